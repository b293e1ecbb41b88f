//! Sheu's back-and-forth ([Jiang 2011, 2.1]): without a directional antenna the robot walks a random direction to the
//! place where a guide node's beacon is strongest, turns by 90°, walks the way on which it becomes stronger, and so on.

use tautline_kernel::net::Strength;
use tautline_kernel::tan::Heading;

/// The robot's next action, a step of a length that the caller gives.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Walk {
    /// A step that way.
    Step(Heading),
    /// Nothing: it is at the guide node.
    Stop,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Leg {
    /// The first step of a line: it may be the wrong way.
    Trying,
    /// The first step was wrong: back over it, and on.
    Reversed,
    /// The beacon became stronger.
    Rising,
}

/// A robot that seeks a guide node by the strength of its beacon alone.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct BackAndForth {
    heading: Heading,
    leg: Leg,
    last: Strength,
    near: Strength,
}

impl BackAndForth {
    /// A robot that hears the beacon as `heard` and begins by `heading`, which is left to chance. It is there when the
    /// beacon is at least `near`.
    pub(super) const fn new(heading: Heading, heard: Strength, near: Strength) -> Self {
        Self { heading, leg: Leg::Trying, last: heard, near }
    }

    /// The robot's action now.
    pub(super) const fn order(&self) -> Walk {
        if self.last.0 >= self.near.0 { Walk::Stop } else { Walk::Step(self.heading) }
    }

    /// The beacon after the step. One that is not heard is taken as weaker than any.
    #[must_use]
    pub(super) fn measure(mut self, heard: Option<Strength>) -> Self {
        let now = heard.unwrap_or(Strength(i32::MIN));
        let is_stronger = now > self.last;
        (self.heading, self.leg) = match (self.leg, is_stronger) {
            (Leg::Trying | Leg::Reversed | Leg::Rising, true) => (self.heading, Leg::Rising),
            (Leg::Trying, false) => (self.heading.opposite(), Leg::Reversed),
            (Leg::Reversed | Leg::Rising, false) => (self.heading.quarter(), Leg::Trying),
        };
        self.last = now;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn heard((x_mm, y_mm): (i64, i64)) -> Strength {
        Strength(-((x_mm * x_mm + y_mm * y_mm).isqrt() as i32))
    }

    #[test]
    fn whichever_way_it_begins_the_robot_comes_to_the_beacon() {
        for heading in Heading::all() {
            for start in [(20_000, 0), (0, -20_000), (9_000, 14_000), (-300, 24_000)] {
                let (mut x, mut y) = start;
                let mut robot = BackAndForth::new(heading, heard(start), Strength(-1_000));
                let mut steps = 0;
                while let Walk::Step(heading) = robot.order() {
                    // A quarter of a metre.
                    let (cosine, sine) = heading.vector();
                    (x, y) = (x + i64::from(cosine) / 4_000, y + i64::from(sine) / 4_000);
                    robot = robot.measure(Some(heard((x, y))));
                    steps += 1;
                    assert!(steps < 400, "{heading:?} from {start:?}: at ({x}, {y})");
                }
                assert!(x * x + y * y <= 1_000 * 1_000);
            }
        }
    }

    #[test]
    fn a_step_out_of_range_is_taken_back() {
        let robot = BackAndForth::new(Heading::FIRST, Strength(-500), Strength(0)).measure(None);
        assert_eq!(robot.order(), Walk::Step(Heading::FIRST.opposite()));
        let back = robot.measure(Some(Strength(-500)));
        assert_eq!(back.order(), Walk::Step(Heading::FIRST.opposite()));
    }

    #[test]
    fn where_both_ways_are_no_better_it_turns_by_a_quarter() {
        let even = Some(Strength(-500));
        let robot =
            BackAndForth::new(Heading::FIRST, Strength(-500), Strength(0)).measure(even).measure(even);
        assert_eq!(robot.order(), Walk::Step(Heading::FIRST.opposite().quarter()));
    }
}
