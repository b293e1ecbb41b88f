//! Random runs beyond the searched bounds: many sizes and densities, more robots than any search holds, and all that
//! can fail. They are judged by SPEC.md's sentences alone: `judge` knows std and nothing of the rules.

mod judge;

use std::collections::BTreeMap;
use std::time::Duration;

use crate::common::generated;
use judge::{BrokenClause, Chain, Drive, Floor, Frontier, Kit, Pack, Place, Trouble};
use tautline_grids::layout::Layout;
use tautline_kernel::chain::Kind;
use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Rule as Cells, Status};
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_kernel::kit::Rule as Touch;
use tautline_proofs::engine::SeededOracle;
use tautline_sim::explore::chain::{CHAIN, REEL};
use tautline_sim::explore::pack::PACK;
use tautline_sim::explore::{ExplorationRequest, RuleId, Setup, StopReason, explore};
use tautline_sim::failures::{Compass, Failure, MoveOrder, WallAppearance};
use tautline_sim::frontier::Explorers;
use tautline_sim::kit::{self, Pace};
use tautline_sim::options::Options;

/// Runs by one rule.
#[derive(Debug, Default)]
struct RunCounts {
    runs: u64,
    moves: u64,
    /// By clause: how many runs break it, and the first of them.
    broken: BTreeMap<&'static str, (u64, String)>,
}

impl RunCounts {
    /// So many runs, each of team moves that it tells, with what it breaks; `None` where a team does not find room.
    fn of(
        runs: u64,
        mut run: impl FnMut(&mut SeededOracle) -> Option<(String, u64, Result<(), BrokenClause>)>,
    ) -> Self {
        let mut counted = Self::default();
        for number in 0.. {
            if counted.runs == runs {
                break;
            }
            let Some((told, moves, judged)) = run(&mut SeededOracle::new(0, number)) else { continue };
            counted.runs += 1;
            counted.moves += moves;
            if let Err((clause, how)) = judged {
                counted.broken.entry(clause).or_insert_with(|| (0, format!("{told}: {how}"))).0 += 1;
            }
        }
        counted
    }

    fn holds(&self, what: &str) {
        println!("{what}: {} runs, {} team moves, broken: {:?}", self.runs, self.moves, self.broken);
        assert!(self.broken.is_empty(), "{what}: {:?}", self.broken);
    }
}

fn between(oracle: &mut SeededOracle, least: u32, most: u32) -> u32 {
    least + oracle.pick(most - least + 1)
}

fn one_of<T: Copy>(oracle: &mut SeededOracle, all: &[T]) -> T {
    all[oracle.pick(all.len() as u32) as usize]
}

/// A random layout: its generator with its seed, and itself.
fn drawn(oracle: &mut SeededOracle, kinds: &[&str], most: u32) -> (String, Layout) {
    let kind = one_of(oracle, kinds);
    let (columns, rows) = (between(oracle, 2, most), between(oracle, 2, most));
    let share = one_of(oracle, &["0", "0.05", "0.1", "0.2", "0.3", "0.4"]);
    let text = format!("{kind}:{columns}x{rows}:{share}");
    let seed = u64::from(oracle.pick(u32::MAX));
    (format!("{text} --seed {seed}"), generated(&text, seed))
}

fn place(cell: Cell) -> Place {
    (cell.x.into(), cell.y.into())
}

fn places(cells: &[Cell]) -> Vec<Place> {
    cells.iter().copied().map(place).collect()
}

fn ends(edge: Edge) -> [Place; 2] {
    let (one, other) = (place(edge.cell()), place(edge.cell().beyond(edge.side())));
    [one.min(other), one.max(other)]
}

fn floor(layout: &Layout) -> Floor {
    Floor {
        columns: layout.width().into(),
        rows: layout.height().into(),
        blocked: layout.cells().filter(|&cell| !layout.is_free(cell)).map(place).collect(),
        walls: layout.walls().map(ends).map(|[one, other]| (one, other)).collect(),
    }
}

/// So many free cells: anywhere, or each beside one before it. `None` if there is no room.
fn starts(
    oracle: &mut SeededOracle,
    layout: &Layout,
    robots: usize,
    are_together: bool,
) -> Option<Vec<Cell>> {
    let mut free: Vec<Cell> = layout.cells().filter(|&cell| layout.is_free(cell)).collect();
    let mut starts: Vec<Cell> = Vec::new();
    while starts.len() < robots {
        let may_start = |cell: &Cell| {
            let is_beside = |&start: &Cell| {
                let side = Side::ALL.into_iter().find(|&side| start.beyond(side) == *cell);
                side.is_some_and(|side| layout.is_open(Edge::new(start, side)))
            };
            starts.is_empty() || !are_together || starts.iter().any(is_beside)
        };
        let may: Vec<usize> = (0..free.len()).filter(|&number| may_start(&free[number])).collect();
        if may.is_empty() {
            return None;
        }
        starts.push(free.remove(one_of(oracle, &may)));
    }
    Some(starts)
}

/// Robots that explore cells, some of whose messages are lost or not heard from afar.
fn frontier(rule: Cells, runs: u64, is_lossy: bool) -> RunCounts {
    RunCounts::of(runs, |oracle| {
        let (text, layout) = drawn(oracle, &["cells"], 16);
        let robots = between(oracle, 1, 12) as usize;
        let starts = starts(oracle, &layout, robots, false)?;
        let usual = Options::USUAL;
        let loss = one_of(oracle, &["0.05", "0.2", "0.5", "0.8"]).parse().expect("a probability");
        let options = if is_lossy { Options { loss, ..usual } } else { usual };
        let seed = u64::from(oracle.pick(u32::MAX));
        let mut team = Explorers::new(rule, &layout, &starts, options.clone(), seed);
        let floor = floor(&layout);
        let mut judge = Frontier::new(&floor, &places(&starts));
        let mut moves = 0;
        let most = 200 * floor.columns as u64 * floor.rows as u64;
        let mut run = || {
            loop {
                let is_over = team.advance().is_err();
                let news = team
                    .news()
                    .flat_map(|(robot, news)| news.iter().map(move |&(cell, status)| (robot, cell, status)));
                let news = news.map(|(robot, cell, status)| (robot, place(cell), status == Status::Obstacle));
                judge.hear(&places(team.cells()), news)?;
                if is_over || moves == most {
                    return judge.end(is_over);
                }
                moves += 1;
            }
        };
        let judged = run();
        Some((format!("{text}, starts {starts:?}, loss {}, radio {seed}", options.loss), moves, judged))
    })
}

/// Robots that see and start side by side.
fn pack(rule: RuleId, runs: u64) -> RunCounts {
    RunCounts::of(runs, |oracle| {
        let (text, layout) = drawn(oracle, &["cells"], 24);
        let robots = between(oracle, 1, 10) as usize;
        let starts = starts(oracle, &layout, robots, true)?;
        let (sight, range) = (between(oracle, 1, 8) as u16, between(oracle, 3, 14) as u16);
        let asked = ExplorationRequest {
            robots: Some(robots as u64),
            starts: starts.clone(),
            options: Options { sight_cells: Some(sight), range_cells: Some(range), ..Options::USUAL },
            ..ExplorationRequest::new(&PACK, rule)
        };
        let setup = asked.setup(layout).expect("a pack");
        let floor = floor(&setup.layout);
        let mut judge = Pack::new(&floor, &places(&starts), sight.into(), range.into());
        let mut judged = Ok(());
        let report = explore(&setup, &mut |made| {
            if judged.is_ok() {
                judged = judge.hear(&places(&made.frame.cells));
            }
            Ok(())
        });
        let report = report.map_err(|_| ()).expect("a run");
        let judged = judged.and_then(|()| judge.end(report.stopped != StopReason::Idle));
        Some((
            format!("{text}, starts {starts:?}, sight {sight}, range {range}"),
            report.steps.into(),
            judged,
        ))
    })
}

/// Robots that keep in touch, at speeds of their own.
fn kit(rule: Touch, robots: [u32; 2], runs: u64) -> RunCounts {
    RunCounts::of(runs, |oracle| {
        let (text, layout) = drawn(oracle, &["walls", "cells"], 14);
        let robots = between(oracle, robots[0], robots[1]) as usize;
        // Two robots may start anywhere in contact.
        let are_together = robots > 2 || oracle.flip();
        let starts = starts(oracle, &layout, robots, are_together)?;
        let floor = floor(&layout);
        let pace = Pace { spread: one_of(oracle, &[0, 100, 500, 900, 999]), ..Pace::STEADY };
        let seed = u64::from(oracle.pick(u32::MAX));
        // Robots out of contact are refused.
        let mut course = kit::course(rule, &layout, &starts, pace, seed).ok()?;
        let most = 100 * (floor.columns * floor.rows + 10) as usize;
        let (mut drives, mut by_itself) = (Vec::new(), false);
        while drives.len() < most && !by_itself {
            match course.drive() {
                None => by_itself = true,
                Some(drive) => drives.push(Drive {
                    robot: drive.robot,
                    from: place(drive.from),
                    to: place(drive.to),
                    begin: Duration::from_millis(drive.time[0]).as_secs_f64(),
                    end: Duration::from_millis(drive.time[1]).as_secs_f64(),
                }),
            }
        }
        let starts = places(&starts);
        let run =
            Kit { floor: &floor, starts: &starts, drives: &drives, by_itself, is_known: course.is_over() };
        let told = format!("{text}, starts {starts:?}, spread {}, seed {seed}", pace.spread);
        Some((told, drives.len() as u64, run.judge()))
    })
}

/// Reels in which bytes are lost, robots go one by one, and a robot dies or a wall appears.
fn reel(rule: RuleId, runs: u64) -> RunCounts {
    RunCounts::of(runs, |oracle| {
        let (text, mut layout) = drawn(oracle, &["walls", "cells"], 21);
        let robots = between(oracle, 3, 14) as u16;
        let base = starts(oracle, &layout, 1, false)?[0];
        layout.place_base(base).expect("a free cell");
        let step = between(oracle, 1, 150).try_into().expect("from 1 on");
        let mut options = Options::USUAL;
        let mut trouble = Trouble::None;
        match oracle.pick(3) {
            0 => {}
            1 => {
                let robot = between(oracle, 1, u32::from(robots) - 1) as u16;
                options.fail = Some(Failure { robot: robot + 1, step });
                trouble = Trouble::Death(robot.into(), step.get());
            }
            _ => {
                let cells: Vec<Cell> = layout.cells().collect();
                let side = one_of(oracle, &[Compass::E, Compass::S, Compass::W, Compass::N]);
                let wall = WallAppearance { cell: one_of(oracle, &cells), side, step };
                options.wall = Some(wall);
                trouble = Trouble::Wall(ends(wall.edge()), step.get());
            }
        }
        if oracle.flip() {
            options.loss = one_of(oracle, &["0.05", "0.2", "0.4"]).parse().expect("a probability");
        }
        if oracle.flip() {
            options.going = MoveOrder::OneByOne;
        }
        let seed = u64::from(oracle.pick(u32::MAX));
        let setup =
            Setup { options: options.clone(), seed, ..Setup::new(&CHAIN, rule, robots, layout, base) };
        // A wall outside of the layout is refused.
        setup.check().ok()?;
        let floor = floor(&setup.layout);
        let mut judge = Chain::new(&floor, place(base), robots.into(), trouble);
        let mut judged = Ok(());
        let report = explore(&setup, &mut |made| {
            if judged.is_ok() {
                judged = judge.hear(made.frame.kind == Kind::Backtrack, &places(&made.frame.cells));
            }
            Ok(())
        });
        let report = report.map_err(|_| ()).expect("a run");
        let by_itself = matches!(report.stopped, StopReason::Explored | StopReason::Exhausted);
        let judged = judged.and_then(|()| judge.end(by_itself));
        let told = format!(
            "{text}, base {base}, {robots} robots, {trouble:?}, loss {}, {:?}",
            options.loss, options.going
        );
        Some((told, report.steps.into(), judged))
    })
}

/// All that is promised, in so many runs of each.
fn all_hold(runs: u64) {
    frontier(Cells::REPAIRED, runs, false).holds("frontier, repaired");
    frontier(Cells::REPAIRED, runs, true).holds("frontier, repaired, with losses");
    pack(RuleId::REPAIRED, runs).holds("pack, repaired");
    kit(Touch::REPAIRED, [2, 2], runs).holds("kit, repaired, two robots");
    kit(Touch::REPAIRED, [3, 8], runs).holds("kit, repaired, three robots and more");
    reel(REEL, runs).holds("reel with faults");
}

#[test]
fn nothing_is_broken_beyond_the_searched_bounds() {
    all_hold(15);
}

#[test]
#[ignore = "67 s: cargo test -p tautline-sim --test all two_thousand -- --ignored --nocapture"]
fn nothing_is_broken_in_two_thousand_runs_of_each() {
    all_hold(2000);
}

/// Runs of the rules as published break clauses, and the judges find which.
#[test]
fn the_judges_find_what_the_published_rules_break() {
    let finds = |counted: RunCounts, clauses: &[&str]| {
        let found: Vec<&str> = counted.broken.keys().copied().collect();
        assert_eq!(found, clauses, "{:?}", counted.broken);
    };
    finds(frontier(Cells::PUBLISHED, 60, false), &["FRONTIER-1", "FRONTIER-2"]);
    finds(pack(RuleId::PUBLISHED, 60), &["PACK-1"]);
    finds(kit(Touch::PUBLISHED, [2, 2], 60), &["KIT-6"]);
}
