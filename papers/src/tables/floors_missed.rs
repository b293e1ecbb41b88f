//! The harm of missed sensors to agents that are to know that they are done: how often one is done although
//! another cell was unexplored or left to go through, and what it costs. Each run has a start, and a generated layout,
//! of its own.

use tautline_kernel::bricks;
use tautline_kernel::bricks::tree::Rule;

use super::agents::{Crew, Outcome};
use super::floors::{Job, file_name, floor, points, probability};
use super::prelude::*;
use tautline_grids::chance::Probability;

/// The teams that are compared: one that is robust by going over the floor again, one by looking underfoot, and those
/// that doubt.
const TEAMS: [(&str, &dyn Crew); 6] = [
    ("bricks-ants", &bricks::Rule::ROBUST),
    ("helpers", &Rule::ROBUST),
    ("helpers (doubting, 1 scan)", &Rule::DOUBTING.reading(1)),
    ("helpers (doubting, 2 scans)", &Rule::DOUBTING.reading(2)),
    ("helpers (doubting, 3 scans)", &Rule::DOUBTING.reading(3)),
    ("helpers (doubting, 4 scans)", &Rule::DOUBTING.reading(4)),
];

/// Being done, wrongly and rightly.
#[derive(Clone, Copy, Debug)]
pub struct FloorsMissed;

settings! {
    /// How much is measured.
    pub struct Settings {
        /// A file of a layout, or a description of a generated one; once for each
        pub maps: Vec<String> = ["cells:8x8:0.2", "cells:32x32:0.2"].map(str::to_owned).into(),
            repeated("map", "LAYOUT", String::clone, layout_name);
        /// Agents of the teams
        pub agents: Vec<u16> = vec![1, 4], list("agents", from_to(1..=255));
        /// Runs of each team in each layout
        pub runs: u32 = 50, one("runs", "COUNT", from_to(1..=1_000_000));
        /// The seed of the first run; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// How likely it is that a sensor is missed, from 0 to 0.5
        pub miss: f64 = 0.0556, one("miss", "P", probability);
        /// Steps of all agents together after which a run is ended
        pub max_steps: u32 = 200_000, one("max-steps", "STEPS", from_to(1..=u32::MAX.into()));
    }
}

/// A team in a layout.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The layout.
    pub map: String,
    /// Agents.
    pub agents: u16,
    /// Who explores.
    pub team: &'static str,
    /// Team moves until everything is explored, over cells by agents, of the runs in which it is.
    pub explored: Option<Estimate>,
    /// Team moves until all agents are done, likewise.
    pub known: Option<Estimate>,
    /// The share of the runs in which an agent was done although another cell was unexplored or left to go through.
    pub early: Option<Estimate>,
    /// The share of the runs that were ended after too many steps.
    pub ended: Option<Estimate>,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    settings: Settings,
    /// Layout by layout, by the number of agents, of all teams.
    pub lines: Vec<Line>,
}

impl Table for FloorsMissed {
    type Settings = Settings;
    type Job = Job;
    type Sample = [Outcome; TEAMS.len()];
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "floors-missed",
            shows: "agents on sensor floors that miss sensors: how often one is done too \
                    early, and what it costs over the lower bound",
            help: "How often agents are wrong that miss sensors",
            more: "The lower bound is the number of cells by that of the agents. A generated layout is another one in \
                   each run. The first start is the cell of the largest part of the layout that is nearest its \
                   centre, the others are drawn from that part.",
            examples: &[
                "floors-missed --map cells:8x8:0.2 --runs 1000",
                "floors-missed --map den312d.map --agents 4,20 --runs 20 --max-steps 2000000",
            ],
            doing: "exploring",
            takes: "some seconds",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(runs(points(&settings.maps, &settings.agents), |_| settings.runs))
    }

    fn parts(&self, _: &Job) -> u64 {
        TEAMS.len() as u64
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let Settings { maps, miss, max_steps, .. } = settings;
        let seed = run.seed(settings.seed);
        let (layout, starts) = floor(maps, run, seed)?;
        let miss = Probability::new(*miss).unwrap_or(Probability::NEVER);
        Ok(TEAMS.map(|(_, crew)| crew.run(&layout, &starts, (miss, seed), *max_steps)))
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let lines = points(&settings.maps, &settings.agents).flat_map(|(map, agents)| {
            let teams = TEAMS.into_iter().zip(of_teams(&results, (map, agents)));
            teams.map(move |((team, _), outcomes)| Line {
                map: settings.maps[map].clone(),
                agents,
                team,
                explored: Outcome::ratios(&outcomes, |outcome| outcome.exploration, agents),
                known: Outcome::ratios(&outcomes, |outcome| outcome.termination, agents),
                early: share(&outcomes, |outcome| outcome.is_early),
                ended: share(&outcomes, |outcome| outcome.is_ended),
            })
        });
        Ok(Summary { settings: settings.clone(), lines: lines.collect() })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let Settings { runs, seed, miss, max_steps, .. } = settings;
        let columns = Columns::of(&merged.lines)
            .left("layout", |line| file_name(&line.map))
            .right("agents", |line| line.agents)
            .left("team", |line| line.team)
            .estimate("until explored", 2, |line| line.explored)
            .estimate("until known", 2, |line| line.known)
            .percent("% early", 1, |line| line.early)
            .percent("% ended", 1, |line| line.ended);
        Ok(format!(
            "Team moves over the lower bound, cells by agents; {runs} runs, seeds from {seed}, \
             {} % of the sensors missed; means with\n\
             95 % intervals over the runs\n\n{}\n\
             until known: of the runs in which all agents were done. early: runs in \
             which an agent was done although another\n\
             cell was unexplored or left to go through. ended: runs that were stopped after {max_steps} \
             steps of all agents. Agents of bricks-ants\n\
             go on for as long as they may miss sensors: their runs are over when everything is explored.\n",
            miss * 100.0,
            columns.text()
        ))
    }
}
