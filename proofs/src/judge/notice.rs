//! The judge of NOTICE: how an event spreads by k-FNF (NOTICE-5), and what a node makes of a newer event as published
//! ([`Later`]: NOTICE-4). It knows the sentences of `SPEC.md` alone.

use std::collections::BTreeSet;

use super::change::{Change, Plain, plain};
use super::{Case, Objection, must};

/// An event that spreads through a network from the node 0.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Spread {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// A node that hears so many other senders before it forwards is silent.
    pub k: usize,
    /// The network.
    pub network: Network,
    /// The events, in order.
    pub steps: Vec<Step>,
}

/// Nodes, and the links between them, the node with the lesser number first.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Network {
    /// How many nodes there are.
    pub nodes: usize,
    /// The links.
    pub links: BTreeSet<(usize, usize)>,
}

/// An event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Step {
    /// The node that hears or forwards.
    pub node: usize,
    /// Whose NOTICE it hears; none if it forwards.
    pub from: Option<usize>,
    /// Whether the NOTICE will come once more.
    pub comes_again: bool,
}

plain!(Spread { k, network, steps });
plain!(Step { node, from, comes_again });

impl Plain for Network {
    fn change(&mut self, change: &mut Change) {
        let nodes = self.nodes;
        let all: Vec<_> =
            (0..nodes).flat_map(|one| (one + 1..nodes).map(move |other| (one, other))).collect();
        change.toggles("link", &mut self.links, &all);
        change.within("nodes", &mut self.nodes);
    }
}

/// How far a node is with the event.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Stage {
    Unaware,
    /// It has heard these.
    Waits(BTreeSet<usize>),
    /// It is silent, or has forwarded.
    Through,
}

impl Case for Spread {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Network { nodes, links } = &self.network;
        must(self.clause == "NOTICE-5" && self.k >= 1, "the judge does not know this")?;
        must((1..=64).contains(nodes), "a network has 1 to 64 nodes")?;
        must(links.iter().all(|(one, other)| one < other && other < nodes), "a link leads nowhere")?;
        let beside = |node: usize| {
            let ends = links.iter().filter_map(move |&(one, other)| match node {
                _ if node == one => Some(other),
                _ if node == other => Some(one),
                _ => None,
            });
            ends.collect::<Vec<_>>()
        };
        let mut stages = vec![Stage::Unaware; *nodes];
        stages[0] = Stage::Through;
        let mut under_way: BTreeSet<(usize, usize)> = beside(0).into_iter().map(|to| (0, to)).collect();
        for (number, step) in (1..).zip(&self.steps) {
            let object = |what| Objection { at: number, what };
            let Step { node, from, comes_again } = *step;
            must(node < *nodes, "there is no such node").map_err(object)?;
            match (from, stages[node].clone()) {
                (None, Stage::Waits(_)) => {
                    must(!comes_again, "no NOTICE comes here").map_err(object)?;
                    stages[node] = Stage::Through;
                    under_way.extend(beside(node).into_iter().map(|to| (node, to)));
                }
                (Some(from), Stage::Unaware | Stage::Waits(_)) => {
                    must(under_way.contains(&(from, node)), "no such NOTICE is under way").map_err(object)?;
                    if !comes_again {
                        under_way.remove(&(from, node));
                    }
                    let heard =
                        if let Stage::Waits(heard) = &stages[node] { heard.clone() } else { BTreeSet::new() };
                    let heard: BTreeSet<usize> = heard.into_iter().chain([from]).collect();
                    // The first sender is not counted.
                    stages[node] = if heard.len() > self.k { Stage::Through } else { Stage::Waits(heard) };
                }
                (None, _) => return Err(object("a node forwards that does not wait")),
                // What a node hears that is through with the event changes nothing, and is not told.
                (Some(_), Stage::Through) => {
                    return Err(object("a node hears that is through with the event"));
                }
            }
        }
        let comes = under_way.iter().any(|&(_, to)| stages[to] != Stage::Through);
        let waits = stages.iter().any(|stage| matches!(stage, Stage::Waits(_)));
        must(!comes && !waits, "something more happens")?;
        let (mut reached, mut rim) = (BTreeSet::new(), vec![0]);
        while let Some(node) = rim.pop() {
            if reached.insert(node) {
                rim.extend(beside(node));
            }
        }
        let is_left = reached.iter().any(|&node| stages[node] == Stage::Unaware);
        Ok(must(is_left, "every node that links connect to the source has heard of the event")?)
    }
}

/// A node that has heard of an event of a source, and hears of a newer one, as published: a NOTICE does not name the
/// event.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Later {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The NOTICEs that it has heard before, in order.
    pub before: Vec<NoticeMessage>,
    /// The NOTICE of the newer event.
    pub news: NoticeMessage,
    /// Whether it takes that for a first one: it begins to wait, and the sender is its parent.
    pub is_first: bool,
}

/// A NOTICE of the source 0 that the node 1 hears.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct NoticeMessage {
    /// The number of the event.
    pub event: i32,
    /// The node that has sent it.
    pub sender: i32,
    /// Its hop count.
    pub hops: i32,
}

plain!(Later { before, news, is_first });
plain!(NoticeMessage { event, sender, hops });

impl Case for Later {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        must(self.clause == "NOTICE-4", "the judge does not know this clause")?;
        let is_notice = |heard: &NoticeMessage| {
            heard.event >= 1 && heard.hops >= 0 && heard.sender >= 0 && heard.sender != 1
        };
        must(self.before.iter().chain([&self.news]).all(is_notice), "that is no NOTICE that a node hears")?;
        let is_newer = self.before.iter().all(|heard| heard.event < self.news.event);
        must(is_newer, "the last NOTICE is of no newer event")?;
        // As published the first NOTICE of a source is the first of all its events.
        must(self.is_first == self.before.is_empty(), "the node takes it otherwise")?;
        Ok(must(!self.is_first, "the node takes the NOTICE for a first one")?)
    }
}
