//! `tautline reproduce`: tables again. The catalogue of tables says what can be asked, and does the work.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, Subcommand};
use indicatif::ProgressBar;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::Plan;
use tautline_io::value_parser::whole;
use tautline_papers::shards::{deal_table, restored, table_part};
use tautline_papers::tables::parameter::{TableOption, Values};
use tautline_papers::tables::{Description, Entry, Experiment, Observer, Report, TABLES, find};
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::plural::counted;

use super::exit::Exit;
use super::options::{ForceArgs, Format, FormatArgs};
use super::output::{self, Output, SCHEMA_VERSION};
use super::{ascii, interrupt, progress, shards};

const EXAMPLES: &str = "\
Examples:
  tautline reproduce
  tautline reproduce repair-cost
  tautline reproduce repair-cost --help
  tautline reproduce repair-cost --plan plan.json --shards 7
  tautline reproduce --plan plan.json --shard 1";

/// Measure a table again; without an id, list them.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
#[command(subcommand_value_name = "ID", subcommand_help_heading = "Tables")]
pub(super) struct Reproduce {
    #[command(subcommand)]
    table: Option<Request>,
    /// A plan, as `reproduce ID --plan FILE --shards N` makes it.
    #[arg(long, value_name = "FILE", requires = "shard")]
    plan: Option<PathBuf>,
    /// Run shard K of the plan, from 1 on, and keep how far it is beside the plan; if it was begun, go on.
    #[arg(long, value_name = "K", value_parser = whole::<u32>, requires = "plan")]
    shard: Option<u32>,
    #[command(flatten)]
    format: FormatArgs,
}

/// A table, and what is asked of it.
#[derive(Debug)]
struct Request {
    table: &'static dyn Entry,
    /// The options that are given, with their values.
    given: Vec<(String, Vec<String>)>,
    /// Those that the user has typed, as a shell takes them.
    typed: String,
    /// Its pictures.
    pictures: Pictures,
    /// Where its values are to be stored.
    csv: Option<PathBuf>,
    /// The plan to be made instead, and its shards.
    dealt: Option<(PathBuf, u32)>,
    force: ForceArgs,
    format: FormatArgs,
}

#[derive(JsonSchema, Serialize)]
struct ListItem {
    id: &'static str,
    shows: &'static str,
    /// How long it takes by its own settings on two cores, roughly.
    takes: &'static str,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct List {
    reproductions: Vec<ListItem>,
}

impl Reproduce {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        match (&self.table, &self.plan, self.shard) {
            (Some(wanted), ..) => wanted.run(out),
            (None, Some(path), Some(shard)) => {
                let plan = Plan::read(path)?;
                let asked = restored(&plan)?;
                shards::run(&plan, shard, self.format.format, out, |far| {
                    table_part(&plan, &*asked, shard, far)
                })
            }
            (None, ..) => self.list(out),
        }
    }

    fn list(&self, out: &mut Output) -> Result<Exit, Halt> {
        let about = TABLES.iter().map(|table| table.about());
        let reproductions: Vec<ListItem> =
            about.map(|about| ListItem { id: about.id, shows: about.shows, takes: about.takes }).collect();
        match self.format.format {
            Format::Json => out.json(&List { reproductions })?,
            Format::Text => {
                for ListItem { id, shows, takes } in reproductions {
                    out.text(format_args!("{id} ({takes}): {shows}\n"))?;
                }
            }
        }
        Ok(Exit::Expected)
    }
}

impl Request {
    fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let asked = self.table.asked(&self.given)?;
        if let Some((path, shards)) = &self.dealt {
            return self.deal(&*asked, path, *shards, out);
        }
        let files = Files::of(self.pictures.clone(), self.csv.clone(), (&self.force, []))?;
        let Description { id, doing, .. } = self.table.about();
        match Show::over(doing, |show| asked.run(show)) {
            (Err(Halt::Interrupted), [done, parts]) => {
                let left =
                    InterruptedTable { id, complete: false, parts, parts_done: done, typed: &self.typed };
                match self.format.format {
                    Format::Json => out.json(&left)?,
                    Format::Text => out.text(left)?,
                }
                Ok(Exit::Unfinished)
            }
            (made, _) => tell(&*made?, files, self.format.format, out),
        }
    }

    /// Deals the jobs of the table out among shards.
    fn deal(&self, asked: &dyn Experiment, path: &Path, shards: u32, out: &mut Output) -> Result<Exit, Halt> {
        if self.csv.is_some() || self.pictures.iter().any(|(_, path)| path.is_some()) {
            let remedy = "leave them out, and give tautline merge a --picture and --csv";
            return Err(Diagnostic::usage("a plan has no pictures and no values", remedy).into());
        }
        Plan::check(shards)?;
        let (of, deal, jobs) = deal_table(self.table.about().id, asked)?;
        let words = format!("{} for {}.", counted(jobs, "job"), counted(shards, "shard"));
        let how = (&self.force, self.format.format);
        shards::plan((path, shards), (of, &deal), (&PlanFacts { jobs }, &words), how, out)
    }
}

/// The facts of a plan, for programs.
#[derive(JsonSchema, Serialize)]
pub(super) struct PlanFacts {
    jobs: usize,
}

/// A table that a signal has left: of some of its parts no figure is made.
#[derive(JsonSchema, Serialize)]
pub(super) struct InterruptedTable<'a> {
    id: &'static str,
    /// False.
    complete: bool,
    parts: u64,
    parts_done: u64,
    /// The options of the table that the user has typed.
    #[serde(skip)]
    typed: &'a str,
}

impl fmt::Display for InterruptedTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { id, parts, parts_done, typed, .. } = self;
        writeln!(
            f,
            "A signal ended the work: {parts_done} of {} of {id} are done, and of a part no figure is claimed.\n\
             To go on after a signal, deal the table out: tautline reproduce {id}{typed} --plan plan.json --shards 1,\n\
             and then tautline reproduce --plan plan.json --shard 1 until it is done; tautline merge plan.json.",
            counted(*parts, "part"),
        )
    }
}

/// The names of pictures, and where each is to be stored.
pub(super) type Pictures = Vec<(String, Option<PathBuf>)>;

/// The files that a table is stored in, begun.
pub(super) struct Files {
    /// By the name of a picture.
    pictures: Vec<(String, AtomicFile)>,
    csv: Option<AtomicFile>,
}

impl Files {
    /// The pictures that have a place, and the values, of a command that reads these files.
    ///
    /// # Errors
    /// A [`Diagnostic`] if one of them has none, or there is nothing to force.
    pub(super) fn of(
        pictures: Pictures,
        csv: Option<PathBuf>,
        (force, inputs): (&ForceArgs, impl IntoIterator<Item = PathBuf>),
    ) -> Result<Self, Diagnostic> {
        let (names, mut paths): (Vec<String>, Vec<_>) = pictures.into_iter().unzip();
        paths.push(csv);
        let mut files = force.each(&paths, inputs)?;
        let csv = files.pop().flatten();
        let pictures = names.into_iter().zip(files);
        Ok(Self { pictures: pictures.filter_map(|(name, file)| Some((name, file?))).collect(), csv })
    }
}

/// Stores a table in its files, and tells of it.
pub(super) fn tell(made: &dyn Report, files: Files, format: Format, out: &mut Output) -> Result<Exit, Halt> {
    for (name, file) in files.pictures {
        out.store(Some(file), |file| file.draw(made.picture(&name)))?;
    }
    out.store(files.csv, |file| file.draw(Ok(made.csv(SCHEMA_VERSION)?)))?;
    match format {
        Format::Json => out.text(ascii::json(made.json(SCHEMA_VERSION)?) + "\n")?,
        Format::Text => out.text(made.text()?)?,
    }
    Ok(if made.is_broken() { Exit::Violation } else { Exit::Expected })
}

impl Subcommand for Request {
    fn augment_subcommands(command: Command) -> Command {
        TABLES.iter().fold(command, |command, &table| command.subcommand(subcommand(table)))
    }

    fn augment_subcommands_for_update(command: Command) -> Command {
        Self::augment_subcommands(command)
    }

    fn has_subcommand(name: &str) -> bool {
        find(name).is_some()
    }
}

impl FromArgMatches for Request {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let missing = || Error::raw(ErrorKind::MissingSubcommand, "an id of a table is missing");
        let (id, matches) = matches.subcommand().ok_or_else(missing)?;
        let table = find(id).ok_or_else(missing)?;
        let given = |option: TableOption| match option.values {
            Values::None => matches.get_flag(option.name).then(|| (option.name.to_owned(), Vec::new())),
            Values::One | Values::Word(_) | Values::List | Values::Repeated => {
                let texts = matches.get_many::<String>(option.name)?;
                Some((option.name.to_owned(), texts.cloned().collect()))
            }
        };
        let path = |name: &str| matches.get_one::<PathBuf>(name).cloned();
        let pictures = table.about().pictures.iter().map(|&(name, _)| (name.to_owned(), path(name)));
        let dealt = path("plan").zip(matches.get_one::<u32>("shards").copied());
        let given: Vec<_> = table.options().into_iter().filter_map(|(option, _)| given(option)).collect();
        Ok(Self {
            table,
            typed: typed(table, &given, |name| matches.value_source(name) == Some(ValueSource::CommandLine)),
            given,
            pictures: pictures.collect(),
            csv: path("csv"),
            dealt,
            force: ForceArgs::from_arg_matches(matches)?,
            format: FormatArgs::from_arg_matches(matches)?,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The options of a table that the user has typed, as a shell takes them, a blank before each.
fn typed(table: &dyn Entry, given: &[(String, Vec<String>)], is_typed: impl Fn(&str) -> bool) -> String {
    let word = |(name, texts): &(String, Vec<String>)| {
        let is_list =
            table.options().iter().any(|(option, _)| option.name == name && option.values == Values::List);
        let texts = if is_list { vec![texts.join(",")] } else { texts.clone() };
        match texts[..] {
            [] => format!(" --{name}"),
            _ => texts
                .iter()
                .map(|text| format!(" --{name}={}", output::argument(text)))
                .collect::<Vec<_>>()
                .concat(),
        }
    };
    given.iter().filter(|(name, _)| is_typed(name)).map(word).collect()
}

/// The command that measures a table.
fn subcommand(table: &'static dyn Entry) -> Command {
    let options = table.options().into_iter().map(|(option, default)| argument(table, option, default));
    let mut command = Command::new(table.about().id).args(options);
    let file = |&(name, about): &(&'static str, &'static str)| {
        let path = clap::value_parser!(PathBuf);
        Arg::new(name).long(name).value_name("FILE").help(about).value_parser(path)
    };
    let shards =
        Arg::new("shards").long("shards").value_name("N").requires("plan").value_parser(whole::<u32>);
    command = command.args(table.about().pictures.iter().map(file)).args([
        file(&("csv", "Store the values of the table as comma-separated values")),
        file(&("plan", "Measure nothing yet, but store a plan in FILE")).requires("shards"),
        shards.help("Deal the jobs out among N shards, each to be run on any machine"),
    ]);
    command = ForceArgs::augment_args(command);
    // What is said of the table comes last: options that are flattened in say something, too.
    let Description { help, more, examples, takes, .. } = table.about();
    let examples = examples.iter().map(|example| format!("\n  tautline reproduce {example}"));
    let examples = "Examples:".to_owned() + &examples.collect::<String>();
    let examples = format!("{examples}\n\nBy its own settings it takes {takes} on two cores.");
    let command = FormatArgs::augment_args(command).about(help).after_help(examples);
    if more.is_empty() { command } else { command.long_about(format!("{help}.\n\n{more}")) }
}

/// An option of a table. Values are checked as they are read, so that what is wrong is told of the option.
fn argument(table: &'static dyn Entry, option: TableOption, default: Vec<String>) -> Arg {
    let name = option.name;
    let argument = Arg::new(name).long(name).help(option.about);
    if option.values == Values::None {
        return argument.action(ArgAction::SetTrue);
    }
    let checked = move |text: &str| table.check(name, text).map(|()| text.to_owned());
    let argument = argument.value_name(option.value).default_values(default);
    match option.values {
        Values::None | Values::One => argument.value_parser(checked),
        Values::Word(words) => {
            let words = words.into_iter().map(|(word, about)| PossibleValue::new(word).help(about));
            argument.value_parser(PossibleValuesParser::new(words))
        }
        Values::List => argument.value_parser(checked).value_delimiter(',').action(ArgAction::Append),
        Values::Repeated => {
            argument.value_parser(checked).allow_hyphen_values(true).action(ArgAction::Append)
        }
    }
}

/// Shows how far a table is.
struct Show {
    doing: &'static str,
    bar: ProgressBar,
    parts: AtomicU64,
    done: AtomicU64,
}

impl Show {
    /// Does the work under a bar. How many parts are done comes out, too, and how many there are.
    fn over<T>(
        doing: &'static str,
        work: impl FnOnce(&Self) -> Result<T, Halt>,
    ) -> (Result<T, Halt>, [u64; 2]) {
        interrupt::defer();
        let start = Instant::now();
        let (parts, done) = (AtomicU64::new(0), AtomicU64::new(0));
        let show = Self { doing, bar: progress::bar(doing, 1), parts, done };
        let result = work(&show);
        show.bar.finish_and_clear();
        let counts @ [done, parts] = [&show.done, &show.parts].map(|count| count.load(Ordering::Relaxed));
        tracing::info!("{doing}: {done} of {parts} in {:.3} s", start.elapsed().as_secs_f64());
        (result, counts)
    }
}

impl Observer for Show {
    fn begin(&self, parts: u64) {
        self.parts.store(parts, Ordering::Relaxed);
        self.bar.set_length(parts);
    }

    fn done(&self, parts: u64) -> Result<(), Halt> {
        let before = self.done.fetch_add(parts, Ordering::Relaxed);
        progress::tell_of_part(self.doing, before + parts, self.parts.load(Ordering::Relaxed));
        // A search may have had the bar to itself.
        if self.bar.prefix() == self.doing {
            self.bar.inc(parts);
        } else {
            self.bar.reset();
            self.bar.set_prefix(self.doing);
            self.bar.set_message("");
            self.bar.set_length(self.parts.load(Ordering::Relaxed));
            self.bar.set_position(before + parts);
        }
        interrupt::check()
    }

    fn searched(&self, what: &str, progress: &Progress<'_>) -> Result<(), Halt> {
        if self.bar.prefix() != what {
            self.bar.reset();
            self.bar.set_prefix(what.to_owned());
        }
        if progress::show(&self.bar, progress).is_break() { Err(Halt::Interrupted) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hint_after_a_signal_has_the_options_that_the_user_has_typed() {
        let line = "reproduce notice-fig5 --nodes 300,500 --k 1,3 --runs 5000 --csv values.csv";
        let matches =
            Request::augment_subcommands(Command::new("reproduce")).get_matches_from(line.split(' '));
        let request = Request::from_arg_matches(&matches).expect("a request");
        assert_eq!(request.typed, " --nodes=300,500 --k=1,3 --runs=5000");
    }
}
