//! The noise of a measurement, such as the level of a radio signal, drawn from an [`Oracle`].

use tautline_kernel::choice::Oracle;

/// A deviation around 0 in the unit of its standard deviation, near to a normal one but at most three times the standard deviation: the sum of twelve
/// uniform numbers. Where the standard deviation is 0 nothing is left to chance.
pub fn deviation(standard: f64, oracle: &mut dyn Oracle) -> f64 {
    if standard == 0.0 {
        return 0.0;
    }
    // Whole numbers, to the last step. The plain case, twelve zeros, is to be no deviation: each number is turned by
    // half.
    let steps: i32 = (0..12).map(|_| (oracle.pick(1 << 16) ^ (1 << 15)) as i32 - (1 << 15)).sum();
    let drawn = (f64::from(steps) / 65_536.0).clamp(-MOST_DEVIATIONS, MOST_DEVIATIONS);
    standard * drawn
}

/// No deviation has more standard deviations.
pub const MOST_DEVIATIONS: f64 = 3.0;

#[cfg(test)]
mod tests {
    use tautline_proofs::engine::{SeededOracle, Tape};

    use super::*;

    #[test]
    fn deviations_have_their_mean_and_standard_deviation_and_an_end() {
        let mut source = SeededOracle::new(2, 0);
        let drawn: Vec<f64> = (0..20_000).map(|_| deviation(4.0, &mut source)).collect();
        let mean = drawn.iter().sum::<f64>() / 20_000.0;
        let variance = drawn.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.1 && (variance.sqrt() - 4.0).abs() < 0.1, "{mean} ± {}", variance.sqrt());
        assert!(drawn.iter().all(|one| one.abs() <= 12.0));
        assert!(deviation(4.0, &mut Tape(&[])).abs() < 1e-9);
    }
}
