//! Bodies under Kani: every answer at once. Compiled by `cargo kani` alone.

use tautline_kernel::choice::Oracle;

use super::{Outcome, Stop};

/// Every answer at once.
struct Symbolic;

impl Oracle for Symbolic {
    fn pick(&mut self, below: u32) -> u32 {
        kani::any_where(|&answer: &u32| answer < below)
    }
}

/// Fails if some choices break the body, and wants a case that meets its assumptions.
pub fn prove<R>(body: fn(&R, &mut dyn Oracle) -> Outcome, rule: &R) {
    match body(rule, &mut Symbolic) {
        Err(Stop::Violated(_)) => panic!("the clause is broken"),
        Err(Stop::Assumed | Stop::GivenUp) => {}
        Ok(_) => kani::cover!(true, "a case of the clause"),
    }
}
