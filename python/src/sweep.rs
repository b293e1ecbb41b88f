//! Many runs at once, as a table that pandas, polars, DuckDB and pyarrow read by Arrow's C stream interface.

use std::collections::BTreeMap;
use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{
    ArrayRef, RecordBatch, RecordBatchIterator, StringArray, UInt16Array, UInt32Array, UInt64Array,
};
use arrow_schema::ArrowError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyList};
use rayon::prelude::*;
use tautline_grids::layout;
use tautline_io::diagnostic::Halt;
use tautline_sim::explore::{
    ExplorationRequest, Limits, Milestone, Profile, Report, RuleId, Scheme, explore,
};

use crate::arguments::{Int, List, MAX_ENTRIES, too_many};
use crate::diagnostic::halted;
use crate::explore::{limits, rule, scheme};
use crate::run::stopped;
use crate::wait::wait_or_leave;

/// A job: one run with its options.
struct Job<'a> {
    layout: &'a str,
    rule: RuleId,
    robots: Option<u64>,
    seed: u64,
}

/// A table of runs: a row for each, in the order of layouts, rules, robots and seeds.
#[pyclass(frozen, module = "pytautline")]
pub(crate) struct Sweep {
    batch: RecordBatch,
}

/// Explores each layout by each rule with each number of robots and each seed, on all processors. The rows do not
/// depend on how many there are.
#[pyfunction]
#[pyo3(signature = (
    layouts, scheme="chain", *, rules=None, robots=None, seeds=List(vec![Int(0)]), max_moves=None, until=None
))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn sweep(
    py: Python<'_>,
    layouts: List<String>,
    scheme: &str,
    rules: Option<List<String>>,
    robots: Option<List<Int>>,
    seeds: List<Int>,
    max_moves: Option<Int>,
    until: Option<Int>,
) -> PyResult<Sweep> {
    let scheme = self::scheme(py, scheme)?;
    let rules = rules.map_or_else(|| vec![None], |List(rules)| rules.into_iter().map(Some).collect());
    let rules = rules.iter().map(|name| rule(py, scheme, name.as_deref()));
    let rules = rules.collect::<PyResult<Vec<RuleId>>>()?;
    let limits = limits(py, until, max_moves)?;
    let robots = robots.map_or_else(|| vec![None], |List(robots)| robots.into_iter().map(Some).collect());
    let robots = robots.into_iter().map(|robots| crate::explore::robots(py, scheme, robots));
    let robots = robots.collect::<PyResult<Vec<_>>>()?;
    let List(layouts) = layouts;
    let seeds = seeds.0.into_iter().map(|seed| seed.within(py, "a seed", 0..=u64::MAX));
    let seeds = seeds.collect::<PyResult<Vec<_>>>()?;
    let mut lengths = [layouts.len(), rules.len(), robots.len(), seeds.len()].into_iter();
    if lengths.try_fold(1, usize::checked_mul).is_none_or(|runs| runs > MAX_ENTRIES) {
        return Err(too_many(py, "a sweep", "runs"));
    }
    let batch = wait_or_leave(py, move |is_stopped| {
        let mut jobs = Vec::new();
        for layout in &layouts {
            for &rule in &rules {
                for &robots in &robots {
                    jobs.extend(seeds.iter().map(|&seed| Job { layout, rule, robots, seed }));
                }
            }
        }
        let one = |job: &Job<'_>| made(scheme, job, limits, &|| stopped(is_stopped));
        let reports = jobs.par_iter().map(one).collect::<Result<Vec<(u16, Report)>, Halt>>()?;
        Ok(table(&scheme, &jobs, &reports))
    })?;
    let batch = batch.map_err(|halt| halted(py, &halt))?.map_err(broken)?;
    Ok(Sweep { batch })
}

fn broken(error: ArrowError) -> PyErr {
    PyRuntimeError::new_err(format!("a bug of tautline: {error}"))
}

fn made(
    scheme: Scheme,
    job: &Job<'_>,
    limits: Limits,
    watch: &dyn Fn() -> Result<(), Halt>,
) -> Result<(u16, Report), Halt> {
    let layout = layout::load(job.layout, job.seed, None)?;
    let asked = ExplorationRequest {
        robots: job.robots,
        seed: job.seed,
        limits,
        ..ExplorationRequest::new(scheme, job.rule)
    };
    let setup = asked.setup(layout)?;
    Ok((setup.robots, explore(&setup, &mut |_| watch())?))
}

fn table(scheme: &Profile, jobs: &[Job<'_>], reports: &[(u16, Report)]) -> Result<RecordBatch, ArrowError> {
    let words = |word: &dyn Fn(&Job<'_>) -> String| -> ArrayRef {
        Arc::new(jobs.iter().map(|job| Some(word(job))).collect::<StringArray>())
    };
    let numbers = |number: &dyn Fn(&Report) -> u32| -> ArrayRef {
        Arc::new(reports.iter().map(|(_, report)| number(report)).collect::<UInt32Array>())
    };
    let reached = |milestone| -> ArrayRef {
        Arc::new(reports.iter().map(|(_, report)| report.reached(milestone)).collect::<UInt32Array>())
    };
    let told = |word: &dyn Fn(&Report) -> Option<String>| -> ArrayRef {
        Arc::new(reports.iter().map(|(_, report)| word(report)).collect::<StringArray>())
    };
    let robots: UInt16Array = reports.iter().map(|&(robots, _)| Some(robots)).collect();
    let seeds: UInt64Array = jobs.iter().map(|job| Some(job.seed)).collect();
    let stopped = |report: &Report| Some(serde_json::to_value(report.stopped).ok()?.as_str()?.to_owned());
    let first = |report: &Report| Some(report.violations.first()?.clause.to_string());
    RecordBatch::try_from_iter_with_nullable([
        ("layout", words(&|job| job.layout.to_owned()), false),
        ("scheme", words(&|_| scheme.name.to_owned()), false),
        ("rule", words(&|job| job.rule.to_string()), false),
        ("robots", Arc::new(robots) as ArrayRef, false),
        ("seed", Arc::new(seeds) as ArrayRef, false),
        ("steps", numbers(&|report| report.steps), false),
        ("explored", numbers(&|report| report.explored), false),
        ("cells", numbers(&|report| report.cells), false),
        ("moves_50", reached(Milestone::Half), true),
        ("moves_75", reached(Milestone::ThreeQuarters), true),
        ("moves_100", reached(Milestone::Whole), true),
        ("stopped", told(&stopped), true),
        ("violations", numbers(&|report| report.violations.len() as u32), false),
        ("first_violation", told(&first), true),
    ])
}

#[pymethods]
impl Sweep {
    /// The table as a stream of Arrow's C interface: one batch.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // Who asks for other types is to cast what comes: the interface allows it.
        drop(requested_schema);
        let (batch, schema) = (self.batch.clone(), self.batch.schema());
        let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(batch)], schema)));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.batch.schema().fields().iter().map(|field| field.name().clone()).collect()
    }

    /// The columns by their names, as lists.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<BTreeMap<String, Bound<'py, PyList>>> {
        let column = |(name, array): (String, &ArrayRef)| Ok((name, list(py, array)?));
        self.columns().into_iter().zip(self.batch.columns()).map(column).collect()
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    fn __repr__(&self) -> String {
        format!("<pytautline.Sweep of {} runs: {}>", self.batch.num_rows(), self.columns().join(", "))
    }
}

/// A column as a list.
fn list<'py>(py: Python<'py>, array: &ArrayRef) -> PyResult<Bound<'py, PyList>> {
    let column = array.as_any();
    if let Some(words) = column.downcast_ref::<StringArray>() {
        PyList::new(py, words.iter().collect::<Vec<_>>())
    } else if let Some(numbers) = column.downcast_ref::<UInt16Array>() {
        PyList::new(py, numbers.iter().collect::<Vec<_>>())
    } else if let Some(numbers) = column.downcast_ref::<UInt32Array>() {
        PyList::new(py, numbers.iter().collect::<Vec<_>>())
    } else if let Some(numbers) = column.downcast_ref::<UInt64Array>() {
        PyList::new(py, numbers.iter().collect::<Vec<_>>())
    } else {
        Err(PyRuntimeError::new_err("a bug of tautline: a column of another type"))
    }
}
