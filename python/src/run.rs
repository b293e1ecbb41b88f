//! A run: what came of it, its team moves as arrays, how it is drawn, stored and made minimal.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use tautline_io::atomic_file::{AtomicFile, Foreign, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::svg::Panel;
use tautline_kernel::ground::Cell;
use tautline_papers::rivals::CATALOGUE;
use tautline_proofs::plural::counted;
use tautline_sim::counterexample::minimise::minimise;
use tautline_sim::draw::{page, story, svg};
use tautline_sim::explore::{ClauseId, Milestone, Play, Report, Setup, TeamMove};
use tautline_sim::trace::{self, ForeignRun, StoredRun, Summary, Writer};

use crate::arguments::Int;
use crate::arrays::view;
use crate::diagnostic::{Kind, error, failed, halted, raised};
use crate::layout::{Layout, Rebuilt, rebuilt};
use crate::wait::wait_for;

/// The version of the JSON of a run: that of the program.
const SCHEMA_VERSION: u32 = 1;

/// Team moves that one picture shows at most.
const MAX_PANELS: u32 = 200;

/// The data that make a run again.
#[derive(Clone)]
pub(crate) enum RunSource {
    /// A rule of the catalogue.
    Known(Box<Setup>),
    /// A file with a rule that the catalogue does not have, and its text.
    Recorded(Box<ForeignRun>, String),
}

impl RunSource {
    fn play(&self) -> &(dyn Play + Sync) {
        match self {
            Self::Known(setup) => &**setup,
            Self::Recorded(run, _) => &**run,
        }
    }
}

/// A run that is over.
#[pyclass(frozen, module = "pytautline")]
pub(crate) struct Run {
    pub(crate) made: RunSource,
    /// The name by which its layout was loaded.
    pub(crate) name: String,
    pub(crate) report: Report,
    /// The clause that it is a counterexample to.
    pub(crate) clause: Option<ClauseId>,
}

/// The head of every JSON object.
#[derive(Serialize)]
struct Document<T> {
    schema_version: u32,
    #[serde(flatten)]
    content: T,
}

/// Why the work of another thread ended: it was told to.
pub(crate) fn stopped(is_stopped: &AtomicBool) -> Result<(), Halt> {
    if is_stopped.load(Ordering::Relaxed) { Err(Halt::Interrupted) } else { Ok(()) }
}

impl Run {
    /// The run of `setup`, made now.
    pub(crate) fn of(py: Python<'_>, setup: Setup, name: String, clause: Option<ClauseId>) -> PyResult<Self> {
        let report = wait_for(py, |is_stopped| setup.play(&mut |_| stopped(is_stopped)))?;
        let report = report.map_err(|halt| halted(py, &halt))?;
        Ok(Self { made: RunSource::Known(Box::new(setup)), name, report, clause })
    }

    /// The run in a file, checked.
    pub(crate) fn read(py: Python<'_>, path: &Path) -> PyResult<Self> {
        let stored = trace::open(path, CATALOGUE).map_err(|fault| raised(py, &fault))?;
        let text = match stored {
            StoredRun::Known(_) => String::new(),
            StoredRun::Foreign(_) => fs::read_to_string(path).map_err(|_| {
                raised(py, &Diagnostic::in_file(path, "it was there, and is gone", "store it again"))
            })?,
        };
        Self::again(py, stored, text, path.display().to_string())
    }

    /// The run that is stored so, made again. One of a rule that the catalogue does not have keeps its `text`.
    fn again(py: Python<'_>, stored: StoredRun, text: String, name: String) -> PyResult<Self> {
        let (made, report, clause) = match stored {
            StoredRun::Known(stored) => {
                let (setup, clause) = (stored.setup.clone(), stored.clause);
                let report = wait_for(py, |is_stopped| stored.replay(&mut |_| stopped(is_stopped)))?;
                (RunSource::Known(Box::new(setup)), report.map_err(|halt| halted(py, &halt))?, clause)
            }
            StoredRun::Foreign(run) => {
                let report = run.play(&mut |_| Ok(())).map_err(|halt| halted(py, &halt))?;
                let clause = run.clause;
                (RunSource::Recorded(Box::new(run), text), report, clause)
            }
        };
        Ok(Self { made, name, report, clause })
    }

    fn play(&self) -> &(dyn Play + Sync) {
        self.made.play()
    }

    /// Each team move, in their order.
    fn each(&self, py: Python<'_>, mut see: impl FnMut(&TeamMove<'_>) + Send) -> PyResult<()> {
        let run = self.play();
        let made = wait_for(py, |is_stopped| {
            run.play(&mut |made| {
                see(made);
                stopped(is_stopped)
            })
        })?;
        made.map(|_| ()).map_err(|halt| halted(py, &halt))
    }

    /// Writes to a file what `put` has to say.
    fn file(
        py: Python<'_>,
        path: &Path,
        replaceable: &Replaceable,
        put: impl FnOnce(AtomicFile) -> Result<AtomicFile, Halt> + Send,
    ) -> PyResult<()> {
        let write = || {
            let file = put(AtomicFile::new(path, replaceable)?)?;
            Ok(file.keep()?)
        };
        py.detach(write).map_err(|halt: Halt| halted(py, &halt))
    }

    /// Writes the trace.
    fn traced(&self, file: AtomicFile) -> Result<AtomicFile, Halt> {
        match &self.made {
            RunSource::Known(setup) => {
                let mut writer = Writer::new(file, setup, self.clause)?;
                let report = setup.play(&mut |made| {
                    writer.add(made);
                    Ok(())
                })?;
                Ok(writer.end(&report))
            }
            RunSource::Recorded(_, text) => {
                let mut file = file;
                file.append(text);
                Ok(file)
            }
        }
    }

    fn paged(&self, mut file: AtomicFile) -> Result<AtomicFile, Halt> {
        let run = self.play();
        svg::check_size(self.report.chart.area())?;
        page::write(&mut file, run, &self.report, &(1..=self.report.steps))?;
        Ok(file)
    }

    /// The bytes that `put` writes to a file.
    fn bytes(
        &self,
        py: Python<'_>,
        put: impl FnOnce(&Self, AtomicFile) -> Result<AtomicFile, Halt> + Send,
    ) -> PyResult<Vec<u8>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("bytes");
        Self::file(py, &path, &Replaceable::default(), |file| put(self, file))?;
        Ok(fs::read(&path)?)
    }

    /// The text that `put` writes to a file.
    fn text(
        &self,
        py: Python<'_>,
        put: impl FnOnce(&Self, AtomicFile) -> Result<AtomicFile, Halt> + Send,
    ) -> PyResult<String> {
        Ok(String::from_utf8(self.bytes(py, put)?)?)
    }

    fn panels(&self, py: Python<'_>, moves: &RangeInclusive<u32>) -> PyResult<String> {
        if moves.end().saturating_sub(*moves.start()) >= MAX_PANELS {
            let what = format!("a picture of more than {MAX_PANELS} team moves");
            return Err(error(py, Kind::Input, what, "give the first and the last of fewer moves"));
        }
        let (run, chart) = (self.play(), &self.report.chart);
        let mut panels = Vec::new();
        self.each(py, |made| {
            if moves.contains(&made.step) {
                panels.push(svg::team_move(run, chart, made));
            }
        })?;
        Ok(Panel::picture(&run.setup().title(), &panels))
    }
}

#[pymethods]
impl Run {
    /// The name of the scheme.
    #[getter]
    fn scheme(&self) -> String {
        self.play().setup().scheme.name.to_owned()
    }

    /// The name of its rule.
    #[getter]
    fn rule(&self) -> String {
        self.play().setup().rule.to_string()
    }

    /// How many robots there are, the base counted if there is one.
    #[getter]
    fn robots(&self) -> u16 {
        self.play().setup().robots
    }

    /// The seed of whatever was left to chance.
    #[getter]
    fn seed(&self) -> u64 {
        self.play().setup().seed
    }

    /// Where it ran.
    #[getter]
    fn layout(&self) -> Layout {
        Layout { ground: self.play().setup().layout.clone(), name: self.name.clone() }
    }

    /// Team moves, backtracks included.
    #[getter]
    fn steps(&self) -> u32 {
        self.report.steps
    }

    /// Cells that were occupied.
    #[getter]
    fn explored(&self) -> u32 {
        self.report.explored
    }

    /// Cells that the team was to explore.
    #[getter]
    fn cells(&self) -> u32 {
        self.report.cells
    }

    /// By percent of the cells: in which team move so many were explored.
    #[getter]
    fn milestones(&self) -> BTreeMap<u32, Option<u32>> {
        Milestone::ALL.map(|milestone| (milestone.percent(), self.report.reached(milestone))).into()
    }

    /// Why it is over, in a word.
    #[getter]
    fn stopped(&self) -> PyResult<String> {
        let word = serde_json::to_value(self.report.stopped);
        let word = word.ok().and_then(|word| Some(word.as_str()?.to_owned()));
        word.ok_or_else(|| pyo3::exceptions::PyRuntimeError::new_err("a bug of tautline: no word"))
    }

    /// Which clause was broken in which team move.
    #[getter]
    fn violations(&self) -> Vec<(&'static str, u32)> {
        self.report.violations.iter().map(|broken| (broken.clause.as_str(), broken.step)).collect()
    }

    /// The clause that it is a counterexample to, if it is one.
    #[getter]
    fn clause(&self) -> Option<&'static str> {
        self.clause.map(ClauseId::as_str)
    }

    /// Where each robot is, at the start and after each team move: an array of moves, robots, and column and row.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let put = |cells: &[Cell], bytes: &mut Vec<u8>| {
            for cell in cells {
                bytes.extend(cell.x.to_ne_bytes());
                bytes.extend(cell.y.to_ne_bytes());
            }
        };
        let (mut bytes, robots) = (Vec::new(), self.report.team.len());
        put(&self.play().setup().starts(), &mut bytes);
        self.each(py, |made| put(&made.frame.cells, &mut bytes))?;
        view(py, &bytes, "h", &[bytes.len() / (4 * robots.max(1)), robots, 2])
    }

    /// In which team move each cell was first occupied, 0 for the start and -1 for never: an array of rows and columns.
    fn order<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let layout = &self.play().setup().layout;
        let step = |cell| self.report.chart.step(cell).map_or(-1, u32::cast_signed);
        let bytes: Vec<u8> = layout.cells().flat_map(|cell| step(cell).to_ne_bytes()).collect();
        view(py, &bytes, "i", &[layout.height() as usize, layout.width() as usize])
    }

    /// The team moves as the trace has them.
    fn moves<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let mut lines = Vec::new();
        let mut wrong = None;
        let look = self.play().setup().scheme.look;
        self.each(py, |made| match serde_json::to_string(&trace::StoredMove::new(made, look)) {
            Ok(line) => lines.push(line),
            Err(error) => wrong = Some(error),
        })?;
        match wrong {
            None => py.import("json")?.call_method1("loads", (format!("[{}]", lines.join(",")),)),
            Some(error) => Err(pyo3::exceptions::PyRuntimeError::new_err(error.to_string())),
        }
    }

    /// One JSON object in a line: what `tautline explore --format json` prints.
    fn json(&self) -> PyResult<String> {
        let content = Summary::new(self.play(), &self.name, &self.report);
        let text = serde_json::to_string(&Document { schema_version: SCHEMA_VERSION, content });
        text.map(|text| text + "\n")
            .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))
    }

    /// The text of the file that `tautline explore --trace` stores.
    fn trace(&self, py: Python<'_>) -> PyResult<String> {
        self.text(py, Self::traced)
    }

    /// Stores that file.
    #[pyo3(signature = (path, *, force=false))]
    fn store(&self, py: Python<'_>, path: PathBuf, force: bool) -> PyResult<()> {
        let foreign = if force { Foreign::Replace } else { Foreign::Keep };
        Self::file(py, &path, &Replaceable::new(foreign, []), |file| self.traced(file))
    }

    /// The run in the Informal Trace Format of Apalache, as `--itf` stores it.
    fn itf(&self, py: Python<'_>) -> PyResult<String> {
        self.text(py, |run, mut file| {
            tautline_viewers::itf::write(&mut file, run.play())?;
            Ok(file)
        })
    }

    /// The run as a recording of ROS 2, as `--mcap` stores it.
    fn mcap<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = self.bytes(py, |run, mut file| {
            tautline_viewers::mcap::write(&mut file, run.play())?;
            Ok(file)
        })?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// How the last team move breaks its clause, in words and drawn.
    fn story(&self, py: Python<'_>) -> PyResult<String> {
        story::last_move(self.play()).map_err(|halt| halted(py, &halt))
    }

    /// A picture: the order of exploration, or these team moves; of a counterexample the last one.
    #[pyo3(signature = (moves=None))]
    fn svg(&self, py: Python<'_>, moves: Option<(Int, Int)>) -> PyResult<String> {
        svg::check_size(self.report.chart.area()).map_err(|fault| raised(py, &fault))?;
        match (moves, self.clause) {
            (Some((first, last)), _) => {
                let (Int(first), Int(last), steps) = (first, last, self.report.steps);
                let moves = first..=last.min(steps.into());
                if first < 1 || moves.is_empty() {
                    let what =
                        format!("moves are {first} to {last} of a run of {}", counted(steps, "team move"));
                    let remedy = "give the first and the last of some, counted from 1";
                    return Err(error(py, Kind::Input, what, remedy));
                }
                self.panels(py, &(*moves.start() as u32..=*moves.end() as u32))
            }
            (None, Some(_)) if self.report.steps > 0 => {
                self.panels(py, &(self.report.steps..=self.report.steps))
            }
            (None, _) => {
                let run = self.play();
                Ok(Panel::picture(&run.setup().title(), &[svg::order(run, &self.report.chart)]))
            }
        }
    }

    /// A page that plays the run: one file without anything from elsewhere.
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        self.text(py, Self::paged)
    }

    /// The smallest run that it shrinks to and that breaks the same clause.
    #[pyo3(signature = (clause=None))]
    fn minimise(&self, py: Python<'_>, clause: Option<&str>) -> PyResult<Self> {
        let setup = match &self.made {
            RunSource::Known(setup) => setup,
            RunSource::Recorded(..) => {
                let what = "a run of a rule that is not in the catalogue";
                let remedy = "take the run that hunt_rule has found: it has the fewest walls";
                return Err(error(py, Kind::Input, what, remedy));
            }
        };
        let asked = clause
            .map(|id| CATALOGUE.clause(id).map_err(|none| error(py, Kind::Input, &none, none.remedy())));
        let asked = asked.transpose()?.or(self.clause);
        let minimal = wait_for(py, |is_stopped| minimise(setup, asked, &mut |_| stopped(is_stopped)))?;
        let minimal = minimal.map_err(|failure| failed(py, &failure))?;
        Self::of(py, minimal.setup, self.name.clone(), Some(minimal.clause))
    }

    /// The run of the text of a trace, checked, in a layout that is called so.
    #[staticmethod]
    #[pyo3(signature = (trace, *, name="trace"))]
    fn parse(py: Python<'_>, trace: String, name: &str) -> PyResult<Self> {
        let stored = trace::open_text(name, trace.clone(), CATALOGUE).map_err(|fault| raised(py, &fault))?;
        Self::again(py, stored, trace, name.to_owned())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Rebuilt<'py>> {
        rebuilt::<Self>(py, &self.trace(py)?, &self.name)
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<String> {
        self.svg(py, None)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let page = self.html(py)?;
        let page = page.replace('&', "&amp;").replace('"', "&quot;");
        Ok(format!(
            "<iframe srcdoc=\"{page}\" title=\"a run\" style=\"width:100%;height:40em;border:0\"></iframe>"
        ))
    }

    fn __repr__(&self) -> String {
        let setup = self.play().setup();
        let Report { steps, explored, cells, violations, .. } = &self.report;
        let mut text = format!("<pytautline.Run {} ({})", setup.scheme.name, setup.rule);
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            ", {} robots: {steps} team moves, {explored} of {cells} cells explored",
            setup.robots
        );
        if let Some(broken) = violations.first() {
            let _ = write!(text, ", {} broken in team move {}", broken.clause, broken.step);
        }
        text + ">"
    }
}
