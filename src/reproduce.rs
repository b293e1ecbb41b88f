//! What the papers and SPEC.md report as tables, measured again.

pub mod agents;
pub mod atlas;
pub mod interval;
pub mod notice_fig5;
pub mod optimum;
pub mod repair_cost;

/// Every reproduction.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reproduction {
    /// What the chain's repairs cost in team moves, and what they prevent.
    RepairCost,
    /// How far the chain is from the optimum of a team that knows the walls.
    Optimum,
    /// What becomes of all runs in all layouts.
    Atlas,
    /// What agents explore by their number, with missed sensors.
    BricksFig11,
    /// What agents explore by the area, with missed sensors.
    BricksFig12,
    /// How long agents take, with none missed.
    BricksIdeal,
    /// Figure 5 of paper 003.
    NoticeFig5,
}

impl Reproduction {
    /// All, in order.
    pub const ALL: [Self; 7] = [
        Self::RepairCost,
        Self::Optimum,
        Self::Atlas,
        Self::BricksFig11,
        Self::BricksFig12,
        Self::BricksIdeal,
        Self::NoticeFig5,
    ];

    /// Its name.
    pub const fn id(self) -> &'static str {
        match self {
            Self::RepairCost => "repair-cost",
            Self::Optimum => "optimum",
            Self::Atlas => "atlas",
            Self::BricksFig11 => "bricks-fig11",
            Self::BricksFig12 => "bricks-fig12",
            Self::BricksIdeal => "bricks-ideal",
            Self::NoticeFig5 => "notice-fig5",
        }
    }

    /// What it shows.
    pub const fn words(self) -> &'static str {
        match self {
            Self::RepairCost => {
                "the chain as published against the chain repaired on the same random layouts: mean team moves to 50 % \
                 and 75 %, and runs that break a clause"
            }
            Self::Optimum => {
                "the chain against the fewest team moves of a team that knows the walls, in all layouts of small areas: \
                 how often it takes as few, how many times as many on average and at worst, and what it misses"
            }
            Self::Atlas => {
                "all runs of the chain in all layouts with few walls, by rule and number of robots: how many there are, \
                 how long, and how many break which clause"
            }
            Self::BricksFig11 => {
                "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what they explore and mark \
                 as visited, by the number of agents"
            }
            Self::BricksFig12 => {
                "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what 20 agents explore and \
                 mark as visited, by the area"
            }
            Self::BricksIdeal => {
                "Brick&Mortar, Ants and both together in offices, no sensor missed: how long until everything is explored, \
                 and until all agents know it, by the number of agents"
            }
            Self::NoticeFig5 => {
                "k-FNF, flooding, counter, distance and scalable broadcasts in random networks: the share of all nodes and \
                 of those connected to the source that each reaches, and how many nodes forward"
            }
        }
    }
}
