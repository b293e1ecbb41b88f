//! Robots, WFRs, path nodes and guides that are sent any messages at all: nobody panics, a timer that no longer runs
//! changes nothing, and what names another WFR or robot changes nothing.

use tautline_kernel::broadcast::NodeId;
use tautline_kernel::choice::{Source, one_of};
use tautline_kernel::homing::{Guide, Homing, Nav, Nearness, Position, ReqNav, Stage, Station};
use tautline_kernel::homing::{Strength, verma};
use tautline_kernel::rescue::{
    Call, Downward, Epoch, Hop, Notice, Relay, Resb, Robot, RobotId, RobotTimer, Rule, Upward, Wfr, WfrTimer,
    Word,
};
use tautline_proofs::engine::{Outcome, require, sample};

const ME: u32 = 1;

fn node(source: &mut dyn Source) -> NodeId {
    NodeId(one_of(source, &[ME, 0, 2, u32::MAX]))
}

fn robot_id(source: &mut dyn Source) -> RobotId {
    RobotId(one_of(source, &[ME as u16, 0, 2, u16::MAX]))
}

fn hops(source: &mut dyn Source) -> u16 {
    one_of(source, &[1, 0, 2, u16::MAX - 1, u16::MAX])
}

fn epoch(source: &mut dyn Source) -> Epoch {
    Epoch(one_of(source, &[1, 0, 2, 3, u32::MAX]))
}

fn call(source: &mut dyn Source) -> Call {
    Call { wfr: node(source), epoch: epoch(source) }
}

fn downward(source: &mut dyn Source) -> Downward {
    if source.flip() {
        let chosen = source.flip().then(|| robot_id(source));
        return Downward::Resb(Resb { call: call(source), robot: robot_id(source), chosen });
    }
    Downward::Notice(Notice { call: call(source), hops: hops(source), sender: node(source) })
}

fn upward(source: &mut dyn Source) -> Upward {
    let word = match source.pick(3) {
        0 => Word::Move { hops: hops(source) },
        1 => Word::Accept,
        _ => Word::Decline,
    };
    Upward { call: call(source), robot: robot_id(source), word, parent: node(source) }
}

fn rule(source: &mut dyn Source) -> Rule {
    one_of(source, &[Rule::REPAIRED, Rule::PUBLISHED])
}

fn robot(source: &mut dyn Source) -> Outcome {
    let mut robot = Robot::<2>::new(rule(source), RobotId(ME as u16));
    for _ in 0..40 {
        let stale = RobotTimer { call: call(source), repeats_left: source.pick(256) as u8 };
        if robot.timer() != Some(stale) {
            require(robot.expire(stale) == (robot, None), "a stale timer changes nothing")?;
        }
        let message = downward(source);
        let next = match source.pick(6) {
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

fn wfr(source: &mut dyn Source) -> Outcome {
    let mut wfr = Wfr::<2>::new(rule(source), NodeId(ME));
    for _ in 0..40 {
        let stale = one_of(
            source,
            &[
                WfrTimer::Window(Epoch(7)),
                WfrTimer::Lease(Epoch(7)),
                WfrTimer::Answer { epoch: Epoch(u32::MAX), repeats_left: u8::MAX },
            ],
        );
        if wfr.timer() != Some(stale) {
            require(wfr.expire(stale).0 == wfr, "a stale timer changes nothing")?;
        }
        let message = upward(source);
        let next = match source.pick(8) {
            0 => wfr.raise().0,
            1 => wfr.reach(robot_id(source)),
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

fn relay(source: &mut dyn Source) -> Outcome {
    let mut relay = Relay::<2>::new(NodeId(ME));
    for _ in 0..40 {
        let message = upward(source);
        let from = if source.flip() { Hop::Node(node(source)) } else { Hop::Robot(robot_id(source)) };
        let (next, sent) = relay.up(message, from, node(source));
        require(sent.is_some() == (message.parent == NodeId(ME)), "only what is for this node is sent on")?;
        let _ = next.down(Resb { call: call(source), robot: robot_id(source), chosen: None });
        relay = next;
    }
    Ok("a path node")
}

fn homing(source: &mut dyn Source) -> Outcome {
    let strength = |source: &mut dyn Source| Strength(one_of(source, &[0, -1, i32::MIN, i32::MAX]));
    let nearness = Nearness {
        near: strength(source),
        closer: one_of(source, &[0, 600, u16::MAX]),
        times: one_of(source, &[1, 0, u8::MAX]),
    };
    let tries = one_of(source, &[1, 0, 3, u8::MAX]);
    let first_hops = hops(source);
    let mut robot = Homing::new(node(source), RobotId(ME as u16), node(source), first_hops, nearness, tries);
    let mut guide = Guide::IDLE;
    for _ in 0..60 {
        let nav = Nav { wfr: node(source), node: node(source), hops: hops(source), parent: node(source) };
        let next = match source.pick(8) {
            0 => robot.expire(),
            1 | 2 => robot.hear(nav),
            3 => robot.bump(),
            _ => robot.measure(source.flip().then(|| strength(source))),
        };
        require(next.hops() <= first_hops, "a robot is never farther by the tree than where it set out")?;
        require(
            next.hops() == 0 || next.stage() != Stage::Arrived,
            "a robot has arrived when no hop is left",
        )?;
        let request = ReqNav { wfr: node(source), robot: robot_id(source), node: node(source) };
        guide = match source.pick(3) {
            0 => guide.expire(),
            1 => guide.overhear(),
            _ => guide.request(request, NodeId(ME), Some(nav)),
        };
        robot = next;
    }
    let far = |source: &mut dyn Source| one_of(source, &[0, 1, i64::MIN, i64::MAX]);
    let station = |source: &mut dyn Source| Station {
        at: Position { x_um: far(source), y_um: far(source) },
        hops: hops(source),
    };
    let stations: Vec<Station> = (0..source.pick(5)).map(|_| station(source)).collect();
    let _ = verma(stations);
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
