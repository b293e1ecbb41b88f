//! The settings of a table, as a person gives them: options with values. A table lists its settings with the macro
//! `settings!`, each with its type, its default, and how a person gives it.

use std::fmt;
use std::ops::RangeInclusive;

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use tautline_kernel::notice::Count;

use tautline_grids::layout;
use tautline_io::named_values::NamedValues;
use tautline_io::value_parser::{self, within};

/// The settings of a table.
pub trait Settings: Default + Serialize + DeserializeOwned + Sync + 'static {
    /// The settings as a person gives them, in the order in which a help text has them.
    fn parameters() -> Vec<Parameter<Self>>;
}

/// A setting of a table, among its settings of type `S`.
pub struct Parameter<S> {
    /// How it is given.
    pub option: TableOption,
    /// The texts that stand for it where it is not given. None if that is said elsewhere.
    pub show: Show<S>,
    /// Reads it.
    pub read: Reader<S>,
}

type Show<S> = Box<dyn Fn(&S) -> Vec<String>>;
type Reader<S> = Box<dyn Fn(&mut S, &[&str]) -> Result<(), String>>;

impl<S> fmt::Debug for Parameter<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.option.fmt(f)
    }
}

/// An option of a table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TableOption {
    /// Its name.
    pub name: &'static str,
    /// The stand-in for its value in a help text.
    pub value: &'static str,
    /// A description for a help text.
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

/// Makes a structure of settings, its default and its parameters. A setting has documentation, which is
/// its help text as well, a field, its default, and how a person gives it: by one of the functions below.
macro_rules! settings {
    ($(#[$meta:meta])* $pub:vis struct $name:ident {$(
        $(#[doc = $about:literal])+
        $vis:vis $field:ident: $type:ty = $default:expr, $how:expr;
    )*}) => {
        $(#[$meta])*
        #[derive(Clone, PartialEq, Debug, schemars::JsonSchema, serde::Serialize, serde::Deserialize)]
        $pub struct $name {
            $($(#[doc = $about])+ $vis $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default),* }
            }
        }

        impl $crate::tables::parameter::Settings for $name {
            fn parameters() -> Vec<$crate::tables::parameter::Parameter<Self>> {
                let parameters: Vec<Vec<_>> = vec![
                    $($crate::tables::parameter::of_field(
                        concat!($($about),+),
                        |all: &Self| &all.$field,
                        |all: &mut Self| &mut all.$field,
                        $how,
                    )),*
                ];
                parameters.into_iter().flatten().collect()
            }
        }
    };
}
pub(super) use settings;

/// Parameters of a field as those of the settings that have it. Where they do not say what they are, it is `about`.
pub(super) fn of_field<S: 'static, T: 'static>(
    about: &'static str,
    of: fn(&S) -> &T,
    of_mut: fn(&mut S) -> &mut T,
    parameters: Vec<Parameter<T>>,
) -> Vec<Parameter<S>> {
    let outer = |Parameter { option, show, read }: Parameter<T>| Parameter {
        option: TableOption {
            about: if option.about.is_empty() { about.trim_ascii() } else { option.about },
            ..option
        },
        show: Box::new(move |all: &S| show(of(all))),
        read: Box::new(move |all: &mut S, texts: &[&str]| read(of_mut(all), texts)),
    };
    parameters.into_iter().map(outer).collect()
}

/// Settings within settings.
pub(super) fn nested<T: Settings>() -> Vec<Parameter<T>> {
    T::parameters()
}

/// A setting that is given or not; `given` is its value if it is.
pub(super) fn flag<T: Copy + 'static>(name: &'static str, given: T) -> Vec<Parameter<T>> {
    let read = move |value: &mut T, _: &[&str]| {
        *value = given;
        Ok(())
    };
    let option = TableOption { name, value: "", about: "", values: Values::None };
    vec![Parameter { option, show: Box::new(|_| Vec::new()), read: Box::new(read) }]
}

/// A setting with one value.
pub(super) fn one<T: ToString + 'static, E: Into<String>>(
    name: &'static str,
    value: &'static str,
    read: impl Fn(&str) -> Result<T, E> + 'static,
) -> Vec<Parameter<T>> {
    single((name, value, Values::One), T::to_string, read)
}

/// A setting of so many thousandths, which is given and shown as a decimal number.
pub(super) fn thousandths<T: Copy + TryFrom<u32> + Into<u32> + 'static>(
    name: &'static str,
    value: &'static str,
    range: RangeInclusive<u32>,
) -> Vec<Parameter<T>> {
    let decimal = |thousandths: u32| (f64::from(thousandths) / 1000.0).to_string();
    let remedy = format!("write a number from {} to {}", decimal(*range.start()), decimal(*range.end()));
    let read = move |text: &str| {
        let thousandths = value_parser::real(text)? * 1000.0;
        let is_in = (f64::from(*range.start())..=f64::from(*range.end())).contains(&thousandths);
        let found = is_in.then(|| T::try_from(thousandths.round() as u32).ok()).flatten();
        found.ok_or_else(|| remedy.clone())
    };
    single((name, value, Values::One), move |&value| decimal(value.into()), read)
}

/// A setting chosen by a word.
pub(super) fn word<T: NamedValues>(name: &'static str, value: &'static str) -> Vec<Parameter<T>> {
    let words = Values::Word(T::WORDS.iter().map(|&(_, word, about)| (word, about)).collect());
    let read = |word: &str| T::of(word).ok_or("it is none of the words");
    single((name, value, words), |value| value.word().to_owned(), read)
}

/// A setting with several values, with commas between them.
pub(super) fn list<T: ToString + 'static, E: Into<String>>(
    name: &'static str,
    read: impl Fn(&str) -> Result<T, E> + 'static,
) -> Vec<Parameter<Vec<T>>> {
    several((name, "LIST", Values::List), |all| all.iter().map(T::to_string).collect(), read)
}

/// As [`list`], with commas between the values that stand for it, too.
pub(super) fn joined<T: ToString + 'static, E: Into<String>>(
    name: &'static str,
    read: impl Fn(&str) -> Result<T, E> + 'static,
) -> Vec<Parameter<Vec<T>>> {
    let show = |all: &Vec<T>| vec![all.iter().map(T::to_string).collect::<Vec<_>>().join(",")];
    several((name, "LIST", Values::List), show, read)
}

/// A setting with one value each time that it is given.
pub(super) fn repeated<T: 'static, E: Into<String>>(
    name: &'static str,
    value: &'static str,
    show: fn(&T) -> String,
    read: impl Fn(&str) -> Result<T, E> + 'static,
) -> Vec<Parameter<Vec<T>>> {
    several((name, value, Values::Repeated), move |all| all.iter().map(show).collect(), read)
}

/// The last text counts.
fn single<T: 'static, E: Into<String>>(
    (name, value, values): (&'static str, &'static str, Values),
    show: impl Fn(&T) -> String + 'static,
    read: impl Fn(&str) -> Result<T, E> + 'static,
) -> Vec<Parameter<T>> {
    let read = move |value: &mut T, texts: &[&str]| {
        for text in texts {
            *value = read(text).map_err(Into::into)?;
        }
        Ok(())
    };
    let option = TableOption { name, value, about: "", values };
    vec![Parameter { option, show: Box::new(move |value| vec![show(value)]), read: Box::new(read) }]
}

/// All texts count.
fn several<T: 'static, E: Into<String>>(
    (name, value, values): (&'static str, &'static str, Values),
    show: impl Fn(&Vec<T>) -> Vec<String> + 'static,
    read: impl Fn(&str) -> Result<T, E> + 'static,
) -> Vec<Parameter<Vec<T>>> {
    let read = move |all: &mut Vec<T>, texts: &[&str]| {
        *all = texts.iter().map(|text| read(text).map_err(Into::into)).collect::<Result<_, _>>()?;
        Ok(())
    };
    let option = TableOption { name, value, about: "", values };
    vec![Parameter { option, show: Box::new(show), read: Box::new(read) }]
}

/// Parameters of which the option `old` has another name, and is something else.
pub(super) fn renamed<S>(mut all: Vec<Parameter<S>>, old: &str, new: [&'static str; 2]) -> Vec<Parameter<S>> {
    for Parameter { option, .. } in all.iter_mut().filter(|parameter| parameter.option.name == old) {
        [option.name, option.about] = new;
    }
    all
}

/// Reads a whole number of `range`.
pub(super) fn from_to<T: TryFrom<i64>>(range: RangeInclusive<i64>) -> impl Fn(&str) -> Result<T, String> {
    move |text| within(text, &range)
}

/// Reads the name of a layout that can be loaded.
pub(super) fn layout_name(text: &str) -> Result<String, String> {
    layout::load(text, 0, None).map(|_| text.to_owned()).map_err(|fault| fault.to_string())
}

/// How many senders make a node silent: a [`Count`] that is stored.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(try_from = "u8", into = "u8")]
pub struct Senders(pub Count);

impl TryFrom<u8> for Senders {
    type Error = String;

    fn try_from(count: u8) -> Result<Self, Self::Error> {
        Self::read(&count.to_string())
    }
}

impl From<Senders> for u8 {
    fn from(Senders(count): Senders) -> Self {
        count.get()
    }
}

impl fmt::Display for Senders {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.get().fmt(f)
    }
}

impl Senders {
    /// One sender.
    pub const ONE: Self = Self(Count::ONE);

    /// Reads one.
    ///
    /// # Errors
    /// A hint at what to write.
    pub fn read(text: &str) -> Result<Self, String> {
        let count = text.parse().ok().and_then(Count::new);
        count.map(Self).ok_or_else(|| format!("write whole numbers from 1 to {}", Count::MOST))
    }
}
