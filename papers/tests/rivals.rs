//! The rivals of the chain: Full search finds what plain enumeration finds, what does not fit is refused with its
//! reason, and runs end.

use std::collections::BTreeSet;

use tautline_grids::chance::Dice;
use tautline_grids::layout::{Generator, Layout};
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};
use tautline_papers::rivals::full::{BestMoves, best};
use tautline_papers::rivals::joint::{Joint, Score};
use tautline_papers::rivals::{CATALOGUE, COVERED, rival};
use tautline_papers::rivals::{
    Cells, Deadlock, Links, Moves, Null, ParameterError, Parameters, Search, Team, Weights, full, pool,
};
use tautline_sim::explore::{Limits, Report, RuleId, Setup, StopReason, explore, run, team};

fn layout(description: &str, seed: u64) -> Layout {
    description.parse::<Generator>().expect("a generator").generate(seed).expect("a layout")
}

/// The score of the best joint moves and all of them, by looking at each.
fn enumerated(joint: &Joint) -> (Score, BTreeSet<Vec<usize>>) {
    let (mut best, mut all) = (None, BTreeSet::new());
    let mut chosen = vec![0; joint.robots.len()];
    loop {
        let options = || chosen.iter().zip(&joint.robots).map(|(&place, robot)| robot[place]);
        let team: Vec<Cell> = options().map(|candidate| candidate.to).collect();
        let score = joint.score(&team, options().map(|candidate| candidate.price).sum());
        if best.is_none_or(|best| score < best) {
            best = Some(score);
            all.clear();
        }
        if best == Some(score) {
            all.insert(options().map(|candidate| candidate.step.place()).collect());
        }
        let Some(place) = (0..chosen.len()).find(|&place| chosen[place] + 1 < joint.robots[place].len())
        else {
            return (best.expect("a joint move"), all);
        };
        chosen[..place].fill(0);
        chosen[place] += 1;
    }
}

fn parameters(number: u64) -> Parameters {
    Parameters {
        links: if number & 1 == 0 { Links::Safe } else { Links::Covered },
        cells: if number & 2 == 0 { Cells::Distinct } else { Cells::Shared },
        weights: Weights { distance: 1.0, new_cell: if number & 4 == 0 { 0.0 } else { 2.5 }, leader: 1.0 },
        ..Parameters::FULL
    }
}

#[test]
fn full_search_finds_what_plain_enumeration_finds_ties_and_faults_included() {
    let mut dice = Dice::new(1, *b"rivals  ");
    let (mut faulty, mut tied) = (0, 0);
    for seed in 0..40 {
        let (robots, density) = (3 + seed as usize % 4, ["0", "0.1", "0.3"][seed as usize % 3]);
        let layout = layout(&format!("walls:9x9:{density}"), seed);
        let parameters = Parameters { patience: 10, ..parameters(seed) };
        let mut team =
            Team::new(parameters, robots, Cell::new(4, 4), layout.size().area(), seed).expect("a team");
        while let Some(joint) = team.joint() {
            let (score, all) = enumerated(&joint);
            let BestMoves { score: found, ties, steps } = best(&joint, &mut dice).expect("few robots");
            assert_eq!((found, ties), (score, all.len() as u64), "{joint:?}");
            assert!(all.contains(&steps.into_iter().map(Step::place).collect::<Vec<_>>()), "{joint:?}");
            faulty += u32::from(score.faults > 0);
            tied += u32::from(ties > 1);
            if team.advance(&mut |edge| layout.is_open(edge)).is_err() {
                break;
            }
        }
    }
    assert!(faulty > 0 && tied > 100, "{faulty} {tied}");
}

#[test]
fn ties_are_broken_evenly() {
    let mut team = Team::new(Parameters::FULL, 2, Cell::new(1, 1), layout("open:3x3", 0).size().area(), 0)
        .expect("a team");
    let joint = team.joint().expect("an unexplored cell");
    let mut dice = Dice::new(2, *b"rivals  ");
    let mut counts = [0; 5];
    for _ in 0..4000 {
        counts[best(&joint, &mut dice).expect("one robot").steps[0].place()] += 1;
    }
    assert!(counts[..4].iter().all(|count| (900..1100).contains(count)) && counts[4] == 0, "{counts:?}");
}

#[test]
fn a_pool_has_the_null_move_and_no_more_than_it_holds() {
    let mut team = Team::new(Parameters::POOL, 8, Cell::new(7, 7), layout("open:15x15", 0).size().area(), 0)
        .expect("a team");
    let joint = team.joint().expect("an unexplored cell");
    let mut dice = Dice::new(3, *b"rivals  ");
    for null in [Null::StandsBy, Null::Competes] {
        assert_eq!(pool::best(&joint, 1, null, &Step::ALL, &mut dice), Some(vec![Step::Stay; 7]));
    }
    let value = |pool| {
        let steps = pool::best(&joint, pool, Null::Competes, &Step::ALL, &mut Dice::new(4, *b"rivals  "))
            .expect("a move");
        let team: Vec<Cell> = steps.iter().map(|&step| Cell::new(7, 7).after(step)).collect();
        let chosen = |(robot, step): (usize, &Step)| {
            joint.robots[robot].iter().find(|candidate| candidate.step == *step).expect("a candidate").price
        };
        joint.score(&team, steps.iter().enumerate().map(chosen).sum())
    };
    let best = full::best(&joint, &mut dice).expect("eight robots").score;
    assert!(value(1000) <= value(10) && value(10) <= value(1) && best <= value(1000));
}

#[test]
fn what_does_not_fit_is_refused_with_its_reason() {
    let refused = |parameters: Parameters, robots| {
        let unfit = parameters.check(robots).expect_err("it does not fit");
        assert!(!unfit.remedy().is_empty());
        unfit.to_string()
    };
    let four = Parameters::FULL.with_moves(Moves::Four);
    insta::assert_snapshot!(refused(four, 8),
        @"with four moves a robot there is no legal first team move: 7 robots cannot leave one \
          cell by four sides into cells of their own");
    assert!(four.check(5).is_ok() && four.in_cells(Cells::Shared).check(8).is_ok());
    insta::assert_snapshot!(refused(Parameters::FULL, 12),
        @"full search of 12 robots would look at 5^11 = 48828125 team moves in each");
    insta::assert_snapshot!(refused(Parameters::FULL, 256),
        @"full search of 256 robots would look at 5^255 team moves in each");
    assert!(Parameters::FULL.check(10).is_ok() && Parameters::POOL.check(256).is_ok());
    insta::assert_snapshot!(refused(Parameters { search: Search::Pool(0), ..Parameters::POOL }, 8),
        @"a pool of no team moves");
    insta::assert_snapshot!(refused(Parameters::POOL, 1), @"there is no team of 1, the base counted");
    for wrong in [f64::NAN, f64::INFINITY, -1e9] {
        let weights = Weights { distance: wrong, ..Parameters::FULL.weights };
        assert!(matches!(
            Parameters { weights, ..Parameters::FULL }.check(8),
            Err(ParameterError::Weight { .. })
        ));
        let weights = Weights { new_cell: wrong, ..Parameters::FULL.weights };
        assert!(matches!(
            Parameters { weights, ..Parameters::POOL }.check(8),
            Err(ParameterError::Weight { .. })
        ));
    }
    let setup = |name, rule, robots| {
        let layout = layout("open:23x23", 0);
        Setup::new(CATALOGUE.scheme(name).expect("a scheme"), rule, robots, layout, Cell::new(11, 11))
    };
    let fault = |setup: &Setup| team(setup).expect_err("it does not fit").to_string();
    assert!(fault(&setup("full-search", RuleId::PUBLISHED, 8)).contains("7 robots cannot leave"));
    assert!(fault(&setup("full-search", RuleId::REPAIRED, 11)).contains("2 to 10 robots"));
    assert!(Parameters::FULL.check(12).expect_err("it does not fit").to_string().contains("48828125"));
    assert!(fault(&setup("rooker-birk", RuleId::PUBLISHED, 8)).contains("four sides"));
    assert!(fault(&setup("chain", COVERED, 8)).contains("chain has no rule covered"));
}

/// A run with these parameters, base in the middle.
fn played(parameters: Parameters, robots: u16, layout: &Layout, seed: u64) -> Report {
    let base = layout.default_base().expect("a free cell");
    let mut team = rival(parameters, robots, layout, base, seed).expect("a team");
    run(&mut *team, layout, Limits::default(), &mut |_| Ok(())).expect("nobody stops it")
}

#[test]
fn a_base_that_is_walled_in_ends_the_run() {
    let mut walled = layout("open:5x5", 0);
    for side in Side::ALL {
        walled.build_wall(Edge::new(Cell::new(2, 2), side));
    }
    for parameters in [Parameters::FULL, Parameters::POOL] {
        let report = played(parameters, 3, &walled, 0);
        assert_eq!((report.stopped, report.explored), (StopReason::Exhausted, 1), "{parameters:?}");
    }
}

#[test]
fn a_team_that_is_stuck_ends_when_its_patience_does_and_a_scattered_one_goes_on() {
    let layout = layout("rooms-a", 0);
    let stuck = Parameters { patience: 100, ..Parameters::FULL.linked(Links::Covered) };
    let waits = played(stuck, 8, &layout, 0);
    assert_eq!(waits.stopped, StopReason::Idle);
    let scatters =
        played(Parameters { deadlock: Deadlock::Scatter { after: 10, moves: 10 }, ..stuck }, 8, &layout, 0);
    assert!(scatters.explored > waits.explored, "{} {}", scatters.explored, waits.explored);
}

#[test]
fn the_same_seed_makes_the_same_run_and_links_break_only_where_a_robot_meets_a_wall() {
    for name in ["full-search", "rooker-birk"] {
        let setup = |seed| {
            let layout = layout("walls:15x15:0.1", 5);
            let setup =
                Setup::new(CATALOGUE.scheme(name).expect("a scheme"), COVERED, 8, layout, Cell::new(7, 7));
            Setup {
                seed,
                limits: Limits { until: Some(tautline_sim::explore::Milestone::Half), ..Limits::default() },
                ..setup
            }
        };
        let frames = |seed| {
            let (mut frames, mut was_blocked) = (Vec::new(), false);
            let report = explore(&setup(seed), &mut |made| {
                let cells = &made.frame.cells;
                let joint = Joint {
                    base: cells[0],
                    robots: Vec::new(),
                    links: Links::Covered,
                    cells: Cells::Distinct,
                };
                let is_blocked = made.frame.blocked.contains(&true);
                let faults = joint.score(&cells[1..], 0).faults;
                assert!(faults == 0 || is_blocked || was_blocked, "{name} {}", made.step);
                was_blocked = faults > 0;
                frames.push(made.frame.clone());
                Ok(())
            });
            report.expect("nobody stops it");
            frames
        };
        assert_eq!(frames(1), frames(1));
        assert_ne!(frames(1), frames(2));
    }
}

#[test]
fn a_rival_explores_no_farther_than_a_chain() {
    let layout = layout("open:15x15", 0);
    let report = played(Parameters::FULL.linked(Links::Covered), 4, &layout, 0);
    let first = Cell::new(4, 4);
    assert_eq!(
        (report.cells, report.chart.area()),
        (49, Area::new(first, Cell::new(10, 10)).expect("an area"))
    );
}
