//! The paper's claims about the chain and its rivals, and what is so.

use super::super::prelude::*;

/// How far from a figure “about” is: a quarter of it. The paper gives no number.
const ABOUT: f64 = 0.25;

/// How far from each other “almost the same” and “similar” are: a tenth.
const ALIKE: f64 = 0.1;

/// Whether `ours` is about `paper`; of no figure it is not.
pub(super) fn about(paper: f64, ours: Option<f64>) -> Verdict {
    Verdict::of(ours.is_some_and(|ours| (ours - paper).abs() <= ABOUT * paper))
}

/// Whether two figures are alike; if there is one only, they are not.
pub(super) fn alike(one: Option<f64>, other: Option<f64>) -> Verdict {
    match (one, other) {
        (Some(one), Some(other)) => Verdict::of((one - other).abs() <= ALIKE * one.max(other)),
        (None, None) => Verdict::Open,
        (Some(_), None) | (None, Some(_)) => Verdict::Fails,
    }
}

/// On how many of the same layouts one team is sooner than another; a team that never gets there is later than any.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize)]
pub(super) struct Race {
    pub(super) sooner: u32,
    pub(super) later: u32,
    pub(super) even: u32,
}

impl Race {
    pub(super) fn of(pairs: impl Iterator<Item = (Option<u32>, Option<u32>)>) -> Self {
        pairs.fold(Self::default(), |mut race, (one, other)| {
            let late = |moves: Option<u32>| moves.map_or(u64::MAX, u64::from);
            match late(one).cmp(&late(other)) {
                std::cmp::Ordering::Less => race.sooner += 1,
                std::cmp::Ordering::Greater => race.later += 1,
                std::cmp::Ordering::Equal => race.even += 1,
            }
            race
        })
    }

    /// Whether the first is sooner more often than not, by the whole 95 % interval.
    pub(super) fn is_won(self) -> Verdict {
        let share = Estimate::share(self.sooner, self.sooner + self.later);
        let [low, high] = share.and_then(|share| share.interval).unwrap_or([0.0, 1.0]);
        Verdict::decided(low > 0.5, high < 0.5)
    }

    pub(super) fn text(self) -> String {
        format!("sooner {}, even {}, later {}", self.sooner, self.even, self.later)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_race_is_won_by_the_whole_interval_and_who_never_arrives_is_last() {
        let race = |sooner, later| Race { sooner, later, even: 3 };
        assert_eq!(race(60, 20).is_won(), Verdict::Holds);
        assert_eq!(race(20, 60).is_won(), Verdict::Fails);
        assert_eq!([race(5, 4).is_won(), race(0, 0).is_won()], [Verdict::Open; 2]);
        let pairs = [(Some(3), None), (None, Some(3)), (None, None), (Some(2), Some(3)), (Some(2), Some(2))];
        assert_eq!(Race::of(pairs.into_iter()), Race { sooner: 2, later: 1, even: 2 });
    }

    #[test]
    fn about_is_a_quarter_and_alike_a_tenth() {
        assert_eq!(
            [1.5, 2.5, 1.4, 2.6].map(|ours| about(2.0, Some(ours)) == Verdict::Holds),
            [true, true, false, false]
        );
        assert_eq!(about(2.0, None), Verdict::Fails);
        assert_eq!(alike(Some(90.0), Some(100.0)), Verdict::Holds);
        assert_eq!([alike(Some(89.0), Some(100.0)), alike(None, Some(1.0))], [Verdict::Fails; 2]);
    }
}
