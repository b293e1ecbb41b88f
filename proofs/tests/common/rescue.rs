//! MRC as a model of stateright.

use stateright::{Model, Property};
use tautline_proofs::mrc::{Action, Demand, Setting, State};

/// A setting, and the demands that no state may break.
pub(crate) struct Rescue(pub(crate) Setting, pub(crate) Vec<Demand>);

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
