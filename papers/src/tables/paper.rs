//! The numbers of papers, beside what is measured.

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
pub(super) fn text(printed: &[PrintedFigure], decimals: usize) -> String {
    Columns::of(printed)
        .left("", |line| &line.what)
        .right("paper", |line| format!("{:.decimals$}", line.paper))
        .estimate("ours", 1, |line| line.ours)
        .right("difference", |line| format!("{:+.1}", line.difference))
        .text()
}
