//! The answers of a robot and a WFR in every state that they can come to, as they are: with hop counts, parents and
//! what is still repeated; and those of a path node. A robot hears of a call of one WFR and two of another, and has
//! room for one record or two; one that repeats twice hears of three WFRs, and has room for two; a WFR hears two
//! robots, and has room for one or two; a path node has room for one way or
//! four.

use std::collections::HashMap;
use std::hash::Hash;

use tautline_kernel::mrc::{
    Bid, Downward, Hop, Mail, Phase, Relay, Resb, Robot, Rule, ServiceBit, Task, Upward, Wfr, Word,
};
use tautline_kernel::net::{Call, NodeId, Notice};

use super::mrc::{LAST, ME, OTHER, call, of, robot_id};
use super::term::{definition, list, option};

/// More repeats than the rule's own.
const PATIENT: u8 = 2;

/// A message heard, the state in which it leaves a machine, and what the machine sends.
type Answer<S> = (String, S, String);

/// The calls that a robot hears of, and those that a WFR hears MOVEs for.
const HEARD: [Call; 3] = [call(1, 1), call(2, 1), call(2, 2)];
/// WFRs of which a robot has not room for all.
const TOO_MANY: [Call; 3] = [call(1, 1), call(2, 1), call(3, 1)];
const ANSWERED: [Call; 3] = [call(1, 1), call(1, 2), call(2, 1)];

fn word(word: Word) -> String {
    match word {
        Word::Move { hops } => format!("(Move {hops})"),
        Word::Accept => "Accept".to_owned(),
        Word::Decline => "Decline".to_owned(),
    }
}

fn upward(message: Upward) -> String {
    format!("(Build_upward {} {} {})", of(message.call), word(message.word), message.parent.0)
}

/// The definitions of the states that can be reached, in the order found, and of what comes of each input: the numbers
/// of the input, of the state, and of what is sent. Where a state stays and is silent nothing stands.
fn table<S: Copy + Eq + Hash>(
    (name, kind, silence): (&str, &str, &str),
    first: S,
    term: impl Fn(&S) -> String,
    next: impl Fn(&S) -> Vec<Answer<S>>,
    is_within: impl Fn(&S) -> bool,
) -> String {
    fn place(terms: &mut Vec<String>, term: String) -> usize {
        terms.iter().position(|known| *known == term).unwrap_or_else(|| {
            terms.push(term);
            terms.len() - 1
        })
    }
    let (mut states, mut numbers) = (vec![first], HashMap::from([(first, 0)]));
    let (mut inputs, mut says, mut rows) = (Vec::new(), vec![silence.to_owned()], Vec::new());
    let mut at = 0;
    while let Some(&state) = states.get(at) {
        let mut row = Vec::new();
        for (input, after, sent) in if is_within(&state) { next(&state) } else { Vec::new() } {
            let (input, said) = (place(&mut inputs, input), place(&mut says, sent));
            let number = *numbers.entry(after).or_insert_with(|| {
                states.push(after);
                states.len() - 1
            });
            if (number, said) != (at, 0) {
                row.push((input, format!("({input},{number},{said})")));
            }
        }
        row.sort_unstable();
        if is_within(&state) {
            rows.push(format!("\n  Some {}", list(row.into_iter().map(|(_, entry)| entry))));
        } else {
            rows.push("\n  None".to_owned());
        }
        at += 1;
    }
    let states = states.iter().map(|state| format!("\n  {}", term(state)));
    let says_kind = if silence == "None" { "option upward" } else { "list mail" };
    let lists = [
        ("states", format!("list {kind}"), list(states)),
        ("inputs", format!("list {kind}_input"), list(inputs)),
        ("says", format!("list ({says_kind})"), list(says)),
        ("answers", "list (option (list (N * N * N)))".to_owned(), format!("{}%N", list(rows))),
    ];
    lists.map(|(part, kind, list)| definition(&format!("{name}_{part}"), &kind, &list)).concat()
}

fn robot_term<const ROOM: usize>(robot: &Robot<ROOM>) -> String {
    let requests = robot.requests().map(|request| {
        let served = request.served == ServiceBit::Yes;
        format!("Build_request {} {served} {} {}", of(request.call), request.hops, request.parent.0)
    });
    let task = match robot.task() {
        Task::Free => "Free".to_owned(),
        Task::Asking { call, repeats_left } => format!("(Asking {} {repeats_left})", of(call)),
        Task::Leased { call } => format!("(Leased {})", of(call)),
    };
    format!("Build_robot [{}] {task}", requests.collect::<Vec<_>>().join("; "))
}

fn robot_answers<const ROOM: usize>(
    robot: &Robot<ROOM>,
    (calls, ways): (&[Call], &[(u16, u32)]),
) -> Vec<Answer<Robot<ROOM>>> {
    let mut all = Vec::new();
    let mut add = |input: String, (after, sent): (Robot<ROOM>, Option<Upward>)| {
        all.push((input, after, option(sent.map(upward))));
    };
    for &call in calls {
        for &(hops, sender) in ways {
            let notice = Notice { call, hops, sender: NodeId(sender) };
            add(format!("Notice {} {hops} {sender}", of(call)), robot.receive(Downward::Notice(notice)));
        }
        for (to, chosen) in [(ME, None), (ME, Some(ME)), (ME, Some(OTHER)), (OTHER, Some(ME))] {
            let resb = Resb { call, robot: to, chosen };
            add(
                format!("Tells {} {} {}", of(call), to.0, robot_id(chosen)),
                robot.receive(Downward::Resb(resb)),
            );
        }
        add(format!("Lapses {}", of(call)), robot.lapse(call));
    }
    add("Waited".to_owned(), robot.timer().map_or((*robot, None), |timer| robot.expire(timer)));
    add("Arrives".to_owned(), robot.arrive());
    all
}

fn robot_table<const ROOM: usize>(name: &str, rule: Rule) -> String {
    let first = Robot::<ROOM>::new(rule, ME);
    let heard: (&[Call], &[(u16, u32)]) = match rule.repeats {
        PATIENT => (&TOO_MANY, &[(1, 5)]),
        _ => (&HEARD, &[(1, 5), (1, 6), (0, 6)]),
    };
    table((name, "robot", "None"), first, robot_term, |robot| robot_answers(robot, heard), |_| true)
}

fn wfr_term<const ROOM: usize>(wfr: &Wfr<ROOM>) -> String {
    let bid = |choice: Bid| format!("(Build_bid {} {})", choice.hops, choice.robot.0);
    let phase = match wfr.phase() {
        Phase::Idle => "Idle".to_owned(),
        Phase::Collecting { best } => format!("(Collecting {})", option(best.map(bid))),
        Phase::Offered { choice, repeats_left } => format!("(Offered {} {repeats_left})", bid(choice)),
        Phase::Leased { choice } => format!("(CountsOn {})", bid(choice)),
        Phase::Rescued { .. } => "Rescued".to_owned(),
    };
    let asked: Vec<String> = wfr.asked().map(|robot| robot.0.to_string()).collect();
    format!("Build_wfr {} {phase} [{}]", wfr.call().epoch.0, asked.join("; "))
}

fn wfr_answers<const ROOM: usize>(wfr: &Wfr<ROOM>) -> Vec<Answer<Wfr<ROOM>>> {
    let mut all = Vec::new();
    let mut add = |input: String, (after, sent): (Wfr<ROOM>, Mail<ROOM>)| {
        let resb = |resb: Resb| {
            assert_eq!(resb.call.wfr, wfr.call().wfr);
            format!("Resb {} {} {}", resb.call.epoch.0, resb.robot.0, robot_id(resb.chosen))
        };
        let sent = match sent {
            Mail::Nothing => String::new(),
            Mail::Notice(notice) => {
                assert_eq!(
                    (notice.call.wfr, notice.hops, notice.sender),
                    (wfr.call().wfr, 0, wfr.call().wfr)
                );
                format!("Calls {}", notice.call.epoch.0)
            }
            Mail::One(message) => resb(message),
            Mail::All(messages) => messages.into_iter().flatten().map(resb).collect::<Vec<_>>().join("; "),
        };
        all.push((input, after, format!("[{sent}]")));
    };
    add("Raised".to_owned(), wfr.raise());
    for call in ANSWERED {
        for robot in [ME, OTHER] {
            for said in [Word::Move { hops: 1 }, Word::Move { hops: 2 }, Word::Accept, Word::Decline] {
                let message = Upward { call, robot, word: said, parent: call.wfr };
                add(format!("Says {} {} {}", of(call), robot.0, word(said)), wfr.receive(message));
            }
        }
    }
    add("Expires".to_owned(), wfr.timer().map_or((*wfr, Mail::Nothing), |timer| wfr.expire(timer)));
    add("Reached".to_owned(), (wfr.reach(ME), Mail::Nothing));
    all
}

fn wfr_table<const ROOM: usize>(name: &str, rule: Rule) -> String {
    let first = Wfr::<ROOM>::new(rule, NodeId(1));
    table((name, "wfr", "[]"), first, wfr_term, wfr_answers, |wfr| wfr.call().epoch <= LAST)
}

/// The messages that come by node 7, whose own parent is 3; the last is another's to send on.
fn passings() -> Vec<(Upward, Hop)> {
    let message =
        |call, robot, parent| Upward { call, robot, word: Word::Move { hops: 2 }, parent: NodeId(parent) };
    let of = |robot| {
        let ways = [Hop::Robot(robot), Hop::Node(NodeId(5))];
        ANSWERED.into_iter().flat_map(move |call| ways.map(|from| (message(call, robot, 7), from)))
    };
    let mut all: Vec<_> = [ME, OTHER].into_iter().flat_map(of).collect();
    all.push((message(call(1, 1), ME, 8), Hop::Robot(ME)));
    all
}

/// After each three messages who gets each RESB, a digit each, the first the lowest: nobody, the robot, the node.
fn ways<const ROOM: usize>(passings: &[(Upward, Hop)]) -> Vec<String> {
    let up = |relay: Relay<ROOM>, &(message, from): &(Upward, Hop)| {
        let (relay, onward) = relay.up(message, from, NodeId(3));
        let due = (message.parent == NodeId(7)).then_some(Upward { parent: NodeId(3), ..message });
        assert_eq!(onward, due);
        relay
    };
    let asked =
        [ME, OTHER].into_iter().flat_map(|robot| ANSWERED.map(|call| Resb { call, robot, chosen: None }));
    let code = |relay: &Relay<ROOM>| {
        asked.clone().rev().fold(0, |sum, resb| {
            3 * sum
                + match relay.down(resb) {
                    None => 0,
                    Some(Hop::Robot(_)) => 1,
                    Some(Hop::Node(_)) => 2,
                }
        })
    };
    let mut codes = Vec::new();
    for one in passings {
        let first = up(Relay::new(NodeId(7)), one);
        for other in passings {
            let second = up(first, other);
            codes.extend(passings.iter().map(|last| code(&up(second, last)).to_string()));
        }
    }
    codes
}

pub(super) fn terms() -> String {
    let mut text = "From Tautline Require Import Machines.\n\n".to_owned();
    text += &robot_table::<1>("robot_1", Rule::REPAIRED);
    text += &robot_table::<2>("robot_2", Rule::REPAIRED);
    text += &robot_table::<2>("published", Rule::PUBLISHED);
    text += &wfr_table::<1>("wfr_1", Rule::REPAIRED);
    text += &wfr_table::<2>("wfr_2", Rule::REPAIRED);
    let patient = Rule { repeats: PATIENT, ..Rule::REPAIRED };
    text += &robot_table::<2>("robot_full", patient);
    text += &wfr_table::<1>("wfr_patient", patient);
    let passings = passings();
    let passing = |&(message, from): &(Upward, Hop)| {
        let from = match from {
            Hop::Robot(robot) => format!("(Robot {})", robot.0),
            Hop::Node(node) => format!("(Node {})", node.0),
        };
        format!("Build_passing {} {} {from} 3", upward(message), message.robot.0)
    };
    text += &definition("passings", "list passing", &list(passings.iter().map(passing)));
    for (name, codes) in [("ways_1", ways::<1>(&passings)), ("ways_4", ways::<4>(&passings))] {
        text += &definition(name, "list N", &format!("{}%N", list(codes)));
    }
    text
}
