//! MRC's states, counted twice: by the search of `prove`, which keeps whole states and looks for cycles, and by
//! stateright, which keeps fingerprints and knows no cycles. Both must find the same states, and break a demand in as
//! few steps.

use stateright::{Checker, Model, Property};
use tautline_kernel::rescue::Rule;
use tautline_proofs::rescue::space::{Found, Until, search};
use tautline_proofs::rescue::{Action, Demand, Faults, Lossy, Setting, State};

/// A setting, and the demands that no state may break.
struct Rescue(Setting, Vec<Demand>);

impl Model for Rescue {
    type State = State;
    type Action = Action;

    fn init_states(&self) -> Vec<State> {
        self.0.starts()
    }

    fn actions(&self, state: &State, actions: &mut Vec<Action>) {
        actions.extend(state.actions(&self.0));
    }

    fn next_state(&self, state: &State, action: Action) -> Option<State> {
        Some(state.after(&self.0, action))
    }

    fn properties(&self) -> Vec<Property<Self>> {
        let keeps =
            |Self(_, demands): &Self, state: &State| !demands.iter().any(|&demand| state.breaks(demand));
        vec![Property::always("keeps", keeps)]
    }
}

const fn setting((robots, wfrs): (usize, usize), events: u8, max_hops: u16, faults: Faults) -> Setting {
    Setting { rule: Rule::REPAIRED, robots, wfrs, events, max_hops, faults, lossy: Lossy::All }
}

const ENOUGH: usize = 40_000_000;

fn found(setting: &Setting) -> Found {
    search(setting, Until::Exhausted, ENOUGH)
}

/// The repaired rule breaks nothing, in so many states and steps.
fn holds(setting: &Setting, states: usize, steps: usize) {
    let found = found(setting);
    assert!(found.complete);
    assert_eq!(found.broken, [], "{setting:?}");
    assert_eq!((found.states, found.steps), (states, steps), "{setting:?}");
}

#[test]
fn stateright_finds_the_same_states_of_the_repaired_rule_and_none_that_breaks_a_demand() {
    for (setting, states) in [
        (setting((2, 1), 2, 2, Faults::any(1)), 11_388),
        (setting((2, 2), 2, 2, Faults::any(1)), 376_572),
        (setting((3, 2), 2, 1, Faults::any(1)), 291_099),
    ] {
        let checker = Rescue(setting, Demand::ALL.to_vec()).checker().threads(1).spawn_bfs().join();
        checker.assert_properties();
        let counted = (checker.unique_state_count(), found(&setting).states);
        assert_eq!(counted, (states, states), "{setting:?}");
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

#[test]
fn the_repaired_rule_holds_with_two_faults() {
    holds(&setting((2, 1), 2, 2, Faults::any(2)), 283_256, 1_045_312);
    holds(&setting((2, 2), 2, 1, Faults::any(2)), 644_372, 2_064_427);
}

#[test]
#[ignore = "deeper, some minutes and 2 GiB: cargo test -p tautline-proofs --test rescue -- --ignored"]
fn the_repaired_rule_holds_for_two_robots_with_three_faults() {
    holds(&setting((2, 1), 2, 2, Faults::any(3)), 5_572_708, 26_865_616);
}
