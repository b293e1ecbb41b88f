//! Choices refute a clause as they were found, and no others do.

use tautline_proofs::clause::AnyCheck;
use tautline_proofs::decide::{Cache, Evidence, RefutationPlay, Verdict};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::engine::{Choices, ScriptError};
use tautline_proofs::ledger;

/// The evidence of the checks that are registered as refuted and take no long time.
fn refuted() -> Vec<(&'static dyn AnyCheck, Evidence)> {
    let mut memory = Cache::default();
    let is_short =
        |id: &str| ["CHAIN-14", "BRICKS-5", "BRICKS-6", "NOTICE-4", "NOTICE-5", "MRC-2"].contains(&id);
    let clauses = ledger::clauses().filter(|clause| is_short(clause.id));
    let checks = clauses.flat_map(|clause| clause.checks.iter().copied());
    let decide = |check: &'static dyn AnyCheck| {
        let decision = check.decide(&mut memory, &mut unwatched).expect("registered checks fit");
        (check, decision.counterexample.expect("a counterexample"))
    };
    checks.filter(|check| check.expected() == Verdict::Refuted).map(decide).collect()
}

#[test]
fn other_choices_refute_something_or_are_refused() {
    for (check, evidence) in refuted() {
        let choices = evidence.choices.clone();
        let RefutationPlay { of, evidence: again } = check.replay(&choices).expect("what was found");
        assert_eq!((again.choices.clone(), again.demand), (choices.clone(), evidence.demand));
        let all = choices.once.len() + choices.again.len();
        assert_eq!(of.len(), all);
        for (at, &of) in of.iter().enumerate() {
            let other = |value: u32| {
                let mut other = choices.clone();
                *other.once.iter_mut().chain(&mut other.again).nth(at).expect("a choice") = value;
                check.replay(&other).map(|played| played.evidence.choices.clone() == other)
            };
            assert_eq!(other(of).map_err(ScriptError::at), Err(Some(at)), "a choice that there is not");
            let near = [(other(0), 0), (other(of - 1), of - 1)];
            for (replayed, value) in near {
                assert_ne!(replayed, Ok(false), "choice {at}, {value}: it is played as another");
            }
        }
    }
}

#[test]
fn choices_that_are_cut_or_go_on_are_refused() {
    for (check, evidence) in refuted() {
        let choices = evidence.choices.clone();
        for left in 0..choices.once.len() {
            let cut = Choices { once: choices.once[..left].to_vec(), ..choices.clone() };
            assert!(check.replay(&cut).is_err(), "{evidence:?} cut behind {left}");
        }
        // Who goes round for ever may go a part of the way more before it counts.
        let mut longer = choices.clone();
        longer.once.push(0);
        let is_round = !choices.again.is_empty();
        assert!(check.replay(&longer).is_err() || is_round, "{evidence:?} goes on");
        let mut round = choices.clone();
        round.again.push(0);
        assert!(check.replay(&round).is_err(), "{evidence:?} goes round farther");
    }
}
