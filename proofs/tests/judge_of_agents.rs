//! The judge of agents accepts what refutes a clause, and nothing with one change.

use std::collections::BTreeSet;

use tautline_kernel::ground::Cell;
use tautline_proofs::course::Course;
use tautline_proofs::decide::{Memory, Seen, Verdict};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::judge::floor::{Exhibit, Judgement, Place, Turn, judge};
use tautline_proofs::ledger;

fn place(cell: Cell) -> Place {
    (i32::from(cell.x), i32::from(cell.y))
}

fn written_down(clause: &str, course: &Course) -> Exhibit {
    let turn = |turn: &tautline_proofs::course::Turn| Turn {
        agent: turn.agent,
        to: place(turn.before.cells[turn.agent].after(turn.step)),
        is_done: turn.is_done,
    };
    Exhibit {
        clause: clause.to_owned(),
        width: course.width.into(),
        height: course.height.into(),
        walls: BTreeSet::new(),
        blocked: course.blocked.iter().copied().map(place).collect(),
        starts: course.turns[0].before.cells.iter().copied().map(place).collect(),
        turns: course.turns.iter().map(turn).collect(),
        round: course.round,
    }
}

/// What refutes BRICKS-5 and BRICKS-6 with sensors missed, and BRICKS-6 without: a run that ends too early, and one
/// that goes round.
fn exhibits() -> Vec<Exhibit> {
    let mut memory = Memory::default();
    let mut exhibits = Vec::new();
    for clause in ledger::clauses().filter(|clause| ["BRICKS-5", "BRICKS-6"].contains(&clause.id)) {
        for check in clause.checks.iter().filter(|check| check.expected() == Verdict::Refuted) {
            let decision = check.decide(&mut memory, &mut unwatched).expect("registered checks fit");
            match decision.counterexample.map(|evidence| evidence.seen) {
                Some(Seen::Agents(course)) => exhibits.push(written_down(clause.id, &course)),
                other => panic!("no run of agents: {other:?}"),
            }
        }
    }
    exhibits
}

#[test]
fn what_refutes_a_clause_is_accepted_and_with_one_change_is_not() {
    let mut rounds = 0;
    for exhibit in exhibits() {
        assert_eq!(judge(&exhibit), Ok(Judgement::Broken), "{exhibit:?}");
        rounds += usize::from(exhibit.round > 0);
        let rejects = |change: &dyn Fn(&mut Exhibit), what: &str| {
            let mut changed = exhibit.clone();
            change(&mut changed);
            assert!(judge(&changed) != Ok(Judgement::Broken), "{what} is accepted: {changed:?}");
        };
        let last = exhibit.turns.len() - 1;
        // Of a round that is gone twice, a part is a round, too.
        let is_round =
            exhibit.round > 0 && exhibit.turns[last - 1].to == exhibit.turns[last - 1 - exhibit.round].to;
        if !is_round {
            rejects(&|changed| changed.turns.truncate(last), "a run that is cut");
        }
        rejects(&|changed| changed.round = changed.turns.len() + 1, "a longer round than the run");
        rejects(&|changed| changed.turns[last].agent = 7, "nobody");
        rejects(&|changed| changed.turns[0].to = (9, 9), "a step out of the layout");
        rejects(&|changed| changed.turns[0].is_done = true, "an agent that is done too early");
        rejects(&|changed| changed.starts[0] = (-1, 0), "a start outside");
        rejects(&|changed| changed.starts.push((0, 0)), "another agent, which does nothing");
        rejects(&|changed| changed.clause = "BRICKS-2".to_owned(), "a clause about marks");
        if exhibit.round == 0 {
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
    let exhibit = |turns: &[Turn]| Exhibit {
        clause: "BRICKS-4".to_owned(),
        width: 3,
        height: 1,
        walls: BTreeSet::new(),
        blocked: BTreeSet::new(),
        starts: vec![(0, 0)],
        turns: turns.to_vec(),
        round: 0,
    };
    let early = [turn((1, 0), false), turn((1, 0), true)];
    assert_eq!(judge(&exhibit(&early)), Ok(Judgement::Broken));
    let late = [turn((1, 0), false), turn((2, 0), false), turn((2, 0), true)];
    assert_eq!(
        judge(&exhibit(&late)),
        Ok(Judgement::Unseen),
        "what is left to go through is a matter of marks"
    );
    assert!(judge(&exhibit(&late[..2])).is_err(), "nobody is done");
    let mut cut_off = exhibit(&early);
    cut_off.walls.insert(((1, 0), (2, 0)));
    assert_eq!(judge(&cut_off), Ok(Judgement::Unseen), "the third cell is not connected");
    let through = [turn((2, 0), false), turn((2, 0), true)];
    assert!(judge(&exhibit(&through)).is_err(), "two cells in one turn");
}
