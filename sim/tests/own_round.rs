//! A run that comes back is held against each demand on runs without an end by itself: what was so once stays met, and
//! what is owed must be owed throughout the round.

use tautline_grids::layout::Layout;
use tautline_kernel::ground::{Cell, Side};
use tautline_proofs::team::{Act, Demand, Ground, Places, Rule, Scene, Setting, View};
use tautline_sim::explore::{Limits, Own, StopReason, run};

/// A robot that goes east until it meets a wall, and turns, to the right or about.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Walk {
    Round,
    ToAndFro,
}

impl Rule for Walk {
    type Memory = Side;
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) -> Side {
        Side::East
    }

    fn act(&self, view: &mut View<'_, Self>, heading: &mut Side) -> Act {
        if view.was_blocked() {
            *heading = if *self == Self::Round { heading.turned_right() } else { heading.opposite() };
        }
        Act::Go(*heading)
    }
}

/// The cells in which no robot is, a bit for each.
fn unvisited(scene: &Scene<Walk>) -> u16 {
    scene.cells().fold(0b1111, |left, cell| left & !(1 << (cell.y * 2 + cell.x)))
}

static SETTING: Setting<'static, Walk> = Setting {
    demands: &[
        Demand::again_and_again("W-1", "every cell is visited again and again", &unvisited),
        Demand::eventually("W-2", "the robot leaves its cell", &|scene| scene.cell(0).x > 0),
        Demand::never_endless("W-3", "every run ends"),
    ],
    ..Setting::new("walk", Ground::open(2, 2), 1, Places::At(|_| vec![Cell::new(0, 0)]))
};

const OPEN: &str = "\
tautline layout 1
+--+--+
|     |
+  +  +
|     |
+--+--+
";

#[test]
fn a_round_breaks_what_is_owed_throughout_and_no_more() {
    let layout: Layout = OPEN.parse().expect("a layout");
    for (rule, broken) in [(Walk::Round, "W-3"), (Walk::ToAndFro, "W-1 W-3")] {
        let playing = SETTING.in_layout(&rule, &[Cell::new(0, 0)], Vec::new());
        let report = run(&mut Own::new(playing, 0), &layout, Limits::default(), &mut |_| Ok(()));
        let report = report.expect("a run");
        let clauses: Vec<String> = report.violations.iter().map(|found| found.clause.to_string()).collect();
        assert_eq!((report.stopped, clauses.join(" ").as_str()), (StopReason::Endless, broken));
    }
}
