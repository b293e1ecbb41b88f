//! Mutual exclusion by Ricart and Agrawala (Communications of the ACM 24, 1981). A node that wants to enter asks all
//! others, with the number that its request has; another one replies at once, unless it is inside or has asked with a
//! smaller number (of equal numbers, the smaller node has the smaller one): then it replies when it leaves. A node
//! enters when all have replied. Messages arrive in any order. The paper assumes that none is lost.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, Debug)]
pub struct Conditions {
    /// A node that is inside or asked first replies only when it leaves.
    pub defers: bool,
    /// Of two equal numbers, that of the smaller node is the smaller one.
    pub breaks_ties: bool,
}

bound! {
    /// Nodes, and the most messages that are lost.
    pub Net { nodes: usize, losses: u32 }
    "{nodes} nodes, each enters once, every order of messages, at most {losses} lost";
    (1..=8).contains(&nodes), "there are 1 to 8 nodes, not {nodes}"
}

compact! {
    /// The phase of a node: it has not asked, it has asked, it is inside, or it has left.
    pub enum Phase { Idle, Wants, Inside, Done }
}

/// A node: its phase, the number of its request, the largest number that it knows, who has replied, and who waits.
type Node = (Phase, u8, u8, u8, u8);
/// Nodes, and the messages under way: the number of a request, or 0 for a reply.
type State = (Vec<Node>, Mail<u8>);

impl Conditions {
    /// A node has received a message, which is no longer in the mail.
    fn receive(self, nodes: &[Node], (from, to, number): Letter<u8>, mut mail: Mail<u8>) -> State {
        let mut nodes = nodes.to_vec();
        let (phase, own, known, replies, waiting) = &mut nodes[to];
        *known = number.max(*known);
        let is_first = *own < number || *own == number && (to < from || !self.breaks_ties);
        let is_before = *phase == Phase::Inside || *phase == Phase::Wants && is_first;
        match number {
            0 => *replies |= 1 << from,
            _ if is_before && self.defers => *waiting |= 1 << from,
            _ => mail.send((to, from, 0)),
        }
        (nodes, mail)
    }
}

impl Protocol for Conditions {
    type Bound = Net;
    type State = State;
    demands! {
        always "at most one node is inside", |_, _, _, (nodes, _)| {
            nodes.iter().filter(|node| node.0 == Phase::Inside).count() <= 1
        };
        at_the_end "every node has been inside", |_, _, (nodes, _)| nodes.iter().all(|node| node.0 == Phase::Done);
    }
    const COVERS: &'static [&'static str] = &["asks", "hears", "enters", "leaves"];

    fn starts(&self, net: &Net) -> impl IntoIterator<Item = State> {
        [(vec![(Phase::Idle, 0, 0, 0, 0); net.nodes], Mail::new(net.losses))]
    }

    fn moves(&self, _: &Net, (nodes, mail): &State) -> Vec<Move<State>> {
        let act = |(me, &(phase, own, known, replies, waiting)): (usize, &Node)| {
            let others = u8::MAX >> (8 - nodes.len()) & !(1 << me);
            let (words, node, receivers, number) = match phase {
                Phase::Idle => ("asks", (Phase::Wants, known + 1, known + 1, 0, 0), others, known + 1),
                Phase::Wants if replies == others => {
                    ("enters", (Phase::Inside, own, known, 0, waiting), 0, 0)
                }
                Phase::Inside => ("leaves", (Phase::Done, own, known, 0, 0), waiting, 0),
                Phase::Wants | Phase::Done => return None,
            };
            Some(Move::of(me, words, (with(nodes, me, node), mail.with_each(me, receivers.into(), &number))))
        };
        let receive = |letter, left| self.receive(nodes, letter, left);
        let arrivals = mail.moves(receive, |left| (nodes.clone(), left));
        nodes.iter().enumerate().filter_map(act).chain(arrivals).collect()
    }

    fn draw(&self, _: &Net, (nodes, mail): &State) -> String {
        let node = |(me, node): (usize, &Node)| format!("{me} {:?} {}\n", node.0, node.1);
        let words = |&number: &u8| if number == 0 { "reply".to_owned() } else { format!("asks {number}") };
        nodes.iter().enumerate().map(node).chain(mail.lines(words)).collect()
    }
}

/// The published rule.
pub const RULE: Conditions = Conditions { defers: true, breaks_ties: true };

entry! { Conditions: "ricart-agrawala", "Ricart–Agrawala", "MUTEX",
    "Ricart, Agrawala, *An Optimal Algorithm for Mutual Exclusion in Computer Networks*, Communications of the ACM \
     24, 1981";
    PUBLISHED = "published", RULE;
    OUTSIDE = "published outside its premises", RULE;
    EAGER = "replies at once", Conditions { defers: false, ..RULE };
    TIES = "ties", Conditions { breaks_ties: false, ..RULE };
    1: "At most one node MUST be inside." {
        Holds PUBLISHED within Net::of(3, 0), not EAGER;
        Holds PUBLISHED within Net::of(3, 1), not EAGER;
    } larger {
        Holds PUBLISHED within Net::of(4, 0), not EAGER;
    }
    2: "Every node MUST get inside." {
        Holds PUBLISHED within Net::of(3, 0), not TIES;
        Refuted OUTSIDE within Net::of(2, 1);
    }
}
