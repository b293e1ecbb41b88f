//! Runs of three robots and more by the repaired rule (KIT-8), as `SPEC.md` has it under “KIT: three robots and
//! more”.

use std::collections::{BTreeMap, BTreeSet};

use super::super::change::plain;
use super::super::{Case, Lattice, Objection, Place, SIDES, beside, must, path};
use super::{Look, Sees, Step, What, in_reach, sees};

/// A run of robots by the repaired rule.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Party {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The nodes, and the walls that the robots meet.
    pub lattice: Lattice,
    /// Where each robot starts.
    pub starts: Vec<Place>,
    /// The steps, in order.
    pub steps: Vec<Step>,
}

plain!(Party { lattice, starts, steps });

/// The task of a robot that stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Rest {
    Asks,
    Stays,
    Done,
}

/// Both ends of a stance, or of a path.
type Ends = [Place; 2];

/// Sides.
type Sides = BTreeSet<usize>;

struct Team<'a> {
    lattice: &'a Lattice,
    stances: Vec<Ends>,
    rests: Vec<Rest>,
    turn: usize,
    driven: BTreeSet<(Place, Place)>,
    /// Paths that were seen blocked, and those that were seen free between two robots.
    blocked: BTreeSet<(Place, Place)>,
    free: BTreeSet<(Place, Place)>,
}

impl Party {
    /// Whether the judge reads runs that are said to break this clause.
    pub fn knows(clause: &str) -> bool {
        clause == "KIT-8"
    }
}

impl Case for Party {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { lattice, starts, .. } = self;
        must(Self::knows(self.clause), "the judge does not know this clause")?;
        let alone: BTreeSet<Place> = starts.iter().copied().collect();
        let are_there = starts.iter().all(|&start| lattice.has(start));
        must(
            starts.len() > 2 && alone.len() == starts.len() && are_there,
            "three robots start at nodes of their own",
        )?;
        let stances: Vec<Ends> = starts.iter().map(|&start| [start; 2]).collect();
        must(
            parts(&(0..starts.len()).collect(), |one, other| hears(stances[one], stances[other])).len() == 1,
            "robots start out of contact",
        )?;
        let rests = vec![Rest::Asks; starts.len()];
        let [driven, blocked, free] = [(); 3].map(|()| BTreeSet::new());
        let mut team = Team { lattice, stances, rests, turn: 0, driven, blocked, free };
        for (number, step) in (1..).zip(&self.steps) {
            team.step(step).map_err(|what| Objection { at: number, what })?;
        }
        must(lattice.barred.is_subset(&team.blocked), "a wall was never met")?;
        let goes_on = (0..starts.len()).any(|robot| team.drives(robot) || team.may_decide(robot));
        must(!goes_on, "the run goes on")?;
        Ok(must(team.rests.contains(&Rest::Stays), "all robots know that the run is over")?)
    }
}

fn hears(one: Ends, other: Ends) -> bool {
    one.iter().all(|&one| other.iter().all(|&other| in_reach(one, other)))
}

/// The sets into which pairs join these robots.
fn parts(robots: &BTreeSet<usize>, joins: impl Fn(usize, usize) -> bool) -> Vec<BTreeSet<usize>> {
    let mut parts: Vec<BTreeSet<usize>> = Vec::new();
    for &robot in robots {
        let (near, far): (Vec<_>, Vec<_>) = parts
            .into_iter()
            .partition(|part: &BTreeSet<usize>| part.iter().any(|&other| joins(robot, other)));
        let part = near.into_iter().flatten().chain([robot]).collect();
        parts = far.into_iter().chain([part]).collect();
    }
    parts
}

impl Team<'_> {
    fn drives(&self, robot: usize) -> bool {
        self.stances[robot][0] != self.stances[robot][1]
    }

    fn may_decide(&self, robot: usize) -> bool {
        self.turn == robot && !self.drives(robot) && self.rests[robot] == Rest::Asks
    }

    /// The turn passes to the next robot that stands and asks, if there is one; to the robot itself if it does.
    fn pass_turn(&mut self) {
        let count = self.stances.len();
        let after = (0..count).map(|step| (self.turn + step) % count);
        let next = after.into_iter().find(|&robot| !self.drives(robot) && self.rests[robot] == Rest::Asks);
        self.turn = next.unwrap_or(self.turn);
    }

    /// Another robot that stays decides anew.
    fn change(&mut self, robot: usize) {
        for (other, rest) in self.rests.iter_mut().enumerate() {
            if other != robot && *rest == Rest::Stays {
                *rest = Rest::Asks;
            }
        }
        self.pass_turn();
    }

    fn step(&mut self, step: &Step) -> Result<(), &'static str> {
        let robot = step.robot;
        must(robot < self.stances.len(), "there is no such robot")?;
        if step.what == What::Arrives {
            must(self.drives(robot) && step.looks.is_empty(), "a robot that does not drive does not arrive")?;
            self.stances[robot] = [self.stances[robot][1]; 2];
            self.change(robot);
            return Ok(());
        }
        must(self.may_decide(robot), "this robot may not decide now")?;
        let mut looks = step.looks.iter();
        let at = self.stances[robot][0];
        let stands_there = |team: &Self, side: usize| {
            beside(at, side)
                .is_some_and(|to| team.stances.contains(&[to; 2]) && !team.free.contains(&path(at, to)))
        };
        for side in
            self.uncovered(at).into_iter().filter(|&side| stands_there(self, side)).collect::<Vec<_>>()
        {
            let look = looks
                .next()
                .filter(|look| look.side == side)
                .ok_or("a robot looks first where another one stands")?;
            self.sees(robot, look)?;
            if look.sees != Sees::Obstacle {
                self.free.extend(beside(at, side).map(|to| path(at, to)));
                self.change(robot);
            }
        }
        let mut left: Sides = self.admitted(robot, self.uncovered(at));
        if self.take(robot, &mut left, &mut looks)? {
            return self.drive(robot, step);
        }
        let part = self.part(robot);
        let mut left = part.clone().unwrap_or_default();
        if self.take(robot, &mut left, &mut looks)? {
            return self.drive(robot, step);
        }
        must(looks.next().is_none(), "the rule does not look there")?;
        let is_over = part.is_none() && (0..self.stances.len()).all(|robot| !self.drives(robot));
        let (what, rest) = if is_over { (What::IsDone, Rest::Done) } else { (What::Stays, Rest::Stays) };
        must(step.what == what, "a robot stays, or is done, when it is not")?;
        self.rests[robot] = rest;
        self.pass_turn();
        Ok(())
    }

    /// Looks at sides of these in any order until one is free; whether one is.
    fn take<'s>(
        &mut self,
        robot: usize,
        left: &mut Sides,
        looks: &mut impl Iterator<Item = &'s Look>,
    ) -> Result<bool, &'static str> {
        while !left.is_empty() {
            let look = looks.next().ok_or("there is a side left to look at")?;
            must(left.remove(&look.side), "the rule does not look there")?;
            self.sees(robot, look)?;
            if look.sees == Sees::Free {
                must(looks.next().is_none(), "a robot looks on though a side is free")?;
                let at = self.stances[robot][0];
                self.stances[robot][1] = beside(at, look.side).unwrap_or(at);
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn drive(&mut self, robot: usize, step: &Step) -> Result<(), &'static str> {
        must(step.what == What::Drives, "a robot drives through a free side")?;
        let [from, to] = self.stances[robot];
        self.driven.insert(path(from, to));
        self.change(robot);
        Ok(())
    }

    fn sees(&mut self, robot: usize, look: &Look) -> Result<(), &'static str> {
        let others: Vec<Ends> = (0..self.stances.len())
            .filter(|&other| other != robot)
            .map(|other| self.stances[other])
            .collect();
        if let Some(blocked) = sees(self.lattice, self.stances[robot][0], look, &others)? {
            self.blocked.insert(blocked);
            self.change(robot);
        }
        Ok(())
    }

    /// The uncovered sides of a node.
    fn uncovered(&self, node: Place) -> Sides {
        let is_uncovered = |side: &usize| {
            beside(node, *side).is_some_and(|to| {
                let path = path(node, to);
                self.lattice.has(to) && !self.driven.contains(&path) && !self.blocked.contains(&path)
            })
        };
        (0..SIDES.len()).filter(is_uncovered).collect()
    }

    /// The nodes beside a node over known paths, and this one besides.
    fn known(&self, node: Place, also: Option<Ends>) -> Vec<(usize, Place)> {
        let all = (0..SIDES.len()).filter_map(|side| Some((side, beside(node, side)?)));
        let is_known = |to: Place| {
            let also = also.is_some_and(|[one, other]| path(one, other) == path(node, to));
            also || self.driven.contains(&path(node, to)) || self.free.contains(&path(node, to))
        };
        all.filter(|&(_, to)| is_known(to)).collect()
    }

    /// The nodes that known paths within one field join to a node, each with the fewest drives.
    fn near(&self, node: Place, also: Option<Ends>) -> BTreeMap<Place, usize> {
        let mut near = BTreeMap::from([(node, 0)]);
        for (columns, rows) in [(3, 3), (4, 2), (2, 4)] {
            for (x, y) in (0..columns).flat_map(|x| (0..rows).map(move |y| (node.0 - x, node.1 - y))) {
                let inside = |to: Place| (x..x + columns).contains(&to.0) && (y..y + rows).contains(&to.1);
                let (mut reached, mut rim) = (BTreeSet::from([node]), vec![node]);
                for drives in 1.. {
                    let next = rim.iter().flat_map(|&node| self.known(node, also)).map(|(_, to)| to);
                    rim = next.filter(|&to| inside(to) && reached.insert(to)).collect();
                    if rim.is_empty() {
                        break;
                    }
                    for &to in &rim {
                        let fewest = near.entry(to).or_insert(drives);
                        *fewest = drives.min(*fewest);
                    }
                }
            }
        }
        near
    }

    /// Whether a robot may drive a path while the others are so: no other one has an end of its stance there; of
    /// those that hear each other without it, it hears one; and of those that are tied to each other without it, and
    /// to it, it stays tied to one.
    fn lets(&self, stances: &[Ends], robot: usize, path_of: Ends) -> bool {
        let [from, to] = path_of;
        let others: BTreeSet<usize> = (0..stances.len()).filter(|&other| other != robot).collect();
        if others.iter().any(|&other| stances[other].contains(&to)) {
            return false;
        }
        let is_tied =
            |one: usize, other: usize| self.near(stances[one][1], None).contains_key(&stances[other][1]);
        let is_new = !self.known(to, None).iter().any(|&(_, node)| node == from);
        let near = self.near(to, is_new.then_some(path_of));
        let heard = parts(&others, |one, other| hears(stances[one], stances[other]));
        heard.iter().all(|part| part.iter().any(|&other| hears(stances[other], path_of)))
            && parts(&others, is_tied)
                .iter()
                .filter(|part| part.iter().any(|&other| is_tied(other, robot)))
                .all(|part| part.iter().any(|&other| near.contains_key(&stances[other][1])))
    }

    fn admitted(&self, robot: usize, sides: Sides) -> Sides {
        let at = self.stances[robot][1];
        let lets =
            |side: &usize| beside(at, *side).is_some_and(|to| self.lets(&self.stances, robot, [at, to]));
        sides.into_iter().filter(lets).collect()
    }

    /// The shortest ways from a node over known paths that may be driven to a goal: how many drives they have, and
    /// the sides with which they begin.
    fn way(
        &self,
        from: Place,
        may: impl Fn(Ends) -> bool,
        is_goal: impl Fn(Place) -> bool,
    ) -> Option<(usize, Sides)> {
        let (mut reached, mut rim) = (BTreeSet::from([from]), BTreeMap::from([(from, Sides::new())]));
        for drives in 0.. {
            let goals: Vec<&Sides> =
                rim.iter().filter(|(node, _)| is_goal(**node)).map(|(_, begins)| begins).collect();
            if !goals.is_empty() {
                return Some((drives, goals.into_iter().flatten().copied().collect()));
            }
            let mut next: BTreeMap<Place, Sides> = BTreeMap::new();
            for (&node, begins) in &rim {
                for (side, to) in self
                    .known(node, None)
                    .into_iter()
                    .filter(|&(_, to)| !reached.contains(&to) && may([node, to]))
                {
                    let first = if drives == 0 { Sides::from([side]) } else { begins.clone() };
                    next.entry(to).or_default().extend(first);
                }
            }
            if next.is_empty() {
                break;
            }
            reached.extend(next.keys());
            rim = next;
        }
        None
    }

    /// The way of a robot alone to a node from which it may drive through an uncovered side, the others standing so.
    fn alone(&self, stances: &[Ends], robot: usize) -> Option<(usize, Sides)> {
        let may = |path: Ends| self.lets(stances, robot, path);
        let is_goal = |node: Place| {
            let mut sides = self.uncovered(node).into_iter().filter_map(|side| beside(node, side));
            sides.any(|to| may([node, to]))
        };
        self.way(stances[robot][1], may, is_goal)
    }

    /// The part of a robot in the way of the team: none if there is no way.
    fn part(&self, robot: usize) -> Option<Sides> {
        let stances: Vec<Ends> = self.stances.iter().map(|&[_, to]| [to; 2]).collect();
        let ways: Vec<Option<(usize, Sides)>> =
            (0..stances.len()).map(|robot| self.alone(&stances, robot)).collect();
        if ways.iter().all(Option::is_none) {
            let parts: Vec<Sides> =
                (0..stances.len()).map(|robot| self.caravan(&stances, robot)).collect::<Option<_>>()?;
            return parts.iter().any(|part| !part.is_empty()).then(|| parts[robot].clone());
        }
        let Some((own, sides)) = ways[robot].clone() else { return Some(Sides::new()) };
        // It makes the way of no robot longer that has a shorter one, or one as short and a lesser number.
        let keeps = |side: &usize| {
            let mut after = stances.clone();
            after[robot] = beside(after[robot][0], *side).map_or(after[robot], |to| [to; 2]);
            (0..stances.len()).all(|other| match ways[other] {
                Some((drives, _)) if (drives, other) < (own, robot) => {
                    self.alone(&after, other).is_some_and(|(then, _)| then <= drives)
                }
                _ => true,
            })
        };
        Some(self.admitted(robot, sides.into_iter().filter(keeps).collect()))
    }

    /// The part of a robot when no robot has a way alone; none if no robot is near an uncovered side.
    fn caravan(&self, stances: &[Ends], robot: usize) -> Option<Sides> {
        let ends: Vec<Place> = stances.iter().map(|stance| stance[1]).collect();
        let is_goal = |node: Place| !self.uncovered(node).is_empty();
        let ways = ends.iter().map(|&from| self.way(from, |_| true, is_goal));
        let (drives, leader, sides) = (0..)
            .zip(ways)
            .filter_map(|(robot, way)| way.map(|(drives, sides)| (drives, robot, sides)))
            .min_by_key(|&(drives, robot, _)| (drives, robot))?;
        let at = ends[leader];
        let ahead: Vec<Place> = self.uncovered(at).into_iter().filter_map(|side| beside(at, side)).collect();
        if drives == 0 && ahead.iter().all(|to| ends.contains(to)) {
            let shift = ahead.first().and_then(|&other| self.shift(&ends, [at, other]));
            if let Some((shifts, side)) = shift {
                let sides = if shifts == robot { Sides::from([side]) } else { Sides::new() };
                return Some(self.admitted(robot, sides));
            }
        }
        if robot == leader {
            return Some(self.admitted(robot, sides));
        }
        let now = self.drives_to(&ends, leader);
        let nearer = self.known(ends[robot], None).into_iter().filter(|&(_, to)| {
            let mut after = ends.clone();
            after[robot] = to;
            !ends.contains(&to) && self.drives_to(&after, leader) < now
        });
        Some(self.admitted(robot, nearer.map(|(side, _)| side).collect()))
    }

    /// The drives of all robots to the leader, each over those that it is tied to.
    fn drives_to(&self, ends: &[Place], leader: usize) -> usize {
        const FAR: usize = 1 << 16;
        let near: Vec<BTreeMap<Place, usize>> = ends.iter().map(|&end| self.near(end, None)).collect();
        let mut far = vec![FAR; ends.len()];
        far[leader] = 0;
        for _ in ends {
            for (one, other) in (0..ends.len()).flat_map(|one| (0..ends.len()).map(move |other| (one, other)))
            {
                let between = near[one].get(&ends[other]).copied().unwrap_or(FAR);
                far[one] = far[one].min((far[other] + between).min(FAR));
            }
        }
        far.iter().sum()
    }

    /// The robot that shifts so that one of the two nodes is left, and the side: the first beside the nearest free
    /// node with which known paths join all robots.
    fn shift(&self, ends: &[Place], nodes: Ends) -> Option<(usize, usize)> {
        let robot_at = |node: Place| ends.iter().position(|&end| end == node);
        let mut queue: Vec<usize> = nodes.into_iter().filter_map(robot_at).collect();
        let mut place = 0;
        while let Some(&robot) = queue.get(place) {
            place += 1;
            for (side, to) in self.known(ends[robot], None) {
                match robot_at(to) {
                    None => {
                        let all: BTreeSet<usize> = (0..=ends.len()).collect();
                        let node = |robot: usize| ends.get(robot).copied().unwrap_or(to);
                        let joins = |one: usize, other: usize| {
                            self.known(node(one), None).iter().any(|&(_, beyond)| beyond == node(other))
                        };
                        if parts(&all, joins).len() == 1 {
                            return Some((robot, side));
                        }
                    }
                    Some(other) if !queue.contains(&other) => queue.push(other),
                    Some(_) => {}
                }
            }
        }
        None
    }
}
