//! The walk that a chain is drawn in and let out along: its own, over the cells of its robots one after the other, and
//! from one of them on to an unexplored cell, by links.

use crate::ground::{Cell, Edge, EdgeMark, Grid, Link, Side, Step, link, steps_to};

/// A walk with the robots on it. Robots are counted from 0, the base.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Walk<const ROBOTS: usize> {
    /// The cells one after the other.
    cells: [[Cell; 2]; ROBOTS],
    /// By link: the place of the cell where it begins, and at last that where the last ends.
    stops: [u16; ROBOTS],
    links: u16,
    /// The robot at the first place: the walk leaves out those behind it.
    first: u16,
    /// The place of the leader.
    leader: u16,
}

impl<const ROBOTS: usize> Walk<ROBOTS> {
    /// No walk.
    pub(super) const NONE: Self =
        Self { cells: [[Cell::new(0, 0); 2]; ROBOTS], stops: [0; ROBOTS], links: 0, first: 0, leader: 0 };

    /// The chain's own walk, from the first robot from which on each is at most two free sides from the next.
    pub(super) fn own(grid: &impl Grid, team: &[Cell]) -> Self {
        let leader = team.len() - 1;
        let mut walk = Self::NONE;
        let is_apart = |&robot: &usize| way(grid, team[robot], team[robot + 1]).is_none();
        let first = (0..leader).rev().find(is_apart).map_or(0, |robot| robot + 1);
        walk.first = first as u16;
        walk.cells.as_flattened_mut()[0] = team[first];
        walk.extend(grid, &team[first..]);
        walk.leader = walk.stops[usize::from(walk.links)];
        walk
    }

    /// The walk by the links between `stops`, on which the leader is in the cell `at`; `None` if it is not on it.
    pub(super) fn between(grid: &impl Grid, stops: &[Cell], at: Cell) -> Option<Self> {
        let mut walk = Self::NONE;
        walk.cells.as_flattened_mut()[0] = *stops.first()?;
        walk.extend(grid, stops);
        let end = walk.stop(walk.links.into());
        walk.leader = walk.cells.as_flattened()[..=end].iter().rposition(|&cell| cell == at)? as u16;
        Some(walk)
    }

    /// This walk up to its stop `stop`, and from there by the links between `stops`.
    pub(super) fn turned_off(&self, grid: &impl Grid, stop: usize, stops: &[Cell]) -> Self {
        let mut walk = Self { links: stop as u16, ..*self };
        walk.extend(grid, stops);
        walk
    }

    /// Adds the links between `stops` at the end.
    fn extend(&mut self, grid: &impl Grid, stops: &[Cell]) {
        for link in stops.windows(2) {
            let Some(way) = way(grid, link[0], link[1]) else { continue };
            let links = usize::from(self.links);
            let mut place = usize::from(self.stops[links]);
            for cell in way.into_iter().flatten() {
                place += 1;
                self.cells.as_flattened_mut()[place] = cell;
            }
            self.links += 1;
            self.stops[links + 1] = place as u16;
        }
    }

    /// The robot at the first place.
    pub(super) fn first(&self) -> usize {
        self.first.into()
    }

    /// The place of the leader.
    pub(super) fn leader(&self) -> usize {
        self.leader.into()
    }

    /// The place of stop `stop`.
    pub(super) fn stop(&self, stop: usize) -> usize {
        self.stops[stop].into()
    }

    /// The cell at `place`.
    pub(super) fn cell(&self, place: usize) -> Cell {
        self.cells.as_flattened()[place]
    }

    /// The leader, which is in the cell `to`, has gone back by one place, or stayed.
    pub(super) fn go_back(&mut self, to: Cell) {
        self.leader -= u16::from(self.cell(self.leader()) != to).min(self.leader);
    }

    /// The leader, which is in the cell `to`, has gone on by one place, or stayed.
    pub(super) fn go_on(&mut self, to: Cell) {
        self.leader += u16::from(self.cell(self.leader()) != to);
    }

    /// The place of each robot on the walk; 0 for the first and those behind it. `None` if one is not on it.
    pub(super) fn places(&self, team: &[Cell], search: Lookup) -> Option<[usize; ROBOTS]> {
        let (leader, cells) = (team.len() - 1, self.cells.as_flattened());
        let mut places = [0; ROBOTS];
        places[leader] = self.leader();
        for robot in (self.first() + 1..leader).rev() {
            let behind = &cells[..=places[robot + 1]];
            let is_there = |&cell: &Cell| cell == team[robot];
            places[robot] = match search {
                Lookup::LastFirst => behind.iter().rposition(is_there),
                Lookup::FirstFirst => behind.iter().position(is_there),
            }?;
        }
        Some(places)
    }

    /// The steps that let the chain out further: the leader goes on by one cell, the others follow one cell behind,
    /// each as far as its stop. `None` if some robot is not on the walk.
    pub(super) fn let_out(&self, team: &[Cell], search: Lookup) -> Option<[Step; ROBOTS]> {
        let places = self.places(team, search)?;
        let leader = team.len() - 1;
        let mut steps = [Step::Stay; ROBOTS];
        let mut ahead = usize::MAX;
        for robot in (self.first() + 1..=leader).rev() {
            let stop = (usize::from(self.links) + robot).saturating_sub(leader);
            let (own, last) = (places[robot], self.stop(stop));
            ahead = own + usize::from(goes_on(own, last, ahead));
            steps[robot] = steps_to(self.cell(ahead), team[robot]).iter().next()?;
        }
        Some(steps)
    }
}

/// Whether a follower goes on along the walk: it is `own` cells along it and stops after `last`, while the robot
/// ahead is planned to be `ahead` cells along it. It follows one cell behind, up to where it stops.
pub const fn goes_on(own: usize, last: usize, ahead: usize) -> bool {
    own < last && own + 2 <= ahead
}

/// Where the place of a robot on a walk is looked for that may visit a cell twice.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Lookup {
    /// From the robot ahead backwards.
    LastFirst,
    /// From the beginning.
    FirstFirst,
}

/// The cells on the way from one robot to the next, over at most two sides that are not known to be walls; the last is
/// `to`, unless both are in one.
fn way(grid: &impl Grid, from: Cell, to: Cell) -> Option<[Option<Cell>; 2]> {
    if from == to {
        return Some([None; 2]);
    }
    match link(grid, from, to) {
        Some(Link::Side) => return Some([Some(to), None]),
        Some(Link::Corner(corner)) => return Some([Some(corner), Some(to)]),
        None => {}
    }
    let is_open = |cell, side| !grid.edge_has(EdgeMark::Wall, Edge::new(cell, side));
    let straight = |&side: &Side| {
        let between = from.beyond(side);
        between.beyond(side) == to && is_open(from, side) && is_open(between, side)
    };
    Side::ALL.into_iter().find(straight).map(|side| [Some(from.beyond(side)), Some(to)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::{Area, TinyGrid};

    #[test]
    fn a_leader_that_is_drawn_in_goes_back_also_where_its_walk_visits_a_cell_twice() {
        let grid =
            TinyGrid::new(Area::new(Cell::new(0, 0), Cell::new(3, 3)).expect("cells")).expect("it fits");
        let team = [(0, 0), (1, 1), (1, 0)].map(Cell::from);
        let mut walk = Walk::<3>::own(&grid, &team);
        let places = [3, 2, 2, 1, 0].map(|place| {
            walk.go_back(walk.cell(place));
            walk.leader()
        });
        assert_eq!((places, walk.cell(1)), ([3, 2, 2, 1, 0], walk.cell(3)));
        for place in [1, 1, 2, 3] {
            walk.go_on(walk.cell(place));
            assert_eq!(walk.leader(), place);
        }
    }

    #[test]
    fn the_first_robot_is_at_the_first_place_also_where_the_walk_comes_back_to_its_cell() {
        let grid =
            TinyGrid::new(Area::new(Cell::new(0, 0), Cell::new(3, 3)).expect("cells")).expect("it fits");
        let base = Cell::new(1, 0);
        let mut walk = Walk::<4>::own(&grid, &[base, Cell::new(0, 0), base, Cell::new(1, 1)]);
        walk.go_back(base);
        assert_eq!(walk.places(&[base; 4], Lookup::LastFirst), Some([0, 2, 2, 2]));
        assert_eq!(walk.places(&[base; 4], Lookup::FirstFirst), Some([0, 0, 0, 2]));
    }
}
