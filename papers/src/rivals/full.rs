//! Full search [Kovács 2011, C]: the best of all joint moves. Links are a tree, so there is no order of the robots
//! along which the best could be put together; the joint moves are searched depth first. A branch is cut where the
//! prices of what is chosen, with the least prices of what is left, are more than the best, and where a robot can no
//! longer be joined to the base whatever the robots that have not chosen yet do. Both are bounds, so the answer is that
//! of plain enumeration, ties included.

use tautline_grids::chance::Dice;
use tautline_kernel::ground::Step;

use super::joint::{Best, Joint, Score, WORST};
use super::parameters::{Cells, MOST_SEARCHED};

/// Bits of a set of candidates: one for each candidate, and the base's.
const BITS: usize = 64;
const BASE: usize = BITS - 1;
const _: () =
    assert!(5 * (MOST_SEARCHED - 1) < BASE, "the candidates of the largest team have bits of their own");

/// The best joint moves.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct BestMoves {
    /// How good they are.
    pub score: Score,
    /// How many there are.
    pub ties: u64,
    /// One of them, each as likely.
    pub steps: Vec<Step>,
}

/// The best of all joint moves. `None` if there are more robots than [`MOST_SEARCHED`] has.
pub fn best(joint: &Joint, dice: &mut Dice) -> Option<BestMoves> {
    if joint.robots.len() >= MOST_SEARCHED {
        return None;
    }
    let space = Space::new(joint);
    // Where the team could stay without fault, nothing worse is of interest.
    let within = joint.staying().unwrap_or(WORST);
    let mut search = Search { space: &space, best: Best::within(within), dice };
    search.descend(0, Branch { alive: space.all, chosen: 0, score: Score { faults: 0, price: 0 } });
    let Search { best, .. } = search;
    let (score, ties) = (best.score(), best.ties());
    let set = best.chosen()?;
    let steps = space.groups.iter().map(|&group| {
        let place = (set & group).trailing_zeros() as usize;
        space.steps[place % BITS]
    });
    Some(BestMoves { score, ties, steps: steps.collect() })
}

/// All candidates as bits, those of a robot side by side, the cheapest lowest.
struct Space {
    /// The candidates of each robot.
    groups: Vec<u64>,
    all: u64,
    /// By candidate: those that have a link with it, the base among them.
    linked: [u64; BITS],
    /// By candidate: those of other robots in the same cell outside the base, if that is a fault.
    clashes: [u64; BITS],
    prices: [i64; BITS],
    steps: [Step; BITS],
}

impl Space {
    fn new(joint: &Joint) -> Self {
        let circle = joint.links.circle();
        let listed: Vec<_> = (0..)
            .zip(&joint.robots)
            .flat_map(|(robot, candidates)| candidates.iter().map(move |&candidate| (robot, candidate)))
            .collect();
        let mut space = Self {
            groups: vec![0; joint.robots.len()],
            all: 0,
            linked: [0; BITS],
            clashes: [0; BITS],
            prices: [0; BITS],
            steps: [Step::Stay; BITS],
        };
        for (place, &(robot, candidate)) in listed.iter().enumerate() {
            let bit = 1_u64 << place;
            space.groups[robot] |= bit;
            space.all |= bit;
            space.prices[place] = candidate.price;
            space.steps[place] = candidate.step;
            if circle.covers(joint.base, candidate.to) {
                space.linked[place] |= 1 << BASE;
                space.linked[BASE] |= bit;
            }
            for (other, &(_, that)) in listed.iter().enumerate().filter(|(_, (whose, _))| *whose != robot) {
                if circle.covers(candidate.to, that.to) {
                    space.linked[place] |= 1 << other;
                }
                let is_shared = candidate.to == that.to && candidate.to != joint.base;
                if is_shared && joint.cells == Cells::Distinct {
                    space.clashes[place] |= 1 << other;
                }
            }
        }
        space
    }

    /// The candidates among `alive` that links join to the base, if all of them were taken at once.
    fn joined(&self, alive: u64) -> u64 {
        let mut joined = 0;
        let mut fresh = self.linked[BASE] & alive;
        while fresh != 0 {
            joined |= fresh;
            let mut next = 0;
            while fresh != 0 {
                next |= self.linked[fresh.trailing_zeros() as usize];
                fresh &= fresh - 1;
            }
            fresh = next & alive & !joined;
        }
        joined
    }
}

/// A part of the joint moves: what the first robots have chosen, and what the others still can.
#[derive(Clone, Copy)]
struct Branch {
    alive: u64,
    chosen: u64,
    /// Robots that share a cell so far, and the prices of what is chosen.
    score: Score,
}

struct Search<'a> {
    space: &'a Space,
    best: Best<u64>,
    dice: &'a mut Dice,
}

impl Search<'_> {
    fn descend(&mut self, robot: usize, branch: Branch) {
        let space = self.space;
        let Branch { mut alive, chosen, score } = branch;
        let joined = space.joined(alive);
        let lost = space.groups.iter().filter(|&&group| joined & group == 0).count() as u32;
        let faults = score.faults + lost;
        if faults > self.best.score().faults {
            return;
        }
        if self.best.score().faults == 0 {
            alive &= joined;
        }
        let rest = space.groups.get(robot..).unwrap_or_default();
        let least: i64 =
            rest.iter().map(|group| space.prices[(alive & group).trailing_zeros() as usize % BITS]).sum();
        if (Score { faults, price: score.price + least }) > self.best.score() {
            return;
        }
        let Some(&group) = rest.first() else {
            self.best.meet(Score { faults, ..score }, || chosen, self.dice);
            return;
        };
        let mut left = alive & group;
        while left != 0 {
            let place = left.trailing_zeros() as usize;
            let bit = 1_u64 << place;
            left &= left - 1;
            let shared = u32::from(space.clashes[place] & chosen != 0);
            let mut alive = alive & !group | bit;
            if self.best.score().faults == 0 {
                if shared > 0 {
                    continue;
                }
                alive &= !space.clashes[place];
            }
            let price = score.price + space.prices[place];
            let score = Score { faults: score.faults + shared, price };
            self.descend(robot + 1, Branch { alive, chosen: chosen | bit, score });
        }
    }
}
