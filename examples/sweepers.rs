//! A rule of one's own, simulated: robots that each go to the neighbouring cell where the team has been least, and tell
//! each other where they go. They run in offices, or on a map that is named: `cargo run -p tautline-examples --bin
//! sweepers -- map.yaml`.

use std::collections::BTreeMap;
use std::env;
use std::error::Error;
use std::num::NonZeroU32;

use tautline_grids::layout::{self, Layout};
use tautline_io::diagnostic::Halt;
use tautline_kernel::ground::{Cell, Side};
use tautline_proofs::team::{Act, Ground, Places, Rule, Setting, View};
use tautline_sim::explore::{Limits, Milestone, Own, Report, run};

/// Robots that go to the neighbouring cell where they know the team to have been least.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Sweepers;

impl Rule for Sweepers {
    /// How often the team has gone to each cell.
    type Memory = BTreeMap<Cell, u32>;
    /// The cell to which the sender goes.
    type Message = Cell;

    fn start(&self, _: usize, starts: &[Cell]) -> Self::Memory {
        starts.iter().map(|&start| (start, 1)).collect()
    }

    fn act(&self, view: &mut View<'_, Self>, visits: &mut Self::Memory) -> Act {
        for &(_, cell) in view.heard() {
            *visits.entry(cell).or_default() += 1;
        }
        let often = |side: &Side| visits.get(&view.cell().beyond(*side)).copied().unwrap_or(0);
        // Each begins on another side, so that robots in one cell part.
        let sides = Side::ALL.into_iter().cycle().skip(view.me()).take(Side::ALL.len());
        let side = sides.min_by_key(often).unwrap_or(Side::East);
        let next = view.cell().beyond(side);
        *visits.entry(next).or_default() += 1;
        view.tell(next);
        Act::Go(side)
    }
}

static SETTING: Setting<'_, Sweepers> =
    Setting::new("sweepers", Ground::open(1, 1), 1, Places::At(|_: &Sweepers| vec![Cell::new(0, 0)]));

/// Runs `robots` in `layout` until everything is explored, or one has entered so many cells.
fn sweep(layout: &Layout, robots: usize, most: u32) -> Result<Report, Halt> {
    let start = layout.default_base()?;
    let (until, max_moves) = (Some(Milestone::Whole), NonZeroU32::new(most));
    let limits = Limits { until, max_moves, ..Limits::default() };
    let team = SETTING.in_layout(&Sweepers, &vec![start; robots], Vec::new());
    run(&mut Own::new(team, 0), layout, limits, &mut |_| Ok(()))
}

fn main() -> Result<(), Box<dyn Error>> {
    let layout = layout::load(&env::args().nth(1).unwrap_or("rooms-a".to_owned()), 0, None)?;
    for robots in [1, 2, 4, 8] {
        let Report { steps, explored, cells, .. } = sweep(&layout, robots, 100_000)?;
        println!("{robots} robots: {explored} of {cells} cells in {steps} team moves");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_robots_sweep_the_offices_in_fewer_team_moves() {
        let layout = layout::load("rooms-a", 0, None).expect("a layout");
        let swept = [1, 2, 4].map(|robots| sweep(&layout, robots, 100_000).expect("nobody stops it"));
        assert!(swept.iter().all(|report| report.explored == report.cells), "{swept:?}");
        let [one, two, four] = swept.map(|report| report.steps);
        assert!(one > two && two > four, "{one} {two} {four}");
    }

    #[test]
    fn a_published_map_is_swept() {
        let Some(folder) = env::var_os("TAUTLINE_MAPS") else { return };
        let map = std::path::Path::new(&folder).join("random-32-32-20.map");
        let layout = layout::load(&map.display().to_string(), 0, None).expect("a layout");
        let report = sweep(&layout, 4, 100_000).expect("nobody stops it");
        assert_eq!((report.explored, report.cells), (819, 819));
    }
}
