//! How work is kept, left and taken up again. There is one protocol. Work is a [`Part`], which goes on in small steps
//! and can tell how far it is. A [`Checkpoint`] keeps it in a file of three lines of JSON: the [`Task`] that is worked
//! at, with the version of the file; how far it is; and the checksum of the two. The file is written aside and put in
//! its place, so the last good one stands there whenever the work is killed. It is locked as long as the work goes on:
//! no other process can go on from it meanwhile. A file of another version or of another task is refused where the two
//! differ.
//!
//! A hunt is one part. [`shards`](crate::shards) deal a task out in many parts, and make one of them again.

use std::fmt::Display;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::json;
use serde_json::value::{RawValue, to_raw_value};

use crate::atomic_file::{AtomicFile, Foreign, Occupant, Replaceable, lock};
use crate::diagnostic::{Diagnostic, Halt};
use crate::json_lines::{self, MAX_FILE_BYTES, Magic, key_of, line_of, value_of};

/// The version of every such file that has none of its own.
pub const VERSION: u32 = 1;

/// How often work on its way is kept.
const KEEP_EVERY: Duration = Duration::from_secs(5);

/// How much of a part is done, under the names that JSON has for it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[expect(missing_docs, reason = "the fields are named as in the text for people")]
pub enum Facts {
    /// Of a hunt through runs.
    Runs { runs: u64, moves: u64 },
    /// Of a hunt that looks at each layout by itself.
    Layouts { layouts: usize, moves: u64 },
    /// Of a table.
    Jobs { jobs: usize, jobs_done: usize },
}

/// Work, or a part of it, that can be left and taken up again.
pub trait Part {
    /// Works a little further. Returns whether there is more to do, and to spend.
    ///
    /// # Errors
    /// [`Halt`] if it cannot be done.
    fn step(&mut self) -> Result<bool, Halt>;

    /// How far it is: enough to go on from here, on any machine.
    ///
    /// # Errors
    /// A [`Diagnostic`] if that cannot be written.
    fn far(&self) -> Result<Box<RawValue>, Diagnostic>;

    /// Whether nothing is left to do.
    fn is_done(&self) -> bool;

    /// How much is done, for programs.
    fn facts(&self) -> Facts;

    /// How much is done, for people.
    fn words(&self) -> String;
}

/// `value` as JSON, as it stands in a file.
///
/// # Errors
/// A [`Diagnostic`] if it cannot be written.
pub fn encode(value: &impl Serialize) -> Result<Box<RawValue>, Diagnostic> {
    to_raw_value(value).map_err(|error| Diagnostic::usage(error, "report it: this is a bug of tautline"))
}

/// The value that [`encode`] has written.
///
/// # Errors
/// A [`Diagnostic`] with this `remedy` if it is none.
pub fn decode<'a, T: Deserialize<'a>>(value: &'a RawValue, remedy: &str) -> Result<T, Diagnostic> {
    json_lines::parse(value.get()).map_err(|(_, what)| Diagnostic::usage(what, remedy))
}

/// The first line of a file: what is worked at.
pub trait Task: Serialize + DeserializeOwned {
    /// Its field `format`.
    const FORMAT: &'static str;
    /// Its field `version`.
    const VERSION: u32 = VERSION;
    /// The noun for such a file.
    const NOUN: &'static str;
    /// The fault of a file of another task.
    const OTHER: &'static str;
    /// The fields in which tasks differ.
    const FIELDS: &'static [&'static str];
    /// The remedy for a file that is none.
    const AGAIN: &'static str;
    /// The remedy for a file of another format, which may be of use elsewhere.
    const OTHER_FORMAT: &'static str = Self::AGAIN;
    /// The remedy for a file of another task.
    const ELSEWHERE: &'static str;
    /// The remedy for a file that another build has made, where that is one of the fields: `program`.
    const OTHER_BUILD: &'static str = Self::ELSEWHERE;

    /// The field of `kept` that names what this task does not know, and what is wrong with the name.
    fn unknown(&self, _kept: &Self) -> Option<(&'static str, String)> {
        None
    }

    /// Notes whether nothing is left to do.
    fn set_done(&mut self, _is_done: bool) {}
}

/// The last line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Seal {
    crc32: u32,
}

/// A file of three lines.
pub(crate) struct Lines<T> {
    path: PathBuf,
    /// The lines without their ends.
    text: [String; 3],
    task: T,
}

impl<T: Task> Lines<T> {
    /// The lines of `file`, called `path`, of which the first and the last are sound. If a task is `asked` for, it
    /// knows the names in the first one.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is no such file, or damaged.
    pub(crate) fn read(path: &Path, file: &File, asked: Option<&T>) -> Result<Self, Diagnostic> {
        let whole = |what: String| Diagnostic::in_file(path, what, T::AGAIN);
        let mut bytes = Vec::new();
        let mut file = file.take(MAX_FILE_BYTES + 1);
        file.read_to_end(&mut bytes).map_err(|error| whole(format!("the file cannot be read: {error}")))?;
        if bytes.len() as u64 > MAX_FILE_BYTES {
            let noun = T::NOUN;
            return Err(whole(format!("{noun} has at most {MAX_FILE_BYTES} bytes, and this file more")));
        }
        let text = String::from_utf8(bytes).map_err(|_| whole("this is not UTF-8 text".to_owned()))?;
        let lines: Vec<&str> = text.lines().collect();
        let [first, second, third] = lines[..] else {
            return Err(whole(format!("{} has three lines, and this file {}", T::NOUN, lines.len())));
        };
        let magic: Magic = parse::<T, _>(path, 1, first)?;
        if let Some((field, what)) = magic.differs(T::FORMAT, T::VERSION) {
            let remedy = if field == "format" { T::OTHER_FORMAT } else { T::AGAIN };
            return Err(in_header(path, first, field, what, remedy));
        }
        let task = parse::<T, T>(path, 1, first)?;
        if let Some((field, what)) = asked.and_then(|asked| asked.unknown(&task)) {
            return Err(none::<T>(path, 1, first, value_of(first, field).end.saturating_sub(1), what));
        }
        let seal: Seal = parse::<T, _>(path, 3, third)?;
        let crc32 = crc32fast::hash(format!("{first}\n{second}\n").as_bytes());
        if seal.crc32 != crc32 {
            let what = format!("the file is damaged: its checksum is {}, its lines give {crc32}", seal.crc32);
            return Err(Diagnostic::in_line(path, 3, third, 0..third.len(), what, T::AGAIN));
        }
        Ok(Self { path: path.to_owned(), task, text: [first, second, third].map(str::to_owned) })
    }

    /// The task that is worked at.
    pub(crate) const fn task(&self) -> &T {
        &self.task
    }

    /// How far it is.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the second line does not tell it.
    pub(crate) fn far<F: DeserializeOwned>(&self) -> Result<F, Diagnostic> {
        parse::<T, _>(&self.path, 2, &self.text[1])
    }

    /// The whole text.
    pub(crate) fn text(&self) -> String {
        self.text.join("\n") + "\n"
    }

    /// A fault at a field of the first line.
    pub(crate) fn in_header(&self, field: &str, what: String, remedy: &str) -> Diagnostic {
        in_header(&self.path, &self.text[0], field, what, remedy)
    }

    /// Checks that it is of the task `asked` for.
    ///
    /// # Errors
    /// A [`Diagnostic`] at the field in which they differ.
    pub(crate) fn check(&self, asked: &T) -> Result<(), Diagnostic> {
        let (kept, asked) = (json!(self.task), json!(asked));
        let Some(key) = T::FIELDS.iter().find(|&&key| kept[key] != asked[key]) else { return Ok(()) };
        if *key == "program" {
            return Err(self.of_another_build());
        }
        let what = format!("{}: {key} {}, asked for is {}", T::OTHER, kept[key], asked[key]);
        Err(self.in_header(key, what, T::ELSEWHERE))
    }

    /// The fault of a file that another build has made.
    pub(crate) fn of_another_build(&self) -> Diagnostic {
        let noun = T::NOUN.trim_start_matches("a ");
        self.in_header("program", format!("another build of tautline made this {noun}"), T::OTHER_BUILD)
    }
}

/// The three lines.
pub(crate) fn text(task: &impl Task, far: &RawValue) -> String {
    let mut text = line_of(task) + &line_of(&far);
    text += &line_of(&Seal { crc32: crc32fast::hash(text.as_bytes()) });
    text
}

fn in_header(path: &Path, text: &str, field: &str, what: String, remedy: &str) -> Diagnostic {
    Diagnostic::in_line(path, 1, text, key_of(text, field), what, remedy)
}

fn parse<'b, T: Task, V: Deserialize<'b>>(
    path: &Path,
    number: usize,
    text: &'b str,
) -> Result<V, Diagnostic> {
    json_lines::parse(text).map_err(|(column, message)| none::<T>(path, number, text, column, message))
}

/// The fault of a line that is none, in this column from 0 on.
fn none<T: Task>(path: &Path, number: usize, text: &str, column: usize, what: impl Display) -> Diagnostic {
    let what = format!("this is no {}: {what}", T::NOUN.trim_start_matches("a "));
    Diagnostic::in_line(path, number, text, column..column + 1, what, T::AGAIN)
}

/// A part of some task that is kept in a file, if it has a place.
#[derive(Debug)]
pub struct Checkpoint<'a, T> {
    path: Option<&'a Path>,
    task: T,
    /// The file that stands at the path, as far as this process knows.
    standing: Occupant,
    /// That file, locked.
    held: Option<File>,
    /// When it was last tried to write one.
    tried: Instant,
}

impl<'a, T: Task> Checkpoint<'a, T> {
    /// The part of `task` that is to be kept at `path`; without one it is not kept.
    pub fn new(path: Option<&'a Path>, task: T) -> Self {
        Self { path, task, standing: Occupant::Nothing, held: None, tried: Instant::now() }
    }

    /// How far the part was by its file, which is locked from now on; `None` if there is no file.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the file is damaged, of another task or in use.
    pub fn read<F: DeserializeOwned>(&mut self) -> Result<Option<F>, Diagnostic> {
        let Some(path) = self.path else { return Ok(None) };
        let Some(file) = open::<T>(path)? else { return Ok(None) };
        lock(path, &file)?;
        // A process that has just let it go may have put a newer one there.
        if !stands_at(&file, path) {
            return self.read();
        }
        let lines = Lines::<T>::read(path, &file, Some(&self.task))?;
        (self.standing, self.held) = (Occupant::Held, Some(file));
        lines.check(&self.task)?;
        lines.far().map(Some)
    }

    /// The fault of what the file says, if there is one; else of what was asked for.
    #[must_use]
    pub fn found(&self, fault: Diagnostic) -> Diagnostic {
        match self.path {
            Some(path) if self.standing == Occupant::Held => fault.found_in(path),
            Some(_) | None => fault,
        }
    }

    /// Keeps how far `part` is.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be written, or another process has put a file there.
    pub fn keep(&mut self, part: &(impl Part + ?Sized)) -> Result<(), Diagnostic> {
        let Some(path) = self.path else { return Ok(()) };
        self.tried = Instant::now();
        let is_own = self.standing == Occupant::Held;
        let foreign = if is_own { Foreign::Replace } else { Foreign::Keep };
        let mut file = AtomicFile::new(path, &Replaceable::new(foreign, []))?;
        self.task.set_done(part.is_done());
        file.append(text(&self.task, &part.far()?));
        if cfg!(not(unix)) {
            // Elsewhere no file is replaced that is open.
            self.held = None;
        }
        self.held = Some(file.keep_locked(self.standing)?);
        self.standing = Occupant::Held;
        Ok(())
    }

    /// Keeps how far `part` is, unless that was kept in the last seconds. Where it cannot be written, the last good
    /// file stands until there is room again; that is logged as a warning.
    pub fn keep_now_and_then(&mut self, part: &(impl Part + ?Sized)) {
        if self.tried.elapsed() > KEEP_EVERY
            && let Err(fault) = self.keep(part)
        {
            tracing::warn!("{fault}");
        }
    }
}

/// The file that stands at the path; `None` if none does.
pub(crate) fn open<T: Task>(path: &Path) -> Result<Option<File>, Diagnostic> {
    if path.is_dir() {
        return Err(Diagnostic::in_file(path, "this is a folder", "name a file in it"));
    }
    if path.exists() && !path.is_file() {
        return Err(Diagnostic::in_file(path, "this is a device or a pipe", "name a file"));
    }
    match File::open(path) {
        Ok(file) => Ok(Some(file)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => {
            let what = format_args!("the file cannot be read: {error}");
            Err(Diagnostic::in_file(path, what, T::AGAIN))
        }
    }
}

/// Whether `file` is the one that stands at `path`.
#[cfg(unix)]
fn stands_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let [one, other] =
        [file.metadata(), path.metadata()].map(|data| data.ok().map(|data| (data.dev(), data.ino())));
    one.is_some() && one == other
}

/// Whether `file` is the one that stands at `path`: what is open is not replaced.
#[cfg(not(unix))]
fn stands_at(_: &File, _: &Path) -> bool {
    true
}
