//! The chain's rule as a set of named conditions, and the admission relation: which next positions the
//! conditions allow, in whatever order one prefers them. The proofs of CHAIN-1, CHAIN-2 and CHAIN-3 speak of
//! these functions alone; the planner asks them and nothing else, mostly of all steps of a robot at once.

use super::habit::{Habit, Habits};
use crate::conditions;
use crate::ground::{Cell, Circle, Step, Steps, neighbouring_steps};

conditions! {
    /// One condition of the rule, by the sentence it stands for.
    pub enum Condition of Rule in u16 {
        /// A follower plans to be in E_S of the planned position ahead: P′_i ∈ E_S(P′_{i+1}).
        SafeAhead,
        /// A robot plans to be in E_C of the present position behind: P′_i ∈ E_C(P_{i−1}).
        CoveredBehind,
        /// No two robots plan to be in one cell, the base excepted.
        Distinct,
        /// A candidate of the leader that is refused gets a virtual obstacle.
        RefusedIsVirtual,
        /// An epoch that explored no cell and found no wall ends the run, unless the next unfolds the chain.
        EpochMustGain,
        /// Repair: unless the robot ahead is sure to arrive, a follower also plans to be in E_C of its present
        /// position: P′_i ∈ E_C(P_{i+1}).
        UnsureAhead,
        /// Repair: no follower enters a cell that two others occupy now, the base excepted.
        FullForFollower,
        /// Repair: nor does the leader.
        FullForLeader,
        /// Repair: when an epoch is over and an unexplored cell is within reach, the next begins by unfolding the chain
        /// towards it. Within reach is what is at most N−1 links from the base in the map known so far.
        Unfold,
        /// Ours: a follower plans to be in E_C of the present position ahead, also where the robot ahead is sure to
        /// arrive: P′_i ∈ E_C(P_{i+1}). So contact holds whichever robots do not go, and in whatever order they go.
        Hold,
        /// Ours: no two robots plan to exchange their cells, neither being the base.
        NoExchange,
        /// Ours: the reel takes a team move that brought two robots into one cell, the base excepted, back at once.
        PartsAtOnce,
    }
}

/// Which position of the robot ahead P_high is read from. The planned one is the paper's meaning: the other
/// gives 458 moves, or no end, where this one gives 62.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum High {
    /// The planned position: P′_{i+1}.
    Planned,
    /// The present position: P_{i+1}.
    Present,
}

/// Whether a robot leads the chain or follows.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Role {
    /// The last robot of the chain: R_N.
    Leader,
    /// A robot between the base and the leader: R_2 … R_{N−1}.
    Follower,
}

/// How a chain chooses among the team moves that the conditions admit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Pursuit {
    /// As the paper does: virtual obstacles, backtracks and epochs.
    Epochs,
    /// Ours: straight to the nearest unexplored cell, by the shortest way that a rehearsal finds.
    Reel(Habits),
}

/// The rule of a chain: its conditions, the two circles, how P_high is read, what a plan may cost, and how it chooses.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    /// The conditions in force.
    pub conditions: Conditions,
    /// The circle of E_S.
    pub safe: Circle,
    /// The circle of E_C.
    pub covered: Circle,
    /// The reading of P_high.
    pub high: High,
    /// How many candidates of followers one plan looks at, at the most.
    pub budget: Budget,
    /// How it chooses among the admitted team moves.
    pub pursuit: Pursuit,
}

/// A bound on the cost of a plan (clause CHAIN-12). A look is a candidate of a follower that is tested against the
/// conditions, or tested again because a step that it relied on was struck out. Counting looks, and not time, makes the
/// plan the same on every machine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Budget {
    /// A plan is sought to the end, as in the paper.
    Unlimited,
    /// Repair: as many looks for each robot of the team, the base counted. When they are used up, the
    /// team takes the plan for the leader's present candidate if one is known by then; else this
    /// candidate and all later ones are refused.
    LooksPerRobot(u16),
}

/// A robot's planned move, as its neighbours see it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Move {
    /// P: where it is.
    pub from: Cell,
    /// Its planned step.
    pub step: Step,
    /// Whether the side it crosses is known to be open.
    pub known_open: bool,
}

impl Move {
    /// A robot that stays.
    #[inline]
    pub const fn stay(at: Cell) -> Self {
        Self { from: at, step: Step::Stay, known_open: false }
    }

    /// P′: where the plan sends it.
    #[inline]
    pub const fn to(self) -> Cell {
        self.from.after(self.step)
    }

    /// Whether it is sure to be at P′ afterwards: it stays, or its way is known to be open.
    #[inline]
    pub const fn is_sure(self) -> bool {
        self.known_open || matches!(self.step, Step::Stay)
    }
}

impl Rule {
    /// The chain as the paper publishes it, but for [`Condition::EpochMustGain`], without which it may never end.
    pub const PUBLISHED: Self = Self {
        conditions: Conditions::of(&[
            Condition::SafeAhead,
            Condition::CoveredBehind,
            Condition::Distinct,
            Condition::RefusedIsVirtual,
            Condition::EpochMustGain,
        ]),
        safe: Circle::SAFE,
        covered: Circle::COVERED,
        high: High::Planned,
        budget: Budget::Unlimited,
        pursuit: Pursuit::Epochs,
    };

    /// The chain with the four repairs: of contact, of crowding, of what is left unexplored, and of what a plan costs.
    pub const REPAIRED: Self = Self { pursuit: Pursuit::Epochs, ..Self::REEL.without(Condition::Hold) };

    /// The repaired chain that reels itself in and out instead of backtracking, and holds contact whoever fails.
    pub const REEL: Self = Self::APART.without(Condition::NoExchange).without(Condition::PartsAtOnce);

    /// The reel whose robots keep apart: they exchange no cells, and two that a wall has brought into one part at once.
    pub const APART: Self = Self {
        conditions: Conditions::of(&Condition::ALL),
        budget: Budget::LooksPerRobot(100),
        pursuit: Pursuit::Reel(Habits::of(&Habit::ALL)),
        ..Self::PUBLISHED
    };

    /// Whether R_i, or the base, may plan `own` while the robot ahead of it plans `ahead`.
    #[inline]
    pub fn admits_ahead(&self, own: Move, ahead: Move) -> bool {
        let safe = !self.has(Condition::SafeAhead) || self.safe.covers(ahead.to(), own.to());
        safe && (!self.doubts(ahead) || self.covered.covers(ahead.from, own.to()))
    }

    /// Whether the rule reckons with it that the robot ahead stays where it is.
    #[inline]
    const fn doubts(&self, ahead: Move) -> bool {
        self.has(Condition::Hold) || self.has(Condition::UnsureAhead) && !ahead.is_sure()
    }

    /// The steps from `at` that [`Rule::admits_ahead`] admits.
    #[inline]
    pub fn steps_ahead(&self, at: Cell, ahead: Move) -> Steps {
        let mut steps = Steps::ALL;
        if self.has(Condition::SafeAhead) {
            steps = self.safe.covered_steps(ahead.to(), at);
        }
        if self.doubts(ahead) {
            steps = steps.and(self.covered.covered_steps(ahead.from, at));
        }
        steps
    }

    /// Whether a robot may plan to be at `to` while the robot behind it is at `behind`.
    #[inline]
    pub fn admits_behind(&self, to: Cell, behind: Cell) -> bool {
        !self.has(Condition::CoveredBehind) || self.covered.covers(behind, to)
    }

    /// The steps from `at` that [`Rule::admits_behind`] admits.
    #[inline]
    pub fn steps_behind(&self, at: Cell, behind: Cell) -> Steps {
        if self.has(Condition::CoveredBehind) { self.covered.covered_steps(behind, at) } else { Steps::ALL }
    }

    /// Whether a robot may enter a cell outside the base that `occupants` others occupy now.
    #[inline]
    pub const fn admits_entry(&self, role: Role, occupants: usize) -> bool {
        let guarded = match role {
            Role::Leader => self.has(Condition::FullForLeader),
            Role::Follower => self.has(Condition::FullForFollower),
        };
        !guarded || occupants < 2
    }

    /// Whether R_i at `behind` and R_{i+1} at `ahead` are as near as this rule keeps neighbours in the chain: in E_C of
    /// each other if it has the repair of contact (CHAIN-1), else within r_cov, centre to centre (CHAIN-3).
    #[inline]
    pub fn keeps_contact(&self, behind: Cell, ahead: Cell) -> bool {
        if self.has(Condition::UnsureAhead) || self.has(Condition::Hold) {
            self.covered.covers(behind, ahead)
        } else {
            self.covered.reaches(behind, ahead)
        }
    }

    /// Whether this rule keeps three robots out of one cell other than the base (CHAIN-2).
    #[inline]
    pub const fn keeps_apart(&self) -> bool {
        self.has(Condition::FullForFollower) && self.has(Condition::FullForLeader)
    }

    /// The steps of a follower at `at` that lead into P_high: the robot ahead would have all its moves from there.
    #[inline]
    pub fn high_steps(&self, at: Cell, ahead: Move) -> Steps {
        match self.high {
            High::Planned => neighbouring_steps(ahead.to(), at),
            High::Present => neighbouring_steps(ahead.from, at),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::neighbours;

    #[test]
    fn sets_of_steps_hold_the_steps_that_the_rule_admits_one_by_one() {
        let at = Cell::new(0, 0);
        let near = || (-5..=5).flat_map(|x| (-5..=5).map(move |y| Cell::new(x, y)));
        let present = Rule { high: High::Present, ..Rule::REPAIRED };
        let wide = Rule { safe: Circle::COVERED, covered: Circle::new(34), ..Rule::REPAIRED };
        let mutants = Condition::ALL.map(|condition| Rule::REPAIRED.without(condition));
        for rule in [Rule::PUBLISHED, Rule::REPAIRED, Rule::REEL, present, wide].iter().chain(&mutants) {
            for from in near() {
                let behind = Steps::ALL.filter(|step| rule.admits_behind(at.after(step), from));
                assert_eq!(rule.steps_behind(at, from), behind, "{rule:?} {from}");
                for (step, known_open) in Step::ALL.into_iter().flat_map(|step| [(step, false), (step, true)])
                {
                    let ahead = Move { from, step, known_open };
                    let own = |step| Move { from: at, step, known_open: false };
                    let admitted = Steps::ALL.filter(|step| rule.admits_ahead(own(step), ahead));
                    assert_eq!(rule.steps_ahead(at, ahead), admitted, "{rule:?} {ahead:?}");
                    let low = if rule.high == High::Planned { ahead.to() } else { ahead.from };
                    let high = Steps::ALL.filter(|step| neighbours(low, at.after(step)));
                    assert_eq!(rule.high_steps(at, ahead), high, "{rule:?} {ahead:?}");
                }
            }
        }
    }
}
