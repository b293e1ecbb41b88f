//! The clauses of our own, as they are registered: each has an id of its own, its checks mutants, and the readings of
//! its paper.

use std::collections::BTreeSet;

use tautline_proofs::ambiguity::PUBLISHED;
use tautline_proofs::clause::{AnyCheck, Clause, Variant};
use tautline_proofs::decide::Verdict;
use tautline_proofs::ledger::{DuplicateClause, clauses, register, rooms, theorems};

fn clause(id: &str) -> &'static Clause {
    clauses().find(|clause| clause.id == id).expect("a clause")
}

#[test]
fn every_id_is_there_once_and_every_check_that_refutes_nothing_has_a_mutant() {
    let rooms: Vec<&[Clause]> = rooms().iter().map(|room| room.clauses).collect();
    for clause in register(&rooms).expect("ids of their own") {
        for check in clause.checks.iter().filter(|check| check.expected() != Verdict::Refuted) {
            let has_mutant = check.variants().iter().any(|variant| variant.reading().is_none());
            assert!(has_mutant, "{}: {check:?} has no mutant", clause.id);
        }
        assert!(clause.sentence.contains("MUST"), "{}", clause.id);
    }
}

#[test]
fn two_clauses_of_one_id_are_refused() {
    assert_eq!(register(&[rooms()[0].clauses, rooms()[0].clauses]).err(), Some(DuplicateClause("LATTICE-1")));
}

#[test]
fn what_is_refuted_is_a_sentence_of_a_paper_or_has_a_reason() {
    for clause in clauses() {
        for check in clause.checks {
            let is_on_purpose = check.expected() == Verdict::Refuted && check.rule() != PUBLISHED;
            assert_eq!(check.reason().is_some(), is_on_purpose, "{}: {check:?}", clause.id);
        }
    }
}

#[test]
fn the_checks_of_a_clause_name_their_rules() {
    let labels = |id: &str| -> Vec<&str> { clause(id).checks.iter().map(|check| check.rule()).collect() };
    let both = ["tree", "helpers"];
    let known = [
        &["published", "repaired", "published", "robust"][..],
        &both,
        &["mdfs", "tree", "careful", "doubting-1", "doubting"],
    ];
    assert_eq!(labels("BRICKS-4"), known.concat());
    let end = [
        &["published", "repaired", "robust", "published", "robust"][..],
        &both,
        &["careful", "careful", "doubting-1", "doubting-1", "doubting", "doubting"],
    ];
    assert_eq!(labels("BRICKS-6"), end.concat());
}

#[test]
fn what_is_sampled_is_never_said_to_hold() {
    for clause in clauses() {
        for check in clause.checks {
            let is_sampled = check.engine() == "sampled";
            let expected = if is_sampled { Verdict::Unrefuted } else { Verdict::Holds };
            assert_eq!(check.shows(), expected, "{}", clause.id);
            let registered = [expected, Verdict::Refuted, Verdict::Open];
            assert!(registered.contains(&check.expected()), "{}: {check:?}", clause.id);
        }
    }
}

#[test]
fn a_bound_names_every_series_that_runs() {
    assert_eq!(
        clause("BRICKS-6").checks[1].bound(),
        "1 agent to 4×4; 1 to 3×3 with walls; 2 to 3×2 with walls; 3 to 3×2; 2 to 3×3; 1 to 4×3, patience 2; \
         2 to 4×2, patience 2, at most 2 acts in a row; reach 4"
    );
}

#[test]
fn a_mutant_is_decided_by_the_search_that_tells_as_much_about_it() {
    let [crowding, contact] = ["CHAIN-2", "CHAIN-3"].map(|id| clause(id).checks);
    let published = |check: &&dyn AnyCheck| {
        let number = check.variants().iter().position(|variant| variant.name() == "as published")?;
        check.family(Some(number)).filter(|_| check.engine() == "search")
    };
    let family = crowding.iter().copied().find_map(|check| published(&check)).expect("a mutant");
    let its_own = contact.iter().filter(|check| check.family(None).as_ref() == Some(&family));
    assert!(its_own.map(|check| check.rule()).eq(["published"]));
}

#[test]
fn the_readings_that_are_decided_are_those_of_the_papers() {
    let readings = |check: &dyn AnyCheck| -> Vec<&str> {
        check.variants().into_iter().filter_map(Variant::reading).map(|(name, _)| name).collect()
    };
    for check in clauses().flat_map(|clause| clause.checks) {
        let Some(paper) = check.paper() else { continue };
        for name in readings(*check) {
            let asked: Vec<&str> = name.split(" + ").collect();
            assert_eq!(paper.reading(&asked).as_deref(), Ok(name), "{check:?}");
        }
    }
    // Some check of each paper has all.
    let has_all = |check: &dyn AnyCheck| {
        let names = readings(check).into_iter().chain([PUBLISHED]).map(str::to_owned);
        let all: BTreeSet<String> = names.collect();
        check.paper().is_some_and(|paper| all == paper.readings().into_iter().collect())
    };
    for scheme in ["CHAIN", "ANTS", "BRICKS", "NOTICE", "MRC", "KIT", "POSITION", "FRONTIER", "PACK"] {
        let of = clauses().filter(|clause| clause.scheme() == scheme).flat_map(|clause| clause.checks);
        assert!(of.into_iter().any(|check| has_all(*check)), "{scheme}");
    }
}

#[test]
fn every_theorem_about_a_clause_is_about_rules_of_its_rows() {
    for theorem in theorems() {
        let clause = clause(&theorem.clause);
        for rule in &theorem.rules {
            assert!(clause.checks.iter().any(|check| check.rule() == *rule), "no row: {theorem:?}");
        }
    }
}
