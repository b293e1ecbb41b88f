//! Sets of steps.

use crate::lattice::Step;

/// A set of steps, one bit each in direction order.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Steps(u8);

impl Steps {
    pub(super) const NONE: Self = Self(0);
    pub(super) const ALL: Self = Self(0b1_1111);

    pub(super) const fn only(step: Step) -> Self {
        Self(1 << step.place())
    }

    pub(super) const fn with(self, step: Step) -> Self {
        self.or(Self::only(step))
    }

    pub(super) const fn without(self, step: Step) -> Self {
        Self(self.0 & !Self::only(step).0)
    }

    pub(super) const fn has(self, step: Step) -> bool {
        self.0 & Self::only(step).0 != 0
    }

    pub(super) const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(super) const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    pub(super) const fn minus(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    pub(super) const fn len(self) -> u32 {
        self.0.count_ones()
    }

    /// The first in direction order; of none, staying.
    pub(super) fn first(self) -> Step {
        self.iter().next().unwrap_or(Step::Stay)
    }

    /// In direction order.
    pub(super) fn iter(self) -> impl Iterator<Item = Step> {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            let step = Step::ALL.get(rest.trailing_zeros() as usize).copied();
            rest &= rest.wrapping_sub(1);
            step
        })
    }

    /// Those of the steps that are `good`.
    pub(super) fn filter(self, mut good: impl FnMut(Step) -> bool) -> Self {
        self.iter().filter(|&step| good(step)).fold(Self::NONE, Self::with)
    }
}
