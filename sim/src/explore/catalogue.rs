//! The catalogue of schemes: a list of their rows that a program puts together, and what is looked up in it by a word.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Deref;
use std::sync::{Mutex, PoisonError};

use serde::{Serialize, Serializer};

use super::ants::ANTS;
use super::bricks::{BRICKS, BRICKS_ANTS};
use super::chain::CHAIN;
use super::clause::ClauseId;
use super::depth_first::{HELPERS, MDFS};
use super::frontier::FRONTIER;
use super::kit::KIT;
use super::pack::PACK;
use super::rule::RuleId;
use super::setup::{Profile, Rule, Senses};

/// The schemes of this library. A program may have others, too.
pub const SCHEMES: &[&Profile] =
    &[&CHAIN, &ANTS, &BRICKS, &BRICKS_ANTS, &MDFS, &HELPERS, &KIT, &FRONTIER, &PACK];

/// The schemes that a program knows, in lists behind each other.
#[derive(Clone, Copy, Debug)]
pub struct Catalogue(pub &'static [&'static [&'static Profile]]);

impl Catalogue {
    /// The schemes of this library and no others.
    pub const OWN: Self = Self(&[SCHEMES]);

    /// All schemes.
    pub fn schemes(self) -> impl Iterator<Item = Scheme> {
        self.0.iter().copied().flatten().map(move |row| Scheme { row, among: self })
    }

    /// The scheme with this name.
    pub fn scheme(self, name: &str) -> Option<Scheme> {
        self.schemes().find(|scheme| scheme.name == name)
    }

    /// The rules of all schemes, each name once.
    pub fn rules(self) -> Vec<&'static Rule> {
        let mut rules: Vec<&Rule> = Vec::new();
        for rule in self.schemes().flat_map(|scheme| scheme.rules) {
            if rules.iter().all(|known| known.name != rule.name) {
                rules.push(rule);
            }
        }
        rules
    }

    /// The rule with this name, if a scheme has one.
    ///
    /// # Errors
    /// What is wrong if none has.
    pub(crate) fn rule(self, name: &str) -> Result<RuleId, String> {
        let names: Vec<RuleId> = self.rules().into_iter().map(|rule| rule.name).collect();
        let found = names.iter().copied().find(|rule| rule.as_str() == name);
        found.ok_or_else(|| unknown(name, names.iter().map(|rule| rule.as_str())))
    }

    /// The scheme with this name.
    ///
    /// # Errors
    /// What is wrong if there is none.
    pub(crate) fn find_scheme(self, name: &str) -> Result<Scheme, String> {
        self.scheme(name).ok_or_else(|| unknown(name, self.names(|_| true).into_iter()))
    }

    /// The clause with this id, if runs of a known scheme can break it.
    ///
    /// # Errors
    /// [`NoClause`] if they cannot.
    pub fn clause(self, id: &str) -> Result<ClauseId, NoClause> {
        let found = self.clauses().into_iter().find(|clause| clause.as_str() == id);
        found.ok_or_else(|| NoClause { id: id.to_owned(), among: self })
    }

    /// The clauses that runs of the known schemes can break, each once.
    fn clauses(self) -> Vec<ClauseId> {
        let mut ids = Vec::new();
        for clause in self.schemes().flat_map(|scheme| scheme.clauses) {
            if !ids.contains(&clause.id) {
                ids.push(clause.id);
            }
        }
        ids
    }

    /// The names of the schemes that are so.
    pub fn names(self, is: impl Fn(&Profile) -> bool) -> Vec<&'static str> {
        self.schemes().filter(|scheme| is(scheme)).map(|scheme| scheme.name).collect()
    }
}

/// What is wrong with a name that is none of these.
fn unknown<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = known.map(|known| format!("`{known}`")).collect();
    format!("unknown variant `{name}`, expected one of {}", quoted.join(", "))
}

/// A scheme, and the catalogue that it is chosen from.
#[derive(Clone, Copy)]
pub struct Scheme {
    row: &'static Profile,
    /// That catalogue.
    pub among: Catalogue,
}

/// The rows of schemes that are in no catalogue, by their names: files name few, and they are kept as long as the
/// process.
static NAMED: Mutex<BTreeMap<&str, &Profile>> = Mutex::new(BTreeMap::new());

impl Scheme {
    /// A scheme of which nothing is known but its name.
    pub(crate) fn named(name: &str) -> Self {
        let mut named = NAMED.lock().unwrap_or_else(PoisonError::into_inner);
        let known = named.get(name).copied();
        let row = known.unwrap_or_else(|| {
            let row: &'static Profile = Box::leak(Box::new(Profile::named(Box::leak(name.into()))));
            named.insert(row.name, row);
            row
        });
        Self { row, among: Catalogue(&[]) }
    }

    /// Whether its catalogue has it.
    pub fn is_known(self) -> bool {
        self.among.scheme(self.name).is_some()
    }

    /// The names of the schemes whose robots learn of the layout so.
    pub(crate) fn sensing(self, senses: Senses) -> String {
        let names = self.among.names(|scheme| scheme.senses == senses);
        match names.split_last() {
            Some((name, before @ [_, ..])) => format!("{} or {name}", before.join(", ")),
            _ => names.concat(),
        }
    }
}

impl From<&'static Profile> for Scheme {
    fn from(row: &'static Profile) -> Self {
        Self { row, among: Catalogue::OWN }
    }
}

impl Deref for Scheme {
    type Target = Profile;

    fn deref(&self) -> &Profile {
        self.row
    }
}

impl PartialEq for Scheme {
    fn eq(&self, other: &Self) -> bool {
        self.row == other.row
    }
}

impl Eq for Scheme {}

impl fmt::Debug for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.row.fmt(f)
    }
}

impl Serialize for Scheme {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.row.serialize(serializer)
    }
}

/// An id that is of no clause about runs.
#[derive(Clone, Debug)]
pub struct NoClause {
    id: String,
    among: Catalogue,
}

impl NoClause {
    /// What would be right.
    pub fn remedy(&self) -> String {
        let ids: Vec<&str> = self.among.clauses().into_iter().map(ClauseId::as_str).collect();
        format!("the clauses are {}", ids.join(", "))
    }
}

impl fmt::Display for NoClause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no run can break the clause {:?}", self.id)
    }
}

impl std::error::Error for NoClause {}
