//! Hunts of rivals that assign robots to cells: all layouts and starts are tried, smallest first.

use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::engine::cases::{self, Cases};
use tautline_proofs::plural::listed;
use tautline_proofs::protocol::arrangements;

use super::super::team::ENDS;
use super::{bounds, report, sized};
use crate::explore::by_layout::{Each, FoundBy};
use crate::explore::hunt::{Bound, Exhibit, Finding, HuntReport, HuntRequest};
use crate::explore::states::{Count, Small};
use crate::explore::{ClauseId, Course, Limits, RuleId, Scheme, Setup, Violation, team};
use tautline_grids::layout::Layout;

/// Team moves after which a rival is watched no longer.
const MOST_MOVES: u32 = 1000;

/// Rivals, of which every layout is tried.
#[derive(Debug)]
pub(in crate::explore::frontier) struct RivalHunt;

impl Each for RivalHunt {
    type Layouts = Layouts;

    const TAKES: &'static [Bound] = &[Bound::Walls];

    fn layouts(&self, asked: &HuntRequest<'_>) -> Result<Layouts, Diagnostic> {
        let (size, robots) = bounds(asked, Small::MOST_CELLS as u64)?;
        let &HuntRequest { scheme, rule, .. } = asked;
        Ok(Layouts {
            scheme,
            rule,
            robots: robots as usize,
            max_walls: asked.bounds.max_walls.unwrap_or(u32::MAX),
            areas: size.areas(),
        })
    }

    fn so_far(&self, _: &HuntRequest<'_>, (count, _): &FoundBy<Self>) -> String {
        format!("layouts {}, moves {}", count.states, count.steps)
    }

    fn report(
        &self,
        asked: &HuntRequest<'_>,
        (count, found): FoundBy<Self>,
        is_complete: bool,
    ) -> Result<HuntReport, Diagnostic> {
        let bounds = bounds(asked, Small::MOST_CELLS as u64)?;
        let looked_for = asked.scheme.clauses.iter().map(|clause| clause.id.as_str()).collect();
        Ok(report(asked, bounds, Count { looked_for, is_complete, ..count }, found))
    }
}

/// All layouts, and all starts in each.
pub(in crate::explore::frontier) struct Layouts {
    scheme: Scheme,
    rule: RuleId,
    robots: usize,
    /// Most obstacles.
    max_walls: u32,
    areas: Vec<(i16, i16)>,
}

/// An area, and which of its cells are blocked, row by row.
#[derive(Clone, Copy)]
pub(in crate::explore::frontier) struct BlockedArea {
    area: (i16, i16),
    set: u32,
}

/// The findings in a layout.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::explore::frontier) struct LayoutFindings {
    /// Runs, one for each start.
    runs: u64,
    /// Team moves.
    steps: u64,
    /// The first run that breaks each clause.
    broken: Vec<BrokenClause>,
}

/// A run that breaks a clause.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct BrokenClause {
    clause: ClauseId,
    /// The number of its start.
    start: usize,
    steps: u32,
}

impl cases::Outcome for LayoutFindings {
    fn steps(&self) -> u64 {
        self.steps
    }

    fn is_whole(&self) -> bool {
        true
    }

    fn is_enough(&self) -> bool {
        false
    }
}

impl Cases for Layouts {
    type Stage = (i16, i16);
    type Case = BlockedArea;
    type Outcome = LayoutFindings;
    type Findings = (Count, Vec<Finding>);
    type Error = Diagnostic;

    fn stages(&self) -> Vec<(i16, i16)> {
        self.areas.clone()
    }

    fn cases(&self, area: (i16, i16)) -> Result<Vec<BlockedArea>, Diagnostic> {
        let mut sets: Vec<u32> = (0..1_u32 << (area.0 * area.1)).collect();
        sets.retain(|set| set.count_ones() <= self.max_walls);
        sets.sort_by_key(|set| (set.count_ones(), *set));
        Ok(sets.into_iter().map(|set| BlockedArea { area, set }).collect())
    }

    fn weight(&self, _: (i16, i16), blocked: &BlockedArea) -> u64 {
        u64::from(blocked.cells(false).len() as u32).saturating_pow(self.robots as u32 + 1)
    }

    fn examine(&self, _: (i16, i16), blocked: &BlockedArea, _: u64) -> Result<LayoutFindings, Diagnostic> {
        let mut tried = LayoutFindings { runs: 0, steps: 0, broken: Vec::new() };
        for (start, starts) in blocked.starts(self.robots).iter().enumerate() {
            let setup = self.setup(blocked, starts)?;
            if setup.layout.reachable(starts).len() < starts.len() {
                continue;
            }
            let (steps, broken) = try_one(&setup)?;
            tried.runs += 1;
            tried.steps += u64::from(steps);
            for Violation { clause, step: steps } in broken {
                if tried.broken.iter().all(|known| known.clause != clause) {
                    tried.broken.push(BrokenClause { clause, start, steps });
                }
            }
        }
        Ok(tried)
    }

    fn add(
        &self,
        (count, found): &mut (Count, Vec<Finding>),
        blocked: &BlockedArea,
        outcome: LayoutFindings,
    ) -> Result<(), Diagnostic> {
        count.states += outcome.runs;
        count.steps += outcome.steps;
        for BrokenClause { clause, start, steps } in outcome.broken {
            if found.iter().all(|known| known.clause != clause.as_str())
                && let Some(starts) = blocked.starts(self.robots).get(start)
            {
                found.push(finding(self.setup(blocked, starts)?, clause, steps));
            }
        }
        Ok(())
    }

    fn cover(&self, (count, _): &mut (Count, Vec<Finding>), area: (i16, i16)) {
        count.covers(area, &self.areas);
    }
}

impl BlockedArea {
    fn cells(&self, is_blocked: bool) -> Vec<Cell> {
        let (width, height) = self.area;
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| Cell::new(x, y)));
        let wanted = cells.enumerate().filter(|(place, _)| (self.set >> place & 1 == 1) == is_blocked);
        wanted.map(|(_, cell)| cell).collect()
    }

    /// Every way in which so many robots can start: who has the lower number matters.
    fn starts(&self, robots: usize) -> Vec<Vec<Cell>> {
        arrangements(&self.cells(false), robots)
    }
}

impl Layouts {
    fn setup(&self, blocked: &BlockedArea, starts: &[Cell]) -> Result<Setup, Diagnostic> {
        let (width, height) = blocked.area;
        let layout = Layout::open(width as u64, height as u64)?.with_blocked(blocked.cells(true));
        let setup = HuntRequest::new(self.scheme, self.rule).setup(layout, starts.to_vec(), None)?;
        Ok(Setup { limits: Limits::default(), ..setup })
    }
}

/// The start of a run without end.
fn endless(setup: &Setup) -> String {
    let starts = setup.starts();
    let starts = (1..).zip(&starts).map(|(robot, start)| format!("R{robot} starts in {start}"));
    format!("A run without end: {}\n\n{}", listed(starts), setup.layout)
}

/// Runs a rival once: its team moves, and what it breaks. It goes on after it has broken something, for the sake of the
/// other clauses.
fn try_one(setup: &Setup) -> Result<(u32, Vec<Violation>), Diagnostic> {
    let (layout, mut members) = (&setup.layout, team(setup)?);
    let mut course = Course::new(&*members, layout);
    let mut world = |edge: Edge| layout.is_open(edge);
    for _ in 0..=MOST_MOVES {
        if course.step(&mut *members, layout, setup.limits, &mut world).is_none() {
            return Ok((course.report.steps, course.report.violations));
        }
    }
    let mut broken = course.report.violations;
    broken.retain(|violation| violation.step <= MOST_MOVES);
    broken.push(Violation { clause: ENDS, step: MOST_MOVES });
    Ok((MOST_MOVES, broken))
}

/// A run that breaks a clause, as one that can be stored, unless it was watched no longer.
fn finding(setup: Setup, clause: ClauseId, steps: u32) -> Finding {
    let layout = &setup.layout;
    let size = [layout.width() as usize, layout.height() as usize];
    let walls = layout.size().cells() - layout.free_cells();
    let (facts, title) = sized(size, walls, steps as usize);
    let shown = match (clause == ENDS, steps < MOST_MOVES) {
        (true, true) => Exhibit::Story(clause, endless(&setup)),
        (true, false) => Exhibit::Told(endless(&setup)),
        (false, _) => Exhibit::Run(clause),
    };
    let setup = Setup { limits: Limits::stopping_at(Some(clause)), ..setup };
    Finding { clause: clause.as_str(), facts, title, setup, shown }
}
