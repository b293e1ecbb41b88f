//! Robots that keep in touch (Peiris) in continuous time: the kernel's team, a layout that answers for what they see,
//! and speeds. A cell of the layout is a node, 3 m from the next one.
//!
//! A decision, a look, a turn and a message take no time, and every drive takes a path's length over the robot's speed.
//! Chance decides which of several sides a robot takes and how fast it drives. It is drawn from `ChaCha8`, seeded
//! with the seed of the run as layouts are, with the tag `kit`. Times are whole milliseconds, and lengths whole
//! millimetres.

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZeroU32;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, MediumGrid, Side, SmallGrid};
use tautline_kernel::kit::{Condition, Kit, Next, Reach, Rule, SetupError, Sight, Stance, touch};

use tautline_grids::chance::Dice;
use tautline_grids::layout::Layout;

/// From a node to the next.
pub const PATH_MILLIMETRES: i64 = 3000;

/// As far as two robots hear each other in the paper.
pub const REACH_MILLIMETRES: i64 = 10_000;

/// As far as two robots hear each other.
pub fn reach_millimetres(reach: Reach) -> i64 {
    match reach {
        Reach::PAPER => REACH_MILLIMETRES,
        _ => i64::from(reach.squared().isqrt()) * PATH_MILLIMETRES,
    }
}

/// How far beyond the next node a robot sees.
const BEYOND_MILLIMETRES: i64 = 500;

/// The most robots that are let run together.
pub const MOST_ROBOTS: usize = 8;

/// Nodes of the areas of which the plans are small.
const FEW_NODES: usize = 16 * 16;
const MOST_NODES: usize = 64 * 64;

/// How fast robots drive.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Pace {
    /// Millimetres a second.
    pub speed: NonZeroU32,
    /// So many thousandths a drive may be faster or slower, each as likely: less than 1000.
    pub spread: u32,
}

impl Pace {
    /// The greatest spread.
    pub const MOST_SPREAD: u32 = 999;

    /// The paper gives no speed: 0.3 m/s, always.
    pub const STEADY: Self = Self { speed: NonZeroU32::new(300).expect("not 0"), spread: 0 };

    /// How long a drive takes, in milliseconds.
    fn milliseconds(self, dice: &mut Dice) -> u64 {
        let fastest = 1000 - self.spread;
        let thousandths = if self.spread == 0 { 1000 } else { fastest + dice.pick(2 * self.spread + 1) };
        let speed = u64::from(self.speed.get()) * u64::from(thousandths);
        (PATH_MILLIMETRES as u64 * 1_000_000 / speed).max(1)
    }
}

/// A drive over a path.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Drive {
    /// Whose.
    pub robot: usize,
    /// From this node.
    pub from: Cell,
    /// To this one.
    pub to: Cell,
    /// When it begins and when it ends, in milliseconds.
    pub time: [u64; 2],
    /// Whether nobody had driven the path.
    pub is_new: bool,
}

/// A run of a team.
pub trait Course {
    /// The next drive that begins; `None` when nobody drives and nobody can decide.
    fn drive(&mut self) -> Option<Drive>;

    /// Where the robots are that have entered.
    fn stances(&self) -> Vec<Stance>;

    /// Whether every robot knows that the team is done.
    fn is_over(&self) -> bool;

    /// Whether robots ever know that.
    fn knows_its_end(&self) -> bool;

    /// Milliseconds since the start.
    fn clock(&self) -> u64;

    /// The paths that were driven, with a bit for each robot that has driven them.
    fn driven(&self) -> &BTreeMap<Edge, u16>;

    /// Whether the sides of the node that `robot` was at last can be driven, as it has recorded them.
    fn recorded(&self, robot: usize) -> Vec<(Edge, bool)>;

    /// The farthest that robots have been apart, where each is as near as it can be to those that are linked with
    /// another: squared, in square millimetres.
    fn apart(&self) -> i64;
}

/// The run of a team in `layout`, a robot in each of `starts`.
///
/// # Errors
/// [`SetupError`] if it cannot start so.
pub fn course(
    rule: Rule,
    layout: &Layout,
    starts: &[Cell],
    pace: Pace,
    seed: u64,
) -> Result<Box<dyn Course>, SetupError> {
    let area = layout.size().area();
    let world = (layout, pace, seed);
    match (SmallGrid::new(area), MediumGrid::new(area)) {
        (Some(map), _) => Ok(Box::new(Run::<_, FEW_NODES>::new(rule, map, starts, world)?)),
        (None, Some(map)) => Ok(Box::new(Run::<_, MOST_NODES>::new(rule, map, starts, world)?)),
        (None, None) => {
            Err(SetupError::TooManyNodes { nodes: area.width() * area.height(), most: MOST_NODES })
        }
    }
}

struct Run<G, const NODES: usize> {
    kit: Kit<G, MOST_ROBOTS, NODES>,
    layout: Layout,
    pace: Pace,
    dice: Dice,
    clock: u64,
    /// When each drive has begun and will end.
    times: [[u64; 2]; MOST_ROBOTS],
    driven: BTreeMap<Edge, u16>,
    apart: i64,
}

impl<G: Grid + Copy, const NODES: usize> Run<G, NODES> {
    fn new(
        rule: Rule,
        map: G,
        starts: &[Cell],
        (layout, pace, seed): (&Layout, Pace, u64),
    ) -> Result<Self, SetupError> {
        Ok(Self {
            kit: Kit::new(rule, map, starts)?,
            layout: layout.clone(),
            pace,
            dice: Dice::new(seed, *b"kit     "),
            clock: 0,
            times: [[0; 2]; MOST_ROBOTS],
            driven: BTreeMap::new(),
            apart: 0,
        })
    }

    /// Where a robot is now, in millimetres east and south of the first node.
    fn position(&self, robot: usize, stance: Stance) -> [i64; 2] {
        let at = |node: Cell| [node.x, node.y].map(|number| i64::from(number) * PATH_MILLIMETRES);
        let Stance::Drives { from, to } = stance else { return at(stance.to()) };
        let [begin, end] = self.times[robot];
        let (gone, whole) = ((self.clock - begin) as i64, (end - begin) as i64);
        let (from, to) = (at(from), at(to));
        std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * gone / whole)
    }

    /// Notes how far apart the robots are. In between it is less than at one of the ends, since distance is convex
    /// where both robots keep their speeds.
    fn note(&mut self) {
        let positions: Vec<[i64; 2]> =
            self.kit.stances().enumerate().map(|(robot, stance)| self.position(robot, stance)).collect();
        self.apart = self.apart.max(widest_gap(&positions));
    }

    /// The sight that `robot` has from `node` at `side`.
    fn sight(&self, robot: usize, node: Cell, side: Side) -> Sight {
        if !self.layout.is_open(Edge::new(node, side)) {
            return Sight::Obstacle;
        }
        let ahead = self.position(robot, Stance::Stands(node.beyond(side)));
        let is_seen = |(other, stance): (usize, Stance)| {
            other != robot
                && touch(node, side, stance).unwrap_or_else(|| {
                    squared(ahead, self.position(other, stance)) <= BEYOND_MILLIMETRES.pow(2)
                })
        };
        if self.kit.stances().enumerate().any(is_seen) { Sight::Robot } else { Sight::Free }
    }

    /// The drive with which the decision of `robot` ends, if it does so.
    fn decide(&mut self, robot: usize) -> Option<Drive> {
        let from = self.kit.stance(robot)?.to();
        let mut next = self.kit.decide(robot, &mut self.dice).ok()?;
        while let Next::Looks(side) = next {
            let sight = self.sight(robot, from, side);
            next = self.kit.looked(robot, sight, &mut self.dice).ok()?;
        }
        let Next::Drives(to) = next else { return None };
        let time = [self.clock, self.clock + self.pace.milliseconds(&mut self.dice)];
        self.times[robot] = time;
        let side = Side::ALL.into_iter().find(|&side| from.beyond(side) == to)?;
        let robots = self.driven.entry(Edge::new(from, side)).or_default();
        let is_new = *robots == 0;
        *robots |= 1 << robot;
        Some(Drive { robot, from, to, time, is_new })
    }
}

impl<G: Grid + Copy + 'static, const NODES: usize> Course for Run<G, NODES> {
    fn drive(&mut self) -> Option<Drive> {
        loop {
            let robots = 0..self.kit.robots().len();
            while let Some(robot) = robots.clone().find(|&robot| self.kit.may_decide(robot)) {
                if let Some(drive) = self.decide(robot) {
                    return Some(drive);
                }
            }
            let is_driving = |robot: &usize| self.kit.stance(*robot).is_some_and(|stance| !stance.stands());
            let (end, robot) = robots.filter(is_driving).map(|robot| (self.times[robot][1], robot)).min()?;
            self.clock = end;
            self.note();
            self.kit.arrived(robot).ok()?;
        }
    }

    fn stances(&self) -> Vec<Stance> {
        self.kit.stances().collect()
    }

    fn is_over(&self) -> bool {
        self.kit.is_over()
    }

    fn knows_its_end(&self) -> bool {
        self.kit.rule().has(Condition::Regroup)
    }

    fn clock(&self) -> u64 {
        self.clock
    }

    fn driven(&self) -> &BTreeMap<Edge, u16> {
        &self.driven
    }

    fn recorded(&self, robot: usize) -> Vec<(Edge, bool)> {
        let (Some(record), Some(stance)) = (self.kit.records().get(robot), self.kit.stance(robot)) else {
            return Vec::new();
        };
        let node = stance.from();
        let sides = Side::ALL.into_iter().filter(|&side| record.area().contains(node.beyond(side)));
        let recorded = |side: Side| {
            let edge = Edge::new(node, side);
            let is_open = record.edge_has(EdgeMark::Open, edge);
            (is_open || record.edge_has(EdgeMark::Wall, edge)).then_some((edge, is_open))
        };
        sides.filter_map(recorded).collect()
    }

    fn apart(&self) -> i64 {
        self.apart
    }
}

fn squared(one: [i64; 2], other: [i64; 2]) -> i64 {
    (one[0] - other[0]).pow(2) + (one[1] - other[1]).pow(2)
}

/// The longest link of the shortest links that connect all positions, squared: they are a network of this reach.
fn widest_gap(positions: &[[i64; 2]]) -> i64 {
    let Some((&first, rest)) = positions.split_first() else { return 0 };
    let mut far: Vec<(i64, [i64; 2])> = rest.iter().map(|&other| (squared(first, other), other)).collect();
    let mut widest = 0;
    while let Some(nearest) = (0..far.len()).min_by_key(|&place| far[place]) {
        let (gap, linked) = far.swap_remove(nearest);
        widest = widest.max(gap);
        for (gap, position) in &mut far {
            *gap = (*gap).min(squared(linked, *position));
        }
    }
    widest
}

/// The open sides within reach of `start`, by the paths across them.
pub fn paths(layout: &Layout, start: Cell) -> Vec<Edge> {
    let sides = layout.spread(&[start]).flat_map(|node| Side::ALL.map(|side| Edge::new(node, side)));
    let paths: BTreeSet<Edge> = sides.filter(|&side| layout.is_open(side)).collect();
    paths.into_iter().collect()
}

/// The nodes nearest to `base`, the base first, in which a team of so many can start: each in one of its own, near
/// enough to hear one before it. Fewer if there are not so many.
pub fn starts(layout: &Layout, base: Cell, robots: usize) -> Vec<Cell> {
    layout.spread(&[base]).take(robots).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tautline_grids::layout::Generator;

    /// Runs a team in layouts of this kind; the drives, and how many runs end before every path is driven, or not at
    /// all.
    fn runs(rule: Rule, kind: &str, robots: usize, seeds: std::ops::Range<u64>) -> (usize, usize) {
        let generator: Generator = kind.parse().expect("a generator");
        let (mut drives, mut ended) = (0, 0);
        for seed in seeds {
            let layout = generator.generate(seed).expect("a layout");
            let base = layout.default_base().expect("a free cell");
            let starts = starts(&layout, base, robots);
            if starts.len() < robots {
                continue;
            }
            let due = paths(&layout, base);
            let pace = Pace { spread: 100, ..Pace::STEADY };
            let mut course = course(rule, &layout, &starts, pace, seed).expect("a team");
            let mut made = 0;
            while course.drive().is_some() && made < 200 * due.len() + 200 {
                made += 1;
            }
            assert!(course.apart() <= REACH_MILLIMETRES.pow(2), "{kind}, seed {seed}: out of contact");
            drives += made;
            let nodes: std::collections::BTreeSet<Cell> =
                due.iter().flat_map(|path| [path.cell(), path.cell().beyond(path.side())]).collect();
            let is_whole = course.is_over() && course.driven().len() == due.len();
            ended += usize::from(!is_whole && nodes.len() > robots);
        }
        (drives, ended)
    }

    #[test]
    fn three_robots_and_more_drive_every_path() {
        for robots in [3, 4, 8] {
            for kind in ["walls:5x4:0.2", "walls:9x3:0.4", "walls:8x8:0.1", "walls:10x2:0.2"] {
                let (drives, ended) = runs(Rule::REPAIRED, kind, robots, 0..20);
                assert_eq!(ended, 0, "{kind}, {robots} robots, {drives} drives");
            }
        }
    }

    #[test]
    fn robots_that_radio_alone_binds_leave_paths_undriven() {
        let rule = Rule::REPAIRED.without(Condition::Tether);
        assert!((0..40).any(|seed| runs(rule, "walls:15x15:0.3", 3, seed..seed + 1).1 > 0));
    }

    #[test]
    #[ignore = "takes minutes: cargo test --release -p tautline-sim -- --ignored --nocapture thousands_of_teams"]
    fn thousands_of_teams_drive_every_path() {
        for kind in ["walls:5x4:0.2", "walls:9x3:0.4", "walls:15x15:0.1", "walls:15x15:0.3"] {
            for robots in [3, 4, 8] {
                let (drives, ended) = runs(Rule::REPAIRED, kind, robots, 0..1000);
                println!("{kind}, {robots} robots: {drives} drives, {ended} of 1000 not whole");
                assert_eq!(ended, 0, "{kind}, {robots} robots");
            }
        }
    }
}
