//! Who plans along with a chain and hears its messages knows what the team knows, in a world where walls stand and in
//! one where they appear; and no message is believed that cannot be true.

use std::collections::BTreeSet;

use tautline_kernel::chain::{Chain, Damage, Intent, Kind, Message, Outcome, Plan, Pursuit, Rule, Walls};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, SmallGrid, Step};

use crate::numbers::Congruence;

const ROBOTS: usize = 5;
const BASE: Cell = Cell::new(3, 3);

type Team = Chain<SmallGrid, ROBOTS>;

/// The side that a robot tries to cross in a team move.
fn crossed(chain: &Team, plan: &Plan<ROBOTS>, robot: usize) -> Option<Edge> {
    match plan.steps()[robot] {
        Step::Cross(side) => Some(Edge::new(chain.cells()[robot], side)),
        Step::Stay => None,
    }
}

/// The first of the messages that cannot be true, if one cannot; that of `mute` is not read.
fn objection(
    chain: &Team,
    walls: Walls,
    plan: &Plan<ROBOTS>,
    messages: &[u8],
    mute: Option<usize>,
) -> Option<Damage> {
    let mut met: Vec<(Edge, bool)> = Vec::new();
    for (robot, &byte) in (1..).zip(messages).filter(|&(robot, _)| mute != Some(robot)) {
        let message = match Message::decode(byte) {
            Ok(message) => message,
            Err(damaged) => return Some(damaged),
        };
        let can_be = match (plan.kind, walls) {
            (Kind::Advance, _) => message.outcome != Outcome::TookBack,
            (Kind::Backtrack, Walls::Lasting) => message.outcome == Outcome::TookBack,
            (Kind::Backtrack, Walls::Changing) => message.outcome != Outcome::Arrived,
        };
        if message.step != plan.steps()[robot] || !can_be {
            return Some(Damage::OtherStep(robot + 1));
        }
        let Some(edge) = crossed(chain, plan, robot) else { continue };
        if plan.kind == Kind::Backtrack && walls == Walls::Lasting {
            continue;
        }
        let is_blocked = message.outcome == Outcome::Blocked;
        let is_wall = chain.grid().edge_has(EdgeMark::Wall, edge);
        let is_open = walls == Walls::Lasting && chain.grid().edge_has(EdgeMark::Open, edge);
        let by_another = met.iter().find(|&&(other, _)| other == edge).map(|&(_, blocked)| blocked);
        let known = if is_wall {
            Some(true)
        } else if is_open {
            Some(false)
        } else {
            by_another
        };
        if known.is_some_and(|known| known != is_blocked) {
            return Some(Damage::OtherWorld(robot + 1));
        }
        met.push((edge, is_blocked));
    }
    None
}

/// `hears` is what a chain makes of messages that tell what `walls` are met, and of no others.
fn hears(chain: &Team, walls: Walls, plan: &Plan<ROBOTS>, messages: &[u8], mute: Option<usize>) -> bool {
    let mut heard = *chain;
    let planned = mute.map_or(*plan, |mute| plan.without(mute + 1));
    let result = heard.hear(&planned, messages);
    if let Some(damaged) = objection(chain, walls, plan, messages, mute) {
        assert_eq!(result, Err(damaged), "{plan:?} {messages:?}");
        assert!(heard == *chain, "it has changed");
        return false;
    }
    assert_eq!(result, Ok(()), "{plan:?} {messages:?}");
    let is_open = |edge| {
        let robot = (1..chain.cells().len())
            .find(|&robot| mute != Some(robot) && crossed(chain, plan, robot) == Some(edge));
        let message = Message::decode(messages[robot.expect("somebody has tried it") - 1]);
        message.expect("a message").outcome != Outcome::Blocked
    };
    let mut settled = *chain;
    settled.settle(&planned, is_open);
    assert!(heard == settled, "{plan:?} {messages:?}");
    true
}

#[test]
fn what_is_heard_of_a_team_move_is_what_came_of_it() {
    let area = Area::new(Cell::new(0, 0), Cell::new(6, 6)).expect("cells");
    let epochs = Rule { pursuit: Pursuit::Epochs, ..Rule::REEL };
    let (mut drawn, mut refused, mut walls_back) = (Congruence(3), 0, 0);
    for round in 0..24 {
        let among = if round % 3 == 0 { Walls::Lasting } else { Walls::Changing };
        let rule = if round % 2 == 0 { Rule::REEL } else { epochs };
        let robots = 3 + round % 3;
        let grid = SmallGrid::new(area.around(BASE, robots as u16 - 1).expect("inside")).expect("it fits");
        let mut chain = Team::new(rule, robots, BASE, grid).expect("a chain").among(among);
        let mut walls: BTreeSet<(Cell, usize)> = BTreeSet::new();
        let named = |edge: Edge| (edge.cell(), Step::Cross(edge.side()).place());
        for edge in area.edges() {
            if drawn.pick(7) == 0 {
                walls.insert(named(edge));
            }
        }
        let mut log = Vec::new();
        for _ in 0..120 {
            let Intent::Go(plan) = chain.plan(&log).expect("its own log") else { break };
            for robot in 1..robots {
                let edge = crossed(&chain, &plan, robot);
                let is_known_wall = edge.is_some_and(|edge| chain.grid().edge_has(EdgeMark::Wall, edge));
                assert!(!is_known_wall, "{plan:?} goes through a known wall");
                if among == Walls::Changing && drawn.pick(12) == 0 {
                    walls.extend(edge.map(named));
                }
            }
            let before = chain;
            let messages = chain.settle(&plan, |edge| !walls.contains(&named(edge))).messages().to_vec();
            assert!(hears(&before, among, &plan, &messages, None), "what is true is believed");
            let mut after = before;
            after.hear(&plan, &messages).expect("true messages");
            assert!(after == chain);
            for robot in 1..robots {
                let mut changed = messages.clone();
                for byte in (0..=20).chain([u8::MAX]) {
                    changed[robot - 1] = byte;
                    refused += u32::from(!hears(&before, among, &plan, &changed, None));
                }
                // Of a robot that has died nothing is read.
                assert!(hears(&before, among, &plan, &changed, Some(robot)));
            }
            let few = before.clone().hear(&plan, &messages[1..]);
            assert_eq!(few, Err(Damage::Length { bytes: robots - 2, sent: robots - 1 }));
            let is_blocked = |byte: &u8| Message::decode(*byte).expect("its own").outcome == Outcome::Blocked;
            if plan.kind == Kind::Backtrack && messages.iter().any(is_blocked) {
                walls_back += 1;
                assert_eq!(chain.last_open(), None, "the history ends where a wall has shut it");
            }
            log.extend(messages);
        }
    }
    assert!(refused > 1000 && walls_back > 3, "{refused} {walls_back}");
}
