//! PIBT, priority inheritance with backtracking: Okumura, Machida, Défago and Tamura (IJCAI 2019); reservation before
//! the recursion as in Artificial Intelligence 310 (2022), Algorithm 1. In each step the robots plan in the order of
//! their priorities: a robot takes the cell nearest its goal; who stands there inherits the priority, and plans next,
//! but not into the cell of the robot that pushes it; if it can go nowhere, the pushing robot tries its next cell. A
//! robot at its goal gets the lowest priority. Priorities count steps without end; their order is all that matters.

use crate::inheritance::{PIBT, Pibt, Plan};
use crate::prelude::*;

/// Where robots are, and their order, the highest priority first.
type State = (Vec<u8>, Vec<u8>);

impl Protocol for Pibt {
    type Bound = Teams;
    type State = State;
    demands! {
        always APART, |_, _, before, after| !conflicts(&before.0, &after.0);
        again_and_again "every robot comes to its goal", |_, task, (now, _)| {
            set((0..now.len()).filter(|&robot| now[robot] != task.goals[robot]))
        };
    }

    fn starts(&self, task: &Task) -> impl IntoIterator<Item = State> {
        let order: Vec<u8> = (0..task.goals.len() as u8).collect();
        task.starts().into_iter().map(move |starts| (starts, order.clone()))
    }

    fn moves(&self, Task { graph, goals }: &Task, (now, order): &State) -> Vec<Move<State>> {
        let mut plan = Plan { rule: *self, graph, now, goals, next: vec![None; now.len()] };
        for &robot in order {
            if plan.next[usize::from(robot)].is_none() {
                plan.plan(usize::from(robot));
            }
        }
        let next: Vec<u8> = plan.next.into_iter().flatten().collect();
        let mut order = order.clone();
        let is_there = |robot: u8| next[usize::from(robot)] == goals[usize::from(robot)];
        if self.rotates {
            order.sort_by_key(|&robot| if is_there(robot) { 1 + robot } else { 0 });
        }
        vec![Move::of_all(now.len(), "all move", (next, order))]
    }

    fn draw(&self, task: &Task, (now, _): &State) -> String {
        task.draw(now)
    }
}

const SMALL: Teams = Teams::within(Kind::Biconnected, 3, 2, 3);
const SQUARE: Teams = Teams::within(Kind::Biconnected, 3, 3, 3);
const CROWDED: Teams = Teams::within(Kind::Biconnected, 3, 2, 5);
const FOUR: Teams = Teams::within(Kind::Biconnected, 3, 3, 4).of_cells(5, 6);
const ANY: Teams = Teams::within(Kind::Connected, 3, 2, 4);
/// A square with a dead end among them: two robots can always change places there.
const DEAD_ENDS: Teams = Teams::within(Kind::Connected, 3, 2, 2).of_cells(5, 6);

entry! { Pibt: "pibt", "PIBT", "PIBT",
    "Okumura, Machida, Défago, Tamura, *Priority Inheritance with Backtracking for Iterative Multi-agent Path \
     Finding*, IJCAI 2019, Algorithm 1 and Theorem 1; the reservation as in Artificial Intelligence 310, 2022";
    PUBLISHED = "published", PIBT;
    OUTSIDE = "published outside its premises", PIBT;
    SWAPS = "pushes back", Pibt { has_no_swap: false, ..PIBT };
    ONE_TRY = "no backtracking", Pibt { backtracks: false, ..PIBT };
    FIXED = "fixed priorities", Pibt { rotates: false, ..PIBT };
    1: "No two robots MUST come into one cell, or change places." {
        Holds PUBLISHED within SMALL, not SWAPS;
        Holds PUBLISHED within ANY, not SWAPS;
    }
    2: "Every robot MUST come to its goal at some time, again and again." {
        Holds PUBLISHED within SMALL, not FIXED;
        Refuted OUTSIDE within DEAD_ENDS;
        Refuted ONE_TRY within CROWDED;
        Refuted FIXED within SMALL;
    } larger {
        Holds PUBLISHED within CROWDED, not ONE_TRY;
        Holds PUBLISHED within SQUARE, not FIXED;
        Holds PUBLISHED within FOUR, not FIXED;
    }
}
