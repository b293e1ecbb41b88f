//! Traps of the published rule: layouts and starts from which two robots that are answered at once can come to where
//! they never cover everything any more, whatever happens.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;
use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, Side, TinyGrid};
use tautline_kernel::kit::{Answers as Answering, Rule};

use super::symmetry::{Image, stripped};
use super::world::{Answers, Setting, Speeds, World};

/// The robots' goal: the paths to cover.
#[derive(Clone, Copy, Debug)]
enum Goal {
    Nodes,
    Sides,
}

/// A lattice with given walls, and the number of the node where both robots start.
type Case = (u64, usize);

/// Each layout with at most three walls with each start, once for all its images, and how many there are.
fn cases(setting: &Setting<2>) -> BTreeMap<Case, u32> {
    let area = setting.area;
    let nodes: Vec<Cell> = area.cells().collect();
    let images = Image::all(area);
    let mut cases = BTreeMap::new();
    for walls in (0_u64..1 << area.edges().count()).filter(|walls| walls.count_ones() <= 3) {
        for &start in &nodes {
            let image_of = |image: &Image| {
                let node = image.node(area, start);
                (image.set(walls), nodes.iter().position(|&other| other == node).unwrap_or_default())
            };
            let first = images.iter().map(image_of).min().expect("an image");
            *cases.entry(first).or_default() += 1;
        }
    }
    cases
}

/// The open edges within reach of `start`.
fn due(setting: &Setting<2>, given: &TinyGrid, start: Cell) -> Vec<Edge> {
    let mut reached = vec![start];
    let mut due = Vec::new();
    let mut place = 0;
    while let Some(&node) = reached.get(place) {
        for side in Side::ALL {
            let edge = Edge::new(node, side);
            if setting.area.contains(node.beyond(side)) && !given.edge_has(EdgeMark::Wall, edge) {
                if !due.contains(&edge) {
                    due.push(edge);
                }
                if !reached.contains(&node.beyond(side)) {
                    reached.push(node.beyond(side));
                }
            }
        }
        place += 1;
    }
    due
}

/// The fates of a start: a run to where everything is never covered any more; one to where nobody ever moves any more;
/// one to where everything is never covered any more, and somebody always moves; and that no run covers everything.
const FATES: [&str; 4] = ["can be trapped", "can be stuck", "can go round", "always are"];

/// The numbers from which those that are marked can be reached.
fn reaching(marked: Vec<usize>, before: &[Vec<usize>]) -> Vec<bool> {
    let (mut left, mut reaches) = (marked, vec![false; before.len()]);
    while let Some(number) = left.pop() {
        if !std::mem::replace(&mut reaches[number], true) {
            left.extend(&before[number]);
        }
    }
    reaches
}

fn fate(setting: &Setting<2>, start: Cell, goal: Goal) -> [bool; FATES.len()] {
    let given = setting.given.expect("its walls are given");
    let due = due(setting, &given, start);
    let is_driven = |world: &World<2>, edge: &Edge| {
        world.team.records().iter().any(|record| record.edge_has(EdgeMark::Open, *edge))
    };
    let is_goal = |world: &World<2>| match goal {
        Goal::Sides => due.iter().all(|edge| is_driven(world, edge)),
        Goal::Nodes => {
            let ends = |edge: &Edge| [edge.cell(), edge.cell().beyond(edge.side())];
            due.iter().flat_map(ends).all(|node| {
                node == start || due.iter().any(|edge| ends(edge).contains(&node) && is_driven(world, edge))
            })
        }
    };
    let without = |world: World<2>| World { team: stripped(world.team), ..world };
    let mut worlds = vec![without(setting.start([start; 2]).expect("a start"))];
    let mut known: FxHashMap<World<2>, usize> = FxHashMap::from_iter([(worlds[0], 0)]);
    let mut before: Vec<Vec<usize>> = vec![Vec::new()];
    let (mut done, mut stuck) = (Vec::new(), Vec::new());
    let mut place = 0;
    while let Some(world) = worlds.get(place).copied() {
        let turns = if is_goal(&world) { Vec::new() } else { setting.turns(&world) };
        match (is_goal(&world), turns.is_empty()) {
            (true, _) => done.push(place),
            (false, true) => stuck.push(place),
            (false, false) => {}
        }
        for turned in turns {
            let after = without(turned.world);
            let number = *known.entry(after).or_insert_with(|| {
                worlds.push(after);
                before.push(Vec::new());
                worlds.len() - 1
            });
            before[number].push(place);
        }
        place += 1;
    }
    let is_stuck = !stuck.is_empty();
    let (done, stuck) = (reaching(done, &before), reaching(stuck, &before));
    let goes_round = done.iter().zip(&stuck).any(|(done, stuck)| !done && !stuck);
    [done.contains(&false), is_stuck, goes_round, !done[0]]
}

#[test]
#[ignore = "takes minutes: cargo test --release -p tautline-proofs -- --ignored \
            --nocapture published_robots_are_trapped"]
fn published_robots_are_trapped_in_some_layouts() {
    let setting = Setting::<2>::new(Rule::PUBLISHED, (3, 3)).expect("a lattice");
    let cases = cases(&setting);
    assert_eq!(cases.values().sum::<u32>(), 2691);
    for (answers, speeds, goal) in [
        (Answers::AtOnce, Speeds::Equal, Goal::Nodes),
        (Answers::AtOnce, Speeds::Equal, Goal::Sides),
        (Answers::AtOnce, Speeds::Any, Goal::Nodes),
        (Answers::TrueNews, Speeds::Any, Goal::Nodes),
    ] {
        let answering = if answers == Answers::TrueNews { Answering::Always } else { Answering::Driving };
        let rule = Rule { answers: answering, ..setting.rule };
        // By the number of walls.
        let mut counts = [[0; 4]; 4];
        for (&(walls, start), &count) in &cases {
            let mut given = TinyGrid::new(setting.area).expect("a map");
            let edges = setting.area.edges().enumerate().filter(|(number, _)| walls >> number & 1 == 1);
            edges.for_each(|(_, edge)| given.put_edge(EdgeMark::Wall, edge));
            let start = setting.area.cells().nth(start).expect("a node");
            let fate = fate(&Setting { rule, speeds, answers, given: Some(given), ..setting }, start, goal);
            for (number, _) in fate.iter().enumerate().filter(|&(_, &is)| is) {
                counts[number][walls.count_ones() as usize] += count;
            }
        }
        for (what, counts) in FATES.iter().zip(counts) {
            println!(
                "{answers:?}, {speeds:?}, {goal:?}: {} {what}, by walls {counts:?}",
                counts.iter().sum::<u32>()
            );
        }
    }
}

#[test]
fn robots_that_are_always_answered_may_go_round_for_ever_and_leave_a_node_out() {
    let rule = Rule { answers: Answering::Always, ..Rule::PUBLISHED };
    let open = Setting::<2>::new(rule, (3, 3)).expect("a lattice");
    let mut walls = TinyGrid::new(open.area).expect("a map");
    for (column, row, side) in [(0, 0, Side::South), (0, 1, Side::East), (1, 0, Side::South)] {
        walls.put_edge(EdgeMark::Wall, Edge::new(Cell::new(column, row), side));
    }
    let setting = Setting { answers: Answers::TrueNews, given: Some(walls), ..open };
    assert_eq!(fate(&setting, Cell::new(2, 2), Goal::Nodes), [true, false, true, false]);
}
