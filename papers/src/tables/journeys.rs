//! Journeys of a robot to the node that waits for rescue [Jiang 2011, 4.3 and 4.4]: how far it walks by TAN, by Verma's
//! and Reich's schemes, and by Sheu's, of which the paper only tells. Figure 7 is the ratio RD of what robots walk to
//! the shortest ways there; figures 6, 9 and 10 are pictures of single journeys, the last two round obstacles, which
//! here stand beside the same measurement. Every way is walked in the same topologies, from the same place to the same
//! node.
//!
//! The paper says of its figures that RD of TAN is very close to Verma's and smaller than Reich's in some cases (4.3),
//! and of its Table 2 that TAN's way is shorter than Verma's and about as long as Reich's (4.4); of Sheu's robot, that
//! going back and forth wastes time and energy (2.1). Each is decided by the 95 % interval of the difference in the
//! same topologies.

mod claims;
mod density;
mod pictures;
mod text;
mod world;

pub use self::claims::{Claim, Decision};
pub use self::density::{Density, Line};
use self::world::World;
pub use self::world::{Sample, Settings, Way};
use super::notice_fig5::{NODES, SIDE_M};
use super::prelude::*;
pub use super::sentences::Verdict;
use tautline_field::radio::{Lake, SHAPES};
use tautline_field::tan::{NextSensor, Scans};

/// The description that all figures of journeys share.
const ABOUT: Description = Description {
    examples: &[
        "rescue-fig7 --svg ratios.svg",
        "rescue-fig7 --nodes 700 --k 8 --format json",
        "rescue-fig6 --svg ways.svg",
        "rescue-fig10 --noise-db 2 --obstacle 40,50,130,120 --obstacle 170,30,240,130",
        "rescue-fig9 --obstacle u:100,90,200,210 --scan once",
    ],
    doing: "walking",
    pictures: &[(
        "svg",
        "Store a picture: of figure 7 a chart, else the ways in the topology in which the shortest is the longest",
    )],
    takes: "a second",
    ..Description::NOTHING
};

/// Figure 6.
pub const RESCUE_FIG6: Journeys = Journeys {
    figure: Figure::Trajectories,
    about: Description {
        id: "rescue-fig6",
        shows: "the ways of a robot to the node that waits for rescue by Reich's scheme, TAN and Verma's, \
            as a picture",
        help: "The ways of a robot by Reich's scheme, TAN and Verma's, as a picture",
        ..ABOUT
    },
};

/// Figure 7.
pub const RESCUE_FIG7: Journeys = Journeys {
    figure: Figure::Ratios,
    about: Description {
        id: "rescue-fig7",
        shows: "how many metres a robot walks for each metre of the shortest way by TAN, Verma's, Reich's \
            and Sheu's schemes, by the number of nodes, and what becomes of the paper's words about it",
        help: "How far a robot walks by TAN and its rivals, by the number of nodes",
        takes: "some seconds",
        ..ABOUT
    },
};

/// Figure 9.
pub const RESCUE_FIG9: Journeys = Journeys {
    figure: Figure::OneObstacle,
    about: Description {
        id: "rescue-fig9",
        shows: "the ways of a robot round a large obstacle: how many arrive, and how far they walk",
        help: "How far a robot walks round a large obstacle",
        ..ABOUT
    },
};

/// Figure 10.
pub const RESCUE_FIG10: Journeys = Journeys {
    figure: Figure::FourObstacles,
    about: Description {
        id: "rescue-fig10",
        shows: "the ways of a robot round four large obstacles: how many arrive, and how far they walk",
        help: "How far a robot walks round four large obstacles",
        ..ABOUT
    },
};

/// Obstacles of any shape, which the paper “might have problems” with (5).
pub const RESCUE_SHAPES: Journeys = Journeys {
    figure: Figure::Shapes,
    about: Description {
        id: "rescue-shapes",
        shows: "the ways of a robot round a large obstacle by its shape: how many arrive, and how far they \
            walk",
        help: "How far a robot walks round obstacles of any shape",
        takes: "some seconds",
        ..ABOUT
    },
};

/// Journeys of a robot to the node that waits for rescue.
#[derive(Clone, Copy, Debug)]
pub struct Journeys {
    figure: Figure,
    about: Description,
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
    /// Round one of each shape.
    Shapes,
}

/// West, north, east and south of an obstacle in the middle of the paper's square of 300 m.
const MIDDLE: [f64; 4] = [75.0, 75.0, 225.0, 225.0];

impl Figure {
    /// The numbers of nodes: those of the paper, or, where it gives none, the middle one.
    fn nodes(self) -> Vec<usize> {
        match self {
            Self::Ratios => NODES.to_vec(),
            Self::Trajectories | Self::OneObstacle | Self::FourObstacles | Self::Shapes => vec![700],
        }
    }

    /// The obstacles, for the paper's square of 300 m. The paper draws its own; these are ours: large lakes that stop
    /// signals and robots.
    fn obstacles(self) -> Vec<Lake> {
        match self {
            Self::Trajectories | Self::Ratios | Self::Shapes => Vec::new(),
            Self::OneObstacle => vec![Lake(vec![[100.0, 90.0, 200.0, 210.0]])],
            Self::FourObstacles => [
                [40.0, 50.0, 130.0, 120.0],
                [170.0, 30.0, 240.0, 130.0],
                [60.0, 170.0, 120.0, 270.0],
                [160.0, 180.0, 260.0, 240.0],
            ]
            .map(|sides| Lake(vec![sides]))
            .into(),
        }
    }

    /// The journeys of its picture.
    fn drawn(self) -> &'static [Way] {
        match self {
            Self::Trajectories | Self::Ratios => &[Way::Reich, Way::Tan, Way::Verma],
            Self::OneObstacle | Self::FourObstacles | Self::Shapes => &[Way::Tan],
        }
    }
}

/// One topology, by the place of the number of nodes, or of nodes and shape.
type Job = Run<usize>;

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    side_m: f64,
    range_m: f64,
    /// West, north, east and south of each, in metres.
    obstacles: Vec<[f64; 4]>,
    k: Senders,
    noise_db: f64,
    scan: Scans,
    reich: NextSensor,
    near_percent: f64,
    topologies: u32,
    seed: u64,
    /// Density by density, of each shape by shape.
    pub densities: Vec<Density>,
}

/// A case: the number of nodes, the shape of the obstacle, and the settings with that obstacle.
type Case = (usize, Option<&'static str>, Settings);

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

    /// The shapes of the obstacle that each number of nodes is measured with; none if the settings have the obstacles.
    fn shapes(&self) -> Vec<Option<&'static str>> {
        match self.figure {
            Figure::Shapes => SHAPES.iter().map(|(name, _)| Some(*name)).collect(),
            Figure::Trajectories | Figure::Ratios | Figure::OneObstacle | Figure::FourObstacles => vec![None],
        }
    }

    /// The case at this place.
    fn case(&self, settings: &Settings, place: usize) -> Result<Case, Halt> {
        let (mut own, shapes) = (self.whole(settings), self.shapes());
        let (nodes, shape) = (own.nodes[place / shapes.len()], shapes[place % shapes.len()]);
        if let Some(shape) = shape {
            let lake = Lake::new(shape, MIDDLE.map(|at| at * own.side_m / SIDE_M));
            own.obstacles_m.push(lake.map_err(|what| Diagnostic::usage(what, "take another shape"))?);
        }
        Ok((nodes, shape, own))
    }

    /// The cases, place by place.
    fn cases(&self, settings: &Settings) -> Result<Vec<Case>, Halt> {
        let count = self.whole(settings).nodes.len() * self.shapes().len();
        (0..count).map(|place| self.case(settings, place)).collect()
    }
}

impl Table for Journeys {
    type Settings = Settings;
    type Job = Job;
    type Sample = Sample;
    type Summary = Summary;

    fn about(&self) -> Description {
        self.about
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let cases = self.cases(settings)?;
        for (nodes, _, own) in &cases {
            World::new(own, *nodes, 0).map_err(usage)?;
        }
        Ok(runs(0..cases.len(), |_| settings.topologies))
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Sample, Halt> {
        let (nodes, _, own) = self.case(settings, run.at)?;
        let world = World::new(&own, nodes, run.number).map_err(usage)?;
        Sample::of(&world).map_err(usage)
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let cases = self.cases(settings)?.into_iter().enumerate();
        let densities =
            cases.map(|(place, (nodes, shape, _))| Density::of(nodes, shape, &at(&results, place))).collect();
        let whole = self.whole(settings);
        Ok(Summary {
            side_m: whole.side_m,
            range_m: whole.range_m,
            obstacles: whole.obstacles_m.into_iter().flat_map(|Lake(parts)| parts).collect(),
            k: whole.k,
            noise_db: whole.noise_db,
            scan: whole.scan,
            reich: whole.reich,
            near_percent: whole.near_percent,
            topologies: whole.topologies,
            seed: whole.seed,
            densities,
        })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(text::figures(&self.whole(settings), &merged.densities))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let each = |of: fn(&Density) -> Option<Judgement>| merged.densities.iter().filter_map(of).collect();
        match self.figure {
            Figure::Shapes => each(Density::problems),
            Figure::OneObstacle | Figure::FourObstacles => each(Density::success),
            Figure::Trajectories | Figure::Ratios => {
                Claim::ALL.into_iter().flat_map(|claim| claim.judged(&merged.densities)).collect()
            }
        }
    }

    fn draw(&self, _: usize, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        match self.figure {
            Figure::Ratios => Ok(pictures::chart(&merged.densities).svg()),
            Figure::Trajectories | Figure::OneObstacle | Figure::FourObstacles | Figure::Shapes => {
                pictures::picture(&self.cases(settings)?, self.figure.drawn(), &merged.densities)
            }
        }
    }
}
