//! How checks are decided on all cores: what is a job of its own, and what becomes of the jobs. Rows do not depend on
//! how many cores there are. Whoever wants the rows waits for them on a thread of their own, and looks once a second
//! whether a step of a job still goes on: a job that does not come back from a step is left behind, with its thread.

use std::any::Any;
use std::cmp::Reverse;
use std::fmt::Display;
use std::ops::ControlFlow;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use rayon::Yield;

use super::{Indecision, Row, checks};
use crate::clause::{Clause, Decision, Variant};
use crate::decide::{Answer, Cache, Context, MethodError, MethodResult, RandomRuns};
use crate::engine::Until;
use crate::engine::states::MemoryLimit;
use crate::engine::tree::Progress;
use crate::engine::watchdog::{BETWEEN_LOOKS, Task, Watchdog};

/// News while checks are decided.
#[derive(Clone, Copy, Debug)]
pub enum News<'a> {
    /// How far a search is.
    Search(&'a Progress<'a>),
    /// Another job is done: a check, or a variant.
    Done {
        /// The clause that it is about.
        clause: &'static str,
        /// How many are done.
        jobs: usize,
        /// How many there are.
        of: usize,
    },
    /// Another second has gone by. Whoever answers that with a break wants the rows that there are, and no others.
    Second,
    /// A step of a job has not ended for too long. Other jobs go on where a thread is left.
    Unended {
        /// The clause that the job is about.
        clause: &'static str,
    },
}

/// Hears how far the deciding is, from any thread, and may end a search, whose check is left open then, or all.
pub type Hear = Arc<dyn Fn(News<'_>) -> ControlFlow<()> + Send + Sync>;

/// The limits of deciding.
#[derive(Clone, Debug)]
pub struct Limits {
    /// The memory that searches over states may take together.
    pub memory: Arc<MemoryLimit>,
    /// Seconds that one step may take: a team move, a case of a body, a step between states. They are far more than any
    /// step takes that ends, on any machine.
    pub patience_s: u32,
}

/// Seconds that one step may take, unless somebody wants otherwise.
pub const PATIENCE_S: u32 = 60;

/// Bytes that searches over states may take together, unless somebody wants otherwise.
pub const MEMORY_BYTES: u64 = 2 << 30;

impl Default for Limits {
    fn default() -> Self {
        let memory = MemoryLimit::of(MEMORY_BYTES, rayon::current_num_threads() as u64);
        Self { memory: Arc::new(memory), patience_s: PATIENCE_S }
    }
}

/// Decides all checks of `clauses`, on all cores, within [`Limits::default`]. A search over states that does not fit
/// into that is cut short, and its check is open, with a note.
///
/// # Errors
/// [`MethodError`] if a method cannot begin.
pub fn decide_all(clauses: &[&'static Clause]) -> Result<Vec<Row>, MethodError> {
    decide(&checks(clauses), &Limits::default(), &(Arc::new(|_: News<'_>| ControlFlow::Continue(())) as Hear))
}

/// Makes random runs for each of `checks` in place of deciding it, on all cores, as [`decide`] does: a step that does
/// not end, and a signal, are heard alike. Of variants none are made. A check without random runs is open.
///
/// # Errors
/// [`MethodError`] if a method cannot begin.
pub fn hunt(
    checks: &[(&'static Clause, usize)],
    runs: &RandomRuns,
    limits: &Limits,
    hear: &Hear,
) -> Result<Vec<Row>, MethodError> {
    let question = |place| Question { place, variant: None };
    let job = |place| Job { questions: vec![question(place)], how: How::Drawn(*runs) };
    done((0..checks.len()).map(job).collect(), checks, limits, hear)
}

/// Decides `checks`, on all cores; the rows are in their order. Checks that share what is found are decided by one
/// thread, which forgets it after the last of them. Where a step does not end, its check is left open; others are
/// decided as long as a thread is left for them, and open if none is. A thread that makes such a step is left behind:
/// it ends with the process. So are all of them, where `hear` ends the work.
///
/// # Errors
/// [`MethodError`] if a method cannot begin.
pub fn decide(
    checks: &[(&'static Clause, usize)],
    limits: &Limits,
    hear: &Hear,
) -> Result<Vec<Row>, MethodError> {
    done(jobs(checks), checks, limits, hear)
}

/// The rows that `jobs` make of `checks`.
fn done(
    jobs: Vec<Job>,
    checks: &[(&'static Clause, usize)],
    limits: &Limits,
    hear: &Hear,
) -> Result<Vec<Row>, MethodError> {
    let (jobs, (tell, told)) = (Arc::new(jobs), channel());
    let tasks: Vec<Task> = Task::several(jobs.len()).collect();
    let shared = Arc::new(SharedState {
        checks: checks.to_vec(),
        limits: limits.clone(),
        hear: Arc::clone(hear),
        ended: AtomicUsize::new(0),
        is_over: AtomicBool::new(false),
    });
    for (number, &task) in tasks.iter().enumerate() {
        let (shared, jobs, tell) = (Arc::clone(&shared), Arc::clone(&jobs), tell.clone());
        rayon::spawn_fifo(move || shared.work(&jobs, (number, task), &tell));
    }
    let waiting = Collector { jobs: &jobs, tasks: &tasks, shared: &shared };
    let came = waiting.wait(&told);
    shared.is_over.store(true, Ordering::Relaxed);
    // As long as this one could tell something, nobody is without news.
    drop(tell);
    Ok(waiting.rows(came?))
}

/// The data that the deciding threads share.
struct SharedState {
    checks: Vec<(&'static Clause, usize)>,
    limits: Limits,
    hear: Hear,
    /// Jobs that are done.
    ended: AtomicUsize,
    /// Whether nobody waits any more.
    is_over: AtomicBool,
}

/// A thread's news for whoever waits.
enum ThreadNews {
    Done(Box<Completion>),
    Refused(MethodError),
    /// A bug, which is the waiting thread's to raise.
    Bug(Box<dyn Any + Send>),
    /// A job has ended.
    End,
}

impl ThreadNews {
    fn answer(self) -> Option<Completion> {
        match self {
            Self::Done(answer) => Some(*answer),
            Self::Refused(_) | Self::Bug(_) | Self::End => None,
        }
    }
}

impl SharedState {
    /// Does a job, and tells of each question when it is answered.
    fn work(&self, jobs: &[Job], (number, task): (usize, Task), tell: &Sender<ThreadNews>) {
        if self.is_over.load(Ordering::Relaxed) {
            return;
        }
        let _working = task.enter();
        // Who has gone wants to hear nothing.
        let send = |told| drop(tell.send(told));
        let work = || {
            let job = &jobs[number];
            let cache = &mut Cache::default();
            let watch = &mut |progress: &Progress<'_>| (self.hear)(News::Search(progress));
            for &question in &job.questions {
                let words = question.words(&self.checks);
                let mut context = Context { cache, watch, memory: self.limits.memory.asked(&words) };
                let answer = || job.answer(question, &self.checks, &mut context);
                let answer = panic::catch_unwind(AssertUnwindSafe(answer));
                let answer = match answer {
                    Ok(answer) => {
                        answer.map_err(|why| question.failed(&self.checks, "cannot be decided", &why))
                    }
                    Err(bug) => Err(question.failed(&self.checks, "panics", &words_of(&*bug))),
                };
                match answer {
                    Ok(answer) => {
                        let (variant, seconds) = (question.variant(&self.checks), task.spent().as_secs_f64());
                        let done = Completion { question, variant, seconds, answer, undecided: None };
                        send(ThreadNews::Done(Box::new(done)));
                    }
                    Err(refused) => return send(ThreadNews::Refused(refused)),
                }
            }
            let ended = self.ended.fetch_add(1, Ordering::Relaxed) + 1;
            let clause = self.checks[job.place()].0.id;
            // Nothing can be ended here.
            let _ = (self.hear)(News::Done { clause, jobs: ended, of: jobs.len() });
            send(ThreadNews::End);
        };
        if let Err(bug) = panic::catch_unwind(AssertUnwindSafe(work)) {
            send(ThreadNews::Bug(bug));
        }
    }
}

/// The answers that there are.
struct Collection {
    done: Vec<Completion>,
    /// The numbers of the jobs that have a step which did not end.
    unended: Vec<usize>,
    /// Why nothing came of the other questions.
    rest: Indecision,
}

/// Whoever waits for the answers.
struct Collector<'a> {
    jobs: &'a [Job],
    tasks: &'a [Task],
    shared: &'a SharedState,
}

impl Collector<'_> {
    /// All answers; or those that there are when a step does not end and no other job goes on, or when the work is
    /// ended.
    fn wait(&self, told: &Receiver<ThreadNews>) -> Result<Collection, MethodError> {
        let (patience_s, mut watchdog) = (self.shared.limits.patience_s, Watchdog::new(self.tasks));
        let (mut done, mut unended, mut left) = (Vec::new(), Vec::new(), self.jobs.len());
        let mut next_look = Instant::now() + BETWEEN_LOOKS;
        while left > 0 {
            match next(told, next_look) {
                Some(ThreadNews::Done(answer)) => done.push(*answer),
                Some(ThreadNews::Refused(refused)) => return Err(refused),
                Some(ThreadNews::Bug(bug)) => panic::resume_unwind(bug),
                Some(ThreadNews::End) => left -= 1,
                None => {}
            }
            if Instant::now() < next_look {
                continue;
            }
            if (self.shared.hear)(News::Second).is_break() {
                // Whatever was answered before is told.
                done.extend(told.try_iter().filter_map(ThreadNews::answer));
                return Ok(Collection { done, unended, rest: Indecision::Ended });
            }
            watchdog.look();
            next_look = Instant::now() + BETWEEN_LOOKS;
            let number = |task: Task| self.tasks.iter().position(|one| *one == task);
            let silent: Vec<usize> = watchdog.silent(patience_s).filter_map(number).collect();
            for number in silent.iter().filter(|number| !unended.contains(*number)) {
                let clause = self.shared.checks[self.jobs[*number].place()].0.id;
                // Nothing can be ended here.
                let _ = (self.shared.hear)(News::Unended { clause });
            }
            unended = silent;
            if !unended.is_empty() && watchdog.is_all_silent(patience_s) {
                break;
            }
        }
        Ok(Collection { done, unended, rest: Indecision::Behind })
    }

    /// The stand-ins for the questions without an answer.
    fn missing(&self, Collection { done, unended, rest }: &Collection) -> Vec<Completion> {
        let mut missing = Vec::new();
        for (number, job) in self.jobs.iter().enumerate() {
            let is_answered = |question: &Question| done.iter().any(|done| done.question == *question);
            // The thread of a job is at the first question without an answer.
            let mut is_unended = unended.contains(&number);
            for &question in job.questions.iter().filter(|question| !is_answered(question)) {
                let variant = question.variant(&self.shared.checks);
                let undecided = if is_unended {
                    Indecision::Unended { variant, seconds: self.shared.limits.patience_s }
                } else {
                    *rest
                };
                is_unended = false;
                let (answer, undecided) = (Answer::open(), Some(undecided));
                missing.push(Completion { question, variant, seconds: 0.0, answer, undecided });
            }
        }
        missing
    }

    /// The row of each check.
    fn rows(&self, collection: Collection) -> Vec<Row> {
        let missing = self.missing(&collection);
        let mut done = collection.done;
        done.extend(missing);
        done.sort_by_key(|done| done.question);
        let mut rows: Vec<Row> = Vec::new();
        for Completion { question: Question { place, .. }, variant, seconds, answer, undecided } in done {
            let (clause, number) = self.shared.checks[place];
            match (variant, rows.last_mut()) {
                (None, _) => {
                    let (check, decision) = (clause.checks[number], Decision::of(answer));
                    rows.push(Row { clause, number, check, decision, undecided, seconds });
                }
                (Some(variant), Some(row)) => {
                    row.decision.add(variant, answer);
                    row.undecided = [row.undecided, undecided].into_iter().flatten().min();
                    row.seconds += seconds;
                }
                // A check comes before its variants.
                (Some(_), None) => {}
            }
        }
        rows
    }
}

/// The time between two attempts to be of use to the other threads.
const IDLE: Duration = Duration::from_millis(1);

/// The next news, if there is any before `until`. A thread that is itself one of those that do the work does some
/// meanwhile: it may be the only one. A step that does not end is its end, too, then.
fn next(told: &Receiver<ThreadNews>, until: Instant) -> Option<ThreadNews> {
    loop {
        let rest = until.saturating_duration_since(Instant::now());
        let wait = match rayon::yield_now() {
            None => rest,
            Some(Yield::Idle) => rest.min(IDLE),
            Some(Yield::Executed) => Duration::ZERO,
        };
        let told = told.recv_timeout(wait).ok();
        if told.is_some() || rest.is_zero() {
            return told;
        }
    }
}

/// Work that can be done beside other work: questions that share what is found, one after the other.
struct Job {
    questions: Vec<Question>,
    how: How,
}

/// The words of a panic.
fn words_of(bug: &(dyn Any + Send)) -> &str {
    let of = bug.downcast_ref::<&str>().copied().or_else(|| bug.downcast_ref().map(String::as_str));
    of.unwrap_or("no words")
}

/// How a question is answered.
#[derive(Clone, Copy)]
enum How {
    /// By a search, or whatever else its method is.
    Decided(Until),
    /// By random runs.
    Drawn(RandomRuns),
}

/// A question to decide: a check, by its place, or one of its variants, by its number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Question {
    place: usize,
    variant: Option<usize>,
}

impl Question {
    /// The variant that it is about, if it is about one.
    fn variant(self, checks: &[(&'static Clause, usize)]) -> Option<Variant> {
        let (clause, number) = checks[self.place];
        self.variant.and_then(|variant| clause.checks[number].variants().get(variant).copied())
    }

    /// The error that deciding it ends in, by the method or as the rule, a demand on it or the engine panics.
    fn failed(self, checks: &[(&'static Clause, usize)], what: &str, why: &dyn Display) -> MethodError {
        let (clause, number) = checks[self.place];
        let rule = self.variant(checks).map_or(clause.checks[number].rule(), Variant::name);
        MethodError::new(format_args!("{} {what} for the rule {rule:?}: {why}", clause.id))
    }

    /// The words that stand for it alone.
    fn words(self, checks: &[(&'static Clause, usize)]) -> String {
        let (clause, number) = checks[self.place];
        let check = clause.checks[number];
        let of = self.variant(checks).map_or(check.rule(), Variant::name);
        format!("{} {number} as {:?} {of}, {}", clause.id, self.variant, check.bound())
    }
}

/// A question that is answered, or given up.
struct Completion {
    question: Question,
    /// The variant that it is about, if it is about one.
    variant: Option<Variant>,
    seconds: f64,
    answer: Answer,
    undecided: Option<Indecision>,
}

/// The checks, those with most others in their family first, as these may take longest, each family with the variants
/// about which it tells as much; behind each family the other variants of its checks, so that these are decided
/// before the next ones.
fn jobs(checks: &[(&'static Clause, usize)]) -> Vec<Job> {
    let of = |place: usize| {
        let (clause, number) = checks[place];
        clause.checks[number]
    };
    let mut families: Vec<(Option<String>, Vec<Question>)> = Vec::new();
    for place in 0..checks.len() {
        let (family, question) = (of(place).family(None), Question { place, variant: None });
        match joined(&mut families, family.as_deref()) {
            Some(questions) => questions.push(question),
            None => families.push((family, vec![question])),
        }
    }
    families.sort_by_key(|(_, questions)| Reverse(questions.len()));
    let mut others = Vec::new();
    for place in 0..checks.len() {
        for number in 0..of(place).variants().len() {
            let variant = Some(number);
            let (family, question) = (of(place).family(variant), Question { place, variant });
            match joined(&mut families, family.as_deref()) {
                Some(questions) => questions.push(question),
                None => others.push(Job { questions: vec![question], how: How::Decided(Until::Violation) }),
            }
        }
    }
    let mut jobs = Vec::new();
    for (_, questions) in families {
        let checks = questions.iter().filter(|question| question.variant.is_none());
        let places: Vec<usize> = checks.map(|question| question.place).collect();
        jobs.push(Job { questions, how: How::Decided(Until::Exhausted) });
        jobs.extend(others.extract_if(.., |variant: &mut Job| places.contains(&variant.place())));
    }
    jobs
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

    /// Answers one of its questions.
    fn answer(
        &self,
        question: Question,
        checks: &[(&'static Clause, usize)],
        context: &mut Context<'_, '_>,
    ) -> MethodResult {
        let (clause, number) = checks[question.place];
        match self.how {
            How::Decided(until) => clause.checks[number].decide_rule(question.variant, until, context),
            How::Drawn(runs) => Ok(clause.checks[number].hunt(&runs)?.unwrap_or_else(Answer::open)),
        }
    }
}
