//! Agents that search in trees on one plan: which agent acts next, which sensors it misses and which agents fail are
//! choices. What the clauses demand is in plain arithmetic; of the kernel's rule only the agents' actions are used.

use tautline_kernel::bricks::tree::{Next, State as Cellular, View};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{COMPASS, Mark};
use tautline_kernel::ground::{Cell, Side, Step};

use super::state::{Body, Part, Small, State};
use super::{Deception, Way};
use crate::engine::outcomes;
use crate::engine::states::{Bits, Places, Run, System};
use crate::engine::world::{self, any_of, picked};
use crate::floor::plans::{Edges, FloorPlan};
use crate::floor::small::Misses;
use crate::floor_trace::{Course, Scene, Turn};

pub(super) use crate::bricks::team::Turns;

/// What a team is looked at for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Demand {
    /// BRICKS-2, BRICKS-3
    Connected,
    /// BRICKS-4
    Knowing,
    /// BRICKS-5
    Explores,
    /// BRICKS-6, BRICKS-11
    Ends,
    /// BRICKS-8
    Whole,
    /// BRICKS-9
    Rising,
    /// BRICKS-10
    Bounded,
    /// BRICKS-12
    Twice,
    /// BRICKS-13
    LeastEntered,
    /// BRICKS-2, BRICKS-4, BRICKS-5, BRICKS-6, BRICKS-8, BRICKS-9, and where no sensor is missed BRICKS-13, looked at
    /// in one pass.
    All,
}

/// Agents that decide in one way on a plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Team {
    pub(super) plan: FloorPlan,
    pub(super) way: Way,
    pub(super) deception: Deception,
    pub(super) turns: Turns,
    /// Sensors that are missed in one run at most.
    pub(super) max_misses: u8,
    /// Whether agents may fail, all but one.
    pub(super) may_fail: bool,
    /// Where sensors count crossings no farther than to this, so that runs that go on for ever come round.
    pub(super) most_crossings: u16,
    pub(super) demand: Demand,
}

impl Team {
    /// The start with the agents in these cells.
    pub(super) fn start(&self, cells: &[Cell]) -> State {
        let body = |(id, &cell)| Body::new(self.way.memory(id), cell);
        let mut state = State::start(&self.plan, cells, (0..).zip(cells).map(body).collect());
        state.count_to(self.most_crossings);
        state
    }

    /// The starts of `agents`, each in any free cell.
    pub(super) fn starts(&self, agents: u32) -> impl Iterator<Item = Box<State>> {
        self.plan.starts(agents).map(|cells| Box::new(self.start(&cells)))
    }

    /// What is broken in `state`, in which `agent` has just acted.
    fn broken(&self, state: &State, agent: usize) -> Option<&'static str> {
        let Self { plan, demand, .. } = self;
        let is_asked = |one| *demand == one || *demand == Demand::All;
        if is_asked(Demand::Connected) {
            let left = state.left(plan);
            if plan.spread(left, Edges::default()) != left {
                return Some("the accessible cells stay connected");
            }
        }
        let Body { cell, is_done, moves, .. } = state.bodies[agent];
        if is_asked(Demand::Knowing) && is_done {
            let here = plan.place(cell).map_or(0, |place| 1 << place);
            if !state.is_explored(plan) {
                return Some("an agent is done only when every cell is explored");
            }
            if state.left(plan) & !here != 0 {
                return Some("an agent is done only when no other cell is left");
            }
        }
        if is_asked(Demand::Whole) && !state.are_trees_whole(plan) {
            return Some("the cells of a tree stay connected through trees whose labels are not lower");
        }
        if is_asked(Demand::Rising) && !state.do_labels_rise(plan) {
            return Some("labels never fall towards the root");
        }
        let is_beyond = |each| u32::from(moves) > each * plan.free.count_ones();
        if *demand == Demand::Bounded && founded(state) <= 1 && is_beyond(4) {
            return Some("with one tree an agent makes at most four moves a cell");
        }
        (*demand == Demand::Twice && is_beyond(2)).then_some("an agent alone makes at most two moves a cell")
    }
}

impl Team {
    /// Every turn from `state`; none once the run is over.
    fn turns(&self, state: &State) -> impl Iterator<Item = Turned> {
        outcomes(|world| self.turn(state, world))
    }

    fn turn(&self, state: &State, world: &mut dyn Oracle) -> Option<Turned> {
        let awake = awake(state);
        let is_over = match self.demand {
            Demand::Explores => state.is_explored(&self.plan),
            Demand::Bounded => founded(state) > 1,
            Demand::Connected
            | Demand::Knowing
            | Demand::Ends
            | Demand::Whole
            | Demand::Rising
            | Demand::Twice
            | Demand::LeastEntered
            | Demand::All => false,
        };
        if awake == 0 || is_over {
            return None;
        }
        let is_locked = |agent: usize| {
            let Body { pending, cell, .. } = state.bodies[agent];
            self.turns == Turns::Overlapping
                && pending.is_none()
                && state.bodies.iter().any(|other| {
                    let (dx, dy) = cell.apart(other.cell);
                    other.pending.is_some() && dx.max(dy) <= 2
                })
        };
        let mut ready = (0..state.bodies.len()).filter(|&agent| awake >> agent & 1 == 1 && !is_locked(agent));
        let of = ready.clone().count() as u32;
        let may_fail = self.may_fail && awake.count_ones() > 1;
        let pick = if of > 1 || may_fail { world.pick(of << u32::from(may_fail)) } else { 0 };
        let agent = ready.nth((pick % of) as usize)?;
        let mut state = Box::new(state.clone());
        let body = &mut state.bodies[agent];
        if pick >= of {
            body.has_failed = true;
            return Some(Turned {
                state,
                agent,
                step: Step::Stay,
                unseen: Vec::new(),
                fails: true,
                breaks: None,
            });
        }
        let mut floor = Small { plan: &self.plan, notes: &mut state.notes };
        let (mut unseen, mut is_least_entered) = (Vec::new(), true);
        let (act, is_due) = if let Some(act) = body.pending.take() {
            (act, true)
        } else {
            let missed = state.misses;
            let mut world = Misses { world, count: &mut state.misses, most: self.max_misses };
            let view = View::new(&floor, body.cell, &mut world);
            if state.misses > missed {
                let mark = |cell| self.plan.place(cell).map_or(Mark::Unexplored, |at| floor.notes[at].mark());
                unseen = view.scan.misread(mark, body.cell).collect();
            }
            let mut act = self.way.decide(&mut body.memory, &view);
            if let (Deception::FirstChild, Next::Goes(side)) = (self.deception, act.next)
                && entered(&view, side).is_some()
            {
                let first = COMPASS.into_iter().find(|&side| entered(&view, side).is_some());
                act.next = Next::Goes(first.unwrap_or(side));
            }
            is_least_entered = goes_to_least_entered(&view, act.next);
            (act, self.turns == Turns::Whole)
        };
        let mut step = Step::Stay;
        if is_due {
            body.cell = self.way.carry_out(&mut floor, body.cell, &act);
            body.is_done = act.next == Next::Done;
            if let Some(side) = act.next.side() {
                let is_counted = matches!(self.demand, Demand::Bounded | Demand::Twice);
                body.moves = if is_counted { body.moves.saturating_add(1) } else { 0 };
                step = Step::Cross(side);
            }
        } else {
            body.pending = Some(act);
        }
        state.count_to(self.most_crossings);
        let is_asked = match self.demand {
            Demand::LeastEntered => true,
            Demand::All => self.max_misses == 0,
            Demand::Connected
            | Demand::Knowing
            | Demand::Explores
            | Demand::Ends
            | Demand::Whole
            | Demand::Rising
            | Demand::Bounded
            | Demand::Twice => false,
        };
        let breaks = if is_asked && !is_least_entered {
            Some("an agent that goes to a child goes to one that was entered least")
        } else {
            self.broken(&state, agent)
        };
        Some(Turned { state, agent, step, unseen, fails: false, breaks })
    }

    fn scene(&self, state: &State) -> Scene {
        let mark = |cell| Some((cell, state.notes[self.plan.place(cell)?].mark()));
        Scene {
            cells: state.bodies.iter().map(|body| body.cell).collect(),
            marks: self.plan.cells().filter_map(mark).collect(),
        }
    }

    /// What happens in `run`, which begins in `start`.
    pub(super) fn course(&self, start: Box<State>, run: &Run<&str>) -> Course {
        let mut state = start;
        let round = run.round();
        let mut turns = Vec::new();
        for &number in run.steps.iter().chain(round) {
            let Some(turned) = self.turns(&state).nth(number as usize) else { break };
            let Turned { agent, step, unseen, fails, .. } = turned;
            let is_done = turned.state.bodies[agent].is_done || fails;
            turns.push(Turn { before: self.scene(&state), agent, step, is_done, unseen });
            state = turned.state;
        }
        self.plan.course(turns, round.len(), self.scene(&state))
    }
}

/// How many times the child of the cell beyond `side` was entered, as far as the agent has seen it; `None` if there is
/// none.
fn entered(view: &View, side: Side) -> Option<u16> {
    let (_, note) = COMPASS.into_iter().zip(view.beside).find(|&(other, _)| other == side)?;
    let is_child = note.state == Cellular::Open && note.side == Some(side.opposite());
    is_child.then_some(note.crossings)
}

/// Whether no child was entered less often than the one that the agent goes to, if it goes to one (BRICKS-13).
fn goes_to_least_entered(view: &View, next: Next) -> bool {
    let Next::Goes(side) = next else { return true };
    let least = COMPASS.into_iter().filter_map(|side| entered(view, side)).min();
    entered(view, side).is_none_or(|often| Some(often) == least)
}

/// The trees that there have been.
fn founded(state: &State) -> u32 {
    state.bodies.iter().map(|body| body.memory.founded()).sum()
}

/// Who has something left to do.
fn awake(state: &State) -> Bits {
    (0..).zip(&state.bodies).filter(|(_, body)| body.is_awake()).fold(0, |set, (agent, _)| set | 1 << agent)
}

/// What a turn leads to.
#[derive(Clone)]
pub(super) struct Turned {
    state: Box<State>,
    /// Whose turn it is, and where it goes.
    agent: usize,
    step: Step,
    /// The cells of the sensors that it misses.
    unseen: Vec<Cell>,
    /// Whether the agent fails instead of acting.
    fails: bool,
    breaks: Option<&'static str>,
}

/// States are boxed: each is handed on many times before it is looked at.
impl world::World for Team {
    type State = Box<State>;
    type Plan = Vec<Turned>;
    type Event = Turned;
    type Demand = &'static str;

    fn plan(&self, state: &mut Box<State>, _: &[u8]) -> Option<Self::Plan> {
        let all: Vec<_> = self.turns(state).collect();
        any_of(all)
    }

    fn settle(
        &self,
        state: &mut Box<State>,
        all: &Self::Plan,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Self::Event {
        let mut turned = picked(all, world);
        std::mem::swap(state, &mut turned.state);
        turned
    }

    fn broken_by(&self, turn: &world::Turn<'_, Self>) -> Vec<&'static str> {
        turn.event.breaks.into_iter().collect()
    }

    fn broken_at_end(&self, state: &Box<State>, _: &[u8]) -> Vec<&'static str> {
        let broken = match self.demand {
            Demand::Connected
            | Demand::Knowing
            | Demand::Whole
            | Demand::Rising
            | Demand::Bounded
            | Demand::Twice
            | Demand::LeastEntered => None,
            Demand::Explores => (!state.is_explored(&self.plan)).then_some("every cell is explored"),
            Demand::Ends | Demand::All => {
                (state.left(&self.plan) != 0).then_some("when all agents are done, every cell is visited")
            }
        };
        broken.into_iter().collect()
    }
}

impl System for Team {
    type Part = Part;

    fn places(&self, state: &Box<State>) -> usize {
        state.places()
    }

    fn part(&self, state: &Box<State>, place: usize) -> Part {
        state.part(place)
    }

    fn differing(&self, one: &Box<State>, other: &Box<State>) -> Places {
        one.differing(other)
    }

    fn put(&self, state: &mut Box<State>, place: usize, part: &Part) {
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
            Demand::Connected
            | Demand::Knowing
            | Demand::Whole
            | Demand::Rising
            | Demand::Bounded
            | Demand::Twice
            | Demand::LeastEntered => None,
            Demand::Explores => Some("every cell is explored: no run goes on for ever before"),
            Demand::Ends | Demand::All => {
                Some("no run goes on for ever in which every agent acts again and again")
            }
        }
    }

    fn awake(&self, state: &Box<State>) -> Bits {
        awake(state)
    }
}
