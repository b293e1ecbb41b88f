//! Which clauses Rocq has proved for every number of robots, layout or network: read from what the audit of `proofs/rocq`
//! prints. `docs/machine-checked.md` says what each theorem assumes.

/// What `proofs/rocq/Audit.v` prints: each theorem with its statement, and whether it rests on assumptions.
const AUDIT: &str = include_str!("../../rocq/audit.expected");

/// The line below the statement of a theorem that rests on nothing but definitions.
const CLOSED: &str = "Closed under the global context";

/// A theorem about a clause.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Theorem {
    /// The id of the clause.
    pub clause: String,
    /// What part of the clause it proves, in words; `None` if it is the clause.
    pub part: Option<String>,
}

impl Theorem {
    /// The theorem of this name: the id of a clause, with `_` for `-`, and the part behind it. Other names are no theorems
    /// about a clause.
    fn named(name: &str) -> Option<Self> {
        let name = name.rsplit('.').next()?;
        let mut parts = name.splitn(3, '_');
        let (scheme, number) = (parts.next()?, parts.next()?);
        let is_id = scheme.bytes().all(|letter| letter.is_ascii_uppercase())
            && number.bytes().all(|digit| digit.is_ascii_digit());
        let part = parts.next().map(|part| part.replace('_', " "));
        (is_id && !scheme.is_empty() && !number.is_empty())
            .then(|| Self { clause: format!("{scheme}-{number}"), part })
    }
}

/// The theorems of the audit that are about a clause and rest on no assumption, in its order.
pub fn theorems() -> Vec<Theorem> {
    closed(AUDIT).filter_map(Theorem::named).collect()
}

/// The names in what an audit prints that stand above a line which says that the theorem is closed.
fn closed(audit: &str) -> impl Iterator<Item = &str> {
    // Statements are indented.
    let heads = || audit.lines().filter(|line| !line.is_empty() && !line.starts_with(' '));
    heads().zip(heads().skip(1)).filter(|&(_, below)| below == CLOSED).map(|(name, _)| name)
}

/// What the ledger says of a clause that holds: whether it, or a part of it, is machine-checked beyond the bound.
pub(super) fn words(clause: &str) -> Option<String> {
    let mut parts = Vec::new();
    for theorem in theorems().into_iter().filter(|theorem| theorem.clause == clause) {
        match theorem.part {
            None => return Some("composition: machine-checked".to_owned()),
            Some(part) => parts.push(part),
        }
    }
    (!parts.is_empty()).then(|| format!("composition: machine-checked in part ({})", parts.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::clauses;

    #[test]
    fn every_theorem_about_a_clause_is_about_one_of_ours() {
        let theorems = theorems();
        assert!(theorems.len() >= 18, "{theorems:?}");
        for theorem in theorems {
            let id = &theorem.clause;
            assert!(clauses().any(|clause| clause.id == id), "no clause {id} is registered: {theorem:?}");
        }
    }

    #[test]
    fn a_theorem_that_rests_on_an_axiom_counts_for_nothing() {
        let audit = "CHAIN_1\n     : forall N : nat,\n       2 <= N\nClosed under the global context\n\
                     Kit.KIT_1\n     : True\nAxioms:\nclassic : forall P : Prop, P \\/ ~ P\n\
                     CHAIN_13_step\n     : True\nClosed under the global context\n";
        assert!(closed(audit).eq(["CHAIN_1", "CHAIN_13_step"]));
    }

    #[test]
    fn the_name_of_a_theorem_says_the_clause_and_the_part() {
        let named = |name| Theorem::named(name).map(|theorem| (theorem.clause, theorem.part));
        assert_eq!(named("Leases.MRC_1"), Some(("MRC-1".to_owned(), None)));
        assert_eq!(named("CHAIN_13_step"), Some(("CHAIN-13".to_owned(), Some("step".to_owned()))));
        for other in ["published_breaks_CHAIN_1", "hold_keeps_coverage", "CHAIN_x", "_1", "CHAIN_"] {
            assert_eq!(named(other), None, "{other}");
        }
    }

    #[test]
    fn a_clause_of_which_a_part_is_proved_is_said_to_be_so() {
        assert_eq!(words("CHAIN-1").as_deref(), Some("composition: machine-checked"));
        assert_eq!(words("BRICKS-2").as_deref(), Some("composition: machine-checked in part (marking)"));
        assert_eq!(words("CHAIN-14"), None);
    }
}
