//! MRC's rule as a set of named conditions. What the paper says is the first three, one of them a reading;
//! the others repair what it leaves open: when a WFR chooses, what becomes of later MOVEs, and of messages, nodes and
//! robots that fail.

use crate::conditions;

conditions! {
    /// One condition of the rule, by the sentence it stands for.
    pub enum Condition of Rule in u16 {
        /// A free robot asks for the call of least HC.
        NearestCall,
        /// A WFR chooses the robot of least MHC.
        NearestRobot,
        /// Where that leaves several, a robot takes the call of least SN and a WFR the robot of least MID, not the
        /// first heard.
        LeastIdentity,
        /// Repair: a WFR chooses when its window closes, not when the first MOVE arrives.
        Window,
        /// Repair: a MOVE that arrives after the choice does not change it.
        ChoiceStands,
        /// Repair: a MOVE that arrives after the choice is answered with it, each time that it arrives.
        AnswersAgain,
        /// Repair: what belongs to another epoch is ignored. A call under a newer one is a new call: its SBit is clear,
        /// and whatever a robot had to do with the older one is over.
        Epochs,
        /// Repair: the robot that is chosen accepts or, on its way elsewhere, declines; the WFR counts on it when it
        /// has accepted. One that has accepted heeds no other choice.
        Consent,
        /// Repair: a robot that no longer asks for the call declines, too.
        StillAsks,
        /// Repair: a window without a MOVE, a choice that is declined or not answered, and a lease that lapses make the
        /// WFR call again under a new epoch.
        Renewal,
        /// Repair: a MOVE, and the RESB to the robot chosen, are repeated when nobody answers; a robot that is never
        /// answered leaves the call to others.
        Repetition,
    }
}

/// The rule of a rescue.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    /// The conditions in force.
    pub conditions: Conditions,
    /// How often a message without an answer is repeated, under [`Condition::Repetition`].
    pub repeats: u8,
}

impl Rule {
    /// MRC as the paper publishes it. A WFR chooses at every MOVE anew among those that it has heard, and a robot does
    /// what the latest RESB says: the paper names no time at which either would stop.
    pub const PUBLISHED: Self = Self {
        conditions: Conditions::of(&[
            Condition::NearestCall,
            Condition::NearestRobot,
            Condition::LeastIdentity,
        ]),
        repeats: 0,
    };

    /// MRC with all repairs; a message without an answer is repeated once.
    pub const REPAIRED: Self = Self { conditions: Conditions::of(&Condition::ALL), repeats: 1 };

    /// How often a message without an answer is sent again.
    pub(super) const fn repeats(self) -> u8 {
        if self.has(Condition::Repetition) { self.repeats } else { 0 }
    }
}
