//! A team of robots that keep in touch: their records, where they are, and whose turn it is (Peiris, sections 3 and 4).

use super::refusals::{Misuse, SetupError};
use super::rule::{Condition, Fallback, Filter, Rule, Runs};
use super::stance::{SEEN, Stance};
use crate::choice::Oracle;
use crate::ground::{Cell, Edge, EdgeMark, Grid, Side, Step, Steps};
use crate::net::sets::{first_robots, sets};

/// The most robots that a team can hold.
pub const MAX_ROBOTS: usize = 16;

/// A robot's next action.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Next {
    /// It turns to this side and looks: tell what it sees by [`Kit::looked`].
    Looks(Side),
    /// It drives to this node: tell when it is there by [`Kit::arrived`].
    Drives(Cell),
    /// It stays until something changes.
    Stays,
    /// It knows that the team can drive no more new path, and stays for ever.
    Done,
}

/// A robot's sight of a side that it looks at.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Sight {
    /// Nothing within 3.5 m.
    Free,
    /// An obstacle.
    Obstacle,
    /// Another robot.
    Robot,
}

/// Why it takes a side.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) enum Why {
    /// It leads straight on.
    Ahead,
    /// Another robot stands there, and nobody knows whether the path is free.
    Beside,
    /// It is uncovered.
    Uncovered,
    /// It was driven before.
    Old,
    /// Nothing else is left.
    Fallback,
}

/// A robot's task.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) enum Task {
    /// It drives, or has yet to decide.
    None,
    /// It looks at a side, and these are left for the same reason.
    Looks { side: Side, left: Steps, why: Why },
    /// It has decided to stay, and nothing has changed since.
    Stays,
    /// It is done.
    Done,
}

/// A robot of a team. Whoever keeps a team as far as it was told puts down here where the others are.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Robot {
    /// Where it is.
    pub stance: Stance,
    pub(super) task: Task,
    /// The way that it drove last.
    pub heading: Option<Side>,
    /// Whether the path that it drives was new when it left.
    pub is_new: bool,
}

/// All that changes of a team but its records.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Crew<const ROBOTS: usize> {
    pub(super) robots: [Robot; ROBOTS],
    /// Robots that have entered. Of those that start at one node each enters when the one before has left.
    pub(super) entered: u8,
    /// Whose turn it is, where robots take turns.
    pub turn: u8,
}

/// A team of at most `ROBOTS` robots on a map of at most `NODES` nodes.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Kit<G, const ROBOTS: usize, const NODES: usize> {
    pub(super) rule: Rule,
    /// Each robot's record of sides driven ([`EdgeMark::Open`]) and seen blocked ([`EdgeMark::Wall`]).
    pub(super) records: [G; ROBOTS],
    /// The union of the records of all.
    pub(super) union: G,
    pub(super) count: u8,
    /// Its robots and whose turn it is, for a team that is told so.
    pub crew: Crew<ROBOTS>,
}

impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// A team that knows nothing of `map` but its border, a robot in each of `starts`.
    ///
    /// # Errors
    /// [`SetupError`] if it cannot start so.
    pub fn new(rule: Rule, map: G, starts: &[Cell]) -> Result<Self, SetupError>
    where
        G: Copy,
    {
        const { assert!(ROBOTS <= MAX_ROBOTS, "a team holds at most 16 robots") };
        let area = map.area();
        let nodes = area.width() * area.height();
        let robots = starts.len();
        if robots == 0 || robots > ROBOTS {
            return Err(SetupError::Robots { robots, most: ROBOTS });
        }
        if nodes > NODES {
            return Err(SetupError::TooManyNodes { nodes, most: NODES });
        }
        if let Some(&outside) = starts.iter().find(|&&start| !area.contains(start)) {
            return Err(SetupError::Outside(outside));
        }
        let taken = (0..robots).find(|&place| starts[..place].contains(&starts[place]));
        if let Some(place) = taken.filter(|_| rule.has(Condition::Apart)) {
            return Err(SetupError::OneNode(starts[place]));
        }
        let sure = |one: usize, other: usize| rule.reach.joins(starts[one], starts[other]);
        if sets::<ROBOTS>(first_robots(robots), sure).iter().skip(1).any(|&set| set != 0) {
            return Err(SetupError::OutOfContact(rule.reach));
        }
        let robot = |place: usize| {
            let stance = Stance::Stands(starts.get(place).copied().unwrap_or(area.first()));
            Robot { stance, task: Task::None, heading: None, is_new: false }
        };
        Ok(Self {
            rule,
            records: [map; ROBOTS],
            union: map,
            count: robots as u8,
            crew: Crew {
                robots: core::array::from_fn(robot),
                entered: if taken.is_some() { 1 } else { robots as u8 },
                turn: 0,
            },
        })
    }

    /// Its rule.
    pub const fn rule(&self) -> &Rule {
        &self.rule
    }

    /// Where each robot is that has entered.
    pub fn stances(&self) -> impl Iterator<Item = Stance> + Clone {
        self.crew.robots.iter().take(self.crew.entered.into()).map(|robot| robot.stance)
    }

    /// Every robot, also those that have not entered.
    pub fn robots(&self) -> &[Robot] {
        &self.crew.robots[..self.count.into()]
    }

    /// Every robot, for a team that is told where they are.
    pub fn robots_mut(&mut self) -> &mut [Robot] {
        &mut self.crew.robots[..self.count.into()]
    }

    /// Where `robot` is.
    pub fn stance(&self, robot: usize) -> Option<Stance> {
        Some(self.robots().get(robot)?.stance)
    }

    /// Each robot's record of sides driven ([`EdgeMark::Open`]) and seen blocked ([`EdgeMark::Wall`]).
    pub fn records(&self) -> &[G] {
        &self.records[..self.count.into()]
    }

    /// Whose turn it is, where robots take turns.
    pub fn turn(&self) -> Option<usize> {
        self.rule.has(Condition::Turn).then_some(self.crew.turn.into())
    }

    /// Whether `robot` knows that it is done.
    pub fn is_done(&self, robot: usize) -> bool {
        self.robots().get(robot).is_some_and(|robot| robot.task == Task::Done)
    }

    /// Whether every robot knows that it is done: the run is over.
    pub fn is_over(&self) -> bool {
        self.robots().iter().all(|robot| robot.task == Task::Done)
    }

    /// Whether `robot` stands, has been answered, and has not decided yet.
    pub fn may_decide(&self, robot: usize) -> bool {
        if robot >= usize::from(self.crew.entered) || !self.asks(robot) {
            return false;
        }
        if let Some(turn) = self.turn() {
            return turn == robot;
        }
        // The other robots answer while they drive.
        self.others(robot).all(|other| !other.stands())
    }

    /// Whether `robot` stands and has something to decide, whoever has the turn.
    pub fn asks(&self, robot: usize) -> bool {
        self.robots().get(robot).is_some_and(|robot| robot.stance.stands() && robot.task == Task::None)
    }

    /// Begins the decision of `robot`. Where several sides are as good, `oracle` picks one.
    ///
    /// # Errors
    /// [`Misuse`] if it may not decide now.
    pub fn decide(&mut self, robot: usize, oracle: &mut dyn Oracle) -> Result<Next, Misuse> {
        if !self.may_decide(robot) {
            return Err(Misuse::Decides);
        }
        let heading = self.crew.robots[robot].heading;
        Ok(match heading {
            Some(ahead) if self.rule.runs == Runs::Ahead => self.look(robot, ahead, Steps::NONE, Why::Ahead),
            Some(_) | None => self.look_beside(robot, oracle),
        })
    }

    /// Takes what `robot` sees at the side that it looks at. Where several sides are as good, `oracle` picks the next.
    ///
    /// # Errors
    /// [`Misuse`] if it looks at no side.
    pub fn looked(&mut self, robot: usize, sight: Sight, oracle: &mut dyn Oracle) -> Result<Next, Misuse> {
        let Some(Task::Looks { side, left, why }) = self.robots().get(robot).map(|robot| robot.task) else {
            return Err(Misuse::Looks);
        };
        let from = self.crew.robots[robot].stance.to();
        let edge = Edge::new(from, side);
        if sight == Sight::Free && why != Why::Beside {
            let to = from.beyond(side);
            let is_new = !self.known(EdgeMark::Open, from).has(Step::Cross(side));
            self.record(robot, EdgeMark::Open, edge);
            self.crew.robots[robot] =
                Robot { stance: Stance::Drives { from, to }, task: Task::None, heading: Some(side), is_new };
            self.crew.entered = self.count.min(self.crew.entered + 1);
            self.tell_of_change(robot);
            return Ok(Next::Drives(to));
        }
        self.crew.robots[robot].task = Task::None;
        if sight == Sight::Obstacle && self.rule.has(Condition::Marked) {
            self.record(robot, EdgeMark::Wall, edge);
            self.tell_of_change(robot);
        }
        if sight != Sight::Obstacle && why == Why::Beside {
            self.record(robot, SEEN, edge);
            self.tell_of_change(robot);
        }
        Ok(match why {
            Why::Ahead => self.look_beside(robot, oracle),
            Why::Beside => self.look_at_those_beside(robot, left, oracle),
            Why::Uncovered => self.take_uncovered(robot, left, oracle),
            Why::Old => self.regroup(robot, left, oracle),
            Why::Fallback => self.fall_back(robot, left, oracle),
        })
    }

    /// `robot` has come to where it drove.
    ///
    /// # Errors
    /// [`Misuse`] if it does not drive.
    pub fn arrived(&mut self, robot: usize) -> Result<(), Misuse> {
        let Some(Stance::Drives { to, .. }) = self.stance(robot) else { return Err(Misuse::Drives) };
        self.crew.robots[robot].stance = Stance::Stands(to);
        self.tell_of_change(robot);
        Ok(())
    }
}

/// How a robot decides.
impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// First the sides at which other robots stand, if it is unknown whether they are free.
    fn look_beside(&mut self, robot: usize, oracle: &mut dyn Oracle) -> Next {
        let mut sides = Steps::NONE;
        if self.count > 2 && self.rule.has(Condition::Beside) {
            let at = self.crew.robots[robot].stance.to();
            let unknown = self.uncovered_by_all(at).minus(self.known(SEEN, at));
            sides =
                unknown.filter(|step| self.stances().any(|other| other == Stance::Stands(at.after(step))));
        }
        self.look_at_those_beside(robot, sides, oracle)
    }

    /// The sides that are `left` at which other robots stand.
    fn look_at_those_beside(&mut self, robot: usize, left: Steps, oracle: &mut dyn Oracle) -> Next {
        match left.iter().next() {
            Some(Step::Cross(side)) => self.look(robot, side, left, Why::Beside),
            Some(Step::Stay) | None => self.keep_in_touch(robot, oracle),
        }
    }

    /// The KIT algorithm, from the uncovered sides on.
    fn keep_in_touch(&mut self, robot: usize, oracle: &mut dyn Oracle) -> Next {
        let sides = self.uncovered(robot, self.crew.robots[robot].stance.to());
        let admitted = match self.rule.filter {
            Filter::Everywhere => self.admitted(robot, sides),
            Filter::OldPaths => sides,
        };
        self.take_uncovered(robot, admitted, oracle)
    }

    /// Any of the uncovered sides that are `left`.
    fn take_uncovered(&mut self, robot: usize, left: Steps, oracle: &mut dyn Oracle) -> Next {
        if let Some(side) = one_of(left, oracle) {
            return self.look(robot, side, left, Why::Uncovered);
        }
        let part = if self.rule.has(Condition::Regroup) { self.part(robot) } else { Some(Steps::NONE) };
        if let Some(sides) = part.filter(|sides| !sides.is_empty()) {
            return self.regroup(robot, sides, oracle);
        }
        if self.rule.has(Condition::Stays) {
            let is_over = part.is_none() && self.stances().all(Stance::stands);
            return self.rest(robot, if is_over { Task::Done } else { Task::Stays });
        }
        let blocked = self.known(EdgeMark::Wall, self.crew.robots[robot].stance.to());
        let all = Steps::ALL.without(Step::Stay).minus(blocked);
        let left = if self.rule.fallback == Fallback::Admitted { self.admitted(robot, all) } else { all };
        self.fall_back(robot, left, oracle)
    }

    /// Any of the sides that are `left` of its part of the joint way.
    fn regroup(&mut self, robot: usize, left: Steps, oracle: &mut dyn Oracle) -> Next {
        match one_of(left, oracle) {
            Some(side) => self.look(robot, side, left, Why::Old),
            None => self.rest(robot, Task::Stays),
        }
    }

    /// The side of those `left` that leads nearest to where the other goes, or any.
    fn fall_back(&mut self, robot: usize, left: Steps, oracle: &mut dyn Oracle) -> Next {
        let at = self.crew.robots[robot].stance.to();
        let distance = |step: Step| {
            let node = at.after(step);
            let to_each = self.others(robot).map(|other| {
                let (dx, dy) = node.apart(other.to());
                u64::from(dx).pow(2) + u64::from(dy).pow(2)
            });
            to_each.min().unwrap_or(0)
        };
        let least = left.iter().map(distance).min();
        let good = match self.rule.fallback {
            Fallback::Nearest | Fallback::Admitted => left.filter(|step| Some(distance(step)) == least),
            Fallback::Random => left,
        };
        match one_of(good, oracle) {
            Some(side) => self.look(robot, side, left, Why::Fallback),
            None => self.rest(robot, Task::Stays),
        }
    }

    fn look(&mut self, robot: usize, side: Side, left: Steps, why: Why) -> Next {
        self.crew.robots[robot].task = Task::Looks { side, left: left.without(Step::Cross(side)), why };
        Next::Looks(side)
    }

    fn rest(&mut self, robot: usize, task: Task) -> Next {
        self.crew.robots[robot].task = task;
        self.pass_turn();
        if task == Task::Done { Next::Done } else { Next::Stays }
    }

    /// Whoever stays decides anew when another robot leaves, arrives, or marks a side.
    fn tell_of_change(&mut self, robot: usize) {
        for (other, Robot { task, .. }) in self.robots_mut().iter_mut().enumerate() {
            if other != robot && *task == Task::Stays {
                *task = Task::None;
            }
        }
        self.pass_turn();
    }

    /// Whose turn it is has decided, and another one asks: the next in the order of their numbers.
    fn pass_turn(&mut self) {
        let asks =
            |robot: &Robot| robot.stance.stands() && matches!(robot.task, Task::None | Task::Looks { .. });
        let turn = usize::from(self.crew.turn);
        let after = (turn..self.count.into()).chain(0..turn);
        if let Some(next) = after.into_iter().find(|&robot| asks(&self.crew.robots[robot])) {
            self.crew.turn = next as u8;
        }
    }
}

/// One of the sides across which `steps` lead, if there is any.
fn one_of(steps: Steps, oracle: &mut dyn Oracle) -> Option<Side> {
    let number = match steps.len() {
        0 => return None,
        1 => 0,
        of => oracle.pick(of),
    };
    match steps.iter().nth(number as usize)? {
        Step::Cross(side) => Some(side),
        Step::Stay => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::stance::Reach;
    use super::*;
    use crate::ground::{Area, TinyGrid};

    type Pair = Kit<TinyGrid, 2, 64>;

    /// Answers 0.
    struct First;

    impl Oracle for First {
        fn pick(&mut self, _: u32) -> u32 {
            0
        }
    }

    fn map(width: i16, height: i16) -> TinyGrid {
        let area = Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1)).expect("an area");
        TinyGrid::new(area).expect("a small map")
    }

    fn pair(rule: Rule, starts: [Cell; 2]) -> Pair {
        Pair::new(rule, map(8, 8), &starts).expect("a team")
    }

    /// Robots drive and arrive in turn, and see nothing but `walls`, until all
    /// are done; the drives that they have made.
    fn run<const ROBOTS: usize>(kit: &mut Kit<TinyGrid, ROBOTS, 64>, walls: impl Fn(Edge) -> bool) -> usize {
        let mut drives = 0;
        for _ in 0..2000 {
            for robot in 0..kit.robots().len() {
                if !kit.may_decide(robot) {
                    let _ = kit.arrived(robot);
                    continue;
                }
                let at = kit.stance(robot).expect("a robot").to();
                let mut next = kit.decide(robot, &mut First).expect("it may");
                while let Next::Looks(side) = next {
                    let sight = if walls(Edge::new(at, side)) { Sight::Obstacle } else { Sight::Free };
                    next = kit.looked(robot, sight, &mut First).expect("it looks");
                }
                drives += usize::from(matches!(next, Next::Drives(_)));
            }
        }
        drives
    }

    fn is_covered<const ROBOTS: usize>(kit: &Kit<TinyGrid, ROBOTS, 64>) -> bool {
        kit.records()[0].area().cells().all(|node| kit.uncovered_by_all(node).is_empty())
    }

    #[test]
    fn repaired_teams_drive_every_path_of_an_open_map_and_know_it() {
        let mut two = pair(Rule::REPAIRED, [Cell::new(0, 0), Cell::new(1, 0)]);
        assert!(run(&mut two, |_| false) >= 112);
        assert!(two.is_over() && is_covered(&two));
        let mut one = Kit::<_, 1, 64>::new(Rule::REPAIRED, map(8, 8), &[Cell::new(3, 3)]).expect("a team");
        assert!(run(&mut one, |_| false) >= 112);
        assert!(one.is_over() && is_covered(&one));
        let starts = [0, 1, 2].map(|x| Cell::new(x, 0));
        let mut three = Kit::<_, 3, 64>::new(Rule::REPAIRED, map(8, 8), &starts).expect("a team");
        assert!(run(&mut three, |_| false) >= 112);
        assert!(three.is_over() && is_covered(&three));
        let one_by_one = Rule::REPAIRED.without(Condition::Meanwhile);
        let mut three = Kit::<_, 3, 64>::new(one_by_one, map(8, 8), &starts).expect("a team");
        assert!(run(&mut three, |_| false) >= 112);
        assert!(three.is_over() && is_covered(&three));
    }

    #[test]
    fn as_published_the_second_robot_enters_when_the_first_has_left() {
        let mut kit = pair(Rule::PUBLISHED, [Cell::new(0, 0); 2]);
        assert!(kit.may_decide(0) && !kit.may_decide(1));
        assert_eq!(kit.decide(0, &mut First), Ok(Next::Looks(Side::East)));
        assert_eq!(kit.looked(0, Sight::Free, &mut First), Ok(Next::Drives(Cell::new(1, 0))));
        assert!(kit.may_decide(1));
        assert_eq!(kit.arrived(0), Ok(()));
        assert!(!kit.may_decide(0) && !kit.may_decide(1), "both stand, and nobody answers");
    }

    #[test]
    fn a_side_that_is_seen_blocked_is_not_looked_at_again() {
        let starts = [Cell::new(0, 0), Cell::new(1, 1)];
        let mut kit = pair(Rule::REPAIRED, starts);
        assert_eq!(kit.decide(0, &mut First), Ok(Next::Looks(Side::East)));
        assert_eq!(kit.looked(0, Sight::Obstacle, &mut First), Ok(Next::Looks(Side::South)));
        assert!(kit.covered(1, Cell::new(1, 0)).has(Step::Cross(Side::West)));
        let mut kit = pair(Rule::REPAIRED.without(Condition::Marked), starts);
        assert_eq!(kit.decide(0, &mut First), Ok(Next::Looks(Side::East)));
        assert_eq!(kit.looked(0, Sight::Obstacle, &mut First), Ok(Next::Looks(Side::South)));
        assert!(!kit.covered(1, Cell::new(1, 0)).has(Step::Cross(Side::West)));
    }

    #[test]
    fn a_team_that_cannot_start_is_refused() {
        let start = |starts: [Cell; 2]| Pair::new(Rule::REPAIRED, map(5, 1), &starts).err();
        let (first, last) = (Cell::new(0, 0), Cell::new(4, 0));
        assert_eq!(start([first, last]), Some(SetupError::OutOfContact(Reach::PAPER)));
        assert_eq!(start([first, first]), Some(SetupError::OneNode(first)));
        assert_eq!(start([first, Cell::new(5, 0)]), Some(SetupError::Outside(Cell::new(5, 0))));
        let small = Kit::<_, 1, 4>::new(Rule::REPAIRED, map(5, 1), &[first]).err();
        assert_eq!(small, Some(SetupError::TooManyNodes { nodes: 5, most: 4 }));
    }

    #[test]
    fn what_does_not_fit_is_not_heard() {
        let mut kit = pair(Rule::REPAIRED, [Cell::new(0, 0), Cell::new(1, 0)]);
        assert_eq!(kit.decide(1, &mut First), Err(Misuse::Decides));
        assert_eq!(kit.looked(0, Sight::Free, &mut First), Err(Misuse::Looks));
        assert_eq!(kit.arrived(0), Err(Misuse::Drives));
        assert_eq!(kit.arrived(7), Err(Misuse::Drives));
    }
}
