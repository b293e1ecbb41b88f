//! How checks are decided on all cores: what is a job of its own, and what becomes of the jobs. Rows do not depend on how
//! many cores there are.

use std::cmp::Reverse;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use rayon::prelude::*;

use super::{Row, checks};
use crate::clause::{Clause, Decision};
use crate::decide::{Answer, Desk, Memory, Refused, Verdict};
use crate::engine::Until;
use crate::engine::states::Room;
use crate::engine::tree::Progress;

/// What is heard while checks are decided.
#[derive(Clone, Copy, Debug)]
pub enum Heard<'a> {
    /// How far a search is.
    Search(&'a Progress<'a>),
    /// Another job is done: a check, or a mutant.
    Done {
        /// The clause that it is about.
        clause: &'static str,
        /// How many are done.
        jobs: usize,
        /// How many there are.
        of: usize,
    },
}

/// Hears how far the deciding is, from any thread, and may end a search: its check is left open then.
pub type Hear<'a> = &'a (dyn Fn(Heard<'_>) -> ControlFlow<()> + Sync);

/// Decides all checks of `clauses`, on all cores.
///
/// # Errors
/// [`Refused`] if a method cannot begin.
pub fn decide_all(clauses: &[&'static Clause]) -> Result<Vec<Row>, Refused> {
    decide(&checks(clauses), Room::any(), &|_| ControlFlow::Continue(()))
}

/// Decides `checks`, on all cores; the rows are in their order. Checks that share what is found are decided by one thread,
/// which forgets it after the last of them. Searches over states together take the memory of `room`.
///
/// # Errors
/// [`Refused`] if a method cannot begin.
pub fn decide(checks: &[(&'static Clause, usize)], room: &Room, hear: Hear<'_>) -> Result<Vec<Row>, Refused> {
    let jobs = jobs(checks);
    let (of, ended) = (jobs.len(), AtomicUsize::new(0));
    let work = |job: &Job| {
        let memory = &mut Memory::default();
        let watch = &mut |progress: &Progress<'_>| hear(Heard::Search(progress));
        let done = job.work(checks, &mut Desk { memory, watch, room });
        let jobs = ended.fetch_add(1, Ordering::Relaxed) + 1;
        // Nothing can be ended here.
        let _ = hear(Heard::Done { clause: checks[job.place()].0.id, jobs, of });
        done
    };
    let done: Vec<Vec<Done>> = jobs.par_iter().with_max_len(1).map(work).collect::<Result<_, _>>()?;
    let mut done: Vec<Done> = done.into_iter().flatten().collect();
    done.sort_by_key(|done| done.question);
    let mut rows: Vec<Row> = Vec::new();
    for Done { question: Question { place, .. }, seconds, came } in done {
        let (clause, number) = checks[place];
        match (came, rows.last_mut()) {
            (Came::Own(answer), _) => {
                let check = clause.checks[number];
                rows.push(Row { clause, number, check, decision: Decision::of(answer), seconds });
            }
            (Came::Mutant(name, verdict), Some(row)) => {
                row.decision.add(name, verdict);
                row.seconds += seconds;
            }
            // A check comes before its mutants.
            (Came::Mutant(..), None) => {}
        }
    }
    Ok(rows)
}

/// Work that can be done beside other work: questions that share what is found, one after the other.
struct Job {
    questions: Vec<Question>,
    until: Until,
}

/// What is decided: a check, by its place, or one of its mutants, by its number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Question {
    place: usize,
    mutant: Option<usize>,
}

/// A question that is answered.
struct Done {
    question: Question,
    seconds: f64,
    came: Came,
}

/// What came of it.
enum Came {
    Own(Answer),
    Mutant(&'static str, Verdict),
}

/// The checks, those with most others in their family first, as these may take longest, each family with the mutants about
/// which it tells as much; then the other mutants.
fn jobs(checks: &[(&'static Clause, usize)]) -> Vec<Job> {
    let of = |place: usize| {
        let (clause, number) = checks[place];
        clause.checks[number]
    };
    let mut families: Vec<(Option<String>, Vec<Question>)> = Vec::new();
    for place in 0..checks.len() {
        let (family, question) = (of(place).family(), Question { place, mutant: None });
        match joined(&mut families, family.as_deref()) {
            Some(questions) => questions.push(question),
            None => families.push((family, vec![question])),
        }
    }
    families.sort_by_key(|(_, questions)| Reverse(questions.len()));
    let mut others = Vec::new();
    for place in 0..checks.len() {
        for number in 0..of(place).mutants().len() {
            let (family, question) =
                (of(place).mutant_family(number), Question { place, mutant: Some(number) });
            match joined(&mut families, family.as_deref()) {
                Some(questions) => questions.push(question),
                None => others.push(Job { questions: vec![question], until: Until::Violation }),
            }
        }
    }
    let families = families.into_iter().map(|(_, questions)| Job { questions, until: Until::Exhausted });
    families.chain(others).collect()
}

/// The questions of the same family, if there are any.
fn joined<'a>(
    families: &'a mut [(Option<String>, Vec<Question>)],
    family: Option<&str>,
) -> Option<&'a mut Vec<Question>> {
    let known = families.iter_mut().find(|(known, _)| family.is_some() && known.as_deref() == family);
    known.map(|(_, questions)| questions)
}

impl Job {
    /// The place of its first check.
    fn place(&self) -> usize {
        self.questions.first().map_or(0, |question| question.place)
    }

    fn work(
        &self,
        checks: &[(&'static Clause, usize)],
        desk: &mut Desk<'_, '_>,
    ) -> Result<Vec<Done>, Refused> {
        let answered = |&question: &Question| {
            let start = Instant::now();
            let (clause, number) = checks[question.place];
            let check = clause.checks[number];
            let came = match question.mutant {
                None => Came::Own(check.decide_own(desk)?),
                Some(number) => {
                    let name = check.mutants().get(number).copied().unwrap_or_default();
                    Came::Mutant(name, check.decide_mutant(number, self.until, desk)?)
                }
            };
            Ok(Done { question, seconds: start.elapsed().as_secs_f64(), came })
        };
        self.questions.iter().map(answered).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::iter;

    use super::super::clauses;
    use super::*;

    #[test]
    fn every_question_is_asked_once_and_that_of_a_mutant_with_its_family() {
        let checks = checks(&clauses().collect::<Vec<_>>());
        let jobs = jobs(&checks);
        let mut asked: Vec<Question> = jobs.iter().flat_map(|job| job.questions.iter().copied()).collect();
        asked.sort_unstable();
        let all = (0..).zip(&checks).flat_map(|(place, (clause, number))| {
            let mutants = 0..clause.checks[*number].mutants().len();
            iter::once(None).chain(mutants.map(Some)).map(move |mutant| Question { place, mutant })
        });
        assert!(asked.into_iter().eq(all));
        let of = |place: usize| (checks[place].0.id, checks[place].0.checks[checks[place].1]);
        let is_published = |question: &Question| {
            let (clause, check) = of(question.place);
            let is_named = |number: usize| check.mutants()[number] == "as published";
            (clause, check.engine()) == ("CHAIN-2", "search") && question.mutant.is_some_and(is_named)
        };
        let job = jobs.iter().find(|job| job.questions.iter().any(is_published)).expect("a mutant");
        let (clause, check) = of(job.place());
        assert_eq!((clause, check.rule(), job.until), ("CHAIN-1", "published", Until::Exhausted));
    }
}
