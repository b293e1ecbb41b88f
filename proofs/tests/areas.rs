//! The search over areas finds the smallest runs that break a clause of the chain: those that plain runs in every
//! layout find.

use std::ops::ControlFlow;

use tautline_kernel::chain::{Chain, Intent, Rule};
use tautline_kernel::ground::{Area, Cell, Edge, SmallGrid};
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::areas::{Areas, Findings, search};
use tautline_proofs::chain::invariant::Invariant;

/// Cells, walls and team moves.
type Size = (usize, usize, usize);

fn areas(observed: Subject, robots: usize, max_cells: u32, max_walls: u32) -> Areas {
    let invariants = Invariant::OF_RUNS.to_vec();
    Areas { observed, robots, max_cells, max_walls, budget_moves: None, invariants }
}

fn found(areas: &Areas) -> Findings {
    search(areas, &mut |_| ControlFlow::Continue(())).expect("so few robots fit")
}

/// The smallest run that breaks `invariant`, and the columns and rows of its area.
fn smallest(found: &Findings, invariant: Invariant) -> Option<([usize; 2], Size)> {
    let known = found.broken.iter().find(|known| known.found.broken == invariant)?;
    let (area, walls) = (known.bounds.area, known.bounds.run(&known.found).walls.len());
    let cells = area.width() * area.height();
    Some(([area.width(), area.height()], (cells, walls, known.found.frames.len())))
}

/// Whether a cell is wholly within r_cov = √26/2 cells of the middle of another.
fn is_covered(one: Cell, other: Cell) -> bool {
    let far = |one: i16, other: i16| (2 * i32::from(one.abs_diff(other)) + 1).pow(2);
    far(one.x, other.x) + far(one.y, other.y) <= 26
}

/// The first team moves after which contact is broken, and a cell other than the base is crowded, in a run of four
/// robots as published among `walls`.
fn broken_by(area: Area, base: Cell, walls: &[Edge]) -> [Option<usize>; 2] {
    let grid = SmallGrid::new(area).expect("it fits");
    let mut chain = Chain::<_, 4>::new(Rule::PUBLISHED, 4, base, grid).expect("a team");
    let (mut log, mut broken) = (Vec::new(), [None; 2]);
    for step in 1.. {
        let Intent::Go(plan) = chain.plan(&log).expect("a log of its own") else { break };
        log.extend_from_slice(chain.settle(&plan, |edge| !walls.contains(&edge)).messages());
        let cells = chain.cells();
        let is_apart = !cells.windows(2).all(|pair| is_covered(pair[0], pair[1]));
        let is_full = |cell: &&Cell| cells.iter().filter(|other| other == cell).count() > 2;
        let is_crowded = cells.iter().filter(|&&cell| cell != base).any(|cell| is_full(&cell));
        for (first, is_broken) in broken.iter_mut().zip([is_apart, is_crowded]) {
            if is_broken {
                first.get_or_insert(step);
            }
        }
    }
    broken
}

/// The smallest of plain runs in every layout with at most so many walls, from every base, in every area of so many
/// cells.
fn plainly(cells: i16, max_walls: u32) -> [Option<Size>; 2] {
    let mut least: [Option<Size>; 2] = [None; 2];
    for rows in (1..=cells).filter(|rows| cells % rows == 0) {
        let area = Area::new(Cell::new(0, 0), Cell::new(cells / rows - 1, rows - 1)).expect("an area");
        let edges: Vec<Edge> = area.edges().collect();
        for set in (0_u32..1 << edges.len()).filter(|set| set.count_ones() <= max_walls) {
            let is_wall = |place: &usize| set >> place & 1 == 1;
            let walls: Vec<Edge> = (0..edges.len()).filter(is_wall).map(|place| edges[place]).collect();
            for base in area.cells() {
                for (least, step) in least.iter_mut().zip(broken_by(area, base, &walls)) {
                    let new = step.map(|step| (cells as usize, walls.len(), step));
                    *least = [*least, new].into_iter().flatten().min();
                }
            }
        }
    }
    least
}

#[test]
fn the_smallest_areas_are_those_that_plain_runs_find() {
    let found = found(&areas(Subject::PUBLISHED, 4, 10, 13));
    let all: Vec<[Option<Size>; 2]> = (1..=9).map(|cells| plainly(cells, 12)).collect();
    assert_eq!(all[..8], [[None; 2]; 8]);
    assert_eq!(all[8], [Some((9, 4, 8)), None]);
    assert_eq!(plainly(10, 2)[1], Some((10, 2, 7)));
    assert_eq!(smallest(&found, Invariant::CONTACT), Some(([3, 3], (9, 4, 8))));
    assert_eq!(smallest(&found, Invariant::CROWDING), Some(([5, 2], (10, 2, 7))));
    assert_eq!((found.cells, found.is_complete), (Some(10), true));
}

#[test]
fn what_remains_is_broken_in_few_cells_too() {
    let least = |observed, robots, invariant| {
        let all = Areas { invariants: vec![invariant], ..areas(observed, robots, 9, 12) };
        smallest(&found(&all), invariant)
    };
    assert_eq!(least(Subject::REPAIRED, 3, Invariant::Exhausts), Some(([3, 3], (9, 3, 32))));
    assert_eq!(least(Subject::REPAIRED, 4, Invariant::AnyOrder), Some(([4, 2], (8, 1, 7))));
    assert_eq!(least(Subject::REEL, 4, Invariant::AnyOrder), None);
}

#[test]
fn a_clause_is_looked_for_in_runs_that_break_another_one_too() {
    let missed = Invariant::COMPLETENESS;
    let all = Areas { invariants: vec![missed, Invariant::Exhausts], ..areas(Subject::PUBLISHED, 3, 9, 12) };
    let found = found(&all);
    // One run breaks both.
    for invariant in all.invariants {
        assert_eq!(smallest(&found, invariant), Some(([3, 3], (9, 2, 26))), "{invariant:?}");
    }
}

#[test]
fn a_search_over_areas_that_is_ended_says_up_to_how_many_cells_it_came() {
    let all = areas(Subject::PUBLISHED, 4, 10, 13);
    let whole = found(&all);
    let ended = found(&Areas { budget_moves: Some(whole.moves() / 2), ..all });
    assert!(!ended.is_complete && ended.moves() < whole.moves(), "{ended:?}");
    assert_eq!(ended.cells, Some(9));
    let covered = |area: &&_| whole.searched.contains(area);
    assert_eq!(ended.searched.iter().filter(covered).count(), ended.searched.len() - 1);
    let stopped = search(&areas(Subject::PUBLISHED, 4, 10, 13), &mut |found| match found.cells {
        Some(7) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    assert_eq!(stopped.expect("so few robots fit").cells, Some(7));
}
