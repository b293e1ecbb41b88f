//! KIT \[Peiris\]: robots that drive every path between two nodes and keep in touch, 3 m from node to node. Its row,
//! and its team. A team move is one robot's drive, in the order in which they begin; whoever drives is drawn where it
//! arrives.
//!
//! As published no robot knows when everything is driven: whoever watches them ends the run then. A run in
//! which no new path is driven for twenty drives a path is over.

mod hunt;
mod layers;
mod scripted;

use std::collections::BTreeSet;
use std::num::NonZeroU32;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_kernel::kit::{Reach, Rule as Kit, SetupError, Stance};
use tautline_proofs::run::Frame;

use self::hunt::KernelHunt;

use super::catalogue::{By, Profile, RandomPart, Starts};
use super::clause::{Clause, ClauseId, broken};
use super::connectivity::unlinked;
use super::rule::{Rule, RuleId, SwitchableRule};
use super::run::{End, Surroundings, Survey, Team};
use super::scene::{Layer, Scene};
use super::setup::Setup;
use crate::kit::{Course, Drive, MOST_ROBOTS, Pace, course, paths};
use crate::options::Extra;
use tautline_grids::layout::Layout;

/// Of two robots, one may not hear the other at all speeds.
pub const CONTACT: ClauseId = ClauseId::new("KIT-1");

/// Of two robots at equal speeds, one may not hear the other.
pub const EQUAL: ClauseId = ClauseId::new("KIT-2");

/// A robot drives to where another one is or goes.
pub const APART: ClauseId = ClauseId::new("KIT-3");

/// A path within reach is not driven, and nobody can decide.
pub const MOVES: ClauseId = ClauseId::new("KIT-6");

/// Robots go round for ever, and keep nobody from acting: what a search has found so.
pub const ENDS: ClauseId = ClauseId::new("KIT-7");

/// All robots are done, and a path within reach is not driven.
pub const COVERS: ClauseId = ClauseId::new("KIT-8");

/// A side counts as covered that nobody has covered, or the other way round.
pub const MARKS: ClauseId = ClauseId::new("KIT-10");

/// A drive over an old path shortens no way.
pub const SHORTENS: ClauseId = ClauseId::new("KIT-11");

/// A robot that drives a path again may take each side that begins a shortest way, and no other.
pub const ANY_SHORTEST: ClauseId = ClauseId::new("KIT-14");

/// Of three robots and more, one may be cut off at some speeds.
pub const CONNECTED: ClauseId = ClauseId::new("KIT-12");

/// Three robots and more that start side by side leave a path undriven that paths join to their starts.
pub const WHOLE: ClauseId = ClauseId::new("KIT-13");

/// The published rule, read by the words of section 3.
pub const AHEAD: RuleId = RuleId::new("ahead");

const MISSED: &str = "Within reach and not driven to";

/// Drives a path without a new one after which a run is over.
const PATIENCE: usize = 20;

/// Robots that drive every path between two nodes, and keep in touch.
pub static KIT: Profile = Profile {
    about: "Keep In Touch: robots that drive every path between two cells, and keep in radio contact",
    rules: &[
        Rule::published(|setup| start(setup, Kit::PUBLISHED), &KernelHunt(Kit::PUBLISHED))
            .switched(&switched(Kit::PUBLISHED)),
        Rule::repaired(|setup| start(setup, Kit::REPAIRED), &KernelHunt(Kit::REPAIRED))
            .switched(&switched(Kit::REPAIRED)),
        Rule::new(AHEAD, "As published, KIT only where the way ahead is blocked", |setup| {
            start(setup, Kit::AHEAD)
        })
        .hunted(&KernelHunt(Kit::AHEAD))
        .switched(&switched(Kit::AHEAD)),
    ],
    robots: 1..=MOST_ROBOTS,
    starts: Starts::Beside,
    extras: &[Extra::RANGE, Extra::SPEED, Extra::SPREAD],
    drawn: &[RandomPart {
        what: "which of several sides a robot takes, and how fast it drives",
        by: By::Every,
    }],
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
    case: |setup, clause, _| scripted::case(setup, clause),
    ..Profile::named("kit")
};

struct KitTeam {
    course: Box<dyn Course>,
    cells: Vec<Cell>,
    /// The paths within reach.
    due: Vec<Edge>,
    /// Drives since the last new path.
    idle: usize,
    reach: Reach,
    /// The last one.
    drive: Option<Drive>,
}

/// A rule whose conditions can be switched.
const fn switched(rule: Kit) -> SwitchableRule<Kit> {
    SwitchableRule { rule, start, hunt: |rule, _| Some(Box::new(KernelHunt(rule))) }
}

/// The team of `setup`, each robot at its start.
fn start(setup: &Setup, rule: Kit) -> Result<Box<dyn Team>, Diagnostic> {
    if setup.layout.free_cells() < 2 {
        let what = "this layout has one node, and no path to drive";
        return Err(Diagnostic::of_field("layout", what, "take a layout of at least two free cells"));
    }
    let rule = Kit { reach: reach(setup.options.range_cells)?, ..rule };
    if !setup.choices.is_empty() {
        return scripted::start(setup, rule);
    }
    let cells = setup.starts();
    let course = course(rule, &setup.layout, &cells, pace(setup), setup.seed);
    let course = course.map_err(fault)?;
    let (due, reach) = (paths(&setup.layout, setup.base), rule.reach);
    Ok(Box::new(KitTeam { course, due, cells, idle: 0, reach, drive: None }))
}

/// How far robots hear each other: so many paths, or the paper's 10 m.
fn reach(paths: Option<u16>) -> Result<Reach, Diagnostic> {
    let Some(paths) = paths else { return Ok(Reach::PAPER) };
    Reach::of_paths(paths).ok_or_else(|| {
        let most = Reach::MOST_PATHS;
        let what = match paths {
            0 => "a range of 0 cells is below one path".to_owned(),
            1 => "within 1 cell no robot can drive while another one stays in range".to_owned(),
            paths => format!("a range of {paths} cells is more than the {most} that robots plan for"),
        };
        let remedy =
            format!("give `range` 2 to {most} cells, or leave it out for 10 m, which are 3.33 cells");
        Diagnostic::of_field("range", what, remedy)
    })
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

impl KitTeam {
    fn is_driven(&self) -> bool {
        self.course.driven().len() == self.due.len()
    }
}

impl Team for KitTeam {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        let knows_its_end = self.course.knows_its_end();
        if self.is_driven() && !knows_its_end {
            return Err(End::Explored);
        }
        if self.idle > PATIENCE * self.due.len() {
            return Err(End::Idle);
        }
        let Some(drive) = self.course.drive() else {
            return Err(if self.is_driven() { End::Explored } else { End::Exhausted });
        };
        self.drive = Some(drive);
        self.idle = if drive.is_new { 0 } else { self.idle + 1 };
        let mut steps = vec![Step::Stay; self.cells.len()];
        let across = Step::ALL.into_iter().find(|&step| drive.from.after(step) == drive.to);
        steps[drive.robot] = across.unwrap_or(Step::Stay);
        self.cells[drive.robot] = drive.to;
        Ok(Frame { kind: Kind::Advance, blocked: vec![false; steps.len()], steps, cells: self.cells.clone() })
    }

    /// The nodes within reach.
    fn due(&self, _: &Layout) -> u32 {
        nodes(&self.due, &self.cells).len() as u32
    }

    fn missed(&self, _: &Layout, chart: &Survey) -> Vec<Cell> {
        missed(&self.due, &self.cells, chart)
    }

    fn broken_in_move(&self, before: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let stances = self.course.stances();
        let driver = before.iter().zip(&frame.cells).position(|(before, after)| before != after);
        let others = || stances.iter().enumerate().filter(|&(robot, _)| Some(robot) != driver);
        let is_near = driver.is_some_and(|driver| others().any(|(_, other)| other.has(frame.cells[driver])));
        let is_cut = !is_connected(&stances, self.reach);
        let (are_two, are_more) = (before.len() == 2, before.len() > 2);
        broken([(is_cut && are_two, CONTACT), (is_near, APART), (is_cut && are_more, CONNECTED)])
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        let is_full = nodes(&self.due, &self.cells).len() == self.cells.len();
        match end {
            // Nobody can leave where every node is taken.
            End::Exhausted if is_full => Vec::new(),
            End::Exhausted if self.course.is_over() => vec![COVERS],
            End::Exhausted => vec![MOVES],
            End::Explored | End::Endless | End::Idle | End::Silent | End::Refused => Vec::new(),
        }
    }

    fn milliseconds(&self) -> Option<u64> {
        Some(self.course.clock())
    }

    fn layers(&self) -> Vec<Layer> {
        layers::layers(self.reach)
    }

    fn show(&self, _: &[Cell], scene: &mut Scene) {
        if let Some(drive) = self.drive {
            layers::show(&*self.course, drive, self.cells.len(), scene);
        }
    }
}

/// The nodes of these paths, and those where robots are.
fn nodes(paths: &[Edge], cells: &[Cell]) -> BTreeSet<Cell> {
    let ends = paths.iter().flat_map(|path| [path.cell(), path.cell().beyond(path.side())]);
    ends.chain(cells.iter().copied()).collect()
}

/// The nodes within reach that no robot has explored.
fn missed(paths: &[Edge], cells: &[Cell], chart: &Survey) -> Vec<Cell> {
    nodes(paths, cells).into_iter().filter(|&node| chart.step(node).is_none()).collect()
}

/// Whether robots hear each other at whatever speeds they drive, directly or over others.
fn is_connected(stances: &[Stance], reach: Reach) -> bool {
    let Some((&first, rest)) = stances.split_first() else { return true };
    unlinked(first, rest.to_vec(), |one, other| one.is_sure_of(other, reach)) == 0
}
