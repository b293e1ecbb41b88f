//! What missed sensors do to agents that are to know that they are done: how often one of them is done although it
//! could have got to an unexplored cell, and what it costs. Each run has a start, and a generated layout, of its own.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::bricks::tree::Rule;
use tautline_proofs::bricks::tree::Way;

use super::agents::{Explorer, Outcome, ROBUST};
use super::floors::{largest_part, loaded, points, probability, start};
use super::parameter::{Given, Parameter, Values, all_shown, put, put_all, shown};
use super::{About, Observer, Table};
use tautline_field::stats::Estimate;
use tautline_sim::diagnostic::Halt;
use tautline_sim::layout;
use tautline_sim::layout::generate::Probability;
use tautline_sim::text_table::{Column, TextTable, Width};
use tautline_sim::value_parser::{number, within};

/// Who is compared: what is robust by going over the floor again, what is robust by looking underfoot, and what doubts.
const TEAMS: [(&str, Explorer); 6] = [
    ("bricks-ants", ROBUST),
    ("helpers", Explorer::Trees(Way::Trees(Rule::ROBUST))),
    ("helpers (doubting, 1 scan)", doubting(1)),
    ("helpers (doubting, 2 scans)", doubting(2)),
    ("helpers (doubting, 3 scans)", doubting(3)),
    ("helpers (doubting, 4 scans)", doubting(4)),
];

const fn doubting(readings: u8) -> Explorer {
    Explorer::Trees(Way::Trees(Rule::DOUBTING.reading(readings)))
}

/// Being done, wrongly and rightly.
#[derive(Clone, Copy, Debug)]
pub struct FloorsMissed;

/// How much is measured.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Files of layouts, or descriptions of generated ones.
    pub maps: Vec<String>,
    /// Agents of the teams.
    pub agents: Vec<u16>,
    /// Runs of each team in each layout.
    pub runs: u32,
    /// The seed of the first run; the others have the seeds after it.
    pub seed: u64,
    /// How likely it is that a sensor is missed.
    pub miss: f64,
    /// Steps of all agents after which a run is ended.
    pub max_steps: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            maps: ["cells:8x8:0.2", "cells:32x32:0.2"].map(str::to_owned).into(),
            agents: vec![1, 4],
            runs: 50,
            seed: 0,
            miss: 0.0556,
            max_steps: 200_000,
        }
    }
}

/// One run of every team.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    map: usize,
    agents: u16,
    run: u32,
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
    /// The share of the runs in which an agent was done although it could have got to an unexplored cell.
    pub early: Option<Estimate>,
    /// The share of the runs that were ended after too many steps.
    pub ended: Option<Estimate>,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    settings: Settings,
    /// Layout by layout, by the number of agents, of all teams.
    pub lines: Vec<Line>,
}

impl Table for FloorsMissed {
    type Settings = Settings;
    type Job = Job;
    type Measured = [Outcome; TEAMS.len()];
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "floors-missed",
            shows: "agents on sensor floors that miss sensors: how often one is done too early, and what it costs over the lower \
                    bound",
            help: "How often agents are wrong that miss sensors",
            more: "The lower bound is the number of cells by that of the agents. A generated layout is another one in each run. \
                   The first start is the cell of the largest part of the layout that is nearest its centre, the others are \
                   drawn from that part.",
            examples: &[
                "floors-missed --map cells:8x8:0.2 --runs 1000",
                "floors-missed --map den312d.map --agents 4,20 --runs 20 --max-steps 2000000",
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
                "runs",
                "COUNT",
                "Runs of each team in each layout",
                |all| shown(&all.runs),
                |all, texts| put(&mut all.runs, texts, |text| within(text, &(1..=1_000_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of the first run; the others have the seeds after it",
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

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let runs = |(map, agents)| (0..settings.runs).map(move |run| Job { map, agents, run });
        Ok(points(&settings.maps, &settings.agents).flat_map(runs).collect())
    }

    fn parts(&self, _: &Job) -> u64 {
        TEAMS.len() as u64
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Self::Measured, Halt> {
        let Settings { maps, seed, miss, max_steps, .. } = settings;
        let name = maps.get(job.map).map_or("", String::as_str);
        let seed = seed.wrapping_add(job.run.into());
        let layout = layout::load(name, seed, None)?;
        let start = start(&layout, &largest_part(&layout), (seed, job.run));
        let starts = vec![start; job.agents.into()];
        let miss = Probability::new(*miss).unwrap_or(Probability::NEVER);
        Ok(TEAMS.map(|(_, way)| way.run(&layout, &starts, (miss, seed), *max_steps)))
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Self::Measured)>) -> Result<Merged, Halt> {
        let of = |(map, agents): (usize, u16)| {
            let here: Vec<&Self::Measured> = results
                .iter()
                .filter(|(job, _)| (job.map, job.agents) == (map, agents))
                .map(|(_, outcomes)| outcomes)
                .collect();
            let line = |(place, (team, _)): (usize, (&'static str, Explorer))| {
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
    fn of(map: String, team: &'static str, agents: u16, outcomes: &[Outcome]) -> Self {
        let share = |is: fn(&Outcome) -> bool| {
            let hits = outcomes.iter().filter(|outcome| is(outcome)).count() as u32;
            Estimate::share(hits, outcomes.len() as u32)
        };
        Self {
            map,
            agents,
            team,
            explored: Outcome::mean_ratio(outcomes, |outcome| outcome.exploration, agents),
            known: Outcome::mean_ratio(outcomes, |outcome| outcome.termination, agents),
            early: share(|outcome| outcome.is_early),
            ended: share(|outcome| outcome.is_ended),
        }
    }
}

fn text(merged: &Merged) -> String {
    let Settings { runs, seed, miss, max_steps, .. } = &merged.settings;
    let names =
        [Column::left(Width::Fit), Column::right(Width::Fit).after(2), Column::left(Width::Fit).after(2)];
    let numbers = [Column::right(Width::Fit); 4].map(|column| column.after(2));
    let mut columns = TextTable::new(names.into_iter().chain(numbers));
    columns.row(["layout", "agents", "team", "until explored", "until known", "% early", "% ended"]);
    let percent = |share: Option<Estimate>| Estimate::text_or_dash(share.map(|share| share.times(100.0)), 1);
    for line in &merged.lines {
        columns.row([
            line.map.rsplit('/').next().unwrap_or_default().to_owned(),
            line.agents.to_string(),
            line.team.to_owned(),
            Estimate::text_or_dash(line.explored, 2),
            Estimate::text_or_dash(line.known, 2),
            percent(line.early),
            percent(line.ended),
        ]);
    }
    format!(
        "Team moves over the lower bound, cells by agents; {runs} runs, seeds from {seed}, {} % of the sensors missed; means with\n\
         95 % intervals over the runs\n\n{}\n\
         until known: of the runs in which all agents were done. early: runs in which an agent was done although it could\n\
         have got to an unexplored cell. ended: runs that were stopped after {max_steps} steps of all agents. Agents of bricks-ants\n\
         go on for as long as they may miss sensors: their runs are over when everything is explored.\n",
        miss * 100.0,
        columns.text()
    )
}
