//! Robots, WFRs, path nodes and guides that are sent any messages at all: nobody panics, a timer that no longer runs
//! changes nothing, and what names another WFR or robot changes nothing.

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::mrc::{
    Downward, Hop, Relay, Resb, Robot, RobotTimer, Rule, Upward, Wfr, WfrTimer, Word,
};
use tautline_kernel::net::{Call, Epoch, NodeId, Notice, RobotId, Strength};
use tautline_kernel::tan::{Guide, Homing, Nav, Nearness, ReqNav, Stage};
use tautline_proofs::engine::{Outcome, require, sample};

const ME: u32 = 1;

fn node(oracle: &mut dyn Oracle) -> NodeId {
    NodeId(one_of(oracle, &[ME, 0, 2, u32::MAX]))
}

fn robot_id(oracle: &mut dyn Oracle) -> RobotId {
    RobotId(one_of(oracle, &[ME as u16, 0, 2, u16::MAX]))
}

fn hops(oracle: &mut dyn Oracle) -> u16 {
    one_of(oracle, &[1, 0, 2, u16::MAX - 1, u16::MAX])
}

fn epoch(oracle: &mut dyn Oracle) -> Epoch {
    Epoch(one_of(oracle, &[1, 0, 2, 3, u32::MAX]))
}

fn call(oracle: &mut dyn Oracle) -> Call {
    Call { wfr: node(oracle), epoch: epoch(oracle) }
}

fn downward(oracle: &mut dyn Oracle) -> Downward {
    if oracle.flip() {
        let chosen = oracle.flip().then(|| robot_id(oracle));
        return Downward::Resb(Resb { call: call(oracle), robot: robot_id(oracle), chosen });
    }
    Downward::Notice(Notice { call: call(oracle), hops: hops(oracle), sender: node(oracle) })
}

fn upward(oracle: &mut dyn Oracle) -> Upward {
    let word = match oracle.pick(3) {
        0 => Word::Move { hops: hops(oracle) },
        1 => Word::Accept,
        _ => Word::Decline,
    };
    Upward { call: call(oracle), robot: robot_id(oracle), word, parent: node(oracle) }
}

fn rule(oracle: &mut dyn Oracle) -> Rule {
    one_of(oracle, &[Rule::REPAIRED, Rule::PUBLISHED])
}

fn robot(oracle: &mut dyn Oracle) -> Outcome {
    let mut robot = Robot::<2>::new(rule(oracle), RobotId(ME as u16));
    for _ in 0..40 {
        let stale = RobotTimer { call: call(oracle), repeats_left: oracle.pick(256) as u8 };
        if robot.timer() != Some(stale) {
            require(robot.expire(stale) == (robot, None), "a stale timer changes nothing")?;
        }
        let message = downward(oracle);
        let next = match oracle.pick(6) {
            0 => robot.arrive().0,
            1 => robot.timer().map_or(robot, |timer| robot.expire(timer).0),
            _ => robot.receive(message).0,
        };
        if let Downward::Resb(resb) = message
            && resb.robot != robot.id()
        {
            require(robot.receive(message) == (robot, None), "another's RESB changes nothing")?;
        }
        let known = |of: &Robot<2>| of.requests().map(|request| request.call.wfr).collect::<Vec<_>>();
        let mut once = known(&next);
        once.sort_unstable();
        once.dedup();
        require(once.len() == known(&next).len(), "T_REQ has one record for a WFR")?;
        robot = next;
    }
    Ok("a robot")
}

fn wfr(oracle: &mut dyn Oracle) -> Outcome {
    let mut wfr = Wfr::<2>::new(rule(oracle), NodeId(ME));
    for _ in 0..40 {
        let stale = one_of(
            oracle,
            &[
                WfrTimer::Window(Epoch(7)),
                WfrTimer::Lease(Epoch(7)),
                WfrTimer::Answer { epoch: Epoch(u32::MAX), repeats_left: u8::MAX },
            ],
        );
        if wfr.timer() != Some(stale) {
            require(wfr.expire(stale).0 == wfr, "a stale timer changes nothing")?;
        }
        let message = upward(oracle);
        let next = match oracle.pick(8) {
            0 => wfr.raise().0,
            1 => wfr.reach(robot_id(oracle)),
            2 => wfr.timer().map_or(wfr, |timer| wfr.expire(timer).0),
            _ => wfr.receive(message).0,
        };
        require(next.call().epoch >= wfr.call().epoch, "epochs never go back")?;
        if message.call.wfr != wfr.call().wfr {
            require(wfr.receive(message).0 == wfr, "what is for another WFR changes nothing")?;
        }
        wfr = next;
    }
    Ok("a WFR")
}

fn relay(oracle: &mut dyn Oracle) -> Outcome {
    let mut relay = Relay::<2>::new(NodeId(ME));
    for _ in 0..40 {
        let message = upward(oracle);
        let from = if oracle.flip() { Hop::Node(node(oracle)) } else { Hop::Robot(robot_id(oracle)) };
        let (next, sent) = relay.up(message, from, node(oracle));
        require(sent.is_some() == (message.parent == NodeId(ME)), "only what is for this node is sent on")?;
        let _ = next.down(Resb { call: call(oracle), robot: robot_id(oracle), chosen: None });
        relay = next;
    }
    Ok("a path node")
}

fn homing(oracle: &mut dyn Oracle) -> Outcome {
    let strength = |oracle: &mut dyn Oracle| Strength(one_of(oracle, &[0, -1, i32::MIN, i32::MAX]));
    let nearness = Nearness {
        near: strength(oracle),
        closer: one_of(oracle, &[0, 600, u16::MAX]),
        times: one_of(oracle, &[1, 0, u8::MAX]),
    };
    let tries = one_of(oracle, &[1, 0, 3, u8::MAX]);
    let first_hops = hops(oracle);
    let mut robot = Homing::new(node(oracle), RobotId(ME as u16), node(oracle), first_hops, nearness, tries);
    let mut guide = Guide::Idle;
    for _ in 0..60 {
        let nav = Nav { wfr: node(oracle), node: node(oracle), hops: hops(oracle), parent: node(oracle) };
        let next = match oracle.pick(8) {
            0 => robot.expire(),
            1 | 2 => robot.hear(nav),
            3 => robot.bump(),
            _ => robot.measure(oracle.flip().then(|| strength(oracle))),
        };
        require(next.hops() <= first_hops, "a robot is never farther by the tree than where it set out")?;
        require(
            next.hops() == 0 || next.stage() != Stage::Arrived,
            "a robot has arrived when no hop is left",
        )?;
        let request = ReqNav { wfr: node(oracle), robot: robot_id(oracle), node: node(oracle) };
        guide = match oracle.pick(3) {
            0 => guide.expire(),
            1 => guide.overhear(),
            _ => guide.request(request, NodeId(ME), Some(nav)),
        };
        robot = next;
    }
    Ok("a robot on its way")
}

#[test]
fn any_messages_at_all_are_borne() {
    for body in [robot, wfr, relay, homing] {
        let tally = sample(20_000, 0, body);
        assert_eq!(tally.violation, None);
        assert_eq!((tally.cases, tally.covered.len()), (20_000, 1));
    }
}
