//! An exhausted search as a section of a certificate: the team moves of the longest run, and for each number
//! of walls the runs that meet so many, and their team moves.

use std::sync::{Mutex, MutexGuard, PoisonError};

use tautline_certificates::{Counts, Refusal, put};

use super::{Findings, Level, Waves};
use crate::engine::states::{AnySystem, Limits, NoCertificate};

/// All runs of a tree, of which one thing is demanded.
pub struct AllRuns<D, F> {
    search: Mutex<Box<dyn Waves<D, F>>>,
    demand: D,
}

impl<D, F> AllRuns<D, F> {
    /// Those of a search that is at its start, of which `demand` is demanded.
    pub fn new(search: Box<dyn Waves<D, F>>, demand: D) -> Self {
        Self { search: Mutex::new(search), demand }
    }

    fn lock(&self) -> MutexGuard<'_, Box<dyn Waves<D, F>>> {
        self.search.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn searched(&self) -> Findings<D, F> {
        let mut search = self.lock();
        while search.wave() {}
        search.found()
    }
}

/// A team move leads to a state that no other one leads to.
impl<D: Copy + PartialEq + Sync, F> AnySystem for AllRuns<D, F> {
    fn exhausted(&self, _: Limits<'_>) -> Result<(Vec<u8>, u64), NoCertificate> {
        let Findings { levels, longest, complete, given_up, counterexamples, moves, .. } = self.searched();
        if counterexamples.iter().any(|run| run.broken == self.demand) {
            return Err(NoCertificate::Broken);
        }
        if !complete || given_up > 0 {
            return Err(NoCertificate::Unfinished);
        }
        let mut section = Vec::new();
        put(&mut section, longest.into());
        for Level { runs, moves } in levels {
            put(&mut section, runs);
            put(&mut section, moves);
        }
        Ok((section, moves + 1))
    }

    fn check(&self, section: &[u8], _: u128) -> Result<Counts, Refusal> {
        self.lock().check(self.demand, section)
    }

    fn search(&self, _: Limits<'_>) -> u64 {
        self.searched().moves + 1
    }
}
