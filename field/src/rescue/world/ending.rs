//! The outcome of a rescue when nothing more happens.

use tautline_kernel::mrc::Request;
use tautline_kernel::net::NodeId;
use tautline_proofs::mrc::Demand;

use super::{Happening, World};
use crate::radio::Air;
use crate::rescue::rover::Rover;
use crate::rescue::{Fate, Report};
use crate::tan::hops;

impl World<'_> {
    pub(super) fn report(mut self, air: Air) -> Report {
        for wfr in 0..self.wfrs.len() {
            self.measure_spread(wfr);
        }
        let mut fates = Vec::new();
        for wfr in 0..self.wfrs.len() {
            let of_wfr = (0..self.scenario.events()).map(|event| self.fate(wfr, event));
            let place = fates.len();
            fates.extend(of_wfr);
            if fates[place..].contains(&Fate::Abandoned) {
                self.judge.tell(Demand::IsServed, wfr, air.end_ns);
            }
        }
        let happenings = self.happenings.iter().flatten();
        Report {
            spreads: happenings.filter_map(|happening| happening.spread).collect(),
            fates,
            journeys: self.journeys,
            violations: self.judge.violations,
            log: self.log,
            paths: self.rovers.into_iter().map(|rover| rover.path).collect(),
            field: self.scenario.field.clone(),
            wfrs: self.scenario.wfrs.iter().map(|wfr| self.scenario.field.at(wfr.node)).collect(),
            air,
            packets: self.packets,
        }
    }

    fn fate(&self, wfr: usize, event: usize) -> Fate {
        let Some(&Happening { epoch, visits, .. }) = self.happenings[wfr].get(event) else {
            return Fate::StillToCome;
        };
        let first = self.journeys.iter().find(|journey| (journey.wfr, journey.event) == (wfr, event));
        if let Some(first) = first {
            return Fate::Served { by: first.robot, visits };
        }
        let node = self.scenario.wfrs[wfr].node;
        let nodes = self.linked(node);
        let is_linked = |rover: &&Rover| {
            !rover.has_failed && nodes.iter().any(|&node| self.link(node, rover, node).is_some())
        };
        let mut linked = self.rovers.iter().filter(is_linked).peekable();
        if linked.peek().is_none() {
            return Fate::CutOff;
        }
        let has_heard = |request: &Request| request.call.epoch >= epoch;
        if linked.any(|rover| rover.machine.request(node).is_some_and(has_heard)) {
            Fate::Abandoned
        } else {
            Fate::Unheard
        }
    }

    /// The nodes that live and are connected with `node` by links, over such nodes; itself included.
    pub(super) fn linked(&self, node: NodeId) -> Vec<NodeId> {
        let lives = |node: NodeId| !self.has_failed(node);
        let hops = hops(&self.scenario.network, node, lives);
        let linked = (0..).map(NodeId).zip(hops).filter(|&(node, hops)| hops.is_some() && lives(node));
        linked.map(|(node, _)| node).collect()
    }
}
