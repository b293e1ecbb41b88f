//! How far a search over states may go. Searches that run beside each other share the memory that they may take: small
//! ones take it as they come, and of those that grow only one at a time is large. What one search may take does not
//! depend on how many there are, so neither does what it finds.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// How far a search may go.
#[derive(Clone, Copy, Debug)]
pub struct Limits<'a> {
    /// Steps between states that it may make.
    pub most_steps: u64,
    /// The memory that it may take.
    pub room: &'a Room,
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
static ANY: Room = Room { most: u64::MAX, small: u64::MAX, large: Mutex::new(()) };

/// The memory that searches beside each other may take together.
#[derive(Debug)]
pub struct Room {
    /// Bytes of one search.
    most: u64,
    /// Bytes of a search that is not the large one.
    small: u64,
    /// Held by the one search that is large.
    large: Mutex<()>,
}

impl Room {
    /// As much as there is.
    pub const fn any() -> &'static Self {
        &ANY
    }

    /// `bytes` for at most `beside` searches at a time: three quarters of it for the large one, and the rest in equal
    /// shares for all.
    pub const fn of(bytes: u64, beside: u64) -> Self {
        let most = bytes - bytes / 4;
        Self { most, small: bytes / 4 / if beside == 0 { 1 } else { beside }, large: Mutex::new(()) }
    }

    /// The most bytes of one search.
    pub const fn most(&self) -> u64 {
        self.most
    }
}

/// What a search takes of a [`Room`].
pub(super) struct Taken<'a> {
    room: &'a Room,
    large: Option<MutexGuard<'a, ()>>,
    /// Bytes of what stays.
    pub(super) held: u64,
    /// The most bytes so far.
    pub(super) most: u64,
}

impl<'a> Taken<'a> {
    pub(super) const fn new(room: &'a Room) -> Self {
        Self { room, large: None, held: 0, most: 0 }
    }

    /// Holds so many bytes in all; false if a search may not have them.
    pub(super) fn hold(&mut self, bytes: u64) -> bool {
        self.held = bytes;
        self.reaches(bytes)
    }

    /// Has so many bytes in all for a while; false if a search may not have them. A search that becomes large waits until
    /// no other one is.
    pub(super) fn reaches(&mut self, bytes: u64) -> bool {
        self.most = self.most.max(bytes);
        if bytes > self.room.small && self.large.is_none() {
            self.large = Some(self.room.large.lock().unwrap_or_else(PoisonError::into_inner));
        }
        bytes <= self.room.most
    }
}
