//! The names under which a table or an object has a position, and their units.

/// A part of a position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Part {
    /// The stamp.
    Time,
    /// The name of the robot.
    Robot,
    /// The place along an axis.
    Along(usize),
}

/// By part: the names that it has in logs. Those with `timestep` and `vehicle` are the floating car data of SUMO.
const NAMES: [(Part, &[&str]); 4] = [
    (Part::Time, &["time", "t", "stamp", "timestamp", "timestep_time"]),
    (Part::Robot, &["robot", "name", "id", "robot_id", "agent", "vehicle_id"]),
    (Part::Along(0), &["x", "pos_x", "position_x", "vehicle_x"]),
    (Part::Along(1), &["y", "pos_y", "position_y", "vehicle_y"]),
];

/// Microseconds of the units of time, and millimetres of those of length.
const SECONDS: [(&str, f64); 4] = [("s", 1e6), ("ms", 1e3), ("us", 1.0), ("ns", 1e-3)];
const METRES: [(&str, f64); 4] = [("m", 1e3), ("cm", 10.0), ("mm", 1.0), ("km", 1e6)];

/// The part that a name stands for, and what one of its unit is in microseconds or millimetres. Without a unit, seconds
/// and metres are meant.
pub(super) fn part(name: &str) -> Option<(Part, f64)> {
    let name = name.trim().to_ascii_lowercase();
    let known = |name: &str| NAMES.iter().find(|(_, names)| names.contains(&name)).map(|&(part, _)| part);
    let units = |part| match part {
        Part::Time => Some(SECONDS),
        Part::Along(_) => Some(METRES),
        Part::Robot => None,
    };
    if let Some(part) = known(&name) {
        return Some((part, units(part).map_or(1.0, |units| units[0].1)));
    }
    let (stem, unit) = name.rsplit_once('_')?;
    let part = known(stem)?;
    let (_, scale) = units(part)?.into_iter().find(|(known, _)| *known == unit)?;
    Some((part, scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_ends_with_its_unit() {
        assert_eq!(part("t_ms"), Some((Part::Time, 1e3)));
        assert_eq!(part("X_mm"), Some((Part::Along(0), 1.0)));
        assert_eq!(part("y"), Some((Part::Along(1), 1e3)));
        assert_eq!(part("robot_id"), Some((Part::Robot, 1.0)));
        assert_eq!((part("x_s"), part("speed"), part("vehicle_angle")), (None, None, None));
    }
}
