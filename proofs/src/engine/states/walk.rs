//! Random runs of a system, for states that are too many to search. A run that breaks a demand is found in the form in
//! which the search gives it, and can be played again; a demand that no run breaks may be broken all the same.

use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;
use tautline_kernel::choice::Oracle;

use super::{Bits, Ending, Run, Step, System, kept, steps};
use crate::engine::watchdog::Steps;

/// One run of `system` of at most so many steps from a start, in which `world` picks each step: up to where it breaks a
/// demand, if it does.
pub fn walk<S: System>(
    system: &S,
    (start, mut state): (usize, S::State),
    most_steps: u32,
    world: &mut (impl Oracle + ?Sized),
) -> Option<Run<S::Demand>> {
    let (mut made, mut round) = (Vec::new(), Round::default());
    let endless = system.broken_by_endless_runs();
    let moves = Steps::begin();
    loop {
        moves.next();
        let run = |made: &[u32], demand, ending| Run { demand, start, steps: made.to_vec(), ending };
        let mut all: Vec<Step<S>> = steps(system, &state).collect();
        if !all.iter().any(|step| step.is_bound)
            && let Some(&demand) = system.broken_at_end(&state, &[]).first()
        {
            return Some(run(&made, demand, Ending::Still));
        }
        if let Some(demand) = endless
            && let Some(first) = round.closes(system, &state, made.len())
        {
            return Some(run(&made[..first], demand, Ending::Round(made[first..].to_vec())));
        }
        if all.is_empty() || made.len() >= most_steps as usize {
            return None;
        }
        let number = world.pick(all.len() as u32);
        let step = all.swap_remove(number as usize);
        made.push(number);
        if let Some(&demand) = step.breaks.first() {
            return Some(run(&made, demand, Ending::There));
        }
        if endless.is_some() {
            round.goes_on(step.is_bound.then_some(step.acting));
        }
        state = step.state;
    }
}

/// The states since which the same thing is owed and every step was bound to be made: a run that comes back to one of
/// them may go round for ever.
struct Round<K> {
    places: FxHashMap<K, usize>,
    owed: Bits,
    /// Of each state who is awake in it, and who acts in the step from it.
    trail: Vec<(Bits, Bits)>,
}

impl<K> Default for Round<K> {
    fn default() -> Self {
        Self { places: FxHashMap::default(), owed: 0, trail: Vec::new() }
    }
}

impl<P: Eq + std::hash::Hash> Round<(Vec<P>, Vec<u8>)> {
    /// The place of the state that this one closes a fair round with, `made` steps having been made before it.
    fn closes<S: System<Part = P>>(&mut self, system: &S, state: &S::State, made: usize) -> Option<usize> {
        let owed = system.owed(state);
        if self.owed & owed == 0 {
            (self.owed, self.trail) = (owed, Vec::new());
            self.places.clear();
        }
        self.owed &= owed;
        let mut home = state.clone();
        system.make_canonical(&mut home);
        let since = made - self.trail.len();
        self.trail.push((system.awake(state), 0));
        match self.places.entry(kept(system, &home)) {
            Entry::Vacant(vacant) => {
                vacant.insert(made);
                None
            }
            Entry::Occupied(known) => {
                let first = *known.get();
                let all = &self.trail[first - since..self.trail.len() - 1];
                let join = |(awake, acted): (Bits, Bits), &(one, acting): &(Bits, Bits)| {
                    (awake & one, acted | acting)
                };
                let (awake, acted) = all.iter().fold((Bits::MAX, 0), join);
                (self.owed != 0 && awake & !acted == 0).then_some(first)
            }
        }
    }

    /// A step is made, by these if it is bound to be.
    fn goes_on(&mut self, acting: Option<Bits>) {
        match (acting, self.trail.last_mut()) {
            (Some(acting), Some(last)) => last.1 = acting,
            _ => *self = Self::default(),
        }
    }
}

/// The run from `state` without what leads back to a state that it had before its round.
pub fn without_detours<S: System>(system: &S, state: &S::State, run: &Run<S::Demand>) -> Run<S::Demand> {
    let (mut way, mut places) = (Vec::new(), FxHashMap::default());
    places.insert(kept(system, state), 0);
    let once = Run { ending: Ending::There, ..run.clone() };
    for (&number, (_, step)) in run.steps.iter().zip(once.played(system, state.clone())) {
        way.push(number);
        // A step that breaks a demand ends the run, wherever it leads.
        if !step.breaks.is_empty() {
            break;
        }
        let place = *places.entry(kept(system, &step.state)).or_insert(way.len());
        if place < way.len() {
            way.truncate(place);
            places.retain(|_, known| *known <= place);
        }
    }
    Run { steps: way, ..run.clone() }
}
