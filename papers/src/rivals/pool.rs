//! Rooker and Birk's choice of a team move [Kovács 2011, C]: the best of some that are drawn at random, “possible or
//! impossible”. A joint move in which a robot crosses a side that is known to be a wall is drawn, and then left out.
//! The null move counts with the others, or stands by for the case that all that are drawn have more faults: see
//! [`Null`].

use tautline_grids::chance::Dice;
use tautline_kernel::ground::{Cell, Step};

use super::joint::{Best, Candidate, Joint, WORST};
use super::parameters::Null;

/// The best of a pool of so many joint moves; of those as good each is as likely. A robot has `moves` moves, some of
/// which it may not be able to make. `None` if every joint move that was drawn crosses a wall, and there is no null
/// move.
pub fn best(joint: &Joint, pool: u32, null: Null, moves: &[Step], dice: &mut Dice) -> Option<Vec<Step>> {
    let by_step: Vec<Vec<Option<Candidate>>> = joint
        .robots
        .iter()
        .map(|robot| {
            moves.iter().map(|&step| robot.iter().find(|candidate| candidate.step == step).copied()).collect()
        })
        .collect();
    let mut best: Best<Vec<Step>> = Best::within(WORST);
    let stay = joint.staying();
    if let (Null::Competes, Some(score)) = (null, stay) {
        best.meet(score, || vec![Step::Stay; joint.robots.len()], dice);
    }
    let mut team: Vec<Cell> = Vec::with_capacity(joint.robots.len());
    let mut drawn: Vec<Step> = Vec::with_capacity(joint.robots.len());
    for _ in u32::from(stay.is_some())..pool {
        team.clear();
        drawn.clear();
        let mut price = 0;
        for robot in &by_step {
            if let Some(candidate) = robot[dice.below(moves.len() as u64) as usize] {
                team.push(candidate.to);
                drawn.push(candidate.step);
                price += candidate.price;
            }
        }
        let is_possible = team.len() == by_step.len();
        // No joint move is better than one without faults at the same price.
        if is_possible && (best.score().faults > 0 || price <= best.score().price) {
            best.meet(joint.score(&team, price), || drawn.clone(), dice);
        }
    }
    match stay {
        Some(score) if score.faults < best.score().faults => Some(vec![Step::Stay; joint.robots.len()]),
        Some(_) | None => best.chosen(),
    }
}
