//! Files that are there whole or not at all: written beside their place under another name, then renamed.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::fault::Fault;

/// A file in the making. Dropped before [`Aside::keep`], it leaves nothing behind.
#[derive(Debug)]
pub struct Aside {
    path: PathBuf,
    file: BufWriter<NamedTempFile>,
}

impl Aside {
    /// A file that is to stand at `path`; one that stands there now is replaced in the end.
    ///
    /// # Errors
    /// A [`Fault`] if nothing can be written in its folder, or `path` is itself a folder.
    pub fn new(path: &Path) -> Result<Self, Fault> {
        if path.is_dir() {
            return Err(Fault::in_file(path, "this is a folder", "name a file in it"));
        }
        let folder = match path.parent() {
            Some(parent) if parent != Path::new("") => parent,
            Some(_) | None => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".tautline-").suffix(".part");
        open_to_others(&mut builder);
        let file = builder.tempfile_in(folder).map_err(|error| unwritable(path, &error))?;
        Ok(Self { path: path.to_owned(), file: BufWriter::new(file) })
    }

    /// Puts `content` at `path`.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be written.
    pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Fault> {
        let mut aside = Self::new(path)?;
        aside.append(content)?;
        aside.keep()
    }

    /// Adds `content` at the end.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be written.
    pub fn append(&mut self, content: impl AsRef<[u8]>) -> Result<(), Fault> {
        self.file.write_all(content.as_ref()).map_err(|error| unwritable(&self.path, &error))
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// A [`Fault`] if that is not possible; then nothing is left.
    pub fn keep(self) -> Result<(), Fault> {
        let Self { path, file } = self;
        let file = file.into_inner().map_err(|error| unwritable(&path, error.error()))?;
        file.persist(&path).map_err(|refused| unwritable(&path, &refused.error))?;
        Ok(())
    }
}

/// Temporary files are private by default; results are files like others.
#[cfg(unix)]
fn open_to_others(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(std::fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn open_to_others(_: &mut tempfile::Builder<'_, '_>) {}

fn unwritable(path: &Path, error: &io::Error) -> Fault {
    match error.kind() {
        io::ErrorKind::NotFound => {
            Fault::in_file(path, "there is no such folder", "make it first, or name another")
        }
        io::ErrorKind::NotADirectory => {
            Fault::in_file(path, "what should be its folder is none", "name a file in a folder")
        }
        _ => Fault::in_file(
            path,
            format_args!("it cannot be written: {error}"),
            "name a file in a folder that you can write to",
        ),
    }
}
