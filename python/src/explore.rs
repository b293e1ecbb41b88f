//! One run of a rule of the catalogue.

use std::collections::BTreeMap;
use std::num::NonZeroU32;
use std::path::PathBuf;

use pyo3::prelude::*;
use tautline_grids::chance::Probability;
use tautline_io::named_values::NamedValues;
use tautline_kernel::chain;
use tautline_papers::rivals::CATALOGUE;
use tautline_sim::explore::{
    ExplorationRequest, Limits, Milestone, OnViolation, Play, Profile, RuleId, Scheme,
};
use tautline_sim::options::Options;

use crate::arguments::{At, Int, List, whole};
use crate::diagnostic::{Kind, error};
use crate::layout::LayoutArgument;
use crate::run::{Run, RunSource, stopped};

/// The scheme of this name.
pub(crate) fn scheme(py: Python<'_>, name: &str) -> PyResult<Scheme> {
    CATALOGUE.scheme(name).ok_or_else(|| {
        let remedy = format_args!("take one of {}", CATALOGUE.names(|_| true).join(", "));
        error(py, Kind::Input, format_args!("there is no scheme {name:?}"), remedy)
    })
}

/// The rule of this name, or the one that the program takes where nobody names one.
pub(crate) fn rule(py: Python<'_>, scheme: Scheme, name: Option<&str>) -> PyResult<RuleId> {
    let Some(name) = name else { return Ok(scheme.default_rule()) };
    let known = scheme.rules.iter().find(|rule| rule.name.as_str() == name);
    known.map(|rule| rule.name).ok_or_else(|| {
        let what = format!("{} has no rule {name:?}", scheme.name);
        error(py, Kind::Input, what, scheme.which_rule())
    })
}

/// A number of robots. Of a small one its scheme says in its own words that it is none of a team.
pub(crate) fn robots(py: Python<'_>, scheme: Scheme, robots: Option<Int>) -> PyResult<Option<u64>> {
    if let Some(Int(robots @ 0..=0xffff)) = robots {
        return Ok(Some(robots as u64));
    }
    let (&least, &most) = (scheme.robots.start(), scheme.robots.end());
    Int::optional(robots, py, "robots", least as u64..=most as u64)
}

fn probability(py: Python<'_>, name: &str, value: Option<f64>) -> PyResult<Option<Probability>> {
    let read = |value| {
        Probability::new(value).ok_or_else(|| {
            let remedy = format_args!("give {name} a number from 0 to 1");
            error(py, Kind::Input, format_args!("{name} is {value}"), remedy)
        })
    };
    value.map(read).transpose()
}

/// When a run is stopped.
pub(crate) fn limits(py: Python<'_>, until: Option<Int>, max_moves: Option<Int>) -> PyResult<Limits> {
    let read = |Int(percent)| {
        <Milestone as NamedValues>::of(&percent.to_string()).ok_or_else(|| {
            error(py, Kind::Input, format_args!("until is {percent}"), "give until 50, 75 or 100")
        })
    };
    let max_moves = Int::optional(max_moves, py, "max_moves", 1..=u32::MAX)?.and_then(NonZeroU32::new);
    Ok(Limits { until: until.map(read).transpose()?, max_moves, violation: OnViolation::GoOn })
}

/// Explores a layout once, and checks every team move: see `tautline explore --help`.
#[pyfunction]
#[pyo3(signature = (
    layout, scheme="chain", *, rule=None, robots=None, seed=0, base=None, starts=List(Vec::new()), miss=None,
    message_range=None, loss=None, noise_db=None, threshold=None, max_moves=None, until=None
))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn explore(
    py: Python<'_>,
    layout: LayoutArgument<'_>,
    scheme: &str,
    rule: Option<&str>,
    robots: Option<Int>,
    #[pyo3(from_py_with = whole)] seed: i128,
    base: Option<At>,
    starts: List<At>,
    miss: Option<f64>,
    message_range: Option<Int>,
    loss: Option<f64>,
    noise_db: Option<f64>,
    threshold: Option<f64>,
    max_moves: Option<Int>,
    until: Option<Int>,
) -> PyResult<Run> {
    let scheme = self::scheme(py, scheme)?;
    let rule = self::rule(py, scheme, rule)?;
    let usual = Options::USUAL;
    let options = Options {
        range_cells: Int::optional(message_range, py, "message_range", 0..=u16::MAX)?,
        loss: probability(py, "loss", loss)?.unwrap_or(usual.loss),
        noise_db: noise_db.unwrap_or(usual.noise_db),
        threshold: threshold.unwrap_or(usual.threshold),
        ..usual
    };
    let seed = Int(seed).within(py, "seed", 0..=u64::MAX)?;
    let asked = ExplorationRequest {
        robots: self::robots(py, scheme, robots)?,
        seed,
        base: base.map(|At(cell)| cell),
        starts: starts.0.into_iter().map(|At(cell)| cell).collect(),
        miss: probability(py, "miss", miss)?,
        options,
        limits: limits(py, until, max_moves)?,
        ..ExplorationRequest::new(scheme, rule)
    };
    let ((setup, report), name) = layout.load(py, seed, |ground, is_stopped| {
        let setup = asked.setup(ground)?;
        let report = setup.play(&mut |_| stopped(is_stopped))?;
        Ok((setup, report))
    })?;
    Ok(Run { made: RunSource::Known(Box::new(setup)), name, report, clause: None })
}

/// The run in a file, made again and compared line by line.
#[pyfunction]
pub(crate) fn replay(py: Python<'_>, path: PathBuf) -> PyResult<Run> {
    Run::read(py, &path)
}

/// By the names of all schemes, the names of their rules.
#[pyfunction]
pub(crate) fn schemes() -> BTreeMap<&'static str, Vec<&'static str>> {
    let rules = |scheme: &Profile| scheme.rules.iter().map(|rule| rule.name.as_str()).collect();
    CATALOGUE.schemes().map(|scheme| (scheme.name, rules(&scheme))).collect()
}

/// Whether two robots of the repaired chain are in contact: each in E_C of the other (CHAIN-1).
#[pyfunction]
pub(crate) fn in_contact(one: At, other: At) -> bool {
    chain::Rule::REPAIRED.keeps_contact(one.0, other.0)
}
