//! Where robots are, by the strength of anchors' signals (POSITION): trials with a robot at random places, positions
//! from measured distances, and how exact they are. The kernel's rules find the positions; the analyses about them,
//! covariance, error ellipse, dilution of precision, Cramér–Rao bound and singular values, are nalgebra's.

pub mod analysis;
mod measurements;
mod meeting;
mod solver;
mod trials;

pub use measurements::{FixReport, Measurements, Place, Power};
pub use solver::{PARTICLES, Solution, Solver};
pub use trials::{Advice, Anchors, Errors, Quantiles, Report, Setting, Spot, distances};

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::position::Refusal;

/// The kernel's refusal for a person: the fault, and a hint.
pub fn refused(refusal: Refusal) -> Diagnostic {
    Diagnostic::usage(refusal, remedy(refusal))
}

/// The kernel's hint, or where it is about residuals and solutions, the [`Solver`] to choose.
fn remedy(refusal: Refusal) -> &'static str {
    match refusal {
        Refusal::Zero(_) => "give a distance above a micrometre, or `solver` least-squares",
        Refusal::Division => "name the anchors in another order, or give `solver` least-squares",
        Refusal::Anchors(_)
        | Refusal::NotFinite(_)
        | Refusal::Negative(_)
        | Refusal::Coincident { .. }
        | Refusal::Collinear
        | Refusal::Apart { .. }
        | Refusal::NoParticle
        | Refusal::NoPlace => refusal.remedy(),
    }
}
