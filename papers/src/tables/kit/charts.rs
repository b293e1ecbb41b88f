//! The figures of KIT as charts.

use super::super::prelude::*;
use super::drive::EXPLORED;
use super::figure::{Figure, Line};
use super::lattice::PATHS;

/// The figure in the first family, with the paper's point.
pub(super) fn chart(figure: Figure, lines: &[Line]) -> LineChart {
    let family = lines.first().map_or("", |line| line.family);
    let lines = lines.iter().filter(|line| line.family == family);
    let percent = |paths: u32| 100.0 * f64::from(paths) / f64::from(PATHS as u32);
    let series = |line: &Line| {
        let (along, estimates): (fn(u32) -> f64, _) = match figure {
            Figure::Time => (f64::from, &line.nodes),
            Figure::Overlap => (percent, &line.efficiencies),
        };
        let points = (1..).zip(estimates).map(|(number, &estimate)| Point::of(along(number), estimate));
        Series::measured(line.team.name(), points)
    };
    let mut drawn: Vec<Series> = lines.map(series).collect();
    let (title, x, y) = match figure {
        Figure::Time => {
            ("Until nodes are found", Axis::new("nodes", ""), Axis::new("time", "s").showing([0.0, 0.0]))
        }
        Figure::Overlap => {
            let paper = Point::plain(percent(EXPLORED as u32), 100.0 * 18.0 / 23.0);
            drawn.push(Series::printed("the paper's run", [paper]));
            let y = Axis::new("driven by one robot alone", "%").showing([0.0, 100.0]);
            ("What robots share", Axis::new("paths explored", "%").showing([0.0, 100.0]), y)
        }
    };
    let title = format!("{title}: lattices of {family} nodes, {PATHS} paths");
    LineChart::new(title, x, y, drawn).without_empty()
}
