//! A page that plays a run: one file without anything from elsewhere, drawn on a canvas from data. Of each team move it
//! holds what changes, so that long runs stay small; it is written as the run goes on. What a scheme shows beside its
//! robots comes from its [`Layer`]s: the page knows no scheme.

pub mod film;
pub mod line;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::RangeInclusive;

use tautline_kernel::ground::Cell;
use tautline_proofs::plural::counted;

pub use self::film::in_words;
use self::film::{Again, Board, Ended, Film, Share};
use self::line::Line;
use super::story;
use crate::atomic_file::AtomicFile;
use crate::diagnostic::Diagnostic;
use crate::explore::{Layer, Look, Milestone, Play, Report, Scene, Setup, Starts, TeamMove};
use crate::options::{Extra, Takes};

/// Bytes of a page. Larger ones take a browser too long.
const MAX_BYTES: usize = 10_000_000;

/// Layouts of more cells are not printed on a page.
const MOST_PRINTED: usize = 64 * 64;

/// A page in the making. One that grows too large is left out.
#[derive(Debug)]
pub struct Page<'a> {
    file: &'a mut AtomicFile,
    run: &'a dyn Play,
    report: &'a Report,
    moves: RangeInclusive<u32>,
    bytes: usize,
    layers: Vec<Layer>,
    line: Line,
    /// Where the robots were before the first of the team moves, once that is known.
    start: Option<Vec<Cell>>,
    /// What is broken in the last of the team moves so far.
    broken: Vec<&'static str>,
    /// By clause, what it says.
    clauses: BTreeMap<&'static str, &'static str>,
}

impl<'a> Page<'a> {
    /// The page in `file` that plays these team moves of a run that came out as `report`. All team moves up to the last
    /// one are to be added.
    pub fn new(
        file: &'a mut AtomicFile,
        run: &'a dyn Play,
        report: &'a Report,
        moves: &RangeInclusive<u32>,
    ) -> Self {
        let mut page = Self {
            file,
            run,
            report,
            moves: moves.clone(),
            bytes: 0,
            layers: Vec::new(),
            line: Line::new(report.chart.area()),
            start: None,
            broken: Vec::new(),
            clauses: BTreeMap::new(),
        };
        page.put(&film::head(&super::title_of(run)));
        page
    }

    fn put(&mut self, text: &str) {
        self.bytes += text.len();
        if self.bytes > MAX_BYTES {
            self.file.leave_out(too_large(
                self.file.path(),
                "store a trace, and give `tautline replay` fewer `moves` to show",
            ));
        } else {
            self.file.append(text);
        }
    }

    /// The number of the team move before the first.
    fn first(&self) -> u32 {
        self.moves.start().saturating_sub(1)
    }

    /// Adds a team move; those before the first are shown as what the team knows by then.
    pub fn add(&mut self, made: &TeamMove<'_>) {
        if self.line.is_new() {
            self.layers = made.team.layers();
        }
        let mut scene = Scene::default();
        made.team.show(made.before, &mut scene);
        if made.step <= self.first() {
            self.line.take(made, &scene);
            return;
        }
        self.begin(made.before);
        let mut text = self.line.of(self.run.setup().scheme.look, made, &scene);
        self.broken = made.broken.iter().map(|clause| clause.as_str()).collect();
        if !made.broken.is_empty() {
            let told: Vec<(&str, Vec<String>)> = made
                .broken
                .iter()
                .map(|&clause| (clause.as_str(), self.run.told(clause, &self.report.chart, made)))
                .collect();
            for &clause in made.broken {
                self.clauses.insert(clause.as_str(), story::sentence(clause).unwrap_or_default());
            }
            text += &film::told(&BTreeMap::from([("broken", told)]));
        }
        self.put(&(text + "\n"));
    }

    /// Writes what there was before the first team move, once.
    fn begin(&mut self, cells: &[Cell]) {
        if self.start.is_none() {
            self.start = Some(cells.to_vec());
            let text = self.line.before(&self.report.chart, self.first());
            self.put(&(text + "\n"));
        }
    }

    /// Adds what comes after the team moves.
    pub fn finish(mut self) {
        let team = self.report.team.clone();
        self.begin(&team);
        let text = film::foot(&self.film());
        self.put(&text);
    }

    fn film(&mut self) -> Film {
        let (setup, report) = (self.run.setup(), self.report);
        let scheme = setup.scheme;
        let area = report.chart.area();
        let start = self.start.take().unwrap_or_default();
        let ends = self.ends();
        Film {
            title: super::title_of(self.run),
            outcome: outcome(report),
            unit: "team move",
            robot: scheme.look.robot(),
            robots: start.len(),
            has_base: scheme.look.has_base(),
            has_leader: matches!(scheme.look, Look::Linked { .. }),
            first: self.first(),
            of: report.steps,
            share: Share { of: report.cells, what: "cells explored" },
            board: Board::cells(&setup.layout, area, &start, scheme.knowledge.is_some()),
            layers: self.layers.iter().map(film::layer).collect(),
            clauses: self.clauses.iter().map(|(&id, &says)| (id, says)).collect(),
            ends,
            notes: notes(report),
            again: again(setup),
        }
    }

    /// What the end of the run breaks, if the end is shown.
    fn ends(&mut self) -> Vec<Ended> {
        let report = self.report;
        if !self.moves.contains(&report.steps) && report.steps > 0 {
            return Vec::new();
        }
        let mut left = self.broken.clone();
        let mut ends = Vec::new();
        for violation in report.violations.iter().filter(|broken| broken.step == report.steps) {
            let clause = violation.clause;
            if let Some(place) = left.iter().position(|&id| id == clause.as_str()) {
                left.remove(place);
                continue;
            }
            self.clauses.insert(clause.as_str(), story::sentence(clause).unwrap_or_default());
            let (what, cells) = self.run.missed(clause, &report.chart).unwrap_or(("", Vec::new()));
            let cells = cells.iter().filter_map(|&cell| line::place_of(report.chart.area(), cell)).collect();
            ends.push(Ended { clause: clause.as_str(), what, cells });
        }
        ends
    }
}

/// The fault of a page that is too large.
pub fn too_large(path: &std::path::Path, remedy: &str) -> Diagnostic {
    let what = format!("a page of more than {} MB is left out", MAX_BYTES / 1_000_000);
    Diagnostic::in_file(path, what, remedy)
}

/// Whether a page of so many bytes is too large.
pub const fn is_too_large(bytes: usize) -> bool {
    bytes > MAX_BYTES
}

fn outcome(report: &Report) -> String {
    format!(
        "{}: {}. {} of {} explored; {}.",
        counted(report.steps, "team move"),
        report.stopped.words(),
        report.explored,
        counted(report.cells, "cell"),
        broken(report)
    )
}

fn broken(report: &Report) -> String {
    match report.violations.as_slice() {
        [] => "no clause is broken".to_owned(),
        [first, ..] => format!("{} is broken in team move {}", first.clause, first.step),
    }
}

/// What is told beside violations: the milestones and the end.
fn notes(report: &Report) -> Vec<(u32, String)> {
    let reached = |milestone: Milestone| {
        let step = report.reached(milestone)?;
        Some((step, format!("{} % of the cells are explored", milestone.percent())))
    };
    let end = (report.steps, format!("The end: {}", report.stopped.words()));
    Milestone::ALL.into_iter().filter_map(reached).chain([end]).collect()
}

/// How to make the run again, and others.
fn again(setup: &Setup) -> Again {
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
    let name = scheme.name;
    let mut command = format!("tautline explore LAYOUT --scheme {name} --rule {rule} --robots {robots}");
    // Writing to a string cannot fail.
    match (scheme.starts, starts) {
        (Starts::Base, _) | (_, None) => {
            let _ = write!(command, " --base {},{}", base.x, base.y);
        }
        (Starts::Anywhere | Starts::Beside | Starts::Alone, Some(starts)) => {
            for start in starts {
                let _ = write!(command, " --start {},{}", start.x, start.y);
            }
        }
    }
    if !miss.is_never() {
        let _ = write!(command, " --miss {miss}");
    }
    for extra in Extra::ALL {
        let _ = match ((extra.typed)(options), extra.takes) {
            (None, _) => Ok(()),
            (Some(_), Takes::Nothing) => write!(command, " --{}", extra.field),
            (Some(word), Takes::Word(_) | Takes::Real(_)) => write!(command, " --{} {word}", extra.field),
        };
    }
    if let Some(milestone) = limits.until {
        let _ = write!(command, " --until {}", milestone.percent());
    }
    if let Some(most) = limits.max_moves {
        let _ = write!(command, " --max-moves {most}");
    }
    if scheme.draws(setup) {
        let _ = write!(command, " --seed {seed}");
    }
    Again { command: Some(command + " --replay run.html"), ..by_search }
}
