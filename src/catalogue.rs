//! The schemes of this program.

#[cfg(feature = "papers")]
pub(crate) use tautline_papers::rivals::CATALOGUE;
#[cfg(not(feature = "papers"))]
use tautline_sim::explore::Catalogue;

/// The schemes of this program: without the papers, the chain has no rivals.
#[cfg(not(feature = "papers"))]
pub(crate) const CATALOGUE: Catalogue = Catalogue::OWN;
