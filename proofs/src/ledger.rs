//! The ledger: the clauses of all rooms, in the order of `SPEC.md`.

use std::fmt;

use crate::clause::Clause;
use crate::{ants, bricks, chain, ground, mrc, notice, tan};

/// The clauses of each room.
pub static ROOMS: [&[Clause]; 7] = [
    &ground::clauses::CLAUSES,
    &chain::clauses::CLAUSES,
    &ants::clauses::CLAUSES,
    &bricks::clauses::CLAUSES,
    &notice::clauses::CLAUSES,
    &mrc::clauses::CLAUSES,
    &tan::clauses::CLAUSES,
];

/// Every clause of our own.
pub fn clauses() -> impl Iterator<Item = &'static Clause> {
    ROOMS.into_iter().flatten()
}

/// Two clauses of one id.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Twice(pub &'static str);

impl fmt::Display for Twice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there are two clauses {}: give each an id of its own", self.0)
    }
}

impl std::error::Error for Twice {}

/// The clauses of `rooms`, of which no two have one id.
///
/// # Errors
/// [`Twice`] if two have.
pub fn register(rooms: &[&'static [Clause]]) -> Result<Vec<&'static Clause>, Twice> {
    let clauses: Vec<&Clause> = rooms.iter().copied().flatten().collect();
    for (place, clause) in clauses.iter().enumerate() {
        if clauses[..place].iter().any(|before| before.id == clause.id) {
            return Err(Twice(clause.id));
        }
    }
    Ok(clauses)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::Verdict;

    #[test]
    fn every_id_is_there_once_and_every_clause_has_a_mutant() {
        for clause in register(&ROOMS).expect("ids of their own") {
            let has_mutant = clause.checks.iter().any(|check| !check.mutants().is_empty());
            assert!(has_mutant, "{} has no mutant", clause.id);
            assert!(clause.sentence.contains("MUST"), "{}", clause.id);
        }
    }

    #[test]
    fn two_clauses_of_one_id_are_refused() {
        assert_eq!(register(&[&tan::clauses::CLAUSES, &tan::clauses::CLAUSES]).err(), Some(Twice("TAN-1")));
    }

    #[test]
    fn the_checks_of_a_clause_name_their_rules() {
        let labels = |id: &str| -> Vec<&str> {
            let clause = clauses().find(|clause| clause.id == id).expect("a clause");
            clause.checks.iter().map(|check| check.rule()).collect()
        };
        assert_eq!(labels("BRICKS-4"), ["published", "repaired", "published", "robust"]);
        assert_eq!(labels("BRICKS-6"), ["published", "repaired", "robust", "published", "robust"]);
    }

    #[test]
    fn what_is_sampled_is_never_said_to_hold() {
        for clause in clauses() {
            for check in clause.checks {
                let is_sampled = check.engine() == "sampled";
                let expected = if is_sampled { Verdict::Unrefuted } else { Verdict::Holds };
                assert_eq!(check.shows(), expected, "{}", clause.id);
                let registered = [expected, Verdict::Refuted, Verdict::Open];
                assert!(registered.contains(&check.expected()), "{}: {check:?}", clause.id);
            }
        }
    }

    #[test]
    fn a_bound_names_every_series_that_runs() {
        let clause = clauses().find(|clause| clause.id == "BRICKS-6").expect("a clause");
        assert_eq!(
            clause.checks[1].bound(),
            "1 agent to 4×4; 1 to 3×3 with walls; 2 to 3×2 with walls; 3 to 3×2; 2 to 3×3; 1 to 4×3, patience 2; \
             2 to 4×2, patience 2, at most 2 acts in a row; reach 4"
        );
    }
}
