//! About how many team moves are left below a place in the tree of runs, by what the levels before this one had. It
//! decides how a level is shared out, and nothing of what is found.

use super::count::Level;

/// Parts of a run of usual length. Walls make runs longer, so that the last part, and not nothing, is left near its
/// end.
const PARTS: u64 = 8;

/// A fraction of one is a number of these.
const ONE: u64 = 1 << 20;

/// Levels by which the next one can be told: fewer do not show that walls make runs longer.
pub(super) const TELLING: usize = 3;

/// Team moves of the next level, if the levels grow on as they have so far. The runs that meet *k* walls are about as
/// many as sets of *k* edges, so their growth falls as that of the sets does. In excess of that, walls make runs
/// longer, by less with each wall: from one level to the next the excess is taken to grow by the square root of what it
/// grew by before.
#[expect(clippy::cast_precision_loss, reason = "an estimate")]
pub(super) fn next(levels: &[Level], edges: u32) -> Option<f64> {
    let moves: Vec<f64> = levels.iter().map(|level| level.moves as f64).collect();
    let growth_of_sets = |walls: usize| (f64::from(edges) - walls as f64 + 1.0) / walls as f64;
    let excess = |walls: usize| moves[walls] / moves[walls - 1] / growth_of_sets(walls);
    let done = moves.len().checked_sub(1).filter(|&done| done > 0)?;
    let slowed = if moves.len() < TELLING { 1.0 } else { (excess(done) / excess(done - 1)).sqrt() };
    Some(moves[done] * excess(done) * slowed * growth_of_sets(done + 1))
}

/// The levels up to that of `last` walls: those that are known, and what is expected of the others.
pub(super) fn levels(known: &[Level], edges: u32, last: u32) -> Vec<Level> {
    let mut levels = known.to_vec();
    while levels.len() <= last as usize {
        let moves = next(&levels, edges).unwrap_or_default().max(1.0) as u64;
        levels.push(Level { runs: 0, moves });
    }
    levels
}

/// How many team moves to expect.
pub(super) struct Forecast {
    /// Team moves of a usual run.
    length: u64,
    /// Team moves below a place, by the mishaps that may still come and the parts of a usual run before it.
    below: Vec<Vec<u64>>,
}

impl Forecast {
    /// Below the start, a search for at most *k* mishaps makes as many team moves as the levels 0 to *k* have. Farther
    /// on, where a part *x* of a usual run is left, a level of *k* mishaps has about its *x* to the power of *k*, since
    /// each of them is somewhere on what is left.
    pub(super) fn new(levels: &[Level]) -> Self {
        let mut fractions = [ONE; PARTS as usize];
        let mut sums = [0_u64; PARTS as usize];
        let mut below = Vec::new();
        for level in levels {
            for ((fraction, sum), left) in fractions.iter_mut().zip(&mut sums).zip((1..=PARTS).rev()) {
                let moves = u128::from(level.moves) * u128::from(*fraction) / u128::from(ONE);
                *sum = sum.saturating_add(moves as u64);
                *fraction = *fraction * left / PARTS;
            }
            below.push(sums.to_vec());
        }
        let length = levels.first().map_or(1, |level| level.moves / level.runs.max(1)).max(1);
        Self { length, below }
    }

    /// The team moves below a place after `steps` team moves, from which `mishaps` may still come. If no level tells,
    /// it is more than any number.
    pub(super) fn below(&self, steps: u32, mishaps: u32) -> u64 {
        let part = (u64::from(steps) * PARTS / self.length).min(PARTS - 1);
        self.below.get(mishaps as usize).map_or(u64::MAX, |moves| moves[part as usize])
    }
}
