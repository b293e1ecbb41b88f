//! Folders of tests.

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
