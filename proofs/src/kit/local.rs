//! Two robots that keep in touch, as a local rule: KIT-1 to KIT-3 for every lattice and every order of events, by the
//! kernel's own conditions. One robot acts at a time.

use tautline_kernel::ground::{Side, Step};
use tautline_kernel::kit::{Reach, Rule, Stance};

use crate::local::{Act, EveryNumber, Far, Local, Plan, Robot, in_a_row};

/// Two robots: of more the kernel asks that sets of them hear each other.
pub(super) const TWO: EveryNumber =
    EveryNumber { teams: "two robots", most_robots: 2, ..EveryNumber::DEFAULT };

/// The act of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Doing {
    /// It leaves its node through a side.
    Leaves(Side),
    /// It arrives.
    Arrives,
    /// It does nothing.
    Idles,
}

/// The stance of a robot whose state is the step that it takes.
fn stance(robot: &Robot<Step>) -> Stance {
    match robot.state {
        Step::Stay => Stance::Stands(robot.at),
        Step::Cross(side) => Stance::Drives { from: robot.at, to: robot.at.beyond(side) },
    }
}

fn acts(state: Step) -> Vec<Act<Step, Doing>> {
    let act = |act, step, ends| Act { act, step, ends, needs_open: false };
    let own = match state {
        Step::Stay => Side::ALL
            .map(|side| act(Doing::Leaves(side), Step::Stay, vec![(false, Step::Cross(side))]))
            .to_vec(),
        Step::Cross(_) => vec![act(Doing::Arrives, state, vec![(true, Step::Stay)])],
    };
    [own, vec![act(Doing::Idles, Step::Stay, vec![(false, state)])]].concat()
}

/// Whether each robot that leaves may do so beside the other one, which does nothing.
fn admits(plans: &[Plan<Step, Doing>], may_drive: impl Fn(Stance, Stance) -> bool) -> bool {
    let is_admitted = |own: &Plan<Step, Doing>, other: &Plan<Step, Doing>| match own.act {
        Doing::Leaves(side) => {
            let path = Stance::Drives { from: own.robot.at, to: own.robot.at.beyond(side) };
            may_drive(path, stance(&other.robot))
        }
        Doing::Arrives | Doing::Idles => true,
    };
    plans.iter().any(|plan| plan.act == Doing::Idles)
        && is_admitted(&plans[0], &plans[1])
        && is_admitted(&plans[1], &plans[0])
}

fn are_in_a_row(robots: &[Robot<Step>]) -> bool {
    let (columns, rows) = robots[0].at.apart(robots[1].at);
    robots.iter().all(|robot| robot.state == Step::Stay) && columns + rows == 1
}

/// A promise about two robots.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Promise {
    /// They hear each other (KIT-1, KIT-2).
    Contact,
    /// They are at least one path apart (KIT-3).
    Apart,
}

/// Two robots of a team, at whatever speeds they drive.
#[derive(Clone, Copy, Debug)]
pub struct Two {
    /// Their rule.
    pub rule: Rule,
    /// The promise.
    pub promise: Promise,
    /// Whether the promise is about the nodes alone that they have left last: the engine finds the rest.
    pub of_nodes: bool,
}

impl Two {
    /// Contact at every moment, by this rule.
    pub const fn in_contact(rule: Rule) -> Self {
        Self { rule, promise: Promise::Contact, of_nodes: false }
    }

    /// Robots that are apart at every moment, by this rule.
    pub const fn apart(rule: Rule) -> Self {
        Self { rule, promise: Promise::Apart, of_nodes: false }
    }
}

impl Local for Two {
    type State = Step;
    type Act = Doing;

    fn states(&self) -> Vec<Step> {
        Step::ALL.to_vec()
    }

    fn acts(&self, state: Step) -> Vec<Act<Step, Doing>> {
        acts(state)
    }

    fn admits(&self, plans: &[Plan<Step, Doing>]) -> bool {
        admits(plans, |path, other| match self.promise {
            Promise::Contact => self.rule.hears(other, path),
            Promise::Apart => self.rule.keeps_apart(path, other),
        })
    }

    fn keeps(&self, robots: &[Robot<Step>]) -> bool {
        let (one, other) = (stance(&robots[0]), stance(&robots[1]));
        match (self.promise, self.of_nodes) {
            (Promise::Contact, true) => Reach::PAPER.joins(one.from(), other.from()),
            (Promise::Contact, false) => one.is_sure_of(other, Reach::PAPER),
            (Promise::Apart, true) => one.from() != other.from(),
            (Promise::Apart, false) => one.is_apart_from(other),
        }
    }

    fn reach(&self) -> (i16, Far) {
        match (self.promise, self.of_nodes) {
            (Promise::Contact, _) => (4, Far::Broken),
            (Promise::Apart, true) => (0, Far::Fine),
            (Promise::Apart, false) => (2, Far::Fine),
        }
    }

    fn may_start(&self, robots: &[Robot<Step>]) -> bool {
        are_in_a_row(robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<Step>> {
        in_a_row(robots, Step::Stay)
    }
}
