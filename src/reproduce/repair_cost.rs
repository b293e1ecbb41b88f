//! `tautline reproduce repair-cost`: what the repairs of the chain cost.

use std::fmt::Write;

use clap::Args;
use serde::Serialize;
use tautline_proofs::words::counted;

use crate::output::Output;
use crate::{Exit, Format, FormatArgs, number, progress};
use tautline_sim::fault::{Halt, Watch};
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::repair_cost::{self, Comparison, DENSITIES, Line, ROBOTS};

const EXAMPLES: &str = "\
Examples:
  tautline reproduce repair-cost
  tautline reproduce repair-cost --layouts 10000 --format json";

/// What the chain's repairs cost in team moves, and what they prevent.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct RepairCost {
    /// Random layouts at each density.
    #[arg(long, value_name = "COUNT", default_value_t = 300, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    layouts: u32,
    /// The seed of the first layout; the others have the seeds after it.
    #[arg(long, default_value = "0", value_parser = number::<u64>)]
    seed: u64,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Measured {
    id: &'static str,
    robots: u16,
    seed: u64,
    densities: Vec<Line>,
}

impl RepairCost {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let layouts = u64::from(self.layouts) * DENSITIES.len() as u64;
        let compare = |watch: &Watch<'_>| repair_cost::compare(self.layouts, self.seed, watch);
        let lines = progress::during("comparing", layouts, compare)?;
        match self.format.format {
            Format::Json => out.json(&Measured {
                id: Reproduction::RepairCost.id(),
                robots: ROBOTS,
                seed: self.seed,
                densities: lines.clone(),
            })?,
            Format::Text => out.text(self.table(&lines))?,
        }
        let is_safe = lines.iter().all(|line| line.violations.iter().all(|runs| runs.repaired == 0));
        Ok(if is_safe { Exit::Expected } else { Exit::Violation })
    }

    fn table(&self, lines: &[Line]) -> String {
        let mut text = format!(
            "{ROBOTS} robots in walls:15x15:DENSITY, {} at each density, seeds from {}\n",
            counted(self.layouts, "layout"),
            self.seed
        );
        for (place, milestone) in repair_cost::MILESTONES.iter().enumerate() {
            let title = format!("Mean team moves to {} %, where both reach it", milestone.percent());
            text.push_str(&compared(&title, lines, |line| &line.milestones[place].moves));
        }
        text.push_str(&compared("Mean team moves of whole runs", lines, |line| &line.moves));
        text.push_str(&compared("Mean cells explored when a run ends", lines, |line| &line.explored));
        text.push_str("\nRuns that break a clause, published / repaired\ndensity ");
        for violations in lines.first().map_or(&[][..], |line| &line.violations) {
            let _ = write!(text, "  {:>12}", violations.clause);
        }
        for line in lines {
            let _ = write!(text, "\n{:<7} ", line.density);
            for runs in line.violations {
                let _ = write!(text, "  {:>12}", format!("{} / {}", runs.published, runs.repaired));
            }
        }
        text + "\n"
    }
}

/// A table of one number of both rules.
fn compared<'a>(title: &str, lines: &'a [Line], number: impl Fn(&'a Line) -> &'a Comparison) -> String {
    let mut text = format!(
        "\n{title}; the difference with its 95 % interval\n\
         density  published   repaired       difference  layouts  left out\n"
    );
    for line in lines {
        let Comparison { pairs, left_out, published, repaired, difference, margin } = number(line);
        let difference = format!("{difference:+.2} ± {margin:.2}");
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<7}  {published:>9.2}  {repaired:>9.2}  {difference:>15}  {pairs:>7}  {left_out:>8}",
            line.density
        );
    }
    text
}
