//! Robots that keep in touch, in random layouts: the repaired team breaks nothing, drives every path and knows it; the
//! published one does not keep its promises; and teams that cannot start say why.

use std::fs;
use std::num::NonZeroU32;
use std::path::Path;

use crate::common::{NoWatcher, generated, run_again};
use tautline_grids::layout::{Layout, Size};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;
use tautline_sim::counterexample::{minimise::minimise, refutation};
use tautline_sim::explore::hunt::{Finding, HuntBounds, HuntReport, HuntRequest, RunSize};
use tautline_sim::explore::kit::{AHEAD, APART, CONNECTED, CONTACT, ENDS, KIT};
use tautline_sim::explore::{Catalogue, Report, RuleId, RuleName, Setup, StopReason, explore};
use tautline_sim::kit::{self, Drive, Pace, REACH_MILLIMETRES};
use tautline_sim::options::Options;
use tautline_sim::trace::Trace;

fn setup(rule: impl Into<RuleId>, robots: u16, layout: Layout, seed: u64) -> Setup {
    let base = layout.default_base().expect("a free cell");
    let rule = rule.into();
    let starts = KIT.default_starts(rule, &layout, base, robots);
    Setup { seed, starts, ..Setup::new(&KIT, rule, robots, layout, base) }
}

fn run(setup: &Setup) -> Report {
    explore(setup, &mut |_| Ok(())).expect("a run")
}

/// Every drive of a team with these speeds, and the farthest that its network was stretched, squared.
fn drives(rule: Rule, layout: &Layout, starts: &[Cell], spread: u32, seed: u64) -> (Vec<Drive>, i64, bool) {
    let speed = NonZeroU32::new(300).expect("not 0");
    let mut course = kit::course(rule, layout, starts, Pace { speed, spread }, seed).expect("a team");
    let mut drives = Vec::new();
    while drives.len() < 2000
        && let Some(drive) = course.drive()
    {
        drives.push(drive);
    }
    (drives, course.apart(), course.is_over())
}

/// Repaired teams of so many in random layouts, each with its seed. Where there are not so many cells within reach,
/// there is none.
fn repaired(robots: u16) -> impl Iterator<Item = (u64, Report)> {
    (0..60).filter_map(move |seed| {
        let layout = generated(["walls:5x4:0.15", "walls:7x7:0.3", "open:6x5"][seed as usize % 3], seed);
        let setup = setup(RuleName::Repaired, robots, layout, seed);
        (usize::from(robots) == setup.starts().len()).then(|| (seed, run(&setup)))
    })
}

#[test]
fn one_robot_and_two_drive_every_path_and_break_nothing() {
    for robots in [1, 2] {
        for (seed, report) in repaired(robots) {
            assert_eq!(report.violations, [], "{robots} robots, seed {seed}");
            assert_eq!(report.explored, report.cells, "{robots} robots, seed {seed}");
        }
    }
}

/// That they drive every path is not promised.
#[test]
fn three_robots_and_more_stay_connected_and_apart() {
    for robots in 3..=8 {
        let mut whole = 0;
        for (seed, report) in repaired(robots) {
            let is_kept = |clause| report.violations.iter().all(|broken| broken.clause != clause);
            assert!(is_kept(CONNECTED) && is_kept(APART), "{robots} robots, seed {seed}");
            whole += u32::from(report.stopped == StopReason::Explored);
        }
        assert!(whole > 30, "{robots} robots: {whole} runs drive everything");
    }
}

#[test]
fn repaired_teams_keep_in_touch_at_any_speeds() {
    for seed in 0..60 {
        let layout = generated("walls:6x6:0.2", seed);
        let starts = kit::starts(&layout, layout.default_base().expect("a free cell"), 2);
        let (drives, apart, is_over) = drives(Rule::REPAIRED, &layout, &starts, 900, seed);
        assert!(is_over && apart <= REACH_MILLIMETRES.pow(2), "seed {seed}: {apart}");
        let due = kit::paths(&layout, starts[0]).len();
        let driven = drives.iter().filter(|drive| drive.is_new).count();
        assert!(driven == due || due == 1, "seed {seed}: {driven} of {due}");
    }
}

#[test]
fn published_teams_lose_contact_and_drive_into_each_other() {
    let broken = |clause| {
        let breaks = |seed: &u64| {
            let layout = generated("walls:7x4:0.1", *seed);
            run(&setup(RuleName::Published, 2, layout, *seed))
                .violations
                .iter()
                .any(|broken| broken.clause == clause)
        };
        (0..20).filter(breaks).count()
    };
    assert!(broken(CONTACT) > 0 && broken(APART) > 0);
    // Not at any speed, but at those that they have.
    let stretched = (0..200).filter(|&seed| {
        let layout = generated("walls:9x3:0.3", seed);
        let start = layout.default_base().expect("a free cell");
        drives(Rule::PUBLISHED, &layout, &[start; 2], 500, seed).1 > REACH_MILLIMETRES.pow(2)
    });
    assert!(stretched.count() > 0);
}

#[test]
fn drives_take_their_time_and_follow_each_other() {
    let layout = generated("open:4x4", 0);
    let starts = [Cell::new(0, 0), Cell::new(1, 0)];
    let (steady, ..) = drives(Rule::REPAIRED, &layout, &starts, 0, 1);
    assert!(steady.iter().all(|drive| drive.time[1] - drive.time[0] == 10_000));
    let (spread, ..) = drives(Rule::REPAIRED, &layout, &starts, 100, 1);
    let took = |drive: &Drive| drive.time[1] - drive.time[0];
    // 3 m at 0.33 m/s and at 0.27 m/s.
    assert!(spread.iter().all(|drive| (9_090..=11_112).contains(&took(drive))));
    assert!(spread.iter().any(|drive| took(drive) != 10_000));
    assert!(spread.is_sorted_by_key(|drive| drive.time[0]));
    assert_eq!(spread, drives(Rule::REPAIRED, &layout, &starts, 100, 1).0, "the same seed");
    assert_ne!(spread, drives(Rule::REPAIRED, &layout, &starts, 100, 2).0, "another seed");
}

#[test]
fn teams_that_cannot_start_say_why() {
    let refused = |starts: &[Cell]| {
        let layout = generated("open:9x9", 0);
        let refused = kit::course(Rule::REPAIRED, &layout, starts, Pace::STEADY, 0).err();
        refused.map(|refused| refused.to_string()).unwrap_or_default()
    };
    let near = Cell::new(0, 0);
    assert!(refused(&[near, Cell::new(4, 0)]).contains("do not hear each other"));
    assert!(refused(&[near, near]).contains("give each a node of its own"));
    assert!(refused(&[near, Cell::new(9, 9)]).contains("outside of the map"));
    assert!(refused(&[]).contains("and not 0") && refused(&[near; 9]).contains("and not 9"));
    assert_eq!(refused(&[near, Cell::new(3, 1)]), "");
    let wide = kit::course(Rule::REPAIRED, &generated("open:65x2", 0), &[near], Pace::STEADY, 0).err();
    assert!(wide.is_some_and(|refused| refused.to_string().contains("130 nodes")));
}

#[test]
fn two_robots_drive_all_paths_of_a_large_map() {
    let report = run(&setup(RuleName::Repaired, 2, generated("walls:24x24:0.1", 3), 3));
    assert_eq!((report.stopped, report.violations), (StopReason::Explored, vec![]));
}

/// The fault of a setup: where it is, what is wrong, and what would be right.
fn wrong(setup: &Setup) -> Option<String> {
    let wrong = tautline_sim::explore::team(setup).err();
    wrong.map(|fault| fault.to_string())
}

#[test]
fn speeds_and_their_spread_are_those_that_are_told() {
    let with = |speed_mps, spread| {
        let usual = setup(RuleName::Repaired, 2, generated("open:4x4", 0), 1);
        Setup { options: Options { speed_mps, spread, ..Options::default() }, ..usual }
    };
    let milliseconds = |speed, spread| run(&with(speed, spread)).milliseconds.expect("a clock");
    let usual = milliseconds(None, None);
    assert_eq!(milliseconds(Some(0.3), Some(0.0)), usual);
    // Ten times as fast, and in whole milliseconds.
    assert_eq!(milliseconds(Some(3.0), None), usual / 10);
    assert_ne!(milliseconds(None, Some(0.5)), usual);
    for speed in [0.0, -0.3, f64::NAN, f64::INFINITY, 0.0004] {
        let wrong = wrong(&with(Some(speed), None)).unwrap_or_default();
        assert!(wrong.contains("0.001 to 1000 m/s"), "{speed}: {wrong}");
    }
    for spread in [-0.1, 1.0, f64::NAN] {
        let wrong = wrong(&with(None, Some(spread))).unwrap_or_default();
        assert!(wrong.contains("by less than the whole speed"), "{spread}: {wrong}");
    }
}

#[test]
fn robots_are_never_farther_apart_than_their_range() {
    let with = |range, robots| {
        let usual = setup(RuleName::Repaired, robots, generated("walls:6x5:0.1", 4), 2);
        Setup { options: Options { range_cells: Some(range), ..Options::default() }, ..usual }
    };
    for range in [2, 3, 4, 5] {
        let setup = with(range, 2);
        let mut widest = 0;
        let report = explore(&setup, &mut |made| {
            let (dx, dy) = made.frame.cells[0].apart(made.frame.cells[1]);
            widest = widest.max(dx * dx + dy * dy);
            Ok(())
        });
        let report = report.expect("a run");
        assert_eq!((report.violations, report.stopped), (vec![], StopReason::Explored), "range {range}");
        assert!(widest <= range * range && widest > (range - 1) * (range - 1), "range {range}: {widest}");
    }
    let wrong = |range, robots| wrong(&with(range, robots)).unwrap_or_default();
    assert!(wrong(0, 2).contains("below one path"), "{}", wrong(0, 2));
    assert!(wrong(1, 2).contains("no robot can drive"), "{}", wrong(1, 2));
    assert!(wrong(6, 2).contains("more than the 5"), "{}", wrong(6, 2));
    for range in [2, 3, 4, 5] {
        let report = run(&with(range, 3));
        assert_eq!((report.violations, report.stopped), (vec![], StopReason::Explored), "range {range}");
    }
}

#[test]
fn teams_without_room_or_contact_say_so() {
    let one = |robots| setup(RuleName::Repaired, robots, generated("open:1x1", 0), 0);
    assert!(wrong(&one(1)).unwrap_or_default().contains("one node, and no path"));
    assert!(wrong(&one(2)).unwrap_or_default().contains("do not find room"));
    let apart = |starts: [(i16, i16); 2]| {
        let layout = generated("cells:9x3:0.2", 1);
        let starts = starts.map(Cell::from).to_vec();
        let base = starts[0];
        Setup { starts: Some(starts), ..Setup::new(&KIT, RuleName::Repaired, 2, layout, base) }
    };
    let layout = apart([(0, 0); 2]).layout;
    let free: Vec<Cell> = layout.cells().filter(|&cell| layout.is_free(cell)).collect();
    let wall = layout.cells().find(|&cell| !layout.is_free(cell)).expect("a blocked cell");
    let (first, last) = (free[0], free[free.len() - 1]);
    let far = wrong(&apart([first.into(), last.into()])).unwrap_or_default();
    assert!(far.contains("do not hear each other"), "{far}");
    let blocked = wrong(&apart([first.into(), wall.into()])).unwrap_or_default();
    assert!(blocked.contains("blocked") || blocked.contains("not free"), "{blocked}");
    let many = Setup { robots: 9, ..setup(RuleName::Repaired, 8, generated("open:9x9", 0), 0) };
    assert!(wrong(&many).unwrap_or_default().contains("9 robots are too many"), "{:?}", wrong(&many));
}

fn asked(rule: impl Into<RuleId>, robots: u64, (columns, rows): (u64, u64)) -> HuntRequest<'static> {
    let bounds = HuntBounds {
        robots: Some(robots),
        size: Some(Size::new(columns, rows).expect("a size")),
        max_walls: Some(2),
        ..HuntBounds::default()
    };
    HuntRequest { bounds, ..HuntRequest::new(&KIT, rule.into()) }
}

fn hunted(asked: &HuntRequest<'_>) -> Result<HuntReport, Diagnostic> {
    let hunt = KIT.rule(asked.rule).and_then(|rule| rule.hunt).expect("it is hunted");
    asked.check(hunt)?;
    hunt.hunt(asked, &mut NoWatcher)
}

/// The clauses that are broken, each with its columns, rows, walls and drives.
fn broken(hunted: &HuntReport) -> Vec<(&'static str, [usize; 4])> {
    let size = |finding: &Finding| match finding.facts {
        RunSize::Lattice { columns, rows, walls, drives } => [columns, rows, walls, drives],
        RunSize::Runs { .. } | RunSize::Area { .. } | RunSize::Misses { .. } => panic!("a lattice"),
    };
    hunted.found.iter().map(|finding| (finding.clause, size(finding))).collect()
}

#[test]
fn the_smallest_runs_that_break_the_published_rule() {
    let hunted = hunted(&asked(RuleName::Published, 2, (5, 1))).expect("a hunt");
    assert!(hunted.is_complete);
    let found = broken(&hunted);
    for expected in [("KIT-1", [5, 1, 0, 5]), ("KIT-3", [3, 1, 0, 3]), ("KIT-6", [3, 1, 0, 1])] {
        assert!(found.contains(&expected), "{expected:?} in {found:?}");
    }
    let is_endless = |finding: &&Finding| finding.clause == ENDS.as_str();
    let endless = hunted.found.iter().find(is_endless).expect("a run that goes on for ever");
    assert_eq!(run(&endless.setup).stopped, StopReason::Endless);
    // Before the robots are where they were, nothing is known of it.
    let mut short = endless.setup.clone();
    short.choices.truncate(4);
    let short = run(&short);
    assert_eq!(short.stopped, StopReason::Exhausted);
    assert!(short.violations.iter().all(|broken| broken.clause != ENDS), "{:?}", short.violations);
    assert_eq!(run_again(&hunted), found.len(), "{found:?}");
}

#[test]
fn the_smallest_runs_that_break_the_reading_ahead() {
    let hunted = hunted(&asked(AHEAD, 2, (5, 1))).expect("a hunt");
    assert!(hunted.is_complete);
    let found = broken(&hunted);
    assert!(found.contains(&("KIT-1", [5, 1, 0, 4])), "{found:?}");
    assert_eq!(run_again(&hunted), found.len(), "{found:?}");
}

#[test]
fn a_run_of_the_reading_ahead_that_loses_contact_is_made_smaller() {
    let mut seeds = (0..20).map(|seed| setup(AHEAD, 2, generated("walls:9x5:0.1", seed), seed));
    let is_cut = |setup: &Setup| run(setup).violations.iter().any(|broken| broken.clause == CONTACT);
    let cut = seeds.find(is_cut).expect("a run that loses contact");
    assert_eq!(cut.starts(), [cut.base; 2], "they enter one after the other");
    let smallest = minimise(&cut, Some(CONTACT), &mut |_| Ok(())).expect("it breaks the clause");
    assert!(is_cut(&smallest.setup) && smallest.setup.layout.cells().count() <= 9 * 5);
}

#[test]
fn a_repaired_team_breaks_nothing_within_the_bound() {
    for robots in [1, 2] {
        let hunted = hunted(&asked(RuleName::Repaired, robots, (4, 1))).expect("a hunt");
        assert!(hunted.is_complete && hunted.found.is_empty(), "{robots} robots: {hunted:?}");
    }
}

/// Robots that no known paths join can shut each other in.
#[test]
fn three_robots_that_start_anywhere_may_shut_each_other_in() {
    let hunted = hunted(&asked(RuleName::Repaired, 3, (2, 2))).expect("a hunt");
    assert_eq!(broken(&hunted).iter().map(|found| found.0).collect::<Vec<_>>(), ["KIT-6", "KIT-8"]);
    assert_eq!(run_again(&hunted), 2);
}

#[test]
fn a_hunt_ends_at_its_budget_and_says_so() {
    let hunted =
        hunted(&HuntRequest { budget: Some(100), ..asked(RuleName::Repaired, 2, (4, 2)) }).expect("a hunt");
    assert!(!hunted.is_complete && hunted.found.is_empty());
    let clauses = ["KIT-1", "KIT-2", "KIT-3", "KIT-6", "KIT-7", "KIT-8", "KIT-10", "KIT-11", "KIT-14"];
    assert_eq!(hunted.looked_for, clauses);
}

#[test]
fn hunts_that_cannot_be_made_say_why() {
    let wrong =
        |asked: HuntRequest<'_>| hunted(&asked).err().map(|fault| fault.to_string()).unwrap_or_default();
    let one = wrong(asked(RuleName::Repaired, 2, (1, 1)));
    assert!(one.contains("one node, and no path"), "{one}");
    let many = wrong(asked(RuleName::Repaired, 9, (4, 2)));
    assert!(many.contains("the joint search holds 3 robots, and not 9"), "{many}");
    let none = wrong(asked(RuleName::Repaired, 0, (4, 2)));
    assert!(none.contains("0 robots"), "{none}");
    let full = wrong(asked(RuleName::Repaired, 3, (2, 1)));
    assert!(full.contains("do not find room in 2 nodes"), "{full}");
    for size in [(9, 1), (5, 4)] {
        let large = wrong(asked(RuleName::Repaired, 2, size));
        assert!(large.contains("too many to search"), "{large}");
    }
    let asked = asked(RuleName::Repaired, 2, (2, 1));
    let lost = wrong(HuntRequest { bounds: HuntBounds { max_losses: Some(1), ..asked.bounds }, ..asked });
    assert!(lost.contains("`max-losses` does not bound this hunt"), "{lost}");
}

/// The counterexamples that `docs/kit.md` shows.
#[test]
fn whatever_the_page_shows_can_be_played_again() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let mut played = 0;
    for entry in fs::read_dir(docs).expect("the documents") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        if !name.starts_with("kit-") || path.extension().is_none_or(|end| end != "jsonl") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a file");
        let clause = if text.starts_with("{\"format\":\"tautline run\"") {
            let report = Trace::open(&path, Catalogue::OWN)
                .expect("a run")
                .replay(&mut |_| Ok(()))
                .expect("it is made again");
            report.violations.last().expect("it breaks something").clause.to_string()
        } else {
            refutation::replay(&path, &[]).expect("it is played again").clause.id.to_owned()
        };
        assert!(name.starts_with(&format!("{}-published", clause.to_lowercase())), "{name} breaks {clause}");
        played += 1;
    }
    assert!(played > 1);
}
