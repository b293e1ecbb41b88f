//! The folder of a command's counterexamples, and how one of them is named.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use tautline_io::atomic_file::{AtomicFile, check_name};
use tautline_io::diagnostic::{Diagnostic, unmade};
use tautline_sim::explore::Setup;

use super::output::{Output, argument, replay_line};

/// The remedy where no folder can be made.
const REMEDY: &str = "name a folder, or a place where one can be made";

/// Makes the folder that --out names, if it is not there. The folders that are new, the inmost first.
pub(super) fn make_folder(out: &Path) -> Result<Vec<PathBuf>, Diagnostic> {
    check_name(out)?;
    let is_new = |folder: &&Path| !folder.exists();
    let new: Vec<PathBuf> = out.ancestors().take_while(is_new).map(Path::to_owned).collect();
    if let Err(error) = fs::create_dir_all(out) {
        clear(&new);
        let (what, remedy) = match error.kind() {
            ErrorKind::AlreadyExists | ErrorKind::NotADirectory => {
                ("a file is where the folder is to be".to_owned(), REMEDY)
            }
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                (format!("the folder cannot be made: {}", unmade(&error)), "make room, or name another place")
            }
            _ => (format!("the folder cannot be made: {}", unmade(&error)), REMEDY),
        };
        return Err(Diagnostic::in_file(out, what, remedy));
    }
    Ok(new)
}

/// Removes those of these folders that are empty.
pub(super) fn clear(folders: &[PathBuf]) {
    for folder in folders {
        // What is not empty stays.
        let _ = fs::remove_dir(folder);
    }
}

/// The result of `work`, for which the folder that --out names is made. Of work that
/// fails no folder is left that is new and empty.
pub(super) fn in_folder<T, E: From<Diagnostic>>(
    out: &Path,
    work: impl FnOnce() -> Result<T, E>,
) -> Result<T, E> {
    let new = make_folder(out)?;
    work().inspect_err(|_| clear(&new))
}

/// Puts the file of a counterexample in its place; where it stands then.
pub(super) fn keep(file: AtomicFile, out: &mut Output) -> Option<String> {
    let path = file.path().to_owned();
    out.keep(file).then(|| shown(&path))
}

/// The path as one would type it.
pub(super) fn shown(path: &Path) -> String {
    path.strip_prefix(".").unwrap_or(path).display().to_string()
}

/// How to see the run of a file again, and, where no search has chosen anything in it, to hold a rule to it.
pub(super) fn again(file: &str, setup: &Setup) -> String {
    let again = replay_line(file);
    if !setup.choices.is_empty() || !setup.missed.is_empty() {
        return again;
    }
    again + "try a rule on it: tautline explore " + &argument(file) + " --rule RULE\n"
}
