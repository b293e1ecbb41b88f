//! How much contact tolerates: how far two robots of a rule can be apart, over every place and every plan that its
//! conditions allow, and how much of the radio's range is left then. What is left is what navigation, radio and clocks
//! may be wrong by: each of two robots may be off by half of it.
//!
//! The chain's cells are 4 m and its radio reaches 10 m [Kovács 2011, I, III.A]; KIT's paths are 3 m, and
//! its robots stay within 10 m [Peiris, 2, 4]. At any moment means at whatever speeds two robots move within
//! a team move or over their paths, and whoever of them has not gone yet: so a robot may be as late as it
//! will, unless more than the range comes out.

use tautline_kernel::chain;
use tautline_kernel::ground::{Cell, Circle};
use tautline_kernel::kit::{Reach, Stance};
use tautline_proofs::chain::{Farthest, farthest};
use tautline_proofs::kit;

use super::prelude::*;

/// From a node of KIT to the next, in metres.
const PATH_M: f64 = 3.0;

/// The table of margins.
#[derive(Clone, Copy, Debug)]
pub struct Margins;

settings! {
    /// The assumptions about robots and radios.
    pub struct Settings {
        /// How far robots hear each other, in metres
        pub range_m: f64 = 10.0, one("range", "METRES", positive);
        /// The side of the chain's cells, in metres
        pub cell_m: f64 = 4.0, one("cell", "METRES", positive);
        /// The exponent by which a signal weakens with the distance
        pub exponent: f64 = 2.0, one("exponent", "NUMBER", positive);
    }
}

fn positive(text: &str) -> Result<f64, String> {
    let number = real(text)?;
    let is_measure = (1e-6..=1e6).contains(&number);
    is_measure.then_some(number).ok_or_else(|| "write a number from 0.000001 to 1000000".to_owned())
}

/// The measure of two robots.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// From the one to the other.
    Centres,
    /// From the one to the farthest corner of the other's cell.
    Cells,
}

/// A rule, and how far two of its robots can be apart.
#[derive(Clone, Copy)]
struct Row {
    rule: &'static str,
    kept: Measure,
    lattice: Lattice,
    /// Squared: at rest, and at any moment. Of the chain in quarters of a squared cell, of KIT in squared paths.
    farthest: fn() -> [u32; 2],
}

/// On what robots move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Lattice {
    Cells,
    Paths,
}

const fn chain(rule: &'static str, kept: Measure, farthest: fn() -> [u32; 2]) -> Row {
    Row { rule, kept, lattice: Lattice::Cells, farthest }
}

const fn paths(rule: &'static str, farthest: fn() -> [u32; 2]) -> Row {
    Row { rule, kept: Measure::Centres, lattice: Lattice::Paths, farthest }
}

const ROWS: [Row; 11] = [
    chain("chain, published", Measure::Centres, || published().centres),
    chain("chain, published", Measure::Cells, || published().cells),
    chain("chain, repaired", Measure::Centres, || covered(&chain::Rule::REPAIRED).centres),
    chain("chain, repaired", Measure::Cells, || covered(&chain::Rule::REPAIRED).cells),
    chain("reel", Measure::Centres, || covered(&chain::Rule::REEL).centres),
    chain("reel", Measure::Cells, || covered(&chain::Rule::REEL).cells),
    paths("KIT, repaired, 10 m", || within(Reach::PAPER)),
    paths("KIT, --range 3", || Reach::of_paths(3).map_or([0; 2], within)),
    paths("KIT, --range 2", || Reach::of_paths(2).map_or([0; 2], within)),
    paths("KIT, --range 4", || Reach::of_paths(4).map_or([0; 2], within)),
    paths("KIT, --range 5", || Reach::of_paths(5).map_or([0; 2], within)),
];

/// Neighbours whose centres are within r_cov, as CHAIN-3 has them.
fn published() -> Farthest {
    farthest(&chain::Rule::PUBLISHED, |one: Cell, other: Cell| Circle::COVERED.reaches(one, other))
}

/// Neighbours in E_C of each other, as CHAIN-1 has them.
fn covered(rule: &chain::Rule) -> Farthest {
    farthest(rule, |one: Cell, other: Cell| Circle::COVERED.covers(one, other))
}

/// Robots that are sure to hear each other, as KIT-1 has them.
fn within(reach: Reach) -> [u32; 2] {
    kit::farthest(|one: Stance, other: Stance| one.is_sure_of(other, reach))
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Rule by rule.
    pub lines: Vec<Line>,
}

/// The margins of a rule.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The rule.
    pub rule: &'static str,
    /// The measure.
    pub kept: Measure,
    /// The side of a cell, or a path, in metres.
    pub side_m: f64,
    /// The farthest that two robots at rest are apart, in metres.
    pub rest_m: f64,
    /// The farthest at any moment, in metres.
    pub moving_m: f64,
    /// The part of the range that is left at any moment, in metres; less than 0 if it does not suffice.
    pub margin_m: f64,
    /// How far each robot may be off where it should be, in metres.
    pub each_m: Option<f64>,
    /// By how much a signal may be weaker than that which just reaches the range, in dB.
    pub weaker_db: Option<f64>,
    /// The largest side with which the range suffices, in metres.
    pub largest_m: f64,
    /// The rest of r_cov at any moment, in metres; KIT has none.
    pub of_r_cov_m: Option<f64>,
    /// Whether the range suffices however late a robot goes.
    pub is_late_allowed: bool,
}

impl Table for Margins {
    type Settings = Settings;
    type Job = usize;
    type Sample = [u32; 2];
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "margins",
            shows: "contact: how far robots of the chain and of KIT can be apart, and what error of position, loss of \
                    signal and delay the range leaves room for",
            help: "How much error of position, loss of signal and delay contact tolerates",
            more: "Every pair of places and every plan that the rules' conditions allow is \
                   looked at. The range is that of the papers.",
            examples: &["margins", "margins --range 12 --cell 3.9 --format json"],
            doing: "measuring",
            takes: "a second",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, _: &Settings) -> Result<Vec<usize>, Halt> {
        Ok((0..ROWS.len()).collect())
    }

    fn measure(&self, _: &Settings, &place: &usize, _: &dyn Observer) -> Result<[u32; 2], Halt> {
        Ok(ROWS.get(place).map_or([0; 2], |row| (row.farthest)()))
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let rows = results.into_iter().filter_map(|(place, far)| Some((*ROWS.get(place)?, far)));
        let lines = rows.map(|(row, far)| Line::of(row, far, settings)).collect();
        Ok(Summary { settings: settings.clone(), lines })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let Settings { range_m, cell_m, exponent } = *settings;
        let [range_m, cell_m, exponent] = [range_m, cell_m, exponent].map(Number);
        let head = format!(
            "A range of {range_m} m, cells of {cell_m} m, paths of {PATH_M} m, a signal \
             that weakens with exponent {exponent}\n\n"
        );
        let body = Columns::of(&merged.lines)
            .left("rule", |line| line.rule)
            .left("measured", |line| line.kept.word())
            .number("at rest, m", 3, |line| line.rest_m)
            .number("moving, m", 3, |line| line.moving_m)
            .number("left, m", 3, |line| line.margin_m)
            .number("each off, m", 3, |line| line.each_m)
            .number("weaker, dB", 3, |line| line.weaker_db)
            .number("side up to, m", 3, |line| line.largest_m)
            .number("left of r_cov, m", 3, |line| line.of_r_cov_m)
            .right("late", |line| if line.is_late_allowed { "any" } else { "none" })
            .text();
        Ok(head
            + &body
            + "\nmoving: at any moment, whoever has not gone yet. left: of the range. each off: \
               how far each of two robots may be off.\n")
    }
}

impl Measure {
    const fn word(self) -> &'static str {
        match self {
            Self::Centres => "centres",
            Self::Cells => "cells",
        }
    }
}

impl Line {
    fn of(row: Row, far: [u32; 2], settings: &Settings) -> Self {
        let Row { rule, kept, lattice, .. } = row;
        let (side_m, of_side) = match lattice {
            Lattice::Cells => (settings.cell_m, 4.0),
            Lattice::Paths => (PATH_M, 1.0),
        };
        let [rest, moving] = far.map(|squared| libm::sqrt(f64::from(squared) / of_side));
        let margin_m = settings.range_m - moving * side_m;
        let is_late_allowed = margin_m >= 0.0;
        let weaker_db = 10.0 * settings.exponent * libm::log10(settings.range_m / (moving * side_m));
        // 26 quarters of a squared cell.
        let r_cov = libm::sqrt(26.0 / 4.0);
        Self {
            rule,
            kept,
            side_m,
            rest_m: thousandths(rest * side_m),
            moving_m: thousandths(moving * side_m),
            margin_m: thousandths(margin_m),
            each_m: is_late_allowed.then(|| thousandths(margin_m / 2.0)),
            weaker_db: is_late_allowed.then(|| thousandths(weaker_db)),
            largest_m: thousandths(settings.range_m / moving),
            of_r_cov_m: (lattice == Lattice::Cells).then(|| thousandths((r_cov - moving) * side_m)),
            is_late_allowed,
        }
    }
}

/// The number rounded to three decimals.
fn thousandths(number: f64) -> f64 {
    // Adding 0 turns −0 into 0.
    libm::round(number * 1000.0) / 1000.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_are_those_that_one_counts_by_hand() {
        let settings = Settings::default();
        let lines = ROWS.map(|row| Line::of(row, (row.farthest)(), &settings));
        let margin = |rule: &str, kept: Measure| {
            let line = lines.iter().find(|line| line.rule == rule && line.kept == kept).expect("a row");
            (line.moving_m, line.margin_m, line.of_r_cov_m)
        };
        // 3·√10 m of 10 m; 4·√5 m of 10 m and of 4·√26/2 m.
        assert_eq!(margin("KIT, repaired, 10 m", Measure::Centres), (9.487, 0.513, None));
        assert_eq!(margin("chain, published", Measure::Centres), (8.944, 1.056, Some(1.254)));
        // A cell wholly covered ends at r_cov.
        assert_eq!(margin("reel", Measure::Cells), (10.198, -0.198, Some(0.0)));
    }
}
