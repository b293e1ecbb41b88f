//! A sensor floor over a layout: what every sensor stores, the open sides of every cell, and a tally of each part of
//! the layout in which agents start. Nothing is asked of the layout once the floor stands.

use std::collections::BTreeMap;
use std::mem;

use tautline_kernel::floor::{Claim, Floor, Mark};
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::floor::crew::SensorData;

use super::scene::{Ink, Layer, Place as Spot, Scene, Shape, Value};
use tautline_grids::layout::{Layout, Size};

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

impl Component {
    /// All of these taken together.
    pub fn whole(parts: &[Self]) -> Self {
        parts.iter().fold(Self::default(), |sum, part| Self {
            robots: sum.robots + part.robots,
            active: sum.active + part.active,
            cells: sum.cells + part.cells,
            explored: sum.explored + part.explored,
            visited: sum.visited + part.visited,
        })
    }
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

/// The layers of a sensor floor on a page: the marks, and the sides that sensors store.
pub(super) fn layers<D: SensorData>() -> Vec<Layer> {
    const SIDES: &[Value] = &[
        Value { name: "from a child to its parent", ink: Ink::Open },
        Value { name: "to what was left", ink: Ink::Aim },
    ];
    const MARKS: &[Value] = &[
        Value { name: "entered by nobody any more", ink: Ink::Closing },
        Value { name: "visited", ink: Ink::Closed },
        Value { name: "sealed", ink: Ink::Sealed },
    ];
    let about = "what the sensors say of cells that are done with";
    let mut layers = vec![Layer::new("marks", about, Shape::Cells(MARKS))];
    if D::STORES_SIDES {
        let about = "the side that a sensor stores: of an open cell its parent's, \
                     of a visited one the way to what was left";
        layers.push(Layer::new("trees", about, Shape::Sides(SIDES)));
    }
    layers
}

/// The marks and the stored sides that have changed.
pub(super) fn show<D: SensorData>(floor: &SensorFloor<D>, scene: &mut Scene) {
    for &(cell, mark) in &floor.marked {
        let value = match mark {
            Mark::Unexplored | Mark::Explored => 0,
            Mark::Closing => 1,
            Mark::Visited => 2,
            Mark::Sealed => 3,
        };
        scene.put(MARKS_LAYER, Spot::Cell(cell), value);
    }
    for &cell in &floor.turned {
        for side in Side::ALL {
            // A side can be stored on either side of it. That of a tree is shown then.
            let of = |cell, side| {
                floor.place(cell).and_then(|place| place.sensor.side()).filter(|&(at, _)| at == side)
            };
            let stored = [of(cell, side), of(cell.beyond(side), side.opposite())].into_iter().flatten();
            let value = stored.map(|(_, value)| value).min().unwrap_or(0);
            scene.put(SIDES_LAYER, Spot::Side(Edge::new(cell, side)), value);
        }
    }
}

/// The number of a component, counted from 1; 0 stands for the cells that no agent can get to.
type Number = u8;

/// A cell, or the rim outside the cells.
#[derive(Clone, Copy, Default)]
struct Place<D> {
    sensor: D,
    /// How many sensors were placed here.
    placed: u16,
    /// One bit for each open side, and `FREE`.
    open: u8,
    component: Number,
}

impl<D> Place<D> {
    const FREE: u8 = 1 << 4;

    const fn is_free(&self) -> bool {
        self.open & Self::FREE != 0
    }
}

/// The floor of a layout.
#[derive(Clone)]
pub(super) struct SensorFloor<D> {
    size: Size,
    /// Row by row, with a rim of one cell all round.
    places: Vec<Place<D>>,
    /// The parts of the layout in which agents start, in the order of the first agent of each.
    pub(super) components: Vec<Component>,
    /// The claims on cells, by place.
    pub(super) claims: BTreeMap<usize, Claim>,
    /// Marks and shut sides that have changed since the start.
    pub(super) gains: u64,
    /// The marks that have changed since changes were last forgotten, in order.
    pub(super) marked: Vec<(Cell, Mark)>,
    /// The cells whose sensors store another side, or none any more, since changes were last forgotten.
    turned: Vec<Cell>,
}

impl<D: SensorData> SensorFloor<D> {
    /// The floor of `layout` for agents that start in `starts`, which are free; there are at most 255.
    pub(super) fn new(layout: &Layout, starts: &[Cell]) -> Self {
        let size = layout.size();
        let rim = (size.width() as usize + 2) * (size.height() as usize + 2);
        let mut floor = Self {
            size,
            places: vec![Place::default(); rim],
            components: Vec::new(),
            claims: BTreeMap::new(),
            gains: 0,
            marked: Vec::new(),
            turned: Vec::new(),
        };
        for cell in layout.cells().filter(|&cell| layout.is_free(cell)) {
            let sides = Side::ALL.into_iter().filter(|&side| layout.is_open(Edge::new(cell, side)));
            let index = floor.index(cell);
            floor.places[index].open = sides.fold(Place::<D>::FREE, |open, side| open | 1 << side as u8);
        }
        for &start in starts {
            let known = floor.component(start);
            let number = known.unwrap_or_else(|| floor.add_component(&layout.reachable(&[start])));
            let component = &mut floor.components[number];
            component.robots += 1;
            component.active += 1;
        }
        floor
    }

    /// The place of a new component of these cells in [`components`](Self::components).
    fn add_component(&mut self, cells: &[Cell]) -> usize {
        let number = self.components.len();
        for &cell in cells {
            let index = self.index(cell);
            self.places[index].component = number as Number + 1;
        }
        self.components.push(Component { cells: cells.len() as u32, ..Component::default() });
        number
    }

    /// Where `cell`, which is at most one outside the layout, is kept.
    const fn index(&self, cell: Cell) -> usize {
        let stride = self.size.width() as usize + 2;
        (cell.y + 1) as usize * stride + (cell.x + 1) as usize
    }

    fn place(&self, cell: Cell) -> Option<&Place<D>> {
        self.places.get(self.index(cell))
    }

    /// The place in [`SensorFloor::components`] of that of `cell`, if agents can get there.
    fn component(&self, cell: Cell) -> Option<usize> {
        self.place(cell).and_then(|place| usize::from(place.component).checked_sub(1))
    }

    /// The agent in `cell` is done; whether it is too early for that: a cell of its component is unexplored, or another
    /// one has a mark by which it `is_left` to go through.
    pub(super) fn retire(&mut self, cell: Cell, is_left: impl Fn(Mark) -> bool) -> bool {
        let Some(number) = self.component(cell) else { return false };
        let here = self.index(cell);
        let component = &mut self.components[number];
        component.active -= 1;
        let is_other_left = |(index, place): (usize, &Place<D>)| {
            index != here && usize::from(place.component) == number + 1 && is_left(place.sensor.mark())
        };
        component.explored < component.cells || self.places.iter().enumerate().any(is_other_left)
    }

    /// Whether agents do here as they did on the floor `then` of the same layout: sensors differ in their crossings
    /// alone, and these have grown alike wherever agents go from one cell to the other, through marks that they pass.
    pub(super) fn is_alike(&self, then: &Self, passes: impl Fn(Mark) -> bool) -> bool {
        let grown = |cell: Cell| {
            let (then, now) = (then.sensor(cell)?, self.sensor(cell)?);
            let grown = now.crossings().checked_sub(then.crossings())?;
            let is_kept = then.with_crossings(0) == now.with_crossings(0);
            (is_kept && (grown == 0 || then.crossings() >= D::ALIKE_FROM)).then_some(grown)
        };
        let ends = |edge: Edge| {
            [(edge.cell(), edge.side()), (edge.cell().beyond(edge.side()), edge.side().opposite())]
        };
        let is_crossed = |edge: &Edge| {
            let sensors = ends(*edge).map(|(cell, side)| (self.sensor(cell).unwrap_or_default(), side));
            let is_shut = sensors.iter().all(|&(sensor, side)| sensor.shut().has(Step::Cross(side)));
            self.is_open(*edge) && !is_shut && sensors.iter().all(|(sensor, _)| passes(sensor.mark()))
        };
        let area = self.size.area();
        area.cells().all(|cell| self.sensor(cell).is_none() || grown(cell).is_some())
            && area.edges().filter(is_crossed).all(|edge| {
                let [(one, _), (other, _)] = ends(edge);
                grown(one) == grown(other)
            })
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

    fn claim(&mut self, index: usize, claim: Option<Claim>) {
        match claim {
            Some(claim) => self.claims.insert(index, claim),
            None => self.claims.remove(&index),
        };
    }
}

impl<D: SensorData> Floor<D> for SensorFloor<D> {
    #[inline]
    fn sensor(&self, cell: Cell) -> Option<D> {
        self.place(cell).filter(|place| place.is_free()).map(|place| place.sensor)
    }

    #[inline]
    fn put(&mut self, cell: Cell, sensor: D) {
        let index = self.index(cell);
        let Some(place) = self.places.get_mut(index).filter(|place| place.is_free()) else { return };
        let component = place.component;
        let was = mem::replace(&mut place.sensor, sensor);
        if (was.mark(), was.shut()) != (sensor.mark(), sensor.shut()) {
            self.gains += 1;
        }
        if was.side() != sensor.side() {
            self.turned.push(cell);
        }
        if was.mark() != sensor.mark() {
            self.count(cell, component, was.mark(), sensor.mark());
        }
        if was.claim() != sensor.claim() {
            self.claim(index, sensor.claim());
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
        self.place(edge.cell()).is_some_and(|place| place.open & 1 << edge.side() as u8 != 0)
    }
}
