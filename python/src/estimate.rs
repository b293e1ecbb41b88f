//! Means and shares with the intervals that the program prints.

use pyo3::prelude::*;
use tautline_field::stats;

use crate::diagnostic::{Kind, error};

/// A mean or a share, and where 95 % of such intervals have the true one.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct Estimate {
    /// How many values.
    count: u32,
    /// The mean, or the share.
    mean: f64,
    /// The ends of the interval, if there is one.
    interval: Option<(f64, f64)>,
}

impl Estimate {
    fn stats(&self) -> stats::Estimate {
        stats::Estimate {
            count: self.count,
            mean: self.mean,
            interval: self.interval.map(|(low, high)| [low, high]),
        }
    }
}

#[pymethods]
impl Estimate {
    /// For people, with so many decimals.
    #[pyo3(signature = (decimals=2))]
    fn text(&self, decimals: usize) -> String {
        self.stats().text(decimals)
    }

    fn __str__(&self) -> String {
        self.text(2)
    }

    fn __repr__(&self) -> String {
        format!("<pytautline.Estimate {} of {}>", self.text(4), self.count)
    }
}

fn made(py: Python<'_>, estimate: Option<stats::Estimate>, what: &str, remedy: &str) -> PyResult<Estimate> {
    let estimate = estimate.ok_or_else(|| error(py, Kind::Input, what, remedy))?;
    let interval = estimate.interval.map(|[low, high]| (low, high));
    Ok(Estimate { count: estimate.count, mean: estimate.mean, interval })
}

/// The mean of values, with Student's t.
#[pyfunction]
pub(crate) fn estimate(py: Python<'_>, values: Vec<f64>) -> PyResult<Estimate> {
    made(py, stats::Estimate::of_values(&values), "there are no values", "give at least one")
}

/// How many times the sum of the second values the sum of the first is.
#[pyfunction]
pub(crate) fn estimate_ratio(py: Python<'_>, pairs: Vec<(f64, f64)>) -> PyResult<Estimate> {
    made(py, stats::Estimate::of_ratio(&pairs), "there are no pairs", "give at least one")
}

/// How many of `count` are hits, with Wilson's interval.
#[pyfunction]
pub(crate) fn estimate_share(py: Python<'_>, hits: u32, count: u32) -> PyResult<Estimate> {
    let remedy = "give a count above 0, and no more hits than that";
    made(py, stats::Estimate::share(hits, count), &format!("{hits} hits of {count} are no share"), remedy)
}
