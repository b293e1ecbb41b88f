//! The commands that the documents name: in their blocks of code, and within their sentences.

#![allow(dead_code, reason = "each test needs a part of it")]

use std::fs;
use std::path::{Path, PathBuf};

/// Lines of code that stand together on a page.
pub(crate) struct Block {
    /// The page, and the language of the block.
    pub(crate) place: String,
    /// Whether it is for a shell.
    pub(crate) is_shell: bool,
    /// The arguments of each command of ours.
    pub(crate) commands: Vec<Vec<String>>,
}

/// The documents that people read: those of the project's folder and of docs/.
pub(crate) fn documents() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let entries = [root.to_owned(), root.join("docs")].into_iter().flat_map(|folder| {
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path())
    });
    let mut found: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|extension| extension == "md")).collect();
    found.sort();
    found
}

/// The words of a command as a shell takes them, up to where another begins.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quote) = (Vec::new(), None::<String>, None);
    for sign in line.chars() {
        match (quote, sign) {
            (Some(open), _) if sign == open => quote = None,
            (None, '\'' | '"') => {
                quote = Some(sign);
                word.get_or_insert_default();
            }
            (None, '|' | '>' | ';' | '&' | '#') => break,
            (None, ' ') => words.extend(word.take()),
            _ => word.get_or_insert_default().push(sign),
        }
    }
    words.extend(word);
    words
}

/// The arguments of a command of ours, if the line is one.
pub(crate) fn arguments(line: &str) -> Option<Vec<String>> {
    let line = line.trim_start();
    let line =
        ["- run: ", "run: ", "$ "].into_iter().find_map(|start| line.strip_prefix(start)).unwrap_or(line);
    let starts = ["tautline ", "cargo run --release -- ", "cargo run --release --locked -- "];
    starts.into_iter().find_map(|start| line.strip_prefix(start)).map(words)
}

/// The blocks of code of all documents that have commands of ours.
pub(crate) fn blocks() -> Vec<Block> {
    let mut found = Vec::new();
    for path in documents() {
        let text = fs::read_to_string(&path).expect("a document");
        let name = path.file_name().expect("a name").display().to_string();
        for block in text.split("\n```").skip(1).step_by(2) {
            let (language, lines) = block.split_once('\n').unwrap_or((block, ""));
            let commands: Vec<_> = lines.lines().filter_map(arguments).collect();
            if !commands.is_empty() && language != "text" {
                let is_shell = ["sh", "console"].contains(&language);
                found.push(Block { place: format!("{name}, {language}"), is_shell, commands });
            }
        }
    }
    found
}

/// The commands of ours that stand within sentences, each with its page, but those with a word in capitals for what a
/// person has to choose.
pub(crate) fn spans() -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for path in documents() {
        let text = fs::read_to_string(&path).expect("a document");
        let sentences: String = text.split("\n```").step_by(2).collect();
        for span in sentences.split('`').skip(1).step_by(2) {
            let is_chosen = |word: &String| {
                word.contains(['…', '='])
                    || word.chars().all(|sign| sign.is_ascii_uppercase() || "[]".contains(sign))
            };
            let command = arguments(&span.replace('\n', " "));
            found.extend(
                command
                    .filter(|words| !words.iter().any(is_chosen))
                    .map(|words| (path.file_name().expect("a name").display().to_string(), words)),
            );
        }
    }
    found
}
