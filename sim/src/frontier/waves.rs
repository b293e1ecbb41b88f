//! The cell of a robot's pair, for a whole team: what [`Robot::next`](tautline_kernel::frontier::Robot::next) finds for
//! one robot alone, and the same to the last tie.
//!
//! Robots and unexplored cells are paired, the nearest pair first. One [`Wave`] for each robot finds the cells that it
//! reaches, one level of distance after another, and no wave goes farther than it must: a robot that has its pair needs
//! no more. Between the decisions of one team move robots stand, and no way becomes shorter: so the waves of one
//! decision serve the next ones.
//!
//! A far wave is kept narrow. A [`Field`] says of each cell how far the nearest unexplored cell is at least, and a wave
//! that is bounded leaves out what leads to none within its bound. Each shortest way to an unexplored cell within the
//! bound stays in: so the cells that it finds, their distances and the first sides of the ways are those of a wave
//! without a bound.

use tautline_kernel::frontier::{Condition, Map, Pair, Rule, Seeker, Status, Target, Way};
use tautline_kernel::ground::{Cell, Side};

use super::chart::Chart;
use super::field::Field;

/// Whose repositories the robots decide by.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Knowledge {
    /// All hear everything: what one robot knows, all know.
    Common,
    /// Each has its own.
    Own,
}

/// So many moves a wave may go round at least.
const LEAST_SLACK: u32 = 2;

/// The origin of a wave.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Origin {
    cell: Cell,
    /// Of whose repository, if each robot has its own.
    whose: Option<usize>,
    /// How much was known: as long as it is that much, ways are what they were.
    known: usize,
}

/// The unexplored cells that one robot reaches, the nearest first.
#[derive(Clone, Debug, Default)]
struct Wave {
    origin: Option<Origin>,
    /// A bit for each place that was reached.
    reached: Vec<u64>,
    /// The explored places that were reached, with the first sides of the ways.
    queue: Vec<(u32, Option<Side>)>,
    /// So many of them have told their neighbours.
    told: usize,
    /// Cells that are so far were found.
    level: u32,
    found: Vec<Target>,
    /// How many cells are left to be found.
    left: usize,
    /// So many moves it may go round.
    slack: u32,
    /// Cells that are farther are not looked for.
    bound: u32,
    /// Whether the bound has left something out.
    is_cut: bool,
}

impl Wave {
    /// Starts in `origin`, unless it has started there.
    fn start(&mut self, origin: Origin, chart: &Chart, field: &Field) {
        if self.origin != Some(origin) {
            // A robot on its way goes round about as far as at its last move.
            let went_round = self.level.saturating_sub(self.bound.saturating_sub(self.slack));
            self.slack = went_round.max(LEAST_SLACK);
            self.origin = Some(origin);
            self.begin(chart, field);
        }
    }

    /// Begins again.
    fn begin(&mut self, chart: &Chart, field: &Field) {
        let found = self.found.drain(..).filter_map(|found| chart.place(found.cell));
        for place in self.queue.drain(..).map(|(place, _)| place as usize).chain(found) {
            self.reached[place / 64] = 0;
        }
        self.reached.resize(chart.statuses.len().div_ceil(64), 0);
        (self.told, self.level, self.left, self.is_cut) = (0, 0, chart.frontier(), false);
        if let Some(place) = self.origin.and_then(|origin| chart.place(origin.cell)) {
            self.bound = field.least(place).saturating_add(self.slack);
            self.reach(place);
            self.queue.push((place as u32, None));
        }
    }

    /// Notes that a place is reached.
    fn reach(&mut self, place: usize) {
        self.reached[place / 64] |= 1 << (place % 64);
    }

    fn has_reached(&self, place: usize) -> bool {
        self.reached[place / 64] & (1 << (place % 64)) != 0
    }

    /// Whether there are no more cells to be found.
    fn is_over(&self) -> bool {
        self.left == 0 || (self.told == self.queue.len() && !self.is_cut)
    }

    /// Goes one level farther, or begins again with twice the slack if its bound is reached. Returns the cells it has
    /// looked at.
    fn extend(&mut self, chart: &Chart, field: &Field) -> usize {
        if self.level >= self.bound || self.told == self.queue.len() {
            self.slack = self.slack.saturating_mul(2);
            self.begin(chart, field);
            return 0;
        }
        self.level += 1;
        let (statuses, steps) = (&chart.statuses, chart.steps());
        let (from, to) = (self.told, self.queue.len());
        while self.told < to && self.left > 0 {
            let (place, first) = self.queue[self.told];
            self.told += 1;
            for (step, side) in steps {
                let beside = (place as usize).wrapping_add_signed(step);
                let status = statuses[beside];
                if matches!(status, Status::Obstacle | Status::Body) || self.has_reached(beside) {
                    continue;
                }
                let first = first.unwrap_or(side);
                if status == Status::Unexplored {
                    // A robot in a cell that is not explored here has neighbours that count in no frontier.
                    self.left = self.left.saturating_sub(1);
                    self.found.push(Target { cell: chart.cell(beside), distance: self.level, first });
                } else if field.is_closed(beside) {
                    continue;
                } else if field.least(beside) + self.level > self.bound {
                    self.is_cut = true;
                    continue;
                } else {
                    self.queue.push((beside as u32, Some(first)));
                }
                self.reach(beside);
            }
        }
        self.told - from
    }

    /// The cells beyond `level`.
    fn beyond(&self, level: u32) -> &[Target] {
        &self.found[self.found.partition_point(|found| found.distance <= level)..]
    }
}

/// The waves of a team.
#[derive(Clone, Debug)]
pub(super) struct Waves {
    knowledge: Knowledge,
    by_robot: Vec<Wave>,
    field: Field,
}

impl Waves {
    /// For so many robots.
    pub(super) fn new(knowledge: Knowledge, robots: usize) -> Self {
        Self { knowledge, by_robot: vec![Wave::default(); robots], field: Field::default() }
    }

    /// The way of the robot `own` to the cell of its pair, or to the one that comes first for it if all cells are the
    /// others'; `None` if it reaches none. `chart` is its repository, and `seekers` are all robots, as far as it has
    /// heard of them.
    pub(super) fn way(
        &mut self,
        chart: &Chart,
        rule: &Rule,
        own: usize,
        is_bound: bool,
        seekers: &[Seeker],
    ) -> Option<Way> {
        let mut free = self.start(chart, rule, own, seekers);
        let (mut first, mut level, mut taken) = (None, 0, Vec::new());
        loop {
            let next =
                |waves: &[Wave], robot: usize| waves[robot].beyond(level).first().map(|next| next.distance);
            if self.by_robot[own].is_over() && next(&self.by_robot, own).is_none() {
                return first.map(Way::Taken);
            }
            let near = free.iter().filter_map(|&robot| next(&self.by_robot, robot)).min();
            // A level is settled when every wave has told what is there.
            let is_behind = |robot: usize| {
                let wave = &self.by_robot[robot];
                !wave.is_over() && wave.beyond(level).is_empty() && near.is_none_or(|near| wave.level < near)
            };
            let behind = free.iter().copied().filter(|&robot| is_behind(robot));
            if let Some(robot) = behind.min_by_key(|&robot| self.by_robot[robot].level) {
                self.field.spent += self.by_robot[robot].extend(chart, &self.field);
                continue;
            }
            let mut pairs: Vec<(Pair, usize)> = Vec::new();
            for &robot in &free {
                let beyond = self.by_robot[robot].beyond(level).iter();
                let there = beyond.take_while(|found| Some(found.distance) == near);
                let open = there.filter(|found| chart.status(found.cell) == Status::Unexplored);
                pairs.extend(open.map(|&found| (Pair::new(chart, rule, seekers[robot], found), robot)));
            }
            pairs.sort_unstable();
            let of_own = pairs.iter().find(|&&(_, robot)| robot == own);
            first = first.or_else(|| of_own.map(|(pair, _)| pair.found()));
            for (pair, robot) in pairs {
                let found = pair.found();
                if taken.contains(&found.cell) || !free.contains(&robot) {
                    continue;
                }
                if robot == own {
                    let mut nearer =
                        self.by_robot[own].found.iter().take_while(|to| to.distance < found.distance);
                    let near = first.filter(|first: &Target| {
                        let cell = seekers[own].aim.unwrap_or(first.cell);
                        is_bound && nearer.any(|to| to.cell == cell)
                    });
                    return Some(near.map_or(Way::Paired(found), Way::Near));
                }
                taken.push(found.cell);
                free.retain(|&other| other != robot);
            }
            level = near?;
        }
    }

    /// Starts the wave of each robot that has a say, and returns these robots, `own` first.
    fn start(&mut self, chart: &Chart, rule: &Rule, own: usize, seekers: &[Seeker]) -> Vec<usize> {
        let (whose, known) = match self.knowledge {
            Knowledge::Common => {
                self.field.renew(chart);
                (None, chart.explored)
            }
            Knowledge::Own => (Some(own), chart.len()),
        };
        let mut robots: Vec<usize> = Vec::new();
        let others = (0..seekers.len()).filter(|&robot| robot != own && rule.has(Condition::Nearer));
        for robot in [own].into_iter().chain(others) {
            let cell = seekers[robot].cell;
            if robots.iter().all(|&other| seekers[other].cell != cell) {
                self.by_robot[robot].start(Origin { cell, whose, known }, chart, &self.field);
                robots.push(robot);
            }
        }
        robots
    }
}
