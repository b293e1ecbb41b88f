//! Radio fields, tried as a whole.

mod maps;
mod position;
mod tan;
