//! A sensor floor over a layout: what every sensor stores, the open sides of every cell, and a tally of each part of
//! the layout in which agents start. Nothing is asked of the layout once the floor stands.

use std::mem;

use tautline_kernel::bricks::tree::{Note, Notes, State};
use tautline_kernel::floor::{Claim, Floor, Mark, Sensor};
use tautline_kernel::ground::{Cell, Edge, Side};

use super::scene::{Ink, Layer, Place as Shown, Scene, Shape, Value};
use crate::layout::{Layout, Size};

/// The cells that are connected with a start, and what has become of them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Component {
    /// Agents that start in it.
    pub robots: u16,
    /// Those of them that are not done.
    pub active: u16,
    /// Its cells.
    pub cells: u32,
    /// Those of them that are not unexplored.
    pub explored: u32,
    /// Those of them that are visited, sealed or not.
    pub visited: u32,
}

/// Whether `mark` says that agents need not go through the cell again.
pub const fn is_visited(mark: Mark) -> bool {
    match mark {
        Mark::Unexplored | Mark::Explored | Mark::Closing => false,
        Mark::Visited | Mark::Sealed => true,
    }
}

/// The places among the layers.
const MARKS_LAYER: usize = 0;
const SIDES_LAYER: usize = 1;

/// What a page shows of a sensor floor: the marks, and the sides that sensors store.
pub(super) fn layers<S: Stored>() -> Vec<Layer> {
    const MARKS: &[Value] = &[
        Value { name: "entered by nobody any more", ink: Ink::Closing },
        Value { name: "visited", ink: Ink::Closed },
        Value { name: "sealed", ink: Ink::Sealed },
    ];
    let about = "what the sensors say of cells that are done with".to_owned();
    let mut layers = vec![Layer { name: "marks", about, shape: Shape::Cells(MARKS) }];
    if !S::SIDES.is_empty() {
        let about = "the side that a sensor stores: of an open cell its parent's, of a visited one the way to what was left";
        layers.push(Layer { name: "trees", about: about.to_owned(), shape: Shape::Sides(S::SIDES) });
    }
    layers
}

/// The marks and the stored sides that have changed.
pub(super) fn show<S: Stored>(floor: &SensorFloor<S>, scene: &mut Scene) {
    for &(cell, mark) in &floor.marked {
        let value = match mark {
            Mark::Unexplored | Mark::Explored => 0,
            Mark::Closing => 1,
            Mark::Visited => 2,
            Mark::Sealed => 3,
        };
        scene.put(MARKS_LAYER, Shown::Cell(cell), value);
    }
    for &cell in &floor.turned {
        for side in Side::ALL {
            // A side can be stored on either side of it. That of a tree is shown then.
            let of = |cell, side| {
                floor.place(cell).and_then(|place| place.sensor.side()).filter(|&(at, _)| at == side)
            };
            let stored = [of(cell, side), of(cell.beyond(side), side.opposite())].into_iter().flatten();
            let value = stored.map(|(_, value)| value).min().unwrap_or(0);
            scene.put(SIDES_LAYER, Shown::Side(Edge::new(cell, side)), value);
        }
    }
}

/// What a sensor stores, whatever that is.
pub trait Stored: Copy + Default + PartialEq {
    /// The state of its cell.
    fn mark(&self) -> Mark;

    /// What a side that it stores can be.
    const SIDES: &'static [Value] = &[];

    /// The side that it stores, and which of [`Self::SIDES`] that is, counted from 1.
    fn side(&self) -> Option<(Side, u8)> {
        None
    }
}

impl Stored for Sensor {
    fn mark(&self) -> Mark {
        self.mark
    }
}

impl Stored for Note {
    const SIDES: &'static [Value] = &[
        Value { name: "from a child to its parent", ink: Ink::Open },
        Value { name: "to what was left", ink: Ink::Aim },
    ];

    fn mark(&self) -> Mark {
        Self::mark(*self)
    }

    fn side(&self) -> Option<(Side, u8)> {
        let value = match self.state {
            State::Unexplored | State::Explored => return None,
            State::Open => 1,
            State::Visited => 2,
        };
        Some((self.side?, value))
    }
}

/// The number of a component, counted from 1; 0 stands for the cells that no agent can get to.
type Number = u8;

/// A cell, or the rim outside the cells.
#[derive(Clone, Copy, Default)]
struct Place<S> {
    sensor: S,
    /// How many sensors were placed here.
    placed: u16,
    /// One bit for each open side, and `FREE`.
    open: u8,
    component: Number,
}

impl<S> Place<S> {
    const FREE: u8 = 1 << 4;

    const fn is_free(&self) -> bool {
        self.open & Self::FREE != 0
    }
}

/// The floor of a layout.
#[derive(Clone)]
pub struct SensorFloor<S = Sensor> {
    size: Size,
    /// Row by row, with a rim of one cell all round.
    places: Vec<Place<S>>,
    components: Vec<Component>,
    /// By place, in order.
    claims: Vec<(usize, Claim)>,
    /// Marks and shut sides that have changed since the start.
    gains: u64,
    marked: Vec<(Cell, Mark)>,
    /// The cells whose sensors store another side, or none any more, since changes were last forgotten.
    turned: Vec<Cell>,
}

impl<S: Stored> SensorFloor<S> {
    /// The floor of `layout` for agents that start in `starts`, which are free; there are at most 255.
    pub(super) fn new(layout: &Layout, starts: &[Cell]) -> Self {
        let size = layout.size();
        let rim = (size.width() as usize + 2) * (size.height() as usize + 2);
        let mut floor = Self {
            size,
            places: vec![Place::default(); rim],
            components: Vec::new(),
            claims: Vec::new(),
            gains: 0,
            marked: Vec::new(),
            turned: Vec::new(),
        };
        for cell in layout.cells().filter(|&cell| layout.is_free(cell)) {
            let sides = Side::ALL.into_iter().filter(|&side| layout.is_open(Edge::new(cell, side)));
            let index = floor.index(cell);
            floor.places[index].open = sides.fold(Place::<S>::FREE, |open, side| open | 1 << side as u8);
        }
        for &start in starts {
            let number = floor.number(start);
            let component = &mut floor.components[usize::from(number) - 1];
            component.robots += 1;
            component.active += 1;
        }
        floor
    }

    /// The number of the component of `start`, which may be new.
    fn number(&mut self, start: Cell) -> Number {
        let index = self.index(start);
        let known = self.places[index].component;
        if known != 0 {
            return known;
        }
        let number = self.components.len() as Number + 1;
        self.places[index].component = number;
        let (mut cells, mut left) = (1, vec![start]);
        while let Some(cell) = left.pop() {
            for side in Side::ALL {
                if !self.has_open(cell, side) {
                    continue;
                }
                let next = cell.beyond(side);
                let index = self.index(next);
                if mem::replace(&mut self.places[index].component, number) == 0 {
                    cells += 1;
                    left.push(next);
                }
            }
        }
        self.components.push(Component { cells, ..Component::default() });
        number
    }

    /// Where `cell`, which is at most one outside the layout, is kept.
    const fn index(&self, cell: Cell) -> usize {
        let stride = self.size.width() as usize + 2;
        (cell.y + 1) as usize * stride + (cell.x + 1) as usize
    }

    fn place(&self, cell: Cell) -> Option<&Place<S>> {
        self.places.get(self.index(cell))
    }

    /// Whether an agent can leave `cell` through `side`.
    pub fn has_open(&self, cell: Cell, side: Side) -> bool {
        self.place(cell).is_some_and(|place| place.open & 1 << side as u8 != 0)
    }

    /// The mark of `cell`; unexplored where there is no sensor.
    pub fn mark(&self, cell: Cell) -> Mark {
        self.place(cell).map_or(Mark::Unexplored, |place| place.sensor.mark())
    }

    /// The parts of the layout in which agents start, in the order of the first agent of each.
    pub fn components(&self) -> &[Component] {
        &self.components
    }

    /// The place in [`SensorFloor::components`] of that of `cell`, if agents can get there.
    pub fn component(&self, cell: Cell) -> Option<usize> {
        self.place(cell).and_then(|place| usize::from(place.component).checked_sub(1))
    }

    /// The agent in `cell` is done; whether it is too early for that: a cell of its component is unexplored.
    pub(super) fn retire(&mut self, cell: Cell) -> bool {
        let component = self.component(cell).and_then(|place| self.components.get_mut(place));
        component.is_some_and(|component| {
            component.active -= 1;
            component.explored < component.cells
        })
    }

    /// Marks and shut sides that have changed since the start.
    pub(super) const fn gains(&self) -> u64 {
        self.gains
    }

    /// The claims on cells, in order.
    pub(super) fn claims(&self) -> &[(usize, Claim)] {
        &self.claims
    }

    /// The marks that have changed since changes were last forgotten, in order.
    pub(super) fn marked(&self) -> &[(Cell, Mark)] {
        &self.marked
    }

    pub(super) fn forget_changes(&mut self) {
        self.marked.clear();
        self.turned.clear();
    }

    fn count(&mut self, cell: Cell, component: Number, was: Mark, is: Mark) {
        self.marked.push((cell, is));
        if let Some(component) = self.components.get_mut(usize::from(component).wrapping_sub(1)) {
            component.explored += u32::from(was == Mark::Unexplored);
            component.visited += u32::from(is_visited(is));
            component.visited -= u32::from(is_visited(was));
        }
    }
}

impl SensorFloor {
    fn claim(&mut self, index: usize, claim: Option<Claim>) {
        let at = self.claims.binary_search_by_key(&index, |&(index, _)| index);
        match (at, claim) {
            (Ok(at), Some(claim)) => self.claims[at].1 = claim,
            (Ok(at), None) => {
                self.claims.remove(at);
            }
            (Err(at), Some(claim)) => self.claims.insert(at, (index, claim)),
            (Err(_), None) => {}
        }
    }
}

impl Floor for SensorFloor {
    #[inline]
    fn sensor(&self, cell: Cell) -> Option<Sensor> {
        self.place(cell).filter(|place| place.is_free()).map(|place| place.sensor)
    }

    #[inline]
    fn put(&mut self, cell: Cell, sensor: Sensor) {
        let index = self.index(cell);
        let Some(place) = self.places.get_mut(index).filter(|place| place.is_free()) else { return };
        let component = place.component;
        let was = mem::replace(&mut place.sensor, sensor);
        if (was.mark, was.shut) != (sensor.mark, sensor.shut) {
            self.gains += 1;
        }
        if was.mark != sensor.mark {
            self.count(cell, component, was.mark, sensor.mark);
        }
        if was.claim != sensor.claim {
            self.claim(index, sensor.claim);
        }
    }

    fn unpack(&mut self, cell: Cell) -> u16 {
        let index = self.index(cell);
        self.places.get_mut(index).map_or(0, |place| {
            // More sensors in one cell than there are numbers: the first ones are long gone.
            place.placed = place.placed.checked_add(1).unwrap_or(1);
            place.placed
        })
    }

    #[inline]
    fn is_open(&self, edge: Edge) -> bool {
        self.has_open(edge.cell(), edge.side())
    }
}

impl Notes for SensorFloor<Note> {
    #[inline]
    fn note(&self, cell: Cell) -> Option<Note> {
        self.place(cell).filter(|place| place.is_free()).map(|place| place.sensor)
    }

    #[inline]
    fn write(&mut self, cell: Cell, note: Note) {
        let index = self.index(cell);
        let Some(place) = self.places.get_mut(index).filter(|place| place.is_free()) else { return };
        let component = place.component;
        let was = mem::replace(&mut place.sensor, note);
        if Stored::side(&was) != Stored::side(&note) {
            self.turned.push(cell);
        }
        if was.mark() != note.mark() {
            self.count(cell, component, was.mark(), note.mark());
        }
    }

    #[inline]
    fn is_open(&self, edge: Edge) -> bool {
        self.has_open(edge.cell(), edge.side())
    }
}
