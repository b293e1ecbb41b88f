//! A search dealt out among shards, for those who have many machines. Its small levels are searched by the dealer; each
//! of the others is begun, until it is in many parts, and the parts are dealt out by how much is expected to be left of
//! each. A shard searches its parts as a search of its own, which can be left and taken up again. What all shards count
//! together is what one search counts.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use serde::{Deserialize, Serialize};

use super::count::Count;
use super::forecast::{self, Forecast};
use super::lane::{Lane, Place};
use super::search::{Position, Tree, Ways};
use super::share::Share;
use super::{Game, Level, Unsearchable};
use crate::engine::watchdog::Steps;

/// A part is at most so small a share of what a shard has, so that what is not foreseen of one is made up for by
/// others.
const PARTS: u64 = 96;

/// Team moves that are made in a part that is too large, before it is looked for places to divide it.
const MOVES: u64 = 64;

/// A level of fewer team moves is not dealt out.
const WORTH_DEALING: f64 = 1e5;

/// Nor is one of fewer team moves if there are too few levels yet to tell the others.
const WORTH_TELLING: f64 = 1e7;

/// A search dealt out among shards.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Deal<D> {
    /// The levels that are done.
    levels: Vec<Level>,
    /// The counts of the others.
    begun: Vec<Level>,
    /// All levels, as they are known or expected.
    expected: Vec<Level>,
    /// The counts of all levels.
    count: Count<D>,
    shards: Vec<Ways>,
    /// About how many team moves each shard has.
    left: Vec<u64>,
}

impl<D> Deal<D> {
    /// About how many team moves each shard has.
    pub fn left(&self) -> &[u64] {
        &self.left
    }

    /// Team moves that are counted already.
    pub const fn moves(&self) -> u64 {
        self.count.moves
    }
}

/// How much is left of all these parts.
fn total(parts: &[(u64, Place)]) -> u128 {
    parts.iter().map(|&(left, _)| u128::from(left)).sum()
}

impl<G: Game> Tree<G> {
    pub(super) fn dealt(&mut self, shards: usize) -> Deal<G::Demand> {
        let (edges, last) = (self.game.edges(), self.limits.max_walls as usize);
        let is_small = |levels: &[Level]| {
            let worth = if levels.len() < forecast::TELLING { WORTH_TELLING } else { WORTH_DEALING };
            forecast::next(levels, edges).is_none_or(|moves| moves < worth)
        };
        while is_small(&self.levels) && self.goes_on() {}
        let mut deal = Deal {
            levels: self.levels.clone(),
            begun: Vec::new(),
            expected: forecast::levels(&self.levels, edges, self.limits.max_walls),
            count: Count::default(),
            shards: vec![vec![Vec::new(); self.levels.len()]; shards],
            left: vec![0; shards],
        };
        let forecast = Forecast::new(&deal.expected);
        self.shard = Some((Vec::new(), deal.expected.clone()));
        let mut parts = Vec::new();
        for walls in self.levels.len()..=last {
            let before = (self.count.runs, self.count.moves);
            let most = deal.expected[walls].moves / (shards as u64 * PARTS).max(1);
            let level = self.divided(walls, &forecast, most);
            let (runs, moves) = (self.count.runs - before.0, self.count.moves - before.1);
            // How parts compare is known better than how much they are together: that the level tells.
            let (due, sum) = (deal.expected[walls].moves.saturating_sub(moves), total(&level));
            let scaled = |left: u64| (u128::from(left) * u128::from(due) / sum.max(1)) as u64;
            parts.extend(level.into_iter().map(|(left, place)| (scaled(left), walls, place)));
            deal.begun.push(Level { runs, moves });
        }
        self.lanes.clear();
        deal.count = self.count.clone();
        largest_first(&mut parts);
        deal.shards.iter_mut().for_each(|ways| ways.resize(last + 1, Vec::new()));
        let mut least: BinaryHeap<Reverse<(u64, usize)>> =
            (0..shards).map(|shard| Reverse((0, shard))).collect();
        for (left, walls, place) in parts {
            let Some(mut first) = least.peek_mut() else { break };
            let Reverse((sum, shard)) = &mut *first;
            *sum = sum.saturating_add(left);
            deal.left[*shard] = *sum;
            deal.shards[*shard][walls].push(place);
        }
        deal
    }

    /// A level in parts, of which no more than `most` is left unless they cannot be divided; and how much is left of
    /// each.
    fn divided(&mut self, walls: usize, forecast: &Forecast, most: u64) -> Vec<(u64, Place)> {
        let mut parts = Vec::new();
        let (mut large, steps) = (vec![Lane::whole(&self.game, walls as u32)], Steps::begin());
        while let Some(mut lane) = large.pop() {
            self.count.made = 0;
            lane.search(&self.game, (MOVES, u64::MAX), &steps, &mut self.count);
            while lane.left(forecast) > most
                && let Some(part) = lane.split()
            {
                large.push(part);
            }
            match lane.left(forecast) {
                _ if !lane.has_more() => {}
                left if left > most => large.push(lane),
                left => parts.push((left, lane.place())),
            }
        }
        parts
    }

    pub(super) fn taken(&mut self, deal: &Deal<G::Demand>, shard: usize) -> Result<(), Unsearchable> {
        let ways = deal.shards.get(shard).ok_or(Unsearchable::Foreign)?;
        let last = self.limits.max_walls as usize;
        let gets_there = |(walls, places): (usize, &Vec<Place>)| {
            places.iter().all(|place| Lane::at(&self.game, walls as u32, place).is_some())
        };
        if ways.len() != last + 1 || !ways.iter().enumerate().all(gets_there) {
            return Err(Unsearchable::Foreign);
        }
        self.shard = Some((ways.clone(), deal.expected.clone()));
        self.levels.clear();
        (self.count, self.before) = (Count::default(), 0);
        self.lanes.clear();
        self.begin();
        self.end_levels();
        Ok(())
    }

    pub(super) fn merged(
        &mut self,
        deal: &Deal<G::Demand>,
        shards: &[Position<G::Demand>],
    ) -> Result<(), Unsearchable> {
        let levels = self.limits.max_walls as usize + 1;
        let is_whole = |shard: &Position<_>| {
            shard.lanes.is_empty() && shard.levels.len() == levels && shard.count.follows(&shard.levels, 0)
        };
        let is_dealt = deal.levels.len() + deal.begun.len() == levels && shards.len() == deal.shards.len();
        if !is_dealt || !shards.iter().all(is_whole) {
            return Err(Unsearchable::Foreign);
        }
        self.levels = [&deal.levels[..], &deal.begun].concat();
        self.count = deal.count.clone();
        for Position { levels, count, .. } in shards {
            self.count.add(count.clone());
            for (sum, level) in self.levels.iter_mut().zip(levels) {
                sum.runs += level.runs;
                sum.moves += level.moves;
            }
        }
        self.lanes.clear();
        if !self.count.follows(&self.levels, 0) || !self.records(&self.count) {
            return Err(Unsearchable::Foreign);
        }
        let is_all = self.count.searched == Share::WHOLE.times(levels as u32);
        if is_all { Ok(()) } else { Err(Unsearchable::Short) }
    }
}

/// Brings parts in order: those with most left first, and of equals those with fewer walls.
fn largest_first(parts: &mut [(u64, usize, Place)]) {
    parts.sort_by_key(|&(left, walls, _)| (Reverse(left), walls));
}
