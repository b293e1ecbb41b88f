//! The sentences that the page has are those of the ledger.

use std::fmt::Write;
use std::{env, fs};

use tautline_proofs::ledger;

#[test]
fn the_sentences_are_those_of_the_ledger() {
    let mut all = String::new();
    for clause in ledger::clauses() {
        writeln!(all, "{}\t{}", clause.id, clause.sentence).expect("a string");
    }
    if env::var_os("TAUTLINE_RENEW").is_some() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/clauses.txt");
        fs::write(path, &all).expect("a file");
    }
    let of_the_page = include_str!("../src/clauses.txt");
    assert!(all == of_the_page, "renew it: TAUTLINE_RENEW=1 cargo test -p tautline-web");
}
