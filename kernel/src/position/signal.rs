//! How strength tells a distance, and how wrong: log-distance path loss with normal noise in decibels.

use crate::net::Propagation;

/// Path loss with its exponent, and the standard deviation of the noise.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Signal {
    propagation: Propagation,
    noise_db: f64,
    decibels: f64,
}

/// The greatest standard deviation of the noise, in dB.
const MOST_NOISE_DB: f64 = 100.0;

impl Signal {
    /// The path loss of `propagation` with noise of this standard deviation; `None` unless it is from 0 to 100 dB.
    pub fn new(propagation: Propagation, noise_db: f64) -> Option<Self> {
        let decibels = 10.0 * propagation.exponent() * core::f64::consts::LOG10_E;
        (0.0..=MOST_NOISE_DB).contains(&noise_db).then_some(Self { propagation, noise_db, decibels })
    }

    /// The path loss.
    pub const fn propagation(&self) -> Propagation {
        self.propagation
    }

    /// The standard deviation of the noise, in dB.
    pub const fn noise_db(&self) -> f64 {
        self.noise_db
    }

    /// The decibels by which the level falls when the distance grows by the factor e.
    pub const fn decibels(&self) -> f64 {
        self.decibels
    }

    /// The standard deviation of the logarithm of a distance: about how wrong it is in proportion.
    pub const fn relative_error(&self) -> f64 {
        self.noise_db / self.decibels
    }

    /// The level at `distance_m`, in dB above that at one metre.
    pub fn level_db(&self, distance_m: f64) -> f64 {
        self.propagation.level_db(1.0, distance_m)
    }

    /// The distance at which the level is so many dB above that at one metre, in metres: the reverse.
    pub fn distance_m(&self, level_db: f64) -> f64 {
        self.propagation.times_as_far(-level_db)
    }
}
