//! The state of a chain, and the two calls that make a team move of it.

use super::MAX_ROBOTS;
use super::admission::are_distinct;
use super::habit::Habits;
use super::message::{Damage, Message, Outcome};
use super::past::Past;
use super::plan::{Kind, Plan, mark_occupied, unmark_occupied};
use super::planner::{Looks, Planner};
use super::reel::{Next, Reel, Task, Winder};
use super::rule::{Condition, Pursuit, Rule};
use super::unfold::unfold;
use crate::error::sentences;
use crate::ground::{Area, Cell, CellMark, Edge, EdgeMark, Grid, Step};

/// Why a chain cannot be set up.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SetupError {
    /// So many robots, the base counted: a chain is a base and at least one robot.
    TooFewRobots(usize),
    /// More robots than this chain holds.
    TooManyRobots {
        /// Robots asked for, base included.
        robots: usize,
        /// Robots it holds.
        most: usize,
    },
    /// The base is not in the area.
    BaseOutside(Cell),
}

sentences!(SetupError {
    Self::TooFewRobots(robots) => "{robots} robots are no chain: it needs at least 2, the base counted";
    Self::TooManyRobots { robots, most } =>
        "{robots} robots are too many: this chain holds at most {most}, the base counted";
    Self::BaseOutside(base) => "the base {base} is outside the area";
});

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

/// A team's intended team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Intent<const ROBOTS: usize> {
    /// A team move.
    Go(Plan<ROBOTS>),
    /// Nothing any more.
    Done(End),
}

/// The outcome of a team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct MoveOutcome<const ROBOTS: usize> {
    pub(super) messages: [u8; ROBOTS],
    pub(super) robots: usize,
}

impl<const ROBOTS: usize> MoveOutcome<ROBOTS> {
    /// The messages of R_2 … R_N, encoded: what the log grows by.
    pub fn messages(&self) -> &[u8] {
        &self.messages[1..self.robots]
    }
}

/// How far an epoch is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Stage {
    /// The chain is being unfolded towards an unexplored cell, and has not yet explored one or found a wall.
    Unfolding,
    /// It has not yet explored a cell or found a wall.
    Seeking,
    /// It has.
    Gained,
}

/// Whether walls stand for ever.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Walls {
    /// A side that was crossed stays open: the paper's.
    Lasting,
    /// A wall may appear where a robot has crossed.
    Changing,
}

/// The part of `whole` that a chain of `robots` can explore from `base`: no cell farther than N−1 columns or rows;
/// `None` if the base is outside.
pub fn area(whole: Area, base: Cell, robots: usize) -> Option<Area> {
    whole.around(base, u16::try_from(robots.saturating_sub(1)).unwrap_or(u16::MAX))
}

/// A chain of at most `ROBOTS` robots that explores a grid.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Chain<G, const ROBOTS: usize> {
    pub(super) rule: Rule,
    pub(super) grid: G,
    /// P_1 … P_N; the base first.
    pub(super) cells: [Cell; ROBOTS],
    pub(super) robots: usize,
    /// Team moves made.
    pub(super) moves: u32,
    /// The log entry that a backtrack would take back.
    pub(super) last_open: Option<u32>,
    /// Epochs that ended.
    pub(super) epochs: u32,
    pub(super) stage: Stage,
    /// The cost of the last plan.
    pub(super) looks: Looks,
    /// The reel's memory, if the chain has a reel.
    pub(super) reel: Reel<ROBOTS>,
    /// Whether the last plan that was made was not admitted.
    pub(super) refused: bool,
    /// Where the history begins.
    pub(super) past: Past,
    /// Whether walls stand for ever.
    pub(super) walls: Walls,
}

impl<G: Grid, const ROBOTS: usize> Chain<G, ROBOTS> {
    /// A chain of `robots`, the base counted, all in the `base` cell of a `grid` of which nothing is known but
    /// the border.
    ///
    /// # Errors
    /// [`SetupError`] if the number of robots or the base does not fit.
    pub fn new(rule: Rule, robots: usize, base: Cell, mut grid: G) -> Result<Self, SetupError> {
        const { assert!(ROBOTS <= MAX_ROBOTS, "a chain holds at most 256 robots") };
        if robots < 2 {
            return Err(SetupError::TooFewRobots(robots));
        }
        if robots > ROBOTS {
            return Err(SetupError::TooManyRobots { robots, most: ROBOTS });
        }
        if !grid.area().contains(base) {
            return Err(SetupError::BaseOutside(base));
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
            past: Past::Home,
            walls: Walls::Lasting,
        })
    }

    /// Where the robots are: R_1, the base, to R_N, the leader.
    pub fn cells(&self) -> &[Cell] {
        &self.cells[..self.robots]
    }

    /// The map that the team knows.
    pub const fn grid(&self) -> &G {
        &self.grid
    }

    /// The rule it follows.
    pub const fn rule(&self) -> &Rule {
        &self.rule
    }

    /// How many candidates of followers the last call of [`Chain::plan`] looked at: see [`Budget`](super::Budget).
    pub const fn looked_at(&self) -> u32 {
        self.looks.used
    }

    /// Whether the last call of [`Chain::plan`] used up its budget, and may have planned otherwise for it.
    pub const fn is_cut_short(&self) -> bool {
        self.looks.is_over
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

    /// Whether the last call of [`Chain::plan`] made a plan that [`Rule::admits_plan`] refused, and returned the null
    /// move in its place.
    pub const fn is_refused(&self) -> bool {
        self.refused
    }

    /// Team moves until what the reel has begun and rehearsed explores a cell, unless it meets a wall before: the next
    /// one is among them. `None` if the chain is at nothing that was rehearsed.
    pub const fn until_gain(&self) -> Option<u32> {
        match self.reel.task {
            Task::None | Task::TakeBack => None,
            Task::Approach { .. } | Task::DrawIn { .. } | Task::LetOut => Some(self.reel.left),
        }
    }

    /// Three numbers that fall lexicographically from one team move of the reel to the next, as long as nothing is
    /// gained (CHAIN-17).
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

    /// The team's intended move. `log` holds the messages of all team moves so
    /// far, as [`MoveOutcome::messages`] gave them.
    ///
    /// The log is not trusted: a backtrack goes over sides that are known to be open, and ends where neighbours are in
    /// contact and no three robots in one cell. So a log that was changed may lead elsewhere than the true one, but
    /// never against CHAIN-1, CHAIN-2 and CHAIN-3.
    ///
    /// # Errors
    /// [`Damage`] if a backtrack needs the log, and it is not as long as the run, a byte needed is no message, or the
    /// messages are of a move that the team cannot have made.
    pub fn plan(&mut self, log: &[u8]) -> Result<Intent<ROBOTS>, Damage> {
        self.looks = Looks::new(self.rule.budget, self.robots);
        self.refused = false;
        if self.grid.is_explored() {
            return Ok(Intent::Done(End::Explored));
        }
        self.forget_what_is_shut(log);
        match self.rule.pursuit {
            Pursuit::Epochs => self.plan_by_epochs(log),
            Pursuit::Reel(habits) => self.plan_by_reel(log, habits),
        }
    }

    /// The paper's plan: the leader's, or a backtrack, or both in a new epoch.
    fn plan_by_epochs(&mut self, log: &[u8]) -> Result<Intent<ROBOTS>, Damage> {
        for is_fresh in [false, true] {
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
            let unfolds = !is_fresh && self.has_target();
            if is_fresh || (gainless && !unfolds) {
                break;
            }
            self.epochs += 1;
            self.stage = if unfolds { Stage::Unfolding } else { Stage::Seeking };
            self.grid.clear_edges(EdgeMark::Virtual);
        }
        Ok(Intent::Done(End::Exhausted))
    }

    /// The reel's plan: see the module `reel`.
    fn plan_by_reel(&mut self, log: &[u8], habits: Habits) -> Result<Intent<ROBOTS>, Damage> {
        if self.gained() {
            self.stage = Stage::Seeking;
            self.reel = Reel::NONE;
        }
        let team = &self.cells[..self.robots];
        if let Some(entry) = self.last_open
            && self.rule.has(Condition::PartsAtOnce)
            && !are_distinct(&mut self.grid, team, &[Step::Stay; ROBOTS])
        {
            self.reel = Reel::TAKE_BACK;
            return self.backtrack(log, entry).map(Intent::Go);
        }
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

    /// Bytes that the team has sent so far.
    pub(super) const fn sent(&self) -> usize {
        self.moves as usize * (self.robots - 1)
    }

    /// Whether all robots are in the base.
    pub fn is_home(&self) -> bool {
        self.cells().iter().all(|&cell| cell == self.cells[0])
    }

    /// Whether an unexplored cell is within reach of so many robots from the base, as far as the team knows.
    pub fn has_more_within_reach(&mut self) -> bool {
        let mut stops = self.cells;
        self.grid.stops(self.cells[0], &mut stops[..self.robots]).is_some()
    }

    /// Forgets the history if the team move that would be taken back next leads over
    /// a side that is known to be a wall by now.
    fn forget_what_is_shut(&mut self, log: &[u8]) {
        let (Walls::Changing, Some(entry)) = (self.walls, self.last_open) else { return };
        let first = entry as usize * (self.robots - 1);
        let is_shut = |(&cell, &byte): (&Cell, &u8)| {
            let back = Message::decode(byte).map_or(Step::Stay, |message| message.made().reverse());
            matches!(back, Step::Cross(side) if self.grid.edge_has(EdgeMark::Wall, Edge::new(cell, side)))
        };
        if self.cells().iter().skip(1).zip(log.get(first..).unwrap_or(&[])).any(is_shut) {
            self.forget();
        }
    }

    /// Leaves nothing to take back.
    pub(super) const fn forget(&mut self) {
        self.past = Past::Since(self.moves);
        self.last_open = None;
    }

    /// Whether there is an unexplored cell to unfold the chain towards.
    fn has_target(&mut self) -> bool {
        self.rule.has(Condition::Unfold) && self.is_home() && self.has_more_within_reach()
    }

    /// The plan that makes these `steps`, if they are admitted; else the null move.
    fn advance(&mut self, steps: [Step; ROBOTS]) -> Plan<ROBOTS> {
        let team = &self.cells[..self.robots];
        self.refused = !self.rule.admits_plan(&mut self.grid, team, &steps[..self.robots]);
        let steps = if self.refused { [Step::Stay; ROBOTS] } else { steps };
        Plan { kind: Kind::Advance, steps, robots: self.robots, last_open: Some(self.moves), mute: 0 }
    }

    /// The plan that takes log entry `entry` back.
    fn backtrack(&mut self, log: &[u8], entry: u32) -> Result<Plan<ROBOTS>, Damage> {
        let movers = self.robots - 1;
        let sent = self.sent();
        if log.len() != sent {
            return Err(Damage::Length { bytes: log.len(), sent });
        }
        let first = entry as usize * movers;
        let messages = log.get(first..first + movers).unwrap_or(&[]);
        let mut steps = [Step::Stay; ROBOTS];
        let mut cells = self.cells;
        for (robot, &byte) in (1..).zip(messages) {
            let message = Message::decode(byte)?;
            if message.outcome == Outcome::TookBack {
                return Err(Damage::TakenBack(robot + 1));
            }
            let back = message.made().reverse();
            let met = match (message.outcome, message.step, back) {
                (Outcome::Blocked, Step::Cross(side), _) => Some((side, EdgeMark::Wall)),
                (_, _, Step::Cross(side)) => Some((side, EdgeMark::Open)),
                (_, _, Step::Stay) => None,
            };
            if met.is_some_and(|(side, mark)| !self.grid.edge_has(mark, Edge::new(cells[robot], side))) {
                return Err(Damage::OtherWorld(robot + 1));
            }
            steps[robot] = back;
            cells[robot] = cells[robot].after(back);
            if !self.rule.keeps_contact(cells[robot - 1], cells[robot]) {
                return Err(Damage::OutOfContact(robot + 1));
            }
        }
        let team = &cells[..self.robots];
        if self.rule.keeps_apart() {
            let is_crowded = mark_occupied(&mut self.grid, team);
            unmark_occupied(&mut self.grid, team);
            if is_crowded {
                return Err(Damage::Crowded);
            }
        }
        let last_open = self.past.open_before(entry, log, movers);
        if last_open.is_none()
            && self.past == Past::Home
            && let Some(robot) = team.iter().position(|&cell| cell != cells[0])
        {
            return Err(Damage::NotHome(robot + 1));
        }
        Ok(Plan { kind: Kind::Backtrack, steps, robots: self.robots, last_open, mute: 0 })
    }
}
