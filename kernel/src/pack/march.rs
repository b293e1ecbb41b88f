//! Robots side by side, as a caterpillar: the robot nearest to a frontier cell goes one step towards it, and robots follow into the
//! cells that are left, along a path from it to a robot without which the others are still side by side. So the team can go
//! wherever one robot could go, through ways that are one cell wide.

use super::MAX_ROBOTS;
use crate::ground::{Cell, neighbours};

/// Sets of robots, one bit each.
type Robots = u32;

/// The robots that are joined to the first one by links, by their number among `cells`.
pub(super) fn joined(cells: &[Cell], is_linked: impl Fn(Cell, Cell) -> bool) -> usize {
    let (mut reached, mut left): (Robots, Robots) = (1, 1);
    while left != 0 {
        let from = left.trailing_zeros() as usize;
        left &= left - 1;
        let Some(&at) = cells.get(from) else { break };
        for (robot, &cell) in cells.iter().enumerate().take(MAX_ROBOTS) {
            if reached >> robot & 1 == 0 && is_linked(at, cell) {
                reached |= 1 << robot;
                left |= 1 << robot;
            }
        }
    }
    reached.count_ones() as usize
}

/// Whether robots in these cells are side by side: one set of cells that share sides.
pub(super) fn is_side_by_side(cells: &[Cell]) -> bool {
    joined(cells, neighbours) == cells.len()
}

/// The robots, by their numbers, from `head` to the one that is farthest from it along cells side by side: the first goes to the
/// new cell, and each other one into the cell of the one before it. How many they are, and their numbers.
pub(super) fn caterpillar(cells: &[Cell], head: usize) -> (usize, [usize; MAX_ROBOTS]) {
    // The robot through which each was reached, and the order in which they were.
    let mut before = [None; MAX_ROBOTS];
    let mut order = [head; MAX_ROBOTS];
    let (mut told, mut known) = (0, 1);
    let mut reached: Robots = 1 << (head % MAX_ROBOTS);
    while let Some(&from) = order.get(told).filter(|_| told < known) {
        told += 1;
        let Some(&at) = cells.get(from) else { break };
        for (robot, &cell) in cells.iter().enumerate().take(MAX_ROBOTS) {
            if reached >> robot & 1 == 1 || !neighbours(at, cell) {
                continue;
            }
            reached |= 1 << robot;
            if let (Some(place), Some(link)) = (order.get_mut(known), before.get_mut(robot)) {
                (*place, *link) = (robot, Some(from));
                known += 1;
            }
        }
    }
    // Without the robot that was reached last, all others are still reached.
    let mut path = [head; MAX_ROBOTS];
    let mut last = order.get(known - 1).copied();
    let mut length = 0;
    while let (Some(robot), Some(place)) = (last, path.get_mut(length)) {
        *place = robot;
        length += 1;
        last = before.get(robot).copied().flatten();
    }
    if let Some(path) = path.get_mut(..length) {
        path.reverse();
    }
    (length, path)
}
