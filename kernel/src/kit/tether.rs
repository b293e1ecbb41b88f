//! The bonds of a robot to the others, who stay where they go: it hears them at any speeds (KIT-1, KIT-12), and in a
//! team of three and more known paths join it with them (KIT-13). The second one is the condition *Tether*, which is
//! ours.
//!
//! A *field* is a rectangle any two nodes of which are in reach, and that is in no larger one: within the paper's
//! 10 m, 3×3 nodes, 4×2, or 2×4. Two robots are *tied* if known paths within one field join their nodes. So a
//! robot that comes nearer to one that it is tied to, along such paths, is in contact with it all the way; radio
//! alone, through a wall, promises no way back.

use core::cell::OnceCell;

use super::around::{HERE, Places, SIDE, bit, in_reach, moved, offsets, place_of};
use super::rule::Condition;
use super::stance::{Reach, Stance};
use super::team::Kit;
use crate::ground::{Cell, Grid, Side, Step, steps_to};
use crate::net::sets::{Set, first_robots, robots, sets};

/// More drives than there can be between two robots.
pub(super) const FAR: u32 = 1 << 16;

/// Drives that lead to any node of a field over paths within it, at most: the largest ones have 20 nodes.
const MAX_DRIVES: usize = 19;

/// Calls `each` with the fields that have the node in the middle: the place of the first node of each,
/// its nodes from there on, and the bit of the one in the middle among them. No field has more than six
/// rows, so that its nodes fit in half a word.
fn fields(reach: Reach, mut each: impl FnMut(u32, u64, u64)) {
    let squared = i16::from(reach.squared());
    let rows = |columns: i16| match squared - (columns - 1) * (columns - 1) {
        rest @ 0.. => rest.isqrt() + 1,
        _ => 0,
    };
    for columns in (1..=squared.isqrt() + 1).filter(|&columns| rows(columns) > rows(columns + 1)) {
        let row = (1 << columns) - 1;
        let field = (0..rows(columns)).fold(0, |field, number| field | row << (SIDE * number));
        for row in 0..rows(columns) {
            for column in 0..columns {
                each(bit(-column, -row), field, 1 << (SIDE * row + column));
            }
        }
    }
}

/// Where all robots are, and what is joined with the nodes where they go, as far as somebody has asked.
#[derive(Clone)]
pub(super) struct Formation<const ROBOTS: usize> {
    pub(super) stances: [Stance; ROBOTS],
    joined: [OnceCell<Places>; ROBOTS],
}

impl<const ROBOTS: usize> Formation<ROBOTS> {
    /// This formation with a robot that stands at this node.
    pub(super) fn with_robot_at(&self, robot: usize, node: Cell) -> Self {
        let mut after = self.clone();
        (after.stances[robot], after.joined[robot]) = (Stance::Stands(node), OnceCell::new());
        after
    }

    /// This formation with other stances of robots that go to the same nodes.
    pub(super) fn with_stances(&self, stances: [Stance; ROBOTS]) -> Self {
        Self { stances, ..self.clone() }
    }
}

/// The bonds of one robot to the others.
pub(super) struct Bonds<const ROBOTS: usize> {
    robot: usize,
    /// Of those that hear each other without it, it has to hear one of each set.
    heard: [Set; ROBOTS],
    /// Of those that are tied to each other without it, it has to stay tied to one of each set.
    tied: [Set; ROBOTS],
}

impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// Where all robots are.
    pub(super) fn formation(&self) -> Formation<ROBOTS> {
        let joined = [const { OnceCell::new() }; ROBOTS];
        Formation { stances: self.crew.robots.map(|robot| robot.stance), joined }
    }

    /// Whether a robot of this formation is tied to one that goes to `node`.
    fn is_tied(&self, formation: &Formation<ROBOTS>, robot: usize, node: Cell) -> bool {
        let Formation { stances, joined } = formation;
        let end = stances[robot].to();
        place_of(end, node).is_some_and(|place| {
            joined[robot].get_or_init(|| self.joined::<1>(end, None, !0)[0]) & place != 0
        })
    }

    /// The drives from `node` to each of `ends` that known paths within one
    /// field join with it; to the others it is far.
    pub(super) fn drives(&self, node: Cell, ends: &[Cell; ROBOTS]) -> [u32; ROBOTS] {
        let places = ends.map(|end| place_of(node, end).unwrap_or(0));
        let wanted = places.iter().fold(0, |wanted, place| wanted | place);
        let [_, within @ ..] = self.joined::<{ MAX_DRIVES + 2 }>(node, None, wanted);
        places.map(|place| {
            within.iter().position(|nodes| nodes & place != 0).map_or(FAR, |drives| drives as u32)
        })
    }

    /// The nodes that known paths within one field, and the one that `also` leads over, join with a node, as far as
    /// they are `wanted`; and then those that they join with no drive, with one at most, and so on.
    fn joined<const WITHIN: usize>(
        &self,
        node: Cell,
        also: Option<Step>,
        wanted: Places,
    ) -> [Places; WITHIN] {
        let disc = in_reach(self.rule.reach) | HERE;
        let (mut east, mut south): (Places, Places) = (0, 0);
        let (mut reached, mut new) = (HERE, HERE);
        while let Some((columns, rows)) = offsets(new).next() {
            let place = 1 << bit(columns, rows);
            let paths = self.paths(node.at_offset(columns, rows));
            let also = also.filter(|_| place == HERE);
            let paths = also.map_or(paths, |also| paths.with(also));
            let beyond = |side: Side| {
                let step = Step::Cross(side);
                if paths.has(step) { moved(place, step) } else { 0 }
            };
            let [to_east, to_south, to_west, to_north] =
                [Side::East, Side::South, Side::West, Side::North].map(beyond);
            east |= to_east >> 1 | to_west;
            south |= to_south >> SIDE | to_north;
            let beside = (to_east | to_south | to_west | to_north) & disc & !reached;
            (reached, new) = (reached | beside, new & !place | beside);
        }
        let wanted = wanted & reached;
        let mut within = [HERE; WITHIN];
        fields(self.rule.reach, |first, field, middle| {
            let known = if WITHIN == 1 { within[0] } else { HERE };
            if Places::from(field) << first & wanted & !known == 0 {
                return;
            }
            let (east, south) = ((east >> first) as u64, (south >> first) as u64);
            let mut joined = middle;
            for drives in 2.. {
                let along = (joined & east) << 1 | joined >> 1 & east;
                let across = (joined & south) << SIDE | joined >> SIDE & south;
                let new = (along | across) & field & !joined;
                if new == 0 {
                    break;
                }
                joined |= new;
                if WITHIN > 1
                    && let Some(nodes) = within.get_mut(drives)
                {
                    *nodes |= Places::from(joined) << first;
                }
            }
            within[0] |= Places::from(joined) << first;
        });
        within
    }

    /// The bonds of `robot` to the others of this formation.
    pub(super) fn bonds(&self, robot: usize, formation: &Formation<ROBOTS>) -> Bonds<ROBOTS> {
        let others = first_robots(self.crew.entered.into()) & !(1 << robot);
        let stances = &formation.stances;
        let heard = sets(others, |one, other| self.rule.hears(stances[one], stances[other]));
        let mut tied = [0; ROBOTS];
        if self.count > 2 && self.rule.has(Condition::Tether) {
            let is_tied = |one: usize, other: usize| self.is_tied(formation, one, stances[other].to());
            tied = sets(others, is_tied);
            for set in tied.iter_mut().filter(|set| !robots(**set).any(|other| is_tied(other, robot))) {
                *set = 0;
            }
        }
        Bonds { robot, heard, tied }
    }

    /// Whether the conditions let the robot of these bonds be on `path`.
    pub(super) fn lets(&self, bonds: &Bonds<ROBOTS>, formation: &Formation<ROBOTS>, path: Stance) -> bool {
        let (from, to) = (path.from(), path.to());
        let stances = &formation.stances;
        let is_taken = |(other, &stance)| other != bonds.robot && !self.rule.keeps_apart(path, stance);
        if stances.iter().take(self.crew.entered.into()).enumerate().any(is_taken) {
            return false;
        }
        let is_heard = |set: &Set| robots(*set).any(|other| self.rule.hears(stances[other], path));
        if !bonds.heard.iter().all(|set| *set == 0 || is_heard(set)) {
            return false;
        }
        let all = bonds.tied.iter().fold(0, |all, set| all | set);
        if all == 0 {
            return true;
        }
        let place = |other: usize| place_of(to, stances[other].to()).unwrap_or(0);
        let back = steps_to(from, to).iter().next();
        let new = back.filter(|&step| !self.paths(to).has(step)).map(|_| {
            let wanted = robots(all).fold(0, |wanted, other| wanted | place(other));
            self.joined::<1>(to, back, wanted)[0]
        });
        let is_tied = |other: usize| match new {
            Some(joined) => joined & place(other) != 0,
            None => self.is_tied(formation, other, to),
        };
        bonds.tied.iter().all(|&set| set == 0 || robots(set).any(is_tied))
    }
}

#[cfg(test)]
mod tests {
    use super::super::rule::Rule;
    use super::*;
    use crate::ground::{Area, EdgeMark, TinyGrid};

    const FAR: u32 = u32::MAX;

    /// Sizes of fields: columns and rows.
    type Sizes = &'static [(i16, i16)];

    fn reaches() -> [(Reach, Sizes); 4] {
        let paths = |paths| Reach::of_paths(paths).expect("a reach");
        [
            (paths(2), &[(1, 3), (2, 2), (3, 1)]),
            (Reach::PAPER, &[(2, 4), (3, 3), (4, 2)]),
            (paths(4), &[(1, 5), (3, 4), (4, 3), (5, 1)]),
            (paths(5), &[(1, 6), (4, 5), (5, 4), (6, 1)]),
        ]
    }

    /// The drives from the middle of an area of 7×7 nodes to each of its nodes, over the paths of `map` between nodes
    /// that are at most so many columns and rows away, the first and last ones of each.
    fn flooded(map: &TinyGrid, columns: (i16, i16), rows: (i16, i16)) -> [[u32; 7]; 7] {
        let is_within = |node: Cell| {
            (columns.0..=columns.1).contains(&(node.x - 3)) && (rows.0..=rows.1).contains(&(node.y - 3))
        };
        let mut drives = [[FAR; 7]; 7];
        drives[3][3] = 0;
        for _ in 0..=MAX_DRIVES {
            for node in map.area().cells().filter(|&node| is_within(node)) {
                let open = map.sides(EdgeMark::Open, node);
                for beyond in open.iter().map(|step| node.after(step)).filter(|&node| is_within(node)) {
                    let over = drives[beyond.y as usize][beyond.x as usize].saturating_add(1);
                    let known = &mut drives[node.y as usize][node.x as usize];
                    *known = over.min(*known);
                }
            }
        }
        drives
    }

    /// The fewest drives from the middle within any field of these sizes.
    fn fewest(map: &TinyGrid, sizes: Sizes) -> [[u32; 7]; 7] {
        let mut least = [[FAR; 7]; 7];
        for &(wide, high) in sizes {
            for (column, row) in
                (1 - wide..=0).flat_map(|column| (1 - high..=0).map(move |row| (column, row)))
            {
                let flooded = flooded(map, (column, column + wide - 1), (row, row + high - 1));
                for node in map.area().cells() {
                    let (x, y) = (node.x as usize, node.y as usize);
                    least[y][x] = least[y][x].min(flooded[y][x]);
                }
            }
        }
        least
    }

    #[test]
    fn a_node_is_joined_by_the_paths_within_one_field() {
        let area = Area::new(Cell::new(0, 0), Cell::new(6, 6)).expect("an area");
        let (middle, mut number) = (Cell::new(3, 3), 1_u64);
        for (round, (reach, sizes)) in (0..200).zip(reaches().into_iter().cycle()) {
            let mut map = TinyGrid::new(area).expect("49 nodes");
            for edge in area.edges() {
                number =
                    number.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                if (number >> 33) % 100 < 40 + round % 61 {
                    map.put_edge(EdgeMark::Open, edge);
                }
            }
            let least = fewest(&map, sizes);
            let starts = [2, 3, 4].map(|x| Cell::new(x, 3));
            let kit = Kit::<_, 3, 49>::new(Rule { reach, ..Rule::REPAIRED }, map, &starts).expect("a team");
            let [all, within @ ..] = kit.joined::<{ MAX_DRIVES + 2 }>(middle, None, !0);
            for node in area.cells() {
                let place = place_of(middle, node).expect("it is near");
                let drives = within.iter().position(|nodes| nodes & place != 0);
                let least = least[node.y as usize][node.x as usize];
                assert_eq!(drives, (least < FAR).then_some(least as usize), "{node} in {map:?}");
                let [wanted] = kit.joined(middle, None, place);
                assert_eq!([all & place != 0, wanted & place != 0], [least < FAR; 2], "{node} in {map:?}");
            }
        }
    }

    #[test]
    fn fields_are_the_largest_rectangles_any_two_nodes_of_which_are_in_reach() {
        for (reach, sizes) in reaches() {
            let mut count = 0;
            fields(reach, |first, field, middle| {
                count += 1;
                let field = Places::from(field) << first;
                assert!(Places::from(middle) << first == HERE && field & HERE != 0);
                for (one, other) in
                    offsets(field).flat_map(|one| offsets(field).map(move |other| (one, other)))
                {
                    let [one, other] =
                        [one, other].map(|(columns, rows)| Cell::new(0, 0).at_offset(columns, rows));
                    assert!(reach.joins(one, other), "{one} {other}");
                }
            });
            assert_eq!(count, sizes.iter().map(|(columns, rows)| columns * rows).sum::<i16>());
            for &(columns, rows) in sizes {
                let last = |columns: i16, rows: i16| Cell::new(columns - 1, rows - 1);
                let larger = [last(columns + 1, rows), last(columns, rows + 1)];
                assert!(larger.iter().all(|&last| !reach.joins(Cell::new(0, 0), last)), "{columns}×{rows}");
            }
        }
    }
}
