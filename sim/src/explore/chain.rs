//! The recursive chain [Kovács 2011, III]: its row, the start of its team in the smallest grid that holds its area, and
//! how its clauses are told.

mod areas;
mod bounds;
pub mod hunt;
mod layers;
mod team;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::chain::{self, Chain, MAX_ROBOTS, SetupError};
use tautline_kernel::ground::{Area, Cell, Grid, MediumGrid, SmallGrid};
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::judge::Case;
use tautline_proofs::judge::chain::judges;
use tautline_proofs::plural::{counted, listed};

use self::bounds::team_fault;
use self::hunt::Walls;
use self::team::ChainTeam;
pub use self::team::{ANY_ORDER, DEATH, HEARD};
use super::judge_input::judge_input;
use super::switches::SwitchableRule;
use super::{
    By, Clause, Completeness, Look, Profile, RandomPart, Rule, RuleId, Setup, Starts, Team, TeamMove,
};
use crate::options::Extra;
use tautline_grids::heap_grid::HeapGrid;

/// The rule that reels the chain in and out instead of backtracking, and holds contact whoever fails.
pub const REEL: RuleId = RuleId::new("reel");
/// The reel whose robots keep apart.
pub const APART: RuleId = RuleId::new("apart");
/// The reel without *Hold*.
pub const UNHELD: RuleId = RuleId::new("unheld");

/// The row of a chain that is hunted, and whose conditions can be switched.
macro_rules! searched {
    ($name:expr, $about:expr, $chain:expr) => {
        Rule::new($name, $about, |setup| start(setup, $chain.rule))
            .hunted(&Walls($chain))
            .switched(&switched($chain.rule))
    };
}

/// A base, a leader that seeks the frontier, and followers that keep radio contact.
pub static CHAIN: Profile = Profile {
    about: "A base, a leader that seeks the frontier, and followers that keep radio contact",
    rules: &[
        searched!(RuleId::PUBLISHED, "As the paper publishes it", Subject::PUBLISHED),
        searched!(RuleId::REPAIRED, "With the repairs of its refuted claims", Subject::REPAIRED),
        searched!(
            REEL,
            "Within the repaired conditions, the shortest rehearsed way to an unexplored cell",
            Subject::REEL
        ),
        searched!(APART, "The reel, whose robots never exchange cells, and part at once", Subject::APART),
        searched!(UNHELD, "The reel without the condition that holds contact whoever fails", Subject::UNHELD),
    ],
    team: "chain",
    robots: 2..=MAX_ROBOTS,
    starts: Starts::Base,
    told: Completeness::All,
    extras: &[Extra::LOSS, Extra::FAIL, Extra::WALL, Extra::SPEEDS],
    drawn: &[
        RandomPart { what: "which bytes are lost", by: By::Told(Extra::LOSS) },
        RandomPart { what: "in which order the robots go", by: By::Told(Extra::SPEEDS) },
    ],
    look: Look::Linked {
        is_lost: |from, to| Breach::Contact.is_in(from, to) || Breach::Coverage.is_in(from, to),
    },
    clauses: &[
        Clause { lines: |_, _, made| far_apart(made), ..Clause::new(Breach::Contact.clause()) },
        Clause { lines: |_, _, made| crowded(&made.frame.cells), ..Clause::new(Breach::Crowding.clause()) },
        Clause { lines: |_, _, made| out_of_range(made), ..Clause::new(Breach::Coverage.clause()) },
        Clause::new(HEARD.as_str()),
        Clause::new(Breach::Costly.clause()),
        Clause { missed: Some("Within reach and unexplored"), ..Clause::new(Breach::Completeness.clause()) },
        Clause::new(ANY_ORDER.as_str()),
        Clause { missed: Some("Within reach of those left and unexplored"), ..Clause::new(DEATH.as_str()) },
    ],
    // In which order robots went is not written down.
    case: |setup, clause, frames| {
        let is_judged = clause != ANY_ORDER && judges(clause.as_str());
        is_judged.then(|| Box::new(judge_input(setup, clause.as_str(), frames)) as Box<dyn Case>)
    },
    ..Profile::named("chain")
};

/// A chain's rule whose conditions can be switched: a mutant still claims to follow it.
const fn switched(rule: chain::Rule) -> SwitchableRule<chain::Rule> {
    SwitchableRule {
        rule,
        start,
        hunt: |rule, intended| Some(Box::new(Walls(Subject { rule, intended, ..Subject::PUBLISHED }))),
    }
}

/// The chain of `setup`, all robots at the base.
fn start(setup: &Setup, rule: chain::Rule) -> Result<Box<dyn Team>, Diagnostic> {
    match setup.robots {
        0..=8 => begin::<_, 8>(setup, rule, SmallGrid::new),
        9..=32 => begin::<_, 32>(setup, rule, MediumGrid::new),
        _ => begin::<_, MAX_ROBOTS>(setup, rule, |area| Some(HeapGrid::new(area))),
    }
    .map_err(team_fault)
}

fn begin<G: Grid + Clone + 'static, const ROBOTS: usize>(
    setup: &Setup,
    rule: chain::Rule,
    grid: impl Fn(Area) -> Option<G>,
) -> Result<Box<dyn Team>, SetupError> {
    let (base, robots) = (setup.base, usize::from(setup.robots));
    let area = chain::area(setup.layout.size().area(), base, robots).ok_or(SetupError::BaseOutside(base))?;
    let grid = grid(area).ok_or(SetupError::TooManyRobots { robots, most: ROBOTS })?;
    let chain = Chain::<G, ROBOTS>::new(rule, robots, base, grid)?;
    Ok(Box::new(ChainTeam::new(setup, chain)))
}

/// The neighbours in the chain that are out of contact.
fn far_apart(made: &TeamMove<'_>) -> Vec<String> {
    pairs(Breach::Contact, made, |behind, ahead, apart| {
        format!("So R_{ahead} is {apart} from R_{behind}: outside E_C, its cell is not wholly covered.")
    })
}

/// The neighbours in the chain that may have left each other's range.
fn out_of_range(made: &TeamMove<'_>) -> Vec<String> {
    pairs(Breach::Coverage, made, |behind, ahead, apart| {
        format!("So the centres of R_{behind} and R_{ahead}, {apart} apart in the end, may leave r_cov.")
    })
}

/// The robots that are too many in one cell.
fn crowded(team: &[Cell]) -> Vec<String> {
    let mut crowded: Vec<Cell> = team.iter().copied().filter(|&cell| cell != team[0]).collect();
    crowded.sort_unstable();
    let too_many = crowded.chunk_by(|one, other| one == other).filter(|cells| cells.len() > 2);
    let told = |cells: &[Cell]| {
        let here = (1..).zip(team).filter(|&(_, &cell)| cell == cells[0]);
        let robots = listed(here.map(|(robot, _)| format!("R_{robot}")));
        format!("So {robots} are in one cell, {}.", cells[0])
    };
    too_many.map(told).collect()
}

/// The neighbours in the chain that commit `breach` by themselves, in the words of `told`: by the number of the one
/// behind, that of the one ahead, and how far apart they are in the end.
fn pairs(breach: Breach, made: &TeamMove<'_>, told: impl Fn(usize, usize, &str) -> String) -> Vec<String> {
    let pairs = (1..).zip(made.before.windows(2).zip(made.frame.cells.windows(2)));
    let broken = pairs.filter(|(_, (from, to))| breach.is_in(from, to));
    let line = |(robot, (_, to)): (usize, (&[Cell], &[Cell]))| {
        let (columns, rows) = to[0].apart(to[1]);
        told(robot, robot + 1, &format!("{} and {}", counted(columns, "column"), counted(rows, "row")))
    };
    broken.map(line).collect()
}
