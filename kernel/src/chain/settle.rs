//! The outcome of a plan: the world's answers, or the messages of the robots that met them. Walls stand for ever, or
//! they may appear (ours): then every side is tried, also one that the team has crossed before (CHAIN-22). A robot that
//! has died does not go (CHAIN-21).

use super::message::{Damage, Message, Outcome};
use super::plan::{Kind, Plan};
use super::team::{Chain, MoveOutcome, Stage, Walls};
use crate::ground::{CellMark, Edge, EdgeMark, Grid, Step};

impl<G: Grid, const ROBOTS: usize> Chain<G, ROBOTS> {
    /// This chain among such walls. Among changing ones the world is asked for every side that a robot crosses, also in
    /// a backtrack; a wall that is found is known from then on, and is a gain. A backtrack that meets one ends the
    /// history: the chain goes on from where it is, and takes back no earlier team move. For walls that appear the rule
    /// needs *Hold* to keep contact.
    #[must_use]
    pub fn among(self, walls: Walls) -> Self {
        Self { walls, ..self }
    }

    /// Carries `plan` out. `is_open` answers for every edge that is crossed without being known, once each, in
    /// the order of the robots. All robots move at once; one that meets a wall stays, and all learn of it.
    /// A robot that has died does not go: its message says that it stays, which no other robot relies on.
    pub fn settle(
        &mut self,
        plan: &Plan<ROBOTS>,
        mut is_open: impl FnMut(Edge) -> bool,
    ) -> MoveOutcome<ROBOTS> {
        let mut messages = [0; ROBOTS];
        let mut meets_wall_going_back = false;
        for (robot, sent) in messages.iter_mut().enumerate().take(self.robots).skip(1) {
            let step = if plan.mute == robot { Step::Stay } else { plan.steps[robot] };
            let cell = self.cells[robot];
            let outcome = match (plan.kind, step, self.walls) {
                (Kind::Advance, Step::Stay, _) => Outcome::Arrived,
                (Kind::Backtrack, Step::Stay, _) | (Kind::Backtrack, _, Walls::Lasting) => Outcome::TookBack,
                (kind, Step::Cross(side), _) => match self.try_edge(Edge::new(cell, side), &mut is_open) {
                    Outcome::Arrived if kind == Kind::Backtrack => Outcome::TookBack,
                    outcome @ (Outcome::Arrived | Outcome::Blocked | Outcome::TookBack) => outcome,
                },
            };
            meets_wall_going_back |= plan.kind == Kind::Backtrack && outcome == Outcome::Blocked;
            let message = Message { step, outcome };
            *sent = message.encode();
            let to = cell.after(message.made());
            self.cells[robot] = to;
            if !self.grid.has(CellMark::Explored, to) {
                self.grid.put(CellMark::Explored, to);
                self.stage = Stage::Gained;
            }
        }
        self.moves += 1;
        self.last_open = plan.last_open;
        if meets_wall_going_back {
            self.forget();
        }
        if !self.gained() {
            self.reel.went_on(self.cells[self.robots - 1]);
        }
        MoveOutcome { messages, robots: self.robots }
    }

    /// The outcome of crossing `edge`.
    fn try_edge(&mut self, edge: Edge, is_open: &mut impl FnMut(Edge) -> bool) -> Outcome {
        if self.walls == Walls::Lasting && self.grid.edge_has(EdgeMark::Open, edge) {
            return Outcome::Arrived;
        }
        if self.grid.edge_has(EdgeMark::Wall, edge) {
            return Outcome::Blocked;
        }
        if is_open(edge) {
            self.grid.put_edge(EdgeMark::Open, edge);
            Outcome::Arrived
        } else {
            self.grid.put_edge(EdgeMark::Wall, edge);
            self.stage = Stage::Gained;
            Outcome::Blocked
        }
    }

    /// Carries `plan` out as one who plans along and hears of the rest: `messages` are those of R_2 … R_N about this
    /// team move, one byte each; whatever stands for that of a robot that has died is not read. Afterwards the chain
    /// is what [`Chain::settle`] makes of the team that sent them.
    ///
    /// # Errors
    /// [`Damage`] if they cannot be about this plan and this world; then nothing has changed.
    pub fn hear(&mut self, plan: &Plan<ROBOTS>, messages: &[u8]) -> Result<(), Damage> {
        let movers = self.robots - 1;
        if messages.len() != movers {
            return Err(Damage::Length { bytes: messages.len(), sent: movers });
        }
        let edge = |robot: usize| match plan.steps[robot] {
            Step::Cross(side) if plan.mute != robot => Some(Edge::new(self.cells[robot], side)),
            Step::Cross(_) | Step::Stay => None,
        };
        let mut outcomes = [Outcome::Arrived; ROBOTS];
        for (robot, &byte) in (1..).zip(messages).filter(|&(robot, _)| plan.mute != robot) {
            let Message { step, outcome } = Message::decode(byte)?;
            let is_back = outcome == Outcome::TookBack;
            let is_shut = outcome == Outcome::Blocked && self.walls == Walls::Changing;
            if step != plan.steps[robot] || (is_back != (plan.kind == Kind::Backtrack) && !is_shut) {
                return Err(Damage::OtherStep(robot + 1));
            }
            outcomes[robot] = outcome;
            let is_tried = !is_back || self.walls == Walls::Changing;
            let Some(crossed) = edge(robot).filter(|_| is_tried) else { continue };
            let known = if self.grid.edge_has(EdgeMark::Wall, crossed) {
                Some(Outcome::Blocked)
            } else if self.walls == Walls::Lasting && self.grid.edge_has(EdgeMark::Open, crossed) {
                Some(Outcome::Arrived)
            } else {
                (1..robot).find(|&other| edge(other) == Some(crossed)).map(|other| outcomes[other])
            };
            if known.is_some_and(|known| known != outcome) {
                return Err(Damage::OtherWorld(robot + 1));
            }
        }
        let crossed: [Option<Edge>; ROBOTS] =
            core::array::from_fn(|robot| (robot < self.robots).then(|| edge(robot)).flatten());
        self.settle(plan, |asked| {
            let first = (1..ROBOTS).find(|&robot| crossed[robot] == Some(asked));
            first.is_some_and(|robot| outcomes[robot] != Outcome::Blocked)
        });
        Ok(())
    }
}
