//! The files that commands store: where they may stand, what becomes of them when there is no room, and that no signal
//! leaves anything half-written.

use std::io::Write;

use super::*;

/// A map of 4x3 cells as MovingAI has it.
const MAP: &str = "type octile\nheight 3\nwidth 4\nmap\n....\n.@..\n....\n";

/// Makes `pipe`, a pipe.
#[cfg(unix)]
fn make_pipe(folder: &Path) {
    let made = Command::new("mkfifo").arg(folder.join("pipe")).status().expect("mkfifo runs");
    assert!(made.success());
}

/// The texts on stdout and on stderr of a program that ends with 2: something was left out, and the rest given.
pub(crate) fn left_out(folder: &Path, arguments: &[&str]) -> (String, String) {
    let output = ran(folder, arguments);
    let errors = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {errors}");
    (String::from_utf8(output.stdout).expect("text"), errors)
}

#[test]
fn what_a_command_reads_is_never_overwritten_by_whatever_name() {
    let folder = &folder();
    write(folder, "own.map", MAP);
    let yaml = "image: floor.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n\
                free_thresh: 0.196\n";
    write(folder, "floor.yaml", yaml);
    let image = "P2\n2 2\n255\n255 255\n255 255\n";
    write(folder, "floor.pgm", image);
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    let run = read(folder, "run.jsonl");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("own.map", folder.join("link")).expect("a link");
        fs::hard_link(folder.join("own.map"), folder.join("hard")).expect("a link");
        for other in ["link", "hard"] {
            refused(folder, &["explore", "own.map", "--robots", "2", "--trace", other, "--force"]);
            refused(folder, &["explore", other, "--robots", "2", "--trace", "own.map", "--force"]);
        }
    }
    let before = names(folder);
    let twice: [&[&str]; 9] = [
        &["explore", "own.map", "--robots", "2", "--trace", "own.map"],
        &["explore", "own.map", "--robots", "2", "--trace", "./own.map"],
        &["explore", "own.map", "--robots", "2", "--html", "own.map"],
        &["show", "own.map", "--svg", "own.map"],
        &["show", "floor.yaml", "--svg", "floor.yaml"],
        &["show", "floor.yaml", "--svg", "floor.pgm"],
        &["show", "floor.yaml", "--image", "floor.pgm", "--svg", "./floor.pgm"],
        &["replay", "run.jsonl", "--html", "run.jsonl"],
        &["replay", "run.jsonl", "--svg", "run.jsonl"],
    ];
    for arguments in twice {
        let said = refused(folder, arguments);
        assert!(said.contains("this command reads this file, and does not overwrite it"), "{said}");
        assert_eq!(refused(folder, &[arguments, &["--force"]].concat()), said);
    }
    assert_eq!(names(folder), before);
    assert_eq!((read(folder, "own.map"), read(folder, "floor.yaml")), (MAP.to_owned(), yaml.to_owned()));
    assert_eq!((read(folder, "floor.pgm"), read(folder, "run.jsonl")), (image.to_owned(), run));
}

#[test]
fn what_tautline_did_not_write_is_replaced_only_with_force() {
    let folder = &folder();
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    let explore = ["explore", "open:3x3", "--robots", "2"];
    let rescue = ["rescue", "--seeds", "0"];
    let stored: [(&[&str], &str); 10] = [
        (&explore, "--trace"),
        (&explore, "--html"),
        (&explore, "--svg"),
        (&rescue, "--trace"),
        (&rescue, "--html"),
        (&rescue, "--svg"),
        (&["replay", "run.jsonl"], "--html"),
        (&["replay", "run.jsonl"], "--svg"),
        (&["show", "rooms-a"], "--svg"),
        (&["reproduce", "antenna-fig4", "--runs", "10"], "--svg"),
    ];
    for (arguments, option) in stored {
        let arguments = [arguments, &[option, "mine"]].concat();
        write(folder, "mine", "a thesis\n");
        says(&refused(folder, &arguments), &["mine: tautline did not write this file"]);
        assert_eq!(read(folder, "mine"), "a thesis\n");
        printed(folder, &[&arguments[..], &["--force"]].concat(), 0);
        let made = read(folder, "mine");
        assert_ne!(made, "a thesis\n");
        // What it wrote itself it replaces, and what holds nothing.
        printed(folder, &arguments, 0);
        write(folder, "mine", "");
        printed(folder, &arguments, 0);
        assert_eq!(read(folder, "mine"), made);
    }
    assert_eq!(names(folder), ["mine", "run.jsonl"]);
    assert_snapshot!(refused(folder, &["show", "rooms-a", "--force"]), @r"
    Error: --force has no effect: no file is to be stored
     Help: leave --force out
    ");
}

#[test]
fn a_counterexample_that_has_no_place_is_left_out_and_the_others_are_stored() {
    let folder = &folder();
    let hunt = ["hunt", "--rule", "published", "--max-cells", "10", "--max-walls", "13"];
    let (mine, other) = ("chain-1-published-n4.jsonl", "chain-2-published-n4.jsonl");
    write(folder, mine, "a thesis\n");
    let (told, said) = left_out(folder, &hunt);
    assert!(said.contains("chain-1-published-n4.jsonl: tautline did not write this file"), "{said}");
    assert!(told.contains("\nCHAIN-1, 3x3 cells") && !told.contains(mine), "{told}");
    assert!(told.contains(other), "{told}");
    assert_eq!(read(folder, mine), "a thesis\n");
    printed(folder, &["replay", other], 1);
    let (told, _) = left_out(folder, &[&hunt[..], &["--format", "json"]].concat());
    let told: Value = serde_json::from_str(&told).expect("JSON");
    let files: Vec<&Value> =
        told["counterexamples"].as_array().expect("a list").iter().map(|one| &one["file"]).collect();
    assert_eq!(files, [&Value::Null, &Value::from(other)]);
}

#[test]
fn a_hunt_names_each_file_that_it_writes() {
    let folder = &folder();
    let hunt = ["hunt", "--rule", "published", "--robots", "4", "--max-walls", "2", "--resume", "kept.json"];
    let told = printed(folder, &hunt, 1);
    let found = json(folder, &hunt, 1);
    assert_eq!(found["kept"], "kept.json");
    let mut named: Vec<&str> = found["counterexamples"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|one| one["file"].as_str().expect("a name"))
        .chain(found["kept"].as_str())
        .collect();
    named.sort_unstable();
    assert_eq!(names(folder), named);
    assert!(named.iter().all(|name| told.contains(name)), "{told}");
}

#[cfg(unix)]
#[test]
fn a_symbolic_link_is_followed_and_stays() {
    use std::os::unix::fs::symlink;
    let folder = &folder();
    fs::create_dir(folder.join("far")).expect("a folder");
    symlink("far/run.jsonl", folder.join("link")).expect("a link");
    symlink("link", folder.join("second")).expect("a link");
    symlink("round", folder.join("about")).expect("a link");
    symlink("about", folder.join("round")).expect("a link");
    let explore = |side: &str, name: &str| {
        let layout = format!("open:{side}");
        printed(folder, &["explore", &layout, "--robots", "2", "--trace", name], 0);
        read(&folder.join("far"), "run.jsonl")
    };
    // It leads to nothing as yet; then to a file that is replaced, over two links.
    let first = explore("3x3", "link");
    assert_ne!(explore("2x2", "second"), first);
    assert_eq!(explore("3x3", "far/run.jsonl"), first);
    for name in ["link", "second"] {
        assert!(fs::symlink_metadata(folder.join(name)).expect("a link").is_symlink(), "{name}");
    }
    assert_eq!(names(&folder.join("far")), ["run.jsonl"]);
    assert_snapshot!(refused(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "about"]), @r"
    Error: about: the symbolic links lead to no end
     Help: name a file
    ");
    let hunt = ["hunt", "--rule", "repaired", "--robots", "3", "--max-walls", "1", "--resume"];
    symlink("far/kept.json", folder.join("kept")).expect("a link");
    printed(folder, &[&hunt[..], &["kept"]].concat(), 0);
    printed(folder, &[&hunt[..], &["kept"]].concat(), 0);
    assert!(fs::symlink_metadata(folder.join("kept")).expect("a link").is_symlink());
    assert_eq!(names(&folder.join("far")), ["kept.json", "run.jsonl"]);
}

/// A full disk is played by a limit on the size of files.
#[cfg(unix)]
#[test]
fn without_room_for_one_file_the_rest_is_stored_and_printed() {
    let folder = &folder();
    let limited = |kilobytes: u32, arguments: &str, output: &str| {
        let program = env!("CARGO_BIN_EXE_tautline");
        let script = format!("ulimit -f {}; exec {program} {arguments} {output}", 2 * kilobytes);
        let mut shell = Command::new("sh");
        shell.current_dir(folder).env("NO_COLOR", "1").args(["-c", &script]);
        let output = shell.output().expect("a shell");
        let errors = String::from_utf8(output.stderr).expect("text");
        (output.status.code(), String::from_utf8(output.stdout).expect("text"), errors)
    };
    let explore = "explore open:15x15 --robots 8";
    let (_, whole, _) = limited(1_000, explore, "");
    let (code, told, said) =
        limited(48, &format!("{explore} --trace t.jsonl --html page.html --svg s.svg"), "");
    assert_eq!((code, &told), (Some(2), &whole), "{said}");
    assert!(said.contains("page.html: it is left out, there is no room for it"), "{said}");
    assert_eq!(names(folder), ["s.svg", "t.jsonl"]);
    let (code, told, said) = limited(4, &format!("{explore} --trace u.jsonl"), "");
    assert_eq!((code, &told), (Some(2), &whole), "{said}");
    let (code, _, said) =
        limited(4, "explore open:99x99 --scheme frontier --robots 1 --until 50 --map m.yaml", "");
    assert_eq!((code, names(folder).contains(&"m.yaml".to_owned())), (Some(2), false), "{said}");
    let (code, ..) = limited(4, "rescue --seeds 0 --trace r.jsonl --html r.html --svg r.svg", "");
    assert_eq!(code, Some(2));
    let (code, told, _) = limited(4, "hunt --rule published --max-walls 2 --resume kept.json", "");
    assert_eq!((code, told.contains("CHAIN-13, 2 walls")), (Some(2), true), "{told}");
    for name in names(folder) {
        assert!(is_whole(folder, &name), "{name}");
    }
    assert!(!names(folder).contains(&"u.jsonl".to_owned()));
}

#[cfg(target_os = "linux")]
#[test]
fn files_are_stored_also_if_nothing_can_be_printed() {
    let folder = &folder();
    let full = fs::File::options().write(true).open("/dev/full").expect("a device");
    let explore = ["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl", "--svg", "order.svg"];
    let output = tautline(folder, &explore).stdout(full).output().expect("the program runs");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(names(folder), ["order.svg", "run.jsonl"]);
    printed(folder, &["replay", "run.jsonl"], 0);
}

#[test]
fn a_page_or_picture_that_is_too_large_is_left_out_alone() {
    let folder = &folder();
    let explore = ["explore", "cells:9x9:0.1", "--scheme", "bricks", "--robots", "1", "--draw", "moves"];
    let files = ["--trace", "run.jsonl", "--html", "run.html", "--svg", "moves.svg"];
    let whole = printed(folder, &explore, 0);
    let (told, said) = left_out(folder, &[&explore[..], &files].concat());
    assert_eq!(told, whole);
    assert!(said.contains("a picture of more than 200 team moves"), "{said}");
    assert_eq!(names(folder), ["run.html", "run.jsonl"]);
    // Who does not hear whom takes the most room.
    let deaf = [
        &["explore", "open:9x9", "--scheme", "frontier", "--rule", "plain"][..],
        &["--robots", "64", "--loss", "1"],
    ]
    .concat();
    let (told, said) = left_out(folder, &[&deaf[..], &["--trace", "c.jsonl", "--html", "c.html"]].concat());
    assert!(told.contains("nothing new was found for so long"), "{told}");
    assert!(said.contains("c.html: a page of more than 10 MB is left out"), "{said}");
    assert_eq!(names(folder), ["c.jsonl", "run.html", "run.jsonl"]);
}

#[test]
fn team_moves_that_a_run_does_not_have_are_refused_and_all_are_drawn_where_all_are_wanted() {
    let folder = &folder();
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    let replay = ["replay", "run.jsonl", "--svg", "a.svg"];
    for (moves, why) in [("9..12", "the run has 8 team moves"), ("0..0", "counted from 1 on; write 1..1")] {
        says(&refused(folder, &[&replay[..], &["--moves", moves]].concat()), &[why]);
    }
    assert_eq!(names(folder), ["run.jsonl"]);
    let drawn = |moves: &[&str]| {
        printed(folder, &[&replay[..], moves].concat(), 0);
        read(folder, "a.svg")
    };
    assert_eq!(drawn(&["--all"]), drawn(&["--moves", "1..8"]));
    // A map that is asked for is drawn, however wide.
    let wide = printed(
        folder,
        &["explore", "open:40x1", "--scheme", "frontier", "--robots", "2", "--draw", "map"],
        0,
    );
    assert!(wide.contains("+---+"), "{wide}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_pipe_is_no_place_for_a_file_and_help_that_has_no_place_is_a_fault() {
    let folder = &folder();
    let said = refused(folder, &["show", "open:3x3", "--svg", "/dev/stdout"]);
    assert!(said.contains("/dev/stdout: this is a device or a pipe"), "{said}");
    for asked in ["--help", "--version"] {
        let full = fs::File::options().write(true).open("/dev/full").expect("a device");
        let output = tautline(folder, &[asked]).stdout(full).output().expect("the program runs");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains("standard output"), "{asked}: {said}");
    }
}

#[test]
fn what_is_known_to_be_too_large_is_refused_before_the_work() {
    let folder = &folder();
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    let large = ["explore", "open:4000x4000", "--scheme", "bricks", "--svg", "a.svg"];
    let cases: [&[&str]; 4] = [
        &large,
        &["show", "open:4000x4000", "--svg", "a.svg"],
        &["explore", "open:4000x4000", "--scheme", "ants", "--html", "a.html"],
        &["replay", "run.jsonl", "--moves", "1..201", "--svg", "a.svg"],
    ];
    assert_snapshot!(refusals(folder, &[], &cases), @r"
    $ tautline explore open:4000x4000 --scheme bricks --svg a.svg
    Error: an area of 4000x4000 cells is too large to be drawn
     Help: leave out the picture and the page, or take at most 524288 cells

    $ tautline show open:4000x4000 --svg a.svg
    Error: an area of 4000x4000 cells is too large to be drawn
     Help: leave out the picture and the page, or take at most 524288 cells

    $ tautline explore open:4000x4000 --scheme ants --html a.html
    Error: an area of 4000x4000 cells is too large to be drawn
     Help: leave out the picture and the page, or take at most 524288 cells

    $ tautline replay run.jsonl --moves 1..201 --svg a.svg
    Error: a picture of more than 200 team moves
     Help: store a trace, and draw at most 200 with `tautline replay --moves`
    ");
    assert_eq!(names(folder), ["run.jsonl"]);
}

/// The most memory in KiB that the program has at once, and how it ended; what it prints goes nowhere.
#[cfg(target_os = "linux")]
fn peak_kib(folder: &Path, arguments: &[&str]) -> (u64, Option<i32>) {
    let mut child = tautline(folder, arguments).stdout(Stdio::null()).spawn().expect("the program runs");
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    loop {
        let lines = fs::read_to_string(&status).unwrap_or_default();
        let most = lines.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
        peak = most.and_then(|most| most.parse().ok()).unwrap_or(0).max(peak);
        if let Some(ended) = child.try_wait().expect("a child") {
            return (peak, ended.code());
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Held all at once, the drawings and the JSON of these moves take 40 MB each or more. The page holds what changes
/// alone.
#[cfg(target_os = "linux")]
#[test]
fn however_many_team_moves_are_replayed_memory_stays_bounded() {
    let folder = &folder();
    let explore = ["explore", "cells:96x96:0.1", "--scheme", "bricks", "--robots", "80"];
    printed(folder, &[&explore[..], &["--trace", "run.jsonl"]].concat(), 0);
    let replay = ["replay", "run.jsonl", "--moves"];
    let cases: [&[&str]; 3] =
        [&["1..300"], &["1..999999", "--format", "json"], &["1..1500", "--html", "run.html"]];
    for case in cases {
        let (peak, code) = peak_kib(folder, &[&replay, case].concat());
        assert_eq!(code, Some(0), "{case:?}");
        assert!(peak < 30_000, "{case:?}: {peak} KiB");
    }
    assert!(fs::metadata(folder.join("run.html")).expect("a page").len() < 1_000_000);
}

#[test]
fn where_a_page_or_a_picture_is_asked_for_nothing_is_drawn_on_stdout() {
    let folder = &folder();
    printed(folder, &["explore", "open:3x3", "--robots", "2", "--trace", "run.jsonl"], 0);
    let summary = "chain (repaired), 2 robots, base 1,1: run.jsonl
8 team moves: every cell of the area is explored
9 of 9 cells explored (100 %), 50 % at team move 4, 75 % at team move 6, 100 % at team move 8
no clause is broken
";
    for files in [&["--html", "run.html"][..], &["--svg", "run.svg"]] {
        assert_eq!(printed(folder, &[&["replay", "run.jsonl"], files].concat(), 0), summary);
    }
    let drawn = printed(folder, &["replay", "run.jsonl"], 0);
    assert!(drawn.starts_with(summary) && drawn.len() > summary.len());
}

#[test]
fn a_hunt_that_was_ended_tells_so_also_if_it_has_found_something() {
    let folder = &folder();
    let hunt = ["hunt", "--rule", "published", "--robots", "4", "--max-walls", "4", "--budget", "200000"];
    let found = json(folder, &hunt, 3);
    assert_eq!((&found["verdict"], &found["complete"]), (&"refuted".into(), &false.into()));
    assert_eq!(found["counterexamples"].as_array().map(Vec::is_empty), Some(false));
    // What was found lies beyond what was covered, and is not called the smallest.
    for (hunt, covered) in [
        ("--robots 3 --max-walls 2 --budget 2000", "all layouts with at most 1 wall were"),
        ("--robots 3 --max-walls 2 --budget 2000 --format github", "all layouts with at most 1 wall were"),
        ("--max-cells 10 --max-walls 4 --budget 200000", "all layouts of at most 9 cells were"),
        ("--scheme kit --size 4x1 --budget 30", "all layouts of at most 2 nodes were"),
    ] {
        let words: Vec<&str> = ["hunt", "--rule", "published"].into_iter().chain(hunt.split(' ')).collect();
        let said = printed(folder, &words, 3);
        says(&said, &[&format!("Found before the hunt was ended, when {covered} covered;")]);
        assert!(!said.contains("The smallest"), "{said}");
    }
}

#[cfg(unix)]
#[test]
fn a_stored_run_in_a_pipe_is_refused_and_a_drawing_in_one_is_read() {
    let folder = &folder();
    make_pipe(folder);
    for command in ["replay", "minimise"] {
        says(&refused(folder, &[command, "pipe"]), &["pipe: this is a pipe or a device"]);
    }
    refused(folder, &["minimise", "pipe", "--out", "new"]);
    assert!(!folder.join("new").exists(), "no folder is left of what was refused");
    let mut explore = tautline(folder, &["explore", "/dev/stdin", "--robots", "3"]);
    let mut child = explore.stdin(Stdio::piped()).stdout(Stdio::null()).spawn().expect("the program runs");
    let drawing = printed(folder, &["show", "open:5x5"], 0);
    child.stdin.take().expect("a pipe").write_all(drawing.as_bytes()).expect("a reader");
    assert_eq!(child.wait().expect("it ends").code(), Some(0));
}

#[cfg(unix)]
#[test]
fn what_is_no_file_of_a_kept_hunt_is_not_read_to_its_end() {
    let folder = &folder();
    make_pipe(folder);
    let large = fs::File::create(folder.join("large")).expect("a file");
    large.set_len((128 << 20) + 1).expect("room for nothing");
    let said = ["/dev/zero", "pipe", "large"].map(|name| {
        let hunt = ["hunt", "--robots", "3", "--max-walls", "1", "--resume", name];
        format!("$ tautline {}\n{}\n", hunt.join(" "), refused(folder, &hunt))
    });
    assert_snapshot!(said.join("\n"), @r"
    $ tautline hunt --robots 3 --max-walls 1 --resume /dev/zero
    Error: /dev/zero: this is a device or a pipe
     Help: name a file

    $ tautline hunt --robots 3 --max-walls 1 --resume pipe
    Error: pipe: this is a device or a pipe
     Help: name a file

    $ tautline hunt --robots 3 --max-walls 1 --resume large
    Error: large: a kept hunt has at most 134217728 bytes, and this file more
     Help: name another file, or remove it and hunt from the start
    ");
}

#[cfg(unix)]
pub(crate) fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).output();
    sent.expect("kill runs");
}

/// A hunt that takes long, kept in `kept.json`, as soon as it is kept there.
#[cfg(unix)]
fn hunting(mut command: Command, folder: &Path) -> Child {
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program runs");
    while !folder.join("kept.json").exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

#[cfg(unix)]
const LONG_HUNT: [&str; 7] = ["hunt", "--robots", "6", "--max-walls", "6", "--resume", "kept.json"];

#[cfg(unix)]
#[test]
fn two_hunts_are_not_kept_in_one_file() {
    let folder = &folder();
    let first = hunting(tautline(folder, &LONG_HUNT), folder);
    for _ in 0..3 {
        let said = refused(folder, &[&LONG_HUNT[..], &["--out", "new/found"]].concat());
        assert!(said.contains("kept.json: another process is at work with it"), "{said}");
        assert!(!folder.join("new").exists(), "no folder is left of what was refused");
    }
    send("-KILL", &first);
    first.wait_with_output().expect("it ends");
    let second = hunting(tautline(folder, &LONG_HUNT), folder);
    std::thread::sleep(Duration::from_millis(300));
    send("-TERM", &second);
    assert_eq!(second.wait_with_output().expect("it ends").status.code(), Some(3));
    assert_eq!(names(folder), ["kept.json"]);
    json(folder, &[&LONG_HUNT[..], &["--budget", "1"]].concat(), 3);
}

#[cfg(unix)]
#[test]
fn each_signal_that_asks_for_an_end_gets_what_is_known_and_keeps_the_hunt() {
    let folder = &folder();
    // What was started to ignore SIGHUP, as by nohup, goes on.
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:")?.trim().chars().last());
    let hears_hangups = ignored.and_then(|digit| digit.to_digit(16)).is_none_or(|digit| digit % 2 == 0);
    let signals = ["-INT", "-TERM", "-HUP"];
    for signal in &signals[..if hears_hangups { 3 } else { 2 }] {
        let child = hunting(tautline(folder, &[&LONG_HUNT[..], &["--format", "json"]].concat()), folder);
        std::thread::sleep(Duration::from_millis(300));
        send(signal, &child);
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(3), "{signal}");
        let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!((&told["complete"], &told["kept"]), (&false.into(), &"kept.json".into()));
        assert_eq!(names(folder), ["kept.json"], "{signal}");
        fs::remove_file(folder.join("kept.json")).expect("a file");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_hunt_that_was_started_to_outlive_its_terminal_does() {
    let folder = &folder();
    let mut shell = Command::new("sh");
    let script = format!("trap '' HUP; exec {} {}", env!("CARGO_BIN_EXE_tautline"), LONG_HUNT.join(" "));
    shell.current_dir(folder).args(["-c", &script]);
    let mut child = hunting(shell, folder);
    send("-HUP", &child);
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(child.try_wait().expect("a child"), None);
    send("-TERM", &child);
    assert_eq!(child.wait().expect("it ends").code(), Some(3));
}

/// Whether a file that a command stores is there to its end.
#[cfg(unix)]
fn is_whole(folder: &Path, name: &str) -> bool {
    let text = read(folder, name);
    let last = text.lines().last().unwrap_or_default();
    let end = match name.rsplit('.').next() {
        Some("svg") => last.ends_with("</svg>"),
        Some("html") => last == "</html>",
        Some("jsonl") => last.starts_with("{\"end\":"),
        Some("json") => last.starts_with("{\"crc32\":"),
        _ => false,
    };
    end && text.ends_with('\n')
}

#[cfg(unix)]
#[test]
fn commands_that_are_ended_at_any_moment_leave_nothing_half_written() {
    use std::os::unix::process::ExitStatusExt;
    let inputs = &folder();
    let explore = ["explore", "cells:96x96:0.1", "--scheme", "bricks", "--robots", "20"];
    printed(inputs, &[&explore[..], &["--trace", "floor.jsonl"]].concat(), 0);
    let chain = ["explore", "walls:127x127:0.05", "--seed", "3", "--robots", "64", "--rule", "published"];
    printed(inputs, &[&chain[..], &["--max-moves", "400", "--trace", "chain.jsonl"]].concat(), 1);
    let input = |name: &str| inputs.join(name).to_str().expect("a plain name").to_owned();
    let (floor, chain) = (input("floor.jsonl"), input("chain.jsonl"));
    let explore = ["explore", "cells:256x256:0.1", "--scheme", "bricks", "--robots", "20"];
    let files = ["--trace", "a.jsonl", "--html", "a.html", "--svg", "a.svg"];
    let rescue = ["rescue", "--nodes", "100000", "--area", "3600x3600", "--seeds", "0", "--wfr", "3"];
    let fig7 = ["reproduce", "rescue-fig7", "--runs", "5000", "--svg", "a.svg"];
    let fig5 = ["reproduce", "notice-fig5", "--runs", "5000", "--svg-reach", "a.svg"];
    let commands: [&[&str]; 9] = [
        &[&explore[..], &files].concat(),
        &[&rescue[..], &files].concat(),
        &["hunt", "--rule", "published", "--robots", "5", "--max-walls", "6", "--resume", "a.json"],
        &["hunt", "--scheme", "bricks-ants", "--max-misses", "9"],
        &["minimise", &chain],
        &["replay", &floor, "--html", "a.html", "--svg", "a.svg"],
        &fig7,
        &[&fig5[..], &["--svg-rebroadcasts", "b.svg"]].concat(),
        &["show", "cells:724x724:0.4", "--svg", "a.svg"],
    ];
    for command in commands {
        let mut ended = 0;
        for millis in [2, 20, 70, 160, 310, 400] {
            let folder = &folder();
            let mut child = tautline(folder, command);
            let child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the program runs");
            std::thread::sleep(Duration::from_millis(millis));
            send("-TERM", &child);
            // A second one at once behind it is the same.
            if millis % 20 == 0 {
                send("-TERM", &child);
            }
            let status = child.wait_with_output().expect("it ends").status;
            match (status.code(), status.signal()) {
                (Some(3), _) => ended += 1,
                // It was done before.
                (Some(0 | 1), _) => {}
                // It had not yet begun.
                (None, Some(15)) => assert_eq!(names(folder), [""; 0], "{command:?} after {millis} ms"),
                other => panic!("{command:?} after {millis} ms: {other:?}"),
            }
            for name in names(folder) {
                assert!(is_whole(folder, &name), "{command:?} after {millis} ms: {name}");
            }
            let asked = command.iter().filter(|word| word.starts_with("a.") || **word == "b.svg").count();
            let stored = names(folder).iter().filter(|name| *name != "a.json").count();
            let is_together =
                [0, asked].contains(&stored) || command[0] == "hunt" || command[0] == "minimise";
            assert!(is_together, "{command:?} after {millis} ms: {:?}", names(folder));
        }
        // To show a layout takes no longer than to begin.
        assert!(ended >= 2 || command[0] == "show", "{command:?}: ended {ended} times");
    }
}
