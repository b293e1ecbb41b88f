//! Input that is wrong ends the program with exit code 2, and with what would be right.

use super::team::{domain, program};
use std::fs;
use std::net::UdpSocket;
use tempfile::TempDir;

/// The exit code of a call, and what it said.
fn call(arguments: &[&str]) -> (Option<i32>, String) {
    let output = program().args(arguments).output().expect("the program");
    (output.status.code(), String::from_utf8(output.stderr).expect("text"))
}

/// The words with which a configuration is refused.
fn refused(text: &str) -> String {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("wrong.toml");
    fs::write(&file, text).expect("a file");
    let (code, said) = call(&[file.to_str().expect("Unicode")]);
    assert_eq!(code, Some(2), "{text}\n{said}");
    assert!(said.contains("wrong.toml"), "{said}");
    said
}

#[test]
fn a_clause_that_cannot_be_watched_is_refused_with_its_line_and_what_would_be_right() {
    let head = "gap_s = 0.5\nrobots = [{ name = 'a' }, { name = 'b' }]\n[[clauses]]\ntolerance_m = 0.1\n";
    for (clause, line, right) in [
        ("clause = 'CHAIN-9'\nrange_m = 2", "line 5", "expected one of `CHAIN-2`, `CHAIN-3`"),
        ("clause = 'CHAIN-3'\nrange_m = 2\nspeed = 1", "line 7", "unknown field `speed`, expected one of"),
        (
            "clause = 'CHAIN-3'\nrange_m = 2\nrobots = ['a', 'c']",
            ":7:",
            "no robot is called c: there are a, b",
        ),
        ("clause = 'CHAIN-3'\nrange_m = 2\nrobots = ['a', 'a']", ":5:", "a robot of CHAIN-3 is named twice"),
        ("clause = 'CHAIN-3'\nrange_m = 2\nrobots = ['a']", ":5:", "CHAIN-3 is of 2 to 64 robots, not of 1"),
        ("clause = 'CHAIN-3'", ":5:", "CHAIN-3 needs its range_m"),
        ("clause = 'CHAIN-3'\ncell_m = 1", ":6:", "CHAIN-3 has no cell_m: give its range_m"),
        ("clause = 'CHAIN-3'\nrange_m = nan", ":6:", "range_m is from 0.001 to 1000000 metres"),
        ("clause = 'PACK-2'\ncell_m = 1\nbase = [0, 0]", ":7:", "PACK-2 has no base"),
        (
            "clause = 'KIT-3'\nleast_m = 0.1",
            ":4:",
            "positions say nothing of KIT-3: give a tolerance_m below its least_m",
        ),
        ("clause = 'CHAIN-3'\nrange_m = 0.1", ":4:", "give a tolerance_m below its range_m"),
        ("clause = 'CHAIN-2'\ncell_m = 0.2", ":4:", "give a tolerance_m below half its cell_m"),
    ] {
        let said = refused(&format!("{head}{clause}"));
        assert!(said.contains(line) && said.contains(right), "{clause}\n{said}");
    }
}

#[test]
fn a_map_of_names_that_cannot_be_heard_is_refused_with_its_line_and_what_would_be_right() {
    let clause = "[[clauses]]\nclause = 'KIT-3'\nleast_m = 3\ntolerance_m = 0\n";
    let robots = "[[robots]]\nname = 'a'\n[[robots]]\nname = 'b'\n";
    for (text, line, right) in [
        (clause.to_owned(), ":1:", "no robot is named: write [[robots]]"),
        (robots.to_owned(), ":1:", "no clause is named: write [[clauses]]"),
        (format!("{robots}[[robots]]\nname = 'a'"), ":7:", "two robots are called a"),
        (format!("{robots}[[robots]]\nname = 'c'\ntopic = '/a/pose'"), ":8:", "c would hear the topic of a"),
        (format!("{robots}[[robots]]\nname = 'c'\ntopic = '/c pose'"), ":8:", "write letters, digits and _"),
        (
            format!("{robots}[[robots]]\nname = 'c'\ntype = 'Pose'"),
            "line 8",
            "expected `geometry_msgs/PoseStamped`",
        ),
        (
            format!("{robots}[[robots]]\nname = 'c'\n{clause}robots = ['a', 'b']"),
            ":7:",
            "c is in no clause: name it in one, or leave it out",
        ),
    ] {
        let said = refused(&format!("gap_s = 0.5\n{text}"));
        assert!(said.contains(line) && said.contains(right), "{text}\n{said}");
    }
    assert!(refused("gap_s = 0").contains(":1: gap_s is from 0.001 to 3600 seconds"));
    assert!(refused("gap_s = ").contains("line 1"));
}

#[test]
fn wrong_arguments_are_refused() {
    for (arguments, said) in [
        ("", "<CONFIG>"),
        ("nowhere.toml", "nowhere.toml: No such file"),
        ("--clause CHAIN-9", "possible values: CHAIN-2, CHAIN-3"),
        ("--clause CHAIN-3", "--robots"),
        ("--clause CHAIN-3 --robots 3 --tolerance-m 0.1 --gap-s 1", "CHAIN-3 needs its range_m"),
        (
            "--clause KIT-1 --robots 3 --range-m 2 --tolerance-m 0.1 --gap-s 1",
            "KIT-1 speaks of two robots, not of 3: name two, or take KIT-12",
        ),
        ("--clause KIT-2 --robots 4 --range-m 2 --tolerance-m 0.1 --gap-s 1", "KIT-2 speaks of two robots"),
        ("--clause CHAIN-3 --robots 65 --range-m 2 --tolerance-m 0.1 --gap-s 1", "2 to 64 robots"),
        (
            "--clause CHAIN-3 --robots 3 --range-m 0 --tolerance-m 0.1 --gap-s 1",
            "tautline-ros: range_m is from 0.001 to 1000000 metres",
        ),
        (
            "--clause CHAIN-3 --robots 3 --range-m 2 --tolerance-m 0.1 --gap-s nan",
            "tautline-ros: gap_s is from 0.001 to 3600 seconds",
        ),
        ("some.toml --domain 232", "231"),
    ] {
        let (code, told) = call(&arguments.split_whitespace().collect::<Vec<_>>());
        assert!(code == Some(2) && told.contains(said), "{arguments}\n{told}");
    }
}

#[test]
fn a_port_of_the_domain_that_another_program_keeps_for_itself_is_named() {
    let domain = domain(2);
    let port = 7_400 + 250 * domain;
    let _taken = UdpSocket::bind(("0.0.0.0", port)).expect("a port that nobody has");
    let arguments = "--clause CHAIN-3 --robots 3 --range-m 2 --tolerance-m 0.1 --gap-s 1 --domain";
    let domain = domain.to_string();
    let (code, told) = call(&arguments.split(' ').chain([domain.as_str()]).collect::<Vec<_>>());
    assert_eq!(code, Some(2), "{told}");
    assert!(told.contains(&format!("UDP port {port}")) && told.contains("choose another --domain"), "{told}");
}
