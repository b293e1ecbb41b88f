//! Table I: team moves without walls, and how much of two buildings is explored when MAX_MOVES ends the run; and how
//! far the rivals' figures depend on what the paper does not say.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_proofs::plural::counted;

use super::super::parameter::{Parameter, put, shown};
use super::super::{About, Observer, Table};
use super::asked::{Told, parameters};
use super::claims::{self, Judged, Verdict};
use super::{OPEN, Outcome, ROBOTS, ROOMS, Times, Who, generated, stopping};
use crate::rivals::{Cells, Links, Search};
use tautline_field::stats::{Estimate, rounded};
use tautline_sim::diagnostic::Halt;
use tautline_sim::explore::{Limits, Milestone, RuleName};
use tautline_sim::text_table::{Column, TextTable, Width};
use tautline_sim::value_parser::within;

/// Table I.
#[derive(Clone, Copy, Debug)]
pub struct ChainTable1;

/// The pools whose results are compared.
const POOLS: [u32; 4] = [50, 200, 1000, 10_000];

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    told: Told,
    /// MAX_MOVES of the runs in buildings.
    max_moves: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { told: Told::new(50), max_moves: 400 }
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

/// A run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    place: Place,
    who: Who,
    seed: u64,
}

/// Where it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
enum Place {
    Open,
    Rooms(usize),
}

/// What comes of a run.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Measured(Outcome);

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    settings: Settings,
    /// Team moves without walls.
    open: Vec<Line>,
    /// What is explored of buildings.
    rooms: Vec<Share>,
    paper: Vec<Printed>,
    sentences: Vec<Judged>,
}

#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Line {
    who: Who,
    milestones: [Times; Milestone::ALL.len()],
}

#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Share {
    room: &'static str,
    who: Who,
    /// Percent of the cells.
    explored: Option<Estimate>,
    /// Runs that explored all.
    whole: u32,
    runs: u32,
}

/// A figure that the paper prints, and ours.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Printed {
    what: String,
    paper: f64,
    ours: Option<f64>,
    difference: Option<f64>,
    /// Runs that get there, or all for a share.
    reached: u32,
    runs: u32,
}

impl Table for ChainTable1 {
    type Settings = Settings;
    type Job = Job;
    type Measured = Measured;
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "chain-table1",
            shows: "the chain against Full search and Rooker and Birk's pool: team moves without walls, what is explored of two \
                    buildings, and what the rivals' figures depend on",
            help: "Table I of the chain's paper: the chain against Full search and a pool of random team moves",
            more: "Rivals have links by E_S or by E_C, in cells of their own or not; the paper does not say which. Where not \
                   all runs get there, the median counts the others as later than any.",
            examples: &["chain-table1", "chain-table1 --runs 200 --pool 200 --format json"],
            doing: "comparing",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        let runs = Parameter::one(
            "runs",
            "COUNT",
            "Runs of each rival",
            |all: &Settings| shown(&all.told.runs),
            |all, texts| put(&mut all.told.runs, texts, |text| within(text, &(1..=100_000_i64))),
        );
        let most = Parameter::one(
            "max-moves",
            "CELLS",
            "In buildings a run stops when a robot has entered so many cells",
            |all: &Settings| shown(&all.max_moves),
            |all, texts| put(&mut all.max_moves, texts, |text| within(text, &(1..=1_000_000_i64))),
        );
        [runs].into_iter().chain(parameters()).chain([most]).collect()
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        settings.told.check()?;
        let Told { runs, seed, pool, .. } = settings.told;
        let open = teams(pool).into_iter().map(|who| (Place::Open, who));
        let rooms = (0..ROOMS.len()).flat_map(|room| Who::all(pool).map(|who| (Place::Rooms(room), who)));
        let all = open.chain(rooms).flat_map(|(place, who)| {
            let runs = if who.is_chancy() { runs } else { 1 };
            (0..runs).map(move |run| Job { place, who, seed: seed.wrapping_add(run.into()) })
        });
        Ok(all.collect())
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Measured, Halt> {
        let (layout, limits) = match job.place {
            Place::Open => (OPEN, Limits::default()),
            Place::Rooms(room) => (ROOMS.get(room).copied().unwrap_or(OPEN), stopping(settings.max_moves)),
        };
        job.who.run(&settings.told, &generated(layout, 0)?, job.seed, limits).map(Measured)
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Measured)>) -> Result<Merged, Halt> {
        let of = |place: Place, who: Who| -> Vec<&Outcome> {
            let these = results.iter().filter(|(job, _)| job.place == place && job.who == who);
            these.map(|(_, Measured(outcome))| outcome).collect()
        };
        let pool = settings.told.pool;
        let line = |who| {
            let outcomes = of(Place::Open, who);
            Line { who, milestones: Milestone::ALL.map(|milestone| Times::of(&outcomes, milestone)) }
        };
        let open: Vec<Line> = teams(pool).into_iter().map(line).collect();
        let share = |room: usize, who| {
            let outcomes = of(Place::Rooms(room), who);
            let explored: Vec<f64> = outcomes.iter().map(|outcome| outcome.explored()).collect();
            let whole = outcomes.iter().filter(|outcome| outcome.explored == outcome.cells).count() as u32;
            let explored = Estimate::of_values(&explored).map(|explored| rounded(explored, 100.0));
            Share { room: ROOMS[room], who, explored, whole, runs: outcomes.len() as u32 }
        };
        let rooms: Vec<Share> =
            (0..ROOMS.len()).flat_map(|room| Who::all(pool).map(|who| share(room, who))).collect();
        let (paper, sentences) = (printed(&open, &rooms, pool), judged(&open, &rooms, pool));
        Ok(Merged { settings: *settings, open, rooms, paper, sentences })
    }

    fn text(&self, settings: &Settings, merged: &Merged) -> Result<String, Halt> {
        let Settings { told: Told { runs, seed, patience, .. }, max_moves } = settings;
        let mut text = format!(
            "{ROBOTS} robots, {} of each rival, seeds from {seed}; means with 95 % intervals (reached / runs); stuck after {} \
             without gain\n",
            counted(*runs, "run"),
            counted(*patience, "team move"),
        );
        let numbers = [9, 14, 11, 10].map(|width| Column::right(Width::Of(width)));
        let mut columns = TextTable::new([Column::left(Width::Fit)].into_iter().chain(numbers));
        columns.title("What the paper prints");
        columns.row(["", "paper", "ours", "difference", "reached"]);
        for Printed { what, paper, ours, difference, reached, runs } in &merged.paper {
            let or_dash = |number: Option<String>| number.unwrap_or_else(|| "-".to_owned());
            columns.row([
                what.clone(),
                format!("{paper:.0}"),
                or_dash(ours.map(|ours| format!("{ours:.1}"))),
                or_dash(difference.map(|difference| format!("{difference:+.1}"))),
                format!("{reached}/{runs}"),
            ]);
        }
        text += &columns.text();
        let mut columns = TextTable::new([
            Column::left(Width::Fit),
            Column::right(Width::Fit),
            Column::right(Width::Fit),
            Column::right(Width::Fit),
        ]);
        columns.title(format!("Team moves in {OPEN} until so much is explored"));
        columns.row(["team", "50 %", "75 %", "100 %"]);
        for Line { who, milestones } in &merged.open {
            columns.row([who.name()].into_iter().chain(milestones.iter().map(Times::text)));
        }
        text += &columns.text();
        let mut columns = TextTable::new([
            Column::left(Width::Fit),
            Column::left(Width::Fit),
            Column::right(Width::Fit),
            Column::right(Width::Fit),
        ]);
        columns.title(format!(
            "Percent explored when a robot has entered {max_moves} cells, or the team is stuck"
        ));
        columns.row(["area", "team", "explored %", "all explored"]);
        for Share { room, who, explored, whole, runs } in &merged.rooms {
            columns.row([
                (*room).to_owned(),
                who.name(),
                Estimate::text_or_dash(*explored, 1),
                format!("{whole}/{runs}"),
            ]);
        }
        text += &columns.text();
        Ok(text + "\nWhat the paper says\n" + &claims::text(&merged.sentences))
    }
}

/// Both chains, then the rivals by links, cells and pools.
fn teams(pool: u32) -> Vec<Who> {
    let mut pools: Vec<u32> = POOLS.into_iter().chain([pool]).collect();
    pools.sort_unstable();
    pools.dedup();
    let searches: Vec<Search> = pools.into_iter().map(Search::Pool).chain([Search::Full]).collect();
    let mut teams = vec![Who::Chain(RuleName::Published), Who::Chain(RuleName::Repaired)];
    for links in [Links::Safe, Links::Covered] {
        for cells in [Cells::Distinct, Cells::Shared] {
            teams.extend(searches.iter().map(|&search| Who::Rival { search, links, cells }));
        }
    }
    teams
}

fn whole(open: &[Line], who: Who) -> Option<Times> {
    open.iter().find(|line| line.who == who).map(|line| line.milestones[Milestone::Whole as usize])
}

/// The paper's figures: 62, and by its words about twice and six times that; 70 and 80 %, 25 and 43 %.
fn printed(open: &[Line], rooms: &[Share], pool: u32) -> Vec<Printed> {
    let times = |who: Who, paper: f64| {
        let Times { runs, reached, .. } = whole(open, who)?;
        let ours = whole(open, who).and_then(|times| times.middle());
        let difference = ours.map(|ours| ours - paper);
        Some(Printed {
            what: format!("team moves to 100 %: {}", who.name()),
            paper,
            ours,
            difference,
            reached,
            runs,
        })
    };
    let chain = Who::Chain(RuleName::Published);
    let moves = [
        times(chain, 62.0),
        times(Who::full(Links::Safe), 124.0),
        times(Who::full(Links::Covered), 124.0),
        times(Who::pool(pool, Links::Safe), 372.0),
        times(Who::pool(pool, Links::Covered), 372.0),
    ];
    let shares = rooms.iter().filter_map(|share| {
        let first = share.room == ROOMS[0];
        let paper = match share.who {
            Who::Chain(RuleName::Published) | Who::Rival { search: Search::Full, .. } => {
                if first {
                    70.0
                } else {
                    80.0
                }
            }
            Who::Rival { search: Search::Pool(_), .. } => {
                if first {
                    25.0
                } else {
                    43.0
                }
            }
            Who::Chain(RuleName::Repaired) => return None,
        };
        let ours = share.explored.map(|explored| explored.mean);
        let what = format!("% of {}: {}", share.room, share.who.name());
        let difference = ours.map(|ours| ours - paper);
        Some(Printed { what, paper, ours, difference, reached: share.runs, runs: share.runs })
    });
    moves.into_iter().flatten().chain(shares).collect()
}

/// The sentences of Section E about Table I.
fn judged(open: &[Line], rooms: &[Share], pool: u32) -> Vec<Judged> {
    let mut judged = Vec::new();
    let chain = whole(open, Who::Chain(RuleName::Published)).and_then(|times| times.middle());
    let said = chain.map_or_else(|| "-".to_owned(), |chain| format!("{chain:.0}"));
    let verdict = Verdict::of(chain.is_some_and(|chain| (chain - 62.0).abs() < 0.5));
    judged.push(Judged {
        sentence: "“62 time units … the minimal theoretical value of 9(N−1)−1”",
        of: "chain".to_owned(),
        measured: said,
        verdict,
    });
    for (sentence, factor, search) in [
        ("“about half of that of the Full search method”", 2.0, Search::Full),
        ("“one sixth of that of the reference method”", 6.0, Search::Pool(pool)),
    ] {
        for links in [Links::Safe, Links::Covered] {
            let times = whole(open, Who::Rival { search, links, cells: Cells::Distinct });
            let ratio = times.and_then(|times| Some(times.mean?.mean / chain?));
            let measured = match (times, ratio) {
                (Some(_), Some(ratio)) => format!("{ratio:.2} times"),
                (Some(Times { runs, reached, .. }), None) => format!("{reached} of {runs} get there"),
                (None, _) => "-".to_owned(),
            };
            let of = format!("links by {}", links.symbol());
            judged.push(Judged { sentence, of, measured, verdict: Verdict::about(factor, ratio) });
        }
    }
    let explored = |room: &str, who: Who| {
        let share = rooms.iter().find(|share| share.room == room && share.who == who);
        share.and_then(|share| share.explored).map_or(0.0, |explored| explored.mean)
    };
    for room in ROOMS {
        let never =
            rooms.iter().filter(|share| share.room == room && share.who != Who::Chain(RuleName::Repaired));
        let (mut all, mut runs) = (0, 0);
        for share in never {
            (all, runs) = (all + share.whole, runs + share.runs);
        }
        judged.push(Judged {
            sentence: "“all three algorithms stopped before the 100 % exploration success”",
            of: room.to_owned(),
            measured: format!("{all} of {runs} runs explore all"),
            verdict: Verdict::of(all == 0),
        });
    }
    for room in ROOMS {
        for links in [Links::Safe, Links::Covered] {
            let ours = explored(room, Who::Chain(RuleName::Published));
            let [full, pool] = [Who::full(links), Who::pool(pool, links)].map(|who| explored(room, who));
            let of = format!("{room}, links by {}", links.symbol());
            judged.push(Judged {
                sentence: "“the proposed and the Full search algorithms have similar success rates”",
                of: of.clone(),
                measured: format!("chain {ours:.0} %, Full search {full:.0} %"),
                verdict: Verdict::alike(Some(ours), Some(full)),
            });
            judged.push(Judged {
                sentence: "“much better … than the reference algorithm having only 25% and 43%”",
                of,
                measured: format!("chain {ours:.0} %, Full search {full:.0} %, pool {pool:.0} %"),
                verdict: Verdict::of(ours > 1.5 * pool && full > 1.5 * pool),
            });
        }
    }
    judged.sort_by_key(|judged| judged.sentence.starts_with("“much"));
    judged
}
