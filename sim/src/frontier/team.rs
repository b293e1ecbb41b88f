//! A team of the kernel's robots in a layout.

use std::collections::BTreeSet;

use tautline_kernel::frontier::{
    Condition, Map, Next, Other, Place, Robot, Rule, Seeker, Sight, Slot, Status, Ties, View, taken_for,
};
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_kernel::position::{Belief, Point, Sighting};
use tautline_proofs::frontier::has_more;
use tautline_proofs::run::Frame;

use super::chart::{Chart, Memory};
use super::place::{cell_at, cell_of, place_of};
use super::radio::{Pose, Radio};
use super::waves::{Knowledge, Waves};
use super::{Moves, PATIENCE, TeamEnd};
use crate::options::Options;
use tautline_grids::layout::Layout;

/// A team of robots that explore cells.
#[derive(Clone, Debug)]
pub struct Explorers {
    rule: Rule,
    layout: Layout,
    robots: Vec<Robot<Chart>>,
    /// Where the robots really are.
    cells: Vec<Cell>,
    poses: Vec<Pose>,
    /// By robot: what the others have told it, itself among them.
    told: Vec<Vec<Other>>,
    /// By robot: how much of each other one's repository it has heard.
    heard: Vec<Vec<usize>>,
    radio: Radio,
    memory: Memory,
    waves: Waves,
    slot: usize,
    /// Team moves since the last news.
    idle: usize,
    /// How often a robot has stood to take another fix.
    stands: usize,
    /// Who has stood for it in the last team move.
    unsure: Vec<usize>,
    /// The sides with an obstacle that is smaller than a cell.
    small: BTreeSet<Edge>,
    /// By robot, on its way through which side it has gone round one.
    detours: Vec<Option<Edge>>,
    /// Objects, and where the robots that were in their cells take them to be, together.
    objects: Vec<(Point, Option<Sighting>)>,
    /// The cells that a robot was in.
    entered: Chart,
    /// Whether a robot has noted in the last team move what is not so.
    is_wrong: bool,
    /// Whether one has entered in it as its frontier cell what a robot had entered before.
    is_again: bool,
    /// How much each robot knew before the last team move: nothing before the first one.
    known: Vec<usize>,
    /// Who has told something in the last team move, and who has not heard it.
    told_now: Vec<(usize, Vec<usize>)>,
    /// The robot that has died.
    dead: Option<usize>,
}

impl Explorers {
    /// A team in these starts.
    pub fn new(rule: Rule, layout: &Layout, starts: &[Cell], options: Options, seed: u64) -> Self {
        let area = layout.size().area();
        let rule = Rule { threshold: options.threshold(), ..rule };
        let robot = |&start: &Cell| Robot::new(Chart::new(area), start, starts);
        let robots: Vec<Robot<Chart>> = starts.iter().map(robot).collect();
        let other = |&cell: &Cell| Other { cell, place: Place::midpoint(cell), aim: None };
        let entered = robots.first().map_or_else(|| Chart::new(area), |robot| robot.map.clone());
        let heard = robots.iter().map(|robot| robot.map.len()).collect();
        let radio = Radio::new(options, area, seed);
        let small = radio.small(area, seed);
        let knowledge = if radio.is_whole() { Knowledge::Common } else { Knowledge::Own };
        Self {
            rule,
            layout: layout.clone(),
            cells: starts.to_vec(),
            poses: starts.iter().copied().map(Pose::start).collect(),
            told: vec![starts.iter().map(other).collect(); starts.len()],
            heard: vec![heard; starts.len()],
            radio,
            memory: Memory::new(area, starts.len()),
            waves: Waves::new(knowledge, starts.len()),
            robots,
            slot: 0,
            idle: 0,
            stands: 0,
            unsure: Vec::new(),
            small,
            detours: vec![None; starts.len()],
            objects: Vec::new(),
            entered,
            is_wrong: false,
            is_again: false,
            known: Vec::new(),
            told_now: Vec::new(),
            dead: None,
        }
    }

    /// Where the robots are.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Whether a robot has noted in the last team move what is not so.
    pub const fn has_false_note(&self) -> bool {
        self.is_wrong
    }

    /// Whether a robot has entered as its frontier cell in the last team move what a robot had entered before.
    pub const fn has_entered_again(&self) -> bool {
        self.is_again
    }

    /// Whether positions have an error.
    pub fn is_noisy(&self) -> bool {
        self.radio.is_noisy()
    }

    /// The cells of the robots that have stood in the last team move, to take another fix.
    pub fn unsure(&self) -> impl Iterator<Item = Cell> {
        self.unsure.iter().map(|&robot| self.cells[robot])
    }

    /// By robot where it is and where it takes itself to be, in sides of a cell, and its last fix.
    pub fn poses(&self) -> impl Iterator<Item = (Point, &Belief, Option<Sighting>)> {
        self.poses.iter().map(|pose| (pose.at, &pose.belief, pose.fixed))
    }

    /// Whether there are obstacles that are smaller than a cell.
    pub fn has_small(&self) -> bool {
        !self.small.is_empty()
    }

    /// The sides on their way through which robots have gone round an obstacle that is smaller than a cell.
    pub fn detours(&self) -> impl Iterator<Item = Edge> {
        self.detours.iter().copied().flatten()
    }

    /// How far robots are from where they take themselves to be, in sides of a cell.
    pub fn errors(&self) -> impl Iterator<Item = f64> {
        self.poses().map(|(at, belief, _)| at.distance_m(belief.at()))
    }

    /// This team among objects at these places, in sides of a cell: a robot sees those in each cell that it enters.
    #[must_use]
    pub fn among(mut self, objects: impl IntoIterator<Item = Point>) -> Self {
        self.objects = objects.into_iter().map(|object| (object, None)).collect();
        self
    }

    /// A robot sees the objects in the cell that it is in.
    fn look_around(&mut self, robot: usize) {
        let Self { objects, radio, poses, cells, .. } = self;
        for (object, known) in objects.iter_mut().filter(|(object, _)| cell_at(*object) == cells[robot]) {
            let seen = radio.sees(&poses[robot], *object);
            *known = Some(known.map_or(seen, |known| known.merged(seen)));
        }
    }

    /// This team after each robot has looked around in its start.
    #[must_use]
    pub fn looked_around(mut self) -> Self {
        (0..self.robots.len()).for_each(|robot| self.look_around(robot));
        self
    }

    /// Objects, and where the robots that have seen them take them to be, together.
    pub fn objects(&self) -> &[(Point, Option<Sighting>)] {
        &self.objects
    }

    /// How often a robot has stood for a team move, to take another fix.
    pub const fn stands(&self) -> usize {
        self.stands
    }

    /// How far messages are heard, if not everywhere.
    pub const fn range_cells(&self) -> Option<u16> {
        self.radio.range_cells()
    }

    /// By robot what it has learned in the last team move, and in the first one with what it knew before: where all
    /// start.
    pub fn news(&self) -> impl Iterator<Item = (usize, &[(Cell, Status)])> {
        let known = |robot: usize| self.known.get(robot).copied().unwrap_or(0);
        self.robots.iter().enumerate().map(move |(robot, own)| (robot, own.map.learned(known(robot))))
    }

    /// The cells that robots have claimed.
    pub fn claims(&self) -> impl Iterator<Item = Cell> {
        self.robots.iter().filter_map(Robot::aim)
    }

    /// Who has told something in the last team move, and who has not heard the last of it.
    pub fn told(&self) -> impl Iterator<Item = (usize, &Vec<usize>)> {
        self.told_now.iter().map(|(from, deaf)| (*from, deaf))
    }

    /// A robot dies: it stands where it is, and from now on neither goes nor tells anything. The others do not know it
    /// before they meet it.
    pub fn dies(&mut self, robot: usize) {
        self.dead = Some(robot);
        // A body that is met makes ways longer, of which waves that serve all robots know nothing.
        self.waves = Waves::new(Knowledge::Own, self.robots.len());
    }

    /// Makes a team move.
    ///
    /// # Errors
    /// [`TeamEnd`] if there is none.
    pub fn advance(&mut self) -> Result<Frame, TeamEnd> {
        self.advance_by(Self::next)
    }

    /// Makes a team move, each robot by what `next` says of it.
    fn advance_by(&mut self, next: impl Fn(&mut Self, usize) -> Next) -> Result<Frame, TeamEnd> {
        let (robots, dead) = (self.robots.len(), self.dead);
        let living = || (0..robots).filter(|&robot| dead != Some(robot));
        let mut moves = Moves::none(robots);
        (self.is_wrong, self.is_again) = (false, false);
        self.told_now.clear();
        let known: Vec<usize> = self.robots.iter().map(|robot| robot.map.len()).collect();
        let before: usize = known.iter().sum();
        self.known = if self.known.is_empty() { vec![0; robots] } else { known };
        let mut does_any = false;
        let mut entering: Vec<Option<(Cell, Pose)>> = vec![None; robots];
        // Who stands, and who tries a frontier cell.
        let (mut stands, mut tries) = (vec![false; robots], vec![false; robots]);
        for robot in living() {
            let next = next(self, robot);
            does_any |= matches!(next, Next::Tries { .. } | Next::Waits);
            let Next::Tries { side, aim } = next else { continue };
            let to = self.robots[robot].at().beyond(side);
            tries[robot] = self.robots[robot].map.status(to) == Status::Unexplored;
            if self.radio.is_noisy() && !self.rule.may_go(&self.poses[robot].belief, to, &self.radio.odometry)
            {
                stands[robot] = true;
                continue;
            }
            self.robots[robot].tries(side, aim);
            if self.rule.has(Condition::Claim) {
                self.tell(robot);
            }
            let (sight, to) = self.look(robot, side, &entering);
            self.robots[robot].looked(&self.rule, sight);
            match sight {
                Sight::Open => {
                    moves.goes(robot, side);
                    entering[robot] = Some(to);
                }
                Sight::Small if self.rule.has(Condition::Detour) => self.poses[robot] = to.1,
                Sight::Obstacle | Sight::Small | Sight::Robot | Sight::Silent => {
                    self.poses[robot] = to.1;
                    if matches!(sight, Sight::Obstacle | Sight::Small) {
                        moves.bumps(robot, side);
                    }
                    self.note(robot, self.robots[robot].at().beyond(side));
                    self.tell(robot);
                }
            }
        }
        if !does_any {
            let know_all = living().all(|robot| !has_more(&self.robots[robot].map, self.robots[robot].at()));
            return Err(if know_all { TeamEnd::Known } else { TeamEnd::Still });
        }
        for (robot, to) in entering.into_iter().enumerate() {
            if stands[robot] {
                let at = self.robots[robot].at();
                self.radio.takes_fix(&self.rule, &mut self.poses[robot], at);
            }
            let Some((cell, pose)) = to else { continue };
            (self.cells[robot], self.poses[robot], self.detours[robot]) = (cell, pose, None);
            self.is_again |= tries[robot] && self.entered.status(cell) == Status::Explored;
            self.entered.learn(cell, Status::Explored);
            if self.radio.is_noisy() {
                let counted = self.robots[robot].entering();
                self.radio.takes_fix(&self.rule, &mut self.poses[robot], counted);
            }
            self.look_around(robot);
            let fix = self.poses[robot].fix();
            self.robots[robot].arrived(&self.rule, taken_for(self.layout.size().area(), fix));
            self.note(robot, self.robots[robot].at());
        }
        self.unsure = (0..robots).filter(|&robot| stands[robot]).collect();
        self.stands += self.unsure.len();
        living().for_each(|robot| self.tell(robot));
        self.slot = (self.slot + 1) % robots.max(1);
        let after: usize = self.robots.iter().map(|robot| robot.map.len()).sum();
        self.idle = if after == before { self.idle + 1 } else { 0 };
        if self.idle > PATIENCE * self.layout.size().cells() {
            return Err(TeamEnd::Idle);
        }
        Ok(moves.frame(&self.cells))
    }

    fn slot(&self, robot: usize) -> Slot {
        if self.slot == robot { Slot::Own } else { Slot::Others }
    }

    /// The next action of a robot. Where robots are paired with cells, the waves of the whole team tell it.
    fn next(&mut self, robot: usize) -> Next {
        if !self.rule.has(Condition::Route) || self.rule.ties == Ties::Any {
            return self.next_alone(robot);
        }
        let seeker = |other: &Other| Seeker { cell: other.cell, aim: other.aim };
        let mut seekers: Vec<Seeker> = self.told[robot].iter().map(seeker).collect();
        let own = &self.robots[robot];
        seekers[robot] = Seeker { cell: own.at(), aim: own.aim() };
        let way = self.waves.way(&own.map, &self.rule, robot, own.is_bound(&self.rule), &seekers);
        own.follows(&self.rule, way, self.slot(robot))
    }

    /// The next action of a robot by the rule of one robot.
    fn next_alone(&mut self, robot: usize) -> Next {
        let others = self.told[robot].iter().enumerate().filter(|&(other, _)| other != robot);
        let others: Vec<Other> = others.map(|(_, other)| *other).collect();
        let view = View { others: &others, slot: self.slot(robot) };
        let next =
            self.robots[robot].next(&self.rule, view, &mut self.memory.scratch(), &mut self.radio.dice);
        if matches!(next, Next::Tries { .. }) {
            self.robots[robot].decided(&self.rule, &others);
        }
        next
    }

    /// The sight that `robot` has as it goes through `side`, and where it gets to.
    fn look(&mut self, robot: usize, side: Side, entering: &[Option<(Cell, Pose)>]) -> (Sight, (Cell, Pose)) {
        let to = self.robots[robot].at().beyond(side);
        let mut from = self.poses[robot];
        let edge = Edge::new(self.robots[robot].at(), side);
        if self.small.contains(&edge) && self.detours[robot] != Some(edge) {
            if self.rule.has(Condition::Detour) {
                self.detours[robot] = Some(edge);
                self.radio.detour(&mut from, to);
            }
            return (Sight::Small, (self.cells[robot], from));
        }
        let (cell, [turned, pose]) = if self.radio.is_noisy() {
            let poses = self.radio.driven(&from, to);
            (cell_of(place_of(poses[1].at)), poses)
        } else {
            (to, [from, Pose::start(to)])
        };
        let is_there = |other: usize| {
            other != robot
                && (self.cells[other] == cell || entering[other].is_some_and(|(entered, _)| entered == cell))
        };
        let sight = if !self.is_clear(place_of(from.at), place_of(pose.at)) {
            Sight::Obstacle
        } else if !self.rule.has(Condition::Look) || !(0..self.robots.len()).any(is_there) {
            Sight::Open
        } else if (0..self.robots.len()).any(|other| is_there(other) && self.dead != Some(other)) {
            Sight::Robot
        } else {
            Sight::Silent
        };
        // It looks before it drives.
        let goes = if sight == Sight::Open { pose } else { turned };
        (sight, (cell, goes))
    }

    /// Whether nothing is in the way from one place to another.
    fn is_clear(&self, from: Place, to: Place) -> bool {
        let (first, last) = (cell_of(from), cell_of(to));
        if first == last || !self.radio.is_noisy() {
            return self.layout.is_free(last);
        }
        // In steps of a sixteenth of a cell or less.
        let parts = (from.distance(to) / 16 + 1) as i32;
        let at = |part: i32| {
            Place::new(from.x + (to.x - from.x) * part / parts, from.y + (to.y - from.y) * part / parts)
        };
        (1..=parts).all(|part| self.layout.is_free(cell_of(at(part))))
    }

    /// Notes whether what `robot` has learned of `cell` is not so.
    fn note(&mut self, robot: usize, cell: Cell) {
        self.is_wrong |= match self.robots[robot].map.status(cell) {
            Status::Unexplored => false,
            Status::Explored => self.entered.status(cell) != Status::Explored,
            Status::Obstacle => self.layout.is_free(cell),
            Status::Body => self.dead.is_none_or(|dead| self.cells[dead] != cell),
        };
    }

    /// `from` tells what it knows, where it is and what it has claimed.
    fn tell(&mut self, from: usize) {
        let Self { rule, robots, cells, told, heard, radio, poses, told_now, .. } = self;
        let mut deaf = Vec::new();
        let says = Other { cell: robots[from].at(), place: poses[from].fix(), aim: robots[from].aim() };
        let knows = robots[from].map.len();
        for to in (0..robots.len()).filter(|&to| to != from) {
            let is_heard = radio.is_heard(cells[from], cells[to]);
            if is_heard {
                told[to][from] = says;
            } else {
                deaf.push(to);
            }
            // Whoever does not share says only once what is new.
            if is_heard || !rule.has(Condition::Share) {
                let since = std::mem::replace(&mut heard[to][from], knows);
                let news: Vec<(Cell, Status)> = robots[from].map.learned(since).to_vec();
                for (cell, status) in news.into_iter().filter(|_| is_heard) {
                    robots[to].hears(cell, status);
                }
            }
        }
        // Of what it tells in one team move, the last has everything.
        told_now.retain(|&(teller, _)| teller != from);
        told_now.push((from, deaf));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit;
    use tautline_grids::chance::Probability;
    use tautline_grids::layout::Generator;

    /// Lets a team explore, and compares each decision with that of the rule of one robot. How many there were.
    fn compared(rule: Rule, layout: &Layout, robots: usize, options: Options, seed: u64) -> usize {
        compared_with_death(rule, layout, robots, options, seed, u64::MAX)
    }

    /// As [`compared`], where the first robot dies after so many team moves.
    fn compared_with_death(
        rule: Rule,
        layout: &Layout,
        robots: usize,
        options: Options,
        seed: u64,
        before: u64,
    ) -> usize {
        let free = layout.cells().filter(|&cell| layout.is_free(cell)).collect::<Vec<_>>();
        let starts = kit::starts(layout, free[seed as usize % free.len()], robots);
        let mut team = Explorers::new(rule, layout, &starts, options, seed);
        let compare = |team: &mut Explorers, robot: usize| {
            let (alone, of_team) = (team.next_alone(robot), team.next(robot));
            assert_eq!(of_team, alone, "robot {robot} of {robots}, seed {seed}, in {layout}");
            of_team
        };
        // Some rules go on for ever.
        let mut moves = 0;
        while moves < 2_000 && team.advance_by(compare).is_ok() {
            moves += 1;
            if moves == before {
                team.dies(0);
            }
        }
        moves as usize * starts.len()
    }

    /// Halls with a door between any two that follow each other, now at one end and now at the other.
    fn halls(width: u64, high: usize, count: usize) -> Layout {
        let rows = count * (high + 1) - 1;
        let mut layout = Layout::open(width, rows as u64).expect("a layout");
        for hall in 1..count {
            let row = (hall * (high + 1) - 1) as i16;
            let door = if hall % 2 == 0 { 0 } else { layout.width() - 1 };
            let wall = layout.cells().filter(|cell| cell.y == row && cell.x != door);
            for cell in wall.collect::<Vec<_>>() {
                layout.block(cell);
            }
        }
        layout
    }

    fn generated(text: &str, seed: u64) -> Layout {
        text.parse::<Generator>().and_then(|generator| generator.generate(seed)).expect("a layout")
    }

    /// Messages that are heard near by, or mostly, and positions with an error.
    fn radios() -> [Options; 4] {
        let usual = Options::USUAL;
        let loss: Probability = "0.3".parse().expect("a probability");
        [
            usual.clone(),
            Options { range_cells: Some(3), ..usual.clone() },
            Options { loss, ..usual.clone() },
            Options { noise_db: 0.5, ..usual },
        ]
    }

    #[test]
    fn a_robot_goes_where_the_rule_of_one_robot_sends_it() {
        let mut decisions = 0;
        for seed in 0..100 {
            let kinds = ["cells:4x3:0.1", "cells:9x7:0.2", "cells:6x12:0.35", "cells:16x16:0.3", "open:8x8"];
            let layout = generated(kinds[seed as usize % kinds.len()], seed);
            for options in radios() {
                decisions += compared(Rule::REPAIRED, &layout, 1 + seed as usize % 9, options, seed);
            }
            let conditions = [Condition::Nearer, Condition::Claim, Condition::Corner];
            for condition in
                conditions.into_iter().chain([Condition::Tell, Condition::Lapse, Condition::Keep])
            {
                let rule = Rule::REPAIRED.without(condition);
                decisions += compared(rule, &layout, 1 + seed as usize % 5, Options::USUAL, seed);
            }
            let (rule, robots, before) = (Rule::REPAIRED, 2 + seed as usize % 4, 1 + seed % 9);
            decisions += compared_with_death(rule, &layout, robots, Options::USUAL, seed, before);
        }
        assert!(decisions > 40_000, "{decisions} decisions");
    }

    #[test]
    fn far_ways_are_those_of_the_rule_of_one_robot() {
        for (seed, robots) in (0..).zip([1, 2, 3, 5, 8]) {
            let far = [halls(24, 2, 6), halls(12, 1, 12), generated("cells:40x40:0.35", seed)];
            let decisions: usize =
                far.iter().map(|layout| compared(Rule::REPAIRED, layout, robots, Options::USUAL, seed)).sum();
            assert!(decisions > 1_000, "{decisions} decisions");
        }
    }
}
