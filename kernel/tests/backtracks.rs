//! A log is not trusted: of a backtrack every message is asked whether it can be true, and the first that cannot is
//! named.

use tautline_kernel::chain::{Chain, Damage, Intent, Kind, Message, Outcome, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, SmallGrid, Step};

use crate::numbers::Congruence;

const BASE: Cell = Cell::new(3, 3);

type Team = Chain<SmallGrid, 5>;

/// The error, if there is one, in taking back a team move of which the robots but the base have sent `messages`;
/// `is_last` if no other is to be taken back then.
fn objection(chain: &Team, messages: &[u8], is_last: bool) -> Option<Damage> {
    let mut cells = chain.cells().to_vec();
    for (place, &byte) in (1..).zip(messages) {
        let robot = place + 1;
        let Message { step, outcome } = match Message::decode(byte) {
            Ok(message) => message,
            Err(damaged) => return Some(damaged),
        };
        let (tried, mark) = match outcome {
            Outcome::TookBack => return Some(Damage::TakenBack(robot)),
            Outcome::Blocked => (step, EdgeMark::Wall),
            Outcome::Arrived => (step.reverse(), EdgeMark::Open),
        };
        if let Step::Cross(side) = tried
            && !chain.grid().edge_has(mark, Edge::new(cells[place], side))
        {
            return Some(Damage::OtherWorld(robot));
        }
        if outcome == Outcome::Arrived {
            cells[place] = cells[place].after(tried);
        }
        if !chain.rule().keeps_contact(cells[place - 1], cells[place]) {
            return Some(Damage::OutOfContact(robot));
        }
    }
    let outside = || cells.iter().filter(|&&cell| cell != BASE);
    let is_crowded = outside().any(|cell| outside().filter(|&other| other == cell).count() > 2);
    if chain.rule().keeps_apart() && is_crowded {
        return Some(Damage::Crowded);
    }
    let away = cells.iter().position(|&cell| cell != BASE);
    away.filter(|_| is_last).map(|place| Damage::NotHome(place + 1))
}

#[test]
fn of_a_log_that_cannot_be_true_the_first_message_is_named_that_tells() {
    let area = Area::new(Cell::new(0, 0), Cell::new(6, 6)).expect("cells");
    let (mut drawn, mut told) = (Congruence(6), [0; 5]);
    for round in 0..12 {
        let robots = 3 + round % 3;
        let rule = if round % 2 == 0 { Rule::PUBLISHED } else { Rule::REPAIRED };
        let area = area.around(BASE, robots as u16 - 1).expect("inside");
        let mut chain =
            Team::new(rule, robots, BASE, SmallGrid::new(area).expect("it fits")).expect("a chain");
        let is_wall: [bool; 98] = core::array::from_fn(|_| drawn.pick(4) == 0);
        let is_open = |edge: Edge| {
            !is_wall[(14 * edge.cell().y + 2 * edge.cell().x + i16::from(edge.side() == Side::East)) as usize]
        };
        let (mut log, movers) = (Vec::new(), robots - 1);
        for _ in 0..150 {
            let before = chain;
            let Intent::Go(plan) = chain.plan(&log).expect("its own log") else { break };
            let settled = chain.settle(&plan, is_open);
            if plan.kind == Kind::Backtrack {
                let first = before.last_open().expect("there is one") as usize * movers;
                let is_last = chain.last_open().is_none();
                for (robot, byte) in (0..movers).flat_map(|robot| (0..=20).map(move |byte| (robot, byte))) {
                    let mut changed = log.clone();
                    changed[first + robot] = byte;
                    let expected = objection(&before, &changed[first..first + movers], is_last);
                    let result = before.clone().plan(&changed);
                    assert_eq!(result.err(), expected, "{:?} {changed:?}", before.cells());
                    match expected {
                        Some(Damage::OutOfContact(_)) => told[0] += 1,
                        Some(Damage::Crowded) => told[1] += 1,
                        Some(Damage::NotHome(_)) => told[2] += 1,
                        Some(_) => told[3] += 1,
                        None => told[4] += 1,
                    }
                }
            }
            log.extend_from_slice(settled.messages());
        }
    }
    assert!(told.iter().all(|&times| times > 3), "{told:?}");
}
