//! MRC, Mobile Robot Coordination [Jiang 2011, 3.3]: which robot goes to which node that waits for rescue (WFR).
//! Clauses MRC-1 to MRC-14.
//!
//! A WFR calls by a NOTICE that spreads through the network; robots answer with MOVE along the tree that the NOTICE
//! has left; the WFR chooses one and tells all of them by RESB. [`Wfr`], [`Robot`] and [`Relay`], the node on the way,
//! are plain values: what arrives, or a timer that goes off, makes of one the next, and says what to send. No machine
//! has a clock: each says which timer runs, and the caller, who knows how long its network takes, how long that is.

mod message;
mod relay;
mod robot;
mod rule;
mod wfr;

pub use message::{Bid, Downward, Resb, Upward, Word};
pub use relay::{Hop, Relay};
pub use robot::{Request, Robot, RobotTimer, ServiceBit, Task};
pub use rule::{Condition, Conditions, Rule};
pub use wfr::{Mail, Phase, Wfr, WfrTimer};
