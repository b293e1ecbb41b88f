//! The judge of chains accepts the smallest counterexamples, and none with one change.

use std::collections::BTreeSet;

use tautline_kernel::chain::{Chain, Intent, Rule};
use tautline_kernel::ground::{Area, Cell, Edge, Side, SmallGrid};
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::breach::{frame, written};
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::search::{Bounds, Counterexample, search};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::judge::chain::{JudgeInput, Move, Objection, Place, Repairs, judge};
use tautline_proofs::run::{Frame, place, sides, walls};

fn input(found: &Counterexample, bounds: &Bounds) -> JudgeInput {
    let side = 2 * bounds.robots as i32 - 1;
    let repairs = if bounds.observed.rule == Rule::REPAIRED { Repairs::With } else { Repairs::Without };
    let (clause, base) = (found.broken.clause(), place(bounds.base));
    JudgeInput {
        walls: walls(&found.frames).into_iter().map(sides).collect(),
        moves: found.frames.iter().map(written).collect(),
        ..JudgeInput::open(clause, repairs, (side, side), base, bounds.robots)
    }
}

fn found(bounds: &Bounds) -> Vec<JudgeInput> {
    let found = search(bounds, &mut unwatched).expect("so few robots fit");
    found.counterexamples.iter().map(|found| input(found, bounds)).collect()
}

/// The smallest counterexample to each clause that the judge knows and a rule breaks.
fn counterexamples() -> Vec<JudgeInput> {
    let exhausting =
        |observed| Bounds { invariants: vec![Invariant::Exhausts], ..Bounds::new(observed, 3, 3) };
    let any_order = Bounds { invariants: vec![Invariant::AnyOrder], ..Bounds::new(Subject::REPAIRED, 4, 3) };
    let exchange =
        |observed| Bounds { invariants: vec![Invariant::Exchanges], ..Bounds::new(observed, 3, 1) };
    let bounds = [
        exchange(Subject::PUBLISHED),
        exchange(Subject::REPAIRED),
        Bounds::new(Subject::PUBLISHED, 4, 4),
        exhausting(Subject::PUBLISHED),
        exhausting(Subject::REPAIRED),
        any_order,
    ];
    bounds.iter().flat_map(found).collect()
}

/// A move of the whole team in the open.
fn step(tried: [Place; 2], places: [Place; 2], is_backtrack: bool) -> Move {
    let base = (2, 2);
    Move {
        is_backtrack,
        tried: [vec![(0, 0)], tried.to_vec()].concat(),
        blocked: vec![false; 3],
        places: [vec![base], places.to_vec()].concat(),
    }
}

#[test]
fn a_step_and_back_is_not_the_end_of_a_run() {
    let out = step([(0, 0), (1, 0)], [(2, 2), (3, 2)], false);
    let back = step([(0, 0), (-1, 0)], [(2, 2), (2, 2)], true);
    for clause in ["CHAIN-13", "CHAIN-14"] {
        for repairs in [Repairs::Without, Repairs::With] {
            let mut input = JudgeInput::open(clause, repairs, (5, 5), (2, 2), 3);
            input.moves.push(out.clone());
            let goes_on = Objection { at: 0, what: "the run goes on after the last move" };
            assert_eq!(judge(&input), Err(goes_on));
            input.moves.push(back.clone());
            let has_a_way = "the leader has a way on: the team takes no move back";
            assert_eq!(judge(&input), Err(Objection { at: 2, what: has_a_way }));
        }
    }
}

/// The team moves of a chain up to its end.
pub(crate) fn frames(mut chain: Chain<SmallGrid, 3>, is_open: impl Fn(Edge) -> bool) -> Vec<Frame> {
    let (mut log, mut frames) = (Vec::new(), Vec::new());
    while let Intent::Go(plan) = chain.plan(&log).expect("its own log") {
        let settled = chain.settle(&plan, &is_open);
        log.extend_from_slice(settled.messages());
        frames.push(frame(plan.kind, settled.messages(), chain.cells()));
    }
    frames
}

/// The whole run of three robots in the open, as a counterexample to `clause`.
fn open_run(observed: Subject, clause: &'static str) -> JudgeInput {
    let bounds = Bounds::new(observed, 3, 0);
    let grid = SmallGrid::new(bounds.area).expect("five cells wide");
    let chain = Chain::<_, 3>::new(observed.rule, 3, bounds.base, grid).expect("it fits");
    let frames = frames(chain, |_| true);
    let (broken, demand, answers) = (Invariant::Exhausts, "nothing", Vec::new());
    let run = Counterexample { broken, runs: 1, demand, frames, answers };
    JudgeInput { clause, ..input(&run, &bounds) }
}

#[test]
fn a_run_that_ends_with_everything_explored_breaks_nothing() {
    for (observed, clause) in [(Subject::PUBLISHED, "CHAIN-13"), (Subject::REPAIRED, "CHAIN-14")] {
        let mut input = open_run(observed, clause);
        let what = "the end of the run does not break the clause";
        assert_eq!(judge(&input), Err(Objection { at: 0, what }));
        let last = input.moves.pop().expect("it has moves");
        let what = "the run goes on after the last move";
        assert_eq!(judge(&input), Err(Objection { at: 0, what }));
        input.moves.extend([last.clone(), last]);
        let what = "the run is over before this move";
        assert_eq!(judge(&input), Err(Objection { at: input.moves.len(), what }));
    }
}

#[test]
fn the_minimal_counterexamples_are_accepted_and_none_with_one_change() {
    let inputs = counterexamples();
    assert_eq!(
        inputs.iter().map(|input| (input.clause, input.repairs)).collect::<Vec<_>>(),
        [
            ("CHAIN-1", Repairs::Without),
            ("CHAIN-2", Repairs::Without),
            ("CHAIN-13", Repairs::Without),
            ("CHAIN-14", Repairs::Without),
            ("CHAIN-14", Repairs::With),
            ("CHAIN-19", Repairs::With),
        ]
    );
    for input in inputs {
        assert_eq!(judge(&input), Ok(()), "{}", input.clause);
        let rejects = |change: &dyn Fn(&mut JudgeInput), what: &str| {
            let mut changed = input.clone();
            change(&mut changed);
            assert!(judge(&changed).is_err(), "{}: {what} is accepted", input.clause);
        };
        let (width, height) = (input.width, input.height);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            for wall in [((x, y), (x + 1, y)), ((x, y), (x, y + 1))] {
                if wall.1.0 < width && wall.1.1 < height {
                    rejects(
                        &|changed| {
                            if !changed.walls.remove(&wall) {
                                changed.walls.insert(wall);
                            }
                        },
                        &format!("a changed wall {wall:?}"),
                    );
                }
            }
        }
        for index in 0..input.moves.len() {
            rejects(&|changed| drop(changed.moves.remove(index)), &format!("move {index} left out"));
            let twice = |changed: &mut JudgeInput| changed.moves.insert(index, changed.moves[index].clone());
            rejects(&twice, &format!("move {index} twice: {:?}", input.moves[index]));
            rejects(&|changed| changed.moves.truncate(index), &format!("nothing from move {index} on"));
            rejects(
                &|changed| changed.moves[index].is_backtrack ^= true,
                &format!("move {index} as the other kind: {:?}", input.moves[index]),
            );
            for robot in 0..input.robots {
                let flip = |changed: &mut JudgeInput| changed.moves[index].blocked[robot] ^= true;
                rejects(&flip, "another outcome");
                for step in [(1, 0), (0, 1), (-1, 0), (0, -1), (0, 0)] {
                    if input.moves[index].tried[robot] != step {
                        let change = |changed: &mut JudgeInput| changed.moves[index].tried[robot] = step;
                        rejects(&change, &format!("step {step:?} of robot {robot} in move {index}"));
                    }
                    let shift = |changed: &mut JudgeInput| {
                        let place = &mut changed.moves[index].places[robot];
                        *place = (place.0 + step.0, place.1 + step.1);
                    };
                    if step != (0, 0) {
                        rejects(&shift, "another place");
                    }
                }
            }
        }
        // The run that breaks CHAIN-14 as repaired is one that the published rule makes, too.
        if input.repairs == Repairs::Without {
            rejects(&|changed| changed.repairs = Repairs::With, "the repaired rule");
        }
        rejects(&|changed| changed.clause = "CHAIN-3", "another clause");
        rejects(&|changed| changed.robots += 1, "another robot");
        rejects(&|changed| changed.base.0 -= 1, "another base");
        rejects(&|changed| changed.blocked = BTreeSet::from([changed.base]), "a blocked base");
        rejects(&|changed| changed.robots = usize::MAX, "more robots than there can be");
    }
}

/// CHAIN-27: what a wall has brought together, a team move that is taken back brings together once more.
#[test]
fn two_robots_that_a_backtrack_brings_into_one_cell_are_judged_to_meet() {
    for observed in [Subject::PUBLISHED, Subject::REPAIRED] {
        meets_in_its_sixth_move(observed);
    }
}

fn meets_in_its_sixth_move(observed: Subject) {
    let (area, base) = (Area::new(Cell::new(0, 0), Cell::new(3, 0)).expect("cells"), Cell::new(1, 0));
    let grid = SmallGrid::new(area).expect("four cells");
    let chain = Chain::<_, 3>::new(observed.rule, 3, base, grid).expect("it fits");
    let wall = Edge::new(Cell::new(2, 0), Side::East);
    let mut frames = frames(chain, |edge| edge != wall);
    frames.truncate(6);
    let bounds = Bounds { area, base, ..Bounds::new(observed, 3, 1) };
    let (broken, demand, answers) = (Invariant::Meets, "nothing", Vec::new());
    let found = Counterexample { broken, runs: 1, demand, frames, answers };
    let mut input = JudgeInput { width: 4, height: 1, ..input(&found, &bounds) };
    assert_eq!(judge(&input), Ok(()));
    input.moves.pop();
    assert_eq!(judge(&input), Err(Objection { at: 5, what: "the last move does not break the clause" }));
}
