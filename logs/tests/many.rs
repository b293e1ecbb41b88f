//! Many logs of runs of our own simulator, by rules that keep the clauses: the judge finds nothing in them, and finds
//! the one violation that is planted in each, whatever the form of the log, with stamps that are off, late or astray.

use std::collections::BTreeSet;

use tautline_grids::layout::{Layout, load};
use tautline_kernel::ground::Cell;
use tautline_logs::{Demand, Doubt, Grid, Group, Limits, Numbers, Tracks, Verdict, judge, read};
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::frontier::FRONTIER;
use tautline_sim::explore::kit::KIT;
use tautline_sim::explore::pack::PACK;
use tautline_sim::explore::{ExplorationRequest, Profile, RuleId, explore};

use super::forms::{self, Row};

/// Positions are right, and their stamps off by so much at most, in microseconds.
const NOISE_US: i64 = 30_000;
/// The time between positions of a robot, and that of a team move.
const PERIOD_US: i64 = 200_000;
const MOVE_US: i64 = 1_000_000;
const LIMITS: Limits = Limits { tolerance_mm: 200, gap_us: 1_000_000, jump_us: 60_000_000 };
const NAMES: [&str; 4] = ["/robot_1", "/robot_2", "/robot_3", "/robot_4"];

/// Random numbers (xorshift), the same on every machine.
struct Chance(u64);

impl Chance {
    fn below(&mut self, below: i64) -> i64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 11) % below.unsigned_abs()).cast_signed()
    }
}

/// A violation that is planted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Plant {
    /// The second robot is so far east of the first one, in millimetres.
    Beside(i32),
    /// Robots with these numbers, up to the last one, are in the middle of one cell.
    Together(usize),
    /// The log ends before the last cell is visited.
    End,
}

/// Runs of a scheme, and what is planted against which clauses.
struct Sort {
    scheme: &'static Profile,
    layout: &'static str,
    robots: usize,
    cell_mm: i32,
    clauses: &'static [(&'static str, Plant)],
}

const SORTS: [Sort; 4] = [
    Sort {
        scheme: &CHAIN,
        layout: "walls:7x7:0.15",
        robots: 4,
        cell_mm: 1_000,
        clauses: &[("CHAIN-3", Plant::Beside(4_000)), ("CHAIN-2", Plant::Together(1))],
    },
    Sort {
        scheme: &KIT,
        layout: "walls:5x5:0.1",
        robots: 2,
        cell_mm: 3_000,
        clauses: &[
            ("KIT-1", Plant::Beside(12_000)),
            ("KIT-3", Plant::Beside(1_500)),
            ("KIT-12", Plant::Beside(12_000)),
        ],
    },
    Sort {
        scheme: &FRONTIER,
        layout: "cells:5x5:0.1",
        robots: 2,
        cell_mm: 1_000,
        clauses: &[("FRONTIER-2", Plant::Together(0)), ("FRONTIER-1", Plant::End)],
    },
    Sort {
        scheme: &PACK,
        layout: "cells:9x9:0.2",
        robots: 3,
        cell_mm: 1_000,
        clauses: &[("PACK-2", Plant::Together(1))],
    },
];

/// A run: the cells of the robots at the start and after each team move.
struct Run {
    layout: Layout,
    cells: Vec<Vec<Cell>>,
}

fn run(sort: &Sort, seed: u64) -> Run {
    let layout = load(sort.layout, seed, None).expect("a layout");
    let asked = ExplorationRequest {
        robots: Some(sort.robots as u64),
        seed,
        ..ExplorationRequest::new(sort.scheme, RuleId::REPAIRED)
    };
    let setup = asked.setup(layout).expect("a setup");
    let mut cells = vec![setup.starts()];
    explore(&setup, &mut |made| {
        cells.push(made.frame.cells.clone());
        Ok(())
    })
    .expect("a run");
    Run { layout: setup.layout, cells }
}

impl Run {
    fn grid_cell(&self, cell: Cell) -> [i32; 2] {
        [cell.x.into(), i32::from(self.layout.height()) - 1 - i32::from(cell.y)]
    }

    /// Where a robot is, in millimetres: it goes straight from the middle of a cell to that of the next one.
    fn at(&self, sort: &Sort, robot: usize, at_us: i64) -> [i32; 2] {
        let step = (at_us / MOVE_US) as usize;
        let next = (step + 1).min(self.cells.len() - 1);
        let [from, to] = [step, next].map(|step| self.grid_cell(self.cells[step.min(next)][robot]));
        let part = i64::from(sort.cell_mm) * (at_us % MOVE_US) / MOVE_US;
        [0, 1]
            .map(|axis| from[axis] * sort.cell_mm + sort.cell_mm / 2 + (to[axis] - from[axis]) * part as i32)
    }

    /// The team move that enters the last cell that is visited.
    fn last_new(&self) -> usize {
        let mut visited = BTreeSet::new();
        let news = self.cells.iter().enumerate().filter(|(_, cells)| {
            let before = visited.len();
            visited.extend(cells.iter().map(|&cell| self.grid_cell(cell)));
            visited.len() > before
        });
        news.map(|(step, _)| step).last().unwrap_or(0)
    }

    fn demand(&self, sort: &Sort, id: &str) -> Demand {
        let grid = Grid { origin_mm: [0.0, 0.0], cell_mm: f64::from(sort.cell_mm) };
        match id {
            "CHAIN-2" => Demand::Crowd { grid, most: 2, base: Some(self.grid_cell(self.cells[0][0])) },
            "CHAIN-3" => Demand::Neighbours { range_mm: 2_549 },
            "KIT-1" => Demand::Joined { range_mm: 10_000, of: Group::All },
            "KIT-12" => Demand::Joined { range_mm: 10_000, of: Group::JoinedAtStart },
            "KIT-3" => Demand::Apart { least_mm: 3_000 },
            "FRONTIER-1" => {
                let cells =
                    self.layout.reachable(&self.cells[0]).into_iter().map(|cell| self.grid_cell(cell));
                Demand::Visited { grid, cells: cells.collect(), is_whole: true }
            }
            _ => Demand::Crowd { grid, most: 1, base: None },
        }
    }
}

/// A log of a run, with a violation from a moment on for so long that three positions show it; and the robots that
/// break it. Stamps are off; some positions come late, one is astray; both are somewhere else.
fn log(
    sort: &Sort,
    run: &Run,
    plant: Option<(Plant, i64)>,
    chance: &mut Chance,
) -> (Vec<Row<'static>>, Vec<u32>) {
    let mut end_us = (run.cells.len() as i64 - 1) * MOVE_US;
    let mut guilty = Vec::new();
    if let Some((Plant::End, _)) = plant {
        end_us = (run.last_new() as i64 - 1) * MOVE_US + PERIOD_US;
    }
    let mut rows: Vec<Row<'static>> = Vec::new();
    for at_us in (0..=end_us).step_by(PERIOD_US as usize) {
        for (robot, name) in NAMES.into_iter().take(sort.robots).enumerate() {
            let mut place = run.at(sort, robot, at_us);
            if let Some((plant, from_us)) = plant
                && (from_us..from_us + 3 * PERIOD_US).contains(&at_us)
            {
                let first = run.at(sort, 0, at_us);
                match plant {
                    Plant::Beside(east) if robot == 1 => place = [first[0] + east, first[1]],
                    Plant::Together(from) if robot >= from => {
                        let cell = run.grid_cell(run.cells[(from_us / MOVE_US) as usize][sort.robots - 1]);
                        place = cell.map(|along| along * sort.cell_mm + sort.cell_mm / 2);
                    }
                    Plant::Beside(_) | Plant::Together(_) | Plant::End => {}
                }
            }
            let stamp =
                1_700_000_000_000_000 + at_us + 17_000 * robot as i64 + chance.below(2 * NOISE_US) - NOISE_US;
            rows.push((stamp, name, place));
        }
    }
    rows.sort_by_key(|row| row.0);
    for _ in 0..rows.len() / 30 {
        let place = 1 + chance.below(rows.len() as i64 - 1) as usize;
        let (stamp, robot, _) = rows[place];
        rows.insert(place + 1, (stamp - 400_000, robot, [-90_000, 50_000]));
    }
    let place = 1 + chance.below(rows.len() as i64 - 1) as usize;
    rows.insert(place, (rows[place].0 + 3_600_000_000, rows[place].1, [90_000, 50_000]));
    match plant.map(|(plant, _)| plant) {
        Some(Plant::Beside(_)) => guilty.push(1),
        Some(Plant::Together(from)) => guilty.extend(from as u32..sort.robots as u32),
        Some(Plant::End) | None => {}
    }
    (rows, guilty)
}

fn verdict(bytes: &[u8], demand: &Demand) -> Verdict {
    let log = read(bytes).expect("a log");
    let tracks = Tracks::new(&log, &Numbers::natural(&log.names), &LIMITS);
    assert_eq!(tracks.refused().astray.map(|(count, _)| count), Some(1));
    judge(&tracks, &LIMITS, demand).expect("few")
}

/// Judges so many logs without a violation and as many with one, each in three forms; returns how many verdicts were
/// right of each.
fn judged(logs: u64) -> [u64; 2] {
    let mut chance = Chance(0x9e37_79b9_7f4a_7c15);
    let mut right = [0, 0];
    let sorts = || SORTS.iter().flat_map(|sort| sort.clauses.iter().map(move |clause| (sort, clause)));
    for (number, (sort, (id, plant))) in (0..logs).zip(sorts().cycle()) {
        let run = run(sort, number);
        let demand = run.demand(sort, id);
        // In the second half, where robots have left their starts, not at the end, and not in the base.
        let moves = run.cells.len() - 1;
        let is_away = |step: &usize| run.cells[*step][sort.robots - 1] != run.cells[0][0];
        let steps: Vec<usize> = (moves / 2..moves).filter(is_away).collect();
        let step = steps[chance.below(steps.len() as i64) as usize];
        let from_us = step as i64 * MOVE_US;
        for plant in [None, Some((*plant, from_us))] {
            let (rows, guilty) = log(sort, &run, plant, &mut chance);
            for bytes in [forms::csv(&rows), forms::json(&rows), forms::mcap(&rows, number % 2 == 0)] {
                let verdict = verdict(&bytes, &demand);
                let is_right = match (plant, &verdict) {
                    (None, Verdict::Kept) => true,
                    (Some((Plant::End, _)), Verdict::Broken(breach)) => !breach.cells.is_empty(),
                    (Some(_), Verdict::Broken(breach)) => {
                        let at_us = breach.at_us - 1_700_000_000_000_000;
                        let near = from_us - PERIOD_US - NOISE_US..from_us + 3 * PERIOD_US + 3 * NOISE_US;
                        near.contains(&at_us) && guilty.iter().all(|robot| breach.robots.contains(robot))
                    }
                    (_, Verdict::Kept | Verdict::Broken(_) | Verdict::Unknown(_)) => false,
                };
                assert!(is_right, "log {number} of {id}, {plant:?}: {verdict:?}");
                right[usize::from(plant.is_some())] += 1;
            }
        }
    }
    right
}

#[test]
fn every_planted_violation_is_found_and_no_other_one() {
    assert_eq!(judged(48), [3 * 48, 3 * 48]);
}

/// `cargo test --release -p tautline-logs -- --ignored --nocapture thousand`.
#[test]
#[ignore = "twenty times as many logs as the test above"]
fn every_planted_violation_of_a_thousand_is_found_and_no_other_one() {
    println!("right without and with a violation: {:?}", judged(1_000));
}

/// A judge that takes what it should not, or believes what it cannot know, is wrong about these logs.
#[test]
fn without_its_limits_the_judge_is_wrong() {
    let wrong = |limits: Limits| {
        let mut chance = Chance(7);
        SORTS.iter().any(|sort| {
            let run = run(sort, 1);
            let (rows, _) = log(sort, &run, None, &mut chance);
            let log = read(&forms::csv(&rows)).expect("a log");
            let tracks = Tracks::new(&log, &Numbers::natural(&log.names), &limits);
            let verdict = judge(&tracks, &limits, &run.demand(sort, sort.clauses[0].0)).expect("few");
            verdict != Verdict::Kept
        })
    };
    assert!(!wrong(LIMITS));
    assert!(wrong(Limits { jump_us: u64::MAX, ..LIMITS }), "stamps that are astray are taken");
    assert!(wrong(Limits { gap_us: 100_000, ..LIMITS }), "robots that are always silent");
    let mut silent = Vec::new();
    for (at_us, robot, place) in
        [(0, "a", [0, 0]), (0, "b", [0, 0]), (3_000_000, "a", [0, 0]), (3_000_000, "b", [0, 0])]
    {
        silent.push((at_us, robot, place));
    }
    let log = read(&forms::csv(&silent)).expect("a log");
    let tracks = Tracks::new(&log, &Numbers::natural(&log.names), &LIMITS);
    let verdict = judge(&tracks, &LIMITS, &Demand::Neighbours { range_mm: 2_549 });
    assert!(matches!(verdict, Ok(Verdict::Unknown(Doubt::Silent(_, 2)))));
}
