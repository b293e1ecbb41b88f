//! Messages under way between nodes: they arrive in any order, and some may be lost.

use super::{Compact, Move};
use crate::engine::states::Bits;

/// A message: its sender, its receiver, and what it says.
pub type Letter<M> = (usize, usize, M);

/// Messages under way, and how many of them may yet be lost.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Mail<M> {
    under_way: Vec<Letter<M>>,
    losses: u32,
}

impl<M: Clone + Ord> Mail<M> {
    /// No message under way, and at most so many losses.
    pub const fn new(losses: u32) -> Self {
        Self { under_way: Vec::new(), losses }
    }

    /// Sends a message.
    pub fn send(&mut self, letter: Letter<M>) {
        let place = self.under_way.partition_point(|other| *other < letter);
        self.under_way.insert(place, letter);
    }

    /// The mail with one message more to each of a set of nodes, a bit for each.
    #[must_use]
    pub fn with_each(&self, from: usize, to: Bits, message: &M) -> Self {
        let receivers = (0..Bits::BITS as usize).filter(|node| to >> node & 1 == 1);
        let mut mail = self.clone();
        receivers.for_each(|to| mail.send((from, to, message.clone())));
        mail
    }

    /// The messages under way, in one order whatever order they were sent in.
    pub fn under_way(&self) -> &[Letter<M>] {
        &self.under_way
    }

    /// Every message that may arrive next, with the mail that is left then.
    pub fn arrivals(&self) -> impl Iterator<Item = (Letter<M>, Self)> {
        self.under_way.iter().enumerate().map(|(place, letter)| {
            let mut left = self.clone();
            left.under_way.remove(place);
            (letter.clone(), left)
        })
    }

    /// Every arrival as a move of its receiver, to the state that comes of it and of the mail that is left; and every
    /// loss as a fault.
    pub fn moves<S>(
        &self,
        mut hears: impl FnMut(Letter<M>, Self) -> S,
        lost: impl FnMut(Self) -> S,
    ) -> impl Iterator<Item = Move<S>> {
        let arrivals = self.arrivals().map(move |(letter, left)| {
            let receiver = letter.1;
            Move::of(receiver, "hears", hears(letter, left))
        });
        arrivals.chain(self.losses().map(lost).map(|to| Move::fault("a message is lost", to)))
    }

    /// A line for each message under way, with these words for it.
    pub fn lines(&self, words: impl Fn(&M) -> String) -> impl Iterator<Item = String> {
        self.under_way.iter().map(move |(from, to, message)| format!("{from}>{to} {}\n", words(message)))
    }

    /// The mail after each loss that there may be.
    pub fn losses(&self) -> impl Iterator<Item = Self> {
        let left = self.losses.checked_sub(1);
        self.arrivals().filter_map(move |(_, mail)| Some(Self { losses: left?, ..mail }))
    }
}

impl<M: Compact> Compact for Mail<M> {
    fn write(&self, to: &mut Vec<u8>) {
        self.under_way.write(to);
        self.losses.write(to);
    }

    fn read(from: &mut &[u8]) -> Self {
        Self { under_way: Vec::read(from), losses: u32::read(from) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_arrive_in_any_order_and_at_most_so_many_are_lost() {
        let mut mail = Mail::new(1);
        mail.send((1, 0, 'b'));
        mail.send((0, 1, 'a'));
        let arrived: Vec<char> = mail.arrivals().map(|(letter, _)| letter.2).collect();
        assert_eq!(arrived, ['a', 'b']);
        let lost: Vec<Mail<char>> = mail.losses().collect();
        assert_eq!(lost[0].under_way(), [(1, 0, 'b')]);
        assert_eq!(lost[0].losses().count(), 0);
        let other_order = [(0, 1, 'a'), (1, 0, 'b')].into_iter().fold(Mail::new(1), |mut mail, letter| {
            mail.send(letter);
            mail
        });
        assert_eq!(other_order, mail);
    }
}
