//! Traps: the hunt of agents on a sensor floor. A [`Trap`] becomes the setup of agents in its layout, with the sensors
//! that they miss written down.

use tautline_io::diagnostic::Diagnostic;
use tautline_proofs::floor::crew::Scheme as Crew;
use tautline_proofs::floor::trap::{Bounds, End, MAX_AGENTS, MAX_CELLS, Trap, TrapReport};
use tautline_proofs::plural::counted;

use super::agents::{self, PREMATURE, UNEXPLORED};
use super::by_layout::Each;
use super::hunt::{Bound, CoveredBound, Exhibit, Facts, Finding, HuntReport, HuntRequest, RunSize};
use super::switches::SwitchableRule;
use super::{ClauseId, Setup};
use tautline_grids::layout::{Layout, Size};

/// Columns and rows of the layouts at most, if nobody says.
const DEFAULT_SIDE: u64 = 4;

/// Agents when nobody says how many.
const DEFAULT_AGENTS: u64 = 1;

/// Sensors that are missed at most when nobody says how many.
const DEFAULT_MISSES: u8 = 1;

/// The words for a trap.
const TRAPPED: &str = "done, or going round for ever, before every cell is explored";

/// The rule of a crew: how it starts, and how it is hunted.
macro_rules! crew {
    ($rule:expr, $crew:expr) => {
        $rule(|setup| Ok($crate::explore::agents::start(setup, $crew)))
            .hunted(&$crate::explore::hunt_states::Traps($crew))
    };
    ($name:expr, $about:expr, $crew:expr) => {
        Rule::new(RuleId::new($name), $about, |setup| Ok($crate::explore::agents::start(setup, $crew)))
            .hunted(&$crate::explore::hunt_states::Traps($crew))
    };
}
pub(super) use crew;

/// The rule of a crew whose conditions can be switched.
macro_rules! switched_crew {
    ($($rule:expr),+; $crew:expr) => {
        crew!($($rule),+, $crew).switched(&$crate::explore::hunt_states::switched($crew))
    };
}
pub(super) use switched_crew;

/// The rule of a crew whose conditions can be switched.
pub(super) const fn switched<C: Crew>(rule: C) -> SwitchableRule<C> {
    SwitchableRule {
        rule,
        start: |setup, crew| Ok(agents::start(setup, crew)),
        hunt: |crew, _| Some(Box::new(Traps(crew))),
    }
}

/// The hunt of a crew.
#[derive(Debug)]
pub(super) struct Traps<C>(pub(super) C);

impl<C: Crew> Each for Traps<C> {
    type Layouts = Bounds<C>;

    const TAKES: &'static [Bound] = &[Bound::Misses];

    fn refusal(&self, bound: Bound) -> Option<(String, String)> {
        let (what, remedy) = match bound {
            Bound::Walls => (
                "agents know every wall: no number of walls bounds their search",
                "give `max-misses` for the sensors, and `size` for the layouts",
            ),
            Bound::Resume => (
                "a hunt for traps is not kept in a file",
                "leave `resume` out; a smaller `size` or `budget` makes it shorter",
            ),
            Bound::Cells => ("the areas of agents are bounded by their size", "give `size` for the layouts"),
            Bound::Misses | Bound::Losses | Bound::Error | Bound::Range => {
                ("agents send no messages and need no fixes", "give `max-misses` for the sensors")
            }
        };
        Some((what.to_owned(), remedy.to_owned()))
    }

    fn layouts(&self, asked: &HuntRequest<'_>) -> Result<Bounds<C>, Diagnostic> {
        let size = asked.bounds.size.map_or_else(|| Size::new(DEFAULT_SIDE, DEFAULT_SIDE), Ok)?;
        let agents = asked.bounds.robots.unwrap_or(DEFAULT_AGENTS);
        let fitting = u32::try_from(agents).ok().filter(|agents| (1..=MAX_AGENTS).contains(agents));
        let agents = fitting.ok_or_else(|| {
            let what = format!("there is no hunt for traps of {agents} agents");
            let remedy = format_args!("give `robots` a number from 1 to {MAX_AGENTS}");
            Diagnostic::of_field("robots", what, remedy)
        })?;
        if size.cells() > MAX_CELLS {
            let what = format!("{size} cells are {}, too many to search all their layouts", size.cells());
            let remedy = format!("give `size` at most {MAX_CELLS} cells, for example 4x4 or 8x2");
            return Err(Diagnostic::of_field("size", what, remedy));
        }
        Ok(Bounds {
            scheme: self.0,
            agents,
            max_misses: asked.bounds.max_misses.unwrap_or(DEFAULT_MISSES),
            max_width: size.width(),
            max_height: size.height(),
            budget_steps: asked.budget,
        })
    }

    fn so_far(&self, asked: &HuntRequest<'_>, found: &TrapReport) -> String {
        let TrapReport { layouts, states, levels, .. } = found;
        let max_misses = asked.bounds.max_misses.unwrap_or(DEFAULT_MISSES);
        format!("misses {levels} of {max_misses}, layouts {layouts}, states {states}")
    }

    fn report(
        &self,
        asked: &HuntRequest<'_>,
        found: TrapReport,
        is_complete: bool,
    ) -> Result<HuntReport, Diagnostic> {
        let Bounds { agents, max_misses, max_width, max_height, .. } = self.layouts(asked)?;
        let size = format!("{max_width}x{max_height}");
        let TrapReport { layouts, states, steps, levels, trap, is_complete } = found.ended(is_complete);
        let found = trap.iter().map(|trap| finding(asked, trap)).collect::<Result<Vec<_>, _>>()?;
        let done = levels.checked_sub(1).map(|misses| misses as u8);
        let bound = match done {
            Some(misses) if misses == max_misses => "in any layout within this bound".to_owned(),
            Some(misses) => format!("with at most {misses} missed; the hunt was ended before its bound"),
            None => "so far; the hunt was ended before it had covered all layouts".to_owned(),
        };
        let order = if agents == 1 { "" } else { " that act in turn" };
        let (all_layouts, all_states) = (counted(layouts, "layout"), counted(states, "state"));
        let (all_agents, all_moves) = (counted(agents, "agent"), counted(steps, "team move"));
        Ok(HuntReport {
            robots: agents.into(),
            title: format!(
                "{all_agents}{order}, at most {max_misses} missed, layouts up to {size}: {all_layouts}, \
                 {all_states}, {all_moves}"
            ),
            looked_for: [PREMATURE, UNEXPLORED].map(ClauseId::as_str).to_vec(),
            facts: Facts::Layouts { size, layouts, states, steps, max_misses },
            is_complete,
            done: CoveredBound::MissesDone(done),
            through: format!("{all_layouts} and {all_states}"),
            outcome: match (&found[..], is_complete) {
                ([], _) => format!("No agent is trapped ({TRAPPED}) {bound}."),
                (_, false) => "Found before the hunt was ended; it need not be the smallest:".to_owned(),
                (_, true) => {
                    format!(
                        "The fewest missed sensors and the smallest layout with which agents are trapped ({TRAPPED}):"
                    )
                }
            },
            not_minimised: Vec::new(),
            found,
        })
    }
}

/// The run that `trap` is, as a hunt tells it; it stops at the violation.
fn finding(asked: &HuntRequest<'_>, trap: &Trap) -> Result<Finding, Diagnostic> {
    let Trap { width, height, moves, .. } = *trap;
    let misses = trap.missed.len();
    let layout = Layout::open(width as u64, height as u64)?.with_blocked(trap.blocked.iter().copied());
    let setup = HuntRequest::new(asked.scheme, asked.rule).setup(layout, trap.starts.clone(), None)?;
    let setup = Setup { missed: trap.missed.clone(), ..setup };
    let clause = match trap.end {
        End::Done => PREMATURE,
        End::Endless => UNEXPLORED,
    };
    let facts = RunSize::Misses { misses, columns: width, rows: height, steps: moves };
    let title = format!("{misses} missed, {width}x{height} cells, {}", counted(moves, "team move"));
    Ok(Finding { clause: clause.as_str(), facts, title, setup, shown: Exhibit::Run(clause) })
}
