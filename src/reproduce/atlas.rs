//! `tautline reproduce atlas`: what becomes of all runs in all layouts.

use std::fmt::Write;

use clap::Args;
use serde::Serialize;
use tautline_proofs::words::counted;

use crate::output::Output;
use crate::{Exit, Format, FormatArgs, progress};
use tautline_sim::explore::RuleName;
use tautline_sim::fault::Halt;
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::atlas::{self, BEYOND, Broken, CLAUSES, DEEP, Line, QUICK};

const EXAMPLES: &str = "\
Examples:
  tautline reproduce atlas
  tautline reproduce atlas --deep --format json";

/// What becomes of all runs in all layouts with few walls, by rule and number of robots.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Atlas {
    /// More walls: many minutes instead of seconds.
    #[arg(long)]
    deep: bool,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Drawn {
    id: &'static str,
    lines: Vec<Line>,
}

impl Atlas {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let sheets = if self.deep { DEEP } else { QUICK };
        let mut lines = Vec::new();
        for sheet in sheets {
            for rule in RuleName::ALL {
                let bar = progress::bar(format!("{} robots, {rule}", sheet.robots), 1);
                lines.push(atlas::line(sheet, rule, &mut |now| progress::show(&bar, now))?);
                bar.finish_and_clear();
            }
        }
        // That some chain-reachable cells are missed is registered; all else the repaired rule must keep to.
        let is_broken = |line: &Line| {
            line.rule == RuleName::Repaired && line.broken.iter().any(|broken| broken.clause != BEYOND)
        };
        let exit = if lines.iter().any(is_broken) { Exit::Violation } else { Exit::Expected };
        match self.format.format {
            Format::Json => out.json(&Drawn { id: Reproduction::Atlas.id(), lines })?,
            Format::Text => out.text(text(&lines))?,
        }
        Ok(exit)
    }
}

fn text(lines: &[Line]) -> String {
    let mut text = String::from(
        "All runs in all layouts of (2N−1)² cells, the base in the middle, by the walls that a run meets at most\n\n",
    );
    let heads = ["N", "walls", "rule", "layouts", "runs", "team moves", "longest"].map(str::to_owned);
    let head = heads.into_iter().chain(CLAUSES.map(str::to_owned)).collect();
    let row = |line: &Line| {
        let Line { rule, robots, max_walls, layouts, runs, moves, longest, .. } = line;
        let counts = CLAUSES.map(|clause| match line.broken.iter().find(|broken| broken.clause == clause) {
            Some(broken) => broken.runs.to_string(),
            None if clause == BEYOND && !line.looked_beyond => "-".to_owned(),
            None => "0".to_owned(),
        });
        [
            robots.to_string(),
            max_walls.to_string(),
            rule.to_string(),
            layouts.to_string(),
            runs.to_string(),
            moves.to_string(),
            longest.to_string(),
        ]
        .into_iter()
        .chain(counts)
        .collect()
    };
    let rows: Vec<Vec<String>> = [head].into_iter().chain(lines.iter().map(row)).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    for row in &rows {
        let cells: Vec<String> =
            row.iter().enumerate().map(|(column, cell)| format!("{cell:>0$}", width(column))).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", cells.join("  "));
    }
    text.push_str(
        "\nlayouts: with at most so many walls, all covered · runs, team moves: leaves and edges of the tree of runs ·\n\
         longest: team moves of the longest run · CHAIN-…: runs that break the clause and none before it; they end\n\
         there · -: not looked for\n\
         \nThe smallest counterexamples\n",
    );
    for line in lines {
        for Broken { clause, walls, steps, .. } in &line.broken {
            let walls: Vec<String> = walls.iter().map(|[one, other]| format!("{one}|{other}")).collect();
            let _ = writeln!(
                text,
                "{} robots, {}: {clause}, {}, {}: {}",
                line.robots,
                line.rule,
                counted(walls.len(), "wall"),
                counted(*steps, "team move"),
                walls.join(" ")
            );
        }
    }
    text
}
