//! Fig. 4 of the chain's paper: the trajectories of seven robots, and what their runs take. A room of 32 m has eight
//! cells of 4 m a side, an even number, so that no cell is its middle: the area with obstacles has 7×7 cells. Where its
//! obstacles are the figure shows, and not the text: ours are two rectangles.

use tautline_io::svg::Panel;
use tautline_kernel::ground::{Area, Cell};

use super::prelude::*;
use crate::nxt::{CELL_MM, DRIFT_PER_MILLE, Odometer, SPEED_MM};
use tautline_grids::layout::ColumnRow;
use tautline_sim::draw::svg;
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::{RuleName, Setup, explore, team};

/// Fig. 4.
#[derive(Clone, Copy, Debug)]
pub struct ChainFig4;

const ROBOTS: u16 = 8;

/// The cells that obstacles fill, by their corners.
const OBSTACLES: [[(i16, i16); 2]; 2] = [[(1, 1), (2, 1)], [(4, 5), (5, 5)]];

settings! {
    /// Nothing can be asked.
    #[derive(Copy, Eq)]
    pub struct Settings {}
}

/// Where the robots are.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// 15×15 cells without obstacles.
    Open,
    /// 7×7 cells with obstacles.
    Obstacles,
}

/// A run in an area by a rule.
type Job = (Place, RuleName);

/// The outcome of a run.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Run {
    place: Place,
    rule: RuleName,
    team_moves: u32,
    explored: u32,
    cells: u32,
    milliseconds: u64,
    longest_way_mm: u64,
    drift_mm: u64,
    walls: u32,
    passed: u32,
    /// Of the robots' places from team move N−1 on, those of R_i that are i−1 cells from the base in columns or rows.
    on_squares: u32,
    /// All these places.
    places: u32,
    /// The cells of R_2 … R_N.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(with = "Vec<Vec<ColumnRow>>")]
    ways: Vec<Vec<Cell>>,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    robots: u16,
    runs: Vec<Run>,
}

impl Place {
    const ALL: [Self; 2] = [Self::Open, Self::Obstacles];

    const fn words(self) -> &'static str {
        match self {
            Self::Open => "15x15, no obstacle",
            Self::Obstacles => "7x7, two rectangles",
        }
    }

    fn setup(self, rule: RuleName) -> Result<Setup, Halt> {
        let (side, obstacles) = match self {
            Self::Open => (15, &[][..]),
            Self::Obstacles => (7, &OBSTACLES[..]),
        };
        let mut layout = Layout::open(side, side)?;
        for &[(left, top), (right, bottom)] in obstacles {
            (top..=bottom).for_each(|y| (left..=right).for_each(|x| layout.block(Cell::new(x, y))));
        }
        let (layout, base) = based(layout)?;
        Ok(Setup::new(&CHAIN, rule, ROBOTS, layout, base))
    }
}

impl Table for ChainFig4 {
    type Settings = Settings;
    type Job = Job;
    type Sample = Run;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "chain-fig4",
            shows: "the trajectories of seven robots without and with obstacles, and what \
                    the runs take: minutes, metres, contacts",
            help: "Fig. 4 of the chain's paper: trajectories, and how long real robots would take",
            more: "Cells of 4 m, 0.30 m/s, 180 degrees a second; a robot that touches something backs up 30 cm and \
                   goes round. The team waits for its last robot; the radio's time is not counted (see chain-radio).",
            examples: &["chain-fig4", "chain-fig4 --svg-open open.svg --svg-obstacles obstacles.svg"],
            doing: "driving",
            takes: "a second",
            pictures: &[
                ("svg-open", "Store the trajectories without obstacles as a picture"),
                ("svg-obstacles", "Store the trajectories with obstacles as a picture"),
            ],
            ..Description::NOTHING
        }
    }

    fn jobs(&self, _: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(pairs(Place::ALL, RuleName::ALL).collect())
    }

    fn measure(&self, _: &Settings, &(place, rule): &Job, _: &dyn Observer) -> Result<Run, Halt> {
        let setup = place.setup(rule)?;
        let mut odometer = Odometer::new(ROBOTS.into());
        let mut ways = vec![vec![setup.base]; usize::from(ROBOTS) - 1];
        let (mut on_squares, mut places) = (0, 0);
        let report = explore(&setup, &mut |made| {
            odometer.make(made.before, made.frame);
            for (robot, (way, &cell)) in (1..).zip(ways.iter_mut().zip(&made.frame.cells[1..])) {
                way.push(cell);
                if made.step >= u32::from(ROBOTS) - 1 {
                    let (columns, rows) = cell.apart(setup.base);
                    places += 1;
                    on_squares += u32::from(columns.max(rows) == robot);
                }
            }
            Ok(())
        })?;
        Ok(Run {
            place,
            rule,
            team_moves: report.steps,
            explored: report.explored,
            cells: report.cells,
            milliseconds: odometer.milliseconds,
            longest_way_mm: odometer.longest_mm(),
            drift_mm: odometer.drift_mm(),
            walls: odometer.walls,
            passed: odometer.passed,
            on_squares,
            places,
            ways,
        })
    }

    fn merge(&self, _: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let runs = results.into_iter().map(|(_, run)| run).collect();
        Ok(Summary { robots: ROBOTS, runs })
    }

    fn text(&self, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        let tenths = |number: u64, unit: u64| {
            let tenths = (number * 10 + unit / 2) / unit;
            format!("{}.{}", tenths / 10, tenths % 10)
        };
        let mut text = format!(
            "{ROBOTS} robots: cells of {} m, {} m/s, error {DRIFT_PER_MILLE} ‰ of the way\n\n",
            CELL_MM / 1000,
            tenths(SPEED_MM, 1000)
        );
        let a_move = |run: &Run| tenths(run.milliseconds, 1000 * u64::from(run.team_moves.max(1)));
        text += &Columns::of(&merged.runs)
            .left("area", |run| run.place.words())
            .right("rule", |run| run.rule)
            .right("team moves", |run| run.team_moves)
            .right("explored", |run| format!("{}/{}", run.explored, run.cells))
            .right("minutes", |run| tenths(run.milliseconds, 60_000))
            .right("s a move", a_move)
            .right("longest way m", |run| tenths(run.longest_way_mm, 1000))
            .right("error m", |run| tenths(run.drift_mm, 1000))
            .right("walls", |run| run.walls)
            .right("robots passed", |run| run.passed)
            .text();
        Ok(text)
    }

    /// The paper prints no figure of these runs.
    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let published = merged.runs.iter().filter(|run| run.rule == RuleName::Published);
        let judged = |run: &Run| {
            let Run { on_squares, places, walls, .. } = run;
            match run.place {
                Place::Open => Judgement::new(
                    "“a regular pattern with concentric squares”",
                    run.place.words(),
                    format!(
                        "{on_squares} of {places} places of R_i are i-1 cells off the base from team move {} on",
                        ROBOTS - 1
                    ),
                    Verdict::of(on_squares == places),
                ),
                Place::Obstacles => Judgement::new(
                    "“clearly the two contact points with the obstacles”",
                    run.place.words(),
                    format!("our obstacles are not the paper's; {}", counted(*walls, "contact")),
                    Verdict::Open,
                ),
            }
        };
        published.map(judged).collect()
    }

    fn draw(&self, number: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        picture(merged, Place::ALL[number])
    }
}

fn picture(merged: &Summary, place: Place) -> Result<String, Halt> {
    let rule = RuleName::Published;
    let setup = place.setup(rule)?;
    let run = merged.runs.iter().find(|run| run.place == place && run.rule == rule);
    let run = run.ok_or_else(|| Diagnostic::usage("there is no such run", "measure it"))?;
    let area: Area = team(&setup)?.area(&setup.layout);
    let caption = format!("{}: {}", place.words(), counted(run.team_moves, "team move"));
    let title = format!("The ways of robots 2 to {ROBOTS}, {rule}");
    Ok(Panel::picture(&title, &[svg::trajectories(&setup.layout, area, &caption, &run.ways)]))
}
