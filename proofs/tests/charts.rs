//! The flaws of MRC as published, each as the shortest message sequence chart that shows it; the repaired rule breaks
//! nothing in any of these settings.

use insta::assert_snapshot;
use tautline_kernel::mrc::{Condition, Rule};
use tautline_proofs::engine::states::Limits;
use tautline_proofs::mrc::chart::chart;
use tautline_proofs::mrc::space::{Until, search};
use tautline_proofs::mrc::{Demand, Faults, Leases, LossKind, RobotReading, Setting};

const NO_FAULT: Faults = Faults::any(0);

/// One robot, one WFR, one event, all one hop away.
const LEAST: Setting = Setting {
    rule: Rule::PUBLISHED,
    misread: None,
    reading: RobotReading::PUBLISHED,
    robots: 1,
    wfrs: 1,
    events: 1,
    max_hops: 1,
    faults: NO_FAULT,
    lossy: LossKind::All,
    leases: Leases::UntilCalled,
};

/// The chart of the shortest run that breaks `demand`, which no run of the repaired rule does.
fn flaw(setting: Setting, demand: Demand) -> String {
    let enough = Limits::NONE;
    let repaired = search(&Setting { rule: Rule::REPAIRED, ..setting }, Until::Exhausted, enough);
    assert!(repaired.complete);
    assert_eq!(repaired.broken, []);
    let found = search(&setting, Until::Broken(demand), enough);
    chart(&setting, found.broken(demand).expect("a run that breaks it"))
}

#[test]
fn without_a_collection_window_the_first_robot_heard_is_chosen() {
    let rule = Rule::PUBLISHED.with(Condition::ChoiceStands);
    let setting = Setting { rule, robots: 2, max_hops: 2, ..LEAST };
    assert_snapshot!("no_collection_window", flaw(setting, Demand::BestOfTheWindow));
}

#[test]
fn a_late_move_that_changes_the_choice_sends_two_robots() {
    let setting = Setting { robots: 2, ..LEAST };
    assert_snapshot!("late_move_redecides", flaw(setting, Demand::OneRobotForACall));
}

#[test]
fn a_late_move_that_nobody_answers_strands_a_robot() {
    let rule = Rule::REPAIRED.without(Condition::AnswersAgain).without(Condition::Repetition);
    let faults = Faults { in_all: 1, robots: 1, ..NO_FAULT };
    let setting = Setting { rule, robots: 2, wfrs: 2, events: 2, faults, ..LEAST };
    assert_snapshot!("late_move_unanswered", flaw(setting, Demand::IsServed));
}

#[test]
fn without_a_time_out_a_lost_notice_strands_a_wfr() {
    let faults = Faults { in_all: 1, losses: 1, ..NO_FAULT };
    assert_snapshot!("no_time_out", flaw(Setting { faults, ..LEAST }, Demand::IsServed));
}

#[test]
fn a_lost_resb_strands_a_robot_and_a_wfr() {
    let faults = Faults { in_all: 1, losses: 1, ..NO_FAULT };
    let setting = Setting { faults, lossy: LossKind::Resb, ..LEAST };
    assert_snapshot!("lost_resb", flaw(setting, Demand::IsServed));
}

#[test]
fn a_failed_robot_strands_a_wfr() {
    let faults = Faults { in_all: 1, robots: 1, ..NO_FAULT };
    let setting = Setting { faults, robots: 2, ..LEAST };
    assert_snapshot!("failed_robot", flaw(setting, Demand::IsServed));
}

#[test]
fn a_failed_node_strands_a_wfr() {
    let faults = Faults { in_all: 1, nodes: 1, ..NO_FAULT };
    assert_snapshot!("failed_node", flaw(Setting { faults, ..LEAST }, Demand::IsServed));
}

#[test]
fn a_late_move_after_the_rescue_makes_two_wfrs_count_on_one_robot() {
    let faults = Faults { in_all: 1, duplicates: 1, ..NO_FAULT };
    let setting = Setting { wfrs: 2, events: 3, faults, ..LEAST };
    assert_snapshot!("one_robot_for_two", flaw(setting, Demand::OneCallForARobot));
}

#[test]
fn a_wfr_counts_on_a_robot_that_does_not_know_it() {
    assert_snapshot!("no_consent", flaw(LEAST, Demand::CountsOnConsent));
}

#[test]
fn a_second_event_at_a_wfr_is_ignored() {
    assert_snapshot!("second_event", flaw(Setting { events: 2, ..LEAST }, Demand::AsksAnew));
}

#[test]
fn without_epochs_a_wfr_calls_for_ever_and_nobody_comes() {
    let rule = Rule::REPAIRED.without(Condition::Epochs);
    let faults = Faults { in_all: 1, robots: 1, ..NO_FAULT };
    let setting = Setting { rule, robots: 2, faults, ..LEAST };
    assert_snapshot!("no_epoch", flaw(setting, Demand::IsServed));
}
