//! Two published robots, each of which takes the other one to be where it was told last: whether they lose contact in
//! a row of nodes without walls (KIT-1 at nodes, KIT-2), where none takes a side out of reach, and whether both can
//! come to wait among walls (KIT-6), by each reading of who answers.

use std::collections::{HashSet, VecDeque};

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Steps};
use tautline_kernel::kit::Answers::{Always, Driving, FirstGoesFirst};
use tautline_kernel::kit::{
    Fallback, Letter, Message, Next, Outbox, Phase, Records, Rule, Runs, Stance, Talk,
};

use super::world::{Demand, Setting, Speeds, World};
use crate::engine::outcomes;

/// Two robots, how they talk, and the letters on their way: to whom, and a bit for each robot that has acted since.
#[derive(Clone, PartialEq, Eq, Hash)]
struct State {
    world: World<2>,
    talks: [Talk; 2],
    letters: Vec<(usize, Letter, u8)>,
}

/// The lattice, and whether a robot that has found no side answers until it decides anew. Else it asks again at once.
struct Pair {
    setting: Setting<2>,
    answers_staying: bool,
}

/// A state that comes next, the drives that were begun, and whether contact is lost.
type Step = (State, usize, bool);

fn nothing(_: Cell) -> Steps {
    Steps::NONE
}

impl State {
    /// This state after `from` has sent these letters. An acknowledgement changes nothing here.
    fn after(mut self, from: usize, sent: Outbox) -> Self {
        let counts =
            |letter: &Letter| matches!(letter.message, Message::Request { .. } | Message::Response { .. });
        let new = sent.into_iter().flatten().filter(counts).map(|letter| (1 - from, letter, 0));
        self.letters.extend(new);
        self
    }

    /// This state after `robot` has acted and sent these letters.
    fn acted(mut self, robot: usize, sent: Outbox) -> Self {
        self.letters.iter_mut().for_each(|(_, _, age)| *age |= 1 << robot);
        self.after(robot, sent)
    }
}

/// `robot` decides: it sees the other one where that is, and knows where it goes as it was told.
fn decided(pair: &Pair, state: &State, robot: usize, oracle: &mut dyn Oracle) -> Option<Step> {
    let mut after = state.clone();
    let (from, other) = (state.talks[robot].next(), state.world.team.stance(1 - robot)?);
    let team = &mut after.world.team;
    if let Some(to) = state.talks[robot].told() {
        team.robots_mut()[1 - robot].stance = Stance::Drives { from: to, to };
    }
    let mut next = team.decide(robot, oracle).ok()?;
    let mut seen = state.world;
    while let Next::Looks(side) = next {
        let sight = pair.setting.see(&mut seen, (robot, from, side), oracle);
        next = team.looked(robot, sight, oracle).ok()?;
    }
    team.robots_mut()[1 - robot].stance = other;
    after.world = World { team: after.world.team, first: after.world.first, ..seen };
    let Next::Drives(to) = next else {
        let talk = &mut after.talks[robot];
        let sent = if pair.answers_staying { talk.drives(from, nothing) } else { talk.arrived(Steps::NONE) };
        return Some((after.acted(robot, sent), 0, false));
    };
    after.world.first = if other.stands() { robot as u8 } else { state.world.first };
    let breaks = pair.setting.broken_by_drive(&state.world, robot, Stance::Drives { from, to }, false);
    let sent = after.talks[robot].drives(to, nothing);
    Some((after.acted(robot, sent), 1, !breaks.is_empty()))
}

/// `robot` arrives, if it does so before the other one.
fn arrived(pair: &Pair, state: &State, robot: usize) -> Option<Step> {
    let both_drive = state.world.team.stances().all(|stance| !stance.stands());
    if both_drive && pair.setting.speeds == Speeds::Equal && usize::from(state.world.first) != robot {
        return None;
    }
    let mut after = state.clone();
    after.world.team.arrived(robot).ok()?;
    after.world.first = 1 - robot as u8;
    let is_lost = pair.setting.broken_by_arrival(&after.world, robot).is_some();
    let sent = after.talks[robot].arrived(Steps::NONE);
    Some((after.acted(robot, sent), 0, is_lost))
}

/// The first robot has left the node where both start, and the second one asks there.
fn starts(pair: &Pair) -> Vec<Step> {
    let entered = |node: Cell| {
        let (second, asks) = Talk::second(pair.setting.rule, node, Steps::NONE);
        let talks = [Talk::first(pair.setting.rule, node), second];
        let start = State { world: pair.setting.start([node; 2])?, talks, letters: Vec::new() };
        let first: Vec<Step> = outcomes(|oracle| decided(pair, &start, 0, oracle)).collect();
        let left = first.into_iter().filter(|&(_, drives, _)| drives > 0);
        Some(left.map(move |(state, drives, is_lost)| (state.after(1, asks), drives, is_lost)))
    };
    pair.setting.area.cells().filter_map(entered).flatten().collect()
}

/// The steps that may come next: a letter takes less time than a robot from one act to the one after the next.
fn steps(pair: &Pair, state: &State) -> Vec<Step> {
    let mut steps = Vec::new();
    for robot in 0..2 {
        if state.letters.iter().any(|(_, _, age)| age >> robot & 1 == 1) {
            continue;
        }
        match state.talks[robot].phase() {
            Phase::Decides => steps.extend(outcomes(|oracle| decided(pair, state, robot, oracle))),
            Phase::Drives if state.world.team.asks(robot) => {
                let mut after = state.clone();
                let sent = after.talks[robot].arrived(Steps::NONE);
                steps.push((after.acted(robot, sent), 0, false));
            }
            Phase::Drives => steps.extend(arrived(pair, state, robot)),
            Phase::Asks | Phase::Waits | Phase::Stays => {}
        }
    }
    for (place, &(to, letter, _)) in state.letters.iter().enumerate() {
        let mut after = state.clone();
        after.letters.remove(place);
        let sent = after.talks[to].hears(letter, nothing);
        steps.push((after.after(to, sent), 0, false));
    }
    steps
}

/// An end of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum End {
    /// Contact is lost after so many drives.
    Lost(usize),
    /// Nobody drives or decides, though an uncovered side is within reach, after so many drives.
    Stuck(usize),
    /// Neither happens in so many states.
    Neither(usize),
}

/// How a run with the fewest steps ends that goes wrong, if there is one.
fn end(pair: &Pair) -> End {
    let (mut known, mut runs) = (HashSet::new(), VecDeque::from(starts(pair)));
    while let Some((state, drives, is_lost)) = runs.pop_front() {
        if is_lost {
            return End::Lost(drives);
        }
        if known.insert(state.clone()) {
            let next = steps(pair, &state);
            if next.is_empty() && !pair.setting.broken_by_staying(&state.world).is_empty() {
                return End::Stuck(drives);
            }
            runs.extend(next.into_iter().map(|(after, begun, is_lost)| (after, drives + begun, is_lost)));
        }
    }
    End::Neither(known.len())
}

/// How two robots in a lattice of this size end that follow `rule`.
fn end_of(rule: Rule, size: (i16, i16), demand: Demand, answers_staying: bool) -> End {
    let lattice = Setting::new(rule, size).expect("a lattice");
    let setting = match demand {
        Demand::Moves => lattice,
        _ => Setting { speeds: Speeds::Equal, max_walls: 0, ..lattice },
    };
    end(&Pair { setting: Setting { demand: Some(demand), ..setting }, answers_staying })
}

#[test]
fn robots_that_filter_their_fallback_lose_contact_where_a_robot_that_stands_answers() {
    for records in [Records::Union, Records::Others] {
        let filtered = Rule { records, fallback: Fallback::Admitted, ..Rule::PUBLISHED };
        for demand in [Demand::Contact, Demand::AtNodes] {
            for (answers, lost) in [(Driving, None), (Always, Some(4)), (FirstGoesFirst, Some(4))] {
                for answers_staying in [true, false] {
                    let rule = Rule { answers, ..filtered };
                    let found = match end_of(rule, (5, 1), demand, answers_staying) {
                        End::Lost(drives) => Some(drives),
                        End::Neither(_) => None,
                        stuck @ End::Stuck(_) => panic!("{stuck:?}"),
                    };
                    assert_eq!(found, lost, "{records:?}, {demand:?}, {answers:?}");
                }
            }
        }
    }
}

/// By old news as by true ones (KIT-6).
#[test]
fn two_robots_do_not_both_wait_where_one_that_stands_answers_and_the_first_that_finds_no_side() {
    for runs in [Runs::Every, Runs::Ahead] {
        for records in [Records::Union, Records::Others] {
            for fallback in [Fallback::Nearest, Fallback::Random, Fallback::Admitted] {
                let waits = |answers, answers_staying| {
                    let rule = Rule { runs, records, fallback, answers, ..Rule::PUBLISHED };
                    match end_of(rule, (3, 1), Demand::Moves, answers_staying) {
                        End::Stuck(drives) => Some(drives),
                        End::Neither(states) => {
                            assert!(states > 9000, "{states} states");
                            None
                        }
                        lost @ End::Lost(_) => panic!("{lost:?}"),
                    }
                };
                for (answers, answered, silent) in
                    [(Driving, Some(1), Some(1)), (Always, None, None), (FirstGoesFirst, None, Some(1))]
                {
                    assert_eq!([true, false].map(|staying| waits(answers, staying)), [answered, silent]);
                }
            }
        }
    }
}

#[test]
#[ignore = "a minute and 2 GiB: cargo test -p tautline-proofs --lib told -- --ignored"]
fn nor_do_they_in_larger_lattices() {
    for (answers, states) in
        [(Always, [120_916, 641_440, 1_566_696]), (FirstGoesFirst, [62_998, 287_530, 732_504])]
    {
        for (size, states) in [(4, 1), (5, 1), (2, 2)].into_iter().zip(states) {
            let rule = Rule { answers, ..Rule::PUBLISHED };
            assert_eq!(
                end_of(rule, size, Demand::Moves, true),
                End::Neither(states),
                "{answers:?}, {size:?}"
            );
        }
    }
}

#[test]
fn two_robots_that_enter_at_once_wait_from_the_beginning_unless_one_that_stands_answers() {
    for (answers, decide) in
        [(Driving, [false, false]), (Always, [true, true]), (FirstGoesFirst, [true, false])]
    {
        let rule = Rule { answers, ..Rule::PUBLISHED };
        let mut first = Talk::first(rule, Cell::new(0, 0));
        let asks = [first.arrived(Steps::NONE), Talk::second(rule, Cell::new(0, 0), Steps::NONE).1];
        let mut robots = [first, Talk::second(rule, Cell::new(0, 0), Steps::NONE).0];
        let mut letters: VecDeque<(usize, Letter)> = VecDeque::new();
        for (from, sent) in asks.into_iter().enumerate() {
            letters.extend(sent.into_iter().flatten().map(|letter| (1 - from, letter)));
        }
        while let Some((to, letter)) = letters.pop_front() {
            let sent = robots[to].hears(letter, nothing);
            letters.extend(sent.into_iter().flatten().map(|letter| (1 - to, letter)));
        }
        assert_eq!(robots.map(|robot| robot.phase() == Phase::Decides), decide, "{answers:?}");
    }
}
