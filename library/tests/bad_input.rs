//! Bad input: rules and bounds of which no verdict may be believed.

use std::fmt;
use std::sync::atomic::{AtomicU8, Ordering};

use tautline_library::{dijkstra, gathering, ricart};
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::decide::{MethodError, Verdict};
use tautline_proofs::engine::states::Limits;
use tautline_proofs::ledger;
use tautline_proofs::protocol::{Compact, Demand, Keeps, Move, Protocol};
use tautline_proofs::team::Moves;

/// A number that a move makes larger, up to 9.
struct Counter(Rule, u8);

#[derive(Clone, Copy, PartialEq, Eq)]
enum Rule {
    AsItSays,
    /// A move looks at a count that is none of its arguments.
    LooksElsewhere,
}

/// How many starts there are.
struct Starts(u8);

impl fmt::Display for Starts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} starts", self.0)
    }
}

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
    type Rule = Rule;
    type Bound = Starts;
    type State = Number;
    const DEMANDS: &'static [Demand<Self>] =
        &[Demand::at_the_end("it is 9", |_, number: &Number| number.0 == 9)];

    fn new(&rule: &Rule, &Starts(starts): &Starts) -> Result<Self, MethodError> {
        Ok(Self(rule, starts))
    }

    fn starts(&self) -> impl Iterator<Item = Number> {
        (0..self.1).map(|start| Number(100 * start))
    }

    fn moves(&self, &Number(number): &Number) -> Vec<Move<Number>> {
        let by = match self.0 {
            Rule::AsItSays => 1,
            Rule::LooksElsewhere => 1 + CALLS.fetch_add(1, Ordering::Relaxed) % 2,
        };
        (number < 9).then(|| Move::of(0, "counts", Number(number + by))).into_iter().collect()
    }

    fn draw(&self, number: &Number) -> String {
        number.0.to_string()
    }
}

fn refused<P: Protocol>(rule: &P::Rule, bound: P::Bound, demand: usize) -> String {
    Keeps::<P>(bound, demand).search(rule, Limits::NONE).expect_err("it is refused").to_string()
}

#[test]
fn a_rule_whose_step_is_not_a_function_of_its_arguments_is_refused() {
    let words = "from one state a step led to two: a rule may depend on nothing but its arguments";
    assert_eq!(refused::<Counter>(&Rule::LooksElsewhere, Starts(1), 0), words);
}

#[test]
fn a_state_that_does_not_come_back_from_its_bytes_is_refused() {
    let words = "the state Number(200) does not come back from its bytes";
    assert_eq!(refused::<Counter>(&Rule::AsItSays, Starts(3), 0), words);
}

#[test]
fn bounds_without_room_and_demands_that_there_are_not_are_refused() {
    assert_eq!(
        refused::<gathering::Ring>(&gathering::RULE, gathering::Row(2, 3, Moves::Together), 0),
        "the ring has no room for the robots"
    );
    assert_eq!(
        refused::<ricart::Nodes>(&ricart::RULE, ricart::Net(9, 0), 0),
        "there are 1 to 8 nodes, not 9"
    );
    let (rule, ring) = (dijkstra::Rule::Published, dijkstra::Ring(1, 5));
    assert_eq!(
        refused::<dijkstra::Machines>(&rule, ring, 0),
        "a ring has at least two machines of two states"
    );
    assert_eq!(refused::<Counter>(&Rule::AsItSays, Starts(1), 7), "there is no demand 7");
}

#[test]
fn a_check_over_no_start_is_open() {
    static NONE: Clause = Clause {
        id: "COUNT-1",
        sentence: "The count MUST be 9 in the end.",
        checks: &[
            &Check::new(
                NamedRule::new("plain", Rule::AsItSays),
                &Keeps::<Counter>(Starts(0), 0),
                Verdict::Open,
                &[],
            ),
            &Check::new(
                NamedRule::new("plain", Rule::AsItSays),
                &Keeps::<Counter>(Starts(1), 0),
                Verdict::Holds,
                &[],
            ),
        ],
    };
    let rows = ledger::decide_all(&[&NONE]).expect("they can be decided");
    assert!(
        rows.iter().all(ledger::Row::is_as_registered),
        "{:?}",
        rows.iter().map(|row| &row.decision).collect::<Vec<_>>()
    );
}
