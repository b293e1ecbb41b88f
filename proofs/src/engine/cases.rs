//! The search of cases, each of which is examined by itself: all layouts of an area, say. Cases come in stages,
//! smallest first, and no stage is examined after one in which enough was found. They are examined in waves of a fixed
//! number, so that all comes out the same on any number of threads.
//!
//! Cases can be dealt out among shards. A shard examines its own cases, stage by stage, until it has found enough
//! itself; the outcomes of all shards are put together by the same search that one process makes.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

use super::threads;
use super::watchdog::Steps;

/// Cases that are examined together.
const WAVE: usize = 64;

/// Cases in stages.
pub trait Cases: Sync {
    /// Data that the cases of a stage share.
    type Stage: Copy + Send + Sync;
    /// A part of the work that is examined by itself.
    type Case: Send + Sync;
    /// The outcome of a case.
    type Outcome: Outcome;
    /// The findings in all cases together.
    type Findings: Default;
    /// Why a case cannot be examined.
    type Error: Send;

    /// All stages, in their order.
    fn stages(&self) -> Vec<Self::Stage>;

    /// The cases of a stage, always in the same order.
    ///
    /// # Errors
    /// Its fault, if one of them cannot be made.
    fn cases(&self, stage: Self::Stage) -> Result<Vec<Self::Case>, Self::Error>;

    /// About how many steps it takes to examine a case; only how they compare matters.
    fn weight(&self, stage: Self::Stage, case: &Self::Case) -> u64;

    /// Examines a case, and may give it up after so many steps.
    ///
    /// # Errors
    /// Its fault, if it cannot be examined.
    fn examine(
        &self,
        stage: Self::Stage,
        case: &Self::Case,
        most_steps: u64,
    ) -> Result<Self::Outcome, Self::Error>;

    /// Adds an outcome to what was found in the cases before.
    ///
    /// # Errors
    /// Its fault, if what was seen cannot be told.
    fn add(
        &self,
        found: &mut Self::Findings,
        case: &Self::Case,
        outcome: Self::Outcome,
    ) -> Result<(), Self::Error>;

    /// All cases of a stage were examined, and a later one may follow.
    fn cover(&self, found: &mut Self::Findings, stage: Self::Stage);
}

/// The outcome of a case.
pub trait Outcome: Send {
    /// Steps that were made.
    fn steps(&self) -> u64;

    /// Whether all of the case was examined.
    fn is_whole(&self) -> bool;

    /// Whether no later stage is to be examined.
    fn is_enough(&self) -> bool;
}

/// Searches all cases until enough is found, `watch` ends the work, or so many steps are made. Whether the search came
/// to its end stands beside what was found.
///
/// # Errors
/// The fault of a case.
pub fn search<L: Cases>(
    cases: &L,
    budget_steps: Option<u64>,
    watch: &mut dyn FnMut(&L::Findings) -> ControlFlow<()>,
) -> Result<(L::Findings, bool), L::Error> {
    gather(cases, budget_steps, |_, stage, wave, most_steps| outcomes(cases, stage, wave, most_steps), watch)
}

/// The findings that one process would have had, by the outcomes of all shards, each stage by stage. A case that no
/// shard has was not examined.
///
/// # Errors
/// The fault of a case.
pub fn merged<L: Cases>(
    cases: &L,
    shards: Vec<Vec<Vec<L::Outcome>>>,
) -> Result<(L::Findings, bool), L::Error> {
    let owners = deal(cases, shards.len())?;
    let mut shards: Vec<Vec<_>> =
        shards.into_iter().map(|stages| stages.into_iter().map(Vec::into_iter).collect()).collect();
    let mut next = |stage: usize, case: usize| {
        let &owner = owners.get(stage)?.get(case)?;
        shards.get_mut(owner)?.get_mut(stage)?.next()
    };
    let mut at = (0, 0);
    gather(
        cases,
        None,
        |number, _, wave, _| {
            let first = if at.0 == number { at.1 } else { 0 };
            at = (number, first + wave.len());
            Ok((first..at.1).map_while(|case| next(number, case)).collect())
        },
        &mut |_| ControlFlow::Continue(()),
    )
}

/// The search, whoever examines a wave of cases.
fn gather<L: Cases>(
    cases: &L,
    budget_steps: Option<u64>,
    mut take: impl FnMut(usize, L::Stage, &[L::Case], u64) -> Result<Vec<L::Outcome>, L::Error>,
    watch: &mut dyn FnMut(&L::Findings) -> ControlFlow<()>,
) -> Result<(L::Findings, bool), L::Error> {
    let (mut found, mut left) = (L::Findings::default(), budget_steps.unwrap_or(u64::MAX));
    for (number, stage) in cases.stages().into_iter().enumerate() {
        let mut is_enough = false;
        for wave in cases.cases(stage)?.chunks(WAVE) {
            if left == 0 {
                return Ok((found, false));
            }
            let outcomes = take(number, stage, wave, left)?;
            let mut is_whole = outcomes.len() == wave.len();
            for (case, outcome) in wave.iter().zip(outcomes) {
                left = left.saturating_sub(outcome.steps());
                is_whole &= outcome.is_whole();
                is_enough |= outcome.is_enough();
                cases.add(&mut found, case, outcome)?;
            }
            if !is_whole || watch(&found).is_break() {
                return Ok((found, false));
            }
        }
        if is_enough {
            break;
        }
        cases.cover(&mut found, stage);
    }
    Ok((found, true))
}

fn outcomes<'a, L: Cases<Case: 'a>>(
    cases: &L,
    stage: L::Stage,
    wave: impl IntoIterator<Item = &'a L::Case>,
    most_steps: u64,
) -> Result<Vec<L::Outcome>, L::Error> {
    let examine = |case| {
        let _steps = Steps::begin();
        cases.examine(stage, case, most_steps)
    };
    threads::each(wave, examine).into_iter().collect()
}

/// Of each stage the shard of each case: the heaviest cases first, each goes to the shard that has least until then.
fn deal<L: Cases>(cases: &L, shards: usize) -> Result<Vec<Vec<usize>>, L::Error> {
    let mut loads: BinaryHeap<Reverse<(u64, usize)>> = (0..shards).map(|shard| Reverse((0, shard))).collect();
    let deal_stage = |stage: L::Stage| {
        let all = cases.cases(stage)?;
        let mut heaviest: Vec<(Reverse<u64>, usize)> =
            all.iter().enumerate().map(|(place, case)| (Reverse(cases.weight(stage, case)), place)).collect();
        heaviest.sort_unstable();
        let mut owners = vec![0; all.len()];
        for (Reverse(weight), place) in heaviest {
            let Some(Reverse((load, shard))) = loads.pop() else { break };
            owners[place] = shard;
            loads.push(Reverse((load.saturating_add(weight), shard)));
        }
        Ok(owners)
    };
    cases.stages().into_iter().map(deal_stage).collect()
}

/// How many cases each of so many shards has.
///
/// # Errors
/// The fault of a case.
pub fn dealt<L: Cases>(cases: &L, shards: usize) -> Result<Vec<u64>, L::Error> {
    let mut left = vec![0; shards];
    for owner in deal(cases, shards)?.into_iter().flatten() {
        left[owner] += 1;
    }
    Ok(left)
}

/// A shard of the cases, and the outcomes of those that it has examined.
pub struct Shard<L: Cases> {
    cases: L,
    /// Its number, the first being 0.
    number: usize,
    stages: Vec<L::Stage>,
    /// Of each stage the shard of each case.
    owners: Vec<Vec<usize>>,
    /// Of each stage that was begun, the outcomes of its own cases.
    outcomes: Vec<Vec<L::Outcome>>,
    /// Its own cases of the last stage that was begun.
    own: Vec<L::Case>,
    left: u64,
}

impl<L: Cases> Shard<L> {
    /// The shard with this number, the first being 0, of so many; it has these outcomes.
    ///
    /// # Errors
    /// The fault of a case.
    pub fn new(
        cases: L,
        (number, of): (usize, usize),
        mut outcomes: Vec<Vec<L::Outcome>>,
        budget_steps: Option<u64>,
    ) -> Result<Self, L::Error> {
        let (stages, owners) = (cases.stages(), deal(&cases, of)?);
        outcomes.truncate(stages.len());
        let left = budget_steps.unwrap_or(u64::MAX);
        let mut shard = Self { cases, number, stages, owners, outcomes, own: Vec::new(), left };
        shard.own = shard.own_cases()?;
        shard.go_on()?;
        Ok(shard)
    }

    /// The outcomes of those that it has examined, stage by stage.
    pub fn outcomes(&self) -> &[Vec<L::Outcome>] {
        &self.outcomes
    }

    /// Examines its next cases. Returns whether there is more to do, and to spend.
    ///
    /// # Errors
    /// The fault of a case.
    pub fn wave(&mut self) -> Result<bool, L::Error> {
        if self.is_done() || self.left == 0 {
            return Ok(false);
        }
        if let (Some(&stage), Some(taken)) =
            (self.stages.get(self.outcomes.len().wrapping_sub(1)), self.outcomes.last_mut())
        {
            let new = outcomes(&self.cases, stage, self.own.iter().skip(taken.len()).take(WAVE), u64::MAX)?;
            self.left = self.left.saturating_sub(new.iter().map(Outcome::steps).sum());
            taken.extend(new);
        }
        self.go_on()?;
        Ok(!self.is_done() && self.left > 0)
    }

    /// Whether it has examined all its cases of each stage before the last one that was begun, and at no other.
    pub fn is_in_order(&self) -> bool {
        let own = |owners: &Vec<usize>| owners.iter().filter(|&&owner| owner == self.number).count();
        let begun = self.outcomes.len();
        let mut stages = self.outcomes.iter().zip(&self.owners).zip(1..);
        stages.all(
            |((taken, owners), stage)| {
                if stage == begun { taken.len() <= own(owners) } else { taken.len() == own(owners) }
            },
        )
    }

    /// Whether nothing is left to do.
    pub fn is_done(&self) -> bool {
        self.is_at_end() && (self.has_enough() || self.outcomes.len() == self.stages.len())
    }

    /// Whether it has examined all its cases of the last stage that was begun.
    fn is_at_end(&self) -> bool {
        self.outcomes.last().is_none_or(|taken| taken.len() >= self.own.len())
    }

    /// Whether one process would examine no later stage than the last one that was begun.
    fn has_enough(&self) -> bool {
        self.outcomes
            .last()
            .is_some_and(|taken| taken.iter().any(|outcome| outcome.is_enough() || !outcome.is_whole()))
    }

    /// Begins the next stage with a case of its own.
    fn go_on(&mut self) -> Result<(), L::Error> {
        while self.is_at_end() && !self.is_done() {
            self.outcomes.push(Vec::new());
            self.own = self.own_cases()?;
        }
        Ok(())
    }

    fn own_cases(&self) -> Result<Vec<L::Case>, L::Error> {
        let begun = self.outcomes.len().wrapping_sub(1);
        let (Some(&stage), Some(owners)) = (self.stages.get(begun), self.owners.get(begun)) else {
            return Ok(Vec::new());
        };
        let all = self.cases.cases(stage)?.into_iter().zip(owners);
        Ok(all.filter(|&(_, &owner)| owner == self.number).map(|(case, _)| case).collect())
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// Stages of so many numbers each; one of the numbers is enough, and one cannot be examined to its end.
    struct Numbers {
        stages: Vec<u64>,
        enough: Option<(u64, u64)>,
        endless: Option<(u64, u64)>,
    }

    struct NumberOutcome {
        steps: u64,
        is_whole: bool,
        is_enough: bool,
    }

    impl Outcome for NumberOutcome {
        fn steps(&self) -> u64 {
            self.steps
        }

        fn is_whole(&self) -> bool {
            self.is_whole
        }

        fn is_enough(&self) -> bool {
            self.is_enough
        }
    }

    impl Cases for Numbers {
        type Stage = (u64, u64);
        type Case = (u64, u64);
        type Outcome = NumberOutcome;
        /// The cases in the order in which they were added, and the stages that were covered.
        type Findings = (Vec<(u64, u64)>, Vec<u64>);
        type Error = Infallible;

        fn stages(&self) -> Vec<(u64, u64)> {
            (0..).zip(self.stages.iter().copied()).collect()
        }

        fn cases(&self, (stage, count): (u64, u64)) -> Result<Vec<(u64, u64)>, Infallible> {
            Ok((0..count).map(|case| (stage, case)).collect())
        }

        fn weight(&self, _: (u64, u64), case: &(u64, u64)) -> u64 {
            1 + case.1 % 7
        }

        fn examine(&self, _: (u64, u64), case: &(u64, u64), _: u64) -> Result<NumberOutcome, Infallible> {
            let is = |one: Option<(u64, u64)>| one == Some(*case);
            Ok(NumberOutcome { steps: case.1 % 7, is_whole: !is(self.endless), is_enough: is(self.enough) })
        }

        fn add(
            &self,
            found: &mut Self::Findings,
            case: &(u64, u64),
            _: NumberOutcome,
        ) -> Result<(), Infallible> {
            found.0.push(*case);
            Ok(())
        }

        fn cover(&self, found: &mut Self::Findings, (stage, _): (u64, u64)) {
            found.1.push(stage);
        }
    }

    const STAGES: [u64; 5] = [1, 300, 0, 17, 400];

    fn whole(cases: &Numbers) -> (<Numbers as Cases>::Findings, bool) {
        let Ok(found) = search(cases, None, &mut |_| ControlFlow::Continue(()));
        found
    }

    /// Each shard is left after every wave and taken up again.
    fn in_shards(new: impl Fn() -> Numbers, of: usize) -> (<Numbers as Cases>::Findings, bool) {
        let all = (0..of).map(|number| {
            let mut outcomes = Vec::new();
            loop {
                let Ok(mut shard) = Shard::new(new(), (number, of), outcomes, Some(1));
                while shard.wave() == Ok(true) {}
                if shard.is_done() {
                    return shard.outcomes;
                }
                outcomes = shard.outcomes;
            }
        });
        let Ok(found) = merged(&new(), all.collect());
        found
    }

    #[test]
    fn shards_find_what_one_process_finds() {
        let settings = [
            (None, None),
            (Some((1, 70)), None),
            (Some((3, 16)), None),
            (None, Some((1, 3))),
            (None, Some((4, 399))),
            (Some((3, 2)), Some((4, 5))),
        ];
        for (enough, endless) in settings {
            let new = || Numbers { stages: STAGES.to_vec(), enough, endless };
            let once = whole(&new());
            for of in [1, 2, 3, 7, 64, 1000] {
                assert_eq!(in_shards(new, of), once, "{enough:?}, {endless:?}, {of} shards");
            }
        }
    }

    #[test]
    fn every_case_is_dealt_out_once_and_no_shard_has_much_more_than_another() {
        let cases = Numbers { stages: STAGES.to_vec(), enough: None, endless: None };
        for of in [1, 2, 5, 64] {
            let Ok(left) = dealt(&cases, of);
            assert_eq!(left.iter().sum::<u64>(), STAGES.iter().sum::<u64>());
            let mut loads = vec![0; of];
            let Ok(owners) = deal(&cases, of);
            for (stage, owners) in cases.stages().into_iter().zip(owners) {
                let Ok(all) = cases.cases(stage);
                all.iter().zip(owners).for_each(|(case, owner)| loads[owner] += cases.weight(stage, case));
            }
            let (most, least) = (loads.iter().max(), loads.iter().min());
            assert!(most.zip(least).is_some_and(|(most, least)| most - least <= 7), "{loads:?}");
        }
    }

    #[test]
    fn a_look_that_no_shard_has_leaves_the_search_without_an_end() {
        let cases = Numbers { stages: vec![10], enough: None, endless: None };
        let Ok(((seen, covered), is_whole)) = merged(&cases, vec![Vec::new(), Vec::new()]);
        assert_eq!((seen.len(), covered.len(), is_whole), (0, 0, false));
    }
}
