//! `tautline reproduce optimum`: how far the chain is from a team that knows the walls.

use std::fmt::Write;

use clap::Args;
use serde::Serialize;

use crate::output::Output;
use crate::{Exit, Format, FormatArgs, progress};
use tautline_sim::draw::{self, Block};
use tautline_sim::explore::RuleName;
use tautline_sim::fault::{Halt, Watch};
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::optimum::{self, Field, Line, Worst};

const EXAMPLES: &str = "\
Examples:
  tautline reproduce optimum
  tautline reproduce optimum --max-walls 2 --format json";

/// How far the chain is from the fewest team moves of a team that knows the walls.
///
/// Two robots in all layouts of 3×3 cells, three in those of 5×5 cells with few walls.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Optimum {
    /// Most walls of a layout of three robots; one more takes ten times as long.
    #[arg(long, value_name = "WALLS", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=6))]
    max_walls: u32,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Measured {
    id: &'static str,
    lines: Vec<Line>,
}

impl Optimum {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let three_robots = (0..=self.max_walls).map(Field::three_robots);
        let fields: Vec<Field> = std::iter::once(Field::TWO_ROBOTS).chain(three_robots).collect();
        let layouts = fields.iter().map(|field| field.layouts()).sum();
        let measure = |watch: &Watch<'_>| -> Result<Vec<[Line; 2]>, Halt> {
            fields.iter().map(|&field| optimum::measure(field, watch)).collect()
        };
        let lines = progress::during("solving", layouts, measure)?.concat();
        let is_below = lines.iter().any(|line| line.below > 0);
        match self.format.format {
            Format::Json => out.json(&Measured { id: Reproduction::Optimum.id(), lines })?,
            Format::Text => out.text(text(&lines)?)?,
        }
        Ok(if is_below { Exit::Violation } else { Exit::Expected })
    }
}

fn text(lines: &[Line]) -> Result<String, Halt> {
    let mut text = String::from(
        "Team moves until the last chain-reachable cell is explored, by the fewest of a team that knows the walls,\n\
         in all layouts of (2N−1)² cells with so many walls\n\n\
         robots  walls  rule       layouts  walled in  missed  beyond  below  optimal  mean  worst\n",
    );
    for line in lines {
        let Line { robots, walls: [fewest, most], rule, .. } = *line;
        let walls = if fewest == most { most.to_string() } else { format!("{fewest}…{most}") };
        let mean = line.mean.map_or("-".to_owned(), |mean| format!("{mean:.2}"));
        let worst = line.worst.as_ref().map_or("-".to_owned(), ratio);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{robots:<6}  {walls:<5}  {rule:<9}  {:>7}  {:>9}  {:>6}  {:>6}  {:>5}  {:>7}  {mean:>4}  {worst}",
            line.layouts, line.walled_in, line.missed, line.beyond, line.below, line.optimal
        );
    }
    text.push_str(
        "\nwalled in: nothing to explore · missed: the chain leaves a chain-reachable cell unexplored; not compared ·\n\
         beyond: it explores one that is not chain-reachable · below, optimal: it takes fewer, as few\n",
    );
    for robots in [2, 3] {
        let worst = lines.iter().filter(|line| line.robots == robots && line.rule == RuleName::Repaired);
        let worst = worst.filter_map(|line| line.worst.as_ref().map(|worst| (line, worst)));
        if let Some((line, worst)) =
            worst.reduce(|one, other| if is_worse(other.1, one.1) { other } else { one })
        {
            text.push_str(&drawing(line, worst)?);
        }
    }
    Ok(text)
}

/// When each cell is explored, by the chain and in the optimum.
fn drawing(line: &Line, worst: &Worst) -> Result<String, Halt> {
    let (setup, charts) = optimum::charts(line, worst)?;
    let titles = [format!("chain: {}", worst.chain), format!("optimum: {}", worst.optimum)];
    let lines = charts.map(|chart| draw::order(&setup, &chart).lines().map(str::to_owned).collect());
    let blocks: Vec<Block> =
        titles.into_iter().zip(lines).map(|(title, lines)| Block { title, lines }).collect();
    let title = format!("The worst for {} robots ({}): when each cell is explored", line.robots, line.rule);
    Ok(format!("\n{title}\n\n{}", draw::beside(blocks)))
}

const fn is_worse(one: &Worst, other: &Worst) -> bool {
    one.chain * other.optimum > other.chain * one.optimum
}

fn ratio(worst: &Worst) -> String {
    let Worst { chain, optimum, layout: _ } = worst;
    format!("{chain}/{optimum} = {:.2}", f64::from(*chain) / f64::from(*optimum))
}
