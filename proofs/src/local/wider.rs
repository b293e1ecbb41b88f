//! A rule that speaks of `k` robots, as one that speaks of `k + 1`: whatever each `k` of them may plan at once. What a
//! robot does to two others may break a promise of two that all three together keep.

use super::invariant::{promised, relative};
use super::{Act, Far, Local, Plan, Robot, RobotOf, all_tuples};

/// One robot more than `rule` speaks of.
pub(super) struct Wider<'r, R: Local> {
    rule: &'r R,
    /// The tuples of which the rule speaks among these robots.
    parts: Vec<Vec<usize>>,
}

impl<'r, R: Local> Wider<'r, R> {
    /// `None` where a team may have no more robots than the rule speaks of, where robots that are far apart are not
    /// asked about, or where a tuple of a team of up to `most` robots is in no tuple of one robot more.
    pub(super) fn of(rule: &'r R, most: usize) -> Option<Self> {
        let wider = Self { rule, parts: rule.tuples(R::ROBOTS + 1) };
        let is_due = R::LEAST > R::ROBOTS && rule.reach().1 == Far::Broken && !wider.parts.is_empty();
        let covers = |robots: usize| {
            let within = wider.tuples(robots);
            let has = |wide: &Vec<usize>, narrow: &Vec<usize>| {
                wider
                    .parts
                    .iter()
                    .any(|part| part.iter().map(|&robot| wide[robot]).eq(narrow.iter().copied()))
            };
            rule.tuples(robots).iter().all(|narrow| within.iter().any(|wide| has(wide, narrow)))
        };
        (is_due && (R::LEAST..=most.max(R::LEAST)).all(covers)).then_some(wider)
    }
}

impl<R: Local> Local for Wider<'_, R> {
    type State = R::State;
    type Act = R::Act;
    const ROBOTS: usize = R::ROBOTS + 1;
    const LEAST: usize = R::LEAST;
    const FAULTS: bool = R::FAULTS;
    const COLOURS: u8 = R::COLOURS;

    fn states(&self) -> Vec<R::State> {
        self.rule.states()
    }

    fn acts(&self, state: R::State) -> Vec<Act<R::State, R::Act>> {
        self.rule.acts(state)
    }

    fn admits(&self, plans: &[Plan<R::State, R::Act>]) -> bool {
        let of = |part: &Vec<usize>| part.iter().map(|&robot| plans[robot]).collect::<Vec<_>>();
        self.parts.iter().all(|part| self.rule.admits(&of(part)))
    }

    fn keeps(&self, robots: &[RobotOf<R>]) -> bool {
        self.parts.iter().all(|part| promised(self.rule, &seen(part, robots)))
    }

    /// Each part is within the reach of the rule, and parts have robots in common.
    fn reach(&self) -> (i16, Far) {
        (self.rule.reach().0 * R::ROBOTS as i16, Far::Broken)
    }

    fn may_start(&self, robots: &[RobotOf<R>]) -> bool {
        self.parts.iter().all(|part| self.rule.may_start(&seen(part, robots)))
    }

    fn start(&self, robots: usize) -> Vec<RobotOf<R>> {
        self.rule.start(robots)
    }

    /// Every tuple that is bound as the first robots of a team are.
    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        let bound = self.rule.tuples(robots);
        let is_bound = |wide: &Vec<usize>| {
            self.parts.iter().all(|part| bound.contains(&part.iter().map(|&robot| wide[robot]).collect()))
        };
        all_tuples(robots, Self::ROBOTS).into_iter().filter(is_bound).collect()
    }

    fn is_always_possible(&self, act: R::Act) -> bool {
        self.rule.is_always_possible(act)
    }

    fn is_sure(&self, act: R::Act) -> bool {
        self.rule.is_sure(act)
    }

    fn is_fixed(&self, robot: usize) -> bool {
        self.rule.is_fixed(robot)
    }
}

/// The robots of a tuple as seen from the first of them.
pub(super) fn seen<S: Copy>(tuple: &[usize], robots: &[Robot<S>]) -> Vec<Robot<S>> {
    relative(&tuple.iter().map(|&robot| robots[robot]).collect::<Vec<_>>())
}
