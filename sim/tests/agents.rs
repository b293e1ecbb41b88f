//! Runs of agents on sensor floors: without missed sensors every cell that they can get to is visited and every agent
//! knows that it is done, in random layouts and on published maps; ants and robust agents explore everything.

use std::collections::BTreeSet;
use std::path::Path;
use std::{env, fs, thread};

use crate::common::{NoWatcher, generated};
use insta::assert_snapshot;
use proptest::prelude::*;
use tautline_grids::chance::Probability;
use tautline_grids::layout::{self, Generator, Layout, MAX_CELLS, Size};
use tautline_kernel::bricks::Rule;
use tautline_kernel::bricks::tree::{Label, Rule as Trees};
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::floor::crew::Scheme;
use tautline_proofs::floor_trace::{Course, Scene, Turn};
use tautline_sim::draw::story;
use tautline_sim::explore::agents::{Agents, PREMATURE};
use tautline_sim::explore::ants::ANTS;
use tautline_sim::explore::bricks::{BRICKS, BRICKS_ANTS};
use tautline_sim::explore::depth_first::{HELPERS, MDFS};
use tautline_sim::explore::hunt::{Exhibit, HuntBounds, HuntReport, HuntRequest};
use tautline_sim::explore::{Profile, Report, RuleId, RuleName, Setup, StopReason, explore, team};

/// More team moves than any run here has.
const MANY: u32 = 300_000;

/// Layouts with more cells than this are visited by one team of each kind only, since all of them take minutes.
const MOST_CELLS: u32 = 20_000;

/// A map whose 26,000 blocked cells stand alone: who marks cells walks round them for a minute. It is left to trees.
const SCATTERED: &str = "random512-10-0.map";

fn run(setup: &Setup) -> Report {
    let report = explore(setup, &mut |made| {
        assert!(made.step < MANY, "the run does not end: {setup:?}");
        Ok(())
    });
    report.expect("a run")
}

/// Random layouts of every generator that has chance in it, and up to eight agents anywhere in them.
fn setups() -> impl Strategy<Value = Setup> {
    let size = (1_u64..=12, 1_u64..=12);
    let described = prop_oneof![
        (size.clone(), 0.0..0.5_f64).prop_map(|((width, height), p)| format!("walls:{width}x{height}:{p}")),
        (size.clone(), 0.0..0.5_f64).prop_map(|((width, height), p)| format!("cells:{width}x{height}:{p}")),
        (size, 1_u64..=4, 1_u64..=4).prop_map(|((width, height), across, down)| {
            format!("office:{width}x{height}:{}x{}", across.min(width), down.min(height))
        }),
    ];
    (described, 0_u64..1000, prop::collection::vec(any::<prop::sample::Index>(), 1..=8)).prop_filter_map(
        "every cell is blocked",
        |(described, seed, places)| {
            let generator: Generator = described.parse().expect("a generator");
            let mut layout = generator.generate(seed).ok()?;
            let free: Vec<Cell> = layout.cells().filter(|&cell| layout.is_free(cell)).collect();
            let starts: Vec<Cell> = places.iter().map(|place| *place.get(&free)).collect();
            let base = Setup::choose_base(&mut layout, None).ok()?;
            let robots = starts.len() as u16;
            let setup = Setup::new(&BRICKS, RuleName::Repaired, robots, layout, base);
            Some(Setup { seed, starts: Some(starts), ..setup })
        },
    )
}

/// The cells that can be reached from `start`.
fn connected(layout: &Layout, start: Cell) -> BTreeSet<Cell> {
    let (mut reached, mut left) = (BTreeSet::from([start]), vec![start]);
    while let Some(cell) = left.pop() {
        for side in Side::ALL {
            if layout.is_open(Edge::new(cell, side)) && reached.insert(cell.beyond(side)) {
                left.push(cell.beyond(side));
            }
        }
    }
    reached
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_cell_is_visited_and_every_agent_knows_it(
        setup in setups(),
        scheme in prop::sample::select(vec![&BRICKS, &BRICKS_ANTS]),
    ) {
        let report = run(&Setup { scheme: scheme.into(), ..setup.clone() });
        prop_assert_eq!(&report.violations, &[]);
        prop_assert_eq!(report.stopped, StopReason::Explored);
        let due: BTreeSet<Cell> = setup.starts().iter().flat_map(|&start| connected(&setup.layout, start)).collect();
        let whole = report.whole();
        prop_assert_eq!(due.len() as u32, report.cells);
        prop_assert_eq!((whole.visited, whole.explored, whole.active), (report.cells, report.cells, 0));
        for component in &report.components {
            prop_assert_eq!((component.visited, component.active), (component.cells, 0));
        }
        prop_assert!(due.iter().all(|&cell| report.chart.step(cell).is_some()));
    }

    #[test]
    fn agents_that_search_in_trees_visit_every_cell_and_know_it(
        setup in setups(),
        (scheme, rule) in prop::sample::select(vec![
            (&BRICKS, RuleId::new("tree")),
            (&HELPERS, RuleId::new("trusting")),
            (&HELPERS, RuleId::REPAIRED),
        ]),
    ) {
        let report = run(&Setup { scheme: scheme.into(), rule, ..setup.clone() });
        prop_assert_eq!(&report.violations, &[]);
        prop_assert_eq!(report.stopped, StopReason::Explored);
        let whole = report.whole();
        prop_assert_eq!((whole.visited, whole.explored, whole.active), (report.cells, report.cells, 0));
    }

    #[test]
    fn careful_helpers_visit_every_cell_and_know_it_although_sensors_are_missed(
        setup in setups(),
        miss in 0.0..0.2_f64,
    ) {
        let miss = Probability::new(miss).expect("a probability");
        let report = run(&Setup { scheme: (&HELPERS).into(), miss, ..setup });
        prop_assert_eq!(&report.violations, &[]);
        let whole = report.whole();
        prop_assert_eq!((whole.visited, whole.explored, whole.active), (report.cells, report.cells, 0));
    }

    #[test]
    fn ants_explore_everything(setup in setups(), rule in prop::sample::select(RuleName::ALL.to_vec())) {
        let report = run(&Setup { scheme: (&ANTS).into(), rule: rule.into(), ..setup });
        prop_assert_eq!((report.stopped, report.explored), (StopReason::Explored, report.cells));
        prop_assert_eq!(report.violations, []);
    }

    #[test]
    fn repaired_ants_and_robust_agents_explore_everything_although_sensors_are_missed(
        setup in setups(),
        miss in 0.0..0.1_f64,
        scheme in prop::sample::select(vec![&ANTS, &BRICKS_ANTS]),
    ) {
        let miss = Probability::new(miss).expect("a probability");
        let report = run(&Setup { scheme: scheme.into(), miss, ..setup });
        prop_assert_eq!(&report.violations, &[]);
        prop_assert_eq!((report.stopped, report.explored), (StopReason::Explored, report.cells));
    }
}

/// The end of a team in `layout`, all agents starting in `start`: cells, visited cells, and agents that are not done.
fn ended(scheme: impl Scheme, layout: &Layout, start: Cell, agents: usize) -> (u32, u32, u32) {
    let starts = vec![start; agents];
    let mut team = Agents::new(scheme, layout, &starts, Probability::NEVER, 0);
    while !team.is_over() {
        team.advance();
    }
    let whole = team.whole();
    (whole.cells, whole.visited, whole.active.into())
}

/// A free cell of the largest part of `layout`, and how many cells the part has.
fn largest_part(layout: &Layout) -> (Cell, u32) {
    let mut seen = BTreeSet::new();
    let mut largest = None;
    for cell in layout.cells().filter(|&cell| layout.is_free(cell)) {
        if seen.contains(&cell) {
            continue;
        }
        let part = connected(layout, cell);
        if largest.is_none_or(|(_, cells)| cells < part.len() as u32) {
            largest = Some((cell, part.len() as u32));
        }
        seen.extend(part);
    }
    largest.expect("a free cell")
}

/// Every team visits the whole of the part of `layout` that `start` is in, which has so many cells, and knows it.
fn is_visited(name: &str, layout: &Layout, (start, cells): (Cell, u32)) {
    let mut teams =
        [Rule::REPAIRED, Rule::ROBUST].map(|rule| [4, 1, 20].map(|agents| (rule, agents))).concat();
    let mut trees = vec![(Trees::HELPERS, 20), (Trees::TREE, 4), (Trees::ROBUST, 1)];
    if cells > MOST_CELLS {
        teams.truncate(1);
        trees.truncate(1);
    }
    if name.ends_with(SCATTERED) {
        teams.clear();
    }
    for (rule, agents) in teams {
        let end = ended(rule, layout, start, agents);
        assert_eq!(end, (cells, cells, 0), "{name}, {agents} agents, {rule:?}");
    }
    for (rule, agents) in trees {
        let end = ended(rule, layout, start, agents);
        assert_eq!(end, (cells, cells, 0), "{name}, {agents} agents, {rule:?}");
    }
}

#[test]
fn built_in_layouts_are_visited() {
    for described in
        ["rooms-a", "rooms-b", "open:20x7", "office:30x30:4x4", "cells:24x24:0.3", "walls:24x24:0.3"]
    {
        let layout = generated(described, 1);
        is_visited(described, &layout, largest_part(&layout));
    }
}

#[test]
fn an_agent_with_a_tree_of_its_own_is_done_too_early() {
    let mut layout = Layout::open(2, 3).expect("a layout");
    layout.block(Cell::new(0, 1));
    let base = Setup::choose_base(&mut layout, None).expect("a free cell");
    let ends_early = |starts: [(i16, i16); 2]| {
        let starts = Some(starts.map(|(x, y)| Cell::new(x, y)).to_vec());
        let setup = Setup::new(&MDFS, RuleName::Published, 2, layout.clone(), base);
        !run(&Setup { starts, ..setup }).violations.is_empty()
    };
    let places = [(0, 0), (1, 0), (1, 1), (0, 2), (1, 2)];
    assert!(places.iter().any(|&one| places.iter().any(|&other| ends_early([one, other]))));
}

/// The rules of agents that search in trees until they know that they are done.
const TREES: [(&Profile, RuleId); 4] = [
    (&BRICKS, RuleId::new("tree")),
    (&HELPERS, RuleId::new("trusting")),
    (&HELPERS, RuleId::REPAIRED),
    (&HELPERS, RuleId::new("doubting")),
];

#[test]
fn agents_in_parts_that_are_not_connected_each_visit_their_own() {
    let mut layout = Layout::open(7, 3).expect("a layout");
    (0..3).for_each(|y| layout.block(Cell::new(3, y)));
    layout.block(Cell::new(1, 1));
    let base = Setup::choose_base(&mut layout, None).expect("a free cell");
    let starts = [(0, 0), (6, 2), (2, 1), (4, 0)].map(|(x, y)| Cell::new(x, y)).to_vec();
    for (scheme, rule) in TREES {
        let setup = Setup::new(scheme, rule, 4, layout.clone(), base);
        let report = run(&Setup { starts: Some(starts.clone()), ..setup });
        assert_eq!(report.violations, [], "{} {rule}", scheme.name);
        let parts: Vec<_> =
            report.components.iter().map(|part| (part.cells, part.visited, part.active)).collect();
        assert_eq!(parts, [(8, 8, 0), (9, 9, 0)], "{} {rule}", scheme.name);
    }
}

#[test]
fn more_agents_than_an_id_counts_are_refused() {
    let layout = Layout::open(3, 3).expect("a layout");
    let base = layout.default_base().expect("a free cell");
    for (scheme, rule) in TREES.into_iter().chain([(&MDFS, RuleId::PUBLISHED)]) {
        let said = |robots| {
            let setup = Setup::new(scheme, rule, robots, layout.clone(), base);
            team(&setup).err().map(|fault| format!("{fault:?}"))
        };
        assert_eq!(said(255), None);
        assert!(said(256).is_some_and(|said| said.contains("256 agents are too many")), "{}", scheme.name);
    }
}

#[test]
fn no_layout_has_more_cells_than_there_are_labels_or_depths() {
    assert_eq!(MAX_CELLS, u64::from(Label::TREES));
    assert!(Size::new(4096, 4096).is_ok() && Size::new(4096, 4097).is_err());
}

fn hunted(scheme: &'static Profile, rule: RuleId, (robots, max_misses): (u64, u8), side: u64) -> HuntReport {
    let bounds = HuntBounds {
        robots: Some(robots),
        size: Some(Size::new(side, side).expect("a size")),
        max_misses: Some(max_misses),
        ..HuntBounds::default()
    };
    let asked = HuntRequest { bounds, ..HuntRequest::new(scheme, rule) };
    let rule = scheme.rules.iter().find(|row| row.name == rule).expect("a rule");
    rule.hunt.expect("a hunt").hunt(&asked, &mut NoWatcher).expect("it can be searched")
}

#[test]
fn hunts_of_trees_find_the_smallest_early_end_and_it_is_a_run() {
    for (scheme, rule, bound, title) in [
        (&MDFS, RuleId::PUBLISHED, (2, 0), "0 missed, 2x3 cells, 3 team moves"),
        (&BRICKS, RuleId::new("tree"), (1, 1), "1 missed, 3x3 cells, 5 team moves"),
    ] {
        let hunted = hunted(scheme, rule, bound, 3);
        let [finding] = &hunted.found[..] else { panic!("{hunted:?}") };
        let found = (finding.title.as_str(), &finding.shown);
        assert_eq!(found, (title, &Exhibit::Run(PREMATURE)), "{}", scheme.name);
        let report = run(&finding.setup);
        assert!(report.violations.iter().any(|violation| violation.clause == PREMATURE), "{report:?}");
    }
    let careful = hunted(&HELPERS, RuleId::REPAIRED, (1, 1), 3);
    assert_eq!(careful.looked_for, ["BRICKS-4", "BRICKS-5"]);
    assert!(careful.is_complete && careful.found.is_empty(), "{careful:?}");
}

#[test]
fn published_maps_are_visited_if_they_are_there() {
    let Some(folder) = env::var_os("TAUTLINE_MAPS") else { return };
    let files = fs::read_dir(folder).expect("a folder").map(|file| file.expect("a file").path());
    let maps: BTreeSet<_> = files.filter(|path| path.extension().is_some_and(|end| end == "map")).collect();
    thread::scope(|scope| {
        for path in maps {
            scope.spawn(move || {
                let name = path.display().to_string();
                let layout = layout::load(&name, 0, None::<&Path>).expect("a map");
                is_visited(&name, &layout, largest_part(&layout));
            });
        }
    });
}

#[test]
fn of_turns_that_can_go_on_for_ever_only_those_are_drawn() {
    let cells = [(0, 0), (1, 0), (2, 0), (0, 1)].map(|(x, y)| Cell::new(x, y));
    let scene = |agents: [usize; 2]| Scene {
        cells: agents.map(|agent| cells[agent]).to_vec(),
        marks: cells
            .into_iter()
            .zip([Mark::Explored, Mark::Explored, Mark::Unexplored, Mark::Visited])
            .collect(),
    };
    let turn = |agents, agent, side| Turn {
        before: scene(agents),
        agent,
        step: Step::Cross(side),
        is_done: false,
        unseen: vec![],
    };
    let course = Course {
        width: 3,
        height: 2,
        blocked: vec![Cell::new(1, 1), Cell::new(2, 1)],
        walls: vec![Edge::new(cells[1], Side::East)],
        turns: vec![
            turn([3, 0], 0, Side::North),
            Turn { unseen: vec![cells[3]], ..turn([0, 0], 1, Side::East) },
            turn([0, 1], 1, Side::West),
        ],
        round: 2,
        end: scene([0, 0]),
    };
    let drawn = story::of_course(&course).expect("a layout");
    assert_snapshot!(drawn, @"
    1, 2, … are the agents, K× stands for K of them in one cell; · is explored, : explored and entered by nobody any \
    more, ░░░ visited, ▒▒▒ sealed, ## blocked; ? is a sensor that an agent missed.

      In turn 2 agent 2 misses the sensor of 0,1.
      The last 2 of 3 turns can go on for ever.

    before turn 2      before turn 3      the end
    +----+----+----+   +---+---+---+      +---+---+---+
    |1·2→  ·  |    |   |1·  2← |   |      |12   · |   |
    +    +    +    +   +   +   +   +      +   +   +   +
    |░?░  #### ####|   |░░░ ### ###|      |░░░ ### ###|
    +----+----+----+   +---+---+---+      +---+---+---+
    ");
}

#[test]
fn what_agents_leave_unexplored_or_unvisited_for_ever_is_judged() {
    let (mut judged, mut several) = (BTreeSet::new(), 0);
    for seed in 0..60 {
        let mut layout = generated(["walls:7x5:0.2", "cells:5x4:0.2"][seed as usize % 2], seed);
        let base = Setup::choose_base(&mut layout, None).expect("a base");
        let robots = 1 + seed as u16 % 3;
        let setup = Setup::new(&BRICKS, RuleId::PUBLISHED, robots, layout, base);
        let mut frames = Vec::new();
        let report = explore(&setup, &mut |made| {
            frames.push(made.frame.clone());
            Ok(())
        });
        for broken in report.expect("a run").violations {
            let clause = broken.clause;
            assert!((setup.scheme.case)(&setup, clause, &[]).is_some(), "its team moves are kept: {setup:?}");
            let Some(case) = (setup.scheme.case)(&setup, clause, &frames) else {
                assert_eq!(clause, PREMATURE, "{setup:?}");
                continue;
            };
            assert_eq!(case.judge(), Ok(()), "{clause}: {setup:?}");
            judged.insert(clause.as_str());
            several += usize::from(robots > 1);
        }
    }
    assert!(
        judged.contains("BRICKS-5") && judged.contains("BRICKS-6") && several > 0,
        "{judged:?}, {several}"
    );
}
