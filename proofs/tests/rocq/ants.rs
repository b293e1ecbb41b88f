//! The answers of ants: where one goes and what the cell that it enters counts then, for all counts of the side
//! neighbours up to 2, seen and missed; and runs on drawn floors where sensors are missed.

use tautline_kernel::ants::{Rule, carry_out, decide};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{COMPASS, Floor, Mark, Scan, Sensor, SensorFate, settle};
use tautline_kernel::ground::{Cell, Edge, Side};

use super::ground::Ground;
use super::term::{cell, definition, list};
use crate::draw::Draw;

const RULES: [(&str, Rule); 4] = [
    ("Lost", Rule::PUBLISHED),
    ("Beside", Rule::Published(SensorFate::Beside)),
    ("Counted", Rule::Published(SensorFate::Counted)),
    ("Repaired", Rule::Repaired),
];

/// The neighbour beyond a side: behind a wall; or how often it was entered, and whether it is missed.
const NEIGHBOURS: [Option<(u32, bool)>; 6] =
    [None, Some((0, false)), Some((1, false)), Some((2, false)), Some((1, true)), Some((2, true))];

impl Ground<Sensor> {
    fn count(&self, cell: Cell) -> u32 {
        self.sensors.get(&(cell.x, cell.y)).map_or(0, |sensor| sensor.crossings)
    }

    /// The neighbours beyond which sides an ant in `cell` comes to.
    fn sides(&self, cell: Cell) -> impl Iterator<Item = Side> {
        let comes = move |&side: &Side| {
            self.sensor(cell.beyond(side)).is_some() && self.is_open(Edge::new(cell, side))
        };
        COMPASS.into_iter().filter(comes)
    }
}

/// Misses the sensors in these places of the order in which they are read.
struct Misses<'a>(std::slice::Iter<'a, bool>);

impl Oracle for Misses<'_> {
    fn pick(&mut self, _: u32) -> u32 {
        self.0.next().copied().unwrap_or_default().into()
    }
}

/// 0 if an ant stays; else 1, the place of the side in the compass, and four times what the cell beyond it counts then.
fn answer(rule: Rule, own: u32, beside: [Option<(u32, bool)>; 4]) -> String {
    let here = Cell::new(0, 0);
    let sensor = |crossings| {
        let mark = if crossings == 0 { Mark::Unexplored } else { Mark::Explored };
        Sensor { mark, crossings, ..Sensor::default() }
    };
    let mut floor = Ground::default();
    floor.put(here, sensor(own));
    for (side, neighbour) in COMPASS.into_iter().zip(beside) {
        floor.put(here.beyond(side), sensor(neighbour.map_or(0, |(count, _)| count)));
        floor.walls.extend(neighbour.is_none().then(|| Edge::new(here, side)));
    }
    let missed: Vec<bool> = beside
        .into_iter()
        .flatten()
        .filter(|&(count, _)| count > 0)
        .map(|(_, is_missed)| is_missed)
        .collect();
    let before: Vec<u32> = COMPASS.iter().map(|&side| floor.count(here.beyond(side))).collect();
    let scan = Scan::new(&floor, here, &mut Misses(missed.iter()));
    let there = carry_out(&mut floor, here, decide(rule, &scan));
    assert_eq!(floor.count(here), own, "only the cell that is entered counts");
    let mut number = 0;
    for ((place, side), before) in (0..).zip(COMPASS).zip(before) {
        let count = floor.count(here.beyond(side));
        if here.beyond(side) == there {
            number = 1 + place + 4 * count;
        } else {
            assert_eq!(count, before, "only the cell that is entered counts");
        }
    }
    number.to_string()
}

/// The answers of one rule: what the ant's own cell counts, 1 or 3, then the neighbours.
fn answers(rule: Rule) -> String {
    let of = |number: usize| [0, 1, 2, 3].map(|place| NEIGHBOURS[number / 6_usize.pow(place) % 6]);
    list([1, 3].into_iter().flat_map(|own| (0..1296).map(move |number| answer(rule, own, of(number)))))
}

/// A run: the cells, the walls, where the ants start; of each action the ant, the side, and the side neighbours that it
/// missed; and where the ants are at the end, and what each cell counts.
fn run(rule: Rule, ants: usize, draw: &mut Draw) -> String {
    let all: Vec<Cell> = (0..4).flat_map(|y| (0..5).map(move |x| Cell::new(x, y))).collect();
    let cells: Vec<Cell> = all.into_iter().filter(|_| draw.below(10) > 0).collect();
    let mut floor = Ground::default();
    for &cell in &cells {
        floor.put(cell, Sensor::default());
        let sides = [Side::East, Side::South].into_iter().filter(|_| draw.below(6) == 0);
        floor.walls.extend(sides.map(|side| Edge::new(cell, side)));
    }
    let free: Vec<Cell> = cells.iter().copied().filter(|&cell| floor.sides(cell).next().is_some()).collect();
    let mut at: Vec<Cell> = (0..ants).map(|_| free[draw.below(free.len() as u64) as usize]).collect();
    let starts = list(at.iter().copied().map(cell));
    settle(&mut floor, &at);
    let mut actions = Vec::new();
    for _ in 0..60 {
        let ant = draw.below(ants as u64) as usize;
        let here = at[ant];
        let misses: Vec<bool> = (0..8).map(|_| draw.below(8) == 0).collect();
        let scan = Scan::new(&floor, here, &mut Misses(misses.iter()));
        let is_missed =
            |&(_, side): &(u32, Side)| scan.unexplored.has(side) && floor.count(here.beyond(side)) > 0;
        let missed = (0_u32..).zip(COMPASS).filter(is_missed).fold(0, |mask, (place, _)| mask | 1 << place);
        at[ant] = carry_out(&mut floor, here, decide(rule, &scan));
        let side = COMPASS.iter().position(|&side| here.beyond(side) == at[ant]).expect("it has a neighbour");
        actions.push((ant + 4 * side + 16 * missed).to_string());
    }
    let counts = cells.iter().map(|&cell| floor.count(cell).to_string());
    format!(
        "\n ({}%Z,\n  {}%Z,{starts}%Z,\n  {}%nat,\n  {}%Z,{}%nat)",
        list(cells.iter().copied().map(cell)),
        floor.walls(),
        list(actions),
        list(at.iter().copied().map(cell)),
        list(counts),
    )
}

pub(super) fn terms() -> String {
    let mut text = String::new();
    for (name, rule) in RULES {
        text += &definition(&format!("answers_{name}"), "list nat", &format!("{}%nat", answers(rule)));
    }
    let mut draw = Draw(2009);
    let kind =
        "list (list (Z * Z) * list ((Z * Z) * bool) * list (Z * Z) * list nat * list (Z * Z) * list nat)";
    for (name, rule) in RULES {
        let runs: Vec<String> = (0..6).map(|number| run(rule, 1 + number % 3, &mut draw)).collect();
        text += &definition(&format!("runs_{name}"), kind, &list(runs));
    }
    text
}
