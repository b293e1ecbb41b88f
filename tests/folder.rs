//! Folders of tests.

use std::fs;
use std::ops::Deref;
use std::path::Path;

use tempfile::TempDir;

/// A folder that goes with its test.
pub(crate) struct Folder(TempDir);

impl Deref for Folder {
    type Target = Path;

    fn deref(&self) -> &Path {
        self.0.path()
    }
}

impl AsRef<Path> for Folder {
    fn as_ref(&self) -> &Path {
        self
    }
}

/// A new, empty folder.
pub(crate) fn folder() -> Folder {
    Folder(tempfile::tempdir().expect("a folder"))
}

/// The text of a file.
#[track_caller]
pub(crate) fn read(folder: &Path, name: impl AsRef<Path>) -> String {
    fs::read_to_string(folder.join(name)).expect("text")
}

#[track_caller]
pub(crate) fn write(folder: &Path, name: impl AsRef<Path>, content: impl AsRef<[u8]>) {
    fs::write(folder.join(name), content).expect("room for a file");
}
