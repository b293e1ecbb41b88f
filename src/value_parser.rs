//! Options whose values are words of the library.

use std::ffi::OsStr;

use clap::builder::{OsStringValueParser, PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command, Error};
use tautline_io::named_values::NamedValues;
use tautline_sim::explore::{RuleId, Scheme};

use super::CATALOGUE;

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
    OsStringValueParser::new()
        .try_map(|text| text.into_string().map_err(|_| "rename the file, so that its name is UTF-8"))
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
