//! What robots and path nodes write down (MRC-10 to MRC-12): every order in which a few messages reach one of them, against
//! what follows from the list of them. Repetitions and losses are orders, too.

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::mrc::{Downward, Hop, Relay, Resb, Robot, Served, Upward, Word};
use tautline_kernel::net::{Call, Epoch, NodeId, Notice, RobotId};

use super::{Misread, Observed};
use crate::engine::{Outcome, require};

/// Messages that arrive at a robot or a node.
const MESSAGES: usize = 3;

/// What happens to a robot that may be answered or not.
const ANSWERS: usize = 4;

/// WFRs, calls of each, and robots whose messages a node sends on.
const WFRS: u32 = 2;
const CALLS: u32 = 2;
const ROBOTS: u32 = 2;

const ROBOT: RobotId = RobotId(0);

/// Nodes that hand on a message.
const SENDERS: [NodeId; 2] = [NodeId(5), NodeId(6)];

fn call(oracle: &mut dyn Oracle) -> Call {
    Call { wfr: NodeId(oracle.pick(WFRS)), epoch: Epoch(1 + oracle.pick(CALLS)) }
}

/// The bound of [`records`].
pub(super) fn notices() -> String {
    format!("{MESSAGES} NOTICEs of {WFRS} WFRs, {CALLS} calls each")
}

/// The bound of [`served`].
pub(super) fn answers() -> String {
    format!("{ANSWERS} NOTICEs, RESBs or timers of {WFRS} WFRs, {CALLS} calls each")
}

/// The bound of [`ways_back`].
pub(super) fn messages() -> String {
    format!("{MESSAGES} messages of {ROBOTS} robots to {WFRS} WFRs, {CALLS} calls each")
}

/// MRC-10: a robot's records, and its bids, whatever NOTICEs it hears.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn records(observed: &Observed, oracle: &mut dyn Oracle) -> Outcome {
    let mut robot = Robot::<{ WFRS as usize }>::new(observed.rule, ROBOT);
    let mut heard: Vec<Notice> = Vec::new();
    let mut situation = "one call";
    for _ in 0..MESSAGES {
        let (call, hops) = (call(oracle), oracle.pick(3) as u16);
        let notice = Notice { call, hops, sender: one_of(oracle, &SENDERS) };
        let is_other = |known: &Notice| known.call != call;
        if heard.iter().any(is_other) {
            situation = "several calls";
        }
        heard.push(notice);
        let (next, sent) = robot.receive(Downward::Notice(notice));
        robot = next;
        for wfr in (0..WFRS).map(NodeId) {
            let newest = heard.iter().map(|notice| notice.call).filter(|call| call.wfr == wfr).max();
            let of_newest = heard.iter().filter(|notice| Some(notice.call) == newest);
            // The first of those with the fewest hops.
            let nearest = of_newest.min_by_key(|notice| notice.hops);
            let record = robot.request(wfr).map(|record| (record.call, record.hops, record.parent));
            let due = nearest.map(|notice| (notice.call, notice.hops + 1, notice.sender));
            require(
                record == due,
                "the record is that of the newest call, its least hop count and the first sender of it",
            )?;
            if let Some(Upward { call, robot, word, parent }) = sent
                && call.wfr == wfr
            {
                let bid = due.map(|(call, hops, parent)| (call, Word::Move { hops }, parent));
                require((Some((call, word, parent)), robot) == (bid, ROBOT), "the bid is by the record")?;
            }
        }
    }
    Ok(situation)
}

/// MRC-12: a robot's SBits, whatever it hears, and however often it is not answered.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn served(observed: &Observed, oracle: &mut dyn Oracle) -> Outcome {
    let mut robot = Robot::<{ WFRS as usize }>::new(observed.rule, ROBOT);
    let mut bits: [Option<(Epoch, bool)>; 2] = [None; WFRS as usize];
    let mut situation = "no SBit";
    for _ in 0..ANSWERS {
        match oracle.pick(3) {
            0 => {
                let call = call(oracle);
                let bit = &mut bits[call.wfr.0 as usize];
                *bit = bit.filter(|&(epoch, _)| epoch >= call.epoch).or(Some((call.epoch, false)));
                let notice = Notice { call, hops: call.wfr.0 as u16, sender: SENDERS[0] };
                robot = robot.receive(Downward::Notice(notice)).0;
            }
            1 => {
                let call = call(oracle);
                if let Some((epoch, is_set)) = &mut bits[call.wfr.0 as usize] {
                    *is_set |= *epoch == call.epoch;
                }
                let chosen = [None, Some(ROBOT), Some(RobotId(1))][oracle.pick(3) as usize];
                robot = robot.receive(Downward::Resb(Resb { call, robot: ROBOT, chosen })).0;
            }
            _ => {
                let Some(timer) = robot.timer() else { continue };
                if timer.repeats_left == 0
                    && let Some((_, is_set)) = &mut bits[timer.call.wfr.0 as usize]
                {
                    *is_set = true;
                    situation = "asked in vain";
                }
                robot = robot.expire(timer).0;
            }
        }
        for (wfr, bit) in (0..).map(NodeId).zip(bits) {
            let is_set = robot.request(wfr).map(|record| record.served == Served::Yes);
            require(
                is_set == bit.map(|(_, is_set)| is_set),
                "the SBit tells whether the robot is done with the call",
            )?;
        }
    }
    let is_told = bits.iter().flatten().any(|&(_, is_set)| is_set);
    Ok(if situation == "no SBit" && is_told { "told of a choice" } else { situation })
}

/// MRC-11: where a path node sends what it is to send on.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn ways_back(observed: &Observed, oracle: &mut dyn Oracle) -> Outcome {
    const ME: NodeId = NodeId(7);
    const PARENT: NodeId = NodeId(3);
    let mut relay = Relay::<{ (WFRS * ROBOTS) as usize }>::new(ME);
    let mut carried: Vec<(Call, RobotId, Hop)> = Vec::new();
    for _ in 0..MESSAGES {
        let (call, robot) = (call(oracle), RobotId(oracle.pick(ROBOTS) as u16));
        let from = [Hop::Robot(robot), Hop::Node(SENDERS[0]), Hop::Node(SENDERS[1])][oracle.pick(3) as usize];
        let (word, is_mine) = (Word::Move { hops: 2 }, !oracle.flip());
        let message = Upward { call, robot, word, parent: if is_mine { ME } else { NodeId(8) } };
        let told = read(observed, message);
        let (next, onward) = relay.up(told, from, PARENT);
        relay = next;
        let due = is_mine.then_some(Upward { parent: PARENT, ..told });
        require(onward == due, "a message for this node, and no other, goes to the node's parent")?;
        if is_mine {
            carried.push((call, robot, from));
        }
    }
    let mut situation = "no way back";
    for &(call, robot, _) in &carried {
        let of_robot = || carried.iter().filter(|known| (known.0.wfr, known.1) == (call.wfr, robot));
        if of_robot().any(|known| known.0.epoch > call.epoch) {
            continue;
        }
        let told = read(observed, Upward { call, robot, word: Word::Accept, parent: ME });
        let resb = Resb { call: told.call, robot: told.robot, chosen: None };
        let latest = of_robot().rfind(|known| known.0 == call).map(|known| known.2);
        require(
            relay.down(resb) == latest,
            "a RESB goes to whom the robot's latest message of the call came from",
        )?;
        situation = "a way back";
    }
    let stranger = Resb { call: call(oracle), robot: RobotId(9), chosen: None };
    require(relay.down(stranger).is_none(), "a RESB of a robot that was not heard ends here")?;
    Ok(situation)
}

/// What a path node takes `message` for.
fn read(observed: &Observed, message: Upward) -> Upward {
    match observed.misread {
        Some(Misread::OneRobot) => Upward { robot: ROBOT, ..message },
        Some(Misread::OneCall) => Upward { call: Call { epoch: Epoch::FIRST, ..message.call }, ..message },
        None => message,
    }
}
