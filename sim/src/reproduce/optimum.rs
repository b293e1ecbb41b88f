//! How far the chain, which meets its walls on the way, is from a team that knows them: team moves until the last
//! chain-reachable cell is explored, against the fewest in which that can be done, in all layouts of small areas.
//! Layouts that a symmetry of the square makes of one another have one optimum, so it is solved once for them; the
//! chain, whose order of directions has no such symmetry, runs in each. The counts are whole numbers, so that the
//! result is the same on any number of threads.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::{Serialize, Serializer};
use tautline_kernel::chain::Rule;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::chain::optimum::{Guide, Optimum, explore_all};
use tautline_proofs::chain::reach::{CellSet, Ground};

use super::interval::hundredths;
use crate::explore::chain::CHAIN;
use crate::explore::{Chart, RuleName, Setup, explore};
use crate::fault::{Fault, Halt, Watch};
use crate::layout::{Layout, Problem, Size};

/// A team, and the layouts of its area that it is measured in: (2N−1)² cells, the base in the middle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Field {
    robots: u16,
    /// The fewest walls and the most.
    walls: [u32; 2],
}

impl Field {
    /// Two robots in all 4096 layouts.
    pub const TWO_ROBOTS: Self = Self { robots: 2, walls: [0, 12] };

    /// Three robots in all layouts with so many walls.
    pub const fn three_robots(walls: u32) -> Self {
        Self { robots: 3, walls: [walls, walls] }
    }

    /// How many layouts it has.
    pub fn layouts(self) -> u64 {
        let side = 2 * u64::from(self.robots) - 1;
        let edges = 2 * side * (side - 1);
        let of = |walls: u32| {
            (0..u64::from(walls)).fold(1, |sets, less| sets * edges.saturating_sub(less) / (less + 1))
        };
        (self.walls[0]..=self.walls[1]).map(of).sum()
    }
}

/// One rule in the layouts of one team with some numbers of walls.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Line {
    /// Robots, base included.
    pub robots: u16,
    /// The fewest walls and the most.
    pub walls: [u32; 2],
    /// As published or repaired.
    pub rule: RuleName,
    /// How many layouts.
    pub layouts: u64,
    /// Those in which no cell but the base can be reached: there is nothing to compare.
    pub walled_in: u64,
    /// Those in which the chain leaves a chain-reachable cell unexplored: they are not compared.
    pub missed: u64,
    /// Those in which the chain explores a cell that is not chain-reachable.
    pub beyond: u64,
    /// Those that are compared.
    pub compared: u64,
    /// Of those compared: the chain takes fewer team moves than the optimum. There must be none.
    pub below: u64,
    /// Of those compared: the chain takes as few.
    pub optimal: u64,
    /// The mean of the chain's team moves by the optimum, over those compared.
    pub mean: Option<f64>,
    /// The layout in which it is largest: of several, one with the fewest walls.
    pub worst: Option<Worst>,
}

/// The layout in which the chain is farthest from the optimum.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Worst {
    /// The chain's team moves.
    pub chain: u32,
    /// The optimum.
    pub optimum: u32,
    /// The layout, with the base.
    #[serde(serialize_with = "as_drawing")]
    pub layout: Layout,
}

fn as_drawing<S: Serializer>(layout: &Layout, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(layout)
}

/// Measures both rules in `field`. `watch` hears of each layout.
///
/// # Errors
/// [`Halt`], as `watch` returned it, or if an optimum takes too many states.
pub fn measure(field: Field, watch: &Watch<'_>) -> Result<[Line; 2], Halt> {
    let area = Area::new(field.robots)?;
    let orbits: Vec<Vec<WallSet>> =
        (field.walls[0]..=field.walls[1]).flat_map(|walls| area.orbits(walls)).collect();
    let sums = orbits.par_iter().map(|orbit| {
        let sums = area.compare(orbit)?;
        orbit.iter().try_for_each(|_| watch())?;
        Ok::<_, Halt>(sums)
    });
    let [published, repaired] = sums.try_reduce(Default::default, |one, other| Ok(both(one, other)))?;
    let line = |rule, sums: Sums| sums.line(&area, field.walls, rule);
    Ok([line(RuleName::Published, published), line(RuleName::Repaired, repaired)])
}

/// The run of the chain in the layout of `worst`, and when each cell is explored in it and in the optimum.
///
/// # Errors
/// [`Halt`] if the layout is none that was measured.
pub fn charts(line: &Line, worst: &Worst) -> Result<(Setup, [Chart; 2]), Halt> {
    let area = Area::new(line.robots)?;
    let setup = area.setup(line.rule, worst.layout.clone());
    let report = explore(&setup, &mut |_| Ok(()))?;
    let (ground, goals) = area.goals(&worst.layout)?;
    let optimum = solve(&ground, &goals)?;
    let charted = Chart::of(ground.area(), optimum.configurations.iter().map(Vec::as_slice));
    Ok((setup, [report.chart, charted]))
}

/// The rule of a team that knows the layout. Every edge is known to it and every robot arrives, so that *UnsureAhead*
/// is met and, by *Distinct*, no two robots share a cell outside the base, which leaves *FullForFollower* and
/// *FullForLeader* nothing to forbid: both rules admit the same.
const KNOWING: Rule = Rule::REPAIRED;

/// States that the solver may meet in one layout.
const MOST_STATES: usize = 10_000_000;

fn solve(ground: &Ground, goals: &CellSet) -> Result<Optimum, Halt> {
    let optimum = explore_all(ground, &KNOWING, goals, Guide::Distances, MOST_STATES);
    Ok(optimum.map_err(|unsolved| Fault::of_field("max-walls", unsolved, "give fewer `max-walls`"))?)
}

/// Walls of a layout, one bit for each edge in the order of [`Layout::edges`].
type WallSet = u64;

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
struct Area {
    robots: u16,
    open: Layout,
    base: Cell,
    edges: Vec<Edge>,
    /// The eight symmetries of the square: by edge, the place of its image.
    symmetries: [Vec<usize>; 8],
}

impl Area {
    fn new(robots: u16) -> Result<Self, Halt> {
        let usage = |problem: Problem| Fault::usage(&problem, problem.remedy());
        let side = 2 * u64::from(robots) - 1;
        let mut open = Layout::of(Size::new(side, side).map_err(usage)?);
        let base = open.default_base().map_err(usage)?;
        open.place_base(base).map_err(usage)?;
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
    fn orbits(&self, walls: u32) -> impl Iterator<Item = Vec<WallSet>> {
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

    fn layout(&self, walls: WallSet) -> Layout {
        let mut layout = self.open.clone();
        for (place, &edge) in self.edges.iter().enumerate() {
            if walls >> place & 1 == 1 {
                layout.build_wall(edge);
            }
        }
        layout
    }

    fn setup(&self, rule: RuleName, layout: Layout) -> Setup {
        Setup::new(&CHAIN, rule, self.robots, layout, self.base)
    }

    /// What a team that knows the `layout` has to explore.
    fn goals(&self, layout: &Layout) -> Result<(Ground, CellSet), Halt> {
        let is_open = |edge| layout.is_open(edge);
        let outside = || Fault::usage("the base is outside the layout", "place it on a free cell");
        let ground = Ground::new(layout.size().area(), self.base, self.robots.into(), is_open);
        let ground = ground.ok_or_else(outside)?;
        let goals = ground.reachable(&KNOWING);
        let goals = goals.map_err(|too_large| Fault::usage(too_large, "measure fewer robots"))?;
        Ok((ground, goals))
    }

    /// Runs the chain under both rules in layouts that have one optimum.
    fn compare(&self, orbit: &[WallSet]) -> Result<[Sums; 2], Halt> {
        let mut sums = <[Sums; 2]>::default();
        let mut optimum = None;
        for &walls in orbit {
            let layout = self.layout(walls);
            let (ground, goals) = self.goals(&layout)?;
            let optimum = match optimum {
                Some(optimum) => optimum,
                None => *optimum.insert(solve(&ground, &goals)?.moves()),
            };
            for (rule, sums) in RuleName::ALL.into_iter().zip(&mut sums) {
                let report = explore(&self.setup(rule, layout.clone()), &mut |_| Ok(()))?;
                sums.count(walls, optimum, &goals, &report.chart);
            }
        }
        Ok(sums)
    }
}

/// Sums over layouts.
#[derive(Clone, Default)]
struct Sums {
    layouts: u64,
    walled_in: u64,
    missed: u64,
    beyond: u64,
    /// By team moves of the chain and of the optimum: how many layouts, and the first by number of walls.
    compared: BTreeMap<(u32, u32), (u64, (u32, WallSet))>,
}

fn both(one: [Sums; 2], other: [Sums; 2]) -> [Sums; 2] {
    let mut sums = one;
    for (sums, more) in sums.iter_mut().zip(other) {
        sums.add(more);
    }
    sums
}

impl Sums {
    fn count(&mut self, walls: WallSet, optimum: u32, goals: &CellSet, chart: &Chart) {
        self.layouts += 1;
        let is_beyond = |cell| chart.step(cell).is_some() && !goals.contains(cell);
        self.beyond += u64::from(chart.area().cells().any(is_beyond));
        let last = goals.iter().map(|goal| chart.step(goal)).try_fold(0, |last, step| Some(step?.max(last)));
        match last {
            _ if optimum == 0 => self.walled_in += 1,
            None => self.missed += 1,
            Some(last) => self.pair((last, optimum), 1, (walls.count_ones(), walls)),
        }
    }

    fn pair(&mut self, moves: (u32, u32), layouts: u64, first: (u32, WallSet)) {
        let known = self.compared.entry(moves).or_insert((0, first));
        *known = (known.0 + layouts, known.1.min(first));
    }

    fn add(&mut self, other: Self) {
        let Self { layouts, walled_in, missed, beyond, compared } = other;
        self.layouts += layouts;
        self.walled_in += walled_in;
        self.missed += missed;
        self.beyond += beyond;
        for (moves, (layouts, first)) in compared {
            self.pair(moves, layouts, first);
        }
    }

    /// The layouts compared whose team moves are as `is_such` says.
    fn layouts(&self, is_such: impl Fn(u32, u32) -> bool) -> u64 {
        let such = self.compared.iter().filter(|&(&(chain, optimum), _)| is_such(chain, optimum));
        such.map(|(_, &(layouts, _))| layouts).sum()
    }

    /// The mean is summed in the order of team moves, so that it rounds alike on every machine.
    #[expect(clippy::cast_precision_loss, reason = "the counts stay far below 2⁵³")]
    fn line(&self, area: &Area, walls: [u32; 2], rule: RuleName) -> Line {
        let compared = self.layouts(|_, _| true);
        let ratios = self
            .compared
            .iter()
            .map(|(&(chain, optimum), &(layouts, _))| layouts as f64 * f64::from(chain) / f64::from(optimum));
        let mean = ratios.sum::<f64>() / compared as f64;
        let worst = self.compared.iter().min_by(|(one, (_, one_first)), (other, (_, other_first))| {
            let ratios = (one.0 * other.1, other.0 * one.1);
            Reverse(ratios.0).cmp(&Reverse(ratios.1)).then(one_first.cmp(other_first))
        });
        Line {
            robots: area.robots,
            walls,
            rule,
            layouts: self.layouts,
            walled_in: self.walled_in,
            missed: self.missed,
            beyond: self.beyond,
            compared,
            below: self.layouts(|chain, optimum| chain < optimum),
            optimal: self.layouts(|chain, optimum| chain == optimum),
            mean: (compared > 0).then(|| hundredths(mean)),
            worst: worst.map(|(&(chain, optimum), &(_, (_, walls)))| Worst {
                chain,
                optimum,
                layout: area.layout(walls),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::ground::Side;

    use super::*;

    #[test]
    fn every_layout_is_in_one_orbit() {
        for field in [Field::TWO_ROBOTS, Field::three_robots(3)] {
            let area = Area::new(field.robots).map_err(|_| ()).expect("an area");
            let walls = field.walls[0]..=field.walls[1];
            let mut all: Vec<WallSet> = walls.flat_map(|walls| area.orbits(walls)).flatten().collect();
            assert_eq!(all.len() as u64, field.layouts());
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len() as u64, field.layouts());
        }
        assert_eq!(Field::TWO_ROBOTS.layouts(), 4096);
        assert_eq!(Field::three_robots(4).layouts(), 91_390);
    }

    #[test]
    fn images_have_one_optimum_and_both_rules_the_same() {
        let area = Area::new(3).map_err(|_| ()).expect("an area");
        for orbit in area.orbits(3).step_by(97) {
            let optima: Vec<u32> = orbit
                .iter()
                .flat_map(|&walls| {
                    let (ground, goals) = area.goals(&area.layout(walls)).map_err(|_| ()).expect("a ground");
                    RuleName::ALL.map(|rule| {
                        assert_eq!(ground.reachable(&rule.chain()).expect("a small ground"), goals);
                        let solved =
                            explore_all(&ground, &rule.chain(), &goals, Guide::Distances, MOST_STATES);
                        solved.expect("a small ground").moves()
                    })
                })
                .collect();
            assert!(optima.iter().all(|&moves| moves == optima[0]), "{orbit:?}: {optima:?}");
        }
    }

    #[test]
    fn a_blocked_follower_lets_the_leader_into_a_cell_that_is_not_chain_reachable() {
        let area = Area::new(3).map_err(|_| ()).expect("an area");
        let mut layout = area.layout(0);
        for x in 1..=3 {
            layout.build_wall(Edge::new(Cell::new(x, 1), Side::South));
        }
        let (_, goals) = area.goals(&layout).map_err(|_| ()).expect("a ground");
        let beyond = Cell::new(2, 0);
        assert!(!goals.contains(beyond));
        for rule in RuleName::ALL {
            let setup = area.setup(rule, layout.clone());
            let report = explore(&setup, &mut |_| Ok(())).map_err(|_| ()).expect("a run");
            assert!(report.chart.step(beyond).is_some() && report.violations.is_empty(), "{rule}");
        }
    }
}
