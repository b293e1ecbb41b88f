//! The paper's claims about TAN and its rivals, and what is so.

use super::super::prelude::*;
use super::world::Way;

/// A claim of the paper about RD.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Claim {
    /// “Very close to position-based Verma's scheme” (4.3).
    CloseToVerma,
    /// “Shorter moving distance … than Verma's scheme” (4.4, Table 2).
    ShorterThanVerma,
    /// “Smaller RD than positionless Reich's scheme for some cases” (4.3).
    SmallerThanReich,
    /// “About the same moving distance … as Reich's scheme” (4.4).
    LikeReich,
    /// Sheu's robot “needs to move back and forth, which wastes time and energy” (2.1): it walks farther than TAN's.
    ShorterThanSheu,
}

/// A claim with its verdict.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Decision {
    /// The paper's.
    pub paper: Claim,
    /// RD of TAN less that of the rival.
    pub difference: Option<Estimate>,
    /// The verdict on the claim.
    pub verdict: Verdict,
}

/// How far two RD may be from each other to be close: a tenth of the shortest way. The paper gives no number.
pub(super) const CLOSE: f64 = 0.1;

impl Claim {
    /// All, in the order of every table.
    pub const ALL: [Self; 5] = [
        Self::CloseToVerma,
        Self::ShorterThanVerma,
        Self::SmallerThanReich,
        Self::LikeReich,
        Self::ShorterThanSheu,
    ];

    /// Whom TAN is compared with.
    pub const fn rival(self) -> Way {
        match self {
            Self::CloseToVerma | Self::ShorterThanVerma => Way::Verma,
            Self::SmallerThanReich | Self::LikeReich => Way::Reich,
            Self::ShorterThanSheu => Way::Sheu,
        }
    }

    /// Whether it is so if it is so in one case.
    pub(super) const fn is_of_some(self) -> bool {
        match self {
            Self::SmallerThanReich => true,
            Self::CloseToVerma | Self::ShorterThanVerma | Self::LikeReich | Self::ShorterThanSheu => false,
        }
    }

    /// In words, with the section.
    pub const fn words(self) -> &'static str {
        match self {
            Self::CloseToVerma => "RD “very close to position-based Verma's scheme” (4.3)",
            Self::ShorterThanVerma => "“shorter moving distance … than Verma's scheme” (4.4)",
            Self::SmallerThanReich => "RD “smaller … than positionless Reich's scheme for some cases” (4.3)",
            Self::LikeReich => "“about the same moving distance … as Reich's scheme” (4.4)",
            Self::ShorterThanSheu => {
                "Sheu's robot “needs to move back and forth, which wastes time and energy” (2.1): RD, against TAN's"
            }
        }
    }

    /// The verdict by the interval of TAN's RD less the rival's.
    pub fn verdict(self, difference: Option<Estimate>) -> Verdict {
        let Some([low, high]) = ends(difference) else {
            return Verdict::Open;
        };
        let (holds, fails) = match self {
            Self::CloseToVerma | Self::LikeReich => {
                (low >= -CLOSE && high <= CLOSE, low > CLOSE || high < -CLOSE)
            }
            Self::ShorterThanVerma | Self::SmallerThanReich | Self::ShorterThanSheu => {
                (high < 0.0, low > 0.0)
            }
        };
        Verdict::decided(holds, fails)
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict::{Fails, Holds, Open};
    use super::*;

    #[test]
    fn a_claim_is_decided_by_the_whole_interval() {
        let verdicts = |low: f64, high: f64| {
            let difference = Estimate { count: 9, mean: low, interval: Some([low, high]) };
            Claim::ALL.map(|claim| claim.verdict(Some(difference)))
        };
        assert_eq!(verdicts(-0.05, -0.01), [Holds, Holds, Holds, Holds, Holds]);
        assert_eq!(verdicts(-0.05, 0.05), [Holds, Open, Open, Holds, Open]);
        assert_eq!(verdicts(0.05, 0.15), [Open, Fails, Fails, Open, Fails]);
        assert_eq!(verdicts(0.4, 0.5), [Fails, Fails, Fails, Fails, Fails]);
        assert_eq!(verdicts(-0.5, -0.4), [Fails, Holds, Holds, Fails, Holds]);
        assert_eq!(Claim::ALL.map(|claim| claim.verdict(None)), [Open; 5]);
    }
}
