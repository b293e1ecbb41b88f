//! The one door through which the unknown enters. Whether an edge is open, a sensor is seen, a packet
//! arrives, which agent moves next: each is a choice, and each is asked of an [`Oracle`].

use crate::ground::{Cell, Edge};

/// Answers choices. Engines differ only in how: at random, every alternative in turn, symbolically, from a
/// list of numbers, or as a stored run answered.
pub trait Oracle {
    /// A number below `below`.
    ///
    /// `below` is at least 1. An oracle that has run out of answers gives 0, so bodies put the plain case
    /// first.
    fn pick(&mut self, below: u32) -> u32;

    /// One of two alternatives; the plain case is `false`.
    fn flip(&mut self) -> bool {
        self.pick(2) == 1
    }

    /// Whether the world is against the robots: an edge is a wall, a sensor is missed, a message is lost. Searches
    /// bound how often it is; the plain case is `false`.
    fn mishap(&mut self) -> bool {
        self.flip()
    }

    /// Whether robots can cross `edge`, which none of them has tried before: a wall is a mishap. A layout looks it up.
    fn is_open(&mut self, _edge: Edge) -> bool {
        !self.mishap()
    }

    /// Whether robots can be in `cell`, of which nothing is known: an obstacle is a mishap. A layout looks it up.
    fn is_free(&mut self, _cell: Cell) -> bool {
        !self.mishap()
    }

    /// Whether a message from one robot arrives at another one: a loss is a mishap.
    fn arrives(&mut self, _from: usize, _to: usize) -> bool {
        !self.mishap()
    }
}

/// One of the `options`, which must not be empty.
pub fn one_of<T: Copy, const OPTIONS: usize>(oracle: &mut dyn Oracle, options: &[T; OPTIONS]) -> T {
    const { assert!(OPTIONS > 0, "a choice needs an option") };
    options[(oracle.pick(OPTIONS as u32) as usize).min(OPTIONS - 1)]
}

#[cfg(test)]
pub(crate) mod tests {
    use super::Oracle;

    /// Answers that a linear congruence makes of the ones before.
    pub(crate) struct Congruence(pub(crate) u64);

    impl Oracle for Congruence {
        fn pick(&mut self, below: u32) -> u32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (((self.0 >> 32) * u64::from(below)) >> 32) as u32
        }
    }
}
