//! The demands that a drive or a stay breaks on a small lattice.

use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, Side, Step, Steps};
use tautline_kernel::kit::{Condition, Stance};

use super::{Demand, Setting, Speeds, World};
use crate::kit::plain::{Findings, hear};

impl<const ROBOTS: usize> Setting<ROBOTS> {
    pub(super) fn broken_by_marks(&self, world: &World<ROBOTS>) -> Vec<Demand> {
        if !self.is_wanted(Demand::Marks) {
            return Vec::new();
        }
        let map = self.found(world);
        let is_covered = |node, side| {
            let edge = Edge::new(node, side);
            map.edge_has(EdgeMark::Open, edge) || map.edge_has(EdgeMark::Wall, edge)
        };
        let sides =
            |node| Steps::ALL.filter(|step| matches!(step, Step::Cross(side) if is_covered(node, side)));
        let is_right = |node| {
            let sides = sides(node);
            (0..ROBOTS).all(|robot| world.team.covered(robot, node) == sides)
        };
        if self.area.cells().all(is_right) { Vec::new() } else { vec![Demand::Marks] }
    }

    /// The demand broken by an arrival.
    pub(in crate::kit) fn broken_by_arrival(&self, world: &World<ROBOTS>, robot: usize) -> Option<Demand> {
        let others: Vec<(usize, Stance)> =
            world.team.stances().enumerate().filter(|&(other, _)| other != robot).collect();
        let stands = world.team.stance(robot)?;
        let all_stand = others.iter().all(|(_, other)| other.stands());
        (self.is_wanted(Demand::AtNodes) && all_stand && !self.is_in_contact(&others, stands))
            .then_some(Demand::AtNodes)
    }

    /// The demands broken by a drive that `robot` begins.
    pub(in crate::kit) fn broken_by_drive(
        &self,
        before: &World<ROBOTS>,
        robot: usize,
        path: Stance,
        is_old: bool,
    ) -> Vec<Demand> {
        let others: Vec<(usize, Stance)> =
            before.team.stances().enumerate().filter(|&(other, _)| other != robot).collect();
        let mut breaks = Vec::new();
        if self.is_wanted(Demand::Contact) && !self.is_in_contact(&others, path) {
            breaks.push(Demand::Contact);
        }
        let meets = |other: Stance| other.has(path.to()) && !self.stays_ahead(path, other);
        if self.is_wanted(Demand::Apart) && others.iter().any(|&(_, other)| meets(other)) {
            breaks.push(Demand::Apart);
        }
        if is_old && self.is_wanted(Demand::Shortens) && !self.is_shorter(before, robot, path.to()) {
            breaks.push(Demand::Shortens);
        }
        breaks
    }

    /// Whether `other` drives on where `path` leads, straight ahead: at one speed it is never less than a path away.
    /// Round a corner it is: two robots that leave one right after the other come to 2.12 m, half a path beyond and
    /// half a path before it.
    fn stays_ahead(&self, path: Stance, other: Stance) -> bool {
        let goes = |stance: Stance| (stance.to().x - stance.from().x, stance.to().y - stance.from().y);
        self.speeds == Speeds::Equal
            && other.from() == path.to()
            && !other.stands()
            && goes(other) == goes(path)
    }

    /// Whether the robots are connected while one of them drives this path.
    fn is_in_contact(&self, others: &[(usize, Stance)], path: Stance) -> bool {
        let are_sure = |one: Stance, other: Stance| {
            let near = |one, other| hear(self.rule.reach, one, other);
            let both = near(one.from(), other.from()) && near(one.to(), other.to());
            // Of two robots of one speed, who has left later is not at its end while the other is where it left.
            let late = near(one.to(), other.from())
                || self.speeds == Speeds::Equal && one == path && !other.stands();
            let early = near(one.from(), other.to())
                || self.speeds == Speeds::Equal && other == path && !one.stands();
            both && late && early
        };
        let mut reached = vec![path];
        let mut rest: Vec<Stance> = others.iter().map(|&(_, stance)| stance).collect();
        let mut place = 0;
        while place < reached.len() {
            let (near, far): (Vec<_>, Vec<_>) =
                rest.iter().partition(|&&other| are_sure(reached[place], other));
            reached.extend(near);
            rest = far;
            place += 1;
        }
        rest.is_empty()
    }

    /// Whether the team, or the robot alone while another one drives a new path, is nearer to an uncovered side at
    /// `to`.
    fn is_shorter(&self, before: &World<ROBOTS>, robot: usize, to: Cell) -> bool {
        let map = self.found(before);
        let cells = Self::ends(before);
        let mut after = cells;
        after[robot] = to;
        let is_nearer = |left, movers| {
            let found = Findings { left, ..self.findings(&map) };
            match (found.distance(after, movers), found.distance(cells, movers)) {
                (Some(after), Some(before)) => after < before,
                (_, None) | (None, Some(_)) => false,
            }
        };
        let left =
            |other: usize| before.team.stance(other).filter(|stance| !stance.stands()).map(Stance::from);
        let goes_alone = self.rule.has(Condition::Meanwhile) && before.fresh & !(1 << robot) != 0;
        is_nearer([None; ROBOTS], u8::MAX) || goes_alone && is_nearer(std::array::from_fn(left), 1 << robot)
    }

    /// The sides of old paths with which a shortest way of the team begins, or of `robot` alone while another one
    /// drives a new path and it has one.
    pub(super) fn shortest(&self, world: &World<ROBOTS>, robot: usize) -> Vec<Side> {
        let map = self.found(world);
        let cells = Self::ends(world);
        let left =
            |other: usize| world.team.stance(other).filter(|stance| !stance.stands()).map(Stance::from);
        let now = Findings { left: std::array::from_fn(left), ..self.findings(&map) };
        let goes_alone = self.rule.has(Condition::Meanwhile) && world.fresh & !(1 << robot) != 0;
        let alone = (now, 1 << robot);
        let (found, movers) = if goes_alone && now.distance(cells, alone.1).is_some() {
            alone
        } else {
            (Findings { left: [None; ROBOTS], ..now }, u8::MAX)
        };
        let far = found.distance(cells, movers);
        let is_nearer = |&side: &Side| {
            let mut after = cells;
            after[robot] = cells[robot].beyond(side);
            let is_old = map.edge_has(EdgeMark::Open, Edge::new(cells[robot], side));
            let may_drive = is_old && now.admits(&cells, robot, side);
            may_drive && found.distance(after, movers).is_some_and(|left| Some(left + 1) == far)
        };
        Side::ALL.into_iter().filter(is_nearer).collect()
    }

    /// The demands that are looked at and broken by staying in `world`.
    pub(in crate::kit) fn broken_by_staying(&self, world: &World<ROBOTS>) -> Vec<Demand> {
        let is_over = world.team.is_over();
        let mut breaks = Vec::new();
        if self.is_wanted(Demand::Moves) && !is_over && self.is_owed(world) {
            breaks.push(Demand::Moves);
        }
        if self.is_wanted(Demand::Covers) && (!is_over || self.is_owed(world)) {
            breaks.push(Demand::Covers);
        }
        let is_left_over = || {
            let map = self.found(world);
            !is_over || self.findings(&map).is_left_over(Self::ends(world))
        };
        if self.is_wanted(Demand::Whole) && is_left_over() {
            breaks.push(Demand::Whole);
        }
        breaks
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::kit::Rule;

    use super::super::DRIVEN;
    use super::*;

    #[test]
    fn a_record_of_a_path_that_nobody_has_driven_and_one_that_lacks_a_path_are_found() {
        let setting = Setting::<2>::new(Rule::REPAIRED, (3, 1)).expect("a lattice");
        let start = setting.start([Cell::new(0, 0), Cell::new(1, 0)]).expect("a start");
        let path = Edge::new(Cell::new(1, 0), Side::East);
        let records = start.team.records();
        let mut recorded = records[0];
        recorded.put_edge(EdgeMark::Open, path);
        let team = start.team.with_records(|robot| if robot == 0 { recorded } else { records[robot] });
        let mut truth = start.truth;
        truth.put_edge(DRIVEN, path);
        assert!(setting.broken_by_marks(&start).is_empty());
        assert!(setting.broken_by_marks(&World { team, truth, ..start }).is_empty());
        assert_eq!(setting.broken_by_marks(&World { team, ..start }), [Demand::Marks]);
        assert_eq!(setting.broken_by_marks(&World { truth, ..start }), [Demand::Marks]);
    }
}
