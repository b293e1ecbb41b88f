//! A pack robot's sight, its map, and how much there would be to see elsewhere, each compared with a second, slower way
//! to say it.

use std::collections::BTreeMap;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Side};
use tautline_kernel::pack::{Chart, Sight, Status, Window};

use crate::floors::{Map, area, free_cell, gain, is_clear, is_within, obstacles, unknown};
use crate::numbers::Congruence;

#[test]
fn a_robot_sees_the_cells_to_which_a_straight_way_is_free() {
    let mut drawn = Congruence(1);
    for (sight_cells, density) in
        (1..=12).flat_map(|far| [0, 8, 25, 60].map(|density| (far, density))).chain([(31, 3), (30, 15)])
    {
        let sight = Sight::new(sight_cells).expect("it sees");
        let floor = area((-7, -9), 80, 40);
        let obstacles = obstacles(&mut drawn, floor, density);
        let is_obstacle = |cell: Cell| obstacles.contains(&cell) || !floor.contains(cell);
        let mut map = unknown(floor);
        for _ in 0..3 {
            let from = free_cell(&mut drawn, floor, &obstacles);
            let before = map.clone();
            let mut told = BTreeMap::new();
            let asked = |cell| {
                assert_eq!(before.status(cell), Status::Unknown, "{cell} is known");
                is_obstacle(cell)
            };
            map.look(&sight, from, asked, |cell, is_obstacle| {
                assert_eq!(told.insert(cell, is_obstacle), None, "{cell} is told twice");
            });
            for cell in floor.cells() {
                let is_new = before.status(cell) == Status::Unknown
                    && is_within(from, cell, sight_cells)
                    && is_clear(from, cell, is_obstacle);
                let seen = is_new.then(|| is_obstacle(cell));
                assert_eq!(told.get(&cell).copied(), seen, "R_s {sight_cells}, from {from} to {cell}");
                let status = match seen {
                    Some(true) => Status::Obstacle,
                    Some(false) => Status::Free,
                    None => before.status(cell),
                };
                assert_eq!(map.status(cell), status);
            }
        }
    }
}

#[test]
fn a_map_knows_what_was_put_in_it_and_nothing_outside() {
    let mut drawn = Congruence(2);
    for (width, height) in [(1, 1), (3, 70), (63, 2), (64, 3), (65, 3), (128, 2), (200, 4)] {
        let floor = area((-90, -3), width, height);
        let mut map = unknown(floor);
        assert_eq!(map.area(), floor);
        let mut put = BTreeMap::new();
        for _ in 0..3 * width * height {
            let (x, y) = (drawn.pick(width as u32 + 4) as i16, drawn.pick(height as u32 + 4) as i16);
            let cell = Cell::new(floor.first().x - 2 + x, floor.first().y - 2 + y);
            let is_obstacle = drawn.pick(2) == 0;
            map.put(cell, is_obstacle);
            if floor.contains(cell) {
                put.insert(cell, if is_obstacle { Status::Obstacle } else { Status::Free });
            }
        }
        let status = |cell: Cell| match put.get(&cell) {
            Some(&status) => status,
            None if floor.contains(cell) => Status::Unknown,
            None => Status::Obstacle,
        };
        let around = area((-95, -6), 210, 80);
        for cell in around.cells() {
            assert_eq!(map.status(cell), status(cell), "{cell} of {floor:?}");
            let beside = Side::ALL.map(|side| status(cell.beyond(side)));
            let is_frontier = status(cell) == Status::Free && beside.contains(&Status::Unknown);
            assert_eq!(map.is_frontier(cell), is_frontier, "{cell} of {floor:?}");
        }
        let few = vec![[0; 2]; Map::words(floor) - 1];
        assert_eq!(Chart::new(floor, few), None, "one pair of words is missing");
    }
}

#[test]
fn a_gain_counts_the_unknown_cells_that_would_be_seen_and_that_nobody_else_goes_to_see() {
    let mut drawn = Congruence(3);
    for sight_cells in [1, 2, 3, 5, 8, 20, 31] {
        let sight = Sight::new(sight_cells).expect("it sees");
        for (width, known) in [(130, 5), (128, 50), (130, 50), (128, 90), (30, 60)] {
            let floor = area((-40, 5), width, 60);
            let mut map = unknown(floor);
            for cell in floor.cells() {
                if drawn.pick(100) < known {
                    map.put(cell, drawn.pick(4) == 0);
                }
            }
            for _ in 0..8 {
                let mut near =
                    || Cell::new(-44 + drawn.pick(width as u32 + 8) as i16, 1 + drawn.pick(68) as i16);
                let (cell, one, other) = (near(), near(), near());
                let by = |by: u32, drawn: &mut Congruence| drawn.pick(2 * by + 1) as i16 - by as i16;
                let close = Cell::new(
                    cell.x + by(2 * u32::from(sight_cells), &mut drawn),
                    cell.y + by(2 * u32::from(sight_cells), &mut drawn),
                );
                let others = [one, other, close];
                let mut window = Window::new(&map, &sight, cell);
                for other in others {
                    window.take(&sight, other);
                }
                assert_eq!(window.gain(), gain(&map, sight_cells, cell, &others), "{cell} {others:?}");
                let is_own = |&unknown: &Cell| {
                    map.status(unknown) == Status::Unknown
                        && is_within(cell, unknown, sight_cells)
                        && !others.iter().any(|&other| is_within(other, unknown, sight_cells))
                };
                assert_eq!(window.most() as usize, floor.cells().filter(is_own).count(), "{cell} {others:?}");
            }
        }
    }
}
