//! The JSON of each command is as its schema in docs/schemas says. That of tables is looked at where all
//! tables are measured, in `papers/tests/tables.rs`.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::folder::{folder, write};

fn printed(folder: &Path, arguments: &str) -> Value {
    let arguments = arguments.split_whitespace().chain(["--format", "json"]);
    let output = Command::new(env!("CARGO_BIN_EXE_tautline")).current_dir(folder).args(arguments).output();
    let output = output.expect("the program runs");
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(&output.stderr)))
}

/// The name of a schema, and commands, one a line, that print what it is of. Later ones read what earlier ones stored.
const COMMANDS: [(&str, &str); 15] = [
    (
        "schemes",
        "schemes
         schemes kit chain",
    ),
    ("prove", "prove NOTICE-4 LATTICE-1 CHAIN-14 BRICKS-5 KIT-3 --out refuted"),
    (
        "hunt",
        "hunt --rule published --robots 3 --max-walls 2
         hunt --robots 3 --max-walls 1 --resume kept.json
         hunt --rule published --robots 3 --max-cells 9 --max-walls 2 --force
         hunt --robots 3 --max-walls 2 --budget 1
         hunt --robots 3 --max-cells 9 --budget 1
         hunt --scheme bricks --max-misses 1 --size 2x2
         hunt --scheme bricks --rule published --max-misses 1 --size 3x3
         hunt --scheme ants --size 2x2
         hunt --scheme frontier --rule published --robots 2 --size 3x1
         hunt --scheme frontier --robots 2 --size 2x1 --max-losses 1
         hunt --scheme frontier --robots 2 --size 2x2 --max-walls 1 --budget 1
         hunt --scheme kit --rule published --size 5x1
         hunt --scheme kit --robots 2 --size 2x2 --budget 1",
    ),
    (
        "plan",
        "hunt --rule published --robots 3 --max-walls 2 --plan plan.json --shards 2
         hunt --scheme ants --size 2x2 --plan layouts.json --shards 2
         reproduce repair-cost --runs 4 --plan table.json --shards 2
         library rmf-lane --plan rules.json --shards 2",
    ),
    (
        "shard",
        "hunt --plan plan.json --shard 1
         hunt --plan plan.json --shard 2
         hunt --plan layouts.json --shard 1
         reproduce --plan table.json --shard 1
         reproduce --plan table.json --shard 2
         library --plan rules.json --shard 1",
    ),
    ("hunt", "merge plan.json --force"),
    ("reproduce-repair-cost", "merge table.json"),
    (
        "explore",
        "explore open:2x2 --scheme frontier --robots 2 --loss 0.995 --seed 1
         explore open:3x3 --robots 2 --trace run.jsonl --mcap run.mcap
         explore walls:7x7:0.2 --rule published --robots 4 --max-moves 9 --trace broken.jsonl
         explore open:7x7 --rule reel --robots 4 --fail 3@5
         explore open:3x3 --rule reel --robots 2 --loss 0.1
         explore open:5x5 --robots 3 --wall 2,2,E@2
         explore open:5x5 --robots 3 --speeds
         explore open:5x5 --scheme rooker-birk --robots 3
         explore open:5x5 --scheme full-search --robots 3
         explore cells:6x6:0.1 --scheme ants --max-moves 50
         explore cells:6x6:0.1 --scheme bricks --robots 3
         explore cells:6x6:0.1 --scheme bricks-ants --robots 2 --miss 0.1
         explore cells:6x6:0.1 --scheme mdfs --rule published --robots 2
         explore cells:6x6:0.1 --scheme helpers --robots 2
         explore walls:5x5:0.1 --scheme kit --robots 2 --trace kit.jsonl
         explore cells:6x6:0.1 --scheme frontier --robots 2 --loss 0.1 --noise-db 1 --objects 3
         explore cells:6x6:0.1 --scheme pack --robots 2",
    ),
    (
        "judge",
        "judge run.mcap --clauses CHAIN-3,FRONTIER-1 --map open:3x3
         judge run.mcap --clauses KIT-1 --range 0.5
         judge run.mcap --clauses KIT-12 --gap 0.5",
    ),
    (
        "replay",
        "replay run.jsonl --moves 1..2
         replay broken.jsonl
         replay kit.jsonl
         replay chain-13-published-n3.jsonl
         replay refuted/notice-4-published-exhaustive.jsonl
         replay refuted/bricks-5-published-states.jsonl
         replay refuted/kit-3-published-states.jsonl",
    ),
    ("library-hunt", "library rmf-lane --runs 9 --out hunted"),
    (
        "minimise",
        "minimise chain-13-published-n3.jsonl --force
         minimise hunted/lane-1-before-the-pull-request-states.jsonl",
    ),
    (
        "rescue",
        "rescue --nodes 300 --seeds 3 --trace rescue.jsonl
         rescue --nodes 300 --seeds 0..3
         rescue --nodes 300 --wfr 2 --robots 2 --seeds 0..3 --loss 0.1 --failing 1
         replay rescue.jsonl",
    ),
    (
        "locate",
        "locate --runs 20
         locate --solver closed-form --runs 20 --noise-db 0
         locate --advice --runs 300
         locate --runs 20 --at 3,3
         locate measured.csv",
    ),
    ("show", "show open:3x3"),
];

#[test]
fn what_each_command_prints_is_as_its_schema_says() {
    let folder = &folder();
    let measured = "fix,x_m,y_m,range_m\na,0,0,5\na,10,0,8\na,0,10,7\nb,0,0,4\nb,9,0,5\nb,0,9,6\n";
    write(folder, "measured.csv", measured);
    let others = [("show-environments", "show environments"), ("reproduce", "reproduce")];
    for (name, commands) in COMMANDS.into_iter().chain(others) {
        for command in commands.lines() {
            crate::schema::check(name, &printed(folder, command), command);
        }
    }
}

#[test]
fn stored_counterexamples_are_replayed_as_the_schema_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for file in std::fs::read_dir(&folder).expect("a folder") {
        let path = file.expect("a file").path();
        if path.extension().is_some_and(|extension| extension == "jsonl") {
            let name = path.file_name().and_then(|name| name.to_str()).expect("a name");
            crate::schema::check("replay", &printed(&folder, &format!("replay {name}")), name);
        }
    }
}
