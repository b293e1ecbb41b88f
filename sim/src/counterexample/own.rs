//! Counterexamples to a rule of one's own: made again in one layout, stored as files that anyone can replay, and shrunk.

use std::path::Path;

use tautline_kernel::ground::Cell;
use tautline_proofs::run::Run;
use tautline_proofs::team::{self, Layouts};

use super::minimise::{Broken, Case, Shrunk, shrink};
use crate::aside::{Aside, Replaceable};
use crate::explore::hunt::layout as layout_of;
use crate::explore::{ClauseId, Limits, OnViolation, Own, Report, Stage, TeamMove, run};
use crate::fault::{Fault, Halt};
use crate::layout::Layout;
use crate::trace::Writer;

/// A rule of one's own, in the layout of a run that was found.
pub struct Found<'a, R: 'static, T: 'static, const ROBOTS: usize> {
    /// Where the rule was searched, and what is demanded of it.
    pub layouts: &'static Layouts<R, T, ROBOTS>,
    /// The rule, by its name.
    pub rule: (&'a str, &'a R),
    /// What was found.
    pub run: &'a Run,
}

const STOP: Limits = Limits { until: None, max_moves: None, violation: OnViolation::Stop };

impl<R, T: team::Team<ROBOTS>, const ROBOTS: usize> Found<'_, R, T, ROBOTS> {
    fn own(&self) -> Own<T, ROBOTS> {
        let (team, cells) = (self.layouts.start)(self.rule.1);
        Own::new(team, cells, self.layouts.demands)
    }

    fn clause(&self) -> Option<ClauseId> {
        self.run.breaks.map(ClauseId::new)
    }

    /// Makes the run again, in the layout that has the walls that it met and no others.
    fn play(
        &self,
        layout: &Layout,
        watch: &mut dyn FnMut(&TeamMove<'_>) -> Result<(), Halt>,
    ) -> Result<Report, Halt> {
        let violation = self.clause().map_or(OnViolation::Stop, OnViolation::StopAt);
        run(&mut self.own(), layout, Limits { violation, ..STOP }, watch)
    }

    /// Writes the run to a file at `path`, which `tautline replay` plays. The file has yet to be put in its place.
    ///
    /// # Errors
    /// [`Halt`] if the area is too large for a layout, or a robot starts in a blocked cell.
    pub fn store(&self, path: &Path, replaceable: &Replaceable) -> Result<(Aside, Report), Halt> {
        let (layout, starts) = layout_of(self.run).map_err(Fault::from)?;
        let stage = Stage::new(self.layouts.scheme, self.rule.0, &layout, &starts);
        let stage = Stage { limits: STOP, ..stage };
        let aside = Aside::new(path, replaceable)?;
        let mut writer = Writer::new(aside, &stage, self.clause()).map_err(Fault::from)?;
        let report = self.play(&layout, &mut |made| {
            writer.add(made);
            Ok(())
        })?;
        Ok((writer.end(&report), report))
    }

    /// The layout with the fewest walls that the run shrinks to: without any one of them the clause is not broken. The area
    /// stays as it is, and the robots start where they did, since the rule and its demands may know both.
    ///
    /// # Errors
    /// [`Halt`] if the area is too large for a layout.
    pub fn minimise(&self) -> Result<Shrunk, Halt> {
        let (layout, starts) = layout_of(self.run).map_err(Fault::from)?;
        let base = starts.first().copied().unwrap_or(Cell::new(0, 0));
        let size = layout.size();
        let case = Case { robots: ROBOTS as u16, layout, base };
        let steps = self.run.frames.len() as u32;
        shrink(case, steps, ROBOTS as u16, &mut |case, _| {
            if case.layout.size() != size {
                return Ok(None);
            }
            let report = self.play(&case.layout, &mut |_| Ok(()))?;
            let is_meant = |id: ClauseId| self.clause().is_none_or(|clause| clause == id);
            let broken = report.violations.iter().find(|broken| is_meant(broken.clause));
            Ok(broken.map(|broken| Broken { steps: broken.step, met: None }))
        })
    }
}
