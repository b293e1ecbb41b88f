//! Ants (ANTS): what is promised of agents that go where they have been least, over all states on small floors.

mod apart;
pub mod clauses;
mod replacement;
mod ties;

use std::convert::Infallible;

use tautline_kernel::ants::{Act, Rule, carry_out, decide};
use tautline_kernel::floor::{Floor, Scan, Sensor};
use tautline_kernel::ground::{Cell, Step};

use crate::floor::crew::{Scheme, Sight};
use crate::floor::team::Demands;

/// Ants remember nothing and are never done.
impl Scheme for Rule {
    type Sensor = Sensor;
    type Memory = ();
    type Act = Act;

    fn memory(&self, _: u8) {}

    fn decide(&self, (): &mut (), scan: &Scan) -> Act {
        decide(*self, scan)
    }

    fn carry_out(&self, floor: &mut impl Floor, cell: Cell, act: &Act) -> Cell {
        carry_out(floor, cell, *act)
    }

    fn step(act: &Act) -> Option<Step> {
        Some(act.map_or(Step::Stay, |(side, _)| Step::Cross(side)))
    }

    fn may_roam(&self, _: Sight) -> bool {
        true
    }
}

impl Demands for Rule {
    type Own = Infallible;

    fn name(_: usize, agents: u32) -> &'static str {
        if agents == 1 { " ant" } else { " ants" }
    }
}
