//! Judges of runs, who know the sentences of `SPEC.md` and std: floors, steps, reach, sight and joint ways are their
//! own, and they share no code with the rules, the searches and the simulator.

mod chain;
mod controls;
mod frontier;
mod kit;
mod pack;

use std::collections::BTreeSet;

pub(crate) use chain::{Chain, Trouble};
pub(crate) use frontier::Frontier;
pub(crate) use kit::{Drive, Kit};
pub(crate) use pack::Pack;

/// Column and row.
pub(crate) type Place = (i32, i32);

/// A broken clause, and how it is broken.
pub(crate) type BrokenClause = (&'static str, String);

/// East, south, west, north.
const SIDES: [Place; 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

fn add(place: Place, step: Place) -> Place {
    (place.0 + step.0, place.1 + step.1)
}

/// The ground truth.
#[derive(Clone, Debug)]
pub(crate) struct Floor {
    pub(crate) columns: i32,
    pub(crate) rows: i32,
    /// The cells that an obstacle fills.
    pub(crate) blocked: BTreeSet<Place>,
    /// The sides with a wall, the lesser cell first.
    pub(crate) walls: BTreeSet<(Place, Place)>,
}

impl Floor {
    fn has(&self, (x, y): Place) -> bool {
        (0..self.columns).contains(&x) && (0..self.rows).contains(&y)
    }

    fn is_free(&self, place: Place) -> bool {
        self.has(place) && !self.blocked.contains(&place)
    }

    /// Whether a robot can cross the side between two cells.
    fn is_open(&self, one: Place, other: Place) -> bool {
        self.is_free(one) && self.is_free(other) && !self.walls.contains(&(one.min(other), one.max(other)))
    }

    /// The cells across open sides.
    fn beside(&self, place: Place) -> impl Iterator<Item = Place> {
        SIDES.into_iter().map(move |side| add(place, side)).filter(move |&to| self.is_open(place, to))
    }

    /// The cells that can be walked to.
    fn walkable(&self, starts: &[Place]) -> BTreeSet<Place> {
        let mut reached: BTreeSet<Place> = starts.iter().copied().collect();
        let mut rim = starts.to_vec();
        while let Some(place) = rim.pop() {
            rim.extend(self.beside(place).filter(|&to| reached.insert(to)));
        }
        reached
    }

    /// The first robot that goes where it cannot go in one step.
    fn leaps(&self, before: &[Place], after: &[Place]) -> Option<usize> {
        (0..after.len()).find(|&robot| {
            let (from, to) = (before[robot], after[robot]);
            !self.is_free(to) || from != to && !self.beside(from).any(|beside| beside == to)
        })
    }
}

/// The clause is broken if this is so.
fn broken(is_broken: bool, clause: &'static str, how: impl FnOnce() -> String) -> Result<(), BrokenClause> {
    if is_broken { Err((clause, how())) } else { Ok(()) }
}
