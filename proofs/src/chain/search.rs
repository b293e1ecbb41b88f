//! The chain as the search over all layouts plays it: its bounds, and a check of what no run may break.

use std::fmt;

use tautline_kernel::chain::SetupError;
use tautline_kernel::ground::{CompactGrid, LargeGrid, MediumGrid, SmallGrid, TinyGrid};

pub use super::bounds::{Bounds, Counterexample};
use super::game::ChainGame;
use super::invariant::Invariant;
use super::plain_game::PlainGame;
use super::subject::Subject;

use crate::decide::{self, Answer, Context, Method, RefutationPlay, Systems};
use crate::engine::tree::{self, AllRuns, Progress, Tree, Watch, Waves};
use crate::engine::{Choices, ScriptError, Until};
use crate::plural::counted;
use crate::run::Frame;

/// The findings of a search.
pub type Findings = tree::Findings<Invariant, Frame>;

/// Where a search is.
pub type Position = tree::Position<Invariant>;

/// A search dealt out among shards.
pub type Deal = tree::Deal<Invariant>;

/// Why there is no search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unsearchable {
    /// The team cannot be set up.
    Team(SetupError),
    /// The bounds are beyond what can be searched.
    Search(tree::Unsearchable),
}

impl fmt::Display for Unsearchable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Team(refused) => refused.fmt(f),
            Self::Search(refused) => refused.fmt(f),
        }
    }
}

impl std::error::Error for Unsearchable {}

impl From<SetupError> for Unsearchable {
    fn from(refused: SetupError) -> Self {
        Self::Team(refused)
    }
}

impl From<tree::Unsearchable> for Unsearchable {
    fn from(refused: tree::Unsearchable) -> Self {
        Self::Search(refused)
    }
}

/// Searches all layouts within `bounds`. The result is the same on any number of threads, unless `watch` ends the
/// search.
///
/// # Errors
/// [`Unsearchable`] if the bounds are beyond what can be searched.
pub fn search(bounds: &Bounds, watch: Watch<'_>) -> Result<Findings, Unsearchable> {
    let mut search = Search::new(bounds)?;
    while search.wave() && watch(&search.progress()).is_continue() {}
    Ok(search.found())
}

/// Plays a run that breaks `invariant` again, whose choices are the answers of the world. It is one run, whatever
/// number of runs break it.
pub(super) fn replay(
    bounds: &Bounds,
    invariant: Invariant,
    choices: &Choices,
) -> Result<Counterexample, ScriptError> {
    let search = Search::new(bounds).map_err(|_| ScriptError::Unbroken)?;
    if !choices.again.is_empty() {
        return Err(ScriptError::Over { at: choices.once.len() });
    }
    search.0.replay(invariant, &choices.once)
}

/// A search that is made wave by wave, and can be left and taken up again between two of them.
pub struct Search(Box<dyn Waves<Invariant, Frame>>);

impl Search {
    /// The search within `bounds`, at its start.
    ///
    /// # Errors
    /// [`Unsearchable`] if the bounds are beyond what can be searched.
    pub fn new(bounds: &Bounds) -> Result<Self, Unsearchable> {
        let limits = &bounds.limits();
        if bounds.observed.has_readings() {
            return Ok(Self(Box::new(Tree::new(PlainGame::new(bounds)?, limits)?)));
        }
        Ok(match bounds.robots {
            0..=4 => Self(Box::new(Tree::new(ChainGame::<_, 4>::new(bounds, TinyGrid::new)?, limits)?)),
            5..=6 => Self(Box::new(Tree::new(ChainGame::<_, 6>::new(bounds, CompactGrid::new)?, limits)?)),
            7..=8 => Self(Box::new(Tree::new(ChainGame::<_, 8>::new(bounds, SmallGrid::new)?, limits)?)),
            9..=32 => Self(Box::new(Tree::new(ChainGame::<_, 32>::new(bounds, MediumGrid::new)?, limits)?)),
            _ => Self(Box::new(Tree::new(ChainGame::<_, 64>::new(bounds, LargeGrid::new)?, limits)?)),
        })
    }

    /// The search within `bounds` at `position`, where a search with the same bounds was; more walls may be asked for
    /// than then.
    ///
    /// # Errors
    /// [`Unsearchable`] if the bounds are beyond what can be searched, or the position is none of this search.
    pub fn at(bounds: &Bounds, position: &Position) -> Result<Self, Unsearchable> {
        let mut search = Self::new(bounds)?;
        search.0.go_to(position)?;
        Ok(search)
    }

    /// The search of one shard of a deal, the first being 0, at its start.
    ///
    /// # Errors
    /// [`Unsearchable`] if the bounds are beyond what can be searched, or the deal is none of this search.
    pub fn shard(bounds: &Bounds, deal: &Deal, shard: usize) -> Result<Self, Unsearchable> {
        let mut search = Self::new(bounds)?;
        search.0.take(deal, shard)?;
        Ok(search)
    }

    /// The search of a shard at `position`, where it was.
    ///
    /// # Errors
    /// [`Unsearchable`], also if the position is none of this shard.
    pub fn shard_at(
        bounds: &Bounds,
        deal: &Deal,
        shard: usize,
        position: &Position,
    ) -> Result<Self, Unsearchable> {
        let mut search = Self::shard(bounds, deal, shard)?;
        search.0.go_to(position)?;
        Ok(search)
    }

    /// The search that has done what all shards of a deal have, which are at these positions.
    ///
    /// # Errors
    /// [`Unsearchable`], also if a shard is not at its end.
    pub fn merged(bounds: &Bounds, deal: &Deal, shards: &[Position]) -> Result<Self, Unsearchable> {
        let mut search = Self::new(bounds)?;
        search.0.merge(deal, shards)?;
        Ok(search)
    }

    /// Deals the search out among so many shards. It goes no further then.
    pub fn deal(mut self, shards: usize) -> Deal {
        self.0.deal(shards)
    }

    /// Searches a little further. Returns whether there is more to do, and to spend.
    pub fn wave(&mut self) -> bool {
        self.0.wave()
    }

    /// Whether all layouts within the bounds are covered.
    pub fn is_complete(&self) -> bool {
        self.0.is_complete()
    }

    /// How far it is.
    pub fn progress(&self) -> Progress<'_> {
        self.0.progress()
    }

    /// Where it is: enough to go on from here.
    pub fn position(&self) -> Position {
        self.0.position()
    }

    /// The findings so far.
    pub fn found(&self) -> Findings {
        self.0.found()
    }
}

impl fmt::Debug for Search {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Search").field(&self.progress()).finish()
    }
}

/// A check that no run of so many robots breaks an invariant, in any layout of the paper's area with at most so many
/// walls.
pub struct EveryLayout(pub Invariant, pub (usize, u32));

impl EveryLayout {
    fn bounds(&self, observed: &Subject) -> Bounds {
        let (robots, max_walls) = self.1;
        let companions = self.0.companions(&observed.intended);
        Bounds { invariants: companions.to_vec(), ..Bounds::new(*observed, robots, max_walls) }
    }
}

impl Method<Subject> for EveryLayout {
    fn engine(&self) -> &'static str {
        "search"
    }

    fn bound(&self) -> String {
        let (robots, max_walls) = self.1;
        let of = if self.0 == Invariant::MeetsInAdvance { ", in advances" } else { "" };
        format!("all layouts, N = {robots}, at most {}{of}", counted(max_walls, "wall"))
    }

    fn family(&self, observed: &Subject) -> Option<String> {
        Some(format!("{:?}", self.bounds(observed)))
    }

    fn decide(
        &self,
        observed: &Subject,
        until: Until,
        context: &mut Context<'_, '_>,
    ) -> Result<Answer, decide::MethodError> {
        let all = self.bounds(observed);
        let bounds = match until {
            Until::Exhausted => all,
            Until::Violation => Bounds { invariants: vec![self.0], until, ..all },
        };
        let Context { cache, watch, .. } = context;
        let found = cache.recall(bounds.clone(), |bounds| search(bounds, *watch));
        let found = found.map_err(decide::MethodError::new)?;
        let broken = found.counterexamples.iter().find(|found| found.broken == self.0);
        let evidence = broken.map(|found| bounds.evidence(found));
        let is_whole = found.complete && found.given_up == 0;
        let answer = Answer::new(evidence, is_whole, self.shows(), found.runs - found.given_up);
        Ok(Answer { given_up: found.given_up, ..answer })
    }

    fn systems(&self, observed: &Subject) -> Result<Systems, decide::MethodError> {
        let bounds = Bounds { invariants: vec![self.0], ..self.bounds(observed) };
        let Search(search) = Search::new(&bounds).map_err(decide::MethodError::new)?;
        Ok(vec![Box::new(AllRuns::new(search, self.0))])
    }

    fn replay(&self, observed: &Subject, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let bounds = self.bounds(observed);
        let run = replay(&bounds, self.0, choices)?;
        Ok(RefutationPlay { of: vec![2; run.answers.len()], evidence: bounds.evidence(&run) })
    }
}
