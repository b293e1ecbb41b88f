//! Means, shares and ratios of what runs give, and their texts.

use tautline_field::stats::{Estimate, rounded};

/// The mean of values, if there are any.
pub(super) fn mean(values: impl IntoIterator<Item = f64>) -> Option<Estimate> {
    Estimate::of_values(&values.into_iter().collect::<Vec<_>>())
}

/// The ratio of the sums of pairs, in ten-thousandths, if there are any.
pub(super) fn ratio(pairs: impl IntoIterator<Item = (f64, f64)>) -> Option<Estimate> {
    let ratio = Estimate::of_ratio(&pairs.into_iter().collect::<Vec<_>>())?;
    Some(rounded(ratio, 1e4))
}

/// Seconds.
#[expect(clippy::cast_precision_loss, reason = "no run takes 2⁵³ milliseconds")]
pub(super) const fn seconds(milliseconds: u64) -> f64 {
    milliseconds as f64 / 1000.0
}

/// How many are such.
pub(super) fn count<T>(all: impl IntoIterator<Item = T>, is_such: impl Fn(T) -> bool) -> u32 {
    all.into_iter().filter_map(|one| is_such(one).then_some(())).count() as u32
}

/// The share of those that are such, if there are any.
pub(super) fn share<T>(
    all: impl IntoIterator<Item = T, IntoIter: ExactSizeIterator>,
    is_such: impl Fn(T) -> bool,
) -> Option<Estimate> {
    let all = all.into_iter();
    let of = all.len() as u32;
    Estimate::share(count(all, is_such), of)
}

/// The 95 % interval of an estimate, if it has one.
pub(super) fn ends(estimate: Option<Estimate>) -> Option<[f64; 2]> {
    estimate.and_then(|estimate| estimate.interval)
}

/// An estimate for people, with so many decimals; a dash for none.
pub(super) fn text(estimate: impl Into<Option<Estimate>>, decimals: usize) -> String {
    Estimate::text_or_dash(estimate.into(), decimals)
}

/// A number for people, with so many decimals; a dash for none.
pub(super) fn plain(number: impl Into<Option<f64>>, decimals: usize) -> String {
    number.into().map_or("-".to_owned(), |number| format!("{number:.decimals$}"))
}

/// A share for people, in percent; a dash for none.
pub(super) fn percent(share: impl Into<Option<Estimate>>, decimals: usize) -> String {
    text(share.into().map(|share| share.times(100.0)), decimals)
}
