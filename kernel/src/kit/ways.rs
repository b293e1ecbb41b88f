//! Which part a robot has in the way of the team to the next uncovered side (clauses KIT-6 to KIT-8, KIT-11, KIT-13,
//! KIT-14). It is the condition *Regroup*, which is ours.
//!
//! A *joint way* of two robots is made of single drives over paths driven before, after each of which both stand in
//! reach of each other and at different nodes; it ends where an uncovered side is admitted for one of them. Whoever has
//! the turn takes a drive with which a shortest joint way can begin. All pairs of nodes in reach are flooded at once:
//! of each node one word has a bit for each place of the other robot around it. The flood goes from where the robots go
//! as far as the nearest uncovered side, and comes back from all that are so near.
//!
//! Three robots and more have too many places for that. There the robot goes that can come to an
//! uncovered side alone, the others staying where they go; if there is none, all go together: see
//! `caravan.rs`. So does a robot that has no others.

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
    /// The sides that `robot`, which stands, can take as its part of a shortest way of the team to an uncovered side:
    /// none if others have to go first. `None` if there is no way.
    pub(super) fn part(&self, robot: usize) -> Option<Steps> {
        if self.count != 2 {
            return self.together(robot);
        }
        let mut others = self.robots().iter().enumerate().filter(|&(other, _)| other != robot);
        let drives_new_path = others.any(|(_, other)| other.is_new && !other.stance.stands());
        let goes_alone = self.rule().has(Condition::Meanwhile) && drives_new_path;
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
        if self.goals(place, pair, admitted) != 0 {
            return Some(Steps::NONE);
        }
        // Each drive changes the sum of all columns and rows by one, so pairs beside one are a drive farther or nearer:
        // the second bit of their drives tells which.
        let (mut near, mut second): (Pairs<NODES>, Pairs<NODES>) = ([0; NODES], [0; NODES]);
        let mut levels = [Level::<NODES>::NONE, Level::NONE];
        let [new, next] = &mut levels;
        new.add(place, pair);
        let mut drives = 0_u32;
        loop {
            next.clear();
            for (node, places) in new.nodes() {
                near[node] |= places;
                second[node] |= if drives & 2 == 0 { 0 } else { places };
                next.add(node, self.goals(node, places, admitted));
            }
            if next.count > 0 {
                break;
            }
            self.spread(new, next, |node| admitted & !near[node]);
            if next.count == 0 {
                return None;
            }
            core::mem::swap(new, next);
            drives += 1;
        }
        for before in (1..drives).rev() {
            core::mem::swap(new, next);
            let is_second = |node: usize| if before & 2 == 0 { !second[node] } else { second[node] };
            self.spread(new, next, |node| near[node] & is_second(node));
        }
        let nearer = self.known(EdgeMark::Open, at).filter(|step| {
            let node = self.place(at.after(step));
            node.is_some_and(|node| next.pairs[node] & moved(pair, step.reverse()) & admitted != 0)
        });
        Some(self.admitted(robot, nearer))
    }

    /// Those of the places of the other robot around a node for which an uncovered side is admitted for one of both.
    fn goals(&self, node: usize, places: Places, admitted: Places) -> Places {
        let at = self.node(node);
        let uncovered = |node: Cell| self.uncovered_by_all(node).iter();
        let own = uncovered(at).fold(0, |goals, step| goals | moved(admitted, step));
        offsets(places & !own).fold(places & own, |goals, (columns, rows)| {
            let place = 1 << bit(columns, rows);
            let mut after = uncovered(at.at_offset(columns, rows)).map(|step| moved(place, step));
            if after.any(|place| place & admitted != 0) { goals | place } else { goals }
        })
    }

    /// Makes `next` those of the pairs one drive from those in `new` that are `among` those of their nodes.
    fn spread(&self, new: &Level<NODES>, next: &mut Level<NODES>, among: impl Fn(usize) -> Places) {
        next.clear();
        for (place, places) in new.nodes() {
            let node = self.node(place);
            for step in self.known(EdgeMark::Open, node).iter() {
                if let Some(beyond) = self.place(node.after(step)) {
                    next.add(beyond, moved(places, step.reverse()) & among(beyond));
                }
            }
            for offset in offsets(places) {
                for step in self.known(EdgeMark::Open, node.at_offset(offset.0, offset.1)).iter() {
                    next.add(place, moved(1 << bit(offset.0, offset.1), step) & among(place));
                }
            }
        }
    }
}
