//! Coordinated exploration: Burgard, Moors, Fox, Simmons and Thrun (ICRA 2000; IEEE Transactions on Robotics 21, 2005,
//! Algorithm 1). Frontiers have a utility, and robots a cost to each, the way there. Again and again the pair of robot
//! and frontier is taken that is worth most, utility less cost; the utility of frontiers nearby goes down by how likely
//! they are seen from the one that is taken. All assignments are made anew in every step.

use tautline_proofs::protocol::{Exploration, Explorers, Team};

use crate::prelude::*;

/// The weight of the utility against one step of the way, and how far a robot sees at its frontier.
#[derive(Clone, Copy)]
struct Burgard {
    weight: i32,
    range: i32,
    /// A long way costs more than a short one.
    is_near: bool,
}

impl Explorers for Burgard {
    fn target(&self, team: &Team<'_>, robot: usize) -> Option<u8> {
        let frontiers: Vec<u8> = team.map.frontiers().collect();
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
                let apart = i32::from(team.map.graph.steps(frontiers[place], *other));
                *utility -= self.weight * (self.range - apart).max(0);
            }
        }
        None
    }
}

const CREW: Crew = Crew { robots: 2, graphs: Graphs::within(Kind::Connected, 3, 3) };
const RULE: Burgard = Burgard { weight: 1, range: 2, is_near: true };

entry! { Exploration<Burgard>: "burgard", "coordinated exploration", "ASSIGN",
    "Burgard, Moors, Stachniss, Schneider, *Coordinated Multi-Robot Exploration*, IEEE Transactions on Robotics 21, \
     2005, Algorithm 1";
    PUBLISHED = "published", Exploration(RULE);
    FAR = "farthest", Exploration(Burgard { is_near: false, ..RULE });
    NO_COST = "hardly any cost", Exploration(Burgard { weight: 100, ..RULE });
    GREEDY = "utility stays", Exploration(Burgard { range: 0, ..RULE });
    1: "Every cell MUST come onto the map." {
        Holds PUBLISHED within CREW, not FAR;
        Holds NO_COST within CREW, not FAR;
    }
    2: "No two robots MUST set out for one frontier: a demand of ours." {
        Refuted PUBLISHED within CREW;
        Refuted GREEDY within CREW;
    }
}
