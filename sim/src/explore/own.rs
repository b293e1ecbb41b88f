//! A team of one's own that is searched over all layouts ([`tautline_proofs::team`]), as a run plays it: in one layout,
//! with what it breaks.

use std::collections::HashMap;

use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_proofs::run::Frame;
use tautline_proofs::team::{self, Demand, Moved};

use super::clause::ClauseId;
use super::run::{End, Team};
use super::survey::Survey;
use crate::layout::Layout;

/// A team that is played in one layout.
pub struct Own<T: 'static, const ROBOTS: usize> {
    team: T,
    /// Before the last team move.
    before: T,
    cells: [Cell; ROBOTS],
    demands: &'static [Demand<T, ROBOTS>],
    /// What the team was in these cells.
    been: HashMap<[Cell; ROBOTS], Vec<T>>,
}

impl<T: team::Team<ROBOTS>, const ROBOTS: usize> Own<T, ROBOTS> {
    /// `team` at its start, in these cells.
    pub fn new(team: T, cells: [Cell; ROBOTS], demands: &'static [Demand<T, ROBOTS>]) -> Self {
        Self { team, before: team, cells, demands, been: HashMap::new() }
    }

    fn broken(&self, is_broken: impl Fn(&Demand<T, ROBOTS>) -> bool) -> Vec<ClauseId> {
        let broken = self.demands.iter().filter(|demand| is_broken(demand));
        broken.map(|demand| ClauseId::new(demand.id)).collect()
    }
}

impl<T: team::Team<ROBOTS>, const ROBOTS: usize> Team for Own<T, ROBOTS> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        let been = self.been.entry(self.cells).or_default();
        if been.contains(&self.team) {
            return Err(End::Endless);
        }
        been.push(self.team);
        self.before = self.team;
        let steps = self.team.plan().ok_or(End::Exhausted)?;
        let mut blocked = [false; ROBOTS];
        for (robot, step) in steps.iter().enumerate() {
            let cell = &mut self.cells[robot];
            blocked[robot] = matches!(*step, Step::Cross(side) if !is_open(Edge::new(*cell, side)));
            if !blocked[robot] {
                *cell = cell.after(*step);
            }
        }
        self.team.settle(self.cells, blocked);
        let (steps, blocked, cells) = (steps.to_vec(), blocked.to_vec(), self.cells.to_vec());
        Ok(Frame { kind: Kind::Advance, steps, blocked, cells })
    }

    fn broken_in_move(&self, before: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let Ok(from) = before.try_into() else { return Vec::new() };
        let moved = Moved { before: &self.before, after: &self.team, from, to: self.cells };
        self.broken(|demand| demand.is_broken_by(&moved))
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        match end {
            End::Explored | End::Exhausted | End::Silent => {
                self.broken(|demand| demand.is_broken_at_end(&self.team, &self.cells))
            }
            End::Endless => self.broken(Demand::is_broken_by_endless_runs),
        }
    }
}
