//! A world as it is drawn and played: what stands still, how a state looks, and who answers what may happen next.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge};
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::engine::world::{Turn, World};
use tautline_sim::draw::page::{film, number_of, place_of, side_of};
use tautline_sim::explore::{Layer, Place};

use crate::ask::{Answers, Question};
use crate::clauses::sentence;
use crate::play::{Board, BrokenClause, Delta, Over, Play, Step};

/// A world whose states can be shown.
pub(super) trait SceneWorld: World {
    /// The part that stands still.
    fn scene(&self) -> Scene;

    /// The events that may happen next, in words, as the plan lists them.
    fn options(&self, state: &Self::State, plan: &Self::Plan) -> Vec<String>;

    /// How a state looks.
    fn picture(&self, state: &Self::State) -> Picture;

    /// The id of the clause that a demand belongs to, and what is broken, in words.
    fn clause(&self, demand: Self::Demand) -> (&'static str, String);
}

/// The part of a world that stands still.
pub(super) struct Scene {
    pub(super) area: Area,
    /// The noun for whoever acts.
    pub(super) actor: &'static str,
    /// The actors that are drawn as squares: so many of the first.
    pub(super) squares: usize,
    /// The names of the actors, if they are not their numbers.
    pub(super) names: Vec<String>,
    pub(super) layers: Vec<Layer>,
}

/// How a state looks.
#[derive(Default)]
pub(super) struct Picture {
    /// Where the actors are.
    pub(super) cells: Vec<Cell>,
    pub(super) explored: Vec<Cell>,
    /// Sides that are known, and whether they are open.
    pub(super) known: Vec<(Edge, bool)>,
    /// Values in layers.
    pub(super) put: Vec<(usize, Option<usize>, Place, u8)>,
    /// Layer, kind, and from whom to whom.
    pub(super) say: Vec<(usize, usize, usize, usize)>,
    pub(super) failed: Vec<usize>,
}

/// A world on its way.
pub(super) struct WorldRun<W: SceneWorld> {
    world: W,
    state: W::State,
    log: Vec<u8>,
    dice: SeededOracle,
    step: u32,
}

impl<W: SceneWorld + 'static> WorldRun<W> {
    pub(super) fn boxed(world: W, state: W::State, seed: u64) -> Box<dyn Play>
    where
        W::State: 'static,
    {
        Box::new(Self { world, state, log: Vec::new(), dice: SeededOracle::new(seed, 0), step: 0 })
    }
}

impl<W: SceneWorld> WorldRun<W> {
    fn delta(&self, picture: Picture) -> Delta {
        let Scene { area, layers, .. } = self.world.scene();
        let Picture { cells, explored, known, put, say, failed } = picture;
        let placed = |(layer, robot, spot, value)| Some((layer, robot, number_of(area, spot)?, value));
        Delta {
            step: self.step,
            tried: ".".repeat(cells.len()),
            explored: explored.iter().chain(&cells).filter_map(|&cell| place_of(area, cell)).collect(),
            cells: cells.into_iter().map(|cell| place_of(area, cell)).collect(),
            known: known.into_iter().filter_map(|(edge, is)| Some((side_of(area, edge)?, is))).collect(),
            clear: (0..layers.len()).collect(),
            put: put.into_iter().filter_map(placed).collect(),
            say: say.into_iter().map(|(layer, kind, from, to)| (layer, kind, from, Some(vec![to]))).collect(),
            failed,
            ..Delta::default()
        }
    }

    fn broken(&self, demands: Vec<W::Demand>) -> Vec<BrokenClause> {
        let broken = |demand| {
            let (clause, told) = self.world.clause(demand);
            let (sentence, told) = (sentence(clause), vec![told]);
            BrokenClause { clause: clause.to_owned(), sentence, told, cells: Vec::new() }
        };
        demands.into_iter().map(broken).collect()
    }
}

impl<W: SceneWorld> Play for WorldRun<W> {
    fn board(&self) -> Board {
        let Scene { area, actor, squares, names, layers } = self.world.scene();
        Board {
            columns: area.width(),
            rows: area.height(),
            area: [area.first().x, area.first().y, area.width() as i16, area.height() as i16],
            robot: actor,
            unit: "step",
            squares,
            names,
            has_leader: false,
            sees: false,
            due: 0,
            layers: layers.iter().map(film::layer).collect(),
            start: self.delta(self.world.picture(&self.state)),
        }
    }

    fn step(&mut self, answers: &mut Answers) -> Step {
        let Self { world, state, log, dice, .. } = self;
        let before = state.clone();
        let Some(plan) = world.plan(state, log) else {
            let (words, broken) = ("nothing can happen any more".to_owned(), world.broken_at_end(state, log));
            return Step::Over(Over { words, broken: self.broken(broken) });
        };
        let options = world.options(state, &plan);
        let (planned, sent) = (state.clone(), log.len());
        let mut asked = AnswerSource { answers, dice, options, taken: String::new() };
        let event = world.settle(state, &plan, log, &mut asked);
        let words = asked.taken;
        let (before, planned, after) = (&before, &planned, &*state);
        let turn = Turn { before, planned, after, plan: &plan, event: &event, sent: &log[sent..] };
        let demands = world.broken_by(&turn);
        let picture = world.picture(state);
        self.step += 1;
        let broken = self.broken(demands);
        Step::Made(Box::new(Delta { words, broken, ..self.delta(picture) }))
    }
}

/// Answers as somebody gives them, or as the dice fall.
struct AnswerSource<'a> {
    answers: &'a mut Answers,
    dice: &'a mut SeededOracle,
    /// The events that may happen, until one of them is picked.
    options: Vec<String>,
    /// The event that was picked.
    taken: String,
}

impl Oracle for AnswerSource<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        let usual = self.dice.pick(below);
        let mut options = std::mem::take(&mut self.options);
        let is_first = options.len() == below as usize;
        if !is_first {
            options = (1..=below).map(|number| number.to_string()).collect();
        }
        let question = || Question {
            words: if is_first { "What happens next?" } else { "Which one?" }.to_owned(),
            options: options.clone(),
            usual,
            side: None,
            robots: Vec::new(),
        };
        let picked = if below < 2 { 0 } else { self.answers.ask(usual, question).min(below - 1) };
        if is_first {
            self.taken.clone_from(&options[picked as usize]);
        }
        picked
    }
}
