//! Who hears whom, and how far off each seems to be by the strength of its signal.
//!
//! By equation (1) of [Jiang 2011], the kernel's [`Propagation`], the mean power at distance d is 10·α·log₁₀(L/d) dB
//! above what can just be heard, L being the range, and a shadow adds its deviation X to that. So a signal is heard if
//! d·10^(−X/10α) ≤ L, and that product is also the distance that the receiver makes of it: with or without shadows, who
//! seems to be within the range is heard. A shadow is that of a pair of places, the same both ways and for ever.

use std::num::NonZeroU32;

use tautline_grids::chance::{MOST_DEVIATIONS, deviation};
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{NodeId, Propagation};

use super::grid::Grid;
use super::problem::{MAX_RANGE_M, MIN_RANGE_M, Problem, checked_deviation};
use super::{Field, Point};

/// The most pairs that are looked at: their links fit into a gibibyte.
const MAX_PAIRS: u64 = 1 << 28;

/// α of free space.
pub const FREE_SPACE: f64 = Propagation::FREE_SPACE.exponent();

/// How signals spread.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Model {
    /// Everything within the range is heard, and nothing else.
    Disc,
    /// The power falls with the distance to the power of `exponent`, and shadows vary it.
    Shadowed {
        /// α, 2 to 5.
        exponent: f64,
        /// The standard deviation of the shadows, 0 to 20 dB; none is more than three times that.
        deviation_db: f64,
    },
}

/// The radio that all nodes have.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Radio {
    range_m: f64,
    model: Model,
    propagation: Propagation,
}

impl Radio {
    /// A radio of `range_m`: where there are shadows, that without them.
    ///
    /// # Errors
    /// A [`Problem`] if the range, the exponent or the deviation is out of bounds.
    pub fn new(range_m: f64, model: Model) -> Result<Self, Problem> {
        if !(MIN_RANGE_M..=MAX_RANGE_M).contains(&range_m) {
            return Err(Problem::Range { range_m });
        }
        let propagation = match model {
            Model::Disc => Propagation::FREE_SPACE,
            Model::Shadowed { exponent, deviation_db } => {
                checked_deviation(deviation_db)?;
                Propagation::new(exponent).ok_or(Problem::Exponent { exponent })?
            }
        };
        Ok(Self { range_m, model, propagation })
    }

    /// The range in metres.
    pub const fn range_m(self) -> f64 {
        self.range_m
    }

    /// How power falls with the distance. Where the model is a disc, as in free space.
    pub const fn propagation(self) -> Propagation {
        self.propagation
    }

    /// How signals spread.
    pub const fn model(self) -> Model {
        self.model
    }

    /// The range in micrometres, rounded to the nearest.
    pub fn range_um(self) -> NonZeroU32 {
        // It is never less than a millimetre.
        NonZeroU32::new(micrometres(self.range_m)).unwrap_or(NonZeroU32::MIN)
    }

    /// No signal is heard from farther.
    pub fn reach_m(self) -> f64 {
        match self.model {
            Model::Disc => self.range_m,
            Model::Shadowed { deviation_db, .. } => {
                self.range_m * self.propagation.times_as_far(MOST_DEVIATIONS * deviation_db)
            }
        }
    }
}

/// Rounds to the nearest.
const fn micrometres(metres: f64) -> u32 {
    (metres * 1e6 + 0.5) as u32
}

/// One end of a link, as the other hears it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Link {
    /// Who hears.
    pub to: NodeId,
    /// How far off the sender seems to be, in micrometres.
    pub distance_um: u32,
}

/// The links of a field. They are the same both ways.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Network {
    /// Where the links of each node begin, and where those of the last end.
    first: Vec<u32>,
    /// For each node those that hear it, ascending.
    to: Vec<NodeId>,
    distances_um: Vec<u32>,
}

impl Network {
    /// The links of `field` under `radio`. Shadows are drawn pair by pair, in the order of the nodes.
    ///
    /// # Errors
    /// [`Problem::TooDense`] if the links might not fit into memory; nothing of them is allocated then.
    pub fn new(field: &Field, radio: Radio, oracle: &mut dyn Oracle) -> Result<Self, Problem> {
        let points = field.nodes();
        let reach_m = radio.reach_m();
        let grid = Grid::new(field.area(), points, reach_m);
        let pairs = grid.pairs();
        if pairs > MAX_PAIRS {
            return Err(Problem::TooDense { pairs, most: MAX_PAIRS });
        }
        let (ends, links) = (Vec::with_capacity(points.len()), Vec::with_capacity(pairs as usize / 2));
        let mut upper = UpperLinks { ends, links };
        let mut buffer = vec![(0, 0.0); points.len()];
        for (node, &point) in (0..).zip(points) {
            let near = within(&grid, node, point, reach_m, &mut buffer);
            if radio.model != Model::Disc {
                // What is drawn depends on the numbers of the nodes, not on the grid.
                near.sort_unstable_by_key(|&(other, _)| other);
            }
            for &mut (other, squared_m2) in near {
                let apart_m = squared_m2.sqrt();
                let seems_m = match radio.model {
                    Model::Disc => apart_m,
                    Model::Shadowed { deviation_db: standard_db, .. } => {
                        apart_m * radio.propagation.times_as_far(-deviation(standard_db, oracle))
                    }
                };
                if seems_m <= radio.range_m && field.has_way(point, points[other as usize]) {
                    upper.links.push(Link { to: NodeId(other), distance_um: micrometres(seems_m) });
                }
            }
            upper.ends.push(upper.links.len() as u32);
        }
        Ok(upper.both_ways())
    }

    /// How many nodes there are.
    pub fn nodes(&self) -> usize {
        self.first.len() - 1
    }

    /// The node with this number.
    ///
    /// # Errors
    /// [`Problem::NoNode`] if there is none.
    pub fn node(&self, number: u32) -> Result<NodeId, Problem> {
        let nodes = self.nodes();
        ((number as usize) < nodes).then_some(NodeId(number)).ok_or(Problem::NoNode { node: number, nodes })
    }

    fn range(&self, node: NodeId) -> std::ops::Range<usize> {
        let place = node.0 as usize;
        match self.first.get(place..place + 2) {
            Some(&[first, end]) => first as usize..end as usize,
            Some(_) | None => 0..0,
        }
    }

    /// Who hears `node`, ascending. A node that there is not, nobody hears.
    pub fn neighbours(&self, node: NodeId) -> &[NodeId] {
        &self.to[self.range(node)]
    }

    /// The links of `node`, ascending by the other end.
    pub fn links(&self, node: NodeId) -> impl Iterator<Item = Link> {
        let range = self.range(node);
        let ends = self.to[range.clone()].iter().zip(&self.distances_um[range]);
        ends.map(|(&to, &distance_um)| Link { to, distance_um })
    }

    /// How far off two nodes that are linked seem to be to each other, in micrometres; `None` if they are not linked.
    pub fn distance_um(&self, one: NodeId, other: NodeId) -> Option<u32> {
        let place = self.neighbours(one).binary_search(&other).ok()?;
        self.distances_um.get(self.range(one).start + place).copied()
    }

    /// How many nodes are connected to `node` by links, itself included.
    pub fn component(&self, node: NodeId) -> usize {
        let mut is_found = vec![false; self.nodes()];
        let mut found = Vec::new();
        let mut find = |node: NodeId, found: &mut Vec<NodeId>| {
            if let Some(is_found) = is_found.get_mut(node.0 as usize)
                && !std::mem::replace(is_found, true)
            {
                found.push(node);
            }
        };
        find(node, &mut found);
        let mut looked_at = 0;
        while let Some(&node) = found.get(looked_at) {
            looked_at += 1;
            self.neighbours(node).iter().for_each(|&next| find(next, &mut found));
        }
        looked_at
    }
}

/// The nodes with larger numbers than `node` within reach of it, with the squares of their distances. The buffer has
/// room for all nodes. What is out of reach is written, too, and then written over: that is quicker than to ask first.
fn within<'a>(
    grid: &Grid,
    node: u32,
    point: Point,
    reach_m: f64,
    buffer: &'a mut [(u32, f64)],
) -> &'a mut [(u32, f64)] {
    let reach_m2 = reach_m * reach_m;
    let mut found = 0;
    for places in grid.near(point) {
        for place in &grid.places[places] {
            let (along_x, along_y) = (place.point.x_m - point.x_m, place.point.y_m - point.y_m);
            let squared_m2 = along_x * along_x + along_y * along_y;
            buffer[found] = (place.node, squared_m2);
            found += usize::from(squared_m2 <= reach_m2) & usize::from(place.node > node);
        }
    }
    &mut buffer[..found]
}

/// Links to larger numbers, node by node: half of a network.
struct UpperLinks {
    /// For each node, where its links end.
    ends: Vec<u32>,
    /// Those of one node in any order.
    links: Vec<Link>,
}

impl UpperLinks {
    /// The network of these links, both ways. Node by node the smaller ends are put into the lists of the larger ones,
    /// and from these lists, node by node, the larger into those of the smaller: so each list ascends, without sorting.
    fn both_ways(self) -> Network {
        let nodes = self.ends.len();
        let mut first = vec![0; nodes + 1];
        let mut smaller = vec![0; nodes];
        for link in &self.links {
            smaller[link.to.0 as usize] += 1;
        }
        let mut start = 0;
        for (node, &end) in self.ends.iter().enumerate() {
            first[node + 1] = first[node] + smaller[node] + (end - start);
            start = end;
        }
        let links = 2 * self.links.len();
        let (mut to, mut distances_um) = (vec![NodeId(0); links], vec![0; links]);
        let mut next = first.clone();
        let mut start = 0;
        for (node, &end) in (0..).zip(&self.ends) {
            for link in &self.links[start as usize..end as usize] {
                let place = &mut next[link.to.0 as usize];
                to[*place as usize] = NodeId(node);
                distances_um[*place as usize] = link.distance_um;
                *place += 1;
            }
            start = end;
        }
        for (node, &smaller) in (0..).zip(&smaller) {
            let start = first[node as usize];
            for from in start as usize..(start + smaller) as usize {
                let place = &mut next[to[from].0 as usize];
                to[*place as usize] = NodeId(node);
                distances_um[*place as usize] = distances_um[from];
                *place += 1;
            }
        }
        Network { first, to, distances_um }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tautline_proofs::engine::{SeededOracle, Tape};

    use super::*;
    use crate::radio::{Area, Obstacle};

    fn disc(range_m: f64) -> Radio {
        Radio::new(range_m, Model::Disc).expect("a radio")
    }

    fn listed(network: &Network) -> Vec<(u32, u32, u32)> {
        let nodes = (0..network.nodes() as u32).map(NodeId);
        nodes
            .flat_map(|node| network.links(node).map(move |link| (node.0, link.to.0, link.distance_um)))
            .collect()
    }

    /// Every pair, looked at one by one.
    fn all_pairs(field: &Field, range_m: f64) -> Vec<(u32, u32, u32)> {
        let nodes = || (0..).zip(field.nodes());
        nodes()
            .flat_map(|(one, from)| nodes().map(move |(other, to)| (one, other, *from, *to)))
            .filter(|&(one, other, from, to)| {
                one != other && !field.obstacles().iter().any(|obstacle| obstacle.stops(from, to))
            })
            .map(|(one, other, from, to)| (one, other, libm::hypot(from.x_m - to.x_m, from.y_m - to.y_m)))
            .filter(|&(_, _, apart_m)| apart_m <= range_m)
            .map(|(one, other, apart_m)| (one, other, (apart_m * 1e6).round() as u32))
            .collect()
    }

    proptest! {
        #[test]
        fn the_grid_finds_whom_all_pairs_find(
            seed in any::<u64>(), count in 2_usize..200, width in 1.0..300.0, height in 1.0..300.0, range in 0.5..400.0
        ) {
            let area = Area::new(width, height).expect("an area");
            let lake = Obstacle {
                west_m: width * 0.4, north_m: height * 0.4, east_m: width * 0.6, south_m: height * 0.5,
            };
            let mut oracle = SeededOracle::new(seed, 0);
            let field = Field::random(area, vec![lake], count, &mut oracle).expect("a field");
            let network = Network::new(&field, disc(range), &mut oracle).expect("a network");
            let (ours, naive) = (listed(&network), all_pairs(&field, range));
            prop_assert_eq!(ours.len(), naive.len());
            for (ours, naive) in ours.into_iter().zip(naive) {
                prop_assert_eq!((ours.0, ours.1), (naive.0, naive.1));
                prop_assert!(ours.2.abs_diff(naive.2) <= 1);
            }
        }

        #[test]
        fn shadows_are_the_same_both_ways_and_lists_ascend(seed in any::<u64>(), deviation_db in 0.0..8.0) {
            let mut oracle = SeededOracle::new(seed, 0);
            let area = Area::new(100.0, 100.0).expect("an area");
            let field = Field::random(area, vec![], 100, &mut oracle).expect("a field");
            let radio = Radio::new(20.0, Model::Shadowed { exponent: 3.0, deviation_db }).expect("a radio");
            let network = Network::new(&field, radio, &mut oracle).expect("a network");
            let links = listed(&network);
            prop_assert!(links.is_sorted());
            for &(one, other, distance_um) in &links {
                prop_assert!(links.contains(&(other, one, distance_um)) && distance_um <= 20_000_000);
            }
        }
    }

    #[test]
    fn without_deviation_shadows_are_a_disc() {
        let area = Area::new(300.0, 300.0).expect("an area");
        let field = Field::random(area, vec![], 300, &mut SeededOracle::new(1, 1)).expect("a field");
        let plain = Radio::new(25.0, Model::Shadowed { exponent: 2.0, deviation_db: 0.0 }).expect("a radio");
        let [plain, disc] =
            [plain, disc(25.0)].map(|radio| Network::new(&field, radio, &mut Tape(&[])).expect("a network"));
        assert_eq!(plain, disc);
    }

    fn line(places: &[f64]) -> Network {
        let area = Area::new(100.0, 1.0).expect("an area");
        let nodes = places.iter().map(|&x_m| Point { x_m, y_m: 0.5 }).collect();
        let field = Field::new(area, vec![], nodes).expect("a field");
        Network::new(&field, disc(10.0), &mut Tape(&[])).expect("a network")
    }

    #[test]
    fn a_component_is_what_links_connect() {
        let network = line(&[0.0, 20.0, 10.0, 30.001, 40.0]);
        assert_eq!([0, 1, 2, 3, 4].map(|node| network.component(NodeId(node))), [3, 3, 3, 2, 2]);
        assert_eq!(network.component(NodeId(5)), 0);
        assert_eq!(network.node(5), Err(Problem::NoNode { node: 5, nodes: 5 }));
        assert_eq!((network.node(4), network.neighbours(NodeId(u32::MAX - 1))), (Ok(NodeId(4)), &[][..]));
    }

    #[test]
    fn what_is_no_radio_or_too_much_is_refused() {
        for range_m in [0.0, -1.0, 4_000.1, f64::INFINITY] {
            assert_eq!(Radio::new(range_m, Model::Disc), Err(Problem::Range { range_m }));
        }
        assert!(Radio::new(f64::NAN, Model::Disc).is_err());
        let shadowed = |exponent, deviation_db| Radio::new(25.0, Model::Shadowed { exponent, deviation_db });
        assert_eq!(shadowed(1.0, 0.0), Err(Problem::Exponent { exponent: 1.0 }));
        assert_eq!(shadowed(2.0, 20.5), Err(Problem::Deviation { deviation_db: 20.5 }));
        let area = Area::new(1.0, 1.0).expect("an area");
        let crowd = Field::random(area, vec![], 20_000, &mut SeededOracle::new(0, 0)).expect("a field");
        let refused = Network::new(&crowd, disc(2.0), &mut Tape(&[]));
        assert_eq!(refused, Err(Problem::TooDense { pairs: 400_000_000, most: MAX_PAIRS }));
    }
}
