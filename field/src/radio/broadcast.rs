//! One event broadcast through a network by the kernel's rules [Jiang 2011, 3.2].

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{Epoch, NodeId, Notice, Reception};
use tautline_kernel::notice::{Node, Reaction, Rule, Scheme, Stage, Surroundings, words};
use tautline_kernel::tan::Nav;

use super::{Air, Channel, Faults, Network, Problem, Protocol, run};

/// B of equation (2), which the paper leaves open: a tenth of a second. Over the ideal channel the farthest-node
/// schemes do the same for any other.
pub const LONGEST_WAIT_NS: u32 = 100_000_000;

/// How far an event has come.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Reach {
    /// Nodes that know of it, the source included.
    pub reached: u32,
    /// Nodes that forwarded it, the source not included.
    pub rebroadcasts: u32,
}

/// The outcome of a broadcast.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Report {
    /// Nodes that know of the event, the source included.
    pub reached: u32,
    /// Nodes that forwarded it, the source not included.
    pub rebroadcasts: u32,
    /// The traffic on the air.
    pub air: Air,
}

/// Broadcasts one event from `source`, whose timer goes off at 0, and returns what came of it with the nodes' states.
///
/// # Errors
/// [`Problem::NoNode`] if there is no such source.
pub fn broadcast(
    network: &Network,
    rule: &Rule,
    channel: Channel,
    faults: &Faults,
    source: NodeId,
    chance: &mut dyn Oracle,
) -> Result<(Report, Vec<Node>), Problem> {
    let mut broadcast = Broadcast::new(network, *rule, source);
    let air = run(network, channel, faults, &mut broadcast, &[(source, 0)], chance)?;
    let Reach { reached, rebroadcasts } = broadcast.reach(Epoch::FIRST);
    Ok((Report { reached, rebroadcasts, air }, broadcast.nodes))
}

/// The nodes of a network while an event spreads.
#[derive(Clone, Debug)]
pub struct Broadcast<'a> {
    network: &'a Network,
    rule: Rule,
    nodes: Vec<Node>,
    source: NodeId,
    hellos: Hellos,
}

/// The scalable broadcast's memory of the neighbours: where the words of each node begin, and the words. The other
/// schemes need none.
#[derive(Clone, Default, Debug)]
struct Hellos {
    first: Vec<usize>,
    unreached: Vec<u64>,
}

impl Hellos {
    /// The knowledge of `at` when it hears `sender`.
    fn around<'a>(&'a mut self, network: &'a Network, at: NodeId, sender: NodeId) -> Surroundings<'a> {
        let Some(&first) = self.first.get(at.0 as usize) else { return Surroundings::none() };
        let neighbours = network.neighbours(at);
        let unreached = &mut self.unreached[first..first + words(neighbours.len())];
        Surroundings { neighbours, of_sender: network.neighbours(sender), unreached }
    }
}

impl<'a> Broadcast<'a> {
    /// No event has happened yet. The first time that the timer of `source` goes off, one does.
    pub fn new(network: &'a Network, rule: Rule, source: NodeId) -> Self {
        let ids = (0..network.nodes() as u32).map(NodeId);
        let hellos = match rule.scheme {
            Scheme::Scalable => {
                let mut end = 0;
                let mut next = |node| {
                    let first = end;
                    end += words(network.neighbours(node).len());
                    first
                };
                let first = ids.clone().map(&mut next).collect();
                Hellos { first, unreached: vec![0; end] }
            }
            Scheme::Farthest { .. } | Scheme::Flooding | Scheme::Counter { .. } | Scheme::Distance { .. } => {
                Hellos::default()
            }
        };
        Self { network, rule, nodes: ids.map(|id| Node::new(id, source)).collect(), source, hellos }
    }

    /// The source begins its next event: what it sends. `None` if it has no number left.
    pub fn originate(&mut self) -> Option<Notice> {
        self.nodes.get_mut(self.source.0 as usize)?.originate()
    }

    /// How far an event, by its number, has come: to be asked before the next.
    pub fn reach(&self, event: Epoch) -> Reach {
        let aware = || self.nodes.iter().filter(|node| node.event() == Some(event));
        let forwarded = aware().filter(|node| node.stage() == Stage::Forwarded).count() as u32;
        Reach { reached: aware().count() as u32, rebroadcasts: forwarded.saturating_sub(1) }
    }

    /// A node's place in the tree of an event, if it is one of its path nodes, or the source.
    pub(crate) fn nav(&self, node: NodeId, event: Epoch) -> Option<Nav> {
        let state = self.nodes[node.0 as usize];
        let is_path_node = state.stage() == Stage::Forwarded && state.event() == Some(event);
        let hops = state.hops().filter(|_| is_path_node)?;
        Some(Nav { wfr: self.source, node, hops, parent: state.parent().unwrap_or(node) })
    }

    /// The nodes' states.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }
}

impl Protocol for Broadcast<'_> {
    type Message = Notice;

    #[inline]
    fn receive(&mut self, at: NodeId, heard: Reception<Notice>, chance: &mut dyn Oracle) -> Option<u64> {
        let (network, hellos) = (self.network, &mut self.hellos);
        let sender = heard.message.sender;
        let node = &mut self.nodes[at.0 as usize];
        match node.receive(&self.rule, heard, || hellos.around(network, at, sender), chance) {
            Reaction::Armed { at_ns } => Some(at_ns),
            Reaction::Ignored | Reaction::Noted | Reaction::Silenced => None,
        }
    }

    fn expire(&mut self, at: NodeId, now_ns: u64, _: &mut dyn Oracle) -> Option<Notice> {
        let node = &mut self.nodes[at.0 as usize];
        if at == self.source { node.originate() } else { node.expire(now_ns) }
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroU32;

    use proptest::prelude::*;
    use tautline_kernel::net::Propagation;
    use tautline_kernel::notice::Count;
    use tautline_proofs::engine::SeededOracle;

    use super::*;
    use crate::radio::{Area, Field, Model, Radio, SharedChannel};
    use tautline_grids::chance::Probability;

    fn network(nodes: usize, seed: u64) -> Network {
        let area = Area::new(300.0, 300.0).expect("an area");
        let oracle = &mut SeededOracle::new(seed, 0);
        let field = Field::random(area, vec![], nodes, oracle).expect("a field");
        Network::new(&field, Radio::new(25.0, Model::Disc).expect("a radio"), oracle).expect("a network")
    }

    fn rule(scheme: Scheme) -> Rule {
        Rule::new(scheme, NonZeroU32::new(25_000_000).expect("a range"), 100_000_000)
    }

    fn cubed() -> Propagation {
        Propagation::new(3.0).expect("an exponent")
    }

    fn schemes() -> [Scheme; 7] {
        let count = |count| Count::new(count).expect("a count");
        [
            Scheme::Farthest { k: Some(Count::ONE) },
            Scheme::Farthest { k: Some(count(3)) },
            Scheme::Farthest { k: None },
            Scheme::Flooding,
            Scheme::Counter { below: count(2) },
            Scheme::Distance { least_um: 20_000_000 },
            Scheme::Scalable,
        ]
    }

    /// Each node that knows of the event is one hop farther than its parent, which has forwarded it.
    fn is_a_tree(nodes: &[Node], source: NodeId) -> bool {
        nodes.iter().filter(|node| node.hops().is_some()).all(|node| match node.parent() {
            None => node == &nodes[source.0 as usize] && node.hops() == Some(0),
            Some(parent) => {
                let parent = &nodes[parent.0 as usize];
                parent.stage() == Stage::Forwarded && parent.hops().map(|hops| hops + 1) == node.hops()
            }
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn parents_form_a_tree_whatever_the_air_does(
            seed in any::<u64>(), nodes in 2_usize..600, scheme in 0..schemes().len(), loss in 0.0..0.6, is_shared: bool
        ) {
            let network = network(nodes, seed);
            let mut chance = SeededOracle::new(seed, 1);
            let source = NodeId(chance.pick(nodes as u32));
            let channel = if is_shared { Channel::Shared(SharedChannel::SENSOR) } else { Channel::Ideal };
            let faults = Faults::NONE.with_loss(Probability::new(loss).expect("a probability"));
            let faults = faults.with_noise(loss * 10.0, cubed()).expect("a noise");
            let (report, states) =
                broadcast(&network, &rule(schemes()[scheme]), channel, &faults, source, &mut chance).expect("a source");
            prop_assert!(is_a_tree(&states, source));
            prop_assert!(report.reached as usize <= network.component(source));
            prop_assert_eq!(report.air.sent, u64::from(report.rebroadcasts) + 1);
        }

        #[test]
        fn without_a_limit_everybody_connected_hears_and_forwards_as_under_flooding(
            seed in any::<u64>(), nodes in 2_usize..600
        ) {
            let network = network(nodes, seed);
            let source = NodeId(nodes as u32 / 2);
            for scheme in [Scheme::Farthest { k: None }, Scheme::Flooding] {
                let chance = &mut SeededOracle::new(seed, 1);
                let spread = broadcast(&network, &rule(scheme), Channel::Ideal, &Faults::NONE, source, chance);
                let (report, _) = spread.expect("a source");
                prop_assert_eq!(report.reached as usize, network.component(source));
                prop_assert_eq!(report.rebroadcasts + 1, report.reached);
            }
        }

        #[test]
        fn the_scalable_broadcast_reaches_everybody_connected(seed in any::<u64>(), nodes in 2_usize..600) {
            let network = network(nodes, seed);
            let chance = &mut SeededOracle::new(seed, 1);
            let (report, _) =
                broadcast(&network, &rule(Scheme::Scalable), Channel::Ideal, &Faults::NONE, NodeId(0), chance)
                    .expect("a source");
            prop_assert_eq!(report.reached as usize, network.component(NodeId(0)));
        }
    }

    /// With shadows, noise, loss and collisions: whatever a library of floats could have a say in.
    #[test]
    fn the_same_seed_makes_the_same_broadcast_on_every_machine() {
        let area = Area::new(300.0, 300.0).expect("an area");
        let mut seeded = SeededOracle::new(7, 0);
        let field = Field::random(area, vec![], 700, &mut seeded).expect("a field");
        let model = Model::Shadowed { exponent: 3.0, deviation_db: 4.0 };
        let radio = Radio::new(25.0, model).expect("a radio");
        let network = Network::new(&field, radio, &mut seeded).expect("a network");
        let faults = Faults::NONE.with_loss(Probability::new(0.1).expect("a probability"));
        let faults = faults.with_noise(2.0, cubed()).expect("a noise");
        let made = schemes().map(|scheme| {
            let channel = Channel::Shared(SharedChannel::SENSOR);
            let chance = &mut SeededOracle::new(7, 1);
            let made =
                broadcast(&network, &rule(scheme), channel, &faults, NodeId(5), chance).expect("a source");
            let Report { reached, rebroadcasts, air } = made.0;
            (reached, rebroadcasts, air.heard, air.collided, air.end_ns)
        });
        assert_eq!(
            made,
            [
                (691, 196, 2388, 447, 226_890_280),
                (700, 323, 3826, 859, 176_583_460),
                (700, 699, 8197, 2663, 167_244_316),
                (700, 699, 8789, 2005, 306_439_582),
                (695, 185, 2427, 156, 479_966_383),
                (649, 119, 1804, 28, 742_010_112),
                (700, 404, 5401, 913, 341_912_137),
            ]
        );
    }

    #[test]
    fn a_source_that_there_is_not_is_refused() {
        let network = network(3, 0);
        let broadcast = |source| {
            broadcast(
                &network,
                &rule(Scheme::Flooding),
                Channel::Ideal,
                &Faults::NONE,
                source,
                &mut SeededOracle::new(0, 0),
            )
        };
        assert_eq!(broadcast(NodeId(3)), Err(Problem::NoNode { node: 3, nodes: 3 }));
    }
}
