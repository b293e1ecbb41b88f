//! The fuzz targets' bodies: one for each, named as its target and its folder of the corpus. A body panics when it
//! finds something wrong. `tests/fuzz_corpus.rs` includes this file and runs the bodies on all kept inputs, so that
//! they are checked without a fuzzer, too.

#![allow(clippy::missing_panics_doc, reason = "a panic is how a body tells what it found")]

mod floor;
mod frontier;
mod kit;
mod network;
mod parts;
mod position;
#[path = "../../src/report.rs"]
#[allow(dead_code, reason = "a fuzzer has no terminal")]
pub mod report;
mod rescue;

use std::fs;
use std::hint::black_box;
use std::io::Write;
use std::path::Path;
use std::sync::LazyLock;

use tautline_grids::heap_grid::HeapGrid;
use tautline_grids::layout::{Layout, Misread, Size, movingai, ros, text};
use tautline_io::checkpoint::Checkpoint;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_kernel::chain::{self, Chain, Intent, Kind, Rule};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Area, Cell, Edge, Grid, SmallGrid};
use tautline_proofs::chain::breach::{Breach, CHEAP_LOOKS, frame as frame_of};
use tautline_proofs::chain::search::{Bounds, Findings, Search, search};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::engine::{SeededOracle, Tape};
use tautline_proofs::judge::chain::{JudgeInput, judge as judged};
use tautline_proofs::run::Frame;
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::chain::hunt::{self, HuntTask, Waves};
use tautline_sim::explore::hunt::HuntRequest;
use tautline_sim::explore::judge_input::judge_input;
use tautline_sim::explore::{Catalogue, RuleId, RuleName, Setup};
use tautline_sim::trace::Trace;

pub use floor::floor;
pub use frontier::frontier;
pub use kit::kit;
pub use network::network;
use parts::{numbers, told};
pub use position::position;
pub use rescue::{rescue, rescue_trace};

/// The body of a target.
pub type Body = fn(&[u8]);

/// Every target's name and body.
pub const TARGETS: [(&str, Body); 17] = [
    ("chain", chain),
    ("chain_log", chain_log),
    ("floor", floor),
    ("frontier", frontier),
    ("judge", judge),
    ("kept_hunt", kept_hunt),
    ("kit", kit),
    ("layout_movingai", layout_movingai),
    ("layout_ros", layout_ros),
    ("layout_text", layout_text),
    ("network", network),
    ("plan_cost", plan_cost),
    ("plan_cost_far", plan_cost_far),
    ("position", position),
    ("rescue", rescue),
    ("rescue_trace", rescue_trace),
    ("trace", trace),
];

/// A chain of any size in any area, every edge decided by the bytes, from its start to its end: the repaired
/// rule keeps all safety sentences, the published one that of coverage, and a small chain's run is not long.
pub fn chain(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut oracle = Tape(&numbers);
    let (rule, kept): (Rule, &[Breach]) =
        if oracle.flip() { (Rule::PUBLISHED, &[Breach::Coverage]) } else { (Rule::REPAIRED, &Breach::CHAIN) };
    let robots = oracle.pick(31) as usize + 2;
    let (_, area, base) = area(robots, &mut oracle);
    let last = if robots <= 8 {
        let grid = SmallGrid::new(area).expect("at most 15 cells a side");
        let chain = Chain::<_, 8>::new(rule, robots, base, grid).expect("it fits");
        follow(chain, 20_000, |_| is_open(&mut oracle), |before, frame| check(kept, before, frame))
    } else {
        let chain = Chain::<_, 32>::new(rule, robots, base, HeapGrid::new(area)).expect("it fits");
        follow(chain, 500, |_| is_open(&mut oracle), |before, frame| check(kept, before, frame))
    };
    assert!(robots > 8 || last == Last::Ended, "a chain of {robots} is still under way");
}

/// The size of a layout that a chain of `robots` can explore from anywhere in it, what it can explore of the
/// layout from a base, and that base.
fn area(robots: usize, oracle: &mut dyn Oracle) -> (Size, Area, Cell) {
    let most = 2 * robots as u32 - 1;
    let (width, height) = (most - oracle.pick(most), most - oracle.pick(most));
    let base = Cell::new((width - 1 - oracle.pick(width)) as i16, (height - 1 - oracle.pick(height)) as i16);
    let size = Size::new(width.into(), height.into()).expect("a small layout");
    let area = chain::area(size.area(), base, robots);
    (size, area.expect("the base is in it"), base)
}

/// An edge is open unless its number is in the upper quarter, so that a tape of any numbers has both.
fn is_open(oracle: &mut dyn Oracle) -> bool {
    oracle.pick(256) < 192
}

fn check(kept: &[Breach], before: &[Cell], frame: &Frame) -> Next {
    for breach in kept {
        assert!(!breach.is_in(before, &frame.cells), "{} from {before:?}: {frame:?}", breach.clause());
    }
    Next::Go
}

/// Whether a run is to be followed further.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Next {
    Go,
    Stop,
}

/// How a run was left.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Last {
    /// It ended by itself.
    Ended,
    /// It could go on.
    Cut,
}

/// Runs `chain` for `most` team moves and shows each of them, with the cells before it.
fn follow<G: Grid, const ROBOTS: usize>(
    mut chain: Chain<G, ROBOTS>,
    most: usize,
    mut is_open: impl FnMut(Edge) -> bool,
    mut show: impl FnMut(&[Cell], &Frame) -> Next,
) -> Last {
    let mut log = Vec::new();
    for _ in 0..most {
        let Intent::Go(plan) = chain.plan(&log).expect("messages of the chain") else { return Last::Ended };
        let before = chain.cells().to_vec();
        let settled = chain.settle(&plan, &mut is_open);
        log.extend_from_slice(settled.messages());
        if show(&before, &frame_of(plan.kind, settled.messages(), chain.cells())) == Next::Stop {
            return Last::Cut;
        }
    }
    Last::Cut
}

/// A chain whose log is replaced by any bytes in the middle of its run: it goes on or says that the log is
/// damaged. It never takes a move back by a log that is cut short.
pub fn chain_log(bytes: &[u8]) {
    let (head, log) = bytes.split_at(bytes.len().min(16));
    let numbers = numbers(head);
    let mut oracle = Tape(&numbers);
    let rule = one_of(&mut oracle, &[Rule::REPAIRED, Rule::PUBLISHED]);
    let robots = oracle.pick(7) as usize + 2;
    let good_moves = oracle.pick(64);
    let (_, area, base) = area(robots, &mut oracle);
    let grid = SmallGrid::new(area).expect("at most 15 cells a side");
    let mut chain = Chain::<_, 8>::new(rule, robots, base, grid).expect("it fits");
    let mut good_log = Vec::new();
    for made in 0..2 * good_moves {
        let log: Vec<u8> = if made < good_moves {
            good_log.clone()
        } else {
            log.iter().copied().chain(std::iter::repeat(0)).take(good_log.len()).collect()
        };
        if let Some((_, cut_short)) = log.split_last() {
            let planned = chain.clone().plan(cut_short);
            assert!(
                !matches!(planned, Ok(Intent::Go(plan)) if plan.kind == Kind::Backtrack),
                "a log cut short"
            );
        }
        let Ok(Intent::Go(plan)) = chain.plan(&log) else { return };
        let settled = chain.settle(&plan, |_| is_open(&mut oracle));
        good_log.extend_from_slice(settled.messages());
    }
}

/// The judge accepts every counterexample that the published rule gives, rejects it without one of its walls,
/// and bears any change of its moves.
pub fn judge(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut oracle = Tape(&numbers);
    let robots = oracle.pick(7) as usize + 2;
    let change = [oracle.pick(256), oracle.pick(256), oracle.pick(256), oracle.pick(256)];
    let (size, area, base) = area(robots, &mut oracle);
    let grid = SmallGrid::new(area).expect("at most 15 cells a side");
    let chain = Chain::<_, 8>::new(Rule::PUBLISHED, robots, base, grid).expect("it fits");
    let mut layout = Layout::of(size);
    let (mut frames, mut broken) = (Vec::new(), None);
    let answer = |edge| {
        let open = is_open(&mut oracle);
        if !open {
            layout.build_wall(edge);
        }
        open
    };
    follow(chain, 500, answer, |before, frame| {
        frames.push(frame.clone());
        broken = Breach::CHAIN.into_iter().find(|breach| breach.is_in(before, &frame.cells));
        if broken.is_some() { Next::Stop } else { Next::Go }
    });
    let Some(breach) = broken else { return };
    let setup = Setup::new(&CHAIN, RuleName::Published, robots as u16, layout, base);
    let mut input = judge_input(&setup, breach.clause(), &frames);
    assert_eq!(judged(&input), Ok(()));
    if let Some(wall) = input.walls.iter().nth(change[0] as usize).copied() {
        input.walls.remove(&wall);
        assert!(judged(&input).is_err(), "it does not need {wall:?}: {input:?}");
        input.walls.insert(wall);
    }
    alter(&mut input, change);
    let _ = black_box(judged(&input));
}

/// Changes one thing of one team move.
fn alter(input: &mut JudgeInput, [which, what, robot, by]: [u32; 4]) {
    let count = input.moves.len().max(1);
    let Some(made) = input.moves.get_mut(which as usize % count) else { return };
    let robot = robot as usize % input.robots;
    let place = (by as i32 % 3 - 1, by as i32 / 3 % 3 - 1);
    match what % 6 {
        0 => made.is_backtrack = !made.is_backtrack,
        1 => made.tried[robot] = place,
        2 => made.blocked[robot] = !made.blocked[robot],
        3 => made.places[robot] = (i32::MAX + place.0.min(0), i32::MIN + place.1.max(0)),
        4 => made.places.truncate(robot),
        _ => made.tried[robot] = (i32::MIN, i32::MAX),
    }
}

/// A chain of 8 to 24 robots, the first edges decided by the bytes and the rest at random: no repaired plan is dear.
/// Only the first moves are made, so that many inputs can be tried.
pub fn plan_cost(bytes: &[u8]) {
    plan(bytes, [8, 12, 16, 24], |robots| 160 / robots);
}

/// As [`plan_cost`], for 16 to 64 robots and a thousand moves: few inputs can be tried, and plans are dearest far from
/// the start.
pub fn plan_cost_far(bytes: &[u8]) {
    plan(bytes, [16, 24, 32, 64], |_| 1_000);
}

fn plan(bytes: &[u8], teams: [usize; 4], moves: fn(usize) -> usize) {
    let (head, answers) = bytes.split_at(bytes.len().min(8));
    let numbers = numbers(head);
    let mut oracle = Tape(&numbers);
    let rule = one_of(&mut oracle, &[Rule::REPAIRED, Rule::PUBLISHED]);
    let robots = one_of(&mut oracle, &teams);
    let walls_percent = oracle.pick(40) + 1;
    let mut random = SeededOracle::new(oracle.pick(256).into(), oracle.pick(256).into());
    let range = robots as i16 - 1;
    let area = Area::new(Cell::new(0, 0), Cell::new(2 * range, 2 * range)).expect("it has cells");
    let grid = HeapGrid::new(area);
    let mut chain = Chain::<_, 64>::new(rule, robots, Cell::new(range, range), grid).expect("it fits");
    let mut bits = answers.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 == 0));
    let mut log = Vec::new();
    let mut dearest = 0;
    for _ in 0..moves(robots) {
        let Intent::Go(plan) = chain.plan(&log).expect("messages of the chain") else { break };
        dearest = dearest.max(chain.looked_at());
        // As published no plan is bounded: what is dear there is only shown to the fuzzer.
        let most = CHEAP_LOOKS * robots as u32;
        assert!(
            rule == Rule::PUBLISHED || dearest <= most,
            "{robots} robots: a plan looked at {dearest} candidates"
        );
        let answer = |_| bits.next().unwrap_or_else(|| random.pick(100) >= walls_percent);
        log.extend_from_slice(chain.settle(&plan, answer).messages());
    }
    // A fuzzer counts how often a loop turns: so it sees that an input is dearer than those before it.
    for _ in 0..dearest / robots as u32 {
        black_box(());
    }
}

/// The hunt of the target: two robots are the smallest team, and the whole hunt takes less than reading a file.
static HUNT: LazyLock<(Bounds, Findings)> = LazyLock::new(|| {
    let bounds = hunt::bounds(RuleName::Published.observed(), 2, 1, None).expect("two robots fit");
    let whole = search(&bounds, &mut unwatched).expect("two robots fit");
    (bounds, whole)
});

/// Any bytes as a hunt that was kept in a file, also with a checksum that fits them: it is refused, or goes on to an
/// end. A real one, left anywhere, with some of its bytes changed: it is refused, or goes on to the end of one that was
/// never left. The first byte says which of the three.
pub fn kept_hunt(bytes: &[u8]) {
    let Some((&which, bytes)) = bytes.split_first() else { return };
    let (bounds, whole) = &*HUNT;
    match which % 3 {
        0 => drop(hunt_on(bounds, bytes)),
        1 => {
            let lines: Vec<&[u8]> = bytes.split_inclusive(|&byte| byte == b'\n').take(2).collect();
            let mut sealed = lines.concat();
            let crc32 = crc32fast::hash(&sealed);
            sealed.extend_from_slice(format!("{{\"crc32\":{crc32}}}\n").as_bytes());
            hunt_on(bounds, &sealed);
        }
        _ => {
            let numbers = numbers(bytes);
            let mut oracle = Tape(&numbers);
            let mut number = |below: usize| (256 * oracle.pick(256) + oracle.pick(256)) as usize % below;
            let cut = Bounds { budget_moves: Some(number(80) as u64), ..bounds.clone() };
            let mut search = Waves(Search::new(&cut).expect("two robots fit"));
            while search.0.wave() {}
            let folder = tempfile::tempdir().expect("a folder");
            let file = folder.path().join("hunt");
            kept_at(&file, bounds).keep(&search).expect("it can be written");
            let original = fs::read(&file).expect("a kept hunt");
            let mut kept = original.clone();
            for _ in 0..number(4) {
                let place = number(kept.len());
                kept[place] = number(256) as u8;
            }
            let found = hunt_on(bounds, &kept);
            assert!(found.is_some() || kept != original, "a hunt as it was kept is refused");
            assert!(found.is_none_or(|found| found == *whole), "it goes another way");
        }
    }
}

/// The file that keeps the hunt.
fn kept_at<'a>(path: &'a Path, bounds: &Bounds) -> Checkpoint<'a, HuntTask> {
    let task = HuntTask::new(&HuntRequest::new(&CHAIN, RuleId::PUBLISHED), bounds).expect("of no program");
    Checkpoint::new(Some(path), task)
}

/// The findings of a hunt that goes on from a file with these bytes.
fn hunt_on(bounds: &Bounds, bytes: &[u8]) -> Option<Findings> {
    let mut file = tempfile::NamedTempFile::new().expect("a file");
    file.write_all(bytes).expect("it can be written");
    match hunt::resume(&mut kept_at(file.path(), bounds), bounds) {
        Ok(mut search) => {
            let mut waves = 0;
            while search.wave() {
                waves += 1;
                assert!(waves < 10_000, "the hunt is still under way");
            }
            Some(search.found())
        }
        Err(fault) => {
            told(&fault);
            None
        }
    }
}

/// Any text as a drawing of ours.
pub fn layout_text(bytes: &[u8]) {
    let Ok(oracle) = str::from_utf8(bytes) else { return };
    read_back(oracle, text::read(oracle));
}

/// Any text as a map of the MovingAI benchmarks.
pub fn layout_movingai(bytes: &[u8]) {
    let Ok(oracle) = str::from_utf8(bytes) else { return };
    read_back(oracle, movingai::read(oracle));
}

/// Any text and, after a zero byte, any image as a map of the ROS `map_server`.
pub fn layout_ros(bytes: &[u8]) {
    let end = bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len());
    let (yaml, image) = bytes.split_at(end);
    let Ok(oracle) = str::from_utf8(yaml) else { return };
    match ros::describe(oracle) {
        Ok(description) => match ros::read(&description, image.get(1..).unwrap_or_default()) {
            Ok(layout) => read_back(oracle, Ok(layout)),
            Err(problem) => told(&problem.found_in("map.pgm")),
        },
        Err(misread) => read_back(oracle, Err(misread)),
    }
}

/// Any text as a stored run, made again for its first team moves.
pub fn trace(bytes: &[u8]) {
    let mut file = tempfile::NamedTempFile::new().expect("a file");
    file.write_all(bytes).expect("it can be written");
    let mut left = 100;
    let replayed = Trace::open(file.path(), Catalogue::OWN).map_err(Halt::Diagnostic).and_then(|trace| {
        trace.replay(&mut |_| {
            left -= 1;
            if left == 0 { Err(Halt::Interrupted) } else { Ok(()) }
        })
    });
    match replayed {
        Ok(_) | Err(Halt::Interrupted) => {}
        Err(Halt::Diagnostic(fault)) => told(&fault),
    }
}

/// Asserts that a layout reads back the same when it is written, and that a fault is told in a line.
fn read_back(oracle: &str, layout: Result<Layout, Misread>) {
    match layout {
        Ok(layout) => {
            let drawing = layout.to_string();
            let again: Layout = drawing.parse().expect("a drawing of ours");
            assert!(again == layout, "{again:?} is not {layout:?}");
            assert_eq!(again.to_string(), drawing);
        }
        Err(Misread { at, problem }) => {
            let remedy = problem.remedy();
            told(&Diagnostic::at(Path::new("layout"), oracle, at, problem.what(), remedy));
        }
    }
}
