//! What the papers and SPEC.md report as tables, measured again.

pub mod repair_cost;

/// Every reproduction.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reproduction {
    /// What the chain's repairs cost in team moves, and what they prevent.
    RepairCost,
}

impl Reproduction {
    /// All, in order.
    pub const ALL: [Self; 1] = [Self::RepairCost];

    /// Its name.
    pub const fn id(self) -> &'static str {
        match self {
            Self::RepairCost => "repair-cost",
        }
    }

    /// What it shows.
    pub const fn words(self) -> &'static str {
        match self {
            Self::RepairCost => {
                "the chain as published against the chain repaired on the same random layouts: mean team moves to 50 % \
                 and 75 %, and runs that break a clause"
            }
        }
    }
}
