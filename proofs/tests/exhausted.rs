//! Certificates of checks that search all states.

use std::time::Instant;

use rayon::ThreadPoolBuilder;
use tautline_proofs::decide::Verdict;
use tautline_proofs::engine::states::Limits;
use tautline_proofs::ledger::{certificate, clauses, examine};

/// One row per check that holds and searches all states; `TAUTLINE_CERTIFICATES` names some of the clauses.
#[test]
#[ignore = "takes minutes: cargo test --release -p tautline-proofs --test all -- --ignored --nocapture certificates_of_all"]
fn certificates_of_all_rows_are_accepted_in_less_time_than_the_search_takes() {
    let wanted = std::env::var("TAUTLINE_CERTIFICATES").unwrap_or_default();
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    println!("{:12} {:10} {:>8} {:>8} {:>6} {:>8} {:>8} {:>8} {:>8}", "clause", "rule", "states", "bytes", "each", "search", "written", "by one", "by two");
    for clause in clauses().filter(|clause| wanted.is_empty() || wanted.split(',').any(|id| id == clause.id)) {
        for (number, check) in (0..).zip(clause.checks) {
            if check.engine() != "states" || check.expected() != Verdict::Holds {
                continue;
            }
            let systems = check.systems().expect("systems");
            let begun = Instant::now();
            for system in &systems {
                system.search(Limits::NONE);
            }
            let searched = begun.elapsed().as_secs_f64();
            let begun = Instant::now();
            let file = pool(1).install(|| certificate(clause, number, Limits::NONE)).expect("a certificate");
            let written = begun.elapsed().as_secs_f64();
            let [one, two] = [1, 2].map(|threads| {
                let begun = Instant::now();
                let examined = pool(threads).install(|| examine(&file, clauses())).expect("a certificate");
                let counts = examined.outcome.expect("it is accepted");
                (begun.elapsed().as_secs_f64(), counts)
            });
            assert_eq!(one.1, two.1);
            let states = one.1.states;
            println!("{:12} {:10} {:>8} {:>8} {:>6.2} {:>8.2} {:>8.2} {:>8.2} {:>8.2}", clause.id, check.rule(), states, file.len(), file.len() as f64 / states as f64, searched, written, one.0, two.0);
        }
    }
}
