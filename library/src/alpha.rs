//! The Alpha rule for swarms that stay together: Winfield, Liu, Nembrini and Martinoli (Swarm Intelligence 2, 2008);
//! model checked by Dixon, Winfield, Fisher and Zeng (Robotics and Autonomous Systems 60, 2012) and, with symmetry, by
//! Antuña, Araiza-Illan, Campos and Eder (2015). A robot goes forward. If fewer than α robots are within its range
//! since its last step, it turns back; once there are α of them again, it turns left or right.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, Debug)]
pub struct Conditions {
    /// A robot that misses the others goes on.
    pub goes_on: bool,
    /// A robot that loses the others turns back.
    pub turns_back: bool,
    /// A robot that has found them again turns left or right.
    pub turns_aside: bool,
}

bound! {
    /// Robots on a grid without rim, so many cells wide and high; the range of each in cells, in both directions.
    pub Swarm { robots: usize, width: i8, range: i8, alpha: usize, moves: Moves }
    "{robots} robots, {width}×{width} cells without rim, range {range}, α = {alpha}, every connected start, {moves}";
    moves != Moves::LookThenMove, "a robot looks and goes in one step here"
}

/// Column and row as seen from robot 0, heading in quarter turns, and whether it misses the others.
type Robot = (i8, i8, u8, bool);

impl Swarm {
    /// Whether there are fewer than α robots within the range of one.
    fn is_lost(&self, robots: &[Robot], me: usize) -> bool {
        let apart = |one: i8, other: i8| {
            let steps = (one - other).rem_euclid(self.width);
            steps.min(self.width - steps)
        };
        let is_near = |&&(column, row, ..): &&Robot| {
            apart(column, robots[me].0) <= self.range && apart(row, robots[me].1) <= self.range
        };
        robots.iter().filter(is_near).count() <= self.alpha
    }

    /// Whether nothing tells one robot from another. Then robot 0 stands for each of them: what can be owed to another
    /// one for ever is owed to robot 0 in the run in which the two have changed places.
    fn are_alike(&self) -> bool {
        self.moves == Moves::Together
    }

    /// The swarm as seen from robot 0.
    fn seen(&self, robots: &[Robot]) -> Vec<Robot> {
        let (column, row, ..) = robots[0];
        let from = |at: i8, zero: i8| (at - zero).rem_euclid(self.width);
        let seen = |&(x, y, way, misses): &Robot| (from(x, column), from(y, row), way, misses);
        robots.iter().map(seen).collect()
    }
}

impl Conditions {
    /// The ways that a robot may go: one, or two.
    fn ways(self, swarm: &Swarm, robots: &[Robot], me: usize) -> Vec<Robot> {
        let ((column, row, heading, misses), now) = (robots[me], swarm.is_lost(robots, me));
        let turns: &[u8] = match (misses, now) {
            (true, true) if !self.goes_on => return vec![robots[me]],
            (false, true) if self.turns_back => &[2],
            (true, false) if self.turns_aside => &[1, 3],
            _ => &[0],
        };
        let go = |turn: &u8| {
            let heading = (heading + turn) % 4;
            let (columns, rows) = WAYS[usize::from(heading)];
            (column + columns, row + rows, heading, now)
        };
        turns.iter().map(go).collect()
    }
}

impl Protocol for Conditions {
    type Bound = Swarm;
    type State = Vec<Robot>;
    demands! {
        again_and_again "every robot is connected", |_, swarm, robots| {
            let watched = if swarm.are_alike() { 1 } else { robots.len() };
            set((0..watched).filter(|&me| swarm.is_lost(robots, me)))
        };
    }

    /// Of those that are alike one: robot 0 heads east, and robots that are alike stand in their order.
    fn starts(&self, swarm: &Swarm) -> impl IntoIterator<Item = Vec<Robot>> {
        let cells = |me: usize| {
            let side = 0..if me == 0 { 1 } else { swarm.width };
            side.clone().flat_map(move |x| side.clone().map(move |y| (x, y, 0, false))).collect()
        };
        let is_meant = |robots: &Vec<Robot>| {
            let is_first = !swarm.are_alike() || robots[1..].is_sorted();
            is_first && !(0..robots.len()).any(|me| swarm.is_lost(robots, me))
        };
        let headings = |robots: Vec<Robot>| {
            let any = |(me, &(x, y, ..)): (usize, &Robot)| {
                (0..if me == 0 { 1 } else { 4 }).map(|way| (x, y, way, false)).collect()
            };
            combinations(robots.iter().enumerate().map(any).collect::<Vec<_>>())
        };
        combinations((0..swarm.robots).map(cells)).filter(is_meant).flat_map(headings)
    }

    fn moves(&self, swarm: &Swarm, robots: &Vec<Robot>) -> Vec<Move<Vec<Robot>>> {
        let act = |actors: Bits| {
            let acted = |(me, &robot): (usize, &Robot)| match actors >> me & 1 {
                1 => self.ways(swarm, robots, me),
                _ => vec![robot],
            };
            let all = combinations(robots.iter().enumerate().map(acted).collect::<Vec<_>>());
            all.map(move |to| Move::of_set(actors, "go", swarm.seen(&to)))
        };
        swarm.moves.sets(robots.len()).flat_map(act).collect()
    }

    /// The floor in its quarter turns, as the rule knows no direction; and the robots but robot 0 in one order.
    fn alike(&self, swarm: &Swarm, robots: &Vec<Robot>) -> Vec<Vec<Robot>> {
        let turn = |&(x, y, heading, misses): &Robot| (-y, x, (heading + 1) % 4, misses);
        let mut all = turned(robots, |robots| swarm.seen(&robots.iter().map(turn).collect::<Vec<_>>()));
        if swarm.are_alike() {
            all.push(robots.clone());
            for robots in &mut all {
                robots[1..].sort_unstable();
            }
        }
        all
    }

    fn draw(&self, swarm: &Swarm, robots: &Vec<Robot>) -> String {
        let at = |x, y| robots.iter().find(|robot| (robot.0, robot.1) == (x, y));
        arrows(swarm.width, |x, y| at(x, y).map(|robot| robot.2))
    }
}

/// Two robots on 6×6 cells.
pub const SWARM: Swarm = Swarm { robots: 2, width: 6, range: 1, alpha: 1, moves: Moves::Together };
/// The published rule.
pub const RULE: Conditions = Conditions { goes_on: true, turns_back: true, turns_aside: true };

entry! { Conditions: "alpha", "Alpha", "ALPHA",
    "Winfield, Liu, Nembrini, Martinoli, *Modelling a Wireless Connected Swarm of Mobile Robots*, Swarm \
     Intelligence 2, 2008; the model is ours, after that of Antuña, Araiza-Illan, Campos, Eder, arXiv 1505.05695, \
     2015";
    PUBLISHED = "published", RULE;
    STANDS = "stands when lost", Conditions { goes_on: false, turns_back: false, ..RULE };
    1: "Every robot MUST be connected again and again." {
        Holds PUBLISHED within SWARM, not STANDS;
        Refuted PUBLISHED within Swarm { moves: Moves::OneAtATime, ..SWARM };
        Refuted PUBLISHED within Swarm { robots: 3, ..SWARM };
    } larger {
        Refuted PUBLISHED within Swarm { robots: 3, width: 16, ..SWARM };
    }
}
