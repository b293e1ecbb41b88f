//! The greatest set of relative places that keep a promise and that no admitted step leaves.

use std::fmt;
use std::iter;

use rustc_hash::{FxHashMap, FxHashSet};
use tautline_kernel::ground::{Cell, Step};

use super::numbers::{ByNumber, NumberedRule};
use super::rule::{Act, Far, Local, Plan, Robot};
use crate::decide::{Answer, MethodError, Verdict};
use crate::engine::watchdog;
use crate::plural::counted;
use crate::protocol::combinations;

/// More relative places than these are refused.
const MOST_PLACES: usize = 4_000_000;

/// How much farther than the promise looks a set may look, and with how many relative places.
const WIDER: i16 = 2;
const MOST_WIDER_PLACES: usize = 100_000;

/// How much nearer two robots can come in one step.
const AFAR: i16 = 2;

/// Robots of which a rule speaks at once, the first one in cell (0, 0).
pub(super) type Tuple = Vec<Robot<u32>>;

/// A set of relative places that no admitted step of a rule leaves.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Invariant {
    /// How many columns and rows robots are at most from the first one.
    pub window: i16,
    /// How many relative places there are, and how many of them keep the promise.
    pub places: (usize, usize),
    /// The relative places that no admitted step leaves, sorted; a state is its place among all states in order.
    pub kept: Vec<Tuple>,
    /// Steps of tuples that were looked at.
    pub cases: u64,
    /// Whether robots that come from afar, or that start, may be in a place that is not kept.
    is_left: bool,
}

impl Invariant {
    /// The set of `rule`: the first that holds of those that look as far as the promise and a little farther.
    ///
    /// # Errors
    /// [`MethodError`] if the rule is not the same everywhere, speaks of no robot, has no colour, no state or one that
    /// is none of its states, an act without an outcome or one that no wall stops, admits nothing, looks too far, may
    /// start with a broken promise, or may not start.
    pub fn of<R: Local>(rule: &R) -> Result<Self, MethodError> {
        Self::found(&ByNumber::new(rule))
    }

    /// The set of a rule by numbers: see [`Self::of`].
    pub(super) fn found(rule: &dyn NumberedRule) -> Result<Self, MethodError> {
        let (reach, far) = rule.reach();
        MethodError::unless(reach >= 0, format_args!("the promise looks {reach} cells far: give 0 or more"))?;
        for (is_there, what) in [
            (rule.robots() > 0, "speaks of no robot"),
            (rule.colours() > 0, "gives cells no colour"),
            (!rule.states().is_empty(), "names no state"),
        ] {
            let why = format_args!("the rule {what}: the promise would be about nothing");
            MethodError::unless(is_there, why)?;
        }
        let mut found = Self::within(rule, reach)?;
        let widest = if far == Far::Fine { reach + WIDER } else { reach };
        for window in reach + 1..=widest {
            if found.holds() || places(rule, window + AFAR).is_none_or(|count| count > MOST_WIDER_PLACES) {
                break;
            }
            found = Self::within(rule, window)?;
        }
        let why = "the rule admits no plan of robots that keep the promise, as far as is looked: the promise would be \
                   about nothing; let admits say yes to a plan, such as that all stay";
        MethodError::unless(found.cases > 0, why)?;
        Ok(found)
    }

    /// Whether the promise holds of every number of robots.
    pub const fn holds(&self) -> bool {
        !self.is_left
    }

    /// The answer that the promise holds.
    pub(super) fn answer(&self) -> Answer {
        Answer { note: Some(self.to_string()), ..Answer::new(None, true, Verdict::Holds, self.cases) }
    }

    /// A shortest way of the robots of which the rule speaks from a start to where they break the promise, each place
    /// in words: what others do to them plays no part, so that no team need go so. Empty if there is none.
    pub(super) fn way_out(&self, rule: &dyn NumberedRule) -> Result<Vec<String>, MethodError> {
        let steps = Steps::of(rule)?;
        let starts = tuples(rule, self.window)?.into_iter().filter(|tuple| rule.may_start(tuple));
        let mut ways: Vec<(Tuple, Option<usize>)> = starts.map(|tuple| (tuple, None)).collect();
        let mut known: FxHashSet<Tuple> = ways.iter().map(|(tuple, _)| tuple.clone()).collect();
        let mut last = 0;
        while last < ways.len() && promised(rule, &ways[last].0) {
            let tuple = ways[last].0.clone();
            steps.each(&tuple, None, &mut |next| {
                let is_new = is_within(&next, self.window) || !promised(rule, &next);
                if is_new && known.insert(next.clone()) {
                    ways.push((next, Some(last)));
                }
            })?;
            last += 1;
        }
        let before = |&place: &usize| ways[place].1;
        let places = iter::successors(ways.get(last).map(|_| last), before);
        let mut way: Vec<String> = places.map(|place| words(rule, &ways[place].0)).collect();
        way.reverse();
        Ok(way)
    }

    fn within(rule: &dyn NumberedRule, window: i16) -> Result<Self, MethodError> {
        let is_fine = rule.reach().1 == Far::Fine;
        let all = tuples(rule, window)?;
        let is_near = |tuple: &[Robot<u32>]| is_within(tuple, window);
        let mut kept: FxHashSet<Tuple> = all.iter().filter(|tuple| promised(rule, tuple)).cloned().collect();
        let (places, mut cases) = ((all.len(), kept.len()), 0);
        let starts: Vec<&Tuple> = all.iter().filter(|tuple| rule.may_start(tuple)).collect();
        if starts.is_empty() && !is_fine {
            return Err(MethodError::new("no robots may start: the promise would be about nothing"));
        }
        if let Some(start) = starts.iter().find(|&&start| !kept.contains(start)) {
            return Err(MethodError::new(format_args!(
                "robots that start so break the promise: {}",
                words(rule, start)
            )));
        }
        // Each tuple is looked at once more when one to which it leads is gone.
        let mut before: FxHashMap<Tuple, Vec<Tuple>> = FxHashMap::default();
        let mut gone: Vec<Tuple> = Vec::new();
        let making = watchdog::Steps::begin();
        let steps = Steps::of(rule)?;
        for tuple in all.iter().filter(|tuple| kept.contains(*tuple)) {
            making.next();
            let mut is_gone = false;
            cases += steps.each(tuple, None, &mut |next| {
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
            for tuple in tuples(rule, window + AFAR)?.iter().filter(|tuple| !is_near(tuple)) {
                making.next();
                cases += steps.each(tuple, Some(window), &mut |next| {
                    is_left |= is_near(&next) && !kept.contains(&next);
                })?;
            }
        }
        let mut kept: Vec<Tuple> = kept.into_iter().collect();
        kept.sort_unstable();
        Ok(Self { window, places, kept, cases, is_left })
    }
}

impl fmt::Display for Invariant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { window, places: (all, safe), kept, .. } = self;
        let far = match window {
            0 => "in one cell".to_owned(),
            1 => "at most 1 cell apart in columns and rows".to_owned(),
            _ => format!("at most {window} cells apart in columns and rows"),
        };
        match kept.len() {
            // Where no place keeps it, none is ever entered: "0 of 1" would read as if the promise were broken.
            0 if *safe == 0 && self.holds() => {
                let (which, breaks) =
                    if *all == 1 { ("the only place", "breaks") } else { ("any of the places", "break") };
                write!(f, "the promise is an invariant, as nobody comes to {which} that {breaks} it, {far}")
            }
            kept if kept == *safe => {
                write!(f, "the promise is an invariant: {safe} of {all} places keep it, {far}")
            }
            kept => write!(f, "invariant: {kept} of the {safe} places that keep the promise, of {all} {far}"),
        }
    }
}

/// Where robots are, in words: their cells, and their states if there are several.
pub(super) fn words(rule: &dyn NumberedRule, tuple: &[Robot<u32>]) -> String {
    let word = |robot: &Robot<u32>| match rule.state_words(robot.state).as_str() {
        "()" => format!("{}", robot.at),
        state => format!("{} {state}", robot.at),
    };
    tuple.iter().map(word).collect::<Vec<_>>().join(" | ")
}

/// Whether robots keep the promise, however far they are from each other.
pub(super) fn promised(rule: &dyn NumberedRule, robots: &[Robot<u32>]) -> bool {
    let (reach, far) = rule.reach();
    if is_within(robots, reach) { rule.keeps(robots) } else { far == Far::Fine }
}

/// Whether all are at most so many columns and rows from the first one, which is in cell (0, 0).
pub(super) fn is_within(robots: &[Robot<u32>], window: i16) -> bool {
    robots.iter().all(|robot| robot.at.x.abs() <= window && robot.at.y.abs() <= window)
}

/// The robots as seen from the cell of the first one.
pub(super) fn relative(robots: &[Robot<u32>]) -> Tuple {
    let Some(&Robot { at: from, .. }) = robots.first() else { return Vec::new() };
    moved(robots, (-from.x, -from.y))
}

fn moved(robots: &[Robot<u32>], (columns, rows): (i16, i16)) -> Tuple {
    let by = |at: Cell| Cell::new(at.x + columns, at.y + rows);
    robots.iter().map(|&robot| Robot { at: by(robot.at), ..robot }).collect()
}

/// How many tuples of robots there are within a window, whatever colours they see; `None` if too many to count.
fn places(rule: &dyn NumberedRule, window: i16) -> Option<usize> {
    let of_first = rule.states().len() * usize::from(rule.colours());
    let side = 2 * window as usize + 1;
    let of_one = side.checked_mul(side)?.checked_mul(of_first)?;
    (1..rule.robots()).try_fold(of_first, |count, _| count.checked_mul(of_one))
}

/// Every tuple of robots within a window.
fn tuples(rule: &dyn NumberedRule, window: i16) -> Result<Vec<Tuple>, MethodError> {
    let (states, count) = (rule.states(), places(rule, window));
    if count.is_none_or(|count| count > MOST_PLACES) {
        let count = count.map_or_else(|| "too many".to_owned(), |count| count.to_string());
        let why = format!(
            "{count} relative places are more than {MOST_PLACES}: let the rule look less far, or give it fewer states"
        );
        return Err(MethodError::new(why));
    }
    let cells = |state| {
        (-window..=window)
            .flat_map(move |x| (-window..=window).map(move |y| Robot::new(Cell::new(x, y), state)))
            .flat_map(|robot| (0..rule.colours()).map(move |on| Robot { on, ..robot }))
    };
    let first = states.iter().flat_map(|&state| cells(state)).filter(|robot| robot.at == Cell::new(0, 0));
    let others: Vec<Robot<u32>> = states.iter().flat_map(|&state| cells(state)).collect();
    let all = combinations(iter::once(first.collect()).chain(iter::repeat_n(others, rule.robots() - 1)));
    Ok(all.filter(|tuple| agree(tuple.iter().map(|robot| (robot.at, robot.on)))).collect())
}

/// Where robots may be within a window: the first in cell (0, 0), each of so many others in any cell, column by column,
/// the second robot's cells changing first.
pub(super) fn offsets(window: i16, others: usize) -> Vec<Vec<Cell>> {
    let cells: Vec<Cell> =
        (-window..=window).flat_map(|x| (-window..=window).map(move |y| Cell::new(x, y))).collect();
    let from_first = |mut cells: Vec<Cell>| {
        cells.push(Cell::new(0, 0));
        cells.reverse();
        cells
    };
    combinations(iter::repeat_n(cells, others)).map(from_first).collect()
}

/// Whether each cell has one colour.
pub(super) fn agree(seen: impl Iterator<Item = (Cell, u8)>) -> bool {
    let seen: Vec<(Cell, u8)> = seen.collect();
    seen.iter().all(|one| seen.iter().all(|other| other.0 != one.0 || other.1 == one.1))
}

/// Places other than (0, 0), to see whether a rule is the same there: one far away, and the next ones, which a pattern
/// of a few columns or rows tells apart.
const ELSEWHERE: [(i16, i16); 3] = [(113, 59), (1, 0), (0, 1)];

/// The acts of robots by a rule.
struct Steps<'r> {
    rule: &'r dyn NumberedRule,
    acts: FxHashMap<u32, Vec<Act<u32, u32>>>,
}

impl<'r> Steps<'r> {
    /// # Errors
    /// [`MethodError`] if a state has no act, which would keep the others from theirs, or an act has no outcome, or
    /// only such as a wall forbids, or one in no state of the rule.
    fn of(rule: &'r dyn NumberedRule) -> Result<Self, MethodError> {
        let acts: FxHashMap<_, Vec<_>> =
            rule.states().into_iter().map(|state| (state, rule.acts(state))).collect();
        let idle = rule.states().into_iter().find(|state| acts[state].is_empty());
        if let Some(idle) = idle {
            let idle = rule.state_words(idle);
            let why =
                format_args!("a robot in state {idle} has no act: name one by which it stays in its cell");
            return Err(MethodError::new(why));
        }
        for (state, act) in acts.iter().flat_map(|(state, acts)| acts.iter().map(move |act| (state, act))) {
            let what = || format!("{} in state {}", rule.act_words(act.act), rule.state_words(*state));
            MethodError::unless(
                !act.ends.is_empty(),
                format_args!("{} has no outcome: name at least one, or leave the act out", what()),
            )?;
            if let Some((_, next)) = act.ends.iter().find(|(_, next)| !acts.contains_key(next)) {
                let next = rule.state_words(*next);
                return Err(MethodError::new(format_args!("{next} is none of the states of the rule")));
            }
            let may_stay = act.step == Step::Stay || act.ends.iter().any(|&(goes, _)| !goes);
            MethodError::unless(
                may_stay || act.needs_open && !rule.may_fail() || rule.is_sure(act.act),
                format_args!(
                    "{} crosses a side that may be a wall: name an outcome in which the robot stays, or say that \
                     the act is_sure",
                    what()
                ),
            )?;
        }
        Ok(Self { rule, acts })
    }

    /// Visits every tuple to which one step of a tuple may lead, as seen from its first robot then, and returns how
    /// many there are; within a window those alone that may be within it.
    fn each(
        &self,
        tuple: &[Robot<u32>],
        window: Option<i16>,
        visit: &mut dyn FnMut(Tuple),
    ) -> Result<u64, MethodError> {
        let mut cases = 0;
        for picked in combinations(tuple.iter().map(|robot| self.acts[&robot.state].iter().collect())) {
            let is_far = window.is_some_and(|window| !come_near(tuple, &picked, window));
            // Colours multiply the cases.
            if is_far && self.rule.colours() > 1 {
                continue;
            }
            for aims in colours_of_goals(self.rule.colours(), tuple, &picked) {
                if !self.admits(tuple, &picked, &aims)? {
                    continue;
                }
                cases += picked.iter().map(|act| act.ends.len() as u64).product::<u64>();
                if is_far {
                    continue;
                }
                for ends in combinations(picked.iter().map(|act| act.ends.clone())) {
                    let acts = picked.iter().map(|act| act.step).zip(aims.iter().copied());
                    let after =
                        tuple.iter().zip(acts).zip(ends).map(|((robot, act), end)| robot.after(act, end));
                    visit(relative(&after.collect::<Vec<_>>()));
                }
            }
        }
        Ok(cases)
    }

    /// Whether the rule admits these acts of a tuple.
    fn admits(
        &self,
        tuple: &[Robot<u32>],
        picked: &[&Act<u32, u32>],
        aims: &[u8],
    ) -> Result<bool, MethodError> {
        let plan = |robots: &[Robot<u32>]| -> Vec<_> {
            let acts = picked.iter().zip(aims);
            robots.iter().zip(acts).map(|(robot, (act, &aims))| robot.plans(act, aims)).collect()
        };
        let plans = plan(tuple);
        let is_admitted = self.rule.admits(&plans);
        let differs = |&place: &(i16, i16)| self.rule.admits(&plan(&moved(tuple, place))) != is_admitted;
        let Some((columns, rows)) = ELSEWHERE.into_iter().find(differs) else { return Ok(is_admitted) };
        let word = |plan: &Plan<u32, u32>| format!("{} in {}", self.rule.act_words(plan.act), plan.robot.at);
        let words: Vec<String> = plans.iter().map(word).collect();
        let why = format!(
            "the rule is not the same everywhere: it answers {} in another way {} and {} away",
            words.join(", "),
            counted(columns, "column"),
            counted(rows, "row")
        );
        Err(MethodError::new(why))
    }
}

/// Whether robots that do this may be within a window then.
fn come_near(tuple: &[Robot<u32>], picked: &[&Act<u32, u32>], window: i16) -> bool {
    let ends = |robot: usize| {
        let act = picked[robot];
        act.ends.iter().map(move |&end| tuple[robot].after((act.step, 0), end).at)
    };
    let is_near =
        |one: Cell, other: Cell| (one.x - other.x).abs() <= window && (one.y - other.y).abs() <= window;
    (1..tuple.len()).all(|robot| ends(robot).any(|end| ends(0).any(|first| is_near(first, end))))
}

/// Which colours the cells may have to which these acts lead.
fn colours_of_goals(colours: u8, tuple: &[Robot<u32>], picked: &[&Act<u32, u32>]) -> Vec<Vec<u8>> {
    if colours == 1 {
        return vec![vec![0; tuple.len()]];
    }
    let all = combinations(tuple.iter().zip(picked).map(|(robot, act)| match act.step {
        Step::Stay => vec![robot.on],
        Step::Cross(_) => (0..colours).collect(),
    }));
    let may_be = |aims: &Vec<u8>| {
        let goals =
            tuple.iter().zip(picked).zip(aims).map(|((robot, act), &aims)| (robot.at.after(act.step), aims));
        agree(goals.chain(tuple.iter().map(|robot| (robot.at, robot.on))))
    };
    all.filter(may_be).collect()
}
