//! The Alpha rule for swarms that stay together: Winfield, Liu, Nembrini and Martinoli (Swarm Intelligence 2, 2008);
//! model checked by Dixon, Winfield, Fisher and Zeng (Robotics and Autonomous Systems 60, 2012) and, with symmetry, by
//! Antuña, Araiza-Illan, Campos and Eder (2015). A robot goes forward. If fewer than α robots are within its range
//! since its last step, it turns back; once there are α of them again, it turns left or right.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Conditions {
    /// A robot that misses the others goes on.
    goes_on: bool,
    /// A robot that loses the others turns back.
    turns_back: bool,
    /// A robot that has found them again turns left or right.
    turns_aside: bool,
}

/// Robots on a grid without rim, so many cells wide and high; the range of each in cells, in both directions.
struct Swarm {
    robots: usize,
    width: i8,
    range: i8,
    alpha: usize,
    moves: Moves,
}

impl fmt::Display for Swarm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { robots, width, range, alpha, moves } = self;
        write!(f, "{robots} robots, {width}×{width} cells without rim, range {range}, α = {alpha}, ")?;
        write!(f, "every connected start, {moves}")
    }
}

struct Robots(Conditions, &'static Swarm);

/// Column and row as seen from robot 0, heading in quarter turns, and whether it misses the others.
type Robot = (i8, i8, u8, bool);

impl Robots {
    /// Robots that are within the range of one.
    fn near(&self, robots: &[Robot], me: usize) -> usize {
        let apart = |one: i8, other: i8| {
            let steps = (one - other).rem_euclid(self.1.width);
            steps.min(self.1.width - steps)
        };
        let is_near = |&(column, row, ..): &Robot| {
            apart(column, robots[me].0) <= self.1.range && apart(row, robots[me].1) <= self.1.range
        };
        robots.iter().filter(|robot| is_near(robot)).count() - 1
    }

    /// The ways that a robot may go: one, or two.
    fn ways(&self, robots: &[Robot], me: usize) -> Vec<Robot> {
        let (column, row, heading, misses) = robots[me];
        let now = self.near(robots, me) < self.1.alpha;
        let turns: &[u8] = match (misses, now) {
            (false, true) if self.0.turns_back => &[2],
            (true, false) if self.0.turns_aside => &[1, 3],
            _ => &[0],
        };
        if now && misses && !self.0.goes_on {
            return vec![robots[me]];
        }
        let go = |turn: &u8| {
            let heading = (heading + turn) % 4;
            let (columns, rows) = WAYS[usize::from(heading)];
            (column + columns, row + rows, heading, now)
        };
        turns.iter().map(go).collect()
    }

    /// Whether nothing tells one robot from another. Then robot 0 stands for each of them: what can be owed to another
    /// one for ever is owed to robot 0 in the run in which the two have changed places.
    fn are_alike(&self) -> bool {
        self.1.moves == Moves::Together
    }

    /// The swarm as seen from robot 0.
    fn seen(&self, robots: &[Robot]) -> Vec<Robot> {
        let (column, row, ..) = robots[0];
        let from = |at: i8, zero: i8| (at - zero).rem_euclid(self.1.width);
        let seen = |&(x, y, way, misses): &Robot| (from(x, column), from(y, row), way, misses);
        robots.iter().map(seen).collect()
    }
}

impl Protocol for Robots {
    type Rule = Conditions;
    type Bound = &'static Swarm;
    type State = Vec<Robot>;
    const DEMANDS: &'static [Demand<Self>] =
        &[Demand::again_and_again("every robot is connected", |swarm, robots: &Vec<Robot>| {
            let is_lost = |&me: &usize| swarm.near(robots, me) < swarm.1.alpha;
            let watched = if swarm.are_alike() { 1 } else { robots.len() };
            set((0..watched).filter(is_lost))
        })];

    fn new(&rule: &Conditions, bound: &&'static Swarm) -> Result<Self, MethodError> {
        Ok(Self(rule, bound))
    }

    fn starts(&self) -> impl Iterator<Item = Vec<Robot>> {
        let width = i16::from(self.1.width);
        let at = |cell| (0..4).map(move |way| ((cell % width) as i8, (cell / width) as i8, way, false));
        let any: Vec<Robot> = (0..width * width).flat_map(at).collect();
        combinations((0..self.1.robots).map(move |me| any[..if me == 0 { 4 } else { any.len() }].to_vec()))
            .filter(|robots| (0..robots.len()).all(|me| self.near(robots, me) >= self.1.alpha))
    }

    fn moves(&self, robots: &Vec<Robot>) -> Vec<Move<Vec<Robot>>> {
        let act = |actors: Bits| {
            let ways = move |me: usize| {
                if actors >> me & 1 == 1 { self.ways(robots, me) } else { vec![robots[me]] }
            };
            let to = combinations((0..robots.len()).map(ways));
            to.map(move |to| Move { actors, words: "go", to: self.seen(&to) })
        };
        self.1.moves.sets(robots.len()).flat_map(act).collect()
    }

    /// The floor in its quarter turns, as the rule knows no direction; and the robots but robot 0 in one order.
    fn alike(&self, robots: &Vec<Robot>) -> Vec<Vec<Robot>> {
        let turn = |&(x, y, heading, misses): &Robot| (-y, x, (heading + 1) % 4, misses);
        let mut all = turned(robots, |robots| self.seen(&robots.iter().map(turn).collect::<Vec<_>>()));
        if self.are_alike() {
            all.push(robots.clone());
            for robots in &mut all {
                robots[1..].sort_unstable();
            }
        }
        all
    }

    fn draw(&self, robots: &Vec<Robot>) -> String {
        let at = |x, y| robots.iter().find(|robot| (robot.0, robot.1) == (x, y));
        arrows(self.1.width, |x, y| at(x, y).map(|robot| robot.2))
    }
}

const SWARM: Swarm = Swarm { robots: 2, width: 6, range: 1, alpha: 1, moves: Moves::Together };
const ONE_BY_ONE: Swarm = Swarm { moves: Moves::OneAtATime, ..SWARM };
const THREE: Swarm = Swarm { robots: 3, ..SWARM };
const RULE: Conditions = Conditions { goes_on: true, turns_back: true, turns_aside: true };
const PUBLISHED: NamedRule<Conditions> = NamedRule::new("published", RULE);
const STANDS: NamedRule<Conditions> =
    NamedRule::new("stands when lost", Conditions { goes_on: false, turns_back: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "alpha",
    title: "Alpha",
    source: "Winfield, Liu, Nembrini, Martinoli, *Modelling a Wireless Connected Swarm of Mobile Robots*, Swarm \
             Intelligence 2, 2008; the model is ours, after that of Antuña, Araiza-Illan, Campos, Eder, arXiv 1505.05695, 2015",
    promises: &[promise(
        "ALPHA-1",
        "Every robot MUST be connected again and again.",
        &[
            &Check::new(PUBLISHED, &Keeps::<Robots>(&SWARM, 0), Holds, &[STANDS]),
            &Check::new(PUBLISHED, &Keeps::<Robots>(&ONE_BY_ONE, 0), Refuted, &[]),
            &Check::new(PUBLISHED, &Keeps::<Robots>(&THREE, 0), Refuted, &[]),
        ],
    )
    .larger(&[&Check::new(PUBLISHED, &Keeps::<Robots>(&Swarm { width: 16, ..THREE }, 0), Refuted, &[])])],
};
