//! Laps of one agent on floors whose corridors are one cell wide: how far it goes before it turns, and when a lap is
//! over.

use std::collections::BTreeMap;

use tautline_kernel::bricks::{Agent, Condition, Rule, act};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Sensor, settle};
use tautline_kernel::ground::{Cell, Edge, Side};

/// Cells with sensors, and no walls.
struct Corridors(BTreeMap<Cell, Sensor>);

impl Corridors {
    /// The rims of rectangles, all of whose cells have been explored.
    fn around(rectangles: &[(Cell, Cell)]) -> Self {
        let explored = Sensor { mark: Mark::Explored, ..Sensor::default() };
        let rims = rectangles.iter().flat_map(|&(first, last)| {
            let cells =
                (first.y..=last.y).flat_map(move |y| (first.x..=last.x).map(move |x| Cell::new(x, y)));
            cells.filter(move |cell| {
                [first.x, last.x].contains(&cell.x) || [first.y, last.y].contains(&cell.y)
            })
        });
        Self(rims.map(|cell| (cell, explored)).collect())
    }
}

impl Floor for Corridors {
    fn sensor(&self, cell: Cell) -> Option<Sensor> {
        self.0.get(&cell).copied()
    }

    fn put(&mut self, cell: Cell, sensor: Sensor) {
        self.0.entry(cell).and_modify(|known| *known = sensor);
    }

    fn unpack(&mut self, _: Cell) -> u16 {
        1
    }

    fn is_open(&self, _: Edge) -> bool {
        true
    }
}

/// No sensor is missed.
struct Luck;

impl Oracle for Luck {
    fn pick(&mut self, _: u32) -> u32 {
        0
    }
}

/// An agent that is always on a lap, from `start` until it shuts a side: the sides that its laps begin with and their
/// moves, the cells that it goes to, and the side that it shuts.
fn laps(floor: &mut Corridors, start: Cell, reach: u8) -> (Vec<(Side, u32)>, Vec<Cell>, Side) {
    let rule = Rule { reach, ..Rule::REPAIRED.without(Condition::LeastCrossed) };
    settle(floor, &[start]);
    let (mut agent, mut at) = (Agent::new(0), start);
    let (mut laps, mut path): (Vec<(Side, u32)>, _) = (Vec::new(), Vec::new());
    for _ in 0..1000 {
        let (done, to) = act(rule, floor, &mut agent, at, &mut Luck);
        if let Some(side) = done.shuts {
            return (laps, path, side);
        }
        let first = agent.lap().expect("it is on a lap").first;
        match laps.last_mut().filter(|lap| lap.0 == first) {
            Some((_, moves)) => *moves += 1,
            None => laps.push((first, 1)),
        }
        path.push(to);
        at = to;
    }
    panic!("it shuts no side: {laps:?}");
}

#[test]
fn after_two_laps_that_are_cut_short_an_agent_goes_twice_as_far() {
    use Side::{East, West};
    let ring = [(Cell::new(0, 0), Cell::new(10, 10))];
    let start = Cell::new(5, 0);
    for (reach, expected) in [
        (3, vec![6, 6, 12, 12, 24, 24, 48, 48, 40]),
        (5, vec![10, 10, 20, 20, 40, 40, 40]),
        (39, vec![78, 78, 40]),
        (40, vec![40]),
        (255, vec![40]),
    ] {
        let (laps, _, shut) = laps(&mut Corridors::around(&ring), start, reach);
        // Out and back, once round the one piece of material and once round the other, until it comes round.
        let sides = [West, East].into_iter().cycle();
        assert_eq!(laps, sides.zip(expected).collect::<Vec<_>>(), "{reach}");
        assert_eq!(shut, West);
    }
}

#[test]
fn a_lap_goes_on_where_it_passes_its_start_by_other_sides() {
    // Two rings with one cell in common: the material around them is on its left when it comes, and when it goes again.
    let eight = [(Cell::new(-2, -2), Cell::new(0, 0)), (Cell::new(0, 0), Cell::new(2, 2))];
    let start = Cell::new(0, 0);
    let (laps, path, shut) = laps(&mut Corridors::around(&eight), start, 255);
    let passed: Vec<usize> = (1..=path.len()).filter(|&moves| path[moves - 1] == start).collect();
    assert_eq!((laps, passed, shut), (vec![(Side::West, 16)], vec![8, 16], Side::West));
}
