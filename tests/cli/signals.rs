//! A signal ends the work: what is known by then is printed, what is not is said, and the exit code is 3.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;

use super::{files, folder, names, ran, says, tautline};

/// Far more threads than work takes, so that what is quick is not behind what is slow.
const THREADS: &str = "16";

/// The output of a command that gets a Ctrl-C when it has said `words` in so many lines of its log. Nothing depends on
/// how fast it is, as long as it has more to do than takes a machine a second or two.
fn ended(folder: &Path, arguments: &[&str], said: (&str, usize)) -> Output {
    ended_by(|child| files::send("-INT", child), folder, arguments, said)
}

/// As [`ended`], by other signals.
fn ended_by(
    send: impl FnOnce(&Child),
    folder: &Path,
    arguments: &[&str],
    (words, times): (&str, usize),
) -> Output {
    let mut command = tautline(folder, &[LOG, arguments].concat());
    command.env("RAYON_NUM_THREADS", THREADS).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program runs");
    let mut log = BufReader::new(child.stderr.take().expect("a pipe")).lines().map_while(Result::ok);
    let said = log.by_ref().filter(|line| line.contains(words)).take(times).count();
    send(&child);
    // It waits for whoever reads its log.
    let rest = std::thread::spawn(move || log.collect::<Vec<_>>().join("\n"));
    let output = child.wait_with_output().expect("it ends");
    let rest = rest.join().expect("lines");
    assert_eq!((said, output.status.code()), (times, Some(3)), "{arguments:?}: {rest}");
    output
}

/// The option that has all of the log written.
const LOG: &[&str] = &["-vv"];

fn told(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("text")
}

fn value(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A clause that is decided at once.
const QUICK: &str = "NOTICE-4";

/// Clauses that take long: in a test build, half a minute and more. They have fewer checks than there are threads, so
/// that the quick one waits for none of them.
const LONG: [&str; 3] = ["MRC-1", "ANTS-1", "BRICKS-11"];

#[test]
fn checks_that_are_decided_are_told_and_the_others_counted() {
    let folder = &folder();
    // All of its checks, and of its mutants.
    let words = format!("the last of {QUICK}");
    let alone = ran(folder, &[LOG, &["prove", QUICK]].concat());
    let jobs = String::from_utf8_lossy(&alone.stderr).lines().filter(|line| line.contains(&words)).count();
    assert!(jobs > 0, "{alone:?}");
    let clauses = [&["prove", QUICK][..], &LONG].concat();
    let text = told(&ended(folder, &clauses, (&words, jobs)));
    says(&text, &["NOTICE-4  published", "A signal ended the work: "]);
    let json = value(&ended(folder, &[&clauses[..], &["--format", "json"]].concat(), (&words, jobs)));
    let clauses = json["clauses"].as_array().expect("a list");
    assert!(clauses.iter().filter(|row| row["id"] == QUICK).count() == 2, "{json}");
    assert_eq!((&json["complete"], &json["as_registered"]), (&false.into(), &false.into()));
    assert!(json["left"].as_u64() > Some(0), "{json}");
}

#[test]
fn no_folder_stays_that_was_made_for_nothing() {
    let folder = &folder();
    let files = ["--out", "found/deep", "--certificate", "proofs"];
    ended(folder, &[&["prove"][..], &LONG, &files].concat(), ("proving: ", 1));
    // A counterexample may be found by then, or a check hold.
    for found in names(folder) {
        assert!(["found", "proofs"].contains(&found.as_str()), "{found}");
        let files = if found == "found" { "found/deep" } else { "proofs" };
        assert!(!names(&folder.join(files)).is_empty(), "{files}");
    }
}

#[test]
fn random_runs_of_the_library_end_with_the_checks_that_they_were_made_for() {
    let folder = &folder();
    assert_eq!(value(&ended(folder, &RUNS, ("hunting: ", 1)))["complete"], false);
}

/// Random runs without end.
const RUNS: [&str; 7] = ["library", "pibt", "--larger", "--runs", "9999999999", "--format", "json"];

/// `timeout` sends a signal to the process, and to the group in which it is.
#[test]
fn a_signal_that_comes_twice_at_once_is_one() {
    let folder = &folder();
    let twice = |child: &Child| {
        let kill = ["-c", "kill -TERM $0; kill -TERM $0", &child.id().to_string()];
        assert!(Command::new("sh").args(kill).status().is_ok_and(|status| status.success()));
    };
    for _ in 0..5 {
        assert_eq!(value(&ended_by(twice, folder, &RUNS, ("hunting: ", 1)))["complete"], false);
    }
}

/// Whether a campaign that was ended when its log says that so many parts are `begun`, and with them the first,
/// prints what one of as many runs prints, which `smaller` makes of its output.
fn comes_out_as(arguments: &[&str], begun: &str, smaller: impl Fn(&Value) -> [String; 2]) {
    let folder = &folder();
    let json = ["--format", "json"];
    let mut part = value(&ended(folder, &[arguments, &json].concat(), (begun, 1)));
    assert_eq!(part["complete"], false);
    let smaller = smaller(&part);
    let smaller =
        [&arguments[..arguments.len() - 2], &smaller.each_ref().map(String::as_str), &json].concat();
    part["complete"] = true.into();
    assert_eq!(part, value(&ran(folder, &smaller)));
}

#[test]
fn rescues_up_to_the_first_that_was_not_made_come_out_as_fewer_do() {
    comes_out_as(&["rescue", "--nodes", "100", "--seeds", "0..999999"], ": 256 of ", |part| {
        ["--seeds".to_owned(), format!("0..{}", part["seeds"][1])]
    });
}

#[test]
fn trials_up_to_the_first_that_was_not_made_come_out_as_fewer_do() {
    comes_out_as(&["locate", "--solver", "pso", "--runs", "1000000"], ": 16 of ", |part| {
        ["--runs".to_owned(), part["trials"].to_string()]
    });
}

/// The log has this line when a part of a table is done.
const BEGUN_TABLE: (&str, usize) = (": 1 of ", 1);

#[test]
fn of_a_part_of_a_table_no_figure_is_claimed() {
    let folder = &folder();
    let table = ["reproduce", "notice-fig5", "--runs", "100000", "--csv", "values.csv"];
    let text = told(&ended(folder, &table, BEGUN_TABLE));
    assert!(text.contains("of a part no figure is claimed"), "{text}");
    let json = value(&ended(folder, &[&table[..], &["--format", "json"]].concat(), BEGUN_TABLE));
    assert_eq!((&json["id"], &json["complete"]), (&"notice-fig5".into(), &false.into()));
    assert!(json["parts_done"].as_u64() < json["parts"].as_u64(), "{json}");
    assert_eq!(names(folder), [""; 0]);
    let schema = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/schemas/reproduce-interrupted.json");
    assert!(fs::read_to_string(schema).is_ok_and(|schema| schema.contains("parts_done")));
}
