//! A protocol as a model of stateright. It shares the moves with the search over states, and nothing of the engine.

use std::hash::Hash;

use stateright::{Model, Property};
use tautline_proofs::protocol::{Move, Protocol, Surroundings};

/// A protocol in its surroundings, whose states are counted.
pub(crate) struct CountedModel<P: Protocol>(pub(crate) P, pub(crate) Surroundings<P>);

impl<P: Protocol> Model for CountedModel<P>
where
    P::State: Hash,
{
    type State = P::State;
    type Action = Move<P::State>;

    fn init_states(&self) -> Vec<P::State> {
        self.0.starts(&self.1).into_iter().collect()
    }

    fn actions(&self, state: &P::State, actions: &mut Vec<Move<P::State>>) {
        actions.extend(self.0.moves(&self.1, state));
    }

    fn next_state(&self, _: &P::State, action: Move<P::State>) -> Option<P::State> {
        Some(action.to)
    }

    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always("nothing", |_, _| true)]
    }
}
