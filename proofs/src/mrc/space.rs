//! All states of a [`Setting`], fewest actions first, and in them the shortest run that breaks each demand. That a WFR
//! is served in the end (MRC-5) is broken by a state in which nothing more is bound to happen, or by states in which it
//! waits and that can go round for ever, nothing being left out that is bound to happen: no timer that runs, no robot
//! on its way, and no message between a robot and a WFR between whom there is one throughout.

use tautline_kernel::choice::Oracle;

use super::state::{Action, Actor, Demand, Message, Part, ROBOTS, Setting, State, WFRS, place};
use crate::engine::model::StatesModel;
use crate::engine::states::{self, AnySystem, Bits, Limits, Places, Run, System};
use crate::engine::world::{Turn, World, any_of, picked};
use crate::engine::{Script, ScriptError};

/// When to stop.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Until {
    /// When all states are known.
    Exhausted,
    /// When this demand is broken; whether a WFR is served in the end is told by all states.
    Broken(Demand),
}

/// A run that breaks a demand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Refutation {
    /// The run, from one of [`Setting::starts`].
    pub run: Run<Demand>,
    /// Its actions.
    pub actions: Vec<Action>,
    /// Those that come again for ever, if some do.
    pub round: Vec<Action>,
}

/// The findings in the states.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Findings {
    /// States.
    pub states: u64,
    /// Steps from state to state.
    pub steps: u64,
    /// The most bytes that the search took at a time.
    pub bytes: u64,
    /// Whether the search came to its end, and not to one of its limits.
    pub complete: bool,
    /// Whether each run is known to be a shortest one.
    pub is_shortest: bool,
    /// The demands that are broken, each by a run.
    pub broken: Vec<Refutation>,
}

impl Findings {
    /// The run that breaks `demand`.
    pub fn broken(&self, demand: Demand) -> Option<&Refutation> {
        self.broken.iter().find(|broken| broken.run.demand == demand)
    }
}

/// Searches all states of `setting` within `limits`.
pub fn search(setting: &Setting, until: Until, limits: Limits<'_>) -> Findings {
    let space = Space { setting: *setting, until };
    let found = states::search(&space, setting.starts(), limits);
    let mut broken: Vec<Refutation> = found.broken.into_iter().map(|run| space.broken(run)).collect();
    broken.sort_by_key(|broken| broken.run.demand);
    Findings {
        states: found.states,
        steps: found.steps,
        bytes: found.bytes,
        complete: found.is_whole,
        is_shortest: found.is_shortest,
        broken,
    }
}

/// The states of `setting`, of which `demand` alone is demanded.
pub(super) fn started(setting: Setting, demand: Demand) -> Box<dyn AnySystem> {
    let system = Space { setting, until: Until::Broken(demand) };
    let is_asked = |space: &Space, demand| space.until == Until::Broken(demand);
    Box::new(StatesModel { system, starts: |space| space.setting.starts(), is_asked })
}

/// Plays a run that breaks `demand` again: from how many each choice was made, and the run.
pub(crate) fn replay(
    setting: &Setting,
    demand: Demand,
    mut script: Script<'_>,
) -> Result<(Vec<u32>, Refutation), ScriptError> {
    let space = Space { setting: *setting, until: Until::Broken(demand) };
    let mut starts = setting.starts();
    let number = script.choose(starts.len())?;
    let start = (number, starts.swap_remove(number));
    let (of, run) = script.play(&space, start, |&broken| broken == demand)?;
    Ok((of, space.broken(run)))
}

/// The states of a setting.
pub struct Space {
    /// The setting.
    pub setting: Setting,
    /// The demands that are looked for.
    pub until: Until,
}

/// The bit of an actor, which is that of the place of its part.
const fn bit(actor: Actor) -> Bits {
    match actor {
        Actor::Robot(robot) => 1 << robot,
        Actor::Wfr(wfr) => 1 << (ROBOTS + wfr),
    }
}

/// The bit of the messages between a robot and a WFR.
const fn between(message: Message) -> Bits {
    let (robot, wfr) = (message.robot().0 as usize, place(message.call().wfr));
    1 << (ROBOTS + WFRS + robot * WFRS + wfr)
}

/// The messages of which `action` lets one arrive.
fn arriving(state: &State, action: Action) -> Bits {
    match action {
        Action::Deliver(at) => between(state.network()[at]),
        Action::Raise(_)
        | Action::Begin(_)
        | Action::Expire(_)
        | Action::Arrive(_)
        | Action::Lapse(_)
        | Action::Lose(_)
        | Action::Duplicate(_)
        | Action::FailRobot(_)
        | Action::FailNode { .. } => 0,
    }
}

/// The actors of whom that is so.
fn actors(is: impl Fn(Actor) -> bool) -> Bits {
    let all = (0..ROBOTS).map(Actor::Robot).chain((0..WFRS).map(Actor::Wfr));
    all.filter(|&actor| is(actor)).map(bit).sum()
}

/// Whether `actor` is no longer before what it was before `action`: its timer, or the end of its way.
fn has_turned(before: &State, action: Action, after: &State, actor: Actor) -> bool {
    action == Action::Expire(actor)
        || match actor {
            Actor::Robot(robot) if action == Action::Begin(robot) => true,
            Actor::Robot(robot) => {
                before.robots[robot].timer() != after.robots[robot].timer()
                    || before.comes_for(robot) != after.comes_for(robot)
            }
            Actor::Wfr(wfr) => before.wfrs[wfr].timer() != after.wfrs[wfr].timer(),
        }
}

impl Space {
    /// Whether it is looked for WFRs that wait for ever.
    fn looks_for_service(&self) -> bool {
        match self.until {
            Until::Exhausted => true,
            Until::Broken(demand) => demand == Demand::IsServed,
        }
    }

    /// The violation in a run.
    fn broken(&self, run: Run<Demand>) -> Refutation {
        let mut state = self.setting.start(run.start as u32);
        let mut played = |numbers: &[u32]| -> Vec<Action> {
            let play = |&number: &u32| {
                let action = *state.actions(&self.setting).get(number as usize)?;
                state = state.after(&self.setting, action);
                Some(action)
            };
            numbers.iter().map_while(play).collect()
        };
        let (actions, round) = (played(&run.steps), played(run.round()));
        Refutation { run, actions, round }
    }
}

impl World for Space {
    type State = State;
    type Plan = Vec<Action>;
    type Event = Action;
    type Demand = Demand;

    fn plan(&self, state: &mut State, _: &[u8]) -> Option<Vec<Action>> {
        any_of(state.actions(&self.setting))
    }

    fn settle(
        &self,
        state: &mut State,
        actions: &Vec<Action>,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Action {
        let action = picked(actions, world);
        state.act(&self.setting, action);
        action
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Demand> {
        match turn.after.broken() {
            0 => Vec::new(),
            _ => Demand::ALL.into_iter().filter(|&demand| turn.after.breaks(demand)).collect(),
        }
    }

    fn broken_at_end(&self, state: &State, _: &[u8]) -> Vec<Demand> {
        let waits = self.looks_for_service() && self.owed(state) != 0;
        waits.then_some(Demand::IsServed).into_iter().collect()
    }
}

impl System for Space {
    type Part = Part;

    fn make_canonical(&self, state: &mut State) {
        state.make_canonical();
    }

    fn places(&self, _: &State) -> usize {
        State::PARTS
    }

    fn part(&self, state: &State, place: usize) -> Part {
        state.part(place)
    }

    fn differing(&self, _: &State, other: &State) -> Places {
        other.touched()
    }

    fn put(&self, state: &mut State, place: usize, part: &Part) {
        state.put(place, part);
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        let Turn { before, after, event: &action, .. } = *turn;
        let is_touched = |actor: Actor| after.touched() & Places::from(bit(actor)) != 0;
        actors(|actor| is_touched(actor) && has_turned(before, action, after, actor))
            | arriving(before, action)
    }

    fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
        turn.before.is_bound_to_happen(&self.setting, *turn.event)
    }

    fn broken_by_endless_runs(&self) -> Option<Demand> {
        self.looks_for_service().then_some(Demand::IsServed)
    }

    /// The WFRs that wait while a robot lives.
    fn owed(&self, state: &State) -> Bits {
        let waits = |&wfr: &usize| state.is_owed_service(&self.setting, wfr);
        (0..self.setting.wfrs).filter(waits).map(|wfr| 1 << wfr).sum()
    }

    /// The actors whose timer runs, who are on their way or have put off asking, and the messages on theirs.
    fn awake(&self, state: &State) -> Bits {
        let is_awake = |actor: Actor| match actor {
            Actor::Robot(robot) => {
                state.timer_runs(actor)
                    || state.comes_for(robot).is_some()
                    || state.collects(&self.setting, robot)
            }
            Actor::Wfr(_) => state.timer_runs(actor),
        };
        state.network().iter().fold(actors(is_awake), |awake, &message| awake | between(message))
    }

    /// That a WFR is not served is told by the end of a run, of which another may be shorter.
    fn is_enough(&self, broken: Demand) -> bool {
        self.until == Until::Broken(broken) && broken != Demand::IsServed
    }
}
