//! Agents on small floors, as systems whose states are all looked at: which agent acts next and which sensors it
//! misses are choices. What BRICKS-2 to BRICKS-6 demand is in plain arithmetic here; of the kernel's rule only the
//! agents' actions are used.

use rayon::prelude::*;
use tautline_kernel::bricks::{Act, Agent, Condition, Next, Rule, carry_out};
use tautline_kernel::choice::Source;
use tautline_kernel::floor::{Floor, Mark, Scan, Sensor, settle};
use tautline_kernel::lattice::{Cell, Edge, Side, Step};

use crate::clause::{Sabotage, Subject};
use crate::course::{Course, Explored, Scene, Turn};
use crate::engine::{Tally, cover, outcomes};
use crate::plans::{CELLS, Plan, blocked, walled};
use crate::states::{self, Bits, Ending, Found, Run, System, search};

/// The sensors of a plan.
pub(crate) struct Small<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) sensors: &'a mut [Sensor; CELLS],
    /// How many sensors have been placed in each cell.
    pub(crate) placed: &'a mut [u8; CELLS],
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
            self.placed[place] = self.placed[place].saturating_add(1);
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
    /// Scanning and writing are two steps, but no agent scans while another whose scan overlaps has yet to write.
    Overlapping,
    /// Scanning and writing are two steps.
    Free,
}

/// What a team is looked at for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Demand {
    /// BRICKS-2, BRICKS-3
    Connected,
    /// BRICKS-4
    Knowing,
    /// BRICKS-5: the run is over when every cell is explored.
    Explores,
    /// BRICKS-6
    Ends,
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
    pub(crate) placed: [u8; CELLS],
    pub(crate) bodies: Vec<Body>,
    /// Sensors missed so far.
    pub(crate) misses: u8,
    /// Who acted last, and how many times in a row; kept only where that is bounded.
    pub(crate) streak: (u8, u8),
}

/// Agents that follow a rule on a plan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Team {
    pub(crate) plan: Plan,
    pub(crate) rule: Rule,
    pub(crate) turns: Turns,
    /// Sensors that are missed in one run at most.
    pub(crate) max_misses: u8,
    /// How many times in a row an agent may act while another waits.
    pub(crate) max_streak: Option<u8>,
    pub(crate) demand: Demand,
}

impl Team {
    /// The start with the agents in these cells.
    pub(crate) fn start(&self, cells: &[Cell]) -> State {
        let (mut sensors, mut placed) = ([Sensor::default(); CELLS], [0; CELLS]);
        let mut floor = Small { plan: &self.plan, sensors: &mut sensors, placed: &mut placed };
        settle(&mut floor, cells);
        let bodies = (0..)
            .zip(cells)
            .map(|(id, &cell)| Body { agent: Agent::new(id), cell, is_done: false, pending: None })
            .collect();
        let mut state = State { sensors, placed, bodies, misses: 0, streak: (0, 0) };
        self.forget(&mut state);
        state
    }

    /// The starts of `agents`, each in any free cell.
    pub(crate) fn starts(&self, agents: u32) -> impl Iterator<Item = State> {
        self.plan.starts(agents).map(|cells| self.start(&cells))
    }

    /// What no agent ever reads is left out of the state: crossings if it goes round at once and is never lost,
    /// identifiers if no sensor is missed.
    fn forget(&self, state: &mut State) {
        let is_ideal = self.max_misses == 0;
        if is_ideal && self.rule.patience == 0 || !self.rule.has(Condition::LeastCrossed) {
            state.sensors.iter_mut().for_each(|sensor| sensor.crossings = 0);
        }
        if is_ideal || !self.rule.has(Condition::SeenOnly) {
            state.placed = [0; CELLS];
            state.sensors.iter_mut().for_each(|sensor| sensor.serial = 0);
        }
    }

    fn marked(&self, state: &State, is: impl Fn(Mark) -> bool) -> u16 {
        marked(&self.plan, &state.sensors, is)
    }

    /// The cells that are left to go through: all but visited ones, or where there is a second pass, but sealed ones.
    fn left(&self, state: &State) -> u16 {
        let is_twofold = self.rule.has(Condition::SecondPass);
        self.marked(state, |mark| match mark {
            Mark::Unexplored | Mark::Explored | Mark::Closing => true,
            Mark::Visited => is_twofold,
            Mark::Sealed => false,
        })
    }

    fn is_explored(&self, state: &State) -> bool {
        self.marked(state, |mark| mark == Mark::Unexplored) == 0
    }

    /// What is broken in `state`, in which the agent in the cell `ended` has just been done.
    fn broken(&self, state: &State, ended: Option<Cell>) -> Option<&'static str> {
        match self.demand {
            Demand::Connected => {
                let left = self.left(state);
                let is_one = self.plan.spread(left, |edge| is_shut(&self.plan, &state.sensors, edge)) == left;
                (!is_one).then_some("the accessible cells stay connected")
            }
            Demand::Knowing => {
                let here = self.plan.place(ended?).map_or(0, |place| 1 << place);
                if !self.is_explored(state) {
                    return Some("an agent is done only when every cell is explored");
                }
                (self.left(state) & !here != 0).then_some("an agent is done only when no other cell is left")
            }
            Demand::Explores | Demand::Ends => None,
        }
    }
}

/// The free cells with such marks.
pub(crate) fn marked(plan: &Plan, sensors: &[Sensor; CELLS], is: impl Fn(Mark) -> bool) -> u16 {
    let cells = (0..CELLS).filter(|place| plan.free >> place & 1 == 1);
    cells.filter(|&place| is(sensors[place].mark)).fold(0, |set, place| set | 1 << place)
}

/// Whether the sensors on both sides of `edge` say that it is shut.
pub(crate) fn is_shut(plan: &Plan, sensors: &[Sensor; CELLS], edge: Edge) -> bool {
    let (one, side) = (edge.cell(), edge.side());
    let says = |cell: Cell, side| plan.place(cell).is_some_and(|place| sensors[place].shut.has(side));
    says(one, side) && says(one.beyond(side), side.opposite())
}

/// Misses sensors a bounded number of times.
pub(crate) struct Misses<'a> {
    pub(crate) world: &'a mut dyn Source,
    pub(crate) count: &'a mut u8,
    pub(crate) most: u8,
}

impl Source for Misses<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.world.pick(below)
    }

    fn mishap(&mut self) -> bool {
        let is_missed = *self.count < self.most && self.world.flip();
        *self.count += u8::from(is_missed);
        is_missed
    }
}

impl Team {
    /// Every turn from `state`; none once the run is over.
    fn turns(&self, state: &State) -> impl Iterator<Item = Turned> {
        outcomes(|world| self.turn(state, world)).flatten()
    }

    fn turn(&self, state: &State, world: &mut dyn Source) -> Option<Turned> {
        let awake = self.awake(state);
        let is_over = match self.demand {
            Demand::Connected | Demand::Knowing | Demand::Ends => false,
            Demand::Explores => self.is_explored(state),
        };
        if awake == 0 || is_over {
            return None;
        }
        let is_awake = |agent: usize| awake >> agent & 1 == 1;
        let is_locked = |agent: usize| {
            let Body { pending, cell, .. } = state.bodies[agent];
            self.turns == Turns::Overlapping
                && pending.is_none()
                && state.bodies.iter().any(|other| {
                    let (dx, dy) = cell.apart(other.cell);
                    other.pending.is_some() && dx.max(dy) <= 2
                })
        };
        let is_tired = |agent: usize| {
            awake.count_ones() > 1 && self.max_streak.is_some_and(|most| state.streak == (agent as u8, most))
        };
        let ready: Vec<usize> = (0..state.bodies.len())
            .filter(|&agent| is_awake(agent) && !is_locked(agent) && !is_tired(agent))
            .collect();
        let agent = ready[if ready.len() > 1 { world.pick(ready.len() as u32) as usize } else { 0 }];
        let mut state = state.clone();
        if let Some(most) = self.max_streak {
            let again = if state.streak.0 == agent as u8 { state.streak.1 } else { 0 };
            state.streak = (agent as u8, most.min(again + 1));
        }
        let body = &mut state.bodies[agent];
        let mut floor = Small { plan: &self.plan, sensors: &mut state.sensors, placed: &mut state.placed };
        let mut unseen = Vec::new();
        let (act, is_due) = if let Some(act) = body.pending.take() {
            (act, true)
        } else {
            let missed = state.misses;
            let mut world = Misses { world, count: &mut state.misses, most: self.max_misses };
            let scan = Scan::new(&floor, body.cell, &mut world);
            if state.misses > missed {
                unseen = scan.misread(&floor, body.cell).collect();
            }
            (body.agent.decide(self.rule, &scan), self.turns == Turns::Whole)
        };
        let mut step = Step::Stay;
        if is_due {
            body.cell = carry_out(&mut floor, body.cell, &act);
            body.is_done = act.next == Next::Done;
            if let Next::Goes(side, ..) = act.next {
                step = Step::Cross(side);
            }
        } else {
            body.pending = Some(act);
        }
        let ended = Some(body.cell).filter(|_| body.is_done);
        self.forget(&mut state);
        let breaks = self.broken(&state, ended);
        Some(Turned { state, agent, step, unseen, breaks })
    }

    fn scene(&self, state: &State) -> Scene {
        let mark = |cell| Some((cell, state.sensors[self.plan.place(cell)?].mark));
        Scene {
            cells: state.bodies.iter().map(|body| body.cell).collect(),
            marks: self.plan.cells().filter_map(mark).collect(),
        }
    }

    /// What happens in `run`, which begins in `start`.
    fn course(&self, start: State, run: &Run<&str>) -> Course {
        let mut state = start;
        let round: &[u32] = match &run.ending {
            Ending::There | Ending::Still => &[],
            Ending::Round(round) => round,
        };
        let mut turns = Vec::new();
        for &number in run.steps.iter().chain(round) {
            let Some(turned) = self.turns(&state).nth(number as usize) else { break };
            let Turned { agent, step, unseen, .. } = turned;
            turns.push(Turn { before: self.scene(&state), agent, step, unseen });
            state = turned.state;
        }
        let Plan { width, height, .. } = self.plan;
        let area = (0..width * height).map(|place| self.plan.cell(place as usize));
        let sides = |cell| [Side::East, Side::South].map(|side| Edge::new(cell, side));
        let is_wall = |edge: &Edge| {
            self.plan.place(edge.cell().beyond(edge.side())).is_some() && !self.plan.is_open(*edge)
        };
        Course {
            width,
            height,
            blocked: area.filter(|&cell| self.plan.place(cell).is_none()).collect(),
            walls: self.plan.cells().flat_map(sides).filter(is_wall).collect(),
            turns,
            round: round.len(),
            end: self.scene(&state),
        }
    }
}

/// What a turn leads to.
struct Turned {
    state: State,
    /// Whose turn it is, and where it goes.
    agent: usize,
    step: Step,
    /// The cells of the sensors that it misses.
    unseen: Vec<Cell>,
    breaks: Option<&'static str>,
}

impl System for Team {
    type State = State;
    type Key = State;
    type Demand = &'static str;

    fn key(&self, state: &State) -> State {
        state.clone()
    }

    fn steps(&self, state: &State) -> impl Iterator<Item = states::Step<State, &'static str>> {
        self.turns(state).map(|Turned { state, agent, breaks, .. }| states::Step {
            state,
            situation: "a step",
            acting: 1 << agent,
            is_bound: true,
            breaks: breaks.into_iter().collect(),
        })
    }

    fn broken_at_end(&self, state: &State) -> Option<&'static str> {
        match self.demand {
            Demand::Connected | Demand::Knowing => None,
            Demand::Explores => (!self.is_explored(state)).then_some("every cell is explored"),
            Demand::Ends => {
                let is_left = |mark| !matches!(mark, Mark::Visited | Mark::Sealed);
                (self.marked(state, is_left) != 0)
                    .then_some("when all agents are done, every cell is visited")
            }
        }
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        match self.demand {
            Demand::Connected | Demand::Knowing => None,
            Demand::Explores => Some("every cell is explored: no run goes on for ever before"),
            Demand::Ends => Some("no run goes on for ever in which every agent acts again and again"),
        }
    }

    fn awake(&self, state: &State) -> Bits {
        (0..).zip(&state.bodies).filter(|(_, body)| !body.is_done).fold(0, |set, (agent, _)| set | 1 << agent)
    }
}

/// Teams to look at: a set of plans, how many agents start in any of their cells, and how many sensors they miss.
struct Series<P> {
    plans: P,
    agents: u32,
    max_misses: u8,
    max_streak: Option<u8>,
    turns: Turns,
    /// Idle moves before an agent goes round; none where what it gains before can only come earlier.
    patience: u8,
    /// Moves after which a lap is cut short: few, so that in small layouts some are and some are not.
    reach: u8,
}

/// Idle moves before an agent goes round where it is to go to least crossed cells for a while: few, so that it does both
/// in small layouts.
const PATIENT: u8 = 2;

impl<P: Iterator<Item = Plan>> Series<P> {
    /// Every action one step, every schedule, nothing missed, no patience.
    fn new(plans: P, agents: u32) -> Self {
        let turns = Turns::Whole;
        Self { plans, agents, max_misses: 0, max_streak: None, turns, patience: 0, reach: 4 }
    }

    /// The same with missed sensors; no agent acts more than twice while another waits.
    fn missing(plans: P, agents: u32, max_misses: u8) -> Self {
        Self { max_misses, max_streak: Some(2), ..Self::new(plans, agents) }
    }

    /// The same with patient agents, which read the crossings of cells: they count up without end where an agent is kept
    /// from acting, so no agent acts more than twice while another waits.
    fn patient(plans: P, agents: u32, max_misses: u8) -> Self {
        Self { patience: PATIENT, ..Self::missing(plans, agents, max_misses) }
    }

    /// Looks at all of them.
    fn look(self, explored: &mut Explored, rule: Rule, demand: Demand) {
        let Self { plans, agents, max_misses, max_streak, turns, patience, reach } = self;
        let rule = Rule { patience, reach, ..rule };
        let teams: Vec<Team> =
            plans.map(|plan| Team { plan, rule, turns, max_misses, max_streak, demand }).collect();
        let broken = look(&mut explored.tally, &teams, |team| team.starts(agents).collect());
        let shown =
            broken.and_then(|(team, run)| Some(team.course(team.starts(agents).nth(run.start)?, &run)));
        explored.course = shown.or(explored.course.take());
    }
}

/// Plans that are looked at between two looks for a violation.
const WAVE: usize = 64;

/// Searches all states of `systems` from their starts, until something is broken: by which system, and how. The choices
/// of a violation are the numbers of the system, the start, and the steps; the tally is the same on any number of threads.
pub(crate) fn look<'a, S: System<Demand = &'static str> + Sync>(
    tally: &mut Tally,
    systems: &'a [S],
    starts: impl Fn(&S) -> Vec<S::State> + Sync,
) -> Option<(&'a S, Run<&'static str>)> {
    for (wave, first) in systems.chunks(WAVE).zip((0..).step_by(WAVE)) {
        if tally.violation.is_some() {
            return None;
        }
        let found: Vec<Found<_>> =
            wave.par_iter().map(|system| search(system, starts(system), u32::MAX)).collect();
        let mut shown = None;
        for ((place, system), Found { states, covered, broken, .. }) in (first..).zip(wave).zip(found) {
            tally.cases += states;
            for situation in covered {
                cover(&mut tally.covered, situation);
            }
            shown = shown.or(broken.into_iter().next().map(|run| (place, system, run)));
        }
        if let Some((place, system, run)) = shown {
            let choices = [&[place, run.start as u32], &run.steps[..]].concat();
            tally.violation = Some((choices, run.demand));
            return Some((system, run));
        }
    }
    None
}

/// Nothing missed: one agent alone, two and three in every order; patient ones last, since what is wrong with a rule
/// may let them go on without end.
fn together(rule: Rule, demand: Demand) -> Explored {
    let mut explored = Explored::default();
    Series::new(blocked(4, 4), 1).look(&mut explored, rule, demand);
    Series::new(walled(3, 3), 1).look(&mut explored, rule, demand);
    Series::new(walled(3, 2), 2).look(&mut explored, rule, demand);
    Series::new(blocked(3, 2), 3).look(&mut explored, rule, demand);
    Series::new(blocked(3, 3), 2).look(&mut explored, rule, demand);
    Series::patient(blocked(4, 3), 1, 0).look(&mut explored, rule, demand);
    Series::patient(blocked(4, 2), 2, 0).look(&mut explored, rule, demand);
    explored
}

/// What [`together`] covers.
pub(crate) const TOGETHER: &str = "1 agent to 4×4, 2 to 3×3, 3 to 3×2; with walls 1 to 3×3, 2 to 3×2";

/// One agent alone, nothing missed.
fn alone(rule: Rule, demand: Demand) -> Explored {
    let mut explored = Explored::default();
    Series::new(blocked(4, 4), 1).look(&mut explored, rule, demand);
    explored
}

/// What [`alone`] covers.
pub(crate) const ALONE: &str = "1 agent to 4×4 cells, every start";

/// Sensors missed; small areas first and patient agents last, as in [`together`].
fn half_blind(rule: Rule, demand: Demand) -> Explored {
    let mut explored = Explored::default();
    Series::missing(blocked(3, 2), 1, 4).look(&mut explored, rule, demand);
    Series::missing(walled(3, 2), 1, 2).look(&mut explored, rule, demand);
    Series::missing(blocked(3, 3), 1, 2).look(&mut explored, rule, demand);
    Series::missing(blocked(3, 2), 2, 1).look(&mut explored, rule, demand);
    Series::patient(blocked(3, 3), 1, 1).look(&mut explored, rule, demand);
    Series::patient(blocked(3, 2), 1, 2).look(&mut explored, rule, demand);
    Series::patient(blocked(2, 2), 2, 1).look(&mut explored, rule, demand);
    explored
}

/// What [`half_blind`] covers.
pub(crate) const HALF_BLIND: &str = "1 agent to 3×3, 2 misses, to 3×2, 4; 2 to 3×2, 1, ≤ 2 acts in a row";

pub(crate) fn connected_alone(subject: &Subject) -> Explored {
    alone(subject.bricks, Demand::Connected)
}

pub(crate) fn connected(subject: &Subject) -> Explored {
    together(subject.bricks, Demand::Connected)
}

pub(crate) fn connected_half_blind(subject: &Subject) -> Explored {
    half_blind(subject.bricks_ants, Demand::Connected)
}

/// Scanning and writing are two steps.
pub(crate) fn connected_in_turns(subject: &Subject) -> Explored {
    let is_atomic = subject.sabotage != Sabotage::ActsAtOnce;
    let turns = if is_atomic { Turns::Overlapping } else { Turns::Free };
    let mut explored = Explored::default();
    let series = Series { turns, ..Series::new(blocked(5, 2), 2) };
    series.look(&mut explored, subject.bricks, Demand::Connected);
    explored
}

/// What [`connected_in_turns`] covers.
pub(crate) const IN_TURNS: &str = "2 agents to 5×2 cells, every order of scans and writes";

pub(crate) fn knowing(subject: &Subject) -> Explored {
    together(subject.bricks, Demand::Knowing)
}

pub(crate) fn knowing_half_blind(subject: &Subject) -> Explored {
    half_blind(subject.bricks, Demand::Knowing)
}

pub(crate) fn robust_knowing_half_blind(subject: &Subject) -> Explored {
    half_blind(subject.bricks_ants, Demand::Knowing)
}

pub(crate) fn explores_half_blind(subject: &Subject) -> Explored {
    half_blind(subject.bricks, Demand::Explores)
}

pub(crate) fn robust_explores_half_blind(subject: &Subject) -> Explored {
    half_blind(subject.bricks_ants, Demand::Explores)
}

pub(crate) fn ends_alone(subject: &Subject) -> Explored {
    alone(subject.bricks, Demand::Ends)
}

pub(crate) fn ends(subject: &Subject) -> Explored {
    together(subject.bricks, Demand::Ends)
}

pub(crate) fn ends_half_blind(subject: &Subject) -> Explored {
    half_blind(subject.bricks, Demand::Ends)
}

pub(crate) fn robust_ends_half_blind(subject: &Subject) -> Explored {
    half_blind(subject.bricks_ants, Demand::Ends)
}

/// Nothing missed, and all gone over twice.
fn twice(rule: Rule, demand: Demand) -> Explored {
    let mut explored = Explored::default();
    Series::new(blocked(4, 3), 1).look(&mut explored, rule, demand);
    Series::new(walled(3, 3), 1).look(&mut explored, rule, demand);
    Series::new(blocked(4, 2), 2).look(&mut explored, rule, demand);
    Series::patient(blocked(4, 3), 1, 0).look(&mut explored, rule, demand);
    Series::patient(blocked(3, 2), 2, 0).look(&mut explored, rule, demand);
    explored
}

/// What [`twice`] covers.
pub(crate) const TWICE: &str = "1 agent to 4×3, 2 to 4×2; with walls 1 to 3×3";

pub(crate) fn robust_ends(subject: &Subject) -> Explored {
    twice(subject.bricks_ants, Demand::Ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// About two minutes, and 3 GB of memory.
    #[test]
    #[ignore = "takes minutes: cargo test -p tautline-proofs -- --ignored two_agents"]
    fn two_agents_keep_all_layouts_of_four_by_three_cells_connected_and_end_with_every_cell_visited() {
        for demand in [Demand::Connected, Demand::Ends] {
            let mut explored = Explored::default();
            let series = Series { reach: u8::MAX, ..Series::new(blocked(4, 3), 2) };
            series.look(&mut explored, Rule::REPAIRED, demand);
            let Explored { tally, course } = explored;
            assert_eq!((tally.violation, course, tally.cases), (None, None, 32_566_853), "{demand:?}");
        }
    }
}
