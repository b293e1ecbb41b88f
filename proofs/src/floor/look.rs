//! All states of many small floors, plan by plan, until the first violation.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::decide::{Answer, Depiction, Verdict};
use crate::engine::states::{END, Findings, Limits, Run, System, search};
use crate::engine::watchdog::Task;
use crate::engine::{Tally, Until, cover};
use crate::floor_trace::Course;

/// What the states of small floors have shown.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Explored {
    /// A case is a state. The choices of a violation are the numbers of the series, the plan, the start, and the steps.
    pub tally: Tally,
    /// Whether no search was cut off.
    pub is_whole: bool,
    /// The steps with which it goes round for ever, if it does.
    pub again: Vec<u32>,
    /// The run of the violation, where there is more to see in it than choices.
    pub course: Option<Course>,
}

impl Explored {
    /// Nothing yet.
    pub(crate) fn new() -> Self {
        Self { tally: Tally::default(), is_whole: true, again: Vec::new(), course: None }
    }

    /// What it shows.
    pub(crate) fn answer(self, shown: Verdict) -> Answer {
        let Self { tally, is_whole, again, course } = self;
        let mut answer = Answer::of_tally(tally, &[END], if is_whole { shown } else { Verdict::Open });
        if let Some(evidence) = &mut answer.counterexample {
            evidence.choices.again = again;
            evidence.seen = course.map_or(Depiction::Choices, |course| Depiction::Agents(Box::new(course)));
        }
        answer
    }

    /// Searches the states of `systems`, which are of the series with this number, from their starts within `limits`
    /// each, until something is broken: by which system, and how. The tally is the same on any number of threads.
    pub(crate) fn look<'a, S: System<Demand = &'static str> + Sync>(
        &mut self,
        series: u32,
        systems: &'a [S],
        starts: impl Fn(&S) -> Vec<S::State> + Sync,
        (limits, until): (Limits<'_>, Until),
    ) -> Option<(&'a S, Run<&'static str>)> {
        let mut first = None;
        for ((place, system), found) in (0..).zip(systems).zip(search_each(systems, starts, (limits, until)))
        {
            let Findings { states, covered, broken, is_whole, .. } = found;
            self.tally.cases += states;
            self.is_whole &= is_whole;
            for situation in covered {
                cover(&mut self.tally.covered, situation);
            }
            first = first.or(broken.into_iter().next().map(|run| (place, system, run)));
        }
        let (place, system, run) = first?;
        let choices = [&[series, place, run.start as u32], &run.steps[..]].concat();
        self.tally.violation = Some((choices, run.demand));
        Some((system, run))
    }
}

/// Systems that are looked at between two looks for a violation.
const WAVE: usize = 64;

/// What is found in each of `systems`, up to the first in which something is broken, or for a whole tally up to the end
/// of its wave.
fn search_each<S: System<Demand = &'static str> + Sync>(
    systems: &[S],
    starts: impl Fn(&S) -> Vec<S::State> + Sync,
    (limits, until): (Limits<'_>, Until),
) -> Vec<Findings<&'static str>> {
    let last = AtomicUsize::new(usize::MAX);
    let task = Task::current();
    let each = systems.par_iter().enumerate().with_max_len(1).map(|(place, system)| {
        let _working = task.enter();
        if last.load(Ordering::Relaxed) < place {
            return None;
        }
        let found = search(system, starts(system), limits);
        if !found.broken.is_empty() {
            let end = match until {
                Until::Exhausted => place - place % WAVE + WAVE - 1,
                Until::Violation => place,
            };
            last.fetch_min(end, Ordering::Relaxed);
        }
        Some(found)
    });
    let mut found: Vec<Option<Findings<_>>> = each.collect();
    found.truncate(last.into_inner().saturating_add(1));
    found.into_iter().flatten().collect()
}
