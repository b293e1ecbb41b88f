//! A protocol in one of its surroundings, as a system whose states are searched.

use std::mem;
use std::ops::{ControlFlow, Deref};
use std::sync::OnceLock;

use tautline_kernel::choice::Oracle;

use super::any_protocol::{AnyProtocol, MoveWords, StateBytes, TypedProtocol};
use super::{Demand, Protocol, Surroundings, beside};
use crate::decide::{Depiction, Evidence, MethodError};
use crate::engine::states::{self, Bits, Ending, Findings, Limits, Run, Scratch, Step, System, Unsound};
use crate::engine::world::{Turn, World, any_of, bit, picked};

/// A protocol in its surroundings, of whose demands one is looked at.
pub(super) struct ErasedProtocol(Box<dyn AnyProtocol>);

impl Deref for ErasedProtocol {
    type Target = dyn AnyProtocol;

    fn deref(&self) -> &Self::Target {
        &*self.0
    }
}

impl World for ErasedProtocol {
    type State = StateBytes;
    type Plan = Vec<(MoveWords, StateBytes)>;
    type Event = MoveWords;
    type Demand = &'static str;

    fn plan(&self, state: &mut StateBytes, _: &[u8]) -> Option<Self::Plan> {
        let mut moves = Vec::new();
        self.each_move(&state.bytes, &mut StateBytes::default(), &mut |made, to| {
            moves.push((made, mem::take(to)));
            ControlFlow::Continue(())
        });
        any_of(moves)
    }

    fn settle(
        &self,
        state: &mut StateBytes,
        moves: &Self::Plan,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> MoveWords {
        let (made, to) = picked(moves, world);
        *state = to;
        made
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        self.broken(turn.event.is_broken)
    }

    fn broken_at_end(&self, state: &StateBytes, _: &[u8]) -> Vec<&'static str> {
        self.broken(self.is_broken_at_end(&state.bytes))
    }

    fn covers(&self) -> Vec<&'static str> {
        AnyProtocol::covers(&*self.0).to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        bit(AnyProtocol::covers(&*self.0), turn.event.words)
    }
}

impl System for ErasedProtocol {
    /// A state has no parts.
    type Part = ();

    fn places(&self, _: &StateBytes) -> usize {
        0
    }

    fn part(&self, _: &StateBytes, _: usize) {}

    fn put(&self, _: &mut StateBytes, _: usize, (): &()) {}

    fn write(&self, state: &StateBytes, to: &mut Vec<u8>) {
        to.extend_from_slice(&state.bytes);
    }

    fn read(&self, state: &mut StateBytes, bytes: &[u8]) {
        state.bytes.clear();
        state.bytes.extend_from_slice(bytes);
        (state.canonical, state.is_lost) = (None, false);
    }

    fn make_canonical(&self, state: &mut StateBytes) {
        if let Some(canonical) = state.canonical.take() {
            state.bytes = canonical;
        }
    }

    fn is_lost(&self, state: &StateBytes) -> bool {
        state.is_lost
    }

    /// Takes the moves as they are, without a copy of each.
    fn each_step<B>(
        &self,
        state: &StateBytes,
        scratch: &mut Scratch<StateBytes>,
        mut take: impl FnMut(Step<Self, &mut StateBytes>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let (covers, mut flow) = (AnyProtocol::covers(&*self.0), ControlFlow::Continue(()));
        self.each_move(&state.bytes, scratch.after(state), &mut |event, state| {
            let (occurs, acting) = (bit(covers, event.words), event.actors);
            let breaks = self.broken(event.is_broken);
            flow = take(Step { state, event, occurs, acting, is_bound: acting != 0, breaks });
            if flow.is_break() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        flow
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        turn.event.actors
    }

    fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
        turn.event.actors != 0
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        self.may_be_endless().then(|| self.demand())
    }

    fn owed(&self, state: &StateBytes) -> Bits {
        self.0.owed(&state.bytes)
    }

    fn awake(&self, state: &StateBytes) -> Bits {
        self.0.awake(&state.bytes)
    }
}

impl ErasedProtocol {
    pub(super) fn new<P: Protocol>(
        rule: P,
        here: Surroundings<P>,
        (demand, tries_all): (&'static Demand<P>, bool),
    ) -> Self {
        Self(Box::new(TypedProtocol { rule, here, demand, tries_all, fault: OnceLock::new() }))
    }

    fn broken(&self, is_broken: bool) -> Vec<&'static str> {
        if is_broken { vec![self.demand()] } else { Vec::new() }
    }

    fn canonical(&self, mut state: StateBytes) -> StateBytes {
        self.make_canonical(&mut state);
        state
    }

    /// All that must be the same of states that are taken for one: what their moves are and lead to, and what is owed.
    fn outlook(&self, state: &StateBytes) -> Outlook {
        let of = |step: Step<Self>| (step.event, self.canonical(step.state).bytes);
        let moves = states::steps(self, state).map(of).collect();
        let home = self.canonical(state.clone()).bytes;
        Outlook { home, moves, owed: self.0.owed(&state.bytes), ends: self.is_broken_at_end(&state.bytes) }
    }

    /// Whether the first few states and those that they are taken for one with are alike.
    ///
    /// # Errors
    /// [`MethodError`] with two that are not.
    fn is_symmetric(&self) -> Result<(), MethodError> {
        for state in states::first_states(self, self.starts()) {
            let own = self.outlook(&state);
            for other in self.alike(&state.bytes) {
                if let Some(what) = own.difference(&self.outlook(&other)) {
                    let [state, other] = [&state, &other].map(|state| self.words(&state.bytes));
                    let reason = format_args!(
                        "the states {state} and {other} are taken for one, and are not alike: {what}"
                    );
                    return Err(MethodError::new(reason));
                }
            }
        }
        Ok(())
    }

    /// The run from `start` itself that a search has found among states of which each stands for those like it.
    pub(super) fn unfolded(&self, start: &StateBytes, run: Run<&'static str>) -> Run<&'static str> {
        let (mut seen, mut state) = (self.canonical(start.clone()), start.clone());
        let mut follow = |&number: &u32| {
            let step = states::steps(self, &seen).nth(number as usize)?;
            seen = self.canonical(step.state);
            let is_it = |(_, own): &(u32, Step<Self>)| {
                own.event == step.event && self.canonical(own.state.clone()).bytes == seen.bytes
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
        Run { steps, ending, ..run }
    }

    /// Whether what is found can be believed, as far as the first few states tell.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot.
    pub(super) fn is_sound(&self) -> Result<(), MethodError> {
        let sound = states::repeats(self, self.starts());
        if !matches!(sound, Err(Unsound::Unrepeatable | Unsound::TooManyCovers)) {
            // Which states do not come back, or are not alike, is said in the words of the rule.
            self.states_came_back()?;
            let mut first = states::first_states(self, self.starts());
            refused(first.find_map(|state| self.lost_after(&state.bytes)))?;
            self.is_symmetric()?;
        }
        sound.map_err(MethodError::new)
    }

    /// The findings of a search of all states here.
    ///
    /// # Errors
    /// [`MethodError`] if a state did not come back from its bytes.
    pub(super) fn search(&self, limits: Limits<'_>) -> Result<Findings<&'static str>, MethodError> {
        let mut found = states::search(self, self.starts(), limits);
        self.states_came_back()?;
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
        self.starts().for_each(drop);
        self.states_came_back()
    }

    /// Whether all states that were met and tried came back from their bytes, and all moves were made by actors.
    ///
    /// # Errors
    /// [`MethodError`] if a state did not, and another one was gone on from in its place, or if a move was not.
    pub(super) fn states_came_back(&self) -> Result<(), MethodError> {
        refused(self.fault().map(str::to_owned))
    }

    pub(super) fn evidence(&self, start: &StateBytes, run: &Run<&'static str>) -> Evidence {
        Evidence { choices: run.choices(), demand: run.demand, seen: self.story(start, run) }
    }

    /// The run, drawn state by state.
    fn story(&self, start: &StateBytes, run: &Run<&'static str>) -> Depiction {
        let mut frames = vec![("start".to_owned(), self.draw(&start.bytes))];
        let numbers = run.steps.iter().chain(run.round());
        for (place, ((before, step), &number)) in run.played(self, start.clone()).zip(numbers).enumerate() {
            let again = if place == run.steps.len() { "again: " } else { "" };
            let title = self.title(&before.bytes, number as usize);
            frames.push((format!("{again}{title}"), self.draw(&step.state.bytes)));
        }
        let end = match run.ending {
            Ending::There => "",
            Ending::Still => "\nnobody moves any more\n",
            Ending::Round(_) => "\nand so on for ever\n",
        };
        Depiction::Story(beside(&frames) + end)
    }
}

/// # Errors
/// [`MethodError`] if there is a fault.
fn refused(fault: Option<String>) -> Result<(), MethodError> {
    fault.map_or(Ok(()), |why| Err(MethodError::new(why)))
}

/// All that must be the same of states that are taken for one.
struct Outlook {
    /// The bytes of the state that stands for it.
    home: Vec<u8>,
    /// Its moves, each with the bytes of the state that stands for the one to which it leads.
    moves: Vec<(MoveWords, Vec<u8>)>,
    owed: Bits,
    /// Whether a run breaks the demand that ends here.
    ends: bool,
}

/// All that a move may differ in, from one list of moves to another; the first differences leave out the others.
const DIFFERENCES: [&str; 4] = [
    "is not possible as often in both",
    "has other actors",
    "leads to states that are not taken for one",
    "breaks the demand in one of them",
];

impl Outlook {
    /// The first thing that this one and another one have not in common, in words.
    fn difference(&self, other: &Self) -> Option<String> {
        if self.home != other.home {
            return Some("another state stands for each of them".to_owned());
        }
        for (depth, what) in DIFFERENCES.into_iter().enumerate() {
            let keys = |outlook: &Self| {
                let key = |(made, to): &(MoveWords, Vec<u8>)| {
                    let actors = if depth > 0 { made.actors } else { 0 };
                    let to = if depth > 1 { to.clone() } else { Vec::new() };
                    (made.words, actors, to, depth > 2 && made.is_broken)
                };
                let mut keys: Vec<_> = outlook.moves.iter().map(key).collect();
                keys.sort_unstable();
                keys
            };
            let (own, others) = (keys(self), keys(other));
            let place = (0..own.len().max(others.len())).find(|&place| own.get(place) != others.get(place));
            let first = place.and_then(|place| own.get(place).into_iter().chain(others.get(place)).min());
            if let Some((words, ..)) = first {
                return Some(format!("the move {words:?} {what}"));
            }
        }
        if self.owed != other.owed {
            return Some("they owe different things".to_owned());
        }
        (self.ends != other.ends).then(|| "a run that ends there breaks the demand in one of them".to_owned())
    }
}
