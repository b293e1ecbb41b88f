//! The atlas of the chain: for each rule and number of robots, what becomes of all runs in all layouts within a bound
//! on the walls met. All counts are exact.

use std::ops::ControlFlow;

use serde::Serialize;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::search::{Bounds, Counterexample};
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::run::walls;

use crate::counterexample::hunt;
use crate::explore::RuleName;
use crate::fault::Halt;

/// A number of robots, and the bound on the walls that one run meets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sheet {
    /// Robots, base included.
    pub robots: u16,
    /// Most walls that are met in one run.
    pub max_walls: u32,
    /// Whether it is asked what a chain could have reached by any team moves at all.
    pub reach: Reach,
}

/// Whether runs are counted that miss a cell which is not within reach but which a chain could reach all the same: that
/// takes long.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reach {
    /// They are.
    Counted,
    /// They are not.
    LeftOut,
}

const fn sheet(robots: u16, max_walls: u32, reach: Reach) -> Sheet {
    Sheet { robots, max_walls, reach }
}

/// What takes seconds. All 12 edges of two robots can be walls: nothing is left out.
pub const QUICK: [Sheet; 6] = [
    sheet(2, 12, Reach::Counted),
    sheet(3, 5, Reach::Counted),
    sheet(4, 4, Reach::Counted),
    sheet(5, 3, Reach::Counted),
    sheet(6, 2, Reach::LeftOut),
    sheet(8, 1, Reach::LeftOut),
];

/// What takes the better part of an hour.
pub const DEEP: [Sheet; 6] = [
    sheet(2, 12, Reach::Counted),
    sheet(3, 8, Reach::LeftOut),
    sheet(4, 6, Reach::LeftOut),
    sheet(5, 5, Reach::LeftOut),
    sheet(6, 3, Reach::LeftOut),
    sheet(8, 2, Reach::LeftOut),
];

/// One rule on one sheet.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Line {
    /// As published or repaired.
    pub rule: RuleName,
    /// Robots, base included.
    pub robots: u16,
    /// Most walls that are met in one run.
    pub max_walls: u32,
    /// Edges that can be walls.
    pub edges: u32,
    /// Layouts with at most so many walls: all of them are covered, and those with more of which no run meets more.
    #[serde(serialize_with = "as_string")]
    pub layouts: u128,
    /// Leaves of the tree of runs.
    pub runs: u64,
    /// Its edges.
    pub moves: u64,
    /// Team moves of the longest run.
    pub longest: u32,
    /// What the runs break.
    pub broken: Vec<Broken>,
    /// Whether it was looked for runs that break CHAIN-14 and not CHAIN-13.
    pub looked_beyond: bool,
}

fn as_string<S: serde::Serializer>(number: &u128, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(number)
}

/// The runs that break a clause.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Broken {
    /// Its id.
    pub clause: &'static str,
    /// How many.
    pub runs: u64,
    /// Walls of the smallest.
    pub walls: Vec<[Cell; 2]>,
    /// Its team moves.
    pub steps: usize,
}

impl Broken {
    fn of(found: &Counterexample) -> Self {
        let between = |wall: &Edge| [wall.cell(), wall.cell().beyond(wall.side())];
        Self {
            clause: found.broken.clause(),
            runs: found.runs,
            walls: walls(&found.frames).iter().map(between).collect(),
            steps: found.frames.len(),
        }
    }
}

/// The clauses of the atlas, in order.
pub const CLAUSES: [&str; 6] = [
    Breach::Contact.clause(),
    Breach::Crowding.clause(),
    Breach::Coverage.clause(),
    Invariant::Ends.clause(),
    Breach::Completeness.clause(),
    BEYOND,
];

/// The clause that is looked for only where it is quickly decided.
pub const BEYOND: &str = Invariant::Exhausts.clause();

/// Searches all layouts of `sheet` under `rule`. `watch` hears how far the search is, and may stop the work.
///
/// # Errors
/// [`Halt`] if it was stopped.
pub fn line(
    sheet: Sheet,
    rule: RuleName,
    watch: &mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>,
) -> Result<Line, Halt> {
    let mut bounds = Bounds::new(rule.observed(), sheet.robots.into(), sheet.max_walls);
    if sheet.reach == Reach::Counted {
        bounds.invariants.push(Invariant::Exhausts);
    }
    let mut search = hunt::start(&bounds)?;
    while search.wave() {
        if watch(&search.progress()).is_break() {
            return Err(Halt::Interrupted);
        }
    }
    let edges = search.progress().edges;
    let found = search.found();
    Ok(Line {
        rule,
        robots: sheet.robots,
        max_walls: sheet.max_walls,
        edges,
        layouts: layouts(edges, sheet.max_walls),
        runs: found.runs,
        moves: found.moves,
        longest: found.longest,
        broken: found.counterexamples.iter().map(Broken::of).collect(),
        looked_beyond: sheet.reach == Reach::Counted,
    })
}

/// The number of sets of at most `most` of `edges`.
fn layouts(edges: u32, most: u32) -> u128 {
    let sets = (0..u128::from(most)).scan(1_u128, |sets, less| {
        *sets = *sets * u128::from(edges).saturating_sub(less) / (less + 1);
        Some(*sets)
    });
    1 + sets.sum::<u128>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layouts_are_counted_as_sets_of_walls() {
        assert_eq!(layouts(12, 12), 1 << 12);
        assert_eq!(layouts(84, 0), 1);
        assert_eq!(layouts(84, 2), 1 + 84 + 84 * 83 / 2);
    }
}
