//! The tie between the kernel and the proofs of `proofs/rocq`: what the kernel answers is written down as Rocq terms,
//! and Rocq compares it with the definitions that the theorems speak of. Here the committed files are compared byte by
//! byte with fresh ones. So neither the kernel nor the definitions can move alone.

#[path = "rocq/ants.rs"]
mod ants;
#[path = "rocq/chain.rs"]
mod chain;
#[path = "rocq/epochs.rs"]
mod epochs;
#[path = "rocq/fixes.rs"]
mod fixes;
#[path = "rocq/frontier.rs"]
mod frontier;
#[path = "rocq/ground.rs"]
mod ground;
#[path = "rocq/joint.rs"]
mod joint;
#[path = "rocq/kit.rs"]
mod kit;
#[path = "rocq/machines.rs"]
mod machines;
#[path = "rocq/mrc.rs"]
mod mrc;
#[path = "rocq/notice.rs"]
mod notice;
#[path = "rocq/pack.rs"]
mod pack;
#[path = "rocq/plans.rs"]
mod plans;
#[path = "rocq/reel.rs"]
mod reel;
#[path = "rocq/runs.rs"]
mod runs;
#[path = "rocq/tan.rs"]
mod tan;
#[path = "rocq/term.rs"]
mod term;
#[path = "rocq/trees.rs"]
mod trees;
#[path = "rocq/turns.rs"]
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

#[test]
fn the_chain_answers_as_the_proofs_have_it() {
    is_up_to_date("ChainAnswers.v", &chain::terms());
}

#[test]
fn chains_run_as_the_proofs_have_it() {
    is_up_to_date("Runs.v", &runs::terms());
}

#[test]
fn plans_are_accepted_as_the_proofs_have_it() {
    is_up_to_date("PlanAnswers.v", &plans::terms());
}

#[test]
fn reels_run_as_the_proofs_have_it() {
    is_up_to_date("ReelRuns.v", &reel::terms());
}

#[test]
fn epochs_end_as_the_proofs_have_it() {
    is_up_to_date("EpochRuns.v", &epochs::terms());
}

#[test]
fn nodes_answer_as_the_proofs_have_it() {
    is_up_to_date("NoticeAnswers.v", &notice::terms());
}

#[test]
fn robots_and_wfrs_answer_as_the_proofs_have_it() {
    is_up_to_date("MrcAnswers.v", &mrc::terms());
}

#[test]
fn machines_of_a_rescue_answer_as_the_proofs_have_it() {
    is_up_to_date("MachineAnswers.v", &machines::terms());
}

#[test]
fn robots_on_their_way_answer_as_the_proofs_have_it() {
    is_up_to_date("HomingAnswers.v", &tan::terms());
}

#[test]
fn robots_walk_as_the_proofs_have_it() {
    is_up_to_date("PatienceRuns.v", &tan::walks());
}

#[test]
fn robots_keep_in_touch_as_the_proofs_have_it() {
    is_up_to_date("KitAnswers.v", &kit::terms());
}

#[test]
fn robots_drive_paths_again_as_the_proofs_have_it() {
    is_up_to_date("JointRuns.v", &joint::terms());
}

#[test]
fn robots_explore_cells_as_the_proofs_have_it() {
    is_up_to_date("FrontierRuns.v", &frontier::terms());
}

#[test]
fn a_repaired_run_without_an_end_is_as_the_proofs_have_it() {
    is_up_to_date("FrontierEndless.v", &frontier::without_end());
}

#[test]
fn fixes_are_taken_as_the_proofs_have_it() {
    is_up_to_date("FixAnswers.v", &fixes::terms());
}

#[test]
fn ants_go_as_the_proofs_have_it() {
    is_up_to_date("AntsAnswers.v", &ants::terms());
}

#[test]
fn packs_stay_connected_as_the_proofs_have_it() {
    is_up_to_date("PackAnswers.v", &pack::terms());
}

#[test]
fn agents_search_in_trees_as_the_proofs_have_it() {
    is_up_to_date("TreesAnswers.v", &trees::terms());
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
