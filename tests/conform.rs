//! `tautline conform`: programs that are not this one, held to stored runs.
#![cfg(unix)]

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use insta::assert_snapshot;
use serde_json::Value;

use crate::cli::says;
use crate::folder::{folder, read};
use crate::recipes::{has, recipe};

/// The lines of a command on stdout and stderr, without blanks at their ends.
fn ended(folder: &Path, arguments: &[&str], code: i32) -> (String, String) {
    let text = |text: String| text.lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
    let (told, said) = crate::foreign::ended(folder, arguments, code);
    (text(told), text(said))
}

/// The answer of `conform` about a run that `explore` has made, and of a program.
fn conform(folder: &Path, run: &str, program: &[&str], code: i32) -> String {
    let stored = ["--force", "--trace", "run.jsonl", "--exit-zero"];
    let explore = ["explore"].into_iter().chain(run.split(' ')).chain(stored);
    ended(folder, &explore.collect::<Vec<_>>(), 0);
    ended(folder, &[&["conform", "run.jsonl", "--patience", "60", "--"], program].concat(), code).0
}

/// A program of the shell that answers each team move by the next of these lines.
fn recorded(lines: &[String]) -> String {
    let answers = lines.iter().map(|line| format!("read line; echo '{line}'\n"));
    format!("read line\n{}cat >/dev/null", answers.collect::<String>())
}

#[test]
fn a_chain_in_c_that_shares_no_code_plans_as_the_model_does() {
    if !has("cc", "--version") {
        return;
    }
    let folder = &folder();
    let compiled = Command::new("cc")
        .args(["-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o", "chain"])
        .arg(recipe("examples/conform/chain.c"))
        .current_dir(folder)
        .output()
        .expect("the compiler runs");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    for (run, moves) in [("chain-1-published-n4", 8), ("chain-2-published-n4", 7)] {
        let run = recipe(&format!("docs/{run}.jsonl"));
        let (told, said) = ended(folder, &["conform", run.to_str().expect("text"), "--", "./chain"], 0);
        assert!(
            told.ends_with(&format!("the program plans all {moves} team moves as the model does")),
            "{told}"
        );
        assert_eq!(said, "");
    }
    for (robots, seed) in (2..7).flat_map(|robots| (0..3).map(move |seed| (robots, seed))) {
        let run = format!("walls:9x8:0.15 --rule published --robots {robots} --seed {seed}");
        conform(folder, &run, &["./chain"], 0);
    }
    // The repaired rule is another one: the program says that it is none of its own.
    let run = ["explore", "open:5x5", "--robots", "3", "--trace", "repaired.jsonl"];
    ended(folder, &run, 0);
    let (_, said) = ended(folder, &["conform", "repaired.jsonl", "--", "./chain"], 2);
    assert_snapshot!(said, @r"
    chain: this is no published chain of 2 to 64 robots
    Error: ./chain: the program has ended (exit status: 2) before it answered team move 1
     Help: its own messages, if it has written any, stand above
    ");
}

#[test]
fn ants_in_python_that_prefer_west_to_south_are_told_where_they_differ() {
    if !has("python3", "--version") {
        return;
    }
    let folder = &folder();
    let ants = recipe("examples/conform/ants.py");
    let ants = ants.to_str().expect("text");
    for agents in 1..4 {
        let run = format!("cells:8x6:0.2 --scheme ants --rule published --robots {agents} --seed 3");
        conform(folder, &run, &["python3", ants], 0);
    }
    let run = "cells:5x4:0.2 --scheme ants --rule published --robots 2 --seed 7";
    assert_snapshot!(conform(folder, run, &["python3", ants, "NEWS"], 1), @r##"
        ants (published), 2 agents: run.jsonl
        the program plans 6 team moves as the model does, and differs in team move 7:
        robot 1: the model S, the program W

        1, 2, … are the agents, K× stands for K of them in one cell; · is explored, : explored and entered by nobody any more, ░░░ visited, ▒▒▒ sealed, ## blocked; ? is a sensor that an agent missed.

        model, move 7           program, move 7
        +---+---+---+---+---+   +---+---+---+---+---+
        |    ###  ·  1↓   · |   |    ###  ·  1←   · |
        +   +   +   +   +   +   +   +   +   +   +   +
        |         ·   ·  ###|   |         ·   ·  ###|
        +   +   +   +   +   +   +   +   +   +   +   +
        |###          ·   · |   |###          ·   · |
        +   +   +   +   +   +   +   +   +   +   +   +
        |        2↑   ·   · |   |        2↑   ·   · |
        +---+---+---+---+---+   +---+---+---+---+---+
        "##);
}

/// For runs that no program of the examples plans: what is told is whole, and the end is asked for where the team
/// knows it.
#[test]
fn what_was_recorded_of_a_run_conforms_to_it() {
    let folder = &folder();
    for (run, knows_its_end) in [
        ("walls:5x5:0.2 --robots 3", true),
        ("walls:5x5:0.2 --robots 3 --rule reel", true),
        ("walls:5x5:0.2 --robots 3 --max-moves 4", false),
        ("cells:5x5:0.2 --scheme bricks --robots 2", false),
        ("cells:5x5:0.2 --scheme helpers --robots 2", false),
    ] {
        conform(folder, run, &["true"], 2);
        let lines = read(folder, "run.jsonl");
        let moves = lines.lines().filter_map(|line| {
            let line: Value = serde_json::from_str(line).expect("JSON");
            let made = line.get("move")?;
            Some(format!(r#"{{"tried":{},"kind":{}}}"#, made["tried"], made["kind"]))
        });
        let mut moves: Vec<String> = moves.collect();
        assert!(moves.len() > 3, "{run}");
        let end = if knows_its_end { r#"{"done":true}"# } else { "" };
        moves.push(end.to_owned());
        conform(folder, run, &["sh", "-c", &recorded(&moves)], 0);
        if knows_its_end {
            // A team that is done too early, and one that is not done.
            let early = [&moves[..3], &[end.to_owned()]].concat();
            let told = conform(folder, run, &["sh", "-c", &recorded(&early)], 1);
            says(&told, &["differs in team move 4:", "has nothing left to do"]);
            *moves.last_mut().expect("an end") = r#"{"tried":"..."}"#.to_owned();
            let told = conform(folder, run, &["sh", "-c", &recorded(&moves)], 1);
            assert!(told.ends_with("the model has nothing left to do, the program plans ..."), "{told}");
        }
        let kinds = moves.iter().map(|line| line.replace("advance", "backtrack")).collect::<Vec<_>>();
        let told = conform(folder, run, &["sh", "-c", &recorded(&kinds)], 1);
        assert!(told.contains("the model plans an advance, the program a backtrack"), "{told}");
    }
}

#[test]
fn programs_that_do_not_answer_are_named_with_their_lines() {
    let run = recipe("docs/chain-1-published-n4.jsonl");
    let run = run.to_str().expect("text");
    let answer = |line: &str| recorded(&[r#"{"tried":"...S"}"#.to_owned(), line.to_owned()]);
    let cases = [
        ("dies", "echo 'no robots here' >&2; exit 3".to_owned()),
        ("closes its output", "exec >&-; exec sleep 9".to_owned()),
        ("is silent", "exec sleep 9".to_owned()),
        ("is no JSON", answer("E")),
        ("is another thing", answer(r#"{"step":2}"#)),
        ("is no answer", answer("{}")),
        ("has too few robots", answer(r#"{"tried":"E"}"#)),
        ("has another letter", answer(r#"{"tried":"...X"}"#)),
        ("has too long a line", "head -c 2000000 /dev/zero | tr '\\0' x".to_owned()),
        ("goes on for ever", "exec yes".to_owned()),
    ];
    let folder = &folder();
    let start = Instant::now();
    let said = cases.map(|(what, program)| {
        let conform = ["conform", run, "--patience", "1", "--", "sh", "-c", &program];
        let (told, said) = ended(folder, &conform, 2);
        assert_eq!(told, "", "{what}");
        // Each has its remedy, and its line is drawn.
        assert!(said.contains(" Help: ") && said.contains("╭─") == said.contains("╰── here"), "{said}");
        let is_told = |line: &&str| !line.contains(['│', '╯']) && !line.contains(" Help: ");
        let told: Vec<&str> = said.lines().filter(is_told).collect();
        format!("{what}: {}", told.join(" "))
    });
    assert!(start.elapsed() < Duration::from_secs(8), "a program was waited for: {:?}", start.elapsed());
    assert_snapshot!(said.join("\n"), @r##"
        dies: no robots here Error: sh: the program has ended (exit status: 3) before it answered team move 1
        closes its output: Error: sh: the program has closed its output before it answered team move 1
        is silent: Error: sh: the program has not answered team move 1 within 1 second
        is no JSON: Error: this does not answer team move 2: expected value    ╭─[ sh:2:1 ]
        is another thing: Error: this does not answer team move 2: unknown field `step`, expected one of `tried`, `kind`, `done`    ╭─[ sh:2:7 ]
        is no answer: Error: an answer has either `tried`, or `done`, which is true    ╭─[ sh:2:1 ]
        has too few robots: Error: "E" is no plan of the team: write one letter of E, S, W, N or . for each of 4 robots    ╭─[ sh:2:11 ]
        has another letter: Error: "...X" is no plan of the team: write one letter of E, S, W, N or . for each of 4 robots    ╭─[ sh:2:11 ]
        has too long a line: Error: this line has more than 1048576 bytes    ╭─[ sh:1:1 ]
        goes on for ever: Error: this does not answer team move 1: expected value    ╭─[ sh:1:1 ]
        "##);
}

#[test]
fn runs_of_which_no_program_could_know_enough_are_refused() {
    let folder = &folder();
    for run in [
        "walls:5x5:0.1 --scheme kit --robots 2",
        "cells:5x5:0.1 --scheme pack --robots 2",
        "cells:5x5:0.1 --scheme ants --miss 0.1",
        "open:5x5 --robots 3 --loss 0.1",
        "open:5x5 --robots 3 --rule reel --fail 2@3",
    ] {
        conform(folder, run, &["true"], 2);
        let (_, said) = ended(folder, &["conform", "run.jsonl", "--", "true"], 2);
        assert!(said.contains("no program could plan along"), "{run}: {said}");
    }
    let (_, said) = ended(folder, &["conform", "run.jsonl", "--", "./nothing"], 2);
    assert!(said.contains("no program could plan along"), "{said}");
    conform(folder, "open:5x5 --robots 3", &["./nothing"], 2);
    let (_, said) = ended(folder, &["conform", "run.jsonl", "--", "./nothing"], 2);
    assert!(said.starts_with("Error: the program ./nothing cannot be started"), "{said}");
}

#[test]
fn what_is_told_and_answered_is_as_the_schemas_say() {
    let folder = &folder();
    let tee = "tee told.jsonl | sed -u -n 's/.*\"step\".*/{\"tried\":\"..\"}/p'";
    for run in ["open:3x3 --scheme ants --robots 2", "open:3x3 --robots 2"] {
        conform(folder, run, &["sh", "-c", tee], 1);
        let told = read(folder, "told.jsonl");
        for line in told.lines() {
            crate::schema::check("conform-told", &serde_json::from_str(line).expect("JSON"), line);
        }
    }
    for answer in [r#"{"tried":"..","kind":"advance"}"#, r#"{"tried":".."}"#, r#"{"done":true}"#] {
        crate::schema::check("conform-answer", &serde_json::from_str(answer).expect("JSON"), answer);
    }
    for program in [tee, "sed -u -n 's/.*\"step\".*/{\"done\":true}/p'"] {
        let arguments = ["conform", "run.jsonl", "--format", "json", "--", "sh", "-c", program];
        let (told, _) = ended(folder, &arguments, 1);
        crate::schema::check("conform", &serde_json::from_str(&told).expect("JSON"), program);
    }
}
