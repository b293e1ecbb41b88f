//! The figures of KIT as text, with what the paper prints beside it.

use super::super::paper;
use super::super::prelude::*;
use super::{EXPLORED, Figure, Line, PATHS, Race, Settings, Summary, TEAMS, TWO, Team};

/// The paper's two numbers: 78 % efficiency at 88 % (5 of 23 paths driven by both), and 7 min 24 s between one robot
/// and two.
pub(super) fn of(figure: Figure, lines: &[Line], races: &[Race]) -> Vec<PrintedFigure> {
    let gain = |race: &Race| {
        PrintedFigure::of(format!("s by which two are sooner, {}", race.family), 444.0, race.gain)
    };
    let share = |line: &Line| {
        PrintedFigure::of(format!("% efficiency of two, {}", line.family), 78.0, line.efficiency)
    };
    match figure {
        Figure::Time => races.iter().filter_map(gain).collect(),
        Figure::Overlap => lines.iter().filter(|line| line.team == TEAMS[TWO]).filter_map(share).collect(),
    }
}

impl Team {
    /// Its name.
    pub(super) fn name(self) -> String {
        format!("{}, {}", self.rule, counted(self.robots, "robot"))
    }
}

/// The figure for people.
pub(super) fn text(figure: Figure, settings: &Settings, merged: &Summary) -> String {
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
        paper::text(&merged.paper, 0, [38, 7, 15, 11])
    )
}

/// Two lines of text for each family and team, the family named once.
fn named(merged: &Summary) -> impl Iterator<Item = (&'static str, &Line)> {
    let mut last = "";
    merged.lines.iter().map(move |line| {
        let family = if line.family == last { "" } else { line.family };
        last = line.family;
        (family, line)
    })
}

fn times(merged: &Summary) -> String {
    let half = |line: &Line| -> Option<Estimate> {
        line.nodes.get(line.nodes.len().div_ceil(2).checked_sub(1)?).copied()
    };
    let nodes = Columns::of(named(merged))
        .title("Seconds until half of the nodes are found, and all")
        .left("family", 11, |(family, _)| family)
        .left("team", 20, |(_, line)| line.team.name())
        .estimate("half", 13, 0, move |(_, line)| half(line))
        .estimate("all", 13, 0, |(_, line)| line.nodes.last().copied())
        .right("ended", 6, |(_, line)| line.ended);
    let races = Columns::of(&merged.races)
        .title(
            "Two robots as published against one: seconds by which they find all nodes sooner, and how often",
        )
        .left("family", 11, |race| race.family)
        .estimate("sooner by s", 15, 0, |race| race.gain)
        .estimate("in % of layouts", 18, 1, |race| race.sooner);
    nodes.text() + &races.text()
}

fn overlaps(merged: &Summary) -> String {
    let title = format!(
        "When {EXPLORED} paths are explored: % of them driven by one robot alone, and seconds; seconds until all are"
    );
    Columns::of(named(merged))
        .title(title)
        .left("family", 11, |(family, _)| family)
        .left("team", 20, |(_, line)| line.team.name())
        .estimate("efficiency", 13, 1, |(_, line)| line.efficiency)
        .estimate("s to 88 %", 13, 0, |(_, line)| line.most)
        .estimate("s to all", 13, 0, |(_, line)| line.all)
        .estimate("out of contact %", 18, 1, |(_, line)| line.cut)
        .right("ended", 6, |(_, line)| line.ended)
        .text()
}
