//! The check that no run breaks an invariant, in any layout of any small area, from any base, of any small team. Its
//! counterexample is the smallest.

use tautline_kernel::ground::{Area, Cell};

use super::areas::{Smallest, smallest_run};
use super::bounds::{Bounds, Counterexample};
use super::invariant::Invariant;
use super::search::replay;
use super::subject::Subject;
use crate::decide::{
    self, Answer, Context, DrawnCertificate, Evidence, Method, MethodError, MethodResult, RefutationPlay,
    Verdict,
};
use crate::engine::smallest::{Certificate, Class, Most};
use crate::engine::tree::{Watch, unwatched};
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::run::walls;

/// A check of one invariant, its bound, and the part of that in which a reading that
/// no rule expresses is refuted or left open.
pub(super) struct EveryArea(pub(super) Invariant, pub(super) Most, pub(super) Most);

/// The numbers before the answers of the world: columns, rows, the place of the base, robots and walls.
const FIRST: usize = 5;

impl EveryArea {
    fn look(
        &self,
        observed: &Subject,
        watch: Watch<'_>,
    ) -> Result<Certificate<Class, Smallest>, MethodError> {
        let most = if observed.has_readings() { &self.2 } else { &self.1 };
        let mut made = smallest_run(*observed, self.0, most, watch).map_err(MethodError::new)?;
        made.is_whole &= !observed.has_readings();
        Ok(made)
    }

    /// The evidence that `smallest` gives, whose choices say where, too.
    fn evidence(Smallest { bounds, found }: &Smallest) -> Evidence {
        let (area, base) = (bounds.area, bounds.base);
        let place = area.locate(base).map_or(0, |(column, row)| row * area.width() + column);
        let first = [area.width(), area.height(), place, bounds.robots].map(|number| number as u32);
        let mut evidence = bounds.evidence(found);
        evidence.choices.once = [&first[..], &[bounds.max_walls], &found.answers].concat();
        evidence
    }

    /// From how many each choice was made, the bounds, and the run.
    fn found(
        &self,
        observed: &Subject,
        choices: &Choices,
    ) -> Result<(Vec<u32>, Bounds, Counterexample), ScriptError> {
        let Self(invariant, Most { cells, barriers, robots }, _) = self;
        let mut script = Script::new(choices);
        let most = *cells as usize;
        let of = [most + 1, most + 1, most, robots.end() + 1, *barriers as usize + 1];
        let mut chosen = [0; FIRST];
        for (chosen, of) in chosen.iter_mut().zip(of) {
            *chosen = script.choose(of)?;
        }
        let [columns, rows, place, robots, max_walls] = chosen;
        let last = Cell::new(columns as i16 - 1, rows as i16 - 1);
        let area = Area::new(Cell::new(0, 0), last).ok_or(ScriptError::Unbroken)?;
        let base = area.cells().nth(place).ok_or(ScriptError::Unbroken)?;
        let bounds = Bounds { area, base, ..Bounds::new(*observed, robots, max_walls as u32) };
        let bounds = Bounds { invariants: vec![*invariant], ..bounds };
        let rest = Choices { once: choices.once[FIRST..].to_vec(), again: choices.again.clone() };
        let run = replay(&bounds, *invariant, &rest).map_err(|error| match error {
            ScriptError::None { at, of } => ScriptError::None { at: FIRST + at, of },
            ScriptError::Over { at } => ScriptError::Over { at: FIRST + at },
            ScriptError::Unbroken | ScriptError::NoRound => error,
        })?;
        let of = of.iter().map(|&of| of as u32).chain(run.answers.iter().map(|_| 2));
        Ok((of.collect(), bounds, run))
    }
}

impl Method<Subject> for EveryArea {
    fn engine(&self) -> &'static str {
        "search"
    }

    fn bound(&self) -> String {
        let Most { cells, barriers, robots } = &self.1;
        let (fewest, most) = (robots.start(), robots.end());
        let areas = format!("all layouts of all areas of up to {cells} cells, every base");
        format!("{areas}, N = {fewest} to {most}, at most {barriers} walls")
    }

    fn decide(&self, observed: &Subject, _: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let made = self.look(observed, context.watch)?;
        let evidence = made.smallest.as_ref().map(|smallest| Self::evidence(&smallest.found));
        let cases = made.exhausted.iter().map(|(_, cases)| cases).sum();
        Ok(Answer::new(evidence, made.is_whole, Verdict::Holds, cases))
    }

    fn replay(&self, observed: &Subject, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let (of, bounds, found) = self.found(observed, choices)?;
        Ok(RefutationPlay { of, evidence: Self::evidence(&Smallest { bounds, found }) })
    }

    fn size(&self, observed: &Subject, choices: &Choices) -> Option<decide::Size> {
        let (_, Bounds { area, robots, .. }, run) = self.found(observed, choices).ok()?;
        let class = Class { area, barriers: walls(&run.frames).len() as u32, robots };
        Some((class.to_string(), run.frames.len()))
    }

    fn smallest(&self, observed: &Subject) -> Result<Option<DrawnCertificate>, MethodError> {
        Ok(Some(self.look(observed, &mut unwatched)?.drawn_by_cells(|run| run.to_string())))
    }
}
