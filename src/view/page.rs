//! A page that plays a run: one file without anything from elsewhere, stepped by buttons, slider and keys, in light and
//! dark. The pictures are those of [`svg`]; the page only shows one team move at a time.

use std::fmt::Write;

use tautline_kernel::chain::Kind;
use tautline_kernel::floor::Mark;
use tautline_kernel::lattice::Step;
use tautline_proofs::run::Frame as Outcome;
use tautline_proofs::words::counted;

use super::svg::{self, Frame};
use crate::explore::{Chart, Crew, Report, Setup, TeamMove};
use crate::fault::Fault;

/// Robots that a page can draw, over all its team moves.
const MAX_DRAWN: usize = 100_000;

const TEMPLATE: &str = include_str!("page.html");

/// A page in the making.
#[derive(Debug)]
pub struct Page<'a> {
    setup: &'a Setup,
    report: &'a Report,
    moves: String,
    drawn: usize,
}

impl<'a> Page<'a> {
    /// The page of a run that came out as `report`.
    pub fn new(setup: &'a Setup, report: &'a Report) -> Self {
        Self { setup, report, moves: String::new(), drawn: 0 }
    }

    /// Adds a team move; before the first one, where the robots were.
    ///
    /// # Errors
    /// A [`Fault`] if the page grows too large.
    pub fn add(&mut self, made: &TeamMove<'_>) -> Result<(), Fault> {
        let chart = &self.report.chart;
        let frame = Frame(chart.area());
        if self.moves.is_empty() {
            let robots = made.before.len();
            let start = Outcome {
                kind: Kind::Advance,
                steps: vec![Step::Stay; robots],
                blocked: vec![false; robots],
                cells: made.before.to_vec(),
            };
            let step = made.step - 1;
            let start = TeamMove { step, before: made.before, frame: &start, unseen: &[], breaches: &[] };
            let words = if step == 0 { started(self.setup) } else { format!("After team move {step}") };
            self.push(frame, &start, &words);
        }
        self.push(frame, made, &words(self.setup.crew(), made, self.report));
        self.drawn += made.before.len();
        if self.drawn > MAX_DRAWN {
            let what = format!("a page of more than {MAX_DRAWN} robots in all its team moves");
            return Err(Fault::usage(what, "store a trace, and give `tautline replay` the --moves to show"));
        }
        Ok(())
    }

    fn push(&mut self, frame: Frame, made: &TeamMove<'_>, words: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            self.moves,
            "<g class=\"move\" data-step=\"{}\" hidden><title>{words}</title>{}</g>",
            made.step,
            svg::team(self.setup.crew(), frame, made)
        );
    }

    /// The whole page.
    pub fn finish(self) -> String {
        let Self { setup, report, moves, drawn: _ } = self;
        let area = report.chart.area();
        let picture = svg::open(area)
            + &svg::ground(&setup.layout, area)
            + &marked(&report.chart)
            + &svg::walls(&setup.layout, area)
            + &moves
            + "</g></svg>";
        let title = super::title_of(setup);
        let outcome = format!(
            "{}: {}. {} of {} explored; {}.",
            counted(report.steps, "team move"),
            report.stopped.words(),
            report.explored,
            counted(report.cells, "cell"),
            broken(report)
        );
        filled(svg::STYLE, ["team move", "Team moves"], &title, &outcome, &picture)
    }
}

/// A page of a picture with a group of the class `move` for each step, of which it shows one at a time, and groups of the
/// class `cell`, which it shows from their step on. `steps` are the words for one step, and for many.
pub(super) fn filled(style: &str, steps: [&str; 2], title: &str, outcome: &str, picture: &str) -> String {
    let [step, steps] = steps;
    TEMPLATE
        .replace("{{style}}", style)
        .replace("{{step}}", step)
        .replace("{{steps}}", steps)
        .replace("{{title}}", title)
        .replace("{{outcome}}", outcome)
        .replace("{{picture}}", picture)
}

/// The cells as they are from a team move on, each mark over the one before it.
fn marked(chart: &Chart) -> String {
    let frame = Frame(chart.area());
    let cells = chart.area().cells();
    let explored = cells.filter_map(|cell| chart.step(cell).map(|step| (cell, step, Mark::Explored)));
    explored.chain(chart.marks()).fold(String::new(), |mut text, (cell, step, mark)| {
        let drawn = svg::marked_cell(frame, cell, mark);
        let _ = write!(text, "<g class=\"cell\" data-step=\"{step}\">{drawn}</g>");
        text
    })
}

/// Who stands where before the first team move.
fn started(setup: &Setup) -> String {
    match setup.crew() {
        Crew::Chain => {
            format!("The start: the base, with {} in its cell", counted(setup.robots - 1, "robot"))
        }
        Crew::Agents(_) => format!("The start: {}", counted(setup.robots, "agent")),
    }
}

fn broken(report: &Report) -> String {
    match report.violations.as_slice() {
        [] => "no clause is broken".to_owned(),
        [first, ..] => format!("{} is broken in team move {}", first.breach.clause(), first.step),
    }
}

fn words(crew: Crew, made: &TeamMove<'_>, report: &Report) -> String {
    let kind = match (crew, made.frame.kind) {
        (Crew::Chain, Kind::Advance) => ", an advance",
        (Crew::Chain, Kind::Backtrack) => ", a backtrack",
        (Crew::Agents(_), Kind::Advance | Kind::Backtrack) => "",
    };
    let mut words = format!("Team move {} of {}{kind}", made.step, report.steps);
    let blocked = (1..).zip(&made.frame.blocked).filter(|&(_, &blocked)| blocked);
    for (robot, _) in blocked {
        let _ = write!(words, "; R{robot} meets a wall");
    }
    for breach in made.breaches {
        let _ = write!(words, "; breaks {}", breach.clause());
    }
    words
}
