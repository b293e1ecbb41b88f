//! The homes of the grid, from one machine word to the heap, give the same answers, whatever is asked of them, and
//! lead a chain the same way.

use proptest::prelude::*;
use tautline_grids::heap_grid::HeapGrid;
use tautline_kernel::chain::{Chain, End, Intent, Rule};
use tautline_kernel::ground::{
    Area, Avoid, BitGrid, Cell, CellMark, CompactGrid, Edge, EdgeMark, Grid, LargeGrid, MediumGrid, Plane,
    Side, SmallGrid, Step, TinyGrid,
};

const CELL_MARKS: [CellMark; 4] = [CellMark::Explored, CellMark::Occupied, CellMark::Full, CellMark::Planned];
const EDGE_MARKS: [EdgeMark; 3] = [EdgeMark::Wall, EdgeMark::Open, EdgeMark::Virtual];
const AVOIDS: [Avoid; 2] = [Avoid::Walls, Avoid::WallsAndVirtual];

/// One call that changes a grid, or asks for a distance.
#[derive(Clone, Copy, Debug)]
enum Call {
    Put(CellMark, Cell),
    Take(CellMark, Cell),
    PutEdge(EdgeMark, Edge),
    ClearEdges(EdgeMark),
    Distance(Cell, Avoid),
    Stops(Cell, usize),
    Nearer { to: Cell, most: u32, at: Cell },
}

/// Distances of a cell and of its neighbours, east, south, west, north, as far as they were asked for.
type Answer = [Option<u32>; Step::ALL.len()];

/// All marks, all distances, and some walks.
type Everything = (Vec<bool>, Vec<Answer>, Vec<Option<Vec<Cell>>>);

impl Call {
    /// Makes the call; the answer, if it has one.
    fn make(self, grid: &mut impl Grid) -> Option<u32> {
        match self {
            Self::Put(mark, cell) => grid.put(mark, cell),
            Self::Take(mark, cell) => grid.take(mark, cell),
            Self::PutEdge(mark, edge) => grid.put_edge(mark, edge),
            Self::ClearEdges(mark) => grid.clear_edges(mark),
            Self::Distance(cell, avoid) => return grid.distance(cell, avoid),
            Self::Nearer { to, most, at } => {
                let bearings = grid.bearings(to, most);
                return Some(grid.nearer(&bearings, at).iter().map(|step| 1 << step.place()).sum());
            }
            Self::Stops(cell, most) => return stops(grid, cell, most).map(|stops| stops.len() as u32),
        }
        None
    }
}

fn rectangle(first: Cell, width: i16, height: i16) -> Area {
    Area::new(first, Cell::new(first.x + width - 1, first.y + height - 1)).expect("an area")
}

/// The area of a chain of `robots`, and its base in the middle.
fn open_area(robots: i16) -> (Area, Cell) {
    (rectangle(Cell::new(0, 0), 2 * robots - 1, 2 * robots - 1), Cell::new(robots - 1, robots - 1))
}

fn areas() -> impl Strategy<Value = Area> {
    let first = (-70..70_i16, -70..70_i16).prop_map(Cell::from);
    let sides = prop_oneof![9 => (1..14_i16, 1..14_i16), 1 => (1..=64_i16, 1..=64_i16)];
    (first, sides).prop_map(|(first, (width, height))| rectangle(first, width, height))
}

/// Cells of the area, and two rows and columns beyond.
fn cells(area: Area) -> impl Strategy<Value = Cell> + Clone {
    let (first, last) = (area.first(), area.last());
    (first.x - 2..=last.x + 2, first.y - 2..=last.y + 2).prop_map(Cell::from)
}

fn edges(area: Area) -> impl Strategy<Value = Edge> + Clone {
    let side = proptest::sample::select(Side::ALL.to_vec());
    (cells(area), side).prop_map(|(cell, side)| Edge::new(cell, side))
}

/// Calls as a chain makes them, many distances among them, and seldom what no chain does.
fn calls(area: Area) -> impl Strategy<Value = Vec<Call>> {
    let cell_mark = proptest::sample::select(CELL_MARKS.to_vec());
    let edge_mark = proptest::sample::select(EDGE_MARKS.to_vec());
    let avoid = proptest::sample::select(AVOIDS.to_vec());
    let call = prop_oneof![
        40 => (cells(area), avoid).prop_map(|(cell, avoid)| Call::Distance(cell, avoid)),
        5 => (cells(area), 0..9_usize).prop_map(|(cell, most)| Call::Stops(cell, most)),
        10 => Just(Call::Stops(area.first(), 200)),
        20 => cells(area).prop_map(move |at| Call::Nearer { to: area.first(), most: 200, at }),
        5 => (cells(area), 0..12_u32, cells(area)).prop_map(|(to, most, at)| Call::Nearer { to, most, at }),
        10 => cells(area).prop_map(|cell| Call::Put(CellMark::Explored, cell)),
        20 => (edge_mark, edges(area)).prop_map(|(mark, edge)| Call::PutEdge(mark, edge)),
        5 => (cell_mark.clone(), cells(area)).prop_map(|(mark, cell)| Call::Put(mark, cell)),
        1 => (cell_mark, cells(area)).prop_map(|(mark, cell)| Call::Take(mark, cell)),
        1 => Just(Call::ClearEdges(EdgeMark::Virtual)),
        1 => Just(Call::ClearEdges(EdgeMark::Open)),
        1 => Just(Call::ClearEdges(EdgeMark::Wall)),
    ];
    proptest::collection::vec(call, 1..400)
}

/// An area, what is known of it at first, mostly explored and with many walls, and calls.
fn histories() -> impl Strategy<Value = (Area, Vec<Call>)> {
    let shares = (0.7..1.0_f64, 0.0..0.5_f64);
    (areas(), shares, any::<u64>()).prop_flat_map(|(area, (explored, walls), seed)| {
        let mut chance = chances(seed);
        let mut known: Vec<Call> = area
            .cells()
            .filter(|_| chance(explored))
            .map(|cell| Call::Put(CellMark::Explored, cell))
            .collect();
        known.extend(area.edges().filter(|_| chance(walls)).map(|edge| Call::PutEdge(EdgeMark::Wall, edge)));
        calls(area).prop_map(move |calls| (area, [known.clone(), calls].concat()))
    })
}

/// Says yes with the probability asked for; the same answers for the same seed.
fn chances(seed: u64) -> impl FnMut(f64) -> bool {
    let mut state = seed | 1;
    move |probability| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        f64::from((state >> 40) as u32) < probability * f64::from(1 << 24)
    }
}

/// The log of a whole run, or of its first moves, and how it ended.
fn run<G: Grid>(
    rule: Rule,
    robots: usize,
    base: Cell,
    grid: G,
    is_open: impl Fn(Edge) -> bool,
) -> (Vec<u8>, Option<End>) {
    const MOST_MOVES: usize = 2_000;
    let mut chain = Chain::<G, 64>::new(rule, robots, base, grid).expect("a chain");
    let mut log = Vec::new();
    for _ in 0..MOST_MOVES {
        match chain.plan(&log).expect("an undamaged log") {
            Intent::Go(plan) => log.extend_from_slice(chain.settle(&plan, &is_open).messages()),
            Intent::Done(end) => return (log, Some(end)),
        }
    }
    (log, None)
}

/// All that can be asked of `grid` in a second, of its area and two rows and columns around it.
fn everything(grid: &mut impl Grid) -> Everything {
    let area = grid.area();
    let around = rectangle(
        Cell::new(area.first().x - 2, area.first().y - 2),
        area.width() as i16 + 4,
        area.height() as i16 + 4,
    );
    let mut marks = vec![grid.is_explored()];
    marks.extend(around.cells().flat_map(|cell| CELL_MARKS.map(|mark| grid.has(mark, cell))));
    marks.extend(around.edges().flat_map(|edge| EDGE_MARKS.map(|mark| grid.edge_has(mark, edge))));
    let questions = around.cells().flat_map(|cell| AVOIDS.map(|avoid| (cell, avoid)));
    let distances =
        questions.map(|(cell, avoid)| Step::ALL.map(|step| grid.distance(cell.after(step), avoid))).collect();
    let starts = around.cells().step_by(1 + around.width() * around.height() / 12);
    let walks = starts.flat_map(|cell| [0, 1, 4, 200].map(|most| stops(grid, cell, most))).collect();
    (marks, distances, walks)
}

/// The stops of the walk from `from` to an unexplored cell at most `most` links away.
fn stops(grid: &mut impl Grid, from: Cell, most: usize) -> Option<Vec<Cell>> {
    let mut stops = vec![Cell::new(i16::MIN, i16::MIN); most + 1];
    let links = grid.stops(from, &mut stops)?;
    stops.truncate(links + 1);
    Some(stops)
}

/// The stops of a way, found by asking of every two cells whether they are one link apart.
fn plain_stops(grid: &impl Grid, from: Cell, most: usize) -> Option<Vec<Cell>> {
    const AROUND: [(i16, i16); 8] = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];
    let is_open = |one: Cell, other: Cell| {
        let side = Side::ALL.into_iter().find(|&side| one.beyond(side) == other);
        side.is_some_and(|side| !grid.edge_has(EdgeMark::Wall, Edge::new(one, side)))
    };
    let is_link = |one: Cell, other: Cell| {
        let corners = [Cell::new(one.x, other.y), Cell::new(other.x, one.y)];
        is_open(one, other)
            || corners.into_iter().any(|corner| is_open(one, corner) && is_open(corner, other))
    };
    let linked = |cell: Cell| {
        let around = AROUND.map(|(dx, dy)| Cell::new(cell.x + dx, cell.y + dy));
        around.into_iter().filter(move |&other| is_link(cell, other))
    };
    let mut layers = vec![vec![from]];
    grid.area().locate(from)?;
    let mut target = None;
    while target.is_none() {
        let nearest = layers.last()?;
        target =
            grid.area().cells().find(|cell| nearest.contains(cell) && !grid.has(CellMark::Explored, *cell));
        let mut next: Vec<Cell> = nearest.iter().flat_map(|&cell| linked(cell)).collect();
        next.retain(|cell| !layers.iter().any(|layer| layer.contains(cell)));
        next.sort_unstable();
        next.dedup();
        if target.is_none() && (next.is_empty() || layers.len() > most) {
            return None;
        }
        layers.push(next);
    }
    let mut stops = vec![target?];
    for nearer in layers.iter().rev().skip(2) {
        stops.push(linked(stops[stops.len() - 1]).find(|cell| nearer.contains(cell))?);
    }
    stops.reverse();
    Some(stops)
}

/// The answers of a grid with planes `P`, if it holds `area`.
fn answers<P: Plane>(area: Area, calls: &[Call]) -> Option<(Vec<Option<u32>>, Everything)> {
    let mut grid = BitGrid::<P>::new(area)?;
    let heard = calls.iter().map(|call| call.make(&mut grid)).collect();
    Some((heard, everything(&mut grid)))
}

proptest! {
    #[test]
    fn all_homes_give_the_same_answers((area, calls) in histories()) {
        let mut wide = HeapGrid::new(area);
        let heard: Vec<_> = calls.iter().map(|call| call.make(&mut wide)).collect();
        prop_assert_eq!(wide.area(), area);
        let ours = (heard, everything(&mut wide));
        let most = area.width().max(area.height());
        let theirs = [
            (8, answers::<u64>(area, &calls)),
            (11, answers::<u128>(area, &calls)),
            (16, answers::<[u16; 16]>(area, &calls)),
            (32, answers::<[u32; 32]>(area, &calls)),
            (64, answers::<[u64; 64]>(area, &calls)),
            (128, answers::<[u128; 128]>(area, &calls)),
        ];
        for (side, theirs) in theirs {
            prop_assert_eq!(theirs.is_some(), most <= side);
            prop_assert!(theirs.is_none_or(|theirs| theirs == ours), "{} cells a side", side);
        }
    }

    #[test]
    fn a_walk_has_the_fewest_links_and_the_first_stops((area, calls) in histories()) {
        let mut grid = HeapGrid::new(area);
        for call in calls {
            call.make(&mut grid);
        }
        for from in area.cells().step_by(1 + area.width() * area.height() / 8) {
            for most in [0, 1, 3, 7, 200] {
                prop_assert_eq!(stops(&mut grid, from, most), plain_stops(&grid, from, most), "{} {}", from, most);
            }
        }
    }

    #[test]
    fn what_is_learned_is_forgotten_when_walls_are_cleared((area, calls) in histories()) {
        let mut taught = HeapGrid::new(area);
        for &call in &calls {
            call.make(&mut taught);
        }
        taught.clear_edges(EdgeMark::Wall);
        let mut plain = MediumGrid::new(area).expect("it fits");
        for call in calls {
            if !matches!(call, Call::PutEdge(EdgeMark::Wall, _)) {
                call.make(&mut plain);
            }
        }
        for cell in area.cells() {
            for avoid in AVOIDS {
                prop_assert_eq!(taught.distance(cell, avoid), plain.distance(cell, avoid), "{}", cell);
            }
            for side in Side::ALL {
                let edge = Edge::new(cell, side);
                prop_assert_eq!(
                    taught.edge_has(EdgeMark::Wall, edge), !area.contains(cell.beyond(side)), "{:?}", edge
                );
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_chain_leaves_the_same_log_on_all_grids(
        robots in prop_oneof![2..=6_i16, 2..=32_i16],
        walls in prop_oneof![Just(0.0), 0.0..0.5_f64],
        seed in any::<u64>(),
        rule in proptest::sample::select(vec![Rule::PUBLISHED, Rule::REPAIRED]),
    ) {
        all_grids_agree(rule, robots, walls, seed)?;
    }

    #[test]
    fn a_reel_leaves_the_same_log_on_all_grids(
        robots in 2..=10_i16,
        walls in 0.0..0.4_f64,
        seed in any::<u64>(),
    ) {
        all_grids_agree(Rule::REEL, robots, walls, seed)?;
    }
}

/// The log of a run is the same on all grids that can hold its area.
fn all_grids_agree(rule: Rule, robots: i16, walls: f64, seed: u64) -> Result<(), TestCaseError> {
    let (area, base) = open_area(robots);
    let mut chance = chances(seed);
    let wall: std::collections::HashSet<_> = area.edges().filter(|_| chance(walls)).collect();
    let is_open = |edge| !wall.contains(&edge);
    let robots = robots as usize;
    let ours = run(rule, robots, base, HeapGrid::new(area), is_open);
    let theirs = [
        TinyGrid::new(area).map(|grid| run(rule, robots, base, grid, is_open)),
        CompactGrid::new(area).map(|grid| run(rule, robots, base, grid, is_open)),
        SmallGrid::new(area).map(|grid| run(rule, robots, base, grid, is_open)),
        MediumGrid::new(area).map(|grid| run(rule, robots, base, grid, is_open)),
        LargeGrid::new(area).map(|grid| run(rule, robots, base, grid, is_open)),
    ];
    prop_assert!(theirs[4].is_some());
    prop_assert!(theirs.into_iter().flatten().all(|theirs| theirs == ours));
    Ok(())
}

#[test]
fn an_open_area_too_wide_for_the_bit_grid_is_explored_in_the_moves_of_the_paper() {
    let robots = 40;
    let (area, base) = open_area(robots);
    let robots = robots as usize;
    let (log, end) = run(Rule::REPAIRED, robots, base, HeapGrid::new(area), |_| true);
    assert_eq!((log.len() / (robots - 1), end), (9 * (robots - 1) - 1, Some(End::Explored)));
}

#[test]
fn the_rim_of_the_coordinates_is_border() {
    let corner = Cell::new(i16::MAX, i16::MAX);
    let mut grid = HeapGrid::new(Area::new(Cell::new(i16::MAX - 1, i16::MAX), corner).expect("two cells"));
    for side in [Side::East, Side::South] {
        let edge = Edge::new(corner, side);
        grid.put_edge(EdgeMark::Open, edge);
        assert!(grid.edge_has(EdgeMark::Wall, edge) && !grid.edge_has(EdgeMark::Open, edge));
    }
    grid.put(CellMark::Explored, corner);
    assert_eq!(grid.distance(corner, Avoid::Walls), Some(1));
}
