//! Ants where a missed sensor stays beside the new one, and the sensors of a cell are missed one by one (ANTS-1,
//! ANTS-3): an ant reads the highest count of those that it sees, and writes one more to each of these.

use std::convert::Infallible;

use tautline_kernel::ants::least_crossed;
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{COMPASS, Floor, Mark, Ring, Scan};
use tautline_kernel::ground::{Cell, Edge, Side, Step};

use crate::engine::{Outcome, require};
use crate::floor::crew::{Scheme, SensorData, Sight};
use crate::floor::team::Demands;

/// The sensors of a cell: the first one, and one for each time that all were
/// missed, as often as the searches let it happen.
const SENSORS: usize = 3;

/// The counts of the sensors of a cell; 0 where there is none.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(super) struct Pile([u32; SENSORS]);

/// The sensors of a cell that are seen, a bit for each.
type SensorSet = u8;

/// How a cell is entered whose sensors are seen in part.
pub(super) type EntryRule = fn(Pile, SensorSet) -> Pile;

impl Pile {
    /// The sensors that an ant sees; `world` says which it misses.
    fn seen(self, world: &mut (impl Oracle + ?Sized)) -> SensorSet {
        let there = (0..SENSORS).filter(|&place| self.0[place] > 0);
        there.fold(0, |seen, place| if world.mishap() { seen } else { seen | 1 << place })
    }

    /// The highest count of those that are seen.
    fn reads(self, seen: SensorSet) -> u32 {
        let counts = (0..).zip(self.0).filter(|(place, _)| seen >> place & 1 == 1);
        counts.map(|(_, count)| count).max().unwrap_or(0)
    }

    /// The sensors once an ant has entered. Where it sees none it places a new one.
    pub(super) fn entered(mut self, seen: SensorSet) -> Self {
        let count = self.reads(seen).saturating_add(1);
        let place = self.0.iter().position(|&count| count == 0).filter(|_| seen == 0);
        for (number, sensor) in self.0.iter_mut().enumerate() {
            if seen >> number & 1 == 1 || place == Some(number) {
                *sensor = count;
            }
        }
        self
    }
}

/// The cell whose old sensors are lost when a new one is placed.
pub(super) fn losing(pile: Pile, seen: SensorSet) -> Pile {
    if seen == 0 { Pile::default().entered(seen) } else { pile.entered(seen) }
}

/// A look at the side neighbours, and which of their sensors it shows.
pub(super) struct Look {
    scan: Scan,
    seen: [SensorSet; 4],
}

impl SensorData for Pile {
    type View = Look;

    fn settle(floor: &mut impl Floor<Self>, starts: &[Cell]) {
        for &start in starts {
            let pile = floor.sensor(start).unwrap_or_default();
            floor.put(start, pile.entered(u8::from(pile != Self::default())));
        }
    }

    fn look(floor: &impl Floor<Self>, cell: Cell, world: &mut (impl Oracle + ?Sized)) -> Look {
        let mut look = Look { scan: Scan::default(), seen: [0; 4] };
        for (place, side) in COMPASS.into_iter().enumerate() {
            let Some(pile) = floor.sensor(cell.beyond(side)) else { continue };
            if floor.is_open(Edge::new(cell, side)) {
                look.seen[place] = pile.seen(world);
                look.scan.crossings[place] = pile.reads(look.seen[place]);
                look.scan.beside = look.scan.beside.or(Ring::of(side));
                if look.seen[place] == 0 {
                    look.scan.unexplored = look.scan.unexplored.or(Ring::of(side));
                }
            }
        }
        look
    }

    fn scan(look: &Look) -> &Scan {
        &look.scan
    }

    fn mark(&self) -> Mark {
        if *self == Self::default() { Mark::Unexplored } else { Mark::Explored }
    }

    fn crossings(&self) -> u32 {
        self.reads(SensorSet::MAX)
    }

    fn with_crossings(self, crossings: u32) -> Self {
        Self(self.0.map(|count| count.min(crossings)))
    }
}

/// Ants whose sensors are missed one by one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Apart;

impl Scheme for Apart {
    type Sensor = Pile;
    type Memory = ();
    type Act = Option<(Side, SensorSet)>;

    fn memory(&self, _: u8) {}

    fn decide(&self, (): &mut (), look: &Look) -> Self::Act {
        let goes = least_crossed(&look.scan, look.scan.beside)?;
        look.seen.into_iter().zip(COMPASS).find_map(|(seen, side)| (side == goes).then_some((side, seen)))
    }

    fn carry_out(&self, floor: &mut impl Floor<Pile>, cell: Cell, act: &Self::Act) -> Cell {
        let Some((side, seen)) = *act else { return cell };
        let beyond = cell.beyond(side);
        floor.put(beyond, floor.sensor(beyond).unwrap_or_default().entered(seen));
        beyond
    }

    fn step(act: &Self::Act) -> Option<Step> {
        Some(act.map_or(Step::Stay, |(side, _)| Step::Cross(side)))
    }

    fn may_roam(&self, _: Sight) -> bool {
        true
    }
}

impl Demands for Apart {
    type Own = Infallible;

    fn name(_: usize, agents: u32) -> &'static str {
        if agents == 1 { " ant" } else { " ants" }
    }
}

/// The most crossings that a sensor counts in [`keeps`].
const MOST: u32 = 4;

/// The bound of [`keeps`].
pub(super) fn piles() -> String {
    format!("two sensors in a cell, up to {MOST} crossings each, each of them missed or not")
}

/// ANTS-3: a cell with an old sensor and a new one, which an ant enters.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn keeps(entered: &EntryRule, oracle: &mut dyn Oracle) -> Outcome {
    let [old, new] = [(); 2].map(|()| 1 + oracle.pick(MOST));
    let before = Pile([old, new, 0]);
    let seen = before.seen(oracle);
    let after = entered(before, seen);
    require(after.crossings() >= before.crossings(), "a cell counts no fewer agents than before")?;
    Ok(match seen.count_ones() {
        0 => "both are missed",
        1 => "one is missed",
        _ => "both are seen",
    })
}
