//! Numbers, cells and lists as Python gives them. What is out of bounds is refused by its name and its bound, before
//! anything is allocated for it.

use std::fmt::Display;
use std::ops::RangeInclusive;

use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PyString};
use tautline_kernel::ground::Cell;

use crate::diagnostic::{Kind, error, shown};

/// The most entries of a list, and the most runs of a sweep.
pub(crate) const MAX_ENTRIES: usize = 1 << 24;

/// A whole number, in place of one that 128 bits do not hold the nearest one that they do.
#[derive(Clone, Copy)]
pub(crate) struct Int(pub(crate) i128);

impl<'py> FromPyObject<'_, 'py> for Int {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        match given.extract() {
            Err(error) if is_overflow(given.py(), &error) => {
                Ok(Self(if given.lt(0)? { i128::MIN } else { i128::MAX }))
            }
            number => number.map(Self),
        }
    }
}

impl Int {
    /// The number, if it is within these bounds.
    pub(crate) fn within<T>(self, py: Python<'_>, name: &str, bounds: RangeInclusive<T>) -> PyResult<T>
    where
        T: TryFrom<i128> + PartialOrd + Display,
    {
        let Self(given) = self;
        T::try_from(given).ok().filter(|number| bounds.contains(number)).ok_or_else(|| {
            let (least, most) = bounds.into_inner();
            let remedy = format_args!("give {name} a whole number from {least} to {most}");
            error(py, Kind::Input, format_args!("{name} is {given}"), remedy)
        })
    }

    /// The number if one was given and is within these bounds, none if none was given.
    pub(crate) fn optional<T>(
        given: Option<Self>,
        py: Python<'_>,
        name: &str,
        bounds: RangeInclusive<T>,
    ) -> PyResult<Option<T>>
    where
        T: TryFrom<i128> + PartialOrd + Display,
    {
        given.map(|given| given.within(py, name, bounds)).transpose()
    }
}

/// An [`Int`] that has a default, which is to be a literal for Python's help to show it.
pub(crate) fn whole(given: &Bound<'_, PyAny>) -> PyResult<i128> {
    given.extract().map(|Int(number)| number)
}

/// An [`Int`] or none, as of [`whole`].
pub(crate) fn whole_or_none(given: &Bound<'_, PyAny>) -> PyResult<Option<i128>> {
    given.extract().map(|given: Option<Int>| given.map(|Int(number)| number))
}

/// The cell of a column and a row.
pub(crate) struct At(pub(crate) Cell);

impl<'py> FromPyObject<'_, 'py> for At {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        match given.extract() {
            Err(raised) if is_overflow(given.py(), &raised) => {
                let remedy = format_args!("give a column and a row from {} to {}", i16::MIN, i16::MAX);
                Err(error(given.py(), Kind::Input, format_args!("{} is no cell", shown(&given)), remedy))
            }
            cell => cell.map(|(x, y)| Self(Cell::new(x, y))),
        }
    }
}

/// A list that is not too long.
pub(crate) struct List<T>(pub(crate) Vec<T>);

impl<'py, T: FromPyObjectOwned<'py>> FromPyObject<'_, 'py> for List<T> {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let py = given.py();
        if given.is_instance_of::<PyString>() {
            return Err(PyTypeError::new_err("a string is no list"));
        }
        match given.len() {
            Err(other) if !is_overflow(py, &other) => Err(other),
            Ok(0..=MAX_ENTRIES) => entries(&given.try_iter()?).map(Self),
            Ok(_) | Err(_) => Err(too_many(py, "a list", "entries")),
        }
    }
}

/// The entries of an iterator, if they are not too many; Ctrl-C ends it.
pub(crate) fn entries<'py, T: FromPyObjectOwned<'py>>(all: &Bound<'py, PyIterator>) -> PyResult<Vec<T>> {
    let mut read = Vec::new();
    for entry in all {
        if read.len() == MAX_ENTRIES {
            return Err(too_many(all.py(), "a list", "entries"));
        }
        if read.len().is_multiple_of(1 << 16) {
            all.py().check_signals()?;
        }
        read.push(entry?.extract().map_err(Into::into)?);
    }
    Ok(read)
}

/// The exception of more than [`MAX_ENTRIES`] of something.
pub(crate) fn too_many(py: Python<'_>, name: &str, of: &str) -> PyErr {
    let what = format_args!("{name} of more than {MAX_ENTRIES} {of}");
    error(py, Kind::Input, what, format_args!("give it fewer {of}"))
}

fn is_overflow(py: Python<'_>, error: &PyErr) -> bool {
    error.is_instance_of::<PyOverflowError>(py)
}
