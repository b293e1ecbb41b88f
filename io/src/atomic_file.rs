//! Files that are there whole or not at all: written beside their place under another name, then renamed. A file that
//! cannot be written to its end is left out, and nothing else suffers: whoever writes it goes on, and is told by
//! [`AtomicFile::keep`]. What a command reads, and what this program did not write, is not overwritten.

use std::ffi::OsStr;
use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use self::heads::worth;
pub use self::heads::{
    CSV_HEAD, HTML_HEAD, ITF_HEAD, MAN_HEAD, MCAP_LIBRARY, MCAP_PROFILE, ROS_HEADS, SVG_HEAD,
};
use crate::diagnostic::{Diagnostic, Halt, unmade};

mod heads;

/// Which files a command may replace: empty ones and those that this program wrote, but none that keeps work for later
/// or that the command reads.
#[derive(Clone, Debug, Default)]
pub struct Replaceable {
    foreign: Foreign,
    inputs: Vec<PathBuf>,
}

/// The fate of a file that this program did not write, or that keeps work.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Foreign {
    /// It stays.
    #[default]
    Keep,
    /// It is replaced.
    Replace,
}

impl Replaceable {
    /// The files that a command may replace which does so with `foreign` ones and reads `inputs`.
    pub fn new(foreign: Foreign, inputs: impl IntoIterator<Item = PathBuf>) -> Self {
        Self { foreign, inputs: inputs.into_iter().collect() }
    }

    /// Checks that a file may stand at `target`, which the user calls `path`.
    fn check(&self, path: &Path, target: &Path) -> Result<(), Diagnostic> {
        check_name(path)?;
        if target.is_dir() {
            return Err(Diagnostic::in_file(path, "this is a folder", "name a file in it"));
        }
        if !target.exists() {
            return Ok(());
        }
        if !target.is_file() {
            return Err(Diagnostic::in_file(path, "this is a device or a pipe", "name a file"));
        }
        if self.inputs.iter().any(|input| is_same(input, target)) {
            let what = "this command reads this file, and does not overwrite it";
            return Err(Diagnostic::in_file(path, what, "store it elsewhere"));
        }
        if self.foreign == Foreign::Keep
            && let Some(what) = worth(target)
        {
            return Err(Diagnostic::in_file(path, what, "store it elsewhere, or replace it with `force`"));
        }
        Ok(())
    }
}

/// Refuses `-`, which elsewhere stands for the standard output.
///
/// # Errors
/// A [`Diagnostic`] that says how a file with that name is named.
pub fn check_name(path: &Path) -> Result<(), Diagnostic> {
    if path != Path::new("-") {
        return Ok(());
    }
    let remedy = "name a file or a folder; one that is called so is ./-";
    Err(Diagnostic::in_file(path, "files are not written to standard output", remedy))
}

/// Whether two paths lead to the same file, by whatever names.
#[cfg(unix)]
pub fn is_same(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |path: &Path| fs::metadata(path).map(|data| (data.dev(), data.ino()));
    matches!((place(one), place(other)), (Ok(one), Ok(other)) if one == other)
}

/// Whether two paths lead to the same file.
#[cfg(not(unix))]
pub fn is_same(one: &Path, other: &Path) -> bool {
    matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other)
}

/// Links that lead from one to the next are followed so far.
const MAX_LINKS: usize = 40;

/// Where the file is to stand that the user calls `path`: where the symbolic link leads, if it is one.
fn target(path: &Path) -> Result<PathBuf, Diagnostic> {
    let mut target = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&target) {
            // A link to a pipe, as /dev/stdout may be one, leads to no name.
            Ok(link) if path.is_file() || !path.exists() => target = folder(&target).join(link),
            Ok(_) | Err(_) => return Ok(target),
        }
    }
    Err(Diagnostic::in_file(path, "the symbolic links lead to no end", "name a file"))
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        Some(_) | None => Path::new("."),
    }
}

/// A file in the making. Dropped before [`AtomicFile::keep`], it leaves nothing behind.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    target: PathBuf,
    replaceable: Replaceable,
    /// The text written so far, or why the file is left out.
    file: Result<BufWriter<Part>, Diagnostic>,
}

impl AtomicFile {
    /// A file that is to stand at `path`; one that stands there now is replaced in the end, and a symbolic link
    /// followed.
    ///
    /// # Errors
    /// A [`Diagnostic`] if nothing can be written in its folder, or what stands at `path` is not to be replaced.
    pub fn new(path: &Path, replaceable: &Replaceable) -> Result<Self, Diagnostic> {
        let target = target(path)?;
        replaceable.check(path, &target)?;
        let part = Part::new(folder(&target)).map_err(|error| unwritable(path, &error))?;
        let file = Ok(BufWriter::new(part));
        Ok(Self { path: path.to_owned(), target, replaceable: replaceable.clone(), file })
    }

    /// A file of which the place is known only when the work is done: what is wrong with it is told by
    /// [`AtomicFile::keep`].
    pub fn late(path: &Path, replaceable: &Replaceable) -> Self {
        Self::new(path, replaceable).unwrap_or_else(|fault| Self {
            path: path.to_owned(),
            target: path.to_owned(),
            replaceable: replaceable.clone(),
            file: Err(fault),
        })
    }

    /// The files that a command stores, where they have a place.
    ///
    /// # Errors
    /// A [`Diagnostic`] as of [`AtomicFile::new`], or if two of them are the same.
    pub fn several<const N: usize>(
        paths: [Option<&Path>; N],
        replaceable: &Replaceable,
    ) -> Result<[Option<Self>; N], Diagnostic> {
        let mut files = [const { None::<Self> }; N];
        for (place, path) in paths.into_iter().enumerate() {
            let Some(path) = path else { continue };
            files[place] = Some(Self::beside(path, files[..place].iter().flatten(), replaceable)?);
        }
        Ok(files)
    }

    /// A file that a command stores beside others.
    ///
    /// # Errors
    /// A [`Diagnostic`] as of [`AtomicFile::new`], or if it is to stand where one of the others is.
    pub fn beside<'a>(
        path: &Path,
        mut others: impl Iterator<Item = &'a Self>,
        replaceable: &Replaceable,
    ) -> Result<Self, Diagnostic> {
        let file = Self::new(path, replaceable)?;
        if others.any(|other| other.place() == file.place()) {
            let what = "two files are to stand here";
            return Err(Diagnostic::in_file(path, what, "give each a name of its own"));
        }
        Ok(file)
    }

    /// The path as the user gave it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The place of the file, the same however its path is written.
    fn place(&self) -> (Option<PathBuf>, Option<&OsStr>) {
        (folder(&self.target).canonicalize().ok(), self.target.file_name())
    }

    /// Adds `content` at the end.
    pub fn append(&mut self, content: impl AsRef<[u8]>) {
        if let Ok(file) = &mut self.file
            && let Err(error) = file.write_all(content.as_ref())
        {
            self.leave_out(unwritable(&self.path, &error));
        }
    }

    /// Adds what was drawn at the end, or leaves the file out for the fault in it.
    ///
    /// # Errors
    /// [`Halt`] if the user asked to stop.
    pub fn draw(&mut self, drawn: Result<impl AsRef<[u8]>, Halt>) -> Result<(), Halt> {
        match drawn {
            Ok(content) => self.append(content),
            Err(Halt::Diagnostic(fault)) => self.leave_out(fault),
            Err(halt @ Halt::Interrupted) => return Err(halt),
        }
        Ok(())
    }

    /// Gives the file up, and makes room for others.
    pub fn leave_out(&mut self, fault: Diagnostic) {
        if let Ok(file) = mem::replace(&mut self.file, Err(fault)) {
            // What is still buffered is not to be written when dropped.
            let _ = file.into_parts();
        }
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// A [`Diagnostic`] if that is not possible, or if the file was left out; then nothing of it is left.
    pub fn keep(self) -> Result<(), Diagnostic> {
        place(vec![self.finish()?]).pop().map_or(Ok(()), Err)
    }

    /// Puts the file in its place, locked until what is returned is closed.
    ///
    /// # Errors
    /// A [`Diagnostic`] as of [`AtomicFile::keep`], or if another process has put a file there.
    pub(crate) fn keep_locked(self, standing: Occupant) -> Result<File, Diagnostic> {
        let FinishedFile { path, target, part, .. } = self.finish()?;
        lock(&path, part.file.as_file())?;
        let kept = match standing {
            Occupant::Held => part.file.persist(&target),
            Occupant::Nothing => part.file.persist_noclobber(&target),
        };
        kept.map_err(|refused| match refused.error.kind() {
            io::ErrorKind::AlreadyExists => {
                let what = "another process has put a file here meanwhile";
                Diagnostic::in_file(&path, what, "wait until it has ended, or name another file")
            }
            _ => unwritable(&path, &refused.error),
        })
    }

    /// The file, written to its end.
    ///
    /// # Errors
    /// A [`Diagnostic`] if that is not possible, or if the file was left out; then nothing of it is left.
    pub fn finish(self) -> Result<FinishedFile, Diagnostic> {
        let Self { path, target, replaceable, file } = self;
        let part = file?.into_inner().map_err(|error| {
            let (error, file) = error.into_parts();
            let _ = file.into_parts();
            unwritable(&path, &error)
        })?;
        // Meanwhile something else may have come there.
        replaceable.check(&path, &target)?;
        Ok(FinishedFile { path, target, replaceable, part })
    }
}

/// A file that is written to its end, and has yet to be put in its place. Dropped before, it leaves nothing behind.
#[derive(Debug)]
pub struct FinishedFile {
    path: PathBuf,
    target: PathBuf,
    replaceable: Replaceable,
    part: Part,
}

/// Puts files in their places together, so that all of them are the new ones or all the old ones: whoever [`abandon`]s
/// unfinished files meanwhile waits. Returns the faults of those that have no place.
pub fn place(files: Vec<FinishedFile>) -> Vec<Diagnostic> {
    let together = unfinished();
    let put = |FinishedFile { path, target, replaceable, part }: FinishedFile| {
        let Part { file, entry } = part;
        // Meanwhile something else may have come there.
        let placed = replaceable.check(&path, &target).and_then(|()| {
            file.persist(&target).map(drop).map_err(|refused| unwritable(&path, &refused.error))
        });
        (entry, placed.err())
    };
    let (entries, faults): (Vec<Entry>, Vec<Option<Diagnostic>>) = files.into_iter().map(put).unzip();
    drop(together);
    drop(entries);
    faults.into_iter().flatten().collect()
}

/// The file that stands in the place of one that processes lock.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Occupant {
    /// Nothing: what another process puts there is not replaced.
    Nothing,
    /// A file that this process has locked.
    Held,
}

/// Locks an open file, called `path`, against other processes, until it is closed. Where files cannot be locked, this
/// is logged as a warning.
///
/// # Errors
/// A [`Diagnostic`] if another process has locked it.
pub fn lock(path: &Path, file: &File) -> Result<(), Diagnostic> {
    match file.try_lock() {
        Ok(()) => Ok(()),
        Err(TryLockError::WouldBlock) => {
            let what = "another process is at work with it";
            Err(Diagnostic::in_file(path, what, "wait until it has ended, or name another one"))
        }
        Err(TryLockError::Error(error)) => {
            tracing::warn!("{} cannot be locked against other processes: {error}", path.display());
            Ok(())
        }
    }
}

/// The unfinished files of this process.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all unfinished files, for a process that ends at once: it can begin no other one.
pub fn abandon() {
    let mut unfinished = unfinished();
    for path in unfinished.drain(..) {
        let _ = fs::remove_file(path);
    }
    mem::forget(unfinished);
}

/// A file under another name.
#[derive(Debug)]
struct Part {
    file: NamedTempFile,
    entry: Entry,
}

/// The place of a file among the unfinished ones.
#[derive(Debug)]
struct Entry(PathBuf);

impl Part {
    fn new(folder: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".tautline-").suffix(".part");
        open_to_others(&mut builder);
        let mut unfinished = unfinished();
        let file = builder.tempfile_in(folder)?;
        unfinished.push(file.path().to_owned());
        let entry = Entry(file.path().to_owned());
        Ok(Self { file, entry })
    }
}

impl Write for Part {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for Entry {
    fn drop(&mut self) {
        unfinished().retain(|path| *path != self.0);
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

fn unwritable(path: &Path, error: &io::Error) -> Diagnostic {
    match error.kind() {
        io::ErrorKind::NotFound => {
            Diagnostic::in_file(path, "there is no such folder", "make it first, or name another")
        }
        io::ErrorKind::NotADirectory => {
            Diagnostic::in_file(path, "what should be its folder is none", "name a file in a folder")
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
            let what = format_args!("it is left out, there is no room for it: {}", error.kind());
            Diagnostic::in_file(path, what, "make room, or store it elsewhere")
        }
        _ => {
            // An error that is met as a part is made goes on with the name of the part, which the user has not given.
            let why = unmade(error);
            let why = why.split(" at path ").next().unwrap_or_default();
            let what = format_args!("it cannot be written: {why}");
            Diagnostic::in_file(path, what, "name a file in a folder that you can write to")
        }
    }
}

/// A fault is told when the file is put in its place.
impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.append(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn several<const N: usize>(paths: [Option<&Path>; N]) -> Result<[Option<AtomicFile>; N], Diagnostic> {
        AtomicFile::several(paths, &Replaceable::default())
    }

    #[test]
    fn of_several_files_none_is_begun_if_one_cannot_be() {
        let folder = tempfile::tempdir().expect("a folder");
        let (one, other) = (folder.path().join("one"), folder.path().join("other"));
        let files = || folder.path().read_dir().expect("a folder").count();
        let [mut file, none, _] = several([Some(&*one), None, Some(&*other)]).expect("places");
        assert!(none.is_none());
        file.as_mut().expect("a place").append("text");
        drop(file);
        assert!(several([Some(&*one), Some(&folder.path().join("nowhere").join("other"))]).is_err());
        let again = folder.path().join(".").join("one");
        assert!(several([Some(&*one), Some(&*again)]).is_err());
        assert_eq!(files(), 0);
        let all = several([Some(&*one), Some(&*other)]).expect("places");
        for file in all.into_iter().flatten() {
            file.keep().expect("room");
        }
        assert_eq!(files(), 2);
    }

    #[test]
    fn files_of_one_command_are_all_new_or_all_old() {
        let folder = tempfile::tempdir().expect("a folder");
        let paths = ["one", "two", "three"].map(|name| folder.path().join(name));
        let replaceable = Replaceable::new(Foreign::Replace, []);
        let finished = |text: &str| {
            paths.each_ref().map(|path| {
                let mut file = AtomicFile::new(path, &replaceable).expect("a place");
                file.append(text);
                file.finish().expect("room")
            })
        };
        let read = || paths.each_ref().map(|path| fs::read_to_string(path).ok());
        assert!(place(finished("old").into()).is_empty());
        drop(finished("given up"));
        let new = finished("new");
        assert_eq!(read(), ["old"; 3].map(|text| Some(text.to_owned())));
        // One that has no place any more is left out alone.
        fs::remove_file(&paths[1]).expect("a file");
        fs::create_dir(&paths[1]).expect("a folder");
        assert_eq!(
            place(new.into()),
            [Diagnostic::in_file(&paths[1], "this is a folder", "name a file in it")]
        );
        assert_eq!(read(), [Some("new".to_owned()), None, Some("new".to_owned())]);
        assert_eq!(folder.path().read_dir().expect("a folder").count(), 3);
    }

    #[test]
    fn a_file_that_is_left_out_leaves_nothing_and_says_why() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("one");
        let mut file = AtomicFile::new(&path, &Replaceable::default()).expect("a place");
        file.append("text");
        let fault = Diagnostic::in_file(&path, "it is too large", "take less");
        file.leave_out(fault.clone());
        assert_eq!(folder.path().read_dir().expect("a folder").count(), 0);
        file.append("more");
        assert_eq!(file.keep(), Err(fault));
        assert_eq!(folder.path().read_dir().expect("a folder").count(), 0);
    }

    #[test]
    fn a_file_that_came_meanwhile_is_not_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("one");
        let file = AtomicFile::new(&path, &Replaceable::default()).expect("a place");
        fs::write(&path, "something else").expect("a file");
        assert!(file.keep().is_err());
        assert_eq!(fs::read_to_string(&path).expect("text"), "something else");
        assert_eq!(folder.path().read_dir().expect("a folder").count(), 1);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn where_nothing_may_be_written_no_name_is_told_but_that_of_the_user() {
        let path = Path::new("/sys/file");
        let fault = AtomicFile::new(path, &Replaceable::default()).map(drop).expect_err("a folder of Linux");
        assert!(!fault.to_string().contains(".part"), "{fault}");
        assert!(fault.what().ends_with(": you may not write there"), "{fault}");
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_not_replaced() {
        let replaceable = Replaceable::new(Foreign::Replace, []);
        let refused = AtomicFile::new(Path::new("/dev/null"), &replaceable).map(|_| ());
        let fault = Diagnostic::in_file(Path::new("/dev/null"), "this is a device or a pipe", "name a file");
        assert_eq!(refused, Err(fault));
    }
}
