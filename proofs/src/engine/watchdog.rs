//! The watchdog over steps. Code under test may loop for ever inside one step: a team move, a case of a body, the steps
//! from a state, a case. No engine gets the control back then, and no thread can be ended by another one. So
//! each thread counts the steps that it makes, and whoever waits for its work looks at the counts once a second. A task
//! is *silent* while one of its threads is inside a step and none of them begins another one. A task that is silent for
//! too long is given up, and its thread is left behind.
//!
//! Seconds of silence are counted in looks: a process that was stopped, or a machine that slept, makes nobody
//! impatient. A count is written by its own thread alone, on a cache line of its own, so that counting costs two plain
//! memory accesses for each step. The time that threads spend on a task is measured where they take it up and leave it.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::marker::PhantomData;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::{Duration, Instant};

/// The time between two looks.
pub const BETWEEN_LOOKS: Duration = Duration::from_secs(1);

/// The steps that a thread makes. Lines of two caches are fetched together on some processors, so it takes two.
#[repr(align(128))]
struct Pulse {
    /// The task that its thread works on.
    task: AtomicU64,
    /// Twice the steps that its thread has begun or left, and 1 more while it is inside of one.
    beats: AtomicU64,
}

impl Pulse {
    /// Whether its thread is inside a step.
    fn is_inside(&self) -> bool {
        self.beats.load(Ordering::Relaxed) & INSIDE != 0
    }

    /// Counts a step that begins. Nobody but its own thread writes it.
    #[inline]
    fn begin(&self) {
        let beats = self.beats.load(Ordering::Relaxed);
        self.beats.store((beats | INSIDE).wrapping_add(BEAT), Ordering::Relaxed);
    }

    /// Counts a step that is left.
    #[inline]
    fn leave(&self) {
        let beats = self.beats.load(Ordering::Relaxed);
        self.beats.store((beats & !INSIDE).wrapping_add(BEAT), Ordering::Relaxed);
    }

    /// Its thread takes up `task`. The one that it worked on until then is returned.
    fn take_up(&self, task: Task) -> Task {
        let before = Task(self.task.load(Ordering::Relaxed));
        self.task.store(task.0, Ordering::Relaxed);
        let now = (before != Task::NONE || task != Task::NONE).then(Instant::now);
        if let (Some(since), Some(now)) = (SINCE.replace(now), now)
            && before != Task::NONE
        {
            *SPENT.lock().unwrap_or_else(PoisonError::into_inner).entry(before).or_default() += now - since;
        }
        before
    }

    /// Goes back to where its thread was before it took up other work.
    fn go_back(&self, was_inside: bool) {
        if was_inside { self.begin() } else { self.leave() }
    }
}

const INSIDE: u64 = 1;
const BEAT: u64 = 2;

/// The pulses of all threads that ever made a step, as long as the threads live.
static PULSES: Mutex<Vec<Weak<Pulse>>> = Mutex::new(Vec::new());

/// The time that threads have spent on each task, as far as nobody has asked for it.
static SPENT: Mutex<BTreeMap<Task, Duration>> = Mutex::new(BTreeMap::new());

/// The first task that no one has.
static NEXT: AtomicU64 = AtomicU64::new(1);

thread_local! {
    static OWN: Arc<Pulse> = {
        let pulse = Arc::new(Pulse { task: AtomicU64::new(0), beats: AtomicU64::new(0) });
        PULSES.lock().unwrap_or_else(PoisonError::into_inner).push(Arc::downgrade(&pulse));
        pulse
    };
    /// When this thread took up what it works on, if that or what it did before is a task.
    static SINCE: Cell<Option<Instant>> = const { Cell::new(None) };
    /// Whether it is one of those that work.
    static IS_AT_WORK: Cell<bool> = const { Cell::new(false) };
}

/// Threads that work on something, whatever its task.
static AT_WORK: AtomicUsize = AtomicUsize::new(0);

/// How many threads work on something that they have entered.
pub fn at_work() -> usize {
    AT_WORK.load(Ordering::Relaxed)
}

/// Work whose steps are counted together: a job of the ledger, say, on whatever threads.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Task(u64);

impl Task {
    /// The task of a thread that has none, or waits for others. Its time is not measured.
    pub const NONE: Self = Self(0);

    /// So many new tasks.
    pub fn several(count: usize) -> impl ExactSizeIterator<Item = Self> {
        let first = NEXT.fetch_add(count as u64, Ordering::Relaxed);
        (0..count).map(move |number| Self(first + number as u64))
    }

    /// The task that this thread works on. What it shares out among other threads is theirs to enter.
    pub fn current() -> Self {
        Self(OWN.with(|pulse| pulse.task.load(Ordering::Relaxed)))
    }

    /// Lets this thread work on the task until what is returned is dropped. A thread that waits for others may take up
    /// other work meanwhile: it is outside of its step then, and inside again when it comes back.
    #[must_use]
    pub fn enter(self) -> WorkGuard {
        self.take_up(true)
    }

    /// Lets this thread wait for others until what is returned is dropped.
    #[must_use]
    pub fn wait() -> WorkGuard {
        Self::NONE.take_up(false)
    }

    fn take_up(self, is_at_work: bool) -> WorkGuard {
        let pulse = OWN.with(Arc::clone);
        let was_inside = pulse.is_inside();
        pulse.leave();
        let before = pulse.take_up(self);
        let was_at_work = go_to_work(is_at_work);
        WorkGuard { pulse, before, was_inside, was_at_work, of_this_thread: PhantomData }
    }

    /// The time that threads have spent on it, added up, since this was asked last. That of a thread that works on it
    /// counts once it takes up something else; this one's does.
    pub fn spent(self) -> Duration {
        drop(self.enter());
        SPENT.lock().unwrap_or_else(PoisonError::into_inner).remove(&self).unwrap_or_default()
    }
}

/// Lets this thread be one of those that work, or none. Whether it was is returned.
fn go_to_work(is_at_work: bool) -> bool {
    let was_at_work = IS_AT_WORK.replace(is_at_work);
    match (was_at_work, is_at_work) {
        (false, true) => AT_WORK.fetch_add(1, Ordering::Relaxed),
        (true, false) => AT_WORK.fetch_sub(1, Ordering::Relaxed),
        _ => 0,
    };
    was_at_work
}

/// The time in which a thread works on a task.
pub struct WorkGuard {
    pulse: Arc<Pulse>,
    before: Task,
    was_inside: bool,
    was_at_work: bool,
    of_this_thread: PhantomData<Cell<()>>,
}

impl Drop for WorkGuard {
    fn drop(&mut self) {
        go_to_work(self.was_at_work);
        self.pulse.take_up(self.before);
        self.pulse.go_back(self.was_inside);
    }
}

/// The time in which a thread makes steps. It is inside a step until it leaves it, or this is dropped.
pub struct Steps {
    pulse: Arc<Pulse>,
    was_inside: bool,
    of_this_thread: PhantomData<Cell<()>>,
}

impl Steps {
    /// This thread begins a step.
    #[must_use]
    pub fn begin() -> Self {
        let pulse = OWN.with(Arc::clone);
        let was_inside = pulse.is_inside();
        pulse.begin();
        Self { pulse, was_inside, of_this_thread: PhantomData }
    }

    /// The next step begins.
    #[inline]
    pub fn next(&self) {
        self.pulse.begin();
    }

    /// The step has ended. Whatever is done before the next one may take its time.
    #[inline]
    pub fn leave(&self) {
        self.pulse.leave();
    }
}

impl Drop for Steps {
    fn drop(&mut self) {
        self.pulse.go_back(self.was_inside);
    }
}

/// The threads that are inside a step of a task, each with its count.
type Inside = Vec<(usize, u64)>;

/// Looks at the tasks of a range, and tells how long each has been silent.
pub struct Watchdog {
    tasks: Range<u64>,
    /// The tasks of which a thread is inside a step, as they were at the last look, and for how many looks they have
    /// been so.
    known: BTreeMap<Task, (Inside, u32)>,
    /// The counts of all threads at work on the tasks, at the last look, and for how many looks they have been so.
    all: (Inside, u32),
}

impl Watchdog {
    /// Watches these tasks, which follow one another.
    pub fn new(tasks: &[Task]) -> Self {
        let first = tasks.first().map_or(0, |task| task.0);
        Self { tasks: first..first + tasks.len() as u64, known: BTreeMap::new(), all: (Vec::new(), 0) }
    }

    /// Looks at the counts, [`BETWEEN_LOOKS`] after the last time.
    pub fn look(&mut self) {
        let mut inside: BTreeMap<Task, Inside> = BTreeMap::new();
        let mut all = Vec::new();
        let mut pulses = PULSES.lock().unwrap_or_else(PoisonError::into_inner);
        pulses.retain(|pulse| {
            let Some(pulse) = pulse.upgrade() else { return false };
            let task = pulse.task.load(Ordering::Relaxed);
            if self.tasks.contains(&task) {
                let count = (Arc::as_ptr(&pulse).addr(), pulse.beats.load(Ordering::Relaxed));
                all.push(count);
                if pulse.is_inside() {
                    inside.entry(Task(task)).or_default().push(count);
                }
            }
            true
        });
        drop(pulses);
        let silent = |before: Option<&(Inside, u32)>, now: &Inside| match before {
            Some((before, looks)) if before == now => looks.saturating_add(1),
            Some(_) | None => 0,
        };
        let looks = silent(Some(&self.all), &all);
        self.all = (all, looks);
        let known = inside.into_iter().map(|(task, now)| {
            let looks = silent(self.known.get(&task), &now);
            (task, (now, looks))
        });
        self.known = known.collect();
    }

    /// The tasks that have been silent for at least so many seconds.
    pub fn silent(&self, seconds: u32) -> impl Iterator<Item = Task> {
        self.known.iter().filter(move |(_, (_, looks))| *looks >= seconds).map(|(&task, _)| task)
    }

    /// Whether no thread has begun a step of any of the tasks for at least so many seconds.
    pub fn is_all_silent(&self, seconds: u32) -> bool {
        self.all.1 >= seconds
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::thread;

    use super::*;

    /// Whether a watchdog finds a thread that does this silent, at two looks.
    fn is_silent(work: impl FnOnce(Task, &dyn Fn()) + Send) -> bool {
        let tasks: Vec<Task> = Task::several(1).collect();
        let mut watchdog = Watchdog::new(&tasks);
        let (told, heard) = channel();
        let (let_go, may_go) = channel();
        thread::scope(|scope| {
            let task = tasks[0];
            scope.spawn(move || {
                let rest = || {
                    told.send(()).expect("somebody looks");
                    may_go.recv().expect("somebody looks");
                };
                work(task, &rest);
            });
            for _ in 0..2 {
                heard.recv().expect("it rests twice");
                watchdog.look();
                let_go.send(()).expect("it rests");
            }
        });
        watchdog.silent(1).eq(tasks)
    }

    #[test]
    fn a_task_is_silent_while_its_step_goes_on() {
        assert!(is_silent(|task, rest| {
            let _working = task.enter();
            let _steps = Steps::begin();
            rest();
            rest();
        }));
    }

    #[test]
    fn a_task_is_not_silent_that_makes_steps_or_is_outside_of_any() {
        assert!(!is_silent(|task, rest| {
            let _working = task.enter();
            let steps = Steps::begin();
            rest();
            steps.next();
            rest();
        }));
        assert!(!is_silent(|task, rest| {
            let _working = task.enter();
            let steps = Steps::begin();
            steps.leave();
            rest();
            rest();
        }));
    }

    #[test]
    fn a_thread_that_takes_up_other_work_inside_a_step_makes_the_first_task_not_silent() {
        assert!(!is_silent(|task, rest| {
            let _working = task.enter();
            let _steps = Steps::begin();
            for other in Task::several(1) {
                let _working = other.enter();
                let _steps = Steps::begin();
                rest();
                rest();
            }
        }));
    }

    #[test]
    fn a_step_within_a_step_leaves_the_outer_one_when_it_ends() {
        assert!(is_silent(|task, rest| {
            let _working = task.enter();
            let _steps = Steps::begin();
            drop(Steps::begin());
            drop(task.enter());
            rest();
            rest();
        }));
    }
}
