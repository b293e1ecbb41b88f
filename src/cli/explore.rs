//! `tautline explore`: one run.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::num::NonZeroU32;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde::Serialize;
use tautline_kernel::chain::MAX_ROBOTS;
use tautline_kernel::lattice::Cell;

use super::output::{Output, store};
use super::{CellArg, Exit, Format, FormatArgs, LayoutArgs, interrupt, number, positive, progress, usage};
use crate::aside::Aside;
use crate::explore::{
    Limits, Milestone, OnViolation, Report, RuleName, SchemeName, Setup, Stopped, Violation, explore,
};
use crate::fault::{Fault, Halt};
use crate::view::page::Page;
use crate::view::svg::{self, Panel};
use crate::{trace, view};

const EXAMPLES: &str = "\
Examples:
  tautline explore open:15x15 --robots 8 --draw order
  tautline explore walls:15x15:0.1 --seed 7 --rule published --trace run.jsonl --replay run.html
  tautline explore room-32-32-4.map --robots 16 --base 10,12 --format json";

/// Explore a layout once, and check every team move.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Explore {
    #[command(flatten)]
    layout: LayoutArgs,
    /// How the team explores.
    #[arg(long, value_enum, default_value = "chain")]
    scheme: SchemeName,
    /// The scheme as published, or repaired.
    #[arg(long, value_enum, default_value = "repaired")]
    rule: RuleName,
    /// Robots; for the chain the base is one of them. Without it the layout says, or there are 8.
    #[arg(long, value_name = "N", value_parser = number::<u64>)]
    robots: Option<u64>,
    /// Column and row of the base. Without it the layout says, or it is the free cell nearest the centre.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    base: Option<CellArg>,
    /// Stop when a robot has entered so many cells.
    #[arg(long, value_name = "CELLS", value_parser = positive)]
    max_moves: Option<NonZeroU32>,
    /// Stop when so many percent of the free cells in reach are explored.
    #[arg(long, value_enum, value_name = "50|75|100", hide_possible_values = true)]
    until: Option<Milestone>,
    /// Store the run as JSON lines.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Store the run as a page that plays it.
    #[arg(long, value_name = "FILE")]
    replay: Option<PathBuf>,
    /// What to draw. Without it the outcome is drawn, if the area is small.
    #[arg(long, value_enum)]
    draw: Option<Draw>,
    /// Store the drawing as a picture: the order, or with `--draw moves` every team move.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// What is drawn of a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Draw {
    /// In each cell, in which team move it was explored.
    Order,
    /// Every team move.
    Moves,
}

/// Wider areas are drawn only when asked for.
const SMALL_COLUMNS: usize = 33;

/// Robots of a team when nobody says how many: the team of the paper.
const DEFAULT_ROBOTS: u16 = 8;

impl Explore {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let setup = self.setup()?;
        let mut writer =
            self.trace.as_deref().map(|path| trace::Writer::new(path, &setup, None)).transpose()?;
        let bar = progress::spinner("exploring");
        let mut team = vec![setup.base; usize::from(setup.robots)];
        let report = explore(&setup, &mut |made| {
            interrupt::check()?;
            bar.set_message(format!("team move {}", made.step));
            team.clone_from(&made.frame.cells);
            Ok(writer.as_mut().map_or(Ok(()), |writer| writer.add(made))?)
        })?;
        bar.finish_and_clear();
        writer.map_or(Ok(()), |writer| writer.end(&report))?;
        if let Some(path) = &self.replay {
            store_page(path, &setup, &report, &(1..=report.steps))?;
        }
        if let Some(path) = &self.svg {
            let panels = match self.draw {
                Some(Draw::Moves) => panels(&setup, &report, &(1..=report.steps))?,
                Some(Draw::Order) | None => vec![svg::order(&setup, &report.chart)],
            };
            store(Some(path), &view::title_of(&setup), &panels)?;
        }
        match self.format.format {
            Format::Json => out.json(&Summary::new(&setup, &self.layout.layout, &report))?,
            Format::Text => {
                out.text(summary(&setup, &self.layout.layout, &report))?;
                self.draw(&setup, &report, &team, out)?;
            }
        }
        Ok(if report.violations.is_empty() { Exit::Expected } else { Exit::Violation })
    }

    fn setup(&self) -> Result<Setup, Fault> {
        let mut layout = self.layout.load()?;
        let robots = self.robots.unwrap_or_else(|| layout.robots().unwrap_or(DEFAULT_ROBOTS).into());
        let robots = Setup::count_robots(robots, MAX_ROBOTS)?;
        let base = Setup::choose_base(&mut layout, self.base.map(|CellArg(cell)| cell))
            .map_err(|problem| usage(&problem))?;
        let limits = Limits { until: self.until, max_moves: self.max_moves, violation: OnViolation::GoOn };
        Ok(Setup {
            scheme: self.scheme,
            rule: self.rule,
            robots,
            seed: self.layout.seed,
            layout,
            base,
            limits,
        })
    }

    fn draw(&self, setup: &Setup, report: &Report, team: &[Cell], out: &mut Output) -> Result<(), Halt> {
        match self.draw {
            Some(Draw::Order) => out.text(format_args!("\n{}", view::order(setup, &report.chart)))?,
            Some(Draw::Moves) => {
                let mut blocks = Vec::new();
                explore(setup, &mut |made| {
                    interrupt::check()?;
                    blocks.push(view::team_move(setup, &report.chart, made, view::Pose::Before));
                    Ok(())
                })?;
                out.text(format_args!("\n{}\n\n{}", view::LEGEND, view::beside(&blocks)))?;
            }
            None if report.chart.area().width() <= SMALL_COLUMNS => {
                out.text(format_args!("\n{}", view::outcome(setup, &report.chart, team)))?;
            }
            None => {}
        }
        Ok(())
    }
}

/// Team moves that a picture can hold.
const MAX_PANELS: u32 = 200;

/// The team moves in `moves`, one panel each.
pub(super) fn panels(
    setup: &Setup,
    report: &Report,
    moves: &RangeInclusive<u32>,
) -> Result<Vec<Panel>, Halt> {
    let count = (*moves.end()).min(report.steps).saturating_sub(*moves.start());
    if count >= MAX_PANELS {
        let what = format!("a picture of more than {MAX_PANELS} team moves");
        return Err(
            Fault::usage(what, "store a trace, and give `tautline replay` the --moves to draw").into()
        );
    }
    let mut panels = Vec::new();
    explore(setup, &mut |made| {
        interrupt::check()?;
        panels.extend(moves.contains(&made.step).then(|| svg::team_move(setup, &report.chart, made)));
        Ok(())
    })?;
    Ok(panels)
}

/// Stores a page that plays the team moves in `moves`.
pub(super) fn store_page(
    path: &Path,
    setup: &Setup,
    report: &Report,
    moves: &RangeInclusive<u32>,
) -> Result<(), Halt> {
    let mut page = Page::new(setup, report);
    explore(setup, &mut |made| {
        interrupt::check()?;
        Ok(if moves.contains(&made.step) { page.add(made) } else { Ok(()) }?)
    })?;
    Ok(Aside::write(path, page.finish())?)
}

/// What came of a run, in a few lines.
pub(super) fn summary(setup: &Setup, layout: &str, report: &Report) -> String {
    let Setup { scheme, rule, robots, base, .. } = setup;
    let percent = report.explored * 100 / report.cells;
    let mut text = format!(
        "{} ({rule}), {robots} robots, base {base}: {layout}\n{} team moves: {}\n{} of {} cells explored ({percent} %)",
        scheme.word(),
        report.steps,
        report.stopped.words(),
        report.explored,
        report.cells,
    );
    for milestone in Milestone::ALL {
        // Writing to a string cannot fail.
        let _ = match report.reached(milestone) {
            Some(step) => write!(text, ", {} % at team move {step}", milestone.percent()),
            None => write!(text, ", {} % never", milestone.percent()),
        };
    }
    text.push('\n');
    text + &violations(report)
}

/// Violations that are listed; the others are counted.
const LISTED: usize = 10;

fn violations(report: &Report) -> String {
    let mut text = String::new();
    for violation in report.violations.iter().take(LISTED) {
        let clause = violation.breach.clause();
        let _ = writeln!(
            text,
            "{clause} is broken in team move {}: {}",
            violation.step,
            view::story::sentence(clause)
        );
    }
    match report.violations.len() {
        0 => text.push_str("no clause is broken\n"),
        1..=LISTED => {}
        more => {
            let _ = writeln!(text, "and {} more", more - LISTED);
        }
    }
    text
}

/// The JSON of a run.
#[derive(Serialize)]
pub(super) struct Summary<'a> {
    scheme: SchemeName,
    rule: RuleName,
    robots: u16,
    seed: u64,
    layout: &'a str,
    base: Cell,
    steps: u32,
    explored: u32,
    cells: u32,
    milestones: BTreeMap<u32, Option<u32>>,
    stopped: Stopped,
    violations: Vec<trace::StoredViolation>,
}

impl<'a> Summary<'a> {
    pub(super) fn new(setup: &Setup, layout: &'a str, report: &Report) -> Self {
        let milestones = Milestone::ALL.map(|milestone| (milestone.percent(), report.reached(milestone)));
        Self {
            scheme: setup.scheme,
            rule: setup.rule,
            robots: setup.robots,
            seed: setup.seed,
            layout,
            base: setup.base,
            steps: report.steps,
            explored: report.explored,
            cells: report.cells,
            milestones: milestones.into(),
            stopped: report.stopped,
            violations: report.violations.iter().map(|violation: &Violation| violation.into()).collect(),
        }
    }
}
