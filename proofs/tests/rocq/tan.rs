//! A robot on its way through a tree: every state that signals of three nodes lead it to, with any strengths. A node
//! that guides: every conduct, and its answers.

use tautline_kernel::net::{NodeId, RobotId, Strength};
use tautline_kernel::tan::{Conduct, Guide, Heading, Homing, Nav, Nearness, ReqNav, Stage};

use super::mrc::{Answers, explore, table};
use super::term::{definition, list};

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
    let conduct = |guide: Guide| match guide.conduct {
        Conduct::Idle => "Idle".to_owned(),
        Conduct::Signals(of) => format!("(Signals {})", nav(of)),
        Conduct::Silent => "KeepsSilent".to_owned(),
    };
    let signals = navs().into_iter().map(Conduct::Signals);
    let mut rows = Vec::new();
    for guide in [Conduct::Idle, Conduct::Silent].into_iter().chain(signals).map(|conduct| Guide { conduct })
    {
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
