//! The atlas of the chain: for each rule and number of robots, what becomes of all runs in all layouts within a bound
//! on the walls met. All counts are exact.

use std::fmt::Write;

use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::search::{Bounds, Counterexample};
use tautline_proofs::run::walls;

use super::prelude::*;
use tautline_grids::layout::ColumnRow;
use tautline_sim::explore::RuleName;
use tautline_sim::explore::chain::hunt::start;

/// The atlas.
#[derive(Clone, Copy, Debug)]
pub struct Atlas;

settings! {
    /// How far is searched.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// More walls: many minutes instead of seconds
        pub depth: Depth = Depth::Quick, flag("deep", Depth::Deep);
    }
}

/// How many walls are allowed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub enum Depth {
    /// Sheets that take seconds.
    Quick,
    /// Sheets that take the better part of an hour.
    Deep,
}

impl Depth {
    const fn sheets(self) -> [Sheet; 6] {
        match self {
            Self::Quick => QUICK,
            Self::Deep => DEEP,
        }
    }
}

/// A sheet, and a rule on it.
type Job = (Sheet, RuleName);

/// The findings of a search.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct SearchResult {
    edges: u32,
    runs: u64,
    moves: u64,
    longest: u32,
    broken: Vec<ViolationCount>,
}

/// The whole atlas.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    /// Sheet by sheet, each under every rule.
    pub lines: Vec<Line>,
}

/// A number of robots, and the bound on the walls that one run meets.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
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
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub enum Reach {
    /// They are.
    Counted,
    /// They are not.
    LeftOut,
}

const fn sheet(robots: u16, max_walls: u32, reach: Reach) -> Sheet {
    Sheet { robots, max_walls, reach }
}

/// All 12 edges of two robots can be walls: nothing is left out.
const QUICK: [Sheet; 6] = [
    sheet(2, 12, Reach::Counted),
    sheet(3, 5, Reach::Counted),
    sheet(4, 4, Reach::Counted),
    sheet(5, 3, Reach::Counted),
    sheet(6, 2, Reach::LeftOut),
    sheet(8, 1, Reach::LeftOut),
];

/// Sheets with more walls.
const DEEP: [Sheet; 6] = [
    sheet(2, 12, Reach::Counted),
    sheet(3, 8, Reach::LeftOut),
    sheet(4, 6, Reach::LeftOut),
    sheet(5, 5, Reach::LeftOut),
    sheet(6, 3, Reach::LeftOut),
    sheet(8, 2, Reach::LeftOut),
];

/// One rule on one sheet.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize)]
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
    #[schemars(with = "String")]
    pub layouts: u128,
    /// Leaves of the tree of runs.
    pub runs: u64,
    /// Its edges.
    pub moves: u64,
    /// Team moves of the longest run.
    pub longest: u32,
    /// The clauses that the runs break.
    pub broken: Vec<ViolationCount>,
    /// Whether it was looked for runs that break CHAIN-14 and not CHAIN-13.
    pub looked_beyond: bool,
}

fn as_string<S: serde::Serializer>(number: &u128, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(number)
}

/// The runs that break a clause.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct ViolationCount {
    /// Its id.
    pub clause: String,
    /// How many.
    pub runs: u64,
    /// Walls of the smallest.
    #[schemars(with = "Vec<[ColumnRow; 2]>")]
    pub walls: Vec<[Cell; 2]>,
    /// Its team moves.
    pub steps: usize,
}

impl ViolationCount {
    fn of(found: &Counterexample) -> Self {
        let between = |wall: &Edge| [wall.cell(), wall.cell().beyond(wall.side())];
        Self {
            clause: found.broken.clause().to_owned(),
            runs: found.runs,
            walls: walls(&found.frames).iter().map(between).collect(),
            steps: found.frames.len(),
        }
    }
}

/// The clauses of the atlas, in order.
const CLAUSES: [&str; 6] = [
    Breach::Contact.clause(),
    Breach::Crowding.clause(),
    Breach::Coverage.clause(),
    Invariant::Ends.clause(),
    Breach::Completeness.clause(),
    BEYOND,
];

/// The clause that is looked for only where it is quickly decided.
const BEYOND: &str = Invariant::Exhausts.clause();

impl Table for Atlas {
    type Settings = Settings;
    type Job = Job;
    type Sample = SearchResult;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "atlas",
            shows: "all runs of the chain in all layouts with few walls, by rule and number of robots: how many there \
                    are, how long, and how many break which clause",
            help: "What becomes of all runs in all layouts with few walls, by rule and number of robots",
            examples: &["atlas", "atlas --deep --format json"],
            doing: "searching",
            takes: "half a minute",
            ..Description::NOTHING
        }
    }

    /// A search uses all threads by itself, and one takes most of the time.
    fn threads(&self) -> Threads {
        Threads::AllForEach
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(pairs(settings.depth.sheets(), RuleName::ALL).collect())
    }

    fn measure(
        &self,
        _: &Settings,
        &(sheet, rule): &Job,
        observer: &dyn Observer,
    ) -> Result<SearchResult, Halt> {
        let mut bounds = Bounds::new(rule.observed(), sheet.robots.into(), sheet.max_walls);
        if sheet.reach == Reach::Counted {
            bounds.invariants.push(Invariant::Exhausts);
        }
        let what = format!("{} robots, {rule}", sheet.robots);
        let mut search = start(&bounds)?;
        while search.wave() {
            observer.searched(&what, &search.progress())?;
        }
        let edges = search.progress().edges;
        let found = search.found();
        Ok(SearchResult {
            edges,
            runs: found.runs,
            moves: found.moves,
            longest: found.longest,
            broken: found.counterexamples.iter().map(ViolationCount::of).collect(),
        })
    }

    fn merge(&self, _: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let line = |((sheet, rule), searched): (Job, SearchResult)| {
            let SearchResult { edges, runs, moves, longest, broken } = searched;
            let Sheet { robots, max_walls, reach } = sheet;
            let layouts = layouts(edges, max_walls);
            let looked_beyond = reach == Reach::Counted;
            Line { rule, robots, max_walls, edges, layouts, runs, moves, longest, broken, looked_beyond }
        };
        Ok(Summary { lines: results.into_iter().map(line).collect() })
    }

    fn text(&self, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        let mut columns = Columns::of(&merged.lines)
            .right("N", |line| line.robots)
            .right("walls", |line| line.max_walls)
            .right("rule", |line| line.rule)
            .right("layouts", |line| line.layouts)
            .right("runs", |line| line.runs)
            .right("team moves", |line| line.moves)
            .right("longest", |line| line.longest);
        for clause in CLAUSES {
            columns = columns.right(clause, |line| line.runs_that_break(clause));
        }
        let mut text = format!(
            "All runs in all layouts of (2N−1)² cells, the base in the middle, by \
             the walls that a run meets at most\n\n{}\n\
             layouts: with at most so many walls, all covered · runs, team moves: \
             leaves and edges of the tree of runs ·\n\
             longest: team moves of the longest run · CHAIN-…: runs that break \
             the clause, whatever else they break ·\n\
             -: not looked for\n\
             \nThe smallest counterexamples in these areas, by walls, then team moves\n",
            columns.text()
        );
        for Line { robots, rule, broken, .. } in &merged.lines {
            for ViolationCount { clause, walls, steps, .. } in broken {
                let between: Vec<String> =
                    walls.iter().map(|[one, other]| format!("{one}|{other}")).collect();
                let (walls, moves) = (counted(walls.len(), "wall"), counted(*steps, "team move"));
                let between = between.join(" ");
                let _ = writeln!(text, "{robots} robots, {rule}: {clause}, {walls}, {moves}: {between}");
            }
        }
        Ok(text)
    }

    /// That some chain-reachable cells are missed is registered; all else the repaired rule must keep to.
    fn is_broken(&self, merged: &Summary) -> bool {
        let repaired = merged.lines.iter().filter(|line| line.rule == RuleName::Repaired);
        repaired.flat_map(|line| &line.broken).any(|broken| broken.clause != BEYOND)
    }
}

impl Line {
    fn runs_that_break(&self, clause: &str) -> String {
        match self.broken.iter().find(|broken| broken.clause == clause) {
            Some(broken) => broken.runs.to_string(),
            None if clause == BEYOND && !self.looked_beyond => "-".to_owned(),
            None => "0".to_owned(),
        }
    }
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
