//! The rivals' parameters: the one place for every reading of the paper and for every number that it leaves open.
//!
//! | parameter | the paper | the default |
//! |---|---|---|
//! | [`Search`] | “the pool population of 1000”; “the pool of all of the possible team-moves” | 1000, or all |
//! | [`Null`] | “a random factor, which helps the team out” (E) | it stands by |
//! | [`Links`] | “E_S … This restriction is applied for all of the tested algorithms” (D) | E_S |
//! | [`Cells`] | “punishes the configurations in which the robots come too close” (I.B) | distinct outside the base |
//! | [`Moves`] | “4^(N−1) team-configurations” (C) | 5: seven robots cannot leave the base by four sides |
//! | [`Weights`] | the distance to the frontier, “with equal weight” (C, E) | 1, none for a new cell, no leader |
//! | [`Deadlock`] | “sooner or later” (E) | nothing but chance |
//! | `patience` | not given | 1000 team moves without gain: the team is taken to be stuck |

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::chain::MAX_ROBOTS;
use tautline_kernel::ground::Circle;

use tautline_io::named_values::NamedValues;

/// Which two robots have a link.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Links {
    /// One is in E_S of the other.
    Safe,
    /// One is in E_C of the other.
    Covered,
}

impl Links {
    /// The circle that decides it.
    pub const fn circle(self) -> Circle {
        match self {
            Self::Safe => Circle::SAFE,
            Self::Covered => Circle::COVERED,
        }
    }

    /// The environment's symbol in the paper.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Safe => "E_S",
            Self::Covered => "E_C",
        }
    }
}

/// Whether robots may plan to share a cell outside the base.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cells {
    /// They may not.
    Distinct,
    /// They may.
    Shared,
}

impl NamedValues for Cells {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Distinct, "distinct", "Robots plan to be in cells of their own, the base excepted"),
        (Self::Shared, "shared", "Robots may plan to share a cell"),
    ];
}

/// A robot's possible moves in a team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Moves {
    /// Cross one of four sides.
    Four,
    /// Cross one of four sides, or stay.
    Five,
}

/// Which team moves are compared.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Search {
    /// All of them: Full search.
    Full,
    /// So many: the null move and others drawn at random, each robot's move out of all as likely (Rooker and Birk).
    Pool(u32),
}

/// The null move's place in a pool.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Null {
    /// It stands by: it is made if all that are drawn have more faults than it has. So a team leaves a place where
    /// every team move makes its utility less: the paper's “random factor” (E).
    StandsBy,
    /// It counts with those that are drawn: a team in such a place never leaves it.
    Competes,
}

/// How a robot's next cell is valued.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Weights {
    /// The price of a side on the shortest way from there to an unexplored cell, over sides not known to be walls.
    pub distance: f64,
    /// The gain of a cell that is unexplored.
    pub new_cell: f64,
    /// How many times those of the first robot behind the base count: 1 with “equal weight”.
    pub leader: f64,
}

/// A team's way out when it has gained nothing for a while: neither an explored cell nor a wall.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Deadlock {
    /// It goes on: only ties are at random.
    Wait,
    /// It values all cells alike for some team moves, so that each legal team move is as likely.
    Scatter {
        /// After so many team moves without gain.
        after: u32,
        /// For so many team moves.
        moves: u32,
    },
}

/// Everything that a rival is told.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Parameters {
    /// Which team moves are compared.
    pub search: Search,
    /// The null move's place in a pool.
    pub null: Null,
    /// Which two robots have a link.
    pub links: Links,
    /// Whether they may share cells.
    pub cells: Cells,
    /// A robot's possible moves.
    pub moves: Moves,
    /// How cells are valued.
    pub weights: Weights,
    /// The team's way out when it is stuck.
    pub deadlock: Deadlock,
    /// Team moves without gain after which the run ends.
    pub patience: u32,
}

/// The pool of the paper.
pub const POOL: u32 = 1000;

/// The largest team that Full search takes, the base included: 5⁹ team moves.
pub const MOST_SEARCHED: usize = 10;

/// The largest pool.
pub const MOST_POOLED: u32 = 10_000_000;

/// Weights are no farther from 0, so that sums of them are exact.
pub const MOST_WEIGHT: f64 = 1000.0;

/// Weights are counted in millionths.
const PARTS: f64 = 1_000_000.0;

impl Parameters {
    /// Full search under E_S.
    pub const FULL: Self = Self {
        search: Search::Full,
        null: Null::StandsBy,
        links: Links::Safe,
        cells: Cells::Distinct,
        moves: Moves::Five,
        weights: Weights { distance: 1.0, new_cell: 0.0, leader: 1.0 },
        deadlock: Deadlock::Wait,
        patience: 1000,
    };

    /// Rooker and Birk's pool of 1000 under E_S.
    pub const POOL: Self = Self { search: Search::Pool(POOL), ..Self::FULL };

    /// These parameters with `links`.
    #[must_use]
    pub const fn linked(self, links: Links) -> Self {
        Self { links, ..self }
    }

    /// These parameters with this rule of cells.
    #[must_use]
    pub const fn in_cells(self, cells: Cells) -> Self {
        Self { cells, ..self }
    }

    /// These parameters with these moves.
    #[must_use]
    pub const fn with_moves(self, moves: Moves) -> Self {
        Self { moves, ..self }
    }

    /// Whether `robots`, the base included, can explore so.
    ///
    /// # Errors
    /// [`ParameterError`].
    pub fn check(&self, robots: usize) -> Result<(), ParameterError> {
        if !(2..=MAX_ROBOTS).contains(&robots) {
            return Err(ParameterError::Robots(robots));
        }
        let Weights { distance, new_cell, leader } = self.weights;
        for (name, weight) in [("distance", distance), ("new cell", new_cell), ("leader", leader)] {
            // A weight that is no number is not within either.
            if weight.is_nan() || weight.abs() > MOST_WEIGHT {
                return Err(ParameterError::Weight { name, weight });
            }
        }
        let walkers = robots - 1;
        match (self.moves, self.cells) {
            (Moves::Four, Cells::Distinct) if walkers > 4 => {
                return Err(ParameterError::NoFirstMove { walkers });
            }
            (Moves::Four | Moves::Five, Cells::Distinct | Cells::Shared) => {}
        }
        match self.search {
            Search::Full if robots > MOST_SEARCHED => {
                Err(ParameterError::TooMany { robots, moves: self.moves })
            }
            Search::Pool(0) => Err(ParameterError::EmptyPool),
            Search::Pool(pool) if pool > MOST_POOLED => Err(ParameterError::LargePool(pool)),
            Search::Full | Search::Pool(_) => Ok(()),
        }
    }
}

impl Weights {
    /// All cells are worth the same.
    pub const NONE: Self = Self { distance: 0.0, new_cell: 0.0, leader: 1.0 };

    /// The price of a cell so many sides from an unexplored one, in millionths.
    pub(super) fn price(self, distance: u32) -> i64 {
        let gain = if distance == 0 { parts(self.new_cell) } else { 0 };
        parts(self.distance) * i64::from(distance) - gain
    }

    /// The weights of one robot.
    pub(super) const fn of(self, leads: bool) -> Self {
        let times = if leads { self.leader } else { 1.0 };
        Self { distance: self.distance * times, new_cell: self.new_cell * times, ..self }
    }
}

fn parts(weight: f64) -> i64 {
    libm::round(weight * PARTS) as i64
}

/// Why a team cannot explore with its parameters.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ParameterError {
    /// There is no team of so many.
    Robots(usize),
    /// A weight that is no number, or too large.
    Weight {
        /// Of what.
        name: &'static str,
        /// The weight.
        weight: f64,
    },
    /// Four moves and cells of their own: there is no legal first team move.
    NoFirstMove {
        /// Robots besides the base.
        walkers: usize,
    },
    /// Full search would look at too many team moves.
    TooMany {
        /// Robots, the base included.
        robots: usize,
        /// The possible moves of each.
        moves: Moves,
    },
    /// A pool without a team move.
    EmptyPool,
    /// A pool that is too large.
    LargePool(u32),
}

impl ParameterError {
    /// The field of a setup that does not fit.
    pub const fn field(&self) -> &'static str {
        match self {
            Self::Robots(_) | Self::TooMany { .. } => "robots",
            Self::Weight { .. } | Self::NoFirstMove { .. } => "rule",
            Self::EmptyPool | Self::LargePool(_) => "pool",
        }
    }

    /// A hint at the right input.
    pub fn remedy(&self) -> String {
        match self {
            Self::Robots(_) => format!("give `robots` a number from 2 to {MAX_ROBOTS}"),
            Self::Weight { .. } => format!("give a number from -{MOST_WEIGHT} to {MOST_WEIGHT}"),
            Self::NoFirstMove { .. } => {
                "let robots stay (five moves), or share cells, or take at most 5 robots".to_owned()
            }
            Self::TooMany { .. } => {
                format!("take at most {MOST_SEARCHED} robots, or draw a pool: the scheme rooker-birk")
            }
            Self::EmptyPool | Self::LargePool(_) => format!("give a pool from 1 to {MOST_POOLED} team moves"),
        }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Robots(robots) => write!(f, "there is no team of {robots}, the base counted"),
            Self::Weight { name, weight } => write!(f, "the weight of a {name} is {weight}"),
            Self::NoFirstMove { walkers } => write!(
                f,
                "with four moves a robot there is no legal first team move: {walkers} robots cannot leave one cell \
                 by four sides into cells of their own"
            ),
            Self::TooMany { robots, moves } => {
                let base: u32 = match moves {
                    Moves::Four => 4,
                    Moves::Five => 5,
                };
                let power = robots as u32 - 1;
                write!(f, "full search of {robots} robots would look at {base}^{power}")?;
                match u128::from(base).checked_pow(power) {
                    Some(count) => write!(f, " = {count} team moves in each"),
                    None => f.write_str(" team moves in each"),
                }
            }
            Self::EmptyPool => f.write_str("a pool of no team moves"),
            Self::LargePool(pool) => write!(f, "a pool of {pool} team moves"),
        }
    }
}

impl std::error::Error for ParameterError {}
