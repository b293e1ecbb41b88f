//! Options whose values are words of the library.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
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

/// Reads the name of a rule that a scheme offers.
pub(crate) fn rule() -> impl TypedValueParser<Value = RuleId> {
    one_of(CATALOGUE.rules().into_iter().map(|rule| (rule.name, rule.name.as_str(), rule.about)))
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
