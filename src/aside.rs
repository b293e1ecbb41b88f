//! Files that are there whole or not at all: written beside their place under another name, then renamed.

use std::ffi::OsStr;
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
    /// A [`Fault`] if nothing can be written in its folder, or what stands at `path` is no file that can be replaced.
    pub fn new(path: &Path) -> Result<Self, Fault> {
        if path.is_dir() {
            return Err(Fault::in_file(path, "this is a folder", "name a file in it"));
        }
        if path.exists() && !path.is_file() {
            return Err(Fault::in_file(path, "this is a device or a pipe", "name a file"));
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

    /// The files that a command stores, where they have a place.
    ///
    /// # Errors
    /// A [`Fault`] as of [`Aside::new`], or if two of them are the same.
    pub fn several<const N: usize>(paths: [Option<&Path>; N]) -> Result<[Option<Self>; N], Fault> {
        let mut asides = [const { None::<Self> }; N];
        for (place, path) in paths.into_iter().enumerate() {
            let Some(path) = path else { continue };
            let (aside, taken) = (Self::new(path)?, asides[..place].iter().flatten());
            if taken.into_iter().any(|other| other.place() == aside.place()) {
                let what = "two files are to stand here";
                return Err(Fault::in_file(path, what, "give each a name of its own"));
            }
            asides[place] = Some(aside);
        }
        Ok(asides)
    }

    /// Puts all of them in their places.
    ///
    /// # Errors
    /// A [`Fault`] if that is not possible.
    pub fn keep_all<const N: usize>(asides: [Option<Self>; N]) -> Result<(), Fault> {
        asides.into_iter().flatten().try_for_each(Self::keep)
    }

    /// The same for each file, however it is written.
    fn place(&self) -> (Option<PathBuf>, Option<&OsStr>) {
        (
            self.file.get_ref().path().parent().and_then(|folder| folder.canonicalize().ok()),
            self.path.file_name(),
        )
    }

    /// Puts `content` at `path`.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be written.
    pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<(), Fault> {
        Self::new(path)?.finish(content)
    }

    /// Adds `content` at the end, and puts the file in its place.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be written.
    pub fn finish(mut self, content: impl AsRef<[u8]>) -> Result<(), Fault> {
        self.append(content)?;
        self.keep()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_several_files_all_are_there_or_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let (one, other) = (folder.path().join("one"), folder.path().join("other"));
        let files = || folder.path().read_dir().expect("a folder").count();
        let [mut aside, none, _] = Aside::several([Some(&*one), None, Some(&*other)]).expect("places");
        assert!(none.is_none());
        aside.as_mut().expect("a place").append("text").expect("room");
        drop(aside);
        assert!(Aside::several([Some(&*one), Some(&folder.path().join("nowhere").join("other"))]).is_err());
        let again = folder.path().join(".").join("one");
        assert!(Aside::several([Some(&*one), Some(&*again)]).is_err());
        assert_eq!(files(), 0);
        Aside::several([Some(&*one), Some(&*other)]).and_then(Aside::keep_all).expect("places");
        assert_eq!(files(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_not_replaced() {
        let refused = Aside::new(Path::new("/dev/null")).map(|_| ());
        let fault = Fault::in_file(Path::new("/dev/null"), "this is a device or a pipe", "name a file");
        assert_eq!(refused, Err(fault));
    }
}
