//! Judges of counterexamples, who know no rule of the kernel and nothing of the engines that find them. Each has a
//! file of its own, written from the sentences of `SPEC.md` by std alone. A counterexample is plain data: numbers,
//! names and lists; [`change`] makes every single change of it, so that a judge can be tried.

use std::fmt;

#[cfg(feature = "rooms")]
pub mod chain;
pub mod change;
#[cfg(feature = "rooms")]
pub mod floor;
#[cfg(feature = "rooms")]
pub mod frontier;
#[cfg(feature = "rooms")]
mod ground;
#[cfg(feature = "rooms")]
pub mod kit;
#[cfg(feature = "rooms")]
pub mod marks;
#[cfg(feature = "rooms")]
pub mod mrc;
#[cfg(feature = "rooms")]
pub mod notice;
#[cfg(feature = "rooms")]
pub mod pack;
#[cfg(feature = "rooms")]
pub mod position;

use change::Plain;
#[cfg(feature = "rooms")]
pub use ground::{Floor, Ground, Lattice, Place};
#[cfg(feature = "rooms")]
use ground::{SIDES, beside, breaks_at_last, must, path};

/// A counterexample, written down for the judge of its scheme.
pub trait Case: fmt::Debug {
    /// The clause that it is said to break.
    fn clause(&self) -> &'static str;

    /// The noun for a step of it.
    fn step(&self) -> &'static str {
        "step"
    }

    /// Judges whether it is possible, whether its rule takes each step of it, and whether the last step, or the end,
    /// breaks the clause, and no earlier one.
    ///
    /// # Errors
    /// The first [`Objection`].
    fn judge(&self) -> Result<(), Objection>;
}

/// A [`Case`], whatever its type, with all that differ from it by a single change.
pub trait AnyCase: Case {
    /// The part that is changed, and the case with that change.
    fn changes(&self) -> Vec<(String, Box<dyn Case>)>;
}

impl<T: Case + Plain + Clone + PartialEq + 'static> AnyCase for T {
    fn changes(&self) -> Vec<(String, Box<dyn Case>)> {
        let all = change::all(self).into_iter();
        all.map(|(what, changed)| (what, Box::new(changed) as Box<dyn Case>)).collect()
    }
}

/// Why a case is no counterexample: the sentence, and the step that it is about, counted from 1; 0 for the case as a
/// whole.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Objection {
    /// The step.
    pub at: usize,
    /// The sentence.
    pub what: &'static str,
}

impl Objection {
    /// In words, where a step is called this.
    pub fn of(self, step: &str) -> String {
        match self.at {
            0 => self.what.to_owned(),
            at => format!("{step} {at}: {}", self.what),
        }
    }
}

/// About the case as a whole.
impl From<&'static str> for Objection {
    fn from(what: &'static str) -> Self {
        Self { at: 0, what }
    }
}

impl fmt::Display for Objection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.of("step"))
    }
}

impl std::error::Error for Objection {}
