//! The papers' tables, tried as a whole.

mod chart;
mod page;
mod radio;
mod rivals;
mod same_runs;
mod seeds;
mod tables;
