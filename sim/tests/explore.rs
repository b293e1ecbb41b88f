//! Runs in random layouts: the repaired chain breaks nothing, every run ends, every step is possible in its layout, and
//! a stored run is read back as the run it was. A failing case shrinks to a drawing.

use std::collections::BTreeSet;
use std::path::Path;
use std::{env, fs};

use crate::common::generated;
use proptest::prelude::*;
use tautline_grids::layout::{self, Layout};
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::run::Frame;
use tautline_sim::explore::chain::{CHAIN, REEL, UNHELD};
use tautline_sim::explore::{
    Catalogue, ClauseId, Limits, Milestone, OnViolation, Report, RuleId, RuleName, Setup, StopReason,
    TeamMove, explore,
};
use tautline_sim::trace::{Trace, Writer};

/// More team moves than any run here has.
const MANY: u32 = 20_000;

fn setup(rule: RuleName, robots: u16, mut layout: Layout) -> Setup {
    let base = Setup::choose_base(&mut layout, None).expect("a free cell");
    Setup::new(&CHAIN, rule, robots, layout, base)
}

fn run(setup: &Setup) -> (Report, Vec<Frame>) {
    let mut frames = Vec::new();
    let report = explore(setup, &mut |made| {
        assert!(made.step < MANY, "the run does not end");
        frames.push(made.frame.clone());
        Ok(())
    });
    (report.expect("a run"), frames)
}

/// Layouts with walls and blocked cells; fewer of both, and smaller ones, as they shrink.
fn layouts() -> impl Strategy<Value = Layout> {
    let size = (1_u64..=11, 1_u64..=11, 0.0..0.4_f64, 0.0..0.2_f64);
    size.prop_flat_map(|(width, height, walls, blocked)| {
        let cells = (width * height) as usize;
        (
            Just((width, height)),
            prop::collection::vec(prop::bool::weighted(walls), 2 * cells),
            prop::collection::vec(prop::bool::weighted(blocked), cells),
            0..cells,
        )
    })
    .prop_map(|((width, height), walls, blocked, base)| {
        let mut layout = Layout::open(width, height).expect("a size");
        let edges: Vec<Edge> = layout.edges().collect();
        edges.into_iter().zip(walls).filter(|&(_, wall)| wall).for_each(|(edge, _)| layout.build_wall(edge));
        let cells: Vec<Cell> = layout.cells().collect();
        for (place, (&cell, blocked)) in cells.iter().zip(blocked).enumerate() {
            if blocked && place != base {
                layout.block(cell);
            }
        }
        layout.place_base(cells[base]).expect("a free cell");
        layout
    })
}

fn setups() -> impl Strategy<Value = Setup> {
    (layouts(), 2_u16..=9, prop::sample::select(RuleName::ALL.to_vec()))
        .prop_map(|(layout, robots, rule)| setup(rule, robots, layout))
}

fn on_violation() -> impl Strategy<Value = OnViolation> {
    let stops = Breach::CHAIN.map(|breach| OnViolation::StopAt(breach.into()));
    prop::sample::select([&[OnViolation::GoOn, OnViolation::Stop][..], &stops].concat())
}

/// Whether a robot can do in the layout what it did.
fn is_possible(setup: &Setup, made: &TeamMove<'_>, robot: usize) -> bool {
    let (from, to) = (made.before[robot], made.frame.cells[robot]);
    match (made.frame.steps[robot], made.frame.blocked[robot]) {
        (Step::Stay, blocked) => to == from && !blocked,
        (Step::Cross(side), true) => to == from && !setup.layout.is_open(Edge::new(from, side)),
        (Step::Cross(side), false) => to == from.beyond(side) && setup.layout.is_open(Edge::new(from, side)),
    }
}

fn stored(setup: &Setup, clause: Option<ClauseId>, path: &Path) -> Report {
    let file = AtomicFile::new(path, &Replaceable::default()).expect("a place");
    let mut writer = Writer::new(file, setup, clause).expect("a free base");
    let report = explore(setup, &mut |made| {
        writer.add(made);
        Ok(())
    })
    .expect("a run");
    writer.end(&report).keep().expect("a file");
    report
}

fn replayed(path: &Path) -> Result<(Report, Vec<Frame>), Diagnostic> {
    let mut frames = Vec::new();
    let replayed = Trace::open(path, Catalogue::OWN).map_err(Halt::Diagnostic).and_then(|trace| {
        trace.replay(&mut |made| {
            frames.push(made.frame.clone());
            Ok(())
        })
    });
    match replayed {
        Ok(report) => Ok((report, frames)),
        Err(Halt::Diagnostic(fault)) => Err(fault),
        Err(Halt::Interrupted) => unreachable!("nobody interrupts"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_repaired_chain_breaks_nothing_and_the_published_one_stays_in_range(setup in setups()) {
        let (report, _) = run(&setup);
        let broken: Vec<ClauseId> = report.violations.iter().map(|violation| violation.clause).collect();
        if setup.rule == RuleId::REPAIRED {
            prop_assert_eq!(broken, Vec::<ClauseId>::new());
        } else {
            prop_assert!(!broken.contains(&Breach::Coverage.into()));
        }
    }

    #[test]
    fn a_reel_breaks_nothing_and_leaves_nothing_out(
        setup in setups(),
        rule in prop::sample::select(vec![REEL, UNHELD]),
    ) {
        let (report, _) = run(&Setup { rule, ..setup });
        prop_assert_eq!(report.violations, vec![]);
    }

    #[test]
    fn a_run_does_what_its_layout_allows_and_counts_what_it_sees(setup in setups()) {
        let mut seen = BTreeSet::from([setup.base]);
        let report = explore(&setup, &mut |made| {
            assert!((1..made.before.len()).all(|robot| is_possible(&setup, made, robot)), "{made:?}");
            assert_eq!(made.frame.cells[0], setup.base);
            seen.extend(&made.frame.cells);
            Ok(())
        });
        let report = report.expect("a run");
        prop_assert_eq!(report.explored as usize, seen.len());
        let charted: BTreeSet<Cell> =
            report.chart.area().cells().filter(|&cell| report.chart.step(cell).is_some()).collect();
        prop_assert_eq!(charted, seen);
        let range = i16::try_from(setup.robots).expect("few robots") - 1;
        let near = |cell: &Cell| (cell.x - setup.base.x).abs() <= range && (cell.y - setup.base.y).abs() <= range;
        let free = setup.layout.cells().filter(|&cell| setup.layout.is_free(cell)).filter(near).count();
        prop_assert_eq!(report.cells as usize, free);
        prop_assert_eq!(report.reached(Milestone::Whole).is_some(), report.explored == report.cells);
        prop_assert!(report.stopped == StopReason::Explored || report.stopped == StopReason::Exhausted);
    }

    #[test]
    fn a_stored_run_reads_back_as_it_was(setup in setups(), violation in on_violation()) {
        let setup = Setup { limits: Limits { violation, ..Limits::default() }, ..setup };
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.jsonl");
        let report = stored(&setup, None, &path);
        let (again, frames) = replayed(&path).expect("the same run");
        prop_assert_eq!(&again, &report);
        prop_assert_eq!(frames, run(&setup).1);
        prop_assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "nothing else is left");
    }

    #[test]
    fn a_stored_run_that_is_cut_is_refused(setup in setups(), cut in any::<prop::sample::Index>()) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.jsonl");
        stored(&setup, None, &path);
        let text = fs::read_to_string(&path).expect("text");
        let cut = cut.index(text.len() - 1);
        fs::write(&path, &text[..text.floor_char_boundary(cut)]).expect("a file");
        prop_assert!(replayed(&path).is_err(), "{} of {} bytes are enough", cut, text.len());
    }

    #[test]
    fn a_stored_run_with_another_digit_is_refused(setup in setups(), which in any::<prop::sample::Index>()) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.jsonl");
        stored(&setup, None, &path);
        let text = fs::read_to_string(&path).expect("text");
        let header = text.find('\n').expect("a header");
        let digits: Vec<usize> = (header..text.len()).filter(|&at| text.as_bytes()[at].is_ascii_digit()).collect();
        let at = digits[which.index(digits.len())];
        let other = if &text[at..=at] == "7" { "3" } else { "7" };
        fs::write(&path, [&text[..at], other, &text[at + 1..]].concat()).expect("a file");
        prop_assert!(replayed(&path).is_err(), "byte {} may be {}", at, other);
    }
}

#[test]
fn open_areas_take_the_optimum_under_both_rules() {
    for rule in RuleName::ALL {
        for robots in 2..=32 {
            let side = 2 * robots - 1;
            let setup = setup(rule, robots, Layout::open(side.into(), side.into()).expect("a size"));
            let report = explore(&setup, &mut |_| Ok(())).expect("a run");
            assert_eq!(report.steps, 9 * (u32::from(robots) - 1) - 1, "{rule}, {robots} robots");
            assert_eq!((report.explored, report.stopped), (report.cells, StopReason::Explored));
            assert_eq!(report.violations, []);
        }
    }
}

#[test]
fn a_reel_needs_the_optimum_in_the_open_and_at_most_so_many_team_moves_in_the_buildings() {
    for (ground, most) in [("open:15x15", 62), ("rooms-a", 260), ("rooms-b", 500)] {
        let reel = Setup { rule: REEL, ..setup(RuleName::Repaired, 8, generated(ground, 0)) };
        let report = explore(&reel, &mut |_| Ok(())).expect("a run");
        assert!(report.steps <= most, "{ground}: {} team moves", report.steps);
        assert_eq!(report.violations, []);
    }
}

#[test]
fn milestones_round_up() {
    assert_eq!(Milestone::ALL.map(|milestone| milestone.of(225)), [113, 169, 225]);
    assert_eq!(Milestone::ALL.map(|milestone| milestone.of(1)), [1, 1, 1]);
}

#[test]
fn a_run_stops_where_it_is_told_to() {
    let open = setup(RuleName::Repaired, 8, generated("open:15x15", 0));
    let limited = |limits| explore(&Setup { limits, ..open.clone() }, &mut |_| Ok(())).expect("a run");
    let until = limited(Limits { until: Some(Milestone::Half), ..Limits::default() });
    assert_eq!((until.stopped, Some(until.steps)), (StopReason::Until, until.reached(Milestone::Half)));
    // Without walls the leader enters a cell in every team move.
    let moves = limited(Limits { max_moves: 20.try_into().ok(), ..Limits::default() });
    assert_eq!((moves.stopped, moves.steps), (StopReason::MaxMoves, 20));
}

#[test]
fn blocked_cells_are_neither_entered_nor_counted() {
    let mut layout = generated("open:3x3", 0);
    layout.block(Cell::new(1, 0));
    let report = explore(&setup(RuleName::Repaired, 2, layout), &mut |_| Ok(())).expect("a run");
    // The team does not know that the blocked cell is none to explore, and tries all its sides.
    assert_eq!((report.explored, report.cells, report.stopped), (8, 8, StopReason::Exhausted));
    assert!(report.reached(Milestone::Whole) < Some(report.steps));
}

#[test]
fn published_maps_are_read_and_explored_if_they_are_there() {
    let Some(folder) = env::var_os("TAUTLINE_MAPS") else {
        println!("TAUTLINE_MAPS names no folder of published maps: nothing to do");
        return;
    };
    let folder = Path::new(&folder);
    let load = |name: &str| layout::load(folder.join(name).to_str().expect("a name"), 0, None);
    let files = |folder: &Path, extension: &str| -> Vec<String> {
        let entries = fs::read_dir(folder).expect("the folder of maps");
        let names = entries.map(|entry| entry.expect("a file").file_name().into_string().expect("a name"));
        names.filter(|name| Path::new(name).extension().is_some_and(|found| found == extension)).collect()
    };
    let maps = files(folder, "map");
    assert!(maps.len() >= 14, "{maps:?}");
    for map in &maps {
        load(map).unwrap_or_else(|fault| panic!("{map}: {fault}"));
    }
    for yaml in files(&folder.join("ros"), "yaml") {
        match (yaml.as_str(), load(&format!("ros/{yaml}"))) {
            ("depot.yaml", Ok(_)) => {}
            ("tb3_map.yaml" | "testmap.yaml", Err(fault)) => {
                assert!(fault.to_string().contains("`image`"), "{fault}");
            }
            (_, result) => panic!("{yaml}: {result:?}"),
        }
    }
    for map in ["room-32-32-4.map", "den312d.map", "Boston_0_512.map", "ros/depot.yaml"] {
        for robots in [8, 32] {
            let setup = setup(RuleName::Repaired, robots, load(map).expect("a map"));
            let report = explore(&setup, &mut |_| Ok(())).expect("a run");
            assert_eq!(report.violations, [], "{map}");
            assert!(2 * report.explored > report.cells, "{map}: {} of {}", report.explored, report.cells);
        }
    }
}
