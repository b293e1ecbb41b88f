//! Minimal runs: without any one of its robots, columns, rows, blocked cells and walls, each taken out by hand here, a
//! run breaks its clause no more.

use std::collections::BTreeSet;
use std::env;
use std::num::NonZeroU32;
use std::path::Path;

use crate::common::generated;
use tautline_grids::layout::{self, Layout};
use tautline_io::atomic_file::Replaceable;
use tautline_io::diagnostic::Halt;
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::judge::chain::judge;
use tautline_sim::counterexample::minimise::{Extent, Failure, Minimal, Refusal, minimise};
use tautline_sim::explore::bricks::BRICKS;
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::judge_input::judge_input;
use tautline_sim::explore::kit::KIT;
use tautline_sim::explore::{
    Catalogue, ClauseId, ExplorationRequest, Limits, OnViolation, RuleId, RuleName, Setup, StopReason,
    explore,
};
use tautline_sim::trace::{Trace, path_in, store};

/// Column and row.
type Place = (i16, i16);

/// A run written down in another way than the library's.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Case {
    robots: u16,
    columns: i16,
    rows: i16,
    base: Place,
    blocked: BTreeSet<Place>,
    /// Pairs of neighbours, the western or northern first.
    walls: BTreeSet<(Place, Place)>,
}

impl Case {
    fn of(setup: &Setup) -> Self {
        let layout = &setup.layout;
        let place = |cell: Cell| (cell.x, cell.y);
        Self {
            robots: setup.robots,
            columns: layout.width(),
            rows: layout.height(),
            base: place(setup.base),
            blocked: layout.cells().filter(|&cell| !layout.is_free(cell)).map(place).collect(),
            walls: layout
                .walls()
                .map(|wall| (place(wall.cell()), place(wall.cell().beyond(wall.side()))))
                .collect(),
        }
    }

    fn setup(&self, rule: RuleId) -> Setup {
        let mut layout = Layout::open(self.columns as u64, self.rows as u64).expect("a size");
        self.blocked.iter().for_each(|&(x, y)| layout.block(Cell::new(x, y)));
        for &((x, y), (east, _)) in &self.walls {
            layout.build_wall(Edge::new(Cell::new(x, y), if east > x { Side::East } else { Side::South }));
        }
        let base = Cell::new(self.base.0, self.base.1);
        layout.place_base(base).expect("a free cell");
        Setup::new(&CHAIN, rule, self.robots, layout, base)
    }

    /// Columns for rows.
    fn turned(&self) -> Self {
        let turned = |(x, y): Place| (y, x);
        Self {
            robots: self.robots,
            columns: self.rows,
            rows: self.columns,
            base: turned(self.base),
            blocked: self.blocked.iter().copied().map(turned).collect(),
            walls: self.walls.iter().map(|&(one, other)| (turned(one), turned(other))).collect(),
        }
    }

    /// Without `column`; one for each place that the base can have.
    fn without_column(&self, column: i16) -> Vec<Self> {
        let old = |(x, y): Place| (if x < column { x } else { x + 1 }, y);
        let places = || (0..self.rows).flat_map(|y| (0..self.columns - 1).map(move |x| (x, y)));
        let blocked: BTreeSet<Place> = places().filter(|&place| self.blocked.contains(&old(place))).collect();
        let has_wall = |one: Place, other: Place| {
            let between = ((one.0 + 1)..other.0).map(|x| (x, one.1));
            let path: Vec<Place> = [one].into_iter().chain(between).chain([other]).collect();
            path.windows(2).any(|pair| self.walls.contains(&(pair[0], pair[1])))
        };
        let walls = places()
            .flat_map(|(x, y)| [((x, y), (x + 1, y)), ((x, y), (x, y + 1))])
            .filter(|&(_, (x, y))| x < self.columns - 1 && y < self.rows)
            .filter(|&(one, other)| has_wall(old(one), old(other)))
            .collect::<BTreeSet<_>>();
        let (x, y) = self.base;
        let bases = if x == column { vec![x, x - 1] } else { vec![x - i16::from(x > column)] };
        bases
            .into_iter()
            .filter(|&x| 0 <= x && x < self.columns - 1 && !blocked.contains(&(x, y)))
            .map(|x| Self {
                columns: self.columns - 1,
                base: (x, y),
                blocked: blocked.clone(),
                walls: walls.clone(),
                ..self.clone()
            })
            .collect()
    }

    /// Everything that this is without one robot, column, row, blocked cell or wall, and what went.
    fn smaller(&self) -> Vec<(String, Self)> {
        let mut smaller = Vec::new();
        if self.robots > 2 {
            smaller.push(("a robot".to_owned(), Self { robots: self.robots - 1, ..self.clone() }));
        }
        for column in 0..self.columns {
            let what = format!("column {column}");
            smaller.extend(self.without_column(column).into_iter().map(|case| (what.clone(), case)));
        }
        for row in 0..self.rows {
            let turned = self.turned().without_column(row);
            smaller.extend(turned.iter().map(|case| (format!("row {row}"), case.turned())));
        }
        for cell in &self.blocked {
            let blocked = self.blocked.iter().copied().filter(|other| other != cell).collect();
            smaller.push((format!("blocked {cell:?}"), Self { blocked, ..self.clone() }));
        }
        for wall in &self.walls {
            let walls = self.walls.iter().copied().filter(|other| other != wall).collect();
            smaller.push((format!("wall {wall:?}"), Self { walls, ..self.clone() }));
        }
        smaller
    }

    /// Whether its run breaks `clause`, whatever else it breaks before.
    fn breaks(&self, rule: RuleId, clause: ClauseId) -> bool {
        let run = explore(&self.setup(rule), &mut |made| {
            if made.broken.contains(&clause) { Err(Halt::Interrupted) } else { Ok(()) }
        });
        run.map_or(true, |report| report.violations.iter().any(|violation| violation.clause == clause))
    }
}

fn setup(robots: u16, mut layout: Layout) -> Setup {
    let base = Setup::choose_base(&mut layout, None).expect("a free cell");
    Setup::new(&CHAIN, RuleName::Published, robots, layout, base)
}

fn minimal(setup: &Setup, asked: Option<Breach>) -> Option<Minimal> {
    match minimise(setup, asked.map(ClauseId::from), &mut |_| Ok(())) {
        Ok(minimal) => Some(minimal),
        Err(Failure::Refused(_)) => None,
        Err(Failure::Halted(halt)) => panic!("{halt:?}"),
    }
}

/// Checks that `found` is what it promises to be.
fn check(found: &Minimal) {
    let Minimal { setup, clause, before, after, runs: _ } = found;
    let mut frames = Vec::new();
    let report = explore(setup, &mut |made| {
        frames.push(made.frame.clone());
        Ok(())
    });
    let report = report.expect("a run");
    let stopped = if *clause == ClauseId::from(Breach::Completeness) {
        StopReason::Exhausted
    } else {
        StopReason::Violation
    };
    assert_eq!((report.stopped, report.steps), (stopped, after.steps));
    assert_eq!(judge(&judge_input(setup, clause.as_str(), &frames)), Ok(()), "{setup:?}");
    let case = Case::of(setup);
    assert_eq!((case.robots, case.columns, case.rows), (after.robots, after.columns, after.rows));
    assert_eq!((case.blocked.len(), case.walls.len()), (after.blocked, after.walls));
    let shrinks = |part: fn(&Extent) -> usize| part(after) <= part(before);
    assert!(shrinks(|extent| extent.robots.into()) && shrinks(|extent| extent.walls), "{found:?}");
    assert!(shrinks(|extent| extent.columns as usize) && shrinks(|extent| extent.rows as usize), "{found:?}");
    assert!(shrinks(|extent| extent.blocked), "{found:?}");
    assert!(case.breaks(setup.rule, *clause), "{setup:?}");
    for (what, smaller) in case.smaller() {
        assert!(!smaller.breaks(setup.rule, *clause), "{what} can go: {setup:?}");
    }
}

#[test]
fn nothing_of_a_minimal_run_can_go() {
    let mut found = 0;
    for robots in 4..=8 {
        let side = 2 * robots - 1;
        for density in ["0.1", "0.2", "0.3"] {
            for seed in 0..40 {
                let layout = generated(&format!("walls:{side}x{side}:{density}"), seed);
                if let Some(minimal) = minimal(&setup(robots, layout), None) {
                    check(&minimal);
                    found += 1;
                }
            }
        }
    }
    println!("{found} runs");
    assert!(found > 100, "{found}");
}

#[test]
fn nothing_of_a_minimal_run_among_blocked_cells_and_walls_can_go() {
    let mut found = 0;
    for seed in 0..60 {
        let mut layout = generated("cells:16x12:0.1", seed);
        let walls = generated("walls:16x12:0.1", seed);
        walls.walls().for_each(|wall| layout.build_wall(wall));
        if let Some(minimal) = minimal(&setup(7, layout), None) {
            check(&minimal);
            found += 1;
        }
    }
    println!("{found} runs");
    assert!(found > 20, "{found}");
}

#[test]
fn minimising_is_the_same_every_time_and_leaves_a_minimal_run_as_it_is() {
    let setup = setup(8, generated("walls:15x15:0.15", 9));
    let first = minimal(&setup, None).expect("it breaks CHAIN-1");
    let second = minimal(&setup, None).expect("it breaks CHAIN-1");
    assert_eq!((Case::of(&first.setup), first.runs), (Case::of(&second.setup), second.runs));
    let again = minimal(&first.setup, None).expect("it breaks CHAIN-1");
    assert_eq!(Case::of(&again.setup), Case::of(&first.setup));
    assert_eq!((again.before, again.after), (first.after, first.after));
}

#[test]
fn the_clause_asked_for_stays_broken_whatever_breaks_before() {
    let setup = setup(8, generated("walls:15x15:0.2", 80));
    let first = minimal(&setup, None).expect("it breaks CHAIN-1");
    assert_eq!(first.clause, Breach::Contact.into());
    check(&first);
    let crowded = minimal(&setup, Some(Breach::Crowding)).expect("it breaks CHAIN-2 later");
    assert_eq!(crowded.clause, Breach::Crowding.into());
    assert!(crowded.before.steps > first.before.steps);
    check(&crowded);
}

#[test]
fn a_minimal_run_that_breaks_another_clause_before_replays_to_its_own() {
    let setup = setup(10, generated("walls:19x19:0.3", 1917));
    let minimal = minimal(&setup, Some(Breach::Crowding)).expect("it breaks CHAIN-2");
    check(&minimal);
    let folder = tempfile::tempdir().expect("a folder");
    let path = path_in(folder.path(), &minimal.setup, minimal.clause);
    let stored = store(&path, &minimal.setup, minimal.clause, &Replaceable::default());
    let (file, report) = stored.expect("a run");
    file.keep().expect("a file");
    assert_eq!(path.file_name(), Some("chain-2-published-n10.jsonl".as_ref()));
    let broken: Vec<ClauseId> = report.violations.iter().map(|violation| violation.clause).collect();
    assert_eq!(broken, [Breach::Contact, Breach::Crowding].map(ClauseId::from));
    let trace = Trace::open(&path, Catalogue::OWN).expect("a stored run");
    assert_eq!(trace.clause, Some(Breach::Crowding.into()));
    assert_eq!(trace.replay(&mut |_| Ok(())), Ok(report));
}

#[test]
fn what_a_run_never_met_goes_at_once_and_its_moves_stay() {
    let layout = generated("walls:300x200:0.1", 3);
    let mut walls = BTreeSet::new();
    let mut first_smaller = None;
    let setup = setup(12, layout);
    let minimal = minimise(&setup, None, &mut |progress| {
        // The second run is what the first one has met, by itself.
        if progress.runs == 3 {
            first_smaller.get_or_insert(progress.smallest);
        }
        Ok(())
    });
    let minimal = minimal.expect("it breaks CHAIN-1");
    let limits = minimal.setup.limits;
    let run = explore(&Setup { limits, ..setup }, &mut |made| {
        walls.extend(made.frame.bumps().map(|edge| format!("{edge:?}")));
        Ok(())
    });
    let met = Extent { columns: 23, rows: 23, walls: walls.len(), ..minimal.before };
    assert_eq!((first_smaller, run.map(|report| report.steps)), (Some(met), Ok(minimal.before.steps)));
    check(&minimal);
}

#[test]
fn a_run_is_taken_to_its_end_and_no_further() {
    let crowded = setup(8, generated("walls:15x15:0.2", 80));
    let ended = |limits| {
        minimise(&Setup { limits, ..crowded.clone() }, Some(Breach::Crowding.into()), &mut |_| Ok(()))
    };
    let refused = |result: Result<Minimal, Failure>| match result {
        Err(Failure::Refused(refused)) => refused,
        other => panic!("{other:?}"),
    };
    let stopped = Limits { violation: OnViolation::Stop, ..Limits::default() };
    assert_eq!(
        refused(ended(stopped)),
        Refusal::Otherwise { asked: Breach::Crowding.into(), broken: vec![Breach::Contact.into()] }
    );
    let short = Limits { max_moves: NonZeroU32::new(1), ..Limits::default() };
    assert_eq!(refused(ended(short)), Refusal::Unbroken);
}

/// Of KIT a layout of one node is no layout, and its robots see blocked cells before they could meet them: without
/// these the run may be another one.
#[test]
fn a_minimal_run_of_robots_that_see_blocked_cells_breaks_its_clause() {
    let mut minimised = 0;
    for (seed, robots) in (0..12).flat_map(|seed| [2, 3, 4].map(|robots| (seed, robots))) {
        let layout = generated("cells:5x5:0.3", seed);
        let asked = ExplorationRequest {
            robots: Some(robots),
            seed,
            ..ExplorationRequest::new(&KIT, RuleName::Published)
        };
        let setup = asked.setup(layout).expect("a setup");
        if explore(&setup, &mut |_| Ok(())).expect("a run").violations.is_empty() {
            continue;
        }
        let found = minimise(&setup, None, &mut |_| Ok(())).expect("a run that breaks a clause");
        let report = explore(&found.setup, &mut |_| Ok(())).expect("the minimal run");
        let last = report.violations.last().map(|broken| (broken.clause, broken.step));
        assert_eq!(last, Some((found.clause, found.after.steps)), "seed {seed}, {robots} robots");
        minimised += 1;
    }
    assert!(minimised > 12, "{minimised}");
}

#[test]
fn who_watches_can_end_the_work() {
    let setup = setup(8, generated("walls:15x15:0.15", 9));
    let mut last = 0;
    let ended = minimise(&setup, None, &mut |progress| {
        last = progress.runs;
        if progress.runs < 20 { Ok(()) } else { Err(Halt::Interrupted) }
    });
    assert_eq!((ended.err(), last), (Some(Failure::Halted(Halt::Interrupted)), 20));
}

#[test]
fn runs_on_published_maps_shrink_if_they_are_there() {
    let Some(folder) = env::var_os("TAUTLINE_MAPS") else {
        println!("TAUTLINE_MAPS names no folder of published maps: nothing to do");
        return;
    };
    for (map, robots) in [
        ("room-32-32-4.map", 16),
        ("random512-10-0.map", 16),
        ("den312d.map", 24),
        ("warehouse-10-20-10-2-1.map", 24),
    ] {
        let path = Path::new(&folder).join(map);
        let layout = layout::load(path.to_str().expect("a name"), 0, None).expect("a map");
        let minimal = minimal(&setup(robots, layout), None).expect("it breaks CHAIN-1");
        println!("{map}: {:?} to {:?}", minimal.before, minimal.after);
        check(&minimal);
    }
}

/// Whether a run of agents breaks a clause.
fn is_broken(setup: &Setup, clause: ClauseId) -> bool {
    let report = explore(setup, &mut |_| Ok(())).expect("a run");
    report.violations.iter().any(|broken| broken.clause == clause)
}

#[test]
fn no_sensor_that_chance_has_missed_can_go_from_a_minimal_run() {
    let (mut found, mut missed) = (0, 0);
    for seed in 0..40 {
        let mut layout = generated("cells:6x5:0.2", seed);
        let base = Setup::choose_base(&mut layout, None).expect("a base");
        let miss = "0.2".parse().expect("a probability");
        let limits = Limits { max_moves: NonZeroU32::new(400), ..Limits::stopping_at(None) };
        let setup = Setup { miss, seed, limits, ..Setup::new(&BRICKS, RuleId::PUBLISHED, 2, layout, base) };
        let Some(minimal) = minimal(&setup, None) else { continue };
        let Minimal { setup, clause, before, after, .. } = minimal;
        assert!(setup.miss.is_never() && is_broken(&setup, clause), "{setup:?}");
        assert_eq!(after.missed, setup.missed.len(), "{setup:?}");
        for left_out in 0..setup.missed.len() {
            let mut fewer = setup.clone();
            fewer.missed.remove(left_out);
            assert!(!is_broken(&fewer, clause), "{left_out} can go: {setup:?}");
        }
        let again = minimise(&setup, Some(clause), &mut |_| Ok(())).expect("it is broken");
        assert_eq!((again.setup.missed, again.after), (setup.missed, after));
        found += 1;
        missed += before.missed.saturating_sub(after.missed);
    }
    assert!(found > 10 && missed > found, "{found} runs, {missed} misses have gone");
}
