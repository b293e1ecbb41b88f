//! Journeys by the schemes that [Jiang 2011] compares TAN with or tells of (2.1). All of them flood the whole network,
//! so that every node that links connect to the goal knows its hops. What the paper leaves open:
//!
//! - Verma's robot goes all the way to the place that it has calculated. Where it hears nobody nearer to the goal than
//!   before, or an obstacle is in the way, it goes to the nearest of the neighbours with the least hops, or to the last
//!   one that it has heard: at that node it hears whom the node hears.
//! - Reich's robot finds a neighbour by the antenna and the steps of TAN: the paper does not say how else, without
//!   positions. A neighbour that it cannot find it takes for visited.
//! - Sheu's robot follows the guide nodes from the first neighbour of least hops on, each the least neighbour one hop
//!   nearer of the one before, with an antenna that hears the same all round.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{NodeId, RobotId};
use tautline_kernel::tan::{Heading, Nav};

use super::back_and_forth::{BackAndForth, Walk};
use super::ear::apart_m;
use super::gradient::{Gradient, NextSensor, Position, Station, reich, verma};
use super::journey::MOST_ACTS;
use super::walker::{Trail, ahead, is_open};
use super::{Antenna, End, Journey, Signal, Site, Walker, hops};
use crate::radio::Point;

/// The hops of a neighbour, and which it is.
type Neighbour = (u16, NodeId);

fn position(point: Point) -> Position {
    let micrometres = |metres: f64| (metres * 1e6).round() as i64;
    Position { x_um: micrometres(point.x_m), y_um: micrometres(point.y_m) }
}

#[expect(clippy::cast_precision_loss, reason = "no field has a side of more than 2^53 µm")]
fn point(position: Position) -> Point {
    let metres = |micrometres: i64| micrometres as f64 / 1e6;
    Point { x_m: metres(position.x_um), y_m: metres(position.y_um) }
}

fn sorted(neighbours: impl Iterator<Item = Neighbour>) -> Vec<Neighbour> {
    let mut neighbours: Vec<Neighbour> = neighbours.collect();
    neighbours.sort_unstable();
    neighbours
}

impl Site<'_> {
    /// The hops of each node from `goal` as after a flood, of which the robot sends nothing on.
    fn hops(&self, goal: NodeId) -> Vec<Option<u16>> {
        hops(self.network, goal, |node| node != self.robot())
    }

    /// The nodes that are linked to a node and know their hops, the least of them first.
    fn linked(&self, node: NodeId, hops: &[Option<u16>]) -> Vec<Neighbour> {
        let neighbours = self.network.neighbours(node).iter().filter(|&&node| node != self.robot());
        let neighbours = neighbours.filter_map(|&node| Some((hops[node.0 as usize]?, node)));
        sorted(neighbours)
    }

    /// The nodes heard from a place between nodes, where no shadow is known.
    fn heard(&self, from: Point, hops: &[Option<u16>]) -> Vec<Neighbour> {
        let nodes = (0..).map(NodeId).zip(self.field.nodes()).zip(hops);
        sorted(nodes.filter_map(|((node, &at), hops)| {
            let is_heard = || self.equipment.ear.hears(self.field, Signal::plain(at), from);
            hops.filter(|_| node != self.robot() && is_heard()).map(|hops| (hops, node))
        }))
    }

    /// The journey by Verma's credit field.
    pub fn verma(&self, goal: NodeId) -> Journey {
        let hops = self.hops(goal);
        let mut trail = Trail::new(self.start());
        let mut neighbours = self.linked(self.robot(), &hops);
        if neighbours.is_empty() {
            return Journey::none(self.start());
        }
        // The least hops heard so far, and the node to which the robot can go at any time.
        let (mut fewest, mut guide) = (u16::MAX, self.robot());
        let end = loop {
            let at = trail.end();
            let has_gained = neighbours.first().is_some_and(|&(least, _)| least < fewest);
            let nearest = neighbours.iter().filter(|&&(hops, _)| hops <= fewest).min_by(|one, other| {
                let apart_m = |&(_, node): &Neighbour| apart_m(self.field.at(node), at);
                one.0.cmp(&other.0).then(apart_m(one).total_cmp(&apart_m(other)))
            });
            (fewest, guide) = nearest.copied().unwrap_or((fewest, guide));
            let stations =
                neighbours.iter().map(|&(hops, node)| Station { at: position(self.field.at(node)), hops });
            let middle = verma(stations).map(point);
            match middle.filter(|&middle| has_gained && is_open(self.field, at, middle)) {
                Some(middle) => {
                    trail.go_straight(middle);
                    neighbours = self.heard(middle, &hops);
                }
                None if self.field.at(guide) == at || !is_open(self.field, at, self.field.at(guide)) => {
                    break End::Lost;
                }
                None => {
                    trail.go_straight(self.field.at(guide));
                    neighbours = self.linked(guide, &hops);
                }
            }
            if trail.end() == self.field.at(goal) {
                break End::Arrived;
            }
        };
        Journey { end, trail: trail.points, length_m: trail.length_m, time_ns: None }
    }

    /// The journey by Reich's gradient.
    pub fn reich(&self, goal: NodeId, order: NextSensor, chance: &mut dyn Oracle) -> Journey {
        let hops = self.hops(goal);
        let start = self.start();
        let mut visited = vec![false; self.field.nodes().len()];
        let mut place = self.robot();
        // The nodes through which it has come, where it goes back.
        let mut way = Vec::new();
        let mut journey = Journey { time_ns: Some(0), ..Journey::none(start) };
        journey.end = loop {
            let at = journey.trail.last().copied().unwrap_or(start);
            let neighbours = self.network.neighbours(place).iter().filter(|&&node| {
                let signal = self.signal(node, place);
                node != self.robot() && self.equipment.ear.hears(self.field, signal, at)
            });
            let gradient = |&node: &NodeId| {
                let visited = visited[node.0 as usize];
                hops[node.0 as usize].map(|hops| Gradient { node, hops, visited })
            };
            let ahead = reich(order, neighbours.filter_map(gradient));
            let Some(next) = ahead.or_else(|| way.pop()) else {
                let has_set_out = place != self.robot() || visited.contains(&true);
                break if has_set_out { End::Lost } else { End::Unaware };
            };
            visited[next.0 as usize] = true;
            // One node is a tree of its own, one hop away.
            let nav = Nav { wfr: next, node: next, hops: 0, parent: next };
            let mut walker = Walker::new(self.equipment, at, RobotId(0), next, (next, 1));
            let (end, time_ns) = self.walk(&mut walker, place, &|_| Some(nav), chance);
            journey.trail.extend(&walker.trail()[1..]);
            journey.length_m += walker.walked_m();
            journey.time_ns = journey.time_ns.map(|so_far| so_far + time_ns);
            match end {
                End::Arrived if next == goal => break end,
                End::Arrived => {
                    if order == NextSensor::LargestAndBack && ahead.is_some() && place != self.robot() {
                        way.push(place);
                    }
                    place = next;
                }
                End::Lost | End::Unaware => {}
                End::Astray => break end,
            }
        };
        journey
    }

    /// The journey by Sheu's back-and-forth.
    pub fn sheu(&self, goal: NodeId, chance: &mut dyn Oracle) -> Journey {
        let hops = self.hops(goal);
        let mut trail = Trail::new(self.start());
        let mut place = self.robot();
        let end = loop {
            let Some(&(hops, guide)) = self.linked(place, &hops).first() else { break End::Unaware };
            match self.back_and_forth(self.signal(guide, place), &mut trail, chance) {
                End::Arrived if hops == 0 => break End::Arrived,
                End::Arrived => place = guide,
                end @ (End::Lost | End::Astray | End::Unaware) => break end,
            }
        };
        Journey { end, trail: trail.points, length_m: trail.length_m, time_ns: None }
    }

    /// Walks to one guide node.
    fn back_and_forth(&self, signal: Signal, trail: &mut Trail, chance: &mut dyn Oracle) -> End {
        let ear = &self.equipment.ear;
        let antenna = &Antenna::ALL_ROUND;
        let listen = |at: Point, heading: Heading, chance: &mut dyn Oracle| {
            ear.strength(self.field, signal, at, (antenna, heading), chance)
        };
        let first = Heading::FIRST.turned(chance.pick(u32::from(Heading::COUNT)) as u8);
        let Some(mut last) = listen(trail.end(), first, chance) else { return End::Lost };
        let mut robot = BackAndForth::new(first, last, ear.expected(antenna, self.equipment.near_m));
        let mut acts = 0;
        while let Walk::Step(heading) = robot.order() {
            acts += 1;
            if acts > MOST_ACTS {
                return End::Astray;
            }
            let stride_m = self.equipment.stride_m(antenna, last);
            let to = ahead(trail.end(), heading, stride_m);
            let heard = is_open(self.field, trail.end(), to).then(|| {
                trail.go(to, heading, stride_m);
                listen(to, heading, chance)
            });
            last = heard.flatten().unwrap_or(last);
            robot = robot.measure(heard.flatten());
        }
        End::Arrived
    }
}
