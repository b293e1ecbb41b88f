//! Counterexamples to a rule of one's own: made again in one layout, and stored as files that anyone can replay.
//! Nothing in them can go: the search finds the fewest walls, and the area is what the rule and its demands may know.

use std::path::Path;

use tautline_proofs::run::Run;
use tautline_proofs::team::{self, Layouts};

use crate::atomic_file::{AtomicFile, Replaceable};
use crate::diagnostic::{Diagnostic, Halt};
use crate::explore::hunt::layout as layout_of;
use crate::explore::{ClauseId, Limits, Own, Report, Setup, run};
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

impl<R, T: team::Team<ROBOTS>, const ROBOTS: usize> Found<'_, R, T, ROBOTS> {
    /// Makes the run again, in the layout that has the walls that it met and no others, and writes it to a file at
    /// `path`, which `tautline replay` plays. The file has yet to be put in its place.
    ///
    /// # Errors
    /// [`Halt`] if the area is too large for a layout, or a robot starts in a blocked cell.
    pub fn store(&self, path: &Path, replaceable: &Replaceable) -> Result<(AtomicFile, Report), Halt> {
        let clause = self.run.breaks.map(ClauseId::new);
        let limits = Limits::stopping_at(clause);
        let (layout, starts) = layout_of(self.run).map_err(Diagnostic::from)?;
        let setup = Setup { limits, ..Setup::named(self.layouts.scheme, self.rule.0, layout, &starts) };
        let aside = AtomicFile::new(path, replaceable)?;
        let mut writer = Writer::new(aside, &setup, clause).map_err(Diagnostic::from)?;
        let (team, cells) = (self.layouts.start)(self.rule.1);
        let report =
            run(&mut Own::new(team, cells, self.layouts.demands), &setup.layout, limits, &mut |made| {
                writer.add(made);
                Ok(())
            })?;
        Ok((writer.end(&report), report))
    }
}
