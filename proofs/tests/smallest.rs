//! The smallest counterexamples over areas, barriers, robots and starts, or over networks, each with a certificate of
//! all that is smaller, which was exhausted; and whether the ledger has them.

use std::fmt::Write;

use tautline_proofs::decide::{Cache, Verdict};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::ledger;

/// The refuted clauses of which smaller counterexamples can be asked for.
fn table(is_wanted: impl Fn(&str) -> bool) -> String {
    let (mut table, mut memory) = (String::new(), Cache::default());
    for clause in ledger::clauses().filter(|clause| is_wanted(clause.id)) {
        for check in clause.checks.iter().filter(|check| check.expected() == Verdict::Refuted) {
            let Some(made) = check.smallest().expect("registered checks fit") else { continue };
            assert!(made.is_whole, "{} was cut off", clause.id);
            let decision = check.decide(&mut memory, &mut unwatched).expect("registered checks fit");
            let found = decision.counterexample.expect("what is refuted has a counterexample");
            let (class, moves) = check.size(&found.choices).expect("it has a size");
            let smallest = made.smallest.as_ref().map(|one| (one.class.clone(), one.moves));
            let (id, rule, size) = (clause.id, check.rule(), made.size());
            writeln!(table, "{id} {rule}: {size}").expect("text");
            if smallest != Some((class.clone(), moves)) {
                writeln!(table, "  in the ledger: {class}, {moves} moves").expect("text");
            }
            for (class, cases) in &made.exhausted {
                writeln!(table, "  none in {class}: {cases}").expect("text");
            }
        }
    }
    table
}

/// Those that take minutes.
fn is_long(clause: &str) -> bool {
    ["CHAIN-14", "BRICKS-"].iter().any(|long| clause.starts_with(long))
}

#[test]
fn nothing_is_smaller_than_the_smallest_counterexamples() {
    insta::assert_snapshot!(table(|clause| !is_long(clause)));
}

#[test]
#[ignore = "takes minutes: cargo test --release -p tautline-proofs --test all -- --ignored nothing_is_smaller_than_those"]
fn nothing_is_smaller_than_those_that_take_long() {
    insta::assert_snapshot!(table(is_long), @r"
    CHAIN-14 published: 3×3, 2 barriers, 3 robots, 26 moves
      none in 1 cell, at most 13 barriers, 2 to 5 robots: 4
      none in 2 cells, at most 13 barriers, 2 to 5 robots: 32
      none in 3 cells, at most 13 barriers, 2 to 5 robots: 68
      none in 4 cells, at most 13 barriers, 2 to 5 robots: 264
      none in 5 cells, at most 13 barriers, 3 to 5 robots: 138
      none in 6 cells, at most 13 barriers, 2 to 5 robots: 2367
      none in 7 cells, at most 13 barriers, 4 to 5 robots: 124
      none in 8 cells, at most 13 barriers, 3 to 5 robots: 12113
      none in 9 cells, at most 0 barriers, 2 to 5 robots: 30
      none in 9 cells, at most 1 barrier, 2 to 5 robots: 301
      none in 9 cells, at most 2 barriers, 2 robots: 50
    CHAIN-14 repaired: 3×3, 3 barriers, 3 robots, 32 moves
      none in 1 cell, at most 13 barriers, 2 to 5 robots: 4
      none in 2 cells, at most 13 barriers, 2 to 5 robots: 32
      none in 3 cells, at most 13 barriers, 2 to 5 robots: 68
      none in 4 cells, at most 13 barriers, 2 to 5 robots: 264
      none in 5 cells, at most 13 barriers, 3 to 5 robots: 138
      none in 6 cells, at most 13 barriers, 2 to 5 robots: 2367
      none in 7 cells, at most 13 barriers, 4 to 5 robots: 124
      none in 8 cells, at most 13 barriers, 3 to 5 robots: 12097
      none in 9 cells, at most 0 barriers, 2 to 5 robots: 30
      none in 9 cells, at most 1 barrier, 2 to 5 robots: 301
      none in 9 cells, at most 2 barriers, 2 to 5 robots: 1632
      none in 9 cells, at most 3 barriers, 2 robots: 197
    BRICKS-3 at-once: 3×1, 0 barriers, 2 robots, 8 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 24
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 2088
      none in 3 cells, at most 0 barriers, 1 robot: 92
    BRICKS-4 published: 3×1, 0 barriers, 2 robots, 3 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 12
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 160
      none in 3 cells, at most 0 barriers, 1 robot: 40
    BRICKS-4 published: 3×1, 0 barriers, 2 robots, 3 moves
      in the ledger: 3×2, 0 barriers, 1 robot, 4 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 14
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 464
      none in 3 cells, at most 0 barriers, 1 robot: 76
    BRICKS-4 mdfs: 3×1, 0 barriers, 2 robots, 3 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 12
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 368
      none in 3 cells, at most 0 barriers, 1 robot: 72
    BRICKS-4 tree: 3×1, 0 barriers, 2 robots, 4 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 12
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 352
      none in 3 cells, at most 0 barriers, 1 robot: 116
    BRICKS-5 published: 3×2, 0 barriers, 2 robots, 5 moves
      in the ledger: 3×2, 0 barriers, 1 robot, 4 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 4
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 56
      none in 3 cells, at most 2 barriers, 1 to 2 robots: 508
      none in 4 cells, at most 2 barriers, 1 to 2 robots: 4698
      none in 5 cells, at most 2 barriers, 1 to 2 robots: 5776
      none in 6 cells, at most 0 barriers, 1 to 2 robots: 7744
    BRICKS-6 published: 3×2, 1 barrier, 1 robot, 11 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 12
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 160
      none in 3 cells, at most 2 barriers, 1 to 2 robots: 548
      none in 4 cells, at most 2 barriers, 1 to 2 robots: 3106
      none in 5 cells, at most 2 barriers, 1 to 2 robots: 2914
      none in 6 cells, at most 0 barriers, 1 to 2 robots: 6338
      none in 6 cells, at most 1 barrier, 1 robot: 232
    BRICKS-6 published: 3×2, 0 barriers, 2 robots, 5 moves
      in the ledger: 3×2, 0 barriers, 1 robot, 4 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 14
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 464
      none in 3 cells, at most 2 barriers, 1 to 2 robots: 1786
      none in 4 cells, at most 2 barriers, 1 to 2 robots: 11280
      none in 5 cells, at most 2 barriers, 1 to 2 robots: 10846
      none in 6 cells, at most 0 barriers, 1 to 2 robots: 11336
    BRICKS-6 doubting-1: 3×1, 0 barriers, 2 robots, 11 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 14
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 3172
      none in 3 cells, at most 0 barriers, 1 robot: 448
    BRICKS-6 doubting: 3×1, 0 barriers, 2 robots, 17 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 14
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 45956
      none in 3 cells, at most 0 barriers, 1 robot: 2684
    BRICKS-11 repaired: 1×1, 0 barriers, 2 robots, 2 moves
      none in 1 cell, at most 0 barriers, 1 robot: 4
    BRICKS-12 tree: 3×2, 1 barrier, 1 robot, 13 moves
      none in 1 cell, at most 2 barriers, 1 to 2 robots: 12
      none in 2 cells, at most 2 barriers, 1 to 2 robots: 192
      none in 3 cells, at most 2 barriers, 1 to 2 robots: 948
      none in 4 cells, at most 2 barriers, 1 to 2 robots: 7744
      none in 5 cells, at most 2 barriers, 1 to 2 robots: 11136
      none in 6 cells, at most 0 barriers, 1 to 2 robots: 31988
      none in 6 cells, at most 1 barrier, 1 robot: 352
    ");
}
