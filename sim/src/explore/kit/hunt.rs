//! Hunts of robots that keep in touch: all walls, all starts, and all orders of decisions and arrivals on all small
//! lattices. Of two robots one image of each state is searched; what is broken there is searched again as it is, with
//! as few walls as can be. Where that is ended, what was found is unfolded, unless it goes round: this need not be so
//! of the lattice itself.

use std::ops::ControlFlow;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::kit::Rule as Kit;
use tautline_proofs::engine::states::{Findings, Run};
use tautline_proofs::kit::counterexample::{Counterexample, fewest};
use tautline_proofs::kit::symmetry::SymmetricLattice;
use tautline_proofs::kit::world::{Demand, Setting, Speeds, Starts};
use tautline_proofs::plural::counted;
use tautline_proofs::run::ScriptedRun;

use super::team::{EQUAL, reach};
use crate::explore::hunt::{
    Bound, CoveredBound, Exhibit, Facts, Finding, Hunt, HuntReport, HuntRequest, Hunter, RunSize, layout,
};
use crate::explore::states::{Count, Small, minimised, report, watched};
use crate::explore::{ClauseId, Setup};
use tautline_grids::layout::Size;

/// The most robots of which all states are searched together.
const MOST_ROBOTS: u64 = 3;

const SMALL: Small = Small {
    cell: "node",
    most_cells: 16,
    most_side: (8, " and 8 on a side"),
    default_size: (3, 2),
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
    const EQUAL: Self = Self { speeds: Speeds::Equal, demand: Some(Demand::Contact), ..Self::ALL };
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
        let max_walls = asked.max_walls.map_or(walls, |most| most.min(walls)) as u8;
        Some(Setting { max_walls, speeds, starts, demand, ..setting })
    }

    /// The clause that a run of so many robots breaks with this demand.
    fn clause(self, demand: Demand, robots: usize) -> ClauseId {
        match self.speeds {
            Speeds::Equal => EQUAL,
            Speeds::Any | Speeds::OneByOne => ClauseId::new(demand.clause(robots)),
        }
    }
}

/// A counterexample, and what was looked for when it was found.
struct BrokenClause<const ROBOTS: usize> {
    clause: ClauseId,
    demand: Demand,
    found: Counterexample<ROBOTS>,
}

/// How all states of a lattice are searched.
type SearchAll<const ROBOTS: usize> =
    fn(Setting<ROBOTS>, &HuntRequest<'_>, &mut Count, &mut dyn Hunter) -> Findings<Demand>;

/// A run on a lattice, by one of how it is searched.
type Unfold<const ROBOTS: usize> = fn(Setting<ROBOTS>, &Run<Demand>) -> Option<Counterexample<ROBOTS>>;

/// How a lattice is searched: all its states, and what each of the runs is that are found so.
type How<const ROBOTS: usize> = (SearchAll<ROBOTS>, Unfold<ROBOTS>);

/// A lattice itself, whose runs are what they are.
fn itself<const ROBOTS: usize>() -> How<ROBOTS> {
    (as_it_is, |setting, run| Some(Counterexample { setting, run: run.clone() }))
}

/// One image of all lattices that are alike, whose runs are unfolded.
const IN_ONE_IMAGE: How<2> = (in_one_image, Counterexample::of_image);

fn as_it_is<const ROBOTS: usize>(
    setting: Setting<ROBOTS>,
    asked: &HuntRequest<'_>,
    count: &mut Count,
    hunter: &mut dyn Hunter,
) -> Findings<Demand> {
    watched(&setting, setting.starts(), &what(&setting), asked, count, hunter)
}

fn in_one_image(
    setting: Setting<2>,
    asked: &HuntRequest<'_>,
    count: &mut Count,
    hunter: &mut dyn Hunter,
) -> Findings<Demand> {
    watched(&SymmetricLattice::new(setting), setting.starts(), &what(&setting), asked, count, hunter)
}

fn what<const ROBOTS: usize>(setting: &Setting<ROBOTS>) -> String {
    format!("lattices up to {}×{}", setting.area.width(), setting.area.height())
}

impl Hunt for KernelHunt {
    fn takes(&self) -> &'static [Bound] {
        &[Bound::Walls, Bound::Range]
    }

    fn again<'a>(&self, setup: &Setup, asked: HuntRequest<'a>) -> HuntRequest<'a> {
        HuntRequest { range_cells: setup.options.range_cells, ..asked }
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        let (size, robots) = bounds(asked)?;
        let rule = Kit { reach: reach(asked.range_cells)?, ..self.0 };
        let mut count = Count { is_complete: true, ..Count::default() };
        let found = match robots {
            1 => searched::<1>(rule, &[Pass::ALL], itself(), size, asked, &mut count, hunter),
            2 => searched(rule, &[Pass::ALL, Pass::EQUAL], IN_ONE_IMAGE, size, asked, &mut count, hunter),
            _ => searched::<3>(rule, &[Pass::ALL, Pass::WHOLE], itself(), size, asked, &mut count, hunter),
        }?;
        let Count { states, steps, cells, .. } = count;
        let max_walls = asked.max_walls;
        let within = max_walls.map(|walls| format!(", at most {}", counted(walls, "wall")));
        let range = asked.range_cells.map(|cells| format!(", a range of {}", counted(cells, "cell")));
        let within = within.unwrap_or_default() + &range.unwrap_or_default();
        let covered = cells.map(|nodes| format!("of at most {}", counted(nodes, "node")));
        Ok(report(
            (size, robots, &within),
            Facts::States { size: size.to_string(), states, steps, max_walls, range: asked.range_cells },
            (CoveredBound::NodesDone(cells), covered),
            &count,
            found,
        ))
    }
}

/// All lattices up to a size that have a path, fewest nodes first, and each once: one that lies on its side is the
/// same.
fn lattices(size: Size) -> Vec<(i16, i16)> {
    let (columns, rows) = (size.width(), size.height());
    let all = (1..=rows).flat_map(|height| (1..=columns).map(move |width| (width, height)));
    let is_new = |&(width, height): &(i16, i16)| width >= height || height > columns || width > rows;
    let mut lattices: Vec<(i16, i16)> = all.filter(|&size| size != (1, 1)).filter(is_new).collect();
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
fn searched<const ROBOTS: usize>(
    rule: Kit,
    passes: &[Pass],
    (search_all, unfold): How<ROBOTS>,
    size: Size,
    asked: &HuntRequest<'_>,
    count: &mut Count,
    hunter: &mut dyn Hunter,
) -> Result<Vec<Finding>, Diagnostic> {
    let mut all: Vec<BrokenClause<ROBOTS>> = Vec::new();
    let lattices = lattices(size);
    'lattices: for &lattice in &lattices {
        for &pass in passes {
            // Runs at equal speeds are runs, and less is demanded of them.
            let is_kept = all.iter().all(|broken| broken.demand != Demand::Contact);
            if pass.speeds == Speeds::Equal && is_kept {
                continue;
            }
            let Some(setting) = pass.setting(rule, lattice, asked) else { continue };
            let is_known =
                |clause: ClauseId| all.iter().any(|broken: &BrokenClause<ROBOTS>| broken.clause == clause);
            if pass.demand.is_some_and(|demand| is_known(pass.clause(demand, ROBOTS))) {
                continue;
            }
            let looked = search_all(setting, asked, count, hunter);
            let mut is_ended = !looked.is_whole;
            for run in &looked.broken {
                let (demand, clause) = (run.demand, pass.clause(run.demand, ROBOTS));
                if all.iter().any(|broken| broken.clause == clause) {
                    continue;
                }
                let look =
                    |setting: &Setting<ROBOTS>| minimised(setting, setting.starts(), asked, count, hunter);
                let found = match fewest(setting, demand, look) {
                    ControlFlow::Continue(found) => found,
                    ControlFlow::Break(()) => {
                        count.not_minimised.push(clause.as_str());
                        is_ended = true;
                        unfold(setting, run)
                    }
                };
                all.extend(found.map(|found| BrokenClause { clause, demand, found }));
            }
            if is_ended {
                count.is_complete = false;
                break 'lattices;
            }
        }
        count.covers(lattice, &lattices);
    }
    all.sort_by_key(|broken| broken.clause);
    all.iter().map(|broken| finding(asked, broken)).collect()
}

/// A counterexample of a search as one that can be stored.
fn finding<const ROBOTS: usize>(
    asked: &HuntRequest<'_>,
    broken: &BrokenClause<ROBOTS>,
) -> Result<Finding, Diagnostic> {
    let BrokenClause { clause, found, .. } = broken;
    let area = found.setting.area;
    let (columns, rows) = (area.width(), area.height());
    let Some(ScriptedRun { run, choices }) = found.scripted() else {
        let remedy = "report it: this is a bug of tautline";
        return Err(Diagnostic::usage("a run was found that cannot be made again", remedy));
    };
    let (layout, starts) = layout(&run)?;
    let setup = asked.setup(layout, starts, Some(*clause))?;
    let story = found.story();
    let (drives, walls) = (found.drives(), run.walls.len());
    Ok(Finding {
        clause: clause.as_str(),
        facts: RunSize::Area { columns, rows, walls, steps: drives },
        title: format!("{columns}x{rows} nodes, {}, {}", counted(walls, "wall"), counted(drives, "drive")),
        shown: Exhibit::Story(*clause, story),
        setup: Setup { choices, ..setup },
    })
}
