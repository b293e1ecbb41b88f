//! Agents on a small floor as a world whose states are all searched, whatever their scheme: which agent acts next,
//! which sensors it misses and which agents fail are choices. The demands of BRICKS-2 to BRICKS-6 and of ANTS-1 are in
//! plain arithmetic here; of a scheme only what its agents do is used, and what is demanded of it alone.

use std::fmt;
use std::slice;

use tautline_kernel::choice::Oracle;
use tautline_kernel::conditions;
use tautline_kernel::floor::{Mark, Ring, Scan};
use tautline_kernel::ground::{Cell, Step};

use super::crew::{BodyOf, Scheme, SensorData, Sight, View};
use super::plans::{Area, FloorPlan};
use super::small::{Misses, PartOf, Small, StateOf};
use crate::engine::states::{Bits, Places, Run, Step as Made, System};
use crate::engine::world::{self, World, any_of, picked};
use crate::floor_trace::{Course, Scene, Turn};
use crate::judge::{Floor, marks as judge};
use crate::run::{place, sides};

/// How the actions of two agents may overlap.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Turns {
    /// Nothing: every action is one step.
    Whole,
    /// Scanning and writing are two steps, but no agent scans while another whose scan overlaps has yet to write.
    Overlapping,
    /// Scanning and writing are two steps.
    Free,
}

conditions! {
    /// A property of the floor by another reading than the published one; agents know nothing of it.
    pub enum FloorProperty in u16 {
        /// The cell in which an agent starts counts nothing until the agent enters it.
        UncountedStart,
        /// In some cells, as many as sensors may be missed, sensors are always missed.
        Dark,
    }
}

/// Teams to look at: all plans of an area, how many agents start in any of their cells, and what may go wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Series {
    pub(crate) area: Area,
    pub(crate) agents: u32,
    /// Sensors that are missed in one run at most.
    pub(crate) max_misses: u8,
    pub(crate) turns: Turns,
    /// How many times in a row an agent may act while another waits.
    pub(crate) max_streak: Option<u8>,
    /// Whether agents may fail, all but one: they act no more, and have not left.
    pub(crate) may_fail: bool,
    /// Idle moves before an agent goes round, in schemes in which it does.
    pub(crate) patience: u8,
    /// How far sensors count crossings, where that is bounded, so that runs that go on for ever come round.
    pub(crate) most_crossings: Option<u32>,
}

/// A demand on a team, or several.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Demand<D> {
    /// BRICKS-2, BRICKS-3
    Connected,
    /// BRICKS-4
    Knowing,
    /// ANTS-1, BRICKS-5: the run is over when every cell is explored.
    Explores,
    /// BRICKS-6, BRICKS-11
    Ends,
    /// A demand on this scheme alone.
    Own(D),
    /// BRICKS-2, BRICKS-4, BRICKS-6, and demands on this scheme alone, looked at in one pass.
    All,
}

/// A scheme of which something is demanded on small floors.
pub(crate) trait Demands: Scheme {
    /// The demands on this scheme alone.
    type Own: Copy + PartialEq + fmt::Debug + Send + Sync;

    /// The words for so many agents of the series in this place of a bound.
    fn name(place: usize, agents: u32) -> &'static str {
        match (place, agents) {
            (0, 1) => " agent",
            (0, _) => " agents",
            _ => "",
        }
    }

    /// The bounds of agents on small floors that no series has, in words.
    fn bounds() -> Option<String> {
        None
    }

    /// The scheme whose agents go round after so many idle moves.
    fn with_patience(self, _: u8) -> Self {
        self
    }

    /// Makes an agent one that acts no more.
    fn fail(body: &mut BodyOf<Self>) {
        body.has_failed = true;
    }

    /// Forgets what the agent with this id, which acts no more, has no use for.
    fn forget(_: &mut Self::Memory, _: u8) {}

    /// The demands on this scheme alone that belong to [`Demand::All`].
    fn of_all() -> &'static [Self::Own] {
        &[]
    }

    /// Whether a run is over for what is demanded.
    fn is_over(_: Self::Own, _: &StateOf<Self>) -> bool {
        false
    }

    /// Whether the cells that an agent enters are counted for what is demanded.
    fn counts_moves(_: Self::Own) -> bool {
        false
    }

    /// The words of what is demanded, if a decision breaks it.
    fn broken_by_act(_: Self::Own, _: &View<Self>, _: &Self::Act) -> Option<&'static str> {
        None
    }

    /// The words of what is demanded, if it is broken in a state on a plan in which this agent has just acted.
    fn broken_in(_: Self::Own, _: &FloorPlan, _: &StateOf<Self>, _: usize) -> Option<&'static str> {
        None
    }
}

/// Agents of a scheme on a plan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Team<S: Demands> {
    pub(crate) plan: FloorPlan,
    pub(crate) scheme: S,
    pub(crate) series: Series,
    pub(crate) demand: Demand<S::Own>,
    pub(crate) given: Conditions,
    /// The cells whose sensors are always missed.
    pub(crate) dark: u16,
}

/// The turn of an agent.
#[derive(Debug)]
pub(crate) struct Action {
    pub(crate) agent: usize,
    /// Where it goes.
    step: Step,
    /// The cells around that read as unexplored to it, if it misses sensors.
    unread: Ring,
    /// Whether it fails instead of acting.
    fails: bool,
    /// The words of the demand that its decision breaks.
    breaks: Option<&'static str>,
}

impl<S: Demands> Team<S> {
    /// The start with the agents in these cells.
    fn start(&self, cells: &[Cell]) -> StateOf<S> {
        let mut state = StateOf::<S>::start(&self.scheme, &self.plan, cells);
        if self.given.has(FloorProperty::UncountedStart) {
            state.sensors.count_to(0);
        }
        self.forget(&mut state);
        state
    }

    /// The starts, each agent in any free cell.
    pub(crate) fn starts(&self) -> impl Iterator<Item = StateOf<S>> {
        self.plan.starts(self.series.agents).map(|cells| self.start(&cells))
    }

    /// Leaves out of the state what no agent ever reads.
    fn forget(&self, state: &mut StateOf<S>) {
        for (id, body) in (0..).zip(&mut state.bodies).filter(|(_, body)| !body.is_awake()) {
            S::forget(&mut body.memory, id);
        }
        let sight = if self.series.max_misses == 0 { Sight::Whole } else { Sight::Partial };
        let most_crossings =
            if self.scheme.reads_crossings(sight) { self.series.most_crossings } else { Some(0) };
        if let Some(most) = most_crossings {
            state.sensors.count_to(most);
        }
        if !self.scheme.reads_serials(sight) {
            state.sensors.forget_serials();
        }
    }

    /// The cells that are left to go through.
    fn left(&self, state: &StateOf<S>) -> u16 {
        state.sensors.cells(&self.plan, |sensor| self.scheme.is_left(sensor.mark()))
    }

    fn is_explored(&self, state: &StateOf<S>) -> bool {
        state.sensors.is_explored(&self.plan)
    }

    /// Whether something of which [`Demand::All`] is made is demanded.
    fn is_asked(&self, one: Demand<S::Own>) -> bool {
        self.demand == one || self.demand == Demand::All
    }

    /// The demands on this scheme alone that are looked at.
    fn own(&self) -> &[S::Own] {
        match &self.demand {
            Demand::Own(own) => slice::from_ref(own),
            Demand::All => S::of_all(),
            Demand::Connected | Demand::Knowing | Demand::Explores | Demand::Ends => &[],
        }
    }

    /// The words of a demand that is broken in `state`, which `agent` has made of the one `before`.
    fn broken(&self, before: &StateOf<S>, state: &StateOf<S>, agent: usize) -> Option<&'static str> {
        if self.is_asked(Demand::Connected) && !state.sensors.is_marked_as(&before.sensors) {
            let left = self.left(state);
            if self.plan.spread(left, state.sensors.shut(&self.plan)) != left {
                return Some("the accessible cells stay connected");
            }
        }
        let body = &state.bodies[agent];
        if self.is_asked(Demand::Knowing) && body.is_done {
            if !self.is_explored(state) {
                return Some("an agent is done only when every cell is explored");
            }
            let here = self.plan.place(body.cell).map_or(0, |place| 1 << place);
            if self.left(state) & !here != 0 {
                return Some("an agent is done only when no other cell is left");
            }
        }
        self.own().iter().find_map(|&own| S::broken_in(own, &self.plan, state, agent))
    }

    fn scene(&self, state: &StateOf<S>) -> Scene {
        let mark = |cell| Some((cell, state.sensors.all[self.plan.place(cell)?].mark()));
        Scene {
            cells: state.bodies.iter().map(|body| body.cell).collect(),
            marks: self.plan.cells().filter_map(mark).collect(),
        }
    }

    /// `run`, which begins in `state` and is said to break `clause`, written down for the judge; with marks if they
    /// matter.
    pub(crate) fn written(
        &self,
        clause: &'static str,
        start: StateOf<S>,
        run: &Run<&str>,
        has_marks: bool,
    ) -> judge::Run {
        let mark = |state: &StateOf<S>, cell| {
            let at = self.plan.place(cell)?;
            match state.sensors.all[at].mark() {
                Mark::Unexplored => None,
                Mark::Explored => Some(judge::Mark::Explored),
                Mark::Closing => Some(judge::Mark::Closing),
                Mark::Visited | Mark::Sealed => Some(judge::Mark::Visited),
            }
        };
        let turn = |(before, made): (StateOf<S>, Made<Self>)| {
            let Action { agent, fails, step, .. } = made.event;
            let (from, body) = (before.bodies[agent].cell, &made.state.bodies[agent]);
            let fate = match (fails, body.is_awake()) {
                (true, _) => judge::Fate::Fails,
                (false, true) => judge::Fate::Awake,
                (false, false) => judge::Fate::Done,
            };
            let (known, new) = (|cell| mark(&before, cell), |cell| mark(&made.state, cell));
            let changed = self.plan.cells().filter(|&cell| has_marks && new(cell) != known(cell));
            let written = |cell| Some(judge::Write { at: place(cell), mark: new(cell)? });
            let writes = judge::Write::in_order(changed.filter_map(written).collect());
            let is_shut = known(body.cell).is_some_and(|mark| mark != judge::Mark::Explored);
            let is_missed = has_marks && body.cell != from && (is_shut || new(body.cell) < known(body.cell));
            let side = match step {
                Step::Cross(side) => Some(side as usize),
                Step::Stay => None,
            };
            judge::Turn { agent, side, fate, writes, is_missed }
        };
        let Course { width, height, blocked, walls, round, .. } = self.course(start.clone(), run);
        judge::Run {
            clause,
            floor: Floor {
                columns: width.into(),
                rows: height.into(),
                barred: blocked.into_iter().map(place).collect(),
            },
            walls: walls.into_iter().map(sides).collect(),
            starts: start.bodies.iter().map(|body| place(body.cell)).collect(),
            turns: run.played(self, start).map(turn).collect(),
            round,
        }
    }

    /// The turns of `run`, which begins in `state`.
    pub(crate) fn course(&self, mut state: StateOf<S>, run: &Run<&str>) -> Course {
        let mut turns = Vec::new();
        for (before, made) in run.played(self, state.clone()) {
            let Action { agent, step, unread, .. } = made.event;
            let place = |cell| self.plan.place(cell);
            let mark = |cell| place(cell).map_or(Mark::Unexplored, |place| before.sensors.all[place].mark());
            let scan = Scan { unexplored: unread, ..Scan::default() };
            let unseen = scan.misread(mark, before.bodies[agent].cell).collect();
            let is_done = !made.state.bodies[agent].is_awake();
            turns.push(Turn { before: self.scene(&before), agent, step, is_done, unseen });
            state = made.state;
        }
        self.plan.course(turns, run.round().len(), self.scene(&state))
    }
}

impl<S: Demands> World for Team<S> {
    type State = StateOf<S>;
    /// The agents that may act, and once more those that may fail.
    type Plan = Vec<(usize, bool)>;
    type Event = Action;
    type Demand = &'static str;

    fn plan(&self, state: &mut StateOf<S>, _: &[u8]) -> Option<Self::Plan> {
        let Series { turns, max_streak, may_fail, .. } = self.series;
        let is_over = match self.demand {
            Demand::Connected | Demand::Knowing | Demand::Ends | Demand::All => false,
            Demand::Explores => self.is_explored(state),
            Demand::Own(own) => S::is_over(own, state),
        };
        if is_over {
            return None;
        }
        let awake = state.awake().count_ones();
        let is_locked = |agent: usize| {
            let body = &state.bodies[agent];
            turns == Turns::Overlapping
                && body.pending.is_none()
                && state.bodies.iter().any(|other| {
                    let (dx, dy) = body.cell.apart(other.cell);
                    other.pending.is_some() && dx.max(dy) <= 2
                })
        };
        let is_tired =
            |agent: usize| awake > 1 && max_streak.is_some_and(|most| state.streak == (agent as u8, most));
        let is_ready =
            |&agent: &usize| state.bodies[agent].is_awake() && !is_locked(agent) && !is_tired(agent);
        let ready = || (0..state.bodies.len()).filter(is_ready);
        let failing = ready().filter(|_| may_fail && awake > 1);
        any_of(ready().map(|agent| (agent, false)).chain(failing.map(|agent| (agent, true))).collect())
    }

    fn settle(
        &self,
        state: &mut StateOf<S>,
        ready: &Self::Plan,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Action {
        let (agent, fails) = picked(ready, world);
        let mut action = Action { agent, step: Step::Stay, unread: Ring::default(), fails, breaks: None };
        if let Some(most) = self.series.max_streak {
            let again = if state.streak.0 == agent as u8 { state.streak.1 } else { 0 };
            state.streak = (agent as u8, most.min(again + 1));
        }
        let body = &mut state.bodies[agent];
        if fails {
            S::fail(body);
            return action;
        }
        let mut floor = Small { plan: &self.plan, sensors: &mut state.sensors, dark: 0 };
        let (act, is_due) = if let Some(act) = body.pending.take() {
            (act, true)
        } else {
            let most = if self.given.has(FloorProperty::Dark) { 0 } else { self.series.max_misses };
            let mut world = Misses::new(world, &mut state.misses, most);
            // The sensor underfoot is always found.
            floor.dark = self.dark & !self.plan.place(body.cell).map_or(0, |place| 1 << place);
            let view = S::Sensor::look(&floor, body.cell, &mut world);
            floor.dark = 0;
            if world.missed != 0 || self.dark != 0 {
                action.unread = S::Sensor::scan(&view).unexplored;
            }
            let act = self.scheme.decide(&mut body.memory, &view);
            action.breaks = self.own().iter().find_map(|&own| S::broken_by_act(own, &view, &act));
            (act, self.series.turns == Turns::Whole)
        };
        if is_due {
            action.step = body.carry_out(&self.scheme, &mut floor, &act);
            let is_counted = || self.own().iter().any(|&own| S::counts_moves(own));
            if action.step != Step::Stay && is_counted() {
                body.moves = body.moves.saturating_add(1);
            }
        } else {
            body.pending = Some(act);
        }
        self.forget(state);
        action
    }

    fn broken_by(&self, turn: &world::Turn<'_, Self>) -> Vec<&'static str> {
        let Action { agent, fails, breaks, .. } = *turn.event;
        let broken = || if fails { None } else { self.broken(turn.before, turn.after, agent) };
        breaks.or_else(broken).into_iter().collect()
    }

    fn broken_at_end(&self, state: &StateOf<S>, _: &[u8]) -> Vec<&'static str> {
        let is_done = |sensor: &S::Sensor| matches!(sensor.mark(), Mark::Visited | Mark::Sealed);
        let broken = match self.demand {
            Demand::Connected | Demand::Knowing | Demand::Own(_) => None,
            Demand::Explores => (!self.is_explored(state)).then_some("every cell is explored"),
            Demand::Ends | Demand::All => (state.sensors.cells(&self.plan, is_done) != self.plan.free)
                .then_some("when all agents are done, every cell is visited"),
        };
        broken.into_iter().collect()
    }
}

impl<S: Demands> System for Team<S> {
    type Part = PartOf<S>;

    fn places(&self, state: &StateOf<S>) -> usize {
        state.places()
    }

    fn part(&self, state: &StateOf<S>, place: usize) -> PartOf<S> {
        state.part(place)
    }

    fn differing(&self, one: &StateOf<S>, other: &StateOf<S>) -> Places {
        one.differing(other)
    }

    fn put(&self, state: &mut StateOf<S>, place: usize, part: &PartOf<S>) {
        state.put(place, part);
    }

    fn acting(&self, turn: &world::Turn<'_, Self>) -> Bits {
        if turn.event.fails { 0 } else { 1 << turn.event.agent }
    }

    fn is_bound(&self, turn: &world::Turn<'_, Self>) -> bool {
        !turn.event.fails
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        match self.demand {
            Demand::Connected | Demand::Knowing | Demand::Own(_) => None,
            Demand::Explores => Some("every cell is explored: no run goes on for ever before"),
            Demand::Ends | Demand::All => {
                Some("no run goes on for ever in which every agent acts again and again")
            }
        }
    }

    fn awake(&self, state: &StateOf<S>) -> Bits {
        state.awake()
    }
}
