//! The search over areas: all areas with few cells, the base in each of their cells, all layouts in each. A
//! counterexample has the fewest cells, of these the fewest walls, and of these the fewest team moves. Each demand is
//! decided by itself: a run goes on when it breaks another one.

use std::fmt;
use std::ops::ControlFlow;

use serde::Serialize;
use tautline_kernel::ground::Area;

use super::bounds::{Bounds, Counterexample};
use super::invariant::Invariant;
use super::search::{Findings as OfOne, Search, Unsearchable, search as search_one};
use super::subject::Subject;
use crate::engine::smallest::{Certificate, Class, ClassFindings, Most, areas_of, smallest};
use crate::engine::tree::Watch;

/// Areas to search, and for what.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Areas {
    /// The chain, and how it is deceived.
    pub observed: Subject,
    /// Robots, base included: at most 64.
    pub robots: usize,
    /// Most cells of an area.
    pub max_cells: u32,
    /// Most walls that are met in one run; the border is not counted. An area with fewer edges is searched for all of
    /// them.
    pub max_walls: u32,
    /// The search stops when it has made so many team moves.
    pub budget_moves: Option<u64>,
    /// The invariants that are looked for.
    pub invariants: Vec<Invariant>,
}

/// An area that was searched, from each of its cells as the base.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AreaSearch {
    /// Columns.
    pub columns: i16,
    /// Rows.
    pub rows: i16,
    /// Cells that were the base.
    pub bases: u64,
    /// Most walls that a run met or could have met.
    pub walls: u32,
    /// Leaves of all trees that were searched.
    pub runs: u64,
    /// Edges of all trees that were searched.
    pub moves: u64,
}

/// A run that breaks a demand, and the area that it does it in.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Smallest {
    /// The area, and the base.
    pub bounds: Bounds,
    /// The run.
    pub found: Counterexample,
}

/// The base, and the walls that are met.
impl fmt::Display for Smallest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let run = self.bounds.run(&self.found);
        write!(f, "base {}, walls", self.bounds.base)?;
        run.walls
            .iter()
            .try_for_each(|wall| write!(f, " {}|{}", wall.cell(), wall.cell().beyond(wall.side())))
    }
}

/// The findings of a search over areas.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Findings {
    /// The areas that were searched, fewest cells first.
    pub searched: Vec<AreaSearch>,
    /// All areas with at most so many cells are among them.
    pub cells: Option<u32>,
    /// Runs that were given up, since they grew too long.
    pub given_up: u64,
    /// Whether all areas within the bounds were searched for all demands to the end of each run, or all demands are
    /// broken in the areas searched.
    pub is_complete: bool,
    /// The smallest for each demand broken, by demand. Where the search was ended, those with more than
    /// [`cells`](Self::cells) cells need not be the smallest.
    pub broken: Vec<Smallest>,
}

impl Findings {
    /// Leaves of all trees that were searched.
    pub fn runs(&self) -> u64 {
        self.searched.iter().map(|area| area.runs).sum()
    }

    /// Edges of all trees that were searched.
    pub fn moves(&self) -> u64 {
        self.searched.iter().map(|area| area.moves).sum()
    }

    /// Makes `found` the smallest of its demand, if it is. Areas come fewest cells first.
    fn add(&mut self, bounds: &Bounds, found: &Counterexample) {
        let size = |bounds: &Bounds, found: &Counterexample| {
            let cells = bounds.area.width() * bounds.area.height();
            (cells, found.answers.iter().sum::<u32>(), found.frames.len())
        };
        let new = || Smallest { bounds: bounds.clone(), found: found.clone() };
        match self.broken.iter_mut().find(|known| known.found.broken == found.broken) {
            None => {
                self.broken.push(new());
                self.broken.sort_by_key(|known| known.found.broken);
            }
            Some(known) if size(bounds, found) < size(&known.bounds, &known.found) => *known = new(),
            Some(_) => {}
        }
    }

    fn has(&self, invariant: Invariant) -> bool {
        self.broken.iter().any(|known| known.found.broken == invariant)
    }
}

/// Edges of the area with most of them that has at most so many cells.
pub fn most_edges(max_cells: u32) -> u32 {
    (1..=max_cells).flat_map(areas_of).map(|area| area.edges().count() as u32).max().unwrap_or(0)
}

/// Searches all areas. The result is the same on any number of threads, unless `watch` ends the search.
///
/// # Errors
/// [`Unsearchable`] if the bounds are beyond what can be searched.
pub fn search(
    all: &Areas,
    watch: &mut dyn FnMut(&Findings) -> ControlFlow<()>,
) -> Result<Findings, Unsearchable> {
    let mut found = Findings::default();
    for cells in 1..=all.max_cells {
        let left: Vec<Invariant> =
            all.invariants.iter().copied().filter(|&invariant| !found.has(invariant)).collect();
        if left.is_empty() {
            break;
        }
        for area in areas_of(cells) {
            if !all.search(area, &left, &mut found, watch)? {
                return Ok(found);
            }
        }
        found.cells = Some(cells);
    }
    found.is_complete = found.given_up == 0;
    Ok(found)
}

/// The bounds of a search in `area` for each of its cells as the base. What the team cannot get to plays no part: where
/// it does not get everywhere, the area that it reaches was searched before, for it has fewer cells.
fn in_each_cell(
    observed: Subject,
    robots: usize,
    (area, walls): (Area, u32),
) -> Result<Vec<Bounds>, Unsearchable> {
    let of = |base| Bounds { area, base, ..Bounds::new(observed, robots, walls) };
    let reached = area.cells().map(of).map(|bounds| Ok((bounds.reach()?, bounds)));
    let reached = reached.collect::<Result<Vec<_>, Unsearchable>>()?;
    Ok(reached.into_iter().filter(|(reach, _)| *reach == area).map(|(_, bounds)| bounds).collect())
}

impl Areas {
    /// Searches `area` for what is `left`. Returns whether nothing ended it before.
    fn search(
        &self,
        area: Area,
        left: &[Invariant],
        found: &mut Findings,
        watch: &mut dyn FnMut(&Findings) -> ControlFlow<()>,
    ) -> Result<bool, Unsearchable> {
        let walls = self.max_walls.min(area.edges().count() as u32);
        let (columns, rows) = (area.width() as i16, area.height() as i16);
        let place = found.searched.len();
        for bounds in in_each_cell(self.observed, self.robots, (area, walls))? {
            if found.searched.len() == place {
                found.searched.push(AreaSearch { columns, rows, bases: 0, walls, runs: 0, moves: 0 });
            }
            let all = Bounds { invariants: left.to_vec(), ..bounds };
            let Some(together) = self.tree(&all, found, watch)? else { return Ok(false) };
            let by_themselves = if together.counterexamples.is_empty() { &[] } else { left };
            for &invariant in by_themselves {
                let alone = Bounds { invariants: vec![invariant], ..all.clone() };
                let Some(tree) = self.tree(&alone, found, watch)? else { return Ok(false) };
                if let Some(broken) = tree.counterexamples.iter().find(|one| one.broken == invariant) {
                    found.add(&alone, broken);
                }
            }
            found.searched[place].bases += 1;
        }
        Ok(true)
    }

    /// The findings of one tree; `None` if it was ended before.
    fn tree(
        &self,
        bounds: &Bounds,
        found: &mut Findings,
        watch: &mut dyn FnMut(&Findings) -> ControlFlow<()>,
    ) -> Result<Option<OfOne>, Unsearchable> {
        let budget_moves = self.budget_moves.map(|budget| budget.saturating_sub(found.moves()));
        let mut search = Search::new(&Bounds { budget_moves, ..bounds.clone() })?;
        while search.wave() && watch(found).is_continue() {}
        let tree = search.found();
        if let Some(area) = found.searched.last_mut() {
            area.runs += tree.runs;
            area.moves += tree.moves;
        }
        found.given_up += tree.given_up;
        if tree.complete {
            return Ok(Some(tree));
        }
        tree.counterexamples.iter().for_each(|broken| found.add(bounds, broken));
        Ok(None)
    }
}

/// The smallest run of chains that follow `observed` which breaks `invariant`, over areas, walls, robots and bases.
///
/// # Errors
/// [`Unsearchable`] if a class is beyond what can be searched.
pub fn smallest_run(
    observed: Subject,
    invariant: Invariant,
    most: &Most,
    watch: Watch<'_>,
) -> Result<Certificate<Class, Smallest>, Unsearchable> {
    smallest(most, |Class { area, barriers, robots }, until| {
        let walls = barriers.min(area.edges().count() as u32);
        let mut all = ClassFindings::default();
        for bounds in in_each_cell(observed, robots, (area, walls))? {
            let bounds = Bounds { invariants: vec![invariant], until, ..bounds };
            if !bounds.starts().all(|start| area.contains(start)) {
                continue;
            }
            let OfOne { runs, complete, counterexamples, given_up, .. } = search_one(&bounds, watch)?;
            let broken = counterexamples.into_iter().find(|one| one.broken == invariant);
            let shortest = broken.map(|found| (found.frames.len(), Smallest { bounds, found }));
            all.add(ClassFindings { cases: runs, is_whole: complete && given_up == 0, shortest });
        }
        Ok(all)
    })
}
