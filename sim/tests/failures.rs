//! Chains in which something fails: what is promised holds, and without *Hold* it does not.

use crate::common::generated;
use tautline_grids::chance::Probability;
use tautline_sim::explore::chain::{ANY_ORDER, CHAIN, REEL, UNHELD};
use tautline_sim::explore::{Report, RuleId, Setup, StopReason, explore};
use tautline_sim::failures::{Failure, MoveOrder};
use tautline_sim::options::Options;

fn ran(rule: RuleId, robots: u16, density: f64, seed: u64, options: Options) -> Report {
    let mut layout = generated(&format!("walls:15x15:{density}"), seed);
    let base = Setup::choose_base(&mut layout, None).expect("a base");
    let setup = Setup { options, seed, ..Setup::new(&CHAIN, rule, robots, layout, base) };
    explore(&setup, &mut |_| Ok(())).map_err(|_| ()).expect("a run")
}

fn failure(robot: u16, step: u32) -> Failure {
    Failure { robot, step: step.try_into().expect("from 1 on") }
}

#[test]
fn lost_bytes_delay_a_run_and_change_nothing_of_it() {
    let lossy = Options { loss: Probability::new(0.3).expect("a probability"), ..Options::USUAL };
    for seed in 0..6 {
        let (whole, lost) = (ran(REEL, 6, 0.1, seed, Options::USUAL), ran(REEL, 6, 0.1, seed, lossy.clone()));
        let failures = lost.failures.expect("something was to fail");
        assert!(failures.lost_bytes > 0 && failures.rounds > u64::from(lost.steps), "{failures:?}");
        let same = |report: &Report| (report.steps, report.milestones, report.team.clone(), report.stopped);
        assert_eq!(same(&whole), same(&lost));
        assert_eq!((whole.violations, lost.violations), (vec![], vec![]));
    }
}

/// Runs of 8 robots at each density in which the order of going breaks contact: of the reel, of the reel without
/// *Hold*, and of the repaired rule.
fn broken_by_orders(runs: u64) -> [[usize; 5]; 3] {
    let speeds = Options { going: MoveOrder::OneByOne, ..Options::USUAL };
    [REEL, UNHELD, RuleId::REPAIRED].map(|rule| {
        [0.01, 0.05, 0.1, 0.15, 0.2].map(|density| {
            let is_broken = |seed| {
                let report = ran(rule, 8, density, seed, speeds.clone());
                report.violations.iter().any(|broken| broken.clause == ANY_ORDER)
            };
            (0..runs).filter(|&seed| is_broken(seed)).count()
        })
    })
}

#[test]
fn no_order_of_going_breaks_contact_and_without_hold_some_do() {
    let [reel, unheld, repaired] = broken_by_orders(8);
    assert_eq!(reel, [0; 5]);
    assert!(unheld.iter().sum::<usize>() > 0, "{unheld:?}");
    assert!(repaired[1..].iter().all(|&broken| broken > 0), "{repaired:?}");
}

#[test]
#[ignore = "ten thousand runs take minutes"]
fn no_order_of_going_breaks_contact_in_1000_runs_a_density() {
    let [reel, unheld, repaired] = broken_by_orders(1000);
    println!("reel {reel:?}, unheld {unheld:?}, repaired {repaired:?}");
    assert_eq!(reel, [0; 5]);
    assert!([unheld, repaired].iter().all(|broken| broken.iter().sum::<usize>() > 0));
}

/// Of so many runs a density in which some robot dies: the team moves taken back, in rising order, and how often the
/// chain came home. Nothing may be broken.
fn deaths(density: f64, runs: u64) -> (Vec<u32>, usize) {
    let (mut taken_back, mut home) = (Vec::new(), 0);
    for seed in 0..runs {
        let (robot, step) = (2 + (seed % 7) as u16, 1 + (seed * 37 % 200) as u32);
        let report =
            ran(REEL, 8, density, seed, Options { fail: Some(failure(robot, step)), ..Options::USUAL });
        assert_eq!(report.violations, [], "{density} {seed}");
        let failures = report.failures.expect("something was to fail");
        if failures.died.is_some() {
            let moves = failures.taken_back.expect("the others re-form");
            assert!(moves <= 2 * step, "{density} {seed}: {moves} team moves taken back after {step}");
            taken_back.push(moves);
            home += usize::from(failures.home > 0);
        }
    }
    taken_back.sort_unstable();
    (taken_back, home)
}

#[test]
fn whoever_dies_the_others_explore_what_is_within_their_reach() {
    let (mut runs, mut home) = (0, 0);
    for density in [0.05, 0.1, 0.2] {
        let (taken_back, came_home) = deaths(density, 14);
        runs += taken_back.len();
        home += came_home;
    }
    assert!(runs > 30, "{runs} deaths, home after {home}");
}

#[test]
#[ignore = "five thousand runs take a minute"]
fn deaths_in_1000_runs_a_density() {
    for density in [0.01, 0.05, 0.1, 0.15, 0.2] {
        let (taken_back, home) = deaths(density, 1000);
        let at_once = taken_back.iter().filter(|&&moves| moves == 0).count();
        let (runs, most) = (taken_back.len(), taken_back.last());
        let p95 = taken_back[runs * 95 / 100];
        println!(
            "{density}: {runs} deaths, {at_once} at once, 95 % in {p95}, all in {most:?}, {home} came home"
        );
    }
}

#[test]
fn a_failure_after_the_end_of_a_run_changes_nothing() {
    let late = ran(REEL, 8, 0.1, 3, Options { fail: Some(failure(4, 100_000)), ..Options::USUAL });
    let never = ran(REEL, 8, 0.1, 3, Options::USUAL);
    assert_eq!((late.steps, late.stopped), (never.steps, never.stopped));
    assert_ne!(late.stopped, StopReason::Silent);
    assert_eq!(late.failures.and_then(|failures| failures.died), None);
}
