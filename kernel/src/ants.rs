//! Ants [Ferranti 2009, II.A, after Svennebring and Koenig 2004]: every cell counts how many times an agent has entered
//! it, and an agent goes to the side neighbour that was entered least. It explores whatever is connected and never
//! knows that it is done. Clauses: ANTS-1 … ANTS-3.

use crate::floor::{COMPASS, Entry, Floor, Ring, Scan, SensorFate, enter, leave};
use crate::ground::{Cell, Side};

/// The count of a sensor placed where none was, or where one was missed: an ant cannot tell which.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Rule {
    /// From nothing: it says 1, as published. The paper leaves open what becomes of a sensor that was only missed.
    Published(SensorFate),
    /// Repair: from what the cell counts that the ant comes from. A missed sensor takes its count with it, and one that
    /// says 1 draws ants back to where they have been.
    Repaired,
}

impl Rule {
    /// As the paper publishes it, where the count of a missed sensor is lost.
    pub const PUBLISHED: Self = Self::Published(SensorFate::Lost);
}

/// Where an agent goes: the side neighbour of `among` with the fewest crossings, ties in the order of the compass.
/// `None` if there is none.
pub fn least_crossed(scan: &Scan, among: Ring) -> Option<Side> {
    (0..)
        .zip(COMPASS)
        .filter(|&(_, side)| among.has(side))
        .min_by_key(|&(place, _): &(usize, Side)| scan.crossings[place])
        .map(|(_, side)| side)
}

/// The side that an ant goes through, and what it enters the cell beyond it as; none if it stays.
pub type Act = Option<(Side, Entry)>;

/// An ant's action after `scan`.
pub fn decide(rule: Rule, scan: &Scan) -> Act {
    let side = least_crossed(scan, scan.beside)?;
    let entry = match rule {
        Rule::Published(replaced) => scan.entry(side, replaced),
        Rule::Repaired => scan.entry_counting_on(side),
    };
    Some((side, entry))
}

/// Writes what an ant in `cell` has decided; where it is then.
pub fn carry_out(floor: &mut impl Floor, cell: Cell, act: Act) -> Cell {
    let Some((side, entry)) = act else { return cell };
    leave(floor, cell);
    enter(floor, cell.beyond(side), entry);
    cell.beyond(side)
}
