//! The records of robots and path nodes (MRC-10 to MRC-14): every order in which a few messages reach one of them,
//! against what follows from the list of them. Repetitions and losses are orders, too.

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::mrc::{
    Downward, Hop, Mail, Relay, Resb, Robot, Rule, ServiceBit, Task, Upward, Wfr, WfrTimer, Word,
};
use tautline_kernel::net::{Call, Epoch, NodeId, Notice, RobotId};

use super::{Misreading, Subject};
use crate::engine::{Choices, Outcome, Replay, require};
use crate::judge::AnyCase;
use crate::judge::mrc::{NoticeRecord, Record};

/// Messages that arrive at a robot or a node.
const MESSAGES: usize = 3;

/// The events of a robot that may be answered or not.
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

fn notice(oracle: &mut dyn Oracle) -> Notice {
    let (call, hops) = (call(oracle), oracle.pick(3) as u16);
    Notice { call, hops, sender: one_of(oracle, &SENDERS) }
}

/// The NOTICEs that these choices of [`records`] make, and what a robot has recorded by them, written down for the
/// judge.
pub(super) fn recorded(observed: &Subject, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let answers: Vec<u32> = choices.all().collect();
    let mut replay = Replay::new(&answers);
    let (mut robot, mut heard) = (Robot::<{ WFRS as usize }>::new(observed.rule, ROBOT), Vec::new());
    let written = |call: Call, hops: u16, sender: NodeId| {
        let [epoch, sender] = [call.epoch.0, sender.0].map(|number| number as i32);
        NoticeRecord { wfr: call.wfr.0 as usize, epoch, hops: hops.into(), sender }
    };
    let mut last = None;
    while replay.asked().len() < answers.len() {
        let notice = notice(&mut replay);
        robot = robot.receive(Downward::Notice(notice)).0;
        heard.push(written(notice.call, notice.hops, notice.sender));
        last = Some(notice.call.wfr);
    }
    let record = robot.request(last?)?;
    let record = written(record.call, record.hops, record.parent);
    Some(Box::new(Record { clause: "MRC-10", heard, record }))
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
pub(super) fn records(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let mut robot = Robot::<{ WFRS as usize }>::new(observed.rule, ROBOT);
    let mut heard: Vec<Notice> = Vec::new();
    let mut situation = "one call";
    for _ in 0..MESSAGES {
        let notice = notice(oracle);
        let is_other = |known: &Notice| known.call != notice.call;
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
pub(super) fn served(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
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
            let is_set = robot.request(wfr).map(|record| record.served == ServiceBit::Yes);
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
pub(super) fn ways_back(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
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

/// The bound of [`repeated`].
pub(super) fn repeats() -> String {
    format!("a robot or a WFR that repeats 0 to {MESSAGES} times, answered or not")
}

/// MRC-13: how often a message is sent until somebody answers.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn repeated(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let repeats = oracle.pick(MESSAGES as u32 + 1) as u8;
    let rule = Rule { repeats, ..observed.rule };
    let call = Call { wfr: NodeId(0), epoch: Epoch::FIRST };
    let demand = "what is not answered is sent as often as the rule repeats";
    let over = "what is answered is sent no more";
    let is_robot = oracle.flip();
    // The number of repeats after which the answer comes, if it comes at all.
    let answered = oracle.pick(u32::from(repeats) + 2) as u8;
    let is_heard = observed.misread != Some(Misreading::Answers);
    if is_robot {
        let notice = Notice { call, hops: 0, sender: SENDERS[0] };
        let (mut robot, mut sent) = Robot::<1>::new(rule, ROBOT).receive(Downward::Notice(notice));
        for number in 0..=repeats {
            let is_move = |sent: Upward| sent.call == call && matches!(sent.word, Word::Move { .. });
            let timer = robot.timer().filter(|timer| timer.repeats_left == repeats - number);
            require(sent.is_some_and(is_move) && timer.is_some(), demand)?;
            if number == answered {
                let chosen = one_of(oracle, &[None, Some(ROBOT), Some(RobotId(1))]);
                let resb = Downward::Resb(Resb { call, robot: ROBOT, chosen });
                robot = if is_heard { robot.receive(resb).0 } else { robot };
                let late = timer.and_then(|timer| robot.expire(timer).1);
                require((robot.timer(), late) == (None, None), over)?;
                return Ok("a robot that is answered");
            }
            if let Some(timer) = timer {
                (robot, sent) = robot.expire(timer);
            }
        }
        require((sent, robot.task()) == (None, Task::Free), demand)?;
        return Ok("a robot");
    }
    let word = Word::Move { hops: 1 };
    let bid = Upward { call, robot: ROBOT, word, parent: call.wfr };
    let (mut wfr, mut sent) = Wfr::<1>::new(rule, call.wfr).raise().0.receive(bid);
    for number in 0..=repeats {
        if let Some(timer) = wfr.timer() {
            (wfr, sent) = wfr.expire(timer);
        }
        let resb = Resb { call, robot: ROBOT, chosen: Some(ROBOT) };
        let is_told = sent == if number == 0 { Mail::All([Some(resb)]) } else { Mail::One(resb) };
        require(is_told && wfr.call() == call, demand)?;
        if number == answered {
            let timer = wfr.timer();
            let answer = Upward { word: one_of(oracle, &[Word::Accept, Word::Decline]), ..bid };
            wfr = if is_heard { wfr.receive(answer).0 } else { wfr };
            let late = timer.map(|timer| wfr.expire(timer).1);
            let waits = matches!(wfr.timer(), Some(WfrTimer::Answer { .. }));
            require(!waits && late == Some(Mail::Nothing), over)?;
            return Ok("a WFR that is answered");
        }
    }
    if let Some(timer) = wfr.timer() {
        (wfr, sent) = wfr.expire(timer);
    }
    require(matches!(sent, Mail::Notice(_)) && wfr.call().epoch == call.epoch.next(), demand)?;
    Ok("a WFR")
}

/// Places of a table that is too small, and what happens to it.
const PLACES: usize = 2;
const FILLINGS: usize = 5;

/// The bound of [`filled`].
pub(super) fn fillings() -> String {
    format!("{FILLINGS} NOTICEs, RESBs or arrivals of {} WFRs, {PLACES} places", PLACES + 1)
}

/// MRC-14: which WFRs a robot knows, and what it does, if its table is too small for all.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn filled(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let mut robot = Robot::<PLACES>::new(observed.rule, ROBOT);
    let (mut table, mut asks, mut holds): (Vec<(u32, bool)>, Option<u32>, Option<u32>) =
        (Vec::new(), None, None);
    let mut situation = "room for all";
    for _ in 0..FILLINGS {
        let wfr = oracle.pick(PLACES as u32 + 1);
        let call = Call { wfr: NodeId(wfr), epoch: Epoch::FIRST };
        let known = table.iter().position(|&(known, _)| known == wfr);
        let event = oracle.pick(4);
        let is_full = table.len() == PLACES && known.is_none();
        if observed.misread == Some(Misreading::Ends) && event == 0 && is_full {
            robot = robot.arrive().0;
        }
        robot = match event {
            0 => robot.receive(Downward::Notice(Notice { call, hops: 0, sender: SENDERS[0] })).0,
            1 | 2 => {
                let chosen = Some(RobotId(event as u16 - 1));
                robot.receive(Downward::Resb(Resb { call, robot: ROBOT, chosen })).0
            }
            _ => robot.arrive().0,
        };
        match (event, known) {
            (0, None) if table.len() < PLACES => table.push((wfr, false)),
            (0, None) => {
                let is_over = |&(known, is_served): &(u32, bool)| is_served && Some(known) != asks.or(holds);
                situation = "nobody gives way";
                if let Some(place) = table.iter_mut().find(|place| is_over(place)) {
                    (*place, situation) = ((wfr, false), "one gives way");
                }
            }
            (1 | 2, Some(place)) => {
                table[place].1 = true;
                if asks == Some(wfr) {
                    (asks, holds) = (None, (event == 1).then_some(wfr));
                }
            }
            (3, _) => holds = None,
            _ => {}
        }
        let seeks = matches!(event, 0 | 3) || event == 2 && known.is_some();
        if seeks && asks.or(holds).is_none() {
            asks = table.iter().filter(|&&(_, is_served)| !is_served).map(|&(wfr, _)| wfr).min();
        }
        let records = robot.requests().map(|request| (request.call.wfr.0, request.served == ServiceBit::Yes));
        require(
            records.eq(table.iter().copied()),
            "a new WFR takes the place of the first that is done with",
        )?;
        let task = match robot.task() {
            Task::Free => (None, None),
            Task::Asking { call, .. } => (Some(call.wfr.0), None),
            Task::Leased { call } => (None, Some(call.wfr.0)),
        };
        require(task == (asks, holds), "it does what the records and answers say")?;
    }
    Ok(situation)
}

/// The message as which a path node reads `message`.
fn read(observed: &Subject, message: Upward) -> Upward {
    match observed.misread {
        Some(Misreading::OneRobot) => Upward { robot: ROBOT, ..message },
        Some(Misreading::OneCall) => Upward { call: Call { epoch: Epoch::FIRST, ..message.call }, ..message },
        Some(Misreading::Askers | Misreading::Offers | Misreading::Ends | Misreading::Answers) | None => {
            message
        }
    }
}
