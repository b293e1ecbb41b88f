//! A team that is in no catalogue: it runs in a building, its run is stored, read back and drawn as that of any team,
//! and what it breaks is shrunk. A stored run that contradicts itself is refused with its place.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use tautline_grids::layout::{self, Layout};
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::svg::Panel;
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::run::Frame;
use tautline_sim::counterexample::minimise::{BrokenClause, Case, Obstacles, minimise, shrink};
use tautline_sim::draw::{story, svg};
use tautline_sim::explore::{
    Catalogue, Clause, ClauseId, End, Limits, Look, OnViolation, Play, Profile, Report, Rule, RuleId, Setup,
    Starts, StopReason, Surroundings, Team, run,
};
use tautline_sim::trace::{self, StoredRun, Writer};

/// The second robot never comes into the cell of the first.
const ALONE: ClauseId = ClauseId::new("PAIR-1");

/// Two robots: the first goes where it has not been, and back where nothing is left; the second goes where the first
/// has been, and does not know that the first may meet a wall.
struct Pair {
    cells: [Cell; 2],
    /// The cells within the rim, which both know.
    size: layout::Size,
    tried: BTreeSet<Cell>,
    /// How the first came to where it is.
    way: Vec<Cell>,
}

impl Pair {
    fn new(layout: &Layout, start: Cell) -> Self {
        Self { cells: [start; 2], size: layout.size(), tried: BTreeSet::from([start]), way: Vec::new() }
    }

    /// Where the first goes next.
    fn next(&self) -> Option<Side> {
        let [first, _] = self.cells;
        let mut sides = Side::ALL.into_iter();
        let is_new = |side: &Side| {
            self.size.contains(first.beyond(*side)) && !self.tried.contains(&first.beyond(*side))
        };
        let back = self.way.last().copied();
        sides.find(is_new).or_else(|| Side::ALL.into_iter().find(|&side| Some(first.beyond(side)) == back))
    }
}

impl Team for Pair {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, world: &mut dyn Surroundings) -> Result<Frame, End> {
        let [first, second] = self.cells;
        let side = self.next().ok_or(End::Exhausted)?;
        let follows = Side::ALL.into_iter().find(|&side| second.beyond(side) == first);
        let is_blocked = !world.is_open(Edge::new(first, side));
        if self.tried.insert(first.beyond(side)) {
            self.way.extend((!is_blocked).then_some(first));
        } else {
            self.way.pop();
        }
        self.cells = [if is_blocked { first } else { first.beyond(side) }, first];
        Ok(Frame {
            kind: Kind::Advance,
            steps: vec![Step::Cross(side), follows.map_or(Step::Stay, Step::Cross)],
            blocked: vec![is_blocked, false],
            cells: self.cells.to_vec(),
        })
    }

    fn broken_in_move(&self, before: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let has_come = frame.cells[0] == frame.cells[1] && before[1] != frame.cells[1];
        if has_come { vec![ALONE] } else { Vec::new() }
    }
}

/// The pair as a row, as those of the catalogue are.
static PAIR: Profile = Profile {
    about: "Two robots, of which the second follows the first",
    rules: &[Rule::new(
        RuleId::new("eager"),
        "The second does not know that the first may meet a wall",
        |setup| Ok(Box::new(Pair::new(&setup.layout, setup.base))),
    )],
    team: "pair",
    robots: 2..=2,
    starts: Starts::Base,
    look: Look::Apart,
    clauses: &[Clause::new("PAIR-1")],
    ..Profile::named("pair")
};

/// Runs the pair in `layout` until it breaks its clause, and stores the run at `path`.
fn store(path: &Path, layout: &Layout, start: Cell, limits: Limits) -> Report {
    let starts = [start; 2];
    let file = AtomicFile::new(path, &Replaceable::default()).expect("a place");
    let clause = (limits.violation == OnViolation::Stop).then_some(ALONE);
    let mut writer = Writer::new(file, &Setup::named("pair", "eager", layout.clone(), &starts), clause)
        .expect("a free cell");
    let report = run(&mut Pair::new(layout, start), layout, limits, &mut |made| {
        writer.add(made);
        Ok(())
    });
    let report = report.expect("a run");
    writer.end(&report).keep().expect("a file");
    report
}

fn loaded(name: &str) -> (Layout, Cell) {
    let layout = layout::load(name, 0, None).expect("a layout");
    let base = layout.default_base().expect("a free cell");
    (layout, base)
}

const STOP: Limits = Limits { until: None, max_moves: None, violation: OnViolation::Stop };

fn foreign(path: &Path) -> Result<trace::ForeignRun, Diagnostic> {
    match trace::open(path, Catalogue::OWN)? {
        StoredRun::Foreign(run) => Ok(run),
        StoredRun::Known(trace) => panic!("{trace:?}"),
    }
}

#[test]
fn a_team_of_ones_own_runs_in_a_building_and_its_run_reads_back_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    let (layout, base) = loaded("rooms-a");
    let report = store(&path, &layout, base, Limits::default());
    assert_eq!((report.stopped, report.explored, report.cells), (StopReason::Exhausted, 197, 225));
    assert!(!report.violations.is_empty());
    let read = foreign(&path).expect("a stored run");
    assert_eq!(read.clause, None);
    assert_eq!(read.play(&mut |_| Ok(())), Ok(report));
}

#[test]
fn a_stored_run_of_a_team_of_ones_own_is_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    let layout: Layout = SMALL.parse().expect("a layout");
    let report = store(&path, &layout, Cell::new(0, 0), STOP);
    let read = foreign(&path).expect("a stored run");
    assert_eq!(read.clause, Some(ALONE));
    assert_snapshot!(story::last_move(&read).expect("a run"), @r"
    Team move 2 breaks PAIR-1.

      Robot 0 at 1,0 tries to go east, meets a wall and stays.
      Robot 1 at 0,0 goes east to 1,0.

    before, with what each tries   after
    +---+---+---+                  +---+---+---+
    |1→  0→ x   |                  | ·  01 x   |
    +---+---+---+                  +---+---+---+
    ");
    let mut panels = 0;
    read.play(&mut |made| {
        assert!(
            Panel::picture("pair", &[svg::team_move(&read, &report.chart, made)]).contains("class=\"robot\"")
        );
        panels += 1;
        Ok(())
    })
    .expect("a run");
    assert_eq!(panels, report.steps);
}

/// Three cells in a row, of which the last cannot be entered.
const SMALL: &str = "\
tautline layout 1
+--+--+--+
|     |  |
+--+--+--+
";

#[test]
fn what_a_team_of_ones_own_breaks_is_shrunk() {
    let (layout, base) = loaded("rooms-b");
    let breaks = |Case { layout, base, .. }: &Case| {
        let mut edges = Vec::new();
        let report = run(&mut Pair::new(layout, *base), layout, STOP, &mut |made| {
            edges.extend(made.frame.bumps());
            Ok(())
        })?;
        let met = Some(Obstacles { area: report.chart.area(), edges });
        Ok((report.stopped == StopReason::Violation).then_some(BrokenClause { steps: report.steps, met }))
    };
    let case = Case { robots: 2, layout, base, starts: Vec::new(), missed: Vec::new() };
    let steps = breaks(&case).expect("a run").expect("it breaks the clause").steps;
    let shrunk = shrink(case.clone(), steps, 2, &mut |case, _| breaks(case)).expect("nobody ends the work");
    assert_snapshot!(shrunk.case.layout, @"
    tautline layout 1
    +--+
    |B |
    +  +
    |  |
    +--+
    |  |
    +--+
    ");
    assert_eq!(breaks(&shrunk.case).expect("a run").map(|broken| broken.steps), Some(shrunk.extent.steps));
    // A row of one's own is minimised as those of the catalogue are.
    let setup = Setup::new(&PAIR, RuleId::new("eager"), case.robots, case.layout, case.base);
    let minimal = minimise(&setup, None, &mut |_| Ok(())).expect("it breaks the clause");
    assert_eq!((minimal.clause, minimal.setup.layout), (ALONE, shrunk.case.layout));
}

#[test]
fn a_stored_run_that_contradicts_itself_is_refused_with_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.jsonl");
    let layout: Layout = SMALL.parse().expect("a layout");
    store(&path, &layout, Cell::new(0, 0), STOP);
    let whole = fs::read_to_string(&path).expect("text");
    assert_snapshot!(whole, @r#"
    {"format":"tautline run","version":1,"scheme":"pair","rule":"eager","robots":2,"seed":0,"base":[0,0],"limits":{"until":null,"max_moves":null,"violation":"go-on"},"clause":"PAIR-1","numbered_from":0,"layout":"tautline layout 1\n+--+--+--+\n|B    |  |\n+--+--+--+\n"}
    {"move":{"step":1,"kind":"advance","tried":"E.","blocked":[],"cells":[[1,0],[0,0]]}}
    {"move":{"step":2,"kind":"advance","tried":"EE","blocked":[0],"cells":[[1,0],[1,0]]}}
    {"end":{"stopped":"violation","steps":2,"explored":2,"cells":3,"violations":[{"clause":"PAIR-1","step":2}]}}
    "#);
    let second = whole.lines().nth(2).expect("a second team move");
    let cases = [
        ("another layout", whole.replacen("|B    |  |", "|B |  |  |", 1)),
        ("no wall", whole.replacen("|B    |  |", "|B       |", 1)),
        ("another base", whole.replacen("\"base\":[0,0]", "\"base\":[1,0]", 1)),
        ("a name that is markup", whole.replacen("\"pair\"", "\"<b>\"", 1)),
        (
            "a clause that is markup",
            whole.replacen("\"clause\":\"PAIR-1\",\"step\"", "\"clause\":\"<b>\",\"step\"", 1),
        ),
        ("no robots", whole.replacen("\"robots\":2", "\"robots\":0", 1)),
        ("a robot more", whole.replacen("\"robots\":2", "\"robots\":3", 1)),
        ("a start outside", whole.replacen("\"base\":[0,0]", "\"base\":[0,0],\"starts\":[[0,0],[0,1]]", 1)),
        ("a start too few", whole.replacen("\"base\":[0,0]", "\"base\":[0,0],\"starts\":[[0,0]]", 1)),
        ("an unknown field", whole.replacen("\"seed\":0", "\"seed\":0,\"mood\":1", 1)),
        ("another number", whole.replacen("\"step\":2", "\"step\":3", 1)),
        ("an unknown letter", whole.replacen("\"EE\"", "\"EX\"", 1)),
        ("a step that was not made", whole.replacen("\"EE\"", "\"E.\"", 1)),
        ("robots that count from 7", whole.replacen("\"numbered_from\":0", "\"numbered_from\":7", 1)),
        ("an empty demand", whole.replacen("\"numbered_from\"", "\"demand\":\"\",\"numbered_from\"", 1)),
        ("a title of two lines", whole.replacen("[0,0]]}", "[0,0]],\"title\":\"a\\nb\"}", 1)),
        ("once again and not again", whole.replacen("[0,0]]}", "[0,0]],\"again\":true}", 1)),
        ("a jump", whole.replacen("[[1,0],[1,0]]", "[[1,0],[2,0]]", 1)),
        ("a cell too few", whole.replacen("[[1,0],[1,0]]", "[[1,0]]", 1)),
        ("through a wall", whole.replacen("\"blocked\":[0]", "\"blocked\":[]", 1)),
        ("stopped by nothing", whole.replacen("\"blocked\":[0]", "\"blocked\":[0,1]", 1)),
        ("a third robot", whole.replacen("\"blocked\":[0]", "\"blocked\":[2]", 1)),
        ("another count of moves", whole.replacen("\"steps\":2", "\"steps\":1", 1)),
        ("another count of cells", whole.replacen("\"explored\":2", "\"explored\":3", 1)),
        ("more than there is", whole.replacen("\"cells\":3,", "\"cells\":4,", 1)),
        ("a clause in no team move", whole.replacen("\"step\":2}]", "\"step\":9}]", 1)),
        ("another clause", whole.replacen("\"clause\":\"PAIR-1\",\"n", "\"clause\":\"PAIR-2\",\"n", 1)),
        ("a team move left out", whole.replacen(&format!("{second}\n"), "", 1)),
        ("no end", whole.split_inclusive('\n').take(3).collect()),
        ("a line after the end", whole.clone() + "{}\n"),
    ];
    let said = cases.map(|(what, text)| {
        assert_ne!(text, whole, "{what}");
        fs::write(&path, text).expect("a file");
        let fault = foreign(&path).expect_err(what).to_string();
        format!("{what}\n  {}\n", fault.replace(&path.display().to_string(), "run.jsonl"))
    });
    assert_snapshot!("wrong_runs_of_a_pair", said.concat());
}
