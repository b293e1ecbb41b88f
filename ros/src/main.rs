//! The program: arguments, signals, and exit codes, which are those of `tautline`.

use clap::Parser;
use log::{Level, LevelFilter, Log, Metadata, Record};
use signal_hook::consts::{SIGINT, SIGTERM};
use std::fmt::Write;
use std::path::PathBuf;
use std::process::{ExitCode, exit};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use tautline_ros::config::{Config, Id};
use tautline_ros::node::{self, LAST_DOMAIN};
use tautline_ros::tell;

/// Watches robots of ROS 2 by the clauses of Tautline: hears poses, publishes /diagnostics and /tautline/markers.
///
/// Exit codes: 0 ended by SIGINT or SIGTERM · 2 wrong usage or bad input, or a port that is taken · 70 a bug of ours.
#[derive(Parser)]
#[command(name = "tautline-ros", version, verbatim_doc_comment)]
struct Arguments {
    /// The robots, their topics and the clauses, in TOML.
    #[arg(value_name = "CONFIG", required_unless_present = "clause", conflicts_with = "clause")]
    file: Option<PathBuf>,
    /// Without a file: one clause, of robot_1, robot_2 and so on, on /robot_1/pose, /robot_2/pose and so on.
    #[arg(long, requires_all = ["robots", "tolerance_m", "gap_s"])]
    clause: Option<Id>,
    /// How many robots.
    #[arg(long, value_name = "N", requires = "clause")]
    robots: Option<u8>,
    /// The range of CHAIN-3, KIT-1, KIT-2 or KIT-12.
    #[arg(long, value_name = "METRES", requires = "clause")]
    range_m: Option<f64>,
    /// The least distance of KIT-3.
    #[arg(long, value_name = "METRES", requires = "clause")]
    least_m: Option<f64>,
    /// The width of a cell of CHAIN-2, FRONTIER-2 or PACK-2.
    #[arg(long, value_name = "METRES", requires = "clause")]
    cell_m: Option<f64>,
    /// How far off a position may be; for a distance, twice as much.
    #[arg(long, value_name = "METRES", requires = "clause")]
    tolerance_m: Option<f64>,
    /// The age at which a position is no longer believed.
    #[arg(long, value_name = "SECONDS", requires = "clause")]
    gap_s: Option<f64>,
    /// The domain of ROS.
    #[arg(long, env = "ROS_DOMAIN_ID", default_value_t = 0, value_parser = domain)]
    domain: u16,
}

/// A domain; an empty variable is one that is not set, as it is for ROS.
fn domain(text: &str) -> Result<u16, String> {
    let number = if text.is_empty() { Some(0) } else { text.parse().ok() };
    number.filter(|domain| *domain <= LAST_DOMAIN).ok_or(format!("domains are from 0 to {LAST_DOMAIN}"))
}

impl Arguments {
    /// The configuration that the clause of the command line stands for.
    fn text(&self, clause: Id) -> String {
        let mut text = String::new();
        let mut set = |name: &str, value: Option<f64>| {
            // TOML writes NaN in small letters.
            let _ = value.map(|value| writeln!(text, "{name} = {}", format!("{value:?}").to_lowercase()));
        };
        set("gap_s", self.gap_s);
        set("[[clauses]]\ntolerance_m", self.tolerance_m);
        set("range_m", self.range_m);
        set("least_m", self.least_m);
        set("cell_m", self.cell_m);
        let _ = writeln!(text, "clause = \"{clause}\"");
        for robot in 1..=self.robots.unwrap_or_default() {
            let _ = writeln!(text, "[[robots]]\nname = \"robot_{robot}\"");
        }
        text
    }

    /// The configuration, or the text of what is wrong with it.
    fn config(&self) -> Result<Config, String> {
        let Some(file) = &self.file else {
            let text = self.clause.map(|clause| self.text(clause)).unwrap_or_default();
            return Config::parse(&text).map_err(|error| error.in_options().to_owned());
        };
        let name = file.display().to_string();
        let text = std::fs::read_to_string(file).map_err(|error| format!("{name}: {error}"))?;
        Config::parse(&text).map_err(|error| error.in_file(&name, &text))
    }
}

/// The errors of the DDS library, for a person. Its warnings are about packets, and for those who work on it.
struct Errors;

impl Log for Errors {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.level() == Level::Error
    }

    fn log(&self, record: &Record<'_>) {
        if self.enabled(record.metadata()) {
            tell!("the DDS library: {}", record.args());
        }
    }

    fn flush(&self) {}
}

fn run() -> Result<(), String> {
    let arguments = Arguments::parse();
    let config = arguments.config()?;
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        signal_hook::flag::register(signal, Arc::clone(&stop)).map_err(|error| error.to_string())?;
    }
    let network = node::join("tautline", arguments.domain).map_err(|error| error.to_string())?;
    tell!(
        "{} robots and {} clauses are watched in domain {}",
        config.robots.len(),
        config.clauses.len(),
        arguments.domain
    );
    node::run(config, network, &stop).map_err(|error| error.to_string())
}

fn main() -> ExitCode {
    // A thread of the DDS library that is gone would leave a node that hears nobody.
    std::panic::set_hook(Box::new(|panic| {
        tell!("this is a bug, please report it: {panic}");
        exit(70);
    }));
    if log::set_logger(&Errors).is_ok() {
        log::set_max_level(LevelFilter::Error);
    }
    match run() {
        Ok(()) => {
            tell!("ended");
            ExitCode::SUCCESS
        }
        Err(why) => {
            tell!("{why}");
            ExitCode::from(2)
        }
    }
}
