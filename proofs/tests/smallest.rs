//! The smallest counterexamples over areas, barriers, robots and starts, or over networks, each with a certificate of
//! all that is smaller, which was exhausted; and whether the ledger has them.

use std::fmt::Write;

use tautline_proofs::plural::counted;

use crate::refuted::{Refutation, of};

/// The refuted checks of which smaller counterexamples can be asked for.
fn table(is_wanted: impl Fn(&Refutation) -> bool) -> String {
    let mut table = String::new();
    for Refutation { clause, check, found } in of(|_| true).filter(|refuted| is_wanted(refuted)) {
        let Some(made) = check.smallest().expect("registered checks fit") else { continue };
        assert!(made.is_whole, "{} was cut off", clause.id);
        let (class, moves) = check.size(&found.choices).expect("it has a size");
        let smallest = made.smallest.as_ref().map(|one| (one.class.clone(), one.moves));
        let (id, rule, size) = (clause.id, check.rule(), made.size());
        writeln!(table, "{id} {rule}: {size}").expect("text");
        if smallest != Some((class.clone(), moves)) {
            writeln!(table, "  in the ledger: {class}, {}", counted(moves, "move")).expect("text");
        }
        for (class, cases) in &made.exhausted {
            writeln!(table, "  none in {class}: {cases}").expect("text");
        }
    }
    table
}

/// Those that take minutes: that of contact at nodes looks at 22 million states.
fn is_long(refuted: &Refutation) -> bool {
    let ids = ["CHAIN-14", "BRICKS-", "KIT-2"];
    ids.iter().any(|long| refuted.clause.id.starts_with(long))
        || refuted.check.bound().contains("where both stand")
}

#[test]
fn nothing_is_smaller_than_the_smallest_counterexamples() {
    insta::assert_snapshot!(table(|refuted| !is_long(refuted)));
}

#[test]
#[ignore = "takes minutes: cargo test --release -p tautline-proofs --test all \
            -- --ignored nothing_is_smaller_than_those"]
fn nothing_is_smaller_than_those_that_take_long() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/smallest.md");
    let (page, table) = (std::fs::read_to_string(page).expect("the page"), table(is_long));
    assert!(page.contains(&table), "docs/smallest.md shows another table:\n{table}");
}
