//! Layouts made from a short description. The random ones are the same for the same description and seed on
//! every machine: each generator has a tag for its [`Dice`], and everything is drawn in an order that is part of the
//! promise.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge, Side};

use super::form::examples;
use super::{Layout, Size, text};
use crate::chance::{Dice, Probability};

pub use super::form::{FORMS, Form};

const ROOMS_A: &str = include_str!("generate/rooms-a.txt");
const ROOMS_B: &str = include_str!("generate/rooms-b.txt");

/// The least width and height of a room in an office that is large enough.
const LEAST_ROOM_CELLS: i16 = 3;

/// A description of layouts, as `FromStr` reads it and `Display` writes it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Generator {
    /// `open:15x15`: no walls, no blocked cells.
    Open(Size),
    /// `walls:15x15:0.1`: each inner cell side is a wall with this probability, drawn in the order of
    /// [`Layout::edges`].
    Walls(Size, Probability),
    /// `rooms-a`: a building of 15×15 cells with a few large rooms, one-cell doors, all cells connected.
    RoomsA,
    /// `rooms-b`: a building of 15×15 cells with many small rooms, one-cell doors, all cells connected.
    RoomsB,
    /// `office:30x30:4x4`: an area divided into rooms by random columns and rows of walls, with one one-cell door
    /// at a random place between any two neighbouring rooms, so that all cells are connected. Rooms are at least
    /// three cells wide and high, or as many as all of them can be; all ways to divide the columns so are as
    /// likely, and those to divide the rows. Drawn first are the columns from west to east: after the least width
    /// of a room either its wall follows or one more cell, as likely as walls and spare cells are left, until
    /// there is no wall left; then the rows in the same way; then the doors room by room in row order, the eastern
    /// door before the southern.
    Office(Size, Rooms),
    /// `cells:32x32:0.2`: each cell is blocked with this probability, drawn in row order.
    Cells(Size, Probability),
}

/// Rooms side by side and one below the other, both at least 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Rooms {
    across: i16,
    down: i16,
}

impl Generator {
    /// Whether anything of the layout is left to chance.
    pub const fn is_random(&self) -> bool {
        match self {
            Self::Open(_) | Self::RoomsA | Self::RoomsB => false,
            Self::Walls(..) | Self::Office(..) | Self::Cells(..) => true,
        }
    }

    /// The layout for `seed`; those without chance are the same for all seeds.
    ///
    /// # Errors
    /// [`Diagnostic`] when chance blocked every cell.
    pub fn generate(&self, seed: u64) -> Result<Layout, Diagnostic> {
        match *self {
            Self::Open(size) => Ok(Layout::of(size)),
            Self::Walls(size, probability) => {
                Ok(walls(size, probability, &mut Dice::new(seed, *b"walls   ")))
            }
            Self::RoomsA => text::read(ROOMS_A).map_err(|misread| misread.problem),
            Self::RoomsB => text::read(ROOMS_B).map_err(|misread| misread.problem),
            Self::Office(size, rooms) => Ok(office(size, rooms, &mut Dice::new(seed, *b"office  "))),
            Self::Cells(size, probability) => cells(size, probability, &mut Dice::new(seed, *b"cells   ")),
        }
    }
}

impl Rooms {
    /// `across` rooms side by side and `down` one below the other, in an area of `size`; `None` when one is 0
    /// or the cells do not suffice.
    pub fn new(across: u64, down: u64, size: Size) -> Option<Self> {
        let within =
            |rooms: u64, cells: i16| i16::try_from(rooms).ok().filter(|rooms| (1..=cells).contains(rooms));
        Some(Self { across: within(across, size.width())?, down: within(down, size.height())? })
    }
}

fn walls(size: Size, probability: Probability, dice: &mut Dice) -> Layout {
    let mut layout = Layout::of(size);
    for edge in layout.edges() {
        if probability.happens(dice) {
            layout.build_wall(edge);
        }
    }
    layout
}

fn cells(size: Size, probability: Probability, dice: &mut Dice) -> Result<Layout, Diagnostic> {
    let mut layout = Layout::of(size);
    for cell in layout.cells() {
        if probability.happens(dice) {
            layout.block(cell);
        }
    }
    layout.with_free_cell()
}

fn office(size: Size, rooms: Rooms, dice: &mut Dice) -> Layout {
    let mut layout = Layout::of(size);
    let across = divide(size.width(), rooms.across, dice);
    let down = divide(size.height(), rooms.down, dice);
    for (rows, columns) in down.iter().flat_map(|rows| across.iter().map(move |columns| (rows, columns))) {
        if columns.end < size.width() {
            let door = rows.start + dice.pick((rows.end - rows.start) as u32) as i16;
            for y in rows.clone().filter(|&y| y != door) {
                layout.build_wall(Edge::new(Cell::new(columns.end, y), Side::West));
            }
        }
        if rows.end < size.height() {
            let door = columns.start + dice.pick((columns.end - columns.start) as u32) as i16;
            for x in columns.clone().filter(|&x| x != door) {
                layout.build_wall(Edge::new(Cell::new(x, rows.end), Side::North));
            }
        }
    }
    layout
}

/// Columns or rows divided into rooms: choosing the places of walls among walls and spare cells, one after the other,
/// makes all choices as likely.
fn divide(cells: i16, rooms: i16, dice: &mut Dice) -> Vec<Range<i16>> {
    let least = LEAST_ROOM_CELLS.min(cells / rooms);
    let (mut walls, mut spare) = (rooms - 1, cells - rooms * least);
    let (mut divided, mut room) = (Vec::new(), 0..least);
    while walls > 0 {
        if dice.pick((walls + spare) as u32) < walls as u32 {
            walls -= 1;
            divided.push(room.clone());
            room = room.end..room.end + least;
        } else {
            spare -= 1;
            room.end += 1;
        }
    }
    divided.push(room.start..cells);
    divided
}

impl FromStr for Generator {
    type Err = Diagnostic;

    fn from_str(description: &str) -> Result<Self, Diagnostic> {
        let form = Form::of(description).ok_or_else(|| {
            let what = format!("{description:?} names no generator");
            Diagnostic::usage(what, format!("the generators are {}", examples()))
        })?;
        let wrong = || {
            let example = if form.pattern == form.example { "" } else { form.example };
            let example = if example.is_empty() { String::new() } else { format!(", for example {example}") };
            let what = format!("{description:?} is not a whole description");
            Diagnostic::usage(what, format!("write {}{example}", form.pattern))
        };
        let parts: Vec<&str> = description.split(':').collect();
        match parts.as_slice() {
            ["open", size] => Ok(Self::Open(parse_size(size, wrong)?)),
            ["walls", size, p] => Ok(Self::Walls(parse_size(size, wrong)?, p.parse()?)),
            ["rooms-a"] => Ok(Self::RoomsA),
            ["rooms-b"] => Ok(Self::RoomsB),
            ["office", size, rooms] => {
                let size = parse_size(size, wrong)?;
                let (across, down) = parse_pair(rooms).ok_or_else(wrong)?;
                let rooms = Rooms::new(across, down, size).ok_or_else(|| {
                    let what = format!("{size} cells cannot hold {across}x{down} rooms");
                    let remedy = "at least one room each way, and at most one for each column and row";
                    Diagnostic::usage(what, remedy)
                })?;
                Ok(Self::Office(size, rooms))
            }
            ["cells", size, p] => Ok(Self::Cells(parse_size(size, wrong)?, p.parse()?)),
            _ => Err(wrong()),
        }
    }
}

fn parse_pair(pair: &str) -> Option<(u64, u64)> {
    let (first, second) = pair.split_once('x')?;
    Some((first.parse().ok()?, second.parse().ok()?))
}

fn parse_size(size: &str, wrong: impl FnOnce() -> Diagnostic) -> Result<Size, Diagnostic> {
    let (width, height) = parse_pair(size).ok_or_else(wrong)?;
    Size::new(width, height)
}

impl fmt::Display for Generator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open(size) => write!(f, "open:{size}"),
            Self::Walls(size, p) => write!(f, "walls:{size}:{p}"),
            Self::RoomsA => f.write_str("rooms-a"),
            Self::RoomsB => f.write_str("rooms-b"),
            Self::Office(size, Rooms { across, down }) => write!(f, "office:{size}:{across}x{down}"),
            Self::Cells(size, p) => write!(f, "cells:{size}:{p}"),
        }
    }
}
