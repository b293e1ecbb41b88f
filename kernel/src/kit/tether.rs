//! The bonds of a robot to the others, who stay where they go: it hears them at any speeds (KIT-1, KIT-12), and in a
//! team of three and more known paths join it with them (KIT-13). The second one is the condition *Tether*, which is
//! ours.
//!
//! A *field* is 3×3 nodes, 4×2, or 2×4: any two nodes of a field are in reach. Two robots are *tied* if known paths within one
//! field join their nodes. So a robot that comes nearer to one that it is tied to, along such paths, is in contact with
//! it all the way; radio alone, through a wall, promises no way back.

use super::around::{HERE, IN_REACH, Places, bit, offsets, place_of};
use super::rule::Condition;
use super::sets::{Set, first_robots, robots, sets};
use super::stance::Stance;
use super::team::Kit;
use crate::ground::{Cell, Grid, Side, Step};

/// Drives that lead to any node of a field over paths within it, at most.
const MAX_DRIVES: usize = 8;

/// The fields that have the node in the middle.
const FIELDS: [Places; 25] = {
    let mut fields = [0; 25];
    let sizes = [(3, 3), (4, 2), (2, 4)];
    let mut number = 0;
    let mut size = 0;
    while size < sizes.len() {
        let (columns, rows): (i16, i16) = sizes[size];
        let mut corner = 0;
        while corner < columns * rows {
            let mut place = 0;
            while place < columns * rows {
                let column = place % columns - corner % columns;
                fields[number] |= 1 << bit(column, place / columns - corner / columns);
                place += 1;
            }
            corner += 1;
            number += 1;
        }
        size += 1;
    }
    fields
};

/// The nodes that known paths within one field join with a node.
#[derive(Clone, Copy)]
pub(super) struct Zone {
    node: Cell,
    /// Those at most so many drives away.
    within: [Places; MAX_DRIVES + 1],
}

impl Zone {
    /// The drives to `node`, if it is joined.
    pub(super) fn drives(&self, node: Cell) -> Option<u32> {
        let place = place_of(self.node, node)?;
        self.within.iter().position(|nodes| nodes & place != 0).map(|drives| drives as u32)
    }

    fn has(&self, node: Cell) -> bool {
        place_of(self.node, node).is_some_and(|place| self.within[MAX_DRIVES] & place != 0)
    }
}

/// Where all robots are and go, and what is joined with the nodes where they go.
#[derive(Clone, Copy)]
pub(super) struct Formation<const ROBOTS: usize> {
    pub(super) stances: [Stance; ROBOTS],
    pub(super) ends: [Cell; ROBOTS],
    pub(super) near: [Zone; ROBOTS],
    pub(super) count: usize,
}

impl<const ROBOTS: usize> Formation<ROBOTS> {
    /// Where the robots of the team go.
    pub(super) fn ends(&self) -> &[Cell] {
        &self.ends[..self.count]
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
    /// Whether robots have to stay tied.
    fn ties(&self) -> bool {
        self.count > 2 && self.rule.has(Condition::Tether)
    }

    /// Where all robots are.
    pub(super) fn formation(&self) -> Formation<ROBOTS> {
        let stances = self.robots.map(|robot| robot.stance);
        let ends = stances.map(Stance::to);
        let near = core::array::from_fn(|robot| {
            let node = ends[robot];
            let is_alone = robot >= self.count.into() || !self.ties();
            if is_alone { Zone { node, within: [HERE; MAX_DRIVES + 1] } } else { self.near(node, None) }
        });
        Formation { stances, ends, near, count: self.count.into() }
    }

    /// Where all robots will stand.
    pub(super) fn planned(&self) -> Formation<ROBOTS> {
        let formation = self.formation();
        Formation { stances: formation.ends.map(Stance::Stands), ..formation }
    }

    /// This formation with a robot at this node.
    pub(super) fn with_robot_at(
        &self,
        formation: &Formation<ROBOTS>,
        robot: usize,
        node: Cell,
    ) -> Formation<ROBOTS> {
        let mut after = *formation;
        after.stances[robot] = Stance::Stands(node);
        after.ends[robot] = node;
        after.near[robot] = self.near(node, None);
        after
    }

    /// The nodes joined with `node` by known paths, and by the one that `also` leads over.
    pub(super) fn near(&self, node: Cell, also: Option<Step>) -> Zone {
        let (mut east, mut south): (Places, Places) = (0, 0);
        for offset in offsets(IN_REACH | HERE) {
            let paths = self.paths(node.at_offset(offset.0, offset.1));
            let place = 1 << bit(offset.0, offset.1);
            east |= if paths.has(Step::Cross(Side::East)) { place } else { 0 };
            south |= if paths.has(Step::Cross(Side::South)) { place } else { 0 };
        }
        match also {
            Some(Step::Cross(Side::East)) => east |= HERE,
            Some(Step::Cross(Side::South)) => south |= HERE,
            Some(Step::Cross(Side::West)) => east |= HERE >> 1,
            Some(Step::Cross(Side::North)) => south |= HERE >> 8,
            Some(Step::Stay) | None => {}
        }
        let mut within = [HERE; MAX_DRIVES + 1];
        for field in FIELDS {
            let mut joined = HERE;
            for nodes in &mut within[1..] {
                let along = (joined & east) << 1 | joined >> 1 & east;
                joined |= (along | (joined & south) << 8 | joined >> 8 & south) & field;
                *nodes |= joined;
            }
        }
        Zone { node, within }
    }

    /// The bonds of `robot` to the others of this formation.
    pub(super) fn bonds(&self, robot: usize, formation: &Formation<ROBOTS>) -> Bonds<ROBOTS> {
        let others = first_robots(self.entered.into()) & !(1 << robot);
        let Formation { stances, ends, near, .. } = formation;
        let heard = sets(others, |one, other| self.rule.hears(stances[one], stances[other]));
        let mut tied = [0; ROBOTS];
        if self.ties() {
            tied = sets(others, |one, other| near[one].has(ends[other]));
            for set in &mut tied {
                if !robots(*set).any(|other| near[other].has(ends[robot])) {
                    *set = 0;
                }
            }
        }
        Bonds { robot, heard, tied }
    }

    /// Whether the conditions let the robot of these bonds be on `path`.
    pub(super) fn lets(&self, bonds: &Bonds<ROBOTS>, formation: &Formation<ROBOTS>, path: Stance) -> bool {
        let (from, to) = (path.from(), path.to());
        let Formation { stances, ends, near, .. } = formation;
        let is_taken = |(other, &stance)| other != bonds.robot && !self.rule.keeps_apart(path, stance);
        let entered = stances.iter().take(self.entered.into());
        if entered.enumerate().any(is_taken) {
            return false;
        }
        let is_heard = |set: &Set| robots(*set).any(|other| self.rule.hears(stances[other], path));
        if !bonds.heard.iter().all(|set| *set == 0 || is_heard(set)) {
            return false;
        }
        if bonds.tied.iter().all(|&set| set == 0) {
            return true;
        }
        let back = Step::ALL.into_iter().find(|&step| to.after(step) == from);
        let is_new = back.is_some_and(|step| !self.paths(to).has(step));
        let here = is_new.then(|| self.near(to, back));
        let is_tied = |other: usize| match &here {
            Some(here) => here.has(ends[other]),
            None => near[other].has(to),
        };
        bonds.tied.iter().all(|&set| set == 0 || robots(set).any(is_tied))
    }
}

#[cfg(test)]
mod tests {
    use super::super::rule::Rule;
    use super::super::stance::Reach;
    use super::*;
    use crate::ground::{Area, EdgeMark, TinyGrid};

    const FAR: u32 = u32::MAX;

    /// The drives from the middle of an area of 7×7 nodes to each of its nodes, over the paths of `map` between nodes that are
    /// at most so many columns and rows away, the first and last ones of each.
    fn flooded(map: &TinyGrid, columns: (i16, i16), rows: (i16, i16)) -> [[u32; 7]; 7] {
        let is_within = |node: Cell| {
            (columns.0..=columns.1).contains(&(node.x - 3)) && (rows.0..=rows.1).contains(&(node.y - 3))
        };
        let mut drives = [[FAR; 7]; 7];
        drives[3][3] = 0;
        for _ in 0..9 {
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

    #[test]
    fn a_node_is_joined_by_the_paths_within_one_field() {
        let area = Area::new(Cell::new(0, 0), Cell::new(6, 6)).expect("an area");
        let (middle, mut number) = (Cell::new(3, 3), 1_u64);
        for round in 0..200 {
            let mut map = TinyGrid::new(area).expect("49 nodes");
            for edge in area.edges() {
                number =
                    number.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                if (number >> 33) % 100 < 40 + round % 61 {
                    map.put_edge(EdgeMark::Open, edge);
                }
            }
            let mut least = [[FAR; 7]; 7];
            for (wide, high) in [(3, 3), (4, 2), (2, 4)] {
                for (column, row) in
                    (1 - wide..=0).flat_map(|column| (1 - high..=0).map(move |row| (column, row)))
                {
                    let flooded = flooded(&map, (column, column + wide - 1), (row, row + high - 1));
                    for node in area.cells() {
                        let (x, y) = (node.x as usize, node.y as usize);
                        least[y][x] = least[y][x].min(flooded[y][x]);
                    }
                }
            }
            let starts = [2, 3, 4].map(|x| Cell::new(x, 3));
            let kit = Kit::<_, 3, 49>::new(Rule::REPAIRED, map, &starts).expect("a team");
            let near = kit.near(middle, None);
            for node in area.cells() {
                let drives = least[node.y as usize][node.x as usize];
                assert_eq!(near.drives(node), (drives < FAR).then_some(drives), "{node} in {map:?}");
                assert_eq!(near.has(node), drives < FAR, "{node} in {map:?}");
            }
        }
    }

    #[test]
    fn any_two_nodes_of_a_field_are_in_reach() {
        for field in FIELDS {
            assert!(field & HERE != 0);
            for one in offsets(field) {
                for other in offsets(field) {
                    let [one, other] =
                        [one, other].map(|offset| Cell::new(0, 0).at_offset(offset.0, offset.1));
                    assert!(Reach::PAPER.joins(one, other), "{one} {other}");
                }
            }
        }
    }
}
