//! A rule of two robots: the first one goes ahead and turns right at a wall, the second one follows where the first one
//! was. It looks right, and it is not: searched in all layouts of a small area, it breaks its promise where a wall
//! stands between the two at the start. Repaired, both start in one cell.

use std::env;
use std::error::Error;
use std::path::Path;

use tautline_kernel::ground::{Cell, Side, Step};
use tautline_proofs::clause::{Check, Clause, Named};
use tautline_proofs::decide::Seen;
use tautline_proofs::decide::Verdict::{Holds, Refuted};
use tautline_proofs::ledger::{self, Row};
use tautline_proofs::run::Run;
use tautline_proofs::team::{Demand, Keeps, Layouts, Team};
use tautline_sim::atomic_file::Replaceable;
use tautline_sim::counterexample::own::Found;

/// Two robots, and all that they know. The last two fields are the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Pair {
    cells: [Cell; 2],
    left: Cell,
    heading: Side,
    walls: u8,
    is_eager: bool,
    most_walls: u8,
}

impl Pair {
    const fn starting(leader: Cell) -> Self {
        let left = Cell::new(0, 0);
        Self { cells: [leader, left], left, heading: Side::East, walls: 0, is_eager: false, most_walls: 3 }
    }
}

impl Team<2> for Pair {
    fn plan(&mut self) -> Option<[Step; 2]> {
        let side = Side::ALL.into_iter().find(|&side| self.cells[1].beyond(side) == self.left);
        let steps = [Step::Cross(self.heading), side.map_or(Step::Stay, Step::Cross)];
        (self.walls < self.most_walls).then_some(steps)
    }

    fn settle(&mut self, cells: [Cell; 2], [is_blocked, _]: [bool; 2]) {
        if is_blocked {
            (self.heading, self.walls) = (self.heading.turned_right(), (self.walls + 1) % 4);
        } else {
            self.left = if self.is_eager { cells[0] } else { self.cells[0] };
        }
        self.cells = cells;
    }
}

static LAYOUTS: Layouts<Pair, Pair, 2> = Layouts {
    scheme: "followers",
    size: (4, 3),
    max_walls: 3,
    longest_run: 100,
    start: |pair| (*pair, pair.cells),
    demands: &[
        Demand::always("FOLLOW-1", "the robots are at most two steps apart", |moved| {
            let (columns, rows) = moved.to[0].apart(moved.to[1]);
            columns + rows <= 2
        }),
        Demand::always("FOLLOW-2", "the follower enters no occupied cell", |moved| {
            moved.from[1] == moved.to[1] || moved.to[0] != moved.to[1]
        }),
        Demand::never_endless("FOLLOW-3", "no run comes back to where it was"),
    ],
    covers: &[
        ("a step", |moved| moved.from[1] != moved.to[1]),
        ("a wall", |moved| moved.from[0] == moved.to[0]),
    ],
};

const WRITTEN: Pair = Pair::starting(Cell::new(1, 0));
const OURS: Named<Pair> = Named::new("repaired", Pair::starting(Cell::new(0, 0)));
const EAGER: Named<Pair> = Named::new("follows at once", Pair { is_eager: true, ..OURS.rule });
const ENDLESS: Named<Pair> = Named::new("never gives up", Pair { most_walls: 4, ..OURS.rule });

/// What is promised.
pub static CLAUSES: [Clause; 3] = [
    Clause {
        id: "FOLLOW-1",
        sentence: "The robots MUST stay at most two steps apart.",
        checks: &[
            &Check::new(Named::new("written", WRITTEN), &Keeps(&LAYOUTS, 0), Refuted, &[]),
            &Check::new(OURS, &Keeps(&LAYOUTS, 0), Holds, &[Named::new("as written", WRITTEN)]),
        ],
    },
    Clause {
        id: "FOLLOW-2",
        sentence: "The follower MUST never enter the leader's cell.",
        checks: &[&Check::new(OURS, &Keeps(&LAYOUTS, 1), Holds, &[EAGER])],
    },
    Clause {
        id: "FOLLOW-3",
        sentence: "Every run MUST end.",
        checks: &[&Check::new(OURS, &Keeps(&LAYOUTS, 2), Holds, &[ENDLESS])],
    },
];

/// The smallest run that breaks a check which is registered as refuted.
fn counterexample(rows: &[Row]) -> Option<&Run> {
    rows.iter().find_map(|row| match &row.decision.counterexample.as_ref()?.seen {
        Seen::Robots(run) => Some(&**run),
        _ => None,
    })
}

/// Prints the ledger, and stores the counterexample in the file that is named, if one is.
fn main() -> Result<(), Box<dyn Error>> {
    let rows = ledger::decide_all(&ledger::register(&[&CLAUSES])?)?;
    print!("{}", ledger::table(&rows));
    if let (Some(path), Some(run)) = (env::args().nth(1), counterexample(&rows)) {
        let found = Found { layouts: &LAYOUTS, rule: ("written", &WRITTEN), run };
        let (file, _) = found.store(Path::new(&path), &Replaceable::default())?;
        file.keep()?;
        println!("\nplay the counterexample with: tautline replay {path}");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn every_check_comes_out_as_it_is_registered_and_what_is_found_is_what_the_tutorial_draws() {
        let rows = ledger::decide_all(&ledger::register(&[&CLAUSES]).expect("ids of their own"));
        let rows = rows.expect("it can be searched");
        for row in &rows {
            assert!(row.is_as_registered(), "{}: {:?}", row.clause.id, row.decision);
        }
        let tutorial = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/own-rule.md");
        assert!(fs::read_to_string(tutorial).expect("a page").contains(&ledger::table(&rows)));
        let run = counterexample(&rows).expect("the rule as written is refuted");
        let found = Found { layouts: &LAYOUTS, rule: ("written", &WRITTEN), run };
        assert_eq!((run.walls.len(), run.frames.len()), (1, 2));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("found.jsonl");
        found.store(&path, &Replaceable::default()).expect("room").0.keep().expect("room");
        let read = |path: &Path| fs::read_to_string(path).expect("a file");
        let drawn = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/follow-1-written.jsonl");
        assert_eq!(read(&path), read(&drawn));
    }
}
