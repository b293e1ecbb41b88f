//! A crew of agents on a floor, whatever their scheme: one trait says what an agent remembers, decides and writes, and
//! another one what a sensor stores for it. Searches over the states of small floors, hunts and runs on layouts are all
//! of such a crew; they differ in the floor, and in whoever answers which sensors are missed.

use std::fmt;
use std::hash::Hash;

use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Claim, Floor, Mark, Scan, Sensor, settle};
use tautline_kernel::ground::{Cell, Side, Step, Steps};

/// The memory of a sensor, as agents of some schemes read and write it.
pub trait SensorData: Copy + Default + Eq + Hash + fmt::Debug + Send + Sync + 'static {
    /// One look at the sensors around an agent.
    type View;

    /// Whether a sensor can store a side.
    const STORES_SIDES: bool = false;

    /// The crossings from which on an agent only asks which of two sensors counts fewer.
    const ALIKE_FROM: u32 = 0;

    /// Puts agents into the cells where they start.
    fn settle(floor: &mut impl Floor<Self>, starts: &[Cell]);

    /// A look from `cell`; `world` says which sensors are missed.
    fn look(floor: &impl Floor<Self>, cell: Cell, world: &mut (impl Oracle + ?Sized)) -> Self::View;

    /// The marks that were seen.
    fn scan(view: &Self::View) -> &Scan;

    /// The state of the cell.
    fn mark(&self) -> Mark;

    /// How many times an agent has entered the cell.
    fn crossings(&self) -> u32;

    /// The sensor that counts so many crossings, or as many of them as it can store.
    fn with_crossings(self, crossings: u32) -> Self;

    /// The sensor without its identifier.
    fn without_serial(self) -> Self {
        self
    }

    /// The claim on the cell, if there is one.
    fn claim(&self) -> Option<Claim> {
        None
    }

    /// The sides that the sensor says are shut.
    fn shut(&self) -> Steps {
        Steps::NONE
    }

    /// The side that the sensor stores: 1 stands by that of a parent, 2 by one that leads to what was left.
    fn side(&self) -> Option<(Side, u8)> {
        None
    }
}

/// The look of an agent of this scheme.
pub type View<S> = <<S as Scheme>::Sensor as SensorData>::View;

/// Whether sensors are missed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sight {
    /// None is.
    Whole,
    /// Some may be.
    Partial,
}

/// A scheme of agents on a floor: its rule, and what a search or a run has to know of it.
pub trait Scheme: Copy + PartialEq + fmt::Debug + Send + Sync + 'static {
    /// The memory of a sensor.
    type Sensor: SensorData;
    /// The memory of an agent, from one action to the next.
    type Memory: Copy + Eq + Hash + fmt::Debug + Send + Sync + 'static;
    /// The decision of an agent, before it is carried out.
    type Act: Copy + Eq + Hash + fmt::Debug + Send + Sync + 'static;

    /// The memory of the agent with this id at the start.
    fn memory(&self, id: u8) -> Self::Memory;

    /// The decision of an agent that has seen `view`.
    fn decide(&self, memory: &mut Self::Memory, view: &View<Self>) -> Self::Act;

    /// Writes what an agent in `cell` has decided; returns where it is then.
    fn carry_out(&self, floor: &mut impl Floor<Self::Sensor>, cell: Cell, act: &Self::Act) -> Cell;

    /// The step that an agent makes; `None` if it takes itself for done.
    fn step(act: &Self::Act) -> Option<Step>;

    /// Whether an agent ever reads the serial number of a sensor.
    fn reads_serials(&self, _: Sight) -> bool {
        false
    }

    /// Whether an agent ever reads how many times a cell was entered. One that does not does as it did where all else
    /// is as it was.
    fn reads_crossings(&self, _: Sight) -> bool {
        true
    }

    /// Whether an agent ever enters a cell with this mark.
    fn passes(&self, mark: Mark) -> bool {
        mark != Mark::Sealed
    }

    /// Whether agents may still have to go through a cell with this mark.
    fn is_left(&self, mark: Mark) -> bool {
        self.passes(mark)
    }

    /// Whether agents may go on for ever although nothing is left to explore, since sensors are missed by chance.
    fn may_roam(&self, _: Sight) -> bool {
        false
    }

    /// Whether the clauses promise that in the end every cell is visited.
    fn promises(&self, _: Sight) -> bool {
        false
    }
}

/// An agent on a floor.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Body<M, A> {
    /// The memory of the agent.
    pub memory: M,
    /// The cell that it is in.
    pub cell: Cell,
    /// Whether it takes itself for done.
    pub is_done: bool,
    /// Whether it acts no more, although it is not done.
    pub has_failed: bool,
    /// The cells that it has entered, where they are counted.
    pub moves: u8,
    /// Its decision, if it has yet to carry that out.
    pub pending: Option<A>,
}

/// An agent of this scheme.
pub type BodyOf<S> = Body<<S as Scheme>::Memory, <S as Scheme>::Act>;

impl<M, A> Body<M, A> {
    /// The agents of `scheme` in the cells where they start; their ids are their places.
    pub fn crew<S: Scheme<Memory = M, Act = A>>(scheme: &S, starts: &[Cell]) -> Vec<Self> {
        let body = |(id, &cell)| Self {
            memory: scheme.memory(id),
            cell,
            is_done: false,
            has_failed: false,
            moves: 0,
            pending: None,
        };
        (0..=u8::MAX).zip(starts).map(body).collect()
    }

    /// Whether it has something left to do.
    pub const fn is_awake(&self) -> bool {
        !self.is_done && !self.has_failed
    }

    /// Carries `act` out; returns the step that the agent makes.
    pub fn carry_out<S: Scheme<Memory = M, Act = A>>(
        &mut self,
        scheme: &S,
        floor: &mut impl Floor<S::Sensor>,
        act: &A,
    ) -> Step {
        self.cell = scheme.carry_out(floor, self.cell, act);
        let step = S::step(act);
        self.is_done = step.is_none();
        step.unwrap_or(Step::Stay)
    }
}

/// The cells of the sensors that an agent in `cell` has missed, which has seen `view` of this floor.
pub fn unseen<D: SensorData>(
    floor: &impl Floor<D>,
    view: &D::View,
    cell: Cell,
) -> impl Iterator<Item = Cell> {
    let mark = |cell| floor.sensor(cell).map_or(Mark::Unexplored, |sensor| sensor.mark());
    D::scan(view).misread(mark, cell)
}

impl SensorData for Sensor {
    type View = Scan;

    fn settle(floor: &mut impl Floor, starts: &[Cell]) {
        settle(floor, starts);
    }

    fn look(floor: &impl Floor, cell: Cell, world: &mut (impl Oracle + ?Sized)) -> Scan {
        Scan::new(floor, cell, world)
    }

    fn scan(view: &Scan) -> &Scan {
        view
    }

    fn mark(&self) -> Mark {
        self.mark
    }

    fn crossings(&self) -> u32 {
        self.crossings
    }

    fn with_crossings(self, crossings: u32) -> Self {
        Self { crossings, ..self }
    }

    fn without_serial(self) -> Self {
        Self { serial: 0, ..self }
    }

    fn claim(&self) -> Option<Claim> {
        self.claim
    }

    fn shut(&self) -> Steps {
        self.shut
    }
}
