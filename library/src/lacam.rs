//! LaCAM, lazy constraints addition search: Okumura (AAAI 2023), Algorithm 1. A depth-first search over the places of
//! all robots. Each place of all has a queue of constraints, of which each says where some robots go next; the others
//! follow PIBT. A constraint is made when the one before it has been tried, so that PIBT's first answer is taken where
//! it is good, and in the end every answer is tried.

use std::collections::{HashMap, VecDeque};

use crate::inheritance::{PIBT, Plan};
use crate::planned::{Only, Planner, PlannerProtocol, Tasks};
use crate::prelude::*;

/// Whether constraints are added, and whether those by which robots conflict are left out.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Lacam {
    has_constraints: bool,
    leaves_out_conflicts: bool,
}

/// Where some robots go, in the order of their numbers.
type Constraint = Vec<u8>;

/// Whence robots came, and the constraints that are yet to be tried.
type Node = (Option<Vec<u8>>, VecDeque<Constraint>);

impl Planner for Lacam {
    fn plan(&self, graph: &Graph, starts: &[u8], goals: &[u8]) -> Option<Vec<Vec<u8>>> {
        let root = || VecDeque::from([Constraint::new()]);
        let mut known: HashMap<Vec<u8>, Node> = HashMap::new();
        known.insert(starts.to_vec(), (None, root()));
        let mut open = vec![starts.to_vec()];
        let mut tries = 0;
        while let Some(now) = open.last().cloned() {
            tries += 1;
            if now == goals || tries > 10_000 {
                break;
            }
            let (_, constraints) = known.get_mut(&now)?;
            let Some(constraint) = constraints.pop_front() else {
                open.pop();
                continue;
            };
            if constraint.len() < now.len() && self.has_constraints {
                let here = now[constraint.len()];
                let cells = graph.beside(here).iter().chain([&here]);
                constraints.extend(cells.map(|&cell| [&constraint[..], &[cell]].concat()));
            }
            if self.leaves_out_conflicts && conflicts(&now[..constraint.len()], &constraint) {
                continue;
            }
            let Some(next) = generated(graph, &now, goals, &constraint) else { continue };
            if known.contains_key(&next) {
                continue;
            }
            known.entry(next.clone()).or_insert((Some(now), root()));
            open.push(next);
        }
        let mut plan = vec![open.pop().filter(|last| last == goals)?];
        while let Some((Some(before), _)) = known.get(plan.last()?) {
            plan.push(before.clone());
        }
        plan.pop();
        plan.reverse();
        Some(plan)
    }
}

/// The next places of all robots, if some of them go as the constraint says; `None` if the others cannot go then.
fn generated(graph: &Graph, now: &[u8], goals: &[u8], constraint: &[u8]) -> Option<Vec<u8>> {
    let mut next: Vec<Option<u8>> = constraint.iter().copied().map(Some).collect();
    next.resize(now.len(), None);
    let mut plan = Plan { rule: PIBT, graph, now, goals, next };
    let can_all_go = (0..now.len()).all(|robot| plan.next[robot].is_some() || plan.plan(robot));
    can_all_go.then(|| plan.next.into_iter().flatten().collect())
}

const SOLVABLE: Tasks = Tasks(Teams::within(Kind::Connected, 3, 2, 3), Only::Solvable);

const RULE: Lacam = Lacam { has_constraints: true, leaves_out_conflicts: true };

entry! { PlannerProtocol<Lacam>: "lacam", "LaCAM", "LACAM",
    "Okumura, *LaCAM: Search-Based Algorithm for Quick Multi-Agent Pathfinding*, AAAI 2023, Algorithm 1 and Theorem \
     1";
    PUBLISHED = "published", PlannerProtocol(RULE);
    BARE = "no constraints", PlannerProtocol(Lacam { has_constraints: false, ..RULE });
    MIXED = "any constraint", PlannerProtocol(Lacam { leaves_out_conflicts: false, ..RULE });
    1: "No two robots MUST come into one cell, or change places." {
        Holds PUBLISHED within SOLVABLE, not MIXED;
    }
    2: "A plan MUST be found if there is one." {
        Holds PUBLISHED within SOLVABLE, not BARE;
        Refuted BARE within SOLVABLE;
    }
}
