//! A log whose bytes were changed. Each byte of each entry is replaced by each other message that a robot can send:
//! whatever the log says, a backtrack crosses only sides that are known to be open, and ends where neighbours in the
//! chain are in contact and, as repaired, no three robots are in one cell.

use tautline_kernel::chain::{Chain, Damage, Intent, Kind, Message, Plan, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Circle, Edge, EdgeMark, Grid, SmallGrid, Step};
use tautline_proofs::engine::SeededOracle;

type Team = Chain<SmallGrid, 8>;

/// A count of the plans that a changed log gave.
#[derive(Default, PartialEq, Eq, Debug)]
struct Count {
    other_world: u32,
    out_of_contact: u32,
    crowded: u32,
    otherwise_refused: u32,
    /// The plan is that of the true log.
    same: u32,
    /// It is another one, and safe.
    other: u32,
}

impl Count {
    fn add(&mut self, more: &Self) {
        let Self { other_world, out_of_contact, crowded, otherwise_refused, same, other } = more;
        self.other_world += other_world;
        self.out_of_contact += out_of_contact;
        self.crowded += crowded;
        self.otherwise_refused += otherwise_refused;
        self.same += same;
        self.other += other;
    }
}

/// The fault of a backtrack of `team`, by the sentences of SPEC.md.
fn wrong(team: &Team, plan: &Plan<8>) -> Option<&'static str> {
    let cells = team.cells();
    let crosses_unknown = cells.iter().zip(plan.steps()).any(|(&cell, &step)| match step {
        Step::Cross(side) => !team.grid().edge_has(EdgeMark::Open, Edge::new(cell, side)),
        Step::Stay => false,
    });
    let after: Vec<Cell> = cells.iter().zip(plan.steps()).map(|(cell, &step)| cell.after(step)).collect();
    let is_repaired = *team.rule() == Rule::REPAIRED;
    let is_near = |pair: &[Cell]| {
        if is_repaired {
            Circle::COVERED.covers(pair[0], pair[1])
        } else {
            Circle::COVERED.reaches(pair[0], pair[1])
        }
    };
    let is_crowded =
        |cell: &Cell| *cell != after[0] && after.iter().filter(|other| *other == cell).count() > 2;
    if crosses_unknown {
        Some("a robot crosses a side that nobody has crossed")
    } else if !after.windows(2).all(is_near) {
        Some("neighbours are out of contact")
    } else if is_repaired && after.iter().any(is_crowded) {
        Some("three robots are in one cell")
    } else {
        None
    }
}

/// Plans with each byte of the entries `of` of `log` replaced by each other message.
fn tamper(team: &Team, log: &[u8], of: std::ops::Range<usize>, truth: &Plan<8>) -> Count {
    let mut count = Count::default();
    for place in of {
        for byte in (0..=u8::MAX).filter(|&byte| byte != log[place] && Message::decode(byte).is_ok()) {
            let mut changed = log.to_vec();
            changed[place] = byte;
            match team.clone().plan(&changed) {
                Err(Damage::OtherWorld(_)) => count.other_world += 1,
                Err(Damage::OutOfContact(_)) => count.out_of_contact += 1,
                Err(Damage::Crowded) => count.crowded += 1,
                Err(_) => count.otherwise_refused += 1,
                Ok(Intent::Go(plan)) => {
                    assert_eq!(plan.kind, Kind::Backtrack);
                    assert_eq!(wrong(team, &plan), None, "byte {place} is {byte} in {log:?}: {plan:?}");
                    if plan.steps() == truth.steps() {
                        count.same += 1;
                    } else {
                        count.other += 1;
                    }
                }
                Ok(Intent::Done(end)) => panic!("{end:?} where a move is taken back"),
            }
        }
    }
    count
}

#[test]
fn whatever_the_log_says_a_backtrack_is_safe() {
    let mut of_the_entry = Count::default();
    let mut of_earlier_ones = Count::default();
    for seed in 0..30 {
        let mut world = SeededOracle::new(11, seed);
        let robots = 3 + world.pick(4) as usize;
        let rule = if world.flip() { Rule::PUBLISHED } else { Rule::REPAIRED };
        let walls_percent = 5 + world.pick(25);
        let range = robots as i16 - 1;
        let area = Area::new(Cell::new(0, 0), Cell::new(2 * range, 2 * range)).expect("it has cells");
        let grid = SmallGrid::new(area).expect("at most 11 columns");
        let mut team = Team::new(rule, robots, Cell::new(range, range), grid).expect("it fits");
        let mut log = Vec::new();
        for made in 0..150 {
            let before = team;
            let Intent::Go(plan) = team.plan(&log).expect("its own log is never refused") else { break };
            if let (Kind::Backtrack, Some(entry)) = (plan.kind, before.last_open()) {
                let first = entry as usize * (robots - 1);
                of_the_entry.add(&tamper(&before, &log, first..first + robots - 1, &plan));
                if made % 10 == 0 {
                    of_earlier_ones.add(&tamper(&before, &log, 0..first, &plan));
                }
            }
            let settled = team.settle(&plan, |_| world.pick(100) >= walls_percent);
            log.extend_from_slice(settled.messages());
        }
    }
    println!("the entry itself: {of_the_entry:?}; earlier ones: {of_earlier_ones:?}");
    let Count { other_world, out_of_contact, crowded, otherwise_refused, .. } = of_the_entry;
    assert!([other_world, out_of_contact, crowded, otherwise_refused].iter().all(|&refused| refused > 0));
    assert!(of_earlier_ones.same > 0);
}

#[test]
fn each_kind_of_damage_is_told() {
    // Two robots in a row of three cells, the base in the middle: a wall in the east, then a way to the west.
    let area = Area::new(Cell::new(0, 0), Cell::new(2, 0)).expect("three cells");
    let grid = SmallGrid::new(area).expect("it fits");
    let mut team = Team::new(Rule::REPAIRED, 2, Cell::new(1, 0), grid).expect("it fits");
    let mut log = Vec::new();
    let go_on = |team: &mut Team, log: &mut Vec<u8>| {
        let Ok(Intent::Go(plan)) = team.plan(log) else { panic!("the run goes on") };
        log.extend_from_slice(team.settle(&plan, |edge| edge.cell() == Cell::new(0, 0)).messages());
        plan.kind
    };
    assert_eq!([go_on(&mut team, &mut log), go_on(&mut team, &mut log)], [Kind::Advance; 2]);
    let plan = |team: &Team, log: &[u8]| team.clone().plan(log).map(|_| ());
    let (east, south, west, blocked_east) = (0, 1, 2, 8);
    assert_eq!(log, [blocked_east, west]);
    assert_eq!(plan(&team, &log), Ok(()));
    assert_eq!(plan(&team, &[blocked_east, east]), Err(Damage::OtherWorld(2)));
    assert_eq!(plan(&team, &[blocked_east, south]), Err(Damage::OtherWorld(2)));
    assert_eq!(plan(&team, &[blocked_east, 16 | west]), Err(Damage::TakenBack(2)));
    assert_eq!(plan(&team, &[blocked_east]), Err(Damage::Length { bytes: 1, sent: 2 }));
    assert_eq!(plan(&team, &[blocked_east, 255]), Err(Damage::Byte(255)));
    assert_eq!(go_on(&mut team, &mut log), Kind::Backtrack);
    assert_eq!(plan(&team, &log), Ok(()));
    assert_eq!(plan(&team, &[east, log[1], log[2]]), Err(Damage::NotHome(2)));
}

#[test]
fn a_listener_refuses_what_does_not_fit_and_is_as_it_was() {
    let area = Area::new(Cell::new(0, 0), Cell::new(4, 4)).expect("it has cells");
    let grid = SmallGrid::new(area).expect("it fits");
    let mut team = Team::new(Rule::REPAIRED, 3, Cell::new(2, 2), grid).expect("it fits");
    let Ok(Intent::Go(plan)) = team.plan(&[]) else { panic!("it has cells to explore") };
    let mut speaker = team;
    let messages = speaker.settle(&plan, |_| true).messages().to_vec();
    let mut listener = team;
    assert_eq!(listener.hear(&plan, &messages), Ok(()));
    assert!(listener == speaker);
    for place in 0..messages.len() {
        for byte in (0..=u8::MAX).filter(|&byte| byte != messages[place]) {
            let mut heard = messages.clone();
            heard[place] = byte;
            let mut listener = team;
            if listener.hear(&plan, &heard).is_ok() {
                // A robot may have met a wall: then this is what the listener knows.
                assert_eq!(Message::decode(byte).map(|message| message.step), Ok(plan.steps()[place + 1]));
                assert!(listener != speaker);
            } else {
                assert!(listener == team);
            }
        }
    }
    assert_eq!(team.hear(&plan, &[]), Err(Damage::Length { bytes: 0, sent: 2 }));
}
