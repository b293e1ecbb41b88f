//! The judge of agents accepts what refutes a clause, and nothing with one change.

use std::collections::BTreeSet;

use tautline_proofs::decide::Depiction;
use tautline_proofs::floor_trace::Course;
use tautline_proofs::judge::floor::{JudgeInput, Judgement, Objection, Place, Turn, judge};
use tautline_proofs::run::place;

use crate::refuted::{Refutation, of};

fn written_down(clause: &'static str, course: &Course) -> JudgeInput {
    let turn = |turn: &tautline_proofs::floor_trace::Turn| Turn {
        agent: turn.agent,
        to: place(turn.before.cells[turn.agent].after(turn.step)),
        is_done: turn.is_done,
    };
    let starts = course.turns[0].before.cells.iter().copied().map(place).collect();
    let turns = course.turns.iter().map(turn).collect();
    JudgeInput {
        blocked: course.blocked.iter().copied().map(place).collect(),
        round: course.round,
        ..JudgeInput::open(clause, (course.width.into(), course.height.into()), starts, turns)
    }
}

/// Exhibits that refute BRICKS-5 and BRICKS-6 with sensors missed, and BRICKS-6 without: a run that ends too early, and
/// one that goes round.
fn inputs() -> impl Iterator<Item = JudgeInput> {
    of(|id| ["BRICKS-5", "BRICKS-6"].contains(&id)).map(input)
}

fn input(refuted: &Refutation) -> JudgeInput {
    let Depiction::Agents(course) = &refuted.found.seen else {
        panic!("no run of agents: {:?}", refuted.found)
    };
    written_down(refuted.clause.id, course)
}

#[test]
fn what_refutes_a_clause_is_accepted_and_with_one_change_is_not() {
    let mut rounds = 0;
    for input in inputs() {
        assert_eq!(judge(&input), Ok(Judgement::Broken), "{input:?}");
        rounds += usize::from(input.round > 0);
        let rejects = |change: &dyn Fn(&mut JudgeInput), what: &str| {
            let mut changed = input.clone();
            change(&mut changed);
            assert!(judge(&changed) != Ok(Judgement::Broken), "{what} is accepted: {changed:?}");
        };
        let last = input.turns.len() - 1;
        // Of a round that is gone twice, a part is a round, too.
        let is_round = input.round > 0 && input.turns[last - 1].to == input.turns[last - 1 - input.round].to;
        if !is_round {
            rejects(&|changed| changed.turns.truncate(last), "a run that is cut");
        }
        rejects(&|changed| changed.round = changed.turns.len() + 1, "a longer round than the run");
        rejects(&|changed| changed.turns[last].agent = 7, "nobody");
        rejects(&|changed| changed.turns[0].to = (9, 9), "a step out of the layout");
        rejects(&|changed| changed.turns[0].is_done = true, "an agent that is done too early");
        rejects(&|changed| changed.starts[0] = (-1, 0), "a start outside");
        rejects(&|changed| changed.starts.push((0, 0)), "another agent, which does nothing");
        rejects(&|changed| changed.clause = "BRICKS-2", "a clause about marks");
        if input.round == 0 {
            rejects(&|changed| changed.turns[last].is_done = false, "a run that is not over");
            rejects(&|changed| changed.round = 1, "a round that is none");
        } else {
            rejects(&|changed| changed.round -= 1, "a shorter round");
            rejects(&|changed| changed.round = 0, "a run that does not end");
        }
    }
    assert!(rounds > 0, "no run goes round");
}

#[test]
fn an_agent_that_is_done_while_a_cell_is_unexplored_breaks_bricks_4() {
    let turn = |to, is_done| Turn { agent: 0, to, is_done };
    let input = |turns: &[Turn]| JudgeInput::open("BRICKS-4", (3, 1), vec![(0, 0)], turns.to_vec());
    let early = [turn((1, 0), false), turn((1, 0), true)];
    assert_eq!(judge(&input(&early)), Ok(Judgement::Broken));
    let late = [turn((1, 0), false), turn((2, 0), false), turn((2, 0), true)];
    assert_eq!(
        judge(&input(&late)),
        Ok(Judgement::Unseen),
        "what is left to go through is a matter of marks"
    );
    assert!(judge(&input(&late[..2])).is_err(), "nobody is done");
    let mut cut_off = input(&early);
    cut_off.walls.insert(((1, 0), (2, 0)));
    assert_eq!(judge(&cut_off), Ok(Judgement::Unseen), "the third cell is not connected");
    let through = [turn((2, 0), false), turn((2, 0), true)];
    assert!(judge(&input(&through)).is_err(), "two cells in one turn");
}

#[test]
fn an_agent_alone_that_makes_more_than_two_moves_a_cell_breaks_bricks_12() {
    let run = |moves: usize| {
        let turns = (1..=moves as i32).map(|to| Turn { agent: 0, to: (to % 2, 0), is_done: false });
        JudgeInput::open("BRICKS-12", (2, 1), vec![(0, 0)], turns.collect())
    };
    assert_eq!(judge(&run(5)), Ok(Judgement::Broken));
    assert!(judge(&run(4)).is_err(), "two moves a cell");
    assert!(judge(&run(6)).is_err(), "it is broken before");
    let mut stays = run(5);
    stays.turns[4].to = (0, 0);
    assert!(judge(&stays).is_err(), "an agent that stays makes no move");
    let mut two = run(5);
    two.starts.push((0, 0));
    assert!(judge(&two).is_err(), "it is not alone");
    let input = of(|id| id == "BRICKS-12").map(input).next().expect("it is refuted");
    assert_eq!(judge(&input), Ok(Judgement::Broken));
    let mut from = input.starts[0];
    for (index, turn) in input.turns.iter().enumerate() {
        let mut cut = input.clone();
        cut.turns.remove(index);
        // A turn in which it stays is no move.
        assert_eq!(judge(&cut).is_ok(), turn.to == from, "{turn:?} left out");
        from = turn.to;
    }
}

/// Agents on 3×3 cells, of which the middle one is where all start.
fn in_the_middle(
    clause: &'static str,
    agents: usize,
    turns: &[(usize, Place, bool)],
    round: usize,
) -> JudgeInput {
    let turns = turns.iter().map(|&(agent, to, is_done)| Turn { agent, to, is_done }).collect();
    JudgeInput { round, ..JudgeInput::open(clause, (3, 3), vec![MIDDLE; agents], turns) }
}

const MIDDLE: Place = (1, 1);
const EAST: Place = (2, 1);
const CORNER: Place = (2, 2);
/// A step and back.
const GO_BACK: [(usize, Place, bool); 2] = [(0, EAST, false), (0, MIDDLE, false)];

#[test]
fn a_cell_is_due_if_it_is_connected_with_a_start() {
    let cells: BTreeSet<Place> = (0..3).flat_map(|x| (0..3).map(move |y| (x, y))).collect();
    for (x, y) in [(1, 0), (2, 1), (1, 2), (0, 1)] {
        let done = in_the_middle("BRICKS-4", 1, &[(0, (1, 1), true)], 0);
        let blocked: BTreeSet<Place> = cells.iter().copied().filter(|&cell| cell != (1, 1)).collect();
        let alone = JudgeInput { blocked: blocked.clone(), ..done.clone() };
        assert_eq!(judge(&alone), Ok(Judgement::Unseen), "no other cell is free");
        let mut one_more = alone.clone();
        one_more.blocked.remove(&(x, y));
        assert_eq!(judge(&one_more), Ok(Judgement::Broken), "{:?} is unexplored", (x, y));
        one_more.walls.insert(((1, 1).min((x, y)), (1, 1).max((x, y))));
        assert_eq!(judge(&one_more), Ok(Judgement::Unseen), "{:?} is not connected", (x, y));
        // The corner after it is connected through it alone.
        let corner = (1 + (x - 1) - (y - 1), 1 + (y - 1) + (x - 1));
        let mut by_a_corner = alone.clone();
        by_a_corner.blocked.remove(&corner);
        assert_eq!(judge(&by_a_corner), Ok(Judgement::Unseen), "{corner:?} is not connected");
        by_a_corner.blocked.remove(&(x, y));
        by_a_corner.turns = [((x, y), false), ((1, 1), false), ((1, 1), true)]
            .map(|(to, is_done)| Turn { agent: 0, to, is_done })
            .to_vec();
        assert_eq!(judge(&by_a_corner), Ok(Judgement::Broken), "{corner:?} is unexplored");
    }
}

/// A clause, how many agents, their turns, how long the round is, and what the judge says.
type Ruling = (&'static str, usize, &'static [(usize, Place, bool)], usize, &'static str);

#[test]
fn the_judge_of_agents_says_what_is_wrong_and_in_which_turn() {
    let says = |input: &JudgeInput| match judge(input) {
        Ok(judgement) => format!("{judgement:?}"),
        Err(objection) => objection.of("turn"),
    };
    let no_clause_needs_it = "a counterexample needs an agent and its turns";
    let not_round = "the last turns do not come back to where they began, or leave an agent out";
    let cases: [Ruling; 16] = [
        ("BRICKS-5", 1, &[], 0, no_clause_needs_it),
        ("BRICKS-5", 0, &[(0, MIDDLE, false)], 0, no_clause_needs_it),
        ("BRICKS-5", 1, &[(0, MIDDLE, false)], 2, no_clause_needs_it),
        (
            "BRICKS-5",
            1,
            &[(0, EAST, false), (0, (0, 1), false)],
            0,
            "turn 2: an agent goes where it cannot go",
        ),
        ("BRICKS-5", 1, &[(0, EAST, false), (0, CORNER, true)], 0, "turn 2: an agent that goes is not done"),
        ("BRICKS-5", 1, &[(0, MIDDLE, true), (0, MIDDLE, true)], 0, "turn 2: an agent acts that is done"),
        ("BRICKS-5", 1, &GO_BACK, 0, "the run is not over, or every cell is explored"),
        ("BRICKS-6", 1, &GO_BACK, 0, "the run is not over"),
        ("BRICKS-6", 1, &[(0, MIDDLE, true)], 0, "Broken"),
        (
            "BRICKS-4",
            2,
            &[(0, MIDDLE, true), (1, EAST, false)],
            0,
            "turn 1: the clause is broken before the last turn",
        ),
        ("BRICKS-4", 2, &[(1, EAST, false), (0, MIDDLE, true)], 0, "Broken"),
        // A run that is one round, a round after a way that leads into it, and rounds that are none.
        ("BRICKS-5", 1, &[(0, MIDDLE, false)], 1, "Broken"),
        (
            "BRICKS-6",
            1,
            &[(0, EAST, false), (0, MIDDLE, false), (0, EAST, false), (0, MIDDLE, false)],
            2,
            "Broken",
        ),
        ("BRICKS-6", 1, &GO_BACK, 2, not_round),
        ("BRICKS-6", 2, &[(1, MIDDLE, false), (0, MIDDLE, false)], 1, not_round),
        ("BRICKS-6", 2, &[(1, MIDDLE, true), (0, MIDDLE, false)], 1, "Broken"),
    ];
    for (clause, agents, turns, round, words) in cases {
        assert_eq!(says(&in_the_middle(clause, agents, turns, round)), words, "{clause} {turns:?} {round}");
    }
    // With no other cell the run is over and nothing is left: that is a matter of marks, or no counterexample.
    let all_explored = |clause: &'static str, round: usize, is_done: bool| {
        let input = in_the_middle(clause, 1, &[(0, MIDDLE, is_done)], round);
        says(&JudgeInput { width: 2, height: 2, blocked: BTreeSet::from([(0, 1), (1, 0)]), ..input })
    };
    assert_eq!(all_explored("BRICKS-6", 0, true), "Unseen");
    assert_eq!(all_explored("BRICKS-5", 0, true), "the run is not over, or every cell is explored");
    assert_eq!(all_explored("BRICKS-5", 1, false), "every cell is explored");
    assert_eq!(all_explored("BRICKS-6", 1, false), "Broken");
    assert_eq!(
        judge(&in_the_middle("BRICKS-5", 1, &[], 0)),
        Err(Objection { at: 0, what: no_clause_needs_it })
    );
}
