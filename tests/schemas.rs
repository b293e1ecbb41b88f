//! Every JSON object that a command prints is as its schema in docs/schemas says. Those of tables are compared where all tables
//! are measured, in `sim/tests/tables.rs`.

mod schema;

use std::path::Path;
use std::process::Command;

use serde_json::Value;

fn printed(folder: &Path, arguments: &str) -> Value {
    let arguments = arguments.split(' ').chain(["--format", "json"]);
    let output = Command::new(env!("CARGO_BIN_EXE_tautline")).current_dir(folder).args(arguments).output();
    let output = output.expect("the program runs");
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(&output.stderr)))
}

#[test]
fn each_schema_is_that_of_what_is_printed() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let stored = |name: &str| format!("replay {}", root.join("docs").join(name).display());
    let replays =
        ["chain-2-published-n4.jsonl", "bricks-4-repaired-n1.jsonl", "kit-1-published.jsonl"].map(stored);
    let schemas: [(&str, &str, Vec<String>); 12] = [
        ("prove", "tautline prove", own(&["prove NOTICE-4 LATTICE-1 CHAIN-2 BRICKS-5 --out refuted"])),
        (
            "hunt",
            "tautline hunt, and tautline merge of a hunt",
            own(&[
                "hunt --rule published --robots 3 --max-walls 2",
                "hunt --robots 3 --max-walls 1 --resume kept.json",
                "hunt --rule published --robots 3 --max-cells 9 --force",
                "hunt --robots 3 --max-walls 2 --budget 1",
                "hunt --scheme bricks --max-misses 1 --size 2x2",
                "hunt --scheme frontier --rule published --robots 2 --size 3x1",
            ]),
        ),
        (
            "plan",
            "tautline hunt or reproduce with --shards",
            own(&[
                "hunt --rule published --robots 3 --max-walls 2 --plan plan.json --shards 2",
                "hunt --scheme ants --size 2x2 --plan layouts.json --shards 2",
                "reproduce repair-cost --layouts 4 --plan table.json --shards 2",
            ]),
        ),
        (
            "shard",
            "tautline hunt or reproduce with --shard",
            own(&[
                "hunt --plan plan.json --shard 1",
                "hunt --plan layouts.json --shard 1",
                "reproduce --plan table.json --shard 1",
            ]),
        ),
        (
            "explore",
            "tautline explore",
            own(&[
                "explore open:3x3 --robots 2 --trace run.jsonl",
                "explore walls:7x7:0.2 --rule published --robots 4 --max-moves 9",
                "explore cells:6x6:0.1 --scheme bricks --robots 3",
                "explore cells:6x6:0.1 --scheme ants --max-moves 50",
                "explore walls:5x5:0.1 --scheme kit --robots 2",
                "explore cells:6x6:0.1 --scheme frontier --robots 2",
                "explore open:7x7 --rule reel --robots 4 --fail 3@5",
                "explore open:3x3 --rule reel --robots 2 --loss 0.1",
            ]),
        ),
        (
            "replay",
            "tautline replay",
            replays.into_iter().chain(own(&["replay run.jsonl --moves 1..2"])).collect(),
        ),
        ("minimise", "tautline minimise", own(&["minimise chain-13-published-n3.jsonl --out ."])),
        (
            "rescue",
            "tautline rescue",
            own(&[
                "rescue --nodes 300 --seeds 0..3",
                "rescue --nodes 300 --wfr 2 --robots 2 --seeds 0..3 --loss 0.1",
            ]),
        ),
        (
            "locate",
            "tautline locate",
            own(&[
                "locate --trials 20",
                "locate --solver closed-form --trials 20 --noise-db 0",
                "locate --advice",
            ]),
        ),
        ("show", "tautline show", own(&["show open:3x3"])),
        ("show-environments", "tautline show environments", own(&["show environments"])),
        ("reproduce", "tautline reproduce", own(&["reproduce"])),
    ];
    for (name, title, commands) in schemas {
        let values: Vec<Value> = commands.iter().map(|command| printed(folder, command)).collect();
        schema::is_up_to_date(name, title, &values);
    }
}

fn own(commands: &[&str]) -> Vec<String> {
    commands.iter().map(ToString::to_string).collect()
}
