//! What can be asked of a table, as a person asks it: options with values, from which its settings are read.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::notice::Count;

use tautline_sim::named_values::NamedValues;
use tautline_sim::value_parser;

/// A setting of a table, among its settings of type `S`.
#[derive(Debug)]
pub struct Parameter<S> {
    /// How it is given.
    pub option: Given,
    /// The texts that stand for it where it is not given. None if that is said elsewhere.
    pub show: fn(&S) -> Vec<String>,
    /// Reads it.
    pub read: fn(&mut S, &[&str]) -> Result<(), String>,
}

/// An option of a table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Given {
    /// Its name.
    pub name: &'static str,
    /// What stands for its value in a help text.
    pub value: &'static str,
    /// What it is, as a help text has it.
    pub about: &'static str,
    /// How many values it has, and of which kind.
    pub values: Values,
}

/// The values of an option.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Values {
    /// It is given or not.
    None,
    /// One.
    One,
    /// One of these words, each with a line about it.
    Word(Vec<(&'static str, &'static str)>),
    /// Some, with commas between them.
    List,
    /// One each time that it is given.
    Repeated,
}

impl<S> Parameter<S> {
    /// What is given or not.
    pub const fn flag(
        name: &'static str,
        about: &'static str,
        read: fn(&mut S, &[&str]) -> Result<(), String>,
    ) -> Self {
        Self::new(Given { name, value: "", about, values: Values::None }, |_| Vec::new(), read)
    }

    /// What has one value.
    pub const fn one(
        name: &'static str,
        value: &'static str,
        about: &'static str,
        show: fn(&S) -> Vec<String>,
        read: fn(&mut S, &[&str]) -> Result<(), String>,
    ) -> Self {
        Self::new(Given { name, value, about, values: Values::One }, show, read)
    }

    /// What has several values, with commas between them.
    pub const fn list(
        name: &'static str,
        about: &'static str,
        show: fn(&S) -> Vec<String>,
        read: fn(&mut S, &[&str]) -> Result<(), String>,
    ) -> Self {
        Self::new(Given { name, value: "LIST", about, values: Values::List }, show, read)
    }

    /// One with other things about it.
    pub const fn new(
        option: Given,
        show: fn(&S) -> Vec<String>,
        read: fn(&mut S, &[&str]) -> Result<(), String>,
    ) -> Self {
        Self { option, show, read }
    }
}

impl Values {
    /// The words of `T`.
    pub fn words<T: NamedValues>() -> Self {
        Self::Word(T::WORDS.iter().map(|&(_, word, about)| (word, about)).collect())
    }
}

/// Puts the last of the texts, read by `read`, into a place.
///
/// # Errors
/// As `read`.
pub(super) fn put<T, E: Into<String>>(
    place: &mut T,
    texts: &[&str],
    read: impl Fn(&str) -> Result<T, E>,
) -> Result<(), String> {
    for text in texts {
        *place = read(text).map_err(Into::into)?;
    }
    Ok(())
}

/// Puts all texts, read by `read`, into a list.
///
/// # Errors
/// As `read`.
pub(super) fn put_all<T, E: Into<String>>(
    list: &mut Vec<T>,
    texts: &[&str],
    read: impl Fn(&str) -> Result<T, E>,
) -> Result<(), String> {
    *list = texts.iter().map(|text| read(text).map_err(Into::into)).collect::<Result<_, _>>()?;
    Ok(())
}

/// The text of one value.
pub(super) fn shown<T: ToString + ?Sized>(value: &T) -> Vec<String> {
    vec![value.to_string()]
}

/// The texts of several values.
pub(super) fn all_shown(values: &[impl ToString]) -> Vec<String> {
    values.iter().map(ToString::to_string).collect()
}

/// How many senders make a node silent: a [`Count`] that is stored.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub struct Senders(pub Count);

impl TryFrom<u8> for Senders {
    type Error = String;

    fn try_from(count: u8) -> Result<Self, Self::Error> {
        value_parser::count(&count.to_string()).map(Self)
    }
}

impl From<Senders> for u8 {
    fn from(Senders(count): Senders) -> Self {
        count.get()
    }
}

impl Senders {
    /// One sender.
    pub const ONE: Self = Self(Count::ONE);

    /// Reads one.
    ///
    /// # Errors
    /// What to write.
    pub fn read(text: &str) -> Result<Self, String> {
        value_parser::count(text).map(Self)
    }
}
