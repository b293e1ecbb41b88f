//! Every input that fuzzing has kept, the corpus and the regressions, passes its target's body.

use std::fs;
use std::path::{Path, PathBuf};

#[path = "../fuzz/src/lib.rs"]
pub mod targets;

use targets::TARGETS;

/// The entries of a folder of the fuzz crate, by name.
fn entries(folder: impl AsRef<Path>) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(folder);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_kept_input_passes() {
    for kept in ["corpus", "regressions"] {
        for folder in entries(kept).iter().filter(|path| path.is_dir()) {
            let name = folder.file_name().expect("a name");
            let found = TARGETS.iter().find(|&&(target, _)| target == name);
            let &(_, body) = found.unwrap_or_else(|| panic!("{kept}: {} is no target", name.display()));
            for input in entries(folder) {
                // The name of the input that fails is the last one that is told.
                println!("{}", input.display());
                body(&fs::read(&input).expect("an input"));
            }
        }
    }
}

#[test]
fn every_target_has_a_corpus() {
    let built: Vec<PathBuf> = entries("fuzz_targets").iter().map(|path| path.with_extension("")).collect();
    assert!(built.iter().map(|path| path.file_name().expect("a name")).eq(TARGETS.map(|(name, _)| name)));
    for (name, _) in TARGETS {
        assert!(!entries(Path::new("corpus").join(name)).is_empty(), "{name}");
    }
}

#[test]
fn every_target_is_fuzzed_at_night() {
    let workflow = Path::new(env!("CARGO_MANIFEST_DIR")).join(".github/workflows/fuzz.yml");
    let workflow = fs::read_to_string(workflow).expect("a workflow");
    let items = workflow.lines().filter_map(|line| line.strip_prefix("          - "));
    assert!(items.eq(TARGETS.map(|(name, _)| name)));
}
