//! The tests of the node, as one program.

mod bad_input;
mod hour;
mod loopback;
mod team;
mod watch;
