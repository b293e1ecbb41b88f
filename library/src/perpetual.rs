//! Perpetual exploration of a ring by three robots that are alike and remember nothing: after Blin, Milani,
//! Potop-Butucaru and Tixeuil (DISC 2010), the legitimate phase of their algorithm for the fewest robots. The gaps
//! between the robots are 0, 2 and a large one. The robot ahead goes on (0, 3); the one behind the gap of 3 follows
//! (1, 2); the last one closes up (0, 2). No other robot of such a ring moves, so that the order of looks and moves
//! does not matter. From other starts robots may stand still for ever: the paper has a second phase for them.

use crate::prelude::*;

/// Which of the three moves a robot makes.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is a condition of the rule")]
struct Conditions {
    goes_on: bool,
    follows: bool,
    closes_up: bool,
    /// The robot between the gaps 0 and 2, too, goes on: two robots may move at once.
    is_hasty: bool,
    /// A robot beside another one does not go there.
    keeps_apart: bool,
}

impl Conditions {
    /// The next node of a robot; the one where it is if it stays.
    fn wish(self, ring: &Ring, robots: &[Walker], me: usize) -> u8 {
        let (nodes, here) = (ring.nodes, robots[me].0);
        let gap = |from: u8, to: u8| (to + nodes - from - 1) % nodes;
        let mut others: Vec<u8> = (1..3).map(|by| robots[(me + by) % 3].0).collect();
        others.sort_by_key(|&other| gap(here, other));
        let (right, across, left) = (gap(here, others[0]), gap(others[0], others[1]), gap(others[1], here));
        let (up, down) = (ring.on(here, 1), ring.back(here));
        let far = |steps: u8| steps > 3;
        // The gaps on one side, on the other side, and across: seen from either side.
        for (near, beyond, to_near, to_beyond) in [(right, left, up, down), (left, right, down, up)] {
            match (near, beyond, across) {
                (2, large, 0) if far(large) && self.goes_on => return to_beyond,
                (3, 0, large) if far(large) && self.follows => return to_near,
                (1, large, 2) if far(large) && self.closes_up => return to_near,
                (2, 0, large) if far(large) && self.is_hasty => return to_near,
                (0, 2, large) if far(large) && !self.keeps_apart => return to_near,
                _ => {}
            }
        }
        here
    }
}

impl Protocol for Conditions {
    type Bound = Ring;
    type State = Vec<Walker>;
    demands! {
        always "no two robots are in one node, or change places", |_, _, before, after| {
            let nodes = |robots: &Vec<Walker>| robots.iter().map(|robot| robot.0).collect::<Vec<u8>>();
            !conflicts(&nodes(before), &nodes(after))
        };
        again_and_again "robot 0 visits every node", |_, ring, robots| {
            set((0..ring.nodes).filter(|&node| robots[0].0 != node).map(usize::from))
        };
    }

    fn starts(&self, ring: &Ring) -> impl IntoIterator<Item = Vec<Walker>> {
        ring.starts()
    }

    fn moves(&self, ring: &Ring, robots: &Vec<Walker>) -> Vec<Move<Vec<Walker>>> {
        ring.moves(robots, |me| self.wish(ring, robots, me))
    }

    fn draw(&self, ring: &Ring, robots: &Vec<Walker>) -> String {
        ring.draw(robots)
    }
}

const fn ring(nodes: u8, starts: Start) -> Ring {
    Ring { nodes, robots: 3, starts, moves: Moves::LookThenMove }
}

/// Gaps of 0, 2 and a large one, robot 0 in each of the three places: what holds of it in all of them holds of each
/// robot.
const GAPS: Start = Start::At(&[0, 1, 4]);
const MIDDLE: Start = Start::At(&[1, 4, 0]);
const BEHIND: Start = Start::At(&[4, 0, 1]);
const RULE: Conditions =
    Conditions { goes_on: true, follows: true, closes_up: true, is_hasty: false, keeps_apart: true };

entry! { Conditions: "perpetual", "perpetual exploration of a ring", "RING",
    "after Blin, Milani, Potop-Butucaru, Tixeuil, *Exclusive Perpetual Ring Exploration without Chirality*, DISC \
     2010: its legitimate phase, as we model it";
    PUBLISHED = "legitimate phase", RULE;
    STOPS = "does not close up", Conditions { closes_up: false, ..RULE };
    HASTY = "two at once", Conditions { is_hasty: true, ..RULE };
    CLOSE = "goes to the next robot", Conditions { keeps_apart: false, ..RULE };
    1: "No two robots MUST come into one node, or change places." {
        Holds PUBLISHED within ring(12, Start::Any), not CLOSE;
    }
    2: "Every node MUST be visited again and again, by each robot." {
        Holds PUBLISHED within ring(12, GAPS), not STOPS, HASTY;
        Holds PUBLISHED within ring(12, MIDDLE), not STOPS, HASTY;
        Holds PUBLISHED within ring(12, BEHIND), not STOPS, HASTY;
        Holds PUBLISHED within ring(10, GAPS), not STOPS;
        Holds PUBLISHED within ring(10, MIDDLE), not STOPS;
        Holds PUBLISHED within ring(10, BEHIND), not STOPS;
        Refuted PUBLISHED within ring(9, GAPS);
        Refuted PUBLISHED within ring(10, Start::Any);
    }
}
