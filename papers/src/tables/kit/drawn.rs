//! The figures of KIT as charts.

use super::super::point;
use super::{EXPLORED, Figure, Line, PATHS};
use crate::chart::{Axis, LineChart, Point, Series, Stroke};
use tautline_field::stats::Estimate;

/// The figure in the first family, with the paper's point.
pub(super) fn chart(figure: Figure, lines: &[Line]) -> LineChart {
    let family = lines.first().map_or("", |line| line.family);
    let lines = lines.iter().filter(|line| line.family == family);
    let series = |line: &Line, along: &dyn Fn(usize) -> f64, estimates: &[Estimate]| Series {
        name: line.team.name(),
        stroke: Stroke::Solid,
        points: (1..).zip(estimates).map(|(number, &estimate)| point(along(number), estimate)).collect(),
    };
    let percent = |paths: usize| 100.0 * f64::from(paths as u32) / f64::from(PATHS as u32);
    let mut drawn: Vec<Series> = lines
        .map(|line| match figure {
            Figure::Time => series(line, &|nodes| f64::from(nodes as u32), &line.nodes),
            Figure::Overlap => series(line, &percent, &line.efficiencies),
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    let (title, x, y) = match figure {
        Figure::Time => {
            ("Until nodes are found", Axis::new("nodes", ""), Axis::new("time", "s").showing([0.0, 0.0]))
        }
        Figure::Overlap => {
            let points = vec![Point { x: percent(EXPLORED), y: 100.0 * 18.0 / 23.0, interval: None }];
            drawn.push(Series { name: "the paper's run".to_owned(), stroke: Stroke::Dashed, points });
            let y = Axis::new("driven by one robot alone", "%").showing([0.0, 100.0]);
            ("What robots share", Axis::new("paths explored", "%").showing([0.0, 100.0]), y)
        }
    };
    LineChart { title: format!("{title}: lattices of {family} nodes, {PATHS} paths"), x, y, series: drawn }
}
