//! The team moves that a rule admits, found for all cells of the leader at once.

use tautline_kernel::chain::{Condition, Rule};
use tautline_kernel::ground::{Area, Cell, Side, Step};

use super::cells::{cells_of, index};
use super::ground::Ground;
use super::limits::{MAX_CELLS, MAX_FOLLOWERS, TooLarge};
use crate::chain::environment::{in_covered, in_safe};

/// Followers R_2 … R_{N−1}, by the index of their cells.
pub(crate) type Followers = [u8; MAX_FOLLOWERS];

/// The team moves that a rule admits on a ground where every edge is known. Cells are indices, sets of them bits.
pub(crate) struct Relation {
    rule: Rule,
    pub(super) followers: usize,
    base: u8,
    width: u32,
    /// Cells whose eastern, and whose southern side is open.
    east: u128,
    south: u128,
    cells: Vec<Around>,
}

/// The surroundings of a cell.
struct Around {
    /// E_S, or everything if the rule has no *SafeAhead*.
    safe: u128,
    /// E_C, or everything if the rule has no *CoveredBehind*.
    covered: u128,
    /// Where a robot can be after a step.
    after: Vec<u8>,
}

/// The followers as they stand before a team move.
struct FollowerPlaces<'a> {
    from: &'a Followers,
    /// Cells with some of them, and with several; never the base.
    some: u128,
    several: u128,
}

/// Takes the followers' next cells, and all those that the leader can then be in.
type Sink<'a> = &'a mut dyn FnMut(&Followers, u128);

impl Relation {
    pub(crate) fn new(ground: &Ground, rule: &Rule) -> Result<Self, TooLarge> {
        let (area, base, robots) = (ground.area(), ground.base(), ground.robots());
        let cells = cells_of(area);
        if cells > MAX_CELLS {
            return Err(TooLarge::Cells { cells });
        }
        let followers = robots.saturating_sub(2);
        if followers > MAX_FOLLOWERS {
            return Err(TooLarge::Places);
        }
        let set = |cells: &mut dyn Iterator<Item = Cell>| {
            cells.filter_map(|cell| index(area, cell)).fold(0_u128, |set, index| set | 1 << index)
        };
        let environment = |condition, cell: Cell, is_in: fn(Cell, Cell) -> bool| {
            let near = area.around(cell, 2).into_iter().flat_map(Area::cells);
            if rule.has(condition) { set(&mut near.filter(|&other| is_in(cell, other))) } else { u128::MAX }
        };
        let open = |side| set(&mut area.cells().filter(|&cell| ground.admits(cell, Step::Cross(side))));
        let around = |cell: Cell| Around {
            safe: environment(Condition::SafeAhead, cell, in_safe),
            covered: environment(Condition::CoveredBehind, cell, in_covered),
            after: Step::ALL
                .into_iter()
                .filter(|&step| ground.admits(cell, step))
                .filter_map(|step| index(area, cell.after(step)).map(|index| index as u8))
                .collect(),
        };
        Ok(Self {
            rule: *rule,
            followers,
            base: index(area, base).unwrap_or(0) as u8,
            width: area.width() as u32,
            east: open(Side::East),
            south: open(Side::South),
            cells: area.cells().map(around).collect(),
        })
    }

    /// All robots in the base.
    pub(crate) fn start(&self) -> (Followers, u8) {
        let mut start = [0; MAX_FOLLOWERS];
        start[..self.followers].fill(self.base);
        (start, self.base)
    }

    /// The cells of the followers, as a set.
    pub(crate) fn cells(&self, followers: &Followers) -> u128 {
        followers[..self.followers].iter().fold(0, |cells, &cell| cells | 1 << cell)
    }

    /// Every team move with the followers in `from` and the leader in any of `leaders`.
    pub(crate) fn moves(&self, from: &Followers, leaders: u128, sink: Sink<'_>) {
        let mut now = FollowerPlaces { from, some: 0, several: 0 };
        for bit in from[..self.followers].iter().map(|&cell| 1 << cell & !(1 << self.base)) {
            now.several |= now.some & bit;
            now.some |= bit;
        }
        self.choose(&now, &mut [0; MAX_FOLLOWERS], (0, 0), (leaders, self.led(&now, leaders)), sink);
    }

    /// Chooses the step of follower number `follower` and of those ahead of it; those behind it take `taken`. `led` is
    /// where the leaders can go.
    fn choose(
        &self,
        now: &FollowerPlaces<'_>,
        to: &mut Followers,
        (follower, taken): (usize, u128),
        (leaders, led): (u128, u128),
        sink: Sink<'_>,
    ) {
        let (planned_behind, behind) = match follower.checked_sub(1) {
            Some(behind) => (to[behind], now.from[behind]),
            None => (self.base, self.base),
        };
        let safe = self.cells[usize::from(planned_behind)].safe & !taken;
        if follower == self.followers {
            sink(to, led & safe);
            return;
        }
        let at = now.from[follower];
        let may_enter = safe & self.cells[usize::from(behind)].covered;
        for &cell in &self.cells[usize::from(at)].after {
            let bit = 1 << cell;
            if may_enter & bit == 0 {
                continue;
            }
            to[follower] = cell;
            let is_guarded = self.rule.has(Condition::FullForFollower) && cell != at;
            // With one follower in it, the cell is full if the leader is there, too.
            let unhindered = match (now.some & bit != 0, now.several & bit != 0) {
                (true, false) if is_guarded => leaders & !bit,
                (true, true) if is_guarded => 0,
                _ => leaders,
            };
            let led = if unhindered == leaders { led } else { self.led(now, unhindered) };
            if led != 0 {
                let taken =
                    if self.rule.has(Condition::Distinct) { taken | bit & !(1 << self.base) } else { 0 };
                self.choose(now, to, (follower + 1, taken), (unhindered, led), sink);
            }
        }
    }

    /// Where leaders can go from where the robots are now.
    fn led(&self, now: &FollowerPlaces<'_>, leaders: u128) -> u128 {
        let moved = (leaders & self.east) << 1
            | leaders >> 1 & self.east
            | (leaders & self.south) << self.width
            | leaders >> self.width & self.south;
        let full = if self.rule.has(Condition::FullForLeader) { now.several } else { 0 };
        let behind = now.from[..self.followers].last().copied().unwrap_or(self.base);
        leaders | moved & self.cells[usize::from(behind)].covered & !full
    }
}
