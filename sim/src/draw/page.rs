//! A page that plays a run: one file without anything from elsewhere, stepped by buttons, slider and keys, in light and
//! dark. The pictures are those of [`svg`]; the page draws one team move at a time. Of the cells it holds only what changes
//! from move to move, and nothing that is not shown; it is written as the run goes on.

use std::fmt::Write;
use std::ops::RangeInclusive;

use tautline_kernel::chain::Kind;
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Step};
use tautline_proofs::run::Frame as Outcome;
use tautline_proofs::words::counted;

use super::svg::{self, Frame};
use crate::aside::{Aside, HTML_HEAD};
use crate::explore::{Look, Play, Report, Stage, Survey, TeamMove};
use crate::fault::Fault;

/// Bytes of a page. What is larger no browser shows.
const MAX_BYTES: usize = 64 << 20;

const TEMPLATE: &str = include_str!("page.html");

/// A page in the making. One that grows too large is left out.
#[derive(Debug)]
pub struct Page<'a> {
    file: &'a mut Aside,
    stage: Stage<'a>,
    report: &'a Report,
    /// How many bytes it has.
    bytes: usize,
    /// What comes after the team moves.
    foot: String,
    is_begun: bool,
}

impl<'a> Page<'a> {
    /// The page in `file` that plays these team moves of a run that came out as `report`.
    pub fn new(
        file: &'a mut Aside,
        run: &'a dyn Play,
        report: &'a Report,
        moves: &RangeInclusive<u32>,
    ) -> Self {
        let outcome = format!(
            "{}: {}. {} of {} explored; {}.",
            counted(report.steps, "team move"),
            report.stopped.words(),
            report.explored,
            counted(report.cells, "cell"),
            broken(report)
        );
        let title = super::title_of(run);
        let [head, middle, foot] = parts(svg::STYLE, ["team move", "Team moves"], &title, &outcome);
        let area = report.chart.area();
        let stage = run.stage();
        let mut page = Self { file, stage, report, bytes: 0, foot, is_begun: false };
        page.put(&(head + &svg::open(area) + &svg::blocked(stage.layout, area)));
        page.put(&marked(&report.chart, moves));
        page.put(&(svg::lines(area) + &svg::walls(stage.layout, area) + TEAM + "</g></svg>" + &middle));
        page
    }

    fn put(&mut self, text: &str) {
        self.bytes += text.len();
        if self.bytes > MAX_BYTES {
            let what = format!("a page of more than {} MiB is left out", MAX_BYTES >> 20);
            let remedy = "store a trace, and give `tautline replay` fewer `moves` to show";
            self.file.leave_out(Fault::in_file(self.file.path(), what, remedy));
        } else {
            self.file.append(text);
        }
    }

    /// Adds a team move; before the first one, where the robots were.
    pub fn add(&mut self, made: &TeamMove<'_>) {
        if !self.is_begun {
            self.is_begun = true;
            let robots = made.before.len();
            let start = Outcome {
                kind: Kind::Advance,
                steps: vec![Step::Stay; robots],
                blocked: vec![false; robots],
                cells: made.before.to_vec(),
            };
            let step = made.step - 1;
            let start = TeamMove { step, before: made.before, frame: &start, unseen: &[], broken: &[] };
            let words = if step == 0 { started(&self.stage) } else { format!("After team move {step}") };
            self.push(&start, &words);
        }
        self.push(made, &words(self.stage.look, made, self.report));
    }

    fn push(&mut self, made: &TeamMove<'_>, words: &str) {
        let team = svg::team(self.stage.look, Frame(self.report.chart.area()), made);
        self.put(&moved(made.step, words, &team));
    }

    /// Adds what comes after the team moves.
    pub fn finish(mut self) {
        let foot = std::mem::take(&mut self.foot);
        self.put(&foot);
    }
}

/// Where a picture shows one step after the other.
pub(super) const TEAM: &str = "<g id=\"team\"></g>";

/// A step of a page, in one line, as it is drawn in [`TEAM`].
pub(super) fn moved(step: u32, words: &str, drawn: &str) -> String {
    format!("<g class=\"move\" data-step=\"{step}\"><title>{words}</title>{drawn}</g>\n")
}

/// A page in three parts. The first ends where its picture begins, which holds [`TEAM`] and parts of the class `cell`, in the
/// order of their steps, which it shows from their step on. The second ends where the steps stand, which [`moved`] makes.
/// `steps` are the words for one step, and for many.
pub(super) fn parts(style: &str, steps: [&str; 2], title: &str, outcome: &str) -> [String; 3] {
    let [step, steps] = steps;
    let filled = |part: &str| {
        part.replace("{{style}}", style)
            .replace("{{step}}", step)
            .replace("{{steps}}", steps)
            .replace("{{title}}", title)
            .replace("{{outcome}}", outcome)
    };
    let (head, rest) = TEMPLATE.split_once("{{picture}}").unwrap_or((TEMPLATE, ""));
    let (middle, foot) = rest.split_once("{{moves}}\n").unwrap_or((rest, ""));
    [HTML_HEAD.to_owned() + &filled(head), filled(middle), filled(foot)]
}

/// The cells as they are before the first of `moves`, and what becomes of them in these.
fn marked(chart: &Survey, moves: &RangeInclusive<u32>) -> String {
    let frame = Frame(chart.area());
    let before = moves.start().saturating_sub(1);
    let mut text = String::new();
    for mark in [Mark::Explored, Mark::Closing, Mark::Visited, Mark::Sealed] {
        let cells = chart.area().cells().filter(|&cell| chart.mark(cell, before) == mark);
        let path = svg::stripes(frame, cells);
        if let (Some(class), false) = (svg::class(mark), path.is_empty()) {
            // Writing to a string cannot fail.
            let _ = write!(text, "<path class=\"{class}\" d=\"{path}\"/>");
        }
    }
    let explored = chart.area().cells().filter_map(|cell| Some((cell, chart.step(cell)?, Mark::Explored)));
    let mut changes: Vec<(u32, Mark, Cell)> = explored
        .chain(chart.marks())
        .filter(|&(_, step, _)| step > before && step <= *moves.end())
        .map(|(cell, step, mark)| (step, mark, cell))
        .collect();
    changes.sort_unstable_by_key(|&(step, mark, cell)| (step, mark as u8, cell));
    for alike in changes.chunk_by(|one, other| (one.0, one.1) == (other.0, other.1)) {
        let (step, mark, _) = alike[0];
        if let Some(class) = svg::class(mark) {
            let path = svg::stripes(frame, alike.iter().map(|&(_, _, cell)| cell));
            let _ = write!(text, "<path class=\"cell {class}\" data-step=\"{step}\" d=\"{path}\"/>");
        }
    }
    text
}

/// Who stands where before the first team move.
fn started(stage: &Stage<'_>) -> String {
    let robot = stage.look.robot();
    if stage.look.has_base() {
        format!("The start: the base, with {} in its cell", counted(stage.robots - 1, robot))
    } else {
        format!("The start: {}", counted(stage.robots, robot))
    }
}

fn broken(report: &Report) -> String {
    match report.violations.as_slice() {
        [] => "no clause is broken".to_owned(),
        [first, ..] => format!("{} is broken in team move {}", first.clause, first.step),
    }
}

fn words(look: Look, made: &TeamMove<'_>, report: &Report) -> String {
    let kind = match (look, made.frame.kind) {
        (Look::Linked { .. }, Kind::Advance) => ", an advance",
        (Look::Linked { .. }, Kind::Backtrack) => ", a backtrack",
        (Look::Tree { .. } | Look::Apart | Look::Robots, Kind::Advance | Kind::Backtrack) => "",
    };
    let mut words = format!("Team move {} of {}{kind}", made.step, report.steps);
    let blocked = (1..).zip(&made.frame.blocked).filter(|&(_, &blocked)| blocked);
    for (robot, _) in blocked {
        let _ = write!(words, "; R{robot} meets a wall");
    }
    for clause in made.broken {
        let _ = write!(words, "; breaks {clause}");
    }
    words
}
