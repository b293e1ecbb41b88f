//! A planner that is kept to the relation of a local rule: what it plans is done only if the rule admits it. So a
//! promise that the relation keeps holds of what runs, whoever plans.

use tautline_kernel::ground::{Cell, Edge, Step};

use super::rule::{ActOf, Far, Local, Plan, RobotOf, as_its_rule};

/// A planner, and the rule to which it is kept. It returns an act for each robot.
#[derive(Clone, Copy, Debug)]
pub struct GuardedPlanner<R, P> {
    /// The rule.
    pub rule: R,
    /// The planner.
    pub planner: P,
}

impl<R: Local, P: Fn(&[RobotOf<R>]) -> Vec<ActOf<R>> + Sync> GuardedPlanner<R, P> {
    /// The acts that the planner returns, if the rule admits them; `None` if it does not: then no robot may act. One
    /// that is sure to go does so over an edge that is known to be open alone. Known of the layout are which edges are
    /// open, and the colours of the cells in and beside which robots are.
    pub fn plan(
        &self,
        robots: &[RobotOf<R>],
        is_known_open: impl Fn(Edge) -> bool,
        colour: impl Fn(Cell) -> u8,
    ) -> Option<Vec<ActOf<R>>> {
        let acts = (self.planner)(robots);
        let is_possible = |(me, (robot, act)): (usize, (&RobotOf<R>, &ActOf<R>))| {
            let may_go = match act.step {
                Step::Stay => true,
                Step::Cross(side) => {
                    let needs_open = act.needs_open || self.rule.is_sure(act.act);
                    let is_open = !needs_open || is_known_open(Edge::new(robot.at, side));
                    is_open && !self.rule.is_fixed(me)
                }
            };
            may_go && self.rule.is_always_possible(act.act) && self.rule.acts(robot.state).contains(act)
        };
        let is_admitted = |tuple: &Vec<usize>| {
            let plan = |&robot: &usize| {
                let (robot, act): (&RobotOf<R>, &ActOf<R>) = (&robots[robot], &acts[robot]);
                robot.plans(act, colour(robot.at.after(act.step)))
            };
            self.rule.admits(&tuple.iter().map(plan).collect::<Vec<_>>())
        };
        let admits = acts.len() == robots.len()
            && robots.iter().zip(&acts).enumerate().all(is_possible)
            && self.rule.tuples(robots.len()).iter().all(is_admitted);
        admits.then_some(acts)
    }
}

impl<R: Local, P: Sync> Local for GuardedPlanner<R, P> {
    type State = R::State;
    type Act = R::Act;

    fn subject() -> &'static str {
        "what runs, each plan kept to the relation"
    }

    as_its_rule! {
        robots() -> usize;
        least() -> usize;
        may_fail() -> bool;
        colours() -> u8;
        states() -> Vec<R::State>;
        acts(state: R::State) -> Vec<ActOf<R>>;
        admits(plans: &[Plan<R::State, R::Act>]) -> bool;
        keeps(robots: &[RobotOf<R>]) -> bool;
        reach() -> (i16, Far);
        may_start(robots: &[RobotOf<R>]) -> bool;
        start(robots: usize) -> Vec<RobotOf<R>>;
        tuples(robots: usize) -> Vec<Vec<usize>>;
        is_always_possible(act: R::Act) -> bool;
        is_sure(act: R::Act) -> bool;
        is_fixed(robot: usize) -> bool;
    }
}
