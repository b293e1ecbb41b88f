//! Laps of Brick&Mortar agents that are cut short after so many moves: whatever their reach and patience, a run without
//! missed sensors that ends has visited every cell. Their moves are pinned, since a lap that ends otherwise still ends.

use std::fmt::Write;

use crate::common::generated;
use crc32fast::Hasher;
use insta::assert_snapshot;
use tautline_grids::chance::Probability;
use tautline_kernel::bricks::{Condition, Rule};
use tautline_kernel::ground::Cell;
use tautline_sim::explore::agents::Agents;

/// The team moves that agents take by a rule, and a checksum of their steps.
fn run(rule: Rule, layout: &str, robots: usize, chance: Probability) -> String {
    let layout = generated(layout, 5);
    let free: Vec<Cell> = layout.cells().filter(|&cell| layout.is_free(cell)).collect();
    let starts: Vec<Cell> = (0..robots).map(|robot| free[robot * free.len() / robots]).collect();
    let mut agents = Agents::new(rule, &layout, &starts, chance, 5);
    let (mut moves, mut done) = (0, Hasher::new());
    while !agents.is_over() && moves < 1500 {
        agents.advance();
        moves += 1;
        for step in agents.steps() {
            done.update(&[step.place() as u8]);
        }
    }
    if chance.is_never() && agents.is_over() {
        let whole = agents.whole();
        assert_eq!((whole.visited, whole.active), (whole.cells, 0), "{rule:?}");
    }
    format!("{moves:>5} {:08x}", done.finalize())
}

#[test]
fn laps_of_every_reach_end_where_they_have_ended() {
    let mut table = String::new();
    let rare = Probability::new(0.02).expect("a probability");
    for (name, rule) in [
        ("repaired", Rule::REPAIRED),
        ("always laps", Rule::REPAIRED.without(Condition::LeastCrossed)),
        ("robust", Rule::ROBUST),
    ] {
        for (reach, patience) in [(1, 1), (3, 0), (6, 4), (13, 8), (40, 2)] {
            let rule = Rule { reach, patience, ..rule };
            write!(table, "{name:<12}{reach:>3}{patience:>3}").expect("text");
            for (layout, robots) in [("walls:8x7:0.25", 1), ("cells:11x10:0.25", 1), ("cells:12x12:0.3", 3)] {
                for chance in [Probability::NEVER, rare] {
                    write!(table, "  |{}", run(rule, layout, robots, chance)).expect("text");
                }
            }
            table.push('\n');
        }
    }
    assert_snapshot!(table);
}
