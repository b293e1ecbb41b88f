//! Agents on small floors, as systems whose states are all looked at: which agent acts next and which sensors it
//! misses are choices. The sentences of BRICKS-2 … BRICKS-8 are in plain arithmetic here; of the kernel's rule only
//! the agents' actions are used.

use tautline_kernel::bricks::{Act, Agent, Next, Rule, carry_out};
use tautline_kernel::choice::Source;
use tautline_kernel::floor::{Floor, Mark, Scan, Sensor};
use tautline_kernel::lattice::{Cell, Edge, Side};

use crate::states::{Step, System};

/// The most cells of a small floor.
pub(crate) const CELLS: usize = 16;

/// A small area: which cells are free, and the walls between them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Plan {
    pub(crate) width: i16,
    pub(crate) height: i16,
    /// Row by row.
    pub(crate) free: u16,
    /// Walls on the eastern and on the southern sides of cells.
    pub(crate) east: u16,
    pub(crate) south: u16,
}

impl Plan {
    fn place(&self, cell: Cell) -> Option<usize> {
        let is_inside = (0..self.width).contains(&cell.x) && (0..self.height).contains(&cell.y);
        is_inside
            .then_some((cell.y * self.width + cell.x) as usize)
            .filter(|place| self.free >> place & 1 == 1)
    }

    fn cell(&self, place: usize) -> Cell {
        Cell::new(place as i16 % self.width, place as i16 / self.width)
    }

    fn is_open(&self, edge: Edge) -> bool {
        let walls = match edge.side() {
            Side::East | Side::West => self.east,
            Side::South | Side::North => self.south,
        };
        let (one, other) = (self.place(edge.cell()), self.place(edge.cell().beyond(edge.side())));
        one.zip(other).is_some_and(|(one, _)| walls >> one & 1 == 0)
    }

    /// The free cells.
    pub(crate) fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let plan = *self;
        (0..CELLS).filter(move |place| plan.free >> place & 1 == 1).map(move |place| plan.cell(place))
    }

    /// Those of `cells` that can be reached from its first one through `cells` and edges that are not `shut`.
    fn spread(&self, cells: u16, is_shut: impl Fn(Edge) -> bool) -> u16 {
        let mut reached = cells & cells.wrapping_neg();
        let mut left: Vec<usize> = (0..CELLS).filter(|place| reached >> place & 1 == 1).collect();
        while let Some(place) = left.pop() {
            for side in Side::ALL {
                let cell = self.cell(place);
                let edge = Edge::new(cell, side);
                let Some(next) =
                    self.place(cell.beyond(side)).filter(|_| self.is_open(edge) && !is_shut(edge))
                else {
                    continue;
                };
                if cells >> next & 1 == 1 && reached >> next & 1 == 0 {
                    reached |= 1 << next;
                    left.push(next);
                }
            }
        }
        reached
    }

    /// Whether all free cells are connected.
    pub(crate) fn is_connected(&self) -> bool {
        self.spread(self.free, |_| false) == self.free
    }
}

/// The sensors of a plan.
struct Small<'a> {
    plan: &'a Plan,
    sensors: &'a mut [Sensor; CELLS],
    placed: &'a mut [u8; CELLS],
}

impl Floor for Small<'_> {
    fn sensor(&self, cell: Cell) -> Option<Sensor> {
        self.plan.place(cell).map(|place| self.sensors[place])
    }

    fn put(&mut self, cell: Cell, sensor: Sensor) {
        if let Some(place) = self.plan.place(cell) {
            self.sensors[place] = sensor;
        }
    }

    fn unpack(&mut self, cell: Cell) -> u16 {
        self.plan.place(cell).map_or(0, |place| {
            self.placed[place] += 1;
            self.placed[place].into()
        })
    }

    fn is_open(&self, edge: Edge) -> bool {
        self.plan.is_open(edge)
    }
}

/// What two agents may do at once.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Turns {
    /// Nothing: every action is one step.
    Whole,
    /// Scanning and writing are two steps, but an agent does not scan while another whose scan overlaps has yet to
    /// write.
    Overlapping,
    /// Scanning and writing are two steps.
    Free,
}

/// An agent on the floor.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Body {
    pub(crate) agent: Agent,
    pub(crate) cell: Cell,
    pub(crate) is_done: bool,
    /// What it has decided and has yet to carry out.
    pub(crate) pending: Option<Act>,
}

/// The state of a floor and its agents.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct State {
    pub(crate) sensors: [Sensor; CELLS],
    pub(crate) bodies: Vec<Body>,
    pub(crate) placed: [u8; CELLS],
    pub(crate) misses: u8,
    /// Who acted last, and how many times in a row; kept only where that is bounded.
    pub(crate) streak: (u8, u8),
}

/// Agents that follow a rule on a plan.
pub(crate) struct Team {
    pub(crate) plan: Plan,
    pub(crate) rule: Rule,
    pub(crate) turns: Turns,
    pub(crate) max_misses: u8,
    /// How many times in a row an agent may act while another waits.
    pub(crate) patience: Option<u8>,
}

impl Team {
    /// The start with the agents in these cells.
    pub(crate) fn start(&self, cells: &[Cell]) -> State {
        let mut sensors = [Sensor::default(); CELLS];
        let mut placed = [0; CELLS];
        let mut floor = Small { plan: &self.plan, sensors: &mut sensors, placed: &mut placed };
        for &cell in cells {
            tautline_kernel::floor::enter(&mut floor, cell, tautline_kernel::floor::Entry::Known);
        }
        self.forget(&mut sensors);
        if !self.rule.has(tautline_kernel::bricks::Condition::SeenOnly) || self.max_misses == 0 {
            placed = [0; CELLS];
        }
        let bodies = (0..)
            .zip(cells)
            .map(|(id, &cell)| Body { agent: Agent::new(id), cell, is_done: false, pending: None })
            .collect();
        State { sensors, bodies, misses: 0, streak: (0, 0), placed }
    }

    /// What no agent reads is left out of the state.
    fn forget(&self, sensors: &mut [Sensor; CELLS]) {
        if self.max_misses == 0
            && (self.rule.patience == 0 || !self.rule.has(tautline_kernel::bricks::Condition::LeastCrossed))
        {
            for sensor in sensors {
                sensor.crossings = 0;
                sensor.serial = 0;
            }
        }
    }

    fn marked(&self, state: &State, is: impl Fn(Mark) -> bool) -> u16 {
        (0..CELLS)
            .filter(|place| self.plan.free >> place & 1 == 1 && is(state.sensors[*place].mark))
            .fold(0, |set, place| set | 1 << place)
    }

    fn is_shut(&self, state: &State, edge: Edge) -> bool {
        let says =
            |cell: Cell, side| self.plan.place(cell).is_some_and(|place| state.sensors[place].shut.has(side));
        says(edge.cell(), edge.side()) && says(edge.cell().beyond(edge.side()), edge.side().opposite())
    }

    fn broken(&self, state: &State, ended: Option<Cell>) -> Option<&'static str> {
        let second = self.rule.has(tautline_kernel::bricks::Condition::SecondPass);
        let accessible = self.marked(state, |mark| match mark {
            Mark::Visited => second,
            Mark::Sealed => false,
            Mark::Unexplored | Mark::Explored | Mark::Closing => true,
        });
        if self.plan.spread(accessible, |edge| self.is_shut(state, edge)) != accessible {
            return Some("the accessible cells stay connected");
        }
        let cell = ended?;
        if self.marked(state, |mark| mark == Mark::Unexplored) != 0 {
            return Some("an agent is done only when every cell is explored");
        }
        let here = self.plan.place(cell).map_or(0, |place| 1 << place);
        (accessible & !here != 0).then_some("an agent is done only when no other cell is left")
    }
}

struct Bounded<'a> {
    world: &'a mut dyn Source,
    left: &'a mut u8,
    most: u8,
}

impl Source for Bounded<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.world.pick(below)
    }

    fn mishap(&mut self) -> bool {
        let is = *self.left < self.most && self.world.flip();
        *self.left += u8::from(is);
        is
    }
}

impl System for Team {
    type State = State;

    fn step(&self, state: &State, world: &mut dyn Source) -> Option<Step<State>> {
        let awake: Vec<usize> =
            (0..state.bodies.len()).filter(|&agent| !state.bodies[agent].is_done).collect();
        if awake.is_empty() || self.max_misses > 0 && self.marked(state, |mark| mark == Mark::Unexplored) == 0
        {
            return None;
        }
        let is_locked = |agent: usize| {
            self.turns == Turns::Overlapping
                && state.bodies[agent].pending.is_none()
                && (0..state.bodies.len()).any(|other| {
                    let (dx, dy) = state.bodies[agent].cell.apart(state.bodies[other].cell);
                    other != agent && state.bodies[other].pending.is_some() && dx.max(dy) <= 2
                })
        };
        let is_tired = |agent: usize| {
            self.patience.is_some_and(|most| state.streak == (agent as u8, most)) && awake.len() > 1
        };
        let ready: Vec<usize> =
            awake.iter().copied().filter(|&agent| !is_locked(agent) && !is_tired(agent)).collect();
        let agent = ready[world.pick(ready.len() as u32) as usize];
        let mut state = state.clone();
        if self.patience.is_some() {
            let again = if state.streak.0 == agent as u8 { state.streak.1 } else { 0 };
            state.streak = (agent as u8, (again + 1).min(self.patience.unwrap_or(0)));
        }
        let body = &mut state.bodies[agent];
        let mut floor = Small { plan: &self.plan, sensors: &mut state.sensors, placed: &mut state.placed };
        let (act, is_due) = match body.pending.take() {
            Some(act) => (act, true),
            None => {
                let mut world = Bounded { world, left: &mut state.misses, most: self.max_misses };
                let act = body.agent.decide(self.rule, &Scan::new(&floor, body.cell, &mut world));
                (act, self.turns == Turns::Whole)
            }
        };
        let mut ended = None;
        if is_due {
            body.cell = carry_out(&mut floor, body.cell, &act);
            body.is_done = act.next == Next::Done;
            ended = Some(body.cell).filter(|_| body.is_done);
        } else {
            body.pending = Some(act);
        }
        self.forget(&mut state.sensors);
        if !self.rule.has(tautline_kernel::bricks::Condition::SeenOnly) || self.max_misses == 0 {
            state.placed = [0; CELLS];
        }
        let breaks = self.broken(&state, ended);
        Some(Step { agent: agent as u32, state, breaks })
    }

    fn broken_at_end(&self, state: &State) -> Option<&'static str> {
        if self.max_misses > 0 {
            return (self.marked(state, |mark| mark == Mark::Unexplored) != 0)
                .then_some("everything is explored");
        }
        let left = self.marked(state, |mark| !matches!(mark, Mark::Visited | Mark::Sealed));
        (left != 0).then_some("when all agents are done, every cell is visited")
    }

    fn awake(&self, state: &State) -> u32 {
        (0..).zip(&state.bodies).filter(|(_, body)| !body.is_done).fold(0, |set, (agent, _)| set | 1 << agent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::states::search;

    fn draw(team: &Team, state: &State) -> String {
        let mut text = String::new();
        for y in 0..team.plan.height {
            for x in 0..team.plan.width {
                let cell = Cell::new(x, y);
                let Some(place) = team.plan.place(cell) else {
                    text.push_str("##  ");
                    continue;
                };
                let mark = match state.sensors[place].mark {
                    Mark::Unexplored => '?',
                    Mark::Explored => '.',
                    Mark::Closing => '-',
                    Mark::Visited => 'x',
                    Mark::Sealed => 'X',
                };
                text.push(mark);
                let who = state.bodies.iter().position(|body| body.cell == cell && !body.is_done);
                text.push_str(&who.map_or(" ".to_owned(), |who| who.to_string()));
                text.push(if state.sensors[place].claim.is_some() { 'c' } else { ' ' });
                text.push(if state.sensors[place].shut.has(Side::East) { '|' } else { ' ' });
            }
            text.push('\n');
        }
        text
    }

    #[test]
    fn experiment() {
        let var = |name: &str, default: &str| std::env::var(name).unwrap_or_else(|_| default.to_owned());
        let agents: usize = var("AGENTS", "1").parse().unwrap();
        let misses: u8 = var("MISSES", "0").parse().unwrap();
        let patience: Option<u8> = var("STREAK", "").parse().ok();
        let rule = match var("RULE", "repaired").as_str() {
            "published" => Rule::PUBLISHED,
            "robust" => Rule::ROBUST,
            "walls" => Rule::REPAIRED.without(tautline_kernel::bricks::Condition::LeastCrossed),
            "unseen" => Rule::ROBUST.without(tautline_kernel::bricks::Condition::SeenOnly),
            _ => Rule::REPAIRED,
        };
        let rule = Rule { patience: var("PATIENCE", "0").parse().unwrap(), ..rule };
        let turns = match var("TURNS", "whole").as_str() {
            "free" => Turns::Free,
            "overlap" => Turns::Overlapping,
            _ => Turns::Whole,
        };
        let (w, h): (i16, i16) = (var("W", "3").parse().unwrap(), var("H", "3").parse().unwrap());
        let walls = var("WALLS", "") != "";
        let n = (w * h) as usize;
        let (mut layouts, mut states, mut steps, mut most) = (0, 0, 0, 0);
        let edges: Vec<(bool, usize)> = (0..n)
            .flat_map(|p| [(true, p), (false, p)])
            .filter(|&(east, p)| if east { (p as i16 % w) + 1 < w } else { (p as i16 / w) + 1 < h })
            .collect();
        let count = if walls { 1_u64 << edges.len() } else { 1 << n };
        let started = std::time::Instant::now();
        for number in 0..count {
            let mut plan = Plan { width: w, height: h, free: ((1_u32 << n) - 1) as u16, east: 0, south: 0 };
            if walls {
                for (bit, &(east, p)) in edges.iter().enumerate() {
                    if number >> bit & 1 == 1 {
                        if east { plan.east |= 1 << p } else { plan.south |= 1 << p }
                    }
                }
            } else {
                plan.free = !(number as u16) & plan.free;
            }
            if plan.free == 0 || !plan.is_connected() {
                continue;
            }
            let team = Team { plan, rule, turns, max_misses: misses, patience };
            let cells: Vec<Cell> = plan.cells().collect();
            let starts: Vec<Vec<Cell>> = match agents {
                1 => cells.iter().map(|&c| vec![c]).collect(),
                2 => cells.iter().flat_map(|&a| cells.iter().map(move |&b| vec![a, b])).collect(),
                _ => cells
                    .iter()
                    .flat_map(|&a| cells.iter().map(move |&b| (a, b)))
                    .flat_map(|(a, b)| cells.iter().map(move |&c| vec![a, b, c]))
                    .collect::<Vec<_>>(),
            };
            let found = search(&team, starts.iter().map(|cells| team.start(cells)));
            layouts += 1;
            states += found.states;
            steps += found.steps;
            most = most.max(found.states);
            if let Some(run) = found.broken {
                println!("layout {number}: {} after {} steps", run.demand, run.answers.len());
                let mut state = team.start(&starts[run.start]);
                println!("{}", draw(&team, &state));
                for answers in &run.answers {
                    let mut tape = crate::engine::Tape(answers);
                    state = team.step(&state, &mut tape).unwrap().state;
                    println!(
                        "{answers:?} {:?}\n{}",
                        state.bodies.iter().map(|b| b.agent).collect::<Vec<_>>(),
                        draw(&team, &state)
                    );
                }
                if run.demand == crate::states::ENDLESS {
                    println!("-- endless, on:");
                    for _ in 0..var("MORE", "12").parse().unwrap() {
                        let k = team.awake(&state).count_ones();
                        let pick = [rand(&mut 0) % k];
                        state = team.step(&state, &mut crate::engine::Tape(&pick)).unwrap().state;
                        println!(
                            "{:?}\n{}",
                            state.bodies.iter().map(|b| b.agent).collect::<Vec<_>>(),
                            draw(&team, &state)
                        );
                    }
                }
                return;
            }
        }
        println!(
            "{w}x{h} agents {agents}: {layouts} layouts, {states} states, {steps} steps, most {most}, {:?}",
            started.elapsed()
        );
    }
    fn rand(_: &mut u32) -> u32 {
        0
    }
}
