//! Figure 8 of Rajesh et al. 2024: the localisation error with and without particle swarm optimisation, by the number
//! of robots. The text that we have prints no number of it; its two sentences are judged: that the error falls with the
//! swarm, and that it grows with the number of robots. Robots stand at random places of a square with anchors in three
//! corners.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::position::{Point, Signal};
use tautline_proofs::engine::Seeded;

use super::locate_convergence::{Field, field, parameters};
use super::parameter::Parameter;
use super::{About, Chart, Observer, Table, point};
use crate::chart::{Axis, LineChart, Series, Stroke};
use tautline_field::position::{Anchors, Solver, distances, refused};
use tautline_field::stats::{Estimate, rounded};
use tautline_sim::diagnostic::Halt;
use tautline_sim::explore::RuleName;
use tautline_sim::named_values::NamedValues;
use tautline_sim::text_table::{Column, Figures, TextTable, Width};

/// The numbers of robots of the paper.
const ROBOTS: [usize; 5] = [1, 2, 4, 6, 8];

/// Robots of the largest team.
const MOST: usize = 8;

/// What is compared.
const SOLVERS: [Solver; 4] = [Solver::ClosedForm, Solver::Pso, Solver::LeastSquares, Solver::Decibel];

/// Teams of a job.
const PART: u32 = 250;

/// Figure 8.
#[derive(Clone, Copy, Debug)]
pub struct LocateFig8;

/// The teams from the first on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    first: u32,
    count: u32,
}

/// The errors of a team's robots by each solver, in metres.
type Team = [[f64; SOLVERS.len()]; MOST];

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    #[serde(flatten)]
    field: Field,
    /// Team by team.
    pub sizes: Vec<Size>,
    /// What the paper says of it.
    pub sentences: Vec<Sentence>,
}

/// The errors of teams of one size.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Size {
    /// Robots.
    pub robots: usize,
    /// Way by way.
    pub solvers: Vec<Errors>,
}

/// The errors of one way.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Errors {
    /// The way.
    pub solver: Solver,
    /// The mean of a team's errors, in metres.
    pub mean_m: Estimate,
    /// The greatest of a team's errors, in metres.
    pub worst_m: Estimate,
}

/// A sentence of the paper.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Sentence {
    /// What is said.
    pub paper: &'static str,
    /// What is measured, in metres: after, less before.
    pub difference_m: Estimate,
    /// Whether the difference has the sign that is said, beyond its 95 % interval.
    pub is_so: bool,
}

fn mean(team: &Team, robots: usize, solver: usize) -> f64 {
    let sum: f64 = team.iter().take(robots).map(|errors| errors[solver]).sum();
    sum / f64::from(u32::try_from(robots).unwrap_or(1))
}

fn worst(team: &Team, robots: usize, solver: usize) -> f64 {
    team.iter().take(robots).map(|errors| errors[solver]).fold(0.0, f64::max)
}

fn estimate(teams: &[Team], value: impl Fn(&Team) -> f64) -> Estimate {
    let values: Vec<f64> = teams.iter().map(value).collect();
    rounded(Estimate::of_values(&values).unwrap_or(Estimate::NOTHING), 1e3)
}

impl Table for LocateFig8 {
    type Settings = Field;
    type Job = Job;
    type Measured = Vec<Team>;
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "locate-fig8",
            shows: "how far robots are from where they take themselves to be, with and without particle swarm optimisation, by their \
                    number",
            help: "The localisation error with and without particle swarm optimisation, by the number of robots",
            more: "Anchors stand at 0,0, at 20,0 and at 0,20 metres, robots at random places between 0,0 and 20,20.",
            examples: &["locate-fig8 --svg fig8.svg", "locate-fig8 --noise-db 2 --format json"],
            doing: "locating",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Field>> {
        parameters("Teams of eight robots")
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        let draw = |_: &Self, _: &Field, merged: &Merged| Ok(chart(merged).svg());
        vec![Chart { name: "svg", about: "Store the figure as a picture", draw }]
    }

    fn jobs(&self, settings: &Field) -> Result<Vec<Job>, Halt> {
        let firsts = (0..settings.trials).step_by(PART as usize);
        Ok(firsts.map(|first| Job { first, count: PART.min(settings.trials - first) }).collect())
    }

    fn measure(&self, settings: &Field, job: &Job, _: &dyn Observer) -> Result<Vec<Team>, Halt> {
        let (anchors, signal) = field(settings)?;
        (job.first..job.first + job.count)
            .map(|team| one_team(&anchors, &signal, settings.seed, team))
            .collect()
    }

    fn merge(&self, settings: &Field, results: Vec<(Job, Vec<Team>)>) -> Result<Merged, Halt> {
        let teams: Vec<Team> = results.into_iter().flat_map(|(_, teams)| teams).collect();
        let errors = |robots: usize, number: usize| Errors {
            solver: SOLVERS[number],
            mean_m: estimate(&teams, |team| mean(team, robots, number)),
            worst_m: estimate(&teams, |team| worst(team, robots, number)),
        };
        let size = |&robots: &usize| Size {
            robots,
            solvers: (0..SOLVERS.len()).map(|number| errors(robots, number)).collect(),
        };
        let sentence = |paper, difference_m: Estimate, is_so: fn([f64; 2]) -> bool| Sentence {
            paper,
            difference_m,
            is_so: difference_m.interval.is_some_and(is_so),
        };
        let grows: fn([f64; 2]) -> bool = |[least, _]| least > 0.0;
        let falls: fn([f64; 2]) -> bool = |[_, most]| most < 0.0;
        Ok(Merged {
            field: settings.clone(),
            sizes: ROBOTS.iter().map(size).collect(),
            sentences: vec![
                sentence(
                    "the error falls with the swarm (8 robots, mean)",
                    estimate(&teams, |team| mean(team, MOST, 1) - mean(team, MOST, 0)),
                    falls,
                ),
                sentence(
                    "the error grows from 1 robot to 8 (pso, mean)",
                    estimate(&teams, |team| mean(team, MOST, 1) - mean(team, 1, 1)),
                    grows,
                ),
                sentence(
                    "the same of the worst robot of the team",
                    estimate(&teams, |team| worst(team, MOST, 1) - worst(team, 1, 1)),
                    grows,
                ),
            ],
        })
    }

    fn text(&self, settings: &Field, merged: &Merged) -> Result<String, Halt> {
        let heading = format!(
            "Localisation error in metres, {} teams, noise {} dB, exponent {}, seed {}; robots:",
            settings.trials, settings.noise_db, settings.exponent, settings.seed
        );
        let mut figures = Figures::new(heading, &merged.sizes);
        figures.row("robots", |size| size.robots.to_string());
        for (title, of) in [("mean of the team", false), ("worst robot of the team", true)] {
            figures.title(title);
            for (number, solver) in SOLVERS.iter().enumerate() {
                figures.row(solver.word(), |size| {
                    let errors = size.solvers[number];
                    if of { errors.worst_m } else { errors.mean_m }.text(2)
                });
            }
        }
        let mut sentences = TextTable::new([Column::left(Width::Fit); 3]);
        sentences.row(["paper", "ours: difference, m", "so?"]);
        for Sentence { paper, difference_m, is_so } in &merged.sentences {
            sentences.row([*paper, &difference_m.text(3), if *is_so { "yes" } else { "no" }]);
        }
        let notes = format!(
            "{}\n±, […]: the 95 % interval; the text of the paper that we have prints no number of its figure",
            sentences.text()
        );
        Ok(figures.with_notes(&notes))
    }
}

/// The errors of one team.
fn one_team(anchors: &Anchors, signal: &Signal, seed: u64, team: u32) -> Result<Team, Halt> {
    let mut oracle = Seeded::new(seed, team.into());
    let mut errors = Team::default();
    for robot in &mut errors {
        let at: Point = anchors.somewhere(&mut oracle);
        let ranges = distances(anchors.places(), signal, at, signal.noise_db(), &mut oracle);
        for (error, solver) in robot.iter_mut().zip(SOLVERS) {
            let solved = solver.solve(RuleName::Repaired, &ranges, signal, None, &mut oracle);
            *error = solved.map_err(refused)?.0.distance_m(at);
        }
    }
    Ok(errors)
}

/// The figure as a chart.
fn chart(merged: &Merged) -> LineChart {
    let points = |number: usize, worst: bool| {
        let sizes = merged.sizes.iter().map(move |size| {
            let errors = size.solvers[number];
            let robots = u32::try_from(size.robots).unwrap_or(u32::MAX);
            point(robots.into(), if worst { errors.worst_m } else { errors.mean_m })
        });
        sizes.collect()
    };
    let series = |(number, worst): (usize, bool)| {
        let of = if worst { ", worst robot" } else { ", mean" };
        Series {
            name: SOLVERS[number].word().to_owned() + of,
            stroke: Stroke::Solid,
            points: points(number, worst),
        }
    };
    LineChart {
        title: format!("Localisation error, noise {} dB", merged.field.noise_db),
        x: Axis::new("robots", "").showing([0.0, 8.0]),
        y: Axis::new("error", "m").showing([0.0, 1.0]),
        series: [(0, false), (1, false), (3, false), (0, true), (1, true), (3, true)].map(series).into(),
    }
}
