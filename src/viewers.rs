//! Runs of a team as files for the viewers that people have.

use std::path::{Path, PathBuf};

use clap::Args;
#[cfg(not(feature = "viewers"))]
use tautline_field::rescue::{Report, Setting};
use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_sim::explore::Play;
#[cfg(feature = "viewers")]
use tautline_viewers::{itf, mcap};

use super::output::Output;

/// The files that a run of a team is stored in besides.
#[derive(Debug, Default, Args)]
pub(super) struct ViewerArgs {
    #[cfg_attr(not(feature = "viewers"), arg(skip))]
    #[cfg_attr(feature = "viewers", arg(long, value_name = "FILE"))]
    /// Store the run in the Informal Trace Format, for the viewers of model checkers.
    itf: Option<PathBuf>,
    /// Store the run as a recording of ROS 2, for its viewers: the map that the team knows, robots, links, team moves.
    #[cfg_attr(not(feature = "viewers"), arg(skip))]
    #[cfg_attr(feature = "viewers", arg(long, value_name = "FILE"))]
    mcap: Option<PathBuf>,
}

/// Those files, begun.
pub(super) type ViewerFiles = [Option<AtomicFile>; 2];

impl ViewerArgs {
    /// Where they are to stand.
    pub(super) const fn paths(&self) -> [&Option<PathBuf>; 2] {
        [&self.itf, &self.mcap]
    }
}

/// Refuses a file in the format `option` where there is no run of a team: in the file at `path` there is `what`
/// instead.
///
/// # Errors
/// A [`Diagnostic`] if it is asked for.
pub(super) fn refuse(
    asked: Option<&AtomicFile>,
    (option, what): (&str, &str),
    path: &Path,
) -> Result<(), Diagnostic> {
    if asked.is_none() {
        return Ok(());
    }
    let what = format!("{what} has no team moves for {option}");
    Err(Diagnostic::in_file(path, what, format_args!("leave {option} out, or name a run of a team")))
}

/// Writes `run` to these files.
#[cfg(feature = "viewers")]
pub(super) fn store([itf, mcap]: ViewerFiles, run: &dyn Play, out: &mut Output) -> Result<(), Halt> {
    type Write = fn(&mut AtomicFile, &dyn Play) -> Result<(), Halt>;
    for (file, write) in [(itf, itf::write as Write), (mcap, mcap::write)] {
        out.store(file, |file| write(file, run))?;
    }
    Ok(())
}

/// Writes nothing: this program was built without viewers, and has no option that names such a file.
#[cfg(not(feature = "viewers"))]
pub(super) fn store(_: ViewerFiles, _: &dyn Play, _: &mut Output) -> Result<(), Halt> {
    Ok(())
}

#[cfg(feature = "viewers")]
pub(super) use tautline_viewers::rescue::write as record;

/// Writes nothing: this program was built without viewers, and has no option that names such a file.
#[cfg(not(feature = "viewers"))]
pub(super) fn record(_: &mut AtomicFile, _: &Setting, _: u64, _: &Report) -> Result<(), Diagnostic> {
    Ok(())
}
