//! The figures of agents as charts.

use super::super::point;
use super::{Figure, Line, TEAMS, Team};
use crate::chart::{Axis, LineChart, Point, Series, Stroke};
use tautline_field::stats::Estimate;
use tautline_sim::explore::RuleId;
use tautline_sim::explore::bricks::BRICKS;

/// The figure, with the numbers that the paper prints.
pub(super) fn chart(figure: Figure, lines: &[Line]) -> LineChart {
    let along = |line: &Line| match figure {
        Figure::Agents | Figure::Ideal => f64::from(line.agents),
        Figure::Area => f64::from(line.side) * f64::from(line.side),
    };
    let series = |name: String, team: Team, of: &dyn Fn(&Line) -> Option<Estimate>| {
        let lines = lines.iter().filter(|line| line.team == team);
        let points: Vec<Point> =
            lines.filter_map(|line| of(line).map(|estimate| point(along(line), estimate))).collect();
        Series { name, stroke: Stroke::Solid, points }
    };
    let mut drawn = Vec::new();
    for team in TEAMS {
        let word = team.name();
        match figure {
            Figure::Agents | Figure::Area => {
                drawn.push(series(format!("{word}: explored"), team, &|line| Some(line.explored)));
                drawn.push(series(format!("{word}: visited"), team, &|line| line.visited));
            }
            Figure::Ideal => {
                let explored = |line: &Line| line.exploration.map(|duration| duration.team_moves);
                let done = |line: &Line| line.termination.map(|duration| duration.team_moves);
                drawn.push(series(format!("{word}: until explored"), team, &explored));
                drawn.push(series(format!("{word}: until done"), team, &done));
            }
        }
        let printed: &[(&str, f64)] = match (figure, (team.scheme, team.rule) == (&BRICKS, RuleId::REPAIRED))
        {
            (Figure::Agents, true) => &[("explored", 50.0), ("visited", 40.0)],
            (Figure::Agents | Figure::Area | Figure::Ideal, _) => &[],
        };
        for (what, percent) in printed {
            let points = vec![Point { x: 1.0, y: *percent, interval: None }];
            drawn.push(Series { name: format!("{word}: {what}, paper"), stroke: Stroke::Dashed, points });
        }
    }
    drawn.retain(|series| !series.points.is_empty());
    let (x, y) = match figure {
        Figure::Agents => (Axis::new("agents", ""), Axis::new("cells", "%").showing([0.0, 100.0])),
        Figure::Area => (Axis::new("area", "cells"), Axis::new("cells", "%").showing([0.0, 100.0])),
        Figure::Ideal => (Axis::new("agents", ""), Axis::new("team moves", "").showing([0.0, 0.0])),
    };
    let title = match figure {
        Figure::Agents => "Offices of 30x30 cells, 5.56 % of the sensors missed",
        Figure::Area => "Offices, 20 agents, 5.56 % of the sensors missed",
        Figure::Ideal => "Offices of 30x30 cells, no sensor missed",
    };
    LineChart { title: title.to_owned(), x, y, series: drawn }
}
