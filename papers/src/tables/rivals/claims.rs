//! The paper's claims about the chain and its rivals, and what is so.

use super::super::prelude::*;
use tautline_field::stats::quantile;

/// How far from a figure “about” is: a quarter of it. The paper gives no number.
const ABOUT: f64 = 0.25;

/// How far from each other “almost the same” and “similar” are: a tenth.
const ALIKE: f64 = 0.1;

/// Whether a figure is about `paper`, by its whole 95 % interval.
pub(super) fn about(paper: f64, ours: Option<[f64; 2]>) -> Verdict {
    within([(1.0 - ABOUT) * paper, (1.0 + ABOUT) * paper], ours)
}

/// Whether a figure and `other` are alike, by the whole 95 % interval of the first.
pub(super) fn alike(other: f64, ours: Option<[f64; 2]>) -> Verdict {
    within([(1.0 - ALIKE) * other, other / (1.0 - ALIKE)], ours)
}

/// On how many of the same layouts one team is sooner than another; a team that never gets there is later than any.
#[derive(Clone, Copy, PartialEq, Debug, Default, JsonSchema, Serialize)]
pub(super) struct Race {
    sooner: u32,
    later: u32,
    even: u32,
    /// The first's team moves less the other's, if both get there on every layout: the mean, in hundredths.
    difference: Option<Estimate>,
    /// How many times the other's team moves the first takes, where one of them gets there: the median, in hundredths.
    /// Never is so many team moves as no run makes.
    ratio: Option<Estimate>,
}

/// The number of team moves that stands for never, and a ratio that is larger than any of two others.
const NEVER: f64 = u32::MAX as f64;
const EVER: f64 = 1e5;

/// How many times as many team moves, with the 95 % interval; ∞ where one team never gets there.
pub(super) fn or_never(times: f64, ends: Option<[f64; 2]>) -> String {
    let text = |times: f64| if times > EVER { "∞".to_owned() } else { format!("{times:.2}") };
    let ends = ends.map_or_else(String::new, |[low, high]| format!(" [{}, {}]", text(low), text(high)));
    text(times) + &ends
}

impl Race {
    pub(super) fn of(pairs: impl Iterator<Item = (Option<u32>, Option<u32>)>) -> Self {
        let (mut race, mut ratios, mut differences) = (Self::default(), Vec::new(), Some(Vec::new()));
        for (one, other) in pairs {
            let [one_is, other_is] = [one, other].map(|moves| moves.map_or(NEVER, f64::from));
            match one_is.total_cmp(&other_is) {
                std::cmp::Ordering::Less => race.sooner += 1,
                std::cmp::Ordering::Greater => race.later += 1,
                std::cmp::Ordering::Equal => race.even += 1,
            }
            match (one.and(other), &mut differences) {
                (Some(_), Some(differences)) => differences.push(one_is - other_is),
                _ => differences = None,
            }
            if one.or(other).is_some() {
                ratios.push(one_is / other_is.max(1.0));
            }
        }
        ratios.sort_by(f64::total_cmp);
        let (median, interval) = quantile(&ratios, 0.5);
        let ratio = Estimate { count: ratios.len() as u32, mean: median, interval };
        let difference = differences.and_then(mean).map(|difference| rounded(difference, 100.0));
        Self { difference, ratio: (ratio.count > 0).then(|| rounded(ratio, 100.0)), ..race }
    }

    /// Whether the first is sooner: in the mean if both get there on every layout, or else more often than not.
    pub(super) fn is_won(self) -> Verdict {
        match ends(self.difference) {
            Some([low, high]) => Verdict::decided(high < 0.0, low > 0.0),
            None => is_most(self.sooner, self.later),
        }
    }

    /// Whether the first is later, in the same way.
    pub(super) fn is_lost(self) -> Verdict {
        self.is_won().contrary()
    }

    /// Whether both are alike.
    pub(super) fn is_alike(self) -> Verdict {
        alike(1.0, ends(self.ratio))
    }

    pub(super) fn text(self) -> String {
        let ratio = match self.ratio {
            None => "-".to_owned(),
            Some(Estimate { mean, interval, .. }) if interval.map_or(mean, |[_, high]| high) > EVER => {
                or_never(mean, interval)
            }
            Some(ratio) => ratio.text(2),
        };
        let by =
            self.difference.map_or_else(String::new, |difference| format!("by {}; ", difference.text(1)));
        format!("{by}{ratio} times; sooner {}, even {}, later {}", self.sooner, self.even, self.later)
    }
}

/// Whether these are more than the others, by the whole 95 % interval of their share.
fn is_most(these: u32, others: u32) -> Verdict {
    let share = Estimate::share(these, these + others);
    let [low, high] = share.and_then(|share| share.interval).unwrap_or([0.0, 1.0]);
    Verdict::decided(low > 0.5, high < 0.5)
}

#[cfg(test)]
mod tests {
    use super::Verdict::{Fails, Holds, Open};
    use super::*;

    #[test]
    fn a_race_is_won_by_the_whole_interval_and_who_never_arrives_is_last() {
        let race = |sooner, later| Race { sooner, later, even: 3, ..Race::default() };
        let all = [race(60, 20), race(20, 60), race(5, 4), race(0, 0)];
        assert_eq!(all.map(Race::is_won), [Holds, Fails, Open, Open]);
        assert_eq!(all.map(Race::is_lost), [Fails, Holds, Open, Open]);
        let pairs = [(Some(3), None), (None, Some(3)), (None, None), (Some(2), Some(3)), (Some(2), Some(2))];
        let race = Race::of(pairs.into_iter());
        assert_eq!((race.sooner, race.later, race.even, race.difference), (2, 1, 2, None));
        assert_eq!(race.ratio, Some(Estimate { count: 4, mean: 0.67, interval: None }));
    }

    #[test]
    fn where_both_always_get_there_the_mean_difference_decides_and_not_who_is_sooner_more_often() {
        let race = |moves: [u32; 10]| Race::of(moves.into_iter().map(|moves| (Some(100), Some(moves))));
        let rare = race([99, 99, 99, 99, 99, 99, 400, 400, 99, 99]);
        assert_eq!((rare.later, rare.is_won(), rare.is_lost()), (8, Open, Open));
        let all = [race([110; 10]), race([90; 10]), race([100; 10])];
        assert_eq!(all.map(Race::is_won), [Holds, Fails, Open]);
        assert_eq!(all.map(Race::is_lost), [Fails, Holds, Open]);
    }

    #[test]
    fn teams_are_alike_by_the_whole_interval_of_the_ratio_of_their_moves() {
        let is_alike = |other: Option<u32>, runs| Race::of((0..runs).map(|_| (Some(90), other))).is_alike();
        let all = [Some(100), Some(81), Some(101), Some(80), None];
        assert_eq!(all.map(|other| is_alike(other, 6)), [Holds, Holds, Fails, Fails, Fails]);
        assert_eq!(all.map(|other| is_alike(other, 5)), [Open; 5]);
        let halves = (0..40).map(|run| (Some(90), Some(if run % 2 == 0 { 90 } else { 120 })));
        assert_eq!(Race::of(halves).is_alike(), Open);
        assert_eq!(Race::of([(None, None); 40].into_iter()).is_alike(), Open);
    }

    #[test]
    fn about_is_a_quarter() {
        let all = [[1.5, 2.5], [1.4, 2.5], [2.6, 3.0], [0.5, 1.4]];
        assert_eq!(all.map(|ends| about(2.0, Some(ends))), [Holds, Open, Fails, Fails]);
        assert_eq!(about(2.0, None), Open);
    }
}
