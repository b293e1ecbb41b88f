//! The figures of agents as text, with what the paper prints beside it.

use super::super::paper;
use super::super::prelude::*;
use super::{Duration, Figure, Line, READINGS, Summary, TEAMS, Team};

/// The numbers that the paper prints: of Brick&Mortar in Fig. 11, and that Ants explore everything.
pub(super) fn of(figure: Figure, lines: &[Line]) -> Vec<PrintedFigure> {
    let ([bricks, _, ants, ants_published, ..], [beside, counted]) = (TEAMS, READINGS);
    let one = lines.iter().find(|line| (line.team, line.agents) == (bricks, 1));
    let one = one.filter(|_| figure == Figure::Agents);
    let least = |team: Team| {
        let explored = lines.iter().filter(|line| line.team == team).map(|line| line.explored);
        explored.min_by(|one, other| one.mean.total_cmp(&other.mean))
    };
    let printed = [
        PrintedFigure::of("% explored by one agent of bricks", 50.0, one.map(|line| line.explored)),
        PrintedFigure::of("% visited by one agent of bricks", 40.0, one.and_then(|line| line.visited)),
        PrintedFigure::of("% explored by ants, at least", 100.0, least(ants)),
        PrintedFigure::of("% explored by ants (published), at least", 100.0, least(ants_published)),
        PrintedFigure::of("% explored by ants (beside), at least", 100.0, least(beside)),
        PrintedFigure::of("% explored by ants (counted), at least", 100.0, least(counted)),
    ];
    printed.into_iter().flatten().collect()
}

/// The figure for people.
pub(super) fn text(figure: Figure, merged: &Summary) -> String {
    let (missed, seconds) = match figure {
        Figure::Agents | Figure::Area => ("5.56 % of the sensors missed", String::new()),
        Figure::Ideal => ("no sensor missed", seconds(merged)),
    };
    format!(
        "Offices of 4x4 rooms, {missed}, {} at each point, seeds from {}; means with 95 % intervals\n\n{}\n\
         ended: runs that were stopped after {} of all agents. Where fewer than all runs explored every cell, or were\n\
         done, their number follows.\n{seconds}\n{}",
        counted(merged.layouts, "layout"),
        merged.seed,
        moves(merged),
        counted(merged.max_steps, "step"),
        paper::text(&merged.paper, 1, [40, 5, 13, 10])
    )
}

fn moves(merged: &Summary) -> String {
    let moves = |duration| of_runs(merged, duration, |duration| duration.team_moves.text(0));
    Columns::of(&merged.lines)
        .left("area", 7, |line| format!("{0}x{0}", line.side))
        .gap(1)
        .right("agents", 6, |line| line.agents)
        .gap(2)
        .left("team", 16, |line| line.team.name())
        .gap(1)
        .estimate("% explored", 15, 1, |line| line.explored)
        .estimate("% visited", 15, 1, |line| line.visited)
        .right("moves until explored", 26, move |line| moves(line.exploration))
        .right("moves until done", 26, move |line| moves(line.termination))
        .right("ended", 5, |line| line.ended)
        .text()
}

fn seconds(merged: &Summary) -> String {
    let hours = |duration| of_runs(merged, duration, |duration| duration.seconds.times(1.0 / 3600.0).text(1));
    Columns::of(&merged.lines)
        .title("Hours of the slowest agent")
        .right("agents", 6, |line| line.agents)
        .left("team", 16, |line| line.team.name())
        .gap(1)
        .right("until explored", 20, move |line| hours(line.exploration))
        .right("until done", 20, move |line| hours(line.termination))
        .text()
}

/// How long something took, and in how many runs if not in all.
fn of_runs(merged: &Summary, duration: Option<Duration>, text: impl Fn(Duration) -> String) -> String {
    match duration {
        None => "never".to_owned(),
        Some(duration) if duration.seconds.count < merged.layouts => {
            format!("{} ({})", text(duration), duration.seconds.count)
        }
        Some(duration) => text(duration),
    }
}
