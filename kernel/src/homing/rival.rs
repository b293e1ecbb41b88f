//! Where a robot goes next under two schemes of others, as paper 003, 2.1, tells of them: Verma's credit field, for which
//! all know their positions, and Reich's gradient, for which nobody does. Both flood the whole network once, so that every
//! sensor knows its hops from the goal.

use crate::broadcast::NodeId;

/// A place, in micrometres.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Position {
    /// Along +x.
    pub x_um: i64,
    /// Along +y.
    pub y_um: i64,
}

/// A neighbour of Verma's robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Station {
    /// Where it is.
    pub at: Position,
    /// Its hops from the goal.
    pub hops: u16,
}

/// Verma's credit field: the place to which the robot goes next, `hops` from the goal itself. A neighbour's credit is
/// larger the nearer it is to the goal: here, how many hops nearer than the robot. Each neighbour that has credit attracts
/// the robot by it, so that it goes to the middle of them, weighted by credit; to the goal itself where that is in
/// range. `None` if no neighbour is nearer than the robot: it has gone astray, or the network is in parts.
pub fn verma(hops: u16, neighbours: impl IntoIterator<Item = Station>) -> Option<Position> {
    let (mut x, mut y, mut credits) = (0, 0, 0);
    for Station { at, hops: of_neighbour } in neighbours {
        let credit = i128::from(hops.saturating_sub(of_neighbour));
        if of_neighbour == 0 && credit > 0 {
            return Some(at);
        }
        x += i128::from(at.x_um) * credit;
        y += i128::from(at.y_um) * credit;
        credits += credit;
    }
    // A mean is between the least and the greatest of what it is the mean of.
    let mean = |sum: i128| sum.checked_div_euclid(credits).map(|mean| mean as i64);
    Some(Position { x_um: mean(x)?, y_um: mean(y)? })
}

/// A neighbour of Reich's robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Gradient {
    /// Which sensor.
    pub node: NodeId,
    /// Its gradient: hops from the target, low near it.
    pub hops: u16,
    /// Whether the robot has been there.
    pub visited: bool,
}

/// Reich's gradient: the neighbour to which the robot goes next, the unvisited one of least gradient, the least identity
/// first; `None` if all are visited. The paper says at once that the way leads from high to low and that the largest is
/// chosen; only the first leads to the target.
pub fn reich(neighbours: impl IntoIterator<Item = Gradient>) -> Option<NodeId> {
    let unvisited = neighbours.into_iter().filter(|neighbour| !neighbour.visited);
    unvisited.min_by_key(|neighbour| (neighbour.hops, neighbour.node)).map(|neighbour| neighbour.node)
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn station(x_um: i64, y_um: i64, hops: u16) -> Station {
        Station { at: Position { x_um, y_um }, hops }
    }

    #[test]
    fn credit_draws_the_robot_to_the_neighbours_nearer_to_the_goal_and_to_the_goal_in_range() {
        let level = [station(0, 9_000, 5), station(0, -9_000, 6)];
        let nearer = [station(6_000, 0, 4), station(12_000, 3_000, 3)];
        let place = |x_um, y_um| Some(Position { x_um, y_um });
        assert_eq!(verma(5, level), None, "none is nearer");
        assert_eq!(verma(5, level.into_iter().chain(nearer)), place(10_000, 2_000));
        assert_eq!(verma(1, [station(-7_000, 1, 0), station(5, 5, 1)]), place(-7_000, 1));
        assert_eq!(verma(5, []), None);
        assert_eq!(verma(2, [station(i64::MAX, i64::MIN, 1); 3]), place(i64::MAX, i64::MIN));
    }

    #[test]
    fn the_gradient_leads_down_over_sensors_not_visited() {
        let gradient = |node, hops, visited| Gradient { node: NodeId(node), hops, visited };
        let neighbours =
            [gradient(4, 3, false), gradient(2, 3, false), gradient(1, 2, true), gradient(9, 7, false)];
        assert_eq!(reich(neighbours), Some(NodeId(2)));
        assert_eq!(reich([gradient(1, 2, true)]), None);
    }
}
