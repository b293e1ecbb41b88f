//! FRONTIER-1 to FRONTIER-5.

use std::collections::{BTreeMap, BTreeSet};

use super::{BrokenClause, Floor, Place, SIDES, add, broken};

/// A run of robots that explore cells, as far as it is heard.
pub(crate) struct Frontier<'a> {
    floor: &'a Floor,
    starts: Vec<Place>,
    cells: Vec<Place>,
    /// The cells that a robot was in.
    entered: BTreeSet<Place>,
    /// By robot: the cells that it takes for explored (false) or for an obstacle (true).
    known: Vec<BTreeMap<Place, bool>>,
}

impl<'a> Frontier<'a> {
    pub(crate) fn new(floor: &'a Floor, starts: &[Place]) -> Self {
        Self {
            floor,
            starts: starts.to_vec(),
            cells: starts.to_vec(),
            entered: starts.iter().copied().collect(),
            known: vec![BTreeMap::new(); starts.len()],
        }
    }

    /// Hears where all are after a team move, and what each has come to take for an obstacle, or for explored.
    pub(crate) fn hear(
        &mut self,
        after: &[Place],
        news: impl IntoIterator<Item = (usize, Place, bool)>,
    ) -> Result<(), BrokenClause> {
        broken(self.floor.leaps(&self.cells, after).is_some(), "FRONTIER-2", || "a robot leaps".to_owned())?;
        for (robot, &to) in after.iter().enumerate() {
            // Whoever enters a cell may be there before another one has left it.
            let is_met = |other: usize| {
                other != robot && (after[other] == to || to != self.cells[robot] && self.cells[other] == to)
            };
            broken((0..after.len()).any(is_met), "FRONTIER-2", || format!("two robots in {to:?}"))?;
        }
        self.entered.extend(after);
        self.cells = after.to_vec();
        for (robot, place, is_obstacle) in news {
            let is_so =
                if is_obstacle { self.floor.blocked.contains(&place) } else { self.entered.contains(&place) };
            broken(!is_so, "FRONTIER-5", || format!("robot {robot} is wrong about {place:?}"))?;
            self.known[robot].insert(place, is_obstacle);
        }
        Ok(())
    }

    /// Hears that the run is over, by itself or not.
    pub(crate) fn end(&self, by_itself: bool) -> Result<(), BrokenClause> {
        broken(!by_itself, "FRONTIER-3", || "the run goes on".to_owned())?;
        let left = self.floor.walkable(&self.starts).into_iter().find(|cell| !self.entered.contains(cell));
        broken(left.is_some(), "FRONTIER-1", || format!("{left:?} is left out"))?;
        let ignorant = (0..self.cells.len()).find(|&robot| self.has_more(robot));
        broken(ignorant.is_some(), "FRONTIER-4", || format!("robot {ignorant:?} does not know it"))
    }

    /// Whether a robot must think that it could go to an unexplored cell.
    fn has_more(&self, robot: usize) -> bool {
        let known = &self.known[robot];
        let (mut reached, mut rim) = (BTreeSet::from([self.cells[robot]]), vec![self.cells[robot]]);
        while let Some(cell) = rim.pop() {
            for next in SIDES.map(|side| add(cell, side)).into_iter().filter(|&next| self.floor.has(next)) {
                match known.get(&next) {
                    None => return true,
                    Some(false) if reached.insert(next) => rim.push(next),
                    Some(_) => {}
                }
            }
        }
        false
    }
}
