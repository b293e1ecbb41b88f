//! The grid of square cells and the three environments of a cell [Kovács 2011, III.A, equation (1)].
//! Clause LATTICE-1 shows that the environments, derived here from the radii in whole numbers, are the
//! sets that the paper draws.

use core::fmt;

/// A square cell, by column and row: `x` grows eastwards, `y` grows southwards, as text and images are
/// read. The unit is the side of a cell, C in the paper.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "(i16, i16)", into = "(i16, i16)")
)]
pub struct Cell {
    /// Column.
    pub x: i16,
    /// Row.
    pub y: i16,
}

impl Cell {
    /// The cell in column `x` and row `y`.
    pub const fn new(x: i16, y: i16) -> Self {
        Self { x, y }
    }

    /// The neighbour beyond `side`. At the rim of the coordinates (±32,767) a cell is its own neighbour.
    #[inline]
    pub const fn beyond(self, side: Side) -> Self {
        self.after(Step::Cross(side))
    }

    #[inline]
    const fn moved(self, (columns, rows): (i16, i16)) -> Self {
        match (self.x.checked_add(columns), self.y.checked_add(rows)) {
            (Some(x), Some(y)) => Self::new(x, y),
            _ => self,
        }
    }

    /// Where `step` leads from here, if nothing is in the way.
    #[inline]
    pub const fn after(self, step: Step) -> Self {
        const OFFSETS: [(i16, i16); 8] = [(1, 0), (0, 1), (-1, 0), (0, -1), (0, 0), (0, 0), (0, 0), (0, 0)];
        self.moved(OFFSETS[step.place() % OFFSETS.len()])
    }

    /// The cell so many columns and rows away, or the nearest one that has coordinates.
    #[inline]
    pub const fn at_offset(self, columns: i16, rows: i16) -> Self {
        Self::new(self.x.saturating_add(columns), self.y.saturating_add(rows))
    }

    /// Columns and rows between two cells, without sign.
    #[inline]
    pub const fn apart(self, other: Self) -> (u16, u16) {
        (self.x.abs_diff(other.x), self.y.abs_diff(other.y))
    }
}

/// As it is printed.
#[cfg(feature = "defmt")]
impl defmt::Format for Cell {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{=i16},{=i16}", self.x, self.y);
    }
}

impl fmt::Debug for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({},{})", self.x, self.y)
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.x, self.y)
    }
}

impl From<(i16, i16)> for Cell {
    fn from((x, y): (i16, i16)) -> Self {
        Self::new(x, y)
    }
}

impl From<Cell> for (i16, i16) {
    fn from(cell: Cell) -> Self {
        (cell.x, cell.y)
    }
}

/// One of the four sides of a cell, in the direction order that settles every tie: +x, +y, −x, −y.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Side {
    /// +x
    East,
    /// +y
    South,
    /// −x
    West,
    /// −y
    North,
}

impl Side {
    /// All sides in direction order.
    pub const ALL: [Self; 4] = [Self::East, Self::South, Self::West, Self::North];

    /// The side to the left of who goes through this one.
    #[inline]
    pub const fn turned_left(self) -> Self {
        Self::ALL[(self as usize + 3) % Self::ALL.len()]
    }

    /// The side to the right of who goes through this one.
    #[inline]
    pub const fn turned_right(self) -> Self {
        self.turned_left().opposite()
    }

    /// This edge seen from the cell beyond it.
    #[inline]
    pub const fn opposite(self) -> Self {
        Self::ALL[(self as usize + 2) % Self::ALL.len()]
    }
}

/// One robot's part in one team move: cross a side of its cell, or stay.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Step {
    /// Go to the cell beyond this side.
    Cross(Side),
    /// The null move.
    Stay,
}

impl Step {
    /// All steps in direction order: +x, +y, −x, −y, stay.
    pub const ALL: [Self; 5] = [
        Self::Cross(Side::East),
        Self::Cross(Side::South),
        Self::Cross(Side::West),
        Self::Cross(Side::North),
        Self::Stay,
    ];

    /// Its place in direction order.
    #[inline]
    pub const fn place(self) -> usize {
        match self {
            Self::Cross(side) => side as usize,
            Self::Stay => 4,
        }
    }

    /// The step that takes this one back.
    #[inline]
    pub const fn reverse(self) -> Self {
        match self {
            Self::Cross(side) => Self::Cross(side.opposite()),
            Self::Stay => Self::Stay,
        }
    }
}

/// The common side of two neighbouring cells: where a wall can stand. Both ways of naming it, from either
/// cell, are the same value.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Edge {
    cell: Cell,
    /// East or south.
    side: Side,
}

impl Edge {
    /// The edge on this `side` of `cell`.
    #[inline]
    pub const fn new(cell: Cell, side: Side) -> Self {
        // From a cell to the western or northern one of the two.
        const OFFSETS: [(i16, i16); 4] = [(0, 0), (0, 0), (-1, 0), (0, -1)];
        const SIDES: [Side; 4] = [Side::East, Side::South, Side::East, Side::South];
        Self { cell: cell.moved(OFFSETS[side as usize]), side: SIDES[side as usize] }
    }

    /// The western or northern cell of the two.
    pub const fn cell(self) -> Cell {
        self.cell
    }

    /// The side of [`Edge::cell`] on which the edge lies: east or south.
    #[inline]
    pub const fn side(self) -> Side {
        self.side
    }
}

impl fmt::Debug for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}|{:?}", self.cell, self.cell.beyond(self.side()))
    }
}

/// A circle round the centre of a cell, by four times its squared radius, so that all arithmetic is exact.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Circle {
    four_radius_squared: u64,
}

impl Circle {
    /// r_safe = 3√2/2, equation (1): the circle of E_S.
    pub const SAFE: Self = Self { four_radius_squared: 18 };
    /// r_cov = √26/2, equation (1): the circle of E_C.
    pub const COVERED: Self = Self { four_radius_squared: 26 };

    /// The circle whose radius r satisfies 4·r² = `four_radius_squared`.
    pub const fn new(four_radius_squared: u64) -> Self {
        Self { four_radius_squared }
    }

    /// Whether `cell` lies wholly inside the circle round the centre of `round`: E_S and E_C are the sets of
    /// such cells. The farthest corner decides; it is half a cell beyond the centre in both coordinates.
    #[inline]
    pub const fn covers(self, round: Cell, cell: Cell) -> bool {
        let (dx, dy) = (round.x as i64 - cell.x as i64, round.y as i64 - cell.y as i64);
        let (x, y) = (2 * dx.unsigned_abs() + 1, 2 * dy.unsigned_abs() + 1);
        x * x + y * y <= self.four_radius_squared
    }

    /// Whether the centre of `cell` lies inside the circle round the centre of `round`.
    #[inline]
    pub const fn reaches(self, round: Cell, cell: Cell) -> bool {
        let (x, y) = (round.x as i64 - cell.x as i64, round.y as i64 - cell.y as i64);
        4 * (x * x + y * y) as u64 <= self.four_radius_squared
    }
}

/// Whether `to` is in E_N(`from`): the cell itself or one of its four side neighbours.
#[inline]
pub const fn neighbours(from: Cell, to: Cell) -> bool {
    let (dx, dy) = from.apart(to);
    dx as u32 + dy as u32 <= 1
}
