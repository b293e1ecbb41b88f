//! How far the nearest unexplored cell is at least: what keeps far waves narrow.
//!
//! The distance from a cell to the nearest unexplored cell that it reaches never falls while the explored cells become
//! more. A way that is new leads through a cell that has become explored since; it was the nearest unexplored one of
//! that way before, and the way goes on from there. So distances that were right once are lower bounds for good, and
//! are computed anew only when waves have looked at so many cells that it pays.

use tautline_kernel::frontier::Status;

use super::chart::Chart;

/// Waves may look at so many times the explored cells before distances are computed anew.
const PATIENCE: usize = 4;

/// Nothing is reached, now and later: no cell beside the explored ones is left.
const CLOSED: u32 = u32::MAX;

/// Lower bounds, by place; 0 until there are any.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    least: Vec<u32>,
    queue: Vec<usize>,
    /// How many cells waves have looked at.
    pub(super) spent: usize,
}

impl Field {
    /// How far the nearest unexplored cell is at least.
    pub(super) fn least(&self, place: usize) -> u32 {
        self.least.get(place).copied().unwrap_or(0)
    }

    /// Whether no unexplored cell is reached from there, now and later.
    pub(super) fn is_closed(&self, place: usize) -> bool {
        self.least(place) == CLOSED
    }

    /// Computes the distances anew if it pays. Where a cell became explored that was taken for an obstacle, distances
    /// may have fallen, and nothing is known of them any more.
    pub(super) fn renew(&mut self, chart: &Chart) {
        if chart.has_erred {
            self.least.clear();
        } else if self.spent > PATIENCE * chart.explored {
            self.spent = 0;
            self.flood(chart);
        }
    }

    /// Floods the explored cells from all unexplored ones at once.
    fn flood(&mut self, chart: &Chart) {
        let Self { least, queue, .. } = self;
        let (statuses, steps) = (&chart.statuses, chart.steps().map(|(step, _)| step));
        let is_explored = |place: usize| statuses[place] == Status::Explored;
        least.clear();
        least.extend((0..statuses.len()).map(|place| if is_explored(place) { CLOSED } else { 0 }));
        queue.clear();
        let beside = |place: usize| steps.into_iter().map(move |step| place.wrapping_add_signed(step));
        let is_frontier = |place: usize| beside(place).any(|place| statuses[place] == Status::Unexplored);
        for place in (0..statuses.len()).filter(|&place| is_explored(place) && is_frontier(place)) {
            least[place] = 1;
            queue.push(place);
        }
        let mut head = 0;
        while let Some(&place) = queue.get(head) {
            head += 1;
            for next in beside(place) {
                if least[next] == CLOSED {
                    least[next] = least[place] + 1;
                    queue.push(next);
                }
            }
        }
    }
}
