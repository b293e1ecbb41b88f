//! A chain's own numbers between two moves, the robots for which a full cell is shut, and what a barrier hears.

use tautline_kernel::chain::{Barrier, ByteEffect, Chain, Condition, Damage, Intent, Message, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Circle, Edge, EdgeMark, Grid, Side, SmallGrid, Step};

use crate::numbers::Congruence;

fn grid(columns: i16, rows: i16) -> SmallGrid {
    let area = Area::new(Cell::new(0, 0), Cell::new(columns - 1, rows - 1)).expect("cells");
    SmallGrid::new(area).expect("it fits")
}

#[test]
fn a_full_cell_is_shut_for_the_leader_and_for_followers_by_a_condition_of_its_own() {
    const ROBOTS: usize = 5;
    let mut grid = grid(9, 9);
    for edge in grid.area().edges() {
        grid.put_edge(EdgeMark::Open, edge);
    }
    let [leader, follower] = [Condition::FullForLeader, Condition::FullForFollower];
    let (mut drawn, base, mut entered) = (Congruence(1), Cell::new(4, 4), [0; 2]);
    for _ in 0..60_000 {
        let mut team = [base; ROBOTS];
        for robot in 1..ROBOTS {
            let mut off = || drawn.pick(3) as i16 - 1;
            team[robot] = Cell::new(team[robot - 1].x + off(), team[robot - 1].y + off());
        }
        let steps: [Step; ROBOTS] =
            core::array::from_fn(
                |robot| {
                    if robot == 0 { Step::Stay } else { Step::ALL[drawn.pick(5) as usize] }
                },
            );
        let enters_full = |robot: usize| {
            let to = team[robot].after(steps[robot]);
            steps[robot] != Step::Stay && to != base && team.iter().filter(|&&cell| cell == to).count() > 1
        };
        let (leads, follows) = (enters_full(ROBOTS - 1), (1..ROBOTS - 1).any(enters_full));
        let mut admits = |rule: Rule| rule.admits_plan(&mut grid, &team, &steps);
        let is_admitted = admits(Rule::REPAIRED.without(leader).without(follower));
        assert_eq!(admits(Rule::REPAIRED.without(leader)), is_admitted && !follows, "{team:?} {steps:?}");
        assert_eq!(admits(Rule::REPAIRED.without(follower)), is_admitted && !leads, "{team:?} {steps:?}");
        assert_eq!(admits(Rule::REPAIRED), is_admitted && !leads && !follows, "{team:?} {steps:?}");
        entered[0] += u32::from(is_admitted && leads);
        entered[1] += u32::from(is_admitted && follows);
    }
    assert!(entered.iter().all(|&times| times > 20), "{entered:?}");
}

/// Whether `rule` admits the steps, in the words of its conditions.
fn is_admitted(rule: Rule, grid: &SmallGrid, team: &[Cell], steps: &[Step]) -> bool {
    let apart = |one: Cell, other: Cell| (one.x.abs_diff(other.x), one.y.abs_diff(other.y));
    let is_safe = |one, other| apart(one, other).0.max(apart(one, other).1) <= 1;
    let is_covered = |one, other| is_safe(one, other) || apart(one, other).0 + apart(one, other).1 == 2;
    let (has, base) = (|condition| rule.has(condition), team[0]);
    let to = |robot: usize| team[robot].after(steps[robot]);
    let carries = |robot: usize, mark| match steps[robot] {
        Step::Cross(side) => grid.edge_has(mark, Edge::new(team[robot], side)),
        Step::Stay => false,
    };
    let others = |robot: usize| (1..team.len()).filter(move |&other| other != robot);
    let is_exchanged = |robot: usize| {
        let is_outside = team[robot] != base && to(robot) != base && team[robot] != to(robot);
        is_outside && others(robot).any(|other| team[other] == to(robot) && to(other) == team[robot])
    };
    steps[0] == Step::Stay
        && (1..team.len()).all(|robot| {
            let (is_leader, stays) = (robot + 1 == team.len(), steps[robot] == Step::Stay);
            let is_sure = stays || carries(robot, EdgeMark::Open);
            let is_full = to(robot) != base && team.iter().filter(|&&cell| cell == to(robot)).count() > 1;
            let full = if is_leader { Condition::FullForLeader } else { Condition::FullForFollower };
            let shares = to(robot) != base && others(robot).any(|other| to(other) == to(robot));
            !carries(robot, EdgeMark::Wall)
                && (!has(Condition::CoveredBehind)
                    || is_leader && stays
                    || is_covered(to(robot), team[robot - 1]))
                && (!has(Condition::SafeAhead) || is_safe(to(robot - 1), to(robot)))
                && (!has(Condition::UnsureAhead) || is_sure || is_covered(to(robot - 1), team[robot]))
                && (!has(Condition::Hold) || is_covered(to(robot - 1), team[robot]))
                && (!has(Condition::Distinct) || !shares)
                && (!has(Condition::NoExchange) || !is_exchanged(robot))
                && (!has(full) || stays || !is_full)
        })
}

#[test]
fn a_team_move_is_admitted_if_each_of_the_conditions_says_so() {
    const ROBOTS: usize = 4;
    let area = grid(9, 9).area();
    let (mut drawn, base) = (Congruence(4), Cell::new(4, 4));
    let mut told = [0; 2];
    for round in 0..4000 {
        let condition = Condition::ALL[round % Condition::ALL.len()];
        let rule =
            [Rule::PUBLISHED, Rule::REPAIRED, Rule::REEL, Rule::APART][round / Condition::ALL.len() % 4];
        let rule = if drawn.pick(2) == 0 { rule.without(condition) } else { rule };
        let mut grid = grid(9, 9);
        for edge in area.edges() {
            match drawn.pick(8) {
                0 => grid.put_edge(EdgeMark::Wall, edge),
                1..=3 => grid.put_edge(EdgeMark::Open, edge),
                _ => {}
            }
        }
        let mut team = [base; ROBOTS];
        for robot in 1..ROBOTS {
            let mut off = || drawn.pick(3) as i16 - 1 + (drawn.pick(6) / 5) as i16;
            let (x, y) = (team[robot - 1].x + off(), team[robot - 1].y + off());
            team[robot] = Cell::new(x.clamp(0, 8), y.clamp(0, 8));
        }
        let mut steps: [Step; ROBOTS] = core::array::from_fn(|_| Step::ALL[drawn.pick(5) as usize]);
        steps[ROBOTS - 1] = if drawn.pick(2) == 0 { Step::Stay } else { steps[ROBOTS - 1] };
        steps[0] = if drawn.pick(20) == 0 { steps[0] } else { Step::Stay };
        let expected = is_admitted(rule, &grid, &team, &steps);
        let before = grid;
        assert_eq!(rule.admits_plan(&mut grid, &team, &steps), expected, "{rule:?} {team:?} {steps:?}");
        assert!(grid == before, "the grid is left as it was");
        told[usize::from(expected)] += 1;
        for robots in 0..ROBOTS {
            let is_nothing = robots == 0;
            assert!(!rule.admits_plan(&mut grid, &team, &[Step::Stay; ROBOTS][..robots]));
            assert!(!rule.admits_plan(&mut grid, &team[..robots], &[Step::Stay; ROBOTS]));
            assert_eq!(rule.admits_plan(&mut grid, &[], &[Step::Stay; ROBOTS][..robots]), is_nothing);
        }
    }
    assert!(told.iter().all(|&times| times > 100), "{told:?}");
}

#[test]
fn a_rule_keeps_what_its_repairs_promise() {
    let rules = Condition::ALL.map(|condition| Rule::REPAIRED.without(condition));
    for rule in rules.into_iter().chain([
        Rule::PUBLISHED,
        Rule::REPAIRED,
        Rule::REEL,
        Rule::REEL.without(Condition::UnsureAhead),
    ]) {
        let has = |condition| rule.has(condition);
        assert_eq!(
            rule.keeps_apart(),
            has(Condition::FullForLeader) && has(Condition::FullForFollower),
            "{rule:?}"
        );
        let covers_cells = has(Condition::UnsureAhead) || has(Condition::Hold);
        for (x, y) in (-3..=3).flat_map(|x| (-3..=3).map(move |y| (x, y))) {
            let (behind, ahead) = (Cell::new(0, 0), Cell::new(x, y));
            let is_near = if covers_cells {
                x.abs() <= 1 && y.abs() <= 1 || x.abs() + y.abs() == 2
            } else {
                x * x + y * y < 7
            };
            assert_eq!(rule.keeps_contact(behind, ahead), is_near, "{rule:?} {ahead}");
            assert_eq!(Circle::COVERED.reaches(behind, ahead), x * x + y * y < 7, "{ahead}");
        }
    }
}

/// The run of a chain, told of every chain before a move, as it has planned, and after the move.
fn run(
    rule: Rule,
    robots: usize,
    base: Cell,
    is_open: impl Fn(Edge) -> bool,
    mut tell: impl FnMut(&Chain<SmallGrid, 5>, &Chain<SmallGrid, 5>, &Chain<SmallGrid, 5>),
) {
    let mut chain = Chain::<_, 5>::new(rule, robots, base, grid(5, 5)).expect("it fits");
    let mut log = Vec::new();
    loop {
        let before = chain;
        let Intent::Go(plan) = chain.plan(&log).expect("its own log") else { break };
        let planned = chain;
        log.extend_from_slice(chain.settle(&plan, &is_open).messages());
        tell(&before, &planned, &chain);
    }
}

#[test]
fn a_chain_tells_what_its_plan_has_cost_and_what_it_would_take_back() {
    for robots in [2, 3, 5] {
        let (mut moves, mut latest) = (0, None);
        run(
            Rule::REPAIRED,
            robots,
            Cell::new(2, 2),
            |_| true,
            |before, planned, after| {
                let followers = robots as u32 - 2;
                let (least, most) = (followers.min(1), 100 * robots as u32);
                assert!(
                    (least..=most).contains(&planned.looked_at()) || planned.looked_at() == 0,
                    "{}",
                    planned.looked_at()
                );
                latest = latest.max(Some(planned.looked_at()));
                assert!(!planned.is_cut_short() && !planned.is_refused());
                assert_eq!(before.until_gain(), None);
                // Either the move that was made is the next one that can be taken back, or one was.
                assert!(after.last_open() == Some(moves) || after.last_open() < before.last_open());
                moves += 1;
            },
        );
        // A follower has five candidates at most, and more than one.
        assert!(moves > 0 && (robots == 2 || latest > Some(1)), "{latest:?}");
    }
}

#[test]
fn a_plan_that_no_follower_has_to_move_for_costs_one_look_for_each_of_them() {
    for robots in 2..=5 {
        let mut chain =
            Chain::<_, 5>::new(Rule::REPAIRED, robots, Cell::new(2, 2), grid(5, 5)).expect("it fits");
        let Ok(Intent::Go(plan)) = chain.plan(&[]) else { panic!("it goes") };
        assert!(plan.steps()[1..robots - 1].iter().all(|&step| step == Step::Stay));
        assert_eq!((chain.looked_at(), chain.is_cut_short()), (robots as u32 - 2, false));
    }
}

#[test]
fn a_reel_tells_in_how_many_moves_it_gains() {
    let (mut drawn, mut told) = (Congruence(2), 0);
    for _ in 0..40 {
        let is_wall: [bool; 50] = core::array::from_fn(|_| drawn.pick(4) == 0);
        let mut expected = None;
        let is_open = |edge: Edge| {
            let place = 10 * edge.cell().y + 2 * edge.cell().x + i16::from(edge.side() == Side::East);
            !is_wall[place as usize]
        };
        run(Rule::REEL, 4, Cell::new(2, 2), is_open, |before, planned, after| {
            let (left, gains) = (planned.until_gain(), after.grid() != before.grid());
            assert!(gains || left != Some(1), "the last move explores a cell");
            // What the reel has begun goes on, unless it can touch something on the way.
            assert!(gains || expected.is_none() || left == expected, "{left:?}, not {expected:?}");
            expected = left.filter(|_| !gains).map(|left| left - 1);
            told += u32::from(expected.is_some());
        });
    }
    assert!(told > 20, "{told}");
}

#[test]
fn a_chain_is_where_another_one_is_if_it_stands_and_knows_alike() {
    let mut before = Vec::new();
    run(Rule::REPAIRED, 3, Cell::new(2, 2), |_| true, |chain, _, _| before.push(*chain));
    for (one, first) in before.iter().enumerate() {
        for (other, second) in before.iter().enumerate() {
            let is_same = first.cells() == second.cells()
                && first.grid() == second.grid()
                && (first.gained(), first.is_unfolding()) == (second.gained(), second.is_unfolding());
            assert_eq!(first.is_where(second), is_same, "{one} {other}");
        }
    }
    let [known, unknown] = [before[0], before[0]];
    let learnt = known.grid().area().edges().next().expect("an edge");
    let mut grid = *unknown.grid();
    grid.put_edge(EdgeMark::Wall, learnt);
    let other = Chain::<_, 5>::new(Rule::REPAIRED, 3, Cell::new(2, 2), grid).expect("it fits");
    assert!(known.is_where(&unknown) && !known.is_where(&other));
}

#[test]
fn a_barrier_tells_of_every_byte_which_team_move_it_is_about() {
    const ROBOTS: usize = 4;
    let is_message = |byte| Message::decode(byte).is_ok();
    let own = |turn: u32| (turn % 5) as u8;
    for robot in 1..ROBOTS {
        let mut barrier = Barrier::<ROBOTS>::new(ROBOTS, robot);
        for turn in 0..6 {
            assert_eq!((barrier.turn(), barrier.again()), (turn, None));
            for (from, byte) in (0..=ROBOTS).flat_map(|from| (0..=u8::MAX).map(move |byte| (from, byte))) {
                // The lowest five bits are the message, two count team moves, and the highest says that it was asked
                // for.
                let (message, about, is_answer) =
                    (byte & 0b1_1111, u32::from(byte >> 5 & 0b11), byte >> 7 == 1);
                let expected = if !is_message(message) {
                    Err(Damage::Byte(message))
                } else if from == robot || !(1..ROBOTS).contains(&from) {
                    Ok(ByteEffect::Foreign)
                } else if about == turn % 4 {
                    Ok(ByteEffect::New)
                } else if about == (turn + 1) % 4 {
                    Ok(ByteEffect::Early)
                } else if about == (turn + 3) % 4 && turn > 0 && !is_answer {
                    Ok(ByteEffect::Late(own(turn - 1) | (about as u8) << 5 | 1 << 7))
                } else {
                    Ok(ByteEffect::Foreign)
                };
                let mut heard = barrier;
                assert_eq!(
                    heard.hear(from, byte),
                    expected,
                    "{robot} hears {byte:08b} from {from} in {turn}"
                );
                if expected == Ok(ByteEffect::New) {
                    assert_eq!(heard.hear(from, byte), Ok(ByteEffect::Again));
                    let other = byte ^ 1;
                    if is_message(other & 0b1_1111) {
                        assert_eq!(heard.hear(from, other), Err(Damage::OtherStep(from + 1)));
                        assert_eq!(heard.hear(from, byte), Ok(ByteEffect::Again));
                    }
                }
            }
            let said = barrier.say(own(turn));
            assert_eq!((said, barrier.again()), (own(turn) | ((turn % 4) as u8) << 5, Some(said)));
            for from in (1..ROBOTS).filter(|&from| from != robot) {
                assert_eq!(barrier.pass(), None);
                assert_eq!(barrier.hear(from, from as u8 | ((turn % 4) as u8) << 5), Ok(ByteEffect::New));
            }
            let mut messages = [1, 2, 3, 0];
            messages[robot - 1] = own(turn);
            assert_eq!(barrier.pass(), Some(messages));
        }
    }
}
