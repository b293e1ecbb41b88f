//! Robots that keep in touch on the command line: a hunt with its files and exit codes, and what is refused.

use std::fs;

use serde_json::Value;

use super::{folder, json, names, printed, ran, read, refused, says};

/// Whether the judge has accepted a counterexample.
fn is_judged(replayed: &str, clause: &str) -> bool {
    replayed.contains(&format!("the judge accepts it as a counterexample to {clause}"))
}

#[test]
fn a_hunt_stores_what_breaks_and_each_file_breaks_it_again() {
    let folder = &folder();
    fs::create_dir(folder.join("found")).expect("a folder");
    let hunt = ["hunt", "--scheme", "kit", "--robots", "2", "--size", "3x1"];
    let published = json(folder, &[&hunt[..], &["--rule", "published", "--out", "found"]].concat(), 1);
    assert_eq!((&published["verdict"], &published["complete"]), (&"refuted".into(), &true.into()));
    let found = published["counterexamples"].as_array().expect("a list");
    let collision = found.iter().find(|finding| finding["clause"] == "KIT-3").expect("robots meet");
    assert_eq!((&collision["drives"], &collision["steps"]), (&3.into(), &Value::Null));
    let stored = || found.iter().filter_map(|finding| Some((finding, finding["file"].as_str()?)));
    for (finding, file) in stored() {
        let replayed = printed(folder, &["replay", file], 1);
        let clause = finding["clause"].as_str().expect("an id");
        assert!(replayed.contains(&format!("{clause} is broken in team move")), "{replayed}");
        assert!(is_judged(&replayed, clause), "{replayed}");
    }
    assert!(stored().count() >= 5);
    assert_eq!(stored().count(), found.len());
    assert_eq!(names(&folder.join("found")).len(), stored().count());

    let repaired = json(folder, &hunt, 0);
    assert_eq!((&repaired["verdict"], &repaired["complete"]), (&"holds".into(), &true.into()));
    let far = json(folder, &[&hunt[..], &["--range", "4"]].concat(), 0);
    assert_eq!((&far["verdict"], &far["range"]), (&"holds".into(), &4.into()));
    let stopped = ran(folder, &[&hunt[..], &["--budget", "10"]].concat());
    assert_eq!(stopped.status.code(), Some(3));
}

#[test]
fn each_section_of_a_hunt_explains_the_clause_of_its_heading() {
    let folder = &folder();
    let hunt = ["hunt", "--rule", "published", "--robots", "2", "--size"];
    let kit = printed(folder, &[&hunt[..], &["3x1", "--scheme", "kit"]].concat(), 1);
    let frontier = printed(folder, &[&hunt[..], &["3x2", "--scheme", "frontier"]].concat(), 1);
    let sections: Vec<&str> = kit.split("\n\nreplay").chain(frontier.split("\n\nreplay")).collect();
    for clause in ["KIT-6", "KIT-7", "KIT-8", "KIT-14", "FRONTIER-1", "FRONTIER-4"] {
        let section =
            sections.iter().find(|section| section.contains(&format!("\n{clause}, "))).expect(clause);
        assert!(section.contains(&format!(" breaks {clause}: ")), "{section}");
    }
}

/// At any speeds three drives break KIT-3; at equal ones, which the paper has, four do.
#[test]
fn a_run_at_equal_speeds_that_is_made_smaller_is_one_at_equal_speeds() {
    let folder = &folder();
    let run = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/kit-3-published-equal.jsonl");
    let told = json(folder, &["minimise", run], 0);
    assert_eq!((&told["before"]["steps"], &told["after"]["steps"]), (&4.into(), &4.into()), "{told}");
    let file = told["file"].as_str().expect("a file");
    let stored = read(folder, file);
    assert!(stored.contains("\"choices\":[1,"), "{stored}");
    assert!(is_judged(&printed(folder, &["replay", file], 1), "KIT-3"));
}

#[test]
fn a_hunt_of_another_reading_stores_runs_that_break_it_again() {
    let folder = &folder();
    let hunt = ["hunt", "--scheme", "kit", "--robots", "2", "--size", "5x1", "--rule", "ahead"];
    let ahead = json(folder, &hunt, 1);
    let found = ahead["counterexamples"].as_array().expect("a list");
    let cut = found.iter().find(|finding| finding["clause"] == "KIT-1").expect("robots lose contact");
    assert_eq!(cut["drives"], 4);
    for finding in found {
        let replayed = printed(folder, &["replay", finding["file"].as_str().expect("a file")], 1);
        let clause = finding["clause"].as_str().expect("an id");
        assert!(is_judged(&replayed, clause), "{replayed}");
    }
    for command in [&["explore", "open:5x4"][..], &["hunt"]] {
        let said = refused(folder, &[command, &["--scheme", "kit", "--rule", "beside"]].concat());
        assert!(said.contains("kit has no rule beside"), "{said}");
        assert!(["published", "repaired", "ahead"].iter().all(|rule| said.contains(rule)), "{said}");
    }
}

#[test]
fn what_no_robots_that_keep_in_touch_can_be_told_is_refused() {
    let folder = &folder();
    let wrong: [(&[&str], &str); 14] = [
        (&["explore", "open:1x1", "--robots", "2"], "--robots a number up to 1"),
        (&["explore", "open:5x4", "--robots", "300"], "1 to 8 robots"),
        (&["explore", "open:5x4", "--start", "9,9"], "columns go from 0 to 4"),
        (
            &["explore", "open:9x9", "--start", "0,0", "--start", "8,8", "--robots", "2"],
            "a start beside another one's",
        ),
        (&["explore", "open:5x4", "--range", "0"], "--range"),
        (&["explore", "open:5x4", "--range", "6"], "--range 2 to 5 cells"),
        (&["hunt", "--size", "3x1", "--range", "6"], "--range 2 to 5 cells"),
        (&["explore", "open:5x4", "--speed", "0"], "--speed a number of metres a second"),
        (&["explore", "open:5x4", "--speed", "-1"], "--speed a number of metres a second"),
        (&["explore", "open:5x4", "--speed", "nan"], "--speed a number of metres a second"),
        (&["explore", "open:5x4", "--spread", "1"], "--spread a share from 0 to 0.999"),
        (&["hunt", "--robots", "5", "--size", "3x3"], "--robots a number from 1 to 3"),
        (&["hunt", "--robots", "2", "--size", "9x9"], "--size at most 16 nodes"),
        (&["hunt", "--robots", "2", "--size", "1x1"], "--size at least 2 nodes"),
    ];
    for (arguments, right) in wrong {
        says(&refused(folder, &[arguments, &["--scheme", "kit"]].concat()), &[right]);
    }
    assert!(names(folder).is_empty());
}
