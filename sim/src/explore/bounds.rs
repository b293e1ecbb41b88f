//! The bounds of a hunt, how far it is, and how much it has searched: plain data of any scheme.

use std::fmt;
use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::value::RawValue;
use tautline_io::diagnostic::Diagnostic;
use tautline_proofs::chain::areas::AreaSearch;
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::plural::{counted, listed};

use super::clause::ClauseId;

/// A bound that some hunts take and others do not.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Bound {
    /// The most walls that are met in one run.
    Walls,
    /// The most cells of an area, where all areas are searched.
    Cells,
    /// The most sensors that are missed in one run.
    Misses,
    /// The most messages that are lost in one run.
    Losses,
    /// How far a fix may be off.
    Error,
    /// How far robots hear each other.
    Range,
    /// The file in which the hunt is kept.
    Resume,
}

impl Bound {
    /// The field that gives it.
    pub const fn field(self) -> &'static str {
        match self {
            Self::Walls => "max-walls",
            Self::Cells => "max-cells",
            Self::Misses => "max-misses",
            Self::Losses => "max-losses",
            Self::Error => "error",
            Self::Range => "range",
            Self::Resume => "resume",
        }
    }

    /// Why a hunt that takes others does not take this one.
    pub(super) fn refused_by(self, takes: &[Self]) -> (String, String) {
        let taken = ["robots", "size", "budget"].into_iter().chain(takes.iter().map(|bound| bound.field()));
        let taken = listed(taken.map(|field| format!("`{field}`")));
        let field = self.field();
        (format!("`{field}` does not bound this hunt"), format!("leave it out; this hunt takes {taken}"))
    }
}

/// A hunt that is dealt out.
#[derive(Clone, Debug)]
pub struct Dealt {
    /// The deal, as a plan has it.
    pub deal: Box<RawValue>,
    /// About how much each shard has.
    pub left: Vec<u64>,
    /// Of what.
    pub of: &'static str,
    /// Team moves that were made to deal it out.
    pub moves: u64,
}

impl fmt::Display for Dealt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (shards, sum) = (self.left.len() as u64, self.left.iter().sum::<u64>());
        let (mean, most) = (sum / shards.max(1), self.left.iter().max().copied().unwrap_or(0));
        let (shards, mean, most) = (counted(shards, "shard"), counted(mean, self.of), counted(most, self.of));
        write!(f, "{shards} of about {mean}, the largest {most}")?;
        match self.moves {
            0 => f.write_str("."),
            made => write!(f, "; {made} are made already."),
        }
    }
}

/// Hears how far a hunt is.
pub trait Hunter {
    /// The hunt is so far. Whoever breaks ends it.
    fn hears(&mut self, far: Far<'_>) -> ControlFlow<()>;

    /// The file in which the hunt is kept could not be written at the end.
    fn is_left_out(&mut self, fault: &Diagnostic);
}

/// How far a hunt is.
#[derive(Debug)]
pub enum Far<'a> {
    /// So far in a tree, whose size can be estimated.
    Tree(&'a Progress<'a>),
    /// So far, in words.
    Words(String),
}

/// How much a hunt has searched, and within which bounds, under the names that JSON has for them.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[expect(
    missing_docs,
    reason = "the fields are named as in the options of the hunts and in the text for people"
)]
pub enum Facts {
    /// Of runs in one area.
    Runs { runs: u64, moves: u64, longest: u32, max_walls: u32 },
    /// Of runs in all areas of at most so many cells.
    Areas { runs: u64, moves: u64, max_walls: u32, max_cells: u32, areas: Vec<AreaSearch> },
    /// Of layouts with missed sensors, each searched by itself.
    Layouts { size: String, layouts: u64, states: u64, steps: u64, max_misses: u8 },
    /// Of states, with lost messages and wrong fixes.
    StatesWithLosses {
        size: String,
        states: u64,
        steps: u64,
        max_walls: Option<u32>,
        max_losses: u8,
        error: Option<f64>,
    },
    /// Of states.
    States {
        size: String,
        states: u64,
        steps: u64,
        max_walls: Option<u32>,
        #[serde(skip_serializing_if = "Option::is_none")]
        range: Option<u16>,
    },
}

/// The bound up to which every layout was covered, if any was.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CoveredBound {
    /// So many walls.
    WallsDone(Option<u32>),
    /// Areas of so many cells.
    CellsDone(Option<u32>),
    /// So many missed sensors.
    MissesDone(Option<u8>),
    /// Layouts of so many nodes.
    NodesDone(Option<usize>),
}

/// How large a run is, under the names that JSON has for it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[expect(missing_docs, reason = "the fields are named as in the text for people")]
pub enum RunSize {
    /// In the one area that is searched: `runs` of them break the clause.
    Runs { runs: u64, walls: usize, steps: usize },
    /// In an area of its own.
    Area { columns: usize, rows: usize, walls: usize, steps: usize },
    /// On a lattice of its own; `drives` are those of its team moves in which a robot does not stay.
    Lattice { columns: usize, rows: usize, walls: usize, drives: usize },
    /// In an area of its own, with missed sensors.
    Misses { misses: usize, columns: i16, rows: i16, steps: u32 },
}

/// How a run that was found is shown.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Exhibit {
    /// By its last team move. It is stored as a run that breaks this clause.
    Run(ClauseId),
    /// By its layout. A run without end that its team does not tell from others is not stored.
    Endless,
    /// By what happens in it. It is stored as a run that breaks this clause.
    Story(ClauseId, String),
    /// By what happens in it. No file tells it.
    Told(String),
}
