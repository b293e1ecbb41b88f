//! Every rule comes out as it is registered, and the page says so.

#[path = "common/model.rs"]
mod model;

mod bad_input;
mod counts;
mod hunts;
mod spilled;

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::{env, fs};

use tautline_library::{Entry, RULES, page};
use tautline_proofs::clause::Clause;
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::ledger::{self, Hear, Limits, News, Row};

/// The rules with their rows, as they are registered.
fn decided(clauses: fn(&'static Entry) -> Vec<&'static Clause>) -> Vec<(&'static Entry, Vec<Row>)> {
    let all: Vec<_> = RULES.iter().flat_map(|&entry| clauses(entry)).collect();
    // Larger bounds take as much memory as there is.
    let limits = Limits { memory: Arc::new(MemoryLimit::unbounded()), ..Limits::default() };
    let hear: Hear = Arc::new(|_: News<'_>| ControlFlow::Continue(()));
    let rows = ledger::decide(&ledger::checks(&all), &limits, &hear).expect("they can be decided");
    let mut rows = rows.into_iter().peekable();
    let of = |row: &Row, entry: &'static Entry| {
        clauses(entry).iter().any(|&clause| std::ptr::eq(clause, row.clause))
    };
    let by_entry = |&entry: &&'static Entry| {
        let mut own = Vec::new();
        while let Some(row) = rows.next_if(|row| of(row, entry)) {
            own.push(row);
        }
        (entry, own)
    };
    let all: Vec<_> = RULES.iter().map(by_entry).collect();
    let rows = all.iter().flat_map(|(_, rows)| rows);
    let mut wrong = Vec::new();
    for row in rows {
        let (id, rule, found) = (row.clause.id, row.check.rule(), &row.decision);
        eprintln!("{id} {rule}: {:?}, {} states, {:.1} s", found.verdict, found.cases, row.seconds);
        if !row.is_as_registered() {
            wrong.push(format!("{id} {rule}: {found:#?} {:?}", row.undecided));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    all
}

#[test]
fn every_rule_comes_out_as_it_is_registered_and_the_page_says_so() {
    let all = decided(|entry| entry.clauses().collect());
    let (path, page) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/library.md"), page(&all));
    if env::var("LIBRARY_UPDATE").is_ok_and(|value| value == "always") {
        fs::write(&path, &page).expect("a page");
    }
    assert_eq!(fs::read_to_string(path).expect("a page"), page, "renew it with LIBRARY_UPDATE=always");
}

/// `cargo test -p tautline-library -- --ignored`: a minute, and gigabytes of memory.
#[test]
#[ignore = "it takes a minute"]
fn every_rule_comes_out_as_it_is_registered_within_larger_bounds() {
    decided(|entry| entry.larger().collect());
}
