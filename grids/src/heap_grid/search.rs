//! Searches that learn: lower bounds of the distances to the frontier, and the walks by links.

use tautline_kernel::ground::EdgeMark;

use super::map::{EXPLORED, Map, Marks, UNREACHED, all_sides};

/// The knowledge of a cell's distance to the nearest unexplored cell.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Bound {
    /// It is not less than this many steps; `UNREACHED` if there is no path.
    pub(super) steps: u32,
    /// It is just that.
    exact: bool,
    /// It may be above the followers' bound.
    ahead: bool,
}

impl Bound {
    /// Whether no search would find more.
    pub(super) const fn is_exact(self) -> bool {
        self.exact || self.steps == UNREACHED
    }
}

/// Bounds on the distances of all cells, for one choice of what blocks. The bounds of two cells with an open
/// edge between them differ by one at most, so that a search never has to come back to a cell.
#[derive(Clone, Debug)]
pub(super) struct Field {
    /// The marks of edges that block, on all sides.
    pub(super) blocked: Marks,
    pub(super) bounds: Vec<Bound>,
    /// The cells whose bound is exact as long as nothing more is explored or blocked.
    exact: Vec<usize>,
    /// The cells whose bound may be above the followers'.
    ahead: Vec<usize>,
}

impl Field {
    pub(super) fn new(cells: usize, blocking: &[EdgeMark]) -> Self {
        let blocked = blocking.iter().fold(0, |blocked, &mark| blocked | all_sides(mark));
        Self { blocked, bounds: vec![Bound::default(); cells], exact: Vec::new(), ahead: Vec::new() }
    }

    /// Distances may have grown. Where there was no path, there is still none.
    pub(super) fn doubt(&mut self) {
        for place in self.exact.drain(..) {
            self.bounds[place].exact = false;
        }
    }

    /// Distances may have shrunk.
    pub(super) fn forget(&mut self) {
        self.bounds.fill(Bound::default());
        self.exact.clear();
        self.ahead.clear();
    }

    /// The leader's bounds rise to what the `followers` have learned of the cells `reached`.
    pub(super) fn keep_up(&mut self, followers: &Self, reached: &[usize]) {
        for &place in reached {
            let bound = &mut self.bounds[place];
            bound.steps = bound.steps.max(followers.bounds[place].steps);
        }
    }

    /// The leader has learned something by itself of the cells `reached`.
    pub(super) fn get_ahead(&mut self, reached: &[usize]) {
        for &place in reached {
            if !std::mem::replace(&mut self.bounds[place].ahead, true) {
                self.ahead.push(place);
            }
        }
    }

    /// Without virtual obstacles, the leader's distances are the followers'.
    pub(super) fn fall_back(&mut self, followers: &Self) {
        for place in self.ahead.drain(..) {
            self.bounds[place] = Bound { steps: followers.bounds[place].steps, ..Bound::default() };
        }
        self.exact.clear();
    }
}

/// The working space of a search.
#[derive(Clone, Debug)]
pub(super) struct Search {
    /// Steps, or links, from the start to each cell on the shortest path found, or `UNREACHED`.
    pub(super) steps: Vec<u32>,
    /// The cells with a path found.
    pub(super) reached: Vec<usize>,
    /// Cells to look at, by the sum of steps and bound, modulo 3: a neighbour's sum is larger by 2 at most.
    open: [Vec<usize>; 3],
}

impl Search {
    pub(super) fn new(cells: usize) -> Self {
        Self { steps: vec![UNREACHED; cells], reached: Vec::new(), open: Default::default() }
    }

    /// Makes the bound of `from` exact and betters those of the cells on its way, all cells that are reached.
    pub(super) fn run(&mut self, map: &Map, field: &mut Field, from: usize) {
        let mut sum = field.bounds[from].steps;
        self.reach(from, 0, sum);
        let end = loop {
            let Some(later) = (0..3).find(|later| !self.open[(sum + later) as usize % 3].is_empty()) else {
                break None;
            };
            sum += later;
            // The last one put in is the farthest on its way.
            let Some(place) = self.open[sum as usize % 3].pop() else { continue };
            let steps = self.steps[place];
            if steps + field.bounds[place].steps != sum {
                continue; // A shorter path to it was found meanwhile, and followed.
            }
            if map.marks[place] & EXPLORED == 0 || field.bounds[place].is_exact() {
                break Some(place);
            }
            for next in map.neighbours(place, field.blocked) {
                if steps + 1 < self.steps[next] && field.bounds[next].steps != UNREACHED {
                    self.reach(next, steps + 1, steps + 1 + field.bounds[next].steps);
                }
            }
        };
        match end {
            Some(end) => self.learn(map, field, end, sum),
            None => {
                for &place in &self.reached {
                    field.bounds[place].steps = UNREACHED;
                }
            }
        }
    }

    /// Reaches the cells at most `most` links from the one at `start`, up to the nearest unexplored: the place of
    /// the first of these, and how many links away it is. `steps` are links until the next search.
    pub(super) fn link_up(&mut self, map: &Map, start: usize, most: usize) -> Option<(usize, u32)> {
        self.steps[start] = 0;
        self.reached.push(start);
        let mut layer = 0;
        for count in 0..=most as u32 {
            let unexplored = |&&place: &&usize| map.marks[place] & EXPLORED == 0;
            if let Some(&target) = self.reached[layer..].iter().filter(unexplored).min() {
                return Some((target, count));
            }
            let nearer = layer..self.reached.len();
            layer = nearer.end;
            for index in nearer {
                for next in map.linked(self.reached[index]) {
                    if self.steps[next] == UNREACHED {
                        self.steps[next] = count + 1;
                        self.reached.push(next);
                    }
                }
            }
        }
        None
    }

    /// Makes ready for the next search.
    pub(super) fn clear(&mut self) {
        for place in self.reached.drain(..) {
            self.steps[place] = UNREACHED;
        }
        self.open.iter_mut().for_each(Vec::clear);
    }

    fn reach(&mut self, place: usize, steps: u32, sum: u32) {
        if self.steps[place] == UNREACHED {
            self.reached.push(place);
        }
        self.steps[place] = steps;
        self.open[sum as usize % 3].push(place);
    }

    /// From the start it is `distance` steps to the frontier, on a path over the cell at `end`.
    fn learn(&self, map: &Map, field: &mut Field, end: usize, distance: u32) {
        for &place in &self.reached {
            let bound = &mut field.bounds[place];
            bound.steps = bound.steps.max(distance.saturating_sub(self.steps[place]));
        }
        let mut place = end;
        while let Some(fewer) = self.steps[place].checked_sub(1) {
            let mut neighbours = map.neighbours(place, field.blocked);
            let Some(next) = neighbours.find(|&next| self.steps[next] == fewer) else { break };
            field.bounds[next].exact = true;
            field.exact.push(next);
            place = next;
        }
    }
}
