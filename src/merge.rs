//! `tautline merge`: one of all shards of a plan.

use std::path::{Path, PathBuf};

use clap::Args;
#[cfg(feature = "papers")]
use clap::value_parser;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::{Gap, Plan, Work};
#[cfg(feature = "papers")]
use tautline_papers::shards::{merge_table, restored};
#[cfg(feature = "papers")]
use tautline_papers::tables::find;
use tautline_proofs::engine::states::MemoryLimit;
use tautline_sim::shards::{hunted, merge_hunt};

use super::catalogue::CATALOGUE;
use super::exit::Exit;
use super::findings::FormatArgs;
use super::folder::make_folder;
use super::options::{ForceArgs, refuse_needless};
use super::output::{Output, complain};
use super::prove::{DecidedRows, DecisionArgs, Detail};
#[cfg(feature = "papers")]
use super::reproduce::{Files, tell};
use super::{hunt, library};

/// The most gaps that are named.
const MOST_NAMED: usize = 20;

const EXAMPLES: &str = "\
Examples:
  tautline hunt --robots 5 --max-walls 4 --plan plan.json --shards 64
  tautline hunt --plan plan.json --shard 1
  tautline merge plan.json
  tautline merge plan.json node-1/plan-1.json node-2/plan-2.json --out counterexamples";

/// Make one of all shards of a plan: what one process would have printed and stored.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Merge {
    /// The plan.
    plan: PathBuf,
    /// The files of its shards. Without one, those beside the plan.
    files: Vec<PathBuf>,
    /// The folder for the counterexamples. Without it those of a hunt are
    /// stored here, and those of the library are not.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Store a picture of a table: its name, which is that of the option of `reproduce ID` that stores it, such as svg
    /// for --svg, and a file.
    #[cfg_attr(not(feature = "papers"), arg(skip))]
    #[cfg_attr(feature = "papers", arg(long = "picture", value_names = ["NAME", "FILE"], num_args = 2))]
    #[cfg_attr(feature = "papers", arg(value_parser = value_parser!(PathBuf)))]
    pictures: Vec<PathBuf>,
    /// Store the values of a table as comma-separated values.
    #[cfg_attr(not(feature = "papers"), arg(skip))]
    #[cfg_attr(feature = "papers", arg(long, value_name = "FILE"))]
    csv: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// Tells what keeps a merge from being whole.
fn refuse(plan: &Plan, gaps: &[Gap]) {
    let words = |gap: &Gap| match gap {
        Gap::Missing(shard) => format!("shard {shard} is missing"),
        Gap::Unfinished(shard) => format!("shard {shard} is not at its end"),
    };
    let mut named: Vec<String> = gaps.iter().take(MOST_NAMED).map(words).collect();
    if gaps.len() > MOST_NAMED {
        named.push(format!("and {} more", gaps.len() - MOST_NAMED));
    }
    let what = format!("{} of {} shards are not there: {}", gaps.len(), plan.shards, named.join(", "));
    complain(&Diagnostic::in_file(plan.path(), what, "run them, and merge again"));
}

impl Merge {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let plan = Plan::read(&self.plan)?;
        let beside = || {
            let paths = (1..=plan.shards).map(|shard| plan.shard_path(shard));
            paths.filter(|path| path.exists()).collect()
        };
        let files: Vec<PathBuf> = if self.files.is_empty() { beside() } else { self.files.clone() };
        let of = match plan.of {
            Work::Hunt { .. } => Some("a hunt"),
            Work::Library { .. } => Some("the library"),
            Work::Table { .. } => None,
        };
        if let Some(of) = of {
            let tables = [("--picture", !self.pictures.is_empty()), ("--csv", self.csv.is_some())];
            let path = self.plan.display();
            let why = format_args!("{path} is a plan of {of}, and only a table has pictures and values");
            refuse_needless(tables, why)?;
        }
        #[cfg(feature = "papers")]
        if let Work::Table { id } = &plan.of
            && let Some(table) = find(id)
        {
            let mut names = self.pictures.iter().step_by(2).map(|name| name.to_string_lossy());
            names.try_for_each(|name| table.about().picture(&name).map(drop))?;
        }
        let shards = match plan.results(&files)? {
            Ok(shards) => shards,
            Err(gaps) => {
                refuse(&plan, &gaps);
                return Ok(Exit::Gaps);
            }
        };
        let inputs = files.into_iter().chain([self.plan.clone()]);
        refuse_needless([("--out", of.is_none() && self.out.is_some())], "a table has no counterexamples")?;
        match plan.of {
            Work::Library { .. } => {
                let how = DecisionArgs::elsewhere(self.out.clone(), self.force, self.format);
                let rows = library::rows(&plan, &shards)?;
                self.out.as_deref().map(make_folder).transpose()?;
                let replaceable = self.force.replaceable(inputs);
                let made = DecidedRows { rows: &rows, memory: &MemoryLimit::unbounded(), left: 0 };
                how.tell(&made, (Detail::Rows, None), &replaceable, out)
            }
            Work::Hunt { .. } => {
                let here = Path::new(".");
                let folder = self.out.as_deref().unwrap_or(here);
                let asked = hunted(&plan, CATALOGUE)?;
                let found = merge_hunt(&plan, &asked, &shards)?;
                make_folder(folder)?;
                let replaceable = self.force.replaceable(inputs);
                hunt::tell((&asked, &found), (folder, &replaceable), self.format.format, out)
            }
            #[cfg(not(feature = "papers"))]
            Work::Table { .. } => {
                let remedy = "build it with the feature `papers`";
                Err(Diagnostic::usage("this program was built without tables", remedy).into())
            }
            #[cfg(feature = "papers")]
            Work::Table { .. } => {
                let asked = restored(&plan)?;
                let made = asked.merge(&merge_table(&plan, &*asked, &shards)?)?;
                let picture =
                    |pair: &[PathBuf]| (pair[0].to_string_lossy().into_owned(), Some(pair[1].clone()));
                let pictures = self.pictures.chunks(2).map(picture).collect();
                let files = Files::of(pictures, self.csv.clone(), (&self.force, inputs))?;
                tell(&*made, files, self.format.format.plain()?, out)
            }
        }
    }
}
