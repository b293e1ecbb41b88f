//! The scripts that people copy: those of docs/recipes, and the steps of the action.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::folder::{Folder, folder, read, write};

const TAUTLINE: &str = env!("CARGO_BIN_EXE_tautline");

const HUNT: [&str; 7] = ["hunt", "--rule", "published", "--robots", "3", "--max-walls", "2"];

pub(crate) fn recipe(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn ran(folder: &Path, program: impl AsRef<Path>, arguments: &[&str]) -> Output {
    let mut command = Command::new(program.as_ref());
    command.current_dir(folder).args(arguments).env("TAUTLINE", TAUTLINE).env("OUT", folder.join("out"));
    command.output().expect("it runs")
}

/// Whether a program is at hand and works; if not, that is said.
pub(crate) fn has(program: &str, argument: &str) -> bool {
    let works = Command::new(program).arg(argument).output().is_ok_and(|output| output.status.success());
    if !works {
        eprintln!("skipped: there is no {program} here that works");
    }
    works
}

/// A name that a shell would take apart.
const PLAN: &str = "my plan.json";

/// A folder with a plan of four shards, and what one process prints.
fn planned() -> (Folder, Vec<u8>) {
    let whole = ran(&folder(), TAUTLINE, &HUNT).stdout;
    let plan = [&HUNT[..], &["--plan", PLAN, "--shards", "4"]].concat();
    let folder = folder();
    assert_eq!(ran(&folder, TAUTLINE, &plan).status.code(), Some(0));
    (folder, whole)
}

#[test]
fn gnu_parallel_runs_all_shards() {
    if !has("parallel", "--version") {
        return;
    }
    let (folder, whole) = planned();
    let output = ran(&folder, recipe("docs/recipes/parallel.sh"), &["hunt", PLAN, "4"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.ends_with(&*String::from_utf8_lossy(&whole)), "{said}");
}

/// `hq` stands in: it runs what it is given for each task of the array.
#[test]
fn hyperqueue_runs_all_shards() {
    let (folder, whole) = planned();
    let hq = folder.join("hq");
    let tasks = r#"while [ "$1" != -- ]; do shift; done
shift
for task in 1 2 3 4; do HQ_TASK_ID=$task "$@" > /dev/null; done
"#;
    fs::write(&hq, format!("#!/bin/sh\n{tasks}")).expect("a file");
    fs::set_permissions(&hq, fs::Permissions::from_mode(0o755)).expect("a file of ours");
    let path = format!("{}:{}", folder.display(), std::env::var("PATH").unwrap_or_default());
    let mut command = Command::new(recipe("docs/recipes/hyperqueue.sh"));
    command.current_dir(&folder).args(["hunt", PLAN, "4"]).env("TAUTLINE", TAUTLINE).env("PATH", path);
    let output = command.output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), output.stdout), (Some(1), whole), "{said}");
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
    let array = ["--wait", "--array=1-4", script, "hunt", PLAN];
    assert!(ran(&folder, "sbatch", &array).status.success());
    let merged = ran(&folder, TAUTLINE, &["merge", PLAN]);
    assert_eq!((merged.status.code(), merged.stdout), (Some(1), whole));
}

#[test]
fn the_action_keeps_a_page_of_each_counterexample_and_ends_as_its_command() {
    let folder = &folder();
    let hunt = [&[TAUTLINE], &HUNT[..], &["--format", "github", "--out", "out"]].concat();
    let output = ran(folder, recipe(".github/action.sh"), &hunt);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.lines().any(|line| line.starts_with("::error title=")), "{said}");
    let entries = fs::read_dir(folder.join("out")).expect("a folder");
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
    assert_eq!(ran(folder, recipe(".github/action.sh"), &small).status.code(), Some(0));
    let without = Command::new(recipe(".github/action.sh")).arg("true").env_remove("OUT").output();
    let said = String::from_utf8(without.expect("it runs").stderr).expect("text");
    assert!(said.contains("OUT: is to be the folder"), "{said}");
}

/// The shell steps of the action, each as an object with its `run`.
fn shell_steps() -> Vec<serde_json::Value> {
    let action = fs::read_to_string(recipe("action.yml")).expect("text");
    let action: serde_json::Value = serde_saphyr::from_str(&action).expect("YAML");
    let steps = action["runs"]["steps"].as_array().expect("steps").clone();
    steps.into_iter().filter(|step| step["run"].is_string()).collect()
}

/// Runs the action's steps as a runner does, in a caller's folder, the action being in a folder beside it. `rustup`,
/// `cargo` and `curl` stand in: the first two say how they were called, what is built is this program, and there are
/// only the files in `released`.
#[test]
fn the_steps_of_the_action_take_a_release_or_build_with_its_own_toolchain_and_name_what_they_keep_by_its_sources()
 {
    let folder = &folder();
    let at = |name: &str| folder.join(name);
    for name in ["action/.github", "caller", "temp", "stand-ins", "released"] {
        fs::create_dir_all(at(name)).expect("a folder");
    }
    fs::copy(recipe(".github/action.sh"), at("action/.github/action.sh")).expect("a copy");
    let said = r#"echo "${0##*/} $* in $PWD with $RUSTUP_TOOLCHAIN" >> "$RUNNER_TEMP/said""#;
    let built = format!(
        r#"mkdir -p "$RUNNER_TEMP/tautline/bin" && ln -sf {TAUTLINE} "$RUNNER_TEMP/tautline/bin/tautline""#
    );
    let curl = format!(
        r#"for url; do [[ $url != http* ]] || cp "{}/${{url##*/}}" .; done"#,
        at("released").display()
    );
    for (name, does) in [("rustup", [said, "true"]), ("cargo", [said, &built]), ("curl", ["set -e", &curl])] {
        write(&at("stand-ins"), name, format!("#!/usr/bin/env bash\n{}\n", does.join("\n")));
        let marked = Command::new("chmod").arg("+x").arg(at("stand-ins").join(name)).status();
        assert!(marked.expect("chmod runs").success());
    }
    let path = format!("{}:{}", at("stand-ins").display(), std::env::var("PATH").expect("a path"));
    let hunt = "tautline hunt --rule published --robots 3 --max-walls 2 --out \"$OUT\"";
    let run_of = |step: &serde_json::Value, action: &str, asked: &str| {
        let mut command = Command::new("bash");
        command.args(["--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"].as_str().expect("text")]);
        command.current_dir(at("caller")).env("PATH", &path);
        command.env("GITHUB_ACTION_PATH", at("action")).env("GITHUB_OUTPUT", at("temp/output"));
        command.env("RUNNER_TEMP", at("temp")).env("RUNNER_OS", "Linux").env("RUNNER_ARCH", "X64");
        command.env("RUSTUP_TOOLCHAIN", "the caller's").env_remove("TAUTLINE");
        for (name, value) in step["env"].as_object().into_iter().flatten() {
            let value = value.as_str().expect("text");
            let value = value.replace("${{ runner.temp }}", at("temp").to_str().expect("text"));
            let value = value.replace("${{ github.action_ref }}", action);
            command.env(name, value.replace("${{ inputs.run }}", asked));
        }
        command.output().expect("bash runs")
    };
    let run = |step: &serde_json::Value| run_of(step, "main", hunt);
    let [released, key, build, asked] = &shell_steps()[..] else { panic!("four steps of a shell") };

    let takes = |action: &str| {
        write(folder, "temp/output", "");
        let output = run_of(released, action, hunt);
        (output.status.success(), read(folder, "temp/output"))
    };
    let built = (true, String::new());
    // No such release yet, and then one.
    assert_eq!(takes("v1.2.3"), built);
    let pack = "mkdir -p all/bin && touch all/bin/tautline && tar -czf $0 all && sha256sum $0 > SHA256SUMS";
    let archive = "tautline-1.2.3-x86_64-unknown-linux-musl.tar.gz";
    let packed = Command::new("bash").args(["-c", pack, archive]).current_dir(at("released")).status();
    assert!(packed.expect("bash runs").success());
    assert_eq!([takes("main"), takes("v1"), takes("0123abc")], [built.clone(), built.clone(), built]);
    assert!(!at("temp/tautline").exists());
    assert_eq!(takes("v1.2.3"), (true, "here=true\n".to_owned()));
    fs::remove_dir_all(at("temp/tautline")).expect("the released program");
    write(&at("released"), archive, "another one");
    assert_eq!(takes("v1.2.3"), (false, String::new()));
    assert!(!at("temp/tautline").exists());

    let keyed = || {
        write(folder, "temp/output", "");
        let output = run(key);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        read(folder, "temp/output")
    };
    let first = keyed();
    assert!(first.starts_with("key=tautline-Linux-X64-own-"), "{first}");
    fs::create_dir_all(at("action/target")).expect("a folder");
    write(folder, "action/target/built", "");
    assert_eq!(keyed(), first);
    write(folder, "action/main.rs", "");
    let second = keyed();
    assert_ne!(second, first);
    fs::rename(at("action/main.rs"), at("action/other.rs")).expect("a file");
    assert_ne!(keyed(), second);

    assert!(run(build).status.success());
    let said = read(folder, "temp/said");
    let action = fs::canonicalize(at("action")).expect("a folder");
    for (line, begins) in
        said.lines().zip(["rustup toolchain install 1.95 ", "cargo install --locked --path . "])
    {
        assert!(line.starts_with(begins), "{said}");
        assert!(line.ends_with(&format!(" in {} with 1.95", action.display())), "{said}");
    }
    assert_eq!(said.lines().count(), 2, "{said}");

    let output = run(asked);
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(at("temp/counterexamples/chain-13-published-n3.html").exists());
    // As in any step of GitHub, a line that fails is the last one, and a pipe fails with any part of it.
    for (lines, code) in [("false\ntrue", 1), ("false | true", 1), ("true\ntrue", 0)] {
        assert_eq!(run_of(asked, "main", lines).status.code(), Some(code), "{lines}");
    }
}

/// A tag can be moved to another commit, a commit cannot; and a version beside it is what a person reads.
#[test]
fn every_action_is_pinned_by_its_commit() {
    let files = fs::read_dir(recipe(".github/workflows")).expect("a folder");
    let files = files.map(|entry| entry.expect("a file").path()).chain([recipe("action.yml")]);
    let mut pinned = 0;
    for file in files {
        let text = fs::read_to_string(&file).expect("text");
        for line in
            text.lines().filter(|line| line.trim_start().trim_start_matches("- ").starts_with("uses: "))
        {
            let (_, reference) = line.split_once('@').expect("a reference");
            let (commit, version) =
                reference.split_once(" # v").unwrap_or_else(|| panic!("{}: {line}", file.display()));
            assert!(commit.len() == 40 && commit.bytes().all(|byte| byte.is_ascii_hexdigit()), "{line}");
            assert!(version.split('.').count() == 3, "{line}");
            pinned += 1;
        }
    }
    assert!(pinned > 20, "{pinned}");
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

/// A JUnit file as the XML library of Python reads it: the counts of its suite, then each case with what came of it.
const READER: &str = "\
import sys
import xml.etree.ElementTree as tree
[suite] = tree.parse(sys.argv[1]).getroot()
print(*(suite.get(name) for name in ('tests', 'failures', 'errors', 'skipped')))
for case in suite:
    print(case.get('classname'), case.get('name'), *(child.tag for child in case), sep='|')
";

#[test]
fn a_junit_file_is_read_by_another_reader() {
    if !has("python3", "--version") {
        return;
    }
    let folder = &folder();
    let read = |arguments: &[&str]| {
        let told = ran(folder, TAUTLINE, &[arguments, &["--format", "junit"]].concat());
        write(folder, "told.xml", told.stdout);
        let read = ran(folder, "python3", &["-c", READER, "told.xml"]);
        String::from_utf8(read.stdout).expect("text")
    };
    assert_eq!(read(&HUNT), "1 1 0 0\nchain|CHAIN-13 by chain (published)|failure\n");
    let proved = read(&["prove", "LATTICE-1"]);
    assert_eq!(proved, "1 0 0 0\nLATTICE|LATTICE-1 as published, exhaustive: 81 offsets\n");
    let ended = read(&["hunt", "--robots", "3", "--max-walls", "2", "--budget", "1"]);
    assert!(ended.starts_with("1 0 0 1\n") && ended.ends_with("|skipped\n"), "{ended}");
}

#[test]
fn the_notes_of_a_release_are_a_section_of_the_changelog() {
    let notes = |version: &str| ran(&recipe("."), recipe(".ci/notes"), &[version]);
    let unreleased = notes("Unreleased");
    assert_eq!(unreleased.status.code(), Some(0));
    let text = String::from_utf8(unreleased.stdout).expect("text");
    assert!(text.starts_with("### ") && !text.contains("\n## "), "{text}");
    assert_eq!(notes("9.9.9").status.code(), Some(1));
}

/// The input of mdBook: the table of contents has every page once, and every link of a page leads to a file in the
/// book; mdBook makes `index.html` of a `README.md`, and nothing of a folder.
#[test]
fn no_page_is_left_out_of_the_book() {
    let folder = &folder();
    let out = folder.to_str().expect("text");
    let made = ran(folder, recipe(".ci/book"), &[out]);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let source = folder.join("src");
    let contents = read(&source, "SUMMARY.md");
    let links = |text: &str| -> Vec<String> {
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        targets.map(|target| target.split('#').next().unwrap_or_default().to_owned()).collect()
    };
    let chapters = links(&contents);
    for page in crate::commands::documents() {
        let name = page.strip_prefix(recipe("")).expect("a page of ours").display().to_string();
        assert_eq!(chapters.iter().filter(|chapter| **chapter == name).count(), 1, "{name}");
        let text = read(&source, &name);
        let near = |target: &&String| !target.is_empty() && !target.starts_with("https://");
        for target in links(&text).iter().filter(near) {
            assert!(!target.ends_with("README.md"), "{name}: {target} leads nowhere in the book");
            let place = source.join(&name).with_file_name(target.replace("index.md", "README.md"));
            assert!(place.is_file(), "{name}: {target} leads nowhere in the book");
        }
    }
    assert_eq!(chapters.len(), crate::commands::documents().len());
}
