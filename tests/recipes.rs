//! The scripts that people copy: those of docs/recipes, and the steps of the action.
#![cfg(unix)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const TAUTLINE: &str = env!("CARGO_BIN_EXE_tautline");

const HUNT: [&str; 7] = ["hunt", "--rule", "published", "--robots", "3", "--max-walls", "2"];

fn recipe(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn ran(folder: &Path, program: impl AsRef<Path>, arguments: &[&str]) -> Output {
    let mut command = Command::new(program.as_ref());
    command.current_dir(folder).args(arguments).env("TAUTLINE", TAUTLINE).env("OUT", folder.join("out"));
    command.output().expect("it runs")
}

/// Whether a program is at hand and works; if not, that is said.
fn has(program: &str, argument: &str) -> bool {
    let works = Command::new(program).arg(argument).output().is_ok_and(|output| output.status.success());
    if !works {
        eprintln!("skipped: there is no {program} here that works");
    }
    works
}

/// A folder with a plan of four shards, and what one process prints.
fn planned() -> (tempfile::TempDir, Vec<u8>) {
    let folder = tempfile::tempdir().expect("a folder");
    let one = tempfile::tempdir().expect("a folder");
    let whole = ran(one.path(), TAUTLINE, &HUNT).stdout;
    let plan = [&HUNT[..], &["--plan", "plan.json", "--shards", "4"]].concat();
    assert_eq!(ran(folder.path(), TAUTLINE, &plan).status.code(), Some(0));
    (folder, whole)
}

#[test]
fn gnu_parallel_runs_all_shards() {
    if !has("parallel", "--version") {
        return;
    }
    let (folder, whole) = planned();
    let output = ran(folder.path(), recipe("docs/recipes/parallel.sh"), &["hunt", "plan.json", "4"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.ends_with(&*String::from_utf8_lossy(&whole)), "{said}");
}

/// Where a Slurm answers, which is rare on a machine of one's own.
#[test]
fn an_array_of_slurm_runs_all_shards() {
    if !has("sinfo", "--noheader") {
        return;
    }
    let (folder, whole) = planned();
    let script = recipe("docs/recipes/slurm.sh");
    let script = script.to_str().expect("text");
    let array = ["--wait", "--array=1-4", script, "hunt", "plan.json"];
    assert!(ran(folder.path(), "sbatch", &array).status.success());
    let merged = ran(folder.path(), TAUTLINE, &["merge", "plan.json"]);
    assert_eq!((merged.status.code(), merged.stdout), (Some(1), whole));
}

#[test]
fn the_action_keeps_a_page_of_each_counterexample_and_ends_as_its_command() {
    let folder = tempfile::tempdir().expect("a folder");
    let hunt = [&[TAUTLINE], &HUNT[..], &["--format", "github", "--out", "out"]].concat();
    let output = ran(folder.path(), recipe(".github/action.sh"), &hunt);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.lines().any(|line| line.starts_with("::error title=")), "{said}");
    let entries = fs::read_dir(folder.path().join("out")).expect("a folder");
    let mut names: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
    names.sort();
    let runs: Vec<&PathBuf> =
        names.iter().filter(|name| name.extension().is_some_and(|end| end == "jsonl")).collect();
    assert!(!runs.is_empty());
    for run in runs {
        let page = fs::read_to_string(run.with_extension("html")).expect("a page");
        assert!(page.starts_with("<!doctype html>"));
        assert!(run.with_extension("txt").exists());
    }
    let small = [TAUTLINE, "hunt", "--robots", "3", "--max-walls", "1", "--out", "out"];
    assert_eq!(ran(folder.path(), recipe(".github/action.sh"), &small).status.code(), Some(0));
}

#[test]
fn the_recipes_that_are_not_run_can_be_read() {
    for script in ["docs/recipes/hyperqueue.sh", "docs/recipes/slurm.sh", "docs/recipes/parallel.sh"] {
        let output = Command::new("bash").arg("-n").arg(recipe(script)).output().expect("bash runs");
        assert!(output.status.success(), "{script}: {}", String::from_utf8_lossy(&output.stderr));
    }
    let one = |file: &str, key| (recipe(file), key);
    let workflows = fs::read_dir(recipe(".github/workflows")).expect("a folder");
    let workflows = workflows.map(|entry| (entry.expect("a file").path(), "jobs"));
    let files = [
        one("docs/recipes/kubernetes.yaml", "spec"),
        one("docs/recipes/workflow.yml", "jobs"),
        one("action.yml", "runs"),
    ];
    for (file, key) in files.into_iter().chain(workflows) {
        let text = fs::read_to_string(&file).expect("text");
        let file = file.display();
        let read: serde_json::Value =
            serde_saphyr::from_str(&text).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(read[key].is_object(), "{file}");
    }
}
