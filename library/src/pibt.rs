//! PIBT, priority inheritance with backtracking: Okumura, Machida, Défago and Tamura (IJCAI 2019); reservation before
//! the recursion as in Artificial Intelligence 310 (2022), Algorithm 1. In each step the robots plan in the order of
//! their priorities: a robot takes the cell nearest its goal; who stands there inherits the priority, and plans next,
//! but not into the cell of the robot that pushes it; if it can go nowhere, the pushing robot tries its next cell. A
//! robot at its goal gets the lowest priority. Priorities count steps without end; their order is all that matters.

use crate::inheritance::{PIBT, Pibt, Plan};
use crate::prelude::*;

/// The rule in all layouts of its bound.
pub(crate) struct Team(Pibt, Teams, Vec<Graph>);

/// The number of the layout, where robots are and go to, and their order, the highest priority first.
type State = (u16, Vec<u8>, Vec<u8>, Vec<u8>);

impl Protocol for Team {
    type Rule = Pibt;
    type Bound = Teams;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always(APART, |_, before: &State, after: &State| !conflicts(&before.1, &after.1)),
        Demand::again_and_again("every robot comes to its goal", |_, (_, now, goals, _): &State| {
            set((0..now.len()).filter(|&robot| now[robot] != goals[robot]))
        }),
    ];

    fn new(rule: &Pibt, bound: &Teams) -> Result<Self, MethodError> {
        Ok(Self(*rule, *bound, bound.graphs.all()?))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        let order: Vec<u8> = (0..self.1.robots as u8).collect();
        let starts = self.1.instances(&self.2);
        starts.map(move |(graph, starts, goals)| (graph as u16, starts, goals, order.clone()))
    }

    fn moves(&self, (graph, now, goals, order): &State) -> Vec<Move<State>> {
        let next = vec![None; now.len()];
        let mut plan = Plan { rule: self.0, graph: &self.2[usize::from(*graph)], now, goals, next };
        for &robot in order {
            if plan.next[usize::from(robot)].is_none() {
                plan.plan(usize::from(robot));
            }
        }
        let next: Vec<u8> = plan.next.into_iter().flatten().collect();
        let mut order = order.clone();
        let is_there = |&robot: &u8| next[usize::from(robot)] == goals[usize::from(robot)];
        if self.0.rotates {
            order.sort_by_key(|robot| if is_there(robot) { 1 + *robot } else { 0 });
        }
        vec![Move::of_all(now.len(), "all move", (*graph, next, goals.clone(), order))]
    }

    fn draw(&self, (graph, now, goals, _): &State) -> String {
        robots(&self.2[usize::from(*graph)], now, goals)
    }
}

const SMALL: Teams = Teams::within(Kind::Biconnected, 3, 2, 3);
const CROWDED: Teams = Teams::within(Kind::Biconnected, 3, 2, 5);
const ANY: Teams = Teams::within(Kind::Connected, 3, 2, 4);
/// A square with a dead end among them: two robots can always change places there.
const DEAD_ENDS: Teams = Teams::within(Kind::Connected, 3, 2, 2).of_cells(5, 6);
const FOUR: Teams = Teams::within(Kind::Biconnected, 3, 3, 4).of_cells(5, 6);
const PUBLISHED: NamedRule<Pibt> = NamedRule::new("published", PIBT);
const SWAPS: NamedRule<Pibt> = NamedRule::new("pushes back", Pibt { has_no_swap: false, ..PIBT });
const ONE_TRY: NamedRule<Pibt> = NamedRule::new("no backtracking", Pibt { backtracks: false, ..PIBT });
const FIXED: NamedRule<Pibt> = NamedRule::new("fixed priorities", Pibt { rotates: false, ..PIBT });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "pibt",
    title: "PIBT",
    source: "Okumura, Machida, Défago, Tamura, *Priority Inheritance with Backtracking for Iterative Multi-agent Path \
             Finding*, IJCAI 2019, Algorithm 1 and Theorem 1; the reservation as in Artificial Intelligence 310, 2022",
    promises: &[
        promise(
            "PIBT-1",
            "No two robots MUST come into one cell, or change places.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Team>(SMALL, 0), Holds, &[SWAPS]),
                &Check::new(PUBLISHED, &Keeps::<Team>(ANY, 0), Holds, &[SWAPS]),
            ],
        ),
        promise(
            "PIBT-2",
            "Every robot MUST come to its goal at some time, again and again.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Team>(SMALL, 1), Holds, &[FIXED]),
                &Check::new(PUBLISHED, &Keeps::<Team>(DEAD_ENDS, 1), Refuted, &[]),
                &Check::new(ONE_TRY, &Keeps::<Team>(CROWDED, 1), Refuted, &[]),
                &Check::new(FIXED, &Keeps::<Team>(SMALL, 1), Refuted, &[]),
            ],
        )
        .larger(&[
            &Check::new(PUBLISHED, &Keeps::<Team>(CROWDED, 1), Holds, &[ONE_TRY]),
            &Check::new(
                PUBLISHED,
                &Keeps::<Team>(Teams::within(Kind::Biconnected, 3, 3, 3), 1),
                Holds,
                &[FIXED],
            ),
            &Check::new(PUBLISHED, &Keeps::<Team>(FOUR, 1), Holds, &[FIXED]),
        ]),
    ],
};
