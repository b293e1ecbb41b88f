//! A chain as a team: the kernel's chain and the log of messages that it reads its history from. Something may fail:
//! bytes are lost at the barrier (CHAIN-20), a robot dies (CHAIN-21), robots go one after the other (CHAIN-19), a wall
//! appears (CHAIN-22).

use std::mem::take;

use tautline_kernel::chain::{
    self, Barrier, ByteEffect, Chain, Intent, Kind, Parts, Plan, Reformation, Walls,
};
use tautline_kernel::choice::Oracle as _;
use tautline_kernel::conditions::Conditional as _;
use tautline_kernel::ground::{Area, Cell, Edge, Grid, Step};
use tautline_proofs::chain::breach::{Breach, CHEAP_LOOKS, frame};
use tautline_proofs::chain::links::{reach_by_robots, within_reach};
use tautline_proofs::run::Frame;

use super::layers;
use crate::explore::clause::broken;
use crate::explore::{
    Change, ClauseId, End, Hearers, Layer, Reach, Refusal, Scene, Setup, Surroundings, Survey, Team,
};
use crate::failures::{Failures, MoveOrder};
use crate::options::Options;
use tautline_grids::chance::Dice;
use tautline_grids::layout::Layout;

/// A message of the team is refused by it.
pub const HEARD: ClauseId = ClauseId::new("CHAIN-8");

/// Neighbours are out of contact while they go.
pub const ANY_ORDER: ClauseId = ClauseId::new("CHAIN-19");

/// Robots lose contact within a part, or leave something out, after one of them has died.
pub const DEATH: ClauseId = ClauseId::new("CHAIN-21");

/// How often robots say their bytes of one team move before whoever watches them ends the run.
const PATIENCE: u32 = 1000;

/// The next team move of a chain that reads its own log; its end if there is none.
fn planned<G: Grid, const ROBOTS: usize>(
    chain: &mut Chain<G, ROBOTS>,
    log: &[u8],
) -> Result<Plan<ROBOTS>, End> {
    match chain.plan(log) {
        Ok(Intent::Go(plan)) => Ok(plan),
        Ok(Intent::Done(chain::End::Explored)) => Err(End::Explored),
        Ok(Intent::Done(chain::End::Exhausted)) => Err(End::Exhausted),
        Err(_) => Err(End::Refused),
    }
}

/// The state of the robots that are left.
enum Whole<G, const ROBOTS: usize> {
    /// A chain.
    Chain(Box<Chain<G, ROBOTS>>),
    /// Two parts that take their moves back, as far as until they are in contact, or home.
    Parts(Reformation<G, ROBOTS>, Until),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Until {
    Contact,
    Home,
}

/// A chain in which something may fail.
pub(super) struct ChainTeam<G, const ROBOTS: usize> {
    /// Whether something is to fail.
    is_faulty: bool,
    /// There is always one between two team moves.
    whole: Option<Whole<G, ROBOTS>>,
    seed: u64,
    log: Vec<u8>,
    /// The run before the death: how far it was taken back, and its log.
    before: Option<(Option<Parts>, Vec<u8>)>,
    /// Where all robots are, the dead one included.
    cells: Vec<Cell>,
    /// The places in `cells` of those that are left.
    left: Vec<usize>,
    /// The failures that are told, but for a death that has come.
    told: Options,
    chance: Dice,
    barriers: Vec<Barrier<ROBOTS>>,
    failures: Failures,
    moves: u32,
    /// Epochs before the last team move.
    epochs: u32,
    /// Whether a byte of the last team move never came.
    is_silent: bool,
    /// By robot that spoke in the last team move: who did not hear it.
    unheard: Vec<(usize, Vec<usize>)>,
}

impl<G: Grid, const ROBOTS: usize> ChainTeam<G, ROBOTS> {
    pub(super) fn new(setup: &Setup, chain: Chain<G, ROBOTS>) -> Self {
        let cells = chain.cells().to_vec();
        let told = setup.options.clone();
        // Where no wall appears, known sides need not be tried again.
        let chain = if told.wall.is_some() { chain.among(Walls::Changing) } else { chain };
        let left: Vec<usize> = (0..cells.len()).collect();
        let mut team = Self {
            is_faulty: !told.loss.is_never()
                || told.fail.is_some()
                || told.wall.is_some()
                || !told.going.is_usual(),
            whole: Some(Whole::Chain(Box::new(chain))),
            seed: setup.seed,
            log: Vec::new(),
            before: None,
            cells,
            left,
            told,
            chance: Dice::new(setup.seed, *b"faults  "),
            barriers: Vec::new(),
            failures: Failures::default(),
            moves: 0,
            epochs: 0,
            is_silent: false,
            unheard: Vec::new(),
        };
        team.meet();
        team
    }

    /// The robots that are left meet at a new barrier; the base, which says nothing, has none.
    fn meet(&mut self) {
        let robots = self.left.len();
        self.barriers = (1..robots).map(|own| Barrier::new(robots, own)).collect();
    }

    /// A team move of the chain.
    fn go(
        &mut self,
        mut chain: Box<Chain<G, ROBOTS>>,
        plan: &Plan<ROBOTS>,
        is_open: &mut dyn FnMut(Edge) -> bool,
    ) -> Frame {
        let due = self.told.fail.take_if(|failure| failure.step.get() <= self.moves);
        let mute = due.map(|failure| usize::from(failure.robot));
        let wall = self.told.wall.filter(|wall| wall.step.get() <= self.moves).map(|wall| wall.edge());
        let is_open = |edge: Edge| wall != Some(edge) && is_open(edge);
        let settled = chain.settle(&mute.map_or(*plan, |mute| plan.without(mute)), is_open);
        self.log.extend_from_slice(settled.messages());
        let made = frame(plan.kind, settled.messages(), chain.cells());
        let made = self.widened(&made);
        match mute {
            None => {
                self.exchange(settled.messages());
                self.whole = Some(Whole::Chain(chain));
            }
            Some(mute) => self.dies(chain, mute),
        }
        made
    }

    /// A robot, numbered from 1 as before, has died in the last team move.
    fn dies(&mut self, chain: Box<Chain<G, ROBOTS>>, mute: usize) {
        self.failures.died = Some(self.moves);
        self.left.remove(mute - 1);
        self.meet();
        let is_alone = self.left.len() < 2;
        self.is_silent = is_alone;
        let log = take(&mut self.log);
        self.whole = if is_alone {
            Some(Whole::Chain(chain))
        } else {
            chain.reform(mute, &log).ok().map(|reforming| Whole::Parts(reforming, Until::Contact))
        };
        self.before = Some((None, log));
    }

    /// A team move of those that are left, as one of all robots.
    fn widened(&mut self, made: &Frame) -> Frame {
        let robots = self.cells.len();
        let (mut steps, mut blocked) = (vec![Step::Stay; robots], vec![false; robots]);
        for (place, &robot) in self.left.iter().enumerate() {
            steps[robot] = made.steps[place];
            blocked[robot] = made.blocked[place];
            self.cells[robot] = made.cells[place];
        }
        Frame { kind: made.kind, steps, blocked, cells: self.cells.clone() }
    }

    /// Takes a team move from before the death back; `None` if there is none.
    fn take_back(&mut self, reforming: &mut Reformation<G, ROBOTS>) -> Option<Frame> {
        let before = reforming.cells().to_vec();
        let (_, log) = self.before.as_ref()?;
        if reforming.take_back(log) != Ok(true) {
            return None;
        }
        let step = |(from, to): (&Cell, &Cell)| Step::ALL.into_iter().find(|&step| from.after(step) == *to);
        let steps = before.iter().zip(reforming.cells()).map(step).collect::<Option<Vec<Step>>>()?;
        let blocked = vec![false; steps.len()];
        let made = Frame { kind: Kind::Backtrack, steps, blocked, cells: reforming.cells().to_vec() };
        Some(self.widened(&made))
    }

    /// The robots say their bytes at the barrier until all have heard all.
    fn exchange(&mut self, messages: &[u8]) {
        if self.told.loss.is_never() {
            return;
        }
        let turn = self.barriers.first().map_or(0, Barrier::turn);
        for (barrier, &message) in self.barriers.iter_mut().zip(messages) {
            barrier.say(message);
        }
        let mut unheard: Vec<Vec<usize>> = vec![Vec::new(); self.barriers.len()];
        for _ in 0..PATIENCE {
            if self.barriers.iter().all(|barrier| barrier.turn() > turn) {
                self.unheard = self.by_robot(unheard);
                return;
            }
            self.failures.rounds += 1;
            let is_waiting = |barrier: &Barrier<ROBOTS>| barrier.turn() == turn;
            let said: Vec<Option<u8>> =
                self.barriers.iter().map(|barrier| barrier.again().filter(|_| is_waiting(barrier))).collect();
            for (from, byte) in said.iter().enumerate() {
                let Some(byte) = *byte else { continue };
                let mut answers = Vec::new();
                for to in (0..self.barriers.len()).filter(|&to| to != from) {
                    if let Some(ByteEffect::Late(answer)) = self.carry(from, to, byte, &mut unheard[from]) {
                        answers.push((to, answer));
                    }
                }
                for (other, answer) in answers {
                    self.carry(other, from, answer, &mut unheard[other]);
                }
            }
            for barrier in &mut self.barriers {
                if is_waiting(barrier) {
                    let passed = barrier.pass();
                    debug_assert!(
                        passed.is_none_or(|passed| passed.starts_with(messages)),
                        "the same of all"
                    );
                }
            }
        }
        self.is_silent = true;
        self.unheard = self.by_robot(unheard);
    }

    /// A byte from one robot to another, both counted from R_2, unless it is lost.
    fn carry(&mut self, from: usize, to: usize, byte: u8, unheard: &mut Vec<usize>) -> Option<ByteEffect> {
        if self.told.loss.happens(&mut self.chance) {
            self.failures.lost_bytes += 1;
            if !unheard.contains(&to) {
                unheard.push(to);
            }
            return None;
        }
        // Every byte here is one that a barrier has made.
        self.barriers[to].hear(from + 1, byte).ok()
    }

    /// Those robots in numbers of all robots, the base being 0.
    fn by_robot(&self, unheard: Vec<Vec<usize>>) -> Vec<(usize, Vec<usize>)> {
        let robot = |mover: usize| self.left[mover + 1];
        let spoken = unheard.into_iter().enumerate().filter(|(_, to)| !to.is_empty());
        spoken.map(|(from, to)| (robot(from), to.into_iter().map(robot).collect())).collect()
    }

    /// The robots between which contact is promised: all that are left, or each part of them.
    fn parts(&self) -> [&[usize]; 2] {
        match &self.whole {
            None | Some(Whole::Chain(_)) => [&self.left, &[]],
            Some(Whole::Parts(reforming, _)) => {
                let (behind, ahead) = self.left.split_at(reforming.behind());
                [behind, ahead]
            }
        }
    }

    /// The two parts are a chain again, with a log that begins anew.
    fn form(&mut self, reforming: Reformation<G, ROBOTS>) {
        if let Ok((chain, parts)) = reforming.formed() {
            if let Some((told, _)) = &mut self.before {
                *told = Some(parts);
            }
            self.log.clear();
            self.whole = Some(Whole::Chain(Box::new(chain)));
        }
    }

    fn grid(&self) -> Option<&G> {
        match self.whole.as_ref()? {
            Whole::Chain(chain) => Some(chain.grid()),
            Whole::Parts(reforming, _) => Some(reforming.grid()),
        }
    }

    /// Whether neighbours are in contact all the time while robots go from `before` to `after` one after the other, in
    /// a random order.
    fn holds_one_by_one(&self, before: &[Cell], after: &[Cell]) -> bool {
        // The order is drawn anew from the number of the team move, so that a look does not change the run.
        let mut chance = Dice::new(self.seed ^ u64::from(self.moves) << 32, *b"going   ");
        let mut waiting = self.left.clone();
        let mut cells = before.to_vec();
        while !waiting.is_empty() {
            let next = waiting.swap_remove(chance.pick(waiting.len() as u32) as usize);
            cells[next] = after[next];
            if self.parts().iter().any(|part| is_apart(part, &cells)) {
                return false;
            }
        }
        true
    }
}

/// Whether neighbours in a part are out of contact.
fn is_apart(part: &[usize], cells: &[Cell]) -> bool {
    let here: Vec<Cell> = part.iter().map(|&robot| cells[robot]).collect();
    Breach::Contact.is_in(&here, &here)
}

impl<G: Grid + Clone, const ROBOTS: usize> Team for ChainTeam<G, ROBOTS> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn reach(&self, layout: &Layout) -> Option<Reach> {
        let (base, robots) = (*self.cells.first()?, self.cells.len());
        let is_open = |edge: Edge| layout.is_open(edge);
        let (reached, counts) = reach_by_robots(layout.size().area(), base, usize::MAX, is_open);
        let (&cells, connected) = (counts.get(robots - 1)?, reached.len());
        (cells < connected).then_some(Reach { cells, connected, robots: counts.len() })
    }

    fn advance(&mut self, world: &mut dyn Surroundings) -> Result<Frame, End> {
        self.unheard.clear();
        if self.is_silent {
            return Err(End::Silent);
        }
        self.moves += 1;
        while let Some(whole) = self.whole.take() {
            match whole {
                Whole::Parts(reforming, Until::Contact) if reforming.is_formed() => {
                    self.failures.taken_back = self.failures.died.map(|died| self.moves - 1 - died);
                    self.form(reforming);
                }
                Whole::Parts(mut reforming, until) => match self.take_back(&mut reforming) {
                    Some(made) => {
                        self.failures.home += u32::from(until == Until::Home);
                        self.whole = Some(Whole::Parts(reforming, until));
                        return Ok(made);
                    }
                    None => self.form(reforming),
                },
                Whole::Chain(mut chain) => {
                    self.epochs = chain.epochs();
                    let end = match planned(&mut chain, &self.log) {
                        Ok(plan) => return Ok(self.go(chain, &plan, &mut |edge| world.is_open(edge))),
                        Err(end) => end,
                    };
                    let has_more = chain.has_more_within_reach();
                    let parts = self.before.as_ref().and_then(|(parts, _)| *parts).filter(|_| has_more);
                    let Some(parts) = parts.filter(|_| chain.can_come_home()) else {
                        self.whole = Some(Whole::Chain(chain));
                        return Err(end);
                    };
                    let reforming = chain.come_home(parts);
                    self.whole = reforming.map(|reforming| Whole::Parts(reforming, Until::Home));
                }
            }
        }
        unreachable!("a log that the chain has sent leads it home, and there it is in contact")
    }

    fn area(&self, _: &Layout) -> Area {
        self.grid().map_or(Area::of(self.cells[0]), Grid::area)
    }

    fn missed(&self, layout: &Layout, chart: &Survey) -> Vec<Cell> {
        let robots = self.left.len();
        chart.unexplored(within_reach(chart.area(), self.cells[0], robots, |edge| layout.is_open(edge)))
    }

    fn broken_in_move(&self, before: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let mut broken = Vec::new();
        if self.failures.died.is_none() {
            let seen = Breach::CHAIN.into_iter().filter(|breach| breach.is_in(before, &frame.cells));
            broken.extend(seen.map(ClauseId::from));
        } else if self.parts().iter().any(|part| is_apart(part, &frame.cells)) {
            broken.push(DEATH);
        }
        if let Some(Whole::Chain(chain)) = &self.whole
            && chain.looked_at() > CHEAP_LOOKS * chain.cells().len() as u32
        {
            broken.push(Breach::Costly.into());
        }
        if self.told.going == MoveOrder::OneByOne && !self.holds_one_by_one(before, &frame.cells) {
            broken.push(ANY_ORDER);
        }
        broken
    }

    fn broken_at_end(&self, layout: &Layout, chart: &Survey, end: End) -> Vec<ClauseId> {
        match end {
            End::Silent | End::Idle => Vec::new(),
            End::Refused => vec![HEARD],
            End::Explored | End::Exhausted | End::Endless => {
                // A wall that appears may cut robots off: CHAIN-13 is not promised.
                let is_short = self.told.wall.is_none() && !self.missed(layout, chart).is_empty();
                let has_died = self.failures.died.is_some();
                broken([(is_short, if has_died { DEATH } else { Breach::Completeness.into() })])
            }
        }
    }

    fn refusals(&self) -> Vec<Refusal> {
        let Some(Whole::Chain(chain)) = &self.whole else { return Vec::new() };
        let mut chain = (**chain).clone();
        let Ok(plan) = planned(&mut chain, &self.log) else { return Vec::new() };
        let (rule, team, mut grid) = (chain.rule(), chain.cells(), chain.grid().clone());
        let mut refusals = Vec::new();
        for robot in 1..team.len() {
            let mut steps = plan.steps().to_vec();
            for step in Step::ALL.into_iter().filter(|&step| step != plan.steps()[robot]) {
                steps[robot] = step;
                if rule.admits_plan(&mut grid, team, &steps) {
                    continue;
                }
                let alone =
                    (0..).zip(chain::Rule::CONDITIONS).filter(|(bit, _)| rule.in_force() >> bit & 1 == 1);
                let refuses = alone
                    .filter(|(bit, _)| !rule.with_in_force(1 << bit).admits_plan(&mut grid, team, &steps));
                let all: Vec<&str> = refuses.map(|(_, &(name, _))| name).collect();
                let is_wall = !rule.with_in_force(0).admits_plan(&mut grid, team, &steps);
                let by = if is_wall { Vec::new() } else { all };
                refusals.push(Refusal { robot: self.left[robot], step, by });
            }
        }
        refusals
    }

    fn failures(&self) -> Option<Failures> {
        self.is_faulty.then_some(self.failures)
    }

    fn layers(&self) -> Vec<Layer> {
        layers::layers(self.is_faulty)
    }

    fn show(&self, before: &[Cell], scene: &mut Scene) {
        if self.failures.died == Some(self.moves)
            && let Some(robot) = (0..self.cells.len()).find(|robot| !self.left.contains(robot))
        {
            scene.note(Change::Fail { robot });
        }
        for (from, to) in &self.unheard {
            scene.say(layers::LOST, 0, *from, Hearers::These(to.clone()));
        }
        if let Some(Whole::Chain(chain)) = &self.whole {
            let before: Vec<Cell> = self.left.iter().map(|&robot| before[robot]).collect();
            layers::show(chain.grid(), &before, self.epochs < chain.epochs(), scene);
        }
    }
}
