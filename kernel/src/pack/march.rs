//! Robots side by side, as a caterpillar: the robot nearest to a frontier cell goes one step towards it, and robots
//! follow into the cells that are left, along a path from it to a robot without which the others are still side by
//! side. So the team can go wherever one robot could go, through ways that are one cell wide.

use super::MAX_ROBOTS;
use crate::ground::{Cell, neighbours};
use crate::net::sets::{first_robots, sets};

/// The robots that are joined to the first one by links, by their number among `cells`.
pub(super) fn joined(cells: &[Cell], is_linked: impl Fn(Cell, Cell) -> bool) -> usize {
    let all = first_robots(cells.len().min(MAX_ROBOTS));
    let [with_first] = sets(all, |one, other| is_linked(cells[one], cells[other]));
    with_first.count_ones() as usize
}

/// Whether robots in these cells are side by side: one set of cells that share sides.
pub(super) fn is_side_by_side(cells: &[Cell]) -> bool {
    joined(cells, neighbours) == cells.len()
}

/// The robots, by their numbers, from `head` to the one that is farthest from it along cells side by side: the first
/// goes to the new cell, and each other one into the cell of the one before it. How many they are, and their numbers.
pub(super) fn caterpillar(cells: &[Cell], head: usize) -> (usize, [usize; MAX_ROBOTS]) {
    // The robot through which each was reached, and the order in which they were.
    let mut before = [None; MAX_ROBOTS];
    let mut order = [head; MAX_ROBOTS];
    let (mut told, mut known) = (0, 1);
    while told < known {
        let from = order[told];
        told += 1;
        for (robot, &cell) in cells.iter().enumerate() {
            if robot != head && before[robot].is_none() && neighbours(cells[from], cell) {
                (order[known], before[robot]) = (robot, Some(from));
                known += 1;
            }
        }
    }
    // Without the robot that was reached last, all others are still reached.
    let (mut path, mut length) = ([head; MAX_ROBOTS], 0);
    let mut last = Some(order[known - 1]);
    while let Some(robot) = last {
        path[length] = robot;
        length += 1;
        last = before[robot];
    }
    path[..length].reverse();
    (length, path)
}
