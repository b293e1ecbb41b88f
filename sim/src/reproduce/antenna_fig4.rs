//! Figure 4 of paper 003: how strong a robot hears a node 20 m off with its directional antenna, by the angle between the
//! antenna and the node. The paper measures two sensors and draws it; its text says that the strength is the greatest
//! straight ahead. The pattern here is the one that [`Antenna`] says. Beside it: how far the strongest of 24 directions is
//! off the node's, by the noise of the measurements, from nodes in every direction.

use serde::Serialize;
use tautline_kernel::choice::Oracle;
use tautline_kernel::tan::{Heading, Scan};
use tautline_proofs::engine::Seeded;

use super::interval::{Estimate, rounded};
use super::notice_fig5::{RANGE_M, usage};
use crate::draw::chart::{Axis, LineChart, Point as Mark, Series, Stroke};
use crate::fault::Halt;
use crate::radio::{Area, Field, Model, Point, Problem, Radio};
use crate::tan::{Antenna, Ear, Signal};

/// The paper's distance, in metres.
pub const DISTANCE_M: f64 = 20.0;

/// The noises that are compared unless others are asked for, in dB.
pub const NOISES_DB: [f64; 5] = [0.0, 0.5, 1.0, 2.0, 4.0];

/// What is measured.
#[derive(Clone, PartialEq, Debug)]
pub struct Setting {
    /// How far off the node is, in metres.
    pub distance_m: f64,
    /// The standard deviations of the strengths measured, in dB.
    pub noises_db: Vec<f64>,
    /// Scans with each.
    pub scans: u32,
    /// The seed of all of them.
    pub seed: u64,
}

/// What is measured, all of it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Measured {
    /// The pattern, without noise.
    pub pattern: Vec<Angle>,
    /// Noise by noise.
    pub noises: Vec<Noise>,
}

/// What is heard at an angle.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Angle {
    /// Between the antenna and the node.
    pub degrees: i32,
    /// Above the weakest signal that an antenna all round can hear, in dB; none if nothing is heard.
    pub level_db: Option<f64>,
}

/// How well a scan tells where a node is.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
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

impl Setting {
    /// Measures everything.
    ///
    /// # Errors
    /// [`Halt`] if a number is out of bounds.
    pub fn measure(&self) -> Result<Measured, Halt> {
        let radio = Radio::new(RANGE_M.max(self.distance_m), Model::Disc).map_err(usage)?;
        let stand = Stand::new(self.distance_m).map_err(usage)?;
        let noise = |&noise_db: &f64| Ok(self.noise(&stand, noise_db, &Ear::new(radio, noise_db)?));
        let noises = self.noises_db.iter().map(noise).collect::<Result<_, Problem>>().map_err(usage)?;
        let ear = Ear::new(radio, 0.0).map_err(usage)?;
        let angle = |steps: i32| {
            let degrees = 15 * steps;
            let chance = &mut Seeded::new(self.seed, 0);
            let level_db = stand.level_db(&ear, stand.node(f64::from(degrees)), Heading::FIRST, chance);
            Angle { degrees, level_db }
        };
        Ok(Measured { pattern: (-12..=12).map(angle).collect(), noises })
    }

    fn noise(&self, stand: &Stand, noise_db: f64, ear: &Ear) -> Noise {
        let chance = &mut Seeded::new(self.seed, 1);
        let scans: Vec<(f64, f64)> = (0..self.scans)
            .map(|_| {
                let degrees = chance.pick(360);
                stand.scan(ear, degrees, chance)
            })
            .collect();
        let share = |beside: f64| {
            let hits = scans.iter().filter(|(off, nearest)| *off <= nearest + beside).count() as u32;
            rounded(Estimate::share(hits, self.scans).unwrap_or(Estimate::NOTHING), 1e4)
        };
        let off: Vec<f64> = scans.iter().map(|&(off, _)| off).collect();
        Noise {
            noise_db,
            right: share(0.0),
            beside: share(15.0),
            degrees_off: rounded(Estimate::of_values(&off).unwrap_or(Estimate::NOTHING), 1e2),
        }
    }
}

/// The pattern as a chart.
pub fn chart(pattern: &[Angle], distance_m: f64) -> LineChart {
    let point = |angle: &Angle| {
        let y = angle.level_db?;
        Some(Mark { x: f64::from(angle.degrees), y, interval: None })
    };
    LineChart {
        title: format!("What a robot hears of a node {distance_m} m off"),
        x: Axis::new("angle between antenna and node", "degrees").showing([-180.0, 180.0]),
        y: Axis::new("above the weakest signal heard all round", "dB").showing([0.0, 10.0]),
        series: vec![Series {
            name: "directional antenna".to_owned(),
            stroke: Stroke::Solid,
            points: pattern.iter().filter_map(point).collect(),
        }],
    }
}
