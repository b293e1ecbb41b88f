//! Frontier cells on the command line: what is refused, with what would be right.

use std::path::Path;

use serde_json::Value;

use super::{folder, json, names, printed, read, refused, says, write};

#[test]
fn what_no_team_of_frontier_cells_can_be_told_is_refused() {
    let folder = &folder();
    let wrong: [(&[&str], &str); 28] = [
        (&["explore", "cells:3x3:0", "--threshold", "1.5"], "--threshold a number from 0 to 1"),
        (&["explore", "cells:3x3:0", "--threshold", "nan"], "--threshold a number from 0 to 1"),
        (&["explore", "cells:3x3:0", "--robots", "10"], "--robots a number up to 9"),
        (&["explore", "cells:3x3:0", "--noise-db", "-1"], "decibels from 0 to 100"),
        (&["explore", "cells:3x3:0", "--odometry", "-0.1:1"], "--odometry a share of the way from 0 to 1"),
        (&["explore", "cells:3x3:0", "--odometry", "0.02:nan"], "--odometry a share of the way from 0 to 1"),
        (&["explore", "cells:3x3:0", "--odometry", "0.02"], "such as 0.02:1"),
        (&["explore", "cells:3x3:0", "--anchors", "2"], "--anchors 3 to 8"),
        (&["explore", "cells:3x3:0", "--readings", "x"], "whole number"),
        (&["explore", "open:60x60", "--noise-db", "4"], "a smaller floor, less --noise-db"),
        (&["explore", "open:6x6", "--noise-db", "1", "--odometry", "0.02:5"], "--odometry smaller errors"),
        (&["explore", "cells:3x3:0", "--objects", "0"], "--objects 1 to 1000 of them"),
        (
            &["explore", "cells:3x3:0", "--objects", "-3"],
            "write a whole number, from 0 on, or columns and rows",
        ),
        (&["explore", "cells:3x3:0", "--objects", "1:2,3"], "columns and rows such as 1.5:2,3:4"),
        (
            &["explore", "cells:3x3:0", "--objects", "1:2,3:1"],
            "columns from -0.5 to 2.5 and rows from -0.5 to 2.5",
        ),
        (
            &["explore", "cells:3x3:0", "--objects", "-0.6:0"],
            "columns from -0.5 to 2.5 and rows from -0.5 to 2.5",
        ),
        (
            &["explore", "cells:3x3:0", "--objects", "nan:0"],
            "columns from -0.5 to 2.5 and rows from -0.5 to 2.5",
        ),
        (&["explore", "shut.txt", "--objects", "2.1:0"], "--objects places in free cells"),
        (&["explore", "cells:3x3:0", "--outliers", "0.1"], "--noise-db as well"),
        (&["explore", "cells:3x3:0", "--small", "1.1"], "from 0 to 1"),
        (&["explore", "cells:3x3:0", "--swarm"], "--noise-db as well"),
        (&["explore", "cells:3x3:0", "--loss", "2"], "from 0 to 1"),
        (&["explore", "cells:3x3:0", "--range", "x"], "whole number"),
        (&["hunt", "--robots", "7", "--size", "3x2"], "--robots a number from 1 to 3"),
        (&["hunt", "--rule", "greedy", "--robots", "7", "--size", "3x2"], "--robots a number up to 6"),
        (&["hunt", "--size", "9x9"], "--size at most 16 cells"),
        (&["hunt", "--error", "0.3"], "sixteenths from 0 to 1"),
        (&["hunt", "--robots", "2", "--error", "0.25"], "--robots 1, or --error 1"),
    ];
    write(folder, "shut.txt", "tautline layout 1\n+--+--+--+\n|      ##|\n+--+--+--+\n");
    for (arguments, right) in wrong {
        says(&refused(folder, &[arguments, &["--scheme", "frontier"]].concat()), &[right]);
    }
    assert_eq!(names(folder), ["shut.txt"]);
}

/// As published two robots come into one cell; by the rule that wanders their runs have no end. Of a message that is
/// lost the judge knows nothing, nor of rivals.
#[test]
fn what_a_hunt_has_stored_is_judged_where_there_is_a_judge_and_has_an_end_only_if_the_run_does() {
    for (rule, more, clause, is_judged) in [
        ("published", &[][..], "FRONTIER-2", true),
        ("wanders", &[], "FRONTIER-3", true),
        ("literal", &[], "FRONTIER-3", true),
        ("published", &["--max-losses", "1"], "FRONTIER-4", false),
        ("earlier", &[], "FRONTIER-3", false),
    ] {
        let folder = &folder();
        let hunt = ["hunt", "--scheme", "frontier", "--robots", "2", "--size", "3x1", "--rule", rule];
        let hunted = json(folder, &[&hunt[..], more].concat(), 1);
        let found = hunted["counterexamples"].as_array().expect("a list");
        let broken = found.iter().find(|finding| finding["clause"] == clause).expect("it is broken");
        let replayed = printed(folder, &["replay", broken["file"].as_str().expect("a file")], 1);
        let said = format!("the judge accepts it as a counterexample to {clause}");
        assert_eq!(replayed.contains(&said), is_judged, "{replayed}");
        let is_endless = replayed.contains("the team is where it was, and would go round for ever");
        assert_eq!(is_endless, clause == "FRONTIER-3", "{replayed}");
    }
}

#[test]
fn a_run_that_no_file_tells_is_said_to_be_none() {
    let folder = &folder();
    let hunt = ["hunt", "--scheme", "frontier", "--robots", "1", "--size", "2x1", "--error", "0.5"];
    says(&printed(folder, &hunt, 1), &["FRONTIER-5, 2x1 cells", "no file is stored: "]);
    assert_eq!(names(folder), [""; 0]);
}

#[test]
fn agents_that_go_round_for_ever_are_stored_up_to_where_they_are_as_before() {
    let folder = &folder();
    let hunt = ["hunt", "--scheme", "bricks", "--rule", "published", "--max-misses", "0", "--size", "5x3"];
    let told = printed(folder, &hunt, 1);
    says(&told, &["BRICKS-5, 0 missed, 5x3 cells", "After team move 23 all is as it was before", "the end"]);
    let replayed = printed(folder, &["replay", "bricks-5-published-n1.jsonl"], 1);
    says(&replayed, &["23 team moves: the team is where it was", "BRICKS-5 is broken in team move 23"]);
    says(&replayed, &["the judge accepts it as a counterexample to BRICKS-5"]);
}

#[test]
fn a_map_of_ros_is_read_again_as_far_as_it_was_explored() {
    let folder = &folder();
    let explored = ["explore", "cells:6x7:0.2", "--scheme", "frontier", "--robots", "2", "--noise-db", "1"];
    let told = printed(folder, &[&explored[..], &["--map", "map.yaml"]].concat(), 0);
    let cells = told.lines().find_map(|line| line.split_once(" explored")).expect("what is explored").0;
    let again = ["explore", "map.yaml", "--scheme", "frontier", "--robots", "2"];
    assert!(printed(folder, &again, 0).contains(&format!("{cells} explored")), "{told}");
    // The next run replaces what an earlier one stored, and nothing else.
    printed(folder, &[&explored[..], &["--map", "map.yaml"]].concat(), 0);
    assert_eq!(names(folder), ["map.pgm", "map.yaml"]);
    for (layout, map, what) in [
        ("open:3x3", "map.txt", "name a file that ends in .yaml"),
        ("open:3x3", "map.pgm", "name a file that ends in .yaml"),
        ("walls:5x5:0.3", "walls.yaml", "the layout has walls between cells"),
    ] {
        says(&refused(folder, &["explore", layout, "--robots", "3", "--map", map]), &[what]);
    }
    assert_eq!(names(folder), ["map.pgm", "map.yaml"]);
}

#[test]
fn the_cells_of_a_map_of_ros_lie_where_those_of_the_layout_do() {
    let folder = &folder();
    let floor = "image: floor.pgm\nresolution: 0.1\norigin: [-1, 2, 0]\nnegate: 0\noccupied_thresh: 0.65\n\
                 free_thresh: 0.196\n";
    write(folder, "floor.yaml", floor);
    write(folder, "floor.pgm", format!("P2\n4 5\n255\n{}", "254 ".repeat(20)));
    // The lowest row of pixels is in no cell; of a floor of five cells a chain of two robots gets to the three in the
    // middle.
    let coarse = "explore floor.yaml --cell 0.2 --radius 0.05 --scheme frontier --robots 2 --map map.yaml";
    let inner = "explore open:5x5 --robots 2 --map map.yaml";
    for (run, lies) in
        [(coarse, "resolution: 0.2\norigin: [-1, 2.1, 0]\n"), (inner, "resolution: 1\norigin: [1, 1, 0]\n")]
    {
        printed(folder, &run.split(' ').collect::<Vec<_>>(), 0);
        let map = read(folder, "map.yaml");
        assert!(map.contains(lies), "{run}: {map}");
    }
}

#[test]
fn the_objects_that_robots_find_are_told_with_their_errors_and_drawn_on_the_map() {
    let folder = &folder();
    let run = ["explore", "open:4x3", "--scheme", "frontier", "--robots", "2", "--noise-db", "1"];
    let objects = ["--objects", "1.25:2,3:0.5", "--draw", "map", "--svg", "map.svg"];
    says(&printed(folder, &[&run[..], &objects].concat(), 0), &["2 of 2 objects found; off by 0."]);
    let found = json(folder, &[&run[..], &objects[..2]].concat(), 0)["objects"].clone();
    for (object, at) in found.as_array().expect("objects").iter().zip([[1.25, 2.0], [3.0, 0.5]]) {
        assert_eq!(object["at"], serde_json::json!(at));
        assert!(object["found"]["error"].as_f64().expect("an error") < 0.5, "{object}");
    }
    let picture = read(folder, "map.svg");
    assert_eq!(picture.matches("<circle class=\"found\"").count(), 2);
    for meaning in ["a robot was here: free", "not known", "where an object is"] {
        assert!(picture.contains(meaning), "{meaning}");
    }
}

/// The options in the header of a stored run.
fn options(folder: &Path, run: &str) -> Value {
    let run = read(folder, run);
    let header: Value = serde_json::from_str(run.lines().next().unwrap_or_default()).expect("a header");
    header["options"].clone()
}

#[test]
fn one_option_of_a_stored_run_leaves_the_others_as_they_were() {
    let folder = &folder();
    let run = "explore cells:4x4:0.1 --scheme frontier --robots 2 --loss 0.1 --noise-db 0.5 --objects 2 \
               --outliers 0.01 --small 0.1 --trace run.jsonl";
    printed(folder, &run.split_whitespace().collect::<Vec<_>>(), 0);
    for (option, word, field) in [("--small", "0.2", "small"), ("--loss", "0", "loss")] {
        let mut expected = options(folder, "run.jsonl");
        expected[field] = word.parse::<f64>().expect("a number").into();
        printed(folder, &["explore", "run.jsonl", option, word, "--trace", "new.jsonl"], 0);
        assert_eq!(options(folder, "new.jsonl"), expected);
    }
}
