//! The map as robots of a team know it, and the drives that the conditions admit.

use super::rule::Records;
use super::stance::{SEEN, Stance};
use super::team::Kit;
use super::tether::Formation;
use crate::ground::{Cell, Edge, EdgeMark, Grid, Step, Steps};

/// The team's knowledge, and the drives admitted.
impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// This team with another record of each robot, as they were kept or told.
    #[must_use]
    pub fn with_records(mut self, record: impl Fn(usize) -> G) -> Self
    where
        G: Copy,
    {
        self.union = record(0);
        for (robot, kept) in self.records.iter_mut().enumerate().take(self.count.into()) {
            *kept = record(robot);
            self.union.add_edges(kept);
        }
        self
    }

    /// Records a mark of a side.
    pub(super) fn record(&mut self, robot: usize, mark: EdgeMark, edge: Edge) {
        self.records[robot].put_edge(mark, edge);
        self.union.put_edge(mark, edge);
    }

    /// The sides of `node` that carry `mark` in any record.
    pub fn known(&self, mark: EdgeMark, node: Cell) -> Steps {
        self.union.sides(mark, node)
    }

    /// The sides of `node` that are known to be open: driven, or seen free by robots at both ends.
    pub(super) fn paths(&self, node: Cell) -> Steps {
        let driven = self.union.sides(EdgeMark::Open, node);
        if self.count > 2 { driven.or(self.union.sides(SEEN, node)) } else { driven }
    }

    /// The sides of `node` that count as covered for `robot`, or are known to be blocked.
    pub fn covered(&self, robot: usize, node: Cell) -> Steps {
        let covered = match self.rule.records {
            Records::Union => self.known(EdgeMark::Open, node),
            Records::Others => {
                let others = self.records().iter().enumerate().filter(|&(other, _)| other != robot);
                others.fold(Steps::NONE, |sides, (_, record)| sides.or(record.sides(EdgeMark::Open, node)))
            }
        };
        covered.or(self.known(EdgeMark::Wall, node))
    }

    /// The sides of `node` that are uncovered for `robot`.
    pub fn uncovered(&self, robot: usize, node: Cell) -> Steps {
        Steps::ALL.without(Step::Stay).minus(self.covered(robot, node))
    }

    /// The sides of `node` that nobody has covered.
    pub fn uncovered_by_all(&self, node: Cell) -> Steps {
        let known = self.known(EdgeMark::Open, node).or(self.known(EdgeMark::Wall, node));
        Steps::ALL.without(Step::Stay).minus(known)
    }

    /// Where the others are that have entered.
    pub(super) fn others(&self, robot: usize) -> impl Iterator<Item = Stance> + Clone {
        self.stances().enumerate().filter(move |&(other, _)| other != robot).map(|(_, stance)| stance)
    }

    /// Whether the conditions let `robot` take this step from where it stands.
    pub fn admits(&self, robot: usize, step: Step) -> bool {
        !self.admitted(robot, Steps::only(step)).is_empty()
    }

    /// Those of the steps that the conditions let `robot` take from where it stands.
    pub(super) fn admitted(&self, robot: usize, steps: Steps) -> Steps {
        if steps.is_empty() { steps } else { self.admitted_in(&self.formation(), robot, steps) }
    }

    /// Those of the steps that the conditions let `robot` take from where it stands in this formation.
    pub(super) fn admitted_in(&self, formation: &Formation<ROBOTS>, robot: usize, steps: Steps) -> Steps {
        let Some(Stance::Stands(from)) = self.stance(robot).filter(|_| !steps.is_empty()) else {
            return Steps::NONE;
        };
        let bonds = self.bonds(robot, formation);
        steps.filter(|step| self.lets(&bonds, formation, Stance::Drives { from, to: from.after(step) }))
    }
}
