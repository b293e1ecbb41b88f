//! The reel (ours): a planner that goes for the nearest unexplored cell by the shortest way that a rehearsal finds.
//! Each team move is the first of these that there is:
//!
//! - A, *touch*: the leader crosses into an unexplored cell beside it, and the others follow as in the paper.
//! - B, *approach*: some robot comes one cell nearer to an unexplored cell in each team move, and the others do what
//!   the step solver finds cheapest.
//! - C, *draw in and let out*: the chain is drawn in along its own walk up to where the walk to another unexplored cell
//!   turns off, and let out along that.
//! - D, *take back*: the latest 1, 2, 4, 8, … team moves are taken back, and A to C are sought again.
//!
//! B and C are **tasks**: a task is begun only if a rehearsal on the known map, in which no wall is met, ends with an
//! unexplored cell explored, and it is kept until then, or until something else is gained: a cell explored or a wall
//! found. So the number of its team moves is known, and falls. From the base C always finds a walk to whatever is
//! within reach. Clauses CHAIN-16 to CHAIN-18, CHAIN-23 to CHAIN-25.

use super::habit::{Habit, Habits};
use super::rule::Rule;
use super::solver::{Apart, Wish, solve};
use super::walk::{Lookup, Walk};
use crate::ground::{Cell, CellMark, Grid, Step, Steps, steps_to};

/// The team's task.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Task {
    /// Nothing: the next team move begins something.
    None,
    /// This robot comes nearer to this cell.
    Approach { robot: u16, to: Cell },
    /// The chain is drawn in as far as this stop of its walk, to be let out from there by at most so many links.
    DrawIn { stop: u16, links: u16 },
    /// The chain is let out along its walk.
    LetOut,
    /// Team moves are taken back.
    TakeBack,
}

/// The reel's memory from one team move to the next.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Reel<const ROBOTS: usize> {
    pub(super) task: Task,
    /// Team moves left of the task.
    pub(super) left: u32,
    /// How often the history was taken back since the last gain.
    doublings: u8,
    walk: Walk<ROBOTS>,
}

/// The team's next move by the reel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Next<const ROBOTS: usize> {
    /// This team move.
    Go([Step; ROBOTS]),
    /// The latest team move is taken back.
    TakeBack,
    /// Nothing any more.
    Done,
}

/// The cost for a robot of a cell nearer to its target, or farther.
const DISTANCE: i32 = 5;
/// The cost of neighbours that are not side by side.
const APART: Apart = Apart(5);
/// The cost of a step.
const STEP: i32 = 1;
/// The gain of an unexplored cell.
const NEW_CELL: i32 = 30;
/// The leader's gain for a step in while the chain is drawn in.
const DRAWN_IN: i32 = 1000;
/// Unexplored cells so near are approached without a look at what drawing in would take.
const NEAR: u32 = 2;
/// Rehearsals of approaches in one plan.
const REHEARSALS: u32 = 64;

impl<const ROBOTS: usize> Reel<ROBOTS> {
    /// Nothing begun.
    pub(super) const NONE: Self = Self { task: Task::None, left: 0, doublings: 0, walk: Walk::NONE };

    /// The latest team move is taken back, the first time since the last gain.
    pub(super) const TAKE_BACK: Self = Self { task: Task::TakeBack, left: 1, doublings: 1, ..Self::NONE };

    /// One team move of the task is made, which gained nothing; `leader` is where the leader is.
    pub(super) fn went_on(&mut self, leader: Cell) {
        self.left = self.left.saturating_sub(1);
        match self.task {
            Task::DrawIn { .. } => self.walk.go_back(leader),
            Task::LetOut => self.walk.go_on(leader),
            Task::None | Task::Approach { .. } | Task::TakeBack => {}
        }
        if self.left == 0 && self.task != Task::TakeBack {
            *self = Self { doublings: self.doublings, ..Self::NONE };
        }
    }

    /// Three numbers that fall lexicographically from one team move to the next as long as nothing is gained: how often
    /// the history can still be begun to be taken back; whether it is being taken back; and the team moves left of
    /// that, or of the task.
    pub(super) fn measure(&self) -> [u32; 3] {
        let is_taking_back = u32::from(self.task == Task::TakeBack);
        [u32::from(u8::MAX - self.doublings), is_taking_back, self.left]
    }
}

/// The reel at work for the robots in `team`, base first.
pub(super) struct Winder<'a, G, const ROBOTS: usize> {
    pub(super) rule: &'a Rule,
    pub(super) habits: Habits,
    pub(super) grid: &'a mut G,
    pub(super) team: &'a [Cell],
}

impl<G: Grid, const ROBOTS: usize> Winder<'_, G, ROBOTS> {
    /// The next move, and what the reel is to remember of it. `has_history` tells whether there is something to take
    /// back.
    pub(super) fn wind(&mut self, mut reel: Reel<ROBOTS>, has_history: bool) -> (Next<ROBOTS>, Reel<ROBOTS>) {
        if !self.habits.has(Habit::KeepsTask) && reel.task != Task::TakeBack {
            reel = Reel { doublings: reel.doublings, ..Reel::NONE };
        }
        if reel.task == Task::TakeBack && reel.left > 0 && has_history {
            return (Next::TakeBack, reel);
        }
        if let Some(next) = self.go_on(&mut reel) {
            return (next, reel);
        }
        reel = Reel { doublings: reel.doublings, ..Reel::NONE };
        let mut stops = [self.team[0]; ROBOTS];
        if self.grid.stops(self.team[0], &mut stops[..self.team.len()]).is_none() {
            return (Next::Done, reel);
        }
        if let Some((begun, left)) = self.seek() {
            reel = Reel { left, doublings: reel.doublings, ..begun };
            if let Some(next) = self.go_on(&mut reel) {
                return (next, reel);
            }
        }
        if !has_history {
            return (Next::Done, reel);
        }
        let left = 1_u32.checked_shl(reel.doublings.into()).unwrap_or(u32::MAX);
        let doublings = reel.doublings.saturating_add(u8::from(self.habits.has(Habit::Doubles)));
        reel = Reel { task: Task::TakeBack, left, doublings, ..Reel::NONE };
        (Next::TakeBack, reel)
    }

    /// The next team move of the task, if there is one.
    fn go_on(&mut self, reel: &mut Reel<ROBOTS>) -> Option<Next<ROBOTS>> {
        let bearings = self.bearings(reel.task);
        self.step(reel, self.team, bearings.as_ref()).map(Next::Go)
    }

    /// How far cells are from the one that is approached.
    fn bearings(&mut self, task: Task) -> Option<G::Bearings> {
        let Task::Approach { to, .. } = task else { return None };
        Some(self.grid.bearings(to, self.most_steps()))
    }

    /// The farthest cells that are sought.
    const fn most_steps(&self) -> u32 {
        4 * self.team.len() as u32
    }

    /// The steps of the next team move of a task by robots in `team`.
    fn step(
        &mut self,
        reel: &mut Reel<ROBOTS>,
        team: &[Cell],
        bearings: Option<&G::Bearings>,
    ) -> Option<[Step; ROBOTS]> {
        if let Task::DrawIn { stop, links } = reel.task
            && reel.walk.leader() <= reel.walk.stop(stop.into())
        {
            let (stop, links) = (usize::from(stop), usize::from(links));
            let mut stops = [team[0]; ROBOTS];
            let found = self.grid.stops(reel.walk.cell(reel.walk.stop(stop)), &mut stops[..=links])?;
            reel.task = Task::LetOut;
            reel.walk = reel.walk.turned_off(self.grid, stop, &stops[..=found]);
        }
        match reel.task {
            Task::None | Task::TakeBack => None,
            Task::Approach { robot, .. } => {
                let wishes = self.approaching(team, robot.into(), bearings?);
                solve(self.rule, self.grid, team, &wishes, APART)
            }
            Task::DrawIn { .. } => {
                let wishes = self.drawing_in(team, &reel.walk)?;
                let steps = solve(self.rule, self.grid, team, &wishes, Apart(0))?;
                steps.iter().any(|&step| step != Step::Stay).then_some(steps)
            }
            Task::LetOut => {
                let steps = reel.walk.let_out(team, self.lookup())?;
                let is_admitted = !self.habits.has(Habit::Rehearses)
                    || self.rule.admits_plan(self.grid, team, &steps[..team.len()]);
                is_admitted.then_some(steps)
            }
        }
    }

    const fn lookup(&self) -> Lookup {
        if self.habits.has(Habit::LastPlace) { Lookup::LastFirst } else { Lookup::FirstFirst }
    }

    /// `robot` comes nearer, and all others would like to.
    fn approaching(&self, team: &[Cell], robot: usize, bearings: &G::Bearings) -> [Wish; ROBOTS] {
        let mut wishes = [Wish::STAY; ROBOTS];
        for (place, (wish, &at)) in wishes.iter_mut().zip(team).enumerate().skip(1) {
            let nearer = self.grid.nearer(bearings, at);
            let is_bound = place == robot && self.habits.has(Habit::ComesNearer);
            wish.steps = if is_bound { nearer } else { Steps::ALL };
            for step in Steps::ALL.without(Step::Stay).iter() {
                let away = match (nearer.has(step), nearer.is_empty()) {
                    (true, _) => -DISTANCE,
                    (false, true) => 0,
                    (false, false) => DISTANCE,
                };
                let is_new = !self.grid.has(CellMark::Explored, at.after(step));
                wish.cost[step.place()] = STEP + away - if is_new { NEW_CELL } else { 0 };
            }
        }
        wishes
    }

    /// The leader goes back along the walk, and the others as far as they must. `None` if one is not on the walk.
    fn drawing_in(&self, team: &[Cell], walk: &Walk<ROBOTS>) -> Option<[Wish; ROBOTS]> {
        let places = walk.places(team, self.lookup())?;
        let leader = team.len() - 1;
        let mut wishes = [Wish::STAY; ROBOTS];
        for (robot, &at) in team.iter().enumerate() {
            if let Some(place) = places[robot].checked_sub(1) {
                let back = steps_to(walk.cell(place), at).iter().next()?;
                wishes[robot].steps = Steps::only(Step::Stay).with(back);
                wishes[robot].cost[back.place()] = if robot == leader { -DRAWN_IN } else { STEP };
            }
        }
        Some(wishes)
    }

    /// Carries a task through on the known map, from where the team is: how many team moves it takes until a cell is
    /// explored, if it comes to that within `most`.
    fn rehearse(&mut self, mut reel: Reel<ROBOTS>, most: u32) -> Option<u32> {
        let robots = self.team.len();
        let mut team = [self.team[0]; ROBOTS];
        team[..robots].copy_from_slice(self.team);
        let bearings = self.bearings(reel.task);
        reel.left = u32::MAX;
        for moves in 1..=most {
            let steps = self.step(&mut reel, &team[..robots], bearings.as_ref())?;
            let mut explores = false;
            for (cell, step) in team[..robots].iter_mut().zip(steps) {
                *cell = cell.after(step);
                explores |= !self.grid.has(CellMark::Explored, *cell);
            }
            if explores {
                return Some(moves);
            }
            if !self.habits.has(Habit::Rehearses) {
                return Some(most);
            }
            reel.went_on(team[robots - 1]);
        }
        None
    }

    /// The task that gains soonest, as far as one is found, and its number of team moves.
    fn seek(&mut self) -> Option<(Reel<ROBOTS>, u32)> {
        let mut rehearsals = REHEARSALS;
        if let Some(found) = self.approach(0, NEAR, &mut rehearsals) {
            return Some(found);
        }
        let drawn = self.draw_in();
        let most = drawn.as_ref().map_or(self.most_steps(), |&(_, moves)| moves - 1);
        self.approach(NEAR, most.min(self.most_steps()), &mut rehearsals).or(drawn)
    }

    /// The first approach that a rehearsal carries through, of robots and cells more than `above` and at most `most`
    /// steps apart, nearest first, the leader before the others.
    fn approach(&mut self, above: u32, most: u32, rehearsals: &mut u32) -> Option<(Reel<ROBOTS>, u32)> {
        if above >= most {
            return None;
        }
        // For each robot, the next cell behind those that were tried; as long as it is
        // not sought, only how far it is at least.
        let mut nearest = [Nearest::Nothing; ROBOTS];
        for (robot, &at) in self.team.iter().enumerate().skip(1) {
            let least = self.grid.least_distance(at).max(above + 1);
            nearest[robot] = Nearest::Unsought { least, behind: (above, Cell::new(i16::MAX, i16::MAX)) };
        }
        while *rehearsals > 0 {
            let (distance, robot, to) = self.seek_nearest(&mut nearest, most)?;
            *rehearsals -= 1;
            let begun = Reel { task: Task::Approach { robot: robot as u16, to }, ..Reel::NONE };
            if let Some(moves) = self.rehearse(begun, distance) {
                return Some((begun, moves));
            }
            nearest[robot] = Nearest::Unsought { least: distance, behind: (distance, to) };
        }
        None
    }

    /// Of what comes next for each robot, the nearest at most `most` steps away, the leader's before the others'. What
    /// cannot be nearer is not sought.
    fn seek_nearest(&mut self, nearest: &mut [Nearest; ROBOTS], most: u32) -> Option<(u32, usize, Cell)> {
        let robots = (1..self.team.len()).rev();
        let promising = robots.clone().min_by_key(|&robot| nearest[robot].least());
        let mut found: Option<(u32, usize, Cell)> = None;
        for robot in promising.into_iter().chain(robots) {
            let is_first = |distance| {
                found.is_none_or(|(least, other, _)| distance < least || distance == least && robot > other)
            };
            if let Nearest::Unsought { least, behind } = nearest[robot]
                && least <= most
                && is_first(least)
            {
                let next = self.grid.next_unexplored(self.team[robot], Some(behind), most);
                nearest[robot] =
                    next.map_or(Nearest::Nothing, |(distance, cell)| Nearest::At { distance, cell });
            }
            if let Nearest::At { distance, cell } = nearest[robot]
                && is_first(distance)
            {
                found = Some((distance, robot, cell));
            }
        }
        found
    }

    /// The shortest way to draw the chain in and let it out again to an
    /// unexplored cell that a rehearsal carries through.
    fn draw_in(&mut self) -> Option<(Reel<ROBOTS>, u32)> {
        let leader = self.team.len() - 1;
        let walk = Walk::<ROBOTS>::own(self.grid, self.team);
        let mut best: Option<(Reel<ROBOTS>, u32)> = None;
        for robot in (walk.first()..leader).rev() {
            let stop = robot - walk.first();
            let taken_in = (walk.leader() - walk.stop(stop)) as u32;
            let least = best.map_or(u32::MAX, |(_, moves)| moves);
            if taken_in + 1 >= least {
                break;
            }
            let links = leader - robot;
            let mut stops = [self.team[0]; ROBOTS];
            if self.grid.stops(self.team[robot], &mut stops[..=links]).is_none() {
                continue;
            }
            let task = Task::DrawIn { stop: stop as u16, links: links as u16 };
            let begun = Reel { task, walk, ..Reel::NONE };
            let most = (least - 1).min(4 * self.most_steps());
            if let Some(moves) = self.rehearse(begun, most) {
                best = Some((begun, moves));
            }
        }
        best
    }
}

/// The unexplored cell that comes next for a robot, as far as it is known.
#[derive(Clone, Copy)]
enum Nearest {
    /// There is none.
    Nothing,
    /// It is at least so far, and comes behind that one.
    Unsought { least: u32, behind: (u32, Cell) },
    /// It is so far.
    At { distance: u32, cell: Cell },
}

impl Nearest {
    /// How far it is at least.
    const fn least(self) -> u32 {
        match self {
            Self::Nothing => u32::MAX,
            Self::Unsought { least, .. } => least,
            Self::At { distance, .. } => distance,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_team_move_that_gains_nothing_leaves_fewer() {
        let leader = Cell::new(0, 0);
        let approach = Task::Approach { robot: 1, to: leader };
        let draw_in = Task::DrawIn { stop: 0, links: 1 };
        for task in [approach, draw_in, Task::LetOut, Task::TakeBack] {
            for (left, doublings) in [(1, 0), (2, 3), (1, 3), (u32::MAX, u8::MAX)] {
                let mut reel = Reel::<4> { task, left, doublings, ..Reel::NONE };
                let before = reel.measure();
                reel.went_on(leader);
                assert!(reel.measure() < before, "{task:?}, {left} left");
            }
        }
    }
}
