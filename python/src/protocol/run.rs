//! A run of a rule over states that breaks a demand.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use tautline_io::atomic_file::{AtomicFile, Foreign, Replaceable};
use tautline_proofs::decide::{Depiction, Evidence};
use tautline_proofs::engine::states::Bits;
use tautline_proofs::protocol::{Move, Protocol};

use super::script::{ScriptCheck, StateScript};
use crate::diagnostic::raised;

/// A run of a rule over states that breaks a demand.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct StateRun {
    /// The clause.
    clause: &'static str,
    /// The demand, in words.
    words: &'static str,
    /// The state in which it begins.
    start: Py<PyAny>,
    /// Its moves.
    moves: Vec<Py<PyAny>>,
    /// The moves that come again and again after them; none if it ends.
    again: Vec<Py<PyAny>>,
    story: String,
    /// The run as it stands in a file.
    text: String,
}

impl StateRun {
    /// The run of the demand with this number that `evidence` is about.
    pub(super) fn of(
        py: Python<'_>,
        script: &Arc<StateScript>,
        demand: usize,
        evidence: &Evidence,
        text: String,
    ) -> PyResult<Self> {
        let wanted = &script.demands[demand];
        let class = py.import("pytautline._protocol")?.getattr("Move")?;
        let posed = ScriptCheck(Arc::clone(script), demand);
        let (start, once) = evidence.choices.once.split_first().unwrap_or((&0, &[]));
        let mut state = script.starts().get(*start as usize).copied().unwrap_or_default();
        let start = script.script.state(py, state);
        let mut made = |&choice: &u32| -> PyResult<Py<PyAny>> {
            let chosen = posed.moves(&(), &state).into_iter().nth(choice as usize);
            script.script.checked(py)?;
            let Move { actors, words, to, by, .. } = chosen.ok_or_else(|| script.script.not_pure(py))?;
            state = to;
            let actors: Vec<u32> = (0..Bits::BITS).filter(|actor| actors >> actor & 1 == 1).collect();
            let made = class.call1((PyTuple::new(py, actors)?, words, script.script.state(py, to)))?;
            if by.is_some() {
                made.setattr("by", by)?;
            }
            Ok(made.unbind())
        };
        Ok(Self {
            clause: wanted.clause,
            words: wanted.words,
            start,
            moves: once.iter().map(&mut made).collect::<PyResult<_>>()?,
            again: evidence.choices.again.iter().map(made).collect::<PyResult<_>>()?,
            story: if let Depiction::Story(story) = &evidence.seen { story.clone() } else { String::new() },
            text,
        })
    }
}

#[pymethods]
impl StateRun {
    /// Stores the run as a file, which `replay_protocol` plays by its rule.
    #[pyo3(signature = (path, *, force=false))]
    fn store(&self, py: Python<'_>, path: PathBuf, force: bool) -> PyResult<()> {
        let foreign = if force { Foreign::Replace } else { Foreign::Keep };
        let stored = AtomicFile::new(&path, &Replaceable::new(foreign, [])).and_then(|mut file| {
            file.append(&self.text);
            file.keep()
        });
        stored.map_err(|fault| raised(py, &fault))
    }

    fn __repr__(&self) -> String {
        let Self { clause, words, moves, again, .. } = self;
        let round =
            if again.is_empty() { String::new() } else { format!(", {} again and again", again.len()) };
        format!("<pytautline.StateRun {clause}: not so that {words}; {} moves{round}>", moves.len())
    }

    fn __str__(&self) -> &str {
        &self.story
    }
}
