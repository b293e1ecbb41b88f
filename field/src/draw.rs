//! Drawings of radio fields, of rescues and of positions.

pub mod field;
pub mod position;
pub mod rescue;
