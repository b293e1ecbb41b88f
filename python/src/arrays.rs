//! Arrays in and out by Python's own `memoryview`, which NumPy reads and gives without a copy of ours, and without
//! being needed.

use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyBytes, PyMemoryView, PyTuple};

use crate::diagnostic::{Kind, error};

const WANTED: &str = "give an array of two dimensions, rows by columns, of booleans or of 8-bit numbers";

/// Rows of a caller's array: their number, their length, and whether each entry is not 0, row by row.
pub(crate) struct Rows {
    pub(crate) height: usize,
    pub(crate) width: usize,
    pub(crate) values: Vec<bool>,
}

/// The rows of an array of two dimensions.
pub(crate) fn rows(name: &str, array: &Bound<'_, PyAny>) -> PyResult<Rows> {
    let py = array.py();
    let wrong = |what: String| error(py, Kind::Input, format_args!("{name} {what}"), WANTED);
    let view = PyMemoryView::from(array).map_err(|_| {
        let class =
            array.get_type().name().map_or_else(|_| "something else".to_owned(), |name| name.to_string());
        wrong(format!("is no array, but {class}"))
    })?;
    let shape: Vec<usize> = view.getattr("shape")?.extract()?;
    let [height, width] = shape[..] else {
        return Err(wrong(format!("has {} dimensions", shape.len())));
    };
    let format: String = view.getattr("format")?.extract()?;
    if !matches!(format.as_str(), "?" | "B" | "b") {
        return Err(wrong(format!("has entries of the format {format:?}")));
    }
    let bytes = view.call_method0("tobytes")?;
    let values = bytes.cast::<PyBytes>()?.as_bytes().iter().map(|&byte| byte != 0).collect();
    Ok(Rows { height, width, values })
}

/// A view of `bytes` as an array of this shape, of entries of this format.
pub(crate) fn view<'py>(
    py: Python<'py>,
    bytes: &[u8],
    format: &str,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    shaped(PyBytes::new(py, bytes).as_any(), format, shape)
}

/// An array of its own, of this shape, of entries of this format, written without Python's lock.
pub(crate) fn filled<'py, const BYTES: usize>(
    py: Python<'py>,
    format: &str,
    shape: &[usize],
    entries: impl Iterator<Item = [u8; BYTES]> + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let bytes = PyByteArray::new_with(py, BYTES * shape.iter().product::<usize>(), |bytes| {
        let places = bytes.as_chunks_mut().0;
        py.detach(|| places.iter_mut().zip(entries).for_each(|(place, entry)| *place = entry));
        Ok(())
    })?;
    shaped(bytes.as_any(), format, shape)
}

fn shaped<'py>(bytes: &Bound<'py, PyAny>, format: &str, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let view = PyMemoryView::from(bytes)?;
    if shape.contains(&0) {
        return view.call_method1("cast", (format,));
    }
    view.call_method1("cast", (format, PyTuple::new(bytes.py(), shape)?))
}
