//! How three robots and more go together to an uncovered side that none of them can come to alone (KIT-13). It is the
//! condition *Caravan*, which is ours.
//!
//! The robot that is nearest to an uncovered side leads. It drives on while the others stay tied to it; else they
//! come nearer, a robot at a time, each along known paths towards one that it is tied to. Where each stands
//! beside another one, the leader can always go on, and at its goal every side is admitted whose other end is
//! free. Two numbers say why that ends: the drives of the leader to an uncovered side, and while they stay the
//! same, the drives of all others to the leader.
//!
//! If a robot stands at each end of the uncovered paths of the leader's node, the robots between one of these ends and
//! the nearest free node shift by one node each: the condition *MakesRoom*. From there the other end drives the path.

use super::alone::Way;
use super::rule::Condition;
use super::stance::Stance;
use super::team::Kit;
use super::tether::{FAR, Formation};
use crate::ground::{Cell, Grid, Step, Steps};
use crate::net::sets::{Set, first_robots, robots};

/// Who leads, and what for.
struct Lead<const ROBOTS: usize> {
    leader: usize,
    /// The sides with which its way can begin.
    sides: Steps,
    /// The drives between each two robots that are tied.
    between: [[u32; ROBOTS]; ROBOTS],
    /// The robot that shifts, and whereto, if the ends of a path are taken.
    shift: Option<(usize, Step)>,
}

impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// The part of `robot` in a team of any number but two. `None` if nobody has one.
    pub(super) fn together(&self, robot: usize) -> Option<Steps> {
        let formation = self.formation();
        let ends = formation.stances.map(Stance::to);
        let planned = formation.with_stances(ends.map(Stance::Stands));
        let count = usize::from(self.count);
        if let Some(own) = self.alone(robot, &planned, u16::MAX) {
            let sides = self.going_alone(robot, own, &planned);
            return Some(self.admitted_in(&planned.with_stances(formation.stances), robot, sides));
        }
        let others = || (0..count).filter(|&other| other != robot);
        if others().any(|other| self.alone(other, &planned, u16::MAX).is_some()) {
            return Some(Steps::NONE);
        }
        if !self.rule.has(Condition::Caravan) {
            return None;
        }
        let lead = self.lead(&ends)?;
        let part = |robot: usize| self.part_of(robot, &lead, &ends);
        let own = part(robot);
        let is_any = !own.is_empty() || others().any(|other| !part(other).is_empty());
        is_any.then_some(own)
    }

    /// The sides that `robot` takes that has its own way alone: those with which it makes no longer the way of one that
    /// has a shorter way.
    fn going_alone(&self, robot: usize, own: Way, planned: &Formation<ROBOTS>) -> Steps {
        let shorter: [Option<Way>; ROBOTS] = core::array::from_fn(|other| {
            let below = own.drives + u16::from(other < robot);
            if other == robot || other >= self.count.into() || below == 0 {
                None
            } else {
                self.alone(other, planned, below)
            }
        });
        if !self.rule.has(Condition::Meanwhile) && shorter.iter().any(Option::is_some) {
            return Steps::NONE;
        }
        own.sides.filter(|step| {
            let after = planned.with_robot_at(robot, planned.stances[robot].to().after(step));
            let is_kept = |(other, way): (usize, &Option<Way>)| {
                way.is_none_or(|way| self.alone(other, &after, way.drives + 1).is_some())
            };
            shorter.iter().enumerate().all(is_kept)
        })
    }

    /// Who leads: of those nearest to an uncovered side the first. `None` if nobody has a way to one.
    fn lead(&self, all: &[Cell; ROBOTS]) -> Option<Lead<ROBOTS>> {
        let ends = &all[..self.count.into()];
        let is_goal = |node: Cell| !self.uncovered_by_all(node).is_empty();
        let mut nearest: Option<(usize, Way)> = None;
        for (robot, &end) in ends.iter().enumerate() {
            let below = nearest.map_or(u16::MAX, |(_, way)| way.drives);
            nearest = self.way(end, |_, _| true, is_goal, below).map(|way| (robot, way)).or(nearest);
        }
        let (leader, way) = nearest?;
        let node = ends[leader];
        let sides = self.uncovered_by_all(node);
        let is_taken = |step: Step| ends.contains(&node.after(step));
        let is_stuck = way.drives == 0 && sides.iter().all(is_taken) && self.rule.has(Condition::MakesRoom);
        let other_end = sides.iter().next().filter(|_| is_stuck).map(|step| node.after(step));
        let shift = other_end.and_then(|other_end| self.shift(ends, [node, other_end]));
        let mut between = [[FAR; ROBOTS]; ROBOTS];
        if shift.is_none() {
            between.iter_mut().zip(ends).for_each(|(drives, &end)| *drives = self.drives(end, all));
        }
        Some(Lead { leader, sides: way.sides, between, shift })
    }

    /// The sides of where `robot` stands that it takes, if it is its part.
    fn part_of(&self, robot: usize, lead: &Lead<ROBOTS>, ends: &[Cell; ROBOTS]) -> Steps {
        let (at, count) = (ends[robot], usize::from(self.count));
        if let Some((shifts, step)) = lead.shift {
            let steps = if shifts == robot { Steps::only(step) } else { Steps::NONE };
            return self.admitted(robot, steps);
        }
        if robot == lead.leader {
            return self.admitted(robot, lead.sides);
        }
        let now = drives_to(lead.leader, &lead.between[..count]);
        let is_nearer = |step: Step| {
            let mut after = lead.between;
            after[robot] = self.drives(at.after(step), ends);
            for other in (0..ROBOTS).filter(|&other| other != robot) {
                after[other][robot] = after[robot][other];
            }
            drives_to(lead.leader, &after[..count]) < now
        };
        let free = self.paths(at).filter(|step| !ends[..count].contains(&at.after(step)));
        self.admitted(robot, free).filter(is_nearer)
    }

    /// Who shifts so that one of the two nodes is left, where robots are: the one beside the nearest free node.
    fn shift(&self, ends: &[Cell], nodes: [Cell; 2]) -> Option<(usize, Step)> {
        let mut queue = [0_usize; ROBOTS];
        let (mut first, mut last) = (0, 0);
        let mut seen: Set = 0;
        for node in nodes {
            let robot = ends.iter().position(|&end| end == node)?;
            (queue[last], seen) = (robot, seen | 1 << robot);
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
            ends.iter().enumerate().fold(0, |set, (robot, &end)| set | Set::from(is_beside(end)) << robot)
        };
        let (mut reached, mut new) = (0, beside(free));
        while new != 0 {
            reached |= new;
            new = robots(new).fold(0, |next, robot| next | beside(ends[robot])) & !reached;
        }
        reached == first_robots(ends.len())
    }
}

/// The drives of all robots to the leader, each over those that it is tied to, of the drives between each two of them.
fn drives_to<const ROBOTS: usize>(leader: usize, between: &[[u32; ROBOTS]]) -> u32 {
    let mut to_leader = [FAR; ROBOTS];
    to_leader[leader] = 0;
    for _ in 1..between.len() {
        for (one, drives) in between.iter().enumerate() {
            for (other, &drives) in drives.iter().enumerate().take(between.len()) {
                to_leader[one] = to_leader[one].min(to_leader[other].saturating_add(drives)).min(FAR);
            }
        }
    }
    to_leader[..between.len()].iter().sum()
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

    /// Three robots in these columns and rows of 4×4 nodes. Paths are driven, seen free by robots at both ends, or
    /// unknown; all others are blocked.
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
        let (robot, step) =
            kit.lead(&kit.crew.robots.map(|robot| robot.stance.to())).expect("an uncovered side").shift?;
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
