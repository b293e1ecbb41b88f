//! Robots that go from frontier cell to frontier cell: hunts, their counterexamples as runs, and bad setups.

mod common;

use crate::common::Unwatched;
use tautline_kernel::ground::Cell;
use tautline_sim::explore::frontier::FRONTIER;
use tautline_sim::explore::hunt::{Asked, Hunted, Shown};
use tautline_sim::explore::{Misfit, RuleId, Setup, Stopped, explore};
use tautline_sim::frontier::Options;
use tautline_sim::layout::{Layout, Size};

fn hunted(rule: &'static str, robots: u64, (width, height): (u64, u64), max_losses: u8) -> Hunted {
    let asked = Asked {
        scheme: &FRONTIER,
        rule: RuleId::new(rule),
        robots: Some(robots),
        size: Some(Size::new(width, height).expect("a size")),
        budget: None,
        max_walls: None,
        max_misses: None,
        max_losses: Some(max_losses).filter(|&losses| losses > 0),
        error_cells: None,
        resume: None,
    };
    let hunt = FRONTIER.rule(asked.rule).and_then(|rule| rule.hunt).expect("it is hunted");
    asked.check(hunt).expect("it takes that");
    hunt.hunt(&asked, &mut Unwatched).expect("a hunt")
}

#[test]
fn every_stored_counterexample_breaks_its_clause_when_it_is_run_again() {
    for (rule, robots, losses) in
        [("published", 1, 0), ("published", 2, 0), ("published", 2, 1), ("wanders", 2, 0)]
    {
        let hunted = hunted(rule, robots, (3, 2), losses);
        assert!(hunted.is_complete);
        let stored = hunted.found.iter().filter_map(|quarry| match quarry.shown {
            Shown::Run(clause) | Shown::Story(clause, _) => Some((clause, quarry)),
            Shown::Endless | Shown::Told(_) => None,
        });
        let mut count = 0;
        for (clause, quarry) in stored {
            let report = explore(&quarry.setup, &mut |_| Ok(())).expect("a run");
            let is_broken = report.violations.iter().any(|violation| violation.clause == clause);
            assert!(is_broken, "{rule}, {robots} robots, {clause}: {:?}", report.violations);
            count += 1;
        }
        assert!(count > 0, "{rule}, {robots} robots");
    }
}

#[test]
fn a_repaired_team_breaks_nothing_within_the_bound() {
    for (robots, losses) in [(1, 0), (2, 0), (2, 1), (3, 0)] {
        let hunted = hunted("repaired", robots, (3, 2), losses);
        assert!(hunted.is_complete && hunted.found.is_empty(), "{robots} robots, {losses} lost: {hunted:?}");
    }
}

/// The robot in the way is given no cell, and so never goes.
#[test]
fn the_nearest_cell_that_no_earlier_robot_takes_may_be_waited_for_for_ever() {
    let hunted = hunted("earlier", 2, (3, 1), 0);
    let [quarry] = &hunted.found[..] else { panic!("{:?}", hunted.found) };
    assert_eq!((quarry.clause, quarry.setup.layout.size().cells()), ("FRONTIER-3", 3));
}

fn setup(robots: u16, (width, height): (u64, u64)) -> Setup {
    let mut layout = Layout::open(width, height).expect("a layout");
    let base = layout.default_base().expect("a base");
    layout.place_base(base).expect("a base");
    let starts = FRONTIER.default_starts(RuleId::REPAIRED, &layout, base, robots);
    Setup { starts, ..Setup::new(&FRONTIER, RuleId::REPAIRED, robots, layout, base) }
}

#[test]
fn a_repaired_team_explores_an_open_area_and_knows_it() {
    for robots in [1, 2, 4, 8] {
        let report = explore(&setup(robots, (6, 7)), &mut |_| Ok(())).expect("a run");
        assert_eq!((report.stopped, report.explored), (Stopped::Explored, 42), "{robots} robots");
        assert!(report.violations.is_empty(), "{:?}", report.violations);
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    assert_eq!(setup(5, (2, 2)).check().err(), Some(Misfit::Full { robots: 5, cells: 4 }));
    let with = |options| Setup { options, ..setup(2, (3, 3)) }.check().err();
    let usual = Options::default();
    assert_eq!(with(usual), None);
    assert_eq!(with(Options { threshold: 1.5, ..usual }), Some(Misfit::Threshold));
    assert_eq!(with(Options { threshold: f64::NAN, ..usual }), Some(Misfit::Threshold));
    assert_eq!(with(Options { noise_db: -1.0, ..usual }), Some(Misfit::Noise));
    let cell = Cell::new(0, 0);
    let together = Setup { starts: Some(vec![cell, cell]), ..setup(2, (3, 3)) };
    assert_eq!(together.check().err(), Some(Misfit::Together(cell)));
}
