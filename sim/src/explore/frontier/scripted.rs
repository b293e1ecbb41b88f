//! A run that a search has found: the search's world makes it again by its choices. A team move is a robot's look:
//! whoever enters a cell is drawn there, and what happens until the next look belongs to it. The first two choices say
//! how many messages are lost and how many fixes are wrong at most, since the others are counted among what may happen
//! then.

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::frontier::{Map, Rule as Frontier, Sight, Status, TinyMap};
use tautline_kernel::ground::Cell;
use tautline_proofs::engine::world::World as _;
use tautline_proofs::frontier::areas;
use tautline_proofs::frontier::world::{Demand, Event, Setting, Successor};
use tautline_proofs::judge::Case;
use tautline_proofs::run::Frame;

use super::team::{COVERS, ENDS, KNOWS};
use crate::explore::clause::broken;
use crate::explore::script::Script;
use crate::explore::setup::of_choices;
use crate::explore::{ClauseId, End, Setup, Surroundings, Survey, Team};
use crate::frontier::Moves;
use tautline_grids::layout::Layout;

/// The world of `setup`, and its choices.
fn script<const ROBOTS: usize>(setup: &Setup, rule: Frontier) -> Result<Script<Setting<ROBOTS>>, Diagnostic> {
    let layout = &setup.layout;
    let too_large = || of_choices("the layout is too large for choices");
    let setting = areas::setting::<ROBOTS>(rule, (layout.width(), layout.height()));
    let blank = TinyMap::new(layout.size().area());
    let cells = <[Cell; ROBOTS]>::try_from(setup.starts());
    let (Some(setting), Some(mut given), Ok(cells)) = (setting, blank, cells) else {
        return Err(too_large());
    };
    layout.cells().filter(|&cell| !layout.is_free(cell)).for_each(|cell| given.learn(cell, Status::Obstacle));
    let Some((&[max_losses, max_wrong], choices)) = setup.choices.split_first_chunk() else {
        return Err(of_choices("the choices do not say how much may go wrong"));
    };
    let (max_losses, max_wrong) = (max_losses as u8, max_wrong as u8);
    let setting = Setting { given: Some(given), max_losses, max_wrong, ..setting };
    let world = setting.start(cells).ok_or_else(too_large)?;
    Ok(Script::new(setting, world, choices))
}

/// The team of `setup`, which has choices and so many robots.
pub(super) fn start<const ROBOTS: usize>(setup: &Setup, rule: Frontier) -> Result<Box<dyn Team>, Diagnostic> {
    let (starts, script) = (setup.starts(), script::<ROBOTS>(setup, rule)?);
    let due = setup.layout.reachable(&starts);
    Ok(Box::new(ScriptedTeam { script, cells: starts, due }))
}

struct ScriptedTeam<const ROBOTS: usize> {
    script: Script<Setting<ROBOTS>>,
    cells: Vec<Cell>,
    due: Vec<Cell>,
}

impl<const ROBOTS: usize> ScriptedTeam<ROBOTS> {
    /// Makes the choices up to the next look.
    fn go_on(&mut self) {
        while self.script.choose(|turned| !is_look(turned)).is_some() {}
    }
}

fn is_look<const ROBOTS: usize>(turned: &Successor<ROBOTS>) -> bool {
    matches!(turned.event, Event::Looks(..))
}

impl<const ROBOTS: usize> Team for ScriptedTeam<ROBOTS> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        self.script.broken.clear();
        self.go_on();
        let look = self.script.choose(is_look).map(|turned| turned.event);
        let Some(Event::Looks(robot, side, sight, ..)) = look else {
            return Err(if self.script.goes_round() { End::Endless } else { End::Exhausted });
        };
        self.go_on();
        let mut moves = Moves::none(ROBOTS);
        match sight {
            Sight::Open => moves.goes(robot, side),
            Sight::Obstacle => moves.bumps(robot, side),
            Sight::Robot | Sight::Silent | Sight::Small => {}
        }
        self.cells = self.script.state.cells().to_vec();
        Ok(moves.frame(&self.cells))
    }

    fn due(&self, _: &Layout) -> u32 {
        self.due.len() as u32
    }

    fn missed(&self, _: &Layout, chart: &Survey) -> Vec<Cell> {
        chart.unexplored(self.due.iter().copied())
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let broken = Demand::ALL.into_iter().filter(|demand| self.script.broken.contains(demand));
        broken.map(|demand| ClauseId::new(demand.clause())).collect()
    }

    fn case(&mut self, layout: &Layout, clause: ClauseId) -> Option<Box<dyn Case>> {
        let events: Vec<Event> = self.script.rest().into_iter().map(|turned| turned.event).collect();
        let round = if clause == ENDS { self.script.round()?.len() } else { 0 };
        let Setting { rule, area, max_wrong, .. } = self.script.system;
        let barred = layout.cells().filter(|&cell| !layout.is_free(cell)).collect();
        let floor = (rule, area, barred);
        Some(areas::case(clause.as_str(), floor, &self.cells, &events, round, max_wrong > 0)?)
    }

    fn broken_at_end(&self, layout: &Layout, chart: &Survey, end: End) -> Vec<ClauseId> {
        if end == End::Endless {
            return vec![ENDS];
        }
        let is_still = self.script.is_over();
        let is_short = is_still && !self.missed(layout, chart).is_empty();
        let knows = Setting { demand: Some(Demand::Knows), ..self.script.system };
        let knows_not = is_still && knows.broken_at_end(&self.script.state, &[]).contains(&Demand::Knows);
        broken([(is_short, COVERS), (knows_not, KNOWS)])
    }
}
