//! Letters are messages for one station alone, MOVE, RESB and the answers to it. A letter goes from hop to hop as a
//! sensor's radio sends such frames (IEEE 802.15.4): the hop acknowledges it by the number of the frame, the sender
//! repeats it until then, at most three times, and a frame that comes once more is acknowledged and otherwise ignored.
//! A call is for all, and is not acknowledged. The paper is silent about this; without it hardly a message would come
//! through fifteen hops that lose one in ten.

use tautline_kernel::mrc::{Hop, Resb, Upward};

/// A sender waits so long for an acknowledgement: over the shared channel both are on the air for 1 ms, and wait while
/// others send.
pub(super) const ANSWER_WAIT_NS: u64 = 25_000_000;

/// A letter is sent at most so often.
pub(super) const TRIES: u8 = 4;

/// A letter's content.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Content {
    /// Towards a WFR.
    Up(Upward),
    /// Towards a robot.
    Down(Resb),
}

/// A message for one station alone.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Letter {
    pub(super) from: Hop,
    pub(super) to: Hop,
    /// Its number among those of its sender.
    pub(super) frame: u32,
    pub(super) content: Content,
}

/// The letters of a station.
#[derive(Debug, Default)]
pub(super) struct Letters {
    written: u32,
    /// Those that are not acknowledged, and how often each will still be repeated.
    open: Vec<(Letter, u8)>,
    heard: Vec<(Hop, Window)>,
}

/// Which frames of a sender have come: the newest, and those of the 64 up to it. A letter is given up long before its
/// sender has written 64 more.
#[derive(Debug, Default)]
struct Window {
    newest: u32,
    /// The bit of each frame, the newest one's being the lowest.
    came: u64,
}

impl Window {
    /// Takes in that `frame` has come; whether it had not come before.
    fn takes(&mut self, frame: u32) -> bool {
        let ahead = frame.saturating_sub(self.newest);
        self.came = self.came.checked_shl(ahead).unwrap_or(0);
        self.newest += ahead;
        let bit = 1_u64.checked_shl(self.newest - frame).unwrap_or(0);
        let is_new = self.came & bit == 0;
        self.came |= bit;
        is_new
    }
}

impl Letters {
    /// A new letter.
    pub(super) fn write(&mut self, from: Hop, to: Hop, content: Content) -> Letter {
        self.written += 1;
        let letter = Letter { from, to, frame: self.written, content };
        self.open.push((letter, TRIES - 1));
        letter
    }

    /// A letter has been acknowledged.
    pub(super) fn close(&mut self, frame: u32) {
        self.open.retain(|(letter, _)| letter.frame != frame);
    }

    /// A letter to be repeated, unless it has been acknowledged or repeated often enough.
    pub(super) fn repeat(&mut self, frame: u32) -> Option<Letter> {
        let place = self.open.iter().position(|(letter, _)| letter.frame == frame)?;
        let (letter, repeats_left) = &mut self.open[place];
        if let Some(left) = repeats_left.checked_sub(1) {
            *repeats_left = left;
            return Some(*letter);
        }
        self.open.remove(place);
        None
    }

    /// Whether a letter that arrives has not arrived before.
    pub(super) fn is_news(&mut self, letter: &Letter) -> bool {
        let place = self.heard.iter().position(|(from, _)| *from == letter.from);
        let place = place.unwrap_or_else(|| {
            self.heard.push((letter.from, Window::default()));
            self.heard.len() - 1
        });
        self.heard[place].1.takes(letter.frame)
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::net::{Call, Epoch, NodeId, RobotId};

    use super::*;

    fn letter(letters: &mut Letters) -> Letter {
        let call = Call { wfr: NodeId(1), epoch: Epoch::FIRST };
        let resb = Resb { call, robot: RobotId(0), chosen: None };
        letters.write(Hop::Node(NodeId(1)), Hop::Robot(RobotId(0)), Content::Down(resb))
    }

    #[test]
    fn a_letter_is_repeated_three_times_unless_it_is_acknowledged() {
        let mut letters = Letters::default();
        let (one, other) = (letter(&mut letters), letter(&mut letters));
        letters.close(one.frame);
        assert_eq!(letters.repeat(one.frame), None);
        let repeats = [(); 4].map(|()| letters.repeat(other.frame));
        assert_eq!(repeats, [Some(other), Some(other), Some(other), None]);
    }

    #[test]
    fn a_letter_that_comes_again_is_no_news() {
        let mut letters = Letters::default();
        let (one, other) = (letter(&mut letters), letter(&mut letters));
        let mut reader = Letters::default();
        assert_eq!([one, one, other, one].map(|letter| reader.is_news(&letter)), [true, false, true, false]);
        let elsewhere = Letter { from: Hop::Node(NodeId(2)), ..one };
        assert!(reader.is_news(&elsewhere));
    }

    #[test]
    fn a_letter_that_a_later_one_has_overtaken_is_news_once() {
        let mut letters = Letters::default();
        let written: Vec<Letter> = (0..64).map(|_| letter(&mut letters)).collect();
        let mut reader = Letters::default();
        let are_news = [1, 0, 0, 1, 63, 3, 3, 1].map(|place: usize| reader.is_news(&written[place]));
        assert_eq!(are_news, [true, true, false, false, true, true, false, false]);
    }
}
