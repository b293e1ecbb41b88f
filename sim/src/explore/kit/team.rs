//! The team of KIT. A team move is one robot's drive, in the order in which they begin; whoever drives is drawn where
//! it arrives.
//!
//! As published no robot knows when everything is driven: whoever watches them ends the run then. A run in
//! which no new path is driven for twenty drives a path is over.

use std::collections::BTreeSet;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_kernel::kit::{Reach, Stance};
use tautline_proofs::kit::world::{Demand, Speeds};
use tautline_proofs::run::Frame;

use super::layers;
use crate::explore::clause::broken;
use crate::explore::{ClauseId, End, Layer, RuleId, Scene, Surroundings, Survey, Team, unlinked};
use crate::kit::{Course, Drive};
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

/// Drives a path without a new one after which a run is over.
const PATIENCE: usize = 20;

pub(super) struct KitTeam {
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

impl KitTeam {
    /// Robots on this course, in these cells, who have the paths of `due` within reach.
    pub(super) fn new(course: Box<dyn Course>, due: Vec<Edge>, cells: Vec<Cell>, reach: Reach) -> Self {
        Self { course, due, cells, idle: 0, reach, drive: None }
    }

    fn is_driven(&self) -> bool {
        self.course.driven().len() == self.due.len()
    }
}

impl Team for KitTeam {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        if self.is_driven() && !self.course.knows_its_end() {
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

/// The clause that a run of so many robots breaks with this demand, at these speeds.
pub(super) fn clause_of(demand: Demand, speeds: Speeds, robots: usize) -> ClauseId {
    let is_at_equal_speeds = speeds == Speeds::Equal && demand == Demand::Contact;
    if is_at_equal_speeds { EQUAL } else { ClauseId::new(demand.clause(robots)) }
}

/// The nodes of these paths, and those where robots are.
pub(super) fn nodes(paths: &[Edge], cells: &[Cell]) -> BTreeSet<Cell> {
    let ends = paths.iter().flat_map(|path| [path.cell(), path.cell().beyond(path.side())]);
    ends.chain(cells.iter().copied()).collect()
}

/// The nodes within reach that no robot has explored.
pub(super) fn missed(paths: &[Edge], cells: &[Cell], chart: &Survey) -> Vec<Cell> {
    nodes(paths, cells).into_iter().filter(|&node| chart.step(node).is_none()).collect()
}

/// Whether robots hear each other at whatever speeds they drive, directly or over others.
fn is_connected(stances: &[Stance], reach: Reach) -> bool {
    let Some((&first, rest)) = stances.split_first() else { return true };
    unlinked(first, rest.to_vec(), |one, other| one.is_sure_of(other, reach)) == 0
}

/// How far robots hear each other: so many paths, or the paper's 10 m.
pub(super) fn reach(paths: Option<u16>) -> Result<Reach, Diagnostic> {
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
