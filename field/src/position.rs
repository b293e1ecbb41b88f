//! Where robots are, by the strength of anchors' signals (POSITION): trials with a robot at random places, positions
//! from measured distances, and how exact they are. The kernel's rules find the positions; the analyses about them,
//! covariance, error ellipse, dilution of precision, Cramér–Rao bound and singular values, are nalgebra's.

pub mod analysis;
mod measured;
mod meeting;
mod solver;
mod trials;

pub use measured::{FixReport, Measurements, Place, Power};
pub use solver::{PARTICLES, Solution, Solver};
pub use trials::{Advice, Anchors, Errors, Quantiles, Report, Setting, Spot, distances};

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::position::Refusal;

/// The kernel's refusal for a person: the fault, and a hint.
pub fn refused(refusal: Refusal) -> Diagnostic {
    Diagnostic::usage(refusal, refusal.remedy())
}
