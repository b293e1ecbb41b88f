//! The history that a chain can take back: the entries of its log that are open, read backwards (CHAIN-8). It begins
//! with all robots in the base, unless the chain has re-formed or met a wall on its way back.

use super::message::Message;

/// Where a history begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Past {
    /// With all robots in the base.
    Home,
    /// At this entry of the log, with the robots elsewhere.
    Since(u32),
}

impl Past {
    /// The open entry before `entry` of a log in which each has the messages of so many `movers`: read backwards, every
    /// backtrack pairs with the nearest open move before it.
    pub(super) fn open_before(self, entry: u32, log: &[u8], movers: usize) -> Option<u32> {
        let first = if let Self::Since(first) = self { first } else { 0 };
        let mut taken_back = 0_u32;
        for index in (first..entry).rev() {
            if log.get(index as usize * movers).is_some_and(|&byte| Message::is_backtrack(byte)) {
                taken_back += 1;
            } else if taken_back == 0 {
                return Some(index);
            } else {
                taken_back -= 1;
            }
        }
        None
    }
}
