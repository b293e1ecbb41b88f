//! A team of agents on a sensor floor [Ferranti 2009], whichever way they decide, and what is the same in all their
//! rows. In a team move every agent that is not done acts once, in the order of the agents' ids.
//!
//! Missed sensors are drawn from `ChaCha8`, seeded with the seed of the run as layouts are, with the tag `miss`: one
//! draw for each sensor that is asked about, agent by agent, clockwise from the northern neighbour. Where the
//! probability is 0 nothing is drawn. A counterexample has the sensors that are missed written down: by their numbers
//! among all that are asked about.

use rand_chacha::ChaCha8Rng;
use tautline_kernel::ants;
use tautline_kernel::bricks::{self, Agent, Condition, Next};
use tautline_kernel::chain::Kind;
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Claim, Mark, Scan, Sensor, settle};
use tautline_kernel::ground::{Cell, Edge, Step};
pub use tautline_proofs::floor::trap::Way;
use tautline_proofs::run::Frame;

use super::clause::ClauseId;
use super::floor::{self, Component, SensorFloor, Stored, is_visited};
use super::run::{End, Team};
use super::scan_time;
use super::scene::{Layer, Scene};
use super::setup::{By, Drawn, Look, Profile, Senses, Setup, Starts};
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
    drawn: &[Drawn { what: "which sensors are missed", by: By::Miss }],
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
pub struct Misses {
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
        generate::below(below, &mut self.generator)
    }

    fn mishap(&mut self) -> bool {
        self.asked = self.asked.saturating_add(1);
        let is_missed = !self.chance.is_never() && self.chance.happens(&mut self.generator);
        is_missed || self.written.binary_search(&self.asked).is_ok()
    }
}

/// How agents on a floor decide, and what their sensors store.
pub trait Crew: Copy + 'static {
    /// What a sensor stores.
    type Stored: Stored;
    /// What an agent remembers.
    type Mind: Copy + PartialEq;
    /// What it sees.
    type View;

    /// What the agent with this id remembers at the start.
    fn mind(&self, id: u8) -> Self::Mind;

    /// Puts agents into the cells where they start.
    fn settle(&self, floor: &mut SensorFloor<Self::Stored>, starts: &[Cell]);

    /// A scan from `cell`; `world` says which sensors are missed.
    fn look(&self, floor: &SensorFloor<Self::Stored>, cell: Cell, world: &mut Misses) -> Self::View;

    /// The marks that were seen.
    fn scan(view: &Self::View) -> &Scan;

    /// One action of an agent in `cell` that has seen `view`.
    fn act(
        &self,
        floor: &mut SensorFloor<Self::Stored>,
        mind: &mut Self::Mind,
        cell: Cell,
        view: &Self::View,
    ) -> Acted;

    /// Whether agents may go on for ever although nothing is left to explore; sensors are missed by chance, or none is.
    fn may_roam(&self, by_chance: bool) -> bool;

    /// Whether agents that are where they were do as they did, as long as no sensor is missed.
    fn repeats(&self) -> bool;

    /// Whether it is promised that in the end every cell is visited; sensors are missed, or none is.
    fn promises(&self, is_blind: bool) -> bool;
}

/// What an agent did.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Acted {
    /// Where it went.
    pub step: Step,
    /// Whether it is done.
    pub is_done: bool,
}

impl Crew for Way {
    type Stored = Sensor;
    type Mind = Agent;
    type View = Scan;

    fn mind(&self, id: u8) -> Agent {
        Agent::new(id)
    }

    fn settle(&self, floor: &mut SensorFloor, starts: &[Cell]) {
        settle(floor, starts);
    }

    fn look(&self, floor: &SensorFloor, cell: Cell, world: &mut Misses) -> Scan {
        Scan::new(floor, cell, world)
    }

    fn scan(view: &Scan) -> &Scan {
        view
    }

    fn act(&self, floor: &mut SensorFloor, agent: &mut Agent, cell: Cell, scan: &Scan) -> Acted {
        let crosses = |side| Acted { step: Step::Cross(side), is_done: false };
        let stays = |is_done| Acted { step: Step::Stay, is_done };
        match *self {
            Self::Ants(rule) => ants::act(rule, floor, cell, scan).map_or(stays(false), crosses),
            Self::Bricks(rule) => {
                let act = agent.decide(rule, scan);
                bricks::carry_out(floor, cell, &act);
                match act.next {
                    Next::Goes(side, ..) => crosses(side),
                    Next::Waits => stays(false),
                    Next::Done => stays(true),
                }
            }
        }
    }

    /// Ants, and those that go over visited cells again, to whom missed sensors always show something.
    fn may_roam(&self, by_chance: bool) -> bool {
        match self {
            Self::Ants(_) => true,
            Self::Bricks(rule) => rule.has(Condition::SecondPass) && by_chance,
        }
    }

    /// Unless an agent reads the crossings, which only grow.
    fn repeats(&self) -> bool {
        match self {
            Self::Ants(_) => false,
            Self::Bricks(rule) => !rule.has(Condition::LeastCrossed),
        }
    }

    /// By those who mark cells, where no sensor is missed.
    fn promises(&self, is_blind: bool) -> bool {
        match self {
            Self::Ants(_) => false,
            Self::Bricks(_) => !is_blind,
        }
    }
}

/// An agent on the floor.
#[derive(Clone, Copy, PartialEq)]
struct Body<M> {
    mind: M,
    is_done: bool,
}

/// How long an agent scans and goes in a team move, by the paper's means.
fn milliseconds(scan: &Scan, step: Step) -> u64 {
    u64::from(match step {
        Step::Cross(_) => scan_time::step_milliseconds(scan.detected),
        Step::Stay => scan_time::scan_milliseconds(scan.detected),
    })
}

/// A team of agents on a floor.
#[derive(Clone)]
pub struct Agents<K: Crew = Way> {
    way: K,
    floor: SensorFloor<K::Stored>,
    bodies: Vec<Body<K::Mind>>,
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

impl<K: Crew> Agents<K> {
    /// A team in `layout`, an agent in each of `starts`: at most 255, and in free cells. They miss sensors by `chance`,
    /// drawn from `seed`.
    pub fn new(way: K, layout: &Layout, starts: &[Cell], chance: Probability, seed: u64) -> Self {
        let mut floor = SensorFloor::new(layout, starts);
        way.settle(&mut floor, starts);
        let bodies = (0..=u8::MAX).zip(starts).map(|(id, _)| Body { mind: way.mind(id), is_done: false });
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
    pub(super) fn of(setup: &Setup, way: K) -> Self {
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
    pub const fn floor(&self) -> &SensorFloor<K::Stored> {
        &self.floor
    }

    /// How many agents are not done. Ants are never done.
    pub fn active(&self) -> u32 {
        self.sum(|component| component.active.into())
    }

    /// Whether in the last team move an agent was done although it could have got to an unexplored cell.
    pub const fn is_premature(&self) -> bool {
        self.is_premature
    }

    /// How many sensors agents have asked about.
    pub(super) const fn asked(&self) -> u32 {
        self.misses.asked
    }

    /// Makes one team move.
    pub fn advance(&mut self) {
        self.floor.forget_changes();
        self.unseen.clear();
        self.is_premature = false;
        for number in 0..self.bodies.len() {
            self.steps[number] = if self.bodies[number].is_done { Step::Stay } else { self.act(number) };
        }
    }

    /// An agent acts; what it does.
    fn act(&mut self, number: usize) -> Step {
        let (body, cell) = (&mut self.bodies[number], self.cells[number]);
        let view = self.way.look(&self.floor, cell, &mut self.misses);
        let scan = K::scan(&view);
        if !self.misses.is_never() {
            self.unseen.extend(scan.misread(|cell| self.floor.mark(cell), cell));
        }
        let Acted { step, is_done } = self.way.act(&mut self.floor, &mut body.mind, cell, &view);
        if let Step::Cross(side) = step {
            self.cells[number] = cell.beyond(side);
        }
        if is_done {
            body.is_done = true;
            self.is_premature |= self.floor.retire(cell);
        }
        self.milliseconds[number] += milliseconds(scan, step);
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

    /// Whether the run is over: every agent is done or, where some may never know that they are, everything is
    /// explored.
    pub fn is_over(&self) -> bool {
        let may_roam = || self.way.may_roam(!self.misses.chance.is_never());
        self.active() == 0 || self.explored() == self.due() && may_roam()
    }

    /// Whether a run that comes back to where it was goes on for ever: nothing is left to chance.
    fn repeats(&self) -> bool {
        self.way.repeats() && self.misses.chance.is_never()
    }
}

/// Agents that may go round for ever.
struct Watched<K: Crew> {
    team: Agents<K>,
    watch: Option<Watch<K::Mind>>,
}

/// The agents of `setup`, each at its start.
pub(super) fn start<K: Crew>(setup: &Setup, way: K) -> Box<dyn Team> {
    let team = Agents::of(setup, way);
    let watch = team.repeats().then(|| Watch::new(&team));
    Box::new(Watched { team, watch })
}

/// The cells that an agent of `setup` can get to and that are not visited, as `chart` shows.
pub(super) fn missed(setup: &Setup, chart: &Survey) -> Vec<Cell> {
    unvisited(&SensorFloor::<Sensor>::new(&setup.layout, &setup.starts()), chart)
}

/// The cells that an agent can get to and that are not visited, as `chart` shows.
fn unvisited<S: Stored>(floor: &SensorFloor<S>, chart: &Survey) -> Vec<Cell> {
    let due = chart.area().cells().filter(|&cell| floor.component(cell).is_some());
    due.filter(|&cell| !is_visited(chart.mark(cell, u32::MAX))).collect()
}

impl<K: Crew> Team for Watched<K> {
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

    fn broken_at_end(&self, _: &Layout, _: &Survey, _: End) -> Vec<ClauseId> {
        let is_promised = self.team.way.promises(!self.team.misses.is_never());
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

    fn layers(&self) -> Vec<Layer> {
        floor::layers::<K::Stored>()
    }

    fn show(&self, _: &[Cell], scene: &mut Scene) {
        floor::show(&self.team.floor, scene);
    }
}

/// Looks for runs that go on for ever: agents and claims that are as they were, with no mark and no side changed in
/// between, go round (Brent 1980).
struct Watch<M> {
    bodies: Vec<Body<M>>,
    cells: Vec<Cell>,
    claims: Vec<(usize, Claim)>,
    gains: u64,
    /// Team moves since this was noted, and how many there are until the next note.
    moves: u64,
    due: u64,
}

impl<M: Copy + PartialEq> Watch<M> {
    fn new<K: Crew<Mind = M>>(team: &Agents<K>) -> Self {
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
    fn has_come_round<K: Crew<Mind = M>>(&mut self, team: &Agents<K>) -> bool {
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
