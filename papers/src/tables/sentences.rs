//! The sentences of papers beside a table, each with its verdict: one shape and one printer for every table.

use schemars::JsonSchema;
use serde::Serialize;
use tautline_field::stats::Estimate;
use tautline_io::text_table::{Align, TextTable};

/// A sentence of a paper, and what is so.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Judgement {
    /// Its words, shortened, and where they stand.
    pub sentence: String,
    /// Of what it is measured, such as a density, an area, a rule.
    pub of: String,
    /// The measured numbers.
    pub measured: String,
    /// Whether it is so.
    pub verdict: Verdict,
}

impl Judgement {
    /// The verdict on a sentence.
    pub(super) fn new(
        sentence: impl Into<String>,
        of: impl Into<String>,
        measured: impl Into<String>,
        verdict: Verdict,
    ) -> Self {
        Self { sentence: sentence.into(), of: of.into(), measured: measured.into(), verdict }
    }
}

/// The verdict on a sentence of a paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It is so, and where there is an interval, its whole says so.
    Holds,
    /// The contrary is so.
    Fails,
    /// The runs do not tell.
    Open,
}

impl Verdict {
    /// Whether it is so, where the runs tell.
    pub(super) const fn of(is_so: bool) -> Self {
        Self::decided(is_so, !is_so)
    }

    /// Whether the runs say so, or else the contrary.
    pub(super) const fn decided(is_so: bool, is_not: bool) -> Self {
        match (is_so, is_not) {
            (true, _) => Self::Holds,
            (false, true) => Self::Fails,
            (false, false) => Self::Open,
        }
    }

    /// Whether the contrary is so.
    pub(super) const fn contrary(self) -> Self {
        match self {
            Self::Holds => Self::Fails,
            Self::Fails => Self::Holds,
            Self::Open => Self::Open,
        }
    }

    /// Whether either is so.
    pub(super) const fn or(self, other: Self) -> Self {
        self.contrary().and(other.contrary()).contrary()
    }

    /// Whether both are so.
    pub(super) const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Fails, _) | (_, Self::Fails) => Self::Fails,
            (Self::Holds, Self::Holds) => Self::Holds,
            (Self::Open, _) | (_, Self::Open) => Self::Open,
        }
    }

    /// In a word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::Open => "open",
        }
    }
}

/// How far from a figure of a paper ours may be to be the same: a tenth of it. No paper gives a number.
pub(super) const SAME: f64 = 0.1;

/// The share that is “near 100 %”. No paper gives a number.
pub(super) const NEAR: f64 = 0.95;

/// Whether a figure is between two others, by its whole 95 % interval; without one that is open.
pub(super) fn within([least, most]: [f64; 2], ours: Option<[f64; 2]>) -> Verdict {
    let Some([low, high]) = ours else { return Verdict::Open };
    Verdict::decided(least <= low && high <= most, high < least || most < low)
}

/// Whether `ours` is the figure `paper`, by its whole 95 % interval; without one that is open.
pub(super) fn same(paper: f64, ours: Estimate) -> Verdict {
    within([paper - SAME * paper.abs(), paper + SAME * paper.abs()], ours.interval)
}

/// Whether a figure is at least so much, by its whole 95 % interval; without one that is open.
pub(super) fn at_least(least: f64, ours: Estimate) -> Verdict {
    let Some([low, high]) = ours.interval else { return Verdict::Open };
    Verdict::decided(low >= least, high < least)
}

/// Whether all runs are such, by the share of those that are: one that is not is enough for *fails*, and for *holds*
/// nearly all are by the whole 95 % interval.
pub(super) fn always(share: Option<Estimate>) -> Verdict {
    match share {
        Some(share) if share.mean < 1.0 => Verdict::Fails,
        Some(share) => at_least(NEAR, share),
        None => Verdict::Open,
    }
}

/// Whether one figure is below another one, by their whole 95 % intervals.
pub(super) fn below(one: Option<[f64; 2]>, other: Option<[f64; 2]>) -> Verdict {
    match (one, other) {
        (Some([least, most]), Some([others_least, others_most])) => {
            Verdict::decided(most < others_least, others_most < least)
        }
        _ => Verdict::Open,
    }
}

/// The sentences for people, each named once; or why there is none.
pub(super) fn text(judged: &[Judgement], why_none: &str) -> String {
    if judged.is_empty() {
        return format!("\nNo sentence of a paper is compared here: {why_none}.\n");
    }
    let mut columns = TextTable::new([Align::Left; 3]);
    let mut last = "";
    for Judgement { sentence, of, measured, verdict } in judged {
        if sentence != last {
            columns.title(sentence);
            last = sentence;
        }
        columns.row([verdict.word().to_owned(), of.clone(), measured.clone()]);
    }
    format!("\nWhat the paper says\n{}", columns.text())
}

#[cfg(test)]
mod tests {
    use super::Verdict::{Fails, Holds, Open};
    use super::*;

    #[test]
    fn a_figure_is_decided_by_its_whole_interval_and_without_one_by_nothing() {
        let ends = |low: f64, high: f64| Some([low, high]);
        let of = |interval| Estimate { count: 9, mean: 100.0, interval };
        let all = [ends(91.0, 109.0), ends(111.0, 120.0), ends(80.0, 89.0), ends(95.0, 111.0), None];
        assert_eq!(all.map(|interval| same(100.0, of(interval))), [Holds, Fails, Fails, Open, Open]);
        let all = [ends(95.0, 100.0), ends(90.0, 94.9), ends(90.0, 100.0), None];
        assert_eq!(all.map(|interval| at_least(95.0, of(interval))), [Holds, Fails, Open, Open]);
        let all = [(999, 1000), (1, 1), (72, 72), (73, 73)].map(|(hits, count)| Estimate::share(hits, count));
        assert_eq!(all.map(always), [Fails, Open, Open, Holds]);
        assert_eq!(always(None), Open);
        let other = ends(3.0, 4.0);
        let all = [ends(1.0, 2.0), ends(5.0, 6.0), ends(2.0, 3.5), ends(3.5, 5.0), None];
        assert_eq!(all.map(|one| below(one, other)), [Holds, Fails, Open, Open, Open]);
        assert_eq!(below(other, None), Open);
    }
}
