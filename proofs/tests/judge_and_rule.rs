//! The judge of chains and the kernel say the same thing twice: which team moves are admitted, and what the leader
//! does. They share no code, so that one change to either of them shows here.

use tautline_kernel::chain::{Chain, Kind, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, CompactGrid, Edge, EdgeMark, Grid, SmallGrid, Step};
use tautline_proofs::chain::breach::written;
use tautline_proofs::judge::chain::{JudgeInput, Move, Objection, Repairs, judge};
use tautline_proofs::run::{Frame, place, sides};

use crate::judge_of_chains::frames;

/// Answers that a linear congruence makes of the ones before.
struct Congruence(u64);

impl Oracle for Congruence {
    fn pick(&mut self, below: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (((self.0 >> 32) * u64::from(below)) >> 32) as u32
    }
}

fn input(
    clause: &'static str,
    rule: Rule,
    area: Area,
    walls: &[Edge],
    base: Cell,
    robots: usize,
) -> JudgeInput {
    let repairs = if rule == Rule::REPAIRED { Repairs::With } else { Repairs::Without };
    let (columns, rows) = place(area.last());
    let walls = walls.iter().copied().map(sides).collect();
    JudgeInput { walls, ..JudgeInput::open(clause, repairs, (columns + 1, rows + 1), place(base), robots) }
}

fn area(columns: i16, rows: i16) -> Area {
    Area::new(Cell::new(0, 0), Cell::new(columns - 1, rows - 1)).expect("cells")
}

/// Random team moves of 13 robots, so many that the judge does not ask what the leader does. Most of them are
/// refused, and the last four robots try most.
#[test]
fn the_judge_admits_the_team_moves_that_the_rule_admits() {
    const ROBOTS: usize = 13;
    let (mut drawn, area, base) = (Congruence(1), area(5, 5), Cell::new(2, 2));
    let does_not_break = "the last move does not break the clause";
    let mut told = [[0; 2]; 2];
    for round in 0..60 {
        let rule = if round % 2 == 0 { Rule::PUBLISHED } else { Rule::REPAIRED };
        let walls: Vec<Edge> = area.edges().filter(|_| drawn.pick(6) == 0).collect();
        let mut grid = CompactGrid::new(area).expect("five cells wide");
        let mut team = [base; ROBOTS];
        // Nothing breaks CHAIN-3, so the judge hears every move before the last one.
        let mut input = input("CHAIN-3", rule, area, &walls, base, ROBOTS);
        for _ in 0..60 {
            let mut steps = [Step::Stay; ROBOTS];
            for _ in 0..=drawn.pick(4) {
                let robot = if drawn.pick(40) == 0 { 0 } else { ROBOTS - 1 - drawn.pick(4) as usize };
                steps[robot] = Step::ALL[drawn.pick(5) as usize];
            }
            let crossed = |robot: usize| match steps[robot] {
                Step::Cross(side) => Some(Edge::new(team[robot], side)),
                Step::Stay => None,
            };
            let is_wall = |edge: Edge| {
                walls.contains(&edge)
                    || !area.contains(edge.cell())
                    || !area.contains(edge.cell().beyond(edge.side()))
            };
            let blocked: Vec<bool> = (0..ROBOTS).map(|robot| crossed(robot).is_some_and(is_wall)).collect();
            let to: [Cell; ROBOTS] = core::array::from_fn(|robot| {
                if blocked[robot] { team[robot] } else { team[robot].after(steps[robot]) }
            });
            let frame = Frame { kind: Kind::Advance, steps: steps.to_vec(), blocked, cells: to.to_vec() };
            input.moves.push(written(&frame));
            let is_admitted = rule.admits_plan(&mut grid, &team, &steps);
            let judgement = judge(&input);
            let objection = Objection { at: input.moves.len(), what: does_not_break };
            assert_eq!(judgement == Err(objection), is_admitted, "{judgement:?} of {input:?}");
            told[round % 2][usize::from(is_admitted)] += 1;
            if !is_admitted {
                input.moves.pop();
                continue;
            }
            for robot in 0..ROBOTS {
                if let Some(edge) = crossed(robot) {
                    grid.put_edge(if is_wall(edge) { EdgeMark::Wall } else { EdgeMark::Open }, edge);
                }
            }
            team = to;
        }
    }
    assert!(told.as_flattened().iter().all(|&times| times > 100), "{told:?}");
}

/// The run of three robots in a layout.
fn run(rule: Rule, area: Area, walls: &[Edge], base: Cell) -> Vec<Move> {
    let grid = SmallGrid::new(area).expect("three cells wide");
    let chain = Chain::<_, 3>::new(rule, 3, base, grid).expect("it fits");
    frames(chain, |edge| !walls.contains(&edge)).iter().map(written).collect()
}

/// In so few cells nothing within the reach of three robots is left out, by either rule, and walls shut cells off.
#[test]
fn the_judge_goes_along_with_the_run_in_every_layout_of_six_cells() {
    let ends = "the end of the run does not break the clause";
    for (area, bases) in [(area(3, 2), [(0, 0), (1, 1)]), (area(2, 3), [(1, 0), (0, 2)])] {
        let edges: Vec<Edge> = area.edges().collect();
        for set in 0..1_u32 << edges.len() {
            let walls: Vec<Edge> =
                (0..edges.len()).filter(|place| set >> place & 1 == 1).map(|place| edges[place]).collect();
            for (x, y) in bases {
                let base = Cell::new(x, y);
                for rule in [Rule::PUBLISHED, Rule::REPAIRED] {
                    let moves = run(rule, area, &walls, base);
                    for clause in ["CHAIN-13", "CHAIN-14"] {
                        let mut input = input(clause, rule, area, &walls, base, 3);
                        input.moves.clone_from(&moves);
                        assert_eq!(judge(&input), Err(Objection { at: 0, what: ends }), "{input:?}");
                        let Some(last) = input.moves.pop().filter(|_| moves.len() > 1) else { continue };
                        let goes_on = Objection { at: 0, what: "the run goes on after the last move" };
                        assert_eq!(judge(&input), Err(goes_on), "{input:?}");
                        input.moves.extend([last.clone(), last]);
                        let what = "the run is over before this move";
                        assert_eq!(
                            judge(&input),
                            Err(Objection { at: input.moves.len(), what }),
                            "{input:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_leader_that_goes_another_way_is_told() {
    let area = area(5, 5);
    let mut input = input("CHAIN-13", Rule::PUBLISHED, area, &[], Cell::new(2, 2), 3);
    let west = Move {
        is_backtrack: false,
        tried: vec![(0, 0), (0, 0), (-1, 0)],
        blocked: vec![false; 3],
        places: vec![(2, 2), (2, 2), (1, 2)],
    };
    input.moves.push(west);
    let what = "the leader has a candidate that comes first";
    assert_eq!(judge(&input), Err(Objection { at: 1, what }));
}

#[test]
fn the_end_of_a_run_of_more_than_twelve_robots_is_not_judged() {
    for (robots, is_judged) in [(12, true), (13, false), (14, false)] {
        let mut input = input("CHAIN-13", Rule::PUBLISHED, area(3, 3), &[], Cell::new(1, 1), robots);
        let nothing = Move {
            is_backtrack: false,
            tried: vec![(0, 0); robots],
            blocked: vec![false; robots],
            places: vec![(1, 1); robots],
        };
        input.moves.push(nothing);
        let what = "the judge cannot say of more than 12 robots whether their run is over";
        assert_eq!(judge(&input) != Err(Objection { at: 0, what }), is_judged, "{robots}");
    }
}
