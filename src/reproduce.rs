//! `tautline reproduce`: tables again.

mod agents;
mod antenna_fig4;
mod atlas;
mod journeys;
mod notice_fig5;
mod optimum;
mod repair_cost;
mod rescue_fig8;
mod table;

use clap::{Args, Subcommand};
use serde::Serialize;

use super::output::Output;
use super::{Exit, Format, FormatArgs};
use tautline_sim::fault::Halt;
use tautline_sim::reproduce::Reproduction;
use tautline_sim::reproduce::agents::Figure;
use tautline_sim::reproduce::journeys::Figure as Journey;

const EXAMPLES: &str = "\
Examples:
  tautline reproduce
  tautline reproduce repair-cost
  tautline reproduce repair-cost --help";

/// Measure a table again; without an id, list them.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
#[command(subcommand_value_name = "ID", subcommand_help_heading = "Tables")]
pub(super) struct Reproduce {
    #[command(subcommand)]
    table: Option<Table>,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Debug, Subcommand)]
enum Table {
    RepairCost(repair_cost::RepairCost),
    Optimum(optimum::Optimum),
    Atlas(atlas::Atlas),
    /// What agents explore by their number, with missed sensors.
    #[command(name = "bricks-fig11")]
    BricksFig11(agents::Agents),
    /// What agents explore by the area, with missed sensors.
    #[command(name = "bricks-fig12")]
    BricksFig12(agents::Agents),
    /// How long agents take, with none missed.
    BricksIdeal(agents::Agents),
    #[command(name = "antenna-fig4")]
    AntennaFig4(antenna_fig4::AntennaFig4),
    #[command(name = "notice-fig5")]
    NoticeFig5(notice_fig5::NoticeFig5),
    /// The ways of a robot by Reich's scheme, TAN and Verma's, as a picture.
    #[command(name = "rescue-fig6")]
    RescueFig6(journeys::Journeys),
    /// How far a robot walks by TAN and its rivals, by the number of nodes.
    #[command(name = "rescue-fig7")]
    RescueFig7(journeys::Journeys),
    #[command(name = "rescue-fig8")]
    RescueFig8(rescue_fig8::RescueFig8),
    /// How far a robot walks round a large obstacle.
    #[command(name = "rescue-fig9")]
    RescueFig9(journeys::Journeys),
    /// How far a robot walks round four large obstacles.
    #[command(name = "rescue-fig10")]
    RescueFig10(journeys::Journeys),
}

#[derive(Serialize)]
struct Listed {
    id: &'static str,
    shows: &'static str,
}

#[derive(Serialize)]
struct List {
    reproductions: Vec<Listed>,
}

impl Reproduce {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        match &self.table {
            None => self.list(out),
            Some(Table::RepairCost(table)) => table.run(out),
            Some(Table::Optimum(table)) => table.run(out),
            Some(Table::Atlas(table)) => table.run(out),
            Some(Table::BricksFig11(table)) => table.run(Reproduction::BricksFig11, Figure::Agents, out),
            Some(Table::BricksFig12(table)) => table.run(Reproduction::BricksFig12, Figure::Area, out),
            Some(Table::BricksIdeal(table)) => table.run(Reproduction::BricksIdeal, Figure::Ideal, out),
            Some(Table::AntennaFig4(table)) => table.run(out),
            Some(Table::NoticeFig5(table)) => table.run(out),
            Some(Table::RescueFig6(table)) => table.run(Reproduction::RescueFig6, Journey::Trajectories, out),
            Some(Table::RescueFig7(table)) => table.run(Reproduction::RescueFig7, Journey::Ratios, out),
            Some(Table::RescueFig8(table)) => table.run(out),
            Some(Table::RescueFig9(table)) => table.run(Reproduction::RescueFig9, Journey::OneObstacle, out),
            Some(Table::RescueFig10(table)) => {
                table.run(Reproduction::RescueFig10, Journey::FourObstacles, out)
            }
        }
    }

    fn list(&self, out: &mut Output) -> Result<Exit, Halt> {
        let listed =
            |reproduction: Reproduction| Listed { id: reproduction.id(), shows: reproduction.words() };
        let reproductions: Vec<Listed> = Reproduction::ALL.into_iter().map(listed).collect();
        match self.format.format {
            Format::Json => out.json(&List { reproductions })?,
            Format::Text => {
                for Listed { id, shows } in reproductions {
                    out.text(format_args!("{id}: {shows}\n"))?;
                }
            }
        }
        Ok(Exit::Expected)
    }
}
