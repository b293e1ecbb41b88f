//! One team move, as a demand in Python sees it.

use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// One team move of a rule written in Python.
#[pyclass(name = "Moved", frozen, module = "pytautline", get_all)]
pub(crate) struct TeamMove {
    /// The state with which the rule was asked for this move.
    pub(crate) before: Py<PyAny>,
    /// The state that it answered.
    pub(crate) after: Py<PyAny>,
    /// Where the robots were.
    pub(crate) cells_before: Py<PyTuple>,
    /// Where they are now.
    pub(crate) cells: Py<PyTuple>,
    /// The steps that the robots tried: one letter of E, S, W, N or `.` for each.
    pub(crate) tried: String,
    /// Whether each robot met a wall.
    pub(crate) blocked: Py<PyTuple>,
}

#[pymethods]
impl TeamMove {
    fn __repr__(&self) -> String {
        format!("<pytautline.Moved {} from {} to {}>", self.tried, self.cells_before, self.cells)
    }
}
