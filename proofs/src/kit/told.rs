//! Two published robots, each of which takes the other one to be where it was told last, in a row of nodes without
//! walls: whether they lose contact (KIT-1 at nodes, KIT-2) by each reading of who answers. None takes a side out of
//! reach.

use std::collections::{HashSet, VecDeque};

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Steps};
use tautline_kernel::kit::Answers::{Always, Driving, FirstGoesFirst};
use tautline_kernel::kit::{
    Fallback, Letter, Message, Next, Outbox, Phase, Records, Rule, Sight, Stance, Talk, touch,
};

use super::world::{Demand, Setting, Speeds, World};
use crate::engine::outcomes;

/// Two robots, how they talk, and the letters on their way: to whom, and a bit for each robot that has acted since.
#[derive(Clone, PartialEq, Eq, Hash)]
struct State {
    world: World<2>,
    talks: [Talk; 2],
    letters: Vec<(usize, Letter, u8)>,
}

/// A state that comes next, the drives that were begun, and whether contact is lost.
type Step = (State, usize, bool);

fn nothing(_: Cell) -> Steps {
    Steps::NONE
}

impl State {
    /// This state after `from` has sent these letters. An acknowledgement changes nothing here.
    fn after(mut self, from: usize, sent: Outbox) -> Self {
        let counts =
            |letter: &Letter| matches!(letter.message, Message::Request { .. } | Message::Response { .. });
        let new = sent.into_iter().flatten().filter(counts).map(|letter| (1 - from, letter, 0));
        self.letters.extend(new);
        self
    }

    /// This state after `robot` has acted and sent these letters.
    fn acted(mut self, robot: usize, sent: Outbox) -> Self {
        self.letters.iter_mut().for_each(|(_, _, age)| *age |= 1 << robot);
        self.after(robot, sent)
    }
}

/// `robot` decides: it sees the other one where that is, and knows where it goes as it was told.
fn decided(setting: &Setting<2>, state: &State, robot: usize, oracle: &mut dyn Oracle) -> Option<Step> {
    let mut after = state.clone();
    let (from, other) = (state.talks[robot].next(), state.world.team.stance(1 - robot)?);
    let team = &mut after.world.team;
    if let Some(to) = state.talks[robot].told() {
        team.robots_mut()[1 - robot].stance = Stance::Drives { from: to, to };
    }
    let mut next = team.decide(robot, oracle).ok()?;
    while let Next::Looks(side) = next {
        let is_seen = touch(from, side, other).unwrap_or_else(|| oracle.flip());
        next = team.looked(robot, if is_seen { Sight::Robot } else { Sight::Free }, oracle).ok()?;
    }
    team.robots_mut()[1 - robot].stance = other;
    let Next::Drives(to) = next else {
        let sent = after.talks[robot].stays(nothing);
        return Some((after.acted(robot, sent), 0, false));
    };
    after.world.first = if other.stands() { robot as u8 } else { state.world.first };
    let breaks = setting.broken_by_drive(&state.world, robot, Stance::Drives { from, to }, false);
    let sent = after.talks[robot].drives(to, nothing);
    Some((after.acted(robot, sent), 1, !breaks.is_empty()))
}

/// `robot` arrives, if it does so before the other one.
fn arrived(setting: &Setting<2>, state: &State, robot: usize) -> Option<Step> {
    let both_drive = state.world.team.stances().all(|stance| !stance.stands());
    if both_drive && usize::from(state.world.first) != robot {
        return None;
    }
    let mut after = state.clone();
    after.world.team.arrived(robot).ok()?;
    after.world.first = 1 - robot as u8;
    let is_lost = setting.broken_by_arrival(&after.world, robot).is_some();
    let sent = after.talks[robot].arrived(Steps::NONE);
    Some((after.acted(robot, sent), 0, is_lost))
}

/// The first robot has left the node where both start, and the second one asks there.
fn starts(setting: &Setting<2>) -> Vec<Step> {
    let left = |node: Cell| {
        let (second, asks) = Talk::second(setting.rule, node, Steps::NONE);
        let talks = [Talk::first(setting.rule, node), second];
        let start = State { world: setting.start([node; 2])?, talks, letters: Vec::new() };
        let first: Vec<Step> = outcomes(|oracle| decided(setting, &start, 0, oracle)).collect();
        Some(first.into_iter().map(move |(state, drives, is_lost)| (state.after(1, asks), drives, is_lost)))
    };
    setting.area.cells().filter_map(left).flatten().collect()
}

/// The steps that may come next: a letter takes less time than a robot from one act to the one after the next.
fn steps(setting: &Setting<2>, state: &State) -> Vec<Step> {
    let mut steps = Vec::new();
    for robot in 0..2 {
        if state.letters.iter().any(|(_, _, age)| age >> robot & 1 == 1) {
            continue;
        }
        match state.talks[robot].phase() {
            Phase::Decides => steps.extend(outcomes(|oracle| decided(setting, state, robot, oracle))),
            Phase::Drives => steps.extend(arrived(setting, state, robot)),
            Phase::Asks | Phase::Waits | Phase::Stays => {}
        }
    }
    for (place, &(to, letter, _)) in state.letters.iter().enumerate() {
        let mut after = state.clone();
        after.letters.remove(place);
        let sent = after.talks[to].hears(letter, nothing);
        steps.push((after.after(to, sent), 0, false));
    }
    steps
}

/// The drives of a run with the fewest steps in which contact is lost in a row of five nodes, if there is one.
fn drives_to_a_loss(rule: Rule, demand: Demand) -> Option<usize> {
    let row = Setting::new(rule, (5, 1)).expect("a lattice");
    let setting = Setting { speeds: Speeds::Equal, demand: Some(demand), ..row };
    let (mut known, mut runs) = (HashSet::new(), VecDeque::from(starts(&setting)));
    while let Some((state, drives, is_lost)) = runs.pop_front() {
        if is_lost {
            return Some(drives);
        }
        if known.insert(state.clone()) {
            let next = steps(&setting, &state).into_iter();
            runs.extend(next.map(|(after, begun, is_lost)| (after, drives + begun, is_lost)));
        }
    }
    None
}

#[test]
fn robots_that_filter_their_fallback_lose_contact_where_a_robot_that_stands_answers() {
    for records in [Records::Union, Records::Others] {
        let filtered = Rule { records, fallback: Fallback::Admitted, ..Rule::PUBLISHED };
        for demand in [Demand::Contact, Demand::AtNodes] {
            for (answers, lost) in [(Driving, None), (Always, Some(4)), (FirstGoesFirst, Some(4))] {
                let rule = Rule { answers, ..filtered };
                assert_eq!(drives_to_a_loss(rule, demand), lost, "{records:?}, {demand:?}, {answers:?}");
            }
        }
    }
}
