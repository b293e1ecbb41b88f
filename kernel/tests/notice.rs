//! A node's reaction to a NOTICE, beyond what every network shows: late ones, and rules with one condition taken out.

use core::num::NonZeroU32;

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{Call, Epoch, NodeId, Notice, Reception};
use tautline_kernel::notice::{Condition, Count, Node, Reaction, Rule, Scheme, Surroundings};

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

fn without(rule: Rule, condition: Condition) -> Rule {
    Rule { conditions: rule.conditions.without(condition), ..rule }
}

fn fresh() -> Node {
    Node::new(NodeId(9), SOURCE)
}

fn heard(sender: u32, hops: u16) -> Reception<Notice> {
    let message = Notice { call: Call { wfr: SOURCE, epoch: Epoch(1) }, sender: NodeId(sender), hops };
    Reception { message, distance_um: 0, now_ns: 0 }
}

fn hear(node: &mut Node, rule: &Rule, sender: u32, hops: u16) -> Reaction {
    node.receive(rule, heard(sender, hops), Surroundings::none, &mut Seven)
}

/// The node hears what comes too late to change anything.
fn ignores(node: &mut Node, rule: &Rule, sender: u32, hops: u16) {
    let before = *node;
    let asked = || -> Surroundings<'static> { panic!("nobody has to know what is around") };
    assert_eq!(node.receive(rule, heard(sender, hops), asked, &mut Seven), Reaction::Ignored);
    assert_eq!(*node, before);
}

#[test]
fn a_late_notice_is_ignored_and_what_is_around_is_not_asked_for() {
    let (mut silent, mut through, rule_of_one) = (fresh(), fresh(), farthest(1));
    hear(&mut silent, &rule_of_one, 4, 2);
    assert_eq!(hear(&mut silent, &rule_of_one, 5, 2), Reaction::Silenced);
    ignores(&mut silent, &rule_of_one, 6, 0);
    hear(&mut through, &rule_of_one, 4, 2);
    through.expire(u64::MAX).expect("its wait is over");
    ignores(&mut through, &rule_of_one, 6, 0);
    // Where nothing can silence a node, only a nearer sender matters.
    for endless in [rule(Scheme::Flooding), farthest(0)] {
        let mut waiting = fresh();
        hear(&mut waiting, &endless, 4, 2);
        ignores(&mut waiting, &endless, 5, 2);
        ignores(&mut waiting, &endless, 6, 3);
        assert_eq!(hear(&mut waiting, &endless, 7, 1), Reaction::Noted);
        assert_eq!((waiting.parent(), waiting.hops()), (Some(NodeId(7)), Some(2)));
    }
}

#[test]
fn a_node_that_has_heard_the_same_senders_is_the_same_in_whatever_order() {
    let rule = farthest(8);
    let heard = |senders: [u32; 4]| {
        let mut node = fresh();
        hear(&mut node, &rule, 5, 0);
        for sender in senders {
            assert_eq!(hear(&mut node, &rule, sender, 1), Reaction::Noted);
        }
        node
    };
    for order in [[7, 6, 3, 4], [3, 7, 4, 6], [6, 4, 7, 3], [4, 3, 6, 7]] {
        assert_eq!(heard(order), heard([3, 4, 6, 7]), "{order:?}");
    }
}

#[test]
fn a_node_that_does_not_remember_what_it_has_forwarded_begins_anew() {
    let forgetful = without(farthest(1), Condition::RememberEvent);
    let mut node = fresh();
    hear(&mut node, &forgetful, 4, 0);
    node.expire(u64::MAX).expect("its wait is over");
    assert_eq!(hear(&mut node, &forgetful, 5, 0), Reaction::Armed { at_ns: 1000 });
}

#[test]
fn a_node_that_is_not_frozen_takes_a_sender_as_near_for_its_parent() {
    let restless = without(farthest(1), Condition::FrozenOnceForwarded);
    let mut node = fresh();
    hear(&mut node, &restless, 4, 2);
    node.expire(u64::MAX).expect("its wait is over");
    assert_eq!(hear(&mut node, &restless, 5, 3), Reaction::Noted);
    assert_eq!((node.parent(), node.hops()), (Some(NodeId(5)), Some(4)));
    assert_eq!(hear(&mut node, &restless, 6, 5), Reaction::Ignored);
    assert_eq!(node.expire(u64::MAX), None, "it has forwarded the event");
}

#[test]
fn where_the_first_of_equals_need_not_be_the_parent_the_last_one_is() {
    let rule = without(farthest(8), Condition::FirstHeard);
    let mut node = fresh();
    for (sender, hops, parent) in [(4, 2, 4), (3, 2, 3), (5, 3, 3), (6, 1, 6), (7, 2, 6), (8, 1, 8)] {
        hear(&mut node, &rule, sender, hops);
        assert_eq!(node.parent(), Some(NodeId(parent)), "after {sender}");
    }
}
