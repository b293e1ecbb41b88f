//! A hunt on its way, as a file of three lines of JSON: what is hunted, where the search is, and the checksum of the
//! two. It is written aside and put in its place, so the last good one stands there whenever the work is killed.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::json;
use tautline_kernel::lattice::Cell;
use tautline_proofs::search::{Bounds, Position, Search};

use super::{remedy, start};
use crate::aside::Aside;
use crate::explore::{RuleName, SchemeName};
use crate::fault::Fault;

const FORMAT: &str = "tautline hunt";
const VERSION: u32 = 1;

/// Larger files are refused: a search of the largest team has less to say.
const MAX_BYTES: u64 = 1 << 26;

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
    scheme: SchemeName,
    rule: RuleName,
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
#[derive(Clone, Debug)]
pub struct Saved<'a> {
    path: &'a Path,
    header: Header,
}

impl<'a> Saved<'a> {
    /// The hunt within `bounds` by `scheme` and `rule`, to be kept at `path`.
    pub fn new(path: &'a Path, scheme: SchemeName, rule: RuleName, bounds: &Bounds) -> Self {
        let area = bounds.reach().unwrap_or(bounds.area);
        let header = Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            scheme,
            rule,
            robots: bounds.robots,
            area: [area.first(), area.last()],
            base: bounds.base,
        };
        Self { path, header }
    }

    /// The search as it is in the file, or from the start if there is no file.
    ///
    /// # Errors
    /// A [`Fault`] if the file is damaged or of another hunt, or the bounds cannot be searched.
    pub fn search(&self, bounds: &Bounds) -> Result<Search, Fault> {
        match self.read()? {
            None => start(bounds),
            Some(position) => Search::at(bounds, &position)
                .map_err(|refused| Fault::in_file(self.path, refused, remedy(refused))),
        }
    }

    /// Keeps where `search` is.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be written.
    pub fn write(&self, search: &Search) -> Result<(), Fault> {
        let mut text = line(&self.header) + &line(&search.position());
        text += &line(&Seal { crc32: crc32fast::hash(text.as_bytes()) });
        Aside::write(self.path, text)
    }

    fn read(&self) -> Result<Option<Position>, Fault> {
        let whole = |what: String| Fault::in_file(self.path, what, AGAIN);
        if self.path.is_dir() {
            return Err(Fault::in_file(self.path, "this is a folder", "name a file in it"));
        }
        let too_long = fs::metadata(self.path).is_ok_and(|data| data.is_file() && data.len() > MAX_BYTES);
        if too_long {
            return Err(whole(format!("a kept hunt has at most {MAX_BYTES} bytes, and this file more")));
        }
        let text = match fs::read(self.path) {
            Ok(bytes) => String::from_utf8(bytes).map_err(|_| whole("this is not UTF-8 text".to_owned()))?,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(whole(format!("the file cannot be read: {error}"))),
        };
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
            return Err(self.in_header(first, key, what, "ask for the same, or give another --resume file"));
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

fn line(value: &impl Serialize) -> String {
    // Numbers, strings and lists of them can always be written.
    serde_json::to_string(value).unwrap_or_default() + "\n"
}
