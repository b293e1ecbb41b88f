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

const ROBOTS: &str = "gap_s = 0.5\nrobots = [{ name = 'a' }, { name = 'b' }]\n";

#[test]
fn a_wrong_configuration_is_refused_with_its_line_and_what_would_be_right() {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("wrong.toml");
    let file = file.to_str().expect("Unicode");
    let clause = |rest: &str| format!("{ROBOTS}[[clauses]]\ntolerance_m = 0.1\n{rest}");
    for (text, line, said) in [
        (clause("clause = 'CHAIN-9'\nrange_m = 2"), "line 5", "expected one of `CHAIN-2`, `CHAIN-3`"),
        (clause("clause = 'CHAIN-3'\nrange_m = 2\nspeed = 1"), "line 7", "unknown field `speed`"),
        ("gap_s = ".to_owned(), "line 1", "expected"),
        (
            "gap_s = 0.5\n[[clauses]]\nclause = 'CHAIN-3'\nrange_m = 2\ntolerance_m = 0".to_owned(),
            ":1:",
            "no robot is named: write [[robots]]",
        ),
        (ROBOTS.to_owned(), ":1:", "no clause is named: write [[clauses]]"),
        (
            clause("clause = 'CHAIN-3'\nrange_m = 2\nrobots = ['a', 'c']"),
            ":7:",
            "no robot is called c: there are a, b",
        ),
        (
            clause("clause = 'CHAIN-3'\nrange_m = 2\nrobots = ['a', 'a']"),
            ":5:",
            "a robot of CHAIN-3 is named twice",
        ),
        (
            clause("clause = 'CHAIN-3'\nrange_m = 2\nrobots = ['a']"),
            ":5:",
            "CHAIN-3 would be of 1 robots: name 2 to 16",
        ),
        (clause("clause = 'CHAIN-3'"), ":5:", "CHAIN-3 needs its range_m"),
        (clause("clause = 'CHAIN-3'\ncell_m = 1"), ":6:", "CHAIN-3 has no cell_m: give its range_m"),
        (clause("clause = 'CHAIN-3'\nrange_m = nan"), ":6:", "range_m is from 0.001 to 1000000 metres"),
        (clause("clause = 'PACK-2'\ncell_m = 1\nbase = [0, 0]"), ":7:", "PACK-2 has no base"),
        (clause("clause = 'KIT-3'\nleast_m = 3\n[[robots]]\nname = 'c'"), "", ""),
        ("gap_s = 0\n".to_owned(), ":1:", "gap_s is from 0.001 to 3600 seconds"),
        (
            "gap_s = 1\n[[robots]]\nname = 'a'\n[[robots]]\nname = 'a'".to_owned(),
            ":5:",
            "two robots are called a",
        ),
        (
            "gap_s = 1\n[[robots]]\nname = 'a'\n[[robots]]\nname = 'b'\ntopic = '/a/pose'".to_owned(),
            ":6:",
            "b would hear the topic of a, /a/pose",
        ),
        (
            "gap_s = 1\n[[robots]]\nname = 'a'\ntopic = '/a pose'".to_owned(),
            ":4:",
            "is no name of a topic: write letters",
        ),
        (
            "gap_s = 1\n[[robots]]\nname = 'a'\ntype = 'geometry_msgs/Pose'".to_owned(),
            "line 4",
            "expected `geometry_msgs/PoseStamped` or `nav_msgs/Odometry`",
        ),
    ] {
        fs::write(file, &text).expect("a file");
        let (code, told) = call(&[file]);
        assert_eq!(code, Some(2), "{text}\n{told}");
        assert!(told.contains(line) && told.contains(said) && told.contains("wrong.toml"), "{text}\n{told}");
    }
    fs::write(file, format!("gap_s = 1\n[[robots]]\nname = 'a'\n[[robots]]\nname = 'b'\n[[robots]]\nname = 'c'\n[[clauses]]\nclause = 'KIT-3'\nleast_m = 3\ntolerance_m = 0\nrobots = ['a', 'b']")).expect("a file");
    assert!(call(&[file]).1.contains(":7: c is in no clause: name it in one, or leave it out"));
    let (code, told) = call(&["nowhere.toml"]);
    assert!(code == Some(2) && told.contains("nowhere.toml: "), "{told}");
}

#[test]
fn wrong_arguments_are_refused() {
    for (arguments, said) in [
        ("", "<CONFIG>"),
        ("--clause CHAIN-9", "possible values: CHAIN-2, CHAIN-3"),
        ("--clause CHAIN-3", "--robots"),
        ("--clause CHAIN-3 --robots 3 --tolerance-m 0.1 --gap-s 1", "CHAIN-3 needs its range_m"),
        ("--clause CHAIN-3 --robots 17 --range-m 2 --tolerance-m 0.1 --gap-s 1", "name 2 to 16"),
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
