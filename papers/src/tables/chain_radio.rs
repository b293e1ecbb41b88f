//! The radio chain [Kovács 2011, I]: a robot with two radios keeps both its neighbours, one with a single radio is a
//! bridge that leaves the one to speak to the other. “This switching … takes between 3 and 6 seconds … Under this
//! period the network is not connected.” The bytes are those of real runs without walls: after each team move each
//! robot's byte goes to all others.
//!
//! *Two radios*: a byte needs one hop time for each link, and each link carries one byte each way in a hop time, so
//! that all bytes are everywhere after N−1 hop times. *Bridges*: R_2, R_4, … are masters of their neighbours, and never
//! switch; the ⌊(N−2)/2⌋ robots between two of them are slaves of both. Besides, each of these switches once before
//! the first byte of one end is at the other; that is the least, since bytes go both ways.

use tautline_kernel::chain::{Message, Outcome};
use tautline_kernel::ground::Circle;

use super::prelude::*;
use crate::nxt::Odometer;
use tautline_grids::chance::Dice;
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::{RuleName, Setup, explore};

/// The radio chain.
#[derive(Clone, Copy, Debug)]
pub struct ChainRadio;

/// The chains that are compared, the base counted: the paper's of three to seven robots, its team of eight, and big
/// ones, of which it gives no number.
const TEAMS: [u16; 10] = [3, 4, 5, 6, 7, 8, 16, 32, 64, 128];

/// The share of the time, in percent, that is “almost any moment”. The paper gives no number.
const ALMOST: f64 = 90.0;

/// How long a bridge's switch takes, in milliseconds.
const SWITCH_MS: [u64; 2] = [3000, 6000];

settings! {
    /// The settings of the table.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Runs of each chain
        runs: u32 = 200, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the durations
        seed: u64 = 0, one("seed", "SEED", number);
        /// How long a byte takes over one link; the paper does not say
        hop_ms: u64 = 30, one("hop-ms", "MS", from_to(1..=60_000));
    }
}

/// The runs of a chain of so many robots.
type Job = u16;

/// The result of one run.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Sample {
    team_moves: u32,
    bytes: u32,
    /// Team moves after which two neighbours are out of E_C.
    cut: u32,
    driving_ms: u64,
    /// Of each run, how long the bridges made the team wait.
    waiting_ms: Vec<u64>,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    settings: Settings,
    switch_ms: [u64; 2],
    lines: Vec<Line>,
}

#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
struct Line {
    robots: u16,
    team_moves: u32,
    bytes: u32,
    cut: u32,
    driving_minutes: f64,
    /// Until all bytes of a team move are everywhere.
    dual_s: f64,
    dual_minutes: f64,
    bridges_s: Option<Estimate>,
    bridges_minutes: Option<Estimate>,
    /// The share of the time in which a bridge is switching, in percent.
    switching: Option<Estimate>,
}

impl Table for ChainRadio {
    type Settings = Settings;
    type Job = Job;
    type Sample = Sample;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "chain-radio",
            shows: "a chain with two radios a robot against a scatternet of bridges, for three to 128 robots: how \
                    long the bytes of a team move take, and how long a run waits for them",
            help: "Two radios a robot against bridges that switch between two nets",
            more: "The bytes are those of runs without walls. A switch takes 3 to 6 s, all durations as likely. Every \
                   second robot is a master that never switches; that the others between them switch once a team move \
                   is the least that they need.",
            examples: &["chain-radio", "chain-radio --hop-ms 5 --format json"],
            doing: "sending",
            takes: "a second",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, _: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(TEAMS.into())
    }

    fn measure(&self, settings: &Settings, &robots: &Job, _: &dyn Observer) -> Result<Sample, Halt> {
        let side = u64::from(2 * robots - 1);
        let (layout, base) = based(Layout::open(side, side)?)?;
        let setup = Setup::new(&CHAIN, RuleName::Repaired, robots, layout, base);
        let mut odometer = Odometer::new(robots.into());
        let (mut log, mut cut) = (Vec::new(), 0);
        let report = explore(&setup, &mut |made| {
            odometer.make(made.before, made.frame);
            let moved = made.frame.steps.iter().zip(&made.frame.blocked).skip(1);
            log.extend(moved.map(|(&step, &blocked)| {
                let outcome = if blocked { Outcome::Blocked } else { Outcome::Arrived };
                Message { step, outcome }.encode()
            }));
            cut +=
                u32::from(made.frame.cells.windows(2).any(|pair| !Circle::COVERED.covers(pair[0], pair[1])));
            Ok(())
        })?;
        let mut tag = *b"switch 0";
        tag[7] += robots as u8;
        let mut dice = Dice::new(settings.seed, tag);
        let bridges = (u32::from(robots) - 2) / 2;
        let run = || (0..report.steps * bridges).map(|_| switch(&mut dice)).sum::<u64>();
        let hops = u64::from(report.steps) * u64::from(robots - 1) * settings.hop_ms;
        let waiting_ms: Vec<u64> =
            std::iter::repeat_with(run).take(settings.runs as usize).map(|ms| ms + hops).collect();
        let (team_moves, driving_ms) = (report.steps, odometer.milliseconds);
        Ok(Sample { team_moves, bytes: log.len() as u32, cut, driving_ms, waiting_ms })
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let lines = results
            .into_iter()
            .map(|(robots, measured)| Line::of(robots, &measured, settings.hop_ms))
            .collect();
        Ok(Summary { settings: *settings, switch_ms: SWITCH_MS, lines })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let [least, most] = SWITCH_MS.map(|ms| ms / 1000);
        let mut text = format!(
            "Chains without walls, a hop {} ms, a switch {least} to {most} s; means of {} with 95 % intervals\n\n",
            settings.hop_ms,
            counted(settings.runs, "run")
        );
        text += &Columns::of(&merged.lines)
            .right("robots", |line| line.robots)
            .right("moves", |line| line.team_moves)
            .right("bytes", |line| line.bytes)
            .right("moves cut", |line| line.cut)
            .number("driving min", 1, |line| line.driving_minutes)
            .number("dual s a move", 2, |line| line.dual_s)
            .number("min", 2, |line| line.dual_minutes)
            .estimate("bridges s a move", 1, |line| line.bridges_s)
            .estimate("min", 1, |line| line.bridges_minutes)
            .estimate("switching %", 0, |line| line.switching)
            .text();
        text += "\nmoves cut: after which two neighbours are out of E_C · switching: of driving and \
                 waiting, the share in which a bridge switches\n";
        Ok(text)
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let cut: u32 = merged.lines.iter().map(|line| line.cut).sum();
        let big = merged.lines.last();
        let switching = big.and_then(|line| line.switching);
        let sent = |which, links: fn(&Line) -> u32| {
            let bytes = |line: &Line| line.bytes * links(line) / (line.team_moves * moving(line));
            let most = merged.lines.iter().map(bytes).max().unwrap_or(0);
            let measured = format!("at most {} a robot and team move", counted(most, "byte"));
            Judgement::new(
                "“each robot sends only one byte in a step-cycle” (III.D)",
                which,
                measured,
                Verdict::of(most <= 1),
            )
        };
        vec![
            sent("of its own", |_| 1),
            // Each link carries the bytes of all robots, one way or the other.
            sent("those that it passes on, too", moving),
            Judgement::new(
                "“every nodes in the network is reachable continuously” (I)",
                "two radios, repaired rule, no walls",
                format!("{cut} team moves cut"),
                Verdict::of(cut == 0),
            ),
            Judgement::new(
                format!(
                    "“in a big (conventional) scatternet, in almost any moment there is an \
                     unconnected part”: {ALMOST:.0} %"
                ),
                big.map_or_else(String::new, |line| format!("bridges, {}", counted(line.robots, "robot"))),
                format!("at least {} % of the time", text(switching, 1)),
                switching.map_or(Verdict::Open, |switching| at_least(ALMOST, switching)),
            ),
        ]
    }
}

/// The robots that move, as many as there are links.
fn moving(line: &Line) -> u32 {
    u32::from(line.robots) - 1
}

/// How long a switch takes.
fn switch(dice: &mut Dice) -> u64 {
    let [least, most] = SWITCH_MS;
    least + dice.below(most - least + 1)
}

/// Minutes or seconds, to hundredths.
#[expect(clippy::cast_precision_loss, reason = "no run takes 2⁵³ milliseconds")]
fn of_ms(ms: u64, unit_ms: f64) -> f64 {
    ms as f64 / unit_ms
}

impl Line {
    fn of(robots: u16, measured: &Sample, hop_ms: u64) -> Self {
        let Sample { team_moves, bytes, cut, driving_ms, waiting_ms } = measured;
        let dual_ms = u64::from(robots - 1) * hop_ms;
        let mean = |of: &dyn Fn(u64) -> f64| {
            mean(waiting_ms.iter().map(|&ms| of(ms))).map(|mean| rounded(mean, 100.0))
        };
        let moves = f64::from(*team_moves);
        let hops = u64::from(*team_moves) * dual_ms;
        Self {
            robots,
            team_moves: *team_moves,
            bytes: *bytes,
            cut: *cut,
            driving_minutes: of_ms(*driving_ms, 60_000.0),
            dual_s: of_ms(dual_ms, 1000.0),
            dual_minutes: of_ms(hops, 60_000.0),
            bridges_s: mean(&|ms| of_ms(ms, 1000.0) / moves),
            bridges_minutes: mean(&|ms| of_ms(ms, 60_000.0)),
            switching: mean(&|ms| 100.0 * of_ms(ms - hops, 1.0) / of_ms(ms + driving_ms, 1.0)),
        }
    }
}
