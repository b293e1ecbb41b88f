//! The state of a small floor and of the agents on it, and an oracle that misses some sensors.

use std::array;

use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark};
use tautline_kernel::ground::{Cell, Edge, Side, Step};

use super::crew::{Body, Scheme, SensorData};
use super::plans::{CELLS, Edges, FloorPlan};
use crate::engine::states::{self, Bits, Places};

/// The sensors of a small floor.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Sensors<D> {
    pub(crate) all: [D; CELLS],
    /// How many sensors have been placed in each cell: on a small floor a byte counts them.
    placed: [u8; CELLS],
}

/// A small floor, and the agents on it, of which each remembers an `M` and decides an `A`.
#[derive(PartialEq, Eq, Hash, Debug)]
pub(crate) struct State<D, M, A> {
    pub(crate) sensors: Sensors<D>,
    pub(crate) bodies: Vec<Body<M, A>>,
    /// Sensors missed so far.
    pub(crate) misses: u8,
    /// The agent that acted last, and how many times in a row; kept only where that is bounded.
    pub(crate) streak: (u8, u8),
}

impl<D: Clone, M: Clone, A: Clone> Clone for State<D, M, A> {
    fn clone(&self) -> Self {
        Self { sensors: self.sensors.clone(), bodies: self.bodies.clone(), ..*self }
    }

    /// Keeps the memory of the agents: searches spend much of their time on copies.
    fn clone_from(&mut self, Self { sensors, bodies, misses, streak }: &Self) {
        self.sensors.clone_from(sensors);
        self.bodies.clone_from(bodies);
        (self.misses, self.streak) = (*misses, *streak);
    }
}

/// The state of agents of this scheme.
pub(crate) type StateOf<S> = State<<S as Scheme>::Sensor, <S as Scheme>::Memory, <S as Scheme>::Act>;

/// The cells of a [`Part`].
const QUARTER: usize = CELLS / 4;

/// The place of the counts, behind the quarters, and of the first body.
const COUNTS: usize = CELLS / QUARTER;
const FIRST_BODY: usize = COUNTS + 1;

/// A part of a [`State`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Part<D, M, A> {
    /// A quarter of the floor.
    Floor([D; QUARTER], [u8; QUARTER]),
    /// An agent.
    Body(Body<M, A>),
    /// The rest.
    Counts { misses: u8, streak: (u8, u8) },
}

/// A part of the state of agents of this scheme.
pub(crate) type PartOf<S> = Part<<S as Scheme>::Sensor, <S as Scheme>::Memory, <S as Scheme>::Act>;

impl<D: SensorData, M: Copy + PartialEq, A: Copy + PartialEq> State<D, M, A> {
    /// The start of agents of `scheme`, who are in `cells` of `plan`.
    pub(crate) fn start<S>(scheme: &S, plan: &FloorPlan, cells: &[Cell]) -> Self
    where
        S: Scheme<Sensor = D, Memory = M, Act = A>,
    {
        let mut sensors = Sensors { all: [D::default(); CELLS], placed: [0; CELLS] };
        D::settle(&mut Small { plan, sensors: &mut sensors, dark: 0 }, cells);
        Self { sensors, bodies: Body::crew(scheme, cells), misses: 0, streak: (0, 0) }
    }

    /// The agents that have something left to do.
    pub(crate) fn awake(&self) -> Bits {
        let awake = (0..).zip(&self.bodies).filter(|(_, body)| body.is_awake());
        awake.fold(0, |set, (agent, _)| set | 1 << agent)
    }

    /// How many parts it has: the quarters, the counts, the bodies.
    pub(crate) const fn places(&self) -> usize {
        FIRST_BODY + self.bodies.len()
    }

    /// The part in this place.
    pub(crate) fn part(&self, place: usize) -> Part<D, M, A> {
        if place < COUNTS {
            let cell = |number: usize| place * QUARTER + number;
            let sensors = array::from_fn(|number| self.sensors.all[cell(number)]);
            Part::Floor(sensors, array::from_fn(|number| self.sensors.placed[cell(number)]))
        } else if place < FIRST_BODY {
            Part::Counts { misses: self.misses, streak: self.streak }
        } else {
            Part::Body(self.bodies[place - FIRST_BODY])
        }
    }

    /// The places whose parts differ.
    pub(crate) fn differing(&self, other: &Self) -> Places {
        let mut floor = [false; COUNTS];
        let (one_floor, other_floor) = (&self.sensors, &other.sensors);
        for (place, differs) in floor.iter_mut().enumerate() {
            let cells = place * QUARTER..(place + 1) * QUARTER;
            *differs = one_floor.all[cells.clone()] != other_floor.all[cells.clone()]
                || one_floor.placed[cells.clone()] != other_floor.placed[cells];
        }
        let counts = (self.misses, self.streak) != (other.misses, other.streak);
        let bodies = self.bodies.iter().zip(&other.bodies).map(|(one, other)| one != other);
        states::places(floor.into_iter().chain([counts]).chain(bodies))
    }

    /// Makes `part` the one in this place.
    pub(crate) fn put(&mut self, place: usize, part: &Part<D, M, A>) {
        match part {
            Part::Floor(sensors, placed) => {
                let cells = place * QUARTER..(place + 1) * QUARTER;
                self.sensors.all[cells.clone()].copy_from_slice(sensors);
                self.sensors.placed[cells].copy_from_slice(placed);
            }
            Part::Counts { misses, streak } => (self.misses, self.streak) = (*misses, *streak),
            Part::Body(body) => self.bodies[place - FIRST_BODY] = *body,
        }
    }
}

impl<D: SensorData> Sensors<D> {
    /// Leaves identifiers out.
    pub(crate) fn forget_serials(&mut self) {
        self.placed = [0; CELLS];
        self.all.iter_mut().for_each(|sensor| *sensor = sensor.without_serial());
    }

    /// No sensor counts farther than to `most` crossings.
    pub(crate) fn count_to(&mut self, most: u32) {
        self.all.iter_mut().for_each(|sensor| *sensor = sensor.with_crossings(sensor.crossings().min(most)));
    }

    /// The free cells of `plan` with such sensors.
    pub(crate) fn cells(&self, plan: &FloorPlan, is: impl Fn(&D) -> bool) -> u16 {
        let cells = (0..).zip(&self.all).filter(|(_, sensor)| is(sensor));
        cells.fold(0, |set, (place, _)| set | 1 << place) & plan.free
    }

    /// Whether every cell of `plan` is explored.
    pub(crate) fn is_explored(&self, plan: &FloorPlan) -> bool {
        self.cells(plan, |sensor| sensor.mark() == Mark::Unexplored) == 0
    }

    /// Whether two floors differ in no mark and in no side that is shut.
    pub(crate) fn is_marked_as(&self, other: &Self) -> bool {
        let is_as = |(one, other): (&D, &D)| one.mark() == other.mark() && one.shut() == other.shut();
        self.all.iter().zip(&other.all).all(is_as)
    }

    /// The sides of `plan` that the sensors on both sides of them say are shut.
    pub(crate) fn shut(&self, plan: &FloorPlan) -> Edges {
        let says = |side: Side| {
            let places = (0..).zip(&self.all).filter(|(_, sensor)| sensor.shut().has(Step::Cross(side)));
            places.fold(0_u16, |set, (place, _)| set | 1 << place)
        };
        Edges {
            east: says(Side::East) & says(Side::West) >> 1,
            south: says(Side::South) & says(Side::North).unbounded_shr(plan.width as u32),
        }
    }
}

/// The sensors of a plan.
pub(crate) struct Small<'a, D> {
    pub(crate) plan: &'a FloorPlan,
    pub(crate) sensors: &'a mut Sensors<D>,
    /// The cells that read as if nobody had been there.
    pub(crate) dark: u16,
}

impl<D: SensorData> Floor<D> for Small<'_, D> {
    fn sensor(&self, cell: Cell) -> Option<D> {
        let place = self.plan.place(cell)?;
        Some(if self.dark >> place & 1 == 1 { D::default() } else { self.sensors.all[place] })
    }

    fn put(&mut self, cell: Cell, sensor: D) {
        if let Some(place) = self.plan.place(cell) {
            self.sensors.all[place] = sensor;
        }
    }

    fn unpack(&mut self, cell: Cell) -> u16 {
        self.plan.place(cell).map_or(0, |place| {
            let placed = &mut self.sensors.placed[place];
            *placed = placed.saturating_add(1);
            (*placed).into()
        })
    }

    fn is_open(&self, edge: Edge) -> bool {
        !self.plan.has_wall(edge)
    }
}

/// Misses sensors a bounded number of times, and notes the questions that it answers yes.
pub(crate) struct Misses<'a, W: ?Sized> {
    world: &'a mut W,
    count: &'a mut u8,
    most: u8,
    /// How many questions were asked, at most 32.
    pub(crate) asked: u32,
    /// The questions that were answered yes: a bit for each, the first lowest.
    pub(crate) missed: u32,
}

impl<'a, W: ?Sized> Misses<'a, W> {
    /// Nothing was asked of `world`; `count` of `most` sensors are missed.
    pub(crate) const fn new(world: &'a mut W, count: &'a mut u8, most: u8) -> Self {
        Self { world, count, most, asked: 0, missed: 0 }
    }
}

impl<W: Oracle + ?Sized> Oracle for Misses<'_, W> {
    fn pick(&mut self, below: u32) -> u32 {
        self.world.pick(below)
    }

    fn mishap(&mut self) -> bool {
        let is_missed = *self.count < self.most && self.world.flip();
        *self.count += u8::from(is_missed);
        self.missed |= u32::from(is_missed) << self.asked;
        self.asked += 1;
        is_missed
    }
}
