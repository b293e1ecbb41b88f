//! The state of a chain, and the two calls that make a team move of it.

use core::fmt;

use super::MAX_ROBOTS;
use super::habit::Habits;
use super::message::{Damaged, Message, Outcome};
use super::plan::{Kind, Plan, mark_occupied, unmark_occupied};
use super::planner::{Looks, Planner};
use super::reel::{Next, Reel, Task, Winder};
use super::rule::{Condition, Pursuit, Rule};
use super::unfold::unfold;
use crate::ground::{Area, Cell, CellMark, Edge, EdgeMark, Grid, Step};

/// Why a chain cannot be set up.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Refused {
    /// A chain is a base and at least one robot.
    TooFewRobots {
        /// Robots asked for, base included.
        robots: usize,
    },
    /// More robots than this chain holds.
    TooManyRobots {
        /// Robots asked for, base included.
        robots: usize,
        /// Robots it holds.
        most: usize,
    },
    /// The base is not in the area.
    BaseOutside {
        /// The base.
        base: Cell,
    },
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewRobots { robots } => {
                write!(f, "{robots} robots are no chain: it needs at least 2, the base counted")
            }
            Self::TooManyRobots { robots, most } => {
                write!(f, "{robots} robots are too many: this chain holds at most {most}, the base counted")
            }
            Self::BaseOutside { base } => write!(f, "the base {base} is outside the area"),
        }
    }
}

impl core::error::Error for Refused {}

/// How a run ended by itself.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum End {
    /// Every cell of the area is explored.
    Explored,
    /// An epoch explored no cell and found no wall; the next would repeat it. With [`Condition::Unfold`] no
    /// unexplored cell is within reach.
    Exhausted,
}

/// What the team is about to do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Intent<const ROBOTS: usize> {
    /// A team move.
    Go(Plan<ROBOTS>),
    /// Nothing any more.
    Done(End),
}

/// What came of a team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Settled<const ROBOTS: usize> {
    messages: [u8; ROBOTS],
    robots: usize,
}

impl<const ROBOTS: usize> Settled<ROBOTS> {
    /// The messages of R_2 … R_N, encoded: what the log grows by.
    pub fn messages(&self) -> &[u8] {
        &self.messages[1..self.robots]
    }
}

/// How far an epoch is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Stage {
    /// The chain is being unfolded towards an unexplored cell, and has not yet explored one or found a wall.
    Unfolding,
    /// It has not yet explored a cell or found a wall.
    Seeking,
    /// It has.
    Gained,
}

/// The part of `whole` that a chain of `robots` can explore from `base`: no cell farther than N−1 columns or rows;
/// `None` if the base is outside.
pub fn area(whole: Area, base: Cell, robots: usize) -> Option<Area> {
    whole.around(base, u16::try_from(robots.saturating_sub(1)).unwrap_or(u16::MAX))
}

/// A chain of at most `ROBOTS` robots that explores a grid.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Chain<G, const ROBOTS: usize> {
    rule: Rule,
    grid: G,
    /// P_1 … P_N; the base first.
    cells: [Cell; ROBOTS],
    robots: usize,
    /// Team moves made.
    moves: u32,
    /// The log entry that a backtrack would take back.
    last_open: Option<u32>,
    /// Epochs that ended.
    epochs: u32,
    stage: Stage,
    /// What the last plan cost.
    looks: Looks,
    /// What the reel is at, if the chain has one.
    reel: Reel<ROBOTS>,
    /// Whether the last plan that was made was not admitted.
    refused: bool,
}

impl<G: Grid, const ROBOTS: usize> Chain<G, ROBOTS> {
    const CAPACITY: () = assert!(ROBOTS <= MAX_ROBOTS, "a chain holds at most 256 robots");

    /// A chain of `robots`, the base counted, all in the `base` cell of a `grid` of which nothing is known but
    /// the border.
    ///
    /// # Errors
    /// [`Refused`] if the number of robots or the base does not fit.
    pub fn new(rule: Rule, robots: usize, base: Cell, mut grid: G) -> Result<Self, Refused> {
        const { Self::CAPACITY };
        if robots < 2 {
            return Err(Refused::TooFewRobots { robots });
        }
        if robots > ROBOTS {
            return Err(Refused::TooManyRobots { robots, most: ROBOTS });
        }
        if !grid.area().contains(base) {
            return Err(Refused::BaseOutside { base });
        }
        grid.put(CellMark::Explored, base);
        Ok(Self {
            rule,
            grid,
            cells: [base; ROBOTS],
            robots,
            moves: 0,
            last_open: None,
            epochs: 0,
            stage: Stage::Gained,
            looks: Looks::new(rule.budget, robots),
            reel: Reel::NONE,
            refused: false,
        })
    }

    /// Where the robots are: R_1, the base, to R_N, the leader.
    pub fn cells(&self) -> &[Cell] {
        &self.cells[..self.robots]
    }

    /// What the team knows.
    pub const fn grid(&self) -> &G {
        &self.grid
    }

    /// The rule it follows.
    pub const fn rule(&self) -> &Rule {
        &self.rule
    }

    /// How many candidates of followers the last call of [`Chain::plan`] looked at: see [`Budget`](super::Budget).
    pub const fn looked_at(&self) -> u32 {
        self.looks.used()
    }

    /// Whether the last call of [`Chain::plan`] used up its budget, and may have planned otherwise for it.
    pub const fn is_cut_short(&self) -> bool {
        self.looks.is_over()
    }

    /// The log entry that a backtrack would take back, if any: entries count team moves from 0.
    pub const fn last_open(&self) -> Option<u32> {
        self.last_open
    }

    /// How many epochs ended so far: how often nothing was left to take back and the virtual obstacles were
    /// cleared.
    pub const fn epochs(&self) -> u32 {
        self.epochs
    }

    /// Whether the present epoch has explored a cell or found a wall; the first counts its start as a gain.
    pub const fn gained(&self) -> bool {
        matches!(self.stage, Stage::Gained)
    }

    /// Whether the chain is being unfolded: see [`Condition::Unfold`]. Over as soon as the epoch gains.
    pub const fn is_unfolding(&self) -> bool {
        matches!(self.stage, Stage::Unfolding)
    }

    /// Whether the last call of [`Chain::plan`] made a plan that [`Rule::admits_plan`] refused, and returned the null move in
    /// its place.
    pub const fn is_refused(&self) -> bool {
        self.refused
    }

    /// Team moves until what the reel has begun and rehearsed explores a cell, unless it meets a wall before: the next one
    /// is among them. `None` if the chain is at nothing that was rehearsed.
    pub const fn until_gain(&self) -> Option<u32> {
        match self.reel.task {
            Task::None | Task::TakeBack => None,
            Task::Approach { .. } | Task::DrawIn { .. } | Task::LetOut => Some(self.reel.left),
        }
    }

    /// What falls lexicographically from one team move of the reel to the next, as long as nothing is gained (CHAIN-17).
    pub fn measure(&self) -> [u32; 3] {
        self.reel.measure()
    }

    /// Whether it is where the `other` chain is, knows as much, and is at the same.
    pub fn is_where(&self, other: &Self) -> bool
    where
        G: PartialEq,
    {
        self.cells() == other.cells()
            && (self.stage, self.reel) == (other.stage, other.reel)
            && self.grid == other.grid
    }

    /// What the team intends. `log` holds the messages of all team moves so far, as [`Settled::messages`]
    /// gave them.
    ///
    /// The log is not trusted: a backtrack goes over sides that are known to be open, and ends where neighbours are in
    /// contact and no three robots in one cell. So a log that was changed may lead elsewhere than the true one, but never
    /// against CHAIN-1, CHAIN-2 and CHAIN-3.
    ///
    /// # Errors
    /// [`Damaged`] if a backtrack needs the log, and it is not as long as the run, a byte needed is no message, or the
    /// messages are of a move that the team cannot have made.
    pub fn plan(&mut self, log: &[u8]) -> Result<Intent<ROBOTS>, Damaged> {
        self.looks = Looks::new(self.rule.budget, self.robots);
        self.refused = false;
        if self.grid.is_explored() {
            return Ok(Intent::Done(End::Explored));
        }
        match self.rule.pursuit {
            Pursuit::Epochs => self.plan_by_epochs(log),
            Pursuit::Reel(habits) => self.plan_by_reel(log, habits),
        }
    }

    /// The paper's plan: the leader's, or a backtrack, or both in a new epoch.
    fn plan_by_epochs(&mut self, log: &[u8]) -> Result<Intent<ROBOTS>, Damaged> {
        let mut fresh_epoch = false;
        loop {
            if self.is_unfolding()
                && let Some(steps) = unfold(&mut self.grid, &self.cells[..self.robots])
            {
                return Ok(Intent::Go(self.advance(steps)));
            }
            let team = &self.cells[..self.robots];
            let (steps, looks) =
                Planner::<G, ROBOTS>::new(&self.rule, &mut self.grid, team, self.looks).make();
            self.looks = looks;
            if let Some(steps) = steps {
                return Ok(Intent::Go(self.advance(steps)));
            }
            if let Some(entry) = self.last_open {
                return self.backtrack(log, entry).map(Intent::Go);
            }
            let gainless = !self.gained() && self.rule.has(Condition::EpochMustGain);
            let unfolds = !fresh_epoch && self.has_target();
            if fresh_epoch || (gainless && !unfolds) {
                return Ok(Intent::Done(End::Exhausted));
            }
            fresh_epoch = true;
            self.epochs += 1;
            self.stage = if unfolds { Stage::Unfolding } else { Stage::Seeking };
            self.grid.clear_edges(EdgeMark::Virtual);
        }
    }

    /// The reel's plan: see the module `reel`.
    fn plan_by_reel(&mut self, log: &[u8], habits: Habits) -> Result<Intent<ROBOTS>, Damaged> {
        if self.gained() {
            self.stage = Stage::Seeking;
            self.reel = Reel::NONE;
        }
        let team = &self.cells[..self.robots];
        let (steps, looks) = Planner::<G, ROBOTS>::new(&self.rule, &mut self.grid, team, self.looks).touch();
        self.looks = looks;
        if let Some(steps) = steps {
            self.reel = Reel::NONE;
            return Ok(Intent::Go(self.advance(steps)));
        }
        let mut winder = Winder::<G, ROBOTS> { rule: &self.rule, habits, grid: &mut self.grid, team };
        let (next, reel) = winder.wind(self.reel, self.last_open.is_some());
        self.reel = reel;
        match (next, self.last_open) {
            (Next::Go(steps), _) => Ok(Intent::Go(self.advance(steps))),
            (Next::TakeBack, Some(entry)) => self.backtrack(log, entry).map(Intent::Go),
            (Next::TakeBack | Next::Done, _) => Ok(Intent::Done(End::Exhausted)),
        }
    }

    /// Whether there is an unexplored cell to unfold the chain towards.
    fn has_target(&mut self) -> bool {
        let mut stops = self.cells;
        self.rule.has(Condition::Unfold)
            && self.grid.stops(self.cells[0], &mut stops[..self.robots]).is_some()
    }

    /// The plan that makes these `steps`, if they are admitted; else the null move.
    fn advance(&mut self, steps: [Step; ROBOTS]) -> Plan<ROBOTS> {
        let team = &self.cells[..self.robots];
        self.refused = !self.rule.admits_plan(&mut self.grid, team, &steps[..self.robots]);
        let steps = if self.refused { [Step::Stay; ROBOTS] } else { steps };
        Plan { kind: Kind::Advance, steps, robots: self.robots, last_open: Some(self.moves) }
    }

    /// The plan that takes log entry `entry` back.
    fn backtrack(&mut self, log: &[u8], entry: u32) -> Result<Plan<ROBOTS>, Damaged> {
        let movers = self.robots - 1;
        let sent = self.moves as usize * movers;
        if log.len() != sent {
            return Err(Damaged::Length { bytes: log.len(), sent });
        }
        let first = entry as usize * movers;
        let messages = log.get(first..first + movers).unwrap_or(&[]);
        let mut steps = [Step::Stay; ROBOTS];
        let mut cells = self.cells;
        for (robot, &byte) in (1..).zip(messages) {
            let message = Message::decode(byte)?;
            if message.outcome == Outcome::TookBack {
                return Err(Damaged::TakenBack { robot: robot + 1 });
            }
            let back = message.made().reverse();
            let met = match (message.outcome, message.step, back) {
                (Outcome::Blocked, Step::Cross(side), _) => Some((side, EdgeMark::Wall)),
                (_, _, Step::Cross(side)) => Some((side, EdgeMark::Open)),
                (_, _, Step::Stay) => None,
            };
            if met.is_some_and(|(side, mark)| !self.grid.edge_has(mark, Edge::new(cells[robot], side))) {
                return Err(Damaged::OtherWorld { robot: robot + 1 });
            }
            steps[robot] = back;
            cells[robot] = cells[robot].after(back);
            if !self.rule.keeps_contact(cells[robot - 1], cells[robot]) {
                return Err(Damaged::OutOfContact { robot: robot + 1 });
            }
        }
        let team = &cells[..self.robots];
        if self.rule.keeps_apart() {
            let is_crowded = mark_occupied(&mut self.grid, team.iter().copied(), cells[0]);
            unmark_occupied(&mut self.grid, team.iter().copied());
            if is_crowded {
                return Err(Damaged::Crowded);
            }
        }
        // Read backwards, every backtrack pairs with the nearest open move before it.
        let mut taken_back = 0_u32;
        let mut last_open = None;
        for index in (0..entry).rev() {
            if log.get(index as usize * movers).is_some_and(|&byte| Message::is_backtrack(byte)) {
                taken_back += 1;
            } else if taken_back == 0 {
                last_open = Some(index);
                break;
            } else {
                taken_back -= 1;
            }
        }
        if last_open.is_none()
            && let Some(robot) = team.iter().position(|&cell| cell != cells[0])
        {
            return Err(Damaged::NotHome { robot: robot + 1 });
        }
        Ok(Plan { kind: Kind::Backtrack, steps, robots: self.robots, last_open })
    }

    /// Carries `plan` out. `is_open` answers for every edge that is crossed without being known, once each, in
    /// the order of the robots. All robots move at once; one that meets a wall stays, and all learn of it.
    pub fn settle(&mut self, plan: &Plan<ROBOTS>, mut is_open: impl FnMut(Edge) -> bool) -> Settled<ROBOTS> {
        let mut messages = [0; ROBOTS];
        let movers = 1..self.robots.min(ROBOTS);
        let team = messages[movers.clone()].iter_mut().zip(&mut self.cells[movers.clone()]);
        for ((sent, cell), &step) in team.zip(&plan.steps[movers]) {
            let outcome = match (plan.kind, step) {
                (Kind::Backtrack, _) => Outcome::TookBack,
                (Kind::Advance, Step::Stay) => Outcome::Arrived,
                (Kind::Advance, Step::Cross(side)) => {
                    try_edge(&mut self.grid, &mut self.stage, Edge::new(*cell, side), &mut is_open)
                }
            };
            let message = Message { step, outcome };
            *sent = message.encode();
            *cell = cell.after(message.made());
            if !self.grid.has(CellMark::Explored, *cell) {
                self.grid.put(CellMark::Explored, *cell);
                self.stage = Stage::Gained;
            }
        }
        self.moves += 1;
        self.last_open = plan.last_open;
        if !self.gained() {
            self.reel.went_on(self.cells[self.robots - 1]);
        }
        Settled { messages, robots: self.robots }
    }

    /// Carries `plan` out as one who plans along and hears of the rest: `messages` are those of R_2 … R_N about this team
    /// move, one byte each. Afterwards the chain is what [`Chain::settle`] makes of the team that sent them.
    ///
    /// # Errors
    /// [`Damaged`] if they cannot be about this plan and this world; then nothing has changed.
    pub fn hear(&mut self, plan: &Plan<ROBOTS>, messages: &[u8]) -> Result<(), Damaged> {
        let movers = self.robots - 1;
        if messages.len() != movers {
            return Err(Damaged::Length { bytes: messages.len(), sent: movers });
        }
        let edge = |robot: usize| match plan.steps[robot] {
            Step::Cross(side) => Some(Edge::new(self.cells[robot], side)),
            Step::Stay => None,
        };
        let mut outcomes = [Outcome::Arrived; ROBOTS];
        for (robot, &byte) in (1..).zip(messages) {
            let Message { step, outcome } = Message::decode(byte)?;
            let is_back = outcome == Outcome::TookBack;
            if step != plan.steps[robot] || is_back != (plan.kind == Kind::Backtrack) {
                return Err(Damaged::OtherStep { robot: robot + 1 });
            }
            outcomes[robot] = outcome;
            let Some(crossed) = edge(robot).filter(|_| !is_back) else { continue };
            let known = if self.grid.edge_has(EdgeMark::Open, crossed) {
                Some(Outcome::Arrived)
            } else if self.grid.edge_has(EdgeMark::Wall, crossed) {
                Some(Outcome::Blocked)
            } else {
                (1..robot).find(|&other| edge(other) == Some(crossed)).map(|other| outcomes[other])
            };
            if known.is_some_and(|known| known != outcome) {
                return Err(Damaged::OtherWorld { robot: robot + 1 });
            }
        }
        let crossed: [Option<Edge>; ROBOTS] =
            core::array::from_fn(|robot| (robot < self.robots).then(|| edge(robot)).flatten());
        self.settle(plan, |asked| {
            let first = (1..ROBOTS).find(|&robot| crossed[robot] == Some(asked));
            first.is_some_and(|robot| outcomes[robot] == Outcome::Arrived)
        });
        Ok(())
    }
}

/// What comes of crossing `edge`.
fn try_edge(
    grid: &mut impl Grid,
    stage: &mut Stage,
    edge: Edge,
    is_open: &mut impl FnMut(Edge) -> bool,
) -> Outcome {
    if grid.edge_has(EdgeMark::Open, edge) {
        return Outcome::Arrived;
    }
    if grid.edge_has(EdgeMark::Wall, edge) {
        return Outcome::Blocked;
    }
    if is_open(edge) {
        grid.put_edge(EdgeMark::Open, edge);
        Outcome::Arrived
    } else {
        grid.put_edge(EdgeMark::Wall, edge);
        *stage = Stage::Gained;
        Outcome::Blocked
    }
}
