//! Radio fields, tried as a whole.

mod belief;
mod maps;
mod position;
mod tan;
