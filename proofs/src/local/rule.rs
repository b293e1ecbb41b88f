//! A rule that is local and the same everywhere, as whoever brings one says it: what one robot can do, what as many as
//! it speaks of may plan at once, how they start, and the promise.

use std::fmt::Debug;

use tautline_kernel::ground::{Cell, Step};

use crate::protocol::arrangements;

/// A robot as others see it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Robot<S> {
    /// Its cell.
    pub at: Cell,
    /// Its state.
    pub state: S,
    /// The colour of its cell.
    pub on: u8,
}

/// A possible act of a robot.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Act<S, A> {
    /// The act.
    pub act: A,
    /// Where it leads.
    pub step: Step,
    /// The possible outcomes, at least one: whether the robot goes, and its next state. An act that crosses a side
    /// needs one in which the robot stays, as there may be a wall: see [`Local::is_sure`].
    pub ends: Vec<(bool, S)>,
    /// Whether it is possible only over an edge that is known to be open.
    pub needs_open: bool,
}

impl<S: Copy> Act<S, Step> {
    /// Every step, in which a robot goes unless a wall stands in its way, and keeps its state.
    pub fn steps(state: S) -> Vec<Self> {
        let act = |step| {
            let (goes, stays) = ((true, state), (false, state));
            let ends = if step == Step::Stay { vec![goes] } else { vec![goes, stays] };
            Self { act: step, step, ends, needs_open: false }
        };
        Step::ALL.into_iter().map(act).collect()
    }
}

impl<S> Robot<S> {
    /// A robot in a cell of colour 0.
    pub const fn new(at: Cell, state: S) -> Self {
        Self { at, state, on: 0 }
    }
}

impl<S: Copy> Robot<S> {
    /// Its plan to do `act`, which leads to a cell of this colour.
    pub(super) fn plans<A: Copy>(&self, act: &Act<S, A>, aims: u8) -> Plan<S, A> {
        Plan { robot: *self, act: act.act, step: act.step, aims }
    }

    /// The robot after this outcome of an act that leads to a cell of this colour.
    pub(super) fn after(&self, (step, aims): (Step, u8), (goes, state): (bool, S)) -> Self {
        if goes { Self { at: self.at.after(step), state, on: aims } } else { Self { state, ..*self } }
    }
}

/// A robot and what it plans.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Plan<S, A> {
    /// The robot.
    pub robot: Robot<S>,
    /// Its act.
    pub act: A,
    /// Where that leads.
    pub step: Step,
    /// The colour of the cell there.
    pub aims: u8,
}

impl<S, A> Plan<S, A> {
    /// The cell to which the plan leads.
    pub fn to(&self) -> Cell {
        self.robot.at.after(self.step)
    }
}

/// Robots that are farther apart than the rule looks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Far {
    /// They keep the promise, and are not asked about.
    Fine,
    /// They break it.
    Broken,
}

/// A rule that is local and the same everywhere.
pub trait Local: Sync {
    /// The state of a robot beside its cell.
    type State: Copy + Ord + Debug + Sync;
    /// An act.
    type Act: Copy + Eq + Debug + Sync;

    /// Of how many robots at once the rule speaks.
    fn robots(&self) -> usize {
        2
    }

    /// The fewest robots of a team.
    fn least(&self) -> usize {
        self.robots()
    }

    /// Whether a robot may be kept from going though no wall stands in its way.
    fn may_fail(&self) -> bool {
        false
    }

    /// How many colours cells may have. A layout gives each cell a colour below that.
    fn colours(&self) -> u8 {
        1
    }

    /// The subject of the verdict, in words.
    fn subject() -> &'static str
    where
        Self: Sized,
    {
        "the relation"
    }

    /// All states.
    fn states(&self) -> Vec<Self::State>;

    /// Whatever a robot in this state can do, at least one act.
    fn acts(&self, state: Self::State) -> Vec<Act<Self::State, Self::Act>>;

    /// Whether as many robots as the rule speaks of may plan this at once. The answer may depend on where they are from
    /// each other, and not on where they are: every answer is compared with those at three other
    /// places.
    fn admits(&self, plans: &[Plan<Self::State, Self::Act>]) -> bool;

    /// The promise, of robots that are at most [`Local::reach`] columns and rows from the first one.
    fn keeps(&self, robots: &[Robot<Self::State>]) -> bool;

    /// How far the promise looks, in cells, and what it says of robots that are farther.
    fn reach(&self) -> (i16, Far);

    /// Whether robots of which the rule speaks may start so, the first of them in cell (0, 0). Where the promise is
    /// broken by robots that are far apart, none start so.
    fn may_start(&self, robots: &[Robot<Self::State>]) -> bool;

    /// A team of so many robots at its start: each tuple of which the rule speaks must be one that may start. It is
    /// asked of teams of up to [`EveryNumber::most_starts`](super::EveryNumber::most_starts) robots.
    fn start(&self, robots: usize) -> Vec<Robot<Self::State>>;

    /// Of which tuples of so many robots the rule speaks, at least one: of all, unless it says otherwise.
    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        all_tuples(robots, self.robots())
    }

    /// Whether an act is possible whatever was before. One that is possible in some pasts only is looked at as if it
    /// always were; but no run with it is called real, and no planner that is kept to the rule may do it.
    fn is_always_possible(&self, _: Self::Act) -> bool {
        true
    }

    /// Whether nothing stops a robot that does this, neither a wall nor a fault: it has met what is there before. An
    /// act that crosses a side and is not sure is refused unless a robot may stay by it; over an edge that is known to
    /// be open faults alone may stop it.
    fn is_sure(&self, _: Self::Act) -> bool {
        false
    }

    /// Whether a robot never leaves its cell: a base.
    fn is_fixed(&self, _robot: usize) -> bool {
        false
    }
}

/// An act of a rule.
pub(super) type ActOf<R> = Act<<R as Local>::State, <R as Local>::Act>;

/// A robot of a rule.
pub(super) type RobotOf<R> = Robot<<R as Local>::State>;

/// So many robots beside each other in a row of cells of the first colour.
pub fn in_a_row<S: Copy>(robots: usize, state: S) -> Vec<Robot<S>> {
    (0..robots as i16).map(|x| Robot::new(Cell::new(x, 0), state)).collect()
}

/// Every way to name `of` of so many robots, in any order.
pub fn all_tuples(robots: usize, of: usize) -> Vec<Vec<usize>> {
    arrangements(&(0..robots).collect::<Vec<_>>(), of)
}

/// Each robot with the next one.
pub fn chain(robots: usize) -> Vec<Vec<usize>> {
    (1..robots).map(|robot| vec![robot - 1, robot]).collect()
}

/// Functions of a rule that has another one, `self.rule`, and answers as that does.
macro_rules! as_its_rule {
    ($($name:ident($($argument:ident: $type:ty)?) -> $answer:ty;)*) => {$(
        fn $name(&self $(, $argument: $type)?) -> $answer {
            self.rule.$name($($argument)?)
        }
    )*};
}

pub(super) use as_its_rule;
