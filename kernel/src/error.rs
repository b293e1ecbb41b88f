//! The words of errors: a sentence for each case.

/// Makes `Display` and `Error` for an enum, of a sentence for each of its cases.
macro_rules! sentences {
    ($error:ty { $($case:pat => $sentence:literal $(, $value:expr)*;)* }) => {
        impl core::fmt::Display for $error {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match *self {
                    $($case => write!(f, $sentence $(, $value)*),)*
                }
            }
        }

        impl core::error::Error for $error {}
    };
}

pub(crate) use sentences;
