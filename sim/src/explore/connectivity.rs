//! Whether robots are together: joined by links, or two in one cell.

use tautline_kernel::ground::Cell;

/// How many of `rest` no links join to `first`.
pub fn unlinked<T: Copy>(first: T, mut rest: Vec<T>, is_linked: impl Fn(T, T) -> bool) -> usize {
    let mut joined = vec![first];
    while let Some(from) = joined.pop() {
        joined.extend(rest.extract_if(.., |other| is_linked(from, *other)));
    }
    rest.len()
}

/// Whether two robots are in one cell.
pub fn has_double(cells: &[Cell]) -> bool {
    let mut cells = cells.to_vec();
    cells.sort_unstable();
    cells.windows(2).any(|pair| pair[0] == pair[1])
}
