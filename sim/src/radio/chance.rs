//! Chances whose outcome is a choice of an `Oracle`. Whatever is the plain case comes first: a source without answers lets
//! every message arrive.

use tautline_kernel::choice::Oracle;

use super::Problem;
use super::problem::MAX_DEVIATION_DB;

/// A probability, in millionths.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Chance(u32);

const MILLION: u32 = 1_000_000;

impl Chance {
    /// It never happens.
    pub const NEVER: Self = Self(0);

    /// The probability `p`, to the nearest millionth.
    ///
    /// # Errors
    /// [`Problem::Probability`] if `p` is not from 0 to 1.
    pub fn new(p: f64) -> Result<Self, Problem> {
        let is_probability = (0.0..=1.0).contains(&p);
        if is_probability {
            Ok(Self((p * 1e6).round() as u32))
        } else {
            Err(Problem::Probability { probability: p })
        }
    }

    /// Whether it happens this time. What never happens is not asked for.
    #[inline]
    pub fn happens(self, oracle: &mut dyn Oracle) -> bool {
        self.0 > 0 && oracle.pick(MILLION) >= MILLION - self.0
    }
}

/// A deviation in dB around 0, near to a normal one but at most three times the standard deviation: the sum of twelve
/// uniform numbers. Where the standard deviation is 0 nothing is left to chance.
pub(crate) fn deviation_db(standard_db: f64, oracle: &mut dyn Oracle) -> f64 {
    if standard_db == 0.0 {
        return 0.0;
    }
    // Whole numbers, to the last step. The plain case, twelve zeros, is to be no deviation: each number is turned by half.
    let steps: i32 = (0..12).map(|_| (oracle.pick(1 << 16) ^ (1 << 15)) as i32 - (1 << 15)).sum();
    let standard = (f64::from(steps) / 65_536.0).clamp(-MOST_DEVIATIONS, MOST_DEVIATIONS);
    standard_db * standard
}

/// No deviation has more standard deviations.
pub(super) const MOST_DEVIATIONS: f64 = 3.0;

/// `deviation_db`, if it can be a standard deviation.
pub(crate) fn checked_deviation(deviation_db: f64) -> Result<f64, Problem> {
    let fits = (0.0..=MAX_DEVIATION_DB).contains(&deviation_db);
    if fits { Ok(deviation_db) } else { Err(Problem::Deviation { deviation_db }) }
}

#[cfg(test)]
mod tests {
    use tautline_proofs::engine::{Seeded, Tape};

    use super::*;

    #[test]
    fn a_chance_happens_as_often_as_it_says() {
        let chance = Chance::new(0.1).expect("a probability");
        let mut source = Seeded::new(1, 0);
        let happened = (0..100_000).filter(|_| chance.happens(&mut source)).count();
        assert!((9_500..10_500).contains(&happened), "{happened}");
        assert!(!Chance::new(0.999).expect("a probability").happens(&mut Tape(&[])));
        assert!(Chance::new(1.0).expect("a probability").happens(&mut Tape(&[])));
        assert!(!Chance::NEVER.happens(&mut Tape(&[999_999])));
        assert!([-0.1, 1.1, f64::NAN].iter().all(|&p| Chance::new(p).is_err()));
    }

    #[test]
    fn deviations_have_their_mean_and_standard_deviation_and_an_end() {
        let mut source = Seeded::new(2, 0);
        let drawn: Vec<f64> = (0..20_000).map(|_| deviation_db(4.0, &mut source)).collect();
        let mean = drawn.iter().sum::<f64>() / 20_000.0;
        let variance = drawn.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.1 && (variance.sqrt() - 4.0).abs() < 0.1, "{mean} ± {}", variance.sqrt());
        assert!(drawn.iter().all(|one| one.abs() <= 12.0));
        assert!(deviation_db(4.0, &mut Tape(&[])).abs() < 1e-9);
    }
}
