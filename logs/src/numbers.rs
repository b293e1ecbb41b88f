//! The numbers of robots: by the order of their names, or as a small file says.

use std::collections::{HashMap, HashSet};
use std::fmt;

use super::reader::BOM;

/// The number of each name of a log, and the names by number.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Numbers {
    /// By name of the log: the robot, from 0; none if it is no robot.
    of: Vec<Option<u32>>,
    /// By robot: its name.
    names: Vec<String>,
    /// The names of the file that are not in the log.
    absent: Vec<String>,
}

/// A file of names that cannot be used.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NamesError {
    /// A line, from 1, that is no name with a number.
    Line(usize),
    /// A name or a number that stands on this line for the second time.
    Twice(usize),
    /// The numbers leave out this one.
    Gap(u32),
    /// None of its names is in the log; these are some that are.
    Nothing(Vec<String>),
}

impl fmt::Display for NamesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(_) => {
                f.write_str("this line is no name with the number of a robot, from 1, behind a comma")
            }
            Self::Twice(_) => f.write_str("this name or number was given before"),
            Self::Gap(robot) => write!(f, "no name has the number {}", robot + 1),
            Self::Nothing(names) => {
                write!(f, "none of these names is in the log, which has {}", names.join(", "))
            }
        }
    }
}

impl std::error::Error for NamesError {}

/// Names that a message shows.
const SHOWN: usize = 6;

impl Numbers {
    /// Numbers in the order of the names, where digits count as numbers: robot 2 is before robot 10.
    pub fn natural(names: &[String]) -> Self {
        let mut order: Vec<usize> = (0..names.len()).collect();
        order.sort_by_cached_key(|&name| natural(&names[name]));
        let mut of = vec![None; names.len()];
        for (robot, &name) in (0..).zip(&order) {
            of[name] = Some(robot);
        }
        Self { of, names: order.into_iter().map(|name| names[name].clone()).collect(), absent: Vec::new() }
    }

    /// Numbers as a file of lines `NAME,NUMBER` says, from 1. Names of the log that it does not name are no robots.
    ///
    /// # Errors
    /// [`NamesError`].
    pub fn named(names: &[String], file: &str) -> Result<Self, NamesError> {
        let mut numbers: HashMap<&str, u32> = HashMap::new();
        let (mut by_number, mut given): (Vec<(u32, &str)>, HashSet<u32>) = (Vec::new(), HashSet::new());
        let file = file.strip_prefix(BOM).unwrap_or(file);
        let lines =
            (1..).zip(file.lines()).filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
        for (place, line) in lines {
            let parsed = line
                .rsplit_once(',')
                .and_then(|(name, number)| Some((name.trim(), number.trim().parse::<u32>().ok()?)));
            let (name, robot) = match parsed {
                Some((name, number @ 1..)) => (name, number - 1),
                None if numbers.is_empty() && line.to_ascii_lowercase().replace(' ', "") == "name,robot" => {
                    continue;
                }
                Some(_) | None => return Err(NamesError::Line(place)),
            };
            if numbers.insert(name, robot).is_some() || !given.insert(robot) {
                return Err(NamesError::Twice(place));
            }
            by_number.push((robot, name));
        }
        by_number.sort_unstable();
        if let Some(gap) = (0..).zip(&by_number).find(|(robot, (other, _))| robot != other) {
            return Err(NamesError::Gap(gap.0));
        }
        let of: Vec<Option<u32>> = names.iter().map(|name| numbers.get(name.as_str()).copied()).collect();
        if of.iter().all(Option::is_none) {
            return Err(NamesError::Nothing(names.iter().take(SHOWN).cloned().collect()));
        }
        let known: HashSet<&str> = names.iter().map(String::as_str).collect();
        let is_absent = |name: &&str| !known.contains(name);
        let absent = by_number.iter().map(|&(_, name)| name).filter(is_absent).map(str::to_owned).collect();
        Ok(Self { of, names: by_number.into_iter().map(|(_, name)| name.to_owned()).collect(), absent })
    }

    /// The robot that has a name of the log.
    pub fn robot(&self, name: u32) -> Option<u32> {
        *self.of.get(name as usize)?
    }

    /// The names of the robots, by number.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The names of robots that the log does not have.
    pub fn absent(&self) -> &[String] {
        &self.absent
    }
}

/// A part of a name: a number, or the text between numbers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Piece {
    Number(u64),
    Text(String),
}

fn natural(name: &str) -> (Vec<Piece>, String) {
    let mut pieces = Vec::new();
    let mut rest = name;
    while let Some(first) = rest.chars().next() {
        let end =
            rest.find(|sign: char| sign.is_ascii_digit() != first.is_ascii_digit()).unwrap_or(rest.len());
        let (piece, left) = rest.split_at(end);
        pieces.push(piece.parse().map_or_else(|_| Piece::Text(piece.to_owned()), Piece::Number));
        rest = left;
    }
    (pieces, name.to_owned())
}
