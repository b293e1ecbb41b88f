//! ASCII alone, for terminals, logs and programs that show nothing else: what is printed with `--ascii`. Text is put
//! into words of ASCII, and keeps its columns; JSON, JUnit and manual pages write a sign by its number, which is the
//! same sign for whoever reads them. Files are not touched.

use std::borrow::Cow;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// The option.
const OPTION: &str = "--ascii";

static ASKED: AtomicBool = AtomicBool::new(false);

/// Looks for the option, so that it holds also for what is told of a command line that cannot be read. What stands
/// behind `--` is none of ours.
pub(super) fn look_for(arguments: impl Iterator<Item = OsString>) {
    ASKED.store(is_among(arguments), Ordering::Relaxed);
}

fn is_among(arguments: impl Iterator<Item = OsString>) -> bool {
    arguments.take_while(|argument| argument != "--").any(|argument| argument == OPTION)
}

/// Whether nothing but ASCII is to be printed.
pub(super) fn is_asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Text as it is printed for people.
pub(super) fn text(text: &str) -> Cow<'_, str> {
    if is_asked() { plain(text) } else { Cow::Borrowed(text) }
}

/// JSON as it is printed.
pub(super) fn json(json: String) -> String {
    unless_asked(json, |sign| {
        let mut buffer = [0; 2];
        let units = sign.encode_utf16(&mut buffer).iter().map(|unit| format!("\\u{unit:04x}"));
        units.collect::<Vec<_>>().concat()
    })
}

/// XML as it is printed.
pub(super) fn xml(xml: String) -> String {
    unless_asked(xml, |sign| format!("&#x{:x};", u32::from(sign)))
}

/// A manual page as it is printed.
pub(super) fn roff(page: String) -> String {
    unless_asked(page, |sign| format!("\\[u{:04X}]", u32::from(sign)))
}

/// `text`, in which `escape` stands for each sign that is not ASCII, if that is asked for.
fn unless_asked(text: String, escape: impl Fn(char) -> String) -> String {
    if is_asked() { escaped(&text, escape) } else { text }
}

fn escaped(text: &str, escape: impl Fn(char) -> String) -> String {
    text.chars().map(|sign| if sign.is_ascii() { sign.to_string() } else { escape(sign) }).collect()
}

/// A path between quotes of a shell that knows `$'…'`, where a name may not be put into other words.
pub(super) fn quoted(path: &str) -> String {
    let quoted = path.bytes().fold(String::from("$'"), |mut quoted, byte| {
        // Writing to a string cannot fail.
        let _ = match byte {
            b'\'' | b'\\' => write!(quoted, "\\{}", char::from(byte)),
            b' '..=b'~' => write!(quoted, "{}", char::from(byte)),
            _ => write!(quoted, "\\x{byte:02x}"),
        };
        quoted
    });
    quoted + "'"
}

/// Text in signs of ASCII. What becomes longer takes the room from the next gap of its line, so that columns stay where
/// they are.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    if text.is_ascii() {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len());
    let (mut excess, mut is_raised) = (0_usize, false);
    let mut rest = text.chars().peekable();
    while let Some(sign) = rest.next() {
        let was_raised = is_raised;
        is_raised = is_superscript(sign);
        match sign {
            '\n' => excess = 0,
            // A gap keeps a space.
            ' ' if excess > 0 && rest.peek() == Some(&' ') => {
                excess -= 1;
                continue;
            }
            _ if sign.is_ascii() => {}
            _ => {
                let before = plain.len();
                match ascii(sign) {
                    "" => plain.extend(sign.escape_unicode()),
                    words if is_raised && was_raised => plain.push_str(words.trim_start_matches('^')),
                    words => plain.push_str(words),
                }
                excess += (plain.len() - before).saturating_sub(1);
                continue;
            }
        }
        plain.push(sign);
    }
    Cow::Owned(plain)
}

fn is_superscript(sign: char) -> bool {
    ascii(sign).starts_with('^') && !matches!(sign, '↑' | '^')
}

/// The signs of our texts and drawings in ASCII; nothing for others. In a drawing one sign stands for one.
const fn ascii(sign: char) -> &'static str {
    match sign {
        '·' => ".",
        '−' | '–' | '—' | '‑' | '─' | '━' | '╌' | '┄' => "-",
        '│' | '┃' | '╎' | '┆' => "|",
        '\u{2500}'..='\u{257f}' => "+",
        '░' => "%",
        '▒' => "@",
        '▓' => "&",
        '\u{2580}'..='\u{259f}' => "#",
        '→' | '▶' | '⟩' | '›' => ">",
        '←' | '◀' | '⟨' | '‹' => "<",
        '↑' => "^",
        '↓' => "v",
        '⇒' => "=>",
        '×' | '✗' => "x",
        '÷' => "/",
        '±' => "+-",
        '≤' => "<=",
        '≥' => ">=",
        '≠' => "/=",
        '≈' => "~",
        '√' => "sqrt ",
        '∞' => "inf",
        '∈' => "in",
        '°' => " deg",
        '½' => "1/2",
        '‰' => " per mille",
        '⌊' | '⌈' => "[",
        '⌋' | '⌉' => "]",
        '…' => "...",
        '“' | '”' | '„' | '«' | '»' => "\"",
        '‘' | '’' | '′' => "'",
        '\u{a0}' | '\u{202f}' | '\u{2009}' => " ",
        '⁰' => "^0",
        '¹' => "^1",
        '²' => "^2",
        '³' => "^3",
        '⁴' => "^4",
        '⁵' => "^5",
        '⁶' => "^6",
        '⁷' => "^7",
        '⁸' => "^8",
        '⁹' => "^9",
        '⁻' => "^-",
        'ᵀ' => "^T",
        '₀' => "0",
        '₁' => "1",
        '₂' => "2",
        '₃' => "3",
        'α' => "alpha",
        'µ' | 'μ' | 'ü' => "u",
        'π' => "pi",
        'ρ' => "rho",
        'θ' => "theta",
        'χ' => "chi",
        'á' | 'à' | 'ä' => "a",
        'Č' => "C",
        'é' | 'è' => "e",
        'ñ' => "n",
        'ó' | 'ö' => "o",
        'ý' => "y",
        'ß' => "ss",
        _ => "",
    }
}

/// A standard error in which nothing but ASCII is written, if that is asked for. What is written at a time is whole.
pub(super) struct Stderr;

impl Write for Stderr {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match std::str::from_utf8(bytes) {
            Ok(whole) => io::stderr().write_all(text(whole).as_bytes())?,
            Err(_) => io::stderr().write_all(bytes)?,
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stderr().flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_keeps_its_columns() {
        let drawing = "+---+---+\n|1→ |░?░|\n|3× | · |\n+---+---+\n";
        assert_eq!(plain(drawing), "+---+---+\n|1> |%?%|\n|3x | . |\n+---+---+\n");
    }

    #[test]
    fn columns_behind_longer_words_stay_where_they_are() {
        assert_eq!(plain("43 ± 4    17 ± 2    no\n±1 m  x"), "43 +- 4   17 +- 2   no\n+-1 m x");
        assert_eq!(plain("a…b, 10⁻¹² m² at 90°"), "a...b, 10^-12 m^2 at 90 deg");
    }

    #[test]
    fn what_has_no_words_is_written_by_its_number() {
        assert_eq!(plain("日.jsonl"), "\\u{65e5}.jsonl");
        assert_eq!(quoted("it's é"), "$'it\\'s \\xc3\\xa9'");
    }

    #[test]
    fn the_option_is_looked_for_up_to_the_program_that_is_run() {
        let asked = |words: &str| is_among(words.split(' ').map(OsString::from));
        assert!(asked("tautline prove --ascii"));
        assert!(!asked("tautline conform run.jsonl -- robots --ascii"));
    }
}
