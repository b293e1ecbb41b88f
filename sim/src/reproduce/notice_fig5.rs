//! Figure 5 of paper 003: how many nodes of a random network a broadcast reaches, and how many forward it, by scheme and
//! density. The paper counts all nodes; those that no link connects to the source nothing can reach, so the reach within
//! the source's component stands beside it. Every scheme broadcasts over the same topologies, from the same sources.

use rayon::prelude::*;
use serde::Serialize;
use std::num::NonZeroU32;
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{Count, Rule, Scheme};
use tautline_proofs::engine::Seeded;

use super::interval::{Estimate, decimals, rounded};
use crate::draw::chart::{Axis, LineChart, Series, Stroke};
use crate::fault::{Fault, Halt, Watch};
use crate::radio::{
    Area, Channel, Faults, Field, LONGEST_WAIT_NS, Model, Network, Problem, Radio, broadcast,
};

/// The numbers of nodes of the paper.
pub const NODES: [usize; 5] = [300, 500, 700, 900, 1100];

/// The side of the paper's square, in metres.
pub const SIDE_M: f64 = 300.0;

/// The paper's radio range, in metres.
pub const RANGE_M: f64 = 25.0;

/// The k of the paper's figure, and what it has k-FNF reach there: “near 100 %”, at every density. All else it draws
/// only.
const PAPER: (Count, f64) = (Count::ONE, 1.0);

/// What is measured.
#[derive(Clone, PartialEq, Debug)]
pub struct Setting {
    /// Numbers of nodes.
    pub nodes: Vec<usize>,
    /// The side of the square, in metres.
    pub side_m: f64,
    /// The radio range, in metres.
    pub range_m: f64,
    /// The k of k-FNF.
    pub ks: Vec<Count>,
    /// Topologies for each number of nodes.
    pub topologies: u32,
    /// The seed of all of them.
    pub seed: u64,
    /// The channel.
    pub channel: Channel,
}

/// All schemes at one number of nodes.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Density {
    /// The number of nodes.
    pub nodes: usize,
    /// The share of the topologies in which links connect all nodes.
    pub connected: Estimate,
    /// The share of the nodes that links connect to the source, the source included.
    pub component: Estimate,
    /// Scheme by scheme.
    pub schemes: Vec<Line>,
}

/// One scheme at one number of nodes.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Line {
    /// The scheme.
    pub scheme: String,
    /// The share of all nodes that know of the event in the end, the source included.
    pub reach: Estimate,
    /// What the paper says of it.
    pub paper: Option<f64>,
    /// Ours less the paper's.
    pub difference: Option<f64>,
    /// The share of the nodes of the source's component that do.
    pub reach_component: Estimate,
    /// Nodes that forward, the source not included.
    pub rebroadcasts: Estimate,
}

/// One topology: the nodes that links connect to the source, and scheme by scheme the nodes reached and the
/// rebroadcasts.
struct Sample {
    component: u32,
    schemes: Vec<(u32, u32)>,
}

impl Setting {
    /// The schemes of the figure by name, k-FNF for each k.
    fn schemes(&self, range_um: u32) -> Vec<(String, Scheme)> {
        let farthest = |&k: &Count| (format!("k-fnf k={}", k.get()), Scheme::Farthest { k: Some(k) });
        let counter = |below: Count| (format!("counter C={}", below.get()), Scheme::Counter { below });
        let distance = |tenths: u32| {
            let least_um = (u64::from(range_um) * u64::from(tenths) / 10) as u32;
            (format!("distance 0.{tenths}"), Scheme::Distance { least_um })
        };
        let rivals = [2, 3].into_iter().filter_map(Count::new).map(counter).chain([8, 5].map(distance));
        let plain = [("sba".to_owned(), Scheme::Scalable), ("flooding".to_owned(), Scheme::Flooding)];
        self.ks.iter().map(farthest).chain(rivals).chain(plain).collect()
    }

    /// Measures everything. `watch` is called after each topology. The result is the same on any number of
    /// threads.
    ///
    /// # Errors
    /// [`Halt`], as `watch` returned it, or if the setting makes no network.
    pub fn measure(&self, watch: &Watch<'_>) -> Result<Vec<Density>, Halt> {
        let area = Area::new(self.side_m, self.side_m).map_err(usage)?;
        let radio = Radio::new(self.range_m, Model::Disc).map_err(usage)?;
        let range_um = radio.range_um();
        let schemes = self.schemes(range_um.get());
        let density = |&nodes: &usize| {
            // What is wrong with all is to be the same fault each time, not that of whichever thread is first.
            self.sample(area, radio, range_um, nodes, 0, &[]).map_err(usage)?;
            let topologies = (0..u64::from(self.topologies)).into_par_iter();
            let samples = topologies.map(|topology| {
                let sample = self.sample(area, radio, range_um, nodes, topology, &schemes).map_err(usage)?;
                watch()?;
                Ok(sample)
            });
            let samples: Vec<Sample> = samples.collect::<Result<_, Halt>>()?;
            Ok(self.density(nodes, &samples, &schemes))
        };
        self.nodes.iter().map(density).collect()
    }

    /// The topology has a stream of answers to itself; each scheme draws its waits from another.
    fn sample(
        &self,
        area: Area,
        radio: Radio,
        range_um: NonZeroU32,
        nodes: usize,
        topology: u64,
        schemes: &[(String, Scheme)],
    ) -> Result<Sample, Problem> {
        let chance = &mut Seeded::new(self.seed, 2 * topology);
        let field = Field::random(area, Vec::new(), nodes, chance)?;
        let network = Network::new(&field, radio, chance)?;
        let source = NodeId(chance.pick(nodes as u32));
        let schemes = schemes.iter().map(|&(_, scheme)| {
            let rule = Rule::new(scheme, range_um, LONGEST_WAIT_NS);
            let chance = &mut Seeded::new(self.seed, 2 * topology + 1);
            let (report, _) = broadcast(&network, &rule, self.channel, &Faults::NONE, source, chance)?;
            Ok((report.reached, report.rebroadcasts))
        });
        let schemes = schemes.collect::<Result<_, Problem>>()?;
        Ok(Sample { component: network.component(source) as u32, schemes })
    }

    fn density(&self, nodes: usize, samples: &[Sample], schemes: &[(String, Scheme)]) -> Density {
        let all = f64::from(nodes as u32);
        let mean = |value: &dyn Fn(&Sample) -> f64| {
            Estimate::of_values(&samples.iter().map(value).collect::<Vec<_>>()).unwrap_or(Estimate::NOTHING)
        };
        let connected = samples.iter().filter(|sample| sample.component as usize == nodes).count() as u32;
        let is_papers = self.side_m == SIDE_M && self.range_m == RANGE_M && NODES.contains(&nodes);
        let line = |(place, (name, scheme)): (usize, &(String, Scheme))| {
            let (paper_k, paper_reach) = PAPER;
            let reach = mean(&|sample| f64::from(sample.schemes[place].0) / all);
            let is_paper = is_papers && *scheme == Scheme::Farthest { k: Some(paper_k) };
            let paper = is_paper.then_some(paper_reach);
            Line {
                scheme: name.clone(),
                reach: rounded(reach, 1e4),
                paper,
                difference: paper.map(|paper| decimals(reach.mean - paper, 1e4)),
                reach_component: rounded(
                    mean(&|sample| f64::from(sample.schemes[place].0) / f64::from(sample.component)),
                    1e4,
                ),
                rebroadcasts: rounded(mean(&|sample| f64::from(sample.schemes[place].1)), 1e2),
            }
        };
        Density {
            nodes,
            connected: rounded(Estimate::share(connected, self.topologies).unwrap_or(Estimate::NOTHING), 1e4),
            component: rounded(mean(&|sample| f64::from(sample.component) / all), 1e4),
            schemes: schemes.iter().enumerate().map(line).collect(),
        }
    }
}

pub(super) fn usage(problem: Problem) -> Halt {
    Fault::usage(problem, problem.remedy()).into()
}

/// The two parts of the figure.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Part {
    /// (a): the reach of all nodes, in percent.
    Reach,
    /// (b): the rebroadcasts.
    Rebroadcasts,
}

/// A part of the figure as a chart.
pub fn chart(part: Part, densities: &[Density]) -> LineChart {
    let names = densities.first().map_or(&[][..], |density| &density.schemes);
    let points = |place: usize| {
        let point = |density: &Density| {
            let line = density.schemes.get(place)?;
            let estimate = match part {
                Part::Reach => line.reach.times(100.0),
                Part::Rebroadcasts => line.rebroadcasts,
            };
            Some(estimate.at(f64::from(density.nodes as u32)))
        };
        densities.iter().filter_map(point).collect()
    };
    let series = |(place, line): (usize, &Line)| Series {
        name: line.scheme.clone(),
        stroke: Stroke::Solid,
        points: points(place),
    };
    let (title, y) = match part {
        Part::Reach => ("Nodes that a broadcast reaches", Axis::new("reach", "%").showing([0.0, 100.0])),
        Part::Rebroadcasts => {
            ("Nodes that forward a broadcast", Axis::new("rebroadcasts", "").showing([0.0, 0.0]))
        }
    };
    LineChart {
        title: title.to_owned(),
        x: Axis::new("nodes", ""),
        y,
        series: names.iter().enumerate().map(series).collect(),
    }
}
