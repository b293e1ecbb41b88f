//! All ways at one number of nodes, over all topologies.

use super::super::estimates;
use super::super::prelude::*;
use super::claims::{Claim, Decision};
use super::world::{Sample, Walk, Way};

/// All ways at one number of nodes.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Density {
    /// The number of nodes.
    pub nodes: usize,
    /// The shape of the obstacle, where shapes are compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<&'static str>,
    /// The share of the topologies in which links lead from the robot to the WFR: no journey succeeds in the others.
    pub linked: Estimate,
    /// The share of those in which the robot hears the call by k-FNF: without it no journey by TAN begins.
    pub told: Option<Estimate>,
    /// The share of those in which the robot arrives by TAN.
    pub told_arrive: Option<Estimate>,
    /// Way by way.
    pub ways: Vec<Line>,
    /// How many hops the robots have by TAN's trees for each hop that the shortest chain of links has, where TAN
    /// arrives.
    pub hops: Option<Estimate>,
    /// The paper's claims, and what is so.
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
    pub(super) fn of(nodes: usize, shape: Option<&'static str>, samples: &[&Sample]) -> Self {
        let part = |share: Option<Estimate>| share.map(|share| rounded(share, 1e4));
        let linked = count(samples, |sample| sample.fewest_hops.is_some());
        let of_linked = |is_such: &dyn Fn(&Sample) -> bool| {
            part(Estimate::share(count(samples, |sample| is_such(sample)), linked))
        };
        let all: Vec<(f64, [Walk; 4])> = samples.iter().filter_map(|sample| sample.all()).collect();
        let ratio = |value: &dyn Fn(&[Walk; 4]) -> Option<f64>| {
            let pairs = all.iter().map(|(shortest_m, walked)| Some((value(walked)?, *shortest_m)));
            estimates::ratio(pairs.collect::<Option<Vec<_>>>()?)
        };
        let line = |(place, way): (usize, Way)| Line {
            way,
            arrivals: of_linked(&|sample| sample.walked[place].is_some()),
            ratio: ratio(&|walked| Some(walked[place].length_m)),
            seconds: ratio(&|walked| walked[place].time_s),
        };
        let [tan, reich] = [Way::Tan, Way::Reich].map(|way| way as usize);
        let decision = |paper: Claim| {
            let rival = paper.rival() as usize;
            let difference = ratio(&|walked| Some(walked[tan].length_m - walked[rival].length_m));
            Decision { paper, difference, verdict: paper.verdict(difference) }
        };
        let arrived = samples.iter().filter(|sample| sample.walked[tan].is_some());
        let hops =
            arrived.filter_map(|sample| Some((f64::from(sample.tree_hops?), f64::from(sample.fewest_hops?))));
        let longest = (0..).zip(samples).filter_map(|(topology, sample)| Some((sample.all()?.0, topology)));
        let longest = longest.max_by(|(one, _), (other, _)| one.total_cmp(other));
        Self {
            nodes,
            shape,
            linked: part(Estimate::share(linked, samples.len() as u32)).unwrap_or(Estimate::NOTHING),
            told: of_linked(&|sample| sample.tree_hops.is_some()),
            told_arrive: part(Estimate::share(
                count(samples, |sample| sample.walked[tan].is_some()),
                count(samples, |sample| sample.tree_hops.is_some()),
            )),
            ways: Way::ALL.into_iter().enumerate().map(line).collect(),
            hops: estimates::ratio(hops),
            claims: Claim::ALL.map(decision).into(),
            shorter_than_reich: part(share(&all, |(_, walked)| {
                walked[tan].length_m < walked[reich].length_m
            })),
            longest: longest.map(|(_, topology)| topology),
        }
    }

    /// Whether TAN has problems with this shape: robots that hear the call do not arrive. That it has none is said
    /// where nearly all arrive by the whole 95 % interval.
    pub(super) fn problems(&self) -> Option<Judgement> {
        let verdict = always(Some(self.told_arrive?)).contrary();
        let sentence = "“might have problems … obstacles of any shapes” (5)";
        Some(Judgement::new(sentence, self.shape?, self.arrivals(), verdict))
    }

    /// Whether all robots that hear the call arrive.
    pub(super) fn success(&self) -> Option<Judgement> {
        let sentence = "“robots can be successfully navigated … for all simulated scenarios” (4.3)";
        let of = counted(self.nodes as u32, "node");
        Some(Judgement::new(sentence, of, self.arrivals(), always(Some(self.told_arrive?))))
    }

    fn arrivals(&self) -> String {
        let [told, arrive] = [self.told, self.told_arrive].map(|share| percent(share, 1));
        format!("{told} % hear the call, {arrive} % of these arrive")
    }
}

impl Claim {
    /// The verdicts on it at all densities, or whether it is so at one of them, or in one topology.
    pub(super) fn judged(self, densities: &[Density]) -> Vec<Judgement> {
        let decisions = densities.iter().filter_map(|density| {
            let decision = density.claims.iter().find(|decision| decision.paper == self);
            decision.map(|decision| (density, decision))
        });
        let less = |decision: &Decision| {
            format!("TAN less {} {}", self.rival().word(), text(decision.difference, 2))
        };
        let of = |density: &Density| counted(density.nodes as u32, "node");
        if !self.is_of_some() {
            let judged = |(density, decision): (&Density, &Decision)| {
                Judgement::new(self.words(), of(density), less(decision), decision.verdict)
            };
            return decisions.map(judged).collect();
        }
        let in_mean =
            decisions.clone().map(|(_, decision)| decision.verdict).fold(Verdict::Fails, Verdict::or);
        let mean = |decision: &Decision| decision.difference.map_or(f64::INFINITY, |less| less.mean);
        let least = decisions.min_by(|(_, one), (_, other)| mean(one).total_cmp(&mean(other)));
        let least = least.map_or_else(String::new, |(density, decision)| {
            format!("{} at {}, the least", less(decision), of(density))
        });
        let shares = densities.iter().filter_map(|density| density.shorter_than_reich);
        let most = shares.max_by(|one, other| one.mean.total_cmp(&other.mean));
        let is_any = most.is_some_and(|share| share.mean > 0.0);
        let most = format!("so in at most {} % of them", percent(most, 1));
        vec![
            Judgement::new(self.words(), "in the mean, at some number of nodes", least, in_mean),
            Judgement::new(self.words(), "in some topology", most, Verdict::decided(is_any, false)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(hops: [Option<u16>; 2], shortest_m: Option<f64>, walked_m: [Option<f64>; 4]) -> Sample {
        let walk = |length_m: f64| Walk { length_m, time_s: Some(2.0 * length_m) };
        let [fewest_hops, tree_hops] = hops;
        Sample { fewest_hops, tree_hops, shortest_m, walked: walked_m.map(|way| way.map(walk)) }
    }

    /// In two topologies all arrive. In the third TAN's robot does not hear the call, in the fourth it loses its way,
    /// and in the fifth no links lead to the WFR.
    fn samples() -> [Sample; 5] {
        let all = |way: [f64; 4]| way.map(Some);
        let others = |metres: f64| [None, Some(metres), Some(metres), Some(metres)];
        [
            sample([Some(2), Some(3)], Some(100.0), all([130.0, 110.0, 140.0, 200.0])),
            sample([Some(4), Some(5)], Some(300.0), all([330.0, 330.0, 330.0, 330.0])),
            sample([Some(1), None], Some(50.0), others(50.0)),
            sample([Some(3), Some(6)], Some(80.0), others(80.0)),
            sample([None, None], None, [None; 4]),
        ]
    }

    #[test]
    fn each_number_is_of_the_topologies_that_its_heading_says() {
        let samples = samples();
        let density = Density::of(700, Some("u"), &samples.iter().collect::<Vec<_>>());
        let mean = |estimate: Option<Estimate>| estimate.map(|estimate| (estimate.count, estimate.mean));
        assert_eq!((density.linked.count, density.linked.mean), (5, 0.8));
        assert_eq!(mean(density.told), Some((4, 0.75)), "of those linked");
        assert_eq!(mean(density.told_arrive), Some((3, 0.6667)), "of those told");
        let of = |way: Way| &density.ways[way as usize];
        assert_eq!(
            [of(Way::Tan), of(Way::Sheu)].map(|way| mean(way.arrivals)),
            [Some((4, 0.5)), Some((4, 1.0))]
        );
        // Where all arrive, 460 m and 440 m for 400 m: no mean of the ratios of single topologies.
        assert_eq!(mean(of(Way::Tan).ratio), Some((2, 1.15)));
        assert_eq!(mean(of(Way::Verma).ratio), Some((2, 1.1)));
        assert_eq!(mean(of(Way::Tan).seconds), Some((2, 2.3)));
        assert_eq!(mean(density.hops), Some((2, 1.3333)), "8 for 6: a robot that is lost has no hops");
        assert_eq!(mean(density.shorter_than_reich), Some((2, 0.5)), "as long is not shorter");
        assert_eq!(density.longest, Some(1));
        let less = |claim: Claim| density.claims.iter().find(|decision| decision.paper == claim);
        let less = |claim| less(claim).and_then(|decision| mean(decision.difference));
        assert_eq!(less(Claim::CloseToVerma), Some((2, 0.05)));
        assert_eq!(less(Claim::LikeReich), Some((2, -0.025)));
    }

    #[test]
    fn a_shape_is_a_problem_where_one_is_lost_and_is_none_where_many_arrive() {
        let samples = samples();
        let verdict = |of: &[&Sample]| Density::of(700, Some("u"), of).problems().map(|one| one.verdict);
        assert_eq!(verdict(&samples.iter().collect::<Vec<_>>()), Some(Verdict::Holds));
        assert_eq!(verdict(&[&samples[0]]), Some(Verdict::Open), "one robot says little");
        assert_eq!(verdict(&[&samples[0]; 100]), Some(Verdict::Fails));
        assert_eq!(verdict(&[&samples[2]]), None);
    }
}
