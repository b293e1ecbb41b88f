//! The id of a clause that a run can break, whoever wrote it.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Deserializer, Serialize};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::ledger;

/// An id such as `CHAIN-1`: a family and a number, of letters, digits and hyphens. Ids are ordered by family, then by
/// number, so that `CHAIN-2` comes before `CHAIN-12`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Serialize)]
pub struct ClauseId(&'static str);

/// The ids and the names of rules that were read in files of other programs. A file names few, and they are kept as
/// long as the process.
static READ: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());

/// A word that was read, kept once.
pub(super) fn kept(word: &str) -> &'static str {
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    let known = read.get(word).copied();
    known.unwrap_or_else(|| {
        let kept: &'static str = Box::leak(word.into());
        read.insert(kept);
        kept
    })
}

impl ClauseId {
    /// The clause with this id.
    pub const fn new(id: &'static str) -> Self {
        Self(id)
    }

    /// The id as it is printed and stored.
    pub const fn as_str(self) -> &'static str {
        self.0
    }

    /// The sentence of the clause, if it is one of this program.
    pub fn sentence(self) -> Option<&'static str> {
        ledger::clauses().find(|clause| clause.id == self.0).map(|clause| clause.sentence)
    }

    /// The clause with the id that stands in a file.
    pub(crate) fn read(id: &str) -> Self {
        Self(kept(id))
    }

    /// The family, and the number if there is one.
    fn parts(self) -> (&'static str, Option<u32>) {
        let numbered =
            self.0.rsplit_once('-').and_then(|(family, number)| Some((family, number.parse().ok()?)));
        numbered.map_or((self.0, None), |(family, number)| (family, Some(number)))
    }
}

impl Ord for ClauseId {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.parts(), self.0).cmp(&(other.parts(), other.0))
    }
}

impl PartialOrd for ClauseId {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Display for ClauseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

impl fmt::Debug for ClauseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

/// Whether a run can break it, a catalogue says.
impl<'de> Deserialize<'de> for ClauseId {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(Self::read(&String::deserialize(deserializer)?))
    }
}

impl From<Breach> for ClauseId {
    fn from(breach: Breach) -> Self {
        Self(breach.clause())
    }
}

/// The clauses that are broken, in this order.
pub(super) fn broken<const N: usize>(clauses: [(bool, ClauseId); N]) -> Vec<ClauseId> {
    clauses.into_iter().filter_map(|(is_broken, clause)| is_broken.then_some(clause)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clauses_are_ordered_by_their_numbers() {
        let mut ids = ["CHAIN-12", "CHAIN", "CHAIN-2", "BRICKS-6", "A-B-10", "A-B-9"].map(ClauseId::new);
        ids.sort();
        assert_eq!(
            ids.map(ClauseId::as_str),
            ["A-B-9", "A-B-10", "BRICKS-6", "CHAIN", "CHAIN-2", "CHAIN-12"]
        );
    }

    #[test]
    fn an_id_that_was_read_is_kept_once() {
        let once = ClauseId::read("PAIR-1");
        let again = ClauseId::read("PAIR-1");
        assert_eq!(once, ClauseId::new("PAIR-1"));
        assert!(std::ptr::eq(once.as_str(), again.as_str()));
    }
}
