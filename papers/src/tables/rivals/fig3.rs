//! Fig. 3: team moves to 50 % and to 75 % of the cells by the density of walls, and in two buildings.

use super::super::prelude::*;
use super::claims::Race;
use super::parameters::{ROBOTS, RivalSettings};
use super::{Contender, MAX_MOVES, OPEN, Outcome, ROOMS, Times, stopping};
use crate::rivals::{Links, Search};
use tautline_sim::explore::{Limits, Milestone, RuleName};

/// Fig. 3.
#[derive(Clone, Copy, Debug)]
pub struct ChainFig3;

/// The paper's densities of walls.
const DENSITIES: [&str; 7] = ["0", "0.01", "0.02", "0.05", "0.1", "0.15", "0.2"];

/// The milestones that are drawn and judged.
const MILESTONES: [Milestone; 2] = [Milestone::Half, Milestone::ThreeQuarters];

settings! {
    /// How much is measured.
    #[derive(Copy)]
    pub struct Settings {
        /// The parameters of the rivals, and how many layouts each density has
        told: RivalSettings = RivalSettings { runs: 200, ..RivalSettings::default() },
            renamed(nested(), "runs", ["runs", "Layouts of each density, and runs in each building"]);
        /// A run stops when a robot has entered so many cells
        max_moves: u32 = MAX_MOVES, one("max-moves", "CELLS", from_to(1..=1_000_000));
    }
}

/// A run of every team in one layout, by the place of its area among [`areas`].
type Job = Run<usize>;

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    settings: Settings,
    areas: Vec<Area>,
}

/// All teams in the layouts of one density, or in one building.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Area {
    area: &'static str,
    teams: Vec<Line>,
}

#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Line {
    who: Contender,
    milestones: [Times; MILESTONES.len()],
    /// Against the chain as published, on the same layouts: how often the chain is sooner.
    races: [Race; MILESTONES.len()],
    /// Of Full search, against the pool with the same links.
    pools: Option<[Race; MILESTONES.len()]>,
}

fn areas() -> impl Iterator<Item = &'static str> {
    DENSITIES.into_iter().chain(ROOMS)
}

impl Table for ChainFig3 {
    type Settings = Settings;
    type Job = Job;
    type Sample = [Outcome; 7];
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "chain-fig3",
            shows: "the chain against Full search and Rooker and Birk's pool by the density of walls: team moves to \
                    50 % and 75 %, and what the paper says of them",
            help: "Fig. 3 of the chain's paper: team moves to 50 % and to 75 % by the density of walls",
            more: "Where not all runs get there, the median counts the others as \
                   later than any; the chart draws medians.",
            examples: &["chain-fig3", "chain-fig3 --runs 20 --svg-50 fig3a.svg"],
            doing: "comparing",
            takes: "two minutes",
            pictures: &[
                ("svg-50", "Store team moves to 50 % as a chart"),
                ("svg-75", "Store team moves to 75 % as a chart"),
            ],
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        settings.told.check()?;
        Ok(runs(0..areas().count(), |_| settings.told.runs))
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let area = areas().nth(run.at).unwrap_or(OPEN);
        let description = if ROOMS.contains(&area) { area.to_owned() } else { format!("walls:15x15:{area}") };
        let seed = run.seed(settings.told.seed);
        let layout = generated(&description, seed)?;
        let limits = Limits { until: Some(Milestone::ThreeQuarters), ..stopping(settings.max_moves) };
        let mut outcomes = [Outcome::default(); 7];
        for (outcome, who) in outcomes.iter_mut().zip(Contender::all(settings.told.pool)) {
            *outcome = who.run(&settings.told, &layout, seed, limits)?;
        }
        Ok(outcomes)
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let area = |(place, area): (usize, &'static str)| {
            let teams = of_teams(&results, place);
            let all = Contender::all(settings.told.pool);
            let races = |one: &[&Outcome], other: &[&Outcome]| {
                MILESTONES.map(|milestone| {
                    let both = one.iter().zip(other);
                    Race::of(both.map(|(one, other)| (one.reached(milestone), other.reached(milestone))))
                })
            };
            let line = |(who, outcomes): (Contender, &Vec<&Outcome>)| {
                let pool = match who {
                    Contender::Rival { search: Search::Full, links, .. } => {
                        let pool = Contender::pool(settings.told.pool, links);
                        all.iter().position(|&other| other == pool)
                    }
                    Contender::Rival { search: Search::Pool(_), .. }
                    | Contender::Chain(_)
                    | Contender::Reel => None,
                };
                Line {
                    who,
                    milestones: MILESTONES.map(|milestone| Times::of(outcomes, milestone)),
                    races: races(&teams[0], outcomes),
                    pools: pool.map(|place| races(outcomes, &teams[place])),
                }
            };
            Area { area, teams: all.into_iter().zip(&teams).map(line).collect() }
        };
        let areas: Vec<Area> = areas().enumerate().map(area).collect();
        Ok(Summary { settings: *settings, areas })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let RivalSettings { runs, seed, patience, pool, .. } = settings.told;
        let mut text = format!(
            "{ROBOTS} robots in walls:15x15:DENSITY and two buildings, {} a point, seeds from {seed}; means with 95 % \
             intervals (reached / runs); a run stops when a robot has entered {}, and is stuck after {} without \
             gain\n",
            counted(runs, "layout"),
            counted(settings.max_moves, "cell"),
            counted(patience, "team move"),
        );
        for (place, milestone) in MILESTONES.iter().enumerate() {
            let mut columns = Columns::of(&merged.areas)
                .title(format!("Team moves to {} %", milestone.percent()))
                .left("density", |area| area.area);
            for (team, who) in Contender::all(pool).into_iter().enumerate() {
                columns = columns.right(who.name(), move |area| area.teams[team].milestones[place].text());
            }
            text += &columns.text();
        }
        text += "\nby: the team moves of the one less those of the other on the same layout, the mean, where both get \
                 there on\nall; then it decides, and else who is sooner more often\ntimes: how many times the \
                 rival's team moves the chain as published takes on the same layout, the median\nsooner, even, later: \
                 the chain on the same layouts; who never gets there is later than any\nlow densities are those to \
                 0.01, as the paper says of 75 %\n";
        Ok(text)
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        judged(&merged.areas, merged.settings.told.pool)
    }

    /// The medians by density.
    fn draw(&self, place: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        let teams = merged.areas.first().map_or(&[][..], |area| &area.teams);
        let series = |(team, line): (usize, &Line)| {
            let points = merged.areas.iter().filter_map(move |Area { area, teams }| {
                let Times { mean, median, .. } = teams.get(team)?.milestones[place];
                let x = area.parse().ok()?;
                mean.map(|mean| Point::of(x, mean)).or(median.map(|median| Point::plain(x, median.into())))
            });
            Series::measured(line.who.name(), points)
        };
        let percent = MILESTONES[place].percent();
        let title =
            format!("Until {percent} % is explored; a line ends where half of the runs never get there");
        let (x, y) = (Axis::new("density of walls", ""), Axis::new("team moves", "").showing([0.0, 0.0]));
        Ok(LineChart::new(title, x, y, teams.iter().enumerate().map(series)).svg())
    }
}

/// A sentence's claim about the chain and a rival.
#[derive(Clone, Copy)]
enum Claim {
    Sooner,
    Later,
    /// Later, and the rival is the best of the three.
    Last,
    Alike,
}

/// The sentences of Section E about Fig. 3.
fn judged(areas: &[Area], pool: u32) -> Vec<Judgement> {
    type Rival = fn(u32, Links) -> Contender;
    type Sentence<'a> = (&'static str, (usize, Rival, &'a [&'a str], Claim));
    let (full, reference): (Rival, Rival) = (|_, links| Contender::full(links), Contender::pool);
    let sentences: [Sentence<'_>; 9] = [
        (
            "50 %: “definitely better than the reference … for an obstacle-free area or low obstacle density”",
            (0, reference, &DENSITIES[..2], Claim::Sooner),
        ),
        (
            "50 %: “for higher obstacle densities the performances of the two methods are similar”",
            (0, reference, &DENSITIES[2..], Claim::Alike),
        ),
        (
            "50 %: “at zero and 0.01 densities” chain and Full search take “almost the same” time",
            (0, full, &DENSITIES[..2], Claim::Alike),
        ),
        (
            "50 %: “for higher densities the Full search method performs better”",
            (0, full, &DENSITIES[2..], Claim::Later),
        ),
        (
            "75 %: “for low densities (zero and 0.01) … better than the other two”: Full search",
            (1, full, &DENSITIES[..2], Claim::Sooner),
        ),
        (
            "75 %: “for low densities (zero and 0.01) … better than the other two”: the reference",
            (1, reference, &DENSITIES[..2], Claim::Sooner),
        ),
        (
            "75 %: “beyond ρ=0.01 the Full search method achieves the best results”",
            (1, full, &DENSITIES[2..], Claim::Last),
        ),
        (
            "75 %: “definitely better than the reference method for all examined obstacle densities”",
            (1, reference, &DENSITIES, Claim::Sooner),
        ),
        (
            "75 %: those without a chain “can be faster in an area with many random obstacles” (IV)",
            (1, reference, &DENSITIES[5..], Claim::Later),
        ),
    ];
    let mut judged = half_of_full(areas);
    for (sentence, (place, rival, densities, says)) in sentences {
        for links in [Links::Safe, Links::Covered] {
            for Area { area, teams } in areas.iter().filter(|area| densities.contains(&area.area)) {
                let find = |who| teams.iter().find(|line| line.who == who);
                let chain = find(Contender::Chain(RuleName::Published));
                let (Some(chain), Some(rival)) = (chain, find(rival(pool, links))) else { continue };
                let (race, best) = (rival.races[place], rival.pools.map(|races| races[place]));
                let verdict = match says {
                    Claim::Sooner => race.is_won(),
                    Claim::Later => race.is_lost(),
                    Claim::Last => race.is_lost().and(best.map_or(Verdict::Open, Race::is_won)),
                    Claim::Alike => race.is_alike(),
                };
                let other = best.filter(|_| matches!(says, Claim::Last));
                let measured = format!(
                    "{} against {}: {}{}",
                    chain.milestones[place].text(),
                    rival.milestones[place].text(),
                    race.text(),
                    other.map_or_else(String::new, |best| format!("; it against the pool: {}", best.text()))
                );
                let of = format!("{area}, {}", links.symbol());
                judged.push(Judgement::new(sentence, of, measured, verdict));
            }
        }
    }
    judged
}

/// Team moves in which a chain without walls can explore half of the cells; a test of CHAIN-26 plays them.
const HALF_BY_CHAIN: f64 = 32.0;

/// Whether Full search is optimal to 50 % without walls.
fn half_of_full(areas: &[Area]) -> Vec<Judgement> {
    let open = areas.iter().find(|area| area.area == DENSITIES[0]);
    let half = |links: Links| {
        let line = open?.teams.iter().find(|line| line.who == Contender::full(links))?;
        let times = line.milestones[0];
        Some(Judgement::new(
            "50 %: “seems to be also optimal in the obstacle free case when only half of the cells must be explored”",
            format!("{}, {}", DENSITIES[0], links.symbol()),
            format!("{} where a chain can take {HALF_BY_CHAIN}", times.text()),
            within([0.0, HALF_BY_CHAIN], times.ends()),
        ))
    };
    [Links::Safe, Links::Covered].into_iter().filter_map(half).collect()
}
