//! The area of a team: its layouts as sets of walls, what its symmetries make of them, and what has to be explored.

use tautline_kernel::chain::Rule;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::chain::optimum::{Guide, Optimum, explore_all};
use tautline_proofs::chain::reach::{CellSet, Ground};

use super::super::prelude::*;
use tautline_grids::layout::Size;
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::{RuleName, Setup};

/// The rule of a team that knows the layout. Every edge is known to it and every robot arrives, so that *UnsureAhead*
/// is met and, by *Distinct*, no two robots share a cell outside the base, which leaves *FullForFollower* and
/// *FullForLeader* nothing to forbid: both rules admit the same.
const KNOWING: Rule = Rule::REPAIRED;

/// States that the solver may meet in one layout.
pub(super) const MOST_STATES: usize = 10_000_000;

pub(super) fn solve(ground: &Ground, goals: &CellSet) -> Result<Optimum, Halt> {
    let optimum = explore_all(ground, &KNOWING, goals, Guide::Distances, MOST_STATES);
    Ok(optimum.map_err(|unsolved| Diagnostic::usage(unsolved, "give fewer --max-walls"))?)
}

/// Walls of a layout, one bit for each edge in the order of [`Layout::edges`].
pub(super) type WallSet = u64;

/// The sets of `walls` of so many `edges`, at most 63, the smallest number first.
fn wall_sets(edges: usize, walls: u32) -> impl Iterator<Item = WallSet> {
    let next = |&set: &WallSet| {
        let lowest = set & set.wrapping_neg();
        let carried = set + lowest;
        (set != 0).then(|| carried | ((carried ^ set) / lowest) >> 2)
    };
    let first = (walls as usize <= edges).then(|| (1 << walls) - 1);
    std::iter::successors(first, next).take_while(move |set| set >> edges == 0)
}

/// The area of a team.
pub(super) struct Area {
    pub(super) robots: u16,
    open: Layout,
    base: Cell,
    edges: Vec<Edge>,
    /// The eight symmetries of the square: by edge, the place of its image.
    symmetries: [Vec<usize>; 8],
}

impl Area {
    pub(super) fn new(robots: u16) -> Result<Self, Halt> {
        let side = 2 * u64::from(robots) - 1;
        let mut open = Layout::of(Size::new(side, side)?);
        let base = open.default_base()?;
        open.place_base(base)?;
        let edges: Vec<Edge> = open.edges().collect();
        let symmetries = std::array::from_fn(|symmetry| {
            let image = |cell: Cell| {
                let (x, y) = if symmetry & 1 == 0 { (cell.x, cell.y) } else { (cell.y, cell.x) };
                let mirrored = |coordinate, bit| match symmetry & bit {
                    0 => coordinate,
                    _ => side as i16 - 1 - coordinate,
                };
                Cell::new(mirrored(x, 2), mirrored(y, 4))
            };
            let ends = |edge: &Edge| [edge.cell(), edge.cell().beyond(edge.side())];
            let place = |edge: &Edge| {
                let [one, other] = ends(edge).map(image);
                edges.iter().position(|edge| [[one, other], [other, one]].contains(&ends(edge)))
            };
            edges.iter().filter_map(place).collect()
        });
        Ok(Self { robots, open, base, edges, symmetries })
    }

    /// The sets of so many walls, those together that are images of one another; the smallest of them first.
    pub(super) fn orbits(&self, walls: u32) -> impl Iterator<Item = Vec<WallSet>> {
        wall_sets(self.edges.len(), walls).filter_map(|walls| {
            let image = |symmetry: &Vec<usize>| {
                let images = symmetry.iter().enumerate().map(|(edge, &image)| (walls >> edge & 1) << image);
                images.fold(0, |set, wall| set | wall)
            };
            let mut orbit: Vec<WallSet> = self.symmetries.iter().map(image).collect();
            orbit.sort_unstable();
            orbit.dedup();
            (orbit[0] == walls).then_some(orbit)
        })
    }

    pub(super) fn layout(&self, walls: WallSet) -> Layout {
        let mut layout = self.open.clone();
        for (place, &edge) in self.edges.iter().enumerate() {
            if walls >> place & 1 == 1 {
                layout.build_wall(edge);
            }
        }
        layout
    }

    pub(super) fn setup(&self, rule: RuleName, layout: Layout) -> Setup {
        Setup::new(&CHAIN, rule, self.robots, layout, self.base)
    }

    /// The cells of `layout` that a team which knows it has to explore.
    pub(super) fn goals(&self, layout: &Layout) -> Result<(Ground, CellSet), Halt> {
        let is_open = |edge| layout.is_open(edge);
        let outside = || Diagnostic::usage("the base is outside the layout", "place it on a free cell");
        let ground = Ground::new(layout.size().area(), self.base, self.robots.into(), is_open);
        let ground = ground.ok_or_else(outside)?;
        let goals = ground.reachable(&KNOWING);
        let goals = goals.map_err(|too_large| Diagnostic::usage(too_large, "measure fewer robots"))?;
        Ok((ground, goals))
    }
}
