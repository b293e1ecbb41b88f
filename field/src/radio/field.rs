//! A field: an area in metres, obstacles that no signal passes, and nodes. Obstacles are closed rectangles along the
//! axes, in metres: they are the paper's lakes and hills, one without width or height is a wall, so that the walls of a
//! layout are obstacles, too, and whether a link meets one is decided by products and signs alone.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::NodeId;

use super::problem::{MAX_NODES, MAX_SIDE_M, Problem};

/// A place, in metres, `x_m` eastwards and `y_m` southwards from the north-western corner.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Point {
    /// Metres eastwards.
    pub x_m: f64,
    /// Metres southwards.
    pub y_m: f64,
}

/// The sides of an area.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Area {
    width_m: f64,
    height_m: f64,
}

impl Area {
    /// An area of `width_m` by `height_m`.
    ///
    /// # Errors
    /// [`Problem::Side`] if a side is not a positive number, or above a million metres.
    pub fn new(width_m: f64, height_m: f64) -> Result<Self, Problem> {
        let is_side = |side: f64| side > 0.0 && side <= MAX_SIDE_M;
        match [width_m, height_m].into_iter().find(|&side| !is_side(side)) {
            Some(side_m) => Err(Problem::Side { side_m }),
            None => Ok(Self { width_m, height_m }),
        }
    }

    /// From west to east, in metres.
    pub const fn width_m(self) -> f64 {
        self.width_m
    }

    /// From north to south, in metres.
    pub const fn height_m(self) -> f64 {
        self.height_m
    }

    /// Whether a point is in it, the rim included. What is no number is nowhere.
    pub fn contains(self, point: Point) -> bool {
        (0.0..=self.width_m).contains(&point.x_m) && (0.0..=self.height_m).contains(&point.y_m)
    }
}

/// A closed rectangle that stops every link, in metres. It may be a line.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Obstacle {
    /// Its western side.
    pub west_m: f64,
    /// Its northern side.
    pub north_m: f64,
    /// Its eastern side.
    pub east_m: f64,
    /// Its southern side.
    pub south_m: f64,
}

impl From<[f64; 4]> for Obstacle {
    /// West, north, east and south.
    fn from([west_m, north_m, east_m, south_m]: [f64; 4]) -> Self {
        Self { west_m, north_m, east_m, south_m }
    }
}

impl From<Obstacle> for [f64; 4] {
    /// West, north, east and south.
    fn from(obstacle: Obstacle) -> Self {
        let Obstacle { west_m, north_m, east_m, south_m } = obstacle;
        [west_m, north_m, east_m, south_m]
    }
}

impl Obstacle {
    fn is_rectangle(&self) -> bool {
        let Self { west_m, north_m, east_m, south_m } = *self;
        let is_finite = [west_m, north_m, east_m, south_m].into_iter().all(f64::is_finite);
        is_finite && west_m <= east_m && north_m <= south_m
    }

    /// Whether a point is in it, its sides included.
    pub fn contains(&self, point: Point) -> bool {
        (self.west_m..=self.east_m).contains(&point.x_m) && (self.north_m..=self.south_m).contains(&point.y_m)
    }

    /// Whether it meets the straight way between two points: neither a column, nor a row, nor the way itself has all of
    /// it on one side.
    pub fn stops(&self, one: Point, other: Point) -> bool {
        let Self { west_m, north_m, east_m, south_m } = *self;
        let is_beside = one.x_m.max(other.x_m) < west_m
            || one.x_m.min(other.x_m) > east_m
            || one.y_m.max(other.y_m) < north_m
            || one.y_m.min(other.y_m) > south_m;
        if is_beside {
            return false;
        }
        let (along_x, along_y) = (other.x_m - one.x_m, other.y_m - one.y_m);
        let corners = [(west_m, north_m), (east_m, north_m), (west_m, south_m), (east_m, south_m)];
        let side = |(x, y): (f64, f64)| along_x * (y - one.y_m) - along_y * (x - one.x_m);
        !(corners.into_iter().all(|corner| side(corner) > 0.0)
            || corners.into_iter().all(|corner| side(corner) < 0.0))
    }
}

/// Nodes in an area with obstacles.
#[derive(Clone, PartialEq, Debug)]
pub struct Field {
    area: Area,
    obstacles: Vec<Obstacle>,
    nodes: Vec<Point>,
}

/// Places that are drawn in vain for one node before there is taken to be no room.
const TRIES: u32 = 10_000;

impl Field {
    /// Nodes at given places; node 0 is the first.
    ///
    /// # Errors
    /// A [`Problem`] if there are fewer than two nodes or more than [`MAX_NODES`], one is not inside the area or in an
    /// obstacle, or an obstacle is no rectangle.
    pub fn new(area: Area, obstacles: Vec<Obstacle>, nodes: Vec<Point>) -> Result<Self, Problem> {
        check(&obstacles, nodes.len())?;
        for (node, &point) in nodes.iter().enumerate() {
            if !area.contains(point) {
                return Err(Problem::Outside { node, x_m: point.x_m, y_m: point.y_m });
            }
            if obstacles.iter().any(|obstacle| obstacle.contains(point)) {
                return Err(Problem::Blocked { node });
            }
        }
        Ok(Self { area, obstacles, nodes })
    }

    /// `count` nodes at random places outside the obstacles, each independent of the others. They are numbered strip by
    /// strip, so that neighbours have near numbers, which is kind to caches.
    ///
    /// # Errors
    /// A [`Problem`] if there are too few nodes or too many, an obstacle is no rectangle, or the obstacles leave no
    /// room.
    pub fn random(
        area: Area,
        obstacles: Vec<Obstacle>,
        count: usize,
        oracle: &mut dyn Oracle,
    ) -> Result<Self, Problem> {
        check(&obstacles, count)?;
        let places = (0..count).map(|_| random_place(area, &obstacles, oracle));
        let mut nodes = places.collect::<Result<Vec<Point>, Problem>>()?;
        let strip_m = STRIP_NODES * (area.width_m * area.height_m / f64::from(count as u32)).sqrt();
        let strip = |point: &Point| (point.y_m / strip_m) as u64;
        nodes.sort_by(|one, other| strip(one).cmp(&strip(other)).then(one.x_m.total_cmp(&other.x_m)));
        Ok(Self { area, obstacles, nodes })
    }

    /// This field with more nodes after its own.
    ///
    /// # Errors
    /// As [`Field::new`].
    pub fn with(&self, more: &[Point]) -> Result<Self, Problem> {
        Self::new(self.area, self.obstacles.clone(), [&self.nodes, more].concat())
    }

    /// A random place outside the obstacles.
    ///
    /// # Errors
    /// [`Problem::NoRoom`] if the obstacles leave none.
    pub fn place(&self, oracle: &mut dyn Oracle) -> Result<Point, Problem> {
        random_place(self.area, &self.obstacles, oracle)
    }

    /// Whether the straight way between two points meets no obstacle.
    #[inline]
    pub fn has_way(&self, one: Point, other: Point) -> bool {
        !self.obstacles.iter().any(|obstacle| obstacle.stops(one, other))
    }

    /// The area.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// The obstacles that stop links.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// Where a node is.
    #[inline]
    pub(crate) fn at(&self, node: NodeId) -> Point {
        self.nodes[node.0 as usize]
    }

    /// Where the nodes are.
    pub fn nodes(&self) -> &[Point] {
        &self.nodes
    }
}

fn random_place(area: Area, obstacles: &[Obstacle], oracle: &mut dyn Oracle) -> Result<Point, Problem> {
    let mut coordinate = |side: f64| side * (f64::from(oracle.pick(u32::MAX)) / f64::from(u32::MAX - 1));
    (0..TRIES)
        .map(|_| Point { x_m: coordinate(area.width_m), y_m: coordinate(area.height_m) })
        .find(|&point| !obstacles.iter().any(|obstacle| obstacle.contains(point)))
        .ok_or(Problem::NoRoom)
}

/// Nodes across a strip, about.
const STRIP_NODES: f64 = 4.0;

fn check(obstacles: &[Obstacle], nodes: usize) -> Result<(), Problem> {
    if !(2..=MAX_NODES).contains(&nodes) {
        return Err(Problem::Nodes { nodes });
    }
    obstacles
        .iter()
        .position(|obstacle| !obstacle.is_rectangle())
        .map_or(Ok(()), |obstacle| Err(Problem::Obstacle { obstacle }))
}

#[cfg(test)]
mod tests {
    use tautline_proofs::engine::{SeededOracle, Tape};

    use super::*;

    const LAKE: Obstacle = Obstacle { west_m: 2.0, north_m: 1.0, east_m: 4.0, south_m: 3.0 };

    fn at(x_m: f64, y_m: f64) -> Point {
        Point { x_m, y_m }
    }

    fn area() -> Area {
        Area::new(10.0, 5.0).expect("an area")
    }

    #[test]
    fn a_link_is_stopped_by_what_it_meets() {
        for (one, other, stops) in [
            (at(0.0, 2.0), at(5.0, 2.0), true),
            (at(0.0, 0.0), at(5.0, 0.5), false),
            (at(0.0, 3.0), at(4.0, 0.0), true),
            (at(0.0, 2.0), at(2.0, 0.0), false),
            (at(1.0, 0.0), at(5.0, 4.0), true),
            (at(1.0, 2.0), at(3.0, 4.0), true),
            (at(1.0, 2.1), at(3.0, 4.1), false),
            (at(2.5, 1.5), at(3.5, 2.5), true),
        ] {
            assert_eq!((LAKE.stops(one, other), LAKE.stops(other, one)), (stops, stops), "{one:?} {other:?}");
        }
        let wall = Obstacle { west_m: 3.0, north_m: 0.0, east_m: 3.0, south_m: 2.0 };
        assert!(wall.stops(at(2.0, 1.0), at(4.0, 1.0)));
        assert!(!wall.stops(at(2.0, 3.0), at(4.0, 3.0)));
    }

    #[test]
    fn random_nodes_are_outside_obstacles_and_the_same_for_the_same_answers() {
        let draw = || Field::random(area(), vec![LAKE], 500, &mut SeededOracle::new(3, 4)).expect("a field");
        assert_eq!(draw(), draw());
        let field = draw();
        assert_eq!(Field::new(area(), vec![LAKE], field.nodes().to_vec()), Ok(field));
    }

    #[test]
    fn what_is_no_field_is_refused() {
        let lake = vec![LAKE];
        let new = |nodes: &[Point]| Field::new(area(), lake.clone(), nodes.to_vec()).map(|_| ());
        let fine = at(1.0, 1.0);
        assert_eq!(new(&[]), Err(Problem::Nodes { nodes: 0 }));
        assert_eq!(new(&[fine]), Err(Problem::Nodes { nodes: 1 }));
        assert_eq!(new(&[fine, at(10.1, 1.0)]), Err(Problem::Outside { node: 1, x_m: 10.1, y_m: 1.0 }));
        assert!(matches!(new(&[at(1.0, f64::NAN), fine]), Err(Problem::Outside { node: 0, .. })));
        assert_eq!(new(&[fine, at(2.0, 3.0)]), Err(Problem::Blocked { node: 1 }));
        let mut oracle = Tape(&[]);
        let mut random = |obstacles, count| Field::random(area(), obstacles, count, &mut oracle).map(|_| ());
        assert_eq!(random(vec![], MAX_NODES + 1), Err(Problem::Nodes { nodes: MAX_NODES + 1 }));
        let everything = Obstacle { west_m: 0.0, north_m: 0.0, east_m: 10.0, south_m: 5.0 };
        assert_eq!(random(vec![everything], 2), Err(Problem::NoRoom));
        let turned = Obstacle { west_m: 3.0, ..everything };
        assert_eq!(
            random(vec![LAKE, Obstacle { east_m: 2.0, ..turned }], 2),
            Err(Problem::Obstacle { obstacle: 1 })
        );
        for side_m in [0.0, -1.0, f64::INFINITY, 1e6 + 1.0] {
            assert_eq!(Area::new(side_m, 1.0), Err(Problem::Side { side_m }));
        }
        assert!(Area::new(1.0, f64::NAN).is_err());
    }
}
