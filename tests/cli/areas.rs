//! The hunt over areas on the command line: the smallest runs that break a clause, its certificate, and what is
//! refused.

use std::fs;
use std::path::Path;

use tautline_papers::rivals::CATALOGUE;
use tautline_sim::explore::{RuleId, Starts};

use super::{folder, json, names, printed, ran, refused, says};

const HUNT: [&str; 7] = ["hunt", "--rule", "published", "--max-cells", "10", "--max-walls", "13"];

#[test]
fn the_smallest_runs_of_all_areas_are_those_of_the_pages() {
    let folder = &folder();
    let found = json(folder, &HUNT, 1);
    assert_eq!((&found["verdict"], &found["complete"]), (&"refuted".into(), &true.into()));
    assert_eq!((&found["max_cells"], &found["cells_done"]), (&10.into(), &10.into()));
    let briefly = |one: &serde_json::Value| {
        ["clause", "columns", "rows", "walls", "steps", "file"].map(|field| one[field].to_string()).join(" ")
    };
    let found_runs: Vec<String> =
        found["counterexamples"].as_array().expect("a list").iter().map(briefly).collect();
    assert_eq!(
        found_runs,
        [
            r#""CHAIN-1" 3 3 4 8 "chain-1-published-n4.jsonl""#,
            r#""CHAIN-2" 5 2 2 7 "chain-2-published-n4.jsonl""#
        ]
    );
    let files = ["chain-1-published-n4.jsonl", "chain-2-published-n4.jsonl"];
    assert_eq!(names(folder), files);
    for file in files {
        assert!(printed(folder, &["replay", file], 1).contains("the judge accepts it as a counterexample"));
        let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(file);
        let [found, kept] = [&folder.join(file), &kept].map(|path| fs::read_to_string(path).expect("a run"));
        assert_eq!(found, kept, "the page draws another one");
    }
    // All columns and rows, each with all places of the base from which the team gets everywhere.
    let areas = found["areas"].as_array().expect("a list");
    let of = |cells: u64| {
        let sizes =
            areas.iter().map(|area| ["columns", "rows", "bases", "walls"].map(|field| area[field].as_u64()));
        let sizes = sizes.map(|fields| fields.map(|field| field.expect("a number")));
        sizes.filter(|[columns, rows, ..]| columns * rows == cells).collect::<Vec<_>>()
    };
    assert_eq!(of(9), [[3, 3, 9, 12]]);
    assert_eq!(of(10), [[5, 2, 6, 13], [2, 5, 6, 13]]);
    let sum = |field: &str| areas.iter().filter_map(|area| area[field].as_u64()).sum::<u64>();
    assert_eq!([sum("runs"), sum("moves")].map(Some), [found["runs"].as_u64(), found["moves"].as_u64()]);
}

#[test]
fn the_repaired_rule_breaks_in_no_area_of_ten_cells() {
    let folder = &folder();
    let hunt = ["hunt", "--max-cells", "10", "--max-walls", "13"];
    insta::assert_snapshot!(printed(folder, &hunt, 0), @r"
    chain (repaired), 4 robots, at most 10 cells and 13 walls: 21 areas with 84 places of the base, 36168 runs, 392872 team moves
    No clause that is looked for is broken in any layout within this bound.
    ");
}

#[test]
fn a_hunt_over_areas_that_is_ended_says_how_far_it_came() {
    let folder = &folder();
    let output = ran(folder, &[&HUNT[..], &["--budget", "200000", "--format", "json"]].concat());
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(output.status.code(), Some(3));
    assert_eq!((&told["complete"], &told["cells_done"]), (&false.into(), &8.into()));
}

#[test]
fn what_no_hunt_over_areas_can_be_told_is_refused() {
    let folder = &folder();
    let wrong: [(&[&str], &str); 9] = [
        (&["--max-cells", "0"], "--max-cells a number from 1 to 49"),
        (&["--max-cells", "50"], "--max-cells a number from 1 to 49"),
        (&["--max-cells", "-1"], "whole number"),
        (&["--max-cells", "2", "--max-walls", "2"], "--max-walls a number up to 1, or more --max-cells"),
        (&["--max-cells", "9", "--robots", "1"], "--robots a number from 2 to 64"),
        (&["--max-cells", "9", "--size", "3x3"], "cannot be used with"),
        (&["--max-cells", "9", "--resume", "kept.json"], "leave --resume out"),
        (&["--max-cells", "9", "--plan", "plan.json", "--shards", "2"], "leave --shards out"),
        (&["--max-cells", "9", "--scheme", "bricks"], "give --size"),
    ];
    for (arguments, right) in wrong {
        says(&refused(folder, &[&["hunt"], arguments].concat()), &[right]);
    }
    assert!(names(folder).is_empty());
}

/// Robots that each need a cell of their own; those of a chain and agents may start in one cell together.
#[test]
fn an_area_too_small_for_the_team_is_refused_with_what_would_be_right() {
    let folder = &folder();
    let mut told = 0;
    for scheme in CATALOGUE.schemes() {
        for rule in scheme.rules {
            let has_own_cells = match scheme.starts {
                Starts::Alone => true,
                Starts::Beside => rule.name == RuleId::REPAIRED,
                Starts::Base | Starts::Anywhere => false,
            };
            let team = ["--scheme", scheme.name, "--rule", rule.name.as_str(), "--robots", "3"];
            if has_own_cells {
                let said = refused(folder, &[&["explore", "open:2x1"], &team[..]].concat());
                let right = "give --robots a number up to 2, or take a larger layout";
                assert!(
                    said.contains("3 robots do not find room") && said.contains(right),
                    "{team:?}: {said}"
                );
                told += 1;
            }
            if rule.hunt.is_some() && has_own_cells {
                let said = refused(folder, &[&["hunt", "--size", "2x1"], &team[..]].concat());
                let right = "give --robots a number up to 2, or a larger --size";
                assert!(
                    said.contains("3 robots do not find room") && said.contains(right),
                    "{team:?}: {said}"
                );
                told += 1;
            }
        }
    }
    assert!(told > 10, "{told}");
    let chain = refused(folder, &["hunt", "--size", "1x1", "--robots", "3", "--max-walls", "1"]);
    assert!(chain.contains("give --max-walls a number up to 0, or a larger --size"), "{chain}");
    assert!(names(folder).is_empty());
}
