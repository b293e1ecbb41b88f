//! A chain that has lost a robot: what it tells while the two parts take their moves back, and once they are in
//! contact.

use tautline_kernel::chain::{Chain, Damage, Intent, ReformError, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, Side, SmallGrid};

use crate::numbers::Congruence;

const BASE: Cell = Cell::new(4, 4);

type Team = Chain<SmallGrid, 5>;

/// Whether neighbours are in contact, and at most two robots in one cell beside the base.
fn is_formed(rule: &Rule, cells: &[Cell]) -> bool {
    let crowd = |cell: &Cell| cells.iter().filter(|&other| other == cell).count();
    cells.windows(2).all(|pair| rule.keeps_contact(pair[0], pair[1]))
        && cells.iter().all(|cell| *cell == BASE || crowd(cell) <= 2)
}

/// Re-forms `chain` without `robot`, numbered from 1, the base; whether it did so away from home.
fn reforms(chain: &Team, robot: usize, log: &[u8]) -> bool {
    let movers = chain.cells().len() - 1;
    let mut left: Vec<Cell> = chain.cells().to_vec();
    left.remove(robot - 1);
    let mut parts = chain.reform(robot, log).expect("its own log");
    assert_eq!((parts.cells(), parts.behind()), (&left[..], robot - 1));
    if let Some(entry) = chain.last_open().filter(|_| robot <= movers) {
        let sent = (entry as usize + 1) * movers;
        let short = parts.clone().take_back(&log[..sent - movers]);
        assert_eq!(short, Err(Damage::Length { bytes: sent - movers, sent }));
    }
    let mut was_away = false;
    loop {
        let formed = is_formed(chain.rule(), parts.cells());
        assert_eq!(parts.is_formed(), formed, "{:?}", parts.cells());
        let then = parts.formed();
        assert_eq!(then.is_ok(), formed);
        let before = parts.cells().to_vec();
        let mut next = parts;
        let took = next.take_back(log).expect("its own log");
        if let Ok((team, parts)) = then {
            assert_eq!((team.cells(), team.last_open(), team.gained()), (&before[..], None, true));
            assert_eq!((team.until_gain(), team.measure()), (None, [u32::from(u8::MAX), 0, 0]));
            assert_eq!(team.is_home(), before.iter().all(|&cell| cell == BASE));
            // It can come home as long as there is something from before to take back.
            assert_eq!((team.can_come_home(), team.come_home(parts).is_some()), (took, took));
            let again = team.reform(2, &[]).err();
            assert_eq!(again == Some(ReformError::NoWayHome), took && before.len() > 2, "{again:?}");
            was_away |= took;
            // Once it has moved, it takes that back first.
            let mut team = team;
            if let Ok(Intent::Go(plan)) = team.plan(&[]) {
                team.settle(&plan, |_| true);
                assert!(!team.can_come_home());
            }
        } else {
            assert_eq!(then.err(), Some(ReformError::Apart));
        }
        if !took {
            assert!(before.iter().all(|&cell| cell == BASE), "{before:?}");
            return was_away;
        }
        parts = next;
    }
}

#[test]
fn the_parts_of_a_chain_come_together_or_home() {
    let area = Area::new(Cell::new(0, 0), Cell::new(8, 8)).expect("cells");
    let (mut drawn, mut away) = (Congruence(5), 0);
    for round in 0..30 {
        let robots = 3 + round % 3;
        let grid = SmallGrid::new(area.around(BASE, robots as u16 - 1).expect("inside")).expect("it fits");
        let mut chain = Team::new(Rule::REEL, robots, BASE, grid).expect("a chain");
        let is_wall: [bool; 162] = core::array::from_fn(|_| drawn.pick(6) == 0);
        let is_open = |edge: Edge| {
            !is_wall[(18 * edge.cell().y + 2 * edge.cell().x + i16::from(edge.side() == Side::East)) as usize]
        };
        let mut log = Vec::new();
        for _ in 0..60 {
            let Intent::Go(plan) = chain.plan(&log).expect("its own log") else { break };
            log.extend_from_slice(chain.settle(&plan, is_open).messages());
            assert_eq!(chain.is_home(), chain.cells().iter().all(|&cell| cell == BASE));
            // Now and then: each of them takes all moves back.
            for robot in (2..=robots).filter(|_| drawn.pick(10) == 0) {
                away += u32::from(reforms(&chain, robot, &log));
            }
            for robot in [0, 1, robots + 1] {
                assert_eq!(chain.reform(robot, &log).err(), Some(ReformError::NoRobot { robot, robots }));
            }
        }
    }
    assert!(away > 40, "{away}");
}

#[test]
fn a_base_and_one_robot_are_too_few_to_lose_one() {
    let grid =
        || SmallGrid::new(Area::new(Cell::new(3, 3), Cell::new(5, 5)).expect("cells")).expect("it fits");
    let [two, three] = [2, 3].map(|robots| Team::new(Rule::REEL, robots, BASE, grid()).expect("a chain"));
    assert_eq!(two.reform(2, &[]).err(), Some(ReformError::TooFew));
    assert!(three.reform(2, &[]).is_ok());
}
