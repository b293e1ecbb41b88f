//! The judge of FRONTIER: runs of robots that explore cells (FRONTIER-1 to FRONTIER-5, FRONTIER-13), of one whose fixes
//! are off by parts of a cell ([`Drift`]: FRONTIER-5), and the occupancy probability ([`Occupancy`]: FRONTIER-8), all
//! by the rules without repairs. It knows the sentences of `SPEC.md` alone.

mod drift;

use std::collections::{BTreeMap, BTreeSet};

use super::change::plain;
use super::{Case, Floor, Objection, Place, beside, breaks_at_last, must};
pub use drift::{Distance, Drift, Move, Occupancy};

/// A run of robots that explore cells.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// By which rule the robots go.
    pub rule: Rule,
    /// The cells, and the obstacles that the robots meet.
    pub floor: Floor,
    /// Where each robot starts.
    pub starts: Vec<Place>,
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// The last of the steps that are said to come again for ever; 0 if the run ends.
    pub round: usize,
    /// Whether fixes may be off, each by one cell, as in FRONTIER-5.
    pub errs: bool,
}

/// The rules without repairs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Rule {
    /// As published.
    Published,
    /// With equation (11) as printed.
    Printed,
    /// Obstacles are not stored.
    Literal,
    /// A robot without a candidate goes to any explored neighbour.
    Wanders,
    /// *Literal*, with an adaptive threshold.
    AdaptiveLiteral,
}

/// A step of a move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Step {
    /// The robot's place among all.
    pub robot: usize,
    /// The act.
    pub what: What,
    /// Through which side of its cell, of one that decides: east, south, west, north, from 0.
    pub side: Option<usize>,
    /// The cell that its fix says, of one that arrives.
    pub fix: Option<Place>,
}

/// An act of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum What {
    /// It goes to the rim of its cell.
    Decides,
    /// It looks into the next cell, sees no obstacle, and enters.
    Enters,
    /// It looks into the next cell, and there is an obstacle.
    IsBarred,
    /// It arrives.
    Arrives,
}

plain!(Run { rule, floor, starts, steps, round });
plain!(Rule one of Published, Printed, Literal, Wanders, AdaptiveLiteral);
plain!(Step { robot, what, side, fix });
plain!(What one of Decides, Enters, IsBarred, Arrives);

/// Where a robot is in its move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Stance {
    Stands,
    /// It goes to this side of its cell, and whether it took the cell beyond for unexplored.
    Tries(usize, bool),
    Enters(usize),
}

/// The cells that a robot takes for explored (true), and for obstacles.
type Repository = BTreeMap<Place, bool>;

#[derive(Clone, PartialEq, Eq, Debug)]
struct Robot {
    /// Where it is, and where it takes itself to be.
    cell: Place,
    at: Place,
    stance: Stance,
    known: Repository,
    /// Whether its threshold has fallen to 0.
    is_shut: bool,
    /// Where each other robot was when it told something last.
    told: Vec<Place>,
}

#[derive(Clone, PartialEq, Eq, Debug)]
struct Team {
    robots: Vec<Robot>,
    /// The cells that were entered, and the obstacles that were met.
    entered: BTreeSet<Place>,
    met: BTreeSet<Place>,
}

impl Case for Run {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { starts, steps, floor, .. } = self;
        let alone: BTreeSet<Place> = starts.iter().copied().collect();
        must(!starts.is_empty() && alone.len() == starts.len(), "robots start in cells of their own")?;
        must(starts.iter().all(|&start| floor.is_free(start)), "a robot starts in no free cell")?;
        must((self.clause == "FRONTIER-3") == (self.round > 0), "FRONTIER-3 is broken by a round alone")?;
        must(self.round <= steps.len(), "there are not so many steps")?;
        let known: Repository = alone.iter().map(|&start| (start, true)).collect();
        let robot = |&at: &Place| Robot {
            cell: at,
            at,
            stance: Stance::Stands,
            known: known.clone(),
            is_shut: false,
            told: starts.clone(),
        };
        let robots = starts.iter().map(robot).collect();
        let mut team = Team { robots, entered: alone, met: BTreeSet::new() };
        let mut before = None;
        let (mut acting, mut awake) = (BTreeSet::new(), (0..starts.len()).collect::<BTreeSet<_>>());
        for (number, step) in (1..).zip(steps) {
            let object = |what| Objection { at: number, what };
            if number > steps.len() - self.round {
                before.get_or_insert_with(|| team.clone());
                acting.insert(step.robot);
                awake.retain(|&robot| self.is_awake(&team.robots[robot]));
            }
            let is_double = is_double(&team, step);
            self.step(&mut team, step).map_err(object)?;
            let breaks = match self.clause {
                "FRONTIER-2" => meets(&team),
                "FRONTIER-5" => self.is_wrong(&team),
                "FRONTIER-13" => is_double,
                _ => continue,
            };
            breaks_at_last(breaks, number == steps.len()).map_err(object)?;
        }
        must(floor.barred.is_subset(&team.met), "an obstacle was never met")?;
        let is_over = team.robots.iter().all(|robot| !self.is_awake(robot));
        match self.clause {
            "FRONTIER-2" | "FRONTIER-5" | "FRONTIER-13" => Ok(must(!steps.is_empty(), "nothing happens")?),
            "FRONTIER-3" => {
                must(before.is_some_and(|before| before == team), "the last steps lead elsewhere")?;
                Ok(must(awake.is_subset(&acting), "a robot that may act never does")?)
            }
            "FRONTIER-1" | "FRONTIER-4" => {
                must(is_over, "the run goes on")?;
                if self.clause == "FRONTIER-4" {
                    let is_ignorant = team.robots.iter().any(|robot| self.has_more(robot));
                    return Ok(must(is_ignorant, "every robot knows that nothing is left")?);
                }
                let is_left =
                    self.floor.walkable(&self.starts).iter().any(|cell| !team.entered.contains(cell));
                Ok(must(is_left, "every cell is explored")?)
            }
            _ => Err("the judge does not know this clause".into()),
        }
    }
}

impl Run {
    /// Whether a robot must think that it could go to an unexplored cell, by ways through explored ones.
    fn has_more(&self, robot: &Robot) -> bool {
        let (mut reached, mut rim) = (BTreeSet::from([robot.at]), vec![robot.at]);
        while let Some(cell) = rim.pop() {
            for next in (0..4).filter_map(|side| beside(cell, side)).filter(|&next| self.floor.has(next)) {
                match robot.known.get(&next) {
                    None => return true,
                    Some(true) if reached.insert(next) => rim.push(next),
                    Some(_) => {}
                }
            }
        }
        false
    }
}

/// Whether a robot enters its frontier cell in this step, and one has entered that before.
fn is_double(team: &Team, step: &Step) -> bool {
    let Some(robot) = team.robots.get(step.robot) else { return false };
    let Stance::Tries(side, true) = robot.stance else { return false };
    step.what == What::Enters && beside(robot.cell, side).is_some_and(|cell| team.entered.contains(&cell))
}

/// Whether two robots are in one cell, or one enters a cell with another one in it.
fn meets(team: &Team) -> bool {
    let cells = |robot: &Robot| {
        let entering = if let Stance::Enters(side) = robot.stance { beside(robot.cell, side) } else { None };
        [Some(robot.cell), entering].into_iter().flatten().collect::<Vec<_>>()
    };
    let taken: Vec<Vec<Place>> = team.robots.iter().map(cells).collect();
    (0..taken.len())
        .any(|one| (0..one).any(|other| taken[one].iter().any(|cell| taken[other].contains(cell))))
}

/// The sides of a cell in the order of the numbers of the cells beyond: north, west, east, south.
pub(super) const BY_NUMBER: [usize; 4] = [3, 2, 0, 1];

impl Run {
    /// Whether a robot has a step to take.
    fn is_awake(&self, robot: &Robot) -> bool {
        robot.stance != Stance::Stands || !self.choices(robot).is_empty()
    }

    /// The sides through which the rule lets a robot go: that of its frontier cell; where it has none, and wanders,
    /// any that leads into an explored cell.
    fn choices(&self, robot: &Robot) -> Vec<usize> {
        let leads = |side: &usize, is: &dyn Fn(Place) -> bool| {
            beside(robot.at, *side).is_some_and(|cell| self.floor.has(cell) && is(cell))
        };
        // The occupancy of a cell is the highest for all robots, as far as it is told: at a midpoint 1, a cell
        // farther 0. As printed it is 1 a cell from a midpoint.
        let is_candidate = |cell: Place| {
            let is_taken = self.rule == Rule::Printed || robot.told.contains(&cell);
            !robot.known.contains_key(&cell) && !is_taken && !robot.is_shut
        };
        if let Some(side) = BY_NUMBER.into_iter().find(|side| leads(side, &is_candidate)) {
            return vec![side];
        }
        let is_explored = |cell: Place| robot.known.get(&cell) == Some(&true);
        let wanders = |side: &usize| self.rule == Rule::Wanders && leads(side, &is_explored);
        (0..4).filter(wanders).collect()
    }

    fn step(&self, team: &mut Team, step: &Step) -> Result<(), &'static str> {
        let Some(robot) = team.robots.get(step.robot).cloned() else { return Err("there is no such robot") };
        let own = step.robot;
        must(
            step.side.is_some() == (step.what == What::Decides),
            "a robot that decides has a side, and no other",
        )?;
        must(
            step.fix.is_some() == (step.what == What::Arrives),
            "a robot that arrives has a fix, and no other",
        )?;
        match (step.what, robot.stance) {
            (What::Decides, Stance::Stands) => {
                let side = step.side.filter(|side| self.choices(&robot).contains(side));
                let side = side.ok_or("the rule does not go there")?;
                let is_known = beside(robot.at, side).is_some_and(|cell| robot.known.contains_key(&cell));
                team.robots[own].stance = Stance::Tries(side, !is_known);
                // An adaptive threshold is above 0 where another robot is in one of the four neighbours.
                let mut near = (0..4).filter_map(|side| beside(robot.at, side));
                let is_alone = !near.any(|cell| robot.told.contains(&cell));
                team.robots[own].is_shut = self.rule == Rule::AdaptiveLiteral && is_alone;
            }
            (What::Enters | What::IsBarred, Stance::Tries(side, _)) => {
                let cell = beside(robot.cell, side).ok_or("there is no such side")?;
                let is_barred = step.what == What::IsBarred;
                must(is_barred != self.floor.is_free(cell), "there is an obstacle, or there is none")?;
                if is_barred {
                    team.met.insert(cell);
                    let taken = beside(robot.at, side).ok_or("there is no such side")?;
                    team.robots[own].stance = Stance::Stands;
                    self.tell(team, own, (taken, false));
                } else {
                    team.entered.insert(cell);
                    team.robots[own].stance = Stance::Enters(side);
                }
            }
            (What::Arrives, Stance::Enters(side)) => {
                let cell = beside(robot.cell, side).ok_or("there is no such side")?;
                let fix = step.fix.filter(|&fix| self.floor.has(fix)).ok_or("a fix is in the area")?;
                let is_beside = (fix.0 - cell.0).abs() + (fix.1 - cell.1).abs() == 1;
                must(
                    fix == cell || is_beside && self.errs,
                    "only where fixes may err one is off, and by one cell",
                )?;
                let robot = &mut team.robots[own];
                (robot.cell, robot.at, robot.stance) = (cell, fix, Stance::Stands);
                self.tell(team, own, (fix, true));
            }
            _ => return Err("a robot does what it cannot do now"),
        }
        Ok(())
    }

    /// A robot stores what it has found, and tells it to all others with where it takes itself to be. What is
    /// explored stays so; outside of the area nothing is stored. *Literal* stores no obstacle of its own.
    fn tell(&self, team: &mut Team, own: usize, (cell, is_explored): (Place, bool)) {
        let at = team.robots[own].at;
        for (number, robot) in team.robots.iter_mut().enumerate() {
            robot.told[own] = at;
            let is_literal = matches!(self.rule, Rule::Literal | Rule::AdaptiveLiteral);
            let stores = number != own || is_explored || !is_literal;
            if stores && self.floor.has(cell) {
                let known = robot.known.entry(cell).or_insert(is_explored);
                *known |= is_explored;
            }
        }
    }

    /// Whether a robot takes a cell for explored where none was, or for an obstacle where there is none.
    fn is_wrong(&self, team: &Team) -> bool {
        let is_so = |(cell, is_explored): (&Place, &bool)| {
            if *is_explored { team.entered.contains(cell) } else { !self.floor.is_free(*cell) }
        };
        team.robots.iter().any(|robot| !robot.known.iter().all(is_so))
    }
}
