//! Which part a robot has in the way of the team to the next uncovered side (clauses KIT-6 to KIT-8, KIT-11). It is the
//! condition *Regroup*, which is ours.
//!
//! A *joint way* of two robots is made of single drives over paths driven before, after each of which both stand in reach of
//! each other and at different nodes; it ends where an uncovered side is admitted for one of them. Whoever has the turn takes
//! a drive with which a shortest joint way can begin. All pairs of nodes in reach are flooded at once: of each node one word
//! has a bit for each place of the other robot around it.
//!
//! Three robots and more have too many places for that. There the robot goes that can reach an uncovered side alone, the
//! others staying where they are; if there is none, the one nearest to an uncovered side leads, and the others come nearer to
//! it, one at a time. That always ends, but a way may be missed.

use super::rule::Condition;
use super::stance::{Stance, in_reach};
use super::team::Kit;
use crate::ground::{Cell, EdgeMark, Grid, Step, Steps};

/// Places of one robot round another, a bit for each: 8·(rows + 3) + columns + 3, of −3 to 3 columns and rows.
type Places = u64;

/// The bit of an offset of at most three columns and rows.
const fn bit(columns: i16, rows: i16) -> u32 {
    (8 * (rows + 3) + columns + 3) as u32
}

/// The places in reach, but for the very same node.
const IN_REACH: Places = {
    let mut places = 0;
    let mut place = 0;
    while place < 56 {
        let offset = Cell::new(place % 8 - 3, place / 8 - 3);
        if in_reach(Cell::new(0, 0), offset) && place != bit(0, 0) as i16 && place % 8 < 7 {
            places |= 1 << place;
        }
        place += 1;
    }
    places
};

/// The places after the other robot has taken this step.
const fn moved(places: Places, step: Step) -> Places {
    match step.place() {
        0 => places << 1,
        1 => places << 8,
        2 => places >> 1,
        3 => places >> 8,
        _ => places,
    }
}

/// The offsets of these places.
fn offsets(places: Places) -> impl Iterator<Item = (i16, i16)> {
    let mut rest = places;
    core::iter::from_fn(move || {
        let place = rest.trailing_zeros() as i16;
        rest &= rest.wrapping_sub(1);
        (place < 64).then_some((place % 8 - 3, place / 8 - 3))
    })
}

/// No way.
const FAR: u16 = u16::MAX;

/// What all robots know of each node, gathered once for a decision.
struct Map<const NODES: usize> {
    /// The sides that were driven.
    open: [Steps; NODES],
    /// The sides that nobody has covered, of nodes where robots have been or go.
    uncovered: [Steps; NODES],
}

impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// The sides that `robot`, which stands, can take as its part of a shortest way of the team to an uncovered side: none if
    /// others have to go first. `None` if there is no way.
    pub(super) fn part(&self, robot: usize) -> Option<Steps> {
        let goes_alone =
            ROBOTS == 1 || self.rule().has(Condition::Meanwhile) && self.another_drives_a_new_path(robot);
        if ROBOTS == 2 && !goes_alone {
            return self.joint(robot).map(|(_, sides)| sides);
        }
        let map = self.map();
        if goes_alone && let Some((_, sides)) = self.alone(robot, &map) {
            return Some(sides);
        }
        match ROBOTS {
            0 | 1 => None,
            2 => self.joint(robot).map(|(_, sides)| sides),
            _ => self.convoy(robot, &map),
        }
    }

    /// The single drives of a shortest joint way of two robots from where they go, before an uncovered side is admitted for
    /// one of them; `None` if there is none, or there are not two robots.
    pub fn joint_way(&self) -> Option<u32> {
        if ROBOTS == 2 { self.joint(0).map(|(length, _)| length) } else { None }
    }

    /// The length of a shortest joint way from where both robots go, and the sides with which `robot` can begin one.
    fn joint(&self, robot: usize) -> Option<(u32, Steps)> {
        let at = self.stance(robot)?.to();
        let other = self.others(robot).next()?.to();
        let (columns, rows) = (other.x.checked_sub(at.x)?, other.y.checked_sub(at.y)?);
        let admitted = if self.rule().has(Condition::Apart) { IN_REACH } else { IN_REACH | 1 << bit(0, 0) };
        let is_inside = columns.abs().max(rows.abs()) <= 3;
        let pair = 1_u64.checked_shl(if is_inside { bit(columns, rows) } else { 64 })? & admitted;
        let mut near = [0; NODES];
        self.put_goals(&mut near, admitted, [at, other]);
        let mut new = near;
        let place = self.place(at)?;
        let mut length = 0;
        while near[place] & pair == 0 {
            let mut next = [0; NODES];
            self.spread(&new, &mut next, admitted);
            let mut is_over = true;
            for (next, near) in next.iter_mut().zip(&near) {
                *next &= !near;
                is_over &= *next == 0;
            }
            if is_over {
                return None;
            }
            new = next;
            length += 1;
            if new[place] & pair != 0 {
                let open = self.known(EdgeMark::Open, at);
                let shortens = |step: Step| {
                    let node = self.place(at.after(step));
                    node.is_some_and(|node| near[node] & moved(pair, step.reverse()) & admitted != 0)
                };
                return Some((length, open.filter(|step| shortens(step) && self.admits(robot, step))));
            }
            for (near, new) in near.iter_mut().zip(&new) {
                *near |= new;
            }
        }
        Some((0, Steps::NONE))
    }

    /// Adds the pairs of nodes where an uncovered side is admitted for one robot or the other.
    fn put_goals(&self, near: &mut [Places; NODES], admitted: Places, ends: [Cell; 2]) {
        for (node, uncovered) in self.frontier(ends) {
            let after = |step: Step| admitted & moved(admitted, step);
            let goals = uncovered.iter().fold(0, |goals, step| goals | after(step));
            if let Some(place) = self.place(node) {
                near[place] |= goals;
            }
            for (columns, rows) in offsets(goals) {
                let other = Cell::new(node.x.saturating_add(columns), node.y.saturating_add(rows));
                if let Some(place) = self.place(other) {
                    near[place] |= 1 << bit(-columns, -rows);
                }
            }
        }
    }

    /// Adds to `next` the pairs of nodes that are one drive from those in `new`.
    fn spread(&self, new: &[Places; NODES], next: &mut [Places; NODES], admitted: Places) {
        for (place, &places) in new.iter().enumerate().filter(|&(_, &places)| places != 0) {
            let node = self.node(place);
            for step in self.known(EdgeMark::Open, node).iter() {
                if let Some(beyond) = self.place(node.after(step)) {
                    next[beyond] |= moved(places, step.reverse()) & admitted;
                }
            }
            for (columns, rows) in offsets(places) {
                let other = Cell::new(node.x.saturating_add(columns), node.y.saturating_add(rows));
                for step in self.known(EdgeMark::Open, other).iter() {
                    next[place] |= moved(1 << bit(columns, rows), step) & admitted;
                }
            }
        }
    }

    /// The drives that `robot` has to make alone, the others where they go, before an uncovered side is admitted for it, and
    /// the sides with which it can begin.
    fn alone(&self, robot: usize, map: &Map<NODES>) -> Option<(u16, Steps)> {
        let at = self.stance(robot)?.to();
        let is_admitted = |node: Cell, step: Step| {
            self.admits_path(robot, Stance::Drives { from: node, to: node.after(step) })
        };
        let is_goal = |node: Cell, uncovered: Steps| uncovered.iter().any(|step| is_admitted(node, step));
        let ways = self.flood(map, is_goal, |node| self.admits_path(robot, Stance::Stands(node)));
        let length = ways[self.place(at)?];
        (length != FAR).then(|| (length, self.shortening(robot, &ways)))
    }

    /// The part of `robot` in a team of three and more.
    fn convoy(&self, robot: usize, map: &Map<NODES>) -> Option<Steps> {
        let alone = |robot: usize| Some((self.alone(robot, map)?.0, robot));
        if let Some((_, first)) = (0..ROBOTS).filter_map(alone).min() {
            return Some(if first == robot { self.alone(robot, map)?.1 } else { Steps::NONE });
        }
        let to_goals = self.flood(map, |_, uncovered| !uncovered.is_empty(), |_| true);
        let way = |robot: usize| Some((to_goals[self.place(self.stance(robot)?.to())?], robot));
        let (_, leader) = (0..ROBOTS).filter_map(way).min().filter(|&(length, _)| length != FAR)?;
        let lead = self.shortening(leader, &to_goals);
        if !lead.is_empty() {
            return Some(if leader == robot { lead } else { Steps::NONE });
        }
        let goal = self.stance(leader)?.to();
        let to_leader = self.flood(map, |node, _| node == goal, |_| true);
        let others = (0..ROBOTS).filter(|&other| other != leader);
        let (follower, sides) = others
            .map(|other| (other, self.shortening(other, &to_leader)))
            .find(|(_, sides)| !sides.is_empty())?;
        Some(if follower == robot { sides } else { Steps::NONE })
    }

    /// The sides of where `robot` stands that shorten its way, as far as they are admitted.
    fn shortening(&self, robot: usize, ways: &[u16; NODES]) -> Steps {
        let Some(at) = self.stance(robot).filter(|stance| stance.stands()).map(Stance::to) else {
            return Steps::NONE;
        };
        let way = |node| self.place(node).map_or(FAR, |place| ways[place]);
        let is_nearer = |step: Step| way(at.after(step)) < way(at) && self.admits(robot, step);
        self.known(EdgeMark::Open, at).filter(is_nearer)
    }

    /// What all robots know.
    fn map(&self) -> Map<NODES> {
        let mut map = Map { open: [Steps::NONE; NODES], uncovered: [Steps::NONE; NODES] };
        for node in self.records()[0].area().cells() {
            let Some(place) = self.place(node) else { continue };
            let open = self.known(EdgeMark::Open, node);
            if !open.is_empty() || self.robots.iter().any(|robot| robot.stance.to() == node) {
                (map.open[place], map.uncovered[place]) = (open, self.uncovered_by_all(node));
            }
        }
        map
    }

    /// Of each node the fewest drives over known paths, through nodes that are admitted, to a goal: a visited node, by its
    /// uncovered sides.
    fn flood(
        &self,
        map: &Map<NODES>,
        is_goal: impl Fn(Cell, Steps) -> bool,
        is_admitted: impl Fn(Cell) -> bool,
    ) -> [u16; NODES] {
        let mut ways = [FAR; NODES];
        let mut queue = [0_u16; NODES];
        let (mut first, mut last) = (0, 0);
        for (place, (&open, &uncovered)) in map.open.iter().zip(&map.uncovered).enumerate() {
            let is_visited = !open.is_empty() || !uncovered.is_empty();
            let node = self.node(place);
            if is_visited && is_goal(node, uncovered) && is_admitted(node) {
                (ways[place], queue[last]) = (0, place as u16);
                last += 1;
            }
        }
        while first < last {
            let from = usize::from(queue[first]);
            first += 1;
            let node = self.node(from);
            for step in map.open[from].iter() {
                let beyond = node.after(step);
                if let Some(place) = self.place(beyond)
                    && ways[place] == FAR
                    && is_admitted(beyond)
                {
                    (ways[place], queue[last]) = (ways[from].saturating_add(1), place as u16);
                    last += 1;
                }
            }
        }
        ways
    }

    /// The nodes where robots have been or go, and those of `ends`.
    fn visited(&self, ends: [Cell; 2]) -> impl Iterator<Item = Cell> {
        let area = self.records()[0].area();
        area.cells().filter(move |node| ends.contains(node) || !self.known(EdgeMark::Open, *node).is_empty())
    }

    /// The visited nodes with uncovered sides.
    fn frontier(&self, ends: [Cell; 2]) -> impl Iterator<Item = (Cell, Steps)> {
        let with_sides = |node| (node, self.uncovered_by_all(node));
        self.visited(ends).map(with_sides).filter(|(_, uncovered)| !uncovered.is_empty())
    }

    /// The sides of `node` that nobody has covered.
    pub fn uncovered_by_all(&self, node: Cell) -> Steps {
        let known = self.known(EdgeMark::Open, node).or(self.known(EdgeMark::Wall, node));
        Steps::ALL.without(Step::Stay).minus(known)
    }

    fn place(&self, node: Cell) -> Option<usize> {
        let area = self.records()[0].area();
        area.locate(node).map(|(column, row)| row * area.width() + column).filter(|&place| place < NODES)
    }

    fn node(&self, place: usize) -> Cell {
        let area = self.records()[0].area();
        let (column, row) = (place % area.width(), place / area.width());
        Cell::new(area.first().x.wrapping_add(column as i16), area.first().y.wrapping_add(row as i16))
    }
}
