//! Robots that go from frontier cell to frontier cell: hunts, their counterexamples as runs, and bad setups.

use std::collections::BTreeMap;

use crate::common::{NoWatcher, generated, run_again};
use tautline_grids::layout::{Layout, Size};
use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Condition, Rule};
use tautline_kernel::ground::Cell;
use tautline_proofs::engine::SeededOracle;
use tautline_sim::explore::frontier::FRONTIER;
use tautline_sim::explore::hunt::{HuntBounds, HuntReport, HuntRequest};
use tautline_sim::explore::{Change, RuleId, Scene, Setup, StopReason, explore, has_double};
use tautline_sim::frontier::{Allowance, AssignedTeam, Assignment, Explorers, TeamEnd};
use tautline_sim::objects::Objects;
use tautline_sim::options::{Options, Wheels};

fn asked(
    rule: &'static str,
    robots: u64,
    (width, height): (u64, u64),
    max_losses: u8,
) -> HuntRequest<'static> {
    let bounds = HuntBounds {
        robots: Some(robots),
        size: Some(Size::new(width, height).expect("a size")),
        max_losses: Some(max_losses).filter(|&losses| losses > 0),
        ..HuntBounds::default()
    };
    HuntRequest { bounds, ..HuntRequest::new(&FRONTIER, RuleId::new(rule)) }
}

fn hunted(rule: &'static str, robots: u64, size: (u64, u64), max_losses: u8) -> HuntReport {
    let asked = asked(rule, robots, size, max_losses);
    let hunt = FRONTIER.rule(asked.rule).and_then(|rule| rule.hunt).expect("it is hunted");
    asked.check(hunt).expect("it takes that");
    hunt.hunt(&asked, &mut NoWatcher).expect("a hunt")
}

#[test]
fn every_stored_counterexample_breaks_its_clause_when_it_is_run_again() {
    for (rule, robots, losses) in
        [("published", 1, 0), ("published", 2, 0), ("published", 2, 1), ("wanders", 2, 0)]
    {
        let hunted = hunted(rule, robots, (3, 2), losses);
        assert!(hunted.is_complete);
        assert!(run_again(&hunted) > 0, "{rule}, {robots} robots");
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
    let [finding] = &hunted.found[..] else { panic!("{:?}", hunted.found) };
    assert_eq!((finding.clause, finding.setup.layout.size().cells()), ("FRONTIER-3", 3));
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
        assert_eq!((report.stopped, report.explored), (StopReason::Explored, 42), "{robots} robots");
        assert!(report.violations.is_empty(), "{:?}", report.violations);
    }
}

/// Of so many runs in 12×14 cells with noise of 2 dB, how many are clean: nothing is noted that is not so, no two
/// robots are in one cell, and the team ends and knows it.
fn clean_runs(rule: Rule, options: &Options, runs: u64) -> usize {
    let is_clean = |seed: &u64| {
        let mut layout = generated("cells:12x14:0.1", *seed);
        let base = Setup::choose_base(&mut layout, None).expect("a base");
        let starts = FRONTIER.default_starts(RuleId::REPAIRED, &layout, base, 4).expect("starts");
        let mut team = Explorers::new(rule, &layout, &starts, options.clone(), *seed);
        loop {
            match team.advance() {
                Err(ended) => return ended == TeamEnd::Known,
                Ok(_) if team.has_false_note() || has_double(team.cells()) => return false,
                Ok(_) => {}
            }
        }
    };
    (0..runs).filter(is_clean).count()
}

#[test]
fn with_noise_a_repaired_team_breaks_nothing_and_its_mutants_do() {
    let noisy = Options { noise_db: 2.0, ..Options::default() };
    assert!(clean_runs(Rule::REPAIRED, &noisy, 20) >= 19);
    let fixes_alone = Rule::REPAIRED.without(Condition::Fuse).without(Condition::Sure);
    assert!(clean_runs(fixes_alone, &noisy, 20) < 10);
    let unsure = Rule::REPAIRED.without(Condition::Sure);
    let noisier = Options { noise_db: 4.0, ..noisy.clone() };
    assert!(clean_runs(Rule::REPAIRED, &noisier, 20) >= 19 && clean_runs(unsure, &noisier, 20) < 15);
    assert!(clean_runs(unsure, &Options { readings: Some(0), ..noisy }, 20) < 10);
}

#[test]
fn wheels_that_err_need_fixes_and_fixes_without_noise_are_enough() {
    let wheels = Options { odometry: Some(Wheels { share: 0.02, turn_degrees: 1.0 }), ..Options::default() };
    assert_eq!(clean_runs(Rule::REPAIRED, &wheels, 5), 5);
    // With eight anchors the best three are near, and few beacons do.
    let near = Options { noise_db: 1.0, anchors: Some(8), readings: Some(25), ..Options::default() };
    assert_eq!(clean_runs(Rule::REPAIRED, &near, 5), 5);
}

#[test]
fn outliers_make_a_team_without_its_gate_err_and_a_team_with_it_not() {
    let outliers = Some("0.05".parse().expect("a probability"));
    let behind_walls = Options { noise_db: 0.5, outliers, ..Options::default() };
    let [gated, open] = [Rule::REPAIRED, Rule::REPAIRED.without(Condition::Gate)]
        .map(|rule| clean_runs(rule, &behind_walls, 20));
    assert!(gated >= 19 && open < 10, "{gated}, {open}");
}

#[test]
fn a_team_whose_fixes_come_from_a_swarm_breaks_nothing() {
    let swarm = Options { noise_db: 1.0, swarm: true, ..Options::default() };
    assert!(clean_runs(Rule::REPAIRED, &swarm, 5) >= 4);
}

#[test]
fn each_small_obstacle_on_its_way_takes_a_robot_a_team_move() {
    let mut setup = setup(1, (6, 1));
    let moves = |setup: &Setup| explore(setup, &mut |_| Ok(())).expect("a run");
    let plain = moves(&setup);
    setup.options = Options { small: Some("1".parse().expect("a probability")), ..Options::default() };
    let around = moves(&setup);
    assert_eq!((around.explored, around.steps), (6, 2 * plain.steps));
    setup.options.noise_db = 1.0;
    assert!(moves(&setup).violations.is_empty());
}

#[test]
fn a_team_without_detour_takes_small_obstacles_for_cells_that_are_filled() {
    let small = Options { small: Some("0.1".parse().expect("a probability")), ..Options::default() };
    assert_eq!(clean_runs(Rule::REPAIRED, &small, 5), 5);
    assert_eq!(clean_runs(Rule::REPAIRED.without(Condition::Detour), &small, 5), 0);
}

#[test]
fn objects_are_found_where_they_are_and_one_that_nobody_reaches_is_not() {
    let mut setup = setup(4, (7, 6));
    let shut = Cell::new(6, 5);
    for cell in [Cell::new(5, 5), Cell::new(6, 4)] {
        setup.layout.block(cell);
    }
    let places = vec![[f64::from(setup.base.x), f64::from(setup.base.y)], [1.25, 2.5], [6.0, 5.0]];
    setup.options = Options { noise_db: 1.0, objects: Some(Objects::At(places)), ..Options::default() };
    let report = explore(&setup, &mut |_| Ok(())).expect("a run");
    let [at_start, on_a_rim, behind] = &report.objects[..] else { panic!("three objects") };
    assert!(behind.found.is_none() && setup.layout.is_free(shut), "{behind:?}");
    for object in [at_start, on_a_rim] {
        let found = object.found.as_ref().expect("it is found");
        let expected = found.deviations[0].hypot(found.deviations[1]);
        assert!(found.error < 4.0 * expected && expected < 0.3, "{object:?}");
    }
}

#[test]
fn marks_of_a_page_say_where_robots_and_objects_are_and_are_taken_to_be() {
    let mut setup = setup(2, (4, 3));
    setup.options = Options { noise_db: 1.0, objects: Some(Objects::Count(3)), ..Options::default() };
    let mut marks = BTreeMap::new();
    explore(&setup, &mut |made| {
        let layers = made.team.layers();
        let mut scene = Scene::default();
        made.team.show(made.before, &mut scene);
        for change in scene.changes() {
            let Change::Mark { layer, mark } = change else { continue };
            marks.insert((layers[*layer].name, mark.number), (mark.value, mark.figures.len()));
        }
        Ok(())
    })
    .expect("a run");
    let of = |name: &str| {
        marks.iter().filter(|((layer, _), _)| *layer == name).map(|(_, &mark)| mark).collect::<Vec<_>>()
    };
    assert_eq!(of("beliefs"), [(1, 7), (1, 7), (2, 2), (2, 2)]);
    assert_eq!(of("fixes"), [(1, 5); 2]);
    assert_eq!(of("objects"), [(1, 5), (1, 5), (1, 5), (2, 2), (2, 2), (2, 2)]);
}

#[test]
fn a_floor_may_be_the_larger_the_less_noise_there_is() {
    let stops = |noise_db, side: i16| {
        let area = tautline_kernel::ground::Area::new(Cell::new(0, 0), Cell::new(side - 1, side - 1));
        Allowance::new(&Options { noise_db, ..Options::default() }, area.expect("an area"))
    };
    assert_eq!(stops(0.0, 100), None);
    let Some(Allowance::Stops(few)) = stops(1.0, 20) else { panic!("it is allowed") };
    let Some(Allowance::Stops(many)) = stops(2.0, 20) else { panic!("it is allowed") };
    // Twice the noise takes four times the fixes, and so does twice the floor.
    assert!((4 * few..=4 * few + 4).contains(&many), "{few}, {many}");
    let unsteady =
        Options { odometry: Some(Wheels { share: 0.02, turn_degrees: 5.0 }), ..Options::default() };
    let area = tautline_kernel::ground::Area::new(Cell::new(0, 0), Cell::new(3, 3)).expect("an area");
    assert_eq!(Allowance::new(&Options { noise_db: 1.0, ..unsteady }, area), Some(Allowance::Never));
}

#[test]
fn what_does_not_fit_is_refused() {
    let wrong =
        |setup: Setup| setup.check().map(|_| ()).map_err(|fault| (fault.field(), fault.what().to_owned()));
    let refused = |field, what: &str| Err((Some(field), what.to_owned()));
    let full = "5 robots do not find room: from the base 4 cells can be reached";
    assert_eq!(wrong(setup(5, (2, 2))), refused("robots", full));
    let with = |options| wrong(Setup { options, ..setup(2, (3, 3)) });
    let usual = Options::default;
    assert_eq!(with(usual()), Ok(()));
    let no_threshold = refused("threshold", "a threshold of the occupancy probability is from 0 to 1");
    assert_eq!(with(Options { threshold: 1.5, ..usual() }), no_threshold);
    assert_eq!(with(Options { threshold: f64::NAN, ..usual() }), no_threshold);
    let no_noise = refused("noise-db", "a standard deviation of noise is from 0 to 100 dB");
    assert_eq!(with(Options { noise_db: -1.0, ..usual() }), no_noise);
    let no_wheels = |share, turn_degrees| {
        with(Options { odometry: Some(Wheels { share, turn_degrees }), ..usual() }).expect_err("wheels").0
    };
    assert_eq!(no_wheels(-0.1, 1.0), Some("odometry"));
    assert_eq!(no_wheels(0.02, f64::NAN), Some("odometry"));
    let no_anchors = refused("anchors", "a position takes three anchors, and there is room for 8");
    assert_eq!(with(Options { anchors: Some(2), ..usual() }), no_anchors);
    let cell = Cell::new(0, 0);
    let together = Setup { starts: Some(vec![cell, cell]), ..setup(2, (3, 3)) };
    assert_eq!(wrong(together), refused("starts", "two robots start in the cell 0,0"));
}

/// By two robots of the published rule FRONTIER-2 and FRONTIER-13 are broken, too.
#[test]
fn what_a_hunt_finds_and_looks_for_is_in_the_order_of_the_numbers() {
    let report = hunted("published", 2, (4, 1), 0);
    let all = ["FRONTIER-1", "FRONTIER-2", "FRONTIER-3", "FRONTIER-4", "FRONTIER-5", "FRONTIER-13"];
    assert_eq!(
        (&report.looked_for[..], &hunted("greedy", 2, (2, 1), 0).looked_for[..]),
        (&all[..], &all[..])
    );
    let found: Vec<&str> = report.found.iter().map(|finding| finding.clause).collect();
    let in_order: Vec<&str> = all.into_iter().filter(|clause| found.contains(clause)).collect();
    assert!(
        found == in_order && found.contains(&"FRONTIER-2") && found.contains(&"FRONTIER-13"),
        "{found:?}"
    );
}

#[test]
fn an_error_below_zero_is_none() {
    let off = |error_cells| {
        let asked = asked("repaired", 1, (2, 1), 0);
        HuntRequest { bounds: HuntBounds { error_cells, ..asked.bounds }, ..asked }
    };
    let hunt = FRONTIER.rule(off(None).rule).and_then(|rule| rule.hunt).expect("it is hunted");
    for error in [-1.0, -0.5, -0.01, 0.3, 2.0, f64::NAN] {
        let refused = hunt.hunt(&off(Some(error)), &mut NoWatcher).map(|_| ()).expect_err("no error");
        assert!(refused.to_string().contains("is not searched"), "{error}: {refused}");
    }
    let states = |error| hunt.hunt(&off(error), &mut NoWatcher).expect("a hunt").title;
    assert_eq!(states(Some(-0.0)), states(None));
}

#[test]
fn a_hunt_for_more_robots_than_its_search_holds_says_how_many_that_are() {
    let refused = |rule: &'static str, robots: u64| {
        let rule = RuleId::new(rule);
        let asked = HuntRequest { rule, ..asked("repaired", robots, (3, 3), 0) };
        let hunt = FRONTIER.rule(rule).and_then(|rule| rule.hunt).expect("it is hunted");
        hunt.hunt(&asked, &mut NoWatcher).expect_err("no hunt").to_string()
    };
    let many = "this search holds 3 robots, and not 5; give `robots` a number from 1 to 3";
    let none = "a hunt without a robot finds nothing; give `robots` a number from 1 to 3";
    let full = "10 robots do not find room in 3x3 cells; give `robots` a number up to 9, or a larger `size`";
    for (rule, robots, said) in [("repaired", 5, many), ("repaired", 0, none), ("greedy", 10, full)] {
        assert_eq!(refused(rule, robots), said);
    }
}

/// So many free cells, any of them.
fn any_starts(layout: &Layout, robots: usize, oracle: &mut SeededOracle) -> Vec<Cell> {
    let mut free: Vec<Cell> = layout.cells().filter(|&cell| layout.is_free(cell)).collect();
    let any = |_| {
        let number = oracle.pick(free.len() as u32) as usize;
        free.swap_remove(number)
    };
    (0..robots).map(any).collect()
}

/// Runs of Hungarian assignment that is computed anew at every move, in so many random layouts for each size, share of
/// blocked cells and number of robots. All starts are anywhere and in any order, so that ties are broken in any way.
fn end_of_runs_with_assignments_anew(layouts: u64) -> usize {
    let mut runs = 0;
    for size in ["6x7", "8x8", "10x6", "12x14"] {
        for share in ["0.05", "0.1", "0.2", "0.3"] {
            for seed in 0..layouts {
                let layout = generated(&format!("cells:{size}:{share}"), seed);
                for robots in 2..=8 {
                    let starts = any_starts(&layout, robots, &mut SeededOracle::new(seed, robots as u64));
                    let mut team = AssignedTeam::new(Assignment::HungarianAnew, &layout, &starts);
                    let ended = loop {
                        if let Err(ended) = team.advance() {
                            break ended;
                        }
                    };
                    assert_eq!(ended, TeamEnd::Known, "{size}, {share}, seed {seed}, {robots} robots");
                    runs += 1;
                }
            }
        }
    }
    runs
}

#[test]
fn hungarian_assignment_anew_at_every_move_ends() {
    assert_eq!(end_of_runs_with_assignments_anew(2), 224);
}

#[test]
#[ignore = "98 s of a core: cargo test -p tautline-sim --test all larger_layouts -- --ignored"]
fn hungarian_assignment_anew_at_every_move_ends_in_larger_layouts() {
    assert_eq!(end_of_runs_with_assignments_anew(500), 56_000);
}

/// The team moves of repaired robots with Keep, those that they take more without it, and in how many of so many runs
/// these differ, for each of several sizes and shares of blocked cells. All starts are anywhere.
fn moves_with_keep(layouts: u64) -> (usize, isize, usize) {
    let (mut moves, mut more, mut differing) = (0, 0, 0);
    for cells in ["6x7:0.1", "6x7:0.3", "12x14:0.1", "12x14:0.3"] {
        for seed in 0..layouts {
            let layout = generated(&format!("cells:{cells}"), seed);
            for robots in [2, 4, 8] {
                let starts = any_starts(&layout, robots, &mut SeededOracle::new(seed, robots as u64));
                let [with, without] = [Rule::REPAIRED, Rule::REPAIRED.without(Condition::Keep)].map(|rule| {
                    let mut team = Explorers::new(rule, &layout, &starts, Options::USUAL, seed);
                    (0..100_000).find(|_| team.advance().is_err()).expect("every run ends")
                });
                moves += with;
                more += without as isize - with as isize;
                differing += usize::from(with != without);
            }
        }
    }
    (moves, more, differing)
}

#[test]
fn keep_costs_next_to_nothing() {
    assert_eq!(moves_with_keep(2), (994, 0, 0));
}

#[test]
#[ignore = "6 s of a core: cargo test -p tautline-sim --test all keep_costs -- --ignored"]
fn keep_costs_next_to_nothing_in_many_layouts() {
    assert_eq!(moves_with_keep(100), (49_119, 17, 2));
}

#[test]
#[ignore = "46 s of a core, and published maps: cargo test -p tautline-sim --release --test \
            all published_maps -- --ignored --nocapture"]
fn eight_robots_explore_published_maps() {
    let folder = std::env::var_os("TAUTLINE_MAPS").expect("TAUTLINE_MAPS names the folder of published maps");
    for (map, expected) in [("random512-10-0", 36_795), ("Boston_0_512", 29_356)] {
        let file = std::path::Path::new(&folder).join(format!("{map}.map"));
        let mut layout =
            tautline_grids::layout::load(file.to_str().expect("a name"), 0, None).expect("a map");
        let base = layout.default_base().expect("a base");
        layout.place_base(base).expect("a base");
        let starts = FRONTIER.default_starts(RuleId::REPAIRED, &layout, base, 8).expect("starts");
        let (begin, mut moves) = (std::time::Instant::now(), 0);
        let mut team = Explorers::new(Rule::REPAIRED, &layout, &starts, Options::default(), 0);
        while team.advance().is_ok() {
            moves += 1;
        }
        println!("{map}: {moves} team moves in {:.1} s", begin.elapsed().as_secs_f64());
        assert_eq!(moves, expected, "{map}");
    }
}
