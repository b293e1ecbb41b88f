//! Which robot goes to which unexplored cell: robots and cells are paired, the nearest pair first.
//!
//! Every robot computes the pairs by itself, from its own map and from what the others have told. A
//! robot takes one of as many cells as there are robots, the others at most all but one of them: so a
//! list of that length for each robot is enough.

use core::ops::ControlFlow;

use super::map::{BY_NUMBER, Map, Status};
use super::rule::{Condition, Rule};
use super::search::{Search, Target, Way, search};
use crate::ground::{Area, Cell, Side};

/// A robot and an unexplored cell that it could go to. What is less goes first: robots and cells count by the row and
/// the column of their cells.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pair {
    distance: u32,
    is_unclaimed: bool,
    /// Unexplored neighbours of the cell.
    unexplored: u8,
    /// Cells to the rim of the area.
    inland: u16,
    robot: (i16, i16),
    cell: (i16, i16),
    /// The side through which the robot leaves its cell. It decides no order:
    /// no two pairs of a list differ in it alone.
    first: Side,
}

/// The memory of searches, and of pairs.
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scratch<'a> {
    /// That of searches.
    pub search: Search<'a>,
    /// As many as the square of the robots; with fewer, fewer of the nearest cells are compared. With fewer than robots
    /// no cell is, and a robot takes itself for done.
    pub pairs: &'a mut [Option<Pair>],
}

/// A robot that is to be paired. Robots in one cell count as one, of which the first has a say.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Seeker {
    /// The cell that it is in.
    pub cell: Cell,
    /// The cell that it has claimed.
    pub aim: Option<Cell>,
}

impl Pair {
    /// The pair of `seeker` and the cell that it has found in `map`.
    pub fn new<M: Map>(map: &M, rule: &Rule, seeker: Seeker, found: Target) -> Self {
        let is_corner = rule.has(Condition::Corner);
        let unexplored =
            |side: &&Side| is_corner && map.status(found.cell.beyond(**side)) == Status::Unexplored;
        Self {
            distance: found.distance,
            is_unclaimed: rule.has(Condition::Claim) && seeker.aim != Some(found.cell),
            unexplored: BY_NUMBER.iter().filter(unexplored).count() as u8,
            inland: if is_corner { inland(map.area(), found.cell) } else { 0 },
            robot: number(seeker.cell),
            cell: number(found.cell),
            first: found.first,
        }
    }

    const fn to(&self) -> Cell {
        Cell::new(self.cell.1, self.cell.0)
    }

    /// Whether a robot in `from` may be as near to the cell of this pair as the robot of this pair is.
    fn may_be_lost_to(&self, from: Cell) -> bool {
        let (columns, rows) = from.apart(self.to());
        u32::from(columns) + u32::from(rows) <= self.distance
    }

    /// The way to its cell.
    pub fn found(&self) -> Target {
        Target { cell: self.to(), distance: self.distance, first: self.first }
    }
}

const fn number(cell: Cell) -> (i16, i16) {
    (cell.y, cell.x)
}

/// How far `cell` is from the rim of `area`.
fn inland(area: Area, cell: Cell) -> u16 {
    let (first, last) = (area.first(), area.last());
    let columns = cell.x.abs_diff(first.x).min(cell.x.abs_diff(last.x));
    let rows = cell.y.abs_diff(first.y).min(cell.y.abs_diff(last.y));
    columns.min(rows)
}

/// A list of pairs of one robot, those that come first.
type List = [Option<Pair>];

/// Puts `pair` into its place of `list`, of which the last one falls out.
fn insert(list: &mut List, pair: Pair) {
    let place = list.iter().position(|known| known.is_none_or(|known| pair < known));
    if let Some(after) = place.and_then(|place| list.get_mut(place..)) {
        after.rotate_right(1);
        if let Some(free) = after.first_mut() {
            *free = Some(pair);
        }
    }
}

/// Fills `list` with the pairs of `seeker` whose cells are no farther than the nearest one from `least` on, nor than
/// `most`. Returns how far that one is, and `None` if there is none.
fn fill<M: Map>(
    map: &M,
    rule: &Rule,
    seeker: Seeker,
    (least, most): (u32, u32),
    memory: &mut Search<'_>,
    list: &mut List,
) -> Option<u32> {
    list.fill(None);
    let mut level = None;
    search(map, seeker.cell, most, memory, |found| {
        let is_beyond = |last: u32| last < found.distance;
        let last = list.last().copied().flatten().map(|last| last.distance);
        if level.is_some_and(is_beyond) || last.is_some_and(is_beyond) {
            return ControlFlow::Break(());
        }
        if found.distance >= least {
            level = Some(found.distance);
        }
        insert(list, Pair::new(map, rule, seeker, found));
        ControlFlow::Continue(())
    });
    level
}

/// The pair of `own`, and how far the others are looked at for it, which is as far as its own cells are.
#[derive(Debug)]
pub(super) struct Pairing<'a, 'm, M, I> {
    pub(super) map: &'a M,
    pub(super) rule: &'a Rule,
    pub(super) own: Seeker,
    /// Whether its way must not be longer than the one to the cell it has claimed, or
    /// to a nearest one if it has claimed none.
    pub(super) is_bound: bool,
    pub(super) others: I,
    pub(super) memory: &'a mut Search<'m>,
    pub(super) pairs: &'a mut List,
}

impl<M: Map, I: ExactSizeIterator<Item = Seeker> + Clone> Pairing<'_, '_, M, I> {
    /// The way to the unexplored cell that the robot is paired with, or to the one that comes first for it if all cells
    /// are the others'; `None` if it reaches none.
    ///
    /// Pairs that are farther come later, so that cells are looked at level by level, no farther than it takes.
    pub(super) fn found(&mut self) -> Option<Way> {
        let robots = self.others.len() + 1;
        let each = (self.pairs.len() / robots).min(robots);
        let (mut first, mut level) = (None, 0);
        loop {
            let bounds = (level + 1, u32::MAX);
            let list = self.pairs.get_mut(..each)?;
            let Some(next) = fill(self.map, self.rule, self.own, bounds, self.memory, list) else {
                return first.map(Way::Taken);
            };
            first = first.or_else(|| list.first().copied().flatten().map(|pair| pair.found()));
            level = next;
            let filled = self.fill_others(each, level);
            if let Some(paired) = self.paired(filled) {
                let near = first.filter(|first| self.is_bound && self.is_within(paired.distance, first));
                return Some(near.map_or(Way::Paired(paired), Way::Near));
            }
        }
    }

    /// Whether the cell that the robot has claimed, or the `first` one if it has
    /// claimed none, is nearer than `distance`.
    fn is_within(&mut self, distance: u32, first: &Target) -> bool {
        let (cell, mut is_nearer) = (self.own.aim.unwrap_or(first.cell), false);
        if first.distance < distance {
            search(self.map, self.own.cell, distance - 1, self.memory, |found| {
                is_nearer = found.cell == cell;
                if is_nearer { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
        }
        is_nearer
    }

    /// Adds a list for each other robot that may be as near to a cell of the lists as the robots that these are of, and
    /// returns how many places of the lists are in use. Measured by columns and rows, the others are farther, and take
    /// none of these cells first.
    fn fill_others(&mut self, each: usize, level: u32) -> usize {
        let mut filled = each;
        loop {
            let before = filled;
            for other in self.others.clone() {
                let (known, free) = self.pairs.split_at_mut(filled);
                let mut known = known.iter().flatten();
                let counts = known.clone().any(|pair| pair.may_be_lost_to(other.cell));
                if !counts || known.any(|pair| pair.robot == number(other.cell)) {
                    continue;
                }
                let Some(list) = free.get_mut(..each) else { continue };
                fill(self.map, self.rule, other, (u32::MAX, level), self.memory, list);
                if list.first().is_some_and(Option::is_some) {
                    filled += each;
                }
            }
            if filled == before {
                return filled;
            }
        }
    }

    /// Takes pairs out of the lists, the first one first, until it is the robot's own.
    fn paired(&mut self, filled: usize) -> Option<Target> {
        let pairs = self.pairs.get_mut(..filled)?;
        while let Some(next) = pairs.iter().flatten().min().copied() {
            if next.robot == number(self.own.cell) {
                return Some(next.found());
            }
            let is_over = |pair: &Pair| pair.robot == next.robot || pair.cell == next.cell;
            pairs.iter_mut().filter(|pair| pair.as_ref().is_some_and(is_over)).for_each(|pair| *pair = None);
        }
        None
    }
}
