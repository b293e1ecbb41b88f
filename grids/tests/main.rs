//! The grids, tried as a whole.

mod heap_grid;
