//! Drawings of states side by side, as a film of a run.

use std::fmt::Write;

/// Columns of text that a row of drawings may take.
const WIDTH: usize = 100;

/// These drawings, each with its title above, in rows from left to right.
pub fn beside(frames: &[(String, String)]) -> String {
    let width = |frame: &(String, String)| {
        let lines = frame.1.lines().chain([frame.0.as_str()]);
        lines.map(|line| line.chars().count()).max().unwrap_or(0)
    };
    let mut text = String::new();
    let mut left = frames;
    while !left.is_empty() {
        let mut columns = 0;
        let fits = left.iter().take_while(|frame| {
            columns += width(frame) + 3;
            columns <= WIDTH + 3
        });
        let (row, rest) = left.split_at(fits.count().max(1));
        left = rest;
        let height = row.iter().map(|(_, drawing)| drawing.lines().count()).max().unwrap_or(0);
        for number in 0..=height {
            let mut line = String::new();
            for frame in row {
                let part = match number.checked_sub(1) {
                    None => frame.0.as_str(),
                    Some(number) => frame.1.lines().nth(number).unwrap_or(""),
                };
                // Writing to a string cannot fail.
                let _ = write!(line, "{part:width$}   ", width = width(frame));
            }
            text += line.trim_end();
            text.push('\n');
        }
        if !left.is_empty() {
            text.push('\n');
        }
    }
    text
}

/// The numbers of those of which this is so.
pub fn names<T>(all: &[T], is_meant: impl Fn(&T) -> bool) -> String {
    all.iter().zip('0'..).filter(|(one, _)| is_meant(one)).map(|(_, name)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawings_stand_side_by_side_below_their_titles_and_a_row_that_is_full_is_followed_by_another() {
        let frames = [("start", "0.\n.1"), ("0: goes", "·0\n·1")];
        let frames = frames.map(|(title, drawing)| (title.to_owned(), drawing.to_owned()));
        assert_eq!(beside(&frames), "start   0: goes\n0.      ·0\n.1      ·1\n");
        let wide = ("wide".to_owned(), "-".repeat(60));
        let rows = beside(&[wide.clone(), wide.clone()]);
        assert_eq!(rows, format!("wide\n{0}\n\nwide\n{0}\n", wide.1));
        assert_eq!(beside(&[]), "");
    }
}
