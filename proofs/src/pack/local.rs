//! Two robots of a pack, as a local rule: PACK-2 for every number of robots and every floor, by the kernel's own
//! condition. Robots take their steps one after the other, also those of one team move.

use tautline_kernel::ground::Step;
use tautline_kernel::pack::Rule;

use crate::local::{Act, Far, Local, Plan, Robot, in_a_row};

/// Robots of which no two are to be in one cell.
#[derive(Clone, Copy, Debug)]
pub struct Single(pub Rule);

impl Local for Single {
    type State = ();
    type Act = Step;

    fn states(&self) -> Vec<()> {
        vec![()]
    }

    fn acts(&self, (): ()) -> Vec<Act<(), Step>> {
        let act = |step| Act { act: step, step, ends: vec![(true, ())], needs_open: false };
        Step::ALL.into_iter().map(act).collect()
    }

    fn admits(&self, plans: &[Plan<(), Step>]) -> bool {
        let may_enter = |own: &Plan<(), Step>, other: &Plan<(), Step>| {
            own.step == Step::Stay || self.0.admits_entry(own.to(), [other.robot.at].into_iter())
        };
        plans.iter().any(|plan| plan.step == Step::Stay)
            && may_enter(&plans[0], &plans[1])
            && may_enter(&plans[1], &plans[0])
    }

    fn keeps(&self, robots: &[Robot<()>]) -> bool {
        robots[0].at != robots[1].at
    }

    fn reach(&self) -> (i16, Far) {
        (0, Far::Fine)
    }

    fn may_start(&self, robots: &[Robot<()>]) -> bool {
        robots[0].at != robots[1].at
    }

    fn start(&self, robots: usize) -> Vec<Robot<()>> {
        in_a_row(robots, ())
    }

    /// Robots know their floor.
    fn is_sure(&self, _: Step) -> bool {
        true
    }
}
