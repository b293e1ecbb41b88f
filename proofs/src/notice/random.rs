//! Larger networks, at random, and the events after the first one.

use core::ops::RangeInclusive;

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{NodeId, Notice};
use tautline_kernel::notice::{Count, Node, Reaction, Rule};

use super::Subject;
use super::shapes::SMALL;
use super::spread::{Demand, Links, Point, Spread, call, hear, notice};
use crate::engine::{Choices, Outcome, Replay, require};
use crate::judge::AnyCase;
use crate::judge::notice::{Later, NoticeMessage};

/// The largest of the random networks.
const LARGE: usize = 40;

/// Nodes of a random network.
const NODES: RangeInclusive<usize> = SMALL + 1..=LARGE;

/// Links of a random network, in percent of all pairs of nodes.
const LINKS: RangeInclusive<u32> = 5..=44;

/// The networks that [`spread_at_random`] draws, in words.
pub(super) fn random_networks() -> String {
    format!("{}, k = 1 … {} or ∞", random_nodes(), Count::MOST)
}

/// Those that it draws for flooding, in words.
pub(super) fn random_floods() -> String {
    format!("{}, k = ∞", random_nodes())
}

fn random_nodes() -> String {
    let (nodes, links) = (NODES, LINKS);
    let (fewest, most, thin, dense) = (nodes.start(), nodes.end(), links.start(), links.end());
    format!("random networks of {fewest} to {most} nodes with {thin} to {dense} % links")
}

/// Events after which nothing more is left to chance, so that copies do not go on arriving for ever.
const MOST_EVENTS: usize = 4_000;

/// NOTICE-1 to NOTICE-3 and NOTICE-6: a random network, a random order and some
/// k, the demand checked after every event.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn spread_at_random(observed: &Subject, oracle: &mut dyn Oracle, demand: Demand) -> Outcome {
    // k = ∞ is one of them, and for flooding the only one.
    let k = if demand == Demand::Floods { 0 } else { oracle.pick(u32::from(Count::MOST) + 1) };
    let rule = observed.farthest(Count::new(k as u8));
    let nodes = NODES.end() - oracle.pick(NODES.count() as u32) as usize;
    let links_percent = LINKS.start() + oracle.pick(LINKS.count() as u32);
    let mut links = Links::<LARGE>::NONE;
    for one in 0..nodes {
        for other in one + 1..nodes {
            if oracle.pick(100) < links_percent {
                links.add(one, other);
            }
        }
    }
    let mut spread = Spread::start(&links, observed.counted);
    for happened in 0.. {
        let events = spread.events();
        let choice = if happened < MOST_EVENTS { oracle.pick(events.len().max(1) as u32) } else { 0 };
        let Some(&event) = events.get(choice as usize) else { break };
        spread = spread.after(&rule, &links, event);
        demand.check(&links, &spread, Point::OnTheWay)?;
    }
    demand.check(&links, &spread, Point::End)?;
    let forwarded = spread.forwards.iter().filter(|&&forwards| forwards > 0).count();
    Ok(if forwarded * 2 > nodes { "most nodes forward" } else { "few nodes forward" })
}

/// The situations that the random runs cover.
pub(super) const SPREADS: [&str; 2] = ["few nodes forward", "most nodes forward"];

/// The fates of the event before.
const FATES: [&str; 4] =
    ["unaware of the first", "waiting with the first", "silent about the first", "through with the first"];

/// Later events, their senders and their hop counts.
const LATER: [u32; 3] = [2, 3, 3];

/// The greatest k.
const MOST_COUNTED: u32 = 3;

/// The bound of [`second_event`], in words.
pub(super) fn later_events() -> String {
    let [events, senders, hops] = LATER;
    format!(
        "{} fates of an event, {events} later ones by {senders} senders with {hops} hop counts, k = 1 … {MOST_COUNTED}",
        FATES.len()
    )
}

/// NOTICE-4: whatever a node has made of one event, the next one is new to it, and k other senders of that silence it.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn second_event(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let (k, fate, news) = drawn(oracle);
    let (mut node, reaction) = heard(observed, k, fate, news);
    require(reaction == Reaction::Armed { at_ns: 0 }, "the first NOTICE of a newer event begins a wait")?;
    require(node.parent() == Some(news.sender), "its sender is the parent")?;
    require(node.hops() == Some(news.hops + 1), "the node is one hop farther than its sender")?;
    for other in 1..=k {
        let sender = NodeId(news.sender.0 + u32::from(other));
        let reaction = hear(&mut node, &rule(observed, k), Notice { sender, ..news });
        let due = if other < k { Reaction::Noted } else { Reaction::Silenced };
        require(reaction == due, "it is silent when k other senders are heard, and not before")?;
    }
    Ok(FATES[fate])
}

/// k, the fate of the first event, and a NOTICE of a later one.
fn drawn(oracle: &mut dyn Oracle) -> (u8, usize, Notice) {
    let k = 1 + oracle.pick(MOST_COUNTED) as u8;
    let fate = oracle.pick(FATES.len() as u32) as usize;
    let [events, senders, most_hops] = LATER;
    let (event, sender) = (2 + oracle.pick(events), 2 + oracle.pick(senders));
    let hops = oracle.pick(most_hops) as u16;
    (k, fate, Notice { call: call(event), hops, ..notice(sender as usize) })
}

fn rule(observed: &Subject, k: u8) -> Rule {
    observed.farthest(Count::new(k))
}

/// The NOTICEs of the first event that a node has heard with this fate: k leave it waiting, and one more silences it.
fn before(k: u8, fate: usize) -> impl Iterator<Item = Notice> {
    let heard = [0, k, k + 1, k][fate];
    (2..2 + usize::from(heard)).map(notice)
}

/// A node with this fate that hears a NOTICE of a later event, and what it makes of that.
fn heard(observed: &Subject, k: u8, fate: usize, news: Notice) -> (Node, Reaction) {
    let rule = rule(observed, k);
    let mut node = Node::new(NodeId(1), NodeId(0));
    for notice in before(k, fate) {
        hear(&mut node, &rule, notice);
    }
    if FATES[fate] == "through with the first" {
        node.expire(0);
    }
    let reaction = hear(&mut node, &rule, news);
    (node, reaction)
}

/// The case that these choices of [`second_event`] make, written down for the judge.
pub(super) fn later(observed: &Subject, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let answers: Vec<u32> = choices.all().collect();
    let mut replay = Replay::new(&answers);
    let (k, fate, news) = drawn(&mut replay);
    let (node, reaction) = heard(observed, k, fate, news);
    let written = |notice: Notice| {
        let [event, sender] = [notice.call.epoch.0, notice.sender.0].map(|number| number as i32);
        NoticeMessage { event, sender, hops: notice.hops.into() }
    };
    let begins = matches!(reaction, Reaction::Armed { .. });
    let is_first = begins && node.parent() == Some(news.sender);
    let before = before(k, fate).map(written).collect();
    let later = Later { clause: "NOTICE-4", before, news: written(news), is_first };
    replay.matches().then(|| Box::new(later) as Box<dyn AnyCase>)
}

#[cfg(test)]
mod tests {
    use core::num::NonZeroU32;

    use tautline_kernel::net::Reception;
    use tautline_kernel::notice::{Scheme, Stage, Surroundings};

    use super::*;
    use crate::engine::Tape;

    /// “k-FNF has the lowest reachability and the smallest number of rebroadcasts for the case of k = 1” (3.2): not in
    /// this network, with the paper's waits and without a loss. The source is the first node.
    #[test]
    fn with_k_1_a_broadcast_may_reach_more_nodes_and_take_more_rebroadcasts_than_with_k_2() {
        let range_um = NonZeroU32::new(100_000).expect("a range");
        let places_mm: [[u32; 2]; 6] = [[169, 142], [88, 74], [50, 142], [137, 94], [147, 88], [38, 39]];
        let distance_um = |one: [u32; 2], other: [u32; 2]| {
            let [x, y] = [0, 1].map(|axis| 1000 * u64::from(one[axis].abs_diff(other[axis])));
            (x * x + y * y).isqrt() as u32
        };
        let reached_and_rebroadcasts = |k: u8| {
            let rule = Rule::new(Scheme::Farthest { k: Count::new(k) }, range_um, 1_000_000_000);
            let mut nodes: [Node; 6] = core::array::from_fn(|id| Node::new(NodeId(id as u32), NodeId(0)));
            let mut sent = nodes[0].originate().map(|notice| (0, 0, notice));
            while let Some((now_ns, from, message)) = sent {
                for (to, node) in nodes.iter_mut().enumerate() {
                    let distance_um = distance_um(places_mm[from], places_mm[to]);
                    if to != from && distance_um <= range_um.get() {
                        let heard = Reception { message, distance_um, now_ns };
                        node.receive(&rule, heard, Surroundings::none, &mut Tape(&[]));
                    }
                }
                let waits = |(id, node): (usize, &Node)| match node.stage() {
                    Stage::Waiting { until_ns } => Some((until_ns, id)),
                    Stage::Unaware | Stage::Silent | Stage::Forwarded => None,
                };
                sent = nodes.iter().enumerate().filter_map(waits).min().and_then(|(until_ns, id)| {
                    nodes[id].expire(until_ns).map(|notice| (until_ns, id, notice))
                });
            }
            let forwarded = nodes.iter().filter(|node| node.stage() == Stage::Forwarded).count();
            (nodes.iter().filter(|node| node.event().is_some()).count(), forwarded - 1)
        };
        assert_eq!([1, 2].map(reached_and_rebroadcasts), [(6, 4), (5, 3)]);
    }
}
