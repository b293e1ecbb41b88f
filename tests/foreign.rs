//! `tautline replay` of a run whose scheme this program does not know: it is said what it is, and it plays as it was
//! written.

use std::path::Path;

use insta::assert_snapshot;

use crate::cli::ran;
use crate::folder::{Folder, folder, read, write};

/// Two robots in a row of three cells; the first meets the wall, the second comes into its cell.
const RUN: &str = r#"{"format":"tautline run","version":1,"scheme":"pair","rule":"eager","robots":2,"seed":0,"base":[0,0],"limits":{"until":null,"max_moves":null,"violation":"stop"},"clause":"PAIR-1","demand":"the second stays apart","layout":"tautline layout 1\n+--+--+--+\n|B    |  |\n+--+--+--+\n"}
{"move":{"step":1,"kind":"advance","tried":"E.","blocked":[],"cells":[[1,0],[0,0]]}}
{"move":{"step":2,"kind":"advance","tried":"EE","blocked":[1],"cells":[[1,0],[1,0]]}}
{"end":{"stopped":"violation","steps":2,"explored":2,"cells":3,"violations":[{"clause":"PAIR-1","step":2}]}}
"#;

/// The text on stdout, and that on stderr, of a command that ends with exit code `code`.
pub(crate) fn ended(folder: &Path, arguments: &[&str], code: i32) -> (String, String) {
    let output = ran(folder, arguments);
    let text = |bytes| String::from_utf8(bytes).expect("text");
    let (told, said) = (text(output.stdout), text(output.stderr));
    assert_eq!(output.status.code(), Some(code), "{told}{said}");
    (told, said)
}

fn with_run(run: &str) -> Folder {
    let folder = folder();
    write(&folder, "run.jsonl", run);
    folder
}

#[test]
fn a_run_of_an_unknown_scheme_plays_as_it_was_written() {
    let folder = &with_run(RUN);
    let (told, said) = ended(folder, &["replay", "run.jsonl"], 1);
    assert_eq!(said, "");
    assert_snapshot!(told, @r"
    pair (eager), 2 robots, start 0,0: run.jsonl
    2 team moves: a clause was broken
    2 of 3 cells explored (66 %), 50 % at team move 1, 75 % never, 100 % never
    PAIR-1 is broken in team move 2; it demands: the second stays apart
    this program does not know the scheme pair: its rule eager was not run, the team moves are those of the file
    the file says that it is a counterexample to PAIR-1

    0, 1, … are the robots, K× stands for K of them in one cell; · is a cell where a robot was, ## blocked; x stands where a robot met a wall.

    move 1                 move 2 breaks PAIR-1
    +---+---+---+          +---+---+---+
    | 1   0 |   |          | ·  01 x   |
    +---+---+---+          +---+---+---+

    Team move 2 breaks PAIR-1; it demands: the second stays apart

      Robot 0 at 1,0 tries to go east, meets a wall and stays.
      Robot 1 at 0,0 goes east to 1,0.

    before, with what each tries   after
    +---+---+---+                  +---+---+---+
    |1→  0→ x   |                  | ·  01 x   |
    +---+---+---+                  +---+---+---+
    ");
}

#[test]
fn a_run_of_an_unknown_scheme_that_names_no_clause_is_as_expected() {
    let kept = RUN
        .replacen("\"clause\":\"PAIR-1\"", "\"clause\":null", 1)
        .replacen("[{\"clause\":\"PAIR-1\",\"step\":2}]", "[]", 1)
        .replacen("\"stopped\":\"violation\"", "\"stopped\":\"exhausted\"", 1);
    let folder = &with_run(&kept);
    let (told, _) = ended(folder, &["replay", "run.jsonl", "--moves", "1..1"], 0);
    assert_snapshot!(told, @r"
    pair (eager), 2 robots, start 0,0: run.jsonl
    2 team moves: the team can explore nothing more
    2 of 3 cells explored (66 %), 50 % at team move 1, 75 % never, 100 % never
    no clause was checked
    this program does not know the scheme pair: its rule eager was not run, the team moves are those of the file

    0, 1, … are the robots, K× stands for K of them in one cell; · is a cell where a robot was, ## blocked; x stands where a robot met a wall.

    move 1
    +---+---+---+
    | 1   0 |   |
    +---+---+---+
    ");
}

#[test]
fn a_run_of_an_unknown_scheme_has_a_page_a_picture_and_json() {
    let folder = &with_run(RUN);
    let (told, _) = ended(folder, &["replay", "run.jsonl", "--html", "run.html", "--svg", "run.svg"], 1);
    assert!(told.contains("the file says that it is a counterexample to PAIR-1"), "{told}");
    let page = read(folder, "run.html");
    // R0 tries to go east and meets a wall, R1 goes east.
    assert!(page.contains("\neE\t{\"broken\":[[\"PAIR-1\",[]]]}\n"), "{page}");
    assert!(read(folder, "run.svg").contains("breaks PAIR-1"));
    let (told, _) = ended(folder, &["replay", "run.jsonl", "--format", "json"], 1);
    assert_snapshot!(told,
        @r#"{"schema_version":1,"scheme":"pair","rule":"eager","robots":2,"seed":0,"layout":"run.jsonl","base":[0,0],"steps":2,"explored":2,"cells":3,"milestones":{"50":1,"75":null,"100":null},"stopped":"violation","violations":[{"clause":"PAIR-1","step":2}],"counterexample_to":"PAIR-1","is_rule_run":false,"demand":"the second stays apart","numbered_from":0,"moves":[{"step":1,"kind":"advance","tried":"E.","blocked":[],"cells":[[1,0],[0,0]]},{"step":2,"kind":"advance","tried":"EE","blocked":[0],"cells":[[1,0],[1,0]]}]}"#);
}

#[test]
fn a_run_of_an_unknown_scheme_that_contradicts_itself_is_refused() {
    let folder = &with_run(&RUN.replacen("\"blocked\":[1]", "\"blocked\":[]", 1));
    let (_, said) = ended(folder, &["replay", "run.jsonl"], 2);
    assert_snapshot!(said, @r#"
    Error: robot 1 at 1,0 cannot cross a wall
       ╭─[ run.jsonl:3:36 ]
       │
     3 │ …ove":{"step":2,"kind":"advance","tried":"EE","blocked":[],"cells":[[1,0…
       │                                  ───┬───  
       │                                     ╰───── here
       │ 
       │ Help: store the run again with the program that wrote it
    ───╯
    "#);
}

#[test]
fn a_program_is_held_to_a_run_of_an_unknown_scheme_whose_robots_are_counted_from_0() {
    let folder = &with_run(RUN);
    let waits = r#"while read line; do echo '{"tried":".."}'; done"#;
    let conform = |options: &[&str], code| {
        ended(folder, &[&["conform", "run.jsonl"], options, &["--", "sh", "-c", waits]].concat(), code)
    };
    let (told, _) = conform(&[], 1);
    assert!(told.contains("robot 0: the model E, the program ."), "{told}");
    assert!(conform(&["--format", "json"], 1).0.contains("\"robot\":0"));
    // Where robots do not act at once, no program can know who does.
    write(folder, "run.jsonl", RUN.replacen("[0,0]]}}", "[0,0]],\"title\":\"robot 0 acts\"}}", 1));
    let (_, said) = conform(&[], 2);
    assert!(said.contains("robot 0 acts in team move 1, and no program is told"), "{said}");
}

#[test]
fn a_run_of_an_unknown_scheme_is_not_minimised() {
    let folder = &with_run(RUN);
    let (_, said) = ended(folder, &["minimise", "run.jsonl"], 2);
    assert_snapshot!("unknown_scheme", said);
}
