//! MRC's states, counted twice: by the search of `prove`, which keeps the parts of states and looks for cycles, and by
//! stateright, which keeps fingerprints and knows no cycles. Both must find the same states, and break a demand in as
//! few steps. Then longer runs with more faults than can be searched, at random.

#[path = "common/rescue.rs"]
mod model;

use std::collections::hash_map::{DefaultHasher, Entry};
use std::collections::{BTreeSet, HashMap, HashSet, VecDeque};
use std::hash::{Hash, Hasher};

use stateright::{Checker, Model};
use tautline_kernel::choice::Oracle;
use tautline_kernel::mrc::{Condition, Phase, Rule, Task};
use tautline_proofs::engine::states::{Limits, System};
use tautline_proofs::engine::{Outcome, require, sample};
use tautline_proofs::mrc::Records::{ByPacket, ByWfr};
use tautline_proofs::mrc::Start::{AtOnce, Later};
use tautline_proofs::mrc::space::{Findings, Space, Until, search};
use tautline_proofs::mrc::{
    Action, Actor, Demand, Faults, Leases, LossKind, Misreading, RobotReading, Setting, State,
};

use self::model::Rescue;

const fn setting((robots, wfrs): (usize, usize), events: u8, max_hops: u16, faults: Faults) -> Setting {
    Setting {
        rule: Rule::REPAIRED,
        misread: None,
        reading: RobotReading::PUBLISHED,
        robots,
        wfrs,
        events,
        max_hops,
        faults,
        lossy: LossKind::All,
        leases: Leases::UntilCalled,
    }
}

const ENOUGH: Limits<'_> = Limits::steps(200_000_000);

fn found(setting: &Setting) -> Findings {
    search(setting, Until::Exhausted, ENOUGH)
}

/// The repaired rule breaks nothing, in so many states and steps.
fn holds(setting: &Setting, states: u64, steps: u64) {
    let found = found(setting);
    assert!(found.complete);
    assert_eq!(found.broken, [], "{setting:?}");
    assert_eq!((found.states, found.steps), (states, steps), "{setting:?}");
}

#[test]
fn stateright_finds_the_same_states_of_the_repaired_rule_and_none_that_breaks_a_demand() {
    for (setting, states) in [
        (setting((2, 1), 2, 2, Faults::any(1)), 11_640),
        (setting((2, 2), 2, 2, Faults::any(1)), 1_037_226),
        (setting((3, 1), 2, 2, Faults::any(1)), 272_256),
    ] {
        let checker = Rescue(setting, Demand::ALL.to_vec()).checker().threads(1).spawn_bfs().join();
        checker.assert_properties();
        let counted = (checker.unique_state_count() as u64, found(&setting).states);
        assert_eq!(counted, (states, states), "{setting:?}");
    }
}

/// A state as it is: every field, epochs by their numbers, records and notes whether or not they play a part.
fn fingerprint(state: &State) -> u64 {
    let mut hasher = DefaultHasher::new();
    format!("{state:?}").hash(&mut hasher);
    hasher.finish()
}

/// The future of a state: what it breaks, who waits, whose timer runs; and for each action whether it is bound to
/// happen and which state, as the search tells states apart, it leads to.
#[derive(PartialEq, Eq, Debug)]
struct Future {
    broken: Vec<Demand>,
    owed: Vec<bool>,
    awake: Vec<bool>,
    next: Vec<(Action, bool, State)>,
}

impl Future {
    fn of(setting: &Setting, state: &State) -> Self {
        let actors = (0..setting.robots).map(Actor::Robot).chain((0..setting.wfrs).map(Actor::Wfr));
        let after =
            |action| (action, state.is_bound_to_happen(setting, action), state.after(setting, action));
        Self {
            broken: Demand::ALL.into_iter().filter(|&demand| state.breaks(demand)).collect(),
            owed: (0..setting.wfrs).map(|wfr| state.is_owed_service(setting, wfr)).collect(),
            awake: actors.map(|actor| state.timer_runs(actor)).collect(),
            next: state.actions(setting).into_iter().map(after).collect(),
        }
    }
}

/// Goes on from every state that differs in anything at all, up to so many: how many there are, and the futures of
/// those that are left once states that have the same parts are taken for one. All of these must have the same future,
/// and so must the one that stands for them.
fn futures(setting: &Setting, most: usize) -> (usize, HashMap<State, Future>) {
    let (mut known, mut futures) = (HashSet::new(), HashMap::new());
    let mut ahead = VecDeque::from(setting.starts());
    while known.len() < most
        && let Some(state) = ahead.pop_front()
    {
        if !known.insert(fingerprint(&state)) {
            continue;
        }
        let future = Future::of(setting, &state);
        ahead.extend(future.next.iter().map(|(.., after)| after.clone()));
        match futures.entry(state.clone()) {
            Entry::Vacant(entry) => {
                let mut canonical = state.clone();
                Space { setting: *setting, until: Until::Exhausted }.make_canonical(&mut canonical);
                assert_eq!(Future::of(setting, &canonical), future, "{state:?}");
                entry.insert(future);
            }
            Entry::Occupied(entry) => assert_eq!(entry.get(), &future, "{state:?}"),
        }
    }
    (known.len(), futures)
}

/// The search and stateright both take states for one that have the same parts, so neither would notice parts that
/// leave out something that matters.
#[test]
fn states_that_are_taken_for_one_have_the_same_future() {
    let setting = setting((2, 1), 2, 2, Faults::any(1));
    let (known, futures) = futures(&setting, usize::MAX);
    let found = found(&setting);
    assert_eq!(futures.len() as u64, found.states);
    assert_eq!((known, futures.len()), (16_092, 11_640));
    for demand in Demand::ALL.into_iter().filter(|&demand| demand != Demand::IsServed) {
        let is_broken = futures.values().any(|future| future.broken.contains(&demand));
        assert_eq!(is_broken, found.broken(demand).is_some(), "{demand:?}");
    }
}

/// With two WFRs calls go on without end, and so their numbers do, while a robot is on its way elsewhere.
#[test]
fn so_do_the_first_ones_where_there_are_several_wfrs() {
    let by_first_heard = Rule::REPAIRED.without(Condition::LeastIdentity);
    let bids_again = Rule::REPAIRED.without(Condition::ChoiceStands);
    let rules = [Rule::REPAIRED, Rule::PUBLISHED, by_first_heard, bids_again].map(|rule| (rule, None));
    let misreading = [Misreading::Askers, Misreading::Offers].map(|it| (Rule::REPAIRED, Some(it)));
    for (rule, misread) in rules.into_iter().chain(misreading) {
        for setting in [
            setting((1, 2), 3, 2, Faults::any(1)),
            setting((2, 2), 2, 1, Faults::any(1)),
            setting((1, 3), 3, 1, Faults::any(0)),
        ] {
            let (known, futures) = futures(&Setting { rule, misread, ..setting }, 10_000);
            assert!(futures.len() < known, "{known} states of {setting:?}");
        }
    }
}

#[test]
fn stateright_breaks_the_published_rule_in_as_few_steps() {
    let setting = Setting { rule: Rule::PUBLISHED, ..setting((2, 2), 2, 1, Faults::any(1)) };
    let found = found(&setting);
    for demand in Demand::ALL.into_iter().filter(|&demand| demand != Demand::IsServed) {
        let checker = Rescue(setting, vec![demand]).checker().threads(1).spawn_bfs().join();
        let theirs = checker.discovery("keeps").map(|path| path.into_actions().len());
        assert_eq!(found.broken(demand).map(|broken| broken.actions.len()), theirs, "{demand:?}");
    }
    assert!(found.broken(Demand::IsServed).is_some());
}

/// The demands that break where nothing is lost, doubled or late, nobody fails and each WFR calls once, as if each
/// event had a RID of its own. A robot asks no WFR any more whose RESB it has heard, so no run goes round.
fn broken_over_reliable_links(
    (rule, reading): (Rule, RobotReading),
    (robots, wfrs): (usize, usize),
    max_hops: u16,
) -> Vec<Demand> {
    let reliable = setting((robots, wfrs), wfrs as u8, max_hops, Faults::any(0));
    let setting = Setting { rule, reading, ..reliable };
    let (mut ahead, mut known, mut broken) = (setting.starts(), HashSet::new(), BTreeSet::new());
    while let Some(state) = ahead.pop() {
        if !known.insert(state.clone()) {
            continue;
        }
        broken.extend(Demand::ALL.into_iter().filter(|&demand| state.breaks(demand)));
        let mut actions = state.actions(&setting);
        let has_called = |wfr: usize| state.wfr(wfr).phase() != Phase::Idle;
        actions.retain(|action| !matches!(action, &Action::Raise(wfr) if has_called(wfr)));
        let goes_on = |&action: &Action| {
            state.is_bound_to_happen(&setting, action) && state.after(&setting, action) != state
        };
        if !actions.iter().any(goes_on) && (0..wfrs).any(|wfr| state.is_owed_service(&setting, wfr)) {
            broken.insert(Demand::IsServed);
        }
        ahead.extend(actions.into_iter().map(|action| state.after(&setting, action)));
    }
    broken.into_iter().collect()
}

#[test]
fn over_reliable_links_and_with_a_new_rid_for_each_event_a_window_with_answers_breaks_mrc_4_alone() {
    use Demand::*;
    let window = Rule::PUBLISHED.with(Condition::ChoiceStands).with(Condition::Window);
    let answered = window.with(Condition::AnswersAgain);
    // Whichever packets make a record (here one of each call comes), and whenever a robot asks.
    for (records, start) in [(ByWfr, AtOnce), (ByPacket, AtOnce), (ByWfr, Later), (ByPacket, Later)] {
        let reading = RobotReading { records, start, ..RobotReading::PUBLISHED };
        for (robots_wfrs, max_hops) in [((2, 2), 2), ((2, 3), 1), ((3, 2), 1)] {
            let broken = broken_over_reliable_links((answered, reading), robots_wfrs, max_hops);
            assert_eq!(broken, [CountsOnConsent], "{reading:?}");
        }
    }
    let broken = |rule, robots_wfrs, max_hops| {
        broken_over_reliable_links((rule, RobotReading::PUBLISHED), robots_wfrs, max_hops)
    };
    assert_eq!(broken(window, (2, 2), 2), [CountsOnConsent, TellsWhoAsked]);
    assert_eq!(broken(window, (2, 3), 1), [CountsOnConsent, IsServed, TellsWhoAsked]);
    let anew =
        [OneRobotForACall, BestOfTheWindow, CountsOnConsent, IsServed, TakesWhatItAsksFor, TellsWhoAsked];
    assert_eq!(broken(Rule::PUBLISHED, (2, 2), 2), anew);
}

#[test]
fn the_repaired_rule_holds_with_two_faults() {
    holds(&setting((2, 1), 2, 2, Faults::any(2)), 284_056, 1_095_824);
    holds(&setting((2, 2), 2, 1, Faults::any(2)), 1_826_014, 7_471_568);
}

/// The demands that break without one condition, or without several.
#[test]
fn each_condition_is_needed_for_the_clauses_that_the_spec_names() {
    use Condition::*;
    use Demand::*;
    let broken = |conditions: &[Condition]| {
        let rule = conditions.iter().fold(Rule::REPAIRED, |rule, &condition| rule.without(condition));
        let of = |robots_wfrs, events| {
            found(&Setting { rule, ..setting(robots_wfrs, events, 2, Faults::any(1)) }).broken
        };
        let found = [of((2, 1), 2), of((1, 2), 3)].concat();
        Demand::ALL
            .into_iter()
            .filter(|&demand| found.iter().any(|broken| broken.run.demand == demand))
            .collect()
    };
    let expected: [(&[Condition], &[Demand]); 13] = [
        (&[NearestCall], &[AsksNearest]),
        (&[NearestRobot], &[BestOfTheWindow]),
        (&[LeastIdentity], &[BestOfTheWindow, AsksNearest]),
        (&[NearestCall, NearestRobot, LeastIdentity], &[BestOfTheWindow, AsksNearest]),
        (&[Window], &[BestOfTheWindow, IsServed]),
        (&[ChoiceStands], &[OneRobotForACall, BestOfTheWindow, TellsWhoAsked]),
        (&[AnswersAgain], &[TellsWhoAsked]),
        (&[Repetition], &[]),
        (&[AnswersAgain, Repetition], &[IsServed, TellsWhoAsked]),
        (&[Epochs], &[BestOfTheWindow, IsServed, AsksAnew, TakesWhatItAsksFor, TellsWhoAsked]),
        (&[Consent], &[OneCallForARobot, CountsOnConsent, TakesWhatItAsksFor]),
        (&[StillAsks], &[TakesWhatItAsksFor]),
        (&[Renewal], &[IsServed]),
    ];
    for (conditions, demands) in expected {
        let broken: Vec<Demand> = broken(conditions);
        assert_eq!(broken, demands, "{conditions:?}");
    }
}

#[test]
fn the_repaired_rule_holds_where_a_robot_lets_a_lease_go_that_is_over_and_not_where_it_does_so_earlier() {
    let lapsing = |setting: Setting| Setting { leases: Leases::UntilOver, ..setting };
    holds(&lapsing(setting((2, 1), 2, 2, Faults::any(1))), 11_664, 33_100);
    holds(&lapsing(setting((2, 2), 2, 1, Faults::any(1))), 66_375, 217_589);
    holds(&lapsing(setting((2, 1), 2, 2, Faults::any(2))), 284_916, 1_101_540);
    let early = Setting { leases: Leases::Any, ..setting((1, 2), 2, 1, Faults::any(0)) };
    let broken: Vec<Demand> = found(&early).broken.iter().map(|broken| broken.run.demand).collect();
    assert_eq!(broken, [Demand::OneCallForARobot, Demand::IsServed]);
}

#[test]
#[ignore = "deeper, two minutes and 2 GiB: cargo test -p tautline-proofs --test all rescue -- --ignored"]
fn the_repaired_rule_holds_for_two_robots_with_three_faults() {
    holds(&setting((2, 1), 2, 2, Faults::any(3)), 5_459_592, 27_338_800);
}

/// A run at random, as long as there are events and faults left, and then without another fault until nobody waits.
fn long_run(setting: &Setting, oracle: &mut dyn Oracle) -> Outcome {
    let mut starts = setting.starts();
    let mut state = starts.swap_remove(oracle.pick(starts.len() as u32) as usize);
    let is_owed = |state: &State| (0..setting.wfrs).any(|wfr| state.is_owed_service(setting, wfr));
    for step in 0..10_000 {
        let mut actions = state.actions(setting);
        if step >= 300 {
            actions.retain(|&action| state.is_bound_to_happen(setting, action));
        }
        if actions.is_empty() || step >= 300 && !is_owed(&state) {
            break;
        }
        state = state.after(setting, actions.swap_remove(oracle.pick(actions.len() as u32) as usize));
        for demand in Demand::ALL {
            require(!state.breaks(demand), demand.broken())?;
        }
    }
    require(!is_owed(&state), Demand::IsServed.broken())?;
    Ok("nobody waits")
}

#[test]
fn the_repaired_rule_holds_in_long_runs_with_many_faults_and_the_mutants_do_not() {
    let faults = Faults { robots: 2, ..Faults::any(20) };
    let setting = setting((3, 2), 8, 2, faults);
    let violation = |rule: Rule| {
        let setting = Setting { rule, ..setting };
        sample(20_000, 0, |oracle| long_run(&setting, oracle)).violation.map(|(_, demand)| demand)
    };
    assert_eq!(violation(Rule::REPAIRED), None);
    let lapsing = Setting { leases: Leases::UntilOver, ..setting };
    assert_eq!(sample(20_000, 0, |oracle| long_run(&lapsing, oracle)).violation, None);
    for rule in [
        Rule::PUBLISHED,
        Rule::REPAIRED.without(Condition::Window),
        Rule::REPAIRED.without(Condition::ChoiceStands),
        Rule::REPAIRED.without(Condition::Epochs),
        Rule::REPAIRED.without(Condition::Consent),
        Rule::REPAIRED.without(Condition::Renewal),
    ] {
        assert!(violation(rule).is_some(), "{rule:?}");
    }
}

const MOST_HOPS: u32 = 6;

/// A rescue of three WFRs by three robots, each hop of a message lost with a chance of one in ten, one robot failing
/// somewhere on the way. Timers are long enough.
fn rescue(rule: Rule, oracle: &mut dyn Oracle) -> Outcome {
    let faults = Faults { in_all: u8::MAX, losses: u8::MAX, robots: 1, ..Faults::any(0) };
    let setting = Setting { rule, ..setting((3, 3), 3, MOST_HOPS as u16, faults) };
    let mut state = setting.start(oracle.pick(MOST_HOPS.pow(9)));
    let (victim, fails_at) = (oracle.pick(3) as usize, oracle.pick(100));
    let (mut called, mut came) = ([false; 3], [0; 3]);
    for step in 0..20_000 {
        let actions = state.actions(&setting);
        if step == fails_at {
            state = state.after(&setting, Action::FailRobot(victim));
            continue;
        }
        let may_happen = |&action: &Action| match action {
            Action::Raise(wfr) => !called[wfr],
            Action::Begin(_)
            | Action::Deliver(_)
            | Action::Expire(_)
            | Action::Arrive(_)
            | Action::Lapse(_)
            | Action::Lose(_)
            | Action::Duplicate(_)
            | Action::FailRobot(_)
            | Action::FailNode { .. } => state.is_bound_to_happen(&setting, action),
        };
        let next: Vec<Action> = actions.iter().copied().filter(may_happen).collect();
        let Some(&action) = next.get(oracle.pick(next.len().max(1) as u32) as usize) else { break };
        let mut happens = action;
        if let Action::Raise(wfr) = action {
            called[wfr] = true;
        }
        if let Action::Arrive(robot) = action
            && let Task::Leased { call } = state.robot(robot).task()
        {
            came[call.wfr.0 as usize] += 1;
        }
        if let Action::Deliver(at) = action {
            let message = state.network()[at];
            let hops = state.hops(message.robot().0.into(), message.call().wfr.0 as usize);
            let is_lost = (0..hops).fold(false, |lost, _| lost | (oracle.pick(10) == 0));
            if is_lost && actions.contains(&Action::Lose(at)) {
                happens = Action::Lose(at);
            }
        }
        state = state.after(&setting, happens);
    }
    require((0..3).all(|wfr| !state.wfr(wfr).is_waiting()), "every WFR is rescued")?;
    require(came == [1; 3], "every WFR is rescued by exactly one robot")?;
    Ok("three rescues")
}

#[test]
fn of_a_thousand_rescues_with_losses_and_a_robot_failing_all_succeed_repaired_and_one_in_six_as_published() {
    let of_a_thousand = |rule: Rule| {
        let one = |seed: u64| sample(1, seed, |oracle| rescue(rule, oracle)).violation.is_none();
        (0..1000).filter(|&seed| one(seed)).count()
    };
    assert_eq!(of_a_thousand(Rule::REPAIRED), 1000);
    assert_eq!(of_a_thousand(Rule::PUBLISHED), 170);
}
