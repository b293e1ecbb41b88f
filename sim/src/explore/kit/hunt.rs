//! Hunts of robots that keep in touch: all walls, all starts, and all orders of decisions and arrivals on all small
//! lattices. Of two robots one image of each state is searched; what is broken there is searched again as it is, with
//! as few walls as can be. Where that is ended, what was found is unfolded, unless it goes round: this need not be so
//! of the lattice itself.

use std::ops::ControlFlow;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::kit::Rule as Kit;
use tautline_proofs::engine::states::{Run, System};
use tautline_proofs::kit::counterexample::{Counterexample, EQUAL_SPEEDS, fewest};
use tautline_proofs::kit::symmetry::SymmetricLattice;
use tautline_proofs::kit::world::{Demand, Setting, Speeds, Starts, World};
use tautline_proofs::plural::counted;
use tautline_proofs::run::ScriptedRun;

use super::team::{clause_of, reach};
use crate::explore::hunt::{
    Bound, CoveredBound, Exhibit, Facts, Finding, Hunt, HuntBounds, HuntReport, HuntRequest, Hunter, RunSize,
    layout,
};
use crate::explore::states::{Count, Search, Small};
use crate::explore::{ClauseId, Setup};
use tautline_grids::layout::Size;

/// The most robots of which all states are searched together.
const MOST_ROBOTS: u64 = 3;

const SMALL: Small = Small {
    cell: "node",
    most_side: (8, " and 8 on a side"),
    examples: "4x3 or 8x2",
    search: "the joint search",
    no_robots: "a hunt for 0 robots",
};

/// A rule of the kernel, whose states are searched.
#[derive(Debug)]
pub(super) struct KernelHunt(pub(super) Kit);

/// The demand that one search looks for.
#[derive(Clone, Copy)]
struct Pass {
    speeds: Speeds,
    starts: Starts,
    /// The one demand that is looked at; all if there is none.
    demand: Option<Demand>,
}

impl Pass {
    const ALL: Self = Self { speeds: Speeds::Any, starts: Starts::Anywhere, demand: None };
    const EQUAL: Self = Self { demand: Some(Demand::Contact), ..Self::ALL_AT_EQUAL };
    const ALL_AT_EQUAL: Self = Self { speeds: Speeds::Equal, ..Self::ALL };
    const WHOLE: Self = Self { starts: Starts::SideBySide, demand: Some(Demand::Whole), ..Self::ALL };

    fn setting<const ROBOTS: usize>(
        self,
        rule: Kit,
        size: (i16, i16),
        asked: &HuntRequest<'_>,
    ) -> Option<Setting<ROBOTS>> {
        let Self { speeds, starts, demand } = self;
        let setting = Setting::new(rule, size)?;
        let walls = u32::from(setting.max_walls);
        let max_walls = asked.bounds.max_walls.map_or(walls, |most| most.min(walls)) as u8;
        Some(Setting { max_walls, speeds, starts, demand, ..setting })
    }
}

/// A clause, and a counterexample to it.
type BrokenClause<const ROBOTS: usize> = (ClauseId, Counterexample<ROBOTS>);

/// How a lattice is searched: the system whose states are, and the run of the lattice that a run of the system is.
type How<S, const ROBOTS: usize> =
    (fn(Setting<ROBOTS>) -> S, fn(Setting<ROBOTS>, &Run<Demand>) -> Option<Counterexample<ROBOTS>>);

/// A lattice itself, whose runs are what they are.
fn itself<const ROBOTS: usize>() -> How<Setting<ROBOTS>, ROBOTS> {
    (|setting| setting, |setting, run| Some(Counterexample { setting, run: run.clone() }))
}

/// One image of all lattices that are alike, whose runs are unfolded.
const IN_ONE_IMAGE: How<SymmetricLattice, 2> = (SymmetricLattice::new, Counterexample::of_image);

impl Hunt for KernelHunt {
    fn takes(&self) -> &'static [Bound] {
        &[Bound::Walls, Bound::Range]
    }

    fn again(&self, setup: &Setup, bounds: HuntBounds) -> HuntBounds {
        // The first choice says whether robots drive at equal speeds.
        let equal_speeds = setup.choices.first() == Some(&EQUAL_SPEEDS);
        HuntBounds { range_cells: setup.options.range_cells, equal_speeds, ..bounds }
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        let (size, robots) = bounds(asked)?;
        let rule = Kit { reach: reach(asked.bounds.range_cells)?, ..self.0 };
        let mut search = Search::new(asked, hunter);
        let passes = if asked.bounds.equal_speeds {
            [Pass::EQUAL, Pass::ALL_AT_EQUAL]
        } else {
            [Pass::ALL, Pass::EQUAL]
        };
        let found = match robots {
            1 => searched(rule, &[Pass::ALL], itself::<1>(), size, &mut search),
            2 => searched(rule, &passes, IN_ONE_IMAGE, size, &mut search),
            _ => searched(rule, &[Pass::ALL, Pass::WHOLE], itself::<3>(), size, &mut search),
        }?;
        let Count { states, steps, cells, .. } = search.count;
        let HuntBounds { max_walls, range_cells: range, .. } = asked.bounds;
        let within = max_walls.map(|walls| format!(", at most {}", counted(walls, "wall")));
        let heard = range.map(|cells| format!(", a range of {}", counted(cells, "cell")));
        let within = within.unwrap_or_default() + &heard.unwrap_or_default();
        let facts = Facts::States { size: size.to_string(), states, steps, max_walls, range };
        let done = CoveredBound::NodesDone(cells);
        Ok(SMALL.report((size, robots, &within), facts, done, search.count, found))
    }
}

/// All lattices up to a size that have a path, fewest nodes first, and each once: one that lies on its side is the
/// same.
fn lattices(size: Size) -> Vec<(i16, i16)> {
    let (columns, rows) = (size.width(), size.height());
    let is_new = |&(width, height): &(i16, i16)| width >= height || height > columns || width > rows;
    let mut lattices = size.areas();
    lattices.retain(|size| *size != (1, 1) && is_new(size));
    lattices.sort_by_key(|&(width, height)| (width * height, width.min(height)));
    lattices
}

/// The size and the number of robots that are asked for.
fn bounds(asked: &HuntRequest<'_>) -> Result<(Size, u64), Diagnostic> {
    let size = SMALL.size(asked)?;
    if size.cells() == 1 {
        let what = "1x1 is one node, and no path to drive";
        return Err(Diagnostic::of_field("size", what, "give `size` at least 2 nodes, for example 2x1"));
    }
    let robots = SMALL.robots(asked, MOST_ROBOTS, size, &size.cells().to_string())?;
    Ok((size, robots))
}

/// The smallest counterexample of each clause, on all lattices up to a size.
fn searched<S: System<State = World<ROBOTS>, Demand = Demand>, const ROBOTS: usize>(
    rule: Kit,
    passes: &[Pass],
    (system, unfold): How<S, ROBOTS>,
    size: Size,
    search: &mut Search<'_>,
) -> Result<Vec<Finding>, Diagnostic> {
    let mut all: Vec<BrokenClause<ROBOTS>> = Vec::new();
    for pass in passes {
        let setting = pass.setting::<ROBOTS>(rule, (2, 1), search.asked);
        let clause = |demand| clause_of(demand, pass.speeds, ROBOTS).as_str();
        search.count.looked_for.extend(setting.iter().flat_map(Setting::demands).map(clause));
    }
    let lattices = lattices(size);
    'lattices: for &lattice in &lattices {
        for &pass in passes {
            // Runs at equal speeds are among those at any, if these are searched, too.
            let contact = clause_of(Demand::Contact, Speeds::Any, ROBOTS);
            let is_kept =
                !search.asked.bounds.equal_speeds && all.iter().all(|(clause, _)| *clause != contact);
            if pass.speeds == Speeds::Equal && is_kept {
                continue;
            }
            let Some(setting) = pass.setting(rule, lattice, search.asked) else { continue };
            let is_known = |all: &[BrokenClause<ROBOTS>], demand| {
                let clause = clause_of(demand, pass.speeds, ROBOTS);
                all.iter().any(|(known, _)| *known == clause)
            };
            if pass.demand.is_some_and(|demand| is_known(&all, demand)) {
                continue;
            }
            let what = format!("lattices up to {}×{}", lattice.0, lattice.1);
            let looked = search.all(&system(setting), setting.starts(), &what);
            search.count.is_complete = looked.is_whole;
            for run in &looked.broken {
                if is_known(&all, run.demand) {
                    continue;
                }
                let (demand, clause) = (run.demand, clause_of(run.demand, pass.speeds, ROBOTS));
                let look = |setting: &Setting<ROBOTS>| search.minimised(setting, setting.starts());
                let found = match fewest(setting, demand, look) {
                    ControlFlow::Continue(found) => found,
                    ControlFlow::Break(()) => {
                        search.count.not_minimised.push(clause.as_str());
                        search.count.is_complete = false;
                        unfold(setting, run)
                    }
                };
                all.extend(found.map(|found| (clause, found)));
            }
            if !search.count.is_complete {
                break 'lattices;
            }
        }
        search.count.covers(lattice, &lattices);
    }
    all.iter().map(|broken| finding(search.asked, broken)).collect()
}

/// A counterexample of a search as one that can be stored.
fn finding<const ROBOTS: usize>(
    asked: &HuntRequest<'_>,
    (clause, found): &BrokenClause<ROBOTS>,
) -> Result<Finding, Diagnostic> {
    let area = found.setting.area;
    let (columns, rows) = (area.width(), area.height());
    let Some(ScriptedRun { run, choices }) = found.scripted() else {
        let remedy = "report it: this is a bug of tautline";
        return Err(Diagnostic::usage("a run was found that cannot be made again", remedy));
    };
    let (layout, starts) = layout(&run)?;
    let (drives, walls) = (found.drives(), run.walls.len());
    Ok(Finding {
        clause: clause.as_str(),
        facts: RunSize::Lattice { columns, rows, walls, drives },
        title: format!("{columns}x{rows} nodes, {}, {}", counted(walls, "wall"), counted(drives, "drive")),
        shown: Exhibit::Story(*clause, found.story()),
        setup: Setup { choices, ..asked.setup(layout, starts, Some(*clause))? },
    })
}
