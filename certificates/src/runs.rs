//! The checker of a section about runs that never merge, since what was found out tells them apart for ever. It makes
//! every run by itself, depth first, and holds what it counts against what the section says.

use std::ops::ControlFlow;

use rayon::prelude::*;
use tautline_kernel::choice::Oracle;

use crate::file::take;
use crate::model::{Answers, QuestionCounts};
use crate::verdict::{Counts, Refusal};

/// The step function of a system whose runs are told apart, and what is demanded of it.
pub trait Runs: Sync {
    /// All that is at a time.
    type State: Clone + Send;
    /// The intention of a step, before anything is asked.
    type Plan: Send;

    /// The state in which runs begin.
    fn start(&self) -> Self::State;

    /// Mishaps in a run, at most.
    fn most_mishaps(&self) -> u32;

    /// Steps to which a run comes that is too long.
    fn longest_run(&self) -> u32;

    /// The plan of the next step from a state, which may be noted in it; `None` if the run is over. `log` is what
    /// earlier steps have written.
    fn plan(&self, state: &mut Self::State, log: &[u8]) -> Option<Self::Plan>;

    /// Makes of `state`, which is as it was planned, the one to which these answers lead, and writes to the end of
    /// `log`. Returns the demand that the step breaks, in words.
    fn step(
        &self,
        ready: &Ready<Self::State, Self::Plan>,
        state: &mut Self::State,
        log: &mut Vec<u8>,
        answers: &mut impl Oracle,
    ) -> Option<String>;

    /// The demand that a run breaks by ending in `state`, in words.
    fn broken_at_end(&self, state: &Self::State, log: &[u8]) -> Option<String>;

    /// Whether a run goes on for ever, and the demand that it breaks by that: it was in the state `then` when the log
    /// had `sent` bytes, and is in `now`; in between every answer was that there is no mishap.
    fn recurs(
        &self,
        then: &Self::State,
        sent: usize,
        now: &Self::State,
        log: &[u8],
    ) -> ControlFlow<Option<String>>;
}

/// A step that is planned.
pub struct Ready<S, P> {
    /// The state in which it was planned.
    pub before: S,
    /// The state once it was planned.
    pub planned: S,
    /// The plan.
    pub plan: P,
}

/// Checks that a section says of every number of mishaps how many runs `model` has, and of how many steps, and that no
/// run breaks anything.
///
/// # Errors
/// [`Refusal`], which does not depend on the number of threads.
pub fn check_runs<M: Runs>(model: &M, section: &[u8]) -> Result<Counts, Refusal> {
    let (mut rest, mut said) = (section, Vec::new());
    while !rest.is_empty() {
        said.push(take(&mut rest).ok_or(Refusal::Malformed(section.len() - rest.len()))?);
    }
    let mut parts = Vec::new();
    let mut counted = Walk::new(model).go(Some(&mut parts))?;
    let walked = parts.into_par_iter().with_max_len(1).map(|part| part.go(None));
    for part in walked.collect::<Vec<_>>() {
        counted.add(&part?);
    }
    let Tally { longest, of } = counted;
    let mut said = said.into_iter();
    if said.next() != Some(longest.into()) {
        return Err(Refusal::Longest(longest));
    }
    for (mishaps, &[runs, steps]) in of.iter().enumerate() {
        if [said.next(), said.next()] != [Some(runs), Some(steps)] {
            return Err(Refusal::Runs(mishaps, runs, steps));
        }
    }
    if said.next().is_some() {
        return Err(Refusal::Malformed(section.len()));
    }
    let [ends, steps] = of.iter().fold([0, 0], |all, one| [all[0] + one[0], all[1] + one[1]]);
    Ok(Counts { states: steps + 1, steps, ends })
}

/// Ways in which the answers of a run could have come out at which it is a part of its own.
const PART: u64 = 1 << 10;

/// Steps without an event from which on a run is watched, which may come back to where it was.
const WATCHED: u32 = 32;

/// Counts of the runs that were made.
struct Tally {
    /// Steps of the longest run.
    longest: u32,
    /// For each number of mishaps the runs, and the steps that come after so many.
    of: Vec<[u64; 2]>,
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.longest = self.longest.max(other.longest);
        for (one, other) in self.of.iter_mut().flatten().zip(other.of.iter().flatten()) {
            *one += other;
        }
    }
}

/// A step that is planned, and how the run stood before it.
struct Fork<S, P> {
    ready: Ready<S, P>,
    steps: u32,
    sent: usize,
    asked: QuestionCounts,
}

/// All runs that begin with certain answers.
struct Walk<'a, M: Runs> {
    model: &'a M,
    state: M::State,
    log: Vec<u8>,
    steps: u32,
    answers: Answers,
    /// The steps since its runs begin that can come out otherwise: an earlier one has no fork here to go back to.
    forks: Vec<Fork<M::State, M::Plan>>,
    /// Steps since the last answer that says more than that there is no mishap, and at how many of them the mark is set
    /// next: at powers of two, as Brent's search for cycles does.
    moved: (u32, u32),
    /// A state since that answer, with the bytes of the log before it.
    mark: Option<(M::State, usize)>,
    tally: Tally,
}

impl<'a, M: Runs> Walk<'a, M> {
    fn new(model: &'a M) -> Self {
        let most_mishaps = model.most_mishaps();
        Self {
            model,
            state: model.start(),
            log: Vec::new(),
            steps: 0,
            answers: Answers::with_mishaps(most_mishaps),
            forks: Vec::new(),
            moved: (0, WATCHED),
            mark: None,
            tally: Tally { longest: 0, of: vec![[0; 2]; most_mishaps as usize + 1] },
        }
    }

    /// All runs that begin with the answers that were given so far.
    fn part(&self) -> Self {
        Self {
            state: self.state.clone(),
            log: self.log.clone(),
            steps: self.steps,
            answers: self.answers.clone(),
            moved: self.moved,
            mark: self.mark.clone(),
            ..Self::new(self.model)
        }
    }

    /// Makes its runs; those of parts of their own go to `parts`, if there are to be any.
    fn go(mut self, mut parts: Option<&mut Vec<Self>>) -> Result<Tally, Refusal> {
        let mut goes_on = self.plan()?;
        while goes_on || self.back() {
            goes_on = self.step()?;
            if let Some(parts) = &mut parts
                && goes_on
                && self.answers.ways() >= PART
            {
                parts.push(self.part());
                goes_on = false;
            }
            goes_on = goes_on && self.plan()?;
        }
        Ok(self.tally)
    }

    /// Plans the next step; false if the run is over.
    fn plan(&mut self) -> Result<bool, Refusal> {
        let before = self.state.clone();
        let Some(plan) = self.model.plan(&mut self.state, &self.log) else {
            self.judge(self.model.broken_at_end(&self.state, &self.log))?;
            self.end();
            return Ok(false);
        };
        let ready = Ready { before, planned: self.state.clone(), plan };
        let (steps, sent, asked) = (self.steps, self.log.len(), self.answers.asked);
        self.forks.push(Fork { ready, steps, sent, asked });
        Ok(true)
    }

    /// Makes the step of the last fork, which stays if it asks for answers; false if the run is over by it.
    fn step(&mut self) -> Result<bool, Refusal> {
        let Some(Fork { ready, asked, .. }) = self.forks.last() else { return Ok(false) };
        let broken = self.model.step(ready, &mut self.state, &mut self.log, &mut self.answers);
        let QuestionCounts { answers, mishaps, events } = self.answers.asked;
        let (is_asked, is_event) = (answers > asked.answers, events > asked.events);
        self.steps += 1;
        self.tally.of[mishaps as usize][1] += 1;
        self.judge(broken)?;
        if !is_asked {
            self.forks.pop();
        }
        if is_event {
            (self.moved, self.mark) = ((0, WATCHED), None);
        } else {
            self.moved.0 += 1;
        }
        let (moved, due) = self.moved;
        if moved == due {
            self.mark = Some((self.state.clone(), self.log.len()));
            self.moved.1 = 2 * due;
        } else if let Some((then, sent)) = &self.mark
            && let ControlFlow::Break(broken) = self.model.recurs(then, *sent, &self.state, &self.log)
        {
            self.judge(broken)?;
            self.end();
            return Ok(false);
        }
        if self.steps >= self.model.longest_run() {
            return Err(Refusal::Long(self.answers.values()));
        }
        Ok(true)
    }

    fn judge(&self, broken: Option<String>) -> Result<(), Refusal> {
        broken.map_or(Ok(()), |demand| Err(Refusal::Broken(self.answers.values(), demand)))
    }

    /// Counts a run that is over.
    fn end(&mut self) {
        self.tally.longest = self.tally.longest.max(self.steps);
        self.tally.of[self.answers.asked.mishaps as usize][0] += 1;
    }

    /// Goes back to the last fork that can come out otherwise, as it was planned; false if there is none.
    fn back(&mut self) -> bool {
        let Some(changed) = self.answers.advance() else { return false };
        while self.forks.pop_if(|fork| fork.asked.answers > changed).is_some() {}
        let Some(Fork { ready, steps, sent, asked }) = self.forks.last() else { return false };
        self.state = ready.planned.clone();
        self.log.truncate(*sent);
        (self.steps, self.answers.asked) = (*steps, *asked);
        true
    }
}
