//! Bad input: rules and bounds of which no verdict may be believed.

use std::sync::atomic::{AtomicU8, Ordering};

use tautline_library::{dijkstra, gathering, ricart};
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::decide::{Depiction, Method, RandomRuns, Verdict};
use tautline_proofs::engine::states::Limits;
use tautline_proofs::ledger;
use tautline_proofs::protocol::{Compact, Keeps, Move, Protocol, Ring, Start};
use tautline_proofs::team::{Crew, Deployment, Graphs, Kind, Moves};
use tautline_proofs::{bound, demands};

/// A number that a move makes larger, up to 9.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Counter {
    AsItSays,
    /// A move looks at a count that is none of its arguments.
    LooksElsewhere,
}

bound! { Starts { starts: u8 } "{starts} starts" }

/// A number of whose bytes a bit is lost.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Number(u8);

impl Compact for Number {
    fn write(&self, to: &mut Vec<u8>) {
        to.push(self.0 & 0x7f);
    }

    fn read(from: &mut &[u8]) -> Self {
        Self(u8::read(from))
    }
}

static CALLS: AtomicU8 = AtomicU8::new(0);

impl Protocol for Counter {
    type Bound = Starts;
    type State = Number;
    demands! { at_the_end "it is 9", |_, _, number| number.0 == 9; }

    fn starts(&self, here: &Starts) -> impl IntoIterator<Item = Number> {
        (0..here.starts).map(|start| Number(100 * start))
    }

    fn moves(&self, _: &Starts, &Number(number): &Number) -> Vec<Move<Number>> {
        let by = match self {
            Self::AsItSays => 1,
            Self::LooksElsewhere => 1 + CALLS.fetch_add(1, Ordering::Relaxed) % 2,
        };
        (number < 9).then(|| Move::of(0, "counts", Number(number + by))).into_iter().collect()
    }
}

fn refused<P: Protocol>(rule: &P, bound: P::Bound, demand: usize) -> String {
    Keeps::<P>(bound, demand).search(rule, Limits::NONE).expect_err("it is refused").to_string()
}

#[test]
fn a_rule_whose_step_is_not_a_function_of_its_arguments_is_refused() {
    let words = "from one state a step led to two: a rule may depend on nothing but its arguments";
    assert_eq!(refused(&Counter::LooksElsewhere, Starts::of(1), 0), words);
}

#[test]
fn a_state_that_does_not_come_back_from_its_bytes_is_refused() {
    let words = "the state Number(200) does not come back from its bytes";
    assert_eq!(refused(&Counter::AsItSays, Starts::of(3), 0), words);
}

#[test]
fn bounds_without_room_and_demands_that_there_are_not_are_refused() {
    let ring = Ring { nodes: 2, ..gathering::row(3, Moves::Together) };
    assert_eq!(refused(&gathering::RULE, ring, 0), "the ring has no room for the robots");
    for (nodes, robots) in [(200, 3), (17, 17)] {
        let ring = Ring { nodes, ..gathering::row(robots, Moves::Together) };
        assert_eq!(refused(&gathering::RULE, ring, 0), "a ring has at most 16 robots and 128 nodes");
    }
    for (places, robots, words) in
        [(&[0, 2][..], 3, "[0, 2]"), (&[0, 9], 2, "[0, 9]"), (&[1, 1], 2, "[1, 1]")]
    {
        let ring = Ring { nodes: 9, starts: Start::At(places), ..gathering::row(robots, Moves::Together) };
        let words = format!(
            "{robots} robots of a ring of 9 nodes do not start at first in {words}: each has a node of its own"
        );
        assert_eq!(refused(&gathering::RULE, ring, 0), words);
    }
    assert_eq!(refused(&ricart::RULE, ricart::Net::of(9, 0), 0), "there are 1 to 8 nodes, not 9");
    for (machines, states, words) in [
        (1, 5, "a ring has two machines or more, of at least two states each"),
        (63, 3, "63 machines of 3 states have too many starts"),
        (1_000_000, 2, "1000000 machines of 2 states have too many starts"),
    ] {
        let machines = dijkstra::Machines::of(machines, states);
        assert_eq!(refused(&dijkstra::Rule::Published, machines, 0), words);
    }
    assert_eq!(refused(&Counter::AsItSays, Starts::of(1), 7), "there is no demand 7: the rule has 1");
}

/// Machines are no actors, so that there may be more of them than a protocol has actors.
#[test]
fn a_ring_of_more_than_ten_machines_is_told_machine_by_machine() {
    static CLAUSE: Clause = Clause {
        id: "RING-1",
        sentence: "There MUST be one privilege.",
        checks: &[&Check::refuted(
            NamedRule::new("too few states", dijkstra::Rule::Published),
            &Keeps::<dijkstra::Rule>(dijkstra::Machines::of(17, 2), 1),
        )],
    };
    let rows = ledger::decide_all(&[&CLAUSE]).expect("it is decided");
    let Some(Depiction::Story(story)) = rows[0].decision.counterexample.as_ref().map(|found| &found.seen)
    else {
        panic!("{rows:?}")
    };
    assert!((0..17).all(|machine| story.contains(&format!("{machine} acts"))), "{story}");
}

/// The set of all eight nodes fits into its byte.
#[test]
fn the_largest_net_that_is_not_refused_is_searched() {
    let found = Keeps(ricart::Net::of(8, 0), 0).search(&ricart::RULE, Limits::steps(10_000));
    let found = found.expect("eight nodes are within the bound");
    assert_eq!((found.is_whole, found.broken), (false, vec![]));
}

/// A number that grows beyond its bytes, long after the states that are tried first; or does not.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Grows {
    Beyond,
    UpTo900,
}

#[derive(Clone, PartialEq, Eq, Debug)]
struct Wide(u16);

impl Compact for Wide {
    fn write(&self, to: &mut Vec<u8>) {
        self.0.min(900).write(to);
    }

    fn read(from: &mut &[u8]) -> Self {
        Self(u16::read(from))
    }
}

impl Protocol for Grows {
    type Bound = Starts;
    type State = Wide;
    demands! { always "it is below 1000", |_, _, _, number| number.0 < 1000; }

    fn starts(&self, here: &Starts) -> impl IntoIterator<Item = Wide> {
        (0..here.starts).map(|start| Wide(start.into()))
    }

    fn moves(&self, _: &Starts, &Wide(number): &Wide) -> Vec<Move<Wide>> {
        let grown = match self {
            Self::Beyond => Wide(number + 1),
            Self::UpTo900 => Wide((number + 1).min(900)),
        };
        vec![Move::of(0, "waits", Wide(number)), Move::of(0, "grows", grown)]
    }
}

#[test]
fn a_state_that_is_lost_deep_in_a_search_is_refused() {
    let refused = refused(&Grows::Beyond, Starts::of(1), 0);
    assert!(refused.ends_with("does not come back from its bytes"), "{refused}");
}

#[test]
fn a_hunt_that_meets_a_state_that_is_lost_is_refused() {
    let hunt = |rule, most_moves| {
        let runs = RandomRuns { runs: 20, seed: 7, most_moves };
        Keeps::<Grows>(Starts::of(1), 0).hunt(&rule, &runs).map(|found| found.expect("an answer").verdict)
    };
    assert_eq!(hunt(Grows::UpTo900, 2000), Ok(Verdict::Unrefuted));
    let refused = hunt(Grows::Beyond, 2000).expect_err("it is refused").to_string();
    assert!(refused.ends_with("does not come back from its bytes"), "{refused}");
}

#[test]
fn a_rule_of_which_a_state_is_lost_gets_no_certificate_and_that_of_another_rule_is_not_accepted_for_it() {
    static CHECK: Keeps<Grows> = Keeps(Starts::of(1), 0);
    static BEYOND: Clause = Clause {
        id: "GROWS-1",
        sentence: "The number MUST be below 1000.",
        checks: &[&Check::new(NamedRule::new("grows", Grows::Beyond), &CHECK, Verdict::Holds, &[])],
    };
    static UP_TO_900: Clause = Clause {
        checks: &[&Check::new(NamedRule::new("grows", Grows::UpTo900), &CHECK, Verdict::Holds, &[])],
        ..BEYOND
    };
    let none =
        ledger::certificate(&BEYOND, 0, Limits::NONE).map(|bytes| bytes.len()).map_err(|why| why.to_string());
    assert_eq!(none, Err("a state does not come back from its bytes".to_owned()));
    let other = ledger::certificate(&UP_TO_900, 0, Limits::NONE).expect("it holds");
    let refusal = |clause| match ledger::examine(&other, [clause]) {
        Ok(examined) => examined.outcome.err().map(|(_, refusal)| refusal.to_string()),
        Err(mismatch) => Some(mismatch.to_string()),
    };
    assert_eq!(refusal(&UP_TO_900), None);
    let refused = refusal(&BEYOND).expect("it is refused");
    assert!(refused.ends_with("a state does not come back from its bytes"), "{refused}");
}

/// More starts than the states that are tried first, of which a late one does not come back.
#[derive(Clone, Copy, PartialEq, Eq)]
struct ManyStarts;

impl Protocol for ManyStarts {
    type Bound = Starts;
    type State = Wide;
    demands! { always "it is below 1000", |_, _, _, number| number.0 < 1000; }

    fn starts(&self, _: &Starts) -> impl IntoIterator<Item = Wide> {
        (0..=999).map(Wide)
    }

    fn moves(&self, _: &Starts, &Wide(number): &Wide) -> Vec<Move<Wide>> {
        (number == 999).then(|| Move::of(0, "grows", Wide(1000))).into_iter().collect()
    }
}

#[test]
fn a_start_that_is_lost_is_refused_although_many_are_before_it() {
    let refused = refused(&ManyStarts, Starts::of(1), 0);
    assert!(refused.ends_with("does not come back from its bytes"), "{refused}");
}

fn are_as_registered(clause: &'static Clause) {
    for row in ledger::decide_all(&[clause]).expect("they can be decided") {
        assert!(row.is_as_registered(), "{:?}", row.decision);
    }
}

/// A robot that stays where it is.
#[derive(Clone, Copy)]
struct Stays;

impl Protocol for Stays {
    type Bound = Crew;
    type State = Vec<u8>;
    demands! { at_the_end "it is somewhere", |_, _, robots| !robots.is_empty(); }

    fn starts(&self, crew: &Deployment) -> impl IntoIterator<Item = Vec<u8>> {
        crew.graph.places(crew.robots)
    }

    fn moves(&self, _: &Deployment, _: &Vec<u8>) -> Vec<Move<Vec<u8>>> {
        Vec::new()
    }
}

#[test]
fn a_check_over_no_layout_with_room_for_the_robots_is_open() {
    const fn crew(robots: usize) -> Keeps<Stays> {
        let graphs = Graphs::within(Kind::Biconnected, 3, 2);
        Keeps(Crew { robots, graphs }, 0)
    }
    static FITS: Keeps<Stays> = crew(6);
    static TOO_MANY: Keeps<Stays> = crew(7);
    const STAYS: NamedRule<Stays> = NamedRule::new("stays", Stays);
    static BOTH: Clause = Clause {
        id: "STAY-1",
        sentence: "Robots MUST be somewhere.",
        checks: &[
            &Check::new(STAYS, &FITS, Verdict::Holds, &[]),
            &Check::new(STAYS, &TOO_MANY, Verdict::Open, &[]),
        ],
    };
    are_as_registered(&BOTH);
}

#[test]
fn a_check_over_no_start_is_open() {
    const PLAIN: NamedRule<Counter> = NamedRule::new("plain", Counter::AsItSays);
    static NONE: Clause = Clause {
        id: "COUNT-1",
        sentence: "The count MUST be 9 in the end.",
        checks: &[
            &Check::new(PLAIN, &Keeps(Starts::of(0), 0), Verdict::Open, &[]),
            &Check::new(PLAIN, &Keeps(Starts::of(1), 0), Verdict::Holds, &[]),
        ],
    };
    are_as_registered(&NONE);
}
