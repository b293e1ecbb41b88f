//! Layouts: loaded, generated, made of arrays, and given as such.

use std::hash::{Hash, Hasher};
use std::num::NonZeroU16;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use pyo3::PyTypeInfo;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyType};
use tautline_grids::layout::{self as layouts, Layout as Ground};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::svg::Panel;
use tautline_kernel::chain::MAX_ROBOTS;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_sim::draw::svg;
use tautline_sim::trace;

use crate::arguments::{At, Int, whole};
use crate::arrays::{Rows, rows, view};
use crate::diagnostic::{Kind, error, halted, raised};
use crate::wait::wait_or_leave;

/// A column and a row.
pub(crate) type Pair = (i16, i16);

/// The ground truth of a run: cells, walls between them, blocked cells.
#[pyclass(frozen, module = "pytautline", eq, hash)]
#[derive(Clone)]
pub(crate) struct Layout {
    pub(crate) ground: Ground,
    /// The name by which it was loaded.
    pub(crate) name: String,
}

/// Layouts are equal that have the same cells, walls, base and number of robots, wherever they come from.
impl PartialEq for Layout {
    fn eq(&self, other: &Self) -> bool {
        self.ground == other.ground
    }
}

impl Eq for Layout {}

impl Hash for Layout {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.ground.hash(state);
    }
}

/// The layout of an argument that is one, or that describes one.
#[derive(FromPyObject)]
pub(crate) enum LayoutArgument<'py> {
    /// A layout.
    Made(Bound<'py, Layout>),
    /// A file or a generator.
    Named(PathBuf),
}

impl LayoutArgument<'_> {
    /// The outcome of `then` for the layout, and the layout's name.
    pub(crate) fn load<T: Send + 'static>(
        self,
        py: Python<'_>,
        seed: u64,
        then: impl FnOnce(Ground, &AtomicBool) -> Result<T, Halt> + Send + 'static,
    ) -> PyResult<(T, String)> {
        let (name, made) = match self {
            Self::Made(layout) => (layout.get().name.clone(), Some(layout.get().ground.clone())),
            Self::Named(path) => (path.display().to_string(), None),
        };
        let description = name.clone();
        let made = wait_or_leave(py, move |is_stopped| {
            then(made.map_or_else(|| layouts::load(&description, seed, None), Ok)?, is_stopped)
        })?;
        Ok((made.map_err(|halt| halted(py, &halt))?, name))
    }
}

#[pymethods]
impl Layout {
    /// A file or a generator, as `tautline explore` takes it.
    #[staticmethod]
    #[pyo3(signature = (description, *, seed=0, image=None))]
    pub(crate) fn load(
        py: Python<'_>,
        description: PathBuf,
        #[pyo3(from_py_with = whole)] seed: i128,
        image: Option<PathBuf>,
    ) -> PyResult<Self> {
        let (name, seed) = (description.display().to_string(), Int(seed).within(py, "seed", 0..=u64::MAX)?);
        let load = move |_: &AtomicBool| {
            layouts::load(&name, seed, image.as_deref()).map(|ground| Self { ground, name })
        };
        wait_or_leave(py, load)?.map_err(|fault| raised(py, &fault))
    }

    /// A drawing of ours, which is called so.
    #[staticmethod]
    #[pyo3(signature = (drawing, *, name="drawing"))]
    fn parse(py: Python<'_>, drawing: &str, name: &str) -> PyResult<Self> {
        let read = drawing.parse::<Ground>();
        let fault = |misread: layouts::Misread| {
            let layouts::Misread { at, problem } = misread;
            raised(py, &Diagnostic::at(name, drawing, at, problem.what(), problem.remedy()))
        };
        Ok(Self { ground: read.map_err(fault)?, name: name.to_owned() })
    }

    /// Of arrays, rows by columns: which cells are blocked, and where a wall stands on the eastern and on the southern
    /// side of a cell.
    #[staticmethod]
    #[pyo3(signature = (blocked, *, east=None, south=None, base=None, robots=None))]
    fn from_arrays(
        py: Python<'_>,
        blocked: Bound<'_, PyAny>,
        east: Option<Bound<'_, PyAny>>,
        south: Option<Bound<'_, PyAny>>,
        base: Option<At>,
        robots: Option<Int>,
    ) -> PyResult<Self> {
        let Rows { height, width, values } = rows("blocked", &blocked)?;
        let fault = |problem: Diagnostic| raised(py, &problem);
        let mut ground = Ground::open(width as u64, height as u64).map_err(fault)?;
        for (cell, _) in ground.cells().zip(values).filter(|(_, is_blocked)| *is_blocked) {
            ground.block(cell);
        }
        for (name, side, array) in [("east", Side::East, east), ("south", Side::South, south)] {
            let Some(array) = array else { continue };
            let walls = rows(name, &array)?;
            if (walls.height, walls.width) != (height, width) {
                let what = format!(
                    "{name} has {} rows and {} columns, and blocked has {height} and {width}",
                    walls.height, walls.width
                );
                return Err(error(py, Kind::Input, what, "give all arrays the same shape"));
            }
            for (cell, _) in ground.cells().zip(walls.values).filter(|(_, is_wall)| *is_wall) {
                ground.build_wall(Edge::new(cell, side));
            }
        }
        if let Some(At(base)) = base {
            ground.place_base(base).map_err(fault)?;
        }
        let robots = Int::optional(robots, py, "robots", 1..=MAX_ROBOTS as u16)?;
        if let Some(robots) = robots.and_then(NonZeroU16::new) {
            ground.set_robots(robots).map_err(fault)?;
        }
        Ok(Self { ground, name: "arrays".to_owned() })
    }

    /// Columns.
    #[getter]
    fn width(&self) -> i16 {
        self.ground.width()
    }

    /// Rows.
    #[getter]
    fn height(&self) -> i16 {
        self.ground.height()
    }

    /// The base, if the layout names one.
    #[getter]
    fn base(&self) -> Option<Pair> {
        self.ground.base().map(|cell| (cell.x, cell.y))
    }

    /// How many robots it is meant for, if it says so.
    #[getter]
    fn robots(&self) -> Option<u16> {
        self.ground.robots()
    }

    /// How many cells are free.
    #[getter]
    fn free_cells(&self) -> usize {
        self.ground.free_cells()
    }

    /// Which cells are blocked, rows by columns.
    #[getter]
    fn blocked<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.plane(py, |cell| !self.ground.is_free(cell))
    }

    /// On the eastern side of which cells a wall stands, the rim left out.
    #[getter]
    fn east<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.walls(py, Side::East)
    }

    /// On the southern side of which cells a wall stands, the rim left out.
    #[getter]
    fn south<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.walls(py, Side::South)
    }

    /// The cell where a robot is that tries this side, one of E, S, W and N; none if it meets a wall or a blocked cell.
    fn beyond(&self, py: Python<'_>, cell: At, letter: char) -> PyResult<Option<Pair>> {
        let Some(Step::Cross(side)) = trace::step(letter) else {
            let remedy = "give one of E, S, W and N";
            return Err(error(py, Kind::Input, format_args!("{letter:?} is no side"), remedy));
        };
        let At(cell) = cell;
        let next = cell.beyond(side);
        Ok(self.ground.is_open(Edge::new(cell, side)).then_some((next.x, next.y)))
    }

    /// A picture.
    fn svg(&self) -> String {
        Panel::picture(&self.name, &[svg::layout(&self.ground)])
    }

    fn _repr_svg_(&self) -> String {
        self.svg()
    }

    fn __str__(&self) -> String {
        self.ground.to_string()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Rebuilt<'py>> {
        rebuilt::<Self>(py, &self.ground.to_string(), &self.name)
    }

    fn __repr__(&self) -> String {
        format!("<pytautline.Layout {} of {}x{} cells>", self.name, self.width(), self.height())
    }
}

/// How a copy is made, as `__reduce__` tells it: what is called, and with what.
pub(crate) type Rebuilt<'py> = (Bound<'py, PyAny>, (Bound<'py, PyType>,));

/// A copy by `parse` of its class, of a text and a name.
pub(crate) fn rebuilt<'py, T: PyTypeInfo>(py: Python<'py>, text: &str, name: &str) -> PyResult<Rebuilt<'py>> {
    let caller = py.import("operator")?.getattr("methodcaller")?;
    let parse = caller.call(("parse", text), Some(&[("name", name)].into_py_dict(py)?))?;
    Ok((parse, (T::type_object(py),)))
}

impl Layout {
    fn plane<'py>(&self, py: Python<'py>, has: impl Fn(Cell) -> bool) -> PyResult<Bound<'py, PyAny>> {
        let bytes: Vec<u8> = self.ground.cells().map(|cell| u8::from(has(cell))).collect();
        view(py, &bytes, "?", &[self.height() as usize, self.width() as usize])
    }

    fn walls<'py>(&self, py: Python<'py>, side: Side) -> PyResult<Bound<'py, PyAny>> {
        self.plane(py, |cell| {
            self.ground.contains(cell.beyond(side)) && self.ground.has_wall(Edge::new(cell, side))
        })
    }
}
