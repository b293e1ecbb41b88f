//! The marks in the cells of a wide grid, row by row, and floods over them.

use tautline_kernel::ground::{CellMark, EdgeMark, Side};

/// The marks of one cell: four bits for the cell, then for each mark of edges four bits, one a side. An edge is
/// marked in both its cells, so that one word tells a search all about a cell.
pub(super) type Marks = u16;

pub(super) const EXPLORED: Marks = cell_mark(CellMark::Explored);

pub(super) const fn cell_mark(mark: CellMark) -> Marks {
    1 << mark as u16
}

pub(super) const fn edge_mark(mark: EdgeMark, side: Side) -> Marks {
    1 << (4 + 4 * mark as u16 + side as u16)
}

pub(super) const fn all_sides(mark: EdgeMark) -> Marks {
    0b1111 << (4 + 4 * mark as u16)
}

/// More steps than any path has.
pub(super) const UNREACHED: u32 = u32::MAX;

/// The distances of the cells near one of them.
#[derive(Clone, Debug)]
pub struct Near {
    /// The place from which on there are distances: rows too far away have none.
    first: usize,
    /// By place from there on; `UNREACHED` for cells that are not near.
    steps: Vec<u32>,
}

impl Near {
    pub(super) const NOTHING: Self = Self { first: 0, steps: Vec::new() };

    /// The distance of the cell at `place`, if it is near.
    pub(super) fn distance(&self, place: usize) -> Option<u32> {
        let steps = place.checked_sub(self.first).and_then(|place| self.steps.get(place).copied());
        steps.filter(|&steps| steps != UNREACHED)
    }
}

/// The marks of all cells, row by row.
#[derive(Clone, Debug)]
pub(super) struct Map {
    /// Cells in a row.
    pub(super) width: usize,
    pub(super) marks: Vec<Marks>,
}

impl Map {
    /// Takes `mark` off all edges.
    pub(super) fn clear(&mut self, mark: EdgeMark) {
        for marks in &mut self.marks {
            *marks &= !all_sides(mark);
        }
    }

    /// Marks the border as walls.
    pub(super) fn close_border(&mut self) {
        let (width, last) = (self.width, self.marks.len() - self.width);
        for row in self.marks.chunks_exact_mut(width) {
            row[0] |= edge_mark(EdgeMark::Wall, Side::West);
            row[width - 1] |= edge_mark(EdgeMark::Wall, Side::East);
        }
        for marks in &mut self.marks[..width] {
            *marks |= edge_mark(EdgeMark::Wall, Side::North);
        }
        for marks in &mut self.marks[last..] {
            *marks |= edge_mark(EdgeMark::Wall, Side::South);
        }
    }

    /// The neighbours of the cell at `place` beyond sides that carry none of the `blocked` marks. The border,
    /// a wall for good, keeps them in the area.
    pub(super) fn neighbours(&self, place: usize, blocked: Marks) -> impl Iterator<Item = usize> + use<> {
        let (closed, width) = (self.marks[place] & blocked, self.width);
        Side::ALL
            .into_iter()
            .filter(move |&side| closed & edge_sides(side) == 0)
            .map(move |side| beyond(place, side, width))
    }

    /// Tells of the cells at most `most` steps from the one at `from` over sides without a wall, nearest first, with
    /// their distances, until `tell` says that it has heard enough.
    pub(super) fn flood(&self, from: usize, most: u32, mut tell: impl FnMut(usize, u32) -> bool) -> Near {
        let (rows, row) = (self.marks.len() / self.width, from / self.width);
        let far = usize::try_from(most).unwrap_or(rows);
        let (first, last) = (row.saturating_sub(far), row.saturating_add(far).min(rows - 1));
        let first = first * self.width;
        let mut near = Near { first, steps: vec![UNREACHED; (last + 1) * self.width - first] };
        near.steps[from - first] = 0;
        let (mut ring, mut next) = (vec![from], Vec::new());
        for distance in 0..=most {
            for place in ring.drain(..) {
                if !tell(place, distance) {
                    return near;
                }
                if distance == most {
                    continue;
                }
                for beyond in self.neighbours(place, all_sides(EdgeMark::Wall)) {
                    let steps = &mut near.steps[beyond - first];
                    if *steps == UNREACHED {
                        *steps = distance + 1;
                        next.push(beyond);
                    }
                }
            }
            if next.is_empty() {
                break;
            }
            std::mem::swap(&mut ring, &mut next);
        }
        near
    }

    /// Whether the distances in `near` hold with the wall that now stands between two cells: the farther one has
    /// another neighbour as near.
    pub(super) fn outlasts(&self, near: &Near, one: usize, other: usize) -> bool {
        let (Some(of_one), Some(of_other)) = (near.distance(one), near.distance(other)) else { return true };
        let (nearer, farther) = if of_one < of_other { (of_one, other) } else { (of_other, one) };
        self.neighbours(farther, all_sides(EdgeMark::Wall)).any(|place| near.distance(place) == Some(nearer))
    }

    /// The neighbours of the cell at `place` that are one link away: beyond its sides, and round its corners.
    pub(super) fn linked(&self, place: usize) -> impl Iterator<Item = usize> {
        let open = |place: usize| {
            let walls = self.marks[place];
            Side::ALL.into_iter().filter(move |&side| walls & edge_mark(EdgeMark::Wall, side) == 0)
        };
        open(place).flat_map(move |side| {
            let next = beyond(place, side, self.width);
            let turns = open(next).filter(move |&turn| turn != side && turn != side.opposite());
            std::iter::once(next).chain(turns.map(move |turn| beyond(next, turn, self.width)))
        })
    }
}

/// The neighbour beyond `side` of the cell at `place`, where rows have `width` cells.
pub(super) const fn beyond(place: usize, side: Side, width: usize) -> usize {
    match side {
        Side::East => place + 1,
        Side::South => place + width,
        Side::West => place - 1,
        Side::North => place - width,
    }
}

/// All marks of edges on this `side`.
const fn edge_sides(side: Side) -> Marks {
    edge_mark(EdgeMark::Wall, side) | edge_mark(EdgeMark::Open, side) | edge_mark(EdgeMark::Virtual, side)
}
