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
use crate::explore::hunt::{Exhibit, Finding, HuntRequest, RunSize, setup};
use tautline_grids::layout::Size;

/// Robots of a chain when nobody says how many.
const DEFAULT_ROBOTS: u64 = 4;

/// Walls when nobody says how many.
const DEFAULT_WALLS: u32 = 4;

/// The most robots that are hunted for.
const MOST_ROBOTS: usize = 64;

/// Robots and walls that are asked for.
pub(super) fn team(asked: &HuntRequest<'_>) -> (u64, u32) {
    (asked.bounds.robots.unwrap_or(DEFAULT_ROBOTS), asked.bounds.max_walls.unwrap_or(DEFAULT_WALLS))
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
        let remedy = format_args!(
            "give `robots` a number from 2 to {MOST_ROBOTS}, the base counted; the most of them need a small `size`"
        );
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

/// A run that was found within `bounds`, as a hunt tells it; `size` says how large it is, of its walls and team moves
/// and of their words.
pub(super) fn finding(
    asked: &HuntRequest<'_>,
    bounds: &Bounds,
    found: &Counterexample,
    size: impl FnOnce(usize, usize, String) -> (RunSize, String),
) -> Result<Finding, Diagnostic> {
    let run = bounds.run(found);
    let setup = setup(asked.scheme, asked.rule, &run)?;
    let (walls, steps) = (run.walls.len(), found.frames.len());
    let moves = counted(steps, "team move");
    let (facts, title) = size(walls, steps, format!("{}, {moves}", counted(walls, "wall")));
    // A run that no file tells is shown by its layout, and by the sentence that is not so if it has an end.
    let shown = match (found.broken.breach(), found.broken) {
        (Some(breach), _) => Exhibit::Run(ClauseId::from(breach)),
        (None, Invariant::Ends) => Exhibit::Endless,
        (None, _) => {
            let (demand, layout) = (found.demand, &setup.layout);
            Exhibit::Told(format!("Not so: {demand}. The run of {moves} is in this layout:\n\n{layout}"))
        }
    };
    Ok(Finding { clause: found.broken.clause(), facts, title, setup, shown })
}

/// The fault of a search that is refused to so many robots.
pub(super) fn fault(refused: Unsearchable, robots: usize) -> Diagnostic {
    let refused = match refused {
        Unsearchable::Team(refused) => return team_fault(refused),
        Unsearchable::Search(refused) => refused,
    };
    let (field, remedy) = match refused {
        tree::Unsearchable::TooManyWalls { edges, .. } => {
            // No size gives a team of N robots more than the (2N−1)x(2N−1) cells in its reach.
            let side = (2 * robots as u32).saturating_sub(1);
            let is_smaller = edges < 2 * side * side.saturating_sub(1);
            let more = if is_smaller { "a larger `size`" } else { "more `robots`" };
            ("max-walls", format!("give `max-walls` a number up to {edges}, or {more}"))
        }
        tree::Unsearchable::TooLarge { .. } => {
            let side = (2 * robots).saturating_sub(1);
            (
                "size",
                format!("give fewer `robots` or a smaller `size`; without it there are {side}x{side} cells"),
            )
        }
        tree::Unsearchable::Beyond { walls } => {
            ("max-walls", format!("give `max-walls` {walls} or more, or another `resume` file"))
        }
        tree::Unsearchable::Foreign | tree::Unsearchable::Short => ("resume", AGAIN.to_owned()),
    };
    Diagnostic::of_field(field, refused, remedy)
}

/// The fault of a chain that is refused.
pub(super) fn team_fault(refused: SetupError) -> Diagnostic {
    let (field, remedy) = match refused {
        SetupError::TooFewRobots(_) | SetupError::TooManyRobots { .. } => {
            ("robots", format!("give `robots` a number from 2 to {MAX_ROBOTS}"))
        }
        SetupError::BaseOutside(_) => ("base", "give `base` a free cell of the layout".to_owned()),
    };
    Diagnostic::of_field(field, refused, remedy)
}

/// The remedy for a file that is no hunt of ours.
pub(super) const AGAIN: &str = "name another file, or remove it and hunt from the start";
