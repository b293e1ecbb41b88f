//! The state of a small floor and of those on it, and an oracle that misses some sensors.

use std::array;

use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Sensor};
use tautline_kernel::ground::{Cell, Edge};

use super::plans::{CELLS, FloorPlan};

/// What a small floor stores, and those on it.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct State<B> {
    pub(crate) sensors: [Sensor; CELLS],
    /// How many sensors have been placed in each cell.
    pub(crate) placed: [u8; CELLS],
    pub(crate) bodies: Vec<B>,
    /// Sensors missed so far.
    pub(crate) misses: u8,
    /// Who acted last, and how many times in a row; kept only where that is bounded.
    pub(crate) streak: (u8, u8),
}

/// The cells of a [`Part`].
const QUARTER: usize = CELLS / 4;

/// A part of a [`State`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Part<B> {
    /// A quarter of the floor.
    Floor([Sensor; QUARTER], [u8; QUARTER]),
    /// One of those on it.
    Body(B),
    /// The rest.
    Counts { misses: u8, streak: (u8, u8) },
}

impl<B: Clone> State<B> {
    /// The parts.
    pub(crate) fn parts(&self) -> impl Iterator<Item = Part<B>> {
        let quarter = |first: usize| {
            let cell = |place: usize| first * QUARTER + place;
            let sensors = array::from_fn(|place| self.sensors[cell(place)]);
            Part::Floor(sensors, array::from_fn(|place| self.placed[cell(place)]))
        };
        let counts = Part::Counts { misses: self.misses, streak: self.streak };
        let bodies = self.bodies.iter().cloned().map(Part::Body);
        (0..CELLS / QUARTER).map(quarter).chain([counts]).chain(bodies)
    }

    /// Makes `part` the one in this place.
    pub(crate) fn put(&mut self, place: usize, part: &Part<B>) {
        match part {
            Part::Floor(sensors, placed) => {
                let cells = place * QUARTER..(place + 1) * QUARTER;
                self.sensors[cells.clone()].copy_from_slice(sensors);
                self.placed[cells].copy_from_slice(placed);
            }
            Part::Counts { misses, streak } => (self.misses, self.streak) = (*misses, *streak),
            Part::Body(body) => self.bodies[place - CELLS / QUARTER - 1] = body.clone(),
        }
    }
}

/// The sensors of a plan.
pub(crate) struct Small<'a> {
    pub(crate) plan: &'a FloorPlan,
    pub(crate) sensors: &'a mut [Sensor; CELLS],
    /// How many sensors have been placed in each cell.
    pub(crate) placed: &'a mut [u8; CELLS],
}

impl Floor for Small<'_> {
    fn sensor(&self, cell: Cell) -> Option<Sensor> {
        self.plan.place(cell).map(|place| self.sensors[place])
    }

    fn put(&mut self, cell: Cell, sensor: Sensor) {
        if let Some(place) = self.plan.place(cell) {
            self.sensors[place] = sensor;
        }
    }

    fn unpack(&mut self, cell: Cell) -> u16 {
        self.plan.place(cell).map_or(0, |place| {
            self.placed[place] = self.placed[place].saturating_add(1);
            self.placed[place].into()
        })
    }

    fn is_open(&self, edge: Edge) -> bool {
        self.plan.is_open(edge)
    }
}

/// The free cells with such marks.
pub(crate) fn marked(plan: &FloorPlan, sensors: &[Sensor; CELLS], is: impl Fn(Mark) -> bool) -> u16 {
    let cells = (0..CELLS).filter(|place| plan.free >> place & 1 == 1);
    cells.filter(|&place| is(sensors[place].mark)).fold(0, |set, place| set | 1 << place)
}

/// Whether the sensors on both sides of `edge` say that it is shut.
pub(crate) fn is_shut(plan: &FloorPlan, sensors: &[Sensor; CELLS], edge: Edge) -> bool {
    let (one, side) = (edge.cell(), edge.side());
    let says = |cell: Cell, side| plan.place(cell).is_some_and(|place| sensors[place].shut.has(side));
    says(one, side) && says(one.beyond(side), side.opposite())
}

/// Misses sensors a bounded number of times.
pub(crate) struct Misses<'a> {
    pub(crate) world: &'a mut dyn Oracle,
    pub(crate) count: &'a mut u8,
    pub(crate) most: u8,
}

impl Oracle for Misses<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.world.pick(below)
    }

    fn mishap(&mut self) -> bool {
        let is_missed = *self.count < self.most && self.world.flip();
        *self.count += u8::from(is_missed);
        is_missed
    }
}
