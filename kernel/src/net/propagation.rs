//! Distance from signal strength [Jiang 2011, equation (1)]: P_rcv = P_tx·(C_1/D)^α·C_2. Powers matter
//! beside each other only, so that P_tx, C_1 and C_2 cancel out: at distance D a signal is (L/D)^α times as
//! strong as at L. With L the range, that is how much stronger it is than what can just be heard; its level
//! is ten times the logarithm of it, in dB.
//!
//! The exponent α is any number from 2 to 5, so this needs logarithms and powers of fractions: those of libm, whose
//! results are the same on every machine.

/// How the power of a signal falls with the distance.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Propagation {
    exponent: f64,
}

impl Propagation {
    /// That of free space: α is 2.
    pub const FREE_SPACE: Self = Self { exponent: 2.0 };

    /// `None` unless 2 ≤ α ≤ 5.
    pub fn new(exponent: f64) -> Option<Self> {
        (2.0..=5.0).contains(&exponent).then_some(Self { exponent })
    }

    /// α.
    pub const fn exponent(self) -> f64 {
        self.exponent
    }

    /// How much stronger a signal is at `distance_m` than at `range_m`, in dB: 10·α·log₁₀(L/D). Both are positive.
    pub fn level_db(self, range_m: f64, distance_m: f64) -> f64 {
        10.0 * self.exponent * libm::log10(range_m / distance_m)
    }

    /// How many times as far a signal comes that is stronger by `level_db`, the
    /// reverse: D is L over this, if that is its level.
    pub fn times_as_far(self, level_db: f64) -> f64 {
        libm::pow(10.0, level_db / (10.0 * self.exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn propagation(exponent: f64) -> Propagation {
        Propagation::new(exponent).expect("an exponent of the paper")
    }

    #[test]
    fn a_level_is_the_ratio_of_two_powers_of_equation_1() {
        let (power_mw, reference_m, factor) = (0.8, 0.125, 1.6);
        for exponent in [2.0, 2.7, 3.5, 5.0] {
            let received_mw =
                |distance_m: f64| power_mw * libm::pow(reference_m / distance_m, exponent) * factor;
            for distance_m in [0.001, 1.0, 12.345_678, 25.0, 4_000.0] {
                let ratio_db = 10.0 * libm::log10(received_mw(distance_m) / received_mw(25.0));
                let level_db = propagation(exponent).level_db(25.0, distance_m);
                assert!((level_db - ratio_db).abs() < 1e-9, "{level_db} dB, not {ratio_db}");
            }
        }
    }

    #[test]
    fn a_signal_tells_the_distance_that_it_came_from() {
        for exponent in [2.0, 2.7, 3.5, 5.0] {
            let propagation = propagation(exponent);
            for distance_um in [1, 1_000, 999_999, 12_345_678, 25_000_000, 4_000_000_000] {
                let level_db = propagation.level_db(25.0, f64::from(distance_um) / 1e6);
                let told = (25e6 / propagation.times_as_far(level_db) + 0.5) as u32;
                assert!(told.abs_diff(distance_um) <= 1, "{distance_um} µm, read as {told}");
            }
        }
    }

    #[test]
    fn what_is_no_exponent_of_the_paper_makes_no_propagation() {
        assert!(
            [1.9, 5.1, f64::NAN, f64::INFINITY].iter().all(|&exponent| Propagation::new(exponent).is_none())
        );
        assert_eq!(Propagation::new(2.0), Some(Propagation::FREE_SPACE));
    }
}
