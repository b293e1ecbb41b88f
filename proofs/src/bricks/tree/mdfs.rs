//! Multiple depth first search, the rival that Brick&Mortar was first compared with: each agent has
//! a tree of its own, and an agent with no way on takes itself for done. Our reading of a rule that
//! the text we have names and does not print.

use tautline_kernel::bricks::tree::{Act, Label, Next, Rule, State, View};
use tautline_kernel::ground::Side;

use super::TreeRule;

/// The rule of MDFS.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Mdfs;

/// An agent: its id, and the side that it went through last.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Agent {
    id: u8,
    heading: Option<Side>,
}

impl TreeRule for Mdfs {
    type Memory = Agent;

    fn memory(&self, id: u8) -> Agent {
        Agent { id, heading: None }
    }

    /// A new cell becomes one of the agent's own, the cell that it comes from the parent. It goes to an unexplored
    /// neighbour; else it marks a cell of its own and goes to its parent; else, in another's cell or at its root, to
    /// the neighbour not yet visited that was entered least. Without one it is done.
    fn decide(&self, agent: &mut Agent, view: &View) -> Act {
        let own = Label::new(0, agent.id).unwrap_or_default();
        let mut here = view.here;
        if here.state == State::Explored {
            here = here.of_tree(own, agent.heading.map(Side::opposite));
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
        agent.heading = next.side().or(agent.heading);
        Act { here, next }
    }

    fn writes(&self) -> Rule {
        Rule::TREE
    }

    fn founded(_: &Agent) -> u32 {
        1
    }
}
