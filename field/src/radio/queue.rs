//! A queue of events: the earliest first, and of events at one time the order is that of the events themselves, never
//! that in which they were put in.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Events in the order of their time, then in their own.
#[derive(Debug)]
pub(super) struct Queue<E>(BinaryHeap<Reverse<(u64, E)>>);

impl<E: Ord> Queue<E> {
    pub(super) const fn new() -> Self {
        Self(BinaryHeap::new())
    }

    pub(super) fn put(&mut self, at_ns: u64, event: E) {
        self.0.push(Reverse((at_ns, event)));
    }

    pub(super) fn take(&mut self) -> Option<(u64, E)> {
        self.0.pop().map(|Reverse(next)| next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_happens_at_once_comes_in_its_own_order() {
        let drain = |events: &[(u64, u8)]| {
            let mut queue = Queue::new();
            for &(at_ns, event) in events {
                queue.put(at_ns, event);
            }
            std::iter::from_fn(|| queue.take()).collect::<Vec<_>>()
        };
        let sorted = [(1, 3), (2, 0), (2, 1), (2, 1), (9, 0)];
        assert_eq!(drain(&sorted), sorted);
        assert_eq!(drain(&[(2, 1), (9, 0), (2, 0), (1, 3), (2, 1)]), sorted);
    }
}
