//! A protocol in one of its surroundings, as a system whose states are searched.

use std::mem;
use std::ops::ControlFlow;
use std::sync::OnceLock;

use tautline_kernel::choice::Oracle;

use super::{Compact, Demand, Move, Protocol, Surroundings, When, beside};
use crate::decide::{Depiction, Evidence, MethodError};
use crate::engine::states::{self, Bits, Ending, Findings, Limits, Scratch, Step, System, Unsound};
use crate::engine::world::{Turn, World, any_of, bit, picked};

/// A protocol in its surroundings, of whose demands one is looked at.
pub(super) struct Playing<P: Protocol> {
    pub(super) rule: P,
    pub(super) here: Surroundings<P>,
    pub(super) demand: &'static Demand<P>,
    /// A state that did not come back from its bytes.
    pub(super) lost: OnceLock<P::State>,
}

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
            When::AtTheEnd(is_so) | When::Eventually(is_so) => !is_so(&self.rule, &self.here, state),
            When::AgainAndAgain(owed) => owed(&self.rule, &self.here, state) != 0,
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
        let all = self.rule.alike(&self.here, state);
        if all.is_empty() {
            return;
        }
        let (mut least, mut image) = (bytes(state), Vec::new());
        for other in all {
            image.clear();
            other.write(&mut image);
            if image < least {
                mem::swap(&mut image, &mut least);
                *state = other;
            }
        }
    }

    fn is_lost(&self, state: &P::State) -> bool {
        is_lost(state)
    }

    /// Takes the moves as they are, without a copy of each. The state to which the first one leads is read again from
    /// its bytes; in a debug build each is.
    fn each_step<B>(
        &self,
        state: &P::State,
        _: &mut Scratch<P::State>,
        mut take: impl FnMut(Step<Self, &mut P::State>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        self.moves(state).into_iter().enumerate().try_for_each(|(number, Move { actors, words, mut to })| {
            if (number == 0 || cfg!(debug_assertions)) && is_lost(&to) {
                self.lost.get_or_init(|| to.clone());
            }
            let breaks = self.broken_between(state, &to);
            let (occurs, is_bound) = (bit(P::COVERS, words), actors != 0);
            let event = (actors, words);
            take(Step { state: &mut to, event, occurs, acting: actors, is_bound, breaks })
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
            When::AgainAndAgain(owed) => owed(&self.rule, &self.here, state),
            When::Always(_) | When::AtTheEnd(_) | When::Eventually(_) => 1,
        }
    }

    fn awake(&self, state: &P::State) -> Bits {
        self.rule.moves(&self.here, state).iter().fold(0, |set, next| set | next.actors)
    }
}

impl<P: Protocol> Playing<P> {
    pub(super) fn starts(&self) -> impl Iterator<Item = P::State> {
        self.rule.starts(&self.here).into_iter()
    }

    /// The moves from a state: none once the demand is met.
    fn moves(&self, state: &P::State) -> Vec<Move<P::State>> {
        let is_met =
            matches!(self.demand.when, When::Eventually(is_so) if is_so(&self.rule, &self.here, state));
        if is_met { Vec::new() } else { self.rule.moves(&self.here, state) }
    }

    fn broken_between(&self, before: &P::State, after: &P::State) -> Vec<&'static str> {
        let is_broken = match self.demand.when {
            When::Always(is_kept) => !is_kept(&self.rule, &self.here, before, after),
            When::AtTheEnd(_) | When::Eventually(_) | When::AgainAndAgain(_) => false,
        };
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
        for state in states::first_states(self, self.starts()) {
            let mut others = self.rule.alike(&self.here, &state).into_iter();
            if let Some(other) = others.find(|other| self.outlook(other) != self.outlook(&state)) {
                let [state, other] = [&state, &other].map(|state| self.rule.words(state));
                let reason =
                    format_args!("the states {state} and {other} are taken for one, and are not alike");
                return Err(MethodError::new(reason));
            }
        }
        Ok(())
    }

    /// The run from `start` itself that a search has found among states of which each stands for those like it.
    pub(super) fn unfolded(
        &self,
        start: &P::State,
        run: states::Run<&'static str>,
    ) -> states::Run<&'static str> {
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
    pub(super) fn is_sound(&self) -> Result<(), MethodError> {
        let sound = states::repeats(self, self.starts());
        if !matches!(sound, Err(Unsound::Unrepeatable | Unsound::TooManyCovers)) {
            // Which states do not come back, or are not alike, is said in the words of the rule.
            self.comes_back()?;
            self.is_symmetric()?;
        }
        sound.map_err(MethodError::new)
    }

    /// The findings of a search of all states here.
    ///
    /// # Errors
    /// [`MethodError`] if a state did not come back from its bytes.
    pub(super) fn search(&self, limits: Limits<'_>) -> Result<Findings<&'static str>, MethodError> {
        self.starts_come_back()?;
        let mut found = states::search(self, self.starts(), limits);
        if let Some(state) = self.lost.get() {
            return Err(self.why_lost(state));
        }
        for run in &mut found.broken {
            if let Some(start) = self.starts().nth(run.start) {
                *run = self.unfolded(&start, run.clone());
            }
        }
        Ok(found)
    }

    /// Whether all starts come back from their bytes.
    ///
    /// # Errors
    /// [`MethodError`] if one does not: two starts might be taken for one.
    pub(super) fn starts_come_back(&self) -> Result<(), MethodError> {
        self.starts().find(is_lost).map_or(Ok(()), |state| Err(self.why_lost(&state)))
    }

    /// Whether the first few states come back from their bytes.
    ///
    /// # Errors
    /// [`MethodError`] if one does not: two states might be taken for one.
    fn comes_back(&self) -> Result<(), MethodError> {
        states::first_states(self, self.starts())
            .find(is_lost)
            .map_or(Ok(()), |state| Err(self.why_lost(&state)))
    }

    fn why_lost(&self, state: &P::State) -> MethodError {
        let state = self.rule.words(state);
        MethodError::new(format_args!("the state {state} does not come back from its bytes"))
    }

    pub(super) fn evidence(&self, start: &P::State, run: &states::Run<&'static str>) -> Evidence {
        Evidence { choices: run.choices(), demand: run.demand, seen: self.story(start, run) }
    }

    /// The run, drawn state by state.
    fn story(&self, start: &P::State, run: &states::Run<&'static str>) -> Depiction {
        let mut frames = vec![("start".to_owned(), self.rule.draw(&self.here, start))];
        for (place, (_, step)) in run.played(self, start.clone()).enumerate() {
            let (actors, words) = step.event;
            let again = if place == run.steps.len() { "again: " } else { "" };
            let title = if actors.is_power_of_two() {
                format!("{again}{} {words}", actors.trailing_zeros())
            } else {
                format!("{again}{words}")
            };
            frames.push((title, self.rule.draw(&self.here, &step.state)));
        }
        let end = match run.ending {
            Ending::There => "",
            Ending::Still => "\nnobody moves any more\n",
            Ending::Round(_) => "\nand so on for ever\n",
        };
        Depiction::Story(beside(&frames) + end)
    }
}

/// Whether a state does not come back from its bytes.
fn is_lost<S: Compact + Eq>(state: &S) -> bool {
    S::read(&mut &bytes(state)[..]) != *state
}

fn bytes(state: &impl Compact) -> Vec<u8> {
    let mut bytes = Vec::new();
    state.write(&mut bytes);
    bytes
}
