//! The judge of KIT: runs of two robots on a lattice as published (KIT-1 to KIT-3, KIT-6 to KIT-8, KIT-10, KIT-11,
//! KIT-14), of three and more by the repaired rule ([`Party`]: KIT-8), what two robots say to each other ([`Talk`]:
//! KIT-4, KIT-5), and the fields of a message ([`Wire`]: KIT-9). It knows the sentences of `SPEC.md` alone.

mod party;
mod talk;
mod wire;

use std::collections::BTreeSet;

use super::change::plain;
use super::{Case, Lattice, Objection, Place, beside, breaks_at_last, must, path};
pub use party::Party;
pub use talk::{Act, Talk, TalkEvent, Word};
pub use wire::{Wire, WireMessage};

/// A run of robots on a lattice.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The reading by which the robots go.
    pub reading: Reading,
    /// How fast they drive.
    pub speeds: Speeds,
    /// When they have to hear each other, if that is the clause.
    pub contact: Contact,
    /// The nodes, and the walls that the robots meet.
    pub lattice: Lattice,
    /// Where each robot starts.
    pub starts: Vec<Place>,
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// The last of the steps that are said to come again for ever; 0 if the run ends.
    pub round: usize,
}

/// Where the published rule runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reading {
    /// At every node.
    Published,
    /// Only where the way ahead is blocked.
    Ahead,
}

/// How fast robots drive.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Speeds {
    /// At any speeds.
    Any,
    /// At equal speeds.
    Equal,
}

/// When robots have to hear each other.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Contact {
    /// At every moment.
    AllTheTime,
    /// Where both stand.
    AtNodes,
}

/// A step of one robot.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Step {
    /// Its place among the robots.
    pub robot: usize,
    /// The act in the end.
    pub what: What,
    /// Where it looks before.
    pub looks: Vec<Look>,
}

/// The end of a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum What {
    /// It arrives where it drove.
    Arrives,
    /// It drives through the side at which it looked last.
    Drives,
    /// It stays.
    Stays,
    /// It knows that the run is over.
    IsDone,
}

/// A look at a side.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Look {
    /// East, south, west, north, from 0.
    pub side: usize,
    /// The sight there.
    pub sees: Sees,
}

/// The sight at a side.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sees {
    /// Nothing.
    Free,
    /// An obstacle.
    Obstacle,
    /// Another robot.
    Robot,
}

plain!(Run { reading, speeds, contact, lattice, starts, steps, round });
plain!(Reading one of Published, Ahead);
plain!(Speeds one of Any, Equal);
plain!(Contact one of AllTheTime, AtNodes);
plain!(Step { robot, what, looks });
plain!(What one of Arrives, Drives, Stays, IsDone);
plain!(Look { side, sees });
plain!(Sees one of Free, Obstacle, Robot);

/// The clauses that a step breaks, and those that an end breaks.
const BY_STEP: [&str; 6] = ["KIT-1", "KIT-2", "KIT-3", "KIT-10", "KIT-11", "KIT-14"];
const BY_END: [&str; 2] = ["KIT-6", "KIT-8"];

/// The clause that a run without end breaks.
const BY_ROUND: &str = "KIT-7";

impl Run {
    /// Whether the judge reads runs that are said to break this clause.
    pub fn knows(clause: &str) -> bool {
        clause == BY_ROUND || BY_STEP.contains(&clause) || BY_END.contains(&clause)
    }
}

impl Case for Run {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        must(self.starts.len() == 2, "the judge knows runs of two robots")?;
        let are_there = self.starts.iter().all(|&start| self.lattice.has(start) && start == self.starts[0]);
        must(are_there, "both robots start at one node")?;
        must((self.clause == "KIT-2") <= (self.speeds == Speeds::Equal), "KIT-2 is about equal speeds")?;
        must(
            (self.contact == Contact::AtNodes) <= (self.clause == "KIT-1"),
            "KIT-1 alone is judged at nodes",
        )?;
        must((self.clause == BY_ROUND) == (self.round > 0), "KIT-7 is broken by a round alone")?;
        must(self.round <= self.steps.len(), "there are not so many steps")?;
        let mut team = Team::new(&self.starts);
        let home = self.steps.len() - self.round;
        let (mut before, mut acting, mut awake) = (None, BTreeSet::new(), BTreeSet::from([0, 1]));
        for (number, step) in (1..).zip(&self.steps) {
            let object = |what| Objection { at: number, what };
            if number > home {
                before.get_or_insert_with(|| team.clone());
                acting.insert(step.robot);
                awake.retain(|&robot| team.drives(robot) || team.may_decide(robot));
            }
            let breaks = self.step(&mut team, step).map_err(object)?;
            let is_last = number == self.steps.len();
            if BY_STEP.contains(&self.clause) {
                breaks_at_last(breaks, is_last).map_err(object)?;
            }
        }
        must(self.lattice.barred.iter().all(|wall| team.seen.contains(wall)), "a wall was never met")?;
        if self.clause == BY_ROUND {
            let is_round = before.is_some_and(|before| self.looks_like(&before, &team));
            must(is_round, "the last steps do not lead back to where they began")?;
            return Ok(must(awake.is_subset(&acting), "a robot that may act never does")?);
        }
        if BY_STEP.contains(&self.clause) {
            return Ok(());
        }
        must(BY_END.contains(&self.clause), "the judge does not know this clause")?;
        must((0..2).all(|robot| !team.drives(robot) && !team.may_decide(robot)), "the run goes on")?;
        // As published no robot ever knows that all is over, so that the end of a run breaks KIT-8.
        let is_owed = self.joint_way(&team, team.goals()).is_some();
        Ok(must(is_owed || self.clause == "KIT-8", "no uncovered side is within reach")?)
    }
}

/// The robots, and what they have found.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Team {
    /// Both ends of each stance.
    stances: [[Place; 2]; 2],
    /// Robots that have entered.
    entered: usize,
    /// The side through which each drove last.
    headings: [Option<usize>; 2],
    stays: [bool; 2],
    driven: BTreeSet<(Place, Place)>,
    /// Paths where an obstacle was seen.
    seen: BTreeSet<(Place, Place)>,
    /// Of two that drive, the one that has left first.
    first: usize,
}

impl Team {
    fn new(starts: &[Place]) -> Self {
        let stances = [[starts[0]; 2], [starts[1]; 2]];
        let (driven, seen) = (BTreeSet::new(), BTreeSet::new());
        Self { stances, entered: 1, headings: [None; 2], stays: [false; 2], driven, seen, first: 0 }
    }

    fn drives(&self, robot: usize) -> bool {
        self.stances[robot][0] != self.stances[robot][1]
    }

    /// A robot that stands is answered while the other one drives.
    fn may_decide(&self, robot: usize) -> bool {
        let is_answered = self.entered < 2 || self.drives(1 - robot);
        robot < self.entered && !self.drives(robot) && !self.stays[robot] && is_answered
    }

    /// Where each robot goes, or stands.
    fn goals(&self) -> [Place; 2] {
        self.stances.map(|[_, to]| to)
    }

    /// The stance of the other robot, if it has entered.
    fn other(&self, robot: usize) -> Option<[Place; 2]> {
        (self.entered > 1).then(|| self.stances[1 - robot])
    }
}

/// The squared distance in paths.
fn apart(one: Place, other: Place) -> i32 {
    (one.0 - other.0).pow(2) + (one.1 - other.1).pow(2)
}

/// Two nodes at most 10 m apart, each path being 3 m.
fn in_reach(one: Place, other: Place) -> bool {
    apart(one, other) <= 11
}

/// Whether a look sees what there is to see, the other robots being so; the path, if an obstacle is met on it.
fn sees(
    lattice: &Lattice,
    from: Place,
    look: &Look,
    others: &[[Place; 2]],
) -> Result<Option<(Place, Place)>, &'static str> {
    let to = beside(from, look.side).ok_or("there is no such side")?;
    let is_wall = !lattice.has(to) || lattice.barred.contains(&path(from, to));
    let what = "there is an obstacle that is not seen, or the other way round";
    must(is_wall == (look.sees == Sees::Obstacle), what)?;
    if is_wall {
        return Ok(lattice.has(to).then(|| path(from, to)));
    }
    // A robot between this node and the next one, or at the next one, is seen; one that leaves or enters the next one
    // otherwise may be.
    let is_on = |ends: &[Place; 2]| ends.map(|end| end == from || end == to);
    let is_sure = others.iter().any(|ends| is_on(ends) == [true; 2] && *ends != [from; 2]);
    let may_be = others.iter().any(|ends| is_on(ends) != [true; 2] && ends.contains(&to));
    let is_robot = look.sees == Sees::Robot;
    must(is_robot || !is_sure, "another robot is seen there")?;
    must(!is_robot || is_sure || may_be, "no robot is there")?;
    Ok(None)
}

impl Run {
    /// Takes a step; whether it breaks the clause.
    fn step(&self, team: &mut Team, step: &Step) -> Result<bool, &'static str> {
        let robot = step.robot;
        must(robot < 2, "there is no such robot")?;
        if step.what == What::Arrives {
            must(team.drives(robot) && step.looks.is_empty(), "a robot that does not drive does not arrive")?;
            let both = self.speeds == Speeds::Equal && team.drives(1 - robot);
            must(!both || team.first == robot, "at equal speeds the one that has left first arrives first")?;
            team.stances[robot] = [team.stances[robot][1]; 2];
            team.first = 1 - robot;
            team.stays[1 - robot] = false;
            let [one, other] = team.stances;
            let both_stand = !team.drives(0) && !team.drives(1);
            return Ok(self.contact == Contact::AtNodes && both_stand && !in_reach(one[0], other[0]));
        }
        must(team.may_decide(robot), "this robot may not decide now")?;
        let before = team.clone();
        self.look(team, step)?;
        let is_marked = self.clause != "KIT-10" || team.seen.is_empty();
        if step.what == What::Stays {
            team.stays[robot] = true;
            return Ok(!is_marked);
        }
        let from = before.stances[robot][0];
        let side = step.looks.last().map_or(usize::MAX, |look| look.side);
        let to = beside(from, side).ok_or("a robot drives nowhere")?;
        let mut is_broken = !is_marked || self.is_broken_by(&before, (robot, [from, to]), &team.seen);
        if self.clause == "KIT-14" && step.looks.len() == 1 && before.driven.contains(&path(from, to)) {
            is_broken = self.at_once(&before, robot) != self.shortest(&before, robot);
        }
        team.stances[robot] = [from, to];
        team.headings[robot] = Some(side);
        team.entered = 2;
        team.first = if before.drives(1 - robot) { before.first } else { robot };
        team.stays[1 - robot] = false;
        team.driven.insert(path(from, to));
        Ok(is_broken)
    }

    /// Looks at sides in an order of the rule: the way ahead, if that is the reading; then the uncovered sides in
    /// any order whose ends are in reach of where the other one goes; then all sides, those that lead nearest to it
    /// first. The first side that is free is driven.
    fn look(&self, team: &mut Team, step: &Step) -> Result<(), &'static str> {
        let (robot, from) = (step.robot, team.stances[step.robot][0]);
        let inside = |side: &usize| beside(from, *side).is_some_and(|to| self.lattice.has(to));
        let to = |side: usize| beside(from, side).unwrap_or(from);
        let other = team.other(robot);
        let is_near = |side: &usize| other.is_none_or(|other| in_reach(to(*side), other[1]));
        let is_new = |side: &usize| !team.driven.contains(&path(from, to(*side)));
        let mut ahead = team.headings[robot].filter(|_| self.reading == Reading::Ahead);
        let mut uncovered: Vec<usize> = (0..4).filter(inside).filter(is_new).filter(is_near).collect();
        let mut left: Vec<usize> = (0..4).filter(inside).collect();
        let mut is_free = false;
        for look in &step.looks {
            must(!is_free, "a robot looks on though a side is free")?;
            let far = |side: usize| other.map_or(0, |other| apart(to(side), other[1]));
            let due = if let Some(ahead) = ahead.take() {
                look.side == ahead
            } else if !uncovered.is_empty() {
                let count = uncovered.len();
                uncovered.retain(|&side| side != look.side);
                uncovered.len() < count
            } else {
                let nearest = left.iter().map(|&side| far(side)).min();
                let is_nearest = left.contains(&look.side) && Some(far(look.side)) == nearest;
                left.retain(|&side| side != look.side);
                is_nearest
            };
            must(due, "the rule does not look there")?;
            let others: Vec<[Place; 2]> = other.into_iter().collect();
            team.seen.extend(sees(&self.lattice, from, look, &others)?);
            is_free = look.sees == Sees::Free;
        }
        match step.what {
            What::Drives => must(is_free, "a robot drives where it sees no free side"),
            What::IsDone => Err("as published no robot knows that the run is over"),
            What::Stays | What::Arrives => {
                let is_through = ahead.is_none() && uncovered.is_empty() && left.is_empty();
                must(!is_free && is_through, "a robot stays though there is a side to look at")
            }
        }
    }

    /// Whether a drive breaks the clause.
    fn is_broken_by(
        &self,
        team: &Team,
        (robot, path_of): (usize, [Place; 2]),
        seen: &BTreeSet<(Place, Place)>,
    ) -> bool {
        let [from, to] = path_of;
        let other = team.other(robot);
        let other_drives = team.drives(1 - robot);
        let is_equal = self.speeds == Speeds::Equal;
        match self.clause {
            "KIT-1" | "KIT-2" if self.contact == Contact::AllTheTime => other.is_some_and(|[left, goal]| {
                // At equal speeds the one that leaves later is not at its end while the other one is where it left.
                let is_late = is_equal && other_drives;
                let corners = [(from, left), (from, goal), (to, goal)];
                !corners.into_iter().all(|(one, other)| in_reach(one, other))
                    || !is_late && !in_reach(to, left)
            }),
            "KIT-3" => other.is_some_and(|[left, goal]| {
                let ahead = (goal.0 - left.0, goal.1 - left.1) == (to.0 - from.0, to.1 - from.1);
                let is_behind = is_equal && other_drives && left == to && ahead;
                [left, goal].contains(&to) && !is_behind
            }),
            "KIT-11" if team.driven.contains(&path(from, to)) => {
                let team = Team { seen: seen.clone(), ..team.clone() };
                let now = self.joint_way(&team, team.goals());
                let mut goals = team.goals();
                goals[robot] = to;
                let then = self.joint_way(&team, goals);
                !matches!((then, now), (Some(then), Some(now)) if then < now)
            }
            _ => false,
        }
    }

    /// The sides of covered paths through which a robot can drive after one look.
    fn at_once(&self, team: &Team, robot: usize) -> Vec<usize> {
        let from = team.stances[robot][0];
        let can_drive = |&side: &usize| {
            let looks = vec![Look { side, sees: Sees::Free }];
            let is_covered = beside(from, side).is_some_and(|to| team.driven.contains(&path(from, to)));
            is_covered && self.look(&mut team.clone(), &Step { robot, what: What::Drives, looks }).is_ok()
        };
        (0..4).filter(can_drive).collect()
    }

    /// The sides of covered paths with which a shortest joint way begins: a robot drives there in contact with both
    /// ends of the other one's path, and to neither of them.
    fn shortest(&self, team: &Team, robot: usize) -> Vec<usize> {
        let (from, other) = (team.stances[robot][0], team.stances[1 - robot]);
        let now = self.joint_way(team, team.goals());
        let begins = |&side: &usize| {
            let Some(to) = beside(from, side).filter(|&to| team.driven.contains(&path(from, to))) else {
                return false;
            };
            let mut goals = team.goals();
            goals[robot] = to;
            let is_in_contact =
                other.iter().all(|&end| end != to && in_reach(from, end) && in_reach(to, end));
            is_in_contact && self.joint_way(team, goals).is_some_and(|then| now == Some(then + 1))
        };
        (0..4).filter(begins).collect()
    }

    /// The fewest single drives over covered paths, in contact and to different nodes, until a robot could drive
    /// through an uncovered side; `None` if there is no such way.
    fn joint_way(&self, team: &Team, goals: [Place; 2]) -> Option<usize> {
        let (mut known, mut now) = (BTreeSet::from([goals]), vec![goals]);
        for length in 0.. {
            let mut next = Vec::new();
            for goals in &now {
                for (robot, side) in (0..2).flat_map(|robot| (0..4).map(move |side| (robot, side))) {
                    let (from, other) = (goals[robot], goals[1 - robot]);
                    let Some(to) = beside(from, side).filter(|&to| self.lattice.has(to)) else { continue };
                    let is_barred = team.seen.contains(&path(from, to)) || to == other;
                    if is_barred || !in_reach(from, other) || !in_reach(to, other) {
                        continue;
                    }
                    if !team.driven.contains(&path(from, to)) {
                        return Some(length);
                    }
                    let mut after = *goals;
                    after[robot] = to;
                    if known.insert(after) {
                        next.push(after);
                    }
                }
            }
            if next.is_empty() {
                break;
            }
            now = next;
        }
        None
    }

    /// Whether robots go on from here as from there: what was seen blocked is not kept, as published.
    fn looks_like(&self, one: &Team, other: &Team) -> bool {
        let same = one.stances == other.stances && one.stays == other.stays && one.driven == other.driven;
        let ahead = self.reading == Reading::Published || one.headings == other.headings;
        let order = self.speeds == Speeds::Any || one.first == other.first;
        same && one.entered == other.entered && ahead && order
    }
}
