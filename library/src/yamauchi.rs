//! Frontier-based exploration by several robots: Yamauchi (Agents 1998). Each robot goes to the frontier that is
//! nearest to it; robots share a map, and do not coordinate, so that two may go to one frontier. With reservations, a
//! frontier is one robot's until it is no frontier any more: nobody goes in vain, but two robots may want past each
//! other. With a way round, ways lead round other robots, and a frontier that cannot be reached is given up.

use crate::frontiers::{Crew, Exploration, Explorers, Team};
use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Yamauchi {
    /// A robot keeps its frontier, and leaves those of others alone.
    reserves: bool,
    /// Ways lead round other robots.
    goes_round: bool,
    /// A robot goes to the nearest frontier, and not to the farthest.
    is_near: bool,
}

impl Explorers for Yamauchi {
    fn target(&self, team: &Team<'_>, robot: usize) -> Option<u8> {
        let steps = team.steps(team.cells[robot]);
        let can_reach = |cell: u8| steps[usize::from(cell)] != u8::MAX;
        let own = team.targets[robot].filter(|&own| team.is_frontier(own) && self.reserves && can_reach(own));
        let is_free = |&cell: &u8| {
            let is_taken = |(other, &target): (usize, &Option<u8>)| other != robot && target == Some(cell);
            can_reach(cell) && !(self.reserves && team.targets.iter().enumerate().any(is_taken))
        };
        let far = |&cell: &u8| {
            if self.is_near { steps[usize::from(cell)] } else { u8::MAX - steps[usize::from(cell)] }
        };
        own.or_else(|| team.frontiers().filter(is_free).min_by_key(far))
    }

    fn goes_round(&self) -> bool {
        self.goes_round
    }
}

const fn crew(robots: usize, width: i16, height: i16) -> Crew {
    Crew(Teams::within(Kind::Connected, width, height, robots))
}

const RULE: Yamauchi = Yamauchi { reserves: false, goes_round: false, is_near: true };
const PUBLISHED: NamedRule<Yamauchi> = NamedRule::new("published", RULE);
const FAR: NamedRule<Yamauchi> = NamedRule::new("farthest", Yamauchi { is_near: false, ..RULE });
const RESERVES: NamedRule<Yamauchi> =
    NamedRule::new("with reservations", Yamauchi { reserves: true, ..RULE });
const ROUND: NamedRule<Yamauchi> =
    NamedRule::new("with a way round", Yamauchi { reserves: true, goes_round: true, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "yamauchi",
    title: "frontier-based exploration",
    source: "Yamauchi, *Frontier-Based Exploration Using Multiple Robots*, Agents 1998",
    promises: &[
        promise(
            "EXPLORE-1",
            "Every cell MUST come onto the map.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Exploration<Yamauchi>>(crew(2, 3, 3), 1), Holds, &[FAR]),
                &Check::new(RESERVES, &Keeps::<Exploration<Yamauchi>>(crew(2, 3, 3), 1), Refuted, &[]),
                &Check::new(ROUND, &Keeps::<Exploration<Yamauchi>>(crew(2, 3, 3), 1), Holds, &[RESERVES]),
            ],
        )
        .larger(&[
            &Check::new(PUBLISHED, &Keeps::<Exploration<Yamauchi>>(crew(3, 4, 3), 1), Holds, &[]),
            &Check::new(ROUND, &Keeps::<Exploration<Yamauchi>>(crew(3, 4, 3), 1), Holds, &[]),
        ]),
        promise(
            "EXPLORE-2",
            "No two robots MUST set out for one frontier.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Exploration<Yamauchi>>(crew(2, 3, 3), 2), Refuted, &[]),
                &Check::new(ROUND, &Keeps::<Exploration<Yamauchi>>(crew(2, 3, 3), 2), Holds, &[PUBLISHED]),
            ],
        ),
    ],
};
