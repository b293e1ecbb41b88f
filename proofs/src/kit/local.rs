//! Two robots that keep in touch, as a local rule: KIT-1 to KIT-3 for every lattice and every order of events, by the
//! kernel's own conditions. One robot acts at a time.

use tautline_kernel::ground::{Cell, Side, Step};
use tautline_kernel::kit::{Reach, Rule, Stance};

use crate::local::{Act, EveryNumber, Far, Local, Plan, Robot, in_a_row};

/// Two robots: of more the kernel asks that sets of them hear each other.
pub(super) const TWO: EveryNumber =
    EveryNumber { teams: "two robots", most_robots: 2, most_starts: 2, ..EveryNumber::DEFAULT };

/// As [`TWO`], of published robots: each knows where the other one goes, since none answers that stands (KIT-5).
pub(super) const TOLD: EveryNumber = EveryNumber { teams: "two robots, by true news", ..TWO };

/// As [`TOLD`], looked at where both stand.
pub(super) const AT_NODES: EveryNumber =
    EveryNumber { teams: "two robots where both stand, by true news", ..TWO };

/// The act of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PairAct {
    /// It leaves its node through a side.
    Leaves(Side),
    /// It arrives.
    Arrives,
    /// It does nothing.
    Idles,
}

/// The stance of a robot that takes this step.
fn stance(at: Cell, step: Step) -> Stance {
    match step {
        Step::Stay => Stance::Stands(at),
        Step::Cross(side) => Stance::Drives { from: at, to: at.beyond(side) },
    }
}

fn acts(state: Step) -> Vec<Act<Step, PairAct>> {
    let act = |act, step, ends| Act { act, step, ends, needs_open: false };
    let own = match state {
        Step::Stay => Side::ALL
            .map(|side| act(PairAct::Leaves(side), Step::Stay, vec![(false, Step::Cross(side))]))
            .to_vec(),
        Step::Cross(_) => vec![act(PairAct::Arrives, state, vec![(true, Step::Stay)])],
    };
    [own, vec![act(PairAct::Idles, Step::Stay, vec![(false, state)])]].concat()
}

/// Whether each robot that leaves may do so beside the other one, which does nothing.
fn admits(plans: &[Plan<Step, PairAct>], may_drive: impl Fn(Stance, Stance) -> bool) -> bool {
    let is_admitted = |own: &Plan<Step, PairAct>, other: &Plan<Step, PairAct>| match own.act {
        PairAct::Leaves(side) => {
            may_drive(stance(own.robot.at, Step::Cross(side)), stance(other.robot.at, other.robot.state))
        }
        PairAct::Arrives | PairAct::Idles => true,
    };
    plans.iter().any(|plan| plan.act == PairAct::Idles)
        && is_admitted(&plans[0], &plans[1])
        && is_admitted(&plans[1], &plans[0])
}

/// Whether two robots stand in different nodes and hear each other.
fn start_in_contact<S: PartialEq>(robots: &[Robot<S>], stands: &S) -> bool {
    let [one, other] = [robots[0].at, robots[1].at];
    robots.iter().all(|robot| robot.state == *stands) && one != other && Reach::PAPER.joins(one, other)
}

/// A promise about two robots.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Promise {
    /// They hear each other (KIT-1, KIT-2).
    Contact,
    /// They hear each other where both stand (KIT-1).
    AtNodes,
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

    /// Contact where both stand, by this rule.
    pub const fn at_nodes(rule: Rule) -> Self {
        Self { rule, promise: Promise::AtNodes, of_nodes: false }
    }

    /// Robots that are apart at every moment, by this rule.
    pub const fn apart(rule: Rule) -> Self {
        Self { rule, promise: Promise::Apart, of_nodes: false }
    }
}

impl Local for Two {
    type State = Step;
    type Act = PairAct;

    fn states(&self) -> Vec<Step> {
        Step::ALL.to_vec()
    }

    fn acts(&self, state: Step) -> Vec<Act<Step, PairAct>> {
        acts(state)
    }

    fn admits(&self, plans: &[Plan<Step, PairAct>]) -> bool {
        admits(plans, |path, other| match self.promise {
            Promise::Contact | Promise::AtNodes => self.rule.hears(other, path),
            Promise::Apart => self.rule.keeps_apart(path, other),
        })
    }

    fn keeps(&self, robots: &[Robot<Step>]) -> bool {
        let (one, other) = (stance(robots[0].at, robots[0].state), stance(robots[1].at, robots[1].state));
        match (self.promise, self.of_nodes) {
            (Promise::Contact, true) => Reach::PAPER.joins(one.from(), other.from()),
            (Promise::Contact, false) => one.is_sure_of(other, Reach::PAPER),
            (Promise::AtNodes, _) => {
                !(one.stands() && other.stands()) || Reach::PAPER.joins(one.to(), other.to())
            }
            (Promise::Apart, true) => one.from() != other.from(),
            (Promise::Apart, false) => one.is_apart_from(other),
        }
    }

    fn reach(&self) -> (i16, Far) {
        match (self.promise, self.of_nodes) {
            (Promise::Contact, _) => (4, Far::Broken),
            // Two that drive towards each other come from two nodes farther away.
            (Promise::AtNodes, _) => (5, Far::Broken),
            (Promise::Apart, true) => (0, Far::Fine),
            (Promise::Apart, false) => (2, Far::Fine),
        }
    }

    fn may_start(&self, robots: &[Robot<Step>]) -> bool {
        match self.promise {
            Promise::Contact | Promise::AtNodes => start_in_contact(robots, &Step::Stay),
            // Of three robots two are not beside each other.
            Promise::Apart => {
                robots[0].at != robots[1].at && robots.iter().all(|robot| robot.state == Step::Stay)
            }
        }
    }

    fn start(&self, robots: usize) -> Vec<Robot<Step>> {
        in_a_row(robots, Step::Stay)
    }

    /// Paths of a lattice are known.
    fn is_sure(&self, act: PairAct) -> bool {
        act == PairAct::Arrives
    }
}

/// The step that a robot takes, and when it has left: a third of those that leave one after the other.
type TimedStep = (Step, u8);

/// Two robots by this rule at equal speeds: of two that drive, the one that has left first arrives first (KIT-2).
#[derive(Clone, Copy, Debug)]
pub struct AtEqualSpeeds(pub Rule);

/// Whether a robot that has left at one time has left before one that has left at the other.
const fn is_before(time: u8, other: u8) -> bool {
    other == (time + 1) % 3
}

impl Local for AtEqualSpeeds {
    type State = TimedStep;
    type Act = (PairAct, u8);

    fn states(&self) -> Vec<TimedStep> {
        let drive = |side| [0, 1, 2].map(|time| (Step::Cross(side), time));
        [(Step::Stay, 0)].into_iter().chain(Side::ALL.into_iter().flat_map(drive)).collect()
    }

    fn acts(&self, (step, time): TimedStep) -> Vec<Act<TimedStep, (PairAct, u8)>> {
        let timed = |act: &Act<Step, PairAct>, time: u8| {
            let end =
                |&(goes, step): &(bool, Step)| (goes, (step, if step == Step::Stay { 0 } else { time }));
            let ends = act.ends.iter().map(end).collect();
            Act { act: (act.act, time), step: act.step, ends, needs_open: act.needs_open }
        };
        let all = acts(step);
        let times = |act: &Act<Step, PairAct>| match act.act {
            PairAct::Leaves(_) => vec![timed(act, 0), timed(act, 1), timed(act, 2)],
            PairAct::Arrives | PairAct::Idles => vec![timed(act, time)],
        };
        all.iter().flat_map(times).collect()
    }

    fn admits(&self, plans: &[Plan<TimedStep, (PairAct, u8)>]) -> bool {
        let is_admitted = |own: &Plan<TimedStep, (PairAct, u8)>, other: &Plan<TimedStep, (PairAct, u8)>| {
            let (step, time) = other.robot.state;
            let stands = step == Step::Stay;
            match own.act {
                (PairAct::Leaves(side), new) => {
                    let path = stance(own.robot.at, Step::Cross(side));
                    let is_next = if stands { new == 0 } else { is_before(time, new) };
                    is_next && self.0.hears(stance(other.robot.at, step), path)
                }
                (PairAct::Arrives, own) => stands || is_before(own, time),
                (PairAct::Idles, _) => true,
            }
        };
        plans.iter().any(|plan| plan.act.0 == PairAct::Idles)
            && is_admitted(&plans[0], &plans[1])
            && is_admitted(&plans[1], &plans[0])
    }

    fn keeps(&self, robots: &[Robot<TimedStep>]) -> bool {
        let [one, other] = [0, 1].map(|robot| stance(robots[robot].at, robots[robot].state.0));
        let near = |one: Cell, other: Cell| Reach::PAPER.joins(one, other);
        let [time, later] = [0, 1].map(|robot| robots[robot].state.1);
        // The later one is not at its end while the other one is where it left.
        let both_drive = !one.stands() && !other.stands();
        near(one.from(), other.from())
            && near(one.to(), other.to())
            && (near(one.to(), other.from()) || both_drive && is_before(later, time))
            && (near(one.from(), other.to()) || both_drive && is_before(time, later))
    }

    fn reach(&self) -> (i16, Far) {
        (4, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<TimedStep>]) -> bool {
        start_in_contact(robots, &(Step::Stay, 0))
    }

    fn start(&self, robots: usize) -> Vec<Robot<TimedStep>> {
        in_a_row(robots, (Step::Stay, 0))
    }

    fn is_sure(&self, (act, _): (PairAct, u8)) -> bool {
        act == PairAct::Arrives
    }
}
