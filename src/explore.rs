//! `tautline explore`: one run.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::num::NonZeroU32;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::error::ErrorKind;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, ValueEnum};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::json_lines;
use tautline_io::svg::Panel;
use tautline_io::text_blocks::Rows;
use tautline_io::value_parser::whole;
use tautline_kernel::ground::Cell;
use tautline_proofs::plural::counted;

use super::catalogue::CATALOGUE;
use super::exit::Exit;
use super::layout_args::LayoutArgs;
use super::options::{ForceArgs, Format, FormatArgs, refuse_needless};
use super::output::Output;
use super::value_parser::{CellArg, chosen, positive};
use super::viewers::{self, ViewerArgs};
use super::{evidence, progress, ros_map};
use crate::value_parser;
use tautline_grids::chance::Probability;
use tautline_sim::counterexample::refutation;
use tautline_sim::draw::story::words_of;
use tautline_sim::draw::{page, svg};
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::floor::Component;
use tautline_sim::explore::{
    ExplorationRequest, Knowledge, Limits, Milestone, OnViolation, Play, Profile, Reach, Report, RuleId,
    Scheme, Senses, Setup, StopReason, Violation, explore, team,
};
use tautline_sim::failures::Failures;
use tautline_sim::options::{Extra, Options, Takes, Wrong};
use tautline_sim::trace::{Summary, Trace};
use tautline_sim::{draw, objects, trace};

const EXAMPLES: &str = "\
Examples:
  tautline explore open:15x15 --robots 8 --draw order
  tautline explore walls:15x15:0.1 --seed 7 --rule published --trace run.jsonl --html run.html
  tautline explore room-32-32-4.map --robots 16 --base 10,12 --format json
  tautline explore office:30x30:4x4 --scheme bricks --robots 20 --html run.html
  tautline explore office:30x30:4x4 --scheme bricks-ants --robots 2 --miss 0.0556 --start 0,0 --start 29,29";

/// Explore a layout once, and check every team move.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Explore {
    #[command(flatten)]
    layout: LayoutArgs,
    /// How the team explores. Without it as the stored run says, or `chain`.
    #[arg(long, value_parser = value_parser::scheme())]
    scheme: Option<Scheme>,
    /// One of the scheme's rules, which `tautline schemes` lists. Without it as the stored run says, or the repaired
    /// one, if there is one.
    #[arg(long, value_parser = value_parser::rule(), hide_possible_values = true)]
    rule: Option<RuleId>,
    /// Robots or agents; for the chain the base is one of them. Without it the layout says, or there are 8.
    #[arg(long, value_name = "N", value_parser = whole::<u64>)]
    robots: Option<u64>,
    /// Column and row of the base. Without it the layout says, or it is the free cell nearest the centre.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    base: Option<CellArg>,
    /// Column and row where the agents start; once for all, or once for each. Without it they start at the base.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, conflicts_with = "base")]
    start: Vec<CellArg>,
    /// How likely it is that an agent misses a sensor, from 0 to 1. Without it 0.
    #[arg(long, value_name = "PROBABILITY", allow_hyphen_values = true)]
    #[arg(help_heading = heading(|scheme| scheme.senses == Senses::Floor))]
    miss: Option<Probability>,
    #[command(flatten)]
    told: SchemeOptions,
    /// Stop when a robot has entered so many cells.
    #[arg(long, value_name = "CELLS", value_parser = positive::<NonZeroU32>)]
    max_moves: Option<NonZeroU32>,
    /// Stop when so many percent of the free cells in reach are explored.
    #[arg(long, value_parser = chosen::<Milestone>(), value_name = "50|75|100", hide_possible_values = true)]
    until: Option<Milestone>,
    /// Store the run as JSON lines.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    #[command(flatten)]
    viewers: ViewerArgs,
    /// Store the run as a page that plays it.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Store what robots have mapped as a map of ROS: FILE ends in `.yaml`, and its image `.pgm` stands beside it.
    /// Cells lie as in the map of ROS that is explored; else each is a metre wide.
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// The drawing to print. Without it the outcome is drawn, if the area is small.
    #[arg(long, value_enum)]
    draw: Option<Draw>,
    /// Store the drawing as a picture: the order, or with `--draw moves` every team move, or with `--draw map` the map.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// The heading in the help above the options that only such schemes can be told.
fn heading(is_told: impl Fn(&Profile) -> bool) -> String {
    let names = CATALOGUE.names(is_told);
    match names.split_last() {
        Some((last, before @ [_, ..])) => format!("Options of {} and {last}", before.join(", ")),
        _ => format!("Options of {}", names.concat()),
    }
}

/// The options of schemes that are told, each by its own name.
#[derive(Debug, Default)]
struct SchemeOptions {
    /// Each with its word, which can be read.
    words: Vec<(&'static Extra, String)>,
    /// The fault, if something is told twice.
    wrong: Option<Wrong>,
}

impl Args for SchemeOptions {
    fn augment_args(command: Command) -> Command {
        command.args(Extra::ALL.map(|extra| {
            let heading = heading(|scheme| scheme.extras.contains(&extra));
            let arg = Arg::new(extra.field).long(extra.field).help(extra.about).help_heading(heading);
            let arg = arg.aliases(extra.alias);
            let read = |text: &str| (extra.read)(text, &mut Options::default()).map(|()| text.to_owned());
            match extra.takes {
                Takes::Nothing => arg,
                Takes::Word(name) | Takes::Real(name) => {
                    arg.value_name(name).value_parser(read).allow_hyphen_values(true)
                }
            }
            .action(match (extra.takes, extra.twice) {
                (Takes::Nothing, _) => ArgAction::SetTrue,
                (_, None) => ArgAction::Set,
                (_, Some(_)) => ArgAction::Append,
            })
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SchemeOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut told = Self::default();
        told.update_from_arg_matches(matches)?;
        Ok(told)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        for extra in Extra::ALL {
            let words: Vec<&str> = match extra.takes {
                Takes::Nothing => Some("").filter(|_| matches.get_flag(extra.field)).into_iter().collect(),
                Takes::Word(_) | Takes::Real(_) => matches
                    .get_many::<String>(extra.field)
                    .into_iter()
                    .flatten()
                    .map(String::as_str)
                    .collect(),
            };
            if let Some(&word) = words.first() {
                (extra.read)(word, &mut Options::default())
                    .map_err(|what| Error::raw(ErrorKind::ValueValidation, what))?;
                self.words.push((extra, word.to_owned()));
            }
            if let ([one, other, ..], Some(twice)) = (&words[..], extra.twice) {
                self.wrong = Some(twice(one, other));
            }
        }
        Ok(())
    }
}

/// The drawing of a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Draw {
    /// In each cell, in which team move it was explored.
    Order,
    /// Every team move.
    Moves,
    /// The map that robots have made; objects are drawn in a picture of it.
    Map,
}

/// The scheme that is taken where nobody says which.
const DEFAULT_SCHEME: &Profile = &CHAIN;

/// Wider areas are drawn only when asked for.
const SMALL_COLUMNS: usize = 33;

impl Explore {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let setup = self.setup()?;
        let frame = self.map.as_ref().map(|map| ros_map::frame(map, &self.layout, &setup)).transpose()?;
        let [itf, mcap] = self.viewers.paths();
        let grid = self.map.as_ref().map(|map| map.with_extension("pgm"));
        let files = [&self.trace, &self.html, &self.svg, itf, mcap, &self.map, &grid];
        let [trace, page, picture, itf, mcap, map, grid] = self.force.files(files, self.layout.inputs())?;
        if page.is_some() || picture.is_some() {
            svg::check_size(team(&setup)?.area(&setup.layout))?;
        }
        let writer = trace.map(|file| trace::Writer::new(file, &setup, None));
        let mut writer = writer.transpose()?;
        let (bar, start) = (progress::spinner("exploring"), Instant::now());
        let report = explore(&setup, &mut |made| {
            bar.set_message(format!("team move {}", made.step));
            if let Some(writer) = &mut writer {
                writer.add(made);
            }
            Ok(())
        })?;
        bar.finish_and_clear();
        tracing::info!("explored in {:.3} s", start.elapsed().as_secs_f64());
        for (field, step) in setup.options.due_after(report.steps) {
            let moves = counted(report.steps, "team move");
            tracing::warn!("--{field} never happened: it is for team move {step}, and the run has {moves}");
        }
        if let Some(writer) = writer {
            out.keep(writer.end(&report));
        }
        let generator = self.layout.layout.parse().ok();
        let run = (&setup as _, generator.as_ref());
        out.store(page, |page| page::write_in(page, run, &report, &(1..=report.steps)))?;
        viewers::store([itf, mcap], &setup, out)?;
        if let (Some(mut map), Some(mut grid), Some(frame)) = (map, grid, frame) {
            grid.append(ros_map::image(&setup, &report));
            let name = grid.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
            map.append(ros_map::description(&name, frame, &setup, &report));
            // A map without its image is none.
            if out.keep(grid) {
                out.keep(map);
            }
        }
        let drawn = |panel: Panel| Ok(Panel::picture(&setup.title(), &[panel]));
        out.store(picture, |picture| {
            picture.draw(match self.draw {
                Some(Draw::Moves) => svg::team_moves(&setup, &report, &(1..=report.steps)),
                Some(Draw::Map) => drawn(svg::map(&setup, &report)),
                Some(Draw::Order) | None => drawn(svg::order(&setup, &report.chart)),
            })
        })?;
        match self.format.format {
            Format::Json => out.json(&Summary::new(&setup, &self.layout.layout, &report))?,
            Format::Text => {
                out.text(summary(&setup, &self.layout.layout, &report))?;
                self.draw(&setup, &report, out)?;
            }
        }
        Ok(if report.violations.is_empty() { Exit::Expected } else { Exit::Violation })
    }

    fn setup(&self) -> Result<Setup, Halt> {
        if let Some((what, remedy)) = &self.told.wrong {
            return Err(Diagnostic::usage(what, remedy).into());
        }
        let is_undrawn = self.format.format == Format::Json && self.svg.is_none();
        let why = "JSON has no drawing, and no picture is stored";
        refuse_needless([("--draw", self.draw.is_some() && is_undrawn)], why)?;
        let stored = self.stored()?;
        let asked = self.asked(stored.as_ref());
        asked.check()?;
        let layout = stored.map_or_else(|| self.layout.load(), |stored| Ok(stored.layout))?;
        let setup = asked.setup(layout)?;
        if self.layout.has_other_seed() && !setup.scheme.draws(&setup) {
            return Err(setup.scheme.needless_seed().into());
        }
        for (extra, _) in &self.told.words {
            setup.check_effect(extra)?;
        }
        Ok(setup)
    }

    /// The run that is stored in the file that is named in place of a layout, if one is.
    fn stored(&self) -> Result<Option<Setup>, Halt> {
        let file = Path::new(&self.layout.layout);
        let setup = match json_lines::format(file).as_deref() {
            Some(trace::FORMAT) => Trace::open(file, CATALOGUE)?.setup,
            Some(refutation::FORMAT) => evidence::stored(file)?,
            Some(_) | None => return Ok(None),
        };
        self.layout.refuse_map_options("a stored run has its layout")?;
        Ok(Some(setup))
    }

    /// The request; whatever nobody says is that of the stored run, where there is one of the scheme.
    fn asked(&self, stored: Option<&Setup>) -> ExplorationRequest {
        let scheme = self.scheme.or(stored.map(|run| run.scheme)).unwrap_or_else(|| DEFAULT_SCHEME.into());
        let stored = stored.filter(|run| run.scheme == scheme);
        let mut asked = stored.map_or_else(
            || ExplorationRequest::new(scheme, scheme.default_rule()),
            ExplorationRequest::again,
        );
        asked.rule = self.rule.unwrap_or(asked.rule);
        asked.robots = self.robots.or(asked.robots);
        asked.seed = self.layout.seed.unwrap_or(asked.seed);
        if self.base.is_some() || !self.start.is_empty() {
            asked.base = self.base.map(|CellArg(cell)| cell);
            asked.starts = self.start.iter().map(|&CellArg(cell)| cell).collect();
        }
        asked.miss = self.miss.or(asked.miss);
        for (extra, word) in &self.told.words {
            // Each word was read before.
            let _ = (extra.read)(word, &mut asked.options);
        }
        asked.limits = Limits { until: self.until, max_moves: self.max_moves, violation: OnViolation::GoOn };
        asked
    }

    fn draw(&self, setup: &Setup, report: &Report, out: &mut Output) -> Result<(), Halt> {
        match self.draw {
            Some(Draw::Order) => out.text(format_args!("\n{}", draw::order(setup, &report.chart)))?,
            Some(Draw::Moves) => {
                draw_moves(setup, report, &DrawnMoves::All(1..=report.steps), draw::Pose::Before, out)?;
            }
            None if report.chart.area().width() > SMALL_COLUMNS => {}
            Some(Draw::Map) | None => {
                out.text(format_args!("\n{}", draw::outcome(setup, &report.chart, &report.team)))?;
            }
        }
        Ok(())
    }
}

/// Lines that the drawings of team moves take up where nobody says which moves.
const MOST_LINES: usize = 500;

/// The team moves that are drawn.
pub(super) enum DrawnMoves {
    /// These, however many lines they take.
    All(RangeInclusive<u32>),
    /// Of these the last ones, as many as fit.
    Last(RangeInclusive<u32>),
}

/// Draws the team moves that are `wanted`, a row at a time; which ones are drawn.
pub(super) fn draw_moves(
    run: &dyn Play,
    report: &Report,
    wanted: &DrawnMoves,
    pose: draw::Pose,
    out: &mut Output,
) -> Result<RangeInclusive<u32>, Halt> {
    let drawn = draw::TeamMoves::new(run, &report.chart);
    let (DrawnMoves::All(moves) | DrawnMoves::Last(moves)) = wanted;
    let mut columns = None;
    run.among(moves, &mut |made| {
        columns = columns.max(Some(drawn.columns(made, pose)));
        Ok(())
    })?;
    let Some(columns) = columns else { return Ok(moves.clone()) };
    let moves = match wanted {
        DrawnMoves::All(moves) => moves.clone(),
        DrawnMoves::Last(moves) => {
            let most = drawn.fitting(columns, MOST_LINES);
            *moves.start().max(&(moves.end() + 1).saturating_sub(most))..=*moves.end()
        }
    };
    out.text(format_args!("\n{}\n\n", drawn.legend(pose)))?;
    let mut rows = Rows::new(columns);
    run.among(&moves, &mut |made| {
        if out.is_gone() {
            return Ok(());
        }
        Ok(out.text(rows.add(drawn.draw(made, pose)))?)
    })?;
    out.text(rows.rest())?;
    Ok(moves)
}

/// How much is explored, and since when; nothing of a team that is not to explore.
fn explored(report: &Report) -> String {
    let Some(percent) = (report.explored * 100).checked_div(report.cells) else { return String::new() };
    let mut text = format!("{} of {} explored ({percent} %)", report.explored, counted(report.cells, "cell"));
    for milestone in Milestone::ALL {
        // Writing to a string cannot fail.
        let _ = match report.reached(milestone) {
            Some(step) => write!(text, ", {} % at team move {step}", milestone.percent()),
            None => write!(text, ", {} % never", milestone.percent()),
        };
    }
    text + "\n"
}

/// The outcome of a run, in a few lines.
pub(super) fn summary(run: &dyn Play, layout: &str, report: &Report) -> String {
    let mut text = format!(
        "{}, {}: {layout}\n{}: {}\n",
        run.setup().title(),
        place(run.setup()),
        counted(report.steps, "team move"),
        report.stop_words(),
    );
    text += &explored(report);
    text += &reach(run.setup(), report.explored);
    if let Some(milliseconds) = report.milliseconds {
        let robot = run.setup().scheme.look.robot();
        let _ = writeln!(text, "the slowest {robot} took {} s", milliseconds / 1000);
    }
    if let Some(failures) = &report.failures {
        text.push_str(&failed(failures));
    }
    text += &objects::table(&report.objects);
    match run.setup().scheme.knowledge {
        None => {}
        Some(Knowledge::None) => {
            text.push_str("ants never know that they are done: whoever watches them ends the run\n");
            text.push_str(&components(report, |_| String::new()));
        }
        Some(Knowledge::Visited) => {
            let words = |Component { active, visited, .. }: &Component| {
                let ends =
                    if *active == 0 { "every agent is done".to_owned() } else { format!("{active} go on") };
                format!(", {visited} visited; {ends}")
            };
            let whole = report.whole();
            let (percent, cells) = (whole.visited * 100 / whole.cells, counted(whole.cells, "cell"));
            let ends = match (whole.active, report.stopped) {
                (0, _) if whole.explored < whole.cells => {
                    let left = counted(whole.cells - whole.explored, "cell");
                    format!("every agent is done, with {left} unexplored")
                }
                (0, _) => "every agent knows that it is done".to_owned(),
                (active, StopReason::Explored) => format!(
                    "{active} of {} may never be done: whoever watches the agents ends the run",
                    counted(whole.robots, "agent")
                ),
                (active, _) => format!("{active} of {} not done", counted(whole.robots, "agent")),
            };
            let _ = writeln!(text, "{} of {cells} visited ({percent} %); {ends}", whole.visited);
            text.push_str(&components(report, words));
        }
    }
    text + &violations(run, report) + &excuse(run.setup(), report)
}

/// How far the team comes, if there is more than it has `explored`.
fn reach(setup: &Setup, explored: u32) -> String {
    let reach = team(setup).ok().and_then(|team| team.reach(&setup.layout));
    match reach.filter(|reach| reach.connected > explored as usize) {
        Some(Reach { cells, connected, robots }) => format!(
            "{cells} of {} are within {} of the base, the reach of this {}, which may explore others beside it; the \
             reach of one of {robots} robots has all {connected} that are connected with the base\n",
            counted(setup.layout.free_cells(), "free cell"),
            counted(setup.robots.saturating_sub(1), "link"),
            setup.scheme.team,
        ),
        None => String::new(),
    }
}

/// Why a broken clause is no refutation of the rule, where the run need not keep to what clauses assume.
fn excuse(setup: &Setup, report: &Report) -> String {
    let is_told = |extra: &&&Extra| extra.is_told_by(&setup.options) && !report.violations.is_empty();
    let excuse = |extra: &&Extra| {
        let assumed = extra.assumed?;
        let field = extra.field;
        Some(format!("with --{field} this is no refutation of the rule: the clauses assume {assumed}\n"))
    };
    Extra::ALL.iter().filter(is_told).filter_map(excuse).collect()
}

/// The failures, in a line or two.
fn failed(failures: &Failures) -> String {
    let Failures { lost_bytes, rounds, died, taken_back, home } = *failures;
    let mut text = String::new();
    // Writing to a string cannot fail.
    if rounds > 0 {
        let rounds = counted(rounds, "round");
        let _ = writeln!(text, "{} lost; the robots said theirs in {rounds}", counted(lost_bytes, "byte"));
    }
    if let Some(died) = died {
        let _ = write!(text, "a robot died in team move {died}");
        if let Some(moves) = taken_back {
            let _ =
                write!(text, "; the others formed a chain after {} taken back", counted(moves, "team move"));
        }
        if home > 0 {
            let _ = write!(text, ", and came home by {home} more");
        }
        text.push('\n');
    }
    text
}

/// Where the robots start.
fn place(setup: &Setup) -> String {
    match (setup.scheme.look.has_base(), &setup.starts) {
        (true, _) => format!("base {}", setup.base),
        (false, None) => format!("start {}", setup.base),
        (false, Some(starts)) => {
            let starts: Vec<String> = starts.iter().map(Cell::to_string).collect();
            format!("starts {}", starts.join(" "))
        }
    }
}

/// The parts of the layout in which agents started, if there are several.
fn components(report: &Report, words: impl Fn(&Component) -> String) -> String {
    let mut text = String::new();
    if report.components.len() < 2 {
        return text;
    }
    let count = report.components.len();
    let _ = writeln!(text, "the agents start in {count} parts of the layout that are not connected:");
    for component in &report.components {
        let Component { robots, cells, explored, .. } = component;
        let (agents, cells) = (counted(*robots, "agent"), counted(*cells, "cell"));
        let _ = writeln!(text, "  {agents}, {explored} of {cells} explored{}", words(component));
    }
    text
}

/// Violations that are listed, the first of each clause among them; the others are counted.
const LISTED: usize = 10;

fn violations(run: &dyn Play, report: &Report) -> String {
    let mut text = String::new();
    let mut known = BTreeSet::new();
    let (mut listed, again): (Vec<_>, Vec<_>) =
        report.violations.iter().enumerate().partition(|(_, violation)| known.insert(violation.clause));
    listed.extend(again);
    listed.truncate(LISTED);
    listed.sort_by_key(|&(place, _)| place);
    for (_, &Violation { clause, step }) in listed {
        let _ = writeln!(text, "{clause} is broken in team move {step}{}", words_of(run, clause));
    }
    match report.violations.len() {
        0 => {
            let _ = writeln!(text, "{}", run.setup().scheme.unbroken());
        }
        1..=LISTED => {}
        more => {
            let _ = writeln!(text, "and {} more", more - LISTED);
        }
    }
    text
}
