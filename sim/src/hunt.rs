//! From the search over all layouts to files that anyone can replay: a [`Counterexample`] becomes the setup of a run
//! in a layout that has the walls met and no others.

mod saved;
pub mod trap;

use std::path::{Path, PathBuf};

use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::chain::Observed;
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::chain::search::{Bounds, Search, Unsearchable};

use tautline_proofs::engine::tree;
use tautline_proofs::run::Run;

use self::saved::AGAIN;
pub use self::saved::Saved;
use crate::aside::{Aside, Replaceable};
use crate::explore::{self, Limits, OnViolation, Report, RuleName, SchemeName, Setup, explore};
use crate::fault::{Fault, Halt};
use crate::layout::{Layout, Problem, Size};
use crate::trace;
use crate::words::Worded;

/// The run of a chain that `found` is, in the area of its search; it stops at the violation.
///
/// # Errors
/// [`Problem`] if the area is too large for a layout, or the base is outside.
pub fn setup(rule: RuleName, found: &Run) -> Result<Setup, Problem> {
    let mut layout = Layout::open(found.area.width() as u64, found.area.height() as u64)?;
    let origin = found.area.first();
    let shifted = |cell: Cell| Cell::new(cell.x - origin.x, cell.y - origin.y);
    for wall in &found.walls {
        layout.build_wall(Edge::new(shifted(wall.cell()), wall.side()));
    }
    let base = shifted(found.starts.first().copied().unwrap_or(origin));
    layout.place_base(base)?;
    let limits = Limits { violation: OnViolation::Stop, ..Limits::default() };
    Ok(Setup { limits, ..Setup::new(SchemeName::Chain, rule, found.starts.len() as u16, layout, base) })
}

/// The place in `folder` of a run of `setup` that breaks `breach`. The scheme is in its name unless the clause tells it.
pub fn path(folder: &Path, setup: &Setup, breach: Breach) -> PathBuf {
    let clause = breach.clause().to_lowercase();
    let Setup { scheme, rule, robots, .. } = setup;
    let is_told = clause.rsplit_once('-').is_some_and(|(family, _)| family == scheme.word());
    let scheme = if is_told { String::new() } else { format!("-{}", scheme.word()) };
    folder.join(format!("{clause}{scheme}-{rule}-n{robots}.jsonl"))
}

/// Writes the run of `setup`, which breaks `breach`, to a file in `folder` under a name that says so. The file has yet to
/// be put in its place.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store(
    folder: &Path,
    setup: &Setup,
    breach: Breach,
    replaceable: &Replaceable,
) -> Result<(Aside, Report), Halt> {
    store_at(&path(folder, setup, breach), setup, breach, replaceable)
}

/// The same with another name.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store_at(
    path: &Path,
    setup: &Setup,
    breach: Breach,
    replaceable: &Replaceable,
) -> Result<(Aside, Report), Halt> {
    let mut writer = trace::Writer::new(Aside::late(path, replaceable), setup, Some(breach));
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
pub fn bounds(rule: RuleName, robots: u64, max_walls: u32, size: Option<Size>) -> Result<Bounds, Fault> {
    let robots = usize::from(Setup::count_robots(robots, MAX_ROBOTS)?);
    let mut bounds = Bounds::new(Observed::honest(rule.chain()), robots, max_walls);
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
    Search::new(bounds).map_err(|refused| Fault::usage(refused, remedy(refused)))
}

/// What would be right where a hunt is refused.
pub fn remedy(refused: Unsearchable) -> String {
    let refused = match refused {
        Unsearchable::Team(refused) => return explore::chain::remedy(refused),
        Unsearchable::Search(refused) => refused,
    };
    match refused {
        tree::Unsearchable::TooManyWalls { edges, .. } => format!("give --max-walls a number up to {edges}"),
        tree::Unsearchable::TooLarge { .. } => "give fewer --robots or a smaller --size".to_owned(),
        tree::Unsearchable::Beyond { walls } => {
            format!("give --max-walls {walls} or more, or another --resume file")
        }
        tree::Unsearchable::Foreign => AGAIN.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_two_schemes_have_two_names() {
        let name = |scheme, breach| {
            let layout = Layout::open(3, 3).expect("a layout");
            let setup = Setup::new(scheme, RuleName::Repaired, 2, layout, Cell::new(1, 1));
            path(Path::new("a"), &setup, breach).display().to_string()
        };
        assert_eq!(name(SchemeName::Chain, Breach::Completeness), "a/chain-13-repaired-n2.jsonl");
        assert_eq!(name(SchemeName::Bricks, Breach::Premature), "a/bricks-4-repaired-n2.jsonl");
        assert_eq!(
            name(SchemeName::BricksAnts, Breach::Premature),
            "a/bricks-4-bricks-ants-repaired-n2.jsonl"
        );
    }
}
