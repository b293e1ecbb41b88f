//! The rule in one layout, as a run plays it.

use std::collections::HashSet;
use std::ops::Range;

use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_proofs::run::Frame;
use tautline_sim::explore::{ClauseId, End, Survey, Team};
use tautline_sim::layout::Layout;

use super::written::{Blocked, Cells, MAX_ROBOTS, Move, Written};

/// A team that follows the rule.
pub(super) struct Player<'a> {
    written: &'a Written,
    /// The demands that are looked at.
    demands: Range<usize>,
    now: Place,
    last: Option<Move>,
    /// Where the team was.
    been: HashSet<Place>,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Place {
    state: u32,
    cells: Cells,
    blocked: Blocked,
}

impl<'a> Player<'a> {
    /// At its start.
    pub(super) fn new(written: &'a Written, demands: Range<usize>) -> Self {
        let (state, cells) = written.start();
        let now = Place { state, cells, blocked: [false; MAX_ROBOTS] };
        Self { written, demands, now, last: None, been: HashSet::new() }
    }

    fn clauses(&self, broken: Vec<usize>) -> Vec<ClauseId> {
        broken.into_iter().map(|demand| self.written.demands[demand].clause).collect()
    }
}

impl Team for Player<'_> {
    fn cells(&self) -> &[Cell] {
        &self.now.cells[..self.written.robots]
    }

    fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        if !self.been.insert(self.now) {
            return Err(End::Endless);
        }
        let Place { state: before, cells: from, blocked } = self.now;
        let (after, steps) = self.written.step(before, &from, &blocked);
        let Some(steps) = steps else {
            self.now.state = after;
            return Err(End::Exhausted);
        };
        let (mut to, mut blocked) = (from, [false; MAX_ROBOTS]);
        let robots = self.written.robots;
        for (robot, step) in steps.iter().enumerate().take(robots) {
            blocked[robot] = matches!(*step, Step::Cross(side) if !is_open(Edge::new(to[robot], side)));
            if !blocked[robot] {
                to[robot] = to[robot].after(*step);
            }
        }
        self.now = Place { state: after, cells: to, blocked };
        self.last = Some(Move { before, after, from, to, steps, blocked });
        Ok(Frame {
            kind: Kind::Advance,
            steps: steps[..robots].to_vec(),
            blocked: blocked[..robots].to_vec(),
            cells: to[..robots].to_vec(),
        })
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let Some(moved) = &self.last else { return Vec::new() };
        self.clauses(self.written.broken_by(self.demands.clone(), moved))
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        self.clauses(match end {
            End::Explored | End::Exhausted | End::Silent => {
                self.written.broken_at_end(self.demands.clone(), self.now.state, &self.now.cells)
            }
            End::Endless => self.written.broken_by_endless(self.demands.clone()),
        })
    }
}
