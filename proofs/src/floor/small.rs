//! The state of a small floor and of those on it, and an oracle that misses some sensors.

use std::array;

use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Sensor, settle};
use tautline_kernel::ground::{Cell, Edge, Side, Step, Steps};

use super::plans::{CELLS, Edges, FloorPlan};
use crate::engine::states::Places;

/// The memory of a sensor in one word. Its identifier counts how many sensors were placed in its cell, and takes the
/// byte that is left: on a small floor it has no more.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(crate) struct Stored(u64);

impl Stored {
    const NOTHING: Sensor =
        Sensor { mark: Mark::Unexplored, crossings: 0, agents: 0, shut: Steps::NONE, claim: None, serial: 0 };
    const MARK: u64 = 0b111;
    const CROSSINGS: u64 = Sensor { crossings: u32::MAX, ..Self::NOTHING }.to_bits();
    const SHUT: u64 = Sensor { shut: Steps::ALL.without(Step::Stay), ..Self::NOTHING }.to_bits();
    /// The bits of the identifier.
    const SERIAL: u64 = u64::MAX << (u64::BITS - u8::BITS);

    pub(crate) fn new(sensor: Sensor) -> Self {
        Self(sensor.to_bits() | u64::from(sensor.serial) << Self::SERIAL.trailing_zeros())
    }

    pub(crate) fn sensor(self) -> Sensor {
        let serial = (self.0 >> Self::SERIAL.trailing_zeros()) as u16;
        Sensor { serial, ..Sensor::from_bits(self.0 & !Self::SERIAL).unwrap_or_default() }
    }

    pub(crate) fn mark(self) -> Mark {
        Sensor::from_bits(self.0 & Self::MARK).unwrap_or_default().mark
    }

    fn shut(self) -> Steps {
        if self.0 & Self::SHUT == 0 { Steps::NONE } else { self.sensor().shut }
    }

    /// Whether two floors differ in a mark or in a side that is shut.
    pub(crate) fn are_marked_alike(one: &[Self; CELLS], other: &[Self; CELLS]) -> bool {
        let marks = Self::MARK | Self::SHUT;
        one.iter().zip(other).fold(0, |differs, (one, other)| differs | (one.0 ^ other.0) & marks) == 0
    }

    /// The same but for its identifier.
    pub(crate) const fn without_serial(self) -> Self {
        Self(self.0 & !Self::SERIAL)
    }

    /// The same but for its crossings.
    pub(crate) const fn without_crossings(self) -> Self {
        Self(self.0 & !Self::CROSSINGS)
    }
}

/// What a small floor stores, and those on it.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct State<B> {
    pub(crate) sensors: [Stored; CELLS],
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

/// The place of the counts, behind the quarters, and of the first body.
const COUNTS: usize = CELLS / QUARTER;
const FIRST_BODY: usize = COUNTS + 1;

/// A part of a [`State`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Part<B> {
    /// A quarter of the floor.
    Floor([Stored; QUARTER], [u8; QUARTER]),
    /// One of those on it.
    Body(B),
    /// The rest.
    Counts { misses: u8, streak: (u8, u8) },
}

impl<B: Clone + PartialEq> State<B> {
    /// The start of these, who are in `cells` of `plan`.
    pub(crate) fn start(plan: &FloorPlan, cells: &[Cell], bodies: Vec<B>) -> Self {
        let (mut sensors, mut placed) = ([Stored::default(); CELLS], [0; CELLS]);
        settle(&mut Small { plan, sensors: &mut sensors, placed: &mut placed }, cells);
        Self { sensors, placed, bodies, misses: 0, streak: (0, 0) }
    }

    /// Leaves identifiers out of the state.
    pub(crate) fn forget_serials(&mut self) {
        self.placed = [0; CELLS];
        self.sensors.iter_mut().for_each(|sensor| *sensor = sensor.without_serial());
    }

    /// Leaves crossings out of the state.
    pub(crate) fn forget_crossings(&mut self) {
        self.sensors.iter_mut().for_each(|sensor| *sensor = sensor.without_crossings());
    }

    /// How many parts it has: the quarters, the counts, the bodies.
    pub(crate) const fn places(&self) -> usize {
        FIRST_BODY + self.bodies.len()
    }

    /// The part in this place.
    pub(crate) fn part(&self, place: usize) -> Part<B> {
        if place < COUNTS {
            let cell = |number: usize| place * QUARTER + number;
            let sensors = array::from_fn(|number| self.sensors[cell(number)]);
            Part::Floor(sensors, array::from_fn(|number| self.placed[cell(number)]))
        } else if place < FIRST_BODY {
            Part::Counts { misses: self.misses, streak: self.streak }
        } else {
            Part::Body(self.bodies[place - FIRST_BODY].clone())
        }
    }

    /// The places whose parts differ.
    pub(crate) fn differing(&self, other: &Self) -> Places {
        let mut floor = [0; COUNTS];
        for (cell, (one, other)) in self.sensors.iter().zip(&other.sensors).enumerate() {
            floor[cell / QUARTER] |= one.0 ^ other.0;
        }
        for (cell, (one, other)) in self.placed.iter().zip(&other.placed).enumerate() {
            floor[cell / QUARTER] |= u64::from(one ^ other);
        }
        let floor = floor.into_iter().map(|differs| differs != 0);
        let counts = (self.misses, self.streak) != (other.misses, other.streak);
        let bodies = self.bodies.iter().zip(&other.bodies).map(|(one, other)| one != other);
        let differing = floor.chain([counts]).chain(bodies);
        (0..).zip(differing).fold(0, |places, (place, differs)| places | Places::from(differs) << place)
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
            Part::Body(body) => self.bodies[place - FIRST_BODY] = body.clone(),
        }
    }
}

/// The sensors of a plan.
pub(crate) struct Small<'a> {
    pub(crate) plan: &'a FloorPlan,
    pub(crate) sensors: &'a mut [Stored; CELLS],
    /// How many sensors have been placed in each cell.
    pub(crate) placed: &'a mut [u8; CELLS],
}

impl Floor for Small<'_> {
    fn sensor(&self, cell: Cell) -> Option<Sensor> {
        self.plan.place(cell).map(|place| self.sensors[place].sensor())
    }

    fn put(&mut self, cell: Cell, sensor: Sensor) {
        if let Some(place) = self.plan.place(cell) {
            self.sensors[place] = Stored::new(sensor);
        }
    }

    fn unpack(&mut self, cell: Cell) -> u16 {
        self.plan.place(cell).map_or(0, |place| {
            self.placed[place] = self.placed[place].saturating_add(1);
            self.placed[place].into()
        })
    }

    fn is_open(&self, edge: Edge) -> bool {
        !self.plan.has_wall(edge)
    }
}

/// The free cells with such marks.
pub(crate) fn marked(plan: &FloorPlan, sensors: &[Stored; CELLS], is: impl Fn(Mark) -> bool) -> u16 {
    let mut places = [0; 1 + Stored::MARK as usize];
    for (place, sensor) in sensors.iter().enumerate() {
        places[(sensor.0 & Stored::MARK) as usize] |= 1 << place;
    }
    let marks = [Mark::Unexplored, Mark::Explored, Mark::Closing, Mark::Visited, Mark::Sealed];
    let marked = marks.into_iter().filter(|&mark| is(mark)).map(|mark| places[mark as usize]);
    marked.fold(0, |all: u16, places| all | places) & plan.free
}

/// The sides that the sensors on both sides of them say are shut.
pub(crate) fn shut(plan: &FloorPlan, sensors: &[Stored; CELLS]) -> Edges {
    let says = |side: Side| {
        (0..CELLS)
            .filter(|&place| sensors[place].shut().has(Step::Cross(side)))
            .fold(0, |set, place| set | 1 << place)
    };
    if sensors.iter().all(|sensor| sensor.0 & Stored::SHUT == 0) {
        return Edges::default();
    }
    Edges {
        east: says(Side::East) & says(Side::West) >> 1,
        south: says(Side::South) & says(Side::North).unbounded_shr(plan.width as u32),
    }
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
