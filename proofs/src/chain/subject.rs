//! A chain as a check observes it: the rule that it follows, the rule that it claims to follow, and what no set of
//! conditions can express, done to a mutant on the way from the rule to the check.

use tautline_kernel::chain::{Budget, Condition, Habit, High, Pursuit, Rule};
use tautline_kernel::ground::{Circle, Step};

use super::readings::{Reading, Readings};
use crate::clause::NamedRule;

/// How the observer of a mutant is deceived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Deception {
    /// Not at all.
    None,
    /// Bits 0 and 3 of every message are swapped.
    SwappedBits,
    /// The plan sends the base along with R_2.
    BaseFollows,
    /// The planner is the plain recursion.
    PlainRecursion,
    /// The plain recursion takes nobody ahead for sure to arrive.
    DoubtsAll,
}

impl Deception {
    /// The byte that arrives when `byte` is sent.
    pub const fn carry(self, byte: u8) -> u8 {
        match self {
            Self::SwappedBits => byte & !0b1001 | (byte & 1) << 3 | byte >> 3 & 1,
            Self::None | Self::BaseFollows | Self::PlainRecursion | Self::DoubtsAll => byte,
        }
    }
}

/// A chain that is observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Subject {
    /// The rule that it follows.
    pub rule: Rule,
    /// The rule that it claims to follow.
    pub intended: Rule,
    /// A deception of the chain behind its back.
    pub deception: Deception,
    /// The readings that it follows, of those that no rule expresses.
    pub readings: Readings,
    /// The order of equal candidates.
    pub order: [Step; 5],
}

impl Subject {
    /// As published.
    pub const PUBLISHED: Self = Self::honest(Rule::PUBLISHED);

    /// Repaired.
    pub const REPAIRED: Self = Self::honest(Rule::REPAIRED);

    /// As published, without *CoveredBehind*: CHAIN-3 does not need it.
    pub const UNCOVERED: Self = Self::honest(Rule::PUBLISHED.without(Condition::CoveredBehind));

    /// Repaired, with so small a budget that many plans use it up, also in small areas.
    pub const SPARING: Self = Self::honest(Rule { budget: Budget::LooksPerRobot(4), ..Rule::REPAIRED });

    /// The reel.
    pub const REEL: Self = Self::honest(Rule::REEL);

    /// The reel whose robots keep apart.
    pub const APART: Self = Self::honest(Rule::APART);

    /// The reel without *Hold*: within the repaired conditions.
    pub const UNHELD: Self = Self::honest(Rule::REEL.without(Condition::Hold));

    /// A chain that follows the rule that it claims to follow.
    pub const fn honest(rule: Rule) -> Self {
        let (deception, readings, order) = (Deception::None, Readings::of(&[]), Step::ALL);
        Self { rule, intended: rule, deception, readings, order }
    }

    /// Whether it follows a reading that no rule expresses.
    pub(super) fn has_readings(&self) -> bool {
        self.readings != Readings::of(&[]) || self.order != Step::ALL
    }

    /// It, which claims what it claims, but follows `rule`.
    pub const fn following(self, rule: Rule) -> Self {
        Self { rule, ..self }
    }

    /// It, without one condition.
    pub const fn without(self, condition: Condition) -> Self {
        self.following(self.rule.without(condition))
    }

    /// It, if it is a reel, without some of its habits.
    pub const fn without_habits(self, habits: &[Habit]) -> Self {
        let Pursuit::Reel(mut left) = self.rule.pursuit else { return self };
        let mut place = 0;
        while place < habits.len() {
            left = left.without(habits[place]);
            place += 1;
        }
        self.following(Rule { pursuit: Pursuit::Reel(left), ..self.rule })
    }

    /// It, deceiving.
    pub const fn deceiving(self, deception: Deception) -> Self {
        Self { deception, ..self }
    }

    /// It, with another circle of E_S.
    pub const fn with_safe(self, safe: Circle) -> Self {
        self.following(Rule { safe, ..self.rule })
    }

    /// It, with another circle of E_C.
    pub const fn with_covered(self, covered: Circle) -> Self {
        self.following(Rule { covered, ..self.rule })
    }

    /// It, reading P_high from present positions.
    pub const fn high_from_present(self) -> Self {
        self.following(Rule { high: High::Present, ..self.rule })
    }
}

/// The published chain under these readings.
const fn read(readings: &[Reading]) -> Subject {
    Subject { readings: Readings::of(readings), ..Subject::PUBLISHED }
}

/// The null move stands last.
pub(super) const LAST: (&str, Subject) = ("last", read(&[Reading::NullLast]));

/// The readings but for the published one that make a difference.
pub(super) const READINGS: [(&str, Subject); 3] =
    [LAST, ("row", read(&[Reading::InARow])), ("row + last", read(&[Reading::InARow, Reading::NullLast]))];

/// Followers that look where the robot ahead is, not where it goes.
pub(super) const fn high_from_present(subject: Subject) -> NamedRule<Subject> {
    NamedRule::new("P_high from present positions", subject.high_from_present())
}

pub(super) const fn safe_too_wide(subject: Subject) -> NamedRule<Subject> {
    NamedRule::new("E_S with the radius of E_C", subject.with_safe(Circle::COVERED))
}

pub(super) const fn base_follows(subject: Subject) -> NamedRule<Subject> {
    NamedRule::new("the base follows R_2", subject.deceiving(Deception::BaseFollows))
}

pub(super) const fn swapped_bits(subject: Subject) -> NamedRule<Subject> {
    NamedRule::new("message bits swapped", subject.deceiving(Deception::SwappedBits))
}
