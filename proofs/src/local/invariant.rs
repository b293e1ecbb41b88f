//! The greatest set of relative places that keep a promise and that no admitted step leaves.

use std::collections::{HashMap, HashSet};
use std::iter;

use tautline_kernel::ground::Cell;

use super::{Far, Local, Plan, Robot, RobotOf};
use crate::decide::MethodError;
use crate::protocol::combinations;

/// More relative places than these are refused.
const MOST_PLACES: usize = 4_000_000;

/// How much farther than the promise looks a set may look.
const WIDER: i16 = 2;

/// Robots of which a rule speaks at once, the first one in cell (0, 0).
type Tuple<S> = Vec<Robot<S>>;

/// A set of relative places that no admitted step of a rule leaves.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Invariant<S> {
    /// How many columns and rows robots are at most from the first one.
    pub window: i16,
    /// How many relative places there are, and how many of them keep the promise.
    pub places: (usize, usize),
    /// The relative places that no admitted step leaves, sorted.
    pub kept: Vec<Tuple<S>>,
    /// Steps of tuples that were looked at.
    pub cases: u64,
    /// Whether robots that come from afar, or that start, may be in a place that is not kept.
    is_left: bool,
}

impl<S: Copy + Eq + Ord + std::hash::Hash + std::fmt::Debug> Invariant<S> {
    /// The set of `rule`: the first that holds of those that look as far as the promise and a little farther.
    ///
    /// # Errors
    /// [`MethodError`] if the rule is not the same everywhere, has a state that is none of its states, looks too far,
    /// may start with a broken promise, or may not start.
    pub fn of<R: Local<State = S>>(rule: &R) -> Result<Self, MethodError> {
        let (reach, far) = rule.reach();
        let widest = if far == Far::Fine { reach + WIDER } else { reach };
        let mut found = Self::within(rule, reach)?;
        for window in reach + 1..=widest {
            if found.holds() {
                break;
            }
            found = Self::within(rule, window)?;
        }
        Ok(found)
    }

    /// Whether the promise holds of every number of robots.
    pub const fn holds(&self) -> bool {
        !self.is_left
    }

    fn within<R: Local<State = S>>(rule: &R, window: i16) -> Result<Self, MethodError> {
        let is_fine = rule.reach().1 == Far::Fine;
        let all = tuples(rule, window)?;
        let is_near = |tuple: &[Robot<S>]| is_within(tuple, window);
        let mut kept: HashSet<Tuple<S>> = all.iter().filter(|tuple| promised(rule, tuple)).cloned().collect();
        let (places, mut cases) = ((all.len(), kept.len()), 0);
        let starts: Vec<&Tuple<S>> = all.iter().filter(|tuple| rule.may_start(tuple)).collect();
        if starts.is_empty() && !is_fine {
            return Err(MethodError::new("no robots may start: the promise would be about nothing"));
        }
        if let Some(start) = starts.iter().find(|&&start| !kept.contains(start)) {
            return Err(MethodError::new(format_args!("robots that start so break the promise: {start:?}")));
        }
        // Each tuple is looked at once more when one to which it leads is gone.
        let mut before: HashMap<Tuple<S>, Vec<Tuple<S>>> = HashMap::new();
        let mut gone: Vec<Tuple<S>> = Vec::new();
        for tuple in all.iter().filter(|tuple| kept.contains(*tuple)) {
            let mut is_gone = false;
            each_step(rule, tuple, &mut |next| {
                cases += 1;
                if !is_near(&next) {
                    is_gone |= !is_fine;
                } else if promised(rule, &next) {
                    before.entry(next).or_default().push(tuple.clone());
                } else {
                    is_gone = true;
                }
            })?;
            if is_gone {
                gone.push(tuple.clone());
            }
        }
        while let Some(tuple) = gone.pop() {
            if kept.remove(&tuple) {
                gone.extend(before.remove(&tuple).unwrap_or_default());
            }
        }
        let mut is_left = starts.iter().any(|&start| !kept.contains(start));
        if is_fine && !is_left {
            for tuple in tuples(rule, window + 2)?.iter().filter(|tuple| !is_near(tuple)) {
                each_step(rule, tuple, &mut |next| {
                    cases += 1;
                    is_left |= is_near(&next) && !kept.contains(&next);
                })?;
            }
        }
        let mut kept: Vec<Tuple<S>> = kept.into_iter().collect();
        kept.sort_unstable();
        Ok(Self { window, places, kept, cases, is_left })
    }
}

/// Whether robots keep the promise, however far they are from each other.
pub(super) fn promised<R: Local>(rule: &R, robots: &[RobotOf<R>]) -> bool {
    let (reach, far) = rule.reach();
    if is_within(robots, reach) { rule.keeps(robots) } else { far == Far::Fine }
}

/// Whether all are at most so many columns and rows from the first one, which is in cell (0, 0).
fn is_within<S>(robots: &[Robot<S>], window: i16) -> bool {
    robots.iter().all(|robot| robot.at.x.abs() <= window && robot.at.y.abs() <= window)
}

/// The robots as seen from the cell of the first one.
pub(super) fn relative<S: Copy>(robots: &[Robot<S>]) -> Tuple<S> {
    let Some(&Robot { at: from, .. }) = robots.first() else { return Vec::new() };
    moved(robots, (-from.x, -from.y))
}

fn moved<S: Copy>(robots: &[Robot<S>], (columns, rows): (i16, i16)) -> Tuple<S> {
    let by = |at: Cell| Cell::new(at.x + columns, at.y + rows);
    robots.iter().map(|&Robot { at, state }| Robot { at: by(at), state }).collect()
}

/// Every tuple of robots within a window.
fn tuples<R: Local>(rule: &R, window: i16) -> Result<Vec<Tuple<R::State>>, MethodError> {
    let states = rule.states();
    let side = 2 * window as usize + 1;
    let of_one = side.saturating_mul(side).saturating_mul(states.len());
    let count = (1..R::ROBOTS).try_fold(states.len(), |count, _| count.checked_mul(of_one));
    if count.is_none_or(|count| count > MOST_PLACES) {
        let count = count.map_or_else(|| "too many".to_owned(), |count| count.to_string());
        let why = format!(
            "{count} relative places are more than {MOST_PLACES}: let the rule look less far, or give it fewer states"
        );
        return Err(MethodError::new(why));
    }
    let cells = |state| {
        (-window..=window)
            .flat_map(move |x| (-window..=window).map(move |y| Robot { at: Cell::new(x, y), state }))
    };
    let first = states.iter().map(|&state| Robot { at: Cell::new(0, 0), state }).collect();
    let others: Vec<RobotOf<R>> = states.iter().flat_map(|&state| cells(state)).collect();
    Ok(combinations(iter::once(first).chain(iter::repeat_n(others, R::ROBOTS - 1))))
}

/// A place far from (0, 0), to see whether a rule is the same there.
const ELSEWHERE: (i16, i16) = (113, 57);

/// Every tuple to which one step of a tuple may lead, as seen from its first robot then.
fn each_step<R: Local>(
    rule: &R,
    tuple: &[RobotOf<R>],
    visit: &mut dyn FnMut(Tuple<R::State>),
) -> Result<(), MethodError> {
    let states = rule.states();
    let acts: Vec<_> = tuple.iter().map(|robot| rule.acts(robot.state)).collect();
    for picked in combinations(acts.iter().map(|acts| acts.iter().collect())) {
        let plan = |robots: &[RobotOf<R>]| -> Vec<_> {
            robots.iter().zip(&picked).map(|(robot, act)| robot.plans(act)).collect()
        };
        let plans = plan(tuple);
        let is_admitted = rule.admits(&plans);
        if rule.admits(&plan(&moved(tuple, ELSEWHERE))) != is_admitted {
            let word = |plan: &Plan<R::State, R::Act>| format!("{:?} in {}", plan.act, plan.robot.at);
            let words: Vec<String> = plans.iter().map(word).collect();
            let (columns, rows) = ELSEWHERE;
            let why = format!(
                "the rule is not the same everywhere: it answers {} in another way {columns} columns and {rows} rows away",
                words.join(", ")
            );
            return Err(MethodError::new(why));
        }
        if !is_admitted {
            continue;
        }
        for ends in combinations(picked.iter().map(|act| act.ends.clone())) {
            let after =
                tuple.iter().zip(&picked).zip(ends).map(|((robot, act), end)| robot.after(act.step, end));
            let next: Vec<_> = after.collect();
            if let Some(robot) = next.iter().find(|robot| !states.contains(&robot.state)) {
                let why = format!("{:?} is none of the states of the rule", robot.state);
                return Err(MethodError::new(why));
            }
            visit(relative(&next));
        }
    }
    Ok(())
}
