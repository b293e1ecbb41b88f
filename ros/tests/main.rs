//! The tests of the node, as one program.

mod bad_input;
mod hour;
mod layout;
mod loopback;
mod team;
mod watch;
