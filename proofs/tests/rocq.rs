//! The tie between the kernel and the proofs of `proofs/rocq`: what the kernel answers is written down as Rocq terms,
//! and Rocq compares it with the definitions that the theorems speak of. Here the committed files are compared byte by
//! byte with fresh ones. So neither the kernel nor the definitions can move alone.

mod ants;
mod chain;
mod epochs;
mod fixes;
mod frontier;
mod ground;
mod joint;
mod kit;
mod machines;
mod mrc;
mod notice;
mod pack;
mod plans;
mod reel;
mod runs;
mod tan;
mod term;
mod trees;
mod turns;

use std::env;
use std::fs;
use std::path::Path;

use tautline_proofs::ledger;

/// The command that writes the files anew.
const RENEW: &str = "ROCQ_UPDATE=always cargo test -p tautline-proofs --test all rocq";

/// The committed file says what the kernel says now.
fn is_up_to_date(name: &str, terms: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("rocq/generated").join(name);
    let fresh = format!(
        "(** What the kernel answers, written by `{RENEW}`. Do not edit. *)\n{}\n{terms}",
        term::HEAD
    );
    if env::var_os("ROCQ_UPDATE").is_some_and(|value| value == "always") {
        fs::write(&path, fresh).expect("a file that can be written");
        return;
    }
    // A checkout may have changed the ends of lines.
    let committed = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        committed == fresh,
        "the kernel answers otherwise than {} says. If that is meant, write the file anew with\n    {RENEW}\nand let \
         Rocq compare it with the proofs: make -C proofs/rocq",
        path.display()
    );
}

/// A test for each committed file: its name, and where its terms are written.
macro_rules! ties {
    ($($test:ident: $file:literal, $terms:path;)+) => {$(
        #[test]
        fn $test() {
            is_up_to_date($file, &$terms());
        }
    )+};
}

ties! {
    the_chain_answers_as_the_proofs_have_it: "ChainAnswers.v", chain::terms;
    chains_run_as_the_proofs_have_it: "Runs.v", runs::terms;
    plans_are_accepted_as_the_proofs_have_it: "PlanAnswers.v", plans::terms;
    reels_run_as_the_proofs_have_it: "ReelRuns.v", reel::terms;
    epochs_end_as_the_proofs_have_it: "EpochRuns.v", epochs::terms;
    nodes_answer_as_the_proofs_have_it: "NoticeAnswers.v", notice::terms;
    robots_and_wfrs_answer_as_the_proofs_have_it: "MrcAnswers.v", mrc::terms;
    machines_of_a_rescue_answer_as_the_proofs_have_it: "MachineAnswers.v", machines::terms;
    robots_on_their_way_answer_as_the_proofs_have_it: "HomingAnswers.v", tan::terms;
    robots_walk_as_the_proofs_have_it: "PatienceRuns.v", tan::walks;
    robots_keep_in_touch_as_the_proofs_have_it: "KitAnswers.v", kit::terms;
    robots_drive_paths_again_as_the_proofs_have_it: "JointRuns.v", joint::terms;
    robots_explore_cells_as_the_proofs_have_it: "FrontierRuns.v", frontier::terms;
    a_repaired_run_without_an_end_is_as_the_proofs_have_it: "FrontierEndless.v", frontier::without_end;
    fixes_are_taken_as_the_proofs_have_it: "FixAnswers.v", fixes::terms;
    ants_go_as_the_proofs_have_it: "AntsAnswers.v", ants::terms;
    packs_stay_connected_as_the_proofs_have_it: "PackAnswers.v", pack::terms;
    agents_search_in_trees_as_the_proofs_have_it: "TreesAnswers.v", trees::terms;
}

#[test]
fn clauses_about_two_robots_have_certificates() {
    let mut left = Vec::new();
    for clause in ledger::clauses() {
        for check in clause.checks {
            let name = format!("{}_{}", clause.id, check.rule()).replace('-', "_");
            match check.certificate() {
                Some(Ok(terms)) => is_up_to_date(&format!("{name}.v"), &terms),
                Some(Err(why)) => left.push(format!("{name}: {why}")),
                None => {}
            }
        }
    }
    insta::assert_snapshot!(left.join("\n"), @r"
    CHAIN_2_repaired: a certificate would have 40000000 entries, more than 2000000
    CHAIN_2_reel: a certificate would have 40000000 entries, more than 2000000
    CHAIN_15_published: a certificate would have 16468459 entries, more than 2000000
    ");
}
