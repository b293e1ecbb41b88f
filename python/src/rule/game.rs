//! A rule written in Python as a rule of each robot: all remember the number of one state, and see the whole team. The
//! first one also remembers which demands were met: a run without end keeps `eventually` by what came before its round.

use std::ops::Range;
use std::sync::Arc;

use tautline_kernel::ground::{Cell, Step};
use tautline_proofs::engine::states::Bits;
use tautline_proofs::team::{
    Act, Cover, Demand, Ground, Places, Rule, Scene, Senses, Setting, TeamStep, View, Which,
};

use super::python_rule::{Cells, MAX_ROBOTS, Move, RuleScript, WallHits, When};

/// The rule, asked as a robot asks it.
#[derive(Clone)]
pub(super) struct PythonRule {
    pub(super) written: Arc<RuleScript>,
    /// The demands that are looked at.
    pub(super) wanted: Range<usize>,
}

/// The memory of each robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Memory {
    /// The number of the state.
    state: u32,
    /// The demands that were met before the last team move, a bit for each; of the first robot alone.
    met: u64,
}

impl Rule for PythonRule {
    type Memory = Memory;
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) -> Memory {
        Memory { state: self.written.start().0, met: 0 }
    }

    fn act(&self, view: &mut View<'_, Self>, memory: &mut Memory) -> Act {
        let (mut cells, mut blocked) = ([Cell::new(0, 0); MAX_ROBOTS], [false; MAX_ROBOTS]);
        for robot in 0..view.robots() {
            cells[robot] = view.sees(robot).unwrap_or(cells[robot]);
            blocked[robot] = view.sees_blocked(robot).unwrap_or(false);
        }
        let Memory { state, met } = *memory;
        let is_new = |demand: &usize| met >> demand & 1 == 0 && self.written.is_met(*demand, state, &cells);
        // All act together, and one of them remembers it for all.
        if view.me() == 0 {
            memory.met = self.wanted.clone().filter(is_new).fold(met, |met, demand| met | 1 << demand);
        }
        let (next, steps) = self.written.step(state, &cells, blocked);
        memory.state = next;
        match steps.map(|steps| steps[view.me()]) {
            Some(Step::Cross(side)) => Act::Go(side),
            Some(Step::Stay) | None => Act::Wait,
        }
    }

    fn is_done(&self, _: usize, scene: &Scene<Self>) -> bool {
        let (cells, blocked) = seen(scene);
        self.written.step(scene.memory(0).state, &cells, blocked).1.is_none()
    }
}

/// Where the robots are, and which of them have just met a wall.
fn seen(scene: &Scene<PythonRule>) -> (Cells, WallHits) {
    let (mut cells, mut blocked) = ([Cell::new(0, 0); MAX_ROBOTS], [false; MAX_ROBOTS]);
    for robot in 0..scene.robots() {
        (cells[robot], blocked[robot]) = (scene.cell(robot), scene.was_blocked(robot));
    }
    (cells, blocked)
}

/// The state of a team, as far as it is known: a rule that learns something at its end says so with its last answer.
fn last(written: &RuleScript, scene: &Scene<PythonRule>) -> u32 {
    let ((cells, blocked), state) = (seen(scene), scene.memory(0).state);
    let (next, steps) = written.step(state, &cells, blocked);
    if steps.is_none() { next } else { state }
}

/// A team move as Python sees it.
fn moved(written: &RuleScript, moved: &TeamStep<'_, PythonRule>) -> Move {
    let (before, after) = (moved.before.memory(0).state, moved.after.memory(0).state);
    let ((from, was_blocked), (to, blocked)) = (seen(moved.before), seen(moved.after));
    let steps = written.step(before, &from, was_blocked).1.unwrap_or([Step::Stay; MAX_ROBOTS]);
    Move { before, after, from, to, steps, blocked }
}

/// A question about a team move.
type MoveQuestion<'a> = Box<dyn Fn(&TeamStep<'_, PythonRule>) -> bool + Sync + 'a>;
/// A question about the end of a run.
type EndQuestion<'a> = Box<dyn Fn(&Scene<PythonRule>) -> bool + Sync + 'a>;

/// A question about what is owed.
type OwedQuestion<'a> = Box<dyn Fn(&Scene<PythonRule>) -> Bits + Sync + 'a>;

/// The questions that a rule's demands and covers ask.
pub(super) struct Questions<'a> {
    of_moves: Vec<MoveQuestion<'a>>,
    of_ends: Vec<EndQuestion<'a>>,
    of_owed: Vec<OwedQuestion<'a>>,
    covers: Vec<MoveQuestion<'a>>,
}

impl<'a> Questions<'a> {
    pub(super) fn of(written: &'a RuleScript) -> Self {
        let of_move = |demand: usize| -> MoveQuestion<'a> {
            Box::new(move |step| !written.is_broken_by(demand, &moved(written, step)))
        };
        let of_end = |demand: usize| -> EndQuestion<'a> {
            Box::new(move |scene| !written.is_broken_at_end(demand, last(written, scene), &seen(scene).0))
        };
        let of_owed = |demand: usize| -> OwedQuestion<'a> {
            Box::new(move |scene| {
                let (state, cells) = (last(written, scene), seen(scene).0);
                let is_met =
                    || scene.memory(0).met >> demand & 1 == 1 || written.is_met(demand, state, &cells);
                match written.demands[demand].when {
                    When::Eventually(_) => Bits::from(!is_met()),
                    When::Always(_) | When::AtTheEnd(_) | When::NeverEndless | When::AgainAndAgain(_) => {
                        written.owed(demand, state, &cells)
                    }
                }
            })
        };
        let cover = |cover: usize| -> MoveQuestion<'a> {
            Box::new(move |step| written.occurs(cover, &moved(written, step)))
        };
        let demands = 0..written.demands.len();
        Self {
            of_moves: demands.clone().map(of_move).collect(),
            of_ends: demands.clone().map(of_end).collect(),
            of_owed: demands.map(of_owed).collect(),
            covers: (0..written.covers.len()).map(cover).collect(),
        }
    }

    pub(super) fn demands(&'a self, written: &RuleScript) -> Vec<Demand<'a, PythonRule>> {
        let demand = |(number, demand): (usize, &super::python_rule::Demand)| {
            let (id, words) = (demand.clause.as_str(), demand.words);
            match demand.when {
                When::Always(_) => Demand::always(id, words, &*self.of_moves[number]),
                When::AtTheEnd(_) => Demand::at_the_end(id, words, &*self.of_ends[number]),
                When::NeverEndless => Demand::never_endless(id, words),
                // A team that remembers what was met owes what was not, and once it is met never again.
                When::Eventually(_) | When::AgainAndAgain(_) => {
                    Demand::again_and_again(id, words, &*self.of_owed[number])
                }
            }
        };
        written.demands.iter().enumerate().map(demand).collect()
    }

    pub(super) fn covers(&'a self, written: &RuleScript) -> Vec<Cover<'a, PythonRule>> {
        written.covers.iter().zip(&self.covers).map(|(&(name, _), is_one)| (name, &**is_one as _)).collect()
    }
}

/// The surroundings of a rule.
pub(super) fn setting<'a>(
    written: &RuleScript,
    demands: &'a [Demand<'a, PythonRule>],
    covers: &'a [Cover<'a, PythonRule>],
) -> Setting<'a, PythonRule> {
    let (width, height) = written.size;
    let ground = Ground::open(width, height).walls(Which::Met(written.max_walls));
    let starts = Places::At(|rule: &PythonRule| rule.written.starts().to_vec());
    Setting {
        senses: Senses::TEAM,
        longest_run: written.longest_run,
        demands,
        covers,
        ..Setting::new(written.scheme, ground, written.robots, starts)
    }
}
