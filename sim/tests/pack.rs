//! Packs in whole layouts: what the repaired rule promises holds, and what is no pack is refused with a remedy.

use crate::common::generated;
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;
use tautline_sim::explore::pack::PACK;
use tautline_sim::explore::{ExplorationRequest, Report, RuleId, StopReason, explore};
use tautline_sim::options::Options;

fn asked(rule: RuleId, sight_cells: u16, range_cells: u16) -> ExplorationRequest {
    ExplorationRequest {
        robots: Some(4),
        options: Options { sight_cells: Some(sight_cells), range_cells: Some(range_cells), ..Options::USUAL },
        ..ExplorationRequest::new(&PACK, rule)
    }
}

fn ran(asked: ExplorationRequest, ground: &str, seed: u64) -> Result<Report, Diagnostic> {
    let setup = asked.setup(generated(ground, seed))?;
    Ok(explore(&setup, &mut |_| Ok(())).map_err(|_| ()).expect("a run"))
}

#[test]
fn a_pack_explores_all_that_one_robot_could_and_stays_connected() {
    for (sight, range) in [(1, 3), (3, 4), (6, 12)] {
        for seed in 0..6 {
            let report =
                ran(asked(RuleId::REPAIRED, sight, range), "cells:20x20:0.25", seed).expect("a pack");
            assert_eq!(report.violations, [], "R_s {sight}, R_c {range}, seed {seed}");
            assert_eq!((report.explored, report.stopped), (report.cells, StopReason::Explored));
        }
    }
}

#[test]
fn robots_that_only_follow_the_definitions_wait_for_each_other() {
    let stuck = |seed| {
        let report = ran(asked(RuleId::PUBLISHED, 3, 4), "cells:20x20:0.25", seed).expect("a pack");
        report.stopped == StopReason::Exhausted && report.explored < report.cells
    };
    assert!((0..6).any(stuck));
}

#[test]
fn what_is_no_pack_is_refused() {
    let refused = |asked: ExplorationRequest| {
        let setup = asked.setup(generated("open:9x9", 0)).expect("it fits its scheme");
        tautline_sim::explore::team(&setup).map(|_| ()).expect_err("it is refused").to_string()
    };
    let far: Vec<Cell> = [(0, 0), (8, 8), (0, 1), (8, 7)].into_iter().map(Cell::from).collect();
    for (wrong, why) in [
        (asked(RuleId::REPAIRED, 0, 4), "from 1 to 31 cells"),
        (asked(RuleId::REPAIRED, 32, 4), "from 1 to 31 cells"),
        (asked(RuleId::REPAIRED, 3, 2), "3 cells far or more"),
        (
            ExplorationRequest { starts: far, ..asked(RuleId::REPAIRED, 3, 4) },
            "is not connected: links join 2 of its 4 robots",
        ),
    ] {
        let said = refused(wrong);
        assert!(said.contains(why), "{said}");
    }
}
