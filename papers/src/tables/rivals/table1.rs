//! Table I: team moves without walls, and how much of two buildings is explored when MAX_MOVES ends the run; and how
//! far the rivals' figures depend on what the paper does not say.

use super::super::prelude::*;
use super::claims::{about, alike, or_never};
use super::parameters::{ROBOTS, RivalSettings};
use super::{Contender, MAX_MOVES, OPEN, Outcome, ROOMS, Times, stopping};
use crate::rivals::{Cells, Links, Search};
use tautline_sim::explore::{Milestone, RuleName};

/// Table I.
#[derive(Clone, Copy, Debug)]
pub struct ChainTable1;

/// How many times as much “much better” is. The paper gives no number.
const MUCH_BETTER: f64 = 1.5;

/// The pools whose results are compared.
const POOLS: [u32; 4] = [50, 200, 1000, 10_000];

settings! {
    /// How much is measured.
    #[derive(Copy)]
    pub struct Settings {
        /// The parameters of the rivals
        told: RivalSettings = RivalSettings::default(), nested();
        /// A run stops when a robot has entered so many cells
        max_moves: u32 = MAX_MOVES, one("max-moves", "CELLS", from_to(1..=1_000_000));
    }
}

/// A run of a team in an area.
type Job = Run<(Place, Contender)>;

/// Where it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub enum Place {
    Open,
    Rooms(usize),
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    settings: Settings,
    /// Team moves without walls.
    open: Vec<Line>,
    /// The explored shares of buildings.
    rooms: Vec<Share>,
    paper: Vec<PrintedFigure>,
}

#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Line {
    who: Contender,
    milestones: [Times; Milestone::ALL.len()],
}

#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Share {
    room: &'static str,
    who: Contender,
    /// Percent of the cells.
    explored: Option<Estimate>,
    /// Runs that explored all.
    whole: u32,
    /// Runs that were stopped since a robot had entered as many cells as it may.
    stopped: u32,
    runs: u32,
}

/// A figure that the paper prints, and ours.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct PrintedFigure {
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
    type Sample = Outcome;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "chain-table1",
            shows: "the chain against Full search and Rooker and Birk's pool: team moves without walls, what is \
                    explored of two buildings, and what the rivals' figures depend on",
            help: "Table I of the chain's paper: the chain against Full search and a pool of random team moves",
            more: "Rivals have links by E_S or by E_C, in cells of their own or not; the paper does not say which. \
                   Where not all runs get there, the median counts the others as later than any.",
            examples: &["chain-table1", "chain-table1 --runs 200 --pool 200 --format json"],
            doing: "comparing",
            takes: "half a minute",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        settings.told.check()?;
        let RivalSettings { runs: count, pool, .. } = settings.told;
        let open = teams(pool).into_iter().map(|who| (Place::Open, who));
        let rooms = pairs((0..ROOMS.len()).map(Place::Rooms), Contender::all(pool));
        Ok(runs(open.chain(rooms), |(_, who)| if who.is_chancy() { count } else { 1 }))
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Outcome, Halt> {
        let (place, who) = run.at;
        let layout = match place {
            Place::Open => OPEN,
            Place::Rooms(room) => ROOMS.get(room).copied().unwrap_or(OPEN),
        };
        let limits = stopping(settings.max_moves);
        who.run(&settings.told, &generated(layout, 0)?, run.seed(settings.told.seed), limits)
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let pool = settings.told.pool;
        let line = |who| {
            let outcomes = at(&results, (Place::Open, who));
            Line { who, milestones: Milestone::ALL.map(|milestone| Times::of(&outcomes, milestone)) }
        };
        let open: Vec<Line> = teams(pool).into_iter().map(line).collect();
        let share = |(room, who)| {
            let outcomes = at(&results, (Place::Rooms(room), who));
            Share {
                room: ROOMS[room],
                who,
                explored: mean(outcomes.iter().map(|outcome| outcome.explored()))
                    .map(|explored| rounded(explored, 100.0)),
                whole: count(&outcomes, |outcome| outcome.explored == outcome.cells),
                stopped: count(&outcomes, |outcome| outcome.is_stopped),
                runs: outcomes.len() as u32,
            }
        };
        let rooms: Vec<Share> = pairs(0..ROOMS.len(), Contender::all(pool)).map(share).collect();
        let paper = printed(&open, &rooms, pool);
        Ok(Summary { settings: *settings, open, rooms, paper })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let Settings { told: RivalSettings { runs, seed, patience, .. }, max_moves } = settings;
        let heading = format!(
            "{ROBOTS} robots, {} of each rival, seeds from {seed}; means with 95 % intervals \
             (reached / runs); a run stops when a robot has entered {}, and is stuck after {} without gain\n",
            counted(*runs, "run"),
            counted(*max_moves, "cell"),
            counted(*patience, "team move"),
        );
        let signed = |off: Option<f64>| off.map_or("-".to_owned(), |off| format!("{off:+.1}"));
        let paper = Columns::of(&merged.paper)
            .title("What the paper prints")
            .left("", |line| &line.what)
            .number("paper", 0, |line| line.paper)
            .number("ours", 1, |line| line.ours)
            .right("difference", move |line| signed(line.difference))
            .right("reached", |line| format!("{}/{}", line.reached, line.runs));
        let mut open = Columns::of(&merged.open)
            .title(format!("Team moves in {OPEN} until so much is explored"))
            .left("team", |line| line.who.name());
        for (place, milestone) in Milestone::ALL.into_iter().enumerate() {
            let percent = format!("{} %", milestone.percent());
            open = open.right(percent, move |line| line.milestones[place].text());
        }
        let rooms = Columns::of(&merged.rooms)
            .title("Percent explored when a run is over; runs that explored all, and that were stopped")
            .left("area", |share| share.room)
            .left("team", |share| share.who.name())
            .estimate("explored %", 1, |share| share.explored)
            .right("all explored", |share| format!("{}/{}", share.whole, share.runs))
            .right("stopped", |share| format!("{}/{}", share.stopped, share.runs));
        Ok([&heading, &paper.text(), &open.text(), &rooms.text()].map(String::as_str).concat())
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        judged(&merged.open, &merged.rooms, merged.settings.told.pool)
    }
}

/// Our own teams, then the rivals by links, cells and pools.
fn teams(pool: u32) -> Vec<Contender> {
    let mut pools: Vec<u32> = POOLS.into_iter().chain([pool]).collect();
    pools.sort_unstable();
    pools.dedup();
    let searches: Vec<Search> = pools.into_iter().map(Search::Pool).chain([Search::Full]).collect();
    let mut teams = Contender::OURS.to_vec();
    for links in [Links::Safe, Links::Covered] {
        for cells in [Cells::Distinct, Cells::Shared] {
            teams.extend(searches.iter().map(|&search| Contender::Rival { search, links, cells }));
        }
    }
    teams
}

fn whole(open: &[Line], who: Contender) -> Option<Times> {
    open.iter().find(|line| line.who == who).map(|line| line.milestones[Milestone::Whole as usize])
}

/// The paper's figures: 62, and by its words about twice and six times that; 70 and 80 %, 25 and 43 %.
fn printed(open: &[Line], rooms: &[Share], pool: u32) -> Vec<PrintedFigure> {
    let printed = |what, paper: f64, ours: Option<f64>, reached, runs| {
        let difference = ours.map(|ours| ours - paper);
        PrintedFigure { what, paper, ours, difference, reached, runs }
    };
    let moves = [
        (Contender::Chain(RuleName::Published), 62.0),
        (Contender::full(Links::Safe), 124.0),
        (Contender::full(Links::Covered), 124.0),
        (Contender::pool(pool, Links::Safe), 372.0),
        (Contender::pool(pool, Links::Covered), 372.0),
    ];
    let moves = moves.into_iter().filter_map(|(who, paper)| {
        let times = whole(open, who)?;
        let what = format!("team moves to 100 %: {}", who.name());
        Some(printed(what, paper, times.middle(), times.reached, times.runs))
    });
    let shares = rooms.iter().filter_map(|share| {
        let [first, second] = match share.who {
            Contender::Chain(RuleName::Published) | Contender::Rival { search: Search::Full, .. } => {
                [70.0, 80.0]
            }
            Contender::Rival { search: Search::Pool(_), .. } => [25.0, 43.0],
            Contender::Chain(RuleName::Repaired) | Contender::Reel => return None,
        };
        let paper = if share.room == ROOMS[0] { first } else { second };
        let what = format!("% of {}: {}", share.room, share.who.name());
        Some(printed(what, paper, share.explored.map(|explored| explored.mean), share.runs, share.runs))
    });
    moves.chain(shares).collect()
}

/// The sentences about the buildings, in their order.
const OF_ROOMS: [&str; 4] = [STOPPED, ALIKE, BETTER, AHEAD];
const STOPPED: &str =
    "“all three algorithms stopped before the 100% … because one of the robots reached the MAX_MOVES”";
const ALIKE: &str = "“the proposed and the Full search algorithms have similar success rates”";
const BETTER: &str = "“in the first case the former is better and in the second case the latter”";
const AHEAD: &str = "“much better … than the reference algorithm having only 25% and 43%”";

/// The sentences of Section E about Table I.
fn judged(open: &[Line], rooms: &[Share], pool: u32) -> Vec<Judgement> {
    let mut judged = Vec::new();
    let chain = whole(open, Contender::Chain(RuleName::Published)).and_then(|times| times.middle());
    judged.push(Judgement::new(
        "“62 time units … the minimal theoretical value of 9(N−1)−1”",
        "chain",
        plain(chain, 0),
        Verdict::of(chain.is_some_and(|chain| (chain - 62.0).abs() < 0.5)),
    ));
    for (sentence, factor, search) in [
        ("“about half of that of the Full search method”", 2.0, Search::Full),
        ("“one sixth of that of the reference method”", 6.0, Search::Pool(pool)),
    ] {
        for links in [Links::Safe, Links::Covered] {
            let times = whole(open, Contender::Rival { search, links, cells: Cells::Distinct });
            let (Some(times), Some(chain)) = (times, chain) else { continue };
            let ratio = times.ends().map(|ends| ends.map(|end| end / chain));
            let get_there = format!("{} of {} get there", times.reached, times.runs);
            let measured = match (times.mean, times.middle(), ratio) {
                (Some(mean), ..) => format!("{} times", mean.times(1.0 / chain).text(2)),
                (None, Some(median), Some(ends)) => {
                    format!("median {} times; {get_there}", or_never(median / chain, Some(ends)))
                }
                (None, ..) => get_there,
            };
            let of = format!("links by {}", links.symbol());
            judged.push(Judgement::new(sentence, of, measured, about(factor, ratio)));
        }
    }
    judged.extend(pronounced(open, pool));
    for (place, room) in ROOMS.into_iter().enumerate() {
        for links in [Links::Safe, Links::Covered] {
            let who =
                [Contender::Chain(RuleName::Published), Contender::full(links), Contender::pool(pool, links)];
            let find = |who| rooms.iter().find(|share| (share.room, share.who) == (room, who));
            let [Some(chain), Some(full), Some(pool)] = who.map(find) else { continue };
            let of = format!("{room}, links by {}", links.symbol());
            let stopped = |share: &Share| {
                let Share { stopped, runs, who, .. } = *share;
                let all = always(Estimate::share(stopped, runs));
                if who.is_chancy() { all } else { Verdict::of(stopped == runs) }
            };
            let all = [chain, full, pool];
            let [of_chain, of_full, of_pool] = all.map(|share| format!("{}/{}", share.stopped, share.runs));
            judged.push(Judgement::new(
                STOPPED,
                of.clone(),
                format!("chain {of_chain}, Full search {of_full}, pool {of_pool}"),
                all.map(stopped).into_iter().fold(Verdict::Holds, Verdict::and),
            ));
            let [chain, full, pool] = all.map(|share| share.explored.unwrap_or(Estimate::NOTHING));
            let chain = chain.mean;
            let measured = format!("chain {chain:.1} %, Full search {} %", full.text(1));
            judged.push(Judgement::new(ALIKE, of.clone(), measured.clone(), alike(chain, full.interval)));
            let chain_leads = below(full.interval, Some([chain; 2]));
            let is_so = if place == 0 { chain_leads } else { chain_leads.contrary() };
            judged.push(Judgement::new(BETTER, of.clone(), measured.clone(), is_so));
            let much_better = |ends| below(pool.times(MUCH_BETTER).interval, ends);
            let is_so = much_better(Some([chain; 2])).and(much_better(full.interval));
            judged.push(Judgement::new(AHEAD, of, format!("{measured}, pool {} %", pool.text(1)), is_so));
        }
    }
    let place = |judged: &Judgement| OF_ROOMS.iter().position(|&sentence| sentence == judged.sentence);
    judged.sort_by_key(place);
    judged
}

/// Whether the chain is ahead of each rival without walls, and the more so the more is to be explored.
fn pronounced(open: &[Line], pool: u32) -> impl Iterator<Item = Judgement> {
    let chain = open.iter().find(|line| line.who == Contender::Chain(RuleName::Published));
    let judged = move |who: Contender| {
        let (chain, rival) = (chain?, open.iter().find(|line| line.who == who)?);
        let times = [Milestone::Half, Milestone::ThreeQuarters, Milestone::Whole].map(|milestone| {
            let (chain, rival) = (chain.milestones[milestone as usize], rival.milestones[milestone as usize]);
            // Where fewer than half of the runs get there, by the whole interval, the median run never does.
            let is_rare = |share: Estimate| below(share.interval, Some([0.5; 2])) == Verdict::Holds;
            let never =
                Estimate::share(rival.reached, rival.runs).is_some_and(is_rare).then_some(f64::INFINITY);
            let ends = rival.ends().or(never.map(|never| [never; 2]));
            let (times, chain) = (rival.middle().or(never)?, chain.middle()?);
            Some((times / chain, ends.map(|ends| ends.map(|end| end / chain))))
        });
        let ends = times.map(|times| times?.1);
        let text = times.map(|times| times.map_or("-".to_owned(), |(times, ends)| or_never(times, ends)));
        let measured =
            format!("{} times as long to 50 %, {} to 75 %, {} to 100 %", text[0], text[1], text[2]);
        Some([
            Judgement::new(
                "“performs better than the chosen reference methods … when high (75% or 100%) exploration ratio is \
                 necessary” (abstract)",
                who.name(),
                measured.clone(),
                below(Some([1.0; 2]), ends[1]).and(below(Some([1.0; 2]), ends[2])),
            ),
            Judgement::new(
                "at 100 % “The advantage of the proposed method is the most pronounced” (E)",
                who.name(),
                measured,
                below(ends[0], ends[2]).and(below(ends[1], ends[2])),
            ),
        ])
    };
    let rivals = [Links::Safe, Links::Covered].into_iter();
    let rivals = rivals.flat_map(move |links| [Contender::full(links), Contender::pool(pool, links)]);
    let (better, most): (Vec<_>, Vec<_>) =
        rivals.filter_map(judged).map(|[better, most]| (better, most)).unzip();
    better.into_iter().chain(most)
}
