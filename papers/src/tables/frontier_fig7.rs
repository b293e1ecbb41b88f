//! Frontier cells (Rajesh, Nagaraja and Suja 2024, 6, Fig. 7) on random layouts: how many team moves one robot and
//! several take to explore every cell, by every rule and rival.
//!
//! The text has no number of Fig. 7, so that only its sentences can be judged. The area is that of Fig. 3, 6×7 cells.
//! Blocked cells are drawn at random, so that the free ones are connected; so are the starts, each robot in a cell of
//! its own.

use std::fmt::Write;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;

use super::parameter::{Parameter, put, shown};
use super::{About, Chart, Observer, Table, point, unfit};
use crate::chart::{Axis, LineChart, Series, Stroke};
use tautline_field::stats::Estimate;
use tautline_sim::diagnostic::{Diagnostic, Halt};
use tautline_sim::explore::frontier::{ALONE, FRONTIER};
use tautline_sim::explore::{Limits, Milestone, RuleId, Setup, explore};
use tautline_sim::layout::{Layout, generate};
use tautline_sim::text_table::{Column, TextTable, Width};
use tautline_sim::value_parser::{number, within};

/// Team sizes that the paper compares.
pub const TEAMS: [u16; 5] = [1, 2, 4, 6, 8];

/// The most cells that robots enter in a run.
const MOST_MOVES: u32 = 5000;

/// Frontier cells on random layouts.
#[derive(Clone, Copy, Debug)]
pub struct FrontierFig7;

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Layouts.
    pub layouts: u32,
    /// The seed of the first one.
    pub seed: u64,
    /// TextTable.
    pub columns: u16,
    /// Rows.
    pub rows: u16,
    /// Blocked cells of each.
    pub blocked: u16,
}

impl Default for Settings {
    fn default() -> Self {
        Self { layouts: 1000, seed: 0, columns: 6, rows: 7, blocked: 4 }
    }
}

/// One layout, for every team.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    seed: u64,
}

/// What came of one run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    /// Team moves until every cell is explored, if all are.
    moves: Option<u32>,
    /// Explored cells, in thousandths.
    explored: u32,
    /// Whether two robots were in one cell.
    is_double: bool,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    #[serde(flatten)]
    settings: Settings,
    /// Rule by rule, each for all teams.
    pub lines: Vec<Line>,
    /// What the paper says, and what comes out.
    pub judged: Vec<Judged>,
}

/// A team of a rule.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The rule.
    pub rule: RuleId,
    /// Robots.
    pub robots: u16,
    /// Team moves until every cell is explored, over the runs that explore all.
    pub moves: Option<Estimate>,
    /// Team moves more than the repaired rule takes on the same layout, over the layouts of which both explore every
    /// cell.
    pub behind: Option<Estimate>,
    /// Runs that explore every cell, in percent.
    pub whole: Option<Estimate>,
    /// Explored cells, in percent.
    pub explored: Option<Estimate>,
    /// Runs in which two robots were in one cell, in percent.
    pub double: Option<Estimate>,
}

/// A sentence of the paper.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Judged {
    /// What it says.
    pub sentence: &'static str,
    /// What comes out.
    pub outcome: String,
}

impl Table for FrontierFig7 {
    type Settings = Settings;
    type Job = Job;
    type Measured = Vec<Outcome>;
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "frontier-fig7",
            shows: "frontier cells: how many team moves 1 to 8 robots take to explore every cell, by every rule and rival",
            help: "How many team moves robots take that go from frontier cell to frontier cell",
            more: "",
            examples: &[
                "frontier-fig7 --svg moves.svg",
                "frontier-fig7 --blocked 12 --layouts 100 --format json",
            ],
            doing: "exploring",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        vec![
            Parameter::one(
                "layouts",
                "COUNT",
                "Random layouts",
                |all| shown(&all.layouts),
                |all, texts| put(&mut all.layouts, texts, |text| within(text, &(1..=100_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of the first layout and its runs; the others have the seeds after it",
                |all| shown(&all.seed),
                |all, texts| put(&mut all.seed, texts, number),
            ),
            Parameter::one(
                "columns",
                "COLUMNS",
                "TextTable of each layout",
                |all| shown(&all.columns),
                |all, texts| put(&mut all.columns, texts, |text| within(text, &(1..=32_i64))),
            ),
            Parameter::one(
                "rows",
                "ROWS",
                "Rows of each layout",
                |all| shown(&all.rows),
                |all, texts| put(&mut all.rows, texts, |text| within(text, &(1..=32_i64))),
            ),
            Parameter::one(
                "blocked",
                "CELLS",
                "Blocked cells of each layout",
                |all| shown(&all.blocked),
                |all, texts| put(&mut all.blocked, texts, |text| within(text, &(0..=512_i64))),
            ),
        ]
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        vec![Chart {
            name: "svg",
            about: "Store a chart of the team moves",
            draw: |_, _, merged| Ok(chart(&merged.lines).svg()),
        }]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let Settings { layouts, seed, columns, rows, blocked } = *settings;
        let cells = columns * rows;
        let most = TEAMS.into_iter().max().unwrap_or(0);
        if blocked + most > cells {
            let what = format!("{blocked} blocked of {cells} cells leave no room for {most} robots");
            return Err(Diagnostic::usage(what, "give fewer blocked cells, or more columns and rows").into());
        }
        Ok((0..u64::from(layouts)).map(|index| Job { seed: seed.wrapping_add(index) }).collect())
    }

    fn parts(&self, _: &Job) -> u64 {
        (FRONTIER.rules.len() * TEAMS.len()) as u64
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Vec<Outcome>, Halt> {
        let (layout, starts) = drawn(settings, job.seed)?;
        let teams = FRONTIER.rules.iter().flat_map(|rule| TEAMS.map(|robots| (rule.name, robots)));
        teams.map(|(rule, robots)| follow(rule, &layout, &starts[..robots.into()], job.seed)).collect()
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Vec<Outcome>)>) -> Result<Merged, Halt> {
        let teams: Vec<(RuleId, u16)> =
            FRONTIER.rules.iter().flat_map(|rule| TEAMS.map(|robots| (rule.name, robots))).collect();
        let outcomes = |wanted: (RuleId, u16)| -> Vec<Outcome> {
            let place = teams.iter().position(|&team| team == wanted);
            results.iter().filter_map(|(_, outcomes)| outcomes.get(place?).copied()).collect()
        };
        let lines = teams.iter().map(|&(rule, robots)| {
            Line::of(rule, robots, &outcomes((rule, robots)), &outcomes((RuleId::REPAIRED, robots)))
        });
        let lines: Vec<Line> = lines.collect();
        let judged = judged(&lines);
        Ok(Merged { settings: *settings, lines, judged })
    }

    fn text(&self, settings: &Settings, merged: &Merged) -> Result<String, Halt> {
        Ok(text(settings, merged))
    }

    /// A repaired team explores every cell, and never has two robots in one.
    fn is_broken(&self, merged: &Merged) -> bool {
        let repaired = |line: &&Line| line.rule == RuleId::REPAIRED || line.rule.as_str() == "plain";
        merged.lines.iter().filter(repaired).any(|line| {
            line.whole.is_some_and(|whole| whole.mean < 100.0)
                || line.double.is_some_and(|double| double.mean > 0.0)
        })
    }
}

/// A layout whose free cells are connected, and starts in it.
fn drawn(settings: &Settings, seed: u64) -> Result<(Layout, Vec<Cell>), Halt> {
    let Settings { columns, rows, blocked, .. } = *settings;
    let mut dice = generate::source(seed, *b"fig7    ");
    let below =
        |of: usize, dice: &mut ChaCha8Rng| ((u128::from(dice.next_u64()) * of as u128) >> 64) as usize;
    for _ in 0..MOST_DRAWN {
        let mut layout = Layout::open(columns.into(), rows.into()).map_err(|problem| unfit(&problem))?;
        let mut cells: Vec<Cell> = layout.cells().collect();
        for _ in 0..blocked {
            layout.block(cells.swap_remove(below(cells.len(), &mut dice)));
        }
        if layout.reachable(&cells[..1]).len() < cells.len() {
            continue;
        }
        let most = TEAMS.into_iter().max().unwrap_or(0);
        let starts = (0..most).map(|_| cells.swap_remove(below(cells.len(), &mut dice)));
        return Ok((layout, starts.collect()));
    }
    let what = format!("of {MOST_DRAWN} layouts with {blocked} blocked cells none is connected");
    Err(Diagnostic::usage(what, "give fewer blocked cells").into())
}

/// Layouts that are drawn until one is connected.
const MOST_DRAWN: u32 = 100_000;

fn follow(rule: RuleId, layout: &Layout, starts: &[Cell], seed: u64) -> Result<Outcome, Halt> {
    let mut layout = layout.clone();
    let base = starts[0];
    layout.place_base(base).map_err(|problem| unfit(&problem))?;
    let limits = Limits { max_moves: std::num::NonZeroU32::new(MOST_MOVES), ..Limits::default() };
    let setup = Setup::new(&FRONTIER, rule, starts.len() as u16, layout, base);
    let setup = Setup { starts: Some(starts.to_vec()), seed, limits, ..setup };
    let report = explore(&setup, &mut |_| Ok(()))?;
    Ok(Outcome {
        moves: report.reached(Milestone::Whole),
        explored: report.explored * 1000 / report.cells,
        is_double: report.violations.iter().any(|violation| violation.clause == ALONE),
    })
}

impl Line {
    fn of(rule: RuleId, robots: u16, outcomes: &[Outcome], repaired: &[Outcome]) -> Self {
        let values = |values: Vec<f64>| Estimate::of_values(&values);
        let share =
            |hits: usize| Estimate::share(hits as u32, outcomes.len() as u32).map(|share| share.times(100.0));
        let moves = outcomes.iter().filter_map(|outcome| outcome.moves.map(f64::from));
        let more = |(own, other): (&Outcome, &Outcome)| Some(f64::from(own.moves?) - f64::from(other.moves?));
        Self {
            rule,
            robots,
            moves: values(moves.collect()),
            behind: values(outcomes.iter().zip(repaired).filter_map(more).collect()),
            whole: share(outcomes.iter().filter(|outcome| outcome.moves.is_some()).count()),
            explored: values(outcomes.iter().map(|outcome| f64::from(outcome.explored) / 10.0).collect()),
            double: share(outcomes.iter().filter(|outcome| outcome.is_double).count()),
        }
    }
}

/// What the paper says of Fig. 7, judged by what is measured.
fn judged(lines: &[Line]) -> Vec<Judged> {
    let of = |rule: &str, robots: u16| {
        lines.iter().find(|line| line.rule.as_str() == rule && line.robots == robots)
    };
    let moves = |rule: &str, robots| Estimate::text_or_dash(of(rule, robots).and_then(|line| line.moves), 1);
    let percent = |part: fn(&Line) -> Option<Estimate>, rule: &str, robots| {
        Estimate::text_or_dash(of(rule, robots).and_then(part), 1)
    };
    vec![
        Judged {
            sentence: "performs better when team of robots has 8 members",
            outcome: format!(
                "8 is the largest team that is compared. Robots that wander take {} team moves with 6 and {} with 8, repaired \
                 ones {} and {}",
                moves("wanders", 6),
                moves("wanders", 8),
                moves("repaired", 6),
                moves("repaired", 8)
            ),
        },
        Judged {
            sentence: "avoiding … missing out sectors",
            outcome: format!(
                "refuted: one published robot explores {} % of the cells, and all of them in {} % of the runs; repaired {} %",
                percent(|line| line.explored, "published", 1),
                percent(|line| line.whole, "published", 1),
                percent(|line| line.whole, "repaired", 1)
            ),
        },
        Judged {
            sentence: "avoiding overlapping",
            outcome: format!(
                "refuted: of the runs of 8 published robots {} % have two in one cell; repaired {} %",
                percent(|line| line.double, "published", 8),
                percent(|line| line.double, "repaired", 8)
            ),
        },
    ]
}

fn text(settings: &Settings, merged: &Merged) -> String {
    let Settings { layouts, columns, rows, blocked, .. } = settings;
    let widths = TEAMS.map(|_| Column::right(Width::Of(15)));
    let mut table = TextTable::new([Column::left(Width::Of(15))].into_iter().chain(widths));
    let heads =
        TEAMS.map(|robots| if robots == 1 { "1 robot".to_owned() } else { format!("{robots} robots") });
    let mut part = |title: String, of: fn(&Line) -> Option<Estimate>| {
        table.title(title);
        table.row(std::iter::once("rule".to_owned()).chain(heads.clone()));
        for lines in merged.lines.chunks(TEAMS.len()) {
            let name = lines.first().map_or("", |line| line.rule.as_str()).to_owned();
            let values = lines.iter().map(|line| Estimate::text_or_dash(of(line), 1));
            table.row(std::iter::once(name).chain(values));
        }
    };
    part(
        format!(
            "Team moves until every cell is explored: {layouts} layouts of {columns}×{rows} cells, {blocked} blocked"
        ),
        |line| line.moves,
    );
    part(
        "Team moves more than the repaired rule takes on the same layouts, of which both explore every cell"
            .to_owned(),
        |line| line.behind,
    );
    part("Runs that explore every cell, in %; the others are in no mean of team moves".to_owned(), |line| {
        line.whole
    });
    part("Runs in which two robots are in one cell, in %".to_owned(), |line| line.double);
    let mut text = table.text();
    for Judged { sentence, outcome } in &merged.judged {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "“{sentence}”: {outcome}.");
    }
    text
}

/// Team moves over robots, a line for each rule.
fn chart(lines: &[Line]) -> LineChart {
    let series = lines.chunks(TEAMS.len()).filter_map(|lines| {
        let rule = lines.first()?.rule;
        let is_whole = |line: &&Line| line.whole.is_some_and(|whole| whole.mean > 50.0);
        let points =
            lines.iter().filter(is_whole).filter_map(|line| Some(point(line.robots.into(), line.moves?)));
        let stroke = if rule == RuleId::REPAIRED { Stroke::Solid } else { Stroke::Dashed };
        Some(Series { name: rule.to_string(), stroke, points: points.collect() })
    });
    let series: Vec<Series> = series.filter(|series| !series.points.is_empty()).collect();
    LineChart {
        title: "Team moves until every cell is explored".to_owned(),
        x: Axis::new("robots", ""),
        y: Axis::new("team moves", "").showing([0.0, 0.0]),
        series,
    }
}
