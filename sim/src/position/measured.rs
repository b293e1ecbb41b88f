//! A file of measurements: lines of comma-separated values under the names of their columns, one line for each distance that
//! a robot has measured. Lines with the same name of a fix belong to one position.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::ops::Range as Bytes;
use std::path::{Path, PathBuf};

use serde::Serialize;
use tautline_kernel::position::{Estimate, Fix, Point, Range, Refusal, Signal, check_meeting};
use tautline_proofs::engine::Seeded;
use tautline_proofs::words::counted;

use super::Solver;
use super::analysis::{Ellipse, ellipse, matrix};
use crate::explore::RuleName;
use crate::fault::{BOM, Fault};
use crate::stats::decimals;

/// The columns that a file must have, in any order.
const COLUMNS: [&str; 4] = ["fix", "x_m", "y_m", "range_m"];

/// Larger files are refused before they are read.
const MAX_BYTES: u64 = 16 << 20;

/// The measurements of a file.
#[derive(Clone, PartialEq, Debug)]
pub struct Measured {
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
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Found {
    /// What the file calls the fix.
    pub fix: String,
    /// The position; two if they cannot be told apart, the one that fits better first.
    pub positions: Vec<Place>,
}

/// A position, and how far it can be trusted where the way to it tells.
#[derive(Clone, PartialEq, Debug, Serialize)]
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
    /// What is to be said with it.
    pub flags: Vec<&'static str>,
}

/// Numbers are told to a hundredth of a millimetre.
const PARTS: f64 = 1e5;

impl Measured {
    /// Reads a file.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be read, a column is missing, or a value is no number.
    pub fn read(file: &Path) -> Result<Self, Fault> {
        let mut text = String::new();
        let read = File::open(file).and_then(|opened| opened.take(MAX_BYTES + 1).read_to_string(&mut text));
        read.map_err(|error| match error.kind() {
            ErrorKind::NotFound => {
                Fault::in_file(file, "there is no such file", "give the path of a file of measurements")
            }
            ErrorKind::InvalidData => Fault::in_file(
                file,
                "this is not UTF-8 text",
                format_args!("begin with the line {}", COLUMNS.join(",")),
            ),
            _ => Fault::in_file(file, error, "give the path of a file of measurements"),
        })?;
        if text.len() as u64 > MAX_BYTES {
            let most = MAX_BYTES >> 20;
            return Err(Fault::in_file(file, format_args!("the file has more than {most} MiB"), "split it"));
        }
        let mut measured = Self { file: file.to_owned(), text: String::new(), fixes: Vec::new() };
        measured.take(&text)?;
        Ok(Self { text, ..measured })
    }

    fn take(&mut self, text: &str) -> Result<(), Fault> {
        let begin = text.len() - text.strip_prefix(BOM).unwrap_or(text).len();
        let mut lines = text[begin..].split_inclusive('\n').scan(begin, |next, line| {
            let start = *next;
            *next += line.len();
            Some((start, line.trim_end_matches(['\r', '\n'])))
        });
        let (start, header) = lines.next().unwrap_or((begin, ""));
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        let mut places = [0; COLUMNS.len()];
        for (place, column) in places.iter_mut().zip(COLUMNS) {
            *place = names.iter().position(|&name| name == column).ok_or_else(|| {
                let remedy = format!("begin with the names of the columns: {}", COLUMNS.join(","));
                self.fault(
                    text,
                    start..start + header.len(),
                    format_args!("the column `{column}` is missing"),
                    remedy,
                )
            })?;
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
            let number = |column: usize| {
                let value = values[places[column]];
                let offset = values[..places[column]].iter().map(|before| before.len() + 1).sum::<usize>();
                value.trim().parse::<f64>().map_err(|_| {
                    let at = start + offset..start + offset + value.len();
                    let what = format!("`{}` of the column `{}` is no number", value.trim(), COLUMNS[column]);
                    self.fault(text, at, what, "give metres, with a point before decimals")
                })
            };
            let range = Range::new(Point::new(number(1)?, number(2)?), number(3)?);
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
    ) -> Fault {
        Fault::at(&self.file, text, at, what, remedy)
    }

    /// The position of each fix, in the order of the file.
    ///
    /// # Errors
    /// A [`Fault`] that shows the line of a distance, if distances are refused, or contradict each other.
    pub fn locate(
        &self,
        solver: Solver,
        rule: RuleName,
        signal: &Signal,
        seed: u64,
    ) -> Result<Vec<Found>, Fault> {
        let fixes = (0..).zip(&self.fixes);
        let found = |(number, readings): (u64, &Readings)| {
            let ranges = &readings.ranges;
            let solved = check_meeting(ranges, signal)
                .and_then(|()| solver.solve(rule, ranges, signal, None, &mut Seeded::new(seed, number)));
            let (at, fix) = solved.map_err(|refusal| self.refused(readings, refusal))?;
            let positions = match &fix {
                None => vec![Place::bare(at)],
                Some(Fix::One(one)) => vec![Place::of(one)],
                Some(Fix::Two(one, other)) => vec![Place::of(one), Place::of(other)],
            };
            Ok(Found { fix: readings.name.clone(), positions })
        };
        fixes.map(found).collect()
    }

    /// What is wrong with a fix, at the line of the anchor that it is about, or at its last one.
    fn refused(&self, readings: &Readings, refusal: Refusal) -> Fault {
        let about = match refusal {
            Refusal::NotFinite { anchor } | Refusal::Negative { anchor } | Refusal::Zero { anchor } => {
                Some(anchor)
            }
            Refusal::Coincident { second, .. } | Refusal::Apart { second, .. } => Some(second),
            Refusal::Anchors { .. } | Refusal::Collinear | Refusal::Division | Refusal::NoParticle => None,
        };
        let line = about.and_then(|anchor| readings.lines.get(anchor)).or_else(|| readings.lines.last());
        let what = format!("fix {}: {refusal}", readings.name);
        self.fault(&self.text, line.cloned().unwrap_or_default(), what, refusal.remedy())
    }

    /// Every anchor of the file, once.
    pub fn anchors(&self) -> Vec<Point> {
        let mut anchors = Vec::new();
        for range in self.fixes.iter().flat_map(|readings| &readings.ranges) {
            if !anchors.contains(&range.anchor) {
                anchors.push(range.anchor);
            }
        }
        anchors
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
