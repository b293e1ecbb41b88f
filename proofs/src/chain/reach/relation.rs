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
        self.choose(from, &mut [0; MAX_FOLLOWERS], 0, leaders, self.led(from, leaders), sink);
    }

    /// Chooses the step of follower number `follower` and of those ahead of it. `led` is where the leaders can go.
    fn choose(
        &self,
        from: &Followers,
        to: &mut Followers,
        follower: usize,
        leaders: u128,
        led: u128,
        sink: Sink<'_>,
    ) {
        let (planned_behind, behind) = match follower.checked_sub(1) {
            Some(behind) => (to[behind], from[behind]),
            None => (self.base, self.base),
        };
        let (planned_behind, behind) =
            (&self.cells[usize::from(planned_behind)], &self.cells[usize::from(behind)]);
        let is_distinct = self.rule.has(Condition::Distinct);
        if follower == self.followers {
            let taken = if is_distinct { self.cells(to) & !(1 << self.base) } else { 0 };
            sink(to, led & planned_behind.safe & !taken);
            return;
        }
        let at = from[follower];
        for &cell in &self.cells[usize::from(at)].after {
            let is_taken = is_distinct && cell != self.base && to[..follower].contains(&cell);
            if (planned_behind.safe & behind.covered) >> cell & 1 == 0 || is_taken {
                continue;
            }
            to[follower] = cell;
            let is_guarded = self.rule.has(Condition::FullForFollower) && cell != self.base && cell != at;
            let others = from[..self.followers].iter().filter(|&&other| is_guarded && other == cell).count();
            // With one follower in it, the cell is full if the leader is there, too.
            let unhindered = match others {
                0 => leaders,
                1 => leaders & !(1 << cell),
                _ => 0,
            };
            let led = if unhindered == leaders { led } else { self.led(from, unhindered) };
            if led != 0 {
                self.choose(from, to, follower + 1, unhindered, led, sink);
            }
        }
    }

    /// Where leaders can go while the followers are in `from`.
    fn led(&self, from: &Followers, leaders: u128) -> u128 {
        let present = &from[..self.followers];
        let moved = (leaders & self.east) << 1
            | leaders >> 1 & self.east
            | (leaders & self.south) << self.width
            | leaders >> self.width & self.south;
        let (mut once, mut twice) = (0_u128, 0);
        if self.rule.has(Condition::FullForLeader) {
            for bit in present.iter().filter(|&&cell| cell != self.base).map(|&cell| 1 << cell) {
                twice |= once & bit;
                once |= bit;
            }
        }
        let behind = present.last().copied().unwrap_or(self.base);
        leaders | moved & self.cells[usize::from(behind)].covered & !twice
    }
}
