//! The chain (clauses CHAIN-1 to CHAIN-19) for programs in C. A caller gives the memory of a chain and of its log, asks
//! for a plan, moves the robots, and says what came of it, as [`tautline_kernel::chain`] has it. Every call returns a
//! [`TautlineStatus`]; nothing is allocated, and no panic leaves a call: one, which would be a bug, ends the program.
//!
//! Monitors of [`tautline_monitor`] watch robots that move, whatever program moves them.
//!
//! The headers `include/tautline.h` and `include/tautline_monitor.h` are written by cbindgen; a test compares them.

#![cfg_attr(target_os = "none", no_std)]

mod caller;
mod chain;
mod monitor;
mod status;

pub use chain::{
    TAUTLINE_CHAIN_CELLS, TAUTLINE_CHAIN_ROBOTS, TAUTLINE_CHAIN_WORDS, TAUTLINE_KIND_ADVANCE,
    TAUTLINE_KIND_BACKTRACK, TAUTLINE_RULE_PUBLISHED, TAUTLINE_RULE_REEL, TAUTLINE_RULE_REPAIRED,
    TAUTLINE_STEP_EAST, TAUTLINE_STEP_NORTH, TAUTLINE_STEP_SOUTH, TAUTLINE_STEP_STAY, TAUTLINE_STEP_WEST,
    TautlineCell, TautlineChain, TautlineIsOpen, TautlinePlan, tautline_chain_begin, tautline_chain_cells,
    tautline_chain_hear, tautline_chain_is_explored, tautline_chain_plan, tautline_chain_settle,
};
pub use monitor::{
    TAUTLINE_DEMAND_APART, TAUTLINE_DEMAND_CELLS, TAUTLINE_DEMAND_JOINED, TAUTLINE_DEMAND_NEIGHBOURS,
    TAUTLINE_DOUBT_AHEAD, TAUTLINE_DOUBT_LATE, TAUTLINE_DOUBT_NOBODY, TAUTLINE_DOUBT_SILENT,
    TAUTLINE_DOUBT_TOO_FAR, TAUTLINE_MONITOR_WORDS, TAUTLINE_ROBOT_WORDS, TAUTLINE_VERDICT_BROKEN,
    TAUTLINE_VERDICT_KEPT, TAUTLINE_VERDICT_UNKNOWN, TautlineDemand, TautlineMonitor, TautlineRobot,
    TautlineVerdict, tautline_monitor_at, tautline_monitor_begin, tautline_monitor_hear,
};
pub use status::{TautlineStatus, tautline_status_text};

/// Without an operating system nobody can be told: the processor stays here. A panic would be a bug of this library.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
