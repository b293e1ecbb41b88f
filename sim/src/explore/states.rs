//! Hunts through all states of small layouts: how large they may be, a search that somebody watches, and how what was
//! found is told.

use std::ops::ControlFlow;

use tautline_io::diagnostic::Diagnostic;
use tautline_proofs::engine::states::{self, Findings, Limits, System};
use tautline_proofs::plural::counted;

use super::ClauseId;
use super::hunt::{CoveredBound, Facts, Far, Finding, HuntReport, HuntRequest, Hunter, in_order, outcome};
use tautline_grids::layout::Size;

/// States between two words about how far the search is.
const BETWEEN: u64 = 1 << 14;

/// How large the layouts of a hunt may be, and its teams.
pub(super) struct Small {
    /// The word for a cell.
    pub(super) cell: &'static str,
    /// The most columns and rows, and how that is said.
    pub(super) most_side: (i16, &'static str),
    /// Sizes that are right.
    pub(super) examples: &'static str,
    /// The word for the search that holds the robots.
    pub(super) search: &'static str,
    /// The words for a team without a robot.
    pub(super) no_robots: &'static str,
}

impl Small {
    /// The most cells of a layout.
    pub(super) const MOST_CELLS: usize = 16;

    /// Columns and rows when nobody says.
    const DEFAULT_SIZE: (u64, u64) = (3, 2);

    /// Robots when nobody says how many.
    const DEFAULT_ROBOTS: u64 = 2;

    /// The size that is asked for.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is too large.
    pub(super) fn size(&self, asked: &HuntRequest<'_>) -> Result<Size, Diagnostic> {
        let (width, height) = Self::DEFAULT_SIZE;
        let size = asked.bounds.size.map_or_else(|| Size::new(width, height), Ok)?;
        let (most_cells, &Self { cell, most_side: (most_side, side), examples, .. }) =
            (Self::MOST_CELLS, self);
        if size.cells() <= most_cells && size.width().max(size.height()) <= most_side {
            return Ok(size);
        }
        let what = format!("{size} {cell}s are {}, too many to search all their layouts", size.cells());
        let remedy = format!("give `size` at most {most_cells} {cell}s{side}, for example {examples}");
        Err(Diagnostic::of_field("size", what, remedy))
    }

    /// The number of robots that is asked for, of at most so many, in an area of this size, which is called `area`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there are none, too many, or too many for the area.
    pub(super) fn robots(
        &self,
        asked: &HuntRequest<'_>,
        most: u64,
        size: Size,
        area: &str,
    ) -> Result<u64, Diagnostic> {
        let robots = asked.bounds.robots.unwrap_or(Self::DEFAULT_ROBOTS);
        let room = size.cells() as u64;
        let (what, remedy) = match robots {
            0 => (self.no_robots.to_owned(), format!("from 1 to {most}")),
            _ if robots > most => (
                format!("{} holds {}, and not {robots}", self.search, counted(most, "robot")),
                format!("from 1 to {most}"),
            ),
            _ if robots > room => (
                format!("{robots} robots do not find room in {area} {}s", self.cell),
                format!("up to {room}, or a larger `size`"),
            ),
            _ => return Ok(robots),
        };
        Err(Diagnostic::of_field("robots", what, format_args!("give `robots` a number {remedy}")))
    }

    /// The report of a hunt for `robots` in layouts up to a size, within these other bounds.
    pub(super) fn report(
        &self,
        (size, robots, within): (Size, u64, &str),
        facts: Facts,
        done: CoveredBound,
        count: Count,
        mut found: Vec<Finding>,
    ) -> HuntReport {
        found.sort_by_key(|found| ClauseId::new(found.clause));
        let (is_complete, not_minimised) = (count.is_complete, in_order(count.not_minimised));
        let (states, steps) = (counted(count.states, "state"), counted(count.steps, "step"));
        let covered = count.cells.map(|cells| format!("of at most {}", counted(cells, self.cell)));
        let outcome = outcome(&found, is_complete, covered);
        HuntReport {
            robots,
            looked_for: in_order(count.looked_for),
            facts,
            is_complete,
            done,
            title: format!("{}, layouts up to {size}{within}: {states}, {steps}", counted(robots, "robot")),
            through: format!("{states} and {steps}"),
            outcome: match &not_minimised[..] {
                [] => outcome,
                clauses => {
                    format!("Not minimised, since the hunt was ended: {}. {outcome}", clauses.join(", "))
                }
            },
            not_minimised,
            found,
        }
    }
}

/// How much was searched.
#[derive(Default)]
pub(super) struct Count {
    /// The clauses that are looked for.
    pub(super) looked_for: Vec<&'static str>,
    pub(super) states: u64,
    pub(super) steps: u64,
    /// The cells up to which all areas were searched.
    pub(super) cells: Option<usize>,
    pub(super) is_complete: bool,
    /// Steps that were made to find the fewest walls of what is broken, which are in the budget and not in `steps`.
    pub(super) steps_to_minimise: u64,
    /// Clauses of which the fewest walls were not found before the search was ended.
    pub(super) not_minimised: Vec<&'static str>,
}

impl Count {
    /// Notes that `area` was searched, one of `all`, in their order: after the last one with as many cells, all with
    /// so many were.
    pub(super) fn covers(&mut self, area: (i16, i16), all: &[(i16, i16)]) {
        let cells = |&(width, height): &(i16, i16)| (width * height) as usize;
        if all.iter().rfind(|other| cells(other) == cells(&area)) == Some(&area) {
            self.cells = Some(cells(&area));
        }
    }
}

/// A hunt under way, through the states of one system after the other.
pub(super) struct Search<'a> {
    pub(super) asked: &'a HuntRequest<'a>,
    hunter: &'a mut dyn Hunter,
    pub(super) count: Count,
}

impl<'a> Search<'a> {
    /// Nothing is searched yet.
    pub(super) fn new(asked: &'a HuntRequest<'a>, hunter: &'a mut dyn Hunter) -> Self {
        Self { asked, hunter, count: Count { is_complete: true, ..Count::default() } }
    }

    /// Searches a system as far as the budget goes, unless the work is ended before.
    pub(super) fn all<S: System>(
        &mut self,
        system: &S,
        starts: Vec<S::State>,
        what: &str,
    ) -> Findings<S::Demand> {
        let found = self.looked(system, starts, what);
        self.count.states += found.states;
        self.count.steps += found.steps;
        found
    }

    /// Searches a system again, for a run with fewer walls. Breaks off where the budget or the work is at its end
    /// before.
    pub(super) fn minimised<S: System>(
        &mut self,
        system: &S,
        starts: Vec<S::State>,
    ) -> ControlFlow<(), Findings<S::Demand>> {
        let what = "the fewest walls of what is broken";
        self.hunter.hears(Far::Words(what.to_owned()))?;
        let found = self.looked(system, starts, what);
        self.count.steps_to_minimise += found.steps;
        if found.is_whole { ControlFlow::Continue(found) } else { ControlFlow::Break(()) }
    }

    fn looked<S: System>(&mut self, system: &S, starts: Vec<S::State>, what: &str) -> Findings<S::Demand> {
        let made = self.count.steps + self.count.steps_to_minimise;
        let most_steps = self.asked.budget.map_or(u64::MAX, |budget| budget.saturating_sub(made));
        let mut watch = |looked_at: u64| {
            let states = self.count.states + looked_at;
            if states.is_multiple_of(BETWEEN) {
                return self.hunter.hears(Far::Words(format!("{what}, states {states}")));
            }
            ControlFlow::Continue(())
        };
        states::watched(system, starts, Limits { most_steps, ..Limits::NONE }, &mut watch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_of_as_many_cells_are_covered_after_the_last_of_them() {
        let all = [(1, 1), (2, 1), (1, 2), (3, 1)];
        let mut count = Count::default();
        let covered = all.map(|area| {
            count.covers(area, &all);
            count.cells
        });
        assert_eq!(covered, [Some(1), Some(1), Some(2), Some(3)]);
    }
}
