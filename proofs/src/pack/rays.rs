//! A robot's sight by the geometry of rays alone (PACK-7), and how much it would see elsewhere (PACK-8).

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell};
use tautline_kernel::pack::{Chart, Sight, Status};

use crate::engine::{Outcome, Stop, require};

/// A reading of where a ray stops.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Rays {
    /// An obstacle in a cell that it crosses, and two at a corner through which it passes; the first obstacle is seen.
    Stopped,
    /// Obstacles in cells that it crosses, and none at corners.
    PassCorners,
    /// One obstacle at a corner is enough.
    StopAtCorners,
    /// No obstacle is seen itself.
    SeeNoObstacle,
}

/// Columns and rows from the robot.
type Offset = (i32, i32);

/// Whether two cells so far apart are within R_s.
fn is_within((columns, rows): Offset, sight_cells: i32) -> bool {
    columns.pow(2) + rows.pow(2) <= sight_cells.pow(2)
}

/// Whether the ray to the midpoint of the cell so far away gets there. Along the ray from 0 to 1, times twice the
/// columns and the rows, it is within an open square of side 1 between two numbers for the columns, and between two for
/// the rows.
fn is_clear(rays: Rays, (columns, rows): Offset, is_obstacle: impl Fn(Offset) -> bool) -> bool {
    let (east, south) = (columns.signum(), rows.signum());
    let (columns, rows) = (columns.abs(), rows.abs());
    let is_blocked = |(x, y): Offset| is_obstacle((x * east, y * south));
    let crosses = |(x, y): Offset| {
        let between = |along: i32, of: i32, times: i32| match of {
            // The ray keeps to one line of cells, which this cell is in or not.
            0 if along == 0 => (i32::MIN, i32::MAX),
            0 => (0, 0),
            _ => ((2 * along - 1) * times, (2 * along + 1) * times),
        };
        let (one, other) = (between(x, columns, rows.max(1)), between(y, rows, columns.max(1)));
        one.0.max(other.0) < one.1.min(other.1)
    };
    let cells = (0..=columns).flat_map(|x| (0..=rows).map(move |y| (x, y)));
    let mut between = cells.filter(|&cell| cell != (0, 0) && cell != (columns, rows));
    let is_stopped = between.any(|cell| crosses(cell) && is_blocked(cell));
    // The corner south-east of a cell is on the ray if it divides it as the ray's end does.
    let mut corners = (0..columns).flat_map(|x| (0..rows).map(move |y| (x, y)));
    let is_pinched = corners.any(|(x, y)| {
        let is_on = (2 * x + 1) * rows == (2 * y + 1) * columns;
        let beside = [(x + 1, y), (x, y + 1)].map(is_blocked);
        is_on
            && match rays {
                Rays::Stopped | Rays::SeeNoObstacle => beside == [true; 2],
                Rays::PassCorners => false,
                Rays::StopAtCorners => beside != [false; 2],
            }
    });
    !is_stopped && !is_pinched
}

/// The visibility gain of `cell` by what is on the `chart`: how many unknown cells would be seen that are not within
/// R_s of a cell in `others`.
pub(super) fn gain<W: AsRef<[[u64; 2]]>>(
    chart: &Chart<W>,
    sight_cells: u8,
    cell: Cell,
    others: &[Cell],
) -> u32 {
    let far = |one: Cell, other: Cell| (i32::from(other.x - one.x), i32::from(other.y - one.y));
    let sight_cells = i32::from(sight_cells);
    let is_obstacle = |(columns, rows): Offset| {
        chart.status(Cell::new(cell.x + columns as i16, cell.y + rows as i16)) == Status::Obstacle
    };
    let seen = chart.area().cells().filter(|&seen| {
        chart.status(seen) == Status::Unknown
            && is_within(far(cell, seen), sight_cells)
            && !others.iter().any(|&other| is_within(far(other, seen), sight_cells))
            && is_clear(Rays::Stopped, far(cell, seen), is_obstacle)
    });
    seen.count() as u32
}

/// The area in which a robot looks round: its rows are longer than a machine word.
const SIZE: (i16, i16) = (68, 5);

/// Where it does: in corners of the area, in its middle, and about the border of the first word of a row.
const PLACES: [(i16, i16); 7] = [(0, 0), (2, 2), (61, 2), (62, 2), (63, 2), (65, 2), (67, 4)];

/// R_s, and the most obstacles among the cells within it.
const SIGHTS: [(u16, usize); 2] = [(2, 12), (3, 2)];

/// The situations that must occur.
pub(super) const COVERS: [&str; 2] = ["all is seen", "something is hidden"];

/// The bound of [`sees`], in words.
pub(super) fn views() -> String {
    let sights = SIGHTS
        .map(|(sight_cells, most)| format!("R_s {sight_cells} with at most {most} obstacles within it"));
    let (width, height) = SIZE;
    format!("{} places of a robot in {width}×{height} cells, {}", PLACES.len(), sights.join(", "))
}

/// PACK-7: a robot looks round in an unknown area.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn sees(rays: &Rays, oracle: &mut dyn Oracle) -> Outcome {
    type Map = Chart<Vec<[u64; 2]>>;
    let (sight_cells, most) = SIGHTS[oracle.pick(SIGHTS.len() as u32) as usize];
    let at = Cell::from(PLACES[oracle.pick(PLACES.len() as u32) as usize]);
    let sight = Sight::new(sight_cells).ok_or(Stop::Assumed)?;
    let area = Area::new(Cell::new(0, 0), Cell::new(SIZE.0 - 1, SIZE.1 - 1)).ok_or(Stop::Assumed)?;
    let mut chart = Map::new(area, vec![[0; 2]; Map::words(area)]).ok_or(Stop::Assumed)?;
    let far = sight_cells as i16;
    let disc: Vec<Cell> = (-far..=far)
        .flat_map(|row| (-far..=far).map(move |column| (column, row)))
        .filter(|&(column, row)| {
            (column, row) != (0, 0) && is_within((column.into(), row.into()), far.into())
        })
        .map(|(column, row)| Cell::new(at.x + column, at.y + row))
        .filter(|&cell| area.contains(cell))
        .collect();
    let mut obstacles: Vec<Cell> = Vec::new();
    for &cell in &disc {
        if obstacles.len() < most && oracle.flip() {
            obstacles.push(cell);
        }
    }
    chart.look(&sight, at, |cell| obstacles.contains(&cell), |_, _| ());
    let is_obstacle = |(columns, rows): Offset| {
        let cell = Cell::new(at.x + columns as i16, at.y + rows as i16);
        !area.contains(cell) || obstacles.contains(&cell)
    };
    let mut outcome = COVERS[0];
    for cell in area.cells() {
        let offset = (i32::from(cell.x - at.x), i32::from(cell.y - at.y));
        let is_seen = is_within(offset, far.into())
            && is_clear(*rays, offset, is_obstacle)
            && !(*rays == Rays::SeeNoObstacle && is_obstacle(offset));
        let expected = match is_seen {
            false => Status::Unknown,
            true if obstacles.contains(&cell) => Status::Obstacle,
            true => Status::Free,
        };
        if !is_seen && disc.contains(&cell) {
            outcome = COVERS[1];
        }
        require(chart.status(cell) == expected, "a robot sees a cell if and only if a ray goes there")?;
    }
    Ok(outcome)
}
