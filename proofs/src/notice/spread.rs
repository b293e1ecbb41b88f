//! How an event spreads, under every order in which NOTICEs arrive and waits end (NOTICE-1 to NOTICE-6). Time is left
//! out: whatever is under way may arrive next, once or again, whoever waits may be next to forward, and what never
//! arrives is lost. So node numbers play no part either, and one network of each shape is enough.

use core::num::NonZeroU32;

use tautline_kernel::net::{Call, Epoch, NodeId, Notice, Reception};
use tautline_kernel::notice::{Count, Node, Reaction, Rule, Stage, Surroundings};

use crate::engine::{Stop, Tape, require};

/// The senders or packets that k counts where a packet comes twice.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum CountOf {
    /// The senders that a node hears besides the first.
    Senders,
    /// The packets after the first one.
    Packets,
}

/// A network: for each node a bit for each neighbour. The source is node 0.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Links<const NODES: usize>(pub(super) [u64; NODES]);

impl<const NODES: usize> Links<NODES> {
    pub(super) const NONE: Self = Self([0; NODES]);

    pub(super) fn add(&mut self, one: usize, other: usize) {
        self.0[one] |= 1 << other;
        self.0[other] |= 1 << one;
    }

    /// The nodes that links connect to the source, a bit for each.
    pub(super) fn component(&self) -> u64 {
        let mut found = 1;
        loop {
            let further = ones(found).fold(found, |found, node| found | self.0[node]);
            if further == found {
                return found;
            }
            found = further;
        }
    }
}

/// The places of the ones, ascending.
pub(super) fn ones(bits: u64) -> impl Iterator<Item = usize> {
    (0..64).filter(move |place| bits >> place & 1 == 1)
}

/// The next event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Event {
    /// A NOTICE arrives.
    Arrives {
        /// The node that has sent it.
        from: usize,
        /// The node that hears it.
        to: usize,
    },
    /// A NOTICE arrives, and another copy of it is still under way.
    ArrivesAgain {
        /// The node that has sent it.
        from: usize,
        /// The node that hears it.
        to: usize,
    },
    /// A wait ends.
    Expires {
        /// The node that waited.
        at: usize,
    },
}

/// An event on its way through a network.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Spread<const NODES: usize> {
    counted: CountOf,
    /// The nodes.
    pub nodes: [Node; NODES],
    /// The hop count of each node's last NOTICE.
    pub(super) sent: [u16; NODES],
    /// For each node a bit for each to whom its NOTICE is under way.
    pub under_way: [u64; NODES],
    /// How often each node has forwarded; more than twice is twice.
    pub(super) forwards: [u8; NODES],
    /// An observer's note of each node: of those it has heard before it forwarded or fell silent, the first with the
    /// least hop count, and that hop count.
    pub(super) nearest: [Option<(usize, u16)>; NODES],
}

/// Any distance will do.
pub(super) const RANGE: NonZeroU32 = NonZeroU32::MIN;

pub(super) const fn call(event: u32) -> Call {
    Call { wfr: NodeId(0), epoch: Epoch(event) }
}

/// A NOTICE of the first event.
pub(super) const fn notice(sender: usize) -> Notice {
    Notice { call: call(1), sender: NodeId(sender as u32), hops: 0 }
}

/// All waits are over as soon as they begin.
pub(super) fn hear(node: &mut Node, rule: &Rule, notice: Notice) -> Reaction {
    let heard = Reception { message: notice, distance_um: RANGE.get(), now_ns: 0 };
    node.receive(rule, heard, Surroundings::none, &mut Tape(&[]))
}

impl<const NODES: usize> Spread<NODES> {
    /// The source has sent.
    pub(super) fn start(links: &Links<NODES>, counted: CountOf) -> Self {
        let mut spread = Self {
            counted,
            nodes: core::array::from_fn(|id| Node::new(NodeId(id as u32), NodeId(0))),
            sent: [0; NODES],
            under_way: [0; NODES],
            forwards: [0; NODES],
            nearest: [None; NODES],
        };
        spread.nodes[0].originate();
        spread.under_way[0] = links.0[0];
        spread
    }

    pub(super) fn events(&self) -> Vec<Event> {
        let mut events = Vec::new();
        for from in 0..NODES {
            for to in ones(self.under_way[from]) {
                events.extend([Event::Arrives { from, to }, Event::ArrivesAgain { from, to }]);
            }
        }
        let waits = |&at: &usize| matches!(self.nodes[at].stage(), Stage::Waiting { .. });
        events.extend((0..NODES).filter(waits).map(|at| Event::Expires { at }));
        events
    }

    pub(super) fn hears(&self, rule: &Rule, from: usize, to: usize) -> Node {
        let mut node = self.nodes[to];
        hear(&mut node, rule, Notice { hops: self.sent[from], ..notice(from) });
        let comes_again = node == self.nodes[to] && matches!(node.stage(), Stage::Waiting { .. });
        if comes_again && self.counted == CountOf::Packets {
            // A copy counts as a sender that nobody has heard, and that is nobody's parent: the source is nearer.
            (1..=Count::MOST).map(usize::from).find(|copy| {
                let copy = Notice { hops: u16::MAX - 1, ..notice(from + copy * NODES) };
                hear(&mut node, rule, copy) != Reaction::Ignored
            });
        }
        node
    }

    /// The state after `event`, without what no longer plays a part.
    pub(super) fn after(self, rule: &Rule, links: &Links<NODES>, event: Event) -> Self {
        let mut next = self.happens(rule, links, event);
        next.drop_idle(rule);
        next
    }

    pub(super) fn happens(mut self, rule: &Rule, links: &Links<NODES>, event: Event) -> Self {
        match event {
            Event::Arrives { from, to } => {
                self.arrives(rule, from, to);
                self.under_way[from] &= !(1 << to);
            }
            Event::ArrivesAgain { from, to } => self.arrives(rule, from, to),
            Event::Expires { at } => {
                let forwarded = self.nodes[at].expire(0);
                self.sent[at] = forwarded.map_or(0, |notice| notice.hops);
                self.under_way[at] = links.0[at];
                self.forwards[at] = 2.min(self.forwards[at] + 1);
            }
        }
        self
    }

    pub(super) fn arrives(&mut self, rule: &Rule, from: usize, to: usize) {
        let hops = self.sent[from];
        match self.nodes[to].stage() {
            Stage::Unaware | Stage::Waiting { .. } => {
                let heard = self.nearest[to].into_iter().chain([(from, hops)]);
                self.nearest[to] = heard.min_by_key(|&(_, hops)| hops);
            }
            Stage::Silent | Stage::Forwarded => {}
        }
        self.nodes[to] = self.hears(rule, from, to);
    }

    /// Leaves out what is under way to a node that is done and does not change by it, which then never will.
    fn drop_idle(&mut self, rule: &Rule) {
        for from in 0..NODES {
            for to in ones(self.under_way[from]) {
                let is_done = matches!(self.nodes[to].stage(), Stage::Silent | Stage::Forwarded);
                if is_done && self.hears(rule, from, to) == self.nodes[to] {
                    self.under_way[from] &= !(1 << to);
                }
            }
        }
    }

    /// Requires that the parent of every node that knows of the event, and its hop count, are as the observer expects.
    fn require_nearest_parents(&self) -> Result<(), Stop> {
        for (node, &nearest) in self.nodes.iter().zip(&self.nearest).skip(1) {
            let parent = nearest.map(|(sender, _)| NodeId(sender as u32));
            require(
                node.parent() == parent,
                "the parent is the first heard of those with the least hop count",
            )?;
            let hops = nearest.map(|(_, hops)| hops + 1);
            require(node.hops() == hops, "a node is one hop farther from the source than its parent")?;
        }
        Ok(())
    }

    /// Requires that parent by parent every node that knows of the event comes to the source, each one hop farther than
    /// the next.
    fn require_tree(&self) -> Result<(), Stop> {
        for node in self.nodes.iter().filter(|node| node.event().is_some()) {
            let mut ancestor = node;
            for _ in 0..NODES {
                if let Some(parent) = ancestor.parent().and_then(|parent| self.nodes.get(parent.0 as usize)) {
                    ancestor = parent;
                }
            }
            require(ancestor == &self.nodes[0], "parent by parent every node comes to the source")?;
            if let Some(parent) = node.parent().and_then(|parent| self.nodes.get(parent.0 as usize)) {
                let farther = parent.hops().map(|hops| hops + 1);
                require(node.hops() == farther, "a node is one hop farther from the source than its parent")?;
                require(
                    parent.stage() == Stage::Forwarded,
                    "a parent is the source or a node that has forwarded",
                )?;
            }
        }
        Ok(())
    }
}

/// Where in a run a state is looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Point {
    OnTheWay,
    /// Nothing is under way and nobody waits.
    End,
}

/// A demand on every state.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Demand {
    /// NOTICE-1
    Tree,
    /// NOTICE-2
    Once,
    /// NOTICE-3
    Floods,
    /// NOTICE-5
    Reaches,
    /// NOTICE-6
    NearestParent,
}

impl Demand {
    /// Every demand.
    pub(super) const ALL: [Self; 5] =
        [Self::Tree, Self::Once, Self::Floods, Self::Reaches, Self::NearestParent];

    /// This one, as a list.
    pub(super) const fn alone(self) -> &'static [Self] {
        match self {
            Self::Tree => &[Self::Tree],
            Self::Once => &[Self::Once],
            Self::Floods => &[Self::Floods],
            Self::Reaches => &[Self::Reaches],
            Self::NearestParent => &[Self::NearestParent],
        }
    }

    /// Whether only the end of a run can break it.
    pub(super) const fn is_of_ends(self) -> bool {
        match self {
            Self::Floods | Self::Reaches => true,
            Self::Tree | Self::Once | Self::NearestParent => false,
        }
    }

    pub(super) fn check<const NODES: usize>(
        self,
        links: &Links<NODES>,
        spread: &Spread<NODES>,
        point: Point,
    ) -> Result<(), Stop> {
        let connected = || ones(links.component());
        match (self, point) {
            (Self::Tree, _) => spread.require_tree(),
            (Self::NearestParent, _) => spread.require_nearest_parents(),
            (Self::Once, _) => {
                let is_once = spread.forwards.iter().all(|&forwards| forwards <= 1);
                require(is_once, "a node forwards an event at most once")
            }
            (Self::Floods | Self::Reaches, Point::OnTheWay) => Ok(()),
            (Self::Floods, Point::End) => require(
                connected().all(|node| node == 0 || spread.forwards[node] == 1),
                "everybody connected to the source receives and forwards",
            ),
            (Self::Reaches, Point::End) => require(
                connected().all(|node| spread.nodes[node].event().is_some()),
                "everybody connected to the source receives the event",
            ),
        }
    }
}
