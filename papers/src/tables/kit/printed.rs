//! The figures of KIT as text, with what the paper prints beside it.

use schemars::JsonSchema;
use serde::Serialize;
use tautline_proofs::plural::counted;

use super::{EXPLORED, Figure, Line, Merged, PATHS, Race, Settings, TEAMS, TWO, Team};
use tautline_field::stats::Estimate;
use tautline_sim::text_table::{Column, TextTable, Width};

/// A figure that the paper prints, and ours.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub(super) struct Printed {
    what: String,
    paper: f64,
    ours: Estimate,
    difference: f64,
}

/// The paper's two numbers: 78 % efficiency at 88 % (5 of 23 paths driven by both), and 7 min 24 s between one robot
/// and two.
pub(super) fn of(figure: Figure, lines: &[Line], races: &[Race]) -> Vec<Printed> {
    let two = lines.iter().filter(|line| line.team == TEAMS[TWO]);
    let claims: Vec<(String, f64, Option<Estimate>)> = match figure {
        Figure::Time => {
            let gain =
                |race: &Race| (format!("s by which two are sooner, {}", race.family), 444.0, race.gain);
            races.iter().map(gain).collect()
        }
        Figure::Overlap => {
            let share =
                |line: &Line| (format!("% efficiency of two, {}", line.family), 78.0, line.efficiency);
            two.map(share).collect()
        }
    };
    let printed = claims.into_iter().filter_map(|(what, paper, ours)| {
        ours.map(|ours| Printed { what, paper, ours, difference: ours.mean - paper })
    });
    printed.collect()
}

impl Team {
    /// Its name.
    pub(super) fn name(self) -> String {
        format!("{}, {}", self.rule, counted(self.robots, "robot"))
    }
}

/// The figure for people.
pub(super) fn text(figure: Figure, settings: &Settings, merged: &Merged) -> String {
    let Settings { layouts, seed, speed, spread } = settings;
    let head = format!(
        "Lattices with {PATHS} paths, {} of each family, seeds from {seed}; {speed} mm/s, drives up to {spread} \u{2030} \
         faster or slower; means with 95 % intervals\n\n",
        counted(*layouts, "layout"),
    );
    let body = match figure {
        Figure::Time => times(merged),
        Figure::Overlap => overlaps(merged),
    };
    format!(
        "{head}{body}\nended: runs that went to and fro, or stood still, before all paths were driven; they are in no mean.\n\n{}",
        paper(&merged.paper)
    )
}

/// Two lines of text for each family and team, the family named once.
fn named(merged: &Merged) -> impl Iterator<Item = (&'static str, &Line)> {
    let mut last = "";
    merged.lines.iter().map(move |line| {
        let family = if line.family == last { "" } else { line.family };
        last = line.family;
        (family, line)
    })
}

fn times(merged: &Merged) -> String {
    let mut columns = TextTable::new([
        Column::left(Width::Of(11)),
        Column::left(Width::Of(20)),
        Column::right(Width::Of(13)),
        Column::right(Width::Of(13)),
        Column::right(Width::Of(6)),
    ]);
    columns.title("Seconds until half of the nodes are found, and all");
    columns.row(["family", "team", "half", "all", "ended"]);
    for (family, line) in named(merged) {
        let half = line.nodes.len().div_ceil(2).checked_sub(1).and_then(|half| line.nodes.get(half));
        columns.row([
            family.to_owned(),
            line.team.name(),
            Estimate::text_or_dash(half.copied(), 0),
            Estimate::text_or_dash(line.nodes.last().copied(), 0),
            line.ended.to_string(),
        ]);
    }
    let mut races = TextTable::new([
        Column::left(Width::Of(11)),
        Column::right(Width::Of(15)),
        Column::right(Width::Of(18)),
    ]);
    races.title(
        "Two robots as published against one: seconds by which they find all nodes sooner, and how often",
    );
    races.row(["family", "sooner by s", "in % of layouts"]);
    for Race { family, gain, sooner } in &merged.races {
        races.row([
            (*family).to_owned(),
            Estimate::text_or_dash(*gain, 0),
            Estimate::text_or_dash(*sooner, 1),
        ]);
    }
    columns.text() + &races.text()
}

fn overlaps(merged: &Merged) -> String {
    let widths = [13, 13, 13, 18, 6].map(|width| Column::right(Width::Of(width)));
    let left = [Column::left(Width::Of(11)), Column::left(Width::Of(20))];
    let mut columns = TextTable::new(left.into_iter().chain(widths));
    columns.title(format!(
        "When {EXPLORED} paths are explored: % of them driven by one robot alone, and seconds; seconds until all are"
    ));
    columns.row(["family", "team", "efficiency", "s to 88 %", "s to all", "out of contact %", "ended"]);
    for (family, line) in named(merged) {
        columns.row([
            family.to_owned(),
            line.team.name(),
            Estimate::text_or_dash(line.efficiency, 1),
            Estimate::text_or_dash(line.most, 0),
            Estimate::text_or_dash(line.all, 0),
            Estimate::text_or_dash(line.cut, 1),
            line.ended.to_string(),
        ]);
    }
    columns.text()
}

fn paper(printed: &[Printed]) -> String {
    let numbers = [7, 15, 11].map(|width| Column::right(Width::Of(width)));
    let mut columns = TextTable::new([Column::left(Width::Of(38))].into_iter().chain(numbers));
    columns.row(["", "paper", "ours", "difference"]);
    for Printed { what, paper, ours, difference } in printed {
        columns.row([what.clone(), format!("{paper:.0}"), ours.text(1), format!("{difference:+.1}")]);
    }
    columns.text()
}
