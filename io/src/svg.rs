//! Pictures as SVG, for light and dark pages: the document, its colours, and panels beside each other. Titles and
//! captions are plain text, and escaped here, where they are written; a body is SVG.

use std::fmt::Write;

use crate::atomic_file::SVG_HEAD;

/// The space round a picture and between its panels.
pub const MARGIN: i32 = 16;
/// The height of a line of text above a panel.
const CAPTION: i32 = 22;
/// Panels beside each other take up at most so much.
const PAGE_WIDTH: i32 = 960;

/// The colours of all pictures, by the class of what they paint.
const STYLE: &str = "\
svg{--ground:#fff;--ink:#1b1f24;--faint:#d4d9e0;--explored:#e3edf9;--visited:#f0d6ba;--sealed:#d9a878;\
--blocked:#9aa4b1;--robot:#1d5fa8;--leader:#0b7a53;--base:#5b3a8c;--bad:#c4261d;font:12px \
system-ui,sans-serif;background:var(--ground)}@media(prefers-color-scheme:dark){svg{--ground:#14181d;--ink:#e6eaef;\
--faint:#333b45;--explored:#1f3550;--visited:#4f3a26;--sealed:#7d5632;--blocked:#5d6875;--robot:#6aa9ee;\
--leader:#4cc79a;--base:#b795e6;--bad:#ff7b72}}text{fill:var(--ink);text-anchor:middle;dominant-baseline:central}\
.caption{text-anchor:start}.lines{stroke:var(--faint);fill:none}.walls{stroke:var(--ink);stroke-width:3;\
stroke-linecap:square;fill:none}.blocked{fill:var(--blocked)}.explored{fill:var(--explored)}\
.visited{fill:var(--visited)}.sealed{fill:var(--sealed)}.closing{fill:var(--explored);stroke:var(--visited);\
stroke-width:3}.member{fill:var(--robot);fill-opacity:.35}.order{fill:var(--robot)}.small{font-size:10px}\
.robot{fill:var(--robot)}.leader{fill:var(--leader)}.base{fill:var(--base)}.name{fill:var(--ground);font-size:10px;\
font-weight:600}.link{stroke:var(--robot);stroke-width:2;stroke-opacity:.5}.way{stroke:var(--ink);stroke-width:1.5}\
.tip{fill:var(--ink)}.bump{stroke:var(--bad);stroke-width:3}.unseen{stroke:var(--bad);stroke-width:2;\
stroke-dasharray:3 2;fill:none}.broken{stroke:var(--bad);stroke-width:3;stroke-dasharray:5 3}.crowded{fill:var(--bad)}";

/// How many colours there are for what is to be told apart.
pub const SERIES: usize = 6;

/// These colours.
pub const SERIES_STYLE: &str = "\
svg{--series-0:#1d5fa8;--series-1:#b9480e;--series-2:#0b7a53;--series-3:#5b3a8c;--series-4:#856500;--series-5:#b02a73}\
@media(prefers-color-scheme:dark){svg{--series-0:#6aa9ee;--series-1:#ff9d6b;--series-2:#4cc79a;--series-3:#b795e6;\
--series-4:#d9b93b;--series-5:#f08ac0}}";

/// A part of a picture with its size, its corner at 0,0.
#[derive(Clone, Debug)]
pub struct Panel {
    caption: String,
    width: i32,
    height: i32,
    body: String,
}

impl Panel {
    /// A part of such a width and height. The caption is empty if there is none.
    pub const fn new(caption: String, (width, height): (i32, i32), body: String) -> Self {
        Self { caption, width, height, body }
    }

    /// How long it is.
    pub const fn bytes(&self) -> usize {
        self.caption.len() + self.body.len()
    }

    /// A whole picture of panels beside each other, as many in a row as the page holds.
    pub fn picture(title: &str, panels: &[Self]) -> String {
        let (mut body, mut x, mut y) = (String::new(), MARGIN, MARGIN);
        let (mut width, mut row_height) = (0, 0);
        for panel in panels {
            if x > MARGIN && x + panel.width + MARGIN > PAGE_WIDTH {
                (x, y, row_height) = (MARGIN, y + row_height + MARGIN, 0);
            }
            let caption = if panel.caption.is_empty() { 0 } else { CAPTION };
            // Writing to a string cannot fail.
            let _ = write!(body, "<g transform=\"translate({x},{y})\">");
            if caption > 0 {
                let _ = write!(
                    body,
                    "<text class=\"caption\" y=\"{}\">{}</text>",
                    CAPTION / 2 - 2,
                    escaped(&panel.caption)
                );
            }
            let _ = writeln!(body, "<g transform=\"translate(0,{caption})\">{}</g></g>", panel.body);
            x += panel.width.max(text_width(&panel.caption)) + MARGIN;
            width = width.max(x);
            row_height = row_height.max(panel.height + caption);
        }
        document(title, "", (width, y + row_height + MARGIN), &body)
    }
}

/// About how wide a line of text is.
pub fn text_width(text: &str) -> i32 {
    text.chars().count() as i32 * 7
}

/// Text as XML has it. Characters that XML has no place for become U+FFFD.
pub fn escaped(text: &str) -> String {
    text.chars().fold(String::new(), |mut escaped, symbol| {
        match symbol {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            control if control.is_control() => escaped.push('\u{fffd}'),
            plain => escaped.push(plain),
        }
        escaped
    })
}

/// A picture of `body` alone, which wants `style` beside that of all pictures. The title is plain text.
pub fn document(title: &str, style: &str, (width, height): (i32, i32), body: &str) -> String {
    let title = escaped(title);
    format!(
        "{SVG_HEAD}viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\" \
         aria-label=\"{title}\">\n<title>{title}</title>\n<style>{STYLE}{style}</style>\n\
         <rect width=\"{width}\" height=\"{height}\" style=\"fill:var(--ground)\"/>\n{body}</svg>\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_and_captions_are_escaped_and_as_wide_as_they_are_seen() {
        let drawn = |name: &str| Panel::picture(name, &[Panel::new(name.to_owned(), (9, 9), String::new())]);
        let picture = drawn("R&D <a>");
        // In an attribute, in the title and in the picture.
        assert_eq!((picture.matches("R&amp;D &lt;a&gt;").count(), picture.contains("<a>")), (3, false));
        let width = |picture: &str| picture.split("width=\"").nth(1)?.split('"').next().map(str::to_owned);
        assert_eq!(width(&picture), width(&drawn("R+D +a+")));
    }
}
