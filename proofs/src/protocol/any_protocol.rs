//! The face of a protocol whose types are not known, in one of its surroundings: states are bytes. What is asked of it
//! is the same for all protocols, so that whatever searches or plays one is compiled once for all of them.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use super::{Compact, Demand, Move, Protocol, Surroundings, When};
use crate::engine::states::Bits;

/// A state by its bytes.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct StateBytes {
    pub(super) bytes: Vec<u8>,
    /// The bytes of the one that stands for those like it, if that is another one.
    pub(super) canonical: Option<Vec<u8>>,
    /// Whether another state is read from the bytes, as far as that was tried, or no actor leads to it.
    pub(super) is_lost: bool,
}

/// A move as it is told.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct MoveWords {
    pub(super) actors: Bits,
    pub(super) words: &'static str,
    /// Whether it breaks the demand.
    pub(super) is_broken: bool,
}

/// A protocol of any types, of whose demands one is looked at. States are given by their bytes.
pub(super) trait AnyProtocol: Sync {
    /// The demand in words.
    fn demand(&self) -> &'static str;

    /// Whether it may be broken by a run without end.
    fn may_be_endless(&self) -> bool;

    /// The moves that must occur, in words.
    fn covers(&self) -> &'static [&'static str];

    /// The states in which runs begin, each tried whether it comes back from its bytes.
    fn starts(&self) -> Box<dyn Iterator<Item = StateBytes> + '_>;

    /// Every move from a state, each with the one to which it leads, made in the
    /// memory of `to`: none once the demand is met.
    fn each_move(
        &self,
        state: &[u8],
        to: &mut StateBytes,
        take: &mut dyn FnMut(MoveWords, &mut StateBytes) -> ControlFlow<()>,
    );

    /// The actors of all moves that are possible in a state.
    fn awake(&self, state: &[u8]) -> Bits;

    /// The obligations in a state.
    fn owed(&self, state: &[u8]) -> Bits;

    /// Whether a run breaks the demand that ends in a state.
    fn is_broken_at_end(&self, state: &[u8]) -> bool;

    /// The states that are taken for one with a state.
    fn alike(&self, state: &[u8]) -> Vec<StateBytes>;

    /// The title of the move with this number from a state.
    fn title(&self, state: &[u8], number: usize) -> String;

    /// A drawing of a state.
    fn draw(&self, state: &[u8]) -> String;

    /// The words for a state.
    fn words(&self, state: &[u8]) -> String;

    /// Why the first state is refused that does not come back from its bytes, of those to which moves from a state
    /// lead.
    fn lost_after(&self, state: &[u8]) -> Option<String>;

    /// Why a state that was tried does not come back from its bytes, or a move that was made has an actor that is none.
    fn fault(&self) -> Option<&str>;
}

/// A protocol in its surroundings, of whose demands one is looked at.
pub(super) struct TypedProtocol<P: Protocol> {
    pub(super) rule: P,
    pub(super) here: Surroundings<P>,
    pub(super) demand: &'static Demand<P>,
    /// Whether every state that is met is read again from its bytes, and not only the first one to which a state leads.
    pub(super) tries_all: bool,
    /// Why the protocol is refused: a state that was met does not come back from its bytes, or a move has an actor that
    /// is none.
    pub(super) fault: OnceLock<String>,
}

impl<P: Protocol> TypedProtocol<P> {
    fn packed(&self, state: &P::State) -> StateBytes {
        let mut packed = StateBytes { bytes: Vec::with_capacity(SOME), ..StateBytes::default() };
        self.pack(state, &mut packed);
        packed
    }

    fn pack(&self, state: &P::State, to: &mut StateBytes) {
        to.bytes.clear();
        state.write(&mut to.bytes);
        let least = self.rule.alike(&self.here, state).iter().map(bytes).min();
        to.canonical = least.filter(|least| *least < to.bytes);
        to.is_lost = false;
    }

    /// Tries whether a state comes back from its bytes.
    fn try_to_read(&self, state: &P::State, packed: &mut StateBytes) {
        packed.is_lost = read::<P>(&packed.bytes) != *state;
        if packed.is_lost {
            self.fault.get_or_init(|| self.lost(state));
        }
    }

    fn lost(&self, state: &P::State) -> String {
        format!("the state {} does not come back from its bytes", self.rule.words(state))
    }
}

impl<P: Protocol> AnyProtocol for TypedProtocol<P> {
    fn demand(&self) -> &'static str {
        self.rule.demand_words(self.demand)
    }

    fn may_be_endless(&self) -> bool {
        matches!(self.demand.when, When::Eventually(_) | When::AgainAndAgain(_))
    }

    fn covers(&self) -> &'static [&'static str] {
        P::COVERS
    }

    fn starts(&self) -> Box<dyn Iterator<Item = StateBytes> + '_> {
        let packed = |state| {
            let mut packed = self.packed(&state);
            self.try_to_read(&state, &mut packed);
            packed
        };
        Box::new(self.rule.starts(&self.here).into_iter().map(packed))
    }

    fn each_move(
        &self,
        state: &[u8],
        to: &mut StateBytes,
        take: &mut dyn FnMut(MoveWords, &mut StateBytes) -> ControlFlow<()>,
    ) {
        let (before, here) = (&read::<P>(state), &self.here);
        if matches!(self.demand.when, When::Eventually(is_so) if is_so(&self.rule, here, before)) {
            return;
        }
        for (number, made) in self.rule.moves(here, before).iter().enumerate() {
            self.pack(&made.to, to);
            if number == 0 || self.tries_all {
                self.try_to_read(&made.to, to);
            }
            if let Some(none) = made.no_actor {
                let why = "the actors of a protocol have the numbers 0 to 15, not";
                let from = || self.rule.words(before);
                self.fault.get_or_init(|| format!("{why} {none}: {:?} in the state {}", made.words, from()));
                to.is_lost = true;
            }
            let is_broken = match self.demand.when {
                When::Always(is_kept) => !is_kept(&self.rule, here, before, &made.to),
                When::AtTheEnd(_) | When::Eventually(_) | When::AgainAndAgain(_) => false,
            };
            if take(MoveWords { actors: made.actors, words: made.words, is_broken }, to).is_break() {
                return;
            }
        }
    }

    fn awake(&self, state: &[u8]) -> Bits {
        self.rule.moves(&self.here, &read::<P>(state)).iter().fold(0, |set, next| set | next.actors)
    }

    fn owed(&self, state: &[u8]) -> Bits {
        match self.demand.when {
            When::AgainAndAgain(owed) => owed(&self.rule, &self.here, &read::<P>(state)),
            When::Always(_) | When::AtTheEnd(_) | When::Eventually(_) => 1,
        }
    }

    fn is_broken_at_end(&self, state: &[u8]) -> bool {
        let state = || read::<P>(state);
        match self.demand.when {
            When::Always(_) => false,
            When::AtTheEnd(is_so) | When::Eventually(is_so) => !is_so(&self.rule, &self.here, &state()),
            When::AgainAndAgain(owed) => owed(&self.rule, &self.here, &state()) != 0,
        }
    }

    fn alike(&self, state: &[u8]) -> Vec<StateBytes> {
        self.rule.alike(&self.here, &read::<P>(state)).iter().map(|other| self.packed(other)).collect()
    }

    fn title(&self, state: &[u8], number: usize) -> String {
        let moves = self.rule.moves(&self.here, &read::<P>(state));
        let title = |made: &Move<P::State>| match made.maker() {
            Some(maker) => format!("{} {}", self.rule.actor(maker), made.words),
            None => made.words.to_owned(),
        };
        moves.get(number).map_or_else(String::new, title)
    }

    fn draw(&self, state: &[u8]) -> String {
        self.rule.draw(&self.here, &read::<P>(state))
    }

    fn words(&self, state: &[u8]) -> String {
        self.rule.words(&read::<P>(state))
    }

    fn lost_after(&self, state: &[u8]) -> Option<String> {
        let moves = self.rule.moves(&self.here, &read::<P>(state));
        let lost = moves.iter().find(|made| read::<P>(&bytes(&made.to)) != made.to);
        lost.map(|made| self.lost(&made.to))
    }

    fn fault(&self) -> Option<&str> {
        self.fault.get().map(String::as_str)
    }
}

/// The bytes of which most states have no more.
const SOME: usize = 32;

fn bytes(state: &impl Compact) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(SOME);
    state.write(&mut bytes);
    bytes
}

fn read<P: Protocol>(mut bytes: &[u8]) -> P::State {
    P::State::read(&mut bytes)
}
