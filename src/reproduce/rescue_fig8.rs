//! `tautline reproduce rescue-fig8`: three robots for three WFRs.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use tautline_kernel::notice::Count;
use tautline_proofs::words::counted;

use super::table::Table;
use crate::output::Output;
use crate::{Exit, ForceArgs, Format, FormatArgs, count, number, progress, whole};
use tautline_sim::fault::Halt;
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::interval::Estimate;
use tautline_sim::reproduce::rescue_fig8::{Line, MOST, NODES, ROBOTS, Setting, WFRS};

const EXAMPLES: &str = "\
Examples:
  tautline reproduce rescue-fig8 --svg ways.svg
  tautline reproduce rescue-fig8 --nodes 1100 --topologies 1000 --format json
  tautline reproduce rescue-fig8 --robots 2 --wfr 4";

/// Which robot comes to whom, and how far it goes, where several call at once.
///
/// Nodes, robots and those who wait for rescue (WFRs) at random in a square, without any fault, under MRC as published and
/// repaired. The paper draws one case of it.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct RescueFig8 {
    /// Nodes.
    #[arg(long, value_name = "N", default_value_t = NODES, value_parser = whole::<usize>)]
    nodes: usize,
    /// Robots.
    #[arg(long, value_name = "N", default_value_t = ROBOTS as u64, value_parser = clap::value_parser!(u64).range(1..=MOST as u64))]
    robots: u64,
    /// WFRs.
    #[arg(long, value_name = "N", default_value_t = WFRS as u64, value_parser = clap::value_parser!(u64).range(1..=MOST as u64))]
    wfr: u64,
    /// The k of k-FNF.
    #[arg(long, default_value = "1", value_parser = count)]
    k: Count,
    /// Topologies.
    #[arg(long, value_name = "COUNT", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    topologies: u32,
    /// The seed of the first topology; the others follow.
    #[arg(long, default_value = "0", value_parser = number::<u64>)]
    seed: u64,
    /// Store the ways of the first topology in which each WFR has a robot of its own as a picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Measured<'a> {
    id: &'static str,
    nodes: usize,
    robots: usize,
    wfrs: usize,
    k: u8,
    topologies: u32,
    seed: u64,
    rules: &'a [Line],
}

impl RescueFig8 {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let Self { nodes, topologies, seed, .. } = *self;
        let (robots, wfrs, k) = (self.robots as usize, self.wfr as usize, self.k.get());
        let setting = Setting { nodes, robots, wfrs, k, topologies, seed };
        let [file] = self.force.files([&self.svg], [])?;
        let rescues = 2 * u64::from(topologies);
        let lines = progress::during("rescuing", rescues, |watch| setting.measure(watch))?;
        if let Some(mut file) = file {
            file.draw(setting.picture())?;
            out.keep(file);
        }
        match self.format.format {
            Format::Json => {
                let id = Reproduction::RescueFig8.id();
                out.json(&Measured { id, nodes, robots, wfrs, k, topologies, seed, rules: &lines })?;
            }
            Format::Text => out.text(table(&setting, &lines))?,
        }
        Ok(Exit::Expected)
    }
}

fn table(setting: &Setting, lines: &[Line]) -> String {
    let Setting { nodes, robots, wfrs, k, topologies, seed } = setting;
    let heading = format!(
        "{}, {}, {nodes} nodes in 300×300 m, range 25 m, k = {k}, {}, seed {seed}",
        counted(*robots, "robot"),
        counted(*wfrs, "WFR"),
        counted(*topologies, "topology")
    );
    let mut table = Table::new(heading, lines);
    let percent = |share: f64| format!("{:.2}", 100.0 * share);
    table.row("MRC", |line| line.rule.to_string());
    table.row("served, %", |line| line.served.ours.times(100.0).text(2));
    table.row("  paper", |line| percent(line.served.paper));
    table.row("  difference", |line| percent(line.served.difference));
    table.row("a robot each, %", |line| line.own.ours.times(100.0).text(2));
    table.row("  paper", |line| percent(line.own.paper));
    table.row("  difference", |line| percent(line.own.difference));
    table.row("RD", |line| Estimate::text_or_dash(line.distance_ratio, 3));
    table.row("over the best assignment", |line| Estimate::text_or_dash(line.over_best, 3));
    table.row("the best assignment, %", |line| {
        Estimate::text_or_dash(line.best.map(|share| share.times(100.0)), 2)
    });
    table.row("seconds to the last", |line| Estimate::text_or_dash(line.last_s, 1));
    table.with_notes(
        "served: % of the topologies in which one robot comes to each WFR, and one only · a robot each: a different one to \
           each ·\npaper: a picture of one topology in which it is so, and “for all simulated scenarios” · RD: metres walked for \
           each metre\nof the shortest ways · over the best assignment: how many times as far the robots are off the WFRs \
           that they come to as\nunder the best of all assignments, where each WFR has a robot of its own · the best assignment: % \
           of these in which it is\nthat one · ±, […]: the 95 % interval",
    )
}
