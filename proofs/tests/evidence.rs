//! Choices refute a clause as they were found, and no others do.

use tautline_proofs::decide::RefutationPlay;
use tautline_proofs::engine::{Choices, ScriptError};

use crate::refuted::{Refutation, of};

/// The refuted checks that take no long time.
fn short() -> impl Iterator<Item = &'static Refutation> {
    let short = ["CHAIN-14", "BRICKS-5", "BRICKS-6", "NOTICE-4", "NOTICE-5", "MRC-2"];
    of(move |id| short.contains(&id))
}

#[test]
fn other_choices_refute_something_or_are_refused() {
    for Refutation { check, found: evidence, .. } in short() {
        let choices = evidence.choices.clone();
        let RefutationPlay { of: options, evidence: again } = check.replay(&choices).expect("what was found");
        assert_eq!((again.choices.clone(), again.demand), (choices.clone(), evidence.demand));
        let all = choices.once.len() + choices.again.len();
        assert_eq!(options.len(), all);
        for (at, &of) in options.iter().enumerate() {
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
    for Refutation { check, found: evidence, .. } in short() {
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
