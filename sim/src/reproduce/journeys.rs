//! Journeys of a robot to the node that waits for rescue (paper 003, 4.3 and 4.4): how far it walks by TAN, by Verma's and
//! Reich's schemes, and by Sheu's, of which the paper only tells. Figure 7 is the ratio RD of what robots walk to the
//! shortest ways there; figures 6, 9 and 10 are pictures of single journeys, the last two round obstacles, which here
//! stand beside the same measurement. Every way is walked in the same topologies, from the same place to the same node.
//!
//! The paper says of its figures that RD of TAN is very close to Verma's and smaller than Reich's in some cases (4.3),
//! and of its Table 2 that TAN's way is shorter than Verma's and about as long as Reich's (4.4). Each of the four is
//! decided by the 95 % interval of the difference in the same topologies.

use rayon::prelude::*;
use serde::Serialize;
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{Count, Rule, Scheme};
use tautline_proofs::engine::Seeded;

use super::interval::{Estimate, rounded};
use super::notice_fig5::{NODES, usage};
use crate::draw::chart::{Axis, LineChart, Series, Stroke};
use crate::draw::field::{self, Map, Terminus, Trail};
use crate::fault::{Halt, Watch};
use crate::radio::{
    Area, Channel, Faults, Field, LONGEST_WAIT_NS, Model, Network, Obstacle, Point, Problem, Radio,
};
use crate::rescue::seconds;
use crate::tan::{End, Equipment, Journey, Site, Tree, hops, shortest_m};

/// The figures.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Figure {
    /// Figure 6: journeys by three ways in one topology.
    Trajectories,
    /// Figure 7: RD by the number of nodes.
    Ratios,
    /// Figure 9: round one obstacle.
    OneObstacle,
    /// Figure 10: round four.
    FourObstacles,
}

const fn lake(west_m: f64, north_m: f64, east_m: f64, south_m: f64) -> Obstacle {
    Obstacle { west_m, north_m, east_m, south_m }
}

impl Figure {
    /// The numbers of nodes: those of the paper, or, where it gives none, the middle one.
    pub fn nodes(self) -> Vec<usize> {
        match self {
            Self::Ratios => NODES.to_vec(),
            Self::Trajectories | Self::OneObstacle | Self::FourObstacles => vec![700],
        }
    }

    /// The obstacles, for the paper's square of 300 m. The paper draws its own; these are ours: large lakes that stop
    /// signals and robots.
    pub fn obstacles(self) -> Vec<Obstacle> {
        match self {
            Self::Trajectories | Self::Ratios => Vec::new(),
            Self::OneObstacle => vec![lake(100.0, 90.0, 200.0, 210.0)],
            Self::FourObstacles => vec![
                lake(40.0, 50.0, 130.0, 120.0),
                lake(170.0, 30.0, 240.0, 130.0),
                lake(60.0, 170.0, 120.0, 270.0),
                lake(160.0, 180.0, 260.0, 240.0),
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
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
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
#[derive(Clone, PartialEq, Debug)]
pub struct Setting {
    /// Numbers of nodes.
    pub nodes: Vec<usize>,
    /// The side of the square, in metres.
    pub side_m: f64,
    /// The radio range, in metres.
    pub range_m: f64,
    /// What stops signals and robots.
    pub obstacles: Vec<Obstacle>,
    /// The k of the broadcast that leaves TAN its tree.
    pub k: Count,
    /// The standard deviation of the strengths that robots measure, in dB.
    pub noise_db: f64,
    /// Topologies for each number of nodes.
    pub topologies: u32,
    /// The seed of all of them.
    pub seed: u64,
}

/// All ways at one number of nodes.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Density {
    /// The number of nodes.
    pub nodes: usize,
    /// The share of the topologies in which links lead from the robot to the WFR: no journey succeeds in the others.
    pub linked: Estimate,
    /// The share of those in which the robot hears the call by k-FNF: without it no journey by TAN begins.
    pub told: Option<Estimate>,
    /// Way by way.
    pub ways: Vec<Line>,
    /// How many hops the robots have by TAN's trees for each hop that the shortest chain of links has, where TAN arrives.
    pub hops: Option<Estimate>,
    /// What the paper says, and what is so.
    pub claims: Vec<Decision>,
    /// The share of the topologies in which all arrive where TAN's way is shorter than Reich's.
    pub shorter_than_reich: Option<Estimate>,
    /// The topology in which the shortest way of those is the longest.
    pub longest: Option<u32>,
}

/// A way at one number of nodes.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Line {
    /// Which.
    pub way: Way,
    /// The share of the topologies, of those in which links lead to the WFR, in which the robot arrives.
    pub arrivals: Option<Estimate>,
    /// RD: the metres walked for each metre of the shortest ways, over the topologies in which all arrive.
    pub ratio: Option<Estimate>,
    /// The seconds taken for each metre of them, where the way has a clock.
    pub seconds: Option<Estimate>,
}

/// What the paper says of RD.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Claim {
    /// “Very close to position-based Verma's scheme” (4.3).
    CloseToVerma,
    /// “Shorter moving distance … than Verma's scheme” (4.4, Table 2).
    ShorterThanVerma,
    /// “Smaller RD than positionless Reich's scheme for some cases” (4.3).
    SmallerThanReich,
    /// “About the same moving distance … as Reich's scheme” (4.4).
    LikeReich,
}

/// What has come of a claim.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The whole interval says so.
    Holds,
    /// The whole interval says the contrary.
    Fails,
    /// Part of it does.
    Open,
}

/// A claim with its verdict.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Decision {
    /// The paper's.
    pub paper: Claim,
    /// RD of TAN less that of the rival.
    pub difference: Option<Estimate>,
    /// What that says of the claim.
    pub verdict: Verdict,
}

/// How far two RD may be from each other to be close: a tenth of the shortest way. The paper gives no number.
pub const CLOSE: f64 = 0.1;

impl Claim {
    /// All, in the order of every table.
    pub const ALL: [Self; 4] =
        [Self::CloseToVerma, Self::ShorterThanVerma, Self::SmallerThanReich, Self::LikeReich];

    /// Whom TAN is compared with.
    pub const fn rival(self) -> Way {
        match self {
            Self::CloseToVerma | Self::ShorterThanVerma => Way::Verma,
            Self::SmallerThanReich | Self::LikeReich => Way::Reich,
        }
    }

    /// In words, with the section.
    pub const fn words(self) -> &'static str {
        match self {
            Self::CloseToVerma => "very close (4.3)",
            Self::ShorterThanVerma => "shorter (4.4)",
            Self::SmallerThanReich => "smaller (4.3)",
            Self::LikeReich => "about as long (4.4)",
        }
    }

    /// What the interval of TAN's RD less the rival's says of it.
    pub fn verdict(self, difference: Option<Estimate>) -> Verdict {
        let Some([low, high]) = difference.and_then(|difference| difference.interval) else {
            return Verdict::Open;
        };
        let (holds, fails) = match self {
            Self::CloseToVerma | Self::LikeReich => {
                (low >= -CLOSE && high <= CLOSE, low > CLOSE || high < -CLOSE)
            }
            Self::ShorterThanVerma | Self::SmallerThanReich => (high < 0.0, low > 0.0),
        };
        match (holds, fails) {
            (true, _) => Verdict::Holds,
            (false, true) => Verdict::Fails,
            (false, false) => Verdict::Open,
        }
    }
}

impl Verdict {
    /// In a word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::Open => "open",
        }
    }
}

/// A topology with a robot as the last node of its field.
struct World {
    field: Field,
    network: Network,
    equipment: Equipment,
    rule: Rule,
    robot: NodeId,
    wfr: NodeId,
}

/// What came of one topology.
struct Sample {
    /// The fewest hops from the robot to the WFR, if links lead there.
    fewest_hops: Option<u16>,
    /// Those of TAN's tree.
    tree_hops: Option<u16>,
    /// In metres, if there is a way at all.
    shortest_m: Option<f64>,
    /// Those who arrive, in the order of [`Way::ALL`].
    walked: [Option<Walked>; 4],
}

/// What a robot has walked until it was there.
#[derive(Clone, Copy)]
struct Walked {
    length_m: f64,
    time_s: Option<f64>,
}

impl Walked {
    fn of(journey: &Journey) -> Option<Self> {
        let time_s = journey.time_ns.map(seconds);
        (journey.end == End::Arrived).then_some(Self { length_m: journey.length_m, time_s })
    }
}

impl World {
    fn site(&self) -> Site<'_> {
        Site { field: &self.field, network: &self.network, equipment: self.equipment }
    }

    fn tree(&self, chance: &mut dyn Oracle) -> Result<Tree, Problem> {
        let ends = (self.wfr, self.robot);
        Tree::grow(&self.network, self.rule, Channel::Ideal, &Faults::NONE, ends, chance)
    }

    fn journey(&self, tree: &Tree, way: Way, chance: &mut dyn Oracle) -> Journey {
        match way {
            Way::Tan => self.site().tan(tree, self.wfr, chance),
            Way::Verma => self.site().verma(self.wfr),
            Way::Reich => self.site().reich(self.wfr, chance),
            Way::Sheu => self.site().sheu(self.wfr, chance),
        }
    }

    fn goal(&self) -> Point {
        self.field.nodes()[self.wfr.0 as usize]
    }

    fn shortest_m(&self) -> Option<f64> {
        shortest_m(&self.field, self.site().start(), self.goal())
    }
}

impl Sample {
    /// The metres of the shortest way, and what was walked, if all arrive.
    fn all(&self) -> Option<(f64, [Walked; 4])> {
        let [tan, verma, reich, sheu] = self.walked;
        Some((self.shortest_m?, [tan?, verma?, reich?, sheu?]))
    }
}

impl Setting {
    /// Measures everything. `watch` is called after each topology. The result is the same on any number of
    /// threads.
    ///
    /// # Errors
    /// [`Halt`], as `watch` returned it, or if the setting makes no network.
    pub fn measure(&self, watch: &Watch<'_>) -> Result<Vec<Density>, Halt> {
        let density = |&nodes: &usize| {
            // What is wrong with all is to be the same fault each time, not that of whichever thread is first.
            self.world(nodes, 0).map_err(usage)?;
            let samples = (0..self.topologies).into_par_iter().map(|topology| {
                let sample = self.sample(nodes, topology).map_err(usage)?;
                watch()?;
                Ok(sample)
            });
            let samples: Vec<Sample> = samples.collect::<Result<_, Halt>>()?;
            Ok(density(nodes, &samples))
        };
        self.nodes.iter().map(density).collect()
    }

    fn world(&self, nodes: usize, topology: u32) -> Result<World, Problem> {
        let area = Area::new(self.side_m, self.side_m)?;
        let radio = Radio::new(self.range_m, Model::Disc)?;
        let chance = &mut Seeded::new(self.seed, 2 * u64::from(topology));
        let field = Field::random(area, self.obstacles.clone(), nodes, chance)?;
        let field = field.with(&[field.place(chance)?])?;
        let network = Network::new(&field, radio, chance)?;
        Ok(World {
            equipment: Equipment::new(radio, self.noise_db)?,
            rule: Rule::new(Scheme::Farthest { k: Some(self.k) }, radio.range_um(), LONGEST_WAIT_NS),
            robot: NodeId(nodes as u32),
            wfr: NodeId(chance.pick(nodes as u32)),
            field,
            network,
        })
    }

    /// The broadcast and each journey have a stream of answers to themselves, different from that of the topology.
    fn chance(&self, topology: u32) -> Seeded {
        Seeded::new(self.seed, 2 * u64::from(topology) + 1)
    }

    fn sample(&self, nodes: usize, topology: u32) -> Result<Sample, Problem> {
        let world = self.world(nodes, topology)?;
        let tree = world.tree(&mut self.chance(topology))?;
        let walked = Way::ALL.map(|way| Walked::of(&world.journey(&tree, way, &mut self.chance(topology))));
        let hops = hops(&world.network, world.wfr, |node| node != world.robot);
        let fewest_hops = hops.last().copied().flatten();
        let tree_hops = tree.entry().map(|(_, hops)| hops);
        Ok(Sample { fewest_hops, tree_hops, shortest_m: world.shortest_m(), walked })
    }

    /// The picture of a figure: journeys in a topology with so many nodes.
    ///
    /// # Errors
    /// [`Halt`] if the setting makes no network.
    pub fn picture(&self, figure: Figure, nodes: usize, topology: u32) -> Result<String, Halt> {
        let world = self.world(nodes, topology).map_err(usage)?;
        let tree = world.tree(&mut self.chance(topology)).map_err(usage)?;
        let place = |node: NodeId| world.field.nodes()[node.0 as usize];
        let map = |&way: &Way| {
            let journey = world.journey(&tree, way, &mut self.chance(topology));
            let times = world.shortest_m().map_or(String::new(), |shortest_m| {
                format!(", {:.2} times the shortest way", journey.length_m / shortest_m)
            });
            let links = match way {
                Way::Tan => tree.links().map(|(node, parent)| [place(node), place(parent)]).collect(),
                Way::Verma | Way::Reich | Way::Sheu => Vec::new(),
            };
            let end = match journey.end {
                End::Arrived => Terminus::There,
                End::Unaware | End::Lost | End::Astray => Terminus::GaveUp,
            };
            Map {
                caption: format!("{}: {:.0} m{times}", way.word(), journey.length_m),
                field: &world.field,
                nodes,
                links,
                trails: vec![Trail { name: way.word().to_owned(), places: journey.trail, end }],
                wfrs: vec![world.goal()],
            }
        };
        let maps: Vec<Map<'_>> = figure.drawn().iter().map(map).collect();
        Ok(field::picture("The way of a robot to the node that waits for rescue", &maps))
    }
}

fn density(nodes: usize, samples: &[Sample]) -> Density {
    let linked = samples.iter().filter(|sample| sample.fewest_hops.is_some()).count() as u32;
    let told = samples.iter().filter(|sample| sample.tree_hops.is_some()).count() as u32;
    let all: Vec<(f64, [Walked; 4])> = samples.iter().filter_map(Sample::all).collect();
    let ratio = |value: &dyn Fn(&[Walked; 4]) -> Option<f64>| {
        let pairs = all.iter().map(|(shortest_m, walked)| Some((value(walked)?, *shortest_m)));
        let ratio = Estimate::of_ratio(&pairs.collect::<Option<Vec<_>>>()?)?;
        Some(rounded(ratio, 1e4))
    };
    let longer = |rival: Way| {
        ratio(&|[tan, verma, reich, sheu]| {
            let rival = match rival {
                Way::Tan => tan,
                Way::Verma => verma,
                Way::Reich => reich,
                Way::Sheu => sheu,
            };
            Some(tan.length_m - rival.length_m)
        })
    };
    let line = |(place, &way): (usize, &Way)| {
        let arrived = samples.iter().filter(|sample| sample.walked[place].is_some()).count() as u32;
        Line {
            way,
            arrivals: Estimate::share(arrived, linked).map(|share| rounded(share, 1e4)),
            ratio: ratio(&|walked| Some(walked[place].length_m)),
            seconds: ratio(&|walked| walked[place].time_s),
        }
    };
    let decision = |paper: Claim| {
        let difference = longer(paper.rival());
        Decision { paper, difference, verdict: paper.verdict(difference) }
    };
    let hops = samples
        .iter()
        .filter(|sample| sample.walked[0].is_some())
        .filter_map(|sample| Some((f64::from(sample.tree_hops?), f64::from(sample.fewest_hops?))));
    let shorter = all.iter().filter(|(_, [tan, _, reich, _])| tan.length_m < reich.length_m).count() as u32;
    let longest = (0..).zip(samples).filter_map(|(topology, sample)| Some((sample.all()?.0, topology)));
    Density {
        nodes,
        linked: rounded(Estimate::share(linked, samples.len() as u32).unwrap_or(Estimate::NOTHING), 1e4),
        told: Estimate::share(told, linked).map(|share| rounded(share, 1e4)),
        ways: Way::ALL.iter().enumerate().map(line).collect(),
        hops: Estimate::of_ratio(&hops.collect::<Vec<_>>()).map(|ratio| rounded(ratio, 1e4)),
        claims: Claim::ALL.map(decision).into(),
        shorter_than_reich: Estimate::share(shorter, all.len() as u32).map(|share| rounded(share, 1e4)),
        longest: longest.max_by(|(one, _), (other, _)| one.total_cmp(other)).map(|(_, topology)| topology),
    }
}

/// RD by the number of nodes, as a chart.
pub fn chart(densities: &[Density]) -> LineChart {
    let series = |(place, way): (usize, &Way)| {
        let point = |density: &Density| {
            let ratio = density.ways.get(place)?.ratio?;
            Some(ratio.at(f64::from(density.nodes as u32)))
        };
        let points = densities.iter().filter_map(point).collect();
        Series { name: way.word().to_owned(), stroke: Stroke::Solid, points }
    };
    LineChart {
        title: "Metres walked for each metre of the shortest way".to_owned(),
        x: Axis::new("nodes", ""),
        y: Axis::new("RD", "").showing([1.0, 1.0]),
        series: Way::ALL.iter().enumerate().map(series).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::Verdict::{Fails, Holds, Open};
    use super::*;

    #[test]
    fn a_claim_is_decided_by_the_whole_interval() {
        let verdicts = |low: f64, high: f64| {
            let difference = Estimate { count: 9, mean: low, interval: Some([low, high]) };
            Claim::ALL.map(|claim| claim.verdict(Some(difference)))
        };
        assert_eq!(verdicts(-0.05, -0.01), [Holds, Holds, Holds, Holds]);
        assert_eq!(verdicts(-0.05, 0.05), [Holds, Open, Open, Holds]);
        assert_eq!(verdicts(0.05, 0.15), [Open, Fails, Fails, Open]);
        assert_eq!(verdicts(0.4, 0.5), [Fails, Fails, Fails, Fails]);
        assert_eq!(verdicts(-0.5, -0.4), [Fails, Holds, Holds, Fails]);
        assert_eq!(Claim::ALL.map(|claim| claim.verdict(None)), [Open; 4]);
    }
}
