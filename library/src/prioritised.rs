//! Prioritised planning: Erdmann and Lozano-Pérez (1987), and revised prioritised planning: Čáp, Novák, Kleiner and
//! Selecký (IEEE Transactions on Automation Science and Engineering 12, 2015). Robots plan one after the other: each
//! takes a shortest way that meets none of those that are planned. Revised, a way also leaves out where robots of a
//! lower priority start; then, in a well-formed infrastructure, every robot has a way at last, after all the others.

use crate::planned::{Only, Planner, PlannerProtocol, Tasks};
use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a condition of the rule")]
struct PriorityPlanner {
    /// A way leaves out where robots of a lower priority start.
    leaves_out_starts: bool,
    /// A robot may stay at its goal only if no way that is planned comes through it later.
    can_stay: bool,
    /// A way changes places with none that is planned.
    has_no_swap: bool,
    /// A robot may wait on its way.
    waits: bool,
}

/// The cell of a way after so many steps.
fn at(way: &[u8], step: usize) -> u8 {
    way[step.min(way.len() - 1)]
}

impl PriorityPlanner {
    /// A shortest way that meets none of `ways`, within so many steps.
    fn way(&self, graph: &Graph, (start, goal): (u8, u8), ways: &[Vec<u8>], shut: &[u8]) -> Option<Vec<u8>> {
        let most = graph.len() * (ways.len() + 2);
        let mut ahead = vec![vec![start]];
        for step in 0..most {
            let is_quiet = |later: usize| ways.iter().all(|way| at(way, later) != goal);
            let can_stay = !self.can_stay || (step..=most).all(is_quiet);
            if let Some(way) = ahead.iter().find(|way| at(way, step) == goal && can_stay) {
                return Some(way.clone());
            }
            let mut next: Vec<Vec<u8>> = Vec::new();
            for way in ahead {
                let here = at(&way, step);
                for &cell in graph.beside(here).iter().chain([&here].into_iter().filter(|_| self.waits)) {
                    let meets = |other: &Vec<u8>| {
                        let is_swap = at(other, step) == cell && at(other, step + 1) == here;
                        at(other, step + 1) == cell || is_swap && self.has_no_swap
                    };
                    let is_known = next.iter().any(|way| way[step + 1] == cell);
                    if !is_known && !shut.contains(&cell) && !ways.iter().any(meets) {
                        next.push([&way[..], &[cell]].concat());
                    }
                }
            }
            ahead = next;
        }
        None
    }
}

impl Planner for PriorityPlanner {
    fn plan(&self, graph: &Graph, starts: &[u8], goals: &[u8]) -> Option<Vec<Vec<u8>>> {
        let mut ways: Vec<Vec<u8>> = Vec::new();
        for (robot, (&start, &goal)) in starts.iter().zip(goals).enumerate() {
            let shut = if self.leaves_out_starts { &starts[robot + 1..] } else { &[] };
            ways.push(self.way(graph, (start, goal), &ways, shut)?);
        }
        let longest = ways.iter().map(Vec::len).max().unwrap_or(0);
        Some((1..longest).map(|step| ways.iter().map(|way| at(way, step)).collect()).collect())
    }
}

const fn tasks(only: Only) -> Tasks {
    Tasks(Teams::within(Kind::Connected, 3, 3, 2), only)
}

const WIDE: Tasks = Tasks(Teams::within(Kind::Connected, 4, 3, 2).of_cells(7, 9), Only::WellFormed);
const RULE: PriorityPlanner =
    PriorityPlanner { leaves_out_starts: true, can_stay: true, has_no_swap: true, waits: true };

entry! { PlannerProtocol<PriorityPlanner>: "prioritised", "prioritised planning", "PRIO",
    "Erdmann, Lozano-Pérez, *On Multiple Moving Objects*, Algorithmica 2, 1987; revised: Čáp, Novák, Kleiner, \
     Selecký, *Prioritized Planning Algorithms for Trajectory Coordination of Multiple Mobile Robots*, IEEE T-ASE \
     12, 2015";
    REVISED = "revised", PlannerProtocol(RULE);
    OUTSIDE = "revised outside its premises", PlannerProtocol(RULE);
    CLASSIC = "classic", PlannerProtocol(PriorityPlanner { leaves_out_starts: false, ..RULE });
    HASTY = "stays anywhere", PlannerProtocol(PriorityPlanner { can_stay: false, ..RULE });
    RUSHES = "never waits", PlannerProtocol(PriorityPlanner { waits: false, ..RULE });
    SWAPS = "may swap", PlannerProtocol(PriorityPlanner { has_no_swap: false, ..RULE });
    1: "No two robots MUST come into one cell, or change places." {
        Holds CLASSIC within tasks(Only::All), not SWAPS, HASTY;
    }
    2: "A plan MUST be found." {
        Holds REVISED within tasks(Only::WellFormed), not RUSHES;
        Holds CLASSIC within tasks(Only::WellFormed), not RUSHES;
        Refuted OUTSIDE within tasks(Only::Solvable);
    } larger {
        Holds CLASSIC within WIDE;
        Holds REVISED within WIDE;
    }
}
