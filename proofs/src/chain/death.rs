//! A robot of the chain dies, whichever and whenever, and the others go on with one fewer (CHAIN-21). Each unknown side
//! is decided by the oracle when a robot first tries it.

use std::collections::{BTreeMap, BTreeSet};

use tautline_kernel::chain::{Chain, Damage, Intent, Kind, Message, Outcome as Came, Reformation};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, Edge, Grid, Side, SmallGrid, Step};

use super::breach::Breach;
use super::environment::in_covered;
use super::links::has_explored;
use super::subject::Subject;
use super::whole_runs::{MANY, NO_MESSAGE, is_one_of, key, start};
use crate::engine::{Outcome, Stop, require};
use crate::plural::listed;

/// Robots, and most walls, of [`in_few_walls`].
const FEW_WALLS: [(usize, u32); 3] = [(3, 1), (4, 1), (5, 0)];

/// Team moves before the death in [`in_few_walls`]: fewer than this.
const MOMENTS: u32 = 60;

/// Robots, and walls in percent, of [`at_random`]; team moves before the death: fewer than this.
const RANDOM: (usize, [u32; 5]) = (8, [1, 5, 10, 15, 20]);
const LATE_MOMENTS: u32 = 300;

/// The bound of [`in_few_walls`], in words.
pub(super) fn few_walls() -> String {
    let (robots, walls) = (FEW_WALLS.map(|(robots, _)| robots), FEW_WALLS.map(|(_, walls)| walls));
    let (robots, walls) = (listed(robots), listed(walls));
    format!("all layouts, N = {robots}, at most {walls} walls, any death in the first {MOMENTS} team moves")
}

/// The layouts that [`at_random`] draws, in words.
pub(super) fn random_layouts() -> String {
    let (robots, walls) = RANDOM;
    let walls = listed(walls);
    format!(
        "random layouts, N = {robots}, walls of {walls} %, a death in the first {LATE_MOMENTS} team moves"
    )
}

/// A chain of which a robot dies, and what the others do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct DeathCase {
    pub(super) observed: Subject,
    pub(super) then: Aftermath,
}

/// The others' action when a robot has died.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Aftermath {
    /// They re-form, and come home when they need what was before.
    Reform,
    /// The robots ahead wait where they are.
    Wait,
    /// They take two team moves back at once.
    Skip,
    /// They take team moves back, although none is left.
    Beyond,
    /// They go on as soon as neighbours are in contact, also with three robots in a cell.
    Crowd,
    /// They re-form, and never come home.
    StayOut,
    /// They re-form, and count robots without the one that has died.
    Renumber,
}

/// CHAIN-21 over all layouts with few walls.
///
/// # Errors
/// [`Stop`] if it is no case, or breaks the clause.
pub(super) fn in_few_walls(dying: &DeathCase, oracle: &mut dyn Oracle) -> Outcome {
    let (robots, mut walls) = one_of(oracle, &FEW_WALLS);
    let (moment, robot) = (oracle.pick(MOMENTS), 1 + oracle.pick(robots as u32 - 1) as usize);
    Death { dying, moment, robot }.happens(robots, &mut || !is_one_of(&mut walls, oracle))
}

/// CHAIN-21 in a random layout.
///
/// # Errors
/// As of [`in_few_walls`].
pub(super) fn at_random(dying: &DeathCase, oracle: &mut dyn Oracle) -> Outcome {
    let walls_percent = one_of(oracle, &RANDOM.1);
    let (moment, robot) = (oracle.pick(LATE_MOMENTS), 1 + oracle.pick(RANDOM.0 as u32 - 1) as usize);
    Death { dying, moment, robot }.happens(RANDOM.0, &mut || oracle.pick(100) >= walls_percent)
}

/// Robots, and team moves, of [`whatever_the_log`].
const MEETING: (usize, u32) = (5, 3);

/// The bound of [`whatever_the_log`], in words.
pub(super) fn meetings() -> String {
    let (robots, moves) = MEETING;
    format!("N = {robots}, a death after {} team moves in the open, any steps in the log", listed(1..=moves))
}

const MAY_COME_HOME: &str =
    "a chain that has re-formed can come home until each part has taken all its moves back";

/// CHAIN-21: when the two parts are one chain again, and whether it can still come home, wherever they come to. A log
/// with other steps than the robots made leads them to more places than true ones do.
///
/// # Errors
/// [`Stop`] if it is no case, or breaks the clause.
pub(super) fn whatever_the_log(dying: &DeathCase, oracle: &mut dyn Oracle) -> Outcome {
    let (robots, most) = MEETING;
    let (moves, mute) = (1 + oracle.pick(most), 1 + oracle.pick(robots as u32 - 1) as usize);
    let mut chain: Small = start(&dying.observed, robots, SmallGrid::new)?;
    let (mut log, mut crossed) = (Vec::new(), BTreeSet::new());
    for _ in 0..moves {
        let before = chain.cells().to_vec();
        goes_on(&mut chain, &mut log, &mut |_| true)?;
        for (&from, &to) in before.iter().zip(chain.cells()) {
            let side = Side::ALL.into_iter().find(|&side| from.beyond(side) == to);
            crossed.extend(side.map(|side| key(Edge::new(from, side))));
        }
    }
    let mut reforming = chain.reform(mute + 1, &log).map_err(|_| Stop::Violated("the others can re-form"))?;
    let taken_back = oracle.pick(2 * moves + 1);
    for made in 0..taken_back {
        // The latest first: those of the part ahead, then those of the part behind.
        let entry = (2 * moves - 1 - made) % moves;
        let part = if made < moves { mute + 1..robots } else { 1..mute };
        let mut refused = None;
        for robot in part {
            let step = one_of(oracle, &Step::ALL);
            // Where it is among the robots that are left.
            let place = if robot < mute { robot } else { robot - 1 };
            if let Step::Cross(side) = step.reverse()
                && !crossed.contains(&key(Edge::new(reforming.cells()[place], side)))
            {
                refused = refused.or(Some(Damage::OtherWorld(robot + 1)));
            }
            log[entry as usize * (robots - 1) + robot - 1] =
                Message { step, outcome: Came::Arrived }.encode();
        }
        // Steps over sides that nobody has crossed are refused.
        let taken = dying.take_back(&mut reforming, &log);
        require(
            taken.err() == refused,
            "a log is refused that leads over a side that nobody has crossed, and \
             the first robot named that it leads there",
        )?;
        let is_left = taken.map_err(|_| Stop::Assumed)?;
        require(is_left, "each part takes back as many team moves as the chain has made")?;
    }
    if !dying.is_formed(&reforming)? {
        require(reforming.formed().is_err(), "two parts that are not one chain do not go on")?;
        let is_crowded = Breach::Crowding.is_in(reforming.cells(), reforming.cells());
        return Ok(if is_crowded { "three robots in one cell" } else { "two parts" });
    }
    let (chain, _) = reforming.formed().map_err(|_| Stop::Violated("the chain goes on"))?;
    require(chain.can_come_home() == (taken_back < 2 * moves), MAY_COME_HOME)?;
    Ok(if taken_back < moves { "one chain" } else { "one chain, the part ahead home" })
}

impl DeathCase {
    /// One more team move is taken back.
    fn take_back(&self, reforming: &mut Reformation<SmallGrid, 8>, log: &[u8]) -> Result<bool, Damage> {
        let behind = reforming.behind();
        match reforming.take_back(log) {
            Err(Damage::OtherWorld(robot)) if self.then == Aftermath::Renumber && robot > behind => {
                Err(Damage::OtherWorld(robot - 1))
            }
            taken => taken,
        }
    }

    /// Whether the two parts are one chain again, by what they do; that is so as soon as it can be.
    fn is_formed(&self, reforming: &Reformation<SmallGrid, 8>) -> Result<bool, Stop> {
        let cells = reforming.cells();
        let in_contact = hold(&ways(cells, cells));
        let is_formed = match self.then {
            Aftermath::Crowd => in_contact,
            Aftermath::Reform
            | Aftermath::Wait
            | Aftermath::Skip
            | Aftermath::Beyond
            | Aftermath::StayOut
            | Aftermath::Renumber => reforming.is_formed(),
        };
        require(
            is_formed == (in_contact && !Breach::Crowding.is_in(cells, cells)),
            "the parts are one chain as soon as neighbours are in contact and no three robots in one cell",
        )?;
        Ok(is_formed)
    }
}

/// The robot in place `robot` dies after so many team moves, on its way in the next.
struct Death<'a> {
    dying: &'a DeathCase,
    moment: u32,
    robot: usize,
}

type Small = Chain<SmallGrid, 8>;

impl Death<'_> {
    fn happens(&self, robots: usize, decides: &mut dyn FnMut() -> bool) -> Outcome {
        // What a side is stays what it is; the oracle is asked once for each.
        let mut world = BTreeMap::new();
        let mut is_open = |edge: Edge| *world.entry(key(edge)).or_insert_with(&mut *decides);
        let mut chain: Small = start(&self.dying.observed, robots, SmallGrid::new)?;
        let (mut log, mut history) = (Vec::new(), 0);
        for _ in 0..self.moment {
            let Some(kind) = goes_on(&mut chain, &mut log, &mut is_open)? else { return Err(Stop::Assumed) };
            history = longer(history, kind);
        }
        let Intent::Go(plan) = chain.plan(&log).map_err(|_| NO_MESSAGE)? else { return Err(Stop::Assumed) };
        let (before, mut heard) = (chain, chain);
        let plan = plan.without(self.robot + 1);
        let settled = chain.settle(&plan, &mut is_open);
        heard.hear(&plan, settled.messages()).map_err(|_| NO_MESSAGE)?;
        require(heard == chain, "who hears the others knows what they know")?;
        log.extend_from_slice(settled.messages());
        // The one that died may be anywhere on its way.
        let mut gone = ways(before.cells(), chain.cells());
        gone[self.robot][1] = before.cells()[self.robot].after(plan.steps()[self.robot]);
        require(hold(&gone), "the team stops in contact, wherever the robot has died")?;
        if robots == 2 {
            return Err(Stop::Assumed);
        }
        let history = longer(history, plan.kind);
        let mut reforming =
            chain.reform(self.robot + 1, &log).map_err(|_| Stop::Violated("the others can re-form"))?;
        let mut taken_back = 0;
        while !self.dying.is_formed(&reforming)? {
            require(self.takes_back(&mut reforming, &log)?, "the two parts come into contact")?;
            taken_back += 1;
            require(
                taken_back <= 2 * history,
                "they are in contact after at most twice the team moves that are not taken back",
            )?;
        }
        let (mut chain, parts) = reforming.formed().map_err(|_| Stop::Violated("the chain goes on"))?;
        require(chain.can_come_home() == (taken_back < 2 * history), MAY_COME_HOME)?;
        let mut fresh = Vec::new();
        let mut comes_home = false;
        for _ in 0..MANY {
            if goes_on(&mut chain, &mut fresh, &mut is_open)?.is_some() {
                continue;
            }
            let may_leave = self.dying.then != Aftermath::StayOut && chain.has_more_within_reach();
            let Some(mut reforming) = chain.come_home(parts).filter(|_| may_leave) else {
                require(
                    has_explored(chain.grid(), chain.cells()[0], chain.cells().len()),
                    "in the end all is explored within reach of those left",
                )?;
                return Ok(match (comes_home, taken_back) {
                    (true, _) => "the chain comes home before it goes on",
                    (false, 0) => "the chain goes on at once",
                    (false, _) => "the chain goes on after some moves taken back",
                });
            };
            while self.takes_back(&mut reforming, &log)? {
                taken_back += 1;
                require(
                    taken_back <= 2 * history,
                    "no part takes back more team moves than the chain has made",
                )?;
            }
            require(taken_back == 2 * history, "on the way home each part takes all its team moves back")?;
            (chain, _) = reforming.formed().map_err(|_| Stop::Violated("all are in contact in the base"))?;
            require(chain.is_home(), "all moves taken back, the robots are in the base")?;
            (fresh, comes_home) = (Vec::new(), true);
        }
        Err(Stop::Violated("the chain of one robot fewer ends its run"))
    }

    /// A team move taken back, and whether there was one. Neighbours of the same part must be in contact, whoever of
    /// them has gone.
    fn takes_back(&self, reforming: &mut Reformation<SmallGrid, 8>, log: &[u8]) -> Result<bool, Stop> {
        let before = reforming.cells().to_vec();
        let mut take_back =
            || reforming.take_back(log).map_err(|_| Stop::Violated("the log leads over crossed sides only"));
        let is_left = match self.dying.then {
            Aftermath::Reform | Aftermath::Crowd | Aftermath::StayOut | Aftermath::Renumber => take_back()?,
            Aftermath::Wait => false,
            Aftermath::Skip => take_back()? | take_back()?,
            Aftermath::Beyond => {
                take_back()?;
                true
            }
        };
        let ways = ways(&before, reforming.cells());
        let (behind, ahead) = ways.split_at(reforming.behind());
        require(hold(behind) && hold(ahead), "within each part neighbours keep contact")?;
        Ok(is_left)
    }
}

/// How many team moves are not taken back, after one more of this kind.
const fn longer(history: u32, kind: Kind) -> u32 {
    match kind {
        Kind::Advance => history + 1,
        Kind::Backtrack => history.saturating_sub(1),
    }
}

/// Makes a team move, in which the team must keep contact whoever goes first, and apart; `None` if the run is over.
fn goes_on<G: Grid>(
    chain: &mut Chain<G, 8>,
    log: &mut Vec<u8>,
    is_open: &mut dyn FnMut(Edge) -> bool,
) -> Result<Option<Kind>, Stop> {
    let Intent::Go(plan) = chain.plan(log).map_err(|_| NO_MESSAGE)? else { return Ok(None) };
    require(!chain.is_refused(), "no plan is refused")?;
    let before = chain.cells().to_vec();
    log.extend_from_slice(chain.settle(&plan, is_open).messages());
    require(hold(&ways(&before, chain.cells())), "neighbours keep contact")?;
    require(!Breach::Crowding.is_in(&before, chain.cells()), "no three robots are in one cell")?;
    Ok(Some(plan.kind))
}

/// Where robots were, and where they are.
fn ways(before: &[Cell], after: &[Cell]) -> Vec<[Cell; 2]> {
    before.iter().zip(after).map(|(&from, &to)| [from, to]).collect()
}

/// Whether neighbours are in contact, whoever of them has gone its way.
fn hold(ways: &[[Cell; 2]]) -> bool {
    let in_contact = |one: [Cell; 2], other: [Cell; 2]| {
        one.iter().all(|&one| other.iter().all(|&other| in_covered(one, other)))
    };
    ways.windows(2).all(|pair| in_contact(pair[0], pair[1]))
}
