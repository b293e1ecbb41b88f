//! Mutual exclusion by Ricart and Agrawala (Communications of the ACM 24, 1981). A node that wants to enter asks all
//! others, with the number that its request has; another one replies at once, unless it is inside or has asked with a
//! smaller number (of equal numbers, the smaller node has the smaller one): then it replies when it leaves. A node
//! enters when all have replied. Messages arrive in any order. The paper assumes that none is lost.

use tautline_proofs::protocol::{Letter, Mail};

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Conditions {
    /// A node that is inside or asked first replies only when it leaves.
    pub defers: bool,
    /// Of two equal numbers, that of the smaller node is the smaller one.
    pub breaks_ties: bool,
}

/// Nodes, at most eight, and the most messages that are lost.
#[derive(Clone, Copy, Debug)]
pub struct Net(pub usize, pub u32);

impl fmt::Display for Net {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} nodes, each enters once, every order of messages", self.0)?;
        if self.1 == 0 { Ok(()) } else { write!(f, ", at most {} lost", self.1) }
    }
}

/// The phase of a node.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Phase {
    /// It has not asked.
    Idle,
    /// It has asked.
    Wants,
    /// It is inside.
    Inside,
    /// It has left.
    Done,
}
compact! { Phase: Idle, Wants, Inside, Done }

/// A node: its phase, the number of its request, the largest number that it knows, who has replied, and who waits.
type Node = (Phase, u8, u8, u8, u8);
/// Nodes, and the messages under way: the number of a request, or 0 for a reply.
type State = (Vec<Node>, Mail<u8>);

/// The nodes of a network.
#[derive(Debug)]
pub struct Nodes(Conditions, Net);

impl Nodes {
    /// A node has received a message, which is no longer in the mail.
    fn receive(&self, nodes: &[Node], (from, to, number): Letter<u8>, mut mail: Mail<u8>) -> State {
        let mut nodes = nodes.to_vec();
        let (phase, own, known, replies, waiting) = &mut nodes[to];
        *known = number.max(*known);
        let is_first = *own < number || *own == number && (to < from || !self.0.breaks_ties);
        let is_before = *phase == Phase::Inside || *phase == Phase::Wants && is_first;
        match number {
            0 => *replies |= 1 << from,
            _ if is_before && self.0.defers => *waiting |= 1 << from,
            _ => mail.send((to, from, 0)),
        }
        (nodes, mail)
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

    fn new(&rule: &Conditions, &net: &Net) -> Result<Self, MethodError> {
        let fits = (1..=8).contains(&net.0);
        MethodError::unless(fits, format_args!("there are 1 to 8 nodes, not {}", net.0))?;
        Ok(Self(rule, net))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        iter::once((vec![(Phase::Idle, 0, 0, 0, 0); self.1.0], Mail::new(self.1.1)))
    }

    fn moves(&self, (nodes, mail): &State) -> Vec<Move<State>> {
        let mut moves = Vec::new();
        for (me, &(phase, own, known, replies, waiting)) in nodes.iter().enumerate() {
            let others = ((1 << nodes.len()) - 1) & !(1 << me);
            let (words, node, receivers, number) = match phase {
                Phase::Idle => ("asks", (Phase::Wants, known + 1, known + 1, 0, 0), others, known + 1),
                Phase::Wants if replies == others => {
                    ("enters", (Phase::Inside, own, known, replies, waiting), 0, 0)
                }
                Phase::Inside => ("leaves", (Phase::Done, own, known, 0, 0), waiting, 0),
                Phase::Wants | Phase::Done => continue,
            };
            let (mut to, mut sent) = (nodes.clone(), mail.clone());
            to[me] = node;
            sent.send_each(me, receivers.into(), &number);
            moves.push(Move::of(me, words, (to, sent)));
        }
        let receive = |letter, left| self.receive(nodes, letter, left);
        moves.extend(mail.moves(receive, |left| (nodes.clone(), left)));
        moves
    }

    fn draw(&self, (nodes, mail): &State) -> String {
        let node = |(me, node): (usize, &Node)| format!("{me} {:?} {}\n", node.0, node.1);
        let words = |&number: &u8| if number == 0 { "reply".to_owned() } else { format!("asks {number}") };
        nodes.iter().enumerate().map(node).chain(mail.lines(words)).collect()
    }
}

/// The published rule.
pub const RULE: Conditions = Conditions { defers: true, breaks_ties: true };
const PUBLISHED: NamedRule<Conditions> = NamedRule::new("published", RULE);
const EAGER: NamedRule<Conditions> = NamedRule::new("replies at once", Conditions { defers: false, ..RULE });
const TIES: NamedRule<Conditions> = NamedRule::new("ties", Conditions { breaks_ties: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "ricart-agrawala",
    title: "Ricart–Agrawala",
    source: "Ricart, Agrawala, *An Optimal Algorithm for Mutual Exclusion in Computer Networks*, Communications of the \
             ACM 24, 1981",
    promises: &[
        promise(
            "MUTEX-1",
            "At most one node MUST be inside.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Nodes>(Net(3, 0), 0), Holds, &[EAGER]),
                &Check::new(PUBLISHED, &Keeps::<Nodes>(Net(3, 1), 0), Holds, &[EAGER]),
            ],
        )
        .larger(&[&Check::new(PUBLISHED, &Keeps::<Nodes>(Net(4, 0), 0), Holds, &[EAGER])]),
        promise(
            "MUTEX-2",
            "Every node MUST get inside.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Nodes>(Net(3, 0), 1), Holds, &[TIES]),
                &Check::new(PUBLISHED, &Keeps::<Nodes>(Net(2, 1), 1), Refuted, &[]),
            ],
        ),
    ],
};
