//! The registry. A clause is registered once: its id and sentence, and the checks that decide it, each with the
//! rule it is about, the engine, the bound, the expected verdict and the mutants that must be rejected. Of a step
//! check one macro makes the exhaustive test, the property, the Kani harnesses and the line in the ledger.

use tautline_kernel::ants;
use tautline_kernel::bricks;
use tautline_kernel::broadcast::{self, Conditions};
use tautline_kernel::chain::{Condition, High, Rule};
use tautline_kernel::choice::Source;
use tautline_kernel::lattice::Circle;
use tautline_kernel::rescue;

use crate::course::Explored;
use crate::engine::Outcome;
use crate::invariant::Invariant;
use crate::notice::Networks;
use crate::rescue::{Demand, Setting};

/// What a check is about: the rules, and how the observer of a mutant is deceived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Subject {
    /// The rule that the team follows.
    pub rule: Rule,
    /// The rule that it claims to follow.
    pub intended: Rule,
    /// What is done to it behind its back.
    pub sabotage: Sabotage,
    /// The rule of Ants.
    pub ants: ants::Rule,
    /// The rule of Brick&Mortar.
    pub bricks: bricks::Rule,
    /// That of Brick&Mortar made robust against missed sensors.
    pub bricks_ants: bricks::Rule,
    /// The rule of a rescue.
    pub rescue: rescue::Rule,
    /// The conditions that the nodes of a network follow.
    pub notice: Conditions,
}

/// What no set of conditions can express, done to a mutant on the way from the rule to the check.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sabotage {
    /// Nothing.
    None,
    /// Bits 0 and 3 of every message are swapped.
    SwappedBits,
    /// The plan sends the base along with R_2.
    BaseFollows,
    /// The planner is the plain recursion.
    PlainRecursion,
    /// The plain recursion takes nobody ahead for sure to arrive.
    DoubtsAll,
    /// A virtual obstacle binds followers, too.
    BindsFollowers,
    /// One row and one column of a grid are not flooded.
    SkipsALine,
    /// Agents beside each other scan and write at once.
    ActsAtOnce,
    /// Sensors do not count crossings.
    CountsNothing,
    /// Sensors are localised with errors of more than half a cell.
    LocalisesBadly,
    /// k = ∞ is taken for k = 1.
    FiniteForEndless,
}

impl Sabotage {
    /// The byte that arrives when `byte` is sent.
    pub const fn carry(self, byte: u8) -> u8 {
        match self {
            Self::SwappedBits => byte & !0b1001 | (byte & 1) << 3 | byte >> 3 & 1,
            Self::None
            | Self::BaseFollows
            | Self::PlainRecursion
            | Self::DoubtsAll
            | Self::BindsFollowers
            | Self::SkipsALine
            | Self::ActsAtOnce
            | Self::CountsNothing
            | Self::LocalisesBadly
            | Self::FiniteForEndless => byte,
        }
    }
}

impl Subject {
    /// Everything as published.
    pub const PUBLISHED: Self = Self {
        rule: Rule::PUBLISHED,
        intended: Rule::PUBLISHED,
        sabotage: Sabotage::None,
        ants: ants::Rule::Published,
        bricks: bricks::Rule::PUBLISHED,
        bricks_ants: bricks::Rule::ROBUST,
        rescue: rescue::Rule::PUBLISHED,
        notice: Conditions::PUBLISHED,
    };
    /// Everything repaired.
    pub const REPAIRED: Self = Self {
        rule: Rule::REPAIRED,
        intended: Rule::REPAIRED,
        sabotage: Sabotage::None,
        ants: ants::Rule::Repaired,
        bricks: bricks::Rule::REPAIRED,
        bricks_ants: bricks::Rule::ROBUST,
        rescue: rescue::Rule::REPAIRED,
        notice: Conditions::REPAIRED,
    };

    /// Agents that follow `rule`.
    pub const fn marking(rule: bricks::Rule) -> Self {
        Self { bricks: rule, ..Self::REPAIRED }
    }

    /// Agents that follow the robust rule without one condition.
    pub const fn marking_twice_without(condition: bricks::Condition) -> Self {
        Self { bricks_ants: bricks::Rule::ROBUST.without(condition), ..Self::REPAIRED }
    }

    /// A team that claims to follow the repaired rule, but follows `rule`.
    pub const fn following(rule: Rule) -> Self {
        Self { rule, ..Self::REPAIRED }
    }

    /// The repaired chain without one condition.
    pub const fn without(condition: Condition) -> Self {
        Self::following(Rule::REPAIRED.without(condition))
    }

    /// Robots and WFRs that follow `rule`.
    pub const fn rescuing(rule: rescue::Rule) -> Self {
        Self { rescue: rule, ..Self::REPAIRED }
    }

    /// The repaired chain, sabotaged.
    pub const fn sabotaged(sabotage: Sabotage) -> Self {
        Self { sabotage, ..Self::REPAIRED }
    }

    /// The repaired chain with another circle of E_S.
    pub const fn with_safe(safe: Circle) -> Self {
        Self::following(Rule { safe, ..Rule::REPAIRED })
    }

    /// The repaired chain with another circle of E_C.
    pub const fn with_covered(covered: Circle) -> Self {
        Self::following(Rule { covered, ..Rule::REPAIRED })
    }

    /// Nodes that broadcast by the repaired rule without one condition.
    pub const fn hearing_without(condition: broadcast::Condition) -> Self {
        Self { notice: Conditions::REPAIRED.without(condition), ..Self::REPAIRED }
    }

    /// The repaired chain that reads P_high from present positions.
    pub const fn high_from_present() -> Self {
        Self::following(Rule { high: High::Present, ..Rule::REPAIRED })
    }
}

/// A clause of `SPEC.md`.
#[derive(Debug)]
pub struct Clause {
    /// Its heading.
    pub id: &'static str,
    /// Its MUST sentence, word for word.
    pub sentence: &'static str,
    /// What decides it.
    pub checks: &'static [Check],
}

/// A body: one case of a clause, made by the choices that the source answers.
pub type Body = fn(&Subject, &mut dyn Source) -> Outcome;

/// One way to decide a clause for one rule.
#[derive(Debug)]
pub struct Check {
    /// The rule it is about.
    pub subject: Subject,
    /// How it is decided.
    pub method: Method,
    /// What the method covers, in words.
    pub bound: &'static str,
    /// What must come out.
    pub expected: Verdict,
    /// Subjects for which the check must fail.
    pub mutants: &'static [Mutant],
}

/// How a check is decided.
#[derive(Clone, Copy, Debug)]
pub enum Method {
    /// Every answer to every choice of a body.
    Exhaustive {
        /// The body.
        body: Body,
        /// The situations that must occur, sorted.
        covers: &'static [&'static str],
    },
    /// Many random answers to the choices of a body.
    Sampled {
        /// The body.
        body: Body,
        /// How many times.
        runs: u64,
        /// The situations that must occur, sorted.
        covers: &'static [&'static str],
    },
    /// Every state of agents on small floors.
    Floors {
        /// Goes through them.
        explore: fn(&Subject) -> Explored,
        /// The situations that must occur, sorted.
        covers: &'static [&'static str],
    },
    /// Every state of an event on its way through small networks.
    Spread {
        /// The networks, and the demand on every state.
        networks: Networks,
        /// The situations that must occur, sorted.
        covers: &'static [&'static str],
    },
    /// Every layout within a bound.
    Search {
        /// Robots, base included.
        robots: usize,
        /// Most walls that are met in one run.
        max_walls: u32,
        /// What every team move is checked for.
        invariant: Invariant,
    },
    /// Every state of a rescue.
    States {
        /// Robots, WFRs and faults; its rule is the subject's.
        setting: Setting,
        /// What every state, or every run, is checked for.
        demand: Demand,
    },
}

impl Method {
    /// The engine's name.
    pub const fn engine(self) -> &'static str {
        match self {
            Self::Exhaustive { .. } => "exhaustive",
            Self::Sampled { .. } => "sampled",
            Self::Search { .. } => "search",
            Self::Floors { .. } | Self::Spread { .. } | Self::States { .. } => "states",
        }
    }
}

/// A subject that a check must reject.
#[derive(Debug)]
pub struct Mutant {
    /// What is wrong with it.
    pub name: &'static str,
    /// The subject.
    pub subject: Subject,
}

/// What a check found.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// Within the bound the clause holds.
    Holds,
    /// There is a counterexample.
    Refuted,
    /// Neither: the check ended before its bound, or did not cover what it claims to.
    Open,
}

impl Verdict {
    /// The word in the ledger.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Refuted => "refuted",
            Self::Open => "open",
        }
    }
}
