//! The command line: what is asked, where it goes, and with which exit code it ends. Data goes to stdout, progress and
//! logs to stderr. A fault ends a command with code 2, an interruption with 3, a panic, which is a bug of ours,
//! with 70. A file that cannot be stored is left out: the rest is given all the same, and the code is 2.

mod ascii;
mod catalogue;
mod check;
mod conform;
#[cfg(test)]
mod docs_test;
mod evidence;
mod exit;
mod explore;
mod findings;
mod folder;
mod hunt;
mod interrupt;
mod judge;
mod layout_args;
mod library;
mod locate;
mod manual;
#[cfg(feature = "mcp")]
mod mcp;
mod merge;
mod minimise;
mod options;
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

use std::io::{self, IsTerminal, Write};
use std::panic::{self, AssertUnwindSafe};
use std::process::ExitCode;
use std::time::Instant;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use clap_complete::Shell;
use tautline_io::diagnostic::Halt;
use tautline_io::text_blocks::fit_into;
use terminal_size::{Width, terminal_size};

use crate::exit::{EXIT_CODES, Exit};
use crate::output::{Output, colour, complain};
use crate::report::Colour;

#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

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

/// The fate of files.
const FILES: &str = "\
Files stand in their places whole or not at all, those of one command together at its end. A file that cannot be \
stored is left out, the others are stored all the same, and the exit code is 2. Only a process that ends \
by a signal other than Ctrl-C, SIGTERM and SIGHUP can leave a file .tautline-….part behind, which nobody needs.";

const LAYOUTS: &str = "\
LAYOUT is a file (our text drawing, a MovingAI .map, a ROS .yaml) or a generator: open:15x15 · walls:15x15:0.1 · \
rooms-a · rooms-b · office:30x30:4x4 · cells:32x32:0.2";

/// The heading of the options that every command has.
const EVERYWHERE: &str = "Options of every command";

/// Verified multi-robot coordination: bounded proofs, counterexamples and simulation.
#[derive(Debug, Parser)]
#[command(name = "tautline", version, about, max_term_width = 100)]
#[command(after_help = format!("Exit codes: {EXIT_CODES}\n\n{FILES}\n\n{LAYOUTS}"))]
struct Cli {
    /// Tell more on stderr; twice for everything.
    #[arg(short, long, global = true, help_heading = EVERYWHERE, action = clap::ArgAction::Count)]
    verbose: u8,
    /// End with 0 where a violation was found, for engines that try again what fails.
    #[arg(long, global = true, help_heading = EVERYWHERE)]
    exit_zero: bool,
    /// Print ASCII alone: drawings, text and JSON. Files are stored as ever.
    #[arg(long, global = true, help_heading = EVERYWHERE)]
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
    Merge(merge::Merge),
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
        Err(error) => told(&with_names(error)).into(),
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

/// The error with the names that a command knows, where it was given another one, and none is like it.
fn with_names(mut error: clap::Error) -> clap::Error {
    let is_told = error.get(ContextKind::SuggestedSubcommand).is_some();
    let Some(word) = error.get(ContextKind::InvalidSubcommand).filter(|_| !is_told).cloned() else {
        return error;
    };
    let usage = error.get(ContextKind::Usage).map(ToString::to_string).unwrap_or_default();
    let mut program = program();
    program.build();
    let command = by_usage(&mut program, &usage);
    if let Some(command) = command.filter(|command| command.find_subcommand(word.to_string()).is_none()) {
        // Behind an option such a word is said to conflict with it.
        if error.kind() == ErrorKind::ArgumentConflict {
            let usage = command.clone().render_usage();
            error = clap::Error::new(ErrorKind::InvalidSubcommand).with_cmd(command);
            error.insert(ContextKind::InvalidSubcommand, word);
            error.insert(ContextKind::Usage, ContextValue::StyledStr(usage));
        }
        let names: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        let of = command.get_subcommand_help_heading().unwrap_or("commands").to_lowercase();
        let tip = format!("the {of} are {}", names.join(", "));
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

/// The command with others in it of which this is the usage: an error tells no more of where it is.
fn by_usage<'a>(command: &'a mut clap::Command, usage: &str) -> Option<&'a clap::Command> {
    if command.has_subcommands() && command.render_usage().to_string() == usage {
        return Some(command);
    }
    command.get_subcommands_mut().find_map(|command| by_usage(command, usage))
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
            Self::Man(manual) => manual.run(program(), out),
        }
    }
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
