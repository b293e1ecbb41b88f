//! Options whose values are words of the library.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use tautline_sim::words::Worded;

/// Reads one of the words for values of `T`; the help says what each of them means.
pub(crate) fn chosen<T: Worded + Send + Sync>() -> impl TypedValueParser<Value = T> {
    let values = T::WORDS.iter().map(|(_, word, about)| PossibleValue::new(*word).help(*about));
    PossibleValuesParser::new(values).try_map(|word| T::of(&word).ok_or("it is none of the words"))
}
