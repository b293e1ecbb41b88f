//! `tautline reproduce antenna-fig4`: a directional antenna, and what noise does to a scan.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::output::Output;
use crate::{Exit, ForceArgs, Format, FormatArgs, number, real};
use tautline_sim::fault::Halt;
use tautline_sim::radio::MAX_RANGE_M;
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::antenna_fig4::{self, DISTANCE_M, Measured, NOISES_DB, Setting};
use tautline_sim::reproduce::interval::Estimate;
use tautline_sim::tan::NEAREST_M;

const EXAMPLES: &str = "\
Examples:
  tautline reproduce antenna-fig4 --svg antenna.svg
  tautline reproduce antenna-fig4 --distance 5 --noise-db 0,3,6 --format json";

/// What a robot hears of a node all round with its directional antenna, and how well that tells where the node is.
///
/// A scan is 24 measurements, 15° apart, and its strongest direction the one in which a robot walks.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct AntennaFig4 {
    /// How far off the node is, in metres.
    #[arg(long, value_name = "METRES", default_value_t = DISTANCE_M, value_parser = distance)]
    distance: f64,
    /// Standard deviations of the strengths measured, in dB.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_values_t = NOISES_DB, value_parser = real)]
    noise_db: Vec<f64>,
    /// Scans with each, of nodes in random directions.
    #[arg(long, value_name = "COUNT", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    scans: u32,
    /// The seed of all scans.
    #[arg(long, default_value = "0", value_parser = number::<u64>)]
    seed: u64,
    /// Store the pattern as a picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

fn distance(text: &str) -> Result<f64, String> {
    let distance_m = text.parse().ok().filter(|distance_m| (NEAREST_M..=MAX_RANGE_M).contains(distance_m));
    distance_m.ok_or_else(|| format!("write metres from {NEAREST_M} to {MAX_RANGE_M}"))
}

#[derive(Serialize)]
struct Report<'a> {
    id: &'static str,
    distance_m: f64,
    scans: u32,
    seed: u64,
    #[serde(flatten)]
    measured: &'a Measured,
}

impl AntennaFig4 {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let [file] = self.force.files([&self.svg], [])?;
        let noises_db = self.noise_db.clone();
        let setting = Setting { distance_m: self.distance, noises_db, scans: self.scans, seed: self.seed };
        let measured = setting.measure()?;
        if let Some(mut file) = file {
            file.append(antenna_fig4::chart(&measured.pattern, self.distance).svg());
            out.keep(file);
        }
        match self.format.format {
            Format::Json => out.json(&Report {
                id: Reproduction::AntennaFig4.id(),
                distance_m: self.distance,
                scans: self.scans,
                seed: self.seed,
                measured: &measured,
            })?,
            Format::Text => out.text(self.text(&measured))?,
        }
        Ok(Exit::Expected)
    }

    fn text(&self, measured: &Measured) -> String {
        let mut text =
            format!("A node {} m off: dB above the weakest signal that is heard all round\n", self.distance);
        // Writing to a string cannot fail.
        for angle in measured.pattern.iter().filter(|angle| angle.degrees >= 0) {
            let level = angle.level_db.map_or("nothing".to_owned(), |level_db| format!("{level_db:.2}"));
            let _ = write!(text, "\n{:>4}°  {level:>8}", angle.degrees);
        }
        let _ = write!(
            text,
            "\n\nScans of nodes in random directions, {} for each noise, seed {}\n\n{:>9}  {:>23}  {:>23}  {:>14}",
            self.scans, self.seed, "noise, dB", "right, %", "one beside, %", "off, degrees"
        );
        let percent = |estimate: Estimate| estimate.times(100.0).text(2);
        for noise in &measured.noises {
            let _ = write!(
                text,
                "\n{:>9}  {:>23}  {:>23}  {:>14}",
                noise.noise_db,
                percent(noise.right),
                percent(noise.beside),
                noise.degrees_off.text(2)
            );
        }
        text + "\n\nright: the strongest direction is the nearest of the 24 to the node's · one beside: that, or one of the two \
                beside it ·\noff: between the strongest direction and the node's · ±, […]: the 95 % interval\n"
    }
}
