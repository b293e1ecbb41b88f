//! What the papers and SPEC.md report as tables, measured again.

pub mod agents;
pub mod antenna_fig4;
pub mod atlas;
pub mod interval;
pub mod journeys;
pub mod notice_fig5;
pub mod optimum;
pub mod repair_cost;
pub mod rescue_fig8;

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
    /// Figure 4 of paper 003.
    AntennaFig4,
    /// Figure 5 of paper 003.
    NoticeFig5,
    /// Figure 6 of paper 003.
    RescueFig6,
    /// Figure 7 of paper 003.
    RescueFig7,
    /// Figure 8 of paper 003.
    RescueFig8,
    /// Figure 9 of paper 003.
    RescueFig9,
    /// Figure 10 of paper 003.
    RescueFig10,
}

impl Reproduction {
    /// All, in order.
    pub const ALL: [Self; 13] = [
        Self::RepairCost,
        Self::Optimum,
        Self::Atlas,
        Self::BricksFig11,
        Self::BricksFig12,
        Self::BricksIdeal,
        Self::AntennaFig4,
        Self::NoticeFig5,
        Self::RescueFig6,
        Self::RescueFig7,
        Self::RescueFig8,
        Self::RescueFig9,
        Self::RescueFig10,
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
            Self::AntennaFig4 => "antenna-fig4",
            Self::NoticeFig5 => "notice-fig5",
            Self::RescueFig6 => "rescue-fig6",
            Self::RescueFig7 => "rescue-fig7",
            Self::RescueFig8 => "rescue-fig8",
            Self::RescueFig9 => "rescue-fig9",
            Self::RescueFig10 => "rescue-fig10",
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
            Self::AntennaFig4 => {
                "what a robot hears of a node all round with its directional antenna, and how far off the strongest \
                 direction is from the node's, by the noise"
            }
            Self::NoticeFig5 => {
                "k-FNF, flooding, counter, distance and scalable broadcasts in random networks: the share of all nodes and \
                 of those connected to the source that each reaches, and how many nodes forward"
            }
            Self::RescueFig6 => {
                "the ways of a robot to the node that waits for rescue by Reich's scheme, TAN and Verma's, as a picture"
            }
            Self::RescueFig7 => {
                "how many metres a robot walks for each metre of the shortest way by TAN, Verma's, Reich's and Sheu's \
                 schemes, by the number of nodes, and what becomes of the paper's words about it"
            }
            Self::RescueFig8 => {
                "three robots for three that wait for rescue, MRC as published and repaired: how often each gets a robot, \
                 and one of its own, how far they go, and how far from the best assignment that is"
            }
            Self::RescueFig9 => {
                "the ways of a robot round a large obstacle: how many arrive, and how far they walk"
            }
            Self::RescueFig10 => {
                "the ways of a robot round four large obstacles: how many arrive, and how far they walk"
            }
        }
    }
}
