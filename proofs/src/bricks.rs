//! Agents on small floors, as systems whose states are all looked at: which agent acts next and which sensors it
//! misses are choices. What BRICKS-2 to BRICKS-6 demand is in plain arithmetic here; of the kernel's rule only the
//! agents' actions are used.

use rayon::prelude::*;
use tautline_kernel::bricks::{Act, Agent, Condition, Next, Rule, carry_out};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Scan, Sensor, settle};
use tautline_kernel::ground::{Cell, Edge, Side, Step};

use crate::clause::{Sabotage, Subject};
use crate::course::{Course, Explored, Scene, Turn};
use crate::decide::Evidence;
use crate::engine::{Tally, cover, outcomes};
use crate::evidence::{Played, Script, Unfit};
use crate::plans::{Area, CELLS, Plan};
use crate::states::{self, Bits, Found, Run, System, search};

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
    /// BRICKS-2, BRICKS-4 and BRICKS-6, looked at in one pass.
    All,
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
            Demand::Connected => self.is_torn(state),
            Demand::Knowing => self.is_wrong(state, ended),
            Demand::All => self.is_torn(state).or_else(|| self.is_wrong(state, ended)),
            Demand::Explores | Demand::Ends => None,
        }
    }

    fn is_torn(&self, state: &State) -> Option<&'static str> {
        let left = self.left(state);
        let is_one = self.plan.spread(left, |edge| is_shut(&self.plan, &state.sensors, edge)) == left;
        (!is_one).then_some("the accessible cells stay connected")
    }

    fn is_wrong(&self, state: &State, ended: Option<Cell>) -> Option<&'static str> {
        let here = self.plan.place(ended?).map_or(0, |place| 1 << place);
        if !self.is_explored(state) {
            return Some("an agent is done only when every cell is explored");
        }
        (self.left(state) & !here != 0).then_some("an agent is done only when no other cell is left")
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
    pub(crate) world: &'a mut dyn Oracle,
    pub(crate) count: &'a mut u8,
    pub(crate) most: u8,
}

impl Oracle for Misses<'_> {
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

    fn turn(&self, state: &State, world: &mut dyn Oracle) -> Option<Turned> {
        let awake = self.awake(state);
        let is_over = match self.demand {
            Demand::Connected | Demand::Knowing | Demand::Ends | Demand::All => false,
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
        let round = run.round();
        let mut turns = Vec::new();
        for &number in run.steps.iter().chain(round) {
            let Some(turned) = self.turns(&state).nth(number as usize) else { break };
            let Turned { agent, step, unseen, .. } = turned;
            let is_done = turned.state.bodies[agent].is_done;
            turns.push(Turn { before: self.scene(&state), agent, step, is_done, unseen });
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
            Demand::Ends | Demand::All => {
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
            Demand::Ends | Demand::All => {
                Some("no run goes on for ever in which every agent acts again and again")
            }
        }
    }

    fn awake(&self, state: &State) -> Bits {
        (0..).zip(&state.bodies).filter(|(_, body)| !body.is_done).fold(0, |set, (agent, _)| set | 1 << agent)
    }
}

/// Teams to look at: all plans of an area, how many agents start in any of their cells, and how many sensors they miss.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Series {
    area: Area,
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

impl Series {
    /// Every action one step, every schedule, nothing missed, no patience.
    const fn new(area: Area, agents: u32) -> Self {
        let turns = Turns::Whole;
        Self { area, agents, max_misses: 0, max_streak: None, turns, patience: 0, reach: 4 }
    }

    /// The same with missed sensors; no agent acts more than twice while another waits.
    const fn missing(area: Area, agents: u32, max_misses: u8) -> Self {
        Self { max_misses, max_streak: Some(2), ..Self::new(area, agents) }
    }

    /// The same with patient agents, which read the crossings of cells: they count up without end where an agent is kept
    /// from acting, so no agent acts more than twice while another waits.
    const fn patient(area: Area, agents: u32, max_misses: u8) -> Self {
        Self { patience: PATIENT, ..Self::missing(area, agents, max_misses) }
    }

    /// The teams, one in each plan.
    fn teams(self, subject: &Subject, demand: Demand) -> Vec<Team> {
        let Self { area, agents: _, max_misses, max_streak, turns, patience, reach } = self;
        let rule = Rule { patience, reach, ..subject.bricks };
        let is_atomic = subject.sabotage != Sabotage::ActsAtOnce;
        let turns = if turns == Turns::Overlapping && !is_atomic { Turns::Free } else { turns };
        area.plans().map(|plan| Team { plan, rule, turns, max_misses, max_streak, demand }).collect()
    }

    /// What it is, `who` standing for its agents.
    fn words(self, who: &str) -> String {
        let Self { area, agents, max_misses, max_streak, turns, patience, reach: _ } = self;
        let turns = match turns {
            Turns::Whole => None,
            Turns::Overlapping => Some("scans and writes in every order unless scans overlap".to_owned()),
            Turns::Free => Some("scans and writes in every order".to_owned()),
        };
        let streak = max_streak.filter(|_| agents > 1);
        let words = [
            Some(format!("{agents}{who} to {area}")),
            (max_misses > 0).then(|| format!("{max_misses} missed")),
            (patience > 0).then(|| format!("patience {patience}")),
            turns,
            streak.map(|most| format!("at most {most} acts in a row")),
        ];
        words.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// The small floors of a check, and what is demanded of every state of the agents on them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Floors {
    series: &'static [Series],
    demand: Demand,
}

impl Floors {
    /// BRICKS-2, nothing missed, one agent.
    pub const CONNECTED_ALONE: Self = Self { series: &ALONE, demand: Demand::Connected };
    /// BRICKS-2, nothing missed.
    pub const CONNECTED: Self = Self { series: &TOGETHER, demand: Demand::Connected };
    /// BRICKS-2, sensors missed.
    pub const CONNECTED_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Connected };
    /// BRICKS-3
    pub const CONNECTED_IN_TURNS: Self = Self { series: &IN_TURNS, demand: Demand::Connected };
    /// BRICKS-4, nothing missed.
    pub const KNOWING: Self = Self { series: &TOGETHER, demand: Demand::Knowing };
    /// BRICKS-4, sensors missed.
    pub const KNOWING_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Knowing };
    /// BRICKS-5, sensors missed.
    pub const EXPLORES_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Explores };
    /// BRICKS-6, nothing missed, one agent.
    pub const ENDS_ALONE: Self = Self { series: &ALONE, demand: Demand::Ends };
    /// BRICKS-6, nothing missed.
    pub const ENDS: Self = Self { series: &TOGETHER, demand: Demand::Ends };
    /// BRICKS-6, nothing missed, and all gone over twice.
    pub const ENDS_TWICE: Self = Self { series: &TWICE, demand: Demand::Ends };
    /// BRICKS-6, sensors missed.
    pub const ENDS_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Ends };

    /// The same floors with the demands of all clauses that are about them, if these are several.
    pub(crate) fn together(self) -> Option<Self> {
        let shared = [
            Self::CONNECTED,
            Self::KNOWING,
            Self::ENDS,
            Self::CONNECTED_HALF_BLIND,
            Self::KNOWING_HALF_BLIND,
            Self::ENDS_HALF_BLIND,
        ];
        shared.contains(&self).then_some(Self { demand: Demand::All, ..self })
    }

    /// Looks at all states, series by series, until the first violation. Its choices are the numbers of the series, the
    /// plan and the start, then the steps.
    pub fn explore(self, subject: &Subject) -> Explored {
        let mut explored = Explored::default();
        for (number, series) in (0..).zip(self.series) {
            let teams = series.teams(subject, self.demand);
            let tally = &mut explored.tally;
            let Some((team, run)) = look(tally, number, &teams, |team| team.starts(series.agents).collect())
            else {
                continue;
            };
            explored.again = run.round().to_vec();
            explored.course = team.starts(series.agents).nth(run.start).map(|start| team.course(start, &run));
            break;
        }
        explored
    }

    /// Makes the choices of a violation again.
    pub(crate) fn replay(self, subject: &Subject, mut script: Script<'_>) -> Result<Played, Unfit> {
        let series = self.series[script.choose(self.series.len())?];
        let teams = series.teams(subject, self.demand);
        let team = &teams[script.choose(teams.len())?];
        let mut starts: Vec<State> = team.starts(series.agents).collect();
        let number = script.choose(starts.len())?;
        let (choices, start) = (script.choices(), starts.swap_remove(number));
        let (of, run) = script.play(team, (number, start.clone()), |_| true)?;
        let course = Box::new(team.course(start, &run));
        Ok(Played { of, evidence: Evidence::Course(course, choices.clone(), run.demand) })
    }

    /// What it covers, every series by its name.
    pub fn bound(self) -> String {
        let name = |agents: u32| if agents == 1 { " agent" } else { " agents" };
        let first = self.series.iter().take(1).map(|series| series.words(name(series.agents)));
        let mut words: Vec<String> =
            first.chain(self.series.iter().skip(1).map(|series| series.words(""))).collect();
        let mut reaches: Vec<u8> = self.series.iter().map(|series| series.reach).collect();
        reaches.dedup();
        words.extend(reaches.into_iter().map(|reach| format!("reach {reach}")));
        words.join("; ")
    }
}

/// Plans that are looked at between two looks for a violation.
const WAVE: usize = 64;

/// Searches all states of `systems`, which are of the series with this number, from their starts, until something is
/// broken: by which system, and how. The choices of a violation are the numbers of the series, the system, the start, and
/// the steps; the tally is the same on any number of threads.
pub(crate) fn look<'a, S: System<Demand = &'static str> + Sync>(
    tally: &mut Tally,
    series: u32,
    systems: &'a [S],
    starts: impl Fn(&S) -> Vec<S::State> + Sync,
) -> Option<(&'a S, Run<&'static str>)> {
    for (wave, first) in systems.chunks(WAVE).zip((0..).step_by(WAVE)) {
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
            let choices = [&[series, place, run.start as u32], &run.steps[..]].concat();
            tally.violation = Some((choices, run.demand));
            return Some((system, run));
        }
    }
    None
}

/// Nothing missed: one agent alone, two and three in every order; patient ones last, since what is wrong with a rule
/// may let them go on without end.
const TOGETHER: [Series; 7] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
    Series::new(Area::blocked(3, 2), 3),
    Series::new(Area::blocked(3, 3), 2),
    Series::patient(Area::blocked(4, 3), 1, 0),
    Series::patient(Area::blocked(4, 2), 2, 0),
];

/// One agent alone, nothing missed.
const ALONE: [Series; 1] = [Series::new(Area::blocked(4, 4), 1)];

/// Sensors missed; small areas first and patient agents last, as in [`TOGETHER`].
const HALF_BLIND: [Series; 7] = [
    Series::missing(Area::blocked(3, 2), 1, 4),
    Series::missing(Area::walled(3, 2), 1, 2),
    Series::missing(Area::blocked(3, 3), 1, 2),
    Series::missing(Area::blocked(3, 2), 2, 1),
    Series::patient(Area::blocked(3, 3), 1, 1),
    Series::patient(Area::blocked(3, 2), 1, 2),
    Series::patient(Area::blocked(2, 2), 2, 1),
];

/// Scanning and writing are two steps.
const IN_TURNS: [Series; 1] = [Series { turns: Turns::Overlapping, ..Series::new(Area::blocked(5, 2), 2) }];

/// Nothing missed, and all gone over twice.
const TWICE: [Series; 5] = [
    Series::new(Area::blocked(4, 3), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::blocked(4, 2), 2),
    Series::patient(Area::blocked(4, 3), 1, 0),
    Series::patient(Area::blocked(3, 2), 2, 0),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// About two minutes, and 3 GB of memory.
    #[test]
    #[ignore = "takes minutes: cargo test -p tautline-proofs -- --ignored two_agents"]
    fn two_agents_keep_all_layouts_of_four_by_three_cells_connected_and_end_with_every_cell_visited() {
        for demand in [Demand::Connected, Demand::Ends] {
            const FAR: [Series; 1] = [Series { reach: u8::MAX, ..Series::new(Area::blocked(4, 3), 2) }];
            let floors = Floors { series: &FAR, demand };
            let Explored { tally, course, .. } = floors.explore(&Subject::REPAIRED);
            assert_eq!((tally.violation, course, tally.cases), (None, None, 32_566_853), "{demand:?}");
        }
    }
}
