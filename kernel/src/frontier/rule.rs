//! The rule of frontier cells as a set of named conditions, with what the paper leaves open as parameters.

use core::f64::consts::FRAC_PI_2;

use super::place::{Occupancy, Threshold};
use crate::conditions;
use crate::ground::Cell;
use crate::position::{Belief, Gate, Odometry, Point};

conditions! {
    /// One condition of the rule, by the sentence it stands for. As published there are none but [`Condition::Record`]
    /// and [`Condition::Detour`], and not even the first one if the paper's avoidance of obstacles is taken literally.
    pub enum Condition of Rule in u32 {
        /// Repair: a robot without an unexplored neighbour goes through explored cells, the shortest way to the nearest
        /// unexplored one.
        Route,
        /// A cell that a robot has tried to enter in vain is stored as an obstacle. Taken literally, the robot goes on
        /// “until it reaches the destination which is the midpoint of the frontier cell”.
        Record,
        /// Repair: a robot looks before it enters, and enters no cell that has a robot in it, or one that is entering
        /// it.
        Look,
        /// Repair: a robot that has met another one tries again only in its own slot. A slot is at least as long as the
        /// longest move.
        Turn,
        /// Repair: a robot that was met is no obstacle.
        Tell,
        /// Repair: a robot counts its cell by its moves; a fix corrects its place within the cell alone.
        Track,
        /// Repair: a message has the whole repository of its sender, and whoever hears it joins both. As published it
        /// has the one cell that the sender has explored or found blocked.
        Share,
        /// Preference: robots and unexplored cells are paired, the nearest pair first, and a robot goes to the cell of
        /// its pair: so it leaves to another robot a cell to which that one is nearer.
        Nearer,
        /// Preference: of pairs as near, the one comes first whose robot has claimed the cell: it keeps its aim.
        Claim,
        /// Preference: of pairs as near, the one comes first whose cell has the fewest unexplored neighbours, and of
        /// these the one whose cell is nearest to the rim of the area: nobody has to come back for it.
        Corner,
        /// Repair: wheels and fixes are fused, each by its covariance. Without it a fix is believed as it is.
        Fuse,
        /// Repair: a fix that the robot's belief makes so unlikely as one in a thousand is left out.
        Gate,
        /// Repair: a robot moves only if by its belief it arrives within the next cell, with four standard deviations
        /// to spare along each axis. Otherwise it stands and takes another fix.
        Sure,
        /// A robot goes round an obstacle that is smaller than a cell: it turns by 90°, takes five steps, turns back,
        /// and goes on. Without it such an obstacle is stored as one that fills the cell beyond.
        Detour,
        /// Repair: what the others have told lapses for a robot to which they leave no cell, since it may be old: the
        /// robot goes to the cell that comes first for it. Without it the robot stands until it hears more.
        Lapse,
        /// Repair: a robot that has learned nothing since it last looked goes to no cell that is farther than the one
        /// it has claimed, and to a nearest one if it has claimed none, as after it has met another robot. So each move
        /// leads nearer to a cell that is left, whatever the others have told.
        Keep,
        /// Repair: a robot at the rim of a cell that it took for unexplored, and that its map has for explored by then,
        /// turns back: another one has been there.
        Return,
        /// Repair: a robot that answers nothing is dead, and its cell is closed to the others for good.
        Bypass,
    }
}

/// The action of a robot without a candidate, where it knows no [`Condition::Route`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Otherwise {
    /// It stops for good: the paper says nothing else.
    Stops,
    /// It goes to any explored neighbour.
    Wanders,
}

/// The basis of the threshold T: the paper has it “decided based on previous probability values”. T is given before the
/// first decision.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Basis {
    /// No values: T stays as it is given.
    Given,
    /// The mean of the values at the last decision, of the four neighbours of the
    /// robot's cell, which are what step 5 checks.
    Neighbours,
    /// The mean of those and of the value of the robot's own cell.
    Cells,
}

/// Which of several cells a robot takes that are as good.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Ties {
    /// The one with the lowest number: cells are numbered row by row.
    Lowest,
    /// Any: a search looks at all of them.
    Any,
}

/// The rule of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    /// The conditions in force.
    pub conditions: Conditions,
    /// How the occupancy probability is computed.
    pub occupancy: Occupancy,
    /// A cell is a candidate if its occupancy probability is below this one.
    pub threshold: Threshold,
    /// How that one follows from earlier probabilities.
    pub basis: Basis,
    /// The action of a robot without a candidate.
    pub otherwise: Otherwise,
    /// Which of several cells it takes.
    pub ties: Ties,
}

/// The five steps of a [`Condition::Detour`], in sides of a cell. This value is ours: half a side would lead to the rim
/// of the next cell.
pub const FIVE_STEPS: f64 = 0.25;

/// A detour about an obstacle that is smaller than a cell, for a robot that heads for its destination: turns in
/// radians, each with the way after it. The robot turns to its right, takes five steps, and turns back.
pub const DETOUR: [(f64, f64); 2] = [(FRAC_PI_2, FIVE_STEPS), (-FRAC_PI_2, 0.0)];

/// The standard deviations along each axis that a robot keeps between where it arrives and the rim of the cell.
pub const SURE_DEVIATIONS: f64 = 4.0;

/// The midpoint of a cell, in sides of a cell.
pub fn midpoint(cell: Cell) -> Point {
    Point::new(cell.x.into(), cell.y.into())
}

impl Rule {
    /// Whether a robot with this belief, in sides of a cell, may go to the midpoint of `to`; else it stands and takes
    /// another fix ([`Condition::Sure`]).
    pub fn may_go(&self, belief: &Belief, to: Cell, odometry: &Odometry) -> bool {
        if !self.has(Condition::Sure) {
            return true;
        }
        let mut arrived = *belief;
        let (turn, way) = arrived.towards(midpoint(to));
        arrived.turned(turn, odometry);
        arrived.driven(way, odometry);
        SURE_DEVIATIONS * arrived.deviation_m() < 0.5
    }

    /// Whether fixes are compared with the belief.
    pub const fn gate(&self) -> Gate {
        if self.has(Condition::Gate) { Gate::Closed } else { Gate::Open }
    }

    /// The rule as the paper publishes it, where unclear by the readings in its favour; a robot without a candidate
    /// stops.
    pub const PUBLISHED: Self = Self {
        conditions: Conditions::of(&[Condition::Record, Condition::Detour]),
        occupancy: Occupancy::Corrected,
        threshold: Threshold::HALF,
        basis: Basis::Given,
        otherwise: Otherwise::Stops,
        ties: Ties::Lowest,
    };

    /// As [`Self::PUBLISHED`], where a robot without a candidate wanders.
    pub const WANDERS: Self = Self { otherwise: Otherwise::Wanders, ..Self::PUBLISHED };

    /// As [`Self::PUBLISHED`], with the avoidance of obstacles taken literally.
    pub const LITERAL: Self = Self::PUBLISHED.without(Condition::Record);

    /// As [`Self::PUBLISHED`], with equation (11) as it is printed.
    pub const PRINTED: Self = Self { occupancy: Occupancy::Printed, ..Self::PUBLISHED };

    /// With all repairs and preferences.
    pub const REPAIRED: Self = Self { conditions: Conditions::of(&Condition::ALL), ..Self::PUBLISHED };

    /// With all repairs, without preferences and what they need: of several nearest cells any may be taken.
    pub const PLAIN: Self = Self {
        ties: Ties::Any,
        ..Self::REPAIRED
            .without(Condition::Nearer)
            .without(Condition::Claim)
            .without(Condition::Corner)
            .without(Condition::Lapse)
            .without(Condition::Keep)
    };
}
