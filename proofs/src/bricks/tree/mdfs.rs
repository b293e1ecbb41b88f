//! Multiple depth first search, the rival that Brick&Mortar was first compared with: each agent has a tree of its own, and
//! an agent with no way on takes itself for done. Our reading of a rule that the text we have names and does not print.

use tautline_kernel::bricks::tree::{Act, Label, Next, State, View};
use tautline_kernel::ground::Side;

/// An agent: its id, and the side that it went through last.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Agent {
    /// No two agents have the same.
    pub id: u8,
    heading: Option<Side>,
}

impl Agent {
    /// An agent before its first action.
    pub const fn new(id: u8) -> Self {
        Self { id, heading: None }
    }

    /// What it does after a scan. A new cell becomes one of its own, the cell that it comes from the parent. It goes to an
    /// unexplored neighbour; else it marks a cell of its own and goes to its parent; else, in another's cell or at its
    /// root, to the neighbour not yet visited that was entered least. Without one it is done.
    pub fn decide(&mut self, view: &View) -> Act {
        let own = Label::new(0, self.id).unwrap_or_default();
        let mut here = view.here;
        if here.state == State::Explored {
            here = here.of_tree(own, self.heading.map(Side::opposite));
        }
        let others = || view.neighbours().filter(|(_, note)| note.state != State::Visited);
        let least = || others().min_by_key(|(_, note)| note.crossings).map(|(side, _)| Next::Goes(side));
        let next = if let Some(side) = view.way_on() {
            Next::Explores(side)
        } else if here.tree() == Some(own) {
            let parent = here.side.filter(|&parent| others().any(|(side, _)| side == parent));
            let next = parent.map(Next::Goes).or_else(least).unwrap_or(Next::Done);
            here = here.visited(parent);
            next
        } else {
            least().unwrap_or(Next::Done)
        };
        self.heading = next.side().or(self.heading);
        Act { here, next }
    }
}
