//! The faults of a rescue: `Display` says what is wrong, [`Problem::remedy`] what would be right.

use std::fmt;

use tautline_io::diagnostic::Diagnostic;
use tautline_io::named_values::NamedValues;
use tautline_io::number::Number;
use tautline_proofs::plural::counted;

use super::{MAX_EVENTS, MAX_ROBOTS, MAX_WFRS, SchemeName, Setting};
use crate::radio::{self, checked_deviation};

/// The most nodes, each counted once for each WFR: what they know of the calls fits into half a gibibyte.
pub(super) const MAX_STATES: usize = 4_000_000;

/// A fault of a rescue.
#[derive(Clone, Copy, PartialEq, Debug)]
#[expect(missing_docs, reason = "the fields are the numbers that the sentence of each problem shows")]
pub enum Problem {
    /// Something about the radio field.
    Field(radio::Problem),
    /// k is 0, or larger than the scheme can count.
    K { k: u8, scheme: SchemeName, most: u8 },
    /// No WFR, or too many.
    Wfrs { wfrs: usize, nodes: usize },
    /// More WFRs than nodes.
    WfrsOfNodes { wfrs: usize, nodes: usize },
    /// A node is to be a WFR twice.
    WfrTwice { node: u32 },
    /// More places for WFRs than WFRs.
    WfrPlaces { places: usize, wfrs: usize },
    /// No event at each WFR, or too many.
    Events { events: usize },
    /// No robot, or too many.
    Robots { robots: usize },
    /// More places for robots than robots.
    RobotPlaces { places: usize, robots: usize },
    /// A robot that is nowhere: a coordinate is no number, or it is outside the area.
    RobotOutside { robot: usize, x_m: f64, y_m: f64 },
    /// A robot in an obstacle.
    RobotBlocked { robot: usize },
    /// More robots are to fail than there are.
    Failing { failing: usize, robots: usize },
    /// More nodes are to fail than there are beside the WFRs.
    FailingNodes { failing: usize, others: usize },
    /// More nodes than memory allows for so many WFRs.
    TooLarge { nodes: usize, wfrs: usize },
}

impl From<radio::Problem> for Problem {
    fn from(problem: radio::Problem) -> Self {
        Self::Field(problem)
    }
}

impl Problem {
    /// A hint at the right input.
    pub fn remedy(&self) -> String {
        match *self {
            Self::Field(problem) => problem.remedy(),
            Self::K { most, .. } => format!("give a k from 1 to {most}"),
            Self::Wfrs { nodes, .. } => format!("let 1 to {} nodes call", nodes.min(MAX_WFRS)),
            Self::WfrsOfNodes { nodes, .. } => {
                format!("let 1 to {nodes} nodes call, or take more nodes")
            }
            Self::WfrTwice { .. } => "name each node once".to_owned(),
            Self::WfrPlaces { places, wfrs } if places > MAX_WFRS => format!("name at most {wfrs} of them"),
            Self::WfrPlaces { places, .. } => format!("let {places} nodes call, or name fewer of them"),
            Self::Events { .. } => format!("let 1 to {MAX_EVENTS} events happen at each node that calls"),
            Self::Robots { .. } => format!("take 1 to {MAX_ROBOTS} robots"),
            Self::RobotPlaces { places, robots } if places > MAX_ROBOTS => {
                format!("place at most {robots} of them")
            }
            Self::RobotPlaces { places, .. } => format!("take {places} robots, or place fewer of them"),
            Self::RobotOutside { .. } => {
                "put every robot inside the area, by two finite numbers of metres".to_owned()
            }
            Self::RobotBlocked { .. } => "put every robot outside all obstacles".to_owned(),
            Self::Failing { robots, .. } => format!("let 0 to {robots} fail"),
            Self::FailingNodes { others, .. } => format!("let 0 to {others} fail"),
            Self::TooLarge { wfrs, .. } => {
                format!("take at most {} nodes, or let fewer of them call", MAX_STATES / wfrs.max(1))
            }
        }
    }

    /// The field of `setting` that makes it.
    pub(super) fn culprit(&self, setting: &Setting) -> &'static str {
        match self {
            Self::Field(problem) => match problem {
                radio::Problem::Side { .. } => "area_m",
                radio::Problem::Nodes { .. }
                | radio::Problem::Outside { .. }
                | radio::Problem::Blocked { .. }
                | radio::Problem::TooDense { .. } => "nodes",
                radio::Problem::Obstacle { .. } | radio::Problem::NoRoom => "obstacles_m",
                radio::Problem::Range { .. } => "range_m",
                radio::Problem::Exponent { .. } => "exponent",
                radio::Problem::Deviation { .. } if checked_deviation(setting.shadowing_db).is_err() => {
                    "shadowing_db"
                }
                radio::Problem::Deviation { .. } => "noise_db",
                radio::Problem::Probability { .. } => "loss",
                radio::Problem::NoNode { .. } => "wfrs_at",
            },
            Self::K { .. } => "k",
            Self::Wfrs { .. } | Self::WfrsOfNodes { .. } => "wfrs",
            Self::WfrTwice { .. } | Self::WfrPlaces { .. } => "wfrs_at",
            Self::Events { .. } => "events_per_wfr",
            Self::Robots { .. } => "robots",
            Self::RobotPlaces { .. } | Self::RobotOutside { .. } | Self::RobotBlocked { .. } => "robots_at_m",
            Self::Failing { .. } => "failing",
            Self::FailingNodes { .. } => "failing_nodes",
            Self::TooLarge { .. } => "nodes",
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Field(problem) => write!(f, "{problem}"),
            Self::K { k, scheme, .. } => write!(f, "no scheme {} has a k of {k}", scheme.word()),
            Self::Wfrs { wfrs: 0, .. } => write!(f, "nobody calls for help"),
            Self::Wfrs { wfrs, .. } => write!(f, "{wfrs} nodes that call are too many"),
            Self::WfrsOfNodes { wfrs, nodes } => write!(f, "{wfrs} of {nodes} nodes cannot call"),
            Self::WfrTwice { node } => write!(f, "node {node} cannot call twice"),
            Self::WfrPlaces { places, wfrs } => {
                write!(f, "more nodes are named ({places}) than are to call ({wfrs})")
            }
            Self::Events { events: 0 } => write!(f, "nothing happens"),
            Self::Events { events } => write!(f, "{events} events at each node that calls are too many"),
            Self::Robots { robots: 0 } => write!(f, "there is no robot"),
            Self::Robots { robots } => write!(f, "{robots} robots are too many"),
            Self::RobotPlaces { places, robots } => {
                write!(f, "there are {places} places for {}", counted(robots, "robot"))
            }
            Self::RobotOutside { robot, x_m, y_m } => {
                write!(f, "robot {robot} at {}, {} m is not inside the area", Number(x_m), Number(y_m))
            }
            Self::RobotBlocked { robot } => write!(f, "robot {robot} is in an obstacle"),
            Self::Failing { failing, robots } => {
                write!(f, "there are fewer robots ({robots}) than are to fail ({failing})")
            }
            Self::FailingNodes { failing, others } => {
                write!(f, "only {others} of the nodes can fail, not {failing}: none that calls does")
            }
            Self::TooLarge { nodes, wfrs } => {
                write!(f, "what {nodes} nodes know of {wfrs} that call does not fit into memory")
            }
        }
    }
}

impl std::error::Error for Problem {}

impl From<Problem> for Diagnostic {
    fn from(problem: Problem) -> Self {
        Self::usage(problem, problem.remedy())
    }
}
