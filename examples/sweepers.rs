//! A team of one's own, simulated: robots that each go to the neighbouring cell where the team has been least, and tell
//! each other where they are. They run in offices, or on a map that is named: `cargo run -p tautline-examples --bin
//! sweepers -- map.yaml`.

use std::collections::BTreeMap;
use std::env;
use std::error::Error;
use std::num::NonZeroU32;

use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::run::Frame;
use tautline_sim::diagnostic::Halt;
use tautline_sim::explore::{End, Limits, Milestone, Report, Team, run};
use tautline_sim::layout::{self, Layout};

/// The robots, and how often the team has been in each cell or found it shut.
struct Sweepers {
    cells: Vec<Cell>,
    visits: BTreeMap<Cell, u32>,
}

impl Sweepers {
    fn new(start: Cell, robots: usize) -> Self {
        Self { cells: vec![start; robots], visits: BTreeMap::from([(start, 1)]) }
    }
}

impl Team for Sweepers {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        let (mut steps, mut blocked) = (Vec::new(), Vec::new());
        for cell in &mut self.cells {
            let visits = |side: &Side| self.visits.get(&cell.beyond(*side)).copied().unwrap_or(0);
            let side = Side::ALL.into_iter().min_by_key(visits).unwrap_or(Side::East);
            let is_blocked = !is_open(Edge::new(*cell, side));
            *self.visits.entry(cell.beyond(side)).or_default() += 1;
            if !is_blocked {
                *cell = cell.beyond(side);
            }
            steps.push(Step::Cross(side));
            blocked.push(is_blocked);
        }
        Ok(Frame { kind: Kind::Advance, steps, blocked, cells: self.cells.clone() })
    }
}

/// Runs `robots` in `layout` until everything is explored, or one has entered so many cells.
fn sweep(layout: &Layout, robots: usize, most: u32) -> Result<Report, Halt> {
    let start = layout.default_base().map_err(|problem| Halt::Diagnostic(problem.into()))?;
    let (until, max_moves) = (Some(Milestone::Whole), NonZeroU32::new(most));
    let limits = Limits { until, max_moves, ..Limits::default() };
    run(&mut Sweepers::new(start, robots), layout, limits, &mut |_| Ok(()))
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
