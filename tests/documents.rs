//! SPEC.md, the README and the pages of docs/ say what the code says: the clauses' sentences, the ledger, the tables
//! and the pictures. Their links lead somewhere, and their commands answer.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::iter;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::commands::documents;
use crate::folder::{folder, read, write};
use crate::foreign;
use crate::proved::proved;
use crate::tidy::sources;
use insta::assert_snapshot;
use tautline_proofs::ledger;

fn document(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect("a document")
}

/// The text that the program prints in the project's folder, if it ends with `code`.
fn printed(arguments: &[&str], code: i32) -> String {
    foreign::ended(Path::new(env!("CARGO_MANIFEST_DIR")), arguments, code).0
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

/// The verdicts of a ledger: by clause, then by rule, in the order in which they stand there, each once.
fn verdicts(ledger: &str) -> BTreeMap<&str, Vec<(&str, Vec<&str>)>> {
    let mut all: BTreeMap<&str, Vec<(&str, Vec<&str>)>> = BTreeMap::new();
    for line in ledger.lines() {
        let [id, rule, _engine, cases, verdict, _mutants] = line.split_whitespace().collect::<Vec<_>>()[..]
        else {
            continue;
        };
        if cases.parse::<u64>().is_err() {
            continue;
        }
        let rules = all.entry(id).or_default();
        let place = rules.iter().position(|&(name, _)| name == rule).unwrap_or_else(|| {
            rules.push((rule, Vec::new()));
            rules.len() - 1
        });
        if !rules[place].1.contains(&verdict) {
            rules[place].1.push(verdict);
        }
    }
    all
}

#[test]
fn the_table_of_the_spec_has_the_verdicts_of_the_ledger() {
    let ledger = document("docs/ledger.md");
    let verdicts = verdicts(&ledger);
    let rows = ledger::clauses().map(|clause| {
        let (id, sentence) = (clause.id, clause.sentence);
        let rules = verdicts.get(id).unwrap_or_else(|| panic!("{id} is not in the ledger"));
        let rules: Vec<String> =
            rules.iter().map(|(rule, verdicts)| format!("{rule}: {}", verdicts.join(", "))).collect();
        format!("| [{id}](#{}) | {sentence} | {} |\n", id.to_lowercase(), rules.join("; "))
    });
    let table: String =
        iter::once("| clause | sentence | verdict |\n|---|---|---|\n".to_owned()).chain(rows).collect();
    shows("SPEC.md", &table);
}

/// The document shows the text byte for byte.
fn shows(name: &str, text: &str) {
    assert!(document(name).contains(text), "{name} shows something else, not\n{text}");
}

#[test]
fn the_theorems_of_the_page_are_those_of_the_audit() {
    let (audit, page) = (document("proofs/rocq/audit.expected"), document("docs/machine-checked.md"));
    let audit =
        audit.strip_suffix("Closed under the global context\n").expect("no theorem rests on an axiom");
    // Statements are indented, names are not.
    let (mut rest, mut count) = (audit.trim_end(), 0);
    while !rest.is_empty() {
        let end = rest.match_indices('\n').find(|&(at, _)| !rest[at + 1..].starts_with(' '));
        let (statement, others) = rest.split_at(end.map_or(rest.len(), |(at, _)| at));
        assert!(page.contains(&format!("\n{statement}\n")), "docs/machine-checked.md has not\n{statement}");
        (rest, count) = (others.trim_start(), count + 1);
    }
    assert!(count >= 40, "{count}");
}

/// The modules of Kani harnesses in a file of proofs: the name, the unwind, and the mutants, as a table's columns; and
/// how many mutants these are.
fn harnesses(file: &str, text: &str) -> Vec<(String, usize)> {
    let module = file.trim_end_matches(".rs").replace('/', "::");
    let macros = text.split("\nstep_checks! {").skip(1).filter_map(|text| text.split("\n}\n").next());
    let bodies = macros.flat_map(|text| text.split("        };\n"));
    let row = |body: &str| {
        let (head, mutants) = body.split_once(" mutants {")?;
        let name = head
            .lines()
            .rev()
            .find_map(|line| line.strip_prefix("    ").filter(|line| !line.starts_with(' ')))?;
        let (name, _) = name.split_once(':')?;
        let unwind = head.rsplit_once("unwind ")?.1.trim_end_matches(',');
        let mutants =
            mutants.lines().filter_map(|line| line.strip_prefix("            ")?.split_once(": \""));
        let mutants: Vec<String> = mutants.map(|(mutant, _)| format!("`{mutant}`")).collect();
        Some((format!("| `{module}::{name}` | {unwind} | {} |", mutants.join(", ")), mutants.len()))
    };
    bodies.filter_map(row).collect()
}

#[test]
fn the_harnesses_of_the_page_are_those_of_the_code() {
    let page = document("docs/kani.md");
    let files = sources("proofs/src");
    let rows: Vec<_> = files.iter().flat_map(|(file, text)| harnesses(file, text)).collect();
    for (row, _) in &rows {
        assert!(page.contains(row), "docs/kani.md has not\n{row}");
    }
    let (found, mutants) = (rows.len(), rows.iter().map(|(_, mutants)| mutants).sum::<usize>());
    let listed = page.lines().filter(|line| line.starts_with("| `")).count();
    assert_eq!(found, listed, "docs/kani.md lists harnesses that are not in the code");
    let said = format!("There are {found} harnesses that must be verified, and {mutants} mutants");
    assert!(page.contains(&said), "docs/kani.md does not say: {said}");
}

#[test]
fn the_exit_codes_of_the_documents_are_those_of_the_help() {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let help = printed(&["--help"], 0);
    let codes = help.split("\n\n").find(|part| part.starts_with("Exit codes:")).expect("exit codes");
    assert!(
        words(&document("docs/commands.md")).contains(&words(codes)),
        "docs/commands.md has others:\n{codes}"
    );
}

#[test]
fn the_ledger_and_the_chart_are_those_of_the_documents() {
    let all = &proved().told;
    let (ledger, stories) = all.split_once("\n\n").expect("a ledger, then counterexamples");
    for line in ledger.lines() {
        assert!(line.chars().count() <= 80, "wider than 80 columns: {line}");
    }
    assert_snapshot!("ledger", ledger);
    shows("docs/ledger.md", ledger);
    let screen = &stories[stories.rfind("\nscheme ").expect("a screen")..];
    assert!(screen.lines().count() <= 50, "{screen}");
    for line in screen.lines() {
        assert!(line.chars().count() <= 80, "wider than 80 columns: {line}");
    }
    assert_snapshot!("screen", screen);
    let (_, of_mrc_1) = stories.split_once("MRC-1 as published").expect("it is refuted");
    let (_, chart) = of_mrc_1.split_once("events.\n\n").expect("a chart");
    let (chart, _) = chart.split_once("\n\nreplay it with: ").expect("the next story");
    shows("docs/mrc.md", chart.trim_end());
}

#[test]
fn the_smallest_counterexamples_are_those_of_the_page() {
    let name = "all__smallest__nothing_is_smaller_than_the_smallest_counterexamples";
    let kept = document(&format!("proofs/tests/snapshots/{name}.snap"));
    let (_, table) = kept.split_once("\n---\n").expect("a head, then a table");
    shows("docs/smallest.md", table.trim_end());
}

#[test]
fn the_atlas_is_that_of_the_page() {
    let atlas = printed(&["reproduce", "atlas"], 0);
    assert_snapshot!("atlas", atlas);
    let (table, _) = atlas.split_once("\n\nlayouts:").expect("a table, then what it means");
    shows("docs/chain.md", table);
}

#[test]
fn the_robots_and_radios_of_the_chain_are_those_of_the_page() {
    for table in ["chain-fig4", "chain-radio"] {
        shows("docs/rivals.md", &printed(&["reproduce", table], 0));
    }
}

#[test]
fn the_reach_of_broadcasts_is_that_of_the_page() {
    shows("docs/notice.md", &printed(&["reproduce", "notice-fig5"], 0));
}

#[test]
fn the_ways_of_robots_are_those_of_the_page() {
    shows("docs/tan.md", &printed(&["reproduce", "rescue-fig7"], 0));
}

#[test]
fn the_margins_of_contact_are_those_of_the_page() {
    shows("docs/kit.md", &printed(&["reproduce", "margins"], 0));
}

#[test]
fn the_errors_of_positions_are_those_of_the_page() {
    for table in ["locate-fig8", "locate-convergence"] {
        shows("docs/position.md", &printed(&["reproduce", table], 0));
    }
    for solver in ["closed-form", "pso", "least-squares", "decibel"] {
        shows("docs/position.md", &printed(&["locate", "--solver", solver], 0));
    }
    shows("docs/position.md", &printed(&["locate", "--noise-db", "0.25", "--advice"], 0));
}

#[test]
#[ignore = "minutes: cargo test --release --test all take_minutes -- --ignored"]
fn the_tables_that_take_minutes_are_those_of_the_pages() {
    for (page, table) in [
        ("docs/reel.md", "reel"),
        ("docs/rivals.md", "chain-table1"),
        ("docs/rivals.md", "chain-fig3"),
        ("docs/chain.md", "optimum"),
        ("docs/chain.md", "repair-cost --runs 10000"),
    ] {
        let arguments: Vec<&str> = ["reproduce"].into_iter().chain(table.split(' ')).collect();
        shows(page, &printed(&arguments, 0));
    }
}

#[test]
fn a_thousand_rescues_are_those_of_the_page() {
    let rescues =
        ["rescue", "--wfr", "3", "--robots", "3", "--loss", "0.1", "--failing", "1", "--seeds", "0..999"];
    shows("docs/rescue.md", &printed(&rescues, 0));
}

#[test]
fn the_pictures_are_drawn_by_the_commands_beside_them() {
    let folder = &folder();
    for (page, picture, arguments, code) in [
        ("docs/chain.md", "environments.svg", "show environments --svg", 0),
        ("docs/chain.md", "move.svg", "replay docs/open-7x7.jsonl --moves 5..5 --svg", 0),
        ("docs/chain.md", "spiral.svg", "explore open:15x15 --robots 8 --draw order --svg", 0),
        ("docs/rivals.md", "trajectories-open.svg", "reproduce chain-fig4 --svg-open", 0),
        ("docs/rivals.md", "trajectories-obstacles.svg", "reproduce chain-fig4 --svg-obstacles", 0),
        ("docs/notice.md", "notice-reach.svg", "reproduce notice-fig5 --svg-reach", 0),
        ("docs/notice.md", "notice-rebroadcasts.svg", "reproduce notice-fig5 --svg-rebroadcasts", 0),
        ("docs/tan.md", "walked.svg", "reproduce rescue-fig7 --svg", 0),
        ("docs/tan.md", "ways.svg", "reproduce rescue-fig6 --svg", 0),
        ("docs/tan.md", "lakes.svg", "reproduce rescue-fig10 --svg", 0),
        ("docs/rescue.md", "rescue.svg", "reproduce rescue-fig8 --svg", 0),
        ("docs/position.md", "positions.svg", "locate --svg", 0),
        ("docs/position.md", "convergence.svg", "reproduce locate-convergence --svg", 0),
        ("README.md", "crowding.svg", "replay docs/chain-2-published-n4.jsonl --svg", 1),
        ("docs/chain.md", "crowding.svg", "replay docs/chain-2-published-n4.jsonl --svg", 1),
        ("docs/chain.md", "contact.svg", "replay docs/chain-1-published-n4.jsonl --svg", 1),
        ("docs/chain.md", "dear.svg", "replay docs/chain-12-published-n47.jsonl --svg", 1),
        ("docs/own-rule.md", "follow-1.svg", "replay docs/follow-1-written.jsonl --svg", 1),
        ("docs/floor.md", "floors.svg", "reproduce floors --runs 3 --max-steps 100000 --svg", 0),
        ("docs/floor.md", "trap.svg", "replay docs/bricks-4-repaired-n1.jsonl --moves 1..5 --svg", 1),
    ] {
        shows(page, &format!("tautline {arguments} docs/{picture}"));
        let drawn = folder.join(picture);
        let arguments: Vec<&str> =
            arguments.split(' ').chain([drawn.to_str().expect("a plain name")]).collect();
        printed(&arguments, code);
        let drawn = fs::read_to_string(drawn).expect("a picture");
        assert_eq!(drawn, document(&format!("docs/{picture}")), "{picture}");
    }
    let run = folder.join("run");
    printed(&["explore", "open:7x7", "--robots", "4", "--trace", run.to_str().expect("a plain name")], 0);
    assert_eq!(fs::read_to_string(run).expect("a run"), document("docs/open-7x7.jsonl"));
}

#[test]
fn the_readme_is_one_page_and_its_commands_answer() {
    let readme = document("README.md");
    assert!(readme.len() <= 10_000, "{} bytes", readme.len());
    let folder = &folder();
    fs::create_dir(folder.join("docs")).expect("a folder");
    let run = "docs/chain-2-published-n4.jsonl";
    write(folder, run, document(run));
    let commands = readme.lines().filter_map(|line| line.strip_prefix("cargo run --release -- "));
    let commands: Vec<&str> = commands.map(|line| line.split('#').next().unwrap_or(line).trim()).collect();
    let [all, quick @ ..] = &commands[..] else { panic!("the README has no commands") };
    assert_eq!(*all, "prove");
    assert_eq!(quick.len(), 3, "{quick:?}");
    for (command, code) in quick.iter().zip([1, 1, 0]) {
        let arguments: Vec<&str> = command.split_whitespace().collect();
        assert!(!foreign::ended(folder, &arguments, code).0.is_empty(), "{command}");
    }
}

/// The tests of a package that a command runs: the words by which it chooses them, and the folders where they stand.
fn chosen_tests(command: &str) -> Option<(Vec<&str>, Vec<String>)> {
    let (mut package, mut is_lib, mut is_all, mut chosen) = ("", false, false, Vec::new());
    let mut words = command.split_whitespace().skip(2);
    while let Some(word) = words.next() {
        match word {
            "-p" => package = words.next()?,
            "--lib" => is_lib = true,
            "--test" => is_all = words.next()? == "all",
            "--manifest-path" => return None,
            word if word.starts_with('-') => {}
            word => chosen.extend(word.split("::").filter(|part| !part.is_empty())),
        }
    }
    let folder = package.strip_prefix("tautline-").unwrap_or(".");
    let parts = [("src", is_lib || !is_all), ("tests", is_all || !is_lib)];
    let folders = parts.into_iter().filter(|(_, is_run)| *is_run).map(|(part, _)| format!("{folder}/{part}"));
    Some((chosen, folders.collect()))
}

#[test]
fn the_tests_that_the_documents_run_and_the_files_that_they_name_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = 0;
    for path in documents() {
        let text = fs::read_to_string(&path).expect("a document");
        for (number, code) in text.split('`').enumerate() {
            // Between ``` and ``` is one part of many lines; what is within a sentence may break over two.
            let is_block = text.split('`').nth(number.wrapping_sub(1)).is_some_and(str::is_empty);
            let lines = if is_block { code.to_owned() } else { code.replace('\n', " ") };
            for line in lines.lines() {
                let line = line.split(" #").next().unwrap_or(line);
                let Some(at) = line.find("cargo test ").filter(|_| number > 0) else { continue };
                let Some((chosen, folders)) = chosen_tests(&line[at..]) else { continue };
                let files: Vec<(String, String)> =
                    folders.iter().flat_map(|folder| sources(folder)).collect();
                for word in chosen {
                    let is_named = |line: &str| {
                        ["fn ", "mod "].iter().any(|kind| {
                            line.split_once(kind).is_some_and(|(_, rest)| {
                                rest.split(['(', ';', ' ']).next().is_some_and(|name| name.contains(word))
                            })
                        })
                    };
                    let is_of = |file: &str| {
                        Path::new(file).file_stem().is_some_and(|stem| stem.to_string_lossy().contains(word))
                    };
                    let is_there = files.iter().any(|(file, text)| is_of(file) || text.lines().any(is_named));
                    assert!(is_there, "{}: `{line}` runs no test of {folders:?}", path.display());
                    found += 1;
                }
            }
            let is_source = Path::new(code).extension().is_some_and(|extension| extension == "rs");
            let is_file = is_source && code.contains("/tests/") && !code.contains([' ', '\n', '<']);
            assert!(!is_file || root.join(code).exists(), "{}: there is no {code}", path.display());
        }
    }
    assert!(found >= 15, "{found}");
}

/// The anchor that GitHub makes of a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|&c| c.is_alphanumeric() || " -_".contains(c));
    kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
}

/// The anchors of a document. Its headings do not stand within a block of code.
fn anchors(path: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(path).expect("a document");
    let mut in_code = false;
    let mut found = BTreeSet::new();
    for line in text.lines() {
        in_code ^= line.starts_with("```");
        if !in_code && line.starts_with('#') {
            found.insert(anchor(line.trim_start_matches('#')));
        }
    }
    found
}

#[test]
fn every_link_of_the_documents_leads_somewhere() {
    for path in documents() {
        let text = fs::read_to_string(&path).expect("a document");
        let folder = path.parent().expect("a folder");
        let of_markdown = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let of_html = text.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next());
        for link in of_markdown.chain(of_html).filter(|link| !link.starts_with("https://")) {
            let (file, place) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { path.clone() } else { folder.join(file) };
            assert!(target.exists(), "{}: {link} leads nowhere", path.display());
            assert!(
                place.is_empty() || anchors(&target).contains(place),
                "{}: {link} has no such heading",
                path.display()
            );
        }
    }
}

#[test]
fn the_code_of_the_tutorial_is_that_of_the_example() {
    let tutorial = document("docs/own-rule.md");
    let examples =
        ["examples/followers.rs", "examples/convoy.rs", "library/src/aggregation.rs"].map(document);
    let blocks: Vec<&str> = tutorial.split("```rust\n").skip(1).collect();
    assert!(blocks.len() > 3, "the tutorial shows the rule");
    for block in blocks {
        let code = block.split("```").next().expect("an end");
        assert!(examples.iter().any(|example| example.contains(code)), "no example has such lines:\n{code}");
    }
    for name in example_files(&tutorial) {
        assert!(document(&name).contains("fn main()"), "{name} can be run");
    }
}

/// The part of a text from `start`, which is there once, to the end of its block of code.
fn block_from<'a>(text: &'a str, start: &str) -> &'a str {
    let at = text.find(start).expect("a block that begins so");
    text[at..].split("```").next().expect("an end")
}

#[cfg(unix)]
#[test]
fn the_templates_find_the_crates_where_they_are_copied_as_the_page_says() {
    let tutorial = document("docs/own-rule.md");
    let copying = block_from(&tutorial, "cp -r tautline/templates/rule");
    // The sources are compiled where they stand.
    let tree = format!("'{}' tree --offline --manifest-path", env!("CARGO"));
    let copying = copying.replace("cargo test --manifest-path", &tree);
    assert!(copying.contains(&tree), "{copying}");
    let folder = &folder();
    std::os::unix::fs::symlink(env!("CARGO_MANIFEST_DIR"), folder.join("tautline")).expect("a link");
    for name in ["rule", "protocol", "page"] {
        let lines = copying.replace("rule", name);
        let output = Command::new("sh").args(["-ec", &lines]).current_dir(folder).output().expect("a shell");
        assert!(output.status.success(), "{lines}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    let copied = read(folder, "rule/Cargo.toml");
    let needed = block_from(&tutorial, "tautline-kernel = {");
    assert!(copied.contains(needed), "{copied}");
}

/// The examples that a text links to.
fn example_files(text: &str) -> BTreeSet<String> {
    let links = text.split("](../examples/").skip(1);
    links.filter_map(|rest| Some(format!("examples/{}", rest.split(')').next()?))).collect()
}

/// So long a command of a page is awaited. One that takes longer is only read, by a test of `src/docs_test.rs`.
const PATIENCE: Duration = Duration::from_secs(2);

/// The exit code of a command, if it ends in time.
fn ended(folder: &Path, arguments: &[String]) -> Option<i32> {
    let mut program = Command::new(env!("CARGO_BIN_EXE_tautline"));
    let program = program.current_dir(folder).args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
    let mut running = program.spawn().expect("the program runs");
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        if let Some(status) = running.try_wait().expect("a process") {
            return status.code();
        }
        thread::sleep(Duration::from_millis(10));
    }
    running.kill().expect("a process that goes on");
    running.wait().expect("its end");
    None
}

#[test]
fn the_commands_of_the_pages_answer() {
    let (mut seen, mut answered) = (BTreeSet::new(), 0);
    for block in crate::commands::blocks().into_iter().filter(|block| block.is_shell) {
        let folder = &folder();
        fs::create_dir(folder.join("docs")).expect("a folder");
        for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|extension| extension == "jsonl") {
                let name = path.file_name().expect("a name");
                fs::copy(&path, folder.join("docs").join(name)).expect("a copy");
                // What the line before has stored, by another program.
                fs::copy(&path, folder.join("found.jsonl")).expect("a copy");
            }
        }
        for arguments in block.commands.iter().filter(|arguments| seen.insert((*arguments).clone())) {
            // The whole ledger is the matter of another test.
            let is_ledger = arguments[0] == "prove"
                && !arguments.iter().any(|argument| argument.starts_with(char::is_uppercase));
            match (!is_ledger).then(|| ended(folder, arguments)).flatten() {
                Some(code) => {
                    // 4: of the shards that a page names only the first was run.
                    assert!(
                        [0, 1, 4].contains(&code),
                        "{}: tautline {arguments:?} ends with {code}",
                        block.place
                    );
                    answered += 1;
                }
                // What follows needs what this one would have stored.
                None => break,
            }
        }
    }
    assert!(answered >= 10, "{answered}");
}
