//! Sets of named conditions: every rule is one.

/// Makes the type `Conditions` of the sets of a `Condition`, a fieldless enum that counts from 0 and has at most 16 variants.
///
/// ```
/// #[derive(Clone, Copy)]
/// pub enum Condition {
///     /// A robot that is blocked waits.
///     Waits,
///     /// A robot that waits tells so.
///     Tells,
/// }
///
/// tautline_kernel::conditions!(Condition);
///
/// const OURS: Conditions = Conditions::of(&[Condition::Waits, Condition::Tells]);
/// assert!(!OURS.without(Condition::Tells).has(Condition::Tells));
/// ```
#[macro_export]
macro_rules! conditions {
    ($condition:ident) => {
        /// A set of conditions.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub struct Conditions(u16);

        $crate::format_conditions!();

        impl Conditions {
            /// The set of these conditions.
            pub const fn of(conditions: &[$condition]) -> Self {
                let mut set = Self(0);
                let mut i = 0;
                while i < conditions.len() {
                    set = set.with(conditions[i]);
                    i += 1;
                }
                set
            }

            /// This set with `condition`.
            #[must_use]
            pub const fn with(self, condition: $condition) -> Self {
                Self(self.0 | 1 << condition as u16)
            }

            /// This set without `condition`.
            #[must_use]
            pub const fn without(self, condition: $condition) -> Self {
                Self(self.0 & !(1 << condition as u16))
            }

            /// Whether `condition` is in the set.
            #[inline]
            pub const fn has(self, condition: $condition) -> bool {
                self.0 & (1 << condition as u16) != 0
            }
        }
    };
}

/// What logs a set of conditions by defmt: its bits.
#[cfg(feature = "defmt")]
#[doc(hidden)]
#[macro_export]
macro_rules! format_conditions {
    () => {
        impl $crate::defmt::Format for Conditions {
            fn format(&self, f: $crate::defmt::Formatter<'_>) {
                $crate::defmt::Format::format(&self.0, f);
            }
        }
    };
}

/// Nothing: sets are logged only where the feature `defmt` is on.
#[cfg(not(feature = "defmt"))]
#[doc(hidden)]
#[macro_export]
macro_rules! format_conditions {
    () => {};
}
