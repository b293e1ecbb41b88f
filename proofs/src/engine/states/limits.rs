//! How far a search over states may go. Searches that run beside each other share the memory that they may take: small
//! ones take it as they come, and of those that grow only one at a time is large. What one search may take does not
//! depend on how many there are, so neither does what it finds.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// How far a search may go.
#[derive(Clone, Copy, Debug)]
pub struct Limits<'a> {
    /// Steps between states that it may make.
    pub most_steps: u64,
    /// The memory that it may take.
    pub room: &'a MemoryLimit,
}

impl Limits<'static> {
    /// None: to the end of the states.
    pub const NONE: Self = Self::steps(u64::MAX);

    /// At most so many steps, in any memory.
    pub const fn steps(most_steps: u64) -> Self {
        Self { most_steps, room: &ANY }
    }
}

/// Room for whatever there is.
static ANY: MemoryLimit = MemoryLimit::unbounded();

/// The memory that searches beside each other may take together.
#[derive(Debug)]
pub struct MemoryLimit {
    /// Bytes of one search.
    most: u64,
    /// Bytes of a search that is not the large one.
    small: u64,
    /// Held by the one search that is large.
    large: Mutex<()>,
    /// Whether it did not suffice.
    was_too_small: AtomicBool,
}

impl MemoryLimit {
    /// As much as there is.
    pub const fn any() -> &'static Self {
        &ANY
    }

    /// As much as there is, for searches of one's own.
    pub const fn unbounded() -> Self {
        Self { most: u64::MAX, small: u64::MAX, large: Mutex::new(()), was_too_small: AtomicBool::new(false) }
    }

    /// `bytes` for at most `beside` searches at a time: three quarters of it for the large one, and the rest in equal
    /// shares for all.
    pub const fn of(bytes: u64, beside: u64) -> Self {
        let most = bytes - bytes / 4;
        let small = bytes / 4 / if beside == 0 { 1 } else { beside };
        Self { most, small, large: Mutex::new(()), was_too_small: AtomicBool::new(false) }
    }

    /// Whether a search was cut off for want of it.
    pub fn was_too_small(&self) -> bool {
        self.was_too_small.load(Ordering::Relaxed)
    }

    /// The most bytes of one search.
    pub const fn most(&self) -> u64 {
        self.most
    }
}

/// A search's share of a [`MemoryLimit`].
pub(super) struct MemoryShare<'a> {
    room: &'a MemoryLimit,
    large: Option<MutexGuard<'a, ()>>,
    /// Bytes of what stays.
    pub(super) held: u64,
    /// The most bytes so far.
    pub(super) most: u64,
}

impl<'a> MemoryShare<'a> {
    pub(super) const fn new(room: &'a MemoryLimit) -> Self {
        Self { room, large: None, held: 0, most: 0 }
    }

    /// Holds so many bytes in all; false if a search may not have them.
    pub(super) fn hold(&mut self, bytes: u64) -> bool {
        self.held = bytes;
        self.reaches(bytes)
    }

    /// Has so many bytes in all for a while; false if a search may not have them. A search that becomes large waits
    /// until no other one is.
    pub(super) fn reaches(&mut self, bytes: u64) -> bool {
        self.most = self.most.max(bytes);
        if bytes > self.room.small && self.large.is_none() {
            self.large = Some(self.room.large.lock().unwrap_or_else(PoisonError::into_inner));
        }
        let fits = bytes <= self.room.most;
        if !fits {
            self.room.was_too_small.store(true, Ordering::Relaxed);
        }
        fits
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::thread;
    use std::time::Duration;

    use super::*;

    #[test]
    fn one_search_gets_three_quarters_whatever_is_beside_it() {
        for beside in [0, 1, 64] {
            let room = MemoryLimit::of(1024, beside);
            let mut taken = MemoryShare::new(&room);
            assert!(taken.hold(768) && !room.was_too_small());
            assert!(!taken.hold(769) && room.was_too_small());
            assert_eq!((taken.held, taken.most, room.most()), (769, 769, 768));
        }
        assert!(MemoryShare::new(MemoryLimit::any()).hold(u64::MAX));
    }

    #[test]
    fn a_second_large_search_waits_for_the_first() {
        let room = MemoryLimit::of(1024, 2);
        let (told, heard) = channel();
        thread::scope(|scope| {
            let mut first = MemoryShare::new(&room);
            assert!(first.hold(200));
            scope.spawn(|| {
                let mut second = MemoryShare::new(&room);
                assert!(second.hold(100), "a small one does not wait");
                told.send("small").expect("somebody hears");
                assert!(second.hold(300));
                told.send("large").expect("somebody hears");
            });
            assert_eq!(heard.recv(), Ok("small"));
            assert!(heard.recv_timeout(Duration::from_millis(50)).is_err(), "the first one is large");
            drop(first);
            assert_eq!(heard.recv(), Ok("large"));
        });
    }
}
