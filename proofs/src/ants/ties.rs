//! Where an ant goes (ANTS-2): whatever the sensors beside it count.

use tautline_kernel::ants::{Rule, decide};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{COMPASS, Ring, Scan};
use tautline_kernel::ground::Side;

use crate::engine::{Outcome, require};
use crate::floor::series::{Deception, Subject};

/// The most crossings that a sensor counts here.
const MOST: u32 = 4;

/// The bound of [`ties`].
pub(super) fn counts() -> String {
    format!("any side neighbours, with up to {MOST} crossings each")
}

/// ANTS-2: the side through which an ant goes.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn ties(subject: &Subject<Rule>, oracle: &mut dyn Oracle) -> Outcome {
    let is_counted = subject.deception != Deception::CountsNothing;
    let mut scan = Scan::default();
    let mut due: Option<(u32, Side)> = None;
    for (place, side) in COMPASS.into_iter().enumerate() {
        if oracle.flip() {
            let crossings = oracle.pick(MOST + 1);
            scan.beside = scan.beside.or(Ring::of(side));
            scan.crossings[place] = if is_counted { crossings } else { 0 };
            if due.is_none_or(|(least, _)| crossings < least) {
                due = Some((crossings, side));
            }
        }
    }
    let goes = decide(subject.scheme, &scan).map(|(side, _)| side);
    require(goes == due.map(|(_, side)| side), "it goes to the first of the least crossed neighbours")?;
    Ok(if goes.is_some() { "a side" } else { "no side" })
}
