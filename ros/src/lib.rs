//! A ROS 2 node that watches robots by the safety clauses of `SPEC.md`: it hears poses, and publishes diagnostics and
//! markers of the clauses that they break. [`config`] says who is watched by what, [`watch`] judges without a network,
//! [`node`] is the network.

pub mod config;
pub mod messages;
pub mod node;
mod report;
pub mod watch;

/// Prints a line for a person to stderr, where there may be nobody any more to read it.
#[macro_export]
macro_rules! tell {
    ($($part:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), "tautline-ros: {}", format_args!($($part)*));
    }};
}
