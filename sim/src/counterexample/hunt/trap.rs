//! Traps as runs that anyone can replay: a [`Trap`] becomes the setup of agents in its layout, with the sensors that
//! they miss written down.

use tautline_proofs::floor::trap::{Bounds, MAX_AGENTS, MAX_CELLS, Trap, Way};

use crate::explore::{Limits, OnViolation, Profile, RuleId, Setup};
use crate::fault::Fault;
use crate::layout::{Layout, Problem, Size};

/// Columns and rows of the layouts at most, if nobody says.
pub const DEFAULT_SIDE: u64 = 4;

/// The bounds of a hunt for traps of so many agents that decide by `way`, in layouts of at most `size`.
///
/// # Errors
/// A [`Fault`] if there are too few or too many agents or cells.
pub fn bounds(way: Way, agents: u64, max_misses: u8, size: Size) -> Result<Bounds, Fault> {
    let fitting = u32::try_from(agents).ok().filter(|agents| (1..=MAX_AGENTS).contains(agents));
    let agents = fitting.ok_or_else(|| {
        let what = format!("a hunt for traps of {agents} agents");
        Fault::of_field("robots", what, format_args!("give `robots` a number from 1 to {MAX_AGENTS}"))
    })?;
    if size.cells() > MAX_CELLS {
        let what = format!("{size} cells are {}, too many to search all their layouts", size.cells());
        let remedy = format!("give `size` at most {MAX_CELLS} cells, for example 4x4 or 8x2");
        return Err(Fault::of_field("size", what, remedy));
    }
    let (max_width, max_height) = (size.width(), size.height());
    Ok(Bounds { way, agents, max_misses, max_width, max_height, budget_steps: None })
}

/// The run that `trap` is; it stops at the violation.
///
/// # Errors
/// [`Problem`] if the trap does not fit into a layout.
pub fn setup(scheme: &'static Profile, rule: RuleId, trap: &Trap) -> Result<Setup, Problem> {
    let mut layout = Layout::open(trap.width as u64, trap.height as u64)?;
    for &cell in &trap.blocked {
        layout.block(cell);
    }
    let base = match trap.starts.first() {
        Some(&start) => start,
        None => layout.default_base()?,
    };
    layout.place_base(base)?;
    let starts = Some(trap.starts.clone()).filter(|starts| starts.iter().any(|&start| start != base));
    let limits = Limits { violation: OnViolation::Stop, ..Limits::default() };
    let setup = Setup::new(scheme, rule, trap.starts.len() as u16, layout, base);
    Ok(Setup { starts, missed: trap.missed.clone(), limits, ..setup })
}
