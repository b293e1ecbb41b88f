//! How fast particles find the position at which distances miss least (Rajesh et al. 2024, 4 and 7: “the localization
//! error is brought down to less than 5cm in 20 iterations”, “0.02cm or below”): by the order of the updates, by what
//! random numbers are drawn for, and by the inertia. Beside it the distance to where the robot is, which is another
//! thing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Draws, Order, Parameters, Particle, Point, Residual, Signal, Swarm, closed_form, locate,
};
use tautline_proofs::engine::Seeded;

use super::parameter::{Parameter, put, shown};
use super::{About, Chart, Observer, Table};
use crate::chart::{Axis, LineChart, Point as Mark, Series, Stroke};
use tautline_field::position::{Anchors, PARTICLES, distances, refused};
use tautline_field::stats::{Estimate, decimals, quantile, rounded};
use tautline_sim::diagnostic::{Diagnostic, Halt};
use tautline_sim::text_table::{Column, Figures, TextTable, Width};
use tautline_sim::value_parser::{number, real, within};

/// The anchors, as in `tautline locate`.
const SQUARE: [Point; 3] = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(0.0, 20.0)];

/// Iterations after which it is looked.
const ITERATIONS: [u32; 6] = [0, 5, 10, 20, 30, 50];

/// The paper's error after 20 iterations, in metres.
const PAPER_M: f64 = 0.05;

/// The error that the paper's conclusion names, in metres.
const CONCLUSION_M: f64 = 0.0002;

/// How the paper can be read.
const VARIANTS: [(&str, Order, Draws, Parameters); 6] = [
    ("published", Order::Published, Draws::Particle, Parameters::CONTRACTING),
    ("published, a draw for each axis", Order::Published, Draws::Axis, Parameters::CONTRACTING),
    ("published, inertia from 0.9 to 0.4", Order::Published, Draws::Particle, Parameters::FALLING),
    ("repaired", Order::Corrected, Draws::Particle, Parameters::CONTRACTING),
    ("repaired, a draw for each axis", Order::Corrected, Draws::Axis, Parameters::CONTRACTING),
    ("repaired, inertia from 0.9 to 0.4", Order::Corrected, Draws::Particle, Parameters::FALLING),
];

/// Convergence.
#[derive(Clone, Copy, Debug)]
pub struct LocateConvergence;

/// A square with anchors in three corners, and what is tried in it.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Field {
    /// The standard deviation of the levels, in dB.
    pub noise_db: f64,
    /// The exponent of the path loss.
    pub exponent: f64,
    /// How often it is tried.
    pub trials: u32,
    /// The seed of all of it.
    pub seed: u64,
}

impl Default for Field {
    fn default() -> Self {
        Self { noise_db: 1.0, exponent: 2.0, trials: 10_000, seed: 0 }
    }
}

/// The options of a field; `tried` says what is tried how often.
pub(super) fn parameters(tried: &'static str) -> Vec<Parameter<Field>> {
    vec![
        Parameter::one(
            "noise-db",
            "DB",
            "The standard deviation of the levels, in dB",
            |all| shown(&all.noise_db),
            |all, texts| put(&mut all.noise_db, texts, real),
        ),
        Parameter::one(
            "exponent",
            "ALPHA",
            "Power falls with the distance to the power of this, from 2 to 5",
            |all| shown(&all.exponent),
            |all, texts| put(&mut all.exponent, texts, real),
        ),
        Parameter::one(
            "trials",
            "COUNT",
            tried,
            |all| shown(&all.trials),
            |all, texts| put(&mut all.trials, texts, |text| within(text, &(2..=1_000_000_i64))),
        ),
        Parameter::one(
            "seed",
            "SEED",
            "The seed of whatever is left to chance",
            |all| shown(&all.seed),
            |all, texts| put(&mut all.seed, texts, number),
        ),
    ]
}

/// The anchors of a field, and how they are heard.
pub(super) fn field(settings: &Field) -> Result<(Anchors, Signal), Halt> {
    let propagation = Propagation::new(settings.exponent).ok_or_else(|| {
        Diagnostic::usage(
            format_args!("the exponent {} is none", settings.exponent),
            "give an exponent from 2 to 5",
        )
    })?;
    let signal = Signal::new(propagation, settings.noise_db).ok_or_else(|| {
        Diagnostic::usage(
            format_args!("a noise of {} dB is none", settings.noise_db),
            "give decibels from 0 to 100",
        )
    })?;
    Ok((Anchors::new(SQUARE.to_vec()).map_err(refused)?, signal))
}

/// One way to read the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    variant: usize,
}

/// What came of it.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Course {
    /// By the number of iterations.
    pub after: Vec<After>,
}

/// Where particles have come.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct After {
    /// How many iterations.
    pub iterations: u32,
    /// The median distance to the optimum, in metres, and its 95 % interval.
    pub optimum_m: f64,
    /// That interval.
    pub interval_m: [f64; 2],
    /// The share of runs that are less than 5 cm from it.
    pub below_5_cm: Estimate,
    /// The median distance to where the robot is, in metres.
    pub error_m: f64,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    #[serde(flatten)]
    field: Field,
    /// Reading by reading.
    pub variants: Vec<Variant>,
}

/// A reading.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Variant {
    /// Which.
    pub reading: &'static str,
    /// What came of it.
    #[serde(flatten)]
    pub course: Course,
}

impl Table for LocateConvergence {
    type Settings = Field;
    type Job = Job;
    type Measured = Course;
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "locate-convergence",
            shows: "how near particles come to the position at which distances miss least, by the iterations",
            help: "How near particles come to the position at which distances miss least, by the iterations",
            more: "Anchors stand at 0,0, at 20,0 and at 0,20 metres, the robot at random places between 0,0 and 20,20.",
            examples: &[
                "locate-convergence --svg convergence.svg",
                "locate-convergence --noise-db 4 --trials 1000 --format json",
            ],
            doing: "locating",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Field>> {
        parameters("Positions that are found")
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        let draw = |_: &Self, _: &Field, merged: &Merged| Ok(chart(merged).svg());
        vec![Chart { name: "svg", about: "Store the medians as a picture", draw }]
    }

    fn jobs(&self, settings: &Field) -> Result<Vec<Job>, Halt> {
        field(settings)?;
        Ok((0..VARIANTS.len()).map(|variant| Job { variant }).collect())
    }

    fn measure(&self, settings: &Field, job: &Job, _: &dyn Observer) -> Result<Course, Halt> {
        let (anchors, signal) = field(settings)?;
        let unknown = || Diagnostic::usage("there is no such reading", "take the job as tautline wrote it");
        let &(_, order, draws, parameters) = VARIANTS.get(job.variant).ok_or_else(unknown)?;
        let after = |iterations: u32| {
            let parameters = Parameters { order, draws, iterations, ..parameters };
            after(settings, (&anchors, &signal), parameters)
        };
        Ok(Course { after: ITERATIONS.into_iter().map(after).collect::<Result<_, _>>()? })
    }

    fn merge(&self, settings: &Field, results: Vec<(Job, Course)>) -> Result<Merged, Halt> {
        let named = |((reading, ..), (_, course)): (&(&'static str, _, _, _), (Job, Course))| Variant {
            reading,
            course,
        };
        Ok(Merged { field: settings.clone(), variants: VARIANTS.iter().zip(results).map(named).collect() })
    }

    fn text(&self, settings: &Field, merged: &Merged) -> Result<String, Halt> {
        let heading = format!(
            "{PARTICLES} particles, medians of {} positions, noise {} dB, exponent {}, seed {}; after iterations:",
            settings.trials, settings.noise_db, settings.exponent, settings.seed
        );
        let places: Vec<usize> = (0..ITERATIONS.len()).collect();
        let mut figures = Figures::new(heading, &places);
        figures.row("iterations", |&place| ITERATIONS[place].to_string());
        figures.title("distance to the optimum, mm");
        for Variant { reading, course } in &merged.variants {
            figures.row(*reading, |&place| {
                let After { optimum_m, interval_m: [least, most], .. } = course.after[place];
                format!("{:.1} [{:.1}, {:.1}]", 1e3 * optimum_m, 1e3 * least, 1e3 * most)
            });
        }
        figures.title("less than 5 cm from the optimum, % of runs");
        for Variant { reading, course } in &merged.variants {
            figures.row(*reading, |&place| course.after[place].below_5_cm.times(100.0).text(1));
        }
        figures.title("distance to the robot, m");
        for Variant { reading, course } in &merged.variants {
            figures.row(*reading, |&place| format!("{:.2}", course.after[place].error_m));
        }
        Ok(figures.with_notes(&format!("{}\n±, […]: the 95 % interval", compared(merged))))
    }
}

/// The paper's numbers beside ours.
fn compared(merged: &Merged) -> String {
    let mut columns =
        TextTable::new([Column::left(Width::Fit)].into_iter().chain([Column::right(Width::Fit); 3]));
    columns.row(["metres", "paper", "ours", "difference"]);
    let last = ITERATIONS.len() - 1;
    // The place of 20 among the iterations.
    let twenty = ITERATIONS.iter().position(|&iterations| iterations == 20).unwrap_or(last);
    for Variant { reading, course } in &merged.variants {
        let After { optimum_m, error_m, .. } = course.after[twenty];
        let conclusion = course.after[last].optimum_m;
        for (what, paper_m, ours_m) in [
            (format!("{reading}: to the optimum, 20 iterations"), PAPER_M, optimum_m),
            (format!("{reading}: to the optimum, {} iterations", ITERATIONS[last]), CONCLUSION_M, conclusion),
            (format!("{reading}: to the robot, 20 iterations"), PAPER_M, error_m),
        ] {
            columns.row([
                what,
                format!("< {paper_m}"),
                format!("{ours_m:.4}"),
                format!("{:+.4}", ours_m - paper_m),
            ]);
        }
    }
    columns.text()
}

/// Many swarms after so many iterations.
fn after(
    settings: &Field,
    (anchors, signal): (&Anchors, &Signal),
    parameters: Parameters,
) -> Result<After, Halt> {
    let (mut to_optimum, mut to_robot) = (Vec::new(), Vec::new());
    for trial in 0..settings.trials {
        let mut oracle = Seeded::new(settings.seed, trial.into());
        let at = anchors.somewhere(&mut oracle);
        let ranges = distances(anchors.places(), signal, at, signal.noise_db(), &mut oracle);
        let optimum = locate(&ranges, Residual::Metres, signal, None).map_err(refused)?.best().at;
        let around = closed_form(&ranges).map_err(refused)?;
        let mut particles = [Particle::UNUSED; PARTICLES];
        let swarm =
            Swarm::start(&ranges, around, parameters, &mut particles, &mut oracle).map_err(refused)?;
        let found = swarm.run(&mut oracle);
        to_optimum.push(found.distance_m(optimum));
        to_robot.push(found.distance_m(at));
    }
    to_optimum.sort_by(f64::total_cmp);
    to_robot.sort_by(f64::total_cmp);
    let (optimum_m, interval_m) = quantile(&to_optimum, 0.5);
    let below = to_optimum.iter().filter(|&&distance_m| distance_m < PAPER_M).count() as u32;
    let share = Estimate::share(below, settings.trials).unwrap_or(Estimate::NOTHING);
    Ok(After {
        iterations: parameters.iterations,
        optimum_m: decimals(optimum_m, 1e6),
        interval_m: interval_m.map(|end| decimals(end, 1e6)),
        below_5_cm: rounded(share, 1e4),
        error_m: decimals(quantile(&to_robot, 0.5).0, 1e4),
    })
}

/// The medians of each reading as a chart.
fn chart(merged: &Merged) -> LineChart {
    let series = |variant: &Variant| {
        let mark = |after: &After| Mark {
            x: after.iterations.into(),
            y: 1e2 * after.optimum_m,
            interval: Some(after.interval_m.map(|end| 1e2 * end)),
        };
        Series {
            name: variant.reading.to_owned(),
            stroke: Stroke::Solid,
            points: variant.course.after.iter().map(mark).collect(),
        }
    };
    LineChart {
        title: format!("Particles on their way to the optimum, noise {} dB", merged.field.noise_db),
        x: Axis::new("iterations", "").showing([0.0, 50.0]),
        y: Axis::new("median distance to the optimum", "cm").showing([0.0, 5.0]),
        series: merged.variants.iter().map(series).collect(),
    }
}
