//! The chain as the search plays it: its edges are decided when a robot first tries them, and a wall is a mishap.

use std::ops::ControlFlow;

use tautline_kernel::chain::{Chain, Intent, Message, Outcome, Plan, SetupError};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, CellMark, Edge, EdgeMark, Grid, Step};

use super::bounds::Bounds;
use super::breach::{frame, is_harmless};
use super::invariant::{Invariant, Moment};
use super::links::within_reach;
use super::reach::{CellSet, Ground};
use super::subject::Deception;
use crate::engine::Stop;
use crate::engine::tree::Game;
use crate::engine::world::{Turn, World};
use crate::run::Frame;

/// Robots for which it can be said what they could reach at all.
const MOST_EXHAUSTING: usize = 5;

/// Team moves for each cell of the area after which a run is given up: many times as many as any run is known to take.
pub(super) const MOVES_OF_A_CELL: u32 = 64;

/// A chain within bounds.
pub(super) struct ChainGame<G, const ROBOTS: usize> {
    bounds: Bounds,
    start: Chain<G, ROBOTS>,
}

impl<G: Grid, const ROBOTS: usize> ChainGame<G, ROBOTS> {
    pub(super) fn new(bounds: &Bounds, grid: impl Fn(Area) -> Option<G>) -> Result<Self, SetupError> {
        let Bounds { robots, base, .. } = *bounds;
        let most = if bounds.invariants.contains(&Invariant::Exhausts) { MOST_EXHAUSTING } else { ROBOTS };
        let too_many = SetupError::TooManyRobots { robots, most };
        let grid = grid(bounds.reach()?).filter(|_| robots <= most).ok_or(too_many)?;
        Ok(Self { bounds: bounds.clone(), start: Chain::new(bounds.observed.rule, robots, base, grid)? })
    }

    fn looks_for(&self, invariant: Invariant) -> bool {
        self.bounds.invariants.contains(&invariant)
    }

    /// The open moves of a log, the latest first: their messages.
    fn open_moves<'a>(&self, log: &'a [u8]) -> impl Iterator<Item = &'a [u8]> + use<'a, G, ROBOTS> {
        let mut taken_back = 0_u32;
        log.chunks_exact(self.bounds.robots - 1).rev().filter(move |messages| {
            let is_open = !is_backtrack(messages) && taken_back == 0;
            if is_backtrack(messages) {
                taken_back += 1;
            } else {
                taken_back = taken_back.saturating_sub(1);
            }
            is_open
        })
    }
}

impl<G, const ROBOTS: usize> ChainGame<G, ROBOTS>
where
    G: Grid + Copy + Eq + Send + Sync + 'static,
{
    /// Those of these demands that a team move breaks, each with what is not so.
    fn broken_in(&self, turn: &Turn<'_, Self>, demands: &[Invariant]) -> Vec<(Invariant, &'static str)> {
        let Turn { before, planned, after, plan, sent, .. } = *turn;
        let observed = &self.bounds.observed;
        let (mut forged_steps, mut forged_messages) = ([Step::Stay; ROBOTS], [0; ROBOTS]);
        let (mut steps, mut messages) = (plan.steps(), sent);
        match observed.deception {
            Deception::None | Deception::PlainRecursion | Deception::DoubtsAll => {}
            Deception::BaseFollows => {
                let forged = &mut forged_steps[..steps.len()];
                forged.copy_from_slice(steps);
                forged[0] = forged[1];
                steps = forged;
            }
            Deception::SwappedBits => {
                let forged = &mut forged_messages[..sent.len()];
                forged
                    .iter_mut()
                    .zip(sent)
                    .for_each(|(heard, &sent)| *heard = observed.deception.carry(sent));
                messages = forged;
            }
        }
        let moment = Moment { observed, before, planned, after, plan, steps, messages };
        let is_harmless = is_harmless(before.cells(), after.cells());
        let is_met = |invariant: Invariant| is_harmless && invariant.breach().is_some();
        let doubtful = demands.iter().filter(|&&invariant| !is_met(invariant));
        let broken = doubtful.copied().filter_map(|invariant| match invariant.check(&moment) {
            Err(Stop::Violated(demand)) => Some((invariant, demand)),
            Err(Stop::Assumed | Stop::GivenUp) | Ok(()) => None,
        });
        broken.collect()
    }
}

impl<G, const ROBOTS: usize> World for ChainGame<G, ROBOTS>
where
    G: Grid + Copy + Eq + Send + Sync + 'static,
{
    type State = Chain<G, ROBOTS>;
    type Plan = Plan<ROBOTS>;
    type Event = ();
    type Demand = Invariant;

    fn plan(&self, chain: &mut Self::State, log: &[u8]) -> Option<Self::Plan> {
        match chain.plan(log) {
            Ok(Intent::Go(plan)) => Some(plan),
            Ok(Intent::Done(_)) | Err(_) => None,
        }
    }

    fn settle(&self, chain: &mut Self::State, plan: &Self::Plan, log: &mut Vec<u8>, world: &mut impl Oracle) {
        log.extend_from_slice(chain.settle(plan, |edge| world.is_open(edge)).messages());
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Invariant> {
        let broken: Vec<_> = self.broken_in(turn, &self.bounds.invariants);
        broken.into_iter().map(|(invariant, _)| invariant).collect()
    }

    fn broken_at_end(&self, chain: &Self::State, log: &[u8]) -> Vec<Invariant> {
        let mut broken = Vec::new();
        if self.looks_for(Invariant::Heard) && chain.clone().plan(log).is_err() {
            broken.push(Invariant::Heard);
        }
        let grid = chain.grid();
        let moves = log.len() / (self.bounds.robots - 1);
        if self.looks_for(Invariant::Short) && moves > most_moves(grid, self.bounds.robots) {
            broken.push(Invariant::Short);
        }
        if grid.is_explored() {
            return broken;
        }
        let is_open = |edge| !grid.edge_has(EdgeMark::Wall, edge);
        let is_missed = |cell| !grid.has(CellMark::Explored, cell);
        broken.extend(left_out(&self.bounds, grid.area(), is_open, is_missed));
        broken
    }
}

impl<G, const ROBOTS: usize> Game for ChainGame<G, ROBOTS>
where
    G: Grid + Copy + Eq + Send + Sync + 'static,
{
    type Frame = Frame;

    fn edges(&self) -> u32 {
        self.start.grid().area().edges().count() as u32
    }

    fn longest_run(&self) -> u32 {
        let area = self.start.grid().area();
        MOVES_OF_A_CELL * (area.width() * area.height()) as u32
    }

    fn start(&self) -> Self::State {
        self.start
    }

    fn frame(&self, turn: &Turn<'_, Self>) -> Frame {
        frame(turn.plan.kind, turn.sent, turn.after.cells())
    }

    fn wanted(&self) -> &[Invariant] {
        &self.bounds.invariants
    }

    fn words(&self, demand: Invariant, turn: Option<&Turn<'_, Self>>) -> &'static str {
        let broken: Vec<_> = turn.map_or_else(Vec::new, |turn| self.broken_in(turn, &[demand]));
        match (broken.first(), demand) {
            (Some((_, words)), _) => words,
            (None, demand) => words_of_end(demand),
        }
    }

    /// The chain is where it was, and what it took back since then, it has done again: so it goes on as it did. If it
    /// took back everything, it must have as much to take back as then.
    fn recurs(
        &self,
        then: &Self::State,
        sent: usize,
        now: &Self::State,
        log: &[u8],
    ) -> ControlFlow<Vec<Invariant>> {
        if !now.is_where(then) {
            return ControlFlow::Continue(());
        }
        let (mut height, mut lowest) = (0_i64, 0_i64);
        for messages in log[sent..].chunks_exact(self.bounds.robots - 1) {
            height += if is_backtrack(messages) { -1 } else { 1 };
            lowest = lowest.min(height);
        }
        let undone = lowest.unsigned_abs() as usize;
        let was_home = self.open_moves(&log[..sent]).nth(undone).is_none();
        let recurs = (height == 0 || height > 0 && !was_home)
            && self.open_moves(&log[..sent]).take(undone).eq(self.open_moves(log).take(undone));
        if recurs { ControlFlow::Break(vec![Invariant::Ends]) } else { ControlFlow::Continue(()) }
    }
}

/// The demands on the end of a run that `area` breaks, as far as sides are open and cells are missed.
pub(super) fn left_out(
    bounds: &Bounds,
    area: Area,
    is_open: impl Fn(Edge) -> bool + Copy,
    is_missed: impl Fn(Cell) -> bool + Copy,
) -> Vec<Invariant> {
    let Bounds { base, robots, ref invariants, ref observed, .. } = *bounds;
    let leaves = |demand: &Invariant| {
        if *demand == Invariant::COMPLETENESS {
            within_reach(area, base, robots, is_open).into_iter().any(is_missed)
        } else if *demand == Invariant::Exhausts {
            let mut missed = CellSet::new(area);
            area.cells().filter(|&cell| is_missed(cell)).for_each(|cell| missed.insert(cell));
            let ground = Ground::new(area, base, robots, is_open);
            ground.is_some_and(|ground| ground.reaches_any(&observed.rule, &missed).unwrap_or(false))
        } else {
            false
        }
    };
    invariants.iter().copied().filter(leaves).collect()
}

/// The sentence that is not so where `demand` is broken by the end of a run, or by its never coming.
pub(super) const fn words_of_end(demand: Invariant) -> &'static str {
    match demand {
        Invariant::Heard => "no message of a team is refused by it",
        Invariant::Short => "each wall that is met costs at most N² team moves",
        Invariant::Without(_) => "at the end every cell within reach is explored",
        Invariant::Exhausts => "at the end every cell that a chain can reach is explored",
        _ => "a run never comes back to where it was",
    }
}

/// The team moves that CHAIN-24 lets a chain make of which this is known at the end.
fn most_moves<G: Grid>(grid: &G, robots: usize) -> usize {
    let walls = grid.area().edges().filter(|&edge| grid.edge_has(EdgeMark::Wall, edge)).count();
    9 * (robots - 1) - 1 + robots * robots * walls
}

fn is_backtrack(messages: &[u8]) -> bool {
    let first = messages.first().and_then(|&byte| Message::decode(byte).ok());
    first.is_some_and(|message| message.outcome == Outcome::TookBack)
}
