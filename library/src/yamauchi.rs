//! Frontier-based exploration by several robots: Yamauchi (Agents 1998). Each robot goes to the frontier that is
//! nearest to it; robots share a map, and do not coordinate, so that two may go to one frontier. With reservations, a
//! frontier is one robot's until it is no frontier any more: nobody goes in vain, but two robots may want past each
//! other. With a way round, ways lead round other robots, and a frontier that cannot be reached is given up.

use tautline_proofs::protocol::{Exploration, Explorers, Team};

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy)]
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
        let own =
            team.targets[robot].filter(|&own| team.map.is_frontier(own) && self.reserves && can_reach(own));
        let is_free = |&cell: &u8| {
            let is_taken = |(other, &target): (usize, &Option<u8>)| other != robot && target == Some(cell);
            can_reach(cell) && !(self.reserves && team.targets.iter().enumerate().any(is_taken))
        };
        let far = |&cell: &u8| {
            if self.is_near { steps[usize::from(cell)] } else { u8::MAX - steps[usize::from(cell)] }
        };
        own.or_else(|| team.map.frontiers().filter(is_free).min_by_key(far))
    }

    fn goes_round(&self) -> bool {
        self.goes_round
    }
}

const fn crew(robots: usize, width: i16, height: i16) -> Crew {
    Crew { robots, graphs: Graphs::within(Kind::Connected, width, height) }
}

const RULE: Yamauchi = Yamauchi { reserves: false, goes_round: false, is_near: true };

entry! { Exploration<Yamauchi>: "yamauchi", "frontier-based exploration", "EXPLORE",
    "Yamauchi, *Frontier-Based Exploration Using Multiple Robots*, Agents 1998";
    PUBLISHED = "published", Exploration(RULE);
    FAR = "farthest", Exploration(Yamauchi { is_near: false, ..RULE });
    RESERVES = "with reservations", Exploration(Yamauchi { reserves: true, ..RULE });
    ROUND = "with a way round", Exploration(Yamauchi { reserves: true, goes_round: true, ..RULE });
    1: "Every cell MUST come onto the map." {
        Holds PUBLISHED within crew(2, 3, 3), not FAR;
        Refuted RESERVES within crew(2, 3, 3);
        Holds ROUND within crew(2, 3, 3), not RESERVES;
    } larger {
        Holds PUBLISHED within crew(3, 4, 3);
        Holds ROUND within crew(3, 4, 3);
    }
    2: "No two robots MUST set out for one frontier: a demand of ours." {
        Refuted PUBLISHED within crew(2, 3, 3);
        Holds ROUND within crew(2, 3, 3), not PUBLISHED;
    }
}
