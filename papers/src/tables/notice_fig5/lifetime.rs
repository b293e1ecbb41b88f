//! The lifetime of a network that broadcasts [Jiang 2011, 1]: how many broadcasts it carries until the first node has
//! spent its energy. All nodes begin with the same, and spend it on sending and receiving alone, so that of two schemes
//! the lifetimes are as the largest spendings of any node, the other way round.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{Rule, Stage};

use super::super::prelude::*;
use super::super::sentences::SAME;
use tautline_field::radio::{Channel, Faults, Network, Problem, broadcast};
use tautline_field::tan::hops;

/// The broadcasts of one topology over which spendings are summed. A thousand give the same within the intervals.
pub const BROADCASTS: u32 = 100;

/// The cost of a signal that a node hears, in halves of the cost of one that it sends.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Receiving {
    /// None: only sending costs.
    Free,
    /// One half. The radio of the paper's sensor, a T-Mote Sky (4.1), takes more still: as much as for sending.
    Half,
}

/// The node from which each broadcast of a topology comes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Source {
    /// One source, each time.
    Fixed,
    /// Any, drawn each time.
    Drawn,
}

/// The readings of “prolonging the network lifetime”, each with its name.
const READINGS: [(&str, Receiving, Source); 4] = [
    ("sent, fixed", Receiving::Free, Source::Fixed),
    ("heard, fixed", Receiving::Half, Source::Fixed),
    ("sent, drawn", Receiving::Free, Source::Drawn),
    ("heard, drawn", Receiving::Half, Source::Drawn),
];

/// The lifetime by k-FNF under one reading.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Lifetime {
    /// The cost of receiving.
    pub receiving: Receiving,
    /// Where broadcasts come from.
    pub source: Source,
    /// How many times that by flooding it is.
    pub ratio: Estimate,
}

/// Those of one topology, in the order of the readings. By flooding every node that links connect to the source sends
/// each time.
pub(super) fn ratios(
    network: &Network,
    rule: &Rule,
    channel: Channel,
    source: NodeId,
    chance: &mut dyn Oracle,
) -> Result<[f64; READINGS.len()], Problem> {
    let parts = parts(network);
    let mut sent_by = |from: Source| {
        let broadcasts = match (from, channel) {
            // Nothing is left to chance, so all are as the first.
            (Source::Fixed, Channel::Ideal) => 1,
            (Source::Drawn, _) | (Source::Fixed, Channel::Shared(_)) => BROADCASTS,
        };
        let (mut ours, mut floods) = (vec![0; network.nodes()], vec![0; network.nodes()]);
        for _ in 0..broadcasts {
            let source = match from {
                Source::Fixed => source,
                Source::Drawn => NodeId(chance.pick(network.nodes() as u32)),
            };
            let (_, nodes) = broadcast(network, rule, channel, &Faults::NONE, source, chance)?;
            for (sent, node) in ours.iter_mut().zip(nodes) {
                *sent += u32::from(node.stage() == Stage::Forwarded);
            }
            for (sent, part) in floods.iter_mut().zip(&parts) {
                *sent += u32::from(*part == parts[source.0 as usize]);
            }
        }
        Ok([floods, ours])
    };
    let (fixed, drawn) = (sent_by(Source::Fixed)?, sent_by(Source::Drawn)?);
    Ok(READINGS.map(|(_, receiving, from)| {
        let sent = match from {
            Source::Fixed => &fixed,
            Source::Drawn => &drawn,
        };
        let [flooding, ours] = [0, 1].map(|scheme: usize| f64::from(most(network, &sent[scheme], receiving)));
        flooding / ours
    }))
}

/// The largest spending of any node, in halves of a sending, where the nodes have sent so often.
fn most(network: &Network, sent: &[u32], receiving: Receiving) -> u32 {
    let spent = |(node, &sent_here): (u32, &u32)| match receiving {
        Receiving::Free => 2 * sent_here,
        Receiving::Half => {
            let heard = network.neighbours(NodeId(node)).iter().map(|other| sent[other.0 as usize]);
            2 * sent_here + heard.sum::<u32>()
        }
    };
    (0..).zip(sent).map(spent).max().unwrap_or(0)
}

/// For each node the first of those that links connect to it.
fn parts(network: &Network) -> Vec<u32> {
    let mut parts = vec![u32::MAX; network.nodes()];
    for node in 0..network.nodes() as u32 {
        if parts[node as usize] == u32::MAX {
            for (part, hops) in parts.iter_mut().zip(hops(network, NodeId(node), |_| true)) {
                *part = hops.map_or(*part, |_| node);
            }
        }
    }
    parts
}

impl Lifetime {
    /// Under each reading, over the topologies of one density.
    pub(super) fn of(samples: &[[f64; READINGS.len()]]) -> Vec<Self> {
        let lifetime = |(place, (_, receiving, source))| {
            let ratio = mean(samples.iter().map(|ratios| ratios[place])).unwrap_or(Estimate::NOTHING);
            Self { receiving, source, ratio: rounded(ratio, 1e4) }
        };
        READINGS.into_iter().enumerate().map(lifetime).collect()
    }

    /// The name of its reading.
    pub(super) fn name(&self) -> &'static str {
        let is_it = |&&(_, receiving, source): &&_| (receiving, source) == (self.receiving, self.source);
        READINGS.iter().find(is_it).map_or("", |&(name, ..)| name)
    }

    /// Whether it is longer than by flooding, and not about the same.
    fn is_longer(&self) -> Verdict {
        at_least(1.0 + SAME, self.ratio)
    }
}

/// Whether networks of all densities live longer by k-FNF, reading by reading.
pub(super) fn judged(densities: &[(usize, &[Lifetime])]) -> Vec<Judgement> {
    let judged = |place: usize| {
        let all = densities.iter().filter_map(|&(nodes, lifetimes)| Some((nodes, lifetimes.get(place)?)));
        let (nodes, least) = all.clone().min_by(|(_, one), (_, other)| {
            let [one, other] = [one, other].map(|lifetime| lifetime.ratio.mean);
            one.total_cmp(&other)
        })?;
        let verdict = all.map(|(_, lifetime)| lifetime.is_longer()).fold(Verdict::Holds, Verdict::and);
        Some(Judgement::new(
            format!(
                "“to save energy for prolonging the network lifetime” (1): by {:.0} % or more",
                100.0 * SAME
            ),
            least.name(),
            format!(
                "{} times that by flooding at {}, the least",
                least.ratio.text(2),
                counted(nodes as u32, "node")
            ),
            verdict,
        ))
    };
    (0..READINGS.len()).filter_map(judged).collect()
}

#[cfg(test)]
mod tests {
    use tautline_field::radio::{Area, Field, Model, Point, Radio};
    use tautline_proofs::engine::Tape;

    use super::*;

    #[test]
    fn a_node_spends_by_what_it_sends_and_by_half_of_what_it_hears() {
        // Three in a row, and one apart.
        let area = Area::new(100.0, 1.0).expect("an area");
        let nodes = [0.0, 10.0, 20.0, 90.0].map(|x_m| Point { x_m, y_m: 0.0 });
        let field = Field::new(area, vec![], nodes.into()).expect("a field");
        let radio = Radio::new(10.0, Model::Disc).expect("a radio");
        let network = Network::new(&field, radio, &mut Tape(&[])).expect("a network");
        assert_eq!(parts(&network), [0, 0, 0, 3]);
        let spent =
            |sent: [u32; 4]| [Receiving::Free, Receiving::Half].map(|cost| most(&network, &sent, cost));
        assert_eq!(spent([1, 1, 1, 0]), [2, 4], "the one in the middle hears two");
        assert_eq!(spent([1, 0, 1, 5]), [10, 10], "the one apart hears nobody");
    }
}
