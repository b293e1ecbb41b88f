//! The reaction of a node to a NOTICE in every state that it can come to, under every scheme.

use std::collections::{BTreeSet, HashSet};
use std::num::NonZeroU32;

use tautline_kernel::net::{Call, Epoch, NodeId, Notice, Reception};
use tautline_kernel::notice::{Condition, Conditions, Count, Node, Rule, Scheme, Stage, Surroundings};
use tautline_proofs::engine::Tape;

use super::term::{definition, list};

const ME: u32 = 9;
const SOURCE: NodeId = NodeId(0);
const RANGE: NonZeroU32 = NonZeroU32::MIN;

/// How far a node is, its parent, and its hops.
type State = (usize, u32, u16);

/// A state, the sender that is heard with its hop count, and the state after it; or what the node sends at the end of
/// its wait.
#[derive(Default)]
struct Rows {
    heard: BTreeSet<(State, (u32, u16), State)>,
    sent: BTreeSet<(State, (State, u16))>,
}

fn state(node: &Node) -> State {
    let stage = match node.stage() {
        Stage::Unaware => 0,
        Stage::Waiting { .. } => 1,
        Stage::Silent => 2,
        Stage::Forwarded => 3,
    };
    (stage, node.parent().map_or(ME, |parent| parent.0), node.hops().unwrap_or(0))
}

fn schemes() -> Vec<Scheme> {
    let count = |count| Count::new(count).expect("a count");
    let mut schemes = vec![Scheme::Flooding, Scheme::Farthest { k: None }, Scheme::Scalable];
    schemes.extend([1, 2].map(|k| Scheme::Farthest { k: Some(count(k)) }));
    schemes.extend([1, 3].map(|below| Scheme::Counter { below: count(below) }));
    schemes.extend([1, 2].map(|least_um| Scheme::Distance { least_um }));
    schemes
}

/// Every state that comes of NOTICEs of three senders with three hop counts, and the end of the wait.
fn explore(conditions: Conditions, rows: &mut Rows) {
    for scheme in schemes() {
        let rule = Rule { conditions, ..Rule::new(scheme, RANGE, 1) };
        let fresh = Node::new(NodeId(ME), SOURCE);
        let (mut known, mut left) = (HashSet::from([fresh]), vec![fresh]);
        while let Some(node) = left.pop() {
            let mut next = Vec::new();
            for (sender, hops) in (1..=3).flat_map(|sender| (0..=2).map(move |hops| (sender, hops))) {
                let call = Call { wfr: SOURCE, epoch: Epoch(1) };
                let message = Notice { call, hops, sender: NodeId(sender) };
                let mut after = node;
                let heard = Reception { message, distance_um: RANGE.get(), now_ns: 0 };
                after.receive(&rule, heard, Surroundings::none, &mut Tape(&[]));
                rows.heard.insert((state(&node), (sender, hops), state(&after)));
                next.push(after);
            }
            let mut after = node;
            if let Some(notice) = after.expire(u64::MAX) {
                assert_eq!(notice.sender, NodeId(ME));
                rows.sent.insert((state(&node), (state(&after), notice.hops)));
                next.push(after);
            }
            left.extend(next.into_iter().filter(|&node| known.insert(node)));
        }
    }
}

/// How many NOTICEs a node hears of three senders, each with its own hop count of three.
const HEARD: usize = 4;
const HOPS: u16 = 3;

/// How far a node is, as published, after any [`HEARD`] NOTICEs of three senders, by any hop counts of theirs, under
/// k = 1, 2, 3 and ∞, and under flooding: 16 times its stage, four times its parent, and its hops.
fn spread() -> Vec<String> {
    let numbers = |base: usize, digits: usize| {
        let digit = move |number: usize, place: usize| number / base.pow((digits - 1 - place) as u32) % base;
        (0..base.pow(digits as u32))
            .map(move |number| (0..digits).map(|place| digit(number, place)).collect::<Vec<_>>())
    };
    let counts = [1, 2, 3].map(Count::new).into_iter().chain([None]);
    let schemes = counts.map(|k| Scheme::Farthest { k }).chain([Scheme::Flooding]);
    let mut codes = Vec::new();
    for scheme in schemes {
        let rule = Rule { conditions: Conditions::PUBLISHED, ..Rule::new(scheme, RANGE, 1) };
        for hops in numbers(HOPS.into(), 3) {
            for senders in numbers(3, HEARD) {
                let mut node = Node::new(NodeId(ME), SOURCE);
                for sender in senders {
                    let call = Call { wfr: SOURCE, epoch: Epoch(1) };
                    let message =
                        Notice { call, hops: hops[sender] as u16, sender: NodeId(1 + sender as u32) };
                    let heard = Reception { message, distance_um: RANGE.get(), now_ns: 0 };
                    node.receive(&rule, heard, Surroundings::none, &mut Tape(&[]));
                }
                let (stage, parent, hops) = state(&node);
                codes.push((16 * stage + 4 * parent as usize + usize::from(hops)).to_string());
            }
        }
    }
    codes
}

/// How far a node is after any [`HEARD`] NOTICEs of two events by three senders, and ends of its wait, with numbered
/// events and without, under k = 1 and ∞: 256 times the number of its event, 64 times its stage, four times its
/// parent, and its hops.
fn numbered() -> Vec<String> {
    let mut codes = Vec::new();
    for conditions in [Conditions::REPAIRED, Conditions::PUBLISHED] {
        for k in [Count::new(1), None] {
            let rule = Rule { conditions, ..Rule::new(Scheme::Farthest { k }, RANGE, 1) };
            for number in 0..7_u32.pow(HEARD as u32) {
                let mut node = Node::new(NodeId(ME), SOURCE);
                for place in (0..HEARD as u32).rev() {
                    let happening = number / 7_u32.pow(place) % 7;
                    if happening == 6 {
                        node.expire(u64::MAX);
                        continue;
                    }
                    let (epoch, sender) = (Epoch(1 + happening / 3), NodeId(1 + happening % 3));
                    let message =
                        Notice { call: Call { wfr: SOURCE, epoch }, hops: (happening % 3) as u16, sender };
                    let heard = Reception { message, distance_um: RANGE.get(), now_ns: 0 };
                    node.receive(&rule, heard, Surroundings::none, &mut Tape(&[]));
                }
                let (stage, parent, hops) = state(&node);
                let event = node.event().map_or(0, |event| event.0 as usize);
                codes.push((256 * event + 64 * stage + 4 * parent as usize + usize::from(hops)).to_string());
            }
        }
    }
    codes
}

pub(super) fn terms() -> String {
    let mut rows = Rows::default();
    let repaired = Conditions::REPAIRED;
    // The theorem does not need the least hop count, nor the first heard, nor numbers of events.
    let fewer = [Condition::LeastHops, Condition::FirstHeard, Condition::NumberedEvents];
    for conditions in [repaired].into_iter().chain(fewer.map(|condition| repaired.without(condition))) {
        explore(conditions, &mut rows);
    }
    let mut thawed = Rows::default();
    explore(repaired.without(Condition::FrozenOnceForwarded), &mut thawed);
    let state = |(stage, parent, hops): State| format!("({stage},{parent},{hops})");
    let heard = |rows: &Rows| {
        let row = |&(before, (sender, hops), after): &(State, (u32, u16), State)| {
            format!("({},({sender},{hops}),{})", state(before), state(after))
        };
        format!("{}%nat", list(rows.heard.iter().map(row)))
    };
    let sent = |rows: &Rows| {
        let row = |&(before, (after, hops)): &(State, (State, u16))| {
            format!("({},({},{hops}))", state(before), state(after))
        };
        format!("{}%nat", list(rows.sent.iter().map(row)))
    };
    let mut text = definition("me", "nat", &ME.to_string());
    text += &definition("heard", "list ((nat * nat * nat) * (nat * nat) * (nat * nat * nat))", &heard(&rows));
    text += &definition("sent", "list ((nat * nat * nat) * ((nat * nat * nat) * nat))", &sent(&rows));
    // Only what forwarded nodes make of it differs.
    thawed.heard.retain(|row| !rows.heard.contains(row));
    text += &definition("spread", "list N", &format!("{}%N", list(spread())));
    text += &definition("numbered", "list N", &format!("{}%N", list(numbered())));
    text + &definition(
        "heard_without_FrozenOnceForwarded",
        "list ((nat * nat * nat) * (nat * nat) * (nat * nat * nat))",
        &heard(&thawed),
    )
}
