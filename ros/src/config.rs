//! Who is watched by which clauses: a configuration in TOML, read whole and refused whole.

use clap::ValueEnum;
use serde::Deserialize;
use std::fmt;
use std::time::Duration;
use toml::Spanned;

/// The most robots that a clause can be of.
pub const MOST_ROBOTS: usize = 64;

/// A configuration that can be run.
#[derive(Clone, PartialEq, Debug)]
pub struct Config {
    /// The age at which a position is no longer believed.
    pub gap: Duration,
    /// The frame that poses have to be in; without it, that of the first pose.
    pub frame: Option<String>,
    /// The robots.
    pub robots: Vec<Robot>,
    /// The clauses.
    pub clauses: Vec<Clause>,
}

/// A robot, and where its poses are published.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Robot {
    /// The name that diagnostics and configuration call it by.
    pub name: String,
    /// The topic of its poses.
    pub topic: String,
    /// The type of their messages.
    pub kind: Kind,
}

/// The types of messages that have a pose.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug, Deserialize)]
pub enum Kind {
    /// `geometry_msgs/PoseStamped`.
    #[default]
    #[serde(rename = "geometry_msgs/PoseStamped")]
    PoseStamped,
    /// `nav_msgs/Odometry`.
    #[serde(rename = "nav_msgs/Odometry")]
    Odometry,
}

/// A clause that robots are watched by.
#[derive(Clone, PartialEq, Debug)]
pub struct Clause {
    /// The name that `SPEC.md` has for it.
    pub id: Id,
    /// The numbers of its robots; neighbours in a chain follow each other.
    pub robots: Vec<usize>,
    /// The range, the least distance or the width of a cell.
    pub length_mm: u32,
    /// How far off a position may be, or a distance.
    pub tolerance_mm: u32,
    /// The column and the row of the cell of the base.
    pub base: Option<[i32; 2]>,
}

/// The clauses that positions decide.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize, clap::ValueEnum)]
#[allow(missing_docs)]
pub enum Id {
    #[serde(rename = "CHAIN-2")]
    #[value(name = "CHAIN-2")]
    Chain2,
    #[serde(rename = "CHAIN-3")]
    #[value(name = "CHAIN-3")]
    Chain3,
    #[serde(rename = "FRONTIER-2")]
    #[value(name = "FRONTIER-2")]
    Frontier2,
    #[serde(rename = "KIT-1")]
    #[value(name = "KIT-1")]
    Kit1,
    #[serde(rename = "KIT-2")]
    #[value(name = "KIT-2")]
    Kit2,
    #[serde(rename = "KIT-3")]
    #[value(name = "KIT-3")]
    Kit3,
    #[serde(rename = "KIT-12")]
    #[value(name = "KIT-12")]
    Kit12,
    #[serde(rename = "PACK-2")]
    #[value(name = "PACK-2")]
    Pack2,
}

impl Id {
    /// The length that the clause is about, as the configuration calls it.
    const fn length(self) -> &'static str {
        match self {
            Self::Chain3 | Self::Kit1 | Self::Kit2 | Self::Kit12 => "range_m",
            Self::Kit3 => "least_m",
            Self::Chain2 | Self::Frontier2 | Self::Pack2 => "cell_m",
        }
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.to_possible_value().as_ref().map_or("", |value| value.get_name()))
    }
}

/// The reason why a configuration is refused.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ConfigError {
    /// It is no TOML, or has what is not known; the text of the parser, with the line.
    Toml(String),
    /// A value that cannot be, at a byte of the text or on the command line.
    Wrong {
        /// The byte.
        at: usize,
        /// A sentence that says what is wrong, and what would be right.
        why: String,
    },
}

impl ConfigError {
    /// The error for a person, with the name of the file and the line.
    pub fn in_file(&self, name: &str, text: &str) -> String {
        match self {
            Self::Toml(why) => format!("{name}: {}", why.trim_end()),
            Self::Wrong { at, why } => {
                let before = text.get(..*at).unwrap_or_default();
                format!("{name}:{}: {why}", before.matches('\n').count() + 1)
            }
        }
    }

    /// The error for a person who gave options on the command line, and so knows no text with lines.
    pub fn in_options(&self) -> &str {
        match self {
            Self::Toml(why) | Self::Wrong { why, .. } => why.trim_end(),
        }
    }
}

/// The file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    gap_s: Spanned<f64>,
    frame: Option<String>,
    #[serde(default)]
    robots: Vec<RobotTable>,
    #[serde(default)]
    clauses: Vec<ClauseTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RobotTable {
    name: Spanned<String>,
    topic: Option<Spanned<String>>,
    #[serde(default, rename = "type")]
    kind: Kind,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClauseTable {
    clause: Spanned<Id>,
    robots: Option<Vec<Spanned<String>>>,
    range_m: Option<Spanned<f64>>,
    least_m: Option<Spanned<f64>>,
    cell_m: Option<Spanned<f64>>,
    tolerance_m: Spanned<f64>,
    base: Option<Spanned<[i32; 2]>>,
}

/// The refusal of what stands at a byte.
fn wrong(at: usize, why: impl Into<String>) -> ConfigError {
    ConfigError::Wrong { at, why: why.into() }
}

/// A length in millimetres, to the nearest.
fn millimetres(metres: &Spanned<f64>, name: &str, least_mm: u32) -> Result<u32, ConfigError> {
    let mm = (metres.get_ref() * 1_000.0).round();
    if (f64::from(least_mm)..=1e9).contains(&mm) {
        return Ok(mm as u32);
    }
    let least = if least_mm == 0 { "0" } else { "0.001" };
    Err(wrong(metres.span().start, format!("{name} is from {least} to 1000000 metres")))
}

impl RobotTable {
    fn check(self, before: &[Robot]) -> Result<Robot, ConfigError> {
        let at = self.name.span().start;
        let name = self.name.into_inner();
        let topic_at = self.topic.as_ref().map_or(at, |topic| topic.span().start);
        let topic = self.topic.map_or_else(|| format!("/{name}/pose"), Spanned::into_inner);
        if before.iter().any(|robot| robot.name == name) {
            return Err(wrong(at, format!("two robots are called {name}: give each a name of its own")));
        }
        if let Some(robot) = before.iter().find(|robot| robot.topic == topic) {
            let why = format!(
                "{name} would hear the topic of {}, {topic}: give each a topic of its own",
                robot.name
            );
            return Err(wrong(topic_at, why));
        }
        if !topic.starts_with('/') || ros2_client::Name::parse(&topic).is_err() {
            let why =
                format!("{topic:?} is no name of a topic: write letters, digits and _ as in /robot_1/pose");
            return Err(wrong(topic_at, why));
        }
        Ok(Robot { name, topic, kind: self.kind })
    }
}

impl ClauseTable {
    fn check(self, all: &[Robot]) -> Result<Clause, ConfigError> {
        let (at, id) = (self.clause.span().start, self.clause.into_inner());
        let numbered = |name: &Spanned<String>| {
            let number = all.iter().position(|robot| robot.name == *name.get_ref());
            let known = || all.iter().map(|robot| robot.name.as_str()).collect::<Vec<_>>().join(", ");
            let why = || format!("no robot is called {}: there are {}", name.get_ref(), known());
            number.ok_or_else(|| wrong(name.span().start, why()))
        };
        let robots: Vec<usize> = match &self.robots {
            Some(names) => names.iter().map(numbered).collect::<Result<_, _>>()?,
            None => (0..all.len()).collect(),
        };
        if robots.iter().enumerate().any(|(place, robot)| robots[..place].contains(robot)) {
            return Err(wrong(at, format!("a robot of {id} is named twice: name each once")));
        }
        if !(2..=MOST_ROBOTS).contains(&robots.len()) {
            let why = format!("{id} is of 2 to {MOST_ROBOTS} robots, not of {}", robots.len());
            return Err(wrong(at, why));
        }
        if matches!(id, Id::Kit1 | Id::Kit2) && robots.len() != 2 {
            let why = format!(
                "{id} speaks of two robots, not of {}: name two, or take KIT-12 of all",
                robots.len()
            );
            return Err(wrong(at, why));
        }
        let mut length = None;
        for (name, given) in [("range_m", self.range_m), ("least_m", self.least_m), ("cell_m", self.cell_m)] {
            match given {
                Some(metres) if name == id.length() => length = Some(millimetres(&metres, name, 1)?),
                Some(metres) => {
                    let why = format!("{id} has no {name}: give its {}", id.length());
                    return Err(wrong(metres.span().start, why));
                }
                None => {}
            }
        }
        let length_mm = length.ok_or_else(|| wrong(at, format!("{id} needs its {}", id.length())))?;
        let tolerance_mm = millimetres(&self.tolerance_m, "tolerance_m", 0)?;
        let (below, of) = match id.length() {
            "cell_m" => (length_mm.div_ceil(2), "half its"),
            _ => (length_mm, "its"),
        };
        if tolerance_mm >= below {
            let why = format!(
                "with this tolerance positions say nothing of {id}: give a tolerance_m below {of} {}",
                id.length()
            );
            return Err(wrong(self.tolerance_m.span().start, why));
        }
        if let Some(base) = self.base.as_ref().filter(|_| id != Id::Chain2) {
            return Err(wrong(base.span().start, format!("{id} has no base: CHAIN-2 alone has one")));
        }
        Ok(Clause { id, robots, length_mm, tolerance_mm, base: self.base.map(Spanned::into_inner) })
    }
}

impl Config {
    /// The configuration that a text in TOML says.
    ///
    /// # Errors
    /// It is no TOML, it has a name that is not known, or it watches nobody.
    pub fn parse(text: &str) -> Result<Self, ConfigError> {
        let file: File = toml::from_str(text).map_err(|error| ConfigError::Toml(error.to_string()))?;
        let seconds = *file.gap_s.get_ref();
        if !(0.001..=3_600.0).contains(&seconds) {
            return Err(wrong(file.gap_s.span().start, "gap_s is from 0.001 to 3600 seconds"));
        }
        let mut robots = Vec::new();
        let names: Vec<_> = file.robots.iter().map(|robot| robot.name.span().start).collect();
        for robot in file.robots {
            robots.push(robot.check(&robots)?);
        }
        if robots.is_empty() {
            return Err(wrong(0, "no robot is named: write [[robots]] and name = \"robot_1\" for each"));
        }
        if file.clauses.is_empty() {
            return Err(wrong(
                0,
                "no clause is named: write [[clauses]] and clause = \"CHAIN-3\", for example",
            ));
        }
        let clauses: Vec<Clause> =
            file.clauses.into_iter().map(|clause| clause.check(&robots)).collect::<Result<_, _>>()?;
        let is_idle = |robot: &usize| !clauses.iter().any(|clause| clause.robots.contains(robot));
        if let Some(idle) = (0..robots.len()).find(is_idle) {
            let why = format!("{} is in no clause: name it in one, or leave it out", robots[idle].name);
            return Err(wrong(names[idle], why));
        }
        Ok(Self { gap: Duration::from_secs_f64(seconds), frame: file.frame, robots, clauses })
    }
}
