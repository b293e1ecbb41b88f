//! What a sensor floor costs: the team moves of agents until everything is explored, and until all of them know it,
//! over the lower bound, cells by agents. Layouts are files of maps, or generated; the agents of a run start in one
//! cell.

use rand_chacha::rand_core::Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::ground::{Cell, Edge, Side};

use super::agents::{Outcome, TEAMS, Team};
use super::parameter::{Given, Parameter, Values, all_shown, put, put_all, shown};
use super::{About, Chart, Observer, Table, point};
use crate::chart::{Axis, LineChart, Point, Series, Stroke};
use tautline_field::stats::Estimate;
use tautline_sim::diagnostic::Halt;
use tautline_sim::layout::generate::{self, Probability};
use tautline_sim::layout::{self, Layout};
use tautline_sim::text_table::{Column, TextTable, Width};
use tautline_sim::value_parser::{number, real, within};

/// The price of a floor.
#[derive(Clone, Copy, Debug)]
pub struct Floors;

/// How much is measured.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Files of layouts, or descriptions of generated ones.
    pub maps: Vec<String>,
    /// Agents of the teams.
    pub agents: Vec<u16>,
    /// Cells in which the teams start, in each layout.
    pub starts: u32,
    /// The seed of what is drawn.
    pub seed: u64,
    /// How likely it is that a sensor is missed.
    pub miss: f64,
    /// Steps of all agents after which a run is ended.
    pub max_steps: u32,
}

impl Default for Settings {
    fn default() -> Self {
        let maps = ["office:30x30:4x4", "cells:48x48:0.2", "open:32x32", "walls:32x32:0.3"];
        Self {
            maps: maps.map(str::to_owned).into(),
            agents: vec![1, 4, 20],
            starts: 5,
            seed: 0,
            miss: 0.0,
            max_steps: 20_000_000,
        }
    }
}

/// One start of so many agents, for every team.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    map: usize,
    agents: u16,
    start: u32,
}

/// A team in a layout.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The layout.
    pub map: String,
    /// Its cells that the agents can get to.
    pub cells: u32,
    /// Agents.
    pub agents: u16,
    /// Who explores.
    #[serde(flatten)]
    pub team: Team,
    /// Team moves until everything is explored, over cells by agents, of the runs in which it is.
    pub explored: Option<Estimate>,
    /// Team moves until all agents are done, likewise.
    pub known: Option<Estimate>,
    /// Runs in which an agent was done although it could have got to an unexplored cell.
    pub early: u32,
    /// Runs that were ended after too many steps.
    pub ended: u32,
    #[serde(skip)]
    needed: Vec<f64>,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    settings: Settings,
    /// Layout by layout, by the number of agents, of all teams.
    pub lines: Vec<Line>,
}

impl Table for Floors {
    type Settings = Settings;
    type Job = Job;
    type Measured = [Outcome; TEAMS.len()];
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "floors",
            shows: "agents on sensor floors: team moves until everything is explored, and until all agents know it, over the lower \
                    bound",
            help: "What agents on sensor floors cost, over the lower bound",
            more: "The lower bound is the number of cells by that of the agents. The first start is the cell of the largest part \
                   of the layout that is nearest its centre, the others are drawn from that part.",
            examples: &[
                "floors --svg floors.svg",
                "floors --map den312d.map --map room-64-64-8.map --agents 4,20 --miss 0.0556",
            ],
            doing: "exploring",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        let map = Given {
            name: "map",
            value: "LAYOUT",
            about: "A file of a layout, or a description of a generated one; once for each",
            values: Values::Repeated,
        };
        vec![
            Parameter::new(
                map,
                |all| all_shown(&all.maps),
                |all, texts| put_all(&mut all.maps, texts, |text| loaded(text, 0).map(|_| text.to_owned())),
            ),
            Parameter::list(
                "agents",
                "Agents of the teams",
                |all| all_shown(&all.agents),
                |all, texts| put_all(&mut all.agents, texts, |text| within(text, &(1..=255_i64))),
            ),
            Parameter::one(
                "starts",
                "COUNT",
                "Cells in which the teams start, in each layout",
                |all| shown(&all.starts),
                |all, texts| put(&mut all.starts, texts, |text| within(text, &(1..=10_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of generated layouts, of the starts and of the sensors that are missed",
                |all| shown(&all.seed),
                |all, texts| put(&mut all.seed, texts, number),
            ),
            Parameter::one(
                "miss",
                "P",
                "How likely it is that a sensor is missed, from 0 to 0.5",
                |all| shown(&all.miss),
                |all, texts| put(&mut all.miss, texts, probability),
            ),
            Parameter::one(
                "max-steps",
                "STEPS",
                "Steps of all agents together after which a run is ended",
                |all| shown(&all.max_steps),
                |all, texts| put(&mut all.max_steps, texts, |text| within(text, &(1..=i64::from(u32::MAX)))),
            ),
        ]
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        let draw = |_: &Self, settings: &Settings, merged: &Merged| Ok(chart(settings, &merged.lines).svg());
        vec![Chart { name: "svg", about: "Store a chart of the share of the moves that are needed", draw }]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let starts = |(map, agents)| (0..settings.starts).map(move |start| Job { map, agents, start });
        Ok(points(&settings.maps, &settings.agents).flat_map(starts).collect())
    }

    fn parts(&self, _: &Job) -> u64 {
        TEAMS.len() as u64
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Self::Measured, Halt> {
        let Settings { maps, seed, miss, max_steps, .. } = settings;
        let name = maps.get(job.map).map_or("", String::as_str);
        let layout = layout::load(name, *seed, None)?;
        let part = largest_part(&layout);
        let start = start(&layout, &part, (*seed, job.start));
        let starts = vec![start; job.agents.into()];
        let miss = Probability::new(*miss).unwrap_or(Probability::NEVER);
        let seed = seed.wrapping_add(job.start.into());
        Ok(TEAMS.map(|team| team.run(&layout, &starts, (miss, seed), *max_steps)))
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Self::Measured)>) -> Result<Merged, Halt> {
        let of = |(map, agents): (usize, u16)| {
            let here: Vec<&Self::Measured> = results
                .iter()
                .filter(|(job, _)| (job.map, job.agents) == (map, agents))
                .map(|(_, outcomes)| outcomes)
                .collect();
            let line = |(place, team): (usize, Team)| {
                let outcomes: Vec<Outcome> = here.iter().map(|outcomes| outcomes[place]).collect();
                Line::of(settings.maps[map].clone(), team, agents, &outcomes)
            };
            TEAMS.into_iter().enumerate().map(line).collect::<Vec<_>>()
        };
        let lines = points(&settings.maps, &settings.agents).flat_map(of).collect();
        Ok(Merged { settings: settings.clone(), lines })
    }

    fn text(&self, _: &Settings, merged: &Merged) -> Result<String, Halt> {
        Ok(text(merged))
    }
}

impl Line {
    fn of(map: String, team: Team, agents: u16, outcomes: &[Outcome]) -> Self {
        let needed = |outcome: &Outcome| {
            let known = outcome.termination.filter(|_| !outcome.is_early);
            outcome.ratio(known, agents).map_or(0.0, |ratio| 100.0 / ratio)
        };
        let count = |is: fn(&Outcome) -> bool| outcomes.iter().filter(|outcome| is(outcome)).count() as u32;
        Self {
            map,
            cells: outcomes.iter().map(|outcome| outcome.cells).max().unwrap_or(0),
            agents,
            team,
            explored: Outcome::mean_ratio(outcomes, |outcome| outcome.exploration, agents),
            known: Outcome::mean_ratio(outcomes, |outcome| outcome.termination, agents),
            early: count(|outcome| outcome.is_early),
            ended: count(|outcome| outcome.is_ended),
            needed: outcomes.iter().map(needed).collect(),
        }
    }
}

/// The numbers of the layouts, each with every number of agents.
pub(super) fn points(maps: &[String], agents: &[u16]) -> impl Iterator<Item = (usize, u16)> {
    (0..maps.len()).flat_map(|map| agents.iter().map(move |&agents| (map, agents)))
}

/// How likely it is that a sensor is missed.
pub(super) fn probability(text: &str) -> Result<f64, &'static str> {
    real(text).and_then(|miss| Some(miss).filter(|miss| (0.0..=0.5).contains(miss)).ok_or("write 0 to 0.5"))
}

/// The layout that a text stands for.
pub(super) fn loaded(text: &str, seed: u64) -> Result<Layout, String> {
    layout::load(text, seed, None).map_err(|fault| fault.to_string())
}

/// The cells of the largest part of `layout`, the first such part.
pub(super) fn largest_part(layout: &Layout) -> Vec<Cell> {
    let (width, mut largest) = (usize::from(layout.width().unsigned_abs()), Vec::new());
    let place = |cell: Cell| cell.y as usize * width + cell.x as usize;
    let mut is_seen = vec![false; layout.size().cells()];
    for first in layout.cells().filter(|&cell| layout.is_free(cell)) {
        if is_seen[place(first)] {
            continue;
        }
        is_seen[place(first)] = true;
        let (mut part, mut next) = (vec![first], 0);
        while let Some(&cell) = part.get(next) {
            next += 1;
            for side in Side::ALL {
                let beyond = cell.beyond(side);
                if layout.is_open(Edge::new(cell, side)) && !is_seen[place(beyond)] {
                    is_seen[place(beyond)] = true;
                    part.push(beyond);
                }
            }
        }
        if part.len() > largest.len() {
            largest = part;
        }
    }
    largest
}

/// The start with this number among the cells of `part`.
pub(super) fn start(layout: &Layout, part: &[Cell], (seed, number): (u64, u32)) -> Cell {
    let centre = Cell::new(layout.width() / 2, layout.height() / 2);
    let apart = |cell: &&Cell| {
        let (columns, rows) = cell.apart(centre);
        (u32::from(columns) + u32::from(rows), **cell)
    };
    let base = part.iter().min_by_key(apart).copied().unwrap_or(centre);
    if number == 0 {
        return base;
    }
    let mut generator = generate::source(seed.wrapping_add(number.into()), *b"start   ");
    let place = (u128::from(generator.next_u64()) * part.len() as u128) >> 64;
    part.get(place as usize).copied().unwrap_or(base)
}

fn text(merged: &Merged) -> String {
    let Settings { starts, seed, miss, max_steps, .. } = &merged.settings;
    let numbers = [Column::right(Width::Fit); 4].map(|column| column.after(2));
    let names = [
        Column::left(Width::Fit),
        Column::right(Width::Fit).after(2),
        Column::right(Width::Fit).after(2),
        Column::left(Width::Fit).after(2),
    ];
    let mut columns = TextTable::new(names.into_iter().chain(numbers));
    columns.row(["layout", "cells", "agents", "team", "until explored", "until known", "early", "ended"]);
    for line in &merged.lines {
        columns.row([
            line.map.rsplit('/').next().unwrap_or_default().to_owned(),
            line.cells.to_string(),
            line.agents.to_string(),
            line.team.name(),
            Estimate::text_or_dash(line.explored, 2),
            Estimate::text_or_dash(line.known, 2),
            line.early.to_string(),
            line.ended.to_string(),
        ]);
    }
    format!(
        "Team moves over the lower bound, cells by agents; {starts} starts, seed {seed}, {} % of the sensors missed; means with\n\
         95 % intervals over the starts\n\n{}\n\
         until known: of the runs in which all agents were done. early: runs in which an agent was done although it could\n\
         have got to an unexplored cell. ended: runs that were stopped after {max_steps} steps of all agents.\n",
        miss * 100.0,
        columns.text()
    )
}

/// The share of an agent's moves that the lower bound needs, by the number of agents: all layouts together.
fn chart(settings: &Settings, lines: &[Line]) -> LineChart {
    let series = |team: Team| {
        let at = |&agents: &u16| {
            let lines = lines.iter().filter(|line| (line.team, line.agents) == (team, agents));
            let needed: Vec<f64> = lines.flat_map(|line| line.needed.iter().copied()).collect();
            Estimate::of_values(&needed).map(|estimate| point(agents.into(), estimate))
        };
        let points: Vec<Point> = settings.agents.iter().filter_map(at).collect();
        Series { name: team.name(), stroke: Stroke::Solid, points }
    };
    let drawn: Vec<Series> =
        TEAMS.into_iter().map(series).filter(|series| !series.points.is_empty()).collect();
    LineChart {
        title: format!(
            "Moves that are needed, of those made until all agents know rightly that they are done: {} layouts",
            settings.maps.len()
        ),
        x: Axis::new("agents", ""),
        y: Axis::new("moves", "%").showing([0.0, 100.0]),
        series: drawn,
    }
}
