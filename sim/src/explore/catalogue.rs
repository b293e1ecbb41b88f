//! The catalogue of schemes: a list of rows that a program puts together, and what is looked up in it by a word.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Deref;
use std::sync::{Mutex, PoisonError};

use serde::{Serialize, Serializer};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;
use tautline_proofs::plural::listed;

use super::clause::kept;
use super::{
    By, Catalogue, Clause, ClauseId, Completeness, Look, Profile, Rule, RuleId, Scheme, Senses, Setup, Starts,
};
use crate::kit;
use tautline_grids::layout::Layout;

impl Catalogue {
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
        once(self.schemes().flat_map(|scheme| scheme.rules), |rule| rule.name)
    }

    /// The clause with this id, if runs of a known scheme can break it.
    ///
    /// # Errors
    /// A [`Diagnostic`] that names those they can break.
    pub fn clause(self, id: &str) -> Result<ClauseId, Diagnostic> {
        let known = once(self.schemes().flat_map(|scheme| scheme.clauses), |clause| clause.id);
        let found = known.iter().find(|clause| clause.id.as_str() == id).map(|clause| clause.id);
        found.ok_or_else(|| {
            let remedy = format!("the clauses are {}", listed(known.iter().map(|clause| clause.id)));
            Diagnostic::usage(format_args!("no run can break the clause {id:?}"), remedy)
        })
    }

    /// The names of the schemes that are so.
    pub fn names(self, is: impl Fn(&Profile) -> bool) -> Vec<&'static str> {
        self.schemes().filter(|scheme| is(scheme)).map(|scheme| scheme.name).collect()
    }
}

/// All of these, but of those with the same key only the first.
fn once<T, K: Ord>(all: impl Iterator<Item = T>, key: impl Fn(&T) -> K) -> Vec<T> {
    let mut known = BTreeSet::new();
    all.filter(|one| known.insert(key(one))).collect()
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
            let row: &'static Profile = Box::leak(Box::new(Profile::named(kept(name))));
            named.insert(row.name, row);
            row
        });
        Self { row, among: Catalogue(&[]) }
    }

    /// Whether its catalogue has it.
    pub fn is_known(self) -> bool {
        self.among.scheme(self.name).is_some()
    }

    /// The words for a run without a broken clause. Those of a scheme that is not known are not known either.
    pub fn unbroken(self) -> &'static str {
        if self.is_known() { "no clause is broken" } else { "no clause was checked" }
    }

    /// The rule with this name.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the scheme does not offer it.
    pub fn find_rule(self, rule: RuleId) -> Result<&'static Rule, Diagnostic> {
        self.rule(rule).ok_or_else(|| {
            let what = match rule {
                RuleId::PUBLISHED => format!("{} is ours: nobody has published it", self.name),
                rule => format!("{} has no rule {rule}", self.name),
            };
            Diagnostic::of_field("rule", what, self.which_rule())
        })
    }

    /// Which rules there are, for those who have asked for another one.
    pub fn which_rule(self) -> String {
        let names: Vec<&str> = self.rules.iter().map(|rule| rule.name.as_str()).collect();
        format!("take the rule {}, or another scheme than {}", names.join(" or "), self.name)
    }

    /// `robots` as the number of a team of the scheme.
    ///
    /// # Errors
    /// A [`Diagnostic`] if no team has so many.
    pub fn count(self, robots: u64) -> Result<u16, Diagnostic> {
        let count = u16::try_from(robots).ok().filter(|&count| self.robots.contains(&count.into()));
        count.ok_or_else(|| {
            let (team, robot, has_base) = (self.team, self.look.robot(), self.look.has_base());
            let what = match (robots, has_base) {
                (0, _) => format!("no {robot}s are no {team}"),
                (1, true) => format!("the base alone is no {team}"),
                (robots, true) => format!("{robots} {robot}s are no {team}"),
                (robots, false) => format!("{robots} {robot}s are too many for a {team}"),
            };
            let (least, most) = (self.robots.start(), self.robots.end());
            let base = if has_base { ", the base counted" } else { "" };
            let remedy = format_args!("a {team} has {least} to {most} {robot}s{base}");
            Diagnostic::of_field("robots", what, remedy)
        })
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

impl Profile {
    /// The rule with this name, if the scheme offers it.
    pub fn rule(&self, name: RuleId) -> Option<&'static Rule> {
        self.rules.iter().find(|rule| rule.name == name)
    }

    /// The rule that is taken where nobody says which: the repaired one, or else the first.
    pub fn default_rule(&self) -> RuleId {
        let repaired = self.rule(RuleId::REPAIRED).or(self.rules.first());
        repaired.map_or(RuleId::REPAIRED, |rule| rule.name)
    }

    /// Whether one of its rules is hunted.
    pub fn is_hunted(&self) -> bool {
        self.rules.iter().any(|rule| rule.hunt.is_some())
    }

    /// Whether a run of it draws anything: whether its seed has an effect.
    pub fn draws(&self, setup: &Setup) -> bool {
        self.drawn.iter().any(|drawn| match drawn.by {
            By::Every => true,
            By::Miss => !setup.miss.is_never(),
            By::Told(extra) => extra.is_told_by(&setup.options),
            By::Rule(rule) => rule == setup.rule,
        })
    }

    /// Where `robots` of this rule start in `layout` of which nobody says where, if not all start at the base.
    pub fn default_starts(
        &self,
        rule: RuleId,
        layout: &Layout,
        base: Cell,
        robots: u16,
    ) -> Option<Vec<Cell>> {
        match self.starts {
            Starts::Beside if rule == RuleId::REPAIRED => Some(kit::starts(layout, base, robots.into())),
            Starts::Alone => Some(kit::starts(layout, base, robots.into())),
            Starts::Base | Starts::Anywhere | Starts::Beside => None,
        }
    }

    /// The clause with this id, if its runs can break it.
    pub fn clause(&self, id: ClauseId) -> Option<&'static Clause> {
        self.clauses.iter().find(|clause| clause.id == id)
    }

    /// A row of which nothing is known but its name, which has robots that are apart.
    pub const fn named(name: &'static str) -> Self {
        Self {
            name,
            about: "",
            rules: &[],
            team: "team",
            robots: 1..=u16::MAX as usize,
            starts: Starts::Anywhere,
            senses: Senses::Bumps,
            extras: &[],
            needless: |_, _| None,
            told: Completeness::Part,
            drawn: &[],
            look: Look::Own,
            knowledge: None,
            clauses: &[],
            case: |setup, clause, _| super::team(setup).ok()?.case(&setup.layout, clause),
        }
    }
}

impl PartialEq for Profile {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Profile {}

impl Serialize for Profile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}
