//! A broadcast over a small network: the links, the scheme, and what happens next are in the bytes. Time is left out:
//! whatever is under way may arrive next, once or again or never, and any wait may be over next.

use std::num::NonZeroU32;

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::net::{NodeId, Notice, Reception};
use tautline_kernel::notice::{
    Condition, Conditions, Count, Node, Reaction, Rule, Scheme, Stage, Surroundings, words,
};
use tautline_proofs::engine::Tape;

use super::parts::numbers;

/// The most nodes.
const NODES: u32 = 12;

/// The most events of the source, node 0.
const EVENTS: u32 = 3;

const RANGE_UM: NonZeroU32 = NonZeroU32::new(25_000_000).unwrap();

/// A NOTICE on its way.
#[derive(Clone, Copy)]
struct Letter {
    notice: Notice,
    to: usize,
    distance_um: u32,
}

/// An observer's note of a node and its latest event.
#[derive(Clone, Copy, Default)]
struct Note {
    event: u32,
    /// Of the senders heard before the node forwarded or fell silent the first with the least hop count, and that.
    nearest: Option<(NodeId, u16)>,
    forwards: u32,
}

/// Nodes and what is under way between them.
struct Spread {
    rule: Rule,
    /// For each node its neighbours, ascending, and how far off each is.
    links: Vec<Vec<(NodeId, u32)>>,
    nodes: Vec<Node>,
    unreached: Vec<Vec<u64>>,
    noted: Vec<Note>,
    under_way: Vec<Letter>,
    /// Whether something was lost, or came twice.
    is_disturbed: bool,
}

/// Up to three events of one source in any order of arrivals, with any loss and repetition: the parents form a tree
/// (NOTICE-1), a node forwards an event once (NOTICE-2), and its parent is the nearest it has heard, the first of
/// several (NOTICE-6). Where everything arrives and everybody forwards, all connected nodes hear the last event
/// (NOTICE-3).
pub fn network(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut bytes = Tape(&numbers);
    let mut spread = Spread::new(&mut bytes);
    // As published, a node is deaf to a second event of a source (NOTICE-4).
    let is_numbered = spread.rule.has(Condition::NumberedEvents);
    let mut events = if is_numbered { 1 + bytes.pick(EVENTS) } else { 1 };
    loop {
        let waiting: Vec<usize> =
            (0..spread.nodes.len()).filter(|&node| spread.wait(node).is_some()).collect();
        let letters = spread.under_way.len();
        let can_begin = usize::from(events > 0);
        let choices = letters + waiting.len() + can_begin;
        if choices == 0 {
            break;
        }
        let next = bytes.pick(choices as u32) as usize;
        if next < letters {
            // What arrives is the plain case; one in eight is lost, another arrives again later.
            let fate = bytes.pick(8);
            let letter = if fate == 7 { spread.under_way[next] } else { spread.under_way.swap_remove(next) };
            spread.is_disturbed |= fate == 6;
            if fate != 6 {
                spread.arrives(letter, &mut bytes);
            }
        } else if next < letters + waiting.len() {
            spread.expires(waiting[next - letters]);
        } else {
            events -= 1;
            spread.begins();
        }
        spread.check();
    }
    spread.check_end();
}

impl Spread {
    fn new(bytes: &mut Tape<'_>) -> Self {
        let scheme = match bytes.pick(5) {
            0 => Scheme::Farthest { k: Count::new(bytes.pick(5) as u8) },
            1 => Scheme::Flooding,
            2 => Scheme::Counter { below: Count::new(1 + bytes.pick(4) as u8).unwrap_or(Count::ONE) },
            3 => Scheme::Distance { least_um: bytes.pick(256) * 100_000 },
            _ => Scheme::Scalable,
        };
        let conditions = one_of(bytes, &[Conditions::REPAIRED, Conditions::PUBLISHED]);
        let rule = Rule { conditions, ..Rule::new(scheme, RANGE_UM, 100_000_000) };
        let count = 1 + bytes.pick(NODES) as usize;
        let mut links = vec![Vec::new(); count];
        for one in 0..count {
            for other in one + 1..count {
                // The plain case is a link.
                let distance = bytes.pick(256);
                if distance < 160 {
                    links[one].push((NodeId(other as u32), distance * 100_000));
                    links[other].push((NodeId(one as u32), distance * 100_000));
                }
            }
        }
        let nodes = (0..count as u32).map(|id| Node::new(NodeId(id), NodeId(0))).collect();
        let unreached = links.iter().map(|near| vec![0; words(near.len())]).collect();
        let (noted, under_way) = (vec![Note::default(); count], Vec::new());
        Self { rule, links, nodes, unreached, noted, under_way, is_disturbed: false }
    }

    /// When the wait of a node ends, if it waits.
    fn wait(&self, node: usize) -> Option<u64> {
        match self.nodes[node].stage() {
            Stage::Waiting { until_ns } => Some(until_ns),
            Stage::Unaware | Stage::Silent | Stage::Forwarded => None,
        }
    }

    /// The source begins its next event.
    fn begins(&mut self) {
        let notice = self.nodes[0].originate().expect("the source has numbers left");
        self.send(0, notice);
    }

    fn send(&mut self, from: usize, notice: Notice) {
        self.noted[from].forwards += 1;
        let letters = self.links[from].iter().map(|&(to, distance_um)| Letter {
            notice,
            to: to.0 as usize,
            distance_um,
        });
        self.under_way.extend(letters);
    }

    fn expires(&mut self, node: usize) {
        let until_ns = self.wait(node).expect("it waits");
        let mut early = self.nodes[node];
        assert!(until_ns == 0 || early.expire(until_ns - 1).is_none(), "too early");
        let notice = self.nodes[node].expire(until_ns).expect("its wait is over");
        self.send(node, notice);
    }

    fn arrives(&mut self, Letter { notice, to, distance_um }: Letter, bytes: &mut Tape<'_>) {
        let before = self.nodes[to];
        let ids = |near: &[(NodeId, u32)]| near.iter().map(|&(id, _)| id).collect::<Vec<_>>();
        let (neighbours, of_sender) = (ids(&self.links[to]), ids(&self.links[notice.sender.0 as usize]));
        let unreached = &mut self.unreached[to][..];
        let heard = Reception { message: notice, distance_um, now_ns: bytes.pick(256).into() };
        let reaction = self.nodes[to].receive(
            &self.rule,
            heard,
            || Surroundings { neighbours: &neighbours, of_sender: &of_sender, unreached },
            bytes,
        );
        if reaction == Reaction::Ignored {
            assert_eq!(self.nodes[to], before, "what is ignored changes nothing");
        }
        self.note(to, before, notice);
    }

    /// Notes down what the node has heard, by the sentences of the clauses.
    fn note(&mut self, to: usize, before: Node, notice: Notice) {
        if to == 0 {
            return;
        }
        let (noted, is_numbered) = (&mut self.noted[to], self.rule.has(Condition::NumberedEvents));
        if noted.event == 0 || is_numbered && notice.call.epoch.0 > noted.event {
            *noted = Note { event: notice.call.epoch.0, ..Note::default() };
        } else if is_numbered && notice.call.epoch.0 < noted.event {
            return;
        }
        let is_open =
            noted.nearest.is_none() || matches!(before.stage(), Stage::Unaware | Stage::Waiting { .. });
        if is_open {
            let heard = noted.nearest.into_iter().chain([(notice.sender, notice.hops)]);
            noted.nearest = heard.min_by_key(|&(_, hops)| hops);
        }
    }

    fn check(&self) {
        for (place, (node, noted)) in self.nodes.iter().zip(&self.noted).enumerate().skip(1) {
            assert!(noted.forwards <= 1, "NOTICE-2: node {place} forwards twice");
            assert_eq!(node.parent(), noted.nearest.map(|(sender, _)| sender), "NOTICE-6: node {place}");
            assert_eq!(node.hops(), noted.nearest.map(|(_, hops)| hops + 1), "NOTICE-1: node {place}");
            let Some(parent) = node.parent() else { continue };
            let parent = &self.nodes[parent.0 as usize];
            assert!(parent.event() >= node.event(), "NOTICE-1: node {place}");
            if parent.event() == node.event() {
                assert_eq!(node.hops(), parent.hops().map(|hops| hops + 1), "NOTICE-1: node {place}");
                assert_eq!(parent.stage(), Stage::Forwarded, "NOTICE-1: node {place}");
            }
        }
    }

    fn check_end(&self) {
        let everybody = matches!(self.rule.scheme, Scheme::Flooding | Scheme::Farthest { k: None });
        if self.is_disturbed || !everybody {
            return;
        }
        let (mut found, mut next) = (vec![0], 0);
        while let Some(&node) = found.get(next) {
            next += 1;
            for &(NodeId(other), _) in &self.links[node] {
                if !found.contains(&(other as usize)) {
                    found.push(other as usize);
                }
            }
        }
        let last = self.nodes[0].event();
        assert!(found.iter().all(|&node| self.nodes[node].event() == last), "NOTICE-3");
    }
}
