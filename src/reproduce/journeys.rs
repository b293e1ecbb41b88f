//! `tautline reproduce rescue-fig6`, `rescue-fig7`, `rescue-fig9` and `rescue-fig10`: how far a robot walks.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use tautline_kernel::notice::Count;
use tautline_proofs::words::counted;

use super::table::Table;
use crate::output::Output;
use crate::rescue::Metres;
use crate::{Exit, ForceArgs, Format, FormatArgs, count, number, progress, real, whole};
use tautline_sim::fault::{Fault, Halt};
use tautline_sim::radio::Obstacle;
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::interval::Estimate;
use tautline_sim::reproduce::journeys::{self, CLOSE, Claim, Density, Figure, Setting, Way};
use tautline_sim::reproduce::notice_fig5::{RANGE_M, SIDE_M};

const EXAMPLES: &str = "\
Examples:
  tautline reproduce rescue-fig7 --svg ratios.svg
  tautline reproduce rescue-fig7 --nodes 700 --k 8 --format json
  tautline reproduce rescue-fig6 --svg ways.svg
  tautline reproduce rescue-fig10 --noise-db 2 --obstacle 40,50,130,120 --obstacle 170,30,240,130";

/// How far a robot walks to the node that waits for rescue (WFR), by TAN and by its rivals.
///
/// Nodes, a robot and a WFR at random in a square. RD is what the robots walk in all topologies, divided by the shortest
/// ways there.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Journeys {
    /// Numbers of nodes [default: 300,500,700,900,1100 for figure 7, else 700]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = whole::<usize>)]
    nodes: Vec<usize>,
    /// The side of the square, in metres.
    #[arg(long, value_name = "METRES", default_value_t = SIDE_M, value_parser = real)]
    side: f64,
    /// The radio range, in metres.
    #[arg(long, value_name = "METRES", default_value_t = RANGE_M, value_parser = real)]
    range: f64,
    /// An obstacle by its sides; may be given again [default: those of the figure]
    #[arg(long, value_name = "W,N,E,S", allow_hyphen_values = true)]
    obstacle: Vec<Metres<4>>,
    /// The k of k-FNF, whose tree TAN uses.
    #[arg(long, default_value = "1", value_parser = count)]
    k: Count,
    /// The standard deviation of the strengths that robots measure, in dB.
    #[arg(long, value_name = "DB", default_value_t = 0.0, value_parser = real)]
    noise_db: f64,
    /// Topologies for each number of nodes.
    #[arg(long, value_name = "COUNT", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    topologies: u32,
    /// The seed of all topologies.
    #[arg(long, default_value = "0", value_parser = number::<u64>)]
    seed: u64,
    /// Store a picture: of figure 7 a chart, else the ways in the topology in which the shortest is the longest.
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
    side_m: f64,
    range_m: f64,
    /// West, north, east and south of each, in metres.
    obstacles: Vec<[f64; 4]>,
    k: u8,
    noise_db: f64,
    topologies: u32,
    seed: u64,
    densities: &'a [Density],
}

impl Journeys {
    pub(super) fn run(
        &self,
        reproduction: Reproduction,
        figure: Figure,
        out: &mut Output,
    ) -> Result<Exit, Halt> {
        let [file] = self.force.files([&self.svg], [])?;
        let given = |own: &[usize]| if own.is_empty() { figure.nodes() } else { own.to_vec() };
        let own: Vec<Obstacle> = self.obstacle.iter().map(|&Metres(sides)| sides.into()).collect();
        let obstacles = if own.is_empty() { figure.obstacles() } else { own };
        let setting = Setting {
            nodes: given(&self.nodes),
            side_m: self.side,
            range_m: self.range,
            obstacles,
            k: self.k,
            noise_db: self.noise_db,
            topologies: self.topologies,
            seed: self.seed,
        };
        let topologies = u64::from(self.topologies) * setting.nodes.len() as u64;
        let densities = progress::during("walking", topologies, |watch| setting.measure(watch))?;
        if let Some(mut file) = file {
            file.draw(picture(figure, &setting, &densities))?;
            out.keep(file);
        }
        match self.format.format {
            Format::Json => out.json(&Measured {
                id: reproduction.id(),
                side_m: self.side,
                range_m: self.range,
                obstacles: setting.obstacles.iter().copied().map(Into::into).collect(),
                k: self.k.get(),
                noise_db: self.noise_db,
                topologies: self.topologies,
                seed: self.seed,
                densities: &densities,
            })?,
            Format::Text => out.text(text(&setting, &densities))?,
        }
        Ok(Exit::Expected)
    }
}

fn picture(figure: Figure, setting: &Setting, densities: &[Density]) -> Result<String, Halt> {
    match figure {
        Figure::Ratios => Ok(journeys::chart(densities).svg()),
        Figure::Trajectories | Figure::OneObstacle | Figure::FourObstacles => {
            let drawn = densities.iter().find_map(|density| Some((density.nodes, density.longest?)));
            let (nodes, topology) = drawn.ok_or_else(|| {
                Fault::usage(
                    "there is no topology to draw in which all arrive",
                    "take more topologies or nodes",
                )
            })?;
            setting.picture(figure, nodes, topology)
        }
    }
}

fn text(setting: &Setting, densities: &[Density]) -> String {
    let obstacles = match setting.obstacles.len() {
        0 => "no obstacle".to_owned(),
        some => counted(some, "obstacle"),
    };
    let heading = format!(
        "{side}×{side} m, range {} m, {obstacles}, k = {}, noise {} dB, {} for each number of nodes, seed {}",
        setting.range_m,
        setting.k.get(),
        setting.noise_db,
        counted(setting.topologies, "topology"),
        setting.seed,
        side = setting.side_m,
    );
    let mut table = Table::new(heading, densities);
    let or_dash = |estimate: Option<Estimate>| Estimate::text_or_dash(estimate, 2);
    let percent = |share: Option<Estimate>| Estimate::text_or_dash(share.map(|share| share.times(100.0)), 1);
    table.row("nodes", |density| density.nodes.to_string());
    table.row("linked", |density| percent(Some(density.linked)));
    table.row("told", |density| percent(density.told));
    table.title("Arrivals, % of those linked");
    for (place, way) in Way::ALL.into_iter().enumerate() {
        table.row(way.word(), |density| percent(density.ways[place].arrivals));
    }
    table.title("RD where all arrive");
    table.row("topologies", |density| density.ways[0].ratio.map_or(0, |ratio| ratio.count).to_string());
    for (place, way) in Way::ALL.into_iter().enumerate() {
        table.row(way.word(), |density| or_dash(density.ways[place].ratio));
    }
    table.title("Seconds for each metre of the shortest way");
    for (place, way) in Way::ALL.into_iter().enumerate() {
        if densities.iter().any(|density| density.ways[place].seconds.is_some()) {
            table.row(way.word(), |density| or_dash(density.ways[place].seconds));
        }
    }
    table.title("TAN");
    table.row("hops", |density| or_dash(density.hops));
    table.row("shorter, %", |density| percent(density.shorter_than_reich));
    table.title("RD of TAN, in the paper's words, and the difference");
    let mut rival = None;
    for (place, claim) in Claim::ALL.into_iter().enumerate() {
        if rival.replace(claim.rival()) != Some(claim.rival()) {
            table.row(format!("TAN less {}", claim.rival().word()), |density| {
                or_dash(density.claims[place].difference)
            });
        }
        table.row(format!("  {}", claim.words()), |density| density.claims[place].verdict.word().to_owned());
    }
    table.with_notes(&format!(
        "linked: % of the topologies in which links lead from the robot to the WFR · told: % of those in which the \
         robot\nhears the call by k-FNF, which TAN needs · RD: metres walked for each metre of the shortest way · hops: for \
         each hop\nof the shortest chain of links · shorter: % of the topologies in which TAN's way is shorter than Reich's · \
         holds, fails:\nthe whole 95 % interval says so, close being up to {CLOSE} · ±, […]: that interval"
    ))
}
