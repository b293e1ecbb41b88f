//! A check that a protocol keeps a demand within its bound. Each of the surroundings is searched by itself, since no
//! state of one is a state of another: so a check can be divided, and counts are the same however it is.

use std::num::NonZeroUsize;

use tautline_kernel::choice::Oracle;

use super::any_protocol::StateBytes;
use super::playing::ErasedProtocol;
use super::{Bound, Protocol};
use crate::decide::{
    Answer, Context, Evidence, Method, MethodError, MethodResult, Portion, RandomRuns, RefutationPlay,
    Systems, Verdict,
};
use crate::engine::model::StatesModel;
use crate::engine::states::{self, AnySystem, Findings, Limits};
use crate::engine::{Choices, Replay, Script, ScriptError, Stop, Until, sample, threads};

/// A check that the demand with this number is kept, in these surroundings.
pub struct Keeps<P: Protocol>(
    /// The bound.
    pub P::Bound,
    /// The number of the demand.
    pub usize,
);

/// A run that breaks the demand, its start by its number among all.
type Run = states::Run<&'static str>;

impl<P: Protocol> Keeps<P> {
    /// The protocol in each of its surroundings. With `tries_all`, and in debug builds, each state that is met is tried
    /// whether it comes back from its bytes; else starts are, and the first state to which each leads.
    fn playing(&self, rule: &P, tries_all: bool) -> Result<Vec<ErasedProtocol>, MethodError> {
        let none = || {
            let of = P::DEMANDS.len();
            MethodError::new(format_args!("there is no demand {}: the rule has {of}", self.1))
        };
        let demand = P::DEMANDS.get(self.1).ok_or_else(none)?;
        let how = (demand, tries_all || cfg!(debug_assertions));
        let each = self.0.each()?.into_iter();
        Ok(each.map(|here| ErasedProtocol::new(rule.clone(), here, how)).collect())
    }

    /// The states, and a run that breaks the demand if there is one: a shortest one, if [`Findings::is_shortest`].
    ///
    /// # Errors
    /// [`MethodError`] if there is no such demand, if there are no such surroundings, if the moves are not a function
    /// of their state, the states not of their bytes, or states that are taken for one not alike.
    pub fn search(&self, rule: &P, limits: Limits<'_>) -> Result<Findings<&'static str>, MethodError> {
        searched(&self.playing(rule, false)?, Portion::WHOLE, Until::Exhausted, limits)
    }
}

impl<P: Protocol> Method<P> for Keeps<P> {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        self.0.to_string()
    }

    fn decide(&self, rule: &P, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        self.decide_portion(rule, Portion::WHOLE, until, context)
    }

    /// The surroundings, one by one. A move that must occur may occur in any of them: such a check is not divided.
    fn portions(&self) -> usize {
        if P::COVERS.is_empty() { self.0.each().map_or(1, |each| each.len()) } else { 1 }
    }

    /// The choices are the number of the start, and those of the moves. A check over no start is open.
    fn decide_portion(
        &self,
        rule: &P,
        portion: Portion,
        until: Until,
        context: &mut Context<'_, '_>,
    ) -> MethodResult {
        let limits = Limits { memory: context.memory, ..Limits::NONE };
        answered((&self.playing(rule, false)?, P::COVERS), portion, (until, limits), self.shows())
    }

    fn systems(&self, rule: &P) -> Result<Systems, MethodError> {
        systems(self.playing(rule, true)?)
    }

    fn replay(&self, rule: &P, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        replayed(&self.playing(rule, false).map_err(|_| ScriptError::Unbroken)?, choices)
    }

    /// A hunt over no start is open.
    fn hunt(&self, rule: &P, runs: &RandomRuns) -> Result<Option<Answer>, MethodError> {
        hunted(&self.playing(rule, true)?, runs).map(Some)
    }

    fn shorten(
        &self,
        rule: &P,
        choices: &Choices,
        limits: Limits<'_>,
    ) -> Result<Option<(Choices, bool)>, MethodError> {
        shortened(&self.playing(rule, false)?, choices, limits)
    }
}

/// Every start, each in its surroundings.
fn starts(all: &[ErasedProtocol]) -> impl Iterator<Item = (&ErasedProtocol, StateBytes)> {
    all.iter().flat_map(|playing| playing.starts().map(move |start| (playing, start)))
}

/// From how many each of these choices is made, and the run that they make.
fn play(all: &[ErasedProtocol], choices: &Choices) -> Result<(Vec<u32>, Run), ScriptError> {
    let mut script = Script::new(choices);
    let number = script.choose(starts(all).count())?;
    let (playing, start) = starts(all).nth(number).ok_or(ScriptError::Unbroken)?;
    script.play(playing, (number, start), |_| true)
}

/// The answer of a search to a check that is to show `shown` and meet each of `covers`.
fn answered(
    (all, covers): (&[ErasedProtocol], &[&'static str]),
    portion: Portion,
    (until, limits): (Until, Limits<'_>),
    shown: Verdict,
) -> MethodResult {
    let found = searched(all, portion, until, limits)?;
    let evidence = found.broken.first().and_then(|run| evidence(all, run));
    Ok(Answer::of_states(evidence, &found, covers.iter().copied(), shown))
}

fn replayed(all: &[ErasedProtocol], choices: &Choices) -> Result<RefutationPlay, ScriptError> {
    let (of, run) = play(all, choices)?;
    Ok(RefutationPlay { of, evidence: evidence(all, &run).ok_or(ScriptError::Unbroken)? })
}

/// Those that have a start, each with its starts; all of them, if none has one.
fn systems(mut all: Vec<ErasedProtocol>) -> Result<Systems, MethodError> {
    is_sound(&all)?;
    all.iter().try_for_each(ErasedProtocol::starts_come_back)?;
    let has_start = |playing: &ErasedProtocol| playing.starts().next().is_some();
    if all.iter().any(has_start) {
        all.retain(has_start);
    }
    let of = |playing| -> Box<dyn AnySystem> {
        Box::new(StatesModel::new(playing, |playing: &ErasedProtocol| playing.starts().collect()))
    };
    Ok(all.into_iter().map(of).collect())
}

/// The findings of random runs.
fn hunted(all: &[ErasedProtocol], runs: &RandomRuns) -> Result<Answer, MethodError> {
    is_sound(all)?;
    let starts: Vec<_> = starts(all).collect();
    if starts.is_empty() {
        return Ok(Answer::startless());
    }
    let made = |oracle: &mut dyn Oracle| {
        let number = oracle.pick(starts.len() as u32) as usize;
        let (playing, start) = &starts[number];
        states::walk(*playing, (number, start.clone()), runs.most_moves, oracle)
    };
    let tally = sample(runs.runs, runs.seed, |oracle| match made(oracle) {
        Some(run) => Err(Stop::Violated(run.demand)),
        None => Ok("a run"),
    });
    all.iter().try_for_each(ErasedProtocol::states_came_back)?;
    let again = tally.violation.as_ref().and_then(|(choices, _)| made(&mut Replay::new(choices)));
    let evidence = again.map(|run| starts[run.start].0.evidence(&starts[run.start].1, &run));
    Ok(Answer::new(evidence, true, Verdict::Unrefuted, tally.cases))
}

/// A shorter run from the start of another one: the one that a search finds, or that one without its detours; and
/// whether it is known that none is shorter.
fn shortened(
    all: &[ErasedProtocol],
    choices: &Choices,
    limits: Limits<'_>,
) -> Result<Option<(Choices, bool)>, MethodError> {
    let (_, run) = play(all, choices).map_err(MethodError::new)?;
    let Some((playing, start)) = starts(all).nth(run.start) else { return Ok(None) };
    let Findings { broken, is_shortest, .. } = states::search(playing, [start.clone()], limits);
    playing.states_came_back()?;
    let found =
        broken.into_iter().next().map(|found| playing.unfolded(&start, Run { start: run.start, ..found }));
    let cut = states::without_detours(playing, &start, &run);
    let shorter = found.filter(|found| found.length() <= cut.length()).unwrap_or(cut);
    Ok(Some((shorter.choices(), is_shortest)))
}

fn evidence(all: &[ErasedProtocol], run: &Run) -> Option<Evidence> {
    let (playing, start) = starts(all).nth(run.start)?;
    Some(playing.evidence(&start, run))
}

/// Whether what is found can be believed, as far as the first few states tell.
///
/// # Errors
/// [`MethodError`] if it cannot.
fn is_sound(all: &[ErasedProtocol]) -> Result<(), MethodError> {
    let mut left = states::TRIED;
    for playing in all {
        playing.is_sound()?;
        left -= playing.starts().take(left).count();
        if left == 0 {
            break;
        }
    }
    Ok(())
}

/// Surroundings that are searched beside each other before what they took of the steps is counted: as many with any
/// number of threads, so that a budget ends the search in the same place.
const WAVE: usize = 256;

/// The findings of a search that can be believed: of all surroundings in a portion, or up to the first in which the
/// demand is broken. The run is a shortest of those that were found, in the first of them that has one.
fn searched(
    all: &[ErasedProtocol],
    portion: Portion,
    until: Until,
    limits: Limits<'_>,
) -> Result<Findings<&'static str>, MethodError> {
    is_sound(all)?;
    let mut whole = Findings::NONE;
    // The surroundings of the run that is the shortest so far, and the run.
    let mut shortest: Option<(usize, Run)> = None;
    let own: Vec<usize> = portion.of(0..all.len()).collect();
    let (at_once, workers) = match own.len() {
        1 => (1, limits.workers),
        _ => {
            (limits.workers.map_or_else(rayon::current_num_threads, NonZeroUsize::get), NonZeroUsize::new(1))
        }
    };
    'all: for places in own.chunks(WAVE) {
        let limits = Limits { most_steps: limits.most_steps.saturating_sub(whole.steps), workers, ..limits };
        let found = threads::each_by(at_once, places, |&place| {
            all[place].search(Limits { memory: limits.memory.of_search(place), ..limits })
        });
        for (&place, found) in places.iter().zip(found) {
            let mut found = found?;
            if let Some(run) = found.broken.pop()
                && shortest.as_ref().is_none_or(|(_, other)| run.length() < other.length())
            {
                shortest = Some((place, run));
            }
            whole.add(found);
            if !whole.is_whole || shortest.is_some() && until == Until::Violation {
                break 'all;
            }
        }
    }
    let before = |place| all[..place].iter().map(|playing| playing.starts().count()).sum::<usize>();
    let counted = shortest.map(|(place, run)| Run { start: before(place) + run.start, ..run });
    Ok(Findings { broken: counted.into_iter().collect(), ..whole })
}
