//! The verdict on a section.

use std::fmt;

/// Counts of a section that was accepted.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Counts {
    /// States.
    pub states: u64,
    /// Steps from them.
    pub steps: u64,
    /// States from which no step is bound to be made; of runs that are told apart, the runs.
    pub ends: u64,
}

impl Counts {
    /// These and others.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        let Self { states, steps, ends } = other;
        Self { states: self.states + states, steps: self.steps + steps, ends: self.ends + ends }
    }
}

/// Why a section is refused. States are numbered in their order in the section, starts and steps in that of the model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Refusal {
    /// From this byte of the section on it is no list of states that are joined to trees, or of numbers of runs.
    Malformed(usize),
    /// The model has other starts than the section: so many.
    Starts(usize),
    /// The start with this number is another state than the section says.
    Start(usize),
    /// The model has other steps from this state: so many, and maybe more.
    Steps(u32, usize),
    /// This step from this state leads to another state than the section says.
    Leads(u32, usize),
    /// It breaks a demand.
    Breaks(u32, usize, String),
    /// A run that stays in this state breaks a demand.
    Ends(u32, String),
    /// This state stands somewhere else, too, and would be counted twice.
    Twice(u32),
    /// This state owes something for which the section has no ranks.
    Owes(u32),
    /// This step from this state leads to a state of a higher rank that owes the same.
    Rises(u32, usize),
    /// Within the states of this rank a weakly fair run may owe for ever what this bit stands for.
    Endless(u32, u32),
    /// The run with these answers breaks a demand.
    Broken(Vec<u32>, String),
    /// The run with these answers is longer than any may be.
    Long(Vec<u32>),
    /// With so many mishaps the model has so many runs, with so many steps that come after no other mishap.
    Runs(usize, u64, u64),
    /// The longest run of the model has so many steps.
    Longest(u32),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Malformed(byte) => write!(f, "from byte {byte} on there is no list of states or runs"),
            Self::Starts(count) => write!(f, "it has not the starts of the model, which are {count}"),
            Self::Start(start) => write!(f, "start {start} is another state than is said"),
            Self::Steps(state, count) => {
                write!(f, "state {state}: it has not the steps of the model, at least {count}")
            }
            Self::Leads(state, step) => {
                write!(f, "state {state}, step {step}: it leads to another state than is said")
            }
            Self::Breaks(state, step, demand) => write!(f, "state {state}, step {step}: it breaks {demand}"),
            Self::Ends(state, demand) => write!(f, "state {state}: a run that stays there breaks {demand}"),
            Self::Twice(state) => write!(f, "state {state} is one that was there before"),
            Self::Owes(state) => write!(f, "state {state}: there are no ranks for what it owes"),
            Self::Rises(state, step) => write!(f, "state {state}, step {step}: it leads to a higher rank"),
            Self::Endless(rank, bit) => {
                write!(f, "rank {rank}: a weakly fair run may stay there and owe obligation {bit} for ever")
            }
            Self::Broken(answers, demand) => {
                write!(f, "the run with the answers {answers:?} breaks {demand}")
            }
            Self::Long(answers) => write!(f, "the run with the answers {answers:?} is too long"),
            Self::Runs(mishaps, runs, steps) => {
                write!(
                    f,
                    "number of mishaps {mishaps}: it has {runs} runs and {steps} steps, and not as is said"
                )
            }
            Self::Longest(steps) => write!(f, "the longest run has {steps} steps"),
        }
    }
}

impl std::error::Error for Refusal {}
