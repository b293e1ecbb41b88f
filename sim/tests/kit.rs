//! Robots that keep in touch, in random layouts: the repaired team breaks nothing, drives every path and knows it; the
//! published one does not keep its promises; and teams that cannot start say why.

use std::num::NonZeroU32;

use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;
use tautline_sim::explore::kit::{APART, CONNECTED, CONTACT, KIT};
use tautline_sim::explore::{Report, RuleName, Setup, Stopped, explore};
use tautline_sim::kit::{self, Drive, Pace, REACH_MILLIMETRES};
use tautline_sim::layout::{Generator, Layout};

fn generated(description: &str, seed: u64) -> Layout {
    description.parse::<Generator>().expect("a generator").generate(seed).expect("a layout")
}

fn setup(rule: RuleName, robots: u16, layout: Layout, seed: u64) -> Setup {
    let base = layout.default_base().expect("a free cell");
    let starts = KIT.default_starts(rule.into(), &layout, base, robots);
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

/// Repaired teams of so many in random layouts, each with its seed. Where there are not so many cells within reach, there is
/// none.
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
            whole += u32::from(report.stopped == Stopped::Explored);
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
    assert_eq!((report.stopped, report.violations), (Stopped::Explored, vec![]));
}
