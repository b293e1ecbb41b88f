//! The findings of the registered checks that are refuted: decided once, for all tests that look at them.

use std::sync::LazyLock;

use rayon::prelude::*;
use tautline_proofs::clause::{AnyCheck, Clause};
use tautline_proofs::decide::{Cache, Context, Evidence, Method, MethodResult, Verdict};
use tautline_proofs::engine::Until;
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::ledger::{Room, rooms};

/// The answer of `method` about `rule`, with nothing found before.
pub(crate) fn decide<R>(method: &impl Method<R>, rule: &R, until: Until) -> MethodResult {
    let (cache, watch) = (&mut Cache::default(), &mut unwatched);
    method.decide(rule, until, &mut Context { cache, watch, memory: MemoryLimit::any() })
}

/// A check that is refuted.
pub(crate) struct Refutation {
    pub(crate) clause: &'static Clause,
    pub(crate) check: &'static dyn AnyCheck,
    pub(crate) found: Evidence,
}

static REFUTED: LazyLock<Vec<Refutation>> = LazyLock::new(|| rooms().par_iter().flat_map(in_room).collect());

/// Checks of a room are decided one after the other: what one has found, the next one need not search again.
fn in_room(room: &Room) -> Vec<Refutation> {
    let cache = &mut Cache::default();
    let mut context = Context { cache, watch: &mut unwatched, memory: MemoryLimit::any() };
    let checks =
        room.clauses.iter().flat_map(|clause| clause.checks.iter().map(move |&check| (clause, check)));
    let refuted = checks.filter(|(_, check)| check.expected() == Verdict::Refuted);
    let decide = |(clause, check): (&'static Clause, &'static dyn AnyCheck)| {
        let answer = check.decide_rule(None, Until::Exhausted, &mut context).expect("registered checks fit");
        Refutation {
            clause,
            check,
            found: answer.counterexample.expect("what is refuted has a counterexample"),
        }
    };
    refuted.map(decide).collect()
}

/// The refuted checks of these clauses, in the order of the ledger.
pub(crate) fn of(is_wanted: impl Fn(&str) -> bool) -> impl Iterator<Item = &'static Refutation> {
    REFUTED.iter().filter(move |refuted| is_wanted(refuted.clause.id))
}
