//! Traces of a broadcast for navigation: the tree of the nodes that have forwarded it, and the part of it that the
//! robot has heard; and the hops of all nodes from a goal, which the rivals have of their floods.

use std::collections::VecDeque;

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{Epoch, NodeId, Notice, Reception};
use tautline_kernel::notice::Rule;
use tautline_kernel::tan::Nav;

use crate::radio::{Broadcast, Channel, Faults, Network, Problem, Protocol, run};

/// The navigation tree of one call.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Tree {
    navs: Vec<Option<Nav>>,
    entry: Option<(NodeId, u16)>,
}

impl Tree {
    /// Broadcasts a call from `wfr`, and nothing goes wrong. Node `robot` of the network
    /// is a robot: it hears, and sends nothing.
    ///
    /// # Errors
    /// [`Problem::NoNode`] if there is no such WFR.
    pub fn grow(
        network: &Network,
        rule: Rule,
        (wfr, robot): (NodeId, NodeId),
        chance: &mut dyn Oracle,
    ) -> Result<Self, Problem> {
        let broadcast = Broadcast::new(network, rule, wfr);
        let mut listening = Listener { broadcast, robot, least: None };
        run(network, Channel::Ideal, &Faults::NONE, &mut listening, &[(wfr, 0)], chance)?;
        let nodes = (0..network.nodes() as u32).map(NodeId);
        let nav = |node: NodeId| listening.broadcast.nav(node, Epoch::FIRST);
        let entry = listening.least.map(|(hops, sender)| (sender, hops));
        Ok(Self { navs: nodes.map(nav).collect(), entry })
    }

    /// A node's answer to a robot, if it is one of the tree.
    pub fn nav(&self, node: NodeId) -> Option<Nav> {
        self.navs.get(node.0 as usize).copied().flatten()
    }

    /// The robot's parent, and its own hops from the WFR; `None` if it has not heard of the call.
    pub const fn entry(&self) -> Option<(NodeId, u16)> {
        self.entry
    }

    /// Each path node with its parent.
    pub fn links(&self) -> impl Iterator<Item = (NodeId, NodeId)> {
        self.navs.iter().flatten().filter(|nav| nav.node != nav.parent).map(|nav| (nav.node, nav.parent))
    }
}

/// A broadcast with a robot that listens: of all that it hears, the least hop count counts, and the first of equals.
struct Listener<'a> {
    broadcast: Broadcast<'a>,
    robot: NodeId,
    /// The robot's hops, and whom it has them from.
    least: Option<(u16, NodeId)>,
}

impl Protocol for Listener<'_> {
    type Message = Notice;

    fn receive(&mut self, at: NodeId, heard: Reception<Notice>, chance: &mut dyn Oracle) -> Option<u64> {
        if at != self.robot {
            return self.broadcast.receive(at, heard, chance);
        }
        let hops = heard.message.hops.saturating_add(1);
        if self.least.is_none_or(|(least, _)| hops < least) {
            self.least = Some((hops, heard.message.sender));
        }
        None
    }

    fn expire(&mut self, at: NodeId, now_ns: u64, chance: &mut dyn Oracle) -> Option<Notice> {
        self.broadcast.expire(at, now_ns, chance)
    }
}

/// The hops of each node from `goal` as after a flood that `goal` and the nodes that forward send on; none where it
/// does not come.
pub fn hops(network: &Network, goal: NodeId, forwards: impl Fn(NodeId) -> bool) -> Vec<Option<u16>> {
    let mut hops = vec![None; network.nodes()];
    let mut queue = VecDeque::new();
    if let Some(of_goal) = hops.get_mut(goal.0 as usize) {
        *of_goal = Some(0);
        queue.push_back((goal, 0_u16));
    }
    while let Some((node, so_far)) = queue.pop_front() {
        let next = so_far.saturating_add(1);
        for &neighbour in network.neighbours(node) {
            if let Some(unknown @ None) = hops.get_mut(neighbour.0 as usize) {
                *unknown = Some(next);
                if forwards(neighbour) {
                    queue.push_back((neighbour, next));
                }
            }
        }
    }
    hops
}

#[cfg(test)]
mod tests {
    use tautline_kernel::notice::{Count, Scheme};
    use tautline_proofs::engine::Tape;

    use super::*;
    use crate::radio::{Area, Field, Model, Point, Radio};

    /// A broadcast by k-FNF from node 0; the last node is the robot.
    fn grown(k: u8, places: &[(f64, f64)]) -> (Tree, Network) {
        let area = Area::new(100.0, 100.0).expect("an area");
        let nodes = places.iter().map(|&(x_m, y_m)| Point { x_m, y_m }).collect();
        let field = Field::new(area, vec![], nodes).expect("a field");
        let radio = Radio::new(25.0, Model::Disc).expect("a radio");
        let network = Network::new(&field, radio, &mut Tape(&[])).expect("a network");
        let rule = Rule::new(Scheme::Farthest { k: Count::new(k) }, radio.range_um(), 100_000_000);
        let ends = (NodeId(0), NodeId(places.len() as u32 - 1));
        let tree = Tree::grow(&network, rule, ends, &mut Tape(&[])).expect("a tree");
        (tree, network)
    }

    #[test]
    fn of_equal_hop_counts_the_robot_takes_the_first_heard() {
        // The farther node is the first to forward.
        for places in [[(0.0, 0.0), (18.0, 5.0), (20.0, 0.0)], [(0.0, 0.0), (20.0, 0.0), (18.0, 5.0)]] {
            let farther = if places[1] == (20.0, 0.0) { 1 } else { 2 };
            let (tree, _) = grown(8, &[&places[..], &[(40.0, 0.0)]].concat());
            assert_eq!(tree.entry(), Some((NodeId(farther), 2)));
        }
    }

    /// The WFR, a node near it, one far from it and one beyond that; the robot hears the near one and the last.
    const ROUND: [(f64, f64); 5] = [(0.0, 0.0), (3.0, 4.0), (0.0, 24.5), (20.0, 27.0), (24.0, 10.0)];

    #[test]
    fn the_robot_takes_the_least_hop_count_also_if_it_comes_later() {
        let (tree, _) = grown(8, &ROUND);
        assert_eq!(tree.entry(), Some((NodeId(1), 2)));
        assert_eq!(tree.nav(NodeId(4)), None, "a robot is no path node");
    }

    #[test]
    fn who_has_not_forwarded_is_no_path_node() {
        let (tree, network) = grown(1, &ROUND);
        assert_eq!(tree.nav(NodeId(1)), None);
        assert_eq!(tree.entry(), Some((NodeId(3), 3)));
        let nav = |node, hops, parent| {
            Some(Nav { wfr: NodeId(0), node: NodeId(node), hops, parent: NodeId(parent) })
        };
        assert_eq!([0, 2, 3].map(|node| tree.nav(NodeId(node))), [nav(0, 0, 0), nav(2, 1, 0), nav(3, 2, 2)]);
        assert_eq!(tree.links().collect::<Vec<_>>(), [(NodeId(2), NodeId(0)), (NodeId(3), NodeId(2))]);
        assert_eq!(hops(&network, NodeId(0), |node| node != NodeId(4)), [0, 1, 1, 2, 2].map(Some));
    }
}
