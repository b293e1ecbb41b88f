//! Who may import whom: arrows run one way, from the program down to the kernel, and a scheme is a room of its own,
//! which the shared rooms do not know. A room is a top-level module of a crate; the root of a crate may import all of
//! its rooms.

use std::collections::BTreeSet;
use std::fs;
use std::path::{self, PathBuf};

use crate::names::{Names, Path};

/// By crate: the crates of ours that it may use. The program stands in the folder of the workspace.
const BELOW: &str = "
    kernel:
    io:
    grids: io kernel
    logs:
    monitor:
    ros: monitor ros
    certificates: kernel
    proofs: kernel certificates
    library: kernel proofs
    sim: grids io kernel proofs
    field: grids io kernel proofs sim
    papers: grids io kernel proofs sim field
    viewers: grids io kernel proofs sim field
    web: grids io kernel proofs sim
    .: grids io kernel logs proofs library sim field papers viewers";

/// By crate and rooms: the other rooms that may import them; `*` are all. The robust rule of bricks goes where an agent
/// has been least, as ants do.
const KNOWN_TO: &str = "
    kernel choice conditions error floor ground net: *
    kernel ants: bricks
    kernel position: frontier
    kernel bricks chain frontier kit mrc notice pack tan:
    proofs ambiguity clause decide engine floor_trace judge local plural protocol run step_check team: *
    proofs ledger:
    proofs floor: ants bricks
    proofs ground: ledger chain
    proofs ants bricks chain frontier kit mrc notice pack position tan: ledger
    io shards:
    sim shards:
    field draw:
    papers tables: shards
    papers shards:
    viewers itf rescue:
    viewers mcap: rescue";

/// By crate and rooms: the only rooms that they may import.
const KNOWS: &str = "
    proofs engine: plural
    proofs ambiguity judge plural:
    io diagnostic named_values schema text_blocks text_table value_parser:
    io atomic_file json_lines: diagnostic
    io svg: atomic_file
    io checkpoint: atomic_file diagnostic json_lines
    field radio: radio
    field tan: radio
    field stats: stats";

/// Crates whose rooms all have a line that says who may import them.
const ALL_LISTED: [&str; 3] = ["kernel", "proofs", "viewers"];

/// Folders whose files have at most [`MOST_LINES`] of at most [`MOST_CHARACTERS`], documentation that reads alone,
/// and nouns as the names of types.
const FOLDERS: [&str; 20] = [
    "kernel/src",
    "io/src",
    "grids/src",
    "certificates/src",
    "logs/src",
    "monitor/src",
    "ros/src",
    "ros/tests",
    "capi/src",
    "proofs/src",
    "library/src",
    "sim/src",
    "field/src",
    "papers/src",
    "viewers/src",
    "web/src",
    "src",
    "examples",
    "benches",
    "fuzz/src",
];
const MOST_LINES: usize = 550;
const MOST_CHARACTERS: usize = 120;

/// The right side of a table's line that begins with `part` and names `room`, if there is one.
fn line(table: &'static str, part: &str, room: &str) -> Option<Vec<&'static str>> {
    let sides = table.lines().filter_map(|line| line.trim().split_once(':'));
    let mut named = sides.filter(|(left, _)| {
        let mut words = left.split(' ');
        words.next() == Some(part) && (room.is_empty() || words.any(|word| word == room))
    });
    named.next().map(|(_, right)| right.split_whitespace().collect())
}

/// The room that a file belongs to.
fn room(file: &str) -> &str {
    file.split(['/', '.']).next().unwrap_or(file)
}

/// The rooms that a file names by a path from the root of its crate, and the crates of ours that it names, also in its
/// tests.
fn imports(file: &str, text: &str) -> BTreeSet<String> {
    let depth = file.split('/').count();
    let Names { imports, paths, .. } = Names::of(text, true);
    let paths = imports.into_iter().map(|import| import.path).chain(paths);
    let named = |path: Path| {
        let supers = path.iter().take_while(|&segment| segment == "super").count();
        let place = match path[0].as_str() {
            first if first.starts_with("tautline_") => 0,
            "crate" => 1,
            _ if supers == depth => depth,
            _ => return None,
        };
        path.into_iter().nth(place)
    };
    paths.filter_map(named).collect()
}

/// The forbidden imports of a file of the crate `part`.
fn forbidden(part: &str, file: &str, text: &str) -> Vec<String> {
    let is_allowed = |name: &str| match name.strip_prefix("tautline_") {
        Some(used) => line(BELOW, part, "").is_some_and(|below| below.contains(&used)),
        None if name == room(file) || matches!(file, "lib.rs" | "main.rs") => true,
        None => {
            let importers = line(KNOWN_TO, part, name);
            name != "*"
                && importers.is_none_or(|rooms| rooms == ["*"] || rooms.contains(&room(file)))
                && line(KNOWS, part, room(file)).is_none_or(|known| known.contains(&name))
        }
    };
    let arrows = imports(file, text).into_iter().filter(|name| !is_allowed(name));
    arrows.map(|name| format!("{part}/src/{file} imports {name}")).collect()
}

/// The crates of ours that a manifest depends on, but for tests.
fn dependencies(manifest: &str) -> impl Iterator<Item = &str> {
    let sections = manifest.split("\n[").filter(|section| section.starts_with("dependencies]"));
    sections.flat_map(str::lines).filter_map(|line| line.strip_prefix("tautline-")?.split([' ', '.']).next())
}

fn path(folder: &str) -> PathBuf {
    path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

/// The Rust files under a folder, by their path within it, and what they say.
pub(crate) fn sources(folder: &str) -> Vec<(String, String)> {
    let (mut files, mut left) = (Vec::new(), vec![path(folder)]);
    while let Some(next) = left.pop() {
        if next.is_dir() {
            left.extend(fs::read_dir(&next).expect("a folder").map(|entry| entry.expect("an entry").path()));
        } else if next.extension().is_some_and(|extension| extension == "rs") {
            let names = next.strip_prefix(path(folder)).expect("a file within").iter();
            let names: Vec<&str> = names.map(|name| name.to_str().expect("Unicode")).collect();
            files.push((names.join("/"), fs::read_to_string(&next).expect("a source")));
        }
    }
    files
}

/// The fault of a line: it is long, is documentation that does not read alone, or names a type by a participle.
fn fault(line: &str) -> Option<&'static str> {
    let line = line.trim_end();
    let doc = line.trim_start().strip_prefix("//").and_then(|doc| doc.strip_prefix(['/', '!']));
    let mut words =
        line.split(['(', ' ', '<', ';', ':']).skip_while(|word| !["struct", "enum", "trait"].contains(word));
    let name = words.nth(1).filter(|_| doc.is_none()).unwrap_or_default();
    let is_one_word = name.chars().filter(|sign| sign.is_uppercase()).count() == 1;
    if line.chars().count() > MOST_CHARACTERS {
        Some("this line is too long")
    } else if doc.is_some_and(|doc| [" What ", " The same "].iter().any(|&first| doc.starts_with(first))) {
        Some("documentation begins with a noun, or with a verb in the third person")
    } else if is_one_word && name.ends_with("ed") && !name.ends_with("eed") {
        Some("a type is a noun")
    } else {
        None
    }
}

#[test]
fn arrows_run_one_way_and_files_and_lines_are_short() {
    for part in BELOW.lines().filter_map(|line| line.trim().split_once(':')).map(|(part, _)| part) {
        let files = sources(&format!("{part}/src"));
        let found: Vec<_> = files.iter().flat_map(|(file, text)| forbidden(part, file, text)).collect();
        assert!(found.is_empty(), "{found:#?}");
        let manifest = fs::read_to_string(path(part).join("Cargo.toml")).expect("a manifest");
        let below = line(BELOW, part, "").expect("a line");
        assert!(dependencies(&manifest).all(|used| below.contains(&used)), "{part}/Cargo.toml");
        for room in files.iter().map(|(file, _)| room(file)).filter(|&room| room != "lib") {
            let is_listed = line(KNOWN_TO, part, room).is_some() || !ALL_LISTED.contains(&part);
            assert!(is_listed, "no line says who may import the room {room} of {part}");
        }
    }
    let mut faults = Vec::new();
    for folder in FOLDERS.into_iter().filter(|folder| path(folder).exists()) {
        for (file, text) in sources(folder) {
            let (file, lines) = (format!("{folder}/{file}"), text.lines().count());
            assert!(lines <= MOST_LINES, "{file} has {lines} lines");
            let lines = (1_u32..).zip(text.lines());
            faults.extend(lines.filter_map(|(line, text)| Some(format!("{file}:{line}: {}", fault(text)?))));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn a_long_line_a_comment_that_needs_another_and_a_participle_are_found() {
    let long = "é".repeat(MOST_CHARACTERS);
    for line in [
        "/// The cells.",
        "// What comes is taken.",
        "    pub(crate) enum Speed {",
        "/// a struct Played",
        &long,
    ] {
        assert_eq!(fault(line), None, "{line}");
    }
    for line in [
        "    /// What is taken.",
        "//! The same cells.",
        "pub struct Played<G>(G);",
        "trait Erased: Sync {",
        &format!("{long}é"),
    ] {
        assert!(fault(line).is_some(), "{line}");
    }
}

/// The two checkers of certificates know no crate of ours but the kernel, and not each other; what they ask of a system
/// is answered by one file, which plans and settles, and knows no search.
#[test]
fn each_checker_of_certificates_is_short_and_its_step_function_knows_no_search() {
    let is_code = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with("//");
    let sources = sources("certificates/src");
    for other in ["runs.rs", "states.rs"] {
        let of_one = sources.iter().filter(|(file, _)| file != other);
        let lines: usize = of_one.map(|(_, text)| text.lines().filter(is_code).count()).sum();
        assert!(lines <= 600, "without {other}: {lines} lines");
        let text = fs::read_to_string(path("certificates/src").join(other)).expect("a source");
        assert!(!text.contains("crate::runs") && !text.contains("crate::states"), "{other} stands alone");
    }
    let model = fs::read_to_string(path("proofs/src/engine/model.rs")).expect("a source");
    let used: Vec<&str> =
        model.lines().filter(|line| line.contains("super::") || line.contains("crate::")).collect();
    assert_eq!(used, ["use super::states::System;", "use super::tree::Game;", "use super::world::Turn;"]);
    for part in ["each_step", "steps(", "search("] {
        assert!(!model.contains(part), "{part} is the search's");
    }
}

#[test]
fn a_forbidden_arrow_is_found_however_it_is_written() {
    let found = |file, text| imports(file, text).into_iter().collect::<Vec<_>>();
    assert_eq!(found("run.rs", "use crate::chain::Rule;"), ["chain"]);
    assert_eq!(
        found("run.rs", "fn all() {\n    one(crate::chain::plan(), crate::run::all());\n}"),
        ["chain", "run"]
    );
    assert_eq!(
        found("run.rs", "use crate::{\n    chain::{Rule, plan},\n    plural,\n};\nuse std::fs;"),
        ["chain", "plural"]
    );
    assert_eq!(
        found("run.rs", "use super::{chain, plural::{self, one}};\nuse crate::*;"),
        ["*", "chain", "plural"]
    );
    let inner = "use super::super::tan;\nmod tests {\n    use super::super::log;\n}\nuse super::super::mrc;";
    assert_eq!(found("run/log.rs", inner), ["mrc", "tan"]);
    assert!(found("run.rs", "//! [`crate::chain`]\npub(crate) fn one() {} // crate::chain").is_empty());
    for (part, file, text) in [
        ("kernel", "mrc/robot.rs", "use crate::notice::Node;"),
        ("kernel", "floor.rs", "use crate::{choice, ants};"),
        ("kernel", "choice.rs", "use tautline_proofs::engine;"),
        ("certificates", "check.rs", "use tautline_proofs::engine::states::search;"),
        ("proofs", "engine/tree.rs", "use crate::run::Run;"),
        ("proofs", "decide.rs", "use crate::{run, chain};"),
        ("proofs", "mrc/space.rs", "use super::super::ledger;"),
        ("proofs", "judge/chain.rs", "use crate::plural::counted;"),
        ("sim", "draw/svg.rs", "use tautline_papers::tables::optimum;"),
        ("field", "tan/tree.rs", "use crate::rescue::Report;"),
        ("io", "diagnostic.rs", "use crate::atomic_file::AtomicFile;"),
    ] {
        assert_eq!(forbidden(part, file, text).len(), 1, "{part}/src/{file}: {text}");
    }
    for (part, file, text) in [
        ("kernel", "mrc/robot.rs", "use crate::net::Notice;"),
        ("proofs", "engine/tree.rs", "use super::states;\nuse crate::plural::counted;"),
        ("proofs", "ledger.rs", "use crate::{ants, chain, mrc};"),
        ("papers", "tables/optimum.rs", "use tautline_field::stats::mean;\nuse tautline_proofs::chain;"),
        ("papers", "lib.rs", "pub use crate::tables::all;"),
    ] {
        assert_eq!(forbidden(part, file, text), [""; 0]);
    }
    let manifest = "[package]\n[dependencies]\ntautline-kernel.workspace = true\n\
                    tautline-sim = { path = \"sim\" }\n[dev-dependencies]\ntautline-proofs = \"1\"";
    assert!(dependencies(manifest).eq(["kernel", "sim"]));
}
