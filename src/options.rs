//! Options that several commands share: how the result is printed, and which files may be replaced.

use std::fmt::Display;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use tautline_io::atomic_file::{AtomicFile, Foreign, Replaceable};
use tautline_io::diagnostic::Diagnostic;

/// How the result is printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Format {
    /// For people.
    Text,
    /// One JSON object, with its schema_version.
    Json,
}

#[derive(Debug, Args)]
pub(crate) struct FormatArgs {
    /// How the result is printed.
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: Format,
}

/// The choice about files that stand where others are to be stored.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct ForceArgs {
    /// Also replace files that tautline did not write, and those that keep work. A file that the command reads is
    /// never replaced.
    #[arg(long)]
    pub(crate) force: bool,
}

impl ForceArgs {
    /// The files that a command may replace which reads `inputs`.
    pub(crate) fn replaceable(&self, inputs: impl IntoIterator<Item = PathBuf>) -> Replaceable {
        Replaceable::new(if self.force { Foreign::Replace } else { Foreign::Keep }, inputs)
    }

    /// The files that a command stores, where they have a place, if it reads these.
    ///
    /// # Errors
    /// A [`Diagnostic`] if one of them has none, or there is nothing to force.
    pub(crate) fn files<const N: usize>(
        &self,
        paths: [&Option<PathBuf>; N],
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> Result<[Option<AtomicFile>; N], Diagnostic> {
        self.has_effect(paths.iter().any(|path| path.is_some()))?;
        AtomicFile::several(paths.map(Option::as_deref), &self.replaceable(inputs))
    }

    /// The files that a command stores, as many as there may be, if it reads these.
    ///
    /// # Errors
    /// As of [`ForceArgs::files`].
    #[cfg(feature = "papers")]
    pub(crate) fn each(
        &self,
        paths: &[Option<PathBuf>],
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> Result<Vec<Option<AtomicFile>>, Diagnostic> {
        self.has_effect(paths.iter().any(Option::is_some))?;
        let replaceable = self.replaceable(inputs);
        let mut files: Vec<Option<AtomicFile>> = Vec::new();
        for path in paths {
            let beside = |path: &PathBuf| AtomicFile::beside(path, files.iter().flatten(), &replaceable);
            let file = path.as_ref().map(beside).transpose()?;
            files.push(file);
        }
        Ok(files)
    }

    pub(crate) fn has_effect(&self, is_any_stored: bool) -> Result<(), Diagnostic> {
        refuse_needless([("--force", self.force && !is_any_stored)], "no file is to be stored")
    }
}

/// Refuses options that can have no effect, where one of them is given.
///
/// # Errors
/// A [`Diagnostic`] of the first that is.
pub(crate) fn refuse_needless<const N: usize>(
    options: [(&str, bool); N],
    why: impl Display,
) -> Result<(), Diagnostic> {
    let Some((option, _)) = options.into_iter().find(|&(_, is_given)| is_given) else { return Ok(()) };
    Err(Diagnostic::usage(format_args!("{option} has no effect: {why}"), format_args!("leave {option} out")))
}
