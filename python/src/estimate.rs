//! Means and shares with the intervals that the program prints.

use pyo3::prelude::*;
use tautline_field::stats;

use crate::arguments::{Int, List, whole};
use crate::diagnostic::{Kind, error};

/// The most decimals, as many as every number has.
const MAX_DECIMALS: usize = 17;

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
    #[new]
    fn new(py: Python<'_>, count: Int, mean: f64, interval: Option<(f64, f64)>) -> PyResult<Self> {
        Ok(Self { count: count.within(py, "count", 0..=u32::MAX)?, mean, interval })
    }

    const fn __getnewargs__(&self) -> (u32, f64, Option<(f64, f64)>) {
        (self.count, self.mean, self.interval)
    }

    /// For people, with so many decimals.
    #[pyo3(signature = (decimals=2))]
    fn text(&self, py: Python<'_>, #[pyo3(from_py_with = whole)] decimals: i128) -> PyResult<String> {
        Ok(self.stats().text(Int(decimals).within(py, "decimals", 0..=MAX_DECIMALS)?))
    }

    fn __str__(&self) -> String {
        self.stats().text(2)
    }

    fn __repr__(&self) -> String {
        format!("<pytautline.Estimate {} of {}>", self.stats().text(4), self.count)
    }
}

fn made(py: Python<'_>, estimate: Option<stats::Estimate>, what: &str, remedy: &str) -> PyResult<Estimate> {
    let estimate = estimate.ok_or_else(|| error(py, Kind::Input, what, remedy))?;
    let interval = estimate.interval.map(|[low, high]| (low, high));
    let is_finite = |(low, high): (f64, f64)| low.is_finite() && high.is_finite();
    if !estimate.mean.is_finite() || !interval.is_none_or(is_finite) {
        let remedy = "give finite numbers, none so large that their squares have no finite sum";
        return Err(error(py, Kind::Input, "the mean or its interval is not finite", remedy));
    }
    Ok(Estimate { count: estimate.count, mean: estimate.mean, interval })
}

/// The mean of values, with Student's t.
#[pyfunction]
pub(crate) fn estimate(py: Python<'_>, values: List<f64>) -> PyResult<Estimate> {
    made(py, stats::Estimate::of_values(&values.0), "there are no values", "give at least one")
}

/// How many times the sum of the second values the sum of the first is.
#[pyfunction]
pub(crate) fn estimate_ratio(py: Python<'_>, pairs: List<(f64, f64)>) -> PyResult<Estimate> {
    let List(pairs) = pairs;
    let under: f64 = pairs.iter().map(|pair| pair.1).sum();
    let what = format!("the second values of {} pairs sum up to {under}", pairs.len());
    made(py, stats::Estimate::of_ratio(&pairs), &what, "give pairs whose second values sum up to more than 0")
}

/// How many of `count` are hits, with Wilson's interval.
#[pyfunction]
pub(crate) fn estimate_share(py: Python<'_>, hits: Int, count: Int) -> PyResult<Estimate> {
    let [hits, count] = [hits.within(py, "hits", 0..=u32::MAX)?, count.within(py, "count", 0..=u32::MAX)?];
    let remedy = "give a count above 0, and no more hits than that";
    made(py, stats::Estimate::share(hits, count), &format!("{hits} hits of {count} are no share"), remedy)
}
