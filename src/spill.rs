//! The folder of `--spill`, in which searches go on for which memory does not suffice.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use tautline_io::atomic_file::lock;
use tautline_io::diagnostic::Diagnostic;
use tautline_proofs::engine::states::{HEAD, PART, Spill, SpillError, WHOLE};

/// The folder at `path`, which is empty or has nothing but states of searches that were killed. It is locked against
/// other processes until what is returned with it is closed.
///
/// # Errors
/// A [`Diagnostic`] if it is none, if it has something else, or if another process is at work there.
pub(super) fn open(path: &Path) -> Result<(Spill, Option<File>), Diagnostic> {
    let unreadable = |error: io::Error| {
        Diagnostic::in_file(path, format_args!("the folder cannot be read: {error}"), "name another one")
    };
    if !path.exists() {
        let remedy = "make it, on a disk with room for the states";
        return Err(Diagnostic::in_file(path, "there is no such folder", remedy));
    }
    if !path.is_dir() {
        return Err(Diagnostic::in_file(path, "this is no folder", "name a folder that is empty"));
    }
    // Not every system opens a folder as a file.
    let held = File::open(path).ok();
    if let Some(held) = &held {
        lock(path, held)?;
    }
    let mut parts = Vec::new();
    for entry in fs::read_dir(path).map_err(unreadable)? {
        let file = entry.map_err(unreadable)?.path();
        if !is_ours(&file) {
            let what = format_args!("{} in it is no file with states of a search", file.display());
            return Err(Diagnostic::in_file(path, what, "name a folder that is empty"));
        }
        parts.extend(Some(file).filter(|file| ends_with(file, PART)));
    }
    // Of a search that was killed, and can do without them.
    for part in parts {
        fs::remove_file(part).map_err(unreadable)?;
    }
    Ok((Spill::new(path.to_owned()), held))
}

/// Why a search could not go on in its folder.
pub(super) fn diagnostic(error: &SpillError) -> Diagnostic {
    Diagnostic::in_file(&error.path, &error.fault, error.fault.remedy())
}

fn ends_with(file: &Path, end: &str) -> bool {
    file.extension().is_some_and(|extension| extension == end)
}

/// Whether a file begins as those with states do; one that was not written to its end may have less.
fn is_ours(file: &Path) -> bool {
    let mut bytes = Vec::new();
    let read = File::open(file).and_then(|file| file.take(HEAD.len() as u64).read_to_end(&mut bytes));
    let is_begun = ends_with(file, PART) && HEAD.as_bytes().starts_with(&bytes);
    read.is_ok() && (is_begun || ends_with(file, WHOLE) && bytes == HEAD.as_bytes())
}
