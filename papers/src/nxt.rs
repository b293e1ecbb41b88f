//! The robots of the paper's physical run [Kovács 2011, F]: cells of 4 m, 0.30 m/s, 180°/s, a touch sensor, and a
//! navigation error of 2·10⁻³ of the way. A team move of the rules becomes seconds and millimetres.
//!
//! A robot first turns by the shorter way, then drives from centre to centre. A robot that touches something backs up
//! 30 cm and goes round on a rectangular path; if it touches again, that was an extended obstacle, and it goes back to
//! the centre of its cell; else it has passed another robot. How far aside it goes is ours: its length and its width.
//! The robots of a team move begin together, and the team move ends with the last one.

use tautline_kernel::ground::{Cell, Side, Step};
use tautline_proofs::run::Frame;

/// From the centre of a cell to that of the next, in millimetres.
pub(crate) const CELL_MM: u64 = 4000;
/// How far a robot drives in a second.
pub(crate) const SPEED_MM: u64 = 300;
/// How long a quarter turn takes.
const QUARTER_MS: u64 = 500;
/// How far a robot backs up from what it touches.
const BACK_MM: u64 = 300;
/// Its length.
const LENGTH_MM: u64 = 220;
/// How far it goes aside: its length and its width.
const ASIDE_MM: u64 = LENGTH_MM + 180;
/// The error of its place, per mille of its way.
pub(crate) const DRIFT_PER_MILLE: u64 = 2;

/// Millimetres and quarter turns.
type Way = (u64, u64);

/// The way of a robot that meets a wall: to the wall, back, aside and to the wall again, and from there back and aside
/// to the centre.
const WALL: Way = (2 * ((CELL_MM - LENGTH_MM) / 2 + BACK_MM + ASIDE_MM), 4);

/// The way that another robot on the way costs besides: back and forth again, aside and back.
const PASSING: Way = (2 * (BACK_MM + ASIDE_MM), 4);

const fn milliseconds((way_mm, quarters): Way) -> u64 {
    way_mm * 1000 / SPEED_MM + quarters * QUARTER_MS
}

/// The time that a run has taken so far.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Odometer {
    /// The way that each robot faces; all face east at first.
    headings: Vec<Side>,
    /// The way that each robot drove.
    ways_mm: Vec<u64>,
    /// All team moves, each until its last robot has arrived.
    pub(crate) milliseconds: u64,
    /// How often a robot met a wall.
    pub(crate) walls: u32,
    /// How often a robot passed another one.
    pub(crate) passed: u32,
}

impl Odometer {
    /// `robots` robots that have not moved, the base counted.
    pub(crate) fn new(robots: usize) -> Self {
        Self {
            headings: vec![Side::East; robots],
            ways_mm: vec![0; robots],
            milliseconds: 0,
            walls: 0,
            passed: 0,
        }
    }

    /// The robots, which were in the cells `before`, make this team move.
    pub(crate) fn make(&mut self, before: &[Cell], frame: &Frame) {
        let mut last = 0;
        for (robot, &step) in frame.steps.iter().enumerate() {
            let Step::Cross(side) = step else { continue };
            let turned = turns(self.headings[robot], side);
            self.headings[robot] = side;
            let (way, quarters) = if frame.blocked[robot] {
                self.walls += 1;
                WALL
            } else if meets(before, frame, robot) {
                self.passed += 1;
                (CELL_MM + PASSING.0, PASSING.1)
            } else {
                (CELL_MM, 0)
            };
            self.ways_mm[robot] += way;
            last = last.max(milliseconds((way, turned + quarters)));
        }
        self.milliseconds += last;
    }

    /// The longest way of a robot.
    pub(crate) fn longest_mm(&self) -> u64 {
        self.ways_mm.iter().copied().max().unwrap_or(0)
    }

    /// How far off the robot with the longest way can be.
    pub(crate) fn drift_mm(&self) -> u64 {
        self.longest_mm() * DRIFT_PER_MILLE / 1000
    }
}

/// Quarter turns from one side to another.
const fn turns(from: Side, to: Side) -> u64 {
    let apart = (4 + to as u64 - from as u64) % 4;
    if apart == 3 { 1 } else { apart }
}

/// Whether `robot`, which arrives, has another one in its way: one that stays in the cell that it enters, outside the
/// base, or one that comes the other way and has a lower number.
fn meets(before: &[Cell], frame: &Frame, robot: usize) -> bool {
    let (from, to) = (before[robot], frame.cells[robot]);
    (0..before.len()).filter(|&other| other != robot).any(|other| {
        let stays = before[other] == to && frame.cells[other] == to && to != before[0];
        stays || (other < robot && before[other] == to && frame.cells[other] == from)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tautline_kernel::chain::Kind;

    fn frame(steps: &[Step], blocked: &[bool], before: &[Cell]) -> Frame {
        let after = before.iter().zip(steps).zip(blocked);
        let cells =
            after.map(|((&cell, &step), &blocked)| if blocked { cell } else { cell.after(step) }).collect();
        Frame { kind: Kind::Advance, steps: steps.to_vec(), blocked: blocked.to_vec(), cells }
    }

    #[test]
    fn a_straight_move_takes_13_333_ms_and_a_quarter_turn_500_more() {
        let before = [Cell::new(0, 0), Cell::new(0, 0)];
        let mut odometer = Odometer::new(2);
        odometer.make(&before, &frame(&[Step::Stay, Step::Cross(Side::East)], &[false; 2], &before));
        assert_eq!(odometer.milliseconds, 13_333);
        odometer.make(&before, &frame(&[Step::Stay, Step::Cross(Side::North)], &[false; 2], &before));
        assert_eq!((odometer.milliseconds, odometer.longest_mm(), odometer.drift_mm()), (27_166, 8000, 16));
        assert_eq!((odometer.walls, odometer.passed), (0, 0));
    }

    #[test]
    fn turns_go_the_shorter_way() {
        assert_eq!(Side::ALL.map(|side| turns(Side::East, side)), [0, 1, 2, 1]);
        assert_eq!(Side::ALL.map(|side| turns(Side::North, side)), [1, 2, 1, 0]);
    }

    #[test]
    fn a_robot_backs_up_from_a_wall_and_goes_round_another_robot() {
        let before = [Cell::new(0, 0), Cell::new(2, 0), Cell::new(3, 0)];
        let [east, west] = [Side::East, Side::West].map(Step::Cross);
        let mut swap = Odometer::new(3);
        swap.make(&before, &frame(&[Step::Stay, east, west], &[false; 3], &before));
        assert_eq!((swap.passed, swap.walls), (1, 0));
        assert_eq!(swap.milliseconds, (4000 + 1400) * 1000 / 300 + 6 * 500);
        let mut wall = Odometer::new(3);
        wall.make(&before, &frame(&[Step::Stay, east, west], &[false, true, false], &before));
        assert_eq!((wall.passed, wall.walls), (1, 1));
        let mut shared = Odometer::new(3);
        shared.make(&before, &frame(&[Step::Stay, Step::Stay, west], &[false; 3], &before));
        assert_eq!(shared.passed, 1);
    }
}
