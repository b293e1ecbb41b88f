//! Weak fairness, and promises that must be kept at some time or again and again: on random small systems the search
//! over states finds what a naive checker finds. The naive one goes on from every state along every walk, and remembers
//! of a walk who was awake in all of its states and who has acted; it knows no components.

use std::collections::{HashMap, HashSet, VecDeque};
use std::fmt;

use tautline_kernel::choice::Oracle;
use tautline_proofs::decide::{Method, MethodError};
use tautline_proofs::demands;
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::engine::states::{Bits, Ending, Findings, Limits, Run};
use tautline_proofs::protocol::{Bound, Keeps, Move, Protocol};

/// The number of a random system.
struct Number(u64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "system {}", self.0)
    }
}

/// At most eight states, three actors and faults, and of each state which of two things are owed there.
struct Random {
    moves: Vec<Vec<Move<u8>>>,
    owed: Vec<Bits>,
}

impl Bound for Number {
    type Surroundings = Random;

    fn each(&self) -> Result<Vec<Random>, MethodError> {
        Ok(vec![Random::new(self.0)])
    }
}

/// The rule of a random system, which knows nothing.
#[derive(Clone, Copy)]
struct Any;

impl Protocol for Any {
    type Bound = Number;
    type State = u8;
    demands! {
        again_and_again "nothing is owed for ever", |_, system, &state| system.owed[usize::from(state)];
        eventually "nothing is owed", |_, system, &state| system.owed[usize::from(state)] == 0;
    }

    fn starts(&self, _: &Random) -> impl IntoIterator<Item = u8> {
        [0]
    }

    fn moves(&self, system: &Random, &state: &u8) -> Vec<Move<u8>> {
        system.moves[usize::from(state)].clone()
    }
}

impl Random {
    fn new(number: u64) -> Self {
        let mut any = SeededOracle::new(0, number);
        let states = 2 + any.pick(7);
        let mut moves_of = |_| {
            let count = any.pick(4);
            let mut one = |_| {
                let actors = [0, 1, 2, 4, 1, 2, 4, 3][any.pick(8) as usize];
                Move::of_set(actors, "goes", any.pick(states) as u8)
            };
            (0..count).map(&mut one).collect()
        };
        let moves = (0..states).map(&mut moves_of).collect();
        let owed = (0..states).map(|_| [0, 1, 2, 3, 3, 1][any.pick(6) as usize]).collect();
        Self { moves, owed }
    }

    /// The states that a run gets to, each with the fewest steps. Where something must be so at some time, a run is
    /// over once it is.
    fn distances(&self, until_met: bool) -> HashMap<u8, usize> {
        let (mut found, mut ahead) = (HashMap::from([(0, 0)]), VecDeque::from([0]));
        while let Some(state) = ahead.pop_front() {
            let is_over = until_met && self.owed[usize::from(state)] == 0;
            for next in self.moves[usize::from(state)].iter().filter(|_| !is_over) {
                if !found.contains_key(&next.to) {
                    found.insert(next.to, found[&state] + 1);
                    ahead.push_back(next.to);
                }
            }
        }
        found
    }

    fn awake(&self, state: u8) -> Bits {
        self.moves[usize::from(state)].iter().fold(0, |set, next| set | next.actors)
    }

    /// The fewest steps of a fair walk from a state back to it in which `is_owed` of every state.
    fn shortest_round(&self, home: u8, is_owed: impl Fn(u8) -> bool) -> Option<usize> {
        let first = (home, Bits::MAX, 0);
        let (mut found, mut ahead) = (HashSet::from([first]), VecDeque::from([(first, 0)]));
        while let Some(((state, awake, acted), steps)) = ahead.pop_front() {
            if steps > 0 && state == home && awake & !acted == 0 {
                return Some(steps);
            }
            for next in
                self.moves[usize::from(state)].iter().filter(|next| next.actors != 0 && is_owed(next.to))
            {
                let walk = (next.to, awake & self.awake(state), acted | next.actors);
                if found.insert(walk) {
                    ahead.push_back((walk, steps + 1));
                }
            }
        }
        None
    }

    /// The fewest steps of a round from a state in which the demand is owed throughout.
    fn round(&self, demand: usize, state: u8) -> Option<usize> {
        let owes = |things: Bits| move |state: u8| self.owed[usize::from(state)] & things != 0;
        let of =
            |things: Bits| owes(things)(state).then(|| self.shortest_round(state, owes(things))).flatten();
        if demand == 0 { [of(1), of(2)].into_iter().flatten().min() } else { of(3) }
    }

    /// The fewest steps of a run that stays in a state, or goes round and begins again, and owes something for ever.
    fn shortest_run(&self, demand: usize) -> Option<usize> {
        let stays = |state: u8| {
            self.owed[usize::from(state)] != 0
                && self.moves[usize::from(state)].iter().all(|next| next.actors == 0)
        };
        let all = self.distances(demand == 1);
        let length = |(&state, way): (&u8, &usize)| {
            if stays(state) { Some(*way) } else { Some(way + self.round(demand, state)?) }
        };
        all.iter().filter_map(length).min()
    }

    /// Whether the steps of the round of a run are fair and lead back to its beginning.
    fn plays(&self, demand: usize, run: &Run<&'static str>) -> bool {
        let step = |state: u8, &number: &u32| &self.moves[usize::from(state)][number as usize];
        let home = run.steps.iter().fold(0, |state, number| step(state, number).to);
        let (mut state, mut awake, mut acted, mut owed, mut has_fault) =
            (home, Bits::MAX, 0, Bits::MAX, false);
        for number in run.round() {
            let next = step(state, number);
            awake &= self.awake(state);
            let owes = self.owed[usize::from(state)];
            owed &= if demand == 0 { owes } else { (owes != 0).into() };
            acted |= next.actors;
            has_fault |= next.actors == 0;
            state = next.to;
        }
        state == home && awake & !acted == 0 && owed != 0 && !has_fault
    }
}

#[test]
fn two_thousand_random_systems_are_decided_as_a_naive_checker_decides_them() {
    let (mut stays, mut rounds, mut kept) = (0, 0, 0);
    for (number, demand) in (0..1000).flat_map(|number| [(number, 0), (number, 1)]) {
        let system = Random::new(number);
        let found = Keeps::<Any>(Number(number), demand).search(&Any, Limits::NONE).expect("it is searched");
        assert!(found.is_whole);
        let length = found.broken.first().map(Run::length);
        assert!(found.is_shortest && length == system.shortest_run(demand), "{number}, {demand}");
        let states = system.distances(demand == 1).len() as u64;
        let Some(run) = found.broken.first() else {
            assert_eq!(found.states, states, "{number}, {demand}");
            kept += 1;
            continue;
        };
        match &run.ending {
            Ending::There => panic!("no step is forbidden"),
            Ending::Still => stays += 1,
            Ending::Round(_) => {
                assert!(system.plays(demand, run), "{number}, {demand}");
                rounds += 1;
            }
        }
    }
    assert_eq!((kept, stays, rounds), (376, 1053, 571));
}

/// A random system in three colours, which no move and no demand looks at: a move goes on by so many colours. With
/// `TURNED`, states are taken for one that differ in their colours alone; a mark that a demand looks at spoils that.
#[derive(Clone, Copy)]
struct ColouredSystem<const TURNED: bool>(Option<u8>);

impl<const TURNED: bool> Protocol for ColouredSystem<TURNED> {
    type Bound = Number;
    type State = (u8, u8);
    demands! {
        again_and_again "nothing is owed for ever", |_, system, &(state, _)| system.owed[usize::from(state)];
        eventually "nothing is owed", |_, system, &(state, _)| system.owed[usize::from(state)] == 0;
        always "no step leads to 3, nor to the mark", |rule, _, _, &(state, colour)| {
            state != 3 && rule.0 != Some(colour)
        };
    }

    fn starts(&self, _: &Random) -> impl IntoIterator<Item = (u8, u8)> {
        [(0, 1)]
    }

    fn moves(&self, system: &Random, &(state, colour): &(u8, u8)) -> Vec<Move<(u8, u8)>> {
        let coloured = |(next, by): (&Move<u8>, u8)| {
            let &Move { actors, words, to, .. } = next;
            Move::of_set(actors, words, (to, (colour + by + to) % 3))
        };
        system.moves[usize::from(state)].iter().zip(0..).map(coloured).collect()
    }

    fn alike(&self, _: &Random, &(state, colour): &(u8, u8)) -> Vec<(u8, u8)> {
        if TURNED { [1, 2].map(|by| (state, (colour + by) % 3)).to_vec() } else { Vec::new() }
    }
}

#[test]
fn states_that_are_taken_for_one_change_no_verdict_and_no_length_of_a_run_that_ends() {
    let (mut all, mut least) = (0, 0);
    for (number, demand) in (0..200).flat_map(|number| [0, 1, 2].map(|demand| (number, demand))) {
        let plain = Keeps::<ColouredSystem<false>>(Number(number), demand)
            .search(&ColouredSystem(None), Limits::NONE);
        let plain = plain.expect("a search");
        let (rule, method) = (ColouredSystem(None), Keeps::<ColouredSystem<true>>(Number(number), demand));
        let turned = method.search(&rule, Limits::NONE).expect("a search");
        (all, least) = (all + plain.states, least + turned.states);
        let length = |found: &Findings<&'static str>| found.broken.first().map(Run::length);
        // A round leads back to a state that is taken for its first one: it is one of the system without colours.
        let fewest = if demand == 2 { length(&plain) } else { Random::new(number).shortest_run(demand) };
        assert_eq!(length(&turned), fewest, "{number}, {demand}");
        assert!(
            length(&plain).is_some() == fewest.is_some() && length(&plain) >= fewest,
            "{number}, {demand}"
        );
        if let Some(run) = turned.broken.first() {
            let played = method.replay(&rule, &run.choices()).expect("the run can be played");
            assert_eq!(played.evidence.demand, run.demand);
        }
    }
    assert_eq!((all, least), (2535, 1393));
}

#[test]
fn states_that_are_not_alike_are_not_taken_for_one() {
    let marked = |mark| {
        let method = Keeps::<ColouredSystem<true>>(Number(1), 2);
        method.search(&ColouredSystem(mark), Limits::NONE).map(|found| found.is_whole)
    };
    assert_eq!(marked(None), Ok(true));
    let refused = marked(Some(2)).expect_err("a demand tells them apart").to_string();
    let words = "the states (0, 1) and (0, 2) are taken for one, and are not alike";
    assert_eq!(refused, format!("{words}: the move \"goes\" breaks the demand in one of them"));
}
