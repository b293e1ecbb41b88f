//! `tautline reproduce bricks-fig11`, `bricks-fig12` and `bricks-ideal`: agents on the floors of offices.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use tautline_proofs::words::counted;

use crate::output::Output;
use crate::{Exit, ForceArgs, Format, FormatArgs, number, progress};
use tautline_sim::draw::chart::{Axis, LineChart, Point, Series, Stroke};
use tautline_sim::explore::bricks::BRICKS;
use tautline_sim::fault::Halt;
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::agents::{self, Duration, Extent, Figure, Line, TEAMS, Team};
use tautline_sim::reproduce::interval::Estimate;

/// Agents on the floors of offices: what they explore and mark, and how long they take.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  tautline reproduce bricks-fig11 --svg fig11.svg
  tautline reproduce bricks-ideal --layouts 20 --format json")]
pub(super) struct Agents {
    /// Random layouts at each point.
    #[arg(long, value_name = "COUNT", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    layouts: u32,
    /// The seed of the first layout and its runs; the others have the seeds after it.
    #[arg(long, default_value = "0", value_parser = number::<u64>)]
    seed: u64,
    /// Steps of all agents together after which a run is ended.
    #[arg(long, value_name = "STEPS", default_value_t = 200_000, value_parser = clap::value_parser!(u32).range(1..))]
    max_steps: u32,
    /// Store a chart.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Measured<'a> {
    id: &'static str,
    layouts: u32,
    seed: u64,
    miss: f64,
    max_steps: u32,
    lines: &'a [Line],
    paper: &'a [Printed],
}

/// A figure that the paper prints, and ours.
#[derive(Serialize)]
struct Printed {
    what: &'static str,
    paper: f64,
    ours: Estimate,
    difference: f64,
}

impl Agents {
    pub(super) fn run(
        &self,
        reproduction: Reproduction,
        figure: Figure,
        out: &mut Output,
    ) -> Result<Exit, Halt> {
        let [file] = self.force.files([&self.svg], [])?;
        let runs = u64::from(self.layouts) * (figure.points().len() * TEAMS.len()) as u64;
        let extent = Extent { layouts: self.layouts, seed: self.seed, max_steps: self.max_steps };
        let lines = progress::during("exploring", runs, |watch| agents::measure(figure, extent, watch))?;
        let printed = printed(figure, &lines);
        if let Some(mut file) = file {
            file.append(chart(figure, &lines).svg());
            out.keep(file);
        }
        match self.format.format {
            Format::Json => out.json(&Measured {
                id: reproduction.id(),
                layouts: self.layouts,
                seed: self.seed,
                miss: figure.miss().into(),
                max_steps: self.max_steps,
                lines: &lines,
                paper: &printed,
            })?,
            Format::Text => out.text(self.text(figure, &lines, &printed))?,
        }
        Ok(Exit::Expected)
    }

    fn text(&self, figure: Figure, lines: &[Line], printed: &[Printed]) -> String {
        let missed = match figure {
            Figure::Agents | Figure::Area => "5.56 % of the sensors missed",
            Figure::Ideal => "no sensor missed",
        };
        let mut text = format!(
            "Offices of 4x4 rooms, {missed}, {} at each point, seeds from {}; means with 95 % intervals\n\n",
            counted(self.layouts, "layout"),
            self.seed
        );
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:7} {:>6}  {:16} {:>15} {:>15} {:>26} {:>26} {:>5}",
            "area",
            "agents",
            "team",
            "% explored",
            "% visited",
            "moves until explored",
            "moves until done",
            "ended"
        );
        for line in lines {
            let area = format!("{0}x{0}", line.side);
            let visited = line.visited.map_or_else(|| "-".to_owned(), |visited| visited.text(1));
            let _ = writeln!(
                text,
                "{area:7} {:>6}  {:16} {:>15} {visited:>15} {:>26} {:>26} {:>5}",
                line.agents,
                line.team.name(),
                line.explored.text(1),
                self.of_runs(line.exploration, |duration| duration.team_moves.text(0)),
                self.of_runs(line.termination, |duration| duration.team_moves.text(0)),
                line.ended
            );
        }
        let _ = writeln!(
            text,
            "\nended: runs that were stopped after {} of all agents. Where fewer than all runs explored every cell, or \
             were\ndone, their number follows.",
            counted(self.max_steps, "step")
        );
        match figure {
            Figure::Agents | Figure::Area => {}
            Figure::Ideal => text.push_str(&self.seconds(lines)),
        }
        let _ = writeln!(text, "\n{:40}  paper           ours  difference", "");
        for Printed { what, paper, ours, difference } in printed {
            let _ = writeln!(text, "{what:40}  {paper:>5.1}  {:>13}  {difference:>+10.1}", ours.text(1));
        }
        text
    }

    /// How long something took, and in how many runs if not in all.
    fn of_runs(&self, duration: Option<Duration>, text: impl Fn(Duration) -> String) -> String {
        match duration {
            None => "never".to_owned(),
            Some(duration) if duration.seconds.count < self.layouts => {
                format!("{} ({})", text(duration), duration.seconds.count)
            }
            Some(duration) => text(duration),
        }
    }

    fn seconds(&self, lines: &[Line]) -> String {
        let mut text = format!(
            "\nHours of the slowest agent\n{:>6}  {:16} {:>20} {:>20}\n",
            "agents", "team", "until explored", "until done"
        );
        let hours = |duration: Duration| duration.seconds.times(1.0 / 3600.0).text(1);
        for line in lines {
            let (explored, done) =
                (self.of_runs(line.exploration, hours), self.of_runs(line.termination, hours));
            let _ = writeln!(text, "{:>6}  {:16} {explored:>20} {done:>20}", line.agents, line.team.name());
        }
        text
    }
}

/// What the paper says in numbers: of Brick&Mortar in Fig. 11, and that Ants explore everything.
fn printed(figure: Figure, lines: &[Line]) -> Vec<Printed> {
    let [bricks, _, ants, ants_published] = TEAMS;
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

fn chart(figure: Figure, lines: &[Line]) -> LineChart {
    let along = |line: &Line| match figure {
        Figure::Agents | Figure::Ideal => f64::from(line.agents),
        Figure::Area => f64::from(line.side) * f64::from(line.side),
    };
    let series = |name: String, team: Team, of: &dyn Fn(&Line) -> Option<Estimate>| {
        let lines = lines.iter().filter(|line| line.team == team);
        let points: Vec<Point> =
            lines.filter_map(|line| of(line).map(|estimate| estimate.at(along(line)))).collect();
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
        let printed: &[(&str, f64)] = match (figure, team.scheme == &BRICKS) {
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
