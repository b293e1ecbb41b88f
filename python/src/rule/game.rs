//! The rule in all layouts, as the search plays it.

use std::ops::{ControlFlow, Range};
use std::sync::Arc;

use pyo3::Python;
use tautline_kernel::chain::Kind;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, SmallGrid, Step};
use tautline_proofs::engine::tree::{Broken, Game, Turn};
use tautline_proofs::run::Frame;
use tautline_proofs::team::Promise;

use super::written::{Blocked, Cells, MAX_ROBOTS, Move, Steps, Written};

/// A rule in layouts, and the numbers of its demands.
pub(super) struct InRule(Arc<Written>, Vec<Promise>);

/// The number of the rule's state, where its robots are, what came of the last team move, and what was found of the
/// layout.
#[derive(Clone, Copy)]
pub(super) struct State {
    number: u32,
    cells: Cells,
    blocked: Blocked,
    grid: SmallGrid,
}

/// What the team tries, and the number of the state with which it was asked.
#[derive(Clone, Copy)]
pub(super) struct Plan {
    before: u32,
    steps: Steps,
}

impl InRule {
    pub(super) fn new(written: Arc<Written>) -> Self {
        let demands = (0..written.demands.len()).map(Promise).collect();
        Self(written, demands)
    }

    const fn demands(&self) -> Range<usize> {
        0..self.1.len()
    }

    fn told(&self, broken: Vec<usize>) -> Vec<Broken<Self>> {
        broken.into_iter().map(|demand| (Promise(demand), self.0.demands[demand].words)).collect()
    }
}

fn moved(turn: &Turn<'_, InRule>) -> Move {
    Move {
        before: turn.plan.before,
        after: turn.after.number,
        from: turn.before.cells,
        to: turn.after.cells,
        steps: turn.plan.steps,
        blocked: turn.after.blocked,
    }
}

impl Game for InRule {
    type State = State;
    type Plan = Plan;
    type Demand = Promise;
    type Frame = Frame;

    fn start(&self) -> State {
        let (number, cells) = self.0.start();
        // The rule was refused if its area does not fit.
        let area = Python::attach(|py| self.0.area(py)).unwrap_or(Area::of(Cell::new(0, 0)));
        let grid = SmallGrid::new(area).or_else(|| SmallGrid::new(Area::of(Cell::new(0, 0))));
        let grid = grid.expect("one cell fits in every grid");
        State { number, cells, blocked: [false; MAX_ROBOTS], grid }
    }

    fn plan(&self, state: &mut State, _: &[u8]) -> Option<Plan> {
        let before = state.number;
        let (number, steps) = self.0.step(before, &state.cells, &state.blocked);
        state.number = number;
        Some(Plan { before, steps: steps? })
    }

    fn settle(&self, state: &mut State, plan: &Plan, log: &mut Vec<u8>, world: &mut impl Oracle) {
        state.blocked = [false; MAX_ROBOTS];
        for (robot, step) in plan.steps.iter().enumerate().take(self.0.robots) {
            let Step::Cross(side) = *step else { continue };
            let edge = Edge::new(state.cells[robot], side);
            if !state.grid.edge_has(EdgeMark::Wall, edge) && !state.grid.edge_has(EdgeMark::Open, edge) {
                let mark = if world.mishap() { EdgeMark::Wall } else { EdgeMark::Open };
                state.grid.put_edge(mark, edge);
            }
            state.blocked[robot] = state.grid.edge_has(EdgeMark::Wall, edge);
            if !state.blocked[robot] {
                state.cells[robot] = state.cells[robot].after(*step);
            }
        }
        log.extend(state.blocked[..self.0.robots].iter().map(|&blocked| u8::from(blocked)));
    }

    fn frame(&self, turn: &Turn<'_, Self>) -> Frame {
        let robots = ..self.0.robots;
        Frame {
            kind: Kind::Advance,
            steps: turn.plan.steps[robots].to_vec(),
            blocked: turn.after.blocked[robots].to_vec(),
            cells: turn.after.cells[robots].to_vec(),
        }
    }

    fn wanted(&self) -> &[Promise] {
        &self.1
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Broken<Self>> {
        self.told(self.0.broken_by(self.demands(), &moved(turn)))
    }

    fn broken_at_end(&self, state: &State, _: &[u8]) -> Vec<Broken<Self>> {
        self.told(self.0.broken_at_end(self.demands(), state.number, &state.cells))
    }

    fn recurs(&self, then: &State, _: usize, now: &State, _: &[u8]) -> ControlFlow<Vec<Broken<Self>>> {
        if (then.number, then.cells, then.blocked) != (now.number, now.cells, now.blocked) {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break(self.told(self.0.broken_by_endless(self.demands())))
    }

    fn edges(&self) -> u32 {
        let (width, height) =
            (u32::from(self.0.size.0.unsigned_abs()), u32::from(self.0.size.1.unsigned_abs()));
        2 * width * height - width - height
    }

    fn longest_run(&self) -> u32 {
        self.0.longest_run
    }

    fn covers(&self) -> impl Iterator<Item = &'static str> {
        self.0.covers.iter().map(|&(name, _)| name)
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        self.0.occurs(&moved(turn))
    }
}
