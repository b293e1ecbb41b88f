//! A team of a local rule among walls that are decided as robots meet them: a run that breaks the promise is real.

use std::fmt::Write;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge, Step};

use super::invariant::{agree, promised, words};
use super::numbers::NumberedRule;
use super::rule::{Act, Robot};
use super::wider::seen;
use crate::decide::{Depiction, MethodError};
use crate::engine::states::{Run, System};
use crate::engine::world::{Turn, World, any_of, picked};
use crate::plural::listed;
use crate::protocol::{beside, combinations};

/// The demand.
const PROMISE: &str = "the promise is kept by all robots of which the rule speaks";

/// How far a start may be from cell (0, 0), in columns and rows: relative places fit into their numbers.
const FARTHEST: u16 = 16_000;

/// Robots, and what they have met of the layout.
pub(super) type Start = (Vec<Robot<u32>>, Layout);

/// A layout as far as robots have met it.
#[derive(Clone, PartialEq, Eq, Hash, Default, Debug)]
pub(super) struct Layout {
    /// Edges, sorted, each with whether it is open.
    edges: Vec<(Edge, bool)>,
    /// Cells, sorted, each with its colour.
    colours: Vec<(Cell, u8)>,
}

impl Layout {
    /// The colour of a cell, if it was met.
    fn colour(&self, cell: Cell) -> Option<u8> {
        let place = self.colours.binary_search_by_key(&cell, |&(cell, _)| cell).ok()?;
        Some(self.colours[place].1)
    }

    /// Notes the colour of a cell.
    fn put_colour(&mut self, cell: Cell, colour: u8) {
        if let Err(place) = self.colours.binary_search_by_key(&cell, |&(cell, _)| cell) {
            self.colours.insert(place, (cell, colour));
        }
    }
}

/// An act, and the colour of the cell to which it leads.
type ColouredAct<'a> = (&'a Act<u32, u32>, u8);

/// So many robots that follow a rule.
pub(super) struct Team<'r> {
    rule: &'r dyn NumberedRule,
    tuples: Vec<Vec<usize>>,
    start: Vec<Robot<u32>>,
}

/// The acts of all robots in words, and what comes of them.
type Next = (String, Start);

impl<'r> Team<'r> {
    /// # Errors
    /// [`MethodError`] if the team does not start as the rule says.
    pub(super) fn new(rule: &'r dyn NumberedRule, robots: usize) -> Result<Self, MethodError> {
        let team = Self { rule, tuples: rule.tuples(robots), start: rule.start(robots) };
        if team.start.len() != robots {
            let why = format!("{} robots start where {robots} should", team.start.len());
            return Err(MethodError::new(why));
        }
        let is_far = |at: &Cell| at.x.unsigned_abs().max(at.y.unsigned_abs()) > FARTHEST;
        if let Some(at) = team.start.iter().map(|robot| robot.at).find(is_far) {
            let why = format!(
                "a team of {robots} starts in {at}, more than {FARTHEST} columns or rows from 0,0: let it start nearer"
            );
            return Err(MethodError::new(why));
        }
        let is_coloured = team.start.iter().all(|robot| robot.on < rule.colours());
        if !is_coloured || !agree(team.start.iter().map(|robot| (robot.at, robot.on))) {
            let why = format!(
                "a team of {robots} starts in cells that have no colour below {}, or two",
                rule.colours()
            );
            return Err(MethodError::new(why));
        }
        let states = rule.states();
        let is_named = team.start.iter().all(|robot| states.contains(&robot.state));
        if !is_named && let Some(stray) = rule.stray(robots) {
            let why =
                format!("a team of {robots} starts in {stray}, which is none of the states of the rule");
            return Err(MethodError::new(why));
        }
        let is_none = |tuple: &&Vec<usize>| {
            let is_wrong =
                |(place, robot): (usize, &usize)| *robot >= robots || tuple[..place].contains(robot);
            tuple.len() != rule.robots() || tuple.iter().enumerate().any(is_wrong)
        };
        if let Some(tuple) = team.tuples.iter().find(is_none) {
            let why = format!("tuples names {tuple:?}, which are not {} of {robots} robots", rule.robots());
            return Err(MethodError::new(why));
        }
        if team.tuples.is_empty() && robots >= rule.robots() {
            let why = format!("tuples names none of {robots} robots: the promise would be about nothing");
            return Err(MethodError::new(why));
        }
        let may_not = |tuple: &Vec<Robot<u32>>| !rule.may_start(tuple) || !promised(rule, tuple);
        match team.tuples.iter().map(|tuple| seen(tuple, &team.start)).find(may_not) {
            Some(tuple) => {
                let start = words(rule, &tuple);
                Err(MethodError::new(format_args!("a team of {robots} may not start so: {start}")))
            }
            None => Ok(team),
        }
    }

    pub(super) fn start(&self) -> Start {
        let mut layout = Layout::default();
        for robot in self.start.iter().filter(|_| self.rule.colours() > 1) {
            layout.put_colour(robot.at, robot.on);
        }
        (self.start.clone(), layout)
    }

    /// Every plan of all robots that the rule admits, each robot's act one of `acts`.
    fn plans<'a>(
        &self,
        (robots, layout): &Start,
        acts: &'a [Vec<Act<u32, u32>>],
    ) -> Vec<Vec<ColouredAct<'a>>> {
        let mut all = vec![Vec::new()];
        for (me, (robot, acts)) in robots.iter().zip(acts).enumerate() {
            let is_possible = |act: &&Act<u32, u32>| match act.step {
                _ if !self.rule.is_always_possible(act.act) => false,
                Step::Stay => true,
                Step::Cross(side) => {
                    let edge = (Edge::new(robot.at, side), true);
                    !self.rule.is_fixed(me) && (!act.needs_open || layout.edges.contains(&edge))
                }
            };
            let possible: Vec<_> = acts.iter().filter(is_possible).collect();
            let with = |plan: Vec<ColouredAct<'a>>| {
                let aimed = |&act: &&'a Act<u32, u32>| {
                    let goal = robot.at.after(act.step);
                    let before = robots
                        .iter()
                        .zip(&plan)
                        .find(|(robot, before)| robot.at.after(before.0.step) == goal);
                    let known = before.map(|(_, &(_, aims))| aims).or_else(|| layout.colour(goal));
                    let colours = known.map_or(0..self.rule.colours(), |known| known..known + 1);
                    colours.map(move |aims| (act, aims)).collect::<Vec<_>>()
                };
                let next = possible.iter().flat_map(aimed).map(|act| [&plan[..], &[act]].concat());
                next.filter(|plan| self.admits(robots, plan, me)).collect::<Vec<_>>()
            };
            all = all.into_iter().flat_map(with).collect();
        }
        all
    }

    /// Whether the rule admits the plans of the first robots, `last` the last of them, in every tuple that has it.
    fn admits(&self, robots: &[Robot<u32>], plan: &[ColouredAct<'_>], last: usize) -> bool {
        let is_due = |tuple: &&Vec<usize>| tuple.contains(&last) && tuple.iter().all(|&robot| robot <= last);
        self.tuples.iter().filter(is_due).all(|tuple| {
            let plans: Vec<_> =
                tuple.iter().map(|&robot| robots[robot].plans(plan[robot].0, plan[robot].1)).collect();
            self.rule.admits(&plans)
        })
    }

    /// Whatever comes of a plan, by the edges and by what robots do.
    fn outcomes(&self, (robots, layout): &Start, plan: &[ColouredAct<'_>]) -> Vec<Start> {
        let mut outcomes = Vec::new();
        'ends: for ends in combinations(plan.iter().map(|(act, _)| act.ends.clone())) {
            let (mut after, mut met) = (Vec::new(), layout.clone());
            for ((robot, &(act, aims)), end) in robots.iter().zip(plan).zip(ends) {
                if let Step::Cross(side) = act.step {
                    if self.rule.colours() > 1 {
                        met.put_colour(robot.at.after(act.step), aims);
                    }
                    if end.0 || !self.rule.may_fail() {
                        let edge = Edge::new(robot.at, side);
                        match met.edges.binary_search_by_key(&edge, |&(edge, _)| edge) {
                            Ok(place) if met.edges[place].1 != end.0 => continue 'ends,
                            Ok(_) => {}
                            Err(place) => met.edges.insert(place, (edge, end.0)),
                        }
                    }
                }
                after.push(robot.after((act.step, aims), end));
            }
            outcomes.push((after, met));
        }
        outcomes
    }

    /// The run, drawn.
    pub(super) fn story(&self, run: &Run<&'static str>) -> Depiction {
        let start = self.start();
        let mut frames = vec![("start".to_owned(), self.draw(&start))];
        frames.extend(run.played(self, start).map(|(_, step)| (step.event, self.draw(&step.state))));
        Depiction::Story(beside(&frames))
    }

    /// The cells that robots are in, robots by number, and below them their
    /// states, if there is more than one, and walls.
    fn draw(&self, (robots, layout): &Start) -> String {
        let (columns, rows) = (robots.iter().map(|robot| robot.at.x), robots.iter().map(|robot| robot.at.y));
        let span = |of: &mut dyn Iterator<Item = i16>| {
            of.fold((0, 0), |(low, high), at| (at.min(low), at.max(high)))
        };
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
        let states: Vec<String> = robots.iter().map(|robot| self.rule.state_words(robot.state)).collect();
        if states.iter().any(|state| state != "()") {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}", states.join(", "));
        }
        for (cell, colour) in layout.colours.iter().filter(|&&(_, colour)| colour > 0) {
            let _ = writeln!(text, "colour {colour} in {cell}");
        }
        for (edge, _) in layout.edges.iter().filter(|(_, is_open)| !is_open) {
            let _ = writeln!(text, "wall {}|{}", edge.cell(), edge.cell().beyond(edge.side()));
        }
        text
    }
}

impl World for Team<'_> {
    type State = Start;
    type Plan = Vec<Next>;
    type Event = String;
    type Demand = &'static str;

    fn plan(&self, state: &mut Self::State, _: &[u8]) -> Option<Self::Plan> {
        let acts: Vec<_> = state.0.iter().map(|robot| self.rule.acts(robot.state)).collect();
        let mut all = Vec::new();
        for plan in self.plans(state, &acts) {
            let words = listed(plan.iter().map(|(act, _)| self.rule.act_words(act.act)));
            all.extend(self.outcomes(state, &plan).into_iter().map(|next| (words.clone(), next)));
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

impl System for Team<'_> {
    type Part = Start;

    fn part(&self, state: &Self::State, _: usize) -> Self::Part {
        state.clone()
    }

    fn put(&self, state: &mut Self::State, _: usize, part: &Self::Part) {
        state.clone_from(part);
    }
}
