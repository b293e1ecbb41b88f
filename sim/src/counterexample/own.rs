//! Counterexamples to a rule of one's own: made again in one layout, and stored as files that anyone can replay.
//! Nothing in them can go: the search finds the fewest walls, and the area is what the rule and its demands may know.

use std::path::Path;

use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::run::{Ending, Frame, Run};
use tautline_proofs::team::{Rule, Setting, Strategy};

use crate::atomic_file::{AtomicFile, Replaceable};
use crate::diagnostic::{Diagnostic, Halt};
use crate::explore::hunt::layout as layout_of;
use crate::explore::{ClauseId, End, Limits, Own, Report, Setup, Survey, Team, TeamMove, run};
use crate::layout::Layout;
use crate::trace::Writer;

/// A rule of one's own, in the layout of a run that was found.
pub struct Found<'a, R: Rule> {
    /// The surroundings in which the rule was searched, and what is demanded of it.
    pub setting: &'a Setting<'a, R>,
    /// The rule, by its name.
    pub rule: (&'a str, &'a R),
    /// What was found.
    pub run: &'a Run,
}

impl<R: Rule> Found<'_, R> {
    /// Makes the run again, in the layout that has the walls and blocked cells that it met and no others, and writes it
    /// to a file at `path`, which `tautline replay` plays. The file has yet to be put in its place.
    ///
    /// # Errors
    /// [`Halt`] if the area is too large for a layout, or a robot starts in a blocked cell.
    pub fn store(&self, path: &Path, replaceable: &Replaceable) -> Result<(AtomicFile, Report), Halt> {
        let clause = self.run.breaks.map(ClauseId::new);
        let limits = Limits::stopping_at(clause);
        let (layout, starts) = layout_of(self.run).map_err(Diagnostic::from)?;
        let setup = Setup { limits, ..Setup::named(self.setting.scheme, self.rule.0, layout, &starts) };
        let aside = AtomicFile::new(path, replaceable)?;
        let mut writer = Writer::new(aside, &setup, clause).map_err(Diagnostic::from)?;
        let mut add = |made: &TeamMove<'_>| {
            writer.add(made);
            Ok(())
        };
        let is_alone = self.setting.strategy() == Strategy::Tree && self.run.ending != Ending::Endless;
        let report = if is_alone {
            let playing = self.setting.in_layout(self.rule.1, &starts, Vec::new());
            run(&mut Own::new(playing, 0), &setup.layout, limits, &mut add)?
        } else {
            run(&mut Told::new(self.run, starts), &setup.layout, limits, &mut add)?
        };
        Ok((writer.end(&report), report))
    }
}

/// A team that does what a search has found, in whatever order its robots acted.
struct Told<'a> {
    found: &'a Run,
    cells: Vec<Cell>,
    made: usize,
}

impl<'a> Told<'a> {
    const fn new(found: &'a Run, cells: Vec<Cell>) -> Self {
        Self { found, cells, made: 0 }
    }

    fn broken(&self) -> Vec<ClauseId> {
        self.found.breaks.map(ClauseId::new).into_iter().collect()
    }
}

impl Team for Told<'_> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        let end = if self.found.ending == Ending::Endless { End::Endless } else { End::Exhausted };
        let frame = self.found.frames.get(self.made).ok_or(end)?;
        self.made += 1;
        self.cells.clone_from(&frame.cells);
        Ok(frame.clone())
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let is_last = self.made == self.found.frames.len();
        if is_last && self.found.ending == Ending::Move { self.broken() } else { Vec::new() }
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, _: End) -> Vec<ClauseId> {
        self.broken()
    }
}
