//! A refutation as choices: little more than numbers, and enough to play it again. Whoever plays it asks the rule
//! itself, so a list of choices is believed no farther than the rule goes along with it: every choice must be one that
//! there is, all must be made, and the demand must be broken by the last one and by none before it.

use std::fmt;

use crate::ants;
use crate::clause::{Check, Method};
use crate::decide::Evidence;
use crate::engine::{Replay, Stop};
use crate::rescue::{Setting, space};
use crate::search::{self, Bounds};
use crate::states::{Bits, Ending, Run, Step, System};

/// The choices of a refutation, each the number of what was chosen.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Choices {
    /// Those that lead to the state in which the demand is broken.
    pub once: Vec<u32>,
    /// Those that lead from that state back to it, where the demand is broken by going round for ever.
    pub again: Vec<u32>,
}

impl Choices {
    /// All of them, in order.
    fn all(&self) -> impl Iterator<Item = u32> {
        self.once.iter().chain(&self.again).copied()
    }
}

/// A refutation that was played.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Played {
    /// From how many each choice was made, in the order of the choices.
    pub of: Vec<u32>,
    /// What it comes to.
    pub evidence: Evidence,
}

/// Why choices are no refutation. Choices are counted from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unfit {
    /// There is no such choice.
    None {
        /// Which.
        at: usize,
        /// How many there are.
        of: u32,
    },
    /// The run is over before this choice.
    Over {
        /// Which.
        at: usize,
    },
    /// The run goes on after the last choice, and nothing is broken.
    Unbroken,
    /// What is to come again does not come back to where it began, or leaves out who has something left to do.
    NoRound,
}

impl Unfit {
    /// The choice that it is about, counted from 0, if it is about one.
    pub const fn at(self) -> Option<usize> {
        match self {
            Self::None { at, .. } | Self::Over { at } => Some(at),
            Self::Unbroken | Self::NoRound => None,
        }
    }
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None { of, .. } => write!(f, "there is no such choice: here there are {of}"),
            Self::Over { .. } => f.write_str("the run is over before this choice"),
            Self::Unbroken => f.write_str("after the last choice nothing is broken"),
            Self::NoRound => f.write_str("what is to come again is no round that can go on for ever"),
        }
    }
}

impl std::error::Error for Unfit {}

impl Check {
    /// Plays `choices` by the rule of the check.
    ///
    /// # Errors
    /// [`Unfit`] if they are no refutation.
    pub fn replay(&self, choices: &Choices) -> Result<Played, Unfit> {
        let subject = &self.subject;
        match self.method {
            Method::Exhaustive { body, .. } | Method::Sampled { body, .. } => {
                let answers: Vec<u32> = choices.all().collect();
                let mut replay = Replay::new(&answers);
                let outcome = body(subject, &mut replay);
                let of = replay.asked().to_vec();
                let misfit = (0..).zip(of.iter().zip(&answers)).find(|&(_, (of, answer))| answer >= of);
                if let Some((at, (&of, _))) = misfit {
                    return Err(Unfit::None { at, of });
                }
                let Err(Stop::Violated(demand)) = outcome else { return Err(Unfit::Unbroken) };
                if of.len() < answers.len() {
                    return Err(Unfit::Over { at: of.len() });
                }
                if !replay.matches() {
                    return Err(Unfit::Unbroken);
                }
                Ok(Played { of, evidence: Evidence::Choices(choices.clone(), demand) })
            }
            Method::Ants => ants::replay(subject, Script::new(choices)),
            Method::Floors(floors) => floors.replay(subject, Script::new(choices)),
            Method::Spread(networks) => networks.replay(subject, Script::new(choices)),
            Method::Search { robots, max_walls, invariant } => {
                let invariants = invariant.family().to_vec();
                let bounds = Bounds { invariants, ..Bounds::new(*subject, robots, max_walls) };
                let run = search::replay(&bounds, invariant, choices)?;
                let of = vec![2; run.answers.len()];
                Ok(Played { of, evidence: Evidence::Run(Box::new(run)) })
            }
            Method::States { setting, demand } => {
                let setting = Setting { rule: subject.rescue, ..setting };
                let (of, broken) = space::replay(&setting, demand, Script::new(choices))?;
                Ok(Played { of, evidence: Evidence::Rescue(Box::new((setting, broken))) })
            }
        }
    }
}

/// Choices that are being made.
pub(crate) struct Script<'a> {
    choices: &'a Choices,
    of: Vec<u32>,
}

impl<'a> Script<'a> {
    fn new(choices: &'a Choices) -> Self {
        Self { choices, of: Vec::new() }
    }

    /// The choices.
    pub(crate) const fn choices(&self) -> &'a Choices {
        self.choices
    }

    /// Makes the next choice, one of `of`, which is none of those that come again.
    pub(crate) fn choose(&mut self, of: usize) -> Result<usize, Unfit> {
        if self.of.len() < self.choices.once.len() { self.take(of) } else { Err(Unfit::Unbroken) }
    }

    fn take(&mut self, of: usize) -> Result<usize, Unfit> {
        let at = self.of.len();
        let of = of as u32;
        let chosen = self.choices.all().nth(at).ok_or(Unfit::Unbroken)?;
        if chosen >= of {
            return Err(Unfit::None { at, of });
        }
        self.of.push(of);
        Ok(chosen as usize)
    }

    /// Makes all choices that are left, each a step of `system`, from the start with this number. Only what `is_meant` is
    /// looked for. From how many each choice was made, and the run.
    pub(crate) fn play<S: System>(
        mut self,
        system: &S,
        (start, mut state): (usize, S::State),
        is_meant: impl Fn(&S::Demand) -> bool,
    ) -> Result<(Vec<u32>, Run<S::Demand>), Unfit> {
        let first = self.of.len();
        let still = |state: &S::State| {
            let is_still = !system.steps(state).any(|step| step.is_bound);
            is_still.then(|| system.broken_at_end(state)).flatten().filter(&is_meant)
        };
        let mut there = None;
        while self.of.len() < self.choices.once.len() {
            if there.is_some() || still(&state).is_some() {
                return Err(Unfit::Over { at: self.of.len() });
            }
            let step = self.step(system, &state)?;
            there = step.breaks.into_iter().find(&is_meant);
            state = step.state;
        }
        let (demand, ending) = match (there, still(&state)) {
            (Some(_), _) | (_, Some(_)) if !self.choices.again.is_empty() => {
                return Err(Unfit::Over { at: self.of.len() });
            }
            (Some(demand), _) => (demand, Ending::There),
            (None, Some(demand)) => (demand, Ending::Still),
            (None, None) if self.choices.again.is_empty() => return Err(Unfit::Unbroken),
            (None, None) => {
                let demand = self.round(system, state)?;
                let demand = demand.filter(&is_meant).ok_or(Unfit::NoRound)?;
                (demand, Ending::Round(self.choices.again.clone()))
            }
        };
        let steps = self.choices.once[first..].to_vec();
        Ok((self.of, Run { demand, start, steps, ending }))
    }

    fn step<S: System>(&mut self, system: &S, state: &S::State) -> Result<Step<S::State, S::Demand>, Unfit> {
        let mut steps: Vec<_> = system.steps(state).collect();
        let chosen = self.take(steps.len())?;
        Ok(steps.swap_remove(chosen))
    }

    /// Goes round from `state` once; what is broken by doing so for ever.
    fn round<S: System>(&mut self, system: &S, mut state: S::State) -> Result<Option<S::Demand>, Unfit> {
        let home = system.key(&state);
        let (mut owed, mut awake, mut acting): (Bits, Bits, Bits) = (Bits::MAX, Bits::MAX, 0);
        let mut is_bound = true;
        while self.of.len() < self.choices.once.len() + self.choices.again.len() {
            owed &= system.owed(&state);
            awake &= system.awake(&state);
            let step = self.step(system, &state)?;
            acting |= step.acting;
            is_bound &= step.is_bound;
            state = step.state;
        }
        let comes_back = system.key(&state) == home;
        let is_fair = is_bound && owed != 0 && awake & !acting == 0;
        Ok(system.broken_by_endless_runs().filter(|_| comes_back && is_fair))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clause::Verdict;
    use crate::decide::Prover;
    use crate::registry::CLAUSES;
    use crate::search::unwatched;

    /// What refutes the checks that are registered as refuted and take no long time.
    fn refuted() -> Vec<(&'static Check, Evidence)> {
        let mut prover = Prover::default();
        let is_short =
            |id: &str| ["CHAIN-14", "BRICKS-5", "BRICKS-6", "NOTICE-4", "NOTICE-5", "MRC-2"].contains(&id);
        let clauses = CLAUSES.iter().filter(|clause| is_short(clause.id));
        let checks = clauses.flat_map(|clause| clause.checks);
        let decide = |check: &'static Check| {
            let decision = prover.decide(check, &mut unwatched).expect("registered checks fit");
            (check, decision.counterexample.expect("a counterexample"))
        };
        checks.filter(|check| check.expected == Verdict::Refuted).map(decide).collect()
    }

    #[test]
    fn other_choices_refute_something_or_are_refused() {
        for (check, evidence) in refuted() {
            let choices = evidence.choices();
            let Played { of, evidence: again } = check.replay(&choices).expect("what was found");
            assert_eq!((again.choices(), again.demand()), (choices.clone(), evidence.demand()));
            let all = choices.once.len() + choices.again.len();
            assert_eq!(of.len(), all);
            for (at, &of) in of.iter().enumerate() {
                let other = |value: u32| {
                    let mut other = choices.clone();
                    *other.once.iter_mut().chain(&mut other.again).nth(at).expect("a choice") = value;
                    check.replay(&other).map(|played| played.evidence.choices() == other)
                };
                assert_eq!(other(of).map_err(Unfit::at), Err(Some(at)), "a choice that there is not");
                let near = [(other(0), 0), (other(of - 1), of - 1)];
                for (replayed, value) in near {
                    assert_ne!(replayed, Ok(false), "choice {at}, {value}: it is played as another");
                }
            }
        }
    }

    #[test]
    fn choices_that_are_cut_or_go_on_are_refused() {
        for (check, evidence) in refuted() {
            let choices = evidence.choices();
            for left in 0..choices.once.len() {
                let cut = Choices { once: choices.once[..left].to_vec(), ..choices.clone() };
                assert!(check.replay(&cut).is_err(), "{evidence:?} cut behind {left}");
            }
            // Who goes round for ever may go a part of the way more before it counts.
            let mut longer = choices.clone();
            longer.once.push(0);
            let is_round = !choices.again.is_empty();
            assert!(check.replay(&longer).is_err() || is_round, "{evidence:?} goes on");
            let mut round = choices.clone();
            round.again.push(0);
            assert!(check.replay(&round).is_err(), "{evidence:?} goes round farther");
        }
    }
}
