//! Other people's rules on the command line.

use std::fs;

use insta::assert_snapshot;

use super::{folder, json, printed, ran, refused};

#[test]
fn the_library_is_listed_with_what_comes_out() {
    assert_snapshot!("library_list", printed(folder().path(), &["library"], 0));
}

#[test]
fn a_rule_of_the_library_is_decided_stored_and_played_again() {
    let folder = folder();
    let told = printed(folder.path(), &["library", "rmf-lane", "--out", "found"], 0);
    assert_snapshot!("library_rule", told);
    let stored = "found/lane-2-before-the-pull-request-states.jsonl";
    let played = printed(folder.path(), &["replay", stored], 1);
    let story =
        told.lines().skip_while(|line| !line.starts_with("start")).take_while(|line| !line.is_empty());
    for line in story {
        assert!(played.contains(line), "{line}\n{played}");
    }
    let text = fs::read_to_string(folder.path().join(stored)).expect("a file");
    let other = text.replace("\"taken\":0", "\"taken\":1");
    fs::write(folder.path().join(stored), other).expect("a file");
    assert_eq!(ran(folder.path(), &["replay", stored]).status.code(), Some(2));
    let ledger = json(folder.path(), &["library", "rmf-lane", "RMF-SWAP"], 0);
    assert_eq!(
        (ledger["as_registered"].as_bool(), ledger["clauses"].as_array().map(Vec::len)),
        (Some(true), Some(8))
    );
}

#[test]
fn a_wrong_name_and_options_without_effect_are_refused() {
    let folder = folder();
    for (name, arguments) in [
        ("library_unknown", &["library", "pbit"][..]),
        ("library_no_larger", &["library", "rmf-lane", "--larger"]),
        ("library_lists", &["library", "--format", "json"]),
    ] {
        assert_snapshot!(name, refused(folder.path(), arguments));
    }
}
