//! A whole journey over a network in which nothing goes wrong: no packet is lost, and nothing fails.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{NodeId, RobotId};
use tautline_kernel::tan::{Nav, Order, Stage};

use super::{Equipment, Signal, Tree, Walker};
use crate::radio::{Field, Network, Point};

/// The most that a robot does on its way to one node before it is taken to go in circles.
pub(super) const MOST_ACTS: u32 = 1_000_000;

/// How a journey ended.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum End {
    /// The robot is at the WFR.
    Arrived,
    /// It never heard of the call, or no link leads to the WFR: it did not set out.
    Unaware,
    /// It does not know where to go next.
    Lost,
    /// It goes in circles.
    Astray,
}

/// The outcome of a journey.
#[derive(Clone, PartialEq, Debug)]
pub struct Journey {
    /// How it ended.
    pub end: End,
    /// Where the robot was: its start, each place where it turned, and its end.
    pub trail: Vec<Point>,
    /// How far it walked, in metres.
    pub length_m: f64,
    /// How long it took, in nanoseconds; rivals that the paper does not give a clock have none.
    pub time_ns: Option<u64>,
}

/// Where journeys take place: a field whose last node is a robot at its start, and the links of all. Where it starts,
/// the robot hears whom a node would hear there.
#[derive(Clone, Copy, Debug)]
pub struct Site<'a> {
    /// Nodes and obstacles.
    pub field: &'a Field,
    /// Who hears whom.
    pub network: &'a Network,
    /// The robot's.
    pub equipment: Equipment,
}

impl Site<'_> {
    /// The node that is the robot.
    pub fn robot(&self) -> NodeId {
        NodeId(self.field.nodes().len().saturating_sub(1) as u32)
    }

    /// Where it begins.
    pub fn start(&self) -> Point {
        self.field.at(self.robot())
    }

    /// The signal of `node` as it is heard near `place`.
    pub(super) fn signal(&self, node: NodeId, place: NodeId) -> Signal {
        Signal::near(self.field, self.network, node, place)
    }

    /// The journey by TAN through `tree`.
    pub fn tan(&self, tree: &Tree, wfr: NodeId, chance: &mut dyn Oracle) -> Journey {
        let start = self.start();
        let Some(entry) = tree.entry() else { return Journey::none(start) };
        let mut walker = Walker::new(self.equipment, start, RobotId(0), wfr, entry);
        let (end, time_ns) = self.walk(&mut walker, self.robot(), &|node| tree.nav(node), chance);
        Journey { end, length_m: walker.walked_m(), trail: walker.trail().to_vec(), time_ns: Some(time_ns) }
    }

    /// Walks from near `place` until there is nothing more to do; `nav` is what each node answers.
    pub(super) fn walk(
        &self,
        walker: &mut Walker,
        place: NodeId,
        nav: &dyn Fn(NodeId) -> Option<Nav>,
        chance: &mut dyn Oracle,
    ) -> (End, u64) {
        // The signals of the nodes asked so far, the last one that of the node asked last for the first time.
        let mut signals: Vec<(NodeId, Signal)> = Vec::new();
        let signal = |node: NodeId, signals: &mut Vec<(NodeId, Signal)>| {
            if let Some(&(_, signal)) = signals.iter().find(|&&(known, _)| known == node) {
                return signal;
            }
            let last = signals.last().map_or(place, |&(last, _)| last);
            signals.push((node, self.signal(node, last)));
            self.signal(node, last)
        };
        let (mut time_ns, mut acts) = (0, 0);
        while acts < MOST_ACTS {
            acts += 1;
            match walker.order() {
                Order::Ask(request) => {
                    acts = 0;
                    time_ns += self.equipment.gait.answer_ns;
                    let signal = signal(request.node, &mut signals);
                    let is_heard = self.equipment.ear.hears(self.field, signal, walker.at());
                    match nav(request.node).filter(|_| is_heard) {
                        Some(nav) => walker.hear(nav),
                        None => walker.expire(),
                    }
                }
                Order::Point(_) | Order::Walk(_) => {
                    let signal = walker.guide().map(|guide| signal(guide, &mut signals));
                    time_ns += walker.act(self.field, signal, chance);
                }
                Order::Stop => {
                    let has_arrived = walker.stage() == Stage::Arrived;
                    return (if has_arrived { End::Arrived } else { End::Lost }, time_ns);
                }
            }
        }
        (End::Astray, time_ns)
    }
}

impl Journey {
    /// One that did not begin.
    pub(super) fn none(start: Point) -> Self {
        Self { end: End::Unaware, trail: vec![start], length_m: 0.0, time_ns: None }
    }
}
