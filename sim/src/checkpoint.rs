//! Work on its way, as a file of three lines of JSON: what is worked at, how far it is, and the checksum of the two. It
//! is written aside and put in its place, so the last good one stands there whenever the work is killed. The file that
//! stands there is locked as long as the work goes on: no other process can go on from it meanwhile.

use std::fmt::Display;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::atomic_file::{AtomicFile, Replaceable, Standing, lock};
use crate::diagnostic::Diagnostic;
use crate::layout::MAX_FILE_BYTES;
use crate::trace::lines::{Magic, value_of};

/// The version of every such file.
pub(crate) const VERSION: u32 = 1;

/// The first line: what is worked at.
pub(crate) trait Header: Serialize + DeserializeOwned {
    /// Its field `format`.
    const FORMAT: &'static str;
    /// What such a file is called.
    const NOUN: &'static str;
    /// What is wrong with one of another work.
    const OTHER: &'static str;
    /// The fields in which works differ.
    const FIELDS: &'static [&'static str];
    /// What to do about a file that is none.
    const AGAIN: &'static str;
    /// What to do about one of another work.
    const ELSEWHERE: &'static str;

    /// The field of `kept` that names what this work does not know, and what is wrong with the name.
    fn unknown(&self, _kept: &Self) -> Option<(&'static str, String)> {
        None
    }
}

/// The last line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Seal {
    crc32: u32,
}

/// A file of three lines.
pub(crate) struct Lines<H> {
    path: PathBuf,
    /// The lines without their ends.
    text: [String; 3],
    header: H,
}

impl<H: Header> Lines<H> {
    /// The lines of `file`, called `path`, of which the first and the last are sound. If a work is `asked` for, it knows
    /// the names in the first one.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is no such file, or damaged.
    pub(crate) fn read(path: &Path, file: &File, asked: Option<&H>) -> Result<Self, Diagnostic> {
        let whole = |what: String| Diagnostic::in_file(path, what, H::AGAIN);
        let mut bytes = Vec::new();
        let mut file = file.take(MAX_FILE_BYTES + 1);
        file.read_to_end(&mut bytes).map_err(|error| whole(format!("the file cannot be read: {error}")))?;
        if bytes.len() as u64 > MAX_FILE_BYTES {
            let noun = H::NOUN;
            return Err(whole(format!("{noun} has at most {MAX_FILE_BYTES} bytes, and this file more")));
        }
        let text = String::from_utf8(bytes).map_err(|_| whole("this is not UTF-8 text".to_owned()))?;
        let lines: Vec<&str> = text.lines().collect();
        let [first, second, third] = lines[..] else {
            return Err(whole(format!("{} has three lines, and this file {}", H::NOUN, lines.len())));
        };
        let magic: Magic = parse::<H, _>(path, 1, first)?;
        if let Some((field, what)) = magic.differs(H::FORMAT, VERSION) {
            return Err(in_header(path, first, field, what, H::AGAIN));
        }
        let header = parse::<H, H>(path, 1, first)?;
        if let Some((field, what)) = asked.and_then(|asked| asked.unknown(&header)) {
            return Err(none::<H>(path, 1, first, value_of(first, field).end.saturating_sub(1), what));
        }
        let seal: Seal = parse::<H, _>(path, 3, third)?;
        let crc32 = crc32fast::hash(format!("{first}\n{second}\n").as_bytes());
        if seal.crc32 != crc32 {
            let what = format!("the file is damaged: its checksum is {}, its lines give {crc32}", seal.crc32);
            return Err(Diagnostic::in_line(path, 3, third, 0..third.len(), what, H::AGAIN));
        }
        Ok(Self { path: path.to_owned(), header, text: [first, second, third].map(str::to_owned) })
    }

    /// What is worked at.
    pub(crate) const fn header(&self) -> &H {
        &self.header
    }

    /// How far it is.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the second line does not tell it.
    pub(crate) fn far<T: DeserializeOwned>(&self) -> Result<T, Diagnostic> {
        parse::<H, _>(&self.path, 2, &self.text[1])
    }

    /// The whole text.
    pub(crate) fn text(&self) -> String {
        self.text.join("\n") + "\n"
    }

    /// A fault at a field of the first line.
    pub(crate) fn in_header(&self, field: &str, what: String, remedy: &str) -> Diagnostic {
        in_header(&self.path, &self.text[0], field, what, remedy)
    }

    /// Checks that it is of the work `asked` for.
    ///
    /// # Errors
    /// A [`Diagnostic`] at the field in which they differ.
    pub(crate) fn check(&self, asked: &H) -> Result<(), Diagnostic> {
        let (kept, asked) = (json!(self.header), json!(asked));
        let Some(key) = H::FIELDS.iter().find(|&&key| kept[key] != asked[key]) else { return Ok(()) };
        let what = format!("{}: {key} {}, asked for is {}", H::OTHER, kept[key], asked[key]);
        Err(self.in_header(key, what, H::ELSEWHERE))
    }
}

/// The three lines.
pub(crate) fn text(header: &impl Header, far: &impl Serialize) -> String {
    let mut text = line(header) + &line(far);
    text += &line(&Seal { crc32: crc32fast::hash(text.as_bytes()) });
    text
}

fn line(value: &impl Serialize) -> String {
    // Numbers, strings and lists of them can always be written.
    serde_json::to_string(value).unwrap_or_default() + "\n"
}

fn in_header(path: &Path, text: &str, field: &str, what: String, remedy: &str) -> Diagnostic {
    let field = format!("{field:?}");
    let start = text.find(&field).unwrap_or(0);
    Diagnostic::in_line(path, 1, text, start..start + field.len(), what, remedy)
}

fn parse<'b, H: Header, T: Deserialize<'b>>(
    path: &Path,
    number: usize,
    text: &'b str,
) -> Result<T, Diagnostic> {
    serde_json::from_str(text).map_err(|error| {
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        none::<H>(path, number, text, error.column().saturating_sub(1), message)
    })
}

/// The fault of a line that is none, in this column from 0 on.
fn none<H: Header>(path: &Path, number: usize, text: &str, column: usize, what: impl Display) -> Diagnostic {
    let what = format!("this is no {}: {what}", H::NOUN.trim_start_matches("a "));
    Diagnostic::in_line(path, number, text, column..column + 1, what, H::AGAIN)
}

/// Work that is kept in a file.
#[derive(Debug)]
pub(crate) struct Checkpoint<'a, H> {
    path: &'a Path,
    header: H,
    /// What stands at the path, as far as this work knows.
    standing: Standing,
    /// That file, locked.
    held: Option<File>,
}

impl<'a, H: Header> Checkpoint<'a, H> {
    /// This work, to be kept at `path`.
    pub(crate) const fn new(path: &'a Path, header: H) -> Self {
        Self { path, header, standing: Standing::Nothing, held: None }
    }

    /// Where it is kept.
    pub(crate) const fn path(&self) -> &'a Path {
        self.path
    }

    /// What is worked at.
    pub(crate) const fn header_mut(&mut self) -> &mut H {
        &mut self.header
    }

    /// Keeps how far it is.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be written, or another process has put a file there.
    pub(crate) fn write(&mut self, far: &impl Serialize) -> Result<(), Diagnostic> {
        let mut aside = AtomicFile::new(self.path, &Replaceable::default())?;
        aside.append(text(&self.header, far));
        if cfg!(not(unix)) {
            // Elsewhere no file is replaced that is open.
            self.held = None;
        }
        self.held = Some(aside.keep_locked(self.standing)?);
        self.standing = Standing::Held;
        Ok(())
    }

    /// How far it was by the file, which is locked from now on; `None` if there is no file.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the file is damaged, of another work or in use.
    pub(crate) fn read<T: DeserializeOwned>(&mut self) -> Result<Option<T>, Diagnostic> {
        let Some(file) = open::<H>(self.path)? else { return Ok(None) };
        lock(self.path, &file)?;
        // A process that has just let it go may have put a newer one there.
        if !stands_at(&file, self.path) {
            return self.read();
        }
        let lines = Lines::<H>::read(self.path, &file, Some(&self.header))?;
        (self.standing, self.held) = (Standing::Held, Some(file));
        lines.check(&self.header)?;
        lines.far().map(Some)
    }
}

/// The file that stands at the path; `None` if none does.
pub(crate) fn open<H: Header>(path: &Path) -> Result<Option<File>, Diagnostic> {
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
            Err(Diagnostic::in_file(path, what, H::AGAIN))
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
