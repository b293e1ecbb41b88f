//! The bounds of a search for the chain: what it looks for, and how far.

use tautline_kernel::chain::{SetupError, area};
use tautline_kernel::ground::{Area, Cell};

use super::breach::Breach;
use super::invariant::Invariant;
use super::readings::starts;
use super::subject::Subject;
use super::whole_runs;
use crate::decide::{Depiction, Evidence};
use crate::engine::tree::{self, Limits};
use crate::engine::{Choices, Until};
use crate::run::{Ending, Frame, Run, Words, walls};

/// A run that breaks an invariant.
pub type Counterexample = tree::Counterexample<Invariant, Frame>;

/// The invariants to search for, and how far.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Bounds {
    /// The chain, and how it is deceived.
    pub observed: Subject,
    /// Robots, base included: at most 64.
    pub robots: usize,
    /// The cells that the layouts have in common; the chain's range cuts them to size.
    pub area: Area,
    /// The base.
    pub base: Cell,
    /// Most walls that are met in one run; the border is not counted.
    pub max_walls: u32,
    /// The search stops when it has made so many team moves.
    pub budget_moves: Option<u64>,
    /// The invariants, each as if it stood alone. A run without end is always found, since it would never be left.
    pub invariants: Vec<Invariant>,
    /// When to stop.
    pub until: Until,
}

impl Bounds {
    /// The area of the paper for `robots`: (2N−1)² cells, the base in the middle, everything looked for that a run of
    /// its own can break.
    pub fn new(observed: Subject, robots: usize, max_walls: u32) -> Self {
        let (area, base) = whole_runs::area(robots);
        Self {
            observed,
            robots,
            area,
            base,
            max_walls,
            budget_moves: None,
            invariants: Invariant::OF_RUNS.to_vec(),
            until: Until::Exhausted,
        }
    }

    /// The run that was found within these bounds.
    pub fn run(&self, found: &Counterexample) -> Run {
        Run {
            scheme: "chain",
            area: self.area,
            starts: self.starts().collect(),
            walls: walls(&found.frames),
            obstacles: Vec::new(),
            frames: found.frames.clone(),
            breaks: found.broken.breach().map(Breach::clause),
            ending: if found.broken.is_of_the_end() { Ending::Over } else { Ending::Move },
            words: Words::default(),
        }
    }

    /// The evidence that the run gives.
    pub(super) fn evidence(&self, found: &Counterexample) -> Evidence {
        let seen = Depiction::Robots(Box::new(self.run(found)));
        let choices = Choices { once: found.answers.clone(), again: Vec::new() };
        Evidence { choices, demand: found.demand, seen }
    }

    /// The limits of the search.
    pub(super) const fn limits(&self) -> Limits {
        let Self { max_walls, budget_moves, until, .. } = *self;
        Limits { max_walls, budget_moves, until }
    }

    /// Where the robots start, base first.
    pub(super) fn starts(&self) -> impl Iterator<Item = Cell> {
        starts(self.observed.readings, self.base, self.robots)
    }

    /// The area as the chain's range cuts it.
    ///
    /// # Errors
    /// [`SetupError`] if the base is outside.
    pub fn reach(&self) -> Result<Area, SetupError> {
        let base = self.base;
        area(self.area, base, self.robots).ok_or(SetupError::BaseOutside(base))
    }
}
