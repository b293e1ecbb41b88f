//! Who says what to whom, and when, between two robots (Peiris, section 5). A robot that stands asks the other one, is
//! told at once that the request has come, and waits for the response, which the other one sends while it drives.
//! Clauses: KIT-4, KIT-5.
//!
//! [`Talk`] is a plain value: what arrives makes of one the next, and says what to send. It has no clock:
//! [`Talk::again`] is for the caller's timer.

use super::message::Message;
use super::rule::{Answers, Condition, Rule};
use crate::ground::{Cell, Steps};

/// Requests are numbered from 0 to one less than this, over and over: no message
/// may be on its way while a robot asks twice.
pub const NUMBERS: u8 = 4;

/// The number of the request after the one with this number.
const fn after(number: u8) -> u8 {
    (number + 1) % NUMBERS
}

/// A message with the number of its request.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Letter {
    /// The number; 0 always without [`Condition::Repeats`].
    pub number: u8,
    /// Its content.
    pub message: Message,
}

/// A robot's phase in an exchange.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Phase {
    /// It drives.
    Drives,
    /// It stands and has asked.
    Asks,
    /// It stands, and its request has come.
    Waits,
    /// It stands, has the answer, and looks for a side to take.
    Decides,
    /// It stands and has decided to stay.
    Stays,
}

/// One of two robots, as they talk to each other.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Talk {
    rule: Rule,
    is_second: bool,
    phase: Phase,
    /// Where it will be next, or stands.
    next: Cell,
    /// Where the other one will be next, as it was told last.
    told: Option<Cell>,
    /// Whether it is its turn; without [`Condition::Turn`] this says nothing.
    has_turn: bool,
    /// The request that it has yet to answer: its number, and the node asked for.
    owed: Option<(u8, Cell)>,
    /// The number of its own latest request, and of the latest that it has answered, with the answer.
    number: u8,
    answered: Option<Letter>,
}

/// The messages sent at a time: an acknowledgement, a response, and a request of its own.
pub type Outbox = [Option<Letter>; 3];

const NOTHING: Outbox = [None; 3];

impl Talk {
    /// The first of two robots, at the node `at`. It is the first to decide.
    pub const fn first(rule: Rule, at: Cell) -> Self {
        Self {
            rule,
            is_second: false,
            phase: Phase::Decides,
            next: at,
            told: None,
            has_turn: true,
            owed: None,
            number: 0,
            answered: None,
        }
    }

    /// The second of two robots, at the node `at`, and its request.
    pub fn second(rule: Rule, at: Cell, sides: Steps) -> (Self, Outbox) {
        let mut talk = Self { is_second: true, has_turn: false, ..Self::first(rule, at) };
        let sent = talk.arrived(sides);
        (talk, sent)
    }

    /// The robot's phase.
    pub const fn phase(&self) -> Phase {
        self.phase
    }

    /// Where it will be next, or stands.
    pub const fn next(&self) -> Cell {
        self.next
    }

    /// Where the other one will be next, as it was told last.
    pub const fn told(&self) -> Option<Cell> {
        self.told
    }

    /// The number of its latest request.
    pub const fn number(&self) -> u8 {
        self.number
    }

    /// It has come to a node where `sides` count as covered.
    pub fn arrived(&mut self, sides: Steps) -> Outbox {
        if self.rule.has(Condition::Turn) && self.has_turn {
            // Nobody else has decided since it was told where the other one is.
            self.phase = Phase::Decides;
            return NOTHING;
        }
        [None, None, Some(self.ask(sides))]
    }

    /// It drives to `to`. `sides` says which sides of a node count as covered.
    pub fn drives(&mut self, to: Cell, sides: impl Fn(Cell) -> Steps) -> Outbox {
        (self.phase, self.next) = (Phase::Drives, to);
        [None, self.pay(sides), None]
    }

    /// It stays. `sides` says which sides of a node count as covered.
    pub fn stays(&mut self, sides: impl Fn(Cell) -> Steps) -> Outbox {
        self.phase = Phase::Stays;
        let paid = self.pay(&sides);
        [None, paid, self.ask_for_the_turn(sides)]
    }

    /// The messages sent when one arrives. `sides` says which sides of a node count as covered.
    pub fn hears(&mut self, letter: Letter, sides: impl Fn(Cell) -> Steps) -> Outbox {
        let Letter { number, message } = letter;
        match message {
            Message::Request { node, .. } => {
                if self.rule.has(Condition::Repeats) {
                    let last = self.answered.map_or(0, |answered| answered.number);
                    if number == last {
                        // Answered before. Who has the turn again has been heard.
                        return [None, self.answered.filter(|_| !self.has_turn), None];
                    }
                    if number != after(last) {
                        return NOTHING;
                    }
                }
                self.owed = Some((number, node));
                let acknowledged = Letter { number, message: Message::Acknowledged };
                let paid = self.pay(&sides);
                let asks_back = paid.is_some() && self.phase == Phase::Stays;
                [Some(acknowledged), paid, if asks_back { self.ask_for_the_turn(sides) } else { None }]
            }
            Message::Acknowledged => {
                if self.phase == Phase::Asks && number == self.number {
                    self.phase = Phase::Waits;
                }
                NOTHING
            }
            Message::Response { next, .. } => {
                let is_asking = matches!(self.phase, Phase::Asks | Phase::Waits);
                if !is_asking || number != self.number {
                    return NOTHING;
                }
                (self.phase, self.told, self.has_turn) = (Phase::Decides, Some(next), true);
                [Some(Letter { number, message: Message::ResponseAcknowledged }), None, None]
            }
            Message::ResponseAcknowledged => NOTHING,
        }
    }

    /// Its request once more, if it waits for an answer and repeats.
    pub fn again(&self, sides: Steps) -> Option<Letter> {
        let is_asking = matches!(self.phase, Phase::Asks | Phase::Waits);
        (is_asking && self.rule.has(Condition::Repeats)).then(|| self.request(sides))
    }

    const fn request(&self, sides: Steps) -> Letter {
        Letter { number: self.number, message: Message::Request { node: self.next, sides } }
    }

    fn ask(&mut self, sides: Steps) -> Letter {
        self.phase = Phase::Asks;
        if self.rule.has(Condition::Repeats) {
            self.number = after(self.number);
        }
        self.request(sides)
    }

    /// Who stays and has passed the turn asks for it.
    fn ask_for_the_turn(&mut self, sides: impl Fn(Cell) -> Steps) -> Option<Letter> {
        let asks = self.rule.has(Condition::Turn) && !self.has_turn;
        asks.then(|| self.ask(sides(self.next)))
    }

    /// Whether it answers a request now.
    fn answers(&self) -> bool {
        let is_free = match self.phase {
            Phase::Drives => true,
            Phase::Stays => self.rule.has(Condition::Turn),
            Phase::Asks | Phase::Waits => match self.rule.answers {
                Answers::Driving => false,
                Answers::Always => true,
                Answers::FirstGoesFirst => self.is_second,
            },
            Phase::Decides => self.rule.answers == Answers::Always,
        };
        is_free && (self.has_turn || !self.rule.has(Condition::Turn))
    }

    /// The response that it owes, if it answers now. The turn goes with it.
    fn pay(&mut self, sides: impl Fn(Cell) -> Steps) -> Option<Letter> {
        let (number, node) = self.owed.filter(|_| self.answers())?;
        let message = Message::Response { next: self.next, sides: sides(node) };
        let letter = Letter { number, message };
        (self.owed, self.answered, self.has_turn) = (None, Some(letter), false);
        Some(letter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const START: Cell = Cell::new(0, 0);
    const BESIDE: Cell = Cell::new(1, 0);

    fn nothing(_: Cell) -> Steps {
        Steps::NONE
    }

    #[test]
    fn as_published_two_robots_that_stand_wait_for_ever() {
        let mut first = Talk::first(Rule::PUBLISHED, START);
        let (mut second, asked) = Talk::second(Rule::PUBLISHED, START, Steps::NONE);
        assert_eq!(first.drives(BESIDE, nothing), NOTHING);
        let [None, None, Some(back)] = first.arrived(Steps::NONE) else { panic!("it asks") };
        let [None, None, Some(request)] = asked else { panic!("it asks") };
        assert_eq!(first.hears(request, nothing)[1], None);
        assert_eq!(second.hears(back, nothing)[1], None);
        assert_eq!((first.phase(), second.phase()), (Phase::Asks, Phase::Asks));
    }

    #[test]
    fn the_turn_passes_with_the_response() {
        let mut first = Talk::first(Rule::REPAIRED, START);
        let (mut second, asked) = Talk::second(Rule::REPAIRED, BESIDE, Steps::NONE);
        assert!(first.hears(asked[2].expect("it asks"), nothing)[1].is_none(), "it decides");
        let [None, Some(response), None] = first.drives(Cell::new(-1, 0), nothing) else {
            panic!("it answers")
        };
        assert!(!first.has_turn);
        second.hears(response, nothing);
        assert_eq!((second.phase(), second.told()), (Phase::Decides, Some(Cell::new(-1, 0))));
        assert!(first.arrived(Steps::NONE)[2].is_some(), "it asks for the turn");
    }

    #[test]
    fn a_request_that_comes_twice_passes_one_turn() {
        let mut first = Talk::first(Rule::ROBUST, START);
        let (second, asked) = Talk::second(Rule::ROBUST, BESIDE, Steps::NONE);
        let request = asked[2].expect("it asks");
        first.hears(request, nothing);
        let response = first.drives(Cell::new(-1, 0), nothing)[1];
        let again = second.again(Steps::NONE).expect("it repeats");
        assert_eq!(first.hears(again, nothing), [None, response, None]);
        assert!(!first.has_turn);
    }

    #[test]
    fn requests_are_numbered_one_after_the_other_and_only_the_latest_is_answered() {
        let mut first = Talk::first(Rule::ROBUST, START);
        let (mut second, asked) = Talk::second(Rule::ROBUST, BESIDE, Steps::NONE);
        assert_eq!((first.number, second.number), (0, 1));
        assert_eq!((first.has_turn, second.has_turn), (true, false));
        let mut request = asked[2].expect("it asks");
        let (mut asks, mut has) = (&mut second, &mut first);
        for turn in 0_u8..12 {
            // Each of the two asks every other time.
            let number = (turn / 2 + 1) % NUMBERS;
            assert_eq!((request.number, asks.number), (number, number));
            let other = |message| Letter { number: request.number ^ 1, message };
            let answer = Message::Response { next: START, sides: Steps::NONE };
            assert_eq!(asks.hears(other(Message::Acknowledged), nothing), NOTHING);
            assert_eq!(asks.hears(other(answer), nothing), NOTHING);
            assert_eq!(asks.phase(), Phase::Asks);
            let [Some(acknowledged), None, None] = has.hears(request, nothing) else { panic!("it decides") };
            asks.hears(acknowledged, nothing);
            assert_eq!(asks.phase(), Phase::Waits);
            let [None, Some(response), Some(next)] = has.stays(nothing) else {
                panic!("it answers, and asks for the turn that it passes")
            };
            assert!(asks.hears(response, nothing)[0].is_some());
            assert_eq!((asks.phase(), asks.has_turn, has.has_turn), (Phase::Decides, true, false));
            // It comes twice, and is not answered twice.
            assert_eq!(asks.hears(response, nothing), NOTHING);
            request = next;
            (asks, has) = (has, asks);
        }
    }
}
