//! The part of YAML in which ROS maps are written: one `key: value` a line. A value is a word, a text between quotes,
//! or a list of these, either `[x, y]` or one below the other behind dashes. Comments are passed over, and so are keys
//! that nobody looks for, with whatever is indented below them. All else that YAML has is refused as such, and not
//! guessed.

use std::ops::Range;

use tautline_io::diagnostic::Diagnostic;

use super::file::{Line, Misread, lines};

/// The keys that a map has; others are passed over.
const KEYS: [&str; 7] = ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"];

/// The fields that a map has, in words.
pub(super) const FIELDS: &str =
    "a map has the fields image, resolution, origin: [x, y, yaw], negate, occupied_thresh and free_thresh";

/// How a file is written.
const SHAPE: &str = "write one `key: value` a line, where a value is a word, a text between quotes, or a list such \
                     as [0, 0, 0]";

/// The characters with which YAML begins what is neither a word nor a number.
const MARKS: [char; 13] = ['&', '*', '!', '|', '>', '%', '@', '`', '{', '}', '[', ']', ','];

/// A word, a number or a text, and the bytes in which it stands.
#[derive(Debug)]
pub(super) struct Scalar {
    pub(super) text: String,
    pub(super) at: Range<usize>,
}

/// The value of a key that is looked for.
#[derive(Debug)]
struct Entry {
    key: &'static str,
    /// Whether it is a list, and not one scalar.
    is_list: bool,
    scalars: Vec<Scalar>,
    /// The bytes in which it begins: those of the key, if it stands below that.
    at: Range<usize>,
}

/// The values of the keys that are looked for.
#[derive(Debug)]
pub(super) struct Mapping {
    entries: Vec<Entry>,
    /// The bytes of the last line.
    end: Range<usize>,
}

/// The key above a line that is indented, or begins with a dash.
enum Above {
    /// It has its value, or there is none.
    Whole,
    /// Its list stands below it.
    List,
    /// Nobody looks for it.
    Unknown,
}

/// The problem of the bytes `at` of a file that is none of a map.
pub(super) fn no_map(at: &Range<usize>, what: &str, remedy: &str) -> Misread {
    Misread {
        at: at.clone(),
        problem: Diagnostic::usage(format!("this does not describe a map: {what}"), remedy),
    }
}

/// The problem of what YAML has, and this reader has not.
fn unread(at: Range<usize>, what: &str) -> Misread {
    no_map(&at, &format!("{what} is YAML that is not read here"), SHAPE)
}

impl Mapping {
    /// Reads the values of the keys that a map has.
    ///
    /// # Errors
    /// The first [`Diagnostic`] from the top, and the bytes it lies in.
    pub(super) fn read(source: &str) -> Result<Self, Misread> {
        let mut mapping = Self { entries: Vec::new(), end: 0..0 };
        let mut above = None;
        for line in lines(source) {
            mapping.end = line.at(0..line.text.len());
            let content = line.text.trim();
            if content.is_empty() || content.starts_with('#') || above.is_none() && content == "---" {
                continue;
            }
            let is_below = line.text.starts_with(is_blank) || line.text.starts_with("- ");
            above = Some(match above.unwrap_or(Above::Whole) {
                Above::Unknown if is_below => Above::Unknown,
                Above::List if is_below => mapping.add_item(&line)?,
                Above::Whole | Above::List | Above::Unknown => mapping.add(&line)?,
            });
        }
        Ok(mapping)
    }

    /// Adds the key of a line, and its value if it stands there.
    fn add(&mut self, line: &Line<'_>) -> Result<Above, Misread> {
        let is_word = |key: &str| key.chars().all(|char| char.is_ascii_alphanumeric() || char == '_');
        let pair = line.text.split_once(':').filter(|&(key, _)| is_word(key));
        let Some((key, _)) = pair.filter(|(_, rest)| rest.is_empty() || rest.starts_with(is_blank)) else {
            return Err(unread(line.at(0..line.text.len()), "this line"));
        };
        let Some(&key) = KEYS.iter().find(|&&one| one == key) else { return Ok(Above::Unknown) };
        let at = line.at(0..key.len());
        if self.entries.iter().any(|entry| entry.key == key) {
            return Err(no_map(&at, &format!("`{key}` stands here again"), FIELDS));
        }
        let mut text = Text { line, at: key.len() + 1 };
        let (above, entry) = match text.next() {
            None => (Above::List, Entry { key, is_list: true, scalars: Vec::new(), at }),
            Some('[') => {
                let (scalars, at) = text.list()?;
                (Above::Whole, Entry { key, is_list: true, scalars, at })
            }
            Some(_) => {
                let scalar = text.scalar(&[])?;
                let at = scalar.at.clone();
                (Above::Whole, Entry { key, is_list: false, scalars: vec![scalar], at })
            }
        };
        text.end()?;
        self.entries.push(entry);
        Ok(above)
    }

    /// Adds a line below a key to the list of that.
    fn add_item(&mut self, line: &Line<'_>) -> Result<Above, Misread> {
        let indent = line.text.len() - line.text.trim_start().len();
        if !line.text[indent..].starts_with("- ") {
            return Err(unread(line.at(indent..line.text.len()), "what is indented here"));
        }
        let mut text = Text { line, at: indent + 1 };
        let scalar = text.scalar(&[])?;
        text.end()?;
        if let Some(entry) = self.entries.last_mut() {
            entry.scalars.push(scalar);
        }
        Ok(Above::List)
    }

    fn find(&self, key: &str) -> Result<&Entry, Misread> {
        let found = self.entries.iter().find(|entry| entry.key == key);
        found.ok_or_else(|| no_map(&self.end, &format!("missing field `{key}`"), FIELDS))
    }

    /// Whether a key is there.
    pub(super) fn has(&self, key: &str) -> bool {
        self.find(key).is_ok()
    }

    /// The value of a key.
    ///
    /// # Errors
    /// A [`Misread`] if it is not there, or a list.
    pub(super) fn scalar(&self, key: &str) -> Result<&Scalar, Misread> {
        match self.find(key)? {
            Entry { is_list: false, scalars, .. } if let [scalar] = &scalars[..] => Ok(scalar),
            Entry { at, .. } => Err(no_map(at, &format!("`{key}` is to have one value"), FIELDS)),
        }
    }

    /// The number of a key, and the bytes in which it stands.
    ///
    /// # Errors
    /// A [`Misread`] if it is not there, or no number.
    pub(super) fn number(&self, key: &str) -> Result<(f64, Range<usize>), Misread> {
        let scalar = self.scalar(key)?;
        Ok((Self::parse(scalar)?, scalar.at.clone()))
    }

    /// The list of a key, and the bytes in which it begins.
    ///
    /// # Errors
    /// A [`Misread`] if it is not there, or is no list of `N` numbers.
    pub(super) fn numbers<const N: usize>(&self, key: &str) -> Result<([f64; N], Range<usize>), Misread> {
        let Entry { scalars, at, is_list, .. } = self.find(key)?;
        let numbers = scalars.iter().map(Self::parse).collect::<Result<Vec<f64>, _>>()?;
        let numbers = <[f64; N]>::try_from(numbers).ok().filter(|_| *is_list);
        let wrong = || no_map(at, &format!("`{key}` is no list of {N} numbers"), FIELDS);
        Ok((numbers.ok_or_else(wrong)?, at.clone()))
    }

    /// The number that stands there. YAML writes a dot before what is infinite, or no number.
    fn parse(Scalar { text, at }: &Scalar) -> Result<f64, Misread> {
        let plain = text.replacen(".inf", "inf", 1).replacen(".nan", "nan", 1);
        plain.parse().map_err(|_| no_map(at, &format!("{text:?} is no number"), FIELDS))
    }
}

const fn is_blank(character: char) -> bool {
    matches!(character, ' ' | '\t')
}

/// A line that is read from a byte on.
struct Text<'a> {
    line: &'a Line<'a>,
    at: usize,
}

impl<'a> Text<'a> {
    fn rest(&self) -> &'a str {
        &self.line.text[self.at..]
    }

    /// The next character that is no blank, and in no comment.
    fn next(&mut self) -> Option<char> {
        self.at = self.line.text.len() - self.rest().trim_start_matches(is_blank).len();
        let is_comment = self.rest().starts_with('#') && self.line.text[..self.at].ends_with(is_blank);
        self.rest().chars().next().filter(|_| !is_comment)
    }

    /// Reads a list that begins here, and returns the bytes of it.
    fn list(&mut self) -> Result<(Vec<Scalar>, Range<usize>), Misread> {
        let start = self.at;
        let mut scalars = Vec::new();
        loop {
            self.at += 1;
            if !matches!(self.next(), None | Some(']')) {
                scalars.push(self.scalar(&[',', ']'])?);
            }
            match self.next() {
                Some(',') => {}
                Some(']') => break,
                Some(_) | None => {
                    return Err(no_map(
                        &self.line.at(start..self.at),
                        "the list has no end on its line",
                        SHAPE,
                    ));
                }
            }
        }
        self.at += 1;
        Ok((scalars, self.line.at(start..self.at)))
    }

    /// Reads a word, which ends before one of `ends`, or a text between quotes.
    fn scalar(&mut self, ends: &[char]) -> Result<Scalar, Misread> {
        let first = self.next();
        let start = self.at;
        let rest = self.rest();
        let (text, is_read) = match first {
            Some(quote @ ('\'' | '"')) => {
                let Some(length) = rest[1..].find(quote) else {
                    let at = self.line.at(start..self.line.text.len());
                    return Err(no_map(&at, "the text has no end on its line", SHAPE));
                };
                self.at += length + 2;
                let text = &rest[1..=length];
                (text, !(self.rest().starts_with(quote) || quote == '"' && text.contains('\\')))
            }
            Some(first) if !MARKS.contains(&first) => {
                let word = &rest[..rest.find(ends).unwrap_or(rest.len())];
                let comment = word.find(" #").or(word.find("\t#"));
                let word = word[..comment.unwrap_or(word.len())].trim_end();
                self.at += word.len();
                (word, !(word.contains(": ") || word.ends_with(':')))
            }
            Some(_) | None => {
                self.at = self.line.text.len();
                ("", false)
            }
        };
        if !is_read {
            return Err(unread(self.line.at(start..self.at), "this value"));
        }
        Ok(Scalar { text: text.to_owned(), at: self.line.at(start..self.at) })
    }

    /// Checks that nothing more stands on the line.
    fn end(&mut self) -> Result<(), Misread> {
        match self.next() {
            None => Ok(()),
            Some(_) => Err(unread(self.line.at(self.at..self.line.text.len()), "what follows the value")),
        }
    }
}
