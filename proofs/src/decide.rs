//! Deciding a check: its verdict, and whether its mutants are rejected. A verdict of a search is remembered, since
//! one search looks for several invariants at once.

use crate::ants;
use crate::bricks::Floors;
use crate::clause::{Check, Method, Subject, Verdict};
use crate::course::{Course, Explored};
use crate::engine::{self, Tally};
use crate::evidence::Choices;
use crate::notice;
use crate::rescue::{Setting, space};
use crate::search::{Bounds, Counterexample, Found, Unsearchable, Until, Watch, search};
use crate::states::END;

/// What came of a check.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Decision {
    /// What it found.
    pub verdict: Verdict,
    /// Cases of a body that met its assumptions, runs of a search, or states.
    pub cases: u64,
    /// Cases that were given up undecided; they are not among the others.
    pub given_up: u64,
    /// The counterexample, if it is refuted.
    pub counterexample: Option<Evidence>,
    /// Mutants that were rejected.
    pub killed: Vec<&'static str>,
    /// Mutants that were not: the check is too weak.
    pub survived: Vec<&'static str>,
}

impl Decision {
    /// Whether `check` came out as it is registered.
    pub fn is_as_registered(&self, check: &Check) -> bool {
        self.verdict == check.expected && self.survived.is_empty()
    }
}

/// A counterexample.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Evidence {
    /// The choices that lead a body or a system to it, and the demand that is not met.
    Choices(Choices, &'static str),
    /// A run of a chain.
    Run(Box<Counterexample>),
    /// A run of agents on a floor, its choices, and the demand that is not met.
    Course(Box<Course>, Choices, &'static str),
    /// A run of robots and WFRs.
    Rescue(Box<(Setting, space::Broken)>),
}

impl Evidence {
    /// The choices that make it again.
    pub fn choices(&self) -> Choices {
        match self {
            Self::Choices(choices, _) | Self::Course(_, choices, _) => choices.clone(),
            Self::Run(run) => Choices { once: run.answers.clone(), again: Vec::new() },
            Self::Rescue(run) => run.1.choices(&run.0),
        }
    }

    /// The demand that is not met, or what is not so.
    pub fn demand(&self) -> &'static str {
        match self {
            Self::Choices(_, demand) | Self::Course(_, _, demand) => demand,
            Self::Run(run) => run.demand,
            Self::Rescue(run) => run.1.demand.broken(),
        }
    }
}

/// Decides checks, and keeps what may be asked again.
#[derive(Default, Debug)]
pub struct Prover {
    searches: Vec<(Bounds, Found)>,
    spaces: Vec<((Setting, space::Until), space::Found)>,
    /// Floors on which everything was looked at that several clauses demand of them.
    floors: Vec<((Floors, Subject), Explored)>,
}

/// Steps between states at which a check is left open.
const MOST_STEPS: u32 = 20_000_000;

/// The seed of every sampled check.
const SEED: u64 = 0;

impl Prover {
    /// Decides `check`. `watch` hears of searches only; a search that it ends leaves the check open.
    ///
    /// # Errors
    /// [`Unsearchable`] if a registered search has too many robots.
    pub fn decide(&mut self, check: &Check, watch: Watch<'_>) -> Result<Decision, Unsearchable> {
        let mut decision = self.settle(check, &check.subject, Until::Exhausted, watch)?;
        for mutant in check.mutants {
            let verdict = self.settle(check, &mutant.subject, Until::Violation, watch)?.verdict;
            match verdict {
                Verdict::Refuted => decision.killed.push(mutant.name),
                Verdict::Holds | Verdict::Unrefuted | Verdict::Open => decision.survived.push(mutant.name),
            }
        }
        Ok(decision)
    }

    fn settle(
        &mut self,
        check: &Check,
        subject: &Subject,
        until: Until,
        watch: Watch<'_>,
    ) -> Result<Decision, Unsearchable> {
        let shown = check.method.shows();
        let of_tally = |tally, covers: &[&str]| Decision::of_tally(tally, covers, shown);
        match check.method {
            Method::Exhaustive { body, covers, .. } => {
                Ok(of_tally(engine::exhaust(|source| body(subject, source)), covers))
            }
            Method::Sampled { body, runs, covers, .. } => {
                Ok(of_tally(engine::sample(runs, SEED, |source| body(subject, source)), covers))
            }
            Method::Ants => Ok(Decision::of_floors(ants::explore(subject), shown)),
            Method::Floors(floors) => Ok(Decision::of_floors(self.explore(floors, subject, until), shown)),
            Method::Spread(networks) => Ok(of_tally(networks.explore(subject), &notice::EVENTS)),
            Method::Search { robots, max_walls, invariant } => {
                let invariants = match until {
                    Until::Exhausted => invariant.family().to_vec(),
                    Until::Violation => vec![invariant],
                };
                let bounds = Bounds { invariants, until, ..Bounds::new(*subject, robots, max_walls) };
                let found = self.search(bounds, watch)?;
                let counterexample = found.counterexamples.iter().find(|found| found.invariant == invariant);
                let verdict = match counterexample {
                    Some(_) => Verdict::Refuted,
                    None if found.complete => shown,
                    None => Verdict::Open,
                };
                let counterexample = counterexample.map(|run| Evidence::Run(Box::new(run.clone())));
                Ok(Decision::new(verdict, found.runs, counterexample))
            }
            Method::States { setting, demand } => {
                let setting = Setting { rule: subject.rescue, ..setting };
                let until = match until {
                    Until::Exhausted => space::Until::Exhausted,
                    Until::Violation => space::Until::Broken(demand),
                };
                let found = self.states(setting, until);
                let broken = found.broken(demand).cloned();
                let verdict = match broken {
                    Some(_) => Verdict::Refuted,
                    None if found.complete => shown,
                    None => Verdict::Open,
                };
                let evidence = broken.map(|broken| Evidence::Rescue(Box::new((setting, broken))));
                Ok(Decision::new(verdict, found.states, evidence))
            }
        }
    }

    /// What several clauses demand of the same floors is looked at in one pass. Where something is broken there, each
    /// looks for its own first violation.
    fn explore(&mut self, floors: Floors, subject: &Subject, until: Until) -> Explored {
        let Some(together) = floors.together().filter(|_| until == Until::Exhausted) else {
            return floors.explore(subject);
        };
        let key = (together, *subject);
        let known = self.floors.iter().position(|(known, _)| *known == key);
        let place = known.unwrap_or(self.floors.len());
        if known.is_none() {
            self.floors.push((key, together.explore(subject)));
        }
        let explored = &self.floors[place].1;
        if explored.tally.violation.is_none() { explored.clone() } else { floors.explore(subject) }
    }

    fn search(&mut self, bounds: Bounds, watch: Watch<'_>) -> Result<&Found, Unsearchable> {
        let known = self.searches.iter().position(|(known, _)| *known == bounds);
        let place = known.unwrap_or(self.searches.len());
        if known.is_none() {
            let found = search(&bounds, watch)?;
            self.searches.push((bounds, found));
        }
        Ok(&self.searches[place].1)
    }

    fn states(&mut self, setting: Setting, until: space::Until) -> &space::Found {
        let known = self.spaces.iter().position(|(known, _)| *known == (setting, until));
        let place = known.unwrap_or(self.spaces.len());
        if known.is_none() {
            self.spaces.push(((setting, until), space::search(&setting, until, MOST_STEPS)));
        }
        &self.spaces[place].1
    }
}

impl Decision {
    const fn new(verdict: Verdict, cases: u64, counterexample: Option<Evidence>) -> Self {
        Self { verdict, cases, given_up: 0, counterexample, killed: Vec::new(), survived: Vec::new() }
    }

    /// A tally without a violation shows `shown`, but not for want of cases: one that did not cover what it claims to
    /// gives no verdict.
    fn of_tally(tally: Tally, covers: &[&str], shown: Verdict) -> Self {
        let verdict = match tally.violation {
            Some(_) => Verdict::Refuted,
            None if covers.iter().all(|situation| tally.covered.contains(situation)) => shown,
            None => Verdict::Open,
        };
        let choices = |once| Choices { once, again: Vec::new() };
        let evidence = tally.violation.map(|(once, demand)| Evidence::Choices(choices(once), demand));
        Self { given_up: tally.given_up, ..Self::new(verdict, tally.cases, evidence) }
    }

    fn of_floors(Explored { tally, again, course }: Explored, shown: Verdict) -> Self {
        let decision = Self::of_tally(tally, &[END], shown);
        let counterexample = decision.counterexample.map(|evidence| {
            let (choices, demand) = (Choices { again, ..evidence.choices() }, evidence.demand());
            match course {
                Some(course) => Evidence::Course(Box::new(course), choices, demand),
                None => Evidence::Choices(choices, demand),
            }
        });
        Self { counterexample, ..decision }
    }
}
