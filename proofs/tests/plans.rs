//! The cost of plans: how many team moves a chain makes in the same random layouts, and at how many candidates of
//! followers its plans look. Both are numbers of the rule and not of the machine.

use std::fmt::Write;

use insta::assert_snapshot;
use tautline_kernel::chain::{Budget, Chain, Intent, Rule};
use tautline_kernel::ground::{Area, Cell, Edge, MediumGrid, Side};

/// Numbers below 100 that a linear congruence makes of the ones before.
fn drawn(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 32) % 100
}

/// Columns and rows of a layout, and its base in the middle.
const SIDE: i16 = 18;
const BASE: Cell = Cell::new(SIDE / 2, SIDE / 2);

/// Sides that are walls, each with this probability in percent.
fn walls(mut seed: u64, percent: u64) -> Vec<bool> {
    (0..2 * SIDE * SIDE).map(|_| drawn(&mut seed) < percent).collect()
}

/// The cost of a run.
#[derive(Default)]
struct Cost {
    moves: u32,
    looks: u64,
    /// Plans that used up their budget.
    cut_short: u32,
    /// The worst plan.
    most: u32,
}

fn run<const ROBOTS: usize>(rule: Rule, walls: &[bool], cost: &mut Cost) {
    let area = Area::new(Cell::new(0, 0), Cell::new(SIDE - 1, SIDE - 1)).expect("cells");
    let area = area.around(BASE, ROBOTS as u16 - 1).expect("the base is in it");
    let grid = MediumGrid::new(area).expect("it fits");
    let mut chain = Chain::<_, ROBOTS>::new(rule, ROBOTS, BASE, grid).expect("a chain");
    let is_open = |edge: Edge| {
        let Cell { x, y } = edge.cell();
        !walls[(2 * (SIDE * y + x) + i16::from(edge.side() == Side::East)) as usize]
    };
    let mut log = Vec::new();
    for _ in 0..250 {
        let intent = chain.plan(&log).expect("its own log");
        cost.looks += u64::from(chain.looked_at());
        cost.most = cost.most.max(chain.looked_at());
        cost.cut_short += u32::from(chain.is_cut_short());
        let Intent::Go(plan) = intent else { break };
        log.extend_from_slice(chain.settle(&plan, is_open).messages());
        cost.moves += 1;
    }
}

fn line<const ROBOTS: usize>(name: &str, rule: Rule) -> String {
    let mut line = format!("{name:<12}{ROBOTS:>7}");
    for percent in [5, 15, 25] {
        let mut cost = Cost::default();
        for seed in 0..3 {
            run::<ROBOTS>(rule, &walls(seed, percent), &mut cost);
        }
        let Cost { moves, looks, cut_short, most } = cost;
        write!(line, "  | {moves:>4} {looks:>6} {most:>5} {cut_short:>3}").expect("text");
    }
    line
}

#[test]
fn plans_cost_what_they_have_cost() {
    let budget = |looks, rule| Rule { budget: Budget::LooksPerRobot(looks), ..rule };
    let mut table = format!("{:<12} robots  {:^24}{:^26}{:^26}\n", "rule", "5 % walls", "15 %", "25 %");
    writeln!(table, "{:>19}{}", "", "  | moves looks most cut".repeat(3)).expect("text");
    for (name, rule) in [
        ("published", budget(500, Rule::PUBLISHED)),
        ("repaired", Rule::REPAIRED),
        ("5 looks", budget(5, Rule::REPAIRED)),
        ("12 looks", budget(12, Rule::REPAIRED)),
        ("reel", Rule::REEL),
        ("reel 9 looks", budget(9, Rule::REEL)),
    ] {
        for line in [line::<2>, line::<4>, line::<7>, line::<13>, line::<70>] {
            writeln!(table, "{}", line(name, rule)).expect("text");
        }
    }
    assert_snapshot!(table);
}
