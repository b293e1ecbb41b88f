//! Other people's rules on the command line.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;

use super::{folder, json, names, printed, ran, read, refused, says, write};

#[test]
fn the_library_is_listed_with_what_comes_out() {
    assert_snapshot!("library_list", printed(&folder(), &["library"], 0));
}

#[test]
fn a_rule_of_the_library_is_decided_stored_and_played_again() {
    let folder = &folder();
    let told = printed(folder, &["library", "rmf-lane", "--out", "found"], 0);
    assert_snapshot!("library_rule", told);
    let stored = "found/lane-1-before-the-pull-request-states.jsonl";
    let played = printed(folder, &["replay", stored], 1);
    let story =
        told.lines().skip_while(|line| !line.starts_with("start")).take_while(|line| !line.is_empty());
    for line in story {
        assert!(played.contains(line), "{line}\n{played}");
    }
    let text = read(folder, stored);
    let other = text.replace("\"taken\":0", "\"taken\":1");
    write(folder, stored, other);
    assert_eq!(ran(folder, &["replay", stored]).status.code(), Some(2));
    let ledger = json(folder, &["library", "rmf-lane", "RMF-SWAP"], 0);
    assert_eq!(
        (ledger["as_registered"].as_bool(), ledger["clauses"].as_array().map(Vec::len)),
        (Some(true), Some(9))
    );
}

#[test]
fn a_wrong_name_and_options_without_effect_are_refused() {
    let folder = &folder();
    for (name, arguments) in [
        ("library_unknown", &["library", "pbit"][..]),
        ("library_no_larger", &["library", "rmf-lane", "--larger"]),
        ("library_lists", &["library", "--format", "json"]),
        ("library_seed", &["library", "rmf-lane", "--seed", "1"]),
        ("library_runs", &["library", "--runs", "5"]),
        ("library_plan", &["library", "rmf-lane", "--plan", "plan.json"]),
    ] {
        assert_snapshot!(name, refused(folder, arguments));
    }
}

#[test]
fn a_rule_is_hunted_by_random_runs_and_what_is_found_is_stored_replayed_and_minimised() {
    let folder = &folder();
    let hunt = ["library", "ricart-agrawala", "--runs", "50", "--seed", "3", "--patience", "30"];
    let told = printed(folder, &[&hunt[..], &["--out", "found"]].concat(), 1);
    assert_snapshot!("library_hunt", told);
    let stored = "found/mutex-2-published-outside-its-premises-states.jsonl";
    assert_eq!(names(&folder.join("found")), [stored.strip_prefix("found/").expect("a name")]);
    printed(folder, &["replay", stored], 1);
    assert_snapshot!("library_minimise", printed(folder, &["minimise", stored], 0));
    printed(folder, &["replay", "mutex-2-published-outside-its-premises-states-minimal.jsonl"], 1);
    // Its own clause can be named, in small letters, too; any other one is none of its.
    json(folder, &["minimise", stored, "--clause", "mutex-2"], 0);
    for none in [["--runs", "0"].as_slice(), &["--runs", "9", "--max-moves", "0"]] {
        let said = refused(folder, &[&["library", "ricart-agrawala"], none].concat());
        assert!(said.contains("write a whole number from 1 to"), "{said}");
    }
    // A name that a shell would take apart.
    let told = printed(folder, &[&hunt[..], &["--out", "my runs"]].concat(), 1);
    assert!(told.contains(&format!("tautline replay 'my runs/{}'", &stored["found/".len()..])), "{told}");
    let said = refused(folder, &["minimise", stored, "--clause", "CHAIN-2"]);
    assert!(said.contains("this is a counterexample to MUTEX-2, not to CHAIN-2"), "{said}");
    let minimised = json(folder, &["minimise", stored, "--out", "again"], 0);
    assert_eq!(
        (minimised["shortest"].as_bool(), minimised["after"]["moves"].as_u64()),
        (Some(true), Some(4))
    );
    let hunted = json(folder, &hunt, 1);
    let verdicts: Vec<_> =
        hunted["checks"].as_array().expect("a list").iter().map(|check| &check["verdict"]).collect();
    assert_eq!(verdicts, ["unrefuted", "unrefuted", "unrefuted", "refuted"]);
    assert_eq!(json(folder, &hunt, 1), hunted);
    let junit = printed(folder, &[&hunt[..], &["--format", "junit"]].concat(), 1);
    assert!(junit.contains(r#"tests="4" skipped="0" failures="1""#), "{junit}");
    assert!(
        printed(folder, &["library", "pibt", "--larger", "--runs", "20"], 0)
            .contains("not refuted by 20 runs")
    );
}

#[test]
fn the_shards_of_the_library_in_any_order_give_what_one_process_gives() {
    let (one, many) = (&folder(), &folder());
    let rules = ["library", "dijkstra", "rmf-swap", "ba-star"];
    let whole = printed(one, &[&rules[..], &["--out", "found"]].concat(), 0);
    let planned = printed(many, &[&rules[..], &["--plan", "plan.json", "--shards", "4"]].concat(), 0);
    // Six jobs of BA* are over layouts, and each is divided among all shards.
    assert!(planned.contains("44 jobs for 4 shards"), "{planned}");
    assert_eq!(ran(many, &["merge", "plan.json"]).status.code(), Some(4));
    for shard in ["3", "1", "4", "2"] {
        printed(many, &["library", "--plan", "plan.json", "--shard", shard], 0);
    }
    assert_eq!(printed(many, &["merge", "plan.json", "--out", "found"], 0), whole);
    for run in names(&one.join("found")) {
        let read = |folder: &Path| fs::read_to_string(folder.join("found").join(&run)).expect("a file");
        assert_eq!(read(one), read(many), "{run}");
    }
    let path = many.join("plan-2.json");
    let text = fs::read_to_string(&path).expect("a file");
    let lines: Vec<&str> = text.lines().collect();
    let changed = format!(
        "{}\n{}\n",
        lines[0],
        lines[1].replacen("\"verdict\":\"refuted\"", "\"verdict\":\"sure\"", 1)
    );
    fs::write(&path, format!("{changed}{{\"crc32\":{}}}\n", crc32fast::hash(changed.as_bytes())))
        .expect("a file");
    assert!(refused(many, &["merge", "plan.json"]).contains("\"sure\" is no verdict"));
    assert!(refused(many, &["hunt", "--plan", "plan.json", "--shard", "1"]).contains("none of a hunt"));
}

/// The first promise of Ricart–Agrawala has 10,522 states, and no room for them.
#[test]
fn a_search_larger_than_memory_goes_on_in_a_folder() {
    let folder = &folder();
    let spill = folder.join("states");
    let bounded = ["library", "ricart-agrawala", "--memory", "480KiB"];
    let spilling = [&bounded[..], &["--spill", "states"]].concat();
    says(&refused(folder, &spilling), &["there is no such folder", "make it"]);
    fs::create_dir(&spill).expect("a folder");
    let whole = printed(folder, &bounded[..2], 0);
    assert!(printed(folder, &bounded, 3).contains("give it a folder with --spill"));
    assert_eq!(printed(folder, &spilling, 0), whole);
    assert_eq!(fs::read_dir(&spill).expect("a folder").count(), 0, "nothing is left");
    let narrow = ["library", "ricart-agrawala", "--memory", "64KiB", "--spill", "states"];
    let said = printed(folder, &narrow, 3);
    assert!(said.contains("Give more with --memory") && !said.contains("--spill"), "{said}");
    // Of a search that was killed while it wrote.
    write(&spill, "0-0.part", "tautline sta");
    assert_eq!(printed(folder, &spilling, 0), whole);
    assert_eq!(fs::read_dir(&spill).expect("a folder").count(), 0, "nothing is left");
    for (name, content) in [("notes.txt", "tautline states 1\n"), ("1-0.states", "mine")] {
        write(&spill, name, content);
        says(&refused(folder, &spilling), &[name, "name a folder that is empty"]);
        fs::remove_file(spill.join(name)).expect("it is there");
    }
    write(folder, "file", "");
    says(&refused(folder, &[&bounded[..], &["--spill", "file"]].concat()), &["this is no folder"]);
    says(&refused(folder, &[&bounded[..2], &["--spill", "states"]].concat()), &["--memory"]);
}
