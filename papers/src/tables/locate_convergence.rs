//! How fast particles find the position at which distances miss least (Rajesh et al. 2024, 4 and 7: “the localization
//! error is brought down to less than 5cm in 20 iterations”, “0.02cm or below”): by the order of the updates, by what
//! random numbers are drawn for, by the inertia, by whether v_max bounds more than the first velocities, and by numbers
//! that the paper does not have. Beside it the distance to where the robot is, which is another thing, and the zone of
//! the particles, which “is narrowed down to finer values”: the root mean square of their distances to their mean.

use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Draws, Inertia, Order, Parameters, Particle, Point, Residual, Signal, Swarm, closed_form, locate,
};
use tautline_proofs::engine::SeededOracle;

use super::prelude::*;
use super::sentences::NEAR;
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

/// The orders of the updates.
const ORDERS: [(&str, Order); 2] = [("published", Order::Published), ("repaired", Order::Corrected)];

/// How the paper can be read in either order, and behind these what the numbers that it does not have come to: each in
/// words, with how many particles.
const VARIANTS: [(&str, Draws, Parameters, usize); 11] = [
    ("", Draws::Particle, PLAIN, PARTICLES),
    (", a draw for each axis", Draws::Axis, PLAIN, PARTICLES),
    (", inertia from 0.9 to 0.4", Draws::Particle, Parameters::FALLING, PARTICLES),
    (", v_max for the first speeds alone", Draws::Particle, UNBOUNDED, PARTICLES),
    (", inertia 1", Draws::Particle, Parameters { inertia: Inertia::Constant(1.0), ..PLAIN }, PARTICLES),
    (", inertia 0", Draws::Particle, Parameters { inertia: Inertia::Constant(0.0), ..PLAIN }, PARTICLES),
    (", 10 particles", Draws::Particle, PLAIN, 10),
    (", 20 particles", Draws::Particle, PLAIN, 20),
    (", begun within 2 m", Draws::Particle, Parameters { spread_m: 2.0, ..PLAIN }, PARTICLES),
    (", begun within 10 m", Draws::Particle, Parameters { spread_m: 10.0, ..PLAIN }, PARTICLES),
    (", v_max 0.3 m", Draws::Particle, SLOW, PARTICLES),
];

/// So many of them are readings of the paper.
const READINGS: usize = 4;

/// The place of an inertia that falls among them.
const FALLING: usize = 2;

/// The place of one that keeps the whole velocity.
const WHOLE: usize = 4;

/// The constants that are varied.
const PLAIN: Parameters = Parameters::CONTRACTING;

/// A swarm of less speed.
const SLOW: Parameters = Parameters { first_speed_m: 0.3, most_speed_m: 0.3, ..PLAIN };

/// A swarm by the letter of the steps, which name v_max for the first velocities alone.
const UNBOUNDED: Parameters = Parameters { most_speed_m: f64::INFINITY, ..PLAIN };

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

/// One variant, by its place among those of the first order, and behind them of the second.
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
    /// The median root mean square of the distances of the particles to their mean at the start, in metres.
    pub first_zone_m: f64,
    /// Such a median in the end.
    pub zone_m: f64,
    /// The share of runs in which it is less than at the start.
    pub narrower: Estimate,
    /// The share of runs in which each iteration makes it less.
    pub always_narrower: Estimate,
}

impl End {
    /// The distance to the optimum in millimetres, in words.
    fn optimum_mm(self) -> String {
        let ends = |[least, most]: [f64; 2]| format!(" [{:.1}, {:.1}]", 1e3 * least, 1e3 * most);
        format!("{:.1}{}", 1e3 * self.optimum_m, self.interval_m.map_or_else(String::new, ends))
    }
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
    pub reading: String,
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
        Ok((0..ORDERS.len() * VARIANTS.len()).collect())
    }

    fn measure(&self, settings: &Field, &variant: &Job, _: &dyn Observer) -> Result<Ends, Halt> {
        let (anchors, signal) = field(settings)?;
        let unknown = || Diagnostic::usage("there is no such reading", "take the job as tautline wrote it");
        let &(_, order) = ORDERS.get(variant / VARIANTS.len()).ok_or_else(unknown)?;
        let (_, draws, parameters, particles) = VARIANTS[variant % VARIANTS.len()];
        let after = |iterations: u32| {
            let parameters = Parameters { order, draws, iterations, ..parameters };
            after(settings, (&anchors, &signal), parameters, particles)
        };
        let is_reading = variant % VARIANTS.len() < READINGS;
        let all = if is_reading { &ITERATIONS[..] } else { &[ITERATIONS[TWENTY]] };
        Ok(Ends { after: all.iter().copied().map(after).collect::<Result<_, _>>()? })
    }

    fn merge(&self, settings: &Field, results: Results<Self>) -> Result<Summary, Halt> {
        let names = pairs(ORDERS, VARIANTS).map(|((order, _), (words, ..))| format!("{order}{words}"));
        let variants = names.zip(results).map(|(reading, (_, ends))| Variant { reading, ends });
        Ok(Summary { field: settings.clone(), variants: variants.collect() })
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
        let parts: [(&str, &dyn Fn(End) -> String); 3] = [
            ("distance to the optimum, mm", &End::optimum_mm),
            ("less than 5 cm from the optimum, % of runs", &|after| percent(after.below_5_cm, 1)),
            ("distance to the robot, m", &|after| format!("{:.2}", after.error_m)),
        ];
        let places: Vec<usize> = (0..ITERATIONS.len()).collect();
        let mut figures = Figures::new(heading, &places);
        figures.row("iterations", |&place| ITERATIONS[place].to_string());
        for (title, of) in parts {
            figures.title(title);
            for Variant { reading, ends } in readings(merged) {
                figures.row(reading, |&place| of(ends.after[place]));
            }
        }
        Ok(figures.with_notes(&format!("{}{}\n±, […]: the 95 % interval", compared(merged), varied(merged))))
    }

    /// The paper's bounds on errors, and what it says of zones and of the inertia.
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
        // Of variants that are no readings the best fit alone: the robot is as far as by the others.
        let others = merged.variants.chunks(VARIANTS.len()).flat_map(|order| &order[READINGS..]);
        let others = others.map(|variant| both(variant, PAPER_M, twenty(variant))[0].clone());
        let mut judged: Vec<Judgement> = numbers(merged).into_iter().chain(others).map(judged).collect();
        judged.sort_by(|one, other| one.sentence.cmp(&other.sentence));
        judged.extend(of_zones(merged));
        judged.extend(merged.variants.chunks(VARIANTS.len()).flat_map(of_inertia));
        judged
    }

    /// The medians of each reading.
    fn draw(&self, _: usize, settings: &Field, merged: &Summary) -> Result<String, Halt> {
        let point = |after: &End| chart::Point {
            x: after.iterations.into(),
            y: 1e2 * after.optimum_m,
            interval: after.interval_m.map(|ends| ends.map(|end| 1e2 * end)),
        };
        let series = |one: &Variant| Series::measured(&one.reading, one.ends.after.iter().map(point));
        let title = format!("How near swarms end to the optimum, noise {} dB", Number(settings.noise_db));
        let x = Axis::new("iterations in all", "").showing([0.0, 50.0]);
        let y = Axis::new("median distance to the optimum", "cm").showing([0.0, 5.0]);
        Ok(LineChart::new(title, x, y, readings(merged).map(series)).svg())
    }
}

/// A number of the paper and ours: of what, how many metres, and the 95 % interval of ours.
type Comparison = (String, f64, f64, Option<[f64; 2]>);

/// The place of the last number of [`ITERATIONS`].
const LAST: usize = ITERATIONS.len() - 1;

/// The place of the paper's 20 among them.
const TWENTY: usize = 3;

/// The variants that are readings of the paper.
fn readings(merged: &Summary) -> impl Iterator<Item = &Variant> {
    merged.variants.chunks(VARIANTS.len()).flat_map(|order| &order[..READINGS])
}

/// The end of a variant's swarms of 20 iterations; those that are no readings have no other.
fn twenty(variant: &Variant) -> End {
    let after = &variant.ends.after;
    after[TWENTY.min(after.len() - 1)]
}

/// A number of the paper, and ours of both distances.
fn both(Variant { reading, .. }: &Variant, paper_m: f64, end: End) -> [Comparison; 2] {
    let End { iterations, optimum_m, interval_m, error_m, error_interval_m, .. } = end;
    let of = |what| format!("{reading}: to the {what}, {iterations} iterations");
    [(of("optimum"), paper_m, optimum_m, interval_m), (of("robot"), paper_m, error_m, error_interval_m)]
}

/// The paper's numbers and ours, of each reading.
fn numbers(merged: &Summary) -> Vec<Comparison> {
    let numbers = |variant: &Variant| {
        // The conclusion does not say after how many iterations.
        let of = [(PAPER_M, TWENTY), (CONCLUSION_M, TWENTY), (CONCLUSION_M, LAST)];
        of.map(|(paper_m, place)| both(variant, paper_m, variant.ends.after[place])).concat()
    };
    readings(merged).flat_map(numbers).collect()
}

/// The paper's numbers beside ours.
fn compared(merged: &Summary) -> String {
    let numbers = numbers(merged);
    Columns::of(&numbers)
        .left("metres", |(what, ..)| what)
        .right("paper", |(_, paper_m, ..)| format!("< {paper_m}"))
        .right("ours", |(_, _, ours_m, _)| format!("{ours_m:.4}"))
        .right("difference", |(_, paper_m, ours_m, _)| format!("{:+.4}", ours_m - paper_m))
        .text()
}

/// The paper's 20 iterations of every variant, and the zones of the particles then.
fn varied(merged: &Summary) -> String {
    Columns::of(&merged.variants)
        .title(
            "20 iterations, also by other numbers; the zone is the rms distance of the particles to their mean",
        )
        .left("", |variant| &variant.reading)
        .right("optimum, mm", |variant| twenty(variant).optimum_mm())
        .percent("< 5 cm, %", 1, |variant| twenty(variant).below_5_cm)
        .number("zone, m: first", 2, |variant| twenty(variant).first_zone_m)
        .number("last", 2, |variant| twenty(variant).zone_m)
        .percent("narrower, %", 1, |variant| twenty(variant).narrower)
        .percent("each time, %", 1, |variant| twenty(variant).always_narrower)
        .text()
}

/// A reading of what the paper says of zones: in words, the share of the swarms that do so, and its verdict.
type ZoneReading = (&'static str, fn(End) -> Estimate, fn(Estimate) -> Verdict);

/// The paper's sentence about zones.
fn of_zones(merged: &Summary) -> Vec<Judgement> {
    let zones: [ZoneReading; 2] = [
        ("in each iteration", |end| end.always_narrower, |share| always(Some(share))),
        ("in the end, of nearly all", |end| end.narrower, |share| at_least(NEAR, share)),
    ];
    let judged = |((when, of, verdict), variant): (ZoneReading, &Variant)| {
        let share = of(twenty(variant));
        Judgement::new(
            format!("“the most possible zone … is narrowed down to finer values” (4.2), {when}"),
            &variant.reading,
            format!("{} % of the swarms, {} iterations", percent(share, 1), twenty(variant).iterations),
            verdict(share),
        )
    };
    pairs(zones, readings(merged).collect::<Vec<_>>()).map(judged).collect()
}

/// The paper's sentence about the inertia, of the variants of one order: without it a velocity is kept whole.
fn of_inertia(variants: &[Variant]) -> [Judgement; 2] {
    [0, FALLING].map(|weighted| {
        let [with, without] = [weighted, WHOLE].map(|place| twenty(&variants[place]));
        Judgement::new(
            "“this inertia weight … is to provide faster and accurate results” (4.2), than inertia 1",
            &variants[weighted].reading,
            format!("{} mm from the optimum, with inertia 1 {}", with.optimum_mm(), without.optimum_mm()),
            below(with.interval_m, without.interval_m),
        )
    })
}

/// Many swarms of so many particles, and of so many iterations in all.
fn after(
    settings: &Field,
    (anchors, signal): (&Anchors, &Signal),
    parameters: Parameters,
    particles: usize,
) -> Result<End, Halt> {
    let [mut to_optimum, mut to_robot, mut first_zones, mut zones] = [const { Vec::new() }; 4];
    let (mut narrower, mut always_narrower) = (0, 0);
    let mut particles = vec![Particle::UNUSED; particles];
    for trial in 0..settings.trials {
        let mut oracle = SeededOracle::new(settings.seed, trial.into());
        let at = anchors.somewhere(&mut oracle);
        let ranges = distances(anchors.places(), signal, at, signal.noise_db(), &mut oracle);
        let optimum = locate(&ranges, Residual::Metres, signal, None).map_err(refused)?.best().at;
        let around = closed_form(&ranges).map_err(refused)?;
        let mut swarm =
            Swarm::start(&ranges, around, parameters, &mut particles, &mut oracle).map_err(refused)?;
        let first_m = zone_m(&swarm);
        let (mut last_m, mut is_always) = (first_m, parameters.iterations > 0);
        for _ in 0..parameters.iterations {
            swarm.step(&mut oracle);
            let now_m = zone_m(&swarm);
            is_always &= now_m < last_m;
            last_m = now_m;
        }
        to_optimum.push(swarm.best().distance_m(optimum));
        to_robot.push(swarm.best().distance_m(at));
        first_zones.push(first_m);
        zones.push(last_m);
        narrower += u32::from(last_m < first_m);
        always_narrower += u32::from(is_always);
    }
    for values in [&mut to_optimum, &mut to_robot, &mut first_zones, &mut zones] {
        values.sort_by(f64::total_cmp);
    }
    let (optimum_m, interval_m) = quantile(&to_optimum, 0.5);
    let (error_m, error_interval_m) = quantile(&to_robot, 0.5);
    let of_all = |count| rounded(Estimate::share(count, settings.trials).unwrap_or(Estimate::NOTHING), 1e4);
    let is_near = share(&to_optimum, |&distance_m| distance_m < PAPER_M).unwrap_or(Estimate::NOTHING);
    Ok(End {
        iterations: parameters.iterations,
        optimum_m: decimals(optimum_m, 1e6),
        interval_m: interval_m.map(|ends| ends.map(|end| decimals(end, 1e6))),
        below_5_cm: rounded(is_near, 1e4),
        error_m: decimals(error_m, 1e4),
        error_interval_m: error_interval_m.map(|ends| ends.map(|end| decimals(end, 1e4))),
        first_zone_m: decimals(quantile(&first_zones, 0.5).0, 1e4),
        zone_m: decimals(quantile(&zones, 0.5).0, 1e4),
        narrower: of_all(narrower),
        always_narrower: of_all(always_narrower),
    })
}

/// The zone of the particles: the root mean square of their distances to their mean, in metres.
fn zone_m(swarm: &Swarm<'_>) -> f64 {
    let (count, sum) = swarm.places().fold((0.0, Point::new(0.0, 0.0)), |(count, sum), at| {
        (count + 1.0, Point::new(sum.x_m + at.x_m, sum.y_m + at.y_m))
    });
    let middle = Point::new(sum.x_m / count, sum.y_m / count);
    let squares = swarm.places().map(|at| (at.x_m - middle.x_m).powi(2) + (at.y_m - middle.y_m).powi(2));
    (squares.sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the letter of the paper's steps, which count from 1 and end at the last, particles move two times less.
    #[test]
    fn with_two_moves_less_the_published_order_still_comes_within_5_cm() {
        let settings = Field { noise_db: 1.0, exponent: 2.0, trials: 10_000, seed: 0 };
        let (anchors, signal) = field(&settings).unwrap_or_else(|_| panic!("a field"));
        let optimum_mm = |iterations| -> Vec<u32> {
            let ends =
                pairs(ORDERS, &VARIANTS[..READINGS]).map(|((_, order), &(_, draws, of, particles))| {
                    let parameters = Parameters { order, draws, iterations, ..of };
                    let end = after(&settings, (&anchors, &signal), parameters, particles);
                    (end.unwrap_or_else(|_| panic!("an end")).optimum_m * 1e3).round() as u32
                });
            ends.collect()
        };
        assert_eq!(optimum_mm(20), [41, 61, 46, 105, 3, 5, 3, 3]);
        assert_eq!(optimum_mm(18), [45, 63, 50, 105, 4, 6, 4, 4]);
    }
}
