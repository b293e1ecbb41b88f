//! The data of a page: what its lines say team move by team move is what the run does, for every scheme, and a page of
//! some team moves begins with what there was before them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::RangeInclusive;

use serde_json::Value;
use tautline_grids::chance::Probability;
use tautline_grids::layout::Generator;
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_papers::rivals::CATALOGUE;
use tautline_proofs::run::Frame;
use tautline_sim::draw::page::write;
use tautline_sim::explore::{Report, Setup, explore};

/// The state after a line, by what the line says.
#[derive(Clone, PartialEq, Debug, Default)]
struct State {
    cells: Vec<u32>,
    explored: BTreeSet<u32>,
    /// Whether a side can be crossed.
    known: BTreeMap<u32, bool>,
    /// By layer, robot and place.
    values: BTreeMap<(usize, usize, u32), u32>,
    milliseconds: u64,
}

/// The steps that robots tried: where each went and whether it met a wall.
fn tried(text: &str) -> Vec<Option<(char, bool)>> {
    let (mut robots, mut count) = (Vec::new(), String::new());
    for letter in text.chars().filter(|&letter| letter != '-') {
        match letter {
            digit if digit.is_ascii_digit() => count.push(digit),
            '.' => {
                robots.extend(vec![None; count.parse().unwrap_or(1)]);
                count.clear();
            }
            letter => robots.push(Some((letter.to_ascii_uppercase(), letter.is_ascii_lowercase()))),
        }
    }
    robots
}

fn numbers(text: &str) -> Vec<u32> {
    let mut sum = 0;
    let parts = text.split(',').filter(|part| !part.is_empty());
    parts
        .map(|part| {
            sum += u32::from_str_radix(part, 36).expect("a number");
            sum
        })
        .collect()
}

/// The still part of the page, and the state after each line.
fn read(page: &str) -> (Value, Vec<State>) {
    let part = |id: &str| {
        let begin = page.find(&format!("id=\"{id}\">")).expect("a part") + id.len() + 6;
        &page[begin..begin + page[begin..].find("</script>").expect("its end")]
    };
    let film: Value = serde_json::from_str(part("film")).expect("JSON");
    let columns = film["board"]["columns"].as_u64().expect("columns") as u32;
    let mut state = State::default();
    let start = film["board"]["start"].as_array().expect("cells");
    state.cells = start.iter().map(|cell| cell.as_u64().expect("a cell") as u32).collect();
    let mut states = Vec::new();
    for line in part("lines").lines().filter(|line| !line.is_empty()) {
        let mut words = line.split('\t').next().unwrap_or_default().split(' ');
        for (robot, tried) in tried(words.next().expect("steps")).into_iter().enumerate() {
            let Some((letter, is_blocked)) = tried else { continue };
            let from = state.cells[robot];
            // Of the rim nothing is noted in the west and in the north.
            let (to, side) = match letter {
                'E' => (from + 1, Some(2 * from)),
                'S' => (from + columns, Some(2 * from + 1)),
                'W' => (from.wrapping_sub(1), (from % columns > 0).then(|| 2 * (from - 1))),
                'N' => (from.wrapping_sub(columns), from.checked_sub(columns).map(|cell| 2 * cell + 1)),
                other => panic!("{other}"),
            };
            state.known.extend(side.map(|side| (side, !is_blocked)));
            if !is_blocked {
                state.cells[robot] = to;
            }
        }
        for word in words {
            let (name, rest) = word.split_once(':').unwrap_or((word, ""));
            let (kind, name) = name.split_at(1);
            match kind {
                "+" => state.milliseconds += name.parse::<u64>().expect("milliseconds"),
                "x" => state.explored.extend(numbers(rest)),
                "o" | "w" => state.known.extend(numbers(rest).into_iter().map(|side| (side, kind == "o"))),
                "c" => {
                    state.values.retain(|&(layer, ..), _| layer != name.parse::<usize>().expect("a layer"));
                }
                "p" => {
                    let (name, robots) = name.split_once('@').unwrap_or((name, "0"));
                    let (layer, value) = name.split_once('.').expect("a value");
                    for robot in robots.split(',') {
                        for place in numbers(rest) {
                            let key =
                                (layer.parse().expect("a layer"), robot.parse().expect("a robot"), place);
                            match value.parse().expect("a value") {
                                0 => state.values.remove(&key),
                                value => state.values.insert(key, value),
                            };
                        }
                    }
                }
                "b" | "u" | "l" | "s" | "d" => {}
                other => panic!("{other} in {line}"),
            }
        }
        state.explored.extend(state.cells.iter().copied());
        states.push(state.clone());
    }
    (film, states)
}

/// The page of these team moves of a run, what came of the run, and its frames.
fn page(setup: &Setup, moves: &RangeInclusive<u32>) -> (String, Report, Vec<Frame>) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.html");
    let mut frames = Vec::new();
    let report = explore(setup, &mut |made| {
        frames.push(made.frame.clone());
        Ok(())
    });
    let report = report.expect("a run");
    let mut file = AtomicFile::new(&path, &Replaceable::default()).expect("a place");
    write(&mut file, setup, &report, moves).expect("a run");
    file.keep().expect("room");
    (fs::read_to_string(path).expect("a page"), report, frames)
}

/// A run of every scheme by each of its rules.
fn setups() -> Vec<Setup> {
    let mut setups = Vec::new();
    for scheme in CATALOGUE.schemes() {
        for rule in scheme.rules {
            let has_cells = ["frontier", "pack"].contains(&scheme.name);
            let kind = if has_cells { "cells:9x7:0.15" } else { "walls:9x7:0.15" };
            let mut layout = kind.parse::<Generator>().expect("a generator").generate(5).expect("a layout");
            let base = Setup::choose_base(&mut layout, None).expect("a free cell");
            let robots = 4;
            let starts = scheme.default_starts(rule.name, &layout, base, robots);
            setups.push(Setup { starts, ..Setup::new(scheme, rule.name, robots, layout, base) });
        }
    }
    setups
}

#[test]
fn the_lines_of_a_page_say_what_the_run_does() {
    let mut marks = 0;
    for setup in setups() {
        let name = format!("{} {}", setup.scheme.name, setup.rule);
        let (page, report, frames) = page(&setup, &(1..=u32::MAX));
        let (film, states) = read(&page);
        let area = report.chart.area();
        let place = |cell: Cell| {
            let (column, row) = area.locate(cell).expect("a cell of the area");
            (row * area.width() + column) as u32
        };
        assert_eq!(states.len(), frames.len() + 1, "{name}");
        assert_eq!(film["of"], report.steps, "{name}");
        for (step, state) in (0..).zip(&states) {
            let explored: BTreeSet<u32> = area
                .cells()
                .filter(|&cell| report.chart.step(cell).is_some_and(|explored| explored <= step))
                .map(place)
                .collect();
            assert_eq!(state.explored, explored, "{name}, team move {step}");
            if let Some(frame) = (step as usize).checked_sub(1).map(|place| &frames[place]) {
                let cells: Vec<u32> = frame.cells.iter().map(|&cell| place(cell)).collect();
                assert_eq!(state.cells, cells, "{name}, team move {step}");
            }
            if setup.scheme.knowledge.is_some() {
                for cell in area.cells() {
                    let value = match report.chart.mark(cell, step) {
                        Mark::Unexplored | Mark::Explored => None,
                        Mark::Closing => Some(&1),
                        Mark::Visited => Some(&2),
                        Mark::Sealed => Some(&3),
                    };
                    marks += usize::from(value.is_some());
                    assert_eq!(state.values.get(&(0, 0, place(cell))), value, "{name}, team move {step}");
                }
            }
        }
        // What was tried is known as it was found.
        for (frame, state) in frames.iter().zip(&states[1..]) {
            for edge in frame.bumps().filter(|edge| area.contains(edge.cell().beyond(edge.side()))) {
                let axis = u32::from(matches!(edge.side(), Side::South | Side::North));
                if area.contains(edge.cell()) {
                    assert!(!state.known[&(2 * place(edge.cell()) + axis)], "{name}");
                }
            }
        }
        let seconds = report.milliseconds.unwrap_or(0);
        assert!(states[states.len() - 1].milliseconds <= seconds, "{name}");
        // A line has the time at which a move begins: the first of each robot may all begin at once.
        if report.steps > 4 {
            assert_eq!(seconds > 0, states[states.len() - 1].milliseconds > 0, "{name}");
        }
    }
    assert!(marks > 1000, "{marks}");
}

#[test]
fn a_page_of_some_team_moves_begins_with_what_there_was_before() {
    for setup in setups() {
        let name = format!("{} {}", setup.scheme.name, setup.rule);
        let (whole, report, _) = page(&setup, &(1..=u32::MAX));
        let (_, all) = read(&whole);
        if report.steps < 2 {
            continue;
        }
        let (first, last) = (report.steps / 2 + 1, report.steps - 1);
        let (film, some) = read(&page(&setup, &(first..=last)).0);
        assert_eq!(film["first"], first - 1, "{name}");
        assert_eq!(some, all[first as usize - 1..=last as usize], "{name}");
    }
}

#[test]
fn each_robots_record_grows_and_is_its_own() {
    let setups = setups();
    let of = |scheme: &str| {
        setups.iter().find(|setup| setup.scheme.name == scheme && setup.rule.as_str() == "repaired")
    };
    for (scheme, layer) in [("kit", 2), ("frontier", 0)] {
        let mut setup = of(scheme).expect("a repaired rule").clone();
        setup.options.loss =
            if scheme == "frontier" { Probability::new(0.5).expect("a half") } else { setup.options.loss };
        let (page, _, frames) = page(&setup, &(1..=u32::MAX));
        let (_, states) = read(&page);
        let of_robot = |state: &State, robot: usize| -> BTreeMap<u32, u32> {
            let values = state.values.iter().filter(|((of, whose, _), _)| (*of, *whose) == (layer, robot));
            values.map(|(&(.., place), &value)| (place, value)).collect()
        };
        let mut differ = 0;
        for pair in states.windows(2) {
            for robot in 0..4 {
                let (before, after) = (of_robot(&pair[0], robot), of_robot(&pair[1], robot));
                assert!(before.iter().all(|(place, value)| after.get(place) == Some(value)), "{scheme}");
                differ += usize::from(after != of_robot(&pair[1], (robot + 1) % 4));
            }
        }
        assert!(differ > 0, "{scheme}");
        if scheme == "kit" {
            // A robot that drives has recorded the path as driven, and nobody else has by that.
            for (frame, state) in frames.iter().zip(&states[1..]) {
                let driver = frame.steps.iter().position(|&step| step != Step::Stay).expect("a drive");
                let Step::Cross(side) = frame.steps[driver] else { panic!("a drive") };
                let edge = Edge::new(frame.cells[driver], side.opposite());
                let axis = u32::from(matches!(edge.side(), Side::South | Side::North));
                let cell = edge.cell();
                let place = 2 * (cell.y as u32 * 9 + cell.x as u32) + axis;
                assert_eq!(of_robot(state, driver).get(&place), Some(&1));
                assert_eq!(state.known.get(&place), Some(&true));
            }
        }
    }
}

/// The runs whose pages have a layer of this name, its number, and what there is after each line.
fn with_layer(name: &str) -> Vec<(Setup, usize, Vec<State>)> {
    let shown = setups().into_iter().filter_map(|setup| {
        let (film, states) = read(&page(&setup, &(1..=u32::MAX)).0);
        let layers = film["layers"].as_array().expect("layers");
        let number = layers.iter().position(|layer| layer["name"] == name)?;
        Some((setup, number, states))
    });
    shown.collect()
}

#[test]
fn rivals_show_which_robot_is_assigned_to_which_frontier_cell() {
    let mut assigned = 0;
    let runs = with_layer("assignment");
    assert_eq!(runs.len(), 4);
    for (setup, layer, states) in runs {
        let rule = setup.rule;
        let of = |state: &State, layer: usize| -> Vec<(usize, u32)> {
            let values = state.values.keys().filter(|(number, ..)| *number == layer);
            values.map(|&(_, robot, place)| (robot, place)).collect()
        };
        let cell = |place: u32| Cell::new(place as i16 % 9, place as i16 / 9);
        for (step, state) in states.iter().enumerate() {
            let own = of(state, layer);
            let (robots, cells): (BTreeSet<usize>, BTreeSet<u32>) = own.iter().copied().unzip();
            assert_eq!((robots.len(), cells.len()), (own.len(), own.len()), "{rule}, {step}");
            assert_eq!(
                of(state, layer + 1).into_iter().map(|(_, place)| place).collect::<BTreeSet<_>>(),
                cells
            );
            for &place in &cells {
                assert!(!state.explored.contains(&place), "{rule}, {step}");
                let beside = Side::ALL.map(|side| cell(place).beyond(side));
                let is_explored = |cell: &Cell| state.explored.contains(&((cell.y * 9 + cell.x) as u32));
                assert!(beside.iter().any(is_explored), "{rule}, {step}");
            }
            assert!(of(state, layer - 1).iter().all(|&(_, place)| !setup.layout.is_free(cell(place))));
            assigned += cells.len();
        }
        let obstacles = of(states.last().expect("an end"), layer - 1);
        assert!(!obstacles.is_empty(), "{rule}");
    }
    assert!(assigned > 100, "{assigned}");
}

#[test]
fn trees_on_a_page_join_explored_cells_and_have_no_loops() {
    let mut sides = [0, 0];
    let runs = with_layer("trees");
    assert!(runs.len() >= 5, "{}", runs.len());
    for (setup, layer, states) in runs {
        for (step, state) in states.iter().enumerate() {
            // The first cell of each part that the sides join so far.
            let mut part: Vec<u32> = (0..63).collect();
            for (&(.., place), &value) in state.values.iter().filter(|((number, ..), _)| *number == layer) {
                sides[value as usize - 1] += 1;
                if value != 1 {
                    continue;
                }
                let name = format!("{} {}, {step}", setup.scheme.name, setup.rule);
                let (one, side) = (place / 2, if place % 2 == 0 { Side::East } else { Side::South });
                let other = if side == Side::East { one + 1 } else { one + 9 };
                assert!(state.explored.contains(&one) && state.explored.contains(&other), "{name}");
                let edge = Edge::new(Cell::new(one as i16 % 9, one as i16 / 9), side);
                assert!(setup.layout.is_open(edge), "{name}");
                let (from, to) = (part[one as usize], part[other as usize]);
                assert_ne!(from, to, "{name}: a loop");
                part.iter_mut().filter(|part| **part == from).for_each(|part| *part = to);
            }
        }
    }
    assert!(sides.iter().all(|&count| count > 100), "{sides:?}");
}

#[test]
fn the_same_run_makes_the_same_page() {
    for setup in setups().iter().take(3) {
        assert_eq!(page(setup, &(1..=u32::MAX)).0, page(setup, &(1..=u32::MAX)).0);
    }
}
