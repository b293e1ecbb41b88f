//! A signal ends the work: what is known by then is printed, what is not is said, and the exit code is 3.

use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};
use std::time::Duration;

use serde_json::Value;

use super::{files, folder, names, ran, says, tautline};

/// Far more threads than work takes, so that what is quick is not behind what is slow.
const THREADS: &str = "16";

/// The output of a command that gets a Ctrl-C after so many seconds.
fn ended(folder: &Path, arguments: &[&str], seconds: u64) -> Output {
    let mut command = tautline(folder, arguments);
    command.env("RAYON_NUM_THREADS", THREADS).stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().expect("the program runs");
    std::thread::sleep(Duration::from_secs(seconds));
    files::send("-INT", &child);
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(3), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

fn told(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("text")
}

fn value(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// One clause that is decided at once, and one that takes long.
const CLAUSES: [&str; 3] = ["prove", "NOTICE-4", "MRC-1"];

#[test]
fn checks_that_are_decided_are_told_and_the_others_counted() {
    let folder = &folder();
    says(&told(&ended(folder, &CLAUSES, 4)), &["NOTICE-4  published", "A signal ended the work: "]);
    let json = value(&ended(folder, &[&CLAUSES[..], &["--format", "json"]].concat(), 4));
    let clauses = json["clauses"].as_array().expect("a list");
    assert!(clauses.iter().filter(|row| row["id"] == "NOTICE-4").count() == 2, "{json}");
    assert_eq!((&json["complete"], &json["as_registered"]), (&false.into(), &false.into()));
    assert!(json["left"].as_u64() > Some(0), "{json}");
}

#[test]
fn no_folder_stays_that_was_made_for_nothing() {
    let folder = &folder();
    ended(folder, &["prove", "MRC-1", "--out", "found/deep", "--certificate", "proofs"], 2);
    // A counterexample may be found by then.
    match names(folder)[..] {
        [] => {}
        [ref found] => assert!(found == "found" && !names(&folder.join("found/deep")).is_empty()),
        ref others => panic!("{others:?}"),
    }
}

#[test]
fn random_runs_of_the_library_end_with_the_checks_that_they_were_made_for() {
    let folder = &folder();
    let runs = ["library", "pibt", "--larger", "--runs", "9999999999", "--format", "json"];
    assert_eq!(value(&ended(folder, &runs, 2))["complete"], false);
}

/// Whether a campaign that was ended prints what one of as many runs prints, which `smaller` makes of its output.
fn comes_out_as(arguments: &[&str], seconds: u64, smaller: impl Fn(&Value) -> [String; 2]) {
    let folder = &folder();
    let json = ["--format", "json"];
    let mut part = value(&ended(folder, &[arguments, &json].concat(), seconds));
    assert_eq!(part["complete"], false);
    let smaller = smaller(&part);
    let smaller =
        [&arguments[..arguments.len() - 2], &smaller.each_ref().map(String::as_str), &json].concat();
    part["complete"] = true.into();
    assert_eq!(part, value(&ran(folder, &smaller)));
}

#[test]
fn rescues_up_to_the_first_that_was_not_made_come_out_as_fewer_do() {
    comes_out_as(&["rescue", "--nodes", "100", "--seeds", "0..999999"], 4, |part| {
        ["--seeds".to_owned(), format!("0..{}", part["seeds"][1])]
    });
}

#[test]
fn trials_up_to_the_first_that_was_not_made_come_out_as_fewer_do() {
    comes_out_as(&["locate", "--solver", "pso", "--runs", "1000000"], 4, |part| {
        ["--runs".to_owned(), part["trials"].to_string()]
    });
}

#[test]
fn of_a_part_of_a_table_no_figure_is_claimed() {
    let folder = &folder();
    let table = ["reproduce", "notice-fig5", "--runs", "100000", "--csv", "values.csv"];
    says(&told(&ended(folder, &table, 2)), &["of a part no figure is claimed"]);
    let json = value(&ended(folder, &[&table[..], &["--format", "json"]].concat(), 2));
    assert_eq!((&json["id"], &json["complete"]), (&"notice-fig5".into(), &false.into()));
    assert!(json["parts_done"].as_u64() < json["parts"].as_u64(), "{json}");
    assert_eq!(names(folder), [""; 0]);
    let schema = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/schemas/reproduce-interrupted.json");
    assert!(fs::read_to_string(schema).is_ok_and(|schema| schema.contains("parts_done")));
}
