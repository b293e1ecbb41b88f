//! Counterexamples to a rule of one's own: made again in one layout, and stored as files that anyone can replay.
//! Nothing in them can go: the search finds the fewest walls, and the area is what the rule and its demands may know.

use std::path::Path;

use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_proofs::run::{Ending, Run};
use tautline_proofs::team::{Rule, Setting, Strategy};

use crate::explore::hunt::layout as layout_of;
use crate::explore::{ClauseId, End, Limits, Own, Report, Setup, TeamMove, Violation, run};
use crate::trace::{Player, Writer, check_names};

/// A rule of one's own, in the layout of a run that was found.
pub struct OwnRun<'a, R: Rule> {
    /// The surroundings in which the rule was searched, and what is demanded of it.
    pub setting: &'a Setting<'a, R>,
    /// The rule, by its name.
    pub rule: (&'a str, &'a R),
    /// The run that was found.
    pub run: &'a Run,
}

impl<R: Rule> OwnRun<'_, R> {
    /// Makes the run again, in the layout that has the walls and blocked cells that it met and no others, and writes it
    /// to a file at `path`, which `tautline replay` plays. The file has yet to be put in its place.
    ///
    /// # Errors
    /// [`Halt`] if the area is too large for a layout, a robot starts in a blocked cell, or a name is none that a file
    /// can have: letters, digits and hyphens.
    pub fn store(&self, path: &Path, replaceable: &Replaceable) -> Result<(AtomicFile, Report), Halt> {
        let names =
            [("scheme", Some(self.setting.scheme)), ("rule", Some(self.rule.0)), ("clause", self.run.breaks)];
        check_names(names)
            .map_err(|(key, what)| Diagnostic::usage(what, format_args!("name the {key} otherwise")))?;
        let clause = self.run.breaks.map(ClauseId::new);
        let limits = Limits::stopping_at(clause);
        let (layout, starts) = layout_of(self.run)?;
        let setup = Setup { limits, ..Setup::named(self.setting.scheme, self.rule.0, layout, &starts) };
        let file = AtomicFile::new(path, replaceable)?;
        let mut writer = Writer::of_demand(file, &setup, clause, self.run.words.demand)?;
        let mut add = |made: &TeamMove<'_>| {
            writer.add(made);
            Ok(())
        };
        let is_alone = self.setting.strategy() == Strategy::Tree && self.run.ending != Ending::Endless;
        let report = if is_alone {
            let playing = self.setting.in_layout(self.rule.1, &starts, Vec::new());
            let mut team = Own::new(playing, 0);
            team.is_exploring = false;
            run(&mut team, &setup.layout, limits, &mut add)?
        } else {
            let Run { frames, ending, words, .. } = self.run;
            let last = clause.map(|clause| Violation { clause, step: frames.len() as u32 });
            let last: Vec<Violation> = last.into_iter().filter(|_| *ending == Ending::Move).collect();
            let mut player = Player {
                frames,
                titles: &words.titles,
                round: words.round,
                end: if *ending == Ending::Endless { End::Endless } else { End::Exhausted },
                broken: &last,
                broken_at_end: clause.into_iter().collect(),
                due: 0,
                cells: starts,
                made: 0,
            };
            run(&mut player, &setup.layout, limits, &mut add)?
        };
        Ok((writer.end(&report), report))
    }
}
