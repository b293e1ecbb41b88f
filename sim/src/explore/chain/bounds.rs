//! The bounds of a hunt of chains, what is refused, and how a run that was found is shown.

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::chain::{MAX_ROBOTS, SetupError};
use tautline_kernel::ground::Cell;
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::search::{Bounds, Counterexample, Unsearchable};
use tautline_proofs::engine::tree;
use tautline_proofs::plural::counted;

use crate::explore::ClauseId;
use crate::explore::hunt::{Exhibit, HuntRequest};
use tautline_grids::layout::{Layout, Size};

/// Robots of a chain when nobody says how many.
const DEFAULT_ROBOTS: u64 = 4;

/// Walls when nobody says how many.
const DEFAULT_WALLS: u32 = 4;

/// The most robots that are hunted for.
const MOST_ROBOTS: usize = 64;

/// Robots and walls that are asked for.
pub(super) fn team(asked: &HuntRequest<'_>) -> (u64, u32) {
    (asked.robots.unwrap_or(DEFAULT_ROBOTS), asked.max_walls.unwrap_or(DEFAULT_WALLS))
}

/// The bounds of a hunt for `robots` in layouts of `size`, by default the (2N−1)² cells of the paper, with at most
/// `max_walls`.
///
/// # Errors
/// A [`Diagnostic`] if there are too few or too many robots.
pub fn bounds(
    observed: Subject,
    robots: u64,
    max_walls: u32,
    size: Option<Size>,
) -> Result<Bounds, Diagnostic> {
    let count = usize::try_from(robots).ok().filter(|count| (2..=MOST_ROBOTS).contains(count));
    let count = count.ok_or_else(|| {
        let what = match robots {
            0 => "no robots".to_owned(),
            1 => "the base alone".to_owned(),
            _ => format!("{robots} robots"),
        };
        let remedy = format_args!("give `robots` a number from 2 to {MOST_ROBOTS}, the base counted");
        Diagnostic::of_field("robots", format_args!("{what} cannot be the team"), remedy)
    })?;
    let invariants = Invariant::of_hunts(&observed.intended);
    let mut bounds = Bounds { invariants, ..Bounds::new(observed, count, max_walls) };
    if let Some(size) = size {
        bounds.base = Cell::new((size.width() - 1) / 2, (size.height() - 1) / 2);
        bounds.area = size.area();
    }
    Ok(bounds)
}

/// How a run that was found is shown: one that a file can tell by its last team move, one without end by its layout,
/// and one that breaks what no file tells by its layout and the sentence that is not so.
pub(super) fn exhibit(found: &Counterexample, layout: &Layout) -> Exhibit {
    match (found.broken.breach(), found.broken) {
        (Some(breach), _) => Exhibit::Run(ClauseId::from(breach)),
        (None, Invariant::Ends) => Exhibit::Endless,
        (None, _) => {
            let moves = counted(found.frames.len(), "team move");
            Exhibit::Told(format!(
                "Not so: {}. The run of {moves} is in this layout:\n\n{layout}",
                found.demand
            ))
        }
    }
}

/// The fault of a search that is refused to so many robots.
pub(super) fn fault(refused: Unsearchable, robots: usize) -> Diagnostic {
    let refused = match refused {
        Unsearchable::Team(refused) => return team_fault(refused),
        Unsearchable::Search(refused) => refused,
    };
    match refused {
        tree::Unsearchable::TooManyWalls { edges, .. } => {
            // No size gives a team of N robots more than the (2N−1)x(2N−1) cells in its reach.
            let side = (2 * robots as u32).saturating_sub(1);
            let is_smaller = edges < 2 * side * side.saturating_sub(1);
            let more = if is_smaller { "a larger `size`" } else { "more `robots`" };
            let remedy = format_args!("give `max-walls` a number up to {edges}, or {more}");
            Diagnostic::of_field("max-walls", refused, remedy)
        }
        tree::Unsearchable::TooLarge { .. } => {
            Diagnostic::of_field("size", refused, "give fewer `robots` or a smaller `size`")
        }
        tree::Unsearchable::Beyond { walls } => Diagnostic::of_field(
            "max-walls",
            refused,
            format_args!("give `max-walls` {walls} or more, or another `resume` file"),
        ),
        tree::Unsearchable::Foreign | tree::Unsearchable::Short => {
            Diagnostic::of_field("resume", refused, AGAIN)
        }
    }
}

/// The fault of a chain that is refused.
pub(super) fn team_fault(refused: SetupError) -> Diagnostic {
    match refused {
        SetupError::TooFewRobots(_) | SetupError::TooManyRobots { .. } => {
            let remedy = format!("give `robots` a number from 2 to {MAX_ROBOTS}");
            Diagnostic::of_field("robots", refused, remedy)
        }
        SetupError::BaseOutside(_) => {
            Diagnostic::of_field("base", refused, "give `base` a free cell of the layout")
        }
    }
}

/// The remedy for a file that is no hunt of ours.
pub(super) const AGAIN: &str = "name another file, or remove it and hunt from the start";
