//! A message protocol over all states and all orders: three robots in a ring elect a leader (Chang and Roberts, 1979).
//! A robot passes on a larger number than its own, swallows a smaller one, and leads when its own comes back. Which
//! message arrives next is open at every step.

use tautline_kernel::choice::Oracle;
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::decide::{Depiction, EveryState, MethodError};
use tautline_proofs::engine::states::System;
use tautline_proofs::engine::world::{Turn, World};
use tautline_proofs::ledger;

const ROBOTS: usize = 3;

/// A robot's treatment of a smaller number than its own.
#[derive(Clone, Copy)]
enum Smaller {
    Swallow,
    PassOn,
}

/// The numbers on their way to each robot, the one sent last at the end, and who takes itself for the leader.
#[derive(Clone, PartialEq, Eq, Hash, Default)]
struct Ring {
    under_way: [Vec<usize>; ROBOTS],
    leads: [bool; ROBOTS],
}

struct Election(Smaller);

/// A robot hears a number.
struct Reception {
    robot: usize,
    number: usize,
    passes_on: bool,
}

impl World for Election {
    type State = Ring;
    /// The robots that a number has reached.
    type Plan = Vec<usize>;
    type Event = Reception;
    type Demand = &'static str;

    fn plan(&self, ring: &mut Ring, _: &[u8]) -> Option<Vec<usize>> {
        let reached = (0..ROBOTS).filter(|&robot| !ring.under_way[robot].is_empty()).collect();
        Some(reached).filter(|reached: &Vec<usize>| !reached.is_empty())
    }

    fn settle(
        &self,
        ring: &mut Ring,
        reached: &Vec<usize>,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Reception {
        let robot = reached[world.pick(reached.len() as u32) as usize];
        let number = ring.under_way[robot].remove(0);
        let passes_on = number > robot || number < robot && matches!(self.0, Smaller::PassOn);
        if passes_on {
            ring.under_way[(robot + 1) % ROBOTS].push(number);
        }
        ring.leads[robot] |= number == robot;
        Reception { robot, number, passes_on }
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        let leaders = turn.after.leads.iter().filter(|&&leads| leads).count();
        if leaders > 1 { vec!["two robots lead"] } else { Vec::new() }
    }

    fn broken_at_end(&self, ring: &Ring, _: &[u8]) -> Vec<&'static str> {
        if ring.leads.contains(&true) { Vec::new() } else { vec!["nobody leads"] }
    }

    fn covers(&self) -> Vec<&'static str> {
        vec!["a number goes on", "a number stops"]
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        if turn.event.passes_on { 1 } else { 2 }
    }
}

impl System for Election {
    type Part = Ring;

    fn part(&self, ring: &Ring, _: usize) -> Ring {
        ring.clone()
    }

    fn put(&self, ring: &mut Ring, _: usize, part: &Ring) {
        ring.clone_from(part);
    }
}

static ORDERS: EveryState<Smaller, Election> = EveryState {
    range: || format!("{ROBOTS} robots, every order of their messages"),
    system: |&smaller| Election(smaller),
    starts: |_| vec![Ring { under_way: [vec![2], vec![0], vec![1]], leads: [false; ROBOTS] }],
    most_steps: 10_000,
    covers: &["a number goes on", "a number stops", "an end"],
    tell: |_, step| {
        let Reception { robot, number, .. } = step.event;
        let now = if step.state.leads[robot] { ", and leads" } else { "" };
        format!("{robot} hears {number}{now}.")
    },
};

const OURS: NamedRule<Smaller> = NamedRule::new("swallows", Smaller::Swallow);
const POLITE: NamedRule<Smaller> = NamedRule::new("passes everything on", Smaller::PassOn);

/// The promises.
static CLAUSES: [Clause; 1] = [Clause {
    id: "ELECT-1",
    sentence: "Exactly one robot MUST lead in the end, and never two.",
    checks: &[&Check::holds(OURS, &ORDERS, &[POLITE]), &Check::refuted(POLITE, &ORDERS)],
}];

fn main() -> Result<(), MethodError> {
    let rows = ledger::decide_all(&ledger::register(&[&CLAUSES]).map_err(MethodError::new)?)?;
    print!("{}", ledger::table(&rows));
    for evidence in rows.iter().filter_map(|row| row.decision.counterexample.as_ref()) {
        if let Depiction::Story(story) = &evidence.seen {
            print!("\n{}:\n{story}", evidence.demand);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_check_comes_out_as_it_is_registered() {
        for row in ledger::decide_all(&[&CLAUSES[0]]).expect("it can be searched") {
            assert!(row.is_as_registered(), "{}: {:?}", row.clause.id, row.decision);
        }
    }
}
