//! The demands on a run, and the notes of an observer from which they are judged.

use tautline_kernel::mrc::Bid;
use tautline_kernel::net::Epoch;

use super::setting::{ROBOTS, WFRS};

/// A demand of the clauses MRC-1 to MRC-9 on a run.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Demand {
    /// MRC-1.
    OneRobotForACall,
    /// MRC-2.
    OneCallForARobot,
    /// MRC-3.
    BestOfTheWindow,
    /// MRC-4.
    CountsOnConsent,
    /// MRC-5.
    IsServed,
    /// MRC-6.
    AsksAnew,
    /// MRC-7.
    AsksNearest,
    /// MRC-8.
    TakesWhatItAsksFor,
    /// MRC-9.
    TellsWhoAsked,
}

impl Demand {
    /// Every demand.
    pub const ALL: [Self; 9] = [
        Self::OneRobotForACall,
        Self::OneCallForARobot,
        Self::BestOfTheWindow,
        Self::CountsOnConsent,
        Self::IsServed,
        Self::AsksAnew,
        Self::AsksNearest,
        Self::TakesWhatItAsksFor,
        Self::TellsWhoAsked,
    ];

    /// The id of its clause.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::OneRobotForACall => "MRC-1",
            Self::OneCallForARobot => "MRC-2",
            Self::BestOfTheWindow => "MRC-3",
            Self::CountsOnConsent => "MRC-4",
            Self::IsServed => "MRC-5",
            Self::AsksAnew => "MRC-6",
            Self::AsksNearest => "MRC-7",
            Self::TakesWhatItAsksFor => "MRC-8",
            Self::TellsWhoAsked => "MRC-9",
        }
    }

    /// The violation, in words.
    pub const fn broken(self) -> &'static str {
        match self {
            Self::OneRobotForACall => "two robots are on their way for one call",
            Self::OneCallForARobot => "two WFRs count on one robot",
            Self::BestOfTheWindow => {
                "the robot chosen is not the best of those heard under the present call while the window was open"
            }
            Self::CountsOnConsent => "a WFR counts on a robot that has not taken its lease",
            Self::IsServed => "a WFR waits for ever, and a robot lives",
            Self::AsksAnew => "a robot has heard a new call, and its SBit is set",
            Self::AsksNearest => "a robot does not ask for the nearest call whose SBit is clear",
            Self::TakesWhatItAsksFor => "a robot has taken the lease of a call for which it did not ask",
            Self::TellsWhoAsked => {
                "a WFR has not told its choice to those that have sent MOVE, and to them alone"
            }
        }
    }
}

/// An observer's notes beside the machines' own states, from which demands are judged.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Notes {
    /// The best MOVE of each WFR's latest call that arrived while its window was open, by the hops that it is away.
    pub(super) best: [Option<Bid>; WFRS],
    /// The robots, a bit for each, whose MOVE of each WFR's latest call arrived while its window was open.
    pub(super) heard: [u8; WFRS],
    /// The WFRs whose window is open.
    pub(super) open: [bool; WFRS],
    /// The latest call of each WFR whose lease each robot has taken.
    pub(super) taken: [[Option<Epoch>; WFRS]; ROBOTS],
    /// The demands, a bit for each, that something which happened has broken.
    pub(super) broken: u16,
}
