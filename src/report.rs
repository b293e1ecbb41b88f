//! A fault as a person sees it: one line, or the spot drawn.

use ariadne::{CharSet, Color, Config, Fmt, IndexType, Label, Report, ReportKind, Source};
use tautline_io::diagnostic::{Diagnostic, Excerpt, Place};
use tautline_sim::options::Extra;

/// Beyond this line the spot is not drawn: the drawing counts lines from the first.
const MAX_DRAWN_LINE: usize = 1 << 20;

/// Whether a report may use terminal colours, and signs that are not ASCII.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Colour {
    /// ANSI escapes.
    Ansi,
    /// Plain characters.
    Plain,
    /// Plain characters, of which the drawing of a spot is in ASCII.
    Ascii,
}

/// The fields of a request that have a flag of the same name, besides those that are told by an [`Extra`].
const FIELDS: [&str; 28] = [
    "seed",
    "miss",
    "robots",
    "base",
    "size",
    "max-cells",
    "max-walls",
    "max-misses",
    "max-moves",
    "resume",
    "image",
    "cell",
    "radius",
    "force",
    "trace",
    "out",
    "moves",
    "scheme",
    "budget",
    "max-losses",
    "error",
    "power-dbm",
    "exponent",
    "rule",
    "solver",
    "plan",
    "shards",
    "shard",
];

/// `words` with the flags of the fields that they name.
pub(crate) fn with_flags(words: &str) -> String {
    let flag = |words: String, field| words.replace(&format!("`{field}`"), &format!("--{field}"));
    FIELDS.into_iter().chain(Extra::ALL.map(|extra| extra.field)).fold(words.to_owned(), flag)
}

/// The fault in words. Only where it is asked for something are the words our own; elsewhere they may quote a file.
fn what(fault: &Diagnostic) -> String {
    match fault.place() {
        Place::Request { .. } => with_flags(fault.what()),
        Place::File(_) | Place::Spot { .. } => fault.what().to_owned(),
    }
}

/// The fault over several lines, with the spot drawn where there is one. Ends with a newline.
pub(crate) fn render(fault: &Diagnostic, colour: Colour) -> String {
    match fault.place() {
        Place::Spot { file, line, column, excerpt } if *line <= MAX_DRAWN_LINE => {
            draw(fault, file, (*line, *column), excerpt, colour).unwrap_or_else(|| headline(fault, colour))
        }
        Place::Spot { .. } | Place::File(_) | Place::Request { .. } => headline(fault, colour),
    }
}

fn headline(fault: &Diagnostic, colour: Colour) -> String {
    let (error, help) = match colour {
        Colour::Ansi => ("Error:".fg(Color::Red).to_string(), "Help:".fg(Color::Fixed(115)).to_string()),
        Colour::Plain | Colour::Ascii => ("Error:".to_owned(), "Help:".to_owned()),
    };
    format!("{error} {}{}\n {help} {}\n", fault.place(), what(fault), with_flags(fault.remedy()))
}

/// The excerpt with one sign of ASCII for each, so that what points at it does so still.
fn narrow(excerpt: &Excerpt) -> Excerpt {
    let signs = |end: usize| excerpt.text[..end].chars().count();
    let mark = signs(excerpt.mark.start)..signs(excerpt.mark.end);
    let ascii = |sign: char| match sign {
        _ if sign.is_ascii() => sign,
        '…' => '~',
        _ => '?',
    };
    Excerpt { text: excerpt.text.chars().map(ascii).collect(), mark }
}

/// Empty lines stand for those before the excerpt, so that the margin numbers are those of the file. The heading counts
/// columns in the clipped line, hence the replacement.
fn draw(
    fault: &Diagnostic,
    file: &str,
    (line, column): (usize, usize),
    excerpt: &Excerpt,
    colour: Colour,
) -> Option<String> {
    let skipped = line - 1;
    let config = Config::new().with_index_type(IndexType::Byte);
    let (excerpt, config) = match colour {
        Colour::Ascii => (&narrow(excerpt), config.with_char_set(CharSet::Ascii)),
        Colour::Ansi | Colour::Plain => (excerpt, config),
    };
    let mark = skipped + excerpt.mark.start..skipped + excerpt.mark.end;
    let (config, label) = match colour {
        Colour::Ansi => (config, Label::new((file, mark.clone())).with_color(Color::Red)),
        Colour::Plain | Colour::Ascii => (config.with_color(false), Label::new((file, mark.clone()))),
    };
    let mut drawing = Vec::new();
    Report::build(ReportKind::Error, (file, mark))
        .with_config(config)
        .with_message(fault.what())
        .with_label(label.with_message("here"))
        .with_help(with_flags(fault.remedy()))
        .finish()
        .write((file, Source::from("\n".repeat(skipped) + &excerpt.text)), &mut drawing)
        .ok()?;
    let shown_column = 1 + excerpt.text[..excerpt.mark.start].chars().count();
    let heading = |column| format!("{file}:{line}:{column} ");
    Some(String::from_utf8(drawing).ok()?.replacen(&heading(shown_column), &heading(column), 1))
}
