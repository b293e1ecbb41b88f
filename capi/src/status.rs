//! The status of a call, as a number for programs and as a sentence for people.

use core::ffi::{CStr, c_char};

use tautline_kernel::chain::{Damage, End, SetupError};

/// The status of a call: 0 or more if it did what it is for, less than 0 if it refused to.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TautlineStatus {
    /// The call did what it is for.
    Ok = 0,
    /// The run is over: every cell of the area is explored.
    Explored = 1,
    /// The run is over: the team can explore nothing more.
    Exhausted = 2,
    /// A pointer that must not be null is null.
    NullPointer = -1,
    /// The memory holds no chain, or no monitor.
    NotBegun = -2,
    /// There is no such rule.
    UnknownRule = -3,
    /// A chain is a base and at least one robot, and a monitor has at least one.
    TooFewRobots = -4,
    /// A chain here has at most 16 robots, the base counted.
    TooManyRobots = -5,
    /// The last cell lies before the first one, or the area has more than 16 columns or rows.
    BadArea = -6,
    /// The base is outside the area.
    BaseOutside = -7,
    /// There is no plan to settle.
    NoPlan = -8,
    /// A caller's array is too small; nothing has happened.
    TooSmall = -9,
    /// A byte of the log or a message is no message.
    DamagedByte = -10,
    /// There are not as many bytes as the team has sent.
    DamagedLength = -11,
    /// The log says that a move was taken back which cannot have been.
    DamagedTakenBack = -12,
    /// By the log, robots would lose contact.
    DamagedOutOfContact = -13,
    /// By the log, three robots would be in one cell.
    DamagedCrowded = -14,
    /// By the log, a robot would not come back to the base.
    DamagedNotHome = -15,
    /// A message is about another step than the plan has.
    DamagedOtherStep = -16,
    /// A message contradicts what the team knows.
    DamagedOtherWorld = -17,
    /// There is no such demand, or positions say nothing of it with its tolerance.
    BadDemand = -18,
}

impl TautlineStatus {
    const ALL: [Self; 21] = [
        Self::Ok,
        Self::Explored,
        Self::Exhausted,
        Self::NullPointer,
        Self::NotBegun,
        Self::UnknownRule,
        Self::TooFewRobots,
        Self::TooManyRobots,
        Self::BadArea,
        Self::BaseOutside,
        Self::NoPlan,
        Self::TooSmall,
        Self::DamagedByte,
        Self::DamagedLength,
        Self::DamagedTakenBack,
        Self::DamagedOutOfContact,
        Self::DamagedCrowded,
        Self::DamagedNotHome,
        Self::DamagedOtherStep,
        Self::DamagedOtherWorld,
        Self::BadDemand,
    ];

    const fn text(self) -> &'static CStr {
        match self {
            Self::Ok => c"done",
            Self::Explored => c"every cell of the area is explored",
            Self::Exhausted => c"the team can explore nothing more",
            Self::NullPointer => c"a pointer is null; give the address of the caller's own memory",
            Self::NotBegun => c"the memory holds nothing begun; call \
                                tautline_chain_begin or tautline_monitor_begin first",
            Self::UnknownRule => c"there is no such rule; give one of TAUTLINE_RULE_...",
            Self::TooFewRobots => {
                c"too few robots; give a chain at least 2, the base counted, and a monitor at least 1"
            }
            Self::TooManyRobots => {
                c"too many robots; give at most TAUTLINE_CHAIN_ROBOTS, the base counted"
            }
            Self::BadArea => {
                c"no area that fits; give its north-western and its south-eastern cell, at most 16 columns and rows"
            }
            Self::BaseOutside => c"the base is outside the area; give a cell of the area",
            Self::NoPlan => c"there is no plan to settle; call tautline_chain_plan first",
            Self::TooSmall => c"an array is too small; give one entry for each robot",
            Self::DamagedByte => c"a byte is no message; give the bytes as tautline_chain_settle wrote them",
            Self::DamagedLength => {
                c"not as many bytes as the team has sent; give one for each robot but \
                  the base, and of the log for each team move"
            }
            Self::DamagedTakenBack
            | Self::DamagedOutOfContact
            | Self::DamagedCrowded
            | Self::DamagedNotHome => {
                c"the log is not that of this team; give the bytes as tautline_chain_settle wrote them, in order"
            }
            Self::DamagedOtherStep => c"a message is about another plan; give the messages of this team move",
            Self::DamagedOtherWorld => {
                c"a message contradicts what the team knows; ask the robots for their messages again"
            }
            Self::BadDemand => {
                c"no such demand; give one of TAUTLINE_DEMAND_..., and a tolerance below its \
                  range, its least distance, or half its cells' width"
            }
        }
    }
}

impl From<SetupError> for TautlineStatus {
    fn from(refused: SetupError) -> Self {
        match refused {
            SetupError::TooFewRobots(_) => Self::TooFewRobots,
            SetupError::TooManyRobots { .. } => Self::TooManyRobots,
            SetupError::BaseOutside(_) => Self::BaseOutside,
        }
    }
}

impl From<Damage> for TautlineStatus {
    fn from(damaged: Damage) -> Self {
        match damaged {
            Damage::Byte(_) => Self::DamagedByte,
            Damage::Length { .. } => Self::DamagedLength,
            Damage::TakenBack(_) => Self::DamagedTakenBack,
            Damage::OutOfContact(_) => Self::DamagedOutOfContact,
            Damage::Crowded => Self::DamagedCrowded,
            Damage::NotHome(_) => Self::DamagedNotHome,
            Damage::OtherStep(_) => Self::DamagedOtherStep,
            Damage::OtherWorld(_) => Self::DamagedOtherWorld,
        }
    }
}

impl From<End> for TautlineStatus {
    fn from(end: End) -> Self {
        match end {
            End::Explored => Self::Explored,
            End::Exhausted => Self::Exhausted,
        }
    }
}

/// The status in words, with what to do: a text that ends with a zero byte and stays where it is. Of a number that is
/// no status it says so.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub extern "C" fn tautline_status_text(status: i32) -> *const c_char {
    let known = TautlineStatus::ALL.into_iter().find(|&known| known as i32 == status);
    known.map_or(c"this is no status of tautline", TautlineStatus::text).as_ptr()
}
