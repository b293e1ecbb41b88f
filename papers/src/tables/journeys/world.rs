//! One topology, and what comes of the journeys in it by each way.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{Rule, Scheme};
use tautline_proofs::engine::SeededOracle;

use super::super::notice_fig5::{RANGE_M, SIDE_M};
use super::super::prelude::*;
use tautline_field::radio::{
    Area, Field, LONGEST_WAIT_NS, Lake, Model, Network, Obstacle, Point, Problem, Radio,
};
use tautline_field::rescue::seconds;
use tautline_field::tan::{
    End, Equipment, Journey, NextSensor, ROBOT_REACH, Scans, Site, Tree, hops, shortest_m,
};

/// A way to find to the WFR.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Way {
    /// By the navigation tree of k-FNF.
    Tan,
    /// By the credit field.
    Verma,
    /// By the gradient.
    Reich,
    /// Back and forth.
    Sheu,
}

impl Way {
    /// All, in the order of every table.
    pub const ALL: [Self; 4] = [Self::Tan, Self::Verma, Self::Reich, Self::Sheu];

    /// Its name.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Tan => "TAN",
            Self::Verma => "Verma",
            Self::Reich => "Reich",
            Self::Sheu => "Sheu",
        }
    }
}

settings! {
    /// The settings of the figure; an empty list stands for what the figure has.
    pub struct Settings {
        /// Numbers of nodes [default: 300,500,700,900,1100 for figure 7, else 700]
        pub nodes: Vec<usize> = Vec::new(), list("nodes", whole);
        /// The side of the square, in metres
        pub side_m: f64 = SIDE_M, one("side", "METRES", real);
        /// The radio range, in metres
        pub range_m: f64 = RANGE_M, one("range", "METRES", real);
        /// An obstacle by its sides, and its shape: l, u, c, spiral, ring, or rows of # and . with / between them; may
        /// be given again [default: those of the figure]
        pub obstacles_m: Vec<Lake> = Vec::new(),
            repeated("obstacle", "[SHAPE:]W,N,E,S", |lake| format!("{lake:?}"), str::parse::<Lake>);
        /// The k of k-FNF, whose tree TAN uses
        pub k: Senders = Senders::ONE, one("k", "K", Senders::read);
        /// The standard deviation of the strengths that robots measure, in dB
        pub noise_db: f64 = 0.0, one("noise-db", "DB", real);
        /// When a robot turns its antenna once round
        pub scan: Scans = Scans::Again, word("scan", "WHEN");
        /// Which unvisited sensor Reich's robot goes to next
        pub reich: NextSensor = NextSensor::Least, word("reich", "SENSOR");
        /// How near it comes to a node before it asks for the next, in percent of the range
        pub near_percent: f64 = 1.0, one("near", "PERCENT", percent_of_range);
        /// Topologies for each number of nodes
        pub topologies: u32 = 200, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of all topologies
        pub seed: u64 = 0, one("seed", "SEED", number);
    }
}

fn percent_of_range(text: &str) -> Result<f64, &'static str> {
    text.parse()
        .ok()
        .filter(|percent| (0.01..=100.0).contains(percent))
        .ok_or("write a number from 0.01 to 100")
}

/// A topology with a robot as the last node of its field.
pub(super) struct World {
    pub(super) field: Field,
    network: Network,
    equipment: Equipment,
    reich: NextSensor,
    rule: Rule,
    robot: NodeId,
    wfr: NodeId,
    /// The seed of all topologies, and which of them it is.
    stream: (u64, u64),
}

/// The outcome of one topology.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Sample {
    /// The fewest hops from the robot to the WFR, if links lead there.
    pub(super) fewest_hops: Option<u16>,
    /// Those of TAN's tree.
    pub(super) tree_hops: Option<u16>,
    /// In metres, if there is a way at all.
    pub(super) shortest_m: Option<f64>,
    /// Those who arrive, in the order of [`Way::ALL`].
    pub(super) walked: [Option<Walk>; 4],
}

/// A robot's walk until it was there.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub(super) struct Walk {
    pub(super) length_m: f64,
    pub(super) time_s: Option<f64>,
}

impl Walk {
    fn of(journey: &Journey) -> Option<Self> {
        let time_s = journey.time_ns.map(seconds);
        (journey.end == End::Arrived).then_some(Self { length_m: journey.length_m, time_s })
    }
}

impl World {
    pub(super) fn new(settings: &Settings, nodes: usize, topology: u32) -> Result<Self, Problem> {
        let area = Area::new(settings.side_m, settings.side_m)?;
        let radio = Radio::new(settings.range_m, Model::Disc)?;
        let stream = (settings.seed, u64::from(topology));
        let chance = &mut SeededOracle::new(stream.0, 2 * stream.1);
        let parts = settings.obstacles_m.iter().flat_map(|Lake(parts)| parts);
        let obstacles: Vec<Obstacle> = parts.copied().map(Into::into).collect();
        let field = Field::random(area, obstacles, nodes, chance)?;
        let field = field.with(&[field.place(chance)?])?;
        let network = Network::new(&field, radio, chance)?;
        let Senders(k) = settings.k;
        let near_m = (ROBOT_REACH - 1.0) * settings.near_percent * radio.range_m();
        let equipment = Equipment::near(radio, settings.noise_db, near_m)?;
        Ok(Self {
            equipment: Equipment { scans: settings.scan, ..equipment },
            reich: settings.reich,
            rule: Rule::new(Scheme::Farthest { k: Some(k) }, radio.range_um(), LONGEST_WAIT_NS),
            robot: NodeId(nodes as u32),
            wfr: NodeId(chance.pick(nodes as u32)),
            field,
            network,
            stream,
        })
    }

    fn site(&self) -> Site<'_> {
        Site { field: &self.field, network: &self.network, equipment: self.equipment }
    }

    /// The stream of answers from whose start the broadcast and each journey draw; it is not that of the topology.
    fn chance(&self) -> SeededOracle {
        let (seed, topology) = self.stream;
        SeededOracle::new(seed, 2 * topology + 1)
    }

    pub(super) fn tree(&self) -> Result<Tree, Problem> {
        let ends = (self.wfr, self.robot);
        Tree::grow(&self.network, self.rule, ends, &mut self.chance())
    }

    pub(super) fn journey(&self, tree: &Tree, way: Way) -> Journey {
        match way {
            Way::Tan => self.site().tan(tree, self.wfr, &mut self.chance()),
            Way::Verma => self.site().verma(self.wfr),
            Way::Reich => self.site().reich(self.wfr, self.reich, &mut self.chance()),
            Way::Sheu => self.site().sheu(self.wfr, &mut self.chance()),
        }
    }

    pub(super) fn goal(&self) -> Point {
        self.field.nodes()[self.wfr.0 as usize]
    }

    pub(super) fn shortest_m(&self) -> Option<f64> {
        shortest_m(&self.field, self.site().start(), self.goal())
    }
}

impl Sample {
    pub(super) fn of(world: &World) -> Result<Self, Problem> {
        let tree = world.tree()?;
        let walked = Way::ALL.map(|way| Walk::of(&world.journey(&tree, way)));
        let hops = hops(&world.network, world.wfr, |node| node != world.robot);
        let fewest_hops = hops.last().copied().flatten();
        let tree_hops = tree.entry().map(|(_, hops)| hops);
        Ok(Self { fewest_hops, tree_hops, shortest_m: world.shortest_m(), walked })
    }

    /// The metres of the shortest way, and what was walked, if all arrive.
    pub(super) fn all(&self) -> Option<(f64, [Walk; 4])> {
        let [tan, verma, reich, sheu] = self.walked;
        Some((self.shortest_m?, [tan?, verma?, reich?, sheu?]))
    }
}
