//! Which part a robot has in the way of the team to the next uncovered side (clauses KIT-6 to KIT-8, KIT-11, KIT-13). It is the
//! condition *Regroup*, which is ours.
//!
//! A *joint way* of two robots is made of single drives over paths driven before, after each of which both stand in reach of
//! each other and at different nodes; it ends where an uncovered side is admitted for one of them. Whoever has the turn takes
//! a drive with which a shortest joint way can begin. All pairs of nodes in reach are flooded at once: of each node one word
//! has a bit for each place of the other robot around it. A first flood goes from where the robots go as far as the nearest
//! uncovered side, and a second one comes back from all that are so near.
//!
//! Three robots and more have too many places for that. There the robot goes that can come to an uncovered side alone, the
//! others staying where they go; if there is none, all go together: see `caravan.rs`. So does a robot that has no others.

use super::around::{HERE, Places, bit, in_reach, moved, offsets, place_of};
use super::rule::Condition;
use super::team::Kit;
use crate::ground::{Cell, EdgeMark, Grid, Steps};

/// Pairs of nodes: of each node of one robot the places of the other one around it.
type Pairs<const NODES: usize> = [Places; NODES];

/// Pairs, with a list of the nodes that have some.
struct Level<const NODES: usize> {
    pairs: Pairs<NODES>,
    nodes: [u16; NODES],
    count: usize,
}

impl<const NODES: usize> Level<NODES> {
    const NONE: Self = Self { pairs: [0; NODES], nodes: [0; NODES], count: 0 };

    fn add(&mut self, node: usize, places: Places) {
        if self.pairs[node] == 0 && places != 0 {
            self.nodes[self.count] = node as u16;
            self.count += 1;
        }
        self.pairs[node] |= places;
    }

    fn nodes(&self) -> impl Iterator<Item = (usize, Places)> {
        let nodes = self.nodes[..self.count].iter().map(|&node| usize::from(node));
        nodes.map(|node| (node, self.pairs[node]))
    }

    fn clear(&mut self) {
        for &node in &self.nodes[..self.count] {
            self.pairs[usize::from(node)] = 0;
        }
        self.count = 0;
    }
}

impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// The sides that `robot`, which stands, can take as its part of a shortest way of the team to an uncovered side: none if
    /// others have to go first. `None` if there is no way.
    pub(super) fn part(&self, robot: usize) -> Option<Steps> {
        if self.count != 2 {
            return self.together(robot);
        }
        let goes_alone = self.rule().has(Condition::Meanwhile) && self.another_drives_a_new_path(robot);
        let alone = if goes_alone { self.alone(robot, &self.formation(), u16::MAX) } else { None };
        alone.map(|way| way.sides).or_else(|| self.joint(robot))
    }

    /// The sides with which `robot` can begin a shortest joint way from where both robots go; `None` if there is none.
    fn joint(&self, robot: usize) -> Option<Steps> {
        let at = self.stance(robot)?.to();
        let other = self.others(robot).next()?.to();
        let around = in_reach(self.rule().reach);
        let admitted = if self.rule().has(Condition::Apart) { around } else { around | HERE };
        let pair = place_of(at, other)? & admitted;
        let place = self.place(at).filter(|_| pair != 0)?;
        let ends = [at, other];
        let length = self.joint_length((place, pair), admitted, ends)?;
        if length == 0 {
            return Some(Steps::NONE);
        }
        let mut near: Pairs<NODES> = [0; NODES];
        let mut levels = [Level::<NODES>::NONE, Level::NONE];
        let [new, next] = &mut levels;
        self.put_goals(new, admitted, ends, length);
        for step in 1..=length {
            for (node, places) in new.nodes() {
                near[node] |= places;
            }
            if step < length {
                self.spread(new, next, &near, admitted);
                core::mem::swap(new, next);
            }
        }
        let open = self.known(EdgeMark::Open, at);
        let nearer = open.filter(|step| {
            let node = self.place(at.after(step));
            node.is_some_and(|node| near[node] & moved(pair, step.reverse()) & admitted != 0)
        });
        Some(self.admitted(robot, nearer))
    }

    /// The single drives from this pair of nodes to the nearest one with an uncovered side.
    fn joint_length(&self, (place, pair): (usize, Places), admitted: Places, ends: [Cell; 2]) -> Option<u32> {
        let mut near: Pairs<NODES> = [0; NODES];
        let mut levels = [Level::<NODES>::NONE, Level::NONE];
        let [new, next] = &mut levels;
        new.add(place, pair);
        // Each drive leads to at least one pair of nodes that was not near before.
        for length in 0..NODES as u32 * Places::BITS {
            if new.count == 0 {
                break;
            }
            for (node, places) in new.nodes() {
                near[node] |= places;
                let at = self.node(node);
                let is_goal = |offset: (i16, i16)| {
                    let goals = self.goals(at.at_offset(offset.0, offset.1), admitted, ends);
                    goals & 1 << bit(-offset.0, -offset.1) != 0
                };
                if self.goals(at, admitted, ends) & places != 0 || offsets(places).any(is_goal) {
                    return Some(length);
                }
            }
            self.spread(new, next, &near, admitted);
            core::mem::swap(new, next);
        }
        None
    }

    /// The places of the other robot for which an uncovered side of `node` is admitted for the one that stands there.
    fn goals(&self, node: Cell, admitted: Places, ends: [Cell; 2]) -> Places {
        if self.known(EdgeMark::Open, node).is_empty() && !ends.contains(&node) {
            return 0;
        }
        let uncovered = self.uncovered_by_all(node);
        uncovered.iter().fold(0, |goals, step| goals | admitted & moved(admitted, step))
    }

    /// Adds the pairs of nodes where an uncovered side is admitted for one robot or the other, as far as one of them can come to
    /// its node in so many drives.
    fn put_goals(&self, level: &mut Level<NODES>, admitted: Places, ends: [Cell; 2], drives: u32) {
        let area = self.union.area();
        let far = i16::try_from(drives).unwrap_or(i16::MAX);
        let rows = |cell: Cell| cell.y.saturating_sub(far)..=cell.y.saturating_add(far);
        let columns = |cell: Cell| cell.x.saturating_sub(far)..=cell.x.saturating_add(far);
        let [one, other] = ends;
        let (first, last) = (area.first(), area.last());
        let y = first.y.max(*rows(one).start().min(rows(other).start()))
            ..=last.y.min(*rows(one).end().max(rows(other).end()));
        for y in y {
            let x = first.x.max(*columns(one).start().min(columns(other).start()))
                ..=last.x.min(*columns(one).end().max(columns(other).end()));
            for x in x {
                let node = Cell::new(x, y);
                let goals = self.goals(node, admitted, ends);
                let Some(place) = self.place(node).filter(|_| goals != 0) else { continue };
                level.add(place, goals);
                for offset in offsets(goals) {
                    if let Some(place) = self.place(node.at_offset(offset.0, offset.1)) {
                        level.add(place, 1 << bit(-offset.0, -offset.1));
                    }
                }
            }
        }
    }

    /// Makes `next` the pairs of nodes that are one drive from those in `new` and not among those `near`.
    fn spread(&self, new: &Level<NODES>, next: &mut Level<NODES>, near: &Pairs<NODES>, admitted: Places) {
        next.clear();
        for (place, places) in new.nodes() {
            let node = self.node(place);
            for step in self.known(EdgeMark::Open, node).iter() {
                if let Some(beyond) = self.place(node.after(step)) {
                    next.add(beyond, moved(places, step.reverse()) & admitted & !near[beyond]);
                }
            }
            for offset in offsets(places) {
                for step in self.known(EdgeMark::Open, node.at_offset(offset.0, offset.1)).iter() {
                    next.add(place, moved(1 << bit(offset.0, offset.1), step) & admitted & !near[place]);
                }
            }
        }
    }
}
