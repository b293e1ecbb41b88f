//! Bounds: the surroundings in which a rule over states is looked at, in words and as data.

use std::fmt::Display;

use crate::decide::MethodError;

/// All surroundings within which a rule is looked at; its words are the bound of a check.
pub trait Bound: Display + Send + Sync + 'static {
    /// One of them, which stays as it is throughout a run: a layout with goals, say, or the number of nodes.
    type Surroundings: Send + Sync;

    /// Each of them, the smallest first. No state of one is a state of another.
    ///
    /// # Errors
    /// [`MethodError`] if there are none like that, or too many.
    fn each(&self) -> Result<Vec<Self::Surroundings>, MethodError>;
}

/// Makes a [`Bound`] of a few numbers, which are the only surroundings: `bound! { Net { nodes: usize } "{nodes} nodes";
/// nodes > 0, "there are no nodes" }`. After the words stand conditions, each with what is said where it is not met.
/// `Net::of` makes one of its numbers in their order.
#[macro_export]
macro_rules! bound {
    (
        $(#[$about:meta])* $vis:vis $name:ident { $($field:ident: $type:ty),+ } $words:literal
        $(; $is_met:expr, $reason:literal)*
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug)]
        #[allow(missing_docs, reason = "the words of the bound say what its numbers mean")]
        $vis struct $name { $($vis $field: $type),+ }

        impl $name {
            #[allow(dead_code, missing_docs, clippy::must_use_candidate, reason = "it may be made by its fields, too")]
            $vis const fn of($($field: $type),+) -> Self {
                Self { $($field),+ }
            }
        }

        impl ::std::fmt::Display for $name {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                let Self { $($field),+ } = self;
                ::std::write!(f, $words)
            }
        }

        impl $crate::protocol::Bound for $name {
            type Surroundings = Self;

            #[allow(unused_variables, reason = "a bound may have no conditions")]
            fn each(&self) -> ::std::result::Result<::std::vec::Vec<Self>, $crate::decide::MethodError> {
                let Self { $($field),+ } = *self;
                $($crate::decide::MethodError::unless($is_met, ::std::format_args!($reason))?;)*
                Ok(::std::vec![*self])
            }
        }
    };
}
