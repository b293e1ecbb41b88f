//! A team in its setting, as every engine plays it.

use std::ops::ControlFlow;

use tautline_kernel::chain::Kind;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Step};

use super::ground::{Map, passes};
use super::rule::{Act, Body, Demand, Rule, Scene, TeamState, TeamStep, View};
use super::{Moves, Promise, Setting, Strategy};
use crate::decide::MethodError;
use crate::engine::states::{self, Bits, Places, System};
use crate::engine::tree::{Game, Limits, Tree};
use crate::engine::world::{Turn, World};
use crate::engine::{SeededOracle, Until};
use crate::run::Frame;

/// A team that follows a rule in its setting.
pub struct TeamWorld<'a, R: Rule> {
    pub(super) setting: &'a Setting<'a, R>,
    pub(super) rule: R,
    /// The demands that are looked at, each as if it stood alone.
    pub(super) wanted: Vec<Promise>,
    /// The first scene.
    pub(super) start: Scene<R>,
}

/// Teams in a setting.
impl<'a, R: Rule> Setting<'a, R> {
    /// The search for teams that follow `rule`, as a tree, at its start: it can be made wave by wave, left and taken up
    /// again. It is for the demands that are `wanted`, or for all if none is said to be; each is decided as if it stood
    /// alone, so a run goes on until it has broken all of them.
    ///
    /// # Errors
    /// [`MethodError`] if the setting is not one for a [tree](Strategy::Tree), or the limits are beyond what can be
    /// searched.
    pub fn search(
        &'a self,
        rule: &R,
        until: Until,
        wanted: &[Promise],
    ) -> Result<Tree<TeamWorld<'a, R>>, MethodError> {
        if self.strategy() != Strategy::Tree {
            let why = "a tree of runs is of one start in one layout, in which robots move together and lose nothing: \
                       decide by `Keeps`, which searches the states of all else";
            return Err(MethodError::new(why));
        }
        let playing = self.playing(rule, wanted)?;
        let max_walls = self.ground.walls.most_met() + self.ground.obstacles.most_met();
        Tree::new(playing, &Limits { max_walls, budget_moves: None, until }).map_err(MethodError::new)
    }

    /// A team that follows `rule` in it; of its demands those are looked at that are `wanted`, or all if none is.
    ///
    /// # Errors
    /// [`MethodError`] as of [`Self::starts`], or if there is no start, or no such demand, or if states would be
    /// searched for several demands on endless runs.
    pub fn playing(&'a self, rule: &R, wanted: &[Promise]) -> Result<TeamWorld<'a, R>, MethodError> {
        let start = self.starts(rule)?.into_iter().next();
        let start = start.ok_or_else(|| MethodError::new("there is no layout to start in"))?;
        self.playing_from(rule, wanted, start)
    }

    /// A team as of [`Self::playing`] that begins so.
    pub(super) fn playing_from(
        &'a self,
        rule: &R,
        wanted: &[Promise],
        start: Scene<R>,
    ) -> Result<TeamWorld<'a, R>, MethodError> {
        let demands = self.demands.len();
        if let Some(Promise(none)) = wanted.iter().find(|promise| promise.0 >= demands) {
            let why = format_args!("there is no demand {none}: the setting has {demands}");
            return Err(MethodError::new(why));
        }
        let wanted = if wanted.is_empty() { (0..demands).map(Promise).collect() } else { wanted.to_vec() };
        let is_endless = |promise: &&Promise| self.demands[promise.0].is_broken_by_endless_runs();
        if self.strategy() == Strategy::States && wanted.iter().filter(is_endless).count() > 1 {
            let why = "states are searched for one demand on endless runs at a time: name it";
            return Err(MethodError::new(why));
        }
        Ok(TeamWorld { setting: self, rule: rule.clone(), wanted, start })
    }

    /// A team that follows `rule` from these cells, to these goals if there are any, in a layout of any size that
    /// answers for itself. All its demands are looked at.
    pub fn in_layout(&'a self, rule: &R, starts: &[Cell], goals: Vec<Cell>) -> TeamWorld<'a, R> {
        let wanted = (0..self.demands.len()).map(Promise).collect();
        TeamWorld { setting: self, rule: rule.clone(), wanted, start: Self::scene(rule, starts, goals, None) }
    }
}

/// The event of a step.
#[derive(Clone, Debug)]
pub struct Event {
    /// The robots that acted, a bit for each; none if one died.
    pub(super) acted: Bits,
    /// Those of them that looked, and did not just carry out what they had decided before.
    pub(super) looked: Bits,
    /// The robot that died.
    pub(super) died: Option<usize>,
    /// The sender and the receiver of each message that was lost.
    pub(super) lost: Vec<(usize, usize)>,
    pub(super) steps: Vec<Step>,
    blocked: Vec<bool>,
}

impl<'a, R: Rule> TeamWorld<'a, R> {
    /// The robots that have something left to do, a bit for each. A robot that has looked still makes its move.
    fn awake(&self, scene: &Scene<R>) -> Bits {
        let is_due = |robot: usize| scene.bodies[robot].pending.is_some() || !self.rule.is_done(robot, scene);
        let is_awake = |&robot: &usize| !scene.is_dead(robot) && is_due(robot);
        (0..scene.robots()).filter(is_awake).fold(0, |set, robot| set | 1 << robot)
    }

    /// The robots that act in the next step.
    fn acting(&self, awake: Bits, world: &mut impl Oracle) -> Bits {
        let ready: Vec<usize> = (0..Bits::BITS as usize).filter(|robot| awake >> robot & 1 == 1).collect();
        match self.setting.moves {
            _ if ready.len() < 2 => awake,
            Moves::Together => awake,
            Moves::OneAtATime | Moves::LookThenMove => 1 << ready[world.pick(ready.len() as u32) as usize],
            Moves::AnySubset => {
                let subset = 1 + world.pick((1 << ready.len()) - 1);
                ready
                    .iter()
                    .zip(0..)
                    .filter(|(_, bit)| subset >> bit & 1 == 1)
                    .fold(0, |set, (robot, _)| set | 1 << robot)
            }
        }
    }

    /// The robot that dies, if one may and the world is against it.
    fn dies(&self, scene: &mut Scene<R>, awake: Bits, world: &mut impl Oracle) -> Option<usize> {
        if scene.deaths >= self.setting.deaths || !world.mishap() {
            return None;
        }
        let ready: Vec<usize> = (0..scene.robots()).filter(|robot| awake >> robot & 1 == 1).collect();
        let robot = ready[world.pick(ready.len() as u32) as usize];
        scene.bodies[robot].is_dead = true;
        scene.bodies[robot].pending = None;
        scene.bodies[robot].heard.clear();
        scene.deaths += 1;
        Some(robot)
    }

    /// The messages that were sent arrive, or are lost; the sender and the receiver of each that is.
    fn deliver(
        &self,
        scene: &mut Scene<R>,
        sent: Vec<(usize, R::Message)>,
        world: &mut impl Oracle,
    ) -> Vec<(usize, usize)> {
        let mut lost = Vec::new();
        for (from, message) in sent {
            for to in (0..scene.robots()).filter(|&to| to != from) {
                if scene.is_dead(to) {
                    continue;
                }
                if scene.losses < self.setting.losses && !world.arrives(from, to) {
                    scene.losses += 1;
                    lost.push((from, to));
                    continue;
                }
                let heard = &mut scene.bodies[to].heard;
                heard.retain(|(other, _)| *other != from);
                heard.push((from, message.clone()));
            }
        }
        lost
    }

    /// The demands that are wanted and of which this is so.
    pub fn broken(&self, is_broken: impl Fn(&Demand<'_, R>) -> bool) -> Vec<Promise> {
        let is_broken = |promise: &Promise| self.setting.demands.get(promise.0).is_some_and(&is_broken);
        self.wanted.iter().copied().filter(is_broken).collect()
    }

    /// The demands that a run may break by never ending.
    pub fn broken_by_never_ending(&self) -> Vec<Promise> {
        self.broken(is_endless)
    }

    /// The obligations of those demands that are wanted and may be broken by never ending: a run that goes round breaks
    /// the ones of which it owes something throughout.
    pub fn obligations(&self, scene: &Scene<R>) -> Vec<(Promise, Bits)> {
        let owed = |promise: Promise| (promise, self.demand(promise).owed(scene));
        self.broken_by_never_ending().into_iter().map(owed).collect()
    }

    /// The demands that a run breaks by coming back to `first` again and again. A round in which the world had nothing
    /// to answer is played again for what is owed throughout it.
    fn broken_by_round(&self, first: &Scene<R>) -> Vec<Promise> {
        let mut owed = self.obligations(first);
        let mut scene = first.clone();
        for _ in 0..self.setting.longest_run {
            let is_open =
                |&(promise, owed): &(Promise, Bits)| owed != 0 && self.demand(promise).is_owed_again();
            if !owed.iter().any(is_open) {
                break;
            }
            let Some(awake) = self.plan(&mut scene, &[]) else { break };
            self.settle(&mut scene, &awake, &mut Vec::new(), &mut SeededOracle::new(0, 0));
            if scene.bodies == first.bodies {
                break;
            }
            for (promise, owed) in &mut owed {
                *owed &= self.demand(*promise).owed(&scene);
            }
        }
        owed.into_iter().filter(|&(_, owed)| owed != 0).map(|(promise, _)| promise).collect()
    }

    /// The demands that are wanted and are met for good in a run that has come to this.
    pub fn met(&self, scene: &Scene<R>) -> Vec<Promise> {
        self.broken(|demand| demand.is_met_by(scene))
    }

    /// This team, of whose demands only these are looked at.
    #[must_use]
    pub fn wanting(self, wanted: &[Promise]) -> Self {
        Self { wanted: wanted.to_vec(), ..self }
    }

    /// The demand with this number.
    pub fn demand(&self, Promise(demand): Promise) -> &Demand<'a, R> {
        &self.setting.demands[demand]
    }
}

impl Event {
    /// The step as a person sees it, once it has led to `scene`.
    pub fn frame<M, T>(&self, scene: &TeamState<M, T>) -> Frame {
        let Self { steps, blocked, .. } = self.clone();
        Frame { kind: Kind::Advance, steps, blocked, cells: scene.cells().collect() }
    }
}

impl<R: Rule> World for TeamWorld<'_, R> {
    type State = Scene<R>;
    type Plan = Bits;
    type Event = Event;
    type Demand = Promise;

    /// The robots that have something left to do.
    fn plan(&self, scene: &mut Scene<R>, _: &[u8]) -> Option<Bits> {
        let awake = self.awake(scene);
        let is_met = |promise: &Promise| {
            self.setting.demands.get(promise.0).is_some_and(|demand| demand.is_met_by(scene))
        };
        let is_over = awake == 0 || !self.wanted.is_empty() && self.wanted.iter().all(is_met);
        (!is_over).then_some(awake)
    }

    fn settle(&self, scene: &mut Scene<R>, &awake: &Bits, _: &mut Vec<u8>, world: &mut impl Oracle) -> Event {
        let robots = scene.robots();
        let (steps, blocked) = (vec![Step::Stay; robots], vec![false; robots]);
        let mut event = Event { acted: 0, looked: 0, died: None, lost: Vec::new(), steps, blocked };
        event.died = self.dies(scene, awake, world);
        if event.died.is_some() {
            return event;
        }
        event.acted = self.acting(awake, world);
        let before = scene.clone();
        let mut sent = Vec::new();
        let acting = (0..robots).filter(|robot| event.acted >> robot & 1 == 1);
        for robot in acting {
            let act = if let Some(act) = scene.bodies[robot].pending.take() {
                act
            } else {
                event.looked |= 1 << robot;
                let map = &mut scene.map;
                let (Setting { senses, ground, .. }, sent) = (self.setting, &mut sent);
                let mut view = View { senses: *senses, ground, robot, scene: &before, map, world, sent };
                let body = &mut scene.bodies[robot];
                let act = self.rule.act(&mut view, &mut body.memory);
                body.heard.clear();
                if self.setting.moves == Moves::LookThenMove && act != Act::Wait {
                    body.pending = Some(act);
                    continue;
                }
                act
            };
            let Act::Go(side) = act else { continue };
            event.steps[robot] = Step::Cross(side);
        }
        for (robot, &step) in event.steps.iter().enumerate() {
            let cell = before.cell(robot);
            let body = &mut scene.bodies[robot];
            if event.acted >> robot & 1 == 1 && body.pending.is_none() {
                body.is_blocked = false;
            }
            let Step::Cross(side) = step else { continue };
            body.is_blocked = !passes(&self.setting.ground, &mut scene.map, (cell, side), world);
            event.blocked[robot] = body.is_blocked;
            if !body.is_blocked {
                body.cell = cell.after(step);
            }
        }
        event.lost = self.deliver(scene, sent, world);
        event
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Promise> {
        let moved = TeamStep { before: turn.before, after: turn.after };
        self.broken(|demand| demand.is_broken_by(&moved))
    }

    fn broken_at_end(&self, scene: &Scene<R>, _: &[u8]) -> Vec<Promise> {
        self.broken(|demand| demand.is_broken_at_end(scene))
    }

    fn covers(&self) -> Vec<&'static str> {
        self.setting.covers.iter().map(|&(name, _)| name).collect()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        let moved = TeamStep { before: turn.before, after: turn.after };
        let occurs = self.setting.covers.iter().zip(0..).filter(|((_, is_one), _)| is_one(&moved));
        occurs.fold(0, |bits, (_, bit)| bits | 1 << bit)
    }
}

impl<R: Rule> Game for TeamWorld<'_, R> {
    type Frame = (Frame, Option<Map>);

    fn start(&self) -> Scene<R> {
        self.start.clone()
    }

    fn frame(&self, turn: &Turn<'_, Self>) -> Self::Frame {
        (turn.event.frame(turn.after), turn.after.map)
    }

    fn wanted(&self) -> &[Promise] {
        &self.wanted
    }

    fn words(&self, Promise(demand): Promise, _: Option<&Turn<'_, Self>>) -> &'static str {
        self.setting.demands[demand].words
    }

    /// The layout as far as it is decided takes part: a team that comes back and has met more is not where it was.
    fn recurs(&self, then: &Scene<R>, _: usize, now: &Scene<R>, _: &[u8]) -> ControlFlow<Vec<Promise>> {
        if (&then.bodies, then.map) != (&now.bodies, now.map) {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break(self.broken_by_round(then))
    }

    fn edges(&self) -> u32 {
        self.setting.ground.mishaps() + self.setting.losses + self.setting.deaths
    }

    fn longest_run(&self) -> u32 {
        self.setting.longest_run
    }
}

/// Whether a run without end breaks a demand.
fn is_endless<R: Rule>(demand: &Demand<'_, R>) -> bool {
    demand.is_broken_by_endless_runs()
}

/// A part of a scene.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Part<M, T> {
    /// A robot.
    Robot(Body<M, T>),
    /// All but the robots.
    Rest {
        /// Where robots are to go.
        goals: Vec<Cell>,
        /// The layout as far as it is decided.
        map: Option<Box<Map>>,
        /// Messages that were lost.
        losses: u32,
        /// Robots that have died.
        deaths: u32,
    },
}

impl<R: Rule> System for TeamWorld<'_, R> {
    type Part = Part<R::Memory, R::Message>;

    fn places(&self, scene: &Scene<R>) -> usize {
        scene.robots() + 1
    }

    fn part(&self, scene: &Scene<R>, place: usize) -> Self::Part {
        let TeamState { bodies, goals, map, losses, deaths } = scene;
        let rest =
            || Part::Rest { goals: goals.clone(), map: map.map(Box::new), losses: *losses, deaths: *deaths };
        bodies.get(place).cloned().map_or_else(rest, Part::Robot)
    }

    fn differing(&self, one: &Scene<R>, other: &Scene<R>) -> Places {
        let bodies = one.bodies.iter().zip(&other.bodies).map(|(one, other)| one != other);
        let rest = |scene: &Scene<R>| (scene.map, scene.losses, scene.deaths);
        states::places(bodies.chain([rest(one) != rest(other) || one.goals != other.goals]))
    }

    fn put(&self, scene: &mut Scene<R>, place: usize, part: &Self::Part) {
        match part {
            Part::Robot(body) => scene.bodies[place].clone_from(body),
            Part::Rest { goals, map, losses, deaths } => {
                scene.goals.clone_from(goals);
                (scene.map, scene.losses, scene.deaths) = (map.as_deref().copied(), *losses, *deaths);
            }
        }
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        turn.event.acted
    }

    /// Nobody is bound to die.
    fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
        turn.event.acted != 0
    }

    fn broken_by_endless_runs(&self) -> Option<Promise> {
        self.broken_by_never_ending().first().copied()
    }

    fn owed(&self, scene: &Scene<R>) -> Bits {
        self.obligations(scene).first().map_or(0, |&(_, owed)| owed)
    }

    fn awake(&self, scene: &Scene<R>) -> Bits {
        Self::awake(self, scene)
    }
}
