//! How far a search over states may go, and on how many threads. Searches that run beside each other share the memory
//! that they may take: small ones take it as they come, and of those that grow only one at a time is large. What one
//! search may take does not depend on how many there are, so neither does what it finds. A large search for which
//! memory does not suffice goes on in a folder ([`Spill`]), if there is one.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::spill::{Spill, SpillError};

/// How far a search may go.
#[derive(Clone, Copy, Debug)]
pub struct Limits<'a> {
    /// Steps between states that it may make.
    pub most_steps: u64,
    /// The memory that it may take.
    pub memory: Memory<'a>,
    /// The threads that it takes, of which nothing depends that it finds; as many as are idle, unless it is said.
    pub workers: Option<NonZeroUsize>,
}

impl Limits<'static> {
    /// None: to the end of the states.
    pub const NONE: Self = Self::steps(u64::MAX);

    /// At most so many steps, in any memory.
    pub const fn steps(most_steps: u64) -> Self {
        Self { most_steps, memory: MemoryLimit::any(), workers: None }
    }
}

/// The memory of searches that answer one question.
#[derive(Clone, Copy, Debug)]
pub struct Memory<'a> {
    limit: &'a MemoryLimit,
    /// The folder in which a search goes on.
    pub(super) spill: Option<&'a Spill>,
    /// The question, if a search that is killed may be taken up for it, and the number of the search among its own.
    pub(super) question: Option<(&'a str, usize)>,
}

impl Memory<'_> {
    /// That of the search with this number among those that answer the question.
    #[must_use]
    pub const fn of_search(self, number: usize) -> Self {
        match self.question {
            Some((question, _)) => Self { question: Some((question, number)), ..self },
            None => self,
        }
    }

    /// That of a search that goes on in no folder.
    pub(super) const fn in_memory(self) -> Self {
        Self { spill: None, ..self }
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
    /// Where a search goes on for which it does not suffice.
    spill: Option<Spill>,
}

impl MemoryLimit {
    /// As much as there is.
    pub const fn any() -> Memory<'static> {
        Memory { limit: &ANY, spill: None, question: None }
    }

    /// As much as there is, for searches of one's own.
    pub const fn unbounded() -> Self {
        Self::new(u64::MAX, u64::MAX)
    }

    const fn new(most: u64, small: u64) -> Self {
        let was_too_small = AtomicBool::new(false);
        Self { most, small, large: Mutex::new(()), was_too_small, spill: None }
    }

    /// `bytes` for at most `beside` searches at a time: three quarters of it for the large one, and the rest in equal
    /// shares for all.
    pub const fn of(bytes: u64, beside: u64) -> Self {
        Self::new(bytes - bytes / 4, bytes / 4 / if beside == 0 { 1 } else { beside })
    }

    /// This memory, and a folder in which a search goes on for which it does not suffice.
    #[must_use]
    pub fn spilling(self, spill: Spill) -> Self {
        Self { spill: Some(spill), ..self }
    }

    /// The memory of searches that answer no question in particular.
    pub const fn memory(&self) -> Memory<'_> {
        Memory { limit: self, spill: self.spill.as_ref(), question: None }
    }

    /// The memory of searches that answer this question, by words that stand for it alone: one that was killed is taken
    /// up when the same question is asked again.
    pub const fn asked<'a>(&'a self, question: &'a str) -> Memory<'a> {
        Memory { question: Some((question, 0)), ..self.memory() }
    }

    /// Whether there is a folder in which a search goes on.
    pub const fn has_folder(&self) -> bool {
        self.spill.is_some()
    }

    /// Why a search could not go on in its folder.
    pub fn fault(&self) -> Option<SpillError> {
        self.spill.as_ref().and_then(Spill::fault)
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
    memory: Memory<'a>,
    large: Option<MutexGuard<'a, ()>>,
    /// Bytes of what stays.
    pub(super) held: u64,
    /// The most bytes so far.
    pub(super) most: u64,
}

impl<'a> MemoryShare<'a> {
    pub(super) const fn new(memory: Memory<'a>) -> Self {
        Self { memory, large: None, held: 0, most: 0 }
    }

    /// Holds so many bytes in all; false if a search may not have them.
    pub(super) fn hold(&mut self, bytes: u64) -> bool {
        self.held = bytes;
        self.reaches(bytes)
    }

    /// Has so many bytes in all for a while; false if a search may not have them. A search that becomes large waits
    /// until no other one is.
    pub(super) fn reaches(&mut self, bytes: u64) -> bool {
        let limit = self.memory.limit;
        if bytes > limit.small && self.large.is_none() {
            self.large = Some(limit.large.lock().unwrap_or_else(PoisonError::into_inner));
        }
        let fits = self.fits(bytes);
        if fits {
            self.most = self.most.max(bytes);
        }
        fits
    }

    /// Whether a search may have so many bytes.
    pub(super) const fn fits(&self, bytes: u64) -> bool {
        bytes <= self.memory.limit.most
    }

    /// The memory did not suffice, and the search stops.
    pub(super) fn was_too_small(&self) {
        self.memory.limit.was_too_small.store(true, Ordering::Relaxed);
    }

    /// The bytes that steps may take at a time beside so many, if a search goes on in a folder: the
    /// states to which they lead may take as many, and a table as many again while it grows.
    /// Nothing if that is too little to go on with.
    pub(super) const fn for_steps(&self, beside: u64) -> u64 {
        let most = self.memory.limit.most;
        let bytes = most.saturating_sub(beside) / 4;
        if bytes < most / 32 { 0 } else { bytes }
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
            let memory = MemoryLimit::of(1024, beside);
            let mut taken = MemoryShare::new(memory.memory());
            assert!(taken.hold(768) && !taken.hold(769));
            assert_eq!((taken.held, taken.most, memory.most()), (769, 768, 768));
        }
        assert!(MemoryShare::new(MemoryLimit::any()).hold(u64::MAX));
    }

    #[test]
    fn a_second_large_search_waits_for_the_first() {
        let memory = MemoryLimit::of(1024, 2);
        let (told, heard) = channel();
        thread::scope(|scope| {
            let mut first = MemoryShare::new(memory.memory());
            assert!(first.hold(200));
            scope.spawn(|| {
                let mut second = MemoryShare::new(memory.memory());
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
