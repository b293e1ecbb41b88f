//! A search as those who make it see it: wave by wave, left and taken up again, dealt out, played again.

use tautline_certificates::{Counts, Refusal, check_runs};

use super::count::Count;
use super::deal::Deal;
use super::lane::{self, Lane, Rerun};
use super::search::{Position, Tree};
use super::{Counterexample, Findings, Game, Limits, Progress, Unsearchable, Watch};
use crate::engine::ScriptError;
use crate::engine::model::RunsModel;

/// A search that is made wave by wave, and can be left and taken up again between two of them.
pub trait Waves<D, F>: Send {
    /// Goes to `position`, where a search with the same limits was; more walls may be asked for than then.
    ///
    /// # Errors
    /// [`Unsearchable`] if the position is none of this search.
    fn go_to(&mut self, position: &Position<D>) -> Result<(), Unsearchable>;
    /// Searches a little further. Returns whether there is more to do, and to spend.
    fn wave(&mut self) -> bool;
    /// Whether the whole tree is covered.
    fn is_complete(&self) -> bool;
    /// How far it is.
    fn progress(&self) -> Progress<'_>;
    /// Where it is: enough to go on from here.
    fn position(&self) -> Position<D>;
    /// The findings so far.
    fn found(&self) -> Findings<D, F>;
    /// Deals what is left of the search out among so many shards, each of which can be searched elsewhere.
    fn deal(&mut self, shards: usize) -> Deal<D>;
    /// Becomes the search of one shard of a deal, the first being 0, at its start.
    ///
    /// # Errors
    /// [`Unsearchable`] if the deal is none of this search, or has no such shard.
    fn take(&mut self, deal: &Deal<D>, shard: usize) -> Result<(), Unsearchable>;
    /// Becomes the search that has done what all shards of a deal have.
    ///
    /// # Errors
    /// [`Unsearchable`] if they are not those of the deal, or not at their ends.
    fn merge(&mut self, deal: &Deal<D>, shards: &[Position<D>]) -> Result<(), Unsearchable>;
    /// Plays a run that breaks `demand` again, whose answers these are. It is one run, whatever number of runs break
    /// it.
    ///
    /// # Errors
    /// [`ScriptError`] if there is no such run.
    fn replay(&self, demand: D, answers: &[u32]) -> Result<Counterexample<D, F>, ScriptError>;
    /// Checks a section of a certificate that no run breaks `demand`, without this search.
    ///
    /// # Errors
    /// [`Refusal`] if it does not show that.
    fn check(&self, demand: D, section: &[u8]) -> Result<Counts, Refusal>;
}

/// Searches all layouts within `limits`. The result is the same on any number of threads, unless `watch` ends the
/// search.
///
/// # Errors
/// [`Unsearchable`] if the limits are beyond what can be searched.
pub fn search<G: Game>(
    game: G,
    limits: &Limits,
    watch: Watch<'_>,
) -> Result<Findings<G::Demand, G::Frame>, Unsearchable> {
    let mut tree = Tree::new(game, limits)?;
    while tree.wave() && watch(&tree.progress()).is_continue() {}
    Ok(tree.found())
}

impl<G: Game> Waves<G::Demand, G::Frame> for Tree<G> {
    fn go_to(&mut self, position: &Position<G::Demand>) -> Result<(), Unsearchable> {
        let walls = position.levels.len() as u32;
        let is_done = position.lanes.is_empty();
        let last = if is_done { walls.saturating_sub(1) } else { walls };
        if last > self.limits.max_walls {
            return Err(Unsearchable::Beyond { walls: last });
        }
        if self.shard.is_none() && !self.counts_again(position) {
            return Err(Unsearchable::Foreign);
        }
        let lane = |place| Lane::at(&self.game, walls, place).ok_or(Unsearchable::Foreign);
        let lanes = position.lanes.iter().map(lane).collect::<Result<_, _>>()?;
        if !position.count.follows(&position.levels, position.lanes.len()) || !self.records(&position.count) {
            return Err(Unsearchable::Foreign);
        }
        self.levels.clone_from(&position.levels);
        self.count = position.count.clone();
        self.before = self.count.moves;
        self.lanes = lanes;
        if !self.has_searched_the_rest(is_done) {
            return Err(Unsearchable::Short);
        }
        self.wave.clear();
        if is_done {
            self.begin();
        }
        Ok(())
    }

    fn wave(&mut self) -> bool {
        self.goes_on()
    }

    fn is_complete(&self) -> bool {
        self.lanes.is_empty()
    }

    fn progress(&self) -> Progress<'_> {
        Progress {
            runs: self.count.runs,
            moves: self.count.moves,
            levels: &self.levels,
            max_walls: self.limits.max_walls,
            edges: self.game.edges(),
            wave: &self.wave,
        }
    }

    fn position(&self) -> Position<G::Demand> {
        Position {
            levels: self.levels.clone(),
            count: self.count.clone(),
            lanes: self.lanes.iter().map(Lane::place).collect(),
        }
    }

    fn found(&self) -> Findings<G::Demand, G::Frame> {
        let Count { runs, moves, longest, given_up, ref broken, .. } = self.count;
        let mut broken = broken.clone();
        broken.sort_unstable();
        let situations = self.game.covers().into_iter().zip(0..);
        let covered = situations.filter(|(_, bit)| self.count.covered >> bit & 1 == 1);
        let counterexamples = broken.iter().filter_map(|broken| self.record(broken)).collect();
        Findings {
            runs,
            moves,
            longest,
            given_up,
            covered: covered.map(|(situation, _)| situation).collect(),
            levels: self.levels.clone(),
            complete: self.is_complete(),
            counterexamples,
        }
    }

    fn deal(&mut self, shards: usize) -> Deal<G::Demand> {
        self.dealt(shards)
    }

    fn take(&mut self, deal: &Deal<G::Demand>, shard: usize) -> Result<(), Unsearchable> {
        self.taken(deal, shard)
    }

    fn merge(&mut self, deal: &Deal<G::Demand>, shards: &[Position<G::Demand>]) -> Result<(), Unsearchable> {
        self.merged(deal, shards)
    }

    fn replay(
        &self,
        demand: G::Demand,
        answers: &[u32],
    ) -> Result<Counterexample<G::Demand, G::Frame>, ScriptError> {
        let mishaps = answers.iter().filter(|&&answer| answer != 0).count() as u32;
        let most = mishaps.min(self.limits.max_walls);
        let Rerun { words, frames, .. } = lane::replay(&self.game, most, demand, answers)?;
        Ok(Counterexample { broken: demand, runs: 1, demand: words, frames, answers: answers.to_vec() })
    }

    fn check(&self, demand: G::Demand, section: &[u8]) -> Result<Counts, Refusal> {
        let most_mishaps = self.limits.max_walls;
        check_runs(&RunsModel { game: &self.game, most_mishaps, demand }, section)
    }
}
