//! Agents on small floors, as systems whose states are all looked at: which agent acts next and which sensors it
//! misses are choices. What BRICKS-2 to BRICKS-6 demand is in plain arithmetic here; of the kernel's rule only the
//! agents' actions are used.

use tautline_kernel::bricks::{Act, Agent, Condition, Next, Rule, carry_out};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Scan};
use tautline_kernel::ground::{Cell, Step};

use crate::engine::outcomes;
use crate::engine::states::{Bits, Places, Run, System};
use crate::engine::world::{self, any_of, picked};
use crate::floor::plans::FloorPlan;
use crate::floor::small::{self, Misses, Part, Small, Stored, marked, shut};
use crate::floor_trace::{Course, Scene, Turn};

/// What two agents may do at once.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Turns {
    /// Nothing: every action is one step.
    Whole,
    /// Scanning and writing are two steps, but no agent scans while another whose scan overlaps has yet to write.
    Overlapping,
    /// Scanning and writing are two steps.
    Free,
}

/// What a team is looked at for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Demand {
    /// BRICKS-2, BRICKS-3
    Connected,
    /// BRICKS-4
    Knowing,
    /// BRICKS-5: the run is over when every cell is explored.
    Explores,
    /// BRICKS-6
    Ends,
    /// BRICKS-2, BRICKS-4 and BRICKS-6, looked at in one pass.
    All,
}

/// An agent on the floor.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Body {
    pub(crate) agent: Agent,
    pub(crate) cell: Cell,
    pub(crate) is_done: bool,
    /// What it has decided and has yet to carry out.
    pub(crate) pending: Option<Act>,
}

/// The state of a floor and its agents.
pub(crate) type State = small::State<Body>;

/// Agents that follow a rule on a plan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Team {
    pub(crate) plan: FloorPlan,
    pub(crate) rule: Rule,
    pub(crate) turns: Turns,
    /// Sensors that are missed in one run at most.
    pub(crate) max_misses: u8,
    /// How many times in a row an agent may act while another waits.
    pub(crate) max_streak: Option<u8>,
    /// Whether agents may fail, all but one: they act no more, and have not left.
    pub(crate) may_fail: bool,
    pub(crate) demand: Demand,
}

impl Team {
    /// The start with the agents in these cells.
    pub(crate) fn start(&self, cells: &[Cell]) -> State {
        let body = |(id, &cell)| Body { agent: Agent::new(id), cell, is_done: false, pending: None };
        let mut state = State::start(&self.plan, cells, (0..).zip(cells).map(body).collect());
        self.forget(&mut state);
        state
    }

    /// The starts of `agents`, each in any free cell.
    pub(crate) fn starts(&self, agents: u32) -> impl Iterator<Item = Box<State>> {
        self.plan.starts(agents).map(|cells| Box::new(self.start(&cells)))
    }

    /// What no agent ever reads is left out of the state: crossings if it goes round at once and is never lost,
    /// identifiers if no sensor is missed, and what agents remember that are done.
    fn forget(&self, state: &mut State) {
        for body in state.bodies.iter_mut().filter(|body| body.is_done) {
            body.agent = Agent::new(body.agent.id);
        }
        let is_ideal = self.max_misses == 0;
        if is_ideal && self.rule.patience == 0 || !self.rule.has(Condition::LeastCrossed) {
            state.forget_crossings();
        }
        if is_ideal || !self.rule.has(Condition::SeenOnly) {
            state.forget_serials();
        }
    }

    fn marked(&self, state: &State, is: impl Fn(Mark) -> bool) -> u16 {
        marked(&self.plan, &state.sensors, is)
    }

    /// The cells that are left to go through: all but visited ones, or where there is a second pass, but sealed ones.
    fn left(&self, state: &State) -> u16 {
        let is_twofold = self.rule.has(Condition::SecondPass);
        self.marked(state, |mark| match mark {
            Mark::Unexplored | Mark::Explored | Mark::Closing => true,
            Mark::Visited => is_twofold,
            Mark::Sealed => false,
        })
    }

    fn is_explored(&self, state: &State) -> bool {
        self.marked(state, |mark| mark == Mark::Unexplored) == 0
    }

    /// What is broken in `state`, in which the agent in the cell `ended` has just been done, and was not in `before`.
    fn broken(&self, before: &State, state: &State, ended: Option<Cell>) -> Option<&'static str> {
        let is_torn = || {
            let is_as_before = Stored::are_marked_alike(&before.sensors, &state.sensors);
            if is_as_before { None } else { self.is_torn(state) }
        };
        match self.demand {
            Demand::Connected => is_torn(),
            Demand::Knowing => self.is_wrong(state, ended),
            Demand::All => is_torn().or_else(|| self.is_wrong(state, ended)),
            Demand::Explores | Demand::Ends => None,
        }
    }

    fn is_torn(&self, state: &State) -> Option<&'static str> {
        let left = self.left(state);
        let is_one = self.plan.spread(left, shut(&self.plan, &state.sensors)) == left;
        (!is_one).then_some("the accessible cells stay connected")
    }

    fn is_wrong(&self, state: &State, ended: Option<Cell>) -> Option<&'static str> {
        let here = self.plan.place(ended?).map_or(0, |place| 1 << place);
        if !self.is_explored(state) {
            return Some("an agent is done only when every cell is explored");
        }
        (self.left(state) & !here != 0).then_some("an agent is done only when no other cell is left")
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
            Demand::Connected | Demand::Knowing | Demand::Ends | Demand::All => false,
            Demand::Explores => self.is_explored(state),
        };
        if awake == 0 || is_over {
            return None;
        }
        let is_awake = |agent: usize| awake >> agent & 1 == 1;
        let is_locked = |agent: usize| {
            let Body { pending, cell, .. } = state.bodies[agent];
            self.turns == Turns::Overlapping
                && pending.is_none()
                && state.bodies.iter().any(|other| {
                    let (dx, dy) = cell.apart(other.cell);
                    other.pending.is_some() && dx.max(dy) <= 2
                })
        };
        let is_tired = |agent: usize| {
            awake.count_ones() > 1 && self.max_streak.is_some_and(|most| state.streak == (agent as u8, most))
        };
        let mut ready =
            (0..state.bodies.len()).filter(|&agent| is_awake(agent) && !is_locked(agent) && !is_tired(agent));
        let of = ready.clone().count() as u32;
        let may_fail = self.may_fail && awake.count_ones() > 1;
        let pick = if of > 1 || may_fail { world.pick(of << u32::from(may_fail)) } else { 0 };
        let agent = ready.nth(if of > 1 { (pick % of) as usize } else { 0 })?;
        let before = state;
        let mut state = Box::new(before.clone());
        if let Some(most) = self.max_streak {
            let again = if state.streak.0 == agent as u8 { state.streak.1 } else { 0 };
            state.streak = (agent as u8, most.min(again + 1));
        }
        let body = &mut state.bodies[agent];
        if pick >= of {
            body.is_done = true;
            return Some(Turned { state, agent, step: Step::Stay, unseen: Vec::new(), breaks: None });
        }
        let mut floor = Small { plan: &self.plan, sensors: &mut state.sensors, placed: &mut state.placed };
        let mut unseen = Vec::new();
        let (act, is_due) = if let Some(act) = body.pending.take() {
            (act, true)
        } else {
            let missed = state.misses;
            let mut world = Misses { world, count: &mut state.misses, most: self.max_misses };
            let scan = Scan::new(&floor, body.cell, &mut world);
            if state.misses > missed {
                let mark = |cell| floor.sensor(cell).map_or(Mark::Unexplored, |sensor| sensor.mark);
                unseen = scan.misread(mark, body.cell).collect();
            }
            (body.agent.decide(self.rule, &scan), self.turns == Turns::Whole)
        };
        let mut step = Step::Stay;
        if is_due {
            body.cell = carry_out(&mut floor, body.cell, &act);
            body.is_done = act.next == Next::Done;
            if let Next::Goes(side, ..) = act.next {
                step = Step::Cross(side);
            }
        } else {
            body.pending = Some(act);
        }
        let ended = Some(body.cell).filter(|_| body.is_done);
        self.forget(&mut state);
        let breaks = self.broken(before, &state, ended);
        Some(Turned { state, agent, step, unseen, breaks })
    }

    fn scene(&self, state: &State) -> Scene {
        let mark = |cell| Some((cell, state.sensors[self.plan.place(cell)?].mark()));
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
            let Turned { agent, step, unseen, .. } = turned;
            let is_done = turned.state.bodies[agent].is_done;
            turns.push(Turn { before: self.scene(&state), agent, step, is_done, unseen });
            state = turned.state;
        }
        self.plan.course(turns, round.len(), self.scene(&state))
    }
}

/// Who has something left to do.
fn awake(state: &State) -> Bits {
    (0..).zip(&state.bodies).filter(|(_, body)| !body.is_done).fold(0, |set, (agent, _)| set | 1 << agent)
}

/// What a turn leads to.
#[derive(Clone)]
pub(crate) struct Turned {
    state: Box<State>,
    /// Whose turn it is, and where it goes.
    agent: usize,
    step: Step,
    /// The cells of the sensors that it misses.
    unseen: Vec<Cell>,
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
            Demand::Connected | Demand::Knowing => None,
            Demand::Explores => (!self.is_explored(state)).then_some("every cell is explored"),
            Demand::Ends | Demand::All => {
                let is_left = |mark| !matches!(mark, Mark::Visited | Mark::Sealed);
                (self.marked(state, is_left) != 0)
                    .then_some("when all agents are done, every cell is visited")
            }
        };
        broken.into_iter().collect()
    }
}

impl System for Team {
    type Part = Part<Body>;

    fn places(&self, state: &Box<State>) -> usize {
        state.places()
    }

    fn part(&self, state: &Box<State>, place: usize) -> Part<Body> {
        state.part(place)
    }

    fn differing(&self, one: &Box<State>, other: &Box<State>) -> Places {
        one.differing(other)
    }

    fn put(&self, state: &mut Box<State>, place: usize, part: &Part<Body>) {
        state.put(place, part);
    }

    fn acting(&self, turn: &world::Turn<'_, Self>) -> Bits {
        1 << turn.event.agent
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        match self.demand {
            Demand::Connected | Demand::Knowing => None,
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

#[cfg(test)]
mod tests {
    use rustc_hash::FxHashSet;

    use super::*;
    use crate::floor::plans::Area;

    /// All states of two agents in a few cells; wherever one is done, it might as well remember what the other does.
    #[test]
    fn what_an_agent_remembers_that_is_done_plays_no_part() {
        for (rule, max_misses, width) in [(Rule::REPAIRED, 0, 3), (Rule::ROBUST, 1, 2)] {
            let plan = Area::blocked(width, 2).plans().next().expect("the open one");
            let rule = Rule { patience: 2, reach: 4, ..rule };
            let team = Team {
                plan,
                rule,
                turns: Turns::Whole,
                max_misses,
                max_streak: Some(2),
                may_fail: false,
                demand: Demand::All,
            };
            let come_of = |state: &State| -> Vec<_> {
                team.turns(state).map(|turned| (turned.state, turned.agent, turned.breaks)).collect()
            };
            let (mut known, mut ahead) = (FxHashSet::default(), team.starts(2).collect::<Vec<_>>());
            let mut compared = 0;
            while let Some(state) = ahead.pop() {
                if !known.insert(state.clone()) {
                    continue;
                }
                let next = come_of(&state);
                for (one, other) in [(0, 1), (1, 0)] {
                    let mut remembering = state.clone();
                    let mut agent = state.bodies[other].agent;
                    agent.id = state.bodies[one].agent.id;
                    remembering.bodies[one].agent = agent;
                    if state.bodies[one].is_done && remembering != state {
                        compared += 1;
                        assert_eq!(come_of(&remembering), next);
                    }
                }
                ahead.extend(next.into_iter().map(|(state, ..)| state));
            }
            assert!(compared > 100, "{compared} states");
        }
    }
}
