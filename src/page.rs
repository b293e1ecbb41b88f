//! `tautline page`: the page of a stored run.

use std::path::PathBuf;

use clap::Args;
use tautline_io::diagnostic::Halt;

use super::exit::Exit;
use super::folder::shown;
use super::options::ForceArgs;
use super::output::Output;
use super::replay::Replay;

const EXAMPLES: &str = "\
Examples:
  tautline page chain-1-published-n4.jsonl
  tautline page rescue.jsonl --html rescue.html
  web/build --rule templates/page     the page of a rule of one's own, from the repository";

/// Write the page that plays a stored run, counterexample or rescue.
///
/// A rule of one's own has a page to draw on, with the engine inside, if it is a crate in
/// Rust: `web/build --rule FOLDER` in the repository makes it. Of a rule in Python a
/// stored run has a page, and the rule has none.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Page {
    /// A file that `explore --trace`, `rescue --trace`, `hunt`, `minimise`, `prove --out` or `library --out` wrote.
    file: PathBuf,
    /// The file of the page. Without it, it has the name of the run, in the folder where you are.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
}

impl Page {
    /// A run that breaks a clause has a page as any other has: the page is what was asked for.
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let name = || PathBuf::from(self.file.file_name().unwrap_or_default()).with_extension("html");
        let html = self.html.clone().unwrap_or_else(name);
        let path = shown(&html);
        let exit = Replay::as_page(self.file.clone(), html, self.force).run(out)?;
        out.text(format_args!("the page that plays it: {path}\n"))?;
        Ok(if exit == Exit::Violation { Exit::Expected } else { exit })
    }
}
