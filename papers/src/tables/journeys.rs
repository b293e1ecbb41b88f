//! Journeys of a robot to the node that waits for rescue [Jiang 2011, 4.3 and 4.4]: how far it walks by TAN, by Verma's
//! and Reich's schemes, and by Sheu's, of which the paper only tells. Figure 7 is the ratio RD of what robots walk to
//! the shortest ways there; figures 6, 9 and 10 are pictures of single journeys, the last two round obstacles, which
//! here stand beside the same measurement. Every way is walked in the same topologies, from the same place to the same
//! node.
//!
//! The paper says of its figures that RD of TAN is very close to Verma's and smaller than Reich's in some cases (4.3),
//! and of its Table 2 that TAN's way is shorter than Verma's and about as long as Reich's (4.4). Each of the four is
//! decided by the 95 % interval of the difference in the same topologies.

mod claims;
mod density;
mod drawn;
mod text;
mod world;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::claims::{Claim, Decision, Verdict};
pub use self::density::{Density, Line};
pub use self::world::Sample;
use self::world::World;
use super::notice_fig5::{NODES, RANGE_M, SIDE_M};
use super::parameter::{Given, Parameter, Senders, Values, all_shown, put, put_all, shown};
use super::{About, Chart, Observer, Table, usage};
use tautline_sim::diagnostic::Halt;
use tautline_sim::value_parser::{Metres, number, real, whole, within};

/// Figure 6.
pub const RESCUE_FIG6: Journeys = Journeys {
    figure: Figure::Trajectories,
    id: "rescue-fig6",
    shows: "the ways of a robot to the node that waits for rescue by Reich's scheme, TAN and Verma's, as a picture",
    help: "The ways of a robot by Reich's scheme, TAN and Verma's, as a picture",
};

/// Figure 7.
pub const RESCUE_FIG7: Journeys = Journeys {
    figure: Figure::Ratios,
    id: "rescue-fig7",
    shows: "how many metres a robot walks for each metre of the shortest way by TAN, Verma's, Reich's and Sheu's schemes, \
            by the number of nodes, and what becomes of the paper's words about it",
    help: "How far a robot walks by TAN and its rivals, by the number of nodes",
};

/// Figure 9.
pub const RESCUE_FIG9: Journeys = Journeys {
    figure: Figure::OneObstacle,
    id: "rescue-fig9",
    shows: "the ways of a robot round a large obstacle: how many arrive, and how far they walk",
    help: "How far a robot walks round a large obstacle",
};

/// Figure 10.
pub const RESCUE_FIG10: Journeys = Journeys {
    figure: Figure::FourObstacles,
    id: "rescue-fig10",
    shows: "the ways of a robot round four large obstacles: how many arrive, and how far they walk",
    help: "How far a robot walks round four large obstacles",
};

/// Journeys of a robot to the node that waits for rescue.
#[derive(Clone, Copy, Debug)]
pub struct Journeys {
    figure: Figure,
    id: &'static str,
    shows: &'static str,
    help: &'static str,
}

/// The figures.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Figure {
    /// Figure 6: journeys by three ways in one topology.
    Trajectories,
    /// Figure 7: RD by the number of nodes.
    Ratios,
    /// Figure 9: round one obstacle.
    OneObstacle,
    /// Figure 10: round four.
    FourObstacles,
}

impl Figure {
    /// The numbers of nodes: those of the paper, or, where it gives none, the middle one.
    fn nodes(self) -> Vec<usize> {
        match self {
            Self::Ratios => NODES.to_vec(),
            Self::Trajectories | Self::OneObstacle | Self::FourObstacles => vec![700],
        }
    }

    /// West, north, east and south of the obstacles, for the paper's square of 300 m. The paper draws its own; these
    /// are ours: large lakes that stop signals and robots.
    fn obstacles(self) -> Vec<[f64; 4]> {
        match self {
            Self::Trajectories | Self::Ratios => Vec::new(),
            Self::OneObstacle => vec![[100.0, 90.0, 200.0, 210.0]],
            Self::FourObstacles => vec![
                [40.0, 50.0, 130.0, 120.0],
                [170.0, 30.0, 240.0, 130.0],
                [60.0, 170.0, 120.0, 270.0],
                [160.0, 180.0, 260.0, 240.0],
            ],
        }
    }

    /// The journeys of its picture.
    fn drawn(self) -> &'static [Way] {
        match self {
            Self::Trajectories | Self::Ratios => &[Way::Reich, Way::Tan, Way::Verma],
            Self::OneObstacle | Self::FourObstacles => &[Way::Tan],
        }
    }
}

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

/// What is measured.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Numbers of nodes; none for those of the figure.
    pub nodes: Vec<usize>,
    /// The side of the square, in metres.
    pub side_m: f64,
    /// The radio range, in metres.
    pub range_m: f64,
    /// West, north, east and south of what stops signals and robots, in metres; none for those of the figure.
    pub obstacles_m: Vec<[f64; 4]>,
    /// The k of the broadcast that leaves TAN its tree.
    pub k: Senders,
    /// The standard deviation of the strengths that robots measure, in dB.
    pub noise_db: f64,
    /// Topologies for each number of nodes.
    pub topologies: u32,
    /// The seed of all of them.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            side_m: SIDE_M,
            range_m: RANGE_M,
            obstacles_m: Vec::new(),
            k: Senders::ONE,
            noise_db: 0.0,
            topologies: 200,
            seed: 0,
        }
    }
}

/// One topology at one number of nodes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    /// The place of the number of nodes.
    density: usize,
    topology: u32,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    side_m: f64,
    range_m: f64,
    /// West, north, east and south of each, in metres.
    obstacles: Vec<[f64; 4]>,
    k: Senders,
    noise_db: f64,
    topologies: u32,
    seed: u64,
    /// Density by density.
    pub densities: Vec<Density>,
}

impl Journeys {
    /// The settings with what the figure has where nothing was asked for.
    fn whole(&self, settings: &Settings) -> Settings {
        let mut whole = settings.clone();
        if whole.nodes.is_empty() {
            whole.nodes = self.figure.nodes();
        }
        if whole.obstacles_m.is_empty() {
            whole.obstacles_m = self.figure.obstacles();
        }
        whole
    }
}

impl Table for Journeys {
    type Settings = Settings;
    type Job = Job;
    type Measured = Sample;
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: self.id,
            shows: self.shows,
            help: self.help,
            more: "",
            examples: &[
                "rescue-fig7 --svg ratios.svg",
                "rescue-fig7 --nodes 700 --k 8 --format json",
                "rescue-fig6 --svg ways.svg",
                "rescue-fig10 --noise-db 2 --obstacle 40,50,130,120 --obstacle 170,30,240,130",
            ],
            doing: "walking",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        let obstacle = Given {
            name: "obstacle",
            value: "W,N,E,S",
            about: "An obstacle by its sides; may be given again [default: those of the figure]",
            values: Values::Repeated,
        };
        vec![
            Parameter::list(
                "nodes",
                "Numbers of nodes [default: 300,500,700,900,1100 for figure 7, else 700]",
                |all| all_shown(&all.nodes),
                |all, texts| put_all(&mut all.nodes, texts, whole),
            ),
            Parameter::one(
                "side",
                "METRES",
                "The side of the square, in metres",
                |all| shown(&all.side_m),
                |all, texts| put(&mut all.side_m, texts, real),
            ),
            Parameter::one(
                "range",
                "METRES",
                "The radio range, in metres",
                |all| shown(&all.range_m),
                |all, texts| put(&mut all.range_m, texts, real),
            ),
            Parameter::new(
                obstacle,
                |_| Vec::new(),
                |all, texts| {
                    put_all(&mut all.obstacles_m, texts, |text| text.parse().map(|Metres(sides)| sides))
                },
            ),
            Parameter::one(
                "k",
                "K",
                "The k of k-FNF, whose tree TAN uses",
                |all| shown(&all.k.0.get()),
                |all, texts| put(&mut all.k, texts, Senders::read),
            ),
            Parameter::one(
                "noise-db",
                "DB",
                "The standard deviation of the strengths that robots measure, in dB",
                |all| shown(&all.noise_db),
                |all, texts| put(&mut all.noise_db, texts, real),
            ),
            Parameter::one(
                "topologies",
                "COUNT",
                "Topologies for each number of nodes",
                |all| shown(&all.topologies),
                |all, texts| put(&mut all.topologies, texts, |text| within(text, &(1..=100_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of all topologies",
                |all| shown(&all.seed),
                |all, texts| put(&mut all.seed, texts, number),
            ),
        ]
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        let about = "Store a picture: of figure 7 a chart, else the ways in the topology in which the shortest is the \
                     longest";
        let draw = |journeys: &Self, settings: &Settings, merged: &Merged| match journeys.figure {
            Figure::Ratios => Ok(drawn::chart(&merged.densities).svg()),
            Figure::Trajectories | Figure::OneObstacle | Figure::FourObstacles => {
                drawn::picture(&journeys.whole(settings), journeys.figure.drawn(), &merged.densities)
            }
        };
        vec![Chart { name: "svg", about, draw }]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let settings = self.whole(settings);
        for &nodes in &settings.nodes {
            World::new(&settings, nodes, 0).map_err(usage)?;
        }
        let topologies = |density| (0..settings.topologies).map(move |topology| Job { density, topology });
        Ok((0..settings.nodes.len()).flat_map(topologies).collect())
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Sample, Halt> {
        let settings = self.whole(settings);
        let nodes = settings.nodes.get(job.density).copied().unwrap_or_default();
        let world = World::new(&settings, nodes, job.topology).map_err(usage)?;
        Sample::of(&world).map_err(usage)
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Sample)>) -> Result<Merged, Halt> {
        let Settings { nodes, side_m, range_m, obstacles_m, k, noise_db, topologies, seed } =
            self.whole(settings);
        let density = |(density, nodes): (usize, usize)| {
            let samples = results.iter().filter(|(job, _)| job.density == density);
            Density::of(nodes, &samples.map(|(_, sample)| sample).collect::<Vec<_>>())
        };
        let densities = nodes.into_iter().enumerate().map(density).collect();
        Ok(Merged { side_m, range_m, obstacles: obstacles_m, k, noise_db, topologies, seed, densities })
    }

    fn text(&self, settings: &Settings, merged: &Merged) -> Result<String, Halt> {
        Ok(text::text(&self.whole(settings), &merged.densities))
    }
}
