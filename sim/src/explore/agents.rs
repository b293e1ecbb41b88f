//! A team of agents on a sensor floor (paper 004), whichever way they decide, and what is the same in all their rows.
//! In a team move every agent that is not done acts once, in the order of the agents' ids.
//!
//! Missed sensors are drawn from `ChaCha8`, seeded with the seed of the run as layouts are, with the tag `miss`: one
//! draw for each sensor that is asked about, agent by agent, clockwise from the northern neighbour. Where the
//! probability is 0 nothing is drawn. A counterexample has the sensors that are missed written down: by their numbers
//! among all that are asked about.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use tautline_kernel::ants;
use tautline_kernel::bricks::{self, Agent, Condition, Next};
use tautline_kernel::chain::Kind;
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Claim, Mark, Scan, settle};
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_kernel::perception::time;
pub use tautline_proofs::floor::trap::Way;
use tautline_proofs::run::Frame;

use super::clause::ClauseId;
use super::floor::{Component, SensorFloor, is_visited};
use super::run::{End, Team};
use super::setup::{Profile, Senses, Setup, Starts};
use super::stage::Look;
use super::survey::Survey;
use crate::layout::Layout;
use crate::layout::generate::{self, Probability};

/// The most agents on a floor: a sensor keeps an id in eight bits, and counts agents in as many.
const MAX_AGENTS: usize = 255;

/// What is the same in the rows of all agents.
pub(super) const AGENTS: Profile = Profile {
    name: "",
    about: "",
    rules: &[],
    team: "team",
    robots: 1..=MAX_AGENTS,
    starts: Starts::Anywhere,
    senses: Senses::Floor,
    extras: &[],
    look: Look::Apart,
    knowledge: None,
    clauses: &[],
};

/// An agent is done, and a cell that it could get to is unexplored.
pub const PREMATURE: ClauseId = ClauseId::new("BRICKS-4");

/// The run has ended, or goes on for ever, and a cell that an agent could get to is not visited.
pub const UNVISITED: ClauseId = ClauseId::new("BRICKS-6");

/// The world: which sensors are missed, by chance or as it is written down.
#[derive(Clone)]
struct Misses {
    chance: Probability,
    generator: ChaCha8Rng,
    /// The numbers of the questions, counted from 1, that are answered yes; in order.
    written: Vec<u32>,
    asked: u32,
}

impl Misses {
    /// Whether any sensor is ever missed.
    fn is_never(&self) -> bool {
        self.chance.is_never() && self.written.is_empty()
    }

    /// Whether no sensor is missed from now on.
    fn is_over(&self) -> bool {
        self.chance.is_never() && self.written.last().is_none_or(|&last| last <= self.asked)
    }
}

impl Oracle for Misses {
    fn pick(&mut self, below: u32) -> u32 {
        ((u128::from(self.generator.next_u64()) * u128::from(below)) >> 64) as u32
    }

    fn mishap(&mut self) -> bool {
        self.asked = self.asked.saturating_add(1);
        let is_missed = !self.chance.is_never() && self.chance.happens(&mut self.generator);
        is_missed || self.written.binary_search(&self.asked).is_ok()
    }
}

/// An agent on the floor.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Body {
    agent: Agent,
    is_done: bool,
}

/// How long an agent scans and goes in a team move, by the paper's means.
fn milliseconds(scan: &Scan, step: Step) -> u64 {
    u64::from(match step {
        Step::Cross(_) => time::step_milliseconds(scan.detected),
        Step::Stay => time::scan_milliseconds(scan.detected),
    })
}

/// A team of agents on a floor.
#[derive(Clone)]
pub struct Agents {
    way: Way,
    floor: SensorFloor,
    bodies: Vec<Body>,
    cells: Vec<Cell>,
    /// What each agent did in the last team move.
    steps: Vec<Step>,
    /// Whether in the last team move an agent was done although it could have got to an unexplored cell.
    is_premature: bool,
    /// How long each agent has scanned and gone.
    milliseconds: Vec<u64>,
    misses: Misses,
    /// The cells of the sensors that were missed in the last team move.
    unseen: Vec<Cell>,
}

impl Agents {
    /// A team in `layout`, an agent in each of `starts`: at most 255, and in free cells. They miss sensors by `chance`, drawn
    /// from `seed`.
    pub fn new(way: Way, layout: &Layout, starts: &[Cell], chance: Probability, seed: u64) -> Self {
        let mut floor = SensorFloor::new(layout, starts);
        settle(&mut floor, starts);
        let bodies = (0..=u8::MAX).zip(starts).map(|(id, _)| Body { agent: Agent::new(id), is_done: false });
        Self {
            way,
            floor,
            bodies: bodies.collect(),
            cells: starts.to_vec(),
            steps: vec![Step::Stay; starts.len()],
            is_premature: false,
            milliseconds: vec![0; starts.len()],
            misses: Misses {
                chance,
                generator: generate::source(seed, *b"miss    "),
                written: Vec::new(),
                asked: 0,
            },
            unseen: Vec::new(),
        }
    }

    /// The team of `setup` at its start, which explores by `way`.
    pub(super) fn of(setup: &Setup, way: Way) -> Self {
        let team = Self::new(way, &setup.layout, &setup.starts(), setup.miss, setup.seed);
        Self { misses: Misses { written: setup.missed.clone(), ..team.misses }, ..team }
    }

    /// Where the agents are.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// What each agent did in the last team move.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The floor.
    pub const fn floor(&self) -> &SensorFloor {
        &self.floor
    }

    /// How many agents are not done. Ants are never done.
    pub fn active(&self) -> u32 {
        self.sum(|component| component.active.into())
    }

    /// Makes one team move.
    pub fn advance(&mut self) {
        self.floor.clear_marked();
        self.unseen.clear();
        self.is_premature = false;
        for number in 0..self.bodies.len() {
            self.steps[number] = if self.bodies[number].is_done { Step::Stay } else { self.act(number) };
        }
    }

    /// An agent acts; what it does.
    fn act(&mut self, number: usize) -> Step {
        let (body, cell) = (&mut self.bodies[number], &mut self.cells[number]);
        let scan = Scan::new(&self.floor, *cell, &mut self.misses);
        if !self.misses.is_never() {
            self.unseen.extend(scan.misread(&self.floor, *cell));
        }
        let step = match self.way {
            Way::Ants(rule) => ants::act(rule, &mut self.floor, *cell, &scan).map_or(Step::Stay, |side| {
                *cell = cell.beyond(side);
                Step::Cross(side)
            }),
            Way::Bricks(rule) => {
                let act = body.agent.decide(rule, &scan);
                *cell = bricks::carry_out(&mut self.floor, *cell, &act);
                match act.next {
                    Next::Goes(side, ..) => Step::Cross(side),
                    Next::Waits => Step::Stay,
                    Next::Done => {
                        body.is_done = true;
                        self.is_premature |= self.floor.retire(*cell);
                        Step::Stay
                    }
                }
            }
        };
        self.milliseconds[number] += milliseconds(&scan, step);
        step
    }

    /// How long the slowest agent has scanned and gone.
    pub fn milliseconds(&self) -> u64 {
        self.milliseconds.iter().copied().max().unwrap_or(0)
    }

    /// Cells that agents can get to.
    pub fn due(&self) -> u32 {
        self.sum(|component| component.cells)
    }

    /// Those of them that are explored.
    pub fn explored(&self) -> u32 {
        self.sum(|component| component.explored)
    }

    /// Those of them that are visited.
    pub fn visited(&self) -> u32 {
        self.sum(|component| component.visited)
    }

    fn sum(&self, number: impl Fn(&Component) -> u32) -> u32 {
        self.floor.components().iter().map(number).sum()
    }

    /// Whether the run is over: every agent is done or, where some may never know that they are, everything is explored.
    pub fn is_over(&self) -> bool {
        self.active() == 0 || self.explored() == self.due() && self.may_roam()
    }

    /// Whether agents may go on for ever although nothing is left to explore: ants, and those that go over visited cells
    /// again, to whom missed sensors always show something.
    fn may_roam(&self) -> bool {
        match self.way {
            Way::Ants(_) => true,
            Way::Bricks(rule) => rule.has(Condition::SecondPass) && !self.misses.chance.is_never(),
        }
    }

    /// Whether a run that comes back to where it was goes on for ever: nothing is left to chance, and no agent reads
    /// the crossings, which only grow.
    fn repeats(&self) -> bool {
        match self.way {
            Way::Ants(_) => false,
            Way::Bricks(rule) => !rule.has(Condition::LeastCrossed) && self.misses.chance.is_never(),
        }
    }
}

/// Agents that may go round for ever.
struct Watched {
    team: Agents,
    watch: Option<Watch>,
}

/// The agents of `setup`, each at its start.
pub(super) fn start(setup: &Setup, way: Way) -> Box<dyn Team> {
    let team = Agents::of(setup, way);
    let watch = team.repeats().then(|| Watch::new(&team));
    Box::new(Watched { team, watch })
}

/// The cells that an agent of `setup` can get to and that are not visited, as `chart` shows.
pub(super) fn missed(setup: &Setup, chart: &Survey) -> Vec<Cell> {
    unvisited(&SensorFloor::new(&setup.layout, &setup.starts()), chart)
}

/// The cells that an agent can get to and that are not visited, as `chart` shows.
fn unvisited(floor: &SensorFloor, chart: &Survey) -> Vec<Cell> {
    let due = chart.area().cells().filter(|&cell| floor.component(cell).is_some());
    due.filter(|&cell| !is_visited(chart.mark(cell, u32::MAX))).collect()
}

impl Team for Watched {
    fn cells(&self) -> &[Cell] {
        self.team.cells()
    }

    fn advance(&mut self, _: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        if self.team.is_over() {
            let is_explored = self.team.explored() == self.team.due();
            return Err(if is_explored { End::Explored } else { End::Exhausted });
        }
        if self.watch.as_mut().is_some_and(|watch| watch.has_come_round(&self.team)) {
            return Err(End::Endless);
        }
        self.team.advance();
        let (steps, cells) = (self.team.steps.clone(), self.team.cells.clone());
        Ok(Frame { kind: Kind::Advance, blocked: vec![false; steps.len()], steps, cells })
    }

    fn due(&self, _: &Layout) -> u32 {
        self.team.due()
    }

    fn missed(&self, _: &Layout, chart: &Survey) -> Vec<Cell> {
        unvisited(self.team.floor(), chart)
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        if self.team.is_premature { vec![PREMATURE] } else { Vec::new() }
    }

    /// That every cell is visited is promised where no sensor is missed, and by those who mark cells.
    fn broken_at_end(&self, _: &Layout, _: &Survey, _: End) -> Vec<ClauseId> {
        let is_promised = match self.team.way {
            Way::Ants(_) => false,
            Way::Bricks(_) => self.team.misses.is_never(),
        };
        let is_broken = is_promised && self.team.visited() < self.team.due();
        if is_broken { vec![UNVISITED] } else { Vec::new() }
    }

    fn marked(&self) -> &[(Cell, Mark)] {
        self.team.floor.marked()
    }

    fn unseen(&self) -> &[Cell] {
        &self.team.unseen
    }

    fn components(&self) -> &[Component] {
        self.team.floor.components()
    }

    fn milliseconds(&self) -> Option<u64> {
        Some(self.team.milliseconds())
    }
}

/// Looks for runs that go on for ever: agents and claims that are as they were, with no mark and no side changed in
/// between, go round (Brent 1980).
struct Watch {
    bodies: Vec<Body>,
    cells: Vec<Cell>,
    claims: Vec<(usize, Claim)>,
    gains: u64,
    /// Team moves since this was noted, and how many there are until the next note.
    moves: u64,
    due: u64,
}

impl Watch {
    fn new(team: &Agents) -> Self {
        Self {
            bodies: team.bodies.clone(),
            cells: team.cells.clone(),
            claims: team.floor.claims().to_vec(),
            gains: team.floor.gains(),
            moves: 0,
            due: 1,
        }
    }

    /// Whether the team, which has made a team move since the last call, is where it was.
    fn has_come_round(&mut self, team: &Agents) -> bool {
        if self.gains != team.floor.gains() || !team.misses.is_over() {
            *self = Self { moves: 1, ..Self::new(team) };
            return false;
        }
        let is_back = self.moves > 0
            && self.cells == team.cells
            && self.bodies == team.bodies
            && self.claims == team.floor.claims();
        if is_back {
            return true;
        }
        if self.moves == self.due {
            *self = Self { due: 2 * self.due, ..Self::new(team) };
        }
        self.moves += 1;
        false
    }
}
