//! The team's next duty by its rule: the leader's priorities, followed out by all that the others could do.

use std::collections::{BTreeSet, VecDeque};

use super::court::Court;
use super::judge_input::{Move, Repairs};
use super::place::{Place, SIDES, add, is_covered, side_between};

/// The team's next duty.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Duty {
    /// To advance, the leader by this step.
    Lead(Place),
    /// To advance, since the chain unfolds.
    Unfold,
    /// To take the latest open move back.
    TakeBack,
    /// The run is over.
    Nothing,
}

impl Duty {
    pub(super) fn is_done_by(self, made: &Move) -> Result<(), &'static str> {
        match self {
            Self::Nothing => Err("the run is over before this move"),
            Self::TakeBack if !made.is_backtrack => {
                Err("the leader has no way on: the team takes a move back")
            }
            Self::Lead(_) | Self::Unfold if made.is_backtrack => {
                Err("the leader has a way on: the team takes no move back")
            }
            Self::Lead(step) if made.tried.last() != Some(&step) => {
                Err("the leader has a candidate that comes first")
            }
            Self::Lead(_) | Self::Unfold | Self::TakeBack => Ok(()),
        }
    }
}

/// Robots of which the judge looks at everything that they could do behind a leader.
pub(super) const MOST_LED: usize = 12;

/// Ways of followers that the judge looks at for one step of the leader.
const MOST_LOOKS: u32 = 1_000_000;

impl Court<'_> {
    /// The team's next duty, by the rule; new virtual obstacles and epochs are noted.
    pub(super) fn duty(&mut self) -> Result<Duty, &'static str> {
        if self.input.inside().all(|place| self.explored.contains(&place)) {
            return Ok(Duty::Nothing);
        }
        let is_target = self.input.repairs == Repairs::With
            && !self.input.within_reach(|side| !self.is_known_wall(side)).is_subset(&self.explored);
        for is_fresh in [false, true] {
            if self.unfolds && !self.gained && is_target {
                return Ok(Duty::Unfold);
            }
            if let Some(step) = self.lead()? {
                return Ok(Duty::Lead(step));
            }
            if !self.history.is_empty() {
                return Ok(Duty::TakeBack);
            }
            let unfolds = !is_fresh && is_target;
            if !self.gained && !unfolds {
                break;
            }
            (self.gained, self.unfolds) = (false, unfolds);
            self.refused.clear();
        }
        Ok(Duty::Nothing)
    }

    /// The step of the leader that its rule chooses: of its candidates the first that the others can follow.
    fn lead(&mut self) -> Result<Option<Place>, &'static str> {
        let leader = self.places.len() - 1;
        let (at, base) = (self.places[leader], self.input.base);
        let mut list: Vec<(u32, i32, Place)> = SIDES
            .into_iter()
            .filter(|&step| !self.is_shut(self.side(leader, step)))
            .filter_map(|step| {
                let outward = step.0 * (at.0 - base.0) + step.1 * (at.1 - base.1);
                Some((self.distance(add(at, step), |side| self.is_shut(side))?, -outward, step))
            })
            .collect();
        // A stable sort: direction settles what is left.
        list.sort_by_key(|&(distance, inward, _)| (distance, inward));
        let mut candidates = Vec::new();
        for (_, _, step) in list {
            let side = self.side(leader, step);
            let is_covered = is_covered(self.places[leader - 1], add(at, step));
            if !is_covered {
                self.refused.insert(side);
            }
            candidates.push((side, if is_covered { step } else { (0, 0) }));
        }
        for (side, step) in candidates {
            let mut tried = vec![(0, 0); leader + 1];
            tried[leader] = step;
            let is_admitted = self.admits_step(leader, step).is_ok();
            if is_admitted && self.can_follow(&mut tried, leader, &mut MOST_LOOKS.clone())? {
                return Ok(Some(step));
            }
            self.refused.insert(side);
        }
        Ok(None)
    }

    /// Whether the robots behind `robot` have steps that are admitted with those of `tried` from it on.
    fn can_follow(&self, tried: &mut [Place], robot: usize, looks: &mut u32) -> Result<bool, &'static str> {
        let behind = robot - 1;
        if behind == 0 {
            return Ok(self.admits_pair(robot, tried[robot], self.input.base).is_ok());
        }
        for step in SIDES.into_iter().chain([(0, 0)]) {
            *looks = looks.checked_sub(1).ok_or("followers have too many ways for the judge to look at")?;
            let planned = add(self.places[behind], step);
            let is_taken = planned != self.input.base
                && (robot..tried.len()).any(|ahead| add(self.places[ahead], tried[ahead]) == planned);
            if is_taken
                || self.admits_step(behind, step).is_err()
                || self.admits_pair(robot, tried[robot], planned).is_err()
            {
                continue;
            }
            tried[behind] = step;
            if self.can_follow(tried, behind, looks)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The steps of all robots in the open, base first, if the leader makes `step`. Followers stay where that is in E_N
    /// of the planned place ahead, else go there, else nearer to what is unexplored, and then in direction order.
    pub(super) fn plan(&self, step: Place) -> Option<Vec<Place>> {
        let leader = self.places.len() - 1;
        let mut tried = vec![(0, 0); leader + 1];
        tried[leader] = step;
        self.follow(&mut tried, leader).then_some(tried)
    }

    /// Whether the robots behind `robot` can follow, by the first of their steps that let the others follow.
    fn follow(&self, tried: &mut [Place], robot: usize) -> bool {
        let (behind, ahead) = (robot - 1, add(self.places[robot], tried[robot]));
        if behind == 0 {
            return self.admits_pair(robot, tried[robot], self.input.base).is_ok();
        }
        let mut steps: Vec<Place> = SIDES.into_iter().chain([(0, 0)]).collect();
        steps.sort_by_key(|&step| {
            let to = add(self.places[behind], step);
            let is_high = (to.0 - ahead.0).abs() + (to.1 - ahead.1).abs() <= 1;
            let distance = self.distance(to, |side| self.is_known_wall(side)).unwrap_or(u32::MAX);
            (!(is_high && step == (0, 0)), !is_high, distance)
        });
        steps.into_iter().any(|step| {
            let planned = add(self.places[behind], step);
            let mut others = (robot..tried.len()).map(|other| add(self.places[other], tried[other]));
            let is_taken = planned != self.input.base && others.any(|other| other == planned);
            if is_taken
                || self.admits_step(behind, step).is_err()
                || self.admits_pair(robot, tried[robot], planned).is_err()
            {
                return false;
            }
            tried[behind] = step;
            self.follow(tried, behind)
        })
    }

    /// Steps from `from` to the nearest unexplored place, over sides that are not shut.
    fn distance(&self, from: Place, is_shut: impl Fn((Place, Place)) -> bool) -> Option<u32> {
        let mut seen = BTreeSet::from([from]);
        let mut queue = VecDeque::from([(from, 0)]);
        while let Some((place, steps)) = queue.pop_front() {
            if !self.explored.contains(&place) {
                return Some(steps);
            }
            for step in SIDES {
                let next = add(place, step);
                if !is_shut(side_between(place, next)) && seen.insert(next) {
                    queue.push_back((next, steps + 1));
                }
            }
        }
        None
    }

    /// Whether the leader does not cross a side in this epoch.
    fn is_shut(&self, side: (Place, Place)) -> bool {
        self.is_known_wall(side) || self.refused.contains(&side)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::chain::judge_input::JudgeInput;

    #[test]
    fn a_chain_unfolds_until_it_has_gained_as_long_as_there_is_something_within_reach() {
        let mut input = JudgeInput::open("", Repairs::With, (5, 5), (2, 2), 3);
        for repairs in [Repairs::With, Repairs::Without] {
            input.repairs = repairs;
            for (unfolds, gained) in [(false, false), (false, true), (true, false), (true, true)] {
                let mut court = Court::new(&input, 3);
                (court.unfolds, court.gained) = (unfolds, gained);
                let is_unfolding = unfolds && !gained && repairs == Repairs::With;
                let expected = if is_unfolding { Duty::Unfold } else { Duty::Lead((1, 0)) };
                assert!(court.duty() == Ok(expected), "{repairs:?} {unfolds} {gained}");
            }
        }
        // Only a corner is left, and its three neighbours are shut off: nothing is within reach.
        let mut court = Court::new(&input, 3);
        court.explored = input.inside().filter(|&place| place != (4, 4)).collect();
        court.walls = BTreeSet::from([((3, 4), (4, 4)), ((4, 3), (4, 4))]);
        (court.unfolds, court.gained) = (true, false);
        assert!(court.duty() == Ok(Duty::Nothing));
    }
}
