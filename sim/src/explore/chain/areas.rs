//! The hunt of chains over areas: whatever their columns and rows, and wherever the base is.

use tautline_io::diagnostic::Diagnostic;
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::areas::{Areas, Findings, Smallest, most_edges, search};
use tautline_proofs::plural::counted;

use super::bounds::{bounds, fault, finding, team};
use crate::explore::ClauseId;
use crate::explore::hunt::{
    CoveredBound, Facts, Far, Finding, HuntReport, HuntRequest, Hunter, RunSize, in_order, outcome,
};

/// Searches all areas of at most so many cells.
pub(super) fn hunt(
    observed: Subject,
    asked: &HuntRequest<'_>,
    max_cells: u32,
    hunter: &mut dyn Hunter,
) -> Result<HuntReport, Diagnostic> {
    if asked.resume.is_some() {
        refuse(asked, "resume", "a hunt over areas is not kept in a file")?;
    }
    let areas = areas_to_search(observed, asked, max_cells)?;
    let mut hears = |found: &Findings| {
        let done = found.cells.unwrap_or(0);
        let runs = counted(found.runs(), "run");
        hunter.hears(Far::Words(format!("areas of {done} of {max_cells} cells, {runs}")))
    };
    let found = search(&areas, &mut hears).map_err(|refused| fault(refused, areas.robots))?;
    report(asked, &areas, &found)
}

/// Refuses what a hunt over areas does not take, if this is one.
pub(super) fn refuse(asked: &HuntRequest<'_>, field: &'static str, what: &str) -> Result<(), Diagnostic> {
    let remedy = format!("leave `{field}` out; fewer `max-cells` or `max-walls` make it shorter");
    asked.bounds.max_cells.map_or(Ok(()), |_| Err(Diagnostic::of_field(field, what, remedy)))
}

/// The areas that are asked for.
fn areas_to_search(observed: Subject, asked: &HuntRequest<'_>, max_cells: u32) -> Result<Areas, Diagnostic> {
    let (robots, walls) = team(asked);
    let whole = bounds(observed, robots, walls, None)?;
    let within_reach = (whole.area.width() * whole.area.height()) as u32;
    if !(1..=within_reach).contains(&max_cells) {
        let what = match max_cells {
            0 => "an area has a cell at least".to_owned(),
            _ => format!("{} get to {within_reach} cells at most", counted(robots, "robot")),
        };
        let remedy = format!("give `max-cells` a number from 1 to {within_reach}");
        return Err(Diagnostic::of_field("max-cells", what, remedy));
    }
    let edges = most_edges(max_cells);
    if asked.bounds.max_walls.is_some_and(|walls| walls > edges) {
        let what = format!("no area of {} has room for {walls} walls", counted(max_cells, "cell"));
        let remedy = format!("give `max-walls` a number up to {edges}, or more `max-cells`");
        return Err(Diagnostic::of_field("max-walls", what, remedy));
    }
    let (robots, max_walls, budget_moves) = (whole.robots, walls.min(edges), asked.budget);
    Ok(Areas { observed, robots, max_cells, max_walls, budget_moves, invariants: whole.invariants })
}

/// The report of a search.
fn report(asked: &HuntRequest<'_>, areas: &Areas, found: &Findings) -> Result<HuntReport, Diagnostic> {
    let findings = found.broken.iter().map(|Smallest { bounds, found }| {
        let (columns, rows) = (bounds.area.width(), bounds.area.height());
        finding(asked, bounds, found, |walls, steps, size| {
            (RunSize::Area { columns, rows, walls, steps }, format!("{columns}x{rows} cells, {size}"))
        })
    });
    let mut findings = findings.collect::<Result<Vec<Finding>, Diagnostic>>()?;
    findings.sort_by_key(|found| ClauseId::new(found.clause));
    let &Areas { max_cells, max_walls, robots, .. } = areas;
    let (robots, runs, moves) = (robots as u64, found.runs(), found.moves());
    let (all_runs, all_moves) = (counted(runs, "run"), counted(moves, "team move"));
    let bases: u64 = found.searched.iter().map(|area| area.bases).sum();
    let searched = format!("{} with {}", counted(found.searched.len(), "area"), counted(bases, "place"));
    let searched = searched + " of the base";
    let (cells, walls) = (counted(max_cells, "cell"), counted(max_walls, "wall"));
    let within = format!("{}, at most {cells} and {walls}", counted(robots, "robot"));
    let covered = found.cells.map(|cells| format!("of at most {}", counted(cells, "cell")));
    Ok(HuntReport {
        robots,
        looked_for: in_order(areas.invariants.iter().map(|invariant| invariant.clause())),
        facts: Facts::Areas { runs, moves, max_walls, max_cells, areas: found.searched.clone() },
        is_complete: found.is_complete,
        done: CoveredBound::CellsDone(found.cells),
        title: format!("{within}: {searched}, {all_runs}, {all_moves}"),
        through: format!("{all_runs} and {all_moves}"),
        outcome: outcome(&findings, found.is_complete, covered),
        not_minimised: Vec::new(),
        found: findings,
    })
}
