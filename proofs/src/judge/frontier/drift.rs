//! One robot whose fixes are off by parts of a cell (FRONTIER-5), and the occupancy probability (FRONTIER-8).
//! Lengths are sixteenths of a cell's side.

use std::collections::{BTreeMap, BTreeSet};

use super::super::change::plain;
use super::super::{Case, Floor, Objection, Place, beside, breaks_at_last, must};
use super::BY_NUMBER;

/// The side of a cell, and half of it.
const SIDE: i32 = 16;
const HALF: i32 = SIDE / 2;

/// A run of one robot by the published rule.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Drift {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The cells, and the obstacles that the robot meets.
    pub floor: Floor,
    /// How far each fix is off along each axis, if it is.
    pub error: i32,
    /// The cell at whose midpoint it starts.
    pub start: Place,
    /// How far its first fix is off.
    pub off: Place,
    /// Its moves.
    pub moves: Vec<Move>,
}

/// A move to another cell, or to an obstacle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Move {
    /// Through which side: east, south, west, north, from 0.
    pub side: usize,
    /// How far the fix after it is off; none where an obstacle ends the move.
    pub off: Option<Place>,
}

plain!(Drift { floor, error, start, off, moves });
plain!(Move { side, off });

/// The midpoint of a cell.
fn midpoint((x, y): Place) -> Place {
    (SIDE * x, SIDE * y)
}

impl Case for Drift {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let is_known = self.clause == "FRONTIER-5" && (0..HALF).contains(&self.error);
        must(is_known, "the judge does not know this")?;
        must(self.floor.is_free(self.start), "the robot starts in no free cell")?;
        must(self.may_err(self.off), "a fix is off by another length")?;
        let (mut entered, mut met) = (BTreeSet::from([self.start]), BTreeSet::new());
        let mut known = BTreeMap::from([(self.start, true)]);
        let (mut at, mut place) = (self.start, midpoint(self.start));
        let mut fix = (place.0 + self.off.0, place.1 + self.off.1);
        for (number, made) in (1..).zip(&self.moves) {
            let object = |what| Objection { at: number, what };
            let leads = |side: &usize| {
                beside(at, *side).is_some_and(|cell| self.floor.has(cell) && !known.contains_key(&cell))
            };
            let due = BY_NUMBER.into_iter().find(leads);
            must(due == Some(made.side), "the rule does not go there").map_err(object)?;
            let aim = beside(at, made.side).unwrap_or(at);
            let to = midpoint(aim);
            // It goes as far as the way from its fix to the midpoint is.
            let to = (place.0 + to.0 - fix.0, place.1 + to.1 - fix.1);
            let obstacle = self.go(place, to, &mut entered);
            must(obstacle.is_some() == made.off.is_none(), "there is an obstacle, or there is none")
                .map_err(object)?;
            if let Some(obstacle) = obstacle {
                met.insert(obstacle);
                known.insert(aim, false);
            }
            if let Some(off) = made.off {
                must(self.may_err(off), "a fix is off by another length").map_err(object)?;
                (place, fix) = (to, (to.0 + off.0, to.1 + off.1));
                at = self.taken_for(fix);
                known.insert(at, true);
            }
            let is_so = |(cell, is_explored): (&Place, &bool)| {
                if *is_explored { entered.contains(cell) } else { !self.floor.is_free(*cell) }
            };
            let breaks = !known.iter().all(is_so);
            breaks_at_last(breaks, number == self.moves.len()).map_err(object)?;
        }
        must(!self.moves.is_empty(), "nothing happens")?;
        Ok(must(self.floor.barred.is_subset(&met), "an obstacle was never met")?)
    }
}

impl Drift {
    /// A fix is off by 0 or the error, along each axis.
    fn may_err(&self, (x, y): Place) -> bool {
        [x, y].iter().all(|off| [0, self.error].contains(&off.abs()))
    }

    /// Goes straight on until an obstacle; which.
    fn go(&self, from: Place, to: Place, entered: &mut BTreeSet<Place>) -> Option<Place> {
        // So fine that no cell is left out: a way is at most two cells long.
        const PARTS: i32 = 1 << 12;
        for part in 0..=PARTS {
            let along = |from: i32, to: i32| {
                (PARTS * from + (to - from) * part + PARTS * HALF).div_euclid(PARTS * SIDE)
            };
            let cell = (along(from.0, to.0), along(from.1, to.1));
            if !self.floor.is_free(cell) {
                return Some(cell);
            }
            entered.insert(cell);
        }
        None
    }

    /// The cell whose midpoint is nearest to a fix; on the rim between two the first one.
    fn taken_for(&self, (x, y): Place) -> Place {
        let nearest =
            |coordinate: i32, count: i32| (coordinate + HALF - 1).div_euclid(SIDE).clamp(0, count - 1);
        (nearest(x, self.floor.columns), nearest(y, self.floor.rows))
    }
}

/// The occupancy probability of the cell 0,0 as printed, by one reading of its distance, at two places in the cell, the
/// first one no farther from its midpoint.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Occupancy {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The distance d_r of equation (11).
    pub distance: Distance,
    /// The places, from the midpoint.
    pub places: [Place; 2],
}

/// Where a robot's distance d_r is measured to in equation (11).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Distance {
    /// The midpoint of the cell.
    ToMidpoint,
    /// The nearest side of the cell.
    ToSide,
}

plain!(Distance one of ToMidpoint, ToSide);
plain!(Occupancy { distance, places });

impl Case for Occupancy {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        must(self.clause == "FRONTIER-8", "the judge does not know this clause")?;
        let is_in = |&(x, y): &Place| x.abs() <= HALF && y.abs() <= HALF;
        must(self.places.iter().all(is_in), "a place is not in the cell")?;
        let [near, far] = self.places.map(|(x, y)| x * x + y * y);
        must(near <= far, "the second place is nearer")?;
        // It is the distance over half a side, at most 1.
        let is_broken = match self.distance {
            // It is 0 at the midpoint, grows, and is 1 from the rim on.
            Distance::ToMidpoint => near == 0 || near < far.min(HALF * HALF) || far >= HALF * HALF,
            Distance::ToSide => {
                let [by_near, by_far] = self.places.map(|(x, y)| HALF - x.abs().max(y.abs()));
                by_near < by_far || far >= HALF * HALF && by_far > 0
            }
        };
        Ok(must(is_broken, "the probability is as demanded")?)
    }
}
