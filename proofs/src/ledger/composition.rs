//! Which clauses Rocq has proved for every number of robots, layout or network, and of which rules: read from what the
//! audit of `proofs/rocq` prints, and from the list of rules beside it. `docs/machine-checked.md` says what each
//! theorem assumes.

use crate::local::EveryNumber;

/// The audit of `proofs/rocq` as printed: each theorem with its statement, and
/// whether any of them rests on assumptions.
const AUDIT: &str = include_str!("../../rocq/audit.expected");

/// The rules that each theorem speaks of: it says nothing of the others that a clause is about.
const RULES: &str = include_str!("../../rocq/rules.txt");

/// The line below the statements if all theorems rest on nothing but definitions.
const CLOSED: &str = "Closed under the global context\n";

/// A theorem about a clause.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Theorem {
    /// The id of the clause.
    pub clause: String,
    /// The part of the clause that it proves, in words; `None` if it is the clause.
    pub part: Option<String>,
    /// The rules that it speaks of, by their names in the ledger.
    pub rules: Vec<&'static str>,
    /// The number of robots that it is about; `None` if it is about any.
    pub robots: Option<&'static str>,
    /// Whether it is the certificate of a check by the engine of local rules: it counts for such checks alone.
    pub is_certificate: bool,
}

/// The module of the theorems that are certificates.
const CERTIFIED: &str = "Certified.";

/// How the bound of a check begins that is about every number of robots.
const EVERY_N: &str = EveryNumber::DEFAULT.teams;

/// The engine whose checks have certificates.
const LOCAL: &str = "local";

impl Theorem {
    /// The theorem of this name, of which the list of `rules` has a line: the id of a clause, with `_` for `-`, and the
    /// part behind it, unless the line names the part. Other names are no theorems about a clause.
    fn named(name: &str, rules: &'static str) -> Option<Self> {
        let (clause, part) = split(name)?;
        let line = rules.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(' '))?;
        let (rules, less) = line.split_once(": ").map_or((line, None), |(rules, less)| (rules, Some(less)));
        let part = less.map(str::to_owned).or(part);
        let (robots, rules): (Vec<_>, Vec<_>) =
            rules.split(' ').partition(|word| word.bytes().all(|letter| letter.is_ascii_digit()));
        let is_certificate = name.starts_with(CERTIFIED);
        Some(Self { clause, part, rules, robots: robots.first().copied(), is_certificate })
    }

    /// Whether it is about this clause, for this rule, within a check of this bound.
    fn is_about(&self, clause: &str, rule: &str, bound: &str) -> bool {
        let has_so_many = |robots| {
            let words = format!("{robots} robots");
            let ends_a_number = |(at, _)| bound[..at].ends_with(|last: char| last.is_ascii_digit());
            !bound.match_indices(&words).all(ends_a_number)
        };
        self.clause == clause && self.rules.contains(&rule) && self.robots.is_none_or(has_so_many)
    }
}

/// The id of the clause that a theorem of this name is about, and what part of it.
fn split(name: &str) -> Option<(String, Option<String>)> {
    let name = name.rsplit('.').next()?;
    let mut parts = name.splitn(3, '_');
    let (scheme, number) = (parts.next()?, parts.next()?);
    let is_id = scheme.bytes().all(|letter| letter.is_ascii_uppercase())
        && number.bytes().all(|digit| digit.is_ascii_digit());
    let part = parts.next().map(|part| part.replace('_', " "));
    (is_id && !scheme.is_empty() && !number.is_empty()).then(|| (format!("{scheme}-{number}"), part))
}

/// The theorems of the audit that are about a clause and rest on no assumption, in its order.
pub fn theorems() -> Vec<Theorem> {
    closed(AUDIT).filter_map(|name| Theorem::named(name, RULES)).collect()
}

/// The names of the theorems of an audit; none if one of them rests on an assumption.
fn closed(audit: &str) -> impl Iterator<Item = &str> {
    let statements = audit.strip_suffix(CLOSED).unwrap_or_default();
    // They are indented.
    statements.lines().filter(|line| !line.starts_with(' '))
}

/// The ledger's words on a clause that holds for `rule` by `engine` within `bound`: whether it, or a part of it, is
/// machine-checked, by a certificate or beyond the bound.
pub(super) fn words(clause: &str, rule: &str, engine: &str, bound: &str) -> Option<String> {
    let (certificates, others): (Vec<Theorem>, Vec<Theorem>) = theorems()
        .into_iter()
        .filter(|theorem| theorem.is_about(clause, rule, bound))
        .partition(|theorem| theorem.is_certificate);
    let (what, found) = match engine {
        LOCAL if !certificates.is_empty() => {
            (if bound.starts_with(EVERY_N) { EVERY_N } else { "every layout" }, certificates)
        }
        _ => ("composition", others),
    };
    if found.iter().any(|theorem| theorem.part.is_none()) {
        return Some(format!("{what}: machine-checked"));
    }
    let parts: Vec<String> = found.into_iter().filter_map(|theorem| theorem.part).collect();
    (!parts.is_empty()).then(|| format!("{what}: machine-checked in part ({})", parts.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_theorem_about_a_clause_has_a_line_with_its_rules() {
        let about_clauses = closed(AUDIT).filter(|name| split(name).is_some()).count();
        let lines = RULES.lines().filter(|line| !line.starts_with('#')).count();
        let theorems = theorems();
        assert_eq!((about_clauses, lines), (theorems.len(), theorems.len()), "{theorems:?}");
        assert!(theorems.len() >= 18, "{theorems:?}");
    }

    #[test]
    fn where_a_theorem_rests_on_an_axiom_none_counts() {
        let statements = "CHAIN_1\n     : forall N : nat,\n       2 <= N\nKit.KIT_1\n     : True\n";
        assert!(closed(&format!("{statements}{CLOSED}")).eq(["CHAIN_1", "Kit.KIT_1"]));
        let axioms = "Axioms:\nclassic : forall P : Prop, P \\/ ~ P\n";
        assert_eq!(closed(&format!("{statements}{axioms}")).count(), 0);
    }

    #[test]
    fn the_name_of_a_theorem_says_the_clause_and_the_part() {
        assert_eq!(split("Leases.MRC_1"), Some(("MRC-1".to_owned(), None)));
        assert_eq!(split("CHAIN_13_step"), Some(("CHAIN-13".to_owned(), Some("step".to_owned()))));
        for other in ["published_breaks_CHAIN_1", "hold_keeps_coverage", "CHAIN_x", "_1", "CHAIN_"] {
            assert_eq!(split(other), None, "{other}");
        }
    }

    #[test]
    fn a_theorem_counts_for_the_rules_of_its_line_alone_and_for_none_without_a_line() {
        let rules = "CHAIN_1 repaired reel\nCHAIN_6 repaired 2: admitted plans\n";
        let named =
            |name| Theorem::named(name, rules).map(|theorem| (theorem.rules, theorem.robots, theorem.part));
        assert_eq!(named("CHAIN_1"), Some((vec!["repaired", "reel"], None, None)));
        assert_eq!(named("CHAIN_6"), Some((vec!["repaired"], Some("2"), Some("admitted plans".to_owned()))));
        assert_eq!((named("CHAIN_10"), named("Hold.CHAIN_1")), (None, None));
    }

    #[test]
    fn a_theorem_about_two_robots_counts_for_two_alone() {
        let words = |bound| words("KIT-7", "repaired", "states", bound);
        let part = "composition: machine-checked in part (drives of two robots)";
        assert_eq!(words("all layouts, 2 robots, any speeds").as_deref(), Some(part));
        assert_eq!(words("all layouts, 3 robots, any speeds"), None);
        assert_eq!(words("all layouts, 12 robots, any speeds"), None);
    }

    #[test]
    fn a_certificate_counts_for_the_engine_of_local_rules_alone() {
        let of_any = "every N, every layout; the relation";
        assert_eq!(words("KIT-3", "repaired", LOCAL, of_any).as_deref(), Some("every N: machine-checked"));
        assert_eq!(words("KIT-2", "repaired", "states", ""), None);
        let contact = words("CHAIN-22", "reel", LOCAL, of_any);
        assert_eq!(contact.as_deref(), Some("every N: machine-checked in part (contact)"));
        assert_eq!(words("CHAIN-2", "reel", LOCAL, "").as_deref(), Some("composition: machine-checked"));
    }

    #[test]
    fn a_certificate_about_two_robots_says_nothing_of_every_number() {
        let of_two = "two robots, every layout; the relation";
        let words = words("KIT-2", "repaired", LOCAL, of_two);
        assert_eq!(words.as_deref(), Some("every layout: machine-checked"));
    }

    #[test]
    fn a_clause_of_which_a_part_is_proved_is_said_to_be_so_for_the_rules_that_the_theorem_speaks_of() {
        assert_eq!(words("CHAIN-1", "reel", "search", "").as_deref(), Some("composition: machine-checked"));
        assert_eq!(
            words("BRICKS-2", "repaired", "search", "").as_deref(),
            Some("composition: machine-checked in part (marking)")
        );
        for (clause, rule) in
            [("CHAIN-14", "repaired"), ("CHAIN-24", "reel"), ("BRICKS-6", "doubting"), ("BRICKS-2", "robust")]
        {
            assert_eq!(words(clause, rule, "search", ""), None, "{clause} {rule}");
        }
    }
}
