//! Mutual exclusion by Ricart and Agrawala (Communications of the ACM 24, 1981). A node that wants to enter asks all
//! others, with the number that its request has; another one replies at once, unless it is inside or has asked with a
//! smaller number (of equal numbers, the smaller node has the smaller one): then it replies when it leaves. A node
//! enters when all have replied. Messages arrive in any order. The paper assumes that none is lost.

use tautline_proofs::protocol::{Letter, Mail};

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Conditions {
    /// A node that is inside or asked first replies only when it leaves.
    defers: bool,
    /// Of two equal numbers, that of the smaller node is the smaller one.
    breaks_ties: bool,
}

struct Net {
    nodes: usize,
    losses: u32,
}

impl fmt::Display for Net {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} nodes, each enters once, every order of messages", self.nodes)?;
        if self.losses == 0 { Ok(()) } else { write!(f, ", at most {} lost", self.losses) }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Phase {
    Idle,
    Wants,
    Inside,
    Done,
}
compact!(
    enum Phase {
        Idle,
        Wants,
        Inside,
        Done,
    }
);

/// A node: its phase, the number of its request, the largest number that it knows, who has replied, and who waits.
type Node = (Phase, u8, u8, u8, u8);
/// Nodes, and the messages under way: the number of a request, or 0 for a reply.
type State = (Vec<Node>, Mail<u8>);

struct Nodes(Conditions, Net);

impl Nodes {
    /// A node receives a message.
    fn receive(&self, nodes: &mut [Node], mail: &mut Mail<u8>, (from, to, number): Letter<u8>) {
        let (phase, own, known, replies, waiting) = &mut nodes[to];
        *known = number.max(*known);
        let is_first = *own < number || *own == number && (to < from || !self.0.breaks_ties);
        match number {
            0 => *replies |= 1 << from,
            _ if (*phase == Phase::Inside || *phase == Phase::Wants && is_first) && self.0.defers => {
                *waiting |= 1 << from;
            }
            _ => mail.send((to, from, 0)),
        }
    }
}

impl Protocol for Nodes {
    type Rule = Conditions;
    type Bound = Net;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always("at most one node is inside", |_, _, after: &State| {
            after.0.iter().filter(|node| node.0 == Phase::Inside).count() <= 1
        }),
        Demand::at_the_end("every node has been inside", |_, (nodes, ..): &State| {
            nodes.iter().all(|node| node.0 == Phase::Done)
        }),
    ];
    const COVERS: &'static [&'static str] = &["asks", "hears", "enters", "leaves"];

    fn new(&rule: &Conditions, &Net { nodes, losses }: &Net) -> Result<Self, MethodError> {
        Ok(Self(rule, Net { nodes, losses }))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        iter::once((vec![(Phase::Idle, 0, 0, 0, 0); self.1.nodes], Mail::new(self.1.losses)))
    }

    fn moves(&self, (nodes, mail): &State) -> Vec<Move<State>> {
        let mut moves = Vec::new();
        for (me, &(phase, own, known, replies, waiting)) in nodes.iter().enumerate() {
            let (mut to, mut sent) = (nodes.clone(), mail.clone());
            let others = (0..nodes.len()).filter(|&other| other != me);
            let words = match phase {
                Phase::Idle => {
                    to[me] = (Phase::Wants, known + 1, known + 1, 0, 0);
                    others.for_each(|other| sent.send((me, other, known + 1)));
                    "asks"
                }
                Phase::Wants if replies.count_ones() as usize + 1 == nodes.len() => {
                    to[me].0 = Phase::Inside;
                    "enters"
                }
                Phase::Inside => {
                    to[me] = (Phase::Done, own, known, 0, 0);
                    others
                        .filter(|other| waiting >> other & 1 == 1)
                        .for_each(|other| sent.send((me, other, 0)));
                    "leaves"
                }
                Phase::Wants | Phase::Done => continue,
            };
            moves.push(Move::of(me, words, (to, sent)));
        }
        for (letter, mut left) in mail.arrivals() {
            let mut to = nodes.clone();
            self.receive(&mut to, &mut left, letter);
            moves.push(Move::of(letter.1, "hears", (to, left)));
        }
        moves.extend(mail.losses().map(|left| Move::fault("a message is lost", (nodes.clone(), left))));
        moves
    }

    fn draw(&self, (nodes, mail): &State) -> String {
        let node = |(me, node): (usize, &Node)| format!("{me} {:?} {}\n", node.0, node.1);
        let sent = mail.under_way().iter().map(|&(from, to, number)| match number {
            0 => format!("{from}>{to} reply\n"),
            _ => format!("{from}>{to} asks {number}\n"),
        });
        nodes.iter().enumerate().map(node).chain(sent).collect()
    }
}

const fn net(nodes: usize, losses: u32) -> Net {
    Net { nodes, losses }
}

const RULE: Conditions = Conditions { defers: true, breaks_ties: true };
const PUBLISHED: NamedRule<Conditions> = NamedRule::new("published", RULE);
const EAGER: NamedRule<Conditions> = NamedRule::new("replies at once", Conditions { defers: false, ..RULE });
const TIES: NamedRule<Conditions> = NamedRule::new("ties", Conditions { breaks_ties: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "ricart-agrawala",
    title: "Ricart–Agrawala",
    source: "Ricart, Agrawala, *An Optimal Algorithm for Mutual Exclusion in Computer Networks*, Communications of the \
             ACM 24, 1981",
    clauses: &[
        promise(
            "MUTEX-1",
            "At most one node MUST be inside.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Nodes>(net(3, 0), 0), Holds, &[EAGER]),
                &Check::new(PUBLISHED, &Keeps::<Nodes>(net(3, 1), 0), Holds, &[EAGER]),
            ],
        ),
        promise(
            "MUTEX-2",
            "Every node MUST get inside.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Nodes>(net(3, 0), 1), Holds, &[TIES]),
                &Check::new(PUBLISHED, &Keeps::<Nodes>(net(2, 1), 1), Refuted, &[]),
            ],
        ),
    ],
    larger: &[promise(
        "MUTEX-1",
        "At most one node MUST be inside.",
        &[&Check::new(PUBLISHED, &Keeps::<Nodes>(net(4, 0), 0), Holds, &[EAGER])],
    )],
};
