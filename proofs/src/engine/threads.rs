//! Work that is shared out among threads. All of them work on the task of the one that shares it out, which waits
//! meanwhile and works on none.

use std::panic::resume_unwind;
use std::sync::{Mutex, PoisonError};
use std::thread;

use rayon::prelude::*;

use super::watchdog::Task;

/// The answers about all of these, in their order, by the threads of the pool.
pub fn each<T: Send, A: Send>(all: impl IntoIterator<Item = T>, answer: impl Fn(T) -> A + Sync) -> Vec<A> {
    let all: Vec<_> = all.into_iter().map(|one| Mutex::new((Some(one), None))).collect();
    in_pool(all.len(), &|place| {
        let held = || all[place].lock().unwrap_or_else(PoisonError::into_inner);
        let asked = held().0.take();
        let answered = asked.map(&answer);
        held().1 = answered;
    });
    all.into_iter().filter_map(|one| one.into_inner().unwrap_or_else(PoisonError::into_inner).1).collect()
}

/// Apart from the types of those who share work out, so that it is compiled once.
fn in_pool(count: usize, work: &(dyn Fn(usize) + Sync)) {
    let task = Task::current();
    let _waiting = Task::NONE.enter();
    (0..count).into_par_iter().with_max_len(1).for_each(|place| {
        let _working = task.enter();
        work(place);
    });
}

/// The results of all of these, in their order, each in a thread of its own.
pub fn each_in_its_own<A: Send>(all: impl IntoIterator<Item = impl FnOnce() -> A + Send>) -> Vec<A> {
    let task = Task::current();
    thread::scope(|scope| {
        let begun = all.into_iter().map(|work| {
            scope.spawn(move || {
                let _working = task.enter();
                work()
            })
        });
        let running: Vec<_> = begun.collect();
        let _waiting = Task::NONE.enter();
        running.into_iter().map(|one| one.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    })
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
            assert_eq!(each_in_its_own(all.iter().map(|number| move || both(number))), wanted);
            assert_eq!(Task::current(), task);
        }
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
            let rests = each_in_its_own([rest, rest]);
            let (spent, both) = (task.spent(), rests[0] + rests[1]);
            assert!(both <= spent && spent < both + rests[0].max(rests[1]), "{spent:?} of {rests:?}");
        }
    }
}
