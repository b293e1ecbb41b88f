//! A rule of one's own ([`tautline_proofs::team`]), as a run plays it: in one layout, with what it breaks.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::engine::tree::Game;
use tautline_proofs::engine::world::World;
use tautline_proofs::run::Frame;
use tautline_proofs::team::{Rule, Scene, TeamStep, TeamWorld};

use super::clause::ClauseId;
use super::run::{End, Survey, Team};
use crate::layout::Layout;

/// A team that follows a rule of one's own in one layout.
pub struct Own<'a, R: Rule> {
    playing: TeamWorld<'a, R>,
    before: Scene<R>,
    scene: Scene<R>,
    cells: Vec<Cell>,
    dice: SeededOracle,
    /// The scenes in which it was since the last draw, by 128 bits of each.
    been: HashSet<[u64; 2]>,
}

/// A digest that tells a scene from all others: its hashes behind two different first bytes.
fn digest(scene: &impl Hash) -> [u64; 2] {
    [0_u8, 1].map(|first| {
        let mut hasher = DefaultHasher::new();
        (first, scene).hash(&mut hasher);
        hasher.finish()
    })
}

/// Answers as a layout does, and by lot what no layout knows.
struct InLayout<'a> {
    is_open: &'a mut dyn FnMut(Edge) -> bool,
    dice: &'a mut SeededOracle,
    /// Whether anything was asked that no layout knows.
    has_drawn: bool,
}

impl Oracle for InLayout<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.has_drawn = true;
        self.dice.pick(below)
    }

    fn is_open(&mut self, edge: Edge) -> bool {
        (self.is_open)(edge)
    }

    /// Whoever crosses an open edge finds the cell behind it free.
    fn is_free(&mut self, _: Cell) -> bool {
        true
    }
}

impl<'a, R: Rule> Own<'a, R> {
    /// A team at its start. What no layout knows, such as who acts next, is drawn by `seed`.
    pub fn new(playing: TeamWorld<'a, R>, seed: u64) -> Self {
        let scene = playing.start();
        let (cells, dice) = (scene.cells().collect(), SeededOracle::new(seed, 0));
        Self { playing, before: scene.clone(), scene, cells, dice, been: HashSet::new() }
    }

    fn clauses(&self, broken: Vec<<TeamWorld<'a, R> as World>::Demand>) -> Vec<ClauseId> {
        broken.into_iter().map(|demand| ClauseId::new(self.playing.demand(demand).id)).collect()
    }
}

impl<R: Rule> Team for Own<'_, R> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        self.before.clone_from(&self.scene);
        let Some(plan) = self.playing.plan(&mut self.scene, &[]) else { return Err(End::Exhausted) };
        if !self.been.insert(digest(&self.before)) {
            return Err(End::Endless);
        }
        let mut world = InLayout { is_open, dice: &mut self.dice, has_drawn: false };
        let event = self.playing.settle(&mut self.scene, &plan, &mut Vec::new(), &mut world);
        if world.has_drawn {
            self.been.clear();
        }
        self.cells = self.scene.cells().collect();
        Ok(event.frame(&self.scene))
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let moved = TeamStep { before: &self.before, after: &self.scene };
        self.clauses(self.playing.broken(|demand| demand.is_broken_by(&moved)))
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        self.clauses(match end {
            End::Explored | End::Exhausted | End::Silent => self.playing.broken_at_end(&self.scene, &[]),
            End::Endless => self.playing.broken_by_never_ending(),
        })
    }
}
