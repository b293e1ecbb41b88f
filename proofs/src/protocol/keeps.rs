//! A check that a protocol keeps a demand within its bound.

use std::ops::ControlFlow;

use tautline_kernel::choice::Oracle;

use super::{Compact, Demand, Move, Protocol, When, beside};
use crate::decide::{
    Answer, Context, Depiction, Evidence, Method, MethodError, RandomRuns, RefutationPlay, Systems, Verdict,
};
use crate::engine::model::Started;
use crate::engine::states::{self, Bits, Ending, Findings, Limits, Step, System};
use crate::engine::world::{Turn, World, any_of, bit, picked};
use crate::engine::{Choices, Replay, Script, ScriptError, Stop, Until, sample};

/// A check that the demand with this number is kept, in these surroundings.
pub struct Keeps<P: Protocol>(
    /// The bound.
    pub P::Bound,
    /// The number of the demand.
    pub usize,
);

/// A protocol, of whose demands one is looked at.
struct Playing<P: Protocol> {
    protocol: P,
    demand: &'static Demand<P>,
}

/// From how many each choice is made, the start, and the run from it.
type Played<P> = (Vec<u32>, <P as Protocol>::State, states::Run<&'static str>);

impl<P: Protocol> World for Playing<P> {
    type State = P::State;
    type Plan = Vec<Move<P::State>>;
    /// The actors, and the move in words.
    type Event = (Bits, &'static str);
    type Demand = &'static str;

    fn plan(&self, state: &mut P::State, _: &[u8]) -> Option<Self::Plan> {
        any_of(self.moves(state))
    }

    fn settle(
        &self,
        state: &mut P::State,
        moves: &Self::Plan,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Self::Event {
        let Move { actors, words, to } = picked(moves, world);
        *state = to;
        (actors, words)
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        self.broken_between(turn.before, turn.after)
    }

    fn broken_at_end(&self, state: &P::State, _: &[u8]) -> Vec<&'static str> {
        let is_broken = match self.demand.when {
            When::Always(_) => false,
            When::AtTheEnd(is_so) | When::Eventually(is_so) => !is_so(&self.protocol, state),
            When::AgainAndAgain(owed) => owed(&self.protocol, state) != 0,
        };
        is_broken.then_some(self.demand.words).into_iter().collect()
    }

    fn covers(&self) -> Vec<&'static str> {
        P::COVERS.to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        bit(P::COVERS, turn.event.1)
    }
}

impl<P: Protocol> System for Playing<P> {
    /// A state has no parts.
    type Part = ();

    fn places(&self, _: &P::State) -> usize {
        0
    }

    fn part(&self, _: &P::State, _: usize) {}

    fn put(&self, _: &mut P::State, _: usize, (): &()) {}

    fn write(&self, state: &P::State, to: &mut Vec<u8>) {
        state.write(to);
    }

    fn read(&self, state: &mut P::State, mut bytes: &[u8]) {
        *state = P::State::read(&mut bytes);
    }

    fn make_canonical(&self, state: &mut P::State) {
        let all = self.protocol.alike(state).into_iter();
        let least = all.map(|other| (bytes(&other), other)).min_by(|one, other| one.0.cmp(&other.0));
        if let Some((bytes_of, other)) = least
            && bytes_of < bytes(state)
        {
            *state = other;
        }
    }

    /// Takes the moves as they are, without a copy of each.
    fn each_step<B>(
        &self,
        state: &P::State,
        mut take: impl FnMut(Step<Self>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        self.moves(state).into_iter().try_for_each(|Move { actors, words, to }| {
            let breaks = self.broken_between(state, &to);
            let (occurs, is_bound) = (bit(P::COVERS, words), actors != 0);
            take(Step { state: to, event: (actors, words), occurs, acting: actors, is_bound, breaks })
        })
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        turn.event.0
    }

    fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
        turn.event.0 != 0
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        matches!(self.demand.when, When::Eventually(_) | When::AgainAndAgain(_)).then_some(self.demand.words)
    }

    fn owed(&self, state: &P::State) -> Bits {
        match self.demand.when {
            When::AgainAndAgain(owed) => owed(&self.protocol, state),
            When::Always(_) | When::AtTheEnd(_) | When::Eventually(_) => 1,
        }
    }

    fn awake(&self, state: &P::State) -> Bits {
        self.protocol.moves(state).iter().fold(0, |set, next| set | next.actors)
    }
}

impl<P: Protocol> Playing<P> {
    /// The moves from a state: none once the demand is met.
    fn moves(&self, state: &P::State) -> Vec<Move<P::State>> {
        let is_met = matches!(self.demand.when, When::Eventually(is_so) if is_so(&self.protocol, state));
        if is_met { Vec::new() } else { self.protocol.moves(state) }
    }

    fn broken_between(&self, before: &P::State, after: &P::State) -> Vec<&'static str> {
        let is_broken =
            matches!(self.demand.when, When::Always(is_kept) if !is_kept(&self.protocol, before, after));
        is_broken.then_some(self.demand.words).into_iter().collect()
    }

    fn canonical(&self, mut state: P::State) -> P::State {
        self.make_canonical(&mut state);
        state
    }

    /// All that must be the same of states that are taken for one: what their moves are and lead to, and what is owed.
    fn outlook(&self, state: &P::State) -> impl Eq + use<P> {
        let of = |step: Step<Self>| (step.event, step.breaks, bytes(&self.canonical(step.state)));
        let mut moves: Vec<_> = states::steps(self, state).map(of).collect();
        moves.sort_unstable();
        (bytes(&self.canonical(state.clone())), moves, self.owed(state), self.broken_at_end(state, &[]))
    }

    /// Whether the first few states and those that they are taken for one with are alike.
    ///
    /// # Errors
    /// [`MethodError`] with two that are not.
    fn is_symmetric(&self) -> Result<(), MethodError> {
        for state in states::first_states(self, self.protocol.starts()) {
            let mut others = self.protocol.alike(&state).into_iter();
            if let Some(other) = others.find(|other| self.outlook(other) != self.outlook(&state)) {
                let [state, other] = [&state, &other].map(|state| self.protocol.words(state));
                let reason =
                    format_args!("the states {state} and {other} are taken for one, and are not alike");
                return Err(MethodError::new(reason));
            }
        }
        Ok(())
    }

    /// The run from `start` itself that a search has found among states of which each stands for those like it.
    fn unfolded(&self, start: &P::State, run: states::Run<&'static str>) -> states::Run<&'static str> {
        let (mut seen, mut state) = (self.canonical(start.clone()), start.clone());
        let mut follow = |&number: &u32| {
            let step = states::steps(self, &seen).nth(number as usize)?;
            seen = self.canonical(step.state);
            let is_it = |(_, own): &(u32, Step<Self>)| {
                own.event == step.event
                    && own.breaks == step.breaks
                    && self.canonical(own.state.clone()) == seen
            };
            let (number, own) = (0..).zip(states::steps(self, &state)).find(is_it)?;
            state = own.state;
            Some(number)
        };
        let steps = run.steps.iter().map_while(&mut follow).collect();
        let ending = match run.ending {
            Ending::Round(round) => Ending::Round(round.iter().map_while(follow).collect()),
            ending @ (Ending::There | Ending::Still) => ending,
        };
        states::Run { steps, ending, ..run }
    }

    /// Whether what is found can be believed, as far as the first few states tell.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot.
    fn is_sound(&self) -> Result<(), MethodError> {
        states::repeats(self, self.protocol.starts()).map_err(MethodError::new)?;
        self.comes_back()?;
        self.is_symmetric()
    }

    /// The findings of a search that can be believed.
    fn searched(&self, limits: Limits<'_>, workers: usize) -> Result<Findings<&'static str>, MethodError> {
        self.is_sound()?;
        let mut found = states::search_together(self, self.protocol.starts(), limits, workers);
        for run in &mut found.broken {
            if let Some(start) = self.protocol.starts().nth(run.start) {
                *run = self.unfolded(&start, run.clone());
            }
        }
        Ok(found)
    }

    /// Whether the first few states come back from their bytes.
    ///
    /// # Errors
    /// [`MethodError`] if one does not: two states might be taken for one.
    fn comes_back(&self) -> Result<(), MethodError> {
        let first = |state: P::State| {
            let next: Vec<P::State> = self.moves(&state).into_iter().map(|next| next.to).collect();
            next.into_iter().chain([state])
        };
        let differs = |state: &P::State| P::State::read(&mut &bytes(state)[..]) != *state;
        self.protocol.starts().take(states::TRIED).flat_map(first).find(differs).map_or(Ok(()), |state| {
            let state = self.protocol.words(&state);
            Err(MethodError::new(format_args!("the state {state} does not come back from its bytes")))
        })
    }

    /// From how many each of these choices is made, and the run that they make, with its start.
    fn play(&self, choices: &Choices) -> Result<Played<P>, ScriptError> {
        let mut script = Script::new(choices);
        let number = script.choose(self.protocol.starts().count())?;
        let start = self.protocol.starts().nth(number).ok_or(ScriptError::Unbroken)?;
        let (of, run) = script.play(self, (number, start.clone()), |_| true)?;
        Ok((of, start, run))
    }

    fn evidence(&self, start: &P::State, run: &states::Run<&'static str>) -> Evidence {
        Evidence { choices: run.choices(), demand: run.demand, seen: self.story(start, run) }
    }

    /// The run, drawn state by state.
    fn story(&self, start: &P::State, run: &states::Run<&'static str>) -> Depiction {
        let mut frames = vec![("start".to_owned(), self.protocol.draw(start))];
        for (place, (_, step)) in run.played(self, start.clone()).enumerate() {
            let (actors, words) = step.event;
            let again = if place == run.steps.len() { "again: " } else { "" };
            let title = if actors.is_power_of_two() {
                format!("{again}{} {words}", actors.trailing_zeros())
            } else {
                format!("{again}{words}")
            };
            frames.push((title, self.protocol.draw(&step.state)));
        }
        let end = match run.ending {
            Ending::There => "",
            Ending::Still => "\nnobody moves any more\n",
            Ending::Round(_) => "\nand so on for ever\n",
        };
        Depiction::Story(beside(&frames) + end)
    }
}

impl<P: Protocol> Keeps<P> {
    fn playing(&self, rule: &P::Rule) -> Result<Playing<P>, MethodError> {
        let none = || MethodError::new(format_args!("there is no demand {}", self.1));
        let demand = P::DEMANDS.get(self.1).ok_or_else(none)?;
        Ok(Playing { protocol: P::new(rule, &self.0)?, demand })
    }

    /// The states, and the shortest run that breaks the demand if there is one.
    ///
    /// # Errors
    /// [`MethodError`] if there is no such demand, if the protocol cannot be within its bound, or if its moves are not a
    /// function of their state, its states not of their bytes, or states that it takes for one not alike.
    pub fn search(&self, rule: &P::Rule, limits: Limits<'_>) -> Result<Findings<&'static str>, MethodError> {
        self.search_together(rule, limits, 1)
    }

    /// Searches as [`Self::search`] does on so many threads, with the same findings.
    ///
    /// # Errors
    /// [`MethodError`] as of [`Self::search`].
    pub fn search_together(
        &self,
        rule: &P::Rule,
        limits: Limits<'_>,
        workers: usize,
    ) -> Result<Findings<&'static str>, MethodError> {
        self.playing(rule)?.searched(limits, workers)
    }
}

impl<P: Protocol> Method<P::Rule> for Keeps<P> {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        self.0.to_string()
    }

    /// The choices are the number of the start, and those of the moves. A check over no start is open.
    fn decide(&self, rule: &P::Rule, _: Until, desk: &mut Context<'_, '_>) -> Result<Answer, MethodError> {
        let playing = self.playing(rule)?;
        let limits = Limits { room: desk.room, ..Limits::NONE };
        let found = playing.searched(limits, rayon::current_num_threads())?;
        let evidence = found
            .broken
            .first()
            .and_then(|run| Some(playing.evidence(&playing.protocol.starts().nth(run.start)?, run)));
        let is_covered = P::COVERS.iter().all(|words| found.covered.contains(words));
        let is_whole = found.is_whole && is_covered && found.states > 0;
        Ok(Answer::new(evidence, is_whole, self.shows(), found.states))
    }

    fn systems(&self, rule: &P::Rule) -> Result<Systems, MethodError> {
        let starts = |playing: &Playing<P>| playing.protocol.starts().collect();
        Ok(vec![Box::new(Started::new(self.playing(rule)?, starts))])
    }

    fn replay(&self, rule: &P::Rule, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let playing = self.playing(rule).map_err(|_| ScriptError::Unbroken)?;
        let (of, start, run) = playing.play(choices)?;
        Ok(RefutationPlay { of, evidence: playing.evidence(&start, &run) })
    }

    /// A hunt over no start is open.
    fn hunt(&self, rule: &P::Rule, runs: &RandomRuns) -> Result<Option<Answer>, MethodError> {
        let playing = self.playing(rule)?;
        playing.is_sound()?;
        let starts: Vec<P::State> = playing.protocol.starts().collect();
        if starts.is_empty() {
            return Ok(Some(Answer::open()));
        }
        let made = |oracle: &mut dyn Oracle| {
            let number = oracle.pick(starts.len() as u32) as usize;
            states::walk(&playing, (number, starts[number].clone()), runs.most_moves, oracle)
        };
        let tally = sample(runs.runs, runs.seed, |oracle| match made(oracle) {
            Some(run) => Err(Stop::Violated(run.demand)),
            None => Ok("a run"),
        });
        let again = tally.violation.as_ref().and_then(|(choices, _)| made(&mut Replay::new(choices)));
        let evidence = again.map(|run| playing.evidence(&starts[run.start], &run));
        Ok(Some(Answer::new(evidence, true, Verdict::Unrefuted, tally.cases)))
    }

    fn shorten(
        &self,
        rule: &P::Rule,
        choices: &Choices,
        limits: Limits<'_>,
    ) -> Result<Option<(Choices, bool)>, MethodError> {
        let playing = self.playing(rule)?;
        let (_, start, run) = playing.play(choices).map_err(MethodError::new)?;
        let found = states::search_together(&playing, [start.clone()], limits, rayon::current_num_threads());
        let shortest = found.broken.into_iter().next();
        let shortest =
            shortest.map(|found| playing.unfolded(&start, states::Run { start: run.start, ..found }));
        Ok(Some(match shortest {
            Some(run) => (run.choices(), true),
            None => (states::without_detours(&playing, &start, &run).choices(), false),
        }))
    }
}

fn bytes(state: &impl Compact) -> Vec<u8> {
    let mut bytes = Vec::new();
    state.write(&mut bytes);
    bytes
}
