//! Refutations of clauses are stored, and played again from their files; a file that was changed is refused.

use std::fs;

use tautline_io::atomic_file::Replaceable;
use tautline_proofs::decide::Verdict;
use tautline_proofs::ledger;
use tautline_sim::counterexample::refutation::{self, replay};

use crate::cli::says;
use crate::folder::{folder, write};
use crate::foreign::ended;
use crate::proved::proved;

/// Copies of a file with one thing changed, each with the words for the change.
fn tampered(text: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = text.lines().collect();
    let joined = |lines: &[&str]| lines.join("\n") + "\n";
    let mut changed = Vec::new();
    for place in 0..lines.len() {
        let mut cut = lines.clone();
        cut.remove(place);
        changed.push((format!("line {} left out", place + 1), joined(&cut)));
        changed.push((format!("cut behind line {place}"), joined(&lines[..place])));
        let mut twice = lines.clone();
        twice.insert(place, lines[place]);
        changed.push((format!("line {} twice", place + 1), joined(&twice)));
        if let Some(taken) = taken(lines[place]) {
            for other in [taken + 1, taken.wrapping_sub(1), 1 << 20] {
                let line = lines[place].replace(&format!("\"taken\":{taken}"), &format!("\"taken\":{other}"));
                let mut other_choice = lines.clone();
                other_choice[place] = &line;
                changed.push((format!("line {}: choice {other}", place + 1), joined(&other_choice)));
            }
        }
    }
    for (what, other) in [
        ("\"version\":1", "\"version\":2"),
        ("tautline refutation", "tautline run"),
        ("\"engine\":\"", "\"engine\":\"s"),
        ("\"bound\":\"", "\"bound\":\"all "),
        ("\"demand\":\"", "\"demand\":\"not "),
        ("\"rule\":\"", "\"rule\":\"un"),
        ("\"clause\":\"", "\"clause\":\"X"),
        ("\"of\":", "\"of\":1"),
        ("\"crc32\":", "\"crc32\":1"),
        ("{\"end\"", "{\"again\":{\"taken\":0,\"of\":1}}\n{\"end\""),
    ] {
        assert!(text.contains(what), "{what} in {text}");
        changed.push((format!("{what} is {other}"), text.replacen(what, other, 1)));
    }
    changed.push(("a line more".to_owned(), text.to_owned() + lines[1] + "\n"));
    changed.push(("nothing".to_owned(), String::new()));
    changed
}

fn taken(line: &str) -> Option<u32> {
    line.split_once("\"taken\":")?.1.split(',').next()?.parse().ok()
}

#[test]
fn whatever_refutes_a_clause_is_stored_and_played_again_and_refused_when_it_was_changed() {
    let folder = &folder();
    let refuted = ledger::clauses().flat_map(|clause| clause.checks);
    let refuted = refuted.filter(|check| check.expected() == Verdict::Refuted);
    assert_eq!(proved().stored.len(), refuted.count(), "each has a file of its own");
    let mut played = 0;
    for (name, text) in &proved().stored {
        // Runs of a chain are traces, which have tests of their own; what was drawn at random is long.
        if !text.contains(refutation::FORMAT) || text.contains("\"engine\":\"sampled\"") {
            continue;
        }
        let path = folder.join(name);
        fs::write(&path, text).expect("room");
        let again = replay(&path, &[]).expect("what was stored");
        let twin = folder.join(format!("again-{name}"));
        let file =
            refutation::store(&twin, again.clause, again.check, &again.evidence, &Replaceable::default());
        file.expect("a refutation").keep().expect("room");
        assert_eq!(fs::read_to_string(&twin).expect("a file"), *text, "{name}");
        for (what, changed) in tampered(text) {
            if changed != *text {
                fs::write(&path, changed).expect("room");
                assert!(replay(&path, &[]).is_err(), "{name}: {what} is accepted");
            }
        }
        played += 1;
    }
    assert!(played > 40, "{played}");
}

#[test]
fn prove_stores_what_it_refutes_and_replay_draws_it_again() {
    let folder = &folder();
    let told = &proved().told;
    let expected = [
        "chain-14-published-search.jsonl",
        "chain-14-repaired-search-2.jsonl",
        "mrc-2-published-states.jsonl",
        "notice-4-published-exhaustive.jsonl",
        "notice-5-published-states-2.jsonl",
        "notice-5-published-states.jsonl",
    ];
    for name in expected {
        let file = format!("refuted/{name}");
        write(folder, name, &proved().stored[name]);
        assert!(told.contains(&format!("replay it with: tautline replay {file}\n")), "{told}");
        let (replayed, _) = ended(folder, &["replay", name], 1);
        let (head, story) = replayed.split_once("\n\n").expect("a head, then a story");
        let clause: Vec<&str> = name.split('-').take(2).collect();
        let judged =
            format!("the judge accepts it as a counterexample to {}", clause.join("-").to_uppercase());
        assert!(head.ends_with(&judged), "{head}");
        assert!(told.contains(story), "{name}: another story:\n{story}");
        ended(folder, &["replay", name, "--svg", "picture.svg"], 2);
    }
    assert!(!folder.join("picture.svg").exists());
}

#[test]
fn a_counterexample_is_drawn_at_the_move_that_was_found_and_under_its_own_clause() {
    let stories = |clause: &str| -> String {
        let stories = proved().told.split("\n\nreplay it with: ").filter(|story| story.contains(clause));
        stories.collect()
    };
    let order = stories("CHAIN-19 as ");
    says(&order, &["and 7 team moves.", "Team move 7 breaks CHAIN-19: "]);
    assert!(!order.contains("Unexplored"), "{order}");
    let ends = stories("CHAIN-14 as ");
    assert_eq!(ends.matches(" breaks CHAIN-14: ").count(), 2, "{ends}");
    assert!(!ends.contains("breaks CHAIN-13") && ends.contains("  Unexplored: ("), "{ends}");
}
