//! The search over all states of a system whose ways merge: what happens next is open at every step, so most ways lead
//! to states that others have led to. States are found in breadth, so that the way to each is as short as can be. When
//! there are no more, those that the system can come back to are looked at for runs that go on for ever and owe the
//! same thing throughout, although everybody acts who is not kept from it.
//!
//! A state is kept in a few bytes: it is taken apart, each part that was ever met stands once in a table, and the state
//! is the numbers of its parts (collapse compression, Holzmann 1997). It is put together again when it is gone on from.
//! Besides, of each state the one is kept from which it was first found, and where endless runs are looked for, the
//! steps that are bound to be made. A run is given by the numbers of its steps, each among all steps from its state.

mod certificate;
mod chunk;
mod code;
mod graph;
mod limits;
mod queue;
mod rounds;
mod search;
mod spill;
mod state_table;
mod tables;
mod walk;

use std::collections::VecDeque;
use std::hash::Hash;
use std::ops::ControlFlow;
use std::{fmt, iter, mem};

use rustc_hash::FxHashMap;

pub use certificate::{AnySystem, NoCertificate};
pub use chunk::{MOST as MOST_AT_ONCE, pieces};
pub use limits::{Limits, Memory, MemoryLimit};
pub use search::{search, watched};
pub use spill::{Create, HEAD, PART, Spill, SpillError, SpillFault, WHOLE};
pub use walk::{walk, without_detours};

use super::bodies::Odometer;
use super::watchdog;
use super::world::{MOST_COVERS, Turn, World};

/// A set of at most sixteen things, one bit each.
pub type Bits = u16;

/// A set of the parts' places, one bit each. Whatever it says, places from 64 on are among them.
pub type Places = u64;

/// Whether a place is among these.
fn has(places: Places, place: usize) -> bool {
    place >= Places::BITS as usize || places >> place & 1 == 1
}

/// The places that differ, by whether each does.
pub fn places(differing: impl IntoIterator<Item = bool>) -> Places {
    (0..).zip(differing).fold(0, |places, (place, differs)| places | Places::from(differs) << place)
}

/// A world whose ways merge: its states are searched.
pub trait System: World<State: Send, Demand: Send> + Sync {
    /// A part of a state. The fewer different parts there are, the less memory a search takes; the whole state may be
    /// one part, or be kept in bytes of its own.
    type Part: Clone + Eq + Hash + Send + Sync;

    /// Makes of `state` the one that stands for all those that are to be taken for one with it: there are no others
    /// unless there is more to tell.
    fn make_canonical(&self, _: &mut Self::State) {}

    /// How many parts `state` has: as many as every other state. A state of no parts is kept as the bytes that
    /// [`Self::write`] makes of it.
    fn places(&self, _: &Self::State) -> usize {
        1
    }

    /// The part of `state` in this place.
    fn part(&self, state: &Self::State, place: usize) -> Self::Part;

    /// The places whose parts may differ in a state and the one to which a step from it leads, both canonical; all of
    /// them, unless there is more to tell. The fewer they are, the less time a search takes.
    fn differing(&self, _: &Self::State, _: &Self::State) -> Places {
        Places::MAX
    }

    /// Makes `part` the part of `state` in this place. Until all its parts are put, others may be another state's.
    fn put(&self, state: &mut Self::State, place: usize, part: &Self::Part);

    /// Appends the bytes that tell a state of no parts from all others.
    fn write(&self, _: &Self::State, _: &mut Vec<u8>) {}

    /// Makes `state` the one of which [`Self::write`] made these bytes.
    fn read(&self, _: &mut Self::State, _: &[u8]) {}

    /// Whether what is kept of `state` leaves something of it out, as far as the system can tell: then another state
    /// may be taken for it, and no search that meets it can be believed.
    fn is_lost(&self, _: &Self::State) -> bool {
        false
    }

    /// Makes every step from `state`, one for each combination of answers, always in the same order. The next one is
    /// made in the place of the state to which the last one leads: in `scratch`, which may come from other states.
    fn each_step<B>(
        &self,
        state: &Self::State,
        scratch: &mut Scratch<Self::State>,
        mut take: impl FnMut(Step<Self, &mut Self::State>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let Scratch { states, answers, log } = scratch;
        let [planned, after] = states.get_or_insert_with(|| [state.clone(), state.clone()]);
        planned.clone_from(state);
        let Some(plan) = self.plan(planned, &[]) else { return ControlFlow::Continue(()) };
        answers.begin();
        let may_be_endless = self.broken_by_endless_runs().is_some();
        loop {
            after.clone_from(planned);
            log.clear();
            let event = self.settle(after, &plan, log, answers);
            let turn = Turn { before: state, planned, after, plan: &plan, event: &event, sent: log };
            let (occurs, is_bound) = (self.occurs(&turn), self.is_bound(&turn));
            let acting = if is_bound && may_be_endless { self.acting(&turn) } else { 0 };
            let breaks = self.broken_by(&turn);
            take(Step { state: after, event, occurs, acting, is_bound, breaks })?;
            if !answers.advance() {
                return ControlFlow::Continue(());
            }
        }
    }

    /// Who acts in a step that is bound to be made, where endless runs are looked for.
    fn acting(&self, _: &Turn<'_, Self>) -> Bits {
        1
    }

    /// Whether a step is bound to be made if no other one is.
    fn is_bound(&self, _: &Turn<'_, Self>) -> bool {
        true
    }

    /// The demand that is broken by a run that never ends and owes the same thing throughout, everybody acting who is
    /// awake throughout; `None` if that is not looked for.
    fn broken_by_endless_runs(&self) -> Option<Self::Demand> {
        None
    }

    /// The obligations owed in `state`: the same one always, unless there is more to tell.
    fn owed(&self, _: &Self::State) -> Bits {
        1
    }

    /// Who has something left to do in `state`.
    fn awake(&self, _: &Self::State) -> Bits {
        0
    }

    /// Whether nothing more is looked for once a step or an end breaks `demand`: what is not found then may be broken
    /// all the same. Where it is not, each demand is decided as if it stood alone, since steps are made from every
    /// state.
    fn is_enough(&self, _: Self::Demand) -> bool {
        true
    }
}

/// The memory in which steps are made, state by state.
pub struct Scratch<T> {
    /// The state once the step is planned, and after it.
    states: Option<[T; 2]>,
    answers: Odometer,
    log: Vec<u8>,
}

impl<T: Clone> Scratch<T> {
    /// The memory for the state to which a step leads: a copy of `state`, or whatever was there last.
    pub(crate) fn after(&mut self, state: &T) -> &mut T {
        let [_, after] = self.states.get_or_insert_with(|| [state.clone(), state.clone()]);
        after
    }
}

impl<T> Default for Scratch<T> {
    fn default() -> Self {
        Self { states: None, answers: Odometer::default(), log: Vec::new() }
    }
}

/// A step to another state.
pub struct Step<S: System + ?Sized, T = <S as World>::State> {
    /// The state to which it leads.
    pub state: T,
    /// Its event.
    pub event: S::Event,
    /// The situations that it is: a bit for each of [`World::covers`].
    pub occurs: u64,
    /// Who acts in it; nobody unless it is bound to be made, and endless runs are looked for.
    pub acting: Bits,
    /// Whether it is bound to be made if no other one is.
    pub is_bound: bool,
    /// The demands that it breaks.
    pub breaks: Vec<S::Demand>,
}

/// Every step of `system` from `state`, in the order of [`System::each_step`].
pub fn steps<S: System>(system: &S, state: &S::State) -> impl Iterator<Item = Step<S>> {
    let mut all = Vec::new();
    let _: ControlFlow<()> = system.each_step(state, &mut Scratch::default(), |step| {
        let Step { state, event, occurs, acting, is_bound, breaks } = step;
        all.push(Step { state: state.clone(), event, occurs, acting, is_bound, breaks });
        ControlFlow::Continue(())
    });
    all.into_iter()
}

/// A state, as far as it is kept.
type StateParts<S> = (Vec<<S as System>::Part>, Vec<u8>);

fn kept<S: System>(system: &S, state: &S::State) -> StateParts<S> {
    let mut bytes = Vec::new();
    system.write(state, &mut bytes);
    ((0..system.places(state)).map(|place| system.part(state, place)).collect(), bytes)
}

/// Whether two states are the same one, as far as they are kept.
pub fn is_same<S: System>(system: &S, one: &S::State, other: &S::State) -> bool {
    kept(system, one) == kept(system, other)
}

/// Why no search of a system can be believed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unsound {
    /// More than [`MOST_COVERS`] situations must occur.
    TooManyCovers,
    /// Steps are not a function of their state.
    Unrepeatable,
    /// A state that is taken apart and put together again is another one.
    Torn,
    /// A state and the one that stands for it have other steps, or that is not the one that stands for itself.
    Unlike,
    /// A step leads to a state that differs in a part that is not among the differing ones.
    Undeclared,
}

impl fmt::Display for Unsound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TooManyCovers => "more than 64 situations must occur: no more can be told apart",
            Self::Unrepeatable => {
                "from one state a step led to two: a rule may depend on nothing but its arguments"
            }
            Self::Torn => {
                "a state that is taken apart and put together again goes on in another way: `part` and `put`, or \
                 `write` and `read`, must leave nothing out"
            }
            Self::Unlike => {
                "a state and the one that `make_canonical` makes of it go on in other ways, or it makes another one of \
                 that: only states that are alike may be taken for one"
            }
            Self::Undeclared => {
                "a step leads to a state that differs in a part that `differing` does not name: it may name too many \
                 places, but none too few"
            }
        })
    }
}

/// States that are tried before a search: half of them depth first, and so beyond what a byte can count.
pub(crate) const TRIED: usize = 600;

/// The first few states: by turns the next one breadth first and the next one depth first, so that many starts do not
/// keep it from going far. A state may come again, since two that are kept alike need not be one: twice, and where
/// nothing new is met.
pub(crate) fn first_states<S: System>(
    system: &S,
    starts: impl IntoIterator<Item = S::State>,
) -> impl Iterator<Item = S::State> {
    let making = watchdog::Steps::begin();
    let mut known: FxHashMap<_, u8> = FxHashMap::default();
    let mut is_due = move |state: &S::State| {
        let times = known.entry(kept(system, state)).or_default();
        *times = times.saturating_add(1);
        *times <= 2
    };
    let mut ahead: VecDeque<S::State> = starts.into_iter().take(TRIED).filter(&mut is_due).collect();
    let mut is_deep = false;
    let next = move || {
        making.next();
        let state = if is_deep { ahead.pop_back() } else { ahead.pop_front() }?;
        let (queued, reached) = (ahead.len(), || steps(system, &state).map(|step| step.state));
        ahead.extend(reached().filter(&mut is_due).take(TRIED.saturating_sub(queued)));
        if ahead.len() == queued && (is_deep || queued == 0) {
            ahead.extend(reached().find(|next| !is_same(system, &state, next)));
        }
        is_deep = !is_deep;
        Some(state)
    };
    iter::from_fn(next).take(TRIED)
}

/// Makes the steps from the first few states again, also once they are put together in the place of another state, and
/// compares them; and those from the states that stand for them, in whatever order these are made.
///
/// # Errors
/// [`Unsound`] if they differ, or too many situations must occur.
pub fn repeats<S: System>(system: &S, starts: impl IntoIterator<Item = S::State>) -> Result<(), Unsound> {
    let made = |state: &S::State| steps(system, state).collect::<Vec<_>>();
    let of_step = |step: &Step<S>| (kept(system, &step.state), step.is_bound, step.breaks.clone());
    let outlook = |steps: &[Step<S>]| steps.iter().map(of_step).collect::<Vec<_>>();
    let canonical = |state: &S::State| {
        let mut state = state.clone();
        system.make_canonical(&mut state);
        state
    };
    if system.covers().len() > MOST_COVERS {
        return Err(Unsound::TooManyCovers);
    }
    let of_class = |steps: &[Step<S>]| {
        let mut times: FxHashMap<_, u32> = FxHashMap::default();
        for Step { state, is_bound, breaks, .. } in steps {
            *times.entry((kept(system, &canonical(state)), *is_bound, breaks.len())).or_default() += 1;
        }
        times
    };
    let mut before: Option<S::State> = None;
    for state in first_states(system, starts) {
        let (own, first) = (canonical(&state), made(&state));
        if outlook(&first) != outlook(&made(&state)) {
            return Err(Unsound::Unrepeatable);
        }
        let of_own = made(&own);
        for after in of_own.iter().map(|step| canonical(&step.state)) {
            let differing = system.differing(&own, &after);
            let differs = |place| system.part(&own, place) != system.part(&after, place);
            if (0..system.places(&own)).any(|place| !has(differing, place) && differs(place)) {
                return Err(Unsound::Undeclared);
            }
        }
        if of_class(&first) != of_class(&of_own) || !is_same(system, &own, &canonical(&own)) {
            return Err(Unsound::Unlike);
        }
        if let Some(mut other) = before.replace(own) {
            let (parts, bytes) = before.as_ref().map(|own| kept(system, own)).unwrap_or_default();
            system.read(&mut other, &bytes);
            for (place, part) in parts.iter().enumerate() {
                system.put(&mut other, place, part);
            }
            if outlook(&made(&other)) != outlook(&of_own) {
                return Err(Unsound::Torn);
            }
        }
    }
    Ok(())
}

/// The situation in which a run ends.
pub const END: &str = "an end";

/// The findings of a search.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Findings<D> {
    /// States, the starts among them.
    pub states: u64,
    /// States from which all steps were made, or the one that broke enough.
    pub looked_at: u64,
    /// Steps between states.
    pub steps: u64,
    /// The most bytes that it took at a time.
    pub bytes: u64,
    /// Whether the search came to its end, and not to one of its [`Limits`], and nobody ended it.
    pub is_whole: bool,
    /// The situations that occurred, sorted.
    pub covered: Vec<&'static str>,
    /// A run for each demand that is broken.
    pub broken: Vec<Run<D>>,
    /// Whether each of these runs is known to be a shortest one: of those that go round, until they begin again.
    pub is_shortest: bool,
}

impl<D> Findings<D> {
    /// Nothing was looked for yet.
    pub(crate) const NONE: Self = Self {
        states: 0,
        looked_at: 0,
        steps: 0,
        bytes: 0,
        is_whole: true,
        is_shortest: true,
        covered: Vec::new(),
        broken: Vec::new(),
    };

    /// These findings, with other words for the demands.
    pub(crate) fn told<E>(self, words: impl Fn(D) -> E) -> Findings<E> {
        let Self { states, looked_at, steps, bytes, is_whole, covered, broken, is_shortest } = self;
        let told = |Run { demand, start, steps, ending }| Run { demand: words(demand), start, steps, ending };
        let broken = broken.into_iter().map(told).collect();
        Findings { states, looked_at, steps, bytes, is_whole, covered, broken, is_shortest }
    }

    /// Adds what was found of another system; of the bytes the larger number counts.
    pub(crate) fn add(&mut self, other: Self) {
        self.states += other.states;
        self.looked_at += other.looked_at;
        self.steps += other.steps;
        self.bytes = self.bytes.max(other.bytes);
        self.is_whole &= other.is_whole;
        self.is_shortest &= other.is_shortest;
        self.covered.extend(other.covered);
        self.covered.sort_unstable();
        self.covered.dedup();
        self.broken.extend(other.broken);
    }
}

/// A run that breaks a demand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run<D> {
    /// The demand that it breaks.
    pub demand: D,
    /// The number of its start.
    pub start: usize,
    /// The numbers of its steps.
    pub steps: Vec<u32>,
    /// How it breaks it.
    pub ending: Ending,
}

/// How a run breaks a demand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ending {
    /// By its last step.
    There,
    /// No step is bound to be made from its last state.
    Still,
    /// These steps lead from its last state back to it.
    Round(Vec<u32>),
}

impl<D> Run<D> {
    /// How many steps it has, those of its round once.
    pub fn length(&self) -> usize {
        self.steps.len() + self.round().len()
    }

    /// The numbers of the steps of its round; none if it ends.
    pub fn round(&self) -> &[u32] {
        match &self.ending {
            Ending::There | Ending::Still => &[],
            Ending::Round(round) => round,
        }
    }

    /// Its steps and then those of its round, made from `state`: each with the state in which it begins.
    pub fn played<S: System>(
        &self,
        system: &S,
        mut state: S::State,
    ) -> impl Iterator<Item = (S::State, Step<S>)> {
        self.steps.iter().chain(self.round()).map_while(move |&number| {
            let step = steps(system, &state).nth(number as usize)?;
            let before = mem::replace(&mut state, step.state.clone());
            Some((before, step))
        })
    }
}
