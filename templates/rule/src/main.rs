//! A rule to begin with. Copy this folder, and change the rule, which stands in `lib.rs`, and here its surroundings and
//! its promises. `cargo run` decides the promises, `cargo test` holds the verdicts.

use std::process::ExitCode;

use my_rule::{East, STARTS};
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::ledger::{self, Row};
use tautline_proofs::team::{Demand, Ground, Keeps, Places, Senses, Setting, Which};

/// The surroundings of the rule: every layout of 4×2 cells with at most two walls on the way.
static SETTING: Setting<'_, East> = Setting {
    senses: Senses::TEAM,
    // A round is noticed some 32 moves later.
    longest_run: 100,
    demands: &[
        Demand::always("EAST-1", "the robots are in different cells", &|moved| moved.after.cells_differ()),
        Demand::never_endless("EAST-2", "every run ends"),
    ],
    covers: &[("a step", &|moved| moved.has_moved(0)), ("a wall", &|moved| !moved.has_moved(0))],
    ..Setting::new("east", Ground::open(4, 2).walls(Which::Met(2)), 2, Places::At(|_| STARTS.to_vec()))
};

const OURS: NamedRule<East> = NamedRule::new("ours", East { looks: true });
const BLIND: NamedRule<East> = NamedRule::new("does not look", East { looks: false });

/// The promises, each with the verdict that you expect and mutants that must be rejected.
static CLAUSES: [Clause; 2] = [
    Clause {
        id: "EAST-1",
        sentence: "The robots MUST never share a cell.",
        checks: &[&Check::holds(OURS, &Keeps(&SETTING, 0), &[BLIND])],
    },
    Clause {
        id: "EAST-2",
        sentence: "Every run MUST end.",
        checks: &[&Check::holds(OURS, &Keeps(&SETTING, 1), &[])],
    },
];

fn decided() -> Vec<Row> {
    let clauses = ledger::register(&[&CLAUSES]).expect("each clause has an id of its own");
    ledger::decide_all(&clauses).expect("the bound is small enough to search")
}

fn main() -> ExitCode {
    let rows = decided();
    print!("{}", ledger::table(&rows));
    if rows.iter().all(Row::is_as_registered) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_verdict_is_the_registered_one() {
        for row in decided() {
            assert!(row.is_as_registered(), "{}: {:?}", row.clause.id, row.decision);
        }
    }
}
