//! Hunts that examine each layout by itself, in one process or dealt out among shards.

use std::fmt;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use tautline_io::checkpoint::{Facts, Part, decode, encode};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_proofs::engine::cases::{self, Cases, Outcome, Shard};
use tautline_proofs::plural::counted;

use super::hunt::{Bound, Deals, Dealt, Far, Hunt, HuntReport, HuntRequest, Hunter, RUN_AGAIN, read_deal};

/// A hunt that outcomes at each layout by itself.
pub(super) trait Each: fmt::Debug + Sync {
    /// The layouts.
    type Layouts: Cases<Outcome: Serialize + DeserializeOwned, Error: Into<Diagnostic>>;

    /// The bounds that it takes, as of a [`Hunt`].
    const TAKES: &'static [Bound];

    /// Why it does not take `bound`, if it is not for the same reason as most hunts.
    fn refusal(&self, _: Bound) -> Option<(String, String)> {
        None
    }

    /// All layouts within what is asked.
    ///
    /// # Errors
    /// A [`Diagnostic`] if they are too many, or none.
    fn layouts(&self, asked: &HuntRequest<'_>) -> Result<Self::Layouts, Diagnostic>;

    /// How far a hunt is, in words.
    fn so_far(&self, asked: &HuntRequest<'_>, found: &FoundBy<Self>) -> String;

    /// The report of a hunt that came to its end, or did not.
    ///
    /// # Errors
    /// A [`Diagnostic`] if what was found cannot be written down.
    fn report(
        &self,
        asked: &HuntRequest<'_>,
        found: FoundBy<Self>,
        is_complete: bool,
    ) -> Result<HuntReport, Diagnostic>;
}

/// The findings of a hunt.
pub(super) type FoundBy<E> = <<E as Each>::Layouts as Cases>::Findings;

impl<E: Each> Hunt for E {
    fn takes(&self) -> &'static [Bound] {
        E::TAKES
    }

    fn refusal(&self, bound: Bound) -> (String, String) {
        Each::refusal(self, bound).unwrap_or_else(|| bound.refused_by(E::TAKES))
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        let layouts = self.layouts(asked)?;
        let mut hears = |found: &FoundBy<E>| hunter.hears(Far::Words(self.so_far(asked, found)));
        let searched = cases::search(&layouts, asked.budget, &mut hears);
        let (found, is_complete) = searched.map_err(Into::into)?;
        self.report(asked, found, is_complete)
    }

    fn deals(&self) -> Option<&dyn Deals> {
        Some(self)
    }
}

impl<E: Each> Deals for E {
    fn deal(&self, asked: &HuntRequest<'_>, shards: usize) -> Result<Dealt, Diagnostic> {
        let left = cases::dealt(&self.layouts(asked)?, shards).map_err(Into::into)?;
        Ok(Dealt { deal: encode(&(asked.bounds, ()))?, left, of: "layout", moves: 0 })
    }

    fn part<'a>(
        &'a self,
        asked: &HuntRequest<'_>,
        deal: &RawValue,
        shard: (usize, usize),
        far: Option<&RawValue>,
    ) -> Result<Box<dyn Part + 'a>, Diagnostic> {
        let (asked, ()) = read_deal(deal, asked)?;
        let outcomes = far.map(|far| decode(far, RUN_AGAIN)).transpose()?.unwrap_or_default();
        let shard = Shard::new(self.layouts(&asked)?, shard, outcomes, asked.budget);
        let shard = shard.map_err(Into::into)?;
        if !shard.is_in_order() {
            let what = "this shard has not done what the plan dealt it before it went on";
            return Err(Diagnostic::usage(what, RUN_AGAIN));
        }
        Ok(Box::new(LayoutShard(shard)))
    }

    fn merge(
        &self,
        asked: &HuntRequest<'_>,
        deal: &RawValue,
        shards: &[&RawValue],
    ) -> Result<HuntReport, Diagnostic> {
        let (asked, ()) = read_deal(deal, asked)?;
        let outcomes = shards.iter().map(|far| decode(far, RUN_AGAIN)).collect::<Result<Vec<_>, _>>()?;
        let (found, is_complete) = cases::merged(&self.layouts(&asked)?, outcomes).map_err(Into::into)?;
        self.report(&asked, found, is_complete)
    }
}

/// A shard of the layouts.
struct LayoutShard<L: Cases>(Shard<L>);

impl<L: Cases> LayoutShard<L> {
    /// How many layouts it has examined, and the steps that were made.
    fn count(&self) -> (usize, u64) {
        let all = || self.0.outcomes().iter().flatten();
        (all().count(), all().map(Outcome::steps).sum())
    }
}

impl<L: Cases<Outcome: Serialize, Error: Into<Diagnostic>>> Part for LayoutShard<L> {
    fn step(&mut self) -> Result<bool, Halt> {
        self.0.wave().map_err(|fault| fault.into().into())
    }

    fn far(&self) -> Result<Box<RawValue>, Diagnostic> {
        encode(&self.0.outcomes())
    }

    fn is_done(&self) -> bool {
        self.0.is_done()
    }

    fn facts(&self) -> Facts {
        let (layouts, moves) = self.count();
        Facts::Layouts { layouts, moves }
    }

    fn words(&self) -> String {
        let (layouts, moves) = self.count();
        format!("{}, {}", counted(layouts, "layout"), counted(moves, "team move"))
    }
}
