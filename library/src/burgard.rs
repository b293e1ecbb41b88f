//! Coordinated exploration: Burgard, Moors, Fox, Simmons and Thrun (ICRA 2000; IEEE Transactions on Robotics 21, 2005,
//! Algorithm 1). Frontiers have a utility, and robots a cost to each, the way there. Again and again the pair of robot
//! and frontier is taken that is worth most, utility less cost; the utility of frontiers nearby goes down by how likely
//! they are seen from the one that is taken. All assignments are made anew in every step.

use crate::frontiers::{Crew, Exploration, Explorers, Team};
use crate::prelude::*;

/// The weight of the utility against one step of the way, and how far a robot sees at its frontier.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Burgard {
    weight: i32,
    range: i32,
    /// A long way costs more than a short one.
    is_near: bool,
}

impl Explorers for Burgard {
    fn target(&self, team: &Team<'_>, robot: usize) -> Option<u8> {
        let frontiers: Vec<u8> = team.frontiers().collect();
        let costs: Vec<Vec<u8>> = team.cells.iter().map(|&cell| team.steps(cell)).collect();
        let mut utility = vec![self.weight * self.range; frontiers.len()];
        let mut left: Vec<usize> = (0..team.cells.len()).collect();
        while !left.is_empty() {
            let pairs = left.iter().flat_map(|&one| (0..frontiers.len()).map(move |place| (one, place)));
            let reached = pairs.filter(|&(one, place)| costs[one][usize::from(frontiers[place])] != u8::MAX);
            let value = |&(one, place): &(usize, usize)| {
                let cost = i32::from(costs[one][usize::from(frontiers[place])]);
                let cost = if self.is_near { cost } else { -cost };
                (cost - utility[place], one, place)
            };
            let (one, place) = reached.min_by_key(value)?;
            if one == robot {
                return Some(frontiers[place]);
            }
            left.retain(|&other| other != one);
            for (other, utility) in frontiers.iter().zip(&mut utility) {
                let apart = i32::from(team.graph.steps(frontiers[place], *other));
                *utility -= self.weight * (self.range - apart).max(0);
            }
        }
        None
    }
}

const CREW: Crew = Crew(Teams::within(Kind::Connected, 3, 3, 2));
const RULE: Burgard = Burgard { weight: 1, range: 2, is_near: true };
const PUBLISHED: NamedRule<Burgard> = NamedRule::new("published", RULE);
const FAR: NamedRule<Burgard> = NamedRule::new("farthest", Burgard { is_near: false, ..RULE });
const NO_COST: NamedRule<Burgard> = NamedRule::new("hardly any cost", Burgard { weight: 100, ..RULE });
const GREEDY: NamedRule<Burgard> = NamedRule::new("utility stays", Burgard { range: 0, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "burgard",
    title: "coordinated exploration",
    source: "Burgard, Moors, Stachniss, Schneider, *Coordinated Multi-Robot Exploration*, IEEE Transactions on \
             Robotics 21, 2005, Algorithm 1",
    promises: &[
        promise(
            "ASSIGN-1",
            "Every cell MUST come onto the map.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Exploration<Burgard>>(CREW, 1), Holds, &[FAR]),
                &Check::new(NO_COST, &Keeps::<Exploration<Burgard>>(CREW, 1), Holds, &[FAR]),
            ],
        ),
        promise(
            "ASSIGN-2",
            "No two robots MUST set out for one frontier.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Exploration<Burgard>>(CREW, 2), Refuted, &[]),
                &Check::new(GREEDY, &Keeps::<Exploration<Burgard>>(CREW, 2), Refuted, &[]),
            ],
        ),
    ],
};
