//! `tautline man`: a manual page of the program and of each command, from the words of their help.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};
use tautline_io::atomic_file::{AtomicFile, MAN_HEAD};
use tautline_io::diagnostic::{Diagnostic, Halt};

use super::ascii;
use super::exit::{EXIT_CODES, Exit};
use super::folder::make_folder;
use super::options::ForceArgs;
use super::output::{self, Output};

const EXAMPLES: &str = "\
Examples:
  tautline man | man -l -
  tautline man reproduce atlas | man -l -
  tautline man --out /usr/local/share/man/man1";

/// Print the manual page of the program or of a command, or store the pages of all.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Manual {
    /// The command, for example `explore` or `reproduce atlas`. Without it the page is that of the program.
    #[arg(value_name = "COMMAND")]
    command: Vec<String>,
    /// Store the pages of the program and of all commands in this folder, as tautline.1, tautline-explore.1 and so on.
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    out: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
}

impl Manual {
    pub(super) fn run(&self, program: Command, out: &mut Output) -> Result<Exit, Halt> {
        self.force.has_effect(self.out.is_some())?;
        let mut program = program.disable_help_subcommand(true);
        program.build();
        if let Some(folder) = &self.out {
            make_folder(folder)?;
            let replaceable = self.force.replaceable([]);
            for command in all(&program) {
                let man = Man::new(command.clone());
                let mut file = AtomicFile::late(&folder.join(man.get_filename()), &replaceable);
                file.append(page(&man)?);
                out.keep(file);
            }
            return Ok(Exit::Expected);
        }
        let mut command = &program;
        for name in &self.command {
            command = command.find_subcommand(name).ok_or_else(|| unknown(command, name))?;
        }
        let page = page(&Man::new(command.clone()))?;
        // A page is made of text.
        out.bytes(ascii::roff(String::from_utf8_lossy(&page).into_owned()).as_bytes())?;
        Ok(Exit::Expected)
    }
}

/// A command and those in it.
fn all(command: &Command) -> Vec<&Command> {
    let mut all = vec![command];
    all.extend(command.get_subcommands().flat_map(self::all));
    all
}

fn page(man: &Man) -> Result<Vec<u8>, Diagnostic> {
    let mut page = MAN_HEAD.as_bytes().to_vec();
    let mut exit_status = Roff::new();
    exit_status.control("SH", ["EXIT STATUS"]).text([roman(EXIT_CODES)]);
    man.render(&mut page).map_err(|error| output::unwritable(&error))?;
    page.extend(exit_status.to_roff().into_bytes());
    Ok(page)
}

fn unknown(command: &Command, name: &str) -> Diagnostic {
    let what = format!("there is no command {name:?}");
    let names: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
    if names.is_empty() {
        return Diagnostic::usage(what, format_args!("{} has no commands of its own", command.get_name()));
    }
    Diagnostic::usage(what, format_args!("the commands are {}", names.join(", ")))
}
