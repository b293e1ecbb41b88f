//! MRC under a network that misbehaves: the kernel's robots and WFRs, the messages between them, and everything that
//! can go wrong within a [`Setting`]. What is searched for all states that can be reached is in
//! [`space`](super::space); a run is drawn by [`chart`](super::chart).
//!
//! A message takes any time and overtakes others. A timer runs longer than what it waits for: it goes off when none of
//! that is on its way, whatever goes on elsewhere, or earlier, which is one of the [`Faults`]. Epochs are only
//! compared: two states that differ by a renumbering that keeps their order are one, and so the states are finitely
//! many.

mod action;
mod demand;
mod next;
mod parts;
mod setting;
mod turn;
mod violations;

use std::mem;

use tautline_kernel::mrc::{Robot, Wfr};
use tautline_kernel::net::{Epoch, NodeId, RobotId};

use crate::engine::states::Places;

pub use action::{Action, Actor, Message};
pub use demand::Demand;
use demand::Notes;
pub(super) use parts::Part;
pub use setting::{Faults, Leases, LossKind, ROBOTS, Setting, WFRS};

/// Robots, WFRs and what is between them.
#[derive(Debug)]
pub struct State {
    pub(super) hops: [[u16; WFRS]; ROBOTS],
    pub(super) robots: [Robot<WFRS>; ROBOTS],
    pub(super) wfrs: [Wfr<ROBOTS>; WFRS],
    pub(super) failed: [bool; ROBOTS],
    /// The call on whose tree a path node between robot and WFR has failed.
    cut: [[Option<Epoch>; WFRS]; ROBOTS],
    /// Sorted.
    pub(super) network: Vec<Message>,
    left: Faults,
    events_left: u8,
    notes: Notes,
    /// The places of the parts that were touched since the state was canonical.
    touched: Places,
    is_canonical: bool,
}

const fn node(wfr: usize) -> NodeId {
    NodeId(wfr as u32)
}

pub(super) const fn place(id: NodeId) -> usize {
    id.0 as usize
}

const fn robot_id(robot: usize) -> RobotId {
    RobotId(robot as u16)
}

impl Setting {
    /// The states in which nothing has happened, one for each combination of hops.
    pub fn starts(&self) -> Vec<State> {
        let ways = self.robots * self.wfrs;
        let all = u32::from(self.max_hops).pow(ways as u32);
        (0..all).map(|number| self.start(number)).collect()
    }

    /// Which of [`Self::starts`], one after the other, without the others.
    pub fn start(&self, mut number: u32) -> State {
        let mut hops = [[1; WFRS]; ROBOTS];
        for row in &mut hops[..self.robots] {
            for hops in &mut row[..self.wfrs] {
                *hops = 1 + (number % u32::from(self.max_hops)) as u16;
                number /= u32::from(self.max_hops);
            }
        }
        State {
            hops,
            robots: std::array::from_fn(|robot| Robot::new(self.rule, robot_id(robot))),
            wfrs: std::array::from_fn(|wfr| Wfr::new(self.rule, node(wfr))),
            failed: [false; ROBOTS],
            cut: [[None; WFRS]; ROBOTS],
            network: Vec::new(),
            left: self.faults,
            events_left: self.events,
            notes: Notes::default(),
            touched: Places::MAX,
            is_canonical: false,
        }
    }
}

impl Clone for State {
    fn clone(&self) -> Self {
        Self { network: self.network.clone(), ..*self }
    }

    fn clone_from(&mut self, other: &Self) {
        let mut network = mem::take(&mut self.network);
        network.clone_from(&other.network);
        *self = Self { network, ..*other };
    }
}

impl State {
    /// A robot.
    pub const fn robot(&self, robot: usize) -> &Robot<WFRS> {
        &self.robots[robot]
    }

    /// A WFR.
    pub const fn wfr(&self, wfr: usize) -> &Wfr<ROBOTS> {
        &self.wfrs[wfr]
    }

    /// Hops from a robot to a WFR.
    pub const fn hops(&self, robot: usize, wfr: usize) -> u16 {
        self.hops[robot][wfr]
    }

    /// The messages on their way.
    pub fn network(&self) -> &[Message] {
        &self.network
    }
}
