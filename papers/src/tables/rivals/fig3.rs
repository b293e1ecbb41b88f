//! Fig. 3: team moves to 50 % and to 75 % of the cells by the density of walls, and in two buildings.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_proofs::plural::counted;

use super::super::parameter::{Parameter, put, shown};
use super::super::{About, Chart, Observer, Table};
use super::asked::{Told, parameters};
use super::claims::{self, Judged, Race, Verdict};
use super::{OPEN, Outcome, ROBOTS, ROOMS, Times, Who, generated};
use crate::chart::{Axis, LineChart, Point, Series, Stroke};
use crate::rivals::Links;
use tautline_sim::diagnostic::Halt;
use tautline_sim::explore::{Limits, Milestone, RuleName};
use tautline_sim::text_table::{Column, TextTable, Width};
use tautline_sim::value_parser::within;

/// Fig. 3.
#[derive(Clone, Copy, Debug)]
pub struct ChainFig3;

/// The paper's densities of walls.
const DENSITIES: [&str; 7] = ["0", "0.01", "0.02", "0.05", "0.1", "0.15", "0.2"];

/// What is drawn and judged.
const MILESTONES: [Milestone; 2] = [Milestone::Half, Milestone::ThreeQuarters];

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    told: Told,
}

impl Default for Settings {
    fn default() -> Self {
        Self { told: Told::new(200) }
    }
}

impl AsRef<Told> for Settings {
    fn as_ref(&self) -> &Told {
        &self.told
    }
}

impl AsMut<Told> for Settings {
    fn as_mut(&mut self) -> &mut Told {
        &mut self.told
    }
}

/// A run of every team in one layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    /// The place among [`DENSITIES`], then among the buildings.
    area: usize,
    seed: u64,
}

/// What comes of it, team by team.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Measured([Outcome; 6]);

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    settings: Settings,
    areas: Vec<Area>,
    sentences: Vec<Judged>,
}

/// All teams in the layouts of one density, or in one building.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Area {
    area: &'static str,
    teams: Vec<Line>,
}

#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Line {
    who: Who,
    milestones: [Times; MILESTONES.len()],
    /// Against the chain as published, on the same layouts: how often the chain is sooner.
    races: [Race; MILESTONES.len()],
}

fn areas() -> impl Iterator<Item = &'static str> {
    DENSITIES.into_iter().chain(ROOMS)
}

impl Table for ChainFig3 {
    type Settings = Settings;
    type Job = Job;
    type Measured = Measured;
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "chain-fig3",
            shows: "the chain against Full search and Rooker and Birk's pool by the density of walls: team moves to 50 % and \
                    75 %, and what the paper says of them",
            help: "Fig. 3 of the chain's paper: team moves to 50 % and to 75 % by the density of walls",
            more: "Where not all runs get there, the median counts the others as later than any; the chart draws medians.",
            examples: &["chain-fig3", "chain-fig3 --layouts 20 --svg-50 fig3a.svg"],
            doing: "comparing",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        let layouts = Parameter::one(
            "layouts",
            "COUNT",
            "Layouts of each density, and runs in each building",
            |all: &Settings| shown(&all.told.runs),
            |all, texts| put(&mut all.told.runs, texts, |text| within(text, &(1..=100_000_i64))),
        );
        [layouts].into_iter().chain(parameters()).collect()
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        vec![
            Chart {
                name: "svg-50",
                about: "Store team moves to 50 % as a chart",
                draw: |_, _, merged| Ok(chart(merged, 0).svg()),
            },
            Chart {
                name: "svg-75",
                about: "Store team moves to 75 % as a chart",
                draw: |_, _, merged| Ok(chart(merged, 1).svg()),
            },
        ]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        settings.told.check()?;
        let Told { runs, seed, .. } = settings.told;
        let of_area = |area| (0..runs).map(move |run| Job { area, seed: seed.wrapping_add(run.into()) });
        Ok((0..areas().count()).flat_map(of_area).collect())
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Measured, Halt> {
        let area = areas().nth(job.area).unwrap_or(OPEN);
        let description = if ROOMS.contains(&area) { area.to_owned() } else { format!("walls:15x15:{area}") };
        let layout = generated(&description, job.seed)?;
        let limits = Limits { until: Some(Milestone::ThreeQuarters), ..Limits::default() };
        let mut outcomes = [Outcome { milestones: [None; 3], explored: 0, cells: 0 }; 6];
        for (outcome, who) in outcomes.iter_mut().zip(Who::all(settings.told.pool)) {
            *outcome = who.run(&settings.told, &layout, job.seed, limits)?;
        }
        Ok(Measured(outcomes))
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Measured)>) -> Result<Merged, Halt> {
        let area = |(place, area): (usize, &'static str)| {
            let runs: Vec<&[Outcome; 6]> = results
                .iter()
                .filter(|(job, _)| job.area == place)
                .map(|(_, Measured(teams))| teams)
                .collect();
            let line = |(team, who): (usize, Who)| {
                let outcomes: Vec<&Outcome> = runs.iter().map(|teams| &teams[team]).collect();
                let race = |milestone| {
                    Race::of(
                        runs.iter()
                            .map(|teams| (teams[0].reached(milestone), teams[team].reached(milestone))),
                    )
                };
                Line {
                    who,
                    milestones: MILESTONES.map(|milestone| Times::of(&outcomes, milestone)),
                    races: MILESTONES.map(race),
                }
            };
            Area { area, teams: Who::all(settings.told.pool).into_iter().enumerate().map(line).collect() }
        };
        let areas: Vec<Area> = areas().enumerate().map(area).collect();
        let sentences = judged(&areas, settings.told.pool);
        Ok(Merged { settings: *settings, areas, sentences })
    }

    fn text(&self, settings: &Settings, merged: &Merged) -> Result<String, Halt> {
        let Told { runs, seed, patience, .. } = settings.told;
        let mut text = format!(
            "{ROBOTS} robots in walls:15x15:DENSITY and two buildings, {} a point, seeds from {seed}; means with 95 % intervals \
             (reached / runs); stuck after {} without gain\n",
            counted(runs, "layout"),
            counted(patience, "team move"),
        );
        for (place, milestone) in MILESTONES.iter().enumerate() {
            let teams = Who::all(settings.told.pool);
            let mut columns = TextTable::new(
                [Column::left(Width::Fit)].into_iter().chain(teams.iter().map(|_| Column::right(Width::Fit))),
            );
            columns.title(format!("Team moves to {} %", milestone.percent()));
            columns.row(["density".to_owned()].into_iter().chain(teams.map(Who::name)));
            for Area { area, teams } in &merged.areas {
                let times = teams.iter().map(|line| line.milestones[place].text());
                columns.row([(*area).to_owned()].into_iter().chain(times));
            }
            text += &columns.text();
        }
        text += "\nWhat the paper says of the chain as published; on the same layouts it is sooner, even or later, and who never \
                 gets there is later than any\n";
        Ok(text + &claims::text(&merged.sentences))
    }
}

/// The medians by density.
fn chart(merged: &Merged, place: usize) -> LineChart {
    let teams = merged.areas.first().map_or(&[][..], |area| &area.teams);
    let series = teams.iter().enumerate().map(|(team, line)| {
        let points = merged.areas.iter().filter_map(|Area { area, teams }| {
            let Times { mean, median, .. } = teams.get(team)?.milestones[place];
            let x = area.parse().ok()?;
            Some(match mean {
                Some(mean) => Point { x, y: mean.mean, interval: mean.interval },
                None => Point { x, y: f64::from(median?), interval: None },
            })
        });
        Series { name: line.who.name(), stroke: Stroke::Solid, points: points.collect() }
    });
    let percent = MILESTONES[place].percent();
    LineChart {
        title: format!("Until {percent} % is explored; a line ends where half of the runs never get there"),
        x: Axis::new("density of walls", ""),
        y: Axis::new("team moves", "").showing([0.0, 0.0]),
        series: series.collect(),
    }
}

/// Where a sentence is about.
type Where = fn(&str) -> bool;

fn is_open(area: &str) -> bool {
    matches!(area, "0" | "0.01")
}

fn is_low(area: &str) -> bool {
    matches!(area, "0" | "0.01" | "0.02")
}

fn is_density(area: &str) -> bool {
    DENSITIES.contains(&area)
}

/// What a sentence says of the chain and a rival.
#[derive(Clone, Copy)]
enum Says {
    Sooner,
    Later,
    Alike,
}

/// The sentences of Section E about Fig. 3.
fn judged(areas: &[Area], pool: u32) -> Vec<Judged> {
    type Rival = fn(u32, Links) -> Who;
    let (full, reference): (Rival, Rival) = (|_, links| Who::full(links), Who::pool);
    let sentences: [(&'static str, usize, Rival, Where, Says); 8] = [
        (
            "50 %: “definitely better than the reference … for an obstacle-free area or low obstacle density”",
            0,
            reference,
            is_low,
            Says::Sooner,
        ),
        (
            "50 %: “for higher obstacle densities the performances of the two methods are similar”",
            0,
            reference,
            |area| is_density(area) && !is_low(area),
            Says::Alike,
        ),
        (
            "50 %: “at zero and 0.01 densities” chain and Full search take “almost the same” time",
            0,
            full,
            is_open,
            Says::Alike,
        ),
        (
            "50 %: “for higher densities the Full search method performs better”",
            0,
            full,
            |area| is_density(area) && !is_open(area),
            Says::Later,
        ),
        (
            "75 %: “for low densities (zero and 0.01) … better than the other two”: Full search",
            1,
            full,
            is_open,
            Says::Sooner,
        ),
        (
            "75 %: “for low densities (zero and 0.01) … better than the other two”: the reference",
            1,
            reference,
            is_open,
            Says::Sooner,
        ),
        (
            "75 %: “beyond ρ=0.01 the Full search method achieves the best results”",
            1,
            full,
            |area| is_density(area) && !is_open(area),
            Says::Later,
        ),
        (
            "75 %: “definitely better than the reference method for all examined obstacle densities”",
            1,
            reference,
            is_density,
            Says::Sooner,
        ),
    ];
    let mut judged = Vec::new();
    for (sentence, place, rival, is_about, says) in sentences {
        for links in [Links::Safe, Links::Covered] {
            for Area { area, teams } in areas.iter().filter(|area| is_about(area.area)) {
                let find = |who| teams.iter().find(|line| line.who == who);
                let chain = find(Who::Chain(RuleName::Published));
                let (Some(chain), Some(rival)) = (chain, find(rival(pool, links))) else { continue };
                let race = rival.races[place];
                let verdict = match says {
                    Says::Sooner => race.is_won(),
                    Says::Later => Race { sooner: race.later, later: race.sooner, even: race.even }.is_won(),
                    Says::Alike => {
                        Verdict::alike(chain.milestones[place].middle(), rival.milestones[place].middle())
                    }
                };
                let measured = format!(
                    "{} against {}: {}",
                    chain.milestones[place].text(),
                    rival.milestones[place].text(),
                    race.text()
                );
                let of = format!("{area}, {}", links.symbol());
                judged.push(Judged { sentence, of, measured, verdict });
            }
        }
    }
    judged
}
