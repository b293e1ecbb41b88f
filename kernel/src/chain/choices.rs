//! The followers' choices, once a descent from the leader to the base got stuck: which steps are left for each
//! robot. What the paper's recursion finds out by trying everything, over and over, is found out here by striking
//! out: a step that no step of a neighbour in the chain agrees with, and a step into a cell that other robots are
//! sure to need. Where that does not decide, steps are tried, first for the robot whose trial failed last (Lecoutre,
//! Sais, Tabary and Vidal 2009), then for those that were left without a step most often for each step they have
//! left (in the manner of Boussemart, Hemery, Lecoutre and Sais 2004), so that a dead end is left where it began.
//! The plan is that of the recursion: every follower in turn, the leader's neighbour first, takes the first step in
//! its order of preference from which the robots behind it can still close the chain.

use core::cmp::Reverse;

use super::planner::{Looks, Planner};
use super::rule::Condition;
use crate::ground::{Cell, Grid, Step, Steps, steps_to};

/// The steps that are left for each robot, base first.
pub(super) struct Choices<'a, const ROBOTS: usize> {
    /// P_1 … P_N.
    team: &'a [Cell],
    /// Whether two robots may not plan to be in one cell.
    is_distinct: bool,
    left: [Steps; ROBOTS],
    /// The robots with one step left.
    decided: Robots<ROBOTS>,
    /// The robots with more steps left.
    undecided: Robots<ROBOTS>,
    /// By robot and place of its step: the steps of the robot behind that agree with it.
    agreeing: [[Steps; Step::ALL.len()]; ROBOTS],
    /// Whom something was struck out for, and what was left before: to be restored backwards.
    trail: [[(u8, Steps); Step::ALL.len()]; ROBOTS],
    trail_length: usize,
    trials: [Trial; ROBOTS],
    /// A whole plan that begins as the one in the making; no steps before the first is found.
    witness: [Steps; ROBOTS],
    /// How often no step was left for a robot.
    failures: [u32; ROBOTS],
    /// The robot whose trial was the last to leave some robot without a step.
    culprit: usize,
    looks: Looks,
}

/// A step that was tried.
#[derive(Clone, Copy)]
struct Trial {
    robot: u8,
    step: Step,
    /// The length of the trail before it.
    mark: u16,
    turn: Turn,
}

/// Whether a robot's step was tried when it was its turn: once all robots ahead had theirs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Turn {
    Own,
    Early,
}

/// The steps that were struck out and have not been followed up.
struct Wave<const ROBOTS: usize> {
    robots: Robots<ROBOTS>,
    struck: [Steps; ROBOTS],
    /// Whether no step is left for some robot.
    is_over: bool,
}

/// A set of robots.
#[derive(Clone, Copy)]
struct Robots<const ROBOTS: usize>([u64; 4]);

impl<'a, const ROBOTS: usize> Choices<'a, ROBOTS> {
    /// The steps left for every robot, if the leader takes one of the steps in `leads`.
    pub(super) fn new<G: Grid>(planner: &Planner<'a, G, ROBOTS>, leads: Steps) -> Self {
        let leader = planner.team.len() - 1;
        let mut choices = Self {
            team: planner.team,
            is_distinct: planner.rule.has(Condition::Distinct),
            left: [Steps::only(Step::Stay); ROBOTS],
            decided: Robots::NONE,
            undecided: Robots::NONE,
            agreeing: [[Steps::NONE; Step::ALL.len()]; ROBOTS],
            trail: [[(0, Steps::NONE); Step::ALL.len()]; ROBOTS],
            trail_length: 0,
            trials: [Trial { robot: 0, step: Step::Stay, mark: 0, turn: Turn::Own }; ROBOTS],
            witness: [Steps::NONE; ROBOTS],
            failures: [0; ROBOTS],
            culprit: 0,
            looks: planner.looks,
        };
        for robot in 1..=leader {
            let steps = if robot == leader { leads } else { planner.candidates(robot) };
            choices.looks.take(if robot == leader { 0 } else { Steps::ALL.len() });
            let (at, behind) = (planner.team[robot - 1], choices.left[robot - 1]);
            choices.left[robot] = steps.filter(|step| {
                let agreeing = behind.and(planner.rule.steps_ahead(at, planner.as_move(robot, step)));
                choices.agreeing[robot][step.place()] = agreeing;
                !agreeing.is_empty()
            });
        }
        for robot in (1..=leader).rev() {
            let behind = choices.left[robot - 1];
            choices.looks.take(behind.len());
            choices.left[robot - 1] = behind.and(choices.agreeing(robot, choices.left[robot]));
        }
        let mut wave = Wave::NONE;
        for robot in 0..=leader {
            choices.leave_exactly(robot, choices.left[robot]);
            wave.robots.insert(robot);
        }
        if !choices.follow_up(wave) {
            choices.left[leader] = Steps::NONE;
        }
        choices
    }

    /// Plans for all followers behind the leader's step `lead`; false if they cannot follow.
    pub(super) fn follow<G: Grid>(&mut self, planner: &mut Planner<'a, G, ROBOTS>, lead: Step) -> bool {
        let leader = self.team.len() - 1;
        let start = self.trail_length;
        self.witness = [Steps::NONE; ROBOTS];
        let found =
            self.left[leader].has(lead) && self.leave(leader, Steps::only(lead)) && self.decide(planner);
        if found {
            for (step, witness) in planner.steps.iter_mut().zip(self.witness).take(leader) {
                *step = witness.first();
            }
        }
        planner.looks = self.looks;
        self.restore(start);
        found
    }

    /// Makes the witness the plan of the recursion, as far as the budget goes; false if no plan is found.
    fn decide<G: Grid>(&mut self, planner: &mut Planner<'a, G, ROBOTS>) -> bool {
        let Some(trials) = self.complete(planner) else { return false };
        if self.trials[..trials].iter().all(|trial| trial.turn == Turn::Own) {
            return true;
        }
        self.take_back(trials);
        for robot in (1..self.team.len() - 1).rev() {
            while self.left[robot].len() > 1 && !self.looks.is_over {
                let step = self.preferred(planner, robot);
                let mark = self.trail_length;
                let fits = self.leave(robot, Steps::only(step))
                    && (self.witness[robot].has(step)
                        || self.complete(planner).inspect(|&trials| self.take_back(trials)).is_some());
                if !fits {
                    self.restore(mark);
                    self.leave(robot, self.left[robot].without(step));
                }
            }
        }
        true
    }

    /// Seeks a plan within what is left; the number of trials it rests on, if there is one. It is the new witness:
    /// where the old one is still possible it stays, as its steps agree with each other.
    fn complete<G: Grid>(&mut self, planner: &mut Planner<'a, G, ROBOTS>) -> Option<usize> {
        let mut trials = 0;
        while let Some((robot, turn)) = self.next() {
            let step = self.preferred(planner, robot);
            self.trials[trials] = Trial { robot: robot as u8, step, mark: self.trail_length as u16, turn };
            trials += 1;
            let mut fits = self.leave(robot, Steps::only(step));
            if !fits {
                self.culprit = robot;
            }
            while !fits {
                trials = trials.checked_sub(1)?;
                let Trial { robot, step, mark, turn: _ } = self.trials[trials];
                let robot = usize::from(robot);
                self.restore(usize::from(mark));
                fits = self.leave(robot, self.left[robot].without(step));
            }
        }
        for (witness, left) in self.witness.iter_mut().zip(self.left) {
            *witness = if witness.and(left).is_empty() { left } else { witness.and(left) };
        }
        Some(trials)
    }

    /// Takes the latest `trials` back, but not what was learned before the first of them.
    fn take_back(&mut self, trials: usize) {
        if trials > 0 {
            self.restore(usize::from(self.trials[0].mark));
        }
    }

    /// The robot to try a step for, as long as there are some that are undecided and that the witness does not help:
    /// the culprit, even if the witness helps it, or else that one of them that failed most often for each step it has
    /// left; in doubt the nearest to the leader.
    fn next(&self) -> Option<(usize, Turn)> {
        let undecided = self.undecided.iter();
        let mut lost = undecided.filter(|&robot| self.left[robot].and(self.witness[robot]).is_empty());
        let first = lost.next()?;
        let urgency =
            |robot: usize| Reverse(FAILURE.saturating_mul(self.failures[robot]) / self.left[robot].len());
        let urgent = if self.undecided.has(self.culprit) {
            self.culprit
        } else {
            // Who never failed is no more urgent than the first.
            let failed = lost.filter(|&robot| self.failures[robot] > 0);
            failed.fold(first, |best, robot| if urgency(robot) < urgency(best) { robot } else { best })
        };
        Some((urgent, if urgent == first { Turn::Own } else { Turn::Early }))
    }

    fn preferred<G: Grid>(&self, planner: &mut Planner<'a, G, ROBOTS>, robot: usize) -> Step {
        let ahead = planner.as_move(robot + 1, self.left[robot + 1].first());
        planner.preferred(self.team[robot], ahead, self.left[robot]).0.unwrap_or(Step::Stay)
    }

    /// Leaves `robot` no other steps than these; false if some robot then has none.
    fn leave(&mut self, robot: usize, steps: Steps) -> bool {
        let mut wave = Wave::NONE;
        self.strike(robot, self.left[robot].minus(steps), &mut wave);
        self.follow_up(wave)
    }

    /// Strikes out what the steps struck out before entail; false if some robot is left with none, or the budget ends.
    fn follow_up(&mut self, mut wave: Wave<ROBOTS>) -> bool {
        while !wave.is_over && !self.looks.is_over {
            let Some(robot) = wave.next(&self.decided) else { return true };
            let struck = core::mem::replace(&mut wave.struck[robot], Steps::NONE);
            let left = self.left[robot];
            if let Some(behind) = robot.checked_sub(1) {
                let doubtful = self.left[behind].and(self.agreeing(robot, struck));
                self.looks.take(doubtful.len());
                self.strike(behind, doubtful.minus(self.agreeing(robot, left)), &mut wave);
            }
            let ahead = robot + 1;
            if ahead < self.team.len() {
                let agreeing = &self.agreeing[ahead];
                let (mut doubtful, mut alone) = (Steps::NONE, Steps::NONE);
                for step in self.left[ahead].iter() {
                    let agreeing = agreeing[step.place()];
                    if !agreeing.and(struck).is_empty() {
                        doubtful = doubtful.with(step);
                        if agreeing.and(left).is_empty() {
                            alone = alone.with(step);
                        }
                    }
                }
                self.looks.take(doubtful.len());
                self.strike(ahead, alone, &mut wave);
            }
            if self.is_distinct {
                self.claim(robot, &mut wave);
            }
        }
        false
    }

    /// A robot with one cell left, or two robots with the same two cells left, leave them to no other. Only the base
    /// has room for all.
    fn claim(&mut self, robot: usize, wave: &mut Wave<ROBOTS>) {
        let (own, team) = (self.left[robot], self.team);
        let cells = own.iter().map(|step| team[robot].after(step));
        let has_the_same = |other: &usize| {
            let theirs = self.left[*other];
            *other != robot
                && theirs.len() == 2
                && theirs.iter().all(|step| cells.clone().any(|cell| cell == team[*other].after(step)))
        };
        let other = match own.len() {
            1 => Some(robot),
            2 => (1..team.len()).find(has_the_same),
            _ => None,
        };
        let Some(other) = other else { return };
        if cells.clone().all(|cell| cell != team[0]) {
            cells.for_each(|cell| self.take([robot, other], cell, wave));
        }
    }

    /// Takes `cell` from all but its `owners`.
    fn take(&mut self, owners: [usize; 2], cell: Cell, wave: &mut Wave<ROBOTS>) {
        let team = self.team;
        for (other, &at) in team.iter().enumerate().skip(1) {
            let steps = steps_to(cell, at);
            if !steps.is_empty() && !owners.contains(&other) {
                self.strike(other, steps, wave);
            }
        }
    }

    fn strike(&mut self, robot: usize, steps: Steps, wave: &mut Wave<ROBOTS>) {
        let before = self.left[robot];
        let struck = before.and(steps);
        if struck.is_empty() {
            return;
        }
        self.trail.as_flattened_mut()[self.trail_length] = (robot as u8, before);
        self.trail_length += 1;
        self.leave_exactly(robot, before.minus(struck));
        wave.robots.insert(robot);
        wave.struck[robot] = wave.struck[robot].or(struck);
        if struck == before {
            self.failures[robot] += 1;
            wave.is_over = true;
        }
    }

    fn leave_exactly(&mut self, robot: usize, steps: Steps) {
        self.left[robot] = steps;
        self.decided.put(robot, !steps.is_choice() && !steps.is_empty());
        self.undecided.put(robot, steps.is_choice());
    }

    /// The steps of the robot behind that agree with one of the `steps` of `robot`.
    fn agreeing(&self, robot: usize, steps: Steps) -> Steps {
        steps.iter().fold(Steps::NONE, |all, step| all.or(self.agreeing[robot][step.place()]))
    }

    fn restore(&mut self, mark: usize) {
        while self.trail_length > mark {
            self.trail_length -= 1;
            let (robot, before) = self.trail.as_flattened()[self.trail_length];
            self.leave_exactly(usize::from(robot), before);
        }
    }
}

/// A failure counts as much as a whole number can tell, divided by one to five steps.
const FAILURE: u32 = 60;

impl<const ROBOTS: usize> Wave<ROBOTS> {
    const NONE: Self = Self { robots: Robots::NONE, struck: [Steps::NONE; ROBOTS], is_over: false };

    /// Takes a robot: if possible one that is decided, as that tells most; else the nearest to the leader.
    fn next(&mut self, decided: &Robots<ROBOTS>) -> Option<usize> {
        let robot = self.robots.last_in(decided).or_else(|| self.robots.last_in(&self.robots))?;
        self.robots.remove(robot);
        Some(robot)
    }
}

impl<const ROBOTS: usize> Robots<ROBOTS> {
    const NONE: Self = Self([0; 4]);

    /// The words that are used.
    const WORDS: usize = ROBOTS.div_ceil(64);

    /// The word of a robot.
    const fn word(robot: usize) -> usize {
        if Self::WORDS == 1 { 0 } else { robot / 64 % 4 }
    }

    const fn insert(&mut self, robot: usize) {
        self.0[Self::word(robot)] |= 1 << (robot % 64);
    }

    const fn remove(&mut self, robot: usize) {
        self.0[Self::word(robot)] &= !(1 << (robot % 64));
    }

    /// Inserts or removes it.
    const fn put(&mut self, robot: usize, is_in: bool) {
        self.remove(robot);
        self.0[Self::word(robot)] |= (is_in as u64) << (robot % 64);
    }

    const fn has(&self, robot: usize) -> bool {
        self.0[Self::word(robot)] >> (robot % 64) & 1 == 1
    }

    /// The one nearest to the leader that is also in the other set.
    fn last_in(&self, other: &Self) -> Option<usize> {
        (0..Self::WORDS).rev().find_map(|word| {
            let both = self.0[word] & other.0[word];
            both.checked_ilog2().map(|bit| 64 * word + bit as usize)
        })
    }

    /// From the leader backwards.
    fn iter(self) -> impl Iterator<Item = usize> {
        (0..Self::WORDS).rev().flat_map(move |word| {
            let mut rest = self.0[word];
            core::iter::from_fn(move || {
                let bit = rest.checked_ilog2()?;
                rest ^= 1 << bit;
                Some(64 * word + bit as usize)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::rule::{Budget, Move, Rule};
    use super::*;
    use crate::choice::Oracle;
    use crate::choice::tests::Congruence;
    use crate::ground::{Area, CellMark, EdgeMark, MediumGrid, SmallGrid};

    /// So many columns and rows from 0,0.
    fn area(columns: i16, rows: i16) -> Area {
        Area::new(Cell::new(0, 0), Cell::new(columns - 1, rows - 1)).expect("cells")
    }

    #[test]
    fn the_robot_that_failed_most_for_each_step_it_has_left_is_the_next_and_the_culprit_before_it() {
        const ROBOTS: usize = 70;
        let rule = Rule { budget: Budget::Unlimited, ..Rule::PUBLISHED };
        let mut grid = MediumGrid::new(area(9, 9)).expect("it fits");
        let team = [Cell::new(4, 4); ROBOTS];
        let looks = Looks::new(rule.budget, ROBOTS);
        let planner = Planner::<_, ROBOTS>::new(&rule, &mut grid, &team, looks);
        // All are in the base, and have all steps left.
        let mut choices = Choices::new(&planner, Steps::ALL);
        let leader = ROBOTS - 1;
        assert!((1..=leader).all(|robot| choices.left[robot] == Steps::ALL));
        assert_eq!(choices.next(), Some((leader, Turn::Own)));
        let start = choices.trail_length;
        // Of two that failed as often the nearer to the leader.
        for (robot, next) in [(10, 10), (30, 30), (20, 30), (20, 20), (66, 20), (66, 66), (66, 66)] {
            let (left, failures) = (choices.left, choices.failures[robot]);
            assert!(!choices.leave(robot, Steps::NONE), "no step is left for it");
            choices.restore(start);
            assert!(choices.left == left && choices.failures[robot] == failures + 1);
            assert_eq!(choices.next(), Some((next, Turn::Early)));
        }
        // 66 failed three times and has five steps left, 20 failed twice and has two.
        choices.leave_exactly(20, Steps::only(Step::Stay).with(Step::ALL[0]));
        assert_eq!(choices.next(), Some((20, Turn::Early)));
        for culprit in [40, leader, 66] {
            choices.culprit = culprit;
            let turn = if culprit == leader { Turn::Own } else { Turn::Early };
            assert_eq!(choices.next(), Some((culprit, turn)));
        }
        // One that is decided, or that the witness helps, is not tried.
        choices.culprit = 0;
        choices.witness[20] = Steps::only(Step::Stay);
        assert_eq!(choices.next(), Some((66, Turn::Early)));
        choices.witness = [Steps::ALL; ROBOTS];
        assert_eq!(choices.next(), None);
    }

    /// The paper's recursion: the first steps of the robots behind `robot`, the nearest
    /// to it first, with which the chain closes.
    fn recursion<const ROBOTS: usize>(planner: &mut Planner<'_, SmallGrid, ROBOTS>, robot: usize) -> bool {
        let (ahead, behind) = (planner.planned(robot), robot - 1);
        if behind == 0 {
            return planner.rule.admits_ahead(Move::stay(planner.team[0]), ahead);
        }
        let at = planner.team[behind];
        let mut left = planner.candidates(behind).and(planner.rule.steps_ahead(at, ahead));
        while let Some(step) = planner.preferred(at, ahead, left).0 {
            left = left.without(step);
            let to = at.after(step);
            let is_taken = to != planner.team[0]
                && (robot..planner.team.len()).any(|other| planner.planned(other).to() == to);
            planner.steps[behind] = step;
            if !is_taken && recursion(planner, behind) {
                return true;
            }
        }
        false
    }

    #[test]
    fn followers_take_the_steps_of_the_recursion() {
        const ROBOTS: usize = 8;
        let mut drawn = Congruence(1);
        let mut told = [0; 2];
        for round in 0..600 {
            let rule = if round % 2 == 0 { Rule::PUBLISHED } else { Rule::REPAIRED };
            let rule = Rule { budget: Budget::Unlimited, ..rule };
            let mut grid = SmallGrid::new(area(5, 5)).expect("it fits");
            for edge in area(5, 5).edges() {
                match drawn.pick(6) {
                    0 => grid.put_edge(EdgeMark::Wall, edge),
                    1 | 2 => grid.put_edge(EdgeMark::Open, edge),
                    _ => {}
                }
            }
            let mut team = [Cell::new(2, 2); ROBOTS];
            for robot in 1..ROBOTS {
                let behind = team[robot - 1];
                let beside = Step::ALL[drawn.pick(5) as usize];
                let to = behind.after(beside).after(Step::ALL[drawn.pick(5) as usize]);
                team[robot] = if area(5, 5).contains(to) { to } else { behind };
                grid.put(CellMark::Explored, team[robot]);
            }
            let looks = Looks::new(rule.budget, ROBOTS);
            let mut planner = Planner::<_, ROBOTS>::new(&rule, &mut grid, &team, looks);
            let leader = ROBOTS - 1;
            let leads = planner.candidates(leader);
            let mut choices = Choices::new(&planner, leads);
            for lead in leads.iter() {
                planner.steps = [Step::Stay; ROBOTS];
                planner.steps[leader] = lead;
                let follows = recursion(&mut planner, leader);
                let expected = planner.steps;
                planner.steps = [Step::Stay; ROBOTS];
                planner.steps[leader] = lead;
                assert_eq!(choices.follow(&mut planner, lead), follows, "{team:?} {lead:?}");
                assert!(
                    !follows || planner.steps == expected,
                    "{team:?} {:?}, not {expected:?}",
                    planner.steps
                );
                told[usize::from(follows)] += 1;
            }
        }
        assert!(told.iter().all(|&times| times > 50), "{told:?}");
    }
}
