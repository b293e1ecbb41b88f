//! Options that runs of some schemes can be told, and runs of others not. An option is a field of [`Options`], as a
//! stored run has it, and a row: how it is typed, what it means, and which values make no run.

use std::fmt::{self, Display};
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::number::Number;
use tautline_io::value_parser::{real, whole};
use tautline_kernel::frontier::Threshold;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{Odometry, Signal};

use crate::failures::{Failure, MoveOrder, WallAppearance};
use crate::objects::Objects;
use tautline_grids::chance::Probability;
use tautline_grids::layout::Layout;

/// The options that a run is told, if its scheme can be told them. The default is an option of which nobody says
/// anything.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Options {
    /// Farther than so many cells no message is heard. Without it all are; robots that keep in touch hear 10 m, those
    /// of a pack 60 cells.
    pub range_cells: Option<u16>,
    /// How many cells robots see; without it 20.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sight_cells: Option<u16>,
    /// How likely it is that a message is lost, for each robot that could hear it.
    pub loss: Probability,
    /// The standard deviation of the noise with which a robot hears each anchor, in dB.
    pub noise_db: f64,
    /// How many beacons of each anchor a robot averages at each stop; without it 100.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub readings: Option<u16>,
    /// How many anchors there are, of which a robot takes the best three; without it 3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchors: Option<u8>,
    /// How far the wheels of robots err; without it, where positions have noise, 2 % of the way and 1° a turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub odometry: Option<Wheels>,
    /// The objects that robots look for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub objects: Option<Objects>,
    /// How likely it is that an anchor is heard fainter at a stop, by 10 dB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outliers: Option<Probability>,
    /// Whether robots find their fixes by a swarm, as in the paper; without it by least squares.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub swarm: bool,
    /// How likely it is that an obstacle that is smaller than a cell stands between two cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub small: Option<Probability>,
    /// The threshold T of the occupancy probability, from 0 to 1.
    pub threshold: f64,
    /// How fast robots that keep in touch drive, in metres a second; without it 0.3.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_mps: Option<f64>,
    /// By which share of it each of their drives may be faster or slower, below 1; without it 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<f64>,
    /// Which robot dies, and when.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fail: Option<Failure>,
    /// Which wall appears, and when.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<WallAppearance>,
    /// In what order robots go.
    #[serde(default, skip_serializing_if = "MoveOrder::is_usual")]
    pub going: MoveOrder,
}

impl Options {
    /// The options where nobody says anything.
    pub const USUAL: Self = Self {
        range_cells: None,
        sight_cells: None,
        loss: Probability::NEVER,
        noise_db: 0.0,
        readings: None,
        anchors: None,
        odometry: None,
        objects: None,
        outliers: None,
        swarm: false,
        small: None,
        threshold: 0.5,
        speed_mps: None,
        spread: None,
        fail: None,
        wall: None,
        going: MoveOrder::AtOnce,
    };

    /// How many beacons of each anchor a robot averages at each stop.
    pub fn readings(&self) -> u16 {
        self.readings.unwrap_or(100)
    }

    /// How many anchors there are.
    pub fn anchors(&self) -> u8 {
        self.anchors.unwrap_or(3)
    }

    /// How far wheels err: exact where nothing is said and positions have no noise.
    pub fn odometry(&self) -> Odometry {
        let usual = if self.noise_db > 0.0 { Odometry::USUAL } else { Odometry::EXACT };
        let told = self.odometry.and_then(|wheels| Odometry::new(wheels.share, wheels.turn_degrees));
        told.unwrap_or(usual)
    }

    /// The signal of one beacon, and of the mean of those that are averaged; `None` if there is no noise.
    pub fn signals(&self) -> Option<[Signal; 2]> {
        let of = |noise_db| Signal::new(Propagation::FREE_SPACE, noise_db).filter(|_| self.noise_db > 0.0);
        Some([of(self.noise_db)?, of(self.noise_db / f64::from(self.readings().max(1)).sqrt())?])
    }

    /// The failures that are told for later than a run of so many team moves: each field, and its team move.
    pub fn due_after(&self, steps: u32) -> impl Iterator<Item = (&'static str, u32)> {
        let told = [("fail", self.fail.map(|fail| fail.step)), ("wall", self.wall.map(|wall| wall.step))];
        let due = told.into_iter().filter_map(|(field, step)| Some((field, step?.get())));
        due.filter(move |&(_, step)| step > steps)
    }

    /// The threshold; ½ if it is none.
    pub fn threshold(&self) -> Threshold {
        Threshold::new(self.threshold).unwrap_or(Threshold::HALF)
    }
}

impl Default for Options {
    fn default() -> Self {
        Self::USUAL
    }
}

/// How far wheels err, as standard deviations: `0.02:1` is 2 % of the way and 1° a turn.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wheels {
    /// The error of a drive, as a share of its way from 0 to 1.
    pub share: f64,
    /// The error of a turn, in degrees from 0 to 90.
    pub turn_degrees: f64,
}

impl FromStr for Wheels {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once(':').ok_or("write a share of the way and degrees, such as 0.02:1")?;
        Ok(Self { share: real(parts.0)?, turn_degrees: real(parts.1)? })
    }
}

impl Display for Wheels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", Number(self.share), Number(self.turn_degrees))
    }
}

/// How an option is typed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Takes {
    /// By its name alone.
    Nothing,
    /// With a word, which is called so.
    Word(&'static str),
    /// With a number that need not be whole, which is called so.
    Real(&'static str),
}

/// The fault of a value, and its remedy.
pub type Wrong = (String, String);

/// An option as a row.
pub struct Extra {
    /// The field that tells it: its name on the command line.
    pub field: &'static str,
    /// Another name.
    pub alias: Option<&'static str>,
    /// How it is typed.
    pub takes: Takes,
    /// Its meaning, for the help.
    pub about: &'static str,
    /// Reads what is typed.
    pub read: fn(&str, &mut Options) -> Result<(), String>,
    /// An assumption of the clauses that a run need not keep to which is told it.
    pub assumed: Option<&'static str>,
    /// How it would be typed, if it is told.
    pub typed: fn(&Options) -> Option<String>,
    /// Its fault for so many robots in a layout.
    pub wrong: fn(&Options, u16, &Layout) -> Option<Wrong>,
    /// Its fault if it is told twice, where that is worth a word.
    pub twice: Option<fn(&str, &str) -> Wrong>,
}

/// Puts what is read into its place.
fn put<T, E: Display>(read: Result<T, E>, place: &mut T) -> Result<(), String> {
    *place = read.map_err(|error| error.to_string())?;
    Ok(())
}

/// The row of an option that is a value or none: its name, its field, and how it is read.
macro_rules! told {
    ($name:literal, $field:ident, $read:expr) => {
        Self {
            read: |text, options| put($read(text).map(Some), &mut options.$field),
            typed: |options| words(options.$field.as_ref()),
            ..Self::new($name)
        }
    };
}

/// A value in words, if there is one.
fn words<T: Display>(value: Option<T>) -> Option<String> {
    value.map(|value| value.to_string())
}

/// The fault of a value, if it is not as it should be.
fn unless(is_right: bool, what: impl Display, remedy: impl Display) -> Option<Wrong> {
    (!is_right).then(|| (what.to_string(), remedy.to_string()))
}

impl Extra {
    /// How far messages are heard.
    pub const RANGE: &'static Self = &Self {
        takes: Takes::Word("CELLS"),
        about: "How many cells a message of robots that explore cells is heard; without it all hear it. Robots \
                that keep in touch hear 2 to 5 cells; without it 10 m, and a cell is 3 m wide. Robots of a \
                pack hear 3 cells or more; without it 60",
        ..told!("range", range_cells, whole)
    };

    /// How far robots see.
    pub const SIGHT: &'static Self = &Self {
        takes: Takes::Word("CELLS"),
        about: "How many cells robots of a pack see, from 1 to 31. Without it 20",
        ..told!("sight", sight_cells, whole)
    };

    /// How likely messages are lost.
    pub const LOSS: &'static Self = &Self {
        alias: Some("lose"),
        takes: Takes::Real("PROBABILITY"),
        about: "How likely it is that a message of robots that explore cells, or a byte of a chain, is lost, from 0 to \
                1. Without it 0",
        read: |text, options| put(text.parse(), &mut options.loss),
        typed: |options| words(Some(options.loss).filter(|loss| !loss.is_never())),
        ..Self::new("loss")
    };

    /// The noise of positions.
    pub const NOISE: &'static Self = &Self {
        takes: Takes::Real("DECIBELS"),
        about: "The noise of the signals by which robots that explore cells find their positions, in decibels. \
                Without it 0",
        read: |text, options| put(real(text), &mut options.noise_db),
        typed: |options| words(unusual(options.noise_db, Options::USUAL.noise_db)),
        wrong: |options, _, _| {
            let is_right = (0.0..=100.0).contains(&options.noise_db);
            let remedy = "give `noise-db` a number of decibels from 0 to 100";
            unless(is_right, "a standard deviation of noise is from 0 to 100 dB", remedy)
        },
        assumed: Some(
            "positions that are off by less than half a cell (FRONTIER-6, FRONTIER-7, FRONTIER-10)",
        ),
        ..Self::new("noise-db")
    };

    /// How many beacons are averaged.
    pub const READINGS: &'static Self = &Self {
        takes: Takes::Word("BEACONS"),
        about: "How many beacons of each anchor a robot averages at each stop; with 0 it \
                goes by its wheels alone. Without it 100",
        ..told!("readings", readings, whole)
    };

    /// How many anchors there are.
    pub const ANCHORS: &'static Self = &Self {
        takes: Takes::Word("ANCHORS"),
        about: "How many anchors stand around the area, from 3 to 8: in its corners, then in the middle of its sides. \
                A robot takes the best three. Without it 3",
        wrong: |options, _, _| {
            let is_right = (3..=8).contains(&options.anchors());
            let what = "a position takes three anchors, and there is room for 8";
            unless(is_right, what, "give `anchors` 3 to 8")
        },
        ..told!("anchors", anchors, whole)
    };

    /// How far wheels err.
    pub const ODOMETRY: &'static Self = &Self {
        takes: Takes::Real("SHARE:DEGREES"),
        about: "By which share of the way each drive errs, and by how many degrees each turn, as standard deviations. \
                Without it 0.02:1 where positions have noise, else 0:0",
        wrong: |options, _, _| {
            let Wheels { share, turn_degrees } = options.odometry?;
            let is_right = Odometry::new(share, turn_degrees).is_some();
            let what = format_args!("wheels do not err by {share} of the way and {turn_degrees}° a turn");
            let remedy =
                "give `odometry` a share of the way from 0 to 1 and degrees from 0 to 90, such as 0.02:1";
            unless(is_right, what, remedy)
        },
        assumed: Some("moves that are off by less than half a cell (FRONTIER-6, FRONTIER-7, FRONTIER-10)"),
        ..told!("odometry", odometry, str::parse)
    };

    /// The threshold of the occupancy probability.
    pub const THRESHOLD: &'static Self = &Self {
        takes: Takes::Real("PROBABILITY"),
        about: "Below which occupancy probability a cell is a candidate, from 0 to 1. Without it 0.5",
        read: |text, options| put(real(text), &mut options.threshold),
        typed: |options| words(unusual(options.threshold, Options::USUAL.threshold)),
        wrong: |options, _, _| {
            let is_right = Threshold::new(options.threshold).is_some();
            let what = "a threshold of the occupancy probability is from 0 to 1";
            unless(is_right, what, "give `threshold` a number from 0 to 1")
        },
        ..Self::new("threshold")
    };

    /// Which objects robots look for.
    pub const OBJECTS: &'static Self = &Self {
        takes: Takes::Real("COUNT|COLUMN:ROW,…"),
        about: "How many objects robots look for, each somewhere in a cell that they can reach, or where the objects \
                are: a cell's column and row are its midpoint, as in 1.5:2,3:4",
        wrong: |options, _, layout| options.objects.as_ref()?.wrong(layout),
        ..told!("objects", objects, str::parse)
    };

    /// How likely a level is an outlier.
    pub const OUTLIERS: &'static Self = &Self {
        takes: Takes::Real("PROBABILITY"),
        about: "How likely it is at each stop that an anchor is heard 10 dB fainter, as behind a wall, from 0 to 1. \
                Without it 0",
        wrong: |options, _, _| {
            let is_right = options.outliers.is_none() || options.noise_db > 0.0;
            unless(is_right, "positions without noise have no outliers", "give `noise-db` as well")
        },
        assumed: Self::NOISE.assumed,
        ..told!("outliers", outliers, str::parse)
    };

    /// How robots find their positions.
    pub const SWARM: &'static Self = &Self {
        about: "Robots find each position by a swarm of particles, as in the paper, in place of least squares",
        read: |_, options| {
            options.swarm = true;
            Ok(())
        },
        typed: |options| options.swarm.then(String::new),
        wrong: |options, _, _| {
            let is_right = !options.swarm || options.noise_db > 0.0;
            unless(is_right, "positions without noise need no swarm", "give `noise-db` as well")
        },
        ..Self::new("swarm")
    };

    /// How likely small obstacles are.
    pub const SMALL: &'static Self = &Self {
        takes: Takes::Real("PROBABILITY"),
        about: "How likely it is that an obstacle that is smaller than a cell stands between two cells, from 0 to 1: a \
                robot goes round it, which takes it a team move. Without it 0",
        ..told!("small", small, str::parse)
    };

    /// How fast robots drive.
    pub const SPEED: &'static Self = &Self {
        takes: Takes::Real("METRES"),
        about: "How fast robots that keep in touch drive, in metres a second. Without it 0.3",
        wrong: |options, _, _| {
            let is_right = options.speed_mps.is_none_or(|speed| (0.001..=1000.0).contains(&speed));
            let remedy = "give `speed` a number of metres a second from 0.001 to 1000";
            unless(is_right, "a robot drives from 0.001 to 1000 m/s", remedy)
        },
        ..told!("speed", speed_mps, real)
    };

    /// How much their speeds differ.
    pub const SPREAD: &'static Self = &Self {
        takes: Takes::Real("SHARE"),
        about: "By which share each of their drives may be faster or slower, from 0 to 0.999. Without it 0",
        wrong: |options, _, _| {
            let is_right = options.spread.is_none_or(|spread| (0.0..=0.999).contains(&spread));
            let what = "drives are faster or slower by less than the whole speed";
            unless(is_right, what, "give `spread` a share from 0 to 0.999")
        },
        typed: |options| words(options.spread.map(Number)),
        ..told!("spread", spread, real)
    };

    /// Which robot dies, and when.
    pub const FAIL: &'static Self = &Self {
        takes: Takes::Word("ROBOT@MOVE"),
        about: "Which robot of a chain dies, and in which team move: the others go on as a chain of one fewer",
        wrong: |options, robots, _| {
            let robot = options.fail?.robot;
            let what = match robot {
                1 => "the base cannot fail: there is no chain without it".to_owned(),
                _ => format!("there is no robot {robot} that could fail among {robots}"),
            };
            let remedy = format_args!("name a robot from 2 to {robots}, as in {robots}@20");
            unless((2..=robots).contains(&robot), what, remedy)
        },
        twice: Some(|one, other| {
            let what = format!("two robots die in one run, {one} and {other}: a chain re-forms behind one");
            (what, "give `--fail` once".to_owned())
        }),
        ..told!("fail", fail, str::parse)
    };

    /// Which wall appears, and when.
    pub const WALL: &'static Self = &Self {
        takes: Takes::Word("X,Y,SIDE@MOVE"),
        about: "On which side of a cell a wall appears while a chain explores, \
                and from which team move on: E, S, W or N",
        wrong: |options, _, layout| {
            let (cell, edge) = options.wall.map(|wall| (wall.cell, wall.edge()))?;
            let sides = [cell, edge.cell(), edge.cell().beyond(edge.side())];
            let is_between = sides.iter().all(|&cell| layout.contains(cell));
            let what = format_args!(
                "no wall can appear on that side of the cell {cell}: it is not between two cells"
            );
            let remedy = "name a side between two cells of the layout, as in 7,6,E@20";
            let shut =
                "a wall that appears may shut the way over which the others re-form behind a robot that dies";
            unless(is_between, what, remedy)
                .or_else(|| unless(options.fail.is_none(), shut, "give `wall` and `fail` to two runs"))
        },
        ..told!("wall", wall, str::parse)
    };

    /// In what order robots go.
    pub const SPEEDS: &'static Self = &Self {
        about: "The robots of a chain go one after the other, in a new random order in each team move",
        read: |_, options| {
            options.going = MoveOrder::OneByOne;
            Ok(())
        },
        typed: |options| (!options.going.is_usual()).then(String::new),
        ..Self::new("speeds")
    };

    /// All of them.
    pub const ALL: [&'static Self; 17] = [
        Self::RANGE,
        Self::SIGHT,
        Self::LOSS,
        Self::NOISE,
        Self::READINGS,
        Self::ANCHORS,
        Self::ODOMETRY,
        Self::THRESHOLD,
        Self::OBJECTS,
        Self::OUTLIERS,
        Self::SWARM,
        Self::SMALL,
        Self::SPEED,
        Self::SPREAD,
        Self::FAIL,
        Self::WALL,
        Self::SPEEDS,
    ];

    /// An option of which nothing but its name is said.
    const fn new(field: &'static str) -> Self {
        Self {
            field,
            alias: None,
            assumed: None,
            takes: Takes::Nothing,
            about: "",
            read: |_, _| Ok(()),
            typed: |_| None,
            wrong: |_, _, _| None,
            twice: None,
        }
    }

    /// Whether `options` tell it.
    pub fn is_told_by(&self, options: &Options) -> bool {
        (self.typed)(options).is_some()
    }
}

/// A number that is not the usual one, bit by bit.
fn unusual(number: f64, usual: f64) -> Option<Number> {
    Some(Number(number)).filter(|_| number.to_bits() != usual.to_bits())
}

impl PartialEq for Extra {
    fn eq(&self, other: &Self) -> bool {
        self.field == other.field
    }
}

impl Eq for Extra {}

impl fmt::Debug for Extra {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.field)
    }
}
