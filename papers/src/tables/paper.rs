//! The numbers and sentences of papers, beside what is measured.

use schemars::JsonSchema;
use serde::Serialize;
use tautline_field::stats::Estimate;

use super::columns::Columns;
use super::sentences::{Judgement, same};

/// A figure that the paper prints, and ours.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub(super) struct PrintedFigure {
    what: String,
    paper: f64,
    ours: Estimate,
    difference: f64,
}

impl PrintedFigure {
    /// The printed number, and the measured one; nothing if there is none.
    pub(super) fn of(what: impl Into<String>, paper: f64, ours: Option<Estimate>) -> Option<Self> {
        ours.map(|ours| Self { what: what.into(), paper, ours, difference: ours.mean - paper })
    }
}

/// The verdict on each figure.
pub(super) fn judged(printed: &[PrintedFigure]) -> Vec<Judgement> {
    let judged = |figure: &PrintedFigure| {
        let PrintedFigure { what, paper, ours, .. } = figure;
        Judgement::new(
            format!("{paper} as a figure of the paper, within a tenth"),
            what,
            ours.text(1),
            same(*paper, *ours),
        )
    };
    let mut judged: Vec<Judgement> = printed.iter().map(judged).collect();
    judged.sort_by(|one, other| one.sentence.cmp(&other.sentence));
    judged
}

/// The figures for people, the paper's with so many decimals.
pub(super) fn text(
    printed: &[PrintedFigure],
    decimals: usize,
    [what, paper, ours, difference]: [usize; 4],
) -> String {
    Columns::of(printed)
        .left("", what, |line| &line.what)
        .right("paper", paper, |line| format!("{:.decimals$}", line.paper))
        .estimate("ours", ours, 1, |line| line.ours)
        .right("difference", difference, |line| format!("{:+.1}", line.difference))
        .text()
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
