//! `tautline reproduce notice-fig5`: how far broadcasts reach, and how many nodes forward them.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use tautline_kernel::notice::Count;
use tautline_proofs::words::counted;

use super::table::Table;
use crate::chosen::chosen;
use crate::output::Output;
use crate::{Exit, ForceArgs, Format, FormatArgs, count, number, progress, real, whole};
use tautline_sim::fault::Halt;
use tautline_sim::radio::ChannelName;
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::interval::Estimate;
use tautline_sim::reproduce::notice_fig5::{self, Density, NODES, Part, RANGE_M, SIDE_M, Setting};
use tautline_sim::words::Worded;

const EXAMPLES: &str = "\
Examples:
  tautline reproduce notice-fig5
  tautline reproduce notice-fig5 --svg-reach reach.svg --svg-rebroadcasts rebroadcasts.svg
  tautline reproduce notice-fig5 --nodes 300 --k 1,2,4,8 --topologies 1000 --format json
  tautline reproduce notice-fig5 --channel shared";

/// How many nodes a broadcast reaches, and how many forward it, by scheme and density.
///
/// Nodes at random places in a square, from a random source: of all nodes, and of those that links connect to the
/// source.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct NoticeFig5 {
    /// Numbers of nodes.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_values_t = NODES, value_parser = whole::<usize>)]
    nodes: Vec<usize>,
    /// The side of the square, in metres.
    #[arg(long, value_name = "METRES", default_value_t = SIDE_M, value_parser = real)]
    side: f64,
    /// The radio range, in metres.
    #[arg(long, value_name = "METRES", default_value_t = RANGE_M, value_parser = real)]
    range: f64,
    /// The k of k-FNF: how many senders, the first not counted, make a node silent.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1,2,3", value_parser = count)]
    k: Vec<Count>,
    /// Topologies for each number of nodes.
    #[arg(long, value_name = "COUNT", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    topologies: u32,
    /// The seed of all topologies.
    #[arg(long, default_value = "0", value_parser = number::<u64>)]
    seed: u64,
    /// What lies between the nodes.
    #[arg(long, value_parser = chosen::<ChannelName>(), default_value = "ideal")]
    channel: ChannelName,
    /// Store the reach as a picture.
    #[arg(long, value_name = "FILE")]
    svg_reach: Option<PathBuf>,
    /// Store the rebroadcasts as a picture.
    #[arg(long, value_name = "FILE")]
    svg_rebroadcasts: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Measured<'a> {
    id: &'static str,
    side_m: f64,
    range_m: f64,
    topologies: u32,
    seed: u64,
    channel: ChannelName,
    densities: &'a [Density],
}

impl NoticeFig5 {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let charts = self.force.files([&self.svg_reach, &self.svg_rebroadcasts], [])?;
        let setting = Setting {
            nodes: self.nodes.clone(),
            side_m: self.side,
            range_m: self.range,
            ks: self.k.clone(),
            topologies: self.topologies,
            seed: self.seed,
            channel: self.channel.channel(),
        };
        let topologies = u64::from(self.topologies) * self.nodes.len() as u64;
        let densities = progress::during("broadcasting", topologies, |watch| setting.measure(watch))?;
        for (chart, part) in charts.into_iter().zip([Part::Reach, Part::Rebroadcasts]) {
            if let Some(mut chart) = chart {
                chart.append(notice_fig5::chart(part, &densities).svg());
                out.keep(chart);
            }
        }
        match self.format.format {
            Format::Json => out.json(&Measured {
                id: Reproduction::NoticeFig5.id(),
                side_m: self.side,
                range_m: self.range,
                topologies: self.topologies,
                seed: self.seed,
                channel: self.channel,
                densities: &densities,
            })?,
            Format::Text => out.text(self.table(&densities))?,
        }
        Ok(Exit::Expected)
    }

    fn table(&self, densities: &[Density]) -> String {
        let heading = format!(
            "{side}×{side} m, range {} m, {} for each number of nodes, seed {}, {} channel",
            self.range,
            counted(self.topologies, "topology"),
            self.seed,
            self.channel.word(),
            side = self.side,
        );
        let percent = |estimate: Estimate| estimate.times(100.0).text(2);
        let mut table = Table::new(heading, densities);
        table.row("nodes", |density| density.nodes.to_string());
        table.row("connected", |density| density.connected.times(100.0).text(1));
        table.row("component", |density| percent(density.component));
        let schemes = densities.first().map_or(&[][..], |density| &density.schemes);
        table.title("Reach, % of all nodes");
        for (place, line) in schemes.iter().enumerate() {
            table.row(line.scheme.as_str(), |density| percent(density.schemes[place].reach));
            if densities.iter().any(|density| density.schemes[place].paper.is_some()) {
                let said =
                    |part: Option<f64>| part.map_or("-".to_owned(), |part| format!("{:.2}", 100.0 * part));
                table.row("  paper", |density| said(density.schemes[place].paper));
                table.row("  difference", |density| said(density.schemes[place].difference));
            }
        }
        table.title("Reach, % of the nodes connected to the source");
        for (place, line) in schemes.iter().enumerate() {
            table.row(line.scheme.as_str(), |density| percent(density.schemes[place].reach_component));
        }
        table.title("Rebroadcasts");
        for (place, line) in schemes.iter().enumerate() {
            table.row(line.scheme.as_str(), |density| density.schemes[place].rebroadcasts.text(2));
        }
        table.with_notes(
            "connected: % of the networks in which links connect all nodes · component: % of the nodes that they \
               connect to the\nsource · ±, […]: the 95 % interval · paper: “near 100 %” at every density; all \
               else it draws only",
        )
    }
}
