//! Radio fields, tried as a whole.

#![expect(
    clippy::disallowed_methods,
    reason = "a test that shares nothing with what it tries has its bounds beside it"
)]

mod belief;
mod maps;
mod position;
mod tan;
