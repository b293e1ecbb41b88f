//! CHAIN-2, CHAIN-7, CHAIN-13, CHAIN-19, CHAIN-21 and CHAIN-22, of a reel in which something fails.

use std::collections::BTreeSet;

use super::{BrokenClause, Floor, Place, SIDES, add, broken};

/// A mishap of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Trouble {
    /// Nothing, or bytes are lost, or robots go one by one.
    None,
    /// The robot of this number, the base being 0, dies in this team move, counted from 1.
    Death(usize, u32),
    /// A wall appears on this side; it stands from this team move on.
    Wall([Place; 2], u32),
}

/// A run of a chain, as far as it is heard.
pub(crate) struct Chain<'a> {
    floor: &'a Floor,
    trouble: Trouble,
    cells: Vec<Place>,
    explored: BTreeSet<Place>,
    moves: u32,
    /// Team moves that are not taken back.
    kept: u32,
    /// How many may still be taken back while two parts re-form, if they do.
    parts: Option<u32>,
}

impl<'a> Chain<'a> {
    pub(crate) fn new(floor: &'a Floor, base: Place, robots: usize, trouble: Trouble) -> Self {
        let (cells, explored) = (vec![base; robots], BTreeSet::from([base]));
        Self { floor, trouble, cells, explored, moves: 0, kept: 0, parts: None }
    }

    /// The robot that has died, if one has.
    fn dead(&self) -> Option<usize> {
        match self.trouble {
            Trouble::Death(robot, at) if at <= self.moves => Some(robot),
            Trouble::None | Trouble::Death(..) | Trouble::Wall(..) => None,
        }
    }

    /// Hears of a team move: whether it takes one back, and where all are after it.
    pub(crate) fn hear(&mut self, takes_back: bool, after: &[Place]) -> Result<(), BrokenClause> {
        self.moves += 1;
        let before = std::mem::replace(&mut self.cells, after.to_vec());
        self.explored.extend(after);
        self.walks(&before)?;
        let dead = self.dead();
        let dies = matches!(self.trouble, Trouble::Death(_, at) if at == self.moves);
        let contact = match (self.trouble, dead) {
            (Trouble::Wall(..), _) => "CHAIN-22",
            (_, Some(_)) => "CHAIN-21",
            (Trouble::None | Trouble::Death(..), None) => "CHAIN-19",
        };
        if dead.is_some() && !dies {
            self.re_form(takes_back)?;
        } else if takes_back {
            self.kept = self.kept.saturating_sub(1);
        } else {
            self.kept += 1;
        }
        if dies {
            self.parts = Some(2 * self.kept);
        }
        let living: Vec<usize> = (0..self.cells.len()).filter(|&robot| Some(robot) != dead).collect();
        // In the team move in which it dies a robot is still on its way, and nobody has to be in contact across it any
        // more.
        let groups: Vec<&[usize]> = match (dead, self.parts) {
            (Some(dead), Some(_)) => {
                let (behind, ahead) = living.split_at(dead);
                vec![behind, ahead]
            }
            (Some(_), None) | (None, _) => vec![&living[..]],
        };
        for group in groups {
            for pair in group.windows(2) {
                let ends = |robot: usize| [before[robot], self.cells[robot]];
                let is_far = ends(pair[0])
                    .iter()
                    .any(|&one| ends(pair[1]).iter().any(|&other| !is_covered(one, other)));
                broken(is_far, contact, || format!("robots {pair:?} in team move {}", self.moves))?;
            }
            let is_full = |cell: Place| group.iter().filter(|&&robot| self.cells[robot] == cell).count() > 2;
            let crowded = group
                .iter()
                .map(|&robot| self.cells[robot])
                .find(|&cell| cell != self.base() && is_full(cell));
            broken(crowded.is_some(), "CHAIN-2", || format!("{crowded:?} in team move {}", self.moves))?;
        }
        if self.parts.is_some() && self.is_formed(&living) {
            (self.parts, self.kept) = (None, 0);
        }
        Ok(())
    }

    /// A team move after a death: of a chain of one robot fewer, or of two parts that take their moves back.
    fn re_form(&mut self, takes_back: bool) -> Result<(), BrokenClause> {
        let at = self.moves;
        match (&mut self.parts, takes_back) {
            (Some(left), true) => {
                broken(*left == 0, "CHAIN-21", || format!("too many are taken back in team move {at}"))?;
                *left -= 1;
            }
            (Some(_), false) => {
                return Err(("CHAIN-21", format!("parts out of contact go on in team move {at}")));
            }
            // The history of this chain is used up: its parts come home, each by its own from before.
            (None, true) if self.kept == 0 => self.parts = Some(u32::MAX),
            (None, true) => self.kept -= 1,
            (None, false) => self.kept += 1,
        }
        Ok(())
    }

    /// Each robot stays or crosses an open side, but not the base, nor one that has died.
    fn walks(&self, before: &[Place]) -> Result<(), BrokenClause> {
        let leaps = self.floor.leaps(before, &self.cells);
        broken(leaps.is_some(), "CHAIN-22", || format!("robot {leaps:?} leaps in team move {}", self.moves))?;
        let stands = |robot: usize| robot == 0 || Some(robot) == self.dead();
        let goes = (0..self.cells.len()).find(|&robot| stands(robot) && before[robot] != self.cells[robot]);
        broken(goes.is_some(), "CHAIN-21", || format!("robot {goes:?} goes in team move {}", self.moves))?;
        if let Trouble::Wall(wall, at) = self.trouble
            && at <= self.moves
        {
            let crosses = |(&from, &to): (&Place, &Place)| [from, to] == wall || [to, from] == wall;
            let is_crossed = before.iter().zip(&self.cells).any(crosses);
            broken(is_crossed, "CHAIN-22", || format!("a wall is crossed in team move {}", self.moves))?;
        }
        Ok(())
    }

    fn base(&self) -> Place {
        self.cells[0]
    }

    /// Whether robots beside each other in their order are in contact, and no three share a cell.
    fn is_formed(&self, living: &[usize]) -> bool {
        let cells: Vec<Place> = living.iter().map(|&robot| self.cells[robot]).collect();
        let is_full =
            |cell: &&Place| **cell != cells[0] && cells.iter().filter(|other| other == cell).count() > 2;
        cells.windows(2).all(|pair| is_covered(pair[0], pair[1])) && !cells.iter().any(|cell| is_full(&cell))
    }

    /// Hears that the run is over, by itself or not.
    pub(crate) fn end(&self, by_itself: bool) -> Result<(), BrokenClause> {
        let clause = match (self.trouble, self.dead()) {
            (Trouble::Wall(..), _) => return broken(!by_itself, "CHAIN-22", || "the run goes on".to_owned()),
            (_, Some(_)) => "CHAIN-21",
            (Trouble::None | Trouble::Death(..), None) => "CHAIN-13",
        };
        broken(!by_itself, "CHAIN-7", || "the run goes on".to_owned())?;
        broken(self.parts.is_some(), "CHAIN-21", || "the parts are out of contact in the end".to_owned())?;
        let links = self.cells.len() - 1 - usize::from(self.dead().is_some());
        let left = self.within_reach(links).into_iter().find(|place| !self.explored.contains(place));
        broken(left.is_some(), clause, || format!("{left:?} is within reach and unexplored"))
    }

    /// The places so many links from the base.
    fn within_reach(&self, links: usize) -> BTreeSet<Place> {
        let is_turn = |one: Place, other: Place| one.0 * other.0 + one.1 * other.1 == 0;
        let (mut reached, mut rim) = (BTreeSet::from([self.base()]), vec![self.base()]);
        for _ in 0..links {
            let mut next = Vec::new();
            for from in rim {
                for one in SIDES {
                    let beside = add(from, one);
                    if !self.floor.is_open(from, beside) {
                        continue;
                    }
                    let corners = SIDES
                        .into_iter()
                        .filter(|&other| is_turn(one, other))
                        .map(|other| add(beside, other));
                    let linked = corners.filter(|&corner| self.floor.is_open(beside, corner)).chain([beside]);
                    next.extend(linked.filter(|&place| reached.insert(place)));
                }
            }
            rim = next;
        }
        reached
    }
}

/// E_C: the block of nine cells, and the four cells two steps straight ahead.
fn is_covered(one: Place, other: Place) -> bool {
    let (x, y) = ((one.0 - other.0).abs(), (one.1 - other.1).abs());
    x.max(y) <= 1 || x + y == 2
}
