//! The papers' tables, tried as a whole.

mod chart;
mod radio;
mod tables;
