//! A hunt on its way, as a file of three lines of JSON: what is hunted, where the search is, and the checksum of the
//! two. It is written aside and put in its place, so the last good one stands there whenever the work is killed. The file
//! that stands there is locked as long as the hunt goes on: no other process can go on from it meanwhile.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::json;
use tautline_kernel::ground::Cell;
use tautline_proofs::chain::search::{Bounds, Position, Search};

use super::hunt::{fault, start};
use crate::aside::{Aside, Replaceable, Standing, lock};
use crate::explore::{Profile, RuleId};
use crate::fault::Fault;
use crate::layout::MAX_FILE_BYTES;

const FORMAT: &str = "tautline hunt";
const VERSION: u32 = 1;

/// What to do about a file that is no hunt of ours.
pub(super) const AGAIN: &str = "name another file, or remove it and hunt from the start";

/// What every version of the header begins with.
#[derive(Deserialize)]
struct Magic {
    format: String,
    version: u32,
}

/// What is hunted.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    format: String,
    version: u32,
    scheme: &'static Profile,
    rule: RuleId,
    robots: usize,
    /// North-west and south-east corner of the area.
    area: [Cell; 2],
    base: Cell,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Seal {
    crc32: u32,
}

/// A hunt that is kept in a file.
#[derive(Debug)]
pub struct Saved<'a> {
    path: &'a Path,
    header: Header,
    /// What stands at the path, as far as this hunt knows.
    standing: Standing,
    /// That file, locked.
    held: Option<File>,
}

impl<'a> Saved<'a> {
    /// The hunt within `bounds` by `scheme` and `rule`, to be kept at `path`.
    pub fn new(path: &'a Path, scheme: &'static Profile, rule: impl Into<RuleId>, bounds: &Bounds) -> Self {
        let area = bounds.reach().unwrap_or(bounds.area);
        let header = Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            scheme,
            rule: rule.into(),
            robots: bounds.robots,
            area: [area.first(), area.last()],
            base: bounds.base,
        };
        Self { path, header, standing: Standing::Nothing, held: None }
    }

    /// The search as it is in the file, or from the start if there is no file.
    ///
    /// # Errors
    /// A [`Fault`] if the file is damaged, of another hunt or in use, or the bounds cannot be searched.
    pub fn search(&mut self, bounds: &Bounds) -> Result<Search, Fault> {
        match self.read()? {
            None => start(bounds),
            Some(position) => {
                Search::at(bounds, &position).map_err(|refused| fault(refused).found_in(self.path))
            }
        }
    }

    /// Keeps where `search` is.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be written, or another process has put a file there.
    pub fn write(&mut self, search: &Search) -> Result<(), Fault> {
        let mut text = line(&self.header) + &line(&search.position());
        text += &line(&Seal { crc32: crc32fast::hash(text.as_bytes()) });
        let mut aside = Aside::new(self.path, &Replaceable::default())?;
        aside.append(text);
        if cfg!(not(unix)) {
            // Elsewhere no file is replaced that is open.
            self.held = None;
        }
        self.held = Some(aside.keep_locked(self.standing)?);
        self.standing = Standing::Held;
        Ok(())
    }

    /// The file that stands at the path, locked; `None` if none does.
    fn open(&self) -> Result<Option<File>, Fault> {
        loop {
            let file = match File::open(self.path) {
                Ok(file) => file,
                Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
                Err(error) => {
                    let what = format_args!("the file cannot be read: {error}");
                    return Err(Fault::in_file(self.path, what, AGAIN));
                }
            };
            lock(self.path, &file)?;
            // A process that has just let it go may have put a newer one there.
            if stands_at(&file, self.path) {
                return Ok(Some(file));
            }
        }
    }

    fn read(&mut self) -> Result<Option<Position>, Fault> {
        let whole = |what: String| Fault::in_file(self.path, what, AGAIN);
        if self.path.is_dir() {
            return Err(Fault::in_file(self.path, "this is a folder", "name a file in it"));
        }
        if self.path.exists() && !self.path.is_file() {
            return Err(Fault::in_file(self.path, "this is a device or a pipe", "name a file"));
        }
        let Some(file) = self.open()? else { return Ok(None) };
        let mut bytes = Vec::new();
        (&file)
            .take(MAX_FILE_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| whole(format!("the file cannot be read: {error}")))?;
        if bytes.len() as u64 > MAX_FILE_BYTES {
            return Err(whole(format!("a kept hunt has at most {MAX_FILE_BYTES} bytes, and this file more")));
        }
        (self.standing, self.held) = (Standing::Held, Some(file));
        let text = String::from_utf8(bytes).map_err(|_| whole("this is not UTF-8 text".to_owned()))?;
        let lines: Vec<&str> = text.lines().collect();
        let [first, second, third] = lines[..] else {
            return Err(whole(format!("a kept hunt has three lines, and this file {}", lines.len())));
        };
        let magic: Magic = self.parse(1, first)?;
        if magic.format != FORMAT {
            let what = format!("the format is {:?}", magic.format);
            return Err(self.in_header(first, "format", what, AGAIN));
        }
        if magic.version != VERSION {
            let what = format!("this is version {}, this program reads version {VERSION}", magic.version);
            return Err(self.in_header(first, "version", what, AGAIN));
        }
        let header: Header = self.parse(1, first)?;
        let seal: Seal = self.parse(3, third)?;
        let crc32 = crc32fast::hash(format!("{first}\n{second}\n").as_bytes());
        if seal.crc32 != crc32 {
            let what = format!("the file is damaged: its checksum is {}, its lines give {crc32}", seal.crc32);
            return Err(Fault::in_line(self.path, 3, third, 0..third.len(), what, AGAIN));
        }
        let (kept, asked) = (json!(header), json!(self.header));
        let differs = |key: &&str| kept[key] != asked[key];
        if let Some(key) = ["scheme", "rule", "robots", "area", "base"].into_iter().find(differs) {
            let what = format!("this is another hunt: {key} {}, asked for is {}", kept[key], asked[key]);
            return Err(self.in_header(first, key, what, "ask for the same, or give another `resume` file"));
        }
        self.parse(2, second).map(Some)
    }

    /// A fault at a key of the header.
    fn in_header(&self, text: &str, key: &str, what: String, remedy: &str) -> Fault {
        let key = format!("{key:?}");
        let start = text.find(&key).unwrap_or(0);
        Fault::in_line(self.path, 1, text, start..start + key.len(), what, remedy)
    }

    fn parse<'b, T: Deserialize<'b>>(&self, number: usize, text: &'b str) -> Result<T, Fault> {
        serde_json::from_str(text).map_err(|error| {
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            let column = error.column().saturating_sub(1);
            let what = format!("this is no kept hunt: {message}");
            Fault::in_line(self.path, number, text, column..column + 1, what, AGAIN)
        })
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

fn line(value: &impl Serialize) -> String {
    // Numbers, strings and lists of them can always be written.
    serde_json::to_string(value).unwrap_or_default() + "\n"
}
