//! Frontier cells (Rajesh, Nagaraja and Suja 2024, 6, Fig. 7) on random layouts: how many team moves one robot and
//! several take to explore every cell, by every rule and rival.
//!
//! The text has no number of Fig. 7, so that only its sentences can be judged. The area is that of Fig. 3, 6×7 cells.
//! Blocked cells are drawn at random, so that the free ones are connected; so are the starts, each robot in a cell of
//! its own.

mod claims;
mod death;
mod line;

use std::num::NonZeroU32;

use tautline_kernel::frontier::Rule;
use tautline_kernel::ground::Cell;

use super::prelude::*;
use line::{Line, Outcome};
use tautline_grids::chance::{Dice, Probability};
use tautline_sim::explore::frontier::{ALONE, FRONTIER, ONCE};
use tautline_sim::explore::{ClauseId, Limits, Milestone, Report, RuleId, Setup, explore};
use tautline_sim::options::Options;

/// Team sizes that the paper compares.
pub const TEAMS: [u16; 5] = [1, 2, 4, 6, 8];

/// The rules whose robots explore and tell each other: they run once more without the maps of the others, and once more
/// with a robot that dies.
const TELLING: [(&str, Rule); 4] = [
    ("published", Rule::PUBLISHED),
    ("repaired", Rule::REPAIRED),
    ("plain", Rule::PLAIN),
    ("wanders", Rule::WANDERS),
];

/// Every rule, with every team size.
fn teams(settings: &Settings) -> impl Iterator<Item = (RuleId, u16)> {
    FRONTIER.rules.iter().flat_map(|rule| settings.robots.iter().map(|&robots| (rule.name, robots)))
}

/// The most cells that robots enter in a run.
const MOST_MOVES: u32 = 5000;

/// Frontier cells on random layouts.
#[derive(Clone, Copy, Debug)]
pub struct FrontierFig7;

settings! {
    /// How much is measured.
    #[derive(Eq)]
    pub struct Settings {
        /// Random layouts
        pub layouts: u32 = 1000, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first layout and its runs; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// Columns of each layout
        pub columns: u16 = 6, one("columns", "COLUMNS", from_to(1..=32));
        /// Rows of each layout
        pub rows: u16 = 7, one("rows", "ROWS", from_to(1..=32));
        /// Blocked cells of each layout
        pub blocked: u16 = 4, one("blocked", "CELLS", from_to(0..=512));
        /// Robots of each team
        pub robots: Vec<u16> = TEAMS.to_vec(), list("robots", from_to(1..=16));
    }
}

/// A run of every team in one layout.
type Job = Run<()>;

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Rule by rule, each for all teams.
    pub lines: Vec<Line>,
}

impl Settings {
    /// The most robots of a team.
    fn most(&self) -> u16 {
        self.robots.iter().copied().max().unwrap_or(0)
    }
}

impl Table for FrontierFig7 {
    type Settings = Settings;
    type Job = Job;
    type Sample = Vec<Outcome>;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "frontier-fig7",
            shows: "frontier cells: how many team moves 1 to 8 robots take to \
                    explore every cell, by every rule and rival",
            help: "How many team moves robots take that go from frontier cell to frontier cell",
            examples: &[
                "frontier-fig7 --svg moves.svg",
                "frontier-fig7 --blocked 12 --runs 100 --format json",
            ],
            doing: "exploring",
            takes: "minutes",
            pictures: &[("svg", "Store a chart of the team moves")],
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let Settings { layouts, columns, rows, blocked, .. } = *settings;
        let (cells, most) = (columns * rows, settings.most());
        if blocked + most > cells {
            let what = format!("{blocked} blocked of {cells} cells leave no room for {most} robots");
            return Err(Diagnostic::usage(what, "give fewer blocked cells, or more columns and rows").into());
        }
        Ok(runs([()], |()| layouts))
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Vec<Outcome>, Halt> {
        let seed = run.seed(settings.seed);
        let (layout, starts) = drawn(settings, seed)?;
        let with = |rule: RuleId, robots: u16, loss| {
            follow(rule, &layout, &starts[..robots.into()], Options { loss, ..Options::default() }, seed)
        };
        let measured = teams(settings).map(|(rule, robots)| {
            let (report, entered) = with(rule, robots, Probability::NEVER)?;
            let tells = TELLING.iter().find(|(name, _)| *name == rule.as_str());
            let alone = tells.map(|_| with(rule, robots, Probability::ALWAYS)).transpose()?;
            let moves = report.reached(Milestone::Whole);
            let (starts, last) = (&starts[..robots.into()], moves.unwrap_or(report.steps));
            Ok(Outcome {
                moves,
                explored: report.explored * 1000 / report.cells,
                is_double: breaks(&report, ALONE) > 0,
                again: alone.as_ref().map(|(alone, _)| [&report, alone].map(|report| breaks(report, ONCE))),
                entered,
                unheard: alone
                    .and_then(|(alone, entered)| Some([alone.reached(Milestone::Whole)?, entered?])),
                left: tells.and_then(|&(_, rule)| death::left(rule, &layout, starts, last, seed)),
            })
        });
        measured.collect()
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let outcomes = |wanted: (RuleId, u16)| -> Vec<Outcome> {
            let place = teams(settings).position(|team| team == wanted);
            results.iter().filter_map(|(_, outcomes)| outcomes.get(place?).copied()).collect()
        };
        let line = |(rule, robots)| {
            let others = [(RuleId::REPAIRED, robots), (rule, 1)].map(&outcomes);
            Line::of(rule, robots, &outcomes((rule, robots)), &others)
        };
        Ok(Summary { settings: settings.clone(), lines: teams(settings).map(line).collect() })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        type Part<'a> = (&'a str, fn(&Line) -> Option<Estimate>);
        let Settings { layouts, columns, rows, blocked, robots: sizes, .. } = settings;
        let moves = format!(
            "Team moves until every cell is explored: {layouts} layouts of {columns}×{rows} cells, {blocked} blocked"
        );
        let parts: [Part<'_>; 12] = [
            (&moves, |line| line.moves),
            (
                "Team moves more than the repaired rule takes on the same layouts, of which both explore every cell",
                |line| line.behind,
            ),
            ("Runs that explore every cell, in %; the others are in no mean of team moves", |one| one.whole),
            ("Runs in which two robots are in one cell, in %", |line| line.double),
            ("Team moves in which a robot explores a cell that one has entered before", |line| line.again),
            ("How many more of them on the same layouts if no robot hears another one's map", |line| {
                line.saved
            }),
            (
                "Layouts on which robots are slower than one of the same rule, or explore fewer cells, in %",
                |line| line.worse,
            ),
            (
                "How many more team moves if no robot hears another one's map, on the layouts that both explore whole",
                |line| line.sooner,
            ),
            ("Cells that all robots together enter until every cell is explored", |line| line.entered),
            ("How many more of them on those layouts if no robot hears another one's map", |line| {
                line.spared
            }),
            ("Runs that explore every cell although one robot dies, in %", |line| line.tolerant),
            ("Runs in which one dies and the others explore every cell that they can get to, in %", |line| {
                line.cleared
            }),
        ];
        let part = |(title, of): Part<'_>| {
            let rules = merged.lines.chunks(sizes.len());
            let mut columns = Columns::of(rules).title(title).left("rule", |teams| teams[0].rule);
            for (place, robots) in sizes.iter().enumerate() {
                columns = columns.estimate(counted(*robots, "robot"), 1, move |teams| of(&teams[place]));
            }
            columns.text()
        };
        Ok(parts.map(part).concat())
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        claims::judged(&merged.lines)
    }

    /// Team moves over robots, a line for each rule.
    fn draw(&self, _: usize, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let series = |lines: &[Line]| {
            let is_whole = |line: &&Line| line.whole.is_some_and(|whole| whole.mean > 50.0);
            let whole = lines.iter().filter(is_whole);
            let points = whole.filter_map(|line| Some(Point::of(line.robots.into(), line.moves?)));
            match lines[0].rule {
                RuleId::REPAIRED => Series::measured("repaired", points),
                rule => Series::printed(rule.as_str(), points),
            }
        };
        let (x, y) = (Axis::new("robots", ""), Axis::new("team moves", "").showing([0.0, 0.0]));
        let series = merged.lines.chunks(settings.robots.len()).map(series);
        Ok(LineChart::new("Team moves until every cell is explored", x, y, series).without_empty().svg())
    }

    /// A repaired team explores every cell, none of them twice, and never has two robots in one.
    fn is_broken(&self, merged: &Summary) -> bool {
        let repaired = |line: &&Line| line.rule == RuleId::REPAIRED || line.rule.as_str() == "plain";
        merged.lines.iter().filter(repaired).any(|line| {
            line.whole.is_some_and(|whole| whole.mean < 100.0)
                || [line.double, line.again].into_iter().flatten().any(|faults| faults.mean > 0.0)
        })
    }
}

/// A layout whose free cells are connected, and starts in it.
fn drawn(settings: &Settings, seed: u64) -> Result<(Layout, Vec<Cell>), Halt> {
    let Settings { columns, rows, blocked, .. } = *settings;
    let mut dice = Dice::new(seed, *b"fig7    ");
    let below = |of: usize, dice: &mut Dice| dice.below(of as u64) as usize;
    for _ in 0..MOST_DRAWN {
        let mut layout = Layout::open(columns.into(), rows.into())?;
        let mut cells: Vec<Cell> = layout.cells().collect();
        for _ in 0..blocked {
            layout.block(cells.swap_remove(below(cells.len(), &mut dice)));
        }
        if layout.reachable(&cells[..1]).len() < cells.len() {
            continue;
        }
        let starts = (0..settings.most()).map(|_| cells.swap_remove(below(cells.len(), &mut dice)));
        return Ok((layout, starts.collect()));
    }
    let what = format!("of {MOST_DRAWN} layouts with {blocked} blocked cells none is connected");
    Err(Diagnostic::usage(what, "give fewer blocked cells").into())
}

/// Layouts that are drawn until one is connected.
const MOST_DRAWN: u32 = 100_000;

/// A run, and how many cells its robots enter together until every cell is explored.
fn follow(
    rule: RuleId,
    layout: &Layout,
    starts: &[Cell],
    options: Options,
    seed: u64,
) -> Result<(Report, Option<u32>), Halt> {
    let mut layout = layout.clone();
    let base = starts[0];
    layout.place_base(base)?;
    let limits = Limits { max_moves: NonZeroU32::new(MOST_MOVES), ..Limits::default() };
    let setup = Setup::new(&FRONTIER, rule, starts.len() as u16, layout, base);
    let setup = Setup { starts: Some(starts.to_vec()), seed, limits, options, ..setup };
    let mut entered = Vec::new();
    let report = explore(&setup, &mut |made| {
        entered.push(count(made.before.iter().zip(&made.frame.cells), |(before, now)| before != now));
        Ok(())
    })?;
    let whole = report.reached(Milestone::Whole).map(|moves| entered.iter().take(moves as usize).sum());
    Ok((report, whole))
}

/// The team moves of a run that break this clause.
fn breaks(report: &Report, clause: ClauseId) -> u32 {
    report.violations.iter().filter(|violation| violation.clause == clause).count() as u32
}
