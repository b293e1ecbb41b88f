//! Which cell a team explored when, and how it was marked.

use std::collections::BTreeMap;

use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell};

/// Which cell was explored when, and how it was marked.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Survey {
    area: Area,
    /// Row by row: the team move, or `UNEXPLORED`.
    steps: Vec<u32>,
    /// The marks that cells have from a team move on; a cell that has none from before is as explored as `steps` says.
    marks: BTreeMap<(Cell, u32), Mark>,
}

const UNEXPLORED: u32 = u32::MAX;

impl Survey {
    /// Nothing of `area` is explored.
    pub(super) fn new(area: Area) -> Self {
        Self { area, steps: vec![UNEXPLORED; area.width() * area.height()], marks: BTreeMap::new() }
    }

    /// The cells that robots explore which are in those of `teams` at the start and after each team move.
    pub fn of<'a>(area: Area, teams: impl IntoIterator<Item = &'a [Cell]>) -> Self {
        let mut chart = Self::new(area);
        for (step, team) in (0..).zip(teams) {
            for &cell in team {
                chart.enter(cell, step);
            }
        }
        chart
    }

    /// The cells that it spans.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// The team move in which `cell` was first occupied, 0 for the start; `None` if it never was.
    pub fn step(&self, cell: Cell) -> Option<u32> {
        self.area.place(cell).map(|place| self.steps[place]).filter(|&step| step != UNEXPLORED)
    }

    /// Those of `cells` that were never occupied.
    pub fn unexplored(&self, cells: impl IntoIterator<Item = Cell>) -> Vec<Cell> {
        cells.into_iter().filter(|&cell| self.step(cell).is_none()).collect()
    }

    /// The mark of `cell` after team move number `step`.
    pub fn mark(&self, cell: Cell, step: u32) -> Mark {
        match self.marks.range((cell, 0)..=(cell, step)).next_back() {
            Some((_, &mark)) => mark,
            None if self.step(cell).is_some_and(|explored| explored <= step) => Mark::Explored,
            None => Mark::Unexplored,
        }
    }

    /// Notes that a robot is in `cell`; whether that is new.
    pub(super) fn enter(&mut self, cell: Cell, step: u32) -> bool {
        let Some(place) = self.area.place(cell).filter(|&place| self.steps[place] == UNEXPLORED) else {
            return false;
        };
        self.steps[place] = step;
        true
    }

    /// Notes that `cell` has this mark from team move number `step` on.
    pub(super) fn put(&mut self, cell: Cell, step: u32, mark: Mark) {
        if mark != self.mark(cell, step) {
            self.marks.insert((cell, step), mark);
        }
    }
}
