//! A refutation as choices: little more than numbers, and enough to play it again. Whoever plays it asks the rule
//! itself, so a list of choices is believed no farther than the rule goes along with it: every choice must be one that
//! there is, all must be made, and the demand must be broken by the last one and by none before it.

use std::fmt;

use super::states::{Bits, Ending, Run, Step, System, is_same, steps};

/// The choices of a refutation, each the number of what was chosen.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Choices {
    /// Those that lead to the state in which the demand is broken.
    pub once: Vec<u32>,
    /// Those that lead from that state back to it, where the demand is broken by going round for ever.
    pub again: Vec<u32>,
}

impl Choices {
    /// All of them, in order.
    pub fn all(&self) -> impl Iterator<Item = u32> {
        self.once.iter().chain(&self.again).copied()
    }
}

impl<D> Run<D> {
    /// Its start and its steps as choices, those of its round apart.
    pub fn choices(&self) -> Choices {
        self.choices_after(&[])
    }

    /// Its start and its steps as choices behind `first`, those of its round apart.
    pub(crate) fn choices_after(&self, first: &[u32]) -> Choices {
        let once = [first, &[self.start as u32], &self.steps].concat();
        Choices { once, again: self.round().to_vec() }
    }
}

/// Why choices are no refutation. Choices are counted from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ScriptError {
    /// There is no such choice.
    None {
        /// Which.
        at: usize,
        /// How many there are.
        of: u32,
    },
    /// The run is over before this choice.
    Over {
        /// Which.
        at: usize,
    },
    /// The run goes on after the last choice, and nothing is broken.
    Unbroken,
    /// The round that is to come again does not come back to where it began, or leaves out who has something left to
    /// do.
    NoRound,
}

impl ScriptError {
    /// The choice that it is about, counted from 0, if it is about one.
    pub const fn at(self) -> Option<usize> {
        match self {
            Self::None { at, .. } | Self::Over { at } => Some(at),
            Self::Unbroken | Self::NoRound => None,
        }
    }
}

impl fmt::Display for ScriptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None { of, .. } => write!(f, "there is no such choice: here there are {of}"),
            Self::Over { .. } => f.write_str("the run is over before this choice"),
            Self::Unbroken => f.write_str("after the last choice nothing is broken"),
            Self::NoRound => f.write_str("what is to come again is no round that can go on for ever"),
        }
    }
}

impl std::error::Error for ScriptError {}

/// Choices that are being made.
pub struct Script<'a> {
    choices: &'a Choices,
    of: Vec<u32>,
}

impl<'a> Script<'a> {
    /// `choices`, none of them made.
    pub const fn new(choices: &'a Choices) -> Self {
        Self { choices, of: Vec::new() }
    }

    /// Makes the next choice, one of `of`, which is none of those that come again.
    ///
    /// # Errors
    /// [`ScriptError`] if there is no such choice.
    pub fn choose(&mut self, of: usize) -> Result<usize, ScriptError> {
        if self.of.len() < self.choices.once.len() { self.take(of) } else { Err(ScriptError::Unbroken) }
    }

    fn take(&mut self, of: usize) -> Result<usize, ScriptError> {
        let at = self.of.len();
        let of = of as u32;
        let chosen = self.choices.all().nth(at).ok_or(ScriptError::Unbroken)?;
        if chosen >= of {
            return Err(ScriptError::None { at, of });
        }
        self.of.push(of);
        Ok(chosen as usize)
    }

    /// Makes all choices that are left, each a step of `system`, from the start with this number. Only what `is_meant`
    /// is looked for. From how many each choice was made, and the run.
    ///
    /// # Errors
    /// [`ScriptError`] if they break nothing that is meant, or not as they say.
    pub fn play<S: System>(
        mut self,
        system: &S,
        (start, mut state): (usize, S::State),
        is_meant: impl Fn(&S::Demand) -> bool,
    ) -> Result<(Vec<u32>, Run<S::Demand>), ScriptError> {
        let first = self.of.len();
        let still = |state: &S::State| {
            let is_still = !steps(system, state).any(|step| step.is_bound);
            is_still.then(|| system.broken_at_end(state, &[]).into_iter().find(&is_meant)).flatten()
        };
        let mut there = None;
        while self.of.len() < self.choices.once.len() {
            if there.is_some() || still(&state).is_some() {
                return Err(ScriptError::Over { at: self.of.len() });
            }
            let step = self.step(system, &state)?;
            there = step.breaks.into_iter().find(&is_meant);
            state = step.state;
        }
        let (demand, ending) = match (there, still(&state)) {
            (Some(_), _) | (_, Some(_)) if !self.choices.again.is_empty() => {
                return Err(ScriptError::Over { at: self.of.len() });
            }
            (Some(demand), _) => (demand, Ending::There),
            (None, Some(demand)) => (demand, Ending::Still),
            (None, None) if self.choices.again.is_empty() => return Err(ScriptError::Unbroken),
            (None, None) => {
                let demand = self.round(system, state)?;
                let demand = demand.filter(&is_meant).ok_or(ScriptError::NoRound)?;
                (demand, Ending::Round(self.choices.again.clone()))
            }
        };
        let made = self.choices.once[first..].to_vec();
        Ok((self.of, Run { demand, start, steps: made, ending }))
    }

    fn step<S: System>(&mut self, system: &S, state: &S::State) -> Result<Step<S>, ScriptError> {
        let mut all: Vec<_> = steps(system, state).collect();
        let chosen = self.take(all.len())?;
        Ok(all.swap_remove(chosen))
    }

    /// Goes round from `state` once; what is broken by doing so for ever.
    fn round<S: System>(
        &mut self,
        system: &S,
        mut state: S::State,
    ) -> Result<Option<S::Demand>, ScriptError> {
        let mut home = state.clone();
        system.make_canonical(&mut home);
        let (mut owed, mut awake, mut acting): (Bits, Bits, Bits) = (Bits::MAX, Bits::MAX, 0);
        let mut is_bound = true;
        while self.of.len() < self.choices.once.len() + self.choices.again.len() {
            owed &= system.owed(&state);
            awake &= system.awake(&state);
            let step = self.step(system, &state)?;
            acting |= step.acting;
            is_bound &= step.is_bound;
            state = step.state;
        }
        system.make_canonical(&mut state);
        let comes_back = is_same(system, &state, &home);
        let is_fair = is_bound && owed != 0 && awake & !acting == 0;
        Ok(system.broken_by_endless_runs().filter(|_| comes_back && is_fair))
    }
}
