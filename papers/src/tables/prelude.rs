//! The names that most tables use: settings, runs and estimates, and the columns and series in which they are told.

pub(super) use schemars::JsonSchema;
pub(super) use serde::{Deserialize, Serialize};
pub(super) use tautline_proofs::plural::counted;

pub(super) use super::columns::Columns;
pub(super) use super::estimates::{count, ends, mean, percent, plain, ratio, seconds, share, text};
pub(super) use super::paper::{self, PrintedFigure};
pub(super) use super::parameter::{
    Senders, flag, from_to, joined, layout_name, list, nested, one, renamed, repeated, settings, thousandths,
    word,
};
pub(super) use super::runs::{Run, at, of_teams, pairs, runs};
pub(super) use super::sentences::{Judgement, Verdict, always, at_least, below, within};
pub(super) use super::table::{Description, Observer, Results, Table, Threads, based, generated, usage};
pub(super) use crate::chart::{Axis, LineChart, Point, Series};
pub(super) use tautline_field::stats::{Estimate, decimals, hundredths, rounded};
pub(super) use tautline_grids::layout::Layout;
pub(super) use tautline_io::diagnostic::{Diagnostic, Halt};
pub(super) use tautline_io::number::Number;
pub(super) use tautline_io::text_table::Figures;
pub(super) use tautline_io::value_parser::{number, real, whole};
