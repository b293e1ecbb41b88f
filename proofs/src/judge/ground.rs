//! Lattices and floors as judges read them.

use std::collections::BTreeSet;

use super::change::{Change, Plain};

/// Column and row.
pub type Place = (i32, i32);

/// East, south, west, north.
pub(super) const SIDES: [Place; 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// The place one step from another; there is none through a side that there is not.
pub(super) fn beside(place: Place, side: usize) -> Option<Place> {
    SIDES.get(side).map(|step| (place.0 + step.0, place.1 + step.1))
}

/// An objection unless something is so.
pub(super) fn must(is_so: bool, what: &'static str) -> Result<(), &'static str> {
    if is_so { Ok(()) } else { Err(what) }
}

/// An objection unless a step breaks the clause if it is the last one, and not before.
pub(super) fn breaks_at_last(breaks: bool, is_last: bool) -> Result<(), &'static str> {
    must(breaks == is_last, if breaks { "the clause is broken before" } else { "the clause is not broken" })
}

/// A lattice of nodes, or a floor of cells: how many columns and rows it has, and what bars the way.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Ground<B: Ord> {
    /// Columns.
    pub columns: i32,
    /// Rows.
    pub rows: i32,
    /// Walls between neighbours, or cells that an obstacle fills.
    pub barred: BTreeSet<B>,
}

/// Nodes with walls on some of the paths between neighbours, the western or northern node first.
pub type Lattice = Ground<(Place, Place)>;

/// Cells of which obstacles fill some.
pub type Floor = Ground<Place>;

impl<B: Ord> Ground<B> {
    pub(super) fn has(&self, (x, y): Place) -> bool {
        (0..self.columns).contains(&x) && (0..self.rows).contains(&y)
    }

    pub(super) fn places(&self) -> impl Iterator<Item = Place> + use<B> {
        let (columns, rows) = (self.columns, self.rows);
        (0..rows).flat_map(move |y| (0..columns).map(move |x| (x, y)))
    }
}

impl Floor {
    pub(super) fn is_free(&self, place: Place) -> bool {
        self.has(place) && !self.barred.contains(&place)
    }

    /// The cells that one can walk to from `starts`, those among them.
    pub(super) fn walkable(&self, starts: &[Place]) -> BTreeSet<Place> {
        let (mut reached, mut rim) = (BTreeSet::new(), starts.to_vec());
        while let Some(cell) = rim.pop() {
            if reached.insert(cell) {
                rim.extend((0..4).filter_map(|side| beside(cell, side)).filter(|&next| self.is_free(next)));
            }
        }
        reached
    }
}

impl Lattice {
    fn paths(&self) -> impl Iterator<Item = (Place, Place)> {
        self.places()
            .flat_map(|node| [(node, (node.0 + 1, node.1)), (node, (node.0, node.1 + 1))])
            .filter(|path| self.has(path.1))
    }
}

/// The path between two places, whichever is the first.
pub(super) fn path(one: Place, other: Place) -> (Place, Place) {
    (one.min(other), one.max(other))
}

impl Plain for Lattice {
    fn change(&mut self, change: &mut Change) {
        let all: Vec<_> = self.paths().collect();
        change.toggles("wall", &mut self.barred, &all);
        change.within("columns", &mut self.columns);
        change.within("rows", &mut self.rows);
    }
}

impl Plain for Floor {
    fn change(&mut self, change: &mut Change) {
        let all: Vec<_> = self.places().collect();
        change.toggles("obstacle", &mut self.barred, &all);
        change.within("columns", &mut self.columns);
        change.within("rows", &mut self.rows);
    }
}
