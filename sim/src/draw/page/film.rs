//! The part of a page that stands still beside the lines of its data: the ground, who takes part, the layers and what
//! they mean, the notes, and how to make the run again.

use std::collections::BTreeMap;

use serde::Serialize;
use tautline_io::atomic_file::HTML_HEAD;
use tautline_io::svg::escaped;
use tautline_kernel::ground::{Area, Cell, Edge, Side};
use tautline_proofs::plural::counted;

use crate::explore::{Joins, Kind, Layer, Milestone, Report, Scheme, Setup, Shape, Starts, Value, Zone};
use crate::options::{Extra, Takes};
use tautline_grids::layout::{Generator, Layout};

const TEMPLATE: &str = include_str!("page.html");
const SCRIPT: &str = concat!(include_str!("marks.js"), include_str!("page.js"));
const TOLD: &str = include_str!("told.html");

/// The part of a page that stands still.
#[derive(Serialize)]
pub struct Film {
    /// The title of the page.
    pub title: String,
    /// The outcome of the run, in a sentence.
    pub outcome: String,
    /// The noun for a line.
    pub unit: &'static str,
    /// The noun for a robot.
    pub robot: &'static str,
    /// How many robots there are.
    pub robots: usize,
    /// Whether the first robot is a base.
    pub has_base: bool,
    /// Whether the last robot leads.
    pub has_leader: bool,
    /// The number of the first robot, if it is not 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub numbered_from: Option<usize>,
    /// The number of the first line, which is what there was before.
    pub first: u32,
    /// How many there are in the whole run.
    pub of: u32,
    /// The curve under the board.
    pub share: Share,
    /// Where the robots are.
    pub board: Board,
    /// The layers that the scheme shows besides.
    pub layers: Vec<LayerJson>,
    /// By clause that is broken, its sentence.
    pub clauses: BTreeMap<&'static str, String>,
    /// The clauses that the end breaks.
    pub ends: Vec<EndBreach>,
    /// The lines worth a jump, by their numbers.
    pub notes: Vec<(u32, String)>,
    /// How to make the run again.
    pub again: Again,
}

/// The count that the curve under the board shows.
#[derive(Serialize)]
pub struct Share {
    /// The count at which it is whole.
    pub of: u32,
    /// The noun of what is counted.
    pub what: &'static str,
    /// Whether cells count as robots visit them, where no robot is to explore.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub visits: bool,
}

impl Share {
    /// The cells that are explored; of a team that is not to explore those where robots were.
    pub(super) fn of(report: &Report, layout: &Layout) -> Self {
        match report.cells {
            0 => Self { of: layout.free_cells() as u32, what: "cells visited", visits: true },
            cells => Self { of: cells, what: "cells explored", visits: false },
        }
    }
}

/// A clause that the end of the run breaks, and the cells that are missed.
#[derive(Serialize)]
pub struct EndBreach {
    /// The id of the clause.
    pub clause: &'static str,
    /// The sentence of what is missed.
    pub what: &'static str,
    /// The places of the cells, row by row.
    pub cells: Vec<u32>,
}

/// How to make another run.
#[derive(Serialize)]
pub struct Again {
    /// The command, in which LAYOUT is a file with the layout, unless a generator made it; none where the run was not
    /// made by a command.
    pub command: Option<String>,
    /// The drawing of the layout, if it is small.
    pub layout: Option<String>,
}

/// Where the run takes place.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Board {
    /// In cells.
    Cells {
        /// How many columns there are.
        columns: usize,
        /// How many rows there are.
        rows: usize,
        /// The column and the row of the first cell.
        first: [i16; 2],
        /// Row by row, a letter for so many cells: `a`, one letter more if they are blocked, two for a wall in the east
        /// and four for one in the south.
        ground: Vec<String>,
        /// Where the robots are before the first line.
        start: Vec<u32>,
        /// Whether robots see which sides of their cells are open.
        sees: bool,
    },
    /// In an area; lengths in millimetres.
    Metres {
        /// Its width and its height.
        size: [u32; 2],
        /// West, north, east and south.
        obstacles: Vec<[u32; 4]>,
        /// Where the nodes of the network are.
        nodes: Vec<[u32; 2]>,
        /// Who waits for robots.
        callers: Vec<[u32; 2]>,
        /// The noun for one of them.
        caller: &'static str,
        /// Robot by robot where it was: milliseconds, east and south, each as what it is more than before.
        paths: Vec<String>,
    },
}

impl Board {
    /// The cells of `area`, with the robots in these cells; whether they see the sides of their cells.
    pub(super) fn cells(layout: &Layout, area: Area, start: &[Cell], sees: bool) -> Self {
        let letter = |cell: Cell| {
            let wall = |side: Side, bit: u8| u8::from(layout.has_wall(Edge::new(cell, side))) * bit;
            let code = u8::from(!layout.is_free(cell)) + wall(Side::East, 2) + wall(Side::South, 4);
            char::from(b'a' + code)
        };
        Self::Cells {
            columns: area.width(),
            rows: area.height(),
            first: [area.first().x, area.first().y],
            ground: rows(area, letter),
            start: start.iter().filter_map(|&cell| place_of(area, cell)).collect(),
            sees,
        }
    }
}

/// The letters of the cells of an area as a page reads them, row by row: `b` for a cell, `2b` for two in a row.
pub fn rows(area: Area, letter: impl Fn(Cell) -> char) -> Vec<String> {
    let row = |y: i16| {
        let letters: Vec<char> = (area.first().x..=area.last().x).map(|x| letter(Cell::new(x, y))).collect();
        letters.chunk_by(|one, other| one == other).fold(String::new(), |row, alike| match alike.len() {
            1 => format!("{row}{}", alike[0]),
            many => format!("{row}{many}{}", alike[0]),
        })
    };
    (area.first().y..=area.last().y).map(row).collect()
}

/// A layer as the page reads it.
#[derive(Default, Serialize)]
pub struct LayerJson {
    name: &'static str,
    about: String,
    shape: &'static str,
    /// Whether each robot has values of its own.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    each: bool,
    #[serde(skip_serializing_if = "<[Value]>::is_empty")]
    values: &'static [Value],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    zones: Vec<Reach>,
    #[serde(skip_serializing_if = "Option::is_none")]
    joins: Option<Joins>,
    /// The radius of a circle, in thousandths.
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<u32>,
    #[serde(skip_serializing_if = "<[Kind]>::is_empty")]
    kinds: &'static [Kind],
}

#[derive(Serialize)]
struct Reach {
    name: &'static str,
    about: &'static str,
    cells: Vec<[i16; 2]>,
}

/// A layer as the page reads it.
pub fn layer(layer: &Layer) -> LayerJson {
    let plain = LayerJson { name: layer.name, about: layer.about.clone(), ..LayerJson::default() };
    let reach = |zone: &Zone| Reach { name: zone.name, about: zone.about, cells: zone.offsets() };
    match layer.shape {
        Shape::Cells(values) => LayerJson { shape: "cells", values, ..plain },
        Shape::Sides(values) => LayerJson { shape: "sides", values, ..plain },
        Shape::CellsOfEach(values) => LayerJson { shape: "cells", each: true, values, ..plain },
        Shape::SidesOfEach(values) => LayerJson { shape: "sides", each: true, values, ..plain },
        Shape::Links(joins, zones) => LayerJson {
            shape: "links",
            zones: zones.iter().map(reach).collect(),
            joins: Some(joins),
            ..plain
        },
        Shape::Circle(radius) => LayerJson { shape: "circle", radius: Some(radius), ..plain },
        Shape::Marks(values) => LayerJson { shape: "marks", values, ..plain },
        Shape::Messages(kinds) => LayerJson { shape: "messages", kinds, ..plain },
        Shape::Reports => LayerJson { shape: "reports", ..plain },
    }
}

/// A page up to where its lines begin.
pub fn head(title: &str) -> String {
    let (head, _) = halves();
    HTML_HEAD.to_owned() + &head.replace("{{title}}", &escaped(title))
}

/// A page from the end of its lines on.
pub fn foot(film: &Film) -> String {
    let (_, foot) = halves();
    foot.replace("{{film}}", &json(film)).replace("{{script}}\n", SCRIPT)
}

/// A whole page of what is no run of the program: a title, a sentence, what to know, and parts that are drawn with
/// letters, which the page goes through one by one.
pub fn in_words(title: &str, sentence: &str, words: &str, parts: &[String]) -> String {
    let (style, _) = TEMPLATE.split_once("</head>").unwrap_or_default();
    let title = escaped(title);
    let part = |part: &String| {
        let kind = if part.contains('\n') { " class=\"drawing\"" } else { "" };
        let lines: Vec<String> = part.lines().map(escaped).collect();
        format!("<pre{kind}>{}</pre>", lines.join("\n"))
    };
    let words: Vec<String> = words.lines().map(|line| format!("<p>{}</p>", escaped(line.trim()))).collect();
    let body = TOLD.replace("{{title}}", &title).replace("{{sentence}}", &escaped(sentence));
    let body = body.replace("{{words}}", &words.join("\n"));
    let parts: Vec<String> = parts.iter().map(part).collect();
    HTML_HEAD.to_owned() + &style.replace("{{title}}", &title) + &body.replace("{{parts}}", &parts.join("\n"))
}

/// The style and the script that the pages of all runs have in common.
pub fn shared() -> [&'static str; 2] {
    let style = TEMPLATE.split_once("<style>\n").and_then(|(_, rest)| rest.split_once("</style>"));
    [style.map_or("", |(style, _)| style), SCRIPT]
}

/// The page with `{{style}}` and `{{script}}` in place of what all pages have in common.
pub fn without_shared(page: &str) -> String {
    let [style, script] = shared();
    page.replacen(style, "{{style}}", 1).replacen(script, "{{script}}", 1)
}

fn halves() -> (&'static str, &'static str) {
    TEMPLATE.split_once("{{lines}}\n").unwrap_or((TEMPLATE, ""))
}

/// The data of a team move beside its words.
#[derive(Serialize)]
pub struct Told<'a> {
    /// The clauses that it breaks, with lines about how.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub broken: Vec<(&'static str, Vec<String>)>,
    /// The words for what the steps cannot show.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub title: &'a str,
    /// Whether it comes again and again.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub again: bool,
}

/// The data at the end of a line, beside its words.
pub fn told(told: &impl Serialize) -> String {
    format!("\t{}", json(told))
}

/// JSON that can stand in a script: nothing in it ends one.
pub fn json(value: &impl Serialize) -> String {
    // Strings and numbers are always JSON.
    serde_json::to_string(value).unwrap_or_default().replace('<', "\\u003c")
}

/// Layouts of more cells are not printed on a page.
const MOST_PRINTED: usize = 64 * 64;

/// The outcome of a run, in a sentence.
pub(super) fn outcome(scheme: Scheme, report: &Report) -> String {
    let explored = match report.cells {
        0 => String::new(),
        cells => format!(" {} of {} explored;", report.explored, counted(cells, "cell")),
    };
    let broken = report.violations.first().map_or_else(
        || scheme.unbroken().to_owned(),
        |first| format!("{} is broken in team move {}", first.clause, first.step),
    );
    format!("{}: {}.{explored} {broken}.", counted(report.steps, "team move"), report.stop_words())
}

/// The notes beside violations: the milestones and the end.
pub(super) fn notes(report: &Report) -> Vec<(u32, String)> {
    let reached = |milestone: Milestone| {
        let step = report.reached(milestone)?;
        Some((step, format!("{} % of the cells are explored", milestone.percent())))
    };
    let end = (report.steps, format!("The end: {}", report.stop_words()));
    Milestone::ALL.into_iter().filter_map(reached).chain([end]).collect()
}

/// How to make the run again, and others; its layout is that of a generator, if one is named.
pub(super) fn again(setup: &Setup, generator: Option<&Generator>) -> Again {
    let Setup { scheme, rule, robots, seed, base, starts, miss, missed, options, choices, limits, .. } =
        setup;
    let is_small = setup.layout.size().area().cells().nth(MOST_PRINTED).is_none();
    let layout = is_small.then(|| {
        let mut layout = setup.layout.clone();
        // Without a base where none can stand, the drawing is as good.
        let _ = layout.place_base(*base);
        layout.to_string()
    });
    let by_search = Again { command: None, layout };
    if !scheme.is_known() || !choices.is_empty() || !missed.is_empty() {
        return by_search;
    }
    let mut command = vec![
        generator.map_or_else(|| "tautline explore LAYOUT".to_owned(), |of| format!("tautline explore {of}")),
        format!("scheme {}", scheme.name),
        format!("rule {rule}"),
        format!("robots {robots}"),
    ];
    match (scheme.starts, starts) {
        (Starts::Base, _) | (_, None) => command.push(format!("base {},{}", base.x, base.y)),
        (Starts::Anywhere | Starts::Beside | Starts::Alone, Some(starts)) => {
            command.extend(starts.iter().map(|start| format!("start {},{}", start.x, start.y)));
        }
    }
    let extra = |extra: &Extra| {
        let (field, word) = (extra.field, (extra.typed)(options)?);
        Some(if extra.takes == Takes::Nothing { field.to_owned() } else { format!("{field} {word}") })
    };
    command.extend((!miss.is_never()).then(|| format!("miss {miss}")));
    command.extend(Extra::ALL.into_iter().filter_map(extra));
    command.extend(limits.until.map(|milestone| format!("until {}", milestone.percent())));
    command.extend(limits.max_moves.map(|most| format!("max-moves {most}")));
    let is_by_seed = scheme.draws(setup) || generator.is_some_and(Generator::is_random);
    command.extend(is_by_seed.then(|| format!("seed {seed}")));
    command.push("html run.html".to_owned());
    Again { command: Some(command.join(" --")), ..by_search }
}

/// The number of a cell, row by row.
pub fn place_of(area: Area, cell: Cell) -> Option<u32> {
    area.place(cell).map(|place| place as u32)
}
