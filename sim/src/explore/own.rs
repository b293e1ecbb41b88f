//! A rule of one's own ([`tautline_proofs::team`]), as a run plays it: in one layout, with what it breaks.

use std::collections::{BTreeSet, HashMap, VecDeque};
use std::hash::{DefaultHasher, Hash, Hasher};

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::engine::states::Bits;
use tautline_proofs::engine::tree::Game;
use tautline_proofs::engine::world::World;
use tautline_proofs::run::Frame;
use tautline_proofs::team::{self, Promise, Rule, TeamStep, TeamWorld};

use super::{Change, ClauseId, End, Scene, Surroundings, Survey, Team};
use tautline_grids::layout::Layout;

/// A team that follows a rule of one's own in one layout.
pub struct Own<'a, R: Rule> {
    playing: TeamWorld<'a, R>,
    before: team::Scene<R>,
    scene: team::Scene<R>,
    cells: Vec<Cell>,
    /// The answers of a search that has found the run; by lot is answered what they leave open.
    script: VecDeque<u32>,
    dice: SeededOracle,
    /// The words for its last step.
    title: String,
    /// Whether its robots are to explore the layout.
    pub(crate) is_exploring: bool,
    /// The scenes in which it was since the last draw, by 128 bits of each, with the number of each among them.
    been: HashMap<[u64; 2], usize>,
    /// The obligations in each of these scenes.
    owed: Vec<Vec<(Promise, Bits)>>,
    /// The demands that are met for good.
    met: BTreeSet<Promise>,
}

/// A digest that stands for a scene: its hashes behind two different first bytes. Two scenes with the same 128 bits
/// would be taken for one, and the run for endless; by chance that is not to be expected.
fn digest(scene: &impl Hash) -> [u64; 2] {
    [0_u8, 1].map(|first| {
        let mut hasher = DefaultHasher::new();
        (first, scene).hash(&mut hasher);
        hasher.finish()
    })
}

/// Answers as a layout does, and what no layout knows as a search did, or by lot, unless somebody else decides.
struct InLayout<'a> {
    world: &'a mut dyn Surroundings,
    script: &'a mut VecDeque<u32>,
    dice: &'a mut SeededOracle,
    /// The robots that have something left to do.
    awake: Vec<usize>,
    /// Whether one of them is about to fail.
    fails: bool,
    /// Whether anything was asked that no layout knows.
    has_drawn: bool,
}

impl InLayout<'_> {
    fn chooses(&mut self, words: &str, below: u32, options: &mut dyn FnMut() -> Vec<String>) -> u32 {
        self.has_drawn = true;
        let usual = self.script.pop_front().unwrap_or_else(|| self.dice.pick(below)).min(below - 1);
        self.world.choose(words, options, usual).min(below - 1)
    }

    /// Whether it is so, which is against the robots.
    fn is_so(&mut self, words: &str) -> bool {
        self.chooses(words, 2, &mut || vec!["no".to_owned(), "yes".to_owned()]) == 1
    }
}

impl Oracle for InLayout<'_> {
    /// Which robot fails, or which act.
    fn pick(&mut self, below: u32) -> u32 {
        let awake = self.awake.clone();
        let mut options = || -> Vec<String> {
            let is_one = below as usize == awake.len();
            let acts = |number: u32, bit: usize| {
                if is_one { number as usize == bit } else { (number + 1) >> bit & 1 == 1 }
            };
            let names = |number: u32| {
                let acting = awake.iter().enumerate().filter(|&(bit, _)| acts(number, bit));
                acting.map(|(_, robot)| format!("robot {robot}")).collect::<Vec<_>>().join(" and ")
            };
            (0..below).map(names).collect()
        };
        let words = if std::mem::take(&mut self.fails) { "Which robot fails?" } else { "Who acts next?" };
        self.chooses(words, below, &mut options)
    }

    fn mishap(&mut self) -> bool {
        self.fails = self.is_so("Does a robot fail now?");
        self.fails
    }

    fn is_open(&mut self, edge: Edge) -> bool {
        self.world.is_open(edge)
    }

    /// Whoever crosses an open edge finds the cell behind it free.
    fn is_free(&mut self, _: Cell) -> bool {
        true
    }

    fn arrives(&mut self, from: usize, to: usize) -> bool {
        !self.is_so(&format!("Is the message of robot {from} to robot {to} lost?"))
    }
}

impl<'a, R: Rule> Own<'a, R> {
    /// A team at its start. What no layout knows, such as who acts next, is drawn by `seed`.
    pub fn new(playing: TeamWorld<'a, R>, seed: u64) -> Self {
        let scene = playing.start();
        Self {
            before: scene.clone(),
            cells: scene.cells().collect(),
            script: VecDeque::new(),
            dice: SeededOracle::new(seed, 0),
            title: String::new(),
            is_exploring: true,
            been: HashMap::new(),
            owed: Vec::new(),
            met: playing.met(&scene).into_iter().collect(),
            playing,
            scene,
        }
    }

    /// This team, of which a search has found these answers to what no layout knows.
    #[must_use]
    pub fn choosing(self, choices: &[u32]) -> Self {
        Self { script: choices.iter().copied().collect(), ..self }
    }

    /// The demands of which something is owed in every scene of the round that it goes.
    fn owed_throughout(&self) -> Vec<Promise> {
        let mut owed = self.owed.first().cloned().unwrap_or_default();
        for later in &self.owed {
            owed.iter_mut().zip(later).for_each(|((_, owed), (_, later))| *owed &= later);
        }
        owed.into_iter().filter(|&(_, owed)| owed != 0).map(|(promise, _)| promise).collect()
    }

    fn clauses(&self, broken: Vec<<TeamWorld<'a, R> as World>::Demand>) -> Vec<ClauseId> {
        broken.into_iter().map(|demand| ClauseId::new(self.playing.demand(demand).id)).collect()
    }
}

impl<R: Rule> Team for Own<'_, R> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, world: &mut dyn Surroundings) -> Result<Frame, End> {
        self.before.clone_from(&self.scene);
        let Some(plan) = self.playing.plan(&mut self.scene, &[]) else { return Err(End::Exhausted) };
        // A search that goes round says so by the end of its answers.
        let is_scripted = !self.script.is_empty();
        if let Some(first) = self.been.insert(digest(&self.before), self.owed.len())
            && !is_scripted
        {
            self.owed.drain(..first);
            return Err(End::Endless);
        }
        self.owed.push(self.playing.obligations(&self.before));
        let awake = (0..self.cells.len()).filter(|robot| plan >> robot & 1 == 1).collect();
        let Self { script, dice, .. } = self;
        let mut world = InLayout { world, script, dice, awake, fails: false, has_drawn: false };
        let event = self.playing.settle(&mut self.scene, &plan, &mut Vec::new(), &mut world);
        if world.has_drawn && !is_scripted {
            self.been.clear();
            self.owed.clear();
        }
        self.met.extend(self.playing.met(&self.scene));
        self.title = self.playing.title(&event);
        self.cells = self.scene.cells().collect();
        Ok(event.frame(&self.scene))
    }

    fn due(&self, layout: &Layout) -> u32 {
        if self.is_exploring { layout.free_cells() as u32 } else { 0 }
    }

    fn title(&self) -> Option<&str> {
        Some(self.title.as_str()).filter(|title| !title.is_empty())
    }

    fn show(&self, _: &[Cell], scene: &mut Scene) {
        for robot in (0..self.cells.len()).filter(|&robot| self.scene.is_dead(robot)) {
            if !self.before.is_dead(robot) {
                scene.note(Change::Fail { robot });
            }
        }
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let moved = TeamStep { before: &self.before, after: &self.scene };
        self.clauses(self.playing.broken(|demand| demand.is_broken_by(&moved)))
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        let mut broken = match end {
            End::Explored | End::Exhausted | End::Silent | End::Refused => {
                self.playing.broken_at_end(&self.scene, &[])
            }
            End::Endless => self.owed_throughout(),
            End::Idle => Vec::new(),
        };
        broken.retain(|demand| !self.met.contains(demand));
        self.clauses(broken)
    }
}
