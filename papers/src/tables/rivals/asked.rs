//! What can be asked of the rivals' tables: the parameters of the rivals that are numbers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::super::parameter::{Parameter, put, shown};
use crate::rivals::fault;
use crate::rivals::{Cells, Deadlock, Links, Parameters, Search, Weights};
use tautline_sim::diagnostic::Halt;
use tautline_sim::value_parser::{number, real};

/// What the rivals are told, but for what the tables vary.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Told {
    /// Runs of each line, or layouts of each point.
    pub runs: u32,
    /// The seed of the first one; the others have the seeds after it.
    pub seed: u64,
    /// Team moves in a pool.
    pub pool: u32,
    /// The weights of a side on the way to an unexplored cell, and of a new cell.
    pub weights: Weights,
    /// Team moves without gain after which a team scatters; 0 for never.
    pub scatter: u32,
    /// Team moves without gain after which a run ends.
    pub patience: u32,
}

impl Told {
    pub(super) const fn new(runs: u32) -> Self {
        let Parameters { weights, patience, .. } = Parameters::POOL;
        Self { runs, seed: 0, pool: crate::rivals::parameters::POOL, weights, scatter: 0, patience }
    }

    pub(super) const fn parameters(&self, search: Search, links: Links, cells: Cells) -> Parameters {
        let deadlock = match self.scatter {
            0 => Deadlock::Wait,
            after => Deadlock::Scatter { after, moves: 5 },
        };
        let Self { weights, patience, .. } = *self;
        Parameters { search, links, cells, weights, deadlock, patience, ..Parameters::POOL }
    }

    /// Refuses what no team can be told.
    pub(super) fn check(&self) -> Result<(), Halt> {
        let parameters = self.parameters(Search::Pool(self.pool), Links::Safe, Cells::Distinct);
        Ok(parameters.check(super::ROBOTS.into()).map_err(|unfit| fault(&unfit))?)
    }
}

fn weight(text: &str) -> Result<f64, String> {
    let weight = real(text)?;
    let weights = Weights { distance: weight, new_cell: 0.0 };
    let checked = Parameters { weights, ..Parameters::POOL }.check(super::ROBOTS.into());
    checked.map(|()| weight).map_err(|unfit| unfit.remedy())
}

fn pool(text: &str) -> Result<u32, String> {
    let pool = number(text)?;
    let checked = Parameters { search: Search::Pool(pool), ..Parameters::POOL }.check(super::ROBOTS.into());
    checked.map(|()| pool).map_err(|unfit| format!("{unfit}: {}", unfit.remedy()))
}

fn at_least_one(text: &str) -> Result<u32, String> {
    match number(text)? {
        0 => Err("give 1 or more".to_owned()),
        more => Ok(more),
    }
}

/// The options of settings that hold what the rivals are told.
pub(super) fn parameters<S: AsRef<Told> + AsMut<Told>>() -> Vec<Parameter<S>> {
    vec![
        Parameter::one(
            "seed",
            "SEED",
            "The seed of the first run; the others have the seeds after it",
            |all| shown(&all.as_ref().seed),
            |all, texts| put(&mut all.as_mut().seed, texts, number),
        ),
        Parameter::one(
            "pool",
            "MOVES",
            "Team moves in the pool of Rooker and Birk",
            |all| shown(&all.as_ref().pool),
            |all, texts| put(&mut all.as_mut().pool, texts, pool),
        ),
        Parameter::one(
            "distance-weight",
            "WEIGHT",
            "What a rival's robot pays for each side on its way to an unexplored cell",
            |all| shown(&all.as_ref().weights.distance),
            |all, texts| put(&mut all.as_mut().weights.distance, texts, weight),
        ),
        Parameter::one(
            "new-cell-weight",
            "WEIGHT",
            "What a rival's robot gains in an unexplored cell",
            |all| shown(&all.as_ref().weights.new_cell),
            |all, texts| put(&mut all.as_mut().weights.new_cell, texts, weight),
        ),
        Parameter::one(
            "scatter",
            "MOVES",
            "Team moves without gain after which a rival makes 5 legal ones at random; 0 for never",
            |all| shown(&all.as_ref().scatter),
            |all, texts| put(&mut all.as_mut().scatter, texts, number),
        ),
        Parameter::one(
            "patience",
            "MOVES",
            "Team moves without gain after which a rival's run ends",
            |all| shown(&all.as_ref().patience),
            |all, texts| put(&mut all.as_mut().patience, texts, at_least_one),
        ),
    ]
}
