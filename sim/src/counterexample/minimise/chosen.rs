//! The smallest run of those that a search makes by its choices: what happens in which order is open again, and every
//! smaller team and layout is searched, the smallest first.

use std::ops::ControlFlow;

use tautline_io::diagnostic::{Diagnostic, Halt};

use super::minimal::{Failure, Minimal, Refusal, first_violation};
use super::shrink::{Extent, Progress};
use crate::explore::hunt::{Bound, Exhibit, Far, Finding, HuntBounds, HuntRequest, Hunter};
use crate::explore::{ClauseId, Setup, explore};
use tautline_grids::layout::Size;

/// Passes on how far the work is.
struct Watcher<'a> {
    watch: &'a mut dyn FnMut(Progress) -> Result<(), Halt>,
    progress: Progress,
    ended: Option<Halt>,
}

impl Hunter for Watcher<'_> {
    fn hears(&mut self, _: Far<'_>) -> ControlFlow<()> {
        match (self.watch)(self.progress) {
            Ok(()) => ControlFlow::Continue(()),
            Err(halt) => {
                self.ended = Some(halt);
                ControlFlow::Break(())
            }
        }
    }

    fn is_left_out(&mut self, _: &Diagnostic) {}
}

/// As of [`minimise`](super::minimise), of a run that has choices.
pub(super) fn minimise(
    setup: &Setup,
    asked: Option<ClauseId>,
    watch: &mut dyn FnMut(Progress) -> Result<(), Halt>,
) -> Result<Minimal, Failure> {
    let extent = |setup: &Setup, steps| Extent::new(setup.robots, &setup.layout, 0, steps);
    let report = explore(setup, &mut |_| Ok(()))?;
    let violation = first_violation(&report, asked)?;
    let before = extent(setup, violation.step);
    let hunt = setup.scheme.find_rule(setup.rule).map_err(Halt::from)?.hunt.ok_or(Refusal::Chosen)?;
    let max_walls = hunt.takes().contains(&Bound::Walls).then_some((before.walls + before.blocked) as u32);
    let mut watcher = Watcher { watch, progress: Progress { runs: 0, smallest: before }, ended: None };
    let mut refused = None;
    let least = *setup.scheme.robots.start() as u16;
    for robots in least..=setup.robots {
        for (columns, rows) in setup.layout.size().areas() {
            let size = Some(Size::new(columns as u64, rows as u64).map_err(Halt::from)?);
            let bounds = HuntBounds { robots: Some(robots.into()), size, max_walls, ..HuntBounds::default() };
            let bounds = hunt.again(setup, bounds);
            let asked = HuntRequest { bounds, ..HuntRequest::new(setup.scheme, setup.rule) };
            let hunted = match hunt.hunt(&asked, &mut watcher) {
                Ok(hunted) => hunted,
                // A size without room for the robots is none to search.
                Err(diagnostic) => {
                    refused = Some(diagnostic);
                    continue;
                }
            };
            if let Some(halt) = watcher.ended {
                return Err(halt.into());
            }
            watcher.progress.runs += 1;
            let is_wanted = |found: &Finding| match found.shown {
                Exhibit::Run(clause) | Exhibit::Story(clause, _) => clause == violation.clause,
                Exhibit::Endless | Exhibit::Told(_) => false,
            };
            let Some(found) = hunted.found.into_iter().find(is_wanted) else { continue };
            let report = explore(&found.setup, &mut |_| Ok(()))?;
            let after = extent(&found.setup, report.steps);
            let runs = watcher.progress.runs;
            return Ok(Minimal { setup: found.setup, clause: violation.clause, before, after, runs });
        }
    }
    match refused {
        Some(diagnostic) if watcher.progress.runs == 0 => Err(Halt::from(diagnostic).into()),
        _ => Err(Refusal::Chosen.into()),
    }
}
