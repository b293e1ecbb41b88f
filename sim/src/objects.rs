//! Objects that robots find (Rajesh, Nagaraja and Suja 2024, 4.5): where they stand, and where robots take them to be.
//! Lengths are in sides of a cell; the midpoint of a cell has the cell's column and row.

use std::fmt::{self, Display};
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::number::Number;
use tautline_io::text_table::{Align, TextTable};
use tautline_io::value_parser::{real, whole};
use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::midpoint;
use tautline_kernel::ground::Cell;
use tautline_kernel::position::{Point, Sighting, SymmetricMatrix};
use tautline_proofs::plural::counted;

use crate::frontier::cell_at;
use tautline_grids::layout::Layout;

/// The most objects of a run.
const MOST: usize = 1000;

/// The objects of a run.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(untagged, expecting = "objects are a number from 1 to 1000, or columns and rows such as [[1.5,2]]")]
pub enum Objects {
    /// So many, each somewhere in a cell that the robots can reach.
    Count(u16),
    /// At these columns and rows.
    At(Vec<[f64; 2]>),
}

impl FromStr for Objects {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if !text.contains(':') {
            return whole(text)
                .map(Self::Count)
                .map_err(|what| format!("{what}, or columns and rows such as 1.5:2,3:4"));
        }
        let place = |word: &str| {
            let (column, row) = word.split_once(':').ok_or("write columns and rows such as 1.5:2,3:4")?;
            Ok([real(column)?, real(row)?])
        };
        text.split(',').map(place).collect::<Result<_, &str>>().map(Self::At).map_err(str::to_owned)
    }
}

impl Display for Objects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(count) => count.fmt(f),
            Self::At(places) => {
                let words: Vec<String> =
                    places.iter().map(|&[x, y]| format!("{}:{}", Number(x), Number(y))).collect();
                f.write_str(&words.join(","))
            }
        }
    }
}

impl Objects {
    /// Where they stand, of random ones in these cells.
    pub fn places(&self, cells: &[Cell], oracle: &mut dyn Oracle) -> Vec<Point> {
        match self {
            Self::Count(count) => scattered(cells, 0.99, u32::from(*count), oracle),
            Self::At(places) => places.iter().map(|&[x, y]| Point::new(x, y)).collect(),
        }
    }

    /// The fault of objects in a layout, and its remedy.
    pub fn wrong(&self, layout: &Layout) -> Option<(String, String)> {
        let (columns, rows) = (f64::from(layout.width()) - 0.5, f64::from(layout.height()) - 0.5);
        let count = match self {
            Self::Count(count) => usize::from(*count),
            Self::At(places) => places.len(),
        };
        if !(1..=MOST).contains(&count) {
            return Some((format!("{count} objects"), format!("give `objects` 1 to {MOST} of them")));
        }
        let Self::At(places) = self else { return None };
        let wrong = |&[x, y]: &[f64; 2]| {
            let is_inside = (-0.5..columns).contains(&x) && (-0.5..rows).contains(&y);
            let cell = cell_at(Point::new(x, y));
            if !is_inside || !layout.contains(cell) {
                let right = format!("columns from -0.5 to {columns} and rows from -0.5 to {rows}");
                let what = format!("an object at {x}:{y} is outside the floor");
                return Some((what, format!("give `objects` {right}")));
            }
            let what = format!("an object at {x}:{y} is within the obstacle that fills the cell {cell}");
            (!layout.is_free(cell)).then(|| (what, "give `objects` places in free cells".to_owned()))
        };
        places.iter().find_map(wrong)
    }
}

/// So many objects, each somewhere in a square round the midpoint of one of these cells, which is so wide.
pub fn scattered(cells: &[Cell], width: f64, count: u32, oracle: &mut dyn Oracle) -> Vec<Point> {
    let place = |_| {
        let cell = midpoint(*cells.get(oracle.pick(cells.len() as u32) as usize)?);
        let mut off = || width * (f64::from(oracle.pick(1 << 16)) / f64::from(1 << 16) - 0.5);
        Some(Point::new(cell.x_m + off(), cell.y_m + off()))
    };
    (0..count).filter_map(place).collect()
}

/// An object after a run.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct ObjectReport {
    /// Its column and row.
    pub at: [f64; 2],
    /// Where the robots that have seen it take it to be, together.
    pub found: Option<ObjectEstimate>,
}

/// Where an object is taken to be, to thousandths.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct ObjectEstimate {
    /// Its column and row.
    pub at: [f64; 2],
    /// How far it is from there.
    pub error: f64,
    /// The standard deviations of the column and of the row.
    pub deviations: [f64; 2],
    /// Their correlation: with it they make the error ellipse.
    pub correlation: f64,
}

impl ObjectReport {
    /// The object at `at`, which robots take to be there, if they have seen it.
    pub fn new(at: Point, known: Option<&Sighting>) -> Self {
        let thousandths = |number: f64| (1000.0 * number).round() / 1000.0;
        let found = known.map(|Sighting { at: there, covariance }| {
            let (deviations, correlation) = spread(*covariance);
            ObjectEstimate {
                at: [there.x_m, there.y_m].map(thousandths),
                error: thousandths(at.distance_m(*there)),
                deviations: deviations.map(thousandths),
                correlation: thousandths(correlation),
            }
        });
        Self { at: [at.x_m, at.y_m].map(thousandths), found }
    }
}

/// The standard deviations of both coordinates, and their correlation.
pub(crate) fn spread(covariance: SymmetricMatrix) -> ([f64; 2], f64) {
    let deviations = [covariance.xx, covariance.yy].map(f64::sqrt);
    let both = deviations[0] * deviations[1];
    (deviations, if both > 0.0 { covariance.xy / both } else { 0.0 })
}

/// A table of objects; nothing if there are none.
pub fn table(objects: &[ObjectReport]) -> String {
    if objects.is_empty() {
        return String::new();
    }
    let mut errors: Vec<f64> = objects.iter().filter_map(|one| Some(one.found.as_ref()?.error)).collect();
    errors.sort_unstable_by(f64::total_cmp);
    let mut text = format!("{} of {} found", errors.len(), counted(objects.len(), "object"));
    let share = |part: usize| errors.get((errors.len() * part).div_ceil(100).saturating_sub(1));
    if let (Some(median), Some(most)) = (share(50), share(95)) {
        text.extend([format!("; off by {median:.3} of a cell's side in the median, {most:.3} at 95 %")]);
    }
    let mut table = TextTable::new([Align::Left; 4]);
    table.row(["  object", "taken to be", "off by", "standard deviations"]);
    for ObjectReport { at: [x, y], found } in objects {
        let object = format!("  {x}:{y}");
        table.row(match found {
            None => [object, "not found".to_owned(), String::new(), String::new()],
            Some(ObjectEstimate { at: [there, far], error, deviations: [of_x, of_y], .. }) => {
                [object, format!("{there}:{far}"), format!("{error:.3}"), format!("{of_x:.3}, {of_y:.3}")]
            }
        });
    }
    text + "\n" + &table.text()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_that_are_none_are_told_what_would_be_right() {
        let (_, said) = tautline_io::json_lines::parse::<Objects>("1000000").expect_err("too many");
        assert_eq!(said, "objects are a number from 1 to 1000, or columns and rows such as [[1.5,2]]");
    }

    #[test]
    fn objects_are_written_as_they_are_read() {
        for text in ["8", "1.5:2,3:4.25", "-0.25:0"] {
            assert_eq!(text.parse::<Objects>().expect("objects").to_string(), text);
        }
        for text in ["", "-1", "1.5", "1:x", "1:2,3", "70000"] {
            assert!(text.parse::<Objects>().is_err(), "{text}");
        }
    }
}
