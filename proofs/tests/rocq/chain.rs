//! The answers of the chain's admission relation to every question about neighbours that can be asked, with the lattice
//! that it stands on, the bytes of messages, and when a robot goes on along a walk.

use tautline_kernel::chain::{Condition, Message, Move, Outcome, Role, Rule, goes_on};
use tautline_kernel::ground::{Cell, Circle, Edge, Side, Step, neighbours};

use super::term::{at, bits, cell, definition, edge, everywhere, list, offsets};

/// Neighbours in E_C are at most 2 apart, and planned places a step farther each. One is to spare.
const REACH: i16 = 5;

const ORIGIN: Cell = Cell::new(0, 0);

/// The rules, with the names that the proofs have for them.
fn rules() -> Vec<(String, Rule)> {
    use Condition::{CoveredBehind, FullForFollower, FullForLeader, SafeAhead, UnsureAhead};
    let mutants = [SafeAhead, CoveredBehind, UnsureAhead, FullForFollower, FullForLeader]
        .map(|condition| (format!("without_{condition:?}"), Rule::REPAIRED.without(condition)));
    let ours = [("PUBLISHED", Rule::PUBLISHED), ("REPAIRED", Rule::REPAIRED), ("REEL", Rule::REEL)];
    ours.map(|(name, rule)| (name.to_owned(), rule)).into_iter().chain(mutants).collect()
}

pub(super) fn terms() -> String {
    let mut text = definition("reach", "Z", &format!("{REACH}%Z"));
    text += &lattice();
    for (name, rule) in rules() {
        text += &relation(&name, &rule);
    }
    text += &messages();
    text += &walks();
    text
}

/// A bit for each offset, row by row.
fn of_offsets(ask: impl Fn(Cell, Cell) -> bool) -> String {
    let answers: Vec<bool> =
        offsets(REACH).map(|offset| everywhere(|cell| ask(cell, at(cell, offset)))).collect();
    bits(&answers)
}

fn lattice() -> String {
    let mut text = String::new();
    text += &definition("in_E_N", "N", &of_offsets(neighbours));
    text += &definition("covers_SAFE", "N", &of_offsets(|round, cell| Circle::SAFE.covers(round, cell)));
    text +=
        &definition("covers_COVERED", "N", &of_offsets(|round, cell| Circle::COVERED.covers(round, cell)));
    text +=
        &definition("reaches_COVERED", "N", &of_offsets(|round, cell| Circle::COVERED.reaches(round, cell)));
    let leads = Step::ALL.map(|step| {
        let to = ORIGIN.after(step);
        assert!(everywhere(|cell| cell.after(step) == at(cell, (to.x, to.y))));
        cell(to)
    });
    text += &definition("leads", "list (Z * Z)", &format!("{}%Z", list(leads)));
    let back = Step::ALL.map(|step| step.reverse().place().to_string());
    text += &definition("back", "list nat", &format!("{}%nat", list(back)));
    let edges = Side::ALL.map(|side| {
        let here = Edge::new(ORIGIN, side);
        assert!(everywhere(|cell| {
            let there = Edge::new(cell, side);
            there.cell() == at(cell, here.cell().into()) && there.side() == here.side()
        }));
        edge(here)
    });
    text += &definition("edges", "list ((Z * Z) * bool)", &format!("{}%Z", list(edges)));
    text
}

fn relation(name: &str, rule: &Rule) -> String {
    // For the robot ahead at each offset a number: a bit for each step of the robot behind, each step of the robot
    // ahead, and whether its side is known to be open.
    let ahead = offsets(REACH).map(|offset| {
        let mut answers = Vec::new();
        for step in Step::ALL {
            for step_ahead in Step::ALL {
                for known_open in [false, true] {
                    answers.push(everywhere(|cell| {
                        let ahead = Move { from: at(cell, offset), step: step_ahead, known_open };
                        let own = |known_open| Move { from: cell, step, known_open };
                        let answer = rule.admits_ahead(own(false), ahead);
                        assert_eq!(answer, rule.admits_ahead(own(true), ahead), "its own side plays no part");
                        answer
                    }));
                }
            }
        }
        bits(&answers)
    });
    let mut text = definition(&format!("ahead_{name}"), "list N", &list(ahead));
    let behind = of_offsets(|to, behind| rule.admits_behind(to, behind));
    text += &definition(&format!("behind_{name}"), "N", &behind);
    let entry: Vec<bool> = [Role::Leader, Role::Follower]
        .into_iter()
        .flat_map(|role| (0..256).map(move |occupants| rule.admits_entry(role, occupants)))
        .collect();
    text + &definition(&format!("entry_{name}"), "N", &bits(&entry))
}

/// The meaning of each byte: 0 if it is no message, else one more than three times the step's place and the outcome's.
fn messages() -> String {
    let word = |byte| {
        let Ok(message) = Message::decode(byte) else { return 0 };
        assert_eq!(message.encode(), byte, "a message is encoded in one way");
        let outcome = match message.outcome {
            Outcome::Arrived => 0,
            Outcome::Blocked => 1,
            Outcome::TookBack => 2,
        };
        1 + 3 * message.step.place() + outcome
    };
    let words = (0..=u8::MAX).map(|byte| word(byte).to_string());
    definition("words", "list nat", &format!("{}%nat", list(words)))
}

/// Whether a robot goes on, by the cells that it has gone, its last one, and those that the robot ahead is planned to
/// have gone.
fn walks() -> String {
    let mut answers = Vec::new();
    for own in 0..8 {
        for last in 0..8 {
            for ahead in 0..8 {
                answers.push(goes_on(own, last, ahead));
            }
        }
    }
    definition("going_on", "N", &bits(&answers))
}
