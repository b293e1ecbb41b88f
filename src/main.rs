//! The command line: what is asked, where it goes, and with which exit code it ends. Data goes to stdout, progress and
//! logs to stderr. A fault ends a command with code 2, an interruption with 3, a panic, which is a bug of ours,
//! with 70. A file that cannot be stored is left out: the rest is given all the same, and the code is 2.

mod ascii;
mod check;
mod conform;
#[cfg(test)]
mod docs_test;
mod evidence;
mod explore;
mod findings;
mod hunt;
mod interrupt;
mod judge;
mod layout_args;
mod library;
mod locate;
mod manual;
#[cfg(feature = "mcp")]
mod mcp;
mod minimise;
mod output;
mod page;
mod progress;
mod prove;
mod replay;
mod report;
#[cfg(feature = "papers")]
mod reproduce;
mod rescue;
mod ros_map;
#[cfg(all(test, feature = "papers"))]
mod schemas;
mod schemes;
mod shards;
mod show;
mod spill;
mod threads;
mod value_parser;
mod viewers;

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;
use std::time::Instant;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use tautline_io::atomic_file::{AtomicFile, Foreign, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::value_parser::{number, real, whole};
use tautline_kernel::ground::Cell;
use tautline_proofs::decide::MethodError;
use terminal_size::{Width, terminal_size};

use crate::report::{Colour, render};
use output::Output;
use tautline_grids::layout::Size;
use tautline_io::text_blocks::fit_into;
#[cfg(feature = "papers")]
use tautline_papers::rivals::CATALOGUE;
#[cfg(not(feature = "papers"))]
use tautline_sim::explore::Catalogue;

#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The schemes of this program: without the papers, the chain has no rivals.
#[cfg(not(feature = "papers"))]
const CATALOGUE: Catalogue = Catalogue::OWN;

/// The text that is printed without a command.
const FIRST_STEPS: &str = "\
Tautline decides what published rules for robot teams promise, and plays what breaks them.

Begin with one of these:
  tautline prove                           every verdict on one screen (1 to 3 minutes)
  tautline hunt --rule published --max-cells 10 --max-walls 13 --out found
                                           the smallest runs that break a chain of robots
  tautline replay found/chain-1-published-n4.jsonl --html run.html
                                           one of them, as a page that plays it
  tautline explore open:15x15 --robots 8   a run that breaks nothing
  tautline schemes                         who can explore, by which rules
  tautline library                         other people's rules, decided

All commands: tautline help; one of them: tautline help COMMAND
";

/// How a command ended. Where several are so, the last of them in this order is told.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Exit {
    /// As expected.
    Expected,
    /// A violation was found.
    Violation,
    /// A budget or the user ended the work before its bound.
    Unfinished,
    /// A merge has gaps.
    Gaps,
    /// Wrong usage or bad input, or a file could not be stored.
    Diagnostic,
    /// A bug of ours.
    Bug,
}

impl Exit {
    /// The exit code of the process.
    const fn code(self) -> u8 {
        match self {
            Self::Expected => 0,
            Self::Violation => 1,
            Self::Diagnostic => 2,
            Self::Unfinished => 3,
            Self::Gaps => 4,
            Self::Bug => 70,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// The meaning of the exit codes, for the help, the manual pages and the documents.
const EXIT_CODES: &str = "0 as expected · 1 a violation was found · 2 wrong usage or bad input, or a file \
                          could not be stored · 3 a budget, Ctrl-C, SIGTERM or SIGHUP ended the work before \
                          its bound, also if something was found by then, or a log does not say enough · 4 a \
                          merge has gaps · 70 a bug of ours. Where several apply, the code is the first of \
                          70, 2, 4, 3, 1, 0. With --exit-zero 1 is 0.";

/// The fate of files.
const FILES: &str = "\
Files stand in their places whole or not at all, those of one command together at its end. Only a process that ends \
by a signal other than Ctrl-C, SIGTERM and SIGHUP can leave a file .tautline-….part behind, which nobody needs.";

const LAYOUTS: &str = "\
LAYOUT is a file (our text drawing, a MovingAI .map, a ROS .yaml) or a generator: open:15x15 · walls:15x15:0.1 · \
rooms-a · rooms-b · office:30x30:4x4 · cells:32x32:0.2";

/// Verified multi-robot coordination: bounded proofs, counterexamples and simulation.
#[derive(Debug, Parser)]
#[command(name = "tautline", version, about, max_term_width = 100)]
#[command(after_help = format!("Exit codes: {EXIT_CODES}\n\n{FILES}\n\n{LAYOUTS}"))]
struct Cli {
    /// Tell more on stderr; twice for everything.
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    verbose: u8,
    /// End with 0 where a violation was found, for engines that try again what fails.
    #[arg(long, global = true)]
    exit_zero: bool,
    /// Print ASCII alone: drawings, text and JSON. Files are stored as ever.
    #[arg(long, global = true)]
    ascii: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Prove(prove::Prove),
    Library(library::Library),
    Schemes(schemes::Schemes),
    Explore(Box<explore::Explore>),
    Hunt(hunt::Hunt),
    Minimise(minimise::Minimise),
    Rescue(rescue::Rescue),
    Locate(locate::Locate),
    Replay(replay::Replay),
    Check(check::Check),
    Conform(conform::Conform),
    Judge(judge::Judge),
    Page(page::Page),
    Show(show::Show),
    #[cfg(feature = "papers")]
    Reproduce(reproduce::Reproduce),
    Merge(shards::Merge),
    #[cfg(feature = "mcp")]
    Mcp(mcp::Mcp),

    /// Print a completion script for a shell.
    #[command(after_help = "Example: tautline completions bash > /etc/bash_completion.d/tautline")]
    Completions {
        /// The shell.
        shell: Shell,
    },
    Man(manual::Manual),
}

/// How the result is printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Format {
    /// For people.
    Text,
    /// One JSON object, with its schema_version.
    Json,
}

/// The version of every JSON object on stdout.
const SCHEMA_VERSION: u32 = 1;

#[derive(Debug, Args)]
struct FormatArgs {
    /// How the result is printed.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// Refuses options that can have no effect, where one of them is given.
///
/// # Errors
/// A [`Diagnostic`] of the first that is.
fn refuse_needless<const N: usize>(options: [(&str, bool); N], why: impl Display) -> Result<(), Diagnostic> {
    let Some((option, _)) = options.into_iter().find(|&(_, is_given)| is_given) else { return Ok(()) };
    Err(Diagnostic::usage(format_args!("{option} has no effect: {why}"), format_args!("leave {option} out")))
}

/// The choice about files that stand where others are to be stored.
#[derive(Clone, Copy, Debug, Args)]
struct ForceArgs {
    /// Also replace files that tautline did not write, and those that keep work. A file that the command reads is
    /// never replaced.
    #[arg(long)]
    force: bool,
}

impl ForceArgs {
    /// The files that a command may replace which reads `inputs`.
    fn replaceable(&self, inputs: impl IntoIterator<Item = PathBuf>) -> Replaceable {
        Replaceable::new(if self.force { Foreign::Replace } else { Foreign::Keep }, inputs)
    }

    /// The files that a command stores, where they have a place, if it reads these.
    ///
    /// # Errors
    /// A [`Diagnostic`] if one of them has none, or there is nothing to force.
    fn files<const N: usize>(
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
    fn each(
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

    fn has_effect(&self, is_any_stored: bool) -> Result<(), Diagnostic> {
        refuse_needless([("--force", self.force && !is_any_stored)], "no file is to be stored")
    }
}

/// A cell as `X,Y`.
#[derive(Clone, Copy, Debug)]
struct CellArg(Cell);

impl FromStr for CellArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = text.split_once(',').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
        parts.map(|(x, y)| Self(Cell::new(x, y))).ok_or("write column and row as X,Y, for example 7,7")
    }
}

/// Columns and rows as `WxH`.
#[derive(Clone, Copy, Debug)]
struct SizeArg(Size);

impl FromStr for SizeArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = text.split_once('x').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
        let (width, height) = parts.ok_or("write columns and rows as WIDTHxHEIGHT, for example 7x7")?;
        let size = Size::new(width, height);
        size.map(Self).map_err(|problem| problem.to_string())
    }
}

/// A whole number above 0, of a type without 0.
fn positive<T: FromStr>(text: &str) -> Result<T, String> {
    let largest = u128::MAX >> (128 - 8 * size_of::<T>());
    text.parse().map_err(|_| format!("write a whole number from 1 to {largest}"))
}

/// Runs the program with the arguments of this process.
fn main() -> ExitCode {
    ascii::look_for(std::env::args_os());
    panic::set_hook(Box::new(|bug| {
        let arguments: Vec<String> = std::env::args().map(|argument| format!("{argument:?}")).collect();
        // Nobody may be there any more to read it.
        let _ = writeln!(
            ascii::Stderr,
            "This is a bug of tautline {}: {bug}\nPlease report it at {}/issues with this command: {}",
            env!("CARGO_PKG_VERSION"),
            env!("CARGO_PKG_REPOSITORY"),
            arguments.join(" ")
        );
    }));
    let arguments = with_negative_numbers(program()).try_get_matches();
    let read = arguments.and_then(|arguments| Ok((Cli::from_arg_matches(&arguments)?, arguments)));
    match read {
        Ok((cli, arguments)) => {
            guarded(|| command(&cli, arguments.subcommand_name().unwrap_or_default())).into()
        }
        Err(error) => told(&error).into(),
    }
}

/// Prints the help, the version, or what is wrong with the command line.
fn told(error: &clap::Error) -> Exit {
    let printed = match (ascii::is_asked(), error.use_stderr()) {
        (false, _) => error.print(),
        (true, true) => write!(ascii::Stderr, "{}", error.render()),
        (true, false) => io::stdout().write_all(ascii::plain(&error.render().to_string()).as_bytes()),
    };
    let printed = printed.and_then(|()| io::stdout().flush());
    match printed {
        _ if error.use_stderr() => Exit::Diagnostic,
        Err(fault) if fault.kind() != io::ErrorKind::BrokenPipe => {
            complain(&output::unwritable(&fault));
            Exit::Diagnostic
        }
        Ok(()) | Err(_) => Exit::Expected,
    }
}

/// The command line, as the help, the manual pages and the completions tell of it.
fn program() -> clap::Command {
    Cli::command()
}

/// A negative number where a number is wanted is a wrong number, not an unknown option.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let takes = |arg: clap::Arg| {
        let takes_values = arg.get_action().takes_values();
        arg.allow_negative_numbers(takes_values)
    };
    command.mut_args(takes).mut_subcommands(with_negative_numbers)
}

/// The answer about a check that is registered. One that cannot be decided, or panics, is a bug of ours.
fn registered<T>(answer: Result<T, MethodError>) -> T {
    answer.unwrap_or_else(|refused| panic!("a registered check is not decided: {refused}"))
}

/// Does `work`; a panic, of which the hook has told, is a bug.
fn guarded(work: impl FnOnce() -> Exit) -> Exit {
    panic::catch_unwind(AssertUnwindSafe(work)).unwrap_or(Exit::Bug)
}

/// Runs a command, and tells what went wrong.
fn command(cli: &Cli, name: &str) -> Exit {
    start_log(cli.verbose);
    let start = Instant::now();
    // Without the thread that listens, Ctrl-C would be taken from the system and heard by nobody.
    if threads::can_start() {
        interrupt::listen();
    } else {
        tracing::warn!("the system starts no thread: Ctrl-C will end the work at once");
    }
    threads::start();
    let mut out = Output::stdout();
    if let Some((Width(columns), _)) = io::stdout().is_terminal().then(terminal_size).flatten() {
        fit_into(columns.into());
    }
    let result = match &cli.command {
        Some(command) => command.run(cli.verbose > 0, &mut out),
        None => out.text(FIRST_STEPS).map(|()| Exit::Expected).map_err(Halt::from),
    };
    if result != Err(Halt::Interrupted) {
        out.place();
    }
    let result = result.and_then(|exit| {
        out.flush().map_err(|error| output::unwritable(&error))?;
        Ok(exit)
    });
    let exit = match result {
        Ok(exit) if out.has_left_out() => exit.max(Exit::Diagnostic),
        Ok(Exit::Violation) if cli.exit_zero => Exit::Expected,
        Ok(exit) => exit,
        Err(Halt::Diagnostic(fault)) => {
            complain(&fault);
            Exit::Diagnostic
        }
        Err(Halt::Interrupted) => {
            interrupt::tell_of_nothing();
            Exit::Unfinished
        }
    };
    tracing::info!("{name}: exit code {} after {:.3} s", exit.code(), start.elapsed().as_secs_f64());
    exit
}

/// Tells on stderr what went wrong, if anybody is there to read it.
fn complain(fault: &Diagnostic) {
    let _ = ascii::Stderr.write_all(render(fault, colour()).as_bytes());
}

impl Command {
    fn run(&self, is_verbose: bool, out: &mut Output) -> Result<Exit, Halt> {
        match self {
            Self::Prove(prove) => prove.run(is_verbose, out),
            Self::Library(library) => library.run(out),
            Self::Schemes(schemes) => schemes.run(out),
            Self::Explore(explore) => explore.run(out),
            Self::Hunt(hunt) => hunt.run(out),
            Self::Minimise(minimise) => minimise.run(out),
            Self::Rescue(rescue) => rescue.run(out),
            Self::Locate(locate) => locate.run(out),
            Self::Replay(replay) => replay.run(out),
            Self::Check(check) => check.run(out),
            Self::Conform(conform) => conform.run(out),
            Self::Judge(judge) => judge.run(out),
            Self::Page(page) => page.run(out),
            Self::Show(show) => show.run(out),
            #[cfg(feature = "papers")]
            Self::Reproduce(reproduce) => reproduce.run(out),
            Self::Merge(merge) => merge.run(out),
            #[cfg(feature = "mcp")]
            Self::Mcp(mcp) => mcp.run(out),
            Self::Completions { shell } => {
                let mut script = Vec::new();
                clap_complete::generate(*shell, &mut program(), "tautline", &mut script);
                out.bytes(&script)?;
                Ok(Exit::Expected)
            }
            Self::Man(manual) => manual.run(out),
        }
    }
}

fn colour() -> Colour {
    if ascii::is_asked() {
        return Colour::Ascii;
    }
    let is_refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if io::stderr().is_terminal() && !is_refused { Colour::Ansi } else { Colour::Plain }
}

fn start_log(verbose: u8) {
    let level = match verbose {
        0 => tracing::Level::WARN,
        1 => tracing::Level::INFO,
        2.. => tracing::Level::DEBUG,
    };
    let log = tracing_subscriber::fmt()
        .with_max_level(level)
        .with_writer(|| ascii::Stderr)
        .with_ansi(colour() == Colour::Ansi)
        .without_time()
        .with_target(false);
    // In a process that has a log already, that one serves.
    let _ = log.try_init();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_panic_is_a_bug_of_ours() {
        assert_eq!(guarded(|| Exit::Violation), Exit::Violation);
        assert_eq!(guarded(|| panic!("on purpose")), Exit::Bug);
        assert_eq!(Exit::Bug.code(), 70);
    }
}
