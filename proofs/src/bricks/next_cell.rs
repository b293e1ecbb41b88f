//! Published agents that may choose any next cell: a game between them, who know the whole floor and all that may come
//! of a choice, and the world, which picks who acts and which sensors are missed. Where the world wins, so it does
//! against every order of ties and every other way to choose.

use std::collections::HashMap;

use tautline_kernel::bricks::Condition::Alone;
use tautline_kernel::bricks::{Act, Agent, Next, Rule, carry_out};
use tautline_kernel::floor::SensorFate::{self, Beside, Counted, Lost};
use tautline_kernel::floor::{COMPASS, Mark, Ring, Scan, Sensor};
use tautline_kernel::ground::Cell;

use crate::engine::outcomes;
use crate::floor::plans::{FloorPlan, blocked};
use crate::floor::small::{Misses, Sensors, Small, StateOf};

/// The neighbours among which agents choose where they see unexplored and explored ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Among {
    Unexplored,
    Explored,
    Both,
}

/// A game on one plan.
#[derive(Clone, Copy)]
struct Game {
    plan: FloorPlan,
    rule: Rule,
    /// The most sensors that are missed.
    most: u8,
    /// The cells whose sensors are missed by every scan from elsewhere.
    dark: u16,
    among: Among,
}

/// A state: the sensors, the agents with whether they are done, and how many sensors were missed.
#[derive(Clone, PartialEq, Eq, Hash)]
struct State {
    sensors: Sensors<Sensor>,
    agents: Vec<(Cell, bool)>,
    misses: u8,
}

impl State {
    /// The state without what no agent reads.
    fn settled(mut self) -> Self {
        self.sensors.count_to(0);
        self.sensors.forget_serials();
        self
    }

    fn is_over(&self) -> bool {
        self.agents.iter().all(|&(_, is_done)| is_done)
    }
}

/// Of each state what the world can do, and of each of that the states among which the agents choose.
type Moves = Vec<Vec<Vec<usize>>>;

impl Game {
    const fn new(plan: FloorPlan, rule: Rule) -> Self {
        Self { plan, rule, most: 0, dark: 0, among: Among::Unexplored }
    }

    fn start(&self, cells: &[Cell]) -> State {
        let sensors = StateOf::<Rule>::start(&self.rule, &self.plan, cells).sensors;
        State { sensors, agents: cells.iter().map(|&cell| (cell, false)).collect(), misses: 0 }.settled()
    }

    /// Every scan of an agent that acts, and how many sensors were missed by then.
    fn scans(&self, state: &State) -> Vec<(usize, Scan, u8)> {
        let awake = (0..state.agents.len()).filter(|&agent| !state.agents[agent].1);
        let of = |agent: usize| {
            let (cell, mut sensors) = (state.agents[agent].0, state.sensors.clone());
            let here = self.plan.place(cell).map_or(0, |place| 1 << place);
            outcomes(move |world| {
                let (floor, mut misses) = (
                    Small { plan: &self.plan, sensors: &mut sensors, dark: self.dark & !here },
                    state.misses,
                );
                let scan = Scan::new(&floor, cell, &mut Misses::new(world, &mut misses, self.most));
                Some((agent, scan, misses))
            })
        };
        awake.flat_map(of).collect()
    }

    /// The states among which an agent chooses after a scan: it goes to any unexplored or explored neighbour, of those
    /// that come first if it sees some. All else is the kernel's.
    fn choices(&self, state: &State, (agent, scan, misses): (usize, Scan, u8)) -> Vec<State> {
        let decided = Agent::new(agent as u8).decide(self.rule, &scan);
        let (new, all) = (scan.reachable().and(scan.unexplored), scan.reachable().and(scan.closing.not()));
        let first = match self.among {
            Among::Unexplored => new,
            Among::Explored => all.and(new.not()),
            Among::Both => all,
        };
        let among = if first == Ring::default() { all } else { first };
        let goes = |side| Next::Goes(side, scan.entry(side, self.rule.replaced), scan.claim(side));
        let mut nexts: Vec<Next> = COMPASS.into_iter().filter(|&side| among.has(side)).map(goes).collect();
        if nexts.is_empty() {
            nexts.push(decided.next);
        }
        let after = |next| {
            let mut after = State { misses, ..state.clone() };
            let mut floor = Small { plan: &self.plan, sensors: &mut after.sensors, dark: 0 };
            let cell = carry_out(&mut floor, state.agents[agent].0, &Act { next, ..decided });
            after.agents[agent] = (cell, next == Next::Done);
            after.settled()
        };
        nexts.into_iter().map(after).collect()
    }

    /// All states from these starts, which come first, and the moves between them.
    fn states(&self, starts: impl Iterator<Item = State>) -> (Vec<State>, Moves) {
        let (mut states, mut numbers, mut moves): (Vec<State>, _, _) =
            (Vec::new(), HashMap::new(), Vec::new());
        let mut number = |state: State, states: &mut Vec<State>| {
            *numbers.entry(state).or_insert_with_key(|state| {
                states.push(state.clone());
                states.len() - 1
            })
        };
        for start in starts {
            number(start, &mut states);
        }
        while let Some(state) = states.get(moves.len()).cloned() {
            let scans = self.scans(&state).into_iter();
            let choices = scans.map(|scan| self.choices(&state, scan));
            moves
                .push(choices.map(|of| of.into_iter().map(|to| number(to, &mut states)).collect()).collect());
        }
        (states, moves)
    }

    fn is_explored(&self, state: &State) -> bool {
        state.sensors.is_explored(&self.plan)
    }

    fn is_visited(&self, state: &State) -> bool {
        state.sensors.cells(&self.plan, |sensor| sensor.mark == Mark::Visited) == self.plan.free
    }

    /// BRICKS-4 is broken: an agent is done where other cells are left.
    fn is_early(&self, state: &State) -> bool {
        let left = state.sensors.cells(&self.plan, |sensor| sensor.mark != Mark::Visited);
        let here = |cell| self.plan.place(cell).map_or(0, |place| 1 << place);
        let is_early = |&(cell, is_done): &(Cell, bool)| is_done && left & !here(cell) != 0;
        state.agents.iter().any(is_early)
    }
}

/// The states from which the world brings a run to `goal`, or, where the agents want it, they do.
fn forced(moves: &Moves, mut goal: Vec<bool>, is_for_world: bool) -> Vec<bool> {
    loop {
        let is_forced = |state: &usize| {
            let mut all = moves[*state].iter();
            let (any, every) = (
                |to: &Vec<usize>| to.iter().any(|&to| goal[to]),
                |to: &Vec<usize>| to.iter().all(|&to| goal[to]),
            );
            if is_for_world { all.any(every) } else { all.len() > 0 && all.all(any) }
        };
        let new: Vec<usize> = (0..goal.len()).filter(|state| !goal[*state]).filter(is_forced).collect();
        if new.is_empty() {
            return goal;
        }
        for state in new {
            goal[state] = true;
        }
    }
}

/// Which of BRICKS-4 to BRICKS-6 the world breaks from some start of so many agents; of several BRICKS-4 alone, since a
/// world that lets one of them wait for ever would break the others.
fn broken(game: &Game, agents: u32) -> Vec<&'static str> {
    let starts: Vec<State> = game.plan.starts(agents).map(|cells| game.start(&cells)).collect();
    let count = starts.len();
    let (states, moves) = game.states(starts.into_iter());
    let are = |is: &dyn Fn(&State) -> bool| states.iter().map(is).collect::<Vec<bool>>();
    let early = forced(&moves, are(&|state| game.is_early(state)), true);
    let explores = forced(&moves, are(&|state| game.is_explored(state)), false);
    let ends = forced(&moves, are(&|state| state.is_over() && game.is_visited(state)), false);
    let some = |is: &dyn Fn(usize) -> bool| (0..count.min(states.len())).any(is);
    let all = [
        ("BRICKS-4", some(&|start| early[start])),
        ("BRICKS-5", agents == 1 && some(&|start| !explores[start])),
        ("BRICKS-6", agents == 1 && some(&|start| !ends[start])),
    ];
    all.into_iter().filter(|(_, is)| *is).map(|(clause, _)| clause).collect()
}

fn open(width: i16, height: i16) -> FloorPlan {
    blocked(width, height).next().expect("a plan without blocked cells")
}

const fn replacing(replaced: SensorFate) -> Rule {
    Rule { replaced, ..Rule::PUBLISHED }
}

#[test]
fn whichever_next_cell_agents_choose_the_clauses_are_broken() {
    // Nothing is missed: two agents that mark each other's cells, and one in the middle of nine cells.
    let corridor = Game::new(open(3, 1), Rule::PUBLISHED);
    assert_eq!(broken(&corridor, 2), ["BRICKS-4"]);
    assert!(broken(&Game { rule: Rule::PUBLISHED.with(Alone), ..corridor }, 2).is_empty());
    assert_eq!(broken(&Game::new(open(3, 3), Rule::PUBLISHED), 1), ["BRICKS-6"]);
    // One agent, with some sensors missed, whatever becomes of them.
    for (replaced, most) in [(Lost, 4), (Beside, 3), (Counted, 3)] {
        let square = Game { most, ..Game::new(open(2, 2), replacing(replaced)) };
        assert_eq!(broken(&square, 1), ["BRICKS-4", "BRICKS-6"], "{replaced:?}");
        assert!(broken(&Game { most: most - 1, ..square }, 1).is_empty(), "{replaced:?}");
    }
    let room = Game { most: 4, ..Game::new(open(3, 3), replacing(Lost)) };
    assert_eq!(broken(&room, 1), ["BRICKS-4", "BRICKS-5", "BRICKS-6"]);
    for replaced in [Beside, Counted] {
        let corridor = Game { most: 2, ..Game::new(open(7, 1), replacing(replaced)) };
        assert_eq!(broken(&corridor, 1), ["BRICKS-4", "BRICKS-5", "BRICKS-6"], "{replaced:?}");
    }
    // In the dark: one agent goes to and fro between two ends for ever.
    for replaced in [Lost, Beside, Counted] {
        let corridor = Game { dark: 0b10001, ..Game::new(open(5, 1), replacing(replaced)) };
        assert_eq!(broken(&corridor, 1), ["BRICKS-5", "BRICKS-6"], "{replaced:?}");
    }
}

/// Agents that may go to an explored neighbour where they see an unexplored one lose in larger areas.
#[test]
fn agents_that_may_turn_back_before_all_is_explored_do_not_keep_the_clauses() {
    let game = |width, height, rule| Game { among: Among::Both, ..Game::new(open(width, height), rule) };
    assert_eq!(broken(&game(3, 1, Rule::PUBLISHED), 2), ["BRICKS-4"]);
    assert_eq!(broken(&game(3, 3, Rule::PUBLISHED), 1), ["BRICKS-6"]);
    for replaced in [Lost, Beside, Counted] {
        let room = Game { most: 3, ..game(3, 3, replacing(replaced)) };
        assert_eq!(broken(&room, 1), ["BRICKS-4", "BRICKS-5", "BRICKS-6"], "{replaced:?}");
        for (most, width, height) in [(2, 3, 3), (6, 2, 2), (6, 3, 2), (6, 5, 1)] {
            let broken = broken(&Game { most, ..game(width, height, replacing(replaced)) }, 1);
            assert!(
                broken.iter().all(|&clause| clause == "BRICKS-6" && (width, height) == (3, 3)),
                "{broken:?}"
            );
        }
        // In the dark they explore everything, and need not end.
        for (width, height) in [(5, 1), (2, 2), (3, 3)] {
            for plan in blocked(width, height) {
                let dark = (0..=plan.free).filter(|dark| dark & !plan.free == 0 && dark.count_ones() <= 2);
                for dark in dark {
                    let game = Game { among: Among::Both, dark, ..Game::new(plan, replacing(replaced)) };
                    assert!(broken(&game, 1).iter().all(|&clause| clause == "BRICKS-6"), "{replaced:?}");
                }
            }
        }
        let square = Game { dark: 0b11, ..game(2, 2, replacing(replaced)) };
        assert_eq!(broken(&square, 1), ["BRICKS-6"], "{replaced:?}");
        // Those who go back first go to and fro in a corridor.
        for dark in [0, 0b10001] {
            let corridor = Game { among: Among::Explored, dark, ..game(5, 1, replacing(replaced)) };
            assert_eq!(broken(&corridor, 1), ["BRICKS-5", "BRICKS-6"], "{replaced:?}");
        }
    }
}
