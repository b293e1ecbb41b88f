//! The answers of robots and WFRs in every state that they can come to, with two epochs of two WFRs and two robots; a
//! robot also with a table of one record. The states that differ in hop counts, or in how often something is still
//! repeated, are one here.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::hash::Hash;

use tautline_kernel::mrc::{Downward, Mail, Phase, Resb, Robot, Rule, ServiceBit, Task, Upward, Wfr, Word};
use tautline_kernel::net::{Call, Epoch, NodeId, Notice, RobotId};

use super::term::{definition, list, option};

pub(super) const ME: RobotId = RobotId(1);
pub(super) const OTHER: RobotId = RobotId(2);
pub(super) const LAST: Epoch = Epoch(2);

pub(super) const fn call(wfr: u32, epoch: u32) -> Call {
    Call { wfr: NodeId(wfr), epoch: Epoch(epoch) }
}

fn calls() -> impl Iterator<Item = Call> {
    [1, 2].into_iter().flat_map(|wfr| [1, 2].map(|epoch| call(wfr, epoch)))
}

pub(super) fn of(call: Call) -> String {
    format!("{} {}", call.wfr.0, call.epoch.0)
}

pub(super) fn robot_id(robot: Option<RobotId>) -> String {
    option(robot.map(|robot| robot.0.to_string()))
}

fn notice(notice: Notice) -> String {
    format!("Notice {}", of(notice.call))
}

fn resb(resb: Resb) -> String {
    format!("Resb {} {} {}", of(resb.call), resb.robot.0, robot_id(resb.chosen))
}

fn upward(message: Upward) -> String {
    let word = match message.word {
        Word::Move { .. } => "Move",
        Word::Accept => "Accept",
        Word::Decline => "Decline",
    };
    format!("{word} {} {}", of(message.call), message.robot.0)
}

/// The answers in a state: the states and the messages that may follow, each as a Rocq term.
pub(super) type Answers = BTreeMap<(String, String), BTreeSet<(String, String)>>;

/// Goes through every state that can be reached from `first`, and adds what comes of each input.
pub(super) fn explore<S: Copy + Eq + Hash>(
    first: S,
    term: impl Fn(&S) -> String,
    next: impl Fn(&S) -> Vec<(String, S, String)>,
    is_within: impl Fn(&S) -> bool,
    answers: &mut Answers,
) {
    let (mut known, mut left) = (HashSet::from([first]), vec![first]);
    while let Some(state) = left.pop() {
        for (input, after, sent) in next(&state) {
            answers.entry((term(&state), input)).or_default().insert((term(&after), sent));
            if is_within(&after) && known.insert(after) {
                left.push(after);
            }
        }
    }
}

fn robot_term<const CALLS: usize>(robot: &Robot<CALLS>) -> String {
    let requests = robot
        .requests()
        .map(|request| format!("Build_request {} {}", of(request.call), request.served == ServiceBit::Yes));
    let task = match robot.task() {
        Task::Free => "Free".to_owned(),
        Task::Asking { call, .. } => format!("(Asking {})", of(call)),
        Task::Leased { call } => format!("(Leased {})", of(call)),
    };
    format!("Build_robot [{}] {task}", requests.collect::<Vec<_>>().join("; "))
}

fn robot_inputs<const CALLS: usize>(robot: &Robot<CALLS>) -> Vec<(String, Robot<CALLS>, String)> {
    let mut all = Vec::new();
    let mut add = |input: String, (after, sent): (Robot<CALLS>, Option<Upward>)| {
        all.push((input, after, format!("[{}]", sent.map_or(String::new(), upward))));
    };
    for call in calls() {
        // Hop counts make one WFR the nearer one.
        let message = Notice { call, hops: call.wfr.0 as u16, sender: NodeId(9) };
        add(format!("Told ({})", notice(message)), robot.receive(Downward::Notice(message)));
        for chosen in [None, Some(ME), Some(OTHER)] {
            let message = Resb { call, robot: ME, chosen };
            add(format!("Told ({})", resb(message)), robot.receive(Downward::Resb(message)));
        }
        add(format!("Lapses {}", of(call)), robot.lapse(call));
    }
    let message = Resb { call: call(1, 1), robot: OTHER, chosen: Some(ME) };
    add(format!("Told ({})", resb(message)), robot.receive(Downward::Resb(message)));
    if let Some(timer) = robot.timer() {
        add("Waited".to_owned(), robot.expire(timer));
    }
    add("Arrives".to_owned(), robot.arrive());
    all
}

fn wfr_term(wfr: &Wfr<2>) -> String {
    let phase = match wfr.phase() {
        Phase::Idle => "Idle".to_owned(),
        Phase::Collecting { best } => format!("(Collecting {})", robot_id(best.map(|best| best.robot))),
        Phase::Offered { choice, .. } => format!("(Offered {})", choice.robot.0),
        Phase::Leased { choice } => format!("(CountsOn {})", choice.robot.0),
        Phase::Rescued { .. } => "Rescued".to_owned(),
    };
    let asked: Vec<String> = wfr.asked().map(|robot| robot.0.to_string()).collect();
    format!("Build_wfr {} {phase} [{}]", wfr.call().epoch.0, asked.join("; "))
}

fn wfr_inputs(wfr: &Wfr<2>) -> Vec<(String, Wfr<2>, String)> {
    let mut all = Vec::new();
    let mut add = |input: &str, (after, sent): (Wfr<2>, Mail<2>)| {
        let sent = match sent {
            Mail::Nothing => String::new(),
            Mail::Notice(message) => notice(message),
            Mail::One(message) => resb(message),
            Mail::All(messages) => messages.into_iter().flatten().map(resb).collect::<Vec<_>>().join("; "),
        };
        all.push((input.to_owned(), after, format!("[{sent}]")));
    };
    add("Raised", wfr.raise());
    for call in calls() {
        for robot in [ME, OTHER] {
            for word in [Word::Move { hops: 1 }, Word::Move { hops: 2 }, Word::Accept, Word::Decline] {
                let message = Upward { call, robot, word, parent: call.wfr };
                add(&format!("Hears ({})", upward(message)), wfr.receive(message));
            }
        }
    }
    if let Some(timer) = wfr.timer() {
        add("Expires", wfr.expire(timer));
    }
    add("Reached", (wfr.reach(ME), Mail::Nothing));
    all
}

/// The states, the inputs and the lists of messages that occur, each once; and for every state that was gone on from,
/// which are the first ones, and every input the numbers of what may follow. Where nothing changes and nothing is sent,
/// that list is empty.
pub(super) fn table(name: &str, state: &str, input: &str, answers: &Answers) -> String {
    let each = |terms: BTreeSet<&String>| -> Vec<String> { terms.into_iter().cloned().collect() };
    let followers = || answers.values().flatten();
    let expanded: BTreeSet<&String> = answers.keys().map(|(state, _)| state).collect();
    let beyond = followers().map(|(state, _)| state).filter(|state| !expanded.contains(state)).collect();
    let inputs = each(answers.keys().map(|(_, input)| input).collect());
    let says = each(followers().map(|(_, sent)| sent).collect());
    let expanded = each(expanded);
    let states = [expanded.clone(), each(beyond)].concat();
    let place =
        |terms: &[String], term: &str| terms.iter().position(|known| known == term).expect("it is listed");
    let silence = place(&says, "[]");
    let answer = |number: usize, input: &String| {
        let after = answers.get(&(states[number].clone(), input.clone())).into_iter().flatten();
        let after = after.map(|(after, sent)| (place(&states, after), place(&says, sent)));
        let after: Vec<(usize, usize)> = after.collect();
        if after == [(number, silence)] {
            return "[]".to_owned();
        }
        let after: Vec<String> = after.iter().map(|(state, sent)| format!("({state},{sent})")).collect();
        format!("[{}]", after.join(";"))
    };
    let rows = (0..expanded.len())
        .map(|number| format!("\n  {}", list(inputs.iter().map(|input| answer(number, input)))));
    let lists = [
        ("states", format!("list {state}"), list(states.iter().cloned())),
        ("inputs", format!("list {input}"), list(inputs.iter().cloned())),
        ("says", "list (list message)".to_owned(), list(says.iter().cloned())),
        ("answers", "list (list (list (nat * nat)))".to_owned(), list(rows)),
    ];
    lists.map(|(part, kind, list)| definition(&format!("{name}_{part}"), &kind, &list)).concat()
}

pub(super) fn terms() -> String {
    let (mut robots, mut wfrs) = (Answers::new(), Answers::new());
    explore(Robot::<1>::new(Rule::REPAIRED, ME), robot_term, robot_inputs, |_| true, &mut robots);
    explore(Robot::<2>::new(Rule::REPAIRED, ME), robot_term, robot_inputs, |_| true, &mut robots);
    let within = |wfr: &Wfr<2>| wfr.call().epoch <= LAST;
    explore(Wfr::<2>::new(Rule::REPAIRED, NodeId(1)), wfr_term, wfr_inputs, within, &mut wfrs);
    let mut text = "From Tautline Require Import Mrc.\n\n".to_owned();
    text += &table("robot", "robot", "robot_input", &robots);
    text + &table("wfr", "wfr", "wfr_input", &wfrs)
}
