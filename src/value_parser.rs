//! The values of options: words of the library, numbers, cells and sizes.

use std::ffi::OsStr;
use std::str::FromStr;

use clap::builder::{OsStringValueParser, PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command, Error};
use tautline_io::named_values::NamedValues;
use tautline_io::value_parser::real;
use tautline_kernel::ground::Cell;

use super::catalogue::CATALOGUE;
use tautline_grids::layout::Size;
use tautline_sim::explore::{RuleId, Scheme};

/// Reads one of the words for values of `T`; the help says what each of them means.
pub(crate) fn chosen<T: NamedValues + Send + Sync>() -> impl TypedValueParser<Value = T> {
    one_of(T::WORDS.iter().copied())
}

/// Reads the name of a scheme.
pub(crate) fn scheme() -> impl TypedValueParser<Value = Scheme> {
    one_of(CATALOGUE.schemes().map(|scheme| (scheme, scheme.name, scheme.about)))
}

/// Reads the name of a scheme of which something is hunted.
pub(crate) fn hunted_scheme() -> impl TypedValueParser<Value = Scheme> {
    let hunted = CATALOGUE.schemes().filter(|scheme| scheme.is_hunted());
    one_of(hunted.map(|scheme| (scheme, scheme.name, scheme.about)))
}

/// Reads the name of a rule. Whether its scheme offers it is for the scheme to say, which knows what it offers.
pub(crate) fn rule() -> impl TypedValueParser<Value = RuleId> {
    AnyRule
}

/// Reads a text that may name a file.
pub(crate) fn file_or_word() -> impl TypedValueParser<Value = String> {
    OsStringValueParser::new().try_map(|text| {
        let text = text.into_string().map_err(|_| "rename the file, so that its name is UTF-8")?;
        if text.is_empty() { Err("it is empty, so name a file") } else { Ok(text) }
    })
}

/// Any word; those of all schemes are what a shell completes.
#[derive(Clone, Copy)]
struct AnyRule;

impl TypedValueParser for AnyRule {
    type Value = RuleId;

    fn parse_ref(&self, _: &Command, _: Option<&Arg>, word: &OsStr) -> Result<RuleId, Error> {
        let word = word.to_string_lossy();
        let known = CATALOGUE.rules().into_iter().map(|rule| rule.name).find(|name| name.as_str() == word);
        Ok(known.unwrap_or_else(|| RuleId::new(word.into_owned().leak())))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let rules = CATALOGUE.rules().into_iter();
        Some(Box::new(rules.map(|rule| PossibleValue::new(rule.name.as_str()).help(rule.about))))
    }
}

/// Reads a word as the value that stands before it; what stands behind it is the help about it.
fn one_of<T: Copy + Send + Sync + 'static>(
    words: impl Iterator<Item = (T, &'static str, &'static str)>,
) -> impl TypedValueParser<Value = T> {
    let words: Vec<_> = words.collect();
    let values: Vec<_> = words.iter().map(|&(_, word, about)| PossibleValue::new(word).help(about)).collect();
    PossibleValuesParser::new(values).try_map(move |chosen| {
        let found = words.iter().find(|&&(_, word, _)| word == chosen);
        found.map(|&(value, ..)| value).ok_or("it is none of the words")
    })
}

/// A cell as `X,Y`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CellArg(pub(crate) Cell);

impl FromStr for CellArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = text.split_once(',').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
        parts.map(|(x, y)| Self(Cell::new(x, y))).ok_or("write column and row as X,Y, for example 7,7")
    }
}

/// Columns and rows as `WxH`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SizeArg(pub(crate) Size);

impl FromStr for SizeArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = text.split_once('x').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
        let (width, height) = parts.ok_or("write columns and rows as WIDTHxHEIGHT, for example 7x7")?;
        let size = Size::new(width, height);
        size.map(Self).map_err(|problem| problem.to_string())
    }
}

/// A whole number above 0, of a type without 0.
pub(crate) fn positive<T: FromStr>(text: &str) -> Result<T, String> {
    let largest = u128::MAX >> (128 - 8 * size_of::<T>());
    text.parse().map_err(|_| format!("write a whole number from 1 to {largest}"))
}

/// The most metres and seconds that an option takes.
pub(crate) const MOST: f64 = 1e6;

pub(crate) fn from_0(text: &str) -> Result<f64, &'static str> {
    real(text).ok().filter(|number| (0.0..=MOST).contains(number)).ok_or("write a number from 0 to 1000000")
}

pub(crate) fn above_0(text: &str) -> Result<f64, &'static str> {
    from_0(text).ok().filter(|&number| number >= 1e-3).ok_or("write a number from 0.001 to 1000000")
}
