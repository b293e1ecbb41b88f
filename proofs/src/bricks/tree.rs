//! Agents that search in trees on small floors (BRICKS-2 to BRICKS-12): brick-tree, helpers and MDFS, as systems whose
//! states are all looked at.

pub(super) mod checks;
mod floors;
mod labels;
pub mod mdfs;
mod state;
mod team;

use tautline_kernel::bricks::tree::{Act, Agent, Condition, Rule, View, carry_out};
use tautline_kernel::bricks::tree::{Next, Notes};
use tautline_kernel::ground::Cell;

/// How agents that search in trees decide.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Way {
    /// By trees that several agents share.
    Trees(Rule),
    /// Each by a tree of its own.
    Mdfs,
}

/// What such an agent remembers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Memory {
    /// Of trees that it shares.
    Shared(Agent),
    /// Of a tree of its own.
    Own(mdfs::Agent),
}

impl Way {
    /// What the agent with this id remembers at the start.
    pub const fn memory(self, id: u8) -> Memory {
        match self {
            Self::Trees(_) => Memory::Shared(Agent::new(id)),
            Self::Mdfs => Memory::Own(mdfs::Agent::new(id)),
        }
    }

    /// What an agent does after a scan.
    pub fn decide(self, memory: &mut Memory, view: &View) -> Act {
        match (self, memory) {
            (Self::Trees(rule), Memory::Shared(agent)) => agent.decide(rule, view),
            (Self::Mdfs, Memory::Own(agent)) => agent.decide(view),
            (Self::Trees(_), Memory::Own(_)) | (Self::Mdfs, Memory::Shared(_)) => {
                Act { here: view.here, next: Next::Done }
            }
        }
    }

    /// Writes what an agent in `cell` has decided; where it is then.
    pub fn carry_out(self, floor: &mut impl Notes, cell: Cell, act: &Act) -> Cell {
        match self {
            Self::Trees(rule) => carry_out(rule, floor, cell, act),
            Self::Mdfs => carry_out(Rule::TREE, floor, cell, act),
        }
    }

    /// Whether agents find out underfoot that they have missed a sensor, so that nothing is lost.
    pub const fn looks_underfoot(self) -> bool {
        match self {
            Self::Trees(rule) => rule.has(Condition::Underfoot),
            Self::Mdfs => false,
        }
    }
}

impl Memory {
    /// The trees that the agent has founded.
    pub const fn founded(self) -> u32 {
        match self {
            Self::Shared(agent) => agent.founded,
            Self::Own(_) => 1,
        }
    }
}

/// How the observer of a mutant is deceived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Deception {
    /// Not at all.
    None,
    /// Agents beside each other scan and write at once.
    ActsAtOnce,
    /// Of several children an agent goes to the first in the order of the compass.
    FirstChild,
}

/// Agents that are observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Observed {
    /// How they decide.
    pub way: Way,
    /// What is done to them behind their back.
    pub deception: Deception,
}

impl Observed {
    /// Agents that follow `rule`, one after the other.
    pub const fn following(rule: Rule) -> Self {
        Self { way: Way::Trees(rule), deception: Deception::None }
    }
}
