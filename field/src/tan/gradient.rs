//! Where a robot goes next under two rivals of TAN [Jiang 2011, 2.1]: Verma's credit field, for which all know their
//! positions, and Reich's gradient, for which nobody does. Both flood the whole network once, so that every sensor
//! knows its hops from the goal.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::named_values::NamedValues;
use tautline_kernel::net::NodeId;

/// A place, in micrometres.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Position {
    /// Along +x.
    pub(super) x_um: i64,
    /// Along +y.
    pub(super) y_um: i64,
}

/// A neighbour of Verma's robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Station {
    /// Where it is.
    pub(super) at: Position,
    /// Its hops from the goal.
    pub(super) hops: u16,
}

/// Verma's credit field: the place to which the robot goes next. A neighbour's credit is the larger the fewer its hops
/// from the goal. The paper says only that high-credit neighbours attract the robot; here those of the highest credit
/// do, all alike, so that it goes to the middle of them: to the goal itself where that is in range. `None` if there is
/// no neighbour.
pub(super) fn verma(neighbours: impl IntoIterator<Item = Station>) -> Option<Position> {
    let (mut fewest, mut x, mut y, mut count) = (u16::MAX, 0, 0, 0);
    for Station { at, hops } in neighbours {
        if hops < fewest {
            (fewest, x, y, count) = (hops, 0, 0, 0);
        }
        if hops == fewest {
            x += i128::from(at.x_um);
            y += i128::from(at.y_um);
            count += 1;
        }
    }
    // A mean is between the least and the greatest of what it is the mean of.
    let mean = |sum: i128| sum.checked_div_euclid(count).map(|mean| mean as i64);
    Some(Position { x_um: mean(x)?, y_um: mean(y)? })
}

/// A neighbour of Reich's robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Gradient {
    /// Which sensor.
    pub node: NodeId,
    /// Its gradient: hops from the target, low near it.
    pub(super) hops: u16,
    /// Whether the robot has been there.
    pub visited: bool,
}

/// Which unvisited sensor Reich's robot goes to. The paper says at once that the way leads from high to low gradients
/// and that the largest is chosen.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NextSensor {
    /// The one with the least gradient: the first sentence.
    Least,
    /// The one with the largest gradient: the second sentence.
    Largest,
    /// The one with the largest gradient, but the target itself where the robot hears it; and where all are visited,
    /// the sensor that it came from. So the movement ends only when the target is found.
    LargestAndBack,
}

impl NamedValues for NextSensor {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Least, "least", "The one with the least gradient"),
        (Self::Largest, "largest", "The one with the largest; where all are visited it is lost"),
        (
            Self::LargestAndBack,
            "largest-and-back",
            "The target where it hears it, else the largest; else it goes back",
        ),
    ];
}

/// Reich's gradient: the unvisited neighbour to which the robot goes next, of equal ones that of least identity; `None`
/// if all are visited.
pub(super) fn reich(order: NextSensor, neighbours: impl IntoIterator<Item = Gradient>) -> Option<NodeId> {
    let unvisited = neighbours.into_iter().filter(|neighbour| !neighbour.visited);
    let rank = |hops: u16| match order {
        NextSensor::Least => hops,
        NextSensor::LargestAndBack if hops == 0 => 0,
        NextSensor::Largest | NextSensor::LargestAndBack => u16::MAX - hops,
    };
    unvisited.min_by_key(|neighbour| (rank(neighbour.hops), neighbour.node)).map(|neighbour| neighbour.node)
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn station(x_um: i64, y_um: i64, hops: u16) -> Station {
        Station { at: Position { x_um, y_um }, hops }
    }

    #[test]
    fn credit_draws_the_robot_to_the_middle_of_the_neighbours_nearest_to_the_goal_and_to_the_goal_in_range() {
        let place = |x_um, y_um| Some(Position { x_um, y_um });
        let farther = [station(0, 9_000, 5), station(0, -9_000, 6)];
        let nearest = [station(6_000, 0, 4), station(12_000, 3_000, 4)];
        assert_eq!(verma(farther), place(0, 9_000));
        assert_eq!(verma(farther.into_iter().chain(nearest)), place(9_000, 1_500));
        assert_eq!(verma(nearest.into_iter().chain(farther)), place(9_000, 1_500));
        assert_eq!(verma([station(5, 5, 1), station(-7_000, 1, 0)]), place(-7_000, 1));
        assert_eq!(verma([]), None);
        assert_eq!(verma([station(3, 4, u16::MAX)]), place(3, 4));
        assert_eq!(verma([station(i64::MAX, i64::MIN, 1); 3]), place(i64::MAX, i64::MIN));
    }

    #[test]
    fn the_gradient_leads_down_over_sensors_not_visited() {
        let gradient = |node, hops, visited| Gradient { node: NodeId(node), hops, visited };
        let neighbours =
            [gradient(4, 3, false), gradient(2, 3, false), gradient(1, 2, true), gradient(9, 7, false)];
        assert_eq!(reich(NextSensor::Least, neighbours), Some(NodeId(2)));
        assert_eq!(reich(NextSensor::Least, [gradient(1, 2, true)]), None);
    }

    #[test]
    fn the_largest_gradient_leads_up_and_a_target_that_is_heard_comes_first() {
        let gradient = |node, hops, visited| Gradient { node: NodeId(node), hops, visited };
        let neighbours =
            [gradient(0, 0, false), gradient(4, 3, false), gradient(2, 3, false), gradient(9, 7, true)];
        assert_eq!(reich(NextSensor::Largest, neighbours), Some(NodeId(2)));
        assert_eq!(reich(NextSensor::LargestAndBack, neighbours), Some(NodeId(0)));
        assert_eq!(reich(NextSensor::LargestAndBack, neighbours.into_iter().skip(1)), Some(NodeId(2)));
        assert_eq!(reich(NextSensor::Largest, [gradient(0, 0, false)]), Some(NodeId(0)));
    }
}
