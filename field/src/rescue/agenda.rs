//! A station's agenda: timers that are to go off, and messages that are to be sent. The air knows one timer of a
//! station, so it is wound to the earliest of them.

use std::collections::VecDeque;

/// A station's agenda.
#[derive(Debug)]
pub(super) struct Agenda<D, M> {
    /// In the order put in.
    due: Vec<(u64, D)>,
    outbox: VecDeque<M>,
    /// The earliest time for which the station's timer is wound.
    wound_ns: Option<u64>,
}

impl<D, M> Agenda<D, M> {
    pub(super) const fn new() -> Self {
        Self { due: Vec::new(), outbox: VecDeque::new(), wound_ns: None }
    }

    /// `duty` is due at `at_ns`.
    pub(super) fn put(&mut self, at_ns: u64, duty: D) {
        self.due.push((at_ns, duty));
    }

    /// `message` is to be sent after those that wait.
    pub(super) fn send(&mut self, message: M) {
        self.outbox.push_back(message);
    }

    /// Forgets everything: the station has failed.
    pub(super) fn clear(&mut self) {
        self.due.clear();
        self.outbox.clear();
    }

    /// The station's timer has gone off.
    pub(super) fn went_off(&mut self, now_ns: u64) {
        self.wound_ns = self.wound_ns.filter(|&at_ns| at_ns > now_ns);
    }

    /// The duty that is due longest, of several the one put in first.
    pub(super) fn take(&mut self, now_ns: u64) -> Option<D> {
        let times = self.due.iter().enumerate();
        let (place, &(at_ns, _)) = times.min_by_key(|&(_, &(at_ns, _))| at_ns)?;
        (at_ns <= now_ns).then(|| self.due.remove(place).1)
    }

    /// The message that waits longest.
    pub(super) fn post(&mut self) -> Option<M> {
        self.outbox.pop_front()
    }

    /// When the timer has to go off, unless it is wound for no later time anyway.
    pub(super) fn wind(&mut self, now_ns: u64) -> Option<u64> {
        let first_due = || self.due.iter().map(|&(at_ns, _)| at_ns).min();
        let at_ns = if self.outbox.is_empty() { first_due()? } else { now_ns };
        if self.wound_ns.is_some_and(|wound_ns| wound_ns <= at_ns) {
            return None;
        }
        self.wound_ns = Some(at_ns);
        Some(at_ns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_due_comes_by_time_then_in_the_order_put_in() {
        let mut agenda = Agenda::<u8, ()>::new();
        for (at_ns, duty) in [(5, 1), (3, 2), (5, 3), (9, 4)] {
            agenda.put(at_ns, duty);
        }
        assert_eq!(agenda.wind(0), Some(3));
        assert_eq!(agenda.wind(0), None, "it is wound");
        agenda.went_off(5);
        let taken: Vec<u8> = std::iter::from_fn(|| agenda.take(5)).collect();
        assert_eq!((taken, agenda.wind(5)), (vec![2, 1, 3], Some(9)));
    }

    #[test]
    fn what_is_to_be_sent_comes_at_once_and_one_by_one() {
        let mut agenda = Agenda::<u8, u8>::new();
        agenda.put(9, 0);
        assert_eq!(agenda.wind(1), Some(9));
        agenda.send(1);
        agenda.send(2);
        assert_eq!(agenda.wind(4), Some(4));
        agenda.went_off(4);
        assert_eq!((agenda.post(), agenda.wind(4)), (Some(1), Some(4)));
        agenda.went_off(4);
        assert_eq!((agenda.post(), agenda.wind(4)), (Some(2), Some(9)));
        agenda.went_off(9);
        agenda.clear();
        assert_eq!((agenda.take(9), agenda.post(), agenda.wind(9)), (None, None, None));
    }
}
