//! Runs of a team as files for the viewers that people have.

use std::path::{Path, PathBuf};

use clap::Args;
use tautline_sim::aside::Aside;
use tautline_sim::explore::Play;
use tautline_sim::fault::{Fault, Halt};
use tautline_sim::trace;

use super::output::Output;

/// The files that a run of a team is stored in besides.
#[derive(Debug, Args)]
pub(super) struct ViewerArgs {
    /// Store the run in the Informal Trace Format, for the viewers of model checkers.
    #[arg(long, value_name = "FILE")]
    itf: Option<PathBuf>,
    /// Store the run as a recording of ROS 2, for its viewers: the map that the team knows, robots, links, team moves.
    #[arg(long, value_name = "FILE")]
    mcap: Option<PathBuf>,
}

/// Those files, begun.
pub(super) type ViewerFiles = [Option<Aside>; 2];

impl ViewerArgs {
    /// Where they are to stand.
    pub(super) const fn paths(&self) -> [&Option<PathBuf>; 2] {
        [&self.itf, &self.mcap]
    }
}

/// Refuses a file in the format `option` where there is no run of a team: in the file at `path` there is `what` instead.
///
/// # Errors
/// A [`Fault`] if it is asked for.
pub(super) fn refuse(asked: Option<&Aside>, (option, what): (&str, &str), path: &Path) -> Result<(), Fault> {
    if asked.is_none() {
        return Ok(());
    }
    let what = format!("{what} has no team moves for {option}");
    Err(Fault::in_file(path, what, format_args!("leave {option} out, or name a run of a team")))
}

/// Writes `run` to these files.
pub(super) fn store([itf, mcap]: ViewerFiles, run: &dyn Play, out: &mut Output) -> Result<(), Halt> {
    type Write = fn(&mut Aside, &dyn Play) -> Result<(), Halt>;
    for (file, write) in [(itf, trace::itf::write as Write), (mcap, trace::mcap::write)] {
        if let Some(mut file) = file {
            write(&mut file, run)?;
            out.keep(file);
        }
    }
    Ok(())
}
