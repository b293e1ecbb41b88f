//! Where a robot is, by the strength of the signals of anchors (Rajesh et al. 2024, 4, “Self-Localization” and
//! “Localization Error Optimization with PSO”; clauses POSITION-1 to POSITION-7).
//!
//! Each anchor gives a [`Range`]: its place, and a distance that a [`Signal`] makes of the strength with which it is
//! heard. From ranges come positions in five ways:
//!
//! - [`closed_form`]: equations (5) to (8) as they are printed, for three anchors;
//! - [`linear`]: the same for any number of anchors and for every arrangement that is not singular;
//! - [`Swarm`]: the particles of equations (9) and (10), as they are printed or with the updates in the right order;
//! - [`locate`] with [`Residual::Metres`] or [`Residual::Decibels`]: damped Gauss–Newton, which finds the minimum that
//!   the particles look for, and says how far it can be trusted: [`Fix`], [`Estimate`], [`Precision`]; [`locate_from`]
//!   for a robot that knows about where it is.
//!
//! A [`Belief`] fuses fixes with a robot's wheels; [`bound`] is the Cramér–Rao bound. Everything is a pure function of
//! numbers of 64 bits in metres and decibels, with `+ − × ÷ √` and libm's logarithms, powers and angles, so that
//! results are the same bits on every machine. A `Range` takes 24 bytes, a [`Particle`] 56, a `Belief` 72 and a `Fix`
//! at most 200; nothing else is kept from one call to the next.

mod belief;
mod bound;
mod closed_form;
mod descent;
mod linear;
mod locate;
mod normal;
mod place;
mod range;
mod signal;
mod swarm;

pub use crate::net::Propagation;
pub use belief::{Belief, Correction, Gate, Odometry, SightError, Sighting};
pub use bound::{Precision, best_three, bound};
pub use closed_form::closed_form;
pub use linear::{Layout, linear};
pub use locate::{Estimate, Fix, Flags, locate, locate_from};
pub use place::{Area, Point, SymmetricMatrix};
pub use range::{Range, Refusal, Residual, check, check_meeting, do_meet, most_error};
pub use signal::Signal;
pub use swarm::{Draws, Inertia, Order, Parameters, Particle, Swarm};
