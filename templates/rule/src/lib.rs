//! The rule. Two robots go east, one behind the other. The second one waits
//! while the first one is in the cell before it.

use tautline_kernel::ground::{Cell, Side};
use tautline_proofs::team::{Act, Rule, Scene, View};

/// The rule. What can be wrong with it is a field, so that a mutant is another value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct East {
    /// Whether the second robot looks where the first one is.
    pub looks: bool,
}

impl Rule for East {
    /// Whatever a robot remembers.
    type Memory = ();
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) {}

    fn act(&self, view: &mut View<'_, Self>, (): &mut ()) -> Act {
        let first = view.sees(0).filter(|_| view.me() == 1 && self.looks);
        match first.and_then(|cell| view.side_to(cell)) {
            Some(_) => Act::Wait,
            None => Act::Go(Side::East),
        }
    }

    fn is_done(&self, _: usize, team: &Scene<Self>) -> bool {
        team.was_blocked(0)
    }
}

/// Where the robots start.
pub const STARTS: [Cell; 2] = [Cell::new(1, 0), Cell::new(0, 0)];
