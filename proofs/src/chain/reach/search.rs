//! The exact reach: all configurations are gone through.

use std::collections::VecDeque;

use tautline_kernel::chain::{Condition, Rule};

use super::cells::CellSet;
use super::ground::Ground;
use super::limits::{MAX_PLACES, TooLarge};
use super::relation::{Followers, Relation};

impl Ground {
    /// The cells that the chain can reach under `rule`: every configuration is looked at.
    ///
    /// # Errors
    /// [`TooLarge`] if there are too many.
    pub fn reachable(&self, rule: &Rule) -> Result<CellSet, TooLarge> {
        let walkable = self.bits(&self.walkable())?;
        let reached = Search::new(self, rule)?.run(|reached| reached == walkable);
        Ok(CellSet::of_bits(self.area(), reached))
    }

    /// Whether the chain can reach any of the cells `wanted` under `rule`; ends as soon as it does.
    ///
    /// # Errors
    /// [`TooLarge`] if there are too many configurations.
    pub fn reaches_any(&self, rule: &Rule, wanted: &CellSet) -> Result<bool, TooLarge> {
        // Nothing is searched for cells that cannot even be walked to.
        let wanted = self.bits(wanted)? & self.bits(&self.walkable())?;
        Ok(wanted != 0 && Search::new(self, rule)?.run(|reached| reached & wanted != 0) & wanted != 0)
    }
}

/// The search through all configurations.
struct Search {
    relation: Relation,
    visited: VisitedSet,
}

/// The configurations that were met.
struct VisitedSet {
    /// By follower and cell: what it adds to the index of the followers' place; none where the follower cannot be.
    strides: Vec<Vec<Option<u32>>>,
    /// By place: the leader's cells seen, and those of them not yet moved on from.
    seen: Vec<u128>,
    pending: Vec<u128>,
    work: VecDeque<(u32, Followers)>,
    /// Where some robot was.
    reached: u128,
}

impl Search {
    fn new(ground: &Ground, rule: &Rule) -> Result<Self, TooLarge> {
        let relation = Relation::new(ground, rule)?;
        let (mut strides, mut places) = (Vec::with_capacity(relation.followers), 1);
        for follower in 0..relation.followers {
            // By SafeAhead a robot is at most one column and row from the one behind.
            let reach = if rule.has(Condition::SafeAhead) { follower as u16 + 1 } else { u16::MAX };
            let mut place = 0;
            let stride = ground.area().cells().map(|cell| {
                let (dx, dy) = ground.base().apart(cell);
                (dx.max(dy) <= reach).then(|| {
                    place += 1;
                    (place - 1) * places
                })
            });
            strides.push(stride.collect());
            places *= place;
            if places as usize > MAX_PLACES {
                return Err(TooLarge::Places);
            }
        }
        let visited = VisitedSet {
            strides,
            seen: vec![0; places as usize],
            pending: vec![0; places as usize],
            work: VecDeque::new(),
            reached: 0,
        };
        Ok(Self { relation, visited })
    }

    /// The cells that some robot has been in when `is_enough` says so of them, or when there are no more.
    fn run(self, is_enough: impl Fn(u128) -> bool) -> u128 {
        let Self { relation, mut visited } = self;
        let (start, leader) = relation.start();
        visited.add(&relation, &start, 1 << leader);
        while let Some((place, from)) = visited.work.pop_front() {
            if is_enough(visited.reached) {
                break;
            }
            let leaders = std::mem::take(&mut visited.pending[place as usize]);
            relation.moves(&from, leaders, &mut |to, led| visited.add(&relation, to, led));
        }
        visited.reached
    }
}

impl VisitedSet {
    /// Notes the configurations with the leader in any of `leaders`.
    fn add(&mut self, relation: &Relation, followers: &Followers, leaders: u128) {
        let parts = followers.iter().zip(&self.strides).map(|(&cell, strides)| strides[usize::from(cell)]);
        let Some(place) = parts.sum::<Option<u32>>() else { return };
        let new = leaders & !self.seen[place as usize];
        if new == 0 {
            return;
        }
        self.seen[place as usize] |= new;
        if self.pending[place as usize] == 0 {
            self.work.push_back((place, *followers));
        }
        self.pending[place as usize] |= new;
        self.reached |= relation.cells(followers) | new;
    }
}
