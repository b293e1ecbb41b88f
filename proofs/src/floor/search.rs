//! All states of many small floors, plan by plan, until the first violation.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::team::{Demands, Team};
use crate::decide::{Answer, Depiction, Verdict};
use crate::engine::states::{END, Findings, Limits, search};
use crate::engine::{Tally, Until, cover, threads};
use crate::floor_trace::Course;

/// The outcome of searches of small floors.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Report {
    /// A case is a state. The choices of a violation are the numbers of the series, the plan, the start, and the steps.
    pub(crate) tally: Tally,
    /// Whether no search was cut off.
    is_whole: bool,
    /// The steps with which the violation goes round for ever, if it does.
    again: Vec<u32>,
    /// The run of the violation.
    course: Option<Course>,
}

impl Report {
    /// Nothing yet.
    pub(crate) fn new() -> Self {
        Self { tally: Tally::default(), is_whole: true, again: Vec::new(), course: None }
    }

    /// The answer to a check that is to show `shown`.
    pub(crate) fn answer(self, shown: Verdict) -> Answer {
        let Self { tally, is_whole, again, course } = self;
        let mut answer = Answer::of_tally(tally, &[END], if is_whole { shown } else { Verdict::Open });
        if let Some(evidence) = &mut answer.counterexample {
            evidence.choices.again = again;
            evidence.seen = course.map_or(Depiction::Choices, |course| Depiction::Agents(Box::new(course)));
        }
        answer
    }

    /// Searches the states of `teams`, which are of the series with this number, within `limits` each, until something
    /// is broken; returns whether it is. The tally is the same on any number of threads.
    pub(crate) fn add<S: Demands>(
        &mut self,
        series: u32,
        teams: &[Team<S>],
        (limits, until): (Limits<'_>, Until),
    ) -> bool {
        let mut first = None;
        for ((place, team), found) in (0..).zip(teams).zip(search_each(teams, (limits, until))) {
            let Findings { states, covered, broken, is_whole, .. } = found;
            self.tally.cases += states;
            self.is_whole &= is_whole;
            for situation in covered {
                cover(&mut self.tally.covered, situation);
            }
            first = first.or(broken.into_iter().next().map(|run| (place, team, run)));
        }
        let Some((place, team, run)) = first else { return false };
        let choices = [&[series, place, run.start as u32], &run.steps[..]].concat();
        self.tally.violation = Some((choices, run.demand));
        self.again = run.round().to_vec();
        self.course = team.starts().nth(run.start).map(|start| team.course(start, &run));
        true
    }
}

/// Teams that are looked at between two looks for a violation.
const WAVE: usize = 64;

/// Searches each of `teams`, up to the first of which something is broken, or for a whole tally up to the end of its
/// wave.
fn search_each<S: Demands>(
    teams: &[Team<S>],
    (limits, until): (Limits<'_>, Until),
) -> Vec<Findings<&'static str>> {
    let last = AtomicUsize::new(usize::MAX);
    let mut found = threads::each(teams.iter().enumerate(), |(place, team)| {
        if last.load(Ordering::Relaxed) < place {
            return None;
        }
        let found = search(team, team.starts(), limits);
        if !found.broken.is_empty() {
            let end = match until {
                Until::Exhausted => place - place % WAVE + WAVE - 1,
                Until::Violation => place,
            };
            last.fetch_min(end, Ordering::Relaxed);
        }
        Some(found)
    });
    found.truncate(last.into_inner().saturating_add(1));
    found.into_iter().flatten().collect()
}
