//! An entry of the library.

use tautline_proofs::clause::Clause;

/// A published rule: its type, its name on a command line and in a table, the word before the numbers of its promises,
/// and its source; the rule and its variants, each with a name in tables; and the promises. A promise has the number of
/// its demand, from 1 on, its sentence, and its checks: the verdict, the rule, the bound, and the rules that the check
/// must reject. Checks within larger bounds stand apart.
macro_rules! entry {
    (
        $rule:ty: $name:literal, $title:literal, $scheme:literal, $source:literal;
        $($variant:ident = $words:literal, $value:expr;)+
        $($number:literal: $sentence:literal { $($checks:tt)* } $(larger { $($larger:tt)* })?)+
    ) => {
        $(const $variant: NamedRule<$rule> = NamedRule::new($words, $value);)+

        /// The rule.
        pub(crate) static ENTRY: $crate::entry::Entry = $crate::entry::Entry {
            name: $name,
            title: $title,
            source: $source,
            promises: &[$($crate::entry::Promise {
                clause: entry!(@clause $rule, concat!($scheme, "-", $number), $number, $sentence; $($checks)*),
                larger: entry!(@clause $rule, concat!($scheme, "-", $number), $number, $sentence; $($($larger)*)?),
            }),+],
        };
    };
    (
        @clause $rule:ty, $id:expr, $number:literal, $sentence:literal;
        $($verdict:ident $about:ident within $bound:expr $(, not $($mutant:ident),+)?;)*
    ) => {
        Clause {
            id: $id,
            sentence: $sentence,
            checks: &[$(&Check::new(
                $about,
                &Keeps::<$rule>($bound, $number - 1),
                Verdict::$verdict,
                &[$($($mutant),+)?],
            )),*],
        }
    };
}

/// A published rule.
#[derive(Debug)]
pub struct Entry {
    /// The name on a command line.
    pub name: &'static str,
    /// The name in a table.
    pub title: &'static str,
    /// The source, as Markdown.
    pub source: &'static str,
    /// The promises, with what must come out.
    pub promises: &'static [Promise],
}

/// A promise with its checks, and with those within bounds that take longer, which may be none.
#[derive(Debug)]
pub struct Promise {
    pub(crate) clause: Clause,
    pub(crate) larger: Clause,
}

impl Entry {
    /// The promises.
    pub fn clauses(&self) -> impl Iterator<Item = &'static Clause> {
        self.promises.iter().map(|promise| &promise.clause)
    }

    /// The promises that have larger bounds, within these.
    pub fn larger(&self) -> impl Iterator<Item = &'static Clause> {
        self.promises.iter().map(|promise| &promise.larger).filter(|clause| !clause.checks.is_empty())
    }
}
