//! One action of an agent: it scans, marks its cell, and goes on. Reading, writing and the registration in the next
//! cell are one step: two agents whose scans overlap take turns (BRICKS-3).

use super::lap::Lap;
use super::marking::{blocks, is_thin};
use super::rule::{Condition, Precedence, Rule};
use crate::ants::least_crossed;
use crate::choice::Source;
use crate::floor::{COMPASS, Claim, Entry, Floor, Mark, Ring, Scan, Sensor, enter, leave};
use crate::lattice::{Cell, Side};

/// What an agent remembers. It has no map and knows no place.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Agent {
    /// No two agents have the same.
    pub id: u8,
    /// The side that it went through last.
    heading: Side,
    lap: Option<Lap>,
    /// Moves since it marked a cell, found a new one or began a lap; counted under [`Condition::AntsWhenIdle`].
    idle: u16,
    /// How many of them it takes to begin a lap.
    patience: u16,
}

/// What an agent does after a scan.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Act {
    /// What the sensor of its cell stores from now on, before the agent leaves.
    pub here: Sensor,
    /// The side that it shuts.
    pub shuts: Option<Side>,
    /// What becomes of the agent.
    pub next: Next,
}

/// What becomes of an agent after an action.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Next {
    /// It goes through a side into a cell on which it leaves this claim.
    Goes(Side, Entry, Option<Claim>),
    /// It waits where it is, since nobody enters the cells around.
    Waits,
    /// It has nowhere to go any more: all is explored, as far as it knows.
    Done,
}

/// Idle moves before the first lap, under [`Condition::AntsWhenIdle`].
const PATIENCE: u16 = 4;

impl Agent {
    /// An agent before its first action.
    pub const fn new(id: u8) -> Self {
        Self { id, heading: Side::North, lap: None, idle: 0, patience: PATIENCE }
    }

    /// The lap that it is on.
    pub const fn lap(&self) -> Option<Lap> {
        self.lap
    }

    /// What it does after `scan`.
    pub fn decide(&mut self, rule: Rule, scan: &Scan) -> Act {
        let mut scan = *scan;
        let was = scan.here.mark;
        self.meet(rule, &mut scan.here.claim);
        let end = self.end_lap(rule, &mut scan);
        let shuts = end.and_then(Ended::shuts);
        if let Some(side) = shuts {
            scan.here.shut = scan.here.shut.with(side);
            scan.open = scan.open.and(Ring::of(side).not());
        }
        let next = self.choose(rule, &mut scan, end);
        let is_simple = scan.here.claim.is_none() && !blocks(rule, &scan);
        let is_alone = scan.here.agents <= 1 || !rule.has(Condition::Alone);
        scan.here.mark = match (was, next) {
            (Mark::Visited, _) => Mark::Visited,
            (_, Next::Goes(..) | Next::Done) if is_simple && is_alone => Mark::Visited,
            (_, Next::Goes(..) | Next::Done) if is_simple => Mark::Closing,
            (_, Next::Goes(..) | Next::Done | Next::Waits) => Mark::Explored,
        };
        if let Next::Goes(side, entry, _) = next {
            let gains = shuts.is_some() || scan.here.mark != was || entry == Entry::New;
            self.rest(rule, gains);
            self.heading = side;
        }
        Act { here: scan.here, shuts, next }
    }

    /// Counts a move that gains something, or another idle one.
    fn rest(&mut self, rule: Rule, gains: bool) {
        if gains {
            (self.idle, self.patience) = (0, PATIENCE);
        } else if rule.has(Condition::AntsWhenIdle) {
            self.idle = self.idle.saturating_add(1);
        }
    }

    /// Control: where a lap comes to the cell in which another began, one of them is void.
    fn meet(&mut self, rule: Rule, claim: &mut Option<Claim>) {
        let (Some(lap), Some(claim)) = (&mut self.lap, claim) else { return };
        if claim.owner == self.id || claim.is_void || lap.is_void {
            return;
        }
        match rule.precedence {
            Precedence::Higher if claim.owner > self.id => lap.is_void = true,
            Precedence::Higher => claim.is_void = true,
            Precedence::Everybody => (lap.is_void, claim.is_void) = (true, true),
            Precedence::Nobody => {}
        }
    }

    /// Closing: ends the lap if it is over, takes its claim back, and says what comes of it.
    fn end_lap(&mut self, rule: Rule, scan: &mut Scan) -> Option<Ended> {
        let lap = self.lap.filter(Lap::is_home)?;
        let first = lap.first;
        let Some(claim) = scan.here.claim.filter(|claim| claim.owner == self.id) else {
            self.lap = None;
            return Some(Ended::InVain(first));
        };
        let is_there = scan.reachable().has(first);
        let came_back = self.heading == first.opposite();
        let comes_round = self.left_hand(scan, scan.reachable()) == Some(first);
        if is_there && !came_back && !comes_round {
            return None;
        }
        self.lap = None;
        scan.here.claim = None;
        let is_shown = is_there && !came_back && !lap.is_void && !claim.is_void;
        let is_unchanged = !rule.has(Condition::SeenOnly) || scan.serials == lap.around;
        let can_shut = is_shown && is_unchanged && is_thin(scan, first) && scan.explored.has(first);
        Some(if can_shut { Ended::Shut(first) } else { Ended::InVain(first) })
    }

    /// Navigation: what becomes of it.
    fn choose(&mut self, rule: Rule, scan: &mut Scan, end: Option<Ended>) -> Next {
        let reachable = scan.reachable();
        let free = reachable.and(scan.closing.not());
        let side = if let Some(lap) = self.lap {
            let along = self.left_hand(scan, reachable);
            let along = along.filter(|&side| free.has(side));
            if let Some(side) = along {
                self.lap = lap.moved(side);
            }
            along
        } else if scan.unexplored() != Ring::default() {
            most_walled(scan)
        } else if rule.has(Condition::Laps) {
            self.go_round(rule, scan, free, end)
        } else {
            self.not_back(free)
        };
        match side {
            Some(side) => {
                let mut claim = scan.claim(side);
                self.meet(rule, &mut claim);
                Next::Goes(side, scan.entry(side), claim)
            }
            None if reachable == Ring::default() => Next::Done,
            None => Next::Waits,
        }
    }

    /// The way on among explored cells, perhaps the first one of a lap.
    fn go_round(&mut self, rule: Rule, scan: &mut Scan, free: Ring, end: Option<Ended>) -> Option<Side> {
        let is_ant = rule.has(Condition::AntsWhenIdle);
        if is_ant && scan.here.mark == Mark::Visited && scan.reachable() == Ring::default() {
            return least_crossed(scan, scan.beside);
        }
        let along = match end {
            // The next lap begins one move farther along the same material.
            Some(Ended::InVain(first)) if free.has(first) => first,
            Some(_) | None => self.left_hand(scan, free)?,
        };
        let is_due = end.is_none() && scan.here.claim.is_none() && blocks(rule, scan) && is_thin(scan, along);
        if is_due && self.is_patient_enough(rule) {
            scan.here.claim = Some(Claim { owner: self.id, is_void: false });
            self.lap = Lap::new(along, scan.serials).moved(along);
            return Some(along);
        }
        if is_ant { least_crossed(scan, free) } else { Some(along) }
    }

    /// Whether it has been idle for so long that it begins a lap; then the next one has to wait twice as long, unless
    /// something comes of this one.
    fn is_patient_enough(&mut self, rule: Rule) -> bool {
        if !rule.has(Condition::AntsWhenIdle) {
            return true;
        }
        let is_due = self.idle >= self.patience;
        if is_due {
            self.idle = 0;
            self.patience = self.patience.saturating_mul(2);
        }
        is_due
    }

    /// An explored neighbour, not back unless forced; ties in the order of the compass.
    fn not_back(&self, reachable: Ring) -> Option<Side> {
        let back = self.heading.opposite();
        let onward = COMPASS.into_iter().find(|&side| side != back && reachable.has(side));
        onward.or_else(|| reachable.has(back).then_some(back))
    }

    /// The way on with the left hand on material: the first side of left, ahead, right and back that is in `among` and
    /// has material on its left; if none has, the first of them.
    fn left_hand(&self, scan: &Scan, among: Ring) -> Option<Side> {
        let (left, ahead) = (self.heading.turned_left(), self.heading);
        let order = [left, ahead, ahead.turned_right(), ahead.opposite()];
        let mut sides = order.into_iter().filter(|&side| among.has(side));
        let along = sides.clone().find(|&side| !scan.is_filled_left(side));
        along.or_else(|| sides.next())
    }
}

/// What comes of a lap that is over, and which side it began with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Ended {
    /// The side is shut.
    Shut(Side),
    /// Nothing.
    InVain(Side),
}

impl Ended {
    const fn shuts(self) -> Option<Side> {
        match self {
            Self::Shut(side) => Some(side),
            Self::InVain(_) => None,
        }
    }
}

/// The unexplored neighbour with the most inaccessible sides, as far as the scan shows them; ties in the order of the
/// compass.
fn most_walled(scan: &Scan) -> Option<Side> {
    let unexplored = scan.unexplored();
    let walled = |side| {
        let flanks = Ring::of(side).beside(scan.rims).and(scan.accessible);
        flanks.count()
    };
    COMPASS.into_iter().filter(|&side| unexplored.has(side)).min_by_key(|&side| walled(side))
}

/// Writes what an agent in `cell` has decided; where it is then.
pub fn carry_out(floor: &mut impl Floor, cell: Cell, act: &Act) -> Cell {
    floor.put(cell, act.here);
    if let Some(side) = act.shuts {
        let beyond = cell.beyond(side);
        if let Some(sensor) = floor.sensor(beyond) {
            floor.put(beyond, Sensor { shut: sensor.shut.with(side.opposite()), ..sensor });
        }
    }
    match act.next {
        Next::Goes(side, entry, claim) => {
            let beyond = cell.beyond(side);
            leave(floor, cell);
            enter(floor, beyond, entry);
            if let Some(sensor) = floor.sensor(beyond) {
                floor.put(beyond, Sensor { claim, ..sensor });
            }
            beyond
        }
        Next::Waits => cell,
        Next::Done => {
            leave(floor, cell);
            cell
        }
    }
}

/// One action of `agent` in `cell`: what it did, and where it is then. Whether sensors are missed is asked of `world`.
pub fn act(
    rule: Rule,
    floor: &mut impl Floor,
    agent: &mut Agent,
    cell: Cell,
    world: &mut (impl Source + ?Sized),
) -> (Act, Cell) {
    let scan = Scan::new(floor, cell, world);
    let act = agent.decide(rule, &scan);
    (act, carry_out(floor, cell, &act))
}
