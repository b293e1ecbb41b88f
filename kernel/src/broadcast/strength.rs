//! Distance from signal strength (paper 003, equation (1)): P_rcv = P_tx·(C_1/D)^α·C_2. The exponent α is any number
//! from 2 to 5, so this needs a power function of fractions: that of libm, whose results are the same on every
//! machine.

/// How the power of a signal falls with the distance.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Propagation {
    power_mw: f64,
    reference_m: f64,
    factor: f64,
    exponent: f64,
}

impl Propagation {
    /// P_tx in milliwatts, C_1 in metres, C_2 without unit, and α. `None` unless the first three are positive and finite
    /// and 2 ≤ α ≤ 5.
    pub fn new(power_mw: f64, reference_m: f64, factor: f64, exponent: f64) -> Option<Self> {
        let is_positive = |number: f64| number.is_finite() && number > 0.0;
        let fits =
            [power_mw, reference_m, factor].into_iter().all(is_positive) && (2.0..=5.0).contains(&exponent);
        fits.then_some(Self { power_mw, reference_m, factor, exponent })
    }

    /// P_rcv in milliwatts at `distance_m`. `None` unless the distance is positive and finite.
    pub fn received_mw(&self, distance_m: f64) -> Option<f64> {
        let is_distance = distance_m.is_finite() && distance_m > 0.0;
        is_distance
            .then(|| self.power_mw * libm::pow(self.reference_m / distance_m, self.exponent) * self.factor)
    }

    /// D in micrometres of a signal of `received_mw`, rounded to the nearest. What is farther than the largest number is
    /// there. `None` unless the power is positive and finite.
    pub fn distance_um(&self, received_mw: f64) -> Option<u32> {
        let is_power = received_mw.is_finite() && received_mw > 0.0;
        let ratio = self.power_mw * self.factor / received_mw;
        is_power.then(|| libm::round(1e6 * self.reference_m * libm::pow(ratio, 1.0 / self.exponent)) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_signal_tells_the_distance_that_it_came_from() {
        for exponent in [2.0, 2.7, 3.5, 5.0] {
            let propagation = Propagation::new(1.0, 0.125, 1.6, exponent).expect("an exponent of the paper");
            for distance_um in [1, 1_000, 999_999, 12_345_678, 25_000_000, 4_000_000_000] {
                let received = propagation.received_mw(f64::from(distance_um) / 1e6).expect("a distance");
                let told = propagation.distance_um(received).expect("a power");
                assert!(told.abs_diff(distance_um) <= 1, "{distance_um} µm, read as {told}");
            }
        }
    }

    #[test]
    fn what_is_no_power_and_no_distance_tells_nothing() {
        let propagation = Propagation::new(1.0, 1.0, 1.0, 2.0).expect("an exponent of the paper");
        for nothing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(propagation.distance_um(nothing), None);
            assert_eq!(propagation.received_mw(nothing), None);
            assert_eq!(Propagation::new(nothing, 1.0, 1.0, 2.0), None);
        }
        assert_eq!(propagation.distance_um(1e-300), Some(u32::MAX));
        assert!(
            [1.9, 5.1, f64::NAN].iter().all(|&exponent| Propagation::new(1.0, 1.0, 1.0, exponent).is_none())
        );
    }
}
