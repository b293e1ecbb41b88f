//! What stands still while a run goes on, and a run that can be made as often as it is drawn.

use std::fmt;

use tautline_kernel::ground::Cell;

use super::clause::ClauseId;
use super::run::{Limits, Report, TeamMove, Watcher};
use super::survey::Survey;
use crate::diagnostic::Halt;
use crate::frontier::Options;
use crate::layout::Layout;
use crate::layout::generate::Probability;

/// How a team is drawn and told of.
#[derive(Clone, Copy, Debug)]
pub enum Look {
    /// The first robot is the base, the last one leads, and those beside each other in their order have a link.
    Linked {
        /// Whether the link of two robots is lost that go from the first to the second of these pairs of cells.
        is_lost: fn(&[Cell], &[Cell]) -> bool,
    },
    /// The first robot is the base, and links join the robots in a tree.
    Tree {
        /// Whether robots in these cells have a link.
        is_linked: fn(Cell, Cell) -> bool,
    },
    /// Every robot is an agent for itself.
    Apart,
    /// The same, and agents are called robots.
    Robots,
}

impl Look {
    /// Whether the first robot is the base.
    pub const fn has_base(self) -> bool {
        match self {
            Self::Linked { .. } | Self::Tree { .. } => true,
            Self::Apart | Self::Robots => false,
        }
    }

    /// What a robot is called.
    pub const fn robot(self) -> &'static str {
        match self {
            Self::Linked { .. } | Self::Tree { .. } | Self::Robots => "robot",
            Self::Apart => "agent",
        }
    }
}

/// What agents know of a sensor floor in the end.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Knowledge {
    /// Nothing: whoever watches them ends the run.
    None,
    /// Which cells are visited, and when they are done.
    Visited,
}

/// What stands still while a run goes on: who explores, where, and what makes the run.
#[derive(Clone, Copy, Debug)]
pub struct RunConfig<'a> {
    /// The name of the scheme: letters, digits and hyphens, as all names of rules and clauses.
    pub scheme: &'a str,
    /// The name of its rule.
    pub rule: &'a str,
    /// Robots, the base included if there is one.
    pub robots: u16,
    /// The seed of whatever is left to chance.
    pub seed: u64,
    /// The ground truth.
    pub layout: &'a Layout,
    /// Where the robots start that have no start of their own.
    pub base: Cell,
    /// Where each robot starts, if not all start at the base.
    pub starts: Option<&'a [Cell]>,
    /// How likely it is that a sensor is missed.
    pub miss: Probability,
    /// Which sensors are missed besides.
    pub missed: &'a [u32],
    /// What else the run is told.
    pub options: Options,
    /// The choices that make the run, where a search has found it.
    pub choices: &'a [u32],
    /// When the run is stopped.
    pub limits: Limits,
    /// How the team is drawn.
    pub look: Look,
    /// What the team knows of a sensor floor, if it is on one.
    pub knowledge: Option<Knowledge>,
}

impl<'a> RunConfig<'a> {
    /// Robots in these `starts` of `layout`, the first of which is the base; nothing is left to chance.
    pub fn new(scheme: &'a str, rule: &'a str, layout: &'a Layout, starts: &'a [Cell]) -> Self {
        let base = starts.first().copied().unwrap_or(Cell::new(0, 0));
        Self {
            scheme,
            rule,
            robots: starts.len() as u16,
            seed: 0,
            layout,
            base,
            starts: Some(starts).filter(|starts| starts.iter().any(|&start| start != base)),
            miss: Probability::NEVER,
            missed: &[],
            options: Options::default(),
            choices: &[],
            limits: Limits::default(),
            look: Look::Robots,
            knowledge: None,
        }
    }

    /// Where each robot starts.
    pub fn starts(&self) -> Vec<Cell> {
        self.starts.map_or_else(|| vec![self.base; self.robots.into()], <[Cell]>::to_vec)
    }
}

/// A run that can be made as often as it is drawn: by its rule, or from what is stored of it.
pub trait Play {
    /// What stands still.
    fn stage(&self) -> RunConfig<'_>;

    /// Makes the run. `watch` sees every team move, and may stop the run for good.
    ///
    /// # Errors
    /// [`Halt`] if the run cannot be made, or whatever `watch` returned.
    fn play(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt>;

    /// How the team move `made` breaks `clause`, one line for each pair or cell.
    fn told(&self, clause: ClauseId, chart: &Survey, made: &TeamMove<'_>) -> Vec<String> {
        let _ = (clause, chart, made);
        Vec::new()
    }

    /// What the cells are that the end of the run must not miss by `clause`, and those that it misses.
    fn missed(&self, clause: ClauseId, chart: &Survey) -> Option<(&'static str, Vec<Cell>)> {
        let _ = (clause, chart);
        None
    }
}

impl fmt::Debug for dyn Play + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.stage().fmt(f)
    }
}
