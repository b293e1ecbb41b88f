//! What a team of robots knows of its map, and which drives the conditions admit.

use super::rule::{Condition, Records};
use super::stance::{Stance, in_reach};
use super::team::Kit;
use crate::ground::{Cell, EdgeMark, Grid, Step, Steps};

/// What is known, and what is admitted.
impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// This team with other records, as they were kept or told.
    #[must_use]
    pub const fn with_records(mut self, records: [G; ROBOTS]) -> Self
    where
        G: Copy,
    {
        self.records = records;
        self
    }

    /// The sides of `node` that carry `mark` in any record.
    #[inline]
    pub fn known(&self, mark: EdgeMark, node: Cell) -> Steps {
        self.records.iter().fold(Steps::NONE, |sides, record| sides.or(record.sides(mark, node)))
    }

    /// The sides of `node` that count as covered for `robot`, or are known to be blocked.
    pub fn covered(&self, robot: usize, node: Cell) -> Steps {
        let covered = match self.rule.records {
            Records::Union => self.known(EdgeMark::Open, node),
            Records::Others => {
                let others = self.records.iter().enumerate().filter(|&(other, _)| other != robot);
                others.fold(Steps::NONE, |sides, (_, record)| sides.or(record.sides(EdgeMark::Open, node)))
            }
        };
        covered.or(self.known(EdgeMark::Wall, node))
    }

    /// The sides of `node` that are uncovered for `robot`.
    #[inline]
    pub fn uncovered(&self, robot: usize, node: Cell) -> Steps {
        Steps::ALL.without(Step::Stay).minus(self.covered(robot, node))
    }

    /// Where the others are that have entered.
    pub(super) fn others(&self, robot: usize) -> impl Iterator<Item = Stance> + Clone {
        self.stances().enumerate().filter(move |&(other, _)| other != robot).map(|(_, stance)| stance)
    }

    /// Whether another one drives a path that was new when it left.
    pub(super) fn another_drives_a_new_path(&self, robot: usize) -> bool {
        let others = self.robots.iter().enumerate().filter(|&(other, _)| other != robot);
        others.into_iter().any(|(_, other)| other.is_new && !other.stance.stands())
    }

    pub(super) fn someone_drives(&self) -> bool {
        self.stances().any(|stance| !stance.stands())
    }

    /// Whether the conditions let `robot` take this step from where it stands.
    pub fn admits(&self, robot: usize, step: Step) -> bool {
        let Some(Stance::Stands(from)) = self.stance(robot) else { return false };
        self.admits_path(robot, Stance::Drives { from, to: from.after(step) })
    }

    /// Whether the conditions let `robot` be on `path`, the others being where they are.
    pub(super) fn admits_path(&self, robot: usize, path: Stance) -> bool {
        if self.rule.has(Condition::Apart) && self.others(robot).any(|other| other.has(path.to())) {
            return false;
        }
        let entered = (1_u32 << self.entered).wrapping_sub(1) as u16;
        let hears = |one: Stance, other: Stance| {
            let next = in_reach(one.to(), other.to());
            let from = in_reach(one.from(), other.to())
                && in_reach(one.to(), other.from())
                && in_reach(one.from(), other.from());
            (next || !self.rule.has(Condition::NextInReach))
                && (from || !self.rule.has(Condition::FromInReach))
        };
        let mut stances = self.robots.map(|robot| robot.stance);
        if let Some(stance) = stances.get_mut(robot) {
            *stance = path;
        }
        is_connected(&stances, entered, hears)
    }

    pub(super) fn is_connected(&self, set: u16, hears: impl Fn(Stance, Stance) -> bool) -> bool {
        is_connected(&self.robots.map(|robot| robot.stance), set, hears)
    }
}

/// Whether the robots of `set`, a bit for each, are connected, two of them directly if they hear each other.
fn is_connected<const ROBOTS: usize>(
    stances: &[Stance; ROBOTS],
    set: u16,
    hears: impl Fn(Stance, Stance) -> bool,
) -> bool {
    let mut reached = set & set.wrapping_neg();
    loop {
        let mut wider = reached;
        for (robot, &stance) in stances.iter().enumerate() {
            let is_near = |(other, &near): (usize, &Stance)| reached >> other & 1 == 1 && hears(near, stance);
            if set >> robot & 1 == 1 && stances.iter().enumerate().any(is_near) {
                wider |= 1 << robot;
            }
        }
        if wider == reached {
            return reached == set;
        }
        reached = wider;
    }
}
