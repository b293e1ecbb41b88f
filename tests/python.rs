//! The figures with which the tests of the Python package compare are those that the program prints.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

#[test]
fn the_figures_of_the_python_tests_are_those_of_the_program() {
    let figures = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/tests/figures/explore.jsonl");
    let figures = std::fs::read_to_string(figures).expect("the figures");
    assert!(figures.lines().count() >= 5);
    for line in figures.split_inclusive('\n') {
        let kept: Value = serde_json::from_str(line).expect("JSON");
        let word = |name: &str| kept[name].as_str().expect("a word").to_owned();
        let number = |name: &str| kept[name].to_string();
        let mut program = Command::new(env!("CARGO_BIN_EXE_tautline"));
        program.args(["explore", &word("layout"), "--scheme", &word("scheme"), "--rule", &word("rule")]);
        program.args(["--robots", &number("robots"), "--format", "json"]);
        if kept["seed"] != 0 {
            program.args(["--seed", &number("seed")]);
        }
        let output = program.output().expect("the program runs");
        assert_eq!(String::from_utf8_lossy(&output.stdout), line);
    }
}
