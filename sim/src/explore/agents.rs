//! A team of agents on a sensor floor [Ferranti 2009], whichever way they decide, and what is the same in all their
//! rows. In a team move every agent that is not done acts once, in the order of the agents' ids.
//!
//! Missed sensors are drawn from `ChaCha8`, seeded with the seed of the run as layouts are, with the tag `miss`: one
//! draw for each sensor that is asked about, agent by agent, clockwise from the northern neighbour. Where the
//! probability is 0 nothing is drawn. A counterexample has the sensors that are missed written down: by their numbers
//! among all that are asked about.

use std::collections::{BTreeMap, VecDeque};

use tautline_kernel::chain::Kind;
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Claim, Mark, Scan};
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_proofs::floor::crew::{Body, BodyOf, Scheme, SensorData, Sight, unseen};
use tautline_proofs::judge::floor::{self as judge, JudgeInput, Judgement, Turn};
use tautline_proofs::judge::{Case, Place};
use tautline_proofs::run::{Frame, place, sides};

use super::clause::broken;
use super::floor::{self, Component, SensorFloor, is_visited};
use super::scan_time::{TRAVEL_MILLISECONDS, scan_milliseconds};
use super::{
    By, ClauseId, Completeness, End, Layer, Look, Profile, RandomPart, Scene, Senses, Setup, Surroundings,
    Survey, Team,
};
use tautline_grids::chance::{Dice, Probability};
use tautline_grids::layout::Layout;

/// The most agents on a floor: a sensor keeps an id in eight bits, and counts agents in as many.
const MAX_AGENTS: usize = 255;

/// The row of all agents, of which theirs are made.
pub(super) const AGENTS: Profile = Profile {
    robots: 1..=MAX_AGENTS,
    senses: Senses::Floor,
    told: Completeness::All,
    drawn: &[RandomPart { what: "which sensors are missed", by: By::Miss }],
    look: Look::Apart,
    ..Profile::named("")
};

/// An agent is done, and a cell that it could get to is unexplored.
pub const PREMATURE: ClauseId = ClauseId::new("BRICKS-4");

/// The agents go round for ever, and a cell that one could get to is unexplored.
pub const UNEXPLORED: ClauseId = ClauseId::new("BRICKS-5");

/// The run has ended, or goes on for ever, and a cell that an agent could get to is not visited.
pub const UNVISITED: ClauseId = ClauseId::new("BRICKS-6");

/// The sensors that are missed: by chance, or as it is written down.
#[derive(Clone)]
struct Misses {
    chance: Probability,
    dice: Dice,
    /// The numbers of the questions, counted from 1, that are answered yes; in order. Those that
    /// are drawn come to them.
    written: Vec<u32>,
    asked: u32,
}

impl Misses {
    /// Whether sensors are ever missed.
    fn sight(&self) -> Sight {
        if self.written.is_empty() { self.sight_by_chance() } else { Sight::Partial }
    }

    /// Whether sensors are missed by chance.
    fn sight_by_chance(&self) -> Sight {
        if self.chance.is_never() { Sight::Whole } else { Sight::Partial }
    }

    /// Whether no sensor is missed from now on.
    fn is_over(&self) -> bool {
        self.chance.is_never() && self.written.last().is_none_or(|&last| last <= self.asked)
    }
}

impl Oracle for Misses {
    fn pick(&mut self, below: u32) -> u32 {
        self.dice.pick(below)
    }

    fn mishap(&mut self) -> bool {
        self.asked = self.asked.saturating_add(1);
        let is_drawn = !self.chance.is_never() && self.chance.happens(&mut self.dice);
        // What is drawn comes last, but for what is named for later.
        let is_last = self.written.last() < Some(&self.asked);
        let place = if is_last { Err(self.written.len()) } else { self.written.binary_search(&self.asked) };
        if let (true, Err(place)) = (is_drawn, place) {
            self.written.insert(place, self.asked);
        }
        is_drawn || place.is_ok()
    }
}

/// How long an agent scans and goes in a team move, by the paper's means.
fn milliseconds(scan: &Scan, step: Step) -> u64 {
    let way = if step == Step::Stay { 0 } else { TRAVEL_MILLISECONDS };
    u64::from(scan_milliseconds(scan.detected) + way)
}

/// A team of agents on a floor.
#[derive(Clone)]
pub struct Agents<S: Scheme> {
    scheme: S,
    floor: SensorFloor<S::Sensor>,
    bodies: Vec<BodyOf<S>>,
    cells: Vec<Cell>,
    /// The step of each agent in the last team move.
    steps: Vec<Step>,
    /// Whether in the last team move an agent was done although another cell was unexplored or left to go through.
    is_premature: bool,
    /// How long each agent has scanned and gone.
    milliseconds: Vec<u64>,
    misses: Misses,
    /// The cells of the sensors that were missed in the last team move.
    unseen: Vec<Cell>,
}

impl<S: Scheme> Agents<S> {
    /// A team in `layout`, an agent in each of `starts`: at most 255, and in free cells. They miss sensors by `chance`,
    /// drawn from `seed`.
    pub fn new(scheme: S, layout: &Layout, starts: &[Cell], chance: Probability, seed: u64) -> Self {
        let mut floor = SensorFloor::new(layout, starts);
        S::Sensor::settle(&mut floor, starts);
        Self {
            scheme,
            floor,
            bodies: Body::crew(&scheme, starts),
            cells: starts.to_vec(),
            steps: vec![Step::Stay; starts.len()],
            is_premature: false,
            milliseconds: vec![0; starts.len()],
            misses: Misses { chance, dice: Dice::new(seed, *b"miss    "), written: Vec::new(), asked: 0 },
            unseen: Vec::new(),
        }
    }

    /// Where the agents are.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The step of each agent in the last team move.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The cells that agents can get to, and what has become of them. Ants are never done.
    pub fn whole(&self) -> Component {
        Component::whole(&self.floor.components)
    }

    /// Whether in the last team move an agent was done although another cell was unexplored or left to go through.
    pub const fn is_premature(&self) -> bool {
        self.is_premature
    }

    /// Makes one team move: agents act in the order of their ids.
    pub fn advance(&mut self) {
        self.advance_in(&mut |_: Edge| true);
    }

    /// Makes one team move, in which `world` says who acts next and which sensors are missed; whether it has said
    /// anything else than usual.
    fn advance_in(&mut self, world: &mut dyn Surroundings) -> bool {
        self.floor.forget_changes();
        self.unseen.clear();
        self.is_premature = false;
        self.steps.fill(Step::Stay);
        let mut left: VecDeque<usize> =
            (0..self.bodies.len()).filter(|&number| !self.bodies[number].is_done).collect();
        let mut is_decided = false;
        while !left.is_empty() {
            let place = if left.len() > 1 {
                let name = |number: &usize| format!("agent {}", number + 1);
                world.choose("Which agent acts next?", &mut || left.iter().map(name).collect(), 0) as usize
            } else {
                0
            };
            let Some(number) = left.remove(place.min(left.len() - 1)) else { break };
            is_decided |= place > 0 || self.loses_sight(number, world);
            self.steps[number] = self.act(number);
        }
        is_decided
    }

    /// Asks which sensors an agent misses next, one after the other; whether it misses any.
    fn loses_sight(&mut self, number: usize, world: &mut dyn Surroundings) -> bool {
        let (asked, mut next) = (self.misses.asked, 0);
        let words = format!("Which sensor does agent {} miss?", number + 1);
        loop {
            let mut options = || {
                let sensors = self.sensors(number).into_iter().skip(next as usize);
                let missed = sensors.map(|cell| format!("that of {cell}"));
                let none = if next == 0 { "none" } else { "no other one" };
                std::iter::once(none.to_owned()).chain(missed).collect()
            };
            let sensor = world.choose(&words, &mut options, 0);
            if sensor == 0 {
                return next > 0;
            }
            next += sensor;
            let written = &mut self.misses.written;
            if let Err(place) = written.binary_search(&(asked + next)) {
                written.insert(place, asked + next);
            }
        }
    }

    /// Makes the turn of an agent; returns its step.
    fn act(&mut self, number: usize) -> Step {
        let (body, cell) = (&mut self.bodies[number], self.cells[number]);
        let view = S::Sensor::look(&self.floor, cell, &mut self.misses);
        if self.misses.sight() == Sight::Partial {
            self.unseen.extend(unseen(&self.floor, &view, cell));
        }
        let act = self.scheme.decide(&mut body.memory, &view);
        let step = body.carry_out(&self.scheme, &mut self.floor, &act);
        self.cells[number] = body.cell;
        if body.is_done {
            self.is_premature |= self.floor.retire(cell, |mark| self.scheme.is_left(mark));
        }
        self.milliseconds[number] += milliseconds(S::Sensor::scan(&view), step);
        step
    }

    /// The cells of the sensors that an agent asks about next, in order.
    fn sensors(&self, number: usize) -> Vec<Cell> {
        let cell = self.cells[number];
        let look = |written: Vec<u32>| {
            let dice = self.misses.dice.clone();
            let mut misses = Misses { chance: Probability::NEVER, dice, written, asked: 0 };
            let view = S::Sensor::look(&self.floor, cell, &mut misses);
            let missed = unseen(&self.floor, &view, cell).next();
            (misses.asked, missed)
        };
        (1..=look(Vec::new()).0).map(|question| look(vec![question]).1.unwrap_or(cell)).collect()
    }

    /// How long the slowest agent has scanned and gone.
    pub fn milliseconds(&self) -> u64 {
        self.milliseconds.iter().copied().max().unwrap_or(0)
    }

    /// Whether the run is over: every agent is done or, where some may never know that they are, everything is
    /// explored.
    pub fn is_over(&self) -> bool {
        let may_roam = || self.scheme.may_roam(self.misses.sight_by_chance());
        let whole = self.whole();
        whole.active == 0 || whole.explored == whole.cells && may_roam()
    }
}

/// Agents that may go round for ever.
struct Patrol<S: Scheme> {
    team: Agents<S>,
    /// If a team that comes back to where it was goes on for ever: nothing is left to chance.
    watch: Option<Watch<S>>,
    /// The most cells that were visited, and the team moves since they were, with everything explored.
    still: (u32, u64),
}

/// Team moves for each cell in which no more are visited, with everything explored, before a run is idle.
const MOST_STILL: u64 = 1000;

/// The agents of `setup`, each at its start.
pub(super) fn start<S: Scheme>(setup: &Setup, scheme: S) -> Box<dyn Team> {
    let mut team = Agents::new(scheme, &setup.layout, &setup.starts(), setup.miss, setup.seed);
    team.misses.written.clone_from(&setup.missed);
    let watch = setup.miss.is_never().then(|| Watch::new(&team));
    Box::new(Patrol { team, watch, still: (0, 0) })
}

/// The cells of `layout` that agents can get to from `starts` and that are not visited, as `chart` shows.
pub(super) fn unvisited(layout: &Layout, starts: &[Cell], chart: &Survey) -> Vec<Cell> {
    let due = layout.reachable(starts).into_iter();
    due.filter(|&cell| !is_visited(chart.mark(cell, u32::MAX))).collect()
}

impl<S: Scheme> Team for Patrol<S> {
    fn cells(&self) -> &[Cell] {
        self.team.cells()
    }

    fn advance(&mut self, world: &mut dyn Surroundings) -> Result<Frame, End> {
        let whole = self.team.whole();
        let is_explored = whole.explored == whole.cells;
        if self.team.is_over() {
            return Err(if is_explored { End::Explored } else { End::Exhausted });
        }
        if self.watch.as_mut().is_some_and(|watch| watch.has_come_round(&self.team)) {
            return Err(End::Endless);
        }
        let (most, moves) = self.still;
        self.still =
            if is_explored && whole.visited <= most { (most, moves + 1) } else { (whole.visited, 0) };
        if self.still.1 > MOST_STILL * u64::from(whole.cells) {
            return Err(End::Idle);
        }
        // A team that somebody decides about may come back to where it was and go on in another way.
        if self.team.advance_in(world) {
            self.watch = None;
        }
        let (steps, cells) = (self.team.steps.clone(), self.team.cells.clone());
        Ok(Frame { kind: Kind::Advance, blocked: vec![false; steps.len()], steps, cells })
    }

    fn due(&self, _: &Layout) -> u32 {
        self.team.whole().cells
    }

    fn missed(&self, layout: &Layout, chart: &Survey) -> Vec<Cell> {
        unvisited(layout, &self.team.cells, chart)
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        if self.team.is_premature { vec![PREMATURE] } else { Vec::new() }
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        let Component { cells, explored, visited, .. } = self.team.whole();
        let is_unexplored = end == End::Endless && explored < cells;
        let is_promised = self.team.scheme.promises(self.team.misses.sight());
        let is_unvisited = is_promised && end != End::Idle && visited < cells;
        broken([(is_unvisited, UNVISITED), (is_unexplored, UNEXPLORED)])
    }

    /// Where marks decide, there is no judge; nor does it know which of several agents was done too early.
    fn case(&mut self, layout: &Layout, clause: ClauseId) -> Option<Box<dyn Case>> {
        let starts: Vec<Place> = self.team.cells.iter().copied().map(place).collect();
        (clause != PREMATURE || starts.len() == 1).then_some(())?;
        let mut turns = Vec::new();
        let end = loop {
            let acting: Vec<bool> = self.team.bodies.iter().map(|body| !body.is_done).collect();
            if let Err(end) = self.advance(&mut |edge: Edge| layout.is_open(edge)) {
                break end;
            }
            for (agent, body) in self.team.bodies.iter().enumerate().filter(|(agent, _)| acting[*agent]) {
                turns.push(Turn { agent, to: place(body.cell), is_done: body.is_done });
            }
        };
        let awake = self.team.bodies.iter().filter(|body| !body.is_done).count();
        let round = if end == End::Endless { self.watch.as_ref()?.moves as usize * awake } else { 0 };
        let size = (layout.width().into(), layout.height().into());
        let run = JudgeInput {
            walls: layout.walls().map(sides).collect(),
            blocked: layout.cells().filter(|&cell| !layout.is_free(cell)).map(place).collect(),
            round,
            ..JudgeInput::open(clause.as_str(), size, starts, turns)
        };
        let is_read = (awake == 0 || round > 0) && judge::judge(&run) != Ok(Judgement::Unseen);
        is_read.then(|| Box::new(run) as Box<dyn Case>)
    }

    fn misses(&self) -> &[u32] {
        &self.team.misses.written
    }

    fn marked(&self) -> &[(Cell, Mark)] {
        &self.team.floor.marked
    }

    fn unseen(&self) -> &[Cell] {
        &self.team.unseen
    }

    fn components(&self) -> &[Component] {
        &self.team.floor.components
    }

    fn milliseconds(&self) -> Option<u64> {
        Some(self.team.milliseconds())
    }

    fn layers(&self) -> Vec<Layer> {
        floor::layers::<S::Sensor>()
    }

    fn show(&self, _: &[Cell], scene: &mut Scene) {
        floor::show(&self.team.floor, scene);
    }
}

/// Looks for runs that go on for ever: agents and claims that are as they were, with no mark and no side changed in
/// between, go round (Brent 1980); agents that read crossings do on a floor that is alike.
struct Watch<S: Scheme> {
    bodies: Vec<BodyOf<S>>,
    claims: BTreeMap<usize, Claim>,
    gains: u64,
    /// The floor, if agents read its crossings.
    floor: Option<SensorFloor<S::Sensor>>,
    /// Team moves since this was noted, and how many there are until the next note.
    moves: u64,
    due: u64,
}

impl<S: Scheme> Watch<S> {
    fn new(team: &Agents<S>) -> Self {
        Self {
            bodies: team.bodies.clone(),
            claims: team.floor.claims.clone(),
            gains: team.floor.gains,
            floor: None,
            moves: 0,
            due: if Self::reads_crossings(team) { team.whole().cells.into() } else { 1 },
        }
    }

    fn reads_crossings(team: &Agents<S>) -> bool {
        team.scheme.reads_crossings(Sight::Partial)
    }

    /// Whether the team, which has made a team move since the last call, is where it was.
    fn has_come_round(&mut self, team: &Agents<S>) -> bool {
        if self.gains != team.floor.gains || !team.misses.is_over() {
            *self = Self { moves: 1, ..Self::new(team) };
            return false;
        }
        let is_alike = || match &self.floor {
            Some(then) => team.floor.is_alike(then, |mark| team.scheme.passes(mark)),
            None => !Self::reads_crossings(team),
        };
        if self.moves > 0 && self.bodies == team.bodies && self.claims == team.floor.claims && is_alike() {
            return true;
        }
        if self.moves == self.due {
            let floor = Self::reads_crossings(team).then(|| team.floor.clone());
            *self = Self { due: 2 * self.due, floor, ..Self::new(team) };
        }
        self.moves += 1;
        false
    }
}
