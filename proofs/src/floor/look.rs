//! All states of many small floors, plan by plan, until the first violation.

use rayon::prelude::*;

use crate::course::Course;
use crate::decide::{Answer, Seen, Verdict};
use crate::engine::states::{END, Found, Run, System, search};
use crate::engine::{Tally, cover};

/// What the states of small floors have shown.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Explored {
    /// A case is a state. The choices of a violation are the numbers of the series, the plan, the start, and the steps.
    pub tally: Tally,
    /// The steps with which it goes round for ever, if it does.
    pub again: Vec<u32>,
    /// The run of the violation, where there is more to see in it than choices.
    pub course: Option<Course>,
}

impl Explored {
    /// What it shows.
    pub(crate) fn answer(self, shown: Verdict) -> Answer {
        let Self { tally, again, course } = self;
        let mut answer = Answer::of_tally(tally, &[END], shown);
        if let Some(evidence) = &mut answer.counterexample {
            evidence.choices.again = again;
            evidence.seen = course.map_or(Seen::Choices, |course| Seen::Agents(Box::new(course)));
        }
        answer
    }
}

/// Plans that are looked at between two looks for a violation.
const WAVE: usize = 64;

/// Searches all states of `systems`, which are of the series with this number, from their starts, until something is
/// broken: by which system, and how. The choices of a violation are the numbers of the series, the system, the start, and
/// the steps; the tally is the same on any number of threads.
pub(crate) fn look<'a, S: System<Demand = &'static str> + Sync>(
    tally: &mut Tally,
    series: u32,
    systems: &'a [S],
    starts: impl Fn(&S) -> Vec<S::State> + Sync,
) -> Option<(&'a S, Run<&'static str>)> {
    for (wave, first) in systems.chunks(WAVE).zip((0..).step_by(WAVE)) {
        let found: Vec<Found<_>> =
            wave.par_iter().map(|system| search(system, starts(system), u32::MAX)).collect();
        let mut shown = None;
        for ((place, system), Found { states, covered, broken, .. }) in (first..).zip(wave).zip(found) {
            tally.cases += states;
            for situation in covered {
                cover(&mut tally.covered, situation);
            }
            shown = shown.or(broken.into_iter().next().map(|run| (place, system, run)));
        }
        if let Some((place, system, run)) = shown {
            let choices = [&[series, place, run.start as u32], &run.steps[..]].concat();
            tally.violation = Some((choices, run.demand));
            return Some((system, run));
        }
    }
    None
}
