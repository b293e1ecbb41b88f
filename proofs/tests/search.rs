//! The search over all layouts comes out the same on any number of threads, and wherever it is left and taken up again.

use std::collections::BTreeSet;

use serde_json::{Value, json};
use tautline_kernel::chain::SetupError;
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::search::{Bounds, Findings, Position, Search, Unsearchable, search};
use tautline_proofs::engine::tree::{self, Progress, unwatched};

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(work)
}

fn found(bounds: &Bounds) -> Findings {
    search(bounds, &mut unwatched).expect("four robots fit")
}

#[test]
fn a_search_comes_out_the_same_on_any_number_of_threads() {
    let bounds = Bounds::new(Subject::PUBLISHED, 4, 3);
    let whole = found(&bounds);
    assert!(whole.complete);
    assert_eq!(whole.levels.len(), 4);
    assert_eq!(whole.levels.iter().map(|level| level.moves).sum::<u64>(), whole.moves);
    // A wave has at most 256 shares, and at the ends of a level fewer.
    for threads in [1, 3, 300] {
        assert_eq!(on_threads(threads, || found(&bounds)), whole, "{threads} threads");
    }
}

#[test]
fn a_budget_cuts_the_same_runs_off_on_any_number_of_threads() {
    let bounds = |budget_moves| Bounds { budget_moves, ..Bounds::new(Subject::PUBLISHED, 4, 3) };
    let whole = found(&bounds(None));
    for budget in [0, 1, 100, 20_000, whole.moves - 1000] {
        let cut = on_threads(1, || found(&bounds(Some(budget))));
        assert_eq!((cut.complete, cut.moves), (false, budget));
        assert_eq!(cut, on_threads(3, || found(&bounds(Some(budget)))), "{budget}");
    }
    assert_eq!(found(&bounds(Some(whole.moves + 1))), whole);
}

#[test]
fn a_search_left_anywhere_and_taken_up_again_comes_out_the_same() {
    let bounds = Bounds::new(Subject::PUBLISHED, 4, 3);
    let whole = found(&bounds);
    let mut positions = Vec::new();
    let mut undisturbed = Search::new(&bounds).expect("four robots fit");
    positions.push(undisturbed.position());
    while undisturbed.wave() {
        positions.push(undisturbed.position());
    }
    positions.push(undisturbed.position());
    assert!(positions.len() > 4, "{} waves", positions.len());
    for position in positions.iter().step_by(7).chain(positions.last()) {
        let mut again = Search::at(&bounds, position).expect("a position of its own");
        assert_eq!(again.position(), *position);
        while again.wave() {}
        assert_eq!(again.found(), whole);
    }
}

#[test]
fn a_finished_search_goes_on_with_more_walls() {
    let (few, more) = (Bounds::new(Subject::REPAIRED, 3, 2), Bounds::new(Subject::REPAIRED, 3, 4));
    let mut search = Search::new(&few).expect("three robots fit");
    while search.wave() {}
    let position = search.position();
    let mut again = Search::at(&more, &position).expect("more walls");
    while again.wave() {}
    assert_eq!(again.found(), found(&more));
    let fewer = Search::at(&Bounds::new(Subject::REPAIRED, 3, 1), &position);
    assert_eq!(fewer.err(), Some(Unsearchable::Search(tree::Unsearchable::Beyond { walls: 2 })));
}

/// The lanes of a position, as it is stored.
fn lanes(position: &Position) -> Vec<Value> {
    serde_json::to_value(position).expect("JSON")["lanes"].as_array().expect("a list").clone()
}

/// `position` with other lanes.
fn with_lanes(position: &Position, lanes: Vec<Value>) -> Position {
    let mut value = serde_json::to_value(position).expect("JSON");
    value["lanes"] = Value::Array(lanes);
    serde_json::from_value(value).expect("a position")
}

#[test]
fn a_position_of_another_search_is_refused() {
    let bounds = Bounds::new(Subject::PUBLISHED, 4, 2);
    let mut search = Search::new(&bounds).expect("four robots fit");
    while lanes(&search.position()).len() < 3 {
        assert!(search.wave(), "a search has many lanes somewhere");
    }
    let position = search.position();
    let foreign = |bounds: &Bounds, position: &Position| {
        let refused = Search::at(bounds, position).err();
        refused == Some(Unsearchable::Search(tree::Unsearchable::Foreign))
    };
    assert!(foreign(&Bounds::new(Subject::PUBLISHED, 5, 2), &position));
    // The start is a place in every tree, but not what is left of this one; nor is what is left when a lane is lost.
    let mut start = lanes(&position);
    start[0] = json!({"answers": [], "fixed": 0, "next": "advance"});
    let fewer = lanes(&position).split_off(1);
    for lanes in [start, fewer] {
        let refused = Search::at(&bounds, &with_lanes(&position, lanes)).err();
        assert_eq!(refused, Some(Unsearchable::Search(tree::Unsearchable::Short)));
    }
    for place in 0..lanes(&position).len() {
        let mut damaged = lanes(&position);
        damaged[place]["answers"].as_array_mut().expect("a list").push(json!(7));
        assert!(foreign(&bounds, &with_lanes(&position, damaged)), "lane {place}");
        let mut beyond_its_end = lanes(&position);
        beyond_its_end[place]["moved"] = json!(u32::MAX);
        assert!(foreign(&bounds, &with_lanes(&position, beyond_its_end)), "lane {place}");
    }
}

#[test]
fn every_lane_is_another_part_of_the_tree_and_none_is_empty() {
    let bounds = Bounds::new(Subject::PUBLISHED, 4, 3);
    let whole = found(&bounds);
    let mut search = Search::new(&bounds).expect("four robots fit");
    let deal = serde_json::to_value(Search::new(&bounds).expect("four robots fit").deal(1)).expect("JSON");
    let mut most = 0;
    while search.wave() {
        let position = search.position();
        let all = lanes(&position);
        let places: BTreeSet<String> = all.iter().map(Value::to_string).collect();
        assert_eq!(places.len(), all.len(), "two lanes are one");
        if all.len() <= most {
            continue;
        }
        most = all.len();
        // The parts add up to the whole, and each has runs of its own: those of a shard that is dealt it alone.
        let at = |lanes: Vec<Value>| {
            let mut ways = vec![json!([]); 4];
            ways[position.levels().len()] = Value::Array(lanes);
            let mut dealt = deal.clone();
            (dealt["shards"], dealt["left"]) = (json!([ways]), json!([0]));
            let deal = serde_json::from_value(dealt).expect("a deal");
            let mut part = Search::shard(&bounds, &deal, 0).expect("a shard");
            while part.wave() {}
            part.progress().runs
        };
        let parts: Vec<u64> = all.iter().map(|lane| at(vec![lane.clone()])).collect();
        assert!(parts.iter().all(|&runs| runs > 0), "{parts:?}");
        assert_eq!(parts.iter().sum::<u64>(), at(all), "{most} lanes");
    }
    // There are at most 512, and three of them ended in the wave after which most were left.
    assert_eq!((most, search.found()), (509, whole));
}

/// Whether no share of a wave made more than 1.3 times as many team moves as the shares did on average.
fn is_even(wave: &[u64]) -> bool {
    let busiest = wave.iter().max().copied().unwrap_or_default();
    10 * busiest * wave.len() as u64 <= 13 * wave.iter().sum::<u64>()
}

#[test]
fn no_wave_waits_for_one_share() {
    assert!(is_even(&[64]) && is_even(&[64, 64, 40]) && !is_even(&[64, 64, 15]));
    let workers = [2, 8, 32];
    let (mut made, mut spans) = (0, [0; 3]);
    let mut search = Search::new(&Bounds::new(Subject::REPAIRED, 4, 3)).expect("four robots fit");
    let (mut most, mut level_of_last) = (0, None);
    let mut has_more = true;
    while has_more {
        let level = search.progress().levels.len();
        has_more = search.wave();
        let progress = search.progress();
        assert!(level_of_last != Some(level) || is_even(progress.wave), "level {level}: {:?}", progress.wave);
        level_of_last = Some(level);
        most = most.max(progress.wave.len());
        made += progress.wave.iter().sum::<u64>();
        for (span, workers) in spans.iter_mut().zip(workers) {
            *span += progress.span(workers);
        }
    }
    assert_eq!(most, 256);
    // The share of their time, in per cent, that so many workers wait.
    let waits = [0, 1, 2].map(|place| 100 - 100 * made / (spans[place] * workers[place] as u64));
    assert!(waits[0] <= 1 && waits[1] <= 4 && waits[2] <= 13, "{waits:?}");
}

#[test]
fn a_wave_takes_as_long_as_its_last_worker() {
    let wave = [5, 3, 4, 1];
    let progress = Progress { runs: 0, moves: 0, levels: &[], max_walls: 0, edges: 0, wave: &wave };
    assert_eq!([1, 2, 3, 4, 9].map(|workers| progress.span(workers)), [13, 7, 5, 5, 5]);
}

#[test]
fn bounds_that_cannot_be_searched_are_refused() {
    let refused = |robots, max_walls| Search::new(&Bounds::new(Subject::REPAIRED, robots, max_walls)).err();
    assert_eq!(
        refused(2, 13),
        Some(Unsearchable::Search(tree::Unsearchable::TooManyWalls { max_walls: 13, edges: 12 }))
    );
    assert_eq!(refused(2, 12), None);
    assert!(matches!(refused(1, 0), Some(Unsearchable::Team(SetupError::TooFewRobots(1)))));
    assert!(matches!(refused(65, 0), Some(Unsearchable::Team(SetupError::TooManyRobots { .. }))));
}

/// Of a hunt that is worth dealing out.
const DEALT: usize = 8;

#[test]
fn the_shards_of_a_search_count_what_one_search_counts() {
    let bounds = Bounds::new(Subject::PUBLISHED, 4, 3);
    let whole = found(&bounds);
    for shards in [1, 3, DEALT] {
        let deal = Search::new(&bounds).expect("four robots fit").deal(shards);
        let text = serde_json::to_string(&deal).expect("numbers");
        let deal = serde_json::from_str(&text).expect("what was written");
        let searched = |shard| {
            let mut search = Search::shard(&bounds, &deal, shard).expect("a shard of its own");
            for _ in 0..3 {
                search.wave();
            }
            // It may go on elsewhere.
            let mut search =
                Search::shard_at(&bounds, &deal, shard, &search.position()).expect("a position of its own");
            while search.wave() {}
            search.position()
        };
        let mut ends: Vec<Position> = (0..shards).map(searched).collect();
        let merged = Search::merged(&bounds, &deal, &ends).expect("all shards");
        assert_eq!(merged.found(), whole, "{shards} shards");
        // Neither one too few nor one that is not at its end.
        let begun = Search::shard(&bounds, &deal, 0).expect("a shard").position();
        let last = ends.pop().expect("a shard");
        assert!(Search::merged(&bounds, &deal, &ends).is_err());
        ends.push(begun);
        assert!(shards == 1 || Search::merged(&bounds, &deal, &ends).is_err());
        assert_ne!(ends.last(), Some(&last));
        assert!(Search::shard(&bounds, &deal, shards).is_err());
    }
}

/// The largest shard has at most 1.3 times the mean, and a plan tells what all shards have to a third, and what each
/// has to a half.
#[test]
fn a_search_is_dealt_out_evenly_and_as_the_plan_tells() {
    let cases = [(Subject::PUBLISHED, 4, 4), (Subject::REPAIRED, 3, 5), (Subject::REEL, 4, 3)];
    for (observed, robots, walls) in cases {
        let bounds = Bounds::new(observed, robots, walls);
        let deal = Search::new(&bounds).expect("so many robots fit").deal(DEALT);
        let moves = |shard| {
            let mut search = Search::shard(&bounds, &deal, shard).expect("a shard of its own");
            while search.wave() {}
            search.progress().moves
        };
        let moves: Vec<u64> = (0..DEALT).map(moves).collect();
        let (most, sum) = (moves.iter().max().expect("shards"), moves.iter().sum::<u64>());
        assert!(10 * most * DEALT as u64 <= 13 * sum, "{robots} robots, {walls} walls: {moves:?}");
        let told: u64 = deal.left().iter().sum();
        assert!((2 * sum..=4 * sum).contains(&(3 * told)), "{robots} robots, {walls} walls: {told} of {sum}");
        let is_about = |(&told, &made): (&u64, &u64)| (made..=3 * made).contains(&(2 * told));
        assert!(deal.left().iter().zip(&moves).all(is_about), "{:?}, {moves:?}", deal.left());
    }
}

#[test]
fn a_shard_that_has_not_searched_what_it_was_dealt_is_none_of_the_deal() {
    let bounds = Bounds::new(Subject::PUBLISHED, 4, 3);
    let deal = Search::new(&bounds).expect("four robots fit").deal(2);
    let mut search = Search::shard(&bounds, &deal, 0).expect("a shard");
    for _ in 0..3 {
        search.wave();
    }
    let text = serde_json::to_string(&search.position()).expect("numbers");
    let at = |text: &str| {
        let position = serde_json::from_str(text).expect("a position");
        Search::shard_at(&bounds, &deal, 0, &position).map(|_| ())
    };
    assert_eq!(at(&text), Ok(()));
    let short = Err(Unsearchable::Search(tree::Unsearchable::Short));
    let mut position: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let lanes = position["lanes"].as_array_mut().expect("lanes");
    // A lane is forgotten, or searched twice.
    let lane = lanes.pop().expect("a lane");
    assert_eq!(at(&position.to_string()), short);
    position["lanes"].as_array_mut().expect("lanes").extend([lane.clone(), lane]);
    assert_eq!(at(&position.to_string()), short);
}

/// Each call has a budget of its own, and all of them come to what one search comes to.
#[test]
fn a_budget_counts_what_was_made_since_the_search_was_taken_up() {
    let bounds = |budget_moves| Bounds { budget_moves, ..Bounds::new(Subject::REPAIRED, 4, 3) };
    let whole = found(&bounds(None));
    let budget = whole.moves / 3 + 1;
    let mut search = Search::new(&bounds(Some(budget))).expect("four robots fit");
    let mut calls = Vec::new();
    loop {
        while search.wave() {}
        calls.push(search.progress().moves);
        if search.is_complete() {
            break;
        }
        assert!(calls.len() < 4, "{calls:?}");
        search = Search::at(&bounds(Some(budget)), &search.position()).expect("a position of its own");
    }
    assert_eq!(calls, [budget, 2 * budget, whole.moves]);
    assert_eq!(search.found(), whole);
}
