//! The registry. A clause is registered once: its id and sentence, and the checks that decide it, each with the
//! rule it is about, the engine, the bound, the expected verdict and the mutants that must be rejected. Of a step
//! check one macro makes the exhaustive test, the property, the Kani harnesses and the line in the ledger.

use tautline_kernel::ants;
use tautline_kernel::bricks;
use tautline_kernel::chain::{Budget, Condition, High, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::Circle;
use tautline_kernel::mrc;
use tautline_kernel::notice::Conditions;

use crate::bricks::Floors;
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
    /// The rule of a rescue.
    pub rescue: mrc::Rule,
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
    /// A message of a rescue is misread.
    Misreads(Misread),
}

/// How a message of a rescue is misread where it arrives.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Misread {
    /// A path node takes all robots for one.
    OneRobot,
    /// A path node takes all calls of a WFR for one.
    OneCall,
    /// A robot takes any node nearer to its WFR for one that is one hop nearer.
    AnyNearer,
    /// A robot takes any node for the one that it has asked.
    AnyNode,
    /// A robot takes the tree of any WFR for that of its own.
    AnyTree,
    /// A robot takes a node for its own parent.
    NoParent,
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
            | Self::FiniteForEndless
            | Self::Misreads(_) => byte,
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
        rescue: mrc::Rule::PUBLISHED,
        notice: Conditions::PUBLISHED,
    };
    /// Everything repaired.
    pub const REPAIRED: Self = Self {
        rule: Rule::REPAIRED,
        intended: Rule::REPAIRED,
        sabotage: Sabotage::None,
        ants: ants::Rule::Repaired,
        bricks: bricks::Rule::REPAIRED,
        rescue: mrc::Rule::REPAIRED,
        notice: Conditions::REPAIRED,
    };

    /// Everything repaired, and agents robust against missed sensors.
    pub const ROBUST: Self = Self::marking(bricks::Rule::ROBUST);

    /// The chain as published, without *CoveredBehind*: CHAIN-3 does not need it.
    pub const UNCOVERED: Self = {
        let rule = Rule::PUBLISHED.without(Condition::CoveredBehind);
        Self { rule, intended: rule, ..Self::PUBLISHED }
    };

    /// The repaired chain with so small a budget that many plans use it up, also in small areas.
    pub const SPARING: Self = {
        let rule = Rule { budget: Budget::LooksPerRobot(4), ..Rule::REPAIRED };
        Self { rule, intended: rule, ..Self::REPAIRED }
    };

    /// The subjects that have a name.
    const NAMED: [(Self, &'static str); 5] = [
        (Self::PUBLISHED, "published"),
        (Self::REPAIRED, "repaired"),
        (Self::ROBUST, "robust"),
        (Self::UNCOVERED, "uncovered"),
        (Self::SPARING, "sparing"),
    ];

    /// The name of the rule; of a mutant, none.
    pub fn name(&self) -> Option<&'static str> {
        Self::NAMED.iter().find(|(named, _)| named == self).map(|&(_, name)| name)
    }

    /// Agents that follow `rule`.
    pub const fn marking(rule: bricks::Rule) -> Self {
        Self { bricks: rule, ..Self::REPAIRED }
    }

    /// Agents that follow the robust rule without one condition.
    pub const fn marking_twice_without(condition: bricks::Condition) -> Self {
        Self::marking(bricks::Rule::ROBUST.without(condition))
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
    pub const fn rescuing(rule: mrc::Rule) -> Self {
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
    pub const fn hearing_without(condition: tautline_kernel::notice::Condition) -> Self {
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

/// A body: one case of a clause, made by the choices that the oracle answers.
pub type Body = fn(&Subject, &mut dyn Oracle) -> Outcome;

/// One way to decide a clause for one rule.
#[derive(Debug)]
pub struct Check {
    /// The rule it is about.
    pub subject: Subject,
    /// How it is decided.
    pub method: Method,
    /// What must come out.
    pub expected: Verdict,
    /// Subjects for which the check must fail.
    pub mutants: &'static [Mutant],
}

/// The bound of a body in words, made from the numbers that its choices range over.
pub type Range = fn() -> String;

/// How a check is decided.
#[derive(Clone, Copy, Debug)]
pub enum Method {
    /// Every answer to every choice of a body.
    Exhaustive {
        /// The body.
        body: Body,
        /// What its choices range over.
        range: Range,
        /// The situations that must occur, sorted.
        covers: &'static [&'static str],
    },
    /// Many random answers to the choices of a body.
    Sampled {
        /// The body.
        body: Body,
        /// How many times.
        runs: u64,
        /// What its choices range over: what so many of are drawn.
        range: Range,
        /// The situations that must occur, sorted.
        covers: &'static [&'static str],
    },
    /// Every state of Ants on small floors.
    Ants,
    /// Every state of agents that mark cells, on small floors.
    Floors(Floors),
    /// Every state of an event on its way through small networks.
    Spread(Networks),
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
            Self::Ants | Self::Floors(_) | Self::Spread(_) | Self::States { .. } => "states",
        }
    }

    /// What it covers, in words that are made from the data that runs.
    pub fn bound(self) -> String {
        match self {
            Self::Exhaustive { range, .. } => range(),
            Self::Sampled { runs, range, .. } => format!("{runs} {}", range()),
            Self::Ants => crate::ants::bound(),
            Self::Floors(floors) => floors.bound(),
            Self::Spread(networks) => networks.bound(),
            Self::Search { robots, max_walls, .. } => {
                format!("all layouts, N = {robots}, at most {max_walls} walls")
            }
            Self::States { setting, .. } => setting.bound(),
        }
    }

    /// What is shown by it when it finds no counterexample within its bound.
    pub const fn shows(self) -> Verdict {
        match self {
            Self::Exhaustive { .. }
            | Self::Ants
            | Self::Floors(_)
            | Self::Spread(_)
            | Self::Search { .. }
            | Self::States { .. } => Verdict::Holds,
            Self::Sampled { .. } => Verdict::Unrefuted,
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
    /// Every case within the bound was looked at, and none breaks the clause.
    Holds,
    /// Cases were sampled, and none of them breaks the clause.
    Unrefuted,
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
            Self::Unrefuted => "unrefuted",
            Self::Refuted => "refuted",
            Self::Open => "open",
        }
    }
}
