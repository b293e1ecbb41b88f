//! The tests of the node, as one program.

mod bad_input;
mod loopback;
mod team;
mod watch;
