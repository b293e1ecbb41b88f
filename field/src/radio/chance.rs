//! Chances whose outcome is a choice of an `Oracle`. Whatever is the plain case comes first: a source without answers
//! lets every message arrive.

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

/// `deviation_db`, if it can be a standard deviation.
pub(crate) fn checked_deviation(deviation_db: f64) -> Result<f64, Problem> {
    let fits = (0.0..=MAX_DEVIATION_DB).contains(&deviation_db);
    if fits { Ok(deviation_db) } else { Err(Problem::Deviation { deviation_db }) }
}

#[cfg(test)]
mod tests {
    use tautline_proofs::engine::{SeededOracle, Tape};

    use super::*;

    #[test]
    fn a_chance_happens_as_often_as_it_says() {
        let chance = Chance::new(0.1).expect("a probability");
        let mut source = SeededOracle::new(1, 0);
        let happened = (0..100_000).filter(|_| chance.happens(&mut source)).count();
        assert!((9_500..10_500).contains(&happened), "{happened}");
        assert!(!Chance::new(0.999).expect("a probability").happens(&mut Tape(&[])));
        assert!(Chance::new(1.0).expect("a probability").happens(&mut Tape(&[])));
        assert!(!Chance::NEVER.happens(&mut Tape(&[999_999])));
        assert!([-0.1, 1.1, f64::NAN].iter().all(|&p| Chance::new(p).is_err()));
    }
}
