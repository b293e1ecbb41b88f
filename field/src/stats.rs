//! Means and shares with their 95 % intervals. Everything is summed exactly or in the order given, and no step but
//! division and square root rounds, so results are the same on every machine and any number of threads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The normal distribution's 97.5 % quantile.
const NORMAL: f64 = 1.959_964;

/// A mean or a share, and where 95 % of such intervals have the true one.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Estimate {
    /// How many values it is of.
    pub count: u32,
    /// The mean of the values, or the share of hits.
    pub mean: f64,
    /// The 95 % interval; one value gives none.
    pub interval: Option<[f64; 2]>,
}

impl Estimate {
    /// Of nothing at all.
    pub const NOTHING: Self = Self { count: 0, mean: 0.0, interval: None };

    /// The mean of real values, with Student's t; `None` if there are none.
    pub fn of_values(values: &[f64]) -> Option<Self> {
        let count = u32::try_from(values.len()).ok().filter(|&count| count > 0)?;
        let mean = values.iter().sum::<f64>() / f64::from(count);
        let squares = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        Some(Self::of_mean(count, mean, squares))
    }

    /// The ratio of two sums over pairs of values, the second above 0: how many times the sum of the second values the
    /// sum of the first is, by the distances of the first from so many times the second. `None` if there are none.
    pub fn of_ratio(pairs: &[(f64, f64)]) -> Option<Self> {
        let count = u32::try_from(pairs.len()).ok().filter(|&count| count > 0)?;
        let (over, under) =
            pairs.iter().fold((0.0, 0.0), |(over, under), pair| (over + pair.0, under + pair.1));
        let (ratio, mean_under) = (over / under, under / f64::from(count));
        let off = |&(over, under): &(f64, f64)| (over - ratio * under) / mean_under;
        let squares = pairs.iter().map(|pair| off(pair) * off(pair)).sum();
        (under > 0.0).then(|| Self::of_mean(count, ratio, squares))
    }

    /// How many of `count` are hits, with Wilson's interval, which stays between 0 and 1 and has a width even where all
    /// or none are; `None` if `count` is 0 or less than `hits`.
    pub fn share(hits: u32, count: u32) -> Option<Self> {
        if count == 0 || hits > count {
            return None;
        }
        let (number, share) = (f64::from(count), f64::from(hits) / f64::from(count));
        let square = NORMAL * NORMAL;
        let scale = 1.0 + square / number;
        let middle = (share + square / (2.0 * number)) / scale;
        let spread = share * (1.0 - share) / number + square / (4.0 * number * number);
        let margin = NORMAL * spread.sqrt() / scale;
        // Rounding must not leave the share itself outside.
        let interval = [(middle - margin).clamp(0.0, share), (middle + margin).clamp(share, 1.0)];
        Some(Self { count, mean: share, interval: Some(interval) })
    }

    /// The mean of `count` values from whose mean the squared distances sum up to `squares`.
    fn of_mean(count: u32, mean: f64, squares: f64) -> Self {
        let interval = (count > 1).then(|| {
            let variance = squares.max(0.0) / f64::from(count - 1);
            let margin = student(count - 1) * (variance / f64::from(count)).sqrt();
            [mean - margin, mean + margin]
        });
        Self { count, mean, interval }
    }

    /// Half the width of the interval.
    pub fn margin(self) -> Option<f64> {
        self.interval.map(|[low, high]| (high - low) / 2.0)
    }

    /// For people, with so many decimals: the mean and the interval, if there is one, by half its width, or by its ends
    /// where the mean is clearly not its middle.
    pub fn text(self, decimals: usize) -> String {
        let number = |number: f64| format!("{number:.decimals$}");
        let mean = number(self.mean);
        let Some([low, high]) = self.interval else { return mean };
        // What was rounded before may be off by half a decimal at each end, and by as much in the middle.
        let is_middle = (high + low - 2.0 * self.mean).abs() < 2.5 * 0.1_f64.powi(decimals as i32);
        if is_middle {
            format!("{mean} ± {}", number((high - low) / 2.0))
        } else {
            format!("{mean} [{}, {}]", number(low), number(high))
        }
    }

    /// As [`Self::text`], of an estimate that may be none, for which a dash stands.
    pub fn text_or_dash(estimate: Option<Self>, decimals: usize) -> String {
        estimate.map_or("-".to_owned(), |estimate| estimate.text(decimals))
    }

    /// This estimate in a unit of which `factor`, above 0, make one of the present: 100 for a share in percent.
    pub fn times(self, factor: f64) -> Self {
        let interval = self.interval.map(|bounds| bounds.map(|bound| bound * factor));
        Self { mean: self.mean * factor, interval, ..self }
    }

    /// The share of the others.
    pub fn rest(self) -> Self {
        let interval = self.interval.map(|[low, high]| [1.0 - high, 1.0 - low]);
        Self { mean: 1.0 - self.mean, interval, ..self }
    }
}

/// Exact sums over whole numbers, to be added up in any order.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Moments {
    count: u32,
    sum: i128,
    squares: u128,
}

impl Moments {
    /// One value, less than 2³² without its sign, so that no sum of such values overflows.
    pub const fn of(value: i64) -> Self {
        Self { count: 1, sum: value as i128, squares: (value.unsigned_abs() as u128).pow(2) }
    }

    /// The sums over the values of both.
    pub const fn and(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            sum: self.sum + other.sum,
            squares: self.squares + other.squares,
        }
    }

    /// Whether at most so many values, each less than 2³² without its sign, can have these sums.
    pub fn is_of_at_most(self, most: u32) -> bool {
        let (count, sum) = (u128::from(self.count), self.sum.unsigned_abs());
        let (most_sum, most_squares) = (count << 32, count << 64);
        let is_small = self.count <= most && sum <= most_sum && self.squares <= most_squares;
        is_small && sum * sum <= count * self.squares
    }

    /// How many values.
    pub const fn count(self) -> u32 {
        self.count
    }

    /// Their mean, with Student's t; `None` if there are none.
    #[expect(clippy::cast_precision_loss, reason = "one rounding each")]
    pub fn estimate(self) -> Option<Estimate> {
        let count = Some(self.count).filter(|&count| count > 0)?;
        let spread = u128::from(count) * self.squares - self.sum.unsigned_abs().pow(2);
        let number = f64::from(count);
        Some(Estimate::of_mean(count, self.sum as f64 / number, spread as f64 / number))
    }
}

/// The 97.5 % quantile of Student's t, in hundredths as tables have it: by the expansion in inverse degrees of freedom
/// (Cornish and Fisher), which from 3 on is as near as that.
fn student(degrees_of_freedom: u32) -> f64 {
    match degrees_of_freedom {
        0 | 1 => 12.71,
        2 => 4.30,
        more => {
            let part = 1.0 / f64::from(more);
            hundredths(
                NORMAL + part * (2.372_271 + part * (2.822_499 + part * (2.555_850 + part * 1.589_534))),
            )
        }
    }
}

/// The value below which a share of `sorted` lies, and its 95 % interval: the ranks between which the true one is with
/// that probability, whatever the distribution. Values that may all lie on one side of it give none. 0 of nothing.
pub fn quantile(sorted: &[f64], share: f64) -> (f64, Option<[f64; 2]>) {
    let count = f64::from(u32::try_from(sorted.len()).unwrap_or(u32::MAX));
    let at = |rank: f64| {
        let place = rank.clamp(1.0, count.max(1.0)) as usize - 1;
        sorted.get(place).copied().unwrap_or(0.0)
    };
    let margin = NORMAL * (count * share * (1.0 - share)).sqrt();
    let are_enough = libm::pow(share.max(1.0 - share), count) <= 0.025;
    let interval = || [at((count * share - margin).floor()), at((count * share + margin).ceil())];
    (at((count * share).ceil()), are_enough.then(interval))
}

/// Rounded to two decimals.
pub fn hundredths(number: f64) -> f64 {
    decimals(number, 100.0)
}

/// Rounded to a whole number of `parts` of 1.
pub fn decimals(number: f64, parts: f64) -> f64 {
    (number * parts).round() / parts
}

/// Mean and interval so rounded.
pub fn rounded(estimate: Estimate, parts: f64) -> Estimate {
    let interval = estimate.interval.map(|ends| ends.map(|end| decimals(end, parts)));
    Estimate { mean: decimals(estimate.mean, parts), interval, ..estimate }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::{Estimate, Moments, student};

    /// In ten-thousandths.
    fn rounded(number: f64) -> i32 {
        (number * 10_000.0).round() as i32
    }

    #[test]
    fn quantiles_are_those_of_the_tables() {
        let table = [
            12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160,
            2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052,
            2.048, 2.045, 2.042,
        ];
        for (degrees, quantile) in (1..).zip(table) {
            // The tables' third decimal is rounded too.
            assert!((student(degrees) - quantile).abs() <= 0.005_5, "{degrees}: {}", student(degrees));
        }
        assert_eq!([60, 199, 1_000, u32::MAX].map(student).map(rounded), [20_000, 19_700, 19_600, 19_600]);
    }

    #[test]
    fn a_few_values_have_no_interval_of_a_quantile() {
        let sorted: Vec<f64> = (1..=72).map(f64::from).collect();
        for (share, least) in [(0.5, 6), (0.95, 72)] {
            assert_eq!(super::quantile(&sorted[..least - 1], share).1, None);
            assert!(super::quantile(&sorted[..least], share).1.is_some());
        }
    }

    #[test]
    fn a_mean_of_five_values() {
        // 1, 2, 3, 4, 10: mean 4, squares 50, variance 12.5, and 2.78·√(12.5/5).
        let estimate = Estimate::of_values(&[1.0, 2.0, 3.0, 4.0, 10.0]).expect("values");
        assert_eq!((estimate.count, rounded(estimate.mean)), (5, 40_000));
        assert_eq!(estimate.interval.map(|bounds| bounds.map(rounded)), Some([-3_956, 83_956]));
        assert_eq!(estimate.times(10.0).interval.map(|bounds| bounds.map(rounded)), Some([-39_557, 839_557]));
        assert_eq!(estimate.margin().map(rounded), Some(43_956));
    }

    #[test]
    fn an_interval_is_told_by_its_ends_where_the_mean_is_not_its_middle() {
        let text = |hits, count| Estimate::share(hits, count).expect("a share").times(100.0).text(2);
        assert_eq!([text(200, 200), text(0, 1)], ["100.00 [98.12, 100.00]", "0.00 [0.00, 79.35]"]);
        let mean = Estimate::of_values(&[1.0, 2.0, 3.0, 4.0, 10.0]).expect("values");
        assert_eq!([mean.text(2), mean.text(0)], ["4.00 ± 4.40", "4 ± 4"]);
        assert_eq!(Estimate { interval: None, ..mean }.text(1), "4.0");
    }

    #[test]
    fn few_values_give_no_interval_and_none_no_mean() {
        assert_eq!(Estimate::of_values(&[]), None);
        assert_eq!(Moments::default().estimate(), None);
        assert_eq!((Estimate::share(0, 0), Estimate::share(2, 1)), (None, None));
        let one = Estimate { count: 1, mean: 7.0, interval: None };
        assert_eq!((Estimate::of_values(&[7.0]), Moments::of(7).estimate()), (Some(one), Some(one)));
    }

    #[test]
    fn a_ratio_of_sums() {
        // 12 of 8: 1.5 times, off by −1, 1 and 0, against 8/3: squares 2·(3/8)², variance half of that, 4.3·√(9/64/3).
        let ratio = Estimate::of_ratio(&[(2.0, 2.0), (4.0, 2.0), (6.0, 4.0)]).expect("pairs");
        assert_eq!((ratio.count, rounded(ratio.mean), ratio.margin().map(rounded)), (3, 15_000, Some(9_310)));
        let same = [(3.0, 1.0), (9.0, 3.0), (1.5, 0.5)];
        assert_eq!(Estimate::of_ratio(&same).and_then(Estimate::margin).map(rounded), Some(0));
        assert_eq!((Estimate::of_ratio(&[]), Estimate::of_ratio(&[(1.0, 0.0)])), (None, None));
    }

    #[test]
    fn shares_have_wilsons_intervals() {
        let bounds = |hits, count| {
            let interval = Estimate::share(hits, count).expect("a share").interval.expect("an interval");
            interval.map(rounded)
        };
        assert_eq!(bounds(0, 10), [0, 2_775]);
        assert_eq!(bounds(10, 10), [7_225, 10_000]);
        assert_eq!(bounds(5, 10), [2_366, 7_634]);
        assert_eq!(bounds(1, 1), [2_065, 10_000]);
        assert_eq!(bounds(100, 200), [4_314, 5_686]);
        let rest = Estimate::share(10, 10).expect("a share").rest();
        assert_eq!((rounded(rest.mean), rest.interval.map(|ends| ends.map(rounded))), (0, Some([0, 2_775])));
    }

    proptest! {
        #[test]
        fn sums_of_whole_numbers_say_the_same_in_any_order(
            values in prop::collection::vec(-5_000..5_000_i32, 1..40),
            cut in any::<prop::sample::Index>(),
        ) {
            let sums = |values: &[i32]| {
                values.iter().map(|&value| Moments::of(value.into())).fold(Moments::default(), Moments::and)
            };
            let (left, right) = values.split_at(cut.index(values.len()));
            prop_assert_eq!(sums(right).and(sums(left)), sums(&values));
            let reals: Vec<f64> = values.iter().copied().map(f64::from).collect();
            let whole = sums(&values).estimate().expect("values");
            let real = Estimate::of_values(&reals).expect("values");
            prop_assert!((whole.mean - real.mean).abs() < 1e-9);
            prop_assert_eq!(whole.interval.is_some(), values.len() > 1);
            prop_assert!((whole.margin().unwrap_or(0.0) - real.margin().unwrap_or(0.0)).abs() < 1e-6);
        }

        #[test]
        fn the_largest_values_do_not_overflow(count in 1..u32::MAX, value in -4_294_967_295..=4_294_967_295_i64) {
            let many = Moments {
                count,
                sum: i128::from(count) * i128::from(value),
                squares: u128::from(count) * Moments::of(value).squares,
            };
            let estimate = many.estimate().expect("values");
            prop_assert_eq!(estimate.mean.round() as i64, value);
            prop_assert_eq!(rounded(estimate.margin().unwrap_or(0.0)), 0);
        }

        #[test]
        fn a_share_is_in_its_interval(count in 1..10_000_u32, part in 0.0..=1.0_f64) {
            let estimate = Estimate::share((part * f64::from(count)) as u32, count).expect("a share");
            let [low, high] = estimate.interval.expect("an interval");
            prop_assert!(0.0 <= low && low <= estimate.mean && estimate.mean <= high && high <= 1.0 && low < high);
        }
    }
}
