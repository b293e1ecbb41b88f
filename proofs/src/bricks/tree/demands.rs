//! The demands on agents that search in trees alone (BRICKS-8 to BRICKS-13), in plain arithmetic.

use tautline_kernel::bricks::tree::{Act, Agent, Label, Next, Note, Rule, State, View};
use tautline_kernel::floor::COMPASS;
use tautline_kernel::ground::Side;

use super::TreeRule;
use crate::floor::plans::{Edges, FloorPlan};
use crate::floor::small::{Sensors, StateOf};
use crate::floor::team::Demands;

/// BRICKS-13 in words.
pub(super) const LEAST_ENTERED: &str = "an agent that goes to a child goes to one that was entered least";

/// A demand on agents that search in trees.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Own {
    /// BRICKS-8
    Whole,
    /// BRICKS-9
    Rising,
    /// BRICKS-10
    Bounded,
    /// BRICKS-12
    Twice,
    /// BRICKS-13
    LeastEntered,
}

impl<T: TreeRule> Demands for T {
    type Own = Own;

    fn of_all() -> &'static [Own] {
        &[Own::Whole, Own::Rising]
    }

    fn is_over(own: Own, state: &StateOf<T>) -> bool {
        own == Own::Bounded && founded::<T>(state) > 1
    }

    fn counts_moves(own: Own) -> bool {
        matches!(own, Own::Bounded | Own::Twice)
    }

    fn broken_by_act(own: Own, view: &View, act: &Act) -> Option<&'static str> {
        let is_broken = own == Own::LeastEntered && !goes_to_least_entered(view, act.next);
        is_broken.then_some(LEAST_ENTERED)
    }

    fn broken_in(own: Own, plan: &FloorPlan, state: &StateOf<T>, agent: usize) -> Option<&'static str> {
        let is_beyond = |each| u32::from(state.bodies[agent].moves) > each * plan.free.count_ones();
        let (is_broken, words) = match own {
            Own::Whole => (
                !are_trees_whole(&state.sensors, plan),
                "the cells of a tree stay connected through trees whose labels are not lower",
            ),
            Own::Rising => (!do_labels_rise(&state.sensors, plan), "labels never fall towards the root"),
            Own::Bounded => (
                founded::<T>(state) <= 1 && is_beyond(2),
                "with one tree an agent makes at most two moves a cell",
            ),
            Own::Twice => (is_beyond(2), "an agent alone makes at most two moves a cell"),
            Own::LeastEntered => return None,
        };
        is_broken.then_some(words)
    }
}

/// The trees that there have been.
fn founded<T: TreeRule>(state: &StateOf<T>) -> u32 {
    state.bodies.iter().map(|body| T::founded(&body.memory)).sum()
}

/// Whether the cells of each tree are connected through cells of trees with labels that are not lower (BRICKS-8).
fn are_trees_whole(sensors: &Sensors<Note>, plan: &FloorPlan) -> bool {
    let labels = sensors.all.iter().filter_map(|note| note.tree());
    labels.into_iter().all(|label: Label| {
        let own = sensors.cells(plan, |note| note.tree() == Some(label));
        let mut among = sensors.cells(plan, |note| note.tree().is_some_and(|other| other >= label));
        while among != 0 {
            let part = plan.spread(among, Edges::default());
            if part & own != 0 {
                return own & !part == 0;
            }
            among &= !part;
        }
        true
    })
}

/// Whether every cell of a tree that has a parent has one in a tree with a label that is not lower (BRICKS-9).
fn do_labels_rise(sensors: &Sensors<Note>, plan: &FloorPlan) -> bool {
    (0..).zip(&sensors.all).all(|(place, note)| {
        let (Some(label), Some(side)) = (note.tree(), note.side) else { return true };
        let parent = plan.place(plan.cell(place).beyond(side)).map(|parent| sensors.all[parent]);
        parent.is_some_and(|parent| parent.state == State::Open && parent.label >= label)
    })
}

/// How many times the child of the cell beyond `side` was entered, as far as the agent has seen it; `None` if there is
/// none.
pub(super) fn entered(view: &View, side: Side) -> Option<u16> {
    let (_, note) = COMPASS.into_iter().zip(view.beside).find(|&(other, _)| other == side)?;
    let is_child = note.state == State::Open && note.side == Some(side.opposite());
    is_child.then_some(note.crossings)
}

/// Whether no child was entered less often than the one that the agent goes to, if it goes to one (BRICKS-13).
pub(super) fn goes_to_least_entered(view: &View, next: Next) -> bool {
    let Next::Goes(side) = next else { return true };
    let least = COMPASS.into_iter().filter_map(|side| entered(view, side)).min();
    entered(view, side).is_none_or(|often| Some(often) == least)
}

/// A rule, and where its agents go to cells that they know.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::bricks) struct TravelRule {
    pub(in crate::bricks) rule: Rule,
    pub(in crate::bricks) to: To,
}

/// Where an agent goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::bricks) enum To {
    /// Where the rule says.
    Ruled,
    /// If to a child, to the first in the order of the compass: a mutant's.
    FirstChild,
    /// If to a child, to one that was entered most: a mutant's.
    MostEntered,
    /// From a visited cell to the first open one beside it: a mutant's.
    OpenBeside,
}

impl TreeRule for TravelRule {
    type Memory = Agent;

    fn memory(&self, id: u8) -> Agent {
        Agent::new(id)
    }

    fn decide(&self, agent: &mut Agent, view: &View) -> Act {
        let mut act = agent.decide(self.rule, view);
        let Next::Goes(side) = act.next else { return act };
        let is_child = |side: &Side| entered(view, *side).is_some();
        let first = match self.to {
            To::FirstChild if is_child(&side) => COMPASS.into_iter().find(is_child),
            To::MostEntered if is_child(&side) => COMPASS.into_iter().max_by_key(|&side| entered(view, side)),
            To::OpenBeside if view.here.state == State::Visited => view.trees().next().map(|(side, _)| side),
            To::Ruled | To::FirstChild | To::MostEntered | To::OpenBeside => None,
        };
        act.next = Next::Goes(first.unwrap_or(side));
        act
    }

    fn writes(&self) -> Rule {
        self.rule
    }

    fn founded(agent: &Agent) -> u32 {
        agent.founded
    }
}
