//! The page of a rule of one's own. A crate names its scheme by [`page!`](crate::page), and
//! `web/build --rule FOLDER` makes the page of it: the rule stands first among the schemes, is drawn,
//! run, decided by hand and hunted as ours are.

use std::sync::OnceLock;

use serde_json::{Value, json};
use tautline_kernel::ground::Cell;
use tautline_sim::explore::{Catalogue, Profile, SCHEMES};

/// A scheme of one's own, and what a page shows of it first.
#[derive(Clone, Copy, Debug)]
pub struct OwnPage {
    /// Its row.
    pub scheme: &'static Profile,
    /// The id and the sentence of each of its clauses.
    pub sentences: &'static [(&'static str, &'static str)],
    /// Columns and rows of the first layout.
    pub size: (i16, i16),
    /// Where the robots start in it.
    pub starts: &'static [Cell],
}

impl OwnPage {
    /// The first layout.
    pub(crate) fn opens(&self) -> Value {
        json!({ "size": self.size, "starts": self.starts })
    }
}

/// The page of one's own rule, and the schemes with it.
static PAGE: OnceLock<(OwnPage, Catalogue)> = OnceLock::new();

/// Puts a scheme of one's own into the page. Only the first one counts.
pub fn begin(page: OwnPage) {
    PAGE.get_or_init(|| {
        let own: &'static [&'static Profile] = Box::leak(Box::new([page.scheme]));
        (page, Catalogue(Box::leak(Box::new([own, SCHEMES]))))
    });
}

/// The page of one's own rule, if it is one.
pub(crate) fn page() -> Option<&'static OwnPage> {
    PAGE.get().map(|(page, _)| page)
}

/// The schemes of the page.
pub(crate) fn catalogue() -> Catalogue {
    PAGE.get().map_or(Catalogue::OWN, |&(_, catalogue)| catalogue)
}

/// Makes the library of a crate the engine behind the page of this [`OwnPage`].
#[macro_export]
macro_rules! page {
    ($page:expr) => {
        /// Puts the scheme into the page.
        #[unsafe(no_mangle)]
        pub extern "C" fn page_begin() {
            $crate::own::begin($page);
        }
    };
}
