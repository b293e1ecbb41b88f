//! Gathering with local vision: Guilbault and Pelc (Theoretical Computer Science 509, 2013), on a ring. Robots are
//! alike, remember nothing, and see the nodes beside theirs. A robot that is alone and sees robots on one side goes
//! there; one that sees them on both sides, or has company, stays. Of all starts, only a *star* gathers: three robots
//! in a row. Two robots change places for ever.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, Debug)]
pub struct Conditions {
    /// A robot in company stays.
    pub counts: bool,
    /// A robot between two others stays.
    pub stays_between: bool,
}

impl Conditions {
    /// The node to which a robot wishes to go.
    fn wish(self, ring: &Ring, robots: &[Walker], me: usize) -> u8 {
        let here = robots[me].0;
        let at = |node: u8| robots.iter().filter(|robot| robot.0 == node).count();
        let (left, right) = (ring.back(here), ring.on(here, 1));
        match (at(left) > 0, at(right) > 0) {
            _ if at(here) > 1 && self.counts => here,
            (true, true) if self.stays_between => here,
            (true, _) => left,
            (_, true) => right,
            (false, false) => here,
        }
    }
}

impl Protocol for Conditions {
    type Bound = Ring;
    type State = Vec<Walker>;
    demands! {
        eventually "all are in one node, and stay", |rule, ring, robots| {
            let is_still = |me: usize| robots[me].1.is_none() && rule.wish(ring, robots, me) == robots[me].0;
            robots.iter().all(|robot| robot.0 == robots[0].0) && (0..robots.len()).all(is_still)
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

/// So many robots in a row, and who acts at once.
pub const fn row(robots: u8, moves: Moves) -> Ring {
    Ring { nodes: 6, robots, starts: Start::InARow, moves }
}

/// The published rule.
pub const RULE: Conditions = Conditions { counts: true, stays_between: true };

entry! { Conditions: "gathering", "gathering with local vision", "GATHER",
    "Guilbault, Pelc, *Gathering Asynchronous Oblivious Agents with Local Vision in Regular Bipartite Graphs*, \
     Theoretical Computer Science 509, 2013";
    PUBLISHED = "published", RULE;
    OUTSIDE = "published outside its premises", RULE;
    BLIND = "does not count", Conditions { counts: false, ..RULE };
    LEAVES = "leaves the middle", Conditions { stays_between: false, ..RULE };
    1: "All robots MUST come into one node, and stay." {
        Holds PUBLISHED within row(3, Moves::LookThenMove), not BLIND, LEAVES;
        Holds PUBLISHED within row(2, Moves::OneAtATime);
        Refuted OUTSIDE within row(2, Moves::Together);
        Refuted OUTSIDE within row(2, Moves::LookThenMove);
        Refuted OUTSIDE within row(4, Moves::LookThenMove);
    }
}
