//! Judges of counterexamples, who know no rule of the kernel and nothing of the engines that find them. Each has a file
//! of its own, written from the sentences of `SPEC.md` by std alone. A counterexample is plain data: numbers, names and
//! lists; [`change`] makes every single change of it, so that a judge can be tried.

use std::collections::BTreeSet;
use std::fmt;

pub mod chain;
pub mod change;
pub mod floor;
pub mod frontier;
pub mod kit;
pub mod mrc;
pub mod notice;
pub mod pack;
pub mod position;

use change::{Change, Plain};

/// Column and row.
pub type Place = (i32, i32);

/// East, south, west, north.
const SIDES: [Place; 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// The place one step from another; there is none through a side that there is not.
fn beside(place: Place, side: usize) -> Option<Place> {
    SIDES.get(side).map(|step| (place.0 + step.0, place.1 + step.1))
}

/// A counterexample, written down for the judge of its scheme.
pub trait Case: fmt::Debug {
    /// The clause that it is said to break.
    fn clause(&self) -> &'static str;

    /// Judges whether it is possible, whether its rule takes each step of it, and whether the last step, or the end, breaks the
    /// clause, and no earlier one.
    ///
    /// # Errors
    /// The first [`Objection`].
    fn judge(&self) -> Result<(), Objection>;
}

/// A [`Case`], whatever its type, with all that differ from it by a single change.
pub trait AnyCase: Case {
    /// What is changed, and the case with that change.
    fn changes(&self) -> Vec<(String, Box<dyn Case>)>;
}

impl<T: Case + Plain + Clone + PartialEq + 'static> AnyCase for T {
    fn changes(&self) -> Vec<(String, Box<dyn Case>)> {
        let all = change::all(self).into_iter();
        all.map(|(what, changed)| (what, Box::new(changed) as Box<dyn Case>)).collect()
    }
}

/// Why a case is no counterexample: the sentence, and the step that it is about, counted from 1; 0 for the case as a whole.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Objection {
    /// The step.
    pub at: usize,
    /// What is wrong.
    pub what: &'static str,
}

impl fmt::Display for Objection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.at {
            0 => f.write_str(self.what),
            at => write!(f, "step {at}: {}", self.what),
        }
    }
}

impl std::error::Error for Objection {}

/// An objection unless something is so.
fn must(is_so: bool, what: &'static str) -> Result<(), &'static str> {
    if is_so { Ok(()) } else { Err(what) }
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
    fn has(&self, (x, y): Place) -> bool {
        (0..self.columns).contains(&x) && (0..self.rows).contains(&y)
    }

    fn places(&self) -> impl Iterator<Item = Place> + use<B> {
        let (columns, rows) = (self.columns, self.rows);
        (0..rows).flat_map(move |y| (0..columns).map(move |x| (x, y)))
    }
}

impl Floor {
    fn is_free(&self, place: Place) -> bool {
        self.has(place) && !self.barred.contains(&place)
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
fn path(one: Place, other: Place) -> (Place, Place) {
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
