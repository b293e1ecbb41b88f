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
