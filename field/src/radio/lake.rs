//! Obstacles of any shape, as a person writes them: a picture of the shape, and the rectangle that the picture fills.
//! Its blocked parts are rectangles that touch each other, so that neither signals nor robots pass between them.

use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::value_parser::Metres;

/// An obstacle: west, north, east and south of the rectangles that it consists of, in metres.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Lake(pub Vec<[f64; 4]>);

/// Shapes with names, row by row: `#` is blocked.
pub const SHAPES: [(&str, &str); 6] = [
    ("rectangle", "#"),
    ("l", "#..../#..../#..../#..../#####"),
    ("u", "#...#/#...#/#...#/#...#/#####"),
    ("c", "#####/#...#/#..../#...#/#####"),
    ("spiral", "#######/......#/#####.#/#...#.#/#.###.#/#.....#/#######"),
    ("ring", "#####/#...#/#...#/#...#/#####"),
];

/// The most rows and columns of a picture.
const MOST: usize = 32;

impl Lake {
    /// The obstacle whose `picture` fills the rectangle with these sides.
    ///
    /// # Errors
    /// A sentence that says what is wrong with the picture, and what would be right.
    pub fn new(picture: &str, [west_m, north_m, east_m, south_m]: [f64; 4]) -> Result<Self, String> {
        let named = SHAPES.into_iter().find(|(name, _)| *name == picture);
        let rows: Vec<&str> = named.map_or(picture, |(_, rows)| rows).split('/').collect();
        let columns = rows[0].len();
        let is_row = |row: &&str| row.len() == columns && row.bytes().all(|part| matches!(part, b'#' | b'.'));
        let is_small = (1..=MOST).contains(&columns) && rows.len() <= MOST;
        if !is_small || !rows.iter().all(is_row) || !rows.concat().contains('#') {
            let names: Vec<&str> = SHAPES.iter().map(|(name, _)| *name).collect();
            return Err(format!(
                "write a shape as {} or as rows of # and . that are alike long, with / between them, up to {MOST} of \
                 {MOST}, for example #..#/####",
                names.join(", ")
            ));
        }
        let between = |start: f64, end: f64, part: usize, of: usize| {
            let [part, of] = [part, of].map(|number| f64::from(number as u32));
            start + (end - start) * part / of
        };
        let mut parts = Vec::new();
        for (number, row) in rows.iter().enumerate() {
            let [north, south] = [number, number + 1].map(|row| between(north_m, south_m, row, rows.len()));
            let mut column = 0;
            for run in row.as_bytes().chunk_by(|one, other| one == other) {
                let [west, east] =
                    [column, column + run.len()].map(|column| between(west_m, east_m, column, columns));
                if run[0] == b'#' {
                    parts.push([west, north, east, south]);
                }
                column += run.len();
            }
        }
        Ok(Self(parts))
    }
}

impl FromStr for Lake {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (picture, sides) = text.split_once(':').unwrap_or(("rectangle", text));
        let Metres(sides) = sides.parse().map_err(|_| {
            "write west, north, east and south in metres, for example 50,100,150,200, and before them a shape if it is \
             no rectangle, for example u:50,100,150,200"
        })?;
        Self::new(picture, sides)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::radio::{Area, Field, Point};

    fn field(text: &str) -> Field {
        let lake: Lake = text.parse().expect("a lake");
        let area = Area::new(100.0, 100.0).expect("an area");
        let corners = [0.0, 100.0].map(|at| Point { x_m: at, y_m: at });
        Field::new(area, lake.0.into_iter().map(Into::into).collect(), corners.to_vec()).expect("a field")
    }

    #[test]
    fn a_ring_shuts_its_inside_in_and_a_c_leaves_it_open() {
        let (middle, east) = (Point { x_m: 50.0, y_m: 50.0 }, Point { x_m: 99.0, y_m: 50.0 });
        let (ring, open) = (field("ring:20,20,80,80"), field("c:20,20,80,80"));
        assert!(!ring.has_way(middle, east) && open.has_way(middle, east));
        // Through the corner in which two rectangles touch each other, too.
        for turn in 0..64 {
            let angle = f64::from(turn) * 0.1;
            let outside = Point { x_m: 50.0 + 49.0 * libm::cos(angle), y_m: 50.0 + 49.0 * libm::sin(angle) };
            assert!(!ring.has_way(middle, outside), "{turn}");
        }
    }

    #[test]
    fn a_shape_is_drawn_by_hand_and_a_wrong_one_is_refused() {
        let lake: Lake = "##./..#:0,0,30,20".parse().expect("a lake");
        assert_eq!(lake.0, [[0.0, 0.0, 20.0, 10.0], [20.0, 10.0, 30.0, 20.0]]);
        assert_eq!("1,2,3,4".parse(), Ok(Lake(vec![[1.0, 2.0, 3.0, 4.0]])));
        for wrong in ["o:0,0,1,1", "##/#:0,0,1,1", "../..:0,0,1,1", ":0,0,1,1", "u:0,0,1", "u", "#/:0,0,1,1"]
        {
            assert!(wrong.parse::<Lake>().is_err(), "{wrong}");
        }
    }
}
