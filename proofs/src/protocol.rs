//! A rule over states: what may happen next in each of them. Whoever implements [`Protocol`] says which states there
//! are and how one looks; the search over all of them, weak fairness, replay and drawings follow ([`Keeps`]). A rule of
//! one robot among others on cells is better brought as a [`Rule`](crate::team::Rule), in a setting.
//!
//! An actor is awake in a state if one of its moves is possible there. A run is weakly fair if it leaves out nobody who
//! is awake throughout.

mod any_protocol;
mod bound;
mod check;
mod compact;
mod exploration;
mod film;
mod mail;
mod playing;
mod ring;

use std::fmt::Debug;
use std::iter;

pub use self::bound::Bound;
pub use self::check::Keeps;
pub use self::compact::Compact;
pub use self::exploration::{Exploration, Explorers, Team};
pub use self::film::{beside, names};
pub use self::mail::{Letter, Mail};
pub use self::ring::{Ring, Start, Walker};
use crate::engine::states::Bits;

/// The surroundings of a protocol: one of those that its bound has.
pub type Surroundings<P> = <<P as Protocol>::Bound as Bound>::Surroundings;

/// A rule over states, of which a mutant is another value.
pub trait Protocol: Clone + Sync + 'static {
    /// All surroundings within which the rule is looked at.
    type Bound: Bound;
    /// All that changes. What is made of numbers, of words (`compact!`), of lists of them is [`Compact`].
    type State: Clone + Eq + Compact + Debug + Send + Sync;

    /// The demands.
    const DEMANDS: &'static [Demand<Self>];
    /// The moves that must occur, by their words: where one does not, a check is open.
    const COVERS: &'static [&'static str] = &[];

    /// The states in which runs begin in these surroundings, always in the same order.
    fn starts(&self, here: &Surroundings<Self>) -> impl IntoIterator<Item = Self::State>;

    /// Every move that is possible in `state`, always in the same order. If there is none, the run is over.
    fn moves(&self, here: &Surroundings<Self>, state: &Self::State) -> Vec<Move<Self::State>>;

    /// The other states that are taken for one with `state`: the same robots in another order, say, or the floor
    /// turned. From each of them the same moves of the same actors, in the same words, lead to states that are taken
    /// for one, and each demand says the same of them. A check tries that on the first few states, and is refused where
    /// it is not so. None, unless there is more to tell.
    fn alike(&self, _: &Surroundings<Self>, _: &Self::State) -> Vec<Self::State> {
        Vec::new()
    }

    /// The name of the actor with this number, or of whoever else a move is said to be made by ([`Move::by()`]), above
    /// a drawing of the move: the number, unless there is more to tell.
    fn actor(&self, number: usize) -> String {
        number.to_string()
    }

    /// A drawing of `state`, in lines.
    fn draw(&self, _: &Surroundings<Self>, state: &Self::State) -> String {
        self.words(state)
    }

    /// The words of `demand` in what is said and stored of it.
    fn demand_words(&self, demand: &Demand<Self>) -> &'static str {
        demand.words
    }

    /// The words for `state` in what is said of a protocol that is refused.
    fn words(&self, state: &Self::State) -> String {
        format!("{state:?}")
    }
}

/// A move to another state.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Move<S> {
    /// The actors, a bit for each. With none of them it is a fault, which no run is bound to meet, and no run
    /// meets for ever: an endless run is looked at from its last fault on.
    pub actors: Bits,
    /// The move in words.
    pub words: &'static str,
    /// The state to which it leads.
    pub to: S,
    /// The number of whoever is said to make it, if that is another one than its actor: see [`Self::by()`].
    pub by: Option<usize>,
    /// A number that no actor can have, for which a check is refused.
    no_actor: Option<usize>,
}

impl<S> Move<S> {
    /// A move of one actor, which has a number from 0 to 15: else a check is refused.
    pub const fn of(actor: usize, words: &'static str, to: S) -> Self {
        let is_one = actor < Bits::BITS as usize;
        let (actors, no_actor) = if is_one { (1 << actor, None) } else { (0, Some(actor)) };
        Self { actors, words, to, by: None, no_actor }
    }

    /// A move of so many actors at once, at most 16: else a check is refused.
    pub const fn of_all(actors: usize, words: &'static str, to: S) -> Self {
        let are_few = actors <= Bits::BITS as usize;
        let (actors, no_actor) =
            if are_few { (((1_u32 << actors) - 1) as Bits, None) } else { (0, Some(actors - 1)) };
        Self { actors, words, to, by: None, no_actor }
    }

    /// A move of these actors at once, a bit for each: see [`set`].
    pub const fn of_set(actors: Bits, words: &'static str, to: S) -> Self {
        Self { actors, words, to, by: None, no_actor: None }
    }

    /// A fault.
    pub const fn fault(words: &'static str, to: S) -> Self {
        Self::of_set(0, words, to)
    }

    /// The move, said to be made by whoever has this number, which may be any. So a story tells machines apart that are
    /// one actor, as no run need be fair to each of them.
    #[must_use]
    pub fn by(self, number: usize) -> Self {
        Self { by: Some(number), ..self }
    }

    /// The number of whoever is said to make it, or of its only actor.
    fn maker(&self) -> Option<usize> {
        self.by.or_else(|| self.actors.is_power_of_two().then(|| self.actors.trailing_zeros() as usize))
    }

    /// The move, if it is possible.
    pub fn when(self, is_possible: bool) -> Option<Self> {
        is_possible.then_some(self)
    }
}

/// The set of these, a bit for each.
///
/// # Panics
/// If one is above 15.
pub fn set(members: impl IntoIterator<Item = usize>) -> Bits {
    members.into_iter().fold(0, |set, member| {
        assert!(member < Bits::BITS as usize, "a set has members from 0 to 15, not {member}");
        set | 1 << member
    })
}

/// Every way to put so many of these in a row, none of them twice, the last one changing first.
pub fn arrangements<T: Copy + PartialEq>(all: &[T], length: usize) -> Vec<Vec<T>> {
    let with = |row: Vec<T>| {
        let others = all.iter().filter(|one| !row.contains(one));
        others.map(|&one| [&row[..], &[one]].concat()).collect::<Vec<_>>()
    };
    (0..length).fold(vec![Vec::new()], |rows, _| rows.into_iter().flat_map(with).collect())
}

/// Every way to take one of each of these, the last one changing first.
pub fn combinations<T: Clone>(choices: impl IntoIterator<Item = Vec<T>>) -> impl Iterator<Item = Vec<T>> {
    let choices: Vec<Vec<T>> = choices.into_iter().collect();
    let count: usize = choices.iter().map(Vec::len).product();
    (0..count).map(move |mut number| {
        let mut left = count;
        let take = |choices: &Vec<T>| {
            left /= choices.len();
            let taken = choices[number / left].clone();
            number %= left;
            taken
        };
        choices.iter().map(take).collect()
    })
}

/// These, with another one in this place.
pub fn with<T: Clone>(all: &[T], place: usize, new: T) -> Vec<T> {
    let mut all = all.to_vec();
    all[place] = new;
    all
}

/// A state whose floor is turned by one, two and three quarters.
pub fn turned<S>(state: &S, quarter: impl Fn(&S) -> S) -> Vec<S> {
    iter::successors(Some(quarter(state)), |before| Some(quarter(before))).take(3).collect()
}

/// When a demand is looked at.
enum When<P: Protocol> {
    Always(fn(&P, &Surroundings<P>, &P::State, &P::State) -> bool),
    AtTheEnd(fn(&P, &Surroundings<P>, &P::State) -> bool),
    Eventually(fn(&P, &Surroundings<P>, &P::State) -> bool),
    AgainAndAgain(fn(&P, &Surroundings<P>, &P::State) -> Bits),
}

/// A demand on a protocol.
pub struct Demand<P: Protocol> {
    words: &'static str,
    when: When<P>,
}

impl<P: Protocol> Demand<P> {
    /// Of every move, from a state to the next one.
    pub const fn always(
        words: &'static str,
        is_kept: fn(&P, &Surroundings<P>, &P::State, &P::State) -> bool,
    ) -> Self {
        Self { words, when: When::Always(is_kept) }
    }

    /// Of the end of every run that ends.
    pub const fn at_the_end(
        words: &'static str,
        is_kept: fn(&P, &Surroundings<P>, &P::State) -> bool,
    ) -> Self {
        Self { words, when: When::AtTheEnd(is_kept) }
    }

    /// That this is so at some time in every run that is weakly fair.
    pub const fn eventually(words: &'static str, is_so: fn(&P, &Surroundings<P>, &P::State) -> bool) -> Self {
        Self { words, when: When::Eventually(is_so) }
    }

    /// That no weakly fair run comes to owe one of these, a bit for each, from some time on for ever.
    pub const fn again_and_again(
        words: &'static str,
        owed: fn(&P, &Surroundings<P>, &P::State) -> Bits,
    ) -> Self {
        Self { words, when: When::AgainAndAgain(owed) }
    }
}

/// Makes the demands of a [`Protocol`](crate::protocol::Protocol), in its block, each by the name of a function of
/// [`Demand`](crate::protocol::Demand): `demands! { eventually "all are there", |rule, here, state| state.0; }`. The
/// last `;` may be left out.
#[macro_export]
macro_rules! demands {
    ($($when:ident $words:expr, $asked:expr);+ $(;)?) => {
        const DEMANDS: &'static [$crate::protocol::Demand<Self>] =
            &[$($crate::protocol::Demand::<Self>::$when($words, $asked)),+];
    };
}
