//! Sets of named conditions: every rule is one.

/// A rule that is a set of named conditions, as a program shows it that lets a person switch them.
pub trait Conditional: Copy {
    /// Its conditions, each by its name and the sentence that it stands for.
    const CONDITIONS: &'static [(&'static str, &'static str)];

    /// The conditions in force, a bit for each in their order.
    fn in_force(&self) -> u32;

    /// This rule with these conditions in force, and no others.
    #[must_use]
    fn with_in_force(self, conditions: u32) -> Self;
}

/// Makes a fieldless enum of conditions, the list `ALL` of them, the type `Conditions` of their sets, each in a number
/// with a bit for each condition, and what a rule is asked that has such a set in its field `conditions`.
///
/// ```
/// tautline_kernel::conditions! {
///     /// One condition of the rule.
///     pub enum Condition of Rule in u16 {
///         /// A robot that is blocked waits.
///         Waits,
///         /// A robot that waits tells so.
///         Tells,
///     }
/// }
///
/// #[derive(Clone, Copy)]
/// pub struct Rule {
///     conditions: Conditions,
/// }
///
/// const OURS: Rule = Rule { conditions: Conditions::of(&Condition::ALL) };
/// assert!(!OURS.without(Condition::Tells).has(Condition::Tells));
/// ```
#[macro_export]
macro_rules! conditions {
    (
        $(#[$about:meta])*
        pub enum $condition:ident $(of $rule:ident)? in $bits:ident { $($(#[doc = $says:literal])* $name:ident,)* }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum $condition { $($(#[doc = $says])* $name,)* }

        impl $condition {
            /// All of them.
            pub const ALL: [Self; [$(Self::$name),*].len()] = [$(Self::$name),*];

            /// Each by its name and the sentence that it stands for.
            pub const SENTENCES: &[(&str, &str)] = &[$((stringify!($name), concat!($($says),*))),*];
        }

        /// A set of conditions.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub struct Conditions($bits);

        $crate::format_conditions!($condition);

        impl Conditions {
            /// The set of these conditions.
            pub const fn of(conditions: &[$condition]) -> Self {
                match conditions {
                    [first, rest @ ..] => Self::of(rest).with(*first),
                    [] => Self(0),
                }
            }

            /// This set with `condition`.
            #[must_use]
            pub const fn with(self, condition: $condition) -> Self {
                Self(self.0 | 1 << condition as $bits)
            }

            /// This set without `condition`.
            #[must_use]
            pub const fn without(self, condition: $condition) -> Self {
                Self(self.0 & !(1 << condition as $bits))
            }

            /// Whether `condition` is in the set.
            #[inline]
            pub const fn has(self, condition: $condition) -> bool {
                self.0 & (1 << condition as $bits) != 0
            }
        }

        $(impl $rule {
            /// This rule with one condition put in.
            #[must_use]
            pub const fn with(mut self, condition: $condition) -> Self {
                self.conditions = self.conditions.with(condition);
                self
            }

            /// This rule with one condition taken out.
            #[must_use]
            pub const fn without(mut self, condition: $condition) -> Self {
                self.conditions = self.conditions.without(condition);
                self
            }

            /// Whether `condition` is in force.
            #[inline]
            pub const fn has(&self, condition: $condition) -> bool {
                self.conditions.has(condition)
            }
        }

        impl $crate::conditions::Conditional for $rule {
            const CONDITIONS: &'static [(&'static str, &'static str)] = $condition::SENTENCES;

            fn in_force(&self) -> u32 {
                self.conditions.0.into()
            }

            fn with_in_force(mut self, conditions: u32) -> Self {
                self.conditions = Conditions(conditions as $bits);
                self
            }
        })?
    };
}

/// Logs a condition by defmt, by its name, and a set of them, by its bits.
#[cfg(feature = "defmt")]
#[doc(hidden)]
#[macro_export]
macro_rules! format_conditions {
    ($condition:ident) => {
        impl $crate::defmt::Format for $condition {
            fn format(&self, f: $crate::defmt::Formatter<'_>) {
                $crate::defmt::Format::format(Self::SENTENCES[*self as usize].0, f);
            }
        }

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
    ($condition:ident) => {};
}
