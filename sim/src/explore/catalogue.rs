//! The catalogue of schemes: the one list of their rows, and what is looked up in it by a word.

use std::fmt;

use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer};

use super::ants::ANTS;
use super::bricks::{BRICKS, BRICKS_ANTS};
use super::chain::CHAIN;
use super::clause::ClauseId;
use super::depth_first::{HELPERS, MDFS};
use super::frontier::FRONTIER;
use super::kit::KIT;
use super::pack::PACK;
use super::rivals::{FULL_SEARCH, ROOKER_BIRK};
use super::rule::RuleId;
use super::setup::{Profile, Rule, Senses};

/// Every scheme that this program knows.
pub const SCHEMES: &[&Profile] = &[
    &CHAIN,
    &FULL_SEARCH,
    &ROOKER_BIRK,
    &ANTS,
    &BRICKS,
    &BRICKS_ANTS,
    &MDFS,
    &HELPERS,
    &KIT,
    &FRONTIER,
    &PACK,
];

/// The scheme with this name.
pub fn scheme(name: &str) -> Option<&'static Profile> {
    SCHEMES.iter().copied().find(|scheme| scheme.name == name)
}

/// The rules of all schemes, each name once.
pub fn rules() -> Vec<&'static Rule> {
    let mut rules: Vec<&Rule> = Vec::new();
    for rule in SCHEMES.iter().flat_map(|scheme| scheme.rules) {
        if rules.iter().all(|known| known.name != rule.name) {
            rules.push(rule);
        }
    }
    rules
}

/// The names of the schemes whose robots learn of the layout so, with `last` before the last one.
pub(crate) fn sensing(senses: Senses, last: &str) -> String {
    let fitting = SCHEMES.iter().filter(|scheme| scheme.senses == senses);
    let names: Vec<&str> = fitting.map(|scheme| scheme.name).collect();
    match names.split_last() {
        Some((name, before @ [_, ..])) => format!("{} {last} {name}", before.join(", ")),
        _ => names.concat(),
    }
}

/// The clause with this id, if runs of a known scheme can break it.
///
/// # Errors
/// [`NoClause`] if they cannot.
pub fn clause(id: &str) -> Result<ClauseId, NoClause> {
    clauses().into_iter().find(|clause| clause.as_str() == id).ok_or_else(|| NoClause(id.to_owned()))
}

/// The clauses that runs of the known schemes can break, each once.
fn clauses() -> Vec<ClauseId> {
    let mut ids = Vec::new();
    for clause in SCHEMES.iter().flat_map(|scheme| scheme.clauses) {
        if !ids.contains(&clause.id) {
            ids.push(clause.id);
        }
    }
    ids
}

/// An id that is of no clause about runs.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NoClause(String);

impl NoClause {
    /// What would be right.
    pub fn remedy(&self) -> String {
        let ids: Vec<&str> = clauses().into_iter().map(ClauseId::as_str).collect();
        format!("the clauses are {}", ids.join(", "))
    }
}

impl fmt::Display for NoClause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no run can break the clause {:?}", self.0)
    }
}

impl std::error::Error for NoClause {}

impl<'de> Deserialize<'de> for ClauseId {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        clause(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

impl<'de> Deserialize<'de> for &'static Profile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(Word(SCHEMES.iter().map(|&scheme| (scheme.name, scheme)).collect()))
    }
}

impl<'de> Deserialize<'de> for RuleId {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer
            .deserialize_str(Word(rules().into_iter().map(|rule| (rule.name.as_str(), rule.name)).collect()))
    }
}

/// Reads one of these words as what it stands for.
struct Word<T>(Vec<(&'static str, T)>);

impl<T> Visitor<'_> for Word<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let quoted: Vec<String> = self.0.iter().map(|(word, _)| format!("`{word}`")).collect();
        match quoted.as_slice() {
            [one, other] => write!(f, "{one} or {other}"),
            [one] => f.write_str(one),
            many => write!(f, "one of {}", many.join(", ")),
        }
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<T, E> {
        let expected = (&self as &dyn de::Expected).to_string();
        let mut values = self.0.into_iter();
        let found = values.find(|(known, _)| *known == word);
        found
            .map(|(_, value)| value)
            .ok_or_else(|| E::custom(format_args!("unknown variant `{word}`, expected {expected}")))
    }
}
