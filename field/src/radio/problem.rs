//! The faults of a radio field: `Display` says what is wrong, [`Problem::remedy`] what would be right.

use std::fmt;

use tautline_io::number::Number;

/// A fault of a radio field.
#[derive(Clone, Copy, PartialEq, Debug)]
#[expect(missing_docs, reason = "the fields are the numbers that the sentence of each problem shows")]
pub enum Problem {
    /// A side of the area is not a positive number, or too long.
    Side { side_m: f64 },
    /// Too few nodes, or too many.
    Nodes { nodes: usize },
    /// A node that is nowhere: a coordinate is no number, or it is outside the area.
    Outside { node: usize, x_m: f64, y_m: f64 },
    /// A node in an obstacle.
    Blocked { node: usize },
    /// An obstacle, counted from 0, whose sides are no numbers, or that ends before it begins.
    Obstacle { obstacle: usize },
    /// The obstacles leave hardly any room for nodes.
    NoRoom,
    /// The range is not a positive number, or too long.
    Range { range_m: f64 },
    /// The exponent of the propagation is not from 2 to 5.
    Exponent { exponent: f64 },
    /// A standard deviation is not from 0 to 20 dB.
    Deviation { deviation_db: f64 },
    /// A probability is not from 0 to 1.
    Probability { probability: f64 },
    /// So many pairs of nodes are near each other that the links would not fit into memory.
    TooDense { pairs: u64, most: u64 },
    /// There is no such node.
    NoNode { node: u32, nodes: usize },
}

/// `deviation_db`, if it can be a standard deviation.
pub(crate) fn checked_deviation(deviation_db: f64) -> Result<f64, Problem> {
    let fits = (0.0..=MAX_DEVIATION_DB).contains(&deviation_db);
    if fits { Ok(deviation_db) } else { Err(Problem::Deviation { deviation_db }) }
}

/// The longest side of an area.
pub(super) const MAX_SIDE_M: f64 = 1e6;

/// The most nodes of a field.
pub const MAX_NODES: usize = 1_000_000;

/// The longest range: distances have to fit into 32 bits of micrometres.
pub const MAX_RANGE_M: f64 = 4_000.0;

/// The shortest range: a thousand micrometres.
pub(super) const MIN_RANGE_M: f64 = 0.001;

/// The largest standard deviation of a shadow.
const MAX_DEVIATION_DB: f64 = 20.0;

impl Problem {
    /// A hint at the right input.
    pub fn remedy(&self) -> String {
        match *self {
            Self::Side { .. } => format!("give a width and a height above 0 and up to {MAX_SIDE_M} m"),
            Self::Nodes { .. } => format!("give 2 to {MAX_NODES} nodes"),
            Self::Outside { .. } => {
                "put every node inside the area, by two finite numbers of metres".to_owned()
            }
            Self::Blocked { .. } => "put every node outside all obstacles".to_owned(),
            Self::Obstacle { .. } => {
                "give finite numbers of metres, west not beyond east and north not beyond south".to_owned()
            }
            Self::NoRoom => "leave more of the area free of obstacles".to_owned(),
            Self::Range { .. } => format!("give a range from {MIN_RANGE_M} to {MAX_RANGE_M} m"),
            Self::Exponent { .. } => "give an exponent from 2 to 5".to_owned(),
            Self::Deviation { .. } => format!("give a standard deviation from 0 to {MAX_DEVIATION_DB} dB"),
            Self::Probability { .. } => "give a probability from 0 to 1".to_owned(),
            Self::TooDense { .. } => "take fewer nodes, a shorter range or a larger area".to_owned(),
            Self::NoNode { nodes, .. } => format!("the nodes are 0 to {}", nodes.saturating_sub(1)),
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Side { side_m } => write!(f, "an area cannot have a side of {} m", Number(side_m)),
            Self::Nodes { nodes: 0 } => write!(f, "there is no node"),
            Self::Nodes { nodes: 1 } => write!(f, "one node is no network"),
            Self::Nodes { nodes } => write!(f, "{nodes} nodes are too many"),
            Self::Outside { node, x_m, y_m } => {
                write!(f, "node {node} at {}, {} m is not inside the area", Number(x_m), Number(y_m))
            }
            Self::Blocked { node } => write!(f, "node {node} is in an obstacle"),
            Self::Obstacle { obstacle } => write!(f, "obstacle {} is no rectangle", obstacle + 1),
            Self::NoRoom => write!(f, "the obstacles leave no room for nodes"),
            Self::Range { range_m } => write!(f, "the radio range cannot be {} m", Number(range_m)),
            Self::Exponent { exponent } => write!(f, "power cannot fall with exponent {}", Number(exponent)),
            Self::Deviation { deviation_db } => {
                write!(f, "signals cannot vary by a standard deviation of {} dB", Number(deviation_db))
            }
            Self::Probability { probability } => write!(f, "{} is no probability", Number(probability)),
            Self::TooDense { pairs, most } => {
                write!(f, "{pairs} pairs of nodes may hear each other, and memory is for {most}")
            }
            Self::NoNode { node, .. } => write!(f, "there is no node {node}"),
        }
    }
}

impl std::error::Error for Problem {}
