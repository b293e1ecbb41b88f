//! Rooker and Birk's choice of a team move [Kovács 2011, C]: the best of some that are drawn at random, “possible or
//! impossible”. A joint move in which a robot crosses a side that is known to be a wall is drawn, and then left out; the null
//! move is always in the pool.

use rand_chacha::ChaCha8Rng;
use tautline_kernel::ground::{Cell, Step};

use super::joint::{Best, Candidate, Joint, WORST, draw};

/// The best of a pool of so many joint moves, the null move among them if the robots can stay; of those as good each is as
/// likely. A robot has `moves` moves, some of which it may not be able to make. `None` if every joint move that was drawn
/// crosses a wall.
pub fn best(joint: &Joint, pool: u32, moves: &[Step], dice: &mut ChaCha8Rng) -> Option<Vec<Step>> {
    let by_step: Vec<Vec<Option<Candidate>>> = joint
        .robots
        .iter()
        .map(|robot| {
            moves.iter().map(|&step| robot.iter().find(|candidate| candidate.step == step).copied()).collect()
        })
        .collect();
    let mut best: Best<Vec<Step>> = Best::within(WORST);
    let mut team: Vec<Cell> = Vec::with_capacity(joint.robots.len());
    let mut drawn: Vec<Step> = Vec::with_capacity(joint.robots.len());
    let stays = moves.iter().position(|&step| step == Step::Stay);
    for number in 0..pool {
        team.clear();
        drawn.clear();
        let mut price = 0;
        for robot in &by_step {
            let place = match stays.filter(|_| number == 0) {
                Some(place) => place,
                None => draw(dice, moves.len() as u64) as usize,
            };
            if let Some(candidate) = robot[place] {
                team.push(candidate.to);
                drawn.push(candidate.step);
                price += candidate.price;
            }
        }
        let is_possible = team.len() == by_step.len();
        // No joint move is better than one without faults at the same price.
        if is_possible && (best.score.faults > 0 || price <= best.score.price) {
            best.meet(joint.score(&team, price), || drawn.clone(), dice);
        }
    }
    best.chosen()
}
