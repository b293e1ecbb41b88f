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
    Bound, CoveredBound, Exhibit, Facts, Finding, Hunt, HuntBounds, HuntReport, HuntRequest, Hunter, RunSize,
    layout,
};
use crate::explore::states::{Count, Search, Small};
use crate::explore::{ClauseId, Setup};
use tautline_grids::layout::{Layout, Size};

/// The most robots of which all states are searched.
const MOST_ROBOTS: u64 = 3;

const SMALL: Small = Small {
    cell: "cell",
    most_side: (i16::MAX, ""),
    examples: "4x4 or 8x2",
    search: "this search",
    no_robots: "a hunt without a robot finds nothing",
};

/// The kernel's robots, whose states are searched.
#[derive(Debug)]
pub(super) struct KernelHunt(pub(super) Frontier);

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
    fn again(&self, setup: &Setup, bounds: HuntBounds) -> HuntBounds {
        let Some(&[losses, wrong]) = setup.choices.first_chunk() else { return bounds };
        HuntBounds { max_losses: Some(losses as u8), error_cells: Some(f64::from(wrong)), ..bounds }
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        let (size, robots) = bounds(asked, MOST_ROBOTS)?;
        let error = error_parts(asked)?;
        let is_part = (1..WHOLE).contains(&error);
        if is_part && robots > 1 {
            let what = "an error of a part of a cell is searched of one robot alone";
            return Err(Diagnostic::of_field("error", what, "give `robots` 1, or `error` 1"));
        }
        let mut search = Search::new(asked, hunter);
        let found = match robots {
            1 if is_part => drifting(self.0, size, error, &mut search),
            1 => searched::<1>(self.0, size, error / WHOLE, &mut search),
            2 => searched::<2>(self.0, size, error / WHOLE, &mut search),
            _ => searched::<3>(self.0, size, error / WHOLE, &mut search),
        }?;
        let looked_for = if is_part { &[Demand::Marks][..] } else { &Demand::ALL };
        search.count.looked_for = looked_for.iter().map(|demand| demand.clause()).collect();
        Ok(report(asked, (size, robots), search.count, found))
    }
}

/// The sixteenths of a whole cell.
const WHOLE: u8 = PARTS as u8;

/// How far fixes are off at most, in sixteenths of a cell; a fix that is off by a whole one is the only one.
fn error_parts(asked: &HuntRequest<'_>) -> Result<u8, Diagnostic> {
    let cells = asked.bounds.error_cells.unwrap_or(0.0);
    let parts = cells * f64::from(PARTS);
    let is_all = |whole: &u8| f64::from(*whole).partial_cmp(&parts).is_some_and(Ordering::is_eq);
    (0..=WHOLE).find(is_all).ok_or_else(|| {
        let what = format!("an error of {cells} cells is not searched");
        let remedy =
            "give `error` a number of sixteenths from 0 to 1, such as 0.25; 1 is one fix off by one cell";
        Diagnostic::of_field("error", what, remedy)
    })
}

/// The search that the hunter hears of.
fn words((width, height): (i16, i16)) -> String {
    format!("areas up to {width}×{height}")
}

/// The hunt of one robot each of whose fixes is off by a part of a cell.
fn drifting(
    rule: Frontier,
    size: Size,
    error: u8,
    search: &mut Search<'_>,
) -> Result<Vec<Finding>, Diagnostic> {
    let asked = search.asked;
    let system = Drift { rule, error, max_obstacles: most_obstacles(asked) };
    let areas = size.areas();
    for &area in &areas {
        let looked = search.all(&system, system.starts(&[area]), &words(area));
        search.count.is_complete = looked.is_whole;
        if let Some(run) = looked.broken.first() {
            let layout = Layout::open(area.0 as u64, area.1 as u64)?;
            let start = layout.default_base()?;
            let (story, walls) = system.story(area, run);
            let (facts, title) = sized([area.0 as usize, area.1 as usize], walls, run.steps.len());
            let setup = asked.setup(layout, vec![start], None)?;
            let clause = Demand::Marks.clause();
            return Ok(vec![Finding { clause, facts, title, setup, shown: Exhibit::Told(story) }]);
        }
        if !looked.is_whole {
            break;
        }
        search.count.covers(area, &areas);
    }
    Ok(Vec::new())
}

/// Most obstacles that one run meets.
fn most_obstacles(asked: &HuntRequest<'_>) -> u8 {
    asked.bounds.max_walls.map_or(Small::MOST_CELLS as u8, |walls| walls.min(Small::MOST_CELLS as u32) as u8)
}

fn searched<const ROBOTS: usize>(
    rule: Frontier,
    size: Size,
    max_wrong: u8,
    search: &mut Search<'_>,
) -> Result<Vec<Finding>, Diagnostic> {
    let asked = search.asked;
    let max_losses = asked.bounds.max_losses.unwrap_or(0);
    let mut found: Vec<(Demand, Counterexample<ROBOTS>)> = Vec::new();
    let areas = size.areas();
    for &area in &areas {
        let Some(all) = setting::<ROBOTS>(rule, area) else { continue };
        let all = Setting { max_obstacles: most_obstacles(asked), max_losses, max_wrong, ..all };
        let looked = search.all(&all, all.starts(), &words(area));
        search.count.is_complete = looked.is_whole;
        for run in looked.broken {
            let demand = run.demand;
            if found.iter().all(|(known, _)| *known != demand) {
                let look = |setting: &Setting<ROBOTS>| search.minimised(setting, setting.starts());
                let counterexample = match fewest(all, run, look) {
                    ControlFlow::Continue(fewest) => fewest,
                    ControlFlow::Break(run) => {
                        search.count.not_minimised.push(demand.clause());
                        search.count.is_complete = false;
                        Counterexample { setting: all, run }
                    }
                };
                found.push((demand, counterexample));
            }
        }
        if !search.count.is_complete {
            break;
        }
        search.count.covers(area, &areas);
    }
    found.iter().map(|(demand, found)| finding(asked, *demand, found)).collect()
}

/// A counterexample of a search as one that can be stored.
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
    let (is_stored, story) = (!setup.choices.is_empty(), found.story());
    let shown = if is_stored { Exhibit::Story(clause, story) } else { Exhibit::Told(story) };
    let (facts, title) = sized([area.width(), area.height()], walls, moves);
    Ok(Finding { clause: demand.clause(), facts, title, setup, shown })
}

/// How large a run is, for JSON and for people.
fn sized([columns, rows]: [usize; 2], walls: usize, steps: usize) -> (RunSize, String) {
    let title = format!("{columns}x{rows} cells, {walls} blocked, {}", counted(steps, "move"));
    (RunSize::Area { columns, rows, walls, steps }, title)
}

/// The report of a hunt.
fn report(
    asked: &HuntRequest<'_>,
    (size, robots): (Size, u64),
    count: Count,
    found: Vec<Finding>,
) -> HuntReport {
    let Count { states, steps, cells, .. } = count;
    let HuntBounds { max_walls, max_losses, error_cells: error, .. } = asked.bounds;
    let max_losses = max_losses.unwrap_or(0);
    let lost = if max_losses == 0 { String::new() } else { format!(", at most {max_losses} lost") };
    let walls = max_walls.map_or_else(String::new, |walls| format!(", at most {walls} blocked"));
    let facts =
        Facts::StatesWithLosses { size: size.to_string(), states, steps, max_walls, max_losses, error };
    let done = CoveredBound::CellsDone(cells.map(|cells| cells as u32));
    SMALL.report((size, robots, &(walls + &lost)), facts, done, count, found)
}
