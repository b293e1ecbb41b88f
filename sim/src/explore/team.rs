//! A team, whoever wrote it: where its robots are, how they make a team move, and what a run asks of it besides.

use std::fmt;

use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell, Edge};
use tautline_proofs::judge::Case;
use tautline_proofs::run::Frame;

use super::clause::ClauseId;
use super::floor::Component;
use super::scene::{Layer, Refusal, Scene};
use super::survey::Survey;
use crate::failures::Failures;
use crate::objects::ObjectReport;
use tautline_grids::layout::Layout;

/// The questions that a run asks of a team. Only where its robots are and how they make a team move is required.
pub trait Team {
    /// Where the robots are; if one of them is a base, it is the first.
    fn cells(&self) -> &[Cell];

    /// Makes one team move. `world` answers for every edge that is crossed
    /// without being known, and what no layout knows.
    ///
    /// # Errors
    /// [`End`] if the run is over.
    fn advance(&mut self, world: &mut dyn Surroundings) -> Result<Frame, End>;

    /// The cells of `layout` among which the team is to explore: all of them, unless it says otherwise.
    fn area(&self, layout: &Layout) -> Area {
        layout.size().area()
    }

    /// How many cells of `layout` the team is to explore: the free ones of its area, unless it says otherwise.
    fn due(&self, layout: &Layout) -> u32 {
        self.area(layout).cells().filter(|&cell| layout.is_free(cell)).count() as u32
    }

    /// How far the team comes in a layout, if one with more robots came farther.
    fn reach(&self, _layout: &Layout) -> Option<Reach> {
        None
    }

    /// The cells of a layout that the team must have explored, or marked as visited, before it ends, and has not, as
    /// the chart shows. It must explore none, unless it says otherwise.
    fn missed(&self, _layout: &Layout, _chart: &Survey) -> Vec<Cell> {
        Vec::new()
    }

    /// The words for the last team move that its steps cannot show, such as that a robot has died.
    fn title(&self) -> Option<&str> {
        None
    }

    /// Whether the last team move is one of those that come again and again in a run that goes round for ever.
    fn comes_again(&self) -> bool {
        false
    }

    /// The clauses that the last team move broke; the cells are those where the robots were before it.
    fn broken_in_move(&self, _before: &[Cell], _frame: &Frame) -> Vec<ClauseId> {
        Vec::new()
    }

    /// The clauses that the end of the run breaks, in which the team has explored what is in the chart.
    fn broken_at_end(&self, _layout: &Layout, _chart: &Survey, _end: End) -> Vec<ClauseId> {
        Vec::new()
    }

    /// The whole run in the layout from here on, written down for a judge as one that breaks a clause; `None` unless it
    /// is made by the choices of a search and a judge reads it.
    fn case(&mut self, _layout: &Layout, _clause: ClauseId) -> Option<Box<dyn Case>> {
        None
    }

    /// The marks of cells that the last team move has changed, in order.
    fn marked(&self) -> &[(Cell, Mark)] {
        &[]
    }

    /// The cells of the sensors that agents missed in the last team move, agent by agent.
    fn unseen(&self) -> &[Cell] {
        &[]
    }

    /// The numbers of the sensors that were missed so far among all that were asked about, by chance or as it is
    /// written down, and of those that are written down and come later.
    fn misses(&self) -> &[u32] {
        &[]
    }

    /// The parts of a sensor floor in which agents started; none for teams without one.
    fn components(&self) -> &[Component] {
        &[]
    }

    /// The cells besides those where its robots are that the last team move has explored, or before the first one the
    /// start: none for teams that explore a cell by being in it.
    fn seen(&self) -> &[Cell] {
        &[]
    }

    /// How long the run has taken the slowest robot, where that is known.
    fn milliseconds(&self) -> Option<u64> {
        None
    }

    /// The steps that robots cannot take instead of theirs in the next team move, all others doing as they plan.
    fn refusals(&self) -> Vec<Refusal> {
        Vec::new()
    }

    /// The failures so far, in a run in which something is to fail.
    fn failures(&self) -> Option<Failures> {
        None
    }

    /// The objects that it has looked for, if it was to.
    fn objects(&self) -> Vec<ObjectReport> {
        Vec::new()
    }

    /// The layers that a page can show of the team beside its robots and the cells that they enter.
    fn layers(&self) -> Vec<Layer> {
        Vec::new()
    }

    /// Tells a scene what the last team move has changed in [`layers`](Self::layers); the cells are those where the
    /// robots were before it.
    fn show(&self, _before: &[Cell], _scene: &mut Scene) {}
}

/// The answers to a team's questions. A function that knows which edges are open answers everything else as usual.
pub trait Surroundings {
    /// Whether robots can cross `edge`.
    fn is_open(&mut self, edge: Edge) -> bool;

    /// The place of the option that is chosen; `usual` is the one of the seed, or of the search that has found the run.
    fn choose(&mut self, words: &str, options: &mut dyn FnMut() -> Vec<String>, usual: u32) -> u32;
}

impl<F: FnMut(Edge) -> bool> Surroundings for F {
    fn is_open(&mut self, edge: Edge) -> bool {
        self(edge)
    }

    fn choose(&mut self, _: &str, _: &mut dyn FnMut() -> Vec<String>, usual: u32) -> u32 {
        usual
    }
}

/// How far a team comes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Reach {
    /// The cells within its reach.
    pub cells: usize,
    /// The cells that are connected with its start.
    pub connected: usize,
    /// The fewest robots that have all of those within reach.
    pub robots: usize,
}

impl fmt::Debug for dyn Team + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.cells()).finish()
    }
}

/// How a run ended by itself.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// Every cell of the area is explored.
    Explored,
    /// The cells that are left cannot be reached.
    Exhausted,
    /// The team goes round and round.
    Endless,
    /// Nothing new was found for so long that the team may go on for ever, or be slow.
    Idle,
    /// The robots that are left wait for one that is silent.
    Silent,
    /// The robots refuse what they have told each other.
    Refused,
}
