//! A rule of two robots: the first one goes ahead and turns right at a wall, the second one follows where the first one
//! was. It looks right, and it is not: searched in all layouts of a small area, it breaks its promise where a wall
//! stands between the two at the start. Repaired, both start in one cell.

use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

use tautline_io::atomic_file::Replaceable;
use tautline_kernel::ground::{Cell, Side};
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::decide::Depiction;
use tautline_proofs::engine::states::Limits;
use tautline_proofs::ledger::{self, Row};
use tautline_proofs::run::Run;
use tautline_proofs::team::{Act, Demand, Ground, Keeps, Places, Rule, Scene, Senses, Setting, View, Which};
use tautline_sim::counterexample::own::OwnRun;

/// The rule: where the leader starts, whether the follower goes to where the leader is, and how many walls end a run.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Followers {
    leader: Cell,
    is_eager: bool,
    most_walls: u8,
}

impl Rule for Followers {
    /// Where the leader heads, the walls that it has met, and the last two
    /// cells in which it was seen, the latest first.
    type Memory = (Side, u8, [Cell; 2]);
    type Message = ();

    fn start(&self, _: usize, starts: &[Cell]) -> Self::Memory {
        (Side::East, 0, [starts[0], starts[1]])
    }

    fn act(&self, view: &mut View<'_, Self>, (heading, walls, trail): &mut Self::Memory) -> Act {
        if view.me() == 0 {
            if view.was_blocked() {
                (*heading, *walls) = (heading.turned_right(), (*walls + 1).min(3));
            }
            return Act::Go(*heading);
        }
        if let Some(leader) = view.sees(0).filter(|&leader| leader != trail[0]) {
            *trail = [leader, trail[0]];
        }
        view.side_to(trail[usize::from(!self.is_eager)]).map_or(Act::Wait, Act::Go)
    }

    fn is_done(&self, _: usize, team: &Scene<Self>) -> bool {
        team.memory(0).1 + u8::from(team.was_blocked(0)) >= self.most_walls
    }
}

const GROUND: Ground = Ground::open(4, 3).walls(Which::Met(3));

static SETTING: Setting<'_, Followers> = Setting {
    senses: Senses::TEAM,
    longest_run: 100,
    demands: &[
        Demand::always("FOLLOW-1", "the robots are at most two steps apart", &|moved| {
            let (columns, rows) = moved.after.cell(0).apart(moved.after.cell(1));
            columns + rows <= 2
        }),
        Demand::always("FOLLOW-2", "the follower enters no occupied cell", &|moved| {
            !moved.has_moved(1) || moved.after.cells_differ()
        }),
        Demand::never_endless("FOLLOW-3", "no run comes back to where it was"),
    ],
    covers: &[("a step", &|moved| moved.has_moved(1)), ("a wall", &|moved| !moved.has_moved(0))],
    ..Setting::new("followers", GROUND, 2, Places::At(|rule| vec![rule.leader, Cell::new(0, 0)]))
};

const WRITTEN: Followers = Followers { leader: Cell::new(1, 0), is_eager: false, most_walls: 3 };
const OURS: NamedRule<Followers> =
    NamedRule::new("repaired", Followers { leader: Cell::new(0, 0), ..WRITTEN });
const EAGER: NamedRule<Followers> =
    NamedRule::new("follows at once", Followers { is_eager: true, ..OURS.rule });
const ENDLESS: NamedRule<Followers> =
    NamedRule::new("never gives up", Followers { most_walls: 9, ..OURS.rule });

/// The promises.
pub static CLAUSES: [Clause; 3] = [
    Clause {
        id: "FOLLOW-1",
        sentence: "The robots MUST stay at most two steps apart.",
        checks: &[
            &Check::refuted(NamedRule::new("written", WRITTEN), &Keeps(&SETTING, 0)),
            &Check::holds(OURS, &Keeps(&SETTING, 0), &[NamedRule::new("as written", WRITTEN)]),
        ],
    },
    Clause {
        id: "FOLLOW-2",
        sentence: "The follower MUST never enter the leader's cell.",
        checks: &[&Check::holds(OURS, &Keeps(&SETTING, 1), &[EAGER])],
    },
    Clause {
        id: "FOLLOW-3",
        sentence: "Every run MUST end.",
        checks: &[&Check::holds(OURS, &Keeps(&SETTING, 2), &[ENDLESS])],
    },
];

/// The smallest run that breaks a check which is registered as refuted.
fn counterexample(rows: &[Row]) -> Option<&Run> {
    rows.iter().find_map(|row| match &row.decision.counterexample.as_ref()?.seen {
        Depiction::Robots(run) => Some(&**run),
        _ => None,
    })
}

/// The certificate of the repaired rule's check of FOLLOW-1, once a checker
/// has accepted it that shares no code with the search.
fn certificate() -> Result<Vec<u8>, Box<dyn Error>> {
    let bytes = ledger::certificate(&CLAUSES[0], 1, Limits::NONE)?;
    let examined = ledger::examine(&bytes, &CLAUSES)?;
    let counts = examined.outcome.map_err(|(section, why)| format!("section {section}: {why}"))?;
    println!("accepted: {} runs", counts.ends);
    Ok(bytes)
}

/// Prints the ledger, and stores the counterexample in the first file that is named, and the certificate in the second.
fn main() -> Result<(), Box<dyn Error>> {
    let rows = ledger::decide_all(&ledger::register(&[&CLAUSES])?)?;
    print!("{}", ledger::table(&rows));
    if let (Some(path), Some(run)) = (env::args().nth(1), counterexample(&rows)) {
        let found = OwnRun { setting: &SETTING, rule: ("written", &WRITTEN), run };
        let (file, _) = found.store(Path::new(&path), &Replaceable::default())?;
        file.keep()?;
        println!("\nplay the counterexample with: tautline replay {path}");
    }
    if let Some(path) = env::args().nth(2) {
        fs::write(path, certificate()?)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_certificate_of_a_rule_of_ones_own_is_accepted_and_one_that_is_changed_is_refused() {
        let mut bytes = certificate().expect("it holds");
        *bytes.last_mut().expect("a digest") ^= 1;
        assert!(ledger::examine(&bytes, &CLAUSES).is_err());
        assert!(ledger::certificate(&CLAUSES[0], 0, Limits::NONE).is_err(), "what is refuted has none");
    }

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
        let found = OwnRun { setting: &SETTING, rule: ("written", &WRITTEN), run };
        assert_eq!((run.walls.len(), run.frames.len()), (1, 2));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("found.jsonl");
        found.store(&path, &Replaceable::default()).expect("room").0.keep().expect("room");
        let read = |path: &Path| fs::read_to_string(path).expect("a file");
        let drawn = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/follow-1-written.jsonl");
        assert_eq!(read(&path), read(&drawn));
        // The numbers of robots in the file are those that the rule knows.
        assert!(read(&path).contains("\"numbered_from\":0") && read(&path).contains(run.words.demand));
    }
}
