//! Each stored refutation that a judge of a scheme reads is accepted, and attacked: every single change of it is
//! refused, or leaves another counterexample by right. Chains have tests of their own.

use std::fmt::Write;

use crate::refuted::{Refutation, of};

/// Whether a clause has a judge in the file of its scheme, or is tried elsewhere.
fn is_here(clause: &str) -> bool {
    !clause.starts_with("CHAIN-")
}

#[test]
fn every_refutation_is_judged_and_no_single_change_of_it_passes_unnoticed() {
    let mut table = "clause       rule       engine      changes refused\n".to_owned();
    let mut unjudged = Vec::new();
    let (mut refutations, mut tried, mut by_right) = (0, 0, 0);
    for Refutation { clause, check, found } in of(is_here) {
        let Some(case) = check.case(&found.choices) else {
            unjudged.push(format!("{} {} {}", clause.id, check.rule(), check.engine()));
            continue;
        };
        assert_eq!(case.clause(), clause.id);
        assert_eq!(case.judge(), Ok(()), "{case:#?}");
        let changes = case.changes();
        let right: Vec<&str> = changes
            .iter()
            .filter(|(_, changed)| changed.judge().is_ok())
            .map(|(what, _)| what.as_str())
            .collect();
        (refutations, tried, by_right) = (refutations + 1, tried + changes.len(), by_right + right.len());
        let (all, refused) = (changes.len(), changes.len() - right.len());
        let (rule, engine) = (check.rule(), check.engine());
        writeln!(table, "{:<12} {rule:<10} {engine:<10} {all:8} {refused:7}", clause.id).expect("text");
        for what in right {
            writeln!(table, "             by right: {what}").expect("text");
        }
    }
    let refused = tried - by_right;
    writeln!(table, "{refutations} refutations, {tried} changes: {refused} refused, {by_right} by right")
        .expect("text");
    writeln!(table, "not judged: {}", unjudged.join(", ")).expect("text");
    insta::assert_snapshot!(table);
}
