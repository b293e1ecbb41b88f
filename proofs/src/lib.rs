//! What Tautline claims, and how the claims are decided: the clauses of `SPEC.md` with their mutants, the engines
//! that answer every choice, the search over all layouts, and the judge of counterexamples.

pub mod run;
