//! Failures while a chain explores: the run, its trace, its page, its JSON, and what is refused.

use super::*;

#[test]
fn a_chain_in_which_something_fails_is_told_of_in_text_json_trace_and_page() {
    let folder = &folder();
    let faults = ["--rule", "reel", "--robots", "5", "--fail", "3@12", "--loss", "0.2", "--speeds"];
    let explore = [&["explore", "walls:9x9:0.1", "--seed", "7"], &faults[..]].concat();
    let files = ["--trace", "run.jsonl", "--html", "run.html"];
    let text = printed(folder, &[&explore[..], &files].concat(), 0);
    assert!(text.contains("a robot died in team move 12; the others formed a chain after"), "{text}");
    says(&text, &["lost; the robots said theirs in", "no clause is broken"]);
    let told = json(folder, &explore, 0);
    assert_eq!((&told["faults"]["died"], &told["violations"]), (&12.into(), &Value::Array(vec![])));
    assert!(told["faults"]["lost_bytes"].as_u64() > Some(10), "{told}");
    printed(folder, &["replay", "run.jsonl"], 0);
    says(&read(folder, "run.jsonl"), &[r#""fail":{"robot":3,"move":12},"going":"one-by-one""#]);
    let page = read(folder, "run.html");
    assert!(page.contains(" f:2") && page.contains("lost byte") && page.contains("--fail 3@12 --speeds"));
}

#[test]
fn a_chain_that_waits_for_ever_says_so() {
    let folder = &folder();
    let explore = ["explore", "open:5x5", "--rule", "reel", "--robots", "3"];
    let lost = json(folder, &[&explore[..], &["--lose", "1"]].concat(), 0);
    assert_eq!((&lost["stopped"], &lost["steps"]), (&"silent".into(), &1.into()));
    let alone = ["explore", "open:3x3", "--rule", "reel", "--robots", "2", "--fail", "2@3"];
    let alone = json(folder, &alone, 0);
    assert_eq!((&alone["stopped"], &alone["steps"]), (&"silent".into(), &3.into()));
}

#[test]
fn a_wall_that_appears_is_met_and_nothing_is_broken() {
    let folder = &folder();
    let explore = ["explore", "open:9x9", "--rule", "reel", "--robots", "5"];
    let open = json(folder, &explore, 0);
    // The first robots cross this side at once; from team move 3 on nobody does.
    let shut = json(folder, &[&explore[..], &["--wall", "4,4,E@3", "--trace", "run.jsonl"]].concat(), 0);
    assert_ne!(open["steps"], shut["steps"]);
    assert_eq!((&shut["violations"], &shut["explored"]), (&serde_json::json!([]), &81.into()));
    json(folder, &["replay", "run.jsonl"], 0);
    // A wall that never appears is worth a word.
    let late = ["--wall", "4,4,E@100000", "--format", "json"];
    let late: serde_json::Value =
        serde_json::from_slice(&ran(folder, &[&explore[..], &late].concat()).stdout).expect("JSON");
    assert_eq!((&open["steps"], &open["milestones"]), (&late["steps"], &late["milestones"]));
}

#[test]
fn a_failure_that_cannot_be_is_refused() {
    let folder = &folder();
    let wrong: [(&[&str], &str); 22] = [
        (&["--fail", "9@5"], "name a robot from 2 to 8"),
        (&["--fail", "1@5"], "the base cannot fail"),
        (&["--fail", "0@5"], "no robot 0"),
        (&["--fail", "3@0"], "whole numbers from 1 on"),
        (&["--fail", "3"], "whole numbers from 1 on"),
        (&["--fail", "3@NaN"], "whole numbers from 1 on"),
        (&["--fail", "3@5", "--fail", "4@9"], "a chain re-forms behind one"),
        (&["--wall", "7,7,E"], "as in 7,6,E@20"),
        (&["--wall", "7,7,X@5"], "one of E, S, W and N"),
        (&["--wall", "7,7@5"], "column, row"),
        (&["--wall", "7,7,E@0"], "whole number from 1 on"),
        (&["--wall", "7,7,E,1@5"], "as in 7,6,E@20"),
        (&["--wall", "14,7,E@5"], "it is not between two cells"),
        (&["--wall", "40,7,E@5"], "it is not between two cells"),
        (&["--wall", "7,7,E@5", "--fail", "3@5"], "give --wall and --fail to two runs"),
        (&["--scheme", "kit", "--wall", "7,7,E@5"], "take the scheme chain"),
        (&["--loss", "1.5"], "1.5"),
        (&["--loss", "-0.1"], "-0.1"),
        (&["--lose", "NaN"], "NaN"),
        (&["--scheme", "bricks", "--fail", "2@5"], "take the scheme chain"),
        (&["--scheme", "full-search", "--loss", "0.1"], "chain"),
        (&["--scheme", "kit", "--speeds"], "take the scheme chain"),
    ];
    for (arguments, why) in wrong {
        says(&refused(folder, &[&["explore", "open:15x15"], arguments].concat()), &[why]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_made_is_told_in_words() {
    let folder = &folder();
    let long = "a".repeat(300);
    for (place, why) in [
        (&*long, "its name is longer than the disk takes"),
        ("/proc/found", "the system makes nothing there"),
        ("/sys/found", "you may not write there"),
    ] {
        let said = refused(folder, &["man", "--out", place]);
        says(&said, &["the folder cannot be made: ", why, "name a folder, or a place where one can be made"]);
        assert!(!said.contains("os error"), "{said}");
    }
}
