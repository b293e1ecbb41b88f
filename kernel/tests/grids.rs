//! Grids of every size compared with a breadth-first search, cell by cell: distances, who is approached first, and what
//! is asked of a cell outside the area.

use std::collections::{BTreeMap, VecDeque};
use std::ops::ControlFlow;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{
    Area, Avoid, Cell, CellMark, CompactGrid, Edge, EdgeMark, Grid, LargeGrid, MediumGrid, Side, SmallGrid,
    Step, Steps, TinyGrid,
};

use crate::numbers::Congruence;

const SIDES: Steps = Steps::ALL.without(Step::Stay);

/// The steps on the shortest path to each cell from one of `sources`.
fn flooded(grid: &impl Grid, sources: impl Iterator<Item = Cell>, avoid: Avoid) -> BTreeMap<Cell, u32> {
    let mut reached: BTreeMap<Cell, u32> = sources.map(|cell| (cell, 0)).collect();
    let mut left: VecDeque<Cell> = reached.keys().copied().collect();
    while let Some(cell) = left.pop_front() {
        let next = reached[&cell] + 1;
        for side in Side::ALL {
            let (edge, beyond) = (Edge::new(cell, side), cell.beyond(side));
            let is_shut = grid.edge_has(EdgeMark::Wall, edge)
                || avoid == Avoid::WallsAndVirtual && grid.edge_has(EdgeMark::Virtual, edge);
            if !is_shut && !reached.contains_key(&beyond) {
                reached.insert(beyond, next);
                left.push_back(beyond);
            }
        }
    }
    reached
}

/// A random area of at most so many columns and rows.
fn area(drawn: &mut Congruence, columns: i16, rows: i16) -> Area {
    let mut below = |most: i16| 1 + drawn.pick(most as u32) as i16;
    let (width, height) = (below(columns), below(rows));
    let first = Cell::new(below(9) - 5, below(9) - 5);
    Area::new(first, Cell::new(first.x + width - 1, first.y + height - 1)).expect("cells")
}

/// Walls and virtual obstacles by chance, and few or many cells left to explore.
fn fill(drawn: &mut Congruence, grid: &mut impl Grid) {
    let (walls, obstacles, explored) = (drawn.pick(45), drawn.pick(20), drawn.pick(2));
    for edge in grid.area().edges() {
        if drawn.pick(100) < walls {
            grid.put_edge(EdgeMark::Wall, edge);
        } else if drawn.pick(100) < obstacles {
            grid.put_edge(EdgeMark::Virtual, edge);
        }
    }
    let few = if explored == 0 { 0 } else { 10 };
    for cell in grid.area().cells() {
        if drawn.pick(200) >= few {
            grid.put(CellMark::Explored, cell);
        }
    }
    let cell = pick(drawn, grid.area());
    grid.take(CellMark::Explored, cell);
}

fn pick(drawn: &mut Congruence, area: Area) -> Cell {
    let (x, y) = (drawn.pick(area.width() as u32), drawn.pick(area.height() as u32));
    Cell::new(area.first().x + x as i16, area.first().y + y as i16)
}

/// Asserts that `grid` and a search agree about the cell `at`.
fn agrees<G: Grid>(grid: &mut G, at: Cell) {
    let area = grid.area();
    let leaves = |step: Step| !area.contains(at.after(step));
    for mark in [EdgeMark::Wall, EdgeMark::Open, EdgeMark::Virtual] {
        let sides = Side::ALL.into_iter().filter(|&side| grid.edge_has(mark, Edge::new(at, side)));
        let sides = sides.fold(Steps::NONE, |all, side| all.with(Step::Cross(side)));
        assert_eq!(grid.sides(mark, at), sides, "{mark:?} beside {at} of {area:?}");
    }
    let unexplored: Vec<Cell> = area.cells().filter(|&cell| !grid.has(CellMark::Explored, cell)).collect();
    for avoid in [Avoid::Walls, Avoid::WallsAndVirtual] {
        let reached = flooded(grid, unexplored.iter().copied(), avoid);
        let expected = Step::ALL.map(|step| reached.get(&at.after(step)).copied());
        let distances = Step::ALL.map(|step| grid.distance(at.after(step), avoid));
        assert_eq!(distances, expected, "{avoid:?} from {at} of {area:?}");
        let mut told = Vec::new();
        grid.approach(at, Steps::ALL, avoid, |nearest| {
            told.push(nearest);
            ControlFlow::Continue(())
        });
        let mut lengths: Vec<u32> = expected.iter().copied().flatten().collect();
        lengths.sort_unstable();
        lengths.dedup();
        let of_length = |length| Steps::ALL.filter(|step| expected[step.place()] == Some(length));
        assert_eq!(told, lengths.into_iter().map(of_length).collect::<Vec<_>>(), "{at} of {area:?}");
    }
    if !area.contains(at) {
        return;
    }
    let from_here = flooded(grid, [at].into_iter(), Avoid::Walls);
    let mut near: Vec<(u32, Cell)> =
        unexplored.iter().filter_map(|cell| Some((*from_here.get(cell)?, *cell))).collect();
    near.sort_unstable_by_key(|&(distance, cell)| (distance, cell.y, cell.x));
    for most in [0, 1, 7, 30, u32::from(u16::MAX)] {
        let mut found = Vec::new();
        while let Some(next) = grid.next_unexplored(at, found.last().copied(), most) {
            found.push(next);
        }
        let within: Vec<_> = near.iter().copied().filter(|&(distance, _)| distance <= most).collect();
        assert_eq!(found, within, "from {at} of {area:?}");
        let bearings = grid.bearings(at, most);
        for cell in area.cells() {
            let own = from_here.get(&cell).copied().filter(|&own| own <= most);
            let open =
                SIDES.minus(grid.sides(EdgeMark::Wall, cell)).filter(|step| !leaves(step) || at != cell);
            let nearer = open.filter(|step| {
                own.is_some_and(|own| own > 0 && from_here.get(&cell.after(step)) == Some(&(own - 1)))
            });
            assert_eq!(grid.nearer(&bearings, cell), nearer, "from {cell} to {at}, at most {most}");
        }
    }
}

/// `rounds` random grids of at most so many columns and rows, each asked of some cells inside and of all just outside
/// it.
fn agree<G: Grid>(columns: i16, rows: i16, rounds: u32, new: impl Fn(Area) -> Option<G>) {
    let mut drawn = Congruence(11);
    for _ in 0..rounds {
        let area = area(&mut drawn, columns, rows);
        let mut grid = new(area).expect("it fits");
        fill(&mut drawn, &mut grid);
        for _ in 0..3 {
            agrees(&mut grid, pick(&mut drawn, area));
        }
        let (first, last, inside) = (area.first(), area.last(), pick(&mut drawn, area));
        for outside in [
            Cell::new(first.x - 1, inside.y),
            Cell::new(last.x + 1, inside.y),
            Cell::new(inside.x, first.y - 1),
            Cell::new(inside.x, last.y + 1),
            Cell::new(first.x - 1, first.y - 1),
        ] {
            agrees(&mut grid, outside);
        }
    }
}

#[test]
fn grids_of_every_size_know_distances() {
    agree(8, 8, 60, TinyGrid::new);
    agree(11, 11, 40, CompactGrid::new);
    agree(16, 16, 30, SmallGrid::new);
    agree(64, 64, 8, MediumGrid::new);
    agree(128, 128, 2, LargeGrid::new);
}
