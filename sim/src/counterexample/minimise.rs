//! From a run that breaks a clause to a minimal one: a run of the same scheme and rule that breaks the same clause, in
//! a layout of which nothing can go. Taken alone, without any one of its robots, columns, rows, blocked cells and
//! walls, the clause is not broken.
//!
//! The parts that go:
//! - *A robot*: the team has one less. A chain then has a shorter range, too.
//! - *A column*: its cells, blocked or free, and the columns on its two sides become neighbours. Between two cells
//!   that were on its two sides stands a wall if one stood on either side of the cell that was between them. The
//!   rim closes up to the first or last column that is left. A base in the column that goes is put into the next cell
//!   east of it or, if there is none, or it is blocked, or the clause is not broken from there, into the next one
//!   west of it. A layout keeps at least one column.
//! - *A row*: likewise, south for east and north for west.
//! - *A blocked cell*: it is free then. Walls beside it stay.
//! - *A wall* inside the rim.
//! - *A missed sensor* that is named by its number. Those that chance has drawn are named once nothing else can go, and
//!   then no other one is missed; if that does not break the clause, as where agents go on since one may still be
//!   missed, they stay left to chance.
//!
//! A start of a robot's own goes with the column or row in which it is, as the base does, and with its robot.
//!
//! A run that a search has made by its choices is not shrunk, since choices fit one layout: smaller teams and layouts
//! are searched instead, the smallest first.
//!
//! Whatever a run never met goes all at once, before anything else and after everything that goes: the cells out of the
//! team's reach, and the walls and blocked cells that no robot bumped into. Where robots see what they do not bump
//! into, as those of KIT do, another run comes of it: what is left is run again, and stays whole if it does not break
//! the clause. Then the robots are tried, the smallest team first, and columns, rows, blocked cells and walls in this
//! order: all, then in chunks half as large each time (Zeller and Hildebrandt 2002, *Simplifying and Isolating
//! Failure-Inducing Input*), then single ones; all this until nothing goes any more. There is no chance in it.

mod chosen;
mod minimal;
mod shrink;

use tautline_io::diagnostic::Halt;

use self::minimal::first_violation;
pub use self::minimal::{Failure, Minimal, Refusal};
pub use self::shrink::{Breaks, BrokenClause, Case, Extent, Obstacles, Progress, Shrinkage, shrink};
use crate::explore::{ClauseId, Limits, OnViolation, Setup, TeamMove, Violation, run, team};
use tautline_grids::chance::Probability;
use tautline_grids::layout::Layout;

/// The minimal run that the run of `setup` shrinks to; what stays broken is `asked`, or else what the run breaks first.
/// `watch` is called after every team move of every run, and may end the work for good.
///
/// # Errors
/// [`Failure`] if the run does not break that, if the setup does not fit its scheme, or if `watch` ended the work.
pub fn minimise(
    setup: &Setup,
    asked: Option<ClauseId>,
    watch: &mut dyn FnMut(Progress) -> Result<(), Halt>,
) -> Result<Minimal, Failure> {
    if !setup.choices.is_empty() {
        return chosen::minimise(setup, asked, watch);
    }
    // Starts that nobody has given are those of the smaller case.
    let starts =
        |robots, layout: &Layout, base| setup.scheme.default_starts(setup.rule, layout, base, robots);
    let is_default = setup.starts == starts(setup.robots, &setup.layout, setup.base);
    let mut before = Extent::new(setup.robots, &setup.layout, setup.missed.len(), 0);
    let violation = match (setup.limits.violation, asked) {
        (OnViolation::GoOn, Some(asked)) => OnViolation::StopAt(asked),
        (OnViolation::GoOn, None) => OnViolation::Stop,
        (stop @ (OnViolation::Stop | OnViolation::StopAt(_)), _) => stop,
    };
    let first = Setup { limits: Limits { violation, ..setup.limits }, ..setup.clone() };
    let mut played = team(&first).map_err(Halt::from)?;
    let mut watch_first = |_: &TeamMove<'_>| watch(Progress { runs: 0, smallest: before });
    let report = run(&mut *played, &first.layout, first.limits, &mut watch_first)?;
    let Violation { clause, step } = first_violation(&report, asked)?;
    let limits = Limits::stopping_at(Some(clause));
    (before.steps, before.missed) = (step, played.misses().len());
    let Setup { robots, layout, base, starts: own, missed, .. } = first.clone();
    let case = Case { robots, layout, base, starts: own.filter(|_| !is_default).unwrap_or_default(), missed };
    let made = |Case { robots, layout, base, starts: own, missed }: Case| {
        let starts = if is_default { starts(robots, &layout, base) } else { Some(own) };
        Setup { robots, layout, base, starts, missed, limits, ..first.clone() }
    };
    let least = *setup.scheme.robots.start() as u16;
    let shrunk = shrink(case, step, least, &mut |case, progress| {
        let mut edges = Vec::new();
        let smaller = made(case.clone());
        // What is no run breaks nothing.
        let Ok(mut team) = team(&smaller) else { return Ok(None) };
        let report = run(&mut *team, &smaller.layout, smaller.limits, &mut |made: &TeamMove<'_>| {
            edges.extend(made.frame.bumps());
            watch(progress)
        })?;
        let met = Some(Obstacles { area: report.chart.area(), edges });
        let is_broken = report.violations.iter().any(|broken| broken.clause == clause);
        Ok(is_broken.then_some(BrokenClause { steps: report.steps, met }))
    })?;
    let Shrinkage { case, extent: after, runs } = shrunk;
    let minimal = Minimal { setup: made(case), clause, before, after, runs };
    if setup.miss.is_never() {
        return Ok(minimal);
    }
    // Sensors that chance has missed become named ones, which are parts, too.
    let mut drawn = team(&minimal.setup).map_err(Halt::from)?;
    run(&mut *drawn, &minimal.setup.layout, limits, &mut |_| watch(Progress { runs, smallest: after }))?;
    let (miss, missed) = (Probability::NEVER, drawn.misses().to_vec());
    match minimise(&Setup { miss, missed, ..minimal.setup.clone() }, Some(clause), watch) {
        Ok(named) => Ok(Minimal { before, runs: runs + named.runs, ..named }),
        Err(Failure::Refused(_)) => Ok(minimal),
        Err(halted) => Err(halted),
    }
}
