//! With `--ascii` nothing but ASCII is printed, on stdout and on stderr; drawings keep their columns, and JSON its
//! values.

use std::fs;

use serde_json::Value;

use super::{folder, ran};

/// Commands of every kind, with what is not ASCII in their drawings, tables, errors or helps.
const COMMANDS: [&str; 16] = [
    "explore walls:7x7:0.1 --robots 4 --draw order",
    "explore walls:7x7:0.1 --robots 4 --draw moves",
    "explore office:12x12:3x3 --scheme bricks --robots 3 --draw moves",
    "explore cells:7x7:0.1 --scheme frontier --robots 3",
    "show environments",
    "schemes",
    "library",
    "prove KIT-4 CHAIN-20 NOTICE-4",
    "hunt --scheme bricks --rule published --size 3x3 --max-misses 1 --format junit",
    "rescue --nodes 100 --seeds 0..3",
    "locate --runs 100",
    "reproduce",
    "explore f\u{fc}r.txt",
    "show \u{65e5}",
    "explore --help",
    "man explore",
];

#[test]
fn nothing_but_ascii_is_printed_in_as_many_lines() {
    let folder = &folder();
    fs::write(folder.join("f\u{fc}r.txt"), "tautline layout 1\n+--+\n|\u{e4}\u{2026} |\n+--+\n")
        .expect("a file");
    for command in COMMANDS {
        let words: Vec<&str> = command.split(' ').collect();
        let [usual, ascii] =
            [&[][..], &["--ascii"]].map(|option: &[&str]| ran(folder, &[option, &words].concat()));
        assert_eq!(usual.status, ascii.status, "{command}");
        for (usual, ascii) in [(&usual.stdout, &ascii.stdout), (&usual.stderr, &ascii.stderr)] {
            let [usual, ascii] = [usual, ascii].map(|text| String::from_utf8(text.clone()).expect("text"));
            assert!(ascii.is_ascii(), "{command}: {ascii}");
            assert_eq!(usual.lines().count(), ascii.lines().count(), "{command}");
            if usual.is_ascii() {
                assert_eq!(usual, ascii, "{command}");
            }
        }
    }
}

#[test]
fn a_drawing_has_its_columns_and_a_file_its_signs() {
    let folder = &folder();
    let explore = ["explore", "open:4x3", "--scheme", "bricks", "--robots", "1", "--draw", "moves"];
    let drawn = |more: &[&str]| {
        let output = ran(folder, &[&explore[..], more].concat());
        String::from_utf8(output.stdout).expect("text")
    };
    let (usual, ascii) = (drawn(&["--html", "usual.html"]), drawn(&["--html", "ascii.html", "--ascii"]));
    assert!(usual.contains('\u{2591}') && ascii.contains("%%%"), "{ascii}");
    let is_drawn = |line: &&str| line.starts_with(['+', '|']);
    let widths = |text: &str| -> Vec<usize> {
        text.lines().filter(is_drawn).map(|line| line.chars().count()).collect()
    };
    assert_eq!(widths(&usual), widths(&ascii));
    let page = |name: &str| fs::read(folder.join(name)).expect("a page");
    assert_eq!(page("usual.html"), page("ascii.html"));
}

#[test]
fn json_means_what_it_meant() {
    let folder = &folder();
    for command in
        ["prove KIT-4 CHAIN-20 --format json", "schemes --format json", "library --format json rmf-lane"]
    {
        let words: Vec<&str> = command.split(' ').collect();
        let value = |option: &[&str]| -> Value {
            let output = ran(folder, &[option, &words].concat());
            assert!(option.is_empty() || output.stdout.is_ascii(), "{command}");
            let mut value: Value = serde_json::from_slice(&output.stdout).expect("JSON");
            // A measurement.
            for line in value["clauses"].as_array_mut().into_iter().flatten() {
                line["seconds"] = 0.into();
            }
            value
        };
        assert_eq!(value(&[]), value(&["--ascii"]), "{command}");
    }
}

#[test]
fn what_a_program_of_ones_own_is_given_is_not_ours() {
    let folder = &folder();
    let said = ran(folder, &["conform", "f\u{fc}r.jsonl", "--", "robots", "--ascii"]);
    assert!(String::from_utf8(said.stderr).expect("text").contains("f\u{fc}r.jsonl"));
}
