//! `tautline judge`: logs of robots that this program did not move.

use std::fmt::Write;
use std::path::Path;

use serde_json::Value;

use crate::cli::says;
use crate::folder::{Folder, folder, read, write};
use crate::foreign::ended;

/// Four robots in a row swing to and fro for half a minute; from 20 s on the last one is 80 cm farther off.
fn field(header: &str, metre: f64) -> String {
    let mut text = format!("{header}\n");
    for moment in 0..60 {
        for robot in 0..4 {
            let swing = f64::from((moment % 20_i32 - 10).abs()) / 10.0;
            let off = if robot == 3 && moment >= 40 { 0.8 } else { 0.0 };
            let x = f64::from(robot) * 2.0 + 0.5 + swing + off;
            writeln!(text, "{},ugv{},{},{}", f64::from(moment) / 2.0, robot + 1, x * metre, 0.5 * metre)
                .expect("a string");
        }
    }
    text
}

fn with_log() -> Folder {
    let folder = folder();
    write(&folder, "field.csv", field("time,robot,x,y", 1.0));
    folder
}

fn judged(folder: &Path, arguments: &str, code: i32) -> (String, String) {
    let arguments: Vec<&str> = ["judge"].into_iter().chain(arguments.split(' ')).collect();
    ended(folder, &arguments, code)
}

#[test]
fn a_breach_has_its_moment_its_robots_its_line_a_picture_and_a_page() {
    let folder = &with_log();
    let arguments = "field.csv --clauses CHAIN-3,CHAIN-2,KIT-12,PACK-2 --svg moment.svg --html moment.html";
    let (told, _) = judged(folder, arguments, 1);
    let page = include_str!("../docs/judge.md");
    assert!(page.contains(&told), "docs/judge.md has not:\n{told}");
    let picture = read(folder, "moment.svg");
    assert!(
        picture.contains("CHAIN-3 is broken at 20 s; cells of 1 m") && picture.contains("class=\"broken\"")
    );
    assert_eq!(picture.matches("class=\"crowded\"").count(), 2, "{picture}");
    let page = read(folder, "moment.html");
    says(&page, &["20 s, x and y in metres: CHAIN-3 is broken", "! 4 (ugv4)"]);
    let (told, _) = judged(folder, "field.csv --clauses chain-3 --format json", 1);
    let told: Value = serde_json::from_str(&told).expect("JSON");
    assert_eq!(told["clauses"][0]["breach"]["place"], 165);
}

#[test]
fn runs_of_ours_keep_their_clauses_in_the_recordings_that_we_write() {
    let folder = &with_log();
    for (run, map, clauses) in [
        ("--robots 4", "walls:9x9:0.1", "CHAIN-2,CHAIN-3"),
        ("--robots 3 --scheme frontier", "cells:6x6:0.1", "FRONTIER-1,FRONTIER-2"),
        ("--robots 3 --scheme pack", "cells:6x6:0.1", "PACK-2"),
    ] {
        let explore = format!("explore {map} --mcap run.mcap --force {run}");
        ended(folder, &explore.split(' ').collect::<Vec<_>>(), 0);
        let (told, _) = judged(folder, &format!("run.mcap --map {map} --clauses {clauses}"), 0);
        assert!(!told.contains("off the map") && !told.contains("through a wall"), "{told}");
    }
    // As published, a chain comes to be three in a cell; the picture of a map is that of the map.
    let run = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/chain-2-published-n4.jsonl");
    ended(folder, &["replay", run, "--mcap", "crowd.mcap"], 1);
    let (told, _) = judged(folder, "crowd.mcap --clauses CHAIN-2", 1);
    assert!(told.contains("CHAIN-2: broken at 7 s: robots"), "{told}");
}

#[test]
fn a_log_of_another_map_or_in_other_units_is_said() {
    let folder = &with_log();
    write(folder, "mm.csv", field("time,robot,x,y", 1_000.0));
    write(folder, "units.csv", field("time_s,robot,x_mm,y_mm", 1_000.0));
    let (told, _) = judged(folder, "mm.csv --clauses CHAIN-3 --map open:12x3", 3);
    says(&told, &["are they millimetres?", "CHAIN-3: unknown: more than half"]);
    let (told, _) = judged(folder, "field.csv --clauses CHAIN-3 --map open:3x3", 3);
    assert!(!told.contains("millimetres") && told.contains("off the map, first in line 3"), "{told}");
    judged(folder, "units.csv --clauses CHAIN-3 --map open:12x3", 1);
    let arguments = "field.csv --clauses FRONTIER-1 --map open:12x1 --svg missed.svg";
    let (told, _) = judged(folder, arguments, 1);
    assert!(told.contains("nobody was in 3 cells, the first is (9,0)"), "{told}");
    // The picture frames each of them.
    let picture = read(folder, "missed.svg");
    let framed =
        [9, 10, 11].map(|column| format!("<rect class=\"unseen\" x=\"{}\" y=\"3\"", 24 * column + 3));
    assert!(framed.iter().all(|frame| picture.contains(frame)), "{picture}");
    assert_eq!(picture.matches("class=\"unseen\"").count(), framed.len(), "{picture}");
    let wall = "tautline layout 1\n\
                +--+--+--+--+--+--+--+--+--+--+--+--+\n\
                |  |                                |\n\
                +--+--+--+--+--+--+--+--+--+--+--+--+\n";
    write(folder, "wall.txt", wall);
    let (told, _) = judged(folder, "field.csv --clauses CHAIN-2 --map wall.txt", 0);
    assert!(told.contains("a step through a wall of the map, first in line"), "{told}");
}

/// The lower left corner of the image is at -1,-1, and its lowest row of pixels is blocked.
#[test]
fn a_ros_map_lies_where_it_says_in_cells_of_the_size_that_is_asked_for() {
    let folder = &with_log();
    let image = format!("P2\n20 6\n255\n{}{}", "255 ".repeat(100), "0 ".repeat(20));
    write(folder, "floor.pgm", image);
    let yaml = "image: floor.pgm\nmode: trinary\nresolution: 0.5\norigin: [-1.0, -1.0, 0.0]\n\
                negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    write(folder, "floor.yaml", yaml);
    // Ten columns from x = -1 on, of which robots reach 1 to 9; two of three rows are free, from y = 0 on.
    let (told, _) =
        judged(folder, "field.csv --clauses FRONTIER-1,CHAIN-2 --map floor.yaml --cell 1 --radius 0.4", 1);
    says(&told, &["nobody was in 11 cells, the first is (0,0)", "CHAIN-2: kept"]);
    assert!(!told.contains("off the map"), "{told}");
    let (told, _) =
        judged(folder, "field.csv --clauses CHAIN-2 --map floor.yaml --cell 1 --radius 0.4 --origin 0,5", 3);
    assert!(told.contains("240 × a position in a blocked cell or off the map"), "{told}");
}

#[test]
fn what_cannot_be_judged_is_refused_with_what_would_be_right() {
    let folder = &with_log();
    let write = |name: &str, text: &str| write(folder, name, text);
    write("nobody.csv", "robot_a,1\n");
    write("twice.csv", "ugv1,1\nugv1,2\n");
    write("lost.csv", "time,robot,x,y\n0,a,NaN,0\n0,b,0,0\n");
    write("bad.csv", "time,robot,x,y\n0,a,0,0\n1,a,0.0.1,0\n");
    write("scan.mcap", "\u{89}");
    for (arguments, words) in [
        ("field.csv --clauses CHAIN-1", "it speaks of the moments after team moves"),
        ("field.csv --clauses FOO-1", "there is no such clause; name some of CHAIN-2"),
        ("field.csv --clauses KIT-1", "KIT-1 speaks of two robots, and the log has 4"),
        ("field.csv --clauses FRONTIER-1", "give a --map"),
        ("field.csv --clauses CHAIN-3 --least 3", "--least has no effect"),
        ("field.csv --clauses KIT-3 --range 3", "--range has no effect"),
        ("field.csv --clauses KIT-3 --cell 3", "--cell has no effect"),
        ("field.csv --clauses CHAIN-3 --range 3 --cell 3", "--cell has no effect"),
        ("field.csv --clauses CHAIN-3 --origin 1,1", "--origin has no effect"),
        ("field.csv --clauses PACK-2 --map open:9x9 --base 1,1", "--base has no effect"),
        ("field.csv --clauses CHAIN-2 --tolerance 0.5", "give a --tolerance below half a --cell"),
        ("field.csv --clauses KIT-3 --tolerance 3", "give a --tolerance below --least"),
        ("field.csv --clauses CHAIN-3 --tolerance 100000", "give a --tolerance below the range of 2.549 m"),
        ("field.csv --clauses KIT-12 --range 3 --tolerance 3", "give a --tolerance below the range of 3 m"),
        ("field.csv --clauses CHAIN-2 --map field.csv", "field.csv:1"),
        ("field.csv --clauses PACK-2 --base 1,1", "--base has no effect"),
        ("field.csv --clauses CHAIN-2 --map open:9x9 --base 9,9", "the base 9,9 is outside"),
        ("field.csv --clauses PACK-2 --origin=NaN,0", "write metres from -1000000 to 1000000"),
        ("field.csv --clauses PACK-2 --origin 0,1e12", "write metres from -1000000 to 1000000"),
        ("lost.csv --clauses CHAIN-2", "the log has no position of robot 1"),
        ("field.csv --clauses CHAIN-3 --names nobody.csv", "which has ugv1, ugv2, ugv3, ugv4"),
        ("field.csv --clauses CHAIN-3 --names twice.csv", "twice.csv:2"),
        ("bad.csv --clauses CHAIN-3", "bad.csv:3:5"),
        ("gone.csv --clauses CHAIN-3", "gone.csv"),
        ("field.csv --clauses CHAIN-3 --svg field.csv --force", "field.csv"),
    ] {
        let (_, said) = judged(folder, arguments, 2);
        assert!(
            said.contains(words) && said.contains("Help:") | said.contains("--help"),
            "{arguments}: {said}"
        );
    }
    assert!(read(folder, "field.csv").starts_with("time,"));
}

#[test]
fn robots_at_one_point_of_a_border_are_not_said_to_be_in_two_cells() {
    let folder = &folder();
    let log = |name: &str, robots: &[&str]| {
        let rows = ["0", "0.5"]
            .iter()
            .flat_map(|time| robots.iter().map(move |robot| format!("{time},{robot},1,0.5\n")));
        write(folder, name, "time,robot,x,y\n".to_owned() + &rows.collect::<String>());
    };
    log("two.csv", &["a", "b"]);
    log("three.csv", &["a", "b", "c"]);
    let (told, _) = judged(folder, "two.csv --clauses PACK-2,pack-2", 3);
    let why =
        "PACK-2: unknown: at 0 s robots 1 (a) and 2 (b) may be in the cell (0,0), at whose border they are";
    assert_eq!(told.matches(why).count(), 1, "{told}");
    let (told, _) = judged(folder, "three.csv --clauses PACK-2", 1);
    says(&told, &["3 (c) are in the cells (0,0) and (1,0), at most 2 may be (line 4; at 2 stamps in all)"]);
    let (told, _) = judged(folder, "three.csv --clauses CHAIN-2", 3);
    says(
        &told,
        &["CHAIN-2: unknown: the base is the cell in which robot 1 is first, and it is at the border"],
    );
    let (told, _) = judged(folder, "three.csv --clauses CHAIN-2 --base 1,0", 3);
    says(&told, &["CHAIN-2: unknown: at 0 s robots 1 (a) and 2 (b) and 3 (c) may be in the cell (0,0)"]);
}

/// Two robots that share a name, or one that is told of twice: which line stands first says nothing.
#[test]
fn a_robot_at_several_places_at_one_stamp_keeps_no_clause_in_any_order() {
    let folder = &folder();
    for [first, second] in [["50", "1"], ["1", "50"]] {
        let rows = format!("0,b,{first},0\n0,b,{second},0\n0.25,a,0,0\n0.25,b,1,0\n");
        write(folder, "log.csv", "time,robot,x,y\n0,a,0,0\n".to_owned() + &rows);
        let (told, _) = judged(folder, "log.csv --clauses CHAIN-3,KIT-1,PACK-2", 3);
        let why = "unknown: robot 2 (b) is at several places at 0 s, farther apart than --tolerance (line 4)";
        assert_eq!(told.matches(why).count(), 3, "{told}");
        says(&told, &["2 × not taken: a position of a robot that is somewhere else at the same stamp"]);
    }
}

/// Without a map its rows are counted northwards, as those of the log are.
#[test]
fn a_base_needs_no_map() {
    let folder = &folder();
    let rows = ["a", "b", "c"].map(|robot| format!("0,{robot},1.5,2.5\n"));
    write(folder, "base.csv", "time,robot,x,y\n".to_owned() + &rows.concat());
    judged(folder, "base.csv --clauses CHAIN-2 --base 1,2", 0);
    let (told, _) = judged(folder, "base.csv --clauses CHAIN-2 --base 1,1", 1);
    says(&told, &["are in the cell (1,2), at most 2 may be"]);
    judged(folder, "base.csv --clauses CHAIN-2 --base 1,1 --map open:3x4", 0);
}

#[test]
fn a_log_that_is_cut_keeps_nothing() {
    let folder = &with_log();
    let text = read(folder, "field.csv");
    // Ten seconds of it: nothing is broken before 20 s.
    let end = text.find("10,ugv3").expect("a line") + 6;
    write(folder, "cut.csv", &text[..end]);
    let (told, _) = judged(folder, "cut.csv --clauses CHAIN-3,PACK-2", 3);
    let why = "unknown: the log is cut, and the run may have gone on";
    says(
        &told,
        &[
            "the log is cut in line",
            "which has no line break, and is not taken",
            &format!("CHAIN-3: {why}"),
            &format!("PACK-2: {why}"),
        ],
    );
}

/// The east room is a robot's own; its first place is a finger's breadth within the wall.
#[test]
fn a_robot_that_is_first_within_the_tolerance_of_a_cell_has_to_visit_what_it_can_reach() {
    let folder = &folder();
    write(folder, "rooms.map", "type octile\nheight 1\nwidth 4\nmap\n.@..\n");
    write(folder, "rooms.csv", "time,robot,x,y\n0,a,0.5,0.5\n0,b,1.98,0.5\n1,a,0.5,0.5\n1,b,2.5,0.5\n");
    let (told, _) = judged(folder, "rooms.csv --clauses FRONTIER-1 --map rooms.map", 1);
    says(&told, &["nobody was in 1 cell, the first is (3,0)"]);
    write(folder, "wall.csv", "time,robot,x,y\n0,a,0.5,0.5\n0,b,1.5,0.5\n1,a,0.5,0.5\n1,b,2.5,0.5\n");
    let (told, _) = judged(folder, "wall.csv --clauses FRONTIER-1 --map rooms.map", 3);
    says(&told, &["FRONTIER-1: unknown: robot 2 (b) is not first in a free cell of the map"]);
}

#[test]
fn numbers_of_robots_are_those_of_the_file_of_names() {
    let folder = &with_log();
    write(folder, "names.csv", "name,robot\nugv3,1\nugv4,2\nugv9,3\n");
    let (told, _) = judged(folder, "field.csv --clauses CHAIN-3,KIT-12 --names names.csv", 3);
    says(&told, &["120 × not taken: a name that is no robot", "not in the log: ugv9"]);
    assert!(told.contains("CHAIN-3: broken at 20 s: robots 1 (ugv3) and 2 (ugv4)"), "{told}");
    assert!(told.contains("KIT-12: unknown: the log has no position of robot 3 (ugv9)"), "{told}");
}

#[test]
fn names_that_steer_a_terminal_or_break_xml_are_shown_as_text() {
    let folder = &with_log();
    let rows = [0, 2, 9].map(|x| format!(r#"{{"t":0,"robot":"{x}\n\u001b[31m","x":{x},"y":0}}"#));
    write(folder, "R&D.jsonl", rows.join("\n"));
    let (told, _) = judged(folder, "R&D.jsonl --clauses CHAIN-3 --svg moment.svg", 1);
    assert!(told.contains("2 (2 \u{fffd}[31m) and 3 (9 \u{fffd}[31m) are 7 m apart"), "{told}");
    assert_eq!((told.lines().count(), told.contains('\u{1b}')), (4, false), "{told}");
    says(&read(folder, "moment.svg"), &["<title>tautline judge R&amp;D.jsonl</title>"]);
}

/// `logs/tests/logs` says which programs have written them.
#[test]
fn logs_of_other_programs_are_judged() {
    let log = |name: &str| format!("{}/logs/tests/logs/{name}", env!("CARGO_MANIFEST_DIR"));
    let folder = &with_log();
    let (told, _) = judged(folder, &format!("{} --clauses KIT-3,KIT-12", log("sumo-fcd.csv")), 3);
    assert!(told.contains("72 positions of 3 robots in 15.5 s"), "{told}");
    assert!(told.contains("KIT-3: unknown: robot 2 (cart_1) is silent from 0 s to 4 s"), "{told}");
    judged(folder, &format!("{} --clauses KIT-3 --gap 5", log("sumo-fcd.csv")), 3);
    judged(folder, &format!("{} --clauses KIT-3 --gap 8", log("sumo-fcd.csv")), 0);
    let (told, _) = judged(folder, &format!("{} --clauses KIT-1,CHAIN-3", log("rosbags.mcap")), 1);
    assert!(told.contains("KIT-1: kept") && told.contains("2.692 m apart, at most 2.549 m"), "{told}");
}
