//! Random runs of the rules.

use tautline_library::RULES;
use tautline_proofs::clause::AnyCheck;
use tautline_proofs::decide::{RandomRuns, Verdict};
use tautline_proofs::engine::states::{Limits, MemoryLimit};

const RUNS: RandomRuns = RandomRuns { runs: 200, seed: 7, most_moves: 100 };

fn checks() -> impl Iterator<Item = (&'static str, &'static dyn AnyCheck)> {
    let clauses = RULES.iter().flat_map(|rule| rule.clauses());
    clauses.flat_map(|clause| clause.checks.iter().map(|&check| (clause.id, check)))
}

#[test]
fn random_runs_break_only_promises_that_are_refuted_and_are_made_as_short_as_from_their_start() {
    let (mut found, mut refuted, mut shortest_ones) = (Vec::new(), 0, 0);
    for (id, check) in checks() {
        let answer = check.hunt(&RUNS).expect("it can begin").expect("it makes random runs");
        refuted += usize::from(check.expected() == Verdict::Refuted);
        let Some(evidence) = answer.counterexample else {
            assert_eq!((answer.verdict, answer.cases), (Verdict::Unrefuted, RUNS.runs), "{id} {check:?}");
            continue;
        };
        assert_eq!(
            (answer.verdict, check.expected()),
            (Verdict::Refuted, Verdict::Refuted),
            "{id} {check:?}"
        );
        assert_eq!(check.replay(&evidence.choices).expect("a refutation").evidence, evidence);
        let memory = MemoryLimit::unbounded();
        let shortened = |most_steps| {
            let limits = Limits { memory: memory.memory(), ..Limits::steps(most_steps) };
            check.shorten(&evidence.choices, limits).expect("a run").expect("it can be shortened")
        };
        let (shortest, is_shortest) = shortened(u64::MAX);
        let (cut, is_cut_shortest) = shortened(1);
        assert!(!is_cut_shortest || cut == shortest, "{id} {check:?}");
        shortest_ones += usize::from(is_shortest);
        for shorter in [&shortest, &cut] {
            check.replay(shorter).expect("a refutation");
            assert!(shorter.once[0] == evidence.choices.once[0], "it begins elsewhere");
            assert!(shorter.once.len() <= evidence.choices.once.len(), "{id} {check:?}");
        }
        found.push((id, evidence.choices.once.len(), cut.once.len(), shortest.once.len()));
    }
    eprintln!("{} of {refuted}: {found:?}", found.len());
    assert!(found.len() * 3 > refuted * 2, "{} of {refuted}: {found:?}", found.len());
    assert_eq!(shortest_ones, found.len());
    assert!(found.iter().any(|(_, long, cut, short)| long > cut && cut > short));
}

/// A run is given by its seed and its number.
#[test]
fn any_number_of_threads_makes_the_same_runs() {
    let by = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let made = || {
            checks().take(12).map(|(_, check)| check.hunt(&RUNS).expect("it can begin")).collect::<Vec<_>>()
        };
        pool.install(made)
    };
    let one = by(1);
    assert_eq!(one, by(3));
    let other = RandomRuns { seed: 8, ..RUNS };
    let others: Vec<_> =
        checks().take(12).map(|(_, check)| check.hunt(&other).expect("it can begin")).collect();
    assert_ne!(one, others);
}
