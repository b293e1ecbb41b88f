//! The program as its users run it: what it prints, what it stores, and with which exit code it ends.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use insta::assert_snapshot;
use serde_json::Value;

use crate::folder::{folder, read, write};

#[path = "cli/areas.rs"]
mod areas;
#[path = "cli/ascii.rs"]
mod ascii;
#[path = "cli/certificates.rs"]
mod certificates;
#[path = "cli/faults.rs"]
mod failures;
#[path = "cli/files.rs"]
mod files;
#[path = "cli/first_steps.rs"]
mod first_steps;
#[path = "cli/frames.rs"]
mod frames;
#[path = "cli/frontier.rs"]
mod frontier;
#[path = "cli/kit.rs"]
mod kit;
#[path = "cli/library.rs"]
mod library;
#[path = "cli/locate.rs"]
mod locate;
#[path = "cli/seeds.rs"]
mod seeds;
#[path = "cli/shards.rs"]
mod shards;
#[cfg(unix)]
#[path = "cli/signals.rs"]
mod signals;

fn tautline(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tautline"));
    command.current_dir(folder).args(arguments).env("NO_COLOR", "1").env("COLUMNS", "100");
    command
}

pub(crate) fn ran(folder: &Path, arguments: &[&str]) -> Output {
    tautline(folder, arguments).output().expect("the program runs")
}

/// The text that a command prints on one thread, and as well on three; so it is with the files that it stores.
fn on_any_threads(folder: &Path, arguments: &[&str]) -> String {
    let [one, three] = ["1", "3"].map(|threads| {
        let output = tautline(folder, arguments).env("RAYON_NUM_THREADS", threads).output();
        let output = output.expect("the program runs");
        assert_eq!(output.status.code(), Some(0));
        let stored: Vec<String> = names(folder).iter().map(|name| read(folder, name)).collect();
        (String::from_utf8(output.stdout).expect("text"), stored)
    });
    assert_eq!(one, three);
    one.0
}

/// A picture that is stored, which is whole.
fn picture(folder: &Path, name: &str) -> String {
    let drawn = read(folder, name);
    assert!(drawn.starts_with("<svg ") && drawn.ends_with("</svg>\n"), "{name}");
    drawn
}

/// The exit code of a command that gets a Ctrl-C at work.
#[cfg(unix)]
fn interrupted(folder: &Path, arguments: &[&str]) -> Option<i32> {
    let mut child = tautline(folder, arguments).stdout(Stdio::piped()).spawn().expect("the program runs");
    std::thread::sleep(Duration::from_millis(500));
    files::send("-INT", &child);
    child.wait().expect("it ends").code()
}

/// The text on stdout of a program that ends with `code` and says nothing on stderr.
fn printed(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = ran(folder, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), &*errors), (Some(code), ""), "{arguments:?}");
    String::from_utf8(output.stdout).expect("text")
}

fn json(folder: &Path, arguments: &[&str], code: i32) -> Value {
    let arguments = [arguments, &["--format", "json"]].concat();
    let value: Value = serde_json::from_str(&printed(folder, &arguments, code)).expect("JSON");
    assert_eq!(value["schema_version"], 1);
    value
}

/// The words about wrong usage or bad input, without the blanks at the ends of lines; nothing is on stdout.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = ran(folder, arguments);
    let errors = String::from_utf8(output.stderr).expect("text");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}: {errors}");
    errors.lines().map(str::trim_end).collect::<Vec<_>>().join("\n")
}

/// Checks that a text has all these words.
#[track_caller]
pub(crate) fn says(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "{word:?} is not in {text}");
    }
}

/// The words about each of these commands, which all begin so and are refused.
fn refusals(folder: &Path, begin: &[&str], ends: &[&[&str]]) -> String {
    let said = ends.iter().map(|end| {
        let arguments = [begin, end].concat();
        format!("$ tautline {}\n{}\n", arguments.join(" "), refused(folder, &arguments))
    });
    said.collect::<Vec<_>>().join("\n")
}

/// The words about each of these texts, none of which is `stored`, in the file that a command reads.
fn refused_texts(folder: &Path, stored: &str, texts: &[(&str, String)], command: [&str; 2]) -> String {
    let said = texts.iter().map(|(what, text)| {
        assert_ne!(text, stored, "{what}");
        write(folder, command[1], text);
        format!("{what}\n{}\n", refused(folder, &command))
    });
    said.collect::<Vec<_>>().join("\n")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("a file").file_name().into_string().expect("a name")).collect();
    names.sort_unstable();
    names
}

#[test]
fn an_open_area_takes_62_team_moves() {
    let folder = &folder();
    assert_snapshot!(
        printed(folder, &["explore", "open:15x15", "--robots", "8", "--format", "json"], 0),
        @r#"{"schema_version":1,"scheme":"chain","rule":"repaired","robots":8,"seed":0,"layout":"open:15x15","base":[7,7],"steps":62,"explored":225,"cells":225,"milestones":{"50":34,"75":48,"100":62},"stopped":"explored","violations":[]}"#
    );
    assert_snapshot!(
        "order_of_62_moves",
        printed(folder, &["explore", "open:15x15", "--robots", "8", "--draw", "order"], 0)
    );
    printed(folder, &["explore", "open:15x15", "--robots", "8", "--trace", "run.jsonl"], 0);
    let frames = printed(folder, &["replay", "run.jsonl"], 0);
    assert_snapshot!("frames_of_62_moves", frames::in_short(&frames));
    assert_eq!(names(folder), ["run.jsonl"]);
}

#[test]
fn the_published_rule_is_refuted_and_its_counterexamples_replay() {
    let folder = &folder();
    let hunt = ["hunt", "--scheme", "chain", "--rule", "published", "--robots", "4", "--max-walls", "4"];
    let found = json(folder, &hunt, 1);
    assert_eq!((&found["runs"], &found["moves"]), (&396_261.into(), &10_057_328.into()));
    assert_eq!((&found["verdict"], &found["complete"]), (&"refuted".into(), &true.into()));
    let counterexamples = found["counterexamples"].as_array().expect("a list");
    let briefly = counterexamples.iter().map(|one| {
        format!("{} {} walls {} steps {}", one["clause"], one["walls"], one["steps"], one["file"])
    });
    assert_snapshot!(briefly.collect::<Vec<_>>().join("\n"), @r#"
    "CHAIN-1" 4 walls 19 steps "chain-1-published-n4.jsonl"
    "CHAIN-2" 4 walls 32 steps "chain-2-published-n4.jsonl"
    "CHAIN-13" 2 walls 72 steps "chain-13-published-n4.jsonl"
    "#);
    let files = ["chain-1-published-n4.jsonl", "chain-13-published-n4.jsonl", "chain-2-published-n4.jsonl"];
    assert_eq!(names(folder), files);
    for (clause, file) in ["CHAIN-1", "CHAIN-13", "CHAIN-2"].into_iter().zip(files) {
        let frames = printed(folder, &["replay", file], 1);
        assert_snapshot!(format!("counterexample_to_{clause}"), frames::in_short(&frames));
        let replayed = json(folder, &["replay", file], 1);
        assert_eq!(replayed["counterexample_to"], clause);
        assert_eq!(replayed["violations"][0]["clause"], clause);
        // Under the other rule it is another run.
        let text = read(folder, file);
        write(folder, "other.jsonl", text.replace("published", "repaired"));
        assert!(refused(folder, &["replay", "other.jsonl"]).contains("the rule does not make this run"));
    }
}

#[test]
fn the_repaired_rule_breaks_in_no_layout_with_four_walls() {
    let folder = &folder();
    let hunt = ["hunt", "--scheme", "chain", "--rule", "repaired", "--robots", "4", "--max-walls", "4"];
    assert_snapshot!(printed(folder, &hunt, 0), @r#"
    chain (repaired), 4 robots, at most 4 walls: 395682 runs, 9669112 team moves, 356 the longest
    No clause that is looked for is broken in any layout within this bound.
    "#);
    assert_eq!(names(folder), [""; 0]);
}

#[test]
fn brick_and_mortar_is_trapped_by_one_missed_sensor() {
    let folder = &folder();
    let hunt = ["hunt", "--scheme", "bricks", "--max-misses", "2"];
    assert_snapshot!("trap", printed(folder, &hunt, 1));
    let found = json(folder, &hunt, 1);
    assert_snapshot!(found["counterexamples"],
        @r#"[{"clause":"BRICKS-4","columns":3,"file":"bricks-4-repaired-n1.jsonl","misses":1,"rows":3,"steps":5}]"#);
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/bricks-4-repaired-n1.jsonl");
    let stored = read(folder, "bricks-4-repaired-n1.jsonl");
    assert_eq!(stored, fs::read_to_string(kept).expect("a run"), "the page draws another one");
    assert_snapshot!("trap_replayed", printed(folder, &["replay", "bricks-4-repaired-n1.jsonl"], 1));
    let cases = [
        ("nothing missed", stored.replacen("\"missed\":[2],", "", 1)),
        ("twice the same", stored.replacen("\"missed\":[2]", "\"missed\":[2,2]", 1)),
        ("sensor 0", stored.replacen("\"missed\":[2]", "\"missed\":[0]", 1)),
        ("less than none", stored.replacen("\"missed\":[2]", "\"missed\":[-2]", 1)),
        (
            "a chain",
            stored.replacen("\"scheme\":\"bricks\"", "\"scheme\":\"chain\"", 1).replacen(
                "\"robots\":1",
                "\"robots\":2",
                1,
            ),
        ),
    ];
    let said = refused_texts(folder, &stored, &cases, ["replay", "run.jsonl"]);
    assert_snapshot!("wrong_traps", said);
}

#[test]
fn ants_and_the_robust_rule_are_not_trapped() {
    let folder = &folder();
    assert_snapshot!(printed(folder, &["hunt", "--scheme", "bricks-ants", "--max-misses", "2", "--size", "3x3"], 0),
        @r#"
    bricks-ants (repaired), 1 agent, at most 2 missed, layouts up to 3x3: 330 layouts, 169999 states, 196963 team moves
    No agent is trapped (done, or going round for ever, before every cell is explored) in any layout within this bound.
    "#);
    assert_snapshot!(printed(folder, &["hunt", "--scheme", "ants", "--max-misses", "2", "--size", "3x3"], 0), @r#"
    ants (repaired), 1 agent, at most 2 missed, layouts up to 3x3: 330 layouts, 151247 states, 212690 team moves
    No agent is trapped (done, or going round for ever, before every cell is explored) in any layout within this bound.
    "#);
    let all = json(folder, &["hunt", "--scheme", "helpers", "--max-misses", "255", "--size", "2x2"], 0);
    assert_eq!((&all["complete"], &all["misses_done"]), (&true.into(), &255.into()));
    let short = json(folder, &["hunt", "--scheme", "bricks", "--budget", "1000"], 3);
    assert_eq!((&short["verdict"], &short["complete"]), (&"open".into(), &false.into()));
    assert_eq!(names(folder), [""; 0]);
}

/// Of agents that read how often cells were entered, and of robots of which a fix is off, too.
#[test]
fn whatever_a_hunt_stores_of_endless_runs_is_replayed() {
    let hunts = [
        (
            "helpers --rule trusting --robots 1 --size 3x2 --max-misses 1",
            "bricks-5-helpers-trusting-n1.jsonl",
        ),
        ("frontier --rule literal --robots 2 --size 3x1 --error 1", "frontier-3-literal-n2.jsonl"),
    ];
    for (hunt, endless) in hunts {
        let folder = &folder();
        let hunt: Vec<&str> = ["hunt", "--scheme"].into_iter().chain(hunt.split(' ')).collect();
        printed(folder, &hunt, 1);
        let stored = names(folder);
        assert!(stored.iter().any(|name| name == endless), "{stored:?}");
        for name in stored {
            printed(folder, &["replay", &name], 1);
        }
    }
}

#[test]
fn a_hunt_that_ends_before_its_bound_claims_nothing() {
    let folder = &folder();
    let found = json(folder, &["hunt", "--rule", "repaired", "--budget", "1000"], 3);
    assert_eq!((&found["verdict"], &found["complete"]), (&"open".into(), &false.into()));
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_a_hunt_without_a_claim() {
    let folder = &folder();
    let hunt = ["hunt", "--robots", "6", "--max-walls", "6", "--out", "found/deep"];
    assert_eq!(interrupted(folder, &hunt), Some(3));
    assert_eq!(names(folder), [""; 0]);
}

/// It is killed at work and, after a Ctrl-C, perhaps while it writes its file; budgets take it further in between.
#[cfg(unix)]
#[test]
fn a_hunt_killed_at_any_moment_and_resumed_comes_out_the_same() {
    let hunt = ["hunt", "--rule", "published", "--robots", "4", "--max-walls", "3", "--format", "json"];
    let run = |folder: &Path, threads: &str, more: &[&str]| {
        let mut command = tautline(folder, &[&hunt, more].concat());
        command.env("RAYON_NUM_THREADS", threads).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().expect("the program runs")
    };
    let ended = |child: Child| {
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
        (output.status.code(), String::from_utf8(output.stdout).expect("text"))
    };
    let runs_in = |folder: &Path| {
        let stored = names(folder).into_iter().filter(|name| name.starts_with("chain-"));
        stored.map(|name| (fs::read(folder.join(&name)).expect("a run"), name)).collect::<Vec<_>>()
    };
    let undisturbed = &folder();
    let whole = ended(run(undisturbed, "2", &["--resume", "hunt.json"]));
    assert_eq!(whole.0, Some(1));
    for threads in ["1", "2"] {
        let folder = &folder();
        let kept = || fs::read(folder.join("hunt.json")).ok();
        for (budget, millis) in [("1000", 3), ("30000", 37), ("150000", 11), ("300000", 61)] {
            let (code, _) = ended(run(folder, threads, &["--resume", "hunt.json", "--budget", budget]));
            assert!(matches!(code, Some(1 | 3)), "{budget}: {code:?}");
            for ending in [["-KILL", "-KILL"], ["-INT", "-KILL"]] {
                let mut child = run(folder, threads, &["--resume", "hunt.json"]);
                for signal in ending {
                    std::thread::sleep(Duration::from_millis(millis));
                    Command::new("kill").args([signal, &child.id().to_string()]).output().expect("kill runs");
                }
                child.wait().expect("it ends");
            }
        }
        assert_eq!(ended(run(folder, threads, &["--resume", "hunt.json"])), whole, "{threads} threads");
        assert_eq!(runs_in(folder), runs_in(undisturbed), "{threads} threads");
        let done = kept();
        assert_eq!(ended(run(folder, threads, &["--resume", "hunt.json"])), whole, "nothing is left to do");
        assert_eq!(kept(), done);
    }
}

/// The first two lines of a file, with the checksum that belongs to them.
fn sealed(text: &str) -> String {
    let lines: Vec<&str> = text.lines().take(2).collect();
    let lines = lines.join("\n") + "\n";
    format!("{lines}{{\"crc32\":{}}}\n", crc32fast::hash(lines.as_bytes()))
}

/// The file as another build would have made it.
fn of_another_build(text: &str) -> String {
    let (head, rest) = text.split_once("\"program\":\"").expect("a program");
    sealed(&format!("{head}\"program\":\"{}{}", "0".repeat(64), &rest[64..]))
}

#[test]
fn a_kept_hunt_that_is_damaged_or_another_is_refused_with_its_place() {
    let folder = &folder();
    let file = folder.join("hunt.json");
    let hunt = ["hunt", "--rule", "repaired", "--robots", "3", "--max-walls", "2", "--resume", "hunt.json"];
    printed(folder, &hunt, 0);
    let kept = fs::read_to_string(&file).expect("text");
    // With a checksum that is the same for all builds.
    let foreign = of_another_build(&kept);
    let lines: Vec<&str> = foreign.split_inclusive('\n').collect();
    let damaged = [
        ("no bytes", String::new()),
        ("cut after a line", lines[..2].concat()),
        ("cut within the last line", foreign[..foreign.len() - 5].to_owned()),
        ("a line too many", foreign.clone() + "{}\n"),
        ("a digit changed", foreign.replacen("\"runs\":1", "\"runs\":2", 1)),
        ("no JSON", foreign.replacen("{\"format\"", "hunt", 1)),
        ("another version", foreign.replacen("\"version\":1", "\"version\":2", 1)),
        ("another format", foreign.replacen("tautline hunt", "tautline run", 1)),
        ("an unknown rule", foreign.replacen("repaired", "mended", 1)),
        ("another checksum", foreign.replacen("{\"crc32\":", "{\"crc32\":1", 1)),
        ("another build", foreign.clone()),
    ];
    let mut said = Vec::new();
    for (what, text) in damaged {
        assert_ne!(text, kept, "{what}");
        fs::write(&file, &text).expect("a file");
        said.push(format!("{what}\n{}\n", refused(folder, &hunt)));
        assert_eq!(fs::read_to_string(&file).expect("text"), text, "{what}: it is left as it is");
    }
    fs::write(&file, &kept).expect("a file");
    let other: [&[&str]; 7] = [
        &["--rule", "published", "--robots", "3", "--max-walls", "2"],
        &["--rule", "repaired", "--robots", "4", "--max-walls", "2"],
        &["--rule", "repaired", "--robots", "3", "--max-walls", "2", "--size", "4x5"],
        &["--rule", "repaired", "--robots", "3", "--max-walls", "1"],
        &["--rule", "repaired", "--robots", "3", "--max-walls", "41"],
        &["--rule", "repaired", "--robots", "3", "--max-walls", "2", "--resume", "."],
        &["--rule", "repaired", "--robots", "3", "--max-walls", "2", "--resume", "nowhere/hunt.json"],
    ];
    for arguments in other {
        let resume: &[&str] = if arguments.contains(&"--resume") { &[] } else { &["--resume", "hunt.json"] };
        let arguments = [&["hunt"], arguments, resume].concat();
        said.push(format!("$ tautline {}\n{}\n", arguments.join(" "), refused(folder, &arguments)));
    }
    assert_snapshot!("wrong_kept_hunts", said.join("\n"));
    assert_eq!(fs::read_to_string(&file).expect("text"), kept);
    assert_eq!(names(folder), ["hunt.json"]);
}

#[test]
fn a_reader_that_goes_away_ends_nothing_but_the_printing() {
    let folder = &folder();
    let mut command = tautline(folder, &["explore", "walls:15x15:0.1", "--draw", "moves"]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program runs");
    let mut line = String::new();
    BufReader::new(child.stdout.take().expect("a pipe")).read_line(&mut line).expect("a line");
    let output = child.wait_with_output().expect("it ends");
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}

#[test]
fn the_environments_are_drawn_from_the_radii() {
    assert_snapshot!(printed(&folder(), &["show", "environments"], 0), @r#"
    E_N, one step or none       E_S, wholly within r_safe   E_C, wholly within r_cov
    · · · · · · ·               · · · · · · ·               · · · · · · ·
    · · · · · · ·               · · · · · · ·               · · · # · · ·
    · · · # · · ·               · · # # # · ·               · · # # # · ·
    · · # R # · ·               · · # R # · ·               · # # R # # ·
    · · · # · · ·               · · # # # · ·               · · # # # · ·
    · · · · · · ·               · · · · · · ·               · · · # · · ·
    · · · · · · ·               · · · · · · ·               · · · · · · ·
    "#);
}

#[test]
fn a_layout_shown_is_a_layout_file() {
    let folder = &folder();
    let drawing = printed(folder, &["show", "walls:5x4:0.2", "--seed", "2"], 0);
    write(folder, "walls.txt", &drawing);
    assert_eq!(printed(folder, &["show", "walls.txt"], 0), drawing);
    assert_snapshot!(drawing, @r#"
    tautline layout 1
    +--+--+--+--+--+
    |              |
    +  +  +  +  +  +
    |  |           |
    +  +  +--+  +  +
    |              |
    +  +  +--+  +  +
    |  |     |  |  |
    +--+--+--+--+--+
    "#);
    let shown = json(folder, &["show", "walls.txt"], 0);
    assert_eq!(
        (&shown["width"], &shown["free_cells"], &shown["base"]),
        (&5.into(), &20.into(), &serde_json::json!([2, 1]))
    );
}

#[test]
fn clauses_are_decided_by_name() {
    let folder = &folder();
    assert_snapshot!(printed(folder, &["prove", "LATTICE-1", "chain-5"], 0), @r#"
    clause     rule       engine      cases  verdict  mutants killed
               bound
    LATTICE-1  published  exhaustive     81  holds    3/3
               81 offsets
               composition: machine-checked
    CHAIN-5    published  search      25742  holds    1/1
               all layouts, N = 4, at most 3 walls
               composition: machine-checked in part (admitted plans)
    CHAIN-5    repaired   search      25724  holds    1/1
               all layouts, N = 4, at most 3 walls
               composition: machine-checked in part (admitted plans)
    CHAIN-5    reel       search      26389  holds    1/1
               all layouts, N = 4, at most 3 walls
               composition: machine-checked in part (admitted plans)

    All 4 verdicts are the registered ones.
    "#);
    let ledger = json(folder, &["prove", "CHAIN-10"], 0);
    assert_eq!(ledger["as_registered"], true);
    let first = &ledger["clauses"][0];
    assert_eq!((&first["id"], &first["verdict"]), (&"CHAIN-10".into(), &"holds".into()));
    assert_eq!(first["mutants"], serde_json::json!({ "killed": 2, "of": 2, "survived": [] }));
    let told = printed(folder, &["prove", "NOTICE-5"], 0);
    says(&told, &["\n2 hears 1 and is silent.\nNothing more happens; 3 has not heard of the event.\n"]);
    assert_snapshot!("unknown_clause", refused(folder, &["prove", "CHAIN-99"]));
}

#[test]
fn a_bound_on_memory_leaves_checks_open_and_says_so() {
    let folder = &folder();
    let enough = printed(folder, &["prove", "KIT-12", "--memory", "1GiB"], 0);
    assert!(enough.contains("The verdict is the registered one."), "{enough}");
    let told = printed(folder, &["prove", "KIT-12", "--memory", "64KiB"], 3);
    assert!(told.contains("KIT-12 as repaired: open, registered as holds"), "{told}");
    assert!(told.contains("would have taken more than 48 KiB") && told.contains("--memory"), "{told}");
    let ledger = json(folder, &["prove", "KIT-12", "--memory", "64KiB"], 3);
    assert_eq!((&ledger["out_of_memory"], &ledger["as_registered"]), (&true.into(), &false.into()));
    for wrong in ["1", "0GiB", "1GB", "-1MiB", "99999999999GiB", "GiB"] {
        says(&refused(folder, &["prove", "KIT-12", &format!("--memory={wrong}")]), &["KiB, MiB or GiB"]);
    }
}

#[test]
fn the_patience_with_a_step_is_a_number_of_seconds_and_changes_nothing_where_steps_end() {
    let folder = &folder();
    let patient = printed(folder, &["prove", "KIT-12", "--patience", "1"], 0);
    assert_eq!(patient, printed(folder, &["prove", "KIT-12"], 0));
    let ledger = json(folder, &["prove", "NOTICE-4", "--patience", "600"], 0);
    assert_eq!((&ledger["unended"], &ledger["clauses"][0]["undecided"]), (&false.into(), &().into()));
    for wrong in ["0", "-1", "1.5", "a while"] {
        let said = refused(folder, &["prove", "NOTICE-4", &format!("--patience={wrong}")]);
        assert!(said.contains("write a whole number from 1"), "{said}");
    }
}

#[test]
fn the_counterexample_of_a_clause_of_agents_is_drawn() {
    let folder = &folder();
    assert_snapshot!("missed_sensors_in_turns", printed(folder, &["prove", "BRICKS-5"], 0));
    let shown = json(folder, &["prove", "BRICKS-5"], 0)["clauses"][1]["counterexample"].take();
    assert_eq!((&shown["demand"], &shown["turns"]), (&"every cell is explored".into(), &4.into()));
    assert!(shown["drawing"].as_str().is_some_and(|drawing| drawing.contains("before turn 4")), "{shown}");
}

#[test]
fn the_cost_of_the_repairs_is_the_same_on_any_number_of_threads() {
    let folder = &folder();
    on_any_threads(folder, &["reproduce", "repair-cost", "--runs", "12"]);
    let measured = json(folder, &["reproduce", "repair-cost", "--runs", "3"], 0);
    assert_eq!(measured["densities"].as_array().map(Vec::len), Some(7));
}

#[test]
fn the_distance_from_the_optimum_is_the_same_on_any_number_of_threads() {
    let folder = &folder();
    let table = on_any_threads(folder, &["reproduce", "optimum", "--max-walls", "2"]);
    assert_snapshot!("optimum_of_two_walls", table);
    let measured = json(folder, &["reproduce", "optimum", "--max-walls", "0"], 0);
    assert_eq!((&measured["id"], &measured["lines"][2]["mean"]), (&"optimum".into(), &1.0.into()));
    let layout = measured["lines"][0]["worst"]["layout"].as_str().expect("a drawing");
    write(folder, "worst.txt", layout);
    printed(folder, &["show", "worst.txt"], 0);
    assert!(refused(folder, &["reproduce", "optimum", "--max-walls", "7"]).contains("from 0 to 6"));
}

#[test]
fn the_figures_of_agents_are_the_same_on_any_number_of_threads() {
    let folder = &folder();
    let figure = ["reproduce", "bricks-fig11", "--runs", "3", "--max-steps", "3000", "--svg", "fig11.svg"];
    on_any_threads(folder, &figure);
    let short = ["--runs", "1", "--max-steps", "500"];
    let area = json(folder, &[&["reproduce", "bricks-fig12"], &short[..]].concat(), 0);
    assert_eq!((&area["miss"], area["lines"].as_array().map(Vec::len)), (&0.0556.into(), Some(64)));
    let ideal = json(folder, &[&["reproduce", "bricks-ideal"], &short[..]].concat(), 0);
    assert_eq!((&ideal["miss"], &ideal["lines"][3]["visited"]), (&0.0.into(), &Value::Null));
    let apart = [&["reproduce", "bricks-ideal", "--starts", "apart"], &short[..]].concat();
    assert!(on_any_threads(folder, &apart).contains("\nEach agent starts in a cell of its own\n"));
    assert!(
        refused(folder, &[&apart[..3], &["roof"]].concat()).contains("possible values: centre, apart, edge")
    );
}

#[test]
fn the_reach_of_broadcasts_is_the_same_on_any_number_of_threads() {
    let folder = &folder();
    let figure = ["reproduce", "notice-fig5", "--nodes", "300,700", "--runs", "20", "--channel", "shared"];
    assert_snapshot!("reach_of_broadcasts", on_any_threads(folder, &figure));
    let asked = ["reproduce", "notice-fig5", "--nodes", "300", "--runs", "3", "--svg-reach", "a.svg"];
    let measured = json(folder, &[&asked[..], &["--svg-rebroadcasts", "b.svg"]].concat(), 0);
    let first = &measured["densities"][0]["schemes"][0];
    assert_eq!((&first["scheme"], &first["paper"]), (&"k-fnf k=1".into(), &1.0.into()));
    assert_eq!(names(folder), ["a.svg", "b.svg"]);
    for name in ["a.svg", "b.svg"] {
        picture(folder, name);
    }
}

#[test]
fn what_is_wrong_with_a_network_is_said_with_a_remedy() {
    let folder = &folder();
    let wrong: [&[&str]; 16] = [
        &["--nodes", "0"],
        &["--nodes", "1"],
        &["--nodes", "300,1000001"],
        &["--nodes", "many"],
        &["--nodes", "20000", "--range", "300"],
        &["--range", "0"],
        &["--range", "-1"],
        &["--range", "nan"],
        &["--range", "4001"],
        &["--side", "0"],
        &["--side", "inf"],
        &["--k", "0"],
        &["--k", "9"],
        &["--runs", "0"],
        &["--channel", "quiet"],
        &["--nodes", "2", "--runs", "1", "--svg-reach", "."],
    ];
    assert_snapshot!("wrong_networks", refusals(folder, &["reproduce", "notice-fig5"], &wrong));
    assert_eq!(names(folder), [""; 0]);
}

#[test]
fn the_ways_of_robots_are_the_same_on_any_number_of_threads() {
    let folder = &folder();
    let figure = ["reproduce", "rescue-fig7", "--nodes", "300,700", "--runs", "12", "--svg", "7.svg"];
    assert_snapshot!("ways_of_robots", on_any_threads(folder, &figure));
    for (figure, obstacles, trails) in [("rescue-fig6", 0, 3), ("rescue-fig9", 1, 1), ("rescue-fig10", 4, 1)]
    {
        let measured = json(folder, &["reproduce", figure, "--runs", "3", "--svg", "ways.svg"], 0);
        assert_eq!((&measured["id"], &measured["topologies"]), (&figure.into(), &3.into()));
        assert_eq!(measured["obstacles"].as_array().map(Vec::len), Some(obstacles));
        let tan = &measured["densities"][0]["ways"][0];
        assert_eq!((&tan["way"], &tan["arrivals"]["mean"]), (&"tan".into(), &1.0.into()));
        assert!(tan["ratio"]["mean"].as_f64().is_some_and(|ratio| ratio >= 1.0), "{tan}");
        let drawn = picture(folder, "ways.svg");
        assert_eq!(drawn.matches("class=\"trail\"").count(), trails, "{figure}");
    }
    let shapes = json(folder, &["reproduce", "rescue-shapes", "--runs", "3"], 0);
    let of = |place: usize| &shapes["densities"][place];
    assert_eq!((&of(0)["shape"], &of(5)["shape"]), (&"rectangle".into(), &"ring".into()));
    assert!((0..6).all(|place| of(place)["told_arrive"]["mean"] == 1.0), "{shapes}");
    let scarce = ["reproduce", "rescue-fig6", "--nodes", "2", "--runs", "1"];
    let (told, said) = files::left_out(folder, &[&scarce[..], &["--svg", "none.svg"]].concat());
    assert_eq!(told, printed(folder, &scarce, 0));
    assert!(said.contains("take more topologies or nodes"), "{said}");
    assert_eq!(names(folder), ["7.svg", "ways.svg"]);
}

#[test]
fn three_robots_for_three_wfrs_are_the_same_on_any_number_of_threads() {
    let folder = &folder();
    let figure = ["reproduce", "rescue-fig8", "--runs", "20", "--svg", "ways.svg"];
    assert_snapshot!("three_robots_for_three_wfrs", on_any_threads(folder, &figure));
    let drawn = read(folder, "ways.svg");
    assert_eq!(drawn.matches("class=\"trail\" d=\"M").count(), 6, "three, and the legend");
    let few = ["reproduce", "rescue-fig8", "--robots", "1", "--wfr", "2", "--runs", "3"];
    let few = json(folder, &few, 0);
    assert_eq!((&few["id"], &few["rules"][1]["own"]["ours"]["mean"]), (&"rescue-fig8".into(), &0.0.into()));
    assert_eq!((&few["rules"][1]["over_best"], &few["rules"][1]["best"]), (&Value::Null, &Value::Null));
    let cases: [&[&str]; 4] =
        [&["--nodes", "1"], &["--robots", "7"], &["--wfr", "0"], &["--nodes", "2", "--wfr", "3"]];
    let said = cases.map(|arguments| {
        let asked = [&["reproduce", "rescue-fig8"], arguments].concat();
        format!("{}\n{}\n", arguments.join(" "), refused(folder, &asked))
    });
    assert_snapshot!("wrong_figure_8", said.join("\n"));
}

#[test]
fn a_directional_antenna_and_what_noise_does_to_a_scan() {
    let folder = &folder();
    let asked = ["reproduce", "antenna-fig4", "--runs", "200", "--svg", "antenna.svg"];
    assert_snapshot!("antenna", printed(folder, &asked, 0));
    picture(folder, "antenna.svg");
    let near = json(folder, &["reproduce", "antenna-fig4", "--distance", "1", "--runs", "10"], 0);
    let levels = near["pattern"].as_array().expect("angles");
    assert_eq!((levels.len(), &levels[12]["degrees"]), (25, &0.into()));
    let level = |place: usize| levels[place]["level_db"].as_f64().expect("heard so near");
    assert!((0..12).all(
        |place| level(place) <= level(place + 1) && level(place).to_bits() == level(24 - place).to_bits()
    ));
}

#[test]
fn what_is_wrong_with_a_journey_is_said_with_a_remedy() {
    let folder = &folder();
    let wrong: [&[&str]; 20] = [
        &["rescue-fig7", "--nodes", "1"],
        &["rescue-fig7", "--nodes", "300,"],
        &["rescue-fig7", "--range", "0"],
        &["rescue-fig7", "--side", "nan"],
        &["rescue-fig7", "--k", "0"],
        &["rescue-fig7", "--noise-db", "-1"],
        &["rescue-fig7", "--noise-db", "nan"],
        &["rescue-fig7", "--runs", "0"],
        &["rescue-fig9", "--obstacle", "1,2,3"],
        &["rescue-fig9", "--obstacle", "a,b,c,d"],
        &["rescue-fig9", "--obstacle", "200,90,100,210"],
        &["rescue-fig9", "--obstacle", "0,0,inf,300"],
        &["rescue-fig9", "--obstacle", "0,0,300,300"],
        &["rescue-fig9", "--obstacle", "o:0,0,30,30"],
        &["rescue-fig9", "--obstacle", "##/#:0,0,30,30"],
        &["rescue-fig7", "--near", "0"],
        &["rescue-fig7", "--scan", "never"],
        &["rescue-fig10", "--runs", "1", "--svg", "."],
        &["antenna-fig4", "--distance", "0"],
        &["antenna-fig4", "--noise-db", "0,21"],
    ];
    assert_snapshot!("wrong_journeys", refusals(folder, &["reproduce"], &wrong));
    assert_eq!(names(folder), [""; 0]);
}

#[test]
fn the_tables_are_listed_and_have_help_with_examples() {
    let folder = &folder();
    assert_snapshot!("tables", printed(folder, &["reproduce"], 0));
    let tables = "repair-cost optimum bricks-fig11 notice-fig5 antenna-fig4 rescue-fig7 rescue-fig8 locate-fig8 \
                  locate-convergence";
    for table in tables.split(' ') {
        let help = printed(folder, &["reproduce", table, "--help"], 0);
        assert!(help.contains("Example"), "{table}");
        assert_snapshot!(format!("help_reproduce_{table}"), help);
    }
}

/// A part of a page's data, by its name.
fn part<'a>(page: &'a str, name: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("id=\"{name}\">")).expect("a part");
    rest.split_once("</script>").expect("its end").0
}

/// The lines of a page: what there was before, then a line for each step.
fn lines_of(page: &str) -> Vec<&str> {
    part(page, "lines").lines().filter(|line| !line.is_empty()).collect()
}

/// The film of a page, as data.
fn film_of(page: &str) -> Value {
    serde_json::from_str(part(page, "film")).expect("JSON")
}

#[test]
fn pictures_and_pages_are_whole_and_need_nothing_from_elsewhere() {
    let folder = &folder();
    let explore = ["explore", "walls:9x9:0.1", "--robots", "5", "--trace", "run.jsonl"];
    printed(folder, &[&explore[..], &["--svg", "order.svg", "--html", "run.html"]].concat(), 0);
    printed(
        folder,
        &["replay", "run.jsonl", "--moves", "3..5", "--svg", "moves.svg", "--html", "moves.html"],
        0,
    );
    printed(folder, &["show", "environments", "--svg", "environments.svg"], 0);
    assert_eq!(
        names(folder),
        ["environments.svg", "moves.html", "moves.svg", "order.svg", "run.html", "run.jsonl"]
    );
    for name in names(folder) {
        let text = read(folder, &name);
        let links = text.replace("http://www.w3.org/2000/svg", "");
        assert!(!links.contains("http") && !text.contains("{{"), "{name}");
        if name.ends_with("svg") {
            picture(folder, &name);
        }
    }
    let page = read(folder, "moves.html");
    assert_eq!(lines_of(&page).len(), 4, "three team moves, and where the robots were before");
    // The page of a run in a layout that was generated has the command that makes it again.
    let page = read(folder, "run.html");
    let again = film_of(&page)["again"]["command"].as_str().expect("a command").to_owned();
    let again: Vec<&str> = again.split(' ').skip(1).chain(["--force"]).collect();
    printed(folder, &again, 0);
    assert_eq!(read(folder, "run.html"), page, "{again:?}");
}

#[test]
fn what_is_wrong_with_the_command_line_is_said_with_a_remedy() {
    let folder = &folder();
    write(folder, "file", "");
    let wrong: [&[&str]; 48] = [
        &["explore", "open:9x9", "--robots", "0"],
        &["explore", "open:9x9", "--robots", "1"],
        &["explore", "open:9x9", "--robots", "257"],
        &["explore", "open:9x9", "--robots", "many"],
        &["explore", "open:9x9", "--base", "9,0"],
        &["explore", "open:9x9", "--base", "here"],
        &["explore", "open:9x9", "--max-moves", "0"],
        &["explore", "open:40000x40000"],
        &["explore", "open:9x9", "--scheme", "bricks", "--robots", "0"],
        &["explore", "open:9x9", "--scheme", "ants", "--robots", "256"],
        &["explore", "open:9x9", "--scheme", "bricks-ants", "--rule", "published"],
        &["explore", "open:9x9", "--scheme", "bricks", "--miss", "1.5"],
        &["explore", "open:9x9", "--scheme", "bricks", "--miss", "-0.1"],
        &["explore", "open:9x9", "--scheme", "bricks", "--miss", "NaN"],
        &["explore", "open:9x9", "--miss", "0.1"],
        &["explore", "open:9x9", "--start", "1,1", "--start", "2,2"],
        &["explore", "open:9x9", "--scheme", "bricks", "--start", "9,0"],
        &["explore", "open:9x9", "--scheme", "bricks", "--start", "1,1", "--start", "2,2", "--robots", "3"],
        &["explore", "open:9x9", "--scheme", "bricks", "--start", "1,1", "--base", "2,2"],
        &["explore", "open:9x9", "--scheme", "bricks", "--miss", "1"],
        &["hunt", "--max-misses", "2"],
        &["hunt", "--scheme", "bricks", "--max-walls", "2"],
        &["hunt", "--scheme", "bricks", "--max-misses", "256"],
        &["hunt", "--scheme", "bricks", "--robots", "0"],
        &["hunt", "--scheme", "bricks", "--robots", "3"],
        &["hunt", "--scheme", "bricks", "--size", "5x4"],
        &["hunt", "--scheme", "bricks", "--resume", "hunt.json"],
        &["hunt", "--scheme", "bricks", "--out", "file"],
        &["hunt", "--scheme", "bricks-ants", "--rule", "published"],
        &["explore", "nowhere.map"],
        &["explore", "open:9x9", "--trace", "nowhere/run.jsonl"],
        &["explore", "open:9x9", "--svg", "."],
        &["explore", "open:9x9", "--trace", "run", "--svg", "run"],
        &["explore", "open:9x9", "--trace", "run", "--svg", "nowhere/run"],
        &["explore", "open:9x9", "--robots", "-1"],
        &["rescue", "--wfr-at", "-1"],
        &["reproduce", "antenna-fig4", "--runs", "-1"],
        &["reproduce", "--format", "json", "nope"],
        &["hunt", "--out", "file"],
        &["hunt", "--out", "file"],
        &["hunt", "--robots", "65"],
        &["hunt", "--robots", "64", "--max-walls", "9"],
        &["hunt", "--robots", "2", "--max-walls", "13"],
        &["replay", "nowhere.jsonl"],
        &["minimise", "nowhere.jsonl"],
        &["minimise", "file", "--out", "file"],
        &["minimise", "file", "--clause", "CHAIN-4"],
        &["minimise"],
    ];
    assert_snapshot!("wrong_usage", refusals(folder, &[], &wrong));
    assert_eq!(names(folder), ["file"]);
}

#[test]
fn a_base_on_a_blocked_cell_is_refused_with_the_nearest_free_one() {
    let folder = &folder();
    let drawing = "tautline layout 1\n+--+--+\n|##   |\n+--+--+\n";
    write(folder, "layout", drawing);
    assert_snapshot!(refused(folder, &["explore", "layout", "--base", "0,0"]), @r#"
    Error: the base 0,0 is on a blocked cell; the nearest free cell is 1,0
     Help: put the base on 1,0
    "#);
    let starts =
        ["explore", "layout", "--scheme", "bricks", "--robots", "2", "--start", "1,0", "--start", "0,0"];
    assert_snapshot!(refused(folder, &starts), @r#"
    Error: the start 0,0 is on a blocked cell; the nearest free cell is 1,0
     Help: start on 1,0
    "#);
}

/// A ring of eight cells, and a part of three cells that is not connected with it.
const RING: &str = "\
tautline layout 1
+--+--+--+--+
|        |  |
+  +  +  +  +
|   ##   |  |
+  +  +  +  +
|        |  |
+--+--+--+--+
";

#[test]
fn agents_in_parts_that_are_not_connected_are_reported_part_by_part() {
    let folder = &folder();
    write(folder, "ring", RING);
    let starts = ["--robots", "3", "--start", "0,0", "--start", "3,1", "--start", "2,2"];
    let explore = |scheme: &'static str| [&["explore", "ring", "--scheme", scheme], &starts[..]].concat();
    assert_snapshot!("agents_in_two_parts", printed(folder, &explore("bricks"), 0));
    let bricks = json(folder, &explore("bricks"), 0);
    assert_snapshot!(bricks["components"],
        @r#"[{"cells":8,"explored":8,"robots":2,"terminated":true,"visited":8},{"cells":3,"explored":3,"robots":1,"terminated":true,"visited":3}]"#);
    assert_eq!((&bricks["cells"], &bricks["visited"]), (&11.into(), &11.into()));
    let ants = json(folder, &explore("ants"), 0);
    assert_snapshot!(ants["components"],
        @r#"[{"cells":8,"explored":8,"robots":2},{"cells":3,"explored":3,"robots":1}]"#);
    assert_eq!((ants.get("visited"), ants.get("terminated")), (None, None), "ants never know");
    // All is explored, and one is done while others have cells to go through.
    let starts = ["--robots", "3", "--start", "1,0", "--start", "2,0", "--start", "0,0"];
    let left = [&["explore", "open:4x1", "--scheme", "mdfs", "--rule", "published"], &starts[..]].concat();
    says(&printed(folder, &left, 1), &["BRICKS-4 is broken in team move 1"]);
    let one_part = json(folder, &["explore", "ring", "--scheme", "bricks", "--start", "3,0"], 0);
    assert_eq!((&one_part["cells"], one_part.get("components")), (&3.into(), None));
}

#[test]
fn a_run_of_agents_without_end_is_found_and_drawn() {
    let folder = &folder();
    write(folder, "ring", RING);
    let explore = ["explore", "ring", "--scheme", "bricks", "--rule", "published", "--robots", "1"];
    printed(folder, &[&explore[..], &["--trace", "run.jsonl"]].concat(), 1);
    assert_snapshot!(
        "endless_run_of_an_agent",
        printed(folder, &["replay", "run.jsonl", "--moves", "8..11"], 1)
    );
    let replayed = json(folder, &["replay", "run.jsonl"], 1);
    assert_eq!((&replayed["stopped"], &replayed["terminated"]), (&"endless".into(), &false.into()));
    let minimal = json(folder, &["minimise", "run.jsonl", "--out", "minimal"], 0);
    assert_eq!((&minimal["clause"], &minimal["after"]["robots"]), (&"BRICKS-6".into(), &1.into()));
}

#[test]
fn runs_of_agents_are_stored_and_replayed() {
    let folder = &folder();
    let starts = ["--robots", "2", "--start", "0,0", "--start", "4,2", "--miss", "0.2", "--seed", "3"];
    for scheme in ["ants", "bricks", "bricks-ants"] {
        let explore =
            [&["explore", "open:5x3", "--scheme", scheme, "--trace", "run.jsonl"], &starts[..]].concat();
        let explored = ran(folder, &explore);
        let replayed = ran(folder, &["replay", "run.jsonl"]);
        assert!(explored.status.code().is_some_and(|code| code < 2), "{scheme}");
        assert_eq!(replayed.status, explored.status, "{scheme}");
    }
    let explore = ["explore", "open:5x3", "--scheme", "bricks-ants", "--trace", "run.jsonl"];
    let page = ["--html", "run.html", "--svg", "order.svg"];
    printed(folder, &[&explore[..], &["--robots", "2", "--start", "4,2"], &page].concat(), 0);
    assert_snapshot!("frames_of_agents", printed(folder, &["replay", "run.jsonl"], 0));
    printed(folder, &["replay", "run.jsonl", "--svg", "last.svg"], 0);
    let drawn = read(folder, "last.svg");
    assert!(drawn.contains("class=\"sealed\"") && !drawn.contains("class=\"base\""));
    printed(folder, &[&explore[..], &starts[..]].concat(), 0);
    let run = read(folder, "run.jsonl");
    let cases = [
        ("no agent", run.replacen("\"robots\":2", "\"robots\":0", 1)),
        ("a start too few", run.replacen("[[0,0],[4,2]]", "[[0,0]]", 1)),
        ("a start outside", run.replacen("[[0,0],[4,2]]", "[[0,0],[5,2]]", 1)),
        ("no probability", run.replacen("\"miss\":0.2", "\"miss\":1.2", 1)),
        ("another probability", run.replacen("\"miss\":0.2", "\"miss\":0.3", 1)),
        ("a rule that nobody has published", run.replacen("repaired", "published", 1)),
        ("a chain that misses sensors", run.replacen("bricks-ants", "chain", 1)),
    ];
    let said = refused_texts(folder, &run, &cases, ["replay", "run.jsonl"]);
    assert_snapshot!("wrong_runs_of_agents", said);
}

#[test]
fn what_is_wrong_with_a_stored_run_is_said_with_its_place() {
    let folder = &folder();
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    let run = read(folder, "run.jsonl");
    let lines: Vec<&str> = run.split_inclusive('\n').collect();
    assert_snapshot!(run, @r#"
    {"format":"tautline run","version":1,"scheme":"chain","rule":"repaired","robots":2,"seed":0,"base":[1,1],"limits":{"until":null,"max_moves":null,"violation":"go-on"},"clause":null,"layout":"tautline layout 1\n+--+--+--+\n|        |\n+  +  +  +\n|   B    |\n+  +  +  +\n|        |\n+--+--+--+\n"}
    {"move":{"step":1,"kind":"advance","tried":".E","blocked":[],"cells":[[1,1],[2,1]]}}
    {"move":{"step":2,"kind":"advance","tried":".S","blocked":[],"cells":[[1,1],[2,2]]}}
    {"move":{"step":3,"kind":"advance","tried":".W","blocked":[],"cells":[[1,1],[1,2]]}}
    {"move":{"step":4,"kind":"advance","tried":".W","blocked":[],"cells":[[1,1],[0,2]]}}
    {"move":{"step":5,"kind":"advance","tried":".N","blocked":[],"cells":[[1,1],[0,1]]}}
    {"move":{"step":6,"kind":"advance","tried":".N","blocked":[],"cells":[[1,1],[0,0]]}}
    {"move":{"step":7,"kind":"advance","tried":".E","blocked":[],"cells":[[1,1],[1,0]]}}
    {"move":{"step":8,"kind":"advance","tried":".E","blocked":[],"cells":[[1,1],[2,0]]}}
    {"end":{"stopped":"explored","steps":8,"explored":9,"cells":9,"violations":[]}}
    "#);
    let cases = [
        ("no bytes", String::new()),
        ("cut after the header", lines[..1].concat()),
        ("cut before the end", lines[..9].concat()),
        ("cut within a line", run[..run.len() / 2].to_owned()),
        ("another version", run.replacen("\"version\":1", "\"version\":2", 1)),
        ("another format", run.replacen("tautline run", "another run", 1)),
        ("no JSON", run.replacen("{\"move\"", "move", 1)),
        ("an unknown field", run.replacen("\"seed\":0", "\"seed\":0,\"mood\":1", 1)),
        ("an unknown kind", run.replacen("advance", "dance", 1)),
        ("another step", run.replacen("\"tried\":\".E\"", "\"tried\":\".W\"", 1)),
        ("a wrong count", run.replacen("\"steps\":8", "\"steps\":7", 1)),
        ("a line twice", [&lines[..3].concat(), lines[2], lines[3]].concat()),
        ("a line after the end", run.clone() + "{}\n"),
        ("too many robots", run.replacen("\"robots\":2", "\"robots\":999", 1)),
        ("another base", run.replacen("\"base\":[1,1]", "\"base\":[0,1]", 1)),
        ("a broken drawing", run.replacen("+--+--+--+", "+--+-?+--+", 1)),
        ("an unknown rule", run.replacen("\"rule\":\"repaired\"", "\"rule\":\"wanders\"", 1)),
        ("a clause that no run can break", run.replacen("\"clause\":null", "\"clause\":\"CHAIN-7\"", 1)),
        ("a clause that no run can stop at", run.replacen("\"go-on\"", "{\"stop-at\":\"CHAIN-7\"}", 1)),
        ("a clause that it does not break", run.replacen("\"clause\":null", "\"clause\":\"CHAIN-1\"", 1)),
    ];
    let said = cases.map(|(what, text)| {
        write(folder, "run.jsonl", text);
        let refusal = refused(folder, &["replay", "run.jsonl"]);
        // What is no run might have been a rescue, which can be replayed and not minimised.
        let is_foreign = ["no bytes", "another format"].contains(&what);
        assert_eq!(refused(folder, &["minimise", "run.jsonl"]) != refusal, is_foreign, "{what}");
        format!("{what}\n{refusal}\n")
    });
    assert_snapshot!("wrong_runs", said.join("\n"));
    write(folder, "run.jsonl", b"\xff\xfe");
    assert_snapshot!(refused(folder, &["replay", "run.jsonl"]), @r#"
    Error: this is not UTF-8 text
       ╭─[ run.jsonl:1:1 ]
       │
     1 │ ��
       │ ┬
       │ ╰── here
       │
       │ Help: name a file that `tautline explore --trace`, `tautline rescue --trace`, `tautline hunt`, `tautline minimise` or `tautline prove --out` wrote
    ───╯
    "#);
}

#[test]
fn a_run_on_a_map_shrinks_to_one_that_replays() {
    let folder = &folder();
    let explore = ["explore", "walls:15x15:0.15", "--seed", "41", "--robots", "8", "--rule", "published"];
    printed(folder, &[&explore[..], &["--trace", "run.jsonl"]].concat(), 1);
    assert_snapshot!("minimal_run", printed(folder, &["minimise", "run.jsonl"], 0));
    assert_eq!(names(folder), ["chain-1-published-n5.jsonl", "run.jsonl"]);
    let stored = fs::read(folder.join("chain-1-published-n5.jsonl")).expect("a run");
    let replayed = json(folder, &["replay", "chain-1-published-n5.jsonl"], 1);
    assert_eq!(replayed["counterexample_to"], "CHAIN-1");
    // It does not take the place of what it is made from, but stands beside it; elsewhere it is the same again.
    let told = printed(folder, &["minimise", "chain-1-published-n5.jsonl"], 0);
    assert!(told.contains("No robot, column, row, blocked cell or wall can go"), "{told}");
    assert!(told.contains("replay it with: tautline replay chain-1-published-n5-minimal.jsonl"), "{told}");
    assert_eq!(fs::read(folder.join("chain-1-published-n5-minimal.jsonl")).expect("a run"), stored);
    fs::create_dir(folder.join("again")).expect("a folder");
    let again = json(folder, &["minimise", "chain-1-published-n5.jsonl", "--out", "again"], 0);
    assert_eq!(again["before"], again["after"]);
    assert_snapshot!(again["after"], @r#"{"blocked":0,"columns":4,"robots":5,"rows":4,"steps":7,"walls":2}"#);
    assert_eq!(fs::read(folder.join("again/chain-1-published-n5.jsonl")).expect("a run"), stored);
    assert_eq!(fs::read(folder.join("chain-1-published-n5.jsonl")).expect("a run"), stored);
}

#[test]
fn a_refutation_shrinks_to_one_of_the_same_clause() {
    let folder = &folder();
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for clause in ["KIT-1", "KIT-2", "KIT-3", "KIT-6", "KIT-7"] {
        let file = docs.join(format!("{}-published.jsonl", clause.to_lowercase()));
        let minimal = json(folder, &["minimise", file.to_str().expect("a path"), "--force"], 0);
        assert_eq!(minimal["clause"], clause);
        assert!(minimal["after"]["steps"].as_u64() <= minimal["before"]["steps"].as_u64(), "{minimal}");
    }
}

#[test]
fn a_run_that_breaks_nothing_cannot_be_minimised() {
    let folder = &folder();
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    assert_snapshot!(refused(folder, &["minimise", "run.jsonl"]), @r#"
    Error: run.jsonl: this run breaks no clause: there is nothing to minimise
     Help: name a counterexample of `tautline hunt`, or a trace of a run that ended `tautline explore` with exit code 1
    "#);
    let crowded = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/chain-2-published-n4.jsonl");
    fs::copy(crowded, folder.join("crowded.jsonl")).expect("a file");
    assert_snapshot!(refused(folder, &["minimise", "crowded.jsonl", "--clause", "chain-1"]), @r#"
    Error: crowded.jsonl: this run does not break CHAIN-1: there is nothing to minimise
     Help: it breaks CHAIN-2
    "#);
    assert_eq!(names(folder), ["crowded.jsonl", "run.jsonl"]);
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_minimising_with_nothing_stored() {
    let folder = &folder();
    let explore = ["explore", "walls:127x127:0.05", "--seed", "3", "--robots", "64", "--rule", "published"];
    printed(folder, &[&explore[..], &["--max-moves", "200", "--trace", "run.jsonl"]].concat(), 1);
    assert_eq!(interrupted(folder, &["minimise", "run.jsonl"]), Some(3));
    assert_eq!(names(folder), ["run.jsonl"]);
}

/// Three robots, three WFRs, one message in ten lost on each link, one robot failing.
const RESCUE: [&str; 9] = ["rescue", "--wfr", "3", "--robots", "3", "--loss", "0.1", "--failing", "1"];

#[test]
fn a_rescue_is_told_event_by_event() {
    let folder = &folder();
    assert_snapshot!("rescue_of_one_wfr", printed(folder, &["rescue", "--seeds", "0"], 0));
    let published = [&RESCUE[..], &["--rule", "published", "--seeds", "8"]].concat();
    assert_snapshot!("rescue_published", printed(folder, &published, 1));
    let twice = ["rescue", "--events", "2", "--rule", "published", "--seeds", "0"];
    assert_snapshot!("rescue_of_two_events", printed(folder, &twice, 1));
    let lake = ["--obstacle", "100,100,200,200", "--robot", "20,150", "--robot", "90.5,1", "--wfr-at", "350"];
    let told = json(folder, &[&["rescue", "--seeds", "7"], &lake[..]].concat(), 0);
    assert_eq!((&told["robots"], &told["wfrs"]), (&2.into(), &1.into()));
    assert_eq!(told["events"][0]["calls"]["node"], 350);
    let events = told["events"].as_array().expect("a list");
    assert_eq!(events.iter().filter(|event| !event["arrives"].is_null()).count(), 1, "one robot comes");
}

#[test]
fn rescues_are_counted_and_judged() {
    let folder = &folder();
    assert_snapshot!("rescues", printed(folder, &[&RESCUE[..], &["--seeds", "0..19"]].concat(), 0));
    let published = [&RESCUE[..], &["--seeds", "0..19", "--rule", "published"]].concat();
    assert_snapshot!("rescues_published", printed(folder, &published, 1));
    let shadows = ["--seeds", "0..19", "--shadowing-db", "4", "--exponent", "3", "--noise-db", "1"];
    assert_snapshot!("rescues_under_shadows", printed(folder, &[&RESCUE[..], &shadows].concat(), 0));
    let counted = json(folder, &published, 1);
    assert_snapshot!(counted["assignments"],
        @r#"{"cut_off":0,"events":60,"never":12,"served_more_often":0,"served_once":48,"still_to_come":0,"unheard":0,"wfrs":60}"#);
    assert_snapshot!(counted["violations"],
        @r#"[{"at_s":0.291420312,"clause":"MRC-1","event":1,"rescues":1,"seed":1,"wfr":3},{"at_s":0.01635954,"clause":"MRC-4","event":1,"rescues":20,"seed":0,"wfr":3},{"at_s":125.692057474,"clause":"MRC-5","event":1,"rescues":12,"seed":0,"wfr":2}]"#);
    assert_eq!(counted.get("events"), None);
    let thrice = [&RESCUE[..], &["--seeds", "0..9", "--events", "3"]].concat();
    assert_eq!(json(folder, &thrice, 0)["assignments"]["served_once"], 90);
    let published = [&thrice[..], &["--rule", "published"]].concat();
    assert_snapshot!("rescues_of_three_events", printed(folder, &published, 1));
    let schemes = ["flooding", "counter", "distance", "sba"].map(|scheme| {
        let arguments =
            [&RESCUE[..], &["--seeds", "0..4", "--channel", "shared", "--scheme", scheme]].concat();
        let counted = json(folder, &arguments, 0);
        format!("{scheme} {} {}", counted["assignments"]["served_once"], counted["rebroadcasts"]["mean"])
    });
    assert_snapshot!(schemes.join("\n"), @r"
    flooding 15 698.4
    counter 15 198.27
    distance 15 115.33
    sba 15 295.0
    ");
}

#[test]
fn a_rescue_is_stored_played_and_drawn() {
    let folder = &folder();
    let published = [&RESCUE[..], &["--rule", "published", "--seeds", "8", "--channel", "shared"]].concat();
    let files = ["--trace", "r.jsonl", "--html", "r.html", "--svg", "r.svg"];
    let told = printed(folder, &[&published[..], &files].concat(), 1);
    assert_eq!(
        printed(folder, &["replay", "r.jsonl", "--html", "again.html", "--svg", "again.svg"], 1),
        told
    );
    let read = |name: &str| read(folder, name);
    assert_eq!((read("r.html"), read("r.svg")), (read("again.html"), read("again.svg")));
    let (page, run) = (read("r.html"), read("r.jsonl"));
    let events = run.lines().count() - 2;
    assert_eq!(lines_of(&page).len(), 1 + events);
    assert_eq!(film_of(&page)["board"]["callers"].as_array().map(Vec::len), Some(3));
    assert_eq!(read("r.svg").matches("class=\"wfr\"").count(), 4, "three, and the legend");
    for number in 1..=3 {
        let text = format!(">{number}</text>");
        assert_eq!(read("r.svg").matches(&text).count(), 1);
    }
    // What was stored before there were several events, and shadows.
    let older = ["\"events_per_wfr\":1,", "\"shadowing_db\":0.0,", "\"exponent\":2.0,"]
        .iter()
        .fold(run.clone(), |run, field| run.replacen(field, "", 1));
    assert_eq!(older.len() + 53, run.len());
    write(folder, "older.jsonl", older);
    assert_eq!(printed(folder, &["replay", "older.jsonl"], 1), told);
    let events = ["--events", "2", "--trace", "twice.jsonl", "--html", "twice.html"];
    let told = printed(folder, &[&published[..], &events].concat(), 1);
    assert_eq!(printed(folder, &["replay", "twice.jsonl", "--html", "twice again.html"], 1), told);
    assert_eq!(read("twice.html"), read("twice again.html"));
    assert!(read("twice.html").contains("event 2 happens at WFR"));
    let several = [&RESCUE[..], &["--seeds", "0..1", "--trace", "several.jsonl"]].concat();
    let cases = [
        ("no seed", run.replacen("\"seed\":8,", "", 1)),
        ("another seed", run.replacen("\"seed\":8,", "\"seed\":9,", 1)),
        ("another rule", run.replacen("published", "repaired", 1)),
        ("another version", run.replacen("\"version\":1", "\"version\":2", 1)),
        ("no field", run.replacen("\"range_m\":25.0", "\"range_m\":0.0", 1)),
        ("no event", run.replacen("\"events_per_wfr\":1", "\"events_per_wfr\":0", 1)),
        ("a robot nowhere", run.replacen("\"robots_at_m\":[]", "\"robots_at_m\":[[1.0,301.0]]", 1)),
        ("no decibels", run.replacen("\"noise_db\":0.0", "\"noise_db\":-1.0", 1)),
        ("an unknown field", run.replacen("\"k\":1", "\"k\":1,\"mood\":1", 1)),
        ("another hop", run.replacen("\"hops\":4", "\"hops\":5", 1)),
        ("cut", run.split_inclusive('\n').take(3).collect()),
        ("a line after the end", run.clone() + "{}\n"),
    ];
    let said = refused_texts(folder, &run, &cases, ["replay", "wrong.jsonl"]);
    assert_snapshot!("wrong_stored_rescues", said);
    assert_snapshot!(refused(folder, &several), @r"
    Error: several rescues do not fit into one file
     Help: give one seed, for example --seeds 0
    ");
    assert_snapshot!(refused(folder, &["replay", "r.jsonl", "--moves", "1..2"]), @r"
    Error: a rescue has no team moves
     Help: leave out --moves, or name a run of a team
    ");
    assert!(refused(folder, &["minimise", "r.jsonl"]).contains("name a \"tautline run\""));
    assert_eq!(
        names(folder),
        [
            "again.html",
            "again.svg",
            "older.jsonl",
            "r.html",
            "r.jsonl",
            "r.svg",
            "twice again.html",
            "twice.html",
            "twice.jsonl",
            "wrong.jsonl",
        ]
    );
}

#[test]
fn what_makes_no_rescue_is_refused_with_what_would_be_right() {
    let folder = &folder();
    let cases: [&[&str]; 35] = [
        &["--nodes", "0"],
        &["--nodes", "1"],
        &["--nodes", "2000000"],
        &["--nodes", "900000"],
        &["--nodes", "900000", "--wfr", "16"],
        &["--range", "0"],
        &["--range", "NaN"],
        &["--range", "1e308"],
        &["--area", "0x5"],
        &["--area", "5"],
        &["--k", "0"],
        &["--k", "8", "--scheme", "counter"],
        &["--wfr", "0"],
        &["--wfr", "3", "--nodes", "2"],
        &["--wfr-at", "700"],
        &["--wfr-at", "7", "--wfr-at", "7"],
        &["--events", "0"],
        &["--events", "17"],
        &["--events", "some"],
        &["--robots", "17"],
        &["--robot", "301,1"],
        &["--robot", "NaN,1"],
        &["--robot", "150,150", "--obstacle", "100,100,200,200"],
        &["--obstacle", "5,5,1,1"],
        &["--obstacle", "1,2,3"],
        &["--loss", "1.5"],
        &["--loss", "a tenth"],
        &["--noise-db", "-1"],
        &["--shadowing-db", "-1"],
        &["--shadowing-db", "21"],
        &["--exponent", "1.9"],
        &["--exponent", "NaN"],
        &["--exponent", "steep"],
        &["--failing", "2"],
        &["--failing-nodes", "700"],
    ];
    let said = cases.map(|arguments| {
        format!("{}\n{}\n", arguments.join(" "), refused(folder, &[&["rescue"], arguments].concat()))
    });
    assert_snapshot!("wrong_rescues", said.join("\n"));
    let seeds = ["", "5..4", "..4", "1..", "a", "0..1000000"]
        .map(|seeds| format!("{seeds:?}\n{}\n", refused(folder, &["rescue", "--seeds", seeds])));
    assert_snapshot!("wrong_seeds", seeds.join("\n"));
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_rescues() {
    let folder = &folder();
    assert_eq!(interrupted(folder, &["rescue", "--seeds", "0..999999"]), Some(3));
}

#[test]
fn every_command_has_help_with_examples() {
    let folder = &folder();
    let commands = "prove library schemes explore hunt minimise rescue locate replay check conform judge page show \
                    reproduce merge completions man";
    for command in commands.split(' ') {
        let help = printed(folder, &[command, "--help"], 0);
        assert!(help.contains("Example"), "{command}");
        assert_snapshot!(format!("help_{command}"), help);
    }
    assert_snapshot!("help", printed(folder, &["--help"], 0));
}

#[test]
fn completions_and_the_manual_pages_are_printed_and_stored() {
    let folder = &folder();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = printed(folder, &["completions", shell], 0);
        assert!(script.contains("tautline") && script.contains("hunt"), "{shell}");
    }
    assert_eq!(printed(folder, &["man", "--out", "man1"], 0), "");
    let stored = names(&folder.join("man1"));
    let of_tables = stored.iter().filter(|name| name.starts_with("tautline-reproduce-")).count();
    assert_eq!((stored.len(), of_tables), (1 + 19 + 30, 30), "{stored:?}");
    for name in stored {
        let page = read(&folder.join("man1"), &name);
        let title = name.strip_suffix(".1").expect("section 1");
        let end = "Where several apply, the code is the first of 70, 2, 4, 3, 1, 0.";
        assert!(page.contains(&format!(".TH {title} 1 ")), "{name}");
        assert!(page.contains(".SH \"EXIT STATUS\"\n0 as expected") && page.contains(end), "{name}");
        let tables = title.strip_prefix("tautline-reproduce-").map(|table| vec!["reproduce", table]);
        let command = tables.unwrap_or_else(|| title.split('-').skip(1).collect());
        assert_eq!(printed(folder, &[&["man"], &command[..]].concat(), 0), page);
    }
    let wrong: [&[&str]; 5] = [
        &["man", "dance"],
        &["man", "reproduce", "fig99"],
        &["man", "show", "rooms-a"],
        &["man", "--out", "man1/tautline.1"],
        &["man", "show", "--out", "man1"],
    ];
    assert_snapshot!("wrong_manuals", refusals(folder, &[], &wrong));
}

/// The log of a program that ends with `code`.
fn logged(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = ran(folder, arguments);
    let log = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {log}");
    log
}

#[test]
fn with_v_every_command_says_what_it_read_and_how_long_it_took() {
    let folder = &folder();
    let run: &[&str] = &["explore", "walls:15x15:0.15", "--seed", "41", "--rule", "published"];
    printed(folder, &[run, &["--trace", "run.jsonl"]].concat(), 1);
    let cases: [(&[&str], i32, &str); 11] = [
        (&["prove", "LATTICE-1"], 0, "LATTICE-1 published exhaustive: "),
        (run, 1, "layout walls:15x15:0.15: 15x15 cells, 225 free; walls between them: 65"),
        (&["hunt", "--robots", "2", "--max-walls", "1"], 0, "hunted through "),
        (&["minimise", "run.jsonl"], 0, "minimised in "),
        (&["rescue", "--seeds", "0..1"], 0, "rescuing: 2 of 2 in "),
        (&["rescue", "--seeds", "0"], 0, "the rescue with seed 0 has "),
        (&["replay", "run.jsonl"], 1, "reading run.jsonl: "),
        (&["show", "rooms-a"], 0, "layout rooms-a: 15x15 cells, 225 free; walls between them: 39"),
        (&["reproduce", "repair-cost", "--runs", "1"], 0, "comparing: 7 of 7 in "),
        (&["completions", "bash"], 0, ""),
        (&["man"], 0, ""),
    ];
    for (arguments, code, said) in cases {
        let log = logged(folder, &[arguments, &["-v"]].concat(), code);
        let end = format!("{}: exit code {code} after ", arguments[0]);
        assert!(log.contains(said) && log.contains(&end) && !log.contains("DEBUG"), "{arguments:?}: {log}");
    }
}

/// The program with so few processes and threads that it can start no more.
#[cfg(target_os = "linux")]
fn alone(folder: &Path, arguments: &[&str]) -> Command {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(folder, fs::Permissions::from_mode(0o755)).expect("our own folder");
    let program = folder.join("tautline");
    fs::copy(env!("CARGO_BIN_EXE_tautline"), &program).expect("room");
    let user = Command::new("id").arg("-u").output().expect("id runs").stdout;
    // Root has no such limit.
    let nobody: &[&str] = &["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"];
    let others: &[&str] = if user == b"0\n" { nobody } else { &[] };
    let limited = [others, &["prlimit", "--nproc=1"]].concat();
    let mut command = Command::new(limited[0]);
    command.args(&limited[1..]).arg(program).args(arguments).env("NO_COLOR", "1");
    command
}

#[cfg(target_os = "linux")]
#[test]
fn where_no_thread_can_be_started_the_work_is_done_without() {
    let folder = &folder();
    let table = ["reproduce", "repair-cost", "--runs", "2"];
    let output = alone(folder, &table).output().expect("prlimit runs");
    let errors = String::from_utf8(output.stderr).expect("text");
    assert_snapshot!(errors.lines().next().unwrap_or_default(),
        @" WARN the system starts no thread: Ctrl-C will end the work at once");
    assert!(errors.contains("the system starts no more threads: 1 instead of "), "{errors}");
    assert_eq!(output.status.code(), Some(0), "{errors}");
    let told = String::from_utf8(output.stdout).expect("text");
    assert_eq!(told, printed(folder, &table, 0));
}

#[test]
fn a_hundred_thousand_threads_are_as_many_as_make_sense() {
    let folder = &folder();
    let table = ["reproduce", "repair-cost", "--runs", "2"];
    let output = tautline(folder, &table).env("RAYON_NUM_THREADS", "100000").output();
    let output = output.expect("the program runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("RAYON_NUM_THREADS asks for 100000 threads; "), "{errors}");
    assert_eq!(String::from_utf8_lossy(&output.stdout), printed(folder, &table, 0));
}

#[test]
fn an_option_that_can_have_no_effect_is_refused() {
    let folder = &folder();
    write(folder, "ring", RING);
    let wrong: [&[&str]; 25] = [
        &["library", "--memory", "1GiB"],
        &["library", "--patience", "3"],
        &["explore", "ring", "--seed", "1"],
        &["explore", "open:9x9", "--seed", "0"],
        &["explore", "rooms-a", "--scheme", "bricks", "--seed", "7"],
        &["explore", "rooms-a", "--scheme", "bricks", "--miss", "0", "--seed", "7"],
        &["explore", "rooms-a", "--image", "map.pgm"],
        &["explore", "open:9x9", "--miss", "0"],
        &["explore", "open:9x9", "--start", "1,1"],
        &["explore", "open:9x9", "--format", "json", "--draw", "order"],
        &["show", "ring", "--seed", "1"],
        &["show", "environments", "--seed", "1"],
        &["show", "environments", "--image", "map.pgm"],
        &["rescue", "--scheme", "flooding", "--k", "1"],
        &["rescue", "--scheme", "distance", "--k", "2"],
        &["explore", "open:4x4", "--scheme", "frontier", "--robots", "2", "--threshold", "0.4"],
        &["explore", "open:4x4", "--scheme", "frontier", "--robots", "2", "--anchors", "5"],
        &["explore", "open:4x4", "--scheme", "frontier", "--robots", "2", "--readings", "5"],
        &["explore", "open:4x4", "--scheme", "frontier", "--robots", "2", "--readings", "0"],
        &["explore", "open:4x4", "--scheme", "frontier", "--robots", "1", "--loss", "0.1"],
        &["explore", "open:4x4", "--scheme", "kit", "--robots", "1", "--range", "4"],
        &["hunt", "--scheme", "frontier", "--robots", "1", "--size", "2x1", "--max-losses", "1"],
        &["hunt", "--scheme", "kit", "--robots", "1", "--size", "2x1", "--range", "4"],
        &["locate", "--noise-db", "0", "--at", "3,3", "--seed", "1"],
        &["judge", "log.csv", "--clauses", "CHAIN-2", "--map", "open:9x9", "--seed", "1"],
    ];
    assert_snapshot!("needless_options", refusals(folder, &[], &wrong));
    // Where they matter they are taken.
    write(folder, "log.csv", "time,robot,x,y\n0,a,1.5,1.5\n0,b,3.5,1.5\n");
    let frontier = ["explore", "open:4x4", "--scheme", "frontier", "--robots", "2"];
    let wheels = [&frontier[..], &["--odometry", "0.001:0.1", "--readings", "0"]].concat();
    let noise = [&frontier[..], &["--noise-db", "0.1", "--anchors", "5", "--readings", "50"]].concat();
    let right: [&[&str]; 9] = [
        &wheels,
        &noise,
        &["locate", "--noise-db", "0", "--at", "3,3", "--seed", "1", "--solver", "pso", "--runs", "10"],
        &["judge", "log.csv", "--clauses", "CHAIN-2", "--map", "walls:9x9:0.1", "--seed", "1"],
        &["explore", "walls:3x3:0.1", "--seed", "0"],
        &["explore", "ring", "--scheme", "ants", "--miss", "0.1", "--seed", "3"],
        &["explore", "open:3x3", "--format", "json", "--draw", "moves", "--svg", "moves.svg"],
        &["show", "office:9x9:2x2", "--seed", "1"],
        &["rescue", "--seeds", "0", "--scheme", "counter", "--k", "2"],
    ];
    for arguments in right {
        printed(folder, arguments, 0);
    }
}

#[test]
fn a_failure_that_never_happens_is_a_warning() {
    let folder = &folder();
    for (option, word, is_late) in [
        ("--fail", "3@500", true),
        ("--wall", "2,2,E@500", true),
        ("--fail", "3@5", false),
        ("--wall", "2,2,E@5", false),
    ] {
        let output = ran(folder, &["explore", "open:7x7", "--robots", "3", option, word]);
        let errors = String::from_utf8(output.stderr).expect("text");
        let warning = format!("{option} never happened: it is for team move 500");
        assert_eq!((output.status.code(), errors.contains(&warning)), (Some(0), is_late), "{word}: {errors}");
    }
}

#[test]
fn what_is_wrong_is_said_without_the_words_of_programs() {
    let folder = &folder();
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    for (name, text) in [("list.jsonl", "[]\n"), ("cut.jsonl", "{\"format\":\n")] {
        write(folder, name, text);
    }
    write(folder, "latin.csv", b"time,robot,x,y\n0,caf\xe9,1,2\n");
    fs::create_dir(folder.join("dir")).expect("a folder");
    printed(folder, &["library", "rmf-lane", "--plan", "plan.json", "--shards", "1"], 0);
    let wrong: [&[&str]; 20] = [
        &["replay", "list.jsonl"],
        &["replay", "cut.jsonl"],
        &["check", "dir"],
        &["judge", "dir", "--clauses", "CHAIN-3"],
        &["locate", "dir"],
        &["judge", "latin.csv", "--clauses", "CHAIN-3"],
        &["merge", "plan.json", "--picture", "radii", "radii.svg"],
        &["merge", "plan.json", "--csv", "values.csv"],
        &["explore", "open:3x3", "--robots", "2", "--trace", "-"],
        &["prove", "NOTICE-4", "--out", "-"],
        &["replay", "run.jsonl", "--moves", "0..1"],
        &["replay", "run.jsonl", "--moves", "-1..1"],
        &["replay", "run.jsonl", "--moves", "3..2"],
        &["rescue", "--seeds", "-1..3"],
        &["hunt", "--size", "-1x3"],
        &["hunt", "--robots", "-1"],
        &["explore", "open:3x3", "--seed", "-1"],
        &["explore", "open:3x3", "--fail", "-1@3"],
        &["locate", "--runs", "-1"],
        &["explore", "open:3x3", "--scheme", "kit", "--robots", "2", "--rule", "nearer"],
    ];
    let said = refusals(folder, &[], &wrong);
    for word in [
        "os error",
        "struct ",
        "EOF",
        "expected u",
        "..=",
        "digit found",
        "unexpected argument",
        "covered-shared",
    ] {
        assert!(!said.contains(word), "{word}: {said}");
    }
    assert_snapshot!("wrong_in_plain_words", said);
    assert_eq!(names(folder), ["cut.jsonl", "dir", "latin.csv", "list.jsonl", "plan.json", "run.jsonl"]);
}

#[test]
fn one_is_not_many() {
    let folder = &folder();
    let said = |arguments: &[&str], code| {
        let text = printed(folder, arguments, code);
        let lines: Vec<&str> = text.lines().take(4).collect();
        format!("$ tautline {}\n{}\n", arguments.join(" "), lines.join("\n"))
    };
    let said = [
        said(&["explore", "open:1x1", "--robots", "2"], 0),
        said(&["explore", "open:1x2", "--scheme", "bricks", "--robots", "1"], 0),
        said(&["explore", "open:3x3", "--robots", "2", "--max-moves", "1"], 0),
        said(&["hunt", "--robots", "2", "--max-walls", "1"], 0),
        said(&["reproduce", "repair-cost", "--runs", "1"], 0),
        said(&["reproduce", "notice-fig5", "--nodes", "20", "--runs", "1"], 0),
        said(&["reproduce", "rescue-fig8", "--robots", "1", "--wfr", "1", "--runs", "1"], 0),
        said(&["reproduce", "rescue-fig7", "--nodes", "300", "--runs", "1"], 0),
    ];
    assert_snapshot!("one_of_each", said.join("\n"));
}

#[test]
fn a_page_begins_with_all_robots_at_the_base_or_at_their_start() {
    let folder = &folder();
    let film = |arguments: &[&str], file: &str| {
        printed(folder, &[arguments, &["--html", file]].concat(), 0);
        film_of(&read(folder, file))
    };
    let chain = film(&["explore", "open:5x5", "--robots", "12"], "chain.html");
    assert_eq!(chain["board"]["start"], Value::from(vec![12; 12]));
    assert_eq!((&chain["robots"], &chain["has_base"]), (&12.into(), &true.into()));
    let agents = film(&["explore", "open:3x3", "--scheme", "ants", "--robots", "6"], "agents.html");
    assert_eq!(agents["board"]["start"], Value::from(vec![4; 6]));
    assert_eq!((&agents["robot"], &agents["has_base"]), (&"agent".into(), &false.into()));
}

#[test]
fn a_byte_order_mark_before_a_text_is_no_part_of_it() {
    let folder = &folder();
    let marked = |name: &str| {
        let text = read(folder, name);
        write(folder, format!("marked-{name}"), format!("\u{feff}{text}"));
    };
    write(folder, "ring.txt", RING);
    write(folder, "two.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
    let map = "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n\
                negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    write(folder, "ros.yaml", map);
    write(folder, "map.pgm", b"P5 2 1 255 \xff\x00");
    for name in ["ring.txt", "two.map", "ros.yaml"] {
        marked(name);
        let shown = printed(folder, &["show", name], 0);
        assert_eq!(printed(folder, &["show", &format!("marked-{name}")], 0), shown, "{name}");
    }
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    printed(folder, &["rescue", "--seeds", "0", "--trace", "rescue.jsonl"], 0);
    for name in ["run.jsonl", "rescue.jsonl"] {
        marked(name);
        printed(folder, &["replay", &format!("marked-{name}")], 0);
    }
    // What is wrong after it is where a person sees it.
    write(folder, "wrong.map", "\u{feff}type tile\n");
    write(folder, "wrong.yaml", format!("\u{feff}{}", map.replace("0.1", "-1")));
    write(folder, "wrong.jsonl", "\u{feff}{\"format\":\"a run\",\"version\":1}\n");
    let said = [&["show", "wrong.map"], &["show", "wrong.yaml"], &["replay", "wrong.jsonl"]]
        .map(|arguments| refused(folder, arguments));
    assert_snapshot!("wrong_after_a_byte_order_mark", said.join("\n\n"));
}

#[test]
fn a_bad_number_in_a_map_is_called_one_and_hints_keep_to_the_limits() {
    let folder = &folder();
    let map = "type octile\nheight 1\nwidth 3\nmap\n.@.\n";
    let maps = ["height -1", "height many", "height 99999999999999999999", "height", "high 1"].map(|line| {
        write(folder, "a.map", map.replace("height 1", line));
        format!("{line}\n{}\n", refused(folder, &["show", "a.map"]))
    });
    assert_snapshot!("bad_numbers_in_maps", maps.join("\n"));
    let wrong: [&[&str]; 12] = [
        &["explore", "open:9x9", "--robots", "99999999999999999999"],
        &["hunt", "--robots", "many"],
        &["hunt", "--max-walls", "-1"],
        &["hunt", "--size", "1x1", "--robots", "2", "--max-walls", "1"],
        &["rescue", "--nodes", "many"],
        &["rescue", "--exponent", "steep"],
        &["rescue", "--wfr", "5001", "--nodes", "5000"],
        &["rescue", "--wfr", "0", "--nodes", "2"],
        &["rescue", "--wfr", "1", "--wfr-at", "1", "--wfr-at", "2"],
        &["rescue", "--robots", "1", "--robot", "1,1", "--robot", "2,2"],
        &["rescue", "--failing-nodes", "2", "--nodes", "2"],
        &["explore", "open:9x9", "--scheme", "ants", "--robots", "1", "--start", "1,1", "--start", "2,2"],
    ];
    assert_snapshot!("hints_within_limits", refusals(folder, &[], &wrong));
    let places = (0..17).flat_map(|node| ["--wfr-at".to_owned(), node.to_string()]);
    let places: Vec<String> = ["rescue", "--wfr", "3"].map(str::to_owned).into_iter().chain(places).collect();
    assert_snapshot!(refused(folder, &places.iter().map(String::as_str).collect::<Vec<_>>()), @r"
    Error: more nodes are named (17) than are to call (3)
     Help: name at most 3 of them
    ");
}
