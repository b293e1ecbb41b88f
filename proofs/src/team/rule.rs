//! The face of a robot's rule: what it sees, what it does, and what is demanded of the team.

use std::fmt::{self, Debug};
use std::hash::Hash;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Side};

use super::ground::{Ground, Map, passes};
use crate::engine::states::Bits;
use crate::plural::counted;

/// A robot's next action.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Act {
    /// It stays in its cell.
    Wait,
    /// It goes to the next cell on this side, if nothing is in its way.
    Go(Side),
}

/// The rule of every robot of a team. It depends on nothing but its arguments: the same view and the same memory make
/// the same act.
pub trait Rule: Clone + Send + Sync {
    /// All that a robot remembers.
    type Memory: Clone + Eq + Hash + Debug + Send + Sync;
    /// A message between robots; `()` if they send none.
    type Message: Clone + Eq + Hash + Debug + Send + Sync;

    /// A robot's memory at the start, of a team that starts in these cells.
    fn start(&self, robot: usize, starts: &[Cell]) -> Self::Memory;

    /// A robot's action; its memory is changed to what it remembers from now on.
    fn act(&self, view: &mut View<'_, Self>, memory: &mut Self::Memory) -> Act;

    /// Whether a robot has nothing left to do. The run is over when no robot has.
    fn is_done(&self, robot: usize, scene: &Scene<Self>) -> bool {
        let _ = (robot, scene);
        false
    }
}

/// One robot: where it is, what it remembers, and what it is about to do.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Body<M, T> {
    pub(super) cell: Cell,
    pub(super) memory: M,
    /// Whether something was in its way when it last acted.
    pub(super) is_blocked: bool,
    pub(super) is_dead: bool,
    /// The robot's next action, if looking and moving are steps of their own.
    pub(super) pending: Option<Act>,
    /// The last message of each other robot since it last acted.
    pub(super) heard: Vec<(usize, T)>,
}

impl<M, T> Body<M, T> {
    pub(super) const fn new(cell: Cell, memory: M) -> Self {
        Self { cell, memory, is_blocked: false, is_dead: false, pending: None, heard: Vec::new() }
    }
}

/// A team that follows a rule, and what is known of its layout.
pub type Scene<R> = TeamState<<R as Rule>::Memory, <R as Rule>::Message>;

/// Robots with their memories, the messages that have come to them, and what is known of their layout.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct TeamState<M, T> {
    pub(super) bodies: Vec<Body<M, T>>,
    pub(super) goals: Vec<Cell>,
    /// The layout as far as it is decided; `None` in a layout that answers for itself.
    pub(super) map: Option<Map>,
    pub(super) losses: u32,
    pub(super) deaths: u32,
}

impl<M, T> TeamState<M, T> {
    /// How many robots there are.
    pub fn robots(&self) -> usize {
        self.bodies.len()
    }

    /// The cells of the robots.
    pub fn cells(&self) -> impl Iterator<Item = Cell> + Clone {
        self.bodies.iter().map(|body| body.cell)
    }

    /// The cell of a robot.
    pub fn cell(&self, robot: usize) -> Cell {
        self.bodies[robot].cell
    }

    /// The goal of a robot, if robots have goals.
    pub fn goal(&self, robot: usize) -> Option<Cell> {
        self.goals.get(robot).copied()
    }

    /// A robot's memory.
    pub fn memory(&self, robot: usize) -> &M {
        &self.bodies[robot].memory
    }

    /// Whether something was in the way of a robot when it last acted.
    pub fn was_blocked(&self, robot: usize) -> bool {
        self.bodies[robot].is_blocked
    }

    /// Whether a robot has died.
    pub fn is_dead(&self, robot: usize) -> bool {
        self.bodies[robot].is_dead
    }

    /// The messages that have come to a robot since it last acted, each with the number of its sender.
    pub fn heard(&self, robot: usize) -> &[(usize, T)] {
        &self.bodies[robot].heard
    }

    /// The pending move of a robot that has looked and not yet moved, where these are steps of their own.
    pub fn pending(&self, robot: usize) -> Option<Act> {
        self.bodies[robot].pending
    }

    /// The layout as far as it is decided: what robots have met, and all of it where nothing is left to be met. Robots
    /// need not know as much: what a rule or a demand is to tell of what they know stands in their memory. `None` in a
    /// layout that answers for itself.
    pub const fn map(&self) -> Option<&Map> {
        self.map.as_ref()
    }

    /// Whether no two robots are in one cell.
    pub fn cells_differ(&self) -> bool {
        let cells = self.cells();
        cells.clone().enumerate().all(|(robot, cell)| cells.clone().take(robot).all(|other| other != cell))
    }
}

/// How far robots see, in steps as if nothing stood between; 0 is not at all, and [`u16::MAX`] everything.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Senses {
    /// Walls and blocked cells. A robot that does not see them finds out by going.
    pub ground: u16,
    /// Other robots.
    pub robots: u16,
}

impl Senses {
    /// A robot sees nothing, and feels what is in its way.
    pub const BUMP: Self = Self { ground: 0, robots: 0 };
    /// A robot feels what is in its way, and knows where the others are.
    pub const TEAM: Self = Self { ground: 0, robots: u16::MAX };
    /// A robot sees everything.
    pub const ALL: Self = Self { ground: u16::MAX, robots: u16::MAX };
}

impl fmt::Display for Senses {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seen = |far: u16, what: &str| match far {
            0 => None,
            u16::MAX => Some(format!("all {what}")),
            _ => Some(format!("{what} within {}", counted(far, "step"))),
        };
        match (seen(self.ground, "walls"), seen(self.robots, "robots")) {
            (None, None) => f.write_str("sight of nothing"),
            (Some(seen), None) | (None, Some(seen)) => write!(f, "sight of {seen}"),
            (Some(ground), Some(robots)) => write!(f, "sight of {ground} and {robots}"),
        }
    }
}

/// A robot's view when it acts.
pub struct View<'a, R: Rule> {
    pub(super) senses: Senses,
    pub(super) ground: &'a Ground,
    pub(super) robot: usize,
    pub(super) scene: &'a Scene<R>,
    /// The layout as far as it is decided by now.
    pub(super) map: &'a mut Option<Map>,
    pub(super) world: &'a mut dyn Oracle,
    pub(super) sent: &'a mut Vec<(usize, R::Message)>,
}

impl<R: Rule> View<'_, R> {
    /// The number of this robot.
    pub const fn me(&self) -> usize {
        self.robot
    }

    /// How many robots there are.
    pub fn robots(&self) -> usize {
        self.scene.robots()
    }

    /// The cell of this robot.
    pub fn cell(&self) -> Cell {
        self.scene.cell(self.robot)
    }

    /// The goal of this robot, if robots have goals.
    pub fn goal(&self) -> Option<Cell> {
        self.scene.goal(self.robot)
    }

    /// Whether something was in its way when it last went.
    pub fn was_blocked(&self) -> bool {
        self.scene.was_blocked(self.robot)
    }

    /// The cell of another robot, if it is in sight.
    pub fn sees(&self, robot: usize) -> Option<Cell> {
        let cell = self.scene.bodies.get(robot)?.cell;
        self.is_within(cell, self.senses.robots).then_some(cell)
    }

    /// Whether a robot that is in sight has met something in its way.
    pub fn sees_blocked(&self, robot: usize) -> Option<bool> {
        self.sees(robot).map(|_| self.scene.was_blocked(robot))
    }

    /// Whether robots can go from `cell` through `side`: no wall is between, and the next cell is free. `None` if it is
    /// out of sight.
    pub fn is_open(&mut self, cell: Cell, side: Side) -> Option<bool> {
        let is_seen = self.is_within(cell, self.senses.ground);
        is_seen.then(|| passes(self.ground, self.map, (cell, side), self.world))
    }

    /// The messages that have come since this robot last acted, each with the number of its sender.
    pub fn heard(&self) -> &[(usize, R::Message)] {
        self.scene.heard(self.robot)
    }

    /// Tells all other robots. Of two messages to a robot that has not acted since, the later one counts.
    pub fn tell(&mut self, message: R::Message) {
        self.sent.push((self.robot, message));
    }

    /// The side to a cell beside this robot's.
    pub fn side_to(&self, cell: Cell) -> Option<Side> {
        Side::ALL.into_iter().find(|&side| self.cell().beyond(side) == cell)
    }

    fn is_within(&self, cell: Cell, most: u16) -> bool {
        let (columns, rows) = self.cell().apart(cell);
        most > 0 && u32::from(columns) + u32::from(rows) <= u32::from(most)
            || most == u16::MAX
            || cell == self.cell() && most > 0
    }
}

/// One step of a team, as a demand sees it.
#[derive(Debug)]
pub struct TeamStep<'a, R: Rule> {
    /// The team before it.
    pub before: &'a Scene<R>,
    /// The team after it.
    pub after: &'a Scene<R>,
}

impl<R: Rule> TeamStep<'_, R> {
    /// Whether a robot has left its cell.
    pub fn has_moved(&self, robot: usize) -> bool {
        self.before.cell(robot) != self.after.cell(robot)
    }
}

/// A question about a step.
type StepQuestion<'a, R> = &'a (dyn Fn(&TeamStep<'_, R>) -> bool + Sync);
/// A question about a team.
type SceneQuestion<'a, R> = &'a (dyn Fn(&Scene<R>) -> bool + Sync);
/// The obligations of a team, a bit for each.
type Obligations<'a, R> = &'a (dyn Fn(&Scene<R>) -> Bits + Sync);

/// When a demand is looked at.
pub(super) enum When<'a, R: Rule> {
    Always(StepQuestion<'a, R>),
    AtTheEnd(SceneQuestion<'a, R>),
    NeverEndless,
    Eventually(SceneQuestion<'a, R>),
    AgainAndAgain(Obligations<'a, R>),
}

/// A demand on a team.
pub struct Demand<'a, R: Rule> {
    /// The id of the clause that demands it.
    pub id: &'static str,
    /// The demand in words.
    pub words: &'static str,
    pub(super) when: When<'a, R>,
}

impl<'a, R: Rule> Demand<'a, R> {
    /// Of every step.
    pub const fn always(id: &'static str, words: &'static str, is_kept: StepQuestion<'a, R>) -> Self {
        Self { id, words, when: When::Always(is_kept) }
    }

    /// Of the end of every run that ends.
    pub const fn at_the_end(id: &'static str, words: &'static str, is_kept: SceneQuestion<'a, R>) -> Self {
        Self { id, words, when: When::AtTheEnd(is_kept) }
    }

    /// That no run goes on for ever: none in which every robot acts again and again that has something left to do.
    /// Where this is not demanded, a run that comes back to where it was is over.
    pub const fn never_endless(id: &'static str, words: &'static str) -> Self {
        Self { id, words, when: When::NeverEndless }
    }

    /// That this is so at some time in every run in which every robot acts again and again that has something left to
    /// do (weak fairness).
    pub const fn eventually(id: &'static str, words: &'static str, is_so: SceneQuestion<'a, R>) -> Self {
        Self { id, words, when: When::Eventually(is_so) }
    }

    /// That no run in which every robot acts again and again that has something left to do comes to owe one of these, a
    /// bit for each, from some time on for ever. A patrol owes a visit to each cell in which no robot is.
    pub const fn again_and_again(id: &'static str, words: &'static str, owed: Obligations<'a, R>) -> Self {
        Self { id, words, when: When::AgainAndAgain(owed) }
    }

    /// Whether a step breaks it.
    pub fn is_broken_by(&self, moved: &TeamStep<'_, R>) -> bool {
        matches!(self.when, When::Always(is_kept) if !is_kept(moved))
    }

    /// Whether a run breaks it that ends so.
    pub fn is_broken_at_end(&self, scene: &Scene<R>) -> bool {
        match self.when {
            When::Always(_) | When::NeverEndless => false,
            When::AtTheEnd(is_kept) | When::Eventually(is_kept) => !is_kept(scene),
            When::AgainAndAgain(owed) => owed(scene) != 0,
        }
    }

    /// Whether a run may break it that never ends.
    pub const fn is_broken_by_endless_runs(&self) -> bool {
        matches!(self.when, When::NeverEndless | When::Eventually(_) | When::AgainAndAgain(_))
    }

    /// Whether its obligations differ from scene to scene.
    pub(super) const fn is_owed_again(&self) -> bool {
        matches!(self.when, When::AgainAndAgain(_))
    }

    /// The obligations that a run must not owe for ever: the same one always, unless the demand is one of them.
    pub(super) fn owed(&self, scene: &Scene<R>) -> Bits {
        match self.when {
            When::AgainAndAgain(owed) => owed(scene),
            When::Always(_) | When::AtTheEnd(_) | When::NeverEndless | When::Eventually(_) => 1,
        }
    }

    /// Whether nothing more is demanded of a run that has come to this.
    pub(super) fn is_met_by(&self, scene: &Scene<R>) -> bool {
        matches!(self.when, When::Eventually(is_so) if is_so(scene))
    }
}

/// A situation that must occur: its name, and whether a step is one.
pub type Cover<'a, R> = (&'static str, StepQuestion<'a, R>);
