//! How fast particles find the position at which distances miss least (Rajesh et al. 2024, 4 and 7: “the localization
//! error is brought down to less than 5cm in 20 iterations”, “0.02cm or below”): by the order of the updates, by what
//! random numbers are drawn for, by the inertia, and by whether v_max bounds more than the first velocities. Beside it
//! the distance to where the robot is, which is another thing.

use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Draws, Order, Parameters, Particle, Point, Residual, Signal, Swarm, closed_form, locate,
};
use tautline_proofs::engine::SeededOracle;

use super::prelude::*;
use crate::chart;
use tautline_field::position::{Anchors, PARTICLES, distances, refused};
use tautline_field::stats::quantile;

/// The anchors, as in `tautline locate`.
const SQUARE: [Point; 3] = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(0.0, 20.0)];

/// Iterations of a swarm in all.
const ITERATIONS: [u32; 6] = [0, 5, 10, 20, 30, 50];

/// The paper's error after 20 iterations, in metres.
const PAPER_M: f64 = 0.05;

/// The error that the paper's conclusion names, in metres.
const CONCLUSION_M: f64 = 0.0002;

/// How the paper can be read.
const VARIANTS: [(&str, Order, Draws, Parameters); 8] = [
    ("published", Order::Published, Draws::Particle, Parameters::CONTRACTING),
    ("published, a draw for each axis", Order::Published, Draws::Axis, Parameters::CONTRACTING),
    ("published, inertia from 0.9 to 0.4", Order::Published, Draws::Particle, Parameters::FALLING),
    ("published, v_max for the first speeds alone", Order::Published, Draws::Particle, UNBOUNDED),
    ("repaired", Order::Corrected, Draws::Particle, Parameters::CONTRACTING),
    ("repaired, a draw for each axis", Order::Corrected, Draws::Axis, Parameters::CONTRACTING),
    ("repaired, inertia from 0.9 to 0.4", Order::Corrected, Draws::Particle, Parameters::FALLING),
    ("repaired, v_max for the first speeds alone", Order::Corrected, Draws::Particle, UNBOUNDED),
];

/// A swarm by the letter of the steps, which name v_max for the first velocities alone.
const UNBOUNDED: Parameters = Parameters { most_speed_m: f64::INFINITY, ..Parameters::CONTRACTING };

/// Convergence.
#[derive(Clone, Copy, Debug)]
pub struct LocateConvergence;

settings! {
    /// A square with anchors in three corners, and what is tried in it.
    pub struct Field {
        /// The standard deviation of the levels, in dB
        pub noise_db: f64 = 1.0, one("noise-db", "DB", real);
        /// Power falls with the distance to the power of this, from 2 to 5
        pub exponent: f64 = 2.0, one("exponent", "ALPHA", real);
        /// Positions that are found
        pub trials: u32 = 10_000, one("runs", "COUNT", from_to(2..=1_000_000));
        /// The seed of whatever is left to chance
        pub seed: u64 = 0, one("seed", "SEED", number);
    }
}

/// The anchors of a field, and how they are heard.
pub(super) fn field(settings: &Field) -> Result<(Anchors, Signal), Halt> {
    let Field { exponent, noise_db, .. } = settings;
    let no_exponent = || {
        let what = format!("the exponent {} is none", Number(*exponent));
        Diagnostic::usage(what, "give an exponent from 2 to 5")
    };
    let no_noise = || {
        let what = format!("a noise of {} dB is none", Number(*noise_db));
        Diagnostic::usage(what, "give decibels from 0 to 100")
    };
    let propagation = Propagation::new(*exponent).ok_or_else(no_exponent)?;
    let signal = Signal::new(propagation, *noise_db).ok_or_else(no_noise)?;
    Ok((Anchors::new(SQUARE.to_vec()).map_err(refused)?, signal))
}

/// One way to read the paper, by its place in [`VARIANTS`].
type Job = usize;

/// The ends of swarms.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Ends {
    /// By the number of iterations in all.
    pub after: Vec<End>,
}

/// The end of swarms of so many iterations in all: an inertia that falls does so over exactly these.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct End {
    /// How many iterations in all.
    pub iterations: u32,
    /// The median distance to the optimum, in metres, and its 95 % interval.
    pub optimum_m: f64,
    /// That interval.
    pub interval_m: Option<[f64; 2]>,
    /// The share of runs that are less than 5 cm from it.
    pub below_5_cm: Estimate,
    /// The median distance to where the robot is, in metres.
    pub error_m: f64,
    /// Its 95 % interval.
    pub error_interval_m: Option<[f64; 2]>,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
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
    /// The ends of its swarms.
    #[serde(flatten)]
    pub ends: Ends,
}

impl Table for LocateConvergence {
    type Settings = Field;
    type Job = Job;
    type Sample = Ends;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "locate-convergence",
            shows: "how near particles come to the position at which distances miss least, by the iterations",
            help: "How near particles come to the position at which distances miss least, by the iterations",
            more: "Anchors stand at 0,0, at 20,0 and at 0,20 metres, the robot at random places between 0,0 and 20,20.",
            examples: &[
                "locate-convergence --svg convergence.svg",
                "locate-convergence --noise-db 4 --runs 1000 --format json",
            ],
            doing: "locating",
            takes: "some seconds",
            pictures: &[("svg", "Store the medians as a picture")],
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Field) -> Result<Vec<Job>, Halt> {
        field(settings)?;
        Ok((0..VARIANTS.len()).collect())
    }

    fn measure(&self, settings: &Field, &variant: &Job, _: &dyn Observer) -> Result<Ends, Halt> {
        let (anchors, signal) = field(settings)?;
        let unknown = || Diagnostic::usage("there is no such reading", "take the job as tautline wrote it");
        let &(_, order, draws, parameters) = VARIANTS.get(variant).ok_or_else(unknown)?;
        let after = |iterations: u32| {
            let parameters = Parameters { order, draws, iterations, ..parameters };
            after(settings, (&anchors, &signal), parameters)
        };
        Ok(Ends { after: ITERATIONS.into_iter().map(after).collect::<Result<_, _>>()? })
    }

    fn merge(&self, settings: &Field, results: Results<Self>) -> Result<Summary, Halt> {
        let named =
            |((reading, ..), (_, ends)): (&(&'static str, _, _, _), (Job, Ends))| Variant { reading, ends };
        Ok(Summary { field: settings.clone(), variants: VARIANTS.iter().zip(results).map(named).collect() })
    }

    fn text(&self, settings: &Field, merged: &Summary) -> Result<String, Halt> {
        let heading = format!(
            "{PARTICLES} particles, medians of {} positions, noise {} dB, exponent {}, seed {}; \
             swarms of so many iterations in all:",
            settings.trials,
            Number(settings.noise_db),
            settings.exponent,
            settings.seed
        );
        let optimum = |End { optimum_m, interval_m, .. }: End| {
            let ends = |[least, most]: [f64; 2]| format!(" [{:.1}, {:.1}]", 1e3 * least, 1e3 * most);
            format!("{:.1}{}", 1e3 * optimum_m, interval_m.map_or_else(String::new, ends))
        };
        let parts: [(&str, &dyn Fn(End) -> String); 3] = [
            ("distance to the optimum, mm", &optimum),
            ("less than 5 cm from the optimum, % of runs", &|after| percent(after.below_5_cm, 1)),
            ("distance to the robot, m", &|after| format!("{:.2}", after.error_m)),
        ];
        let places: Vec<usize> = (0..ITERATIONS.len()).collect();
        let mut figures = Figures::new(heading, &places);
        figures.row("iterations", |&place| ITERATIONS[place].to_string());
        for (title, of) in parts {
            figures.title(title);
            for Variant { reading, ends } in &merged.variants {
                figures.row(*reading, |&place| of(ends.after[place]));
            }
        }
        Ok(figures.with_notes(&format!("{}\n±, […]: the 95 % interval", compared(merged))))
    }

    /// The paper's bounds on errors.
    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let judged = |(what, paper_m, ours_m, interval_m): Comparison| {
            let verdict = below(interval_m, Some([paper_m; 2]));
            Judgement::new(
                format!("an error below {paper_m} m"),
                what,
                format!("{ours_m:.4} m, the median"),
                verdict,
            )
        };
        let mut judged: Vec<Judgement> = numbers(merged).into_iter().map(judged).collect();
        judged.sort_by(|one, other| one.sentence.cmp(&other.sentence));
        judged
    }

    /// The medians of each reading.
    fn draw(&self, _: usize, settings: &Field, merged: &Summary) -> Result<String, Halt> {
        let point = |after: &End| chart::Point {
            x: after.iterations.into(),
            y: 1e2 * after.optimum_m,
            interval: after.interval_m.map(|ends| ends.map(|end| 1e2 * end)),
        };
        let series = |one: &Variant| Series::measured(one.reading, one.ends.after.iter().map(point));
        let title = format!("How near swarms end to the optimum, noise {} dB", Number(settings.noise_db));
        let x = Axis::new("iterations in all", "").showing([0.0, 50.0]);
        let y = Axis::new("median distance to the optimum", "cm").showing([0.0, 5.0]);
        Ok(LineChart::new(title, x, y, merged.variants.iter().map(series)).svg())
    }
}

/// A number of the paper and ours: of what, how many metres, and the 95 % interval of ours.
type Comparison = (String, f64, f64, Option<[f64; 2]>);

/// The paper's numbers and ours.
fn numbers(merged: &Summary) -> Vec<Comparison> {
    let last = ITERATIONS.len() - 1;
    // The place of 20 among the iterations.
    let twenty = ITERATIONS.iter().position(|&iterations| iterations == 20).unwrap_or(last);
    let numbers = |Variant { reading, ends }: &Variant| {
        // The conclusion does not say after how many iterations.
        let of = [(PAPER_M, twenty), (CONCLUSION_M, twenty), (CONCLUSION_M, last)];
        let both = |(paper_m, place): (f64, usize)| {
            let End { optimum_m, interval_m, error_m, error_interval_m, .. } = ends.after[place];
            let of = |what| format!("{reading}: to the {what}, {} iterations", ITERATIONS[place]);
            [
                (of("optimum"), paper_m, optimum_m, interval_m),
                (of("robot"), paper_m, error_m, error_interval_m),
            ]
        };
        of.map(both).concat()
    };
    merged.variants.iter().flat_map(numbers).collect()
}

/// The paper's numbers beside ours.
fn compared(merged: &Summary) -> String {
    let numbers = numbers(merged);
    Columns::of(&numbers)
        .left("metres", Fit, |(what, ..)| what)
        .right("paper", Fit, |(_, paper_m, ..)| format!("< {paper_m}"))
        .right("ours", Fit, |(_, _, ours_m, _)| format!("{ours_m:.4}"))
        .right("difference", Fit, |(_, paper_m, ours_m, _)| format!("{:+.4}", ours_m - paper_m))
        .text()
}

/// Many swarms of so many iterations in all.
fn after(
    settings: &Field,
    (anchors, signal): (&Anchors, &Signal),
    parameters: Parameters,
) -> Result<End, Halt> {
    let (mut to_optimum, mut to_robot) = (Vec::new(), Vec::new());
    for trial in 0..settings.trials {
        let mut oracle = SeededOracle::new(settings.seed, trial.into());
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
    let (error_m, error_interval_m) = quantile(&to_robot, 0.5);
    let is_near = share(&to_optimum, |&distance_m| distance_m < PAPER_M).unwrap_or(Estimate::NOTHING);
    Ok(End {
        iterations: parameters.iterations,
        optimum_m: decimals(optimum_m, 1e6),
        interval_m: interval_m.map(|ends| ends.map(|end| decimals(end, 1e6))),
        below_5_cm: rounded(is_near, 1e4),
        error_m: decimals(error_m, 1e4),
        error_interval_m: error_interval_m.map(|ends| ends.map(|end| decimals(end, 1e4))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the letter of the paper's steps, which count from 1 and end at the last, particles move two times less.
    #[test]
    fn with_two_moves_less_the_published_order_still_comes_within_5_cm() {
        let settings = Field { noise_db: 1.0, exponent: 2.0, trials: 10_000, seed: 0 };
        let (anchors, signal) = field(&settings).unwrap_or_else(|_| panic!("a field"));
        let optimum_mm = |(_, order, draws, parameters): (_, _, _, Parameters), iterations| {
            let parameters = Parameters { order, draws, iterations, ..parameters };
            let end = after(&settings, (&anchors, &signal), parameters).unwrap_or_else(|_| panic!("an end"));
            (end.optimum_m * 1e3).round() as u32
        };
        assert_eq!(VARIANTS.map(|variant| optimum_mm(variant, 20)), [41, 61, 46, 105, 3, 5, 3, 3]);
        assert_eq!(VARIANTS.map(|variant| optimum_mm(variant, 18)), [45, 63, 50, 105, 4, 6, 4, 4]);
    }
}
