//! The cost of a flood, from the places of the nodes to the last heard over the ideal channel: against looking at every
//! node for every sender, and by the number of nodes at one density. Criterion follows each figure over time; the
//! tables at the end relate them to one another.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::num::NonZeroU32;

use criterion::{BenchmarkId, Criterion};
use tautline_benches::{Cost, Work, group, measure};
use tautline_field::radio::{Area, Channel, Faults, Field, Model, Network, Radio, broadcast};
use tautline_kernel::net::{NodeId, Reception};
use tautline_kernel::notice::{Node, Reaction, Rule, Scheme, Surroundings};
use tautline_proofs::engine::SeededOracle;

/// The work of a flood.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct FloodWork {
    reached: u32,
    receptions: u32,
}

impl Work for FloodWork {
    fn parts(&self) -> u32 {
        self.receptions
    }
}

const RANGE_M: f64 = 25.0;

/// Nodes as dense as 1100 in 300×300 m.
fn field(nodes: u32) -> Field {
    let side_m = 300.0 * (f64::from(nodes) / 1100.0).sqrt();
    let area = Area::new(side_m, side_m).expect("an area");
    Field::random(area, Vec::new(), nodes as usize, &mut SeededOracle::new(1, 0)).expect("a field")
}

fn rule() -> Rule {
    let range_um = NonZeroU32::new((RANGE_M * 1e6) as u32).expect("a range");
    Rule::new(Scheme::Flooding, range_um, 100_000_000)
}

fn flood(field: &Field) -> FloodWork {
    let chance = &mut SeededOracle::new(2, 0);
    let radio = Radio::new(RANGE_M, Model::Disc).expect("a radio");
    let network = Network::new(field, radio, chance).expect("a network");
    let flooded = broadcast(&network, &rule(), Channel::Ideal, &Faults::NONE, NodeId(0), chance);
    let (report, _) = flooded.expect("a source");
    FloodWork { reached: report.reached, receptions: report.air.heard as u32 }
}

/// As [`flood`], with a look at every node for every sender.
fn flood_naively(field: &Field) -> FloodWork {
    let (rule, chance) = (rule(), &mut SeededOracle::new(2, 0));
    let mut nodes: Vec<Node> =
        (0..field.nodes().len() as u32).map(|id| Node::new(NodeId(id), NodeId(0))).collect();
    let mut queue = BinaryHeap::from([Reverse((0, 0))]);
    let mut flooded = FloodWork { reached: 1, receptions: 0 };
    while let Some(Reverse((now_ns, sender))) = queue.pop() {
        let sent = if sender == 0 { nodes[0].originate() } else { nodes[sender].expire(now_ns) };
        let (Some(notice), from) = (sent, field.nodes()[sender]) else { continue };
        for (to, (node, place)) in nodes.iter_mut().zip(field.nodes()).enumerate() {
            let (x, y) = (place.x_m - from.x_m, place.y_m - from.y_m);
            let apart_m = (x * x + y * y).sqrt();
            if apart_m <= RANGE_M && to != sender {
                flooded.receptions += 1;
                let heard = Reception { message: notice, distance_um: (apart_m * 1e6) as u32, now_ns };
                if let Reaction::Armed { at_ns } = node.receive(&rule, heard, Surroundings::none, chance) {
                    flooded.reached += 1;
                    queue.push(Reverse((at_ns, to)));
                }
            }
        }
    }
    flooded
}

/// Ours and the naive way.
fn against_all_pairs(criterion: &mut Criterion) -> [(u32, [Cost<FloodWork>; 2]); 2] {
    let mut group = group(criterion, "against a look at all nodes");
    [1_100, 5_000].map(|nodes| {
        let field = field(nodes);
        let costs = [
            measure(&mut group, BenchmarkId::new("flood", nodes), || flood(&field)),
            measure(&mut group, BenchmarkId::new("naive flood", nodes), || flood_naively(&field)),
        ];
        assert_eq!(costs[0].work.receptions, costs[1].work.receptions, "the same nodes hear the same");
        assert_eq!(costs[0].work.reached, costs[1].work.reached, "the same nodes hear the same");
        (nodes, costs)
    })
}

/// Floods at one density, with more and more nodes.
fn by_size(criterion: &mut Criterion) -> [(u32, Cost<FloodWork>); 5] {
    let mut group = group(criterion, "flood");
    [1_100, 3_300, 10_000, 33_000, 100_000].map(|nodes| {
        let field = field(nodes);
        (nodes, measure(&mut group, BenchmarkId::from_parameter(nodes), || flood(&field)))
    })
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let naive = against_all_pairs(&mut criterion);
    let sizes = by_size(&mut criterion);
    criterion.final_summary();

    println!("\nA flood over the ideal channel, neighbour search included, in milliseconds");
    println!("    nodes  receptions  flood  all pairs  ratio");
    for (nodes, [ours, naive]) in naive {
        let receptions = ours.work.receptions;
        let millis = |cost: &Cost<FloodWork>| cost.micros * f64::from(receptions) / 1e3;
        let (ours, naive) = (millis(&ours), millis(&naive));
        println!("  {nodes:>7} {receptions:>11} {ours:>6.3} {naive:>10.3} {:>6.1}", naive / ours);
    }

    println!("\nNanoseconds for each heard, as dense as 1100 nodes in 300×300 m and a range of 25 m");
    println!("    nodes  receptions     ns");
    for (nodes, cost) in sizes {
        println!("  {nodes:>7} {:>11} {:>6.1}", cost.work.receptions, 1e3 * cost.micros);
    }
}
