//! Frontier cells (Rajesh, Nagaraja and Suja 2024, 6, Fig. 7) on random layouts: how many team moves one robot and
//! several take to explore every cell, by every rule and rival.
//!
//! The text has no number of Fig. 7, so that only its sentences can be judged. The area is that of Fig. 3, 6×7 cells.
//! Blocked cells are drawn at random, so that the free ones are connected; so are the starts, each robot in a cell of
//! its own.

mod death;

use std::num::NonZeroU32;

use tautline_kernel::frontier::Rule;
use tautline_kernel::ground::Cell;

use super::prelude::*;
use tautline_grids::chance::{Dice, Probability};
use tautline_sim::explore::frontier::{ALONE, FRONTIER, ONCE};
use tautline_sim::explore::{ClauseId, Limits, Milestone, Report, RuleId, Setup, explore};
use tautline_sim::options::Options;

/// Team sizes that the paper compares.
pub const TEAMS: [u16; 5] = [1, 2, 4, 6, 8];

/// The team that the paper says is best.
const BEST: u16 = 8;

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

/// The outcome of one run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    /// Team moves until every cell is explored, if all are.
    moves: Option<u32>,
    /// Explored cells, in thousandths.
    explored: u32,
    /// Whether two robots were in one cell.
    is_double: bool,
    /// Team moves in which a robot entered as its frontier cell what one had entered before, and how many these are if
    /// no robot hears another one; for some rules.
    again: Option<[u32; 2]>,
    /// Cells that all robots together enter until every cell is explored, if all are.
    entered: Option<u32>,
    /// The team moves and the entered cells until then if no robot hears another one, for some rules.
    unheard: Option<[u32; 2]>,
    /// Cells that are left out if one robot dies, and those of them that the others could get to, for some rules.
    left: Option<[u32; 2]>,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Rule by rule, each for all teams.
    pub lines: Vec<Line>,
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
    /// Team moves of a run in which a robot enters as its frontier cell what one has entered before.
    pub again: Option<Estimate>,
    /// How many more of them there are on the same layouts if no robot hears of another one's map.
    pub saved: Option<Estimate>,
    /// Layouts on which the team takes more team moves than one robot of the same rule, or explores fewer cells, in
    /// percent.
    pub worse: Option<Estimate>,
    /// How many more team moves it takes on the same layouts if no robot hears of another one's map, over those of
    /// which both explore every cell.
    pub sooner: Option<Estimate>,
    /// Cells that all robots together enter until every cell is explored, over the runs that explore all.
    pub entered: Option<Estimate>,
    /// How many more of them there are on the layouts of `sooner` if no robot hears of another one's map.
    pub spared: Option<Estimate>,
    /// Runs in which every cell is explored although one robot dies, in percent.
    pub tolerant: Option<Estimate>,
    /// Runs in which one robot dies and the others explore every cell that they can get to, in percent.
    pub cleared: Option<Estimate>,
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
        let mut sentences = judged(&merged.lines);
        sentences.extend(best_of_all(&merged.lines));
        sentences.extend(of_teams(&merged.lines));
        sentences.extend(death::judged(&merged.lines));
        sentences
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

impl Outcome {
    /// Whether it explores fewer cells than `other` on the same layout, or all of them in more team moves.
    fn is_worse(&self, other: &Self) -> bool {
        let is_slower = self.moves.zip(other.moves).is_some_and(|(own, other)| own > other);
        is_slower || self.explored < other.explored
    }
}

impl Line {
    /// The mean of the team moves, where a run explores every cell.
    fn mean(&self) -> f64 {
        self.moves.map_or(f64::INFINITY, |moves| moves.mean)
    }

    /// Beside these outcomes those of repaired robots, and of one robot of the same rule.
    fn of(rule: RuleId, robots: u16, outcomes: &[Outcome], [repaired, one]: &[Vec<Outcome>; 2]) -> Self {
        let percent =
            |is_such: fn(&Outcome) -> bool| share(outcomes, is_such).map(|share| share.times(100.0));
        let deaths: Vec<[u32; 2]> = outcomes.iter().filter_map(|outcome| outcome.left).collect();
        let none_left = |of: usize| share(&deaths, |left| left[of] == 0).map(|share| share.times(100.0));
        let worse = share(outcomes.iter().zip(one), |(own, one)| own.is_worse(one));
        let unheard = |place: usize, heard: fn(&Outcome) -> Option<u32>| {
            let more = move |one: &Outcome| Some(f64::from(one.unheard?[place]) - f64::from(heard(one)?));
            mean(outcomes.iter().filter_map(more))
        };
        let more = |(own, other): (&Outcome, &Outcome)| Some(f64::from(own.moves?) - f64::from(other.moves?));
        let again = |one: &Outcome| one.again.map(|[heard, _]| f64::from(heard));
        let saved = |one: &Outcome| one.again.map(|[heard, alone]| f64::from(alone) - f64::from(heard));
        Self {
            rule,
            robots,
            moves: mean(outcomes.iter().filter_map(|outcome| outcome.moves.map(f64::from))),
            behind: mean(outcomes.iter().zip(repaired).filter_map(more)),
            whole: percent(|outcome| outcome.moves.is_some()),
            explored: mean(outcomes.iter().map(|outcome| f64::from(outcome.explored) / 10.0)),
            double: percent(|outcome| outcome.is_double),
            again: mean(outcomes.iter().filter_map(again)),
            saved: mean(outcomes.iter().filter_map(saved)),
            worse: worse.map(|share| share.times(100.0)),
            sooner: unheard(0, |one| one.moves),
            entered: mean(outcomes.iter().filter_map(|one| one.entered.map(f64::from))),
            spared: unheard(1, |one| one.entered),
            tolerant: none_left(0),
            cleared: none_left(1).filter(|_| robots > 1),
        }
    }
}

/// The 95 % interval of an estimate.
fn ends(estimate: Option<Estimate>) -> Option<[f64; 2]> {
    estimate.and_then(|estimate| estimate.interval)
}

/// Whether the paper's sentences about several robots are judged of this team.
fn is_judged(line: &&Line) -> bool {
    ["published", "repaired", "wanders"].contains(&line.rule.as_str()) && [2, BEST].contains(&line.robots)
}

/// The paper's sentences about Fig. 7, judged by what is measured.
fn judged(lines: &[Line]) -> Vec<Judgement> {
    let of = |rule: &str, robots: u16| {
        lines.iter().find(|line| line.rule.as_str() == rule && line.robots == robots)
    };
    let moves = |rule: &str, robots| text(of(rule, robots).and_then(|line| line.moves), 1);
    let percent =
        |part: fn(&Line) -> Option<Estimate>, rule: &str, robots| text(of(rule, robots).and_then(part), 1);
    let estimate = |part: fn(&Line) -> Option<Estimate>, rule: &str, robots| of(rule, robots).and_then(part);
    let whole = estimate(|line| line.whole, "published", 1).map(|whole| whole.times(0.01));
    let alone = estimate(|line| line.double, "published", 8).map(|double| double.times(0.01).rest());
    let largest = lines.iter().map(|line| line.robots).max().unwrap_or(BEST);
    let [eight, six] = [8, 6].map(|robots| ends(estimate(|line| line.moves, "wanders", robots)));
    let less = |(rule, who): (&str, &str)| {
        let again = estimate(|line| line.again, rule, 8);
        let saved = estimate(|line| line.saved, rule, 8);
        Judgement::new(
            "maps are exchanged “to reduce overlapping”",
            who,
            format!(
                "in {} team moves of a run one explores a cell again, in {} more if it hears no map",
                text(again, 1),
                text(saved, 1)
            ),
            below(Some([0.0, 0.0]), ends(saved)),
        )
    };
    let mut judged = vec![
        Judgement::new(
            "“performs better when team of robots has 8 members”",
            "robots that wander",
            format!(
                "{} team moves with 6 and {} with 8, repaired {} and {}; \
                 {largest} is the largest team that is compared",
                moves("wanders", 6),
                moves("wanders", 8),
                moves("repaired", 6),
                moves("repaired", 8)
            ),
            below(eight, six),
        ),
        Judgement::new(
            "“avoiding … missing out sectors”",
            "one published robot",
            format!(
                "{} % of the cells, and all of them in {} % of the runs; repaired {} %",
                percent(|line| line.explored, "published", 1),
                percent(|line| line.whole, "published", 1),
                percent(|line| line.whole, "repaired", 1)
            ),
            always(whole),
        ),
        Judgement::new(
            "“avoiding overlapping”",
            "8 published robots",
            format!(
                "in {} % of the runs two are in one cell; repaired {} %",
                percent(|line| line.double, "published", 8),
                percent(|line| line.double, "repaired", 8)
            ),
            always(alone),
        ),
    ];
    judged.extend([("published", "8 published robots"), ("wanders", "8 robots that wander")].map(less));
    judged
}

/// The paper's sentence about eight robots, where larger teams are measured, too: no larger team of robots that wander,
/// as of repaired ones, explores every cell in fewer team moves.
fn best_of_all(lines: &[Line]) -> Vec<Judgement> {
    let of = |rule: &str| -> Vec<&Line> { lines.iter().filter(|line| line.rule.as_str() == rule).collect() };
    let judged = |(rule, who): (&str, &str)| {
        let lines = of(rule);
        let eight = lines.iter().find(|line| line.robots == BEST)?;
        let larger = lines.iter().filter(|line| line.robots > BEST);
        let fastest = larger.min_by(|one, other| one.mean().total_cmp(&other.mean()))?;
        let measured = format!(
            "{} team moves with {BEST}, {} with {}",
            text(eight.moves, 1),
            text(fastest.moves, 1),
            fastest.robots
        );
        let is_best = below(ends(eight.moves), ends(fastest.moves));
        Some(Judgement::new(
            "“performs better when team of robots has 8 members”, best of all",
            who,
            measured,
            is_best,
        ))
    };
    [("wanders", "robots that wander"), ("repaired", "repaired robots")]
        .into_iter()
        .filter_map(judged)
        .collect()
}

/// The paper's sentences about several robots beside one, and about robots that share their maps beside such that do
/// not. The energy of a team is taken to be the cells that its robots enter.
fn of_teams(lines: &[Line]) -> Vec<Judgement> {
    let nothing = Some([0.0, 0.0]);
    let teams = lines.iter().filter(is_judged);
    let one = |line: &Line| lines.iter().find(|one| one.rule == line.rule && one.robots == 1);
    let judged = |line: &Line| {
        let one = one(line);
        let worse = line.worse.map(|worse| worse.times(0.01).rest());
        let [moves, entered] = [|line: &Line| line.moves, |line: &Line| line.entered].map(|of| {
            (text(of(line), 1), text(one.and_then(of), 1), below(ends(of(line)), ends(one.and_then(of))))
        });
        let more = |what: &str, more: Option<Estimate>| format!("{} more {what} without", text(more, 1));
        [
            (
                "“always advantages over single robot exploration strategies as the total time … will be reduced” (1)",
                format!("on {} % of the layouts slower, or with fewer cells explored", text(line.worse, 1)),
                always(worse),
            ),
            (
                "“the total time … will be reduced” (1), in the mean",
                format!("{} team moves, one robot {}", moves.0, moves.1),
                moves.2,
            ),
            (
                "shared maps: “complete the exploration in lesser time” (4.5)",
                more("team moves", line.sooner),
                below(nothing, ends(line.sooner)),
            ),
            (
                "“which is energy efficient” (4.5), than without maps: fewer cells entered",
                more("cells", line.spared),
                below(nothing, ends(line.spared)),
            ),
            (
                "“which is energy efficient” (4.5), than one robot: fewer cells entered",
                format!("{} cells, one robot {}", entered.0, entered.1),
                entered.2,
            ),
        ]
        .map(|(sentence, measured, verdict)| {
            Judgement::new(sentence, format!("{} robots, {}", line.robots, line.rule), measured, verdict)
        })
    };
    let judged: Vec<[Judgement; 5]> = teams.map(judged).collect();
    (0..5).flat_map(|place| judged.iter().map(move |team| team[place].clone())).collect()
}
