//! The settings of the rivals' tables: the parameters of the rivals that are numbers.

use super::super::parameter::{Parameter, of_field};
use super::super::prelude::*;
use crate::rivals::fault;
use crate::rivals::parameters::POOL;
use crate::rivals::{Cells, Deadlock, Links, Parameters, Search, Weights};

/// The team of the paper.
pub(super) const ROBOTS: u16 = 8;

settings! {
    /// The parameters of the rivals, but for what the tables vary.
    #[derive(Copy)]
    pub(super) struct RivalSettings {
        /// Runs of each rival
        pub runs: u32 = 50, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first run; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// Team moves in the pool of Rooker and Birk
        pub pool: u32 = POOL, one("pool", "MOVES", pool);
        /// The weights of a side on the way to an unexplored cell, of a new cell, and of a leader
        pub weights: Weights = Parameters::POOL.weights, weights();
        /// Team moves without gain after which a rival makes 5 legal ones at random; 0 for never
        pub scatter: u32 = 0, one("scatter", "MOVES", number);
        /// Team moves without gain after which a rival's run ends
        pub patience: u32 = Parameters::POOL.patience, one("patience", "MOVES", at_least_one);
    }
}

impl RivalSettings {
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
        Ok(parameters.check(ROBOTS.into()).map_err(|unfit| fault(&unfit))?)
    }
}

/// The weights, each by an option of its own.
fn weights() -> Vec<Parameter<Weights>> {
    let price = "What a rival's robot pays for each side on its way to an unexplored cell";
    let gain = "What a rival's robot gains in an unexplored cell";
    let leads = "How many times as much that counts for one robot, the leader; 1 for equal weight";
    let names = ["distance-weight", "new-cell-weight", "leader-weight"];
    let [price_by, gain_by, leads_by] = names.map(|name| one(name, "WEIGHT", weight));
    let mut weights = of_field(price, |all: &Weights| &all.distance, |all| &mut all.distance, price_by);
    weights.extend(of_field(gain, |all: &Weights| &all.new_cell, |all| &mut all.new_cell, gain_by));
    weights.extend(of_field(leads, |all: &Weights| &all.leader, |all| &mut all.leader, leads_by));
    weights
}

fn weight(text: &str) -> Result<f64, String> {
    let weight = real(text)?;
    let weights = Weights { distance: weight, ..Parameters::POOL.weights };
    let checked = Parameters { weights, ..Parameters::POOL }.check(ROBOTS.into());
    checked.map(|()| weight).map_err(|unfit| unfit.remedy())
}

fn pool(text: &str) -> Result<u32, String> {
    let pool = number(text)?;
    let checked = Parameters { search: Search::Pool(pool), ..Parameters::POOL }.check(ROBOTS.into());
    checked.map(|()| pool).map_err(|unfit| format!("{unfit}: {}", unfit.remedy()))
}

fn at_least_one(text: &str) -> Result<u32, String> {
    match number(text)? {
        0 => Err("give 1 or more".to_owned()),
        more => Ok(more),
    }
}
