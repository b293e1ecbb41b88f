//! The teams of frontier cells: the kernel's robots, and rivals that assign cells.

use std::collections::BTreeSet;

use tautline_kernel::ground::Cell;
use tautline_proofs::run::Frame;

use super::layers;
use crate::explore::clause::broken;
use crate::explore::{ClauseId, End, Layer, Scene, Setup, Surroundings, Survey, Team, has_double};
use crate::frontier::{AssignedTeam, Explorers, TeamEnd};
use crate::objects::ObjectReport;
use tautline_grids::layout::Layout;

/// The run ends, and a cell in reach is unexplored.
pub const COVERS: ClauseId = ClauseId::new("FRONTIER-1");

/// Two robots are in one cell.
pub const ALONE: ClauseId = ClauseId::new("FRONTIER-2");

/// The run goes on for ever.
pub const ENDS: ClauseId = ClauseId::new("FRONTIER-3");

/// The run ends, and a robot does not know it.
pub const KNOWS: ClauseId = ClauseId::new("FRONTIER-4");

/// A robot notes of a cell what is not so.
pub const MARKS: ClauseId = ClauseId::new("FRONTIER-5");

/// A robot enters as its frontier cell what a robot has entered before.
pub const ONCE: ClauseId = ClauseId::new("FRONTIER-13");

/// Who explores.
pub(super) enum Who {
    Robots(Box<Explorers>),
    Assigned(Box<AssignedTeam>),
}

struct FrontierTeam {
    who: Who,
    /// Cells in reach of a start.
    due: Vec<Cell>,
    /// Those of them that no robot was in.
    left: BTreeSet<Cell>,
    /// How it has ended.
    ended: Option<TeamEnd>,
}

pub(super) fn team(setup: &Setup, who: Who) -> Box<dyn Team> {
    let starts = setup.starts();
    let due = setup.layout.reachable(&starts);
    let left = due.iter().copied().filter(|cell| !starts.contains(cell)).collect();
    Box::new(FrontierTeam { who, due, left, ended: None })
}

impl FrontierTeam {
    /// Those that decide for themselves: robots to which cells are assigned have one map.
    fn robots(&self) -> Option<&Explorers> {
        match &self.who {
            Who::Robots(robots) => Some(robots),
            Who::Assigned(_) => None,
        }
    }
}

impl Team for FrontierTeam {
    fn cells(&self) -> &[Cell] {
        match &self.who {
            Who::Robots(robots) => robots.cells(),
            Who::Assigned(robots) => robots.cells(),
        }
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        let made = match &mut self.who {
            Who::Robots(robots) => robots.advance(),
            Who::Assigned(robots) => robots.advance(),
        };
        for cell in made.iter().flat_map(|frame| &frame.cells) {
            self.left.remove(cell);
        }
        made.map_err(|ended| {
            self.ended = Some(ended);
            match ended {
                TeamEnd::Known if self.left.is_empty() => End::Explored,
                TeamEnd::Known | TeamEnd::Still => End::Exhausted,
                TeamEnd::Endless => End::Endless,
                TeamEnd::Idle => End::Idle,
            }
        })
    }

    fn due(&self, _: &Layout) -> u32 {
        self.due.len() as u32
    }

    fn missed(&self, _: &Layout, chart: &Survey) -> Vec<Cell> {
        chart.unexplored(self.due.iter().copied())
    }

    fn broken_in_move(&self, _: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let is_double = has_double(&frame.cells);
        let has = |broken: fn(&Explorers) -> bool| self.robots().is_some_and(broken);
        let (is_wrong, is_again) = (has(Explorers::has_false_note), has(Explorers::has_entered_again));
        broken([(is_double, ALONE), (is_wrong, MARKS), (is_again, ONCE)])
    }

    fn broken_at_end(&self, layout: &Layout, chart: &Survey, end: End) -> Vec<ClauseId> {
        let is_endless = end == End::Endless;
        let is_short = !is_endless && end != End::Idle && !self.missed(layout, chart).is_empty();
        let knows_not = self.ended == Some(TeamEnd::Still);
        broken([(is_short, COVERS), (is_endless, ENDS), (knows_not, KNOWS)])
    }

    fn objects(&self) -> Vec<ObjectReport> {
        let objects = self.robots().map_or(&[][..], Explorers::objects);
        objects.iter().map(|(at, known)| ObjectReport::new(*at, known.as_ref())).collect()
    }

    fn layers(&self) -> Vec<Layer> {
        match &self.who {
            Who::Robots(robots) => layers::layers(robots),
            Who::Assigned(_) => layers::layers_of_assigned(),
        }
    }

    fn show(&self, _: &[Cell], scene: &mut Scene) {
        match &self.who {
            Who::Robots(robots) => layers::show(robots, scene),
            Who::Assigned(robots) => layers::show_assigned(robots, scene),
        }
    }
}
