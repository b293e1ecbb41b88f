//! The paper's claims about TAN and its rivals, and what is so.

use super::super::prelude::*;
use super::{Density, Way};

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
    pub const ALL: [Self; 4] =
        [Self::CloseToVerma, Self::ShorterThanVerma, Self::SmallerThanReich, Self::LikeReich];

    /// Whom TAN is compared with.
    pub const fn rival(self) -> Way {
        match self {
            Self::CloseToVerma | Self::ShorterThanVerma => Way::Verma,
            Self::SmallerThanReich | Self::LikeReich => Way::Reich,
        }
    }

    /// Whether it is so if it is so in one case.
    const fn is_of_some(self) -> bool {
        match self {
            Self::SmallerThanReich => true,
            Self::CloseToVerma | Self::ShorterThanVerma | Self::LikeReich => false,
        }
    }

    /// The verdicts on it at all densities, or whether it is so at one of them, or in one topology.
    pub(super) fn judged(self, densities: &[Density]) -> Vec<Judgement> {
        let decisions = densities.iter().filter_map(|density| {
            let decision = density.claims.iter().find(|decision| decision.paper == self);
            decision.map(|decision| (density, decision))
        });
        let less = |decision: &Decision| {
            format!("TAN less {} {}", self.rival().word(), text(decision.difference, 2))
        };
        let of = |density: &Density| counted(density.nodes as u32, "node");
        if !self.is_of_some() {
            let judged = |(density, decision): (&Density, &Decision)| {
                Judgement::new(self.words(), of(density), less(decision), decision.verdict)
            };
            return decisions.map(judged).collect();
        }
        let in_mean =
            decisions.clone().map(|(_, decision)| decision.verdict).fold(Verdict::Fails, Verdict::or);
        let mean = |decision: &Decision| decision.difference.map_or(f64::INFINITY, |less| less.mean);
        let least = decisions.min_by(|(_, one), (_, other)| mean(one).total_cmp(&mean(other)));
        let least = least.map_or_else(String::new, |(density, decision)| {
            format!("{} at {}, the least", less(decision), of(density))
        });
        let shares = densities.iter().filter_map(|density| density.shorter_than_reich);
        let most = shares.max_by(|one, other| one.mean.total_cmp(&other.mean));
        let is_any = most.is_some_and(|share| share.mean > 0.0);
        vec![
            Judgement::new(self.words(), "in the mean, at some number of nodes", least, in_mean),
            Judgement::new(
                self.words(),
                "in some topology",
                format!("so in at most {} % of them", percent(most, 1)),
                Verdict::decided(is_any, false),
            ),
        ]
    }

    /// In words, with the section.
    pub const fn words(self) -> &'static str {
        match self {
            Self::CloseToVerma => "RD “very close to position-based Verma's scheme” (4.3)",
            Self::ShorterThanVerma => "“shorter moving distance … than Verma's scheme” (4.4)",
            Self::SmallerThanReich => "RD “smaller … than positionless Reich's scheme for some cases” (4.3)",
            Self::LikeReich => "“about the same moving distance … as Reich's scheme” (4.4)",
        }
    }

    /// The verdict by the interval of TAN's RD less the rival's.
    pub fn verdict(self, difference: Option<Estimate>) -> Verdict {
        let Some([low, high]) = difference.and_then(|difference| difference.interval) else {
            return Verdict::Open;
        };
        let (holds, fails) = match self {
            Self::CloseToVerma | Self::LikeReich => {
                (low >= -CLOSE && high <= CLOSE, low > CLOSE || high < -CLOSE)
            }
            Self::ShorterThanVerma | Self::SmallerThanReich => (high < 0.0, low > 0.0),
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
        assert_eq!(verdicts(-0.05, -0.01), [Holds, Holds, Holds, Holds]);
        assert_eq!(verdicts(-0.05, 0.05), [Holds, Open, Open, Holds]);
        assert_eq!(verdicts(0.05, 0.15), [Open, Fails, Fails, Open]);
        assert_eq!(verdicts(0.4, 0.5), [Fails, Fails, Fails, Fails]);
        assert_eq!(verdicts(-0.5, -0.4), [Fails, Holds, Holds, Fails]);
        assert_eq!(Claim::ALL.map(|claim| claim.verdict(None)), [Open; 4]);
    }
}
