//! A team of a local rule among walls that are decided as robots meet them: a run that breaks the promise is real.

use std::fmt::Write;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge, Step};

use super::invariant::{promised, relative};
use super::{ActOf, Local, Robot, RobotOf};
use crate::decide::{Depiction, MethodError};
use crate::engine::states::{Run, System};
use crate::engine::world::{Turn, World, any_of, picked};
use crate::protocol::{beside, combinations};

/// The demand.
const PROMISE: &str = "the promise is kept by all robots of which the rule speaks";

/// Robots, and the edges that they have met, each with whether it is open.
pub(super) type Start<S> = (Vec<Robot<S>>, Vec<(Edge, bool)>);

/// So many robots that follow a rule.
pub(super) struct Team<'r, R: Local> {
    rule: &'r R,
    tuples: Vec<Vec<usize>>,
    start: Vec<RobotOf<R>>,
}

/// The acts of all robots in words, and what comes of them.
type Next<S> = (String, Start<S>);

/// The robots of a tuple as seen from the first of them.
fn seen<S: Copy>(tuple: &[usize], robots: &[Robot<S>]) -> Vec<Robot<S>> {
    relative(&tuple.iter().map(|&robot| robots[robot]).collect::<Vec<_>>())
}

impl<'r, R: Local> Team<'r, R> {
    /// # Errors
    /// [`MethodError`] if the team does not start as the rule says.
    pub(super) fn new(rule: &'r R, robots: usize) -> Result<Self, MethodError> {
        let team = Self { rule, tuples: rule.tuples(robots), start: rule.start(robots) };
        if team.start.len() != robots {
            let why = format!("{} robots start where {robots} should", team.start.len());
            return Err(MethodError::new(why));
        }
        let may_not = |tuple: &Vec<RobotOf<R>>| !rule.may_start(tuple) || !promised(rule, tuple);
        match team.tuples.iter().map(|tuple| seen(tuple, &team.start)).find(may_not) {
            Some(tuple) => {
                Err(MethodError::new(format_args!("a team of {robots} may not start so: {tuple:?}")))
            }
            None => Ok(team),
        }
    }

    pub(super) fn start(&self) -> Start<R::State> {
        (self.start.clone(), Vec::new())
    }

    /// Every plan of all robots that the rule admits, each robot's act one of `acts`.
    fn plans<'a>(
        &self,
        (robots, edges): &Start<R::State>,
        acts: &'a [Vec<ActOf<R>>],
    ) -> Vec<Vec<&'a ActOf<R>>> {
        let mut all = vec![Vec::new()];
        for (me, (robot, acts)) in robots.iter().zip(acts).enumerate() {
            let is_possible = |act: &&ActOf<R>| match act.step {
                Step::Stay => true,
                Step::Cross(side) => {
                    let edge = (Edge::new(robot.at, side), true);
                    !self.rule.is_fixed(me) && (!act.needs_open || edges.contains(&edge))
                }
            };
            let possible: Vec<_> = acts.iter().filter(is_possible).collect();
            let with = |plan: Vec<_>| {
                let next = possible.iter().map(move |&act| [&plan[..], &[act]].concat());
                next.filter(|plan| self.admits(robots, plan, me)).collect::<Vec<_>>()
            };
            all = all.into_iter().flat_map(with).collect();
        }
        all
    }

    /// Whether the rule admits the plans of the first robots, `last` the last of them, in every tuple that has it.
    fn admits(&self, robots: &[RobotOf<R>], plan: &[&ActOf<R>], last: usize) -> bool {
        let is_due = |tuple: &&Vec<usize>| tuple.contains(&last) && tuple.iter().all(|&robot| robot <= last);
        self.tuples.iter().filter(is_due).all(|tuple| {
            let plans: Vec<_> = tuple.iter().map(|&robot| robots[robot].plans(plan[robot])).collect();
            self.rule.admits(&plans)
        })
    }

    /// Whatever comes of a plan, by the edges and by what robots do.
    fn outcomes((robots, edges): &Start<R::State>, plan: &[&ActOf<R>]) -> Vec<Start<R::State>> {
        let mut outcomes = Vec::new();
        'ends: for ends in combinations(plan.iter().map(|act| act.ends.clone())) {
            let (mut after, mut met) = (Vec::new(), edges.clone());
            for ((robot, act), end) in robots.iter().zip(plan).zip(ends) {
                if let Step::Cross(side) = act.step
                    && (end.0 || !R::FAULTS)
                {
                    let edge = Edge::new(robot.at, side);
                    match met.binary_search_by_key(&edge, |&(edge, _)| edge) {
                        Ok(place) if met[place].1 != end.0 => continue 'ends,
                        Ok(_) => {}
                        Err(place) => met.insert(place, (edge, end.0)),
                    }
                }
                after.push(robot.after(act.step, end));
            }
            outcomes.push((after, met));
        }
        outcomes
    }

    /// The run, drawn.
    pub(super) fn story(&self, run: &Run<&'static str>) -> Depiction {
        let start = self.start();
        let mut frames = vec![("start".to_owned(), draw(&start))];
        frames.extend(run.played(self, start).map(|(_, step)| (step.event, draw(&step.state))));
        Depiction::Story(beside(&frames))
    }
}

/// The cells that robots are in, robots by number, and below them their states, if there is more than one, and walls.
fn draw<S: std::fmt::Debug>((robots, edges): &Start<S>) -> String {
    let (columns, rows) = (robots.iter().map(|robot| robot.at.x), robots.iter().map(|robot| robot.at.y));
    let span =
        |of: &mut dyn Iterator<Item = i16>| of.fold((0, 0), |(low, high), at| (at.min(low), at.max(high)));
    let ((left, right), (top, bottom)) = (span(&mut columns.into_iter()), span(&mut rows.into_iter()));
    let here = |cell: Cell| -> String {
        let names = robots.iter().zip('0'..).filter(|(robot, _)| robot.at == cell);
        names.map(|(_, name)| name).collect()
    };
    let mut text = String::new();
    for y in top..=bottom {
        let row: Vec<String> =
            (left..=right).map(|x| format!("{:.<1$}", here(Cell::new(x, y)), robots.len())).collect();
        text += &row.join(" ");
        text.push('\n');
    }
    let states: Vec<String> = robots.iter().map(|robot| format!("{:?}", robot.state)).collect();
    if states.iter().any(|state| state != "()") {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", states.join(", "));
    }
    for (edge, _) in edges.iter().filter(|(_, is_open)| !is_open) {
        let _ = writeln!(text, "wall {}|{}", edge.cell(), edge.cell().beyond(edge.side()));
    }
    text
}

impl<R: Local> World for Team<'_, R> {
    type State = Start<R::State>;
    type Plan = Vec<Next<R::State>>;
    type Event = String;
    type Demand = &'static str;

    fn plan(&self, state: &mut Self::State, _: &[u8]) -> Option<Self::Plan> {
        let acts: Vec<_> = state.0.iter().map(|robot| self.rule.acts(robot.state)).collect();
        let mut all = Vec::new();
        for plan in self.plans(state, &acts) {
            let words: Vec<String> = plan.iter().map(|act| format!("{:?}", act.act)).collect();
            let words = words.join(", ");
            all.extend(Self::outcomes(state, &plan).into_iter().map(|next| (words.clone(), next)));
        }
        any_of(all)
    }

    fn settle(
        &self,
        state: &mut Self::State,
        plan: &Self::Plan,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> String {
        let (words, next) = picked(plan, world);
        *state = next;
        words
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        let is_kept = |tuple: &Vec<usize>| promised(self.rule, &seen(tuple, &turn.after.0));
        if self.tuples.iter().all(is_kept) { Vec::new() } else { vec![PROMISE] }
    }
}

impl<R: Local> System for Team<'_, R> {
    type Part = Start<R::State>;

    fn part(&self, state: &Self::State, _: usize) -> Self::Part {
        state.clone()
    }

    fn put(&self, state: &mut Self::State, _: usize, part: &Self::Part) {
        state.clone_from(part);
    }
}
