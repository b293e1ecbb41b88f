//! Figure 8 of Rajesh et al. 2024: the localisation error with and without particle swarm optimisation, by the number
//! of robots. The text that we have prints no number of it; its two sentences are judged: that the error falls with the
//! swarm, and that it grows with the number of robots. Robots stand at random places of a square with anchors in three
//! corners.

use tautline_io::named_values::NamedValues;
use tautline_kernel::position::{Point, Signal};
use tautline_proofs::engine::SeededOracle;

use super::locate_convergence::{Field, field};
use super::parameter::{Parameter, Settings};
use super::prelude::*;
use crate::chart;
use tautline_field::position::{Anchors, Solver, distances, refused};
use tautline_sim::explore::RuleName;

/// The numbers of robots of the paper.
const ROBOTS: [usize; 5] = [1, 2, 4, 6, 8];

/// Robots of the largest team.
const MOST: usize = 8;

/// The solvers that are compared.
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
pub struct Summary {
    #[serde(flatten)]
    field: Field,
    /// Team by team.
    pub sizes: Vec<Size>,
    /// The paper's sentences about it.
    #[serde(skip)]
    sentences: Vec<Judgement>,
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

/// An estimate of a solver's errors.
type Part = fn(&Errors) -> Estimate;

/// A number of a team's errors: of so many robots, by one solver.
type Metric = fn(&Team, robots: usize, solver: usize) -> f64;

fn mean_of(team: &Team, robots: usize, solver: usize) -> f64 {
    let sum: f64 = team.iter().take(robots).map(|errors| errors[solver]).sum();
    sum / f64::from(robots as u32)
}

fn worst_of(team: &Team, robots: usize, solver: usize) -> f64 {
    team.iter().take(robots).map(|errors| errors[solver]).fold(0.0, f64::max)
}

fn estimate(teams: &[Team], value: impl Fn(&Team) -> f64) -> Estimate {
    rounded(mean(teams.iter().map(value)).unwrap_or(Estimate::NOTHING), 1e3)
}

impl Table for LocateFig8 {
    type Settings = Field;
    type Job = Job;
    type Sample = Vec<Team>;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "locate-fig8",
            shows: "how far robots are from where they take themselves to be, with and without \
                    particle swarm optimisation, by their number",
            help: "The localisation error with and without particle swarm optimisation, by the number of robots",
            more: "Anchors stand at 0,0, at 20,0 and at 0,20 metres, robots at random places between 0,0 and 20,20.",
            examples: &["locate-fig8 --svg fig8.svg", "locate-fig8 --noise-db 2 --format json"],
            doing: "locating",
            takes: "a second",
            pictures: &[("svg", "Store the figure as a picture")],
            ..Description::NOTHING
        }
    }

    fn parameters(&self) -> Vec<Parameter<Field>> {
        renamed(Field::parameters(), "trials", ["trials", "Teams of eight robots"])
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

    fn merge(&self, settings: &Field, results: Results<Self>) -> Result<Summary, Halt> {
        let teams: Vec<Team> = results.into_iter().flat_map(|(_, teams)| teams).collect();
        let errors = |robots: usize, number: usize| Errors {
            solver: SOLVERS[number],
            mean_m: estimate(&teams, |team| mean_of(team, robots, number)),
            worst_m: estimate(&teams, |team| worst_of(team, robots, number)),
        };
        let size = |robots: usize| Size {
            robots,
            solvers: (0..SOLVERS.len()).map(|number| errors(robots, number)).collect(),
        };
        let (without, with) = ((MOST, 0), (MOST, 1));
        let one: (usize, usize) = (1, 1);
        // The paper's words, of what, by which number, from which team to which, and whether it falls or grows.
        let judged =
            |words: &str, what: &str, of: Metric, [before, after]: [(usize, usize); 2], sign: f64| {
                let difference =
                    estimate(&teams, |team| of(team, after.0, after.1) - of(team, before.0, before.1));
                let has = |sign: f64| {
                    difference.interval.is_some_and(|ends| ends.iter().all(|end| sign * end > 0.0))
                };
                let verdict = Verdict::decided(has(sign), has(-sign));
                Judgement::new(words, what, format!("difference {} m", difference.text(3)), verdict)
            };
        let (falls, grows) = ("the error falls with the swarm", "the error grows from 1 robot to 8");
        let fixes: Vec<[f64; SOLVERS.len()]> = teams.iter().flatten().copied().collect();
        let farther = share(&fixes, |errors| errors[1] > errors[0]);
        let each = Judgement::new(
            "“will reduce the localization error” (5), of each fix",
            "pso against closed-form",
            format!("farther from the robot in {} % of {} fixes", percent(farther, 1), fixes.len()),
            always(farther.map(Estimate::rest)),
        );
        let least_squares = (MOST, 2);
        let sentences = vec![
            judged(falls, "8 robots, mean of the team", mean_of, [without, with], -1.0),
            judged(grows, "pso, mean of the team", mean_of, [one, with], 1.0),
            judged(grows, "pso, worst robot of the team", worst_of, [one, with], 1.0),
            each,
            judged(
                "“PSO provides more accurate results” (4.2), than least squares",
                "8 robots, mean of the team",
                mean_of,
                [least_squares, with],
                -1.0,
            ),
        ];
        Ok(Summary { field: settings.clone(), sizes: ROBOTS.map(size).into(), sentences })
    }

    fn text(&self, settings: &Field, merged: &Summary) -> Result<String, Halt> {
        let heading = format!(
            "Localisation error in metres, {} teams, noise {} dB, exponent {}, seed {}; robots:",
            settings.trials,
            Number(settings.noise_db),
            settings.exponent,
            settings.seed
        );
        let parts: [(&str, Part); 2] = [
            ("mean of the team", |errors| errors.mean_m),
            ("worst robot of the team", |errors| errors.worst_m),
        ];
        let mut figures = Figures::new(heading, &merged.sizes);
        figures.row("robots", |size| size.robots.to_string());
        for (title, of) in parts {
            figures.title(title);
            for (number, solver) in SOLVERS.iter().enumerate() {
                figures.row(solver.word(), |size| of(&size.solvers[number]).text(2));
            }
        }
        let notes =
            "±, […]: the 95 % interval; the text of the paper that we have prints no number of its figure";
        Ok(figures.with_notes(notes))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        merged.sentences.clone()
    }

    fn draw(&self, _: usize, settings: &Field, merged: &Summary) -> Result<String, Halt> {
        let series = |number: usize, what: &str, of: Part| {
            let point =
                |size: &Size| chart::Point::of((size.robots as u32).into(), of(&size.solvers[number]));
            Series::measured(format!("{}, {what}", SOLVERS[number].word()), merged.sizes.iter().map(point))
        };
        let drawn = [0, 1, 3];
        let means = drawn.map(|number| series(number, "mean", |errors| errors.mean_m));
        let worst = drawn.map(|number| series(number, "worst robot", |errors| errors.worst_m));
        let title = format!("Localisation error, noise {} dB", Number(settings.noise_db));
        let x = Axis::new("robots", "").showing([0.0, 8.0]);
        let y = Axis::new("error", "m").showing([0.0, 1.0]);
        Ok(LineChart::new(title, x, y, means.into_iter().chain(worst)).svg())
    }
}

/// The errors of one team.
fn one_team(anchors: &Anchors, signal: &Signal, seed: u64, team: u32) -> Result<Team, Halt> {
    let mut oracle = SeededOracle::new(seed, team.into());
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
