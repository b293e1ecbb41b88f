//! The environments of a cell in plain arithmetic, for whoever asks nothing of the kernel.

use tautline_kernel::ground::Cell;

/// E_S: at most one column and one row apart.
pub(crate) fn in_safe(centre: Cell, cell: Cell) -> bool {
    let (dx, dy) = centre.apart(cell);
    dx <= 1 && dy <= 1
}

/// E_C: E_S, and two straight ahead.
pub(crate) fn in_covered(centre: Cell, cell: Cell) -> bool {
    let (dx, dy) = centre.apart(cell);
    in_safe(centre, cell) || u32::from(dx) + u32::from(dy) <= 2
}
