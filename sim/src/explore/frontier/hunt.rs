//! Hunts of robots that explore cells. Of the kernel's robots all states are searched: all obstacles, all starts, all
//! orders, lost messages and wrong fixes. Of rivals all layouts and starts are tried, smallest first.

mod rivals;

use std::cmp::Ordering;
use std::ops::ControlFlow;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::frontier::Rule as Frontier;
use tautline_kernel::ground::Cell;
use tautline_proofs::frontier::areas::{Counterexample, fewest, setting};
use tautline_proofs::frontier::drift::{Drift, PARTS};
use tautline_proofs::frontier::world::{Demand, Event, Setting};
use tautline_proofs::plural::counted;
use tautline_proofs::run::ScriptedRun;

pub(super) use self::rivals::RivalHunt;
use crate::explore::hunt::{
    Bound, CoveredBound, Exhibit, Facts, Finding, Hunt, HuntReport, HuntRequest, Hunter, RunSize, layout,
};
use crate::explore::states::{self, Count, Small, minimised, watched};
use crate::explore::{ClauseId, Setup};
use tautline_grids::layout::{Layout, Size};

/// The most robots of which all states are searched.
const MOST_ROBOTS: u64 = 3;

const SMALL: Small = Small {
    cell: "cell",
    most_cells: 16,
    most_side: (i16::MAX, ""),
    default_size: (3, 2),
    examples: "4x4 or 8x2",
    search: "this search",
    no_robots: "a hunt without a robot finds nothing",
};

/// The kernel's robots, whose states are searched.
#[derive(Debug)]
pub(super) struct KernelHunt(pub(super) Frontier);

/// All areas up to a size, fewest cells first.
fn areas(size: Size) -> Vec<(i16, i16)> {
    let mut areas: Vec<(i16, i16)> =
        (1..=size.height()).flat_map(|height| (1..=size.width()).map(move |width| (width, height))).collect();
    areas.sort_by_key(|&(width, height)| (width * height, height));
    areas
}

/// The size and the number of robots that are asked for.
fn bounds(asked: &HuntRequest<'_>, most: u64) -> Result<(Size, u64), Diagnostic> {
    let size = SMALL.size(asked)?;
    Ok((size, SMALL.robots(asked, most, size, &size.to_string())?))
}

impl Hunt for KernelHunt {
    fn takes(&self) -> &'static [Bound] {
        &[Bound::Walls, Bound::Losses, Bound::Error]
    }

    /// The first two choices say how many messages are lost and how many fixes are wrong at most.
    fn again<'a>(&self, setup: &Setup, asked: HuntRequest<'a>) -> HuntRequest<'a> {
        let Some(&[losses, wrong]) = setup.choices.first_chunk() else { return asked };
        HuntRequest { max_losses: Some(losses as u8), error_cells: Some(f64::from(wrong)), ..asked }
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        let (size, robots) = bounds(asked, MOST_ROBOTS)?;
        let max_wrong = match error(asked)? {
            Off::Never => 0,
            Off::OneCell => 1,
            Off::Parts(_) if robots > 1 => {
                let what = "an error of a part of a cell is searched of one robot alone";
                return Err(Diagnostic::of_field("error", what, "give `robots` 1, or `error` 1"));
            }
            Off::Parts(parts) => return drifting(self.0, size, parts, asked, hunter),
        };
        let hunt = match robots {
            1 => searched::<1>,
            2 => searched::<2>,
            _ => searched::<3>,
        };
        let (count, found) = hunt(self.0, size, max_wrong, asked, hunter)?;
        Ok(report(asked, (size, robots), &count, found))
    }
}

/// How far fixes are off.
enum Off {
    Never,
    /// One of them, by one cell.
    OneCell,
    /// Each, by at most so many sixteenths of a cell.
    Parts(u8),
}

fn error(asked: &HuntRequest<'_>) -> Result<Off, Diagnostic> {
    let parts = asked.error_cells.unwrap_or(0.0) * f64::from(PARTS);
    let whole =
        (0..=PARTS as u8).find(|&whole| f64::from(whole).partial_cmp(&parts).is_some_and(Ordering::is_eq));
    match whole {
        Some(0) => Ok(Off::Never),
        Some(parts) if i32::from(parts) == PARTS => Ok(Off::OneCell),
        Some(parts) => Ok(Off::Parts(parts)),
        None => {
            let what = format!("an error of {} cells is not searched", asked.error_cells.unwrap_or(0.0));
            let remedy =
                "give `error` a number of sixteenths from 0 to 1, such as 0.25; 1 is one fix off by one cell";
            Err(Diagnostic::of_field("error", what, remedy))
        }
    }
}

/// The hunt of one robot each of whose fixes is off by a part of a cell.
fn drifting(
    rule: Frontier,
    size: Size,
    error: u8,
    asked: &HuntRequest<'_>,
    hunter: &mut dyn Hunter,
) -> Result<HuntReport, Diagnostic> {
    let max_obstacles = most_obstacles(asked);
    let system = Drift { rule, error, max_obstacles };
    let mut count = Count { is_complete: true, ..Count::default() };
    let mut found = Vec::new();
    let areas = areas(size);
    for &area in &areas {
        let what = format!("areas up to {}×{}", area.0, area.1);
        let looked = watched(&system, system.starts(&[area]), &what, asked, &mut count, hunter);
        if let Some(run) = looked.broken.first() {
            let layout = Layout::open(area.0 as u64, area.1 as u64)?;
            let start = layout.default_base()?;
            let size = [area.0 as usize, area.1 as usize];
            let (story, walls) = system.story(area, run);
            let clause = Demand::Marks.clause();
            found.push(Finding {
                clause,
                facts: RunSize::Area { columns: size[0], rows: size[1], walls, steps: run.steps.len() },
                title: title(size, walls, run.steps.len()),
                setup: asked.setup(layout, vec![start], None)?,
                shown: Exhibit::Told(story),
            });
        }
        if !looked.is_whole {
            count.is_complete = false;
            break;
        }
        if !found.is_empty() {
            break;
        }
        count.covers(area, &areas);
    }
    Ok(report(asked, (size, 1), &count, found))
}

/// Most obstacles that one run meets.
fn most_obstacles(asked: &HuntRequest<'_>) -> u8 {
    asked.max_walls.map_or(SMALL.most_cells as u8, |walls| walls.min(SMALL.most_cells as u32) as u8)
}

fn searched<const ROBOTS: usize>(
    rule: Frontier,
    size: Size,
    max_wrong: u8,
    asked: &HuntRequest<'_>,
    hunter: &mut dyn Hunter,
) -> Result<(Count, Vec<Finding>), Diagnostic> {
    let max_losses = asked.max_losses.unwrap_or(0);
    let mut found: Vec<(Demand, Counterexample<ROBOTS>)> = Vec::new();
    let mut count = Count { is_complete: true, ..Count::default() };
    let areas = areas(size);
    for &area in &areas {
        let Some(all) = setting::<ROBOTS>(rule, area) else { continue };
        let all = Setting { max_obstacles: most_obstacles(asked), max_losses, max_wrong, ..all };
        let what = format!("areas up to {}×{}", area.0, area.1);
        let looked = watched(&all, all.starts(), &what, asked, &mut count, hunter);
        let mut is_ended = !looked.is_whole;
        for run in looked.broken {
            if found.iter().all(|(known, _)| *known != run.demand) {
                let look = |setting: &Setting<ROBOTS>| {
                    minimised(setting, setting.starts(), asked, &mut count, hunter)
                };
                let demand = run.demand;
                let counterexample = match fewest(all, run, look) {
                    ControlFlow::Continue(fewest) => fewest,
                    ControlFlow::Break(run) => {
                        count.not_minimised.push(demand.clause());
                        is_ended = true;
                        Counterexample { setting: all, run }
                    }
                };
                found.push((demand, counterexample));
            }
        }
        if is_ended {
            count.is_complete = false;
            break;
        }
        count.covers(area, &areas);
    }
    found.sort_by_key(|(demand, _)| demand.clause());
    let findings = found.iter().map(|(demand, found)| finding(asked, *demand, found));
    Ok((count, findings.collect::<Result<_, _>>()?))
}

/// A counterexample of a search as one that can be stored, unless its run goes on for ever.
fn finding<const ROBOTS: usize>(
    asked: &HuntRequest<'_>,
    demand: Demand,
    found: &Counterexample<ROBOTS>,
) -> Result<Finding, Diagnostic> {
    let area = found.setting.area;
    let open = Layout::open(area.width() as u64, area.height() as u64)?;
    let steps = found.steps().map_or_else(Vec::new, |(_, steps, _)| steps);
    let moves = steps.iter().filter(|(event, _)| matches!(event, Event::Looks(..))).count();
    let clause = ClauseId::new(demand.clause());
    let (setup, walls) = match found.scripted() {
        Some(ScriptedRun { run, choices }) => {
            let (layout, starts) = layout(&run)?;
            (Setup { choices, ..asked.setup(layout, starts, Some(clause))? }, run.obstacles.len())
        }
        None => (asked.setup(open, vec![Cell::new(0, 0); ROBOTS], Some(clause))?, 0),
    };
    let is_stored = found.run.round().is_empty() && !setup.choices.is_empty();
    let story = found.story();
    let (columns, rows) = (area.width(), area.height());
    Ok(Finding {
        clause: demand.clause(),
        facts: RunSize::Area { columns, rows, walls, steps: moves },
        title: title([columns, rows], walls, moves),
        shown: if is_stored { Exhibit::Story(clause, story) } else { Exhibit::Told(story) },
        setup,
    })
}

fn title([columns, rows]: [usize; 2], walls: usize, moves: usize) -> String {
    format!("{columns}x{rows} cells, {} blocked, {}", walls, counted(moves, "move"))
}

/// The report of a hunt.
fn report(
    asked: &HuntRequest<'_>,
    (size, robots): (Size, u64),
    count: &Count,
    found: Vec<Finding>,
) -> HuntReport {
    let &Count { states, steps, cells, .. } = count;
    let &HuntRequest { max_walls, error_cells: error, .. } = asked;
    let max_losses = asked.max_losses.unwrap_or(0);
    let lost = if max_losses == 0 { String::new() } else { format!(", at most {max_losses} lost") };
    let walls = max_walls.map_or_else(String::new, |walls| format!(", at most {walls} blocked"));
    let covered = cells.map(|cells| format!("of at most {}", counted(cells, "cell")));
    states::report(
        (size, robots, &(walls + &lost)),
        Facts::StatesWithLosses { size: size.to_string(), states, steps, max_walls, max_losses, error },
        (CoveredBound::CellsDone(cells.map(|cells| cells as u32)), covered),
        count,
        found,
    )
}
