//! A robot on its way by TAN (TAN-1, TAN-2): a few legs, in each of which it hears some node's signal, of the tree that
//! it follows or of another, and then comes to that node or hears it no more. Where nodes are, and how strong they are
//! heard, is left out: any strength may be measured.

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::net::{NodeId, RobotId, Strength};
use tautline_kernel::tan::{Heading, Homing, Nav, Nearness, Stage};

use crate::engine::{Outcome, Stop, require};

/// How a robot reads the signals that it hears.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Reading {
    /// As they were sent.
    True,
    /// It takes any node nearer to its WFR for one that is one hop nearer.
    AnyNearer,
    /// It takes any node for the one that it has asked.
    AnyNode,
    /// It takes the tree of any WFR for that of its own.
    AnyTree,
    /// It takes a node for its own parent.
    NoParent,
}

/// Signals that are heard.
const SIGNALS: usize = 3;

/// Nodes that signal, and roots of the trees in which they do.
const NODES: u32 = 3;
const TREES: [NodeId; 2] = [WFR, NodeId(9)];

const WFR: NodeId = NodeId(0);
const NEARNESS: Nearness = Nearness { near: Strength(100), closer: 10, times: 1 };
const TRIES: u8 = 2;

/// A robot's leg towards a signal that it hears.
struct Leg {
    before: Homing,
    nav: Nav,
    heard: Homing,
    /// Whether it comes to the node, if it has followed the signal.
    comes: bool,
    after: Homing,
}

/// The bound of both.
pub(super) fn signals() -> String {
    format!("{SIGNALS} signals of any of {NODES} nodes, in {} trees", TREES.len())
}

/// TAN-1: the signal that a robot follows.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn follows(reading: &Reading, oracle: &mut dyn Oracle) -> Outcome {
    legs(reading, oracle, |leg| {
        let Stage::Asking { node } = leg.before.stage() else { return Ok("it does not ask") };
        let Nav { wfr, hops, .. } = leg.nav;
        let is_due = leg.nav.node == node && wfr == WFR && hops.checked_add(1) == Some(leg.before.hops());
        let follows = matches!(leg.heard.stage(), Stage::Scanning { .. });
        require(
            follows == is_due,
            "it follows the node that it has asked, one hop nearer in the tree of its WFR",
        )?;
        Ok(if follows { "a signal followed" } else { "a signal ignored" })
    })
}

/// TAN-2: where a robot is, and where it goes next, when it is at a node.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn goes_on(reading: &Reading, oracle: &mut dyn Oracle) -> Outcome {
    legs(reading, oracle, |leg| {
        if !matches!(leg.heard.stage(), Stage::Scanning { .. }) {
            return Ok("no signal followed");
        }
        let Nav { node, hops, parent, .. } = leg.nav;
        let is_at_end = node == WFR;
        match leg.after.stage() {
            Stage::Arrived => {
                require(leg.comes && is_at_end, "it has arrived at the WFR alone")?;
                Ok("at the WFR")
            }
            Stage::Asking { node } if leg.comes => {
                let is_next = !is_at_end && node == parent && leg.after.hops() == hops;
                require(is_next, "the next is the parent of the node")?;
                Ok("at a node")
            }
            Stage::Asking { .. } | Stage::Lost | Stage::Scanning { .. } | Stage::Walking { .. } => {
                require(!leg.comes, "a robot that has come to a node knows it")?;
                Ok("the signal lost")
            }
        }
    })
}

/// Goes through legs, and returns the last situation, or whichever of them is `Err`.
fn legs(
    reading: &Reading,
    oracle: &mut dyn Oracle,
    judge: impl Fn(&Leg) -> Result<&'static str, Stop>,
) -> Outcome {
    let hops = 2 + oracle.pick(2) as u16;
    let mut robot = Homing::new(WFR, RobotId(1), NodeId(1), hops, NEARNESS, TRIES);
    let mut situation = "no signal";
    for _ in 0..SIGNALS {
        if !matches!(robot.stage(), Stage::Asking { .. }) {
            break;
        }
        let nav = nav(oracle);
        let heard = robot.hear(read(reading, nav, robot));
        let (comes, after) = match heard.stage() {
            Stage::Scanning { .. } => {
                let comes = !oracle.flip();
                (comes, measured(heard, comes))
            }
            Stage::Asking { .. } | Stage::Walking { .. } | Stage::Arrived | Stage::Lost => {
                (false, heard.expire())
            }
        };
        situation = judge(&Leg { before: robot, nav, heard, comes, after })?;
        robot = after;
    }
    Ok(situation)
}

/// A signal of one of three nodes, the WFR among them. The WFR is the root of its tree, and nothing else has no hops.
fn nav(oracle: &mut dyn Oracle) -> Nav {
    let (wfr, node) = (one_of(oracle, &TREES), NodeId(oracle.pick(NODES)));
    if node == wfr {
        return Nav { wfr, node, hops: 0, parent: node };
    }
    let hops = one_of(oracle, &[1, 2, 3, u16::MAX]);
    Nav { wfr, node, hops, parent: NodeId(oracle.pick(NODES)) }
}

/// A robot that has turned its antenna once round, and then comes to the node, or loses its signal on the way.
fn measured(mut robot: Homing, comes: bool) -> Homing {
    let strength = if comes { 10 * NEARNESS.near.0 } else { NEARNESS.near.0 - 1 };
    for _ in Heading::all() {
        robot = robot.measure(Some(Strength(strength)));
        if !matches!(robot.stage(), Stage::Scanning { .. }) {
            break;
        }
    }
    match robot.stage() {
        Stage::Walking { .. } => robot.measure(None),
        Stage::Asking { .. } | Stage::Scanning { .. } | Stage::Arrived | Stage::Lost => robot,
    }
}

/// The signal that a robot takes `nav` for.
fn read(reading: &Reading, nav: Nav, robot: Homing) -> Nav {
    match (reading, robot.stage()) {
        (Reading::AnyNearer, _) if nav.hops < robot.hops() => Nav { hops: robot.hops() - 1, ..nav },
        (Reading::AnyNode, Stage::Asking { node }) => Nav { node, ..nav },
        (Reading::AnyTree, _) => Nav { wfr: WFR, ..nav },
        (Reading::NoParent, _) => Nav { parent: nav.node, ..nav },
        (Reading::True | Reading::AnyNearer | Reading::AnyNode, _) => nav,
    }
}
