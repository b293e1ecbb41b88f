//! Re-forming behind a robot that has died (ours). The barrier has stopped the team in contact (CHAIN-20,
//! CHAIN-19). Behind a mute R_d the robots R_1 … R_{d−1} stay, and those ahead take their own moves back
//! until R_{d+1} is in contact with R_{d−1}; if that does not come about, the robots behind come home, too.
//! Then the chain goes on with one robot fewer. Within each of the two parts neighbours are always in
//! contact: each part is where it was before (CHAIN-21).

use super::message::{Damage, Message};
use super::past::Past;
use super::reel::Reel;
use super::team::{Chain, Stage};
use crate::error::sentences;
use crate::ground::{Cell, Edge, EdgeMark, Grid, Step};

/// Why a chain cannot re-form.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ReformError {
    /// There is no such robot beside the base. Robots are numbered from 1, the base.
    NoRobot {
        /// The robot.
        robot: usize,
        /// Robots that there are, the base included.
        robots: usize,
    },
    /// The base alone is left without that robot.
    TooFew,
    /// The history of the chain does not begin in the base: it has re-formed before and not come home since, or a wall
    /// has shut its way back.
    NoWayHome,
    /// The log is not as long as the run.
    Damaged(Damage),
    /// The two parts are not in contact yet.
    Apart,
}

sentences!(ReformError {
    Self::NoRobot { robot, robots } => "R_{robot} cannot fail: name a robot from 2 to {robots}";
    Self::TooFew => "without that robot there is no chain: it needs at least 2 robots";
    Self::NoWayHome => "the log does not lead back to the base: leave the robots where they are";
    Self::Damaged(damage) => "{damage}";
    Self::Apart => "the two parts are not in contact yet: take more moves back";
});

/// The two parts of a chain that has lost a robot, and how far each has taken its moves back in the log of then.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Parts {
    /// The place of the mute robot, the base being in place 0.
    mute: usize,
    /// Robots beside the base, the mute one included.
    movers: usize,
    /// The log entries that the part ahead, and the part behind, would take back next.
    ahead: Option<u32>,
    behind: Option<u32>,
}

/// A chain while it re-forms.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Reformation<G, const ROBOTS: usize> {
    /// The robots that are left.
    chain: Chain<G, ROBOTS>,
    parts: Parts,
}

impl<G: Grid, const ROBOTS: usize> Reformation<G, ROBOTS> {
    /// Where the robots that are left are, the base first.
    pub fn cells(&self) -> &[Cell] {
        self.chain.cells()
    }

    /// The map that they know.
    pub const fn grid(&self) -> &G {
        self.chain.grid()
    }

    /// How many of them are behind the mute robot.
    pub const fn behind(&self) -> usize {
        self.parts.mute
    }

    /// Takes one more team move back, of the part ahead as long as it has one, then of the part behind. `log` is that
    /// of the chain before the failure. Returns whether there was one.
    ///
    /// # Errors
    /// [`Damage`] if an entry of the log is no messages, or leads over a side that nobody is known to have crossed.
    pub fn take_back(&mut self, log: &[u8]) -> Result<bool, Damage> {
        let Parts { mute, movers, ahead, behind } = self.parts;
        let (entry, part) = match (ahead, behind) {
            (Some(entry), _) => (entry, mute + 1..movers + 1),
            (None, Some(entry)) => (entry, 1..mute),
            (None, None) => return Ok(false),
        };
        let first = entry as usize * movers;
        let mut cells = self.chain.cells;
        for robot in part {
            let sent = first + movers;
            let byte = *log.get(first + robot - 1).ok_or(Damage::Length { bytes: log.len(), sent })?;
            let place = if robot > mute { robot - 1 } else { robot };
            let back = Message::decode(byte)?.made().reverse();
            if let Step::Cross(side) = back
                && !self.chain.grid.edge_has(EdgeMark::Open, Edge::new(cells[place], side))
            {
                return Err(Damage::OtherWorld(robot + 1));
            }
            cells[place] = cells[place].after(back);
        }
        self.chain.cells = cells;
        let next = if ahead.is_some() { &mut self.parts.ahead } else { &mut self.parts.behind };
        *next = Past::Home.open_before(entry, log, movers);
        Ok(true)
    }

    /// Whether the chain can go on: neighbours are in contact, and no three robots in one cell.
    pub fn is_formed(&self) -> bool {
        let (rule, cells) = (self.chain.rule(), self.cells());
        let in_contact = cells.windows(2).all(|pair| rule.keeps_contact(pair[0], pair[1]));
        let is_crowded =
            |cell: &Cell| *cell != cells[0] && cells.iter().filter(|other| *other == cell).count() > 2;
        in_contact && !cells.iter().any(is_crowded)
    }

    /// The chain with one robot fewer. It knows what it knew, and its log begins anew: it takes back no move from
    /// before. And what is needed to bring it home for that: see [`Chain::come_home`].
    ///
    /// # Errors
    /// [`ReformError::Apart`] if it is not [formed](Reformation::is_formed).
    pub fn formed(self) -> Result<(Chain<G, ROBOTS>, Parts), ReformError> {
        if !self.is_formed() {
            return Err(ReformError::Apart);
        }
        let is_home = self.parts.ahead.is_none() && self.parts.behind.is_none();
        let past = if is_home { Past::Home } else { Past::Since(0) };
        Ok((Chain { past, ..self.chain }, self.parts))
    }
}

impl<G: Grid, const ROBOTS: usize> Chain<G, ROBOTS> {
    /// Begins to re-form without `robot`, numbered from 1, the base. `log` holds the messages of all team moves; what
    /// it says of that robot is not read.
    ///
    /// # Errors
    /// [`ReformError`] if there is no such robot, too few are left, or the log does not lead home.
    pub fn reform(self, robot: usize, log: &[u8]) -> Result<Reformation<G, ROBOTS>, ReformError> {
        let (robots, sent) = (self.robots, self.sent());
        if !(2..=robots).contains(&robot) {
            return Err(ReformError::NoRobot { robot, robots });
        }
        if robots < 3 {
            return Err(ReformError::TooFew);
        }
        if self.past != Past::Home {
            return Err(ReformError::NoWayHome);
        }
        if log.len() != sent {
            return Err(ReformError::Damaged(Damage::Length { bytes: log.len(), sent }));
        }
        let mute = robot - 1;
        let mut cells = self.cells;
        cells.copy_within(robot..robots, mute);
        let (ahead, behind) = (self.last_open, self.last_open);
        let parts = Parts { mute, movers: robots - 1, ahead, behind };
        Ok(Chain { cells, robots: robots - 1, ..self }.parted(parts))
    }

    /// Whether it has re-formed elsewhere than in the base, and taken back all its moves since.
    pub fn can_come_home(&self) -> bool {
        self.past == Past::Since(0) && self.last_open.is_none()
    }

    /// Begins to bring a chain home that [can come home](Chain::can_come_home): it is to take back the moves from
    /// before, too. `None` if it cannot.
    pub fn come_home(self, parts: Parts) -> Option<Reformation<G, ROBOTS>> {
        self.can_come_home().then(|| self.parted(parts))
    }

    /// The chain in two parts, its log at the beginning.
    fn parted(self, parts: Parts) -> Reformation<G, ROBOTS> {
        let chain = Self { moves: 0, last_open: None, stage: Stage::Gained, reel: Reel::NONE, ..self };
        Reformation { chain, parts }
    }
}
