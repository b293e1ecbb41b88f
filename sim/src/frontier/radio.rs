//! The radio as robots have it: which messages they hear, and where they take themselves to be.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Place, SIDE};
use tautline_kernel::ground::{Area, Cell};
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{self, Point, Range, Residual, Signal, locate};

use crate::layout::generate;
use crate::noise::deviation_db;
use crate::options::Options;

/// The radio of a run.
#[derive(Clone, Debug)]
pub(super) struct Radio {
    options: Options,
    pub(super) dice: Dice,
    anchors: [Point; 3],
    rim: Option<position::Area>,
    signal: Option<Signal>,
}

/// A seeded oracle.
#[derive(Clone, Debug)]
pub(super) struct Dice(ChaCha8Rng);

impl Oracle for Dice {
    fn pick(&mut self, below: u32) -> u32 {
        ((u128::from(self.0.next_u64()) * u128::from(below)) >> 64) as u32
    }
}

impl Radio {
    /// A radio with anchors in three corners of the area. A cell counts as one metre wide: errors are in proportion to
    /// distances, so that the width of a cell does not matter.
    pub(super) fn new(options: Options, area: Area, seed: u64) -> Self {
        let (west, north) = (f64::from(area.first().x) - 0.5, f64::from(area.first().y) - 0.5);
        let (east, south) = (f64::from(area.last().x) + 0.5, f64::from(area.last().y) + 0.5);
        let anchors = [Point::new(west, north), Point::new(east, north), Point::new(west, south)];
        let rim = position::Area::new(Point::new(west, north), Point::new(east, south));
        let signal =
            Signal::new(Propagation::FREE_SPACE, options.noise_db).filter(|_| options.noise_db > 0.0);
        Self { options, dice: Dice(generate::source(seed, *b"frontier")), anchors, rim, signal }
    }

    /// How far messages are heard, if not everywhere.
    pub(super) const fn range_cells(&self) -> Option<u16> {
        self.options.range_cells
    }

    /// Whether every robot hears everything.
    pub(super) fn is_whole(&self) -> bool {
        self.options.range_cells.is_none() && self.options.loss.is_never()
    }

    /// Whether positions have an error.
    pub(super) const fn is_noisy(&self) -> bool {
        self.signal.is_some()
    }

    /// Whether a robot in one cell hears what one in another says now.
    pub(super) fn is_heard(&mut self, from: Cell, to: Cell) -> bool {
        let (columns, rows) = from.apart(to);
        let is_near = self.options.range_cells.is_none_or(|range| {
            u64::from(columns).pow(2) + u64::from(rows).pow(2) <= u64::from(range).pow(2)
        });
        is_near && (self.options.loss.is_never() || !self.options.loss.happens(&mut self.dice.0))
    }

    /// Where a robot takes itself to be that is at `place`.
    pub(super) fn fix(&mut self, place: Place) -> Place {
        let Some(signal) = self.signal else { return place };
        let units = f64::from(SIDE);
        let at = Point::new(f64::from(place.x) / units, f64::from(place.y) / units);
        let dice = &mut self.dice;
        let ranges = self.anchors.map(|anchor| {
            let level_db = signal.level_db(at.distance_m(anchor)) + deviation_db(signal.noise_db(), dice);
            Range::new(anchor, signal.distance_m(level_db))
        });
        let fixed = locate(&ranges, Residual::Decibels, &signal, self.rim);
        let units_of = |metres: f64| libm::round(metres * units) as i32;
        fixed.map_or(place, |fix| Place::new(units_of(fix.best().at.x_m), units_of(fix.best().at.y_m)))
    }
}
