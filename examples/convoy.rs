//! The followers of the tutorial, however many: each robot follows the next one, and none is left behind, for every
//! number of robots and every layout. And a rule that looks as local and is not: it knows where a fence is.

use std::error::Error;
use std::{env, fs};

use tautline_kernel::ground::{Cell, Step};
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::ledger;
use tautline_proofs::local::{Act, EveryNumber, Far, Invariant, Local, Plan, Robot, chain};

/// Whether a robot waits for the one behind it, and whether all stay east of a fence.
#[derive(Clone, Copy)]
struct Convoy {
    waits: bool,
    is_fenced: bool,
}

fn steps(one: Cell, other: Cell) -> u16 {
    let (columns, rows) = one.apart(other);
    columns + rows
}

impl Local for Convoy {
    type State = ();
    type Act = Step;

    fn states(&self) -> Vec<()> {
        vec![()]
    }
    /// A robot that tries to go goes or meets a wall.
    fn acts(&self, (): ()) -> Vec<Act<(), Step>> {
        let act = |step| Act { act: step, step, ends: vec![(true, ()), (false, ())], needs_open: false };
        Step::ALL.into_iter().map(act).collect()
    }
    /// The one behind goes to the cell of the one ahead, which leaves nobody farther behind than two steps.
    fn admits(&self, plans: &[Plan<(), Step>]) -> bool {
        let [ahead, behind] = [&plans[0], &plans[1]];
        let follows = behind.step == Step::Stay || behind.to() == ahead.robot.at;
        let waits = steps(ahead.to(), behind.robot.at) <= 2;
        let is_inside = ahead.to().x >= 0;
        follows && (waits || !self.waits) && (is_inside || !self.is_fenced)
    }
    fn keeps(&self, robots: &[Robot<()>]) -> bool {
        steps(robots[0].at, robots[1].at) <= 2
    }
    fn reach(&self) -> (i16, Far) {
        (2, Far::Broken)
    }
    fn may_start(&self, robots: &[Robot<()>]) -> bool {
        robots[0].at == robots[1].at
    }
    fn start(&self, robots: usize) -> Vec<Robot<()>> {
        vec![Robot::new(Cell::new(0, 0), ()); robots]
    }
    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        chain(robots)
    }
}

const OURS: Convoy = Convoy { waits: true, is_fenced: false };
const HASTY: Convoy = Convoy { waits: false, ..OURS };
const FENCED: Convoy = Convoy { is_fenced: true, ..OURS };

/// The promise.
pub static CLAUSES: [Clause; 1] = [Clause {
    id: "CONVOY-1",
    sentence: "Each robot MUST stay at most two steps behind the next one.",
    checks: &[&Check::holds(
        NamedRule::new("ours", OURS),
        &EveryNumber::DEFAULT,
        &[NamedRule::new("waits for nobody", HASTY)],
    )],
}];

/// The theorem that CONVOY-1 holds for every number of robots, as a file that Rocq checks.
fn theorem() -> Result<String, Box<dyn Error>> {
    let found = CLAUSES[0].checks[0].certificate().ok_or("the promise does not hold")?;
    Ok(found?)
}

/// Prints the ledger, and the answer to the rule that is not local; stores the theorem in the file that is named, if
/// one is.
fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", ledger::table(&ledger::decide_all(&ledger::register(&[&CLAUSES])?)?));
    if let Err(refusal) = Invariant::of(&FENCED) {
        println!("\nwith a fence: {refusal}");
    }
    if let Some(path) = env::args().nth(1) {
        fs::write(path, theorem()?)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn a_convoy_is_decided_for_every_number_of_robots_and_a_fence_is_refused() {
        let rows = ledger::decide_all(&ledger::register(&[&CLAUSES]).expect("ids of their own"));
        let rows = rows.expect("a local rule");
        assert!(rows.iter().all(ledger::Row::is_as_registered), "{rows:?}");
        let tutorial = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/own-rule.md");
        let page = fs::read_to_string(tutorial).expect("a page");
        assert!(page.contains(&ledger::table(&rows)), "{}", ledger::table(&rows));
        assert!(theorem().expect("it holds").contains("Theorem"));
        let refusal = Invariant::of(&FENCED).expect_err("it knows a place").to_string();
        assert!(page.contains(&refusal), "{refusal}");
    }
}
