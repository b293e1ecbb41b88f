//! The figures of agents as charts.

use super::super::prelude::*;
use super::figure::{Figure, Line};
use super::team::{BRICKS_PUBLISHED, Team};

/// The figure, with the numbers that the paper prints.
pub(super) fn chart(figure: Figure, lines: &[Line]) -> LineChart {
    let along = |line: &Line| match figure {
        Figure::Agents | Figure::Ideal => f64::from(line.agents),
        Figure::Area => f64::from(line.side) * f64::from(line.side),
    };
    let series = |team: Team, what: &str, of: fn(&Line) -> Option<Estimate>| {
        let lines = lines.iter().filter(|line| line.team == team);
        let points = lines.filter_map(|line| Some(Point::of(along(line), of(line)?)));
        Series::measured(format!("{}: {what}", team.name()), points)
    };
    let printed = |team: Team, what: &str, percent| {
        Series::printed(format!("{}: {what}, paper", team.name()), [Point::plain(1.0, percent)])
    };
    let of_team = |team: Team| match figure {
        Figure::Agents | Figure::Area => {
            let mut drawn = vec![
                series(team, "explored", |line| Some(line.explored)),
                series(team, "visited", |line| line.visited),
            ];
            if figure == Figure::Agents && team == BRICKS_PUBLISHED {
                drawn.extend([printed(team, "explored", 50.0), printed(team, "visited", 40.0)]);
            }
            drawn
        }
        Figure::Ideal => vec![
            series(team, "until explored", |line| line.exploration.map(|duration| duration.team_moves)),
            series(team, "until done", |line| line.termination.map(|duration| duration.team_moves)),
        ],
    };
    let (agents, cells) = (Axis::new("agents", ""), Axis::new("cells", "%").showing([0.0, 100.0]));
    let (title, x, y) = match figure {
        Figure::Agents => ("Offices of 30x30 cells, 5.56 % of the sensors missed", agents, cells),
        Figure::Area => {
            ("Offices, 20 agents, 5.56 % of the sensors missed", Axis::new("area", "cells"), cells)
        }
        Figure::Ideal => {
            let moves = Axis::new("team moves", "").showing([0.0, 0.0]);
            ("Offices of 30x30 cells, no sensor missed", agents, moves)
        }
    };
    LineChart::new(title, x, y, figure.teams().into_iter().flat_map(of_team)).without_empty()
}
