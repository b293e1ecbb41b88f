//! Sets of steps: what a robot can choose from.

use super::Step;

/// A set of steps, one bit each in direction order.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Steps(u8);

impl Steps {
    /// No step.
    pub const NONE: Self = Self(0);
    /// Every step.
    pub const ALL: Self = Self(0b1_1111);

    /// This step alone.
    #[inline]
    pub const fn only(step: Step) -> Self {
        Self(1 << step.place())
    }

    /// These and `step`.
    #[inline]
    pub const fn with(self, step: Step) -> Self {
        self.or(Self::only(step))
    }

    /// These but not `step`.
    #[inline]
    pub const fn without(self, step: Step) -> Self {
        Self(self.0 & !Self::only(step).0)
    }

    /// Whether `step` is among them.
    #[inline]
    pub const fn has(self, step: Step) -> bool {
        self.0 & Self::only(step).0 != 0
    }

    /// The steps of either set.
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The steps of both sets.
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// These but not the `other` steps.
    pub const fn minus(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// How many they are.
    #[inline]
    pub const fn len(self) -> u32 {
        // Most processors' plainest instructions count no bits.
        const LENGTHS: [u8; 32] = {
            let mut lengths = [0; 32];
            let mut bits = 0;
            while bits < lengths.len() {
                lengths[bits] = bits.count_ones() as u8;
                bits += 1;
            }
            lengths
        };
        LENGTHS[(self.0 & Self::ALL.0) as usize] as u32
    }

    /// Whether there are two or more.
    #[inline]
    pub const fn is_choice(self) -> bool {
        self.0 & self.0.wrapping_sub(1) != 0
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The first in direction order; of none, staying.
    #[inline]
    pub fn first(self) -> Step {
        self.iter().next().unwrap_or(Step::Stay)
    }

    /// A bit for each by its place, the first lowest; more bits than there are steps are left out.
    pub const fn of_bits(bits: u8) -> Self {
        Self(bits & Self::ALL.0)
    }

    /// A bit for each, as [`Steps::of_bits`] has them.
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// In direction order.
    #[inline]
    pub fn iter(self) -> impl Iterator<Item = Step> + Clone {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            let step = Step::ALL.get(rest.trailing_zeros() as usize).copied();
            rest &= rest.wrapping_sub(1);
            step
        })
    }

    /// Those of the steps that are `good`.
    #[inline]
    pub fn filter(self, mut good: impl FnMut(Step) -> bool) -> Self {
        self.iter().filter(|&step| good(step)).fold(Self::NONE, Self::with)
    }
}
