//! Plans that two or three robots of a chain may make at once, as local rules: CHAIN-1 to CHAIN-3, CHAIN-15 and
//! CHAIN-19 for every layout, by the kernel's own conditions.

use tautline_kernel::chain::{Condition, Move, Role, Rule};
use tautline_kernel::ground::{Cell, Circle, Step};

use super::breach::stays_in_range;
use super::{pair, three};
use crate::local::{Act, EveryNumber, Far, Local, Plan, Robot, chain};

/// Of a clause of which contact is a part.
pub(super) const ITS_CONTACT: EveryNumber = EveryNumber { part: "contact alone", ..EveryNumber::DEFAULT };

/// Chains of three.
pub(super) const THREE: EveryNumber =
    EveryNumber { teams: "N = 3", most_robots: 3, most_starts: 3, ..EveryNumber::DEFAULT };

/// The kernel keeps every plan that it returns to the relation: see `Rule::admits_plan`.
const EVERY_PLAN: &str = "the relation, to which every plan is kept";

/// A step, and how it comes about.
pub type SortedStep = (Step, Sort);

/// How a step of a robot comes about.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sort {
    /// By a plan. If it crosses a side, that may be a wall.
    Tries,
    /// By a plan, over a side that is known to be open.
    KnownOpen,
    /// The team takes its last move back.
    TakesBack,
}

/// Every step by a plan. Where robots may stay behind though no wall is there, a team that takes a move back is not
/// where it was: so that is looked at, too.
fn steps<S: Copy>(state: S, may_fail: bool) -> Vec<Act<S, SortedStep>> {
    let act = |sort, step| {
        let goes = vec![(true, state)];
        let may_not = step != Step::Stay && (sort != Sort::KnownOpen || may_fail);
        let ends = if may_not { [goes, vec![(false, state)]].concat() } else { goes };
        Act { act: (step, sort), step, ends, needs_open: sort == Sort::KnownOpen }
    };
    let crossing = Step::ALL.into_iter().filter(|&step| step != Step::Stay);
    let planned = Step::ALL.into_iter().map(|step| act(Sort::Tries, step));
    let taken_back = Step::ALL.into_iter().filter(|_| may_fail).map(|step| act(Sort::TakesBack, step));
    planned.chain(crossing.map(|step| act(Sort::KnownOpen, step))).chain(taken_back).collect()
}

fn as_move<S>(plan: &Plan<S, SortedStep>) -> Move {
    Move { from: plan.robot.at, step: plan.step, known_open: plan.act.1 == Sort::KnownOpen }
}

/// The moves that a robot may have planned which takes its part in the last team move back: a robot that need not go
/// back has stayed behind, or planned to stay.
fn undone(back: Move) -> Vec<Move> {
    let planned = |step| Move { from: back.to(), step, known_open: true };
    match back.step {
        Step::Cross(_) => vec![planned(back.step.reverse())],
        Step::Stay => Step::ALL.map(planned).to_vec(),
    }
}

/// So many robots in one cell.
fn together<S: Copy>(robots: usize, state: impl Fn(usize) -> S) -> Vec<Robot<S>> {
    (0..robots).map(|robot| Robot::new(Cell::new(0, 0), state(robot))).collect()
}

/// The contact of neighbours in the chain (CHAIN-1); with faults, whichever of them go (CHAIN-19).
#[derive(Clone, Copy, Debug)]
pub struct Contact<const FAULTS: bool>(pub Rule);

impl<const FAULTS: bool> Local for Contact<FAULTS> {
    type State = ();
    type Act = SortedStep;

    fn may_fail(&self) -> bool {
        FAULTS
    }

    fn subject() -> &'static str {
        EVERY_PLAN
    }

    fn states(&self) -> Vec<()> {
        vec![()]
    }

    fn acts(&self, (): ()) -> Vec<Act<(), SortedStep>> {
        steps((), FAULTS)
    }

    fn admits(&self, plans: &[Plan<(), SortedStep>]) -> bool {
        let (own, ahead) = (as_move(&plans[0]), as_move(&plans[1]));
        match [&plans[0], &plans[1]].map(|plan| plan.act.1 == Sort::TakesBack) {
            [false, false] => pair::admits(&self.0, own, ahead),
            [true, true] => {
                let is_admitted =
                    |&own: &Move| undone(ahead).iter().any(|&ahead| pair::admits(&self.0, own, ahead));
                self.0.keeps_contact(own.to(), ahead.to()) && undone(own).iter().any(is_admitted)
            }
            [true, false] | [false, true] => false,
        }
    }

    fn keeps(&self, robots: &[Robot<()>]) -> bool {
        Circle::COVERED.covers(robots[0].at, robots[1].at)
    }

    fn reach(&self) -> (i16, Far) {
        (2, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<()>]) -> bool {
        robots[1].at == robots[0].at
    }

    fn start(&self, robots: usize) -> Vec<Robot<()>> {
        together(robots, |_| ())
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        chain(robots)
    }

    /// A team takes a move back only after it has made one.
    fn is_always_possible(&self, (_, sort): SortedStep) -> bool {
        sort != Sort::TakesBack
    }

    fn is_fixed(&self, robot: usize) -> bool {
        robot == 0
    }
}

/// At most two robots in a cell outside the base (CHAIN-2): any three of them. With two colours the base is a cell of
/// the second one.
#[derive(Clone, Copy, Debug)]
pub struct Crowd<const COLOURS: u8> {
    /// Their rule.
    pub rule: Rule,
    /// Their roles.
    pub roles: &'static [Role],
}

/// The colour of the base.
const BASE: u8 = 1;

impl Crowd<2> {
    /// Robots that lead or follow by this rule, and their base.
    pub const fn of(rule: Rule) -> Self {
        Self { rule, roles: &[Role::Follower, Role::Leader] }
    }
}

impl<const COLOURS: u8> Local for Crowd<COLOURS> {
    type State = Role;
    type Act = Step;

    fn robots(&self) -> usize {
        3
    }

    fn colours(&self) -> u8 {
        COLOURS
    }

    fn subject() -> &'static str {
        EVERY_PLAN
    }

    fn states(&self) -> Vec<Role> {
        self.roles.to_vec()
    }

    fn acts(&self, role: Role) -> Vec<Act<Role, Step>> {
        Act::steps(role)
    }

    fn admits(&self, plans: &[Plan<Role, Step>]) -> bool {
        (0..3).all(|one| {
            let (own, others) = (&plans[one], [&plans[(one + 1) % 3], &plans[(one + 2) % 3]]);
            let is_distinct =
                !self.rule.has(Condition::Distinct) || others.iter().all(|other| other.to() != own.to());
            let occupants = others.iter().filter(|other| other.robot.at == own.to()).count();
            let may_enter = own.step == Step::Stay || self.rule.admits_entry(own.robot.state, occupants);
            own.aims == BASE || is_distinct && may_enter
        })
    }

    fn keeps(&self, robots: &[Robot<Role>]) -> bool {
        robots[0].on == BASE || robots[0].at != robots[1].at || robots[1].at != robots[2].at
    }

    fn reach(&self) -> (i16, Far) {
        (0, Far::Fine)
    }

    fn may_start(&self, robots: &[Robot<Role>]) -> bool {
        self.keeps(robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<Role>> {
        let role = |robot| if robot + 1 == robots { self.roles[self.roles.len() - 1] } else { self.roles[0] };
        let on = |robot| if robot == 0 { COLOURS - 1 } else { 0 };
        let robot = |robot| Robot { at: Cell::new(robot as i16, 0), state: role(robot), on: on(robot) };
        (0..robots).map(robot).collect()
    }

    fn is_fixed(&self, robot: usize) -> bool {
        COLOURS > 1 && robot == 0
    }
}

/// The distance of neighbours during a team move, at whatever speeds they go (CHAIN-3).
#[derive(Clone, Copy, Debug)]
pub struct Coverage(pub Rule);

/// A robot's part in a team move.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Phase {
    /// It is the base.
    Base,
    /// It waits for the next team move.
    Rests,
    /// It is on its way, or stays.
    Goes(Step),
}

impl Phase {
    /// The step that it takes.
    const fn step(self) -> Step {
        match self {
            Self::Goes(step) => step,
            Self::Base | Self::Rests => Step::Stay,
        }
    }
}

impl Local for Coverage {
    type State = Phase;
    /// The step on which a robot sets out, or `None` when it ends.
    type Act = Option<Step>;

    fn subject() -> &'static str {
        EVERY_PLAN
    }

    fn states(&self) -> Vec<Phase> {
        [Phase::Base, Phase::Rests].into_iter().chain(Step::ALL.map(Phase::Goes)).collect()
    }

    fn acts(&self, phase: Phase) -> Vec<Act<Phase, Option<Step>>> {
        let act = |act, step, ends| Act { act, step, ends, needs_open: false };
        match phase {
            Phase::Base => vec![act(Some(Step::Stay), Step::Stay, vec![(true, phase)])],
            Phase::Rests => {
                Step::ALL.map(|step| act(Some(step), Step::Stay, vec![(true, Phase::Goes(step))])).to_vec()
            }
            Phase::Goes(Step::Stay) => vec![act(None, Step::Stay, vec![(true, Phase::Rests)])],
            Phase::Goes(step) => vec![act(None, step, vec![(true, Phase::Rests), (false, Phase::Rests)])],
        }
    }

    fn admits(&self, plans: &[Plan<Phase, Option<Step>>]) -> bool {
        let sets_out = |plan: &Plan<Phase, Option<Step>>| {
            plan.act.map(|step| Move { from: plan.robot.at, step, known_open: false })
        };
        match (sets_out(&plans[0]), sets_out(&plans[1])) {
            (Some(own), Some(ahead)) => pair::admits(&self.0, own, ahead),
            (Some(_), None) => plans[0].robot.state == Phase::Base,
            (None, Some(_)) => false,
            (None, None) => true,
        }
    }

    fn keeps(&self, robots: &[Robot<Phase>]) -> bool {
        let is_in_step = match (robots[0].state, robots[1].state) {
            (_, Phase::Base) => false,
            (Phase::Base, _) => true,
            (one, other) => (one == Phase::Rests) == (other == Phase::Rests),
        };
        let way = |robot: &Robot<Phase>| [robot.at, robot.at.after(robot.state.step())];
        is_in_step && stays_in_range(way(&robots[0]), way(&robots[1]))
    }

    fn reach(&self) -> (i16, Far) {
        (2, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<Phase>]) -> bool {
        let waits = |robot: &Robot<Phase>| !matches!(robot.state, Phase::Goes(_));
        robots[1].at == robots[0].at && robots[1].state == Phase::Rests && waits(&robots[0])
    }

    fn start(&self, robots: usize) -> Vec<Robot<Phase>> {
        together(robots, |robot| if robot == 0 { Phase::Base } else { Phase::Rests })
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        chain(robots)
    }
}

/// A chain of three as published (CHAIN-15): the base, R_2 and R_3, of which R_2 prefers
/// to stay. Their states are their numbers.
#[derive(Clone, Copy, Debug)]
pub struct OfThree(pub Rule);

impl Local for OfThree {
    type State = u8;
    type Act = SortedStep;

    fn robots(&self) -> usize {
        3
    }

    fn subject() -> &'static str {
        "the relation, and that R_2 prefers to stay"
    }

    fn states(&self) -> Vec<u8> {
        vec![1, 2, 3]
    }

    fn acts(&self, number: u8) -> Vec<Act<u8, SortedStep>> {
        let is_possible = |act: &Act<u8, SortedStep>| number > 1 || act.step == Step::Stay;
        steps(number, false).into_iter().filter(is_possible).collect()
    }

    fn admits(&self, plans: &[Plan<u8, SortedStep>]) -> bool {
        three::admits(&self.0, plans[0].robot.at, as_move(&plans[1]), as_move(&plans[2]))
    }

    fn keeps(&self, robots: &[Robot<u8>]) -> bool {
        robots.iter().map(|robot| robot.state).eq(1..=3)
            && Circle::SAFE.covers(robots[0].at, robots[1].at)
            && Circle::COVERED.covers(robots[1].at, robots[2].at)
    }

    fn reach(&self) -> (i16, Far) {
        (3, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<u8>]) -> bool {
        robots.iter().map(|robot| robot.state).eq(1..=3)
            && robots.iter().all(|robot| robot.at == robots[0].at)
    }

    fn start(&self, robots: usize) -> Vec<Robot<u8>> {
        together(robots, |robot| robot as u8 + 1)
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        if robots == 3 { vec![vec![0, 1, 2]] } else { Vec::new() }
    }
}
