//! A robot on its way through a tree: every state that signals of three nodes lead it to, with any strengths; and runs
//! with all that is heard. A node that guides: every conduct, and its answers.

use tautline_kernel::net::{NodeId, RobotId, Strength};
use tautline_kernel::tan::{Guide, Heading, Homing, Nav, Nearness, Order, ReqNav, Stage};

use super::mrc::{Answers, explore, table};
use super::term::{definition, list};
use crate::draw::Draw;

const GOAL: NodeId = NodeId(0);
const NEARNESS: Nearness = Nearness { near: Strength(100), closer: 10, times: 1 };
const TRIES: u8 = 2;

/// The strengths that may be heard: nothing, a little, a little more, and as at the node.
const HEARD: [Option<i32>; 4] = [None, Some(49), Some(50), Some(1_000)];

/// A robot, and the node where it was last, with its hops.
type State = (Homing, Option<(NodeId, u16)>);

/// Signals of the nodes of its tree, and one of another tree.
fn navs() -> Vec<Nav> {
    let nav =
        |wfr, node, hops, parent| Nav { wfr: NodeId(wfr), node: NodeId(node), hops, parent: NodeId(parent) };
    let mut all = vec![nav(0, 0, 0, 0), nav(9, 1, 1, 0)];
    for (node, hops) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
        all.extend([0, 3 - node].map(|parent| nav(0, node, hops, parent)));
    }
    all
}

fn nav(Nav { wfr, node, hops, parent }: Nav) -> String {
    format!("(Build_nav {} {} {hops} {})", wfr.0, node.0, parent.0)
}

fn term((robot, last): &State) -> String {
    let last = last.map_or("None".to_owned(), |(node, hops)| format!("(Some ({}, {hops}))", node.0));
    let stage = match robot.stage() {
        Stage::Asking { node } => format!("(Asks {})", node.0),
        Stage::Scanning { nav: of, .. } => format!("(Scans {})", nav(of)),
        Stage::Walking { nav: of, .. } => format!("(Walks {})", nav(of)),
        Stage::Arrived => "Arrived".to_owned(),
        Stage::Lost => "Lost".to_owned(),
    };
    format!("Build_homing {} {last} {stage}", robot.hops())
}

/// The state after `robot`, who may have come to the node that it followed.
fn after((robot, last): State, next: Homing) -> State {
    let of = match robot.stage() {
        Stage::Scanning { nav, .. } | Stage::Walking { nav, .. } => Some(nav),
        Stage::Asking { .. } | Stage::Arrived | Stage::Lost => None,
    };
    let has_come = of.filter(|of| next.hops() == of.hops && next.hops() < robot.hops());
    (next, has_come.map_or(last, |of| Some((of.node, of.hops))))
}

fn answers(state: &State) -> Vec<(String, State, String)> {
    let (robot, _) = *state;
    let mut all = Vec::new();
    let mut add =
        |input: &str, next: Homing| all.push((input.to_owned(), after(*state, next), "[]".to_owned()));
    for of in navs() {
        add(&format!("Hears {}", nav(of)), robot.hear(of));
    }
    for heard in HEARD.map(|heard| heard.map(Strength)) {
        let once = robot.measure(heard);
        // A scan is whole when all directions are measured.
        let whole = Heading::all().fold(robot, |robot, _| match robot.stage() {
            Stage::Scanning { .. } => robot.measure(heard),
            Stage::Asking { .. } | Stage::Walking { .. } | Stage::Arrived | Stage::Lost => robot,
        });
        let is_scanning = matches!(robot.stage(), Stage::Scanning { .. });
        add("Measures", if is_scanning { whole } else { once });
    }
    add("Bumps", robot.bump());
    add("Waited", robot.expire());
    all
}

/// The conducts of a node, each with a request to it or to another, a signal or the end of T_x, and the conduct after
/// it. Requests come with any place in the tree, and with none.
fn guides() -> Vec<String> {
    const NODE: NodeId = NodeId(1);
    let conduct = |guide: Guide| match guide {
        Guide::Idle => "Idle".to_owned(),
        Guide::Signals(of) => format!("(Signals {})", nav(of)),
        Guide::Silent => "KeepsSilent".to_owned(),
    };
    let signals = navs().into_iter().map(Guide::Signals);
    let mut rows = Vec::new();
    for guide in [Guide::Idle, Guide::Silent].into_iter().chain(signals) {
        let mut add =
            |input: &str, after| rows.push(format!("({},{input},{})", conduct(guide), conduct(after)));
        for (wfr, node) in [0, 9].into_iter().flat_map(|wfr| [1, 2].map(|node| (wfr, node))) {
            let request = ReqNav { wfr: NodeId(wfr), robot: RobotId(1), node: NodeId(node) };
            for own in navs().into_iter().map(Some).chain([None]) {
                let place = own.map_or("None".to_owned(), |own| format!("(Some {})", nav(own)));
                add(&format!("Requested {wfr} {node} {place}"), guide.request(request, NODE, own));
            }
        }
        add("Overhears", guide.overhear());
        add("Passes", guide.expire());
    }
    rows
}

/// The steps of a robot that walks, at most.
const STEPS: usize = 60;

/// Runs of robots that ask and go nearer so many times at most: of each step what
/// happens, what the robot does then, and its hops.
pub(super) fn walks() -> String {
    let mut draw = Draw(2011);
    let numbers = (0..36).map(|number| (1 + number % 3, number / 3 % 3));
    let runs: Vec<String> = numbers.map(|(tries, times)| walk(tries, times, &mut draw)).collect();
    let count = |order: &str| runs.iter().map(|run| run.matches(order).count()).sum::<usize>();
    let met = [",Ask ", ",Point ", ",Walk ", ",There,", ",Off,"].map(count);
    assert!(met.iter().all(|&times| times > 3), "{met:?}");
    let kind = "list (nat * nat * list (list input * order * nat))";
    "From Tautline Require Import Homing Patience.\n\n".to_owned()
        + &definition("turns", "nat", &Heading::COUNT.to_string())
        + &definition("near", "Z", &NEARNESS.near.0.to_string())
        + &definition("closer", "Z", &NEARNESS.closer.to_string())
        + &definition("walks", kind, &list(runs))
}

fn walk(tries: u8, times: u8, draw: &mut Draw) -> String {
    let mut robot = Homing::new(GOAL, RobotId(1), NodeId(2), 3, Nearness { times, ..NEARNESS }, tries);
    let mut steps = Vec::new();
    while robot.order() != Order::Stop && steps.len() < STEPS {
        let (inputs, next) = happens(robot, draw);
        robot = next;
        let order = match (robot.order(), robot.stage()) {
            (Order::Ask(request), _) => format!("Ask {}", request.node.0),
            (Order::Point(heading), _) => format!("Point {}", heading.degrees() / 15),
            (Order::Walk(heading), _) => format!("Walk {}", heading.degrees() / 15),
            (Order::Stop, Stage::Arrived) => "There".to_owned(),
            (Order::Stop, _) => "Off".to_owned(),
        };
        steps.push(format!("\n  ({inputs},{order},{}%nat)", robot.hops()));
    }
    format!("\n ({tries}%nat,{times}%nat,{})", list(steps))
}

/// The next event of a robot, and the robot after it: a signal or none, a part of a scan, or a step of a walk.
fn happens(robot: Homing, draw: &mut Draw) -> (String, Homing) {
    // How strong the node is to be heard at most, in this scan or step.
    let most = 96 + draw.below(20) as i32;
    let measured = |robot: Homing, heard: &[Option<i32>]| {
        let words =
            heard.iter().map(|heard| heard.map_or("None".to_owned(), |heard| format!("Some {heard}")));
        let next = heard.iter().fold(robot, |robot, &heard| robot.measure(heard.map(Strength)));
        (format!("map Measures {}%Z", list(words)), next)
    };
    match robot.order() {
        Order::Ask(request) => match draw.below(4) {
            0 => ("[Waited]".to_owned(), robot.expire()),
            1 => {
                let stray = navs()[draw.below(navs().len() as u64) as usize];
                (format!("[Hears {}]", nav(stray)), robot.hear(stray))
            }
            _ => {
                let hops = robot.hops() - 1;
                let parent = if hops > 1 { NodeId(1 + draw.below(3) as u32) } else { GOAL };
                let due = Nav { wfr: GOAL, node: request.node, hops, parent };
                (format!("[Hears {}]", nav(due)), robot.hear(due))
            }
        },
        Order::Point(heading) => {
            let left = u64::from(Heading::COUNT) - u64::from(heading.degrees() / 15);
            let now = if draw.below(2) == 0 { left } else { 1 + draw.below(left) };
            let is_heard = draw.below(5) > 0;
            let mut heard = || (is_heard && draw.below(3) > 0).then(|| most - draw.below(6) as i32);
            measured(robot, &(0..now).map(|_| heard()).collect::<Vec<_>>())
        }
        Order::Walk(_) => match draw.below(6) {
            0 => ("[Bumps]".to_owned(), robot.bump()),
            1 => measured(robot, &[None]),
            _ => measured(robot, &[Some(most)]),
        },
        Order::Stop => unreachable!("it goes on"),
    }
}

pub(super) fn terms() -> String {
    let mut found = Answers::new();
    for hops in [1, 2, 3] {
        let first = Homing::new(GOAL, RobotId(1), NodeId(1), hops, NEARNESS, TRIES);
        explore((first, None), term, answers, |_| true, &mut found);
    }
    let guides = definition("guides", "list (conduct * guide_input * conduct)", &list(guides()));
    "From Tautline Require Import Mrc Homing.\n\n".to_owned()
        + &table("homing", "homing", "input", &found)
        + &guides
}
