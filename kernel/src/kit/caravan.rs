//! How three robots and more go together to an uncovered side that none of them can come to alone (KIT-13). It is the condition
//! *Caravan*, which is ours.
//!
//! The robot that is nearest to an uncovered side leads. It drives on while the others stay tied to it; else they come nearer,
//! a robot at a time, each along known paths towards one that it is tied to. Where each stands beside another one, the leader
//! can always go on, and at its goal every side is admitted whose other end is free. Two numbers say why that ends: the drives
//! of the leader to an uncovered side, and while they stay the same, the drives of all others to the leader.
//!
//! If a robot stands at each end of the uncovered paths of the leader's node, the robots between one of these ends and the
//! nearest free node shift by one node each: the condition *MakesRoom*. From there the other end drives the path.

use super::alone::Way;
use super::rule::Condition;
use super::sets::{first_robots, robots};
use super::team::Kit;
use super::tether::Formation;
use crate::ground::{Cell, Grid, Step, Steps};

/// More drives than there can be between two robots.
const FAR: u32 = 1 << 16;

/// No robot.
const NOBODY: u8 = u8::MAX;

/// Who leads, and what for.
struct Lead {
    leader: usize,
    /// The robot that shifts, and whereto, if the ends of a path are taken.
    shift: Option<(usize, Step)>,
}

impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// The part of `robot` in a team of any number but two. `None` if nobody has one.
    pub(super) fn together(&self, robot: usize) -> Option<Steps> {
        let formation = self.planned();
        let is_robot = |other: &usize| *other < formation.count;
        let way =
            |other| Some(other).filter(is_robot).and_then(|other| self.alone(other, &formation, u16::MAX));
        let ways = core::array::from_fn(way);
        if ways.iter().any(Option::is_some) {
            let sides = self.going_alone(robot, &ways, &formation);
            return Some(self.admitted(robot, sides));
        }
        if !self.rule.has(Condition::Caravan) {
            return None;
        }
        let lead = self.lead(&formation)?;
        let part = |robot: usize| self.part_of(robot, &lead, &formation);
        let own = part(robot);
        let is_any = !own.is_empty() || (0..formation.count).any(|other| !part(other).is_empty());
        is_any.then_some(own)
    }

    /// The sides that `robot` takes that has a way alone, as others may have: those with which it makes no longer the way of
    /// one that has a shorter way.
    fn going_alone(
        &self,
        robot: usize,
        ways: &[Option<Way>; ROBOTS],
        formation: &Formation<ROBOTS>,
    ) -> Steps {
        let rank = |other: usize| ways[other].map_or((u16::MAX, other), |way| (way.drives, other));
        let Some(own) = ways[robot] else { return Steps::NONE };
        let is_first = |other: usize| rank(other) < rank(robot);
        if !self.rule.has(Condition::Meanwhile) && (0..ROBOTS).any(is_first) {
            return Steps::NONE;
        }
        own.sides.filter(|step| {
            let after = self.with_robot_at(formation, robot, formation.ends[robot].after(step));
            let below = |other: usize| rank(other).0.saturating_add(1);
            (0..ROBOTS)
                .filter(|&other| is_first(other))
                .all(|other| self.alone(other, &after, below(other)).is_some())
        })
    }

    /// Who leads: of those nearest to an uncovered side the first. `None` if nobody has a way to one.
    fn lead(&self, formation: &Formation<ROBOTS>) -> Option<Lead> {
        let (drives, leader, node) = self.nearest(formation.ends())?;
        let sides = self.uncovered_by_all(node);
        let is_taken = |step: Step| formation.ends().contains(&node.after(step));
        let is_stuck = drives == 0 && sides.iter().all(is_taken) && self.rule.has(Condition::MakesRoom);
        let other_end = sides.iter().next().filter(|_| is_stuck).map(|step| node.after(step));
        let shift = other_end.and_then(|other_end| self.shift(formation.ends(), [node, other_end]));
        Some(Lead { leader, shift })
    }

    /// The sides of where `robot` stands that it takes, if it is its part.
    fn part_of(&self, robot: usize, lead: &Lead, formation: &Formation<ROBOTS>) -> Steps {
        let at = formation.ends[robot];
        if let Some((shifts, step)) = lead.shift {
            let steps = if shifts == robot { Steps::only(step) } else { Steps::NONE };
            return self.admitted(robot, steps);
        }
        if robot == lead.leader {
            let is_goal = |node: Cell| !self.uncovered_by_all(node).is_empty();
            let way = self.way(at, |_, _| true, is_goal, u16::MAX);
            return self.admitted(robot, way.map_or(Steps::NONE, |way| way.sides));
        }
        let now = drives_to(lead.leader, formation);
        let is_nearer =
            |step: Step| drives_to(lead.leader, &self.with_robot_at(formation, robot, at.after(step))) < now;
        let free = self.paths(at).filter(|step| !formation.ends().contains(&at.after(step)));
        self.admitted(robot, free).filter(is_nearer)
    }

    /// The fewest drives of a robot over known paths to a node with an uncovered side, the first of the robots that have no
    /// more, and this node.
    fn nearest(&self, ends: &[Cell]) -> Option<(u16, usize, Cell)> {
        let mut from = [NOBODY; NODES];
        let mut queue = [(0_u16, 0_u16); NODES];
        let (mut first, mut last) = (0, 0);
        for (robot, &node) in ends.iter().enumerate() {
            let place = self.place(node)?;
            if from[place] == NOBODY {
                (from[place], queue[last]) = (robot as u8, (place as u16, 0));
                last += 1;
            }
        }
        while first < last {
            let (place, drives) = queue[first];
            first += 1;
            let (node, robot) = (self.node(place.into()), from[usize::from(place)]);
            if !self.uncovered_by_all(node).is_empty() {
                return Some((drives, robot.into(), node));
            }
            for step in self.paths(node).iter() {
                if let Some(beyond) = self.place(node.after(step))
                    && from[beyond] == NOBODY
                {
                    (from[beyond], queue[last]) = (robot, (beyond as u16, drives + 1));
                    last += 1;
                }
            }
        }
        None
    }

    /// Who shifts so that one of the two nodes is left, where robots are: the one beside the nearest free node.
    fn shift(&self, ends: &[Cell], nodes: [Cell; 2]) -> Option<(usize, Step)> {
        let mut queue = [0_usize; ROBOTS];
        let (mut first, mut last) = (0, 0);
        let mut seen = 0;
        for node in nodes {
            let robot = ends.iter().position(|&end| end == node)?;
            (queue[last], seen) = (robot, seen | 1_u16 << robot);
            last += 1;
        }
        while first < last {
            let robot = queue[first];
            first += 1;
            let node = ends[robot];
            for step in self.paths(node).iter() {
                let beyond = node.after(step);
                match ends.iter().position(|&end| end == beyond) {
                    None if self.is_whole_with(ends, beyond) => return Some((robot, step)),
                    Some(other) if seen >> other & 1 == 0 => {
                        (queue[last], seen) = (other, seen | 1 << other);
                        last += 1;
                    }
                    None | Some(_) => {}
                }
            }
        }
        None
    }

    /// Whether known paths join all robots, over their own nodes and a free one.
    fn is_whole_with(&self, ends: &[Cell], free: Cell) -> bool {
        let beside = |node: Cell| {
            let paths = self.paths(node);
            let is_beside = |end: Cell| paths.iter().any(|step| node.after(step) == end);
            ends.iter().enumerate().fold(0, |set, (robot, &end)| set | u16::from(is_beside(end)) << robot)
        };
        let (mut reached, mut new) = (0, beside(free));
        while new != 0 {
            reached |= new;
            new = robots(new).fold(0, |next, robot| next | beside(ends[robot])) & !reached;
        }
        reached == first_robots(ends.len())
    }
}

/// The drives of all robots to the leader, each over those that it is tied to.
fn drives_to<const ROBOTS: usize>(leader: usize, formation: &Formation<ROBOTS>) -> u32 {
    let between = |one: usize, other: usize| formation.near[one].drives(formation.ends[other]).unwrap_or(FAR);
    let mut to_leader = [FAR; ROBOTS];
    to_leader[leader] = 0;
    for _ in 1..formation.count {
        for one in 0..formation.count {
            for other in 0..formation.count {
                let over = to_leader[other].saturating_add(between(one, other)).min(FAR);
                to_leader[one] = to_leader[one].min(over);
            }
        }
    }
    to_leader[..formation.count].iter().sum()
}

#[cfg(test)]
mod tests {
    use super::super::rule::Rule;
    use super::super::stance::SEEN;
    use super::*;
    use crate::ground::{Area, Edge, EdgeMark, Side, TinyGrid};

    type Trio = Kit<TinyGrid, 3, 16>;

    /// A path, by the node where it begins and its side there.
    type Path = (i16, i16, Side);

    fn edge(&(x, y, side): &Path) -> Edge {
        Edge::new(Cell::new(x, y), side)
    }

    /// Three robots in these columns and rows of 4×4 nodes. Paths are driven, seen free by robots at both ends, or unknown; all
    /// others are blocked.
    fn trio(rule: Rule, starts: [(i16, i16); 3], [driven, seen, unknown]: [&[Path]; 3]) -> Trio {
        let area = Area::new(Cell::new(0, 0), Cell::new(3, 3)).expect("an area");
        let mut map = TinyGrid::new(area).expect("16 nodes");
        for (mark, paths) in [(EdgeMark::Open, driven), (SEEN, seen)] {
            for path in paths {
                map.put_edge(mark, edge(path));
            }
        }
        let is_blocked =
            |path: &Edge| ![driven, seen, unknown].into_iter().flatten().any(|free| edge(free) == *path);
        area.edges().filter(is_blocked).for_each(|path| map.put_edge(EdgeMark::Wall, path));
        Trio::new(rule, map, &starts.map(Cell::from)).expect("a team")
    }

    /// Who shifts, and whereto.
    fn shift(kit: &Trio) -> Option<(usize, Side)> {
        let (robot, step) = kit.lead(&kit.planned()).expect("an uncovered side").shift?;
        let Step::Cross(side) = step else { panic!("it shifts to another node") };
        Some((robot, side))
    }

    const NO_ROOM: Rule = Rule::REPAIRED.without(Condition::MakesRoom);

    #[test]
    fn the_robot_beside_a_free_node_shifts_if_both_ends_of_the_last_path_are_taken() {
        // Free is the fourth node of a square. Two ways round join the two robots beside it with the third.
        let starts = [(0, 0), (1, 0), (0, 1)];
        let driven = [(0, 0, Side::South), (1, 0, Side::South), (0, 1, Side::East)];
        let paths: [&[Path]; 3] = [&driven, &[(0, 0, Side::East)], &[]];
        assert_eq!(shift(&trio(Rule::REPAIRED, starts, paths)), Some((1, Side::South)));
        assert_eq!(shift(&trio(NO_ROOM, starts, paths)), None);
    }

    /// Three robots in a row whose fourth node is free: the first path is uncovered.
    const ROW: [(i16, i16); 3] = [(0, 0), (1, 0), (2, 0)];
    const DRIVEN: [Path; 2] = [(1, 0, Side::East), (2, 0, Side::East)];
    const UNCOVERED: [Path; 1] = [(0, 0, Side::East)];

    #[test]
    fn a_robot_may_shift_that_is_at_neither_end_of_the_last_path() {
        let paths: [&[Path]; 3] = [&DRIVEN, &UNCOVERED, &[]];
        assert_eq!(shift(&trio(Rule::REPAIRED, ROW, paths)), Some((2, Side::East)));
        assert_eq!(shift(&trio(NO_ROOM, ROW, paths)), None);
    }

    #[test]
    fn nobody_shifts_while_an_end_of_an_uncovered_path_is_free() {
        let paths: [&[Path]; 3] = [&DRIVEN, &UNCOVERED, &[(0, 0, Side::South)]];
        assert_eq!(shift(&trio(Rule::REPAIRED, ROW, paths)), None);
    }
}
