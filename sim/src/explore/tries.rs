//! Tries: the hunt of agents whose sensors store trees. The traps of other agents are sought among states; here each run is run,
//! in every small layout, from every start, and with every choice of sensors that are missed: fewest first, then the smallest area.

use std::fmt;
use std::ops::ControlFlow;

use rayon::prelude::*;
use tautline_kernel::ground::Cell;
use tautline_proofs::floor::trap::{End, Found, Trap};

use super::agents::{Agents, Crew};
use super::hunt::{Asked, Bound, Far, Hunt, Hunted, Hunter};
use super::traps::{Sought, TAKEN, hunted, quarry, refusal, setup, so_far, sought};
use crate::fault::Fault;
use crate::layout::{Layout, Size};

/// Team moves for each cell after which a run is taken to go on for ever: an agent alone makes at most four (BRICKS-10), and a
/// missed sensor costs it a few.
const MANY: u32 = 100;

/// Layouts that are looked at together.
const WAVE: usize = 64;

/// The way of the agents that are hunted.
#[derive(Debug)]
pub(super) struct Tries<K>(pub(super) K);

impl<K: Crew + Sync + fmt::Debug> Hunt for Tries<K> {
    fn takes(&self) -> &'static [Bound] {
        TAKEN
    }

    fn refusal(&self, bound: Bound) -> (String, String) {
        refusal(bound)
    }

    fn hunt(&self, asked: &Asked<'_>, hunter: &mut dyn Hunter) -> Result<Hunted, Fault> {
        let sought = sought(asked)?;
        let mut found = Found::default();
        let is_ended = self.look(asked, &sought, &mut found, hunter)?.is_break();
        found.is_complete = !is_ended;
        let trap = if is_ended { None } else { found.trap.take() };
        let quarries = trap.iter().map(|trap| quarry(asked, trap)).collect::<Result<Vec<_>, _>>()?;
        Ok(hunted((sought.agents, sought.max_misses), sought.size, (&found, "run"), quarries))
    }
}

impl<K: Crew + Sync> Tries<K> {
    /// Looks at all layouts until there is a trap; whether the work was ended before.
    fn look(
        &self,
        asked: &Asked<'_>,
        sought: &Sought,
        found: &mut Found,
        hunter: &mut dyn Hunter,
    ) -> Result<ControlFlow<()>, Fault> {
        for misses in 0..=sought.max_misses {
            for area in areas(sought.size) {
                let plans = plans(area)?;
                for wave in plans.chunks(WAVE) {
                    if asked.budget.is_some_and(|budget| found.steps >= budget) {
                        return Ok(ControlFlow::Break(()));
                    }
                    let looks: Result<Vec<Look>, Fault> =
                        wave.par_iter().map(|plan| self.plan(asked, sought.agents, misses, plan)).collect();
                    for Look { runs, steps, trap } in looks? {
                        found.layouts += 1;
                        found.states += runs;
                        found.steps += steps;
                        let is_smaller =
                            |trap: &Trap| found.trap.as_ref().is_none_or(|least| trap.moves < least.moves);
                        found.trap = trap.filter(is_smaller).or(found.trap.take());
                    }
                    if hunter.hears(Far::Words(so_far(found, sought.max_misses))).is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
                if found.trap.is_some() {
                    return Ok(ControlFlow::Continue(()));
                }
            }
            found.levels += 1;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Every run in one layout in which exactly so many sensors are missed.
    fn plan(&self, asked: &Asked<'_>, agents: u32, misses: u8, plan: &Plan) -> Result<Look, Fault> {
        let mut look = Look { runs: 0, steps: 0, trap: None };
        let free = plan.free.len();
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
            self.try_each(asked, trap, misses, &mut look)?;
        }
        Ok(look)
    }

    /// The run of `trap` as far as it is given, and with each way to miss so many sensors more after those that it misses.
    fn try_each(&self, asked: &Asked<'_>, trap: Trap, misses: u8, look: &mut Look) -> Result<(), Fault> {
        let mut team = Agents::of(&setup(asked.scheme, asked.rule, &trap)?, self.0);
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
            look.runs += 1;
            let is_smaller = look.trap.as_ref().is_none_or(|least| moves < least.moves);
            if let Some(end) = end.filter(|_| is_smaller) {
                look.trap = Some(Trap { moves, end, ..trap });
            }
            return Ok(());
        }
        let first = trap.missed.last().map_or(1, |last| last + 1);
        for question in first..=team.asked() {
            let missed = [&trap.missed[..], &[question]].concat();
            self.try_each(asked, Trap { missed, ..trap.clone() }, misses - 1, look)?;
        }
        Ok(())
    }
}

/// A layout of which all free cells are connected.
struct Plan {
    layout: Layout,
    free: Vec<Cell>,
    blocked: Vec<Cell>,
}

/// What was found in a layout.
struct Look {
    runs: u64,
    /// Team moves.
    steps: u64,
    trap: Option<Trap>,
}

/// The areas, the smallest first.
fn areas(size: Size) -> Vec<(i16, i16)> {
    let all = |width| (1..=size.height()).map(move |height| (width, height));
    let mut areas: Vec<(i16, i16)> = (1..=size.width()).flat_map(all).collect();
    areas.sort_unstable_by_key(|&(width, height)| (width * height, width));
    areas
}

/// Every layout of an area, blocked cells read as a binary number with the north-western one last.
fn plans((width, height): (i16, i16)) -> Result<Vec<Plan>, Fault> {
    let cells: Vec<Cell> = (0..height).flat_map(|y| (0..width).map(move |x| Cell::new(x, y))).collect();
    let mut plans = Vec::new();
    for set in 0..(1_u32 << cells.len()) - 1 {
        let mut layout = Layout::open(width as u64, height as u64)?;
        let (mut blocked, mut free) = (Vec::new(), Vec::new());
        for (place, &cell) in cells.iter().enumerate() {
            if set >> place & 1 == 1 {
                layout.block(cell);
                blocked.push(cell);
            } else {
                free.push(cell);
            }
        }
        let plan = Plan { layout, free, blocked };
        if plan.is_one() {
            plans.push(plan);
        }
    }
    Ok(plans)
}

impl Plan {
    /// Whether all free cells are connected.
    fn is_one(&self) -> bool {
        let Some(&first) = self.free.first() else { return false };
        let (mut reached, mut next) = (vec![first], 0);
        while let Some(&cell) = reached.get(next) {
            next += 1;
            let beside =
                self.free.iter().filter(|&&other| cell.apart(other) == (1, 0) || cell.apart(other) == (0, 1));
            let new: Vec<Cell> = beside.copied().filter(|other| !reached.contains(other)).collect();
            reached.extend(new);
        }
        reached.len() == self.free.len()
    }
}
