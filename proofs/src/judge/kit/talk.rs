//! The messages between two robots, as `SPEC.md` has it under “KIT: what robots say” (KIT-4, KIT-5).

use super::super::change::plain;
use super::super::{Case, Objection, must};

/// A talk of two robots, of which the second one has asked. The first one decides, or, without turns, has left the node
/// where both start.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Talk {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// Whether robots take turns: the repaired rule.
    pub has_turns: bool,
    /// Messages that are lost, and that come twice.
    pub faults: usize,
    /// The events, in order.
    pub acts: Vec<Act>,
}

/// An event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Act {
    /// The robot that acts, or to which the message is sent.
    pub robot: usize,
    /// Its act, or the fate of the message.
    pub said: TalkEvent,
    /// The message, of one that is on its way.
    pub word: Option<Word>,
}

/// An act of a robot, or the fate of a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TalkEvent {
    /// A robot comes to its node.
    Arrives,
    /// A robot decides and drives to another node.
    Drives,
    /// A robot decides and stays.
    Stays,
    /// A message arrives.
    Hears,
    /// A message is lost.
    Misses,
    /// A message will come twice.
    Doubled,
}

/// A message.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum Word {
    /// A robot asks.
    #[default]
    Request,
    /// The request has come.
    Acknowledged,
    /// The answer: where its sender goes, or stands, which is one of two nodes, 0 and 1.
    Response(usize),
}

plain!(Talk { has_turns, faults, acts });
plain!(Act { robot, said, word });
plain!(TalkEvent one of Arrives, Drives, Stays, Hears, Misses, Doubled);

impl super::super::change::Plain for Word {
    fn change(&mut self, change: &mut super::super::change::Change) {
        let next = if let Self::Response(node) = *self { [node + 1, node.wrapping_sub(1)] } else { [0, 1] };
        let all = [Self::Request, Self::Acknowledged, Self::Response(next[0]), Self::Response(next[1])];
        change.another(self, &all);
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Phase {
    Drives,
    Asks,
    Waits,
    Decides,
    Stays,
}

#[derive(Clone, Copy, Debug)]
struct Robot {
    phase: Phase,
    /// The node where it goes or stands: each robot drives to and fro between two nodes.
    node: usize,
    /// Where it was told last that the other one goes or stands; at first, where that one starts.
    told: usize,
    has_turn: bool,
    owes: bool,
}

/// A message on its way: to whom, whether it is a copy, and which robots have acted since it was sent.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Letter {
    to: usize,
    word: Word,
    is_copy: bool,
    acted: [bool; 2],
}

struct Court {
    has_turns: bool,
    robots: [Robot; 2],
    letters: Vec<Letter>,
}

impl Case for Talk {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let decides = Robot { phase: Phase::Decides, node: 0, told: 0, has_turn: true, owes: false };
        let second = Robot { phase: Phase::Asks, has_turn: false, ..decides };
        let leaves = Robot { phase: Phase::Drives, node: 1, ..decides };
        let first = if self.has_turns { decides } else { leaves };
        let mut court = Court { has_turns: self.has_turns, robots: [first, second], letters: Vec::new() };
        court.send(0, Word::Request);
        let is_fault = |act: &&Act| matches!(act.said, TalkEvent::Misses | TalkEvent::Doubled);
        let faults = self.acts.iter().filter(is_fault).count();
        must(faults == self.faults, "there are more faults, or fewer")?;
        for (number, act) in (1..).zip(&self.acts) {
            let is_stale = court.act(act).map_err(|what| Objection { at: number, what })?;
            let is_last = number == self.acts.len();
            if self.clause == "KIT-5" {
                let what = if is_stale { "the clause is broken before" } else { "the robot knows it" };
                must(is_stale == is_last, what).map_err(|what| Objection { at: number, what })?;
            }
        }
        match self.clause {
            "KIT-5" => Ok(must(!self.acts.is_empty(), "nothing happens")?),
            "KIT-4" => {
                let robots = 0..2;
                let is_still = court.letters.is_empty() && robots.clone().all(|robot| !court.is_busy(robot));
                must(is_still, "something is still bound to happen")?;
                let waits = |robot: usize| matches!(court.robots[robot].phase, Phase::Asks | Phase::Waits);
                Ok(must(robots.clone().any(waits), "no robot waits for an answer")?)
            }
            _ => Err("the judge does not know this clause".into()),
        }
    }
}

impl Court {
    fn send(&mut self, to: usize, word: Word) {
        self.letters.push(Letter { to, word, is_copy: false, acted: [false; 2] });
    }

    fn is_busy(&self, robot: usize) -> bool {
        matches!(self.robots[robot].phase, Phase::Drives | Phase::Decides)
    }

    /// Takes an act; whether a robot decides by old news.
    fn act(&mut self, act: &Act) -> Result<bool, &'static str> {
        let robot = act.robot;
        must(robot < 2, "there is no such robot")?;
        let is_about =
            |said: TalkEvent| matches!(said, TalkEvent::Hears | TalkEvent::Misses | TalkEvent::Doubled);
        must(act.word.is_some() == is_about(act.said), "what happens has a message, or has none")?;
        if let Some(word) = act.word {
            // Of a message and its copy the message itself keeps more from happening.
            let places = || {
                (0..self.letters.len())
                    .filter(|&place| (self.letters[place].to, self.letters[place].word) == (robot, word))
            };
            let place = places()
                .min_by_key(|&place| self.letters[place].is_copy)
                .ok_or("no such message is on its way")?;
            let letter = self.letters.remove(place);
            match act.said {
                TalkEvent::Doubled => self.letters.extend([letter, Letter { is_copy: true, ..letter }]),
                TalkEvent::Hears => self.hear(robot, word),
                TalkEvent::Arrives | TalkEvent::Drives | TalkEvent::Stays | TalkEvent::Misses => {}
            }
            return Ok(false);
        }
        // A message takes less time than two acts of a robot; a copy takes any time.
        let is_late = self.letters.iter().any(|letter| !letter.is_copy && letter.acted[robot]);
        must(!is_late, "a message takes less time than two acts of a robot")?;
        self.letters.iter_mut().for_each(|letter| letter.acted[robot] = true);
        let own = self.robots[robot];
        let phase = if act.said == TalkEvent::Arrives { Phase::Drives } else { Phase::Decides };
        must(own.phase == phase, "a robot does what it cannot do now")?;
        let is_stale = act.said != TalkEvent::Arrives && own.told != self.robots[1 - robot].node;
        match act.said {
            TalkEvent::Arrives if self.has_turns && own.has_turn => self.robots[robot].phase = Phase::Decides,
            TalkEvent::Arrives => self.ask(robot),
            TalkEvent::Drives => {
                self.robots[robot] = Robot { phase: Phase::Drives, node: 1 - own.node, ..own };
                self.pay(robot);
            }
            _ => {
                must(
                    self.has_turns,
                    "as published a robot takes the side by which it has come, if no other",
                )?;
                self.robots[robot].phase = Phase::Stays;
                self.pay(robot);
                self.ask_for_the_turn(robot);
            }
        }
        Ok(is_stale)
    }

    fn hear(&mut self, robot: usize, word: Word) {
        let own = self.robots[robot];
        match word {
            Word::Request => {
                self.robots[robot].owes = true;
                self.send(1 - robot, Word::Acknowledged);
                if self.pay(robot) && own.phase == Phase::Stays {
                    self.ask_for_the_turn(robot);
                }
            }
            Word::Acknowledged if own.phase == Phase::Asks => self.robots[robot].phase = Phase::Waits,
            Word::Response(node) if matches!(own.phase, Phase::Asks | Phase::Waits) => {
                self.robots[robot] = Robot { phase: Phase::Decides, told: node, has_turn: true, ..own };
            }
            Word::Acknowledged | Word::Response(_) => {}
        }
    }

    fn ask(&mut self, robot: usize) {
        self.robots[robot].phase = Phase::Asks;
        self.send(1 - robot, Word::Request);
    }

    fn ask_for_the_turn(&mut self, robot: usize) {
        if self.has_turns && !self.robots[robot].has_turn {
            self.ask(robot);
        }
    }

    /// A robot that owes an answer gives it while it drives; one with the turn also while it stays, and the turn
    /// goes with it.
    fn pay(&mut self, robot: usize) -> bool {
        let own = self.robots[robot];
        let is_free = own.phase == Phase::Drives || own.phase == Phase::Stays && self.has_turns;
        let pays = own.owes && is_free && (own.has_turn || !self.has_turns);
        if pays {
            self.robots[robot] = Robot { owes: false, has_turn: false, ..own };
            self.send(1 - robot, Word::Response(own.node));
        }
        pays
    }
}
