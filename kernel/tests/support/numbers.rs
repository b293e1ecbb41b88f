//! Numbers that are the same in every run.

#![allow(missing_docs, unreachable_pub, reason = "several tests use it")]

use tautline_kernel::choice::Oracle;

/// Answers that a linear congruence makes of the ones before.
pub struct Congruence(pub u64);

impl Oracle for Congruence {
    fn pick(&mut self, below: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (((self.0 >> 32) * u64::from(below)) >> 32) as u32
    }
}
