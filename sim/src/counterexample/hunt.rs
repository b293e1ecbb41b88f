//! From the search over all layouts to files that anyone can replay: a [`Run`] becomes the setup of one
//! in a layout that has the walls met and no others.

mod saved;
pub mod trap;

use std::path::{Path, PathBuf};

use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::chain::Observed;
use tautline_proofs::chain::search::{Bounds, Search, Unsearchable};
use tautline_proofs::engine::tree;
use tautline_proofs::run::Run;

use self::saved::AGAIN;
pub use self::saved::Saved;
use crate::aside::{Aside, Replaceable};
use crate::explore::chain;
use crate::explore::{ClauseId, Limits, OnViolation, Profile, Report, RuleId, Setup, explore};
use crate::fault::{Fault, Halt};
use crate::layout::{Layout, Problem, Size};
use crate::trace;

/// The run of `scheme` that `found` is, in the area of its search; it stops at the violation.
///
/// # Errors
/// [`Problem`] if the area is too large for a layout, or the base is outside.
pub fn setup(scheme: &'static Profile, rule: impl Into<RuleId>, found: &Run) -> Result<Setup, Problem> {
    let (mut layout, starts) = layout(found)?;
    let base = starts.first().copied().unwrap_or(Cell::new(0, 0));
    layout.place_base(base)?;
    let limits = Limits { violation: OnViolation::Stop, ..Limits::default() };
    Ok(Setup { limits, ..Setup::new(scheme, rule, starts.len() as u16, layout, base) })
}

/// The layout of a run that was found, which has the walls that were met and no others; and where the robots start in it.
///
/// # Errors
/// [`Problem`] if the area is too large for a layout.
pub fn layout(found: &Run) -> Result<(Layout, Vec<Cell>), Problem> {
    let mut layout = Layout::open(found.area.width() as u64, found.area.height() as u64)?;
    let origin = found.area.first();
    let shifted = |cell: Cell| Cell::new(cell.x - origin.x, cell.y - origin.y);
    for wall in &found.walls {
        layout.build_wall(Edge::new(shifted(wall.cell()), wall.side()));
    }
    Ok((layout, found.starts.iter().copied().map(shifted).collect()))
}

/// The place in `folder` of a run of `setup` that breaks `clause`. The scheme is in its name unless the clause tells it.
pub fn path(folder: &Path, setup: &Setup, clause: ClauseId) -> PathBuf {
    let clause = clause.as_str().to_lowercase();
    let Setup { scheme, rule, robots, .. } = setup;
    let is_told = clause.rsplit_once('-').is_some_and(|(family, _)| family == scheme.name);
    let scheme = if is_told { String::new() } else { format!("-{}", scheme.name) };
    folder.join(format!("{clause}{scheme}-{rule}-n{robots}.jsonl"))
}

/// Writes the run of `setup`, which breaks `clause`, to a file in `folder` under a name that says so. The file has yet to
/// be put in its place.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store(
    folder: &Path,
    setup: &Setup,
    clause: ClauseId,
    replaceable: &Replaceable,
) -> Result<(Aside, Report), Halt> {
    store_at(&path(folder, setup, clause), setup, clause, replaceable)
}

/// The same with another name.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store_at(
    path: &Path,
    setup: &Setup,
    clause: ClauseId,
    replaceable: &Replaceable,
) -> Result<(Aside, Report), Halt> {
    let aside = Aside::late(path, replaceable);
    let mut writer = trace::Writer::new(aside, &setup.stage(), Some(clause)).map_err(Fault::from)?;
    let report = explore(setup, &mut |made| {
        writer.add(made);
        Ok(())
    })?;
    Ok((writer.end(&report), report))
}

/// The most robots that are hunted for.
const MAX_ROBOTS: usize = 64;

/// The bounds of a hunt for `robots` in layouts of `size`, by default the (2N−1)² cells of the paper, with at most
/// `max_walls`.
///
/// # Errors
/// A [`Fault`] if there are too few or too many robots.
pub fn bounds(observed: Observed, robots: u64, max_walls: u32, size: Option<Size>) -> Result<Bounds, Fault> {
    let count = usize::try_from(robots).ok().filter(|count| (2..=MAX_ROBOTS).contains(count));
    let count = count.ok_or_else(|| {
        let what = match robots {
            0 => "no robots".to_owned(),
            1 => "the base alone".to_owned(),
            _ => format!("{robots} robots"),
        };
        Fault::of_field(
            "robots",
            format_args!("{what} cannot be the team"),
            format_args!("give `robots` a number from 2 to {MAX_ROBOTS}, the base counted"),
        )
    })?;
    let mut bounds = Bounds::new(observed, count, max_walls);
    if let Some(size) = size {
        bounds.base = Cell::new((size.width() - 1) / 2, (size.height() - 1) / 2);
        bounds.area = size.area();
    }
    Ok(bounds)
}

/// The search within `bounds`, from the start.
///
/// # Errors
/// A [`Fault`] if it cannot be made.
pub fn start(bounds: &Bounds) -> Result<Search, Fault> {
    Search::new(bounds).map_err(fault)
}

/// The fault of a search that is refused.
fn fault(refused: Unsearchable) -> Fault {
    let refused = match refused {
        Unsearchable::Team(refused) => return chain::fault(refused),
        Unsearchable::Search(refused) => refused,
    };
    match refused {
        tree::Unsearchable::TooManyWalls { edges, .. } => {
            Fault::of_field("max-walls", refused, format_args!("give `max-walls` a number up to {edges}"))
        }
        tree::Unsearchable::TooLarge { .. } => {
            Fault::of_field("size", refused, "give fewer `robots` or a smaller `size`")
        }
        tree::Unsearchable::Beyond { walls } => Fault::of_field(
            "max-walls",
            refused,
            format_args!("give `max-walls` {walls} or more, or another `resume` file"),
        ),
        tree::Unsearchable::Foreign => Fault::of_field("resume", refused, AGAIN),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::RuleName;
    use crate::explore::bricks::{BRICKS, BRICKS_ANTS};
    use crate::explore::chain::CHAIN;

    #[test]
    fn runs_of_two_schemes_have_two_names() {
        let name = |scheme, clause: &'static str| {
            let layout = Layout::open(3, 3).expect("a layout");
            let setup = Setup::new(scheme, RuleName::Repaired, 2, layout, Cell::new(1, 1));
            path(Path::new("a"), &setup, ClauseId::new(clause)).display().to_string()
        };
        assert_eq!(name(&CHAIN, "CHAIN-13"), "a/chain-13-repaired-n2.jsonl");
        assert_eq!(name(&BRICKS, "BRICKS-4"), "a/bricks-4-repaired-n2.jsonl");
        assert_eq!(name(&BRICKS_ANTS, "BRICKS-4"), "a/bricks-4-bricks-ants-repaired-n2.jsonl");
    }
}
