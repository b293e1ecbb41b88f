//! One robot: what it knows, what it is about, and what it does next.

use core::ops::ControlFlow;

use super::map::{BY_NUMBER, Map, Status, TinyMap};
use super::pairs::{Pairing, Scratch, Seeker};
use super::place::{Place, Threshold};
use super::rule::{Basis, Condition, Otherwise, Rule, Ties};
use super::search::{Target, Way, search};
use crate::choice::Oracle;
use crate::ground::{Cell, Side};

/// A robot's state of motion.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Stance {
    /// It stands in its cell.
    Stands,
    /// It is at the rim of its cell and looks into the one beyond this side: for
    /// those who look too, it is entering that one.
    Tries(Side),
    /// It moves to the cell beyond this side.
    Enters(Side),
}

/// A robot's sight of the cell that it is about to enter.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Sight {
    /// Nothing is in the way.
    Open,
    /// An obstacle that fills the cell, or the rim of the area.
    Obstacle,
    /// An obstacle that is smaller than a cell, so that there is a way beside it.
    Small,
    /// Another robot, in the cell or entering it.
    Robot,
    /// One that answers nothing.
    Silent,
}

/// A robot's next action.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Next {
    /// It goes to the rim of its cell at this side, on its way to an unexplored
    /// cell: tell what it sees by [`Robot::looked`].
    Tries {
        /// The side.
        side: Side,
        /// Where it is going in the end.
        aim: Cell,
    },
    /// It waits for its slot, or for what the others say.
    Waits,
    /// It has no candidate, and stops for good, not knowing whether anything is left.
    Stops,
    /// It knows that no cell is left that it could explore.
    Done,
}

/// Another robot, as far as it has told.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Other {
    /// The cell that it is in.
    pub cell: Cell,
    /// Where it is.
    pub place: Place,
    /// Which unexplored cell it has claimed.
    pub aim: Option<Cell>,
}

/// A robot's knowledge besides its repository when it decides.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct View<'a> {
    /// The others.
    pub others: &'a [Other],
    /// Whose slot it is.
    pub slot: Slot,
}

/// Whose slot it is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Slot {
    /// The robot's own.
    Own,
    /// Another one's.
    Others,
}

/// A robot that explores cells.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Robot<M> {
    /// Its map; it has no news of what others change there.
    pub map: M,
    at: Cell,
    stance: Stance,
    aim: Option<Cell>,
    waits: bool,
    /// Whether it has learned anything since it last looked, or will have when it
    /// arrives, as far as its rule asks for that.
    has_news: bool,
    /// The threshold of its next decision, if its rule bases it on the last one.
    threshold: Option<Threshold>,
}

impl<M: Map> Robot<M> {
    /// A robot in its start, all of which are explored; it knows nothing else of `map`.
    pub fn new(mut map: M, start: Cell, starts: &[Cell]) -> Self {
        for &cell in starts.iter().chain([&start]) {
            map.learn(cell, Status::Explored);
        }
        let stance = Stance::Stands;
        Self { map, at: start, stance, aim: None, waits: false, has_news: true, threshold: None }
    }

    /// The cell in which it takes itself to be.
    pub const fn at(&self) -> Cell {
        self.at
    }

    /// The cell that it is entering by its count, or that it is in.
    pub const fn entering(&self) -> Cell {
        if let Stance::Enters(side) = self.stance { self.at.beyond(side) } else { self.at }
    }

    /// Whether it stands, looks beyond a side of its cell, or enters the next one.
    pub const fn stance(&self) -> Stance {
        self.stance
    }

    /// The unexplored cell that it has claimed.
    pub const fn aim(&self) -> Option<Cell> {
        self.aim
    }

    /// Whether it waits for its slot.
    pub const fn waits(&self) -> bool {
        self.waits
    }

    /// The next action, if the robot stands.
    pub fn next(
        &self,
        rule: &Rule,
        view: View<'_>,
        scratch: &mut Scratch<'_>,
        oracle: &mut dyn Oracle,
    ) -> Next {
        let way = match (rule.has(Condition::Route), rule.ties) {
            (false, _) => return self.candidate(rule, view, oracle),
            (true, Ties::Lowest) => self.preferred(rule, view, scratch),
            (true, Ties::Any) => self.any_nearest(scratch, oracle).map(Way::Paired),
        };
        self.follows(rule, way, view.slot)
    }

    /// The next action, if the robot stands, where `way` leads to an unexplored cell, or is `None` if it reaches none:
    /// for a caller who knows the pairs of the whole team. [`Self::next`] finds them for one robot.
    pub const fn follows(&self, rule: &Rule, way: Option<Way>, slot: Slot) -> Next {
        match (way, slot) {
            (None, _) => Next::Done,
            (Some(_), Slot::Others) if self.waits => Next::Waits,
            (Some(Way::Taken(_)), _) if !rule.has(Condition::Lapse) => Next::Waits,
            (Some(Way::Paired(to) | Way::Taken(to) | Way::Near(to)), Slot::Own | Slot::Others) => {
                Next::Tries { side: to.first, aim: to.cell }
            }
        }
    }

    /// The frontier cell: the unexplored neighbour with the lowest occupancy
    /// probability, if one is below the threshold.
    fn candidate(&self, rule: &Rule, view: View<'_>, oracle: &mut dyn Oracle) -> Next {
        let threshold = self.threshold.unwrap_or(rule.threshold);
        let neighbours = BY_NUMBER.map(|side| (side, self.at.beyond(side)));
        let candidates = neighbours.map(|(side, cell)| {
            let occupancy = self.occupancy(rule, view.others, cell);
            let is_one = self.map.status(cell) == Status::Unexplored && threshold.is_above(occupancy);
            is_one.then_some((occupancy, side, cell))
        });
        let least = candidates.iter().flatten().map(|&(occupancy, ..)| occupancy).min();
        let best = candidates.map(|candidate| candidate.filter(|&(occupancy, ..)| Some(occupancy) == least));
        let chosen = match rule.ties {
            Ties::Lowest => best.into_iter().flatten().next(),
            Ties::Any => any(best, oracle),
        };
        if let Some((_, side, aim)) = chosen {
            return Next::Tries { side, aim };
        }
        let explored = neighbours.map(|(side, cell)| {
            (self.map.status(cell) == Status::Explored).then_some(Next::Tries { side, aim: cell })
        });
        match rule.otherwise {
            Otherwise::Wanders => any(explored, oracle).unwrap_or(Next::Stops),
            Otherwise::Stops => Next::Stops,
        }
    }

    /// The occupancy probability of `cell`, in units of 1 / [`HALF`](super::HALF): the highest by any robot.
    fn occupancy(&self, rule: &Rule, others: &[Other], cell: Cell) -> u16 {
        let own = rule.occupancy.of(cell, Place::midpoint(self.at));
        others.iter().map(|other| rule.occupancy.of(cell, other.place)).fold(own, u16::max)
    }

    /// Bases the threshold of its next decision on the probabilities of this one, if its rule does: to be called before
    /// [`Self::tries`], with the `others` of the decision.
    pub fn decided(&mut self, rule: &Rule, others: &[Other]) {
        let own = match rule.basis {
            Basis::Given => return,
            Basis::Neighbours => None,
            Basis::Cells => Some(self.at),
        };
        let cells = BY_NUMBER.into_iter().map(|side| self.at.beyond(side)).chain(own);
        self.threshold = Some(Threshold::mean(cells.map(|cell| self.occupancy(rule, others, cell))));
    }

    /// The way to the unexplored cell that it is paired with, or to the one that comes first for
    /// it. The nearest pair comes first: so the robot that is nearest to an unexplored cell goes
    /// there, and none that stands can be in its way.
    fn preferred(&self, rule: &Rule, view: View<'_>, scratch: &mut Scratch<'_>) -> Option<Way> {
        let own = Seeker { cell: self.at, aim: self.aim };
        let others = if rule.has(Condition::Nearer) { view.others } else { &[] };
        let others = others.iter().map(|other| Seeker { cell: other.cell, aim: other.aim });
        let Scratch { search: memory, pairs } = scratch;
        Pairing { map: &self.map, rule, own, is_bound: self.is_bound(rule), others, memory, pairs }.found()
    }

    /// Whether it goes to no cell that is farther than the one it has claimed, or
    /// than a nearest one if it has claimed none.
    pub const fn is_bound(&self, rule: &Rule) -> bool {
        rule.has(Condition::Keep) && !self.has_news
    }

    /// Any of the first moves of the shortest ways to the nearest unexplored cells.
    fn any_nearest(&self, scratch: &mut Scratch<'_>, oracle: &mut dyn Oracle) -> Option<Target> {
        let ways = BY_NUMBER.map(|side| {
            let cell = self.at.beyond(side);
            match self.map.status(cell) {
                Status::Obstacle | Status::Body => None,
                Status::Unexplored => Some(Target { cell, distance: 1, first: side }),
                Status::Explored => {
                    let mut way = None;
                    search(&self.map, cell, u32::MAX, &mut scratch.search, |found| {
                        way = Some(Target { distance: found.distance + 1, first: side, ..found });
                        ControlFlow::Break(())
                    });
                    way
                }
            }
        });
        let least = ways.iter().flatten().map(|way| way.distance).min()?;
        any(ways.map(|way| way.filter(|way| way.distance == least)), oracle)
    }

    /// It goes to the rim of its cell at `side`, and claims `aim`.
    pub const fn tries(&mut self, side: Side, aim: Cell) {
        self.stance = Stance::Tries(side);
        self.aim = Some(aim);
    }

    /// It has looked into the cell that it was about to enter: it enters it, or stays. After a detour it is on its way
    /// still, and keeps what it has claimed.
    pub fn looked(&mut self, rule: &Rule, sight: Sight) {
        let Stance::Tries(side) = self.stance else { return };
        let cell = self.at.beyond(side);
        let is_explored = self.map.status(cell) == Status::Explored;
        let returns = is_explored && self.aim == Some(cell) && rule.has(Condition::Return);
        self.has_news = sight == Sight::Open && (returns || !is_explored) || !rule.has(Condition::Keep);
        let enters = sight == Sight::Open && !returns;
        self.stance = if enters { Stance::Enters(side) } else { Stance::Stands };
        let is_dead = sight == Sight::Silent && rule.has(Condition::Bypass);
        self.waits = matches!(sight, Sight::Robot | Sight::Silent) && !is_dead && rule.has(Condition::Turn);
        let status = match sight {
            Sight::Open if enters => return,
            Sight::Small if rule.has(Condition::Detour) => return,
            Sight::Silent if is_dead => Status::Body,
            Sight::Robot | Sight::Silent if rule.has(Condition::Tell) => Status::Unexplored,
            Sight::Open => Status::Unexplored,
            Sight::Obstacle | Sight::Small | Sight::Robot | Sight::Silent => Status::Obstacle,
        };
        if rule.has(Condition::Record) {
            self.hears(cell, status);
        }
        self.aim = None;
    }

    /// It has arrived, and `fix` is the cell that its position is taken for.
    pub fn arrived(&mut self, rule: &Rule, fix: Cell) {
        let Stance::Enters(side) = self.stance else { return };
        self.at = if rule.has(Condition::Track) { self.at.beyond(side) } else { fix };
        self.stance = Stance::Stands;
        self.aim = self.aim.filter(|&aim| rule.has(Condition::Claim) && aim != self.at);
        self.hears(self.at, Status::Explored);
    }

    /// It hears that `cell` has this status.
    pub fn hears(&mut self, cell: Cell, status: Status) {
        let before = self.map.status(cell);
        self.map.learn(cell, status);
        self.has_news |= self.map.status(cell) != before;
    }
}

impl Robot<TinyMap> {
    /// It hears all that another one knows.
    pub fn hears_all(&mut self, known: &TinyMap) {
        let before = self.map;
        self.map.join(known);
        self.has_news |= self.map != before;
    }
}

/// Any of those that there are, each as likely.
fn any<T, const SIDES: usize>(options: [Option<T>; SIDES], oracle: &mut dyn Oracle) -> Option<T> {
    let of = options.iter().flatten().count() as u32;
    let number = if of > 0 { oracle.pick(of) } else { 0 };
    options.into_iter().flatten().nth(number as usize)
}
