//! `tautline show`: a layout or the environments of a cell, drawn.

use std::path::PathBuf;

use clap::Args;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::Halt;
use tautline_kernel::ground::Cell;

use super::exit::Exit;
use super::layout_args::LayoutArgs;
use super::options::{ForceArgs, Format, FormatArgs, refuse_needless};
use super::output::Output;
use tautline_grids::layout::ColumnRow;
use tautline_io::svg::Panel;
use tautline_sim::draw::svg;
use tautline_sim::draw::{self, Environment};

const EXAMPLES: &str = "\
Examples:
  tautline show rooms-a
  tautline show office:30x30:4x4 --seed 3 > office.txt
  tautline show environments";

/// The word that stands for the environments of a cell, in place of a layout.
const ENVIRONMENTS: &str = "environments";

/// Draw a layout, or with `environments` the three sets of cells round a cell that the rules of chains speak of.
///
/// They are E_N, E_S and E_C: the cells to which a robot can go from the cell in one team move, those in which its
/// neighbours in the chain plan to be, and those that lie wholly within its radio coverage. SPEC.md explains them.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Show {
    #[command(flatten)]
    layout: LayoutArgs,
    /// Store the drawing as a picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct LayoutJson<'a> {
    layout: &'a str,
    width: i16,
    height: i16,
    free_cells: usize,
    walls: usize,
    #[schemars(with = "ColumnRow")]
    base: Cell,
    robots: Option<u16>,
    drawing: String,
}

#[derive(JsonSchema, Serialize)]
struct EnvironmentJson {
    symbol: &'static str,
    /// Columns and rows from the centre.
    #[schemars(with = "Vec<ColumnRow>")]
    offsets: Vec<Cell>,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct EnvironmentsJson {
    environments: [EnvironmentJson; 3],
}

impl Show {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        if self.layout.layout == ENVIRONMENTS {
            let why = "the environments are the same in every layout";
            refuse_needless([("--seed", self.layout.seed.is_some())], why)?;
            self.layout.refuse_map_options(why)?;
            let [file] = self.force.files([&self.svg], [])?;
            let title = "The environments of a cell";
            out.store(file, |file| file.draw(Ok(Panel::picture(title, &svg::environments()))))?;
            match self.format.format {
                Format::Text => out.text(draw::environments())?,
                Format::Json => out.json(&EnvironmentsJson { environments: Environment::ALL.map(shown) })?,
            }
            return Ok(Exit::Expected);
        }
        let layout = self.layout.load()?;
        refuse_needless([("--seed", self.layout.has_other_seed())], "nothing here is left to chance")?;
        let [file] = self.force.files([&self.svg], self.layout.inputs())?;
        if file.is_some() {
            svg::check_size(layout.size().area())?;
        }
        out.store(file, |file| file.draw(Ok(Panel::picture("A layout", &[svg::layout(&layout)]))))?;
        let drawing = layout.to_string();
        match self.format.format {
            Format::Text => out.text(drawing)?,
            Format::Json => out.json(&LayoutJson {
                layout: &self.layout.layout,
                width: layout.width(),
                height: layout.height(),
                free_cells: layout.free_cells(),
                walls: layout.walls().count(),
                base: layout.base().map_or_else(|| layout.default_base(), Ok)?,
                robots: layout.robots(),
                drawing,
            })?,
        }
        Ok(Exit::Expected)
    }
}

fn shown(environment: Environment) -> EnvironmentJson {
    EnvironmentJson { symbol: environment.symbol(), offsets: environment.offsets().collect() }
}
