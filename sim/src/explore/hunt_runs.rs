//! Tries: the hunt of agents whose sensors store trees. The traps of other agents are sought among states; here each
//! run is run, in every small layout, from every start, and with every choice of sensors that are missed: fewest first,
//! then the smallest area.

use std::fmt;

use tautline_kernel::ground::Cell;
use tautline_proofs::engine::lots::Lots;
use tautline_proofs::floor::trap::{End, Found, Look, Stage, Trap, stages, weight};

use super::agents::{Agents, Crew};
use super::catalogue::Scheme;
use super::each::Each;
use super::hunt::{Asked, Bound, HuntReport};
use super::hunt_states::{Sought, TAKEN, hunted, refusal, setup, so_far, sought};
use super::rule::RuleId;
use crate::diagnostic::Diagnostic;
use crate::layout::Layout;

/// Team moves for each cell after which a run is taken to go on for ever: an agent alone makes at most four
/// (BRICKS-10), and a missed sensor costs it a few.
const MANY: u32 = 100;

/// The way of the agents that are hunted.
#[derive(Debug)]
pub(super) struct Tries<K>(pub(super) K);

impl<K: Crew + Sync + Send + fmt::Debug> Each for Tries<K> {
    type Layouts = Runs<K>;

    const TAKES: &'static [Bound] = TAKEN;

    fn refusal(&self, bound: Bound) -> Option<(String, String)> {
        Some(refusal(bound))
    }

    fn layouts(&self, asked: &Asked<'_>) -> Result<Runs<K>, Diagnostic> {
        let &Asked { scheme, rule, .. } = asked;
        Ok(Runs { crew: self.0, scheme, rule, sought: sought(asked)? })
    }

    fn so_far(&self, asked: &Asked<'_>, found: &Found) -> String {
        so_far(asked, found)
    }

    fn told(&self, asked: &Asked<'_>, found: Found, is_complete: bool) -> Result<HuntReport, Diagnostic> {
        hunted(asked, &found.ended(is_complete), "run")
    }
}

/// Every run of these agents in every layout.
pub(super) struct Runs<K> {
    crew: K,
    scheme: Scheme,
    rule: RuleId,
    sought: Sought,
}

impl<K: Crew + Sync> Lots for Runs<K> {
    type Stage = Stage;
    type Lot = Plan;
    type Look = Look;
    type Found = Found;
    type Error = Diagnostic;

    fn stages(&self) -> Vec<Stage> {
        let Sought { max_misses, size, .. } = self.sought;
        stages(max_misses, (size.width(), size.height()))
    }

    fn lots(&self, (_, area): Stage) -> Result<Vec<Plan>, Diagnostic> {
        plans(area)
    }

    fn weight(&self, stage: Stage, plan: &Plan) -> u64 {
        weight(stage, plan.free.len() as u32, self.sought.agents)
    }

    fn look(&self, (misses, _): Stage, plan: &Plan, _: u64) -> Result<Look, Diagnostic> {
        self.plan(misses, plan)
    }

    fn add(&self, found: &mut Found, _: &Plan, look: Look) -> Result<(), Diagnostic> {
        found.add(look);
        Ok(())
    }

    fn cover(&self, found: &mut Found, stage: Stage) {
        found.cover(stage, &self.stages());
    }
}

impl<K: Crew + Sync> Runs<K> {
    /// Every run in one layout in which exactly so many sensors are missed.
    fn plan(&self, misses: u8, plan: &Plan) -> Result<Look, Diagnostic> {
        let mut look = Look { states: 0, steps: 0, is_whole: true, trap: None };
        let (free, agents) = (plan.free.len(), self.sought.agents);
        for number in 0..free.pow(agents) {
            let starts = (0..agents).map(|agent| plan.free[number / free.pow(agent) % free]).collect();
            let trap = Trap {
                width: plan.layout.width(),
                height: plan.layout.height(),
                blocked: plan.blocked.clone(),
                starts,
                missed: Vec::new(),
                moves: 0,
                end: End::Done,
            };
            self.try_each(trap, misses, &mut look)?;
        }
        Ok(look)
    }

    /// The run of `trap` as far as it is given, and with each way to miss so many sensors more after those that it
    /// misses.
    fn try_each(&self, trap: Trap, misses: u8, look: &mut Look) -> Result<(), Diagnostic> {
        let mut team = Agents::of(&setup(self.scheme, self.rule, &trap)?, self.crew);
        let (mut moves, mut end) = (0, None);
        while end.is_none() && !team.is_over() && team.explored() < team.due() {
            team.advance();
            moves += 1;
            if team.is_premature() {
                end = Some(End::Done);
            } else if moves >= MANY.saturating_mul(team.due()) {
                end = Some(End::Endless);
            }
        }
        look.steps += u64::from(moves);
        if misses == 0 {
            look.states += 1;
            let is_smaller = look.trap.as_ref().is_none_or(|least| moves < least.moves);
            if let Some(end) = end.filter(|_| is_smaller) {
                look.trap = Some(Trap { moves, end, ..trap });
            }
            return Ok(());
        }
        let first = trap.missed.last().map_or(1, |last| last + 1);
        for question in first..=team.asked() {
            let missed = [&trap.missed[..], &[question]].concat();
            self.try_each(Trap { missed, ..trap.clone() }, misses - 1, look)?;
        }
        Ok(())
    }
}

/// A layout of which all free cells are connected.
pub(super) struct Plan {
    layout: Layout,
    free: Vec<Cell>,
    blocked: Vec<Cell>,
}

/// Every layout of an area, blocked cells read as a binary number with the north-western one last.
fn plans((width, height): (i16, i16)) -> Result<Vec<Plan>, Diagnostic> {
    let open = Layout::open(width as u64, height as u64)?;
    let cells: Vec<Cell> = open.cells().collect();
    let mut plans = Vec::new();
    for set in 0..(1_u32 << cells.len()) - 1 {
        let with_bit = |bit: u32| {
            let cells = cells.iter().enumerate().filter(move |(place, _)| set >> place & 1 == bit);
            cells.map(|(_, &cell)| cell).collect::<Vec<Cell>>()
        };
        let (blocked, free) = (with_bit(1), with_bit(0));
        let layout = open.clone().with_blocked(blocked.iter().copied());
        if layout.reachable(&free[..1]).len() == free.len() {
            plans.push(Plan { layout, free, blocked });
        }
    }
    Ok(plans)
}
