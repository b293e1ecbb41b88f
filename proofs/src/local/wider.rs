//! A rule that speaks of `k` robots, as one that speaks of `k + 1`: whatever each `k` of them may plan at once. What a
//! robot does to two others may break a promise of two that all three together keep.

use std::collections::BTreeSet;

use super::invariant::{promised, relative};
use super::numbers::NumberedRule;
use super::rule::{Act, Far, Local, Plan, Robot, all_tuples, as_its_rule};

/// One robot more than `rule` speaks of.
pub(super) struct Wider<'r> {
    rule: &'r dyn NumberedRule,
    /// The tuples of which the rule speaks among these robots.
    parts: Vec<Vec<usize>>,
}

impl<'r> Wider<'r> {
    /// `None` where a team may have no more robots than the rule speaks of, where robots that are far apart are not
    /// asked about, or where a tuple of a team of up to `most` robots is in no tuple of one robot more.
    pub(super) fn of(rule: &'r dyn NumberedRule, most: usize) -> Option<Self> {
        let wider = Self { rule, parts: rule.tuples(rule.robots() + 1) };
        let is_due = rule.least() > rule.robots() && rule.reach().1 == Far::Broken && !wider.parts.is_empty();
        let covers = |robots: usize| {
            let within = wider.tuples(robots);
            let covered: BTreeSet<Vec<usize>> = within.iter().flat_map(|wide| wider.parts_of(wide)).collect();
            rule.tuples(robots).iter().all(|tuple| covered.contains(tuple))
        };
        (is_due && (rule.least()..=most.max(rule.least())).all(covers)).then_some(wider)
    }

    /// The tuples of the rule among the robots of this one.
    fn parts_of(&self, wide: &[usize]) -> impl Iterator<Item = Vec<usize>> {
        self.parts.iter().map(|part| part.iter().map(|&robot| wide[robot]).collect())
    }
}

impl NumberedRule for Wider<'_> {
    as_its_rule! {
        state_words(state: u32) -> String;
        act_words(act: u32) -> String;
        stray(robots: usize) -> Option<String>;
    }
}

impl Local for Wider<'_> {
    type State = u32;
    type Act = u32;

    fn robots(&self) -> usize {
        self.rule.robots() + 1
    }

    as_its_rule! {
        least() -> usize;
        may_fail() -> bool;
        colours() -> u8;
        states() -> Vec<u32>;
        acts(state: u32) -> Vec<Act<u32, u32>>;
        start(robots: usize) -> Vec<Robot<u32>>;
        is_always_possible(act: u32) -> bool;
        is_sure(act: u32) -> bool;
        is_fixed(robot: usize) -> bool;
    }

    fn admits(&self, plans: &[Plan<u32, u32>]) -> bool {
        let of = |part: &Vec<usize>| part.iter().map(|&robot| plans[robot]).collect::<Vec<_>>();
        self.parts.iter().all(|part| self.rule.admits(&of(part)))
    }

    fn keeps(&self, robots: &[Robot<u32>]) -> bool {
        self.parts.iter().all(|part| promised(self.rule, &seen(part, robots)))
    }

    /// Each part is within the reach of the rule, and parts have robots in common.
    fn reach(&self) -> (i16, Far) {
        (self.rule.reach().0 * self.rule.robots() as i16, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<u32>]) -> bool {
        self.parts.iter().all(|part| self.rule.may_start(&seen(part, robots)))
    }

    /// Every tuple that is bound as the first robots of a team are.
    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        let bound: BTreeSet<Vec<usize>> = self.rule.tuples(robots).into_iter().collect();
        let is_bound = |wide: &Vec<usize>| self.parts_of(wide).all(|part| bound.contains(&part));
        all_tuples(robots, self.robots()).into_iter().filter(is_bound).collect()
    }
}

/// The robots of a tuple as seen from the first of them.
pub(super) fn seen(tuple: &[usize], robots: &[Robot<u32>]) -> Vec<Robot<u32>> {
    relative(&tuple.iter().map(|&robot| robots[robot]).collect::<Vec<_>>())
}
