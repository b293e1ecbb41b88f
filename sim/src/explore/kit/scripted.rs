//! A run that a search has found: the search's world makes it again by its choices. A team move is a robot's decision,
//! and the arrivals after it; whoever drives is drawn where it arrives. The first choice says whether robots drive at
//! equal speeds.

use std::collections::BTreeSet;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, TinyGrid};
use tautline_kernel::kit::{Next, Rule as Kit, Sight};
use tautline_proofs::engine::world::World as _;
use tautline_proofs::judge::Case;
use tautline_proofs::kit::counterexample::{self, ANY_SPEEDS, EQUAL_SPEEDS};
use tautline_proofs::kit::world::{Demand, Event, Setting, Speeds, Starts, Successor};
use tautline_proofs::run::Frame;

use super::team::{COVERS, ENDS, MOVES, WHOLE, clause_of, missed, nodes};
use crate::explore::script::Script;
use crate::explore::setup::of_choices;
use crate::explore::{ClauseId, End, Setup, Surroundings, Survey, Team};
use crate::frontier::Moves;
use crate::kit::paths;
use tautline_grids::layout::Layout;

/// The world of `setup`, and its choices.
fn script<const ROBOTS: usize>(setup: &Setup, rule: Kit) -> Result<Script<Setting<ROBOTS>>, Diagnostic> {
    let layout = &setup.layout;
    let setting = Setting::<ROBOTS>::new(rule, (layout.width(), layout.height()));
    let blank = TinyGrid::new(layout.size().area());
    let cells = <[Cell; ROBOTS]>::try_from(setup.starts());
    let (Some(setting), Some(mut given), Ok(cells)) = (setting, blank, cells) else {
        return Err(of_choices("the layout is too large for choices"));
    };
    for edge in setting.area.edges().filter(|&edge| !layout.is_open(edge)) {
        given.put_edge(EdgeMark::Wall, edge);
    }
    let (speeds, choices) = match setup.choices.split_first() {
        Some((&ANY_SPEEDS, choices)) => (Speeds::Any, choices),
        Some((&EQUAL_SPEEDS, choices)) => (Speeds::Equal, choices),
        Some(_) | None => return Err(of_choices("the choices do not say how fast robots drive")),
    };
    let setting = Setting { given: Some(given), speeds, ..setting };
    let world = setting.start(cells).ok_or_else(|| of_choices("the robots cannot start so"))?;
    Ok(Script::new(setting, world, choices))
}

/// The team of `setup`, which has choices and so many robots.
pub(super) fn start<const ROBOTS: usize>(setup: &Setup, rule: Kit) -> Result<Box<dyn Team>, Diagnostic> {
    let due = paths(&setup.layout, setup.base);
    Ok(Box::new(ScriptedTeam { script: script::<ROBOTS>(setup, rule)?, cells: setup.starts(), due }))
}

struct ScriptedTeam<const ROBOTS: usize> {
    script: Script<Setting<ROBOTS>>,
    cells: Vec<Cell>,
    /// The paths within reach.
    due: Vec<Edge>,
}

impl<const ROBOTS: usize> Team for ScriptedTeam<ROBOTS> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        self.script.broken.clear();
        let decides = |turned: &Successor<ROBOTS>| matches!(turned.events.first(), Some(Event::Decides(..)));
        let decision = self.script.choose(decides).and_then(|turned| turned.events.into_iter().next());
        let Some(Event::Decides(robot, looks, next)) = decision else {
            return Err(if self.script.goes_round() { End::Endless } else { End::Exhausted });
        };
        let arrives = |turned: &Successor<ROBOTS>| matches!(turned.events.first(), Some(Event::Arrives(..)));
        while self.script.choose(arrives).is_some() {}
        let mut moves = Moves::none(ROBOTS);
        match (next, looks.last()) {
            (Next::Drives(to), Some(&(side, _))) => {
                moves.goes(robot, side);
                self.cells[robot] = to;
            }
            (_, Some(&(side, Sight::Obstacle))) => moves.bumps(robot, side),
            (_, Some((_, Sight::Free | Sight::Robot)) | None) => {}
        }
        Ok(moves.frame(&self.cells))
    }

    fn due(&self, _: &Layout) -> u32 {
        nodes(&self.due, &self.cells).len() as u32
    }

    fn missed(&self, _: &Layout, chart: &Survey) -> Vec<Cell> {
        missed(&self.due, &self.cells, chart)
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let speeds = self.script.system.speeds;
        let broken = self.script.broken.iter().map(|&demand| clause_of(demand, speeds, ROBOTS));
        broken.collect::<BTreeSet<ClauseId>>().into_iter().collect()
    }

    fn case(&mut self, layout: &Layout, clause: ClauseId) -> Option<Box<dyn Case>> {
        let start = self.script.state;
        let steps: Vec<Successor<ROBOTS>> = self.script.rest();
        let round = if clause == ENDS { self.script.round()?.len() } else { 0 };
        let walls: Vec<Edge> = layout.walls().collect();
        Some(counterexample::case(clause.as_str(), (&self.script.system, &walls), &start, steps, round)?)
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        if end == End::Endless {
            return vec![ENDS];
        }
        if !self.script.is_over() {
            return Vec::new();
        }
        let ends = [
            (Demand::Moves, Starts::Anywhere, MOVES),
            (Demand::Covers, Starts::Anywhere, COVERS),
            (Demand::Whole, Starts::SideBySide, WHOLE),
        ];
        let is_broken = |&(demand, starts, _): &(Demand, Starts, ClauseId)| {
            let asked = Setting { demand: Some(demand), starts, ..self.script.system };
            asked.broken_at_end(&self.script.state, &[]).contains(&demand)
        };
        ends.iter().filter(|end| is_broken(end)).map(|&(.., clause)| clause).collect()
    }
}
