//! A search, level by level and wave by wave.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use serde::{Deserialize, Serialize};

use super::count::{Count, DemandRuns, Violation};
use super::forecast::Forecast;
use super::lane::{self, Lane, Place, Rerun};
use super::share::Share;
use super::{Counterexample, Game, Level, Limits, Unsearchable};
use crate::engine::watchdog::Steps;
use crate::engine::{Until, threads};

/// For each number of walls, from none on, the places where a search begins.
pub(super) type Ways = Vec<Vec<Place>>;

/// Where a search is. Read back, it goes on from here and comes out as if it had never been interrupted.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Position<D> {
    pub(super) levels: Vec<Level>,
    pub(super) count: Count<D>,
    pub(super) lanes: Vec<Place>,
}

impl<D> Position<D> {
    /// The numbers of walls that are done.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }
}

/// Lanes of a search, if they have room: many more than threads, so that none is idle for long.
const LANES: u64 = 512;

/// Lanes for each share of a wave, so that a share whose first lane ends has another one.
const LANES_OF_SHARE: usize = 2;

/// Team moves of a share in one wave where a level has enough left.
const MOST: u64 = 1 << 12;

/// Team moves of a share where a level begins or ends, so that it is soon shared out and no share runs out before the
/// others.
const LEAST: u64 = 1 << 6;

/// How many times the team moves that it may make are left in a share, as far as that is known: some have less.
const RESERVE: u64 = 2;

/// Bytes that the lanes may need.
const MEMORY: u64 = 1 << 30;

/// Numbers of walls, from none on, whose runs a resumed search counts again, to see that it is of the same rule.
const COUNTED_AGAIN: usize = 2;

/// The tree of runs of a game.
pub struct Tree<G: Game> {
    pub(super) game: G,
    pub(super) limits: Limits,
    most_lanes: usize,
    /// The levels that are done.
    pub(super) levels: Vec<Level>,
    pub(super) count: Count<G::Demand>,
    /// Team moves that were counted when the search was taken up.
    pub(super) before: u64,
    /// The lanes left of this level.
    pub(super) lanes: Vec<Lane<G>>,
    /// Team moves that the shares of the last wave made.
    pub(super) wave: Vec<u64>,
    /// If this is the search of a shard: where it begins at each level, and the levels as they are known or expected.
    pub(super) shard: Option<(Ways, Vec<Level>)>,
}

/// The first lanes, in their order, in shares in each of which enough is left that it can make `moves`: how many lanes
/// each has. There are at most `most` shares; `left` says how much is left of each lane. If there is not enough for
/// any, all are in one.
fn share_out(left: &[u64], moves: u64, most: usize) -> Vec<usize> {
    let enough = RESERVE * moves;
    let mut shares = Vec::new();
    let (mut lanes, mut sum) = (0, 0);
    for left in left {
        lanes += 1;
        sum += enough.min(*left);
        if sum >= enough && shares.len() < most {
            shares.push(lanes);
            (lanes, sum) = (0, 0);
        }
    }
    if shares.is_empty() { vec![left.len()] } else { shares }
}

/// Bytes that a lane may need: every fork of a run reveals an edge.
fn lane_bytes<G: Game>(game: &G) -> u64 {
    u64::from(game.edges().max(1)) * Lane::<G>::FORK_BYTES as u64
}

impl<G: Game> Tree<G> {
    /// The search of `game` within `limits`, at its start.
    ///
    /// # Errors
    /// [`Unsearchable`] if the limits are beyond what can be searched.
    pub fn new(game: G, limits: &Limits) -> Result<Self, Unsearchable> {
        let (edges, max_walls) = (game.edges(), limits.max_walls);
        if max_walls > edges {
            return Err(Unsearchable::TooManyWalls { max_walls, edges });
        }
        let bytes = lane_bytes(&game);
        if bytes > MEMORY {
            return Err(Unsearchable::TooLarge { bytes, most: MEMORY });
        }
        let lanes = vec![Lane::whole(&game, 0)];
        Ok(Self {
            game,
            limits: *limits,
            most_lanes: (MEMORY / bytes).min(LANES) as usize,
            levels: Vec::new(),
            count: Count::default(),
            before: 0,
            lanes,
            wave: Vec::new(),
            shard: None,
        })
    }

    /// The lanes with which a level begins.
    fn first_lanes(&self, walls: u32) -> Vec<Lane<G>> {
        match &self.shard {
            None => vec![Lane::whole(&self.game, walls)],
            Some((ways, _)) => {
                let places = ways.get(walls as usize).into_iter().flatten();
                places.filter_map(|place| Lane::at(&self.game, walls, place)).collect()
            }
        }
    }

    /// Begins the next level, if there is one.
    pub(super) fn begin(&mut self) {
        let walls = self.levels.len() as u32;
        if walls <= self.limits.max_walls {
            self.lanes.extend(self.first_lanes(walls));
        }
    }

    /// Ends the levels of which nothing is left, and begins the next.
    pub(super) fn end_levels(&mut self) {
        while self.lanes.is_empty() && self.levels.len() <= self.limits.max_walls as usize {
            let done = |of: fn(&Level) -> u64| self.levels.iter().map(of).sum::<u64>();
            self.levels.push(Level {
                runs: self.count.runs - done(|level| level.runs),
                moves: self.count.moves - done(|level| level.moves),
            });
            self.begin();
        }
    }

    /// Whether the runs of the first levels are as many as `position` says: whether it is of the same rule.
    pub(super) fn counts_again(&mut self, position: &Position<G::Demand>) -> bool {
        let Some(max_walls) = (position.levels.len().min(COUNTED_AGAIN) as u32).checked_sub(1) else {
            return true;
        };
        let first = Limits { max_walls, budget_moves: None, until: Until::Exhausted };
        let limits = std::mem::replace(&mut self.limits, first);
        self.levels.clear();
        (self.count, self.before) = (Count::default(), 0);
        self.lanes = vec![Lane::whole(&self.game, 0)];
        while self.goes_on() {}
        self.limits = limits;
        position.levels.starts_with(&self.levels)
    }

    /// Whether all of the levels that were begun has been searched, but for what is left; `is_at_end` says that no
    /// other level was begun than those that are done.
    pub(super) fn has_searched_the_rest(&self, is_at_end: bool) -> bool {
        let left =
            |lanes: &[Lane<G>], sum| lanes.iter().fold(sum, |sum: Share, lane| sum.and(lane.share_left()));
        let begun = self.levels.len() as u32 + u32::from(!is_at_end);
        let all = (0..begun).fold(Share::NONE, |sum, walls| left(&self.first_lanes(walls), sum));
        left(&self.lanes, self.count.searched) == all
    }

    fn is_over(&self) -> bool {
        let is_wanted = |broken: &DemandRuns<_>| self.game.wanted().contains(&broken.demand);
        let is_settled = self.limits.until == Until::Violation && self.count.broken.iter().any(is_wanted);
        is_settled || self.lanes.is_empty() || self.affordable_moves() == 0
    }

    /// Team moves that may still be made.
    fn affordable_moves(&self) -> u64 {
        let made = self.count.moves - self.before;
        self.limits.budget_moves.map_or(u64::MAX, |budget| budget.saturating_sub(made))
    }

    /// Searches a little further. Returns whether there is more to do, and to spend.
    pub(super) fn goes_on(&mut self) -> bool {
        if self.is_over() {
            return false;
        }
        self.search();
        self.end_levels();
        !self.is_over()
    }

    /// Splits lanes, shares them out, those with most left first, searches each share a little further, and forgets the
    /// lanes that are done.
    fn search(&mut self) {
        let budget = self.affordable_moves();
        let left = self.split();
        let mut lanes: Vec<(u64, &mut Lane<G>)> = left.into_iter().zip(&mut self.lanes).collect();
        lanes.sort_by_key(|&(left, _)| Reverse(left));
        let (left, mut lanes): (Vec<u64>, Vec<&mut Lane<G>>) = lanes.into_iter().unzip();
        let most = self.most_lanes.div_ceil(LANES_OF_SHARE);
        let mut moves = MOST;
        while moves > LEAST && share_out(&left, moves, most).len() < most {
            moves /= 2;
        }
        let affordable = (budget / moves).max(1) as usize;
        let mut rest = &mut lanes[..];
        let mut shares = Vec::new();
        for length in share_out(&left, moves, most).into_iter().take(affordable) {
            let (share, others) = rest.split_at_mut(length);
            shares.push(share);
            rest = others;
        }
        let game = &self.game;
        let counts = threads::each(shares, |share| {
            let (steps, mut count) = (Steps::begin(), Count::default());
            for lane in share {
                lane.search(game, (moves, budget), &steps, &mut count);
            }
            count
        });
        self.wave = counts.iter().map(|count| count.made).collect();
        for count in counts {
            self.count.add(count);
        }
        self.lanes.retain(Lane::has_more);
    }

    /// Splits the lanes with most left, until there are as many as there may be. About how much is left of each.
    fn split(&mut self) -> Vec<u64> {
        let known = self.shard.as_ref().map_or(&self.levels, |(_, levels)| levels);
        let forecast = Forecast::new(known);
        let mut left: Vec<u64> = self.lanes.iter().map(|lane| lane.left(&forecast)).collect();
        let mut most: BinaryHeap<(u64, usize)> = left.iter().copied().zip(0..).collect();
        while self.lanes.len() < self.most_lanes
            && let Some((_, place)) = most.pop()
        {
            let Some(part) = self.lanes[place].split() else { continue };
            left[place] = self.lanes[place].left(&forecast);
            left.push(part.left(&forecast));
            most.push((left[place], place));
            most.push((left[self.lanes.len()], self.lanes.len()));
            self.lanes.push(part);
        }
        left
    }

    /// Whether every smallest run breaks its demand again.
    pub(super) fn records(&self, count: &Count<G::Demand>) -> bool {
        count.broken.iter().all(|broken| self.record(broken).is_some())
    }

    /// The smallest run that breaks a demand again; `None` if it does not.
    pub(super) fn record(
        &self,
        broken: &DemandRuns<G::Demand>,
    ) -> Option<Counterexample<G::Demand, G::Frame>> {
        let Violation { mishaps, steps, answers } = &broken.smallest;
        let again = lane::replay(&self.game, *mishaps, broken.demand, answers).ok()?;
        let (runs, answers) = (broken.runs, answers.clone());
        let Rerun { words, frames, .. } = again;
        (again.steps == *steps).then_some(Counterexample {
            broken: broken.demand,
            runs,
            demand: words,
            frames,
            answers,
        })
    }
}
