//! Figure 4 of [Jiang 2011]: how strong a robot hears a node 20 m off with its directional antenna, by the angle
//! between the antenna and the node. The paper measures two sensors and draws it; its text says that the strength is
//! the greatest straight ahead. The pattern here is the one that [`Antenna`] says. Beside it: how far the strongest of
//! 24 directions is off the node's, by the noise of the measurements, from nodes in every direction.

use tautline_kernel::choice::Oracle;
use tautline_kernel::tan::{Heading, Scan};
use tautline_proofs::engine::SeededOracle;

use super::notice_fig5::RANGE_M;
use super::prelude::*;
use crate::chart;
use tautline_field::radio::{Area, Field, MAX_RANGE_M, Model, Point, Problem, Radio};
use tautline_field::tan::{Antenna, Ear, NEAREST_M, Signal};

/// The paper's distance, in metres.
const DISTANCE_M: f64 = 20.0;

/// The noises that are compared unless others are asked for, in dB.
const NOISES_DB: [f64; 5] = [0.0, 0.5, 1.0, 2.0, 4.0];

/// Figure 4.
#[derive(Clone, Copy, Debug)]
pub struct AntennaFig4;

settings! {
    /// The settings of the figure.
    pub struct Settings {
        /// How far off the node is, in metres
        pub distance_m: f64 = DISTANCE_M, one("distance", "METRES", distance);
        /// Standard deviations of the strengths measured, in dB
        pub noises_db: Vec<f64> = NOISES_DB.into(), list("noise-db", real);
        /// Scans with each, of nodes in random directions
        pub scans: u32 = 10_000, one("runs", "COUNT", from_to(1..=1_000_000));
        /// The seed of all scans
        pub seed: u64 = 0, one("seed", "SEED", number);
    }
}

/// The scans with one noise.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Job {
    noise_db: f64,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    distance_m: f64,
    scans: u32,
    seed: u64,
    /// The pattern, without noise.
    pub pattern: Vec<Angle>,
    /// Noise by noise.
    pub noises: Vec<Noise>,
}

/// The signal heard at an angle.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Angle {
    /// Between the antenna and the node.
    pub degrees: i32,
    /// Above the weakest signal that an antenna all round can hear, in dB; none if nothing is heard.
    pub level_db: Option<f64>,
}

/// How well a scan tells where a node is.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Noise {
    /// The standard deviation, in dB.
    pub noise_db: f64,
    /// The share of the scans whose direction is the nearest of the 24 to the node's.
    pub right: Estimate,
    /// The share of those whose direction is at most one beside it.
    pub beside: Estimate,
    /// How far off it is on average, in degrees.
    pub degrees_off: Estimate,
}

/// A robot in the middle, and a field round it.
struct Stand {
    field: Field,
    robot: Point,
    distance_m: f64,
}

impl Stand {
    fn new(distance_m: f64) -> Result<Self, Problem> {
        // A signal needs an area; nodes do not matter here.
        let side_m = 2.0 * distance_m;
        let area = Area::new(side_m, side_m)?;
        let robot = Point { x_m: distance_m, y_m: distance_m };
        Ok(Self { field: Field::new(area, Vec::new(), vec![robot; 2])?, robot, distance_m })
    }

    /// A node so many degrees from +x.
    fn node(&self, degrees: f64) -> Signal {
        let angle = degrees.to_radians();
        let (x_m, y_m) = (self.distance_m * libm::cos(angle), self.distance_m * libm::sin(angle));
        Signal::plain(Point { x_m: self.robot.x_m + x_m, y_m: self.robot.y_m + y_m })
    }

    fn level_db(&self, ear: &Ear, node: Signal, heading: Heading, chance: &mut dyn Oracle) -> Option<f64> {
        let axis = (&Antenna::DIRECTIONAL, heading);
        let heard = ear.strength(&self.field, node, self.robot, axis, chance);
        heard.map(|strength| f64::from(strength.0) / 100.0)
    }

    /// How far the strongest direction of a scan is off the node's, and the nearest of the 24 directions, in degrees.
    fn scan(&self, ear: &Ear, degrees: u32, chance: &mut dyn Oracle) -> (f64, f64) {
        let node = self.node(f64::from(degrees));
        let mut scan = Scan::START;
        while let Some(heading) = scan.heading() {
            let axis = (&Antenna::DIRECTIONAL, heading);
            scan = scan.measure(ear.strength(&self.field, node, self.robot, axis, chance));
        }
        let off = |heading: Heading| {
            let apart = u32::from(heading.degrees()).abs_diff(degrees) % 360;
            f64::from(apart.min(360 - apart))
        };
        let nearest = Heading::all().map(off).fold(f64::INFINITY, f64::min);
        // What is in range is heard in some direction.
        (scan.best().map_or(180.0, |(_, heading)| off(heading)), nearest)
    }
}

impl Settings {
    fn ear(&self, noise_db: f64) -> Result<Ear, Halt> {
        let radio = Radio::new(RANGE_M.max(self.distance_m), Model::Disc).map_err(usage)?;
        Ear::new(radio, noise_db).map_err(usage)
    }

    fn pattern(&self) -> Result<Vec<Angle>, Halt> {
        let (ear, stand) = (self.ear(0.0)?, Stand::new(self.distance_m).map_err(usage)?);
        let angle = |steps: i32| {
            let degrees = 15 * steps;
            let chance = &mut SeededOracle::new(self.seed, 0);
            let level_db = stand.level_db(&ear, stand.node(f64::from(degrees)), Heading::FIRST, chance);
            Angle { degrees, level_db }
        };
        Ok((-12..=12).map(angle).collect())
    }
}

fn distance(text: &str) -> Result<f64, String> {
    let distance_m = text.parse().ok().filter(|distance_m| (NEAREST_M..=MAX_RANGE_M).contains(distance_m));
    distance_m.ok_or_else(|| format!("write metres from {NEAREST_M} to {MAX_RANGE_M}"))
}

impl Table for AntennaFig4 {
    type Settings = Settings;
    type Job = Job;
    type Sample = Noise;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "antenna-fig4",
            shows: "what a robot hears of a node all round with its directional antenna, and how far off the strongest \
                    direction is from the node's, by the noise",
            help: "What a robot hears of a node all round with its directional antenna, \
                   and how well that tells where the node is",
            more: "A scan is 24 measurements, 15° apart, and its strongest direction the one in which a robot walks.",
            examples: &[
                "antenna-fig4 --svg antenna.svg",
                "antenna-fig4 --distance 5 --noise-db 0,3,6 --format json",
            ],
            doing: "scanning",
            takes: "a second",
            why_none: "the paper draws the strengths of two sensors and prints no number of them",
            pictures: &[("svg", "Store the pattern as a picture")],
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let job = |&noise_db: &f64| settings.ear(noise_db).map(|_| Job { noise_db });
        settings.noises_db.iter().map(job).collect()
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Noise, Halt> {
        let Job { noise_db } = *job;
        let (ear, stand) = (settings.ear(noise_db)?, Stand::new(settings.distance_m).map_err(usage)?);
        let chance = &mut SeededOracle::new(settings.seed, 1);
        let scans: Vec<(f64, f64)> = (0..settings.scans)
            .map(|_| {
                let degrees = chance.pick(360);
                stand.scan(&ear, degrees, chance)
            })
            .collect();
        let within = |beside: f64| {
            let share = share(&scans, |(off, nearest)| *off <= nearest + beside);
            rounded(share.unwrap_or(Estimate::NOTHING), 1e4)
        };
        let off = mean(scans.iter().map(|&(off, _)| off)).unwrap_or(Estimate::NOTHING);
        Ok(Noise { noise_db, right: within(0.0), beside: within(15.0), degrees_off: rounded(off, 1e2) })
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let Settings { distance_m, scans, seed, .. } = *settings;
        let noises = results.into_iter().map(|(_, noise)| noise).collect();
        Ok(Summary { distance_m, scans, seed, pattern: settings.pattern()?, noises })
    }

    fn text(&self, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        let level = |angle: &Angle| match angle.level_db {
            Some(level_db) => format!("{level_db:.2}"),
            None => "nothing".to_owned(),
        };
        let pattern = Columns::of(merged.pattern.iter().filter(|angle| angle.degrees >= 0))
            .right("", |angle| format!("{}°", angle.degrees))
            .right("", level);
        let noises = Columns::of(&merged.noises)
            .right("noise, dB", |noise| Number(noise.noise_db))
            .percent("right, %", 2, |noise| noise.right)
            .percent("one beside, %", 2, |noise| noise.beside)
            .estimate("off, degrees", 2, |noise| noise.degrees_off);
        Ok(format!(
            "A node {} m off: dB above the weakest signal that is heard all round\n\n{}\n\
             Scans of nodes in random directions, {} for each noise, seed {}\n\n{}\n\
             right: the strongest direction is the nearest of the 24 to the node's · one beside: that, or one of the \
             two beside it ·\noff: between the strongest direction and the node's · ±, […]: the 95 % interval\n",
            Number(merged.distance_m),
            pattern.text(),
            merged.scans,
            merged.seed,
            noises.text()
        ))
    }

    fn draw(&self, _: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        let point = |angle: &Angle| Some(chart::Point::plain(angle.degrees.into(), angle.level_db?));
        let chart = LineChart::new(
            format!("What a robot hears of a node {} m off", Number(merged.distance_m)),
            Axis::new("angle between antenna and node", "degrees").showing([-180.0, 180.0]),
            Axis::new("above the weakest signal heard all round", "dB").showing([0.0, 10.0]),
            [Series::measured("directional antenna", merged.pattern.iter().filter_map(point))],
        );
        Ok(chart.svg())
    }
}
