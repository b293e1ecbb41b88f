//! An upper bound of what is reachable, for any number of robots: every two neighbours are looked at alone.

use tautline_kernel::chain::{Condition, Rule};
use tautline_kernel::ground::{Area, Cell, Step};

use super::cells::{CellSet, cells_of, index};
use super::ground::Ground;
use crate::chain::environment::{in_covered, in_safe};

impl Ground {
    /// All cells that the chain can reach under `rule`, and perhaps others, for any number of robots.
    ///
    /// Every two neighbours are looked at alone, from the base outwards: of R_i it is remembered which steps it can
    /// make from which cell, as the robot ahead of R_{i−1}; what R_{i+1} can do is then found with whatever step of
    /// R_i suits it. What a whole chain does, each of its pairs can do, but not the other way round. Without
    /// *SafeAhead* neighbours can be anywhere, and all cells that can be walked to are returned.
    pub fn perhaps_reachable(&self, rule: &Rule) -> CellSet {
        if !rule.has(Condition::SafeAhead) {
            return self.walkable();
        }
        let mut reached = CellSet::new(self.area());
        reached.insert(self.base());
        let mut behind = Steps::new(self.area());
        behind.insert(self.base(), Step::Stay);
        for robot in 2..=self.robots() {
            behind = self.pair(rule, robot, &behind, &mut reached);
        }
        reached
    }

    /// The steps of R_`robot` if the one behind it makes those of `behind`, all from the base.
    fn pair(&self, rule: &Rule, robot: usize, behind: &Steps, reached: &mut CellSet) -> Steps {
        let mut steps = Steps::new(self.area());
        // Of every cell of the robot behind: where this one has been seen with it, by offset in E_S.
        let mut seen = vec![[false; 9]; cells_of(self.area())];
        let mut pairs = vec![(self.base(), self.base())];
        while let Some((from_behind, from)) = pairs.pop() {
            for to_behind in behind.from(from_behind) {
                for step in Step::ALL.into_iter().filter(|&step| self.admits(from, step)) {
                    let to = from.after(step);
                    let is_null = robot == self.robots() && step == Step::Stay;
                    let is_covered =
                        is_null || !rule.has(Condition::CoveredBehind) || in_covered(from_behind, to);
                    let is_distinct = !rule.has(Condition::Distinct) || to != to_behind || to == self.base();
                    if !(in_safe(to, to_behind) && is_covered && is_distinct) {
                        continue;
                    }
                    steps.insert(from, step);
                    reached.insert(to);
                    let offset = (to.x - to_behind.x + 1) + 3 * (to.y - to_behind.y + 1);
                    if let Some(index) = index(self.area(), to_behind)
                        && !std::mem::replace(&mut seen[index][offset as usize], true)
                    {
                        pairs.push((to_behind, to));
                    }
                }
            }
        }
        steps
    }
}

/// For every cell, steps that a robot can make there.
struct Steps {
    area: Area,
    by_cell: Vec<[bool; 5]>,
}

impl Steps {
    fn new(area: Area) -> Self {
        Self { area, by_cell: vec![[false; 5]; cells_of(area)] }
    }

    fn insert(&mut self, cell: Cell, step: Step) {
        if let Some(index) = index(self.area, cell) {
            self.by_cell[index][step.place()] = true;
        }
    }

    /// Where the steps lead from `cell`.
    fn from(&self, cell: Cell) -> impl Iterator<Item = Cell> + '_ {
        let steps = index(self.area, cell).map_or([false; 5], |index| self.by_cell[index]);
        Step::ALL.into_iter().filter(move |step| steps[step.place()]).map(move |step| cell.after(step))
    }
}
