//! KIT \[Peiris\]: robots that drive every path between two nodes and keep in touch, 3 m from node to node: its row,
//! and the start of its team.

mod hunt;
mod layers;
mod scripted;
mod team;

use std::num::NonZeroU32;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::kit::{Rule as Kit, SetupError};

use self::hunt::KernelHunt;
pub use self::team::{
    AHEAD, ANY_SHORTEST, APART, CONNECTED, CONTACT, COVERS, ENDS, EQUAL, MARKS, MOVES, SHORTENS, WHOLE,
};
use self::team::{KitTeam, reach};
use super::script::by_robots;
use super::switches::searched;
use super::{By, Clause, Look, Profile, RandomPart, RuleId, Setup, Starts, Team};
use crate::kit::{MOST_ROBOTS, Pace, course, paths};
use crate::options::Extra;

const MISSED: &str = "Within reach and not driven to";

/// Robots that drive every path between two nodes, and keep in touch.
pub static KIT: Profile = Profile {
    about: "Keep In Touch: robots that drive every path between two cells, and keep in radio contact",
    rules: &[
        searched!(RuleId::PUBLISHED, "As the paper publishes it", Kit::PUBLISHED),
        searched!(RuleId::REPAIRED, "With the repairs of its refuted claims", Kit::REPAIRED),
        searched!(AHEAD, "As published, KIT only where the way ahead is blocked", Kit::AHEAD),
    ],
    robots: 1..=MOST_ROBOTS,
    starts: Starts::Beside,
    extras: &[Extra::RANGE, Extra::SPEED, Extra::SPREAD],
    drawn: &[RandomPart {
        what: "which of several sides a robot takes, and how fast it drives",
        by: By::Every,
    }],
    look: Look::Robots,
    clauses: &[
        Clause::new(CONTACT.as_str()),
        Clause::new(EQUAL.as_str()),
        Clause::new(APART.as_str()),
        Clause { missed: Some(MISSED), ..Clause::new(MOVES.as_str()) },
        Clause::new(ENDS.as_str()),
        Clause { missed: Some(MISSED), ..Clause::new(COVERS.as_str()) },
        Clause::new(MARKS.as_str()),
        Clause::new(SHORTENS.as_str()),
        Clause::new(CONNECTED.as_str()),
        Clause { missed: Some(MISSED), ..Clause::new(WHOLE.as_str()) },
        Clause::new(ANY_SHORTEST.as_str()),
    ],
    ..Profile::named("kit")
};

/// The team of `setup`, each robot at its start.
fn start(setup: &Setup, rule: Kit) -> Result<Box<dyn Team>, Diagnostic> {
    if setup.layout.free_cells() < 2 {
        let what = "this layout has one node, and no path to drive";
        return Err(Diagnostic::of_field("layout", what, "take a layout of at least two free cells"));
    }
    let rule = Kit { reach: reach(setup.options.range_cells)?, ..rule };
    if !setup.choices.is_empty() {
        return by_robots(setup, rule, [scripted::start::<1>, scripted::start::<2>, scripted::start::<3>]);
    }
    let cells = setup.starts();
    let course = course(rule, &setup.layout, &cells, pace(setup), setup.seed);
    let course = course.map_err(fault)?;
    Ok(Box::new(KitTeam::new(course, paths(&setup.layout, setup.base), cells, rule.reach)))
}

/// How fast the robots of `setup` drive. Whatever is out of bounds was refused before.
fn pace(setup: &Setup) -> Pace {
    let thousandths = |number: f64| (number * 1000.0).round() as u32;
    let speed = setup.options.speed_mps.and_then(|metres| NonZeroU32::new(thousandths(metres)));
    let spread = setup.options.spread.map_or(0, thousandths);
    Pace { speed: speed.unwrap_or(Pace::STEADY.speed), spread: spread.min(Pace::MOST_SPREAD) }
}

/// The fault of a team that is refused.
fn fault(refused: SetupError) -> Diagnostic {
    let (field, remedy) = match refused {
        SetupError::Robots { .. } => ("robots", format!("give `robots` a number from 1 to {MOST_ROBOTS}")),
        SetupError::TooManyNodes { .. } => {
            ("layout", "take a layout of at most 64 columns and rows".to_owned())
        }
        SetupError::Outside(_) | SetupError::OneNode(_) | SetupError::OutOfContact(_) => {
            ("starts", "give each robot a start beside another one's".to_owned())
        }
    };
    Diagnostic::of_field(field, refused, remedy)
}
