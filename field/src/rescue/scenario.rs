//! A rescue laid out: the field with its links, who calls when, where the robots are, and what will fail.

use std::num::NonZeroU32;

use tautline_kernel::choice::Oracle;
use tautline_kernel::mrc::Rule;
use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{self, Count, Scheme};

use super::problem::MAX_STATES;
use super::{CallTimes, MAX_EVENTS, MAX_ROBOTS, MAX_WFRS, Problem, SchemeName, Setting};
use crate::radio::{
    self, Area, Channel, Faults, Field, Grid, LONGEST_WAIT_NS, Link, Model, Network, Obstacle, Point, Radio,
};
use crate::tan::{Equipment, ROBOT_REACH, Signal, hops};
use tautline_grids::chance::Probability;
use tautline_sim::explore::RuleName;

/// The threshold of the distance-based scheme, in tenths of the range: the larger of the paper's two.
const THRESHOLD_TENTHS: u64 = 8;

/// Whatever happens at a random time happens within so many milliseconds of the beginning, or of what it follows: ten
/// minutes.
const EARLY_MS: u32 = 600_000;

const MILLISECOND_NS: u64 = 1_000_000;

/// A rescue laid out.
pub(super) struct Scenario {
    pub(super) rule: Rule,
    pub(super) broadcast: notice::Rule,
    pub(super) radio: Radio,
    pub(super) noise_db: f64,
    pub(super) equipment: Equipment,
    pub(super) field: Field,
    pub(super) network: Network,
    /// The nodes that hear a robot are near it.
    pub(super) grid: Grid,
    pub(super) channel: Channel,
    pub(super) faults: Faults,
    pub(super) wfrs: Vec<Caller>,
    pub(super) robots: Vec<Place>,
    /// The nodes that fail, and when.
    pub(super) failing: Vec<(NodeId, u64)>,
}

/// A node that calls.
pub(super) struct Caller {
    pub(super) node: NodeId,
    /// When the first event happens.
    pub(super) at_ns: u64,
    /// For each further event how long after the service of the one before it happens.
    pub(super) pauses_ns: Vec<u64>,
    /// Hops from it to the node farthest off that links connect with it.
    pub(super) depth: u16,
}

impl Caller {
    pub(super) fn new(network: &Network, node: NodeId, at_ns: u64) -> Self {
        let depth = hops(network, node, |_| true).into_iter().flatten().max();
        Self { node, at_ns, pauses_ns: Vec::new(), depth: depth.unwrap_or(0) }
    }
}

/// Where a robot begins, and when it fails, if it does.
pub(super) struct Place {
    pub(super) at: Point,
    pub(super) fails_ns: Option<u64>,
}

impl Setting {
    /// Lays the rescue out. What is not given is drawn.
    pub(super) fn lay_out(&self, chance: &mut dyn Oracle) -> Result<Scenario, Problem> {
        self.check()?;
        let [width_m, height_m] = self.area_m;
        let obstacles = self.obstacles_m.iter().copied().map(Obstacle::from).collect();
        let radio = Radio::new(self.range_m, self.model())?;
        let range_um = radio.range_um();
        let (rule, conditions) = match self.rule {
            RuleName::Published => (Rule::PUBLISHED, notice::Conditions::PUBLISHED),
            RuleName::Repaired => (Rule::REPAIRED, notice::Conditions::REPAIRED),
        };
        let scheme = self.scheme(range_um)?;
        let loss =
            Probability::new(self.loss).ok_or(radio::Problem::Probability { probability: self.loss })?;
        let faults = Faults::NONE.with_loss(loss);
        let faults = if self.noise_db == 0.0 {
            faults
        } else {
            faults.with_noise(self.noise_db, radio.propagation())?
        };
        let field = Field::random(Area::new(width_m, height_m)?, obstacles, self.nodes, chance)?;
        let network = Network::new(&field, radio, chance)?;
        let grid = Scenario::grid(&field, radio);
        let mut wfrs = self.wfrs(&network, chance)?;
        let robots = self.robots(&field, chance)?;
        let others = (0..self.nodes as u32)
            .map(NodeId)
            .filter(|node| wfrs.iter().all(|wfr| wfr.node != *node))
            .collect();
        let failing = drawn(self.failing_nodes, others, chance)
            .into_iter()
            .map(|node| (node, early_ns(chance)))
            .collect();
        // Last, so that the first events are the same however many follow.
        for caller in &mut wfrs {
            caller.pauses_ns = (1..self.events_per_wfr).map(|_| early_ns(chance)).collect();
        }
        Ok(Scenario {
            rule,
            broadcast: notice::Rule { conditions, ..notice::Rule::new(scheme, range_um, LONGEST_WAIT_NS) },
            radio,
            noise_db: self.noise_db,
            equipment: Equipment::new(radio, self.noise_db)?,
            field,
            network,
            grid,
            channel: self.channel.channel(),
            faults,
            wfrs,
            robots,
            failing,
        })
    }

    /// The first fault that the numbers alone show.
    fn check(&self) -> Result<(), Problem> {
        let Self { nodes, wfrs, robots, events_per_wfr: events, failing, failing_nodes, .. } = *self;
        if !(1..=MAX_ROBOTS).contains(&robots) {
            return Err(Problem::Robots { robots });
        }
        if self.robots_at_m.len() > robots {
            return Err(Problem::RobotPlaces { places: self.robots_at_m.len(), robots });
        }
        if failing > robots {
            return Err(Problem::Failing { failing, robots });
        }
        if !(2..=radio::MAX_NODES).contains(&nodes) {
            return Err(Problem::Field(radio::Problem::Nodes { nodes }));
        }
        if !(1..=MAX_WFRS).contains(&wfrs) {
            return Err(Problem::Wfrs { wfrs, nodes });
        }
        if wfrs > nodes {
            return Err(Problem::WfrsOfNodes { wfrs, nodes });
        }
        if !(1..=MAX_EVENTS).contains(&events) {
            return Err(Problem::Events { events });
        }
        if self.wfrs_at.len() > wfrs {
            return Err(Problem::WfrPlaces { places: self.wfrs_at.len(), wfrs });
        }
        if failing_nodes > nodes - wfrs {
            return Err(Problem::FailingNodes { failing: failing_nodes, others: nodes - wfrs });
        }
        if nodes * wfrs > MAX_STATES {
            return Err(Problem::TooLarge { nodes, wfrs });
        }
        Ok(())
    }

    fn scheme(&self, range_um: NonZeroU32) -> Result<Scheme, Problem> {
        let Self { k, scheme, .. } = *self;
        let too_many = |most: u8| Problem::K { k, scheme, most };
        match scheme {
            SchemeName::KFnf => {
                let k = Count::new(k).ok_or(too_many(Count::MOST))?;
                Ok(Scheme::Farthest { k: Some(k) })
            }
            SchemeName::Flooding => Ok(Scheme::Flooding),
            SchemeName::Counter => {
                // The first is counted here.
                let below = k.checked_add(1).filter(|_| k > 0).and_then(Count::new);
                Ok(Scheme::Counter { below: below.ok_or(too_many(Count::MOST - 1))? })
            }
            SchemeName::Distance => {
                let least_um = u64::from(range_um.get()) * THRESHOLD_TENTHS / 10;
                Ok(Scheme::Distance { least_um: least_um as u32 })
            }
            SchemeName::Sba => Ok(Scheme::Scalable),
        }
    }

    fn wfrs(&self, network: &Network, chance: &mut dyn Oracle) -> Result<Vec<Caller>, Problem> {
        let mut nodes: Vec<NodeId> = Vec::with_capacity(self.wfrs);
        for &number in &self.wfrs_at {
            let node = network.node(number)?;
            if nodes.contains(&node) {
                return Err(Problem::WfrTwice { node: number });
            }
            nodes.push(node);
        }
        let others = (0..self.nodes as u32).map(NodeId).filter(|node| !nodes.contains(node)).collect();
        nodes.extend(drawn(self.wfrs - nodes.len(), others, chance));
        let caller = |node| {
            let at_ns = match self.calls {
                CallTimes::Together => 0,
                CallTimes::Spread => early_ns(chance),
            };
            Caller::new(network, node, at_ns)
        };
        Ok(nodes.into_iter().map(caller).collect())
    }

    fn robots(&self, field: &Field, chance: &mut dyn Oracle) -> Result<Vec<Place>, Problem> {
        let mut places = Vec::with_capacity(self.robots);
        for (robot, &[x_m, y_m]) in (1..).zip(&self.robots_at_m) {
            let at = Point { x_m, y_m };
            if !field.area().contains(at) {
                return Err(Problem::RobotOutside { robot, x_m, y_m });
            }
            if field.obstacles().iter().any(|obstacle| obstacle.contains(at)) {
                return Err(Problem::RobotBlocked { robot });
            }
            places.push(Place { at, fails_ns: None });
        }
        while places.len() < self.robots {
            places.push(Place { at: field.place(chance)?, fails_ns: None });
        }
        for robot in drawn(self.failing, (0..self.robots).collect(), chance) {
            places[robot].fails_ns = Some(early_ns(chance));
        }
        Ok(places)
    }
}

/// `count` of `from`, each as likely as any other.
fn drawn<T>(count: usize, mut from: Vec<T>, chance: &mut dyn Oracle) -> Vec<T> {
    (0..count.min(from.len())).map(|_| from.swap_remove(chance.pick(from.len() as u32) as usize)).collect()
}

fn early_ns(chance: &mut dyn Oracle) -> u64 {
    u64::from(chance.pick(EARLY_MS)) * MILLISECOND_NS
}

impl Scenario {
    /// The nodes of `field`, so that those are found that a robot hears.
    pub(super) fn grid(field: &Field, radio: Radio) -> Grid {
        Grid::new(field.area(), field.nodes(), ROBOT_REACH * radio.reach_m())
    }

    /// How many events happen at each WFR.
    pub(super) fn events(&self) -> usize {
        1 + self.wfrs.first().map_or(0, |caller| caller.pauses_ns.len())
    }

    /// Which of the WFRs a node is.
    pub(super) fn wfr(&self, node: NodeId) -> Option<usize> {
        self.wfrs.iter().position(|wfr| wfr.node == node)
    }

    /// A node as a robot hears it that was last at `place`: with the shadow between the two, if they are linked.
    /// Otherwise, and before it was at a node, without shadow.
    #[inline]
    pub(super) fn signal(&self, node: NodeId, place: Option<NodeId>) -> Signal {
        match (self.radio.model(), place) {
            (Model::Shadowed { .. }, Some(place)) => Signal::near(&self.field, &self.network, node, place),
            (Model::Disc, _) | (Model::Shadowed { .. }, None) => Signal::plain(self.field.at(node)),
        }
    }

    /// The link of a robot with another station; `None` if they do not hear each other.
    #[inline]
    pub(super) fn link(&self, to: NodeId, signal: Signal, robot: Point) -> Option<Link> {
        let is_heard = self.equipment.ear.hears(&self.field, signal, robot);
        is_heard.then(|| Link { to, distance_um: (signal.seems_m(robot) * 1e6 + 0.5) as u32 })
    }
}
