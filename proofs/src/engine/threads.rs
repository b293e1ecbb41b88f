//! Work that is shared out among threads. All of them work on the task of the one that shares it out, which waits
//! meanwhile and works on none.

use std::iter;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use rayon::prelude::*;

use super::watchdog::{self, Task};

/// The answers about all of these, in their order, by the threads of the pool.
pub fn each<T: Send, A: Send>(all: impl IntoIterator<Item = T>, answer: impl Fn(T) -> A + Sync) -> Vec<A> {
    shared_out(all, answer, &in_pool)
}

/// The answers of [`each`], or an error: after the first one no other answer is begun.
///
/// # Errors
/// The error of an answer.
pub fn try_each<T: Send, A: Send, E: Send>(
    all: impl IntoIterator<Item = T>,
    answer: impl Fn(T) -> Result<A, E> + Sync,
) -> Result<Vec<A>, E> {
    let has_failed = AtomicBool::new(false);
    let answers = each(all, |one| {
        let is_due = !has_failed.load(Ordering::Relaxed);
        is_due.then(|| answer(one).inspect_err(|_| has_failed.store(true, Ordering::Relaxed)))
    });
    answers.into_iter().flatten().collect()
}

/// The answers about all of these, in their order, by so many threads that work on
/// nothing else meanwhile. One thread is this one.
pub fn each_by<T: Send, A: Send>(
    workers: usize,
    all: impl IntoIterator<Item = T>,
    answer: impl Fn(T) -> A + Sync,
) -> Vec<A> {
    if workers == 1 {
        return all.into_iter().map(answer).collect();
    }
    shared_out(all, answer, &|count, work| in_threads(workers, count, work))
}

/// The threads of the pool that work on nothing, this one not counted.
pub fn idle() -> usize {
    rayon::current_num_threads().saturating_sub(watchdog::at_work().max(1))
}

/// The answers about all of these, in their order. What shares them out knows no types of theirs, and is compiled once.
fn shared_out<T: Send, A: Send>(
    all: impl IntoIterator<Item = T>,
    answer: impl Fn(T) -> A + Sync,
    share_out: &dyn Fn(usize, Work<'_>),
) -> Vec<A> {
    let all: Vec<_> = all.into_iter().map(|one| Mutex::new((Some(one), None))).collect();
    share_out(all.len(), &|place| {
        let held = || all[place].lock().unwrap_or_else(PoisonError::into_inner);
        let asked = held().0.take();
        let answered = asked.map(&answer);
        held().1 = answered;
    });
    all.into_iter().filter_map(|one| one.into_inner().unwrap_or_else(PoisonError::into_inner).1).collect()
}

/// The work on the one in a place.
type Work<'a> = &'a (dyn Fn(usize) + Sync);

fn in_pool(count: usize, work: Work<'_>) {
    let task = Task::current();
    let _waiting = Task::wait();
    (0..count).into_par_iter().with_max_len(1).for_each(|place| {
        let _working = task.enter();
        work(place);
    });
}

fn in_threads(workers: usize, count: usize, work: Work<'_>) {
    let (task, next) = (Task::current(), &AtomicUsize::new(0));
    thread::scope(|scope| {
        let begun = (0..workers.min(count)).map(|_| {
            scope.spawn(move || {
                let _working = task.enter();
                let places = iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
                places.take_while(|&place| place < count).for_each(work);
            })
        });
        let running: Vec<_> = begun.collect();
        let _waiting = Task::wait();
        for one in running {
            one.join().unwrap_or_else(|panic| resume_unwind(panic));
        }
    });
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    #[test]
    fn answers_are_in_order_and_all_work_is_of_the_task_that_shares_it_out() {
        for task in Task::several(1) {
            let _working = task.enter();
            let all: Vec<u32> = (0..100).collect();
            let both = |number: &u32| (number + 1, Task::current());
            let wanted: Vec<_> = all.iter().map(|number| (number + 1, task)).collect();
            assert_eq!(each(&all, both), wanted);
            assert_eq!(each_by(3, &all, both), wanted);
            assert_eq!(Task::current(), task);
        }
    }

    #[test]
    fn nothing_is_begun_after_an_error() {
        let begun = AtomicUsize::new(0);
        let until = |last: usize| {
            let answer = move |number| if number < last { Ok(number) } else { Err(number) };
            try_each(0..100_000, |number| {
                begun.fetch_add(1, Ordering::Relaxed);
                answer(number)
            })
        };
        assert_eq!(until(100_000), Ok((0..100_000).collect()));
        assert_eq!(begun.swap(0, Ordering::Relaxed), 100_000);
        assert!(until(0).is_err());
        assert!(begun.into_inner() < 50_000);
    }

    #[test]
    fn who_waits_spends_nothing_and_who_works_all_of_it() {
        let rest = || {
            let start = Instant::now();
            thread::sleep(Duration::from_millis(50));
            start.elapsed()
        };
        for task in Task::several(1) {
            let _working = task.enter();
            let rests = each_by(2, [rest, rest], |rest| rest());
            let (spent, both) = (task.spent(), rests[0] + rests[1]);
            assert!(both <= spent && spent < both + rests[0].max(rests[1]), "{spent:?} of {rests:?}");
        }
    }
}
