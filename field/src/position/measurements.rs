//! A file of measurements: lines of comma-separated values under the names of their columns, one line for each distance
//! that a robot has measured. Lines with the same name of a fix belong to one position.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::ops::{Range as Bytes, RangeInclusive};
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::{BOM, Diagnostic, unreadable};
use tautline_kernel::position::{Estimate, Fix, Point, Range, Refusal, Signal};
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::plural::counted;

use super::Solver;
use super::analysis::{Ellipse, PARTS, ellipse, matrix};
use super::meeting::check_meeting;
use crate::stats::decimals;
use tautline_sim::explore::RuleName;

/// The columns that a file of distances must have, in any order.
const COLUMNS: [&str; 4] = ["fix", "x_m", "y_m", RANGE];

/// Those of a file of levels.
const COLUMNS_OF_LEVELS: [&str; 4] = ["fix", "x_m", "y_m", LEVEL];

/// A distance, in metres.
const RANGE: &str = "range_m";

/// The strength with which an anchor is heard, in dBm.
const LEVEL: &str = "level_dbm";

/// The strengths that are taken for levels, in dBm: from below all noise to a megawatt.
const LEVELS_DBM: RangeInclusive<f64> = -200.0..=90.0;

/// How strong anchors are heard at one metre, in dBm: levels tell distances by it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Power(f64);

impl Power {
    /// The strength `level_dbm`; `None` unless it is from -200 to 90 dBm.
    pub fn new(level_dbm: f64) -> Option<Self> {
        LEVELS_DBM.contains(&level_dbm).then_some(Self(level_dbm))
    }
}

/// Larger files are refused before they are read.
const MAX_BYTES: u64 = 16 << 20;

/// The measurements of a file.
#[derive(Clone, PartialEq, Debug)]
pub struct Measurements {
    file: PathBuf,
    text: String,
    fixes: Vec<Readings>,
}

/// The distances of one position.
#[derive(Clone, PartialEq, Debug)]
struct Readings {
    name: String,
    ranges: Vec<Range>,
    /// The bytes of the text that have each of them.
    lines: Vec<Bytes<usize>>,
}

/// The position of a fix.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct FixReport {
    /// The fix's name in the file.
    pub fix: String,
    /// The position; two if they cannot be told apart, the one that fits better first.
    pub positions: Vec<Place>,
}

/// A position, and how far it can be trusted where the way to it tells.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Place {
    /// Along +x, in metres.
    pub x_m: f64,
    /// Along +y, in metres.
    pub y_m: f64,
    /// The root mean square error to be expected, in metres.
    pub rms_m: Option<f64>,
    /// The dilution of precision.
    pub dilution: Option<f64>,
    /// The ellipse in which the robot is with 95 %.
    pub ellipse: Option<Ellipse>,
    /// The root mean square of what distances miss, in metres, or levels, in dB.
    pub residual: Option<f64>,
    /// Warnings about the position.
    pub flags: Vec<&'static str>,
}

impl Measurements {
    /// Reads a file of distances, or of levels where `power` says what these are at one metre; `signal` says how fast
    /// they fall.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be read, a column is missing, or a value is no number or no level.
    pub fn read(file: &Path, signal: &Signal, power: Option<Power>) -> Result<Self, Diagnostic> {
        let mut text = String::new();
        let read = File::open(file).and_then(|opened| opened.take(MAX_BYTES + 1).read_to_string(&mut text));
        read.map_err(|error| match error.kind() {
            ErrorKind::InvalidData => Diagnostic::in_file(
                file,
                "this is not UTF-8 text",
                format_args!("begin with the line {}", COLUMNS.join(",")),
            ),
            _ => Diagnostic::in_file(file, unreadable(&error), "give the path of a file of measurements"),
        })?;
        if text.len() as u64 > MAX_BYTES {
            let most = MAX_BYTES >> 20;
            let what = format_args!("the file has more than {most} MiB");
            return Err(Diagnostic::in_file(file, what, "split it"));
        }
        let mut measured = Self { file: file.to_owned(), text: String::new(), fixes: Vec::new() };
        measured.take(&text, signal, power)?;
        Ok(Self { text, ..measured })
    }

    fn take(&mut self, text: &str, signal: &Signal, power: Option<Power>) -> Result<(), Diagnostic> {
        let columns = if power.is_some() { COLUMNS_OF_LEVELS } else { COLUMNS };
        let begin = text.len() - text.strip_prefix(BOM).unwrap_or(text).len();
        let mut lines = text[begin..].split_inclusive('\n').scan(begin, |next, line| {
            let start = *next;
            *next += line.len();
            Some((start, line.trim_end_matches(['\r', '\n'])))
        });
        let (start, header) = lines.next().unwrap_or((begin, ""));
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        if power.is_none() && names.contains(&LEVEL) && !names.contains(&RANGE) {
            let what = format!("the column `{LEVEL}` tells no distance by itself");
            let remedy = "give `power-dbm`, the level at one metre, and `exponent`, how fast levels fall";
            return Err(self.fault(text, start..start + header.len(), what, remedy));
        }
        let mut places = [0; COLUMNS.len()];
        for (place, column) in places.iter_mut().zip(columns) {
            let mut named = names.iter().enumerate().filter(|(_, name)| **name == column);
            *place = match (named.next(), named.next()) {
                (Some((only, _)), None) => only,
                (first, _) => {
                    let fault = if first.is_some() { "there twice" } else { "missing" };
                    let what = format_args!("the column `{column}` is {fault}");
                    let remedy = format!("begin with the names of the columns: {}", columns.join(","));
                    return Err(self.fault(text, start..start + header.len(), what, remedy));
                }
            };
        }
        let mut known = BTreeMap::new();
        for (start, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
            let values: Vec<&str> = line.split(',').collect();
            let whole = start..start + line.len();
            if values.len() != names.len() {
                let what = format!(
                    "this line has {}, the first one {}",
                    counted(values.len(), "value"),
                    names.len()
                );
                return Err(self.fault(text, whole, what, format_args!("give a value for each of {header}")));
            }
            let value = |column: usize| {
                let value = values[places[column]];
                let offset = values[..places[column]].iter().map(|before| before.len() + 1).sum::<usize>();
                (value.trim(), start + offset..start + offset + value.len())
            };
            let number = |column: usize| {
                let (value, at) = value(column);
                value.parse::<f64>().map_err(|_| {
                    let what = format!("`{value}` of the column `{}` is no number", columns[column]);
                    let unit = if columns[column] == LEVEL { "dBm" } else { "metres" };
                    self.fault(text, at, what, format_args!("give {unit}, with a point before decimals"))
                })
            };
            let (anchor, told) = (Point::new(number(1)?, number(2)?), number(3)?);
            let distance_m = match power {
                None => told,
                Some(Power(at_one_metre)) if LEVELS_DBM.contains(&told) => {
                    signal.distance_m(told - at_one_metre)
                }
                Some(_) => {
                    let (value, at) = value(3);
                    let what = format!("`{value}` dBm is no level of a radio");
                    let (least, most) = (LEVELS_DBM.start(), LEVELS_DBM.end());
                    return Err(self.fault(text, at, what, format_args!("give dBm from {least} to {most}")));
                }
            };
            let range = Range::new(anchor, distance_m);
            let name = values[places[0]].trim();
            let number = *known.entry(name).or_insert(self.fixes.len());
            if number == self.fixes.len() {
                self.fixes.push(Readings { name: name.to_owned(), ranges: Vec::new(), lines: Vec::new() });
            }
            self.fixes[number].ranges.push(range);
            self.fixes[number].lines.push(whole);
        }
        if self.fixes.is_empty() {
            let end = text.len()..text.len();
            return Err(self.fault(text, end, "there is no measurement", "add a line for each distance"));
        }
        Ok(())
    }

    fn fault(
        &self,
        text: &str,
        at: Bytes<usize>,
        what: impl std::fmt::Display,
        remedy: impl std::fmt::Display,
    ) -> Diagnostic {
        Diagnostic::at(&self.file, text, at, what, remedy)
    }

    /// The position of each fix, in the order of the file.
    ///
    /// # Errors
    /// A [`Diagnostic`] that shows the line of a distance, if distances are refused, or contradict each other.
    pub fn locate(
        &self,
        solver: Solver,
        rule: RuleName,
        signal: &Signal,
        seed: u64,
    ) -> Result<Vec<FixReport>, Diagnostic> {
        let fixes = (0..).zip(&self.fixes);
        let found = |(number, readings): (u64, &Readings)| {
            let ranges = &readings.ranges;
            let solved = check_meeting(ranges, signal).and_then(|()| {
                solver.solve(rule, ranges, signal, None, &mut SeededOracle::new(seed, number))
            });
            let (at, fix) = solved.map_err(|refusal| self.refused(readings, refusal))?;
            let positions = match &fix {
                None => vec![Place::bare(at)],
                Some(Fix::One(one)) => vec![Place::of(one)],
                Some(Fix::Two(one, other)) => vec![Place::of(one), Place::of(other)],
            };
            Ok(FixReport { fix: readings.name.clone(), positions })
        };
        fixes.map(found).collect()
    }

    /// The fault of a fix, at the line of the anchor that it is about, or at its last one.
    fn refused(&self, readings: &Readings, refusal: Refusal) -> Diagnostic {
        let about = match refusal {
            Refusal::NotFinite(anchor) | Refusal::Negative(anchor) | Refusal::Zero(anchor) => Some(anchor),
            Refusal::Coincident { second, .. } | Refusal::Apart { second, .. } => Some(second),
            Refusal::Anchors(_)
            | Refusal::Collinear
            | Refusal::Division
            | Refusal::NoParticle
            | Refusal::NoPlace => None,
        };
        let line = about.and_then(|anchor| readings.lines.get(anchor)).or_else(|| readings.lines.last());
        let what = format!("fix {}: {refusal}", readings.name);
        self.fault(&self.text, line.cloned().unwrap_or_default(), what, super::remedy(refusal))
    }

    /// Every anchor of the file, once.
    pub fn anchors(&self) -> Vec<Point> {
        let mut known = BTreeSet::new();
        let anchors = self.fixes.iter().flat_map(|readings| &readings.ranges).map(|range| range.anchor);
        // A coordinate of -0 is one of 0.
        anchors.filter(|at| known.insert([at.x_m + 0.0, at.y_m + 0.0].map(f64::to_bits))).collect()
    }
}

impl Place {
    fn bare(at: Point) -> Self {
        Self {
            x_m: decimals(at.x_m, PARTS),
            y_m: decimals(at.y_m, PARTS),
            rms_m: None,
            dilution: None,
            ellipse: None,
            residual: None,
            flags: Vec::new(),
        }
    }

    fn of(estimate: &Estimate) -> Self {
        let flags = estimate.flags;
        let said =
            [(flags.is_weak, "weak"), (flags.is_outside, "outside"), (flags.is_unsettled, "unsettled")];
        Self {
            rms_m: estimate.precision.map(|precision| decimals(precision.rms_m(), PARTS)),
            dilution: estimate.precision.map(|precision| decimals(precision.dilution, PARTS)),
            ellipse: estimate
                .precision
                .map(|precision| ellipse(estimate.at, &matrix(&precision.covariance)).rounded()),
            residual: Some(decimals(estimate.residual, PARTS)),
            flags: said.into_iter().filter(|(is, _)| *is).map(|(_, word)| word).collect(),
            ..Self::bare(estimate.at)
        }
    }

    /// Where it is.
    pub const fn at(&self) -> Point {
        Point::new(self.x_m, self.y_m)
    }
}
