//! The violations of each clause: a move, or the end of a run.

use std::collections::HashSet;

use super::court::Court;
use super::judge_input::Move;
use super::place::{Place, SIDES, add, is_covered, side_between};

/// The violation of the clause with this id, if the judge knows it.
pub(super) fn broken(clause: &str) -> Option<Violation> {
    Some(match clause {
        "CHAIN-1" => Violation::ByMove(|_, made| contact_is_lost(&made.places)),
        "CHAIN-2" => Violation::ByMove(|_, made| cell_is_crowded(&made.places)),
        "CHAIN-3" => Violation::ByMove(|court, made| range_is_left(&court.places, &made.places)),
        "CHAIN-13" => Violation::AtEnd(|court| Ok(misses_within_reach(court))),
        "CHAIN-19" => Violation::ByMove(|court, made| order_loses_contact(&court.places, &made.places)),
        "CHAIN-27" => Violation::ByMove(|court, made| robots_meet(&court.places, made)),
        "CHAIN-28" => Violation::ByMove(|court, made| robots_exchange(&court.places, &made.places)),
        "CHAIN-14" => Violation::AtEnd(|court| misses_reachable(court, MOST_CONFIGURATIONS)),
        _ => return None,
    })
}

/// A violation of a clause.
#[derive(Clone, Copy)]
pub(super) enum Violation {
    ByMove(fn(&Court<'_>, &Move) -> bool),
    AtEnd(fn(&Court<'_>) -> Result<bool, &'static str>),
}

/// Places of all robots that the judge looks at to say what a chain can reach.
const MOST_CONFIGURATIONS: usize = 1_000_000;

/// CHAIN-1
fn contact_is_lost(after: &[Place]) -> bool {
    after.windows(2).any(|pair| !is_covered(pair[0], pair[1]))
}

/// CHAIN-2
fn cell_is_crowded(after: &[Place]) -> bool {
    after.iter().any(|place| *place != after[0] && after.iter().filter(|other| *other == place).count() > 2)
}

/// CHAIN-3: four times the squared distance is above 26 for some pair of ends.
fn range_is_left(before: &[Place], after: &[Place]) -> bool {
    let is_far = |one: Place, other: Place| {
        let (dx, dy) = (one.0 - other.0, one.1 - other.1);
        4 * (dx * dx + dy * dy) > 26
    };
    (1..after.len()).any(|robot| {
        [before[robot], after[robot]].into_iter().any(|ahead| {
            [before[robot - 1], after[robot - 1]].into_iter().any(|behind| is_far(ahead, behind))
        })
    })
}

/// CHAIN-27: two robots come together outside the base, and neither is blocked.
fn robots_meet(before: &[Place], made: &Move) -> bool {
    let after = &made.places;
    let passed: Vec<usize> = (1..after.len()).filter(|&robot| !made.blocked[robot]).collect();
    let meet = |one: usize, other: usize| {
        let is_entered = before[one] != after[one] || before[other] != after[other];
        one < other && after[one] == after[other] && after[one] != after[0] && is_entered
    };
    passed.iter().any(|&one| passed.iter().any(|&other| meet(one, other)))
}

/// CHAIN-28: two robots go to where the other one was, outside the base.
fn robots_exchange(before: &[Place], after: &[Place]) -> bool {
    let ways = || before.iter().zip(after).filter(|(from, to)| from != to);
    let mut outside = ways().filter(|(from, to)| **from != after[0] && **to != after[0]);
    outside.any(|(from, to)| ways().any(|way| way == (to, from)))
}

/// CHAIN-19: some two neighbours lose contact when each of them has gone or not yet.
fn order_loses_contact(before: &[Place], after: &[Place]) -> bool {
    let both = |robot: usize| [before[robot], after[robot]];
    (1..after.len()).any(|ahead| {
        let pairs = both(ahead - 1).into_iter().flat_map(|one| both(ahead).map(|other| (one, other)));
        pairs.into_iter().any(|(one, other)| !is_covered(one, other))
    })
}

/// CHAIN-13: some place at most N−1 links from the base was never explored.
fn misses_within_reach(court: &Court<'_>) -> bool {
    let within_reach = court.input.within_reach(|side| court.input.is_open(side));
    !within_reach.is_subset(&court.explored)
}

/// CHAIN-14: a team that knows the layout, and tries no wall, can bring a robot to a place that was never explored. It
/// is said if there are at most so many configurations.
fn misses_reachable(court: &Court<'_>, most: usize) -> Result<bool, &'static str> {
    let start = vec![court.input.base; court.input.robots];
    // One who knows all sides: nobody is unsure, and no wall is planned to be crossed.
    let mut informed = court.clone();
    for place in court.input.inside() {
        for step in [(1, 0), (0, 1)] {
            let side = side_between(place, add(place, step));
            let known = if court.input.is_open(side) { &mut informed.open } else { &mut informed.walls };
            known.insert(side);
        }
    }
    let mut seen = HashSet::from([start.clone()]);
    let mut left = vec![start];
    while let Some(places) = left.pop() {
        if places.iter().any(|place| !court.explored.contains(place)) {
            return Ok(true);
        }
        informed.places = places;
        informed.configurations(&mut vec![(0, 0)], &mut |next| {
            if seen.insert(next.clone()) {
                left.push(next);
            }
        });
        if seen.len() > most {
            return Err("the robots have too many places for the judge to say what they can reach");
        }
    }
    Ok(false)
}

impl Court<'_> {
    /// The places of all robots after each team move that is admitted and begins with the steps `tried`, base first.
    fn configurations(&self, tried: &mut Vec<Place>, sink: &mut dyn FnMut(Vec<Place>)) {
        let robot = tried.len();
        let planned: Vec<Place> = tried.iter().zip(&self.places).map(|(&step, &at)| add(at, step)).collect();
        if robot == self.input.robots {
            return sink(planned);
        }
        for step in SIDES.into_iter().chain([(0, 0)]) {
            let to = add(self.places[robot], step);
            let is_taken = to != self.input.base && planned[1..].contains(&to);
            if !is_taken
                && self.admits_step(robot, step).is_ok()
                && self.admits_pair(robot, step, planned[robot - 1]).is_ok()
            {
                tried.push(step);
                self.configurations(tried, sink);
                tried.pop();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::judge::chain::judge_input::{JudgeInput, Repairs};

    /// A layout without walls, its base in the middle.
    fn input(width: i32, height: i32, robots: usize) -> JudgeInput {
        JudgeInput::open("", Repairs::With, (width, height), (width / 2, height / 2), robots)
    }

    #[test]
    fn the_judge_looks_at_so_many_configurations_and_no_more() {
        // In the base, one cell to the east, and one to the west.
        let input = input(3, 1, 2);
        let mut court = Court::new(&input, 2);
        court.explored = input.inside().collect();
        assert_eq!([3, 4].map(|most| misses_reachable(&court, most)), [Ok(false); 2]);
        assert!([1, 2].iter().all(|&most| misses_reachable(&court, most).is_err()));
        court.explored.remove(&(0, 0));
        assert_eq!(misses_reachable(&court, 3), Ok(true));
    }

    #[test]
    fn the_configurations_that_follow_are_those_of_the_moves_that_the_court_admits() {
        let places = || (0..3).flat_map(|x| (0..3).map(move |y| (x, y)));
        for repairs in [Repairs::Without, Repairs::With] {
            let input = JudgeInput { repairs, ..input(3, 3, 3) };
            let mut court = Court::new(&input, 3);
            court.walls.insert(((1, 1), (1, 2)));
            court.open.extend([((0, 1), (1, 1)), ((1, 1), (2, 1)), ((1, 0), (1, 1))]);
            for (one, other) in places().flat_map(|one| places().map(move |other| (one, other))) {
                court.places = vec![input.base, one, other];
                let mut found = BTreeSet::new();
                court.configurations(&mut vec![(0, 0)], &mut |next| {
                    found.insert(next);
                });
                let steps = || SIDES.into_iter().chain([(0, 0)]);
                let moves = steps().flat_map(|first| steps().map(move |last| [(0, 0), first, last]));
                let targets = moves.filter_map(|tried| {
                    let to = tried.iter().zip(&court.places).map(|(&step, &at)| add(at, step)).collect();
                    court.admits(&tried).is_ok().then_some(to)
                });
                assert_eq!(found, targets.collect(), "{repairs:?} {:?}", court.places);
            }
        }
    }

    #[test]
    fn centres_of_neighbours_more_than_half_the_root_of_26_apart_at_any_two_ends_break_chain_3() {
        let base = (1, -1);
        for (x, y) in (-4..=4).flat_map(|x| (-4..=4).map(move |y| (x, y))) {
            let is_far = 4 * (x * x + y * y) > 26;
            let off = add(base, (x, y));
            let still = [base; 2];
            let pairs = [[base, off], [off, base]].map(|gone| [(gone, still), (still, gone)]);
            for (before, after) in pairs.into_iter().flatten() {
                assert_eq!(range_is_left(&before, &after), is_far, "{before:?} {after:?}");
                // A third robot beside either of them, and a fourth that stays with it.
                let beside = |team: [Place; 2]| [team[0], team[0], team[1], team[1]];
                assert_eq!(range_is_left(&beside(before), &beside(after)), is_far, "{before:?} {after:?}");
            }
            // One end before the move, the other after it: each robot goes half of the way.
            let half = add(base, (x / 2, y / 2));
            let crossing = range_is_left(&[base, half], &[half, off]);
            let are_near = [(base, half), (half, off), (base, off), (half, half)];
            let square = |(one, other): &(Place, Place)| (one.0 - other.0).pow(2) + (one.1 - other.1).pow(2);
            let any_far = are_near.iter().any(|pair| 4 * square(pair) > 26);
            assert_eq!(crossing, any_far, "{half:?} {off:?}");
        }
    }
}
