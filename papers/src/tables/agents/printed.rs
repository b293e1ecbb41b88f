//! The figures of agents as text, with what the paper prints beside it.

use schemars::JsonSchema;
use serde::Serialize;
use tautline_proofs::plural::counted;

use super::{Duration, Figure, Line, Merged, TEAMS, Team};
use tautline_field::stats::Estimate;
use tautline_sim::text_table::{Column, TextTable, Width};

/// A figure that the paper prints, and ours.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub(super) struct Printed {
    what: &'static str,
    paper: f64,
    ours: Estimate,
    difference: f64,
}

/// What the paper says in numbers: of Brick&Mortar in Fig. 11, and that Ants explore everything.
pub(super) fn of(figure: Figure, lines: &[Line]) -> Vec<Printed> {
    let [bricks, _, ants, ants_published, ..] = TEAMS;
    let one = lines.iter().find(|line| (line.team, line.agents) == (bricks, 1));
    let one = one.filter(|_| figure == Figure::Agents);
    let least = |team: Team| {
        let explored = lines.iter().filter(|line| line.team == team).map(|line| line.explored);
        explored.min_by(|one, other| one.mean.total_cmp(&other.mean))
    };
    let claims = [
        ("% explored by one agent of bricks", 50.0, one.map(|line| line.explored)),
        ("% visited by one agent of bricks", 40.0, one.and_then(|line| line.visited)),
        ("% explored by ants, at least", 100.0, least(ants)),
        ("% explored by ants (published), at least", 100.0, least(ants_published)),
    ];
    let printed = claims.into_iter().filter_map(|(what, paper, ours)| {
        ours.map(|ours| Printed { what, paper, ours, difference: ours.mean - paper })
    });
    printed.collect()
}

/// The figure for people.
pub(super) fn text(figure: Figure, merged: &Merged) -> String {
    let missed = match figure {
        Figure::Agents | Figure::Area => "5.56 % of the sensors missed",
        Figure::Ideal => "no sensor missed",
    };
    let seconds = match figure {
        Figure::Agents | Figure::Area => String::new(),
        Figure::Ideal => seconds(merged),
    };
    format!(
        "Offices of 4x4 rooms, {missed}, {} at each point, seeds from {}; means with 95 % intervals\n\n{}\n\
         ended: runs that were stopped after {} of all agents. Where fewer than all runs explored every cell, or were\n\
         done, their number follows.\n{seconds}\n{}",
        counted(merged.layouts, "layout"),
        merged.seed,
        moves(merged),
        counted(merged.max_steps, "step"),
        paper(&merged.paper)
    )
}

fn moves(merged: &Merged) -> String {
    let numbers = [15, 15, 26, 26, 5].map(|width| Column::right(Width::Of(width)).after(1));
    let point =
        [Column::left(Width::Of(7)), Column::right(Width::Of(6)).after(1), Column::left(Width::Of(16))];
    let mut columns = TextTable::new(point.into_iter().chain(numbers));
    let heads = ["area", "agents", "team", "% explored", "% visited"];
    columns.row(heads.into_iter().chain(["moves until explored", "moves until done", "ended"]));
    for line in &merged.lines {
        let moves = |duration| of_runs(merged, duration, |duration| duration.team_moves.text(0));
        columns.row([
            format!("{0}x{0}", line.side),
            line.agents.to_string(),
            line.team.name(),
            line.explored.text(1),
            Estimate::text_or_dash(line.visited, 1),
            moves(line.exploration),
            moves(line.termination),
            line.ended.to_string(),
        ]);
    }
    columns.text()
}

fn seconds(merged: &Merged) -> String {
    let times = [20, 20].map(|width| Column::right(Width::Of(width)).after(1));
    let team = [Column::right(Width::Of(6)), Column::left(Width::Of(16))];
    let mut columns = TextTable::new(team.into_iter().chain(times));
    columns.title("Hours of the slowest agent");
    columns.row(["agents", "team", "until explored", "until done"]);
    for line in &merged.lines {
        let hours =
            |duration| of_runs(merged, duration, |duration| duration.seconds.times(1.0 / 3600.0).text(1));
        let (explored, done) = (hours(line.exploration), hours(line.termination));
        columns.row([line.agents.to_string(), line.team.name(), explored, done]);
    }
    columns.text()
}

fn paper(printed: &[Printed]) -> String {
    let numbers = [5, 13, 10].map(|width| Column::right(Width::Of(width)));
    let mut columns = TextTable::new([Column::left(Width::Of(40))].into_iter().chain(numbers));
    columns.row(["", "paper", "ours", "difference"]);
    for Printed { what, paper, ours, difference } in printed {
        let (paper, difference) = (format!("{paper:.1}"), format!("{difference:+.1}"));
        columns.row([(*what).to_owned(), paper, ours.text(1), difference]);
    }
    columns.text()
}

/// How long something took, and in how many runs if not in all.
fn of_runs(merged: &Merged, duration: Option<Duration>, text: impl Fn(Duration) -> String) -> String {
    match duration {
        None => "never".to_owned(),
        Some(duration) if duration.seconds.count < merged.layouts => {
            format!("{} ({})", text(duration), duration.seconds.count)
        }
        Some(duration) => text(duration),
    }
}
