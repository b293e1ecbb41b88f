//! All verdicts with all that refutes something, made once for whoever looks at
//! them: `prove` takes longer than most tests.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;
use std::sync::OnceLock;

use crate::folder::folder;

/// The text and the files of `tautline prove --verbose --out refuted`.
pub(crate) struct ProveOutput {
    /// The text that it prints.
    pub(crate) told: String,
    /// The files in `refuted`, by their names.
    pub(crate) stored: BTreeMap<String, String>,
}

/// All verdicts, which are the registered ones.
pub(crate) fn proved() -> &'static ProveOutput {
    static PROVED: OnceLock<ProveOutput> = OnceLock::new();
    PROVED.get_or_init(|| {
        let folder = &folder();
        let mut prove = Command::new(env!("CARGO_BIN_EXE_tautline"));
        prove.current_dir(folder).args(["prove", "--verbose", "--out", "refuted"]).env("NO_COLOR", "1");
        let output = prove.output().expect("the program runs");
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let files = fs::read_dir(folder.join("refuted")).expect("a folder");
        let stored = files.map(|file| {
            let file = file.expect("a file");
            let name = file.file_name().into_string().expect("a plain name");
            (name, fs::read_to_string(file.path()).expect("text"))
        });
        ProveOutput { told: String::from_utf8(output.stdout).expect("text"), stored: stored.collect() }
    })
}
