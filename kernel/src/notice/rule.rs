//! The rule of a broadcast: which scheme, which named conditions, and the two constants of equation (2). What the
//! schemes other than k-FNF do is their papers' (Ni, Tseng, Chen and Sheu, MobiCom 1999; Peng and Lu, MobiHoc 2000), as
//! [Jiang 2011] tells it.

use core::num::NonZeroU32;

use crate::conditions;

conditions! {
    /// One condition of the rule, by the sentence it stands for.
    pub enum Condition of Rule in u16 {
        /// From forwarding on, a node's parent and hop count stay what they are. Without it, a NOTICE with a hop count
        /// up to the node's own makes its sender the parent.
        FrozenOnceForwarded,
        /// The parent is a sender with the least hop count. Without it, the last heard, whatever its hop count.
        LeastHops,
        /// Of several senders with the least hop count the parent is the first heard. Without it, the last.
        FirstHeard,
        /// A node that has forwarded an event takes no later NOTICE of it as a first one.
        RememberEvent,
        /// Repair: a NOTICE of a newer event of the same source is a first one. Without it, whoever has heard of one
        /// event of a source is deaf to the next.
        NumberedEvents,
    }
}

impl Conditions {
    /// The conditions of the paper.
    pub const PUBLISHED: Self = Self::REPAIRED.without(Condition::NumberedEvents);

    /// All conditions.
    pub const REPAIRED: Self = Self::of(&Condition::ALL);
}

/// How many NOTICEs are counted, from 1 to [`Count::MOST`]. Each is that of another sender, so that a node has to
/// remember as many.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Count(u8);

impl Count {
    /// The largest count.
    pub const MOST: u8 = 8;

    /// 1
    pub const ONE: Self = Self(1);

    /// The count of `count`, if it is one.
    pub const fn new(count: u8) -> Option<Self> {
        if 0 < count && count <= Self::MOST { Some(Self(count)) } else { None }
    }

    /// The number.
    pub const fn get(self) -> u8 {
        self.0
    }
}

/// Which nodes forward, and how long they wait before.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Scheme {
    /// k-FNF: who has heard `k` other senders besides the first before its wait is over does not forward. The wait is
    /// equation (2): the farther the first sender, the shorter. `None` is k = ∞.
    Farthest {
        /// k
        k: Option<Count>,
    },
    /// Everybody forwards, after a random wait.
    Flooding,
    /// Who has heard fewer than `below` senders when its random wait is over forwards. (The paper's text inverts it.)
    Counter {
        /// C
        below: Count,
    },
    /// Who has heard no sender nearer than `least_um` when its random wait is over forwards.
    Distance {
        /// The threshold, in micrometres.
        least_um: u32,
    },
    /// Scalable broadcast: who has a neighbour that no sender heard so far reaches when its random wait is over
    /// forwards. Neighbours are known from hellos, see [`Surroundings`](super::Surroundings).
    Scalable,
}

/// The rule of a broadcast.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    /// Who forwards.
    pub scheme: Scheme,
    /// The conditions in force.
    pub conditions: Conditions,
    /// L: the radio range, in micrometres.
    pub range_um: NonZeroU32,
    /// B: the longest wait, in nanoseconds.
    pub longest_wait_ns: u32,
}

impl Rule {
    /// `scheme`, repaired.
    pub const fn new(scheme: Scheme, range_um: NonZeroU32, longest_wait_ns: u32) -> Self {
        Self { scheme, conditions: Conditions::REPAIRED, range_um, longest_wait_ns }
    }

    /// Equation (2), in nanoseconds: ((L − D) / L)·B, rounded down. D is at most L: who hears a sender from beyond its
    /// range takes it to be at the rim.
    pub const fn backoff_ns(&self, distance_um: u32) -> u64 {
        let range = self.range_um.get() as u64;
        let inside = range.saturating_sub(distance_um as u64);
        // At most (2³² − 1)².
        inside * self.longest_wait_ns as u64 / range
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_backoff_falls_from_b_to_nothing_with_the_distance() {
        let range = NonZeroU32::new(25_000_000).expect("a range");
        let rule = Rule::new(Scheme::Flooding, range, 100_000_000);
        let waits =
            [0, 5_000_000, 24_999_999, 25_000_000, u32::MAX].map(|distance| rule.backoff_ns(distance));
        assert_eq!(waits, [100_000_000, 80_000_000, 4, 0, 0]);
        let widest = Rule::new(Scheme::Flooding, NonZeroU32::MAX, u32::MAX);
        assert_eq!(widest.backoff_ns(0), u64::from(u32::MAX));
    }

    #[test]
    fn counts_are_1_to_8() {
        let counts = [0, 1, 8, 9].map(|count| Count::new(count).map(Count::get));
        assert_eq!(counts, [None, Some(1), Some(8), None]);
    }

    #[test]
    fn conditions_are_taken_out_one_by_one() {
        for condition in Condition::ALL {
            let others = Conditions::REPAIRED.without(condition);
            assert!(Condition::ALL.iter().all(|&other| others.has(other) == (other != condition)));
        }
        assert!(!Conditions::PUBLISHED.has(Condition::NumberedEvents));
    }
}
