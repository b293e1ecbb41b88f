//! The graph of the states that were met, with nothing of what they are: how each was first found, and which steps lead
//! from it.

use super::Bits;

/// The states that were met, in the order in which they were.
#[derive(Default)]
pub(super) struct Graph {
    pub(super) nodes: Vec<Node>,
    /// Of each node that is gone on from, where its arcs begin.
    pub(super) first_arc: Vec<u32>,
    pub(super) arcs: Vec<Arc>,
}

/// How a state was first found.
#[derive(Clone, Copy)]
pub(super) enum Way {
    /// It is the start with this number.
    Start(u32),
    /// By a step from this node.
    Step(u32),
}

pub(super) struct Node {
    pub(super) way: Way,
    pub(super) owed: Bits,
    pub(super) awake: Bits,
}

pub(super) struct Arc {
    pub(super) to: u32,
    pub(super) acting: Bits,
    pub(super) is_bound: bool,
}

impl Graph {
    /// The steps from a node.
    pub(super) fn arcs(&self, node: usize) -> &[Arc] {
        let end = self.first_arc.get(node + 1).map_or(self.arcs.len(), |&end| end as usize);
        &self.arcs[self.first_arc[node] as usize..end]
    }

    /// The start, and the steps from it that first led to a node.
    pub(super) fn way(&self, mut node: usize) -> (usize, Vec<u32>) {
        let mut steps = Vec::new();
        loop {
            match self.nodes[node].way {
                Way::Start(start) => {
                    steps.reverse();
                    return (start as usize, steps);
                }
                Way::Step(from) => {
                    let before = from as usize;
                    let number = self.arcs(before).iter().position(|arc| arc.to as usize == node);
                    steps.extend(number.map(|number| number as u32));
                    node = before;
                }
            }
        }
    }
}
