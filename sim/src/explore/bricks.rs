//! Brick&Mortar [Ferranti 2009]: agents that mark cells as visited until none is left, as published, repaired, and
//! robust against missed sensors. Their rows; the team is that of all agents.

use tautline_kernel::bricks::tree::Rule as Trees;
use tautline_kernel::bricks::{Condition, Rule as Bricks};
use tautline_kernel::floor::{Mark, SensorFate};
use tautline_kernel::ground::Cell;
use tautline_proofs::judge::floor::JudgeInput;
use tautline_proofs::plural::counted;

use super::agents::{AGENTS, PREMATURE, UNEXPLORED, UNVISITED, unvisited};
use super::hunt_states::{crew, switched_crew};
use super::{Clause, Knowledge, Profile, Rule, RuleId, Setup, Survey, TeamMove};

const ALONE: Bricks = Bricks::PUBLISHED.with(Condition::Alone);
const BESIDE: Bricks = Bricks { replaced: SensorFate::Beside, ..Bricks::PUBLISHED };
const COUNTED: Bricks = Bricks { replaced: SensorFate::Counted, ..Bricks::PUBLISHED };

/// Brick&Mortar: agents on a sensor floor that mark cells as visited until none is left.
pub static BRICKS: Profile = Profile {
    name: "bricks",
    about: "Brick&Mortar: agents on a sensor floor that mark cells as visited until none is left",
    rules: &[
        switched_crew!(Rule::published; Bricks::PUBLISHED),
        switched_crew!(Rule::repaired; Bricks::REPAIRED),
        switched_crew!("alone", "As published; no cell is marked in which another agent is"; ALONE),
        switched_crew!("beside", "As published; a missed sensor stays beside the new one"; BESIDE),
        switched_crew!("counted", "As published; a new sensor takes over what a missed one says"; COUNTED),
        switched_crew!("tree", "Trees close the loops in place of laps"; Trees::TREE),
    ],
    ..MARKING
};

/// Brick&Mortar with ants' ways, robust against missed sensors. It is ours: nobody has published it.
pub static BRICKS_ANTS: Profile = Profile {
    name: "bricks-ants",
    about: "Brick&Mortar with ants' ways, robust against missed sensors",
    rules: &[switched_crew!(Rule::repaired; Bricks::ROBUST)],
    ..MARKING
};

/// The row of all agents that mark cells as visited.
pub(super) const MARKING: Profile = Profile {
    knowledge: Some(Knowledge::Visited),
    clauses: &[
        Clause { lines: premature, ..Clause::new(PREMATURE.as_str()) },
        Clause::new(UNEXPLORED.as_str()),
        Clause { missed: Some("Connected with a start and not visited"), ..Clause::new(UNVISITED.as_str()) },
    ],
    // A run that nobody has made yet may have no end.
    case: |setup, clause, frames| match frames {
        [] if clause != PREMATURE || setup.robots == 1 => {
            Some(Box::new(JudgeInput::open(clause.as_str(), (0, 0), Vec::new(), Vec::new())))
        }
        [..] => super::team(setup).ok()?.case(&setup.layout, clause),
    },
    ..AGENTS
};

/// How much is left to an agent that is done too early.
fn premature(setup: &Setup, chart: &Survey, made: &TeamMove<'_>) -> Vec<String> {
    let is_left = |cell: &Cell| chart.mark(*cell, made.step) == Mark::Unexplored;
    let left = unvisited(&setup.layout, &setup.starts(), chart).into_iter().filter(is_left).count();
    vec![match left {
        0 => "So an agent is done before all other cells are explored and gone through.".to_owned(),
        left => format!("So an agent is done, with {} unexplored.", counted(left, "cell")),
    }]
}
