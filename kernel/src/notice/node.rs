//! One node and the events of one source: what a NOTICE makes of it, and whether it forwards when its wait is over.
//!
//! A node ignores NOTICEs of another source or an older event, those that the source hears of its own event, its own
//! NOTICE, those of a sender heard before, and a hop count that cannot be counted on from.

use super::Surroundings;
use super::rule::{Condition, Count, Rule, Scheme};
use crate::choice::Oracle;
use crate::net::{Call, Epoch, NodeId, Notice, Reception};

/// How far a node is with an event.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Stage {
    /// It has heard of none.
    Unaware,
    /// It may still forward.
    Waiting {
        /// When its wait is over, in nanoseconds.
        until_ns: u64,
    },
    /// It does not forward.
    Silent,
    /// It has forwarded: it is a path node. So is the source.
    Forwarded,
}

/// A node's reaction to a NOTICE.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Reaction {
    /// Nothing at all.
    Ignored,
    /// The node is to be asked again, by [`Node::expire`], when its wait is over.
    Armed {
        /// The end of the wait, in nanoseconds.
        at_ns: u64,
    },
    /// It goes on waiting.
    Noted,
    /// It does not forward this event. A timer that is still armed may expire all the same.
    Silenced,
}

/// The state of one node for the events of one source.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Node {
    id: NodeId,
    source: NodeId,
    /// The latest event heard of; 0 before the first.
    event: u32,
    parent: NodeId,
    hops: u16,
    phase: Phase,
    heard: Senders,
    /// While it waits: when the wait is over, in nanoseconds. Else 0.
    until_ns: u64,
}

/// A [`Stage`] without its time: beside it a node takes one cache line.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Phase {
    Unaware,
    Waiting,
    Silent,
    Forwarded,
}

/// Senders heard, as many as are counted, ascending: the same senders are the same value in whatever order they came.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Senders {
    senders: [NodeId; HEARD],
    count: u8,
}

/// The first sender, and the others that are counted.
const HEARD: usize = Count::MOST as usize + 1;

impl Senders {
    const NOBODY: Self = Self { senders: [NodeId(0); HEARD], count: 0 };

    fn has(&self, sender: NodeId) -> bool {
        self.senders.iter().take(self.count.into()).any(|&heard| heard == sender)
    }

    /// Remembers `sender`. There is room: a node that has heard as many as there are places is silent.
    fn add(&mut self, mut sender: NodeId) {
        for place in self.senders.iter_mut().take(self.count.into()) {
            if sender < *place {
                core::mem::swap(&mut sender, place);
            }
        }
        if let Some(place) = self.senders.get_mut(usize::from(self.count)) {
            *place = sender;
            self.count += 1;
        }
    }
}

/// Whether a NOTICE is about something new to a node.
enum News {
    First,
    Again,
    None,
}

impl Node {
    /// Node `id`, which has not heard of any event of `source`.
    pub const fn new(id: NodeId, source: NodeId) -> Self {
        let (phase, heard) = (Phase::Unaware, Senders::NOBODY);
        Self { id, source, event: 0, parent: id, hops: 0, phase, heard, until_ns: 0 }
    }

    /// How far it is with the latest event.
    pub const fn stage(&self) -> Stage {
        match self.phase {
            Phase::Unaware => Stage::Unaware,
            Phase::Waiting => Stage::Waiting { until_ns: self.until_ns },
            Phase::Silent => Stage::Silent,
            Phase::Forwarded => Stage::Forwarded,
        }
    }

    /// The number of the latest event that it has heard of; `None` before the first.
    pub const fn event(&self) -> Option<Epoch> {
        if self.event == 0 { None } else { Some(Epoch(self.event)) }
    }

    /// HC: its hops to the source, once it has heard of an event.
    pub const fn hops(&self) -> Option<u16> {
        if self.event == 0 { None } else { Some(self.hops) }
    }

    /// The next node on the way to the source. The source has none, and nobody who has not heard of an event.
    pub fn parent(&self) -> Option<NodeId> {
        (self.event != 0 && self.id != self.source).then_some(self.parent)
    }

    /// The source begins its next event. `None` if the node is not the source, or has no number left.
    pub fn originate(&mut self) -> Option<Notice> {
        if self.id != self.source {
            return None;
        }
        self.event = self.event.checked_add(1)?;
        self.phase = Phase::Forwarded;
        Some(self.notice())
    }

    /// Hears a NOTICE. What is `around` is asked for if the NOTICE can matter, and matters to [`Scheme::Scalable`]
    /// alone; `chance` is asked for the wait of the schemes that wait at random.
    #[inline]
    pub fn receive<'a>(
        &mut self,
        rule: &Rule,
        heard: Reception<Notice>,
        around: impl FnOnce() -> Surroundings<'a>,
        chance: &mut dyn Oracle,
    ) -> Reaction {
        if self.is_late(rule, heard.message) {
            return Reaction::Ignored;
        }
        self.consider(rule, heard, around(), chance)
    }

    /// Whether a NOTICE comes too late to change anything, as most do that are heard in a dense network.
    #[inline]
    #[expect(
        clippy::needless_bitwise_bool,
        reason = "nothing foretells the phase of the next node that hears: a branch on it costs a fifth of a flood"
    )]
    fn is_late(&self, rule: &Rule, notice: Notice) -> bool {
        let is_frozen = rule.has(Condition::RememberEvent) && rule.has(Condition::FrozenOnceForwarded);
        let is_idle =
            !can_settle(rule.scheme) && rule.has(Condition::LeastHops) && rule.has(Condition::FirstHeard);
        let is_through = (self.phase == Phase::Silent) | (self.phase == Phase::Forwarded) & is_frozen;
        let is_no_nearer = notice.hops.saturating_add(1) >= self.hops;
        let waits_on = (self.phase == Phase::Waiting) & is_idle & is_no_nearer;
        notice.call == self.call() && (is_through | waits_on)
    }

    fn consider(
        &mut self,
        rule: &Rule,
        heard: Reception<Notice>,
        around: Surroundings<'_>,
        chance: &mut dyn Oracle,
    ) -> Reaction {
        let notice = heard.message;
        let is_foreign = notice.call.wfr != self.source
            || self.id == self.source
            || notice.sender == self.id
            || notice.hops == u16::MAX;
        if is_foreign {
            return Reaction::Ignored;
        }
        match self.news(rule, notice) {
            News::First => self.begin(rule, heard, around, chance),
            News::Again => self.hear_again(rule, heard, around),
            News::None => Reaction::Ignored,
        }
    }

    /// Its wait may be over: the NOTICE that it forwards, if it does. A timer that was armed for a wait since given up,
    /// or for an older event, comes to nothing.
    #[inline]
    pub fn expire(&mut self, now_ns: u64) -> Option<Notice> {
        if self.phase != Phase::Waiting || self.until_ns > now_ns {
            return None;
        }
        self.pass(Phase::Forwarded);
        Some(self.notice())
    }

    /// Ceases to wait.
    const fn pass(&mut self, phase: Phase) {
        self.phase = phase;
        self.until_ns = 0;
    }

    const fn call(&self) -> Call {
        Call { wfr: self.source, epoch: Epoch(self.event) }
    }

    const fn notice(&self) -> Notice {
        Notice { call: self.call(), hops: self.hops, sender: self.id }
    }

    #[inline]
    fn news(&self, rule: &Rule, notice: Notice) -> News {
        let is_newer =
            notice.call.epoch.0 > self.event && (self.event == 0 || rule.has(Condition::NumberedEvents));
        let is_older = notice.call.epoch.0 < self.event && rule.has(Condition::NumberedEvents);
        if is_newer {
            return News::First;
        }
        if is_older || notice.call.epoch.0 == 0 {
            return News::None;
        }
        match self.phase {
            Phase::Forwarded if !rule.has(Condition::RememberEvent) => News::First,
            Phase::Forwarded if !rule.has(Condition::FrozenOnceForwarded) => News::Again,
            Phase::Waiting => News::Again,
            Phase::Unaware | Phase::Silent | Phase::Forwarded => News::None,
        }
    }

    fn begin(
        &mut self,
        rule: &Rule,
        heard: Reception<Notice>,
        mut around: Surroundings<'_>,
        chance: &mut dyn Oracle,
    ) -> Reaction {
        let Reception { message: notice, distance_um, now_ns } = heard;
        self.event = notice.call.epoch.0;
        self.parent = notice.sender;
        self.hops = notice.hops.saturating_add(1);
        self.heard = Senders::NOBODY;
        self.heard.add(notice.sender);
        around.begin();
        if self.is_settled(rule, heard, around) {
            return self.be_silent();
        }
        let wait_ns = match rule.scheme {
            Scheme::Farthest { .. } => rule.backoff_ns(distance_um),
            Scheme::Flooding | Scheme::Counter { .. } | Scheme::Distance { .. } | Scheme::Scalable => {
                chance.pick(rule.longest_wait_ns.max(1)).into()
            }
        };
        let until_ns = now_ns.saturating_add(wait_ns);
        self.phase = Phase::Waiting;
        self.until_ns = until_ns;
        Reaction::Armed { at_ns: until_ns }
    }

    #[inline]
    fn hear_again(&mut self, rule: &Rule, heard: Reception<Notice>, around: Surroundings<'_>) -> Reaction {
        let notice = heard.message;
        if self.phase == Phase::Forwarded {
            if notice.hops > self.hops {
                return Reaction::Ignored;
            }
            self.parent = notice.sender;
            self.hops = notice.hops.saturating_add(1);
            return Reaction::Noted;
        }
        if self.heard.has(notice.sender) {
            return Reaction::Ignored;
        }
        let hops = notice.hops.saturating_add(1);
        let is_best = hops < self.hops || hops == self.hops && !rule.has(Condition::FirstHeard);
        if is_best || !rule.has(Condition::LeastHops) {
            (self.parent, self.hops) = (notice.sender, hops);
        }
        if is_counted(rule.scheme) {
            self.heard.add(notice.sender);
        }
        if self.is_settled(rule, heard, around) { self.be_silent() } else { Reaction::Noted }
    }

    fn be_silent(&mut self) -> Reaction {
        self.pass(Phase::Silent);
        Reaction::Silenced
    }

    /// Whether with this NOTICE the node has heard enough not to forward.
    #[inline]
    fn is_settled(&self, rule: &Rule, heard: Reception<Notice>, mut around: Surroundings<'_>) -> bool {
        match rule.scheme {
            // The first is not counted: k = 1 would else never forward.
            Scheme::Farthest { k } => k.is_some_and(|k| self.heard.count > k.get()),
            Scheme::Flooding => false,
            Scheme::Counter { below } => self.heard.count >= below.get(),
            Scheme::Distance { least_um } => heard.distance_um < least_um,
            Scheme::Scalable => {
                around.reach(heard.message.sender);
                around.all_reached()
            }
        }
    }
}

/// Whether a node that waits may hear enough not to forward.
const fn can_settle(scheme: Scheme) -> bool {
    !matches!(scheme, Scheme::Flooding | Scheme::Farthest { k: None })
}

/// Whether a scheme has to remember whom it has heard. Where it need not, hearing a sender again changes nothing.
const fn is_counted(scheme: Scheme) -> bool {
    matches!(scheme, Scheme::Farthest { k: Some(_) } | Scheme::Counter { .. })
}

#[cfg(test)]
mod tests {
    use core::num::NonZeroU32;

    use super::*;
    use crate::notice::{Conditions, words};

    const SOURCE: NodeId = NodeId(0);

    /// Waits 7 ns where it is left to chance.
    struct Seven;

    impl Oracle for Seven {
        fn pick(&mut self, below: u32) -> u32 {
            7.min(below - 1)
        }
    }

    fn rule(scheme: Scheme) -> Rule {
        Rule::new(scheme, NonZeroU32::new(1000).expect("a range"), 1000)
    }

    fn farthest(k: u8) -> Rule {
        rule(Scheme::Farthest { k: Count::new(k) })
    }

    fn notice(sender: u32, hops: u16) -> Notice {
        Notice { call: Call { wfr: SOURCE, epoch: Epoch(1) }, sender: NodeId(sender), hops }
    }

    fn hear(node: &mut Node, rule: &Rule, notice: Notice, distance_um: u32) -> Reaction {
        node.receive(
            rule,
            Reception { message: notice, distance_um, now_ns: 100 },
            Surroundings::none,
            &mut Seven,
        )
    }

    fn fresh() -> Node {
        Node::new(NodeId(9), SOURCE)
    }

    #[test]
    fn the_first_is_not_counted_and_the_kth_other_silences() {
        for k in 1..=Count::MOST {
            let (mut node, rule) = (fresh(), farthest(k));
            assert_eq!(hear(&mut node, &rule, notice(50, 0), 600), Reaction::Armed { at_ns: 500 });
            for other in 1..k {
                assert_eq!(hear(&mut node, &rule, notice(50 - u32::from(other), 1), 0), Reaction::Noted);
            }
            assert_eq!(hear(&mut node, &rule, notice(1, 1), 0), Reaction::Silenced);
            assert_eq!((node.stage(), node.expire(u64::MAX)), (Stage::Silent, None));
        }
    }

    #[test]
    fn a_node_forwards_at_the_end_of_its_wait_with_the_least_hop_count_and_the_first_heard_of_equals() {
        let (mut node, rule) = (fresh(), farthest(8));
        hear(&mut node, &rule, notice(4, 5), 0);
        hear(&mut node, &rule, notice(3, 2), 0);
        hear(&mut node, &rule, notice(2, 2), 0);
        hear(&mut node, &rule, notice(1, 4), 0);
        assert_eq!((node.parent(), node.hops()), (Some(NodeId(3)), Some(3)));
        assert_eq!(node.expire(1099), None);
        assert_eq!(node.expire(1100), Some(Notice { sender: NodeId(9), hops: 3, ..notice(0, 0) }));
        assert_eq!(node.expire(1100), None);
        assert_eq!(hear(&mut node, &rule, notice(7, 0), 0), Reaction::Ignored);
        assert_eq!((node.parent(), node.hops()), (Some(NodeId(3)), Some(3)));
    }

    #[test]
    fn what_a_protocol_must_ignore_changes_nothing() {
        let rule = farthest(1);
        let mut node = fresh();
        hear(&mut node, &rule, notice(4, 5), 0);
        let ignored = [
            Notice { call: Call { wfr: NodeId(8), epoch: Epoch(1) }, ..notice(3, 0) },
            Notice { call: Call { wfr: SOURCE, epoch: Epoch(0) }, ..notice(3, 0) },
            notice(4, 5),
            notice(9, 0),
            notice(3, u16::MAX),
        ];
        for notice in ignored {
            let before = node;
            assert_eq!((hear(&mut node, &rule, notice, 0), node), (Reaction::Ignored, before), "{notice:?}");
        }
        let mut source = Node::new(SOURCE, SOURCE);
        assert_eq!(source.originate(), Some(notice(0, 0)));
        assert_eq!(hear(&mut source, &rule, notice(4, 1), 0), Reaction::Ignored);
        assert_eq!((source.parent(), source.hops(), fresh().originate()), (None, Some(0), None));
    }

    #[test]
    fn a_newer_event_is_a_first_one_and_an_older_one_is_ignored() {
        let rule = farthest(1);
        let second = Notice { call: Call { wfr: SOURCE, epoch: Epoch(2) }, ..notice(5, 1) };
        let mut node = fresh();
        hear(&mut node, &rule, notice(4, 0), 0);
        node.expire(u64::MAX);
        assert_eq!(hear(&mut node, &rule, second, 1000), Reaction::Armed { at_ns: 100 });
        assert_eq!((node.parent(), node.event()), (Some(NodeId(5)), Some(Epoch(2))));
        assert_eq!(hear(&mut node, &rule, notice(3, 0), 0), Reaction::Ignored);
        let published = Rule { conditions: Conditions::PUBLISHED, ..rule };
        let mut deaf = fresh();
        hear(&mut deaf, &published, notice(4, 0), 0);
        deaf.expire(u64::MAX);
        assert_eq!(hear(&mut deaf, &published, second, 0), Reaction::Ignored);
    }

    #[test]
    fn a_source_has_as_many_events_as_numbers() {
        let mut source = Node::new(SOURCE, SOURCE);
        source.event = u32::MAX - 1;
        assert_eq!(source.originate().map(|notice| notice.call.epoch.0), Some(u32::MAX));
        assert_eq!(source.originate(), None);
    }

    #[test]
    fn who_has_heard_c_senders_is_silent() {
        let rule = rule(Scheme::Counter { below: Count::new(3).expect("a count") });
        let mut node = fresh();
        assert_eq!(hear(&mut node, &rule, notice(4, 0), 0), Reaction::Armed { at_ns: 107 });
        assert_eq!(hear(&mut node, &rule, notice(4, 0), 0), Reaction::Ignored);
        assert_eq!(hear(&mut node, &rule, notice(5, 0), 0), Reaction::Noted);
        assert_eq!(hear(&mut node, &rule, notice(6, 0), 0), Reaction::Silenced);
    }

    #[test]
    fn who_has_heard_a_near_sender_is_silent() {
        let rule = rule(Scheme::Distance { least_um: 500 });
        let mut node = fresh();
        assert_eq!(hear(&mut node, &rule, notice(4, 0), 500), Reaction::Armed { at_ns: 107 });
        assert_eq!(hear(&mut node, &rule, notice(5, 0), 499), Reaction::Silenced);
        assert_eq!(hear(&mut fresh(), &rule, notice(5, 0), 499), Reaction::Silenced);
    }

    #[test]
    fn who_has_no_neighbour_left_to_reach_is_silent() {
        let rule = rule(Scheme::Scalable);
        let mut node = fresh();
        let own = [NodeId(1), NodeId(2), NodeId(3)];
        let mut unreached = [0; words(3)];
        let mut hear = |sender, of_sender: &[NodeId]| {
            let around = Surroundings { neighbours: &own, of_sender, unreached: &mut unreached };
            let reception = Reception { message: notice(sender, 0), distance_um: 0, now_ns: 0 };
            node.receive(&rule, reception, || around, &mut Seven)
        };
        assert_eq!(hear(1, &[NodeId(2), NodeId(9)]), Reaction::Armed { at_ns: 7 });
        assert_eq!(hear(2, &[NodeId(1), NodeId(9)]), Reaction::Noted);
        assert_eq!(hear(3, &[NodeId(9)]), Reaction::Silenced);
    }
}
