//! Each clause that a run can break is broken under some rule, and whoever watches the run notices: a watcher that
//! notices nothing keeps every clause.

use std::collections::BTreeSet;

use crate::common::generated;
use tautline_kernel::ground::Cell;
use tautline_sim::explore::{Catalogue, ClauseId, Limits, RuleId, Setup, run};
use tautline_sim::failures::{Failure, MoveOrder};

/// A setting of a team besides its rule, robots and layout.
#[derive(Clone, Copy, Debug)]
enum TeamSetting {
    Nothing,
    Miss,
    /// A robot dies in a team move.
    Dies(u16, u32),
    OneByOne,
    /// Noise of 2 dB.
    Noise,
    /// Robots hear each other so many cells far.
    Range(u16),
    /// They see two cells far besides.
    SightAndRange(u16),
    /// And two of them start with a cell between them.
    Apart(u16),
}

use TeamSetting::{Apart, Dies, Miss, Noise, Nothing, OneByOne, Range, SightAndRange};

/// A clause, and whether the end of a run breaks it or a team move; the scheme, the rule, and the condition that it
/// lacks, if it lacks one; the layout, the robots, the seed, and what else is told.
type Case = (&'static str, bool, [&'static str; 3], (&'static str, u16, u64), TeamSetting);

const CASES: [Case; 24] = [
    ("CHAIN-1", false, ["chain", "published", ""], ("cells:6x5:0.2", 6, 0), Nothing),
    ("CHAIN-2", false, ["chain", "published", "Distinct"], ("walls:7x5:0.2", 4, 3), Nothing),
    ("CHAIN-3", false, ["chain", "published", "SafeAhead"], ("walls:7x5:0.2", 3, 0), Nothing),
    ("CHAIN-8", true, ["chain", "published", "SafeAhead"], ("walls:7x5:0.2", 3, 0), Nothing),
    ("CHAIN-13", true, ["chain", "published", ""], ("walls:15x15:0.1", 8, 0), Nothing),
    ("CHAIN-19", false, ["chain", "published", ""], ("walls:7x5:0.2", 4, 0), OneByOne),
    ("CHAIN-21", false, ["chain", "published", ""], ("walls:7x5:0.2", 4, 0), Dies(2, 5)),
    ("BRICKS-4", false, ["bricks", "published", ""], ("open:5x4", 2, 0), Miss),
    ("BRICKS-5", true, ["bricks", "published", ""], ("walls:7x5:0.2", 1, 0), Nothing),
    ("BRICKS-6", true, ["bricks", "published", ""], ("open:5x4", 1, 0), Nothing),
    ("KIT-1", false, ["kit", "published", ""], ("walls:3x3:0.2", 2, 0), Range(2)),
    ("KIT-3", false, ["kit", "published", ""], ("walls:3x3:0.2", 2, 0), Nothing),
    ("KIT-6", true, ["kit", "published", ""], ("walls:3x3:0.2", 4, 3), Nothing),
    ("KIT-8", true, ["kit", "repaired", "NextInReach"], ("walls:3x3:0.2", 2, 0), Range(2)),
    ("KIT-12", false, ["kit", "published", ""], ("walls:3x3:0.2", 3, 0), Range(2)),
    ("FRONTIER-1", true, ["frontier", "published", ""], ("cells:6x5:0.2", 1, 0), Nothing),
    ("FRONTIER-2", false, ["frontier", "published", ""], ("cells:6x5:0.2", 3, 1), Nothing),
    ("FRONTIER-4", true, ["frontier", "published", ""], ("cells:6x5:0.2", 1, 0), Nothing),
    ("FRONTIER-5", false, ["frontier", "published", ""], ("cells:6x5:0.2", 3, 3), Noise),
    ("FRONTIER-13", false, ["frontier", "published", ""], ("cells:6x5:0.2", 3, 1), Nothing),
    ("PACK-1", false, ["pack", "published", ""], ("cells:6x5:0.2", 2, 0), SightAndRange(3)),
    ("PACK-2", false, ["pack", "published", "Single"], ("cells:6x5:0.2", 3, 0), Nothing),
    ("PACK-3", true, ["pack", "published", ""], ("cells:6x5:0.2", 3, 1), SightAndRange(3)),
    ("PACK-5", true, ["pack", "published", ""], ("cells:6x5:0.2", 2, 2), Apart(3)),
];

/// The clauses that only the runs of searches break, which have tests of their own, and one that no team is known to
/// break in a run.
const OTHERS: [&str; 9] =
    ["CHAIN-12", "KIT-2", "KIT-7", "KIT-10", "KIT-11", "KIT-13", "KIT-14", "FRONTIER-3", "PACK-4"];

/// The clauses that a run breaks: in team moves, and by its end.
fn broken((_, _, [scheme, rule, lacks], (layout, robots, seed), told): Case) -> [BTreeSet<ClauseId>; 2] {
    let scheme = Catalogue::OWN.scheme(scheme).expect("a scheme");
    let rule = scheme.rule(RuleId::new(rule)).expect("a rule");
    let mut layout = generated(layout, seed);
    let base = Setup::choose_base(&mut layout, None).expect("a free cell");
    let apart = Some(vec![Cell::new(0, 0), Cell::new(2, 0)]);
    let default = scheme.default_starts(rule.name, &layout, base, robots);
    let starts = if matches!(told, Apart(_)) { apart } else { default };
    let mut setup = Setup { starts, seed, ..Setup::new(scheme, rule.name, robots, layout, base) };
    match told {
        Nothing => {}
        Miss => setup.miss = "0.1".parse().expect("a probability"),
        Dies(robot, step) => {
            setup.options.fail = Some(Failure { robot, step: step.try_into().expect("from 1 on") });
        }
        OneByOne => setup.options.going = MoveOrder::OneByOne,
        Noise => setup.options.noise_db = 2.0,
        Range(cells) => setup.options.range_cells = Some(cells),
        SightAndRange(cells) | Apart(cells) => {
            (setup.options.sight_cells, setup.options.range_cells) = (Some(2), Some(cells));
        }
    }
    let mut team = if lacks.is_empty() {
        (rule.start)(&setup)
    } else {
        let switches = rule.switches.expect("conditions");
        let place = switches.conditions().iter().position(|(name, _)| *name == lacks).expect("a condition");
        switches.start(&setup, switches.in_force() & !(1 << place))
    }
    .expect("a team");
    let mut in_moves = BTreeSet::new();
    let report = run(&mut *team, &setup.layout, Limits::default(), &mut |made| {
        assert!(made.step < 10_000, "the run does not end");
        in_moves.extend(made.broken);
        Ok(())
    });
    let all = report.expect("a run").violations.into_iter().map(|violation| violation.clause);
    let at_end = all.filter(|clause| !in_moves.contains(clause)).collect();
    [in_moves, at_end]
}

#[test]
fn every_clause_that_a_run_can_break_is_broken_by_some_team_and_noticed() {
    let (mut wrong, mut noticed) = (Vec::new(), BTreeSet::from(OTHERS.map(ClauseId::new)));
    for case in CASES {
        let (clause, is_at_end, ..) = case;
        let found = broken(case);
        if !found[usize::from(is_at_end)].contains(&ClauseId::new(clause)) {
            wrong.push(format!("{case:?}: {found:?}"));
        }
        noticed.insert(ClauseId::new(clause));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let listed: BTreeSet<ClauseId> =
        Catalogue::OWN.schemes().flat_map(|scheme| scheme.clauses).map(|clause| clause.id).collect();
    assert_eq!(noticed, listed);
}
