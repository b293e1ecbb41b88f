//! All ways at one number of nodes, over all topologies.

use schemars::JsonSchema;
use serde::Serialize;

use super::Way;
use super::claims::{Claim, Decision};
use super::world::{Sample, Walked};
use tautline_field::stats::{Estimate, rounded};

/// All ways at one number of nodes.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Density {
    /// The number of nodes.
    pub nodes: usize,
    /// The share of the topologies in which links lead from the robot to the WFR: no journey succeeds in the others.
    pub linked: Estimate,
    /// The share of those in which the robot hears the call by k-FNF: without it no journey by TAN begins.
    pub told: Option<Estimate>,
    /// Way by way.
    pub ways: Vec<Line>,
    /// How many hops the robots have by TAN's trees for each hop that the shortest chain of links has, where TAN
    /// arrives.
    pub hops: Option<Estimate>,
    /// What the paper says, and what is so.
    pub claims: Vec<Decision>,
    /// The share of the topologies in which all arrive where TAN's way is shorter than Reich's.
    pub shorter_than_reich: Option<Estimate>,
    /// The topology in which the shortest way of those is the longest.
    pub longest: Option<u32>,
}

/// A way at one number of nodes.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
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

impl Density {
    /// Of all topologies with so many nodes.
    pub(super) fn of(nodes: usize, samples: &[&Sample]) -> Self {
        let linked = samples.iter().filter(|sample| sample.fewest_hops.is_some()).count() as u32;
        let told = samples.iter().filter(|sample| sample.tree_hops.is_some()).count() as u32;
        let all: Vec<(f64, [Walked; 4])> = samples.iter().filter_map(|sample| sample.all()).collect();
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
        let shorter =
            all.iter().filter(|(_, [tan, _, reich, _])| tan.length_m < reich.length_m).count() as u32;
        let longest = (0..).zip(samples).filter_map(|(topology, sample)| Some((sample.all()?.0, topology)));
        Self {
            nodes,
            linked: rounded(Estimate::share(linked, samples.len() as u32).unwrap_or(Estimate::NOTHING), 1e4),
            told: Estimate::share(told, linked).map(|share| rounded(share, 1e4)),
            ways: Way::ALL.iter().enumerate().map(line).collect(),
            hops: Estimate::of_ratio(&hops.collect::<Vec<_>>()).map(|ratio| rounded(ratio, 1e4)),
            claims: Claim::ALL.map(decision).into(),
            shorter_than_reich: Estimate::share(shorter, all.len() as u32).map(|share| rounded(share, 1e4)),
            longest: longest
                .max_by(|(one, _), (other, _)| one.total_cmp(other))
                .map(|(_, topology)| topology),
        }
    }
}
