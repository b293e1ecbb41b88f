//! The cost of a sensor floor: the team moves of agents until everything is explored, and until all of them know it,
//! over the lower bound, cells by agents. Layouts are files of maps, or generated; the agents of a run start in one
//! cell.

use std::collections::BTreeSet;

use tautline_kernel::ground::Cell;

use super::agents::{Outcome, TEAMS, Team};
use super::prelude::*;
use tautline_grids::chance::{Dice, Probability};
use tautline_grids::layout;

/// The price of a floor.
#[derive(Clone, Copy, Debug)]
pub struct Floors;

settings! {
    /// How much is measured.
    pub struct Settings {
        /// A file of a layout, or a description of a generated one; once for each
        pub maps: Vec<String> = [
            "office:30x30:4x4", "cells:48x48:0.2", "open:32x32", "walls:32x32:0.3",
        ].map(str::to_owned).into(), repeated("map", "LAYOUT", String::clone, layout_name);
        /// Agents of the teams
        pub agents: Vec<u16> = vec![1, 4, 20], list("agents", from_to(1..=255));
        /// Cells in which the teams start, in each layout
        pub starts: u32 = 5, one("runs", "COUNT", from_to(1..=10_000));
        /// The seed of generated layouts, of the starts and of the sensors that are missed
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// How likely it is that a sensor is missed, from 0 to 0.5
        pub miss: f64 = 0.0, one("miss", "P", probability);
        /// Steps of all agents together after which a run is ended
        pub max_steps: u32 = 20_000_000, one("max-steps", "STEPS", from_to(1..=u32::MAX.into()));
    }
}

/// A run of every team: in which layout, and of how many agents.
pub(super) type Job = Run<(usize, u16)>;

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
    /// Runs in which an agent was done although another cell was unexplored or left to go through.
    pub early: u32,
    /// Runs that were ended after too many steps.
    pub ended: u32,
    #[serde(skip)]
    needed: Vec<f64>,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    settings: Settings,
    /// Layout by layout, by the number of agents, of all teams.
    pub lines: Vec<Line>,
}

impl Table for Floors {
    type Settings = Settings;
    type Job = Job;
    type Sample = [Outcome; TEAMS.len()];
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "floors",
            shows: "agents on sensor floors: team moves until everything is explored, and until \
                    all agents know it, over the lower bound",
            help: "What agents on sensor floors cost, over the lower bound",
            more: "The lower bound is the number of cells by that of the agents. The first start is the cell of the \
                   largest part of the layout that is nearest its centre, the others are drawn from that part.",
            examples: &[
                "floors --svg floors.svg",
                "floors --map den312d.map --map room-64-64-8.map --agents 4,20 --miss 0.0556",
            ],
            doing: "exploring",
            takes: "some seconds",
            pictures: &[("svg", "Store a chart of the share of the moves that are needed")],
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(runs(points(&settings.maps, &settings.agents), |_| settings.starts))
    }

    fn parts(&self, _: &Job) -> u64 {
        TEAMS.len() as u64
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let Settings { maps, seed, miss, max_steps, .. } = settings;
        let (layout, starts) = floor(maps, run, *seed)?;
        let miss = Probability::new(*miss).unwrap_or(Probability::NEVER);
        Ok(TEAMS.map(|team| team.crew.run(&layout, &starts, (miss, run.seed(*seed)), *max_steps)))
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let lines = points(&settings.maps, &settings.agents).flat_map(|(map, agents)| {
            let teams = TEAMS.into_iter().zip(of_teams(&results, (map, agents)));
            teams.map(move |(team, outcomes)| Line::of(&settings.maps[map], team, agents, &outcomes))
        });
        Ok(Summary { settings: settings.clone(), lines: lines.collect() })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let Settings { starts, seed, miss, max_steps, .. } = settings;
        let columns = Columns::of(&merged.lines)
            .left("layout", |line| file_name(&line.map))
            .right("cells", |line| line.cells)
            .right("agents", |line| line.agents)
            .left("team", |line| line.team.name())
            .estimate("until explored", 2, |line| line.explored)
            .estimate("until known", 2, |line| line.known)
            .right("early", |line| line.early)
            .right("ended", |line| line.ended);
        Ok(format!(
            "Team moves over the lower bound, cells by agents; {starts} starts, seed {seed}, \
             {} % of the sensors missed; means with\n\
             95 % intervals over the starts\n\n{}\n\
             until known: of the runs in which all agents were done. early: runs in \
             which an agent was done although another\n\
             cell was unexplored or left to go through. ended: runs that were stopped after {max_steps} \
             steps of all agents.\n",
            Number(miss * 100.0),
            columns.text()
        ))
    }

    /// The share of an agent's moves that the lower bound needs, by the number of agents: all layouts together.
    fn draw(&self, _: usize, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let series = |team: Team| {
            let at = |&agents: &u16| {
                let lines = merged.lines.iter().filter(|line| (line.team, line.agents) == (team, agents));
                let needed = mean(lines.flat_map(|line| line.needed.iter().copied()))?;
                Some(Point::of(agents.into(), needed))
            };
            Series::measured(team.name(), settings.agents.iter().filter_map(at))
        };
        let title = format!(
            "Moves that are needed, of those made until all agents know rightly that they are done: {} layouts",
            settings.maps.len()
        );
        let (x, y) = (Axis::new("agents", ""), Axis::new("moves", "%").showing([0.0, 100.0]));
        Ok(LineChart::new(title, x, y, TEAMS.map(series)).without_empty().svg())
    }
}

impl Line {
    fn of(map: &str, team: Team, agents: u16, outcomes: &[&Outcome]) -> Self {
        let needed = |outcome: &&Outcome| {
            let known = outcome.termination.filter(|_| !outcome.is_early);
            outcome.ratio(known, agents).map_or(0.0, |ratio| 100.0 / ratio)
        };
        Self {
            map: map.to_owned(),
            cells: outcomes.iter().map(|outcome| outcome.cells).max().unwrap_or(0),
            agents,
            team,
            explored: Outcome::ratios(outcomes, |outcome| outcome.exploration, agents),
            known: Outcome::ratios(outcomes, |outcome| outcome.termination, agents),
            early: count(outcomes, |outcome| outcome.is_early),
            ended: count(outcomes, |outcome| outcome.is_ended),
            needed: outcomes.iter().map(needed).collect(),
        }
    }
}

/// The numbers of the layouts, each with every number of agents.
pub(super) fn points(maps: &[String], agents: &[u16]) -> impl Iterator<Item = (usize, u16)> {
    pairs(0..maps.len(), agents.iter().copied())
}

/// How likely it is that a sensor is missed.
pub(super) fn probability(text: &str) -> Result<f64, &'static str> {
    real(text).and_then(|miss| Some(miss).filter(|miss| (0.0..=0.5).contains(miss)).ok_or("write 0 to 0.5"))
}

/// The name of a layout without its folders.
pub(super) fn file_name(map: &str) -> &str {
    map.rsplit('/').next().unwrap_or_default()
}

/// The cells of the largest part of `layout`, the first such part.
fn largest_part(layout: &Layout) -> Vec<Cell> {
    let mut seen = BTreeSet::new();
    let mut part_from = |first: Cell| {
        let part = if seen.contains(&first) { Vec::new() } else { layout.spread(&[first]).collect() };
        seen.extend(part.iter().copied());
        part
    };
    let parts = layout.cells().filter(|&cell| layout.is_free(cell)).map(&mut part_from);
    parts.reduce(|largest, part| if part.len() > largest.len() { part } else { largest }).unwrap_or_default()
}

/// The layout of a run with this seed, and the cells in which its agents start.
pub(super) fn floor(maps: &[String], run: &Job, seed: u64) -> Result<(Layout, Vec<Cell>), Halt> {
    let (map, agents) = run.at;
    let layout = layout::load(maps.get(map).map_or("", String::as_str), seed, None)?;
    let starts = vec![start(&layout, seed, run.number); agents.into()];
    Ok((layout, starts))
}

/// The start with this number in the largest part of `layout`.
fn start(layout: &Layout, seed: u64, number: u32) -> Cell {
    let part = largest_part(layout);
    let centre = Cell::new(layout.width() / 2, layout.height() / 2);
    let apart = |cell: &&Cell| {
        let (columns, rows) = cell.apart(centre);
        (u32::from(columns) + u32::from(rows), **cell)
    };
    let base = part.iter().min_by_key(apart).copied().unwrap_or(centre);
    if number == 0 {
        return base;
    }
    let mut dice = Dice::new(seed.wrapping_add(number.into()), *b"start   ");
    let place = dice.below(part.len() as u64);
    part.get(place as usize).copied().unwrap_or(base)
}
