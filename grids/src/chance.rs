//! Whatever is left to chance in runs and layouts: dice, how likely something is, and the noise of a measurement, such
//! as the level of a radio signal.

use std::fmt;
use std::str::FromStr;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::number::Number;
use tautline_kernel::choice::Oracle;

/// Dice that fall the same for the same seed and tag on every machine: `ChaCha8`, seeded with the seed in the first
/// eight bytes, little-endian, the tag in the next eight and zeros in the rest.
#[derive(Clone, Debug)]
pub struct Dice(ChaCha8Rng);

impl Dice {
    /// The dice of whatever `tag` names.
    pub fn new(seed: u64, tag: [u8; 8]) -> Self {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        bytes[8..16].copy_from_slice(&tag);
        Self(ChaCha8Rng::from_seed(bytes))
    }

    /// A number below `n`: the high half of n times 64 random bits.
    #[inline]
    pub fn below(&mut self, n: u64) -> u64 {
        ((u128::from(self.0.next_u64()) * u128::from(n)) >> 64) as u64
    }
}

impl Oracle for Dice {
    #[inline]
    fn pick(&mut self, below: u32) -> u32 {
        self.below(below.into()) as u32
    }
}

const MILLION: u32 = 1_000_000;
const TWO_TO_THE_53: f64 = 9_007_199_254_740_992.0;

/// A number from 0 to 1.
#[derive(Clone, Copy, PartialEq, Debug, Default, JsonSchema, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Probability(f64);

impl Probability {
    /// The probability `p`, if it is one.
    pub const fn new(p: f64) -> Option<Self> {
        if 0.0 <= p && p <= 1.0 { Some(Self(p)) } else { None }
    }

    /// The probability of what never happens.
    pub const NEVER: Self = Self(0.0);

    /// The probability of what always happens.
    pub const ALWAYS: Self = Self(1.0);

    /// Whether it never happens.
    pub fn is_never(self) -> bool {
        self == Self::NEVER
    }

    /// Whether it always happens.
    pub fn is_certain(self) -> bool {
        self.0 >= 1.0
    }

    /// Draws once: 53 random bits are compared with p·2⁵³, which is exact.
    pub fn happens(self, dice: &mut Dice) -> bool {
        let threshold = (self.0 * TWO_TO_THE_53) as u64;
        dice.0.next_u64() >> 11 < threshold
    }

    /// Asks `oracle` whether it happens this time, to the nearest millionth. The plain case comes first: where nobody
    /// answers, it does not happen. What never happens is not asked for.
    #[inline]
    pub fn is_picked(self, oracle: &mut dyn Oracle) -> bool {
        let millionths = (self.0 * f64::from(MILLION)).round() as u32;
        millionths > 0 && oracle.pick(MILLION) >= MILLION - millionths
    }
}

fn no_probability(p: &str) -> Diagnostic {
    Diagnostic::usage(format!("{p:?} is no probability"), "write a number from 0 to 1, for example 0.1")
}

impl FromStr for Probability {
    type Err = Diagnostic;

    fn from_str(p: &str) -> Result<Self, Diagnostic> {
        p.parse().ok().and_then(Self::new).ok_or_else(|| no_probability(p))
    }
}

impl TryFrom<f64> for Probability {
    type Error = String;

    fn try_from(p: f64) -> Result<Self, String> {
        Self::new(p).ok_or_else(|| no_probability(&Number(p).to_string()).what().to_owned())
    }
}

impl From<Probability> for f64 {
    fn from(Probability(p): Probability) -> Self {
        p
    }
}

impl fmt::Display for Probability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Number(self.0).fmt(f)
    }
}

/// A deviation around 0 in the unit of its standard deviation, near to a normal one but at most three times the
/// standard deviation: the sum of twelve uniform numbers. Where the standard deviation is 0 nothing is left to chance.
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
    use super::*;

    /// Gives one answer alone.
    struct Always(u32);

    impl Oracle for Always {
        fn pick(&mut self, _: u32) -> u32 {
            self.0
        }
    }

    #[test]
    fn a_probability_is_picked_as_often_as_it_says() {
        let of = |p| Probability::new(p).expect("a probability");
        let mut source = Dice::new(1, *b"chance  ");
        let picked = (0..100_000).filter(|_| of(0.1).is_picked(&mut source)).count();
        assert!((9_500..10_500).contains(&picked), "{picked}");
        assert!(!of(0.999).is_picked(&mut Always(0)));
        assert!(of(1.0).is_picked(&mut Always(0)));
        assert!(!Probability::NEVER.is_picked(&mut Always(999_999)));
        assert!([-0.1, 1.1, f64::NAN].iter().all(|&p| Probability::new(p).is_none()));
    }

    #[test]
    fn deviations_have_their_mean_and_standard_deviation_and_an_end() {
        let mut source = Dice::new(2, *b"chance  ");
        let drawn: Vec<f64> = (0..20_000).map(|_| deviation(4.0, &mut source)).collect();
        let mean = drawn.iter().sum::<f64>() / 20_000.0;
        let variance = drawn.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.1 && (variance.sqrt() - 4.0).abs() < 0.1, "{mean} ± {}", variance.sqrt());
        assert!(drawn.iter().all(|one| one.abs() <= 12.0));
        assert!(deviation(4.0, &mut Always(0)).abs() < 1e-9);
    }
}
