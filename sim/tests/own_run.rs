//! Stored runs of a rule of one's own in which robots act one by one, messages are lost and robots die: the file says
//! what no frame can show, and what is drawn of it says so too.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use tautline_io::atomic_file::Replaceable;
use tautline_io::diagnostic::Halt;
use tautline_kernel::ground::{Cell, Side};
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::decide::Depiction;
use tautline_proofs::ledger;
use tautline_proofs::team::{Act, Demand, Ground, Keeps, Moves, Places, Rule, Senses, Setting, View};
use tautline_sim::counterexample::own::OwnRun;
use tautline_sim::draw::{page, story};
use tautline_sim::explore::{Catalogue, Play};
use tautline_sim::trace::{self, StoredRun};

/// Robots go round four cells. Each goes on where it sees the next cell free, or has heard that the robot there has
/// left it.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Patrol {
    listens: bool,
}

/// The side on which the way round four cells goes on.
const fn next(cell: Cell) -> Side {
    match (cell.x, cell.y) {
        (0, 0) => Side::East,
        (_, 0) => Side::South,
        (0, _) => Side::North,
        _ => Side::West,
    }
}

impl Rule for Patrol {
    type Memory = bool;
    type Message = Cell;

    fn start(&self, robot: usize, starts: &[Cell]) -> bool {
        !starts.contains(&starts[robot].beyond(next(starts[robot])))
    }

    fn act(&self, view: &mut View<'_, Self>, is_free: &mut bool) -> Act {
        let side = next(view.cell());
        let ahead = view.cell().beyond(side);
        let is_seen =
            |cell, view: &View<'_, Self>| (0..view.robots()).any(|other| view.sees(other) == Some(cell));
        *is_free = if self.listens {
            *is_free || view.heard().iter().any(|&(_, left)| left == ahead)
        } else {
            !is_seen(ahead, view)
        };
        if !*is_free {
            return Act::Wait;
        }
        view.tell(view.cell());
        *is_free = !is_seen(ahead.beyond(next(ahead)), view);
        Act::Go(side)
    }
}

const DEMANDS: &[Demand<'static, Patrol>] = &[
    Demand::always("PATROL-1", "no two robots are in one cell", &|moved| moved.after.cells_differ()),
    Demand::eventually("PATROL-2", "robot 1 comes to the south east", &|scene| {
        scene.cell(1) == Cell::new(1, 1)
    }),
];

/// Two robots in four cells, of which the second waits for the first.
const fn setting(moves: Moves, losses: u32, deaths: u32) -> Setting<'static, Patrol> {
    Setting {
        senses: Senses::TEAM,
        moves,
        losses,
        deaths,
        demands: DEMANDS,
        ..Setting::new(
            "patrol",
            Ground::open(2, 2),
            2,
            Places::At(|_| vec![Cell::new(1, 0), Cell::new(0, 0)]),
        )
    }
}

const LISTENS: NamedRule<Patrol> = NamedRule::new("listens", Patrol { listens: true });
const LOOKS: NamedRule<Patrol> = NamedRule::new("looks", Patrol { listens: false });

static LATE: Setting<'_, Patrol> = setting(Moves::LookThenMove, 0, 0);
static MORTAL: Setting<'_, Patrol> = setting(Moves::OneAtATime, 0, 1);
static LOSSY: Setting<'_, Patrol> = setting(Moves::Together, 1, 0);

static CLAUSES: [Clause; 2] = [
    Clause {
        id: "PATROL-1",
        sentence: "No two robots MUST be in one cell.",
        checks: &[&Check::refuted(LISTENS, &Keeps(&LATE, 0))],
    },
    Clause {
        id: "PATROL-2",
        sentence: "Robot 1 MUST come to the south east.",
        checks: &[&Check::refuted(LOOKS, &Keeps(&MORTAL, 1)), &Check::refuted(LISTENS, &Keeps(&LOSSY, 1))],
    },
];

/// The story of the run that refutes the check at this place, stored at `path` and read again.
fn told(path: &Path, place: usize) -> String {
    let rows = ledger::decide_all(&ledger::register(&[&CLAUSES]).expect("ids of their own"));
    let row = &rows.expect("it can be searched")[place];
    let found = row.decision.counterexample.as_ref().map(|evidence| &evidence.seen);
    let Some(Depiction::Robots(run)) = found else { panic!("{found:?}") };
    let (setting, rule) = [(&LATE, &LISTENS), (&MORTAL, &LOOKS), (&LOSSY, &LISTENS)][place];
    let stored = OwnRun { setting, rule: (rule.name, &rule.rule), run }.store(path, &Replaceable::default());
    stored.expect("room").0.keep().expect("room");
    let StoredRun::Foreign(read) = trace::open(path, Catalogue::OWN).expect("a stored run") else {
        panic!("the scheme is in no catalogue")
    };
    let report = read.play(&mut |_| Ok(())).expect("a run");
    let mut shown = String::new();
    page::write(&mut shown, &read, &report, &(1..=report.steps)).expect("a run");
    assert!(shown.contains(run.words.demand) && shown.contains("\"numbered_from\":0"));
    assert!(shown.contains(r#""what":"cells visited","visits":true}"#), "no robot is to explore");
    let mut titles = run.words.titles.iter().filter(|title| !title.is_empty());
    assert!(titles.all(|title| shown.contains(&format!("\"title\":\"{title}\""))));
    let moves = fs::read_to_string(path).expect("a file");
    let told = story::last_move(&read).expect("a run");
    format!("{}\n{told}", moves.lines().skip(1).collect::<Vec<_>>().join("\n"))
}

#[test]
fn a_run_is_not_stored_by_names_that_no_file_can_have() {
    let row = &ledger::decide_all(&[&CLAUSES[0]]).expect("it can be searched")[0];
    let found = row.decision.counterexample.as_ref().map(|evidence| &evidence.seen);
    let Some(Depiction::Robots(run)) = found else { panic!("{found:?}") };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    let bridge = Setting { scheme: "my patrol", ..LATE };
    for (setting, rule, wrong) in [(&LATE, "tells once", "tells once"), (&bridge, "listens", "my patrol")] {
        let refused =
            OwnRun { setting, rule: (rule, &LISTENS.rule), run }.store(&path, &Replaceable::default());
        let Err(Halt::Diagnostic(fault)) = refused else { panic!("{wrong} is stored") };
        assert!(fault.what().starts_with(&format!("{wrong:?} is no name")), "{}", fault.what());
    }
    assert!(!path.exists());
}

#[test]
fn a_stored_run_says_who_looks_and_who_moves() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    assert_snapshot!(told(&path, 0), @r#"
    {"move":{"step":1,"kind":"advance","tried":"..","blocked":[],"cells":[[1,0],[0,0]],"title":"robot 0 looks"}}
    {"move":{"step":2,"kind":"advance","tried":"..","blocked":[],"cells":[[1,0],[0,0]],"title":"robot 1 looks"}}
    {"move":{"step":3,"kind":"advance","tried":".E","blocked":[],"cells":[[1,0],[1,0]],"title":"robot 1 moves"}}
    {"end":{"stopped":"violation","steps":3,"explored":2,"cells":0,"violations":[{"clause":"PATROL-1","step":3}]}}
    Team move 3 breaks PATROL-1; it demands: no two robots are in one cell

      Robot 1 moves.
      Robot 0 at 1,0 stays.
      Robot 1 at 0,0 goes east to 1,0.

    before, with what each tries   after
    +---+---+                      +--+
    |1→  0· |                      |·*|
    +   +   +                      |  |
    |       |                      +--+
    +---+---+
    "#);
}

#[test]
fn a_stored_run_says_who_dies_and_what_comes_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    assert_snapshot!(told(&path, 1), @r#"
    {"move":{"step":1,"kind":"advance","tried":"..","blocked":[],"cells":[[1,0],[0,0]],"title":"robot 0 dies"}}
    {"move":{"step":2,"kind":"advance","tried":"..","blocked":[],"cells":[[1,0],[0,0]],"title":"robot 1 acts","again":true}}
    {"end":{"stopped":"endless","steps":2,"explored":2,"cells":0,"violations":[{"clause":"PATROL-2","step":2}]}}
    Team move 2 comes again and again. Such a run breaks PATROL-2; it demands: robot 1 comes to the south east

    +---+---+
    | 1   0 |
    +   +   +
    |       |
    +---+---+
    "#);
}

#[test]
fn a_stored_run_says_which_message_is_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    assert_snapshot!(told(&path, 2), @r#"
    {"move":{"step":1,"kind":"advance","tried":"S.","blocked":[],"cells":[[1,1],[0,0]],"title":"the message of robot 0 to robot 1 is lost"}}
    {"move":{"step":2,"kind":"advance","tried":"W.","blocked":[],"cells":[[0,1],[0,0]]}}
    {"move":{"step":3,"kind":"advance","tried":"..","blocked":[],"cells":[[0,1],[0,0]]}}
    {"move":{"step":4,"kind":"advance","tried":"..","blocked":[],"cells":[[0,1],[0,0]],"again":true}}
    {"end":{"stopped":"endless","steps":4,"explored":4,"cells":0,"violations":[{"clause":"PATROL-2","step":4}]}}
    Team move 4 comes again and again. Such a run breaks PATROL-2; it demands: robot 1 comes to the south east

    +---+---+
    | 1   · |
    +   +   +
    | 0   · |
    +---+---+
    "#);
}

#[test]
fn a_stored_run_of_before_titles_is_still_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    fs::write(&path, OLD).expect("a file");
    let StoredRun::Foreign(read) = trace::open(&path, Catalogue::OWN).expect("a stored run") else {
        panic!("the scheme is in no catalogue")
    };
    assert_snapshot!(story::last_move(&read).expect("a run"), @r"
    Team move 1 breaks OLD-1.

      Robot 0 at 0,0 tries to go east, meets a wall and stays.

    before, with what each tries   after
    +---+---+                      +---+---+
    |0→ x   |                      | 0 x   |
    +---+---+                      +---+---+
    ");
}

/// The file of a robot that meets a wall, as it was before robots counted from 0.
const OLD: &str = concat!(
    r#"{"format":"tautline run","version":1,"scheme":"old","rule":"old","robots":1,"seed":0,"base":[0,0],"#,
    r#""limits":{"until":null,"max_moves":null,"violation":{"stop-at":"OLD-1"}},"clause":"OLD-1","#,
    r#""layout":"tautline layout 1\n+--+--+\n|B |  |\n+--+--+\n"}"#,
    "\n",
    r#"{"move":{"step":1,"kind":"advance","tried":"E","blocked":[1],"cells":[[0,0]]}}"#,
    "\n",
    r#"{"end":{"stopped":"violation","steps":1,"explored":1,"cells":2,"violations":[{"clause":"OLD-1","step":1}]}}"#,
    "\n",
);
