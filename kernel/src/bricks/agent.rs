//! One action of an agent: it scans, marks its cell, and goes on. Reading, writing and the registration in the next
//! cell are one step: two agents whose scans overlap take turns (BRICKS-3).

use super::lap::{Hand, Lap};
use super::marking::{blocks, is_thin};
use super::rule::{Condition, Precedence, Rule};
use crate::ants::least_crossed;
use crate::choice::Oracle;
use crate::floor::{COMPASS, Claim, Entry, Floor, Mark, Ring, Scan, Sensor, enter, leave};
use crate::ground::{Cell, Side, Step};

/// An agent's memory: no map, and no place.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Agent {
    /// No two agents have the same.
    pub id: u8,
    /// The side that it went through last.
    heading: Side,
    pass: Pass,
    lap: Option<Lap>,
    /// Whether its last lap did not come home, and nothing was gained since: its claim may still stand somewhere.
    is_lost: bool,
    /// Counts moves in which it neither marked a cell nor found a new one nor shut a side, under
    /// [`Condition::LeastCrossed`].
    idle: u16,
    /// Laps that were cut short since one came round or came back.
    cut_short: u8,
}

/// Whether visited cells count as walls (see [`Condition::SecondPass`]).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Pass {
    /// Yes: the agent explores and marks.
    First,
    /// No, only sealed ones do: it goes over what is visited and seals it.
    Second,
}

/// An agent's action after a scan.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Act {
    /// The mark and count that the sensor of its cell stores from now on, before the agent leaves.
    pub here: Sensor,
    /// The side that it shuts.
    pub shuts: Option<Side>,
    /// Where the agent goes, or that it ends.
    pub next: Next,
}

/// An agent's next cell, or its end, after an action.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Next {
    /// It goes through a side into a cell on which it leaves this claim.
    Goes(Side, Entry, Option<Claim>),
    /// It waits where it is, since nobody enters the cells around.
    Waits,
    /// It has nowhere to go any more: all is explored, as far as it knows.
    Done,
}

impl Agent {
    /// An agent before its first action.
    pub const fn new(id: u8) -> Self {
        Self { id, heading: Side::North, pass: Pass::First, lap: None, is_lost: false, idle: 0, cut_short: 0 }
    }

    /// The lap that it is on.
    pub const fn lap(&self) -> Option<Lap> {
        self.lap
    }

    /// The agent's action after `scan`.
    pub fn decide(&mut self, rule: Rule, scan: &Scan) -> Act {
        self.choose_pass(rule, scan);
        let (rule, mut scan) = match self.pass {
            Pass::First => (rule.without(Condition::SeenOnly), *scan),
            Pass::Second => (rule, scan.with_visited()),
        };
        let was = scan.here.mark;
        self.meet(rule, &mut scan.here.claim);
        let end = self.end_lap(rule, &mut scan);
        let shuts = end.and_then(|end| if let LapOutcome::Shut(side) = end { Some(side) } else { None });
        if let Some(side) = shuts {
            scan.here.shut = scan.here.shut.with(Step::Cross(side));
            scan.open = scan.open.and(Ring::of(side).not());
        }
        let next = self.choose(rule, &mut scan, end);
        let is_simple = scan.here.claim.is_none() && !blocks(rule, &scan);
        let is_alone = scan.here.agents <= 1 || !rule.has(Condition::Alone);
        let leaves = next != Next::Waits && is_simple;
        scan.here.mark = match (was, self.pass) {
            (Mark::Sealed, Pass::First | Pass::Second) | (Mark::Visited, Pass::First) => was,
            (_, Pass::First) if leaves && is_alone => Mark::Visited,
            (_, Pass::Second) if leaves && is_alone => Mark::Sealed,
            (_, Pass::First | Pass::Second) if leaves => Mark::Closing,
            (Mark::Visited, Pass::Second) => Mark::Visited,
            (_, Pass::First | Pass::Second) => Mark::Explored,
        };
        if let Next::Goes(side, entry, _) = next {
            self.rest(rule, shuts.is_some() || scan.here.mark != was || entry != Entry::Known);
            self.heading = side;
        }
        Act { here: scan.here, shuts, next }
    }

    /// The first pass while something unexplored is beside it. The second when it has nowhere to go in the first, or
    /// has gained little for long.
    fn choose_pass(&mut self, rule: Rule, scan: &Scan) {
        let is_stuck = scan.reachable() == Ring::default() || self.idle >= rule.hope();
        if scan.reachable().and(scan.unexplored) != Ring::default() && self.lap.is_none() {
            self.pass = Pass::First;
        } else if rule.has(Condition::SecondPass) && self.pass == Pass::First && is_stuck {
            (self.pass, self.idle) = (Pass::Second, 0);
        }
    }

    /// Counts a move that gains something, or another idle one.
    fn rest(&mut self, rule: Rule, gains: bool) {
        if gains {
            self.is_lost = false;
            self.idle = match self.pass {
                // It may be a missed sensor that was replaced, again and again.
                Pass::First if rule.has(Condition::SecondPass) => self.idle.saturating_sub(2),
                Pass::First | Pass::Second => 0,
            };
        } else if rule.has(Condition::LeastCrossed) {
            self.idle = (self.idle + 1).min(rule.hope());
        }
    }

    /// Control: where a lap comes to the cell in which another began, one of them is in vain.
    fn meet(&mut self, rule: Rule, claim: &mut Option<Claim>) {
        let Some(owner) = claim.map(|claim| claim.owner) else { return };
        if owner == self.id {
            // A claim of a lap that did not come home is taken back wherever it is found.
            if !self.lap.is_some_and(|lap| lap.is_home()) {
                (*claim, self.is_lost) = (None, false);
            }
            return;
        }
        let Some(lap) = self.lap.as_mut().filter(|lap| !lap.is_void) else { return };
        match rule.precedence {
            Precedence::Higher if owner > self.id => lap.is_void = true,
            Precedence::Higher => *claim = None,
            Precedence::Everybody => (lap.is_void, *claim) = (true, None),
            Precedence::Nobody => {}
        }
    }

    /// Closing: ends the lap if it is over, takes its claim back, and says what comes of it.
    fn end_lap(&mut self, rule: Rule, scan: &mut Scan) -> Option<LapOutcome> {
        let lap = self.lap.filter(Lap::is_home)?;
        let first = lap.first;
        if scan.here.claim.is_none_or(|claim| claim.owner != self.id) {
            self.lap = None;
            return Some(LapOutcome::InVain(first));
        }
        let is_there = scan.reachable().has(first);
        let came_back = self.heading == first.opposite();
        let comes_round = self.along(lap.hand, scan, scan.reachable()) == Some(first);
        if is_there && !came_back && !comes_round && !lap.is_cut_short() {
            return None;
        }
        self.lap = None;
        scan.here.claim = None;
        if lap.is_cut_short() && !lap.is_void {
            self.cut_short = self.cut_short.saturating_add(1);
            return Some(LapOutcome::CutShort);
        }
        self.cut_short = 0;
        let is_shown = is_there && !came_back && !lap.is_void;
        let is_unchanged = !rule.has(Condition::SeenOnly) || scan.serials == lap.around;
        let can_shut = is_shown && is_unchanged && is_thin(scan, first) && scan.explored.has(first);
        Some(if can_shut { LapOutcome::Shut(first) } else { LapOutcome::InVain(first) })
    }

    /// Navigation: what becomes of it.
    fn choose(&mut self, rule: Rule, scan: &mut Scan, end: Option<LapOutcome>) -> Next {
        let reachable = scan.reachable();
        let free = reachable.and(scan.closing.not());
        let side = if let Some(lap) = self.lap {
            let (mut lap, along) = self.go_on(rule, scan, lap);
            let along = along.filter(|&side| free.has(side));
            if let Some(side) = along {
                // It may be a sealed cell that was missed: who goes through it has other material at hand.
                lap.is_void |= rule.has(Condition::SeenOnly) && scan.unexplored.has(side);
                self.lap = lap.through(side);
                self.is_lost = self.lap.is_none();
            }
            along
        } else if reachable.and(scan.unexplored) != Ring::default() {
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
                Next::Goes(side, entry(rule, scan, side), claim)
            }
            None if reachable == Ring::default() => Next::Done,
            None => Next::Waits,
        }
    }

    /// The way on on a lap, which is cut short where it goes too far.
    fn go_on(&mut self, rule: Rule, scan: &Scan, lap: Lap) -> (Lap, Option<Side>) {
        let reach = u32::from(rule.reach).saturating_mul(1 << (self.cut_short / 2).min(31));
        match self.along(lap.hand, scan, scan.reachable()) {
            Some(onward) if !lap.is_cut_short() && lap.moved >= reach => {
                let lap = lap.cut_short();
                self.heading = onward.opposite();
                (lap, self.along(lap.hand, scan, scan.reachable()))
            }
            along => (lap, along),
        }
    }

    /// The way on among explored cells, perhaps the first one of a lap.
    fn go_round(&mut self, rule: Rule, scan: &mut Scan, free: Ring, end: Option<LapOutcome>) -> Option<Side> {
        let along = match end {
            // The next lap begins one move farther along the same material.
            Some(LapOutcome::InVain(first)) if free.has(first) => first,
            Some(LapOutcome::InVain(_) | LapOutcome::CutShort | LapOutcome::Shut(_)) | None => {
                self.along(Hand::Left, scan, free)?
            }
        };
        // It goes to the least crossed neighbour for a while, and then round the material until something comes of it.
        let is_calm = self.idle < u16::from(rule.patience) || self.is_lost;
        let is_early = self.pass == Pass::First && rule.has(Condition::SecondPass);
        if rule.has(Condition::LeastCrossed) && (is_calm || is_early) {
            return least_crossed(scan, free);
        }
        let may_begin = match end {
            None | Some(LapOutcome::CutShort) => true,
            Some(LapOutcome::InVain(_) | LapOutcome::Shut(_)) => false,
        };
        if may_begin && scan.here.claim.is_none() && blocks(rule, scan) && is_thin(scan, along) {
            scan.here.claim = Some(Claim { owner: self.id });
            self.lap = Lap::new(along, scan.serials).through(along);
        }
        Some(along)
    }

    /// An explored neighbour, not back unless forced; ties in the order of the compass.
    fn not_back(&self, reachable: Ring) -> Option<Side> {
        let back = self.heading.opposite();
        let onward = COMPASS.into_iter().find(|&side| side != back && reachable.has(side));
        onward.or_else(|| reachable.has(back).then_some(back))
    }

    /// The way on with a hand on material: the first side of that hand's, ahead, the other hand's and back that is in
    /// `among` and has material on that hand's side; if none has, the first of them.
    fn along(&self, hand: Hand, scan: &Scan, among: Ring) -> Option<Side> {
        let (left, ahead, right) = (self.heading.turned_left(), self.heading, self.heading.turned_right());
        let back = ahead.opposite();
        let (order, is_filled): (_, fn(&Scan, Side) -> bool) = match hand {
            Hand::Left => ([left, ahead, right, back], Scan::is_filled_left),
            Hand::Right => ([right, ahead, left, back], Scan::is_filled_right),
        };
        let mut sides = order.into_iter().filter(|&side| among.has(side));
        let along = sides.clone().find(|&side| !is_filled(scan, side));
        along.or_else(|| sides.next())
    }
}

/// The outcome of a lap that is over, and which side it began with where that matters.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum LapOutcome {
    /// The side is shut.
    Shut(Side),
    /// Nothing.
    InVain(Side),
    /// Nothing yet: it was cut short.
    CutShort,
}

/// How the neighbour beyond `side` is entered. Missed sensors take their counts with them: under
/// [`Condition::SecondPass`] new ones count on, lest agents be drawn back again and again.
fn entry(rule: Rule, scan: &Scan, side: Side) -> Entry {
    if rule.has(Condition::SecondPass) {
        scan.entry_counting_on(side)
    } else {
        scan.entry(side, rule.replaced)
    }
}

/// The unexplored neighbour with the most inaccessible sides, as far as the scan shows them; ties in the order of the
/// compass.
pub(super) fn most_walled(scan: &Scan) -> Option<Side> {
    let unexplored = scan.reachable().and(scan.unexplored);
    let flanks = |side| Ring::of(side).beside(scan.rims).and(scan.accessible()).count();
    COMPASS.into_iter().filter(|&side| unexplored.has(side)).min_by_key(|&side| flanks(side))
}

/// Writes what an agent in `cell` has decided; where it is then.
pub fn carry_out(floor: &mut impl Floor, cell: Cell, act: &Act) -> Cell {
    floor.put(cell, act.here);
    if let Some(side) = act.shuts {
        let beyond = cell.beyond(side);
        if let Some(sensor) = floor.sensor(beyond) {
            floor.put(beyond, Sensor { shut: sensor.shut.with(Step::Cross(side.opposite())), ..sensor });
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
    world: &mut (impl Oracle + ?Sized),
) -> (Act, Cell) {
    let scan = Scan::new(floor, cell, world);
    let act = agent.decide(rule, &scan);
    (act, carry_out(floor, cell, &act))
}
