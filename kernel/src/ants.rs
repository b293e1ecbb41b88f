//! Ants (paper 004, II.A, after Svennebring and Koenig 2004): every cell counts how many times an agent has entered it,
//! and an agent goes to the side neighbour that was entered least. It explores whatever is connected and never knows
//! that it is done. Clause: ANTS-1.

use crate::floor::{COMPASS, Ring, Scan};
use crate::lattice::Side;

/// Where an agent goes: the side neighbour of `among` with the fewest crossings, ties in the order of the compass.
/// `None` if there is none.
#[inline]
pub fn least_crossed(scan: &Scan, among: Ring) -> Option<Side> {
    (0..)
        .zip(COMPASS)
        .filter(|&(_, side)| among.has(side))
        .min_by_key(|&(place, _): &(usize, Side)| scan.crossings[place])
        .map(|(_, side)| side)
}
