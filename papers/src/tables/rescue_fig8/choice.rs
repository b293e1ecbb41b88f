//! The choice of MRC by hops: whether the robot that comes has the fewest, and how many targets robots are on their way
//! to at once, beside those to which they would go by Reich's scheme, each to its nearest.

use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{Rule, Scheme, Stage};
use tautline_proofs::engine::Tape;

use super::super::notice_fig5::RANGE_M;
use super::super::prelude::*;
use tautline_field::radio::{
    Channel, Faults, LONGEST_WAIT_NS, Model, Network, Point, Problem, Radio, broadcast,
};
use tautline_field::rescue::{Event, Fate, Report};
use tautline_field::tan::{ROBOT_REACH, hops};

/// The choices of one topology.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub(super) struct Choices {
    /// The WFRs to which a robot has come.
    pub(super) served: u32,
    /// Those to which one came that had the fewest hops of the robots that were not on their way when it was chosen.
    pub(super) nearest_available: u32,
    /// Those to which one came that had the fewest hops of all robots when the WFR first called.
    pub(super) nearest: u32,
    /// The most WFRs to which robots were on their way at once.
    pub(super) at_once: u32,
    /// The WFRs to which robots would go if each went to the one that it has the fewest hops from.
    pub(super) uncoordinated: u32,
    /// The most robots that would go to the same one.
    pub(super) crowd: u32,
}

/// The hops of a robot at `at` that hears the nodes which have these, if it hears any.
fn hops_at(report: &Report, hops: &[Option<u16>], range_m: f64, at: Point) -> Option<u16> {
    let nodes = report.field.nodes().iter().zip(hops);
    let heard = nodes.filter(|(node, _)| {
        let (east_m, south_m) = (node.x_m - at.x_m, node.y_m - at.y_m);
        (east_m * east_m + south_m * south_m).sqrt() <= ROBOT_REACH * range_m
    });
    heard.filter_map(|(_, hops)| *hops).min().map(|hops| hops.saturating_add(1))
}

impl Choices {
    /// Of a rescue without faults, in which every call spreads as the first one.
    pub(super) fn of(scheme: Scheme, report: &Report) -> Result<Self, Problem> {
        let wfrs = report.fates.len();
        let radio = Radio::new(RANGE_M, Model::Disc)?;
        // A disc and k-FNF over the ideal channel leave nothing to chance.
        let network = Network::new(&report.field, radio, &mut Tape(&[]))?;
        let rule = Rule::new(scheme, radio.range_um(), LONGEST_WAIT_NS);
        let (mut tree, mut fewest) = (vec![Vec::new(); wfrs], vec![Vec::new(); wfrs]);
        for logged in &report.log {
            if let Event::Calls { wfr, node, .. } = logged.event
                && tree[wfr.0].is_empty()
            {
                let source = NodeId(node);
                let (_, nodes) =
                    broadcast(&network, &rule, Channel::Ideal, &Faults::NONE, source, &mut Tape(&[]))?;
                let of_path_node =
                    nodes.iter().map(|node| node.hops().filter(|_| node.stage() == Stage::Forwarded));
                tree[wfr.0] = of_path_node.collect();
                fewest[wfr.0] = hops(&network, source, |_| true);
            }
        }
        let distance = |hops: &[Vec<Option<u16>>], wfr: usize, at| hops_at(report, &hops[wfr], RANGE_M, at);
        let starts: Vec<Point> = report.paths.iter().filter_map(|path| Some(path.first()?.at)).collect();
        let mut choices = Self::default();
        let mut crowds = vec![0; wfrs];
        for &start in &starts {
            let nearest = (0..wfrs).filter_map(|wfr| Some((distance(&fewest, wfr, start)?, wfr))).min();
            if let Some((_, wfr)) = nearest {
                crowds[wfr] += 1;
            }
        }
        choices.uncoordinated = count(&crowds, |&crowd| crowd > 0);
        choices.crowd = crowds.into_iter().max().unwrap_or(0);
        // The WFR to which each robot is on its way; of each WFR and robot, whether it was nearest when chosen last.
        let mut ways: Vec<Option<usize>> = vec![None; starts.len()];
        let mut was_nearest = vec![vec![false; starts.len()]; wfrs];
        for logged in &report.log {
            match logged.event {
                Event::Chooses { wfr, robot, .. } => {
                    let at = |robot: usize| {
                        let path = &report.paths[robot];
                        let fix = path.iter().rev().find(|fix| fix.at_ns <= logged.at_ns);
                        distance(&tree, wfr.0, fix.map_or(starts[robot], |fix| fix.at))
                    };
                    let others = (0..starts.len()).filter(|&other| other != robot.0 && ways[other].is_none());
                    let least = others.filter_map(at).min();
                    was_nearest[wfr.0][robot.0] =
                        at(robot.0).is_some_and(|ours| least.is_none_or(|least| ours <= least));
                }
                Event::SetsOut { robot, wfr, .. } => {
                    ways[robot.0] = Some(wfr.0);
                    let has_one = |wfr: usize| ways.contains(&Some(wfr));
                    choices.at_once = choices.at_once.max(count(0..wfrs, has_one));
                }
                Event::Arrives { robot, .. } | Event::LetsGo { robot, .. } => ways[robot.0] = None,
                Event::Recurs { .. }
                | Event::Calls { .. }
                | Event::Hears { .. }
                | Event::Asks { .. }
                | Event::CountsOn { .. }
                | Event::Declines { .. }
                | Event::Passes { .. }
                | Event::LosesItsWay { .. }
                | Event::RobotFails { .. }
                | Event::NodeFails { .. } => {}
            }
        }
        for (wfr, fate) in report.fates.iter().enumerate() {
            if let Fate::Served { by, .. } = *fate {
                let of = |robot: usize| distance(&tree, wfr, starts[robot]);
                let least = (0..starts.len()).filter_map(of).min();
                choices.served += 1;
                choices.nearest_available += u32::from(was_nearest[wfr][by]);
                choices.nearest += u32::from(of(by).is_some() && of(by) == least);
            }
        }
        Ok(choices)
    }
}
