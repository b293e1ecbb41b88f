//! One pair of neighbours in the chain during one team move: the inductive steps of CHAIN-1 (E_C membership)
//! and CHAIN-3 (centre-to-centre coverage). They speak of every state of the pair, every admitted plan and every
//! answer of the world, not of the planner, so they hold for every robot, every N, every layout and every order
//! in which one may prefer the candidates.

use tautline_kernel::chain::{Move, Rule};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, Circle, Edge, Step};

use super::breach::stays_in_range;
use super::subject::Subject;
use crate::engine::{Outcome, Stop, assume, outcomes, require};

/// The state of an edge that a robot plans to cross.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Nature {
    KnownOpen,
    Open,
    Wall,
}

/// The edges that one team move crosses, by as many robots as there are places: an edge is asked for once.
pub(crate) struct World<const ROBOTS: usize> {
    edges: [Option<(Edge, Nature)>; ROBOTS],
}

impl<const ROBOTS: usize> World<ROBOTS> {
    pub(crate) const fn new() -> Self {
        Self { edges: [None; ROBOTS] }
    }

    fn nature(&mut self, edge: Edge, oracle: &mut dyn Oracle) -> Nature {
        for place in &mut self.edges {
            match *place {
                Some((known, nature)) if known == edge => return nature,
                Some(_) => {}
                None => {
                    let nature = one_of(oracle, &[Nature::KnownOpen, Nature::Open, Nature::Wall]);
                    *place = Some((edge, nature));
                    return nature;
                }
            }
        }
        Nature::Wall
    }

    /// A robot at `from` that plans any step, and where it ends up.
    pub(crate) fn pick(&mut self, from: Cell, oracle: &mut dyn Oracle) -> Attempt {
        let step = one_of(oracle, &Step::ALL);
        let nature = match step {
            Step::Cross(side) => self.nature(Edge::new(from, side), oracle),
            Step::Stay => Nature::Open,
        };
        let plan = Move { from, step, known_open: nature == Nature::KnownOpen };
        Attempt { plan, arrived: if nature == Nature::Wall { from } else { plan.to() } }
    }
}

/// A robot's planned move and where it ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempt {
    pub(crate) plan: Move,
    pub(crate) arrived: Cell,
}

impl Attempt {
    fn is_blocked(self) -> bool {
        self.arrived != self.plan.to()
    }
}

/// How many columns and rows the robot ahead is looked at from the one behind. E_C reaches no farther.
const FAR: u32 = 2;

/// The bound of [`contact`] and [`coverage`], in words.
pub(super) fn neighbours() -> String {
    format!("every pair of neighbours up to {FAR} apart, every plan and answer")
}

/// Whether `rule` admits what two neighbours plan. A null move is always admitted to the robot ahead: the leader may
/// fall back on it.
pub(super) fn admits(rule: &Rule, own: Move, ahead: Move) -> bool {
    (ahead.step == Step::Stay || rule.admits_behind(ahead.to(), own.from)) && rule.admits_ahead(own, ahead)
}

/// R_i and R_{i+1}, i ≥ 1.
struct Pair {
    behind: Attempt,
    ahead: Attempt,
}

impl Pair {
    /// Any two robots that are `related` now and plan what `rule` admits.
    fn pick(
        rule: &Rule,
        related: impl Fn(Cell, Cell) -> bool,
        oracle: &mut dyn Oracle,
    ) -> Result<Self, Stop> {
        let behind = Cell::new(0, 0);
        let mut offset = || oracle.pick(2 * FAR + 1) as i16 - FAR as i16;
        let ahead = Cell::new(offset(), offset());
        assume(related(behind, ahead))?;
        let mut world = World::<2>::new();
        let pair = Self { behind: world.pick(behind, oracle), ahead: world.pick(ahead, oracle) };
        assume(admits(rule, pair.behind.plan, pair.ahead.plan))?;
        Ok(pair)
    }

    fn situation(&self) -> &'static str {
        match (self.behind.is_blocked(), self.ahead.is_blocked()) {
            (false, false) => "both arrive",
            (true, false) => "the robot behind is blocked",
            (false, true) => "the robot ahead is blocked",
            (true, true) => "both are blocked",
        }
    }
}

/// The largest distances of two neighbours in the chain, squared, in quarters of a squared cell: after a team move, and
/// at any moment of it, whoever of the two has gone.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Farthest {
    /// From centre to centre.
    pub centres: [u32; 2],
    /// From the centre of the one to the farthest corner of a cell round the other.
    pub cells: [u32; 2],
}

/// The largest distances over all pairs of neighbours that are `related` before a team move, and all plans that `rule`
/// admits to them.
pub fn farthest(rule: &Rule, related: impl Fn(Cell, Cell) -> bool) -> Farthest {
    let mut farthest = Farthest::default();
    for pair in outcomes(|oracle| Pair::pick(rule, &related, oracle).ok()) {
        let Pair { behind, ahead } = pair;
        // Distance is convex, so it is largest where each is at an end of its way.
        let ends = |robot: Attempt| [robot.plan.from, robot.plan.to()];
        let corners = ends(behind).into_iter().flat_map(|one| ends(ahead).map(|other| (one, other)));
        let after = (behind.arrived, ahead.arrived);
        for (place, (one, other)) in corners.map(|corner| (1, corner)).chain([(0, after)]) {
            let (dx, dy) = one.apart(other);
            let squared = |dx: u32, dy: u32| dx * dx + dy * dy;
            let [dx, dy] = [dx, dy].map(|offset| 2 * u32::from(offset));
            farthest.centres[place] = farthest.centres[place].max(squared(dx, dy));
            farthest.cells[place] = farthest.cells[place].max(squared(dx + 1, dy + 1));
        }
    }
    farthest
}

/// CHAIN-1, inductive step: neighbours in E_C of each other are so after the move.
///
/// # Errors
/// [`Stop`] if the choices are no case, or break the clause.
pub(super) fn contact(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let pair = Pair::pick(&observed.rule, |behind, ahead| Circle::COVERED.covers(behind, ahead), oracle)?;
    require(
        Circle::COVERED.covers(pair.behind.arrived, pair.ahead.arrived),
        "each neighbour's cell is wholly covered after the move",
    )?;
    Ok(pair.situation())
}

/// The bound of [`hold`], in words.
pub(super) fn goers() -> String {
    format!("every pair of neighbours up to {FAR} apart, every plan, and who has gone")
}

/// CHAIN-19, inductive step: neighbours in E_C of each other are so whoever of them has gone to where the plan sends
/// it, and whoever has not, and so are their centres within r_cov on the way.
///
/// # Errors
/// [`Stop`] if the choices are no case, or break the clause.
pub(super) fn hold(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let behind = Cell::new(0, 0);
    let mut offset = || oracle.pick(2 * FAR + 1) as i16 - FAR as i16;
    let ahead = Cell::new(offset(), offset());
    assume(Circle::COVERED.covers(behind, ahead))?;
    let mut plan = |from| Move { from, step: one_of(oracle, &Step::ALL), known_open: oracle.flip() };
    let (own, ahead) = (plan(behind), plan(ahead));
    assume(admits(&observed.rule, own, ahead))?;
    let (has_gone, has_gone_ahead) = (oracle.flip(), oracle.flip());
    let at = |plan: Move, has_gone: bool| if has_gone { plan.to() } else { plan.from };
    require(
        Circle::COVERED.covers(at(own, has_gone), at(ahead, has_gone_ahead)),
        "each neighbour's cell is wholly covered, whoever of the two has gone",
    )?;
    let on_the_way = stays_in_range([own.from, own.to()], [ahead.from, ahead.to()]);
    require(on_the_way, "the neighbours' centres stay within r_cov, at whatever speeds they move")?;
    Ok(match (has_gone, has_gone_ahead) {
        (false, false) => "neither has gone",
        (true, false) => "the robot behind has gone",
        (false, true) => "the robot ahead has gone",
        (true, true) => "both have gone",
    })
}

/// CHAIN-3, inductive step: neighbours whose centres are within r_cov are so during the whole move.
///
/// # Errors
/// [`Stop`] if the choices are no case, or break the clause.
pub(super) fn coverage(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let pair = Pair::pick(&observed.rule, |behind, ahead| Circle::COVERED.reaches(behind, ahead), oracle)?;
    // A robot that meets a wall goes part of its way, and back.
    let path = |robot: Attempt| [robot.plan.from, robot.plan.to()];
    require(
        stays_in_range(path(pair.behind), path(pair.ahead)),
        "the neighbours' centres stay within r_cov, at whatever speeds they move",
    )?;
    Ok(pair.situation())
}
