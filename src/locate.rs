//! `tautline locate`: how exact positions are that signals tell, and the positions of measurements.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_field::draw;
use tautline_field::position::{
    Advice, Anchors, Errors, FixReport, Measurements, Place, Power, Report, Setting, Solver, refused,
};
use tautline_io::diagnostic::{Diagnostic, Halt, one_line};
use tautline_io::named_values::NamedValues;
use tautline_io::number::Number;
use tautline_io::text_table::{Align, TextTable};
use tautline_io::value_parser::{Metres, metres_within, number, within};
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{Point, Signal};
use tautline_proofs::plural::counted;
use tautline_sim::explore::RuleName;

use super::exit::Exit;
use super::options::{ForceArgs, Format, FormatArgs, refuse_needless};
use super::output::Output;
use super::value_parser::chosen;
use super::{interrupt, progress};

const EXAMPLES: &str = "\
Examples:
  tautline locate
  tautline locate --solver closed-form --format json
  tautline locate --anchors 0,0 --anchors 30,0 --anchors 0,20 --anchors 30,20 --noise-db 2 --exponent 3
  tautline locate --solver pso --rule published --at 5,5 --svg positions.svg
  tautline locate --noise-db 0.25 --advice
  tautline locate measurements.csv --noise-db 2 --format json
  tautline locate levels.csv --power-dbm -40 --exponent 2.7

FILE holds measurements: its first line is fix,x_m,y_m,range_m, and each other line has one distance, with the name of \
the position that it belongs to, the place of the anchor, and the metres measured. With --power-dbm the last column is \
level_dbm, the strength with which the anchor is heard.

What the JSON says: error_m is how far positions are from where the robot is, optimum_m how far they are from where \
the distances miss least, each with median, p95 and rms and the 95 % interval of these; crlb_rms_m is the Cramér-Rao \
bound, the least root mean square error of an unbiased way; spread_m are the singular values of the anchors' places; \
two, weak, outside and unsettled count positions of which there were two, that the anchors tell badly, that the \
distances put outside the rectangle, and of which the steps did not end; advice is what --advice prints.

Advice: a robot may believe each fix if its error is below a quarter of a cell, and correct its place within a cell \
that it counts by moves if the error is below half a cell. It is about the 99th percentile of the errors.";

/// Measure how exact positions are that come from the strength of anchors' signals, or find the positions of
/// measurements.
///
/// Anchors are radios at known places. A robot hears each with a strength (the level, in dB) that falls with the
/// distance and has noise, takes these levels for distances, and finds its position from three distances or more. This
/// is done many times, at random places in the rectangle that the anchors span; what is printed is how far the
/// positions are from where the robot is. docs/position.md explains the ways to find a position.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Locate {
    /// A file of measurements whose positions are to be found.
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// Where an anchor is, in metres; once for each. Without it 0,0 and 20,0 and 0,20.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    anchors: Vec<Metres<2>>,
    /// Where the robot is, in metres. Without it anywhere, each time anew.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = place)]
    at: Option<Metres<2>>,
    /// The standard deviation of the levels, in dB.
    #[arg(long, value_name = "DB", allow_hyphen_values = true, default_value = "1", value_parser = noise)]
    noise_db: f64,
    /// The path loss exponent, from 2 in free space to 5: power falls with the distance to the power of this.
    #[arg(long, value_name = "ALPHA", allow_hyphen_values = true, default_value = "2", value_parser = propagation)]
    exponent: Propagation,
    /// For a FILE of levels: how strong an anchor is heard at one metre, in dBm.
    #[arg(long, value_name = "DBM", allow_hyphen_values = true, value_parser = power)]
    power_dbm: Option<Power>,
    /// How a position is found.
    #[arg(long, value_parser = chosen::<Solver>(), default_value = "decibel")]
    solver: Solver,
    /// For pso, in which order velocities and places of particles are updated: as the paper prints it in equation (10),
    /// or as its algorithm does. Without it repaired, which is as the algorithm.
    #[arg(long, value_parser = chosen::<RuleName>())]
    rule: Option<RuleName>,
    /// For least-squares and decibel: the robot is known to be within the rectangle that the anchors span.
    #[arg(long)]
    inside: bool,
    /// How many positions are found. Without it 10000.
    #[arg(long = "runs", value_name = "COUNT", allow_hyphen_values = true, value_parser = trials)]
    trials: Option<u32>,
    /// The seed of whatever is left to chance. Without it 0.
    #[arg(long, value_parser = number::<u64>)]
    seed: Option<u64>,
    /// Print how many cells across a floor can have, so that errors leave a robot in its cell.
    #[arg(long)]
    advice: bool,
    /// Store a picture, in metres: anchors, positions found, the ellipse in which 95 % of them are, and the smallest
    /// one that is possible (the Cramér-Rao bound).
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

fn noise(text: &str) -> Result<f64, &'static str> {
    let noise_db =
        text.parse().ok().filter(|&noise_db| Signal::new(Propagation::FREE_SPACE, noise_db).is_some());
    noise_db.ok_or("write decibels from 0 to 100")
}

fn power(text: &str) -> Result<Power, &'static str> {
    text.parse().ok().and_then(Power::new).ok_or("write dBm from -200 to 90")
}

/// A place from which distances are well below those that the kernel refuses.
fn place(text: &str) -> Result<Metres<2>, String> {
    metres_within(text, 1e8)
}

fn propagation(text: &str) -> Result<Propagation, &'static str> {
    text.parse().ok().and_then(Propagation::new).ok_or("write a number from 2 to 5")
}

fn trials(text: &str) -> Result<u32, String> {
    within::<i64, u32>(text, &(1..=1_000_000))
}

/// The anchors where none are named: three corners of a square.
const SQUARE: [Point; 3] = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(0.0, 20.0)];

/// The JSON of trials.
#[derive(JsonSchema, Serialize)]
pub(super) struct TrialsJson<'a> {
    #[serde(flatten)]
    setting: &'a Setting,
    #[serde(flatten)]
    report: &'a Report,
    /// Whether as many trials were made as were asked for: a signal ended nothing.
    complete: bool,
}

/// The JSON of measurements.
#[derive(JsonSchema, Serialize)]
pub(super) struct FixesJson<'a> {
    solver: Solver,
    noise_db: f64,
    exponent: f64,
    #[serde(rename = "fixes")]
    found: &'a [FixReport],
}

impl Locate {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let signal = Signal::new(self.exponent, self.noise_db)
            .ok_or_else(|| Diagnostic::usage("there is no such noise", "write decibels from 0 to 100"))?;
        let (solver, word) = (self.solver, self.solver.word());
        let rule = ("--rule", self.rule.is_some() && solver != Solver::Pso);
        refuse_needless([rule], format_args!("{word} has no order of updates"))?;
        let inside = ("--inside", self.inside && !solver.has_area());
        refuse_needless([inside], format_args!("{word} keeps to no rectangle"))?;
        match &self.file {
            Some(file) => self.measured(file, &signal, out),
            None => self.tried(signal, out),
        }
    }

    fn rule(&self) -> RuleName {
        self.rule.unwrap_or(RuleName::Repaired)
    }

    fn tried(&self, signal: Signal, out: &mut Output) -> Result<Exit, Halt> {
        refuse_needless([("--power-dbm", self.power_dbm.is_some())], "there is no file of levels")?;
        let is_drawn = signal.noise_db() > 0.0 || self.at.is_none() || self.solver == Solver::Pso;
        let why = "without noise, at one place, nothing is left to chance";
        refuse_needless([("--seed", self.seed.is_some() && !is_drawn)], why)?;
        if self.advice && self.at.is_some() {
            let what = "--advice is about a whole floor, and --at is one place of it";
            return Err(Diagnostic::usage(what, "leave --at or --advice out").into());
        }
        let trials = self.trials.unwrap_or(10_000);
        if self.advice && trials < Advice::FEWEST {
            let what = format!("--runs {trials} are too few for the 99th percentile of --advice");
            return Err(Diagnostic::usage(what, format_args!("give {} or more", Advice::FEWEST)).into());
        }
        let [picture] = self.force.files([&self.svg], [])?;
        let named = self.anchors.iter().map(|&Metres([x_m, y_m])| Point::new(x_m, y_m));
        let places = if self.anchors.is_empty() { SQUARE.to_vec() } else { named.collect() };
        let setting = Setting {
            anchors: Anchors::new(places).map_err(refused)?,
            at_m: self.at.map(|Metres(at)| at),
            signal,
            solver: self.solver,
            rule: self.rule(),
            inside: self.inside,
            trials,
            seed: self.seed.unwrap_or(0),
        };
        let outside = |&[x_m, y_m]: &[f64; 2]| {
            let at = Point::new(x_m, y_m);
            setting.anchors.area().nearest(at) != at
        };
        if let Some([x_m, y_m]) = setting.at_m.filter(|at| setting.inside && outside(at)) {
            let at = format!("{},{}", Number(x_m), Number(y_m));
            let what = format!("--inside keeps to the rectangle that the anchors span, and {at} is outside");
            return Err(Diagnostic::usage(what, "give --at a place within it, or leave --inside out").into());
        }
        let (setting, report) = progress::during("locating", setting.parts(), |watch| setting.run(watch))?;
        let complete = setting.trials == trials;
        let spots = || draw::position::spots(&title(&setting), setting.anchors.places(), &setting.spots());
        out.store(picture, |picture| picture.draw(Ok(spots())))?;
        match self.format.format {
            Format::Json => out.json(&TrialsJson { setting: &setting, report: &report, complete })?,
            Format::Text => {
                out.text(text(&setting, &report))?;
                if self.advice {
                    out.text(advice(&report.advice))?;
                }
                if !complete {
                    out.text(interrupt::part(setting.trials.into(), counted(trials, "trial")))?;
                }
            }
        }
        Ok(if complete { Exit::Expected } else { Exit::Unfinished })
    }

    fn measured(&self, file: &Path, signal: &Signal, out: &mut Output) -> Result<Exit, Halt> {
        let given = [
            ("--anchors", !self.anchors.is_empty()),
            ("--at", self.at.is_some()),
            ("--runs", self.trials.is_some()),
            ("--inside", self.inside),
            ("--advice", self.advice),
            ("--seed", self.seed.is_some() && self.solver != Solver::Pso),
        ];
        refuse_needless(given, "the positions of measurements are found")?;
        let [picture] = self.force.files([&self.svg], [file.to_path_buf()])?;
        let measured = Measurements::read(file, signal, self.power_dbm)?;
        let found = measured.locate(self.solver, self.rule(), signal, self.seed.unwrap_or(0))?;
        let title = format!("Positions by {}", self.solver.word());
        let drawn = || draw::position::found(&title, &measured.anchors(), &found);
        out.store(picture, |picture| picture.draw(Ok(drawn())))?;
        match self.format.format {
            Format::Json => {
                let (noise_db, exponent) = (self.noise_db, self.exponent.exponent());
                out.json(&FixesJson { solver: self.solver, noise_db, exponent, found: &found })?;
            }
            Format::Text => out.text(positions(&found))?,
        }
        Ok(Exit::Expected)
    }
}

fn title(setting: &Setting) -> String {
    let Setting { signal, solver, rule, .. } = setting;
    let order = if *solver == Solver::Pso { format!(" ({rule})") } else { String::new() };
    let (noise_db, exponent) = (Number(signal.noise_db()), signal.propagation().exponent());
    format!("{}{order}, noise {noise_db} dB, exponent {exponent}", solver.word())
}

fn text(setting: &Setting, report: &Report) -> String {
    let anchors = setting.anchors.places().len();
    let [width_m, height_m] = setting.anchors.sides_m().map(Number);
    let place = setting.at_m.map_or_else(
        || format!("a robot anywhere in {width_m}×{height_m} m"),
        |[x_m, y_m]| format!("a robot at {},{}", Number(x_m), Number(y_m)),
    );
    let mut columns = TextTable::new([Align::Left; 4]);
    columns.row(["metres", "median", "95th percentile", "root mean square"]);
    let row = |name: &str, errors: &Errors| {
        let Errors { of, interval } = errors;
        let cell = |number: f64, interval: Option<[f64; 2]>| {
            let ends = interval.map_or_else(String::new, |[least, most]| format!(" [{least:.3}, {most:.3}]"));
            format!("{number:.3}{ends}")
        };
        [
            name.to_owned(),
            cell(of.median, interval.median),
            cell(of.p95, interval.p95),
            cell(of.rms, interval.rms),
        ]
    };
    columns.row(row("error", &report.error_m));
    columns.row(row("distance to the least squares", &report.optimum_m));
    let bound = report.crlb_rms_m.map_or_else(|| "none".to_owned(), |rms_m| format!("{rms_m:.3}"));
    columns.row(["Cramér–Rao bound".to_owned(), String::new(), String::new(), bound]);
    let inside = if setting.inside { ", kept inside" } else { "" };
    let mut text = format!(
        "{anchors} anchors, {place}; {}{inside}; {}, seed {}\n\n{}\n[…]: the 95 % interval\n",
        title(setting),
        counted(setting.trials, "trial"),
        setting.seed,
        columns.text()
    );
    let counts = [
        (report.two, "in which two positions fit"),
        (report.weak, "that the anchors tell badly"),
        (report.outside, "on the rim of the rectangle"),
        (report.unsettled, "that did not settle"),
        (report.refused, "whose distances were refused"),
    ];
    for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{count} {what}");
    }
    text
}

fn advice(advice: &Advice) -> String {
    let Advice { side_m, p99_m, cells_believed, cells_tracked } = advice;
    let side_m = Number(*side_m);
    let [believed, tracked] = [*cells_believed, *cells_tracked].map(|cells| match cells {
        Advice::MOST_CELLS => format!("{cells} cells and more"),
        _ => format!("at most {}", counted(cells, "cell")),
    });
    format!(
        "\n99 % of the errors are below {p99_m:.3} m. Across {side_m} m a floor can have\n\
         {believed} where a robot believes each fix,\n\
         {tracked} where it counts its cells by moves and lets fixes correct its place within one.\n"
    )
}

fn positions(found: &[FixReport]) -> String {
    let mut columns = TextTable::new([Align::Left].into_iter().chain([Align::Right; 5]).chain([Align::Left]));
    columns.row(["fix", "x, m", "y, m", "± rms, m", "dilution", "residual", ""]);
    let told = |number: Option<f64>| {
        number.map_or_else(|| "-".to_owned(), |number| format!("{number:.3}").replace("-0.000", "0.000"))
    };
    for FixReport { fix, positions } in found {
        for (number, place) in positions.iter().enumerate() {
            let Place { x_m, y_m, rms_m, dilution, residual, flags, .. } = place;
            let or = if number == 0 { Vec::new() } else { vec!["or here"] };
            columns.row([
                one_line(fix),
                told(Some(*x_m)),
                told(Some(*y_m)),
                told(*rms_m),
                told(*dilution),
                told(*residual),
                or.into_iter().chain(flags.iter().copied()).collect::<Vec<_>>().join(", "),
            ]);
        }
    }
    columns.text()
}
