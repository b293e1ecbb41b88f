//! A rule whose states and acts are numbers: the engine is compiled once, and not for each rule that it decides.

use std::fmt::Debug;

use super::rule::{Act, ActOf, Far, Local, Plan, Robot, RobotOf, as_its_rule};

/// A rule by numbers. The words of a number are those of the state or the act that has it.
pub(super) trait NumberedRule: Local<State = u32, Act = u32> {
    /// The words of a state.
    fn state_words(&self, state: u32) -> String;

    /// The words of an act.
    fn act_words(&self, act: u32) -> String;

    /// The words of a state in which a robot of so many starts, and which is none of the rule's.
    fn stray(&self, robots: usize) -> Option<String>;
}

/// A rule and the numbers of its states, which have the order of the states, and of its acts.
pub(super) struct ByNumber<'r, R: Local> {
    rule: &'r R,
    /// The states by number: those of the rule and those in which its acts end.
    states: Vec<R::State>,
    /// The acts by number: those of each state by themselves.
    acts: Vec<R::Act>,
    /// The numbers of the rule's states, in its order.
    listed: Vec<u32>,
    /// Whatever a robot can do, by the number of its state.
    possible: Vec<Vec<Act<u32, u32>>>,
}

impl<'r, R: Local> ByNumber<'r, R> {
    pub(super) fn new(rule: &'r R) -> Self {
        let named = rule.states();
        let of_each: Vec<Vec<ActOf<R>>> = named.iter().map(|&state| rule.acts(state)).collect();
        let ends = of_each.iter().flatten().flat_map(|act| act.ends.iter().map(|&(_, state)| state));
        let mut states: Vec<R::State> = named.iter().copied().chain(ends).collect();
        states.sort_unstable();
        states.dedup();
        let mut numbered = Self {
            rule,
            possible: vec![Vec::new(); states.len()],
            states,
            acts: Vec::new(),
            listed: Vec::new(),
        };
        for (state, acts) in named.into_iter().zip(of_each) {
            let first = numbered.acts.len() as u32;
            let act = |(number, act): (u32, &ActOf<R>)| Act {
                act: number,
                step: act.step,
                ends: act.ends.iter().map(|&(goes, state)| (goes, numbered.number(state))).collect(),
                needs_open: act.needs_open,
            };
            let possible = (first..).zip(&acts).map(act).collect();
            let number = numbered.number(state);
            numbered.possible[number as usize] = possible;
            numbered.listed.push(number);
            numbered.acts.extend(acts.into_iter().map(|act| act.act));
        }
        numbered
    }

    /// The number of a state; that of none if it has none.
    fn number(&self, state: R::State) -> u32 {
        self.states.binary_search(&state).map_or(u32::MAX, |place| place as u32)
    }

    fn robot(&self, &Robot { at, state, on }: &Robot<u32>) -> RobotOf<R> {
        Robot { at, state: self.states[state as usize], on }
    }

    fn robots(&self, robots: &[Robot<u32>]) -> Vec<RobotOf<R>> {
        robots.iter().map(|robot| self.robot(robot)).collect()
    }
}

impl<R: Local> NumberedRule for ByNumber<'_, R> {
    fn state_words(&self, state: u32) -> String {
        words(&self.states[state as usize])
    }

    fn act_words(&self, act: u32) -> String {
        words(&self.acts[act as usize])
    }

    fn stray(&self, robots: usize) -> Option<String> {
        let is_stray = |robot: &RobotOf<R>| !self.listed.contains(&self.number(robot.state));
        self.rule.start(robots).iter().find(|robot| is_stray(robot)).map(|robot| words(&robot.state))
    }
}

fn words(named: &dyn Debug) -> String {
    format!("{named:?}")
}

impl<R: Local> Local for ByNumber<'_, R> {
    type State = u32;
    type Act = u32;

    as_its_rule! {
        robots() -> usize;
        least() -> usize;
        may_fail() -> bool;
        colours() -> u8;
        reach() -> (i16, Far);
        tuples(robots: usize) -> Vec<Vec<usize>>;
        is_fixed(robot: usize) -> bool;
    }

    fn states(&self) -> Vec<u32> {
        self.listed.clone()
    }

    fn acts(&self, state: u32) -> Vec<Act<u32, u32>> {
        self.possible[state as usize].clone()
    }

    fn admits(&self, plans: &[Plan<u32, u32>]) -> bool {
        let plan = |&Plan { ref robot, act, step, aims }: &Plan<u32, u32>| Plan {
            robot: self.robot(robot),
            act: self.acts[act as usize],
            step,
            aims,
        };
        self.rule.admits(&plans.iter().map(plan).collect::<Vec<_>>())
    }

    fn keeps(&self, robots: &[Robot<u32>]) -> bool {
        self.rule.keeps(&self.robots(robots))
    }

    fn may_start(&self, robots: &[Robot<u32>]) -> bool {
        self.rule.may_start(&self.robots(robots))
    }

    fn start(&self, robots: usize) -> Vec<Robot<u32>> {
        let number = |&Robot { at, state, on }: &RobotOf<R>| Robot { at, state: self.number(state), on };
        self.rule.start(robots).iter().map(number).collect()
    }

    fn is_always_possible(&self, act: u32) -> bool {
        self.rule.is_always_possible(self.acts[act as usize])
    }

    fn is_sure(&self, act: u32) -> bool {
        self.rule.is_sure(self.acts[act as usize])
    }
}
