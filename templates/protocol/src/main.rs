//! A rule over states to begin with: what may happen next in each of them. Copy this folder, and change the rule, its
//! bound and its promises. `cargo run` decides the promises, `cargo test` holds the verdicts.
//!
//! A robot hands a load to another one: it offers the load, and holds it until it hears that the other robot does. As a
//! message may be lost, it offers again when nothing is under way.

use std::process::ExitCode;

use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::ledger::{self, Row};
use tautline_proofs::protocol::{Keeps, Letter, Mail, Move, Protocol};
use tautline_proofs::{bound, compact, demands};

/// The rule. What can be wrong with it is a field, so that a mutant is another value.
#[derive(Clone, Copy)]
struct HandOver {
    /// Whether the giver holds the load until it hears that the other robot does.
    waits: bool,
    /// Whether it offers again when nothing is under way.
    repeats: bool,
}

bound! {
    /// The surroundings in which the rule is looked at.
    Radio { losses: u32 }
    "two robots, every order of messages, at most {losses} lost"
}

compact! {
    /// A message.
    enum Message { Offer, Taken }
}

/// All that changes.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct State {
    giver_holds: bool,
    has_offered: bool,
    taker_holds: bool,
    mail: Mail<Message>,
}

compact! { State { giver_holds, has_offered, taker_holds, mail } }

/// The numbers of the robots.
const GIVER: usize = 0;
const TAKER: usize = 1;

impl HandOver {
    /// The state after a message has arrived, which is no longer in the mail.
    fn hear(before: &State, (_, _, message): Letter<Message>, mail: Mail<Message>) -> State {
        let mut after = State { mail, ..before.clone() };
        match message {
            Message::Offer => {
                after.taker_holds = true;
                after.mail.send((TAKER, GIVER, Message::Taken));
            }
            Message::Taken => after.giver_holds = false,
        }
        after
    }
}

impl Protocol for HandOver {
    type Bound = Radio;
    type State = State;
    demands! {
        always "somebody holds the load", |_, _, _, after| after.giver_holds || after.taker_holds;
        eventually "the taker alone holds the load", |_, _, now| now.taker_holds && !now.giver_holds;
    }
    const COVERS: &'static [&'static str] = &["offers", "hears", "a message is lost"];

    fn starts(&self, radio: &Radio) -> impl IntoIterator<Item = State> {
        let mail = Mail::new(radio.losses);
        [State { giver_holds: true, has_offered: false, taker_holds: false, mail }]
    }

    fn moves(&self, _: &Radio, now: &State) -> Vec<Move<State>> {
        let is_quiet = now.mail.under_way().is_empty();
        let may_offer = !now.has_offered || self.repeats && is_quiet && now.giver_holds;
        let mut offered = State { has_offered: true, giver_holds: self.waits, ..now.clone() };
        offered.mail.send((GIVER, TAKER, Message::Offer));
        let offer = Move::of(GIVER, "offers", offered).when(may_offer);
        let hear = |letter, mail| Self::hear(now, letter, mail);
        let arrivals = now.mail.moves(hear, |mail| State { mail, ..now.clone() });
        offer.into_iter().chain(arrivals).collect()
    }

    fn draw(&self, _: &Radio, now: &State) -> String {
        let holds = |holds: bool| if holds { "holds the load" } else { "-" };
        let robots = format!("giver {}\ntaker {}\n", holds(now.giver_holds), holds(now.taker_holds));
        now.mail.lines(|message| format!("{message:?}")).fold(robots, |lines, line| lines + &line)
    }
}

const OURS: NamedRule<HandOver> = NamedRule::new("ours", HandOver { waits: true, repeats: true });
const HASTY: NamedRule<HandOver> =
    NamedRule::new("lets go at once", HandOver { waits: false, repeats: true });
const ONCE: NamedRule<HandOver> = NamedRule::new("offers once", HandOver { waits: true, repeats: false });

/// The promises, each with the verdict that you expect and mutants that must be rejected.
static CLAUSES: [Clause; 2] = [
    Clause {
        id: "HAND-1",
        sentence: "Somebody MUST hold the load.",
        checks: &[&Check::holds(OURS, &Keeps(Radio::of(2), 0), &[HASTY])],
    },
    Clause {
        id: "HAND-2",
        sentence: "The taker alone MUST hold the load at last.",
        checks: &[&Check::holds(OURS, &Keeps(Radio::of(2), 1), &[ONCE])],
    },
];

fn decided() -> Vec<Row> {
    let clauses = ledger::register(&[&CLAUSES]).expect("each clause has an id of its own");
    ledger::decide_all(&clauses).expect("the bound is small enough to search")
}

fn main() -> ExitCode {
    let rows = decided();
    print!("{}", ledger::table(&rows));
    if rows.iter().all(Row::is_as_registered) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_verdict_is_the_registered_one() {
        for row in decided() {
            assert!(row.is_as_registered(), "{}: {:?}", row.clause.id, row.decision);
        }
    }
}
