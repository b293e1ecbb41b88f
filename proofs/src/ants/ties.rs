//! Where an ant goes (ANTS-2): whatever the sensors beside it count.

use tautline_kernel::ants::least_crossed;
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{COMPASS, Ring, Scan, Sensor};
use tautline_kernel::ground::Side;

use super::colony::Observed;
use crate::engine::{Outcome, require};

/// What a sensor counts at most here.
const MOST: u32 = 4;

/// The bound of [`ties`].
pub(super) fn counts() -> String {
    format!("any side neighbours, with up to {MOST} crossings each")
}

/// ANTS-2: the side through which an ant goes.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn ties(observed: &Observed, oracle: &mut dyn Oracle) -> Outcome {
    let none = Ring::default();
    let mut scan = Scan {
        here: Sensor::default(),
        unexplored: none,
        explored: none,
        closing: none,
        visited: none,
        open: none,
        rims: none,
        detected: 0,
        beside: none,
        crossings: [0; 4],
        claims: [None; 4],
        serials: [0; 8],
    };
    let mut due: Option<(u32, Side)> = None;
    for (place, side) in COMPASS.into_iter().enumerate() {
        if oracle.flip() {
            let crossings = oracle.pick(MOST + 1);
            scan.beside = scan.beside.or(Ring::of(side));
            scan.crossings[place] = if observed.counts { crossings } else { 0 };
            if due.is_none_or(|(least, _)| crossings < least) {
                due = Some((crossings, side));
            }
        }
    }
    let goes = least_crossed(&scan, scan.beside);
    require(goes == due.map(|(_, side)| side), "it goes to the first of the least crossed neighbours")?;
    Ok(if goes.is_some() { "a side" } else { "no side" })
}
