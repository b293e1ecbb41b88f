//! The rules that are asked for by their names, and their promises.

use tautline_io::diagnostic::Diagnostic;
use tautline_library::{Entry, RULES};
use tautline_proofs::clause::Clause;

/// The word for every rule.
const ALL: &str = "all";

/// The rules of these names.
pub(super) fn chosen(names: &[String]) -> Result<Vec<&'static Entry>, Diagnostic> {
    if names == [ALL] {
        return Ok(RULES.to_vec());
    }
    let find = |name: &String| {
        RULES.iter().copied().find(|rule| rule.name.eq_ignore_ascii_case(name)).ok_or_else(|| {
            let known: Vec<&str> = RULES.iter().map(|rule| rule.name).collect();
            let remedy = format!("the rules are {}; or give {ALL} alone", known.join(", "));
            Diagnostic::usage(format_args!("there is no rule {name:?}"), remedy)
        })
    };
    names.iter().map(find).collect()
}

/// The promises of these rules.
pub(super) fn clauses(rules: &[&'static Entry], larger: bool) -> Vec<&'static Clause> {
    if larger {
        rules.iter().flat_map(|rule| rule.larger()).collect()
    } else {
        rules.iter().flat_map(|rule| rule.clauses()).collect()
    }
}
