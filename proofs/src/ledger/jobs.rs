//! How checks are decided on all cores: what is a job of its own, and what becomes of the jobs. Rows do not depend on how
//! many cores there are.

use std::cmp::Reverse;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use rayon::prelude::*;

use super::{Row, checks};
use crate::clause::{AnyCheck, Clause, Decision};
use crate::decide::{Answer, Desk, Memory, Refused, Verdict};
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
    let mut rows: Vec<Option<Row>> = checks.iter().map(|_| None).collect();
    for Done { place, seconds, came } in done.into_iter().flatten() {
        let (clause, number) = checks[place];
        match (came, &mut rows[place]) {
            (Came::Own(answer), row) => {
                let check = clause.checks[number];
                *row = Some(Row { clause, number, check, decision: Decision::of(answer), seconds });
            }
            (Came::Mutant(name, verdict), Some(row)) => {
                row.decision.add(name, verdict);
                row.seconds += seconds;
            }
            // A check is decided before its mutants.
            (Came::Mutant(..), None) => {}
        }
    }
    Ok(rows.into_iter().flatten().collect())
}

/// Work that can be done beside other work. Checks go by their places.
enum Job {
    /// Checks that share what is found.
    Family(Vec<usize>),
    /// A mutant of a check, by its number and name.
    Mutant(usize, usize, &'static str),
}

/// A part of a job that is done.
struct Done {
    place: usize,
    seconds: f64,
    came: Came,
}

/// What came of it.
enum Came {
    Own(Answer),
    Mutant(&'static str, Verdict),
}

/// The checks, those with most others in their family first, as these may take longest; then the mutants.
fn jobs(checks: &[(&'static Clause, usize)]) -> Vec<Job> {
    let mut families: Vec<(Option<String>, Vec<usize>)> = Vec::new();
    let mut mutants = Vec::new();
    for (place, &(clause, number)) in checks.iter().enumerate() {
        let check = clause.checks[number];
        let family = check.family();
        match families.iter_mut().find(|(known, _)| family.is_some() && *known == family) {
            Some((_, places)) => places.push(place),
            None => families.push((family, vec![place])),
        }
        mutants.extend((0..).zip(check.mutants()).map(|(number, name)| Job::Mutant(place, number, name)));
    }
    families.sort_by_key(|(_, places)| Reverse(places.len()));
    families.into_iter().map(|(_, places)| Job::Family(places)).chain(mutants).collect()
}

impl Job {
    /// The place of its first check.
    fn place(&self) -> usize {
        match self {
            Self::Family(places) => places.first().copied().unwrap_or_default(),
            &Self::Mutant(place, ..) => place,
        }
    }

    fn work(
        &self,
        checks: &[(&'static Clause, usize)],
        desk: &mut Desk<'_, '_>,
    ) -> Result<Vec<Done>, Refused> {
        let mut timed =
            |place: usize, work: &dyn Fn(&dyn AnyCheck, &mut Desk<'_, '_>) -> Result<Came, Refused>| {
                let (clause, number) = checks[place];
                let start = Instant::now();
                let came = work(clause.checks[number], desk)?;
                Ok(Done { place, seconds: start.elapsed().as_secs_f64(), came })
            };
        match self {
            Self::Family(places) => {
                let own = |&place| timed(place, &|check, desk| Ok(Came::Own(check.decide_own(desk)?)));
                places.iter().map(own).collect()
            }
            &Self::Mutant(place, number, name) => {
                let mutant =
                    timed(place, &|check, desk| Ok(Came::Mutant(name, check.decide_mutant(number, desk)?)));
                Ok(vec![mutant?])
            }
        }
    }
}
