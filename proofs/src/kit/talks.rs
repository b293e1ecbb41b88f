//! Two robots that talk: the kernel's robots, the messages between them, which take any time and overtake each other,
//! and as many that are lost or come twice as a setting lets. Nodes are numbers: what matters is whether a robot knows
//! where the other one goes when it decides (KIT-4, KIT-5).

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Steps};
use tautline_kernel::kit::{Condition, Letter, Message, NUMBERS, Outbox, Phase, Rule, Talk};

use crate::engine::Choices;
use crate::engine::states::{Bits, System, steps};
use crate::engine::world::{Turn, World, any_of, bit};
use crate::judge::AnyCase;
use crate::judge::kit::{Act, Talk as Written, TalkEvent, Word};

/// A demand on the talks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Demand {
    /// KIT-4
    Answered,
    /// KIT-5
    Fresh,
}

/// A rule by which robots talk.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Hearing {
    pub(super) rule: Rule,
    /// Whether a robot forgets at once what it is told: a mutant's.
    pub(super) forgets: bool,
}

/// Talks under way.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Talks {
    pub(super) rule: Rule,
    /// See [`Hearing`].
    pub(super) forgets: bool,
    pub(super) demand: Demand,
    /// Messages that are lost in one run at most.
    pub(super) max_lost: u8,
    /// Messages that come twice in one run at most.
    pub(super) max_doubled: u8,
}

/// Two robots and what is on its way between them.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct State {
    robots: [Talk; 2],
    /// The messages on their way, sorted.
    letters: Vec<Envelope>,
    lost: u8,
    doubled: u8,
    last: Event,
}

/// A letter on its way: to whom, its fields, and a bit for each robot that has acted since it was sent. A copy of a
/// letter takes any time.
type Envelope = (usize, [i16; 8], Bits);

/// The bit of a copy.
const COPY: Bits = 4;

/// The last event. It is told and not compared.
#[derive(Clone, Copy, Debug)]
enum Event {
    Start,
    Arrives(usize),
    Drives(usize),
    Stays(usize),
    Hears(usize, Letter),
    Loses(usize, Letter),
    Doubles(usize, Letter),
    Repeats(usize),
}

impl PartialEq for Event {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Event {}

impl std::hash::Hash for Event {
    fn hash<H: std::hash::Hasher>(&self, _: &mut H) {}
}

/// Nodes that a robot goes to, one after the other, over and over.
const NODES: i16 = 2;

const WAITS: &str = "a robot that waits is answered";
const STALE: &str = "a robot that decides knows where the other one goes";

/// Where a robot starts. Both know it of each other.
const fn start(robot: usize) -> Cell {
    Cell::new(0, robot as i16)
}

fn nothing(_: Cell) -> Steps {
    Steps::NONE
}

impl Talks {
    /// The fields of a letter, and its number again: the order of what is on its way.
    fn fields(&self, letter: Letter) -> [i16; 8] {
        let [flag, x, y, north, east, south, west] = letter.message.encode(0, &self.rule);
        let kind = match letter.message {
            Message::ResponseAcknowledged => 3,
            Message::Request { .. } | Message::Acknowledged | Message::Response { .. } => flag,
        };
        [kind, x, y, north, east, south, west, letter.number.into()]
    }

    fn letter(fields: [i16; 8]) -> Letter {
        let [kind, x, y, .., number] = fields;
        let node = Cell::new(x, y);
        let sides = Steps::NONE;
        let message = match kind {
            0 => Message::Request { node, sides },
            1 => Message::Acknowledged,
            2 => Message::Response { next: node, sides },
            _ => Message::ResponseAcknowledged,
        };
        Letter { number: number as u8, message }
    }

    /// The start: the second robot has asked. The first one decides; as published it has left the node where both
    /// start, and the second one has entered that.
    pub(super) fn start(&self) -> State {
        let mut first = Talk::first(self.rule, start(0));
        if !self.rule.has(Condition::Turn) {
            first.drives(Self::next(first), nothing);
        }
        let (second, sent) = Talk::second(self.rule, start(1), Steps::NONE);
        let robots = [first, second];
        let mut state = State { robots, letters: Vec::new(), lost: 0, doubled: 0, last: Event::Start };
        self.send(&mut state, 1, sent);
        state
    }

    /// The node to which a robot drives from where it stands.
    fn next(talk: Talk) -> Cell {
        Cell::new((talk.next().x + 1) % NODES, talk.next().y)
    }

    /// Whether a robot may stay: as published it takes any side if no other is free, and has come by one.
    const fn may_stay(&self) -> bool {
        self.rule.has(Condition::Stays) || self.rule.has(Condition::Turn)
    }

    /// `from` has acted and says so.
    fn act(&self, state: &mut State, from: usize, sent: Outbox) {
        for (_, _, age) in &mut state.letters {
            *age |= 1 << from;
        }
        self.send(state, from, sent);
    }

    fn send(&self, state: &mut State, from: usize, sent: Outbox) {
        // Who hears that its response has come does nothing then.
        let counts = |letter: &Letter| letter.message != Message::ResponseAcknowledged;
        let letters = sent.into_iter().flatten().filter(counts);
        state.letters.extend(letters.map(|letter| (1 - from, self.fields(letter), 0)));
        state.letters.sort_unstable();
    }

    /// Whether `robot` may act: a message takes less time than a robot from one act to the one after the next, and a
    /// copy of one less than half of the numbers.
    fn may_act(state: &State, robot: usize) -> bool {
        state.letters.iter().all(|&(to, fields, age)| {
            if age & COPY == 0 {
                return age >> robot & 1 == 0;
            }
            let Letter { number, message } = Self::letter(fields);
            let asker = match message {
                Message::Request { .. } | Message::ResponseAcknowledged => 1 - to,
                Message::Acknowledged | Message::Response { .. } => to,
            };
            (state.robots[asker].number() + NUMBERS - number) % NUMBERS < NUMBERS / 2
        })
    }

    /// The acts open to two robots.
    fn acts(&self, state: &State) -> Vec<Successor> {
        let mut acts = Vec::new();
        for robot in 0..2 {
            let bit = 1 << robot;
            let talk = state.robots[robot];
            match talk.phase() {
                Phase::Drives if Self::may_act(state, robot) => {
                    let mut after = State { last: Event::Arrives(robot), ..state.clone() };
                    let sent = after.robots[robot].arrived(Steps::NONE);
                    self.act(&mut after, robot, sent);
                    acts.push(Successor::by(bit, "an arrival", after));
                }
                Phase::Decides if Self::may_act(state, robot) => {
                    let told = talk.told().filter(|_| !self.forgets).unwrap_or_else(|| start(1 - robot));
                    let is_stale = told != state.robots[1 - robot].next();
                    let breaks = (is_stale && self.demand == Demand::Fresh).then_some(STALE);
                    let mut after = State { last: Event::Drives(robot), ..state.clone() };
                    let sent = after.robots[robot].drives(Self::next(talk), nothing);
                    self.act(&mut after, robot, sent);
                    acts.push(Successor { breaks, ..Successor::by(bit, "a drive", after) });
                    if !self.may_stay() {
                        continue;
                    }
                    let mut after = State { last: Event::Stays(robot), ..state.clone() };
                    let sent = after.robots[robot].stays(nothing);
                    self.act(&mut after, robot, sent);
                    acts.push(Successor { breaks, ..Successor::by(bit, "a stay", after) });
                }
                Phase::Drives | Phase::Decides | Phase::Asks | Phase::Waits | Phase::Stays => {}
            }
            if state.letters.is_empty()
                && let Some(letter) = talk.again(Steps::NONE)
            {
                let mut after = State { last: Event::Repeats(robot), ..state.clone() };
                self.send(&mut after, robot, [Some(letter), None, None]);
                acts.push(Successor::by(16 << robot, "a repeated request", after));
            }
        }
        acts
    }

    /// The fates open to the messages on their way.
    fn letters(&self, state: &State) -> Vec<Successor> {
        let mut steps = Vec::new();
        let mut before = None;
        for (place, &(to, fields, age)) in state.letters.iter().enumerate() {
            if before == Some((to, fields, age)) {
                continue;
            }
            before = Some((to, fields, age));
            let letter = Self::letter(fields);
            let mut gone = state.clone();
            gone.letters.remove(place);
            let mut after = State { last: Event::Hears(to, letter), ..gone.clone() };
            let sent = after.robots[to].hears(letter, nothing);
            self.send(&mut after, to, sent);
            steps.push(Successor::by(4 << to, "a message", after));
            if state.lost < self.max_lost {
                let lost = State { last: Event::Loses(to, letter), lost: state.lost + 1, ..gone };
                steps.push(Successor::by(0, "a loss", lost));
            }
            if state.doubled < self.max_doubled {
                let mut twice = State { last: Event::Doubles(to, letter), ..state.clone() };
                twice.letters.push((to, fields, age | COPY));
                twice.letters.sort_unstable();
                twice.doubled += 1;
                steps.push(Successor::by(0, "a double", twice));
            }
        }
        steps
    }

    fn waiting(&self, state: &State) -> Bits {
        let waits = |robot: &usize| matches!(state.robots[*robot].phase(), Phase::Asks | Phase::Waits);
        match self.demand {
            Demand::Answered => (0..2).filter(waits).fold(0, |set, robot| set | 1 << robot),
            Demand::Fresh => 0,
        }
    }
}

/// A step, with what happens in it.
pub(super) struct Successor {
    state: State,
    /// Who acts; nobody in a fault.
    acting: Bits,
    situation: &'static str,
    breaks: Option<&'static str>,
}

impl Successor {
    const fn by(acting: Bits, situation: &'static str, state: State) -> Self {
        Self { state, acting, situation, breaks: None }
    }
}

/// The situations that occur.
const SITUATIONS: [&str; 7] =
    ["a double", "a drive", "a loss", "a message", "a repeated request", "a stay", "an arrival"];

impl World for Talks {
    type State = State;
    type Plan = Vec<Successor>;
    type Event = usize;
    type Demand = &'static str;

    fn plan(&self, state: &mut State, _: &[u8]) -> Option<Vec<Successor>> {
        let mut turns = self.acts(state);
        turns.extend(self.letters(state));
        any_of(turns)
    }

    fn settle(
        &self,
        state: &mut State,
        turns: &Vec<Successor>,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> usize {
        let number = world.pick(turns.len() as u32) as usize;
        state.clone_from(&turns[number].state);
        number
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        turn.plan[*turn.event].breaks.into_iter().collect()
    }

    fn broken_at_end(&self, state: &State, _: &[u8]) -> Vec<&'static str> {
        (self.waiting(state) != 0).then_some(WAITS).into_iter().collect()
    }

    fn covers(&self) -> Vec<&'static str> {
        SITUATIONS.to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        bit(&SITUATIONS, turn.plan[*turn.event].situation)
    }
}

impl System for Talks {
    type Part = State;

    fn part(&self, state: &State, _: usize) -> State {
        state.clone()
    }

    fn put(&self, state: &mut State, _: usize, part: &State) {
        state.clone_from(part);
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        turn.plan[*turn.event].acting
    }

    /// Whatever becomes of a message by a fault has nobody who acts.
    fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
        turn.plan[*turn.event].acting != 0
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        (self.demand == Demand::Answered).then_some(WAITS)
    }

    fn owed(&self, state: &State) -> Bits {
        self.waiting(state)
    }

    /// Robots that drive or decide, each way that has a message on it, and the timers of those that wait.
    fn awake(&self, state: &State) -> Bits {
        let is_busy = |robot: &usize| matches!(state.robots[*robot].phase(), Phase::Drives | Phase::Decides);
        let busy = (0..2).filter(is_busy).fold(0, |set: Bits, robot| set | 1 << robot);
        let repeats = |robot: &usize| state.robots[*robot].again(Steps::NONE).is_some();
        let awake = (0..2).filter(repeats).fold(busy, |set, robot| set | 16 << robot);
        state.letters.iter().fold(awake, |set, &(to, ..)| set | 4 << to)
    }
}

/// The talk that these choices make, written down for the judge.
pub(super) fn case(talks: &Talks, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let (mut state, mut acts) = (talks.start(), Vec::new());
    // The first choice is that of the only start.
    for number in choices.all().skip(1) {
        let step = steps(talks, &state).nth(number as usize)?;
        state = step.state;
        acts.push(act(state.last)?);
    }
    let clause = match talks.demand {
        Demand::Answered => "KIT-4",
        Demand::Fresh => "KIT-5",
    };
    let (has_turns, faults) = (talks.rule.has(Condition::Turn), usize::from(state.lost + state.doubled));
    Some(Box::new(Written { clause, has_turns, faults, acts }))
}

fn act(event: Event) -> Option<Act> {
    let of = |robot, said, letter: Letter| {
        let word = match letter.message {
            Message::Request { .. } => Word::Request,
            Message::Acknowledged => Word::Acknowledged,
            Message::Response { next, .. } => Word::Response(next.x as usize),
            Message::ResponseAcknowledged => return None,
        };
        Some(Act { robot, said, word: Some(word) })
    };
    let does = |robot, said| Some(Act { robot, said, word: None });
    match event {
        Event::Arrives(robot) => does(robot, TalkEvent::Arrives),
        Event::Drives(robot) => does(robot, TalkEvent::Drives),
        Event::Stays(robot) => does(robot, TalkEvent::Stays),
        Event::Hears(robot, letter) => of(robot, TalkEvent::Hears, letter),
        Event::Loses(robot, letter) => of(robot, TalkEvent::Misses, letter),
        Event::Doubles(robot, letter) => of(robot, TalkEvent::Doubled, letter),
        Event::Start | Event::Repeats(_) => None,
    }
}

/// A step in words.
pub(super) fn tell(after: &State) -> String {
    let name = |robot: usize| format!("R{}", robot + 1);
    let says = |letter: Letter| match letter.message {
        Message::Request { .. } => "a request",
        Message::Acknowledged => "that its request has come",
        Message::Response { .. } => "a response",
        Message::ResponseAcknowledged => "that its response has come",
    };
    match after.last {
        Event::Start => String::new(),
        Event::Arrives(robot) => format!("{} arrives and asks", name(robot)),
        Event::Drives(robot) => format!("{} decides and drives", name(robot)),
        Event::Stays(robot) => format!("{} decides and stays", name(robot)),
        Event::Hears(robot, letter) => format!("{} hears {}", name(robot), says(letter)),
        Event::Loses(robot, letter) => format!("{} misses {}", name(robot), says(letter)),
        Event::Doubles(robot, letter) => format!("{} will hear twice {}", name(robot), says(letter)),
        Event::Repeats(robot) => format!("{} asks again", name(robot)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::states::{Limits, search};

    #[test]
    #[ignore = "516,348 states: cargo test --release -p tautline-proofs -- --ignored --nocapture comes_twice"]
    fn robust_robots_survive_a_message_that_comes_twice() {
        for demand in [Demand::Answered, Demand::Fresh] {
            let talks = Talks { rule: Rule::ROBUST, forgets: false, demand, max_lost: 0, max_doubled: 1 };
            let found = search(&talks, [talks.start()], Limits::NONE);
            println!("{demand:?}: {} states", found.states);
            assert!(found.is_whole && found.broken.is_empty(), "{:?}", found.broken);
        }
    }

    #[test]
    #[ignore = "1,605,518 states, 22 s: cargo test --release -p tautline-proofs -- --ignored --nocapture lost_and_one"]
    fn robust_robots_survive_one_message_lost_and_one_that_comes_twice() {
        for demand in [Demand::Answered, Demand::Fresh] {
            let talks = Talks { rule: Rule::ROBUST, forgets: false, demand, max_lost: 1, max_doubled: 1 };
            let found = search(&talks, [talks.start()], Limits::NONE);
            println!("{demand:?}: {} states", found.states);
            assert!(found.is_whole && found.broken.is_empty(), "{:?}", found.broken);
        }
    }
}
