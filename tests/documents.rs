//! SPEC.md and the README say what the code says: the clauses' sentences, the ledger and the pictures.

use std::fs;
use std::path::Path;
use std::process::Command;

use insta::assert_snapshot;
use tautline_proofs::ledger;

fn document(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect("a document")
}

/// What the program prints in the project's folder, if it ends with `code`.
fn printed(arguments: &[&str], code: i32) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_tautline"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .output()
        .expect("the program runs");
    assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn every_clause_stands_in_the_spec_word_for_word() {
    let spec = document("SPEC.md");
    let mut lines = spec.lines();
    let mut stated = Vec::new();
    while let Some(line) = lines.next() {
        if let Some(id) = line.strip_prefix("### ") {
            let sentence = lines.find(|line| !line.is_empty()).expect("a sentence");
            stated.push((id, sentence));
        }
    }
    let registered: Vec<_> = ledger::clauses().map(|clause| (clause.id, clause.sentence)).collect();
    assert_eq!(stated, registered);
}

#[test]
fn the_exit_codes_of_the_readme_are_those_of_the_help() {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let help = printed(&["--help"], 0);
    let codes = help.split("\n\n").find(|part| part.starts_with("Exit codes:")).expect("exit codes");
    assert!(
        words(&document("README.md")).contains(&words(codes)),
        "the README has other exit codes:\n{codes}"
    );
}

#[test]
fn the_ledger_and_the_chart_are_those_of_the_readme() {
    let (readme, all) = (document("README.md"), printed(&["prove"], 0));
    let (ledger, stories) = all.split_once("\n\n").expect("a ledger, then counterexamples");
    for line in ledger.lines() {
        assert!(line.chars().count() <= 80, "wider than 80 columns: {line}");
    }
    assert_snapshot!("ledger", ledger);
    assert!(readme.contains(ledger), "the README shows another ledger:\n{ledger}");
    let (_, of_mrc_1) = stories.split_once("MRC-1 as published").expect("it is refuted");
    let (_, chart) = of_mrc_1.split_once("events.\n\n").expect("a chart");
    let (chart, _) = chart.split_once("\n\nMRC-2 as").expect("the next story");
    assert!(readme.contains(chart.trim_end()), "the README shows another chart:\n{chart}");
}

#[test]
fn the_atlas_is_that_of_the_readme() {
    let atlas = printed(&["reproduce", "atlas"], 0);
    assert_snapshot!("atlas", atlas);
    let (table, _) = atlas.split_once("\n\nlayouts:").expect("a table, then what it means");
    assert!(document("README.md").contains(table), "the README shows another atlas:\n{table}");
}

#[test]
fn the_distance_from_the_optimum_is_that_of_the_readme() {
    let table = printed(&["reproduce", "optimum"], 0);
    assert!(document("README.md").contains(&table), "the README shows another table:\n{table}");
}

#[test]
fn the_reach_of_broadcasts_is_that_of_the_readme() {
    let table = printed(&["reproduce", "notice-fig5"], 0);
    assert!(document("README.md").contains(&table), "the README shows another table:\n{table}");
}

#[test]
fn the_ways_of_robots_are_those_of_the_readme() {
    let table = printed(&["reproduce", "rescue-fig7"], 0);
    assert!(document("README.md").contains(&table), "the README shows another table:\n{table}");
}

#[test]
fn a_thousand_rescues_are_those_of_the_readme() {
    let rescues =
        ["rescue", "--wfr", "3", "--robots", "3", "--loss", "0.1", "--failing", "1", "--seeds", "0..999"];
    let table = printed(&rescues, 0);
    assert!(document("README.md").contains(&table), "the README shows another table:\n{table}");
}

#[test]
fn the_pictures_of_the_readme_are_drawn_by_the_commands_beside_them() {
    let readme = document("README.md");
    let folder = tempfile::tempdir().expect("a folder");
    for (picture, arguments, code) in [
        ("environments.svg", "show environments --svg", 0),
        ("move.svg", "replay docs/open-7x7.jsonl --moves 5..5 --svg", 0),
        ("spiral.svg", "explore open:15x15 --robots 8 --draw order --svg", 0),
        ("notice-reach.svg", "reproduce notice-fig5 --svg-reach", 0),
        ("notice-rebroadcasts.svg", "reproduce notice-fig5 --svg-rebroadcasts", 0),
        ("walked.svg", "reproduce rescue-fig7 --svg", 0),
        ("ways.svg", "reproduce rescue-fig6 --svg", 0),
        ("lakes.svg", "reproduce rescue-fig10 --svg", 0),
        ("rescue.svg", "reproduce rescue-fig8 --svg", 0),
        ("crowding.svg", "replay docs/chain-2-published-n4.jsonl --svg", 1),
        ("dear.svg", "replay docs/chain-12-published-n47.jsonl --svg", 1),
        ("trap.svg", "replay docs/bricks-4-repaired-n1.jsonl --moves 1..5 --svg", 1),
    ] {
        assert!(readme.contains(&format!("tautline {arguments} docs/{picture}")), "{picture}");
        let drawn = folder.path().join(picture);
        let arguments: Vec<&str> =
            arguments.split(' ').chain([drawn.to_str().expect("a plain name")]).collect();
        printed(&arguments, code);
        let drawn = fs::read_to_string(drawn).expect("a picture");
        assert_eq!(drawn, document(&format!("docs/{picture}")), "{picture}");
    }
    let run = folder.path().join("run");
    printed(&["explore", "open:7x7", "--robots", "4", "--trace", run.to_str().expect("a plain name")], 0);
    assert_eq!(fs::read_to_string(run).expect("a run"), document("docs/open-7x7.jsonl"));
}
