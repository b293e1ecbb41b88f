//! The choices of the reel as SPEC.md writes them down: every robot with every cell, every step with every other, lists
//! that grow, a flood fill for each distance. It is told of the map, and knows nothing of the kernel's rule. CHAIN-25
//! compares the two.

use std::collections::VecDeque;

use tautline_kernel::ground::{Cell, Edge, Side, Step};

use super::environment::{in_covered, in_safe};
use super::plain_walk::{Map, Walk, walk, way};

/// Rehearsals of approaches that one choice may take.
const REHEARSALS: usize = 64;

/// The robots, base first, on the map.
pub(super) struct PlainReel<'a> {
    map: Map<'a>,
    team: Vec<Cell>,
}

/// The team moves until a cell is explored.
type Rehearsal = Vec<Vec<Step>>;

/// The cost of a robot's step; none, if it is not to be made.
type Cost<'a> = &'a dyn Fn(usize, Step) -> Option<i32>;

impl<'a> PlainReel<'a> {
    pub(super) fn new(map: Map<'a>, team: &[Cell]) -> Self {
        Self { map, team: team.to_vec() }
    }

    const fn leader(&self) -> usize {
        self.team.len() - 1
    }

    fn is_open(&self, edge: Edge) -> bool {
        self.map.1(edge)
    }

    fn is_explored(&self, cell: Cell) -> bool {
        self.map.2(cell)
    }

    /// How far the cells are from one, over sides not known to be walls; the nearest first.
    fn distances(&self, from: Cell) -> Vec<(Cell, usize)> {
        let mut met = vec![(from, 0)];
        let mut queue = VecDeque::from([(from, 0)]);
        while let Some((cell, distance)) = queue.pop_front() {
            for side in Side::ALL.into_iter().filter(|&side| self.is_open(Edge::new(cell, side))) {
                let next = (cell.beyond(side), distance + 1);
                if met.iter().all(|&(cell, _)| cell != next.0) {
                    met.push(next);
                    queue.push_back(next);
                }
            }
        }
        met
    }

    /// Whether what is planned, leader first, leaves the next robot this step by the conditions of neighbours.
    fn agrees(&self, planned: &[Step], step: Step) -> bool {
        let robot = self.leader() - planned.len();
        let (at, base) = (self.team[robot], self.team[0]);
        let to = at.after(step);
        let crosses = match step {
            Step::Cross(side) => self.is_open(Edge::new(at, side)),
            Step::Stay => true,
        };
        let others = self.team.iter().filter(|&&cell| cell == to).count();
        let may_enter = step == Step::Stay || to == base || others < 2;
        let is_covered = robot == 0
            || robot == self.leader() && step == Step::Stay
            || in_covered(self.team[robot - 1], to);
        let agrees_ahead = planned.last().is_none_or(|&ahead| {
            let from = self.team[robot + 1];
            let is_own = to == base || to != from.after(ahead);
            in_safe(from.after(ahead), to) && in_covered(from, to) && is_own
        });
        (robot > 0 || step == Step::Stay) && crosses && may_enter && is_covered && agrees_ahead
    }

    /// The first team move, base first, in which each robot has a cell of its own; from the leader backwards each
    /// prefers its steps in the order of `prefer`, which is told what is planned.
    fn first(&self, planned: &[Step], prefer: &dyn Fn(&[Step]) -> Vec<Step>) -> Option<Vec<Step>> {
        let Some(robot) = self.leader().checked_sub(planned.len()) else {
            return Some(planned.iter().rev().copied().collect());
        };
        let is_own = |to| {
            let mut ahead = planned.iter().zip(self.team.iter().rev());
            to == self.team[0] || ahead.all(|(&step, cell)| cell.after(step) != to)
        };
        let steps = prefer(planned).into_iter();
        let mut fit =
            steps.filter(|&step| self.agrees(planned, step) && is_own(self.team[robot].after(step)));
        fit.find_map(|step| self.first(&[planned, &[step]].concat(), prefer))
    }

    /// A: the leader goes into an unexplored cell beside it.
    pub(super) fn touch(&self) -> Option<Vec<Step>> {
        let (at, base) = (self.team[self.leader()], self.team[0]);
        let (x, y) = (i32::from(at.x - base.x), i32::from(at.y - base.y));
        let is_new = |&side: &Side| self.is_open(Edge::new(at, side)) && !self.is_explored(at.beyond(side));
        let mut sides: Vec<Side> = Side::ALL.into_iter().filter(is_new).collect();
        sides.sort_by_key(|&side| {
            let to = at.beyond(side);
            -(i32::from(to.x - at.x) * x + i32::from(to.y - at.y) * y)
        });
        let follow = |planned: &[Step]| {
            let robot = self.leader() - planned.len();
            let ahead = self.team[robot + 1].after(planned[planned.len() - 1]);
            let mut steps = Step::ALL.to_vec();
            steps.retain(|&step| self.agrees(planned, step));
            steps.sort_by_cached_key(|&step| {
                let to = self.team[robot].after(step);
                let (dx, dy) = ahead.apart(to);
                let is_high = dx + dy <= 1;
                let distances = self.distances(to).into_iter();
                let distance = distances.filter(|&(cell, _)| !self.is_explored(cell)).map(|(_, far)| far);
                (!(is_high && step == Step::Stay), !is_high, distance.min().unwrap_or(usize::MAX))
            });
            steps
        };
        sides
            .into_iter()
            .map(Step::Cross)
            .find_map(|step| if self.agrees(&[], step) { self.first(&[step], &follow) } else { None })
    }

    /// The least that the robots behind those planned can cost in sum, as neighbours agree.
    fn least(&self, planned: &[Step], cost: Cost<'_>, apart: i32) -> Option<i32> {
        let Some(robot) = self.leader().checked_sub(planned.len()) else { return Some(0) };
        let steps = Step::ALL.into_iter().filter(|&step| self.agrees(planned, step));
        steps.filter_map(|step| self.least_with(planned, robot, step, cost, apart)).min()
    }

    /// The least cost, as [`Self::least`], if the next of them makes this step.
    fn least_with(
        &self,
        planned: &[Step],
        robot: usize,
        step: Step,
        cost: Cost<'_>,
        apart: i32,
    ) -> Option<i32> {
        let behind = self.least(&[planned, &[step]].concat(), cost, apart)?;
        let is_apart = planned.last().is_some_and(|&ahead| {
            let (dx, dy) = self.team[robot + 1].after(ahead).apart(self.team[robot].after(step));
            dx + dy > 1
        });
        Some(cost(robot, step)? + if is_apart { apart } else { 0 } + behind)
    }

    /// The cheapest team move.
    fn cheapest(&self, cost: Cost<'_>, apart: i32) -> Option<Vec<Step>> {
        self.first(&[], &|planned| {
            let robot = self.leader() - planned.len();
            let priced = Step::ALL.into_iter().filter(|&step| self.agrees(planned, step));
            let mut priced: Vec<(i32, Step)> = priced
                .filter_map(|step| Some((self.least_with(planned, robot, step, cost, apart)?, step)))
                .collect();
            priced.sort_by_key(|&(least, _)| least);
            priced.into_iter().map(|(_, step)| step).collect()
        })
    }

    /// Carries a task through, `next` by `next`, as if no wall were met.
    fn rehearse(&self, most: usize, mut next: impl FnMut(&Self) -> Option<Vec<Step>>) -> Option<Rehearsal> {
        let (mut then, mut moves) = (Self { team: self.team.clone(), ..*self }, Vec::new());
        while moves.len() < most {
            let steps = next(&then)?;
            then.team = then.team.iter().zip(&steps).map(|(cell, &step)| cell.after(step)).collect();
            moves.push(steps);
            if then.team.iter().any(|&cell| !self.is_explored(cell)) {
                return Some(moves);
            }
        }
        None
    }

    /// B: `robot` comes nearer to the cell at each step.
    fn approach(&self, robot: usize, to: Cell, distance: usize) -> Option<Rehearsal> {
        let bearings = self.distances(to);
        let far = |at| bearings.iter().find(|&&(cell, _)| cell == at).map(|&(_, far)| far);
        self.rehearse(distance, |then| {
            let cost = |other: usize, step| {
                let (at, next) = (then.team[other], then.team[other].after(step));
                let is_nearer = far(next) < far(at);
                let wish = match step {
                    Step::Stay => 0,
                    Step::Cross(_) => {
                        let new = if self.is_explored(next) { 0 } else { 30 };
                        1 + if is_nearer { -5 } else { 5 } - new
                    }
                };
                (other != robot || is_nearer).then_some(wish)
            };
            then.cheapest(&cost, 5)
        })
    }

    /// C: the walk of the chain is drawn in as far as `stop`, and let out along the `branch` from there.
    fn draw_in(
        &self,
        first: usize,
        own: &Walk,
        stop: usize,
        branch: &Walk,
        most: usize,
    ) -> Option<Rehearsal> {
        let turn = own.1[stop];
        let beyond = |places: &[usize]| places.iter().skip(1).map(|place| turn + place).collect::<Vec<_>>();
        let cells = [&own.0[..=turn], &branch.0[1..]].concat();
        let stops = [&own.1[..=stop], &beyond(&branch.1)].concat();
        let (mut at, mut is_in) = (own.0.len() - 1, false);
        self.rehearse(most, |then| {
            is_in |= at <= turn;
            let along = if is_in { &cells } else { &own.0 };
            let leader = then.leader();
            let mut places = vec![0; then.team.len()];
            places[leader] = at;
            for robot in (first + 1..leader).rev() {
                let behind = &along[..=places[robot + 1]];
                places[robot] = behind.iter().rposition(|&cell| cell == then.team[robot])?;
            }
            let steps = if is_in {
                let mut planned = places.clone();
                for robot in (first + 1..=leader).rev() {
                    let last = stops[(stops.len() + robot).saturating_sub(leader + 1)];
                    let follows = robot == leader || places[robot] + 2 <= planned[robot + 1];
                    planned[robot] += usize::from(places[robot] < last && follows);
                }
                let steps = then.team.iter().enumerate().map(|(robot, cell)| {
                    let goes_on = planned[robot] > places[robot];
                    let is_it = |step: &Step| !goes_on || cell.after(*step) == along[planned[robot]];
                    if goes_on { Step::ALL.into_iter().find(is_it) } else { Some(Step::Stay) }
                });
                let steps: Vec<Step> = steps.collect::<Option<_>>()?;
                then.first(&[], &|planned| vec![steps[leader - planned.len()]])
            } else {
                let cost = |robot: usize, step| match (step, places[robot].checked_sub(1)) {
                    (Step::Stay, _) => Some(0),
                    (_, Some(back)) if then.team[robot].after(step) == along[back] => {
                        Some(if robot == leader { -1000 } else { 1 })
                    }
                    _ => None,
                };
                then.cheapest(&cost, 0).filter(|steps| steps.iter().any(|&step| step != Step::Stay))
            }?;
            let goes = steps[leader] != Step::Stay;
            at = if is_in { at + usize::from(goes) } else { at - usize::from(goes) };
            Some(steps)
        })
    }

    /// The walk along the chain from its first robot from which each is at most two free sides from the next, and that
    /// robot.
    fn own(&self) -> (usize, Walk) {
        let (mut first, mut own) = (0, (vec![self.team[0]], vec![0]));
        for robot in 0..self.leader() {
            let (from, to) = (self.team[robot], self.team[robot + 1]);
            let offset = (to.x - from.x, to.y - from.y);
            let is_open = |edge| self.is_open(edge);
            if let Some(cells) = if from == to { Some(Vec::new()) } else { way(&is_open, from, offset) } {
                own.0.extend(cells);
                own.1.push(own.0.len() - 1);
            } else {
                (first, own) = (robot + 1, (vec![to], vec![0]));
            }
        }
        (first, own)
    }

    /// The shortest C; of equals that which draws in least.
    fn shortest(&self) -> Option<Rehearsal> {
        let (first, own) = self.own();
        let mut best: Option<Rehearsal> = None;
        for robot in (first..self.leader()).rev() {
            let (links, from) = (self.leader() - robot, self.team[robot]);
            let Some(branch) = walk(self.map, from, links) else { continue };
            let most = best.as_ref().map_or(16 * self.team.len(), |best| best.len() - 1);
            best = self.draw_in(first, &own, robot - first, &branch, most).or(best);
        }
        best
    }

    /// The task that is begun: B to a cell at most two steps away, or in fewer team moves than the shortest C, or that.
    pub(super) fn task(&self) -> Option<Rehearsal> {
        let mut pairs = Vec::new();
        for robot in (1..self.team.len()).rev() {
            let met = self.distances(self.team[robot]).into_iter();
            let new = met.filter(|&(cell, far)| !self.is_explored(cell) && far <= 4 * self.team.len());
            pairs.extend(new.map(|(cell, far)| (far, robot, cell)));
        }
        pairs.sort_by_key(|&(far, robot, cell)| (far, self.leader() - robot, cell.y, cell.x));
        pairs.truncate(REHEARSALS);
        let (near, rest) = pairs.split_at(pairs.partition_point(|&(far, ..)| far <= 2));
        let approach = |&(far, robot, cell): &(usize, usize, Cell)| self.approach(robot, cell, far);
        near.iter().find_map(approach).or_else(|| {
            let shortest = self.shortest();
            let most = shortest.as_ref().map_or(usize::MAX, Vec::len);
            rest.iter().take_while(|&&(far, ..)| far < most).find_map(approach).or(shortest)
        })
    }
}
