//! Milestones in an open area: after how many team moves a chain has explored half, or three quarters, of the cells,
//! and after how few it could have (CHAIN-26). All explorations are tried that the conditions admit, wave by wave, but
//! for those that come too late even if every robot explores a cell in each team move from then on.

use std::fmt::Write;
use std::ops::RangeInclusive;

use rustc_hash::FxHashSet;
use tautline_kernel::chain::Intent;
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, CellMark, Grid, SmallGrid};

use super::optimum::Graph;
use super::reach::Ground;
use super::subject::Subject;
use super::whole_runs::{self, NO_MESSAGE};
use crate::decide::{Context, Depiction, EveryAnswer, Method, MethodResult, RefutationPlay};
use crate::engine::{Choices, Outcome, Replay, ScriptError, Stop, Until, require};
use crate::judge::AnyCase;
use crate::judge::chain::Sooner;

/// A check that no chain has explored so many percent of the cells sooner than the rule.
pub(super) struct Milestone<const PERCENT: u32>;

/// The chains that are looked at.
const ROBOTS: RangeInclusive<u32> = 2..=3;

/// Whether the share is rounded up or down to whole cells.
#[derive(Clone, Copy)]
enum Rounding {
    Up,
    Down,
}

/// How a chain comes to a milestone.
struct Exploration {
    cells: u32,
    /// Cells of the area.
    of: u32,
    /// Team moves that the rule takes.
    moves: u32,
    /// Where the robots are at the start and after each team move of a sooner exploration.
    sooner: Option<Vec<Vec<Cell>>>,
}

impl<const PERCENT: u32> Milestone<PERCENT> {
    const CASES: EveryAnswer<Subject> = EveryAnswer::new(Self::body, Self::range, &["an open area"]);

    fn range() -> String {
        format!("{}, {PERCENT} % of the cells, rounded up and down", whole_runs::chains(&ROBOTS))
    }

    fn reach(observed: &Subject, oracle: &mut dyn Oracle) -> Result<Exploration, Stop> {
        let robots = whole_runs::within(&ROBOTS, oracle) as usize;
        let (area, base) = whole_runs::area(robots);
        let all: Vec<Cell> = area.cells().collect();
        let of = all.len() as u32;
        let cells = match one_of(oracle, &[Rounding::Up, Rounding::Down]) {
            Rounding::Up => (of * PERCENT).div_ceil(100),
            Rounding::Down => of * PERCENT / 100,
        };
        let moves = taken(observed, robots, cells)?;
        let ground = Ground::new(area, base, robots, |_| true).ok_or(Stop::Assumed)?;
        let graph = Graph::new(&ground, &observed.rule).map_err(|_| Stop::Assumed)?;
        let sooner = soonest(&graph, cells, moves - 1);
        let sooner = sooner.map(|path| path.iter().map(|&place| graph.team(place, base, &all)).collect());
        Ok(Exploration { cells, of, moves, sooner })
    }

    fn body(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
        let reached = Self::reach(observed, oracle)?;
        require(reached.sooner.is_none(), "no chain has explored so many cells sooner")?;
        Ok("an open area")
    }

    /// The sooner exploration, in lines.
    fn story(observed: &Subject, choices: &Choices) -> Depiction {
        let answers: Vec<u32> = choices.all().collect();
        let Ok(reached) = Self::reach(observed, &mut Replay::new(&answers)) else {
            return Depiction::Choices;
        };
        let Exploration { cells, of, moves, sooner } = reached;
        let teams = sooner.unwrap_or_default();
        let fewest = teams.len().saturating_sub(1);
        let mut story = format!(
            "{cells} of {of} cells: the rule takes {moves} team moves, and these {fewest} are enough, base first.\n\n"
        );
        for (made, team) in teams.iter().enumerate() {
            let team: Vec<String> = team.iter().map(Cell::to_string).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(story, "{made:>4}  {}", team.join("  "));
        }
        Depiction::Story(story)
    }
}

impl<const PERCENT: u32> Method<Subject> for Milestone<PERCENT> {
    fn engine(&self) -> &'static str {
        Self::CASES.engine()
    }

    fn bound(&self) -> String {
        Self::range()
    }

    fn decide(&self, observed: &Subject, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let mut answer = Self::CASES.decide(observed, until, context)?;
        if let Some(evidence) = &mut answer.counterexample {
            evidence.seen = Self::story(observed, &evidence.choices);
        }
        Ok(answer)
    }

    fn case(&self, observed: &Subject, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        let answers: Vec<u32> = choices.all().collect();
        let reached = Self::reach(observed, &mut Replay::new(&answers)).ok()?;
        let (teams, cells) = (reached.sooner?, reached.cells as usize);
        let step = |(from, to): (&Cell, &Cell)| (i32::from(to.x - from.x), i32::from(to.y - from.y));
        let steps = |pair: &[Vec<Cell>]| pair[0].iter().zip(&pair[1]).map(step).collect();
        let robots = teams.first()?.len();
        Some(Box::new(Sooner { robots, cells, moves: teams.windows(2).map(steps).collect() }))
    }

    fn replay(&self, observed: &Subject, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let mut play = Self::CASES.replay(observed, choices)?;
        play.evidence.seen = Self::story(observed, choices);
        Ok(play)
    }
}

/// The team moves after which a chain has explored so many cells of an open area.
fn taken(observed: &Subject, robots: usize, cells: u32) -> Result<u32, Stop> {
    let mut chain = whole_runs::start::<_, 8>(observed, robots, SmallGrid::new)?;
    let (mut log, mut moves) = (Vec::new(), 0);
    loop {
        let grid = chain.grid();
        let explored = grid.area().cells().filter(|&cell| grid.has(CellMark::Explored, cell)).count();
        if explored as u32 >= cells {
            return Ok(moves);
        }
        let Intent::Go(plan) = chain.plan(&log).map_err(|_| NO_MESSAGE)? else {
            return Err(Stop::Violated("the chain explores an open area"));
        };
        log.extend_from_slice(chain.settle(&plan, |_| true).messages());
        moves += 1;
    }
}

/// The configurations of a shortest exploration of so many cells in at most `most` team moves, if there is one.
fn soonest(graph: &Graph, cells: u32, most: u32) -> Option<Vec<u32>> {
    let movers = graph.robots as u32 - 1;
    // By configuration and cells explored, each with the node before.
    let mut nodes = vec![((0_u32, graph.occupied[0]), 0)];
    let mut known = FxHashSet::from_iter([nodes[0].0]);
    let mut wave = 0..1;
    for left in (0..most).rev() {
        for parent in wave.clone() {
            let (place, explored) = nodes[parent].0;
            for &next in &graph.next[place as usize] {
                let explored = explored | graph.occupied[next as usize];
                let count = explored.count_ones();
                if count + left * movers >= cells && known.insert((next, explored)) {
                    nodes.push(((next, explored), parent));
                    if count >= cells {
                        return Some(path(&nodes));
                    }
                }
            }
        }
        wave = wave.end..nodes.len();
    }
    None
}

/// The configurations on the way to the last node.
fn path(nodes: &[((u32, u128), usize)]) -> Vec<u32> {
    let mut index = nodes.len() - 1;
    let mut path = vec![nodes[index].0.0];
    while index != 0 {
        index = nodes[index].1;
        path.push(nodes[index].0.0);
    }
    path.reverse();
    path
}

#[cfg(test)]
mod tests {
    use tautline_kernel::chain::Rule;
    use tautline_kernel::ground::{Side, Step};

    use super::*;
    use crate::judge::Case;

    #[test]
    fn three_robots_take_a_team_move_more_than_they_must_to_half_and_to_three_quarters() {
        let (area, base) = whole_runs::area(3);
        let ground = Ground::new(area, base, 3, |_| true).expect("a base inside");
        let graph = Graph::new(&ground, &Rule::PUBLISHED).expect("few configurations");
        for (cells, moves) in [(12, 8), (13, 9), (18, 12), (19, 13)] {
            for observed in [Subject::PUBLISHED, Subject::REPAIRED, Subject::REEL] {
                assert_eq!(taken(&observed, 3, cells), Ok(moves), "{cells} cells");
            }
            let sooner = soonest(&graph, cells, moves).expect("the rule takes no more");
            assert_eq!(sooner.len() as u32 - 1, moves - 1, "{cells} cells");
        }
    }

    /// The steps of R_2 … R_8 in each team move: 0 stays, 1 … 4 go east, south, west and north.
    const HALF_OF_225: &str = "1040302 4433222 3333333 3403433 0304333 0233333 0002333 0444033 0044444 0220003 \
        0404444 0040444 0004444 0000444 0000044 0000044 0111111 1011111 1111111 0111111 0111111 0001111 0011111 \
        0001111 0000111 0000111 2222220 2222222 0222222 0222222 0022222 0022221";

    #[test]
    fn eight_robots_can_explore_half_of_the_papers_cells_in_32_team_moves_where_the_rule_takes_34() {
        let (area, base) = whole_runs::area(8);
        let mut grid = SmallGrid::new(area).expect("fifteen cells wide");
        let mut team = vec![base; 8];
        let mut explored = FxHashSet::from_iter([base]);
        let mut sooner = Sooner { robots: 8, cells: 113, moves: Vec::new() };
        for steps in HALF_OF_225.split_whitespace() {
            let step = |digit: u8| match usize::from(digit - b'0') {
                0 => Step::Stay,
                side => Step::Cross(Side::ALL[side - 1]),
            };
            let steps: Vec<Step> = std::iter::once(b'0').chain(steps.bytes()).map(step).collect();
            assert!(Rule::PUBLISHED.admits_plan(&mut grid, &team, &steps), "{team:?}");
            let origin = Cell::new(0, 0);
            let offset = |step: &Step| (origin.after(*step).x.into(), origin.after(*step).y.into());
            sooner.moves.push(steps.iter().map(offset).collect());
            team.iter_mut().zip(steps).for_each(|(cell, step)| *cell = cell.after(step));
            assert!(team.iter().all(|&cell| area.contains(cell)), "{team:?}");
            explored.extend(team.iter().copied());
        }
        assert_eq!((explored.len(), HALF_OF_225.split_whitespace().count()), (113, 32));
        assert_eq!([112, 113].map(|cells| taken(&Subject::PUBLISHED, 8, cells)), [Ok(34), Ok(34)]);
        // The judge, which follows the rule by itself, agrees.
        assert_eq!(sooner.judge(), Ok(()));
    }
}
